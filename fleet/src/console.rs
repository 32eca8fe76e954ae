//! The fleet as an operator sees it: one page, and the JSON behind it, under what the operator's key may see.

use axum::extract::{Query, State};
use axum::response::Html;
use axum::{Json, Router, routing::get, routing::post};
use deadpool_postgres::Transaction;
use serde::{Deserialize, Serialize};

use crate::ask::{Answer, ask, rows};
use crate::db::{Who, enter};
use crate::error::{FleetError, Result};
use crate::query::{Question, Table};
use crate::serve::{Centre, Key};
use crate::sheets::revision;

const PAGE: &str = include_str!("console.html");

/// What the page shows.
#[derive(Debug, Serialize)]
struct Fleet {
    buildings: Table,
    robots: Table,
    missions: Table,
    proposals: Table,
    conflicts: Table,
}

/// The paths of operators.
pub(crate) fn router() -> Router<Centre> {
    Router::new()
        .route("/", get(|| async { Html(PAGE) }))
        .route("/v1/fleet", get(fleet))
        .route("/v1/building", get(building))
        .route("/v1/ask", post(asked))
        .route("/v1/query", post(queried))
}

async fn operator(transaction: &Transaction<'_>, key: &Key) -> Result<()> {
    match enter(transaction, &key.0).await? {
        Who::Operator { .. } => Ok(()),
        Who::Robot { .. } => Err(FleetError::Forbidden),
    }
}

const MOMENT: &str = "to_char($ AT TIME ZONE 'UTC', 'YYYY-MM-DD HH24:MI:SS')";

fn moment(column: &str) -> String {
    MOMENT.replace('$', column)
}

async fn fleet(State(centre): State<Centre>, key: Key) -> Result<Json<Fleet>> {
    let mut client = centre.client().await?;
    let transaction = client.build_transaction().read_only(true).start().await?;
    operator(&transaction, &key).await?;
    let sql = format!(
        "SELECT b.building::text, b.name, count(r.robot) FILTER (WHERE r.robot > 0)::text, \
                max(r.revision) FILTER (WHERE r.robot = 0)::text, {} \
         FROM fleet.building b LEFT JOIN fleet.robot r USING (building) GROUP BY b.building, b.name ORDER BY b.building",
        moment("max(r.reported)")
    );
    let columns = ["building", "name", "robots", "centre", "reported"];
    let buildings = rows(&transaction, &columns, &sql, &[]).await?;
    let sql = format!(
        "SELECT r.building::text, b.name, r.robot::text, r.name, r.revision::text, r.sequence::text, {}, \
                CASE WHEN r.reported IS NULL THEN 'silent' WHEN EXISTS (SELECT FROM fleet.conflict c \
                  WHERE c.building = r.building AND c.robot = r.robot AND c.settled IS NULL) THEN 'apart' \
                WHEN EXISTS (SELECT FROM fleet.mission m WHERE m.building = r.building AND m.robot = r.robot \
                  AND m.ended IS NULL AND m.state = 'begun') THEN 'works' \
                WHEN r.reported < now() - interval '1 hour' THEN 'away' ELSE 'here' END \
         FROM fleet.robot r JOIN fleet.building b USING (building) WHERE r.robot > 0 ORDER BY r.building, r.robot",
        moment("r.reported")
    );
    let columns =
        ["building", "building_name", "robot", "name", "revision", "sequence", "reported", "state"];
    let robots = rows(&transaction, &columns, &sql, &[]).await?;
    let sql = format!(
        "SELECT b.name, r.name, m.text, m.given_by, {}, CASE WHEN m.ended IS NOT NULL THEN 'ended' ELSE m.state END, {} \
         FROM fleet.mission m JOIN fleet.building b USING (building) \
         JOIN fleet.robot r ON r.building = m.building AND r.robot = m.robot \
         ORDER BY m.ended IS NOT NULL, m.given DESC LIMIT 500",
        moment("m.given"),
        moment("m.ended")
    );
    let columns = ["building", "robot", "text", "given_by", "given", "state", "ended"];
    let missions = rows(&transaction, &columns, &sql, &[]).await?;
    let sql = format!(
        "SELECT b.name, r.name, p.thing, p.mapped_area, p.area, round(p.apart)::text, round((p.sure * 100)::numeric)::text, {} \
         FROM fleet.proposal p JOIN fleet.building b USING (building) \
         JOIN fleet.robot r ON r.building = p.building AND r.robot = p.robot \
         ORDER BY p.sure DESC, b.name, p.thing LIMIT 500",
        moment("p.seen")
    );
    let columns =
        ["building", "robot", "thing", "map_area", "seen_area", "apart_cm", "sure_percent", "seen"];
    let proposals = rows(&transaction, &columns, &sql, &[]).await?;
    let sql = "SELECT b.name, r.name, c.centre_revision::text, c.thing, c.centre, c.robots \
               FROM fleet.conflict c JOIN fleet.building b USING (building) \
               JOIN fleet.robot r ON r.building = c.building AND r.robot = c.robot \
               WHERE c.settled IS NULL ORDER BY 1, 2, 4 LIMIT 500";
    let columns = ["building", "robot", "centre_revision", "thing", "centre", "robots"];
    let conflicts = rows(&transaction, &columns, sql, &[]).await?;
    Ok(Json(Fleet { buildings, robots, missions, proposals, conflicts }))
}

