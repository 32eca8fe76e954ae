//! Two programs that have one store open and write it in turn.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe_map::World;
use orthoframe_store::{Finding, Meanwhile, Severity, Store, StoreError, fsck, last_transaction};

use super::{change, load, open, scratch};
use crate::store_world::{Dice, world};

/// What was acknowledged, by whichever of the two.
struct Model {
    /// The map at each revision.
    past: Vec<World>,
    /// Every id that a thing ever had, with its name then.
    given: BTreeMap<u32, String>,
}

impl Model {
    fn check(&self, store: &Store) {
        assert_eq!(store.revision() as usize, self.past.len());
        assert_eq!(&load(store), self.past.last().expect("the first map"));
    }

    /// A thing more or less, or another name.
    fn edit(&mut self, store: &mut Store, dice: &mut Dice, number: u64) {
        let mut next = load(store);
        let ids: Vec<_> = next.replicas.keys().copied().collect();
        let id = ids[dice.roll(ids.len() as u64) as usize];
        match dice.roll(3) {
            0 if ids.len() > 4 => {
                next.replicas.remove(&id);
            }
            1 => {
                let table = orthoframe_store::Table::AreaObjects;
                let new = store.next_id(table).expect("ids are counted");
                let mut thing = next.replicas[&id].clone();
                thing.id.0 = new;
                thing.name = format!("Вещь {number}");
                assert_eq!(self.given.insert(new, thing.name.clone()), None, "given twice");
                next.replicas.insert(thing.id, thing);
            }
            _ => next.replicas.get_mut(&id).expect("it is there").name = format!("Имя {number}"),
        }
        let report =
            store.commit(&next, &change(&format!("правка {number}"))).expect("it is taken");
        assert_eq!(report.revision as usize, self.past.len() + 1);
        self.past.push(next);
        self.check(store);
    }
}

/// Two stores, whose turns a seed deals; now and then one is closed with the store in hand, and opened again.
#[test]
fn two_that_write_in_turn_lose_nothing_and_give_no_id_twice() {
    for seed in 0..6 {
        let dir = scratch();
        let mut dice = Dice::new(seed);
        let first = world(seed, 9);
        let mut one = open(dir.path());
        one.import(&first, &change("первая")).unwrap();
        let given = load(&one).replicas.values().map(|r| (r.id.0, r.name.clone())).collect();
        let mut model = Model { past: vec![load(&one)], given };
        one.put_down();
        let mut other = open(dir.path());
        other.put_down();
        let mut stores = vec![one, other];
        for number in 0..40 {
            let at = dice.roll(2) as usize;
            match dice.roll(6) {
                0 => {
                    stores[at].follow().unwrap();
                    model.check(&stores[at]);
                    let last = last_transaction(dir.path()).unwrap();
                    assert_eq!(stores[at].transaction(), last);
                }
                1 => {
                    // Closed with the store in hand.
                    stores[at].take_up().unwrap();
                    model.edit(&mut stores[at], &mut dice, number);
                    if dice.roll(2) == 0 {
                        stores[at].checkpoint().unwrap();
                    }
                    // What the other knew it still tells, and takes over.
                    stores[1 - at].follow().unwrap();
                    model.check(&stores[1 - at]);
                    drop(stores.remove(at));
                    let mut again = open(dir.path());
                    model.check(&again);
                    again.put_down();
                    stores.push(again);
                }
                _ => {
                    let store = &mut stores[at];
                    let mut other = load(store);
                    other.domain.name = "Без спроса".into();
                    let written = store.commit(&other, &change("без спроса"));
                    assert!(matches!(written, Err(StoreError::Locked { .. })), "{written:?}");
                    store.take_up().unwrap();
                    for more in 0..dice.roll(3) {
                        model.edit(store, &mut dice, 100 * (more + 1) + number);
                    }
                    if dice.roll(5) == 0 {
                        store.checkpoint().unwrap();
                    }
                    store.put_down();
                    store.put_down();
                }
            }
        }
        for store in &mut stores {
            store.follow().unwrap();
            model.check(store);
            for (at, then) in model.past.iter().enumerate() {
                assert_eq!(store.world_as_of(at as u64 + 1).unwrap().as_ref(), Some(then));
            }
        }
        let numbers: BTreeSet<u64> =
            stores[0].revisions().unwrap().iter().map(|r| r.number).collect();
        assert_eq!(numbers, (1..=model.past.len() as u64).collect());
        drop(stores);
        let report = fsck(dir.path()).unwrap();
        let is_note = |finding: &Finding| finding.severity == Severity::Note;
        assert!(report.findings.iter().all(is_note), "{report:?}");
        model.check(&open(dir.path()));
    }
}

/// Whoever is about to drive for long says so, and nobody waits.
#[test]
fn a_store_that_is_held_for_a_drive_is_refused_at_once() {
    let dir = scratch();
    let mut store = open(dir.path());
    store.import(&world(3, 5), &change("первая")).unwrap();
    store.set_out().unwrap();
    let begun = std::time::Instant::now();
    let Err(refused) = Store::open(dir.path()) else { panic!("opened twice") };
    assert!(matches!(refused, StoreError::Locked { drives: true, .. }), "{refused}");
    assert!(refused.to_string().contains("ведёт робота"), "{refused}");
    assert!(begun.elapsed().as_millis() < 1000);
    let (asked, _) = Store::open_to_ask(dir.path()).unwrap();
    assert_eq!(load(&asked), load(&store));
    store.come_back();
    store.put_down();
    assert!(matches!(store.set_out(), Err(StoreError::Locked { .. })));
    let mut other = open(dir.path());
    assert!(matches!(store.set_out(), Err(StoreError::Locked { drives: false, .. })));
    other.set_out().unwrap();
    assert!(matches!(store.set_out(), Err(StoreError::Locked { drives: true, .. })));
}

/// A short call of another program is waited for.
#[test]
fn a_call_waits_for_the_call_of_another_program() {
    let dir = scratch();
    let mut store = open(dir.path());
    store.import(&world(3, 5), &change("первая")).unwrap();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(std::time::Duration::from_millis(300));
            store.put_down();
        });
        open(dir.path()).import(&world(4, 5), &change("вторая")).unwrap();
    });
    assert_eq!(store.follow().unwrap(), Meanwhile::Records);
    assert_eq!(store.revision(), 2);
}

/// A store that was put back from a backup while it was put down is another.
#[test]
fn another_store_in_its_place_is_read_anew() {
    let dir = scratch();
    let at = dir.path().join("store");
    let mut store = open(&at);
    store.import(&world(3, 5), &change("первая")).unwrap();
    store.import(&world(4, 5), &change("вторая")).unwrap();
    store.put_down();
    std::fs::remove_dir_all(&at).unwrap();
    open(&at).import(&world(8, 6), &change("другая")).unwrap();
    assert_eq!(store.follow().unwrap(), Meanwhile::Anew);
    assert_eq!((store.revision(), load(&store)), (1, world(8, 6)));
    store.take_up().unwrap();
    store.import(&world(9, 6), &change("дальше")).unwrap();
    assert_eq!(store.revision(), 2);
}
