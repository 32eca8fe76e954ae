//! Planning problems of the families that planners are measured on, written anew: the rules as the literature
//! describes them, the instances drawn from a seed, of the sizes that competitions used.

use std::fmt::Write;

mod building;
mod making;
mod moving;
mod random;
mod transport;

pub(crate) use building::buildings;
use making::{barman, childsnack, floortile, openstacks, termes, woodworking};
use moving::{elevators, grid, hiking, parking, sokoban, storage, tiles, transport, visitall};
use random::Random;
pub(crate) use transport::{
    depot, driverlog, logistics, miconic, mystery, rocket, tpp, zenotravel,
};

/// PDDL texts of a domain and a problem.
pub(crate) struct Instance {
    pub(crate) name: String,
    pub(crate) domain: String,
    pub(crate) problem: String,
}

/// The numbers below `count` in an order drawn at random (Fisher-Yates).
fn shuffled(random: &mut Random, count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for at in (1..count).rev() {
        order.swap(at, random.below(at + 1));
    }
    order
}

/// `a0 a1 a2 - kind`
fn objects(prefix: &str, count: usize, kind: &str) -> String {
    let mut text = String::new();
    for number in 0..count {
        write!(text, "{prefix}{number} ").expect("a string takes all text");
    }
    format!("{text}- {kind} ")
}

fn instance(
    name: String,
    domain: &str,
    objects: &str,
    init: &[String],
    goal: &[String],
) -> Instance {
    let problem = format!(
        "(define (problem p) (:domain d)\n (:objects {objects})\n (:init {})\n (:goal (and {})))",
        init.join(" "),
        goal.join(" ")
    );
    Instance { name, domain: domain.to_owned(), problem }
}

/// A robot with two hands carries balls from one room to another.
pub(crate) fn gripper(balls: usize) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types room ball gripper)
 (:predicates (at-robby ?r - room) (at ?b - ball ?r - room) (free ?g - gripper) (carry ?b - ball ?g - gripper))
 (:action move :parameters (?a ?b - room) :precondition (at-robby ?a) :effect (and (at-robby ?b) (not (at-robby ?a))))
 (:action pick :parameters (?b - ball ?r - room ?g - gripper) :precondition (and (at ?b ?r) (at-robby ?r) (free ?g))
  :effect (and (carry ?b ?g) (not (at ?b ?r)) (not (free ?g))))
 (:action drop :parameters (?b - ball ?r - room ?g - gripper) :precondition (and (carry ?b ?g) (at-robby ?r))
  :effect (and (at ?b ?r) (free ?g) (not (carry ?b ?g)))))";
    let mut init: Vec<String> =
        ["(at-robby ra)", "(free left)", "(free right)"].map(String::from).into();
    init.extend((0..balls).map(|b| format!("(at b{b} ra)")));
    let goal: Vec<String> = (0..balls).map(|b| format!("(at b{b} rb)")).collect();
    let all = format!("ra rb - room left right - gripper {}", objects("b", balls, "ball"));
    instance(format!("gripper-{balls}"), domain, &all, &init, &goal)
}

/// Towers of blocks, moved by one hand.
pub(crate) fn blocks(count: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips)
 (:predicates (on ?x ?y) (ontable ?x) (clear ?x) (handempty) (holding ?x))
 (:action pick-up :parameters (?x) :precondition (and (clear ?x) (ontable ?x) (handempty))
  :effect (and (not (ontable ?x)) (not (clear ?x)) (not (handempty)) (holding ?x)))
 (:action put-down :parameters (?x) :precondition (holding ?x)
  :effect (and (not (holding ?x)) (clear ?x) (handempty) (ontable ?x)))
 (:action stack :parameters (?x ?y) :precondition (and (holding ?x) (clear ?y))
  :effect (and (not (holding ?x)) (not (clear ?y)) (clear ?x) (handempty) (on ?x ?y)))
 (:action unstack :parameters (?x ?y) :precondition (and (on ?x ?y) (clear ?x) (handempty))
  :effect (and (holding ?x) (clear ?y) (not (clear ?x)) (not (handempty)) (not (on ?x ?y)))))";
    let mut random = Random::new(seed);
    let towers = |random: &mut Random, whole: bool| {
        let mut facts = Vec::new();
        let mut top: Option<usize> = None;
        for block in shuffled(random, count) {
            match top {
                Some(below) if random.below(4) > 0 => facts.push(format!("(on b{block} b{below})")),
                _ => {
                    if let (Some(top), true) = (top, whole) {
                        facts.push(format!("(clear b{top})"));
                    }
                    if whole {
                        facts.push(format!("(ontable b{block})"));
                    }
                }
            }
            top = Some(block);
        }
        if let (Some(top), true) = (top, whole) {
            facts.push(format!("(clear b{top}) (handempty)"));
        }
        facts
    };
    let init = towers(&mut random, true);
    let goal = towers(&mut random, false);
    instance(format!("blocks-{count}/{seed}"), domain, &objects("b", count, "object"), &init, &goal)
}

