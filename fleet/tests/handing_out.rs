//! A map made at the centre goes to the building's robots; where a robot changed its own meanwhile, both are kept and told
//! thing by thing, and nothing is merged.

mod common;

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use common::robot::{home, live, must_be_same};
use common::{Centre, Postgres, furnish};
use deadpool_postgres::Object;
use orthoframe_fleet::pull::Pulled;
use orthoframe_fleet::push::Line;
use orthoframe_fleet::{FleetError, db, revise, sheets};
use orthoframe_map::World;
use orthoframe_store::{Change, Changes, Store, Timestamp};
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
    store
        .commit_changes(&Changes::between(&before, &after).expect("no key twice"), &change)
        .expect("commits");
}

async fn revised(client: &mut Object, building: i64, world: &World, change: &Change) -> i64 {
    let transaction = client.transaction().await.expect("begins");
    let made = revise::revise(&transaction, building, None, world, change).await.expect("revises");
    transaction.commit().await.expect("commits");
    made
}

async fn adopted(client: &mut Object, building: i64, robot: i64, change: &Change) -> i64 {
    let transaction = client.transaction().await.expect("begins");
    let made = revise::adopt(&transaction, building, robot, change).await.expect("adopts");
    transaction.commit().await.expect("commits");
    made
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
    assert_eq!(adopted(&mut client, 1, 1, &by("от робота 1")).await, 1);
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
    assert_eq!(revised(&mut client, 1, &corrected, &by("поправка")).await, 2);
    assert_eq!(revised(&mut client, 1, &corrected, &by("ещё раз")).await, 2);
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
    assert_eq!(revised(&mut client, 1, &both, &by("обе")).await, 3);
    let transaction = client.transaction().await.expect("begins");
    revise::insist(&transaction, 1, 2).await.expect("ok");
    transaction.commit().await.expect("commits");
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

/// `ortho-fleet push --pull`: what it says, and what it complains of.
fn pushed(centre: &Centre, key: &str, store: &Path) -> (String, String) {
    let ran = Command::new(env!("CARGO_BIN_EXE_ortho-fleet"))
        .args(["push", "--pull", "--to", &centre.url(), "--key", key, "--store"])
        .arg(store)
        .output()
        .expect("it runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (out, err) = (text(&ran.stdout), text(&ran.stderr));
    assert!(ran.status.success(), "{out}{err}");
    (out, err)
}

/// An id that the centre or a robot of the building has ever given is not given again: a robot would refuse the map.
#[tokio::test(flavor = "multi_thread")]
async fn what_is_new_at_the_centre_has_an_id_that_no_robot_of_the_building_knows() {
    let Some(postgres) = Postgres::start("-c fsync=off") else { return };
    let keys = furnish(&postgres.address(), &[(1, 1)]).await;
    let centre = Centre::start(&postgres.address());
    let pool = db::pool(&postgres.address(), 2).expect("an address");
    let mut client = pool.get().await.expect("connects");
    let dir = tempfile::tempdir().expect("a folder");
    let store = dir.path().join("store");
    let line = Line::new(&centre.url(), &keys[0], None).expect("loopback");
    live(&store, 0, 1, &home(), false);
    // The last thing of the robot came and went again, so its map as it is does not tell of it.
    let last = *world_of(&store).replicas.keys().next_back().expect("some");
    let (gone, by) = (ReplicaId(last.0 + 5), |reason: &str| {
        Change::new("оператор", Timestamp(1_860_000_000_000), reason)
    });
    edit(&store, |world| {
        let mut twin = world.replicas[&last].clone();
        (twin.id, twin.name) = (gone, "Гость".to_owned());
        world.replicas.insert(gone, twin);
    });
    edit(&store, |world| drop(world.replicas.remove(&gone)));
    line.push(&store).expect("it is taken");
    adopted(&mut client, 1, 1, &by("от робота")).await;
    let mut corrected = world_of(&store);
    let mut new = corrected.replicas[&last].clone();
    (new.id, new.name) = (ReplicaId(last.0 + 1), "Новая".to_owned());
    corrected.replicas.insert(new.id, new);
    let revision = revised(&mut client, 1, &corrected, &by("новая вещь")).await;
    let pulled = line.pull(&store).expect("the robot can take it");
    assert!(matches!(pulled, Pulled::Taken { .. }), "{pulled:?}");
    let here = world_of(&store);
    let new = here.replicas.values().find(|r| r.name == "Новая").expect("it came");
    assert!(new.id > gone, "{:?} was given by the robot", new.id);

    // The program that a robot runs beside its own takes maps too, when the store is free.
    let run = || pushed(&centre, &keys[0], &store);
    corrected = world_of(&store);
    move_thing(&mut corrected, "Новая", 2.0);
    let revision = revision + 1;
    assert_eq!(revised(&mut client, 1, &corrected, &by("сдвинута")).await, revision);
    let held = Store::open(&store).expect("opens");
    let (_, told) = run();
    assert!(told.contains("подождёт"), "{told}");
    drop(held);
    assert!(run().0.contains("Принята карта центра"));
    assert_eq!(world_of(&store), corrected);

    // An edit on the newest revision is worked in, one on an older is refused.
    let edit = |on: i64, tries: bool| revise::Edit {
        building: 1,
        on,
        text: "[[edit]]\nremove = \"Новая\"\n".to_owned(),
        format: orthoframe_map::Format::Toml,
        tries,
    };
    let transaction = client.transaction().await.expect("begins");
    let late = revise::edit(&transaction, &edit(revision - 1, false), &by("")).await;
    assert!(
        matches!(late, Err(FleetError::Moved { revision: now }) if now == revision),
        "{late:?}"
    );
    let tried = revise::edit(&transaction, &edit(revision, true), &by("")).await.expect("reads");
    assert_eq!((tried.revision, tried.differences.len()), (revision, 1), "{tried:?}");
    let done = revise::edit(&transaction, &edit(revision, false), &by("")).await.expect("reads");
    assert_eq!(done.revision, revision + 1);
    transaction.commit().await.expect("commits");
    assert!(matches!(line.pull(&store), Ok(Pulled::Taken { .. })));
    assert!(world_of(&store).replicas.values().all(|r| r.name != "Новая"));
}

/// The robots' own program, where the main crate was built before this one.
fn ortho() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_BIN_EXE_ortho-fleet")).parent().expect("it is in a folder");
    let program = folder.join("ortho");
    let is_there = program.exists();
    assert!(is_there || std::env::var_os("CI").is_none(), "build ortho first: cargo build");
    is_there.then_some(program)
}

/// `ortho serve` on a store.
struct Console(Child);

impl Console {
    fn start(program: &Path, store: &Path) -> Self {
        let mut child = Command::new(program)
            .args(["serve", "--port", "0", "--store"])
            .arg(store)
            .stdout(Stdio::piped())
            .spawn()
            .expect("it starts");
        let mut line = String::new();
        let out = child.stdout.take().expect("piped");
        BufReader::new(out).read_line(&mut line).expect("it tells its address");
        assert!(line.contains("http://"), "{line}");
        Self(child)
    }
}

impl Drop for Console {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A robot whose own program never lets go of its store takes a new map through that program; what it changed itself is kept.
#[tokio::test(flavor = "multi_thread")]
async fn a_running_console_takes_the_map_of_the_centre() {
    let (Some(postgres), Some(program)) = (Postgres::start("-c fsync=off"), ortho()) else {
        return;
    };
    let keys = furnish(&postgres.address(), &[(1, 1)]).await;
    let centre = Centre::start(&postgres.address());
    let pool = db::pool(&postgres.address(), 2).expect("an address");
    let mut client = pool.get().await.expect("connects");
    let dir = tempfile::tempdir().expect("a folder");
    let store = dir.path().join("store");
    let by = |reason: &str| Change::new("Диспетчер", Timestamp(1_860_000_000_000), reason);
    live(&store, 0, 1, &home(), false);
    let run = || pushed(&centre, &keys[0], &store);
    run();
    adopted(&mut client, 1, 1, &by("от робота")).await;
    let mut corrected = world_of(&store);
    let names: Vec<String> = corrected.replicas.values().map(|r| r.name.clone()).collect();
    move_thing(&mut corrected, &names[0], 3.0);
    assert_eq!(revised(&mut client, 1, &corrected, &by("поправка")).await, 2);

    let console = Console::start(&program, &store);
    let (told, _) = run();
    assert!(told.contains("Принята карта центра, ревизия 2"), "{told}");
    assert_eq!(world_of(&store), corrected);
    let last = |store: &Path| {
        let (store, _) = Store::open_read_only(store).expect("opens");
        store.revisions().expect("reads").pop().expect("some")
    };
    assert_eq!(last(&store).user, "Диспетчер");
    assert!(run().0.contains("Нового в центре нет"));
    let line = Line::new(&centre.url(), &keys[0], None).expect("loopback");
    line.push(&store).expect("it is taken");
    must_be_same(&pool, 1, 1, &store, false).await;
    // A note of who held it, left by a program that was killed, is no holder.
    drop(console);
    assert!(dir.path().join("store.held").exists(), "it was killed");
    move_thing(&mut corrected, &names[0], 3.0);
    assert_eq!(revised(&mut client, 1, &corrected, &by("ещё")).await, 3);
    let held = Store::open(&store).expect("opens");
    let (_, told) = run();
    assert!(told.contains("подождёт"), "{told}");
    drop(held);
    // What the robot changed itself while it is held is not merged.
    edit(&store, |world| {
        move_thing(world, &names[1], -5.0);
    });
    let mine = world_of(&store);
    let _console = Console::start(&program, &store);
    let pulled = line.pull(&store).expect("answers");
    assert!(matches!(pulled, Pulled::Apart(_)), "{pulled:?}");
    assert_eq!(world_of(&store), mine);
}
