//! Everyday words for what a map names otherwise: diminutives («столик»), talk («телик»), other names of one thing
//! ("couch", "trash can").
//!
//! Invariant: a word is only ever replaced by one that means the same thing; whether the map knows that one is asked
//! by the caller.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::OnceLock;

use super::english;
use super::grammar::{Case, Number, WordHints};
use super::lexicon;
use super::list::Language;
use super::phrase::NounPhrase;
use super::things::things;
use crate::units::name_key;

/// The words for one sort of thing each, and those words of the word list that have one and the same English: «скамья», «скамейка»,
/// "bench".
fn sorts() -> &'static [Vec<String>] {
    static SORTS: OnceLock<Vec<Vec<String>>> = OnceLock::new();
    SORTS.get_or_init(|| {
        let mut sorts = things().same.clone();
        let mut of_english: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for (word, entry) in lexicon::all().filter(|(_, entry)| !entry.animate) {
            if let [english] = &entry.english[..] {
                of_english.entry(english.clone()).or_default().push(word.to_owned());
            }
        }
        for (english, mut words) in of_english.into_iter().filter(|(_, words)| words.len() > 1) {
            words.push(english);
            sorts.push(words);
        }
        sorts
    })
}

/// Whether a word is one of the word list, in any form or in English; the text in [`name_key`] form.
pub(crate) fn is_in_list(key: &str) -> bool {
    static FORMS: OnceLock<HashSet<String>> = OnceLock::new();
    let forms = FORMS.get_or_init(|| {
        let mut forms = HashSet::new();
        for (word, entry) in lexicon::all() {
            forms.extend(phrase(word).all_forms().iter().map(|(_, _, form)| name_key(form)));
            for english in &entry.english {
                forms.extend([name_key(english), name_key(&english::plural(english))]);
            }
        }
        forms
    });
    forms.contains(key)
}

/// Forms of the words of [`sorts`] with the sort they name and their number and case.
type Forms = HashMap<String, Vec<(usize, Number, Case)>>;

fn forms() -> &'static Forms {
    static FORMS: OnceLock<Forms> = OnceLock::new();
    FORMS.get_or_init(|| {
        let mut forms = Forms::new();
        let mut add = |form: &str, group: usize, number: Number, case: Case| {
            let known = forms.entry(name_key(form)).or_default();
            if known.iter().all(|(other, _, _)| *other != group) {
                known.push((group, number, case));
            }
        };
        for (group, words) in sorts().iter().enumerate() {
            for word in words {
                if Language::of(word) == Language::English {
                    add(word, group, Number::Singular, Case::Nominative);
                    add(&english::plural(word), group, Number::Plural, Case::Nominative);
                    continue;
                }
                for (number, case, form) in phrase(word).all_forms() {
                    add(&form, group, number, case);
                }
            }
        }
        forms
    })
}

fn phrase(word: &str) -> NounPhrase {
    NounPhrase::parse(word, &WordHints::default())
}

fn in_form(word: &str, number: Number, case: Case) -> String {
    match Language::of(word) {
        Language::Russian => phrase(word).form(case, number),
        Language::English if number == Number::Plural => english::plural(word),
        Language::English => word.to_owned(),
    }
}

/// Other words for the same thing, of either language and in the same case; the text in [`name_key`] form.
pub(crate) fn same_things(key: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for &(group, number, case) in forms().get(key).into_iter().flatten() {
        for word in &sorts()[group] {
            let form = in_form(word, number, case);
            if name_key(&form) != key && !found.contains(&form) {
                found.push(form);
            }
        }
    }
    found
}

/// Whether a word is a name of things in this list, in any form; the text in [`name_key`] form.
pub(crate) fn is_a_thing(key: &str) -> bool {
    forms().contains_key(key)
}

/// «нож» for «ножа»: the name of this list of which a Russian word is a form; the text in [`name_key`] form.
pub(crate) fn nominative(key: &str) -> Option<String> {
    let &(group, number, case) = forms().get(key)?.first()?;
    let of = |word: &&String| Language::of(word) == Language::Russian;
    let names = sorts()[group].iter().filter(of);
    names
        .filter(|word| name_key(&in_form(word, number, case)) == key)
        .map(|word| in_form(word, number, Case::Nominative))
        .next()
}

/// So many words make the longest of them.
pub(crate) const LONGEST: usize = 4;

