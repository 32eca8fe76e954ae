//! The satisfiability solver behind [`super::sat`]: batsat, a MiniSat in Rust, held to a number of conflicts.

use std::cell::Cell;

use batsat::callbacks::Callbacks;
use batsat::{Lit, SolverInterface, lbool};

use crate::Limits;

/// A variable or its negation.
pub(crate) type Literal = Lit;

pub(crate) enum Answer {
    Satisfiable,
    Unsatisfiable,
    /// The conflicts allowed were used up, or the time.
    Open,
}

pub(crate) struct Solver {
    inner: batsat::Solver<Effort>,
    literals: usize,
    clause: Vec<Lit>,
}

/// Stops the solver by the number of conflicts, which repeats, and by the clock or from outside, which is a limit.
struct Effort {
    conflicts: Cell<u64>,
    allowed: u64,
    limits: Limits,
    late: Cell<bool>,
}

impl Callbacks for Effort {
    fn on_new_clause(&mut self, _clause: &[Lit], source: batsat::ClauseKind) {
        if source == batsat::ClauseKind::Learnt {
            self.conflicts.set(self.conflicts.get() + 1);
        }
    }

    fn stop(&self) -> bool {
        // Looking at the clock costs more than a propagation.
        if self.conflicts.get().is_multiple_of(64) && self.limits.check(0).is_err() {
            self.late.set(true);
        }
        self.late.get() || self.conflicts.get() >= self.allowed
    }
}

impl Solver {
    pub(crate) fn new(limits: &Limits) -> Self {
        let effort = Effort {
            conflicts: Cell::new(0),
            allowed: 0,
            limits: limits.clone(),
            late: Cell::new(false),
        };
        Self {
            inner: batsat::Solver::new(batsat::SolverOpts::default(), effort),
            literals: 0,
            clause: Vec::new(),
        }
    }

    pub(crate) fn new_variable(&mut self) -> Literal {
        // Left to itself the solver tries "false" first and later its last choice: few actions by nature.
        Lit::new(self.inner.new_var(lbool::UNDEF, true), true)
    }

    /// A variable that is only ever assumed; the solver never tries values for it.
    pub(crate) fn new_switch(&mut self) -> Literal {
        Lit::new(self.inner.new_var(lbool::UNDEF, false), true)
    }

    pub(crate) fn add_clause(&mut self, literals: &[Literal]) {
        self.literals += literals.len() + 2;
        self.clause.clear();
        self.clause.extend_from_slice(literals);
        self.inner.add_clause_reuse(&mut self.clause);
    }

    pub(crate) fn solve(&mut self, assumptions: &[Literal], conflicts: u64) -> Answer {
        let effort = self.inner.cb_mut();
        effort.allowed = effort.conflicts.get() + conflicts;
        match self.inner.solve_limited(assumptions) {
            answer if answer == lbool::TRUE => Answer::Satisfiable,
            answer if answer == lbool::FALSE => Answer::Unsatisfiable,
            _ => Answer::Open,
        }
    }

    /// A literal's value in the model found last.
    pub(crate) fn value(&self, literal: Literal) -> bool {
        self.inner.value_lit(literal) == lbool::TRUE
    }

    /// The assumptions that took part in the last refutation.
    pub(crate) fn blamed(&self) -> Vec<Literal> {
        self.inner.unsat_core().iter().map(|&literal| !literal).collect()
    }

    /// Variables set so far, over and over.
    pub(crate) fn effort(&self) -> u64 {
        self.inner.num_propagations()
    }

    pub(crate) fn conflicts(&self) -> u64 {
        self.inner.cb().conflicts.get()
    }

    pub(crate) fn bytes(&self) -> usize {
        // Literals with their watches, and variables with theirs.
        self.literals * 12 + self.inner.num_vars() as usize * 100
    }
}
