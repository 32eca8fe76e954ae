//! A plan text carried out on the rules, step by step, to see whether and where it breaks.
//!
//! The replay works on the rules themselves, not on a grounded task: it is a second opinion on grounding and on
//! the planner, and it judges plans of others, who may take steps that the planner would never think of.

use std::cell::RefCell;
use std::collections::{BTreeMap, HashSet};

use super::cases::Objects;
use super::domain::{Domain, Formula, Schema, SchemaAtom, SchemaTerm};
use super::error::RuleError;
use super::fault::{RuleFault, RuleFaults};
use super::hint::{hint, perhaps};
use super::plan_text::{Directive, PlanText};
use super::price::cost;
use super::problem::Problem;
use super::resolve::{GroundAtom, Resolved, ThingId};
use crate::units::{Bilingual, Source, name_key, nearest_name, said};

/// What came of carrying out a plan.
#[derive(Debug, Clone)]
pub struct Replayed {
    /// The steps that could be carried out, by the numbers that the text gives them.
    pub steps: Vec<(u32, Vec<Directive>)>,
    /// What they cost together, in units of which [`Domain::cost_unit`] are one.
    pub cost: u64,
    pub cost_unit: u32,
    /// Where the plan breaks; none when it reaches the goal.
    pub broken: Option<Broken>,
}

/// Where a plan breaks, and why.
#[derive(Debug, Clone)]
pub struct Broken {
    /// The step that cannot be carried out; none when all could and a part of the goal does not hold.
    pub step: Option<u32>,
    /// Everything wrong with that step, and what in later ones means nothing to the rules; or the goals that do not
    /// hold.
    pub faults: RuleFaults,
}

impl Replayed {
    /// What they cost together, with the decimals that there are.
    #[must_use]
    pub fn cost_shown(&self) -> String {
        match self.cost_unit {
            1 => self.cost.to_string(),
            unit => (self.cost as f64 / f64::from(unit)).to_string(),
        }
    }
}

impl PlanText {
    /// Carries the plan out on the rules, step by step, as far as it goes.
    ///
    /// # Errors
    /// The problem itself means nothing to the rules.
    pub fn replay(&self, domain: &Domain, problem: &Problem) -> Result<Replayed, RuleFaults> {
        let resolved = problem.resolve(domain)?;
        let mut state: HashSet<GroundAtom> =
            resolved.facts.iter().map(|(atom, _)| atom.clone()).collect();
        let objects = Objects::new(domain, &resolved);
        let mut steps: BTreeMap<u32, Vec<&Directive>> = BTreeMap::new();
        for directive in &self.directives {
            steps.entry(directive.step).or_default().push(directive);
        }
        let replay =
            Replay { domain, resolved: &resolved, objects: &objects, source: &self.source };
        replay.derive(&mut state);
        let mut replayed =
            Replayed { steps: Vec::new(), cost: 0, cost_unit: domain.cost_unit(), broken: None };
        let mut steps = steps.into_iter();
        for (step, directives) in steps.by_ref() {
            match replay.step(&directives, &mut state) {
                Ok(cost) => {
                    replayed.cost += cost;
                    replayed.steps.push((step, directives.into_iter().cloned().collect()));
                }
                Err(mut faults) => {
                    // What means nothing to the rules is told of all that was still to come.
                    let later = steps.flat_map(|(_, directives)| directives);
                    let senseless = later.filter_map(|directive| replay.meaning(directive).err());
                    faults.0.extend(senseless.flat_map(|faults| faults.0));
                    replayed.broken = Some(Broken { step: Some(step), faults });
                    return Ok(replayed);
                }
            }
        }
        replayed.broken = replay.unmet(&state).map(|faults| Broken { step: None, faults });
        Ok(replayed)
    }

    /// Whether the plan works.
    ///
    /// # Errors
    /// Everything wrong in the first step that cannot be carried out, or the goals that do not hold at the end.
    pub fn check(&self, domain: &Domain, problem: &Problem) -> Result<(), RuleFaults> {
        match self.replay(domain, problem)?.broken {
            Some(broken) => Err(broken.faults),
            None => Ok(()),
        }
    }
}

