//! Places that are told by a part's height or by where one looks, in words.

use super::knowledge::{Knowledge, Level};
use super::lexicon::lower_first;
use super::query::{Noun, Rel, Side, Thing};
use crate::words::{Case, Gender, Number, russian};

/// «второй», "second": places that people count by words.
const ORDINALS: [(&str, &str); 9] = [
    ("второй", "second"),
    ("третий", "third"),
    ("четвёртый", "fourth"),
    ("пятый", "fifth"),
    ("шестой", "sixth"),
    ("седьмой", "seventh"),
    ("восьмой", "eighth"),
    ("девятый", "ninth"),
    ("десятый", "tenth"),
];

impl Knowledge<'_> {
    /// «на верхней полке Стеллажа-1», "on the second shelf from the bottom of Bookshelf 1"
    pub(super) fn place_on(&self, level: &Level, part: &Noun, rel: Rel) -> String {
        let kind = part.head.kinds.iter().copied().find(|k| {
            let only = Noun {
                head: super::Head { kinds: vec![*k], ..Default::default() },
                ..Noun::default()
            };
            self.has_part_kinds(&only)
        });
        let Some(kind) = kind.map(|k| self.lexicon().kind(k)) else { return String::new() };
        let (russian_word, english_word, counted) = match (level.place, level.of - 1 - level.place)
        {
            (0, 0) => ("", "", false),
            (_, 0) => ("верхний", "top", false),
            (0, _) => ("нижний", "bottom", false),
            (below, above) if below == above => ("средний", "middle", false),
            (below, _) => {
                let (ru, en) = ORDINALS.get(below - 1).copied().unwrap_or(("", ""));
                (ru, en, true)
            }
        };
        if !self.is_russian() {
            let on = if rel == Rel::In { "in" } else { "on" };
            let from = if counted { " from the bottom" } else { "" };
            let name = format!("{english_word} {}", kind.english);
            return format!("{on} the {}{from} of {}", name.trim(), self.name(level.owner));
        }
        let gender: Gender = kind.phrase.gender();
        let word = match russian_word {
            "" => String::new(),
            word => russian::agreeing(word, Case::Prepositional, Number::Singular, gender) + " ",
        };
        let from = if counted { " снизу" } else { "" };
        let form = lower_first(&kind.phrase.form(Case::Prepositional, Number::Singular));
        let place = format!("{word}{form}{from}");
        let before =
            if rel == Rel::In { russian::Preposition::V } else { russian::Preposition::Na };
        let owner = self.form(level.owner, Case::Genitive);
        format!("{} {place} {owner}", russian::preposition(before, &place))
    }

    /// «слева от Стола-1, если смотреть на Окно с моего места», "on the left when facing the window from where I am"
    pub(super) fn place_aside(&self, side: Side, anchors: &[Thing]) -> String {
        let (Some(&of), Some(&faced)) = (anchors.first(), anchors.last()) else {
            return String::new();
        };
        let own = self.standpoint(faced).is_some_and(|(_, own)| own);
        let russian = self.is_russian();
        let side_word = match (side.is_left(), russian) {
            (true, true) => "слева",
            (false, true) => "справа",
            (true, false) => "left",
            (false, false) => "right",
        };
        let from = match (own, russian) {
            (true, true) => "с моего места",
            (false, true) => "с середины комнаты",
            (true, false) => "from where I am",
            (false, false) => "from the middle of the room",
        };
        match (side.of_all(), russian) {
            (true, true) => {
                format!(
                    "{side_word}, если смотреть на {} {from},",
                    self.form(faced, Case::Accusative)
                )
            }
            (true, false) => format!("on the {side_word} when facing {} {from}", self.name(faced)),
            (false, true) => {
                let form = self.form(of, Case::Genitive);
                let before = russian::preposition(russian::Preposition::Ot, &form);
                let seen = match of == faced {
                    true if self.gender(of).0 == Gender::Feminine => "неё".to_owned(),
                    true => "него".to_owned(),
                    false => self.form(faced, Case::Accusative),
                };
                format!("{side_word} {before} {form}, если смотреть на {seen} {from},")
            }
            (false, false) => {
                let seen = if of == faced { "it".to_owned() } else { self.name(faced) };
                format!("to the {side_word} of {} when facing {seen} {from}", self.name(of))
            }
        }
    }
}
