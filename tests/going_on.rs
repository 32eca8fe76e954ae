//! Lines of a dialogue that mean something only by what was said before: each is answered as the whole question is that it
//! stands for, or not at all; and most of a family are understood.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Memory};
use orthoframe_language::Language;
use orthoframe_language::question::{Answer, Said};
use orthoframe_language::words::russian::{self, Preposition};
use orthoframe_language::words::{Case, NounPhrase, WordHints};

use crate::talk::engine;

fn rb2() -> Engine {
    engine("maps/rb2.toml").expect("part of the crate")
}

fn ask(engine: &Engine, line: &str, memory: &mut Memory) -> Option<Answer> {
    engine.ask(line, memory).expect("there is a map").ok()
}

/// What a whole question comes to by itself.
fn whole(engine: &Engine, question: &str) -> Option<Answer> {
    ask(engine, question, &mut Memory::default())
}

/// How many dialogues were understood; each of which says what its whole question says.
#[derive(Default)]
struct Family {
    asked: usize,
    understood: usize,
}

impl Family {
    /// `same` tells what of two answers must agree.
    fn hear<T: PartialEq + std::fmt::Debug>(
        &mut self,
        engine: &Engine,
        lines: &[&str],
        question: &str,
        same: impl Fn(&Answer) -> T,
    ) {
        let Some(plain) = whole(engine, question) else { return };
        let mut memory = Memory::default();
        let (last, before) = lines.split_last().expect("a dialogue");
        for line in before {
            ask(engine, line, &mut memory);
        }
        self.asked += 1;
        let Some(told) = ask(engine, last, &mut memory) else { return };
        assert_eq!(
            same(&told),
            same(&plain),
            "{lines:?}\n  {}\n{question}\n  {}",
            told.text,
            plain.text
        );
        self.understood += 1;
    }

    fn mostly_understood(&self) {
        let Self { asked, understood } = self;
        assert!(understood * 4 >= asked * 3 && *asked > 4, "{understood} of {asked}");
    }
}

const ROOMS: [&str; 4] = ["Room V", "Room Z", "Room Y", "the corridor"];
const KINDS: [&str; 5] = ["chairs", "books", "lamps", "cups", "wardrobes"];

/// "I'm in the kitchen." – "How do I get to the bedroom?": from where the person said to be, on whichever line; what is asked
/// of the robot counts from the robot.
#[test]
fn the_person_stays_where_it_said_to_be() {
    let rb2 = rb2();
    let mut ways = Family::default();
    for from in ROOMS {
        for to in ROOMS.iter().filter(|to| **to != from) {
            let told = format!("I'm in {from}.");
            let way = format!("How do I get from {from} to {to}?");
            let asked = format!("How do I get to {to}?");
            ways.hear(&rb2, &[&told, &asked], &way, |answer| answer.number.map(f64::round));
            let between = "What colour is the sofa?";
            ways.hear(&rb2, &[&told, between, &asked], &way, |a| a.number.map(f64::round));
            let robots = format!("How far are you from {to}?");
            ways.hear(&rb2, &[&told, &robots], &robots, |answer| answer.number.map(f64::round));
        }
    }
    ways.mostly_understood();
}

/// «В какой комнате больше всего ламп? – … – А меньше всего?»: the fewest lamps, and no room's size.
#[test]
fn the_fewest_goes_on_from_the_most() {
    let rb2 = rb2();
    let mut fewest = Family::default();
    let things = |answer: &Answer| answer.things.iter().copied().collect::<BTreeSet<_>>();
    for (russian, english) in
        [("ламп", "lamps"), ("стульев", "chairs"), ("столов", "tables"), ("ваз", "vases")]
    {
        let most = format!("В какой комнате больше всего {russian}?");
        let asked = format!("В какой комнате меньше всего {russian}?");
        fewest.hear(&rb2, &[&most, "А меньше всего?"], &asked, things);
        fewest.hear(&rb2, &[&asked, "А больше всего?"], &most, things);
        let most = format!("Which room has the most {english}?");
        let asked = format!("Which room has the fewest {english}?");
        fewest.hear(&rb2, &[&most, "And the fewest?"], &asked, things);
        fewest.hear(&rb2, &[&asked, "And the most?"], &most, things);
    }
    fewest.mostly_understood();
}

