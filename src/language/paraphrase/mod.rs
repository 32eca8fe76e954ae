//! Paraphrases: other ways to say what the grammar reads, as the language files list them.
//!
//! ```text
//! same what does X contain = what is in X ?          a sentence with a gap
//! same … наружу … = … на улицу …                     words within a sentence: «…» is what stands before and behind
//! same … V:(put | set) X{1-4} down … = … V down X …  of one that is named the words are kept; a gap of one to four words
//! same … S:(свободен | свободна) = … S:(пуст | пуста)      for each of the words its own
//! same … S:закрыт* на ключ … = … S:заперт* …         any ending, which is kept
//! same … N:(nearer | closer) X{not to} = … N to X {unless or}      not in the gap; not in the sentence
//! set  Must = must | have to                         words in common, by whose name others have them
//! ```
//!
//! A statement is tried once, in the order of the file; what it has put is what the next are given.
//!
//! # Invariants
//!
//! - Every gap and every word that is named stands on both sides: nothing that was named is lost.
//! - No sentence makes it panic, or search longer than the square of its length.

mod pattern;
mod read;
mod row;
mod words;

use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use crate::scan::{Scanner, Unread, statements};
use crate::units::{Carried, InOrder as _, carried};
use crate::words::{Language, word_keys};
pub(crate) use row::Stage;
use row::{Paraphrase, Sets};
pub(crate) use words::{Kind, Sense, Words, lost};

/// The built-in files, by their paths within `rules/language`.
pub static FILES: [(&str, Carried); 4] = [
    ("ru/orders.lang", carried!("../../../rules/language/ru/orders.lang")),
    ("en/orders.lang", carried!("../../../rules/language/en/orders.lang")),
    ("ru/paraphrases.lang", carried!("../../../rules/language/ru/paraphrases.lang")),
    ("en/paraphrases.lang", carried!("../../../rules/language/en/paraphrases.lang")),
];

/// The paraphrases of each language.
#[derive(Debug, Default)]
pub struct Paraphrases {
    russian: Rows,
    english: Rows,
    /// Of orders, of each stage, in either language: their words and names may be of both.
    orders: [Rows; 3],
}

/// An order as it is put plainly, and the words that were left out because they are not meant.
pub(crate) type Ordered = (String, Vec<String>);

#[derive(Debug, Default)]
struct Rows {
    sets: Sets,
    all: Vec<Paraphrase>,
    /// Those that a sentence with a word may be said in, in their order.
    by_word: HashMap<String, Vec<usize>>,
    /// Those of which no word is certain.
    of_any: Vec<usize>,
}

impl Rows {
    fn add(&mut self, row: Paraphrase) {
        let at = self.all.len();
        // The part whose shortest word is longest: long words are rare.
        let required = row.pattern.parts.iter().filter_map(pattern::Part::required);
        let shortest = |words: &Vec<&str>| words.iter().map(|word| word.len()).min();
        match required.max_by_key(shortest) {
            Some(words) => {
                for word in words {
                    self.by_word.entry(word.to_owned()).or_default().push(at);
                }
            }
            None => self.of_any.push(at),
        }
        self.all.push(row);
    }

    /// Those of which a sentence may be, from one on.
    fn may_be(&self, words: &Words<'_>, from: usize) -> Vec<usize> {
        let by_word = words.keys.iter().filter_map(|key| self.by_word.get(key)).flatten();
        let mut found: Vec<usize> =
            by_word.chain(&self.of_any).copied().filter(|at| *at >= from).collect();
        found.order();
        found.dedup();
        found
    }

    /// The first that puts a text plainly, from one on, and what it puts.
    fn first(&self, words: &Words<'_>, from: usize) -> Option<(usize, String)> {
        let may_be = self.may_be(words, from);
        may_be.into_iter().find_map(|at| Some((at, self.all[at].put(words)?)))
    }
}

impl Paraphrases {
    /// Those that are built in.
    ///
    /// # Panics
    /// When these have a fault, which a test rules out.
    #[must_use]
    pub fn built_in() -> Arc<Self> {
        static BUILT_IN: OnceLock<Arc<Paraphrases>> = OnceLock::new();
        let all = BUILT_IN.get_or_init(|| {
            let mut all = Self::default();
            for (path, text) in &FILES {
                for statement in statements(text) {
                    let language = language_of(path).expect("the folder of a language");
                    all.read(language, text, &statement).expect("they are sound");
                }
            }
            Arc::new(all)
        });
        Arc::clone(all)
    }

