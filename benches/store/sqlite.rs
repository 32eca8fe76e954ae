//! The work of the store's bench done by SQLite: WAL, synchronous=FULL, the same records in the same batches, each
//! statement prepared once.

use std::path::Path;

use orthoframe_store::records::AreaObjects;
use rusqlite::{Connection, params};

pub(crate) fn open(directory: &Path) -> Connection {
    let db = Connection::open(directory.join("map.sqlite")).expect("a new file");
    db.execute_batch(
        "PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL;
         CREATE TABLE AreaObjects (AreaID INTEGER, ObjectID INTEGER, ReplID INTEGER, X REAL, Y REAL, Z REAL,
         Ang REAL, MoveProb INTEGER, Name TEXT, NameEn TEXT, Deleted INTEGER, RecDate TEXT, RecUser TEXT,
         PRIMARY KEY (AreaID, ObjectID, ReplID)) WITHOUT ROWID",
    )
    .expect("a table");
    db
}

pub(crate) fn fill(db: &Connection, records: &[AreaObjects]) {
    let mut insert = db
        .prepare("INSERT INTO AreaObjects VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?)")
        .expect("the table is there");
    for batch in records.chunks(super::BATCH) {
        let transaction = db.unchecked_transaction().expect("no other writer");
        for r in batch {
            let (date, user) = ("2026-09-21T14:13:20.000Z", "Мастер");
            insert
                .execute(params![
                    r.area_id,
                    r.object_id,
                    r.repl_id,
                    r.x,
                    r.y,
                    r.z,
                    r.ang,
                    r.move_prob,
                    r.name,
                    r.name_en,
                    0,
                    date,
                    user
                ])
                .expect("the disk has room");
        }
        transaction.commit().expect("the disk has room");
    }
}

/// Moves one replica, durably.
pub(crate) fn edit(db: &Connection) -> impl FnMut(&AreaObjects) {
    let mut update = db
        .prepare(
            "UPDATE AreaObjects SET X = ?, Y = ? WHERE AreaID = ? AND ObjectID = ? AND ReplID = ?",
        )
        .expect("the table is there");
    move |r| {
        let changed = update.execute(params![r.x, r.y, r.area_id, r.object_id, r.repl_id]);
        assert_eq!(changed.expect("the disk has room"), 1);
    }
}

/// How many records of a Fragment were read, all their cells with them.
pub(crate) fn fragment(db: &Connection) -> impl FnMut(u32) -> usize {
    let mut select =
        db.prepare("SELECT * FROM AreaObjects WHERE AreaID = ?").expect("the table is there");
    move |area| {
        let rows = select
            .query_map([area], |row| {
                Ok(AreaObjects {
                    area_id: row.get(0)?,
                    object_id: row.get(1)?,
                    repl_id: row.get(2)?,
                    x: row.get(3)?,
                    y: row.get(4)?,
                    z: row.get(5)?,
                    ang: row.get(6)?,
                    move_prob: row.get(7)?,
                    name: row.get(8)?,
                    name_en: row.get(9)?,
                })
            })
            .expect("a number is bound");
        rows.map(|row| row.expect("whole records")).collect::<Vec<_>>().len()
    }
}
