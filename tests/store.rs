//! The store as its callers see it: import, history, durability, refusals.

use std::path::Path;
use std::process::Command;

use orthoframe::map::{DoorKind, DoorState, Replica, World};
use orthoframe::store::{
    Cell, Change, Counts, Edits, Key, Observation, Seen, Severity, Sheet, Store, StoreError, Table,
    Timestamp, compare, fsck, records,
};
use orthoframe::units::{AreaId, Cm, Deg, Frame, MapId, Point, Pose, ReplicaId};
use proptest::prelude::*;

use crate::store_world::{Dice, replica, world};

fn change(reason: &str) -> Change {
    Change::new("Мастер", Timestamp(1_790_000_000_000), reason)
}

fn scratch() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary directory")
}

fn open(dir: &Path) -> Store {
    Store::open(dir).expect("the store opens").0
}

fn load(store: &Store) -> World {
    store.world().expect("the map is whole").expect("there is a map")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn a_world_comes_back_from_its_records(seed: u64, size in 0..20u32) {
        let world = world(seed, size);
        let back = Sheet::of(&world).unwrap().world().unwrap().unwrap();
        // Debug tells what == does not: -0.0 from 0.0.
        prop_assert_eq!(format!("{back:?}"), format!("{world:?}"));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn a_world_comes_back_from_the_disk(seed: u64, next: u64) {
        let dir = scratch();
        let (first, second) = (world(seed, 12), world(next, 8));
        open(dir.path()).import(&first, &change("первая")).unwrap();
        prop_assert_eq!(&load(&open(dir.path())), &first);
        let mut store = open(dir.path());
        prop_assert_eq!(store.import(&first, &change("та же")).unwrap().counts, Counts::default());
        store.import(&second, &change("вторая")).unwrap();
        prop_assert_eq!(store.revision(), 2);
        prop_assert_eq!(store.world_as_of(1).unwrap().unwrap(), first);
        prop_assert_eq!(store.world_as_of(0).unwrap(), None);
        // Under other ids it is the second world: everything has its name.
        let names = |w: &World| {
            let mut names: Vec<_> = w.replicas.values().map(|r| format!("{} {:?}", r.name, r.frame)).collect();
            names.sort();
            names
        };
        prop_assert_eq!(names(&load(&store)), names(&second));
        // And the same once more changes nothing.
        prop_assert_eq!(store.import(&second, &change("та же")).unwrap().counts, Counts::default());
    }
}

#[test]
fn names_keep_their_ids_and_ids_are_never_given_twice() {
    let dir = scratch();
    let mut store = open(dir.path());
    let mut map = world(7, 4);
    store.import(&map, &change("первая")).unwrap();
    let (_, gone) = map.replicas.pop_last().unwrap();
    store.import(&map, &change("одной вещи нет")).unwrap();
    // A file numbers its replicas anew, and in another order.
    let mut dice = Dice::new(1);
    let mut fresh = replica(&mut dice, 90, &map);
    fresh.name = "Новая".into();
    fresh.id = ReplicaId(1);
    let old = std::mem::take(&mut map.replicas);
    map.replicas.insert(fresh.id, fresh);
    for (n, mut r) in (2..).zip(old.into_values().rev()) {
        r.id = ReplicaId(n);
        map.replicas.insert(r.id, r);
    }
    map.places.clear();
    map.robot.start = None;
    store.import(&map, &change("и новая")).unwrap();
    let now = load(&store);
    let id_of = |name: &str| now.replicas.values().find(|r| r.name == name).unwrap().id;
    assert_eq!(
        (id_of("Вещь-0"), id_of("Вещь-1"), id_of("Вещь-2")),
        (ReplicaId(1), ReplicaId(3), ReplicaId(5))
    );
    assert_eq!(id_of("Новая"), ReplicaId(gone.id.0 + 1));
    assert_eq!(store.next_id(Table::AreaObjects).unwrap(), gone.id.0 + 2);
    // What comes back under its old name is what it was.
    let mut returned = gone.clone();
    returned.id = ReplicaId(77);
    map.replicas.insert(returned.id, returned);
    store.import(&map, &change("вернулась")).unwrap();
    assert_eq!(load(&store).replicas[&gone.id].name, gone.name);
}

#[test]
fn every_version_of_a_record_is_kept_with_its_author() {
    let dir = scratch();
    let mut store = open(dir.path());
    let mut map = world(3, 3);
    store.import(&map, &change("первая")).unwrap();
    let id = *map.replicas.keys().next().unwrap();
    let (area, object) = (map.replicas[&id].area, map.replicas[&id].object);
    for n in 1..=3 {
        map.replicas.get_mut(&id).unwrap().frame = Frame::new(f64::from(n), 0.0, 0.0, Deg::ZERO);
        let change = Change::new(format!("Автор-{n}"), Timestamp(i64::from(n)), "подвинул");
        let report = store.commit(&map, &change).unwrap();
        assert_eq!((report.counts.changed, report.counts.total()), (1, 1));
    }
    map.replicas.remove(&id);
    map.places.clear();
    map.robot.start = None;
    store.commit(&map, &change("унёс")).unwrap();
    drop(store);

    let store = open(dir.path());
    let key = Key::new().id(area.0).id(object.0).id(id.0);
    let versions = store.history(Table::AreaObjects, &key).unwrap();
    let told: Vec<_> = versions
        .iter()
        .map(|v| (v.stamp.revision, v.stamp.user.as_str(), v.stamp.deleted))
        .collect();
    assert_eq!(
        told,
        [
            (1, "Мастер", false),
            (2, "Автор-1", false),
            (3, "Автор-2", false),
            (4, "Автор-3", false),
            (5, "Мастер", true)
        ]
    );
    assert_eq!(store.world_as_of(3).unwrap().unwrap().replicas[&id].frame.x, Cm::of(2.0));
    assert_eq!(store.revision_at(Timestamp(2)).unwrap(), 3);
    let reasons: Vec<_> = store.revisions().unwrap().into_iter().map(|r| r.reason).collect();
    assert_eq!(reasons, ["первая", "подвинул", "подвинул", "подвинул", "унёс"]);
    assert!(matches!(
        store.world_as_of(6),
        Err(StoreError::UnknownRevision { wanted: 6, last: 5 })
    ));
}

#[test]
fn an_id_of_the_past_is_refused_to_another_thing() {
    let dir = scratch();
    let mut store = open(dir.path());
    let map = world(11, 1);
    store.import(&map, &change("первая")).unwrap();
    let mut less = map.clone();
    let mut object = less.objects.pop_last().unwrap().1;
    less.replicas.clear();
    less.places.clear();
    less.robot.start = None;
    store.commit(&less, &change("вещи нет")).unwrap();
    object.key = "другая".into();
    less.objects.insert(object.id, object);
    let refused = store.commit(&less, &change("под старым номером")).unwrap_err();
    assert!(matches!(refused, StoreError::IdReused { table: "Object", .. }), "{refused}");
    assert_eq!(store.revision(), 2);
}

#[test]
fn a_fragment_is_found_by_its_area_alone() {
    let dir = scratch();
    let mut store = open(dir.path());
    let map = world(5, 40);
    store.import(&map, &change("первая")).unwrap();
    for area in map.areas.keys() {
        let expected: Vec<_> = map.replicas_in(*area).cloned().collect();
        assert_eq!(store.fragment(*area).unwrap(), expected);
    }
    assert_eq!(store.fragment(AreaId(999)).unwrap(), []);
    let reader = store.reader();
    let maps = reader.maps_of(map.domain.id).unwrap();
    assert_eq!(maps, map.maps.keys().copied().collect::<Vec<_>>());
    let areas: usize = maps.iter().map(|m| reader.areas_of(*m).unwrap().len()).sum();
    assert_eq!(areas, map.areas.len());
}

#[test]
fn a_reader_keeps_its_revision_while_the_writer_goes_on() {
    let dir = scratch();
    let mut store = open(dir.path());
    let first = world(21, 10);
    store.import(&first, &change("первая")).unwrap();
    let reader = store.reader();
    let watching = std::thread::spawn(move || {
        (0..30).all(|_| reader.world().unwrap().as_ref() == Some(&first))
    });
    for seed in 22..32 {
        store.import(&world(seed, 10), &change("следующая")).unwrap();
    }
    assert!(watching.join().unwrap());
}

/// Each revision writes all replicas with its own number as their place: a reader that sees two numbers saw half of
/// a transaction.
#[test]
fn many_readers_see_one_revision_each_while_one_writes() {
    const REPLICAS: u32 = 300;
    const REVISIONS: u64 = 120;
    let dir = scratch();
    let mut store = open(dir.path());
    let write = |store: &mut Store| {
        let number = store.revision() + 1;
        let edits = (0..REPLICAS).fold(Edits::new(), |edits, n| {
            let (area_id, x) = (n % 7, number as f64);
            edits.put(&records::AreaObjects { area_id, repl_id: n, x, ..Default::default() })
        });
        store.apply(&edits, &change("ещё")).unwrap();
    };
    write(&mut store);
    let latest = std::sync::Mutex::new(store.reader());
    let is_done = std::sync::atomic::AtomicBool::new(false);
    let look = |reader: &orthoframe::store::Reader| {
        let all: Vec<records::AreaObjects> = reader.records(&Key::new()).unwrap();
        assert_eq!(all.len(), REPLICAS as usize);
        let own = reader.revision() as f64;
        let astray = all.iter().find(|r| (r.x - own).abs() > 0.0);
        assert!(astray.is_none(), "revision {own}: {astray:?}");
    };
    let seen: Vec<u64> = std::thread::scope(|scope| {
        let readers: Vec<_> = (0..4)
            .map(|_| {
                scope.spawn(|| {
                    let mut seen = Vec::new();
                    while !is_done.load(std::sync::atomic::Ordering::Acquire) {
                        let reader = latest.lock().unwrap().clone();
                        look(&reader);
                        // The same one again, when the writer has gone on.
                        std::thread::yield_now();
                        look(&reader);
                        seen.push(reader.revision());
                    }
                    seen
                })
            })
            .collect();
        for _ in 1..REVISIONS {
            write(&mut store);
            *latest.lock().unwrap() = store.reader();
        }
        is_done.store(true, std::sync::atomic::Ordering::Release);
        readers.into_iter().flat_map(|r| r.join().unwrap()).collect()
    });
    let different: std::collections::BTreeSet<u64> = seen.iter().copied().collect();
    assert!(different.len() > 5, "the readers read while the writer wrote: {different:?}");
    assert_eq!(store.revision(), REVISIONS);
}

#[test]
fn derived_tables_are_computed_and_cannot_be_edited() {
    let map = world(9, 6);
    let sheet = Sheet::derived(&map).unwrap();
    let sides: Vec<records::AreaObjectSides> = sheet.all().unwrap();
    let expected: usize = map
        .replicas
        .values()
        .flat_map(|r| &map.objects[&r.object].items)
        .map(|i| map.orthoframe_of(i).base.len())
        .sum();
    assert_eq!(sides.len(), expected);
    // One of them against the arithmetic done by hand.
    let side = &sides[0];
    let r = &map.replicas[&ReplicaId(side.repl_id)];
    let item = map.objects[&r.object].item(&side.item_id).unwrap();
    let vector = map.orthoframe_of(item).side(&side.side_id).unwrap().1;
    let at = r.frame.apply(item.frame.apply(vector.start));
    assert!((Point::new(side.x1, side.y1) - at).norm() < 1e-6);

    let dir = scratch();
    let refused = open(dir.path()).apply(&Edits::new().put(side), &change("вручную"));
    assert!(matches!(refused, Err(StoreError::DerivedTable { table: "AreaObjectSides" })));
}

#[test]
fn a_second_program_is_told_that_the_store_is_taken() {
    let dir = scratch();
    let store = open(dir.path());
    let Err(refused) = Store::open(dir.path()) else { panic!("opened twice") };
    assert!(matches!(refused, StoreError::Locked { .. }));
    assert!(refused.to_string().contains(&dir.path().display().to_string()));
    drop(store);
    open(dir.path());
}

#[test]
fn a_store_can_be_read_while_another_writes_it() {
    let dir = scratch();
    let mut store = open(dir.path());
    let map = world(4, 5);
    store.import(&map, &change("первая")).unwrap();
    let (mut other, _) = Store::open_read_only(dir.path()).unwrap();
    assert_eq!(load(&other), map);
    let refused = other.import(&world(5, 5), &change("вторая")).unwrap_err();
    assert!(matches!(refused, StoreError::ReadOnly { .. }));
    let missing = Store::open_read_only(dir.path().join("нет"));
    assert!(matches!(missing, Err(StoreError::Missing { .. })));
}

#[test]
fn what_is_no_store_is_left_alone() {
    let dir = scratch();
    std::fs::write(dir.path().join("письмо.txt"), "важное").unwrap();
    assert!(matches!(Store::open(dir.path()), Err(StoreError::NotAStore { .. })));
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1);

    let dir = scratch();
    drop(open(dir.path()));
    std::fs::write(dir.path().join("FORMAT"), "orthoframe store, format 9\n".repeat(2)).unwrap();
    let Err(refused) = Store::open(dir.path()) else { panic!("an unknown format was opened") };
    assert!(matches!(&refused, StoreError::UnknownFormat { found, known: 1, .. } if found == "9"));
}

