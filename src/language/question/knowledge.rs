//! What a description finds on the map: kinds, values and relations looked up, and things measured when that is asked.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use crate::language::words::Language;
use crate::map::{DoorKind, DoorStatus, Entity, Permeability, World};
use crate::semantics::{Relations, Subject};
use crate::units::{AreaId, DoorId, MapId, ObjectId, Point, ReplicaId, TypeId, Vector};

use super::lexicon::{Extension, Lexicon};
use super::query::{Best, Extreme, Head, Noun, Rel, Restriction, Thing};
use super::values::{Property, ValueId};
use super::{Doubt, Memory, Senses};

/// The tuples of one relation, both ways.
#[derive(Debug, Default)]
struct Pairs {
    forward: HashMap<Thing, Vec<Thing>>,
    backward: HashMap<Thing, Vec<Thing>>,
}

/// A relation of the rule text that a preposition may stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Basis {
    pub(super) relation: &'static str,
    /// The anchor stands first in the tuple.
    pub(super) swapped: bool,
    /// Only where the anchor has shelves: on a bookcase is what stands in it.
    pub(super) of_support: bool,
}

const fn basis(relation: &'static str) -> Basis {
    Basis { relation, swapped: false, of_support: false }
}

const fn swapped(relation: &'static str) -> Basis {
    Basis { relation, swapped: true, of_support: false }
}

/// The relations that a preposition stands for; what any of them gives counts.
pub(super) fn bases(rel: Rel) -> &'static [Basis] {
    const ON: &[Basis] =
        &[basis("ON_TOP_OF"), Basis { relation: "INSIDE", swapped: false, of_support: true }];
    const IN: &[Basis] = &[basis("INSIDE")];
    const UNDER: &[Basis] = &[basis("UNDER"), swapped("ON_TOP_OF"), swapped("ABOVE")];
    const ABOVE: &[Basis] = &[basis("ABOVE"), swapped("UNDER")];
    const NEXT: &[Basis] =
        &[basis("NEXT_TO"), basis("LEANING_AGAINST"), swapped("LEANING_AGAINST")];
    const NEAR: &[Basis] = &[basis("CLOSE_TO")];
    const LEFT: &[Basis] = &[basis("LEFT_OF")];
    const RIGHT: &[Basis] = &[basis("RIGHT_OF")];
    const BEHIND: &[Basis] = &[basis("BEHIND")];
    const FRONT: &[Basis] = &[basis("IN_FRONT_OF")];
    const LEANING: &[Basis] = &[basis("LEANING_AGAINST")];
    const HAS: &[Basis] = &[swapped("INSIDE")];
    const BEARS: &[Basis] = &[swapped("ON_TOP_OF"), swapped("INSIDE")];
    match rel {
        Rel::On => ON,
        Rel::In | Rel::Of => IN,
        Rel::Under => UNDER,
        Rel::Above => ABOVE,
        Rel::NextTo => NEXT,
        Rel::Near | Rel::At => NEAR,
        Rel::LeftOf => LEFT,
        Rel::RightOf => RIGHT,
        Rel::Behind => BEHIND,
        Rel::InFrontOf => FRONT,
        Rel::Leaning => LEANING,
        Rel::Has => HAS,
        Rel::Bears => BEARS,
        Rel::Between | Rel::Outside | Rel::From | Rel::To | Rel::Through => &[],
    }
}

const RELATIONS: [&str; 11] = [
    "ON_TOP_OF",
    "INSIDE",
    "UNDER",
    "ABOVE",
    "NEXT_TO",
    "LEANING_AGAINST",
    "CLOSE_TO",
    "LEFT_OF",
    "RIGHT_OF",
    "BEHIND",
    "IN_FRONT_OF",
];

/// From whose side left and right are seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// The anchor's own front.
    Own,
    /// The robot's place.
    Viewer,
}

/// A door or passage with what it joins.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Gate {
    pub(super) thing: Thing,
    pub(super) name: String,
    pub(super) is_passage: bool,
    /// The Areas that it joins; one for a door that leads out of the map.
    pub(super) areas: Vec<AreaId>,
    pub(super) ends: (Point, Point),
    pub(super) clear_width: f64,
}

/// What is looked up once a map: nouns, relations both ways, doors. It belongs to one state of the relations.
#[derive(Debug)]
pub struct Mind {
    pub lexicon: Lexicon,
    pairs: [OnceCell<Pairs>; RELATIONS.len()],
    gates: OnceCell<Vec<Gate>>,
    by_type: OnceCell<HashMap<Option<TypeId>, Vec<ReplicaId>>>,
    on_floor: OnceCell<HashSet<ReplicaId>>,
}

