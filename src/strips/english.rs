//! What is wrong with a rule file, a scenario, a PDDL file or a plan, in English.

use std::fmt;

use miette::Diagnostic;

use super::error::RuleError;
use super::fault::{RuleFault, RuleFaults};
use crate::units::{Bilingual, English, InEnglish, Language};

fn en(words: &Bilingual) -> &str {
    words.say(Language::English)
}

/// A fact as English has it: only a negation is worded.
fn shown(fact: &str) -> String {
    fact.strip_prefix("НЕ ").map_or_else(|| fact.to_owned(), |fact| format!("NOT {fact}"))
}

impl RuleError {
    /// The fault in English.
    #[must_use]
    pub fn english(&self) -> String {
        match self {
            Self::Unreadable { path, reason } => {
                format!("the file “{path}” cannot be read: {}", en(reason))
            }
            Self::NotText { path, offset } => {
                format!("the file “{path}” is no UTF-8 text: byte {offset} cannot be read")
            }
            Self::TooLarge { path, bytes, limit } => {
                format!("the file “{path}” is too large: {bytes} bytes, the limit is {limit}")
            }
            Self::Empty { path } => format!("the file “{path}” is empty"),
            Self::UnexpectedCharacter { sign, .. } => format!("unexpected sign “{sign}”"),
            Self::Syntax { expected, found, .. } => {
                format!("{} is expected, and {} stands here", en(expected), en(found))
            }
            Self::UnknownHeading { heading, .. } => format!("unknown section “{heading}”"),
            Self::MissingParenthesis { .. } => "a bracket is not closed".to_owned(),
            Self::SurplusParenthesis { .. } => "one closing bracket too many".to_owned(),
            Self::TooDeep { limit, .. } => {
                format!("brackets within brackets deeper than {limit} levels")
            }
            Self::Unsupported { what, .. } => format!("“{what}” is not read"),
            Self::Requirement { name, .. } => {
                format!("the requirement “{name}” is wider than what is read")
            }
            Self::EarlyEnd { next, .. } => {
                format!("“(define …)” is closed here, and {} follows", en(next))
            }
            Self::NotAssumed { fact, is_fact, .. } => {
                let fact_it_is = if *is_fact { " (it is a fact)" } else { "" };
                format!("there is no such assumption: {fact}{fact_it_is}")
            }
            Self::NotBelieved { fact, .. } => {
                format!("neither the map nor the robot knows this: {}", shown(fact))
            }
            Self::NotDriven { fact, .. } => {
                format!("the robot cannot bring this about: {}", shown(fact))
            }
            Self::UnknownType { name, .. } => format!("unknown type “{name}”"),
            Self::TypeCycle { name, .. } => format!("the type “{name}” inherits from itself"),
            Self::UnknownPredicate { name, .. } => format!("unknown predicate “{name}”"),
            Self::LonelyPredicate { name, action, .. } => format!(
                "the predicate “{name}” occurs in the action “{action}” alone – a slip of the pen?"
            ),
            Self::LonelyType { name, .. } => {
                format!("the type “{name}” is not declared – a slip of the pen?")
            }
            Self::UnknownFunction { name, .. } => format!("unknown function “{name}”"),
            Self::OtherDomain { wanted, found, .. } => {
                format!("the problem is of the domain “{wanted}”, and “{found}” was read")
            }
            Self::Metric { metric, .. } => format!("the metric “{metric}” is not heeded"),
            Self::UnknownPreference { name, .. } => format!("unknown preference “{name}”"),
            Self::Arity { name, expected, found, .. } => {
                let s = if *expected == 1 { "" } else { "s" };
                format!("“{name}” takes {expected} argument{s}, not {found}")
            }
            Self::UndeclaredVariable { action, variable, .. } => {
                format!("action “{action}”: the variable “{variable}” is not declared")
            }
            Self::VariableInFact { variable, .. } => {
                format!("the variable “{variable}” stands outside an action")
            }
            Self::Duplicate { what, name, .. } => {
                format!("{} “{name}” is declared a second time", en(what))
            }
            Self::SecondNameOfAction { name, .. } => {
                format!("“{name}” is an action: predicates and types may have a second name")
            }
            Self::ObjectTwice { name, found, earlier, .. } => format!(
                "the object “{name}” is declared twice: here as “{}”, and before as “{}”",
                en(found),
                en(earlier)
            ),
            Self::PhraseVariable { variable, .. } => {
                format!("“{variable}” stands in the words, and not among the arguments")
            }
            Self::ContradictoryEffect { action, atom, .. } => {
                format!("action “{action}” contradicts itself: it both adds and deletes “{atom}”")
            }
            Self::ContradictoryPrecondition { action, atom, .. } => {
                format!("action “{action}” contradicts itself: it both needs and forbids “{atom}”")
            }
            Self::ArgumentType { name, number, expected, term, found, .. } => format!(
                "“{name}”: argument {number} is to be of type “{}”, and “{term}” is of type “{}”",
                en(expected),
                en(found)
            ),
            Self::VariableType { variable, declared, found, .. } => format!(
                "the variable “{variable}” is declared as “{}”, and called “{found}” here",
                en(declared)
            ),
            Self::UnknownObject { name, .. } => format!("unknown object “{name}”"),
            Self::ObjectType { name, found, earlier, .. } => format!(
                "the object “{name}” is of type “{}” here, and of type “{}” elsewhere",
                en(found),
                en(earlier)
            ),
            Self::ContradictoryFact { atom, .. } => {
                format!("“{atom}” is both stated and denied")
            }
            Self::IncludeCycle { .. } => "the file includes itself".to_owned(),
            Self::Include { path, reason, .. } => {
                format!("the file “{path}” cannot be included: {}", en(reason))
            }
            Self::Cost { text, .. } => format!("“{text}” is no cost"),
            Self::NoGoal => "the scenario has no goal".to_owned(),
            Self::NoActions => "there is not one action".to_owned(),
            Self::UnknownAction { name, .. } => format!("unknown action “{name}”"),
            Self::WrongObject { name, expected, .. } => {
                format!("“{name}” does not fit: an object of type “{}” is due here", en(expected))
            }
            Self::PlanPrecondition { fact, .. } => {
                format!("the action cannot be carried out: it takes {}", shown(fact))
            }
            Self::PlanInterference { fact, other, .. } => format!(
                "two actions of one step disturb each other: because of {} it does not go with “{other}”",
                shown(fact)
            ),
            Self::PlanMissesGoal { fact } => {
                format!("in the end the goal {} does not hold", shown(fact))
            }
            Self::TooManyOperators { megabytes } => format!(
                "the actions of the rules over these objects do not fit into {megabytes} MiB of memory"
            ),
            Self::TooManyCases { of, limit } => {
                format!("the conditions of “{of}” fall into more than {limit} cases")
            }
            Self::LastingCompound { .. } => {
                "while an action lasts plain facts can be asked: its start touches what the condition asks".to_owned()
            }
            Self::Durations { .. } => {
                "actions that last are planned whole, one after another; steps are counted in these actions, and a duration is a cost".to_owned()
            }
            Self::DerivedStated { name, .. } => format!(
                "“{name}” is derived by a rule: it can neither be stated nor changed by an action"
            ),
            Self::DerivedByAbsence { name, .. } => {
                format!("“{name}” is derived from “{name}” not being derived")
            }
            Self::NoPrice { action, more } => {
                let more = if *more == 0 { String::new() } else { format!(" (and {more} more)") };
                format!(
                    "the problem does not say what {action}{more} costs: it is taken to be free"
                )
            }
        }
    }

