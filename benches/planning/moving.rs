//! Families in which things stand in each other's way: lifts, lorries, cars on a kerb, crates in a store, stones in a
//! maze, tiles in a frame, keys and locked places.

use super::{Instance, Random, instance, objects, shuffled};

/// Fast lifts stop at some floors, slow ones serve a block of them; people change.
pub(crate) fn elevators(floors: usize, people: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types lift - object slow fast - lift person count)
 (:predicates (at ?p - person ?f - count) (in ?p - person ?l - lift) (lift-at ?l - lift ?f - count) (stops ?l - lift ?f - count)
  (above ?a ?b - count) (load ?l - lift ?n - count) (room ?l - lift ?n - count) (next ?a ?b - count))
 (:action up-slow :parameters (?l - slow ?a ?b - count) :precondition (and (lift-at ?l ?a) (above ?a ?b) (stops ?l ?b))
  :effect (and (lift-at ?l ?b) (not (lift-at ?l ?a))))
 (:action down-slow :parameters (?l - slow ?a ?b - count) :precondition (and (lift-at ?l ?a) (above ?b ?a) (stops ?l ?b))
  :effect (and (lift-at ?l ?b) (not (lift-at ?l ?a))))
 (:action up-fast :parameters (?l - fast ?a ?b - count) :precondition (and (lift-at ?l ?a) (above ?a ?b) (stops ?l ?b))
  :effect (and (lift-at ?l ?b) (not (lift-at ?l ?a))))
 (:action down-fast :parameters (?l - fast ?a ?b - count) :precondition (and (lift-at ?l ?a) (above ?b ?a) (stops ?l ?b))
  :effect (and (lift-at ?l ?b) (not (lift-at ?l ?a))))
 (:action board :parameters (?p - person ?l - lift ?f ?n ?m - count)
  :precondition (and (lift-at ?l ?f) (at ?p ?f) (load ?l ?n) (next ?n ?m) (room ?l ?m))
  :effect (and (not (at ?p ?f)) (in ?p ?l) (not (load ?l ?n)) (load ?l ?m)))
 (:action leave :parameters (?p - person ?l - lift ?f ?n ?m - count)
  :precondition (and (lift-at ?l ?f) (in ?p ?l) (load ?l ?n) (next ?m ?n))
  :effect (and (at ?p ?f) (not (in ?p ?l)) (not (load ?l ?n)) (load ?l ?m))))";
    let mut random = Random::new(seed);
    // Two blocks of floors that share one; a slow lift and half a fast one for each.
    let half = floors / 2;
    let mut init: Vec<String> = Vec::new();
    for a in 0..=floors {
        init.extend((a + 1..=floors).map(|b| format!("(above n{a} n{b})")));
    }
    init.extend((0..floors).map(|n| format!("(next n{n} n{})", n + 1)));
    for (block, first) in [0, half].into_iter().enumerate() {
        for slow in 0..2 {
            let lift = format!("s{}", 2 * block + slow);
            init.extend((first..=first + half).map(|f| format!("(stops {lift} n{f})")));
            init.push(format!("(lift-at {lift} n{}) (load {lift} n0)", first + random.below(half)));
            init.extend((1..=2).map(|n| format!("(room {lift} n{n})")));
        }
    }
    let every = (half / 2).max(1);
    for fast in 0..2 {
        let stops: Vec<usize> = (0..=floors).step_by(every).collect();
        init.extend(stops.iter().map(|f| format!("(stops q{fast} n{f})")));
        init.push(format!(
            "(lift-at q{fast} n{}) (load q{fast} n0)",
            stops[random.below(stops.len())]
        ));
        init.extend((1..=3).map(|n| format!("(room q{fast} n{n})")));
    }
    let mut goal = Vec::new();
    for person in 0..people {
        let (from, to) = (random.below(floors + 1), random.below(floors + 1));
        init.push(format!("(at p{person} n{from})"));
        goal.push(format!("(at p{person} n{to})"));
    }
    let all = format!(
        "{}{}{}{}",
        objects("s", 4, "slow"),
        objects("q", 2, "fast"),
        objects("p", people, "person"),
        objects("n", floors + 1, "count")
    );
    instance(format!("elevators-{floors}-{people}/{seed}"), domain, &all, &init, &goal)
}

