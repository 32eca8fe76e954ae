//! The faults that an edit would make: looked for where it changed something.
//!
//! **Invariant**: of a map that has passed every check, they are those of [`check`] after the edit that it does not find
//! before; see `whole_news`.

use std::collections::BTreeSet;

use crate::fault::{Fault, Record, Spot};
use crate::units::{DoorId, ReplicaId};
use crate::{Entity, NameIndex, Replica, World};

use super::{Checker, check};

/// The faults that a map has after an edit, and had not before. Where things and the states of doors alone differ, only
/// these are checked: it costs what was changed. `names` is asked for the names of the map before, where one of them changed.
#[must_use]
pub fn news(before: &World, after: &World, names: impl FnOnce() -> NameIndex) -> Vec<Fault> {
    if !before.is_same_building(after) {
        return whole_news(before, after);
    }
    let changes = before.replicas.changes(&after.replicas);
    let both = |r: Option<&Replica>| r.map(|r| (r.name.clone(), r.name_en.clone()));
    let mut ids: BTreeSet<ReplicaId> = changes.iter().map(|(id, ..)| *id).collect();
    let doors = before.doors.changes(&after.doors).into_iter().map(|(id, ..)| id).collect();
    let renamed = changes.iter().map(|(_, was, is)| (both(*was), both(*is)));
    let renamed: Vec<_> = renamed.filter(|(was, is)| was != is).collect();
    if renamed.is_empty() {
        let asked = Asked { ids: &ids, doors: &doors, names: None };
        return without(asked.of(after), &asked.of(before));
    }
    let bearers = names();
    let mut bearers_after = bearers.clone();
    bearers_after.follow(before, after);
    let spoken = renamed.iter().flat_map(|(was, is)| [was, is]).flatten();
    let spoken: BTreeSet<&str> =
        spoken.flat_map(|(name, name_en)| [name.as_str(), name_en.as_str()]).collect();
    let names = Some((&spoken, &bearers_after));
    let after_faults = Asked { ids: &ids, doors: &doors, names }.of(after);
    // What is said of a thing is known if it was said of another of that name.
    let twins = renamed.iter().filter_map(|(_, is)| is.as_ref()).flat_map(|(name, _)| {
        let twin = |entity| match entity {
            Entity::Replica(id) if before.replicas[&id].name == *name => Some(id),
            _ => None,
        };
        bearers.find(before, name).into_iter().filter_map(twin)
    });
    ids.extend(twins);
    let names = Some((&spoken, &bearers));
    let known = Asked { ids: &ids, doors: &doors, names }.of(before);
    without(after_faults, &known)
}

/// The same by checking both maps whole.
#[must_use]
pub(super) fn whole_news(before: &World, after: &World) -> Vec<Fault> {
    without(check(after), &check(before))
}

fn without(faults: Vec<Fault>, known: &[Fault]) -> Vec<Fault> {
    faults.into_iter().filter(|f| !known.iter().any(|k| k.error == f.error)).collect()
}

/// What may have changed.
struct Asked<'a> {
    ids: &'a BTreeSet<ReplicaId>,
    doors: &'a BTreeSet<DoorId>,
    /// Names that something bore or bears now, and who bears them; none where no name changed.
    names: Option<(&'a BTreeSet<&'a str>, &'a NameIndex)>,
}

impl Asked<'_> {
    /// What [`check`] finds of it, in the same order.
    fn of(&self, world: &World) -> Vec<Fault> {
        let broken = BTreeSet::new();
        let mut checker = Checker::new(world, &broken);
        let replicas = || self.ids.iter().filter_map(|id| world.replicas.get(id));
        let objects = replicas().filter_map(|r| world.objects.get(&r.object)).map(|o| &o.items);
        let areas = replicas().filter_map(|r| world.areas.get(&r.area)).map(|a| &a.items);
        let meant = |place: &crate::Place| place.serves.is_some_and(|id| self.ids.contains(&id));
        let rooms = world.places.values().filter(|place| self.names.is_some() && meant(place));
        let rooms = rooms.filter_map(|place| world.areas.get(&place.area)).map(|a| &a.items);
        let items = objects.chain(areas).chain(rooms).flatten();
        checker.judge_bases(items.map(|item| item.orthoframe));
        for door in self.doors.iter().filter_map(|id| world.doors.get(id)) {
            checker.door(door, &Spot::of(Record::Door(door.id)));
        }
        checker.some_replicas(self.ids);
        if let Some((spoken, bearers)) = self.names {
            checker.places(meant);
            checker.some_names(spoken, bearers, self.ids);
        }
        checker.faults
    }
}

