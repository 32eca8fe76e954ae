//! A robot that lives at random in its own store, and whether the centre holds what that store holds.

use std::collections::BTreeMap;
use std::path::Path;

use deadpool_postgres::Pool;
use orthoframe_fleet::rows::{At, cell, place, quoted};
use orthoframe_map::{DoorState, DoorStatus, Replica, World};
use orthoframe_store::{
    Cell, Change, Changes, Key, Observation, Queue, QueuedTask, RevisionKind, RobotMemory, Row,
    Seen, Sheet, Store, Table,
};
use orthoframe_units::{Deg, Frame, Point, Pose, ReplicaId, Timestamp};

pub fn home() -> World {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../maps/rb2.toml");
    World::load(path).expect("a map of the project")
}

/// Lives on until the store has made so many transactions in all.
pub fn live_until(dir: &Path, transactions: u64, seed: u64, home: &World) {
    // What changes nothing is no transaction.
    for more in 0.. {
        let made = if dir.exists() { Store::open(dir).expect("opens").1.lsn } else { 0 };
        if made >= transactions {
            return;
        }
        live(dir, transactions - made, seed.wrapping_add(more), home, false);
    }
}

/// Lives on until the store has made so many transactions more. With `forgets` it sometimes drops some of its past.
pub fn live(dir: &Path, transactions: u64, seed: u64, home: &World, forgets: bool) {
    let (mut store, report) = Store::open(dir).expect("opens");
    let clock = Timestamp(1_800_000_000_000 + (report.lsn as i64) * 60_000);
    if store.revision() == 0 {
        let change = Change::new("Мастер", clock, "съёмка");
        store.import(home, &change).expect("imports");
    }
    let world = store.world().expect("reads").expect("a map");
    let mut life = Life { store, world, rng: fastrand::Rng::with_seed(seed), clock, forgets };
    for n in 0..transactions {
        life.clock.0 += life.rng.i64(1..90_000);
        life.step(n);
    }
}

struct Life {
    store: Store,
    /// What the store holds.
    world: World,
    rng: fastrand::Rng,
    clock: Timestamp,
    forgets: bool,
}

impl Life {
    fn step(&mut self, n: u64) {
        let now = self.clock;
        let who = ["Мастер", "оператор", "op"][self.rng.usize(..3)];
        let change = Change::new(who, now, format!("шаг {n}"));
        match self.rng.u32(..100) {
            0..50 => self.observe(),
            50..70 => self.remember(),
            70..85 => {
                let mut after = self.world.clone();
                alter(&mut after, &mut self.rng, n);
                self.store
                    .commit_changes(
                        &Changes::between(&self.world, &after).expect("no key twice"),
                        &change,
                    )
                    .expect("commits");
                self.world = after;
            }
            // The first map is never taken back.
            85..90 if self.last_is_edit() => {
                self.store.undo(&change).expect("undoes");
                self.world = self.store.world().expect("reads").expect("a map");
            }
            90..97 => {
                let count = self.rng.u32(..4);
                let rng = &mut self.rng;
                let task = |id| QueuedTask {
                    id,
                    text: format!("Принеси чашку {id}"),
                    by: "op".to_owned(),
                    at: Timestamp(now.0 - i64::from(id)),
                    from: None,
                    is_begun: rng.bool(),
                };
                let tasks = (0..count).map(task).collect();
                let paused = self.rng.bool().then_some(now);
                self.store.put_queue(&Queue { tasks, paused }, "op", now).expect("writes");
            }
            97 if self.forgets && self.store.revision() > 5 => {
                let revision = self.store.revision();
                self.store.forget_before(revision - 2, &change).expect("forgets");
            }
            _ => self.observe(),
        }
    }

    fn last_is_edit(&self) -> bool {
        let last = self.store.revisions().expect("reads").pop();
        last.is_some_and(|revision| revision.kind == RevisionKind::Edit)
    }

    fn observe(&mut self) {
        let rng = &mut self.rng;
        let all: Vec<_> = self.world.replicas.values().collect();
        let some: Vec<_> = (0..rng.usize(1..4)).map(|_| all[rng.usize(..all.len())]).collect();
        let look = |thing: &&Replica| Observation {
            replica: thing.id,
            at: self.clock,
            seen: rng.u32(..5).gt(&0).then(|| {
                let (x, y) = (thing.frame.x.get(), thing.frame.y.get());
                let (x, y) = (x + rng.f64() * 80.0 - 40.0, y + rng.f64() * 80.0 - 40.0);
                let frame = Frame::new(x, y, thing.frame.z.get(), Deg::of(rng.f64() * 360.0));
                Seen { area: thing.area, frame }
            }),
            sure: 0.3 + 0.6 * rng.f64(),
            observer: "лидар".to_owned(),
        };
        let seen: Vec<_> = some.iter().map(look).collect();
        self.store.observe(&seen).expect("writes");
    }

    fn remember(&mut self) {
        let (world, rng) = (&self.world, &mut self.rng);
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
        self.store.remember(&memory, &[], "robot", self.clock).expect("writes");
    }
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
    // What it proposes is kept beside, and is what beliefs and map say.
    let sql = "SELECT (SELECT count(*) FROM fleet.proposed WHERE building = $1 AND robot = $2), count(p.replica), count(*) \
               FROM fleet.disagreement d LEFT JOIN fleet.proposed p USING (building, robot, replica, sure) \
               WHERE building = $1 AND robot = $2";
    let row = client.query_one(sql, &[&building, &robot]).await.expect("reads");
    let [kept, same, all] = [0, 1, 2].map(|at| row.get::<_, i64>(at));
    assert_eq!([kept, same], [all; 2], "what {building}.{robot} proposes");
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
