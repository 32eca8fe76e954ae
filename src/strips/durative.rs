//! Actions that last (M. Fox, D. Long: PDDL 2.1, level 3 without numbers), as actions of one piece.
//!
//! An action that goes from its start to its end before or after every other that it touches is one of the language without
//! time: it needs what is asked at the start, and what is asked later and its own start does not give; it leaves what
//! its end leaves. So every plan of such actions is a plan in time. The reverse does not hold: a plan that needs one
//! action to go on within another is not found, which a warning says. The duration is a cost.
//!
//! PDDL and rule files alike are read into a [`Lasting`], and that into one piece.

use miette::SourceSpan;

use super::error::RuleError;
use super::expression::Expression;
use super::fault::RuleFault;
use super::pddl::{Reader, atom_key, renew};
use super::syntax::{ActionText, Atom, Condition, CostTerm, Name, Term};
use crate::units::{Source, word};

/// When something is asked, or comes about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Time {
    Start,
    Throughout,
    End,
}

impl Reader<'_> {
    pub(super) fn durative_action(&mut self, section: &Expression<'_>) {
        let items = section.items();
        let Some(Expression::Word(name, span)) = items.get(1) else {
            return self.expected(word!("the-name-of-an-action"), section.span());
        };
        let name = Name::new(name, self.source, *span);
        let mut action = ActionText::new(name);
        let mut lasting = Lasting::new(&action, section.head_span());
        let mut rest = items[2..].iter();
        while let (Some(key), Some(body)) = (rest.next(), rest.next()) {
            let Expression::Word(word, span) = key else {
                self.expected(word!("condition-or-effect"), key.span());
                continue;
            };
            match word.to_lowercase().as_str() {
                ":parameters" => action.parameters.extend(self.variables(body.items())),
                ":duration" => self.duration(body, &mut action),
                ":condition" => self.timed_conditions(body, &mut action, &mut lasting.later),
                ":effect" => self.timed_effects(body, &mut lasting.start, &mut action),
                other => self.unsupported(other, *span),
            }
        }
        lasting.into_one_piece(self.source, &mut action, &mut self.document.warnings, self.faults);
        self.document.actions.push(action);
    }

    /// `(= ?duration 5)`, `(= ?duration (road-length ?a ?b))`
    fn duration(&mut self, body: &Expression<'_>, action: &mut ActionText) {
        let is_fixed = body.head().as_deref() == Some("=")
            && matches!(body.items().get(1), Some(Expression::Word(word, _)) if word.eq_ignore_ascii_case("?duration"));
        match (is_fixed, body.items()) {
            (true, [_, _, Expression::Word(text, span)]) => {
                action.cost.extend(self.number(text, *span).map(CostTerm::Number));
            }
            (true, [_, _, list @ Expression::List(items, _)])
                if items.iter().all(|item| matches!(item, Expression::Word(..)))
                    && !matches!(list.head().as_deref(), Some("*" | "/" | "+" | "-")) =>
            {
                action.cost.extend(self.atom(list).map(CostTerm::Function));
            }
            _ => self.expected(word!("duration-number-or-duration-function"), body.span()),
        }
    }

    fn time(part: &Expression<'_>) -> Option<Time> {
        let [Expression::Word(first, _), Expression::Word(second, _), _] = part.items() else {
            return None;
        };
        match (first.to_lowercase().as_str(), second.to_lowercase().as_str()) {
            ("at", "start") => Some(Time::Start),
            ("over", "all") => Some(Time::Throughout),
            ("at", "end") => Some(Time::End),
            _ => None,
        }
    }

    fn timed_conditions(
        &mut self,
        part: &Expression<'_>,
        action: &mut ActionText,
        later: &mut Vec<Condition>,
    ) {
        let items = part.items();
        match (Self::time(part), part.head().as_deref()) {
            (Some(Time::Start), _) => self.condition(&items[2], false, &mut action.precondition),
            (Some(_), _) => self.condition(&items[2], false, later),
            (None, Some("and")) => {
                items[1..].iter().for_each(|p| self.timed_conditions(p, action, later));
            }
            (None, None) if items.is_empty() => {}
            _ => self.expected(word!("at-start-over-all-or-at-end"), part.span()),
        }
    }

    fn timed_effects(
        &mut self,
        part: &Expression<'_>,
        start: &mut ActionText,
        end: &mut ActionText,
    ) {
        let items = part.items();
        match (Self::time(part), part.head().as_deref()) {
            (Some(Time::Start), _) => self.effect(&items[2], start),
            (Some(Time::End), _) => self.effect(&items[2], end),
            (None, Some("and")) => {
                items[1..].iter().for_each(|p| self.timed_effects(p, start, end));
            }
            (None, Some(what @ ("forall" | "when"))) => self.unsupported(what, part.head_span()),
            (None, None) if items.is_empty() => {}
            _ => self.expected(word!("at-start-or-at-end"), part.span()),
        }
    }
}

