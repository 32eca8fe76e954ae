//! Talk: names in all their forms, position reports and commands, in Russian and English.
//!
//! After the source paper 1, sections 5 and 8. The folder turns values into sentences and sentences into values; it
//! holds no map. Invariant: no text from outside makes it panic, and it never guesses between two names.
//!
//! ```
//! use orthoframe::language::{NounPhrase, WordHints, russian};
//! let room = NounPhrase::parse("Комната-В", &WordHints::default());
//! assert_eq!(format!("{} – {}", russian::whence(&room), russian::whither(&room)), "из Комнаты-В – в Комнату-В");
//! ```

pub mod command;
pub mod directions;
pub(crate) mod names;
pub mod question;
pub mod report;
pub mod words;

pub use words::{
    Animacy, Case, Evidence, FormIndex, Gender, Hit, Language, NounPhrase, Number, PlaceSense,
    Readings, Spelling, WordHints, alternatives, english, enumerate, russian, word_ranges,
};
