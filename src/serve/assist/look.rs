//! What only reads: questions, relations and reasons, ways, the map, the past.

use std::sync::Arc;

use crate::engine::calls;
use crate::engine::{Drawing, Method, RequestError, json as views, rehearsal};
use crate::robot::Moment;
use crate::units::{Language, said};
use serde::Deserialize;

use super::super::drive::Answered;
use super::super::{apart, asked, read};
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
            Answered::Told(view) => {
                let text = said(&view["replies"]);
                Ok(Told::Value(views::with_text(view, &text)))
            }
            Answered::IsOrder => Err(refuse("assist::order", said!("that-is-an-order-and"))),
        }
    }

    pub(super) async fn query(&self, given: Query) -> Answer {
        let state = self.house().desk.state();
        let view = asked(move |stop| {
            let state = state.heeding(stop);
            let found = state.query(&given.query, false)?;
            views::query(&state, &found, false, Language::English)
        });
        view.await.map(Told::Value)
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
                Ok(views::robot(&state, &moment))
            });
            return view.await.map(Told::Value);
        };
        let state = house.desk.state();
        let view = apart(move || views::about(&state, &name, Language::English));
        view.await.map(Told::Value)
    }

    pub(super) async fn relations(&self, about: About) -> Answer {
        let state = self.house().desk.state();
        let view = apart(move || {
            let (name, of) = (about.name.as_deref(), about.of.as_deref());
            views::facts(&state, name, of, Language::English)
        });
        view.await.map(Told::Value)
    }

    pub(super) async fn reasons(&self, fact: Fact, expected: bool) -> Answer {
        let state = self.house().desk.state();
        let view = apart(move || {
            let of: Vec<&str> = fact.of.iter().map(String::as_str).collect();
            views::reasons(&state, &fact.relation, &of, Language::English)
        });
        let view = view.await?;
        let note = match expected {
            true => "It does not hold; this is what was missing.",
            false => "It does hold; this is the proof.",
        };
        let is_as_asked = view["holds"] == expected;
        Ok(Told::Value(if is_as_asked { view } else { views::with_note(view, note) }))
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
                (Some(_), Some(room)) => views::about(&state, room, Language::English)?,
                _ => views::storey(&state, map, views::Part::Whole { most: usize::MAX })?,
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
            view = views::with_calls(view, &calls);
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
        Ok(Told::Value(views::of_the_past(then.revision, &said(&replies), &replies)))
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
