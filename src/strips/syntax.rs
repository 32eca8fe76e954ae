//! What a rule file or a PDDL file says, before anyone asked whether it means anything.

use miette::SourceSpan;

use super::error::{Place, RuleError, RuleFault};
use crate::units::{Language, Source, name_key};

/// A word of the text, as written, with its place.
#[derive(Debug, Clone)]
pub(super) struct Name {
    pub(super) text: String,
    pub(super) at: Place,
}

impl Name {
    pub(super) fn new(text: &str, source: &Source, span: SourceSpan) -> Self {
        Self { text: text.to_owned(), at: Place { source: source.clone(), span } }
    }

    pub(super) fn key(&self) -> String {
        name_key(&self.text)
    }

    pub(super) fn fault(&self, error: impl FnOnce(SourceSpan) -> RuleError) -> RuleFault {
        RuleFault::new(&self.at.source, error(self.at.span))
    }
}

/// `дверь ?y`, `Дверь-ВZ` or `дверь Дверь-ВZ`.
#[derive(Debug, Clone)]
pub(super) struct Term {
    pub(super) kind: Option<Name>,
    pub(super) name: Name,
    pub(super) is_variable: bool,
}

#[derive(Debug, Clone)]
pub(super) struct Atom {
    pub(super) predicate: Name,
    pub(super) args: Vec<Term>,
}

#[derive(Debug, Clone)]
pub(super) enum Condition {
    Holds { atom: Atom, negated: bool },
    Equal { pair: Box<(Term, Term)>, negated: bool },
}

/// A variable with the types it may take; none means any.
#[derive(Debug, Clone)]
pub(super) struct Parameter {
    pub(super) kinds: Vec<Name>,
    pub(super) variable: Name,
}

/// What carrying out an action costs.
#[derive(Debug, Clone)]
pub(super) enum CostTerm {
    Number(u32),
    /// `(road-length ?a ?b)`, looked up in the problem's initial values.
    Function(Atom),
}

#[derive(Debug, Clone)]
pub(super) struct ActionText {
    pub(super) name: Name,
    pub(super) parameters: Vec<Parameter>,
    pub(super) precondition: Vec<Condition>,
    pub(super) add: Vec<Atom>,
    pub(super) del: Vec<Atom>,
    /// Deleted, and then added: among `add` alone.
    pub(super) renewed: Vec<Atom>,
    pub(super) cost: Vec<CostTerm>,
}

/// A word and the types it is declared with: a type and its parents, an object and its types.
#[derive(Debug, Clone)]
pub(super) struct Declaration {
    pub(super) name: Name,
    pub(super) kinds: Vec<Name>,
}

/// `ДВЕРЬ_НАХОДИТСЯ-В_(дверь, помещение)`.
#[derive(Debug, Clone)]
pub(super) struct Signature {
    pub(super) name: Name,
    pub(super) args: Vec<Vec<Name>>,
}

/// `ДВЕРЬ_ИЗ_В_ОТКРЫТА_(?y, ?x, ?z) = «?y is open»`: how a predicate, an action or a type is said in a language.
#[derive(Debug, Clone)]
pub(super) struct PhraseText {
    pub(super) language: Language,
    pub(super) negated: bool,
    pub(super) name: Name,
    /// None for a type.
    pub(super) parameters: Option<Vec<Name>>,
    pub(super) phrase: Name,
}

/// All that one file and the files it includes say.
#[derive(Debug, Default)]
pub(super) struct Document {
    /// None when the text declares no types and they are taken from the actions.
    pub(super) types: Option<Vec<Declaration>>,
    pub(super) predicates: Vec<Signature>,
    /// Whether a predicate must be declared before use (PDDL), or may be inferred from the actions.
    pub(super) predicates_closed: bool,
    pub(super) objects: Vec<Declaration>,
    /// Whether an object must be declared before use (PDDL), or a fact about it is enough.
    pub(super) objects_closed: bool,
    pub(super) actions: Vec<ActionText>,
    pub(super) facts: Vec<Condition>,
    pub(super) assumptions: Vec<Condition>,
    pub(super) values: Vec<(Atom, u32)>,
    /// Numbers that a problem gives, as declared (PDDL).
    pub(super) functions: Vec<Signature>,
    pub(super) goal: Vec<Condition>,
    /// The goal was stated and asks for nothing, as `(:goal (and))` does.
    pub(super) goal_is_empty: bool,
    pub(super) map: Option<Name>,
    pub(super) phrases: Vec<PhraseText>,
    /// What a PDDL domain calls itself, and what its problem calls it.
    pub(super) domain_names: (Option<Name>, Option<Name>),
    pub(super) warnings: Vec<RuleFault>,
}

impl Document {
    /// Appends what an included file says.
    pub(super) fn include(&mut self, other: Self) {
        if let Some(types) = other.types {
            self.types.get_or_insert_default().extend(types);
        }
        self.predicates.extend(other.predicates);
        self.predicates_closed |= other.predicates_closed;
        self.objects.extend(other.objects);
        self.objects_closed |= other.objects_closed;
        self.actions.extend(other.actions);
        self.facts.extend(other.facts);
        self.assumptions.extend(other.assumptions);
        self.values.extend(other.values);
        self.functions.extend(other.functions);
        self.goal.extend(other.goal);
        self.goal_is_empty |= other.goal_is_empty;
        self.map = self.map.take().or(other.map);
        self.phrases.extend(other.phrases);
        self.warnings.extend(other.warnings);
    }
}
