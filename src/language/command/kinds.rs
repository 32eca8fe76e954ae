//! What the words of an order do, as the lines of `orders.lang` name it.

use super::Relation;
use super::verbs::{Sort, is_relative};
use super::vocabulary::{Link, Meaning, Role, Verb, longest};
use crate::paraphrase::{Kind, Sense, Words};
use crate::words::Cardinal;

/// What each word of a text does; a verb is none within a longer phrase.
pub(super) fn senses(words: &Words<'_>) -> Vec<Sense> {
    let mut phrase_ends = 0;
    (0..words.keys.len())
        .map(|at| {
            let found = longest(&words.keys[at..].iter().map(String::as_str));
            let is_within = at < phrase_ends;
            let mut own = Vec::new();
            own.extend(is_relative(&words.keys, at).then_some(Kind::Relative));
            own.extend(Cardinal::read(&words.keys[at]).map(|_| Kind::Number));
            let Some((length, meaning)) = found else { return Sense { length: 1, kinds: own } };
            if !is_within {
                phrase_ends = at + length;
            }
            let mut kinds = match meaning {
                Meaning::Verb(_) if is_within => Vec::new(),
                Meaning::Verb(verb) => of_verb(verb),
                Meaning::Link(link) => of_link(link),
                Meaning::FacingWall => vec![Kind::Facing, Kind::Other],
                Meaning::Not => vec![Kind::Not, Kind::Other],
                Meaning::Filler => vec![Kind::Small, Kind::Other],
                Meaning::And => vec![Kind::And, Kind::Other],
                Meaning::Me => vec![Kind::Me, Kind::Other],
                Meaning::All => vec![Kind::All, Kind::Other],
                _ => vec![Kind::Other],
            };
            kinds.append(&mut own);
            if words.text[words.at[at].clone()].to_lowercase() == "всё" {
                kinds.push(Kind::Everything);
            }
            Sense { length, kinds }
        })
        .collect()
}

fn of_link(link: Link) -> Vec<Kind> {
    let mut kinds = vec![Kind::Link];
    kinds.extend((link.role == Role::Via).then_some(Kind::Via));
    kinds.extend(match link.relation {
        Relation::Between | Relation::NextTo | Relation::InFrontOf | Relation::Behind => {
            Some(Kind::Beside)
        }
        Relation::At => Some(Kind::At),
        Relation::Facing => Some(Kind::Facing),
        _ => None,
    });
    kinds
}

fn of_verb(verb: Verb) -> Vec<Kind> {
    let mut kinds = vec![Kind::Verb];
    if verb != Verb::Need {
        kinds.push(Kind::Act);
    }
    if matches!(
        verb,
        Verb::Put | Verb::PutBack | Verb::Return | Verb::Move | Verb::Bring | Verb::Take
    ) {
        kinds.push(Kind::Move);
    }
    kinds.extend(match Sort::of(verb) {
        Sort::Carry => Some(Kind::Carry),
        Sort::Put => Some(Kind::Put),
        Sort::Switch => Some(Kind::Switch),
        Sort::Find => Some(Kind::Find),
        Sort::Leave => Some(Kind::Leave),
        Sort::Go => Some(Kind::Approach),
        Sort::Door => Some(Kind::Door),
        Sort::Other => None,
    });
    kinds.extend((Sort::of(verb) != Sort::Door).then_some(Kind::Deed));
    kinds.extend(match verb {
        Verb::Face => Some(Kind::Face),
        Verb::Needless => Some(Kind::Needless),
        Verb::GoTo => Some(Kind::Go),
        Verb::Take => Some(Kind::Take),
        Verb::Wait => Some(Kind::Wait),
        Verb::Stop => Some(Kind::Stop),
        _ => None,
    });
    kinds
}
