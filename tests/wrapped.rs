//! What is wrapped around a question and says nothing of the world: particles, and the ways to lead in what is asked. It changes
//! no answer, and what is refused stays refused.

use std::fmt::{Display, Formatter};

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Memory, Outcome};

use orthoframe_language::question::Said;
use orthoframe_language::{NounPhrase, WordHints, russian};
use orthoframe_units::name_key;

use crate::files::{long, project};
use crate::talk::engine;

/// A golden case: its map, and the questions that begin a dialogue.
struct Case {
    name: &'static str,
    engine: Engine,
    questions: Vec<String>,
}

/// Cases of several maps, of which those of others may lack their map.
fn cases() -> Vec<Case> {
    const NAMES: [&str; 12] = [
        "rb2-ru",
        "rb2-en",
        "house-ru",
        "house-en",
        "fresh-clinic",
        "fresh-lab",
        "stranger-house2",
        "stranger-house5",
        "stranger-scene2",
        "uses-house7",
        "measured-rb2",
        "storeys",
    ];
    let read = |name: &'static str| {
        let folder = project("tests/golden/talk").join(name);
        let map = std::fs::read_to_string(folder.join("map.txt")).unwrap();
        let text = std::fs::read_to_string(folder.join("questions.txt")).unwrap();
        let lines = text.lines().map(str::trim);
        let openings = lines.filter(|line| !line.is_empty() && !line.starts_with(['+', '#']));
        let questions = openings.map(str::to_owned).collect();
        Some(Case { name, engine: engine(map.trim())?, questions })
    };
    NAMES.into_iter().filter_map(read).collect()
}

/// How lines that should be answered as plain ones are were answered.
#[derive(Default)]
struct Tally {
    asked: usize,
    same: usize,
    changed: Vec<String>,
}

impl Tally {
    /// What was told, if anything was, and what the plain line tells.
    fn add<T: PartialEq + Display>(&mut self, name: &str, line: &str, told: Option<T>, plain: &T) {
        self.asked += 1;
        match told {
            None => {}
            Some(told) if told == *plain => self.same += 1,
            Some(told) => self.changed.push(format!("{name}: {line}\n  {told}\n  {plain}")),
        }
    }

    /// No answer is another, and so many of a hundred are answered.
    #[expect(clippy::print_stdout, reason = "how many are understood is worth seeing")]
    fn end(self, least: usize) {
        let Self { asked, same, changed } = self;
        println!("{same} of {asked} as the plain ones");
        assert!(changed.is_empty(), "{}", changed.join("\n"));
        assert!(same * 100 >= asked * least, "{same} of {asked}");
    }
}

/// The ordinary run takes one question of six.
fn some(case: &Case) -> impl Iterator<Item = (usize, &String)> {
    case.questions.iter().step_by(if long() { 1 } else { 6 }).enumerate()
}

/// What is answered, without what was understood before it; none where it is not.
fn answered(engine: &Engine, question: &str) -> Option<String> {
    let text = engine.ask(question, &mut Memory::default()).expect("there is a map").ok()?.text;
    let understood = ["Understood as “", "Понял так: «"].iter().any(|lead| text.starts_with(lead));
    let rest = text.split_once(['”', '»']).map(|(_, rest)| rest.trim().to_owned());
    Some(rest.filter(|_| understood).unwrap_or(text))
}

fn is_russian(text: &str) -> bool {
    text.chars().any(|c| matches!(c, 'а'..='я' | 'А'..='Я' | 'ё' | 'Ё'))
}

fn uncapitalized(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map(|first| first.to_lowercase().chain(chars).collect()).unwrap_or_default()
}

const RUSSIAN: [&str; 16] = [
    "Ой",
    "Извини",
    "Короче",
    "Значит",
    "Как его",
    "Ну",
    "Типа",
    "Ну короче",
    "Это самое",
    "Слушай",
    "Короче говоря",
    "Блин",
    "В общем",
    "Знаешь",
    "Так вот",
    "Кстати",
];
const ENGLISH: [&str; 15] = [
    "Actually",
    "Sorry",
    "Like",
    "You know",
    "So",
    "Well",
    "Basically",
    "Look",
    "So like",
    "Honestly",
    "Okay so",
    "Long story short",
    "By the way",
    "Anyway",
    "Let's see",
];

