//! A robot's frames taken in: kept byte by byte, and their records put in place, in one transaction.
//!
//! The robot's row is locked first, so frames of one robot come one after the other, whoever brings them. Frames that are
//! here already are passed over if they are the same, a gap is asked for again, and a frame with a known number and other
//! bytes tells of another past: then the robot sends the whole of its store, which takes the place of what was here.
//!
//! Rows go as one array a column, unnested side by side in the list of what is selected: there the server goes through them
//! in step, while in `FROM` it would first lay each of them out as a table.
//!
//! **Invariant**: after each transaction the tables hold what the robot's store held after the frame `fleet.robot.sequence`.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use deadpool_postgres::{Object, Transaction};
use futures_util::future::try_join_all;
use tokio_postgres::error::SqlState;
use tokio_postgres::types::ToSql;

use crate::db::{Who, enter};
use crate::error::{FleetError, Result};
use crate::rows::{At, Values, kind, place, quoted};
use crate::store::shipping::{Frame, Whole, Written};
use crate::store::{Cell, Column, Key, Kind, Row, Table};
use crate::units::said;

/// How far a robot's journal is here.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub struct Position {
    pub sequence: i64,
    /// Of the frame of that number; none where it is not known.
    pub checksum: Option<u32>,
}

/// A robot as its row was locked.
#[derive(Debug, Clone, Copy)]
struct Robot {
    building: i64,
    robot: i64,
    at: Position,
    epoch: i64,
    forgot: bool,
    revision: i64,
    /// What is put in place is the whole of its store.
    is_whole: bool,
}

/// Where a robot's journal stands here. That it asks is a sign of life, which is noted once a minute.
///
/// # Errors
/// [`FleetError::Key`], [`FleetError::Forbidden`], [`FleetError::Database`].
pub async fn position(client: &mut Object, key: &str) -> Result<Position> {
    let transaction = client.transaction().await?;
    let robot = robot_of(&transaction, key, "").await?;
    let sql = "UPDATE fleet.robot SET reported = now() WHERE building = $1 AND robot = $2 \
               AND (reported IS NULL OR reported < now() - interval '1 minute')";
    let statement = transaction.prepare_cached(sql).await?;
    transaction.execute(&statement, &[&robot.building, &robot.robot]).await?;
    transaction.commit().await?;
    Ok(robot.at)
}

async fn robot_of(transaction: &Transaction<'_>, key: &str, lock: &str) -> Result<Robot> {
    let Who::Robot { building, robot } = enter(transaction, key).await? else {
        return Err(FleetError::Forbidden);
    };
    let sql = format!(
        "SELECT sequence, checksum, epoch, forgot, revision FROM fleet.robot \
         WHERE building = $1 AND robot = $2 {lock}"
    );
    let statement = transaction.prepare_cached(&sql).await?;
    let row = transaction.query_opt(&statement, &[&building, &robot]).await?;
    let row = row.ok_or(FleetError::Key)?;
    let checksum: Option<i64> = row.get(1);
    Ok(Robot {
        building,
        robot,
        at: Position {
            sequence: row.get(0),
            checksum: checksum.and_then(|c| u32::try_from(c).ok()),
        },
        epoch: row.get(2),
        forgot: row.get(3),
        revision: row.get(4),
        is_whole: false,
    })
}