    /// Adds a statement of a language file.
    ///
    /// # Errors
    /// What is expected, and where.
    pub fn read(
        &mut self,
        language: Language,
        text: &str,
        statement: &Range<usize>,
    ) -> Result<(), Unread> {
        let rows = match language {
            Language::Russian => &mut self.russian,
            Language::English => &mut self.english,
        };
        let mut scan = Scanner::of(text, statement);
        if scan.takes("set ") {
            let (name, words) = read::set(scan, &rows.sets, language)?;
            rows.sets.insert(name, words);
            return Ok(());
        }
        let orders = scan.takes("ordered ");
        if !orders {
            scan.needs("same ", ("«same», «ordered» или «set»", "“same”, “ordered” or “set”"))?;
        }
        let mut row = read::paraphrase(scan, &rows.sets, language)?;
        row.is_order = orders;
        match orders {
            true => self.orders[row.stage as usize].add(row),
            false => rows.add(row),
        }
        Ok(())
    }

    /// An order in the words that are meant, by the lines of a stage; none where these change nothing. A line is tried while it changes something, as a sentence may have several of one construction.
    pub(crate) fn ordered(
        &self,
        text: &str,
        stage: Stage,
        senses: fn(&Words<'_>) -> Vec<Sense>,
    ) -> Option<Ordered> {
        /// No sentence has more of one construction.
        const MOST: usize = 4;
        let rows = &self.orders[stage as usize];
        let mut plain: Option<String> = None;
        let mut not_meant = Vec::new();
        let (mut from, mut times) = (0, 0);
        loop {
            let mut words = Words::of(plain.as_deref().unwrap_or(text))?;
            words.senses = senses(&words);
            let Some((at, put)) = rows.first(&words, from) else { break };
            times = if at == from { times + 1 } else { 1 };
            if rows.all[at].drops {
                not_meant.extend(lost(&words.keys, &word_keys(&put)));
            }
            if times == MOST || put == words.text {
                (from, times) = (at + 1, 0);
            } else {
                from = at;
            }
            plain = Some(put);
        }
        plain.map(|plain| (plain, not_meant))
    }

    /// A text in the words that are meant.
    pub(crate) fn plain<'t>(&self, text: &'t str) -> Cow<'t, str> {
        let rows = match Language::of(text) {
            Language::Russian => &self.russian,
            Language::English => &self.english,
        };
        let (mut plain, mut from) = (Cow::Borrowed(text), 0);
        while let Some(words) = Words::of(&plain)
            && let Some((at, put)) = rows.first(&words, from)
        {
            from = at + 1;
            plain = Cow::Owned(put);
        }
        plain
    }
}

