//! What the rules of one tuple ask of other relations: which of them, with which of their columns known.
//!
//! Known is what the tuple says, what rules name, and what they hand on to the rules below; what a rule would find by
//! joining is not. Whoever tells the rows of these calls can show why the tuple holds, or what it lacks.

use std::collections::BTreeSet;

use super::database::{FactError, RelationKey, Schema};
use super::program::{Clause, Expr, Literal, Program, Term};
use super::relations::RelationId;
use super::word::{NO_WORD, Value, Word};

/// A relation, and a row of it as far as it is known.
pub type KnownRow = (RelationId, Vec<Option<Value>>);

/// A relation and the words that are known of a row, [`NO_WORD`] for the others.
type Call = (RelationId, Vec<Word>);

impl Program {
    /// The calls of some relations that the rules of a tuple make.
    ///
    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn calls(
        &self,
        relation: impl RelationKey,
        tuple: &[Value],
        of: &[RelationId],
    ) -> Result<Vec<KnownRow>, FactError> {
        let mut words = self.words.share();
        let schema = Schema::of(self);
        let relation = relation.find(&schema)?;
        let row = schema
            .encode(relation, tuple, |value, kind| words.of(value, kind).unwrap_or(NO_WORD))?;
        let (mut made, mut open) =
            (BTreeSet::from([(relation, row.clone())]), vec![(relation, row)]);
        while let Some((relation, row)) = open.pop() {
            for clause in self.clauses.iter().filter(|clause| clause.head == relation) {
                for call in clause.calls(&row) {
                    if made.insert(call.clone()) {
                        open.push(call);
                    }
                }
            }
        }
        let value = |(relation, row): &Call| {
            let columns = self.info(*relation).columns.iter().zip(row);
            let known = columns
                .map(|(column, word)| (*word != NO_WORD).then(|| words.value(*word, column.kind)));
            (*relation, known.collect())
        };
        Ok(made.iter().filter(|(relation, _)| of.contains(relation)).map(value).collect())
    }
}

impl Clause {
    /// What it calls for a row of its head; nothing where the row is not of this head.
    fn calls(&self, row: &[Word]) -> Vec<Call> {
        let mut known = vec![NO_WORD; self.variables.len()];
        for (arg, word) in self.args.iter().zip(row).filter(|(_, word)| **word != NO_WORD) {
            match arg {
                Expr::Variable(v) if known[*v as usize] == NO_WORD => known[*v as usize] = *word,
                Expr::Variable(v) if known[*v as usize] != *word => return Vec::new(),
                Expr::Constant(own) if own != word => return Vec::new(),
                _ => {}
            }
        }
        let mut calls = Vec::new();
        read(&self.body, &known, &mut calls);
        calls
    }
}

fn read(body: &[Literal], known: &[Word], calls: &mut Vec<Call>) {
    for literal in body {
        match literal {
            Literal::Atom(atom) | Literal::Not(atom) => {
                let word = |term: &Term| match term {
                    Term::Any => NO_WORD,
                    Term::Variable(v) => known.get(*v as usize).copied().unwrap_or(NO_WORD),
                    Term::Constant(word) => *word,
                };
                calls.push((atom.relation, atom.args.iter().map(word).collect()));
            }
            Literal::Aggregate(aggregate) => read(&aggregate.body, known, calls),
            Literal::Compare(_) | Literal::Range(_) => {}
        }
    }
}
