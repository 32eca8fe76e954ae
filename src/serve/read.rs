//! What is asked and changes nothing: the state, drawings, things and reasons, the history.

use std::sync::Arc;

use axum::Json;
use axum::extract::{Query, State as Of};
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::engine::{
    Believed, Drawing, Engine, Error, RequestError, Source, State, When, json as views,
    question_beginnings,
};
use crate::facts::{Because, Kind, Premise, WhyNot};
use crate::map::{Entity, Replica};
use crate::store::Seen;
use crate::units::{InOrder as _, Language, MapId};

use super::drawing::{self, Part};
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
    let mut view = json!({
        "event": house.events.last_id(),
        "revision": state.revision(),
        "session": session.number,
        "user": session.name,
        "role": session.role,
        "demo": house.is_demo,
    });
    for (field, value) in house.tasks.view().as_object().expect("it is one") {
        view[field] = value.clone();
    }
    let live = house.events.robot();
    let rest = apart(move || Ok(resting(&state))).await?;
    for (field, value) in rest.as_object().expect("it is one") {
        view[field] = value.clone();
    }
    if !live.is_null() {
        view["robot"]["place"] = live;
    }
    Ok(Json(view))
}

/// What is known while the robot stands.
fn resting(state: &State) -> Value {
    let Ok(world) = state.world() else {
        return json!({ "maps": [], "robot": null, "missing": ["map"] });
    };
    let mut maps: Vec<_> = world.domain.maps.iter().collect();
    maps.order_by(|a, b| a.frame.z.get().total_cmp(&b.frame.z.get()));
    let storey = |placed: &&crate::map::DomainMap| {
        let map = &world.maps[&placed.map];
        json!({ "name": map.name, "name_en": map.name_en, "z": placed.frame.z.get() })
    };
    let mut view = json!({
        "name": world.domain.name, "name_en": world.domain.name_en,
        "maps": maps.iter().map(storey).collect::<Vec<_>>(),
        "profile": {
            "radius": (world.robot.passing_width() / 2.0), "speed": world.robot.speed,
        },
        "missing": [],
    });
    match (state.robot(), state.held(), state.handed_over()) {
        (Ok((map, pose)), Ok(held), Ok(handed_over)) => {
            let moment = crate::robot::Moment { time: 0.0, map, pose };
            let thing = |replica: &Replica| json!([replica.name, replica.name_en]);
            view["robot"] = json!({
                "place": super::drive::pose_view(state, &moment),
                "carries": held.map(thing),
                "handed_over": handed_over.iter().map(|(r, to)| json!([r.name, to])).collect::<Vec<_>>(),
            });
        }
        _ => view["missing"] = json!(["robot"]),
    }
    view
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
    apart(move || drawing::storey(&state, map_of(&state, name.as_deref())?, part)).await.map(Json)
}

/// Four numbers divided by commas.
fn reach(text: &str) -> Option<[f64; 4]> {
    let numbers: Vec<f64> =
        text.split(',').map(|n| n.trim().parse().ok()).collect::<Option<_>>()?;
    let reach: [f64; 4] = numbers.try_into().ok()?;
    reach.iter().all(|n| n.is_finite()).then_some(reach)
}

fn no_box() -> Fault {
    Fault::new(
        StatusCode::UNPROCESSABLE_ENTITY,
        "serve::box",
        "box – четыре числа через запятую: лево, низ, право, верх.",
        "box is four numbers divided by commas: left, bottom, right, top.",
    )
}

/// The state as it was at a revision: the map alone.
pub(super) async fn then(house: &House, revision: u64) -> Result<Arc<State>, Fault> {
    let world =
        house.desk.ask(move |engine| engine.store()?.world_as_of(revision).map_err(Error::from));
    let world = world.await??;
    let world = world.ok_or_else(|| Error::from(RequestError::BeforeTheMap))?;
    let rules = house.rules.clone();
    apart(move || Engine::in_memory(world, rules.as_deref())?.state()).await
}

/// The free floor of a storey.
pub(super) async fn floor(Of(house): Of<Arc<House>>, Query(which): Query<Which>) -> Answer {
    let state = house.desk.state();
    apart(move || drawing::floor(&state, map_of(&state, which.map.as_deref())?)).await.map(Json)
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
    apart(move || about(&state, &asked.name, language(asked.lang.as_deref()))).await.map(Json)
}

