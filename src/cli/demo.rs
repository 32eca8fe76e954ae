//! The main job, told as it goes: a task in words, planned, driven, reported, drawn.

use std::path::Path;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::engine::{
    Engine, Error, Memory, Progress, TaskAnswer, TaskEnding, TaskEvents, World, change_now,
    deeds_in_words, directive_in_words, name_in, surprise_in_words,
};
use crate::graphplan::Outcome;
use crate::language::Language;
use crate::language::command::{Command, in_time, is_order};
use crate::language::question::{Conditional, conditional};
use crate::map::Entity;
use crate::robot::Directive;
use crate::semantics::predicate;
use crate::strips::Scenario;
use crate::units::write_file;

use super::args::{Common, Lang};
use super::commands::{described, rules_dir};
use super::fault::Failure;
use super::text::decimal;
use super::{Answer, json, say, text};

/// What is said to "Stop" where nothing is under way, in both languages.
pub(super) const NOTHING_TO_STOP: [&str; 2] =
    ["Стою: ничего не выполняется.", "I stand still: nothing is under way."];

/// The map of the papers, for a program that was installed without its files.
const RB2: (&str, &str) = ("maps/rb2.toml", include_str!("../../maps/rb2.toml"));

pub(super) fn run(
    common: &Common,
    dir: Option<&Path>,
    map: Option<&Path>,
    task: &str,
    out: &Path,
) -> Result<Answer, Failure> {
    let scratch = Scratch::new().map_err(|e| Failure::file(&std::env::temp_dir(), &e))?;
    let map = match map {
        Some(path) => path.to_owned(),
        None => scratch.map()?,
    };
    let store = dir.or(common.store.as_deref()).unwrap_or(&scratch.store);
    let mut engine = Engine::open(store, rules_dir(common).as_deref())?;
    let imported = engine.import(&map, &change_now(&common.user, "demo"))?;
    if !common.json {
        let world = engine.world()?;
        say(&format!("{} {}", common.lang.pick("Карта", "Map"), described(world, common.lang)))?;
        say(&match common.lang {
            Lang::Ru => format!("Записана в хранилище, ревизия {}.\n", imported.report.revision),
            Lang::En => format!("Stored as revision {}.\n", imported.report.revision),
        })?;
        say(common.lang.pick("Выведено из геометрии:", "Derived from the geometry:"))?;
        say(&text::counts(engine.relations()?, common.lang))?;
        say("")?;
    }
    engine.reset_robot(&change_now(&common.user, "demo"))?;
    let answer = perform(common, &mut engine, task, None)?;
    let drawing = out.join("plan.svg");
    for drawn in super::draw::put_driven(common, &engine, &answer, &drawing)? {
        if !common.json {
            say(&format!("{} {}", common.lang.pick("Рисунок:", "Drawing:"), drawn.display()))?;
        }
    }
    Ok(match answer.ending {
        TaskEnding::Done | TaskEnding::AlreadyTrue => Answer::Yes,
        TaskEnding::NoPlan(_) | TaskEnding::Stuck(_) => Answer::No,
    })
}

/// Carries out a task, tells of it, and notes how it left the robot. `truth` is the world in which it drives, where that is
/// not the one that it believes in.
pub(super) fn perform(
    common: &Common,
    engine: &mut Engine,
    task: &str,
    mut truth: Option<&mut World>,
) -> Result<TaskAnswer, Failure> {
    let parts = match engine.parts_of(task)? {
        Some(parts) if parts.len() > 1 => {
            engine.read_ahead(&parts, &Memory::default())?;
            parts
        }
        _ => vec![task.to_owned()],
    };
    let mut memory = Memory::default();
    let (mut done, mut refused) = (None, false);
    for part in &parts {
        if parts.len() > 1 && !engine.is_command(part)? {
            // What is asked may speak of where the robot was sent.
            say(&match engine.ask(part, &mut memory)? {
                Ok(answer) if common.json => super::ask::view(engine, &answer)?.to_string(),
                Err(unanswered) if common.json => super::ask::doubt(&unanswered).to_string(),
                Ok(answer) => answer.text,
                Err(unanswered) => unanswered.text,
            })?;
            continue;
        }
        if refused {
            continue;
        }
        let answer = perform_order(common, engine, part, &mut memory, truth.as_deref_mut())?;
        remember(common, engine, &answer)?;
        let failed = matches!(answer.ending, TaskEnding::NoPlan(_) | TaskEnding::Stuck(_));
        done = Some(answer);
        // What was ordered behind it is not begun; what was asked is answered.
        refused |= failed;
    }
    match done {
        Some(answer) => Ok(answer),
        None => perform_order(common, engine, task, &mut memory, truth),
    }
}

