//! The new reading beside the old one: on every golden single question, and on sentences that were written from the data
//! of the maps before either was tried on them (`fresh/open.txt`, and `fresh/sealed.txt`, which nobody tunes on).

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use orthoframe_exchange::{Options, read};
use orthoframe_facts::{Computed, Limits, Value};
use orthoframe_language::Language;
use orthoframe_language::paraphrase::Paraphrases;
use orthoframe_language::question::{
    Answer as Old, Asker, Lexicon, Memory, Mind, News, Past, Said, Senses, Sighting, Thing,
    Unanswered, Way,
};
use orthoframe_language::report::Detail;
use orthoframe_map::World;
use orthoframe_meaning::{Answer, Form, Found, Grammar, Map, MapWords, NoAnswer, Outcome, files};
use orthoframe_semantics::{Around, RelationRules, Relations, derive, on_demand};
use orthoframe_units::{MapId, Pose, ReplicaId, Source};

/// A robot that sees nothing: what is asked of the map alone needs no more.
struct Blind;

impl Senses for Blind {
    fn robot(&self) -> Option<(MapId, Pose)> {
        None
    }
    fn position(&self, _: Language, _: Detail) -> Option<String> {
        None
    }
    fn way(&self, _: Option<Thing>, _: Thing, _: Language, _: Detail) -> Result<Way, String> {
        Err(String::new())
    }
    fn way_without(
        &self,
        _: Option<Thing>,
        _: Thing,
        _: &[Thing],
        _: Language,
    ) -> Result<Way, String> {
        Err(String::new())
    }
    fn beyond_arm(&self, _: ReplicaId) -> Option<f64> {
        None
    }
    fn visible(&self) -> Vec<ReplicaId> {
        Vec::new()
    }
    fn holder(&self, _: ReplicaId) -> Option<String> {
        None
    }
    fn carrier(&self, _: ReplicaId) -> Option<ReplicaId> {
        None
    }
    fn doubted(&self, _: ReplicaId) -> Option<f64> {
        None
    }
    fn held(&self) -> Vec<ReplicaId> {
        Vec::new()
    }
    fn sightings(&self, _: ReplicaId) -> Vec<Sighting> {
        Vec::new()
    }
    fn past(&self, _: ReplicaId) -> Vec<Past> {
        Vec::new()
    }
    fn changed(&self) -> Vec<News> {
        Vec::new()
    }
    fn unseen(&self) -> (Vec<ReplicaId>, usize) {
        (Vec::new(), 0)
    }
    fn sureness(&self, _: Language) -> Option<String> {
        None
    }
}

/// A map, derived, with both ways to read.
struct House {
    world: World,
    relations: Relations,
    mind: Mind,
    words: MapWords,
}

impl House {
    fn of(path: &Path) -> Self {
        let world = read(path, &Options::default()).expect("the map reads").world;
        let rules = RelationRules::standard();
        let relations = derive(&world, &rules, world.domain.profile).expect("the rules hold");
        let mind = Mind::of(&world, Paraphrases::built_in());
        let words = MapWords::of(&mind.lexicon);
        Self { world, relations, mind, words }
    }

    fn lexicon(&self) -> &Lexicon {
        &self.mind.lexicon
    }

    fn by_grammar(&self, grammar: &Grammar, text: &str) -> Outcome {
        let Self { world, relations, words, .. } = self;
        let map = Map { world, relations, lexicon: self.lexicon(), words };
        grammar.answer(&map, grammar.read(&map, text), &mut |question| self.rows(question))
    }

    fn by_the_old_way(&self, text: &str) -> Result<Old, Unanswered> {
        let Self { world, relations, mind, .. } = self;
        Asker { world, relations, mind, senses: &Blind }.ask(text, &mut Memory::default())
    }

