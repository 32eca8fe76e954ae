//! Which words a sort of query takes up, by what its nouns tell.

use crate::question::mark::Mark;
use crate::question::query::{
    Best, Claim, Denial, Extreme, Noun, Passing, Quantity, Query, Rel, Restriction,
};

/// What the nouns of a query tell by comparing, counting and pointing.
#[derive(Default)]
pub(super) struct Told {
    pub(super) best: bool,
    /// A superlative among things that are named, of a kind, or were spoken of.
    pub(super) best_of_some: bool,
    pub(super) rank: bool,
    pub(super) beyond: bool,
    pub(super) like: bool,
    pub(super) other: bool,
    pub(super) counted: bool,
    pub(super) referent: bool,
    pub(super) either: bool,
    /// A superlative of how many.
    pub(super) most: bool,
    /// Something stands in a relation to something.
    pub(super) inward: bool,
    /// Some of what it has is there and some is not.
    pub(super) bounded: bool,
    /// Things are sought beside things of the same kind: "trees by the trees".
    pub(super) itself: bool,
    /// Something is "from" a thing that was spoken of, as no thing is.
    pub(super) parted: bool,
}

impl Told {
    pub(super) fn of(query: &mut Query) -> Self {
        let mut told = Self::default();
        if let Query::Holds { claims, .. } | Query::Choice { claims, .. } = &*query {
            for claim in claims {
                if let Claim::Value(filter) = claim {
                    told.either |= !filter.or.is_empty();
                }
            }
        }
        query.each_noun(&mut |noun| told.add(noun));
        told
    }

    fn add(&mut self, noun: &Noun) {
        let head = &noun.head;
        let some = !head.kinds.is_empty() || !head.named.is_empty() || head.things.is_some();
        self.best |= noun.best.is_some();
        self.best_of_some |= noun.best.is_some() && (some || !noun.restrictions.is_empty());
        self.rank |= noun.rank.is_some();
        self.beyond |= noun.beyond.is_some();
        self.like |= noun.like.is_some() || noun.same;
        self.other |= noun.other || !noun.except.is_empty();
        self.counted |= noun.count.is_some() || noun.quantity != Quantity::Exactly;
        self.referent |= head.things.is_some();
        self.either |= noun.filters.iter().any(|filter| !filter.or.is_empty())
            || noun.restrictions.iter().any(|place| place.anchors.len() > 1);
        self.inward |= !noun.restrictions.is_empty();
        let denied = noun.restrictions.iter().filter(|place| place.negated).count();
        self.bounded |= denied > 0 && denied < noun.restrictions.len();
        let alike = |anchor: &Noun| {
            let bare = |noun: &Noun| noun.filters.is_empty() && noun.best.is_none() && !noun.other;
            !head.kinds.is_empty()
                && anchor.head.kinds == head.kinds
                && bare(anchor)
                && anchor.restrictions.is_empty()
                && anchor.plural
                && head.named.is_empty()
        };
        self.itself |= noun.restrictions.iter().any(|r| r.anchors.iter().any(alike));
        let thing = |noun: &Noun| {
            let things = noun.head.things.as_deref().unwrap_or_default();
            !things.is_empty() && things.iter().all(|t| t.replica().is_some())
        };
        // "How many of them are eggs?" asks among them.
        let among = |r: &Restriction| {
            !head.kinds.is_empty()
                && matches!(&r.anchors[..], [a] if a.head.things.as_ref().is_some_and(|t| t.len() > 1))
        };
        self.parted |= noun
            .restrictions
            .iter()
            .any(|r| r.rel == Rel::From && r.anchors.iter().all(thing) && !among(r));
        let most = |best: &Best| matches!(best.extreme, Extreme::Most | Extreme::Fewest);
        self.most |= noun.best.as_ref().is_some_and(most);
    }
}

