//! English around a name: articles, plurals, possessives, and English for the Russian names of a house.
//!
//! ```
//! use orthoframe_language::english;
//! assert_eq!(english::with_article("kitchen"), "the kitchen");
//! assert_eq!(english::with_article("Room-B"), "Room-B");
//! assert_eq!(english::name_of("Комната-В").as_deref(), Some("Room-B"));
//! assert_eq!(english::a("hour"), "an hour");
//! ```

use super::adjective::Adjective;
use super::letters::{Run, cyrillic_twin, runs};
use super::lexicon;
use super::noun;
use crate::sets::Set;
use crate::units::capitalized;

/// The name inside a sentence, with "the" where English wants it: "the kitchen" for Kitchen, but "Room-B", "Office 12",
/// "Anna's desk". A plain capital at the start is dropped, since a thing's name is no proper name.
#[must_use]
pub fn with_article(name: &str) -> String {
    if is_proper(name) {
        return name.to_owned();
    }
    let mut letters = name.chars();
    let Some(first) = letters.next() else { return String::new() };
    let plain = letters.as_str().chars().take_while(|c| c.is_alphabetic()).all(char::is_lowercase);
    if plain {
        format!("the {}{}", first.to_lowercase(), letters.as_str())
    } else {
        format!("the {name}")
    }
}

/// The noun with "a" or "an", by its sound.
#[must_use]
pub fn a(noun: &str) -> String {
    format!("{} {noun}", if begins_with_vowel_sound(noun) { "an" } else { "a" })
}

/// Whether a name is of several by its form: "Keys 1", "Scissors", "Wardrobe doors".
#[must_use]
pub fn is_plural(name: &str) -> bool {
    const NOT: [&str; 9] = ["ss", "us", "is", "as", "os", "lens", "series", "chess", "species"];
    let before =
        [" of ", " to ", " for ", " with "].iter().filter_map(|after| name.find(after)).min();
    let head = &name[..before.unwrap_or(name.len())];
    let head = head.trim_end_matches(|c: char| !c.is_alphabetic());
    let word = head.rsplit(|c: char| !c.is_alphabetic()).next().unwrap_or_default().to_lowercase();
    word == "people"
        || (word.len() > 3 && word.ends_with('s') && !NOT.iter().any(|n| word.ends_with(n)))
}

/// The plural of a noun or of a phrase whose last word is its head: "boxes", "shelves", "living rooms".
#[must_use]
pub fn plural(noun: &str) -> String {
    let cut = noun
        .rfind(|c: char| !c.is_alphabetic())
        .map_or(0, |at| at + noun[at..].chars().next().map_or(1, char::len_utf8));
    let (before, word) = noun.split_at(cut);
    // A name in Russian letters takes no English ending, nor does the tag of one: "Room 12a".
    let is_tag = !before.is_empty()
        && (before.ends_with(|c: char| c.is_ascii_digit()) || word.chars().count() == 1);
    if is_tag || word.is_empty() || word.chars().any(is_cyrillic) {
        return noun.to_owned();
    }
    // "chest of drawers", "thing to drink from": the head stands before.
    if let Some(at) =
        [" of ", " to ", " for ", " without "].iter().filter_map(|after| noun.find(after)).min()
    {
        return format!("{}{}", plural(&noun[..at]), &noun[at..]);
    }
    // "way out"
    if let Some(way) = noun.strip_suffix(" out") {
        return format!("{} out", plural(way));
    }
    // "TVs"
    if word.chars().count() > 1 && word.chars().all(char::is_uppercase) {
        return format!("{before}{word}s");
    }
    let lower = word.to_lowercase();
    static IRREGULAR: Set = Set::named("IrregularPlural");
    static SAME: Set = Set::named("SamePlural");
    let ends = |endings: &[&str]| endings.iter().any(|e| lower.ends_with(e));
    // "keys" are many already.
    let plural = if SAME.contains(&lower.as_str()) || is_plural(word) {
        word.to_owned()
    } else if let Some((one, many)) = IRREGULAR.meant().iter().find(|(one, _)| lower == *one) {
        let kept = one.chars().zip(many.chars()).take_while(|(a, b)| a == b).count();
        word.chars().take(kept).chain(many.chars().skip(kept)).collect()
    } else if ends(&["s", "x", "z", "ch", "sh", "tomato", "potato", "mango", "hero", "echo"]) {
        format!("{word}es")
    } else if lower.ends_with('y') && !ends(&["ay", "ey", "oy", "uy"]) && lower.len() > 1 {
        format!("{}ies", &word[..word.len() - 1])
    } else {
        format!("{word}s")
    };
    format!("{before}{plural}")
}

