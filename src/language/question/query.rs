//! What a question asks, as data: descriptions of things joined by relations, and what is wanted of them on top.
//!
//! A [`Noun`] is a conjunctive query in the shape of a tree: a kind or names, values of properties, and relations to
//! other such trees. [`Query`] puts on top what is asked: the place, the number, whether there is one, a measure.

use crate::map::Entity;
use crate::report::Detail;
use crate::units::{AreaId, OpeningId, ReplicaId};

pub(super) use super::compared::{Closeness, Dimension, Extreme, Quantity, Sized};
use super::courtesy::Courtesy;
use super::lexicon::KindId;
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
    pub reached: Option<bool>,
}

/// «ближайший к столу», "the three biggest"
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Best {
    pub extreme: Extreme,
    /// Of nearness: to what; none means to the robot. Of having the most: what is counted.
    pub anchor: Option<Box<Noun>>,
}

/// What is said of a subject.
#[expect(clippy::large_enum_variant, reason = "a question has one or two of them, read once")]
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Claim {
    Related(Restriction),
    Value(Filter),
    Size(Sized),
    Kind(Noun),
}

/// What a question asks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Query {
    /// Where is it.
    Where(Noun),
    /// In which room, on which floor.
    RoomOf(Noun),
    /// Which are there.
    Find(Noun),
    Count(Noun),
    /// Whether there is one; of several, whether there are all, or any. `negated` for «… нет?»
    Exists {
        what: Vec<Noun>,
        either: bool,
        negated: bool,
    },
    /// Whether all claims hold of the subject.
    Holds {
        subject: Noun,
        claims: Vec<Claim>,
        negated: bool,
    },
    /// Which of several claims hold: "open or closed", «на столе или на полке».
    Choice {
        subject: Noun,
        claims: Vec<Claim>,
    },
    /// What the subject stands on, lies in …: the other end of a relation.
    Anchor {
        rel: Rel,
        of: Noun,
        what: Option<Noun>,
    },
    Property {
        property: Property,
        of: Noun,
    },
    Size {
        dimension: Dimension,
        of: Noun,
    },
    Parts(Noun),
    /// Which rooms a door joins.
    Leads(Noun),
    Way {
        from: Option<Noun>,
        to: Noun,
        detail: Detail,
    },
    CanReach {
        from: Option<Noun>,
        to: Noun,
    },
    /// A way by its rooms and doors.
    Passing {
        from: Option<Noun>,
        to: Noun,
        /// «через коридор»: rooms and doors that it leads through, in this order.
        through: Vec<Noun>,
        /// «не заходя в кухню»
        avoiding: Vec<Noun>,
        asks: Passing,
    },
    Distance {
        from: Option<Noun>,
        to: Noun,
    },
    /// How long the way takes.
    Duration {
        from: Option<Noun>,
        to: Noun,
    },
    /// Which of two ways is shorter, or longer.
    WhichWay {
        of: Vec<(Option<Noun>, Noun)>,
        extreme: Extreme,
    },
    /// Is `what` closer to `near` than to `than`.
    Closer {
        what: Noun,
        near: Noun,
        than: Noun,
        closeness: Closeness,
    },
    /// Which of two or more is closer to another, or bigger.
    WhichMore {
        of: Vec<Noun>,
        extreme: Extreme,
        to: Option<Noun>,
    },
    /// Is the first bigger than the second, or closer to the third than it.
    Larger {
        what: Noun,
        than: Noun,
        extreme: Extreme,
        to: Option<Noun>,
        /// By how much is asked, not whether.
        by: bool,
    },
    /// Of which there are more; `asks` which, else whether it is the first.
    MoreOf {
        of: [Noun; 2],
        extreme: Extreme,
        asks: bool,
        /// By how many is asked.
        by: bool,
    },
    /// Have both the same value.
    Same {
        property: Property,
        of: [Noun; 2],
    },
    /// Have all the same value.
    SameAll {
        property: Property,
        of: Noun,
    },
    /// Are all in one room, on one table.
    Together {
        of: Vec<Noun>,
        rel: Rel,
        place: Noun,
    },
    /// In what two things differ, or what they have in common.
    Differ {
        of: Vec<Noun>,
        alike: bool,
    },
    /// How much of it is free.
    Free(Noun),
    /// Where one can sit, lie, put something.
    Place {
        use_for: Use,
        what: Option<Noun>,
        within: Vec<Restriction>,
        /// Whether there is one at all, rather than which.
        whether: bool,
    },
    /// What serves for a deed: things of a sort, as it was asked for.
    Serving {
        sort: u16,
        of: Noun,
        asked: Asked,
    },
    /// What such things are used for.
    Purpose(Noun),
    LastSeen(Noun),
    Before(Noun),
    WhereAreYou(Detail),
    /// «Где я?»: the robot knows its own place only.
    WhereAmI,
    /// Several questions in one sentence, each answered by itself.
    Several(Vec<Self>),
    /// Who is somewhere: the people whom the map has among its things.
    People {
        within: Vec<Restriction>,
    },
    /// Which kinds of such things there are, or how many.
    Kinds {
        of: Noun,
        count: bool,
    },
    /// What the robot is and can be asked.
    Help,
    /// Nothing is asked: a greeting, thanks.
    Courtesy(Courtesy),
    WhatDoYouSee,
    /// What the robot did last.
    Deeds,
    /// What is not as the map has it.
    Changed,
    /// What of the map the robot has not seen.
    Unseen,
    /// How well the robot knows where it is.
    Sureness,
    /// Whether one of such things is in the robot's view.
    Sees(Noun),
    WhatDoYouHold,
    Describe(Noun),
    /// What was read by the grammar files and has been answered: the form that it took, and the rule that ran.
    Ran {
        form: &'static str,
        rule: String,
    },
    /// A fact in the notation of the rules: `ON_TOP_OF(Cup 1, Table 1)`.
    Noted {
        relation: String,
        args: Vec<String>,
    },
    /// Of the last answer, or of a claim.
    Why {
        negated: bool,
        about: Option<Box<Self>>,
    },
}

