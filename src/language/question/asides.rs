//! What is said in a dialogue and is neither a question nor an order of its own: yes and no to what was offered, "why?",
//! the end; and the small words by which a line asks or begs.
//!
//! Invariant: only a line of nothing else is an aside.

use crate::command::has_verb;
use crate::sets::{named, of_kind, set};
use crate::units::name_key;
use crate::words::{Language, phrase_at, word_keys, word_ranges};

/// A line that means something only after what was said before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Aside {
    Yes,
    No,
    Why,
    /// The dialogue is over.
    End,
}

named!(Aside: Yes No Why End);

/// The aside that a line is. What ends in a question mark only asks: «Выход?» is no farewell.
#[must_use]
pub fn aside(text: &str) -> Option<Aside> {
    let key = name_key(text.trim_matches(|c: char| !c.is_alphanumeric()));
    let (name, _) = of_kind("Aside.").find(|(_, said)| *said == key)?;
    let found = Aside::named(name)?;
    (found == Aside::Why || !text.contains('?')).then_some(found)
}

/// What stands behind a "no" with which a line begins: "No, put it there".
#[must_use]
pub fn behind_no(text: &str) -> Option<&str> {
    let (no, behind) = text.split_once([',', '.', '!'])?;
    (aside(no) == Some(Aside::No)).then(|| behind.trim_start())
}

/// "Sorry, I meant the other one, and take it to the hall": what is put right, and the order behind it, which is done to that.
#[must_use]
pub fn another_and_order(line: &str) -> Option<[String; 2]> {
    let (words, keys) = (word_ranges(line), word_keys(line));
    let phrase = |all: &[&str], at: usize| all.iter().filter_map(|p| phrase_at(&keys, at, p)).max();
    let is_no = |key: &&String| set!("NoOrSorry").contains(&key.as_str());
    let denied = keys.iter().take_while(is_no).count();
    let lead = denied + phrase(set!("IMeant"), denied).unwrap_or_default();
    let end = lead + phrase(set!("AnotherOne"), lead).filter(|_| lead > 0)?;
    let order = end + phrase(set!("AndWord"), end)?;
    let (other, order) = (&line[words[lead].start..words[end - 1].end], words.get(order)?.start);
    let no = Language::of(line).pick("Нет", "No");
    has_verb(&line[order..]).then(|| [format!("{no}, {other}"), line[order..].to_owned()])
}

/// Whether a line begs: "Two spoons to the table, please".
#[must_use]
pub fn begs(text: &str) -> bool {
    word_keys(text).iter().any(|word| set!("Please").contains(&word.as_str()))
}

/// Whether a particle makes a question of a line: «Дойдёшь ли ты до спальни».
#[must_use]
pub fn asks_whether(text: &str) -> bool {
    word_keys(text).get(1).is_some_and(|word| word == "ли")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_line_of_nothing_else_is_an_aside() {
        for (text, expected) in [
            ("Да!", Some(Aside::Yes)),
            ("нет", Some(Aside::No)),
            ("А почему?", Some(Aside::Why)),
            ("Why not?", Some(Aside::Why)),
            ("Выход", Some(Aside::End)),
            ("Выход?", None),
            ("Да, принеси", None),
            ("почему стол здесь", None),
            ("", None),
        ] {
            assert_eq!(aside(text), expected, "{text}");
        }
    }
}
