//! What is past lies on the disk: it is read as if it were in memory, and never wrongly.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use orthoframe_map::{Replica, World};
use orthoframe_store::{Change, Observation, Seen, Severity, Store, StoreError, Timestamp, fsck};
use orthoframe_units::{Deg, Frame, ReplicaId};

use super::{change, load, open, scratch};
use crate::store_world::{Dice, world};

const DAY: i64 = 86_400_000;

fn at(ms: i64) -> Timestamp {
    Timestamp(1_790_000_000_000 + ms)
}

/// Things that move, and the store that has them.
fn begun(dir: &Path) -> (Store, World) {
    let mut map = world(31, 3);
    for replica in map.replicas.values_mut() {
        replica.move_prob = (replica.id.0 * 37 % 101) as u8;
    }
    let mut store = open(dir);
    store.import(&map, &Change::new("Мастер", at(0), "первая")).unwrap();
    (store, map)
}

fn look(dice: &mut Dice, replica: &Replica, ms: i64) -> Observation {
    let frame = Frame::new(dice.roll(900) as f64, dice.roll(90) as f64, 0.0, Deg::ZERO);
    let seen = match dice.roll(4) {
        0 => None,
        1 => Some(Seen { area: replica.area, frame: replica.frame }),
        _ => Some(Seen { area: replica.area, frame }),
    };
    let sure = dice.roll(100) as f64 / 100.0;
    Observation { replica: replica.id, at: at(ms), seen, sure, observer: "робот".into() }
}

/// So many observations, a run of its own or more.
fn see_much(store: &mut Store, map: &World, dice: &mut Dice, from: i64, count: i64) {
    let all: Vec<&Replica> = map.replicas.values().collect();
    for batch in 0..count / 500 {
        let seen = (0..500).map(|n| {
            let replica = all[dice.roll(all.len() as u64) as usize];
            look(dice, replica, from + batch * 500 + n)
        });
        store.observe(&seen.collect::<Vec<_>>()).unwrap();
    }
}

fn runs(dir: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(dir.join("past")) else { return Vec::new() };
    let mut all: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    all.sort();
    all
}

type Told = (Vec<(ReplicaId, Vec<Observation>)>, Vec<String>, World);

/// All that is past, and the map as of some revisions.
fn told(store: &Store) -> Result<Told, StoreError> {
    let map = store.world()?.expect("there is a map");
    let reader = store.reader();
    let seen = map.replicas.keys().map(|id| Ok((*id, reader.observations(*id)?)));
    let seen = seen.collect::<Result<_, StoreError>>()?;
    let stories = map.replicas.keys().map(|id| Ok(format!("{:?}", reader.replica_history(*id)?)));
    let stories = stories.collect::<Result<_, StoreError>>()?;
    let then = store.world_as_of(store.revision() / 2 + 1)?.expect("there was a map");
    Ok((seen, stories, then))
}

#[test]
fn what_is_past_is_read_as_if_it_were_in_memory() {
    let dir = scratch();
    let (mut store, mut map) = begun(dir.path());
    let mut dice = Dice::new(4);
    for round in 0..12 {
        see_much(&mut store, &map, &mut dice, round * DAY, 12_000);
        for replica in map.replicas.values_mut().take(3) {
            let by = Frame::new(round as f64, 0.0, 0.0, Deg::ZERO);
            replica.frame = by;
        }
        store.commit(&map, &Change::new("Мастер", at(round * DAY + 1), "ещё")).unwrap();
        let before = told(&store).unwrap();
        store.checkpoint().unwrap();
        assert!(told(&store).unwrap() == before, "round {round}");
        if round % 4 == 3 {
            drop(store);
            store = open(dir.path());
            assert!(told(&store).unwrap() == before, "round {round}, opened again");
        }
    }
    let kept = runs(dir.path());
    // Eight of like size became one, in two files; those that a snapshot needs yet may be there.
    assert!(kept.len() >= 2 * 5 && kept.len() <= 2 * 13, "{kept:?}");
    let before = told(&store).unwrap();
    let copy = dir.path().join("copy.backup");
    store.backup(&copy).unwrap();
    drop(store);
    assert!(fsck(dir.path()).unwrap().is_sound(), "{:?}", fsck(dir.path()));
    let other = scratch();
    let restored = Store::restore(&copy, other.path().join("store")).unwrap();
    assert!(told(&restored).unwrap() == before, "restored");
    // Forgotten is forgotten, seen is seen.
    let mut store = open(dir.path());
    let last = store.revision();
    store.forget_before(last, &change("хватит")).unwrap();
    let (seen, _, then) = before;
    let after: Vec<_> =
        seen.iter().map(|(id, _)| (*id, store.reader().observations(*id).unwrap())).collect();
    assert!(after == seen);
    assert!(matches!(store.reader_at(last - 1), Err(StoreError::ForgottenRevision { .. })));
    assert_ne!(load(&store), then);
}