#[test]
fn a_refused_import_changes_nothing() {
    let dir = scratch();
    let mut store = open(dir.path());
    let map = world(13, 5);
    store.import(&map, &change("первая")).unwrap();
    let mut twins = map.clone();
    for r in twins.replicas.values_mut() {
        r.name = "Близнец".into();
    }
    let refused = store.import(&twins, &change("близнецы")).unwrap_err();
    assert!(matches!(refused, StoreError::DuplicateName { table: "AreaObjects", .. }));
    assert_eq!((store.revision(), load(&store)), (1, map));
}

/// The papers' world: what is imported twice is imported once, what is read back is what was read.
#[test]
fn the_map_of_the_papers_goes_in_and_comes_out() {
    let dir = scratch();
    let mut store = open(dir.path());
    let map = World::load("maps/rb2.toml").expect("the map of the papers is sound");
    let first = store.import(&map, &change("первая")).unwrap();
    assert_eq!((load(&store), first.revision), (map.clone(), 1));
    assert_eq!(first.by_table[&Table::AreaObjects].created as usize, map.replicas.len());
    let again = store.import(&map, &change("та же")).unwrap();
    assert_eq!((again.revision, again.counts), (1, Counts::default()));
}

/// The journal alone brings everything back: sled is an index.
#[test]
fn the_tables_are_built_anew_from_the_journal() {
    let dir = scratch();
    let map = world(17, 9);
    open(dir.path()).import(&map, &change("первая")).unwrap();
    std::fs::remove_dir_all(dir.path().join("sled")).unwrap();
    let (store, report) = Store::open(dir.path()).unwrap();
    assert_eq!((report.replayed, load(&store)), (1, map.clone()));
    drop(store);
    for entry in std::fs::read_dir(dir.path().join("sled")).unwrap() {
        let path = entry.unwrap().path();
        if path.is_file() {
            std::fs::write(path, [0x5A; 5000]).unwrap();
        }
    }
    let (store, report) = Store::open(dir.path()).unwrap();
    assert!(report.tables_rebuilt.is_some());
    assert_eq!(load(&store), map);
}

