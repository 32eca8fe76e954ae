//! What a dialogue replies and does, as it happens: on standard output, with a bar on the terminal; and to who looks on, a
//! recording or a file of the plan.

use std::io::BufRead;
use std::path::{Path, PathBuf};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};

use crate::engine::{
    Engine, Event, Outcome, Progress, Recording, Reply, TaskEvents, directive_in_words, json,
};
use crate::language::question::{Aside, aside};
use crate::robot::Answer;
use crate::units::{told, write_file};

use super::args::{Common, Lang};
use super::fault::Failure;
use super::{say, waiting};

/// Who else is told of a drive.
#[derive(Debug, Clone, Args)]
pub(super) struct RecordArgs {
    /// Record all that happens in this MCAP file, in place of what is there: for Foxglove, Lichtblick and ortho replay
    #[arg(long, value_name = "FILE.mcap")]
    pub record: Option<PathBuf>,
}

/// Tells a dialogue, or a task alone.
pub(super) struct Teller {
    json: bool,
    lang: Lang,
    /// A task given alone: its words stand above what is done, what is wrong with it is the command's fault, and of its
    /// condition programs learn by what was done.
    is_task: bool,
    /// Rule and proof are shown below each answer.
    pub(super) explains: bool,
    /// Somebody answers on standard input where something bars the way.
    is_attended: bool,
    bar: ProgressBar,
    events: TaskEvents,
    onlookers: Onlookers,
    /// Why no more could be told.
    failure: Option<Failure>,
}

impl Teller {
    pub(super) fn of_dialogue(common: &Common, onlookers: Onlookers) -> Self {
        Self::new(common, false, onlookers)
    }

    pub(super) fn of_task(common: &Common, onlookers: Onlookers) -> Self {
        Self::new(common, true, onlookers)
    }

    fn new(common: &Common, is_task: bool, onlookers: Onlookers) -> Self {
        let (json, lang) = (common.json, common.lang);
        let (bar, events) = (ProgressBar::hidden(), TaskEvents::default());
        Self {
            json,
            lang,
            is_task,
            explains: false,
            is_attended: false,
            bar,
            events,
            onlookers,
            failure: None,
        }
    }

    /// The same where somebody answers on standard input, or nobody does.
    pub(super) fn attended(self, is_attended: bool) -> Self {
        Self { is_attended, ..self }
    }

    /// # Errors
    /// Something could not be told.
    pub(super) fn end(&mut self) -> Result<(), Failure> {
        self.failure.take().map_or(Ok(()), Err)
    }

    /// Ends with what was recorded.
    ///
    /// # Errors
    /// Something could not be told, or not be recorded.
    pub(super) fn close(mut self) -> Result<(), Failure> {
        self.end().and(self.onlookers.end())
    }

    pub(super) fn tell(&mut self, engine: &Engine, event: &Event<'_>) {
        self.onlookers.tell(engine, event);
        if self.failure.is_none()
            && let Err(failure) = self.told(engine, event)
        {
            self.failure = Some(failure);
        }
        if let Event::Progress { progress: Progress::Barred { answer, .. }, .. } = event
            && self.is_attended
        {
            self.bar.suspend(|| answer.set(self.asked()));
        }
    }

    /// What whoever sits at the terminal says to a way that is barred: a line that means yes, or any other.
    fn asked(&self) -> Answer {
        if !self.json {
            let question = told!(self.lang.language(), "is-the-way-clear");
            drop(say(&question));
        }
        let mut line = Vec::new();
        let read = std::io::stdin().lock().read_until(b'\n', &mut line);
        match read {
            Ok(0) | Err(_) => Answer::Silence,
            Ok(_) if aside(String::from_utf8_lossy(&line).trim()) == Some(Aside::Yes) => {
                Answer::Clear
            }
            Ok(_) => Answer::GiveUp,
        }
    }

