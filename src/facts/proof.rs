//! Why a tuple holds: a proof of the least height, found when asked for.
//!
//! Evaluation records nothing for this. A question collects, backwards from its tuple, every rule instance
//! that could take part in a proof, and then gives heights forwards: told facts have height 0, a rule
//! instance one more than its highest premise (Knuth's generalisation of Dijkstra's algorithm). The first
//! instance that reaches a tuple is the lowest.

use std::collections::{HashMap, VecDeque};
use std::fmt;

use super::database::{FactError, RelationKey};
use super::demand::Demand;
use super::derived::{Derived, values};
use super::growing::Version;
use super::kept::{Kept, View};
use super::plan::{Plan, Task, plan};
use super::program::{Atom, Clause, Expr, Literal, Program, Term, VariableId};
use super::relations::RelationId;
use super::rows::Stored;
use super::syntax::{Comparison, Span};
use super::turned::turned;
use super::value;
use super::word::{NO_WORD, Value, Word, Words};
use crate::units::{Language, Piece, word};

/// A tuple of a relation, as values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FactText {
    pub relation: RelationId,
    /// The relation's name.
    pub name: String,
    pub values: Vec<Value>,
}

/// A proof, flat: the first step proves what was asked, premises are later steps. Shared premises stand once.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    pub steps: Vec<ProofStep>,
}

/// A tuple and why it holds.
#[derive(Debug, Clone, PartialEq)]
pub struct ProofStep {
    pub fact: FactText,
    /// 0 for what was told; for a rule one more than its highest premise.
    pub height: u32,
    pub because: Because,
}

#[derive(Debug, Clone, PartialEq)]
pub enum Because {
    /// The database says so.
    Told,
    /// The rule text says so, in this line of this source.
    Written {
        source: String,
        line: usize,
    },
    Rule {
        rule: RuleInstance,
        premises: Vec<Premise>,
    },
}

/// A rule with values for its variables.
#[derive(Debug, Clone, PartialEq)]
pub struct RuleInstance {
    /// Name of the rule's text.
    pub source: String,
    /// Line of its head, from 1.
    pub line: usize,
    pub text: String,
    /// Named variables that have a value, in the order of the rule.
    pub bindings: Vec<(String, Value)>,
}

/// A premise of a rule instance.
#[derive(Debug, Clone, PartialEq)]
pub enum Premise {
    /// A tuple that is proved by the step of this number.
    Fact(usize),
    /// A tuple; in a failed instance, `None` where its value is open.
    Pattern {
        name: String,
        values: Vec<Option<Value>>,
    },
    /// No such tuple is there; `None` where any value would do.
    Absent {
        name: String,
        values: Vec<Option<Value>>,
    },
    Compared {
        text: String,
        left: Value,
        op: Comparison,
        right: Value,
    },
    /// An aggregate and its value.
    Counted {
        text: String,
        value: Option<Value>,
    },
    /// A premise that could not be judged, as it stands in the rule.
    Unknown {
        text: String,
    },
}

/// Answers why and why not about one result; keeps what it builds for the next question.
pub struct Explainer {
    pub(super) program: Program,
    pub(super) finished: Kept,
    given: Vec<Option<Box<dyn Stored>>>,
    /// By clause, once asked for.
    pub(super) asked: HashMap<usize, Asked>,
}

impl fmt::Debug for Explainer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Explainer")
            .field("clauses_asked", &self.asked.len())
            .finish_non_exhaustive()
    }
}

/// A clause turned to run backwards: its head's variables are known.
pub(super) struct Asked {
    pub(super) clause: Clause,
    /// For each column of the head, the variable that takes its word.
    pub(super) head: Vec<VariableId>,
    plan: Plan,
    /// Literals of the original body; those behind compare the head with its tuple.
    pub(super) own: usize,
}

/// A tuple in the cone of a question.
struct Node {
    relation: RelationId,
    row: Box<[Word]>,
    height: Option<u32>,
    /// The instance that gave the height.
    by: Option<usize>,
    /// Instances that wait for this tuple.
    waiting: Vec<usize>,
}

