//! What a rule file or a PDDL file says, before anyone asked whether it means anything.

use std::sync::Arc;

use miette::SourceSpan;

use super::error::{Place, RuleError};
use super::fault::RuleFault;
use crate::units::{Language, Source, name_key};

/// A word of the text, as written, with its place.
#[derive(Debug, Clone)]
pub(super) struct Name {
    pub(super) text: String,
    pub(super) at: Place,
    /// What the text names by a second name.
    pub(super) second_of: Option<Arc<str>>,
}

impl Name {
    pub(super) fn new(text: &str, source: &Source, span: SourceSpan) -> Self {
        let at = Place { source: source.clone(), span };
        Self { text: text.to_owned(), at, second_of: None }
    }

    /// The first name of what is named.
    pub(super) fn first(&self) -> &str {
        self.second_of.as_deref().unwrap_or(&self.text)
    }

    pub(super) fn key(&self) -> String {
        name_key(self.first())
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

/// A condition; negation stands at atoms and comparisons alone.
#[derive(Debug, Clone)]
pub(super) enum Condition {
    Holds {
        atom: Atom,
        negated: bool,
    },
    Equal {
        pair: Box<(Term, Term)>,
        negated: bool,
    },
    /// One of the conjunctions holds.
    Any(Vec<Vec<Self>>),
    /// The conjunction holds for every choice of objects, or for some.
    Quantified {
        every: bool,
        variables: Vec<Parameter>,
        body: Vec<Self>,
    },
}

impl Condition {
    /// Its opposite.
    pub(super) fn negated(self) -> Self {
        match self {
            Self::Holds { atom, negated } => Self::Holds { atom, negated: !negated },
            Self::Equal { pair, negated } => Self::Equal { pair, negated: !negated },
            // Of each case something fails: one case of so many parts.
            Self::Any(cases) => Self::Any(vec![cases.into_iter().map(none_of).collect()]),
            Self::Quantified { every, variables, body } => {
                Self::Quantified { every: !every, variables, body: vec![none_of(body)] }
            }
        }
    }

    /// Every atom in it, with the variables bound around it, the inner ones last.
    pub(super) fn for_each_atom<'a>(
        &'a self,
        bound: &mut Vec<&'a Parameter>,
        f: &mut dyn FnMut(&'a Atom, &[&'a Parameter]),
    ) {
        match self {
            Self::Holds { atom, .. } => f(atom, bound),
            Self::Equal { .. } => {}
            Self::Any(cases) => cases.iter().flatten().for_each(|c| c.for_each_atom(bound, f)),
            Self::Quantified { variables, body, .. } => {
                let before = bound.len();
                bound.extend(variables);
                body.iter().for_each(|condition| condition.for_each_atom(bound, f));
                bound.truncate(before);
            }
        }
    }

    /// The first name in it, for faults.
    pub(super) fn first_name(&self) -> Option<&Name> {
        match self {
            Self::Holds { atom, .. } => Some(&atom.predicate),
            Self::Equal { pair, .. } => Some(&pair.0.name),
            Self::Any(cases) => cases.iter().flatten().find_map(Self::first_name),
            Self::Quantified { variables, body, .. } => variables
                .first()
                .map(|parameter| &parameter.variable)
                .or_else(|| body.iter().find_map(Self::first_name)),
        }
    }
}

/// That a conjunction does not hold.
pub(super) fn none_of(conjunction: Vec<Condition>) -> Condition {
    Condition::Any(conjunction.into_iter().map(|condition| vec![condition.negated()]).collect())
}

/// What an action brings about where a condition holds before it, for every choice of objects.
#[derive(Debug, Clone)]
pub(super) struct ConditionalText {
    pub(super) variables: Vec<Parameter>,
    pub(super) condition: Vec<Condition>,
    pub(super) add: Vec<Atom>,
    pub(super) del: Vec<Atom>,
}

/// `(:derived (above ?x ?y) condition)`: the atom holds where the condition does, and only there.
#[derive(Debug, Clone)]
pub(super) struct DerivedText {
    pub(super) parameters: Vec<Parameter>,
    pub(super) atom: Atom,
    pub(super) condition: Vec<Condition>,
}

/// A variable with the types it may take; none means any.
#[derive(Debug, Clone)]
pub(super) struct Parameter {
    pub(super) kinds: Vec<Name>,
    pub(super) variable: Name,
}

/// A cost as a text writes it, in thousandths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Amount(u64);

/// A cost beyond it would overflow the sum over a plan.
const MAX_COST: u64 = 1_000_000;

impl Amount {
    pub(super) const NOTHING: Self = Self(0);

    /// None for what is no number from zero to [`MAX_COST`], or has more than three decimals that count.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let (whole, decimals) = text.split_once('.').unwrap_or((text, ""));
        let decimals = decimals.trim_end_matches('0');
        let is_number = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
        if whole.is_empty() || !is_number(whole) || !is_number(decimals) || decimals.len() > 3 {
            return None;
        }
        let thousandths = format!("{whole}{decimals:0<3}").parse().ok()?;
        (thousandths <= MAX_COST * 1000).then_some(Self(thousandths))
    }

    /// In units of which `unit` are one.
    pub(super) fn in_units(self, unit: u32) -> u32 {
        u32::try_from(self.0 * u64::from(unit) / 1000).expect("a cost is bounded")
    }

    pub(super) const ONE: Self = Self(1000);

    /// In thousandths.
    pub(super) fn thousandths(self) -> u64 {
        self.0
    }

    fn is_whole(self) -> bool {
        self.0.is_multiple_of(1000)
    }
}

