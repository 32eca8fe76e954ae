//! The part of a map that a file of edits speaks of: the tree of a few records is written and read, instead of that of the
//! whole map.
//!
//! Of every name that the file says, wherever it says it, the part has all that bear it; with these what they refer to, and
//! what refers to them where the edits follow that: places that serve a thing, links of an Area; where something is taken
//! away, all that goes with it and one of those that cannot be without it. What is only referred to is a stub: a name, and
//! what a reference to it says.
//!
//! **Invariant**: what the steps make of the part is what they make of it in the whole map, where all goes smoothly.

use std::collections::{BTreeSet, HashSet};

use super::super::node::{Node, Value};
use super::Naming;
use crate::fault::{Record, Spot, Step};
use crate::units::{
    AreaId, DoorId, MapId, ObjectId, OrFrId, PlaceId, ReplicaId, TypeId, ZoneId, name_key,
};
use crate::{
    Area, BaseVector, DoorMount, Entity, Extent, Item, Map, MapItem, MapLink, Object, Orthoframe,
    TypeKind, World,
};

/// Steps whose own name is a new one, or is no name: it means nothing in other words.
const NAMING: [&str; 5] = ["place", "point", "item", "link", "lift"];
/// Fields of a step that name something which is there.
const REFERENCES: [&str; 8] = ["area", "of", "from", "to", "on", "map", "rooms", "stops"];
/// Steps that strike something out of what others say.
const TAKING: [&str; 2] = ["remove", "unbind"];

/// Some records of a world, as a world.
pub(super) struct Part {
    pub(super) world: World,
    stubs: Stubs,
}

/// What is in a part with its name alone.
#[derive(Default)]
struct Stubs {
    areas: BTreeSet<AreaId>,
    objects: BTreeSet<ObjectId>,
    orthoframes: BTreeSet<OrFrId>,
}

/// The part of a world that these edits speak of; none where they number records themselves: any may have that number.
pub(super) fn part_of(world: &World, edits: &Node, naming: &Naming<'_>) -> Option<Part> {
    let mut said = Said::default();
    said.hear(edits)?;
    let steps = edits.entry("edit").map_or(&[][..], |entry| entry.node.elements());
    let has = |verbs: &[&str]| steps.iter().any(|s| verbs.iter().any(|v| s.entry(v).is_some()));
    let mut spoken = Spoken::default();
    for text in &said.texts {
        naming.exact.find(world, text).into_iter().for_each(|entity| spoken.add(entity));
    }
    spoken.add_keyed(world, &said.folded);
    spoken.add_in_other_words(world, steps, naming);

    let takes_away = has(&TAKING);
    let stubs = Stubs::default();
    let mut gathered = Gathered { whole: world, naming, part: World::empty(), stubs };
    gathered.types(&said.folded);
    spoken.areas.iter().for_each(|&id| gathered.area(id));
    spoken.objects.iter().for_each(|&id| gathered.object(id));
    spoken.orthoframes.iter().for_each(|&id| gathered.orthoframe(id));
    spoken.doors.iter().for_each(|&id| gathered.door(id));
    spoken.replicas.iter().for_each(|&id| gathered.replica(id));
    spoken.places.iter().for_each(|&id| gathered.place(id));
    gathered.zones(&spoken, takes_away);
    if takes_away {
        gathered.users(&spoken);
    }
    gathered.servants();
    let (reshapes, relinks) = (has(&["cut", "shape"]), has(&["cut", "shape", "relink"]));
    if reshapes {
        gathered.walls(&spoken);
    }
    gathered.frame(&spoken, takes_away || has(&["lift"]), relinks);
    Some(Part { world: gathered.part, stubs: gathered.stubs })
}

/// All texts of a file of edits: of any it may be that it is a name.
#[derive(Default)]
struct Said {
    texts: BTreeSet<String>,
    /// The same as [`name_key`] spells them.
    folded: HashSet<String>,
}

