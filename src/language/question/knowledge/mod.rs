//! What a description finds on the map: kinds, values and relations looked up, and things measured when that is asked.

mod best;
mod facing;
mod find;
mod levels;
mod measure;
mod members;
mod passages;
mod relate;
mod values;
mod walls;

pub(super) use levels::Level;
pub(super) use measure::HowFar;
pub(super) use walls::{Held, Kept};

use super::lexicon::Lexicon;
use super::memo::Memo;
use super::query::{Rel, Thing};
use super::{Memory, Senses};
use crate::map::{DoorKind, Entity, World};
use crate::paraphrase::Paraphrases;
use crate::semantics::{Around, Relations, Subject};
use crate::units::{AreaId, InOrder as _, OpeningId, Point, ReplicaId, TypeId};
use crate::words::Language;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::{Arc, OnceLock};

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
    // On a tray that stands on the table is on the table too.
    const ON: &[Basis] = &[
        basis("ON_TOP_OF"),
        basis("BORNE_BY"),
        Basis { relation: "INSIDE", swapped: false, of_support: true },
    ];
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
    const FACING: &[Basis] = &[swapped("IN_FRONT_OF")];
    const LEANING: &[Basis] = &[basis("LEANING_AGAINST")];
    const HAS: &[Basis] = &[swapped("INSIDE")];
    const BEARS: &[Basis] = &[swapped("ON_TOP_OF"), swapped("BORNE_BY"), swapped("INSIDE")];
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
        Rel::Facing => FACING,
        Rel::Leaning => LEANING,
        Rel::Has => HAS,
        Rel::Bears => BEARS,
        Rel::Between
        | Rel::There
        | Rel::Middle
        | Rel::Outside
        | Rel::From
        | Rel::To
        | Rel::Through
        | Rel::Opens
        | Rel::ToTheEye(_)
        | Rel::Within(_) => &[],
    }
}

const RELATIONS: [&str; 19] = [
    "ON_TOP_OF",
    "BORNE_BY",
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
    "AT_WALL",
    "IN_CORNER",
    "ON_WALL",
    "STANDS_ON_FLOOR",
    "AT_DOOR",
    "IN_MIDDLE_OF",
    "STANDS_AT",
];

/// From whose side left and right are seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// The anchor's own front.
    Own,
    /// The robot's place.
    Viewer,
}

/// How a question speaks of an opening: by its name in the facts, under which a door may hang in several places.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct KnownOpening {
    pub(super) thing: Thing,
    pub(super) id: OpeningId,
    pub(super) name: String,
    pub(super) is_passage: bool,
    /// The Areas that it is of; one for a door that leads out of the map.
    pub(super) areas: Vec<AreaId>,
    /// The pairs of Areas between which one goes through it, by the rules; the lower id first.
    joins: Vec<[AreaId; 2]>,
}

impl KnownOpening {
    /// The Areas to which one comes through it from this one.
    pub(super) fn beyond(&self, area: AreaId) -> impl Iterator<Item = AreaId> + '_ {
        let pairs = self.joins.iter().filter(move |pair| pair.contains(&area));
        pairs.map(move |&[a, b]| if a == area { b } else { a })
    }

    /// Whether one goes through it from one of these Areas to the other.
    pub(super) fn joins(&self, a: AreaId, b: AreaId) -> bool {
        self.joins.contains(&[a.min(b), a.max(b)])
    }
}

/// What is looked up once a map: nouns, relations both ways, doors. It belongs to one state of the relations.
#[derive(Debug)]
pub struct Mind {
    pub lexicon: Arc<Lexicon>,
    pub(super) paraphrases: Arc<Paraphrases>,
    /// Texts in words of the map, by the texts.
    pub(super) plain: Memo<String>,
    pairs: [OnceLock<Pairs>; RELATIONS.len()],
    openings: OnceLock<Vec<KnownOpening>>,
    by_type: OnceLock<HashMap<Option<TypeId>, Vec<ReplicaId>>>,
    on_floor: OnceLock<HashSet<ReplicaId>>,
    furniture: OnceLock<Vec<ReplicaId>>,
}

impl Mind {
    /// The nouns of a world, asked of in words that these paraphrases put plainly; all else when it is first asked for.
    #[must_use]
    pub fn of(world: &World, paraphrases: Arc<Paraphrases>) -> Self {
        Self::with(Arc::new(Lexicon::of(world)), paraphrases)
    }