#[test]
fn a_torn_tail_is_cut_and_said() {
    let dir = scratch();
    let map = world(19, 6);
    open(dir.path()).import(&map, &change("первая")).unwrap();
    let journal =
        std::fs::read_dir(dir.path().join("journal")).unwrap().next().unwrap().unwrap().path();
    let mut bytes = std::fs::read(&journal).unwrap();
    bytes.extend_from_slice(b"OFJ\x01half of a fra");
    std::fs::write(&journal, &bytes).unwrap();
    let (mut store, report) = Store::open(dir.path()).unwrap();
    assert_eq!((report.torn_bytes, load(&store)), (17, map));
    store.import(&world(20, 6), &change("дальше")).unwrap();
    drop(store);
    let (store, report) = Store::open(dir.path()).unwrap();
    assert_eq!((report.torn_bytes, store.revision()), (0, 2));
}

#[test]
fn a_broken_frame_before_a_good_one_is_corruption() {
    let dir = scratch();
    let mut store = open(dir.path());
    for seed in 0..3 {
        store.import(&world(seed, 5), &change("ещё")).unwrap();
    }
    let map = load(&store);
    drop(store);
    let journal =
        std::fs::read_dir(dir.path().join("journal")).unwrap().next().unwrap().unwrap().path();
    let mut bytes = std::fs::read(&journal).unwrap();
    bytes[300] ^= 4;
    std::fs::write(&journal, &bytes).unwrap();
    // The tables are whole: they give a new snapshot and journal.
    let (store, report) = Store::open(dir.path()).unwrap();
    assert!(report.journal_renewed.is_some());
    assert_eq!(load(&store), map);
    drop(store);
    assert_eq!(load(&open(dir.path())), map);
    // Now both are broken.
    let broken = scratch();
    let status = Command::new("cp").arg("-r").arg(dir.path()).arg(broken.path().join("s")).status();
    assert!(status.unwrap().success());
    let broken = broken.path().join("s");
    std::fs::remove_dir_all(broken.join("sled")).unwrap();
    std::fs::remove_dir_all(broken.join("snapshots")).unwrap();
    let Err(refused) = Store::open(&broken) else { panic!("a store beyond repair was opened") };
    assert!(matches!(refused, StoreError::BothCorrupt { .. }), "{refused}");
}