/// Carries out a scenario, tells of it, and notes how it left the robot.
pub(super) fn perform_scenario(
    common: &Common,
    engine: &mut Engine,
    scenario: &Scenario,
    truth: Option<&mut World>,
) -> Result<TaskAnswer, Failure> {
    let answer = told(common, engine, |tell| engine.drive_scenario(scenario, truth, tell))?;
    remember(common, engine, &answer)?;
    Ok(answer)
}

/// A store that is only read keeps nothing.
fn remember(common: &Common, engine: &mut Engine, answer: &TaskAnswer) -> Result<(), Failure> {
    if !common.read_only && common.as_of.is_none() {
        engine.remember(answer, std::time::SystemTime::now().into())?;
    }
    Ok(())
}

/// Drives, and tells of it as it goes: in words, or an event a line; what it came to, last.
fn told(
    common: &Common,
    engine: &Engine,
    drive: impl FnOnce(&mut dyn FnMut(&Progress<'_>)) -> Result<TaskAnswer, Error>,
) -> Result<TaskAnswer, Failure> {
    let world = engine.world()?;
    if common.json {
        let mut events = TaskEvents::new(world);
        let answer = drive(&mut |progress| {
            let event = serde_json::to_string(&events.of(progress)).expect("an event is JSON");
            // A closed pipe is noticed by the command's last words.
            drop(say(&event));
        })?;
        say(&json::task(world, &answer).to_string())?;
        return Ok(answer);
    }
    let mut teller = Teller::new(world, common.lang);
    let answer = drive(&mut |progress| teller.tell(progress))?;
    teller.bar.finish_and_clear();
    say_ending(engine, &answer, common.lang)?;
    Ok(answer)
}

fn carry_out_in(
    engine: &Engine,
    commands: &[Command<Entity>],
    truth: Option<&mut World>,
    tell: &mut dyn FnMut(&Progress<'_>),
) -> Result<TaskAnswer, Error> {
    match truth {
        Some(truth) => engine.carry_out_in(commands, truth, tell),
        None => engine.carry_out(commands, tell),
    }
}

fn perform_order(
    common: &Common,
    engine: &Engine,
    order: &str,
    memory: &mut Memory,
    truth: Option<&mut World>,
) -> Result<TaskAnswer, Failure> {
    let in_order = in_time(order).filter(|order| is_order(order));
    let order = in_order.as_deref().unwrap_or(order);
    match conditional(order) {
        Some(conditional) => perform_if(common, engine, order, &conditional, memory, truth),
        None => perform_told(common, engine, order, memory, truth),
    }
}

/// Tells whether a condition holds, and does what is then to be done.
fn perform_if(
    common: &Common,
    engine: &Engine,
    task: &str,
    conditional: &Conditional,
    memory: &mut Memory,
    truth: Option<&mut World>,
) -> Result<TaskAnswer, Failure> {
    if !common.json
        && let Ok((holds, answer)) = engine.holds(conditional, &mut memory.clone())?
    {
        say(&answer.text)?;
        let order = if holds { &conditional.then } else { &conditional.otherwise };
        if order.is_none() && conditional.first.is_none() {
            say(conditional.undone())?;
            let commands = engine.understand_in(task, memory)?;
            return Ok(carry_out_in(engine, &commands, truth, &mut |_| {})?);
        }
    }
    perform_told(common, engine, task, memory, truth)
}

fn perform_told(
    common: &Common,
    engine: &Engine,
    task: &str,
    memory: &mut Memory,
    truth: Option<&mut World>,
) -> Result<TaskAnswer, Failure> {
    if !common.json {
        say(&match common.lang {
            Lang::Ru => format!("Задание: «{task}»"),
            Lang::En => format!("Task: \"{task}\""),
        })?;
    }
    let commands = engine.understand_in(task, memory)?;
    told(common, engine, |tell| carry_out_in(engine, &commands, truth, tell))
}

/// Carries out commands of a dialogue in the language that was spoken.
pub(super) fn carry_out(
    engine: &Engine,
    commands: &[Command<Entity>],
    lang: Lang,
) -> Result<TaskAnswer, Failure> {
    let world = engine.world()?;
    let mut teller = Teller::new(world, lang);
    let answer = engine.carry_out(commands, &mut |progress| teller.tell(progress))?;
    teller.bar.finish_and_clear();
    say_ending(engine, &answer, lang)?;
    Ok(answer)
}

/// Tells a run as it happens: reports on standard output, a bar on the terminal.
struct Teller<'w> {
    world: &'w World,
    lang: Lang,
    bar: ProgressBar,
}

impl<'w> Teller<'w> {
    fn new(world: &'w World, lang: Lang) -> Self {
        let bar = ProgressBar::new(0);
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len}  {wide_msg}")
            .expect("the template is a constant and sound");
        bar.set_style(style);
        Self { world, lang, bar }
    }

    fn tell(&mut self, progress: &Progress<'_>) {
        match progress {
            Progress::Planned(planned) => {
                if matches!(planned.solved.outcome, Outcome::Plan(_)) && !planned.steps.is_empty() {
                    let steps: Vec<Vec<String>> = planned
                        .steps
                        .iter()
                        .map(|step| step.iter().map(|d| self.directive(d)).collect())
                        .collect();
                    let language = self.lang.language();
                    let name = |name: &str| name_in(self.world, name, language);
                    let wording = planned.solved.wording(language, &name);
                    let plan = text::plan_of(&planned.solved, &steps, &wording);
                    self.line(&format!("{plan}\n"));
                }
                self.bar.set_length(planned.steps.iter().map(Vec::len).sum::<usize>() as u64);
                self.bar.set_position(0);
            }
            Progress::Started { directive, .. } => {
                self.bar.set_message(self.directive(directive));
                self.bar.tick();
            }
            Progress::Finished(report) => {
                self.bar.inc(1);
                let way = if report.points.is_empty() {
                    String::new()
                } else {
                    format!(
                        "{}, ",
                        decimal(report.length / 100.0, self.lang.pick("м", "m"), self.lang)
                    )
                };
                let time = decimal(report.seconds, self.lang.pick("с", "s"), self.lang);
                self.line(&format!(
                    "{:>4} {} – {way}{time}",
                    format!("{}.", report.number),
                    self.directive(&report.directive)
                ));
                let language = self.lang.language();
                for sentence in deeds_in_words(self.world, &report.directive, language) {
                    self.line(&format!("     {sentence}"));
                }
                if let Some(position) = &report.position {
                    self.line(&format!("     {}", position.say(self.lang.language())));
                }
            }
            Progress::Surprised { directive, surprise } => {
                let what = surprise_in_words(self.world, surprise, self.lang.language());
                self.line(&format!("   ! {}: {what}", self.directive(directive)));
                self.line(self.lang.pick("     Новый план.", "     Planning anew."));
            }
        }
    }

    /// As the paper prints it; in English, where its Russian names tell nothing, in words.
    fn directive(&self, directive: &Directive) -> String {
        match self.lang {
            Lang::Ru => directive.to_string(),
            Lang::En => directive_in_words(self.world, directive, Language::English),
        }
    }

    fn line(&self, line: &str) {
        // A closed pipe is noticed by the command's last words.
        self.bar.suspend(|| drop(say(line)));
    }
}

fn say_ending(engine: &Engine, answer: &TaskAnswer, lang: Lang) -> Result<(), Failure> {
    if let TaskEnding::NoPlan(planned) = &answer.ending
        && matches!(planned.solved.outcome, Outcome::NoPlan { .. })
    {
        // Where nothing leads at all, that is the reason; the rules would only say it in more words.
        let apart = engine.unconnected_in_words(answer, lang.language());
        if !apart.is_empty() {
            let head = lang.pick("Плана нет, и это доказано.", "There is no plan; this is proven.");
            return say(&format!("{head} {}", apart.join(" "))).map(|_| ());
        }
    }
    let mut told = vec![ending(engine.world()?, answer, lang)];
    let places = places_found(engine, answer, lang)?;
    // That a thing is found already says nothing more than where it is.
    let finds = answer.goal.iter().all(|goal| goal.predicate == predicate::FOUND);
    let is_so = matches!(answer.ending, TaskEnding::AlreadyTrue) && answer.left.is_empty();
    if is_so && finds && !places.is_empty() {
        told.clear();
    }
    told.extend(places);
    say(&told.join(" ")).map(|_| ())
}

/// Who asks to find a thing wants to know where it is.
fn places_found(engine: &Engine, answer: &TaskAnswer, lang: Lang) -> Result<Vec<String>, Failure> {
    let goals = answer.goal.iter().filter(|goal| goal.predicate == predicate::FOUND);
    let mut places = Vec::new();
    for name in goals.flat_map(|goal| goal.args.first()) {
        let shown = name_in(engine.world()?, name, lang.language());
        let question = match lang {
            Lang::Ru => format!("Где {name}?"),
            Lang::En => format!("Where is {shown}?"),
        };
        places.extend(engine.ask(&question, &mut Memory::default())?.ok().map(|found| found.text));
    }
    Ok(places)
}

fn ending(world: &World, answer: &TaskAnswer, lang: Lang) -> String {
    let length = answer.reports.iter().map(|r| r.length).sum::<f64>() / 100.0;
    let spent = format!(
        "{}, {}",
        decimal(length, lang.pick("м", "m"), lang),
        decimal(answer.seconds, lang.pick("с", "s"), lang)
    );
    let mut told = match &answer.ending {
        TaskEnding::Done => match lang {
            Lang::Ru => format!("\nСделано: {spent}."),
            Lang::En => format!("\nDone: {spent}."),
        },
        ending => unfinished(world, ending, answer, lang),
    };
    for (thing, sure) in &answer.unsure {
        let name = name_in(world, world.name(Entity::Replica(*thing)), lang.language());
        let percent = (sure * 100.0).round();
        told.push_str(&match lang {
            Lang::Ru => format!(
                "\nГде {name}, я не был уверен (уверенность {percent:.0} %), поэтому сначала искал."
            ),
            Lang::En => {
                format!(
                    "\nI was not sure where {name} was ({percent:.0}% sure), so I looked first."
                )
            }
        });
    }
    for (goal, ending) in &answer.left {
        let thing = goal.args.first().map(|name| name_in(world, name, lang.language()));
        let stays = lang.pick("осталось не на месте", "is not in its place");
        let why = unfinished(world, ending, answer, lang);
        told.push_str(&format!("\n{} {stays}. {why}", thing.unwrap_or_default()));
    }
    if answer.not_begun > 0 {
        let rest = "\nОстальное из этого задания не начато.";
        told.push_str(lang.pick(rest, "\nThe rest of this order was not begun."));
    }
    told
}

fn unfinished(world: &World, ending: &TaskEnding, answer: &TaskAnswer, lang: Lang) -> String {
    match ending {
        TaskEnding::Done | TaskEnding::AlreadyTrue => match &answer.reported {
            Some(position) => position.say(lang.language()),
            None if answer.stops => lang.pick(NOTHING_TO_STOP[0], NOTHING_TO_STOP[1]).to_owned(),
            None if answer.tidies => {
                let kept = "Всё уже на своих местах: там, где хранится или было на карте.";
                let english =
                    "Everything is in its place already: where it is kept, or was surveyed.";
                lang.pick(kept, english).to_owned()
            }
            None => lang.pick("Так уже и есть.", "It is so already.").to_owned(),
        },
        TaskEnding::NoPlan(planned) => {
            let name = |name: &str| name_in(world, name, lang.language());
            text::plan(&planned.solved, &planned.solved.wording(lang.language(), &name))
        }
        TaskEnding::Stuck(surprise) => {
            let what = surprise_in_words(world, surprise, lang.language());
            format!("{}: {what}.", lang.pick("Не выходит", "Stuck"))
        }
    }
}

/// A directory for the time of one run.
struct Scratch {
    dir: std::path::PathBuf,
    store: std::path::PathBuf,
}

impl Scratch {
    fn new() -> std::io::Result<Self> {
        let stamp = std::time::SystemTime::now()
            .duration_since(std::time::UNIX_EPOCH)
            .unwrap_or(Duration::ZERO);
        let name = format!("ortho-demo-{}-{}", std::process::id(), stamp.as_nanos());
        let dir = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&dir)?;
        Ok(Self { store: dir.join("store"), dir })
    }

    /// The papers' map: the file beside the program's sources, else the copy built in.
    fn map(&self) -> Result<std::path::PathBuf, Failure> {
        let file = Path::new(RB2.0);
        if file.is_file() {
            return Ok(file.to_owned());
        }
        let copy = self.dir.join("rb2.toml");
        write_file(&copy, RB2.1.as_bytes()).map_err(|e| Failure::file(&copy, &e))?;
        Ok(copy)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // A directory that cannot be removed is the system's to clean.
        let _ = std::fs::remove_dir_all(&self.dir);
    }
}
