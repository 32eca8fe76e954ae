//! What others ask of relations often, looked up once: the Areas of things, what bears them, what they bear, what stands on
//! which floor.
//!
//! **Invariant**: after an update it is what looking up anew would give.

use std::collections::{BTreeMap, BTreeSet};

use crate::facts::Value;
use crate::openings::decide;
use crate::units::AreaId;

use super::Relations;

impl Relations {
    /// Brings what was looked up to the last update; openings of these names are `fresh`.
    pub(super) fn follow(&mut self, fresh: BTreeSet<String>) {
        let mut names = fresh;
        if let Some(joins) = self.rules.program().relation("JOINS") {
            let news = self.live.added(joins).chain(self.live.removed(joins));
            names.extend(news.filter_map(|tuple| Some(tuple.symbol(0)?.to_owned())));
        }
        if !names.is_empty() {
            self.decide_openings(Some(&names));
        }
        let program = self.rules.program();
        let find = |name: &str| program.relation(name);
        let symbols = &self.symbols;
        if let Some(contains) = find("CONTAINS") {
            for tuple in self.live.removed(contains) {
                let (Some(area), Some(id)) =
                    (symbols.area_of(tuple.symbol(0)), symbols.replica_of(tuple.symbol(1)))
                else {
                    continue;
                };
                self.areas.remove(&(id, area));
            }
            for tuple in self.live.added(contains) {
                self.areas.extend(
                    symbols.replica_of(tuple.symbol(1)).zip(symbols.area_of(tuple.symbol(0))),
                );
            }
        }
        if let Some(on_floor) = find("STANDS_ON_FLOOR") {
            let pair = |tuple: &crate::facts::Tuple<'_>| {
                symbols.area_of(tuple.symbol(1)).zip(symbols.replica_of(tuple.symbol(0)))
            };
            for gone in self.live.removed(on_floor).filter_map(|tuple| pair(&tuple)) {
                self.on_floor.remove(&gone);
            }
            self.on_floor.extend(self.live.added(on_floor).filter_map(|tuple| pair(&tuple)));
        }
        if let Some(rests_on) = find("RESTS_ON") {
            for tuple in self.live.removed(rests_on) {
                if let Some((load, support)) =
                    symbols.replica_of(tuple.symbol(0)).zip(symbols.replica_of(tuple.symbol(1)))
                {
                    self.supports.remove(&load);
                    self.loads.remove(&(support, load));
                }
            }
            for tuple in self.live.added(rests_on) {
                if let Some((load, support)) =
                    symbols.replica_of(tuple.symbol(0)).zip(symbols.replica_of(tuple.symbol(1)))
                {
                    self.supports.insert(load, support);
                    self.loads.insert((support, load));
                }
            }
        }
        if let Some(on_top) = find("ON_TOP_OF") {
            for tuple in self.live.removed(on_top) {
                if let Some((upper, lower)) =
                    symbols.replica_of(tuple.symbol(0)).zip(symbols.replica_of(tuple.symbol(1)))
                {
                    self.bearing.remove(&(lower, upper));
                }
            }
            for tuple in self.live.added(on_top) {
                self.bearing.extend(
                    symbols.replica_of(tuple.symbol(1)).zip(symbols.replica_of(tuple.symbol(0))),
                );
            }
        }
    }

    /// Tells the openings of these names, or all, which Areas the rules let them join.
    pub(super) fn decide_openings(&mut self, names: Option<&BTreeSet<String>>) {
        let mut joins: BTreeMap<String, BTreeSet<[AreaId; 2]>> = BTreeMap::new();
        let derived = self.derived();
        let of_name = |name: &String| {
            derived
                .tuples_with("JOINS", &[Value::Symbol(name.as_str().into())])
                .into_iter()
                .flatten()
        };
        let all = derived.tuples("JOINS").into_iter().flatten().filter(|_| names.is_none());
        for tuple in names.into_iter().flatten().flat_map(of_name).chain(all) {
            let areas = [1, 2].map(|column| self.symbols.area_of(tuple.symbol(column)));
            if let ([Some(a), Some(b)], Some(name)) = (areas, tuple.symbol(0)) {
                joins.entry(name.to_owned()).or_default().insert([a.min(b), a.max(b)]);
            }
        }
        decide(&mut self.openings, |name| names.is_none_or(|own| own.contains(name)), &joins);
    }

    /// Looks up once what others ask for often.
    pub(super) fn index(&mut self) {
        let symbols = &self.symbols;
        let pairs = |name: &'static str| self.derived().tuples(name).into_iter().flatten();
        let areas = pairs("CONTAINS").filter_map(|t| {
            Some((symbols.replica_of(t.symbol(1))?, symbols.area_of(t.symbol(0))?))
        });
        let supports = pairs("RESTS_ON").filter_map(|t| {
            Some((symbols.replica_of(t.symbol(0))?, symbols.replica_of(t.symbol(1))?))
        });
        let bearing = pairs("ON_TOP_OF").filter_map(|t| {
            Some((symbols.replica_of(t.symbol(1))?, symbols.replica_of(t.symbol(0))?))
        });
        let on_floor = pairs("STANDS_ON_FLOOR").filter_map(|t| {
            Some((symbols.area_of(t.symbol(1))?, symbols.replica_of(t.symbol(0))?))
        });
        let (areas, bearing) = (areas.collect(), bearing.collect());
        let (supports, on_floor): (BTreeMap<_, _>, _) = (supports.collect(), on_floor.collect());
        self.loads = supports.iter().map(|(load, support)| (*support, *load)).collect();
        (self.areas, self.supports, self.bearing) = (areas, supports, bearing);
        self.on_floor = on_floor;
    }
}
