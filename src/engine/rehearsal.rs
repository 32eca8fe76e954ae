//! A line heard apart: the simulator drives in no time what it would have the robot do, and nothing of it stays.

use std::sync::Arc;

use serde_json::{Value, json};

use super::directive_words::name_in;
use super::narration::left_open;
use super::{
    Dialogue, Engine, Error, Event, Heard, Outcome, Progress, Queue, QueuedTask, Reply, State,
    TaskEvents, json,
};
use crate::map::{DoorStatus, World};
use crate::robot::{Planned, Primitive};
use crate::units::Language;

/// What is heard.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Line<'l> {
    Said(&'l str),
    /// An order that waited in the store.
    Waited(&'l QueuedTask),
}

/// Hears a line, and does what it says.
///
/// # Errors
/// There is no map, or the disk refused.
pub(crate) fn hear(
    dialogue: &mut Dialogue,
    engine: &mut Engine,
    line: &Line<'_>,
    tell: &mut dyn FnMut(&Engine, &Event<'_>),
) -> Result<Heard, Error> {
    match line {
        Line::Said(text) => dialogue.hear(engine, text, tell),
        Line::Waited(task) => {
            let tasks = vec![QueuedTask::clone(task)];
            engine.put_queue(Queue { tasks, paused: None }, &task.by)?;
            dialogue.go_on(engine, tell)
        }
    }
}

/// What a line came to when it was heard apart.
#[derive(Debug)]
pub struct Rehearsed {
    /// What was replied before the first task.
    pub replies: Vec<Value>,
    /// What is to be confirmed, if anything is.
    pub plan: Option<Value>,
    /// Told to stop.
    pub stops: bool,
    pub dialogue: Dialogue,
}

/// The plans that a task goes by, as they are made one after another: steps and assumptions.
pub(crate) fn plans_of(plan: &Value) -> impl Iterator<Item = &Value> {
    let events = plan["events"].as_array().into_iter().flatten();
    events.filter(|event| event["event"] == "planned" || event["event"] == "replanned")
}

/// Whether two lines heard apart would do the same, and rest on the same.
pub(crate) fn is_same_plan(one: &Value, other: &Value) -> bool {
    plans_of(one).eq(plans_of(other))
}

/// What a person is told of a plan before saying yes, beside its steps and what it rests on: how long it is, whether that
/// is proven, and else how short it might be; what it opens, and what it takes along or pushes away.
#[derive(Debug, Default)]
struct Outlook {
    proof_ru: Vec<String>,
    proof_en: Vec<String>,
    /// None until there is a plan; false where one of several is not proven.
    is_shortest: Option<bool>,
    /// Proven: so many steps are needed, of several plans in all; and so many they have.
    at_least: usize,
    at_most: usize,
    opens: Vec<String>,
    carries: Vec<String>,
}

impl Outlook {
    fn add(&mut self, world: &World, planned: &Planned) {
        let proof = |language| -> Vec<String> {
            let told = Progress::Planned(planned).in_words(world, language);
            // What stands above the steps.
            let head =
                told.iter().flat_map(|text| text.lines().take_while(|l| !l.starts_with(' ')));
            let name = |name: &str| name_in(world, name, language);
            let open = left_open(&planned.solved, &planned.solved.wording(language, &name));
            let open = open.filter(|_| !told.is_empty());
            head.map(str::to_owned).chain(open).collect()
        };
        let (russian, english) = (proof(Language::Russian), proof(Language::English));
        if russian.is_empty() {
            return;
        }
        self.proof_ru.extend(russian);
        self.proof_en.extend(english);
        let is_shortest = planned.solved.is_shortest && self.is_shortest != Some(false);
        self.is_shortest = Some(is_shortest);
        self.at_least += planned.solved.at_least;
        self.at_most += planned.steps.len();
        for primitive in planned.steps.iter().flatten().flat_map(|directive| directive.primitives())
        {
            let (list, name) = match primitive {
                Primitive::SetDoor { door, status: DoorStatus::Open } => (&mut self.opens, door),
                Primitive::SetOpen { thing, open: true } => (&mut self.opens, thing),
                Primitive::Take(thing) | Primitive::Push(thing) => (&mut self.carries, thing),
                _ => continue,
            };
            if !list.contains(&name) {
                list.push(name);
            }
        }
    }

    fn put_into(self, plan: &mut Value, world: &World) {
        let named = |names: Vec<String>| {
            let both = names.into_iter().map(|name| {
                let english = name_in(world, &name, Language::English);
                json!({ "ru": name, "en": english })
            });
            Value::from_iter(both)
        };
        plan["proof_ru"] = json!(self.proof_ru.join("\n"));
        plan["proof_en"] = json!(self.proof_en.join("\n"));
        plan["is_shortest"] = json!(self.is_shortest);
        let bound = |steps: usize| self.is_shortest.map(|_| steps);
        plan["at_least_steps"] = json!(bound(self.at_least));
        plan["at_most_steps"] = json!(bound(self.at_most));
        plan["opens"] = named(self.opens);
        plan["carries"] = named(self.carries);
    }
}

/// What is replied to a line that is heard apart, and by nobody else.
///
/// # Errors
/// There is no map, or the disk refused.
pub(crate) fn replied(state: &Arc<State>, text: &str, language: Language) -> Result<Value, Error> {
    rehearse(state, &Dialogue::new(language), &Line::Said(text)).map(|heard| json!(heard.replies))
}

/// Hears a line apart: what it answers, and what it would have the robot do.
///
/// # Errors
/// There is no map, or the disk refused.
pub(crate) fn rehearse(
    state: &Arc<State>,
    before: &Dialogue,
    line: &Line<'_>,
) -> Result<Rehearsed, Error> {
    let mut engine = Engine::beside(Arc::clone(state));
    let mut dialogue = before.apart().keeping_nothing();
    // Who asks what it would come to may leave while it is planned.
    dialogue.stopped_by(state.stop.clone());
    let (mut told, mut events) = (Vec::new(), TaskEvents::default());
    let (mut outlook, mut is_first) = (Outlook::default(), true);
    let heard = hear(&mut dialogue, &mut engine, line, &mut |_, event| match event {
        Event::Progress { progress, world, .. } if is_first => {
            if let Progress::Planned(planned) = progress {
                outlook.add(world, planned);
            }
            if let Some(event) = events.of(world, progress) {
                told.push(event);
            }
        }
        Event::Replied(Reply { outcome: Outcome::Task(_), .. }) => is_first = false,
        _ => {}
    })?;
    let drives =
        |reply: &Reply| matches!(&reply.outcome, Outcome::Task(t) if !t.reports.is_empty());
    let stops = heard.replies.iter().any(|reply| match &reply.outcome {
        // A robot that drives is stopped, whatever else was meant to be dropped.
        Outcome::Stopped { .. } => true,
        Outcome::Task(task) => task.stops,
        _ => false,
    });
    let first = heard.replies.iter().position(drives);
    let before = first.unwrap_or(heard.replies.len());
    let mut replies = Vec::new();
    for reply in &heard.replies[..before] {
        let mut view = json::reply(&engine, reply)?;
        view["text"] = json!(reply.text);
        view["language"] = json!(reply.language.pick("ru", "en"));
        replies.push(view);
    }
    let plan = match first.map(|at| &heard.replies[at].outcome) {
        Some(Outcome::Task(task)) => {
            let mut plan = json::task(engine.world()?, task);
            plan["said"] = json!(match line {
                Line::Said(text) => text,
                Line::Waited(task) => task.text.as_str(),
            });
            plan["events"] = json!(told);
            outlook.put_into(&mut plan, engine.world()?);
            let others = heard.replies.iter().filter(|reply| drives(reply)).count();
            // Of what is ordered behind it the plan is made when its turn comes.
            plan["more"] = json!(others - 1);
            Some(plan)
        }
        _ => None,
    };
    Ok(Rehearsed { replies, plan, stops, dialogue })
}

impl State {
    /// Hears what a person says apart: what it would be answered, and what the robot would do. Nothing of it stays.
    ///
    /// # Errors
    /// There is no map, or the disk refused.
    pub fn rehearse(self: &Arc<Self>, before: &Dialogue, text: &str) -> Result<Rehearsed, Error> {
        rehearse(self, before, &Line::Said(text))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graphplan::{Limits, Outcome};
    use crate::robot::{Directive, Wanted, solve};
    use crate::strips::Scenario;
    use crate::units::Source;

    /// Balls that two grippers carry from one room to the other: soon planned, and long proven.
    fn open_plan() -> Planned {
        const DOMAIN: &str = "(define (domain g) (:predicates (room ?r) (ball ?b) (gripper ?g) (robby ?r) (at ?b ?r) (free ?g) (carry ?b ?g))
            (:action move :parameters (?a ?b) :precondition (and (room ?a) (room ?b) (robby ?a)) :effect (and (robby ?b) (not (robby ?a))))
            (:action pick :parameters (?b ?r ?g) :precondition (and (ball ?b) (gripper ?g) (at ?b ?r) (robby ?r) (free ?g))
             :effect (and (carry ?b ?g) (not (at ?b ?r)) (not (free ?g))))
            (:action drop :parameters (?b ?r ?g) :precondition (and (carry ?b ?g) (robby ?r) (gripper ?g))
             :effect (and (at ?b ?r) (free ?g) (not (carry ?b ?g)))))";
        let each = |text: &str| -> String {
            (0..20).map(|ball| text.replace('#', &ball.to_string())).collect()
        };
        let problem = format!(
            "(define (problem p) (:domain g) (:objects a b l r {}) (:init (room a) (room b) (gripper l) (gripper r) (robby a) (free l) (free r) {}) (:goal (and {})))",
            each("b# "),
            each("(ball b#) (at b# a) "),
            each("(at b# b) ")
        );
        let scenario =
            Scenario::parse_pddl(&Source::new("d", DOMAIN), &Source::new("p", problem)).unwrap();
        let limits = Limits { effort: Some(0), ..Limits::default() };
        let Scenario { domain, problem, .. } = &scenario;
        let solved = solve(domain, problem, &limits, Wanted::Anytime).unwrap();
        assert!(matches!(solved.outcome, Outcome::LimitReached(_)), "{:?}", solved.outcome);
        let plan = solved.outcome.plan().expect("there is one at once");
        let directive = |&id| Directive::of(domain, &solved.task, solved.task.operator(id));
        let steps = plan.steps.iter().map(|step| step.iter().map(directive).collect()).collect();
        let (places, joins, lifts) = (Vec::new(), Vec::new(), Vec::new());
        Planned { solved, steps, places, joins, lifts, learned_before: false }
    }

    #[test]
    fn who_is_to_confirm_a_plan_is_told_its_bounds() {
        let (planned, world) = (open_plan(), World::empty());
        let (at_least, at_most) = (planned.solved.at_least, planned.steps.len());
        assert!(0 < at_least && at_least < at_most, "{at_least} {at_most}");
        let mut outlook = Outlook::default();
        outlook.add(&world, &planned);
        outlook.add(&world, &planned);
        let mut plan = json!({});
        outlook.put_into(&mut plan, &world);
        assert_eq!(plan["is_shortest"], json!(false));
        let bounds = (&plan["at_least_steps"], &plan["at_most_steps"]);
        assert_eq!(bounds, (&json!(2 * at_least), &json!(2 * at_most)));
        for (field, words) in [
            ("proof_ru", format!("шагов нужно от {at_least} до {at_most}")),
            ("proof_en", format!("it takes {at_least} to {at_most} steps")),
        ] {
            let told = plan[field].as_str().unwrap();
            assert_eq!(told.matches(&words).count(), 2, "{told}");
        }
    }
}
