//! Families in which things or people are carried: by rocket, truck and airplane, hoist, driver, lift.

use std::fmt::Write;

use super::{Instance, Random, instance, objects, shuffled};

/// Two rockets with fuel for so many flights each bring cargo to two places.
pub(crate) fn rocket(cargos: usize, flights: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types place fuel - object rocket cargo - thing)
 (:predicates (at ?x - thing ?p - place) (in ?c - cargo ?r - rocket) (has-fuel ?r - rocket ?f - fuel))
 (:action move :parameters (?r - rocket ?a ?b - place ?f - fuel) :precondition (and (at ?r ?a) (has-fuel ?r ?f) (not (= ?a ?b)))
  :effect (and (at ?r ?b) (not (at ?r ?a)) (not (has-fuel ?r ?f))))
 (:action load :parameters (?c - cargo ?r - rocket ?p - place) :precondition (and (at ?c ?p) (at ?r ?p))
  :effect (and (in ?c ?r) (not (at ?c ?p))))
 (:action unload :parameters (?c - cargo ?r - rocket ?p - place) :precondition (and (in ?c ?r) (at ?r ?p))
  :effect (and (at ?c ?p) (not (in ?c ?r)))))";
    let mut random = Random::new(seed);
    let mut init: Vec<String> = (0..2).map(|r| format!("(at r{r} p{r})")).collect();
    for flight in 0..flights {
        init.push(format!("(has-fuel r0 f{flight}) (has-fuel r1 f{flight})"));
    }
    let mut goal = Vec::new();
    for cargo in 0..cargos {
        init.push(format!("(at c{cargo} p{})", random.below(2)));
        goal.push(format!("(at c{cargo} p{})", 2 + random.below(2)));
    }
    let all = format!(
        "{}{}{}",
        objects("p", 4, "place"),
        objects("r", 2, "rocket"),
        objects("c", cargos, "cargo") + &objects("f", flights, "fuel")
    );
    instance(format!("rocket-{cargos}-{flights}/{seed}"), domain, &all, &init, &goal)
}

/// Packages by trucks within cities and by airplanes between them.
pub(crate) fn logistics(
    cities: usize,
    places: usize,
    planes: usize,
    packages: usize,
    seed: u64,
) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing)
 (:types city place thing - object airport - place vehicle package - thing truck plane - vehicle)
 (:predicates (at ?x - thing ?p - place) (in ?x - package ?v - vehicle) (in-city ?p - place ?c - city))
 (:action load :parameters (?x - package ?v - vehicle ?p - place) :precondition (and (at ?v ?p) (at ?x ?p))
  :effect (and (in ?x ?v) (not (at ?x ?p))))
 (:action unload :parameters (?x - package ?v - vehicle ?p - place) :precondition (and (at ?v ?p) (in ?x ?v))
  :effect (and (at ?x ?p) (not (in ?x ?v))))
 (:action drive :parameters (?t - truck ?a ?b - place ?c - city)
  :precondition (and (at ?t ?a) (in-city ?a ?c) (in-city ?b ?c) (not (= ?a ?b))) :effect (and (at ?t ?b) (not (at ?t ?a))))
 (:action fly :parameters (?p - plane ?a ?b - airport) :precondition (and (at ?p ?a) (not (= ?a ?b)))
  :effect (and (at ?p ?b) (not (at ?p ?a)))))";
    let mut random = Random::new(seed);
    let (mut init, mut goal) = (Vec::new(), Vec::new());
    let mut airports = String::new();
    let mut others = String::new();
    for city in 0..cities {
        write!(airports, "l{city}x0 ").expect("a string takes all text");
        for place in 0..places {
            init.push(format!("(in-city l{city}x{place} c{city})"));
            if place > 0 {
                write!(others, "l{city}x{place} ").expect("a string takes all text");
            }
        }
        init.push(format!("(at t{city} l{city}x{})", random.below(places)));
    }
    init.extend((0..planes).map(|p| format!("(at a{p} l{}x0)", random.below(cities))));
    for package in 0..packages {
        let mut spot = || format!("l{}x{}", random.below(cities), random.below(places));
        init.push(format!("(at p{package} {})", spot()));
        goal.push(format!("(at p{package} {})", spot()));
    }
    let all = format!(
        "{airports}- airport {others}- place {}{}{}{}",
        objects("c", cities, "city"),
        objects("t", cities, "truck"),
        objects("a", planes, "plane"),
        objects("p", packages, "package")
    );
    instance(format!("logistics-{cities}x{places}-{packages}/{seed}"), domain, &all, &init, &goal)
}

