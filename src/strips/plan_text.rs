//! Plans as text, in the format that plan validators read, and a check of such a text against the rules.
//!
//! `0: (move ball1 rooma roomb)` – the number is the parallel step. A name with blanks stands in double quotes.
//! The check works on the rules themselves, not on a grounded task: it is a second opinion on grounding and on
//! the planner, and it judges plans of others, who may take steps that the planner would never think of.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fmt::Write;
use std::path::Path;

use miette::SourceSpan;

use super::domain::{Domain, Schema, SchemaAtom, SchemaTerm};
use super::error::{RuleError, RuleFault, RuleFaults};
use super::load::read_source;
use super::pddl::{Expression, expressions};
use super::problem::{GroundAtom, Problem, Resolved, ThingId};
use super::task::{OperatorId, Task};
use crate::units::{Source, name_key, nearest_name};

/// An action of a plan text and where it stands.
#[derive(Debug, Clone)]
pub struct Directive {
    pub step: u32,
    pub action: String,
    pub args: Vec<String>,
    at: SourceSpan,
}

/// A plan that was read.
#[derive(Debug, Clone)]
pub struct PlanText {
    source: Source,
    /// In the order of their steps.
    pub directives: Vec<Directive>,
}

impl PlanText {
    /// Writes parallel steps of operators.
    #[must_use]
    pub fn write(task: &Task, steps: &[Vec<OperatorId>]) -> String {
        let mut text = String::new();
        let mut cost = 0;
        for (step, operators) in steps.iter().enumerate() {
            for &id in operators {
                let operator = task.operator(id);
                cost += u64::from(operator.cost);
                let names = std::iter::once(&operator.name).chain(&operator.args);
                let words: Vec<String> = names.map(|name| quoted(name)).collect();
                writeln!(text, "{step}: ({})", words.join(" ")).expect("a string takes all text");
            }
        }
        writeln!(text, "; cost = {cost}").expect("a string takes all text");
        text
    }

    /// # Errors
    /// The file cannot be read or holds no plan.
    pub fn read(path: &Path) -> Result<Self, RuleFaults> {
        Self::parse(&read_source(path)?)
    }

    /// Reads `step: (action object …)`; without numbers each action is a step of its own.
    ///
    /// # Errors
    /// All places where the text is no plan.
    pub fn parse(source: &Source) -> Result<Self, RuleFaults> {
        let mut directives = Vec::new();
        let mut faults = Vec::new();
        let mut time = None;
        for expression in expressions(source)? {
            let at = expression.span();
            match &expression {
                Expression::Word(word, _) => match word.trim_end_matches(':').parse::<f64>() {
                    Ok(number) if (0.0..1e9).contains(&number) => {
                        time = Some(number.floor() as u32)
                    }
                    // `[1]`, the duration that some planners add.
                    _ if word.starts_with('[') => {}
                    _ => faults.push(syntax(source, "«шаг: (действие объект …)»", word, at)),
                },
                Expression::List(items, _) => {
                    let words: Option<Vec<String>> = items
                        .iter()
                        .map(|item| match item {
                            Expression::Word(word, _) => Some((*word).to_owned()),
                            Expression::List(..) => None,
                        })
                        .collect();
                    match words.as_deref() {
                        Some([action, args @ ..]) => directives.push(Directive {
                            step: time.take().unwrap_or(directives.len() as u32),
                            action: action.clone(),
                            args: args.to_vec(),
                            at,
                        }),
                        _ => faults.push(syntax(source, "«(действие объект …)»", "список", at)),
                    }
                }
            }
        }
        directives.sort_by_key(|directive| directive.step);
        if faults.is_empty() {
            Ok(Self { source: source.clone(), directives })
        } else {
            Err(RuleFaults(faults))
        }
    }

    /// Carries the plan out on the rules, step by step.
    ///
    /// # Errors
    /// Everything wrong in the first step that cannot be carried out, or the goals that do not hold at the end.
    pub fn check(&self, domain: &Domain, problem: &Problem) -> Result<(), RuleFaults> {
        let resolved = problem.resolve(domain)?;
        let mut state: HashSet<GroundAtom> =
            resolved.facts.iter().map(|(atom, _)| atom.clone()).collect();
        let mut steps: BTreeMap<u32, Vec<&Directive>> = BTreeMap::new();
        for directive in &self.directives {
            steps.entry(directive.step).or_default().push(directive);
        }
        let replay = Replay { domain, resolved: &resolved, source: &self.source };
        for directives in steps.values() {
            replay.step(directives, &mut state)?;
        }
        let unmet = resolved.goal.iter().filter(|(atom, negated)| state.contains(atom) == *negated);
        let faults: Vec<RuleFault> = unmet
            .map(|(atom, negated)| {
                let fact = format!("{}{}", if *negated { "НЕ " } else { "" }, replay.shown(atom));
                RuleFault::placeless(RuleError::PlanMissesGoal { fact })
            })
            .collect();
        if faults.is_empty() { Ok(()) } else { Err(RuleFaults(faults)) }
    }
}

