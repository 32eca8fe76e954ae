//! The fleet as an operator sees it: a page, and the JSON behind it, under what the operator's key may see and do.

use axum::extract::{Query, State};
use axum::http::header::{CONTENT_TYPE, SET_COOKIE};
use axum::response::IntoResponse;
use axum::{Json, Router, routing::get, routing::post};
use deadpool_postgres::Transaction;
use serde::{Deserialize, Serialize};

use crate::ask::{Answer, ask, rows};
use crate::db::{Who, enter};
use crate::error::{FleetError, Result};
use crate::handout::now;
use crate::keys;
use crate::lists::{Counted, MOST, Scope, moment};
use crate::map::{Format, World};
use crate::picture::{Wanted, plan, world};
use crate::query::{Question, Table};
use crate::revise::{self, Edit, Revised};
use crate::serve::{Centre, Key};
use crate::sheets::revision;
use crate::store::Change;
use crate::units::{Language, Source};

/// The paths of operators.
pub(crate) fn router() -> Router<Centre> {
    let file = |kind: &'static str, text: &'static str| {
        get(move || async move { ([(CONTENT_TYPE, kind)], text) })
    };
    Router::new()
        .route("/", file("text/html; charset=utf-8", include_str!("page/index.html")))
        .route("/app.js", file("text/javascript; charset=utf-8", include_str!("page/app.js")))
        .route("/style.css", file("text/css; charset=utf-8", include_str!("page/style.css")))
        .route("/icon.svg", file("image/svg+xml", include_str!("page/icon.svg")))
        .route("/v1/enter", post(entered))
        .route("/v1/leave", post(left))
        .route("/v1/fleet", get(fleet))
        .route("/v1/building", get(building))
        .route("/v1/plan", get(drawn))
        .route("/v1/map.toml", get(file_of))
        .route("/v1/ask", post(asked))
        .route("/v1/query", post(queried))
        .route("/v1/edit", post(edited))
        .route("/v1/revise", post(revised))
        .route("/v1/adopt", post(adopted))
        .route("/v1/insist", post(insisted))
}

#[derive(Deserialize)]
struct Entering {
    key: String,
}

async fn entered(
    State(centre): State<Centre>,
    Json(entering): Json<Entering>,
) -> Result<impl IntoResponse> {
    let client = centre.client().await?;
    let session = keys::enter(&client, entering.key.trim()).await?;
    Ok(([(SET_COOKIE, centre.gate.cookie(&session))], Json(())))
}

async fn left(State(centre): State<Centre>, key: Key) -> Result<impl IntoResponse> {
    keys::leave(&*centre.client().await?, &key.0).await?;
    Ok(([(SET_COOKIE, centre.gate.cookie(""))], Json(())))
}

async fn operator(transaction: &Transaction<'_>, key: &Key) -> Result<bool> {
    match enter(transaction, &key.0).await? {
        Who::Operator { edits, .. } => Ok(edits),
        Who::Robot { .. } => Err(FleetError::Forbidden),
    }
}

/// An operator who edits, as the author of a revision.
async fn editor(transaction: &Transaction<'_>, key: &Key, reason: String) -> Result<Change> {
    if !operator(transaction, key).await? {
        return Err(FleetError::Forbidden);
    }
    let name: String = transaction.query_one("SELECT fleet.my_name()", &[]).await?.get(0);
    Ok(Change::new(name, now(), reason))
}

/// What the page shows.
#[derive(Debug, Serialize)]
struct Fleet {
    name: String,
    edits: bool,
    #[serde(flatten)]
    lists: Counted,
}

#[derive(Deserialize)]
struct Found {
    /// Part of the name of a building or robot.
    #[serde(default)]
    find: String,
    /// A page that is open asks again by itself: what was counted a moment ago will do.
    #[serde(default)]
    again: bool,
}

async fn fleet(
    State(centre): State<Centre>,
    key: Key,
    Query(Found { find, again }): Query<Found>,
) -> Result<Json<Fleet>> {
    let mut client = centre.client().await?;
    let transaction = client.build_transaction().read_only(true).start().await?;
    let Who::Operator { building, edits } = enter(&transaction, &key.0).await? else {
        return Err(FleetError::Forbidden);
    };
    let name = transaction.query_one("SELECT fleet.my_name()", &[]).await?.get(0);
    let lists = centre.kept.lists(&transaction, Scope { building, find }, again).await?;
    Ok(Json(Fleet { name, edits, lists }))
}