/// Takes frames in, whatever their order, and tells how far the journal is here then.
///
/// # Errors
/// [`FleetError::Gap`], [`FleetError::Diverged`], [`FleetError::Store`] for a frame that holds no records;
/// [`FleetError::Key`], [`FleetError::Forbidden`], [`FleetError::Database`]. Nothing is taken then.
pub async fn take_frames(
    client: &mut Object,
    key: &str,
    mut frames: Vec<Frame>,
) -> Result<Position> {
    frames.sort_by_key(|frame| frame.sequence);
    frames.dedup();
    let transaction = client.transaction().await?;
    let mut robot = robot_of(&transaction, key, "FOR UPDATE").await?;
    let have = robot.at.sequence.unsigned_abs();
    let (known, new): (Vec<_>, Vec<_>) = frames.into_iter().partition(|f| f.sequence <= have);
    check_known(&transaction, &robot, &known).await?;
    for (expected, frame) in (have + 1..).zip(&new) {
        if frame.sequence < expected {
            return Err(FleetError::Diverged { sequence: frame.sequence });
        }
        if frame.sequence > expected {
            let (have, checksum) = (robot.at.sequence, robot.at.checksum);
            return Err(FleetError::Gap { have, checksum, came: frame.sequence });
        }
    }
    let Some(last) = new.last() else {
        transaction.commit().await?;
        return Ok(robot.at);
    };
    robot.at = Position { sequence: number(last.sequence)?, checksum: Some(last.checksum) };
    // What they hold is read, and sent after them, while the server keeps them.
    let new = std::sync::Arc::new(new);
    let reading = tokio::task::spawn_blocking({
        let new = std::sync::Arc::clone(&new);
        move || records_of(&new)
    });
    let before = robot;
    let putting = async {
        let read = reading.await;
        let written = read.map_err(|error| FleetError::content(error.to_string()))??;
        put_records(&transaction, &mut robot, written).await
    };
    tokio::try_join!(keep_frames(&transaction, &before, &new), putting)?;
    note_robot(&transaction, &robot).await?;
    transaction.commit().await?;
    Ok(robot.at)
}

/// Takes the whole of a store in the place of all that was here of it. Frames of before are kept under the epoch before.
///
/// # Errors
/// As [`take_frames`].
pub async fn take_whole(client: &mut Object, key: &str, whole: Whole) -> Result<Position> {
    let transaction = client.transaction().await?;
    let mut robot = robot_of(&transaction, key, "FOR UPDATE").await?;
    let pieces = whole.pieces;
    let reading = tokio::task::spawn_blocking(move || records_of(&pieces));
    let written = reading.await.map_err(|error| FleetError::content(error.to_string()))??;
    for table in Table::ALL.iter().copied().filter(|table| table.is_stored()) {
        let sql = format!("DELETE FROM {} WHERE building = $1 AND robot = $2", place(table));
        transaction.execute(&sql, &[&robot.building, &robot.robot]).await?;
    }
    let sql = "DELETE FROM fleet.proposed WHERE building = $1 AND robot = $2";
    transaction.execute(sql, &[&robot.building, &robot.robot]).await?;
    robot.epoch += 1;
    robot.is_whole = true;
    robot.revision = 0;
    robot.at = Position { sequence: number(whole.sequence)?, checksum: whole.checksum };
    put_records(&transaction, &mut robot, written).await?;
    note_robot(&transaction, &robot).await?;
    transaction.commit().await?;
    Ok(robot.at)
}

/// What frames wrote, in their order.
fn records_of(frames: &[Frame]) -> Result<Vec<Written>> {
    let mut written = Vec::new();
    for frame in frames {
        written.extend(frame.written()?);
    }
    Ok(written)
}

fn number(n: u64) -> Result<i64> {
    i64::try_from(n).map_err(|_too_large| FleetError::content(said!("number-too-large", n)))
}

async fn check_known(transaction: &Transaction<'_>, robot: &Robot, known: &[Frame]) -> Result<()> {
    let (Some(first), Some(last)) = (known.first(), known.last()) else { return Ok(()) };
    let sql = "SELECT sequence, checksum FROM fleet.frame WHERE building = $1 AND robot = $2 \
               AND epoch = $3 AND sequence BETWEEN $4 AND $5";
    let statement = transaction.prepare_cached(sql).await?;
    let (from, to) = (number(first.sequence)?, number(last.sequence)?);
    let rows = transaction
        .query(&statement, &[&robot.building, &robot.robot, &robot.epoch, &from, &to])
        .await?;
    let here: HashMap<i64, i64> = rows.iter().map(|row| (row.get(0), row.get(1))).collect();
    for frame in known {
        // What came with the whole has no frame here, and nothing to be compared with.
        let is_other = here
            .get(&number(frame.sequence)?)
            .is_some_and(|checksum| *checksum != i64::from(frame.checksum));
        if is_other {
            return Err(FleetError::Diverged { sequence: frame.sequence });
        }
    }
    Ok(())
}

