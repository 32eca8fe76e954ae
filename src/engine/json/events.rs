//! What happens while a task is driven, as data: one JSON object after another, each with its name in the field `event`
//! (docs/cli.md lists the fields, which stay).
//!
//! ```
//! use orthoframe::Engine;
//! use orthoframe::engine::TaskEvents;
//! use orthoframe::World;
//!
//! let engine = Engine::in_memory(World::load("maps/rb2.toml").unwrap(), None).unwrap();
//! let (mut events, mut names) = (TaskEvents::default(), Vec::new());
//! engine.perform("Поезжай к Точке-К", &mut |progress| {
//!     let Some(event) = events.of(engine.world().unwrap(), progress) else { return };
//!     names.push(event["event"].as_str().unwrap().to_owned());
//! }).unwrap();
//! assert_eq!(names[..3], ["planned", "started", "arrived"]);
//! ```

use serde::Serialize;
use serde_json::{Value, json};

use crate::engine::assumed::assumptions_in_russian;
use crate::engine::surprises::barred_in_words;
use crate::engine::{
    Progress, Report, actions_in_words, directive_in_words, name_in, surprise_in_words,
};
use crate::graphplan::Outcome;
use crate::language::Language;
use crate::map::{Entity, World};
use crate::robot::{Barred, Directive, Planned, Primitive, Refusal, Surprise};
use crate::units::ReplicaId;

use super::values::{point, pose, round};

/// One thing that happened on the way.
#[derive(Debug, Serialize)]
#[serde(tag = "event", rename_all = "snake_case")]
enum TaskEvent {
    /// A goal has a plan, or is shown to have none.
    Planned(PlanView),
    /// The same after a surprise.
    Replanned(PlanView),
    /// A directive is begun.
    Started {
        /// Counts from 1 over all directives of the plan in force.
        number: usize,
        of: usize,
        #[serde(flatten)]
        directive: DirectiveView,
    },
    /// A directive that drives is done.
    Arrived(ReportView),
    /// A directive that does something where the robot stands is done.
    Done(ReportView),
    /// The world is not as believed.
    Surprised {
        /// `blocked`, `not_there`, `refused`, `no_way`, `unknown`, `not_seen` or `no_return`.
        kind: &'static str,
        /// What stood in the way or would not, where it is something of the map.
        thing: Option<String>,
        explanation: String,
        explanation_en: String,
        #[serde(flatten)]
        directive: DirectiveView,
    },
    /// Something bars the only way, and the operator is asked to clear it.
    Barred {
        /// Things of the map; none where what stands there is on no map.
        things: Vec<String>,
        area: String,
        map: String,
        /// Where it stands, cm.
        x: f64,
        y: f64,
        /// The door or place to which it bars the way.
        to: Option<String>,
        explanation: String,
        explanation_en: String,
    },
}

/// A directive in names and in words.
#[derive(Debug, Serialize)]
struct DirectiveView {
    action: String,
    args: Vec<String>,
    do_ru: String,
    do_en: String,
}

/// A plan, as far as who follows the drive cares.
#[derive(Debug, Serialize)]
struct PlanView {
    /// `plan`, `no_plan` or `limit`.
    outcome: &'static str,
    /// The facts that are wanted, as the rule language writes them.
    goal: Vec<String>,
    /// Parallel steps, empty where there is no plan.
    steps: Vec<Vec<DirectiveView>>,
    /// Proven: no plan has fewer parallel steps. None where there is no plan, or one by driven time.
    at_least_steps: Option<usize>,
    /// So many the plan that is known has, where one is.
    at_most_steps: Option<usize>,
    /// With a plan by driven time: how long it takes, and what none takes less than.
    seconds: Option<f64>,
    at_least_seconds: Option<f64>,
    assumptions: Vec<String>,
    assumptions_ru: Vec<String>,
    assumptions_en: Vec<String>,
    /// Why there is no plan.
    explanation: Option<String>,
    explanation_en: Option<String>,
}

/// A directive that is done, and where the robot then is.
#[derive(Debug, Serialize)]
pub(super) struct ReportView {
    do_ru: String,
    do_en: String,
    /// Sentences on what was switched, found, put away, and who was called.
    done_ru: Vec<String>,
    done_en: Vec<String>,
    number: usize,
    action: String,
    args: Vec<String>,
    map: String,
    pose: Value,
    length_cm: f64,
    seconds: f64,
    points: Vec<[f64; 2]>,
    /// The report of the position; none outside of every room.
    ru: Option<String>,
    en: Option<String>,
}

/// Makes events of the progress of one task.
#[derive(Debug, Default)]
pub struct TaskEvents {
    surprised: bool,
}

impl TaskEvents {
    /// The event for what has just happened, if it is one: a way, a pose on it and a scan are none. To be asked once for
    /// each, in order.
    pub fn of(&mut self, world: &World, progress: &Progress<'_>) -> Option<Value> {
        self.event(world, progress).map(|event| json!(event))
    }

