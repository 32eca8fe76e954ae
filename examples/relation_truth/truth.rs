//! What the makers of a world say of it, beside what the rules derive from its geometry.
//!
//! The readers of [`orthoframe_exchange`] read no relation between things; here the same files are read a second time,
//! for their relations alone, and the ids that both have in common (the property ИСТОЧНИК) tie the two together.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::path::Path;

use orthoframe_exchange::{Options, read};
use orthoframe_facts as facts;
use orthoframe_map::{Properties, World};
use orthoframe_semantics::{Profile, RelationRules, Relations, derive};
use orthoframe_units::Source;
use serde_json::Value;

/// The property under which an import keeps the file's own id.
const SOURCE: &str = "ИСТОЧНИК";
/// VirtualHome's categories that are parts of the building, not things in it.
const STRUCTURE: [&str; 8] =
    ["Rooms", "Floor", "Floors", "Walls", "Ceiling", "Doors", "Windows", "Characters"];

type Pair = (String, String);

/// One relation of the data against one relation of the rules, over all files of a data set.
#[derive(Debug, Clone, Default)]
pub(crate) struct Comparison {
    pub(crate) data: &'static str,
    pub(crate) profile: &'static str,
    /// As the data has it.
    pub(crate) relation: &'static str,
    /// The relation of the rules.
    pub(crate) by: &'static str,
    pub(crate) both: usize,
    /// In the data, not derived.
    pub(crate) missed: Vec<String>,
    /// Derived, not in the data.
    pub(crate) surplus: Vec<String>,
}

impl Comparison {
    #[must_use]
    pub(crate) fn precision(&self) -> f64 {
        share(self.both, self.both + self.surplus.len())
    }

    #[must_use]
    pub(crate) fn recall(&self) -> f64 {
        share(self.both, self.both + self.missed.len())
    }

    #[must_use]
    pub(crate) fn f_score(&self) -> f64 {
        share(2 * self.both, 2 * self.both + self.missed.len() + self.surplus.len())
    }

    fn add(&mut self, file: &str, truth: &BTreeSet<Pair>, derived: &BTreeSet<Pair>) {
        let words = |(a, b): &Pair| format!("{file}: {a} - {b}");
        self.both += truth.intersection(derived).count();
        self.missed.extend(truth.difference(derived).map(words));
        self.surplus.extend(derived.difference(truth).map(words));
    }
}

fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 1.0 } else { part as f64 / whole as f64 }
}

/// A world with the file's own ids of what is in it.
struct Imported {
    world: World,
    /// Our name → the file's id.
    ids: BTreeMap<String, String>,
}

impl Imported {
    fn read(path: &Path) -> Result<Self, Box<dyn Error>> {
        let world = read(path, &Options::default())?.world;
        let mut ids = BTreeMap::new();
        let mut note = |name: &str, properties: &Properties| {
            if let Some(id) = properties.get(SOURCE) {
                ids.insert(name.to_owned(), id.clone());
            }
        };
        world.replicas.values().for_each(|r| note(&r.name, &r.properties));
        world.areas.values().for_each(|a| note(&a.name, &a.properties));
        world.doors.values().for_each(|d| note(&d.name, &d.properties));
        Ok(Self { world, ids })
    }

    /// The file's id of what a fact names.
    fn id(&self, value: &facts::Value) -> Option<String> {
        match value {
            facts::Value::Symbol(name) => self.ids.get(name.as_ref()).cloned(),
            _ => None,
        }
    }

    /// The pairs of a relation, as the file's ids.
    fn pairs(&self, relations: &Relations, name: &str) -> Result<BTreeSet<Pair>, Box<dyn Error>> {
        let pair = |tuple: Vec<facts::Value>| Some((self.id(&tuple[0])?, self.id(&tuple[1])?));
        Ok(relations.tuples(name)?.into_iter().filter_map(pair).collect())
    }

    /// For each door or passage the Areas that it joins, both ways.
    fn joined(&self, relations: &Relations) -> Result<BTreeSet<(String, Pair)>, Box<dyn Error>> {
        let join =
            |t: Vec<facts::Value>| Some((self.id(&t[0])?, (self.id(&t[1])?, self.id(&t[2])?)));
        Ok(relations.tuples("JOINS")?.into_iter().filter_map(join).collect())
    }
}

const PROFILES: [(Profile, &str); 2] =
    [(Profile::Surveyed, "surveyed"), (Profile::Detected, "detected")];

fn json(path: &Path) -> Result<Value, Box<dyn Error>> {
    Ok(serde_json::from_str(&std::fs::read_to_string(path)?)?)
}

fn list<'v>(value: &'v Value, field: &str) -> &'v [Value] {
    value.get(field).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

fn id(value: &Value, field: &str) -> String {
    match value.get(field) {
        Some(Value::String(text)) => text.clone(),
        Some(other) => other.to_string(),
        None => String::new(),
    }
}

