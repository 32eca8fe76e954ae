//! Engine values as JSON, for all faces alike. The field names are documented in docs/cli.md and stay.

mod faults;
mod known;
mod numbers;
mod proofs;
mod segments;

pub use faults::faults;
pub use known::{believed, changed, differences, edited, facts, revision, story};
pub use proofs::{query, why};
pub use segments::{ends, log_faults};

use serde::Serialize;
use serde_json::{Value, json};

use super::differences::{Differing, ThingNews};
use super::{
    Answer, Changes, Engine, Error, FoundScan, Heard, Journey, Outcome as Heeded, PlanStep, Queue,
    Relations, Replanned, Reply, ReportView, RouteAnswer, Solved, TaskAnswer, TaskEnding, Things,
    Unanswered, View, Whereabout, World, face_in_words, name_in, no_way_in_words, steps,
    surprise_in_words,
};
use crate::facts;
use crate::geometry::{FaceInView, PassframeId, Remedy, Ride, Route};
use crate::graphplan::{Attempt, Limit, NoPlanReason, Outcome, Way};
use crate::language::Language;
use crate::map::{DoorStatus, Entity};
use crate::robot::{Reason, Refused, Shortness};
use crate::semantics::Spot;
use crate::strips::{Preference, Replayed, Said, Wording};
use crate::units::{AreaId, ReplicaId};
use crate::vectors::Segment;

use numbers::{point, pose, round};
use segments::segment;

#[derive(Debug, Serialize)]
struct StepView {
    action: String,
    args: Vec<String>,
}

/// `name` gives the English names of objects.
pub fn plan(solved: &Solved, name: &dyn Fn(&str) -> String) -> Value {
    let english = solved.wording(Language::English, name);
    let steps: Vec<Vec<StepView>> = steps(solved)
        .into_iter()
        .map(|step| {
            step.into_iter().map(|PlanStep { action, args }| StepView { action, args }).collect()
        })
        .collect();
    let mut view = json!({
        "outcome": outcome(&solved.outcome),
        "parallel_steps": steps.len(),
        "actions": steps.iter().map(Vec::len).sum::<usize>(),
        "steps": steps,
        "optimal": solved.is_shortest && matches!(solved.outcome, Outcome::Plan(_)),
        "assumptions": solved.assumptions.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "assumptions_en": solved.assumptions_with(&english),
        "explanation": solved.explanation(Language::Russian),
        "explanation_en": solved.explanation_with(&english),
    });
    if solved.is_of_whole_actions {
        view["whole_actions"] = json!(true);
    }
    if let Some(time) = solved.time {
        let seconds = |hundredths: u64| hundredths as f64 / 100.0;
        view["seconds"] = json!(seconds(time.takes));
        view["at_least_seconds"] = json!(seconds(time.at_least));
        view["quickest"] = json!(time.is_least());
    }
    if let Some(wishes) = &solved.wishes {
        let told = |all: &[Preference]| -> Vec<Value> {
            let weight = |thousandths: u64| thousandths as f64 / 1000.0;
            all.iter().map(|one| json!({"name": one.name, "weight": weight(one.weight)})).collect()
        };
        view["preferences"] = json!({
            "met": told(&wishes.met),
            "unmet": told(&wishes.unmet),
            "proven_least": wishes.is_least,
        });
    }
    if let Some(Reason::NoWay(refused)) = &solved.reason {
        let refused = refused.iter().map(|Refused { action, why }| {
            let why = |language| why.as_ref().map(|why| why.say(language));
            json!({
                "action": action.to_string(),
                "action_en": english.action(action),
                "explanation": why(Language::Russian),
                "explanation_en": why(Language::English),
            })
        });
        view["no_way"] = refused.collect();
    }
    match &solved.outcome {
        Outcome::NoPlan { leveled_off_at, reason } => {
            let fact = |id: &_| solved.task.fact(*id).to_string();
            view["leveled_off_at"] = json!(leveled_off_at);
            view["reason"] = match reason {
                NoPlanReason::Unreachable(facts) => {
                    json!({"unreachable": facts.iter().map(fact).collect::<Vec<_>>()})
                }
                NoPlanReason::Exclusive(pairs) => {
                    json!({"exclusive": pairs.iter().map(|(a, b)| [fact(a), fact(b)]).collect::<Vec<_>>()})
                }
                NoPlanReason::Together(facts) => {
                    json!({"together": facts.iter().map(fact).collect::<Vec<_>>()})
                }
            };
        }
        Outcome::LimitReached(known) => {
            view["limit"] = json!(match known.limit {
                Limit::Time => "time",
                Limit::Memory => "memory",
                Limit::Steps => "steps",
                Limit::Stopped => "stopped",
                Limit::Effort => "effort",
            });
            view["at_least_steps"] = json!(known.at_least);
            view["at_most_steps"] = json!(known.plan.as_ref().map(|plan| plan.steps.len()));
            view["tried"] = known.tried.iter().map(tried).collect();
        }
        Outcome::Plan(_) if !solved.is_shortest && solved.time.is_none() => {
            view["at_least_steps"] = json!(solved.at_least);
        }
        Outcome::Plan(_) => {}
    }
    view
}

