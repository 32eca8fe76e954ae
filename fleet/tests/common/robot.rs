//! A robot that lives at random in its own store, and whether the centre holds what that store holds.

use std::collections::BTreeMap;
use std::path::Path;

use deadpool_postgres::Pool;
use orthoframe_fleet::rows::{At, cell, place, quoted};
use orthoframe_map::{DoorState, DoorStatus, World};
use orthoframe_store::{
    Cell, Change, Key, Observation, Queue, QueuedTask, RevisionKind, RobotMemory, Row, Seen, Sheet,
    Store, Table,
};
use orthoframe_units::{AreaId, Deg, Frame, Point, Pose, ReplicaId, Timestamp};

pub fn home() -> World {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../maps/rb2.toml");
    World::load(path).expect("a map of the project")
}

/// Lives on until the store has made so many transactions more. With `forgets` it sometimes drops some of its past.
pub fn live(dir: &Path, transactions: u64, seed: u64, home: &World, forgets: bool) {
    let mut rng = fastrand::Rng::with_seed(seed);
    let (mut store, report) = Store::open(dir).expect("opens");
    let mut clock = Timestamp(1_800_000_000_000 + (report.lsn as i64) * 60_000);
    if store.revision() == 0 {
        let change = Change::new("Мастер", clock, "съёмка");
        store.import(home, &change).expect("imports");
    }
    for n in 0..transactions {
        clock.0 += rng.i64(1..90_000);
        step(&mut store, &mut rng, clock, n, forgets);
    }
}

fn step(store: &mut Store, rng: &mut fastrand::Rng, now: Timestamp, n: u64, forgets: bool) {
    let change = Change::new(["Мастер", "оператор", "op"][rng.usize(..3)], now, format!("шаг {n}"));
    match rng.u32(..100) {
        0..50 => observe(store, rng, now),
        50..70 => remember(store, rng, now),
        70..85 => {
            let before = store.world().expect("reads").expect("a map");
            let mut after = before.clone();
            alter(&mut after, rng, n);
            store.commit_change(&before, &after, &change).expect("commits");
        }
        // The first map is never taken back.
        85..90 if last_is_edit(store) => drop(store.undo(&change).expect("undoes")),
        90..97 => {
            let count = rng.u32(..4);
            let task = |id| QueuedTask {
                id,
                text: format!("Принеси чашку {id}"),
                by: "op".to_owned(),
                at: Timestamp(now.0 - i64::from(id)),
                from: None,
                is_begun: rng.bool(),
            };
            let tasks = (0..count).map(task).collect();
            let paused = rng.bool().then_some(now);
            store.put_queue(&Queue { tasks, paused }, "op", now).expect("writes");
        }
        97 if forgets && store.revision() > 5 => {
            let revision = store.revision();
            store.forget_before(revision - 2, &change).expect("forgets");
        }
        _ => observe(store, rng, now),
    }
}

fn last_is_edit(store: &Store) -> bool {
    let last = store.revisions().expect("reads").pop();
    last.is_some_and(|revision| revision.kind == RevisionKind::Edit)
}

fn observe(store: &mut Store, rng: &mut fastrand::Rng, now: Timestamp) {
    let world_replicas =
        store.reader().records::<orthoframe_store::records::AreaObjects>(&Key::new());
    let all = world_replicas.expect("reads");
    let some: Vec<_> = (0..rng.usize(1..4)).map(|_| &all[rng.usize(..all.len())]).collect();
    let look = |r: &&orthoframe_store::records::AreaObjects| Observation {
        replica: ReplicaId(r.repl_id),
        at: now,
        seen: rng.u32(..5).gt(&0).then(|| {
            let (x, y) = (r.x + rng.f64() * 80.0 - 40.0, r.y + rng.f64() * 80.0 - 40.0);
            Seen {
                area: AreaId(r.area_id),
                frame: Frame::new(x, y, r.z, Deg::of(rng.f64() * 360.0)),
            }
        }),
        sure: 0.3 + 0.6 * rng.f64(),
        observer: "лидар".to_owned(),
    };
    let seen: Vec<_> = some.iter().map(look).collect();
    store.observe(&seen).expect("writes");
}

