//! The head of a clause: its tuple for each solution of the body.

use super::limits::{MAX_ROWS, Watch};
use super::program::{Clause, Expr, Kind, Program, VariableId};
use super::run::Goal;
use super::sink::Sink;
use super::value;
use super::word::{Word, Words};

/// The variables whose values a clause's head reads.
pub(super) fn head_variables(clause: &Clause) -> Vec<VariableId> {
    let mut wanted: Vec<VariableId> = Vec::new();
    clause.args.iter().for_each(|arg| arg.for_each_variable(&mut |v| wanted.push(v)));
    wanted
}

/// Puts the head's tuple for each solution into the sink.
pub(super) struct Head<'a> {
    args: &'a [Expr],
    /// Columns that hold no negative number; a solution that would put one there is none.
    unsigned: Vec<usize>,
    /// Of `.limitsize`.
    limit: usize,
    /// Solutions so far.
    solutions: usize,
    row: Vec<Word>,
    sink: &'a mut dyn Sink,
    watch: &'a Watch,
    /// Memory of words that others hold as well.
    shared_bytes: usize,
}

/// Solutions between two looks at the memory that they take.
const SOLUTIONS_A_LOOK: usize = 1 << 12;

impl<'a> Head<'a> {
    pub(super) fn new(
        program: &Program,
        clause: &'a Clause,
        limit: usize,
        sink: &'a mut dyn Sink,
        watch: &'a Watch,
    ) -> Self {
        let columns = &program.info(clause.head).columns;
        let unsigned: Vec<usize> =
            (0..columns.len()).filter(|n| columns[*n].kind == Kind::Unsigned).collect();
        let row = vec![0; clause.args.len()];
        let (args, solutions, shared_bytes) = (&clause.args, 0, 0);
        Self { args, unsigned, limit, solutions, row, sink, watch, shared_bytes }
    }

    /// For a thread whose words are shared with others up to so many bytes.
    pub(super) fn beside(self, shared_bytes: usize) -> Self {
        Self { shared_bytes, ..self }
    }
}

/// The heads of a clause's solutions, one by one.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub(super) rows: Vec<Box<[Word]>>,
}

impl Rows {
    /// Takes the solutions that `run` finds for the goal that it is given.
    pub(super) fn fill(
        &mut self,
        program: &Program,
        clause: &Clause,
        run: impl FnOnce(&mut dyn Goal),
    ) {
        run(&mut Head::new(program, clause, MAX_ROWS, self, &Watch::unlimited()));
    }
}

impl Sink for Rows {
    fn push(&mut self, row: &[Word]) {
        self.rows.push(row.into());
    }

    fn len(&self) -> usize {
        self.rows.len()
    }

    fn bytes(&self) -> usize {
        self.rows.iter().map(|row| size_of_val(&**row) + size_of_val(row)).sum()
    }
}

impl Goal for Head<'_> {
    fn reached(&mut self, registers: &[Word], words: &mut Words) -> bool {
        for (word, arg) in self.row.iter_mut().zip(self.args) {
            *word = match arg {
                Expr::Variable(v) => registers[*v as usize],
                Expr::Constant(word) => *word,
                Expr::Call(..) => match value::compute(arg, &|v| registers[v as usize], words) {
                    Some(word) => word,
                    None => return false,
                },
            };
        }
        if self.unsigned.iter().any(|n| words.to_number(self.row[*n]) < 0) {
            return false;
        }
        if self.solutions.is_multiple_of(SOLUTIONS_A_LOOK) {
            let words = words.bytes().saturating_sub(self.shared_bytes);
            self.watch.weigh(self.sink.bytes() + words);
        }
        if self.watch.is_over() || self.limit < MAX_ROWS && self.sink.len() >= self.limit {
            return false;
        }
        self.solutions += 1;
        self.sink.push(&self.row);
        true
    }
}