    /// The remedy in English.
    fn english_help(&self) -> Option<&str> {
        Some(match self {
            Self::Unreadable { .. } => "check the path and the permissions",
            Self::NotText { .. } => "save the file as text in UTF-8",
            Self::TooLarge { .. } => {
                "divide the file and include its parts: “Include: part.strips”"
            }
            Self::Empty { .. } => {
                "a rule file consists of sections “Action: …”, a scenario of “Initial: …” and “Goal: …”"
            }
            Self::UnexpectedCharacter { .. } => {
                "names with such signs stand in quotation marks: \"name\""
            }
            Self::MissingParenthesis { .. } => "put “)” before the next section",
            Self::SurplusParenthesis { .. } => "it can be removed",
            Self::TooDeep { .. } => "simplify the expression",
            Self::Requirement { .. } => {
                ":strips :typing :negative-preconditions :equality :action-costs are read; what goes beyond is told where it stands"
            }
            Self::EarlyEnd { .. } => "remove the “)” too many here or before",
            Self::TypeCycle { .. } => "break the circle of inheritance under “Types:”",
            Self::OtherDomain { .. } => {
                "check that --domain and --problem name the files that belong together"
            }
            Self::Metric { .. } => {
                "(:metric minimize (total-cost)) is heeded, so is (+ (* 3 (is-violated name)) …); without it the plan is one of the fewest steps"
            }
            Self::VariableInFact { .. } => "in facts and goals stand names of objects",
            Self::ContradictoryEffect { .. } => "leave the fact in one of “Effect+”, “Effect-”",
            Self::ContradictoryPrecondition { .. } => "remove one of the two",
            Self::VariableType { .. } => "call the type as the parameters do",
            Self::ObjectType { .. } => {
                "declare the object’s type under “Objects:”, or correct the fact"
            }
            Self::ContradictoryFact { .. } => "keep one of the two",
            Self::IncludeCycle { .. } => "remove this inclusion",
            Self::Include { .. } => {
                "the path is seen from the folder of the file in which “Include” stands"
            }
            Self::Cost { .. } => {
                "a cost is a number from 0 to 1000000 with no more than three decimals"
            }
            Self::NoGoal => "add a section “Goal: …”, in PDDL “(:goal …)”",
            Self::NoActions => "include a rule file: “Include: ../service-robot.strips”",
            Self::PlanInterference { .. } => "put them into different steps",
            Self::TooManyOperators { .. } => {
                "give the rules preconditions that tie their parameters together, or use fewer objects"
            }
            Self::TooManyCases { .. } => {
                "divide the action into several, or use fewer objects under “forall” and “when”"
            }
            Self::LastingCompound { .. } => {
                "divide the condition into facts, or ask it at the start"
            }
            Self::Durations { .. } => {
                "a plan that needs one action to go on within another is not found this way"
            }
            Self::DerivedStated { .. } => "remove this, or the rule that derives it",
            Self::DerivedByAbsence { .. } => {
                "break the circle: a negation under a derived predicate must not lead back to it"
            }
            Self::NoPrice { .. } => "give its value in :init: (= (function object …) number)",
            Self::SecondNameOfAction { .. } => "remove it; the words in quotation marks stay",
            Self::LonelyType { help, .. }
            | Self::Unsupported { help, .. }
            | Self::Arity { help, .. }
            | Self::Duplicate { help, .. }
            | Self::ObjectTwice { help, .. }
            | Self::NotDriven { help, .. }
            | Self::ArgumentType { help, .. } => en(help),
            Self::UnknownHeading { help, .. }
            | Self::NotAssumed { help, .. }
            | Self::NotBelieved { help, .. }
            | Self::UnknownType { help, .. }
            | Self::UnknownPredicate { help, .. }
            | Self::UnknownPreference { help, .. }
            | Self::LonelyPredicate { help, .. }
            | Self::UnknownFunction { help, .. }
            | Self::UndeclaredVariable { help, .. }
            | Self::PhraseVariable { help, .. }
            | Self::UnknownObject { help, .. }
            | Self::UnknownAction { help, .. } => return help.as_ref().map(en),
            Self::Syntax { .. }
            | Self::WrongObject { .. }
            | Self::PlanPrecondition { .. }
            | Self::PlanMissesGoal { .. } => return None,
        })
    }