/// What an action that lasts does at its start, and asks later; the rest stands in its text: what it asks at the start, and
/// what its end leaves.
pub(super) struct Lasting {
    at: SourceSpan,
    pub(super) start: ActionText,
    pub(super) later: Vec<Condition>,
}

impl Lasting {
    /// Of an action that lasts, as it is told at a place.
    pub(super) fn new(action: &ActionText, at: SourceSpan) -> Self {
        Self { at, start: ActionText::new(action.name.clone()), later: Vec::new() }
    }

    /// Makes one piece of the action. That it is planned whole a warning says, once in a text.
    pub(super) fn into_one_piece(
        self,
        source: &Source,
        action: &mut ActionText,
        warnings: &mut Vec<RuleFault>,
        faults: &mut Vec<RuleFault>,
    ) {
        let Self { at, start, later } = self;
        let is_told = |fault: &RuleFault| matches!(*fault.error, RuleError::Durations { .. });
        if !warnings.iter().any(is_told) {
            warnings.push(RuleFault::new(source, RuleError::Durations { at }));
        }
        ask_later(
            &start,
            later,
            action,
            &mut |error| faults.push(RuleFault::new(source, error)),
            at,
        );
        // Of what the start adds and the end deletes by other names, nobody can say here whether it is the same.
        for added in &start.add {
            let apart = action.del.iter().filter_map(|deleted| apart(added, deleted));
            action.precondition.extend(apart);
        }
        // What the start adds and the end deletes is gone; what the end adds is there, whatever the start did.
        let gone: Vec<Vec<String>> = action.del.iter().map(atom_key).collect();
        let there: Vec<Vec<String>> = action.add.iter().map(atom_key).collect();
        let lasts = |key: &Vec<String>| !gone.contains(key) || there.contains(key);
        let added = start.add.into_iter().filter(|atom| lasts(&atom_key(atom)));
        action.add.splice(..0, added);
        action.del.splice(..0, start.del);
        action.conditional.splice(..0, start.conditional);
        renew(action);
    }
}

/// What is asked while the action goes on is asked before it, but for what its start gives; what its start takes
/// away can never be had later.
fn ask_later(
    start: &ActionText,
    later: Vec<Condition>,
    action: &mut ActionText,
    fault: &mut dyn FnMut(RuleError),
    at: SourceSpan,
) {
    let given: Vec<Vec<String>> = start.add.iter().map(atom_key).collect();
    let taken: Vec<Vec<String>> = start.del.iter().map(atom_key).collect();
    let touched: Vec<String> =
        start.add.iter().chain(&start.del).map(|atom| atom.predicate.key()).collect();
    for condition in later {
        if let Condition::Holds { atom, negated } = &condition {
            let key = atom_key(atom);
            let (is_given, is_taken) = (given.contains(&key), taken.contains(&key));
            // Adding comes last, at the start as well.
            let (holds, fails) = match negated {
                false => (is_given, is_taken && !is_given),
                true => (is_taken && !is_given, is_given),
            };
            if fails {
                let name = action.name.text.clone();
                let atom = super::check::text_of(atom);
                fault(RuleError::ContradictoryPrecondition { action: name, atom, at });
            }
            if holds || fails {
                continue;
            }
            // What would take it away by other names is to be something else.
            let takers = if *negated { &start.add } else { &start.del };
            action.precondition.extend(takers.iter().filter_map(|taker| apart(atom, taker)));
        }
        // What only other objects might touch, nobody can say here.
        let mut is_touched = false;
        condition.for_each_atom(&mut Vec::new(), &mut |atom, _| {
            is_touched |= touched.contains(&atom.predicate.key());
        });
        let is_literal = matches!(condition, Condition::Holds { .. } | Condition::Equal { .. });
        if is_touched && !is_literal {
            fault(RuleError::LastingCompound { at });
        }
        action.precondition.push(condition);
    }
    // The same may be asked at the start and throughout.
    let mut known: Vec<(Vec<String>, bool)> = Vec::new();
    action.precondition.retain(|condition| match condition {
        Condition::Holds { atom, negated } => {
            let one = (atom_key(atom), *negated);
            let is_new = !known.contains(&one);
            known.push(one);
            is_new
        }
        _ => true,
    });
}

/// That two atoms of different names are not one; none where they cannot be, or are the same by name.
fn apart(one: &Atom, other: &Atom) -> Option<Condition> {
    if one.predicate.key() != other.predicate.key()
        || one.args.len() != other.args.len()
        || atom_key(one) == atom_key(other)
    {
        return None;
    }
    let pairs = one.args.iter().zip(&other.args).filter(|(a, b)| a.name.key() != b.name.key());
    let differ = |(a, b): (&Term, &Term)| Condition::Equal {
        pair: Box::new((a.clone(), b.clone())),
        negated: true,
    };
    let mut cases: Vec<Vec<Condition>> = pairs.map(|pair| vec![differ(pair)]).collect();
    match cases.len() {
        1 => cases.swap_remove(0).pop(),
        _ => Some(Condition::Any(cases)),
    }
}