impl Said {
    fn hear(&mut self, node: &Node) -> Option<()> {
        match &node.value {
            Value::Text(text) => self.note(text),
            Value::List(elements) => elements.iter().try_for_each(|e| self.hear(e))?,
            Value::Table(entries) => {
                for entry in entries {
                    if entry.key == "id" && matches!(entry.node.value, Value::Integer(_)) {
                        return None;
                    }
                    self.note(&entry.key);
                    self.hear(&entry.node)?;
                }
            }
            _ => {}
        }
        Some(())
    }

    /// A text, what stands before any of its points («Комната-В.F»), and the key that a zone of that name gets.
    fn note(&mut self, text: &str) {
        let ends = text.match_indices('.').map(|(at, _)| text[..at].to_owned());
        let mut all: Vec<String> = ends.collect();
        if !all.is_empty() {
            all.push(text.replace('.', "-"));
        }
        all.push(text.to_owned());
        for text in all.into_iter().filter(|text| !text.is_empty()) {
            self.folded.insert(name_key(&text));
            self.texts.insert(text);
        }
    }
}

/// Records that edits speak of, or may.
#[derive(Default)]
struct Spoken {
    maps: BTreeSet<MapId>,
    areas: BTreeSet<AreaId>,
    objects: BTreeSet<ObjectId>,
    orthoframes: BTreeSet<OrFrId>,
    doors: BTreeSet<DoorId>,
    replicas: BTreeSet<ReplicaId>,
    places: BTreeSet<PlaceId>,
    zones: BTreeSet<ZoneId>,
}

impl Spoken {
    fn add(&mut self, entity: Entity) {
        match entity {
            Entity::Map(id) => drop(self.maps.insert(id)),
            Entity::Area(id) => drop(self.areas.insert(id)),
            Entity::Door(id) => drop(self.doors.insert(id)),
            Entity::Replica(id) => drop(self.replicas.insert(id)),
            Entity::Place(id) => drop(self.places.insert(id)),
            Entity::Zone(id) => drop(self.zones.insert(id)),
        }
    }

    /// What has one of these for its key; of Objects and Orthoframes, for a name too.
    fn add_keyed(&mut self, world: &World, folded: &HashSet<String>) {
        let is_said = |text: &str| folded.contains(&name_key(text));
        let keyed = |key: &str| is_said(key);
        self.maps.extend(world.maps.values().filter(|r| keyed(&r.key)).map(|r| r.id));
        self.areas.extend(world.areas.values().filter(|r| keyed(&r.key)).map(|r| r.id));
        self.doors.extend(world.doors.values().filter(|r| keyed(&r.key)).map(|r| r.id));
        self.zones.extend(world.zones.values().filter(|r| keyed(&r.key)).map(|r| r.id));
        let named = |names: [&String; 3]| names.into_iter().any(|name| is_said(name));
        let objects = world.objects.values().filter(|o| named([&o.key, &o.name, &o.name_en]));
        self.objects.extend(objects.map(|o| o.id));
        let parts = world.orthoframes.values().filter(|o| named([&o.key, &o.name, &o.name_en]));
        self.orthoframes.extend(parts.map(|o| o.id));
    }

