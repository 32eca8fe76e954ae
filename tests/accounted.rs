//! Every content word of a question is accounted for: one that is put into it changes how it is read, or how it is answered,
//! or there is no answer.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe::engine::Memory;
use orthoframe_language::{Case, NounPhrase, Number, WordHints, english, russian};
use orthoframe_map::{Replica, World};
use orthoframe_semantics::Relations;

use crate::files::{long, project};
use crate::talk::engine;

/// Words that each ask for something, or bound what is asked for.
const ENGLISH: [&str; 8] = [
    "whose",
    "red",
    "wooden",
    "closed",
    "on the desk",
    "without a lamp",
    "except the sofa",
    "without going through the corridor",
];
const RUSSIAN: [&str; 8] = [
    "чей",
    "красный",
    "деревянная",
    "закрытые",
    "на столе",
    "без лампы",
    "кроме дивана",
    "минуя коридор",
];

/// A line with words put in before its word at `gap`, or at its end.
fn with(question: &str, words: &str, gap: usize) -> String {
    let bare = question.trim_end_matches('?');
    let mut line: Vec<&str> = bare.split(' ').collect();
    line.insert(gap, words);
    format!("{}{}", line.join(" "), &question[bare.len()..])
}

/// Wherever a content word stands in a golden question, it is not passed over in silence.
#[test]
fn no_content_word_is_passed_over() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    // With `ORTHOFRAME_LONG` words are put into all of them.
    let step = if long() { 1 } else { 40 };
    let ask = |line: &str| {
        let answer = rb2.ask(line, &mut Memory::default()).expect("there is a map").ok()?;
        Some((format!("{:?}", answer.query), answer.text))
    };
    let (mut asked, mut passed_over) = (0, Vec::new());
    for case in ["rb2-en", "fresh-rb2", "rb2-ru", "stranger-rb2"] {
        let questions = project("tests/golden/talk").join(case).join("questions.txt");
        let questions = std::fs::read_to_string(questions).unwrap();
        let own = questions.lines().map(str::trim);
        let own = own.filter(|line| !line.is_empty() && !line.starts_with(['+', '#']));
        for question in own.step_by(step) {
            let Some(plain) = ask(question) else { continue };
            let is_russian = question.chars().any(|letter| ('а'..='я').contains(&letter));
            for words in if is_russian { RUSSIAN } else { ENGLISH } {
                for gap in 0..=question.split(' ').count() {
                    let line = with(question, words, gap);
                    asked += 1;
                    if ask(&line).as_ref() == Some(&plain) {
                        passed_over.push(line);
                    }
                }
            }
        }
    }
    let (many, all) = (passed_over.len(), passed_over.join("\n"));
    assert!(many * 100 <= asked, "{many} of {asked}:\n{all}");
}

/// What bears or holds things of a kind: its kind and theirs, and how many.
fn borne(world: &World, relations: &Relations) -> BTreeSet<(String, String, String, String, u64)> {
    let kind = |replica: &Replica| {
        let kind = world.types.object.get(world.objects[&replica.object].object_type)?;
        Some((kind.name.to_lowercase(), kind.name_en.to_lowercase()))
    };
    let mut counted: BTreeMap<_, u64> = BTreeMap::new();
    for thing in world.replicas.values() {
        let Some(support) = relations.support_of(thing.id) else { continue };
        let (Some(of), Some(on)) = (kind(thing), kind(&world.replicas[&support])) else { continue };
        *counted.entry((support, on, of)).or_default() += 1;
    }
    let several = counted.into_iter().filter(|(_, n)| *n > 1);
    several.map(|((_, on, of), n)| (on.0, on.1, of.0, of.1, n)).collect()
}

/// «На каком столе пять тарелок?», "Which table are five plates on?": where there are so many, in whatever words, or it is
/// not understood.
#[test]
fn a_number_of_things_tells_what_bears_them() {
    let mut told = 0;
    for map in [
        "../shared/data/procthor/house_5.json",
        "../shared/data/procthor/house_8.json",
        "../shared/data/virtualhome/TestScene3_graph.json",
    ] {
        let Some(house) = engine(map) else { return };
        let symbols = |line: &str| -> Option<BTreeSet<String>> {
            let answer = house.ask(line, &mut Memory::default()).expect("there is a map").ok()?;
            Some(answer.symbols.into_iter().collect())
        };
        for (on, on_en, of, of_en, there_are) in
            borne(house.world().unwrap(), house.relations().unwrap())
        {
            let phrase = |words: &str| NounPhrase::parse(words, &WordHints::default());
            let place = phrase(&on);
            let which =
                russian::agreeing("какой", Case::Prepositional, Number::Singular, place.gender());
            let place = place.form(Case::Prepositional, Number::Singular);
            let many = english::plural(&of_en);
            for n in [there_are, there_are + 1] {
                let plain = symbols(&format!("Which {on_en} has {n} {many}?"));
                let Some(plain) = plain else { continue };
                let things = russian::count(n, &phrase(&of));
                for line in [
                    format!("On which {on_en} are there {n} {many}?"),
                    format!("Which {on_en} are {n} {many} on?"),
                    format!("На {which} {place} {things}?"),
                    format!("На {which} {place} лежат {things}?"),
                ] {
                    let Some(found) = symbols(&line) else { continue };
                    assert_eq!(found, plain, "{line}");
                    told += 1;
                }
            }
        }
    }
    assert!(told > 20, "{told}");
}