fn quoted(name: &str) -> String {
    if name.contains([' ', '(', ')', ';']) { format!("\"{name}\"") } else { name.to_owned() }
}

fn syntax(source: &Source, expected: &str, found: &str, at: SourceSpan) -> RuleFault {
    let found = format!("«{}»", found.chars().take(40).collect::<String>());
    RuleFault::new(source, RuleError::Syntax { expected: expected.to_owned(), found, at })
}

struct Replay<'a> {
    domain: &'a Domain,
    resolved: &'a Resolved,
    source: &'a Source,
}

/// What a directive needs, adds and deletes.
struct Instance {
    needs: Vec<GroundAtom>,
    adds: Vec<GroundAtom>,
    dels: Vec<GroundAtom>,
}

impl Replay<'_> {
    fn step(
        &self,
        directives: &[&Directive],
        state: &mut HashSet<GroundAtom>,
    ) -> Result<(), RuleFaults> {
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
                    x.dels
                        .iter()
                        .find(|atom| y.needs.contains(atom) || y.adds.contains(atom))
                        .cloned()
                };
                if let Some(atom) = breaks(a, b).or_else(|| breaks(b, a)) {
                    faults.push(self.fault(RuleError::PlanInterference {
                        fact: self.shown(&atom),
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
        state.extend(instances.into_iter().flat_map(|(_, instance)| instance.adds));
        Ok(())
    }

    fn instance(
        &self,
        directive: &Directive,
        state: &HashSet<GroundAtom>,
    ) -> Result<Instance, RuleFaults> {
        let schema = self.schema(directive)?;
        let args = self.args(directive, schema)?;
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
        let faults: Vec<RuleFault> = missing
            .chain(present)
            .chain(unequal)
            .chain(equal)
            .map(|fact| self.fault(RuleError::PlanPrecondition { fact, at: directive.at }))
            .collect();
        if !faults.is_empty() {
            return Err(RuleFaults(faults));
        }
        let adds = ground(&schema.add_effects);
        let mut dels = ground(&schema.del_effects);
        dels.retain(|atom| !adds.contains(atom));
        Ok(Instance { needs, adds, dels })
    }

    fn schema(&self, directive: &Directive) -> Result<&Schema, RuleFaults> {
        let key = name_key(directive.action.trim_end_matches('_'));
        self.domain.schemas.iter().find(|schema| name_key(&schema.name) == key).ok_or_else(|| {
            let near = nearest_name(
                &directive.action,
                self.domain.schemas.iter().map(|s| s.name.as_str()),
            );
            let help = near.map(|near| format!("может быть, «{near}»?"));
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
            return Err(self
                .fault(RuleError::Arity {
                    name: schema.name.clone(),
                    expected: schema.parameters.len(),
                    found: directive.args.len(),
                    help: format!("запись: ({} {})", schema.name, schema.parameter_names.join(" ")),
                    at: directive.at,
                })
                .into());
        }
        let mut args = Vec::new();
        let mut faults = BTreeSet::new();
        for (name, kinds) in directive.args.iter().zip(&schema.parameters) {
            match self.resolved.index.get(&name_key(name)) {
                Some(&thing) => {
                    let have = &self.resolved.things[thing.index()].kinds;
                    if !kinds.is_empty() && !self.domain.fits(have, kinds) {
                        faults.insert((name.clone(), Some(self.domain.kind_names(kinds))));
                    }
                    args.push(thing);
                }
                None => {
                    faults.insert((name.clone(), None));
                }
            }
        }
        if faults.is_empty() {
            return Ok(args);
        }
        let told = |(name, wanted): (String, Option<String>)| {
            let help = wanted.map(|kind| format!("здесь должен стоять объект типа «{kind}»"));
            self.fault(RuleError::UnknownObject { name, help, at: directive.at })
        };
        Err(RuleFaults(faults.into_iter().map(told).collect()))
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
