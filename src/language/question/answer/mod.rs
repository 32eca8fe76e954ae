//! From a query to its answer: what was found, the facts it rests on, and the sentence.

mod claim;
mod compare;
mod each;
mod found;
mod kinds;
mod leading;
mod lifts;
mod nothing;
mod part;
mod passing;
mod place;
mod property;
mod senses;
mod serving;
mod size;
mod state;
mod taking;
mod together;
mod unsure;
mod usable;
mod way;

use super::knowledge::Knowledge;
use super::query::{Best, Extreme, Noun, Query, Rel, Thing};
use super::speech::sentence;
use super::values::Property;
use super::{Answer, Doubt, Fact, Said, truth as said_to_be};

/// An answer on its way: what is known of it beside its words.
#[derive(Debug, Default)]
pub(super) struct Draft {
    said: Option<Said>,
    text: String,
    things: Vec<Thing>,
    facts: Vec<Fact>,
    /// What pronouns mean from now on, beside the things.
    topic: Vec<Thing>,
    number: Option<f64>,
}

/// Things in groups of one key, both in the order in which they come.
fn grouped<K: PartialEq>(
    things: &[Thing],
    mut key: impl FnMut(Thing) -> K,
) -> Vec<(K, Vec<Thing>)> {
    let mut groups: Vec<(K, Vec<Thing>)> = Vec::new();
    for &thing in things {
        let own = key(thing);
        match groups.iter_mut().find(|(other, _)| *other == own) {
            Some((_, same)) => same.push(thing),
            None => groups.push((own, vec![thing])),
        }
    }
    groups
}

impl Draft {
    fn new(said: Said, text: String) -> Self {
        Self { said: Some(said), text, ..Self::default() }
    }

    pub(super) fn plain(said: Said, text: String) -> Self {
        Self::new(said, text)
    }

    pub(super) fn text(&self) -> &str {
        &self.text
    }

    pub(super) fn rest_on(&mut self, fact: Fact) {
        self.facts.push(fact);
    }

    pub(super) fn with(mut self, things: Vec<Thing>) -> Self {
        self.things = things;
        self
    }

    fn about(mut self, topic: &[Thing]) -> Self {
        self.topic.extend_from_slice(topic);
        self
    }

    fn number(mut self, number: f64) -> Self {
        self.number = Some(number);
        self
    }
}

/// What the map does not say of some things, in Russian.
fn unsaid(property: &Property) -> &'static str {
    match property {
        Property::Material => "из чего сделаны",
        Property::Colour => "какого они цвета",
        Property::State => "в каком они состоянии",
        _ => "каковы они",
    }
}

