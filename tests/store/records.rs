//! A map goes in and comes out: records, keys, ids, Fragments, derived tables.

use orthoframe_map::World;
use orthoframe_store::{Cell, Changes, Counts, Edits, Key, Sheet, StoreError, Table, records};
use orthoframe_units::{AreaId, Point, ReplicaId};
use proptest::prelude::*;

use super::{change, load, open, scratch};
use crate::store_world::{Dice, replica, world};

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

#[test]
fn what_was_derived_from_an_older_map_is_not_given_out() {
    let dir = scratch();
    let mut store = open(dir.path());
    store.import(&world(1, 3), &change("первая")).unwrap();
    assert_eq!(store.derived().get("relations"), None);
    store.derived().put("relations", b"facts").unwrap();
    drop(store);
    let mut store = open(dir.path());
    assert_eq!(store.derived().get("relations").as_deref(), Some(&b"facts"[..]));
    let path = dir.path().join("derived/relations");
    let mut bytes = std::fs::read(&path).unwrap();
    for bit in 0..bytes.len() * 8 {
        bytes[bit / 8] ^= 1 << (bit % 8);
        std::fs::write(&path, &bytes).unwrap();
        assert_eq!(store.derived().get("relations"), None, "bit {bit}");
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
    std::fs::write(&path, &bytes).unwrap();
    store.import(&world(2, 3), &change("вторая")).unwrap();
    assert_eq!(store.derived().get("relations"), None);
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
        Changes::between(&map, &edited).unwrap().told().iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 1);
    assert!(
        said[0].ends_with("→ 101") && said[0].starts_with("экземпляр «Вещь-0»: подвижность"),
        "{said:?}"
    );
}