/// «Где стул? – Стул-1 или Стул-2?» – «А другой?»: of those that were asked back, and not of what was told before.
#[test]
fn the_other_one_is_none_of_what_was_told_before_it_was_asked_back() {
    let rb2 = rb2();
    let chair = |t: &orthoframe_language::question::Thing| {
        let replica = t.replica().expect("a chair is on the map");
        let name = &rb2.world().unwrap().replicas[&replica].name;
        name.starts_with("Стул")
    };
    let mut asked_back = 0;
    for before in ["Сколько ламп в доме?", "What is on Table 1?", "Какие комнаты есть?"]
    {
        for ambiguous in ["Где стул?", "What colour is the chair?"] {
            let lines = ["А другой?", "А остальные?", "Где остальные?", "The other one?"];
            for line in lines.into_iter().chain(["And the others?", "Where are the others?"]) {
                let mut memory = Memory::default();
                ask(&rb2, before, &mut memory);
                if ask(&rb2, ambiguous, &mut memory).is_some() {
                    continue;
                }
                asked_back += 1;
                let told = ask(&rb2, line, &mut memory);
                let things = told.as_ref().map(|told| &told.things[..]).unwrap_or_default();
                assert!(things.iter().all(chair), "{before} {ambiguous} {line} {told:?}");
            }
        }
    }
    assert!(asked_back > 12, "{asked_back}");
}

/// «Что рядом с диваном?» – «А с кроватью?»: beside that, whatever it has on it.
#[test]
fn with_alone_is_beside_where_beside_was_asked() {
    let rb2 = rb2();
    let mut beside = Family::default();
    let names: Vec<&str> =
        rb2.world().unwrap().replicas.values().map(|replica| replica.name.as_str()).collect();
    let with = |name: &str| {
        let form = NounPhrase::parse(name, &WordHints::default());
        russian::with(Preposition::S, Case::Instrumental, &form)
    };
    for pair in names.windows(2).step_by(3) {
        let (first, then) = (format!("Что рядом {}?", with(pair[0])), with(pair[1]));
        let things = |answer: &Answer| answer.things.iter().copied().collect::<BTreeSet<_>>();
        let asked = format!("Что рядом {then}?");
        beside.hear(&rb2, &[&first, &format!("А {then}?")], &asked, things);
    }
    beside.mostly_understood();
}

/// «А что внутри?», "What's inside that?", "What's on top?" of whatever was spoken of: what is in it or on it.
#[test]
fn a_side_alone_is_of_what_was_spoken_of() {
    let rb2 = rb2();
    let world = rb2.world().unwrap();
    let (mut inside, mut on_top) = (Family::default(), Family::default());
    let things = |answer: &Answer| answer.things.iter().copied().collect::<BTreeSet<_>>();
    for replica in world.replicas.values() {
        let (russian, english) = (&replica.name, &replica.name_en);
        let shown = format!("Where is {english}?");
        let bears = |trait_: &str| world.has_trait(replica.id, trait_);
        if bears("container") {
            let asked = format!("What is in {english}?");
            for last in ["What's inside that?", "What is inside?", "And what's inside it?"] {
                inside.hear(&rb2, &[&shown, last], &asked, things);
            }
            let shown = format!("В какой комнате {russian}?");
            inside.hear(&rb2, &[&shown, "А что внутри?"], &asked, things);
        }
        if bears("support") {
            on_top.hear(
                &rb2,
                &[&shown, "What's on top?"],
                &format!("What is on {english}?"),
                things,
            );
        }
    }
    inside.mostly_understood();
    on_top.mostly_understood();
}

/// "Are there any chairs in the kitchen?" – "How many are there?"
#[test]
fn how_many_alone_counts_what_was_asked_for() {
    let rb2 = rb2();
    let mut counts = Family::default();
    for room in ROOMS {
        for kind in KINDS {
            let whether = format!("Are there any {kind} in {room}?");
            let count = format!("How many {kind} are in {room}?");
            for last in ["How many are there?", "How many?", "And how many?"] {
                counts.hear(&rb2, &[&whether, last], &count, |answer| answer.number);
            }
        }
    }
    counts.mostly_understood();
}