    /// What is spoken of in other words, with all that bear its names.
    fn add_in_other_words(&mut self, world: &World, steps: &[Node], naming: &Naming<'_>) {
        let mut asked: Vec<&str> = Vec::new();
        for entry in steps.iter().flat_map(Node::entries) {
            let is_verb = super::steps::is_verb(&entry.key) && !NAMING.contains(&&*entry.key);
            if is_verb || REFERENCES.contains(&&*entry.key) {
                let listed = entry.node.elements().iter();
                asked.extend(listed.chain([&entry.node]).filter_map(Node::text));
            }
        }
        for text in asked {
            if !naming.exact.find(world, text).is_empty() {
                continue;
            }
            let mut folded = HashSet::new();
            for entity in (naming.in_other_words)(text) {
                let key = match entity {
                    Entity::Map(id) => world.maps.get(&id).map(|r| &r.key),
                    Entity::Area(id) => world.areas.get(&id).map(|r| &r.key),
                    Entity::Door(id) => world.doors.get(&id).map(|r| &r.key),
                    Entity::Zone(id) => world.zones.get(&id).map(|r| &r.key),
                    Entity::Replica(_) | Entity::Place(_) => None,
                };
                folded.extend(key.map(|key| name_key(key)));
                for name in world.both_names(entity).into_iter().filter(|name| !name.is_empty()) {
                    let all = naming.exact.find(world, name);
                    all.into_iter().for_each(|entity| self.add(entity));
                }
            }
            if !folded.is_empty() {
                self.add_keyed(world, &folded);
            }
        }
    }
}

/// A part in the making: a record comes with what it refers to.
struct Gathered<'w> {
    whole: &'w World,
    naming: &'w Naming<'w>,
    part: World,
    stubs: Stubs,
}

