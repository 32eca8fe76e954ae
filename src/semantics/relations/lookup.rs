//! What others ask of relations often, looked up once: the Areas of things, what bears them, what they bear.
//!
//! **Invariant**: after an update it is what looking up anew would give.

use crate::map::Entity;
use crate::semantics::names::Subject;

use super::Relations;

impl Relations {
    /// Brings what was looked up to the last update.
    pub(super) fn follow(&mut self) {
        let program = self.rules.program();
        let find = |name: &str| program.relation(name);
        let symbols = &self.symbols;
        let replica = |symbol: Option<&str>| match symbols.subject(symbol?)? {
            Subject::Entity(Entity::Replica(id)) => Some(id),
            _ => None,
        };
        let area = |symbol: Option<&str>| match symbols.subject(symbol?)? {
            Subject::Entity(Entity::Area(id)) => Some(id),
            _ => None,
        };
        if let Some(contains) = find("CONTAINS") {
            for tuple in self.live.removed(contains) {
                let (Some(area), Some(id)) = (area(tuple.symbol(0)), replica(tuple.symbol(1)))
                else {
                    continue;
                };
                self.areas.remove(&(id, area));
            }
            for tuple in self.live.added(contains) {
                self.areas.extend(replica(tuple.symbol(1)).zip(area(tuple.symbol(0))));
            }
        }
        if let Some(rests_on) = find("RESTS_ON") {
            for tuple in self.live.removed(rests_on) {
                replica(tuple.symbol(0)).map(|id| self.supports.remove(&id));
            }
            for tuple in self.live.added(rests_on) {
                self.supports.extend(replica(tuple.symbol(0)).zip(replica(tuple.symbol(1))));
            }
        }
        if let Some(on_top) = find("ON_TOP_OF") {
            for tuple in self.live.removed(on_top) {
                if let Some((upper, lower)) = replica(tuple.symbol(0)).zip(replica(tuple.symbol(1)))
                {
                    self.bearing.remove(&(lower, upper));
                }
            }
            for tuple in self.live.added(on_top) {
                self.bearing.extend(replica(tuple.symbol(1)).zip(replica(tuple.symbol(0))));
            }
        }
    }

    /// Looks up once what others ask for often.
    pub(super) fn index(&mut self) {
        let replica = |symbol: Option<&str>| match self.symbols.subject(symbol?)? {
            Subject::Entity(Entity::Replica(id)) => Some(id),
            _ => None,
        };
        let area = |symbol: Option<&str>| match self.symbols.subject(symbol?)? {
            Subject::Entity(Entity::Area(id)) => Some(id),
            _ => None,
        };
        let pairs = |name: &'static str| self.derived().tuples(name).into_iter().flatten();
        let areas =
            pairs("CONTAINS").filter_map(|t| Some((replica(t.symbol(1))?, area(t.symbol(0))?)));
        let supports =
            pairs("RESTS_ON").filter_map(|t| Some((replica(t.symbol(0))?, replica(t.symbol(1))?)));
        let bearing =
            pairs("ON_TOP_OF").filter_map(|t| Some((replica(t.symbol(1))?, replica(t.symbol(0))?)));
        let (areas, supports, bearing) = (areas.collect(), supports.collect(), bearing.collect());
        (self.areas, self.supports, self.bearing) = (areas, supports, bearing);
    }
}
