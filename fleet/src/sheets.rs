//! The maps that the centre holds, read back as records and as worlds.

use deadpool_postgres::Transaction;
use futures_util::future::try_join_all;

use crate::error::{FleetError, Result};
use crate::rows::{cell, place, quoted};
use crate::store::{Cell, Row, Sheet, Table};
use crate::units::said;

/// The rows of a table of a robot's map as of a revision, or of what it notes as it is now; gone ones left out. `U+2400`
/// stands where the robot has a zero byte.
///
/// # Errors
/// [`FleetError::Database`].
pub async fn rows_of(
    transaction: &Transaction<'_>,
    building: i64,
    robot: i64,
    table: Table,
    revision: i64,
) -> Result<Vec<Row>> {
    let names: Vec<String> = table.columns().iter().map(|c| quoted(c.name)).collect();
    let valid = match table.is_map() {
        true => "revision <= $3 AND (revision_to IS NULL OR revision_to > $3)",
        false => "$3 >= 0",
    };
    let sql = format!(
        "SELECT {} FROM {} WHERE building = $1 AND robot = $2 AND {valid} AND NOT \"Deleted\"",
        names.join(", "),
        place(table)
    );
    let statement = transaction.prepare_typed_cached(
        &sql,
        &[
            tokio_postgres::types::Type::INT8,
            tokio_postgres::types::Type::INT8,
            tokio_postgres::types::Type::INT8,
        ],
    );
    let found = transaction.query(&statement.await?, &[&building, &robot, &revision]).await?;
    let row = |row: &tokio_postgres::Row| {
        let cells = table.columns().iter().enumerate().map(|(at, column)| cell(row, at, column));
        Ok(cells.collect::<Result<Row, _>>()?)
    };
    found.iter().map(row).collect()
}

/// A robot's map as of a revision: the records of its store.
///
/// # Errors
/// [`FleetError::Database`], [`FleetError::Store`].
pub async fn sheet(
    transaction: &Transaction<'_>,
    building: i64,
    robot: i64,
    revision: i64,
) -> Result<Sheet> {
    // All are asked for before the first answer is there.
    let tables: Vec<Table> = Table::ALL.iter().copied().filter(|table| table.is_map()).collect();
    let asked = tables.iter().map(|table| rows_of(transaction, building, robot, *table, revision));
    let mut sheet = Sheet::default();
    for (table, rows) in tables.iter().zip(try_join_all(asked).await?) {
        for row in rows {
            sheet.add(*table, row)?;
        }
    }
    Ok(sheet)
}

/// The last revision of a robot's map that is here.
///
/// # Errors
/// [`FleetError::Unknown`], [`FleetError::Database`].
pub async fn revision(transaction: &Transaction<'_>, building: i64, robot: i64) -> Result<i64> {
    let sql = "SELECT revision FROM fleet.robot WHERE building = $1 AND robot = $2";
    let row = transaction.query_opt(sql, &[&building, &robot]).await?;
    let unknown = || FleetError::unknown(said!("robot-of-building", robot, building));
    Ok(row.ok_or_else(unknown)?.get(0))
}

/// Whether two sheets hold the same records, but for zero bytes in their texts.
#[must_use]
pub fn same(one: &Sheet, other: &Sheet) -> bool {
    let told = |row: &Row| {
        let text = |cell: &Cell| match cell {
            Cell::Text(text) => Cell::Text(text.replace('\0', "\u{2400}")),
            other => other.clone(),
        };
        row.iter().map(text).collect::<Row>()
    };
    let all = |sheet: &Sheet| {
        let full = sheet.iter().map(|(table, _, row)| {
            (table, table.full(row).map_or_else(|| told(row), |row| told(&row)))
        });
        full.collect::<Vec<_>>()
    };
    all(one) == all(other)
}
