//! The tools: what each is called with, and what it answers.

use std::sync::Arc;
use std::time::{Duration, SystemTime};

use axum::http::StatusCode;
use rmcp::model::{
    CallToolRequestParams, InputRequiredResult, ProgressNotificationParam, Tool, ToolAnnotations,
};
use rmcp::service::{RequestContext, RoleServer};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use crate::engine::{Drawing, Error, Method, Mode, RequestError, change_now, json as views};
use crate::robot::Moment;
use crate::units::{Deg, Frame, Language};

use super::super::drive::{Answered, Declined, pose_view};
use super::super::fault::Fault;
use super::super::gate::{Role, Session};
use super::super::{House, act, apart, drawing, read};
use super::approval::{Word, ask};
use super::client::Assistant;

/// What a call came to.
pub(super) enum Told {
    Value(Value),
    /// PNG, and what it shows.
    Picture(Vec<u8>, Value),
    /// The client's user is to be asked first.
    Waits(Box<InputRequiredResult>),
}

type Answer = Result<Told, Fault>;

/// A tool as it is listed.
pub(super) struct Row {
    pub(super) name: &'static str,
    title: &'static str,
    about: &'static str,
    pub(super) needs: Role,
    deed: Deed,
    takes: fn() -> Value,
}

/// What a tool does to the world.
#[derive(Clone, Copy, PartialEq)]
enum Deed {
    Reads,
    /// Adds to what is known, or proposes.
    Adds,
    Acts,
}

fn text(about: &str) -> Value {
    json!({ "type": "string", "description": about })
}

fn number(about: &str) -> Value {
    json!({ "type": "number", "description": about })
}

fn of(properties: &Value, required: &[&str]) -> Value {
    json!({
        "type": "object", "properties": properties, "required": required,
        "additionalProperties": false,
    })
}

const THING: &str =
    "Name of a thing, room, door or place, as the map has it, in Russian or English";

