//! What a question asks, as data: on top of descriptions ([`Noun`]) the place, the number, whether there is one, a measure.

use crate::report::Detail;

pub(super) use super::compared::{Closeness, Dimension, Extreme, Quantity, Sized};
pub(super) use super::noun::Side;
pub use super::noun::{Best, Filter, Head, Noun, Reach, Rel, Restriction, Thing};
use super::values::Property;

/// What is said of a subject.
#[expect(clippy::large_enum_variant, reason = "a question has one or two of them, read once")]
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Claim {
    Related(Restriction),
    Value(Filter),
    Size(Sized),
    Kind(Noun),
}

/// What politeness answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Courtesy {
    Greeting,
    Thanks,
    Farewell,
    HowAreYou,
    /// «хорошо», "okay"
    Assent,
}

/// How a question denies what it asks about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Denial {
    #[default]
    None,
    /// Yes and no are said of the denial: «Телевизор не включён?» – «Да, он выключен».
    Taken,
    /// Yes and no are said of what is denied: "Isn't the TV on?" – "No, it is off".
    Idle,
    /// Neither yes nor no is said: «Что есть на столе: миска или тарелка?»
    Unasked,
}

impl Denial {
    /// Whether yes and no are said of the denial.
    #[must_use]
    pub fn is_taken(self) -> bool {
        self == Self::Taken
    }
}

impl From<bool> for Denial {
    fn from(is_taken: bool) -> Self {
        if is_taken { Self::Taken } else { Self::None }
    }
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
    /// Whether there is one; of several, whether there are all, or any.
    Exists {
        what: Vec<Noun>,
        either: bool,
        denial: Denial,
    },
    /// Whether all claims hold of the subject.
    Holds {
        subject: Noun,
        claims: Vec<Claim>,
        denial: Denial,
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
    /// Have all the same size, or height.
    SameSize {
        dimension: Dimension,
        of: Vec<Noun>,
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
    /// What serves for an activity: things of a sort, as it was asked for.
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
    Done,
    /// What is not as the map has it.
    Changed,
    /// What of the map the robot has not seen.
    Unseen,
    /// How well the robot knows where it is.
    Sureness,
    /// Whether one of such things is in the robot's view.
    Sees(Noun),
    /// Whether the robot can take one into its hand.
    Takes(Noun),
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
    /// How long it is.
    Far,
    /// How long it takes.
    Long,
}

/// What is asked of things that serve for an activity.
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

    /// The same question about something else: what stands in it first.
    pub(super) fn of_another(mut self, noun: &Noun) -> Self {
        self.first_noun(|old| old.clone_from(noun));
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

    /// Whether what is sought is sought "there" alone.
    pub(super) fn is_of_there(&self) -> bool {
        let there = |place: &Restriction| place.rel == Rel::There;
        self.sought().is_some_and(|noun| {
            !noun.restrictions.is_empty() && noun.restrictions.iter().all(there)
        })
    }

    /// Does something to what the query is about first.
    pub(super) fn first_noun(&mut self, act: impl FnOnce(&mut Noun)) {
        let mut act = Some(act);
        self.each_noun(&mut |noun| {
            if let Some(act) = act.take() {
                act(noun);
            }
        });
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
            | Self::Takes(noun)
            | Self::Serving { of: noun, .. }
            | Self::Purpose(noun)
            | Self::Describe(noun) => noun.each(act),
            Self::Exists { what, .. }
            | Self::Differ { of: what, .. }
            | Self::SameSize { of: what, .. } => {
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
            | Self::Done
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
            Self::Same { .. } | Self::SameAll { .. } | Self::SameSize { .. } => "same",
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
            Self::Done => "done",
            Self::Changed => "changed",
            Self::Unseen => "unseen",
            Self::Sureness => "sureness",
            Self::Sees(_) => "sees",
            Self::Takes(_) => "takes",
            Self::WhatDoYouHold => "what_do_you_hold",
            Self::Describe(_) => "describe",
            Self::Noted { .. } => "fact",
            Self::Ran { form, .. } => form,
            Self::Why { .. } => "why",
        }
    }
}