#[derive(Deserialize)]
struct Of {
    building: i64,
    robot: i64,
}

/// A building as one of its robots has it: maps, revisions and what follows from the map.
#[derive(Debug, Serialize)]
struct Building {
    maps: Table,
    revisions: Table,
    facts: Table,
}

async fn building(
    State(centre): State<Centre>,
    key: Key,
    Query(of): Query<Of>,
) -> Result<Json<Building>> {
    let mut client = centre.client().await?;
    let transaction = client.build_transaction().read_only(true).start().await?;
    operator(&transaction, &key).await?;
    revision(&transaction, of.building, of.robot).await?;
    let sql = "SELECT \"ID\"::text, \"Name\" FROM map.\"Map\" WHERE building = $1 AND robot = $2 \
               AND revision_to IS NULL AND NOT \"Deleted\" ORDER BY \"ID\"";
    let maps = rows(&transaction, &["map", "name"], sql, &[&of.building, &of.robot]).await?;
    let sql = format!(
        "SELECT \"Revision\"::text, {}, \"RecUser\", \"Reason\" FROM log.\"Revisions\" \
         WHERE building = $1 AND robot = $2 ORDER BY \"Revision\" DESC LIMIT 100",
        moment("\"RecDate\"")
    );
    let columns = ["revision", "at", "author", "reason"];
    let revisions = rows(&transaction, &columns, &sql, &[&of.building, &of.robot]).await?;
    let sql = "SELECT relation, subject, object FROM fleet.fact WHERE building = $1 AND robot = $2 \
               AND revision_to IS NULL ORDER BY 1, 2, 3 LIMIT 5000";
    let columns = ["relation", "subject", "object"];
    let facts = rows(&transaction, &columns, sql, &[&of.building, &of.robot]).await?;
    Ok(Json(Building { maps, revisions, facts }))
}

#[derive(Deserialize)]
struct Asked {
    question: String,
}

async fn asked(
    State(centre): State<Centre>,
    key: Key,
    Json(asked): Json<Asked>,
) -> Result<Json<Answer>> {
    let mut client = centre.client().await?;
    let transaction = client.build_transaction().read_only(true).start().await?;
    operator(&transaction, &key).await?;
    Ok(Json(ask(&transaction, &asked.question).await?))
}

async fn queried(
    State(centre): State<Centre>,
    key: Key,
    Json(asked): Json<Asked>,
) -> Result<Json<Table>> {
    let mut client = centre.client().await?;
    let transaction = client.build_transaction().read_only(true).start().await?;
    operator(&transaction, &key).await?;
    // Joins of anything with anything end.
    transaction.batch_execute("SET LOCAL statement_timeout = '30s'").await?;
    Ok(Json(Question::parse(&asked.question)?.run(&transaction).await?))
}