/// Whether a query of this sort takes up a word.
pub(super) fn answers(query: &Query, mark: Mark, told: &Told) -> bool {
    use Query as Q;
    // Yes or no.
    let unasked = matches!(query, Q::Exists { denial: Denial::Unasked, .. });
    let polar = matches!(
        query,
        Q::Exists { .. }
            | Q::Holds { .. }
            | Q::CanReach { .. }
            | Q::Closer { .. }
            | Q::Larger { by: false, .. }
            | Q::MoreOf { asks: false, by: false, .. }
            | Q::Together { .. }
            | Q::Same { .. }
            | Q::SameAll { .. }
            | Q::SameSize { .. }
            | Q::Sees(_)
            | Q::Takes(_)
    ) && !unasked;
    // "Why is it smaller?" asks of more than the last answer.
    if matches!(query, Q::Why { about: None, .. }) {
        let compares = matches!(
            mark,
            Mark::More(_) | Mark::Best(_) | Mark::BestTo(_) | Mark::Nearer(_) | Mark::HowMany
        );
        return !compares;
    }
    let whole = matches!(query, Q::Several(_) | Q::Why { .. } | Q::Help | Q::Differ { .. });
    if whole {
        return true;
    }
    match mark {
        // «больше, чем»
        Mark::What if matches!(query, Q::MoreOf { .. } | Q::Larger { .. } | Q::Closer { .. }) => {
            true
        }
        Mark::What | Mark::Which => !polar,
        // "How many does the kitchen have?" counts no kitchens.
        Mark::HowMany if matches!(query, Q::Count(noun) if !noun.plural && !noun.head.named.is_empty()) => {
            false
        }
        Mark::HowMany => matches!(
            query,
            Q::Count(_)
                | Q::MoreOf { .. }
                | Q::Passing { .. }
                | Q::Serving { .. }
                | Q::Kinds { .. }
                | Q::Free(_)
                | Q::Larger { by: true, .. }
                | Q::Size { .. }
                | Q::Distance { .. }
                | Q::Duration { .. }
                | Q::People { .. }
        ),
        Mark::HowFar => matches!(
            query,
            Q::Passing { asks: Passing::Far, .. }
                | Q::Distance { .. }
                | Q::WhichWay { .. }
                | Q::Way { .. }
                | Q::Duration { .. }
        ),
        Mark::HowLong => {
            matches!(query, Q::Duration { .. } | Q::Passing { asks: Passing::Long, .. })
        }
        Mark::When => matches!(query, Q::LastSeen(_) | Q::Before(_)),
        Mark::LastSeen | Mark::Last => matches!(query, Q::LastSeen(_)),
        Mark::Before => matches!(query, Q::Before(_) | Q::LastSeen(_)),
        Mark::Where => {
            !polar
                && !matches!(
                    query,
                    Q::Count(_)
                        | Q::Property { .. }
                        | Q::Size { .. }
                        | Q::Distance { .. }
                        | Q::Duration { .. }
                        | Q::Parts(_)
                )
        }
        Mark::Whither => matches!(
            query,
            Q::Where(_)
                | Q::Place { .. }
                | Q::Serving { .. }
                | Q::Leads(_)
                | Q::Find(_)
                | Q::Free(_)
                | Q::WhereAreYou(_)
        ),
        Mark::HowBig(_) => matches!(
            query,
            Q::Size { .. }
                | Q::SameSize { .. }
                | Q::Larger { .. }
                | Q::WhichMore { .. }
                | Q::Free(_)
                | Q::Find(_)
                | Q::Property { .. }
        ),
        Mark::Describe => matches!(query, Q::Describe(_) | Q::Way { .. } | Q::Passing { .. }),
        Mark::See => matches!(
            query,
            Q::WhatDoYouSee
                | Q::Sees(_)
                | Q::Find(_)
                | Q::Exists { .. }
                | Q::Count(_)
                | Q::LastSeen(_)
        ),
        Mark::Or => {
            told.either
                || matches!(
                    query,
                    Q::Choice { .. }
                        | Q::WhichMore { .. }
                        | Q::MoreOf { .. }
                        | Q::Exists { .. }
                        | Q::WhichWay { .. }
                        | Q::Together { .. }
                )
        }
        // What is not said to bound a denial bounds something that was not read.
        Mark::But => told.bounded,
        Mark::Than | Mark::ThanTo => {
            told.beyond
                || told.counted
                || matches!(query, Q::MoreOf { .. } | Q::Larger { .. } | Q::Closer { .. })
        }
        Mark::Nearer(_) => {
            told.best || matches!(query, Q::Closer { .. } | Q::WhichMore { .. } | Q::Larger { .. })
        }
        // Of two, or of those that are named: never of all that there is.
        Mark::More(_) => {
            told.beyond
                || told.best_of_some
                || told.counted
                || (told.other && matches!(query, Q::Exists { .. }))
                || matches!(
                    query,
                    Q::WhichMore { .. }
                        | Q::Larger { .. }
                        | Q::MoreOf { .. }
                        | Q::WhichWay { .. }
                        | Q::Anchor { .. }
                )
        }
        Mark::Best(_) | Mark::BestTo(_) => {
            told.best || matches!(query, Q::WhichMore { .. } | Q::Size { .. } | Q::WhichWay { .. })
        }
        Mark::Rank(_) => told.rank || told.referent || told.counted,
        Mark::Other => {
            told.other
                || told.like
                || told.referent
                || matches!(query, Q::Place { .. } | Q::Passing { .. })
        }
        Mark::Same | Mark::As => {
            told.like
                || told.inward
                || matches!(
                    query,
                    Q::Same { .. }
                        | Q::SameAll { .. }
                        | Q::SameSize { .. }
                        | Q::Together { .. }
                        | Q::Holds { .. }
                )
        }
        // "Where does the robot sleep?" asks for no place where it stands.
        Mark::Sit | Mark::LieDown | Mark::PutDown => {
            !matches!(query, Q::WhereAreYou(_) | Q::LastSeen(_) | Q::Before(_))
        }
        // «Кто оставил биту в спальне?» does not ask whether it is there.
        Mark::Who => !matches!(query, Q::Holds { .. }),
        // "I need the bathroom, how do I get out of the kitchen?" claims nothing of the two.
        Mark::HowGet => !matches!(query, Q::Holds { .. } | Q::Same { .. } | Q::Together { .. }),
        Mark::Kinds => matches!(query, Q::Kinds { .. }),
        Mark::Hold => matches!(query, Q::WhatDoYouHold | Q::Holds { .. }),
        Mark::Differ | Mark::Alike => false,
        Mark::Number(_) | Mark::OnlyOne => told.counted || matches!(query, Q::MoreOf { .. }),
        Mark::Unopened | Mark::MustOpen => matches!(query, Q::Passing { .. }),
        Mark::Without | Mark::Avoiding | Mark::Directly | Mark::Must => {
            told.inward || matches!(query, Q::Passing { .. } | Q::Way { .. } | Q::CanReach { .. })
        }
        _ => true,
    }
}
