//! What a dialogue answers: data first, then the words.

use crate::language::Language;
use crate::language::command::Misheard;
use crate::language::question::{Answer, Unanswered};
use crate::map::World;

use crate::engine::{Error, Progress, Queue, TaskAnswer};

/// What came of a line, in the order in which it was heeded.
#[derive(Debug, Default)]
pub struct Heard {
    pub replies: Vec<Reply>,
}

impl Heard {
    /// Whether the line ended the dialogue.
    #[must_use]
    pub fn ended(&self) -> bool {
        self.replies.iter().any(|reply| matches!(reply.outcome, Outcome::Ended))
    }

    /// The tasks that were carried out, or shown impossible.
    pub fn tasks(&self) -> impl Iterator<Item = &TaskAnswer> {
        self.replies.iter().filter_map(|reply| match &reply.outcome {
            Outcome::Task(task) => Some(&**task),
            _ => None,
        })
    }

    /// All that is told, a reply a line.
    #[must_use]
    pub fn text(&self) -> String {
        let told = self.replies.iter().map(|reply| reply.text.as_str());
        told.filter(|text| !text.is_empty()).collect::<Vec<_>>().join("\n")
    }
}

/// One outcome, with what is told of it.
#[derive(Debug)]
pub struct Reply {
    pub outcome: Outcome,
    /// In [`Self::language`]; of a task, how it ended: its steps are told as they happen.
    pub text: String,
    pub language: Language,
}

/// What a part of a line came to.
#[derive(Debug)]
pub enum Outcome {
    /// A question was answered.
    Answered(Box<Answer>),
    /// A question, or a condition, that has no answer, and why.
    Unanswered(Box<Unanswered>),
    /// Whether a condition holds, with the answer that says so.
    Condition { holds: bool, answer: Box<Answer> },
    /// Why the line before was not carried out.
    Reason,
    /// A verb was mistyped: the order with the one that is likely meant waits for a yes.
    Offered { order: String },
    /// An order that was not understood.
    Misheard(Box<Misheard>),
    /// An order that was understood and cannot be begun: the map lacks what it needs.
    Refused(Box<Error>),
    /// A task was carried out, or shown impossible.
    Task(Box<TaskAnswer>),
    /// An order behind one that failed.
    NotBegun { order: String },
    /// What waited for an answer was dropped, if anything waited.
    Stopped { waited: bool },
    /// An order waits, by its number.
    Queued { task: u32 },
    /// One that waited is begun.
    Begun { task: u32 },
    /// What waits.
    Waits(Queue),
    /// Nothing more is begun.
    Paused,
    /// Of those that waited these do no longer.
    Cancelled { tasks: Vec<u32> },
    /// Nothing is to be done now.
    Waiting,
    /// It was told to come back from where it was never sent.
    NeverLeft,
    /// The robot said where it is.
    Reported,
    /// What says yes or no, where nothing was offered.
    NothingOffered,
    /// The dialogue is over.
    Ended,
}

impl Outcome {
    /// A stable word for programs.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Answered(answer) => answer.said.word(),
            Self::Unanswered(unanswered) => unanswered.doubt.kind(),
            Self::Condition { .. } | Self::Reason => "found",
            Self::Offered { .. } | Self::NothingOffered => "not_understood",
            Self::Misheard(_) => "misheard",
            Self::Refused(_) | Self::NeverLeft => "refused",
            Self::Task(task) => task.word(),
            Self::NotBegun { .. } => "not_begun",
            Self::Stopped { .. } => "stopped",
            Self::Queued { .. } => "queued",
            Self::Begun { .. } => "begun",
            Self::Waits(_) => "queue",
            Self::Paused => "paused",
            Self::Cancelled { .. } => "cancelled",
            Self::Waiting => "waiting",
            Self::Reported => "reported",
            Self::Ended => "ended",
        }
    }

    /// An order that was not done: what was ordered behind it is not begun.
    #[must_use]
    pub fn has_failed(&self) -> bool {
        match self {
            Self::Misheard(_) | Self::Refused(_) | Self::NeverLeft => true,
            Self::Task(task) => !task.ending.is_done(),
            _ => false,
        }
    }
}

/// What happens while a line is heeded.
#[derive(Debug)]
pub enum Event<'a> {
    /// An order is taken up, in these words.
    Ordered(&'a str),
    /// A task is under way.
    Progress { progress: &'a Progress<'a>, world: &'a World, language: Language },
    /// A part of the line is done with; [`Heard`] will have this reply.
    Replied(&'a Reply),
}

impl Event<'_> {
    /// What is told of it, a text each; nothing for an order, which the speaker knows.
    #[must_use]
    pub fn in_words(&self) -> Vec<String> {
        match self {
            Self::Ordered(_) => Vec::new(),
            Self::Progress { progress, world, language } => progress.in_words(world, *language),
            Self::Replied(reply) => vec![reply.text.clone()],
        }
    }
}