/// "How far is A from B? And C?" – from B; "Which chair is nearest to A? And to B?"; "What is in the lab? And in the office?
/// Which of the two is bigger?"
#[test]
fn what_is_measured_goes_on_by_its_own_end() {
    let rb2 = rb2();
    let things = ["the fridge", "the sofa", "the stove", "the dresser", "the desk"];
    let round = |answer: &Answer| answer.number.map(f64::round);
    let found = |answer: &Answer| answer.things.clone();
    let (mut far, mut near, mut big) = (Family::default(), Family::default(), Family::default());
    for (a, b) in things.iter().zip(things.iter().cycle().skip(1)) {
        for c in things.iter().filter(|c| *c != a && *c != b) {
            let lines = [format!("How far is {a} from {b}?"), format!("And {c}?")];
            let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
            far.hear(&rb2, &lines, &format!("How far is {c} from {b}?"), round);
        }
        let lines = [format!("Which chair is nearest to {a}?"), format!("And to {b}?")];
        let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
        near.hear(&rb2, &lines, &format!("Which chair is nearest to {b}?"), found);
    }
    for (a, b) in ROOMS.iter().zip(ROOMS.iter().cycle().skip(1)) {
        let lines = [format!("What is in {a}?"), format!("And in {b}?")];
        let question = format!("Which is bigger, {a} or {b}?");
        big.hear(&rb2, &[&lines[0], &lines[1], "Which of the two is bigger?"], &question, found);
    }
    far.mostly_understood();
    near.mostly_understood();
    assert!(big.understood > 2, "{} of {}", big.understood, big.asked);
}

/// "What colour is the floor in the kitchen? And the walls?": the kitchen's.
#[test]
fn walls_are_of_the_room_whose_floor_was_asked_of() {
    let Some(house) = engine("../shared/data/procthor/house_1.json") else { return };
    let mut walls = Family::default();
    for room in ["kitchen", "bedroom", "bathroom", "living room"] {
        for (first, second) in [("floor", "walls"), ("walls", "floor")] {
            let asked = |what: &str| {
                let is = if what == "walls" { "are" } else { "is" };
                format!("What colour {is} the {what} in the {room}?")
            };
            let last = format!("And the {second}?");
            walls.hear(&house, &[&asked(first), &last], &asked(second), |a| a.text.clone());
        }
    }
    walls.mostly_understood();
}

/// «А мыло там есть?» of whatever lies in or on what was asked of: yes, on whichever side it lies.
#[test]
fn there_is_on_it_as_well_as_in_it() {
    let rb2 = rb2();
    let (world, relations) = (rb2.world().unwrap(), rb2.relations().unwrap());
    let mut shown = 0;
    for replica in world.replicas.values() {
        let Some(support) = relations.support_of(replica.id) else { continue };
        let support = &world.replicas[&support].name;
        let mut memory = Memory::default();
        ask(&rb2, &format!("В какой комнате {support}?"), &mut memory);
        let Some(told) = ask(&rb2, &format!("А {} там есть?", replica.name), &mut memory)
        else {
            continue;
        };
        // «там» may be the room.
        assert_eq!(told.said, Said::Yes, "{support}, {}: {}", replica.name, told.text);
        shown += 1;
    }
    assert!(shown > 8, "{shown}");
}

/// Of things of two genders that were spoken of one after the other, «его» and «её» in an order mean the one of that gender, or
/// nothing.
#[test]
fn a_pronoun_of_an_order_agrees_with_its_thing() {
    let rb2 = rb2();
    let world = rb2.world().unwrap();
    let portable: Vec<_> =
        world.replicas.values().filter(|r| world.has_trait(r.id, "portable")).collect();
    let order = |text: &str, memory: &mut Memory| {
        let commands = rb2.understand_in(text, memory).ok()?;
        Some(format!("{commands:?}"))
    };
    let bring = |name: &str| order(&format!("Принеси {name}"), &mut Memory::default());
    let is_feminine = |name: &str| {
        ["Книга", "Чашка", "Тарелка", "Ваза", "Коробка"].iter().any(|kind| name.starts_with(kind))
    };
    let mut understood = 0;
    for first in &portable {
        let second = portable.iter().find(|r| is_feminine(&r.name) != is_feminine(&first.name));
        let second = second.expect("there are things of both genders");
        for (pronoun, feminine) in [("её", true), ("его", false)] {
            let mut memory = Memory::default();
            for name in [&first.name, &second.name] {
                ask(&rb2, &format!("Где {name}?"), &mut memory);
            }
            let Some(meant) = order(&format!("Принеси {pronoun}"), &mut memory) else {
                continue;
            };
            let brought: Vec<&str> = portable
                .iter()
                .map(|r| r.name.as_str())
                .filter(|name| bring(name).is_some_and(|command| command == meant))
                .collect();
            assert!(
                brought.iter().all(|name| is_feminine(name) == feminine),
                "{}, {}, {pronoun}: {brought:?}",
                first.name,
                second.name
            );
            understood += 1;
        }
    }
    assert!(understood > 8, "{understood}");
}