/// Endings of diminutives with those of the words that they come from: «стол-ик», «книж-ечк-а» → «книжк-а».
const SMALL: &[(&str, &[&str])] = &[
    ("ичек", &["ик"]),
    ("очек", &["ок", "ка"]),
    ("ечек", &["ок", "ек", "ка"]),
    ("чик", &["", "ец"]),
    ("ик", &[""]),
    ("ок", &[""]),
    ("ек", &[""]),
    ("ечка", &["ка", "а", "я", "ь"]),
    ("очка", &["ка", "а", "ь"]),
    ("ичка", &["ица", "а"]),
    ("енька", &["а", "я"]),
    ("онька", &["а", "я"]),
    ("ушка", &["а", ""]),
    ("ка", &["а", "ь", "я"]),
    ("ечко", &["о", "е", "ко"]),
    ("ышко", &["о"]),
    ("ошко", &["но"]),
    ("ице", &["о", "е"]),
    ("ико", &["о"]),
    ("ко", &["о"]),
];

/// Endings that a nominative may have where an oblique case has these, longest first.
const CASES: &[(&str, &[&str])] = &[
    ("", &[""]),
    ("а", &["", "о"]),
    ("у", &["", "а", "о"]),
    ("е", &["", "а", "о", "е"]),
    ("и", &["", "а", "о", "е"]),
    ("ы", &["", "а"]),
    ("ом", &["", "о"]),
    ("ой", &["а"]),
    ("ах", &["", "а", "о"]),
    ("ам", &["", "а", "о"]),
    ("ами", &["", "а", "о"]),
    ("ов", &[""]),
    ("ек", &["ка", "ко"]),
    ("ок", &["ка", "ко"]),
];

/// The words of which a Russian word may be a diminutive, in its own number and case: «столике» – «столе».
pub(crate) fn undiminished(key: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for (ending, nominatives) in CASES {
        let Some(stem) = key.strip_suffix(ending) else { continue };
        for base in nominatives.iter().map(|n| format!("{stem}{n}")) {
            let wholes = wholes(&base);
            if wholes.is_empty() {
                continue;
            }
            let forms = phrase(&base).all_forms().into_iter();
            let Some((number, case, _)) = forms.into_iter().find(|(_, _, f)| name_key(f) == key)
            else {
                continue;
            };
            for whole in wholes {
                let form = in_form(&whole, number, case);
                if form != key && !found.contains(&form) {
                    found.push(form);
                }
            }
        }
    }
    found
}

/// The nominatives of which a nominative may be the diminutive.
fn wholes(base: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (ending, wholes) in SMALL {
        let Some(stem) = base.strip_suffix(ending).filter(|s| s.chars().count() >= 2) else {
            continue;
        };
        for stem in softened(stem) {
            found.extend(wholes.iter().map(|whole| format!("{stem}{whole}")));
        }
    }
    found
}

/// A stem and those that alternate with it: «книж» – «книг», «полоч» – «полк».
fn softened(stem: &str) -> Vec<String> {
    let mut stems = vec![stem.to_owned()];
    for (soft, hard) in [("ж", "г"), ("ж", "з"), ("ч", "к"), ("ч", "ц"), ("ш", "х"), ("ь", "")]
    {
        stems.extend(stem.strip_suffix(soft).map(|s| format!("{s}{hard}")));
    }
    stems
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn diminutives_come_from_their_words() {
        let check = |small: &str, word: &str| {
            assert!(
                undiminished(small).iter().any(|w| w == word),
                "{small}: {:?}",
                undiminished(small)
            );
        };
        check("столик", "стол");
        check("столике", "столе");
        check("холодильничек", "холодильник");
        check("книжечка", "книжка");
        check("чашечку", "чашку");
        check("вазочка", "ваза");
        check("полочке", "полке");
        check("шкафчик", "шкаф");
        check("стульчик", "стул");
        check("диванчике", "диване");
        check("креслице", "кресло");
        check("кроватка", "кровать");
        check("комнатке", "комнате");
        check("окошко", "окно");
        check("коробочка", "коробка");
        assert!(undiminished("стол").is_empty());
    }

    #[test]
    fn other_words_are_of_the_same_thing() {
        assert!(same_things("couch").iter().any(|w| w == "диван"));
        assert!(same_things("телика").iter().any(|w| w == "телевизора"));
        assert!(same_things("велосипед").is_empty());
    }
}
