//! Families in which things are made in the right order: drinks, orders, boards, sandwiches, coloured floors, towers.

use std::fmt::Write;

use super::{Instance, Random, instance, objects, shuffled};

/// Two hands mix drinks of two ingredients each in a shaker and pour them into glasses.
pub(crate) fn barman(ingredients: usize, cocktails: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing)
 (:types hand level beverage dispenser vessel - object ingredient cocktail - beverage glass shaker - vessel)
 (:predicates (ontable ?c - vessel) (holding ?h - hand ?c - vessel) (handempty ?h - hand) (empty ?c - vessel) (contains ?c - vessel ?b - beverage)
  (clean ?c - vessel) (used ?c - vessel ?b - beverage) (dispenses ?d - dispenser ?i - ingredient) (shaker-empty-level ?s - shaker ?l - level)
  (shaker-level ?s - shaker ?l - level) (next ?a ?b - level) (unshaken ?s - shaker) (shaken ?s - shaker)
  (part1 ?c - cocktail ?i - ingredient) (part2 ?c - cocktail ?i - ingredient))
 (:action grasp :parameters (?h - hand ?c - vessel) :precondition (and (ontable ?c) (handempty ?h)) :effect (and (not (ontable ?c)) (not (handempty ?h)) (holding ?h ?c)))
 (:action leave :parameters (?h - hand ?c - vessel) :precondition (holding ?h ?c) :effect (and (not (holding ?h ?c)) (handempty ?h) (ontable ?c)))
 (:action fill :parameters (?s - glass ?i - ingredient ?a ?b - hand ?d - dispenser)
  :precondition (and (holding ?a ?s) (handempty ?b) (dispenses ?d ?i) (empty ?s) (clean ?s) (not (= ?a ?b)))
  :effect (and (not (empty ?s)) (contains ?s ?i) (not (clean ?s)) (used ?s ?i)))
 (:action refill :parameters (?s - glass ?i - ingredient ?a ?b - hand ?d - dispenser)
  :precondition (and (holding ?a ?s) (handempty ?b) (dispenses ?d ?i) (empty ?s) (used ?s ?i) (not (= ?a ?b)))
  :effect (and (not (empty ?s)) (contains ?s ?i)))
 (:action empty-glass :parameters (?h - hand ?s - glass ?b - beverage) :precondition (and (holding ?h ?s) (contains ?s ?b)) :effect (and (not (contains ?s ?b)) (empty ?s)))
 (:action clean-glass :parameters (?s - glass ?b - beverage ?a ?h - hand)
  :precondition (and (holding ?a ?s) (handempty ?h) (empty ?s) (used ?s ?b) (not (= ?a ?h))) :effect (and (not (used ?s ?b)) (clean ?s)))
 (:action pour-to-clean :parameters (?s - glass ?i - ingredient ?k - shaker ?h - hand ?l ?m - level)
  :precondition (and (holding ?h ?s) (contains ?s ?i) (empty ?k) (clean ?k) (shaker-level ?k ?l) (next ?l ?m))
  :effect (and (not (contains ?s ?i)) (empty ?s) (contains ?k ?i) (not (empty ?k)) (not (clean ?k)) (unshaken ?k) (not (shaker-level ?k ?l)) (shaker-level ?k ?m)))
 (:action pour-to-used :parameters (?s - glass ?i - ingredient ?k - shaker ?h - hand ?l ?m - level)
  :precondition (and (holding ?h ?s) (contains ?s ?i) (unshaken ?k) (shaker-level ?k ?l) (next ?l ?m))
  :effect (and (not (contains ?s ?i)) (contains ?k ?i) (empty ?s) (not (shaker-level ?k ?l)) (shaker-level ?k ?m)))
 (:action empty-shaker :parameters (?h - hand ?k - shaker ?c - cocktail ?l ?m - level)
  :precondition (and (holding ?h ?k) (contains ?k ?c) (shaken ?k) (shaker-level ?k ?l) (shaker-empty-level ?k ?m))
  :effect (and (not (shaken ?k)) (not (shaker-level ?k ?l)) (shaker-level ?k ?m) (not (contains ?k ?c)) (empty ?k)))
 (:action clean-shaker :parameters (?a ?b - hand ?k - shaker) :precondition (and (holding ?a ?k) (handempty ?b) (empty ?k) (not (= ?a ?b))) :effect (clean ?k))
 (:action shake :parameters (?c - cocktail ?i ?j - ingredient ?k - shaker ?a ?b - hand)
  :precondition (and (holding ?a ?k) (handempty ?b) (contains ?k ?i) (contains ?k ?j) (part1 ?c ?i) (part2 ?c ?j) (unshaken ?k) (not (= ?a ?b)))
  :effect (and (not (unshaken ?k)) (not (contains ?k ?i)) (not (contains ?k ?j)) (shaken ?k) (contains ?k ?c)))
 (:action pour :parameters (?b - beverage ?d - glass ?h - hand ?k - shaker ?l ?m - level)
  :precondition (and (holding ?h ?k) (shaken ?k) (empty ?d) (clean ?d) (contains ?k ?b) (shaker-level ?k ?l) (next ?m ?l))
  :effect (and (not (clean ?d)) (not (empty ?d)) (contains ?d ?b) (shaker-level ?k ?m) (not (shaker-level ?k ?l)))))";
    let mut random = Random::new(seed);
    let glasses = cocktails + 1;
    let mut init: Vec<String> = [
        "(ontable k0) (clean k0) (empty k0) (handempty left) (handempty right)",
        "(shaker-empty-level k0 l0) (shaker-level k0 l0) (next l0 l1) (next l1 l2)",
    ]
    .map(String::from)
    .into();
    init.extend((0..glasses).map(|g| format!("(ontable g{g}) (clean g{g}) (empty g{g})")));
    init.extend((0..ingredients).map(|i| format!("(dispenses d{i} i{i})")));
    for cocktail in 0..cocktails {
        let parts = shuffled(&mut random, ingredients);
        init.push(format!("(part1 c{cocktail} i{}) (part2 c{cocktail} i{})", parts[0], parts[1]));
    }
    let goal: Vec<String> = (0..cocktails).map(|c| format!("(contains g{c} c{c})")).collect();
    let all = format!(
        "left right - hand k0 - shaker {}{}{}{}{}",
        objects("l", 3, "level"),
        objects("g", glasses, "glass"),
        objects("i", ingredients, "ingredient"),
        objects("c", cocktails, "cocktail"),
        objects("d", ingredients, "dispenser")
    );
    instance(format!("barman-{ingredients}-{cocktails}/{seed}"), domain, &all, &init, &goal)
}