#[test]
fn one_broken_file_of_the_past_is_mended_and_two_are_refused() {
    let dir = scratch();
    let (mut store, map) = begun(dir.path());
    see_much(&mut store, &map, &mut Dice::new(9), 0, 20_000);
    let before = told(&store).unwrap();
    store.checkpoint().unwrap();
    drop(store);
    let [run, twin] = &runs(dir.path())[..] else { panic!("{:?}", runs(dir.path())) };
    assert_eq!(std::fs::read(run).unwrap(), std::fs::read(twin).unwrap());
    let whole = std::fs::read(run).unwrap();
    let flip = |path: &Path, at: usize| {
        let mut bytes = std::fs::read(path).unwrap();
        bytes[at] ^= 4;
        std::fs::write(path, bytes).unwrap();
    };
    // In its blocks a twin is read only where the other is broken, and by `fsck`.
    let places = [3, 20, whole.len() / 2, whole.len() - 5, whole.len() - 30, whole.len() - 60];
    for (n, place) in places.into_iter().enumerate() {
        let (one, other) = if n % 2 == 0 { (run, twin) } else { (twin, run) };
        flip(one, place);
        let found = fsck(dir.path()).unwrap();
        let found = found.findings.iter().filter(|f| f.severity != Severity::Note);
        assert_eq!(found.map(|f| f.severity).collect::<Vec<_>>(), [Severity::Mendable], "{place}");
        let mut store = open(dir.path());
        assert!(told(&store).unwrap() == before, "byte {place}");
        store.checkpoint().unwrap();
        drop(store);
        assert_eq!(std::fs::read(one).unwrap(), whole, "byte {place} is mended");
        assert_eq!(std::fs::read(other).unwrap(), whole);
    }
    for gone in [run, twin] {
        std::fs::remove_file(gone).unwrap();
        assert!(told(&open(dir.path())).unwrap() == before);
        assert_eq!(std::fs::read(gone).unwrap(), whole, "written anew");
    }
    // The same block of both: what stands there is refused, with the file's name; all else is told.
    let middle = whole.len() / 2;
    [run, twin].into_iter().for_each(|path| flip(path, middle));
    let store = open(dir.path());
    let reader = store.reader();
    let (mut refused, mut given) = (0, 0);
    for (id, seen) in &before.0 {
        match reader.observations(*id) {
            Ok(again) => {
                assert!(again == *seen);
                given += 1;
            }
            Err(StoreError::BadFile { path, .. }) => {
                assert!(path.ends_with(".run"));
                refused += 1;
            }
            Err(other) => panic!("{other}"),
        }
    }
    assert!(refused > 0 && given > 0, "{refused} {given}");
    assert!(!fsck(dir.path()).unwrap().is_sound());
}

/// A run that cannot be opened once may be well the next time, or be brought back from elsewhere: its files stay.
#[test]
fn files_of_the_past_that_cannot_be_read_stay_where_they_are() {
    let dir = scratch();
    let (mut store, map) = begun(dir.path());
    let mut dice = Dice::new(12);
    see_much(&mut store, &map, &mut dice, 0, 20_000);
    store.checkpoint().unwrap();
    let (before, _, _) = told(&store).unwrap();
    drop(store);
    let old = runs(dir.path());
    let whole: Vec<Vec<u8>> = old.iter().map(|path| std::fs::read(path).unwrap()).collect();
    // As long as it has both indexes broken, it is unreadable; and then once more in the midst of its records.
    for at in [whole[0].len() - 5, whole[0].len() / 2] {
        for (path, bytes) in old.iter().zip(&whole) {
            let mut bytes = bytes.clone();
            bytes[at] ^= 4;
            std::fs::write(path, bytes).unwrap();
        }
        let mut store = open(dir.path());
        assert!(told(&store).is_err(), "it is broken");
        for day in 1..7 {
            see_much(&mut store, &map, &mut dice, day * DAY, 12_000);
            store.checkpoint().unwrap();
        }
        drop(store);
        for (path, bytes) in old.iter().zip(&whole) {
            assert!(path.exists(), "{} is gone", path.display());
            std::fs::write(path, bytes).unwrap();
        }
        let store = open(dir.path());
        for (id, seen) in &before {
            let now = store.reader().observations(*id).unwrap();
            assert!(now.len() > seen.len() && seen.iter().all(|o| now.contains(o)), "byte {at}");
        }
    }
}

