//! Other ways to ask, as the language files list them: those of the user's own, and of every line that is built in.

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::paraphrase::FILES as PARAPHRASES;
use orthoframe_language::question::{Answer, Doubt, Unanswered};

use crate::worlds::rb2;

/// The map with one language file of the user's own.
fn with_own(path: &str, text: &str) -> Result<Engine, String> {
    let rules = tempfile::tempdir().unwrap();
    let file = rules.path().join("language").join(path);
    std::fs::create_dir_all(file.parent().unwrap()).unwrap();
    std::fs::write(file, text).unwrap();
    let engine = Engine::in_memory(rb2(), Some(rules.path()));
    engine.map_err(|error| format!("{:?}", miette::Report::new(error)))
}

fn ask(engine: &Engine, question: &str) -> Result<Answer, Unanswered> {
    engine.ask(question, &mut Memory::default()).expect("there is a map")
}

/// «Где тусуется кот?» is «Где кот?» to whom the file says so, whatever is asked for.
#[test]
fn a_line_of_the_users_own_is_another_way_to_ask() {
    let own = "set Hangs = тусуется | тусуются\nsame где (Hangs) … = где …\n";
    let engine = with_own("ru/own.lang", own).unwrap();
    let mut asked = 0;
    for thing in ["Холодильник-1", "Шкаф-2", "лекарство", "белая кровать", "робот"]
    {
        let plain = ask(&engine, &format!("Где {thing}?"));
        let own = ask(&engine, &format!("Где тусуется {thing}?"));
        match (plain, own) {
            (Ok(plain), Ok(own)) => {
                assert_eq!((plain.text, plain.symbols), (own.text, own.symbols));
                asked += 1;
            }
            (plain, own) => assert_eq!(plain.is_ok(), own.is_ok(), "{thing}"),
        }
    }
    assert!(asked > 2);
    let without = Engine::in_memory(rb2(), None).unwrap();
    assert!(ask(&without, "Где тусуется Холодильник-1?").is_err());
}

/// "Whisk the medicine over" is "bring the medicine" to whom the file says so; without it no such order is heard.
#[test]
fn an_order_may_be_said_in_words_of_the_users_own() {
    let own = "set Whisk = whisk | conjure\nordered … (Whisk) X{clause} over … = … bring X …\n";
    let engine = with_own("en/own.lang", own).unwrap();
    let without = Engine::in_memory(rb2(), None).unwrap();
    let goal = |engine: &Engine, order: &str| {
        let copy = engine.perform(order, &mut |_| {});
        copy.ok().map(|answer| answer.goal)
    };
    let mut ordered = 0;
    for thing in ["the medicine", "Book 4"] {
        let plain = goal(&without, &format!("Bring {thing}"));
        for own in ["Whisk", "please conjure"] {
            let own = format!("{own} {thing} over");
            assert_eq!(goal(&engine, &own), plain, "{own}");
            assert_eq!(goal(&without, &own), None, "{own}");
            ordered += usize::from(plain.is_some());
        }
    }
    assert_eq!(ordered, 4);
    // What an order names is never lost: a gap that goes nowhere is a fault, with its place.
    let told = with_own("en/own.lang", "ordered whisk X over Y = bring X\n").expect_err("a fault");
    assert!(told.contains("own.lang:1:"), "{told}");
}

/// Every fault of a file is told, with its line and column; the languages that the program does not speak have none.
#[test]
fn the_faults_of_the_users_lines_have_their_places() {
    let own =
        "same где тусуется X = где Y\nsame … дома = дома …\nvoid ну\nsame V:(а | б) = V:(в)\n";
    let told = with_own("ru/own.lang", own).expect_err("there are faults");
    for place in ["own.lang:1:27", "own.lang:2:15", "own.lang:4:22"] {
        assert!(told.contains(place), "{place}: {told}");
    }
    let told = with_own("de/own.lang", "same wo steckt X = wo ist X\n").expect_err("a fault");
    assert!(told.contains("own.lang:1:1"), "{told}");
}

/// A file in the place of a built-in one stands for it.
#[test]
fn a_file_of_the_same_name_stands_for_the_one_built_in() {
    let engine = with_own("en/paraphrases.lang", "same whither is X = where is X?\n").unwrap();
    assert!(ask(&engine, "Whither is Refrigerator 1?").is_ok());
    let plain = Engine::in_memory(rb2(), None).unwrap();
    assert!(ask(&plain, "Whither is Refrigerator 1?").is_err());
}

/// A sentence that a line of the file puts plainly: of its choices the first or the last, its gaps filled.
struct Said<'l> {
    line: &'l str,
    /// What stands for each gap.
    fill: &'l [&'l str],
    last: bool,
}

/// The names of words that lines have in common.
type Sets = std::collections::BTreeMap<String, Vec<String>>;

