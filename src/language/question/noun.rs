//! Descriptions of things, as data: kinds or names, values of properties, and relations to other descriptions.
//!
//! A [`Noun`] is a conjunctive query in the shape of a tree.

use crate::map::Entity;
use crate::units::{AreaId, OpeningId, ReplicaId};

use super::compared::{Extreme, Quantity, Sized};
use super::lexicon::{Extension, KindId, Lexicon};
use super::values::{Property, ValueId};

/// How things lie to each other, as prepositions have it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Rel {
    In,
    On,
    Under,
    Above,
    NextTo,
    Near,
    LeftOf,
    RightOf,
    Behind,
    InFrontOf,
    Between,
    /// «лицом к телевизору», "facing the TV": it is in front of them.
    Facing,
    /// «слева, если смотреть на окно»: for one who faces the last of the anchors, of the first or in the whole room.
    ToTheEye(Side),
    /// «там»: in a room or a thing, or on it.
    There,
    /// About the middle of a room or of a top.
    Middle,
    Leaning,
    Outside,
    /// Out of a room, from a place.
    From,
    To,
    Through,
    At,
    /// «стул комнаты», "the door of the room"
    Of,
    /// The inverse of In: "rooms that have a chair".
    Has,
    /// The inverse of On: «стол, на котором лежит книга».
    Bears,
    /// Of a key: to a door, or to a room by its door.
    Opens,
    /// «в метре от стола», "within 50 cm of the door": not farther than so many cm, surface to surface.
    Within(u32),
}

impl Rel {
    /// Whether it is beside its anchor, and not in it or on it.
    pub(super) fn is_side(self) -> bool {
        matches!(
            self,
            Self::NextTo
                | Self::Near
                | Self::LeftOf
                | Self::RightOf
                | Self::InFrontOf
                | Self::Behind
                | Self::Between
        )
    }
}

/// A side of one who faces a thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// Of another thing or the same one.
    Left,
    Right,
    /// Of all that is in the room.
    AllLeft,
    AllRight,
}

impl Side {
    #[must_use]
    pub fn is_left(self) -> bool {
        matches!(self, Self::Left | Self::AllLeft)
    }

    #[must_use]
    pub fn of_all(self) -> bool {
        matches!(self, Self::AllLeft | Self::AllRight)
    }
}

/// Anything that can be an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Thing {
    Entity(Entity),
    /// A passage or door without a name of its own: its place among the openings of the relations.
    Opening(OpeningId),
    /// A window: its place among the windows of the lexicon.
    Window(u32),
    Robot,
}

impl Thing {
    /// A storey of the building.
    #[must_use]
    pub fn is_storey(&self) -> bool {
        matches!(self, Self::Entity(Entity::Map(_)))
    }

    #[must_use]
    pub fn replica(self) -> Option<ReplicaId> {
        match self {
            Self::Entity(Entity::Replica(id)) => Some(id),
            _ => None,
        }
    }

    #[must_use]
    pub fn area(self) -> Option<AreaId> {
        match self {
            Self::Entity(Entity::Area(id)) => Some(id),
            _ => None,
        }
    }

    /// Whether it is a room or a place, which are far or near by the way to them.
    #[must_use]
    pub fn is_gone_to(self) -> bool {
        matches!(self, Self::Entity(Entity::Area(_) | Entity::Place(_)))
    }
}

/// What the head of a description means.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Head {
    /// What bears this name.
    pub named: Vec<Entity>,
    /// What is of one of these kinds.
    pub kinds: Vec<KindId>,
    /// What was spoken of.
    pub things: Option<Vec<Thing>>,
    /// Anything at all.
    pub anything: bool,
}

impl Head {
    /// What is of one kind: any door, any room.
    #[must_use]
    pub fn of_kind(lexicon: &Lexicon, extension: &Extension) -> Self {
        Self { kinds: lexicon.kind_of(extension).into_iter().collect(), ..Self::default() }
    }
}

/// A value that the thing must, or must not, have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Filter {
    pub value: ValueId,
    /// «красные или белые»: these do as well.
    pub or: Vec<ValueId>,
    pub negated: bool,
}

impl Filter {
    /// One value, had or not had.
    #[must_use]
    pub fn new(value: ValueId, negated: bool) -> Self {
        Self { value, or: Vec::new(), negated }
    }

    /// All values that will do.
    pub fn values(&self) -> impl Iterator<Item = ValueId> + '_ {
        std::iter::once(self.value).chain(self.or.iter().copied())
    }
}

/// A relation to other things.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Restriction {
    pub rel: Rel,
    /// Two for [`Rel::Between`]; else one.
    pub anchors: Vec<Noun>,
    pub negated: bool,
}

/// A description of things: «чёрное кресло в комнате у окна».
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Noun {
    pub head: Head,
    /// The words of the head, as they were said.
    pub text: String,
    pub plural: bool,
    /// «какой-нибудь», "a"
    pub indefinite: bool,
    /// «все», "all"
    pub all: bool,
    /// "the desk lamp": it stands before the noun that is one of its kind, or only called after it.
    pub modifies: bool,
    /// «другие», "other": not those spoken of.
    pub other: bool,
    pub count: Option<u64>,
    /// How a number of the description is to be taken; without one it is exact.
    pub quantity: Quantity,
    /// «вторая по величине»: the place in the order of the superlative; none is the first.
    pub rank: Option<u64>,
    /// «в одной комнате», "on the same desk": one for all that are spoken of.
    pub same: bool,
    pub filters: Vec<Filter>,
    pub sizes: Vec<Sized>,
    pub restrictions: Vec<Restriction>,
    pub best: Option<Best>,
    /// «Что из мебели можно передвинуть?»: sorts to which it belongs as well.
    pub also: Vec<Head>,
    /// «того же цвета, что и стол»: with the value of another thing.
    pub like: Option<(Property, Box<Self>)>,
    /// "bigger than the kitchen": beyond another thing by what a superlative compares.
    pub beyond: Option<(Extreme, Box<Self>)>,
    /// «кроме лампы»
    pub except: Vec<Self>,
    /// "… that you can reach": whether there is a way for the robot.
    pub reached: Option<Reach>,
}