/// «Положи её к ним» puts nothing to itself, and "one" of several that were told is one of these.
#[test]
fn one_of_those_that_were_told_is_meant() {
    let rb2 = rb2();
    let mut memory = Memory::default();
    ask(&rb2, "Где Чашка-1?", &mut memory);
    let put = rb2.understand_in("Поставь её рядом с ней", &mut memory);
    assert!(put.is_err(), "{put:?}");
    let order = |text: &str, memory: &mut Memory| {
        let commands = rb2.understand_in(text, memory).ok()?;
        Some(format!("{commands:?}"))
    };
    for (listed, line) in [
        ("Какие книги есть в Комнате-В?", "Принеси одну"),
        ("Which books are in Room V?", "Bring me one of them"),
        ("Какие тарелки есть в Комнате-Z?", "Принеси мне одну, пожалуйста"),
    ] {
        let mut memory = Memory::default();
        let told = ask(&rb2, listed, &mut memory).expect("a plain question").symbols;
        let meant = order(line, &mut memory).unwrap_or_else(|| panic!("{listed} {line}"));
        let russian = line.starts_with("При");
        let named = |name: &String| {
            let text = if russian {
                format!("Принеси мне {name}")
            } else {
                format!("Bring me {name}")
            };
            order(&text, &mut Memory::default()).is_some_and(|command| command == meant)
        };
        assert_eq!(told.iter().filter(|name| named(name)).count(), 1, "{listed} {line}: {meant}");
    }
}

/// "I need the battery, where is it?" asks, "I can't find the cup, is it on the desk?" asks after the cup, and «есть что-нибудь из
/// еды?» of the class.
#[test]
fn what_a_person_tells_of_itself_is_what_is_asked_of() {
    let rb2 = rb2();
    let said = |answer: &Answer| (answer.said, answer.things.clone());
    let mut told = Family::default();
    for thing in ["umbrella", "medicine", "kettle", "vase", "dresser"] {
        let place = format!("Where is the {thing}?");
        for lead in ["I need the", "I can't find the", "I'm looking for the", "I lost the"] {
            let line = format!("{lead} {thing}, where is it?");
            told.hear(&rb2, &[&line], &place, said);
            let idea = format!("{lead} {thing}, any idea where it is?");
            told.hear(&rb2, &[&idea], &place, said);
            for room in ROOMS {
                let line = format!("Listen, {lead} {thing}, is it still in {room}?");
                let whether = format!("Is the {thing} in {room}?");
                told.hear(&rb2, &[&line], &whether, |answer| answer.said);
            }
        }
    }
    for thing in ["зонт", "чайник", "комод"] {
        let place = format!("Где {thing}?");
        for lead in ["Мне сказали, что", "Сосед говорит, что", "Слышал, что"]
        {
            let line = format!("{lead} {thing} сломался, где он?");
            told.hear(&rb2, &[&line], &place, said);
        }
        let whether = format!("{thing} в Комнате-В?");
        told.hear(&rb2, &[&format!("{thing} в Комнате-В или как?")], &whether, said);
    }
    told.mostly_understood();
    let Some(house) = engine("../shared/data/procthor/house_8.json") else { return };
    let mut classes = Family::default();
    for (of, kind) in [("еды", "еда"), ("мебели", "мебель"), ("посуды", "посуда")]
    {
        for room in ["кухне", "спальне", "ванной", "гостиной"] {
            let inside = if room == "кухне" { "на" } else { "в" };
            let line = format!("Есть ли {inside} {room} что-нибудь из {of}?");
            let plain = format!("Есть ли {inside} {room} {kind}?");
            classes.hear(&house, &[&line], &plain, |answer| answer.said);
        }
    }
    assert!(classes.understood > 3, "{} of {}", classes.understood, classes.asked);
}