/// A way that was tried, and how far it came.
fn tried(attempt: &Attempt) -> Value {
    let Attempt { way, times, levels, nodes, effort } = attempt;
    let way = match way {
        Way::Grounding => "grounding",
        Way::Graph => "graph",
        Way::Proof => "proof",
        Way::Forward => "forward",
    };
    json!({"way": way, "times": times, "levels": levels, "nodes": nodes, "effort": effort})
}

/// Why no plan has fewer steps.
pub fn shortness(why: &Shortness, english: &Wording<'_>) -> Value {
    let fact = |fact: &Said| json!({"fact": fact.to_string(), "fact_en": english.fact(fact)});
    let alone = why.alone.iter().map(|(goal, steps)| {
        json!({"goal": goal.to_string(), "goal_en": english.fact(goal), "parallel_steps": steps})
    });
    json!({
        "one_after_the_other": why.row.iter().map(fact).collect::<Vec<_>>(),
        "goals_alone": alone.collect::<Vec<_>>(),
    })
}

/// The plan after assumptions were withdrawn, and what became of the one before.
pub fn replanned(replanned: &Replanned, name: &dyn Fn(&str) -> String) -> Value {
    let before = steps(&replanned.before);
    let mut view = plan(&replanned.after, name);
    view["withdrawn"] =
        json!(replanned.withdrawn.iter().map(ToString::to_string).collect::<Vec<_>>());
    view["before"] = json!({
        "outcome": outcome(&replanned.before.outcome),
        "parallel_steps": before.len(),
        "actions": before.iter().map(Vec::len).sum::<usize>(),
        "rested_on_it": replanned.rested_on(),
    });
    view["learned_before"] = json!(replanned.learned_before);
    view
}

/// A plan carried out, as far as it goes.
pub fn replayed(replayed: &Replayed) -> Value {
    let steps: Vec<Value> = replayed
        .steps
        .iter()
        .map(|(step, directives)| {
            let actions: Vec<StepView> = directives
                .iter()
                .map(|d| StepView { action: d.action.clone(), args: d.args.clone() })
                .collect();
            json!({"step": step, "actions": actions})
        })
        .collect();
    let broken = replayed.broken.as_ref().map(|broken| {
        let faults: Vec<Value> = broken
            .faults
            .0
            .iter()
            .map(|fault| {
                let code = miette::Diagnostic::code(fault).map(|code| code.to_string());
                let place = fault.position();
                json!({
                    "code": code,
                    "message": fault.error.to_string(),
                    "message_en": fault.error.english(),
                    "line": place.map(|(_, line, _)| line),
                    "column": place.map(|(_, _, column)| column),
                })
            })
            .collect();
        json!({"step": broken.step, "faults": faults})
    });
    json!({
        "outcome": if broken.is_none() { "sound" } else { "broken" },
        "parallel_steps": replayed.steps.len(),
        "cost": serde_json::from_str::<serde_json::Number>(&replayed.cost_shown()).ok(),
        "steps": steps,
        "broken": broken,
    })
}

pub(super) fn outcome(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Plan(_) => "plan",
        Outcome::NoPlan { .. } => "no_plan",
        Outcome::LimitReached(_) => "limit",
    }
}

pub fn counts(relations: &Relations) -> Value {
    let rows: Vec<Value> = relations
        .counts()
        .into_iter()
        .map(|c| json!({"name": c.name, "name_en": c.name_en, "count": c.count}))
        .collect();
    json!({ "relations": rows })
}