#[cfg(test)]
mod tests {
    use super::whole_news;
    use crate::dice::dice;
    use crate::units::{AreaId, Deg, DoorId, Frame, ObjectId, ReplicaId};
    use crate::{DoorState, DoorStatus, MapErrors, NameIndex, Replica, World, check, news};

    /// One edit, sound or not.
    fn alter(world: &mut World, throw: &mut impl FnMut(usize) -> usize) {
        let ids: Vec<ReplicaId> = world.replicas.keys().copied().collect();
        let [one, other] = [0, 1].map(|_| ids[throw(ids.len())]);
        let other = world.replicas[&other].clone();
        let doors: Vec<DoorId> = world.doors.keys().copied().collect();
        let door = doors[throw(doors.len())];
        let areas: Vec<AreaId> = world.areas.keys().copied().collect();
        let replica = world.replicas.get_mut(&one).expect("chosen among them");
        let (x, y) = (throw(900) as f64 - 200.0, throw(900) as f64 - 200.0);
        let z = [replica.frame.z.get(), throw(300) as f64 - 20.0][throw(2)];
        match throw(13) {
            0..=3 => replica.frame = Frame::new(x, y, z, Deg::of(throw(4) as f64 * 45.0)),
            4 => replica.area = areas[throw(areas.len())],
            5 => replica.name = [other.name, format!("Вещь-{}", throw(50))][throw(2)].clone(),
            6 => replica.name_en = [other.name_en, other.name][throw(2)].clone(),
            7 => drop(world.replicas.remove(&one)),
            8 => {
                let id = ReplicaId(ids[ids.len() - 1].0 + 1);
                let name = [other.name.clone(), format!("Вещь-{}", throw(50)), String::new()];
                let name = name[throw(3)].clone();
                world.replicas.insert(id, Replica { id, name, name_en: String::new(), ..other });
            }
            9 => replica.move_prob = throw(150) as u8,
            10 => {
                let id = [door, DoorId(9_999)][throw(2)];
                let opening = throw(130) as f64;
                let state = DoorState { status: DoorStatus::Open, opening };
                replica.door_states.insert(id, state);
            }
            11 => {
                let door = world.doors.get_mut(&door).expect("chosen among them");
                door.state.opening = throw(130) as f64;
            }
            _ => match throw(6) {
                0 => replica.object = ObjectId(9_999),
                1 => replica.area = AreaId(9_999),
                2 => world.places.values_mut().for_each(|p| p.serves = Some(one)),
                3 => world.areas.values_mut().for_each(|a| a.description.push('!')),
                _ => replica.object = other.object,
            },
        }
    }

    /// What an edit would spoil is found in what it changes as by checking the whole map, whatever was already odd in it.
    #[test]
    fn what_changed_is_checked_as_the_whole_is() {
        for (seed, map) in ["../../maps/rb2.toml", "../../maps/lab.toml"].into_iter().enumerate() {
            let mut throw = dice(seed as u64 + 11);
            let first = World::load(map).expect("a map of the project");
            let (mut sound, mut faulty, mut odd) = (0, 0, 0);
            let mut before = first.clone();
            for step in 0..700 {
                let mut after = before.clone();
                for _ in 0..=throw(3) {
                    alter(&mut after, &mut throw);
                }
                let found = news(&before, &after, || NameIndex::of(&before));
                assert_eq!(found, whole_news(&before, &after), "{map}, step {step}");
                odd += usize::from(!found.is_empty());
                if !(MapErrors { source: None, faults: check(&after) }).has_errors() {
                    (before, sound) = (after, sound + 1);
                } else {
                    faulty += 1;
                }
                if step % 100 == 99 || before.replicas.len() < 4 {
                    before = first.clone();
                }
            }
            assert!(sound > 50 && faulty > 50 && odd > 100, "{sound} {faulty} {odd}");
        }
    }
}
