//! The phrases that a document gives, read.

use super::domain::Domain;
use super::error::RuleError;
use super::fault::RuleFault;
use super::hint::hint;
use super::phrase::{Part, Phrase, Phrases};
use super::syntax::{Document, Name};
use crate::units::{name_key, said};

/// How the document says its predicates, actions and types in words.
pub(super) fn phrases(
    document: &Document,
    domain: &Domain,
    faults: &mut Vec<RuleFault>,
) -> Phrases {
    let mut phrases = Phrases::default();
    for text in &document.phrases {
        let (name, key) = (&text.name, text.name.key());
        let vocabulary = phrases.of_mut(text.language);
        let schema = domain.schemas.iter().find(|schema| name_key(&schema.name) == key);
        let predicate = domain.predicate(name.first());
        let Some(parameters) = &text.parameters else {
            if domain.kind(name.first()).is_some() {
                vocabulary.kinds.insert(key, text.phrase.text.clone());
            } else {
                let help = hint(&name.text, domain.names_of_kinds());
                let name = name.text.clone();
                let error = |at| RuleError::UnknownType { name, help, at };
                faults.push(text.name.fault(error));
            }
            continue;
        };
        let (expected, help) = match (predicate, schema) {
            (Some(id), _) => {
                (domain.predicates[id.index()].args.len(), domain.signature(id, &name.text))
            }
            (None, Some(schema)) => {
                let names = schema.parameter_names.join(", ");
                let written = format!("{}_({names})", schema.name);
                let help = said!("written", written);
                (schema.parameters.len(), help)
            }
            (None, None) => {
                let predicates = domain.names_of_predicates();
                let known = predicates.chain(domain.schemas.iter().map(|s| s.name.as_str()));
                let help = hint(&name.text, known);
                let name = name.text.clone();
                let error = |at| RuleError::UnknownPredicate { name, help, at };
                faults.push(text.name.fault(error));
                continue;
            }
        };
        if expected != parameters.len() {
            let (found, of) = (parameters.len(), name.text.clone());
            let error = |at| RuleError::Arity { name: of, expected, found, help, at };
            faults.push(name.fault(error));
            continue;
        }
        let Some(phrase) = phrase(&text.phrase, parameters, faults) else { continue };
        if predicate.is_some() {
            vocabulary.facts.insert((key, text.negated), phrase);
        } else {
            vocabulary.actions.insert(key, phrase);
        }
    }
    phrases
}

/// A phrase cut at its variables; none when one of them is no parameter.
fn phrase(text: &Name, parameters: &[Name], faults: &mut Vec<RuleFault>) -> Option<Phrase> {
    let is_of_name = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    let mut parts = Vec::new();
    let mut rest = text.text.as_str();
    while let Some(mark) = rest.find('?') {
        let after = &rest[mark + 1..];
        let end = after.find(|c| !is_of_name(c)).unwrap_or(after.len());
        if end == 0 {
            parts.push(Part::Text(rest[..=mark].to_owned()));
            rest = after;
            continue;
        }
        let variable = &rest[mark..mark + 1 + end];
        let Some(number) = parameters.iter().position(|p| p.key() == name_key(variable)) else {
            let help = hint(variable, parameters.iter().map(|p| p.text.as_str()));
            let variable = variable.to_owned();
            faults.push(text.fault(|at| RuleError::PhraseVariable { variable, help, at }));
            return None;
        };
        parts.push(Part::Text(rest[..mark].to_owned()));
        parts.push(Part::Argument(number));
        rest = &after[end..];
    }
    parts.push(Part::Text(rest.to_owned()));
    Some(Phrase(parts))
}
