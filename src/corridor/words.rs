//! The words of the hand-written corridor file.

use super::system::{JunctionKind, Measure, Side, Turn};

/// A word of the file together with its other spellings; the first one is the one that is told to people.
pub(super) type Words<T> = &'static [(&'static [&'static str], T)];

pub(super) const SIDES: Words<Side> = &[
    (&["right", "справа"], Side::Right),
    (&["left", "слева"], Side::Left),
    (&["ahead", "прямо"], Side::Ahead),
];

pub(super) const MEASURES: Words<Measure> =
    &[(&["arcs", "дуги"], Measure::Arcs), (&["metres", "метры"], Measure::Metres)];

pub(super) const KINDS: Words<JunctionKind> = &[
    (&["crossing", "крестообразное"], JunctionKind::Crossing),
    (&["tee", "т-образное"], JunctionKind::Tee),
    (&["branch-right", "ответвление направо"], JunctionKind::BranchRight),
    (&["branch-left", "ответвление налево"], JunctionKind::BranchLeft),
    (&["turn-right", "поворот направо"], JunctionKind::TurnRight),
    (&["turn-left", "поворот налево"], JunctionKind::TurnLeft),
];

pub(super) const TURNS: Words<Turn> = &[
    (&["straight", "прямо"], Turn::Straight),
    (&["right", "направо"], Turn::Right),
    (&["left", "налево"], Turn::Left),
];

/// The word of the file for a kind of junction.
pub(super) fn kind_word(kind: JunctionKind) -> &'static str {
    KINDS.iter().find(|(_, k)| *k == kind).map_or("", |(words, _)| words[0])
}

/// The word of the file for a turn.
pub(super) fn turn_word(turn: Turn) -> &'static str {
    TURNS.iter().find(|(_, t)| *t == turn).map_or("", |(words, _)| words[0])
}
