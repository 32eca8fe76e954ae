//! The ground actions of all that is reachable, case by case, and the goal.

use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

use super::cases::{Body, Case, Cases, Known, MOST_CASES, TooMany, together};
use super::domain::{ConditionalEffect, Domain, PredicateId, SchemaAtom};
use super::error::RuleError;
use super::fault::{RuleFault, RuleFaults};
use super::price::cost;
use super::problem::Standing;
use super::reachability::{Instance, Reachability};
use super::resolve::{GroundAtom, Resolved, ThingId};

pub(super) struct DraftOperator {
    pub(super) name: Arc<str>,
    pub(super) args: Vec<Arc<str>>,
    pub(super) preconditions: Vec<u32>,
    pub(super) negative: Vec<u32>,
    pub(super) add_effects: Vec<u32>,
    pub(super) del_effects: Vec<u32>,
    /// What is deleted and then added: among `add_effects`, and not among `del_effects` once complements are made.
    pub(super) renewed: Vec<u32>,
    pub(super) cost: u32,
    /// No action: see [`Task::goal_steps`]. Such operators stand last.
    pub(super) meets_goal: bool,
}

/// A task before simplification; facts are numbered by their place in `facts`.
pub(super) struct Draft {
    pub(super) facts: Vec<(Arc<str>, Vec<Arc<str>>)>,
    pub(super) operators: Vec<DraftOperator>,
    pub(super) init: Vec<u32>,
    pub(super) assumptions: Vec<u32>,
    pub(super) goal: Vec<(u32, bool)>,
    /// The goal holds in no state at all.
    pub(super) impossible: bool,
}

/// The reached atoms and actions, numbered, still with all that simplification will drop; none when it was stopped.
pub(super) fn draft(
    domain: &Domain,
    resolved: &Resolved,
    reached: &Reachability<'_>,
    goes_on: &dyn Fn() -> bool,
) -> Result<Option<Draft>, RuleFaults> {
    let mut atoms = reached.atoms.clone();
    for (atom, _) in &resolved.goal {
        if !reached.numbers.contains_key(atom) && !atoms.contains(atom) {
            atoms.push(atom.clone());
        }
    }
    atoms.sort_unstable();
    let numbers: HashMap<&GroundAtom, u32> =
        atoms.iter().enumerate().map(|(number, atom)| (atom, number as u32)).collect();
    let mut instances: Vec<&Instance> = reached.instances.iter().collect();
    instances.sort_unstable_by(|a, b| (a.schema, &a.args).cmp(&(b.schema, &b.args)));
    let mut bodies: HashMap<GroundAtom, Vec<Body>> = HashMap::new();
    for instance in instances.iter().filter(|i| i.schema >= domain.schemas.len()) {
        let head =
            reached.instantiate(&domain.rule(instance.schema).add_effects[0], &instance.args);
        let body = Body { rule: instance.schema, args: instance.args.clone() };
        bodies.entry(head).or_default().push(body);
    }
    let bodies: HashMap<GroundAtom, Rc<[Body]>> =
        bodies.into_iter().map(|(atom, bodies)| (atom, bodies.into())).collect();
    let is_derived: Vec<bool> =
        (0..domain.predicates.len() as u32).map(|p| domain.is_derived(PredicateId(p))).collect();
    let known = |atom: &GroundAtom| {
        if is_derived[atom.predicate.index()] {
            return bodies.get(atom).map_or(Known::Never, |bodies| Known::Derived(bodies.clone()));
        }
        match reached.numbers.contains_key(atom) {
            false => Known::Never,
            true if !reached.changing[atom.predicate.index()] => Known::Always,
            true => Known::Changes(numbers[atom]),
        }
    };
    let names: Vec<Arc<str>> =
        resolved.things.iter().map(|thing| thing.name.as_str().into()).collect();
    let schema_names: Vec<Arc<str>> =
        domain.schemas.iter().map(|schema| schema.name.as_str().into()).collect();
    let drafter =
        Drafter { domain, reached, numbers: &numbers, is_derived: &is_derived, known: &known };
    let mut operators = Vec::new();
    let actions = instances.into_iter().filter(|i| i.schema < domain.schemas.len());
    for (count, instance) in actions.enumerate() {
        if count.is_multiple_of(256) && !goes_on() {
            return Ok(None);
        }
        let schema = &domain.schemas[instance.schema];
        let drafted = drafter.of_instance(instance).map_err(|TooMany| {
            let of = schema.name.clone();
            RuleFault::placeless(RuleError::TooManyCases { of, limit: MOST_CASES })
        })?;
        let args: Vec<Arc<str>> =
            instance.args.iter().map(|thing| names[thing.index()].clone()).collect();
        let cost = cost(schema, resolved, &instance.args);
        operators.extend(drafted.into_iter().map(|effects| DraftOperator {
            name: schema_names[instance.schema].clone(),
            args: args.clone(),
            cost,
            ..effects
        }));
    }
    let predicate_names: Vec<Arc<str>> =
        domain.predicates.iter().map(|predicate| predicate.name.as_str().into()).collect();
    let shown = |predicate: PredicateId| predicate_names[predicate.index()].clone();
    let mut draft = Draft {
        init: resolved.facts.iter().map(|(atom, _)| numbers[atom]).collect(),
        assumptions: resolved
            .facts
            .iter()
            .filter(|(_, standing)| *standing == Standing::Assumption)
            .map(|(atom, _)| numbers[atom])
            .collect(),
        goal: Vec::new(),
        impossible: resolved.impossible,
        operators,
        facts: atoms
            .iter()
            .map(|atom| {
                let args = atom.args.iter().map(|thing| names[thing.index()].clone()).collect();
                (shown(atom.predicate), args)
            })
            .collect(),
    };
    let goals = drafter.goals(resolved).map_err(|TooMany| {
        let of = "goal".to_owned();
        RuleFault::placeless(RuleError::TooManyCases { of, limit: MOST_CASES })
    })?;
    state_goal(&mut draft, goals);
    Ok(Some(draft))
}