/// So many bytes of frames go to the server at a time: it keeps them while the next come.
const PIECE: usize = 256 << 10;

async fn keep_frames(transaction: &Transaction<'_>, robot: &Robot, frames: &[Frame]) -> Result<()> {
    let mut pieces = Vec::new();
    let mut rest = frames;
    while !rest.is_empty() {
        let mut size = 0;
        let is_full = |frame: &Frame| {
            size += frame.bytes.len();
            size > PIECE
        };
        let count = rest.iter().position(is_full).unwrap_or(rest.len()).max(1);
        let (piece, after) = rest.split_at(count);
        pieces.push(keep_piece(transaction, robot, piece));
        rest = after;
    }
    try_join_all(pieces).await?;
    Ok(())
}

async fn keep_piece(transaction: &Transaction<'_>, robot: &Robot, frames: &[Frame]) -> Result<()> {
    let sequences = frames.iter().map(|f| number(f.sequence)).collect::<Result<Vec<_>>>()?;
    let checksums: Vec<i64> = frames.iter().map(|f| i64::from(f.checksum)).collect();
    let bytes: Vec<&[u8]> = frames.iter().map(|f| &f.bytes[..]).collect();
    let sql = "INSERT INTO fleet.frame (building, robot, epoch, sequence, checksum, bytes) \
               SELECT $1, $2, $3, unnest($4::bigint[]), unnest($5::bigint[]), unnest($6::bytea[])";
    let statement = transaction.prepare_cached(sql).await?;
    let Robot { building, robot, epoch, .. } = robot;
    transaction
        .execute(&statement, &[building, robot, epoch, &sequences, &checksums, &bytes])
        .await?;
    Ok(())
}

async fn note_robot(transaction: &Transaction<'_>, robot: &Robot) -> Result<()> {
    let sql = "UPDATE fleet.robot SET sequence = $3, checksum = $4, epoch = $5, forgot = $6, \
               revision = $7, reported = now() WHERE building = $1 AND robot = $2";
    let statement = transaction.prepare_cached(sql).await?;
    let checksum = robot.at.checksum.map(i64::from);
    let Robot { building, robot: no, epoch, forgot, revision, .. } = robot;
    transaction
        .execute(
            &statement,
            &[building, no, &robot.at.sequence, &checksum, epoch, forgot, revision],
        )
        .await?;
    Ok(())
}

/// Under this name of `LastIds` a store notes that it has forgotten some of its past.
const FORGOTTEN: &str = "~forgotten";

/// Puts records in place, in the order in which they were written.
async fn put_records(
    transaction: &Transaction<'_>,
    robot: &mut Robot,
    written: Vec<Written>,
) -> Result<()> {
    let before = robot.revision;
    let mut tables = BTreeMap::<Table, Vec<Written>>::new();
    for record in written {
        match (record.table, record.version.row.first()) {
            (Table::LastIds, Some(Cell::Text(kind))) if kind == FORGOTTEN => robot.forgot = true,
            (Table::Revisions, Some(Cell::Int(n))) => robot.revision = robot.revision.max(*n),
            _ => {}
        }
        tables.entry(record.table).or_default().push(record);
    }
    let now: &Robot = robot;
    let many = |table: &Table| tables.get(table).filter(|records| records.len() >= MANY);
    let mut added = Vec::new();
    for table in ADDED_TO {
        if let Some(records) = many(&table)
            && add_notes(transaction, now, table, records).await?
        {
            added.push(table);
        }
    }
    // Of one table after the other; of all tables at once, without waiting for the answers.
    let left = tables.iter().filter(|(table, _)| !added.contains(*table));
    let tables_put = left.map(|(table, records)| async move {
        if table.is_map() {
            put_versions(transaction, now, *table, records).await
        } else {
            put_notes(transaction, now, *table, records).await
        }
    });
    try_join_all(tables_put).await?;
    let touched: BTreeSet<i64> = [Table::Beliefs, Table::AreaObjects]
        .into_iter()
        .filter_map(|table| tables.get(&table).map(|records| (table, records)))
        .flat_map(|(table, records)| replicas(table, records))
        .collect();
    // The centre believes nothing of its own.
    if !touched.is_empty() && robot.robot > 0 {
        note_proposals(transaction, robot, touched).await?;
    }
    if let Some(tasks) = tables.get(&Table::Tasks) {
        note_missions(transaction, robot, tasks).await?;
    }
    if robot.revision > before {
        // Of a store that came whole what follows from its older revisions is not asked for.
        let (first, anew) =
            if robot.is_whole { (robot.revision, true) } else { (before + 1, false) };
        let sql = "INSERT INTO fleet.work (building, robot, revision, anew) \
                   SELECT $1, $2, n, $5 FROM generate_series($3::bigint, $4::bigint) AS n ON CONFLICT DO NOTHING";
        let statement = transaction.prepare_cached(sql).await?;
        let Robot { building, robot: no, revision, .. } = robot;
        transaction.execute(&statement, &[building, no, &first, revision, &anew]).await?;
    }
    Ok(())
}