    fn rows(&self, question: &str) -> Result<Vec<Vec<Value>>, String> {
        let around = Around::new(&self.world);
        let measured = on_demand(&around, &self.relations);
        let computed: Vec<&dyn Computed> =
            measured.iter().map(|one| one as &dyn Computed).collect();
        let source = Source::new("?", question);
        let answers = self.relations.derived().ask_with(&source, &computed, Limits::default());
        answers.map(|answers| answers.rows().to_vec()).map_err(|e| format!("{e}\n{question}"))
    }

    fn symbols(&self, body: &str) -> BTreeSet<String> {
        let rows = self.rows(&format!("?- a(X) :- {body}")).expect("the gold is a question");
        rows.into_iter().flatten().map(|value| value.to_string()).collect()
    }
}

/// The grammar as its files stand now.
fn grammar() -> Grammar {
    let read = |name| {
        Source::read(&root().join("rules/language").join(name)).expect("part of the project")
    };
    let files: Vec<(&str, Source)> = files().map(|(name, _)| (name, read(name))).collect();
    let (grammar, faults) = Grammar::of(&files);
    assert!(faults.is_none(), "{faults:#?}");
    grammar
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Houses by the path of their map; those of others are left out where the data is not there.
#[derive(Default)]
struct Houses(BTreeMap<String, Option<House>>);

impl Houses {
    fn at(&mut self, map: &str) -> Option<&House> {
        let place = self.0.entry(map.to_owned()).or_insert_with(|| {
            let path = root().join(map);
            let is_there = path.exists();
            assert!(is_there || std::env::var_os("CI").is_none(), "{map} is missing");
            is_there.then(|| House::of(&path))
        });
        place.as_ref()
    }
}

fn set(symbols: &[String]) -> BTreeSet<&str> {
    symbols.iter().map(String::as_str).collect()
}

/// What the new reading says, in one line.
fn told(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Answered(answer) | Outcome::Refused(answer) => {
            let (reading, rule) = (&answer.reading, answer.rules.last());
            let frame = reading.frame.rsplit('/').next().unwrap_or_default();
            format!(
                "{:?} [{} {frame}] {}",
                answer.found,
                reading.cost,
                rule.map_or("", String::as_str)
            )
        }
        Outcome::Several(all) => {
            let all = all.iter().map(|a| format!("{:?} [{}]", a.found, a.reading.frame));
            format!("several: {}", all.collect::<Vec<_>>().join(" / "))
        }
        Outcome::NotUnderstood => "not understood".to_owned(),
    }
}

/// Whether both come to the same.
fn agree(old: &Old, new: &Answer) -> bool {
    let Ok(found) = &new.found else { return false };
    match found {
        Found::Things(all) => set(&old.symbols) == set(all),
        // Whether there is none is told by yes and no in each language's own way.
        Found::Truth(yes) if matches!(new.reading.form, Form::None(_)) => old.is_so() == Some(*yes),
        // That there is such a one the old way may tell by naming it.
        Found::Truth(true) if old.said == Said::Found => true,
        Found::Truth(false) if old.said == Said::Nothing => true,
        Found::Truth(yes) => old.said == if *yes { Said::Yes } else { Said::No },
        Found::Number(number) => {
            old.number.map_or(old.said == Said::Nothing && *number == 0, |n| {
                (n - *number as f64).abs() < 0.5
            })
        }
        Found::Length(tenths) => {
            old.number.is_some_and(|cm| (cm - *tenths as f64 / 100.0).abs() < 1.0)
        }
        Found::Area(square) => {
            old.number.is_some_and(|own| (own - *square as f64).abs() < 1.0 + own / 1000.0)
        }
        Found::Places(all) => {
            let things: Vec<String> = all.iter().map(|place| place.thing.clone()).collect();
            set(&old.symbols) == set(&things)
        }
        Found::Values(values) => match new.reading.form {
            Form::Choice(..) => old.said != Said::Unknown,
            _ => old.facts.iter().any(|f| f.args.last().is_some_and(|v| values.contains(v))),
        },
        Found::Unknown => old.said == Said::Unknown,
    }
}