/// A particle that a comma parts from any understood question of the golden sets, before it, changes no answer.
#[test]
fn a_particle_before_a_question_changes_no_answer() {
    let mut asked = 0;
    for case in cases() {
        for (n, question) in some(&case) {
            let Some(plain) = answered(&case.engine, question) else { continue };
            let particles: &[&str] = if is_russian(question) { &RUSSIAN } else { &ENGLISH };
            for particle in
                [particles[n % particles.len()], particles[(n * 5 + 2) % particles.len()]]
            {
                for line in [
                    format!("{particle}, {}", uncapitalized(question)),
                    format!("{particle}… {question}"),
                ] {
                    let told = answered(&case.engine, &line);
                    assert_eq!(told.as_deref(), Some(&*plain), "{}: {line}", case.name);
                    asked += 1;
                }
            }
        }
    }
    assert!(asked > 200, "{asked}");
}

/// The same between any two words: the same answer, or none; and mostly there is one.
#[test]
fn a_particle_within_a_question_changes_no_answer() {
    let mut tally = Tally::default();
    for case in cases() {
        for (n, question) in some(&case) {
            let Some(plain) = answered(&case.engine, question) else { continue };
            let particles: &[&str] = if is_russian(question) { &RUSSIAN } else { &ENGLISH };
            let words: Vec<&str> = question.split(' ').collect();
            let names: Vec<String> =
                case.engine.world().unwrap().names().map(|(_, name)| name_key(name)).collect();
            for at in (1..words.len()).step_by(2) {
                // Nobody hesitates within a name.
                let key = name_key(&words[at - 1..=at].join(" "));
                let key = key.trim_matches(|c: char| !c.is_alphanumeric());
                if names.iter().any(|name| name.contains(key)) {
                    continue;
                }
                let particle = uncapitalized(particles[(n + at) % particles.len()]);
                let (before, behind) = (words[..at].join(" "), words[at..].join(" "));
                let before = before.trim_end_matches(',');
                let line = format!("{before}, {particle}, {behind}");
                tally.add(case.name, &line, answered(&case.engine, &line), &plain);
            }
        }
    }
    tally.end(95);
}

const ADVERBS_RU: [&str; 14] = [
    "сегодня",
    "вообще",
    "собственно",
    "быстренько",
    "честно говоря",
    "случайно",
    "всё ещё",
    "на данный момент",
    "в итоге",
    "реально",
    "конкретно",
    "если не трудно",
    "пожалуйста",
    "нынче",
];
const ADVERBS_EN: [&str; 14] = [
    "today",
    "exactly",
    "these days",
    "real quick",
    "do you think",
    "by any chance",
    "still",
    "at this very moment",
    "in fact",
    "already",
    "this time",
    "if you know",
    "please",
    "even",
];

/// An adverb that bounds nothing, at either end of a question and with no comma: the same answer, or none; and mostly there is
/// one. So of an order: what is understood is what was without it.
#[test]
fn an_adverb_at_either_end_changes_nothing() {
    let mut tally = Tally::default();
    for case in cases() {
        for (n, question) in some(&case) {
            let Some(plain) = answered(&case.engine, question) else { continue };
            let adverbs = if is_russian(question) { &ADVERBS_RU } else { &ADVERBS_EN };
            for adverb in [adverbs[n % 14], adverbs[(n * 5 + 3) % 14]] {
                let begun = question.trim_end_matches('?');
                for line in
                    [format!("{begun} {adverb}?"), format!("{adverb} {}", uncapitalized(question))]
                {
                    tally.add(case.name, &line, answered(&case.engine, &line), &plain);
                }
            }
        }
    }
    tally.end(80);
    let engine = Engine::in_memory(crate::worlds::rb2(), None).unwrap();
    let understood = |line: &str| engine.understand(line).ok().map(|all| format!("{all:?}"));
    for (order, adverbs) in [
        (
            "принеси зонт",
            ["быстренько", "прямо сейчас", "как можно скорее", "если можешь", "ещё раз"],
        ),
        ("поезжай в Комнату-Y", ["сразу", "по-быстрому", "на минутку", "чувак", "когда сможешь"]),
        ("bring the umbrella", ["right away", "asap", "as soon as you can", "real quick", "bro"]),
        ("go to Room-Y", ["hurry up", "for a second", "this time", "if you would", "today"]),
    ] {
        let plain = understood(order);
        assert!(plain.is_some(), "{order}");
        for line in adverbs.map(|adverb| format!("{order} {adverb}")) {
            assert_eq!(understood(&line), plain, "{line}");
        }
    }
}

