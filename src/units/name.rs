//! Names as people write them, and the key under which two spellings are one name.

use unicode_normalization::UnicodeNormalization;

/// The key of a name: NFC, lower case, ё as е, white space folded to single blanks.
///
/// Two names with one key are the same name everywhere: in maps, rule files and questions.
#[must_use]
pub fn name_key(name: &str) -> String {
    let folded = name.nfc().flat_map(char::to_lowercase).map(|c| if c == 'ё' { 'е' } else { c });
    let mut key = String::with_capacity(name.len());
    for c in folded {
        if c.is_whitespace() {
            if !key.is_empty() && !key.ends_with(' ') {
                key.push(' ');
            }
        } else {
            key.push(c);
        }
    }
    key.truncate(key.trim_end().len());
    key
}

/// The text with a capital at its beginning.
#[must_use]
pub fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |c| c.to_uppercase().chain(letters).collect())
}

/// The candidate most like `wanted`, for "did you mean …"; none when nothing is near.
pub fn nearest_name<'a>(
    wanted: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let wanted = name_key(wanted);
    candidates
        .into_iter()
        .map(|c| (strsim::normalized_damerau_levenshtein(&wanted, &name_key(c)), c))
        .filter(|(likeness, _)| *likeness >= 0.6)
        .max_by(|(a, x), (b, y)| a.total_cmp(b).then_with(|| y.cmp(x)))
        .map(|(_, c)| c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spellings_of_one_name_share_a_key() {
        assert_eq!(name_key("  Ёлка \t у  ОКНА "), "елка у окна");
        // и + combining breve, as some keyboards send it
        assert_eq!(name_key("и\u{306}од"), name_key("йод"));
    }

    #[test]
    fn a_slip_of_the_pen_finds_its_name() {
        let names = ["Комната-В", "Комната-Z", "Коридор"];
        assert_eq!(nearest_name("Конмата-В", names), Some("Комната-В"));
        assert_eq!(nearest_name("подвал", names), None);
    }
}
