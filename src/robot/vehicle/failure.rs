//! [`Failure`]: a vehicle that can be asked nothing more, and what it did to be held so.

use crate::units::{Bilingual, Fault as _, Language, Pose};

/// Why a vehicle is of no more use. What it had done and told before stays known.
#[derive(Debug, Clone, PartialEq, crate::units::Fault)]
#[fault(vehicle)]
#[non_exhaustive]
pub enum Failure {
    /// There is no way to speak with it.
    NoConnection { address: String, why: String },

    /// The connection ended: the vehicle died, or the line was cut.
    Lost { asked: &'static str },

    /// It kept silent longer than the caller waits, or an order took longer than any may.
    TimedOut { asked: &'static str, seconds: f64 },

    /// It said what the protocol does not know.
    Rubbish { asked: &'static str, said: String, why: Bilingual },

    /// It speaks another version of the protocol.
    Version { theirs: u32, ours: u32 },

    /// It says that it is where it was not sent.
    OffTheWay { pose: Pose, off: f64 },

    /// It says that it faces another way than it was told to.
    WrongHeading { pose: Pose, off: f64 },

    /// It says that it is on another storey than it was sent to.
    WrongMap,

    /// It says that it is where there is no room.
    OffTheMap { pose: Pose },

    /// Its pose or its clock is no number, or its clock went back.
    NoNumber,

    /// It says itself that it can do no more.
    OwnFault { text: String },

    /// It does not know where it is.
    Nowhere { why: Bilingual },

    /// What it sees changes with each look, so that no plan lasts.
    Restless { times: usize },
}

impl Failure {
    /// What happened, in a language.
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        self.tell(language)
    }
}
