//! What was measured, on its way into the database.

use std::collections::HashMap;

use foldhash::fast::RandomState;

use crate::facts::{Database, FactError, Known, Loader, Program, RelationId, Value};
use crate::feed::{Cell, Sink};

pub(super) fn tuple(cells: &[Cell<'_>]) -> Vec<Value> {
    cells.iter().map(|&c| c.into()).collect()
}

/// Keeps the first fault. A rule text may do without a measurement.
pub(super) fn note(kept: &mut Option<FactError>, fault: FactError) {
    if !matches!(fault, FactError::UnknownRelation { .. }) {
        kept.get_or_insert(fault);
    }
}

/// Rows on their way into the database, all at once. Names are looked up by where they stand, each but once.
pub(super) struct Load<'a> {
    program: &'a Program,
    loader: Loader<'a>,
    relations: HashMap<(*const u8, usize), Option<RelationId>, RandomState>,
    names: HashMap<*const u8, Known, RandomState>,
    row: Vec<Known>,
    fault: Option<FactError>,
}

impl<'a> Load<'a> {
    pub(super) fn new(program: &'a Program, database: &'a mut Database) -> Self {
        Self {
            program,
            loader: database.load(),
            relations: HashMap::default(),
            names: HashMap::default(),
            row: Vec::new(),
            fault: None,
        }
    }

    pub(super) fn finish(self) -> Result<(), FactError> {
        self.loader.finish();
        self.fault.map_or(Ok(()), Err)
    }
}

impl Sink for Load<'_> {
    fn row(&mut self, relation: &'static str, cells: &[Cell<'_>]) {
        // A rule text may do without a measurement.
        let known = self.relations.entry((relation.as_ptr(), relation.len()));
        let Some(relation) = *known.or_insert_with(|| self.program.relation(relation)) else {
            return;
        };
        self.row.clear();
        for cell in cells {
            self.row.push(match cell {
                // The Map's own symbols outlive the loading, so that a place stands for one name.
                Cell::Name(name) => {
                    *self.names.entry(name.as_ptr()).or_insert_with(|| self.loader.symbol(name))
                }
                Cell::Word(word) => self.loader.symbol(word),
                Cell::Number(number) => self.loader.number(*number),
            });
        }
        if let Err(fault) = self.loader.push(relation, &self.row) {
            self.fault.get_or_insert(fault);
        }
    }
}