/// Both ways on the golden single questions. What the old way answers there was read by people.
#[test]
#[expect(clippy::print_stdout, reason = "the table is what one looks at")]
fn golden_questions_come_to_the_same() {
    let grammar = grammar();
    let (mut houses, mut counts) = (Houses::default(), BTreeMap::<&str, usize>::new());
    let (mut differ, mut gained, mut refused) = (Vec::new(), Vec::new(), Vec::new());
    let mut classes = BTreeMap::<String, [usize; 2]>::new();
    let mut cases: Vec<PathBuf> = std::fs::read_dir(root().join("tests/golden/talk"))
        .expect("part of the project")
        .map(|entry| entry.expect("it can be read").path())
        .collect();
    cases.sort();
    for case in cases {
        let text = |name: &str| std::fs::read_to_string(case.join(name)).expect("part of the case");
        let Some(house) = houses.at(text("map.txt").trim()) else { continue };
        let name = case.file_name().unwrap_or_default().to_string_lossy().into_owned();
        for line in text("questions.txt").lines().map(str::trim) {
            if line.is_empty() || line.starts_with(['#', '+']) {
                continue;
            }
            let (old, new) = (house.by_the_old_way(line), house.by_grammar(&grammar, line));
            let kind = match (&old, &new) {
                (Ok(old), Outcome::Answered(answer)) if agree(old, answer) => "same",
                (Ok(old), Outcome::Answered(_)) => {
                    differ.push(format!(
                        "{name}: {line}\n    old {}\n    new {}",
                        old.text,
                        told(&new)
                    ));
                    "differ"
                }
                (Err(old), Outcome::Answered(_)) => {
                    gained.push(format!(
                        "{name}: {line}\n    old {}\n    new {}",
                        old.text,
                        told(&new)
                    ));
                    "old refused"
                }
                (Ok(old), _) => {
                    refused.push(format!("{name}: {line}\n    {}\n    {}", old.text, told(&new)));
                    "new refused"
                }
                (Err(_), _) => "both refused",
            };
            *counts.entry(kind).or_default() += 1;
            if let Ok(old) = &old {
                // The kind of the old query, as its name says.
                let query = format!("{:?}", old.query);
                let end = query.find(|c: char| !c.is_alphanumeric()).unwrap_or(query.len());
                let class = classes.entry(query[..end].to_owned()).or_default();
                class[0] += usize::from(kind == "same");
                class[1] += 1;
            }
        }
    }
    println!("{counts:?}");
    let mut classes: Vec<_> = classes.into_iter().collect();
    classes.sort_by_key(|(_, [_, all])| std::cmp::Reverse(*all));
    classes.iter().for_each(|(class, [same, all])| println!("{class}: {same} of {all}"));
    println!("--- differ\n{}\n--- old refused\n{}", differ.join("\n"), gained.join("\n"));
    if std::env::var_os("SHADOW_REFUSED").is_some() {
        println!("--- new refused\n{}", refused.join("\n"));
    }
    let of = |kind: &str| counts.get(kind).copied().unwrap_or(0);
    assert_eq!(of("differ"), 0, "answers differ");
    let is_whole = houses.0.values().all(Option::is_some);
    assert!(!is_whole || of("same") >= LEAST_SAME, "{} answers are the same", of("same"));
}

/// Golden questions that the new way answers as the old one does; the number may only rise.
const LEAST_SAME: usize = 828;

/// How an answer fares against what the data say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Mark {
    Right,
    Wrong,
    Refused,
}

/// What both readings come to, as far as the gold can tell.
enum Given {
    Things(BTreeSet<String>),
    Truth(bool),
    Number(usize),
    Values(Vec<String>),
    Asked,
    /// Said to be nothing that one knows of.
    None,
    Refused,
}

