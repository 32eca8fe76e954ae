//! One function a command.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::json;

use crate::engine::{
    Dialogue, Engine, Method, Outcome, Reply, Rules, Sighted, Truth, World, change_now,
    check_map_closely, opens_in_words, parse_pose, ride_in_words, uncertain_names,
};
use crate::language::report::Detail as Level;
use crate::language::{Case, Language, NounPhrase, english};
use crate::map::{EnglishMapErrors, MapErrors};
use crate::recording::Played;
use crate::robot::Vehicle;
use crate::strips::Scenario;

use super::args::{Common, Detail, DoArgs, Lang, Metric, RouteMethod};
use super::fault::{Failure, drawn};
use super::teller::Teller;
use super::{Answer, came_to, heeded, json, say, text};
use crate::units::Gather as _;

pub(super) const DEFAULT_STORE: &str = "ortho-store";

/// The store in force: the one named, or `./ortho-store`.
pub(super) fn store_dir(common: &Common) -> PathBuf {
    common.store.clone().unwrap_or_else(|| PathBuf::from(DEFAULT_STORE))
}

pub(super) fn rules_dir(common: &Common) -> Option<PathBuf> {
    common.rules.clone().or_else(Rules::default_dir)
}

/// Opens a store that is there already.
pub(super) fn open(common: &Common) -> Result<Engine, Failure> {
    let (dir, rules) = (store_dir(common), rules_dir(common));
    let engine = if common.read_only {
        Engine::open_read_only(&dir, rules.as_deref())?
    } else {
        Engine::open_existing(&dir, rules.as_deref())?
    };
    note_repairs(&engine, common.lang);
    Ok(match common.as_of {
        Some(when) => engine.as_of(when)?,
        None => engine,
    })
}

/// Opens a store that is to be changed: as it is now.
pub(super) fn open_to_write(common: &Common) -> Result<Engine, Failure> {
    if common.as_of.is_some() {
        return Err(crate::engine::RequestError::PastIsPast.into());
    }
    open(common)
}

#[expect(clippy::print_stderr, reason = "notes go to standard error")]
pub(super) fn note(text: &str) {
    super::waiting::over();
    eprintln!("{text}");
}

/// Notes where a recording was cut off, if it was.
pub(super) fn note_cut(common: &Common, played: &Played) {
    let Some(cut) = &played.cut else { return };
    let begun = played.told.first().map_or(0, |first| first.time);
    let (lasted, cut) = (seconds(played.end(), begun), cut.say(common.lang.language()));
    note(&match common.lang {
        Lang::Ru => format!("Запись обрывается на {lasted} с: {cut}."),
        Lang::En => format!("The recording breaks off after {lasted} s: {cut}."),
    });
}

/// Of a recording, to the millisecond.
pub(super) fn seconds(time: u64, begun: u64) -> f64 {
    (time.saturating_sub(begun) / 1_000_000) as f64 / 1000.0
}

pub(super) fn note_repairs(engine: &Engine, lang: Lang) {
    let opened = &engine.opened;
    let store = lang.pick("Хранилище", "The store");
    if opened.torn_bytes > 0 {
        let bytes = opened.torn_bytes;
        note(&match lang {
            Lang::Ru => format!(
                "{store}: последняя запись была прервана и не подтверждена; отброшено {bytes} байт."
            ),
            Lang::En => format!(
                "{store}: the last record was cut off and not confirmed; {bytes} bytes are dropped."
            ),
        });
    }
    let tables = lang
        .pick("таблицы построены заново по журналу", "the tables are built anew from the journal");
    let journal = lang
        .pick("журнал записан заново по таблицам", "the journal is written anew from the tables");
    let read = lang.pick(
        "прочитано по таблицам, потому что журнал неполон (открытие для записи восстановит его)",
        "read from the tables, since the journal is incomplete (opening to write mends it)",
    );
    let off = lang.pick(
        "таблицы не ведутся, всё остаётся в журнале и снимках",
        "the tables are not kept, everything stays in journal and snapshots",
    );
    let past = lang.pick(
        "файл прошлого был утрачен или испорчен и записан заново по второму",
        "a file of the past was lost or broken, and is written anew from its twin",
    );
    let shut = lang.pick("писать в него нельзя", "it cannot be written");
    for (what, why) in [
        (tables, &opened.tables_rebuilt),
        (journal, &opened.journal_renewed),
        (read, &opened.read_from_tables),
        (off, &opened.tables_off),
        (past, &opened.past_mended),
        (shut, &opened.not_writable),
    ] {
        if let Some(why) = why {
            note(&format!("{store}: {what}: {}.", why.say(lang.language())));
        }
    }
    for name in &opened.marks_renewed {
        let renewed = lang.pick("был утрачен или испорчен", "was lost or broken");
        note(&format!("{store}: {name} {renewed}."));
    }
}

