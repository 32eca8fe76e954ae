//! The schema, as numbered files of plain SQL that are run once each, in their order.
//!
//! **Invariant**: a file that was run is never changed; its checksum is kept beside its number.

use tokio_postgres::Client;

use crate::error::{FleetError, Result};
use crate::units::said;

struct Migration {
    name: &'static str,
    sql: &'static str,
    /// A server that divides the tables itself does without it.
    divides: bool,
}

macro_rules! migration {
    ($name:literal, $divides:literal) => {
        Migration {
            name: $name,
            sql: include_str!(concat!("../migrations/", $name, ".sql")),
            divides: $divides,
        }
    };
}

const MIGRATIONS: &[Migration] = &[
    migration!("0001_fleet", false),
    migration!("0002_map", false),
    migration!("0003_log", false),
    migration!("0004_partitions", true),
    migration!("0005_views", false),
    migration!("0006_security", false),
    migration!("0007_fact_building", false),
    migration!("0008_editors", false),
    migration!("0009_work_asked", false),
    migration!("0010_proposed", false),
    migration!("0011_functions", false),
];

/// What a distributed server takes away from the files; see `docs/fleet.md`.
const DIVIDED: &str = " PARTITION BY HASH (building)";

const NOTES: &str = "CREATE TABLE IF NOT EXISTS public.fleet_migration (
    number bigint PRIMARY KEY, name text NOT NULL, checksum bigint NOT NULL, ran timestamptz NOT NULL DEFAULT now());
    INSERT INTO public.fleet_migration (number, name, checksum) VALUES (0, 'lock', 0) ON CONFLICT DO NOTHING";

const LOCK: &str = "SELECT FROM public.fleet_migration WHERE number = 0 FOR UPDATE";

/// Runs what was not run yet, each file in a transaction of its own; returns their names.
///
/// # Errors
/// The database refused; or a file that was run before is not the one of this program.
pub async fn migrate(client: &mut Client, undivided: bool) -> Result<Vec<&'static str>> {
    client.batch_execute(NOTES).await?;
    let mut ran = Vec::new();
    for (number, migration) in (1_i64..).zip(MIGRATIONS) {
        let checksum = i64::from(crc32fast::hash(migration.sql.as_bytes()));
        let transaction = client.transaction().await?;
        // Two at once would run a file twice. A row's lock is what distributed servers have, too.
        transaction.execute(LOCK, &[]).await?;
        let known = transaction
            .query_opt("SELECT checksum FROM public.fleet_migration WHERE number = $1", &[&number])
            .await?;
        match known.map(|row| row.get::<_, i64>(0)) {
            Some(before) if before == checksum => continue,
            Some(_) => {
                let what = said!("step-was-another", step = migration.name);
                return Err(FleetError::Database { what });
            }
            None => {}
        }
        if !(undivided && migration.divides) {
            let sql = migration.sql.to_owned();
            let sql = if undivided { sql.replace(DIVIDED, "") } else { sql };
            transaction.batch_execute(&sql).await?;
        }
        let note =
            "INSERT INTO public.fleet_migration (number, name, checksum) VALUES ($1, $2, $3)";
        transaction.execute(note, &[&number, &migration.name, &checksum]).await?;
        transaction.commit().await?;
        ran.push(migration.name);
    }
    Ok(ran)
}