pub(super) fn about(state: &State, name: &str, language: Language) -> Result<Value, Error> {
    let (world, relations) = (state.world()?, state.relations()?);
    let entity = state.find(name)?;
    let name = world.name(entity).to_owned();
    let facts = relations.of(&name).into_iter().map(|(relation, values)| {
        json!({
            "relation": relations.display_name(&relation, language),
            "args": views::tuple(&values),
        })
    });
    let mut view = json!({ "name": name, "relations": facts.collect::<Vec<_>>() });
    view["seen"] = json!(drawing::seen(state, entity));
    // A state of the past has no store behind it.
    let changes = state.changes_of(entity).unwrap_or_default();
    view["changes"] = changes
        .iter()
        .map(|made| json!({ "revision": made.revision, "user": made.user, "at": made.at.to_string() }))
        .collect();
    match entity {
        Entity::Replica(id) => {
            let replica = &world.replicas[&id];
            let object = &world.objects[&replica.object];
            let mut properties = object.properties.clone();
            properties.extend(replica.properties.clone());
            view["kind"] = json!("thing");
            view["name_en"] = json!(replica.name_en);
            view["object"] = json!([object.name, object.name_en]);
            view["room"] = json!(world.areas[&replica.area].name);
            view["properties"] = json!(properties);
            let now = std::time::SystemTime::now().into();
            if let Ok(found) = state.where_is(&name, now) {
                view["believed"] = believed(state, &found)?;
                let story = state.story_of(&name)?;
                view["story"] = json!(
                    story
                        .iter()
                        .map(|s| {
                            let source = match &s.source {
                                Source::Map { revision, user } => {
                                    json!({ "revision": revision, "user": user })
                                }
                                Source::Seen { observer, sure } => {
                                    json!({ "observer": observer, "sure": sure })
                                }
                            };
                            json!({
                                "at": s.at.to_string(), "source": source,
                                "place": s.place.as_ref().and_then(|seen| place(state, seen)),
                            })
                        })
                        .collect::<Vec<_>>()
                );
            }
        }
        Entity::Door(id) => {
            let door = state.world_now()?.doors.get(&id).unwrap_or(&world.doors[&id]);
            view["kind"] = json!("door");
            view["name_en"] = json!(door.name_en);
            view["state"] = json!(match door.state.status {
                crate::map::DoorStatus::Open => "open",
                crate::map::DoorStatus::Closed => "closed",
                crate::map::DoorStatus::Locked => "locked",
            });
            view["properties"] = json!(door.properties);
        }
        Entity::Area(id) => {
            view["kind"] = json!("room");
            view["name_en"] = json!(world.areas[&id].name_en);
            view["parts"] = json!(drawing::walls(world, id));
            view["things"] =
                json!(world.replicas_in(id).map(|r| [&r.name, &r.name_en]).collect::<Vec<_>>());
        }
        Entity::Place(id) => {
            view["kind"] = json!("place");
            view["name_en"] = json!(world.places[&id].name_en);
        }
        Entity::Zone(id) => {
            let words = state.zones_in_words(language)?;
            view["rule"] = json!(words.get(&id));
            view["kind"] = json!("zone");
            view["name_en"] = json!(world.zones[&id].name_en);
        }
        Entity::Map(id) => {
            view["kind"] = json!("map");
            view["name_en"] = json!(world.maps[&id].name_en);
        }
    }
    Ok(view)
}

fn place(state: &State, seen: &Seen) -> Option<Value> {
    let area = state.world().ok()?.areas.get(&seen.area)?;
    let (map, frame) = state.on_map(seen).ok()??;
    let map = &state.world().ok()?.maps[&map].name;
    Some(json!({
        "room": area.name, "room_en": area.name_en, "map": map,
        "at": [frame.x.get(), frame.y.get()], "angle_deg": frame.angle.get(),
    }))
}

fn believed(state: &State, found: &Believed) -> Result<Value, Error> {
    let belief = &found.belief;
    Ok(json!({
        "name": found.name,
        "name_en": state.uncarried()?.replicas.get(&found.replica).or(state.world()?.replicas.get(&found.replica)).map(|r| &r.name_en),
        "place": place(state, &belief.place),
        "surveyed": found.surveyed.as_ref().and_then(|seen| place(state, seen)),
        "confidence": (belief.confidence * 1000.0).round() / 1000.0,
        "since": belief.since.to_string(),
        "last_seen": belief.last_seen.map(|at| at.to_string()),
        "is_surveyed": belief.is_surveyed,
        "carried": found.carried,
    }))
}

/// Why a relation holds or does not, down to what was measured.
pub(super) async fn why(Of(house): Of<Arc<House>>, Query(fact): Query<Fact>) -> Answer {
    let state = house.desk.state();
    let language = language(fact.lang.as_deref());
    apart(move || {
        let of: Vec<&str> = fact.of.split(',').filter(|name| !name.is_empty()).collect();
        reasons(&state, &fact.relation, &of, language)
    })
    .await
    .map(Json)
}