/// Crates on pallets, hoisted onto trucks.
pub(crate) fn depot(places: usize, trucks: usize, crates: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing)
 (:types place truck hoist surface - object pallet crate - surface)
 (:predicates (at ?t - truck ?p - place) (hoist-at ?h - hoist ?p - place) (rests ?s - surface ?p - place)
  (on ?c - crate ?s - surface) (in ?c - crate ?t - truck) (lifting ?h - hoist ?c - crate) (available ?h - hoist) (clear ?s - surface))
 (:action drive :parameters (?t - truck ?a ?b - place) :precondition (and (at ?t ?a) (not (= ?a ?b))) :effect (and (at ?t ?b) (not (at ?t ?a))))
 (:action lift :parameters (?h - hoist ?c - crate ?s - surface ?p - place)
  :precondition (and (hoist-at ?h ?p) (available ?h) (rests ?c ?p) (on ?c ?s) (clear ?c))
  :effect (and (not (rests ?c ?p)) (lifting ?h ?c) (not (clear ?c)) (not (available ?h)) (clear ?s) (not (on ?c ?s))))
 (:action drop :parameters (?h - hoist ?c - crate ?s - surface ?p - place)
  :precondition (and (hoist-at ?h ?p) (rests ?s ?p) (clear ?s) (lifting ?h ?c))
  :effect (and (available ?h) (not (lifting ?h ?c)) (rests ?c ?p) (not (clear ?s)) (clear ?c) (on ?c ?s)))
 (:action load :parameters (?h - hoist ?c - crate ?t - truck ?p - place)
  :precondition (and (hoist-at ?h ?p) (at ?t ?p) (lifting ?h ?c)) :effect (and (not (lifting ?h ?c)) (in ?c ?t) (available ?h)))
 (:action unload :parameters (?h - hoist ?c - crate ?t - truck ?p - place)
  :precondition (and (hoist-at ?h ?p) (at ?t ?p) (available ?h) (in ?c ?t))
  :effect (and (not (in ?c ?t)) (not (available ?h)) (lifting ?h ?c))))";
    let mut random = Random::new(seed);
    let mut init = Vec::new();
    for place in 0..places {
        init.push(format!(
            "(hoist-at h{place} p{place}) (available h{place}) (rests s{place} p{place})"
        ));
    }
    init.extend((0..trucks).map(|t| format!("(at t{t} p{})", random.below(places))));
    let stack = |random: &mut Random, init: Option<&mut Vec<String>>| {
        let mut top: Vec<String> = (0..places).map(|p| format!("s{p}")).collect();
        let mut facts = Vec::new();
        for number in shuffled(random, crates) {
            let place = random.below(places);
            let below = std::mem::replace(&mut top[place], format!("c{number}"));
            facts.push((format!("(on c{number} {below})"), format!("(rests c{number} p{place})")));
        }
        if let Some(init) = init {
            init.extend(top.iter().map(|surface| format!("(clear {surface})")));
            init.extend(facts.iter().map(|(on, rests)| format!("{on} {rests}")));
        }
        facts
    };
    stack(&mut random, Some(&mut init));
    let goal: Vec<String> = stack(&mut random, None).into_iter().map(|(on, _)| on).collect();
    let all = format!(
        "{}{}{}{}{}",
        objects("p", places, "place"),
        objects("t", trucks, "truck"),
        objects("h", places, "hoist"),
        objects("s", places, "pallet"),
        objects("c", crates, "crate")
    );
    instance(format!("depot-{places}-{trucks}-{crates}/{seed}"), domain, &all, &init, &goal)
}

