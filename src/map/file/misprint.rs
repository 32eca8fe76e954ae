//! What the TOML parser has to say, in both languages. A phrase that no message tells is passed on as it is.

use crate::units::{Bilingual, Language, Piece, said, word};

/// What is wrong. The English of each is what the parser says.
const PHRASES: [Piece; 63] = [
    word!("notation-underscore-may-only-go-between-digits"),
    word!("notation-cannot-extend-value-of-type-array-with-a-dotted-key"),
    word!("notation-cannot-extend-value-of-type-inline-table-with-a-dotted-key"),
    word!("notation-cannot-recurse-further-max-recursion-depth-met"),
    word!("notation-carriage-return-must-be-followed-by-newline"),
    word!("notation-duplicate-key"),
    word!("notation-extra-equals"),
    word!("notation-extra-assignment-between-key-value-pairs"),
    word!("notation-extra-comma-in-array"),
    word!("notation-extra-comma-in-inline-table"),
    word!("notation-integers-with-a-radix-cannot-be-signed"),
    word!("notation-invalid-basic-string"),
    word!("notation-invalid-binary-number"),
    word!("notation-invalid-boolean"),
    word!("notation-invalid-comment-character"),
    word!("notation-invalid-date-time"),
    word!("notation-invalid-exponent"),
    word!("notation-invalid-float"),
    word!("notation-invalid-fraction"),
    word!("notation-invalid-hexadecimal-number"),
    word!("notation-invalid-inline-table-element"),
    word!("notation-invalid-integer-number"),
    word!("notation-invalid-key"),
    word!("notation-invalid-key-value-pair"),
    word!("notation-invalid-literal-string"),
    word!("notation-invalid-mantissa"),
    word!("notation-invalid-multi-line-basic-string"),
    word!("notation-invalid-multi-line-literal-string"),
    word!("notation-invalid-octal-number"),
    word!("notation-invalid-string"),
    word!("notation-invalid-table"),
    word!("notation-invalid-unquoted-key"),
    word!("notation-invalid-value"),
    word!("notation-key-with-no-value"),
    word!("notation-keys-cannot-be-multi-line-basic-strings"),
    word!("notation-keys-cannot-be-multi-line-literal-strings"),
    word!("notation-missing-array-opening"),
    word!("notation-missing-assignment-between-key-value-pairs"),
    word!("notation-missing-comma-between-array-elements"),
    word!("notation-missing-comma-between-key-value-pairs"),
    word!("notation-missing-escaped-value"),
    word!("notation-missing-inline-table-opening"),
    word!("notation-missing-key-for-inline-table-element"),
    word!("notation-missing-opening-quote"),
    word!("notation-missing-value-for-key"),
    word!("notation-missing-value"),
    word!("notation-radix-must-be-lowercase"),
    word!("notation-recursion-limit"),
    word!("notation-redundant-integer-number-prefix"),
    word!("notation-redundant-numeric-sign"),
    word!("notation-string-values-must-be-quoted"),
    word!("notation-too-few-unicode-value-digits"),
    word!("notation-unclosed-array-table"),
    word!("notation-unclosed-array"),
    word!("notation-unclosed-inline-table"),
    word!("notation-unclosed-table"),
    word!("notation-unexpected-equals-in-array"),
    word!("notation-unexpected-content-between-comment-and-newline"),
    word!("notation-unexpected-content"),
    word!("notation-unexpected-key-or-value"),
    word!("notation-unexpected-leading-zero"),
    word!("notation-unexpected-sign"),
    word!("notation-unquoted-keys-cannot-be-empty"),
];
/// What it expected there.
const EXPECTED: [Piece; 13] = [
    word!("expected-basic-string"),
    word!("expected-literal-string"),
    word!("expected-multi-line-basic-string"),
    word!("expected-characters"),
    word!("expected-digits"),
    word!("expected-key"),
    word!("expected-letters"),
    word!("expected-numbers"),
    word!("expected-printable-characters"),
    word!("expected-non-double-quote-visible-characters"),
    word!("expected-non-single-quote-visible-characters"),
    word!("expected-unicode-hexadecimal-value"),
    word!("expected-value"),
];

/// A message of the parser: what is wrong, and perhaps after a comma what it expected.
pub(super) fn in_both(message: &str) -> Bilingual {
    let (wrong, expected) = message.split_once(", expected ").unwrap_or((message, ""));
    let wrong = look_up(&PHRASES, wrong);
    if expected.is_empty() {
        return wrong;
    }
    let expected: Vec<_> = expected.split(", ").map(|word| look_up(&EXPECTED, word)).collect();
    said!("notation-expected", wrong, expected = Bilingual::list(&expected))
}

fn look_up(table: &[Piece], phrase: &str) -> Bilingual {
    let known = table.iter().find(|piece| piece.say(Language::English) == phrase);
    known.map_or_else(|| phrase.to_owned().into(), |piece| (*piece).into())
}
