//! A general embedded Datalog engine: rule text read at run time, evaluated on datafrog.
//!
//! The text is Soufflé's dialect (`.decl` with types, `:-`, `!`, comparisons, arithmetic, string functors,
//! `count`, `sum`, `min`, `max`, `mean`), with identifiers in any alphabet and a second name for a relation
//! after its declaration. Symbols and numbers become 32-bit words, tuples rows of words; each rule becomes
//! nested loops over indexes, each recursive group of relations a semi-naive iteration with datafrog's
//! variables. The engine knows nothing of maps or robots.
//!
//! **Invariant**: a [`Program`] that parses can be evaluated: its variables are bound, its negations stratified.
//!
//! ```
//! use orthoframe_facts::{Program, Value};
//! use orthoframe_units::Source;
//!
//! let rules = Source::new("опора.dl", r#"
//!     .decl стоит_на(верх: symbol, низ: symbol) = stands_on
//!     .decl держится_на(верх: symbol, низ: symbol) = held_by
//!     .input стоит_на
//!     .output держится_на
//!     держится_на(X, Y) :- стоит_на(X, Y).
//!     держится_на(X, Z) :- держится_на(X, Y), стоит_на(Y, Z).
//! "#);
//! let program = Program::parse(&rules)?;
//! let mut facts = program.database();
//! facts.insert("stands_on", &["чашка".into(), "блюдце".into()])?;
//! facts.insert("стоит_на", &["блюдце".into(), "стол".into()])?;
//!
//! let derived = program.evaluate(&facts)?;
//! assert_eq!(derived.len("держится_на")?, 3);
//! assert!(derived.contains("held_by", &["чашка".into(), "стол".into()])?);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Invariants
//!
//! A `Program` that parses can be evaluated: every variable is bound, and no relation depends on its own negation
//! or aggregate. Evaluation ends: in its result, or in a fault that names the rule, when the time or memory of
//! `facts::Limits` is used up (`facts/limits`). Equal values have equal 32-bit words, so joins compare words
//! alone. Evaluation records nothing for explanations; proofs are found afterwards, each of least height. After
//! `Live::update` the result equals an evaluation from scratch, and the update's cost follows what may change,
//! not the size of the relations (below). Dense recursive relations of pairs are kept as bits. A `float` is an
//! exact decimal in millionths, so that it too is one word. Deliberately absent: maps, robots, languages of
//! answers.
//!
//! *How edits are followed.* Delete and rederive, stratum by stratum. Each premise of each clause has a plan that
//! starts with that premise's changed rows; a changed negation or aggregate is put before its clause as one more
//! atom, and the clause itself still decides. Run over the relations as they were, these plans name the tuples
//! that may fall; run over them as they will be, those that rise. A tuple that may fall is tried by its clauses
//! run backwards from their heads; in a recursive stratum all that hangs on it falls first, so that nothing holds
//! itself up. Counting was not taken: evaluation stops at the first witness and would have to count them all;
//! backward/forward search saves little where recursion is short, as chains of support are. A stratum of which a
//! quarter would fall, or that has a `.limitsize`, is evaluated anew. Rows keep their places through edits
//! (`facts/stored.rs`: a sorted part that is never moved, one bit for each of its rows, and a tree of later
//! rows), so indexes are built once and follow (`facts/kept.rs`).

use orthoframe_units as units;

units::messages!(
    "../../rules/messages",
    "facts",
    AskError,
    EvaluateError,
    FactError,
    FilesError,
    NoDecimal,
    RuleError
);

mod abreast;
mod apart;
mod ask;
mod beside;
mod called;
mod calls;
mod check;
mod clause;
mod component;
mod computed;
mod condition;
mod database;
mod decimal;
mod declare;
mod declared;
mod delta;
mod demand;
mod derived;
mod evaluate;
mod explain;
mod expression;
mod fault;
mod file_input;
mod file_output;
mod files;
mod files_error;
mod filter;
mod finished;
mod fixpoint;
mod format;
mod ground;
mod growing;
mod head;
mod idle;
mod index;
mod inline;
mod interned;
mod kept;
mod kinds;
mod layout;
mod lex;
mod limits;
mod live;
mod magic;
mod misuse;
mod nearest;
mod operand;
mod outline;
mod parse;
mod pattern;
mod plan;
mod preprocess;
mod product;
mod program;
mod proof;
mod question;
mod read;
mod record;
mod regular;
mod relations;
mod row;
mod rows;
mod run;
mod saved;
mod seen;
mod shares;
mod sink;
mod slots;
mod sorted_rows;
mod sorting;
mod spread;
mod step;
mod stored;
mod strata;
mod subsume;
mod syntax;
mod tables;
mod texts;
mod together;
mod trace;
mod turned;
mod unify;
mod value;
mod why_not;
mod witness;
mod word;

pub use ask::Answers;
pub use calls::KnownRow;
pub use computed::{AskError, Computed};
pub use database::{Database, FactError, Known, Loader, RelationKey, Schema};
pub use decimal::{Decimal, NoDecimal};
pub use derived::{Derived, Tuple, Tuples};
pub use evaluate::EvaluateError;
pub use fault::{Faults, FileFaults, RuleError};
pub use files::{FilesReport, run_files, run_files_traced};
pub use files_error::FilesError;
pub use format::format_rules;
pub use limits::Limits;
pub use live::Live;
pub use outline::{Mark, Meaning, outline};
pub use program::{Kind, Program};
pub use proof::{Because, Explainer, FactText, Premise, Proof, ProofStep, RuleInstance, SEE_ABOVE};
pub use question::FirstName;
pub use relations::{Column, Parameters, RelationId, RelationInfo};
pub use syntax::{Aggregation, Comparison};
pub use trace::{Join, RuleTrace};
pub use why_not::{Below, FailedRule, WhyNot};
pub use word::{Value, quoted};
