//! Everything that a store holds as JSON (D6): every table, every record, every version of it, and the derived tables.
//!
//! For other programs and for the archive; a map is exchanged by its map file. Versions of one record stand together,
//! the oldest first, each with its Revision, RecDate, RecUser and Deleted; derived rows have none of these.

use serde_json::{Map, Value};

use crate::map::World;
use crate::store::{Cell, Origin, Reader, Row, Sheet, Stamp, StoreError, Table};

/// All that a reader sees, as one JSON object of tables, a row a line; `world` is the reader's, for the derived tables.
///
/// # Errors
/// [`StoreError::BadRecord`] when a record is broken.
pub fn to_records(reader: &Reader, world: &World) -> Result<String, StoreError> {
    let derived = Sheet::derived(world)?;
    let mut tables = Vec::new();
    for &table in Table::ALL {
        let rows: Vec<String> = if table.origin() == Origin::Derived {
            derived.rows(table).map(|(_, row)| object(table, row, None).to_string()).collect()
        } else {
            let versions = reader.all_versions(table)?;
            versions.iter().map(|v| object(table, &v.row, Some(&v.stamp)).to_string()).collect()
        };
        tables.push(format!("\"{}\": [\n{}\n]", table.name(), rows.join(",\n")));
    }
    Ok(format!(
        "{{\n\"format\": \"orthoframe records\",\n\"version\": 1,\n\"revision\": {},\n\"tables\": {{\n{}\n}}\n}}\n",
        reader.revision(),
        tables.join(",\n")
    ))
}

fn object(table: Table, row: &Row, stamp: Option<&Stamp>) -> Value {
    let cells = table.columns().iter().zip(row).map(|(c, cell)| (c.name.to_owned(), value(cell)));
    let mut object: Map<String, Value> = cells.collect();
    if let Some(stamp) = stamp {
        object.insert("Revision".to_owned(), stamp.revision.into());
        object.insert("RecDate".to_owned(), stamp.at.to_string().into());
        object.insert("RecUser".to_owned(), stamp.user.clone().into());
        object.insert("Deleted".to_owned(), stamp.deleted.into());
    }
    Value::Object(object)
}

fn value(cell: &Cell) -> Value {
    match cell {
        Cell::Null => Value::Null,
        Cell::Int(n) => (*n).into(),
        Cell::Real(x) => (*x).into(),
        Cell::Text(text) => text.as_str().into(),
    }
}