/// `(preference name condition)`: its condition is a disjunction of one case, so that it is met as a whole.
#[derive(Debug, Clone)]
pub(super) struct PreferenceText {
    pub(super) name: Name,
    pub(super) condition: Condition,
}

/// What carrying out an action costs.
#[derive(Debug, Clone)]
pub(super) enum CostTerm {
    Number(Amount),
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
    pub(super) conditional: Vec<ConditionalText>,
    pub(super) cost: Vec<CostTerm>,
}

impl ActionText {
    pub(super) fn new(name: Name) -> Self {
        Self {
            name,
            parameters: Vec::new(),
            precondition: Vec::new(),
            add: Vec::new(),
            del: Vec::new(),
            renewed: Vec::new(),
            conditional: Vec::new(),
            cost: Vec::new(),
        }
    }

    /// Every atom of its conditions and effects, with the variables bound around it.
    pub(super) fn for_each_atom<'a>(&'a self, f: &mut dyn FnMut(Use, &'a Atom, &[&'a Parameter])) {
        let mut bound: Vec<&Parameter> = self.parameters.iter().collect();
        for condition in &self.precondition {
            condition.for_each_atom(&mut bound, &mut |atom, bound| f(Use::Asked, atom, bound));
        }
        self.add.iter().for_each(|atom| f(Use::Added, atom, &bound));
        self.del.iter().for_each(|atom| f(Use::Deleted, atom, &bound));
        for part in &self.conditional {
            let before = bound.len();
            bound.extend(&part.variables);
            for condition in &part.condition {
                condition.for_each_atom(&mut bound, &mut |atom, bound| f(Use::Asked, atom, bound));
            }
            part.add.iter().for_each(|atom| f(Use::Added, atom, &bound));
            part.del.iter().for_each(|atom| f(Use::Deleted, atom, &bound));
            bound.truncate(before);
        }
    }
}

/// Whether an action asks for an atom, gives or takes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Use {
    Asked,
    Added,
    Deleted,
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

/// `ДВЕРЬ_ИЗ_В_ОТКРЫТА_(?y, ?x, ?z) = DOOR-OPEN = «?y is open»`: how a predicate, an action or a type is said in a language,
/// and what a text may call it.
#[derive(Debug, Clone)]
pub(super) struct PhraseText {
    pub(super) language: Language,
    pub(super) negated: bool,
    pub(super) name: Name,
    /// None for a type.
    pub(super) parameters: Option<Vec<Name>>,
    pub(super) second: Option<Name>,
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
    pub(super) derived: Vec<DerivedText>,
    pub(super) facts: Vec<Condition>,
    pub(super) assumptions: Vec<Condition>,
    pub(super) values: Vec<(Atom, Amount)>,
    /// Numbers that a problem gives, as declared (PDDL).
    pub(super) functions: Vec<Signature>,
    pub(super) goal: Vec<Condition>,
    /// The goal was stated and asks for nothing, as `(:goal (and))` does.
    pub(super) goal_is_empty: bool,
    /// What is wanted where it can be had.
    pub(super) preferences: Vec<PreferenceText>,
    /// What it costs that a preference is not met, where the metric says so.
    pub(super) violations: Option<Vec<(Name, Amount)>>,
    pub(super) map: Option<Name>,
    pub(super) phrases: Vec<PhraseText>,
    /// What a PDDL domain calls itself, and what its problem calls it.
    pub(super) domain_names: (Option<Name>, Option<Name>),
    pub(super) warnings: Vec<RuleFault>,
}

impl Document {
    /// How many units of cost are one: one, or a thousand where some cost has decimals.
    pub(super) fn cost_unit(&self) -> u32 {
        let costs =
            self.actions.iter().flat_map(|action| &action.cost).filter_map(|cost| match cost {
                CostTerm::Number(amount) => Some(*amount),
                CostTerm::Function(_) => None,
            });
        let mut all = costs.chain(self.values.iter().map(|(_, amount)| *amount));
        if all.all(Amount::is_whole) { 1 } else { 1000 }
    }

    /// What is wanted, come what may or where it can be had.
    pub(super) fn wanted(&self) -> impl Iterator<Item = &Condition> {
        self.goal.iter().chain(self.preferences.iter().map(|preference| &preference.condition))
    }

    /// Every atom of the rules, with the variables bound around it.
    pub(super) fn each_atom_of_rules<'a>(&'a self, f: &mut dyn FnMut(&'a Atom, &[&'a Parameter])) {
        for action in &self.actions {
            action.for_each_atom(&mut |_, atom, bound| f(atom, bound));
        }
        for rule in &self.derived {
            let mut bound: Vec<&Parameter> = rule.parameters.iter().collect();
            f(&rule.atom, &bound);
            rule.condition.iter().for_each(|condition| condition.for_each_atom(&mut bound, f));
        }
    }

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
        self.derived.extend(other.derived);
        self.facts.extend(other.facts);
        self.assumptions.extend(other.assumptions);
        self.values.extend(other.values);
        self.functions.extend(other.functions);
        self.goal.extend(other.goal);
        self.goal_is_empty |= other.goal_is_empty;
        self.preferences.extend(other.preferences);
        if let Some(more) = other.violations {
            self.violations.get_or_insert_default().extend(more);
        }
        self.map = self.map.take().or(other.map);
        self.phrases.extend(other.phrases);
        self.warnings.extend(other.warnings);
    }
}
