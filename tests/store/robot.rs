//! What the robot saw, and where it was left.

use orthoframe_map::Replica;
use orthoframe_store::{Change, Observation, Seen, Store, StoreError, Timestamp};
use orthoframe_units::{Deg, Frame, MapId, Point, Pose, ReplicaId};

use super::{change, load, open, scratch};
use crate::store_world::world;

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
    assert_eq!((belief(&store, 9).missed, belief(&store, 11).missed), (None, Some(at(10))));
    let now = belief(&store, 20);
    assert_eq!((now.place, now.confidence, now.is_surveyed), (elsewhere, 0.9, false));
    assert_eq!((now.since, now.last_seen, now.missed), (at(20), Some(at(20)), None));
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
    let proposals = store.proposals(at(2), 0.5).unwrap();
    assert_eq!(
        (proposals.len(), proposals[0].replica, proposals[0].believed.place),
        (1, chair.id, elsewhere)
    );

    store.reject(chair.id, &Change::new("Мастер", at(3), "это был другой стул")).unwrap();
    assert_eq!(store.proposals(at(3), 0.5).unwrap(), []);
    store.observe(&[look(&chair, 4, Some(elsewhere), 0.8)]).unwrap();
    let report = store.confirm(chair.id, &Change::new("Мастер", at(5), "да, он там")).unwrap();
    assert_eq!((report.revision, report.counts.changed), (2, 1));
    assert_eq!(load(&store).replicas[&chair.id].frame, elsewhere.frame);
    assert_eq!(store.proposals(at(6), 0.5).unwrap(), []);
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

/// Much may happen in one millisecond, by a clock that is no finer: what was written first is told apart all the same.
#[test]
fn what_was_seen_in_the_moment_of_a_verdict_counts_if_it_was_seen_after_it() {
    let dir = scratch();
    let mut store = open(dir.path());
    let (chair, elsewhere) = chair(&mut store);
    let proposed = |store: &Store| store.proposals(at(2), 0.5).unwrap().len();
    for again in 0..3 {
        assert_eq!(proposed(&store), 0, "{again}");
        store.observe(&[look(&chair, 1, Some(elsewhere), 0.8)]).unwrap();
        assert_eq!(proposed(&store), 1, "{again}");
        store.reject(chair.id, &Change::new("Мастер", at(1), "нет")).unwrap();
    }
    // A survey of the same moment says where the thing is, whatever was seen before it.
    store.observe(&[look(&chair, 1, Some(elsewhere), 0.8)]).unwrap();
    let mut map = load(&store);
    map.replicas.get_mut(&chair.id).unwrap().frame = Frame::new(60.0, 0.0, 0.0, Deg::ZERO);
    store.commit(&map, &Change::new("Мастер", at(1), "сюда")).unwrap();
    let chair = load(&store).replicas[&chair.id].clone();
    assert!(store.reader().belief(&chair, at(2)).unwrap().is_surveyed);
    store.observe(&[look(&chair, 1, Some(elsewhere), 0.8)]).unwrap();
    assert!(!store.reader().belief(&chair, at(2)).unwrap().is_surveyed);
}