/// Orders of several products each are stacked while they are open; stacks are few. Each product and each order has
/// an action of its own.
pub(crate) fn openstacks(orders: usize, stacks: usize, seed: u64) -> Instance {
    let mut random = Random::new(seed);
    let mut of_order = vec![Vec::new(); orders];
    for product in 0..orders {
        for _ in 0..2 {
            let order = random.below(orders);
            if !of_order[order].contains(&product) {
                of_order[order].push(product);
            }
        }
    }
    for order in &mut of_order {
        if order.is_empty() {
            order.push(random.below(orders));
        }
    }
    let mut domain = "(define (domain d) (:requirements :strips :typing) (:types order product count)
 (:predicates (waiting ?o - order) (started ?o - order) (shipped ?o - order) (made ?p - product) (unmade ?p - product) (free ?n - count) (next ?a ?b - count))
 (:action start :parameters (?o - order ?n ?m - count) :precondition (and (waiting ?o) (free ?n) (next ?m ?n))
  :effect (and (not (waiting ?o)) (started ?o) (not (free ?n)) (free ?m)))".to_owned();
    let mut constants = String::new();
    for product in 0..orders {
        let users = (0..orders).filter(|&o| of_order[o].contains(&product));
        let started: String = users.map(|o| format!(" (started o{o})")).collect();
        write!(domain, "\n (:action make-{product} :parameters () :precondition (and (unmade p{product}){started}) :effect (and (not (unmade p{product})) (made p{product})))")
            .expect("a string takes all text");
    }
    for (order, products) in of_order.iter().enumerate() {
        let made: String = products.iter().map(|p| format!(" (made p{p})")).collect();
        write!(domain, "\n (:action ship-{order} :parameters (?n ?m - count) :precondition (and (started o{order}){made} (free ?n) (next ?n ?m))
  :effect (and (not (started o{order})) (shipped o{order}) (not (free ?n)) (free ?m)))")
            .expect("a string takes all text");
    }
    domain.push(')');
    write!(
        constants,
        "(:constants {}{})",
        objects("o", orders, "order"),
        objects("p", orders, "product")
    )
    .expect("a string takes all text");
    let domain = domain.replacen("\n (:predicates", &format!("\n {constants}\n (:predicates"), 1);
    let mut init: Vec<String> = (0..stacks).map(|n| format!("(next n{n} n{})", n + 1)).collect();
    init.push(format!("(free n{stacks})"));
    init.extend((0..orders).map(|o| format!("(waiting o{o}) (unmade p{o})")));
    let goal: Vec<String> = (0..orders).map(|o| format!("(shipped o{o})")).collect();
    instance(
        format!("openstacks-{orders}-{stacks}/{seed}"),
        &domain,
        &objects("n", stacks + 1, "count"),
        &init,
        &goal,
    )
}

