//! What comes of a sentence: what it may mean, and what that came to.

use super::term::Form;

/// What a sentence may mean.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reading {
    pub form: Form,
    /// What was passed over, in an unusual order or said loosely; 0 where nothing was.
    pub cost: u32,
    /// File and line of the frame that read it.
    pub frame: String,
    /// The folder of the language in which it was read.
    pub tongue: String,
}

/// What was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Found {
    /// The symbols of all that fits, sorted.
    Things(Vec<String>),
    /// Whether it is so.
    Truth(bool),
    /// Where each thing is.
    Places(Vec<Place>),
    Number(usize),
    /// In tenths of a millimetre.
    Length(i64),
    /// In cm².
    Area(i64),
    /// As the map writes them.
    Values(Vec<String>),
    /// The map does not tell.
    Unknown,
}

/// Where a thing is.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    pub thing: String,
    /// What it lies on or in and its room; the rooms that a door joins; the storey of a room.
    pub at: Vec<String>,
}

/// Why a form comes to nothing.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoAnswer {
    /// Nothing fits a description where one thing is meant.
    NoneSuch,
    /// Several do.
    Ambiguous(Vec<String>),
    /// It is understood, and no relation tells it.
    Unfit(&'static str),
    /// The rules refused the question.
    Failed(String),
}

/// An answer, with what was read and what was run.
#[derive(Debug, Clone)]
pub struct Answer {
    pub reading: Reading,
    /// The questions that ran, in the rules' language; the last is the sentence's own.
    pub rules: Vec<String>,
    pub found: Result<Found, NoAnswer>,
}

/// What comes of a sentence.
#[derive(Debug, Clone)]
pub enum Outcome {
    Answered(Box<Answer>),
    /// Read in one way, and there is no answer.
    Refused(Box<Answer>),
    /// Read in several ways that come to different things.
    Several(Vec<Answer>),
    NotUnderstood,
}