/// Versions of the centre's own map: what turns one revision into the next, under robot 0.
///
/// # Errors
/// [`FleetError::Database`].
pub(crate) async fn put_centre(
    transaction: &Transaction<'_>,
    building: i64,
    revision: i64,
    written: Vec<Written>,
) -> Result<()> {
    let at = Position::default();
    let mut centre = Robot {
        building,
        robot: 0,
        at,
        epoch: 0,
        forgot: true,
        revision: revision - 1,
        is_whole: false,
    };
    put_records(transaction, &mut centre, written).await?;
    let sql =
        "UPDATE fleet.robot SET revision = $2, reported = now() WHERE building = $1 AND robot = 0";
    transaction.execute(sql, &[&building, &centre.revision]).await?;
    Ok(())
}

fn key_columns(table: Table) -> impl Iterator<Item = (usize, &'static Column)> {
    table.columns().iter().enumerate().filter(|(_, column)| column.is_key)
}

/// The key of a row.
fn key_of(table: Table, row: &Row) -> Key {
    key_columns(table).fold(Key::new(), |key, (at, column)| match (&row[at], column.kind) {
        (Cell::Int(n), Kind::Id) => key.id(u32::try_from(*n).unwrap_or(u32::MAX)),
        (Cell::Int(n), _) => key.int(*n),
        (Cell::Text(text), _) => key.text(text),
        // No key column is empty or a measure.
        (Cell::Null | Cell::Real(_), _) => key,
    })
}

fn names(table: Table) -> Vec<String> {
    table.columns().iter().map(|column| quoted(column.name)).collect()
}

/// The part of an insert that is the same for map and notes: columns, what is selected for them, and the next parameter.
struct Insert {
    columns: String,
    chosen: String,
    next: usize,
}

/// A parameter's elements, one a row.
fn each(parameter: usize, kind: &str) -> String {
    format!("unnest(${parameter}::{kind}[])")
}

fn insert(table: Table) -> Insert {
    let names = names(table);
    let kinds = table.columns().iter().map(kind);
    let kinds = kinds.chain(["timestamptz", "text", "boolean", "bigint"]);
    let chosen: Vec<String> = (3..).zip(kinds).map(|(n, kind)| each(n, kind)).collect();
    Insert {
        columns: format!(
            "building, robot, {}, \"RecDate\", \"RecUser\", \"Deleted\", revision",
            names.join(", ")
        ),
        next: 3 + chosen.len(),
        chosen: format!("$1, $2, {}", chosen.join(", ")),
    }
}

/// What every version bears, as columns.
struct Stamps {
    at: Vec<At>,
    user: Vec<String>,
    deleted: Vec<bool>,
    revision: Vec<i64>,
}