impl Gathered<'_> {
    fn area(&mut self, id: AreaId) {
        let Some(area) = self.whole.areas.get(&id) else { return };
        if self.part.areas.contains_key(&id) && !self.stubs.areas.remove(&id) {
            return;
        }
        self.part.areas.insert(id, area.clone());
        self.r#type(TypeKind::Area, area.area_type);
        area.items.iter().for_each(|item| self.stub_orthoframe(item.orthoframe));
        area.doors.iter().for_each(|mount| self.door(mount.door));
    }

    fn stub_area(&mut self, id: AreaId) {
        let Some(area) = self.whole.areas.get(&id) else { return };
        if self.part.areas.contains_key(&id) {
            return;
        }
        self.stubs.areas.insert(id);
        let (items, links, doors) = (Vec::new(), Vec::new(), Vec::new());
        let stub = Area { area_type: None, items, links, doors, ..area.clone() };
        self.part.areas.insert(id, stub);
    }

    fn object(&mut self, id: ObjectId) {
        let Some(object) = self.whole.objects.get(&id) else { return };
        if self.part.objects.contains_key(&id) && !self.stubs.objects.remove(&id) {
            return;
        }
        self.part.objects.insert(id, object.clone());
        self.r#type(TypeKind::Object, object.object_type);
        object.items.iter().for_each(|item| self.stub_orthoframe(item.orthoframe));
        object.doors.iter().for_each(|mount| self.door(mount.door));
    }

    fn stub_object(&mut self, id: ObjectId) {
        let Some(object) = self.whole.objects.get(&id) else { return };
        if self.part.objects.contains_key(&id) {
            return;
        }
        self.stubs.objects.insert(id);
        let (items, links, doors) = (Vec::new(), Vec::new(), Vec::new());
        let stub = Object {
            object_type: None,
            items,
            links,
            doors,
            front: None,
            back: None,
            ..object.clone()
        };
        self.part.objects.insert(id, stub);
    }

    fn orthoframe(&mut self, id: OrFrId) {
        let Some(part) = self.whole.orthoframes.get(&id) else { return };
        if self.part.orthoframes.contains_key(&id) && !self.stubs.orthoframes.remove(&id) {
            return;
        }
        self.part.orthoframes.insert(id, part.clone());
        self.r#type(TypeKind::Orthoframe, part.frame_type);
        self.r#type(TypeKind::Shape, part.shape);
        part.base.iter().for_each(|side| self.r#type(TypeKind::Side, side.side_type));
    }

    fn stub_orthoframe(&mut self, id: OrFrId) {
        let Some(part) = self.whole.orthoframes.get(&id) else { return };
        if self.part.orthoframes.contains_key(&id) {
            return;
        }
        self.stubs.orthoframes.insert(id);
        let plain = |side: &BaseVector| BaseVector { side_type: None, ..side.clone() };
        let base = part.base.iter().map(plain).collect();
        let stub = Orthoframe { frame_type: None, shape: None, base, ..part.clone() };
        self.part.orthoframes.insert(id, stub);
    }

    fn door(&mut self, id: DoorId) {
        let Some(door) = self.whole.doors.get(&id) else { return };
        self.part.doors.insert(id, door.clone());
        self.r#type(TypeKind::Door, door.door_type);
    }

    fn replica(&mut self, id: ReplicaId) {
        let Some(replica) = self.whole.replicas.get(&id) else { return };
        self.part.replicas.insert(id, replica.clone());
        self.stub_area(replica.area);
        self.stub_object(replica.object);
        replica.door_states.keys().for_each(|&door| self.door(door));
    }

    fn place(&mut self, id: PlaceId) {
        let Some(place) = self.whole.places.get(&id) else { return };
        self.part.places.insert(id, place.clone());
        self.stub_area(place.area);
        if let Some(served) = place.serves.and_then(|id| self.whole.replicas.get(&id)) {
            // It is spoken of by its name.
            for entity in self.naming.exact.find(self.whole, &served.name) {
                if let Entity::Replica(id) = entity {
                    self.replica(id);
                }
            }
        }
    }

    fn r#type(&mut self, kind: TypeKind, id: Option<TypeId>) {
        if let Some(entry) = self.whole.types.list(kind).get(id) {
            self.part.types.list_mut(kind).entries.insert(entry.id, entry.clone());
        }
    }

    /// The types that may be named.
    fn types(&mut self, folded: &HashSet<String>) {
        for kind in TypeKind::ALL {
            for entry in self.whole.types.list(kind).entries.values() {
                if [&entry.name, &entry.name_en].iter().any(|n| folded.contains(&name_key(n))) {
                    self.r#type(kind, Some(entry.id));
                }
            }
        }
    }

    /// The zones that are spoken of, and those of what may be taken away.
    fn zones(&mut self, spoken: &Spoken, takes_away: bool) {
        for zone in self.whole.zones.values() {
            let is_of = match &zone.extent {
                Extent::Areas(areas) => areas.iter().any(|area| spoken.areas.contains(area)),
                Extent::Polygon { map, .. } => spoken.maps.contains(map),
            };
            if spoken.zones.contains(&zone.id) || (takes_away && is_of) {
                self.part.zones.insert(zone.id, zone.clone());
                if let Extent::Areas(areas) = &zone.extent {
                    areas.iter().for_each(|&area| self.stub_area(area));
                }
            }
        }
    }

    /// What goes with the records that are spoken of if they go; and of those who cannot be without one, the first that does
    /// not go itself.
    fn users(&mut self, spoken: &Spoken) {
        let whole = self.whole;
        let hangs = |mounts: &[DoorMount]| mounts.iter().any(|m| spoken.doors.contains(&m.door));
        let mut unused = spoken.orthoframes.clone();
        let mut is_first =
            |items: &[Item]| items.iter().any(|item| unused.remove(&item.orthoframe));
        for area in whole.areas.values().filter(|area| !spoken.areas.contains(&area.id)) {
            if is_first(&area.items) || hangs(&area.doors) {
                self.area(area.id);
            }
        }
        for object in whole.objects.values().filter(|o| !spoken.objects.contains(&o.id)) {
            if is_first(&object.items) || hangs(&object.doors) {
                self.object(object.id);
            }
        }
        let (mut unused, mut unset) = (spoken.objects.clone(), spoken.doors.clone());
        for replica in whole.replicas.values().filter(|r| !spoken.replicas.contains(&r.id)) {
            if spoken.areas.contains(&replica.area)
                || unused.remove(&replica.object)
                || replica.door_states.keys().any(|door| unset.remove(door))
            {
                self.replica(replica.id);
            }
        }
        for place in whole.places.values().filter(|p| spoken.areas.contains(&p.area)) {
            self.place(place.id);
        }
    }

    /// The places at which things of the part are served: they speak of them by their names.
    fn servants(&mut self) {
        for place in self.whole.places.values() {
            if place.serves.is_some_and(|id| self.part.replicas.contains_key(&id)) {
                self.place(place.id);
            }
        }
    }

    /// The parts of Areas that are spoken of, to be changed: whole, each with one more that is made of it if there is any, and
    /// with those that have the key that a copy of it would get.
    fn walls(&mut self, spoken: &Spoken) {
        let whole = self.whole;
        let areas = || spoken.areas.iter().filter_map(|id| whole.areas.get(id));
        let items = || areas().flat_map(|area| area.items.iter().map(move |item| (area, item)));
        let mut shared: BTreeSet<OrFrId> = items().map(|(_, item)| item.orthoframe).collect();
        shared.iter().for_each(|&id| self.orthoframe(id));
        let mut uses = |items: &[Item]| items.iter().any(|item| shared.remove(&item.orthoframe));
        for area in whole.areas.values().filter(|area| !spoken.areas.contains(&area.id)) {
            if uses(&area.items) {
                self.area(area.id);
            }
        }
        for object in whole.objects.values() {
            if uses(&object.items) {
                self.object(object.id);
            }
        }
        let copies = items().map(|(area, item)| name_key(&format!("{}-{}", area.key, item.id)));
        let copies: Vec<String> = copies.collect();
        let is_like = |name: &str| copies.iter().any(|copy| name_key(name).starts_with(copy));
        let named = whole.orthoframes.values();
        let named = named.filter(|o| [&o.key, &o.name, &o.name_en].into_iter().any(|n| is_like(n)));
        named.for_each(|part| self.stub_orthoframe(part.id));
    }

    /// The robot, and how Maps make up the building; of each Map the items and links of Areas that are spoken of, and, where
    /// it `relinks` them, the items of those to which they are linked.
    fn frame(&mut self, spoken: &Spoken, with_lifts: bool, relinks: bool) {
        let whole = self.whole;
        self.part.robot = whole.robot.clone();
        if let Some(start) = whole.robot.start.and_then(|id| whole.places.get(&id)) {
            for entity in self.naming.exact.find(whole, &start.name) {
                if let Entity::Place(id) = entity {
                    self.place(id);
                }
            }
        }
        self.part.domain = whole.domain.clone();
        if with_lifts {
            for stop in whole.domain.lifts.iter().flat_map(|(_, stops)| stops) {
                self.stub_area(stop.area);
            }
        } else {
            self.part.domain.lifts.clear();
        }
        for map in whole.maps.values() {
            self.map(map, spoken, relinks);
        }
    }

    fn map(&mut self, map: &Map, spoken: &Spoken, relinks: bool) {
        let is_of = |link: &&MapLink| {
            spoken.areas.contains(&link.area) || spoken.areas.contains(&link.to_area)
        };
        let own = map.links.iter().filter(is_of).filter(|_| relinks);
        let linked: BTreeSet<AreaId> = own.flat_map(|link| [link.area, link.to_area]).collect();
        // The first one is the base where none is said to be, whichever are taken away.
        let first = spoken.areas.len() + 2;
        let is_in = |(no, item): &(usize, &MapItem)| {
            let is_asked = spoken.areas.contains(&item.area) || linked.contains(&item.area);
            *no < first || item.is_base || is_asked
        };
        let items = map.items.iter().enumerate().filter(is_in).map(|(_, item)| item.clone());
        let links = map.links.iter().filter(is_of).cloned();
        let part = Map { items: items.collect(), links: links.collect(), ..map.clone() };
        part.items.iter().for_each(|item| self.stub_area(item.area));
        // A link names the parts of an Area where there are several.
        part.links.iter().flat_map(|l| [l.area, l.to_area]).for_each(|area| self.area(area));
        self.r#type(TypeKind::Map, map.map_type);
        self.part.maps.insert(map.id, part);
    }
}