fn given_by_new(outcome: &Outcome) -> Given {
    match outcome {
        Outcome::Answered(answer) => match answer.found.as_ref().expect("it was answered") {
            Found::Things(all) => Given::Things(all.iter().cloned().collect()),
            Found::Places(all) => Given::Things(all.iter().map(|p| p.thing.clone()).collect()),
            Found::Truth(yes) => Given::Truth(*yes),
            Found::Number(n) => Given::Number(*n),
            Found::Values(all) => Given::Values(all.clone()),
            Found::Unknown => Given::None,
            Found::Length(_) | Found::Area(_) => Given::Refused,
        },
        Outcome::Refused(answer) => match &answer.found {
            Err(NoAnswer::Ambiguous(_)) => Given::Asked,
            Err(NoAnswer::NoneSuch) => Given::None,
            _ => Given::Refused,
        },
        _ => Given::Refused,
    }
}

fn given_by_old(old: &Result<Old, Unanswered>, wants: &str) -> Given {
    match old {
        Err(unanswered) => match unanswered.doubt.kind() {
            "ambiguous" => Given::Asked,
            "unknown" => Given::None,
            _ => Given::Refused,
        },
        Ok(old) => match old.said {
            Said::Unknown => Given::None,
            Said::Yes if wants != "v" => Given::Truth(true),
            Said::No if wants != "v" => Given::Truth(false),
            _ if wants == "#" => {
                Given::Number(old.number.map_or(old.symbols.len(), |n| n as usize))
            }
            _ if wants == "v" => {
                let last = |fact: &orthoframe_language::question::Fact| fact.args.last().cloned();
                Given::Values(old.facts.iter().filter_map(last).collect())
            }
            Said::Nothing => Given::Things(BTreeSet::new()),
            _ => Given::Things(old.symbols.iter().cloned().collect()),
        },
    }
}

fn mark(given: &Given, gold: &str, house: &House) -> Mark {
    let (kind, rest) = gold.split_once(' ').unwrap_or((gold, ""));
    let named = || -> BTreeSet<String> {
        rest.split(',').map(|s| s.trim().to_owned()).filter(|s| s != "-").collect()
    };
    let right = match (kind, given) {
        (_, Given::Refused) => return Mark::Refused,
        ("ask", Given::Asked) | ("none", Given::None) => true,
        ("none", Given::Asked) | ("ask", Given::None) => return Mark::Refused,
        (_, Given::Asked | Given::None) => return Mark::Refused,
        ("yes", Given::Truth(yes)) => *yes,
        ("no", Given::Truth(yes)) => !*yes,
        ("#", Given::Number(n)) => rest.parse() == Ok(*n),
        ("#:", Given::Number(n)) => house.symbols(rest).len() == *n,
        ("=" | "@", Given::Things(all)) => named() == *all,
        ("=:", Given::Things(all)) => house.symbols(rest) == *all,
        // A choice is told by its place among those offered, which the old way does not give.
        ("v", Given::Values(all)) if rest.parse::<usize>().is_ok() => {
            all.iter().any(|v| v == rest) || all.iter().all(|v| v.parse::<usize>().is_err())
        }
        ("v", Given::Values(all)) => all.iter().any(|v| v == rest),
        _ => false,
    };
    if right { Mark::Right } else { Mark::Wrong }
}

