//! The headings of a rule file, in Russian and English.

use crate::units::{Language, name_key};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Heading {
    Action,
    Parameters,
    Precondition,
    AddEffect,
    DelEffect,
    Cost,
    Duration,
    Throughout,
    AtEnd,
    StartAdd,
    StartDel,
    Initial,
    Goal,
    Wishes,
    Facts,
    Assumptions,
    Types,
    Predicates,
    Derived,
    Objects,
    Include,
    Map,
    Phrases(Language),
}

/// Every heading in both languages, as shown to people.
pub(super) const HEADINGS: &[(&str, Heading)] = &[
    ("Действие", Heading::Action),
    ("Action", Heading::Action),
    ("Параметры", Heading::Parameters),
    ("Parameters", Heading::Parameters),
    ("Предусловие", Heading::Precondition),
    ("Precondition", Heading::Precondition),
    ("Эффект+", Heading::AddEffect),
    ("Effect+", Heading::AddEffect),
    ("Эффект-", Heading::DelEffect),
    ("Effect-", Heading::DelEffect),
    ("Стоимость", Heading::Cost),
    ("Cost", Heading::Cost),
    ("Длительность", Heading::Duration),
    ("Duration", Heading::Duration),
    ("Всё-время", Heading::Throughout),
    ("Throughout", Heading::Throughout),
    ("Под-конец", Heading::AtEnd),
    ("At-end", Heading::AtEnd),
    ("Начало+", Heading::StartAdd),
    ("Start+", Heading::StartAdd),
    ("Начало-", Heading::StartDel),
    ("Start-", Heading::StartDel),
    ("Исходная позиция", Heading::Initial),
    ("Initial", Heading::Initial),
    ("Initial position", Heading::Initial),
    ("Целевая позиция", Heading::Goal),
    ("Цель", Heading::Goal),
    ("Goal", Heading::Goal),
    ("Goal position", Heading::Goal),
    ("Желательно", Heading::Wishes),
    ("Preferably", Heading::Wishes),
    ("Факты", Heading::Facts),
    ("Facts", Heading::Facts),
    ("Предположения", Heading::Assumptions),
    ("Assumptions", Heading::Assumptions),
    ("Типы", Heading::Types),
    ("Types", Heading::Types),
    ("Предикаты", Heading::Predicates),
    ("Predicates", Heading::Predicates),
    ("Выводится", Heading::Derived),
    ("Derived", Heading::Derived),
    ("Объекты", Heading::Objects),
    ("Objects", Heading::Objects),
    ("Константы", Heading::Objects),
    ("Constants", Heading::Objects),
    ("Включить", Heading::Include),
    ("Include", Heading::Include),
    ("Карта", Heading::Map),
    ("Map", Heading::Map),
    ("По-русски", Heading::Phrases(Language::Russian)),
    ("In Russian", Heading::Phrases(Language::Russian)),
    ("По-английски", Heading::Phrases(Language::English)),
    ("In English", Heading::Phrases(Language::English)),
];

impl Heading {
    pub(super) fn of(key: &str) -> Option<Self> {
        HEADINGS.iter().find(|(name, _)| name_key(name) == key).map(|&(_, heading)| heading)
    }

    pub(super) fn is_part_of_action(self) -> bool {
        matches!(
            self,
            Self::Parameters
                | Self::Precondition
                | Self::AddEffect
                | Self::DelEffect
                | Self::Cost
                | Self::Duration
                | Self::Throughout
                | Self::AtEnd
                | Self::StartAdd
                | Self::StartDel
        )
    }
}
