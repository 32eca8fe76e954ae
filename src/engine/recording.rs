//! Recordings of missions: whoever hears a dialogue's events has them written, or shown as they happen.
//!
//! ```
//! use orthoframe::engine::{Dialogue, Recording};
//! use orthoframe::{Engine, World};
//! # let dir = tempfile::tempdir().unwrap();
//! # let file = dir.path().join("mission.mcap");
//! # let map = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/rb2.toml");
//! let mut engine = Engine::in_memory(World::load(map).unwrap(), None)?;
//! let mut recording = Recording::begin();
//! recording.to_file(&file, &engine)?;
//! Dialogue::default().hear(&mut engine, "Поезжай к Точке-К", &mut |engine, event| {
//!     recording.tell(engine, event);
//! })?;
//! recording.end()?;
//! assert!(Recording::read(&file)?.cut.is_none());
//! # Ok::<(), orthoframe::engine::Error>(())
//! ```

use std::collections::BTreeMap;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use serde_json::json;

use crate::exchange::to_map_file;
use crate::map::Format;
use crate::recording::{Level, Message, Played, RecordingError, Scribe, Sink, Tape, Turn};

use super::{Error, Event, Progress, Reply, State, TaskEvents};

/// Who speaks in the log: the robot, and whoever gives it orders.
const ROBOT: &str = "ortho";
const OPERATOR: &str = "operator";

/// What happens, told to those who record it or look on.
#[derive(Debug)]
pub struct Recording {
    scribe: Scribe,
    sinks: Vec<Box<dyn Sink>>,
    events: TaskEvents,
    /// Of the map that was told.
    revision: Option<u64>,
    /// The vehicle's clock against the recording's: nanoseconds to be added, once the task's first moment is known.
    offset: Option<f64>,
    /// When the directive under way was begun.
    begun: u64,
    failure: Option<RecordingError>,
}

fn now() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    u64::try_from(since.as_nanos()).unwrap_or(u64::MAX)
}

fn nanoseconds(seconds: f64) -> u64 {
    (seconds.max(0.0) * 1e9) as u64
}

impl Recording {
    /// Nothing was told yet, and nobody listens.
    #[must_use]
    pub fn begin() -> Self {
        Self {
            scribe: Scribe::new(now()),
            sinks: Vec::new(),
            events: TaskEvents::default(),
            revision: None,
            offset: None,
            begun: 0,
            failure: None,
        }
    }