pub fn tuple(values: &[facts::Value]) -> Vec<Value> {
    values
        .iter()
        .map(|value| match value {
            facts::Value::Symbol(symbol) => json!(symbol.as_ref()),
            other => other
                .to_string()
                .parse::<i64>()
                .map_or_else(|_| json!(other.to_string()), |n| json!(n)),
        })
        .collect()
}

pub fn route(world: &World, answer: &RouteAnswer, language: Language) -> Value {
    let mut view = json!({
        "from": answer.from,
        "to": answer.to,
        "map": world.maps[&answer.map].name,
    });
    match &answer.route {
        Ok(route) => {
            view["outcome"] = json!("route");
            view["areas"] =
                json!(answer.stages.iter().map(|s| &world.areas[&s.area].name).collect::<Vec<_>>());
            merge(&mut view, way(world, route, &answer.chain));
        }
        Err(why) => {
            view["outcome"] = json!("no_route");
            view["explanation"] = json!(no_way_in_words(world, why, language));
        }
    }
    view
}

/// What would open a way: doors to open, and what is to be done once they are.
fn remedy(world: &World, remedy: &Remedy) -> Value {
    let name = |entity: Entity| world.name(entity).to_owned();
    let thing = |id: &ReplicaId| name(Entity::Replica(*id));
    let (Remedy::Open(open)
    | Remedy::Move { open, .. }
    | Remedy::Shut { open, .. }
    | Remedy::Remove { open, .. }) = remedy;
    let open: Vec<String> = open.iter().map(|&door| name(Entity::Door(door))).collect();
    let mut view = json!({ "open": open });
    match remedy {
        Remedy::Open(_) => {}
        Remedy::Move { replica, by, .. } => {
            view["move"] = json!({ "thing": thing(replica), "by": [round(by.x), round(by.y)] });
        }
        Remedy::Shut { door, of, .. } => {
            let of = of.as_ref().map(thing);
            view["shut"] = json!({ "door": name(Entity::Door(*door)), "of": of });
        }
        Remedy::Remove { replicas, .. } => {
            view["remove"] = json!(replicas.iter().map(thing).collect::<Vec<_>>());
        }
    }
    view
}

/// A face in view.
pub fn face(world: &World, view: &FaceInView, language: Language) -> Value {
    json!({
        "face": face_in_words(world, &view.face, language),
        "area_cm2": round(view.area),
        "whole_cm2": round(view.whole),
        "distance_cm": round(view.distance),
    })
}

/// A single leg as [`route`] gives it; several as a list of those, with the rides between them.
pub fn journey(world: &World, journey: &Journey, language: Language) -> Value {
    let opens: Vec<&str> =
        journey.opens.iter().map(|door| world.name(Entity::Door(*door))).collect();
    if let [leg] = &journey.legs[..] {
        let mut view = route(world, leg, language);
        if !opens.is_empty() {
            view["opens"] = json!(opens);
        }
        if let Some(advice) = &journey.advice {
            view["advice"] = json!(advice.in_words(world, language));
            view["remedy"] = remedy(world, &advice.remedy);
        }
        return view;
    }
    let ride = |ride: &Ride| {
        json!({
            "lift": world.domain.lifts[ride.lift].0,
            "from": world.areas[&ride.from].name,
            "to": world.areas[&ride.to].name,
            "rise_cm": round(ride.rise),
        })
    };
    let length = |leg: &RouteAnswer| leg.route.as_ref().map_or(0.0, |r| r.length);
    let mut view = json!({
        "outcome": "route",
        "length_cm": round(journey.legs.iter().map(length).sum()),
        "legs": journey.legs.iter().map(|leg| route(world, leg, language)).collect::<Vec<_>>(),
        "rides": journey.rides.iter().map(ride).collect::<Vec<_>>(),
    });
    if !opens.is_empty() {
        view["opens"] = json!(opens);
    }
    view
}