/// Parts are sawn from boards, planed, ground, glazed or varnished, each in its colour.
pub(crate) fn woodworking(parts: usize, boards: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing)
 (:types colour wood size surface machine piece - object planer grinder glazer varnisher saw - machine board part - piece)
 (:constants verysmooth smooth rough - surface natural - colour)
 (:predicates (unused ?p - part) (available ?p - piece) (surface ?p - piece ?s - surface) (colour ?p - part ?c - colour) (wood ?p - piece ?w - wood)
  (board-size ?b - board ?s - size) (goal-size ?p - part ?s - size) (next ?a ?b - size) (has ?m - machine ?c - colour) (idle ?m - machine) (in-saw ?b - board ?m - saw)
  (empty ?m - saw) (grown ?a ?b - surface) (treated ?p - part) (untreated ?p - part))
 (:action load :parameters (?b - board ?m - saw) :precondition (and (empty ?m) (available ?b)) :effect (and (in-saw ?b ?m) (not (available ?b)) (not (empty ?m))))
 (:action unload :parameters (?b - board ?m - saw) :precondition (in-saw ?b ?m) :effect (and (available ?b) (empty ?m) (not (in-saw ?b ?m))))
 (:action cut-small :parameters (?b - board ?p - part ?m - saw ?w - wood ?s - surface ?x ?y - size)
  :precondition (and (unused ?p) (goal-size ?p z1) (in-saw ?b ?m) (wood ?b ?w) (surface ?b ?s) (board-size ?b ?x) (next ?y ?x))
  :effect (and (not (unused ?p)) (available ?p) (wood ?p ?w) (surface ?p ?s) (colour ?p natural) (untreated ?p) (not (board-size ?b ?x)) (board-size ?b ?y)))
 (:action cut-large :parameters (?b - board ?p - part ?m - saw ?w - wood ?s - surface ?x ?y ?z - size)
  :precondition (and (unused ?p) (goal-size ?p z2) (in-saw ?b ?m) (wood ?b ?w) (surface ?b ?s) (board-size ?b ?x) (next ?y ?x) (next ?z ?y))
  :effect (and (not (unused ?p)) (available ?p) (wood ?p ?w) (surface ?p ?s) (colour ?p natural) (untreated ?p) (not (board-size ?b ?x)) (board-size ?b ?z)))
 (:action plane :parameters (?p - part ?m - planer ?s - surface ?c - colour) :precondition (and (available ?p) (surface ?p ?s) (colour ?p ?c))
  :effect (and (not (surface ?p ?s)) (surface ?p smooth) (not (colour ?p ?c)) (colour ?p natural) (untreated ?p) (not (treated ?p))))
 (:action grind :parameters (?p - part ?m - grinder ?s ?t - surface ?c - colour) :precondition (and (available ?p) (surface ?p ?s) (grown ?s ?t) (colour ?p ?c))
  :effect (and (not (surface ?p ?s)) (surface ?p ?t) (not (colour ?p ?c)) (colour ?p natural) (untreated ?p) (not (treated ?p))))
 (:action glaze :parameters (?p - part ?m - glazer ?c - colour) :precondition (and (available ?p) (has ?m ?c) (untreated ?p) (colour ?p natural) (idle ?m))
  :effect (and (not (untreated ?p)) (treated ?p) (not (colour ?p natural)) (colour ?p ?c)))
 (:action varnish :parameters (?p - part ?m - varnisher ?c - colour ?s - surface)
  :precondition (and (available ?p) (has ?m ?c) (surface ?p smooth) (untreated ?p) (colour ?p natural) (surface ?p ?s))
  :effect (and (not (untreated ?p)) (treated ?p) (not (colour ?p natural)) (colour ?p ?c))))";
    let domain = domain.replace("natural - colour)", "natural - colour z0 z1 z2 - size)");
    let mut random = Random::new(seed);
    let sizes = 2 + 2 * parts / boards;
    let mut init: Vec<String> = (0..sizes - 1).map(|s| format!("(next z{s} z{})", s + 1)).collect();
    init.push("(empty saw) (idle gl) (has gl c0) (has gl c1) (has va c1) (has va c2) (grown rough smooth) (grown smooth verysmooth)".to_owned());
    for board in 0..boards {
        let surface = ["rough", "smooth"][random.below(2)];
        init.push(format!("(available b{board}) (surface b{board} {surface}) (wood b{board} w{}) (board-size b{board} z{})", board % 2, sizes - 1));
    }
    let mut goal = Vec::new();
    for part in 0..parts {
        init.push(format!("(unused p{part}) (goal-size p{part} z{})", 1 + random.below(2)));
        goal.push(format!("(available p{part}) (colour p{part} c{})", random.below(3)));
        if random.below(2) == 0 {
            goal.push(format!("(wood p{part} w{})", random.below(boards.min(2))));
        }
        if random.below(2) == 0 {
            goal.push(format!("(surface p{part} smooth)"));
        }
    }
    let extra: String = (3..sizes).map(|s| format!("z{s} ")).collect();
    let extra = if extra.is_empty() { String::new() } else { format!("{extra}- size ") };
    let all = format!(
        "{}{}{}{}{extra}pl - planer gr - grinder gl - glazer va - varnisher saw - saw",
        objects("c", 3, "colour"),
        objects("w", 2, "wood"),
        objects("b", boards, "board"),
        objects("p", parts, "part")
    );
    instance(format!("woodworking-{parts}-{boards}/{seed}"), &domain, &all, &init, &goal)
}

