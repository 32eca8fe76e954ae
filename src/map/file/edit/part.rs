//! The part of a map that a file of edits speaks of, where it speaks of things and doors alone: the tree of a few records is
//! written and read, instead of that of the whole map.
//!
//! **Invariant**: what the steps make of the part is what they make of it in the whole map. A file that says more than that,
//! or whose names are not plain to see, has no such part.

use std::collections::BTreeSet;

use super::super::node::{Node, Value};
use super::Naming;
use crate::units::{AreaId, DoorId, ObjectId, ReplicaId, name_key};
use crate::{Area, Entity, Object, TypeLists, World};

/// Verbs of which the thing stands first, with the fields that name something else.
const VERBS: [(&str, &[&str]); 7] = [
    ("place", &["object", "area"]),
    ("move", &["area"]),
    ("turn", &[]),
    ("remove", &[]),
    ("rename", &[]),
    ("set", &[]),
    ("unset", &[]),
];

/// What stands beside the steps and changes nothing.
const BESIDE: [&str; 3] = ["format", "reason", "edit"];

/// Records that steps speak of.
#[derive(Default)]
struct Spoken {
    replicas: BTreeSet<ReplicaId>,
    doors: BTreeSet<DoorId>,
    objects: BTreeSet<ObjectId>,
    areas: BTreeSet<AreaId>,
}

/// The part of a world that these edits speak of, as a world; none where they reach further.
pub(super) fn part_of(world: &World, edits: &Node, naming: &Naming<'_>) -> Option<World> {
    if edits.entries().iter().any(|entry| !BESIDE.contains(&entry.key.as_str())) {
        return None;
    }
    let Value::List(steps) = &edits.entry("edit")?.node.value else { return None };
    let mut spoken = Spoken::default();
    for step in steps {
        spoken.hear(world, step, naming)?;
    }
    // A place at which something is served speaks of it by its name.
    let is_served = |id: &ReplicaId| world.places.values().any(|place| place.serves == Some(*id));
    if spoken.replicas.iter().any(is_served) {
        return None;
    }
    Some(spoken.part(world))
}

impl Spoken {
    fn hear(&mut self, world: &World, step: &Node, naming: &Naming<'_>) -> Option<()> {
        let text = |field: &str| step.entry(field).map(|entry| entry.node.text());
        if let Some(door) = text("state") {
            self.doors.insert(only(doors(world, door?, naming))?);
            if let Some(on) = text("on") {
                self.replicas.insert(only(replicas(world, on?, naming))?);
            }
            return Some(());
        }
        let mut verbs = VERBS.iter().filter(|(verb, _)| step.entry(verb).is_some());
        let (verb, fields) = verbs.next()?;
        if verbs.next().is_some() || ["side", "kind"].iter().any(|f| step.entry(f).is_some()) {
            return None;
        }
        // Where a room stands on its map is not part of it.
        if step.entry("pose").is_some() {
            return None;
        }
        let thing = text(verb)??;
        let bearers = naming.exact.find(world, thing);
        // What comes into a name that is borne already is to be told of with that.
        let named: Vec<ReplicaId> = bearers.iter().filter_map(replica).collect();
        match (*verb, &named[..]) {
            ("place", []) => {}
            ("place", _) => return None,
            (_, &[only]) => drop(self.replicas.insert(only)),
            // It was put there by a step before this one, or is spoken of in other words.
            _ => return None,
        }
        for field in *fields {
            let Some(name) = text(field) else { continue };
            match *field {
                "object" => {
                    let all = world.objects.values();
                    let all = all.map(|o| (o.id, [&*o.key, &o.name, &o.name_en]));
                    self.objects.insert(only(bearing(all, name?))?);
                }
                _ => {
                    let all = world.areas.values();
                    let all = all.map(|a| (a.id, [&*a.key, &a.name, &a.name_en]));
                    self.areas.insert(only(bearing(all, name?))?);
                }
            }
        }
        Some(())
    }