/// Rovers sample rocks and soil, take images and send them to a lander. Its channel and the rover are free throughout:
/// the competition's rules take both and give them back in one action, and its planners read that so.
pub(crate) fn rovers(rovers: usize, places: usize, goals: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types rover place store camera mode lander objective)
 (:predicates (at ?r - rover ?p - place) (lander-at ?l - lander ?p - place) (road ?r - rover ?a ?b - place) (visible ?a ?b - place)
  (store-of ?s - store ?r - rover) (empty ?s - store) (full ?s - store) (soil ?p - place) (rock ?p - place) (for-soil ?r - rover) (for-rock ?r - rover)
  (has-soil ?r - rover ?p - place) (has-rock ?r - rover ?p - place) (on-board ?c - camera ?r - rover) (supports ?c - camera ?m - mode)
  (calibrated ?c - camera ?r - rover) (target ?c - camera ?o - objective) (seen-from ?o - objective ?p - place)
  (image ?r - rover ?o - objective ?m - mode) (sent-soil ?p - place) (sent-rock ?p - place) (sent-image ?o - objective ?m - mode) (channel ?l - lander) (available ?r - rover))
 (:action drive :parameters (?r - rover ?a ?b - place) :precondition (and (available ?r) (at ?r ?a) (road ?r ?a ?b)) :effect (and (not (at ?r ?a)) (at ?r ?b)))
 (:action dig :parameters (?r - rover ?s - store ?p - place) :precondition (and (at ?r ?p) (soil ?p) (for-soil ?r) (store-of ?s ?r) (empty ?s))
  :effect (and (not (empty ?s)) (full ?s) (has-soil ?r ?p) (not (soil ?p))))
 (:action drill :parameters (?r - rover ?s - store ?p - place) :precondition (and (at ?r ?p) (rock ?p) (for-rock ?r) (store-of ?s ?r) (empty ?s))
  :effect (and (not (empty ?s)) (full ?s) (has-rock ?r ?p) (not (rock ?p))))
 (:action dump :parameters (?r - rover ?s - store) :precondition (and (store-of ?s ?r) (full ?s)) :effect (and (not (full ?s)) (empty ?s)))
 (:action calibrate :parameters (?r - rover ?c - camera ?o - objective ?p - place)
  :precondition (and (on-board ?c ?r) (target ?c ?o) (at ?r ?p) (seen-from ?o ?p)) :effect (calibrated ?c ?r))
 (:action shoot :parameters (?r - rover ?p - place ?o - objective ?c - camera ?m - mode)
  :precondition (and (calibrated ?c ?r) (on-board ?c ?r) (supports ?c ?m) (seen-from ?o ?p) (at ?r ?p))
  :effect (and (image ?r ?o ?m) (not (calibrated ?c ?r))))
 (:action send-soil :parameters (?r - rover ?l - lander ?x ?a ?b - place)
  :precondition (and (at ?r ?a) (lander-at ?l ?b) (has-soil ?r ?x) (visible ?a ?b) (available ?r) (channel ?l))
  :effect (sent-soil ?x))
 (:action send-rock :parameters (?r - rover ?l - lander ?x ?a ?b - place)
  :precondition (and (at ?r ?a) (lander-at ?l ?b) (has-rock ?r ?x) (visible ?a ?b) (available ?r) (channel ?l))
  :effect (sent-rock ?x))
 (:action send-image :parameters (?r - rover ?l - lander ?o - objective ?m - mode ?a ?b - place)
  :precondition (and (at ?r ?a) (lander-at ?l ?b) (image ?r ?o ?m) (visible ?a ?b) (available ?r) (channel ?l))
  :effect (sent-image ?o ?m)))";
    let mut random = Random::new(seed);
    let objectives = goals.max(2);
    let mut init = vec![format!("(lander-at l0 p{}) (channel l0)", random.below(places))];
    for place in 1..places {
        let other = random.below(place);
        init.push(format!("(visible p{place} p{other}) (visible p{other} p{place})"));
    }
    for _ in 0..2 * places {
        let (a, b) = (random.below(places), random.below(places));
        init.push(format!("(visible p{a} p{b}) (visible p{b} p{a})"));
    }
    for rover in 0..rovers {
        init.push(format!(
            "(at r{rover} p{}) (store-of s{rover} r{rover}) (empty s{rover}) (available r{rover})",
            random.below(places)
        ));
        init.push(format!("(for-soil r{rover}) (for-rock r{rover}) (on-board c{rover} r{rover})"));
        init.push(format!("(target c{rover} o{})", random.below(objectives)));
        init.extend((0..2).map(|m| format!("(supports c{rover} m{m})")));
        for place in 1..places {
            let other = random.below(place);
            init.push(format!(
                "(road r{rover} p{place} p{other}) (road r{rover} p{other} p{place})"
            ));
        }
    }
    for objective in 0..objectives {
        for _ in 0..2 {
            init.push(format!("(seen-from o{objective} p{})", random.below(places)));
        }
    }
    let mut goal = Vec::new();
    for number in 0..goals {
        let (a, b) = (random.below(places), random.below(places));
        init.push(format!("(soil p{a}) (rock p{b})"));
        goal.push(format!("(sent-soil p{a})"));
        goal.push(format!("(sent-rock p{b})"));
        goal.push(format!("(sent-image o{number} m{})", random.below(2)));
    }
    let all = format!(
        "{}{}{}{}{}{}l0 - lander",
        objects("r", rovers, "rover"),
        objects("p", places, "place"),
        objects("s", rovers, "store"),
        objects("c", rovers, "camera"),
        objects("m", 2, "mode"),
        objects("o", objectives, "objective")
    );
    instance(format!("rovers-{rovers}-{places}-{goals}/{seed}"), domain, &all, &init, &goal)
}