/// Drivers walk to trucks and drive packages.
pub(crate) fn driverlog(
    places: usize,
    drivers: usize,
    trucks: usize,
    packages: usize,
    seed: u64,
) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types place thing - object driver truck package - thing)
 (:predicates (at ?x - thing ?p - place) (in ?x - package ?t - truck) (driving ?d - driver ?t - truck) (empty ?t - truck)
  (link ?a ?b - place) (path ?a ?b - place))
 (:action load :parameters (?x - package ?t - truck ?p - place) :precondition (and (at ?t ?p) (at ?x ?p)) :effect (and (not (at ?x ?p)) (in ?x ?t)))
 (:action unload :parameters (?x - package ?t - truck ?p - place) :precondition (and (at ?t ?p) (in ?x ?t)) :effect (and (not (in ?x ?t)) (at ?x ?p)))
 (:action board :parameters (?d - driver ?t - truck ?p - place) :precondition (and (at ?t ?p) (at ?d ?p) (empty ?t))
  :effect (and (not (at ?d ?p)) (driving ?d ?t) (not (empty ?t))))
 (:action leave :parameters (?d - driver ?t - truck ?p - place) :precondition (and (at ?t ?p) (driving ?d ?t))
  :effect (and (not (driving ?d ?t)) (at ?d ?p) (empty ?t)))
 (:action drive :parameters (?t - truck ?a ?b - place ?d - driver) :precondition (and (at ?t ?a) (driving ?d ?t) (link ?a ?b))
  :effect (and (not (at ?t ?a)) (at ?t ?b)))
 (:action walk :parameters (?d - driver ?a ?b - place) :precondition (and (at ?d ?a) (path ?a ?b)) :effect (and (not (at ?d ?a)) (at ?d ?b))))";
    let mut random = Random::new(seed);
    let mut init = Vec::new();
    for kind in ["link", "path"] {
        for place in 1..places {
            let other = random.below(place);
            init.push(format!("({kind} p{place} p{other}) ({kind} p{other} p{place})"));
        }
        for _ in 0..places / 2 {
            let (a, b) = (random.below(places), random.below(places));
            init.push(format!("({kind} p{a} p{b}) ({kind} p{b} p{a})"));
        }
    }
    init.extend((0..drivers).map(|d| format!("(at d{d} p{})", random.below(places))));
    init.extend((0..trucks).map(|t| format!("(at t{t} p{}) (empty t{t})", random.below(places))));
    let mut goal = Vec::new();
    for package in 0..packages {
        init.push(format!("(at x{package} p{})", random.below(places)));
        goal.push(format!("(at x{package} p{})", random.below(places)));
    }
    goal.push(format!("(at d0 p{})", random.below(places)));
    goal.push(format!("(at t0 p{})", random.below(places)));
    let all = format!(
        "{}{}{}{}",
        objects("p", places, "place"),
        objects("d", drivers, "driver"),
        objects("t", trucks, "truck"),
        objects("x", packages, "package")
    );
    instance(
        format!("driverlog-{places}-{drivers}-{trucks}-{packages}/{seed}"),
        domain,
        &all,
        &init,
        &goal,
    )
}

/// Aircraft with levels of fuel carry people between cities.
pub(crate) fn zenotravel(planes: usize, people: usize, cities: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types city level thing - object plane person - thing)
 (:predicates (at ?x - thing ?c - city) (in ?p - person ?a - plane) (fuel ?a - plane ?l - level) (next ?a ?b - level))
 (:action board :parameters (?p - person ?a - plane ?c - city) :precondition (and (at ?p ?c) (at ?a ?c)) :effect (and (not (at ?p ?c)) (in ?p ?a)))
 (:action debark :parameters (?p - person ?a - plane ?c - city) :precondition (and (in ?p ?a) (at ?a ?c)) :effect (and (not (in ?p ?a)) (at ?p ?c)))
 (:action fly :parameters (?a - plane ?x ?y - city ?f ?g - level) :precondition (and (at ?a ?x) (fuel ?a ?f) (next ?g ?f) (not (= ?x ?y)))
  :effect (and (not (at ?a ?x)) (at ?a ?y) (not (fuel ?a ?f)) (fuel ?a ?g)))
 (:action zoom :parameters (?a - plane ?x ?y - city ?f ?g ?h - level)
  :precondition (and (at ?a ?x) (fuel ?a ?f) (next ?g ?f) (next ?h ?g) (not (= ?x ?y)))
  :effect (and (not (at ?a ?x)) (at ?a ?y) (not (fuel ?a ?f)) (fuel ?a ?h)))
 (:action refuel :parameters (?a - plane ?c - city ?f ?g - level) :precondition (and (fuel ?a ?f) (next ?f ?g) (at ?a ?c))
  :effect (and (fuel ?a ?g) (not (fuel ?a ?f)))))";
    let mut random = Random::new(seed);
    let mut init: Vec<String> = (1..7).map(|l| format!("(next f{} f{l})", l - 1)).collect();
    let mut goal = Vec::new();
    for plane in 0..planes {
        init.push(format!(
            "(at a{plane} c{}) (fuel a{plane} f{})",
            random.below(cities),
            random.below(4)
        ));
    }
    for person in 0..people {
        init.push(format!("(at p{person} c{})", random.below(cities)));
        goal.push(format!("(at p{person} c{})", random.below(cities)));
    }
    goal.push(format!("(at a0 c{})", random.below(cities)));
    let all = format!(
        "{}{}{}{}",
        objects("a", planes, "plane"),
        objects("p", people, "person"),
        objects("c", cities, "city"),
        objects("f", 7, "level")
    );
    instance(format!("zenotravel-{planes}-{people}-{cities}/{seed}"), domain, &all, &init, &goal)
}

