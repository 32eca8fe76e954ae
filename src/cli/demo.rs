//! The main job, told as it goes: a task in words, planned, driven, reported, drawn.

use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::engine::{
    Dialogue, Engine, Error, Event, Heard, Outcome, Progress, Reply, TaskAnswer, change_now,
};
#[cfg(feature = "serve")]
use crate::recording::{Played, RecordingError};
use crate::robot::Vehicle;
use crate::strips::Scenario;
use crate::units::{Carried, carried, told, word, write_file};

use super::args::Common;
use super::fault::Failure;
use super::opened::rules_dir;
use super::signals::stopped_by_signals;
use super::teller::{Onlookers, Teller};
use super::text::described;
use super::{Answer, came_to, say, text};

/// The map of the papers, for a program that was installed without its files.
static RB2: (&str, Carried) = ("maps/rb2.toml", carried!("../../maps/rb2.toml"));

pub(super) fn run(
    common: &Common,
    dir: Option<&Path>,
    map: Option<&Path>,
    task: Option<&str>,
    out: &Path,
) -> Result<Answer, Failure> {
    let usual = word!("bring-the-medicine").say(common.lang.language());
    let task = task.unwrap_or(&usual);
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
        say(&format!(
            "{} {}",
            told!(common.lang.language(), "map"),
            described(world, common.lang)
        ))?;
        say(&told!(common.lang.language(), "stored", revision = imported.report.revision))?;
        say(&told!(common.lang.language(), "derived-from-the-geometry"))?;
        say(&text::counts(engine.relations()?, common.lang))?;
        say("")?;
    }
    engine.reset_robot(&change_now(&common.user, "demo"))?;
    let dialogue = Dialogue::new(common.lang.language());
    let teller = Teller::of_task(common, Onlookers::default());
    let heard = perform(common, &mut engine, &Order::Now(task), dialogue, teller)?;
    let Some(answer) = heard.tasks().last() else { return Ok(Answer::Yes) };
    let drawing = out.join("plan.svg");
    for drawn in super::draw::put_driven(common, &engine, answer, &drawing)? {
        if !common.json {
            say(&format!("{} {}", told!(common.lang.language(), "drawing"), drawn.display()))?;
        }
    }
    Ok(came_to(answer))
}

/// What is to be done.
pub(super) enum Order<'t> {
    Now(&'t str),
    Later(&'t str),
    /// What waits.
    GoOn,
}

/// Carries out a task, tells of it, and notes how it left the robot. A signal stops it.
pub(super) fn perform(
    common: &Common,
    engine: &mut Engine,
    order: &Order<'_>,
    mut dialogue: Dialogue,
    mut teller: Teller,
) -> Result<Heard, Failure> {
    dialogue.stopped_by(stopped_by_signals());
    if common.read_only || common.as_of.is_some() {
        dialogue = dialogue.keeping_nothing();
    }
    let mut tell = |engine: &Engine, event: &Event<'_>| teller.tell(engine, event);
    let mut heard = match order {
        Order::Now(task) => dialogue.order(engine, task, &mut tell)?,
        Order::Later(task) => dialogue.later(engine, task, &mut tell)?,
        Order::GoOn => dialogue.go_on(engine, &mut tell)?,
    };
    teller.close()?;
    let failed =
        |reply: &Reply| matches!(reply.outcome, Outcome::Misheard(_) | Outcome::Refused(_));
    match heard.replies.iter().position(failed).map(|at| heard.replies.swap_remove(at).outcome) {
        Some(Outcome::Misheard(misheard)) => Err(Error::from(*misheard).into()),
        Some(Outcome::Refused(error)) => Err(Failure::Engine(error)),
        _ => Ok(heard),
    }
}

/// Carries out a scenario, tells of it, and notes how it left the robot. A signal stops it.
pub(super) fn perform_scenario(
    common: &Common,
    engine: &mut Engine,
    scenario: &Scenario,
    vehicle: &mut dyn Vehicle,
    mut teller: Teller,
) -> Result<TaskAnswer, Failure> {
    let language = common.lang.language();
    let (asked, world) = (&*engine, engine.world()?);
    let mut tell = |progress: &Progress<'_>| {
        teller.tell(asked, &Event::Progress { progress, world, language });
    };
    let answer = asked.drive_scenario(scenario, vehicle, &mut tell, &stopped_by_signals())?;
    let text = asked.ending_in_words(&answer, language)?;
    let reply = Reply { outcome: Outcome::Task(Box::new(answer)), text, language };
    teller.tell(asked, &Event::Replied(&reply));
    teller.close()?;
    let Outcome::Task(answer) = reply.outcome else { unreachable!("put there above") };
    if !common.read_only && common.as_of.is_none() {
        engine.remember(&answer, std::time::SystemTime::now().into())?;
    }
    Ok(*answer)
}

/// A directory for the time of one run.
pub(super) struct Scratch {
    dir: PathBuf,
    pub(super) store: PathBuf,
}

impl Scratch {
    pub(super) fn new() -> std::io::Result<Self> {
        let stamp = std::time::SystemTime::now()
            .duration_since(std::time::UNIX_EPOCH)
            .unwrap_or(Duration::ZERO);
        let name = format!("ortho-demo-{}-{}", std::process::id(), stamp.as_nanos());
        let dir = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&dir)?;
        Ok(Self { store: dir.join("store"), dir })
    }

    /// The papers' map: the file beside the program's sources, else the copy built in.
    pub(super) fn map(&self) -> Result<PathBuf, Failure> {
        let file = Path::new(RB2.0);
        if file.is_file() {
            return Ok(file.to_owned());
        }
        let copy = self.dir.join("rb2.toml");
        write_file(&copy, RB2.1.as_bytes()).map_err(|e| Failure::file(&copy, &e))?;
        Ok(copy)
    }

    /// The map with which a recording began.
    #[cfg(feature = "serve")]
    pub(super) fn map_of(&self, file: &Path, played: &Played) -> Result<PathBuf, Failure> {
        let Some(text) = &played.map else {
            let path = file.display().to_string();
            return Err(crate::engine::Error::from(RecordingError::Foreign { path }).into());
        };
        let copy = self.dir.join("map.toml");
        write_file(&copy, text.as_bytes()).map_err(|e| Failure::file(&copy, &e))?;
        Ok(copy)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // A directory that cannot be removed is the system's to clean.
        let _ = std::fs::remove_dir_all(&self.dir);
    }
}