/// A line that names nothing takes nothing away from what was spoken of, though it is not understood; one that has words for
/// something does.
#[test]
fn what_names_nothing_leaves_what_was_spoken_of() {
    let rb2 = rb2();
    for (line, russian) in [("А на чём?", true), ("Why there?", false)] {
        let mut memory = Memory::speaking(Language::of(line));
        ask(&rb2, "Where is the vase?", &mut memory);
        let refused = ask(&rb2, line, &mut memory).is_none();
        let asked = if russian { "Какого она цвета?" } else { "What colour is it?" };
        let told = ask(&rb2, asked, &mut memory);
        let plain = whole(&rb2, "What colour is the vase?").expect("a plain question");
        assert!(!refused || told.is_none_or(|told| told.things == plain.things), "{line}");
    }
    let mut memory = Memory::default();
    ask(&rb2, "Where is the vase?", &mut memory);
    assert!(ask(&rb2, "Is the gramophone zorbled?", &mut memory).is_none());
    assert!(ask(&rb2, "What colour is it?", &mut memory).is_none());
}

/// «Где зонт? А ваза? Принеси их»: both, or nothing; and of a table and a cup «её» is what can be carried.
#[test]
fn what_is_carried_is_all_that_was_meant_and_can_be() {
    let rb2 = rb2();
    let world = rb2.world().unwrap();
    let names: Vec<&str> = world
        .replicas
        .values()
        .filter(|r| world.has_trait(r.id, "portable"))
        .map(|r| r.name.as_str())
        .collect();
    let order = |text: &str, memory: &mut Memory| rb2.understand_in(text, memory).ok();
    let mut both = 0;
    for (first, second) in names.iter().zip(names.iter().cycle().skip(1)) {
        let mut memory = Memory::default();
        ask(&rb2, &format!("Где {first}?"), &mut memory);
        ask(&rb2, &format!("А {second}?"), &mut memory);
        let Some(commands) = order("Принеси их", &mut memory) else { continue };
        assert_eq!(commands.len(), 2, "{first}, {second}: {commands:?}");
        both += 1;
    }
    assert!(both > 5, "{both}");
    let two_storeys = engine("maps/two-storeys.toml").expect("part of the crate");
    let mut memory = Memory::default();
    ask(&two_storeys, "Что находится на складе?", &mut memory);
    let brought = two_storeys.understand_in("Принеси её", &mut memory).expect("the cup is meant");
    let cup = two_storeys.understand("Принеси Чашку-1").expect("a plain order");
    assert_eq!(format!("{brought:?}"), format!("{cup:?}"));
}

/// What goes on from a question about one thing, or about rooms that were told, is no list of all there is elsewhere.
#[test]
fn another_room_has_none_of_what_was_told_by_name() {
    let rb2 = rb2();
    for dialogue in [
        ["Is there a cup in Room Z?", "What colour is it?", "And in Room V?"],
        ["Which rooms have chairs?", "How many?", "And in Room Y?"],
        ["What is on the dresser?", "How big is it?", "And in Room Z?"],
    ] {
        let mut memory = Memory::default();
        let told: Vec<_> = dialogue.iter().map(|line| ask(&rb2, line, &mut memory)).collect();
        let last = told.last().expect("three lines");
        assert!(
            last.as_ref().is_none_or(|answer| answer.things.len() < 4),
            "{dialogue:?} {last:?}"
        );
    }
    for line in ["Is its door locked?", "Is its door made of glass?"] {
        let mut memory = Memory::default();
        ask(&rb2, "Where is Room Z?", &mut memory);
        let told = ask(&rb2, line, &mut memory);
        assert!(told.is_none_or(|answer| !answer.text.contains("is not a door")), "{line}");
    }
}