/// Sandwiches for children at tables, some without gluten, carried on trays.
pub(crate) fn childsnack(children: usize, trays: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types child bread filling sandwich tray place) (:constants kitchen - place)
 (:predicates (bread-in ?b - bread) (filling-in ?f - filling) (plain-bread ?b - bread) (plain-filling ?f - filling) (on ?s - sandwich ?t - tray)
  (plain ?s - sandwich) (allergic ?c - child) (healthy ?c - child) (served ?c - child) (waits ?c - child ?p - place) (at ?t - tray ?p - place)
  (unmade ?s - sandwich) (in-kitchen ?s - sandwich))
 (:action make-plain :parameters (?s - sandwich ?b - bread ?f - filling)
  :precondition (and (bread-in ?b) (filling-in ?f) (plain-bread ?b) (plain-filling ?f) (unmade ?s))
  :effect (and (not (bread-in ?b)) (not (filling-in ?f)) (in-kitchen ?s) (plain ?s) (not (unmade ?s))))
 (:action make :parameters (?s - sandwich ?b - bread ?f - filling) :precondition (and (bread-in ?b) (filling-in ?f) (unmade ?s))
  :effect (and (not (bread-in ?b)) (not (filling-in ?f)) (in-kitchen ?s) (not (unmade ?s))))
 (:action put :parameters (?s - sandwich ?t - tray) :precondition (and (in-kitchen ?s) (at ?t kitchen)) :effect (and (not (in-kitchen ?s)) (on ?s ?t)))
 (:action serve-plain :parameters (?s - sandwich ?c - child ?t - tray ?p - place)
  :precondition (and (allergic ?c) (on ?s ?t) (waits ?c ?p) (plain ?s) (at ?t ?p)) :effect (and (not (on ?s ?t)) (served ?c)))
 (:action serve :parameters (?s - sandwich ?c - child ?t - tray ?p - place)
  :precondition (and (healthy ?c) (waits ?c ?p) (on ?s ?t) (at ?t ?p)) :effect (and (not (on ?s ?t)) (served ?c)))
 (:action move :parameters (?t - tray ?a ?b - place) :precondition (and (at ?t ?a) (not (= ?a ?b))) :effect (and (not (at ?t ?a)) (at ?t ?b))))";
    let mut random = Random::new(seed);
    let allergic = children.div_ceil(3);
    let made = children + children.div_ceil(3);
    let mut init: Vec<String> = (0..trays).map(|t| format!("(at t{t} kitchen)")).collect();
    for child in 0..children {
        let kind = if child < allergic { "allergic" } else { "healthy" };
        init.push(format!("({kind} c{child}) (waits c{child} p{})", random.below(3)));
        init.push(format!("(bread-in b{child}) (filling-in f{child})"));
        if child < allergic {
            init.push(format!("(plain-bread b{child}) (plain-filling f{child})"));
        }
    }
    init.extend((0..made).map(|s| format!("(unmade s{s})")));
    let goal: Vec<String> = (0..children).map(|c| format!("(served c{c})")).collect();
    let all = format!(
        "{}{}{}{}{}{}",
        objects("c", children, "child"),
        objects("b", children, "bread"),
        objects("f", children, "filling"),
        objects("s", made, "sandwich"),
        objects("t", trays, "tray"),
        objects("p", 3, "place")
    );
    instance(format!("childsnack-{children}-{trays}/{seed}"), domain, &all, &init, &goal)
}