fn way(world: &World, route: &Route, chain: &[(AreaId, PassframeId)]) -> Value {
    let moved = |m: &Option<crate::geometry::Moved>| {
        m.as_ref().map(|m| json!({"from": point(m.from), "to": point(m.to)}))
    };
    json!({
        "length_cm": round(route.length),
        "points": route.points.iter().map(|&p| point(p)).collect::<Vec<_>>(),
        "heading_deg": route.heading.map(|h| round(h.get())),
        "passframes": chain
            .iter()
            .map(|(area, id)| json!({"area": world.areas[area].name, "id": id.to_string()}))
            .collect::<Vec<_>>(),
        "moved_start": moved(&route.moved_start),
        "moved_goal": moved(&route.moved_goal),
    })
}

/// Where scans can have been taken.
#[must_use]
pub fn found_scans(world: &World, found: &[FoundScan]) -> Value {
    let scan = |found: &FoundScan| {
        let poses = found.poses.iter().map(|at| {
            json!({
                "pose": pose(at.pose),
                "deviation_cm": round(at.deviation.0),
                "deviation_deg": at.deviation.1,
                "explained": at.explained,
                "through": at.through,
                "place": at.place.as_ref().map(|place| whereabout(world, place)),
            })
        });
        json!({
            "scan": found.scan,
            "line": found.line,
            "found": match (found.is_unique, found.poses.is_empty()) {
                (true, _) => "unique",
                (false, false) => "ambiguous",
                (false, true) => "unknown",
            },
            "event": found.event(),
            "telling_move": found.telling.map(|by| json!({
                "turn_deg": round(by.turn.to_degrees()),
                "ahead_cm": round(by.ahead),
                "tells": by.tells,
            })),
            "poses": poses.collect::<Vec<_>>(),
        })
    };
    json!({"outcome": "scans", "found": found.iter().map(scan).collect::<Vec<_>>()})
}

/// What scans see that a map has otherwise.
#[must_use]
pub fn differing(world: &World, seen: &Differing) -> Value {
    let place = |seen: &crate::store::Seen| {
        json!({
            "area": world.name(Entity::Area(seen.area)),
            "x": round(seen.frame.x.get()),
            "y": round(seen.frame.y.get()),
            "angle": round(seen.frame.angle.get()),
        })
    };
    let things = seen.things.iter().map(|(id, (news, sure))| {
        let (kind, to) = match news {
            ThingNews::There => ("there", None),
            ThingNews::Missed => ("missed", None),
            ThingNews::Moved(to) => ("moved", Some(place(to))),
        };
        json!({"thing": world.name(Entity::Replica(*id)), "seen": kind, "place": to, "sure": sure})
    });
    let doors = seen.doors.iter().map(|(id, news)| {
        json!({
            "door": world.name(Entity::Door(*id)),
            "open": news.state.status == DoorStatus::Open,
            "opening": round(news.state.opening),
            "least": news.between.0,
            "most": news.between.1,
            "as_mapped": news.is_as_mapped,
            "sure": news.sure,
        })
    });
    let obstacles = seen.obstacles.iter().map(|obstacle| {
        let piece = |piece: &Vec<crate::units::Point>| {
            piece.iter().map(|p| json!([round(p.x), round(p.y)])).collect::<Vec<_>>()
        };
        json!({
            "area": world.name(Entity::Area(obstacle.area)),
            "pieces": obstacle.pieces.iter().map(piece).collect::<Vec<_>>(),
            "top": round(obstacle.top),
            "sure": obstacle.sure,
        })
    });
    json!({
        "outcome": "differences",
        "scans": seen.scans,
        "held": seen.held,
        "things": things.collect::<Vec<_>>(),
        "doors": doors.collect::<Vec<_>>(),
        "obstacles": obstacles.collect::<Vec<_>>(),
        "gone": seen.gone.len(),
    })
}

pub fn whereabout(world: &World, found: &Whereabout) -> Value {
    let terms = &found.terms;
    let map = &world.maps[&found.map];
    let mut view = json!({
        "map": map.name,
        "frame": Some(&map.frame).filter(|frame| !frame.is_empty()),
        "pose": pose(found.pose),
        "area": world.areas[&terms.area].name,
        "ru": found.position.say(Language::Russian),
        "en": found.position.say(Language::English),
    });
    let spot = match terms.spot {
        Spot::InDoorway(way) => json!({"kind": "in_doorway", "way": self::passage(world, &way)}),
        Spot::AtDoor { way, distance } => {
            json!({"kind": "at_door", "way": self::passage(world, &way), "distance_cm": round(distance)})
        }
        Spot::On { replica } => {
            json!({"kind": "on", "thing": world.name(Entity::Replica(replica))})
        }
        Spot::NextTo { replica, distance } => {
            json!({"kind": "next_to", "thing": world.name(Entity::Replica(replica)), "distance_cm": round(distance)})
        }
        Spot::InCorner => json!({"kind": "in_corner"}),
        Spot::AlongWall => json!({"kind": "along_wall"}),
        Spot::InMiddle => json!({"kind": "in_middle"}),
        Spot::Inside => json!({"kind": "inside"}),
    };
    view["spot"] = spot;
    view
}