/// "… that you can reach from the hall, not going through the kitchen": whether there is such a way.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reach {
    pub able: bool,
    /// None is where the robot stands.
    pub from: Option<Box<Noun>>,
    /// Rooms and doors; of those none is told.
    pub avoiding: Vec<Noun>,
}

/// «ближайший к столу», "the three biggest"
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Best {
    pub extreme: Extreme,
    /// Of nearness: to what; none means to the robot. Of having the most: what is counted.
    pub anchor: Option<Box<Noun>>,
}

impl Noun {
    /// What is told by itself, not described.
    pub(super) fn of(things: Vec<Thing>) -> Self {
        Self { head: Head { things: Some(things), ..Head::default() }, ..Self::default() }
    }

    /// Whether a storey is named, or storeys at large.
    pub(super) fn is_storey(&self, lexicon: &Lexicon) -> bool {
        let named = |entity: &Entity| matches!(entity, Entity::Map(_));
        let storeys = |id: &KindId| lexicon.kind(*id).extension == Extension::Storeys;
        self.head.named.iter().any(named) || self.head.kinds.iter().any(storeys)
    }

    /// The same of its kind, where a word is a name and a kind's as well: «Спальня» is called so, and not the only one.
    pub(super) fn of_kind(&self) -> Option<Self> {
        let names_a_kind = !self.head.named.is_empty() && !self.head.kinds.is_empty();
        names_a_kind.then(|| {
            let head = Head { named: Vec::new(), ..self.head.clone() };
            Self { head, ..self.clone() }
        })
    }

    /// Whether it is of all that was counted thing by thing or place by place.
    pub(super) fn sums(&self) -> bool {
        let places = |place: &Restriction| place.anchors.len() > 1;
        self.all
            && (self.head.things.is_some() && self.text.is_empty()
                || self.restrictions.iter().any(places))
    }

    /// Whether its number says that several are meant, or none.
    pub(super) fn counts_several(&self) -> bool {
        self.best.is_none() && self.count.is_some_and(|n| n != 1)
    }

    /// Whether one thing is meant, by its words: "the cup".
    pub(super) fn means_one(&self) -> bool {
        let several = self.plural || self.all || self.indefinite || self.count.is_some();
        let told = self.best.is_some() || self.rank.is_some() || self.head.things.is_some();
        !several && !told
    }

    /// A noun that this one names beside itself, with a number that tells nothing there: "nearest to the 5 beds". Of what
    /// a room has the number counts, and "between the two doors" names both.
    pub(super) fn idle_count(&self) -> Option<&Self> {
        let counts = |noun: &Self, meant: Option<u64>| {
            let told = noun.count.filter(|_| noun.best.is_none());
            told.is_some_and(|n| n > 1 && Some(n) != meant) || noun.quantity != Quantity::Exactly
        };
        let of_places = self.restrictions.iter().flat_map(|restriction| {
            let pair = restriction.rel == Rel::Between && restriction.anchors.len() == 1;
            let meant = pair.then_some(2);
            let had = matches!(restriction.rel, Rel::Has | Rel::Bears);
            restriction.anchors.iter().map(move |anchor| (anchor, meant, had))
        });
        let anchor = self.best.as_ref().and_then(|best| best.anchor.as_deref());
        let compared = [self.like.as_ref().map(|(_, other)| &**other), anchor];
        let beyond = self.beyond.as_ref().map(|(_, other)| &**other);
        let others = compared.into_iter().flatten().chain(beyond).chain(&self.except);
        let mut all = of_places.chain(others.map(|noun| (noun, None, false)));
        all.find_map(|(noun, meant, had)| match !had && counts(noun, meant) {
            true => Some(noun),
            false => noun.idle_count(),
        })
    }

    /// Whether it is told by what it is not, or where it is not.
    pub(super) fn denies(&self) -> bool {
        self.restrictions.iter().any(|place| place.negated)
            || self.filters.iter().any(|filter| filter.negated)
    }

    /// Does something to this noun and to all that it names.
    pub(super) fn each(&mut self, act: &mut dyn FnMut(&mut Self)) {
        act(self);
        for restriction in &mut self.restrictions {
            restriction.anchors.iter_mut().for_each(|anchor| anchor.each(act));
        }
        if let Some(anchor) = self.best.as_mut().and_then(|b| b.anchor.as_mut()) {
            anchor.each(act);
        }
        if let Some((_, other)) = &mut self.like {
            other.each(act);
        }
        if let Some(reach) = &mut self.reached {
            let from = reach.from.as_deref_mut().into_iter();
            from.chain(&mut reach.avoiding).for_each(|noun| noun.each(act));
        }
        if let Some((_, other)) = &mut self.beyond {
            other.each(act);
        }
    }
}
