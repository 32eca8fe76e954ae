//! The robot takes the centre's map, if it has not changed its own meanwhile.

use std::path::Path;

use crate::error::{FleetError, Result};
use crate::handout::{Conflict, Handout, apart};
use crate::push::Line;
use crate::sheets::same;
use crate::store::shipping::unpack_rows;
use crate::store::{Change, Sheet, Store, StoreError};

/// What a pull came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Pulled {
    /// The centre has nothing newer.
    Nothing,
    /// Both have the same map already.
    Same { centre: i64 },
    /// The robot's map is now the centre's, by this revision of its own.
    Taken { centre: i64, revision: u64 },
    /// Both have changed it, and both are kept.
    Apart(Conflict),
}

impl Line {
    /// Takes the centre's newest map into a store, in one transaction, or tells what went apart.
    ///
    /// # Errors
    /// [`FleetError::Line`]; [`FleetError::Store`], where another program has the store open for one.
    pub fn pull(&self, store: &Path) -> Result<Pulled> {
        let (told, rows) = self.handout()?;
        let Some(rows) = rows else { return Ok(Pulled::Nothing) };
        let Handout { centre, agreed_robot, .. } = told;
        let mut new = Sheet::default();
        let unread = || FleetError::content("карта центра не читается");
        for (table, row) in unpack_rows(&rows).ok_or_else(unread)? {
            new.add(table, row)?;
        }
        let (mut store, _) = Store::open(store)?;
        let mine = store.reader().sheet()?;
        if same(&new, &mine) {
            self.agree(centre, store.revision())?;
            return Ok(Pulled::Same { centre });
        }
        let base = match u64::try_from(agreed_robot) {
            Ok(revision) if revision > 0 || mine.is_empty() => match store.reader_at(revision) {
                Ok(reader) => Some(reader.sheet()?),
                Err(StoreError::ForgottenRevision { .. } | StoreError::UnknownRevision { .. }) => {
                    None
                }
                Err(error) => return Err(error.into()),
            },
            _ => None,
        };
        if base.as_ref() == Some(&mine) {
            let reason = format!("центр, ревизия {centre}: {}", told.reason);
            let change = Change::new(told.author, crate::handout::now(), reason);
            let revision = store.import_sheet(&new, &change)?.revision;
            self.agree(centre, revision)?;
            return Ok(Pulled::Taken { centre, revision });
        }
        let things = apart(base.as_ref(), &mine, &new)?;
        let robot = i64::try_from(store.revision()).unwrap_or(i64::MAX);
        let conflict = Conflict { centre, robot, things };
        self.note_conflict(&conflict)?;
        Ok(Pulled::Apart(conflict))
    }
}