/// Satellites turn, calibrate instruments and take images.
pub(crate) fn satellite(
    satellites: usize,
    instruments: usize,
    directions: usize,
    images: usize,
    seed: u64,
) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types satellite direction instrument mode)
 (:predicates (on-board ?i - instrument ?s - satellite) (supports ?i - instrument ?m - mode) (pointing ?s - satellite ?d - direction)
  (power ?s - satellite) (on ?i - instrument) (calibrated ?i - instrument) (image ?d - direction ?m - mode) (target ?i - instrument ?d - direction))
 (:action turn :parameters (?s - satellite ?a ?b - direction) :precondition (and (pointing ?s ?b) (not (= ?a ?b)))
  :effect (and (pointing ?s ?a) (not (pointing ?s ?b))))
 (:action switch-on :parameters (?i - instrument ?s - satellite) :precondition (and (on-board ?i ?s) (power ?s))
  :effect (and (on ?i) (not (calibrated ?i)) (not (power ?s))))
 (:action switch-off :parameters (?i - instrument ?s - satellite) :precondition (and (on-board ?i ?s) (on ?i)) :effect (and (not (on ?i)) (power ?s)))
 (:action calibrate :parameters (?s - satellite ?i - instrument ?d - direction)
  :precondition (and (on-board ?i ?s) (target ?i ?d) (pointing ?s ?d) (on ?i)) :effect (calibrated ?i))
 (:action take :parameters (?s - satellite ?d - direction ?i - instrument ?m - mode)
  :precondition (and (calibrated ?i) (on-board ?i ?s) (supports ?i ?m) (on ?i) (pointing ?s ?d)) :effect (image ?d ?m)))";
    let mut random = Random::new(seed);
    let mut init = Vec::new();
    for satellite in 0..satellites {
        init.push(format!(
            "(power s{satellite}) (pointing s{satellite} d{})",
            random.below(directions)
        ));
    }
    for number in 0..instruments {
        init.push(format!(
            "(on-board i{number} s{}) (target i{number} d{})",
            number % satellites,
            random.below(directions)
        ));
        init.push(format!(
            "(supports i{number} m{}) (supports i{number} m{})",
            number % 3,
            random.below(3)
        ));
    }
    let mut goal: Vec<String> = (0..images)
        .map(|_| {
            format!("(image d{} m{})", random.below(directions), random.below(3.min(instruments)))
        })
        .collect();
    goal.push(format!("(pointing s0 d{})", random.below(directions)));
    let all = format!(
        "{}{}{}{}",
        objects("s", satellites, "satellite"),
        objects("d", directions, "direction"),
        objects("i", instruments, "instrument"),
        objects("m", 3, "mode")
    );
    instance(
        format!("satellite-{satellites}-{instruments}-{images}/{seed}"),
        domain,
        &all,
        &init,
        &goal,
    )
}

