//! Revisions that are made at the centre: from a map file, by an edit, or by taking a robot's map for its own.
//!
//! What bears a known name keeps its id; what is new takes one that neither the centre nor any robot of the building has ever
//! given, so that robots can take it. Of a map file the library's own store does that, in a folder that goes again.
//!
//! **Invariant**: a revision is checked as a whole, as a robot checks its own, or it is not made.

use std::convert::Infallible;
use std::path::{Path, PathBuf};

use deadpool_postgres::Transaction;
use tempfile::TempDir;

use crate::error::{FleetError, Result};
use crate::ingest::put_centre;
use crate::map::{self, EditReading, Format, MapErrors, NameIndex, Naming, NextIds, World};
use crate::rows::{place, quoted};
use crate::semantics::{RelationRules, derive, load};
use crate::sheets::{revision, sheet};
use crate::store::records::{LastIds, Revisions};
use crate::store::shipping::Written;
use crate::store::{
    Change, Changes, Edits, Record, Row, Sheet, Stamp, Store, Table, Version, next_ids, numbered,
};
use crate::units::{Bilingual, Fault as _, Language, OwnText, Source, said};

/// Steps and sections as in a map file, to be worked into the centre's map.
#[derive(Debug, Clone)]
pub struct Edit {
    pub building: i64,
    /// The revision that it was made on.
    pub on: i64,
    pub text: String,
    pub format: Format,
    /// Tried only: what would change is told, and nothing written.
    pub tries: bool,
}

/// What an edit did, or would do.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Revised {
    /// The centre's revision after it.
    pub revision: i64,
    /// In the words of a person.
    pub differences: Vec<String>,
    pub warnings: Vec<String>,
    /// What stood on a thing that was moved without its load, and so stayed.
    pub left_behind: Vec<String>,
}

/// Makes the centre's map of a building equal to a world from a map file, made on revision `on` where that is known. Returns
/// the revision, or the old one where nothing changed.
///
/// # Errors
/// [`FleetError::Moved`]: another was quicker. [`FleetError::Store`] where the world is ambiguous, [`FleetError::Database`].
pub async fn revise(
    transaction: &Transaction<'_>,
    building: i64,
    on: Option<i64>,
    world: &World,
    change: &Change,
) -> Result<i64> {
    let before = locked(transaction, building).await?;
    if on.is_some_and(|on| on != before) {
        return Err(FleetError::Moved { revision: before });
    }
    let desk = Desk::of(transaction, building, before).await?;
    let new = tokio::task::block_in_place(|| {
        let (mut store, _) = Store::open(&desk.dir)?;
        store.import(world, change)?;
        store.reader().sheet()
    })?;
    put(transaction, building, before, &desk.old, &new, change).await
}

/// Works an edit into the centre's map of a building.
///
/// # Errors
/// [`FleetError::Moved`]: another was quicker. [`FleetError::Content`]: the edit cannot be read, or makes no map.
pub async fn edit(transaction: &Transaction<'_>, edit: &Edit, change: &Change) -> Result<Revised> {
    let before = locked(transaction, edit.building).await?;
    if before != edit.on {
        return Err(FleetError::Moved { revision: before });
    }
    let old = sheet(transaction, edit.building, 0, before).await?;
    let ids = given_ids(transaction, edit.building).await?;
    let (mut revised, new) = tokio::task::block_in_place(|| work_in(&old, &ids, edit))?;
    revised.revision = before;
    if !edit.tries {
        revised.revision = put(transaction, edit.building, before, &old, &new, change).await?;
    }
    Ok(revised)
}

