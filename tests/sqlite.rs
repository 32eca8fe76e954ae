//! The tables of paper 2 as an SQLite file: the paper's names to the letter, nothing lost either way.

use orthoframe::Engine;
use orthoframe::engine::change_now;
use orthoframe_exchange::{read_sqlite, write_sqlite};
use orthoframe_map::World;
use orthoframe_store::{Change, Origin, Store, Table, Timestamp};
use rusqlite::Connection;

use crate::generated_worlds;
use crate::worlds::{rb2, variants};

/// A store with a world, and the world's tables in a file beside it.
fn exported(world: &World) -> (tempfile::TempDir, std::path::PathBuf) {
    let dir = tempfile::tempdir().expect("a folder");
    let (mut store, _) = Store::open(dir.path().join("store")).expect("a new store");
    store.import(world, &Change::new("Мастер", Timestamp(0), "проба")).expect("a sound world");
    let file = dir.path().join("map.sqlite");
    write_sqlite(&file, &store.reader(), world).expect("a new file");
    (dir, file)
}

fn check_comes_back(world: &World) {
    let (_dir, file) = exported(world);
    let again = read_sqlite(&file).expect("our own file").world().expect("records of a world");
    assert_eq!(again.as_ref(), Some(world));
}

#[test]
fn nothing_is_lost_on_the_way_to_sql_and_back() {
    check_comes_back(&rb2());
    for (_, world) in variants() {
        check_comes_back(&world);
    }
    for seed in 0..40 {
        check_comes_back(&generated_worlds::world(seed));
    }
}

/// What tests/store and the paper say, seen from SQL.
#[test]
fn the_papers_tables_stand_there_with_its_names() {
    let (_dir, file) = exported(&rb2());
    let sql = Connection::open(&file).expect("a file of SQLite");
    let mut paper = 0;
    for table in Table::ALL.iter().filter(|t| matches!(t.origin(), Origin::Paper | Origin::Derived))
    {
        let mut names = sql
            .prepare(&format!("SELECT name FROM pragma_table_info('{}')", table.name()))
            .expect("a query");
        let names: Vec<String> =
            names.query_map([], |r| r.get(0)).expect("rows").map(|n| n.expect("a name")).collect();
        let wanted: Vec<&str> =
            table.columns().iter().filter(|c| !c.is_beyond).map(|c| c.name).collect();
        // The paper's columns first, in its order; then its three of every record.
        assert_eq!(names[..wanted.len()], wanted[..], "{}", table.name());
        assert_eq!(names[wanted.len()..wanted.len() + 3], ["RecDate", "RecUser", "Deleted"]);
        paper += 1;
    }
    assert_eq!(paper, 31);
    let count = |query: &str| sql.query_row(query, [], |r| r.get::<_, i64>(0)).expect("a number");
    assert_eq!(count("SELECT count(*) FROM Area"), rb2().areas.len() as i64);
    // The misspelling is the paper's.
    assert!(count("SELECT count(*) FROM Area WHERE \"Hieght\" > 200") > 0);
    // Derived tables are filled: as many sides as the Areas' Orthoframes have.
    let sides = "SELECT count(*) FROM OrtFrmSides s JOIN AreaItems i ON i.OrFrID = s.OrFrID";
    assert_eq!(count("SELECT count(*) FROM AreaItemSides"), count(sides));
    assert!(count("SELECT count(*) FROM MapItemSides") > 0);
    assert!(count("SELECT count(*) FROM AreaObjectSides") > 0);
    assert!(count("SELECT count(*) FROM ObjectItemSides") > 0);
    assert_eq!(count("SELECT count(*) FROM Area WHERE RecUser = 'Мастер' AND Deleted = 0"), 4);
}

#[test]
fn an_edit_in_sql_arrives_and_a_deleted_row_does_not() {
    let (dir, file) = exported(&rb2());
    let sql = Connection::open(&file).expect("a file of SQLite");
    let chair: (i64, f64) = sql
        .query_row("SELECT ReplID, X FROM AreaObjects ORDER BY ReplID LIMIT 1", [], |r| {
            Ok((r.get(0)?, r.get(1)?))
        })
        .expect("a replica");
    sql.execute("UPDATE AreaObjects SET MoveProb = 77 WHERE ReplID = ?1", [chair.0])
        .expect("edited");
    sql.execute("UPDATE Places SET Deleted = 1", []).expect("edited");
    sql.execute("UPDATE Robot SET StartPlaceID = NULL", []).expect("edited");
    sql.close().expect("closed");
    let mut engine = Engine::open(&dir.path().join("other"), None).expect("a new store");
    engine.import_sqlite(&file, &change_now("operator", "SQL")).expect("a sound map");
    let world = engine.world().expect("a map");
    let id = orthoframe_units::ReplicaId(u32::try_from(chair.0).expect("an id"));
    assert_eq!(world.replicas[&id].move_prob, 77);
    assert!(world.places.is_empty());
    // Again: it is the same map, so nothing changes.
    let report = engine.import_sqlite(&file, &change_now("operator", "SQL")).expect("a sound map");
    assert_eq!(report.counts.total(), 0);
}

#[test]
fn a_file_that_makes_no_map_is_refused_and_the_store_stays_as_it_was() {
    let (dir, file) = exported(&rb2());
    let mut engine = Engine::open(&dir.path().join("other"), None).expect("a new store");
    let mut refused = |file: &std::path::Path| {
        let error = engine.import_sqlite(file, &change_now("operator", "SQL")).unwrap_err();
        assert!(engine.world().is_err());
        error.to_string()
    };
    let spoiled = |no: usize, edit: &str| {
        let copy = dir.path().join(format!("spoiled-{no}.sqlite"));
        std::fs::copy(&file, &copy).expect("copied");
        Connection::open(&copy).expect("opened").execute_batch(edit).expect("edited");
        copy
    };
    assert!(refused(&spoiled(1, "DROP TABLE Area")).contains("нет таблицы Area"));
    assert!(
        refused(&spoiled(2, "ALTER TABLE Map DROP COLUMN \"Hieght\"")).contains("нет поля Hieght")
    );
    let text = refused(&spoiled(3, "DELETE FROM Domain"));
    assert!(text.contains("нет карты"), "{text}");
    let text = refused(&spoiled(4, "UPDATE OrtFrmSides SET X1 = 'много'"));
    assert!(text.contains("поле X1 не читается"), "{text}");
    // A base that is not closed is a fault of the map, told as of a map file.
    refused(&spoiled(5, "UPDATE OrtFrmSides SET X1 = X1 + 7 WHERE rowid = 1"));
    let view = "ALTER TABLE Area RENAME TO Hidden; CREATE VIEW Area AS SELECT * FROM Hidden";
    assert!(refused(&spoiled(6, view)).contains("нет таблицы Area"));
    let rubbish = dir.path().join("rubbish.sqlite");
    std::fs::write(&rubbish, b"SQLite format 3\0 and no more").expect("written");
    refused(&rubbish);
    let whole = std::fs::read(&file).expect("read");
    for end in [0, 50, 100, 1000, whole.len() / 2, whole.len() - 100] {
        std::fs::write(&rubbish, &whole[..end]).expect("written");
        refused(&rubbish);
    }
}