/// Solitaire with cells: every card home, suit by suit.
pub(crate) fn freecell(
    ranks: usize,
    suits: usize,
    cells: usize,
    columns: usize,
    seed: u64,
) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types card num suit)
 (:predicates (on ?a ?b - card) (incell ?c - card) (clear ?c - card) (cellspace ?n - num) (colspace ?n - num) (home ?c - card)
  (bottom ?c - card) (canstack ?a ?b - card) (suit ?c - card ?s - suit) (value ?c - card ?n - num) (successor ?a ?b - num))
 (:action move :parameters (?c ?o ?n - card) :precondition (and (clear ?c) (clear ?n) (canstack ?c ?n) (on ?c ?o))
  :effect (and (on ?c ?n) (clear ?o) (not (on ?c ?o)) (not (clear ?n))))
 (:action move-b :parameters (?c ?n - card ?x ?y - num) :precondition (and (clear ?c) (bottom ?c) (clear ?n) (canstack ?c ?n) (colspace ?x) (successor ?y ?x))
  :effect (and (on ?c ?n) (colspace ?y) (not (bottom ?c)) (not (clear ?n)) (not (colspace ?x))))
 (:action tocell :parameters (?c ?o - card ?x ?y - num) :precondition (and (clear ?c) (on ?c ?o) (cellspace ?x) (successor ?x ?y))
  :effect (and (clear ?o) (incell ?c) (cellspace ?y) (not (on ?c ?o)) (not (clear ?c)) (not (cellspace ?x))))
 (:action tocell-b :parameters (?c - card ?x ?y ?u ?v - num)
  :precondition (and (clear ?c) (bottom ?c) (cellspace ?x) (successor ?x ?y) (colspace ?u) (successor ?v ?u))
  :effect (and (incell ?c) (colspace ?v) (cellspace ?y) (not (bottom ?c)) (not (clear ?c)) (not (colspace ?u)) (not (cellspace ?x))))
 (:action column :parameters (?c ?o - card ?x ?y - num) :precondition (and (clear ?c) (on ?c ?o) (colspace ?x) (successor ?x ?y))
  :effect (and (clear ?o) (bottom ?c) (colspace ?y) (not (on ?c ?o)) (not (colspace ?x))))
 (:action column-b :parameters (?c - card ?x ?y ?u ?v - num)
  :precondition (and (incell ?c) (colspace ?x) (successor ?x ?y) (cellspace ?u) (successor ?v ?u))
  :effect (and (bottom ?c) (clear ?c) (colspace ?y) (cellspace ?v) (not (incell ?c)) (not (colspace ?x)) (not (cellspace ?u))))
 (:action uncell :parameters (?c ?n - card ?x ?y - num) :precondition (and (incell ?c) (clear ?n) (canstack ?c ?n) (cellspace ?x) (successor ?y ?x))
  :effect (and (on ?c ?n) (clear ?c) (cellspace ?y) (not (incell ?c)) (not (clear ?n)) (not (cellspace ?x))))
 (:action gohome :parameters (?c ?o - card ?s - suit ?v - num ?h - card ?w - num)
  :precondition (and (clear ?c) (on ?c ?o) (home ?h) (suit ?c ?s) (suit ?h ?s) (value ?c ?v) (value ?h ?w) (successor ?v ?w))
  :effect (and (home ?c) (clear ?o) (not (on ?c ?o)) (not (home ?h)) (not (clear ?c))))
 (:action gohome-b :parameters (?c - card ?s - suit ?v - num ?h - card ?w ?x ?y - num)
  :precondition (and (clear ?c) (bottom ?c) (home ?h) (suit ?c ?s) (suit ?h ?s) (value ?c ?v) (value ?h ?w) (successor ?v ?w) (colspace ?x) (successor ?y ?x))
  :effect (and (home ?c) (colspace ?y) (not (home ?h)) (not (clear ?c)) (not (bottom ?c)) (not (colspace ?x))))
 (:action gohome-c :parameters (?c - card ?s - suit ?v - num ?h - card ?w ?x ?y - num)
  :precondition (and (incell ?c) (home ?h) (suit ?c ?s) (suit ?h ?s) (value ?c ?v) (value ?h ?w) (successor ?v ?w) (cellspace ?x) (successor ?y ?x))
  :effect (and (home ?c) (cellspace ?y) (not (home ?h)) (not (incell ?c)) (not (cellspace ?x)))))";
    let mut random = Random::new(seed);
    let numbers = (ranks + 1).max(cells + 1).max(columns + 1);
    let mut init: Vec<String> =
        (1..numbers).map(|n| format!("(successor n{n} n{})", n - 1)).collect();
    init.push(format!("(cellspace n{cells})"));
    let mut cards = String::new();
    for suit in 0..suits {
        for rank in 0..=ranks {
            write!(cards, "k{suit}x{rank} ").expect("a string takes all text");
            init.push(format!("(suit k{suit}x{rank} s{suit}) (value k{suit}x{rank} n{rank})"));
            for other in
                (0..suits).filter(|other| other % 2 != suit % 2 && rank > 0 && rank < ranks)
            {
                init.push(format!("(canstack k{suit}x{rank} k{other}x{})", rank + 1));
            }
        }
        init.push(format!("(home k{suit}x0)"));
    }
    let mut column: Vec<Option<String>> = vec![None; columns];
    for (at, number) in shuffled(&mut random, suits * ranks).into_iter().enumerate() {
        let card = format!("k{}x{}", number / ranks, number % ranks + 1);
        match column[at % columns].replace(card.clone()) {
            None => init.push(format!("(bottom {card})")),
            Some(below) => init.push(format!("(on {card} {below})")),
        }
    }
    init.extend(column.iter().flatten().map(|card| format!("(clear {card})")));
    init.push(format!("(colspace n{})", column.iter().filter(|top| top.is_none()).count()));
    let goal: Vec<String> = (0..suits).map(|s| format!("(home k{s}x{ranks})")).collect();
    let all =
        format!("{cards}- card {}{}", objects("n", numbers, "num"), objects("s", suits, "suit"));
    instance(format!("freecell-{ranks}x{suits}/{seed}"), domain, &all, &init, &goal)
}

