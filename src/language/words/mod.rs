//! Word forms.
mod adjective;
mod dictionary;
pub mod english;
mod grammar;
mod letters;
mod lexicon;
mod list;
mod noun;
mod phrase;
pub mod russian;

pub use grammar::{Animacy, Case, Evidence, Gender, Number, PlaceSense, WordHints};
pub use list::{Language, alternatives, enumerate};
pub use phrase::NounPhrase;

#[cfg(test)]
mod survey {
    use super::*;
    use super::noun::{Known, Noun};

    #[test]
    #[ignore = "lab"]
    fn survey() {
        let words = std::fs::read_to_string("/tmp/wordslab/ru.txt").unwrap();
        let limit: usize = std::env::var("LIMIT").ok().and_then(|v| v.parse().ok()).unwrap_or(20000);
        let skip: usize = std::env::var("SKIP").ok().and_then(|v| v.parse().ok()).unwrap_or(0);
        let (mut total, mut good, mut bad, mut words_n) = (0, 0, Vec::new(), 0);
        for word in words.lines().skip(skip).take(limit) {
            if !word.chars().all(|c| ('а'..='я').contains(&c) || c == 'ё') { continue }
            let r = dictionary::readings(word);
            if !r.noun || r.adjective { continue }
            let in_lex = lexicon::find(word).is_some();
            if in_lex != std::env::var("LEX").is_ok() { continue }
            let Some(truth) = dictionary::noun(word, Known::default()) else { continue };
            if truth.number == Number::Plural || (!in_lex && std::env::var("ALL").is_err() && truth.animacy == Animacy::Animate) { continue }
            let ours = Noun::by_rules(word, Known { gender: std::env::var("GENDER").ok().map(|_| truth.gender), animacy: Some(truth.animacy), number: None });
            words_n += 1;
            let mut diff = vec![];
            let yo = |s: &str| s.replace('ё', "е");
            for number in Number::BOTH { if number == Number::Plural && truth.paradigm.form(number, Case::Dative) == truth.paradigm.form(Number::Singular, Case::Dative) { continue } for case in Case::SIX {
                total += 1;
                let (a, b) = (truth.paradigm.form(number, case), ours.paradigm.form(number, case));
                let variant = truth.paradigm.variants.iter().any(|(n, c, v)| (*n, *c) == (number, case) && yo(v) == yo(b));
                if yo(a) == yo(b) || variant { good += 1 } else { diff.push(format!("{b}!={a}")) }
            }}
            if truth.gender != ours.gender { diff.push(format!("{:?}!={:?}", ours.gender, truth.gender)); }
            if !diff.is_empty() { bad.push(format!("{word} [{:?}]: {}", ours.evidence, diff.join(" "))); }
        }
        let sure_bad = bad.iter().filter(|b| b.contains("[Rule]")).count();
        println!("words {words_n}, bad words {}, sure but bad {sure_bad}, forms {good}/{total} = {:.2}%", bad.len(), 100.0 * f64::from(good) / f64::from(total));
        for b in &bad { println!("{b}"); }
    }
}
