//! What a plan rests on, as one tells a person in Russian: «Дверь-ZY открыта».
//!
//! The papers name a predicate so that its words stand about its arguments: ДВЕРЬ_ИЗ_В_ОТКРЫТА_(дверь, откуда, куда). What the
//! rule file gives a phrase is told by that; what the Map assumes has words here; any other is read so.

use crate::language::names::hints;
use crate::language::words::NounPhrase;
use crate::language::words::russian::{self, Preposition};
use crate::language::{Case, Language, WordHints};
use crate::map::World;
use crate::robot::Solved;
use crate::semantics::predicate;
use crate::strips::{Said, SaidArgument};
use crate::units::told;

use super::barriers::agrees;
use super::name_in;

const RUSSIAN: Language = Language::Russian;

/// The assumptions of a plan, each once.
pub(super) fn assumptions_in_russian(world: &World, solved: &Solved) -> Vec<String> {
    let name = |name: &str| name_in(world, name, Language::Russian);
    let wording = solved.wording(RUSSIAN, &name);
    let mut told: Vec<String> = Vec::new();
    for fact in &solved.assumptions {
        let phrase = wording.fact(fact);
        let is_phrase = phrase != fact.written(Language::Russian);
        let text = if is_phrase { phrase } else { in_russian(world, fact) };
        if !told.contains(&text) {
            told.push(text);
        }
    }
    told
}

fn in_russian(world: &World, fact: &Said) -> String {
    let args: Vec<NounPhrase> = fact.args.iter().map(|argument| phrase(world, argument)).collect();
    let of = |at: usize, case: Case| args[at].case(case);
    match (fact.name.as_str(), args.len(), fact.negated) {
        (predicate::DOOR_OPEN | predicate::DOOR_CLOSED | predicate::DOOR_LOCKED, 3, false) => {
            let (door, agrees) = (of(0, Case::Nominative), agrees(&args[0]));
            match fact.name.as_str() {
                predicate::DOOR_OPEN => told!(RUSSIAN, "door-open", door, agrees),
                predicate::DOOR_CLOSED => told!(RUSSIAN, "door-closed", door, agrees),
                _ => told!(RUSSIAN, "door-locked", door, agrees),
            }
        }
        (predicate::LIFT_WORKS, 1, false) => {
            told!(RUSSIAN, "lift-works", lift = of(0, Case::Nominative))
        }
        (predicate::CABIN_AT, 2, false) => {
            let at = russian::with(Preposition::U, Case::Genitive, &args[1]);
            told!(RUSSIAN, "cabin-stands", lift = of(0, Case::Genitive), at)
        }
        (predicate::MAY_BE_IN, 2, false) => {
            let place = russian::where_at(&args[1]);
            told!(RUSSIAN, "may-be-there", thing = of(0, Case::Nominative), place)
        }
        _ => as_named(fact, &args),
    }
}

/// The words of a predicate's name about its arguments; those that have no place among them, behind.
fn as_named(fact: &Said, args: &[NounPhrase]) -> String {
    let mut args = args.iter().map(NounPhrase::name);
    let mut words: Vec<String> = Vec::new();
    if fact.negated {
        words.push(told!(RUSSIAN, "it-is-not-so-that"));
    }
    let pieces: Vec<&str> = fact.name.split('_').collect();
    for (at, piece) in pieces.iter().enumerate() {
        if !piece.is_empty() {
            words.push(piece.replace('-', " ").to_lowercase());
        }
        if at + 1 < pieces.len() {
            words.extend(args.next().map(str::to_owned));
        }
    }
    let rest: Vec<&str> = args.collect();
    match rest.is_empty() {
        true => words.join(" "),
        false => format!("{}: {}", rest.join(", "), words.join(" ")),
    }
}

fn phrase(world: &World, argument: &SaidArgument) -> NounPhrase {
    match argument {
        SaidArgument::Object(name) => {
            let called = name_in(world, name, Language::Russian);
            let hints = world.find(name).first().map(|entity| hints(world, *entity));
            NounPhrase::parse(&called, &hints.unwrap_or_default())
        }
        SaidArgument::Any(kinds) => {
            NounPhrase::parse(&kinds.join(&told!(RUSSIAN, "or")), &WordHints::default())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn assumptions_read_as_sentences() {
        let world = World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/maps/rb2.toml"));
        let world = world.expect("the map is sound");
        let say = |name: &str, args: &[&str], negated: bool| {
            let args = args.iter().map(|name| SaidArgument::Object((*name).to_owned())).collect();
            in_russian(&world, &Said { name: name.to_owned(), args, negated })
        };
        let rooms = ["Комната-В", "Комната-Z"];
        let door = |name, state: &str| say(state, &[name, rooms[0], rooms[1]], false);
        assert_eq!(door("Дверь-ВZ", predicate::DOOR_OPEN), "Дверь-ВZ открыта");
        assert_eq!(door("Проход-ВК", predicate::DOOR_OPEN), "Проход-ВК открыт");
        assert_eq!(door("Дверь-КY", predicate::DOOR_LOCKED), "Дверь-КY заперта");
        let lift = say(predicate::CABIN_AT, &["Лифт-1", "Дверь-ВZ"], false);
        assert_eq!(lift, "кабина Лифта-1 стоит у Двери-ВZ");
        let seen = say(predicate::MAY_BE_IN, &["Чашка-1", "Комната-Z"], false);
        assert_eq!(seen, "Чашка-1 может быть в Комнате-Z");
        let own = say("РОБОТ-ВИДИТ_ИЗ_", &["Чашка-1", "Комната-Z"], true);
        assert_eq!(own, "неверно, что робот видит Чашка-1 из Комната-Z");
        assert_eq!(say("ТИХО-В", &["Комната-Z"], false), "Комната-Z: тихо в");
    }
}
