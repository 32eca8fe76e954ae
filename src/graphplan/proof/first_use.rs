//! Interchangeable objects put to use in one order, for the solver: where balls are alike, the second is not taken
//! up before the first.
//!
//! Whoever exchanges objects that neither initial state nor goal tell apart turns plans into plans. So of all plans
//! that differ by such exchanges it is enough to look at those in which the objects of a class are first used in the
//! order of their names; without that a refutation would have to be found once for each exchange (J. Crawford,
//! M. Ginsberg, E. Luks, A. Roy, 1996, "symmetry-breaking predicates").

use super::solver::{Literal, Solver};
use super::symmetry::users_of_alike;
use crate::Limits;
use crate::strips::{OperatorId, Task};

pub(crate) struct FirstUse {
    /// For each class and each object of it, what it takes part in.
    users: Vec<Vec<Vec<OperatorId>>>,
    /// For each class and each object but the last, "it was used before this level".
    used: Vec<Vec<Literal>>,
}

impl FirstUse {
    pub(crate) fn of(task: &Task, limits: &Limits) -> Self {
        Self { users: users_of_alike(task, limits), used: Vec::new() }
    }

    /// Adds a step, the variables of whose operators are given.
    pub(crate) fn add_step(&mut self, solver: &mut Solver, step: &[Option<Literal>]) {
        let mut used = Vec::new();
        for (class, objects) in self.users.iter().enumerate() {
            let mut used_of_class = Vec::new();
            for (object, pair) in objects.windows(2).enumerate() {
                let now = solver.new_variable();
                let mut because = vec![!now];
                if let Some(&before) = self.used.get(class).and_then(|all| all.get(object)) {
                    solver.add_clause(&[!before, now]);
                    because.push(before);
                }
                because.extend(pair[0].iter().filter_map(|id| step[id.index()]));
                solver.add_clause(&because);
                for done in pair[1].iter().filter_map(|id| step[id.index()]) {
                    solver.add_clause(&[!done, now]);
                }
                used_of_class.push(now);
            }
            used.push(used_of_class);
        }
        self.used = used;
    }
}