/// The fact, and the operators that give it, by which a goal of several ways is met ([`super::Task::goal_steps`]).
pub const GOAL_STEP: &str = "GOAL";

/// The goal as one conjunction. Where any of several would do, an action for each meets the one fact that is the goal then.
fn state_goal(draft: &mut Draft, mut goals: Vec<Case>) {
    match goals.len() {
        0 => draft.impossible = true,
        1 => draft.goal = goals.swap_remove(0),
        _ => {
            let met = draft.facts.len() as u32;
            draft.facts.push((GOAL_STEP.into(), Vec::new()));
            draft.goal = vec![(met, false)];
            for case in goals {
                draft.operators.push(DraftOperator {
                    name: GOAL_STEP.into(),
                    args: Vec::new(),
                    preconditions: atoms_of(&case, false),
                    negative: atoms_of(&case, true),
                    add_effects: vec![met],
                    del_effects: Vec::new(),
                    renewed: Vec::new(),
                    cost: 0,
                    meets_goal: true,
                });
            }
        }
    }
}

/// The atoms that are there in a case, or those that are absent.
fn atoms_of(case: &Case, absent: bool) -> Vec<u32> {
    case.iter().filter(|(_, negated)| *negated == absent).map(|&(atom, _)| atom).collect()
}

/// Makes ground actions of instances.
struct Drafter<'a> {
    domain: &'a Domain,
    reached: &'a Reachability<'a>,
    numbers: &'a HashMap<&'a GroundAtom, u32>,
    is_derived: &'a [bool],
    known: &'a dyn Fn(&GroundAtom) -> Known,
}

/// A case of an action: when it is, and what it then adds and deletes.
struct Variant {
    case: Case,
    adds: Vec<u32>,
    dels: Vec<u32>,
}