    fn part(mut self, world: &World) -> World {
        let mut part = World::empty();
        for id in &self.replicas {
            let Some(replica) = world.replicas.get(id) else { continue };
            self.areas.insert(replica.area);
            self.objects.insert(replica.object);
            self.doors.extend(replica.door_states.keys());
            part.replicas.insert(*id, replica.clone());
        }
        for object in self.objects.iter().filter_map(|id| world.objects.get(id)) {
            self.doors.extend(object.doors.iter().map(|mount| mount.door));
            part.objects.insert(
                object.id,
                Object {
                    object_type: None,
                    items: Vec::new(),
                    links: Vec::new(),
                    front: None,
                    back: None,
                    doors: Vec::new(),
                    ..object.clone()
                },
            );
        }
        for area in self.areas.iter().filter_map(|id| world.areas.get(id)) {
            let area = Area {
                area_type: None,
                items: Vec::new(),
                links: Vec::new(),
                doors: Vec::new(),
                ..area.clone()
            };
            part.areas.insert(area.id, area);
        }
        for door in self.doors.iter().filter_map(|id| world.doors.get(id)) {
            part.doors.insert(door.id, door.clone());
        }
        part.types = TypeLists { door: world.types.door.clone(), ..TypeLists::default() };
        part
    }
}

fn only<T>(all: Vec<T>) -> Option<T> {
    let mut all = all.into_iter();
    let first = all.next()?;
    all.next().is_none().then_some(first)
}

fn replica(entity: &Entity) -> Option<ReplicaId> {
    if let Entity::Replica(id) = entity { Some(*id) } else { None }
}

fn replicas(world: &World, name: &str, naming: &Naming<'_>) -> Vec<ReplicaId> {
    naming.exact.find(world, name).iter().filter_map(replica).collect()
}

/// Doors by their names and keys, else in other words.
fn doors(world: &World, name: &str, naming: &Naming<'_>) -> Vec<DoorId> {
    let all = world.doors.values().map(|d| (d.id, [&*d.key, &d.name, &d.name_en]));
    let found = bearing(all, name);
    if !found.is_empty() {
        return found;
    }
    let door = |entity: Entity| if let Entity::Door(id) = entity { Some(id) } else { None };
    (naming.in_other_words)(name).into_iter().filter_map(door).collect()
}

/// The records that bear a name: the one whose key it is, else all that bear anything like it.
fn bearing<'w, Id: Copy>(all: impl Iterator<Item = (Id, [&'w str; 3])>, name: &str) -> Vec<Id> {
    let wanted = name_key(name);
    let mut found = Vec::new();
    for (id, names) in all {
        if names[0] == name {
            return vec![id];
        }
        if names.iter().any(|n| !n.is_empty() && name_key(n) == wanted) {
            found.push(id);
        }
    }
    found
}

