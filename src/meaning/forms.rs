//! The forms that a word of a grammar file stands for: `~слово` is all of them.

use super::fault::LangError;
use super::features::Features;
use super::file::Word;
use crate::language::{Case, Evidence, Language, NounPhrase, Number, Readings, WordHints, english};

/// Whether a word that stands for all its forms has forms that are known and not guessed by its ending.
pub(super) fn check_forms(word: &Word) -> Result<(), LangError> {
    let text = &word.name.text;
    let is_guessed = word.declines
        && Language::of(text) == Language::Russian
        && Features::of_adjective(text).is_empty()
        && NounPhrase::parse(text, &WordHints::default()).evidence() == Evidence::Guess;
    if is_guessed {
        return Err(LangError::Forms { word: text.clone(), at: word.name.at.clone().into() });
    }
    Ok(())
}

/// The forms that a word of a file stands for, with what each may be.
pub(super) fn forms_of(word: &Word) -> Vec<(String, Features)> {
    let key = |form: &str| crate::units::name_key(form);
    if !word.declines {
        return vec![(word.name.text.clone(), word.features)];
    }
    let forms = match Features::of_adjective(&word.name.text) {
        adjective if !adjective.is_empty() => adjective,
        _ if Language::of(&word.name.text) == Language::English => {
            let plural = english::plural(&word.name.text);
            let of = |number| {
                let all =
                    Case::ALL.map(|case| Features::of_noun(Readings::one(number, case), None));
                all.into_iter().fold(Features::NONE, Features::or)
            };
            vec![(word.name.text.clone(), of(Number::Singular)), (plural, of(Number::Plural))]
        }
        _ => {
            let phrase = NounPhrase::parse(&word.name.text, &WordHints::default());
            let of = |number, case| {
                Features::of_noun(Readings::one(number, case), Some(phrase.gender()))
            };
            let all = phrase.all_forms().into_iter();
            all.map(|(number, case, form)| (form, of(number, case))).collect()
        }
    };
    let kept = forms.into_iter().map(|(form, features)| (key(&form), features & word.features));
    kept.filter(|(_, features)| !features.is_empty()).collect()
}