/// The language of which a file of `rules/language` is, by its folder, where the program speaks it.
#[must_use]
pub fn language_of(path: &str) -> Option<Language> {
    match path.split_once('/')?.0 {
        "ru" => Some(Language::Russian),
        "en" => Some(Language::English),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Source;

    #[test]
    fn everyday_constructions_become_plain_ones() {
        let all = Paraphrases::built_in();
        let check = |text: &str, expected: &str| assert_eq!(all.plain(text), expected, "{text}");
        check("What does the bedroom contain?", "what is in the bedroom?");
        check("Which rooms does Door 1 connect?", "what does Door 1 join?");
        check("What do we have more of, chairs or books?", "are there more chairs or books?");
        check("How many rooms have paintings in them?", "How many rooms have paintings?");
        check("Does the room have both a bed and a desk?", "Does the room have a bed and a desk?");
        check("Где искать статуэтку?", "где статуэтку?");
        check(
            "Что ещё есть на том же столе, где и газета?",
            "Что ещё есть на том же столе что и газета?",
        );
        check("Which rooms have books but no lamps?", "which rooms with books are without lamps?");
        check(
            "Which door connects the hall with the lab?",
            "Which door connects the hall and the lab?",
        );
        check("От хлеба до чашки ближе, чем до яблока?", "хлеба ближе к чашки, чем к яблока?");
        check("Правда, что газета на диване?", "правда ли, что газета на диване?");
        check("Where are both chairs?", "Where are both chairs?");
        check("В каких комнатах есть кровать, но нет лампы?", "комнаты с кроватью без лампы?");
        check("Where'd I leave my keys?", "Where did I leave my keys?");
        check("Закрыта ли дверь на ключ?", "Заперта ли дверь?");
        check("Закрой дверь на ключ", "Закрой дверь на ключ");
        check("Which room has neither a lamp nor a bed?", "Which room without a lamp or a bed?");
        check("Это далеко?", "как далеко туда?");
        check("Which room is that?", "which room is it in?");
        check("Какая дверь ведёт наружу?", "Какая дверь ведёт на улицу?");
        check("Откуда можно попасть в ванную?", "из каких комнат можно попасть в ванную?");
        check("Is there any room without windows?", "Is there a room without windows?");
        check("Is there any room on the desk?", "Is there any room on the desk?");
        check("Откуда ты это знаешь?", "Откуда ты это знаешь?");
        check("Which table has the most things on it?", "Which table has the most things?");
        check("Which chair has nothing on it?", "Which chair is empty?");
        check("Теперь спускайся!", "Теперь спускайся вниз!");
        check("Отнеси одну из тарелок в зал", "Отнеси одну тарелок в зал");
        check(
            "Open the door that connects the hall to the lab",
            "Open the door between the hall and the lab",
        );
        check(
            "Какого цвета дверь, соединяющая холл с кухней?",
            "Какого цвета дверь между холл и кухней?",
        );
        check("Закрыта ли дверь, ведущая на улицу?", "Закрыта ли наружный выход?");
        check(
            "Is the door from the hall to the outside locked?",
            "Is the outer door from the hall locked?",
        );
        check("What is to its left?", "What is to the left of it?");
        check("Какая дверь соединяет холл с кухней?", "Какая дверь соединяет холл с кухней?");
        check("Смотрит ли кресло на диван?", "стоит ли кресло лицом к диван?");
        check("What does the TV stand have on it?", "What is on the TV stand?");
        check("Что у тебя за спиной?", "Что позади тебя?");
        check("Назови три самых высоких шкафа", "Назови три самые высокие шкафа");
        check("Which things can I move?", "Which things can be moved?");
        check("Книга-1 лежит или стоит?", "Книга-1 горизонтальный или вертикальный?");
        check("Что лежит или стоит на столе?", "Что лежит или стоит на столе?");
        check("What else is there but an apple?", "What else is there except an apple?");
        check("я дверь закрыл?", "я дверь закрыт?");
        check("кто-нибудь закрыл дверь?", "закрыт дверь?");
        check("кто закрыл дверь?", "кто закрыл дверь?");
        check("какую дверь закрыли?", "какую дверь закрыли?");
        check("did I lock the front door?", "is the front door locked?");
        check("did somebody turn the lamp off?", "is the lamp switched off?");
        check("did you lock the door?", "did you lock the door?");
        check("Кровать застелена?", "Кровать чиста?");
        check("", "");
    }

    #[test]
    fn every_fault_tells_what_is_expected_and_where() {
        let text = "same где X = X\nsame X = где X\nsame где X Y = где X\nsame где X = где Z\n\
                    same … где X = где X\nsame V:(где | куда) = V:(а | б | в)\n\
                    same где X{2-1 или} = X\nsame где (дом = где\nset a = b\nset A = b |\nsame = где\n\
                    same где X = X[вин]\nsame (B) = где\nsame где X = где X {when а}\nsame X где X = X\n";
        let source = Source::new("a.lang", text);
        let mut all = Paraphrases::default();
        let places: Vec<String> = statements(text)
            .iter()
            .filter_map(|statement| all.read(Language::Russian, text, statement).err())
            .map(|unread| {
                let (line, column) = source.position(unread.at.start);
                format!("{line}:{column} {}", unread.expected.say(Language::English))
            })
            .collect();
        expect_test::expect![[r#"
            2:6 a word that is required
            3:12 a name that stands on the right too: “Y” would be lost
            4:18 a name of the left side: X
            5:16 “…” as on the left
            6:35 as many choices as on the left: 2
            7:16 a number, “not” or “}”
            8:15 “)” or “|”
            9:5 a name in Latin capitals
            10:12 a word
            11:6 a word that is required
            12:19 a case: nom, gen, dat, acc, ins or loc
            13:7 a word, or a name of a line “set”
            14:21 a condition, or “}”
            15:12 another name"#]]
        .assert_eq(&places.join("\n"));
    }

    /// Nothing that is said makes it panic or takes it long.
    #[test]
    fn every_order_of_the_words_of_patterns_is_put_or_left() {
        let all = Paraphrases::built_in();
        for (_, text) in &FILES {
            let words: Vec<&str> = text.split_whitespace().filter(|w| w.len() > 1).collect();
            for step in 1..40 {
                for start in (0..words.len()).step_by(11) {
                    let some = (0..step).map(|n| words[(start + n * step) % words.len()]);
                    let _ = all.plain(&some.collect::<Vec<_>>().join(" "));
                }
            }
        }
        let long = "from does which have things on it or the ".repeat(200);
        assert!(!all.plain(&long).is_empty());
    }
}
