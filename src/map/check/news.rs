//! The faults that an edit would make: looked for where it changed something.
//!
//! **Invariant**: of a map that has passed every check, they are those of [`check`] after the edit that it does not find
//! before, as a test holds against checking both maps whole.

use std::collections::BTreeSet;

use crate::fault::Fault;
use crate::{NameIndex, World};

use super::{Checker, Scope, check};

/// The faults that a map has after an edit, and had not before: looked for in what changed and what hangs on it alone.
/// `names` is asked for the names of the map before, where one of them changed.
#[must_use]
pub fn news(before: &World, after: &World, names: impl FnOnce() -> NameIndex) -> Vec<Fault> {
    let Some(mut scope) = Scope::between(before, after) else { return whole_news(before, after) };
    let renamed = Scope::renamed(before, after);
    if renamed.is_empty() {
        return without(scope.faults_of(after), || scope.faults_of(before));
    }
    let bearers = names();
    let mut bearers_after = bearers.clone();
    bearers_after.follow(before, after);
    scope.names = Some((renamed.clone(), bearers_after));
    let after_faults = scope.faults_of(after);
    // What is said of a thing is known if it was said of another of that name.
    scope.add_twins(before, &renamed, &bearers);
    scope.names = Some((renamed, bearers));
    without(after_faults, || scope.faults_of(before))
}

impl Scope<'_> {
    /// What [`check`] finds in it, in the same order.
    fn faults_of(&self, world: &World) -> Vec<Fault> {
        let broken = BTreeSet::new();
        let mut checker = Checker::new(world, &broken);
        checker.scope = Some(self);
        checker.all()
    }
}

/// The same by checking both maps whole.
#[must_use]
fn whole_news(before: &World, after: &World) -> Vec<Fault> {
    without(check(after), || check(before))
}

/// Faults but for those that are known, which are looked for where there are any.
fn without(faults: Vec<Fault>, known: impl FnOnce() -> Vec<Fault>) -> Vec<Fault> {
    let known = if faults.is_empty() { Vec::new() } else { known() };
    faults.into_iter().filter(|f| !known.iter().any(|k| k.error == f.error)).collect()
}
