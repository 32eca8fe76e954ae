//! Conditions beyond literals over the objects of a problem: whether they hold, and the cases that they fall into.
//!
//! An action under a condition with «or», «for all» or «there is», or with effects under conditions, becomes several ground
//! actions of the same name, one a case (B. Gazen, C. Knoblock, 1997): each case says of all that matters whether it
//! holds, so a plan has as many actions and steps as before, and what it needs is what that case needs.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;

use super::domain::{Domain, Formula, KindSet, SchemaAtom, SchemaTerm};
use super::resolve::{GroundAtom, Resolved, ThingId};
use crate::units::{InOrder as _, name_key};

/// Into more cases than these no ground action is divided.
pub(super) const MOST_CASES: usize = 4096;
/// Steps that dividing one action may take.
const MOST_WORK: usize = 4_000_000;

/// The objects that a quantifier ranges over.
pub(super) struct Objects<'a> {
    domain: &'a Domain,
    resolved: &'a Resolved,
    of: RefCell<HashMap<KindSet, Rc<[ThingId]>>>,
}

impl<'a> Objects<'a> {
    pub(super) fn new(domain: &'a Domain, resolved: &'a Resolved) -> Self {
        Self { domain, resolved, of: RefCell::default() }
    }

    fn of(&self, kinds: &KindSet) -> Rc<[ThingId]> {
        let mut known = self.of.borrow_mut();
        let stands = |thing: &ThingId| {
            let have = &self.resolved.things[thing.index()].kinds;
            kinds.is_empty() || self.domain.fits(have, kinds)
        };
        let all = || (0..self.resolved.things.len() as u32).map(ThingId).filter(stands).collect();
        known.entry(kinds.clone()).or_insert_with(all).clone()
    }

    pub(super) fn value(&self, term: &SchemaTerm, binding: &[ThingId]) -> ThingId {
        match term {
            SchemaTerm::Constant(name) => self.resolved.index[&name_key(name)],
            SchemaTerm::Parameter(number) => binding[*number as usize],
        }
    }

    pub(super) fn ground(&self, atom: &SchemaAtom, binding: &[ThingId]) -> GroundAtom {
        let args = atom.args.iter().map(|term| self.value(term, binding)).collect();
        GroundAtom { predicate: atom.predicate, args }
    }

    /// Every choice of objects for the variables of a quantifier, until `f` says that it is enough; whether it did.
    pub(super) fn each_choice(
        &self,
        variables: &[KindSet],
        binding: &mut Vec<ThingId>,
        f: &mut dyn FnMut(&mut Vec<ThingId>) -> bool,
    ) -> bool {
        let Some((first, rest)) = variables.split_first() else { return f(binding) };
        for &thing in self.of(first).iter() {
            binding.push(thing);
            let is_enough = self.each_choice(rest, binding, f);
            binding.pop();
            if is_enough {
                return true;
            }
        }
        false
    }

    /// Whether all formulas hold where `holds` says it of literals, the second argument whether they are negated.
    pub(super) fn all_hold(
        &self,
        formulas: &[Formula],
        binding: &mut Vec<ThingId>,
        holds: &dyn Fn(&GroundAtom, bool) -> bool,
    ) -> bool {
        formulas.iter().all(|formula| match formula {
            Formula::Literal { atom, negated } => holds(&self.ground(atom, binding), *negated),
            Formula::Equal { pair: (left, right), negated } => {
                (self.value(left, binding) == self.value(right, binding)) != *negated
            }
            Formula::Any(cases) => cases.iter().any(|case| self.all_hold(case, binding, holds)),
            Formula::Quantified { every, variables, body } => {
                let mut decides =
                    |binding: &mut Vec<ThingId>| self.all_hold(body, binding, holds) != *every;
                self.each_choice(variables, binding, &mut decides) != *every
            }
        })
    }
}

/// Literals that hold together: the numbers of atoms, and whether each is to be absent; sorted.
pub(super) type Case = Vec<(u32, bool)>;

/// More cases, or more work, than anybody plans with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TooMany;

/// What is known of an atom before any planning.
pub(super) enum Known {
    Always,
    Never,
    /// It changes, and has this number.
    Changes(u32),
    /// It holds where one of these rules does.
    Derived(Rc<[Body]>),
}

/// A rule of what is derived, over objects.
pub(super) struct Body {
    pub(super) rule: usize,
    pub(super) args: Vec<ThingId>,
}

/// Divides conditions into cases.
pub(super) struct Cases<'a> {
    pub(super) objects: &'a Objects<'a>,
    pub(super) domain: &'a Domain,
    pub(super) known: &'a dyn Fn(&GroundAtom) -> Known,
    /// Derived atoms that are being divided: within its own proof an atom does not hold yet.
    open: RefCell<Vec<GroundAtom>>,
    work: Cell<usize>,
}

type Found = Result<Vec<Case>, TooMany>;

impl<'a> Cases<'a> {
    pub(super) fn new(
        objects: &'a Objects<'a>,
        domain: &'a Domain,
        known: &'a dyn Fn(&GroundAtom) -> Known,
    ) -> Self {
        Self { objects, domain, known, open: RefCell::default(), work: Cell::new(0) }
    }