fn passage(world: &World, way: &crate::semantics::Way) -> Value {
    json!({
        "door": way.door.map(|d| world.name(Entity::Door(d))),
        "is_passage": way.is_passage,
        "from": world.name(Entity::Area(way.from)),
        "to": way.to.map(|a| world.name(Entity::Area(a))),
    })
}

/// What a dialogue replied: an answer with its rule and proofs, a task with its steps, else the outcome and its words.
///
/// # Errors
/// As [`State::ask`](crate::engine::State::ask).
pub fn reply(engine: &Engine, reply: &Reply) -> Result<Value, Error> {
    Ok(match &reply.outcome {
        Heeded::Answered(found) => answer(engine, found)?,
        Heeded::Unanswered(unanswered) => doubt(unanswered),
        Heeded::Task(done) => task(engine.world()?, done),
        Heeded::Queued { task } | Heeded::Begun { task } => {
            json!({ "outcome": reply.outcome.word(), "task": task, "text": reply.text })
        }
        Heeded::Cancelled { tasks } => {
            json!({ "outcome": reply.outcome.word(), "tasks": tasks, "text": reply.text })
        }
        Heeded::Waits(waiting) => {
            let mut view = queue(waiting);
            view["outcome"] = json!(reply.outcome.word());
            view["text"] = json!(reply.text);
            view
        }
        other => json!({ "outcome": other.word(), "text": reply.text }),
    })
}

/// The tasks that wait.
pub fn queue(queue: &Queue) -> Value {
    let tasks = queue.tasks.iter().map(|task| {
        json!({
            "task": task.id, "text": task.text, "by": task.by, "at": task.at.to_string(),
            "is_begun": task.is_begun,
        })
    });
    json!({
        "tasks": tasks.collect::<Vec<_>>(),
        "paused": queue.paused.map(|at| at.to_string()),
    })
}

/// All that came of a line, in its order.
///
/// # Errors
/// As [`State::ask`](crate::engine::State::ask).
pub fn heard(engine: &Engine, heard: &Heard) -> Result<Vec<Value>, Error> {
    heard.replies.iter().map(|one| reply(engine, one)).collect()
}

/// The answer as data: outcome, query, bindings, facts with their proofs.
///
/// # Errors
/// As [`State::ask`](crate::engine::State::ask).
pub fn answer(engine: &Engine, answer: &Answer) -> Result<Value, Error> {
    let mut facts = Vec::new();
    for fact in answer.facts.iter().take(20) {
        facts.push(json!({
            "relation": fact.relation,
            "args": fact.args,
            "holds": fact.holds,
            "proof": engine.proof_of(fact, answer.language)?,
        }));
    }
    Ok(json!({
        "outcome": answer.said.word(),
        "kind": answer.query.kind(),
        "rule": engine.rule_of(answer)?,
        "bindings": answer.symbols,
        "number": answer.number,
        "facts": facts,
        "text": answer.text,
    }))
}

/// Why there is no answer, and what may have been meant.
pub fn doubt(unanswered: &Unanswered) -> Value {
    json!({
        "outcome": unanswered.doubt.kind(),
        "candidates": unanswered.names,
        "text": unanswered.text,
    })
}

