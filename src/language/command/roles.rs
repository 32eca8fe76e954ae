//! What part a named thing plays: by its case, by the preposition before it, by the verb; and what is asked where a part
//! is not said.

use super::grammar::{Argument, Reference};
use super::vocabulary::{Link, Role, Verb};
use super::{Placement, Relation};
use crate::sets::set;
use crate::units::name_key;
use crate::words::{Case, Hit};

/// All that a name may mean in these cases.
pub(super) fn choose<T: Clone>(hits: &[Hit<'_, T>], cases: &[Case]) -> Vec<T> {
    in_case(hits, cases).iter().map(|hit| hit.id.clone()).collect()
}

/// Says of a place where that is; none where it is said already, or there is no place.
pub(super) fn within<T>(place: &mut Option<Placement<T>>, outer: T) -> Option<()> {
    let place = place.as_mut().filter(|place| place.within.is_none())?;
    place.within = Some(outer);
    Some(())
}

/// Hits whose form may stand in one of these cases; all of them when none does, for people slip in endings.
pub(super) fn in_case<'h, 's, T>(hits: &'h [Hit<'s, T>], cases: &[Case]) -> Vec<&'h Hit<'s, T>> {
    let suiting: Vec<_> =
        hits.iter().filter(|hit| cases.iter().any(|case| hit.readings.has_case(*case))).collect();
    if suiting.is_empty() { hits.iter().collect() } else { suiting }
}

pub(super) fn cases_after(link: Link) -> &'static [Case] {
    match (link.role, link.relation) {
        (Role::Whence, _) => &[Case::Genitive],
        (Role::Via, _) => &[Case::Accusative],
        (_, Relation::Middle | Relation::LeftOf | Relation::RightOf) => &[Case::Genitive],
        (_, Relation::Facing) => &[Case::Dative, Case::Accusative],
        (_, Relation::Between) => &[Case::Instrumental],
        (Role::Whither, Relation::At) => &[Case::Dative, Case::Genitive],
        (_, Relation::In | Relation::On) => {
            &[Case::Accusative, Case::Locative, Case::Prepositional]
        }
        (_, Relation::NextTo) => &[Case::Genitive, Case::Instrumental],
        _ => &[Case::Accusative, Case::Instrumental],
    }
}

/// Whether a place is where something is or whither it goes: by the preposition, by the case, by the verb.
pub(super) fn direction<T>(verb: Verb, link: Link, argument: &Argument<'_, T>) -> Role {
    if link.role != Role::WhereOrWhither {
        return link.role;
    }
    let Reference::Known(hits) = &argument.reference else { return by_verb(verb) };
    let may_be = |cases: &[Case]| {
        hits.iter().any(|hit| cases.iter().any(|case| hit.readings.has_case(*case)))
    };
    let (whither, place) = match link.relation {
        Relation::In | Relation::On => (may_be(&[Case::Accusative]), may_be(&[Case::Locative])),
        Relation::Under | Relation::Behind => {
            (may_be(&[Case::Accusative]), may_be(&[Case::Instrumental]))
        }
        _ => return by_verb(verb),
    };
    match (whither, place) {
        (true, false) => Role::Whither,
        (false, true) => Role::Where,
        _ => by_verb(verb),
    }
}

pub(super) fn by_verb(verb: Verb) -> Role {
    match verb {
        Verb::GoTo
        | Verb::Visit
        | Verb::Move
        | Verb::Put
        | Verb::SetDown
        | Verb::Bring
        | Verb::Clear
        | Verb::Return
        | Verb::PutBack
        | Verb::ThrowAway
        | Verb::Leave => Role::Whither,
        _ => Role::Where,
    }
}

/// Whether an argument, said so, is several things: «к ним», where «с ним» is one.
pub(super) fn is_them<T>(argument: &Argument<'_, T>, link: Link, said: &str) -> bool {
    let dative = cases_after(link).contains(&Case::Dative);
    match argument.reference {
        Reference::Them => true,
        Reference::Pronoun => dative && set!("ThemInDative").contains(&name_key(said).as_str()),
        _ => false,
    }
}

/// Whether a verb brings things to where they belong.
pub(super) fn restores(verb: Verb) -> bool {
    matches!(verb, Verb::PutBack | Verb::Return | Verb::Clear)
}

pub(super) fn question(verb: Verb) -> (&'static str, &'static str) {
    match verb {
        Verb::Bring | Verb::Need => ("что принести", "what to bring"),
        Verb::Take => ("что взять", "what to take"),
        Verb::Put | Verb::SetDown | Verb::Clear => ("что положить", "what to put"),
        Verb::Open => ("что открыть", "what to open"),
        Verb::Close => ("что закрыть", "what to close"),
        Verb::Lock => ("что запереть", "what to lock"),
        Verb::Unlock => ("что отпереть", "what to unlock"),
        Verb::SwitchOn => ("что включить", "what to switch on"),
        Verb::SwitchOff => ("что выключить", "what to switch off"),
        Verb::Find => ("что найти", "what to find"),
        Verb::PutBack => ("что вернуть на место", "what to put back"),
        Verb::ThrowAway => ("что выбросить", "what to throw away"),
        Verb::GoTo | Verb::Visit | Verb::Move | Verb::Get | Verb::Return | Verb::Leave => {
            ("куда ехать", "where to go")
        }
        Verb::Tidy
        | Verb::Clean
        | Verb::Charge
        | Verb::CallOperator
        | Verb::CallLift
        | Verb::Report
        | Verb::Wait
        | Verb::Face
        | Verb::Unable
        | Verb::Stop
        | Verb::Needless => ("что сделать", "what to do"),
    }
}
