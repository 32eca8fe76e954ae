//! The lists of the fleet's page, and how they were counted last.
//!
//! A page that is open asks every few seconds whether anything is new, and many may be open. What was counted for one is kept
//! for all who see the same, at least twenty times as long as the counting took: however large the fleet, pages that are only
//! looked at cost the database a twentieth of one connection. Who opens the page, searches or has done something is told what
//! is there now.
//!
//! **Invariant**: what is kept is given only to keys that see the same buildings.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use deadpool_postgres::Transaction;
use serde::Serialize;

use crate::ask::rows;
use crate::error::Result;
use crate::query::Table;

/// Of each list so many rows at most; a page of more is read by nobody.
pub(crate) const MOST: usize = 300;

/// What was counted is good so long, and so many times as long as the counting took.
const SOON: Duration = Duration::from_secs(10);
const SPARINGLY: u32 = 20;

/// So many scopes are remembered.
const SCOPES: usize = 64;

/// Whose lists, and of what.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) struct Scope {
    /// The one building that the key sees; none for all.
    pub(crate) building: Option<i64>,
    /// Part of the name of a building or robot.
    pub(crate) find: String,
}

/// See the head of this file.
#[derive(Debug, Serialize)]
struct Lists {
    /// How many there are of each, whatever is shown.
    totals: Table,
    buildings: Table,
    robots: Table,
    missions: Table,
    proposals: Table,
    conflicts: Table,
    /// What could not be derived, and why.
    stuck: Table,
}

/// Lists, and how old they are.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Counted {
    #[serde(flatten, serialize_with = "told")]
    lists: Arc<Lists>,
    /// Seconds since they were counted.
    age: u64,
}

fn told<S: serde::Serializer>(lists: &Arc<Lists>, to: S) -> Result<S::Ok, S::Error> {
    lists.serialize(to)
}

/// What was counted last; locked while it is counted anew, so that one counts for all who wait.
type Last = Arc<tokio::sync::Mutex<Option<(Instant, Duration, Arc<Lists>)>>>;

/// What was counted last in each scope.
#[derive(Debug, Default)]
pub(crate) struct Kept(Mutex<HashMap<Scope, Last>>);

impl Kept {
    /// The lists of a scope, as they are since this was asked; or, `again`, as they were a moment ago.
    ///
    /// # Errors
    /// [`FleetError::Database`](crate::FleetError::Database).
    pub(crate) async fn lists(
        &self,
        transaction: &Transaction<'_>,
        scope: Scope,
        again: bool,
    ) -> Result<Counted> {
        let asked = Instant::now();
        let last = self.last(&scope);
        let mut last = last.lock().await;
        if let Some((begun, took, lists)) = &*last {
            let is_good = match again {
                true => begun.elapsed() < SOON.max(*took * SPARINGLY),
                // Somebody else has counted while this one waited.
                false => *begun >= asked,
            };
            if is_good {
                let age = begun.elapsed().as_secs();
                return Ok(Counted { lists: Arc::clone(lists), age });
            }
        }
        let begun = Instant::now();
        let lists = Arc::new(count(transaction, &scope.find).await?);
        *last = Some((begun, begun.elapsed(), Arc::clone(&lists)));
        Ok(Counted { lists, age: 0 })
    }

    fn last(&self, scope: &Scope) -> Last {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if all.len() >= SCOPES && !all.contains_key(scope) {
            // Who waits for one of them has it in hand.
            all.clear();
        }
        Arc::clone(all.entry(scope.clone()).or_default())
    }
}

pub(crate) fn moment(column: &str) -> String {
    format!("to_char({column} AT TIME ZONE 'UTC', 'YYYY-MM-DD\"T\"HH24:MI:SS\"Z\"')")
}

const TOTALS: &str = "SELECT (SELECT count(*) FROM fleet.building)::text, (SELECT count(*) FROM fleet.robot WHERE robot > 0)::text, \
    (SELECT count(*) FROM fleet.mission WHERE ended IS NULL)::text, (SELECT count(*) FROM fleet.proposed)::text, \
    (SELECT count(*) FROM (SELECT DISTINCT building, robot FROM fleet.conflict WHERE settled IS NULL) c)::text";

/// Of a list that names robots.
const OF: &str = "JOIN fleet.building b ON b.building = x.building \
    JOIN fleet.robot r ON r.building = x.building AND r.robot = x.robot \
    WHERE (r.name ILIKE $1 OR b.name ILIKE $1)";

async fn count(transaction: &Transaction<'_>, find: &str) -> Result<Lists> {
    let like = format!("%{}%", find.replace(['%', '_', '\\', '\0'], ""));
    let columns = ["buildings", "robots", "missions", "proposals", "apart"];
    Ok(Lists {
        totals: rows(transaction, &columns, TOTALS, &[]).await?,
        buildings: buildings(transaction, &like).await?,
        robots: robots(transaction, &like).await?,
        missions: missions(transaction, &like).await?,
        proposals: proposals(transaction, &like).await?,
        conflicts: conflicts(transaction, &like).await?,
        stuck: stuck(transaction).await?,
    })
}

