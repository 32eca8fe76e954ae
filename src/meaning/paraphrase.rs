//! Other ways to say what is understood: the lines of a language file that the older reading takes.

use std::ops::Range;

use crate::language::paraphrase::{Paraphrases, language_of};
use crate::language::scan::Unread;
use crate::units::{Bilingual, Source};

/// Reads another way to say something in the language of a file.
///
/// # Errors
/// What is expected, and where; that the language has none.
pub(super) fn add(
    all: &mut Paraphrases,
    path: &str,
    source: &Source,
    at: &Range<usize>,
) -> Result<(), Unread> {
    let Some(language) = language_of(path) else {
        let expected = Bilingual::new(
            "другая строка: перефразировки есть у языков ru и en",
            "another line: the languages ru and en have paraphrases",
        );
        return Err(Unread { expected, at: at.start..at.start + 1 });
    };
    all.read(language, source.text(), at)
}