/// ProcTHOR: the receptacle of each thing is its parent, on or in; its id names its room; a door names its two.
///
/// # Errors
/// A file cannot be read, or the rules do not hold.
pub(crate) fn procthor(data: &Path) -> Result<Vec<Comparison>, Box<dyn Error>> {
    let row = |profile, relation, by| Comparison {
        data: "ProcTHOR",
        profile,
        relation,
        by,
        ..Comparison::default()
    };
    let rules = RelationRules::standard();
    let mut found = Vec::new();
    for (profile, name) in PROFILES {
        let mut held = row(name, "parent: on or in", "LIES_ON_OR_IN");
        let mut rooms = row(name, "room of a thing", "INSIDE");
        let mut doors = row(name, "room0 and room1 of a door", "JOINS");
        for n in 0..10 {
            let file = format!("house_{n}");
            let path = data.join("procthor").join(format!("{file}.json"));
            let truth = House::of(&json(&path)?);
            let imported = Imported::read(&path)?;
            let relations = derive(&imported.world, &rules, profile)?;
            held.add(&file, &truth.parents, &imported.pairs(&relations, "LIES_ON_OR_IN")?);
            let inside = imported.pairs(&relations, "INSIDE")?;
            let in_room = inside.into_iter().filter(|(_, r)| r.starts_with("room|")).collect();
            rooms.add(&file, &truth.rooms, &in_room);
            doors.add(&file, &truth.doors, &both_ways(imported.joined(&relations)?));
        }
        found.extend([held, rooms, doors]);
    }
    Ok(found)
}

/// A door with its rooms as one pair: the door, and the rooms in the order of their ids.
fn both_ways(joined: BTreeSet<(String, Pair)>) -> BTreeSet<Pair> {
    let in_order =
        |(o, (a, b)): (String, Pair)| (o, format!("{} + {}", (&a).min(&b), (&a).max(&b)));
    joined.into_iter().map(in_order).collect()
}

#[derive(Default)]
struct House {
    parents: BTreeSet<Pair>,
    rooms: BTreeSet<Pair>,
    doors: BTreeSet<Pair>,
}

impl House {
    fn of(house: &Value) -> Self {
        let mut found = Self::default();
        for object in list(house, "objects") {
            found.thing(object, None);
        }
        for door in list(house, "doors") {
            let (a, b) = (id(door, "room0"), id(door, "room1"));
            if a != b {
                let rooms = format!("{} + {}", (&a).min(&b), (&a).max(&b));
                found.doors.insert((id(door, "id"), rooms));
            }
        }
        // An empty wall stands once for each of its rooms, "wall|6|1.74|5.22|3.48|5.22"; the first is its passage.
        let mut empty: BTreeMap<String, (String, String)> = BTreeMap::new();
        for wall in list(house, "walls").iter().filter(|w| w["empty"] == true) {
            let (own, room) = (id(wall, "id"), id(wall, "roomId"));
            let ends = own.splitn(3, '|').nth(2).unwrap_or_default().to_owned();
            match empty.remove(&ends) {
                Some((first, other)) => {
                    let rooms = format!("{} + {}", (&room).min(&other), (&room).max(&other));
                    found.doors.insert((own.min(first), rooms));
                }
                None => drop(empty.insert(ends, (own, room))),
            }
        }
        found
    }

    fn thing(&mut self, object: &Value, parent: Option<&str>) {
        let own = id(object, "id");
        if let Some(room) = own.split('|').nth(1) {
            self.rooms.insert((own.clone(), format!("room|{room}")));
        }
        if let Some(parent) = parent {
            self.parents.insert((own.clone(), parent.to_owned()));
        }
        for child in list(object, "children") {
            self.thing(child, Some(&own));
        }
    }
}

