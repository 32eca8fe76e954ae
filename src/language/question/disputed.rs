//! Two who say different things: "My wife says the vase is in the kitchen, but I think it's in the bedroom. Who is right?"
//!
//! Invariant: each claim is judged by the map, and neither by the other; where one of them is not understood, or not known,
//! nothing is said of the two.

use super::clauses::{JOINTS, is_reported};
use super::mark::Mark;
use super::why::without_verdict;
use super::{Answer, Asker, Memory, Said, vocabulary};
use crate::sets::Set;
use crate::words::{Language, word_keys, word_ranges};

/// Words between the claim of one and that of the other.
static BETWEEN: Set = Set::named("BetweenClaims");

impl Asker<'_> {
    /// Which of two claims is so, where a line tells both and asks who is right.
    pub(super) fn who_is_right(
        &self,
        text: &str,
        language: Language,
        memory: &mut Memory,
    ) -> Option<Answer> {
        let claims = disputed(text)?;
        let mut after = memory.clone();
        let [first, second] = claims.map(|claim| self.judged(claim, language, &mut after));
        let (first, second) = (first?, second?);
        let told = |answer: &Answer| without_verdict(&answer.text).to_owned();
        let text = match (first.said, second.said) {
            (Said::Yes, Said::Yes) => {
                let both = language.pick("Верно и то и другое", "Both are right");
                format!("{both}: {}; {}.", told(&first), told(&second))
            }
            (Said::Yes, _) => {
                format!(
                    "{}: {}.",
                    language.pick("Верно первое", "The first is right"),
                    told(&first)
                )
            }
            (_, Said::Yes) => {
                let right = language.pick("Верно второе", "The second is right");
                format!("{right}: {}.", told(&second))
            }
            _ => {
                let neither = language.pick("Ни то ни другое не верно", "Neither is right");
                format!("{neither}: {}.", told(&first))
            }
        };
        let answer = Answer {
            text,
            said: Said::Found,
            so: None,
            ..Answer::joined(vec![first, second], language)
        };
        memory.learn(&answer);
        Some(answer)
    }

    /// Whether what somebody says is so: a whole claim, or the place that another claim gave otherwise.
    fn judged(&self, claim: &str, language: Language, memory: &mut Memory) -> Option<Answer> {
        let and = language.pick("а", "and");
        let judged = |asked: &str| {
            let answer = self.answer(asked, language, memory).ok()?;
            matches!(answer.said, Said::Yes | Said::No).then_some(answer)
        };
        let answer = judged(&format!("{claim}?")).or_else(|| judged(&format!("{and} {claim}?")))?;
        memory.learn(&answer);
        Some(answer)
    }
}

/// The two claims of a line that ends by asking who is right.
fn disputed(text: &str) -> Option<[&str; 2]> {
    let (words, keys) = (word_ranges(text), word_keys(text));
    let asks =
        |n: &usize| vocabulary::taken_by(Mark::WhoIsRight, &keys[*n..]) == Some(keys.len() - n);
    let end = (1..keys.len()).find(asks)?;
    let begins = |n: &usize| is_reported(&keys[..*n]) && !JOINTS.contains(&keys[*n].as_str());
    let [first, second] = (1..end).filter(begins).collect::<Vec<_>>()[..] else { return None };
    // Who says it, and the word for that, belong to the second claim.
    let joints = keys[..second].iter().rev().take_while(|key| JOINTS.contains(&key.as_str()));
    let says = second - joints.count() - 1;
    let between = (first + 1..says).rev().find(|n| BETWEEN.contains(&keys[*n].as_str()));
    let mark = text[words[first].start..words[says].start].rfind([',', ';', '.', '–', '—']);
    let cut = between.map(|n| words[n].start).max(mark.map(|at| words[first].start + at))?;
    let marks = [' ', ',', ';', '.', '!', '–', '—', ':'];
    let claim = |from: usize, to: usize| text[from..to].trim_end_matches(marks);
    Some([claim(words[first].start, cut), claim(words[second].start, words[end].start)])
}

#[cfg(test)]
mod tests {
    use super::disputed;

    #[test]
    fn each_claim_stands_by_itself() {
        let check = |text: &str, expected: Option<[&str; 2]>| {
            assert_eq!(disputed(text), expected, "{text}");
        };
        check(
            "My wife says the vase is in the kitchen, but I think it's in the bedroom. Who's right?",
            Some(["the vase is in the kitchen", "it's in the bedroom"]),
        );
        check(
            "I think that the vase is red and my son thinks that it is blue, so who is right?",
            Some(["the vase is red", "it is blue"]),
        );
        check(
            "Жена говорит, что ваза на кухне, а я думаю, что в спальне. Кто прав?",
            Some(["ваза на кухне", "в спальне"]),
        );
        check("Жена говорит, что ваза на кухне. Кто прав?", None);
        check("Кто прав?", None);
    }
}