/// Tasks out of reach of any proof, for a plan soon.
pub(crate) fn soon() -> Vec<Instance> {
    vec![
        blocks(16, 3),
        blocks(40, 1),
        blocks(50, 1),
        blocks(60, 1),
        blocks(60, 2),
        depot(6, 2, 20, 1),
        depot(8, 3, 20, 2),
        depot(8, 3, 20, 3),
        driverlog(20, 4, 5, 15, 1),
        driverlog(30, 6, 6, 30, 1),
        freecell(13, 4, 4, 8, 1),
        elevators(16, 30, 1),
        elevators(24, 60, 1),
        transport(50, 4, 20, 1),
        parking(8, 14, 1),
        parking(11, 20, 1),
        parking(16, 30, 1),
        storage(4, 5, 3, 15, 1),
        storage(5, 5, 3, 20, 2),
        sokoban(10, 4, 1),
        visitall(40, 100, 1),
        tiles(5, 1),
        grid(10, 10, 10, 1),
        hiking(2, 4, 1),
        hiking(3, 6, 1),
        barman(6, 8, 1),
        barman(10, 15, 1),
        openstacks(40, 12, 1),
        woodworking(20, 4, 1),
        childsnack(20, 4, 1),
        floortile(5, 5, 1),
        termes(5, 4, 4, 1),
    ]
}

/// Tasks of about a hundred thousand ground actions.
pub(crate) fn large() -> Vec<Instance> {
    vec![
        logistics(20, 8, 4, 220, 1),
        zenotravel(8, 30, 40, 1),
        satellite(10, 20, 100, 80, 1),
        logistics(40, 10, 4, 400, 1),
    ]
}

/// An instance, and the least processor time in which IPP 4.1, STAN, SATPLAN06 or Madagascar (step-optimal)
/// solves the competition's instance of that family and size, in seconds; none where none does in a minute.
pub(crate) struct Measured {
    pub(crate) instance: Instance,
    pub(crate) best_peer: Option<f64>,
}