/// Robots paint a floor in two colours, each tile from the one below or above it, and never step on paint.
pub(crate) fn floortile(width: usize, height: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types robot tile colour)
 (:predicates (at ?r - robot ?x - tile) (above ?a ?b - tile) (right ?a ?b - tile) (clear ?x - tile) (painted ?x - tile ?c - colour) (has ?r - robot ?c - colour))
 (:action change :parameters (?r - robot ?c ?d - colour) :precondition (and (has ?r ?c) (not (= ?c ?d))) :effect (and (not (has ?r ?c)) (has ?r ?d)))
 (:action paint-up :parameters (?r - robot ?y ?x - tile ?c - colour) :precondition (and (has ?r ?c) (at ?r ?x) (above ?y ?x) (clear ?y)) :effect (and (not (clear ?y)) (painted ?y ?c)))
 (:action paint-down :parameters (?r - robot ?y ?x - tile ?c - colour) :precondition (and (has ?r ?c) (at ?r ?x) (above ?x ?y) (clear ?y)) :effect (and (not (clear ?y)) (painted ?y ?c)))
 (:action up :parameters (?r - robot ?x ?y - tile) :precondition (and (at ?r ?x) (above ?y ?x) (clear ?y)) :effect (and (at ?r ?y) (not (at ?r ?x)) (clear ?x) (not (clear ?y))))
 (:action down :parameters (?r - robot ?x ?y - tile) :precondition (and (at ?r ?x) (above ?x ?y) (clear ?y)) :effect (and (at ?r ?y) (not (at ?r ?x)) (clear ?x) (not (clear ?y))))
 (:action right :parameters (?r - robot ?x ?y - tile) :precondition (and (at ?r ?x) (right ?y ?x) (clear ?y)) :effect (and (at ?r ?y) (not (at ?r ?x)) (clear ?x) (not (clear ?y))))
 (:action left :parameters (?r - robot ?x ?y - tile) :precondition (and (at ?r ?x) (right ?x ?y) (clear ?y)) :effect (and (at ?r ?y) (not (at ?r ?x)) (clear ?x) (not (clear ?y)))))";
    let mut random = Random::new(seed);
    let tile = |x: usize, y: usize| format!("t{}", y * width + x);
    let mut init = Vec::new();
    let mut goal = Vec::new();
    for y in 0..=height {
        for x in 0..width {
            if y > 0 {
                init.push(format!("(above {} {})", tile(x, y), tile(x, y - 1)));
                goal.push(format!("(painted {} c{})", tile(x, y), (x + y) % 2));
            }
            if x > 0 {
                init.push(format!("(right {} {})", tile(x, y), tile(x - 1, y)));
            }
        }
    }
    let places = shuffled(&mut random, width * (height + 1));
    for (at, place) in places.iter().enumerate() {
        init.push(if at < 2 {
            format!("(at r{at} t{place}) (has r{at} c{at})")
        } else {
            format!("(clear t{place})")
        });
    }
    let all = format!(
        "{}{}{}",
        objects("r", 2, "robot"),
        objects("t", width * (height + 1), "tile"),
        objects("c", 2, "colour")
    );
    instance(format!("floortile-{width}x{height}/{seed}"), domain, &all, &init, &goal)
}