/// A task carried out, or shown impossible.
pub fn task(world: &World, answer: &TaskAnswer) -> Value {
    let goal: Vec<Value> =
        answer.goal.iter().map(|g| json!({"predicate": g.predicate, "args": g.args})).collect();
    let mut view = json!({
        "outcome": answer.word(),
        "map": world.maps[&answer.map].name,
        "goal": goal,
        "start": pose(answer.start),
        "end": pose(answer.end),
        "end_map": world.maps[&answer.end_map].name,
        "seconds": round(answer.seconds),
        "length_cm": round(answer.reports.iter().map(|r| r.length).sum()),
        "replans": answer.replans,
        "directives": answer.reports.iter().map(|r| ReportView::of(world, r)).collect::<Vec<_>>(),
    });
    match &answer.ending {
        TaskEnding::NoPlan(planned) => {
            let name = |name: &str| name_in(world, name, Language::English);
            view["plan"] = plan(&planned.solved, &name);
        }
        TaskEnding::Stuck(surprise) => {
            view["explanation"] = json!(surprise_in_words(world, surprise, Language::Russian));
            view["explanation_en"] = json!(surprise_in_words(world, surprise, Language::English))
        }
        TaskEnding::Failed(failure) => {
            view["code"] = json!(miette::Diagnostic::code(failure).map(|code| code.to_string()));
            view["explanation"] = json!(failure.say(Language::Russian));
            view["explanation_en"] = json!(failure.say(Language::English));
        }
        TaskEnding::Done | TaskEnding::AlreadyTrue | TaskEnding::Stopped => {}
    }
    if !answer.left.is_empty() {
        let left = answer.left.iter().map(|(goal, _)| json!(goal.args)).collect::<Vec<_>>();
        view["left"] = json!(left);
    }
    if answer.not_begun > 0 {
        view["not_begun"] = json!(answer.not_begun);
    }
    if let Some(position) = &answer.reported {
        view["ru"] = json!(position.say(Language::Russian));
        view["en"] = json!(position.say(Language::English));
    }
    view
}

/// The segments of a scan or a picture.
pub fn view(view: &View) -> Value {
    json!({
        "outcome": "segments",
        "unit": if view.is_picture { "px" } else { "cm" },
        "scan": view.scan,
        "line": (!view.is_picture).then_some(view.line),
        "beams": view.beams,
        "returned": view.returns.len(),
        "pose": view.pose.map(pose),
        "segments": view.segments.iter().map(segment).collect::<Vec<_>>(),
        "points": view.points.iter().map(|p| json!([round(p.x), round(p.y)])).collect::<Vec<_>>(),
    })
}

/// The things of a log, a scan or a picture; each with its place and its segments in its own frame.
pub fn things(things: &Things) -> Value {
    let scene = &things.scene;
    let thing = |(at, thing): (usize, &crate::vectors::Thing<2>)| {
        let frame = scene.frames()[at].translation.vector;
        let leaves = scene.leaves(at);
        let of_leaf = |leaf: &crate::vectors::Leaf<'_, 2>| -> Vec<Value> {
            let told = |(k, s): (usize, &Segment<2>)| {
                let mut view = segment(s);
                let counts = leaf.model.membership(k);
                view["seen"] = json!(counts.seen);
                view["expected"] = json!(counts.expected);
                view["probability"] = json!(round(counts.probability()));
                view
            };
            leaf.model.segments().iter().enumerate().map(told).collect()
        };
        json!({
            "id": thing.id.0,
            "at": point(frame.into()),
            "segments": leaves.iter().flat_map(of_leaf).collect::<Vec<_>>(),
        })
    };
    json!({
        "outcome": "things",
        "unit": if things.is_picture { "px" } else { "cm" },
        "views": things.views,
        "without_pose": things.without_pose,
        "things": scene.things().iter().enumerate().map(thing).collect::<Vec<_>>(),
    })
}

/// Two scans: which segment is which, what moved by itself, what is new or not found again.
pub fn changes(changes: &Changes) -> Value {
    let found = &changes.difference;
    let part = |part: &crate::vectors::RigidPart<2>| {
        let motion = part.motion.isometry;
        json!({
            "pairs": part.members,
            "shift": point(motion.translation.vector.into()),
            "turn_deg": round(motion.rotation.angle().to_degrees()),
        })
    };
    json!({
        "outcome": "changes",
        "before": view(&changes.before),
        "after": view(&changes.after),
        "pairs": found.pairs.iter().map(|&(was, is, _)| [was, is]).collect::<Vec<_>>(),
        "parts": found.parts.iter().map(part).collect::<Vec<_>>(),
        "vanished": found.vanished,
        "appeared": found.appeared,
        "comparisons": found.counters.comparisons(),
    })
}

fn merge(view: &mut Value, more: Value) {
    if let (Value::Object(view), Value::Object(more)) = (view, more) {
        view.extend(more);
    }
}
