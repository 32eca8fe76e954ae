//! Every content word of a question is accounted for: one that is put into it changes how it is read, or how it is answered,
//! or there is no answer.

use orthoframe::engine::Memory;

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