impl Said<'_> {
    fn sentence(&self, sets: &Sets) -> String {
        let said = self.line.split_once('=').expect("a line has two sides").0;
        let mut words: Vec<String> = Vec::new();
        let mut gaps = 0;
        let mut rest = said.trim_start_matches("same").trim();
        while !rest.is_empty() {
            let name =
                rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_alphanumeric()).len();
            let is_named = rest.starts_with(|c: char| c.is_ascii_uppercase());
            let behind = if is_named { &rest[name..] } else { rest };
            let (chosen, after) = if is_named && !behind.starts_with(':') {
                let (options, after) = match behind.strip_prefix('{') {
                    Some(inner) => inner.split_once('}').expect("it closes"),
                    None => ("", behind),
                };
                let many = options.starts_with('0');
                gaps += usize::from(!many);
                let fill = self.fill[(gaps.max(1) - 1) % self.fill.len()];
                (if many { String::new() } else { fill.to_owned() }, after)
            } else {
                let behind = behind.trim_start_matches(':');
                let (choices, after) = match behind.strip_prefix('(') {
                    Some(inner) => inner.split_once(')').expect("it closes"),
                    None => behind.split_once(' ').unwrap_or((behind, "")),
                };
                let mut all: Vec<String> = Vec::new();
                for one in choices.split('|').map(str::trim) {
                    match sets.get(one) {
                        Some(set) => all.extend(set.iter().cloned()),
                        None => all.push(one.to_owned()),
                    }
                }
                let chosen = if self.last { all.last() } else { all.first() };
                let optional = after.starts_with('?') || choices.ends_with('?');
                let chosen = chosen.filter(|_| !optional).cloned().unwrap_or_default();
                (chosen.replace('*', "а").replace('…', ""), after.trim_start_matches('?'))
            };
            words.push(chosen);
            rest = after.trim_start();
        }
        words.retain(|word| !word.is_empty());
        format!("{}?", words.join(" "))
    }
}

/// What gaps are filled with: what is somewhere, where it is, and what is so.
const ENGLISH: &[&[&str]] = &[
    &["the table", "the bed", "the cup"],
    &["Room V", "the corridor", "a wardrobe"],
    &["Refrigerator 1", "tables", "beds"],
    &["a bed", "a table", "chairs"],
    &["chairs", "chairs", "tables"],
    &["the table is in Room V"],
    &["any chairs in Room V"],
    &["chairs or beds"],
    &["which table is", "table"],
    &["is there a bed", "a table"],
    &["Door VY"],
    &["which things", "things"],
    &["do you", "Room V", "Room Z"],
];
const RUSSIAN: &[&[&str]] = &[
    &["Шкаф-1", "Шкаф-2", "Кровать-1"],
    &["кровать", "стола", "стул"],
    &["стол", "стола", "стула"],
    &["стол в Комнате-В"],
    &["в Комнату-В"],
    &["Комната-В"],
    &["дверь"],
    &["лампу"],
    &["стульях", "стульях"],
    &["Холодильника-1", "Шкафа-1", "Шкафа-2"],
    &["Стол-1"],
];

/// Whole sentences of the file: with gaps filled by what is on a map, each line puts one that is read. Lines about orders are
/// gone over where it is known what each word does in an order: `language/command/kinds`.
#[test]
fn every_line_puts_a_sentence_that_is_read() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    let mut unread: Vec<String> = Vec::new();
    let mut read = 0;
    for (path, text) in &PARAPHRASES {
        let mut sets = Sets::new();
        let joined = text.replace("\n    ", " ");
        for line in joined.lines() {
            if let Some((name, words)) =
                line.strip_prefix("set ").and_then(|set| set.split_once('='))
            {
                let mut all: Vec<String> = Vec::new();
                for one in words.split('|').map(str::trim) {
                    match sets.get(one) {
                        Some(set) => all.extend(set.clone()),
                        None => all.push(one.to_owned()),
                    }
                }
                sets.insert(name.trim().to_owned(), all);
            }
            // What stands within a sentence has none of its own.
            let Some(said) = line.strip_prefix("same ").filter(|said| !said.starts_with('…'))
            else {
                continue;
            };
            let fillings = if path.starts_with("ru") { RUSSIAN } else { ENGLISH };
            // Some ask of what was told before, of one thing or of several.
            let firsts = match path.starts_with("ru") {
                true => ["Где Шкаф-1?", "Где шкафы?"],
                false => ["Where is Wardrobe 1?", "Where are the wardrobes?"],
            };
            let is_read = fillings.iter().any(|fill| {
                [false, true].into_iter().any(|last| {
                    let mut sentence = Said { line: said, fill, last }.sentence(&sets);
                    if said.split_once(" =").is_some_and(|(said, _)| said.ends_with('…')) {
                        sentence = format!("{} {}?", sentence.trim_end_matches('?'), fill[0]);
                    }
                    firsts.iter().any(|first| {
                        let mut memory = Memory::default();
                        let _ = engine.ask(first, &mut memory).expect("there is a map");
                        let answer = engine.ask(&sentence, &mut memory).expect("there is a map");
                        !matches!(
                            answer,
                            Err(Unanswered { doubt: Doubt::NotUnderstood { .. }, .. })
                        )
                    })
                })
            });
            if is_read {
                read += 1;
            } else {
                unread.push(format!("{path}: {said}"));
            }
        }
    }
    assert!(unread.is_empty(), "{}", unread.join("\n"));
    assert!(read > 50, "{read}");
}