struct Replay<'a> {
    domain: &'a Domain,
    resolved: &'a Resolved,
    objects: &'a Objects<'a>,
    source: &'a Source,
}

/// What a directive needs, deletes and then adds, and what it costs. What it deletes and adds holds after it, but within
/// its step nobody else may need or add it.
struct Instance {
    needs: Vec<GroundAtom>,
    denied: Vec<GroundAtom>,
    adds: Vec<GroundAtom>,
    dels: Vec<GroundAtom>,
    cost: u32,
}

impl Replay<'_> {
    /// The goals that do not hold, if any.
    fn unmet(&self, state: &HashSet<GroundAtom>) -> Option<RuleFaults> {
        let unmet =
            self.resolved.goal.iter().filter(|(atom, negated)| state.contains(atom) == *negated);
        let unequal = self.resolved.impossible.then(|| "=".to_owned());
        let faults: Vec<RuleFault> = unmet
            .map(|(atom, negated)| {
                format!("{}{}", if *negated { "НЕ " } else { "" }, self.shown(atom))
            })
            .chain(unequal)
            .chain(self.unmet_formulas(state))
            .map(|fact| RuleFault::placeless(RuleError::PlanMissesGoal { fact: told(fact) }))
            .collect();
        (!faults.is_empty()).then_some(RuleFaults(faults))
    }

    /// Conditions of the goal beyond literals that do not hold.
    fn unmet_formulas(&self, state: &HashSet<GroundAtom>) -> Vec<String> {
        let holds = |atom: &GroundAtom, negated: bool| state.contains(atom) != negated;
        let met = |formula: &&Formula| {
            self.objects.all_hold(std::slice::from_ref(*formula), &mut Vec::new(), &holds)
        };
        let unmet = self.resolved.goal_formulas.iter().filter(|formula| !met(formula));
        unmet.map(|formula| self.written(formula)).collect()
    }

    /// A condition by the names of its predicates.
    fn written(&self, formula: &Formula) -> String {
        let mut names: Vec<&str> = Vec::new();
        formula.for_each_literal(&mut |atom, _| {
            let name = self.domain.predicates[atom.predicate.index()].name.as_str();
            if !names.contains(&name) {
                names.push(name);
            }
        });
        format!("({} …)", names.join(" "))
    }

    /// What the rules derive anew: nothing of what was derived before stays for that alone.
    fn derive(&self, state: &mut HashSet<GroundAtom>) {
        if self.domain.derived.is_empty() {
            return;
        }
        state.retain(|atom| !self.domain.is_derived(atom.predicate));
        // Layer by layer: a rule that asks for something to be absent runs when that is known whole.
        for layer in self.domain.layers() {
            loop {
                let before = state.len();
                for rule in &layer {
                    let mut news = Vec::new();
                    self.objects.each_choice(&rule.parameters, &mut Vec::new(), &mut |binding| {
                        if self.condition_holds(rule, binding, state) {
                            news.push(self.objects.ground(&rule.add_effects[0], binding));
                        }
                        false
                    });
                    state.extend(news);
                }
                if state.len() == before {
                    break;
                }
            }
        }
    }

    fn condition_holds(
        &self,
        rule: &Schema,
        binding: &mut Vec<ThingId>,
        state: &HashSet<GroundAtom>,
    ) -> bool {
        let ground = |atom: &SchemaAtom| self.objects.ground(atom, binding);
        let equal = |(left, right): &(SchemaTerm, SchemaTerm)| {
            self.objects.value(left, binding) == self.objects.value(right, binding)
        };
        let literals = rule.preconditions.iter().all(|atom| state.contains(&ground(atom)))
            && !rule.negative_preconditions.iter().any(|atom| state.contains(&ground(atom)))
            && rule.equal.iter().all(equal)
            && !rule.different.iter().any(equal);
        let holds = |atom: &GroundAtom, negated: bool| state.contains(atom) != negated;
        literals && self.objects.all_hold(&rule.formulas, binding, &holds)
    }

    /// Carries out one step and says what it costs.
    fn step(
        &self,
        directives: &[&Directive],
        state: &mut HashSet<GroundAtom>,
    ) -> Result<u64, RuleFaults> {
        let mut faults = Vec::new();
        let mut instances = Vec::new();
        for directive in directives {
            match self.instance(directive, state) {
                Ok(instance) => instances.push((*directive, instance)),
                Err(fault) => faults.extend(fault.0),
            }
        }
        for (at, (first, a)) in instances.iter().enumerate() {
            for (second, b) in &instances[at + 1..] {
                let breaks = |x: &Instance, y: &Instance| {
                    let wanted =
                        |atom: &&GroundAtom| y.needs.contains(atom) || y.adds.contains(atom);
                    let gone = x.dels.iter().find(wanted);
                    gone.or_else(|| x.adds.iter().find(|atom| y.denied.contains(atom))).cloned()
                };
                if let Some(atom) = breaks(a, b).or_else(|| breaks(b, a)) {
                    faults.push(self.fault(RuleError::PlanInterference {
                        fact: self.shown(&atom).into(),
                        other: first.action.clone(),
                        at: second.at,
                    }));
                }
            }
        }
        if !faults.is_empty() {
            return Err(RuleFaults(faults));
        }
        for (_, instance) in &instances {
            instance.dels.iter().for_each(|atom| {
                state.remove(atom);
            });
        }
        let cost = instances.iter().map(|(_, instance)| u64::from(instance.cost)).sum();
        state.extend(instances.into_iter().flat_map(|(_, instance)| instance.adds));
        self.derive(state);
        Ok(cost)
    }

    fn instance(
        &self,
        directive: &Directive,
        state: &HashSet<GroundAtom>,
    ) -> Result<Instance, RuleFaults> {
        let (schema, args) = self.meaning(directive)?;
        let value = |term: &SchemaTerm| match term {
            SchemaTerm::Constant(name) => self.resolved.index[&name_key(name)],
            SchemaTerm::Parameter(parameter) => args[*parameter as usize],
        };
        let ground = |atoms: &[SchemaAtom]| -> Vec<GroundAtom> {
            let one = |atom: &SchemaAtom| GroundAtom {
                predicate: atom.predicate,
                args: atom.args.iter().map(value).collect(),
            };
            atoms.iter().map(one).collect()
        };
        let needs = ground(&schema.preconditions);
        let denied = ground(&schema.negative_preconditions);
        let missing =
            needs.iter().filter(|atom| !state.contains(atom)).map(|atom| self.shown(atom));
        let present =
            denied.iter().filter(|a| state.contains(a)).map(|a| format!("НЕ {}", self.shown(a)));
        let unequal =
            schema.equal.iter().filter(|(a, b)| value(a) != value(b)).map(|_| "=".to_owned());
        let equal =
            schema.different.iter().filter(|(a, b)| value(a) == value(b)).map(|_| "≠".to_owned());
        let holds = |atom: &GroundAtom, negated: bool| state.contains(atom) != negated;
        let unmet = schema.formulas.iter().filter(|formula| {
            !self.objects.all_hold(std::slice::from_ref(*formula), &mut args.clone(), &holds)
        });
        let unmet = unmet.map(|formula| self.written(formula));
        let faults: Vec<RuleFault> = missing
            .chain(present)
            .chain(unmet)
            .chain(unequal)
            .chain(equal)
            .map(|fact| {
                self.fault(RuleError::PlanPrecondition { fact: told(fact), at: directive.at })
            })
            .collect();
        if !faults.is_empty() {
            return Err(RuleFaults(faults));
        }
        let mut adds = ground(&schema.add_effects);
        let mut dels = ground(&schema.del_effects);
        dels.extend(ground(&schema.renewed));
        // An effect under a condition hangs on every literal of it, whether it comes about or not.
        let (needs, denied) = (RefCell::new(needs), RefCell::new(denied));
        let asked = |atom: &GroundAtom, negated: bool| {
            let is_there = state.contains(atom);
            let rests_on = if is_there { &needs } else { &denied };
            rests_on.borrow_mut().push(atom.clone());
            is_there != negated
        };
        for formula in &schema.formulas {
            self.objects.all_hold(std::slice::from_ref(formula), &mut args.clone(), &asked);
        }
        for effect in &schema.conditional {
            self.objects.each_choice(&effect.variables, &mut args.clone(), &mut |binding| {
                if self.objects.all_hold(&effect.condition, binding, &asked) {
                    let of = |atoms: &[SchemaAtom]| -> Vec<GroundAtom> {
                        atoms.iter().map(|atom| self.objects.ground(atom, binding)).collect()
                    };
                    adds.extend(of(&effect.add_effects));
                    dels.extend(of(&effect.del_effects));
                }
                false
            });
        }
        let (needs, denied) = (needs.into_inner(), denied.into_inner());
        Ok(Instance { needs, denied, adds, dels, cost: cost(schema, self.resolved, &args) })
    }

    /// The action and the objects that a directive names.
    fn meaning(&self, directive: &Directive) -> Result<(&Schema, Vec<ThingId>), RuleFaults> {
        let schema = self.schema(directive)?;
        Ok((schema, self.args(directive, schema)?))
    }

    fn schema(&self, directive: &Directive) -> Result<&Schema, RuleFaults> {
        let named = |name: &str| {
            let key = name_key(name);
            self.domain.schemas.iter().find(|schema| name_key(&schema.name) == key)
        };
        // The paper writes an underscore between a name and its bracket; only where no action is called so is it
        // taken for that.
        let plain = directive.action.trim_end_matches('_');
        named(&directive.action).or_else(|| named(plain)).ok_or_else(|| {
            let near = nearest_name(
                &directive.action,
                self.domain.schemas.iter().map(|s| s.name.as_str()),
            );
            let help = near.map(perhaps);
            self.fault(RuleError::UnknownAction {
                name: directive.action.clone(),
                help,
                at: directive.at,
            })
            .into()
        })
    }

    fn args(&self, directive: &Directive, schema: &Schema) -> Result<Vec<ThingId>, RuleFaults> {
        if directive.args.len() != schema.parameters.len() {
            let written = format!("({} {})", schema.name, schema.parameter_names.join(" "));
            return Err(self
                .fault(RuleError::Arity {
                    name: schema.name.clone(),
                    expected: schema.parameters.len(),
                    found: directive.args.len(),
                    help: said!("written", written),
                    at: directive.at,
                })
                .into());
        }
        let mut args = Vec::new();
        let mut faults = Vec::new();
        let named = directive.args.iter().zip(&directive.args_at);
        for ((name, &at), kinds) in named.zip(&schema.parameters) {
            let known = self.resolved.index.get(&name_key(name));
            let fits = |thing: &ThingId| {
                let have = &self.resolved.things[thing.index()].kinds;
                kinds.is_empty() || self.domain.fits(have, kinds)
            };
            let name = name.clone();
            faults.push(self.fault(match known {
                Some(&thing) if fits(&thing) => {
                    args.push(thing);
                    continue;
                }
                Some(_) => {
                    let expected = self.domain.kind_names(kinds);
                    RuleError::WrongObject { name, expected, at }
                }
                None => {
                    let things = self.resolved.things.iter();
                    let help = hint(&name, things.map(|thing| thing.name.as_str()));
                    RuleError::UnknownObject { name, help, at }
                }
            }));
        }
        if faults.is_empty() { Ok(args) } else { Err(RuleFaults(faults)) }
    }

    fn fault(&self, error: RuleError) -> RuleFault {
        RuleFault::new(self.source, error)
    }

    fn shown(&self, atom: &GroundAtom) -> String {
        let args: Vec<&str> = atom
            .args
            .iter()
            .map(|thing| self.resolved.things[thing.index()].name.as_str())
            .collect();
        format!("{}_({})", self.domain.predicates[atom.predicate.index()].name, args.join(", "))
    }
}

/// A fact as both languages have it: only a negation is worded.
fn told(fact: String) -> Bilingual {
    match fact.strip_prefix("НЕ ") {
        Some(fact) => said!("strips-denied", fact),
        None => fact.into(),
    }
}