#[derive(Deserialize)]
struct Of {
    building: i64,
    robot: i64,
}

/// A building as one of its robots has it: maps, revisions, what stands there, and what follows from the map.
#[derive(Debug, Serialize)]
struct Building {
    name: String,
    revision: i64,
    edits: bool,
    robots: Table,
    maps: Table,
    things: Table,
    revisions: Table,
    conflicts: Table,
    facts: Table,
}

async fn building(
    State(centre): State<Centre>,
    key: Key,
    Query(of): Query<Of>,
) -> Result<Json<Building>> {
    let mut client = centre.client().await?;
    let transaction = client.build_transaction().read_only(true).start().await?;
    let edits = operator(&transaction, &key).await?;
    let revision = revision(&transaction, of.building, of.robot).await?;
    let name = transaction
        .query_one("SELECT name FROM fleet.building WHERE building = $1", &[&of.building])
        .await?
        .get(0);
    let sql = format!(
        "SELECT robot::text, name, revision::text, {} FROM fleet.robot WHERE building = $1 ORDER BY robot LIMIT {MOST}",
        moment("reported")
    );
    let columns = ["robot", "name", "revision", "reported"];
    let robots = rows(&transaction, &columns, &sql, &[&of.building]).await?;
    let asked: [&(dyn tokio_postgres::types::ToSql + Sync); 2] = [&of.building, &of.robot];
    let sql = "SELECT m.\"ID\"::text, m.\"Name\" FROM map.\"DomainMaps\" d JOIN map.\"Map\" m \
                 ON m.building = d.building AND m.robot = d.robot AND m.\"ID\" = d.\"MapID\" \
                 AND m.revision_to IS NULL AND NOT m.\"Deleted\" \
               WHERE d.building = $1 AND d.robot = $2 AND d.revision_to IS NULL AND NOT d.\"Deleted\" ORDER BY m.\"ID\"";
    let maps = rows(&transaction, &["map", "name"], sql, &asked).await?;
    let sql = "SELECT t.\"Name\", a.\"Name\", round(t.\"X\"::numeric, 1)::text, round(t.\"Y\"::numeric, 1)::text, \
                 round(t.\"Ang\"::numeric, 1)::text FROM map.\"AreaObjects\" t LEFT JOIN map.\"Area\" a \
                 ON a.building = t.building AND a.robot = t.robot AND a.\"ID\" = t.\"AreaID\" AND a.revision_to IS NULL \
               WHERE t.building = $1 AND t.robot = $2 AND t.revision_to IS NULL AND NOT t.\"Deleted\" ORDER BY 2, 1 LIMIT 5000";
    let columns = ["thing", "area", "x", "y", "angle"];
    let things = rows(&transaction, &columns, sql, &asked).await?;
    let sql = format!(
        "SELECT \"Revision\"::text, {}, \"RecUser\", \"Reason\", \
           (\"CreatedCount\" + \"ChangedCount\" + \"DeletedCount\")::text FROM log.\"Revisions\" \
         WHERE building = $1 AND robot = $2 ORDER BY \"Revision\" DESC LIMIT 100",
        moment("\"RecDate\"")
    );
    let columns = ["revision", "at", "author", "reason", "records"];
    let revisions = rows(&transaction, &columns, &sql, &asked).await?;
    let sql = "SELECT robot::text, thing, centre, robots FROM fleet.conflict \
               WHERE building = $1 AND ($2::bigint = 0 OR robot = $2) AND settled IS NULL ORDER BY robot, thing LIMIT 1000";
    let conflicts =
        rows(&transaction, &["robot", "thing", "centre", "robots"], sql, &asked).await?;
    let sql = "SELECT relation, subject, object FROM fleet.fact WHERE building = $1 AND robot = $2 \
               AND revision_to IS NULL ORDER BY 1, 2, 3 LIMIT 2000";
    let facts = rows(&transaction, &["relation", "subject", "object"], sql, &asked).await?;
    Ok(Json(Building { name, revision, edits, robots, maps, things, revisions, conflicts, facts }))
}