    /// The same nouns, of a world in which things stand elsewhere and all else is as it was.
    #[must_use]
    pub fn renewed(&self) -> Self {
        Self::with(Arc::clone(&self.lexicon), Arc::clone(&self.paraphrases))
    }

    fn with(lexicon: Arc<Lexicon>, paraphrases: Arc<Paraphrases>) -> Self {
        Self {
            lexicon,
            paraphrases,
            plain: Memo::default(),
            pairs: std::array::from_fn(|_| OnceLock::new()),
            openings: OnceLock::new(),
            by_type: OnceLock::new(),
            on_floor: OnceLock::new(),
            furniture: OnceLock::new(),
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

impl<'a> Knowledge<'a> {
    /// What is measured from when the relations are asked.
    pub(super) fn around(&self) -> Around<'a> {
        Around::new(self.world).with_robot(self.senses.robot())
    }
}

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
            None => {
                let openings = self.openings();
                let opening = openings.binary_search_by(|o| o.name.as_str().cmp(symbol));
                let opening = opening.ok().map(|n| openings[n].thing);
                let windows = &self.lexicon().windows;
                let window = || windows.iter().position(|w| !w.name.is_empty() && w.name == symbol);
                opening.or_else(|| window().map(|n| Thing::Window(n as u32)))
            }
        }
    }

    /// The symbol by which the facts know a thing.
    pub(super) fn symbol(&self, thing: Thing) -> String {
        match thing {
            Thing::Entity(entity) => {
                // What is carried stands in no facts.
                let known = self.relations.symbols().known(Subject::Entity(entity));
                known.map_or_else(|| self.world.name(entity).to_owned(), ToString::to_string)
            }
            Thing::Opening(id) => {
                self.relations.openings().opening(id).map_or_else(String::new, |o| o.name.clone())
            }
            Thing::Window(n) => self.lexicon().windows[n as usize].name.clone(),
            Thing::Robot => "РБ-2".to_owned(),
        }
    }

    /// Doors and passages of Areas, each once, in the order of their names.
    pub(super) fn openings(&self) -> &[KnownOpening] {
        self.mind.openings.get_or_init(|| {
            let mut known: BTreeMap<&str, KnownOpening> = BTreeMap::new();
            for opening in self.relations.openings().iter() {
                let kind = opening.door.and_then(|d| self.world.doors.get(&d)).map(|d| d.kind);
                let thing = match opening.door {
                    Some(door) => Thing::Entity(Entity::Door(door)),
                    None => Thing::Opening(opening.id),
                };
                let noun = known.entry(&opening.name).or_insert_with(|| KnownOpening {
                    thing,
                    id: opening.id,
                    name: opening.name.clone(),
                    is_passage: kind.map_or(opening.is_passage(), |kind| kind == DoorKind::Passage),
                    areas: Vec::new(),
                    joins: Vec::new(),
                });
                for area in opening.all_areas() {
                    if !noun.areas.contains(&area) {
                        noun.areas.push(area);
                    }
                }
                for pair in &opening.joins {
                    if !noun.joins.contains(pair) {
                        noun.joins.push(*pair);
                    }
                }
            }
            known.into_values().collect()
        })
    }

    pub(super) fn opening(&self, thing: Thing) -> Option<&KnownOpening> {
        self.openings().iter().find(|opening| opening.thing == thing)
    }

    /// The ends of the side in which an opening lies, of the lower Area's where it lies in two.
    pub(super) fn ends_of(&self, opening: &KnownOpening) -> Option<(Point, Point)> {
        let side = |o: &crate::semantics::Opening| {
            o.sides.iter().min_by_key(|side| side.area).map(|side| side.ends)
        };
        self.relations.openings().opening(opening.id).and_then(side)
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

    fn furniture(&self) -> &[ReplicaId] {
        self.mind.furniture.get_or_init(|| {
            let tuples = self.relations.derived().tuples("IS_FURNITURE").into_iter().flatten();
            let mut found: Vec<ReplicaId> =
                tuples.filter_map(|t| self.thing(t.symbol(0)?)?.replica()).collect();
            found.order();
            found
        })
    }

    fn on_floor(&self) -> &HashSet<ReplicaId> {
        self.mind.on_floor.get_or_init(|| {
            let pairs = self.pairs("STANDS_ON_FLOOR");
            let things = pairs.into_iter().flat_map(|pairs| pairs.forward.keys());
            things.filter_map(|thing| thing.replica()).collect()
        })
    }
}