struct Instance {
    clause: usize,
    proves: usize,
    registers: Box<[Word]>,
    premises: Vec<usize>,
    /// Premises without a height; one that occurs twice counts twice.
    missing: usize,
}

#[derive(Default)]
struct Cone {
    nodes: Vec<Node>,
    numbers: HashMap<(RelationId, Box<[Word]>), usize>,
    instances: Vec<Instance>,
}

impl Derived {
    /// What answers questions about this result.
    #[must_use]
    pub fn explain(&self) -> Explainer {
        Explainer {
            program: self.program.clone(),
            finished: self.kept.clone(),
            given: self.given.clone(),
            asked: HashMap::new(),
        }
    }

    /// A proof of least height; none when the tuple does not hold.
    ///
    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn why(
        &self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<Option<Proof>, FactError> {
        self.explain().why(relation, tuple)
    }
}

impl Explainer {
    /// A proof of least height; none when the tuple does not hold.
    ///
    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn why(
        &mut self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<Option<Proof>, FactError> {
        let (relation, row) = self.encode(relation, tuple)?;
        Ok(self.prove(relation, row.into()))
    }

    pub(super) fn over(program: &Program, kept: Kept, given: Vec<Option<Box<dyn Stored>>>) -> Self {
        Self { program: program.clone(), finished: kept, given, asked: HashMap::new() }
    }

    /// A proof of what was found on demand.
    pub(super) fn prove_on(
        &mut self,
        demand: &Demand<'_>,
        relation: RelationId,
        row: Box<[Word]>,
    ) -> Proof {
        let mut cone = self.cone(relation, row, Some(demand));
        cone.give_heights();
        self.proof(&cone)
    }

    pub(super) fn prove(&mut self, relation: RelationId, row: Box<[Word]>) -> Option<Proof> {
        if !self.holds(relation, &row) {
            return None;
        }
        let mut cone = self.cone(relation, row, None);
        cone.give_heights();
        Some(self.proof(&cone))
    }

    pub(super) fn encode(
        &mut self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<(RelationId, Vec<Word>), FactError> {
        let schema = super::Schema::of(&self.program);
        let relation = relation.find(&schema)?;
        let words = &mut self.finished.words;
        let row = schema
            .encode(relation, tuple, |value, kind| words.of(value, kind).unwrap_or(NO_WORD))?;
        Ok((relation, row))
    }

    pub(super) fn holds(&self, relation: RelationId, row: &[Word]) -> bool {
        self.finished.holds(relation, row, View::After)
    }

    /// Every tuple and rule instance that could take part in a proof.
    fn cone(
        &mut self,
        relation: RelationId,
        row: Box<[Word]>,
        demand: Option<&Demand<'_>>,
    ) -> Cone {
        let mut cone = Cone::default();
        cone.node(relation, row);
        let mut next = 0;
        while next < cone.nodes.len() {
            let (relation, row) = (cone.nodes[next].relation, cone.nodes[next].row.clone());
            let is_told = match &self.given[relation.index()] {
                Some(given) => given.find(&row).is_some(),
                None if relation.index() < self.finished.len() => {
                    self.finished.rows(relation).find(&row).is_some()
                }
                // What is computed is told by who computes it.
                None => demand.is_some_and(|demand| demand.is_ground(relation)),
            };
            if is_told {
                cone.nodes[next].height = Some(0);
            } else {
                for clause in 0..self.program.clauses.len() {
                    if self.program.clauses[clause].head == relation {
                        self.instances(clause, next, &row, &mut cone, demand);
                    }
                }
            }
            next += 1;
        }
        cone
    }

    /// Adds the instances of a clause that prove the tuple.
    fn instances(
        &mut self,
        clause: usize,
        proves: usize,
        row: &[Word],
        cone: &mut Cone,
        demand: Option<&Demand<'_>>,
    ) {
        self.prepare(clause, demand);
        let asked = &self.asked[&clause];
        let mut registers = vec![NO_WORD; asked.clause.variables.len()];
        for (v, word) in asked.head.iter().zip(row) {
            registers[*v as usize] = *word;
        }
        let mut found: Vec<Box<[Word]>> = Vec::new();
        let mut keep = |registers: &[Word], _: &mut Words| {
            found.push(registers.into());
            true
        };
        match demand {
            Some(demand) => {
                demand.run(&asked.plan, &mut registers, &mut self.finished.words, &mut keep);
            }
            None => {
                self.finished.run(&asked.plan, View::After, &[], &mut registers, &mut keep);
            }
        }
        for registers in found {
            let premises: Vec<usize> = asked.clause.body[..asked.own]
                .iter()
                .filter_map(|literal| match literal {
                    Literal::Atom(atom) => Some(cone.node(atom.relation, row_of(atom, &registers))),
                    _ => None,
                })
                .collect();
            let number = cone.instances.len();
            premises.iter().for_each(|premise| cone.nodes[*premise].waiting.push(number));
            let missing = premises.len();
            cone.instances.push(Instance { clause, proves, registers, premises, missing });
        }
    }

    /// Prepares a clause to be run backwards.
    pub(super) fn ask(&mut self, clause: usize) -> &Asked {
        self.prepare(clause, None);
        &self.asked[&clause]
    }

    fn prepare(&mut self, clause: usize, demand: Option<&Demand<'_>>) {
        if !self.asked.contains_key(&clause) {
            let columns = &self.program.info(self.program.clauses[clause].head).columns;
            let (clause_turned, head, own) = turned(&self.program.clauses[clause], columns);
            let versions = vec![Version::Finished; clause_turned.body.len()];
            let wanted: Vec<VariableId> =
                (0..clause_turned.variables.len() as VariableId).collect();
            let task = Task {
                clause: &clause_turned,
                versions: &versions,
                first: None,
                bound: &head,
                wanted: &wanted,
            };
            let plan = match demand {
                Some(demand) => plan(&task, demand),
                None => plan(&task, &self.finished),
            };
            if demand.is_none() {
                self.finished.provide(&plan);
            }
            self.asked.insert(clause, Asked { clause: clause_turned, head, plan, own });
        }
    }

    pub(super) fn asked(&self, clause: usize) -> &Asked {
        &self.asked[&clause]
    }

    /// The proof of the cone's first node.
    fn proof(&mut self, cone: &Cone) -> Proof {
        let mut number_of = HashMap::from([(0, 0)]);
        let mut order = vec![0];
        let mut steps = Vec::new();
        while steps.len() < order.len() {
            let node = &cone.nodes[order[steps.len()]];
            let because = match node.by {
                None => self.told(node),
                Some(instance) => {
                    let instance = &cone.instances[instance];
                    for premise in &instance.premises {
                        number_of.entry(*premise).or_insert_with(|| {
                            order.push(*premise);
                            order.len() - 1
                        });
                    }
                    let mut facts = instance.premises.iter().map(|premise| number_of[premise]);
                    let asked = &self.asked[&instance.clause];
                    let premises =
                        asked.clause.body[..asked.own].iter().filter_map(|literal| match literal {
                            Literal::Atom(_) => facts.next().map(Premise::Fact),
                            other => {
                                let words = &mut self.finished.words;
                                premise(
                                    &self.program,
                                    &asked.clause,
                                    other,
                                    &instance.registers,
                                    words,
                                )
                            }
                        });
                    let premises = premises.collect();
                    let words = &self.finished.words;
                    let rule =
                        rule_instance(&self.program, &asked.clause, &instance.registers, words);
                    Because::Rule { rule, premises }
                }
            };
            let fact = fact_text(&self.program, &self.finished.words, node.relation, &node.row);
            steps.push(ProofStep { fact, height: node.height.unwrap_or(0), because });
        }
        Proof { steps }
    }
}

impl Explainer {
    fn told(&self, node: &Node) -> Because {
        let mut facts = self.program.facts.iter();
        match facts.find(|fact| fact.relation == node.relation && fact.words == node.row) {
            Some(fact) => {
                let (source, line, _) = self.program.excerpt(fact.at);
                Because::Written { source: source.name().to_owned(), line }
            }
            None => Because::Told,
        }
    }
}

impl Cone {
    fn node(&mut self, relation: RelationId, row: Box<[Word]>) -> usize {
        let nodes = &mut self.nodes;
        *self.numbers.entry((relation, row.clone())).or_insert_with(|| {
            nodes.push(Node { relation, row, height: None, by: None, waiting: Vec::new() });
            nodes.len() - 1
        })
    }

    fn give_heights(&mut self) {
        let mut queue: VecDeque<usize> =
            (0..self.nodes.len()).filter(|n| self.nodes[*n].height.is_some()).collect();
        // Nodes leave the queue in the order of their heights: an instance is as high as its last premise.
        let (nodes, instances) = (&mut self.nodes, &mut self.instances);
        let reach = |number: usize,
                     height: u32,
                     queue: &mut VecDeque<usize>,
                     nodes: &mut Vec<Node>,
                     proves: usize| {
            if nodes[proves].height.is_none() {
                nodes[proves].height = Some(height);
                nodes[proves].by = Some(number);
                queue.push_back(proves);
            }
        };
        for (number, instance) in instances.iter().enumerate() {
            if instance.missing == 0 {
                reach(number, 1, &mut queue, nodes, instance.proves);
            }
        }
        while let Some(node) = queue.pop_front() {
            let height = nodes[node].height.unwrap_or(0) + 1;
            for number in std::mem::take(&mut nodes[node].waiting) {
                let instance = &mut instances[number];
                instance.missing -= 1;
                if instance.missing == 0 {
                    reach(number, height, &mut queue, nodes, instance.proves);
                }
            }
        }
    }
}

pub(super) fn row_of(atom: &Atom, registers: &[Word]) -> Box<[Word]> {
    let word = |term: &Term| match term {
        Term::Variable(v) => registers[*v as usize],
        Term::Constant(word) => *word,
        Term::Any => NO_WORD,
    };
    atom.args.iter().map(word).collect()
}

pub(super) fn fact_text(
    program: &Program,
    words: &Words,
    relation: RelationId,
    row: &[Word],
) -> FactText {
    let info = program.info(relation);
    FactText { relation, name: info.name.clone(), values: values(words, info, row) }
}

pub(super) fn rule_instance(
    program: &Program,
    clause: &Clause,
    registers: &[Word],
    words: &Words,
) -> RuleInstance {
    let (source, line, text) = program.excerpt(clause.at);
    let mut local = Vec::new();
    for literal in &clause.body {
        if let Literal::Aggregate(aggregate) = literal {
            super::program::used_variables(&aggregate.body, aggregate.value.as_ref(), &mut |v| {
                if !aggregate.shared.contains(&v) {
                    local.push(v);
                }
            });
        }
    }
    let bindings =
        clause.variables.iter().enumerate().zip(registers).filter_map(|((n, variable), word)| {
            let is_shown = !variable.name.is_empty()
                && *word != NO_WORD
                && !local.contains(&(n as VariableId));
            is_shown.then(|| (variable.name.clone(), words.value(*word, variable.kind)))
        });
    RuleInstance {
        source: source.name().to_owned(),
        line,
        text: text.to_owned(),
        bindings: bindings.collect(),
    }
}

/// A premise as it stands with the registers' values; none for one that only names an expression.
pub(super) fn premise(
    program: &Program,
    clause: &Clause,
    literal: &Literal,
    registers: &[Word],
    words: &mut Words,
) -> Option<Premise> {
    let excerpt = |at: Span| program.excerpt(at).2.to_owned();
    Some(match literal {
        Literal::Atom(atom) => {
            let (name, values) = pattern(program, atom, registers, words);
            Premise::Pattern { name, values }
        }
        Literal::Not(atom) => {
            let (name, values) = pattern(program, atom, registers, words);
            Premise::Absent { name, values }
        }
        Literal::Compare(compare) => {
            if matches!(compare.left, Expr::Variable(v) if clause.variables[v as usize].name.is_empty())
            {
                return None;
            }
            let register = |v: VariableId| registers[v as usize];
            let known = |expr: &Expr| expr.all_variables(|v| register(v) != NO_WORD);
            let text = excerpt(compare.at);
            let sides = (known(&compare.left) && known(&compare.right)).then(|| {
                let left = value::compute(&compare.left, &register, words)?;
                Some((left, value::compute(&compare.right, &register, words)?))
            });
            match sides.flatten() {
                Some((left, right)) => Premise::Compared {
                    text,
                    left: words.value(left, compare.kind),
                    op: compare.op,
                    right: words.value(right, compare.kind),
                },
                None => Premise::Unknown { text },
            }
        }
        Literal::Range(range) => {
            let word = registers[range.target as usize];
            let value = (word != NO_WORD).then(|| words.value(word, range.kind));
            Premise::Counted { text: excerpt(range.at), value }
        }
        Literal::Aggregate(aggregate) => {
            let word = registers[aggregate.target as usize];
            let value = (word != NO_WORD).then(|| words.value(word, aggregate.kind));
            Premise::Counted { text: excerpt(aggregate.at), value }
        }
    })
}

fn pattern(
    program: &Program,
    atom: &Atom,
    registers: &[Word],
    words: &Words,
) -> (String, Vec<Option<Value>>) {
    let info = program.info(atom.relation);
    let row = row_of(atom, registers);
    let value = |(word, column): (&Word, &super::Column)| {
        (*word != NO_WORD).then(|| words.value(*word, column.kind))
    };
    (info.name.clone(), row.iter().zip(&info.columns).map(value).collect())
}

impl fmt::Display for FactText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let values: Vec<String> = self.values.iter().map(shown).collect();
        write!(f, "{}({})", self.name, values.join(", "))
    }
}

/// A value as the rule text would write it.
fn shown(value: &Value) -> String {
    match value {
        Value::Symbol(text) => format!("\"{text}\""),
        number => number.to_string(),
    }
}

fn shown_pattern(name: &str, values: &[Option<Value>]) -> String {
    let values: Vec<String> =
        values.iter().map(|value| value.as_ref().map_or("_".into(), shown)).collect();
    format!("{name}({})", values.join(", "))
}

impl fmt::Display for Premise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fact(step) => write!(f, "[{step}]"),
            Self::Pattern { name, values } => write!(f, "{}", shown_pattern(name, values)),
            Self::Absent { name, values } => write!(f, "!{}", shown_pattern(name, values)),
            Self::Compared { text, left, op, right } => {
                write!(f, "{text}: {} {} {}", shown(left), op.sign(), shown(right))
            }
            Self::Counted { text, value: Some(value) } => write!(f, "{text} = {}", shown(value)),
            Self::Counted { text, value: None } | Self::Unknown { text } => write!(f, "{text}"),
        }
    }
}

