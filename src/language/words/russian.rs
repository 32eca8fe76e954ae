//! Russian around a name: prepositions that sound right before it, numbers that agree with it.
//!
//! ```
//! use orthoframe_language::{NounPhrase, WordHints, russian};
//! let name = |name| NounPhrase::parse(name, &WordHints::default());
//! assert_eq!(russian::where_at(&name("Комната-В")), "в Комнате-В");
//! assert_eq!(russian::whence(&name("Кухня")), "с Кухни");
//! assert_eq!(russian::whither(&name("Второй зал")), "во Второй зал");
//! assert_eq!(russian::count(5, &name("дверь")), "5 дверей");
//! ```

use super::adjective::{Adjective, is_vowel};
use super::grammar::{Animacy, Case, Gender, Number, PlaceSense};
use super::letters::is_acronym;
use super::phrase::NounPhrase;

/// The prepositions that a robot needs; those with two spellings choose by the next word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Preposition {
    /// в, во
    V,
    Na,
    /// с, со
    S,
    /// к, ко
    K,
    /// о, об, обо
    O,
    Iz,
    Ot,
    Do,
    U,
    Okolo,
    Cherez,
    /// под, подо
    Pod,
    /// над, надо
    Nad,
    /// перед, передо
    Pered,
    Za,
    Mezhdu,
    Po,
}

/// The preposition as it is spelled before this form.
#[must_use]
pub fn preposition(preposition: Preposition, next: &str) -> &'static str {
    let word = Word::first(next);
    let full = word.wants_vowel(preposition);
    match preposition {
        Preposition::V => {
            if full {
                "во"
            } else {
                "в"
            }
        }
        Preposition::S => {
            if full {
                "со"
            } else {
                "с"
            }
        }
        Preposition::K => {
            if full {
                "ко"
            } else {
                "к"
            }
        }
        Preposition::O if full => "обо",
        Preposition::O => {
            if word.starts_with_vowel_sound() {
                "об"
            } else {
                "о"
            }
        }
        Preposition::Iz => {
            if full {
                "изо"
            } else {
                "из"
            }
        }
        Preposition::Ot => {
            if full {
                "ото"
            } else {
                "от"
            }
        }
        Preposition::Pod => {
            if full {
                "подо"
            } else {
                "под"
            }
        }
        Preposition::Nad => {
            if full {
                "надо"
            } else {
                "над"
            }
        }
        Preposition::Pered => {
            if full {
                "передо"
            } else {
                "перед"
            }
        }
        Preposition::Na => "на",
        Preposition::Do => "до",
        Preposition::U => "у",
        Preposition::Okolo => "около",
        Preposition::Cherez => "через",
        Preposition::Za => "за",
        Preposition::Mezhdu => "между",
        Preposition::Po => "по",
    }
}

/// Preposition and name in this case: «к Двери-ВZ».
#[must_use]
pub fn with(before: Preposition, case: Case, phrase: &NounPhrase) -> String {
    let form = phrase.case(case);
    format!("{} {form}", preposition(before, &form))
}

/// «в Комнате-В», «на Кухне», «в шкафу»
#[must_use]
pub fn where_at(place: &NounPhrase) -> String {
    with(inside_or_upon(place), Case::Locative, place)
}

/// «в Комнату-Z», «на Кухню»
#[must_use]
pub fn whither(place: &NounPhrase) -> String {
    with(inside_or_upon(place), Case::Accusative, place)
}

/// «из Комнаты-В», «с Кухни»
#[must_use]
pub fn whence(place: &NounPhrase) -> String {
    let before = match place.place() {
        PlaceSense::Inside => Preposition::Iz,
        PlaceSense::Upon => Preposition::S,
    };
    with(before, Case::Genitive, place)
}

fn inside_or_upon(place: &NounPhrase) -> Preposition {
    match place.place() {
        PlaceSense::Inside => Preposition::V,
        PlaceSense::Upon => Preposition::Na,
    }
}

