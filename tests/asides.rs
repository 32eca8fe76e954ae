//! What is told around a question: what bounds nothing changes no answer, and what bounds it is never passed over.
//!
//! The files in `tests/asides` hold what people say; `{}` stands for a question of the golden talks.

use orthoframe::Engine;
use orthoframe::engine::Memory;

use crate::files::{long, project};
use crate::talk::engine;

/// Golden talks whose first questions are asked here: on maps of this house and of others.
const TALKS: [&str; 9] = [
    "rb2-ru",
    "rb2-en",
    "house-ru",
    "house-en",
    "fresh-lab",
    "asked-house4",
    "stranger-house3",
    "fresh-clinic",
    "uses-house7",
];

/// A question of a golden talk, with its answer, and the query that it was read as.
struct Asked {
    question: String,
    russian: bool,
    text: String,
    query: String,
}

/// What is answered to a line in a new dialogue, without what was understood before it.
fn answered(engine: &Engine, line: &str) -> Option<(String, String)> {
    let answer = engine.ask(line, &mut Memory::default()).expect("there is a map").ok()?;
    let (text, query) = (answer.text, format!("{:?}", answer.query));
    let understood = ["Understood as “", "Понял так: «"].iter().any(|lead| text.starts_with(lead));
    let rest = text.split_once(['”', '»']).map(|(_, rest)| rest.trim().to_owned());
    Some((rest.filter(|_| understood).unwrap_or(text), query))
}

/// The questions of a golden talk that begin a dialogue, tell nothing aside and have an answer.
fn asked(engine: &Engine, talk: &str) -> Vec<Asked> {
    let questions = project("tests/golden/talk").join(talk).join("questions.txt");
    let lines = std::fs::read_to_string(questions).unwrap();
    let lines = lines.lines().map(str::trim);
    let plain = |line: &&str| {
        let begins = !line.is_empty() && !line.starts_with(['+', '#']);
        begins && line.ends_with('?') && !line.contains([',', '.', '!', '–'])
    };
    let asked = lines.filter(plain).filter_map(|question| {
        let (text, query) = answered(engine, question)?;
        let russian = question.chars().any(|c| matches!(c, 'а'..='я' | 'А'..='Я'));
        Some(Asked { question: question.to_owned(), russian, text, query })
    });
    asked.collect()
}

/// What stands in a file of `tests/asides`, one aside a line.
fn asides(file: &str) -> Vec<String> {
    let text = std::fs::read_to_string(project("tests/asides").join(file)).unwrap();
    let lines =
        text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    lines.map(str::to_owned).collect()
}

/// An aside around a question, as it would be written.
fn around(aside: &str, question: &str) -> String {
    let (before, behind) = aside.split_once("{}").expect("a place for the question");
    let within = !before.is_empty() && !before.trim_end().ends_with(['.', '!']);
    let mut letters = question.chars();
    let question = match letters.next() {
        Some(first) if within => first.to_lowercase().chain(letters).collect(),
        _ => question.to_owned(),
    };
    match behind.starts_with(',') {
        true => format!("{before}{}{behind}?", question.trim_end_matches('?')),
        false => format!("{before}{question}{behind}"),
    }
}

/// Every line of an aside around a question, with the question. The ordinary run takes some of them.
fn lines(kind: &str, mut look: impl FnMut(&Engine, &str, &Asked, &str)) {
    let most = if long() { 4 } else { 1 };
    for talk in TALKS {
        let map = project("tests/golden/talk").join(talk).join("map.txt");
        let map = std::fs::read_to_string(map).unwrap();
        let Some(engine) = engine(map.trim()) else { continue };
        let all = asked(&engine, talk);
        for (russian, file) in [(true, "ru"), (false, "en")] {
            let all: Vec<&Asked> = all.iter().filter(|asked| asked.russian == russian).collect();
            for (n, aside) in asides(&format!("{kind}.{file}.txt")).iter().enumerate() {
                for k in 0..most.min(all.len()) {
                    let asked = all[(n * 7 + k * 5) % all.len()];
                    look(&engine, file, asked, &around(aside, &asked.question));
                }
            }
        }
    }
}

/// An answer with an idle aside is the answer without it, or there is none; and mostly there is one.
#[test]
#[expect(clippy::print_stdout, reason = "how many are understood is worth seeing")]
fn what_bounds_nothing_changes_no_answer() {
    let mut changed = Vec::new();
    let mut counts = [("ru", 0, 0), ("en", 0, 0)];
    lines("idle", |engine, language, asked, line| {
        let counts = counts.iter_mut().find(|(own, ..)| *own == language).expect("two languages");
        counts.1 += 1;
        match answered(engine, line) {
            Some((text, _)) if text == asked.text => counts.2 += 1,
            Some((text, _)) => changed.push(format!("{line}\n  {text}\n  {}", asked.text)),
            None => {}
        }
    });
    for (language, asked, same) in counts {
        println!("{language}: {same} of {asked} as without the aside");
    }
    println!("{} otherwise", changed.len());
    assert!(changed.is_empty(), "{}", changed.join("\n"));
    for (language, asked, same) in counts {
        assert!(same * 100 >= asked * 80, "{language}: {same} of {asked}");
    }
}

/// With an aside that bounds the question there is no answer, or one that takes account of it: never the bare one.
#[test]
#[expect(clippy::print_stdout, reason = "how many are understood is worth seeing")]
fn what_bounds_a_question_is_never_passed_over() {
    let (mut told, mut heeded, mut bare) = (0, 0, Vec::new());
    lines("binding", |engine, _, asked, line| {
        told += 1;
        if let Some((text, query)) = answered(engine, line) {
            match query == asked.query {
                true => bare.push(format!("{line}\n  {text}")),
                false => heeded += 1,
            }
        }
    });
    println!("{} of {told} passed over, {heeded} heeded", bare.len());
    assert!(bare.is_empty(), "{}", bare.join("\n"));
}
