//! Subsumption and choice: tuples that go where others stand.
//!
//! `shortest(x, a) <= shortest(x, b) :- b < a.` takes the left tuple out of the relation as soon as the right one is in
//! it, after each round of the evaluation, so that a recursive rule goes on from the best tuples only. Of a relation with
//! `choice-domain k` the first tuple of each `k` stays that the evaluation finds; its order is fixed.

use crate::units::word;
use std::cell::{Ref, RefCell, RefMut};
use std::collections::{HashMap, HashSet};

use datafrog::Iteration;

use super::declared::{Declared, MAX_COLUMNS};
use super::fault::{Found, RuleError};
use super::growing::{Growing, Version};
use super::relations::{Column, RelationId, RelationInfo};
use super::rows::{Heap, RowSet, SharedRows, heap};
use super::sink::Sink;
use super::syntax::{Atom, Body, Expr, Item, Name, Rule};
use super::word::Word;

/// A rule for a relation of both tuples, side by side: the one that goes, the one that stays.
pub(super) fn rule(
    item: &Item,
    declared: &mut Declared,
    dominated: &mut HashMap<RelationId, RelationId>,
    faults: &mut Found,
) -> Option<Rule> {
    let Item::Subsumption { dominated: goes, dominating: stays, body, at } = item else {
        return None;
    };
    let relation = declared.relation(&goes.relation, faults)?;
    if declared.relation(&stays.relation, faults)? != relation {
        let what = format!("«{}» <= «{}»", goes.relation.text, stays.relation.text);
        let help = word!("rows-of-one-relation-subsume-each-other");
        faults.push(*at, RuleError::Unsupported { what: what.into(), help, at: (*at).into() });
        return None;
    }
    let columns = declared.relations[relation.index()].columns.len();
    for atom in [goes, stays] {
        if atom.args.len() != columns {
            let (name, found) = (atom.relation.text.clone(), atom.args.len());
            let fault = RuleError::Arity { name, expected: columns, found, at: atom.at.into() };
            faults.push(atom.at, fault);
            return None;
        }
    }
    if 2 * columns > MAX_COLUMNS {
        let (what, limit) = (word!("columns-of-a-relation-with-subsumption"), MAX_COLUMNS / 2);
        faults.push(*at, RuleError::TooLarge { what, limit, at: (*at).into() });
        return None;
    }
    let both = RelationId(declared.relations.len() as u32);
    let name = format!("поглощение {}", dominated.len() + 1);
    declared.names.insert(&name, both);
    let info = &declared.relations[relation.index()];
    let twice = |columns: &[Column]| [columns, columns].concat();
    let info = RelationInfo {
        name: name.clone(),
        columns: twice(&info.columns),
        ..RelationInfo::default()
    };
    declared.relations.push(info);
    let types = declared.columns[relation.index()].clone();
    declared.columns.push([types.as_slice(), types.as_slice()].concat());
    declared.places.push(*at);
    dominated.insert(both, relation);
    let (goes, stays) = (named(goes, 1), named(stays, 2));
    let args = [goes.args.as_slice(), stays.args.as_slice()].concat();
    let head = Atom { relation: Name { text: name, at: *at }, args, at: *at };
    let body = Body::All(vec![Body::Atom(goes), Body::Atom(stays), body.clone()]);
    Some(Rule { heads: vec![head], body, at: *at })
}

/// The atom with a name for each `_`.
fn named(atom: &Atom, side: usize) -> Atom {
    let name = |(n, arg): (usize, &Expr)| match arg {
        Expr::Any(at) => Expr::Variable(Name { text: format!("_{side}′{n}"), at: *at }),
        other => other.clone(),
    };
    Atom { args: atom.args.iter().enumerate().map(name).collect(), ..atom.clone() }
}

/// A sink that takes the first tuple of each combination only.
pub(super) struct Choosing<'a> {
    pub(super) taken: &'a mut Chosen,
    pub(super) sink: &'a mut dyn Sink,
}