const HOUR: i64 = 3_600_000;

fn at(hours: i64) -> Timestamp {
    Timestamp(1_790_000_000_000 + hours * HOUR)
}

fn look(replica: &Replica, hours: i64, seen: Option<Seen>, sure: f64) -> Observation {
    Observation { replica: replica.id, at: at(hours), seen, sure, observer: "робот".into() }
}

/// A chair that may move, and a place far from where it was surveyed.
fn chair(store: &mut Store) -> (Replica, Seen) {
    let mut map = world(31, 3);
    let chair = map.replicas.values_mut().next().unwrap();
    chair.move_prob = 50;
    let elsewhere = Seen { area: chair.area, frame: Frame::new(5000.0, 0.0, 0.0, Deg::ZERO) };
    let chair = chair.clone();
    store.import(&map, &change("первая")).unwrap();
    (chair, elsewhere)
}

#[test]
fn what_the_robot_sees_is_believed_but_leaves_the_map_alone() {
    let dir = scratch();
    let mut store = open(dir.path());
    let (chair, elsewhere) = chair(&mut store);
    let before = load(&store);
    let belief = |store: &Store, hours| store.reader().belief(&chair, at(hours)).unwrap();
    assert!(belief(&store, 0).confidence > 0.999_999);
    assert!(belief(&store, 1000).confidence < 0.1);

    store.observe(&[look(&chair, 10, None, 0.5), look(&chair, 20, Some(elsewhere), 0.9)]).unwrap();
    assert!(belief(&store, 11).confidence < 0.5);
    let now = belief(&store, 20);
    assert_eq!((now.place, now.confidence, now.is_surveyed), (elsewhere, 0.9, false));
    assert_eq!((now.since, now.last_seen), (at(20), Some(at(20))));
    // Where was it before that?
    assert!(belief(&store, 15).is_surveyed);
    // Seen there again, it is surer, and has been there since the first time.
    store.observe(&[look(&chair, 21, Some(elsewhere), 0.9)]).unwrap();
    let now = belief(&store, 21);
    assert!(now.confidence > 0.98 && now.since == at(20) && now.last_seen == Some(at(21)));
    drop(store);

    let store = open(dir.path());
    assert_eq!(belief(&store, 21), now);
    assert_eq!((store.revision(), load(&store)), (1, before));
    assert_eq!(store.reader().observations(chair.id).unwrap().len(), 3);
}