    /// What its labels say in English, in their order.
    fn english_labels(&self) -> [&'static str; 2] {
        let first = match self {
            Self::MissingParenthesis { .. } => "opened here",
            Self::EarlyEnd { .. } => "closed here",
            Self::Duplicate { .. } | Self::ObjectTwice { .. } => "the second time here",
            Self::ContradictoryEffect { .. } => "deleted here",
            Self::ContradictoryPrecondition { .. } => "forbidden here",
            Self::ContradictoryFact { .. } => "denied here",
            Self::PlanPrecondition { .. } | Self::PlanInterference { .. } => {
                "here the plan breaks off"
            }
            _ => "here",
        };
        [first, "the first time here"]
    }
}

impl InEnglish for RuleFault {
    fn english(&self) -> String {
        let place = self.position();
        let place = place.map(|(name, line, column)| format!("{name}:{line}:{column}: "));
        place.unwrap_or_default() + &self.error.english()
    }
    fn english_help(&self) -> Option<String> {
        self.error.english_help().map(str::to_owned)
    }
    fn english_labels(&self) -> [&'static str; 2] {
        self.error.english_labels()
    }
}

/// Faults as English tells them.
#[derive(Debug, Clone)]
pub struct EnglishFaults<'f>(Vec<English<'f, RuleFault>>);

impl<'f> From<&'f RuleFaults> for EnglishFaults<'f> {
    fn from(faults: &'f RuleFaults) -> Self {
        Self(faults.0.iter().map(English).collect())
    }
}

impl fmt::Display for EnglishFaults<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.as_slice() {
            [only] => only.fmt(f),
            many => {
                write!(f, "{} faults are found", many.len())?;
                many.iter().try_for_each(|fault| write!(f, "\n  {fault}"))
            }
        }
    }
}

impl std::error::Error for EnglishFaults<'_> {}

impl Diagnostic for EnglishFaults<'_> {
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.0.iter().map(|fault| fault as &dyn Diagnostic)))
    }
}