/// Lorries with room for few bring packages along roads.
pub(crate) fn transport(places: usize, lorries: usize, packages: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types place size thing - object lorry package - thing)
 (:predicates (road ?a ?b - place) (at ?x - thing ?p - place) (in ?x - package ?l - lorry) (room ?l - lorry ?s - size) (less ?a ?b - size))
 (:action drive :parameters (?l - lorry ?a ?b - place) :precondition (and (at ?l ?a) (road ?a ?b)) :effect (and (not (at ?l ?a)) (at ?l ?b)))
 (:action load :parameters (?l - lorry ?p - place ?x - package ?r ?s - size)
  :precondition (and (at ?l ?p) (at ?x ?p) (less ?r ?s) (room ?l ?s)) :effect (and (not (at ?x ?p)) (in ?x ?l) (room ?l ?r) (not (room ?l ?s))))
 (:action unload :parameters (?l - lorry ?p - place ?x - package ?r ?s - size)
  :precondition (and (at ?l ?p) (in ?x ?l) (less ?r ?s) (room ?l ?r)) :effect (and (not (in ?x ?l)) (at ?x ?p) (room ?l ?s) (not (room ?l ?r)))))";
    let mut random = Random::new(seed);
    let mut init: Vec<String> = (0..4).map(|s| format!("(less s{s} s{})", s + 1)).collect();
    for place in 1..places {
        let other = random.below(place);
        init.push(format!("(road p{place} p{other}) (road p{other} p{place})"));
    }
    for _ in 0..places / 2 {
        let (a, b) = (random.below(places), random.below(places));
        init.push(format!("(road p{a} p{b}) (road p{b} p{a})"));
    }
    init.extend((0..lorries).map(|l| {
        format!("(at l{l} p{}) (room l{l} s{})", random.below(places), 2 + random.below(3))
    }));
    let mut goal = Vec::new();
    for package in 0..packages {
        init.push(format!("(at x{package} p{})", random.below(places)));
        goal.push(format!("(at x{package} p{})", random.below(places)));
    }
    let all = format!(
        "{}{}{}{}",
        objects("p", places, "place"),
        objects("l", lorries, "lorry"),
        objects("x", packages, "package"),
        objects("s", 5, "size")
    );
    instance(format!("transport-{places}-{lorries}-{packages}/{seed}"), domain, &all, &init, &goal)
}

/// Cars stand on a kerb in two rows; only the outer one of two can drive away.
pub(crate) fn parking(kerbs: usize, cars: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types car kerb)
 (:predicates (at-kerb ?c - car) (parks ?c - car ?k - kerb) (behind ?c ?d - car) (clear ?c - car) (free ?k - kerb))
 (:action kerb-to-kerb :parameters (?c - car ?a ?b - kerb) :precondition (and (clear ?c) (free ?b) (parks ?c ?a))
  :effect (and (not (free ?b)) (free ?a) (parks ?c ?b) (not (parks ?c ?a))))
 (:action kerb-to-car :parameters (?c - car ?a - kerb ?d - car) :precondition (and (clear ?c) (clear ?d) (parks ?c ?a) (at-kerb ?d) (not (= ?c ?d)))
  :effect (and (not (clear ?d)) (free ?a) (behind ?c ?d) (not (parks ?c ?a)) (not (at-kerb ?c))))
 (:action car-to-kerb :parameters (?c - car ?b - kerb ?d - car) :precondition (and (clear ?c) (free ?b) (behind ?c ?d))
  :effect (and (not (free ?b)) (clear ?d) (parks ?c ?b) (not (behind ?c ?d)) (at-kerb ?c)))
 (:action car-to-car :parameters (?c ?d ?e - car) :precondition (and (clear ?c) (clear ?e) (behind ?c ?d) (at-kerb ?e) (not (= ?c ?e)))
  :effect (and (not (clear ?e)) (clear ?d) (behind ?c ?e) (not (behind ?c ?d)))))";
    let mut random = Random::new(seed);
    let row = |random: &mut Random, whole: bool| {
        let order = shuffled(random, cars);
        // One kerb is left free at first, and cars fill the others from the inside.
        let inner = (kerbs - usize::from(whole)).min(cars);
        let mut facts = Vec::new();
        for (at, car) in order.iter().enumerate() {
            if at < inner {
                facts.push(format!("(parks c{car} k{at})"));
            } else {
                facts.push(format!("(behind c{car} c{})", order[at - inner]));
            }
            if whole {
                if at < inner {
                    facts.push(format!("(at-kerb c{car})"));
                }
                if at + inner >= cars {
                    facts.push(format!("(clear c{car})"));
                }
            }
        }
        if whole {
            facts.extend((inner..kerbs).map(|k| format!("(free k{k})")));
        }
        facts
    };
    let init = row(&mut random, true);
    let goal = row(&mut random, false);
    let all = format!("{}{}", objects("c", cars, "car"), objects("k", kerbs, "kerb"));
    instance(format!("parking-{kerbs}-{cars}/{seed}"), domain, &all, &init, &goal)
}

