//! What workers derive is what each robot's own engine derives, of every revision; and questions over all buildings.

mod common;

use std::collections::BTreeSet;
use std::process::Command;

use common::robot::{home, live};
use common::{Centre, Postgres, furnish};
use deadpool_postgres::Object;
use orthoframe_fleet::derive::{Fact, facts};
use orthoframe_fleet::push::Line;
use orthoframe_fleet::query::Question;
use orthoframe_fleet::{FleetError, db, keys};
use orthoframe_map::World;
use orthoframe_semantics::RelationRules;
use orthoframe_store::{Change, Observation, Seen, Store, Timestamp};
use orthoframe_units::{Frame, ReplicaId};

fn work(postgres: &Postgres, workers: usize) {
    let started: Vec<_> = (0..workers)
        .map(|_| {
            Command::new(env!("CARGO_BIN_EXE_ortho-fleet"))
                .args(["work", "--once", "--db", &postgres.address()])
                .spawn()
                .expect("it starts")
        })
        .collect();
    for mut worker in started {
        assert!(worker.wait().expect("it ran").success());
    }
}

async fn facts_at(client: &Object, building: i64, robot: i64, revision: i64) -> BTreeSet<Fact> {
    let sql = "SELECT relation, subject, object FROM fleet.fact WHERE building = $1 AND robot = $2 \
               AND revision <= $3 AND (revision_to IS NULL OR revision_to > $3)";
    let rows = client.query(sql, &[&building, &robot, &revision]).await.expect("reads");
    rows.iter().map(|row| (row.get(0), row.get(1), row.get(2))).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn what_workers_derive_is_what_follows_from_each_revision() {
    let Some(postgres) = Postgres::start("-c fsync=off") else { return };
    let all: Vec<(i64, i64)> = vec![(1, 1), (1, 2), (2, 3), (3, 4)];
    let made = furnish(&postgres.address(), &all).await;
    let centre = Centre::start(&postgres.address());
    let (dir, home) = (tempfile::tempdir().expect("a folder"), home());
    let line = |n: usize| Line::new(&centre.url(), &made[n], None).expect("loopback");
    let store = |n: usize| dir.path().join(n.to_string());
    for round in 0..2 {
        for n in 0..all.len() {
            live(&store(n), 30, (n * 2 + round) as u64, &home, false);
            line(n).push(&store(n)).expect("it is taken");
        }
        work(&postgres, 2);
    }
    let client =
        db::pool(&postgres.address(), 1).expect("an address").get().await.expect("connects");
    let waiting: i64 =
        client.query_one("SELECT count(*) FROM fleet.work", &[]).await.expect("reads").get(0);
    assert_eq!(waiting, 0);
    let rules = RelationRules::standard();
    for (n, (building, robot)) in all.iter().enumerate() {
        let (opened, _) = Store::open_read_only(store(n)).expect("opens");
        let mut before = BTreeSet::new();
        for revision in 1..=opened.revision() {
            let world = opened.world_as_of(revision).expect("reads").expect("a map");
            let own = facts(&world, &rules).expect("derives");
            let there = facts_at(&client, *building, *robot, revision as i64).await;
            assert_eq!(there, own, "revision {revision} of {building}.{robot}");
            before = own;
        }
        assert!(before.iter().any(|fact| fact.0 == "ON_TOP_OF"), "something stands on something");
    }
}

/// The flat with its chairs as wheelchairs; with `laden`, something lies on every one of them.
fn clinic(wheelchairs: bool, laden: bool) -> World {
    let mut world = home();
    if wheelchairs {
        let chair = world.objects.values().find(|o| o.name == "Стул").expect("a chair").id;
        let object = world.objects.get_mut(&chair).expect("it is there");
        object.name = "Кресло-каталка".to_owned();
        object.name_en = "Wheelchair".to_owned();
        let chairs: Vec<_> =
            world.replicas.values().filter(|r| r.object == chair).cloned().collect();
        for (n, replica) in chairs.iter().enumerate() {
            let renamed = world.replicas.get_mut(&replica.id).expect("it is there");
            renamed.name = format!("Кресло-каталка-{}", n + 1);
            renamed.name_en = format!("Wheelchair {}", n + 1);
        }
        if laden {
            let book = world.replicas.values().find(|r| r.name.starts_with("Книга")).expect("one");
            let book = book.clone();
            let last = world.replicas.keys().next_back().expect("some").0;
            let rules = RelationRules::standard();
            let seats: Vec<f64> = (30..60).map(f64::from).collect();
            for (id, chair) in (last + 1..).zip(chairs) {
                // The height of the seat is found by trying: what lies on it is on it by the rules.
                let lies = seats.iter().any(|z| {
                    let mut tried = world.clone();
                    let mut twin = book.clone();
                    (twin.id, twin.name) = (ReplicaId(id), format!("Книга-на-{}", chair.id.0));
                    twin.area = chair.area;
                    let at = chair.frame;
                    let middle = at.apply(orthoframe_units::Point::new(12.0, 12.0));
                    twin.frame = Frame::new(middle.x, middle.y, at.z.get() + z, at.angle);
                    let name = twin.name.clone();
                    tried.replicas.insert(twin.id, twin);
                    let found = facts(&tried, &rules).expect("derives");
                    let is_on = found
                        .iter()
                        .any(|f| f.0 == "ON_TOP_OF" && f.1 == name && f.2.starts_with("Кресло"));
                    if is_on {
                        world = tried;
                    }
                    is_on
                });
                assert!(lies, "a seat is found");
            }
        }
    }
    world
}

#[tokio::test(flavor = "multi_thread")]
async fn questions_over_all_buildings() {
    let Some(postgres) = Postgres::start("-c fsync=off") else { return };
    let all = [(1, 1), (2, 1), (3, 1)];
    let made = furnish(&postgres.address(), &all).await;
    let admin = db::connect(&postgres.address()).await.expect("connects");
    let of_all = keys::add_operator(&admin, None, "диспетчер").await.expect("new");
    let of_two = keys::add_operator(&admin, Some(2), "завхоз").await.expect("new");
    let centre = Centre::start(&postgres.address());
    let dir = tempfile::tempdir().expect("a folder");
    let now = orthoframe_fleet::handout::now();
    for (n, world) in
        [clinic(true, false), clinic(true, true), clinic(false, false)].iter().enumerate()
    {
        let path = dir.path().join(n.to_string());
        let (mut store, _) = Store::open(&path).expect("opens");
        store.import(world, &Change::new("Мастер", now, "съёмка")).expect("imports");
        let cup = world.replicas.values().find(|r| r.name == "Чашка-1").expect("a cup");
        let at = cup.frame;
        let frame = Frame::new(at.x.get() + 60.0 * n as f64, at.y.get(), at.z.get(), at.angle);
        let seen = Observation {
            replica: cup.id,
            at: Timestamp(now.0 + n as i64 * 1000),
            seen: Some(Seen { area: cup.area, frame }),
            sure: 0.95,
            observer: "лидар".to_owned(),
        };
        store.observe(&[seen]).expect("writes");
        drop(store);
        Line::new(&centre.url(), &made[n], None).expect("loopback").push(&path).expect("taken");
    }
    work(&postgres, 2);
    let line = |key: &str| Line::new(&centre.url(), key, None).expect("loopback");
    let dispatcher = line(&of_all);
    for question in [
        "В каких корпусах есть свободные кресла-каталки?",
        "in which buildings are there free wheelchairs",
    ] {
        let answer = dispatcher.ask(question).expect("is understood");
        assert!(
            answer.text.starts_with("Корпус-1: ") && !answer.text.contains("Корпус-2"),
            "{}",
            answer.text
        );
        assert!(answer.text.contains("Кресло-каталка-1"), "{}", answer.text);
        // The rule that is shown is the rule that ran.
        let rule = answer.rule.expect("a rule");
        assert_eq!(dispatcher.query(&rule).expect("runs").rows, answer.table.rows);
    }
    let any = dispatcher.ask("В каких зданиях есть кресла-каталки?").expect("is understood").text;
    assert!(
        any.contains("Корпус-1: ") && any.contains("Корпус-2: ") && !any.contains("Корпус-3"),
        "{any}"
    );
    let own =
        line(&of_two).ask("В каких зданиях есть кресла-каталки?").expect("is understood").text;
    assert!(own.starts_with("Корпус-2: ") && !own.contains("Корпус-1"), "{own}");
    let seen = dispatcher.ask("Какой робот последним видел Чашку-1?").expect("is understood");
    assert_eq!(seen.table.rows.len(), 3, "{}", seen.text);
    assert!(seen.text.starts_with("Корпус-3: Чашка-1 – robot 3.1"), "{}", seen.text);
    let changed = dispatcher.ask("Что изменилось за неделю?").expect("is understood");
    assert_eq!(changed.table.rows.len(), 3, "{}", changed.text);
    let apart = dispatcher.ask("Где карты и представления расходятся больше всего?").expect("ok");
    assert_eq!(apart.table.rows.len(), 2, "60 and 120 cm are apart, 0 is not: {}", apart.text);
    // Not understood, and not known, are told apart; a robot's key asks nothing.
    for strange in
        ["В каких корпусах живут медведи?", "есть", "", "'; DROP SCHEMA fleet CASCADE; --"]
    {
        let told = dispatcher.ask(strange);
        assert!(
            matches!(&told, Err(FleetError::Content { what })
                if ["не понят", "not understood"].iter().any(|part| what.to_string().contains(part))),
            "{strange}: {told:?}"
        );
    }
    let told = dispatcher.ask("В каких корпусах есть свободные медведи?");
    assert!(
        matches!(&told, Err(FleetError::Content { what }) if what.to_string().contains("медведи")),
        "{told:?}"
    );
    assert!(matches!(line(&made[0]).ask("Что изменилось за неделю?"), Err(FleetError::Forbidden)));

    // The same answers as by going through all facts.
    let client =
        db::pool(&postgres.address(), 1).expect("an address").get().await.expect("connects");
    let mut expected = BTreeSet::new();
    for (building, robot) in all {
        let there = facts_at(&client, building, robot, i64::MAX).await;
        for (_, cup, table) in there.iter().filter(|f| f.0 == "ON_TOP_OF") {
            let is =
                |name: &str, kind: &str| there.contains(&("IS_A".into(), name.into(), kind.into()));
            if is(table, "Стол") && !is(cup, "Книга") {
                expected.insert(vec![
                    building.to_string(),
                    robot.to_string(),
                    cup.clone(),
                    table.clone(),
                ]);
            }
        }
    }
    let found = dispatcher
        .query("?- ON_TOP_OF(X, Y), IS_A(Y, \"Стол\"), !IS_A(X, \"Книга\"), X != Y.")
        .expect("runs");
    assert!(!expected.is_empty());
    assert_eq!(found.rows.into_iter().collect::<BTreeSet<_>>(), expected);
    for wrong in [
        "",
        "?-",
        "ON_TOP_OF(X",
        "!ON_TOP_OF(X, Y)",
        "ON_TOP_OF(X, Y), Z = Y",
        "R(A, B, C)",
        "R(X, \"a\"); R(X)",
    ] {
        assert!(Question::parse(wrong).and_then(|q| q.to_sql()).is_err(), "{wrong}");
    }
    // The page and what is behind it.
    for path in ["/v1/fleet", "/v1/building?building=1&robot=1"] {
        let body = dispatcher.get(path).expect("answers");
        assert!(body.len() > 200, "{path}");
        assert!(matches!(line(&made[0]).get(path), Err(FleetError::Forbidden)), "{path}");
    }
    let other = line(&of_two).get("/v1/building?building=1&robot=1");
    assert!(matches!(other, Err(FleetError::Unknown { .. })), "another building is not there");
    let page = String::from_utf8(dispatcher.get("/").expect("answers")).expect("a text");
    assert!(page.contains("Парк роботов"));
    let told = String::from_utf8(dispatcher.get("/v1/fleet").expect("answers")).expect("a text");
    for wanted in ["Корпус-1", "robot 3.1", "Чашка-1", "\"here\""] {
        assert!(told.contains(wanted), "{wanted} in {told}");
    }
}