/// What is led in by words that ask for nothing themselves is answered as it is without them, or not at all; mostly it is.
#[test]
fn what_leads_a_question_in_changes_no_answer() {
    const RUSSIAN: [&str; 8] = [
        "Это мне кажется или {}?",
        "Сделай одолжение, скажи, {}",
        "Не сочти за труд, скажи, {}",
        "Слушай, а вот скажи мне, {}",
        "У меня такой вопрос: {}",
        "Мне тут интересно стало, {}",
        "Может, ты знаешь, {}",
        "Вопрос на засыпку: {}",
    ];
    const ENGLISH: [&str; 8] = [
        "Is it me or {}?",
        "Is it just me, or {}?",
        "Do me a favor and tell me, {}",
        "Do me a favour: {}",
        "I've got a question: {}",
        "Here's a question for you: {}",
        "I was just wondering, {}",
        "Maybe you know, {}",
    ];
    let mut tally = Tally::default();
    for case in cases() {
        for (n, question) in some(&case) {
            let Some(plain) = answered(&case.engine, question) else { continue };
            let frames: &[&str] = if is_russian(question) { &RUSSIAN } else { &ENGLISH };
            for frame in [frames[n % frames.len()], frames[(n * 3 + 1) % frames.len()]] {
                // Of oneself is doubted whether something is so; and what is asked may be one question only.
                let whether = ["Да", "Нет", "Yes", "No"].iter().any(|said| plain.starts_with(said));
                let several = question.trim_end_matches('?').contains(['?', '.']);
                if frame.ends_with("{}?") && !whether || several {
                    continue;
                }
                let bare = match frame.ends_with('?') {
                    true => question.trim_end_matches(['?', '.', '!']),
                    false => question,
                };
                let line = frame.replace("{}", &uncapitalized(bare));
                tally.add(case.name, &line, answered(&case.engine, &line), &plain);
            }
        }
    }
    tally.end(80);
}

/// No refusal speaks of a word without saying it.
#[test]
fn no_refusal_quotes_nothing() {
    let mut refused = 0;
    for case in cases() {
        let mut memory = Memory::default();
        for question in &case.questions {
            let words: Vec<&str> = question.split(' ').collect();
            // The question, its end, and its beginning, which may be none; each after what was said before.
            let cuts = [question.clone(), words[words.len() / 2..].join(" "), words[..1].join(" ")];
            for line in cuts.iter().step_by(if long() { 1 } else { 2 }) {
                let Err(unanswered) = case.engine.ask(line, &mut memory).unwrap() else { continue };
                let text = &unanswered.text;
                let is_empty =
                    ["\"\"", "«»", "“”", "''", "  "].iter().any(|none| text.contains(none));
                assert!(!is_empty, "{}: {line}: {text}", case.name);
                refused += 1;
            }
        }
    }
    assert!(refused > 100, "{refused}");
}

/// Whether a claim is so, and the words for it.
struct Claimed(Said, String);

impl PartialEq for Claimed {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl Display for Claimed {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        self.1.fmt(f)
    }
}