/// Hoists bring crates from containers into a store whose places fill up.
pub(crate) fn storage(
    width: usize,
    depth: usize,
    hoists: usize,
    crates: usize,
    seed: u64,
) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types hoist crate area yard)
 (:predicates (clear ?a - area) (in-yard ?a - area ?y - yard) (on ?c - crate ?a - area) (at ?h - hoist ?a - area) (available ?h - hoist)
  (lifting ?h - hoist ?c - crate) (next ?a ?b - area) (inside ?c - crate ?y - yard) (indoors ?a - area))
 (:action lift :parameters (?h - hoist ?c - crate ?a ?b - area ?y - yard)
  :precondition (and (next ?a ?b) (available ?h) (at ?h ?b) (on ?c ?a) (in-yard ?a ?y))
  :effect (and (not (on ?c ?a)) (clear ?a) (not (available ?h)) (lifting ?h ?c) (not (inside ?c ?y))))
 (:action drop :parameters (?h - hoist ?c - crate ?a ?b - area ?y - yard)
  :precondition (and (next ?a ?b) (at ?h ?b) (lifting ?h ?c) (clear ?a) (in-yard ?a ?y) (indoors ?a))
  :effect (and (not (lifting ?h ?c)) (available ?h) (not (clear ?a)) (on ?c ?a) (inside ?c ?y)))
 (:action move :parameters (?h - hoist ?a ?b - area) :precondition (and (at ?h ?a) (clear ?b) (next ?a ?b) (indoors ?b))
  :effect (and (not (at ?h ?a)) (at ?h ?b) (not (clear ?b)) (clear ?a)))
 (:action go-out :parameters (?h - hoist ?a ?b - area) :precondition (and (at ?h ?a) (next ?a ?b) (indoors ?a) (not (indoors ?b)) (clear ?b))
  :effect (and (not (at ?h ?a)) (at ?h ?b) (clear ?a))))";
    let mut random = Random::new(seed);
    let mut init = Vec::new();
    let area = |x: usize, y: usize| format!("a{}", y * width + x);
    for y in 0..depth {
        for x in 0..width {
            init.push(format!("(in-yard {} store) (indoors {})", area(x, y), area(x, y)));
            let beside =
                [(x + 1 < width).then(|| area(x + 1, y)), (y + 1 < depth).then(|| area(x, y + 1))];
            for other in beside.into_iter().flatten() {
                init.push(format!("(next {0} {other}) (next {other} {0})", area(x, y)));
            }
        }
    }
    // The way in leads over the first place; crates stand round the load area outside it, which takes any number of hoists.
    init.push("(next out a0) (next a0 out) (clear out)".to_owned());
    for number in 0..crates {
        init.push(format!(
            "(next k{number} out) (next out k{number}) (in-yard k{number} container)"
        ));
        init.push(format!("(on c{number} k{number}) (inside c{number} container)"));
    }
    let places = shuffled(&mut random, width * depth);
    for (at, place) in places.iter().enumerate() {
        if at < hoists {
            init.push(format!("(at h{at} a{place}) (available h{at})"));
        } else {
            init.push(format!("(clear a{place})"));
        }
    }
    let goal: Vec<String> = (0..crates).map(|c| format!("(inside c{c} store)")).collect();
    let all = format!(
        "{}{}{}{}out - area store container - yard",
        objects("h", hoists, "hoist"),
        objects("c", crates, "crate"),
        objects("a", width * depth, "area"),
        objects("k", crates, "area")
    );
    instance(
        format!("storage-{width}x{depth}-{hoists}-{crates}/{seed}"),
        domain,
        &all,
        &init,
        &goal,
    )
}

