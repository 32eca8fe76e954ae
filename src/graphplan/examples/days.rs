//! A robot's whole day in a large building: things to be tidied up in many rooms, over one or two storeys, or rounds.
//!
//! `cargo run --release -p orthoframe-graphplan --example days -- tidy 60 8 1 30`: 8 things in 60 rooms on one storey,
//! 30 seconds. `rounds 40 0 1 30`: a look into each of 40 rooms. `robot 60 8 1 30`: the first by the rules in
//! `rules/service-robot.strips`, with places, keys and a lift. Tells when the first plan stood, what came after it, and
//! what is proven; every plan is replayed. `write` in front writes the problem to domain.pddl and problem.pddl.

#![allow(clippy::print_stdout, reason = "an example speaks to its caller")]

use std::fmt::Write;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use orthoframe_graphplan::{Limits, Outcome, solve_anytime, validate};
use orthoframe_strips::Scenario;
use orthoframe_units::Source;

const DOMAIN: &str = "(define (domain day)
 (:requirements :strips :typing)
 (:types robot room door item storey)
 (:predicates (in ?r - robot ?a - room) (links ?d - door ?a - room ?b - room) (open ?d - door)
   (shut ?d - door) (at ?o - item ?a - room) (holds ?r - robot ?o - item) (free ?r - robot)
   (seen ?a - room) (lift ?a - room ?s - storey) (stands ?s - storey))
 (:action go :parameters (?r - robot ?a - room ?b - room ?d - door)
   :precondition (and (in ?r ?a) (links ?d ?a ?b) (open ?d))
   :effect (and (in ?r ?b) (not (in ?r ?a))))
 (:action open-door :parameters (?r - robot ?d - door ?a - room ?b - room)
   :precondition (and (in ?r ?a) (links ?d ?a ?b) (shut ?d))
   :effect (and (open ?d) (not (shut ?d))))
 (:action call :parameters (?r - robot ?a - room ?s - storey ?t - storey)
   :precondition (and (in ?r ?a) (lift ?a ?t) (stands ?s))
   :effect (and (stands ?t) (not (stands ?s))))
 (:action ride :parameters (?r - robot ?a - room ?b - room ?s - storey ?t - storey)
   :precondition (and (in ?r ?a) (lift ?a ?s) (lift ?b ?t) (stands ?s))
   :effect (and (in ?r ?b) (not (in ?r ?a)) (stands ?t) (not (stands ?s))))
 (:action look :parameters (?r - robot ?a - room)
   :precondition (in ?r ?a) :effect (seen ?a))
 (:action pick :parameters (?r - robot ?o - item ?a - room)
   :precondition (and (in ?r ?a) (at ?o ?a) (free ?r))
   :effect (and (holds ?r ?o) (not (at ?o ?a)) (not (free ?r))))
 (:action put :parameters (?r - robot ?o - item ?a - room)
   :precondition (and (in ?r ?a) (holds ?r ?o))
   :effect (and (at ?o ?a) (free ?r) (not (holds ?r ?o)))))";

/// Corridors of so many pieces, each piece with a room on either side.
const ALONG: usize = 10;

#[path = "../../../benches/planning/building.rs"]
#[allow(dead_code, reason = "benches ask for more errands")]
mod building;

/// A small generator with a seed (xorshift64*).
struct Random(u64);

impl Random {
    fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        ((self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize) % bound
    }
}