impl Stamps {
    fn of(records: &[&Written]) -> Self {
        let stamps = || records.iter().map(|w| &w.version.stamp);
        Self {
            at: stamps().map(|s| At(s.at.0)).collect(),
            user: stamps().map(|s| s.user.replace('\0', "\u{2400}")).collect(),
            deleted: stamps().map(|s| s.deleted).collect(),
            revision: stamps().map(|s| i64::try_from(s.revision).unwrap_or(i64::MAX)).collect(),
        }
    }
}

fn values(table: Table, records: &[&Written]) -> Vec<Values> {
    let rows = || records.iter().map(|w| &w.version.row);
    table.columns().iter().enumerate().map(|(at, c)| Values::of(c, at, rows())).collect()
}

/// Versions of records of the map: each ends the one before it.
async fn put_versions(
    transaction: &Transaction<'_>,
    robot: &Robot,
    table: Table,
    records: &[Written],
) -> Result<()> {
    let all: Vec<&Written> = records.iter().collect();
    // When the next version of the same record is in this very batch, it ends here.
    let mut next = HashMap::<Key, usize>::new();
    let mut ends = vec![None; all.len()];
    let mut first = Vec::new();
    for (at, record) in all.iter().enumerate().rev() {
        let key = key_of(table, &record.version.row);
        ends[at] = next.insert(key, at);
    }
    first.extend(next.into_values().filter(|at| robot.forgot || all[*at].replaces.is_some()));
    if !first.is_empty() {
        end_versions(transaction, robot, table, first.iter().map(|at| all[*at]).collect()).await?;
    }
    let Insert { columns, chosen, next } = insert(table);
    let sql = format!(
        "INSERT INTO {} ({columns}, revision_to, valid_to) SELECT {chosen}, {}, {}",
        place(table),
        each(next, "bigint"),
        each(next + 1, "timestamptz")
    );
    let statement = transaction.prepare_cached(&sql).await?;
    let (cells, stamps) = (values(table, &all), Stamps::of(&all));
    let revision_to: Vec<Option<i64>> =
        ends.iter().map(|e| e.map(|at| stamps.revision[at])).collect();
    let valid_to: Vec<Option<At>> = ends.iter().map(|e| e.map(|at| stamps.at[at])).collect();
    let mut parameters = inserted(robot, &cells, &stamps);
    parameters.extend([&revision_to as &(dyn ToSql + Sync), &valid_to]);
    transaction.execute(&statement, &parameters).await?;
    Ok(())
}

/// The parameters of [`insert`], in its order.
fn inserted<'a>(
    robot: &'a Robot,
    cells: &'a [Values],
    stamps: &'a Stamps,
) -> Vec<&'a (dyn ToSql + Sync)> {
    let mut parameters: Vec<&(dyn ToSql + Sync)> = vec![&robot.building, &robot.robot];
    parameters.extend(cells.iter().map(Values::as_parameter));
    parameters.extend([
        &stamps.at as &(dyn ToSql + Sync),
        &stamps.user,
        &stamps.deleted,
        &stamps.revision,
    ]);
    parameters
}

async fn end_versions(
    transaction: &Transaction<'_>,
    robot: &Robot,
    table: Table,
    by: Vec<&Written>,
) -> Result<()> {
    let keys: Vec<_> = key_columns(table).collect();
    let aliases: Vec<String> = (0..keys.len()).map(|n| format!("k{n}")).collect();
    let arrays: Vec<String> = (3..)
        .zip(&keys)
        .zip(&aliases)
        .map(|((n, (_, column)), alias)| format!("{} AS {alias}", each(n, kind(column))))
        .collect();
    let same: Vec<String> = aliases
        .iter()
        .zip(&keys)
        .map(|(alias, (_, column))| format!("t.{} = u.{alias}", quoted(column.name)))
        .collect();
    let next = 3 + keys.len();
    let sql = format!(
        "UPDATE {} t SET revision_to = u.by, valid_to = u.at \
         FROM (SELECT {}, {} AS by, {} AS at) AS u \
         WHERE t.building = $1 AND t.robot = $2 AND {} AND t.revision_to IS NULL",
        place(table),
        arrays.join(", "),
        each(next, "bigint"),
        each(next + 1, "timestamptz"),
        same.join(" AND ")
    );
    let statement = transaction.prepare_cached(&sql).await?;
    let rows = || by.iter().map(|w| &w.version.row);
    let cells: Vec<Values> = keys.iter().map(|(at, c)| Values::of(c, *at, rows())).collect();
    let stamps = Stamps::of(&by);
    let mut parameters: Vec<&(dyn ToSql + Sync)> = vec![&robot.building, &robot.robot];
    parameters.extend(cells.iter().map(Values::as_parameter));
    parameters.extend([&stamps.revision as &(dyn ToSql + Sync), &stamps.at]);
    transaction.execute(&statement, &parameters).await?;
    Ok(())
}