/// "How far is A from B? Which of them is higher up? What is it on? And the other one?": the two that were measured.
#[test]
fn what_was_measured_together_is_them_and_the_other_one() {
    let rb2 = rb2();
    let things = ["the fridge", "the kettle", "the medicine", "the vase", "the umbrella", "Book 5"];
    let found = |answer: &Answer| answer.things.iter().copied().collect::<BTreeSet<_>>();
    let (mut them, mut other) = (Family::default(), Family::default());
    for (a, b) in things.iter().zip(things.iter().cycle().skip(1)) {
        let far = format!("How far is {a} from {b}?");
        for more in ["higher up", "taller"] {
            let whole = format!("Which is {more}, {a} or {b}?");
            them.hear(&rb2, &[&far, &format!("Which of them is {more}?")], &whole, found);
        }
        let Some(higher) = whole_of(&rb2, &format!("Which is taller, {a} or {b}?")) else {
            continue;
        };
        for rest in [a, b] {
            if whole_of(&rb2, &format!("Where is {rest}?")).is_some_and(|t| t != higher) {
                let lines =
                    [&far, "Which of them is taller?", "Where is it?", "And the other one?"];
                other.hear(&rb2, &lines, &format!("Where is {rest}?"), found);
            }
        }
    }
    them.mostly_understood();
    other.mostly_understood();
}

fn whole_of(
    engine: &Engine,
    question: &str,
) -> Option<BTreeSet<orthoframe_language::question::Thing>> {
    whole(engine, question).map(|answer| answer.things.into_iter().collect())
}

/// «Отнеси чашку на стол. – Что на нём лежит? – Положи туда книгу»: where the order went, and never what was carried.
#[test]
fn there_is_whither_the_last_order_went() {
    let rb2 = rb2();
    let order = |text: &str, memory: &mut Memory| {
        let commands = rb2.understand_in(text, memory).ok()?;
        Some(format!("{commands:?}"))
    };
    let things = |answer: &Answer| answer.things.iter().copied().collect::<BTreeSet<_>>();
    let mut understood = 0;
    for place in ["the desk", "the dresser", "Table 1", "the dining table", "Bedside table 1"] {
        for thing in ["Book 1", "Plate 1", "the vase", "the kettle"] {
            let carry = format!("Put {thing} on {place}");
            let bears = whole(&rb2, &format!("What is on {place}?")).map(|a| things(&a));
            for asked in ["What is on it?", "What is on it now?"] {
                let mut memory = Memory::default();
                order(&carry, &mut memory).expect("a plain order");
                let told = ask(&rb2, asked, &mut memory).map(|a| things(&a));
                assert!(told.is_none() || told == bears, "{carry}. {asked}");
                understood += usize::from(told.is_some());
            }
            let plain = order(&format!("Put Book 5 on {place}"), &mut Memory::default());
            // A thing that is brought to a table is put on it.
            let toward = ["Put", "Bring"]
                .map(|verb| order(&format!("{verb} Book 5 to {place}"), &mut Memory::default()));
            for line in [
                "Put Book 5 on it",
                "Put Book 5 there",
                "Book 5 there too",
                "now put Book 5 there as well",
            ] {
                let mut memory = Memory::default();
                order(&carry, &mut memory).expect("a plain order");
                let told = order(line, &mut memory);
                assert!(
                    told.is_none() || told == plain || toward.contains(&told),
                    "{carry}. {line}: {told:?}"
                );
                understood += usize::from(told.is_some());
            }
        }
    }
    assert!(understood >= 5 * 4 * 6 / 2, "{understood}");
}