/// A robot piles blocks into towers, climbing one step at a time.
pub(crate) fn termes(width: usize, height: usize, tall: usize, seed: u64) -> Instance {
    let domain = "(define (domain d) (:requirements :strips :typing) (:types number place)
 (:predicates (height ?p - place ?h - number) (at ?p - place) (carries) (idle) (succ ?a ?b - number) (next ?p ?q - place) (depot ?p - place))
 (:action move :parameters (?a ?b - place ?h - number) :precondition (and (at ?a) (next ?a ?b) (height ?a ?h) (height ?b ?h)) :effect (and (not (at ?a)) (at ?b)))
 (:action up :parameters (?a ?b - place ?h ?k - number) :precondition (and (at ?a) (next ?a ?b) (height ?a ?h) (height ?b ?k) (succ ?k ?h)) :effect (and (not (at ?a)) (at ?b)))
 (:action down :parameters (?a ?b - place ?h ?k - number) :precondition (and (at ?a) (next ?a ?b) (height ?a ?h) (height ?b ?k) (succ ?h ?k)) :effect (and (not (at ?a)) (at ?b)))
 (:action place :parameters (?a ?b - place ?h ?k - number)
  :precondition (and (at ?a) (next ?a ?b) (height ?a ?h) (height ?b ?h) (carries) (succ ?k ?h) (not (depot ?b)))
  :effect (and (not (height ?b ?h)) (height ?b ?k) (not (carries)) (idle)))
 (:action remove :parameters (?a ?b - place ?h ?k - number) :precondition (and (at ?a) (next ?a ?b) (height ?a ?k) (height ?b ?h) (succ ?h ?k) (idle))
  :effect (and (not (height ?b ?h)) (height ?b ?k) (carries) (not (idle))))
 (:action create :parameters (?p - place) :precondition (and (at ?p) (idle) (depot ?p)) :effect (and (carries) (not (idle))))
 (:action destroy :parameters (?p - place) :precondition (and (at ?p) (carries) (depot ?p)) :effect (and (idle) (not (carries)))))";
    let mut random = Random::new(seed);
    let cells = width * height;
    let mut init: Vec<String> = (0..tall + 1).map(|h| format!("(succ n{} n{h})", h + 1)).collect();
    for at in 0..cells {
        if at % width + 1 < width {
            init.push(format!("(next p{at} p{0}) (next p{0} p{at})", at + 1));
        }
        if at / width + 1 < height {
            init.push(format!("(next p{at} p{0}) (next p{0} p{at})", at + width));
        }
        init.push(format!("(height p{at} n0)"));
    }
    let order = shuffled(&mut random, cells);
    init.push(format!("(at p{0}) (depot p{0}) (idle)", order[0]));
    let mut goal: Vec<String> = vec!["(idle)".to_owned()];
    for at in 0..cells {
        let high = if at == order[1] {
            tall
        } else if at == order[2] {
            1 + random.below(tall)
        } else {
            0
        };
        goal.push(format!("(height p{at} n{high})"));
    }
    let all = format!("{}{}", objects("n", tall + 2, "number"), objects("p", cells, "place"));
    instance(format!("termes-{width}x{height}-{tall}/{seed}"), domain, &all, &init, &goal)
}
