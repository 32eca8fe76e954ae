//! What a text that was not understood may ask: a frame in its own words, and without those that no part of the frame uses.
//!
//! Invariant: it is offered and never answered unasked; a word that may turn a question about ([`Tongue::reserved`]) is never
//! left out.

use super::chart::Chart;
use super::cover::{Left, readings_without};
use super::grammar::{Grammar, OF_THE_MAP, Tongue};
use super::words::{Edge, Map, Sentence, Token, tokens_across};
use crate::language::Language;

/// Words of the longest text in which a question is looked for.
const LONGEST: usize = 40;
/// What may be left out at most, by the prices below.
const DEAREST: u32 = 16;
/// Questions that are offered at most, before they are asked.
const MOST: usize = 8;

impl Grammar {
    /// The questions that a text comes nearest to, the nearest first, in its own words; where they may be `broken`, with
    /// words of the clause that asks left out.
    #[must_use]
    pub fn near(&self, map: &Map<'_>, text: &str, broken: bool) -> Vec<String> {
        let tokens = tokens_across(text);
        if tokens.is_empty() || tokens.len() > LONGEST {
            return Vec::new();
        }
        let Map { world, lexicon, words, .. } = *map;
        let language = Language::of(text);
        let sentence = Sentence { text, tokens: &tokens, language, world, lexicon, words };
        let Some((_, tongue)) = self.tongues_for(language).next() else { return Vec::new() };
        let edges = sentence.edges(tongue, &self.signatures);
        let chart = Chart::of(&tokens, edges, tongue, &self.signatures);
        let left = prices(&chart, tongue, broken);
        let mut found: Vec<String> = Vec::new();
        for reading in readings_without(&chart, tongue, &self.signatures, &left) {
            let names = |at: &usize| chart.over(*at).any(|edge| is_of_map(edge.category));
            let question = in_words(text, &tokens, &reading.used);
            if reading.used.iter().any(names) && !found.contains(&question) {
                found.push(question);
            }
        }
        found.truncate(MOST);
        found
    }
}

fn is_of_map(category: u16) -> bool {
    usize::from(category) < OF_THE_MAP.len()
}

/// What it costs to leave out words: most what the map names, least what nothing knows; within the clause that asks more than
/// in another, and none where that is only to be `broken` off.
fn prices(chart: &Chart<'_>, tongue: &Tongue, broken: bool) -> Left {
    let price = |at: usize| {
        let token = &chart.tokens[at];
        let is_reserved =
            |edge: &Edge| tongue.reserved.contains(&edge.category) && edge.to == edge.from + 1;
        match (chart.over(at).any(is_reserved), chart.over(at).any(|edge| is_of_map(edge.category)))
        {
            _ if token.is_mark() => (Some(0), Some(1)),
            (true, _) => (None, None),
            (_, true) => (Some(2), Some(6)),
            _ if tongue.words.contains_key(&token.key) || tongue.literals.contains(&token.key) => {
                (Some(1), Some(4))
            }
            _ => (Some(1), Some(1)),
        }
    };
    let (aside, own): (Vec<Price>, Vec<Price>) = (0..chart.tokens.len()).map(price).unzip();
    let both = |a: Price, b: Price| a.zip(b).map(|(a, b)| a + b);
    let sum = |prices: &[Price]| prices.iter().copied().fold(Some(0), both);
    let is_mark = |at: &usize| chart.tokens[*at].is_mark();
    let end = chart.tokens.len();
    let before = |at: usize| {
        let from = (0..at).rfind(is_mark).map_or(0, |mark| mark + 1);
        both(sum(&aside[..from]), sum(&own[from..at]))
    };
    let behind = |at: usize| {
        let to = (at..end).find(is_mark).unwrap_or(end);
        let rest = Some(()).filter(|()| broken || to == at);
        both(rest.and_then(|()| sum(&own[at..to])), sum(&aside[to..]))
    };
    Left {
        before: (0..=end).map(before).collect(),
        behind: (0..=end).map(behind).collect(),
        within: if broken { own } else { vec![None; end] },
        dearest: DEAREST,
    }
}

/// What it costs to leave out a word.
type Price = Option<u32>;

/// Words of a text as a question: those that stand together as they are written.
fn in_words(text: &str, tokens: &[Token], used: &[usize]) -> String {
    let mut question = String::new();
    for (n, at) in used.iter().enumerate() {
        let before = n.checked_sub(1).map(|n| used[n]);
        question.push_str(match before {
            Some(before) if before + 1 == *at => &text[tokens[before].at.end..tokens[*at].at.start],
            Some(_) => " ",
            None => "",
        });
        question.push_str(&text[tokens[*at].at.clone()]);
    }
    question.push('?');
    crate::units::capitalized(&question)
}