/// "Where is the nearest chair? How many of them are in the kitchen?": of its kind; «А на другой?»: on the other of the kind;
/// and of what the map lacks the question goes on to what it has.
#[test]
fn a_kind_goes_on_from_the_one_that_was_told() {
    let rb2 = rb2();
    let number = |answer: &Answer| answer.number;
    let found = |answer: &Answer| answer.things.iter().copied().collect::<BTreeSet<_>>();
    let rooms = ["в Комнате-В", "в Комнате-Z", "в Комнате-Y", "в коридоре"];
    let mut counts = Family::default();
    for room in rooms {
        for (kind, all) in [("стул", "стульев"), ("шкаф", "шкафов"), ("торшер", "торшеров")]
        {
            let whole = format!("Сколько {all} {room}?");
            for last in [format!("А {room} их сколько?"), format!("Сколько их {room}?")]
            {
                counts.hear(&rb2, &[&format!("Где ближайший {kind}?"), &last], &whole, number);
            }
        }
    }
    counts.mostly_understood();
    let mut others = Family::default();
    for (one, rest) in [("Тумбочке-1", "Тумбочке-2"), ("Тумбочке-2", "Тумбочке-1")]
    {
        for what in ["Что лежит", "Что стоит", "Что есть"] {
            let first = format!("{what} на {one}?");
            for last in ["А на другой?".to_owned(), format!("{what} на другой?")] {
                others.hear(&rb2, &[&first, &last], &format!("{what} на {rest}?"), found);
            }
        }
    }
    others.mostly_understood();
    let mut lacking = Family::default();
    for room in rooms {
        for kind in ["книга", "лампа", "стул"] {
            let first = format!("Есть ли {room} чашка?");
            let lines = [&first, "А аквариум?", &format!("А {kind}?")];
            lacking.hear(&rb2, &lines, &format!("Есть ли {room} {kind}?"), |a| a.said);
        }
    }
    lacking.mostly_understood();
}

/// "Which of the cups do you mean?" – "How many are in the kitchen?": of those that were asked back.
#[test]
fn what_was_asked_back_is_what_is_counted() {
    let rb2 = rb2();
    let mut counts = Family::default();
    for (one, all) in
        [("cup", "cups"), ("chair", "chairs"), ("book", "books"), ("wardrobe", "wardrobes")]
    {
        for room in ROOMS {
            let asked = format!("What colour is the {one}?");
            let whole = format!("How many {all} are in {room}?");
            counts.hear(&rb2, &[&asked, &format!("How many are in {room}?")], &whole, |a| a.number);
        }
    }
    counts.mostly_understood();
}

/// «В какой комнате нет дивана? А телевизора?», "Which room has the most chairs? And paintings?": rooms again, and no list of
/// televisions.
#[test]
fn what_rooms_have_goes_on_with_another_thing() {
    let rooms = |answer: &Answer| answer.things.iter().copied().collect::<BTreeSet<_>>();
    const ENGLISH: [&str; 4] = [
        "Which rooms have no {}?",
        "Which rooms have {}?",
        "Which room has the most {}?",
        "Which rooms are without {}?",
    ];
    const RUSSIAN: [&str; 4] = [
        "В каких комнатах нет {}?",
        "Где нет {}?",
        "В какой комнате больше всего {}?",
        "Какие комнаты без {}?",
    ];
    let mut told = Family::default();
    for map in ["maps/rb2.toml", "../shared/data/procthor/house_4.json"] {
        let Some(engine) = engine(map) else { continue };
        let english = ["chairs", "tables", "lamps", "books", "windows"];
        let russian = ["стульев", "столов", "ламп", "книг", "окон"];
        for (frames, kinds, leads) in [
            (ENGLISH, english, ["And {}?", "What about {}?"]),
            (RUSSIAN, russian, ["А {}?", "А как же {}?"]),
        ] {
            for (n, (kind, other)) in kinds.iter().zip(kinds.iter().cycle().skip(1)).enumerate() {
                for frame in frames {
                    let opening = frame.replace("{}", kind);
                    let line = leads[n % 2].replace("{}", other);
                    told.hear(&engine, &[&opening, &line], &frame.replace("{}", other), rooms);
                }
            }
        }
    }
    told.mostly_understood();
}

/// «Где яблоко? Что ещё на нём лежит?»: nothing lies on an apple, so that "it" is something else.
#[test]
fn what_else_is_on_it_is_asked_of_what_bears_something() {
    let rb2 = rb2();
    for thing in ["зонт", "чайник", "пульт"] {
        let mut memory = Memory::default();
        let Some(told) = ask(&rb2, &format!("Где {thing}?"), &mut memory) else { continue };
        let [only] = told.things[..] else { continue };
        let more = ask(&rb2, "Что ещё на нём?", &mut memory);
        assert!(more.is_none_or(|answer| !answer.text.contains("больше ничего")), "{only:?}");
    }
}

