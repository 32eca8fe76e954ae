//! What can be wrong with a rule file, a scenario or a PDDL file, each fault with its place and its remedy.

use miette::SourceSpan;

use crate::units::{Bilingual, Fault, Source};

/// A stretch of a text that was read.
#[derive(Debug, Clone)]
pub struct Place {
    pub source: Source,
    pub span: SourceSpan,
}

impl Place {
    /// Line and column, both from 1, the column in characters.
    #[must_use]
    pub fn position(&self) -> (usize, usize) {
        self.source.position(self.span.offset())
    }
}

/// One thing wrong in a rule file, a scenario or a PDDL file.
#[derive(Debug, Clone, PartialEq, Eq, Fault)]
#[fault(strips)]
#[non_exhaustive]
pub enum RuleError {
    /// The file system refused.
    Unreadable { path: String, reason: Bilingual },

    /// Rubbish instead of UTF-8.
    NotText { path: String, offset: usize },

    /// More than [`super::MAX_FILE_BYTES`].
    TooLarge { path: String, bytes: u64, limit: u64 },

    /// Nothing but white space and comments.
    Empty { path: String },

    /// A character that no word of the language may hold.
    UnexpectedCharacter { sign: String, at: SourceSpan },

    /// One word stands where another is due.
    Syntax { expected: Bilingual, found: Bilingual, at: SourceSpan },

    /// `Слово:` that opens no section.
    UnknownHeading { heading: String, help: Option<Bilingual>, at: SourceSpan },

    /// A bracket was opened and never closed.
    MissingParenthesis { at: SourceSpan },

    /// One closing bracket too many; the paper's own rule ends so.
    #[fault(warning)]
    SurplusParenthesis { at: SourceSpan },

    /// Brackets within brackets beyond all sense.
    TooDeep { limit: usize, at: SourceSpan },

    /// PDDL beyond :strips :typing :negative-preconditions :equality :action-costs.
    Unsupported { what: String, help: Bilingual, at: SourceSpan },

    /// A PDDL requirement beyond what is read; a file that declares it need not use it.
    #[fault(warning)]
    Requirement { name: String, at: SourceSpan },

    /// `(define …)` is closed, and more sections follow.
    EarlyEnd { next: Bilingual, at: SourceSpan },

    /// An assumption to be withdrawn that nobody made.
    NotAssumed { fact: String, is_fact: bool, help: Option<Bilingual>, at: SourceSpan },

    /// A scenario that is to be driven states what neither the map nor the robot knows to be so.
    NotBelieved { fact: String, help: Option<Bilingual>, at: SourceSpan },

    /// A scenario that is to be driven wants what nothing that the robot does brings about.
    NotDriven { fact: String, help: Bilingual, at: SourceSpan },

    /// A type that is declared nowhere, though types are declared.
    UnknownType { name: String, help: Option<Bilingual>, at: SourceSpan },

    /// A type that inherits from itself.
    TypeCycle { name: String, at: SourceSpan },

    /// A predicate that no action and no declaration introduces.
    UnknownPredicate { name: String, help: Option<Bilingual>, at: SourceSpan },

    /// A predicate that one action alone speaks of, and that differs from another by a slip of the pen.
    #[fault(warning)]
    LonelyPredicate { name: String, action: String, help: Option<Bilingual>, at: SourceSpan },

    /// A parent that is declared nowhere and differs from a declared type by a slip of the pen.
    #[fault(warning)]
    LonelyType { name: String, help: Bilingual, at: SourceSpan },

    /// A number that no `:functions` declares.
    UnknownFunction { name: String, help: Option<Bilingual>, at: SourceSpan },

    /// A PDDL problem of another domain than the one read with it.
    #[fault(warning)]
    OtherDomain { wanted: String, found: String, at: SourceSpan },

    /// A PDDL metric that the planner does not know.
    #[fault(warning)]
    Metric { metric: String, at: SourceSpan },

    /// A PDDL metric that weighs a preference that there is none of.
    UnknownPreference { name: String, help: Option<Bilingual>, at: SourceSpan },

