//! Names as people write them, and the key under which two spellings are one name.

use unicode_normalization::UnicodeNormalization;

/// The key of a name: NFC, lower case, ё as е, white space folded to single blanks.
///
/// Two names with one key are the same name everywhere: in maps, rule files and questions.
#[must_use]
pub fn name_key(name: &str) -> String {
    // Most names are of plain letters, each of which stands for itself whatever is beside it.
    match name.chars().all(is_plain) {
        true => spaced(name.chars().map(plain_key), name.len()),
        false => spaced(name.nfc().flat_map(char::to_lowercase).map(without_dots), name.len()),
    }
}

fn without_dots(c: char) -> char {
    if c == 'ё' { 'е' } else { c }
}

/// ASCII and Russian letters, and the signs between words.
fn is_plain(c: char) -> bool {
    c.is_ascii() || matches!(c, 'а'..='я' | 'А'..='Я' | 'ё' | 'Ё' | '«' | '»' | '–' | '—' | '…')
}

/// What becomes of a plain character.
fn plain_key(c: char) -> char {
    match c {
        'А'..='Я' => {
            char::from_u32(u32::from(c) + 32).expect("the small letters stand 32 further")
        }
        'ё' | 'Ё' => 'е',
        _ => c.to_ascii_lowercase(),
    }
}

/// The characters, white space folded to single blanks.
fn spaced(of: impl Iterator<Item = char>, bytes: usize) -> String {
    let mut key = String::with_capacity(bytes);
    for c in of {
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

    /// Each plain character alone, and between letters and marks that join what they can.
    #[test]
    fn plain_names_have_the_key_of_all_others() {
        let whole = |name: &str| {
            let folded = name.nfc().flat_map(char::to_lowercase).map(without_dots);
            spaced(folded, name.len())
        };
        for c in ('\0'..=char::MAX).filter(|c| is_plain(*c)) {
            assert_eq!(plain_key(c).to_string().trim(), whole(&c.to_string()), "{c:?}");
            for text in
                [format!("и{c}Е"), format!("{c}{c}"), format!("и{c}\u{306}"), format!("ж{c} é")]
            {
                assert_eq!(name_key(&text), whole(&text), "{text:?}");
            }
        }
    }

    #[test]
    fn a_slip_of_the_pen_finds_its_name() {
        let names = ["Комната-В", "Комната-Z", "Коридор"];
        assert_eq!(nearest_name("Конмата-В", names), Some("Комната-В"));
        assert_eq!(nearest_name("подвал", names), None);
    }
}
