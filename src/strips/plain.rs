//! Rules without conditions beyond literals, for explanations: a rule for each case of a disjunction, an object more for what
//! is there, a literal for each object of what holds for all, and a rule for each effect under a condition.
//!
//! **Invariant**: with delete effects forgotten, what is reachable by these rules is what is reachable by those given.

use super::cases::Objects;
use super::domain::{
    Domain, Formula, KindSet, Predicate, PredicateId, Schema, SchemaAtom, SchemaTerm,
};
use super::draft::GOAL_STEP;
use super::resolve::{GroundAtom, Resolved, ThingId};

/// Into more cases, or longer ones, nobody reads an explanation.
const MOST_CASES: usize = 256;
const MOST_LITERALS: usize = 600;

/// The rules in plain terms, and, where the goal is met in several ways, one that says that it is met; none where that
/// would be too long to read, or rests on the absence of what is derived.
pub(super) fn plain(domain: &Domain, resolved: &Resolved) -> Option<Domain> {
    let objects = Objects::new(domain, resolved);
    let mut all: Vec<Schema> = Vec::new();
    for schema in domain.rules() {
        all.extend(Divider::of(&objects, resolved, schema)?);
    }
    let mut plain = Domain { schemas: Vec::new(), derived: Vec::new(), ..domain.clone() };
    if !resolved.goal_formulas.is_empty() {
        let met = PredicateId(plain.predicates.len() as u32);
        plain.predicates.push(Predicate { name: GOAL_STEP.to_owned(), args: Vec::new() });
        plain.predicate_index.insert(crate::units::name_key(GOAL_STEP), met);
        let mut goal = Schema::new(GOAL_STEP);
        goal.formulas.clone_from(&resolved.goal_formulas);
        goal.add_effects.push(SchemaAtom { predicate: met, args: Vec::new() });
        for (atom, negated) in &resolved.goal {
            let list =
                if *negated { &mut goal.negative_preconditions } else { &mut goal.preconditions };
            list.push(named(resolved, atom));
        }
        all.extend(Divider::of(&objects, resolved, &goal)?);
    }
    let absent = all.iter().flat_map(|schema| &schema.negative_preconditions);
    if absent.into_iter().any(|atom| domain.is_derived(atom.predicate)) {
        return None;
    }
    plain.schemas = all;
    Some(plain)
}

/// An atom over objects as one of a rule.
fn named(resolved: &Resolved, atom: &GroundAtom) -> SchemaAtom {
    let args = atom.args.iter().map(|thing| constant(resolved, *thing)).collect();
    SchemaAtom { predicate: atom.predicate, args }
}

fn constant(resolved: &Resolved, thing: ThingId) -> SchemaTerm {
    SchemaTerm::Constant(resolved.things[thing.index()].name.clone())
}

/// What stands for each variable of a formula.
type Values = Vec<SchemaTerm>;

struct Divider<'a> {
    objects: &'a Objects<'a>,
    resolved: &'a Resolved,
    found: Vec<Schema>,
}

impl<'a> Divider<'a> {
    fn of(
        objects: &'a Objects<'a>,
        resolved: &'a Resolved,
        schema: &Schema,
    ) -> Option<Vec<Schema>> {
        let mut divider = Self { objects, resolved, found: Vec::new() };
        let base = Schema { formulas: Vec::new(), conditional: Vec::new(), ..schema.clone() };
        let values: Values =
            (0..schema.parameters.len() as u32).map(SchemaTerm::Parameter).collect();
        let own = |values: &Values| -> Vec<(&Formula, Values)> {
            schema.formulas.iter().map(|formula| (formula, values.clone())).collect()
        };
        divider.divide(base.clone(), own(&values))?;
        for effect in &schema.conditional {
            let (mut under, mut inner) = (base.clone(), values.clone());
            open(&mut under, &mut inner, &effect.variables);
            let put = |atoms: &[SchemaAtom]| -> Vec<SchemaAtom> {
                atoms.iter().map(|atom| filled(atom, &inner)).collect()
            };
            under.add_effects.extend(put(&effect.add_effects));
            under.del_effects.extend(put(&effect.del_effects));
            let mut todo = own(&values);
            todo.extend(effect.condition.iter().map(|formula| (formula, inner.clone())));
            divider.divide(under, todo)?;
        }
        Some(divider.found)
    }

    /// The rule with each of the formulas in turn among its literals, a rule for each case.
    fn divide(&mut self, mut rule: Schema, mut todo: Vec<(&Formula, Values)>) -> Option<()> {
        let Some((formula, mut values)) = todo.pop() else {
            self.found.push(rule);
            return (self.found.len() <= MOST_CASES).then_some(());
        };
        match formula {
            Formula::Literal { atom, negated } => {
                let list = match negated {
                    true => &mut rule.negative_preconditions,
                    false => &mut rule.preconditions,
                };
                list.push(filled(atom, &values));
                if list.len() > MOST_LITERALS {
                    return None;
                }
            }
            Formula::Equal { pair: (left, right), negated } => {
                let list = if *negated { &mut rule.different } else { &mut rule.equal };
                list.push((value(left, &values), value(right, &values)));
            }
            Formula::Any(cases) => {
                for case in cases {
                    let mut todo = todo.clone();
                    todo.extend(case.iter().map(|formula| (formula, values.clone())));
                    self.divide(rule.clone(), todo)?;
                }
                return Some(());
            }
            Formula::Quantified { every: false, variables, body } => {
                open(&mut rule, &mut values, variables);
                todo.extend(body.iter().map(|formula| (formula, values.clone())));
            }
            Formula::Quantified { every: true, variables, body } => {
                let (mut room, mut chosen) = (MOST_LITERALS, Vec::new());
                self.objects.each_choice(variables, &mut Vec::new(), &mut |things| {
                    chosen.push(things.clone());
                    room -= 1;
                    room == 0
                });
                if room == 0 {
                    return None;
                }
                for things in chosen {
                    let mut values = values.clone();
                    values.extend(things.iter().map(|thing| constant(self.resolved, *thing)));
                    todo.extend(body.iter().map(|formula| (formula, values.clone())));
                }
            }
        }
        self.divide(rule, todo)
    }
}

/// Makes the variables of a quantifier parameters of the rule, which no name shows.
fn open(rule: &mut Schema, values: &mut Values, variables: &[KindSet]) {
    for kinds in variables {
        values.push(SchemaTerm::Parameter(rule.parameters.len() as u32));
        rule.parameters.push(kinds.clone());
        rule.parameter_names.push(String::new());
    }
}

fn value(term: &SchemaTerm, values: &Values) -> SchemaTerm {
    match term {
        SchemaTerm::Constant(_) => term.clone(),
        SchemaTerm::Parameter(number) => values[*number as usize].clone(),
    }
}

fn filled(atom: &SchemaAtom, values: &Values) -> SchemaAtom {
    let args = atom.args.iter().map(|term| value(term, values)).collect();
    SchemaAtom { predicate: atom.predicate, args }
}