/// An adjective or participle, given in the masculine, as it agrees with an inanimate noun: «ведущей», «ведущих».
#[must_use]
pub fn agreeing(adjective: &str, case: Case, number: Number, gender: Gender) -> String {
    Adjective::read(adjective).map_or_else(
        || adjective.to_owned(),
        |read| read.form(case, number, gender, Animacy::Inanimate),
    )
}

/// Number and name in the nominative: «1 дверь», «2 двери», «5 дверей», «21 дверь».
#[must_use]
pub fn count(number: u64, phrase: &NounPhrase) -> String {
    format!("{number} {}", phrase.counted(number))
}

/// The first word after a preposition, as the ear meets it.
struct Word {
    /// In lower case; for an abbreviation that is spelled out, the name of its first letter.
    sound: String,
}

impl Word {
    fn first(text: &str) -> Self {
        let start = text.trim_start_matches(|c: char| !c.is_alphanumeric());
        // A hyphen ends the word too, but «2-й» is one word for the ear.
        let end = start.find(|c: char| !c.is_alphanumeric() && c != '-').unwrap_or(start.len());
        let whole = &start[..end];
        let word = whole.split('-').next().unwrap_or(whole);
        let lower = word.to_lowercase();
        let spelled = word.chars().count() == 1 && !word.chars().all(char::is_lowercase)
            || (is_acronym(word) && is_spelled_out(&lower));
        let sound = match lower.chars().next() {
            Some(letter) if letter.is_ascii_digit() => digit_sound(whole).to_owned(),
            Some(letter) if spelled || letter.is_ascii_alphabetic() => {
                letter_name(letter, spelled).to_owned()
            }
            _ => lower,
        };
        Self { sound }
    }

    fn starts_with_vowel_sound(&self) -> bool {
        self.sound.starts_with(['а', 'э', 'и', 'о', 'у', 'ы'])
    }

    fn wants_vowel(&self, before: Preposition) -> bool {
        const PRONOUNS: [&str; 4] = ["мне", "мной", "мною", "мню"];
        let sound = self.sound.as_str();
        let starts = |heads: &[&str]| heads.iter().any(|head| sound.starts_with(head));
        let all = starts(&["всем", "всех", "всей", "всю"]) || sound == "всё" || sound == "все";
        let second = starts(&["второ", "втори", "вторы", "вторн", "вторую", "вторая"]);
        let cluster = |first: &[char]| {
            let mut letters = sound.chars();
            letters.next().is_some_and(|c| first.contains(&c))
                && letters.next().is_some_and(|c| !is_vowel(c) && c.is_alphabetic() && c != 'ь')
        };
        let short = [
            "льду",
            "льда",
            "льдом",
            "льде",
            "лба",
            "лбу",
            "лбом",
            "рту",
            "рта",
            "ртом",
            "сна",
            "сне",
            "сну",
            "мху",
            "мха",
            "дня",
            "дну",
            "дню",
            "льве",
            "львове",
        ];
        match before {
            Preposition::V => {
                cluster(&['в', 'ф'])
                    || all
                    || starts(&["льв"])
                    || [
                        "дворе",
                        "двор",
                        "льду",
                        "льдах",
                        "лбу",
                        "рту",
                        "сне",
                        "мху",
                        "мне",
                        "мраке",
                        "многих",
                    ]
                    .contains(&sound)
            }
            Preposition::S => {
                cluster(&['с', 'з', 'ш', 'ж'])
                    || starts(&["льв"])
                    || sound.starts_with('щ')
                    || all
                    || second
                    || PRONOUNS.contains(&sound)
                    || ["двора", "дна", "льда", "лба"].contains(&sound)
            }
            Preposition::K => {
                all || second
                    || sound == "мне"
                    || ["двору", "дну", "дню", "льду", "лбу", "рту", "сну"].contains(&sound)
            }
            Preposition::O => sound == "мне" || all,
            Preposition::Iz | Preposition::Ot => {
                all || short[..10].contains(&sound) && sound != "льдом"
            }
            Preposition::Pod | Preposition::Nad | Preposition::Pered => {
                PRONOUNS.contains(&sound) || all || ["льдом", "лбом", "ртом"].contains(&sound)
            }
            _ => false,
        }
    }
}