/// The word that names the kind of a thing: "cup" of "red cup", "Room" of "Room-B", "chest" of "chest of drawers".
#[must_use]
pub fn kind(name: &str) -> Option<&str> {
    let before_of = name.split_once(" of ").map_or(name, |(before, _)| before);
    let is_tag = |word: &str| word.chars().all(|c| c.is_uppercase() || c.is_numeric());
    let mut words = runs(before_of).into_iter().filter(|run| run.is_word).map(|run| run.text).rev();
    words
        .find(|word| word.chars().count() > 2 && !is_tag(word))
        .filter(|kind| kind.len() < name.len())
}

/// "1 door", "5 doors"
#[must_use]
pub fn count(number: u64, noun: &str) -> String {
    if number == 1 { format!("1 {noun}") } else { format!("{number} {}", plural(noun)) }
}

/// "the director's", "the stairs'"
#[must_use]
pub fn possessive(noun: &str) -> String {
    if noun.ends_with(['s', 'S']) { format!("{noun}'") } else { format!("{noun}'s") }
}

/// English for a Russian name, where every word of it is known: «Комната-В» is "Room-B", «Письменный стол» "Desk".
///
/// Tags keep their look: В becomes B, the letter that looks like it, so that a sign on the wall is still found.
/// A name without Cyrillic letters is English already.
#[must_use]
pub fn name_of(name: &str) -> Option<String> {
    if !name.chars().any(is_cyrillic) {
        return Some(name.to_owned());
    }
    let lower = name.to_lowercase();
    let mut english = String::new();
    let mut rest = name;
    if let Some((russian, phrase)) = PHRASES.meant().iter().find(|(russian, _)| {
        lower.strip_prefix(russian).is_some_and(|tail| !tail.starts_with(char::is_alphabetic))
    }) {
        english.push_str(&cased_like(name, phrase));
        let letters = russian.chars().count();
        rest = name.char_indices().nth(letters).map_or("", |(at, _)| &name[at..]);
    }
    let runs = runs(rest);
    let mut wide = english.contains(' ');
    let mut noun_before = false;
    let mut at = 0;
    while let Some(run) = runs.get(at) {
        if let [digits, hyphen, ending] = &runs[at..runs.len().min(at + 3)]
            && hyphen.is_hyphen()
            && let Some(ordinal) = ordinal(digits.text, ending.text)
        {
            english.push_str(&ordinal);
            at += 3;
            continue;
        }
        match run.is_word {
            // "Bedside table 1": a hyphen would bind the number to the last word alone.
            false if run.is_hyphen() && wide && next_is_tag(&runs[at + 1..]) => {
                english.push(' ');
            }
            false => english.push_str(&run.text.replace('№', "No. ")),
            true => {
                let word =
                    word_of(run.text).or_else(|| plural_of(run.text).filter(|_| !noun_before))?;
                noun_before |= !words_of(run.text).is_empty();
                wide = word.contains(' ');
                english.push_str(&word);
            }
        }
        at += 1;
    }
    Some(english)
}

fn next_is_tag(runs: &[Run<'_>]) -> bool {
    runs.first().is_some_and(|run| is_tag(run.text))
}

/// A letter or two, or a number: what tells rooms of one kind apart.
fn is_tag(word: &str) -> bool {
    word.chars().count() <= 3
        && (word.chars().all(|c| c.is_uppercase() || c.is_numeric())
            || word.starts_with(|c: char| c.is_ascii_digit()))
}

/// «2-й» is "2nd".
fn ordinal(digits: &str, ending: &str) -> Option<String> {
    let number: u64 = digits.parse().ok()?;
    let suffix = match (number % 10, number % 100) {
        (_, 11..=13) => "th",
        (1, _) => "st",
        (2, _) => "nd",
        (3, _) => "rd",
        _ => "th",
    };
    ["й", "я", "е", "ый", "ая", "ое"].contains(&ending).then(|| format!("{number}{suffix}"))
}

/// All English words for a Russian noun, the usual one first: «диван» – sofa.
#[must_use]
pub fn words_of(noun: &str) -> &'static [String] {
    lexicon::find(&noun.to_lowercase()).map_or(&[], |entry| &entry.english)
}

