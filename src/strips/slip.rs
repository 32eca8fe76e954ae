//! Misspelt names that no declaration catches: in rules that declare no predicates the slip would silently become
//! a predicate of its own.
//!
//! A misspelt name stands alone: one action speaks of it and nothing else does, neither an effect, a fact nor a
//! goal. Alone are also predicates that only a map supplies, so standing alone is no fault; it is reported when
//! another predicate of as many arguments, used elsewhere, is a slip of the pen away. Names that differ only in
//! letters that look alike, or in `-` for `_`, are never meant as two: that is a fault, the rest a warning.

use std::collections::BTreeMap;

use super::error::RuleError;
use super::fault::RuleFault;
use super::hint::{hint, looks_the_same, perhaps};
use super::syntax::{ActionText, Atom, Condition, Document, Name, Use};
use crate::units::{Gather as _, name_key, said};

/// Where a predicate is spoken of.
struct Uses<'a> {
    first: &'a Name,
    arity: usize,
    /// The one action that speaks of it; none when several do, or a fact or the goal.
    alone_in: Option<&'a ActionText>,
    is_asked: bool,
    is_given: bool,
}

/// Appends what looks misspelt to `faults` and `warnings`.
pub(super) fn slips(
    document: &Document,
    faults: &mut Vec<RuleFault>,
    warnings: &mut Vec<RuleFault>,
) {
    parents(document, warnings);
    if document.predicates_closed {
        return;
    }
    let predicates = uses(document);
    for uses in predicates.values() {
        // What one action gives and the same action asks for is a matter of its own.
        let Some(action) = uses.alone_in.filter(|_| uses.is_asked != uses.is_given) else {
            continue;
        };
        let name = &uses.first.text;
        let others = || {
            predicates.values().filter(|other| {
                other.arity == uses.arity && !std::ptr::eq(*other, uses) && !is_alone(other, action)
            })
        };
        let same =
            others().map(|other| &other.first.text).find(|other| reads_the_same(other, name));
        let near = others().map(|other| &other.first.text).find(|other| is_slip(other, name));
        if let Some(same) = same {
            let help = hint(name, [same.as_str()]);
            let error = |at| RuleError::UnknownPredicate { name: name.clone(), help, at };
            faults.push(uses.first.fault(error));
        } else if let Some(near) = near {
            let help = Some(said!("perhaps-if-not-declare-the-predicates-under", near));
            let action = action.name.text.clone();
            let error = |at| RuleError::LonelyPredicate { name: name.clone(), action, help, at };
            warnings.push(uses.first.fault(error));
        }
    }
}

/// A parent type that nobody declares is let be, as PDDL files have it, unless it looks like one that is declared.
fn parents(document: &Document, warnings: &mut Vec<RuleFault>) {
    let declared: BTreeMap<String, &Name> =
        document.types.iter().flatten().map(|t| (t.name.key(), &t.name)).gather();
    for parent in document.types.iter().flatten().flat_map(|declaration| &declaration.kinds) {
        if declared.contains_key(&parent.key()) {
            continue;
        }
        if let Some(near) = declared.values().find(|name| is_slip(&name.text, &parent.text)) {
            let (name, help) = (parent.text.clone(), perhaps(&near.text));
            let error = |at| RuleError::LonelyType { name, help, at };
            warnings.push(parent.fault(error));
        }
    }
}

/// Two slips in one action do not explain each other.
fn is_alone(uses: &Uses<'_>, action: &ActionText) -> bool {
    uses.alone_in.is_some_and(|alone| std::ptr::eq(alone, action))
}

fn uses(document: &Document) -> BTreeMap<String, Uses<'_>> {
    let mut predicates: BTreeMap<String, Uses<'_>> = BTreeMap::new();
    for action in &document.actions {
        action.for_each_atom(&mut |used, atom, _| {
            add(&mut predicates, atom, Some(action), used != Use::Added, used == Use::Added);
        });
    }
    for rule in &document.derived {
        add(&mut predicates, &rule.atom, None, false, true);
        atoms_of(&rule.condition, &mut |atom| add(&mut predicates, atom, None, true, false));
    }
    for facts in [&document.facts, &document.assumptions] {
        atoms_of(facts, &mut |atom| add(&mut predicates, atom, None, false, true));
    }
    atoms_of(&document.goal, &mut |atom| add(&mut predicates, atom, None, true, false));
    predicates
}

/// Every atom of the conditions.
fn atoms_of<'a>(conditions: &'a [Condition], f: &mut dyn FnMut(&'a Atom)) {
    for condition in conditions {
        condition.for_each_atom(&mut Vec::new(), &mut |atom, _| f(atom));
    }
}

fn add<'a>(
    predicates: &mut BTreeMap<String, Uses<'a>>,
    atom: &'a Atom,
    action: Option<&'a ActionText>,
    is_asked: bool,
    is_given: bool,
) {
    let uses = predicates.entry(atom.predicate.key()).or_insert_with(|| Uses {
        first: &atom.predicate,
        arity: atom.args.len(),
        alone_in: action,
        is_asked: false,
        is_given: false,
    });
    let still = match (uses.alone_in, action) {
        (Some(known), Some(action)) => std::ptr::eq(known, action),
        _ => false,
    };
    uses.alone_in = uses.alone_in.filter(|_| still);
    uses.is_asked |= is_asked;
    uses.is_given |= is_given;
}

/// Words of a name, as hyphens and underscores part them.
fn words(key: &str) -> Vec<&str> {
    key.split(['-', '_']).collect()
}

/// Whether a reader would take the two for one name.
fn reads_the_same(a: &str, b: &str) -> bool {
    looks_the_same(a, b) || words(&name_key(a)).concat() == words(&name_key(b)).concat()
}

/// Whether two names differ by a letter or two in one long word. Short words are told apart by a letter on purpose,
/// as `НАХОДИТСЯ-В` and `НАХОДИТСЯ-У` are.
fn is_slip(a: &str, b: &str) -> bool {
    const LONG: usize = 4;
    const LONGER: usize = 8;
    let (a, b) = (name_key(a), name_key(b));
    let (a, b) = (words(&a), words(&b));
    let mut different = a.iter().zip(&b).filter(|(a, b)| a != b);
    let (Some((x, y)), None) = (different.next(), different.next()) else { return false };
    let (short, distance) =
        (x.chars().count().min(y.chars().count()), strsim::damerau_levenshtein(x, y));
    a.len() == b.len() && (short >= LONG && distance == 1 || short >= LONGER && distance == 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_word_is_another_predicate() {
        assert!(!is_slip("ДВЕРЬ_ОТКРЫТА", "ДВЕРЬ_ЗАКРЫТА"));
        assert!(!is_slip("at", "in"));
    }
}
