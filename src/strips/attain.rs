//! What can be attained when delete effects are forgotten, but what an action forbids is not: a fact counts as
//! absent when it does not hold at first or some attainable action takes it away.

use std::collections::{HashMap, HashSet};

use super::domain::{Domain, SchemaAtom};
use super::reachability::Reachability;
use super::resolve::{GroundAtom, Resolved};
use super::wanted::Wanted;

pub(super) struct Attainable<'a> {
    pub(super) initial: HashSet<&'a GroundAtom>,
    held: HashSet<&'a GroundAtom>,
    undone: HashSet<&'a GroundAtom>,
}

impl<'a> Attainable<'a> {
    pub(super) fn of(
        domain: &Domain,
        resolved: &'a Resolved,
        reached: &'a Reachability<'_>,
    ) -> Self {
        let initial: HashSet<&GroundAtom> = resolved.facts.iter().map(|(atom, _)| atom).collect();
        let ground = |atom: &SchemaAtom, instance: usize| {
            let atom = reached.instantiate(atom, &reached.instances[instance].args);
            reached.numbers.get(&atom).map(|&number| &reached.atoms[number])
        };
        let mut waiting: HashMap<(&GroundAtom, bool), Vec<usize>> = HashMap::new();
        let mut lacking = vec![0_usize; reached.instances.len()];
        for (number, instance) in reached.instances.iter().enumerate() {
            let schema = &domain.schemas[instance.schema];
            let wanted = schema.preconditions.iter().filter_map(|atom| ground(atom, number));
            let denied = schema.negative_preconditions.iter();
            let denied = denied.filter_map(|a| ground(a, number)).filter(|a| initial.contains(a));
            for need in wanted.map(|atom| (atom, true)).chain(denied.map(|atom| (atom, false))) {
                waiting.entry(need).or_default().push(number);
                lacking[number] += 1;
            }
        }
        let mut news: Vec<(&GroundAtom, bool)> = initial.iter().map(|&atom| (atom, true)).collect();
        let (mut held, mut undone) = (initial.clone(), HashSet::new());
        let mut ready: Vec<usize> = (0..lacking.len()).filter(|&at| lacking[at] == 0).collect();
        loop {
            for number in ready.drain(..) {
                let schema = &domain.schemas[reached.instances[number].schema];
                let adds = schema.add_effects.iter().filter_map(|atom| ground(atom, number));
                news.extend(adds.filter(|&atom| held.insert(atom)).map(|atom| (atom, true)));
                let added: Vec<&GroundAtom> =
                    schema.add_effects.iter().filter_map(|atom| ground(atom, number)).collect();
                let dels = schema.del_effects.iter().filter_map(|atom| ground(atom, number));
                let dels = dels.filter(|atom| !added.contains(atom));
                let dels = dels.filter(|&atom| initial.contains(atom) && undone.insert(atom));
                news.extend(dels.map(|atom| (atom, false)));
            }
            let Some(new) = news.pop() else { break };
            for &number in waiting.get(&new).into_iter().flatten() {
                lacking[number] -= 1;
                if lacking[number] == 0 {
                    ready.push(number);
                }
            }
        }
        Self { initial, held, undone }
    }

    pub(super) fn holds(&self, atom: &GroundAtom) -> bool {
        self.held.contains(atom)
    }

    pub(super) fn can_be(&self, wanted: &Wanted) -> bool {
        let can_be =
            |atom| if wanted.negated { self.may_be_absent(&atom) } else { self.holds(&atom) };
        wanted.closed().is_some_and(can_be)
    }

    pub(super) fn may_be_absent(&self, atom: &GroundAtom) -> bool {
        !self.initial.contains(atom) || self.undone.contains(atom)
    }
}
