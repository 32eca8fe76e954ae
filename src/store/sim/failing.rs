//! Trees that fail at one of their calls, as a sled on a full disk: they decide nothing.

use std::sync::Arc;

use super::{Run, SimTrees, TREES, dir};
use crate::error::{Result, StoreError};
use crate::frame::Op;
use crate::trees::{State, Trees, Visit};
use crate::vault::{Change, Shelf, Vault};

/// Trees that fail at one of their calls, and from then on.
#[derive(Clone, Copy, Debug, PartialEq)]
enum FailsTo {
    Open,
    BeSetAside,
    Apply,
    Flush,
}

struct FailingTrees {
    inner: Arc<SimTrees>,
    fails: FailsTo,
}

fn no_room<T>() -> Result<T> {
    Err(StoreError::Tables { what: "No space left on device".into() })
}

impl Trees for FailingTrees {
    fn scan(&self, tree: u8, prefix: &[u8], visit: &mut Visit) -> Result<()> {
        self.inner.scan(tree, prefix, visit)
    }
    fn apply(&self, ops: Vec<Op>, state: &State) -> Result<()> {
        if self.fails == FailsTo::Apply { no_room() } else { self.inner.apply(ops, state) }
    }
    fn state(&self) -> Result<State> {
        if self.fails == FailsTo::BeSetAside { no_room() } else { self.inner.state() }
    }
    fn flush(&self) -> Result<()> {
        if self.fails == FailsTo::Flush { no_room() } else { self.inner.flush() }
    }
}

struct FailingShelf {
    trees: Arc<SimTrees>,
    fails: FailsTo,
}

impl Shelf for FailingShelf {
    fn open(&mut self) -> Result<Arc<dyn Trees>> {
        match self.fails {
            FailsTo::Open => no_room(),
            fails => Ok(Arc::new(FailingTrees { inner: Arc::clone(&self.trees), fails })),
        }
    }
    fn exists(&self) -> bool {
        true
    }
    fn set_aside(&mut self) -> Result<()> {
        if self.fails == FailsTo::BeSetAside { no_room() } else { Ok(()) }
    }
    fn look(&self) -> Result<Arc<dyn Trees>> {
        no_room()
    }
}

/// Whatever the trees do, a store whose journal is whole opens, takes what it is given, and has it the next time.
#[test]
fn failing_trees_decide_nothing() {
    for fails in [FailsTo::Open, FailsTo::BeSetAside, FailsTo::Apply, FailsTo::Flush] {
        let mut run = Run::new(5);
        drop(run.open().expect("a new store"));
        for _ in 0..4 {
            let mut shelf = FailingShelf { trees: Arc::clone(&run.shelf.trees), fails };
            let opened = Vault::open(Arc::new(run.disk.clone()), dir(), &mut shelf);
            let (mut vault, _) = opened.unwrap_or_else(|e| panic!("{fails:?}: {e}"));
            assert_eq!(vault.lsn(), run.acknowledged, "{fails:?}");
            run.check(&vault, run.acknowledged);
            for round in 0..30_u8 {
                let mut after = run.past[vault.lsn() as usize].clone();
                let (tree, key, value) =
                    (TREES[usize::from(round % 3)], vec![round % 5], vec![round]);
                let old = after.insert((tree, key.clone()), value.clone());
                run.past.push(after);
                let change = Change { op: Op { tree, key, value: Some(value) }, old };
                vault.commit(vec![change]).unwrap_or_else(|e| panic!("{fails:?}: {e}"));
                run.acknowledged = vault.lsn();
                if round == 20 {
                    // What fails is seen at the latest here, and harms nothing.
                    let _ = vault.catch_up();
                    vault.checkpoint().unwrap_or_else(|e| panic!("{fails:?}: {e}"));
                    run.past.resize(vault.lsn() as usize + 1, run.past[run.past.len() - 1].clone());
                }
            }
            run.check(&vault, run.acknowledged);
        }
    }
}