    fn told(&mut self, engine: &Engine, event: &Event<'_>) -> Result<(), Failure> {
        match event {
            Event::Progress { progress, world, .. }
                if self.json && (self.is_task || matches!(progress, Progress::Barred { .. })) =>
            {
                if let Some(event) = self.events.of(world, progress) {
                    // A closed pipe is noticed by the command's last words.
                    drop(say(&event.to_string()));
                }
                Ok(())
            }
            Event::Ordered(_) | Event::Progress { .. } if self.json => Ok(()),
            Event::Ordered(order) => {
                self.bar = bar();
                if self.is_task {
                    put(&told!(self.lang.language(), "task-quoted", order))?;
                }
                // A plan may be long in coming.
                waiting::begin(self.lang.language());
                Ok(())
            }
            Event::Progress { progress, world, language } => {
                for line in event.in_words() {
                    // A closed pipe is noticed by the command's last words.
                    self.bar.suspend(|| drop(say(&line)));
                }
                match progress {
                    Progress::Planned(planned) => {
                        let steps = planned.steps.iter().map(Vec::len).sum::<usize>();
                        self.bar.set_length(steps as u64);
                        self.bar.set_position(0);
                    }
                    Progress::Started { directive, .. } => {
                        self.bar.set_message(directive_in_words(world, directive, *language));
                        self.bar.tick();
                    }
                    Progress::Finished(_) => self.bar.inc(1),
                    Progress::Sent { .. }
                    | Progress::Moved(_)
                    | Progress::Scanned(_)
                    | Progress::Surprised { .. }
                    | Progress::Barred { .. } => {}
                }
                Ok(())
            }
            Event::Replied(reply) => {
                self.bar.finish_and_clear();
                self.replied(engine, reply)
            }
        }
    }

    fn replied(&self, engine: &Engine, reply: &Reply) -> Result<(), Failure> {
        match &reply.outcome {
            Outcome::Ended => Ok(()),
            Outcome::Misheard(_) | Outcome::Refused(_) if self.is_task => Ok(()),
            Outcome::Condition { .. } | Outcome::Begun { .. } if self.is_task && self.json => {
                Ok(())
            }
            Outcome::Begun { .. } if self.is_task => Ok(()),
            _ if self.json => put(&json::reply(engine, reply)?.to_string()),
            Outcome::Answered(answer) if self.explains => {
                put(&reply.text)?;
                put(&engine.explained(answer)?)
            }
            _ => put(&reply.text),
        }
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(0);
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len}  {wide_msg}")
        .expect("the template is a constant and sound");
    bar.set_style(style);
    bar
}

fn put(text: &str) -> Result<(), Failure> {
    say(text).map(|_| ())
}

impl RecordArgs {
    /// # Errors
    /// The file cannot be written.
    pub(super) fn begin(&self, engine: &Engine) -> Result<Onlookers, Failure> {
        let mut onlookers = Onlookers::default();
        if let Some(path) = &self.record {
            let mut recording = Recording::begin();
            recording.to_file(path, engine)?;
            onlookers.recording = Some(recording);
        }
        Ok(onlookers)
    }
}

/// Who is told of a drive beside the person at the terminal.
#[derive(Debug, Default)]
pub(super) struct Onlookers {
    recording: Option<Recording>,
    /// Where the first plan is to be written as a behaviour tree.
    tree: Option<PathBuf>,
    failure: Option<Failure>,
}

impl Onlookers {
    /// The same, and the first plan is written as a behaviour tree.
    pub(super) fn writing(self, tree: Option<&Path>) -> Self {
        Self { tree: tree.map(Path::to_owned), ..self }
    }

    pub(super) fn tell(&mut self, engine: &Engine, event: &Event<'_>) {
        if let Some(recording) = &mut self.recording {
            recording.tell(engine, event);
        }
        if let Event::Progress { progress: Progress::Planned(planned), .. } = event
            && let Some(path) = self.tree.take()
        {
            match engine.behaviour_tree(planned) {
                Ok(Some(text)) => {
                    let written = write_file(&path, text.as_bytes());
                    self.failure = written.err().map(|error| Failure::file(&path, &error));
                }
                // A later part of the order may have a plan.
                Ok(None) => self.tree = Some(path),
                Err(error) => self.failure = Some(error.into()),
            }
        }
    }

    /// # Errors
    /// Something could not be written.
    pub(super) fn end(&mut self) -> Result<(), Failure> {
        let recorded = self.recording.take().map_or(Ok(()), Recording::end);
        self.failure.take().map_or(Ok(()), Err).and(recorded.map_err(Failure::from))
    }
}