/// The sheet that an edit makes of another, and what is told of it.
fn work_in(old: &Sheet, ids: &[LastIds], edit: &Edit) -> Result<(Revised, Sheet)> {
    let before = old.world()?.unwrap_or_else(World::empty);
    let exact = NameIndex::of(&before);
    let naming = Naming { exact: &exact, in_other_words: &|_| Vec::new() };
    let source = Source::own(OwnText::Edit, &edit.text);
    let EditReading { world, faults: mut found, carriers, .. } = map::edit(
        &before,
        &map::Edits::read(&source, edit.format),
        &free_ids(&before, ids),
        naming,
    );
    let wrong = |found: &MapErrors| FleetError::content(all_faults(found));
    let mut after = world.ok_or_else(|| wrong(&found))?;
    let mut left_behind = Vec::new();
    if before.replicas != after.replicas {
        let relations = derive(&before, &RelationRules::standard(), before.domain.profile)
            .map_err(|error| FleetError::content(Bilingual::of(&error)))?;
        let stayed = load::carry(&before, &relations, &carriers, &mut after);
        let names = stayed.iter().filter_map(|id| before.replicas.get(id));
        left_behind.extend(names.map(|thing| thing.name.clone()));
        // Loads that went along may strike something where they are now.
        let news = map::news(&before, &after, || NameIndex::of(&before));
        found = MapErrors { source: None, faults: news };
        if found.has_errors() {
            return Err(wrong(&found));
        }
    }
    let differences = Changes::between(&before, &after)?.told();
    let revised = Revised {
        revision: 0,
        differences: differences.iter().map(|d| d.say(Language::Russian)).collect(),
        warnings: faults(&found),
        left_behind,
    };
    Ok((revised, Sheet::of(&after)?))
}

/// The ids for new records: none is ever given twice in a building.
fn free_ids(world: &World, given: &[LastIds]) -> NextIds {
    let Ok(ids) = next_ids(world, |table| {
        let last = given.iter().find(|last| last.kind == table.name()).map(|last| last.last_id);
        Ok::<_, Infallible>(last.unwrap_or(0).saturating_add(1))
    });
    ids
}

/// All faults of a map, a line each.
fn faults(all: &MapErrors) -> Vec<String> {
    all.faults.iter().map(|fault| fault.error.to_string()).collect()
}

/// A line for each.
pub(crate) fn all_faults(all: &MapErrors) -> Bilingual {
    let lines = |language| all.faults.iter().map(move |fault| fault.error.tell(language));
    Bilingual::both(|language| lines(language).collect::<Vec<_>>().join("\n"))
}

/// Makes the centre's map of a building equal to a robot's, as it is here, and notes that the two agree.
///
/// # Errors
/// [`FleetError::Unknown`], [`FleetError::Database`].
pub async fn adopt(
    transaction: &Transaction<'_>,
    building: i64,
    robot: i64,
    change: &Change,
) -> Result<i64> {
    let before = locked(transaction, building).await?;
    let theirs = revision(transaction, building, robot).await?;
    let map = sheet(transaction, building, robot, theirs).await?;
    let old = sheet(transaction, building, 0, before).await?;
    let centre = put(transaction, building, before, &old, &map, change).await?;
    let sql = "UPDATE fleet.robot SET agreed_centre = $3, agreed_robot = $4 WHERE building = $1 AND robot = $2";
    transaction.execute(sql, &[&building, &robot, &centre, &theirs]).await?;
    let sql = "UPDATE fleet.conflict SET settled = now() WHERE building = $1 AND robot = $2 AND settled IS NULL";
    transaction.execute(sql, &[&building, &robot]).await?;
    Ok(centre)
}

/// Settles a conflict for the centre's map: the robot takes the newest one the next time, whatever it changed until now.
///
/// # Errors
/// [`FleetError::Unknown`], [`FleetError::Database`].
pub async fn insist(transaction: &Transaction<'_>, building: i64, robot: i64) -> Result<()> {
    let theirs = revision(transaction, building, robot).await?;
    let sql = "UPDATE fleet.robot SET agreed_robot = $3, agreed_centre = 0 WHERE building = $1 AND robot = $2";
    transaction.execute(sql, &[&building, &robot, &theirs]).await?;
    Ok(())
}

/// The centre's revision of a building, which nobody else moves until the transaction ends.
async fn locked(transaction: &Transaction<'_>, building: i64) -> Result<i64> {
    let lock = "SELECT revision FROM fleet.robot WHERE building = $1 AND robot = 0 FOR UPDATE";
    let row = transaction.query_opt(lock, &[&building]).await?;
    Ok(row.ok_or_else(|| FleetError::unknown(said!("building-numbered", building)))?.get(0))
}

