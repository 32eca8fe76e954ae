//! A checked program: relations, clauses over numbered variables, strata.
//!
//! **Invariant**: every variable of a clause gets its value from a positive premise or an equality,
//! and no relation depends on its own negation or aggregate, so evaluation always has an order to run in.

use std::sync::Arc;

use super::declared::Declared;
use super::fault::FileFaults;
use super::limits::Ceilings;
use super::relations::{Names, RelationId, RelationInfo};
pub use super::syntax::Kind;
use super::syntax::{Aggregation, Comparison, Functor, Span};
use super::word::{Value, Word, Words};
use crate::units::Source;

/// A rule for one head and one choice of each disjunction.
#[derive(Debug, Clone)]
pub(super) struct Clause {
    pub(super) head: RelationId,
    pub(super) args: Vec<Expr>,
    pub(super) body: Vec<Literal>,
    pub(super) variables: Vec<Variable>,
    /// The whole rule in its text.
    pub(super) at: Span,
}

#[derive(Debug, Clone)]
pub(super) struct Variable {
    /// As written; empty for one that stands for an expression among an atom's arguments.
    pub(super) name: String,
    pub(super) kind: Kind,
}

pub(super) type VariableId = u32;

#[derive(Debug, Clone)]
pub(super) enum Literal {
    Atom(Atom),
    Not(Atom),
    Compare(Compare),
    Aggregate(Aggregate),
    Range(NumberRange),
}

#[derive(Debug, Clone)]
pub(super) struct Atom {
    pub(super) relation: RelationId,
    pub(super) args: Vec<Term>,
    pub(super) at: Span,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Term {
    Any,
    Variable(VariableId),
    Constant(Word),
}

#[derive(Debug, Clone)]
pub(super) struct Compare {
    pub(super) op: Comparison,
    pub(super) left: Expr,
    pub(super) right: Expr,
    pub(super) kind: Kind,
    pub(super) at: Span,
}

#[derive(Debug, Clone)]
pub(super) struct Aggregate {
    pub(super) target: VariableId,
    /// Of the target.
    pub(super) kind: Kind,
    pub(super) function: Aggregation,
    pub(super) value: Option<Expr>,
    pub(super) body: Vec<Literal>,
    /// Variables of the rule outside that the body reads.
    pub(super) shared: Vec<VariableId>,
    pub(super) at: Span,
}

/// `target = range(from, to, step)`: each of the numbers from `from` on, `to` not among them.
#[derive(Debug, Clone)]
pub(super) struct NumberRange {
    pub(super) target: VariableId,
    pub(super) kind: Kind,
    pub(super) bounds: Bounds,
    pub(super) at: Span,
}

/// Where a range begins, ends, and by how much it steps: by one towards the end where that is not said.
#[derive(Debug, Clone)]
pub(super) struct Bounds {
    pub(super) from: Expr,
    pub(super) to: Expr,
    pub(super) step: Option<Expr>,
    /// One, in what the numbers are counted in.
    pub(super) unit: i64,
}

impl Bounds {
    pub(super) fn exprs(&self) -> impl Iterator<Item = &Expr> {
        [&self.from, &self.to].into_iter().chain(&self.step)
    }
}

/// A computed value; its variables are a clause's, or an index's columns.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) enum Expr {
    Variable(VariableId),
    Constant(Word),
    Call(Functor, Vec<Self>),
}

impl Expr {
    pub(super) fn for_each_variable(&self, f: &mut dyn FnMut(VariableId)) {
        match self {
            Self::Variable(v) => f(*v),
            Self::Constant(_) => {}
            Self::Call(_, args) => args.iter().for_each(|arg| arg.for_each_variable(f)),
        }
    }

    pub(super) fn all_variables(&self, mut f: impl FnMut(VariableId) -> bool) -> bool {
        let mut all = true;
        self.for_each_variable(&mut |v| all &= f(v));
        all
    }

    /// Whether `autoinc()` stands in it.
    pub(super) fn counts_on(&self) -> bool {
        match self {
            Self::Call(functor, args) => {
                *functor == Functor::Counter || args.iter().any(Self::counts_on)
            }
            _ => false,
        }
    }

    pub(super) fn has_variables(&self) -> bool {
        !self.all_variables(|_| false)
    }
}

impl Clause {
    /// Whether `autoinc()` stands in it.
    pub(super) fn counts_on(&self) -> bool {
        self.args.iter().any(Expr::counts_on)
            || self.body.iter().any(|literal| match literal {
                Literal::Compare(compare) => compare.left.counts_on() || compare.right.counts_on(),
                _ => false,
            })
    }
}

/// Relations that depend on each other, and what derives them.
#[derive(Debug, Clone)]
pub(super) struct Stratum {
    pub(super) relations: Vec<RelationId>,
    /// Positions in [`Program::clauses`].
    pub(super) clauses: Vec<usize>,
    /// Positions in [`Program::subsumptions`].
    pub(super) subsumptions: Vec<usize>,
}