/// Vehicles with room for few, fuel that places run out of.
pub(crate) fn mystery(places: usize, vehicles: usize, cargos: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types place fuel space thing - object vehicle cargo - thing)
 (:predicates (at ?x - thing ?p - place) (road ?a ?b - place) (has-fuel ?p - place ?f - fuel) (less-fuel ?a ?b - fuel)
  (in ?c - cargo ?v - vehicle) (has-space ?v - vehicle ?s - space) (less-space ?a ?b - space))
 (:action move :parameters (?v - vehicle ?a ?b - place ?f ?g - fuel)
  :precondition (and (at ?v ?a) (road ?a ?b) (has-fuel ?a ?f) (less-fuel ?g ?f))
  :effect (and (not (at ?v ?a)) (at ?v ?b) (not (has-fuel ?a ?f)) (has-fuel ?a ?g)))
 (:action load :parameters (?c - cargo ?v - vehicle ?p - place ?s ?r - space)
  :precondition (and (at ?c ?p) (at ?v ?p) (has-space ?v ?s) (less-space ?r ?s))
  :effect (and (not (at ?c ?p)) (in ?c ?v) (not (has-space ?v ?s)) (has-space ?v ?r)))
 (:action unload :parameters (?c - cargo ?v - vehicle ?p - place ?s ?r - space)
  :precondition (and (in ?c ?v) (at ?v ?p) (has-space ?v ?r) (less-space ?r ?s))
  :effect (and (not (in ?c ?v)) (at ?c ?p) (not (has-space ?v ?r)) (has-space ?v ?s))))";
    let mut random = Random::new(seed);
    let mut init: Vec<String> = (1..4).map(|l| format!("(less-fuel f{} f{l})", l - 1)).collect();
    init.extend((1..4).map(|l| format!("(less-space s{} s{l})", l - 1)));
    for place in 1..places {
        let other = random.below(place);
        init.push(format!("(road p{place} p{other}) (road p{other} p{place})"));
    }
    for _ in 0..places / 2 {
        let (a, b) = (random.below(places), random.below(places));
        init.push(format!("(road p{a} p{b}) (road p{b} p{a})"));
    }
    init.extend((0..places).map(|p| format!("(has-fuel p{p} f{})", random.below(4))));
    init.extend((0..vehicles).map(|v| {
        format!("(at v{v} p{}) (has-space v{v} s{})", random.below(places), 1 + random.below(3))
    }));
    init.extend((0..cargos).map(|c| format!("(at c{c} p{})", random.below(places))));
    let goal: Vec<String> =
        (0..3).map(|c| format!("(at c{c} p{})", random.below(places))).collect();
    let all = format!(
        "{}{}{}{}{}",
        objects("p", places, "place"),
        objects("f", 4, "fuel"),
        objects("s", 4, "space"),
        objects("v", vehicles, "vehicle"),
        objects("c", cargos, "cargo")
    );
    instance(format!("mystery-{places}-{vehicles}-{cargos}/{seed}"), domain, &all, &init, &goal)
}

