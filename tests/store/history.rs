//! The past: versions, undo and redo, differences, forgetting.

use std::path::Path;

use orthoframe_map::{DoorKind, DoorState, World};
use orthoframe_store::{Cell, Change, Key, Store, StoreError, Table, Timestamp, fsck};
use orthoframe_units::{AreaId, Cm, Deg, Frame, ReplicaId};

use super::{change, load, open, scratch};
use crate::store_world::world;

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

/// What is undone is not undone again, whatever later edit came to the same values; brought back, it is.
#[test]
fn what_is_undone_is_not_undone_again() {
    let dir = scratch();
    let mut store = open(dir.path());
    store.import(&world(43, 3), &change("первая")).unwrap();
    nudge(&mut store, 10.0);
    store.undo(&change("")).unwrap();
    nudge(&mut store, 10.0);
    let refused = store.undo_revision(2, &change("")).unwrap_err();
    assert!(matches!(refused, StoreError::AlreadyUndone { revision: 2, by: 3 }), "{refused}");
    store.undo_revision(4, &change("")).unwrap();
    store.undo_revision(5, &change("brings 4 back")).unwrap();
    store.undo_revision(4, &change("")).unwrap();
    store.redo(&change("")).unwrap();
    store.undo_revision(4, &change("")).unwrap();
    let refused = store.undo_revision(4, &change("")).unwrap_err();
    assert!(matches!(refused, StoreError::AlreadyUndone { revision: 4, .. }), "{refused}");
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

#[test]
fn forgetting_takes_the_past_and_leaves_the_rest() {
    let dir = scratch();
    let mut store = open(dir.path());
    for seed in 60..66 {
        store.import(&world(seed, 8), &change("ещё")).unwrap();
    }
    let worlds: Vec<_> = (4..=6).map(|r| store.world_as_of(r).unwrap()).collect();
    let next = store.next_id(Table::AreaObjects).unwrap();
    assert!(store.forget_before(4, &change("место нужно")).unwrap().versions > 0);
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

fn open_twin(dir: &Path) -> Store {
    Store::open_read_only(dir).unwrap().0
}
