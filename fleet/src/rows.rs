//! Records as columns, which the database takes and gives by the thousand.
//!
//! A text with a zero byte is no text for PostgreSQL: the zero is kept as U+2400, which is its picture.

use std::error::Error;

use tokio_postgres::types::{
    FromSql, IsNull, ToSql, Type, accepts, private::BytesMut, to_sql_checked,
};

use crate::store::{Cell, Column, Kind, Origin, Row, Table};

/// Where a table stands: what is of the map, or computed from it, with its past; what a robot notes as it is.
#[must_use]
pub fn place(table: Table) -> String {
    format!("{}.\"{}\"", if table.origin() == Origin::Log { "log" } else { "map" }, table.name())
}

/// A name as SQL writes it.
#[must_use]
pub fn quoted(name: &str) -> String {
    format!("\"{name}\"")
}

/// The database's type of a column.
#[must_use]
pub fn kind(column: &Column) -> &'static str {
    match column.kind {
        Kind::Id | Kind::Int => "bigint",
        Kind::Real => "double precision",
        Kind::Text => "text",
    }
}

/// The values of one column.
#[derive(Debug)]
pub enum Values {
    Int(Vec<Option<i64>>),
    Real(Vec<Option<f64>>),
    Text(Vec<Option<String>>),
}

impl Values {
    /// One column of some rows.
    pub fn of<'r>(column: &Column, at: usize, rows: impl Iterator<Item = &'r Row>) -> Self {
        match column.kind {
            Kind::Id | Kind::Int => Self::Int(
                rows.map(|row| if let Some(Cell::Int(n)) = row.get(at) { Some(*n) } else { None })
                    .collect(),
            ),
            Kind::Real => Self::Real(
                rows.map(|row| match row.get(at) {
                    Some(Cell::Real(x)) => Some(*x),
                    Some(Cell::Int(n)) => Some(*n as f64),
                    _ => None,
                })
                .collect(),
            ),
            Kind::Text => Self::Text(
                rows.map(|row| match row.get(at) {
                    Some(Cell::Text(text)) => Some(text.replace('\0', "\u{2400}")),
                    _ => None,
                })
                .collect(),
            ),
        }
    }

    #[must_use]
    pub fn as_parameter(&self) -> &(dyn ToSql + Sync) {
        match self {
            Self::Int(values) => values,
            Self::Real(values) => values,
            Self::Text(values) => values,
        }
    }
}

/// The cell of a column of a row that the database gave.
///
/// # Errors
/// The column has another type there.
pub fn cell(
    row: &tokio_postgres::Row,
    at: usize,
    column: &Column,
) -> Result<Cell, tokio_postgres::Error> {
    Ok(match column.kind {
        Kind::Id | Kind::Int => row.try_get::<_, Option<i64>>(at)?.map(Cell::Int),
        Kind::Real => row.try_get::<_, Option<f64>>(at)?.map(Cell::Real),
        Kind::Text => row.try_get::<_, Option<String>>(at)?.map(Cell::Text),
    }
    .unwrap_or(Cell::Null))
}

/// A moment, milliseconds since 1970: a `timestamptz` there. What lies beyond the server's calendar is its first or last
/// day.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct At(pub i64);

/// The server counts microseconds since 2000.
const EPOCH_MS: i64 = 946_684_800_000;
const FIRST_US: i64 = -210_866_803_200_000_000;
const LAST_US: i64 = 9_223_371_331_199_999_999;

impl At {
    /// As the server counts it.
    #[must_use]
    pub fn micros(self) -> i64 {
        self.0.saturating_sub(EPOCH_MS).saturating_mul(1000).clamp(FIRST_US, LAST_US)
    }
}

impl ToSql for At {
    fn to_sql(
        &self,
        kind: &Type,
        out: &mut BytesMut,
    ) -> Result<IsNull, Box<dyn Error + Sync + Send>> {
        let us = self.micros();
        us.to_sql(&Type::INT8, out).inspect(|_| debug_assert!(<Self as ToSql>::accepts(kind)))
    }

    accepts!(TIMESTAMPTZ);
    to_sql_checked!();
}

impl<'a> FromSql<'a> for At {
    fn from_sql(_: &Type, raw: &'a [u8]) -> Result<Self, Box<dyn Error + Sync + Send>> {
        let us = i64::from_sql(&Type::INT8, raw)?;
        Ok(Self(us.div_euclid(1000).saturating_add(EPOCH_MS)))
    }

    accepts!(TIMESTAMPTZ);
}