/// The world with what became of a part of it.
pub(super) fn with_part(world: &World, before: &World, after: &World) -> World {
    let mut whole = world.clone();
    for (id, _, is) in before.replicas.changes(&after.replicas) {
        match is {
            Some(replica) => drop(whole.replicas.insert(id, replica.clone())),
            None => drop(whole.replicas.remove(&id)),
        }
    }
    for (id, _, is) in before.doors.changes(&after.doors) {
        if let Some(door) = is {
            whole.doors.insert(id, door.clone());
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::super::{EditReading, NextIds, Work};
    use super::*;
    use crate::dice::dice;
    use crate::units::Source;
    use crate::{Format, NameIndex};

    /// A step of some sort, sound or not.
    fn step(world: &World, throw: &mut impl FnMut(usize) -> usize) -> String {
        let names: Vec<&str> = world.names().map(|(_, name)| name).collect();
        let things: Vec<&str> = world.replicas.values().map(|r| r.name.as_str()).collect();
        let areas: Vec<&str> = world.areas.values().map(|a| a.key.as_str()).collect();
        let objects: Vec<&str> = world.objects.values().map(|o| o.key.as_str()).collect();
        let doors: Vec<&str> = world.doors.values().map(|d| d.name.as_str()).collect();
        let pick =
            |throw: &mut dyn FnMut(usize) -> usize, all: &[&str]| all[throw(all.len())].to_owned();
        let any = throw(8) == 0;
        let thing = pick(throw, if any { &names } else { &things });
        let (x, y) = (throw(500) as i64 - 60, throw(500) as i64 - 60);
        match throw(12) {
            0 => format!("move = \"{thing}\"\nby = [{}, {}]\n", x % 20, y % 20),
            1 => format!("move = \"{thing}\"\nto = [{x}, {y}]\ncarry = true\n"),
            2 => {
                let area = pick(throw, &areas);
                format!("move = \"{thing}\"\nto = [{x}, {y}]\narea = \"{area}\"\n")
            }
            3 => format!("turn = \"{thing}\"\nby = {x}\n"),
            4 => format!("remove = \"{thing}\"\n"),
            5 => {
                let to = [pick(throw, &names), format!("Вещь-{}", throw(9))][throw(2)].clone();
                format!("rename = \"{thing}\"\nto = \"{to}\"\n")
            }
            6 => format!("rename = \"{thing}\"\nen = \"Thing {}\"\n", throw(9)),
            7 => format!("set = \"{thing}\"\nproperty = \"ЦВЕТ\"\nvalue = \"Красный\"\n"),
            8 => format!("unset = \"{thing}\"\nproperty = \"ЦВЕТ\"\n"),
            9 => format!("set = \"{thing}\"\nmove_prob = {}\n", throw(140)),
            10 => {
                let (door, is) = (pick(throw, &doors), ["open", "closed", "ajar"][throw(3)]);
                let on = [String::new(), format!("on = \"{thing}\"\n")][throw(2)].clone();
                format!("state = \"{door}\"\nis = \"{is}\"\n{on}")
            }
            _ => {
                let (object, area) = (pick(throw, &objects), pick(throw, &areas));
                let name = [thing, format!("Вещь-{}", throw(9))][throw(2)].clone();
                let place = format!("object = \"{object}\"\narea = \"{area}\"\nat = [{x}, {y}]\n");
                format!("place = \"{name}\"\n{place}")
            }
        }
    }

    /// Worked into the part of which it speaks, an edit comes to the same map and the same faults, at the same places, as
    /// worked into the whole.
    #[test]
    fn a_part_comes_to_what_the_whole_comes_to() {
        for (seed, map) in ["rb2", "lab", "two-storeys"].into_iter().enumerate() {
            let mut throw = dice(seed as u64 + 3);
            let path = format!("../../maps/{map}.toml");
            let mut world = World::load(&path).expect("a map of the project");
            let (mut parts, mut sound, mut faulty) = (0, 0, 0);
            for turn in 0..150 {
                let mut text = String::new();
                for _ in 0..=throw(3) {
                    let _ = write!(text, "[[edit]]\n{}", step(&world, &mut throw));
                }
                let source = Source::new("edit.toml", text.clone());
                let edits = super::super::node::parse(&text, Format::Toml).expect("it is TOML");
                let (exact, ids) = (NameIndex::of(&world), NextIds::after(&world));
                let naming = Naming { exact: &exact, in_other_words: &|_| Vec::new() };
                let (world_now, judge) = (&world, &|_: &World| Vec::new());
                let (source, edits, ids) = (&source, &edits, &ids);
                let work = Work { world: world_now, source, edits, ids, naming, judge };
                let whole = work.on(&world, false).expect("the whole is gone through");
                let part = part_of(&world, edits, &naming).and_then(|part| work.on(&part, true));
                if let Some(part) = part {
                    parts += 1;
                    let told = |reading: &EditReading| -> Vec<String> {
                        let faults = reading.faults.faults.iter();
                        faults.map(|f| format!("{f} {:?}", f.spans)).collect()
                    };
                    assert_eq!(told(&part), told(&whole), "{map}, {turn}: {text}");
                    assert_eq!(part.world, whole.world, "{map}, {turn}: {text}");
                    assert_eq!(part.carriers, whole.carriers, "{map}, {turn}: {text}");
                    (sound, faulty) = match part.world {
                        Some(_) => (sound + 1, faulty),
                        None => (sound, faulty + 1),
                    };
                }
                if let Some(edited) = whole.world.filter(|w| w.replicas.len() > 4) {
                    world = edited;
                }
            }
            assert!(parts > 50 && sound > 15 && faulty > 10, "{map}: {parts} {sound} {faulty}");
        }
    }
}