    /// Too few or too many arguments.
    Arity { name: String, expected: usize, found: usize, help: Bilingual, at: SourceSpan },

    /// A variable that the action's parameters do not name.
    UndeclaredVariable { action: String, variable: String, help: Option<Bilingual>, at: SourceSpan },

    /// A variable where only objects may stand.
    VariableInFact { variable: String, at: SourceSpan },

    /// The same name given twice where once is enough.
    Duplicate {
        what: Bilingual,
        name: String,
        help: Bilingual,
        at: SourceSpan,
        first: Option<SourceSpan>,
    },

    /// A second name is given to an action.
    SecondNameOfAction { name: String, at: SourceSpan },

    /// An object declared twice, with types that have nothing in common.
    ObjectTwice {
        name: String,
        found: Bilingual,
        earlier: Bilingual,
        help: Bilingual,
        at: SourceSpan,
        first: Option<SourceSpan>,
    },

    /// A phrase with a variable that its head does not name.
    PhraseVariable { variable: String, help: Option<Bilingual>, at: SourceSpan },

    /// The same atom is added and deleted.
    ContradictoryEffect { action: String, atom: String, at: SourceSpan },

    /// A precondition that no state satisfies.
    ContradictoryPrecondition { action: String, atom: String, at: SourceSpan },

    /// An argument of one type where the predicate wants another.
    ArgumentType {
        name: String,
        number: usize,
        expected: Bilingual,
        term: String,
        found: Bilingual,
        help: Bilingual,
        at: SourceSpan,
    },

    /// `(дверь ?x)` in the body, `(помещение ?x)` in the parameters.
    VariableType { variable: String, declared: Bilingual, found: String, at: SourceSpan },

    /// An object that no fact, declaration or map knows.
    UnknownObject { name: String, help: Option<Bilingual>, at: SourceSpan },

    /// Two uses of an object ask for two types that have nothing in common.
    ObjectType { name: String, found: Bilingual, earlier: Bilingual, at: SourceSpan },

    /// Facts that cannot hold together.
    ContradictoryFact { atom: String, at: SourceSpan },

    /// A file that includes itself through others.
    IncludeCycle { at: SourceSpan },

    /// An included file that cannot be had.
    Include { path: String, reason: Bilingual, at: SourceSpan },

    /// A number that is none, or is negative, or too large.
    Cost { text: String, at: SourceSpan },

    /// A scenario without a goal.
    NoGoal,

    /// A scenario whose rules know no action.
    NoActions,

    /// A plan names an action that the rules do not have.
    UnknownAction { name: String, help: Option<Bilingual>, at: SourceSpan },

    /// A plan has an object where one of another type is due.
    WrongObject { name: String, expected: Bilingual, at: SourceSpan },

    /// An action of a plan whose turn comes too early.
    PlanPrecondition { fact: Bilingual, at: SourceSpan },

    /// Two actions of a step that cannot go together.
    PlanInterference { fact: Bilingual, other: String, at: SourceSpan },

    /// A plan that does not do what it is for.
    PlanMissesGoal { fact: Bilingual },

    /// Grounding takes more memory than it may.
    TooManyOperators { megabytes: usize },

    /// A condition with «or», quantifiers or effects under conditions falls into more cases than anybody plans with.
    TooManyCases { of: String, limit: usize },

    /// Actions that last: each is planned as one, from its start to its end.
    #[fault(warning)]
    Durations { at: SourceSpan },

    /// What is asked while an action lasts is no plain fact, and its start may touch it.
    #[fault(code = "strips::lasting_condition")]
    LastingCompound { at: SourceSpan },

    /// What a rule derives is stated, or changed by an action.
    DerivedStated { name: String, at: SourceSpan },

    /// What is derived rests on its own absence.
    DerivedByAbsence { name: String, at: SourceSpan },

    /// A cost is a function's value, and the problem does not give it.
    #[fault(warning)]
    NoPrice { action: String, more: usize },
}
