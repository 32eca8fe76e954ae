//! Talk: names in all their forms, position reports and commands, in Russian and English.
//!
//! After the source paper 1, sections 5 and 8. The folder turns values into sentences and sentences into values; it
//! holds no map. Invariant: no text from outside makes it panic, and it never guesses between two names.
//!
//! ```
//! use orthoframe_language::{NounPhrase, WordHints, russian};
//! let room = NounPhrase::parse("Комната-В", &WordHints::default());
//! assert_eq!(format!("{} – {}", russian::whence(&room), russian::whither(&room)), "из Комнаты-В – в Комнату-В");
//! ```
//!
//! # Invariants
//!
//! - *Names.* A name's nominative is the name itself; every form that a phrase gives is found again by the
//!   index of forms. Forms come from the map, then the word list, then the dictionary, then the ending; the
//!   dictionary is opened at the first word that the list does not know. Names that differ in their tag alone
//!   share one declined stem, so the index grows with the stems.
//! - *Words.* What code looks for among words stands in the language files, in common sets (`sets`); what questions and
//!   orders are made of, in `marks.txt`, `things.txt` and `commands.txt`.
//! - *No guessing.* A sentence that names several things is ambiguous and one that names none is unknown; no
//!   choice is made. Nothing that a person writes makes it panic.
//! - *Questions.* Before it is read, a sentence is put into words that the map knows (`everyday`: diminutives
//!   and other names of a thing; `purposes`: sorts above the map's types, each with its role in what `uses`
//!   lists as done with them; `storeys`: "upstairs"; `paraphrase`, by the lines of the language files, and
//!   `rephrase`: other ways to say it; `here`: the robot's room), and cut where it asks several things (`several`). It becomes a `Query` before
//!   the map is looked at; one that lacks a noun, value, number or size of the sentence is not understood
//!   (`assemble/used`); what has no answer gets its words in `doubts`. An `Answer` is data before it is a
//!   sentence; a rule shown for a query of relations gives the same bindings as the answer (a test runs it).
//!   Where the robot is, ways and history come from outside through `question::Senses`.
//! - *Dialogue.* What each of the last exchanges was about is kept in ranks (`focus`): topics, then the members
//!   of a list. A pronoun takes up the first that agrees and may stand in its relation (`pronouns`), and "there"
//!   is where what was told is (`there`); of several things that
//!   a description fits the one is meant that was just spoken of, and where the exchanges name several of one
//!   rank it is asked back. After a name that the map lacks a pronoun means nothing. `follow` makes a whole
//!   question of one that goes on from the last, `discourse` of one about the way that was asked for,
//!   `another_one` of one about another of the kind, `rest` of one about what was not told.
//! - *Measures in answers.* What superlatives and comparatives go by is one list (`compared`); "higher" goes by
//!   place, and by size where things begin equally high (`knowledge/measure`); shelves and drawers are told
//!   apart by the heights of an object's parts (`knowledge/levels`), and left and right for one who faces a
//!   thing are seen from a standpoint that the answer names (`knowledge/facing`); both have their words in
//!   `level_words`. `each` tells of every room by itself and `part` of legs and shelves; walls and corners,
//!   which have no names, are measured (`knowledge/walls`), and told by what opens in them.
//! - *Commands.* Whether a text orders, and when, is told by its words alone (`command/hints`), and so is how
//!   it is put into plain orders (`paraphrase`, by the lines of the language files; `command/spoken`, `time`;
//!   `ellipsis`: what the clause before has said); an order under a condition is parted from it (`question/orders`). Then it is resolved
//!   (`question/resolution`): orders without a verb and amendments become whole ones (`terse`), descriptions become
//!   names by the grammar of questions, and `command` reads verbs, roles and names only. Nothing that was said
//!   is passed over: a rewriting loses no name, number or value but what is said not to be meant
//!   (`command/spoken`, `resolution::dropped`), a description uses all its words (`resolution`, `Noun::idle_count`), a
//!   command takes its arguments out of their roles, and what is left there refuses it (`command/assemble`).
//!   What stands in its way is laid to words of the text (`command/blame`).
//! - *Reports and ways.* A position report's context is the shortest under which a reader finds one region; the
//!   turns told of a way are the angles of its geometry. What the robot is less sure of than the rules'
//!   threshold «belief told» is never told as a fact (`answer/unsure`). Where the relations of the moment
//!   differ from the survey, ways and places are told of the world now, in dialogue, by `route` and in tasks
//!   alike: `engine/present` has its floor and relations, which `relations/follow` brings from the survey's
//!   tuple by tuple, and `engine/surroundings` hands them to the tellers.

use orthoframe_facts as facts;
use orthoframe_map as map;
use orthoframe_semantics as semantics;
use orthoframe_units as units;

pub mod command;
pub mod directions;
pub mod names;
pub mod paraphrase;
pub mod question;
pub mod report;
pub mod scan;
mod sets;
pub mod words;
pub mod zones;

pub use words::{
    Animacy, Case, Evidence, FormIndex, Gender, Hit, Language, NounPhrase, Number, PlaceSense,
    Readings, Spelling, WordHints, alternatives, english, enumerate, russian, word_ranges,
};
pub use zones::zone_in_words;