const ROWS: &[Row] = &[
    Row {
        name: "ask",
        title: "Ask a question",
        about: "Answers a question in plain English or Russian about rooms, doors, things, how they lie to each other, ways, and the robot. Never acts. The dialogue is remembered: \"and what is under it?\" works.",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: || {
            of(
                &json!({ "text": text("The question"), "lang": { "enum": ["en", "ru"], "description": "Of the answer, where the question does not tell" } }),
                &["text"],
            )
        },
    },
    Row {
        name: "query",
        title: "Query in the rules' language",
        about: "Runs a Datalog query over relations and measurements, e.g. ?- ON_TOP_OF(X, \"Table 1\"), distance_between(X, \"Window 1\", D).order D.limit 3",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: || {
            of(
                &json!({ "query": text("A query, with rules of its own before it if it likes") }),
                &["query"],
            )
        },
    },
    Row {
        name: "where_is",
        title: "Where is it",
        about: "Where a thing is believed to be and how surely, where it was seen and when, its properties and relations; without a name, where the robot is.",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: || of(&json!({ "name": text(THING) }), &[]),
    },
    Row {
        name: "relations",
        title: "Relations",
        about: "Relations derived from the map's geometry: all of one name, all about one thing, or both.",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: || {
            of(
                &json!({ "name": text("Of the relation, e.g. ON_TOP_OF, NEXT_TO, INSIDE"), "of": text(THING) }),
                &[],
            )
        },
    },
    Row {
        name: "why",
        title: "Why does it hold",
        about: "The proof of a relation down to what was measured, e.g. relation ON_TOP_OF of [\"Cup 1\", \"Table 1\"].",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: fact,
    },
    Row {
        name: "why_not",
        title: "Why does it not hold",
        about: "Of a relation that does not hold: the rule that came closest, and the number that was missing.",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: fact,
    },
    Row {
        name: "route",
        title: "A way",
        about: "The shortest way for the robot between two places, with its length, doors and points; where there is none, what bars it and what would open it.",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: || {
            of(
                &json!({ "from": text("Where from: a name, or \"X,Y\" in cm"), "to": text("Where to") }),
                &["from", "to"],
            )
        },
    },
    Row {
        name: "map",
        title: "The map",
        about: "A picture of a storey or a room (PNG), and the same as data: outlines of rooms, things, doors and places in cm.",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: || {
            of(
                &json!({ "name": text("A storey or a room; the lowest storey without one"), "picture": { "type": "boolean", "description": "With the picture (default), or the data alone" } }),
                &[],
            )
        },
    },
    Row {
        name: "history",
        title: "History of the map",
        about: "Revisions of the map with author, time and reason, the newest last; with `from`, what changed since that revision.",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: || {
            of(
                &json!({ "from": { "type": "integer", "minimum": 0 }, "to": { "type": "integer", "minimum": 0 } }),
                &[],
            )
        },
    },
    Row {
        name: "as_of",
        title: "Ask about the past",
        about: "Answers a question about the map as it stood at a revision.",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: || {
            of(
                &json!({ "revision": { "type": "integer", "minimum": 1 }, "text": text("The question") }),
                &["revision", "text"],
            )
        },
    },
    Row {
        name: "tasks",
        title: "Tasks",
        about: "What the robot does, what waits, and how the last tasks ended.",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: || of(&json!({}), &[]),
    },
    Row {
        name: "proposals",
        title: "What is elsewhere",
        about: "Things that are believed to stand elsewhere than the map says; a person confirms or rejects them.",
        needs: Role::Look,
        deed: Deed::Reads,
        takes: || of(&json!({}), &[]),
    },
    Row {
        name: "plan",
        title: "Plan a task",
        about: "Plans what the robot would do for an order in plain English or Russian, e.g. \"Bring the medicine\". Gives the plan's id, its steps, the proof that none is shorter, and what it assumes. Moves nothing.",
        needs: Role::Drive,
        deed: Deed::Adds,
        takes: || {
            of(&json!({ "text": text("The order"), "lang": { "enum": ["en", "ru"] } }), &["text"])
        },
    },
    Row {
        name: "run",
        title: "Carry out a plan",
        about: "Has the robot carry out a plan by its id, that plan and no other. A person is asked first. Refused when the map, or anything that the plan rests on, has changed since. Tells of its progress; cancelling the call stops the robot.",
        needs: Role::Drive,
        deed: Deed::Acts,
        takes: || {
            of(
                &json!({ "id": { "type": "integer", "minimum": 1, "description": "As `plan` gave it" } }),
                &["id"],
            )
        },
    },
    Row {
        name: "stop",
        title: "Stop the robot",
        about: "Stops the robot at once and drops what waits. Needs nobody's word.",
        needs: Role::Look,
        deed: Deed::Adds,
        takes: || of(&json!({}), &[]),
    },
    Row {
        name: "observe",
        title: "Note an observation",
        about: "Notes that a thing was seen at a place of its storey, or that it was not where it was expected. Changes what is believed, never the surveyed map.",
        needs: Role::Drive,
        deed: Deed::Adds,
        takes: || {
            of(
                &json!({
                    "thing": text("Name of the thing"), "x": number("cm"), "y": number("cm"), "z": number("cm above the floor; 0 without it"),
                    "angle": number("degrees; 0 without it"), "map": text("Storey; the thing's own without it"),
                    "absent": { "type": "boolean", "description": "It was not where it was expected" },
                    "sure": { "type": "number", "minimum": 0, "maximum": 1, "description": "0.9 without it" },
                }),
                &["thing"],
            )
        },
    },
    Row {
        name: "propose_edit",
        title: "Propose an edit of the map",
        about: "Checks an edit of the map (the steps of `ortho edit --file`, as JSON) and tells what it would change. A person is asked before it is written; where nobody can be asked, it is laid beside the store for the operator.",
        needs: Role::Edit,
        deed: Deed::Acts,
        takes: || {
            of(
                &json!({
                    "edit": { "type": "object", "description": "{\"edit\": [{\"move\": \"Chair 1\", \"by\": [10, 0]}]}: docs/cli.md" },
                    "reason": text("Why"), "on": { "type": "integer", "description": "The revision that it was made on; the present one without it" },
                }),
                &["edit"],
            )
        },
    },
];