impl Knowledge<'_> {
    /// # Errors
    /// A description that fits several things where one is meant, or none.
    pub(super) fn answer(&self, query: &Query) -> Result<Answer, Doubt> {
        let beyond = match query {
            Query::Find(noun) | Query::Count(noun) => self.unmeasured(noun)?,
            Query::Exists { what, .. } => what.first().map_or(Ok(None), |n| self.unmeasured(n))?,
            _ => None,
        };
        let draft = match query {
            _ if let Some(unmeasured) = beyond => unmeasured,
            Query::Where(noun) => self.say_where(noun)?,
            Query::RoomOf(noun) => self.room_of(noun)?,
            Query::Find(noun) => self.say_found(noun)?,
            Query::Count(noun) => self.count(noun)?,
            Query::Exists { what, either, denial } => self.exists(what, *either, *denial)?,
            Query::Holds { subject, claims, denial }
                if self.is_floor(subject) || self.is_walls(subject) =>
            {
                self.surface_is(subject, claims, denial.is_taken())?
            }
            Query::Holds { subject, claims, denial } => {
                match self.lift_goes(subject, claims, denial.is_taken())? {
                    Some(draft) => draft,
                    None => self.say_holds(subject, claims, denial.is_taken())?,
                }
            }
            Query::Choice { subject, claims } => self.choose(subject, claims)?,
            Query::Anchor { rel, of, what } => self.anchor(*rel, of, what.as_ref())?,
            Query::Property { property, of } => self.property(property, of)?,
            Query::Size { dimension, of } => self.size(*dimension, of)?,
            Query::Parts(noun) => self.parts(noun)?,
            Query::Leads(noun) => self.leads(noun)?,
            Query::Way { from, to, detail } => self.way(from.as_ref(), to, Some(*detail))?,
            Query::CanReach { from, to } => self.way(from.as_ref(), to, None)?,
            Query::Passing { from, to, through, avoiding, asks } => {
                self.passing(from.as_ref(), to, (through, avoiding), *asks)?
            }
            Query::Distance { from, to } => self.say_distance(from.as_ref(), to)?,
            Query::Duration { from, to } => self.duration(from.as_ref(), to)?,
            Query::WhichWay { of, extreme } => self.which_way(of, *extreme)?,
            Query::Closer { what, near, than, closeness } => {
                self.closer(what, near, than, *closeness)?
            }
            Query::WhichMore { of, extreme, to } => self.which_more(of, *extreme, to.as_ref())?,
            Query::Larger { what, than, extreme, to, by } => {
                self.larger(what, than, *extreme, to.as_ref(), *by)?
            }
            Query::MoreOf { of, extreme, asks, by } => self.more_of(of, *extreme, *asks, *by)?,
            Query::Same { property, of } => self.same(property, of)?,
            Query::SameAll { property, of } => self.same_all(property, of)?,
            Query::Together { of, rel, place } => self.together(of, *rel, place)?,
            Query::Differ { of, alike } => self.differ(of, *alike)?,
            Query::SameSize { dimension, of } => self.same_size(*dimension, of)?,
            Query::Free(noun) => self.free(noun)?,
            Query::Place { use_for, what, within, whether } => {
                let draft = self.usable(*use_for, what.as_ref(), within)?;
                if *whether { self.as_yes_or_no(draft) } else { draft }
            }
            Query::Serving { sort, of, asked } => self.serving(*sort, of, *asked)?,
            Query::Purpose(noun) => self.purpose(noun)?,
            Query::LastSeen(noun) => self.last_seen(noun)?,
            Query::Before(noun) => self.before(noun)?,
            Query::WhereAreYou(detail) => self.where_are_you(*detail),
            Query::WhereAmI => self.where_am_i(),
            Query::Several(queries) => return self.several(queries),
            Query::People { within } => self.people(within)?,
            Query::Kinds { of, count } => self.say_kinds(of, *count)?,
            Query::Help => self.help(),
            Query::Courtesy(courtesy) => self.courteous(*courtesy),
            Query::WhatDoYouSee => self.what_do_you_see(),
            Query::Sees(noun) => self.sees(noun)?,
            Query::Takes(noun) => self.may_take(noun)?,
            Query::Done => self.done(),
            Query::Changed => self.changed(),
            Query::Unseen => self.unseen(),
            Query::Sureness => self.sureness(),
            Query::WhatDoYouHold => self.what_do_you_hold(),
            Query::Describe(noun) => self.describe(noun)?,
            Query::Noted { relation, args } => self.say_noted(relation, args)?,
            // It is answered where it is read.
            Query::Ran { rule, .. } => return Err(Doubt::NotUnderstood { words: rule.clone() }),
            Query::Why { negated, about } => self.why(*negated, about.as_deref())?,
        };
        let mut draft = draft;
        // «левая тумбочка» is the left one for who looks from there.
        let mut sided = false;
        query.clone().each_noun(&mut |noun| {
            let side = |best: &Best| matches!(best.extreme, Extreme::LeftMost | Extreme::RightMost);
            sided |= noun.best.as_ref().is_some_and(side);
        });
        if sided && !draft.text.is_empty() {
            let seen = self.pick(" (если смотреть с моего места)", " (as seen from where I stand)");
            draft.text = format!("{}{seen}", draft.text.trim_end_matches('.'));
        }
        if let Some(untold) = query
            .sought()
            .and_then(|noun| self.all_untold(noun))
            .filter(|_| draft.things.is_empty())
        {
            draft.text = untold;
            draft.said = Some(Said::Unknown);
        }
        let denied =
            matches!(draft.said, Some(Said::No | Said::Nothing)) && draft.things.is_empty();
        if let Some(untold) = self.partly_untold(query).filter(|_| denied) {
            draft.text = self.as_far_as_told(&draft.text, untold);
            draft.said = Some(Said::Unknown);
        }
        if let Some(untold) = self.untold(query) {
            draft.text = format!("{}; {untold}", draft.text.trim_end_matches('.'));
        }
        let draft = self.hedged(query, self.as_measured(query, draft));
        let mut topic = draft.things.clone();
        topic.extend(draft.topic);
        Ok(Answer {
            query: query.clone(),
            language: self.language,
            said: draft.said.unwrap_or(Said::Found),
            text: sentence(&draft.text),
            symbols: draft.things.iter().map(|t| self.symbol(*t)).collect(),
            things: draft.things,
            facts: draft.facts,
            number: draft.number,
            topic,
            compared: self.measured_together(query),
            words: String::new(),
            so: said_to_be(draft.said.unwrap_or(Said::Found)),
            stamp: None,
        })
    }

    /// The things that a question measures against each other, where each is one.
    fn measured_together(&self, query: &Query) -> Vec<Thing> {
        let one = |noun: &&Noun| self.one(noun).ok();
        let mut things = Vec::new();
        for thing in query.compares().iter().map_while(one) {
            if !things.contains(&thing) {
                things.push(thing);
            }
        }
        if things.len() == query.compares().len() && things.len() > 1 { things } else { Vec::new() }
    }

    /// «Есть ли грязные тарелки?» where the map says of no plate whether it is dirty.
    fn all_untold(&self, noun: &Noun) -> Option<String> {
        let [filter] = &noun.filters[..] else { return None };
        if filter.negated || noun.head.anything || noun.best.is_some() {
            return None;
        }
        let all = self.find(&Noun { filters: Vec::new(), ..noun.clone() }, true).ok()?;
        if all.iter().any(|t| self.tells(*t, filter)) {
            return None;
        }
        self.unsaid(&self.lexicon().values.entry(filter.value).property, &all)
    }

    /// "Are there more red chairs than blue ones?": those of which the map does not tell it may be either.
    fn uncounted(&self, noun: &Noun) -> Option<String> {
        let [filter] = &noun.filters[..] else { return None };
        let property = &self.lexicon().values.entry(filter.value).property;
        if !matches!(property, Property::Colour | Property::Material) {
            return self.all_untold(noun);
        }
        let mut all = self.find(&Noun { filters: Vec::new(), ..noun.clone() }, true).ok()?;
        all.retain(|thing| !self.tells(*thing, filter));
        self.unsaid(property, &all)
    }

    /// "Are there glass things in the kitchen?", where none that the map tells of is: of how many it does not tell. What has no
    /// such state at all, as a table is neither on nor off, is none of them.
    fn partly_untold(&self, query: &Query) -> Option<usize> {
        let noun = query.sought()?;
        let [filter] = &noun.filters[..] else { return None };
        let property = &self.lexicon().values.entry(filter.value).property;
        let of_all = matches!(property, Property::Colour | Property::Material);
        if filter.negated || noun.best.is_some() || !of_all {
            return None;
        }
        let all = self.find(&Noun { filters: Vec::new(), ..noun.clone() }, true).ok()?;
        let untold = all.iter().filter(|thing| !self.tells(**thing, filter)).count();
        (untold > 0).then_some(untold)
    }

    /// What the map does not say of some things.
    fn unsaid(&self, property: &Property, all: &[Thing]) -> Option<String> {
        match *all {
            [] => None,
            [only] => Some(self.no_property(property, only)),
            _ => Some(match self.is_russian() {
                true => format!("не указано, {}: {}", unsaid(property), self.list(all)),
                false => {
                    let property = property.noun(self.language);
                    format!("the map does not give the {property} of {}", self.list(all))
                }
            }),
        }
    }

    /// «Какие столы не деревянные?»: those of whose material the map says nothing.
    fn untold(&self, query: &Query) -> Option<String> {
        let noun = match query {
            Query::Find(noun) | Query::Count(noun) => noun,
            Query::Exists { what, .. } => what.first()?,
            _ => return None,
        };
        let denied = noun.filters.iter().find(|filter| filter.negated)?;
        let told = noun.filters.iter().filter(|filter| !filter.negated).cloned().collect();
        let mut all = self.find(&Noun { filters: told, ..noun.clone() }, true).ok()?;
        all.retain(|t| !self.tells(*t, denied));
        let property = &self.lexicon().values.entry(denied.value).property;
        self.unsaid(property, &all)
    }

    /// The answers of several questions, one after the other.
    fn several(&self, queries: &[Query]) -> Result<Answer, Doubt> {
        let answers = queries.iter().map(|q| self.answer(q)).collect::<Result<Vec<_>, _>>()?;
        Ok(Answer::joined(answers, self.language))
    }

    fn fact(&self, rel: Rel, x: Thing, y: Thing) -> Option<Fact> {
        let (relation, a, b) = self.tuple(rel, x, y)?;
        Some(Fact::holding(relation, vec![self.symbol(a), self.symbol(b)]))
    }

    /// The fact that would have to hold.
    fn missing(&self, rel: Rel, x: Thing, y: Thing) -> Option<Fact> {
        let basis = super::knowledge::bases(rel).first()?;
        let (a, b) = if basis.swapped { (y, x) } else { (x, y) };
        let args = vec![self.symbol(a), self.symbol(b)];
        Some(Fact { relation: basis.relation.to_owned(), args, holds: false })
    }

    fn facts_of(&self, noun: &Noun, found: &[Thing]) -> Vec<Fact> {
        let mut facts = Vec::new();
        for filter in noun.filters.iter().filter(|filter| !filter.negated) {
            let wanted = &self.lexicon().values.entry(filter.value).property;
            for &thing in found.iter().take(50) {
                let own = self.valued(thing, filter.value);
                facts.extend(own.filter(|_| thing.replica().is_some()).map(|(_, _, text)| {
                    let name = self.property_name(thing, wanted, &text);
                    Fact::holding("HAS", vec![self.symbol(thing), name, text])
                }));
            }
        }
        for restriction in &noun.restrictions {
            let Some(anchor) = restriction.anchors.first() else { continue };
            if !restriction.negated && (self.is_walls(anchor) || self.is_floor(anchor)) {
                let held = |thing: &Thing| {
                    let (relation, room) = self.stands_in(restriction.rel, *thing, anchor)?;
                    Some(Fact::holding(relation, vec![self.symbol(*thing), self.symbol(room)]))
                };
                facts.extend(found.iter().take(50).filter_map(held));
                continue;
            }
            if restriction.rel == Rel::Between && !restriction.negated {
                let ends = self.ends_between(restriction).unwrap_or_default();
                if let [a, b] = ends[..]
                    && let (Some(_), Some(_)) = (a.replica(), b.replica())
                {
                    let fact = |thing: &Thing| {
                        let of = [*thing, a, b].map(|one| self.symbol(one));
                        Fact::holding("BETWEEN", of.to_vec())
                    };
                    facts.extend(found.iter().take(50).map(fact));
                }
                continue;
            }
            let Ok(anchors) = self.find(anchor, true) else { continue };
            for thing in found.iter().take(50) {
                facts.extend(anchors.iter().find_map(|a| self.fact(restriction.rel, *thing, *a)));
            }
        }
        facts
    }
}
