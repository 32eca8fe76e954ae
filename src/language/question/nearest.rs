//! The nearest that serves where nothing fits all that was said: «чистая чашка» – another thing of the same use that is
//! clean, or a cup that is not.
//!
//! **Invariant**: a substitute fits all that was said but one thing: its kind, for which another of the same use stands, or
//! one value that nothing of its kind has. Which comes first is told by the value: a state says what a thing is wanted for, so
//! that the kind gives way; of a colour the value does.

use super::Asker;
use super::lexicon::{Extension, KindId};
use super::memory::Memory;
use super::purposes::{self, Role};
use super::query::{Head, Noun, Thing};
use super::values::Property;
use crate::units::{InOrder as _, ReplicaId};
use crate::words::Language;
use crate::words::things::things;

/// Sorts of more kinds are no use: all that can be carried serves for nothing in particular.
const MOST_KINDS: usize = 24;

impl Asker<'_> {
    /// The things that serve where nothing fits a description, those that come nearest first.
    #[must_use]
    pub fn nearest(&self, noun: &Noun, language: Language) -> Vec<ReplicaId> {
        let is_one = !noun.plural && noun.count.is_none_or(|count| count == 1) && !noun.all;
        if !is_one || noun.head.kinds.is_empty() || !noun.head.named.is_empty() {
            return Vec::new();
        }
        let memory = Memory::default();
        let knowledge = self.knowledge(language, &memory);
        let found = |noun: &Noun| -> Vec<ReplicaId> {
            let all = knowledge.find(noun, true).unwrap_or_default();
            all.into_iter().filter_map(Thing::replica).collect()
        };
        let values = &self.mind.lexicon.values;
        // A value that a thing of the kind has is not what is missing.
        let bare = Noun { head: noun.head.clone(), text: noun.text.clone(), ..Noun::default() };
        let is_missing = |n: &usize| {
            let one = Noun { filters: vec![noun.filters[*n].clone()], ..bare.clone() };
            found(&one).is_empty()
        };
        let missing: Vec<usize> = (0..noun.filters.len()).filter(is_missing).collect();
        // Of values that each thing of the kind has, only not one thing all of them, any may give way.
        let may_go: Vec<usize> = match missing[..] {
            [only] => vec![only],
            [] => (0..noun.filters.len()).collect(),
            _ => Vec::new(),
        };
        if may_go.is_empty() {
            return Vec::new();
        }
        let is_state = |n: &usize| values.entry(noun.filters[*n].value).property == Property::State;
        let mut without = Vec::new();
        // A state is the last to give way.
        let (states, others): (Vec<usize>, Vec<usize>) = may_go.into_iter().partition(is_state);
        let loses_state = others.is_empty();
        for n in others.into_iter().chain(states) {
            let mut filters = noun.filters.clone();
            filters.remove(n);
            let fit = found(&Noun { filters, ..noun.clone() });
            without.extend(fit.into_iter().filter(|id| !without.contains(id)).collect::<Vec<_>>());
        }
        let mut alike = Vec::new();
        for kinds in self.of_same_use(&noun.head.kinds) {
            let head = Head { kinds, ..Head::default() };
            let others = found(&Noun { head, ..noun.clone() });
            alike.extend(others.into_iter().filter(|id| !alike.contains(id)).collect::<Vec<_>>());
        }
        let (first, second) = if loses_state { (alike, without) } else { (without, alike) };
        let mut all = first;
        all.extend(second.into_iter().filter(|id| !all.contains(id)).collect::<Vec<_>>());
        all
    }

    /// The kinds of each use that these have, the narrowest use first.
    fn of_same_use(&self, kinds: &[KindId]) -> Vec<Vec<KindId>> {
        let lexicon = &self.mind.lexicon;
        let mut uses: Vec<Vec<KindId>> = (0..things().sorts.len())
            .filter_map(|n| u16::try_from(n).ok())
            .filter(|sort| matches!(purposes::role(*sort), Role::Source | Role::Instrument))
            .map(|sort| lexicon.kinds_of_sort(sort))
            .filter(|all| kinds.iter().any(|kind| all.contains(kind)) && all.len() <= MOST_KINDS)
            .map(|mut all| {
                // The sort itself means them all.
                all.retain(|kind| !matches!(lexicon.kind(*kind).extension, Extension::Sort(_)));
                all
            })
            .collect();
        uses.order_by_key(Vec::len);
        uses
    }
}