impl Drafter<'_> {
    fn atoms(&self, atoms: &[SchemaAtom], args: &[ThingId]) -> Vec<u32> {
        let number = |atom| self.numbers.get(&self.reached.objects.ground(atom, args)).copied();
        atoms.iter().filter_map(number).collect()
    }

    /// Its cases; name, objects and cost are left to be told.
    fn of_instance(&self, instance: &Instance) -> Result<Vec<DraftOperator>, TooMany> {
        let (schema, args) = (self.domain.rule(instance.schema), &instance.args);
        let derives =
            |atoms: &[SchemaAtom]| atoms.iter().any(|a| self.is_derived[a.predicate.index()]);
        let is_plain = !schema.is_beyond_literals()
            && !derives(&schema.preconditions)
            && !derives(&schema.negative_preconditions);
        let nameless = |preconditions, negative| DraftOperator {
            name: "".into(),
            args: Vec::new(),
            preconditions,
            negative,
            add_effects: self.atoms(&schema.add_effects, args),
            del_effects: self.atoms(&schema.del_effects, args),
            renewed: self.atoms(&schema.renewed, args),
            cost: 0,
            meets_goal: false,
        };
        if is_plain {
            let needs = self.atoms(&schema.preconditions, args);
            return Ok(vec![nameless(needs, self.atoms(&schema.negative_preconditions, args))]);
        }
        let cases = Cases::new(&self.reached.objects, self.domain, self.known);
        let whole = cases.of_rule(instance.schema, args, false)?;
        let variant = |case| Variant { case, adds: Vec::new(), dels: Vec::new() };
        let mut variants: Vec<Variant> = whole.into_iter().map(variant).collect();
        for effect in &schema.conditional {
            let mut choices = Vec::new();
            self.reached.objects.each_choice(
                &effect.variables,
                &mut args.clone(),
                &mut |binding| {
                    choices.push(binding.clone());
                    false
                },
            );
            for mut choice in choices {
                variants = self.divided(&cases, effect, &mut choice, variants)?;
            }
        }
        let operators = variants.into_iter().map(|Variant { case, adds, dels }| {
            let mut operator = nameless(atoms_of(&case, false), atoms_of(&case, true));
            operator.add_effects.extend(adds);
            operator.del_effects.extend(dels);
            operator
        });
        Ok(operators.collect())
    }

    /// Each variant where an effect's condition holds, with the effect, and where it does not, without.
    fn divided(
        &self,
        cases: &Cases<'_>,
        effect: &ConditionalEffect,
        choice: &mut Vec<ThingId>,
        variants: Vec<Variant>,
    ) -> Result<Vec<Variant>, TooMany> {
        let adds = self.atoms(&effect.add_effects, choice);
        let dels = self.atoms(&effect.del_effects, choice);
        if adds.is_empty() && dels.is_empty() {
            return Ok(variants);
        }
        let holds = cases.of_all(&effect.condition, choice, false)?;
        let fails = cases.of_all(&effect.condition, choice, true)?;
        let mut divided = Vec::new();
        for variant in variants {
            for (conditions, comes) in [(&holds, true), (&fails, false)] {
                let here = conditions.iter().filter_map(|case| together(&variant.case, case));
                // Where the variant says already that it is so, nothing is to be divided.
                for case in cases.without_special(here.collect())? {
                    let mut one =
                        Variant { case, adds: variant.adds.clone(), dels: variant.dels.clone() };
                    if comes {
                        one.adds.extend(&adds);
                        one.dels.extend(&dels);
                    }
                    divided.push(one);
                    if divided.len() > MOST_CASES {
                        return Err(TooMany);
                    }
                }
            }
        }
        Ok(divided)
    }

    /// What is wanted, by cases.
    fn goals(&self, resolved: &Resolved) -> Result<Vec<Case>, TooMany> {
        let is_plain = resolved.goal_formulas.is_empty()
            && !resolved.goal.iter().any(|(atom, _)| self.is_derived[atom.predicate.index()]);
        if is_plain {
            let goal = resolved.goal.iter().map(|(atom, negated)| (self.numbers[atom], *negated));
            return Ok(vec![goal.collect()]);
        }
        let cases = Cases::new(&self.reached.objects, self.domain, self.known);
        let mut all = cases.of_all(&resolved.goal_formulas, &mut Vec::new(), false)?;
        for (atom, negated) in &resolved.goal {
            // What nothing reaches is told as such, by its name.
            let literal = match (self.known)(atom) {
                Known::Derived(_) => cases.literal(atom, *negated)?,
                _ => vec![vec![(self.numbers[atom], *negated)]],
            };
            all = cases.both(&all, &literal)?;
        }
        Ok(all)
    }
}