#[expect(clippy::print_stdout, reason = "what went otherwise is what one looks at")]
fn fresh(file: &str, shows: bool) -> [BTreeMap<Mark, usize>; 2] {
    let grammar = grammar();
    let (mut houses, mut counts) = (Houses::default(), [BTreeMap::new(), BTreeMap::new()]);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fresh").join(file);
    for line in std::fs::read_to_string(path).expect("part of the crate").lines() {
        let parts: Vec<&str> = line.splitn(3, '|').map(str::trim).collect();
        let [map, question, gold] = parts[..] else { panic!("{line}") };
        let map = match map {
            "rb2" => "maps/rb2.toml",
            "h1" => "../shared/data/procthor/house_1.json",
            "h5" => "../shared/data/procthor/house_5.json",
            "cl" => "../shared/data/rmf/clinic.building.yaml",
            other => panic!("{other}"),
        };
        let Some(house) = houses.at(map) else { continue };
        let (old, new) = (house.by_the_old_way(question), house.by_grammar(&grammar, question));
        let wants = gold.get(..1).unwrap_or_default();
        let marks =
            [mark(&given_by_old(&old, wants), gold, house), mark(&given_by_new(&new), gold, house)];
        for (counts, mark) in counts.iter_mut().zip(marks) {
            *counts.entry(mark).or_insert(0) += 1;
        }
        if shows && marks != [Mark::Right, Mark::Right] {
            let old = old.map_or_else(|e| e.text, |a| a.text);
            println!(
                "{question}  ({gold})\n    old {:?}: {old}\n    new {:?}: {}",
                marks[0],
                marks[1],
                told(&new)
            );
        }
    }
    counts
}

#[test]
#[expect(clippy::print_stdout, reason = "the table is what one looks at")]
fn fresh_sentences_are_answered_rightly_or_not_at_all() {
    let sealed = fresh("sealed.txt", std::env::var_os("SHADOW_SEALED").is_some());
    let open = fresh("open.txt", true);
    println!("open:   old {:?}\n        new {:?}", open[0], open[1]);
    println!("sealed: old {:?}\n        new {:?}", sealed[0], sealed[1]);
    for new in [&open[1], &sealed[1]] {
        assert_eq!(new.get(&Mark::Wrong), None, "a wrong answer");
    }
}

/// A language is a folder: what no word of the program is German for is read by the files of `de`, and comes to what the
/// English question does.
#[test]
fn german_comes_to_what_english_does() {
    let (grammar, mut houses) = (grammar(), Houses::default());
    let house = houses.at("maps/rb2.toml").expect("part of the project");
    let found = |text: &str| match house.by_grammar(&grammar, text) {
        Outcome::Answered(answer) => Ok((answer.reading.tongue, answer.found)),
        other => Err(told(&other)),
    };
    for pair in include_str!("german.txt").lines().filter(|line| !line.is_empty()) {
        let (german, english) = pair.split_once(" | ").expect("two questions");
        let (own, theirs) = (found(german), found(english));
        match (own, theirs) {
            (Ok((de, own)), Ok((en, theirs))) => {
                assert_eq!((&*de, &*en, own), ("de", "en", theirs), "{german}");
            }
            other => panic!("{german}: {other:?}"),
        }
    }
    for unknown in ["Wo ist der Elefant?", "Ist die Vase nicht?", "Wo ist nicht die Vase?"] {
        assert!(found(unknown).is_err(), "{unknown}");
    }
}

/// A chain of prepositional phrases has exponentially many readings; the chart keeps few of them.
#[test]
#[expect(clippy::print_stdout, reason = "the time is worth seeing")]
fn long_and_odd_sentences_end() {
    let (grammar, mut houses) = (grammar(), Houses::default());
    let house = houses.at("maps/rb2.toml").expect("part of the project");
    let chain = format!("Где книга {}", "на столе в Комнате-В ".repeat(36));
    let english = format!("What is {}", "on the table in the room next to the chair ".repeat(15));
    let odd = [
        "",
        "?",
        "…",
        "«»",
        "'s",
        "что что что",
        "на на на на",
        "🤖 где 🤖",
        "a\u{301}'t",
        "1 2 3 4",
    ];
    for text in odd.into_iter().chain([chain.as_str(), &english, &"я".repeat(5_000)]) {
        let begun = std::time::Instant::now();
        let outcome = house.by_grammar(&grammar, text);
        assert!(!matches!(outcome, Outcome::Answered(_)), "{text}");
        println!("{} characters: {:?}", text.chars().count(), begun.elapsed());
    }
}
