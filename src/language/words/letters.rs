//! Letters: runs of a name, the case they are written in, and letters of two alphabets that look alike.

use std::borrow::Cow;
use std::ops::Range;

use crate::units::name_key;

/// A maximal run of word letters (letters, digits) or of anything else.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Run<'a> {
    /// Byte offset in the text.
    pub(crate) at: usize,
    pub(crate) text: &'a str,
    pub(crate) is_word: bool,
}

impl Run<'_> {
    pub(crate) fn is_hyphen(&self) -> bool {
        let mut letters = self.text.chars();
        letters.next().is_some_and(is_hyphen) && letters.next().is_none()
    }
}

/// Hyphen, its unbreakable kin, the dashes and the minus.
pub(crate) fn is_hyphen(c: char) -> bool {
    matches!(c, '-' | '\u{2010}'..='\u{2015}' | '\u{2212}' | '\u{fe63}' | '\u{ff0d}')
}

/// Within a word it says that the word is part of a name, whatever it means elsewhere. It combines, and shows nothing.
pub(crate) const OPAQUE: char = '\u{34f}';

/// Splits a text into words and what lies between them. The runs together are the text.
pub(crate) fn runs(text: &str) -> Vec<Run<'_>> {
    let mut runs: Vec<Run<'_>> = Vec::new();
    for (at, c) in text.char_indices() {
        let is_word = c.is_alphanumeric() || is_combining(c);
        let end = at + c.len_utf8();
        match runs.last_mut() {
            Some(run) if run.is_word == is_word => run.text = &text[run.at..end],
            _ => runs.push(Run { at, text: &text[at..end], is_word }),
        }
    }
    runs
}

/// The places of the words in a text, as the index and the grammars count them.
///
/// ```
/// use orthoframe_language::word_ranges;
/// assert_eq!(word_ranges("«Дверь-В», да"), [2..12, 13..15, 19..23]);
/// ```
#[must_use]
pub fn word_ranges(text: &str) -> Vec<Range<usize>> {
    runs(text).iter().filter(|run| run.is_word).map(|run| run.at..run.at + run.text.len()).collect()
}

/// The words of a text in the form in which names are compared.
#[must_use]
pub(crate) fn word_keys(text: &str) -> Vec<String> {
    word_ranges(text).into_iter().map(|range| name_key(&text[range])).collect()
}

/// How many words a phrase has, where all of them stand one after the other from a place on.
#[must_use]
pub(crate) fn phrase_at(keys: &[String], at: usize, phrase: &str) -> Option<usize> {
    phrase
        .split(' ')
        .try_fold(0, |taken, word| (keys.get(at + taken)? == word).then_some(taken + 1))
}

fn is_combining(c: char) -> bool {
    ('\u{300}'..='\u{36f}').contains(&c)
}

/// A form in lower case, written as `written` is: КОМНАТА – КОМНАТЕ, Комната – Комнате.
pub(crate) fn recase(written: &str, form: &str) -> String {
    let all_upper = written.chars().count() > 1 && written.chars().all(|c| !c.is_lowercase());
    let mut original = written.chars();
    let mut same = true;
    let mut cased = String::with_capacity(form.len());
    for c in form.chars() {
        let model = original.next();
        same &= model.is_some_and(|m| m.to_lowercase().eq(c.to_lowercase()));
        match model {
            Some(model) if same => cased.push(model),
            _ if all_upper => cased.extend(c.to_uppercase()),
            Some(model) if cased.is_empty() && model.is_uppercase() => {
                cased.extend(c.to_uppercase())
            }
            _ => cased.push(c),
        }
    }
    cased
}

/// Whether a word is written as an abbreviation: two capitals or more, nothing small.
pub(crate) fn is_acronym(word: &str) -> bool {
    word.chars().count() > 1 && word.chars().all(char::is_uppercase)
}

/// A word with stray Latin letters among Cyrillic ones, in Cyrillic. Others stay as they are.
pub(crate) fn to_cyrillic(word: &str) -> Cow<'_, str> {
    let latin = word.chars().any(|c| c.is_ascii_alphabetic());
    let own = word.chars().any(|c| ('\u{400}'..='\u{4ff}').contains(&c));
    if !latin || !own || word.chars().count() < 3 || word.chars().all(|c| !c.is_lowercase()) {
        return Cow::Borrowed(word);
    }
    Cow::Owned(word.chars().map(|c| cyrillic_twin(c).unwrap_or(c)).collect())
}

/// The Cyrillic letter that looks like this Latin one.
pub(crate) fn cyrillic_twin(latin: char) -> Option<char> {
    Some(match latin {
        'A' => 'А',
        'B' => 'В',
        'C' => 'С',
        'E' => 'Е',
        'H' => 'Н',
        'K' => 'К',
        'M' => 'М',
        'O' => 'О',
        'P' => 'Р',
        'T' => 'Т',
        'X' => 'Х',
        'Y' => 'У',
        'a' => 'а',
        'c' => 'с',
        'e' => 'е',
        'o' => 'о',
        'p' => 'р',
        'x' => 'х',
        'y' => 'у',
        'k' => 'к',
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_are_written_as_the_name_is() {
        assert_eq!(recase("Комната", "комнате"), "Комнате");
        assert_eq!(recase("КОМНАТА", "комнате"), "КОМНАТЕ");
        assert_eq!(recase("Лёд", "льда"), "Льда");
        assert_eq!(recase("Ведро", "вёдра"), "Вёдра");
        assert_eq!(recase("ШкаФ", "шкафу"), "ШкаФу");
    }

    #[test]
    fn runs_make_up_the_text() {
        let text = "Стол №2 – «у окна»";
        assert_eq!(runs(text).iter().map(|run| run.text).collect::<String>(), text);
        assert!(runs("").is_empty());
    }

    #[test]
    fn stray_latin_letters_are_read_as_cyrillic() {
        assert_eq!(to_cyrillic("Кoмнaта"), "Комната");
        assert_eq!(to_cyrillic("ВZ"), "ВZ");
        assert_eq!(to_cyrillic("Room"), "Room");
    }
}
