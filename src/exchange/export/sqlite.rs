//! The tables of paper 2 as an SQLite file, and back (D6).
//!
//! Each of the paper's 31 tables stands there under its name with its columns under their names, `Hieght` included,
//! and RecDate, RecUser, Deleted as the paper has them on every record. Columns that the paper lacks stand last and
//! have defaults, so that a row can be inserted with the paper's columns alone; so do the tables that it lacks.
//! Derived tables are filled when written and passed over when read. A row whose `Deleted` is 1 is not read.
//!
//! **Invariant**: what was written reads as the same records (SQLite keeps no sign of zero).

use std::path::Path;

use rusqlite::types::{Value, ValueRef};
use rusqlite::{Connection, OpenFlags};

use crate::LARGEST;
use crate::map::World;
use crate::store::{Cell, Column, Key, Kind, Origin, Reader, Row, Sheet, StoreError, Table};
use crate::units::{Bilingual, Fault, Piece, said, word};

/// Rows of one file.
const MOST_ROWS: usize = 5_000_000;

/// An SQLite file that cannot be written or read.
#[derive(Debug, Fault)]
#[fault(exchange)]
#[non_exhaustive]
pub enum SqliteError {
    /// SQLite itself refused.
    Sqlite {
        path: String,
        reason: String,
        #[fault(untold)]
        source: rusqlite::Error,
    },

    /// An export never writes over a file.
    #[fault(code = "exchange::sqlite_exists")]
    Exists { path: String },

    /// Something else than tables with rows.
    #[fault(code = "exchange::sqlite_content")]
    Content { path: String, what: Bilingual },

    /// More than any building.
    #[fault(code = "exchange::sqlite_limit")]
    Limit { path: String, what: Piece, limit: u64 },

    /// A row that makes no record.
    #[fault(transparent)]
    Store(#[from] StoreError),
}

impl SqliteError {
    fn of(path: &str, source: rusqlite::Error) -> Self {
        Self::Sqlite { path: path.to_owned(), reason: source.to_string(), source }
    }

    /// What was asked for is at fault, not the disk.
    #[must_use]
    pub fn is_input(&self) -> bool {
        use rusqlite::ErrorCode::{DiskFull, SystemIoFailure};
        match self {
            Self::Sqlite { source, .. } => {
                !matches!(source.sqlite_error_code(), Some(DiskFull | SystemIoFailure))
            }
            _ => true,
        }
    }
}

/// Tables that an exchange holds: those of the map, and the derived ones.
fn tables() -> impl Iterator<Item = Table> {
    Table::ALL.iter().copied().filter(|t| t.origin() != Origin::Log)
}

fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

fn definition(table: Table) -> String {
    let column = |c: &Column| {
        let (kind, usual) = match c.kind {
            Kind::Id | Kind::Int => ("INTEGER", "0"),
            Kind::Real => ("REAL", "0"),
            Kind::Text => ("TEXT", "''"),
        };
        let name = quoted(c.name);
        // Whether a column may be empty is known by whether its record takes it.
        let needed = if c.is_key || !takes_null(table, c) { " NOT NULL" } else { "" };
        let usual = if c.is_beyond && !needed.is_empty() {
            format!(" DEFAULT {usual}")
        } else {
            String::new()
        };
        format!("{name} {kind}{needed}{usual}")
    };
    let own =
        |beyond: bool| table.columns().iter().filter(move |c| c.is_beyond == beyond).map(column);
    let stamps = ["RecDate", "RecUser"].map(|c| format!("{} TEXT", quoted(c)));
    let deleted = "\"Deleted\" INTEGER NOT NULL DEFAULT 0".to_owned();
    let columns: Vec<String> = own(false).chain(stamps).chain([deleted]).chain(own(true)).collect();
    let keys: Vec<String> =
        table.columns().iter().filter(|c| c.is_key).map(|c| quoted(c.name)).collect();
    format!(
        "CREATE TABLE {} (\n  {},\n  PRIMARY KEY ({})\n);\n",
        quoted(table.name()),
        columns.join(",\n  "),
        keys.join(", ")
    )
}

/// A row of defaults, for the columns that a file lacks.
fn usual(column: &Column) -> Cell {
    match column.kind {
        Kind::Id | Kind::Int => Cell::Int(0),
        Kind::Real => Cell::Real(0.0),
        Kind::Text => Cell::Text(String::new()),
    }
}

fn takes_null(table: Table, column: &Column) -> bool {
    let row: Row = table
        .columns()
        .iter()
        .map(|c| if c.name == column.name { Cell::Null } else { usual(c) })
        .collect();
    table.fits(&row)
}

fn value(cell: &Cell) -> Value {
    match cell {
        Cell::Null => Value::Null,
        Cell::Int(n) => Value::Integer(*n),
        Cell::Real(x) => Value::Real(*x),
        Cell::Text(text) => Value::Text(text.clone()),
    }
}

/// Writes the records of a store's map, and the derived tables of its world, to a new SQLite file.
///
/// # Errors
/// [`SqliteError::Exists`], or what SQLite says; the file is then not there, or not whole and to be deleted.
pub fn write_sqlite(path: &Path, reader: &Reader, world: &World) -> Result<(), SqliteError> {
    let shown = path.display().to_string();
    if path.exists() {
        return Err(SqliteError::Exists { path: shown });
    }
    write_tables(path, reader, world).inspect_err(|_| {
        // The beginning of a file is no export, and it would be in the way of the next one.
        let _ = std::fs::remove_file(path);
        let _ = std::fs::remove_file(journal_of(path));
    })
}

/// SQLite's own journal, which it leaves where it could not go on.
fn journal_of(path: &Path) -> std::path::PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push("-journal");
    name.into()
}