/// What others claim is answered as the question is whether it is so, whichever words tell of the claim and whichever ask; and
/// mostly it is answered.
#[test]
fn a_claim_is_asked_after_however_it_was_heard() {
    const FRAMES: [(&str, &str); 16] = [
        ("I was told that {}, correct?", "Is {}?"),
        ("I've been told that {}, is that so?", "Is {}?"),
        ("I heard {}, is it true?", "Is {}?"),
        ("Someone mentioned that {}, right?", "Is {}?"),
        ("Do me a favor and see whether {}", "Is {}?"),
        ("Could you check if {}?", "Is {}?"),
        ("Would you mind checking whether {}?", "Is {}?"),
        ("Can you confirm that {}?", "Is {}?"),
        ("Мне сказали, что {}, это так?", "{}?"),
        ("Мне тут сказали, что {}. Правда?", "{}?"),
        ("Я слышал, что {}, верно?", "{}?"),
        ("Говорят, что {}, так ли это?", "{}?"),
        ("Сделай одолжение, проверь, {}?", "{}?"),
        ("Мне казалось, что {}, разве нет?", "{}?"),
        ("Уверяют, будто {}. Это правда?", "{}?"),
        ("Подтверди, что {}", "{}?"),
    ];
    let mut tally = Tally::default();
    for case in cases().into_iter().step_by(2) {
        let world = case.engine.world().unwrap();
        let rooms: Vec<_> = world.areas.values().collect();
        let things = world.replicas.values().filter(|r| !r.name_en.is_empty());
        for (n, thing) in things.step_by(if long() { 2 } else { 20 }).take(40).enumerate() {
            let room = rooms[(n * 7) % rooms.len()];
            let place = russian::where_at(&NounPhrase::parse(&room.name, &WordHints::default()));
            let english = format!("{} is in {}", thing.name_en, room.name_en);
            let russian = format!("{} {place}", thing.name);
            for (frame, question) in FRAMES.iter().skip(n % 4).step_by(4) {
                let of = |text: &str, claim: &str| text.replace("{}", claim);
                let (line, plain) = match is_russian(frame) {
                    true => (of(frame, &russian), of(question, &russian)),
                    false => {
                        let asked = english.replacen(" is ", " ", 1);
                        (of(frame, &english), of(question, &asked))
                    }
                };
                let said = |text: &str| {
                    let answer = case.engine.ask(text, &mut Memory::default()).unwrap().ok()?;
                    // «Подтверди, что стул на кухне» may list what is there.
                    let so = match answer.said {
                        Said::Found => Said::Yes,
                        Said::Nothing => Said::No,
                        said => said,
                    };
                    Some(Claimed(so, answer.text))
                };
                let Some(plain) = said(&plain) else { continue };
                tally.add(case.name, &line, said(&line), &plain);
            }
        }
    }
    tally.end(85);
}

/// A way that cannot go round what is to be left out is told so, with all names in it.
#[test]
fn a_way_that_goes_round_nothing_names_what_bars_it() {
    let (mut asked, mut barred) = (0, 0);
    for case in cases().into_iter().filter(|case| case.name.ends_with("en") || long()) {
        let world = case.engine.world().unwrap();
        let rooms: Vec<_> = world.areas.values().map(|area| &area.name_en).take(5).collect();
        for from in &rooms {
            for (to, without) in rooms.iter().zip(rooms.iter().skip(1)) {
                if from == to || from == without || to == without {
                    continue;
                }
                for line in [
                    format!("How far is it from {from} to {to} without going through {without}?"),
                    format!("How long does it take from {from} to {to} avoiding {without}?"),
                ] {
                    let told = case.engine.ask(&line, &mut Memory::default()).unwrap();
                    let Ok(told) = told else { continue };
                    let text = told.text;
                    asked += 1;
                    let lacks = [" .", " ,", "enter.", "through.", "  "];
                    assert!(!lacks.iter().any(|lack| text.contains(lack)), "{line}: {text}");
                    barred += usize::from(text.contains("only way"));
                }
            }
        }
    }
    assert!(asked > 5 && barred > 0, "{asked}, {barred}");
}

/// A question that begins with its word orders nothing, though nothing marks its end and a verb of orders stands in it.
#[test]
fn a_question_without_its_mark_orders_nothing() {
    let mut heard = 0;
    for case in cases().into_iter().filter(|case| case.name.starts_with("rb2") || long()) {
        let mut engine = case.engine;
        for (n, thing) in ["чашку", "книгу", "a cup", "the book"].iter().enumerate() {
            let lines = match n < 2 {
                true => [
                    format!("где взять {thing}"),
                    format!("ну а где мне тут {thing} взять"),
                    format!("я в коридоре, где поближе {thing} взять"),
                    format!("куда поставить {thing}"),
                ],
                false => [
                    format!("where can I take {thing}"),
                    format!("so where do I get {thing}"),
                    format!("I'm in the corridor, where can I grab {thing}"),
                    format!("where should I put {thing}"),
                ],
            };
            for line in lines {
                let mut dialogue = Dialogue::default();
                let told = dialogue.hear(&mut engine, &line, &mut |_, _| {}).unwrap();
                let orders = told
                    .replies
                    .iter()
                    .any(|reply| matches!(reply.outcome, Outcome::Task(_) | Outcome::Misheard(_)));
                assert!(!orders, "{line}: {}", told.text());
                heard += 1;
            }
        }
    }
    assert!(heard > 10, "{heard}");
}
