//! Word forms: Russian names in any case and number, English beside them, and from a form back to its name.
//!
//! After the source paper 1, section 8 («Я нахожусь в Комнате-В …»), which needs every name of the map declined.
//! A form comes from the first that knows it: the map itself ([`WordHints::forms`]), the word list of this folder,
//! the dictionary (feature `rumorph`), the ending of the word. [`NounPhrase::evidence`] tells which it was.
//!
//! Invariant: no text makes this folder panic, and a name's nominative is the name.
//!
//! ```
//! use orthoframe_language::{Case, Language, NounPhrase, WordHints, enumerate, russian};
//! let name = |name| NounPhrase::parse(name, &WordHints::default());
//! assert_eq!(russian::where_at(&name("шкаф")), "в шкафу");
//! assert_eq!(russian::with(russian::Preposition::U, Case::Genitive, &name("Дверь-ВZ")), "у Двери-ВZ");
//! assert_eq!(russian::count(22, &name("Письменный стол")), "22 Письменных стола");
//! assert_eq!(enumerate(&["стол", "стул"], Language::Russian), "стол и стул");
//! ```

mod adjective;
mod dictionary;
pub mod english;
pub(crate) mod everyday;
mod grammar;
mod identifier;
mod index;
mod letters;
mod lexicon;
mod list;
mod measure;
mod noun;
mod number;
mod parse;
mod phrase;
pub mod russian;
pub(crate) mod things;

pub(crate) use dictionary::{
    is_first_person, is_russian_word, may_be_predicate, ordering_verb, readings, says_nothing,
};
pub use grammar::{Animacy, Case, Evidence, Gender, Number, PlaceSense, WordHints};
pub use index::{FormIndex, Hit, Readings, Spelling};
pub use letters::word_ranges;
pub(crate) use letters::{OPAQUE, is_hyphen, phrase_at, word_keys};
pub use list::{Language, alternatives, enumerate};
pub(crate) use measure::{area, duration, length};
pub(crate) use number::{Cardinal, Counted};
pub(crate) use parse::may_be_noun;
pub use phrase::NounPhrase;