    /// Begins an MCAP file, in place of what is there. It is readable up to the last event, or the last quarter of a
    /// second of a drive, whenever the program ends.
    ///
    /// # Errors
    /// There is no map, or the disk refused.
    pub fn to_file(&mut self, path: &Path, state: &State) -> Result<(), Error> {
        let world = state.world()?;
        let about = BTreeMap::from([
            ("version".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
            ("domain".to_owned(), world.domain.name.clone()),
            ("revision".to_owned(), state.revision().to_string()),
        ]);
        let map = to_map_file(world, Format::Toml);
        self.sinks.push(Box::new(Tape::create(path, &map, &about, self.scribe.now())?));
        Ok(())
    }

    /// Reads a recording.
    ///
    /// # Errors
    /// It cannot be read, is no MCAP, or has nothing of a mission.
    pub fn read(path: &Path) -> Result<Played, Error> {
        Ok(Played::read(path)?)
    }

    /// Tells what has just happened; to be called with every event of a dialogue, in order. Why something could not be
    /// kept is told by [`Recording::end`].
    pub fn tell(&mut self, state: &State, event: &Event<'_>) {
        if self.failure.is_some() {
            return;
        }
        let messages = self.messages(state, event);
        let is_on_the_way =
            |progress: &Progress<'_>| matches!(progress, Progress::Moved(_) | Progress::Scanned(_));
        let urgent = !matches!(event, Event::Progress { progress, .. } if is_on_the_way(progress));
        self.give(&messages, urgent);
    }

    fn give(&mut self, messages: &[Message], urgent: bool) {
        for sink in &mut self.sinks {
            if let Err(failure) = sink.take(messages, urgent) {
                self.failure.get_or_insert(failure);
            }
        }
    }

    /// Brings all to its end.
    ///
    /// # Errors
    /// Something could not be kept, since when nothing was.
    pub fn end(mut self) -> Result<(), Error> {
        for sink in &mut self.sinks {
            if let Err(failure) = sink.end() {
                self.failure.get_or_insert(failure);
            }
        }
        self.failure.map_or(Ok(()), |failure| Err(failure.into()))
    }

    fn messages(&mut self, state: &State, event: &Event<'_>) -> Vec<Message> {
        match event {
            Event::Ordered(order) => {
                self.scribe.reach(now());
                (self.events, self.offset) = (TaskEvents::default(), None);
                let mut messages = self.stand(state);
                let begun = json!({ "event": "task", "text": order });
                messages.push(self.scribe.event("/tasks", &begun));
                messages.push(self.scribe.words(Level::Info, OPERATOR, order));
                messages
            }
            Event::Progress { progress, world, .. } => {
                let mut messages = match self.revision {
                    // A scenario is driven without an order in words.
                    None => self.stand(state),
                    Some(_) => Vec::new(),
                };
                messages.extend(self.progress(state, progress));
                if let Some(told) = self.events.of(world, progress) {
                    let topic = match progress {
                        Progress::Surprised { .. } | Progress::Barred { .. } => "/surprises",
                        _ => "/directives",
                    };
                    messages.push(self.scribe.event(topic, &told));
                }
                let level = match progress {
                    Progress::Surprised { .. } | Progress::Barred { .. } => Level::Warning,
                    _ => Level::Info,
                };
                messages.extend(self.words(level, event));
                messages
            }
            Event::Replied(reply) => self.replied(state, event, reply),
        }
    }

    fn words(&self, level: Level, event: &Event<'_>) -> Vec<Message> {
        let texts = event.in_words();
        let texts = texts.iter().map(|text| text.trim()).filter(|text| !text.is_empty());
        texts.map(|text| self.scribe.words(level, ROBOT, text)).collect()
    }

    /// The building, what stands in it, and the robot, as they are known now.
    fn stand(&mut self, state: &State) -> Vec<Message> {
        let mut messages = Vec::new();
        if self.revision != Some(state.revision())
            && let (Ok(world), Ok(floors)) = (state.world(), state.floors())
        {
            messages.extend(self.scribe.building(world, floors.values()));
        }
        self.revision = Some(state.revision());
        messages.extend(self.things(state));
        if let Ok((map, pose)) = state.robot() {
            messages.extend(self.scribe.pose(map, pose));
        }
        messages
    }

    fn things(&mut self, state: &State) -> Vec<Message> {
        match (state.world_now(), state.floors()) {
            (Ok(world), Ok(floors)) => self.scribe.things(world, floors.values()),
            _ => Vec::new(),
        }
    }

    fn progress(&mut self, state: &State, progress: &Progress<'_>) -> Vec<Message> {
        match progress {
            Progress::Planned(_) | Progress::Surprised { .. } | Progress::Barred { .. } => {
                Vec::new()
            }
            Progress::Started { .. } => {
                self.begun = self.scribe.now();
                Vec::new()
            }
            Progress::Sent { map, way } => vec![self.scribe.path(*map, way)],
            Progress::Moved(moment) => {
                let now = self.scribe.now() as f64;
                let offset = *self.offset.get_or_insert(now - moment.time * 1e9);
                self.scribe.reach((offset + moment.time * 1e9).max(0.0) as u64);
                self.scribe.pose(moment.map, moment.pose)
            }
            Progress::Scanned(scan) => {
                let turn = Turn {
                    height: scan.height,
                    from: scan.from,
                    step: scan.step,
                    ranges: &scan.ranges,
                };
                vec![self.scribe.scan(&turn)]
            }
            Progress::Finished(report) => {
                self.scribe.reach(self.begun.saturating_add(nanoseconds(report.seconds)));
                let mut messages = self.scribe.pose(report.map, report.pose);
                messages.extend(self.things(state));
                messages
            }
        }
    }

    fn replied(&mut self, state: &State, event: &Event<'_>, reply: &Reply) -> Vec<Message> {
        let mut messages = self.things(state);
        if let super::Outcome::Task(task) = &reply.outcome {
            let metres: f64 = task.reports.iter().map(|report| report.length).sum::<f64>() / 100.0;
            messages.push(self.scribe.event(
                "/tasks",
                &json!({
                    "event": "task_ended", "outcome": reply.outcome.word(), "text": reply.text,
                    "length_m": (metres * 1000.0).round() / 1000.0,
                    "seconds": (task.seconds * 1000.0).round() / 1000.0, "replans": task.replans,
                }),
            ));
        }
        let level = if reply.outcome.has_failed() { Level::Error } else { Level::Info };
        messages.extend(self.words(level, event));
        messages
    }
}
