//! What is asked and changes nothing: the state, drawings, things and reasons, the history.

use std::sync::Arc;

use axum::Json;
use axum::extract::{Query, State as Of};
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::Value;

use crate::engine::json::{self as views, Completion, Part};
use crate::engine::{Drawing, Engine, Error, RequestError, State, When, question_beginnings};
use crate::units::{Language, MapId, said};

use super::fault::Fault;
use super::gate::Session;
use super::{House, apart};

type Answer = Result<Json<Value>, Fault>;

/// Which storey, in which language, at which time.
#[derive(Debug, Deserialize)]
pub(super) struct Which {
    map: Option<String>,
    lang: Option<String>,
    as_of: Option<u64>,
    /// Left, bottom, right, top.
    r#box: Option<String>,
    most: Option<usize>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Named {
    name: String,
    lang: Option<String>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Fact {
    relation: String,
    /// The names, with a comma and nothing else between.
    #[serde(default)]
    of: String,
    lang: Option<String>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Way {
    /// From where the robot is, where it is left out.
    from: Option<String>,
    to: String,
    lang: Option<String>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Between {
    from: u64,
    to: Option<u64>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Begun {
    #[serde(default)]
    text: String,
}

/// The language of a request: `ru` or `en`.
pub(super) fn language(of: Option<&str>) -> Language {
    if of == Some("en") { Language::English } else { Language::Russian }
}

/// Everything that a page begins with.
pub(super) async fn state(Of(house): Of<Arc<House>>, session: axum::Extension<Session>) -> Answer {
    let state = house.desk.state();
    let seat = views::Seat {
        event: house.events.last_id(),
        revision: state.revision(),
        session: session.number,
        user: &session.name,
        role: session.role.word(),
        demo: house.is_demo,
    };
    let (tasks, driving) = (house.tasks.view(), house.events.robot());
    let standing = apart(move || Ok(views::house(&state))).await?;
    Ok(Json(views::console(&seat, tasks, standing, driving)))
}

fn map_of(state: &State, name: Option<&str>) -> Result<MapId, Error> {
    match name {
        Some(_) => state.map_named(name),
        // The lowest, where there are several.
        None => {
            let sheets = state.sheets_named(None)?;
            let first = sheets.first().map(|(map, _)| *map);
            first.ok_or_else(|| RequestError::NoMaps.into())
        }
    }
}

/// A storey as data; at an earlier revision, as it was then.
pub(super) async fn drawing(Of(house): Of<Arc<House>>, Query(which): Query<Which>) -> Answer {
    let state = match which.as_of {
        None => house.desk.state(),
        Some(revision) => then(&house, revision).await?,
    };
    let part = match which.r#box.as_deref() {
        None => Part::Whole { most: which.most.unwrap_or(usize::MAX) },
        Some(text) => Part::Box(reach(text).ok_or_else(no_box)?),
    };
    let name = which.map;
    apart(move || views::storey(&state, map_of(&state, name.as_deref())?, part)).await.map(Json)
}

/// Four numbers divided by commas.
fn reach(text: &str) -> Option<[f64; 4]> {
    let numbers: Vec<f64> =
        text.split(',').map(|n| n.trim().parse().ok()).collect::<Option<_>>()?;
    let reach: [f64; 4] = numbers.try_into().ok()?;
    reach.iter().all(|n| n.is_finite()).then_some(reach)
}

fn no_box() -> Fault {
    Fault::new(StatusCode::UNPROCESSABLE_ENTITY, "serve::box", said!("box-is-four-numbers-divided"))
}

/// The state as it was at a revision: the map alone.
pub(super) async fn then(house: &House, revision: u64) -> Result<Arc<State>, Fault> {
    let world =
        house.desk.look(move |engine| engine.store()?.world_as_of(revision).map_err(Error::from));
    let world = world.await??;
    let world = world.ok_or_else(|| Error::from(RequestError::BeforeTheMap))?;
    let rules = house.rules.clone();
    apart(move || Engine::in_memory(world, rules.as_deref())?.state()).await
}

/// The free floor of a storey.
pub(super) async fn floor(Of(house): Of<Arc<House>>, Query(which): Query<Which>) -> Answer {
    let state = house.desk.state();
    apart(move || views::floor(&state, map_of(&state, which.map.as_deref())?)).await.map(Json)
}

/// A storey as SVG, to be kept or printed.
pub(super) async fn svg(
    Of(house): Of<Arc<House>>,
    Query(which): Query<Which>,
) -> Result<Response, Fault> {
    let state = house.desk.state();
    let text = apart(move || {
        let language = language(which.lang.as_deref());
        let drawing = Drawing { language, ..Drawing::default() };
        state.draw(map_of(&state, which.map.as_deref())?, &drawing)
    });
    Ok(([(CONTENT_TYPE, "image/svg+xml")], text.await?).into_response())
}

/// What is known of one thing, room, door or place.
pub(super) async fn thing(Of(house): Of<Arc<House>>, Query(asked): Query<Named>) -> Answer {
    let state = house.desk.state();
    apart(move || views::about(&state, &asked.name, language(asked.lang.as_deref())))
        .await
        .map(Json)
}

/// Why a relation holds or does not, down to what was measured.
pub(super) async fn why(Of(house): Of<Arc<House>>, Query(fact): Query<Fact>) -> Answer {
    let state = house.desk.state();
    let language = language(fact.lang.as_deref());
    apart(move || {
        let of: Vec<&str> = fact.of.split(',').filter(|name| !name.is_empty()).collect();
        views::reasons(&state, &fact.relation, &of, language)
    })
    .await
    .map(Json)
}

/// What can be asked of two things, and what kinds of things can be put down.
pub(super) async fn kinds(Of(house): Of<Arc<House>>) -> Answer {
    let state = house.desk.state();
    apart(move || views::kinds(&state)).await.map(Json)
}

/// The way between two places, with what would open it.
pub(super) async fn route(Of(house): Of<Arc<House>>, Query(way): Query<Way>) -> Answer {
    let state = house.desk.state();
    apart(move || {
        let journey = match &way.from {
            Some(from) => state.journey(from, &way.to, crate::engine::Method::Shortest)?,
            None => state.journey_of_robot(&way.to)?,
        };
        Ok(views::journey(state.world()?, &journey, language(way.lang.as_deref())))
    })
    .await
    .map(Json)
}

/// Questions that begin as a text does, and names that begin as its last words do.
pub(super) async fn complete(Of(house): Of<Arc<House>>, Query(begun): Query<Begun>) -> Answer {
    const MOST: usize = 8;
    let names = house.desk.state().names().unwrap_or_default();
    let text = begun.text.to_lowercase();
    let starts: Vec<usize> = text
        .char_indices()
        .filter(|(at, _)| *at == 0 || text[..*at].ends_with([' ', '«', '"']))
        .map(|(at, _)| at)
        .collect();
    let mut found = Vec::new();
    for start in starts {
        let said = &text[start..];
        if said.chars().count() < 2 {
            continue;
        }
        for name in &names {
            let key = name.to_lowercase();
            if key.starts_with(said) && key != said && !found.iter().any(|(_, n)| *n == name) {
                found.push((said.chars().count(), name));
            }
        }
    }
    let length = text.chars().count();
    let frames =
        question_beginnings().iter().filter(|frame| length > 1 && frame.starts_with(&text));
    // As far as it is written it stays as it is written.
    let frame = |frame: &String| {
        let name = format!("{}{} ", begun.text, &frame[text.len()..]);
        Completion { typed: length, name, kind: "frame" }
    };
    let name =
        |(typed, name): (usize, &String)| Completion { typed, name: name.clone(), kind: "name" };
    let frames: Vec<Completion> =
        frames.filter(|f| f.len() > text.len()).take(4).map(frame).collect();
    let left = MOST - frames.len();
    let all: Vec<Completion> =
        frames.into_iter().chain(found.into_iter().take(left).map(name)).collect();
    Ok(Json(views::completions(&all)))
}

/// All revisions, the oldest first.
pub(super) async fn history(Of(house): Of<Arc<House>>) -> Answer {
    revisions(&house).await.map(Json)
}

pub(super) async fn revisions(house: &House) -> Result<Value, Fault> {
    let all = house.desk.look(|engine| engine.revisions()).await??;
    Ok(views::revisions(&all))
}

/// What changed between two revisions.
pub(super) async fn diff(Of(house): Of<Arc<House>>, Query(between): Query<Between>) -> Answer {
    changed(&house, between.from, between.to).await.map(Json)
}

pub(super) async fn changed(house: &House, from: u64, to: Option<u64>) -> Result<Value, Fault> {
    let found = house.desk.look(move |engine| {
        let to = to.unwrap_or_else(|| engine.revision());
        let all = engine.diff(When::Revision(from), When::Revision(to))?;
        Ok::<_, Error>(views::diff(from, to, &all, Language::Russian))
    });
    Ok(found.await??)
}

/// What is believed to stand elsewhere than the map has it.
pub(super) async fn proposals(Of(house): Of<Arc<House>>) -> Answer {
    proposed(&house).await.map(Json)
}

pub(super) async fn proposed(house: &House) -> Result<Value, Fault> {
    let found = house.desk.look(|engine| {
        let all = engine.proposals(std::time::SystemTime::now().into())?;
        views::proposals(engine, &all)
    });
    Ok(found.await??)
}