/// Combinations of values.
type Taken = HashSet<Box<[Word]>>;

/// The combinations that have their tuple.
#[derive(Debug, Default)]
pub(super) struct Chosen {
    domains: Vec<(Vec<usize>, Taken)>,
}

impl Chosen {
    pub(super) fn of(info: &RelationInfo) -> Self {
        let domain = |columns: &Vec<usize>| (columns.clone(), HashSet::new());
        Self { domains: info.choices.iter().map(domain).collect() }
    }

    fn takes(&mut self, row: &[Word]) -> bool {
        let key = |columns: &[usize]| columns.iter().map(|at| row[*at]).collect::<Box<[Word]>>();
        let is_free = self.domains.iter().all(|(columns, taken)| !taken.contains(&key(columns)));
        if is_free {
            for (columns, taken) in &mut self.domains {
                taken.insert(key(columns));
            }
        }
        is_free
    }
}

impl Sink for Choosing<'_> {
    fn push(&mut self, row: &[Word]) {
        if self.taken.takes(row) {
            self.sink.push(row);
        }
    }

    fn len(&self) -> usize {
        self.sink.len()
    }

    fn bytes(&self) -> usize {
        const A_KEY: usize = 64;
        self.sink.bytes()
            + self.taken.domains.iter().map(|(_, taken)| taken.len() * A_KEY).sum::<usize>()
    }
}

/// A sink for the pairs of a subsumption: the tuples that go, unless both are the same.
#[derive(Default)]
pub(super) struct Dominated {
    pub(super) rows: HashSet<Box<[Word]>>,
}

impl Sink for Dominated {
    fn push(&mut self, row: &[Word]) {
        let (goes, stays) = row.split_at(row.len() / 2);
        if goes != stays && !self.rows.contains(goes) {
            self.rows.insert(goes.into());
        }
    }

    fn len(&self) -> usize {
        self.rows.len()
    }

    fn bytes(&self) -> usize {
        self.rows.iter().map(|row| 2 * size_of_val(&**row) + size_of_val(row)).sum()
    }
}

/// A relation that grows and loses tuples, round by round.
pub(super) struct Pruned {
    columns: usize,
    /// The natural order first; each order's columns, rows from before the last round, and its rows.
    orders: Vec<Order>,
    pushed: RefCell<Box<dyn Heap>>,
}

struct Order {
    columns: Vec<usize>,
    stable: RefCell<SharedRows>,
    recent: RefCell<SharedRows>,
}

impl Pruned {
    pub(super) fn new(columns: usize) -> Self {
        let natural = Order {
            columns: (0..columns).collect(),
            stable: RefCell::new(heap(columns).sort()),
            recent: RefCell::new(heap(columns).sort()),
        };
        Self { columns, orders: vec![natural], pushed: RefCell::new(heap(columns)) }
    }

    fn rows(&self, is_stable: bool) -> SharedRows {
        let order = &self.orders[0];
        if is_stable { order.stable.borrow().clone() } else { order.recent.borrow().clone() }
    }

    fn set(&mut self, stable: &SharedRows, recent: &SharedRows) {
        for order in &self.orders {
            order.stable.replace(turned(stable, &order.columns));
            order.recent.replace(turned(recent, &order.columns));
        }
    }
}

/// The rows with their columns in another order.
fn turned(rows: &SharedRows, columns: &[usize]) -> SharedRows {
    if columns.iter().enumerate().all(|(n, column)| n == *column) {
        return rows.clone();
    }
    let mut all = heap(columns.len());
    all.project(&**rows, columns);
    all.sort()
}

