//! Names that a person can speak of: from the file where it gives any that is one, else from the type, in Russian
//! and English, each borne by one thing alone.

use std::collections::{HashMap, HashSet};

use crate::units::{capitalized, name_key};

/// A name longer than this is a text, not a name.
const LONGEST: usize = 80;

/// A name in both languages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Named {
    pub(super) name: String,
    pub(super) name_en: String,
}

/// All names given so far.
#[derive(Debug, Default)]
pub(super) struct Names {
    taken: HashSet<String>,
    next: HashMap<String, usize>,
    keys: HashSet<String>,
}

impl Names {
    /// The name itself, or with the next free number: «Спальня», «Спальня-2».
    pub(super) fn unique(&mut self, name: &str, name_en: &str) -> Named {
        let plain = Named { name: name.to_owned(), name_en: name_en.to_owned() };
        if self.take(&plain) { plain } else { self.counted(name, name_en, 2) }
    }

    /// Always with a number: «Стул-1», "Chair 1".
    pub(super) fn numbered(&mut self, name: &str, name_en: &str) -> Named {
        self.counted(name, name_en, 1)
    }

    /// Numbered in Russian, in English by the name that the file gives: «Дверь-3», "main_door".
    pub(super) fn numbered_with(&mut self, name: &str, name_en: &str) -> Named {
        let english = self.unique("", name_en);
        let russian = self.numbered(name, "");
        Named { name: russian.name, name_en: english.name_en }
    }

    fn counted(&mut self, name: &str, name_en: &str, first: usize) -> Named {
        let key = format!("{}/{}", name_key(name), name_key(name_en));
        loop {
            let next = self.next.entry(key.clone()).or_insert(first);
            let number = (*next).max(first);
            *next = number + 1;
            let name_en =
                if name_en.is_empty() { String::new() } else { format!("{name_en} {number}") };
            let name = if name.is_empty() { String::new() } else { format!("{name}-{number}") };
            let named = Named { name, name_en };
            if self.take(&named) {
                return named;
            }
        }
    }

    fn take(&mut self, named: &Named) -> bool {
        let keys = [name_key(&named.name), name_key(&named.name_en)];
        if keys.iter().any(|key| self.taken.contains(key)) {
            return false;
        }
        self.taken.extend(keys.into_iter().filter(|key| !key.is_empty()));
        true
    }

    /// A handle for the map file, made of the file's own id.
    pub(super) fn key(&mut self, sort: &str, source: &str) -> String {
        let mut id: String = source
            .chars()
            .map(|c| if c.is_alphanumeric() { c } else { '-' })
            .take(LONGEST)
            .collect();
        id = id.trim_matches('-').to_owned();
        let plain = if id.is_empty() { sort.to_owned() } else { format!("{sort}-{id}") };
        let mut key = plain.clone();
        let mut number = self.next.get(&plain).copied().unwrap_or(2);
        while !self.keys.insert(key.clone()) {
            key = format!("{plain}-{number}");
            number += 1;
        }
        self.next.insert(plain, number);
        key
    }
}

/// A name as people write it: without control characters and odd blanks, not too long.
pub(super) fn tidy(name: &str) -> String {
    let words: Vec<&str> = name
        .split(|c: char| c.is_whitespace() || c.is_control())
        .filter(|w| !w.is_empty())
        .collect();
    words.join(" ").chars().take(LONGEST).collect()
}

/// `Dresser_315` as words: "Dresser 315"; CamelCase comes apart.
pub(super) fn words(name: &str) -> String {
    let mut spaced = String::new();
    let mut before = ' ';
    for c in tidy(name).chars() {
        let c = if c == '_' { ' ' } else { c };
        if c.is_uppercase() && before.is_lowercase() {
            spaced.push(' ');
            spaced.extend(c.to_lowercase());
        } else {
            spaced.push(c);
        }
        before = c;
    }
    capitalized(&tidy(&spaced))
}

pub(super) fn is_russian(name: &str) -> bool {
    name.chars().any(|c| ('а'..='я').contains(&c) || ('А'..='Я').contains(&c))
}

/// Id of the `i`-th side: A, B, … Z, AA, AB …; never a word that means a face.
pub(super) fn letters(i: usize) -> String {
    let (mut i, mut id) = (i, Vec::new());
    loop {
        id.push(char::from(b'A' + (i % 26) as u8));
        if i < 26 {
            break;
        }
        i = i / 26 - 1;
    }
    id.iter().rev().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_name_is_borne_once() {
        let mut names = Names::default();
        let given = |n: Named| format!("{} / {}", n.name, n.name_en);
        assert_eq!(given(names.unique("Спальня", "Bedroom")), "Спальня / Bedroom");
        assert_eq!(given(names.unique("спальня", "Bedroom")), "спальня-2 / Bedroom 2");
        assert_eq!(given(names.numbered("Стул", "Chair")), "Стул-1 / Chair 1");
        assert_eq!(given(names.unique("Стул-2", "")), "Стул-2 / ");
        assert_eq!(given(names.numbered("Стул", "Chair")), "Стул-3 / Chair 3");
        assert_eq!(names.key("room", "E1.a/1"), "room-E1-a-1");
        assert_eq!(names.key("room", "E1 a 1"), "room-E1-a-1-2");
    }

    #[test]
    fn words_and_letters() {
        assert_eq!(words("OfficeChair_black"), "Office chair black");
        assert_eq!(tidy(" a\u{0}b\t c "), "a b c");
        assert_eq!([0, 25, 26, 701, 702].map(letters), ["A", "Z", "AA", "ZZ", "AAA"]);
    }
}