/// A store in a folder that goes again, with the centre's map in it.
struct Desk {
    old: Sheet,
    dir: PathBuf,
    _folder: TempDir,
}

impl Desk {
    async fn of(transaction: &Transaction<'_>, building: i64, revision: i64) -> Result<Self> {
        let old = sheet(transaction, building, 0, revision).await?;
        let ids = given_ids(transaction, building).await?;
        let failed = |source| FleetError::Io { path: "TMPDIR".to_owned(), source };
        let folder = tempfile::tempdir().map_err(failed)?;
        let dir = folder.path().join("store");
        tokio::task::block_in_place(|| fill(&dir, &old, &ids))?;
        Ok(Self { old, dir, _folder: folder })
    }
}

fn fill(dir: &Path, old: &Sheet, ids: &[LastIds]) -> Result<()> {
    let change = Change::new("", crate::handout::now(), "");
    let (mut store, _) = Store::open(dir)?;
    if !old.is_empty() {
        store.import_sheet(old, &change)?;
    }
    let given = ids.iter().fold(Edits::new(), |edits, id| edits.put(id));
    store.apply(&given, &change)?;
    Ok(())
}

/// The highest id of each table that the centre or a robot of the building has ever given.
async fn given_ids(transaction: &Transaction<'_>, building: i64) -> Result<Vec<LastIds>> {
    let highest = numbered().map(|(table, id)| {
        let (name, from, id) = (table.name(), place(table), quoted(id));
        format!("SELECT '{name}', max({id}) FROM {from} WHERE building = $1")
    });
    let sql = highest.collect::<Vec<_>>().join(" UNION ALL ");
    let rows = transaction.query(&sql, &[&building]).await?;
    let id = |row: &tokio_postgres::Row| {
        let last = row.get::<_, Option<i64>>(1).and_then(|id| u32::try_from(id).ok());
        last.map(|last_id| LastIds { kind: row.get::<_, &str>(0).into(), last_id })
    };
    Ok(rows.iter().filter_map(id).collect())
}

async fn put(
    transaction: &Transaction<'_>,
    building: i64,
    before: i64,
    old: &Sheet,
    new: &Sheet,
    change: &Change,
) -> Result<i64> {
    if new.world()?.is_none() {
        return Err(FleetError::content(said!("map-has-no-domain")));
    }
    let written = changes(old, new, before + 1, change);
    if written.is_empty() {
        return Ok(before);
    }
    put_centre(transaction, building, before + 1, written).await?;
    Ok(before + 1)
}

/// What turns one sheet into another, as versions of a revision, with the entry in the list of revisions.
fn changes(old: &Sheet, new: &Sheet, number: i64, change: &Change) -> Vec<Written> {
    let revision = number.unsigned_abs();
    let version = |row: &Row, deleted: bool| Version {
        stamp: Stamp { revision, at: change.at, user: change.user.clone(), deleted },
        row: row.clone(),
    };
    let mut written = Vec::new();
    let mut counts = [0_u32; 3];
    for (table, key, row) in new.iter() {
        let before = old.get(table, key);
        if before != Some(row) {
            counts[usize::from(before.is_some())] += 1;
            written.push(Written { table, version: version(row, false), replaces: Some(0) });
        }
    }
    for (table, key, row) in old.iter() {
        if new.get(table, key).is_none() {
            counts[2] += 1;
            written.push(Written { table, version: version(row, true), replaces: Some(0) });
        }
    }
    if !written.is_empty() {
        let [created, changed, deleted] = counts;
        let entry = Revisions {
            revision: u32::try_from(number).unwrap_or(u32::MAX),
            kind: "edit".to_owned(),
            reason: change.reason.clone(),
            undoes: None,
            created,
            changed,
            deleted,
        };
        let row = entry.to_row();
        written.push(Written {
            table: Table::Revisions,
            version: version(&row, false),
            replaces: None,
        });
    }
    written
}