/// Behind a premise that was shown before.
pub const SEE_ABOVE: Piece = word!("see-above");

/// As an indented tree, in Russian. A premise that was shown before is named, not shown again.
impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut was_shown = vec![false; self.steps.len()];
        let mut open: Vec<(usize, Premise)> = vec![(0, Premise::Fact(0))];
        while let Some((depth, premise)) = open.pop() {
            // Deep proofs are not pushed off the page.
            let indent = "  ".repeat(depth.min(40));
            let Premise::Fact(number) = premise else {
                writeln!(f, "{indent}{premise}")?;
                continue;
            };
            let step = &self.steps[number];
            let again = std::mem::replace(&mut was_shown[number], true);
            match &step.because {
                Because::Told => writeln!(f, "{indent}{}", step.fact)?,
                Because::Written { source, line } => {
                    writeln!(f, "{indent}{}  ← {source}:{line}", step.fact)?;
                }
                Because::Rule { .. } if again => {
                    let above = SEE_ABOVE.say(Language::Russian);
                    writeln!(f, "{indent}{} ({above})", step.fact)?;
                }
                Because::Rule { rule, premises } => {
                    writeln!(f, "{indent}{}  ← {}:{}", step.fact, rule.source, rule.line)?;
                    open.extend(premises.iter().rev().map(|premise| (depth + 1, premise.clone())));
                }
            }
        }
        Ok(())
    }
}