/// The world with what became of a part of it.
pub(super) fn with_part(world: &World, part: &Part, after: &World) -> World {
    let (before, stubs) = (&part.world, &part.stubs);
    let mut whole = world.clone();
    macro_rules! take {
        ($($records:ident but $stubs:expr),*) => {$(
            for (id, _, is) in before.$records.changes(&after.$records) {
                match is {
                    _ if $stubs.contains(&id) => {}
                    Some(record) => drop(whole.$records.insert(id, record.clone())),
                    None => drop(whole.$records.remove(&id)),
                }
            }
        )*};
    }
    take!(orthoframes but stubs.orthoframes, objects but stubs.objects, areas but stubs.areas);
    take!(doors but [], replicas but [], places but [], zones but []);
    for kind in TypeKind::ALL {
        let known = &before.types.list(kind).entries;
        let entries = after.types.list(kind).entries.iter();
        let new = entries.filter(|(id, _)| !known.contains_key(id));
        let new: Vec<_> = new.map(|(id, entry)| (*id, entry.clone())).collect();
        whole.types.list_mut(kind).entries.extend(new);
    }
    for (id, was, is) in before.maps.changes(&after.maps) {
        match (world.maps.get(&id).zip(was), is) {
            (Some((all, was)), Some(is)) => {
                drop(whole.maps.insert(id, with_part_of_map(all, was, is)));
            }
            (None, Some(is)) => drop(whole.maps.insert(id, is.clone())),
            (_, None) => drop(whole.maps.remove(&id)),
        }
    }
    if before.domain.maps != after.domain.maps {
        whole.domain.maps.clone_from(&after.domain.maps);
    }
    if before.domain.lifts != after.domain.lifts {
        whole.domain.lifts.clone_from(&after.domain.lifts);
    }
    if before.robot != after.robot {
        whole.robot = after.robot.clone();
    }
    whole
}

