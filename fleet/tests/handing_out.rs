//! A map made at the centre goes to the building's robots; where a robot changed its own meanwhile, both are kept and told
//! thing by thing, and nothing is merged.

mod common;

use std::path::Path;

use common::robot::{home, live, must_be_same};
use common::{Centre, Postgres, furnish};
use orthoframe_fleet::pull::Pulled;
use orthoframe_fleet::push::Line;
use orthoframe_fleet::{db, handout, sheets};
use orthoframe_map::World;
use orthoframe_store::{Change, Store, Timestamp};
use orthoframe_units::{Frame, ReplicaId};

fn move_thing(world: &mut World, name: &str, by: f64) -> ReplicaId {
    let replica = world.replicas.values().find(|r| r.name == name).expect("a thing").id;
    let moved = world.replicas.get_mut(&replica).expect("it is there");
    let at = moved.frame;
    moved.frame = Frame::new(at.x.get() + by, at.y.get(), at.z.get(), at.angle);
    replica
}

fn edit(store: &Path, alter: impl FnOnce(&mut World)) {
    let (mut store, _) = Store::open(store).expect("opens");
    let before = store.world().expect("reads").expect("a map");
    let mut after = before.clone();
    alter(&mut after);
    let change = Change::new("робот", Timestamp(1_850_000_000_000), "сам");
    store.commit_change(&before, &after, &change).expect("commits");
}

fn world_of(store: &Path) -> World {
    Store::open_read_only(store).expect("opens").0.world().expect("reads").expect("a map")
}

#[tokio::test(flavor = "multi_thread")]
async fn a_revision_of_the_centre_goes_to_the_robots_and_nothing_is_merged() {
    let Some(postgres) = Postgres::start("-c fsync=off") else { return };
    let keys = furnish(&postgres.address(), &[(1, 1), (1, 2), (2, 3)]).await;
    let centre = Centre::start(&postgres.address());
    let pool = db::pool(&postgres.address(), 2).expect("an address");
    let mut client = pool.get().await.expect("connects");
    let dir = tempfile::tempdir().expect("a folder");
    let stores: Vec<_> = (0..3).map(|n| dir.path().join(n.to_string())).collect();
    let line = |n: usize| Line::new(&centre.url(), &keys[n], None).expect("loopback");
    let home = home();
    live(&stores[0], 30, 1, &home, false);
    live(&stores[2], 30, 2, &home, false);
    for n in [0, 2] {
        line(n).push(&stores[n]).expect("it is taken");
        assert_eq!(line(n).pull(&stores[n]).expect("answers"), Pulled::Nothing);
    }
    let by = |reason: &str| Change::new("оператор", Timestamp(1_860_000_000_000), reason);
    assert_eq!(handout::adopt(&mut client, 1, 1, &by("от робота 1")).await.expect("adopts"), 1);
    assert_eq!(line(0).pull(&stores[0]).expect("answers"), Pulled::Nothing, "it is its own");
    // A robot with nothing yet takes all of it.
    assert_eq!(
        line(1).pull(&stores[1]).expect("answers"),
        Pulled::Taken { centre: 1, revision: 1 }
    );
    assert_eq!(world_of(&stores[1]), world_of(&stores[0]));
    assert_eq!(line(1).pull(&stores[1]).expect("answers"), Pulled::Nothing);
    assert_eq!(line(2).pull(&stores[2]).expect("answers"), Pulled::Nothing, "another building");

    // A corrected map, from a file as it were.
    let mut corrected = world_of(&stores[0]);
    let names: Vec<String> = corrected.replicas.values().map(|r| r.name.clone()).collect();
    let [first, second] = [&names[0], &names[1]];
    move_thing(&mut corrected, first, 10.0);
    assert_eq!(handout::revise(&mut client, 1, &corrected, &by("поправка")).await.expect("ok"), 2);
    assert_eq!(handout::revise(&mut client, 1, &corrected, &by("ещё раз")).await.expect("ok"), 2);
    let Pulled::Taken { centre: 2, revision } = line(0).pull(&stores[0]).expect("answers") else {
        panic!("it is taken");
    };
    assert_eq!(world_of(&stores[0]), corrected);
    let last =
        Store::open_read_only(&stores[0]).expect("opens").0.revisions().expect("reads").pop();
    let last = last.expect("some");
    assert_eq!((last.number, last.user.as_str()), (revision, "оператор"));
    assert!(
        last.reason.contains("ревизия 2") && last.reason.contains("поправка"),
        "{}",
        last.reason
    );
    line(0).push(&stores[0]).expect("it is taken");
    must_be_same(&pool, 1, 1, &stores[0], false).await;

    // Robot 2 has moved something meanwhile, another thing even: both are kept.
    edit(&stores[1], |world| {
        move_thing(world, second, -7.0);
    });
    let mine = world_of(&stores[1]);
    line(1).push(&stores[1]).expect("it is taken");
    for _ in 0..2 {
        let Pulled::Apart(conflict) = line(1).pull(&stores[1]).expect("answers") else {
            panic!("they are apart");
        };
        assert_eq!(conflict.centre, 2);
        let of =
            |name: &str| conflict.things.iter().find(|t| t.thing.contains(name)).expect("told");
        assert!(!of(first).centre.is_empty() && of(first).robot.is_empty(), "{conflict:?}");
        assert!(of(second).centre.is_empty() && !of(second).robot.is_empty(), "{conflict:?}");
        assert_eq!(world_of(&stores[1]), mine, "nothing is merged");
    }
    let sql = "SELECT count(*) FROM fleet.conflict WHERE robot = 2 AND settled IS NULL";
    let open: i64 = client.query_one(sql, &[]).await.expect("reads").get(0);
    assert_eq!(open, 2, "each once");
    let transaction = client.transaction().await.expect("begins");
    let kept = sheets::sheet(&transaction, 1, 0, 2).await.expect("reads").world().expect("a world");
    assert_eq!(kept.expect("a map"), corrected, "nor at the centre");
    transaction.commit().await.expect("ends");

    // A person puts both into one map, and insists on it.
    let mut both = corrected.clone();
    move_thing(&mut both, second, -7.0);
    assert_eq!(handout::revise(&mut client, 1, &both, &by("обе")).await.expect("ok"), 3);
    handout::insist(&mut client, 1, 2).await.expect("ok");
    let pulled = line(1).pull(&stores[1]).expect("answers");
    assert!(matches!(pulled, Pulled::Taken { centre: 3, .. }), "{pulled:?}");
    assert_eq!(world_of(&stores[1]), both);
    let open: i64 = client.query_one(sql, &[]).await.expect("reads").get(0);
    assert_eq!(open, 0, "it is settled");
    // The other one had changed nothing.
    assert!(matches!(line(0).pull(&stores[0]), Ok(Pulled::Taken { centre: 3, .. })));
    for (n, store) in stores.iter().take(2).enumerate() {
        line(n).push(store).expect("it is taken");
        must_be_same(&pool, 1, n as i64 + 1, store, false).await;
    }
    // The centre's past can be read.
    let transaction = client.transaction().await.expect("begins");
    let first_map = sheets::sheet(&transaction, 1, 0, 1).await.expect("reads").world().expect("ok");
    assert_ne!(first_map.expect("a map"), both);
}
