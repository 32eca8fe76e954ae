//! A checked set of rules: types, predicates and actions whose names all mean something.
//!
//! Invariant: every index held by a [`Domain`] is an index of that same `Domain`.

use std::collections::{HashMap, HashSet, VecDeque};
use std::sync::Arc;

use super::error::{Place, RuleError};
use super::fault::{RuleFault, RuleFaults};
use super::hint::hint;
use super::indices::indices;
use super::phrase::Phrases;
use super::second::{Second, SecondNames};
use crate::units::{Bilingual, Language, name_key, told};

indices! {
    /// A type of objects: помещение, дверь.
    KindId,
    /// A predicate of the rules.
    PredicateId,
}

/// The root of all types: an object that is known by name alone.
pub const ANY_KIND: KindId = KindId(0);

/// A type and the types that it inherits from.
#[derive(Debug, Clone)]
pub struct Kind {
    pub name: String,
    /// Those that it is said to belong to; every type belongs to [`ANY_KIND`] besides.
    pub(super) parents: Vec<KindId>,
}

/// Types of which an object must have one.
pub type KindSet = Vec<KindId>;

/// A predicate and what its arguments may be.
#[derive(Debug, Clone)]
pub struct Predicate {
    pub name: String,
    pub args: Vec<KindSet>,
}

/// A parameter of the schema, or an object known by name.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum SchemaTerm {
    Parameter(u32),
    Constant(String),
}

/// An atom over a schema's parameters.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct SchemaAtom {
    pub predicate: PredicateId,
    pub args: Vec<SchemaTerm>,
}

/// A part of a schema's cost.
#[derive(Debug, Clone)]
pub enum SchemaCost {
    Number(u32),
    /// A value that the problem gives for the arguments.
    Function {
        name: String,
        args: Vec<SchemaTerm>,
    },
}

/// A condition that is no conjunction of literals; negation stands at literals alone. A variable that a quantifier binds is
/// numbered as a parameter after all those bound around it.
#[derive(Debug, Clone)]
pub enum Formula {
    Literal {
        atom: SchemaAtom,
        negated: bool,
    },
    Equal {
        pair: (SchemaTerm, SchemaTerm),
        negated: bool,
    },
    /// One of the conjunctions holds.
    Any(Vec<Vec<Self>>),
    /// The conjunction holds for every choice of objects, or for some.
    Quantified {
        every: bool,
        variables: Vec<KindSet>,
        body: Vec<Self>,
    },
}

/// What an action brings about where a condition holds before it, for every choice of objects.
#[derive(Debug, Clone)]
pub struct ConditionalEffect {
    pub variables: Vec<KindSet>,
    pub condition: Vec<Formula>,
    pub add_effects: Vec<SchemaAtom>,
    pub del_effects: Vec<SchemaAtom>,
}

/// One `Действие` of a rule file.
#[derive(Debug, Clone)]
pub struct Schema {
    pub name: String,
    pub parameters: Vec<KindSet>,
    pub parameter_names: Vec<String>,
    pub preconditions: Vec<SchemaAtom>,
    pub negative_preconditions: Vec<SchemaAtom>,
    pub equal: Vec<(SchemaTerm, SchemaTerm)>,
    pub different: Vec<(SchemaTerm, SchemaTerm)>,
    pub add_effects: Vec<SchemaAtom>,
    pub del_effects: Vec<SchemaAtom>,
    /// Those of `add_effects` that are deleted first, in so many words.
    pub renewed: Vec<SchemaAtom>,
    /// Preconditions beyond literals.
    pub formulas: Vec<Formula>,
    pub conditional: Vec<ConditionalEffect>,
    /// Summed; empty means one.
    pub cost: Vec<SchemaCost>,
}

impl Schema {
    /// A schema of no conditions and no effects.
    pub(super) fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            parameters: Vec::new(),
            parameter_names: Vec::new(),
            preconditions: Vec::new(),
            negative_preconditions: Vec::new(),
            equal: Vec::new(),
            different: Vec::new(),
            add_effects: Vec::new(),
            del_effects: Vec::new(),
            renewed: Vec::new(),
            formulas: Vec::new(),
            conditional: Vec::new(),
            cost: Vec::new(),
        }
    }

    /// All that it may add or delete, under whatever condition.
    pub(super) fn changes(&self) -> impl Iterator<Item = &SchemaAtom> {
        let own = self.add_effects.iter().chain(&self.del_effects);
        own.chain(self.conditional.iter().flat_map(|e| e.add_effects.iter().chain(&e.del_effects)))
    }

    /// Whether it has conditions beyond literals, or effects under conditions.
    #[must_use]
    pub fn is_beyond_literals(&self) -> bool {
        !self.formulas.is_empty() || !self.conditional.is_empty()
    }
}