/// Tables whose records are added and never written again, as far as a store of today goes.
const ADDED_TO: [Table; 2] = [Table::Observations, Table::Revisions];

/// So many records of a table are worth a savepoint.
const MANY: usize = 64;

/// Of each record the last word, where it stands among all.
fn last_words(table: Table, records: &[Written]) -> Vec<&Written> {
    let mut seen = HashSet::new();
    let mut last: Vec<&Written> =
        records.iter().rev().filter(|w| seen.insert(key_of(table, &w.version.row))).collect();
    last.reverse();
    last
}

async fn insert_notes(
    transaction: &Transaction<'_>,
    robot: &Robot,
    sql: &str,
    table: Table,
    last: &[&Written],
) -> Result<(), tokio_postgres::Error> {
    let statement = transaction.prepare_cached(sql).await?;
    let (cells, stamps) = (values(table, last), Stamps::of(last));
    transaction.execute(&statement, &inserted(robot, &cells, &stamps)).await?;
    Ok(())
}

/// Adds what is taken to be new, without looking for each row whether it is there; false where one was, and nothing is done.
async fn add_notes(
    transaction: &Transaction<'_>,
    robot: &Robot,
    table: Table,
    records: &[Written],
) -> Result<bool> {
    let Insert { columns, chosen, .. } = insert(table);
    let sql = format!("INSERT INTO {} ({columns}) SELECT {chosen}", place(table));
    transaction.batch_execute("SAVEPOINT adding").await?;
    match insert_notes(transaction, robot, &sql, table, &last_words(table, records)).await {
        Ok(()) => {
            transaction.batch_execute("RELEASE SAVEPOINT adding").await?;
            Ok(true)
        }
        Err(error) if error.code() == Some(&SqlState::UNIQUE_VIOLATION) => {
            transaction.batch_execute("ROLLBACK TO SAVEPOINT adding").await?;
            Ok(false)
        }
        Err(error) => Err(error.into()),
    }
}

/// What a robot notes: of each record the last word counts.
async fn put_notes(
    transaction: &Transaction<'_>,
    robot: &Robot,
    table: Table,
    records: &[Written],
) -> Result<()> {
    let Insert { columns, chosen, .. } = insert(table);
    let keys: Vec<String> = key_columns(table).map(|(_, c)| quoted(c.name)).collect();
    let own = table.columns().iter().filter(|c| !c.is_key).map(|c| quoted(c.name));
    let stamps = ["\"RecDate\"", "\"RecUser\"", "\"Deleted\"", "revision"].map(str::to_owned);
    let sets: Vec<String> =
        own.chain(stamps).map(|name| format!("{name} = excluded.{name}")).collect();
    let sql = format!(
        "INSERT INTO {} ({columns}) SELECT {chosen} \
         ON CONFLICT (building, robot, {}) DO UPDATE SET {}",
        place(table),
        keys.join(", "),
        sets.join(", ")
    );
    Ok(insert_notes(transaction, robot, &sql, table, &last_words(table, records)).await?)
}

/// The things that records are about.
fn replicas(table: Table, records: &[Written]) -> impl Iterator<Item = i64> {
    let column = table.columns().iter().position(|c| c.name == "ReplID").expect("a column of both");
    let id = move |w: &Written| match w.version.row.get(column) {
        Some(Cell::Int(id)) => Some(*id),
        _ => None,
    };
    records.iter().filter_map(id)
}