impl Mind {
    /// The nouns of a world; all else when it is first asked for.
    #[must_use]
    pub fn of(world: &World) -> Self {
        Self {
            lexicon: Lexicon::of(world),
            pairs: std::array::from_fn(|_| OnceCell::new()),
            gates: OnceCell::new(),
            by_type: OnceCell::new(),
            on_floor: OnceCell::new(),
        }
    }
}

/// The map, asked by someone who stands somewhere.
#[derive(Clone, Copy)]
pub(super) struct Knowledge<'a> {
    pub(super) world: &'a World,
    pub(super) relations: &'a Relations,
    pub(super) mind: &'a Mind,
    pub(super) senses: &'a dyn Senses,
    pub(super) memory: &'a Memory,
    pub(super) language: Language,
}

/// What stands this far from a door is at it, cm.
const AT_DOOR: f64 = 100.0;

impl Knowledge<'_> {
    pub(super) fn lexicon(&self) -> &Lexicon {
        &self.mind.lexicon
    }

    fn pairs(&self, relation: &str) -> Option<&Pairs> {
        let at = RELATIONS.iter().position(|r| *r == relation)?;
        Some(self.mind.pairs[at].get_or_init(|| {
            let mut pairs = Pairs::default();
            let tuples = self.relations.derived().tuples(relation);
            for tuple in tuples.into_iter().flatten() {
                let thing = |column| self.thing(tuple.symbol(column)?);
                if let (Some(x), Some(y)) = (thing(0), thing(1)) {
                    pairs.forward.entry(x).or_default().push(y);
                    pairs.backward.entry(y).or_default().push(x);
                }
            }
            pairs
        }))
    }

    pub(super) fn thing(&self, symbol: &str) -> Option<Thing> {
        match self.relations.symbols().subject(symbol) {
            Some(Subject::Entity(entity)) => Some(Thing::Entity(entity)),
            Some(_) => None,
            None => self.gates().iter().find(|g| g.name == symbol).map(|g| g.thing),
        }
    }

    /// The symbol by which the facts know a thing.
    pub(super) fn symbol(&self, thing: Thing) -> String {
        match thing {
            Thing::Entity(entity) => {
                self.relations.symbols().symbol(Subject::Entity(entity)).to_string()
            }
            Thing::Opening(n) => self.relations.openings()[n as usize].name.clone(),
            Thing::Window(n) => self.lexicon().windows[n as usize].name.clone(),
            Thing::Robot => "РБ-2".to_owned(),
        }
    }

    /// Doors and passages of Areas, each once.
    pub(super) fn gates(&self) -> &[Gate] {
        self.mind.gates.get_or_init(|| {
            let mut gates: BTreeMap<String, Gate> = BTreeMap::new();
            for (n, opening) in self.relations.openings().iter().enumerate() {
                let kind = opening.door.and_then(|d| self.world.doors.get(&d)).map(|d| d.kind);
                let is_passage = kind == Some(DoorKind::Passage)
                    || (kind.is_none() && opening.permeability == Permeability::Permeable);
                let thing = match opening.door {
                    Some(door) => Thing::Entity(Entity::Door(door)),
                    None => Thing::Opening(n as u32),
                };
                let gate = gates.entry(opening.name.clone()).or_insert_with(|| Gate {
                    thing,
                    name: opening.name.clone(),
                    is_passage,
                    areas: Vec::new(),
                    ends: opening.ends,
                    clear_width: opening.clear_width,
                });
                for area in [Some(opening.area), opening.leads_to()].into_iter().flatten() {
                    if !gate.areas.contains(&area) {
                        gate.areas.push(area);
                    }
                }
            }
            gates.into_values().collect()
        })
    }

    pub(super) fn gate(&self, thing: Thing) -> Option<&Gate> {
        self.gates().iter().find(|g| g.thing == thing)
    }

    fn by_type(&self) -> &HashMap<Option<TypeId>, Vec<ReplicaId>> {
        self.mind.by_type.get_or_init(|| {
            let mut by_type: HashMap<Option<TypeId>, Vec<ReplicaId>> = HashMap::new();
            for replica in self.world.replicas.values() {
                let kind = self.world.objects.get(&replica.object).and_then(|o| o.object_type);
                by_type.entry(kind).or_default().push(replica.id);
            }
            by_type
        })
    }

    fn on_floor(&self) -> &HashSet<ReplicaId> {
        self.mind.on_floor.get_or_init(|| {
            let tuples = self.relations.derived().tuples("stands_on_floor");
            let things = tuples.into_iter().flatten();
            things.filter_map(|t| self.thing(t.symbol(0)?)?.replica()).collect()
        })
    }

    pub(super) fn has_trait(&self, replica: ReplicaId, wanted: &str) -> bool {
        let object = self.world.replicas.get(&replica).map(|r| r.object);
        let kind = object.and_then(|o| self.world.objects.get(&o)).and_then(|o| o.object_type);
        self.world.types.object.has_trait(kind, wanted)
    }

    /// Everything of a kind.
    fn members(&self, extension: &Extension) -> Vec<Thing> {
        let replica = |&id: &ReplicaId| Thing::Entity(Entity::Replica(id));
        let of_object = |object: ObjectId| {
            let all = self.world.replicas.values().filter(move |r| r.object == object);
            all.map(|r| Thing::Entity(Entity::Replica(r.id))).collect()
        };
        let with_trait = |wanted: &str| -> Vec<Thing> {
            let kinds = self.by_type().iter();
            let kinds = kinds.filter(|(kind, _)| self.world.types.object.has_trait(**kind, wanted));
            let mut found: Vec<Thing> = kinds.flat_map(|(_, all)| all).map(replica).collect();
            found.sort_unstable();
            found
        };
        match extension {
            Extension::ObjectType(kind) => {
                self.by_type().get(&Some(*kind)).into_iter().flatten().map(replica).collect()
            }
            Extension::Object(object) => of_object(*object),
            Extension::Trait(wanted) => with_trait(wanted),
            Extension::Things => self.world.replicas.keys().map(replica).collect(),
            Extension::Furniture => {
                let all = self.world.replicas.keys();
                all.filter(|id| !self.has_trait(**id, "portable")).map(replica).collect()
            }
            Extension::AreaType(kind) => {
                let all = self.world.areas.values().filter(|a| a.area_type == Some(*kind));
                all.map(|a| Thing::Entity(Entity::Area(a.id))).collect()
            }
            Extension::Rooms => {
                self.world.areas.keys().map(|a| Thing::Entity(Entity::Area(*a))).collect()
            }
            Extension::DoorType(kind) => {
                let all = self.world.doors.values().filter(|d| d.door_type == Some(*kind));
                all.map(|d| Thing::Entity(Entity::Door(d.id))).collect()
            }
            Extension::Doors => {
                self.gates().iter().filter(|g| !g.is_passage).map(|g| g.thing).collect()
            }
            Extension::Passages => {
                self.gates().iter().filter(|g| g.is_passage).map(|g| g.thing).collect()
            }
            Extension::Windows => {
                (0..self.lexicon().windows.len()).map(|n| Thing::Window(n as u32)).collect()
            }
            Extension::Places => {
                self.world.places.keys().map(|p| Thing::Entity(Entity::Place(*p))).collect()
            }
            Extension::Storeys | Extension::Building => {
                self.world.maps.keys().map(|m| Thing::Entity(Entity::Map(*m))).collect()
            }
            Extension::Robot => vec![Thing::Robot],
            Extension::Floor | Extension::Walls => Vec::new(),
        }
    }

    /// What the head alone may mean.
    pub(super) fn base(&self, head: &Head) -> Vec<Thing> {
        if let Some(things) = &head.things {
            return things.clone();
        }
        if !head.named.is_empty() {
            return head.named.iter().map(|e| Thing::Entity(*e)).collect();
        }
        if head.anything {
            return self.members(&Extension::Things);
        }
        let mut found: BTreeSet<Thing> = BTreeSet::new();
        for kind in &head.kinds {
            found.extend(self.members(&self.lexicon().kind(*kind).extension));
        }
        found.into_iter().collect()
    }

    pub(super) fn is_floor(&self, noun: &Noun) -> bool {
        let kinds = &noun.head.kinds;
        kinds.iter().any(|k| self.lexicon().kind(*k).extension == Extension::Floor)
            && noun.head.named.is_empty()
    }

    /// Everything that a description fits. `loose` lets an anchor be any of several things.
    ///
    /// # Errors
    /// An anchor that may be several things, or none.
    pub(super) fn find(&self, noun: &Noun, loose: bool) -> Result<Vec<Thing>, Doubt> {
        let mut found = self.base(&noun.head);
        if noun.other {
            found.retain(|t| !self.memory.spoken.contains(t));
        }
        for restriction in &noun.restrictions {
            let related = self.related_to(restriction, loose)?;
            // "What is in the kitchen" asks for things, "what is next to the kitchen" may ask for rooms.
            if noun.head.anything
                && !restriction.negated
                && found.iter().all(|t| !related.contains(t))
            {
                let rooms = related.iter().filter(|t| t.area().is_some()).copied();
                if restriction.rel == Rel::NextTo || restriction.rel == Rel::Near {
                    found = rooms.collect();
                    continue;
                }
            }
            found.retain(|t| related.contains(t) != restriction.negated);
        }
        for filter in &noun.filters {
            found.retain(|t| self.has_value(*t, filter.value) != filter.negated);
        }
        for except in &noun.except {
            let without = self.find(except, true)?;
            found.retain(|t| !without.contains(t));
        }
        match &noun.best {
            Some(best) => self.best(best, found, noun.count.unwrap_or(1), noun.plural, loose),
            None => Ok(found),
        }
    }

    /// The one thing, or the several where several are spoken of.
    ///
    /// # Errors
    /// Several where one is meant; none at all.
    pub(super) fn definite(&self, noun: &Noun) -> Result<Vec<Thing>, Doubt> {
        let found = self.find(noun, false)?;
        if found.is_empty() {
            return Err(self.none_such(noun));
        }
        let several = noun.plural || noun.all || noun.count.is_some() || noun.indefinite;
        if found.len() > 1 && !several && noun.head.things.is_none() {
            return Err(self.ambiguous(noun, &found));
        }
        Ok(found)
    }

    /// # Errors
    /// As [`Self::definite`]; several things are always one too many.
    pub(super) fn one(&self, noun: &Noun) -> Result<Thing, Doubt> {
        let found = self.find(noun, false)?;
        match found[..] {
            [only] => Ok(only),
            [] => Err(self.none_such(noun)),
            _ => Err(self.ambiguous(noun, &found)),
        }
    }

    pub(super) fn ambiguous(&self, noun: &Noun, found: &[Thing]) -> Doubt {
        Doubt::Ambiguous { reference: noun.text.clone(), candidates: found.to_vec() }
    }

    pub(super) fn none_such(&self, noun: &Noun) -> Doubt {
        Doubt::NoneSuch { noun: Box::new(noun.clone()) }
    }

    /// What lies to some anchor as a restriction says.
    fn related_to(&self, restriction: &Restriction, loose: bool) -> Result<HashSet<Thing>, Doubt> {
        if restriction.rel == Rel::Between {
            return self.between(restriction);
        }
        let Some(noun) = restriction.anchors.first() else { return Ok(HashSet::new()) };
        if self.is_floor(noun) {
            let on_floor = self.on_floor().iter().map(|id| Thing::Entity(Entity::Replica(*id)));
            let mut found: HashSet<Thing> = on_floor.collect();
            for inner in &noun.restrictions {
                let within = self.related_to(inner, loose)?;
                found.retain(|t| within.contains(t));
            }
            return Ok(found);
        }
        let mut found = HashSet::new();
        for noun in &restriction.anchors {
            for anchor in self.anchors(restriction, noun, loose)? {
                found.extend(self.related(restriction.rel, anchor));
            }
        }
        Ok(found)
    }

    /// # Errors
    /// Several where one is meant; none at all.
    pub(super) fn anchors(
        &self,
        restriction: &Restriction,
        noun: &Noun,
        loose: bool,
    ) -> Result<Vec<Thing>, Doubt> {
        let any = loose || noun.indefinite || matches!(restriction.rel, Rel::Has | Rel::Bears);
        let anchors = self.find(noun, any)?;
        if anchors.is_empty() && !any {
            return Err(self.none_such(noun));
        }
        let several = any || noun.plural || noun.all || noun.head.things.is_some();
        if anchors.len() > 1 && !several {
            return Err(self.ambiguous(noun, &anchors));
        }
        Ok(anchors)
    }

    fn between(&self, restriction: &Restriction) -> Result<HashSet<Thing>, Doubt> {
        let mut ends: Vec<Thing> = Vec::new();
        for noun in &restriction.anchors {
            ends.extend(self.definite(noun)?);
        }
        let [a, b] = ends[..] else {
            return Err(match (&ends[..], &restriction.anchors[..]) {
                ([], [noun, ..]) => self.none_such(noun),
                (_, [noun, ..]) => self.ambiguous(noun, &ends),
                _ => Doubt::Empty,
            });
        };
        if let (Some(a), Some(b)) = (a.area(), b.area()) {
            let joins = |g: &&Gate| g.areas.contains(&a) && g.areas.contains(&b);
            return Ok(self.gates().iter().filter(joins).map(|g| g.thing).collect());
        }
        let (Some(a), Some(b)) = (a.replica(), b.replica()) else { return Ok(HashSet::new()) };
        let between = self.relations.standing_between(a, b);
        Ok(between.into_iter().map(|id| Thing::Entity(Entity::Replica(id))).collect())
    }

    /// What lies to a thing as a preposition says.
    pub(super) fn related(&self, rel: Rel, anchor: Thing) -> Vec<Thing> {
        match (rel, anchor) {
            (Rel::In | Rel::On | Rel::Of | Rel::At, Thing::Entity(Entity::Map(map))) => {
                self.on_map(map)
            }
            (Rel::In | Rel::On | Rel::At, Thing::Entity(Entity::Area(area))) => self.in_area(area),
            (Rel::Of | Rel::From | Rel::To | Rel::Through, Thing::Entity(Entity::Area(area))) => {
                let mut found = self.in_area(area);
                if rel != Rel::Of {
                    found.retain(|t| self.gate(*t).is_some());
                }
                found
            }
            (Rel::Outside, Thing::Entity(Entity::Area(area))) => {
                let inside: HashSet<Thing> = self.in_area(area).into_iter().collect();
                let all = self.members(&Extension::Things).into_iter();
                all.filter(|t| !inside.contains(t)).collect()
            }
            (Rel::Near | Rel::NextTo, Thing::Entity(Entity::Area(area))) => {
                let gates = self.gates().iter().filter(|g| g.areas.contains(&area));
                let rooms: BTreeSet<AreaId> =
                    gates.flat_map(|g| &g.areas).copied().filter(|a| *a != area).collect();
                rooms.into_iter().map(|a| Thing::Entity(Entity::Area(a))).collect()
            }
            (
                Rel::Near | Rel::NextTo | Rel::At,
                Thing::Entity(Entity::Door(_)) | Thing::Opening(_),
            ) => {
                let Some(gate) = self.gate(anchor) else { return Vec::new() };
                self.within_reach(&gate.areas, |id| {
                    self.relations.distance_to_segment(id, gate.ends)
                })
            }
            (Rel::Near | Rel::NextTo | Rel::At | Rel::Under, Thing::Window(n)) => {
                let window = &self.lexicon().windows[n as usize];
                self.within_reach(&[window.area], |id| {
                    self.relations.distance_to_segment(id, window.ends)
                })
            }
            (Rel::Near | Rel::NextTo | Rel::At, Thing::Entity(Entity::Place(_)) | Thing::Robot) => {
                let Some((map, at)) = self.point(anchor) else { return Vec::new() };
                let area = self.relations.measurements().area_at(map, at);
                let areas: Vec<AreaId> = area.into_iter().collect();
                self.within_reach(&areas, |id| self.relations.distance_to_point(id, map, at))
            }
            (Rel::Has, _) => self.holders(anchor),
            (Rel::LeftOf | Rel::RightOf | Rel::Behind | Rel::InFrontOf, Thing::Robot) => {
                self.beside_robot(rel)
            }
            (Rel::LeftOf | Rel::RightOf | Rel::Behind | Rel::InFrontOf, _) => {
                match self.frame(anchor) {
                    Frame::Own => self.by_relation(rel, anchor),
                    Frame::Viewer => self.for_viewer(rel, anchor),
                }
            }
            _ => self.by_relation(rel, anchor),
        }
    }

    fn by_relation(&self, rel: Rel, anchor: Thing) -> Vec<Thing> {
        let mut found: Vec<Thing> = Vec::new();
        for basis in bases(rel) {
            if basis.of_support && anchor.replica().is_none_or(|id| !self.has_trait(id, "support"))
            {
                continue;
            }
            let Some(pairs) = self.pairs(basis.relation) else { continue };
            let side = if basis.swapped { &pairs.forward } else { &pairs.backward };
            for thing in side.get(&anchor).into_iter().flatten() {
                if !found.contains(thing) {
                    found.push(*thing);
                }
            }
        }
        found.sort_unstable();
        found
    }

    /// The tuple that makes a relation hold: its name in the rule text and its arguments in order.
    pub(super) fn tuple(
        &self,
        rel: Rel,
        x: Thing,
        y: Thing,
    ) -> Option<(&'static str, Thing, Thing)> {
        if let (Rel::Has, _) = (rel, y) {
            return self.tuple(Rel::In, y, x);
        }
        bases(rel).iter().find_map(|basis| {
            let (a, b) = if basis.swapped { (y, x) } else { (x, y) };
            let pairs = self.pairs(basis.relation)?;
            pairs.forward.get(&a)?.contains(&b).then_some((basis.relation, a, b))
        })
    }

    /// Rooms and things that hold a thing.
    fn holders(&self, thing: Thing) -> Vec<Thing> {
        match thing {
            Thing::Window(n) => {
                vec![Thing::Entity(Entity::Area(self.lexicon().windows[n as usize].area))]
            }
            Thing::Entity(Entity::Place(id)) => self
                .world
                .places
                .get(&id)
                .map(|p| Thing::Entity(Entity::Area(p.area)))
                .into_iter()
                .collect(),
            _ => match self.gate(thing) {
                Some(gate) => gate.areas.iter().map(|a| Thing::Entity(Entity::Area(*a))).collect(),
                None => self.by_relation(Rel::Has, thing),
            },
        }
    }

    fn in_area(&self, area: AreaId) -> Vec<Thing> {
        let here = Thing::Entity(Entity::Area(area));
        let mut found = self.by_relation(Rel::In, here);
        found.extend(self.gates().iter().filter(|g| g.areas.contains(&area)).map(|g| g.thing));
        let windows = self.lexicon().windows.iter().enumerate();
        found.extend(windows.filter(|(_, w)| w.area == area).map(|(n, _)| Thing::Window(n as u32)));
        let places = self.world.places.values().filter(|p| p.area == area);
        found.extend(places.map(|p| Thing::Entity(Entity::Place(p.id))));
        found
    }

    fn on_map(&self, map: MapId) -> Vec<Thing> {
        let Some(map) = self.world.maps.get(&map) else { return Vec::new() };
        let mut found: Vec<Thing> = Vec::new();
        for item in &map.items {
            found.push(Thing::Entity(Entity::Area(item.area)));
            found.extend(self.in_area(item.area));
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    fn within_reach(
        &self,
        areas: &[AreaId],
        distance: impl Fn(ReplicaId) -> Option<f64>,
    ) -> Vec<Thing> {
        let rooms = areas.iter().map(|a| Thing::Entity(Entity::Area(*a)));
        let mut near: Vec<(f64, Thing)> = rooms
            .flat_map(|room| self.by_relation(Rel::In, room))
            .filter_map(|t| Some((distance(t.replica()?)?, t)))
            .filter(|(d, _)| *d <= AT_DOOR)
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.dedup_by_key(|(_, t)| *t);
        near.into_iter().map(|(_, t)| t).collect()
    }

    /// From whose side left and right of a thing are told.
    pub(super) fn frame(&self, anchor: Thing) -> Frame {
        match anchor.replica() {
            Some(id) if self.relations.has_front(id) => Frame::Own,
            _ => Frame::Viewer,
        }
    }

    fn for_viewer(&self, rel: Rel, anchor: Thing) -> Vec<Thing> {
        let Some((map, pose)) = self.senses.robot() else { return Vec::new() };
        let wanted = match rel {
            Rel::LeftOf => "LEFT_FOR_VIEWER",
            Rel::RightOf => "RIGHT_FOR_VIEWER",
            Rel::Behind => "BEHIND_FOR_VIEWER",
            _ => "IN_FRONT_FOR_VIEWER",
        };
        let symbol = self.symbol(anchor);
        let seen = self.relations.seen_from(map, pose.at).unwrap_or_default();
        let seen = seen.into_iter().filter(|s| s.relation_en == wanted && s.anchor == symbol);
        seen.filter_map(|s| self.thing(&s.thing)).collect()
    }

    /// What is ahead of the robot, behind it or at its sides, in its room, within four metres, nearest first.
    fn beside_robot(&self, rel: Rel) -> Vec<Thing> {
        const REACH: f64 = 400.0;
        let Some((map, pose)) = self.senses.robot() else { return Vec::new() };
        let Some(area) = self.relations.measurements().area_at(map, pose.at) else {
            return Vec::new();
        };
        let (sin, cos) = pose.heading.sin_cos();
        let (ahead, left) = (Vector::new(cos, sin), Vector::new(-sin, cos));
        let mut found: Vec<(f64, Thing)> = Vec::new();
        for thing in self.by_relation(Rel::In, Thing::Entity(Entity::Area(area))) {
            let Some(id) = thing.replica() else { continue };
            let Some((_, at)) = self.relations.centre(id) else { continue };
            let Some(distance) = self.relations.distance_to_point(id, map, pose.at) else {
                continue;
            };
            let (forward, sideways) = ((at - pose.at).dot(&ahead), (at - pose.at).dot(&left));
            let fits = match rel {
                Rel::InFrontOf => forward >= sideways.abs(),
                Rel::Behind => -forward >= sideways.abs(),
                Rel::LeftOf => sideways > forward.abs(),
                _ => -sideways > forward.abs(),
            };
            if fits && distance <= REACH {
                found.push((distance, thing));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.into_iter().map(|(_, t)| t).collect()
    }

    /// Whether a relation holds of two things; being on and in is passed on by what stands between.
    pub(super) fn holds(&self, rel: Rel, x: Thing, y: Thing) -> bool {
        if self.related(rel, y).contains(&x) {
            return true;
        }
        matches!(rel, Rel::On | Rel::In) && self.support_chain(x).contains(&y)
    }

    /// What a thing stands on or lies in, what that stands on, and so on.
    pub(super) fn support_chain(&self, thing: Thing) -> Vec<Thing> {
        let mut chain = Vec::new();
        let mut at = thing.replica();
        while let Some(id) = at.and_then(|id| self.relations.support_of(id)) {
            let support = Thing::Entity(Entity::Replica(id));
            if chain.contains(&support) {
                break;
            }
            chain.push(support);
            at = Some(id);
        }
        chain
    }

    /// The room in which a thing is.
    pub(super) fn area_of(&self, thing: Thing) -> Option<AreaId> {
        match thing {
            Thing::Entity(Entity::Replica(id)) => self.relations.area_of(id),
            Thing::Entity(Entity::Area(id)) => Some(id),
            Thing::Entity(Entity::Place(id)) => self.world.places.get(&id).map(|p| p.area),
            Thing::Entity(Entity::Door(_)) | Thing::Opening(_) => {
                self.gate(thing).and_then(|g| g.areas.first().copied())
            }
            Thing::Window(n) => Some(self.lexicon().windows[n as usize].area),
            Thing::Robot => {
                let (map, pose) = self.senses.robot()?;
                self.relations.measurements().area_at(map, pose.at)
            }
            Thing::Entity(Entity::Map(_)) => None,
        }
    }

    /// Where a thing is on its Map.
    pub(super) fn point(&self, thing: Thing) -> Option<(MapId, Point)> {
        match thing {
            Thing::Entity(Entity::Replica(id)) => self.relations.centre(id),
            Thing::Entity(Entity::Area(id)) => self.relations.area_centre(id),
            Thing::Entity(Entity::Place(id)) => {
                let place = self.world.places.get(&id)?;
                let (map, frame) = self.world.placement(place.area)?;
                Some((map, frame.apply(place.at)))
            }
            Thing::Entity(Entity::Door(_)) | Thing::Opening(_) => {
                let gate = self.gate(thing)?;
                let (map, _) = self.world.placement(*gate.areas.first()?)?;
                Some((map, nalgebra::center(&gate.ends.0, &gate.ends.1)))
            }
            Thing::Window(n) => {
                let window = &self.lexicon().windows[n as usize];
                let (map, _) = self.world.placement(window.area)?;
                Some((map, nalgebra::center(&window.ends.0, &window.ends.1)))
            }
            Thing::Robot => self.senses.robot().map(|(map, pose)| (map, pose.at)),
            Thing::Entity(Entity::Map(_)) => None,
        }
    }

    /// Straight distance between two things of one Map, cm: between surfaces, where both have any.
    pub(super) fn distance(&self, a: Thing, b: Thing) -> Option<f64> {
        let segment = |t: Thing| match t {
            Thing::Window(n) => Some(self.lexicon().windows[n as usize].ends),
            _ => self.gate(t).map(|g| g.ends),
        };
        match (a, b) {
            (Thing::Entity(Entity::Replica(x)), Thing::Entity(Entity::Replica(y))) => {
                self.relations.distance(x, y)
            }
            (Thing::Entity(Entity::Replica(x)), Thing::Entity(Entity::Area(y)))
            | (Thing::Entity(Entity::Area(y)), Thing::Entity(Entity::Replica(x))) => {
                self.relations.distance_to_area(x, y)
            }
            (Thing::Entity(Entity::Replica(x)), other)
            | (other, Thing::Entity(Entity::Replica(x))) => match segment(other) {
                Some(ends) => {
                    let (map, _) = self.point(other)?;
                    let own = self.relations.centre(x).map(|(m, _)| m);
                    (own == Some(map))
                        .then(|| self.relations.distance_to_segment(x, ends))
                        .flatten()
                }
                None => {
                    let (map, at) = self.point(other)?;
                    self.relations.distance_to_point(x, map, at)
                }
            },
            _ => {
                let ((m, p), (n, q)) = (self.point(a)?, self.point(b)?);
                (m == n).then(|| (p - q).norm())
            }
        }
    }

    /// What a superlative compares of a thing; more is more of it.
    pub(super) fn measure(&self, extreme: Extreme, thing: Thing) -> Option<f64> {
        let extent = match thing {
            Thing::Entity(Entity::Replica(id)) => self.relations.extent(id)?,
            Thing::Entity(Entity::Area(id)) => self.relations.area_extent(id)?,
            _ => {
                let gate = self.gate(thing)?;
                let width = (gate.ends.1 - gate.ends.0).norm();
                return matches!(
                    extreme,
                    Extreme::Widest | Extreme::Narrowest | Extreme::Biggest | Extreme::Smallest
                )
                .then_some(width);
            }
        };
        let is_area = thing.area().is_some();
        Some(match extreme {
            Extreme::Biggest | Extreme::Smallest if is_area => extent.base,
            Extreme::Biggest | Extreme::Smallest => extent.base * extent.height,
            Extreme::Tallest | Extreme::Lowest => extent.height,
            Extreme::Narrowest => extent.width.min(extent.depth),
            Extreme::Widest | Extreme::Longest => extent.width.max(extent.depth),
            _ => return None,
        })
    }

    fn best(
        &self,
        best: &Best,
        found: Vec<Thing>,
        count: u64,
        plural: bool,
        loose: bool,
    ) -> Result<Vec<Thing>, Doubt> {
        let _ = plural;
        let ranked: Vec<(f64, Thing)> = match best.extreme {
            Extreme::Nearest | Extreme::Farthest => {
                let anchors = match &best.anchor {
                    Some(noun) => {
                        let place = Restriction { rel: Rel::To, anchors: vec![], negated: false };
                        self.anchors(&place, noun, loose)?
                    }
                    None => vec![Thing::Robot],
                };
                let sign = if best.extreme == Extreme::Nearest { 1.0 } else { -1.0 };
                let away = |t: Thing| {
                    let all =
                        anchors.iter().filter(|a| **a != t).filter_map(|a| self.distance(t, *a));
                    all.reduce(f64::min)
                };
                found.iter().filter_map(|t| Some((sign * away(*t)?, *t))).collect()
            }
            Extreme::LeftMost | Extreme::RightMost => self.outermost(&found, best.extreme),
            Extreme::Most => return Ok(found),
            extreme => {
                let up = matches!(
                    extreme,
                    Extreme::Biggest | Extreme::Tallest | Extreme::Widest | Extreme::Longest
                );
                let sign = if up { -1.0 } else { 1.0 };
                found.iter().filter_map(|t| Some((sign * self.measure(extreme, *t)?, *t))).collect()
            }
        };
        let mut ranked = ranked;
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let wanted = usize::try_from(count).unwrap_or(usize::MAX);
        let Some(limit) = ranked.get(wanted.min(ranked.len()).saturating_sub(1)).map(|r| r.0)
        else {
            return Ok(Vec::new());
        };
        // Equal ones are all the biggest.
        Ok(ranked.into_iter().take_while(|(m, _)| *m <= limit + 1e-6).map(|(_, t)| t).collect())
    }

    /// Things in the order in which the robot sees them, from the left or from the right.
    fn outermost(&self, found: &[Thing], extreme: Extreme) -> Vec<(f64, Thing)> {
        let Some((map, pose)) = self.senses.robot() else { return Vec::new() };
        let placed: Vec<(Vector, Thing)> = found
            .iter()
            .filter_map(|t| {
                self.point(*t).filter(|(m, _)| *m == map).map(|(_, p)| (p - pose.at, *t))
            })
            .collect();
        let middle: Vector = placed.iter().filter_map(|(v, _)| v.try_normalize(1e-6)).sum();
        let sign = if extreme == Extreme::LeftMost { -1.0 } else { 1.0 };
        placed.iter().map(|(v, t)| (sign * middle.perp(v).atan2(middle.dot(v)), *t)).collect()
    }

    /// All values of a thing, with the map's own words for them.
    pub(super) fn values(&self, thing: Thing) -> Vec<(Property, Option<ValueId>, String)> {
        let values = &self.lexicon().values;
        let mut found: Vec<(Property, Option<ValueId>, String)> = Vec::new();
        let mut add = |properties: &crate::map::Properties| {
            for (name, value) in properties {
                let property = Property::of(name);
                if found.iter().all(|(other, _, _)| *other != property) {
                    found.push((property, values.meaning(value), value.clone()));
                }
            }
        };
        match thing {
            Thing::Entity(Entity::Replica(id)) => {
                if let Some(replica) = self.world.replicas.get(&id) {
                    add(&replica.properties);
                    if let Some(object) = self.world.objects.get(&replica.object) {
                        add(&object.properties);
                    }
                }
            }
            Thing::Entity(Entity::Area(id)) => {
                self.world.areas.get(&id).iter().for_each(|a| add(&a.properties));
            }
            Thing::Entity(Entity::Door(id)) => {
                self.world.doors.get(&id).iter().for_each(|d| add(&d.properties));
            }
            _ => {}
        }
        for (status, _) in self.statuses(thing) {
            let value = values.of_door(status);
            let word = value.map(|v| values.entry(v).russian.clone()).unwrap_or_default();
            found.insert(0, (Property::State, value, word));
        }
        found
    }

    /// States of a door, or of the doors of a thing.
    pub(super) fn statuses(&self, thing: Thing) -> Vec<(DoorStatus, DoorId)> {
        match thing {
            Thing::Entity(Entity::Door(id)) => match self.world.doors.get(&id) {
                Some(door) if door.kind != DoorKind::Passage => vec![(door.state.status, id)],
                _ => Vec::new(),
            },
            Thing::Entity(Entity::Replica(id)) => {
                let Some(replica) = self.world.replicas.get(&id) else { return Vec::new() };
                let Some(object) = self.world.objects.get(&replica.object) else {
                    return Vec::new();
                };
                let state = |door: DoorId| {
                    let own = replica.door_states.get(&door).copied();
                    own.or_else(|| self.world.doors.get(&door).map(|d| d.state))
                };
                let doors = object.doors.iter();
                doors.filter_map(|m| Some((state(m.door)?.status, m.door))).collect()
            }
            _ => Vec::new(),
        }
    }

    pub(super) fn has_value(&self, thing: Thing, wanted: ValueId) -> bool {
        let values = &self.lexicon().values;
        self.values(thing).iter().any(|(_, value, _)| value.is_some_and(|v| values.is(v, wanted)))
    }
}