pub(super) fn warn(warnings: &MapErrors, lang: Lang) {
    if warnings.faults.is_empty() {
        return;
    }
    note(
        match lang {
            Lang::Ru => drawn(warnings, Lang::Ru),
            Lang::En => drawn(&EnglishMapErrors::from(warnings), Lang::En),
        }
        .trim_end(),
    );
}

/// What of a log could not be read, beside what could.
pub(super) fn warn_of_lines(log: &Sighted, lang: Lang) {
    let Some(faults) = log.faults() else { return };
    let told = match lang {
        Lang::Ru => drawn(faults, Lang::Ru),
        Lang::En => drawn(&faults.in_english(), Lang::En),
    };
    note(told.trim_end());
}

/// Each warning with its place and remedy.
fn faults_view(warnings: &MapErrors, lang: Lang) -> serde_json::Value {
    match lang {
        _ if warnings.faults.is_empty() => json!([]),
        Lang::Ru => json!(json::faults(warnings)),
        Lang::En => json!(json::faults(&EnglishMapErrors::from(warnings))),
    }
}

pub(super) fn check(common: &Common, file: &Path, strict: bool) -> Result<Answer, Failure> {
    let (world, warnings) = check_map_closely(file, rules_dir(common).as_deref())?;
    if strict && !warnings.faults.is_empty() {
        return Err(warnings.into());
    }
    warn(&warnings, common.lang);
    let uncertain = uncertain_names(&world);
    if common.json {
        let names: Vec<_> = uncertain
            .iter()
            .map(|phrase| json!({"name": phrase.name(), "genitive": phrase.case(Case::Genitive)}))
            .collect();
        return say(&json!({
            "outcome": "sound", "warnings": warnings.faults.len(),
            "told": faults_view(&warnings, common.lang), "world": size(&world),
            "uncertain_names": names,
        })
        .to_string());
    }
    let sound = common.lang.pick("Карта исправна.", "The map is sound.");
    let mut lines = vec![format!("{sound} {}", described(&world, common.lang))];
    if !uncertain.is_empty() {
        lines.push(guessed(&uncertain, common.lang));
    }
    say(&lines.join("\n"))
}

/// How many names of uncertain forms are listed; the JSON has all.
const UNCERTAIN_SHOWN: usize = 20;

/// «Формы 2 имён угаданы …», each with its genitive, where a wrong guess shows.
fn guessed(uncertain: &[NounPhrase], lang: Lang) -> String {
    let shown: Vec<String> = uncertain
        .iter()
        .take(UNCERTAIN_SHOWN)
        .map(|phrase| {
            let of = lang.pick("нет", "genitive");
            format!("{} ({of} {})", phrase.name(), phrase.case(Case::Genitive))
        })
        .collect();
    let more = match uncertain.len().saturating_sub(UNCERTAIN_SHOWN) {
        0 => String::new(),
        more => format!(" {} {more}", lang.pick("и ещё", "and more:")),
    };
    let head = lang.pick(
        "Формы имён, угаданные по окончанию (карта может задать их полем forms; все формы: ortho words ИМЯ)",
        "Russian forms of names guessed by their endings (the map may give them in the field forms; all forms: ortho words NAME)",
    );
    format!("{head}: {}{more}.", shown.join(", "))
}

