//! What is said of the tasks that wait: «Пауза», «Продолжай», «Отмени 2», "What is queued?", "Later: bring the cup".
//!
//! Invariant: only a line of nothing else is one.

use crate::sets::Set;
use crate::units::name_key;

/// A line about the tasks that wait.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Waiting<'t> {
    /// Nothing more is begun.
    Pause,
    Resume,
    /// What waits is told.
    List,
    /// One is dropped, by its number in the list from 1; without one the only one.
    Cancel(Option<usize>),
    CancelAll,
    /// An order that is to wait.
    Add(&'t str),
}

static PAUSE: Set = Set::named("Pause");
static RESUME: Set = Set::named("Resume");
static LIST: Set = Set::named("WhatWaits");
static CANCEL: Set = Set::named("Cancel");
static CANCEL_ALL: Set = Set::named("CancelAll");
static LATER: Set = Set::named("Later");

/// What a line says of the tasks that wait; none for every other line.
#[must_use]
pub fn waiting(line: &str) -> Option<Waiting<'_>> {
    if let Some((before, order)) = line.split_once(':')
        && LATER.has(&name_key(before))
        && !order.trim().is_empty()
    {
        return Some(Waiting::Add(order.trim()));
    }
    let key = name_key(line.trim_matches(|c: char| !c.is_alphanumeric())).replace(['\'', '’'], " ");
    let lists = [
        (&PAUSE, Waiting::Pause),
        (&RESUME, Waiting::Resume),
        (&LIST, Waiting::List),
        (&CANCEL, Waiting::Cancel(None)),
        (&CANCEL_ALL, Waiting::CancelAll),
    ];
    if let Some((_, meant)) = lists.into_iter().find(|(list, _)| list.has(&key)) {
        return Some(meant);
    }
    let (verb, number) = key.rsplit_once(' ')?;
    let number = number.parse().ok().filter(|number| *number > 0)?;
    CANCEL.has(verb).then_some(Waiting::Cancel(Some(number)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_line_of_nothing_else_speaks_of_what_waits() {
        for (line, expected) in [
            ("Пауза!", Some(Waiting::Pause)),
            ("pause", Some(Waiting::Pause)),
            ("Продолжай", Some(Waiting::Resume)),
            ("Resume.", Some(Waiting::Resume)),
            ("Что в очереди?", Some(Waiting::List)),
            ("What's queued?", Some(Waiting::List)),
            ("Отмени", Some(Waiting::Cancel(None))),
            ("Отмени задание 2", Some(Waiting::Cancel(Some(2)))),
            ("cancel 3", Some(Waiting::Cancel(Some(3)))),
            ("cancel 0", None),
            ("Отмени всё", Some(Waiting::CancelAll)),
            ("Later: bring the cup", Some(Waiting::Add("bring the cup"))),
            ("В очередь: принеси чашку", Some(Waiting::Add("принеси чашку"))),
            ("Later:", None),
            ("Продолжай искать", None),
            ("Pause the music", None),
            ("Что на столе?", None),
            ("", None),
        ] {
            assert_eq!(waiting(line), expected, "{line}");
        }
    }
}