    fn event(&mut self, world: &World, progress: &Progress<'_>) -> Option<TaskEvent> {
        Some(match progress {
            Progress::Sent { .. } | Progress::Moved(_) | Progress::Scanned(_) => return None,
            Progress::Planned(planned) => {
                let plan = PlanView::of(world, planned);
                match std::mem::take(&mut self.surprised) {
                    true => TaskEvent::Replanned(plan),
                    false => TaskEvent::Planned(plan),
                }
            }
            Progress::Started { number, of, directive } => TaskEvent::Started {
                number: *number,
                of: *of,
                directive: DirectiveView::of(world, directive),
            },
            Progress::Finished(report) => {
                let view = ReportView::of(world, report);
                let drives = |primitive: &Primitive| {
                    matches!(
                        primitive,
                        Primitive::GoToPlace(_)
                            | Primitive::GoToDoor(_)
                            | Primitive::Cross { .. }
                            | Primitive::Ride { .. }
                    )
                };
                match report.directive.primitives().iter().any(drives) {
                    true => TaskEvent::Arrived(view),
                    false => TaskEvent::Done(view),
                }
            }
            Progress::Barred { barred, .. } => {
                self.surprised = true;
                barred_event(world, barred)
            }
            Progress::Surprised { directive, surprise } => {
                self.surprised = true;
                let told = |language| surprise_in_words(world, surprise, language);
                TaskEvent::Surprised {
                    kind: kind(surprise),
                    thing: thing(world, surprise),
                    explanation: told(Language::Russian),
                    explanation_en: told(Language::English),
                    directive: DirectiveView::of(world, directive),
                }
            }
        })
    }
}

fn barred_event(world: &World, barred: &Barred) -> TaskEvent {
    let name = |id: &ReplicaId| world.replicas.get(id).map(|thing| thing.name.clone());
    let round = |value: f64| (value * 10.0).round() / 10.0;
    TaskEvent::Barred {
        things: barred.things.iter().filter_map(name).collect(),
        area: world.name(Entity::Area(barred.area)).to_owned(),
        map: world.name(Entity::Map(barred.map)).to_owned(),
        x: round(barred.at.x),
        y: round(barred.at.y),
        to: barred.to.clone(),
        explanation: barred_in_words(world, barred, Language::Russian),
        explanation_en: barred_in_words(world, barred, Language::English),
    }
}

/// What a surprise is about, by its name on the map; what the map does not have has none.
fn thing(world: &World, surprise: &Surprise) -> Option<String> {
    let what = match surprise {
        Surprise::Blocked { bump, .. } => bump.against.entity(),
        Surprise::Refused { refusal, .. } => refusal.about().and_then(|what| what.entity()),
        Surprise::Noticed { seen } => Some(seen.entity()),
        Surprise::Displaced => None,
        Surprise::NoWay { to: name, .. }
        | Surprise::Unknown { name }
        | Surprise::NotSeen { thing: name, .. } => return Some(name.clone()),
        Surprise::NoReturn { door, .. } => Some(Entity::Door(*door)),
    };
    let known = world.names().find(|(entity, _)| Some(*entity) == what);
    known.map(|(_, name)| name.to_owned())
}

fn kind(surprise: &Surprise) -> &'static str {
    match surprise {
        Surprise::Blocked { .. } => "blocked",
        Surprise::Refused { refusal: Refusal::NotThere(_), .. } => "not_there",
        Surprise::Refused { .. } => "refused",
        Surprise::NoWay { .. } => "no_way",
        Surprise::Unknown { .. } => "unknown",
        Surprise::NotSeen { .. } => "not_seen",
        Surprise::NoReturn { .. } => "no_return",
        Surprise::Noticed { .. } => "noticed",
        Surprise::Displaced => "displaced",
    }
}

impl DirectiveView {
    fn of(world: &World, directive: &Directive) -> Self {
        let asked = |language| directive_in_words(world, directive, language);
        Self {
            action: directive.action.to_string(),
            args: directive.args.iter().map(ToString::to_string).collect(),
            do_ru: asked(Language::Russian),
            do_en: asked(Language::English),
        }
    }
}

impl PlanView {
    fn of(world: &World, planned: &Planned) -> Self {
        let solved = &planned.solved;
        let name = |name: &str| name_in(world, name, Language::English);
        let english = solved.wording(Language::English, &name);
        let step = |step: &Vec<Directive>| {
            step.iter().map(|directive| DirectiveView::of(world, directive)).collect()
        };
        let is_plan = matches!(solved.outcome, Outcome::Plan(_));
        let is_bounded = !matches!(solved.outcome, Outcome::NoPlan { .. }) && solved.time.is_none();
        Self {
            outcome: match solved.outcome {
                Outcome::Plan(_) => "plan",
                Outcome::NoPlan { .. } => "no_plan",
                Outcome::LimitReached(_) => "limit",
            },
            goal: solved.task.goal.iter().map(|&id| solved.task.fact(id).to_string()).collect(),
            steps: planned.steps.iter().map(step).collect(),
            at_least_steps: is_bounded.then_some(solved.at_least),
            at_most_steps: solved.outcome.plan().map(|_| planned.steps.len()),
            seconds: solved.time.map(|time| time.takes as f64 / 100.0),
            at_least_seconds: solved.time.map(|time| time.at_least as f64 / 100.0),
            assumptions: solved.assumptions.iter().map(ToString::to_string).collect(),
            assumptions_ru: assumptions_in_russian(world, solved),
            assumptions_en: solved.assumptions_with(&english),
            explanation: (!is_plan).then(|| solved.explanation(Language::Russian)).flatten(),
            explanation_en: (!is_plan).then(|| solved.explanation_with(&english)).flatten(),
        }
    }
}

impl ReportView {
    pub(super) fn of(world: &World, report: &Report) -> Self {
        let DirectiveView { action, args, do_ru, do_en } =
            DirectiveView::of(world, &report.directive);
        let done = |language| actions_in_words(world, &report.directive, language);
        let said = |language| report.position.as_ref().map(|position| position.say(language));
        Self {
            do_ru,
            do_en,
            done_ru: done(Language::Russian),
            done_en: done(Language::English),
            number: report.number,
            action,
            args,
            map: world.maps[&report.map].name.clone(),
            pose: pose(report.pose),
            length_cm: round(report.length),
            seconds: round(report.seconds),
            points: report.points.iter().copied().map(point).collect(),
            ru: said(Language::Russian),
            en: said(Language::English),
        }
    }
}