pub(super) fn size(world: &World) -> serde_json::Value {
    json!({
        "maps": world.maps.len(),
        "areas": world.areas.len(),
        "doors": world.doors.len(),
        "objects": world.objects.len(),
        "orthoframes": world.orthoframes.len(),
        "replicas": world.replicas.len(),
        "places": world.places.len(),
    })
}

/// «Дом РБ-2»: карт 1, помещений 4 …
pub(super) fn described(world: &World, lang: Lang) -> String {
    let [maps, areas, doors] = [world.maps.len(), world.areas.len(), world.doors.len()];
    let [replicas, objects] = [world.replicas.len(), world.objects.len()];
    let [orthoframes, places] = [world.orthoframes.len(), world.places.len()];
    let domain = &world.domain;
    match lang {
        Lang::Ru => format!(
            "«{}»: карт {maps}, помещений {areas}, дверей и проходов {doors}, экземпляров {replicas} (объектов {objects}, ортофреймов {orthoframes}), точек {places}.",
            domain.name
        ),
        Lang::En => {
            let count = |number: usize, noun| english::count(number as u64, noun);
            format!(
                "“{}”: {}, {}, {} (passages among them), {} ({}, {}), {}.",
                if domain.name_en.is_empty() { &domain.name } else { &domain.name_en },
                count(maps, "map"),
                count(areas, "room"),
                count(doors, "door"),
                count(replicas, "thing"),
                count(objects, "object"),
                count(orthoframes, "Orthoframe"),
                count(places, "place"),
            )
        }
    }
}

pub(super) fn relations(
    common: &Common,
    name: Option<&str>,
    of: Option<&str>,
) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let relations = engine.relations()?;
    if name.is_none() && of.is_none() {
        return if common.json {
            say(&json::counts(relations).to_string())
        } else {
            say(&text::counts(relations, common.lang))
        };
    }
    if common.json {
        return say(&json::facts(&engine, name, of, Language::Russian)?.to_string());
    }
    let rows = engine.facts(name, of)?;
    if rows.is_empty() {
        return say(common.lang.pick("Таких фактов нет.", "There are no such facts."));
    }
    say(&text::facts(&match common.lang {
        Lang::Ru => rows,
        Lang::En => {
            let named = relations.counts().into_iter().filter(|row| !row.name_en.is_empty());
            let names: BTreeMap<String, String> = named.map(|row| (row.name, row.name_en)).gather();
            let called = |relation: String| names.get(&relation).cloned().unwrap_or(relation);
            rows.into_iter().map(|(relation, values)| (called(relation), values)).collect()
        }
    }))
}