/// All sizes that are measured, smaller first within each family.
pub(crate) fn all() -> Vec<Measured> {
    let pairs: Vec<(Instance, f64)> = vec![
        (gripper(4), 0.003),
        (gripper(6), 0.013),
        (gripper(8), 0.144),
        (gripper(12), 11.0),
        (gripper(16), f64::INFINITY),
        (gripper(20), f64::INFINITY),
        (gripper(24), f64::INFINITY),
        (rocket(10, 2, 1), 0.020),
        (rocket(10, 2, 2), 0.021),
        (logistics(3, 3, 1, 8, 1), 0.017),
        (logistics(4, 3, 2, 9, 2), 0.115),
        (logistics(5, 3, 2, 11, 3), 0.18),
        (logistics(7, 3, 2, 14, 4), 0.056),
        (logistics(6, 2, 2, 12, 1), f64::INFINITY),
        (logistics(2, 2, 1, 6, 5), 0.004),
        (logistics(3, 2, 1, 9, 6), 0.009),
        (logistics(4, 2, 1, 12, 7), 0.021),
        (blocks(8, 1), 0.009),
        (blocks(10, 2), 0.049),
        (blocks(14, 3), 1.24),
        (blocks(14, 4), 1.24),
        (blocks(14, 2), 1.24),
        (blocks(16, 1), f64::INFINITY),
        (blocks(16, 2), f64::INFINITY),
        (depot(3, 2, 4, 1), 0.007),
        (depot(3, 2, 6, 2), 0.03),
        (depot(6, 2, 6, 3), 0.02),
        (driverlog(6, 2, 2, 4, 1), 0.004),
        (driverlog(7, 3, 3, 6, 2), 0.008),
        (driverlog(10, 3, 3, 9, 3), 0.11),
        (rovers(2, 4, 1, 1), 0.006),
        (rovers(2, 4, 2, 2), 0.006),
        (rovers(4, 6, 3, 3), 0.035),
        (rovers(4, 8, 6, 1), f64::INFINITY),
        (satellite(2, 4, 8, 4, 1), 0.005),
        (satellite(3, 6, 12, 7, 2), 0.18),
        (satellite(3, 6, 14, 9, 3), 0.016),
        (zenotravel(2, 4, 4, 1), 0.008),
        (zenotravel(3, 6, 5, 2), 0.02),
        (zenotravel(3, 8, 6, 3), 0.17),
        (zenotravel(3, 8, 8, 3), 0.17),
        (zenotravel(4, 10, 10, 1), f64::INFINITY),
        (freecell(2, 4, 4, 4, 1), 0.014),
        (freecell(3, 4, 4, 4, 2), 0.47),
        (miconic(4, 1), 0.005),
        (miconic(6, 2), 0.034),
        (miconic(8, 2), f64::INFINITY),
        (mystery(8, 3, 6, 4), 0.011),
        (mystery(10, 4, 8, 2), 0.009),
        (mystery(6, 3, 4, 1), 0.015),
        (tpp(5, 2, 2, 2, 1), 0.004),
        (tpp(6, 2, 2, 2, 2), 0.009),
        (tpp(8, 3, 2, 2, 3), 0.010),
        (elevators(12, 12, 1), f64::INFINITY),
        (transport(10, 2, 6, 1), f64::INFINITY),
        (parking(5, 8, 1), f64::INFINITY),
        (parking(6, 10, 1), f64::INFINITY),
        (storage(3, 3, 1, 4, 1), f64::INFINITY),
        (storage(4, 3, 1, 6, 1), f64::INFINITY),
        (sokoban(8, 3, 1), f64::INFINITY),
        (visitall(6, 100, 1), f64::INFINITY),
        (visitall(8, 100, 1), f64::INFINITY),
        (visitall(8, 50, 1), f64::INFINITY),
        (tiles(3, 1), f64::INFINITY),
        (grid(5, 5, 4, 1), f64::INFINITY),
        (hiking(2, 4, 1), f64::INFINITY),
        (barman(3, 2, 1), f64::INFINITY),
        (openstacks(10, 4, 1), f64::INFINITY),
        (openstacks(15, 4, 1), f64::INFINITY),
        (woodworking(9, 2, 1), f64::INFINITY),
        (childsnack(6, 2, 1), f64::INFINITY),
        (floortile(4, 4, 1), f64::INFINITY),
        (termes(4, 3, 2, 1), f64::INFINITY),
    ];
    let measured = |(instance, seconds): (Instance, f64)| Measured {
        instance,
        best_peer: seconds.is_finite().then_some(seconds),
    };
    pairs.into_iter().map(measured).collect()
}