/// A Map with what became of some of its items and links: what is changed stays in its place, what is new comes last.
fn with_part_of_map(all: &Map, was: &Map, is: &Map) -> Map {
    let mut items = all.items.clone();
    for old in &was.items {
        let new = is.items.iter().find(|new| new.area == old.area);
        match (items.iter().position(|item| item == old), new) {
            (Some(at), Some(new)) => items[at] = new.clone(),
            (Some(at), None) => drop(items.remove(at)),
            (None, _) => {}
        }
    }
    let is_new = |new: &&MapItem| was.items.iter().all(|old| old.area != new.area);
    items.extend(is.items.iter().filter(is_new).cloned());
    let mut links = all.links.clone();
    let mut new = is.links.clone();
    for old in &was.links {
        match new.iter().position(|link| link == old) {
            Some(at) => drop(new.remove(at)),
            None => {
                if let Some(at) = links.iter().position(|link| link == old) {
                    links.remove(at);
                }
            }
        }
    }
    links.extend(new);
    Map { items, links, ..is.clone() }
}

/// Items and links of a Map are told by their places in its lists: turns that in the whole Map into that in the part; `false`
/// where it is not in there.
pub(super) fn into_part(spot: &mut Spot, whole: &World, part: &World) -> bool {
    let Record::Map(id) = spot.record else { return true };
    let [Step::Field(list), Step::Index(at), ..] = &mut spot.steps[..] else { return true };
    let Some((all, some)) = whole.maps.get(&id).zip(part.maps.get(&id)) else { return true };
    let found = match *list {
        "items" => all
            .items
            .get(*at)
            .and_then(|own| some.items.iter().position(|item| item.area == own.area)),
        "links" => all.links.get(*at).and_then(|own| {
            let before = all.links[..*at].iter().filter(|link| *link == own).count();
            let alike = some.links.iter().enumerate().filter(|(_, link)| *link == own);
            alike.map(|(place, _)| place).nth(before)
        }),
        _ => return true,
    };
    if let Some(found) = found {
        *at = found;
    }
    found.is_some()
}

#[cfg(test)]
mod tests;