/// Rooms on both sides of corridors, one corridor behind the other, storeys joined by a lift; every third door is shut.
fn day(rooms: usize, things: usize, storeys: usize, is_rounds: bool) -> String {
    let mut random = Random((rooms * 31 + things * 7 + storeys) as u64);
    let (mut objects, mut init, mut goal) = (String::new(), String::new(), String::new());
    let pieces = rooms.div_ceil(2);
    let per_storey = pieces.div_ceil(storeys);
    let mut doors = 0;
    let mut link = |init: &mut String, objects: &mut String, a: &str, b: &str, shut: bool| {
        let state = if shut { "shut" } else { "open" };
        write!(objects, "d{doors} - door ").expect("a string takes all text");
        write!(init, "(links d{doors} {a} {b}) (links d{doors} {b} {a}) ({state} d{doors}) ")
            .expect("a string takes all text");
        doors += 1;
    };
    for piece in 0..pieces {
        let hall = format!("h{piece}");
        objects += &format!("{hall} - room ");
        let first = per_storey * (piece / per_storey);
        if piece > first {
            // Along a corridor; its beginning lies beside the beginning of the one before.
            let own = piece - first;
            let before = if own.is_multiple_of(ALONG) { piece - ALONG } else { piece - 1 };
            link(&mut init, &mut objects, &hall, &format!("h{before}"), false);
        } else if storeys > 1 {
            let storey = piece / per_storey;
            init += &format!("(lift {hall} s{storey}) ");
            objects += &format!("s{storey} - storey ");
        }
        for room in [2 * piece, 2 * piece + 1].into_iter().filter(|&room| room < rooms) {
            objects += &format!("r{room} - room ");
            link(&mut init, &mut objects, &hall, &format!("r{room}"), room % 3 == 0);
        }
    }
    if storeys > 1 {
        init += "(stands s0) ";
    }
    init += "(in bot h0) (free bot) ";
    for thing in 0..things {
        let (from, to) = (random.below(rooms), random.below(rooms));
        let to = if from == to { (to + 1) % rooms } else { to };
        objects += &format!("o{thing} - item ");
        init += &format!("(at o{thing} r{from}) ");
        goal += &format!("(at o{thing} r{to}) ");
    }
    if is_rounds {
        (0..rooms).for_each(|room| goal += &format!("(seen r{room}) "));
    }
    format!(
        "(define (problem day) (:domain day) (:objects bot - robot {objects}) (:init {init}) (:goal (and {goal})))"
    )
}

static BEGUN: OnceLock<Instant> = OnceLock::new();

fn since() -> f64 {
    BEGUN.get_or_init(Instant::now).elapsed().as_secs_f64()
}

fn main() {
    let mut args: Vec<String> = std::env::args().skip(1).collect();
    let is_written = args.first().is_some_and(|first| first == "write");
    if is_written {
        args.remove(0);
    }
    let number =
        |at: usize| -> usize { args.get(at).and_then(|text| text.parse().ok()).unwrap_or(1) };
    let (rooms, things, storeys, seconds) = (number(1), number(2), number(3), number(4));
    let is_rounds = args.first().is_some_and(|kind| kind == "rounds");
    if args.first().is_some_and(|kind| kind == "robot") {
        let rules = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rules/service-robot.strips");
        let rules = std::fs::read_to_string(rules).expect("the rules stand beside the sources");
        let day = building::building(rooms, storeys, building::Errand::Day(things));
        if is_written {
            std::fs::write("day.strips", rules + &day.scenario).expect("it can be written");
            return;
        }
        let source = Source::new("day", &(rules + &day.scenario));
        return plan(&Scenario::parse(&source).expect("the rules read well"), seconds);
    }
    let problem = day(rooms, things, storeys, is_rounds);
    if is_written {
        std::fs::write("domain.pddl", DOMAIN).expect("the directory can be written to");
        std::fs::write("problem.pddl", problem).expect("the directory can be written to");
        return;
    }
    let (domain, problem) = (Source::new("domain", DOMAIN), Source::new("problem", &problem));
    plan(&Scenario::parse_pddl(&domain, &problem).expect("the domain reads well"), seconds);
}

fn plan(scenario: &Scenario, seconds: usize) {
    since();
    let task = scenario.ground().expect("the problem means something");
    println!("{:.2} s: {} facts, {} operators", since(), task.facts.len(), task.operators.len());
    let limits = Limits {
        deadline: Some(Instant::now() + Duration::from_secs(seconds as u64)),
        tell: Some(|plan| {
            println!(
                "{:.2} s: {} steps, {} actions",
                since(),
                plan.steps.len(),
                plan.action_count()
            )
        }),
        tell_bound: Some(|bound| println!("{:.2} s: at least {bound}", since())),
        ..Limits::default()
    };
    match solve_anytime(&task, &limits) {
        Outcome::Plan(plan) => {
            validate(&task, &plan).expect("the plan works");
            println!("{:.2} s: proven, {} steps", since(), plan.steps.len());
        }
        Outcome::NoPlan { .. } => println!("{:.2} s: no plan", since()),
        Outcome::LimitReached(known) => {
            let steps = known.plan.as_ref().map(|plan| {
                validate(&task, plan).expect("the plan works");
                plan.steps.len()
            });
            println!(
                "{:.2} s: {:?}, {steps:?} steps, at least {}",
                since(),
                known.limit,
                known.at_least
            );
        }
    }
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    println!("{}", status.lines().find(|line| line.starts_with("VmHWM")).unwrap_or_default());
}