pub(super) fn perform(common: &Common, args: &DoArgs) -> Result<Answer, Failure> {
    let scenario = args.scenario.as_deref().map(Scenario::read).transpose()?;
    let mut engine = match scenario.as_ref().map(|scenario| &scenario.map) {
        Some(map) => super::plan::engine_for(common, map.as_deref())?,
        None => open(common)?,
    };
    if args.reset {
        engine.reset_robot(&change_now(&common.user, "do --reset"))?;
    }
    if let Some(from) = &args.from {
        engine.place_robot(from, &change_now(&common.user, "do --from"))?;
    }
    if args.metric == Some(Metric::Time) {
        engine.plan_in_time();
    }
    super::plan::warn(&engine.rules().warnings, common.lang);
    if let Some(scenario) = &scenario {
        super::plan::warn(&scenario.warnings, common.lang);
    }
    let truth = args.truth.as_deref().map(|file| truth(common, &engine, file)).transpose()?;
    if let Some(scenario) = &scenario {
        let mut robot: Box<dyn Vehicle> =
            match args.vehicle.connect(engine.world()?, args.truth.as_deref())? {
                Some(robot) => Box::new(robot),
                None => match args.vehicle.senses() {
                    Some(senses) => Box::new(engine.sensing_robot(truth, senses)?),
                    None => Box::new(engine.simulator(truth)?),
                },
            };
        let teller = teller(common, args, &engine)?;
        let answer =
            super::demo::perform_scenario(common, &mut engine, scenario, &mut *robot, teller)?;
        if let Some(path) = &args.draw {
            super::draw::put_driven(common, &engine, &answer, path)?;
        }
        return Ok(came_to(&answer));
    }
    let task = args.task.as_deref().unwrap_or_default();
    let mut dialogue = Dialogue::new(common.lang.language());
    if let Some(senses) = args.vehicle.senses() {
        dialogue = dialogue.driving(Box::new(engine.sensing_robot(truth, senses)?));
    } else if let Some(truth) = truth {
        dialogue = dialogue.in_truth(truth);
    }
    if let Some(robot) = args.vehicle.connect(engine.world()?, args.truth.as_deref())? {
        dialogue = dialogue.driving(Box::new(robot));
    }
    let order = match (args.resume, args.later) {
        (true, _) => super::demo::Order::GoOn,
        (_, true) => super::demo::Order::Later(task),
        _ => super::demo::Order::Now(task),
    };
    let teller = teller(common, args, &engine)?;
    let heard = super::demo::perform(common, &mut engine, &order, dialogue, teller)?;
    if let (Some(path), Some(answer)) = (&args.draw, heard.tasks().last()) {
        super::draw::put_driven(common, &engine, answer, path)?;
    }
    let is_task = |reply: &&Reply| matches!(reply.outcome, Outcome::Task(_));
    let last = heard.replies.iter().rfind(is_task).or(heard.replies.last());
    Ok(last.map_or(Answer::Yes, |reply| heeded(&reply.outcome)))
}

fn teller(common: &Common, args: &DoArgs, engine: &Engine) -> Result<Teller, Failure> {
    let onlookers = args.record.begin(engine)?.writing(args.tree.as_deref());
    Ok(Teller::of_task(common, onlookers).attended(args.attended))
}

/// The world of `--truth`; what stayed behind in it is told beside.
fn truth(common: &Common, engine: &Engine, file: &Path) -> Result<World, Failure> {
    let Truth { world, left_behind } = engine.read_truth(file)?;
    if !left_behind.is_empty() {
        let names = left_behind.join(", ");
        note(&match common.lang {
            Lang::Ru => format!(
                "--truth: остаётся на прежнем месте, хотя опора уходит: {names}; carry = true перенесёт и это."
            ),
            Lang::En => format!(
                "--truth: stays behind, though what bears it goes: {names}; carry = true takes it along."
            ),
        });
    }
    Ok(world)
}

pub(super) fn export_rules(common: &Common, dir: &Path, force: bool) -> Result<Answer, Failure> {
    let written: Vec<String> = crate::engine::export_rules(dir, force)?
        .into_iter()
        .map(|path| path.display().to_string())
        .collect();
    if common.json {
        return say(&json!({"outcome": "done", "written": written}).to_string());
    }
    say(&written.join("\n"))
}

/// Puts rule files into the usual form and names those that changed.
pub(super) fn format_rules(common: &Common, files: &[PathBuf]) -> Result<Answer, Failure> {
    const MAX_BYTES: u64 = 16 << 20;
    let fault = |path: &Path, cause: std::io::Error| {
        let error = crate::facts::FilesError::File { path: path.to_owned(), cause };
        Failure::from(crate::engine::Error::from(Box::new(error)))
    };
    let mut changed = Vec::new();
    for path in files {
        let text = crate::units::read_text(path, MAX_BYTES)
            .map_err(|error| fault(path, error.into_io()))?;
        let formatted = crate::facts::format_rules(&text);
        if formatted != text {
            crate::units::write_file(path, formatted.as_bytes())
                .map_err(|cause| fault(path, cause))?;
            changed.push(path.display().to_string());
        }
    }
    if common.json {
        return say(&json!({"outcome": "done", "changed": changed}).to_string());
    }
    say(&changed.join("\n"))
}