/// A man pushes stones onto marked places; the goal is a drawn end from which stones were pulled away.
pub(crate) fn sokoban(size: usize, stones: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types dir place stone)
 (:predicates (clear ?p - place) (man ?p - place) (at ?s - stone ?p - place) (way ?a ?b - place ?d - dir) (mark ?p - place) (home ?s - stone))
 (:action move :parameters (?a ?b - place ?d - dir) :precondition (and (man ?a) (clear ?b) (way ?a ?b ?d))
  :effect (and (not (man ?a)) (clear ?a) (man ?b) (not (clear ?b))))
 (:action push-off :parameters (?s - stone ?a ?b ?c - place ?d - dir)
  :precondition (and (man ?a) (at ?s ?b) (clear ?c) (way ?a ?b ?d) (way ?b ?c ?d) (not (mark ?c)))
  :effect (and (not (man ?a)) (clear ?a) (man ?b) (not (at ?s ?b)) (at ?s ?c) (not (clear ?c)) (not (home ?s))))
 (:action push-home :parameters (?s - stone ?a ?b ?c - place ?d - dir)
  :precondition (and (man ?a) (at ?s ?b) (clear ?c) (way ?a ?b ?d) (way ?b ?c ?d) (mark ?c))
  :effect (and (not (man ?a)) (clear ?a) (man ?b) (not (at ?s ?b)) (at ?s ?c) (not (clear ?c)) (home ?s))))";
    const STEPS: [(isize, isize); 4] = [(1, 0), (-1, 0), (0, 1), (0, -1)];
    let mut random = Random::new(seed);
    let cells = size * size;
    let mut wall = vec![false; cells];
    (0..cells / 5).for_each(|_| wall[random.below(cells)] = true);
    let from = |at: usize, (dx, dy): (isize, isize)| {
        let (x, y) = ((at % size).checked_add_signed(dx)?, (at / size).checked_add_signed(dy)?);
        (x < size && y < size).then(|| y * size + x)
    };
    let free: Vec<usize> =
        shuffled(&mut random, cells).into_iter().filter(|&at| !wall[at]).collect();
    let marks: Vec<usize> = free[..stones].to_vec();
    let mut at = marks.clone();
    let mut man = free[stones];
    // Backward from the end: the man walks at random and pulls what stands behind him.
    for _ in 0..400 * stones {
        let step = STEPS[random.below(4)];
        let back = (-step.0, -step.1);
        let Some(to) = from(man, step).filter(|&to| !wall[to] && !at.contains(&to)) else {
            continue;
        };
        if let Some(behind) = from(man, back)
            && let Some(stone) = at.iter().position(|&stone| stone == behind)
            && random.below(3) > 0
        {
            at[stone] = man;
        }
        man = to;
    }
    let mut init: Vec<String> = vec![format!("(man p{man})")];
    for cell in (0..cells).filter(|&cell| !wall[cell]) {
        for (number, step) in STEPS.into_iter().enumerate() {
            if let Some(to) = from(cell, step).filter(|&to| !wall[to]) {
                init.push(format!("(way p{cell} p{to} d{number})"));
            }
        }
        if cell != man && !at.contains(&cell) {
            init.push(format!("(clear p{cell})"));
        }
    }
    init.extend(marks.iter().map(|cell| format!("(mark p{cell})")));
    for (stone, cell) in at.iter().enumerate() {
        init.push(format!("(at s{stone} p{cell})"));
        if marks.contains(cell) {
            init.push(format!("(home s{stone})"));
        }
    }
    let goal: Vec<String> = (0..stones).map(|s| format!("(home s{s})")).collect();
    let all = format!(
        "{}{}{}",
        objects("d", 4, "dir"),
        objects("p", cells, "place"),
        objects("s", stones, "stone")
    );
    instance(format!("sokoban-{size}-{stones}/{seed}"), domain, &all, &init, &goal)
}

/// Roads of a grid, all or part of whose crossings are to be visited.
pub(crate) fn visitall(size: usize, percent: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types place)
 (:predicates (next ?a ?b - place) (at ?p - place) (visited ?p - place))
 (:action move :parameters (?a ?b - place) :precondition (and (at ?a) (next ?a ?b)) :effect (and (not (at ?a)) (at ?b) (visited ?b))))";
    let mut random = Random::new(seed);
    let mut init = Vec::new();
    neighbours(size, size, |a, b, _| init.push(format!("(next p{a} p{b}) (next p{b} p{a})")));
    let start = random.below(size * size);
    init.push(format!("(at p{start}) (visited p{start})"));
    let goal: Vec<String> = (0..size * size)
        .filter(|_| random.below(100) < percent)
        .map(|p| format!("(visited p{p})"))
        .collect();
    instance(
        format!("visitall-{size}-{percent}/{seed}"),
        domain,
        &objects("p", size * size, "place"),
        &init,
        &goal,
    )
}