/// Trucks buy goods at markets and store them at a depot, by levels of stock.
pub(crate) fn tpp(
    goods: usize,
    markets: usize,
    trucks: usize,
    levels: usize,
    seed: u64,
) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types place truck goods level - object depot market - place)
 (:predicates (loaded ?g - goods ?t - truck ?l - level) (ready ?g - goods ?m - market ?l - level) (stored ?g - goods ?l - level)
  (sale ?g - goods ?m - market ?l - level) (next ?a ?b - level) (at ?t - truck ?p - place) (road ?a ?b - place))
 (:action drive :parameters (?t - truck ?a ?b - place) :precondition (and (at ?t ?a) (road ?a ?b)) :effect (and (not (at ?t ?a)) (at ?t ?b)))
 (:action load :parameters (?g - goods ?t - truck ?m - market ?l1 ?l2 ?l3 ?l4 - level)
  :precondition (and (at ?t ?m) (loaded ?g ?t ?l3) (ready ?g ?m ?l2) (next ?l2 ?l1) (next ?l4 ?l3))
  :effect (and (loaded ?g ?t ?l4) (not (loaded ?g ?t ?l3)) (ready ?g ?m ?l1) (not (ready ?g ?m ?l2))))
 (:action unload :parameters (?g - goods ?t - truck ?d - depot ?l1 ?l2 ?l3 ?l4 - level)
  :precondition (and (at ?t ?d) (loaded ?g ?t ?l2) (stored ?g ?l3) (next ?l2 ?l1) (next ?l4 ?l3))
  :effect (and (loaded ?g ?t ?l1) (not (loaded ?g ?t ?l2)) (stored ?g ?l4) (not (stored ?g ?l3))))
 (:action buy :parameters (?t - truck ?g - goods ?m - market ?l1 ?l2 ?l3 ?l4 - level)
  :precondition (and (at ?t ?m) (sale ?g ?m ?l2) (ready ?g ?m ?l3) (next ?l2 ?l1) (next ?l4 ?l3))
  :effect (and (sale ?g ?m ?l1) (not (sale ?g ?m ?l2)) (ready ?g ?m ?l4) (not (ready ?g ?m ?l3)))))";
    let mut random = Random::new(seed);
    let mut init: Vec<String> = (1..=levels).map(|l| format!("(next l{l} l{})", l - 1)).collect();
    init.extend((0..markets).map(|m| format!("(road m{m} d0) (road d0 m{m})")));
    init.extend((1..markets).map(|m| format!("(road m{m} m{0}) (road m{0} m{m})", m - 1)));
    init.extend((0..trucks).map(|t| format!("(at t{t} d0)")));
    let mut goal = Vec::new();
    for good in 0..goods {
        init.push(format!("(stored g{good} l0)"));
        init.extend((0..trucks).map(|t| format!("(loaded g{good} t{t} l0)")));
        let source = random.below(markets);
        for market in 0..markets {
            let level = if market == source { levels } else { random.below(levels) };
            init.push(format!("(ready g{good} m{market} l0) (sale g{good} m{market} l{level})"));
        }
        goal.push(format!("(stored g{good} l{})", 1 + random.below(levels)));
    }
    let all = format!(
        "d0 - depot {}{}{}{}",
        objects("m", markets, "market"),
        objects("t", trucks, "truck"),
        objects("g", goods, "goods"),
        objects("l", levels + 1, "level")
    );
    instance(format!("tpp-{goods}-{markets}-{trucks}/{seed}"), domain, &all, &init, &goal)
}

/// A lift serves passengers.
pub(crate) fn miconic(passengers: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types floor passenger)
 (:predicates (origin ?p - passenger ?f - floor) (destination ?p - passenger ?f - floor) (above ?a ?b - floor)
  (boarded ?p - passenger) (served ?p - passenger) (lift-at ?f - floor))
 (:action board :parameters (?f - floor ?p - passenger) :precondition (and (lift-at ?f) (origin ?p ?f)) :effect (boarded ?p))
 (:action depart :parameters (?f - floor ?p - passenger) :precondition (and (lift-at ?f) (destination ?p ?f) (boarded ?p))
  :effect (and (not (boarded ?p)) (served ?p)))
 (:action up :parameters (?a ?b - floor) :precondition (and (lift-at ?a) (above ?a ?b)) :effect (and (lift-at ?b) (not (lift-at ?a))))
 (:action down :parameters (?a ?b - floor) :precondition (and (lift-at ?a) (above ?b ?a)) :effect (and (lift-at ?b) (not (lift-at ?a)))))";
    let mut random = Random::new(seed);
    let floors = 2 * passengers;
    let mut init = vec!["(lift-at f0)".to_owned()];
    for a in 0..floors {
        init.extend((a + 1..floors).map(|b| format!("(above f{a} f{b})")));
    }
    for passenger in 0..passengers {
        let (from, to) = (random.below(floors), random.below(floors - 1));
        let to = if to >= from { to + 1 } else { to };
        init.push(format!("(origin p{passenger} f{from}) (destination p{passenger} f{to})"));
    }
    let goal: Vec<String> = (0..passengers).map(|p| format!("(served p{p})")).collect();
    let all = format!("{}{}", objects("f", floors, "floor"), objects("p", passengers, "passenger"));
    instance(format!("miconic-{passengers}/{seed}"), domain, &all, &init, &goal)
}
