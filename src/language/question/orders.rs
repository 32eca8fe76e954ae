//! A text that orders and asks: «Скажи, где ваза, и принеси её», "Go to the bedroom and tell me what you see".

use std::ops::Range;

use super::Asker;
use crate::language::command::is_order;
use crate::language::words::{Language, phrase_at, word_keys, word_ranges};

impl Asker<'_> {
    /// What is to be heard one after the other: «Скажи, где ваза, и принеси её» is a question and an order, "Go to the
    /// bedroom and tell me what you see" an order and a question. None where the text is one or the other.
    #[must_use]
    pub fn orders_and_questions(&self, text: &str) -> Option<Vec<String>> {
        if !self.begins_as_question(text) {
            let (order, question) = order_and_question(text)?;
            let question = whether(&question).unwrap_or(question);
            if !self.begins_as_question(&question) && !question.ends_with('?') {
                return None;
            }
            // "Go and see …": whither is not said, and need not be.
            let bare = word_ranges(order).len() < 2;
            let order = Some(order).filter(|_| !bare).map(str::to_owned);
            return Some(order.into_iter().chain([question]).collect());
        }
        [" и ", " and ", ", then ", ", затем ", ", потом "].iter().find_map(|joint| {
            let (question, order) = text.rsplit_once(joint)?;
            let question = question.trim_end_matches(',');
            is_order(order).then(|| vec![question.to_owned(), order.to_owned()])
        })
    }
}

/// What is told to be found out, as a question: «скажи, выключена ли лампа», "tell me whether the fridge is on".
fn whether(text: &str) -> Option<String> {
    let (words, keys) = (word_ranges(text), word_keys(text));
    let said = |range: Range<usize>| match range.is_empty() {
        true => String::new(),
        false => text[words[range.start].start..words[range.end - 1].end].to_owned(),
    };
    if keys.iter().any(|key| key == "ли") {
        return Some(format!("{}?", said(1..words.len())));
    }
    let at = keys.iter().position(|key| key == "whether" || key == "if")?;
    let is = (at + 1..keys.len()).find(|&n| matches!(keys[n].as_str(), "is" | "are"))?;
    let (what, state) = (said(at + 1..is), said(is + 1..words.len()));
    Some(format!("{} {what} {state}?", keys[is]))
}

/// An order and the question after it, or the question that is to be reported: «доложи, что ты видишь».
fn order_and_question(text: &str) -> Option<(&str, String)> {
    const TELL: [&str; 24] = [
        "скажи",
        "скажите",
        "расскажи",
        "сообщи",
        "доложи",
        "посмотри",
        "глянь",
        "проверь",
        "узнай",
        "выясни",
        "tell me",
        "tell us",
        "let me know",
        "report",
        "report back",
        "say",
        "check",
        "look",
        "see",
        "find out",
        "describe",
        "tell",
        "опиши",
        "перечисли",
    ];
    /// Behind these stands what is to be so, and no question.
    const THAT: [&str; 3] = ["that", "что бы", "чтобы"];
    const ROUND: [&str; 5] =
        ["look around", "have a look around", "look round", "осмотрись", "оглядись"];
    let (words, keys) = (word_ranges(text), word_keys(text));
    if ROUND.contains(&keys.join(" ").as_str()) {
        let question = Language::of(text).pick("Что ты видишь?", "What do you see?");
        return Some(("", question.to_owned()));
    }
    for at in 0..keys.len() {
        let Some(taken) = TELL.iter().filter_map(|tell| phrase_at(&keys, at, tell)).max() else {
            continue;
        };
        let asked = at + taken;
        if asked >= words.len() || THAT.iter().any(|w| phrase_at(&keys, asked, w).is_some()) {
            continue;
        }
        let order = text[..words[at].start].trim_end();
        let mut order = order.trim_end_matches([',', ';', '.']);
        for joint in [" и", " а", " and", " then", " потом", " затем", " мне"] {
            order = order.strip_suffix(joint).unwrap_or(order).trim_end().trim_end_matches(',');
        }
        if at == 0 || is_order(order) {
            let tell = Language::of(text).pick("скажи, ", "tell me ");
            let order = if at == 0 { "" } else { order };
            return Some((order, format!("{tell}{}", &text[words[asked].start..])));
        }
    }
    None
}