/// Each cell of a grid with those to the right of it and below it, and which of the two it is.
fn neighbours(width: usize, height: usize, mut tell: impl FnMut(usize, usize, bool)) {
    for at in 0..width * height {
        if at % width + 1 < width {
            tell(at, at + 1, true);
        }
        if at / width + 1 < height {
            tell(at, at + width, false);
        }
    }
}

/// Tiles slide in a frame with one hole.
pub(crate) fn tiles(size: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types tile place)
 (:predicates (at ?t - tile ?p - place) (hole ?p - place) (next ?a ?b - place))
 (:action slide :parameters (?t - tile ?a ?b - place) :precondition (and (at ?t ?a) (hole ?b) (next ?a ?b))
  :effect (and (not (at ?t ?a)) (at ?t ?b) (hole ?a) (not (hole ?b)))))";
    let mut random = Random::new(seed);
    let cells = size * size;
    let mut pairs = Vec::new();
    neighbours(size, size, |a, b, _| pairs.extend([(a, b), (b, a)]));
    let mut board: Vec<usize> = (0..cells).collect();
    let mut hole = cells - 1;
    for _ in 0..200 * cells {
        let ways: Vec<usize> = pairs.iter().filter(|(a, _)| *a == hole).map(|(_, b)| *b).collect();
        let to = ways[random.below(ways.len())];
        board.swap(hole, to);
        hole = to;
    }
    let mut init: Vec<String> = pairs.iter().map(|(a, b)| format!("(next p{a} p{b})")).collect();
    for (place, &tile) in board.iter().enumerate() {
        init.push(if tile == cells - 1 {
            format!("(hole p{place})")
        } else {
            format!("(at t{tile} p{place})")
        });
    }
    let goal: Vec<String> = (0..cells - 1).map(|t| format!("(at t{t} p{t})")).collect();
    let all = format!("{}{}", objects("t", cells - 1, "tile"), objects("p", cells, "place"));
    instance(format!("tiles-{size}/{seed}"), domain, &all, &init, &goal)
}

/// A robot with one key at a time opens locked places of a grid to bring keys elsewhere.
pub(crate) fn grid(width: usize, height: usize, keys: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types place shape key)
 (:predicates (next ?a ?b - place) (robot ?p - place) (at ?k - key ?p - place) (open ?p - place) (locked ?p - place)
  (lock-shape ?p - place ?s - shape) (key-shape ?k - key ?s - shape) (holding ?k - key) (handempty))
 (:action unlock :parameters (?a ?b - place ?k - key ?s - shape)
  :precondition (and (next ?a ?b) (key-shape ?k ?s) (lock-shape ?b ?s) (robot ?a) (locked ?b) (holding ?k)) :effect (and (open ?b) (not (locked ?b))))
 (:action move :parameters (?a ?b - place) :precondition (and (robot ?a) (next ?a ?b) (open ?b)) :effect (and (robot ?b) (not (robot ?a))))
 (:action pickup :parameters (?p - place ?k - key) :precondition (and (robot ?p) (at ?k ?p) (handempty))
  :effect (and (holding ?k) (not (at ?k ?p)) (not (handempty))))
 (:action swap :parameters (?p - place ?k ?l - key) :precondition (and (robot ?p) (holding ?l) (at ?k ?p))
  :effect (and (holding ?k) (at ?l ?p) (not (holding ?l)) (not (at ?k ?p))))
 (:action putdown :parameters (?p - place ?k - key) :precondition (and (robot ?p) (holding ?k)) :effect (and (handempty) (at ?k ?p) (not (holding ?k)))))";
    let mut random = Random::new(seed);
    let cells = width * height;
    let mut init = vec!["(handempty)".to_owned()];
    neighbours(width, height, |a, b, _| init.push(format!("(next p{a} p{b}) (next p{b} p{a})")));
    let order = shuffled(&mut random, cells);
    let locked = cells / 4;
    for (at, place) in order.iter().enumerate() {
        if at < locked {
            init.push(format!("(locked p{place}) (lock-shape p{place} s{})", random.below(2)));
        } else {
            init.push(format!("(open p{place})"));
        }
    }
    init.push(format!("(robot p{})", order[cells - 1]));
    let mut goal = Vec::new();
    for key in 0..keys {
        init.push(format!(
            "(key-shape k{key} s{}) (at k{key} p{})",
            key % 2,
            order[locked + random.below(cells - locked)]
        ));
        if key < keys.div_ceil(2) {
            goal.push(format!("(at k{key} p{})", random.below(cells)));
        }
    }
    let all = format!(
        "{}{}{}",
        objects("p", cells, "place"),
        objects("s", 2, "shape"),
        objects("k", keys, "key")
    );
    instance(format!("grid-{width}x{height}-{keys}/{seed}"), domain, &all, &init, &goal)
}

