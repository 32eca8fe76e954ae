//! The robot takes the centre's map, if it has not changed its own meanwhile.
//!
//! Where another program holds the store, the map is compared as the store can be read beside it, and brought to that
//! program (see `holder`), which takes it only on the revision that it was compared with.

use std::path::Path;

use crate::error::{FleetError, Result};
use crate::handout::{Conflict, Handout, apart};
use crate::holder::Holder;
use crate::push::Line;
use crate::sheets::same;
use crate::store::shipping::unpack_rows;
use crate::store::{Change, Sheet, Store, StoreError};
use crate::units::{Bilingual, Language, said, told};

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

impl Pulled {
    /// What came of it, in a line, or in some where the maps went apart.
    #[must_use]
    pub fn in_words(&self, language: Language) -> String {
        match self {
            Self::Nothing => told!(language, "nothing-new"),
            Self::Same { centre } => told!(language, "same-map", centre),
            Self::Taken { centre, revision } => told!(language, "map-taken", centre, revision),
            Self::Apart(conflict) => {
                let head = told!(language, "maps-apart", centre = conflict.centre);
                let sides = [told!(language, "at-the-centre"), told!(language, "at-the-robot")];
                conflict.things.iter().fold(head, |mut told, apart| {
                    told += &format!("\n{}", apart.thing);
                    for (side, what) in sides.iter().zip([&apart.centre, &apart.robot]) {
                        if !what.is_empty() {
                            told += &format!("\n     {side}: {what}");
                        }
                    }
                    told
                })
            }
        }
    }
}

impl Line {
    /// Takes the centre's newest map into a store, in one transaction, or tells what went apart.
    ///
    /// # Errors
    /// [`FleetError::Line`]; [`FleetError::Held`], where another program has the store open and does not take the map now.
    pub fn pull(&self, store: &Path) -> Result<Pulled> {
        let (told, rows) = self.handout()?;
        let Some(rows) = rows else { return Ok(Pulled::Nothing) };
        let Handout { centre, agreed_robot, .. } = told;
        let mut new = Sheet::default();
        let unread = || FleetError::content(said!("centre-map-unreadable"));
        for (table, row) in unpack_rows(&rows).ok_or_else(unread)? {
            new.add(table, row)?;
        }
        let (mut store, holder) = opened(store)?;
        let mine = store.reader().sheet()?;
        if same(&new, &mine) {
            self.agree(centre, store.revision())?;
            return Ok(Pulled::Same { centre });
        }
        let base = base(&store, agreed_robot, mine.is_empty())?;
        if base.as_ref() == Some(&mine) {
            let reason =
                told!(Language::Russian, "taken-from-centre", centre, reason = told.reason);
            let change = Change::new(told.author, crate::handout::now(), reason);
            let revision = match holder {
                Some(holder) => holder.take(store.revision(), &rows, &change)?,
                None => store.import_sheet(&new, &change)?.revision,
            };
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

/// The store, and who is to write it where that is not this program.
fn opened(dir: &Path) -> Result<(Store, Option<Holder>)> {
    match Store::open(dir) {
        Ok((store, _)) => Ok((store, None)),
        Err(locked @ StoreError::Locked { .. }) => {
            let holder =
                Holder::of(dir).ok_or_else(|| FleetError::Held { why: Bilingual::of(&locked) })?;
            Ok((Store::open_read_only(dir)?.0, Some(holder)))
        }
        Err(error) => Err(error.into()),
    }
}

/// The map as it was when both sides last agreed; none where that is not known any more.
fn base(store: &Store, agreed: i64, is_empty: bool) -> Result<Option<Sheet>> {
    let revision = match u64::try_from(agreed) {
        Ok(revision) if revision > 0 || is_empty => revision,
        _ => return Ok(None),
    };
    match store.reader_at(revision) {
        Ok(reader) => Ok(Some(reader.sheet()?)),
        Err(StoreError::ForgottenRevision { .. } | StoreError::UnknownRevision { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}