/// All Russian nouns of the word list, with their English.
pub(crate) fn nouns() -> impl Iterator<Item = (&'static str, Vec<String>)> {
    lexicon::all().map(|(word, entry)| (word, entry.english))
}

/// Russian nouns of the word list that this English word stands for: "bed" – «кровать».
pub(crate) fn russian_of(english_name: &str) -> Vec<&'static str> {
    let lower = english_name.to_lowercase();
    let means = |entry: &&(&'static str, lexicon::Entry)| {
        entry.1.english.iter().take(1).any(|word| *word == lower)
    };
    let named =
        PHRASES.meant().iter().filter(|(_, english)| *english == lower).map(|(word, _)| *word);
    named
        .chain(lexicon::all().filter(|entry| means(&entry)).map(|(word, _)| word))
        .take(2)
        .collect()
}

fn word_of(word: &str) -> Option<String> {
    if !word.chars().any(is_cyrillic) {
        return Some(word.to_owned());
    }
    let lower = word.to_lowercase();
    let noun = lexicon::find(&lower).and_then(|entry| entry.english.first());
    if let Some(english) = noun {
        return Some(cased_like(word, english));
    }
    let masculine = Adjective::read(&lower).map(|adjective| adjective.masculine());
    let adjective =
        masculine.and_then(|m| ADJECTIVES.meant().iter().find(|(russian, _)| *russian == m));
    if let Some((_, english)) = adjective {
        return Some(cased_like(word, english));
    }
    // «ТВ» is no tag that only looks so.
    match word {
        "ТВ" => Some("TV".to_owned()),
        _ => is_tag(word).then(|| latin(word)),
    }
}

/// «стулья» is "chairs"; after a noun the same letters may be its genitive («кабинет директора»).
fn plural_of(word: &str) -> Option<String> {
    let singular = noun::singular_of(&word.to_lowercase())?;
    words_of(singular).first().map(|english| cased_like(word, &plural(english)))
}

/// Names that are one thing in English.
static PHRASES: Set = Set::named("NameInEnglish");

static ADJECTIVES: Set = Set::named("AdjectiveInEnglish");

fn cased_like(written: &str, english: &str) -> String {
    if written.starts_with(char::is_uppercase) { capitalized(english) } else { english.to_owned() }
}

/// A tag in Latin letters: each by its look, and where none looks like it by its usual transcription; a letter that
/// stands alone by its name where a look-alike has taken the transcription.
fn latin(tag: &str) -> String {
    const ALONE: [(&str, &str); 3] = [("Б", "Be"), ("З", "Ze"), ("П", "Pe")];
    const LATIN: [(char, &str); 20] = [
        ('Б', "B"),
        ('Г', "G"),
        ('Д', "D"),
        ('Ё', "E"),
        ('Ж', "Zh"),
        ('З', "Z"),
        ('И', "I"),
        ('Й', "J"),
        ('Л', "L"),
        ('П', "P"),
        ('Ф', "F"),
        ('Ц', "Ts"),
        ('Ч', "Ch"),
        ('Ш', "Sh"),
        ('Щ', "Shch"),
        ('Ы', "Y"),
        ('Э', "E"),
        ('Ю', "Yu"),
        ('Я', "Ya"),
        ('Ь', ""),
    ];
    if let Some((_, name)) = ALONE.iter().find(|(letter, _)| *letter == tag) {
        return (*name).into();
    }
    let one = |c: char| -> String {
        let capital = c.to_uppercase().next().unwrap_or(c);
        let twin =
            ('A'..='Z').find(|latin| cyrillic_twin(*latin) == Some(capital)).map(String::from);
        let listed = LATIN
            .iter()
            .find(|(letter, _)| *letter == capital)
            .map(|(_, latin)| (*latin).to_owned());
        let latin = twin.or(listed).unwrap_or_else(|| c.to_string());
        if c.is_lowercase() { latin.to_lowercase() } else { latin }
    };
    tag.chars().map(one).collect()
}

fn is_cyrillic(c: char) -> bool {
    ('\u{400}'..='\u{4ff}').contains(&c)
}

/// Names with a number, a tag or a possessor take no article.
fn is_proper(name: &str) -> bool {
    let mut words =
        name.split(|c: char| !c.is_alphanumeric() && c != '\'').filter(|word| !word.is_empty());
    let first = words.next().unwrap_or_default();
    let tagged = words.any(|word| {
        word.starts_with(|c: char| c.is_numeric())
            || (word.chars().count() <= 3
                && word.chars().all(|c| c.is_uppercase() || c.is_numeric()))
    });
    let spelled = name.chars().count() > 1
        && first.chars().all(|c| c.is_uppercase() || c.is_numeric())
        && first.chars().any(char::is_numeric);
    tagged || spelled || first.ends_with("'s") || name.chars().any(is_cyrillic)
}