/// What is asked of a way by its rooms and doors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Passing {
    /// How it leads.
    How,
    /// Whether there is one.
    Whether,
    /// Whether all ways lead so: "Do I have to go through the hall?"
    Must,
    /// Whether there is one on which no door is shut.
    Unopened,
    /// Whether a door must be opened: no to what `Unopened` says yes to.
    Opens,
    /// Whether one door is all that lies between.
    Directly,
    /// How many doors are on it.
    Doors,
    /// How many rooms lie between its ends.
    Rooms,
}

/// What is asked of things that serve for a deed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Asked {
    What,
    Where,
    Whether,
    HowMany,
    /// Whether those that are named will do.
    Suits,
}

/// What a place is to be good for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Use {
    Sit,
    Lie,
    Put,
}

impl Noun {
    /// What is told by itself, not described.
    pub(super) fn of(things: Vec<Thing>) -> Self {
        Self { head: Head { things: Some(things), ..Head::default() }, ..Self::default() }
    }

    /// Whether its number says that several are meant, or none.
    pub(super) fn counts_several(&self) -> bool {
        self.best.is_none() && self.count.is_some_and(|n| n != 1)
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
        if let Some((_, other)) = &mut self.beyond {
            other.each(act);
        }
    }
}

impl Claim {
    fn each(&mut self, act: &mut dyn FnMut(&mut Noun)) {
        match self {
            Self::Related(restriction) => restriction.anchors.iter_mut().for_each(|a| a.each(act)),
            Self::Kind(noun) => noun.each(act),
            Self::Value(_) | Self::Size(_) => {}
        }
    }
}

impl Query {
    /// The same question about something else: what stands in it first.
    /// What the question measures against each other, each by its own description.
    pub(super) fn compares(&self) -> Vec<&Noun> {
        match self {
            Self::Distance { from: Some(from), to } => vec![to, from],
            Self::WhichMore { of, .. } => of.iter().collect(),
            Self::Larger { what, than, .. } => vec![what, than],
            Self::Closer { near, than, .. } => vec![near, than],
            Self::Same { of, .. } => of.iter().collect(),
            _ => Vec::new(),
        }
    }

    pub(super) fn of_another(mut self, noun: &Noun) -> Self {
        let mut is_first = true;
        self.each_noun(&mut |old| {
            if std::mem::take(&mut is_first) {
                old.clone_from(noun);
            }
        });
        self
    }

    /// The one description of what is looked for, counted, or said to exist.
    pub(super) fn sought(&self) -> Option<&Noun> {
        match self {
            Self::Find(noun) | Self::Count(noun) | Self::Serving { of: noun, .. } => Some(noun),
            Self::Exists { what, .. } => match &what[..] {
                [noun] => Some(noun),
                _ => None,
            },
            _ => None,
        }
    }