async fn buildings(transaction: &Transaction<'_>, like: &str) -> Result<Table> {
    let sql = format!(
        "SELECT b.building::text, b.name, count(r.robot) FILTER (WHERE r.robot > 0)::text, \
                max(r.revision) FILTER (WHERE r.robot = 0)::text, {} \
         FROM fleet.building b LEFT JOIN fleet.robot r ON r.building = b.building WHERE b.name ILIKE $1 \
         GROUP BY b.building, b.name ORDER BY b.building LIMIT {MOST}",
        moment("max(r.reported) FILTER (WHERE r.robot > 0)")
    );
    let columns = ["building", "name", "robots", "centre", "reported"];
    rows(transaction, &columns, &sql, &[&like]).await
}

/// Those that want somebody come first.
async fn robots(transaction: &Transaction<'_>, like: &str) -> Result<Table> {
    let sql = format!(
        "SELECT building::text, building_name, robot::text, name, state, {}, revision::text, sequence::text FROM ( \
           SELECT r.*, b.name AS building_name, \
                CASE WHEN r.reported IS NULL THEN 'silent' WHEN c.robot IS NOT NULL THEN 'apart' \
                WHEN r.reported < now() - interval '1 hour' THEN 'away' \
                WHEN m.robot IS NOT NULL THEN 'works' ELSE 'here' END AS state \
           FROM fleet.robot r JOIN fleet.building b ON b.building = r.building \
           LEFT JOIN (SELECT DISTINCT building, robot FROM fleet.conflict WHERE settled IS NULL) c \
             ON c.building = r.building AND c.robot = r.robot \
           LEFT JOIN (SELECT DISTINCT building, robot FROM fleet.mission WHERE ended IS NULL AND state = 'begun') m \
             ON m.building = r.building AND m.robot = r.robot \
           WHERE r.robot > 0 AND (r.name ILIKE $1 OR b.name ILIKE $1)) r \
         ORDER BY array_position(ARRAY['apart', 'away', 'works', 'here', 'silent'], state), building, robot LIMIT {MOST}",
        moment("reported")
    );
    let columns =
        ["building", "building_name", "robot", "name", "state", "reported", "revision", "sequence"];
    rows(transaction, &columns, &sql, &[&like]).await
}

/// What goes on, then what ended; the newest first.
async fn missions(transaction: &Transaction<'_>, like: &str) -> Result<Table> {
    let part = |ended: &str| {
        format!(
            "(SELECT b.name, r.name AS robot_name, x.text, \
               CASE WHEN x.ended IS NOT NULL THEN 'ended' ELSE x.state END, x.given_by, {}, {} \
             FROM fleet.mission x {OF} AND x.ended {ended} ORDER BY x.given DESC LIMIT {MOST})",
            moment("x.given"),
            moment("x.ended")
        )
    };
    let sql = format!("{} UNION ALL {} LIMIT {MOST}", part("IS NULL"), part("IS NOT NULL"));
    let columns = ["building_name", "robot_name", "text", "state", "given_by", "given", "ended"];
    rows(transaction, &columns, &sql, &[&like]).await
}

async fn proposals(transaction: &Transaction<'_>, like: &str) -> Result<Table> {
    let sql = format!(
        "SELECT x.building::text, x.robot::text, b.name, r.name, x.thing, x.mapped_area, x.area, round(x.apart)::text, \
                round((x.sure * 100)::numeric)::text, {} \
         FROM fleet.proposal x {OF} ORDER BY x.sure DESC, x.building, x.robot, x.replica LIMIT {MOST}",
        moment("x.seen")
    );
    let columns = [
        "building",
        "robot",
        "building_name",
        "robot_name",
        "thing",
        "map_area",
        "seen_area",
        "apart_cm",
        "sure_percent",
        "seen",
    ];
    rows(transaction, &columns, &sql, &[&like]).await
}

async fn conflicts(transaction: &Transaction<'_>, like: &str) -> Result<Table> {
    let sql = format!(
        "SELECT x.building::text, x.robot::text, b.name, r.name, x.centre_revision::text, x.robot_revision::text, \
                x.thing, x.centre, x.robots, {} \
         FROM fleet.conflict x {OF} AND x.settled IS NULL ORDER BY x.building, x.robot, x.thing LIMIT {MOST}",
        moment("x.noted")
    );
    let columns = [
        "building",
        "robot",
        "building_name",
        "robot_name",
        "centre_revision",
        "robot_revision",
        "thing",
        "centre",
        "robots",
        "noted",
    ];
    rows(transaction, &columns, &sql, &[&like]).await
}

async fn stuck(transaction: &Transaction<'_>) -> Result<Table> {
    let sql = format!(
        "SELECT b.name, x.robot::text, x.revision::text, x.fault FROM fleet.work x JOIN fleet.building b USING (building) \
         WHERE x.fault <> '' ORDER BY x.asked LIMIT {MOST}"
    );
    rows(transaction, &["building_name", "robot", "revision", "fault"], &sql, &[]).await
}