fn begins_with_vowel_sound(noun: &str) -> bool {
    let word: String = noun
        .chars()
        .skip_while(|c| !c.is_alphanumeric())
        .take_while(|c| c.is_alphanumeric())
        .collect();
    let lower = word.to_lowercase();
    let starts = |heads: &[&str]| heads.iter().any(|head| lower.starts_with(head));
    let spelled = word.len() < 4 || !lower.contains(['a', 'e', 'i', 'o', 'u']);
    if word.len() > 1 && word.chars().all(char::is_uppercase) && spelled {
        return lower.starts_with(['a', 'e', 'f', 'h', 'i', 'l', 'm', 'n', 'o', 'r', 's', 'x']);
    }
    match () {
        () if starts(&[
            "hour", "honest", "honour", "honor", "heir", "x-ray", "xray", "8", "11", "18",
        ]) =>
        {
            true
        }
        () if starts(&["uni", "use", "usu", "uti", "euro", "one", "once", "ewe", "ubi"])
            && !starts(&["unin", "unim", "unid"]) =>
        {
            false
        }
        () => lower.starts_with(['a', 'e', 'i', 'o', 'u']),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn articles_follow_the_sound() {
        for (noun, expected) in [
            ("armchair", "an armchair"),
            ("unit", "a unit"),
            ("MRI room", "an MRI room"),
            ("USB socket", "a USB socket"),
            ("one-way door", "a one-way door"),
            ("8-seat table", "an 8-seat table"),
            ("umbrella", "an umbrella"),
            ("", "a "),
        ] {
            assert_eq!(a(noun), expected);
        }
        for (name, expected) in [
            ("Bookcase", "the bookcase"),
            ("IKEA desk", "the IKEA desk"),
            ("", ""),
            ("Office 12", "Office 12"),
            ("Door-BZ", "Door-BZ"),
            ("Anna's desk", "Anna's desk"),
            ("dining table", "the dining table"),
            ("Склад", "Склад"),
        ] {
            assert_eq!(with_article(name), expected);
        }
    }

    #[test]
    fn plurals_and_possessives() {
        for (one, many) in [
            ("box", "boxes"),
            ("tomato", "tomatoes"),
            ("Кукла Маша", "Кукла Маша"),
            ("shelf", "shelves"),
            ("nursery", "nurseries"),
            ("key", "keys"),
            ("living room", "living rooms"),
            ("chest of drawers", "chests of drawers"),
            ("Person", "People"),
            ("bench", "benches"),
            ("scissors", "scissors"),
        ] {
            assert_eq!(plural(one), many);
        }
        assert_eq!((possessive("boss"), possessive("robot")), ("boss'".into(), "robot's".into()));
        assert_eq!((count(1, "door"), count(3, "door")), ("1 door".into(), "3 doors".into()));
    }

    #[test]
    fn a_name_has_a_kind() {
        for (name, expected) in [
            ("red cup", Some("cup")),
            ("Room-B", Some("Room")),
            ("chest of drawers", Some("chest")),
            ("cup", None),
            ("", None),
        ] {
            assert_eq!(kind(name), expected, "{name}");
        }
    }

    #[test]
    fn russian_names_have_english_ones() {
        for (russian, english) in [
            ("Дверь-ВZ", Some("Door-BZ")),
            ("Письменный стол", Some("Desk")),
            ("Точка-К", Some("Point-K")),
            ("Красная чашка", Some("Red cup")),
            ("Стул 2", Some("Chair 2")),
            ("Тумбочка-1", Some("Bedside table 1")),
            ("2-й этаж", Some("2nd floor")),
            ("Дверь-1а", Some("Door-1a")),
            ("Кабинет №12-А", Some("Study No. 12-A")),
            ("Офисные стулья", Some("Office chairs")),
            ("ИБП", Some("IBP")),
            ("Корпус Б", Some("Building Be")),
            ("Кабинет директора", None),
            ("Room-Z", Some("Room-Z")),
            ("Шкаф-бар", Some("Bar cabinet")),
        ] {
            assert_eq!(name_of(russian).as_deref(), english, "{russian}");
        }
    }
}