#[test]
fn a_person_confirms_or_rejects_what_was_seen() {
    let dir = scratch();
    let mut store = open(dir.path());
    let (chair, elsewhere) = chair(&mut store);
    store.observe(&[look(&chair, 1, Some(elsewhere), 0.8)]).unwrap();
    let proposals = store.proposals(at(2)).unwrap();
    assert_eq!(
        (proposals.len(), proposals[0].replica, proposals[0].believed.place),
        (1, chair.id, elsewhere)
    );

    store.reject(chair.id, &Change::new("Мастер", at(3), "это был другой стул")).unwrap();
    assert_eq!(store.proposals(at(3)).unwrap(), []);
    store.observe(&[look(&chair, 4, Some(elsewhere), 0.8)]).unwrap();
    let report = store.confirm(chair.id, &Change::new("Мастер", at(5), "да, он там")).unwrap();
    assert_eq!((report.revision, report.counts.changed), (2, 1));
    assert_eq!(load(&store).replicas[&chair.id].frame, elsewhere.frame);
    assert_eq!(store.proposals(at(6)).unwrap(), []);
    let unknown = store.confirm(ReplicaId(999), &change("нет такого"));
    assert!(matches!(unknown, Err(StoreError::UnknownReplica { id: 999 })));
}

#[test]
fn the_robot_is_found_where_it_was_left() {
    let dir = scratch();
    let mut store = open(dir.path());
    assert!(store.reader().robot_pose().unwrap().is_none());
    let pose = Pose { at: Point::new(12.5, -3.0), heading: Deg::of(90.0) };
    for hours in 0..3 {
        store.put_robot_pose(MapId(1), &pose, "робот", at(hours)).unwrap();
    }
    drop(store);
    let (map, back, stamp) = open(dir.path()).reader().robot_pose().unwrap().unwrap();
    assert_eq!((map, back, stamp.at, stamp.revision), (MapId(1), pose, at(2), 0));
}

