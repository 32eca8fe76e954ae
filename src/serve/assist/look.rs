//! What only reads: questions, relations and reasons, ways, the map, the past.

use std::sync::Arc;

use serde::Deserialize;
use serde_json::{Value, json};

use crate::engine::calls;
use crate::engine::{Drawing, Method, RequestError, json as views, rehearsal};
use crate::robot::Moment;
use crate::units::Language;

use super::super::drive::{Answered, pose_view};
use super::super::{apart, asked, drawing, read};
use super::call::{Answer, Call, Said, Told, refuse, said};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Query {
    query: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Named {
    name: Option<String>,
    #[serde(default = "yes")]
    picture: bool,
}

fn yes() -> bool {
    true
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Name {
    name: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct About {
    name: Option<String>,
    of: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Fact {
    relation: String,
    of: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Way {
    from: String,
    to: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Between {
    from: Option<u64>,
    to: Option<u64>,
    #[serde(default)]
    calls: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Then {
    revision: u64,
    text: String,
}

impl Call<'_> {
    pub(super) async fn ask(&self, question: Said) -> Answer {
        let (house, session) = (self.house(), self.session.clone());
        let language = question.language();
        let heard =
            asked(move |stop| house.tasks.answer(&session, question.text.trim(), language, stop))
                .await?;
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

    pub(super) async fn query(&self, given: Query) -> Answer {
        let state = self.house().desk.state();
        let found = asked(move |stop| state.heeding(stop).query(&given.query, false)).await?;
        let rows: Vec<Value> = found.rows.iter().map(|row| json!(views::tuple(row))).collect();
        Ok(Told::Value(json!({
            "columns": found.columns, "rows": rows, "unknown": found.unknown,
        })))
    }

    pub(super) async fn where_is(&self, named: Name) -> Answer {
        let house = self.house();
        let Some(name) = named.name else {
            let live = house.events.robot();
            if !live.is_null() {
                return Ok(Told::Value(live));
            }
            let state = house.desk.state();
            let view = apart(move || {
                let (map, pose) = state.robot()?;
                let moment = Moment { time: 0.0, map, pose };
                Ok(pose_view(&state, &moment))
            });
            return view.await.map(Told::Value);
        };
        let state = house.desk.state();
        let view = apart(move || read::about(&state, &name, Language::English));
        view.await.map(Told::Value)
    }

    pub(super) async fn relations(&self, about: About) -> Answer {
        let state = self.house().desk.state();
        let found = apart(move || {
            let facts = state.facts(about.name.as_deref(), about.of.as_deref())?;
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

    pub(super) async fn reasons(&self, fact: Fact, expected: bool) -> Answer {
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

    pub(super) async fn route(&self, way: Way) -> Answer {
        let state = self.house().desk.state();
        let view = apart(move || {
            let journey = state.journey(&way.from, &way.to, Method::Shortest)?;
            Ok(views::journey(state.world()?, &journey, Language::English))
        });
        view.await.map(Told::Value)
    }

    pub(super) async fn map(&self, named: Named) -> Answer {
        let state = self.house().desk.state();
        let (svg, data) = apart(move || {
            let sheets = state.sheets_named(named.name.as_deref())?;
            let (map, only) = *sheets.first().ok_or(RequestError::NoMaps)?;
            let drawing = Drawing { only, language: Language::English, ..Drawing::default() };
            let svg = if named.picture { Some(state.draw(map, &drawing)?) } else { None };
            let data = match (only, &named.name) {
                (Some(_), Some(room)) => read::about(&state, room, Language::English)?,
                _ => drawing::storey(&state, map, drawing::Part::Whole { most: usize::MAX })?,
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

    pub(super) async fn history(&self, between: Between) -> Answer {
        let house = self.house();
        let mut view = match between.from {
            None => read::revisions(&house).await?,
            Some(from) => read::changed(&house, from, between.to).await?,
        };
        if let Some(file) = self.assistant.calls.file.clone().filter(|_| between.calls) {
            let (calls, _) = apart(move || Ok(calls::noted(&file)?)).await?;
            view["calls"] = json!(calls);
        }
        Ok(Told::Value(view))
    }

    pub(super) async fn as_of(&self, then: Then) -> Answer {
        let house = self.house();
        let state = read::then(&house, then.revision).await?;
        let language = Language::of(&then.text);
        let replies = asked(move |stop| {
            rehearsal::replied(&Arc::new(state.heeding(stop)), then.text.trim(), language)
        });
        let replies = replies.await?;
        Ok(Told::Value(json!({
            "revision": then.revision, "text": said(&replies), "replies": replies,
        })))
    }
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