/// Checked rules.
#[derive(Debug, Clone)]
pub struct Domain {
    pub(super) kinds: Vec<Kind>,
    pub(super) kind_index: HashMap<String, KindId>,
    pub(super) predicates: Vec<Predicate>,
    pub(super) predicate_index: HashMap<String, PredicateId>,
    pub(super) schemas: Vec<Schema>,
    /// What holds wherever its condition does, one schema a rule; the atom is its only effect.
    pub(super) derived: Vec<Schema>,
    /// How many units of cost are one; costs with decimals are counted in thousandths.
    pub(super) cost_unit: u32,
    pub(super) phrases: Arc<Phrases>,
    pub(super) second: Arc<SecondNames>,
    /// Where each predicate was declared, or else first spoken of as it is understood.
    pub(super) introduced: HashMap<PredicateId, Place>,
}

impl Domain {
    /// The type of this name in any of its spellings.
    #[must_use]
    pub fn kind(&self, name: &str) -> Option<KindId> {
        let key = name_key(name);
        let of = |second: &Second| self.kind_index.get(&name_key(&second.of));
        self.kind_index.get(&key).or_else(|| of(self.second.kinds.get(&key)?)).copied()
    }

    #[must_use]
    pub fn kinds(&self) -> &[Kind] {
        &self.kinds
    }

    /// The predicate of this name in any of its spellings. An underscore at the end is a sign like any other: PDDL tells
    /// `at` and `at_` apart, and the rule text, where the paper writes one before the bracket, is read without it.
    #[must_use]
    pub fn predicate(&self, name: &str) -> Option<PredicateId> {
        let key = name_key(name);
        let of = |second: &Second| self.predicate_index.get(&name_key(&second.of));
        self.predicate_index.get(&key).or_else(|| of(self.second.predicates.get(&key)?)).copied()
    }

    /// What a text of this language calls a predicate: its second name there, or the only one that it has.
    #[must_use]
    pub fn called<'a>(&'a self, predicate: &'a str, language: Language) -> &'a str {
        SecondNames::in_language(&self.second.predicates, predicate, language).unwrap_or(predicate)
    }

    /// What a text of this language calls a type.
    #[must_use]
    pub fn called_kind<'a>(&'a self, kind: &'a str, language: Language) -> &'a str {
        let of_root = || language == Language::English && self.kind(kind) == Some(ANY_KIND);
        let second = SecondNames::in_language(&self.second.kinds, kind, language);
        second.unwrap_or_else(|| if of_root() { "object" } else { kind })
    }

    /// Every name of a predicate, for hints.
    pub(super) fn names_of_predicates(&self) -> impl Iterator<Item = &str> {
        let second = self.second.predicates.values().map(|second| second.text.as_str());
        self.predicates.iter().map(|predicate| predicate.name.as_str()).chain(second)
    }

    /// Every name of a type, for hints.
    pub(super) fn names_of_kinds(&self) -> impl Iterator<Item = &str> {
        let second = self.second.kinds.values().map(|second| second.text.as_str());
        self.kinds.iter().map(|kind| kind.name.as_str()).chain(second)
    }

    /// The predicate of this name, or what may have been meant.
    ///
    /// # Errors
    /// [`RuleError::UnknownPredicate`].
    pub fn known_predicate(&self, name: &str) -> Result<PredicateId, RuleFaults> {
        self.predicate(name).ok_or_else(|| {
            let help = hint(name, self.names_of_predicates());
            let (name, at) = (name.to_owned(), (0, 0).into());
            RuleFault::placeless(RuleError::UnknownPredicate { name, help, at }).into()
        })
    }

    #[must_use]
    pub fn predicates(&self) -> &[Predicate] {
        &self.predicates
    }

    #[must_use]
    pub fn schemas(&self) -> &[Schema] {
        &self.schemas
    }