fn write_tables(path: &Path, reader: &Reader, world: &World) -> Result<(), SqliteError> {
    let shown = path.display().to_string();
    let failed = |source| SqliteError::of(&shown, source);
    let derived = Sheet::derived(world)?;
    let mut connection = Connection::open(path).map_err(failed)?;
    let transaction = connection.transaction().map_err(failed)?;
    for table in tables() {
        transaction.execute_batch(&definition(table)).map_err(failed)?;
        let names: Vec<String> = table.columns().iter().map(|c| quoted(c.name)).collect();
        let marks = vec!["?"; names.len() + 2].join(", ");
        let insert = format!(
            "INSERT INTO {} ({}, \"RecDate\", \"RecUser\") VALUES ({marks})",
            quoted(table.name()),
            names.join(", ")
        );
        let mut statement = transaction.prepare(&insert).map_err(failed)?;
        let mut put = |row: &Row, stamp: [Value; 2]| {
            // An older row ends before a column that was added later.
            let missing = table.columns().iter().skip(row.len()).map(|c| value(&usual(c)));
            let values: Vec<Value> = row.iter().map(value).chain(missing).chain(stamp).collect();
            statement.execute(rusqlite::params_from_iter(values)).map(|_| ()).map_err(failed)
        };
        if table.is_stored() {
            for (_, version) in reader.versions(table, &Key::new())? {
                let stamp = &version.stamp;
                put(&version.row, [stamp.at.to_string().into(), stamp.user.clone().into()])?;
            }
        } else {
            for (_, row) in derived.rows(table) {
                put(row, [Value::Null, Value::Null])?;
            }
        }
    }
    transaction.commit().map_err(failed)?;
    connection.close().map_err(|(_, source)| failed(source))
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Reads the records of an SQLite file. Whether they make a sound map is for the caller to check.
///
/// # Errors
/// [`SqliteError`] when the file is none, lacks the paper's tables or columns, or has a row that makes no record.
pub fn read_sqlite(path: &Path) -> Result<Sheet, SqliteError> {
    let shown = path.display().to_string();
    let failed = |source| SqliteError::of(&shown, source);
    let content = |what: Bilingual| SqliteError::Content { path: shown.clone(), what };
    let limit = |what, limit| SqliteError::Limit { path: shown.clone(), what, limit };
    let bytes = match std::fs::metadata(path) {
        Ok(data) if data.len() > LARGEST => return Err(limit(word!("bytes"), LARGEST)),
        // Opening a pipe could wait for ever.
        Ok(data) if !data.is_file() => {
            return Err(content(said!("no-file")));
        }
        Ok(data) => data.len(),
        Err(e) => return Err(content(e.to_string().into())),
    };
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let connection = Connection::open_with_flags(path, flags).map_err(failed)?;
    // A file from outside may bring views and triggers; none of their code is to run.
    connection
        .execute_batch("PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON;")
        .map_err(failed)?;
    // SQLite itself misses the end of a file only where a row lies there; pages of a log beside it come later.
    let number =
        |pragma: &str| connection.pragma_query_value(None, pragma, |row| row.get::<_, i64>(0));
    let whole = number("page_count").map_err(failed)? * number("page_size").map_err(failed)?;
    if bytes < whole.unsigned_abs()
        && !path.with_file_name(format!("{}-wal", file_name(path))).exists()
    {
        return Err(content(said!("cut-off", bytes, whole)));
    }
    let mut sheet = Sheet::default();
    let mut rows = 0_usize;
    for table in tables().filter(|t| t.is_stored()) {
        let Some(columns) = columns_of(&connection, table).map_err(failed)? else {
            if table.origin() == Origin::Paper {
                return Err(content(said!("no-table", table = table.name())));
            }
            continue;
        };
        let has = |name: &str| columns.iter().any(|c| c.eq_ignore_ascii_case(name));
        if let Some(missing) = table.columns().iter().find(|c| !c.is_beyond && !has(c.name)) {
            return Err(content(said!("no-column", table = table.name(), column = missing.name)));
        }
        let present: Vec<bool> = table.columns().iter().map(|c| has(c.name)).collect();
        let names = table.columns().iter().filter(|c| has(c.name)).map(|c| quoted(c.name));
        let names: Vec<String> = names.collect();
        let living = if has("Deleted") { " WHERE \"Deleted\" IS NOT 1" } else { "" };
        let select = format!("SELECT {} FROM {}{living}", names.join(", "), quoted(table.name()));
        let mut statement = connection.prepare(&select).map_err(failed)?;
        let mut found = statement.query([]).map_err(failed)?;
        while let Some(record) = found.next().map_err(failed)? {
            rows += 1;
            if rows > MOST_ROWS {
                return Err(limit(word!("records"), MOST_ROWS as u64));
            }
            let mut index = 0;
            let mut row = Row::new();
            for (column, present) in table.columns().iter().zip(&present) {
                if !present {
                    row.push(usual(column));
                    continue;
                }
                let value = record.get_ref(index).map_err(failed)?;
                index += 1;
                let cell = cell(value, column).ok_or_else(|| {
                    content(said!("unreadable-column", table = table.name(), column = column.name))
                })?;
                row.push(cell);
            }
            sheet.add(table, row)?;
        }
    }
    Ok(sheet)
}

/// The columns of a table; None when there is no plain table of this name.
fn columns_of(connection: &Connection, table: Table) -> rusqlite::Result<Option<Vec<String>>> {
    let plain = "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = ?1 \
                 AND sql NOT LIKE 'CREATE VIRTUAL%'";
    let count: i64 = connection.query_row(plain, [table.name()], |row| row.get(0))?;
    if count == 0 {
        return Ok(None);
    }
    let mut statement = connection.prepare("SELECT name FROM pragma_table_info(?1)")?;
    let names = statement.query_map([table.name()], |row| row.get(0))?;
    names.collect::<rusqlite::Result<_>>().map(Some)
}

/// None when the value is no number or text, or no number where one is wanted.
fn cell(value: ValueRef<'_>, column: &Column) -> Option<Cell> {
    Some(match (value, column.kind) {
        (ValueRef::Null, _) => Cell::Null,
        (ValueRef::Integer(n), Kind::Real) => Cell::Real(n as f64),
        (ValueRef::Integer(n), Kind::Text) => Cell::Text(n.to_string()),
        (ValueRef::Integer(n), _) => Cell::Int(n),
        (ValueRef::Real(x), Kind::Real) => Cell::Real(x),
        // A side named 3 in a column without a type: SQL tools write such.
        (ValueRef::Real(x), Kind::Text) => Cell::Text(x.to_string()),
        (ValueRef::Real(x), _) if x.fract() == 0.0 && x.abs() < 1e15 => Cell::Int(x as i64),
        (ValueRef::Text(bytes), Kind::Text) => {
            Cell::Text(std::str::from_utf8(bytes).ok()?.to_owned())
        }
        (ValueRef::Text(bytes), kind) => {
            let text = std::str::from_utf8(bytes).ok()?.trim();
            match kind {
                Kind::Real => Cell::Real(text.parse().ok()?),
                _ => Cell::Int(text.parse().ok()?),
            }
        }
        (ValueRef::Real(_) | ValueRef::Blob(_), _) => return None,
    })
}