/// A file that was mended while the store is open is read from then on, and not written at every snapshot.
#[test]
fn what_was_mended_is_mended_once() {
    let dir = scratch();
    let (mut store, map) = begun(dir.path());
    see_much(&mut store, &map, &mut Dice::new(9), 0, 20_000);
    store.checkpoint().unwrap();
    drop(store);
    let first = runs(dir.path())[0].clone();
    let mut bytes = std::fs::read(&first).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 4;
    std::fs::write(&first, bytes).unwrap();
    let mut store = open(dir.path());
    let told_once = told(&store).unwrap();
    store.checkpoint().unwrap();
    let written = std::fs::metadata(&first).unwrap().modified().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(20));
    assert!(told(&store).unwrap() == told_once);
    store.checkpoint().unwrap();
    assert_eq!(std::fs::metadata(&first).unwrap().modified().unwrap(), written);
}

/// What a person said, and what was seen, in the order of writing.
enum Event {
    Seen(Observation),
    Rejected(Timestamp),
    Written(Timestamp),
}

/// How much of what was seen counts: the obvious slow way, by the order of writing.
fn counting(story: &[Event], now: Timestamp) -> usize {
    let written = story.iter().rposition(|told| matches!(told, Event::Written(_)));
    let written = written.expect("the map has it");
    let Event::Written(survey) = story[written] else { unreachable!() };
    let rejected = story.iter().enumerate().filter_map(|(n, told)| match told {
        Event::Rejected(at) if *at <= now => Some((*at, n)),
        _ => None,
    });
    let rejected = rejected.max();
    let counts = |n: usize, o: &Observation| {
        let after_survey = o.at > survey || (o.at == survey && n > written);
        let after_verdict = rejected.is_none_or(|(at, m)| o.at > at || (o.at == at && n > m));
        o.at <= now && after_survey && after_verdict
    };
    let seen = story.iter().enumerate();
    seen.filter(|(n, told)| matches!(told, Event::Seen(o) if counts(*n, o))).count()
}

/// Whatever is noted in whatever order, the belief that is kept is the one that going through all of it gives.
#[test]
fn the_belief_that_is_kept_is_that_of_all_that_was_seen() {
    let dir = scratch();
    let (mut store, mut map) = begun(dir.path());
    let mut dice = Dice::new(77);
    let mut stories: BTreeMap<ReplicaId, Vec<Event>> =
        map.replicas.values().map(|r| (r.id, vec![Event::Written(at(0))])).collect();
    let ids: Vec<ReplicaId> = map.replicas.keys().copied().take(5).collect();
    let mut clock = 1;
    let mut counted = 0;
    for step in 0..600 {
        clock += dice.roll(3) as i64;
        let id = ids[dice.roll(ids.len() as u64) as usize];
        let replica = map.replicas[&id].clone();
        let story = stories.get_mut(&id).unwrap();
        match dice.roll(12) {
            0 => {
                store.reject(id, &Change::new("Мастер", at(clock), "нет")).unwrap();
                story.push(Event::Rejected(at(clock)));
            }
            1 => {
                let frame = Frame::new(step as f64, 0.0, 0.0, Deg::ZERO);
                map.replicas.get_mut(&id).unwrap().frame = frame;
                store.commit(&map, &Change::new("Мастер", at(clock), "сюда")).unwrap();
                story.push(Event::Written(at(clock)));
            }
            2 => store.checkpoint().unwrap(),
            _ => {
                let count = 1 + dice.roll(3);
                let mut seen = Vec::new();
                for _ in 0..count {
                    // Now and then from a log of earlier.
                    let back = if dice.roll(5) == 0 { dice.roll(40) as i64 } else { 0 };
                    seen.push(look(&mut dice, &replica, clock - back));
                    clock += dice.roll(2) as i64;
                }
                store.observe(&seen).unwrap();
                story.extend(seen.into_iter().map(Event::Seen));
            }
        }
        // With what is kept and without it: a store that has forgotten it goes through all of it.
        let reader = store.reader();
        for id in &ids {
            let replica = &map.replicas[id];
            for now in [at(clock), at(clock + 50_000), at(clock - dice.roll(60) as i64)] {
                let kept = reader.belief(replica, now).unwrap();
                let slow = reader.belief_from_all(replica, now).unwrap();
                assert_eq!(kept, slow, "step {step}, {id:?} at {now:?}");
                let seen = counting(&stories[id], now);
                // Nothing that counts: as the map has it, and not seen. Something: it was seen or missed.
                assert_eq!(seen == 0, kept.last_seen.is_none() && kept.missed.is_none());
                counted += usize::from(seen > 0);
            }
        }
    }
    assert!(counted > 1_000, "{counted}");
}