/// Couples walk from place to place, their tents driven ahead of them.
pub(crate) fn hiking(couples: usize, places: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types car tent person couple place)
 (:predicates (person-at ?p - person ?x - place) (car-at ?c - car ?x - place) (tent-at ?t - tent ?x - place) (up ?t - tent) (down ?t - tent)
  (partners ?h - couple ?a ?b - person) (walked ?h - couple ?x - place) (next ?a ?b - place))
 (:action fold :parameters (?p - person ?x - place ?t - tent) :precondition (and (person-at ?p ?x) (tent-at ?t ?x) (up ?t)) :effect (and (down ?t) (not (up ?t))))
 (:action pitch :parameters (?p - person ?x - place ?t - tent) :precondition (and (person-at ?p ?x) (tent-at ?t ?x) (down ?t)) :effect (and (up ?t) (not (down ?t))))
 (:action drive :parameters (?p - person ?a ?b - place ?c - car) :precondition (and (person-at ?p ?a) (car-at ?c ?a))
  :effect (and (person-at ?p ?b) (not (person-at ?p ?a)) (car-at ?c ?b) (not (car-at ?c ?a))))
 (:action drive-passenger :parameters (?p - person ?a ?b - place ?c - car ?q - person) :precondition (and (person-at ?p ?a) (car-at ?c ?a) (person-at ?q ?a) (not (= ?p ?q)))
  :effect (and (person-at ?p ?b) (not (person-at ?p ?a)) (car-at ?c ?b) (not (car-at ?c ?a)) (person-at ?q ?b) (not (person-at ?q ?a))))
 (:action drive-tent :parameters (?p - person ?a ?b - place ?c - car ?t - tent) :precondition (and (person-at ?p ?a) (car-at ?c ?a) (tent-at ?t ?a) (down ?t))
  :effect (and (person-at ?p ?b) (not (person-at ?p ?a)) (car-at ?c ?b) (not (car-at ?c ?a)) (tent-at ?t ?b) (not (tent-at ?t ?a))))
 (:action drive-tent-passenger :parameters (?p - person ?a ?b - place ?c - car ?t - tent ?q - person)
  :precondition (and (person-at ?p ?a) (car-at ?c ?a) (tent-at ?t ?a) (down ?t) (person-at ?q ?a) (not (= ?p ?q)))
  :effect (and (person-at ?p ?b) (not (person-at ?p ?a)) (car-at ?c ?b) (not (car-at ?c ?a)) (tent-at ?t ?b) (not (tent-at ?t ?a)) (person-at ?q ?b) (not (person-at ?q ?a))))
 (:action walk :parameters (?t - tent ?b - place ?p - person ?a - place ?q - person ?h - couple)
  :precondition (and (tent-at ?t ?b) (up ?t) (person-at ?p ?a) (next ?a ?b) (walked ?h ?a) (person-at ?q ?a) (partners ?h ?p ?q))
  :effect (and (person-at ?p ?b) (not (person-at ?p ?a)) (person-at ?q ?b) (not (person-at ?q ?a)) (walked ?h ?b) (not (walked ?h ?a)))))";
    let mut random = Random::new(seed);
    let mut init: Vec<String> = (1..places).map(|p| format!("(next p{} p{p})", p - 1)).collect();
    for couple in 0..couples {
        init.push(format!("(partners h{couple} m{couple} w{couple}) (walked h{couple} p0)"));
        init.push(format!("(person-at m{couple} p0) (person-at w{couple} p0)"));
    }
    for tent in 0..couples {
        let state = if random.below(2) == 0 { "up" } else { "down" };
        init.push(format!("(tent-at t{tent} p0) ({state} t{tent})"));
    }
    init.extend((0..=couples).map(|c| format!("(car-at c{c} p0)")));
    let goal: Vec<String> =
        (0..couples).map(|h| format!("(walked h{h} p{})", places - 1)).collect();
    let all = format!(
        "{}{}{}{}{}{}",
        objects("c", couples + 1, "car"),
        objects("t", couples, "tent"),
        objects("m", couples, "person"),
        objects("w", couples, "person"),
        objects("h", couples, "couple"),
        objects("p", places, "place")
    );
    instance(format!("hiking-{couples}-{places}/{seed}"), domain, &all, &init, &goal)
}