fn fact() -> Value {
    of(
        &json!({
            "relation": text("Name of the relation, in Russian or English"),
            "of": { "type": "array", "items": { "type": "string" }, "description": "The names, in order" },
        }),
        &["relation", "of"],
    )
}

pub(super) fn named(name: &str) -> Option<&'static Row> {
    ROWS.iter().find(|row| row.name == name)
}

pub(super) fn names() -> impl Iterator<Item = &'static str> {
    ROWS.iter().map(|row| row.name)
}

pub(super) fn all() -> Vec<Tool> {
    let one = |row: &Row| {
        let Value::Object(schema) = (row.takes)() else { unreachable!("a schema is an object") };
        let reads = row.deed == Deed::Reads;
        let hints = ToolAnnotations::with_title(row.title)
            .read_only(reads)
            .destructive(row.deed == Deed::Acts)
            .idempotent(reads || row.name == "stop")
            .open_world(false);
        Tool::new(row.name, row.about, Arc::new(schema)).with_title(row.title).annotate(hints)
    };
    ROWS.iter().map(one).collect()
}

/// One call.
pub(super) struct Call<'c> {
    pub(super) assistant: &'c Assistant,
    pub(super) session: &'c Session,
    pub(super) request: &'c CallToolRequestParams,
    pub(super) context: &'c RequestContext<RoleServer>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Said {
    text: String,
    lang: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Query {
    query: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Named {
    name: Option<String>,
    #[serde(default = "yes")]
    picture: bool,
}

fn yes() -> bool {
    true
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct About {
    name: Option<String>,
    of: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Fact {
    relation: String,
    of: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Way {
    from: String,
    to: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Between {
    from: Option<u64>,
    to: Option<u64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Then {
    revision: u64,
    text: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Nothing {}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    id: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Seen {
    thing: String,
    x: Option<f64>,
    y: Option<f64>,
    #[serde(default)]
    z: f64,
    #[serde(default)]
    angle: f64,
    map: Option<String>,
    #[serde(default)]
    absent: bool,
    sure: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Edit {
    edit: serde_json::Map<String, Value>,
    #[serde(default)]
    reason: String,
    on: Option<u64>,
}

fn refuse(code: &str, russian: &str, english: &str) -> Fault {
    Fault::new(StatusCode::UNPROCESSABLE_ENTITY, code, russian, english)
}

fn arguments<T: DeserializeOwned>(given: Value) -> Result<T, Fault> {
    serde_json::from_value(given).map_err(|error| {
        let (ru, en) = (format!("аргументы: {error}"), format!("arguments: {error}"));
        refuse("assist::arguments", &ru, &en)
    })
}

/// The language of a line, where nobody says: that of its letters.
fn language(lang: Option<&str>, text: &str) -> Language {
    let is_russian = text
        .chars()
        .any(|c| ('а'..='я').contains(&c.to_ascii_lowercase()) || ('А'..='Я').contains(&c));
    match lang {
        Some("ru") => Language::Russian,
        Some(_) => Language::English,
        None if is_russian => Language::Russian,
        None => Language::English,
    }
}

/// What was replied, as one text.
fn said(replies: &Value) -> String {
    let all = replies.as_array().into_iter().flatten();
    all.filter_map(|reply| reply["text"].as_str()).collect::<Vec<_>>().join("\n")
}

impl Call<'_> {
    fn house(&self) -> Arc<House> {
        Arc::clone(&self.assistant.house)
    }

    pub(super) async fn run(&self, name: &str, given: Value) -> Answer {
        match name {
            "ask" => self.ask(arguments(given)?).await,
            "query" => self.query(arguments(given)?).await,
            "where_is" => self.where_is(arguments(given)?).await,
            "relations" => self.relations(arguments(given)?).await,
            "why" => self.reasons(arguments(given)?, true).await,
            "why_not" => self.reasons(arguments(given)?, false).await,
            "route" => self.route(arguments(given)?).await,
            "map" => self.map(arguments(given)?).await,
            "history" => self.history(arguments(given)?).await,
            "as_of" => self.as_of(arguments(given)?).await,
            "tasks" => {
                let Nothing {} = arguments(given)?;
                Ok(Told::Value(self.house().tasks.view()))
            }
            "proposals" => {
                let Nothing {} = arguments(given)?;
                read::proposed(&self.house()).await.map(Told::Value)
            }
            "plan" => self.plan(arguments(given)?).await,
            "run" => self.carry_out(arguments(given)?).await,
            "stop" => {
                let Nothing {} = arguments(given)?;
                let is_running = self.house().tasks.stop(&self.session.name);
                Ok(Told::Value(json!({ "stopped": is_running })))
            }
            "observe" => self.observe(arguments(given)?).await,
            "propose_edit" => self.propose_edit(arguments(given)?).await,
            other => unreachable!("the table has no {other}"),
        }
    }

    async fn ask(&self, said_: Said) -> Answer {
        let (house, session) = (self.house(), self.session.clone());
        let language = language(said_.lang.as_deref(), &said_.text);
        let heard =
            apart(move || house.tasks.answer(&session, said_.text.trim(), language)).await?;
        match heard {
            Answered::Told(mut view) => {
                view["text"] = json!(said(&view["replies"]));
                Ok(Told::Value(view))
            }
            Answered::IsOrder => Err(refuse(
                "assist::order",
                "Это приказ, а не вопрос: вызовите plan, а затем run.",
                "That is an order and no question: call plan, then run.",
            )),
        }
    }

    async fn query(&self, asked: Query) -> Answer {
        let state = self.house().desk.state();
        let found = apart(move || state.query(&asked.query, false)).await?;
        let rows: Vec<Value> = found.rows.iter().map(|row| json!(views::tuple(row))).collect();
        Ok(Told::Value(json!({
            "columns": found.columns, "rows": rows, "unknown": found.unknown,
        })))
    }

    async fn where_is(&self, named: About) -> Answer {
        let house = self.house();
        let Some(name) = named.name else {
            let live = house.events.robot();
            if !live.is_null() {
                return Ok(Told::Value(live));
            }
            let state = house.desk.state();
            let view = apart(move || {
                let now = state.now(SystemTime::now().into())?;
                let moment = Moment { time: 0.0, map: now.map, pose: now.pose };
                Ok(pose_view(&state, &moment))
            });
            return view.await.map(Told::Value);
        };
        let state = house.desk.state();
        let view = apart(move || read::about(&state, &name, Language::English));
        view.await.map(Told::Value)
    }

    async fn relations(&self, asked: About) -> Answer {
        let state = self.house().desk.state();
        let found = apart(move || {
            let facts = state.facts(asked.name.as_deref(), asked.of.as_deref())?;
            let relations = state.relations()?;
            let one = |(name, values): &(String, Vec<crate::facts::Value>)| {
                json!({
                    "relation": relations.display_name(name, Language::English),
                    "args": views::tuple(values),
                })
            };
            Ok(facts.iter().map(one).collect::<Vec<_>>())
        });
        Ok(Told::Value(json!({ "relations": found.await? })))
    }

    async fn reasons(&self, fact: Fact, expected: bool) -> Answer {
        let state = self.house().desk.state();
        let view = apart(move || {
            let of: Vec<&str> = fact.of.iter().map(String::as_str).collect();
            read::reasons(&state, &fact.relation, &of, Language::English)
        });
        let mut view = view.await?;
        if view["holds"] != json!(expected) {
            view["note"] = json!(match expected {
                true => "It does not hold; this is what was missing.",
                false => "It does hold; this is the proof.",
            });
        }
        Ok(Told::Value(view))
    }

    async fn route(&self, way: Way) -> Answer {
        let state = self.house().desk.state();
        let view = apart(move || {
            let journey = state.journey(&way.from, &way.to, Method::Shortest)?;
            Ok(views::journey(state.world()?, &journey, Language::English))
        });
        view.await.map(Told::Value)
    }

    async fn map(&self, named: Named) -> Answer {
        let state = self.house().desk.state();
        let (svg, data) = apart(move || {
            let sheets = state.sheets_named(named.name.as_deref())?;
            let (map, only) = *sheets.first().ok_or(RequestError::NoMaps)?;
            let drawing = Drawing { only, language: Language::English, ..Drawing::default() };
            let svg = if named.picture { Some(state.draw(map, &drawing)?) } else { None };
            let data = match (only, &named.name) {
                (Some(_), Some(room)) => read::about(&state, room, Language::English)?,
                _ => drawing::storey(&state, map)?,
            };
            Ok((svg, data))
        })
        .await?;
        let picture = svg.and_then(|svg| picture(&svg));
        Ok(match picture {
            Some(png) => Told::Picture(png, data),
            None => Told::Value(data),
        })
    }

    async fn history(&self, between: Between) -> Answer {
        let house = self.house();
        let view = match between.from {
            None => read::revisions(&house).await?,
            Some(from) => read::changed(&house, from, between.to).await?,
        };
        Ok(Told::Value(view))
    }

    async fn as_of(&self, then: Then) -> Answer {
        let house = self.house();
        let state = read::then(&house, then.revision).await?;
        let language = language(None, &then.text);
        let replies =
            apart(move || super::super::drive::replied(&state, then.text.trim(), language));
        let replies = replies.await?;
        Ok(Told::Value(json!({
            "revision": then.revision, "text": said(&replies), "replies": replies,
        })))
    }

    async fn plan(&self, order: Said) -> Answer {
        let (house, session) = (self.house(), self.session.clone());
        let language = language(order.lang.as_deref(), &order.text);
        let heard = apart(move || house.tasks.say(&session, order.text.trim(), language));
        let mut view = heard.await?;
        view["text"] = match view.get("task") {
            Some(task) => json!(plan_in_words(task, language)),
            None => json!(said(&view["replies"])),
        };
        Ok(Told::Value(view))
    }

    async fn carry_out(&self, plan: Plan) -> Answer {
        let house = self.house();
        let Some(task) = house.tasks.planned(plan.id) else {
            return Err(act::unknown());
        };
        let about = format!("run {}", plan.id);
        let question = plan_in_words(&task, Language::English);
        if let Some(waits) = self.approved(&about, &question).await? {
            return Ok(waits);
        }
        self.drive(plan.id).await
    }

    /// A person's yes is none; what is to be returned, where it is not there yet.
    async fn approved(&self, about: &str, question: &str) -> Result<Option<Told>, Fault> {
        let by = (self.request, self.context);
        let (asked, trusts) = (&self.assistant.asked, self.assistant.trusts_host);
        let word = ask(asked, trusts, by, about, question).await.map_err(|error| {
            let told = error.to_string();
            refuse("assist::asking", &told, &told)
        })?;
        match word {
            Word::Yes => Ok(None),
            Word::Ask(question) => Ok(Some(Told::Waits(question))),
            Word::No => Err(refuse(
                "assist::declined",
                "Человек не согласился; ничего не сделано.",
                "The person did not agree; nothing was done.",
            )),
            Word::NobodyToAsk => Err(refuse(
                "assist::nobody_to_ask",
                "Спросить некого: эта программа не умеет спрашивать человека (elicitation). Если она сама спрашивает его перед каждым вызовом, запустите сервер с --trust-client.",
                "There is nobody to ask: this client cannot ask its user (elicitation). If it asks before every call by itself, start the server with --trust-client.",
            )),
        }
    }

    async fn drive(&self, id: u64) -> Answer {
        let house = self.house();
        let mut hearing = house.events.listen();
        let (asked, session) = (Arc::clone(&house), self.session.clone());
        let begun = apart(move || Ok(asked.tasks.confirm_alone(&session, id))).await?;
        if let Err(declined) = begun {
            return Err(self.declined(declined));
        }
        let mut watch = Watch { house: &house, session: self.session, id, is_over: false };
        let token = self.context.meta.get_progress_token();
        let mut steps = 0.0;
        loop {
            let happened = tokio::select! {
                happened = house.events.next(&mut hearing) => happened,
                () = self.context.ct.cancelled() => {
                    house.tasks.cancel(self.session, id);
                    tokio::time::sleep(Duration::from_millis(50)).await;
                    Vec::new()
                }
                // Whoever drives must be heard of.
                () = tokio::time::sleep(Duration::from_secs(20)) => {
                    let _ = house.tasks.lease(self.session);
                    Vec::new()
                }
            };
            for (kind, data) in happened {
                let event: Value = serde_json::from_str(&data).unwrap_or_default();
                if event["task"] != json!(id) {
                    continue;
                }
                if kind == "task"
                    && !["queued", "running"].contains(&event["state"].as_str().unwrap_or_default())
                {
                    watch.is_over = true;
                    return Ok(Told::Value(ended(event)));
                }
                if kind == "directive"
                    && let Some(token) = &token
                {
                    steps += 1.0;
                    let told = event["en"]
                        .as_str()
                        .or(event["do_en"].as_str())
                        .or(event["explanation_en"].as_str());
                    let told = told.or(event["event"].as_str()).unwrap_or_default();
                    let progress =
                        ProgressNotificationParam::new(token.clone(), steps).with_message(told);
                    // Who has gone hears nothing; the call is cancelled then.
                    let _ = self.context.peer.notify_progress(progress).await;
                }
            }
        }
    }

    fn declined(&self, declined: Declined) -> Fault {
        let Declined::Expired(again) = declined else { return declined.into() };
        let fault = refuse(
            "assist::expired",
            "Карта или то, на чём держался план, с тех пор изменились; план не начат.",
            "The map, or what the plan rested on, has changed since; the plan was not begun.",
        );
        let replies = json!(again.replies);
        let plan = again.plan.map(|plan| {
            let text = plan["said"].as_str().unwrap_or_default().to_owned();
            self.house().tasks.propose_anew(self.session, &text, plan)
        });
        fault.with("task", json!(plan)).with("replies", replies)
    }

    async fn observe(&self, seen: Seen) -> Answer {
        let at = match (seen.absent, seen.x, seen.y) {
            (true, None, None) => None,
            (false, Some(x), Some(y)) => Some(Frame::new(x, y, seen.z, Deg::of(seen.angle))),
            _ => {
                return Err(refuse(
                    "assist::place",
                    "нужны x и y, либо absent",
                    "it takes x and y, or absent",
                ));
            }
        };
        let sure = seen.sure.unwrap_or(0.9);
        let numbers = [seen.x.unwrap_or(0.0), seen.y.unwrap_or(0.0), seen.z, seen.angle];
        if !(0.0..=1.0).contains(&sure) || numbers.iter().any(|n| !n.is_finite() || n.abs() > 1e7) {
            return Err(refuse(
                "assist::number",
                "sure – от 0 до 1, а место – в пределах здания",
                "sure is from 0 to 1, and the place within the building",
            ));
        }
        let observer = self.session.name.clone();
        let house = self.house();
        let noted = house.desk.ask(move |engine| {
            let when = SystemTime::now().into();
            match at {
                Some(frame) => {
                    let place = (seen.map.as_deref(), frame);
                    engine.observe_on_map(&seen.thing, place, sure, &observer, when)
                }
                None => engine.observe(&seen.thing, None, sure, &observer, when),
            }
        });
        noted.await?.map_err(|error| self.named(&error))?;
        house.events.tell("known", &json!({}));
        Ok(Told::Value(json!({ "outcome": "noted" })))
    }

    /// A fault with the names of the map as it is.
    fn named(&self, error: &Error) -> Fault {
        let state = self.house().desk.state();
        Fault::of(error, state.world().ok())
    }

    async fn propose_edit(&self, proposed: Edit) -> Answer {
        let house = self.house();
        let on = proposed.on.unwrap_or_else(|| house.desk.state().revision());
        let text = Value::Object(proposed.edit).to_string();
        let change = change_now(&self.session.name, &proposed.reason);
        let tried = act::edited(&house, on, text.clone(), change.clone(), Mode::DryRun).await?;
        let told = tried["differences"].as_array().into_iter().flatten();
        let told: Vec<&str> = told.filter_map(|d| d["ru"].as_str()).collect();
        let question = format!("{}\n{}", proposed.reason, told.join("\n"));
        let about = format!("edit on {on}: {text}");
        match self.approved(&about, question.trim()).await {
            Ok(Some(waits)) => return Ok(waits),
            Ok(None) => {}
            Err(fault) if fault.body()["code"] == "assist::nobody_to_ask" => {
                return self.laid_beside(on, &text, tried).await;
            }
            Err(fault) => return Err(fault),
        }
        act::edited(&house, on, text, change, Mode::Commit).await.map(Told::Value)
    }

    /// Leaves an edit that nobody could be asked about for the operator, as a file that `ortho edit --file` takes.
    async fn laid_beside(&self, on: u64, text: &str, mut tried: Value) -> Answer {
        let Some(dir) = self.assistant.proposed.clone() else {
            return Ok(Told::Value(tried));
        };
        let text = text.to_owned();
        let at =
            SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).map_or(0, |d| d.as_millis());
        let file = dir.join(format!("{on}-{at}.json"));
        let written = {
            let file = file.clone();
            tokio::task::spawn_blocking(move || {
                std::fs::create_dir_all(&dir)
                    .and_then(|()| crate::units::write_file(&file, text.as_bytes()))
            })
        };
        if let Ok(Err(error)) = written.await {
            let told = format!("{}: {error}", file.display());
            return Err(refuse("assist::disk", &told, &told));
        }
        tried["outcome"] = json!("proposed");
        tried["file"] = json!(file.display().to_string());
        tried["text"] = json!(format!(
            "The edit is sound and not written: nobody could be asked. The operator can write it by `ortho edit --file {}`.",
            file.display()
        ));
        Ok(Told::Value(tried))
    }
}

/// Has the robot stop when the call that drives it is dropped before its end.
struct Watch<'w> {
    house: &'w House,
    session: &'w Session,
    id: u64,
    is_over: bool,
}

impl Drop for Watch<'_> {
    fn drop(&mut self) {
        if !self.is_over {
            self.house.tasks.cancel(self.session, self.id);
        }
    }
}

fn ended(mut event: Value) -> Value {
    event["text"] = event["text_end"].clone();
    event
}

/// A plan as it is shown to a person.
fn plan_in_words(task: &Value, language: Language) -> String {
    let plan = &task["plan"];
    let field = |name: &str| format!("{name}{}", language.pick("", "_en"));
    let mut lines = vec![format!(
        "{}: {}",
        language.pick("Задание", "Task"),
        task["text"].as_str().unwrap_or_default()
    )];
    let directive = language.pick("do_ru", "do_en");
    let events = plan["events"].as_array().into_iter().flatten();
    let planned = events.filter(|event| event["event"] == "planned");
    let steps = planned.filter_map(|event| event["steps"].as_array()).flatten();
    let steps = steps.filter_map(|step| step.as_array()).flatten();
    for (number, step) in (1..).zip(steps) {
        lines.push(format!("{number}. {}", step[directive].as_str().unwrap_or_default()));
    }
    let assumed = plan[field("assumptions")].as_array().into_iter().flatten();
    let assumed: Vec<&str> = assumed.filter_map(Value::as_str).collect();
    if !assumed.is_empty() {
        let head = language.pick("Если так и есть", "Assuming");
        lines.push(format!("{head}: {}", assumed.join("; ")));
    }
    lines.join("\n")
}

#[cfg(feature = "pictures")]
fn picture(svg: &str) -> Option<Vec<u8>> {
    const WIDTH: u32 = 1200;
    crate::draw::png(svg, Some(WIDTH)).ok()
}

#[cfg(not(feature = "pictures"))]
fn picture(_: &str) -> Option<Vec<u8>> {
    None
}