    /// Of a rule's whole condition over these objects, or of its opposite.
    pub(super) fn of_rule(&self, rule: usize, args: &[ThingId], negated: bool) -> Found {
        let rule = self.domain.rule(rule);
        let mut parts = Parts { negated, found: None };
        let literals = rule.preconditions.iter().map(|atom| (atom, false));
        for (atom, is_negative) in
            literals.chain(rule.negative_preconditions.iter().map(|a| (a, true)))
        {
            let atom = self.objects.ground(atom, args);
            parts.join(self, self.literal(&atom, is_negative != negated)?)?;
        }
        let mut binding = args.to_vec();
        for formula in &rule.formulas {
            parts.join(self, self.formula(formula, &mut binding, negated)?)?;
        }
        Ok(parts.end())
    }

    /// Of all formulas together, or of the opposite of that.
    pub(super) fn of_all(
        &self,
        formulas: &[Formula],
        binding: &mut Vec<ThingId>,
        negated: bool,
    ) -> Found {
        let mut parts = Parts { negated, found: None };
        for formula in formulas {
            parts.join(self, self.formula(formula, binding, negated)?)?;
        }
        Ok(parts.end())
    }

    pub(super) fn literal(&self, atom: &GroundAtom, negated: bool) -> Found {
        let all = |holds: bool| if holds { vec![Case::new()] } else { Vec::new() };
        Ok(match (self.known)(atom) {
            Known::Always => all(!negated),
            Known::Never => all(negated),
            Known::Changes(number) => vec![vec![(number, negated)]],
            Known::Derived(_) if self.open.borrow().contains(atom) => all(negated),
            Known::Derived(bodies) => {
                self.open.borrow_mut().push(atom.clone());
                // One of the bodies; to be absent, none of them.
                let mut parts = Parts { negated: !negated, found: None };
                for body in bodies.iter() {
                    parts.join(self, self.of_rule(body.rule, &body.args, negated)?)?;
                }
                self.open.borrow_mut().pop();
                parts.end()
            }
        })
    }

    fn formula(&self, formula: &Formula, binding: &mut Vec<ThingId>, negated: bool) -> Found {
        match formula {
            Formula::Literal { atom, negated: is_negative } => {
                self.literal(&self.objects.ground(atom, binding), *is_negative != negated)
            }
            Formula::Equal { pair: (left, right), negated: differs } => {
                let (left, right) =
                    (self.objects.value(left, binding), self.objects.value(right, binding));
                let holds = ((left == right) != *differs) != negated;
                Ok(if holds { vec![Case::new()] } else { Vec::new() })
            }
            Formula::Any(cases) => {
                let mut parts = Parts { negated: !negated, found: None };
                for case in cases {
                    parts.join(self, self.of_all(case, binding, negated)?)?;
                }
                Ok(parts.end())
            }
            Formula::Quantified { every, variables, body } => {
                let mut parts = Parts { negated: *every == negated, found: None };
                let mut failed = Ok(());
                self.objects.each_choice(variables, binding, &mut |binding| {
                    let one = self.of_all(body, binding, negated);
                    failed = one.and_then(|one| parts.join(self, one));
                    failed.is_err()
                });
                failed?;
                Ok(parts.end())
            }
        }
    }

    /// Every pair of cases that can be true together.
    pub(super) fn both(&self, left: &[Case], right: &[Case]) -> Found {
        self.spend(left.len() * right.len())?;
        let mut both = Vec::new();
        for one in left {
            both.extend(right.iter().filter_map(|other| together(one, other)));
            if both.len() > 2 * MOST_CASES {
                both = self.without_special(both)?;
                if both.len() > MOST_CASES {
                    return Err(TooMany);
                }
            }
        }
        self.without_special(both)
    }

    /// Without the cases that say more than another of them.
    pub(super) fn without_special(&self, mut cases: Vec<Case>) -> Found {
        cases.order_by(|a, b| (a.len(), a).cmp(&(b.len(), b)));
        cases.dedup();
        self.spend(cases.len())?;
        let mut kept: Vec<Case> = Vec::new();
        for case in cases {
            self.spend(kept.len() / 16)?;
            if !kept
                .iter()
                .any(|general| general.iter().all(|part| case.binary_search(part).is_ok()))
            {
                kept.push(case);
            }
        }
        if kept.len() > MOST_CASES { Err(TooMany) } else { Ok(kept) }
    }

    fn spend(&self, work: usize) -> Result<(), TooMany> {
        self.work.set(self.work.get() + work + 1);
        if self.work.get() > MOST_WORK { Err(TooMany) } else { Ok(()) }
    }
}

/// A conjunction in the making, or, where it is negated, a disjunction.
struct Parts {
    negated: bool,
    found: Option<Vec<Case>>,
}

impl Parts {
    fn join(&mut self, with: &Cases<'_>, part: Vec<Case>) -> Result<(), TooMany> {
        self.found = Some(match self.found.take() {
            None => part,
            Some(mut found) if self.negated => {
                found.extend(part);
                with.without_special(found)?
            }
            Some(found) => with.both(&found, &part)?,
        });
        Ok(())
    }

    /// Nothing at all holds as a conjunction, and does not as a disjunction.
    fn end(self) -> Vec<Case> {
        self.found.unwrap_or_else(|| if self.negated { Vec::new() } else { vec![Case::new()] })
    }
}

/// Both cases, unless they contradict each other.
pub(super) fn together(one: &Case, other: &Case) -> Option<Case> {
    let mut both: Case = one.iter().chain(other).copied().collect();
    both.sort_unstable();
    both.dedup();
    both.windows(2).all(|pair| pair[0].0 != pair[1].0).then_some(both)
}