/// «МФУ» is spelled out, «СТО» is read as a word.
fn is_spelled_out(lower: &str) -> bool {
    let mut letters = lower.chars();
    let sonorant = letters.next().is_some_and(|c| matches!(c, 'м' | 'н' | 'л' | 'р' | 'ф'));
    !lower.chars().any(is_vowel) || (sonorant && letters.next().is_some_and(|c| !is_vowel(c)))
}

/// How the name of a letter begins: В is «вэ», but Р is «эр».
fn letter_name(letter: char, spelled: bool) -> &'static str {
    match letter {
        'р' | 'н' | 'л' | 'м' | 'с' | 'ф' if spelled => "эр",
        'f' | 'l' | 'm' | 'n' | 's' | 'x' | 'r' if spelled => "эф",
        'a' | 'e' | 'i' | 'o' | 'u' | 'а' | 'е' | 'и' | 'о' | 'у' | 'э' => "а",
        _ => "бэ",
    }
}

/// How a number sounds at its beginning, as far as a preposition hears it.
fn digit_sound(whole: &str) -> &'static str {
    let digits: String = whole.chars().take_while(char::is_ascii_digit).collect();
    let ordinal = whole.len() > digits.len();
    match digits.as_str() {
        "2" if ordinal => "второй",
        "1" => {
            if ordinal {
                "первый"
            } else {
                "один"
            }
        }
        "11" => "одиннадцать",
        _ if digits.starts_with("8") && matches!(digits.len(), 1 | 2) => "восемь",
        _ => "три",
    }
}

#[cfg(test)]
mod tests {
    use super::super::grammar::WordHints;
    use super::*;

    #[test]
    fn prepositions_follow_the_next_word() {
        let cases = [
            (Preposition::V, "Владимире", "во"),
            (Preposition::V, "Второй комнате", "во"),
            (Preposition::V, "2-й комнате", "во"),
            (Preposition::V, "вазе", "в"),
            (Preposition::V, "дворе", "во"),
            (Preposition::V, "Комнате-В", "в"),
            (Preposition::V, "ВЦ", "в"),
            (Preposition::S, "стола", "со"),
            (Preposition::S, "шкафа", "со"),
            (Preposition::S, "сервера", "с"),
            (Preposition::S, "Щита", "со"),
            (Preposition::K, "двери", "к"),
            (Preposition::K, "второму столу", "ко"),
            (Preposition::O, "окне", "об"),
            (Preposition::O, "ёлке", "о"),
            (Preposition::O, "Ящике", "о"),
            (Preposition::O, "мне", "обо"),
            (Preposition::O, "МФУ", "об"),
            (Preposition::O, "СТО-2", "о"),
            (Preposition::Iz, "«Комнаты»", "из"),
            (Preposition::V, "", "в"),
        ];
        for (before, next, expected) in cases {
            assert_eq!(preposition(before, next), expected, "before {next}");
        }
    }

    #[test]
    fn numbers_agree() {
        let count = |n, name: &str| count(n, &NounPhrase::parse(name, &WordHints::default()));
        assert_eq!(count(1, "дверь"), "1 дверь");
        assert_eq!(count(2, "дверь"), "2 двери");
        assert_eq!(count(12, "дверь"), "12 дверей");
        assert_eq!(count(21, "дверь"), "21 дверь");
        assert_eq!(count(111, "стол"), "111 столов");
        assert_eq!(count(3, "письменный стол"), "3 письменных стола");
        assert_eq!(count(4, "красная чашка"), "4 красные чашки");
        assert_eq!(count(2, "гостиная"), "2 гостиные");
        assert_eq!(count(5, "ворота"), "5 ворот");
        assert_eq!(count(0, "стул"), "0 стульев");
        assert_eq!(count(5, "человек"), "5 человек");
    }
}