/// Which of these things the robot now proposes to put elsewhere on the map.
async fn note_proposals(
    transaction: &Transaction<'_>,
    robot: &Robot,
    touched: BTreeSet<i64>,
) -> Result<()> {
    let sql = "WITH now AS MATERIALIZED ( \
                 SELECT replica, sure FROM fleet.disagreement \
                 WHERE building = $1 AND robot = $2 AND replica = ANY ($3)), \
               gone AS ( \
                 DELETE FROM fleet.proposed p WHERE building = $1 AND robot = $2 AND replica = ANY ($3) \
                 AND NOT EXISTS (SELECT FROM now n WHERE n.replica = p.replica)) \
               INSERT INTO fleet.proposed (building, robot, replica, sure) SELECT $1, $2, replica, sure FROM now \
               ON CONFLICT (building, robot, replica) DO UPDATE SET sure = excluded.sure";
    let statement = transaction.prepare_cached(sql).await?;
    let touched = Vec::from_iter(touched);
    transaction.execute(&statement, &[&robot.building, &robot.robot, &touched]).await?;
    Ok(())
}

/// Tasks that came, went on, or left the queue.
async fn note_missions(
    transaction: &Transaction<'_>,
    robot: &Robot,
    tasks: &[Written],
) -> Result<()> {
    let text = |row: &Row, at: usize| match row.get(at) {
        Some(Cell::Text(text)) => text.replace('\0', "\u{2400}"),
        _ => String::new(),
    };
    let int = |row: &Row, at: usize| if let Some(Cell::Int(n)) = row.get(at) { *n } else { 0 };
    let column = |name: &str| {
        Table::Tasks.columns().iter().position(|c| c.name == name).expect("a column of Tasks")
    };
    let [task, words, by, at, state] = ["TaskID", "Text", "By", "At", "State"].map(column);
    let mut known = BTreeMap::new();
    for version in tasks.iter().map(|w| &w.version).filter(|v| !v.stamp.deleted) {
        // Moments beyond the server's calendar are one there.
        let given = At(int(&version.row, at)).micros();
        known.insert((int(&version.row, task), given), version);
    }
    let all = || known.values();
    let ids: Vec<i64> = known.keys().map(|(task, _)| *task).collect();
    let column = |at| all().map(|v| text(&v.row, at)).collect::<Vec<_>>();
    let (words, by, states) = (column(words), column(by), column(state));
    let given: Vec<At> = all().map(|v| At(int(&v.row, at))).collect();
    let noted: Vec<At> = all().map(|v| At(v.stamp.at.0)).collect();
    let sql = "INSERT INTO fleet.mission (building, robot, task, text, given_by, given, state, noted) \
               SELECT $1, $2, unnest($3::bigint[]), unnest($4::text[]), unnest($5::text[]), \
                      unnest($6::timestamptz[]), unnest($7::text[]), unnest($8::timestamptz[]) \
               ON CONFLICT (building, robot, task, given) DO UPDATE SET \
               text = excluded.text, state = excluded.state, noted = excluded.noted, ended = NULL";
    let statement = transaction.prepare_cached(sql).await?;
    let Robot { building, robot: no, .. } = robot;
    transaction
        .execute(&statement, &[building, no, &ids, &words, &by, &given, &states, &noted])
        .await?;
    let sql = "UPDATE fleet.mission m SET ended = $3 WHERE building = $1 AND robot = $2 AND ended IS NULL \
               AND NOT EXISTS (SELECT FROM log.\"Tasks\" t WHERE t.building = $1 AND t.robot = $2 \
               AND t.\"TaskID\" = m.task AND NOT t.\"Deleted\" \
               AND timestamptz 'epoch' + t.\"At\" * interval '1 millisecond' = m.given)";
    let statement = transaction.prepare_cached(sql).await?;
    let last = At(tasks.iter().map(|w| w.version.stamp.at.0).max().unwrap_or_default());
    transaction.execute(&statement, &[building, no, &last]).await?;
    Ok(())
}
