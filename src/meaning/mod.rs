//! Meaning: a sentence by grammar files to a typed logical form, and the form to a question in the rules' language.
//!
//! After issue 29. Words, phrases and frames stand in `rules/language`, a folder a language; nothing of a language stands
//! here. A sentence is cut into tokens (`words`), phrases are built bottom up with agreement and typed attachment
//! (`chart`), and a clause is the cheapest cover of *all* its words by the parts of one frame (`cover`). The form becomes
//! a Datalog question (`query`) that the caller runs: the rule shown is the rule that ran.
//!
//! # Invariants
//!
//! - Every word is accounted for: it stands in a part of the frame, or in the grammar's own list of words that say
//!   nothing. No text is rewritten into text.
//! - A phrase that the sorts of things forbid does not come about.
//! - Readings within [`MARGIN`] of the cheapest are all run; where their answers differ, there is no answer.
//! - No sentence and no grammar file makes it panic.

use orthoframe_facts as facts;
use orthoframe_language as language;
use orthoframe_map as map;
use orthoframe_semantics as semantics;
use orthoframe_units as units;

units::messages!("../../rules/messages", "meaning", fault::LangError);

mod answer;
mod chart;
mod check;
mod cover;
mod declared;
mod fault;
mod features;
mod file;
mod forms;
mod grammar;
mod near;
mod outcome;
mod paraphrase;
mod query;
mod read;
mod say;
mod sense;
mod term;
mod words;

pub use declared::words_beside;
pub use fault::{LangError, LangFault, LangFaults};
pub use features::Features;
pub use grammar::{Grammar, files};
pub use outcome::{Answer, Found, NoAnswer, Outcome, Reading};
pub use query::Rows;
pub use read::MARGIN;
pub use term::{Desc, Dimension, Form, Head, Measure, Mod, Quant, RoleId, Sorts};
pub use words::{Map, MapWords};