#[test]
fn what_was_derived_from_an_older_map_is_not_given_out() {
    let dir = scratch();
    let mut store = open(dir.path());
    store.import(&world(1, 3), &change("первая")).unwrap();
    assert_eq!(store.get_derived("relations"), None);
    store.put_derived("relations", 1, b"facts").unwrap();
    drop(store);
    let mut store = open(dir.path());
    assert_eq!(store.get_derived("relations").as_deref(), Some(&b"facts"[..]));
    let path = dir.path().join("derived/relations");
    let mut bytes = std::fs::read(&path).unwrap();
    for bit in 0..bytes.len() * 8 {
        bytes[bit / 8] ^= 1 << (bit % 8);
        std::fs::write(&path, &bytes).unwrap();
        assert_eq!(store.get_derived("relations"), None, "bit {bit}");
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
    std::fs::write(&path, &bytes).unwrap();
    store.import(&world(2, 3), &change("вторая")).unwrap();
    assert_eq!(store.get_derived("relations"), None);
}

#[test]
fn what_could_not_be_read_is_not_written() {
    let dir = scratch();
    let mut store = open(dir.path());
    let mut map = world(1, 3);
    map.robot.speed = f64::NAN;
    let refused = store.import(&map, &change("первая")).unwrap_err();
    assert!(matches!(refused, StoreError::NotFinite { table: "Robot", column: "Speed", .. }));
    map.robot.speed = 1e300;
    map.robot.radius = Cm::of(1e12);
    store.import(&map, &change("первая")).unwrap();
    assert_eq!(load(&store), map);
}

/// A small step of the first replica, as an edit of its own.
fn nudge(store: &mut Store, to: f64) {
    let mut map = load(store);
    map.replicas.values_mut().next().unwrap().frame = Frame::new(to, 0.0, 0.0, Deg::ZERO);
    store.commit(&map, &change(&format!("на {to}"))).unwrap();
}

fn first_x(store: &Store) -> f64 {
    load(store).replicas.values().next().unwrap().frame.x.get()
}

#[test]
fn edits_are_undone_and_redone_in_order() {
    let dir = scratch();
    let mut store = open(dir.path());
    assert!(matches!(store.undo(&change("")), Err(StoreError::NothingToUndo { .. })));
    store.import(&world(41, 3), &change("первая")).unwrap();
    let before = first_x(&store);
    for x in [10.0, 20.0, 30.0] {
        nudge(&mut store, x);
    }
    let mut seen = Vec::new();
    for step in "uuuruurrr".chars() {
        if step == 'u' {
            store.undo(&change("отмена")).unwrap();
        } else {
            store.redo(&change("возврат")).unwrap();
        }
        seen.push(
            store.world().unwrap().map(|w| w.replicas.values().next().unwrap().frame.x.get()),
        );
    }
    let (before, ten, twenty) = (Some(before), Some(10.0), Some(20.0));
    assert_eq!(seen, [twenty, ten, before, ten, before, None, before, ten, twenty]);
    // A new edit ends what can be redone.
    nudge(&mut store, 40.0);
    assert!(matches!(store.redo(&change("")), Err(StoreError::NothingToUndo { .. })));
    store.undo(&change("отмена")).unwrap();
    assert_eq!(Cm::of(first_x(&store)), Cm::of(20.0));
    drop(store);
    assert_eq!(Cm::of(first_x(&open(dir.path()))), Cm::of(20.0));
}

#[test]
fn an_edit_that_others_build_on_is_not_undone() {
    let dir = scratch();
    let mut store = open(dir.path());
    let map = world(43, 3);
    store.import(&map, &change("первая")).unwrap();
    nudge(&mut store, 10.0);
    nudge(&mut store, 20.0);
    let refused = store.undo_revision(2, &change("")).unwrap_err();
    assert!(matches!(refused, StoreError::UndoConflict { revision: 2, by: 3, .. }), "{refused}");
    store.undo_revision(3, &change("")).unwrap();
    store.undo_revision(2, &change("")).unwrap();
    assert_eq!(load(&store), map);
    store.return_to(3, &change("обратно")).unwrap();
    assert_eq!(Cm::of(first_x(&store)), Cm::of(20.0));
}

#[test]
fn two_revisions_are_compared_in_words() {
    let dir = scratch();
    let mut store = open(dir.path());
    let mut map = World::load("maps/rb2.toml").unwrap();
    store.import(&map, &change("первая")).unwrap();
    let areas: Vec<AreaId> = map.areas.keys().copied().collect();
    let ids: Vec<ReplicaId> = map.replicas.keys().copied().collect();
    let named =
        |id: &ReplicaId| format!("экземпляр «{}»", load(&open_twin(dir.path())).replicas[id].name);
    let names: Vec<String> = ids.iter().map(named).collect();
    let moved = map.replicas.get_mut(&ids[0]).unwrap();
    moved.frame.x = moved.frame.x + Cm::of(30.0);
    moved.frame.y = moved.frame.y + Cm::of(40.0);
    moved.frame.angle = moved.frame.angle + Deg::of(-90.0);
    let carried = map.replicas.get_mut(&ids[1]).unwrap();
    let from = carried.area;
    carried.area = *areas.iter().find(|a| **a != from).unwrap();
    let (from, to) =
        (map.areas[&from].name.clone(), map.areas[&map.replicas[&ids[1]].area].name.clone());
    let door = map.doors.values_mut().find(|d| d.kind != DoorKind::Passage).unwrap();
    door.state = DoorState { opening: 40.0, ..DoorState::OPEN };
    let door_name = door.name.clone();
    map.robot.speed = 33.0;
    store.commit(&map, &change("вторая")).unwrap();
    let said: Vec<String> = store.diff(1, 2).unwrap().iter().map(ToString::to_string).collect();
    assert!(
        said.contains(&format!(
            "{}: передвинут на 50 см, повёрнут на 90° по часовой стрелке",
            names[0]
        )),
        "{said:#?}"
    );
    assert!(said.contains(&format!("{}: помещение «{from}» → «{to}»", names[1])), "{said:#?}");
    assert!(
        said.iter().any(|s| s.starts_with(&format!("дверь «{door_name}»: "))
            && s.ends_with("→ открыта на 40 %")),
        "{said:#?}"
    );
    assert!(
        said.iter().any(|s| s.starts_with("робот домейна") && s.ends_with("Speed 60 → 33")),
        "{said:#?}"
    );
    assert_eq!(said.len(), 4, "{said:#?}");
    assert_eq!(store.diff(2, 2).unwrap(), []);
    assert_eq!(store.diff(2, 1).unwrap().len(), 4);
}

fn open_twin(dir: &Path) -> Store {
    Store::open_read_only(dir).unwrap().0
}

#[test]
fn a_backup_is_the_whole_store_in_one_file() {
    let (dir, copies) = (scratch(), scratch());
    let mut store = open(dir.path());
    let (first, second) = (world(51, 10), world(52, 10));
    store.import(&first, &change("первая")).unwrap();
    store.import(&second, &change("вторая")).unwrap();
    let second = load(&store);
    let copy = copies.path().join("копия");
    store.backup(&copy).unwrap();
    store.import(&world(53, 10), &change("третья")).unwrap();

    let place = copies.path().join("новое");
    let restored = Store::restore(&copy, &place).unwrap();
    assert_eq!((restored.revision(), load(&restored)), (2, second));
    assert_eq!(restored.world_as_of(1).unwrap().unwrap(), first);
    drop(restored);
    assert!(fsck(&place).unwrap().is_sound());
    assert!(matches!(Store::restore(&copy, &place), Err(StoreError::NotEmpty { .. })));

    let mut bytes = std::fs::read(&copy).unwrap();
    for _ in 0..40 {
        let bit = Dice::new(bytes.len() as u64).roll(bytes.len() as u64 * 8) as usize;
        bytes[bit / 8] ^= 1 << (bit % 8);
        std::fs::write(&copy, &bytes).unwrap();
        let refused = Store::restore(&copy, copies.path().join("другое"));
        assert!(matches!(refused, Err(StoreError::BadFile { .. })));
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
    for rubbish in [&b""[..], b"SQLite format 3\0", &[0xFF; 100_000]] {
        std::fs::write(&copy, rubbish).unwrap();
        let refused = Store::restore(&copy, copies.path().join("другое"));
        assert!(matches!(refused, Err(StoreError::BadFile { .. })));
    }
}

#[test]
fn a_deep_check_finds_what_is_broken_and_opening_mends_it() {
    let dir = scratch();
    let mut store = open(dir.path());
    for seed in 0..4 {
        store.import(&world(seed, 5), &change("ещё")).unwrap();
        store.checkpoint().unwrap();
    }
    let map = load(&store);
    // While it is open, all but sled can be checked.
    assert!(fsck(dir.path()).unwrap().is_sound());
    drop(store);
    let report = fsck(dir.path()).unwrap();
    assert_eq!((report.is_sound(), report.revision, report.snapshots), (true, 4, 3));

    let snapshots = dir.path().join("snapshots");
    let newest = std::fs::read_dir(&snapshots).unwrap().map(|e| e.unwrap().path()).max().unwrap();
    let mut bytes = std::fs::read(&newest).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&newest, &bytes).unwrap();
    std::fs::remove_dir_all(dir.path().join("sled")).unwrap();
    let report = fsck(dir.path()).unwrap();
    let mendable = report.findings.iter().filter(|f| f.severity == Severity::Mendable).count();
    assert_eq!(mendable, 2, "{:#?}", report.findings);
    assert!(report.findings.iter().all(|f| f.severity < Severity::Broken));
    // The snapshot before it and the journal since then are enough.
    let (store, opened) = Store::open(dir.path()).unwrap();
    assert!(opened.tables_rebuilt.is_some());
    assert_eq!(load(&store), map);
}

/// A child shares its parent's files from its fork until it runs, the lock among them.
#[test]
fn a_closed_store_is_free_while_children_are_started() {
    let dir = scratch();
    let stop = std::sync::atomic::AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !stop.load(std::sync::atomic::Ordering::Relaxed) {
                let _ = Command::new("true").status();
            }
        });
        let refused = (0..40).filter(|_| Store::open(dir.path()).is_err()).count();
        stop.store(true, std::sync::atomic::Ordering::Relaxed);
        assert_eq!(refused, 0);
    });
}