impl Growing for Pruned {
    fn sink(&self) -> RefMut<'_, dyn Sink> {
        RefMut::map(self.pushed.borrow_mut(), |pushed| pushed.as_sink() as &mut dyn Sink)
    }

    /// The rows of the last round become old ones; what was pushed since and is new becomes recent.
    fn flush(&mut self) {
        let pushed = std::mem::replace(&mut *self.pushed.borrow_mut(), heap(self.columns));
        let pushed = pushed.sort();
        let (stable, recent) = (self.rows(true), self.rows(false));
        let mut old = heap(self.columns);
        for rows in [&stable, &recent] {
            (0..rows.len()).for_each(|at| old.push(&rows.row(at)[..self.columns]));
        }
        let old = old.sort();
        let mut new = heap(self.columns);
        for at in 0..pushed.len() {
            let row = &pushed.row(at)[..self.columns];
            if self.columns == 0 && old.len() > 0 || !old.range(row).is_empty() {
                continue;
            }
            new.push(row);
        }
        self.set(&old, &new.sort());
    }

    /// Takes tuples out.
    fn prune(&mut self, gone: &HashSet<Box<[Word]>>) {
        if gone.is_empty() {
            return;
        }
        let left = |rows: &SharedRows| {
            let mut left = heap(self.columns);
            for at in 0..rows.len() {
                let row = &rows.row(at)[..self.columns];
                if !gone.contains(row) {
                    left.push(row);
                }
            }
            left.sort()
        };
        let (stable, recent) = (left(&self.rows(true)), left(&self.rows(false)));
        self.set(&stable, &recent);
    }

    fn has_recent(&self) -> bool {
        self.orders[0].recent.borrow().len() > 0
    }

    fn follow(&mut self) {}

    fn order(&mut self, _: &mut Iteration, columns: &[usize], _: Version) -> usize {
        let rest = (0..self.columns).filter(|column| !columns.contains(column));
        let columns: Vec<usize> = columns.iter().copied().chain(rest).collect();
        let known = self.orders.iter().position(|order| order.columns == columns);
        known.unwrap_or_else(|| {
            let (stable, recent) = (self.rows(true), self.rows(false));
            self.orders.push(Order {
                stable: RefCell::new(turned(&stable, &columns)),
                recent: RefCell::new(turned(&recent, &columns)),
                columns,
            });
            self.orders.len() - 1
        })
    }

    fn recent(&self, order: usize) -> Vec<Ref<'_, dyn RowSet>> {
        vec![Ref::map(self.orders[order].recent.borrow(), |rows| &**rows as &dyn RowSet)]
    }

    fn stable(&self, order: usize) -> Vec<Ref<'_, dyn RowSet>> {
        vec![Ref::map(self.orders[order].stable.borrow(), |rows| &**rows as &dyn RowSet)]
    }

    fn len(&self) -> usize {
        self.orders[0].stable.borrow().len() + self.orders[0].recent.borrow().len()
    }

    fn bytes(&self) -> usize {
        let held = self.orders.iter();
        held.map(|order| order.stable.borrow().bytes() + order.recent.borrow().bytes())
            .sum::<usize>()
            + self.pushed.borrow().bytes()
    }

    fn complete(self: Box<Self>, _: usize) -> SharedRows {
        let mut all = heap(self.columns);
        for rows in [self.rows(true), self.rows(false)] {
            (0..rows.len()).for_each(|at| all.push(&rows.row(at)[..self.columns]));
        }
        all.sort()
    }
}

/// A sink, through the choice of a relation that has one.
pub(super) enum MaybeChoosing<'a> {
    Plain(&'a mut dyn Sink),
    Choosing(Choosing<'a>),
}

impl MaybeChoosing<'_> {
    pub(super) fn as_sink(&mut self) -> &mut dyn Sink {
        match self {
            MaybeChoosing::Plain(sink) => &mut **sink,
            MaybeChoosing::Choosing(sink) => sink,
        }
    }
}

pub(super) fn choosing<'a>(
    sink: &'a mut dyn Sink,
    chosen: Option<&'a mut Chosen>,
) -> MaybeChoosing<'a> {
    match chosen {
        None => MaybeChoosing::Plain(sink),
        Some(taken) => MaybeChoosing::Choosing(Choosing { taken, sink }),
    }
}
