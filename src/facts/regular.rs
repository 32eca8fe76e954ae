//! `match(pattern, text)`: regular expressions over whole texts, in linear time, by the crate regex-lite.
//!
//! Soufflé takes C++'s `std::regex_match` with ECMAScript's grammar, in which `\w`, `\d` and `\b` know ASCII alone. What only a
//! search with backtracking can decide (`\1`, `(?=…)`) is refused where it stands in the rules; a pattern that is no
//! regular expression matches nothing, as there, and neither does its negation.

use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

use regex_lite::{Regex, RegexBuilder};

/// Patterns kept compiled in one thread.
const MAX_KEPT: usize = 256;
/// A compiled pattern's bytes.
const MAX_SIZE: usize = 1 << 22;

thread_local! {
    static KEPT: RefCell<HashMap<Arc<str>, Option<Regex>>> = RefCell::new(HashMap::new());
}

/// Whether the whole text is of the pattern; none for a pattern that is no regular expression.
pub(super) fn matches(pattern: &Arc<str>, text: &str) -> Option<bool> {
    KEPT.with_borrow_mut(|kept| {
        if let Some(known) = kept.get(pattern) {
            return known.as_ref().map(|regex| regex.is_match(text));
        }
        if kept.len() >= MAX_KEPT {
            kept.clear();
        }
        let made = compile(pattern).ok();
        let found = made.as_ref().map(|regex| regex.is_match(text));
        kept.insert(Arc::clone(pattern), made);
        found
    })
}

/// Why a pattern is none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum NoPattern {
    /// Only backtracking decides it.
    Backtracking,
    Broken(String),
}

pub(super) fn compile(pattern: &str) -> Result<Regex, NoPattern> {
    let whole = format!("^(?:{})$", translated(pattern));
    RegexBuilder::new(&whole).size_limit(MAX_SIZE).build().map_err(|fault| {
        let told = fault.to_string();
        if told.contains("look-around") || told.contains("backreferences are not supported") {
            return NoPattern::Backtracking;
        }
        NoPattern::Broken(told.lines().last().unwrap_or_default().trim().to_owned())
    })
}

/// ECMAScript's pattern as the regex crate reads it: within brackets `[`, `&&`, `--` and `~~` are plain there.
fn translated(pattern: &str) -> String {
    let mut out = String::with_capacity(pattern.len() + 8);
    let mut letters = pattern.chars().peekable();
    let mut in_class = false;
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => {
                out.push('\\');
                out.extend(letters.next());
            }
            '[' if !in_class => {
                in_class = true;
                out.push('[');
                if letters.peek() == Some(&'^') {
                    out.extend(letters.next());
                }
            }
            // [:digit:]
            '[' if letters.peek() == Some(&':') => {
                out.push('[');
                while let Some(inside) = letters.next() {
                    out.push(inside);
                    if inside == ':' && letters.peek() == Some(&']') {
                        out.extend(letters.next());
                        break;
                    }
                }
            }
            '[' => out.push_str("\\["),
            ']' if in_class => {
                in_class = false;
                out.push(']');
            }
            '&' | '~' if in_class => {
                out.push('\\');
                out.push(letter);
            }
            // Written twice it would take one class from another.
            '-' if in_class && out.ends_with('-') && !out.ends_with("\\-") => out.push_str("\\-"),
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_text_is_matched_as_ecmascript_reads_the_pattern() {
        for (pattern, text, expected) in [
            ("a.*", "aaaa", Some(true)),
            ("a.*", "ba", Some(false)),
            ("a|bc", "bcd", Some(false)),
            ("[[a]+", "[a[", Some(true)),
            ("[[:digit:]x]+", "1x2", Some(true)),
            ("[a&&b]+", "a&b", Some(true)),
            ("b.*[", "b", None),
            ("(a)\\1", "aa", None),
            ("", "", Some(true)),
            ("[а-яё]+.", "стол1", Some(true)),
            ("\\w+", "стол", Some(false)),
        ] {
            assert_eq!(matches(&pattern.into(), text), expected, "{pattern} {text}");
        }
        assert_eq!(compile("(?=a)a").err(), Some(NoPattern::Backtracking));
    }

    /// Backtracking would take 2^40 steps.
    #[test]
    fn no_pattern_takes_long() {
        let text = "a".repeat(40) + "b";
        assert_eq!(matches(&"(a*)*".into(), &text), Some(false));
        assert_eq!(matches(&"(a|aa)+".into(), &text), Some(false));
    }
}