fn remember(store: &mut Store, rng: &mut fastrand::Rng, now: Timestamp) {
    let world = store.world().expect("reads").expect("a map");
    let map = *world.maps.keys().next().expect("some");
    let mut memory = RobotMemory::default();
    let at = Point::new(rng.f64() * 400.0, rng.f64() * 400.0);
    memory.pose = Some((map, Pose { at, heading: Deg::of(rng.f64() * 360.0) }));
    for door in world.doors.keys() {
        let opening = f64::from(rng.u32(..300));
        if opening > 100.0 {
            continue;
        }
        memory.doors.insert(*door, DoorState { status: DoorStatus::Open, opening });
    }
    for replica in world.replicas.keys().filter(|_| rng.u32(..20) == 0) {
        memory.carried.insert(*replica, String::new());
    }
    store.remember(&memory, &[], "robot", now).expect("writes");
}

fn alter(world: &mut World, rng: &mut fastrand::Rng, n: u64) {
    let ids: Vec<_> = world.replicas.keys().copied().collect();
    let id = ids[rng.usize(..ids.len())];
    match rng.u32(..10) {
        0 if ids.len() > 20 => drop(world.replicas.remove(&id)),
        1 => {
            let last = ids.last().expect("some").0;
            let new = ReplicaId(last + 1000 + n as u32);
            let mut twin = world.replicas[&id].clone();
            twin.id = new;
            twin.name = format!("Вещь-{n}\u{0}");
            world.replicas.insert(new, twin);
        }
        2 => {
            world.areas.values_mut().take(1).for_each(|area| area.description = format!("тихо {n}"))
        }
        3 => {
            world.doors.values_mut().take(2).for_each(|door| door.state.opening = (n % 100) as f64)
        }
        _ => {
            let replica = world.replicas.get_mut(&id).expect("it is there");
            let at = replica.frame;
            let (x, y) = (at.x.get() + rng.f64() - 0.5, at.y.get() + rng.f64() - 0.5);
            replica.frame = Frame::new(x, y, at.z.get(), at.angle);
        }
    }
}

type Told = Vec<String>;

fn told(row: &Row) -> String {
    let text = |cell: &Cell| match cell {
        Cell::Text(text) => format!("{:?}", Cell::Text(text.replace('\0', "\u{2400}"))),
        other => format!("{other:?}"),
    };
    row.iter().map(text).collect::<Vec<_>>().join(" ")
}

/// What a store holds, as sorted lines a table: the records that stand, with their stamps; and all versions of the map's.
fn of_store(dir: &Path) -> (BTreeMap<String, Told>, Sheet, u64) {
    let (store, report) = Store::open_read_only(dir).expect("opens");
    let reader = store.reader();
    let mut all = BTreeMap::new();
    let line = |table: Table, version: &orthoframe_store::Version| {
        let row = table.full(&version.row).expect("a record");
        let stamp = &version.stamp;
        format!("{} | {} {} {} {}", told(&row), stamp.at, stamp.user, stamp.revision, stamp.deleted)
    };
    for table in Table::ALL.iter().copied().filter(|t| t.is_stored()) {
        let versions = reader.versions(table, &Key::new()).expect("reads");
        let mut lines: Told = versions.iter().map(|(_, v)| line(table, v)).collect();
        lines.sort();
        all.insert(table.name().to_owned(), lines);
        if table.is_map() {
            let versions = reader.all_versions(table).expect("reads");
            let mut lines: Told = versions.iter().map(|v| line(table, v)).collect();
            lines.sort();
            all.insert(format!("{} with its past", table.name()), lines);
        }
    }
    let world = store.world().expect("reads").expect("a map");
    (all, Sheet::derived(&world).expect("derives"), report.lsn)
}