#[test]
fn a_deep_check_says_what_the_next_opening_will_mend() {
    let dir = scratch();
    let mut store = open(dir.path());
    for seed in 0..3 {
        store.import(&world(seed, 5), &change("ещё")).unwrap();
    }
    store.put_derived("relations", 3, b"computed").unwrap();
    let map = load(&store);
    drop(store);
    let journal =
        std::fs::read_dir(dir.path().join("journal")).unwrap().next().unwrap().unwrap().path();
    let derived = dir.path().join("derived").join("relations");
    let flip = |path: &Path, at: usize| {
        let mut bytes = std::fs::read(path).unwrap();
        bytes[at] ^= 1;
        std::fs::write(path, bytes).unwrap();
    };
    // The first frame is broken, whole ones follow, there is no snapshot: sled alone has it all.
    flip(&journal, 300);
    flip(&derived, 25);
    let report = fsck(dir.path()).unwrap();
    // What the random map itself is warned of is a note.
    let texts: Vec<_> = report
        .findings
        .iter()
        .filter(|f| f.severity > Severity::Note)
        .map(|f| (f.severity, f.text.as_str()))
        .collect();
    assert!(texts.iter().all(|(severity, _)| *severity == Severity::Mendable), "{texts:#?}");
    assert_eq!((report.revision, texts.len()), (3, 2), "{texts:#?}");
    assert!(texts[0].1.contains("испорчен"), "{texts:#?}");
    assert!(texts[1].1.contains("relations"), "{texts:#?}");
    let (store, opened) = Store::open(dir.path()).unwrap();
    assert!(opened.journal_renewed.is_some());
    assert_eq!(load(&store), map);
    assert_eq!(store.get_derived("relations"), None);
    drop(store);

    // With sled gone as well, nothing is left to mend with.
    let journal =
        std::fs::read_dir(dir.path().join("snapshots")).unwrap().next().unwrap().unwrap().path();
    flip(&journal, 300);
    std::fs::remove_dir_all(dir.path().join("sled")).unwrap();
    let report = fsck(dir.path()).unwrap();
    assert!(report.findings.iter().any(|f| f.severity == Severity::Broken), "{report:#?}");
    assert!(matches!(Store::open(dir.path()), Err(StoreError::BothCorrupt { .. })));
}

/// One bit of any file, sled's included: everything is there all the same.
/// `STORE_FLIPS=1000` flips as many.
#[test]
fn a_flipped_bit_in_any_file_costs_nothing() {
    let flips = std::env::var("STORE_FLIPS").ok().and_then(|n| n.parse().ok()).unwrap_or(60);
    let original = scratch();
    let mut store = open(original.path());
    for seed in 0..3 {
        store.import(&world(seed, 6), &change("ещё")).unwrap();
        if seed == 1 {
            store.checkpoint().unwrap();
        }
    }
    let map = load(&store);
    drop(store);
    let mut files = Vec::new();
    collect_files(original.path(), &mut files);
    let mut dice = Dice::new(2026);
    for _ in 0..flips {
        let copy = scratch();
        for (path, bytes) in &files {
            let to = copy.path().join(path.strip_prefix(original.path()).unwrap());
            std::fs::create_dir_all(to.parent().unwrap()).unwrap();
            std::fs::write(to, bytes).unwrap();
        }
        let filled: Vec<_> = files.iter().filter(|(_, bytes)| !bytes.is_empty()).collect();
        let (path, bytes) = filled[dice.roll(filled.len() as u64) as usize];
        let mut bytes = bytes.clone();
        let bit = dice.roll(bytes.len() as u64 * 8) as usize;
        bytes[bit / 8] ^= 1 << (bit % 8);
        std::fs::write(copy.path().join(path.strip_prefix(original.path()).unwrap()), bytes)
            .unwrap();
        let opened = Store::open(copy.path());
        let (store, _) = opened.unwrap_or_else(|e| panic!("{path:?} bit {bit}: {e}"));
        assert_eq!((store.revision(), load(&store)), (3, map.clone()), "{path:?} bit {bit}");
    }
}