/// The proof of a relation, or the rule that came closest.
pub(super) fn reasons(
    state: &State,
    relation: &str,
    of: &[&str],
    language: Language,
) -> Result<Value, Error> {
    let relations = state.relations()?;
    let reason = state.reason(relation, of, language)?;
    let map = |id: &MapId| state.world().map(|world| world.maps[id].name.clone());
    let measures: Vec<Value> = reason
        .measurements
        .iter()
        .map(|m| {
            Ok(json!({
                "of": m.of, "map": map(&m.map)?, "ends": m.ends.map(drawing::point),
                "length_cm": m.length, "text": m.text, "fails": m.fails,
            }))
        })
        .collect::<Result<_, Error>>()?;
    let with_reason = |mut view: Value| {
        view["words"] = json!(reason.text);
        view["about"] = json!(reason.about);
        view["measures"] = json!(measures);
        view
    };
    let compared = |premises: &[Premise]| -> Vec<Value> {
        let measure = |premise: &Premise| match premise {
            Premise::Compared { text, left, op, right } => Some(json!({
                "text": text, "left": left.to_string(), "op": op.sign(), "right": right.to_string(),
            })),
            _ => None,
        };
        premises.iter().filter_map(measure).collect()
    };
    Ok(with_reason(match &reason.because {
        Ok(proof) => {
            let step = |step: &crate::facts::ProofStep| {
                let mut view = json!({
                    "relation": relations.display_name(&step.fact.name, language),
                    "args": views::tuple(&step.fact.values),
                    "height": step.height,
                });
                match &step.because {
                    Because::Told => view["measured"] = json!(true),
                    Because::Written { .. } => view["written"] = json!(true),
                    Because::Rule { rule, premises } => {
                        view["rule"] = json!(rule.text);
                        view["compared"] = json!(compared(premises));
                    }
                }
                view
            };
            let steps: Vec<Value> = proof.steps.iter().map(step).collect();
            json!({ "holds": true, "steps": steps })
        }
        Err(WhyNot::Nearest(rule)) => {
            let failed = rule.premises.iter().filter(|(_, holds)| *holds == Some(false));
            let failed: Vec<Premise> = failed.map(|(premise, _)| premise.clone()).collect();
            json!({
                "holds": false, "rule": rule.rule.text, "failed": compared(&failed),
                "text": rule.to_string(),
            })
        }
        Err(WhyNot::NotTold | WhyNot::Holds) => json!({ "holds": false }),
    }))
}

/// What can be asked of two things, and what kinds of things can be put down.
pub(super) async fn kinds(Of(house): Of<Arc<House>>) -> Answer {
    let state = house.desk.state();
    apart(move || {
        let relations = state.relations()?;
        let between = relations.derived().relations().filter(|(_, info)| {
            let is_shown = !info.outputs.is_empty() && info.columns.len() == 2;
            is_shown && info.columns.iter().all(|column| column.kind == Kind::Symbol)
        });
        let names = between.filter_map(|(_, info)| Some([&info.name, info.second_name.as_ref()?]));
        Ok(json!({
            "relations": names.collect::<Vec<_>>(),
            "objects": drawing::objects(state.world()?),
        }))
    })
    .await
    .map(Json)
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
        let rest = &frame[text.len()..];
        json!({ "typed": length, "name": format!("{}{rest} ", begun.text), "kind": "frame" })
    };
    let name =
        |(typed, name): (usize, &String)| json!({ "typed": typed, "name": name, "kind": "name" });
    let frames: Vec<Value> = frames.filter(|f| f.len() > text.len()).take(4).map(frame).collect();
    let left = MOST - frames.len();
    let all: Vec<Value> =
        frames.into_iter().chain(found.into_iter().take(left).map(name)).collect();
    Ok(Json(json!(all)))
}

/// All revisions, the oldest first.
pub(super) async fn history(Of(house): Of<Arc<House>>) -> Answer {
    revisions(&house).await.map(Json)
}

pub(super) async fn revisions(house: &House) -> Result<Value, Fault> {
    let all = house.desk.ask(|engine| engine.revisions()).await??;
    Ok(json!({ "revisions": all.iter().map(views::revision).collect::<Vec<_>>() }))
}

/// What changed between two revisions.
pub(super) async fn diff(Of(house): Of<Arc<House>>, Query(between): Query<Between>) -> Answer {
    changed(&house, between.from, between.to).await.map(Json)
}

pub(super) async fn changed(house: &House, from: u64, to: Option<u64>) -> Result<Value, Fault> {
    let all = house.desk.ask(move |engine| {
        let to = to.unwrap_or_else(|| engine.revision());
        engine.diff(When::Revision(from), When::Revision(to))
    });
    Ok(
        json!({ "from": from, "to": to, "differences": views::differences(&all.await??, Language::Russian) }),
    )
}

/// What is believed to stand elsewhere than the map has it.
pub(super) async fn proposals(Of(house): Of<Arc<House>>) -> Answer {
    proposed(&house).await.map(Json)
}

pub(super) async fn proposed(house: &House) -> Result<Value, Fault> {
    let found = house.desk.ask(|engine| {
        let all = engine.proposals(std::time::SystemTime::now().into())?;
        all.iter().map(|one| believed(engine, one)).collect::<Result<Vec<_>, Error>>()
    });
    Ok(json!({ "proposals": found.await?? }))
}