/// «Каких вещей больше всего?» asks for a kind: the biggest thing is no answer.
#[test]
fn the_most_of_all_things_is_not_the_biggest_of_them() {
    let rb2 = rb2();
    for line in [
        "Каких вещей больше всего в Комнате-В?",
        "Каких предметов в Комнате-В больше всего?",
        "Чего больше всего в Комнате-В?",
        "What is there most of in Room V?",
    ] {
        let told = whole(&rb2, line);
        assert!(told.is_none(), "{line} {told:?}");
    }
}

/// «Поезжай в Комнату-Z.» – «А теперь на зарядку.»: after whatever was ordered, the robot goes to the place of its own.
#[test]
fn it_goes_on_to_a_place_of_its_own() {
    let goals = |lines: &[&str]| {
        let (mut engine, mut dialogue) = (rb2(), Dialogue::default());
        let heard = lines.iter().map(|l| dialogue.hear(&mut engine, l, &mut |_, _| {}).unwrap());
        let last = heard.last().expect("a line");
        last.tasks().map(|task| task.goal.clone()).collect::<Vec<_>>()
    };
    let own = goals(&["Поезжай в Комнату-Z.", "Поезжай на зарядку."]);
    assert_eq!(own.len(), 1);
    let befores = ["Поезжай в Комнату-Z.", "Go to Room Z.", "Отнеси Чашку-1 в Комнату-Z."];
    for before in befores {
        for joint in ["А теперь", "Теперь", "И потом", "Ну а теперь", "Ладно, теперь"]
        {
            for haunt in ["на зарядку", "на подзарядку", "к зарядной станции"]
            {
                let line = format!("{joint} {haunt}.");
                assert_eq!(goals(&[before, &line]), own, "{before} {line}");
            }
        }
        for joint in ["And now", "Then", "Now", "Okay, now"] {
            for haunt in ["to charge", "to recharge", "to your charger", "to the docking station"] {
                let line = format!("{joint} {haunt}, please.");
                assert_eq!(goals(&[before, &line]), own, "{before} {line}");
            }
        }
    }
}

/// «Где ноутбук? – На столе. – Что рядом с ним? – Сколько там стульев?»: of what stands on the floor "there" is the room,
/// whether or not it was asked in between what is beside.
#[test]
fn what_stands_on_the_floor_is_in_the_room_of_what_was_spoken_of() {
    for map in ["procthor/house_4.json", "procthor/house_5.json"] {
        let Some(engine) = engine(&format!("../shared/data/{map}")) else { return };
        let world = engine.world().unwrap();
        let mut there = Family::default();
        let portable = world.replicas.values().filter(|r| world.has_trait(r.id, "portable"));
        for thing in portable.step_by(7) {
            let Some(area) = engine.relations().unwrap().area_of(thing.id) else { continue };
            let where_is = format!("Where is {}?", thing.name_en);
            let beside = format!("What is next to {}?", thing.name_en);
            let room = &world.areas[&area].name_en;
            let asked = format!("How many chairs are there in the {}?", room.to_lowercase());
            let number = |answer: &Answer| answer.number;
            for lines in [
                &[&where_is, "How many chairs are in there?"][..],
                &[&where_is, &beside, "How many chairs are in there?"],
            ] {
                there.hear(&engine, lines, &asked, number);
            }
        }
        there.mostly_understood();
    }
}

/// "Why can't you reach it?": where a way leads to it, that the arm is too short or that it is not so; never the way as the
/// reason.
#[test]
fn a_way_is_no_reason_why_it_cannot_be_reached() {
    let (mut short, mut unfounded) = (0, 0);
    for scene in 1..=3 {
        let file = format!("../shared/data/virtualhome/TestScene{scene}_graph.json");
        let Some(engine) = engine(&file) else { return };
        for thing in engine.world().unwrap().replicas.values().step_by(5) {
            let line = format!("Why can't you reach {}?", thing.name_en);
            let Some(told) = whole(&engine, &line) else { continue };
            assert!(!told.text.starts_with("By the map it is so: there is a way"), "{}", told.text);
            short += usize::from(told.text.contains("out of reach"));
            unfounded += usize::from(told.text.starts_with("By the map it is not so"));
        }
    }
    assert!(short > 0 && unfounded > 0, "{short} {unfounded}");
}