fn collect_files(dir: &Path, files: &mut Vec<(std::path::PathBuf, Vec<u8>)>) {
    for entry in std::fs::read_dir(dir).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect_files(&path, files);
        } else {
            let bytes = std::fs::read(&path).unwrap();
            files.push((path, bytes));
        }
    }
}

#[test]
fn forgetting_takes_the_past_and_leaves_the_rest() {
    let dir = scratch();
    let mut store = open(dir.path());
    for seed in 60..66 {
        store.import(&world(seed, 8), &change("ещё")).unwrap();
    }
    let worlds: Vec<_> = (4..=6).map(|r| store.world_as_of(r).unwrap()).collect();
    let next = store.next_id(Table::AreaObjects).unwrap();
    assert!(store.forget_before(4, &change("место нужно")).unwrap() > 0);
    drop(store);
    let mut store = open(dir.path());
    assert_eq!((4..=6).map(|r| store.world_as_of(r).unwrap()).collect::<Vec<_>>(), worlds);
    assert!(matches!(
        store.world_as_of(3),
        Err(StoreError::ForgottenRevision { wanted: 3, first: 4 })
    ));
    assert_eq!(store.next_id(Table::AreaObjects).unwrap(), next);
    assert_eq!(store.revisions().unwrap().len(), 6);
    assert!(fsck(dir.path()).unwrap().is_sound());
    store.undo(&change("")).unwrap();
    store.undo(&change("")).unwrap();
    assert_eq!(store.world().unwrap(), worlds[0]);
    let refused = store.undo(&change("")).unwrap_err();
    assert!(matches!(refused, StoreError::ForgottenRevision { .. }), "{refused}");
    // Once more with everything: only what stands now is left.
    store.forget_before(store.revision(), &change("всё")).unwrap();
    assert_eq!(store.world().unwrap(), worlds[0]);
}

#[test]
fn a_replica_is_followed_from_room_to_room() {
    let dir = scratch();
    let mut store = open(dir.path());
    let mut map = World::load("maps/rb2.toml").unwrap();
    store.import(&map, &change("первая")).unwrap();
    let areas: Vec<AreaId> = map.areas.keys().copied().collect();
    let id = *map.replicas.keys().next().unwrap();
    let mut expected = vec![map.replicas[&id].area];
    for n in 0..5 {
        let r = map.replicas.get_mut(&id).unwrap();
        r.area = areas[n % areas.len()];
        r.frame.x = Cm::of(n as f64);
        expected.push(r.area);
        store.commit(&map, &change("перенёс")).unwrap();
    }
    let reader = store.reader();
    let column = |row: &[Cell]| match row[0] {
        Cell::Int(id) => AreaId(u32::try_from(id).unwrap()),
        _ => panic!("an id is a number"),
    };
    let path: Vec<AreaId> =
        reader.replica_history(id).unwrap().iter().map(|v| column(&v.row)).collect();
    assert_eq!(path, expected);
    assert_eq!(reader.replica(id).unwrap().unwrap(), map.replicas[&id]);
    assert_eq!(store.reader_at(2).unwrap().replica(id).unwrap().unwrap().area, areas[0]);
    assert!(reader.replica(ReplicaId(9999)).unwrap().is_none());
}

#[test]
fn rows_from_elsewhere_become_the_map_or_are_refused() {
    let (first, second) = (scratch(), scratch());
    let map = world(71, 10);
    let mut store = open(first.path());
    store.import(&map, &change("первая")).unwrap();
    // Every row over the public interface, as an exchange with SQL does it.
    let mut sheet = Sheet::default();
    for table in Table::ALL.iter().copied().filter(|t| t.is_map()) {
        for (_, version) in store.reader().versions(table, &Key::new()).unwrap() {
            sheet.add(table, version.row).unwrap();
        }
    }
    let mut other = open(second.path());
    other.import_sheet(&sheet, &change("из таблиц")).unwrap();
    assert_eq!(load(&other), map);
    let text = || Cell::Text("не число".into());
    assert!(matches!(sheet.add(Table::Area, vec![text()]), Err(StoreError::BadRecord { .. })));
    assert!(matches!(
        sheet.add(Table::Area, vec![Cell::Int(-1)]),
        Err(StoreError::BadRecord { .. })
    ));
    let twice = sheet.rows(Table::Domain).next().unwrap().1.clone();
    assert!(matches!(sheet.add(Table::Domain, twice), Err(StoreError::Duplicate { .. })));
    let empty = other.import_sheet(&Sheet::default(), &change("ничего"));
    assert!(matches!(empty, Err(StoreError::BrokenReference { table: "Domain", .. })));
}

#[test]
fn an_edit_is_shown_before_it_is_made() {
    let map = world(73, 5);
    let mut edited = map.clone();
    edited.replicas.values_mut().next().unwrap().move_prob = 101;
    let said: Vec<String> =
        compare(&map, &edited).unwrap().iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 1);
    assert!(
        said[0].ends_with("→ 101") && said[0].starts_with("экземпляр «Вещь-0»: подвижность"),
        "{said:?}"
    );
}