pub(super) fn route(
    common: &Common,
    from: &str,
    to: &str,
    method: RouteMethod,
    words: Option<Detail>,
) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let method = match method {
        RouteMethod::Shortest => Method::Shortest,
        RouteMethod::Paper => Method::Paper,
    };
    let journey = engine.journey(from, to, method)?;
    let world = engine.world_now()?;
    let found = journey.legs.iter().all(|leg| leg.route.is_ok());
    let language = common.lang.language();
    if common.json {
        let mut view = json::journey(world, &journey, language);
        if let Some(detail) = words.filter(|_| found) {
            view["words"] =
                json!(engine.journey_in_words(&journey, None, language, detail.level())?);
        }
        say(&view.to_string())?;
    } else if let Some(detail) = words.filter(|_| found) {
        say(&engine.journey_in_words(&journey, None, language, detail.level())?.join("\n"))?;
    } else {
        let mut parts = Vec::new();
        for (k, leg) in journey.legs.iter().enumerate() {
            parts.push(text::route(world, engine.floor(leg.map)?, leg, common));
            parts.extend(journey.rides.get(k).map(|r| ride_in_words(world, r, language)));
        }
        let opens = opens_in_words(world, &journey.opens, language);
        parts.extend(Some(opens).filter(|told| !told.is_empty()));
        let head = common.lang.pick("Чтобы открыть путь:", "To open a way:");
        let advice = journey.advice.as_ref().map(|a| a.in_words(world, language));
        parts.extend(advice.map(|a| format!("{head} {a}.")));
        say(&parts.join("\n"))?;
    }
    Ok(if found { Answer::Yes } else { Answer::No })
}

pub(super) fn locate(
    common: &Common,
    map: Option<&str>,
    at: Option<&str>,
    detail: Option<Detail>,
) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let (map, pose, facing) = match at {
        Some(at) => (engine.map_named(map)?, parse_pose(at)?, at.split(',').count() == 3),
        None => {
            let (map, pose) = engine.robot()?;
            (map, pose, true)
        }
    };
    let level = detail.map(Detail::level);
    let facing = level.map_or(facing, |level| level == Level::Heading);
    let found = engine.locate(map, pose, facing)?;
    if common.json {
        return say(&json::whereabout(engine.world()?, &found).to_string());
    }
    let language = common.lang.language();
    say(&match level {
        Some(level) => found.position.say_in(language, level),
        None => found.position.say(language),
    })
}

pub(super) fn datalog(
    common: &Common,
    program: &Path,
    facts: &Path,
    output: &Path,
    limits: crate::facts::Limits,
    explain: bool,
) -> Result<Answer, Failure> {
    let run = if explain { crate::facts::run_files_traced } else { crate::facts::run_files };
    let report =
        run(program, facts, output, limits).map_err(|e| crate::engine::Error::from(Box::new(e)))?;
    for warning in &report.warnings {
        note(
            match common.lang {
                Lang::Ru => drawn(warning, Lang::Ru),
                Lang::En => drawn(&warning.in_english(), Lang::En),
            }
            .trim_end(),
        );
    }
    for line in &report.traced {
        note(&line.say(common.lang.language()));
    }
    if common.json {
        let sizes: Vec<_> =
            report.sizes.iter().map(|(name, n)| json!({"relation": name, "tuples": n})).collect();
        let mut view = json!({
            "outcome": "done", "sizes": sizes, "written": report.written, "printed": report.printed,
        });
        if explain {
            let language = common.lang.language();
            let rule = |line: &crate::facts::RuleTrace| {
                let joins: Vec<_> = line.joins.iter().map(|join| join.say(language)).collect();
                json!({
                    "place": line.place, "relation": line.relation, "joins": joins,
                    "runs": line.runs, "found": line.found, "ms": line.time.as_secs_f64() * 1000.0,
                })
            };
            view["rules"] = report.traced.iter().map(rule).collect();
        }
        return say(&view.to_string());
    }
    let printed = report.printed.trim_end();
    let lines: Vec<String> = (!printed.is_empty())
        .then(|| printed.to_owned())
        .into_iter()
        .chain(report.sizes.iter().map(|(name, n)| format!("{name}\t{n}")))
        .chain(report.written.iter().map(|path| path.display().to_string()))
        .collect();
    say(&lines.join("\n"))
}