/// Which tuples of a relation go where others stand.
#[derive(Debug, Clone)]
pub(super) struct Subsumption {
    pub(super) relation: RelationId,
    pub(super) clause: Clause,
}

/// A fact in the text.
#[derive(Debug, Clone)]
pub(super) struct Fact {
    pub(super) relation: RelationId,
    pub(super) words: Box<[Word]>,
    pub(super) at: Span,
}

/// A rule text that was read and found sound, ready to be evaluated over any number of databases. Cheap to clone.
#[derive(Debug, Clone)]
pub struct Program {
    pub(super) sources: Arc<[Source]>,
    pub(super) relations: Arc<Vec<Arc<RelationInfo>>>,
    pub(super) names: Arc<Names>,
    pub(super) clauses: Arc<[Arc<Clause>]>,
    pub(super) facts: Arc<[Fact]>,
    pub(super) strata: Arc<[Stratum]>,
    /// For each `A <= B` a clause whose head is the tuple that goes and the one that stays.
    pub(super) subsumptions: Arc<[Subsumption]>,
    /// What the text itself allows.
    pub(super) limits: Ceilings,
    /// The constants of the text; a database starts with them.
    pub(super) words: Words,
    pub(super) warnings: Arc<[FileFaults]>,
    /// What questions about the program's results name.
    pub(super) declared: Arc<Declared>,
}

impl Program {
    /// `rules.dl:3:1`
    pub(super) fn place(&self, at: Span) -> String {
        let source = &self.sources[at.file as usize];
        let (line, column) = source.position(at.start as usize);
        format!("{}:{line}:{column}", source.name())
    }

    /// What is odd about the text without being wrong: relations never used, never derived.
    #[must_use]
    pub fn warnings(&self) -> &[FileFaults] {
        &self.warnings
    }

    /// The relation of either of its names. Spellings that differ in case or ё find it too,
    /// unless they fit several.
    #[must_use]
    pub fn relation(&self, name: &str) -> Option<RelationId> {
        self.names.find(name)
    }

    #[must_use]
    pub fn info(&self, relation: RelationId) -> &RelationInfo {
        &self.relations[relation.index()]
    }

    /// All relations, in the order of their declarations.
    pub fn relations(&self) -> impl Iterator<Item = (RelationId, &RelationInfo)> {
        self.relations.iter().enumerate().map(|(n, info)| (RelationId(n as u32), &**info))
    }

    /// Whether the text asks for its results to be derived on demand: `.pragma "magic-transform" "*"`.
    pub(super) fn asks_for_demand(&self) -> bool {
        self.limits.on_demand
    }

    /// Whether what is derived depends on the order in which it is: then nothing can be derived in part.
    pub(super) fn depends_on_order(&self) -> bool {
        !self.subsumptions.is_empty()
            || self.clauses.iter().any(|clause| clause.counts_on())
            || self
                .relations
                .iter()
                .any(|info| info.limit_size.is_some() || !info.choices.is_empty())
    }

    /// The facts of a relation that stand in the text, each with its values and where it stands.
    pub fn written(
        &self,
        relation: RelationId,
    ) -> impl Iterator<Item = (Vec<Value>, &Source, miette::SourceSpan)> {
        let columns = &self.info(relation).columns;
        let facts = self.facts.iter().filter(move |fact| fact.relation == relation);
        facts.map(move |fact| {
            let values = fact.words.iter().zip(columns);
            let values = values.map(|(word, column)| self.words.value(*word, column.kind));
            (values.collect(), &self.sources[fact.at.file as usize], fact.at.into())
        })
    }

    /// A rule's text, its source and its line, for proofs.
    pub(super) fn excerpt(&self, at: Span) -> (&Source, usize, &str) {
        let source = &self.sources[at.file as usize];
        let (line, _) = source.position(at.start as usize);
        (source, line, &source.text()[at.range()])
    }
}

/// Every variable of a body, those within aggregates included.
pub(super) fn used_variables(
    body: &[Literal],
    value: Option<&Expr>,
    f: &mut dyn FnMut(VariableId),
) {
    if let Some(value) = value {
        value.for_each_variable(f);
    }
    for literal in body {
        match literal {
            Literal::Atom(atom) | Literal::Not(atom) => {
                for term in &atom.args {
                    if let Term::Variable(v) = term {
                        f(*v);
                    }
                }
            }
            Literal::Compare(compare) => {
                compare.left.for_each_variable(f);
                compare.right.for_each_variable(f);
            }
            Literal::Range(range) => {
                f(range.target);
                range.bounds.exprs().for_each(|expr| expr.for_each_variable(f));
            }
            Literal::Aggregate(aggregate) => {
                f(aggregate.target);
                used_variables(&aggregate.body, aggregate.value.as_ref(), f);
            }
        }
    }
}