async fn of_centre(
    client: &deadpool_postgres::Object,
    building: i64,
    robot: i64,
    table: Table,
    condition: &str,
) -> Told {
    let names: Vec<_> = table.columns().iter().map(|c| quoted(c.name)).collect();
    let sql = format!(
        "SELECT {}, \"RecDate\", \"RecUser\", revision, \"Deleted\" FROM {} \
         WHERE building = $1 AND robot = $2 AND {condition}",
        names.join(", "),
        place(table)
    );
    let rows = client.query(&sql, &[&building, &robot]).await.expect("reads");
    let line = |row: &tokio_postgres::Row| {
        let cells = table.columns().iter().enumerate().map(|(at, c)| cell(row, at, c));
        let cells: Row = cells.collect::<Result<_, _>>().expect("its types");
        let at = names.len();
        let (when, user): (At, &str) = (row.get(at), row.get(at + 1));
        let (revision, deleted): (i64, bool) = (row.get(at + 2), row.get(at + 3));
        format!("{} | {} {user} {revision} {deleted}", told(&cells), Timestamp(when.0))
    };
    let mut lines: Told = rows.iter().map(line).collect();
    lines.sort();
    lines
}

/// The centre's tables of a robot are its store's, record by record. A robot that forgets may have less of a past.
pub async fn must_be_same(pool: &Pool, building: i64, robot: i64, dir: &Path, forgets: bool) {
    let (theirs, derived, lsn) = of_store(dir);
    let client = pool.get().await.expect("connects");
    let at = client
        .query_one(
            "SELECT sequence FROM fleet.robot WHERE building = $1 AND robot = $2",
            &[&building, &robot],
        )
        .await
        .expect("a robot");
    assert_eq!(at.get::<_, i64>(0), lsn as i64, "the journal of {building}.{robot}");
    for table in Table::ALL.iter().copied().filter(|t| t.is_stored()) {
        let name = table.name();
        let stands = if table.is_map() { "revision_to IS NULL AND" } else { "" };
        let condition = format!("{stands} NOT \"Deleted\"");
        let here = of_centre(&client, building, robot, table, &condition).await;
        assert_eq!(here, theirs[name], "{name} of {building}.{robot}");
        if table.is_map() {
            let here = of_centre(&client, building, robot, table, "true").await;
            let past = &theirs[&format!("{name} with its past")];
            if forgets {
                let missing: Vec<_> =
                    past.iter().filter(|l| here.binary_search(l).is_err()).collect();
                assert!(missing.is_empty(), "{name} of {building}.{robot}: {missing:?}");
            } else {
                assert_eq!(&here, past, "{name} of {building}.{robot}, with its past");
            }
        }
    }
    for table in Table::ALL.iter().copied().filter(|t| !t.is_stored()) {
        let names: Vec<_> = table.columns().iter().map(|c| quoted(c.name)).collect();
        let sql = format!(
            "SELECT {} FROM {} WHERE building = $1 AND robot = $2",
            names.join(", "),
            place(table)
        );
        let rows = client.query(&sql, &[&building, &robot]).await.expect("reads");
        // Computed there by another program: the last bits of a turned point may differ.
        let rounded = |row: &Row| {
            let round = |cell: &Cell| match cell {
                Cell::Real(x) => format!("{:.5}", (x * 1e5).round() / 1e5 + 0.0),
                other => format!("{other:?}"),
            };
            row.iter().map(round).collect::<Vec<_>>().join(" ")
        };
        let line = |row: &tokio_postgres::Row| {
            let cells = table.columns().iter().enumerate().map(|(at, c)| cell(row, at, c));
            rounded(&cells.collect::<Result<_, _>>().expect("its types"))
        };
        let mut here: Told = rows.iter().map(line).collect();
        let mut theirs: Told = derived.rows(table).map(|(_, row)| rounded(row)).collect();
        here.sort();
        theirs.sort();
        assert_eq!(here, theirs, "{} of {building}.{robot}", table.name());
    }
}