#[derive(Deserialize)]
struct OfPlan {
    building: i64,
    robot: i64,
    map: Option<u32>,
    #[serde(default)]
    believed: bool,
}

async fn drawn(
    State(centre): State<Centre>,
    key: Key,
    Query(of): Query<OfPlan>,
) -> Result<impl IntoResponse> {
    let mut client = centre.client().await?;
    let transaction = client.build_transaction().read_only(true).start().await?;
    operator(&transaction, &key).await?;
    let OfPlan { building, robot, map, believed } = of;
    let language = Language::Russian;
    let wanted = Wanted { building, robot, map, as_believed: believed, language };
    Ok(([(CONTENT_TYPE, "image/svg+xml")], plan(&transaction, wanted).await?))
}

/// The map as a file, to be corrected and given back.
async fn file_of(
    State(centre): State<Centre>,
    key: Key,
    Query(of): Query<Of>,
) -> Result<impl IntoResponse> {
    let mut client = centre.client().await?;
    let transaction = client.build_transaction().read_only(true).start().await?;
    operator(&transaction, &key).await?;
    let world = world(&transaction, of.building, of.robot).await?;
    Ok(([(CONTENT_TYPE, "text/plain; charset=utf-8")], world.to_toml()))
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

#[derive(Deserialize)]
struct Editing {
    building: i64,
    /// The revision that it was made on.
    on: i64,
    #[serde(default)]
    reason: String,
    /// Check and tell what would change; write nothing.
    #[serde(default)]
    r#try: bool,
    /// Steps and sections as of a map file, in TOML or JSON.
    text: String,
}

async fn edited(
    State(centre): State<Centre>,
    key: Key,
    Json(editing): Json<Editing>,
) -> Result<Json<Revised>> {
    let mut client = centre.client().await?;
    let transaction = client.transaction().await?;
    let change = editor(&transaction, &key, editing.reason).await?;
    let Editing { building, on, r#try: tries, text, .. } = editing;
    let format = Format::of_text(std::path::Path::new("edit"), &text);
    let revised =
        revise::edit(&transaction, &Edit { building, on, text, format, tries }, &change).await?;
    if !tries {
        transaction.commit().await?;
    }
    Ok(Json(revised))
}

#[derive(Deserialize)]
struct Revising {
    building: i64,
    on: i64,
    #[serde(default)]
    reason: String,
    /// A map file.
    map: String,
}

async fn revised(
    State(centre): State<Centre>,
    key: Key,
    Json(revising): Json<Revising>,
) -> Result<Json<i64>> {
    let mut client = centre.client().await?;
    let transaction = client.transaction().await?;
    let change = editor(&transaction, &key, revising.reason).await?;
    let format = Format::of_text(std::path::Path::new("map"), &revising.map);
    let world = World::parse(&Source::new("map", revising.map), format)
        .map_err(|faulty| FleetError::content(revise::all_faults(&faulty)))?;
    let Revising { building, on, .. } = revising;
    let made = revise::revise(&transaction, building, Some(on), &world, &change).await?;
    transaction.commit().await?;
    Ok(Json(made))
}

#[derive(Deserialize)]
struct Settling {
    building: i64,
    robot: i64,
    #[serde(default)]
    reason: String,
}

async fn adopted(
    State(centre): State<Centre>,
    key: Key,
    Json(settling): Json<Settling>,
) -> Result<Json<i64>> {
    let mut client = centre.client().await?;
    let transaction = client.transaction().await?;
    let change = editor(&transaction, &key, settling.reason).await?;
    let made = revise::adopt(&transaction, settling.building, settling.robot, &change).await?;
    transaction.commit().await?;
    Ok(Json(made))
}

async fn insisted(
    State(centre): State<Centre>,
    key: Key,
    Json(settling): Json<Settling>,
) -> Result<Json<()>> {
    let mut client = centre.client().await?;
    let transaction = client.transaction().await?;
    editor(&transaction, &key, String::new()).await?;
    revise::insist(&transaction, settling.building, settling.robot).await?;
    transaction.commit().await?;
    Ok(Json(()))
}