/// VirtualHome: edges between things, and between things and rooms.
///
/// Rows by VH_… are by the file's own definitions, written over the same measurements in `rules/truth/virtualhome.dl`.
/// Things that the import left out (a prefab and its part in the same place are one thing) take no part.
///
/// # Errors
/// A file cannot be read, or the rules do not hold.
pub(crate) fn virtualhome(data: &Path) -> Result<Vec<Comparison>, Box<dyn Error>> {
    const ROWS: [(&str, &str); 9] = [
        ("INSIDE a thing or room", "VH_INSIDE, INSIDE"),
        ("INSIDE a thing", "VH_INSIDE"),
        ("INSIDE a thing", "INSIDE"),
        ("INSIDE a room", "INSIDE"),
        ("CLOSE", "VH_CLOSE"),
        ("CLOSE", "CLOSE_TO"),
        ("ON", "VH_ON"),
        ("ON", "RESTS_ON"),
        ("ON or INSIDE, through chains", "RESTS_ON, INSIDE"),
    ];
    let own = include_str!("../../rules/truth/virtualhome.dl");
    let rules = RelationRules::with(&Source::new("rules/truth/virtualhome.dl", own))?;
    let mut found = Vec::new();
    for (profile, name) in PROFILES {
        let row = |relation, by| Comparison {
            data: "VirtualHome",
            profile: name,
            relation,
            by,
            ..Comparison::default()
        };
        let mut rows = ROWS.map(|(relation, by)| row(relation, by));
        let mut doors = row("BETWEEN a door and rooms", "JOINS");
        for n in 1..=3 {
            let file = format!("scene_{n}");
            let path = data.join("virtualhome").join(format!("TestScene{n}_graph.json"));
            let imported = Imported::read(&path)?;
            let graph = Graph::of(&json(&path)?, &imported);
            let relations = derive(&imported.world, &rules, profile)?;
            let pairs = |name: &str| imported.pairs(&relations, name);
            let is_room = |p: &Pair| graph.rooms.contains(&p.1);
            let (in_room, in_thing): (BTreeSet<Pair>, BTreeSet<Pair>) =
                pairs("INSIDE")?.into_iter().partition(is_room);
            let (truth_room, truth_thing): (BTreeSet<Pair>, BTreeSet<Pair>) =
                graph.edges("INSIDE").into_iter().partition(is_room);
            let vh_inside = pairs("VH_INSIDE")?;
            let supports = pairs("RESTS_ON")?;
            let truth_held = chains(graph.edges("ON").union(&truth_thing));
            let held = chains(supports.union(&in_thing));
            let all = |a: &BTreeSet<Pair>, b: &BTreeSet<Pair>| a.union(b).cloned().collect();
            let derived: [(BTreeSet<Pair>, BTreeSet<Pair>); 9] = [
                (all(&truth_thing, &truth_room), all(&vh_inside, &in_room)),
                (truth_thing.clone(), vh_inside),
                (truth_thing, in_thing),
                (truth_room, in_room),
                (graph.edges("CLOSE"), pairs("VH_CLOSE")?),
                (graph.edges("CLOSE"), pairs("CLOSE_TO")?),
                (graph.edges("ON"), pairs("VH_ON")?),
                (graph.edges("ON"), supports),
                (truth_held, held),
            ];
            for (row, (truth, derived)) in rows.iter_mut().zip(&derived) {
                row.add(&file, &graph.named(truth), &graph.named(derived));
            }
            let joined: BTreeSet<Pair> =
                imported.joined(&relations)?.into_iter().map(|(o, (a, _))| (o, a)).collect();
            // A door into the open is between nothing.
            doors.add(&file, &graph.named(&graph.between), &graph.named(&joined));
        }
        found.extend(rows);
        found.push(doors);
    }
    Ok(found)
}

/// Everything that follows when a holds b and b holds c says that a holds c; what would hold itself is left out.
fn chains<'p>(pairs: impl Iterator<Item = &'p Pair>) -> BTreeSet<Pair> {
    let mut holders: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (a, b) in pairs {
        holders.entry(a).or_default().insert(b);
    }
    let mut found = BTreeSet::new();
    for &a in holders.keys() {
        let mut waiting = vec![a];
        while let Some(here) = waiting.pop() {
            for &b in holders.get(here).into_iter().flatten() {
                if b != a && found.insert((a.to_owned(), b.to_owned())) {
                    waiting.push(b);
                }
            }
        }
    }
    found
}

struct Graph {
    edges: BTreeMap<String, BTreeSet<Pair>>,
    between: BTreeSet<Pair>,
    rooms: BTreeSet<String>,
    words: BTreeMap<String, String>,
}

impl Graph {
    fn of(graph: &Value, imported: &Imported) -> Self {
        let arrived: BTreeSet<&str> = imported.ids.values().map(String::as_str).collect();
        let (mut rooms, mut things) = (BTreeSet::new(), BTreeSet::new());
        let mut words = BTreeMap::new();
        for node in list(graph, "nodes") {
            let (own, category) = (id(node, "id"), id(node, "category"));
            words.insert(own.clone(), format!("{} {own}", id(node, "class_name")));
            if category == "Rooms" {
                rooms.insert(own);
            } else if !STRUCTURE.contains(&category.as_str()) && arrived.contains(own.as_str()) {
                things.insert(own);
            }
        }
        let mut edges: BTreeMap<String, BTreeSet<Pair>> = BTreeMap::new();
        let mut between = BTreeSet::new();
        for edge in list(graph, "edges") {
            let (from, to) = (id(edge, "from_id"), id(edge, "to_id"));
            let relation = id(edge, "relation_type");
            if relation == "BETWEEN" {
                between.insert((from, to));
            } else if things.contains(&from) && (things.contains(&to) || rooms.contains(&to)) {
                edges.entry(relation).or_default().insert((from, to));
            }
        }
        Self { edges, between, rooms, words }
    }

    fn edges(&self, relation: &str) -> BTreeSet<Pair> {
        self.edges.get(relation).cloned().unwrap_or_default()
    }

    /// Ids with their words, for people.
    fn named(&self, pairs: &BTreeSet<Pair>) -> BTreeSet<Pair> {
        let word = |id: &String| self.words.get(id).unwrap_or(id).clone();
        pairs.iter().map(|(a, b)| (word(a), word(b))).collect()
    }
}