    /// How the rules say their predicates, actions and types in words.
    #[must_use]
    pub fn phrases(&self) -> &Arc<Phrases> {
        &self.phrases
    }

    /// Whether some action of the rules adds or deletes facts of this predicate.
    #[must_use]
    pub fn is_changed_by_actions(&self, predicate: PredicateId) -> bool {
        self.schemas.iter().any(|schema| schema.changes().any(|atom| atom.predicate == predicate))
    }

    /// How many units of an operator's cost are one: a thousand where costs have decimals.
    #[must_use]
    pub fn cost_unit(&self) -> u32 {
        self.cost_unit
    }

    /// Actions, and after them the rules of what is derived.
    pub(super) fn rules(&self) -> impl Iterator<Item = &Schema> {
        self.schemas.iter().chain(&self.derived)
    }

    pub(super) fn rule(&self, number: usize) -> &Schema {
        let actions = self.schemas.len();
        if number < actions { &self.schemas[number] } else { &self.derived[number - actions] }
    }

    /// Whether some rule gives facts of this predicate wherever a condition holds.
    #[must_use]
    pub fn is_derived(&self, predicate: PredicateId) -> bool {
        self.derived.iter().any(|rule| rule.add_effects[0].predicate == predicate)
    }

    /// Whether the rules have more than literals as conditions and effects: which explanations do not see through.
    #[must_use]
    pub fn is_beyond_literals(&self) -> bool {
        !self.derived.is_empty() || self.schemas.iter().any(Schema::is_beyond_literals)
    }

    /// Whether `kind` is `ancestor` or inherits from it.
    #[must_use]
    pub fn inherits(&self, kind: KindId, ancestor: KindId) -> bool {
        if ancestor == ANY_KIND {
            return true;
        }
        let mut at = kind;
        // Most types have one parent; a chain is no longer than there are types.
        for _ in 0..self.kinds.len() {
            if at == ancestor {
                return true;
            }
            match self.kinds[at.index()].parents[..] {
                [] => return false,
                [only] => at = only,
                _ => break,
            }
        }
        self.lineage(at).any(|above| above == ancestor)
    }

    /// A type and all that it inherits from, the nearer ones first.
    pub(super) fn lineage(&self, kind: KindId) -> impl Iterator<Item = KindId> + '_ {
        let mut told = HashSet::from([kind]);
        let mut open = VecDeque::from([kind]);
        std::iter::from_fn(move || {
            let next = open.pop_front()?;
            let above = self.kinds[next.index()].parents.iter().copied();
            open.extend(above.filter(|parent| told.insert(*parent)));
            Some(next)
        })
    }

    /// Whether an object of one of the types `have` may stand where one of `wanted` is due.
    #[must_use]
    pub fn fits(&self, have: &[KindId], wanted: &[KindId]) -> bool {
        have.iter().any(|&kind| wanted.iter().any(|&ancestor| self.inherits(kind, ancestor)))
    }

    pub(super) fn kind_names(&self, kinds: &[KindId]) -> Bilingual {
        let name = |kind: &KindId| self.kinds[kind.index()].name.as_str();
        let called = |kind: &KindId, language| match language {
            Language::Russian => name(kind),
            Language::English => self.called_kind(name(kind), language),
        };
        Bilingual::both(|language| {
            let names: Vec<&str> = kinds.iter().map(|kind| called(kind, language)).collect();
            names.join(&told!(language, "one-or-another"))
        })
    }
}

impl Domain {
    /// `ДВЕРЬ_НАХОДИТСЯ-В_(дверь, помещение)`, for messages about what was written by one of its names.
    pub(super) fn signature(&self, predicate: PredicateId, name: &str) -> Bilingual {
        let Predicate { args, .. } = &self.predicates[predicate.index()];
        let told = |language: Language| {
            let args: Vec<String> = args
                .iter()
                .map(|kinds| match kinds.is_empty() {
                    true => told!(language, "any-object"),
                    false => self.kind_names(kinds).say(language).to_owned(),
                })
                .collect();
            let place = self.introduced.get(&predicate).map_or_else(String::new, |place| {
                let (line, column) = place.position();
                told!(language, "as-here", at = format!("{}:{line}:{column}", place.source.name()))
            });
            let written = format!("{name}_({})", args.join(", "));
            told!(language, "signature", written, place)
        };
        Bilingual::both(told)
    }
}