    /// Does something to every noun of the query.
    pub(super) fn each_noun(&mut self, act: &mut dyn FnMut(&mut Noun)) {
        match self {
            Self::Where(noun)
            | Self::RoomOf(noun)
            | Self::Find(noun)
            | Self::Count(noun)
            | Self::Parts(noun)
            | Self::Leads(noun)
            | Self::Free(noun)
            | Self::LastSeen(noun)
            | Self::Before(noun)
            | Self::Sees(noun)
            | Self::Serving { of: noun, .. }
            | Self::Purpose(noun)
            | Self::Describe(noun) => noun.each(act),
            Self::Exists { what, .. } | Self::Differ { of: what, .. } => {
                what.iter_mut().for_each(|n| n.each(act));
            }
            Self::Together { of, place, .. } => {
                of.iter_mut().for_each(|n| n.each(act));
                place.each(act);
            }
            Self::Holds { subject, claims, .. } | Self::Choice { subject, claims } => {
                subject.each(act);
                claims.iter_mut().for_each(|c| c.each(act));
            }
            Self::Anchor { of, what, .. } => {
                of.each(act);
                what.iter_mut().for_each(|n| n.each(act));
            }
            Self::Kinds { of, .. }
            | Self::Property { of, .. }
            | Self::Size { of, .. }
            | Self::SameAll { of, .. } => of.each(act),
            Self::Way { from, to, .. }
            | Self::CanReach { from, to }
            | Self::Duration { from, to }
            | Self::Distance { from, to } => {
                from.iter_mut().for_each(|n| n.each(act));
                to.each(act);
            }
            Self::Passing { from, to, through, avoiding, .. } => {
                let others = through.iter_mut().chain(avoiding).chain([to]);
                from.iter_mut().chain(others).for_each(|n| n.each(act));
            }
            Self::WhichWay { of, .. } => {
                for (from, to) in of {
                    from.iter_mut().chain([to]).for_each(|n| n.each(act));
                }
            }
            Self::Closer { what, near, than, .. } => {
                [what, near, than].into_iter().for_each(|n| n.each(act));
            }
            Self::WhichMore { of, to, .. } => {
                of.iter_mut().chain(to.iter_mut()).for_each(|n| n.each(act));
            }
            Self::Larger { what, than, to, .. } => {
                what.each(act);
                than.each(act);
                to.iter_mut().for_each(|n| n.each(act));
            }
            Self::Same { of, .. } | Self::MoreOf { of, .. } => {
                of.iter_mut().for_each(|n| n.each(act))
            }
            Self::Place { what, within, .. } => {
                what.iter_mut().for_each(|n| n.each(act));
                within.iter_mut().flat_map(|r| &mut r.anchors).for_each(|n| n.each(act));
            }
            Self::Why { about, .. } => {
                if let Some(query) = about {
                    query.each_noun(act);
                }
            }
            Self::Several(queries) => queries.iter_mut().for_each(|q| q.each_noun(act)),
            Self::People { within } => {
                within.iter_mut().flat_map(|r| &mut r.anchors).for_each(|n| n.each(act));
            }
            Self::WhereAreYou(_)
            | Self::WhereAmI
            | Self::Help
            | Self::Courtesy(_)
            | Self::WhatDoYouSee
            | Self::Deeds
            | Self::Changed
            | Self::Unseen
            | Self::Sureness
            | Self::Noted { .. }
            | Self::Ran { .. }
            | Self::WhatDoYouHold => {}
        }
    }

    /// A stable word for the kind of question, for programs.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Where(_) => "where",
            Self::RoomOf(_) => "room_of",
            Self::Find(_) => "find",
            Self::Count(_) => "count",
            Self::Exists { .. } => "exists",
            Self::Holds { .. } => "holds",
            Self::Choice { .. } => "choice",
            Self::Anchor { .. } => "anchor",
            Self::Property { .. } => "property",
            Self::Size { .. } => "size",
            Self::Parts(_) => "parts",
            Self::Leads(_) => "leads",
            Self::Way { .. } => "way",
            Self::CanReach { .. } => "can_reach",
            Self::Passing { .. } => "passing",
            Self::Distance { .. } => "distance",
            Self::Duration { .. } => "duration",
            Self::WhichWay { .. } => "which_way",
            Self::Closer { .. } => "closer",
            Self::WhichMore { .. } => "which_more",
            Self::Larger { .. } => "larger",
            Self::MoreOf { .. } => "more_of",
            Self::Same { .. } | Self::SameAll { .. } => "same",
            Self::Together { .. } => "together",
            Self::Differ { .. } => "differ",
            Self::Free(_) => "free",
            Self::Place { .. } => "place",
            Self::Serving { .. } => "serving",
            Self::Purpose(_) => "purpose",
            Self::LastSeen(_) => "last_seen",
            Self::Before(_) => "before",
            Self::WhereAreYou(_) => "where_are_you",
            Self::WhereAmI => "where_am_i",
            Self::Several(_) => "several",
            Self::People { .. } => "people",
            Self::Kinds { .. } => "kinds",
            Self::Help => "help",
            Self::Courtesy(_) => "courtesy",
            Self::WhatDoYouSee => "what_do_you_see",
            Self::Deeds => "deeds",
            Self::Changed => "changed",
            Self::Unseen => "unseen",
            Self::Sureness => "sureness",
            Self::Sees(_) => "sees",
            Self::WhatDoYouHold => "what_do_you_hold",
            Self::Describe(_) => "describe",
            Self::Noted { .. } => "fact",
            Self::Ran { form, .. } => form,
            Self::Why { .. } => "why",
        }
    }
}
