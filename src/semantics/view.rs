//! Left, right, before and behind as a viewer sees them: computed when asked, for one place to look from (SPEC R1).
//!
//! ```text
//!              behind
//!        left  anchor  right        the anchor turns its face to the viewer
//!             in front
//!                 ^
//!              viewer
//! ```

use crate::facts::Tuple;
use crate::units::{MapId, Point};

use super::feed::Cell;
use super::measure::{hundredths, level, surface_distance, tenths};
use super::relations::{RelationError, Relations, Rows};

/// One thing seen beside another.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Seen {
    /// `LEFT_FOR_VIEWER` and the like, by both names.
    pub relation: String,
    pub relation_en: String,
    pub thing: String,
    pub anchor: String,
}

impl Relations {
    /// How the things of the viewer's Area lie to each other for one who stands at a point of a Map.
    ///
    /// # Errors
    /// [`RelationError::Schema`] when the rule text changed the columns of `view`.
    pub fn seen_from(&self, map: MapId, viewer: Point) -> Result<Vec<Seen>, RelationError> {
        let measured = self.measurements();
        let Some(area) = measured.area_at(map, viewer) else { return Ok(Vec::new()) };
        let here = |id| self.area_of(id) == Some(area);
        let bodies: Vec<_> = measured.bodies.values().filter(|b| here(b.id)).collect();
        let program = self.rules().program();
        let mut rows = Rows { database: program.database(), fault: None };
        rows.insert("profile", &[Cell::Word(self.profile().name())]);
        for anchor in &bodies {
            // Whoever stands on the anchor sees it from no side.
            let Some(ahead) = (viewer - anchor.centre).try_normalize(1e-6) else { continue };
            for thing in bodies.iter().filter(|t| t.id != anchor.id) {
                let Some(level) = level(thing, anchor) else { continue };
                let Some(bearing) = anchor.bearing_from(ahead, thing.centre) else { continue };
                let (distance, _) = surface_distance(thing, anchor);
                let names = [thing, anchor].map(|b| self.symbols().replica(b.id));
                let numbers = [hundredths(bearing), tenths(distance), level];
                let cells = names.map(Cell::Name).into_iter().chain(numbers.map(Cell::Number));
                rows.insert("view", &cells.collect::<Vec<_>>());
            }
        }
        if let Some(fault) = rows.fault {
            return Err(RelationError::Schema { fault });
        }
        let derived = program.evaluate(&rows.database)?;
        let mut seen = Vec::new();
        for (id, info) in derived.relations() {
            let Some(name_en) = info.second_name.clone().filter(|n| n.ends_with("_FOR_VIEWER"))
            else {
                continue;
            };
            let text = |t: &Tuple<'_>, column| t.symbol(column).map(str::to_owned);
            seen.extend(derived.tuples(id).into_iter().flatten().filter_map(|t| {
                Some(Seen {
                    relation: info.name.clone(),
                    relation_en: name_en.clone(),
                    thing: text(&t, 0)?,
                    anchor: text(&t, 1)?,
                })
            }));
        }
        seen.sort_unstable();
        Ok(seen)
    }
}
