//! Rule texts in one form: four blanks within a statement or a component, a blank behind each comma, blanks around
//! `:-`, no blanks at the ends of lines, one empty line at most. Comments and line breaks stay where they are.
//!
//! **Invariant**: the formatted text has the same words and comments as the text, and formatting it again changes
//! nothing.

/// The text in the usual form.
#[must_use]
pub fn format_rules(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut state = State::default();
    // Where lines are counted, each stays.
    let counts_lines = text.contains("__LINE__");
    let mut empty = 0;
    for line in text.lines() {
        let is_verbatim = state.in_comment || state.in_directive;
        let shown = if is_verbatim { line.trim_end().to_owned() } else { line.trim().to_owned() };
        if shown.is_empty() {
            empty += 1;
            continue;
        }
        match counts_lines {
            true => out.extend(std::iter::repeat_n('\n', empty)),
            false if empty > 0 && !out.is_empty() => out.push('\n'),
            false => {}
        }
        empty = 0;
        let closes = usize::from(shown.starts_with('}'));
        let depth = state.components.saturating_sub(closes) + usize::from(state.in_statement);
        let is_directive = shown.starts_with('#') || state.in_directive;
        if !is_verbatim && !is_directive {
            out.push_str(&"    ".repeat(depth));
        }
        if is_directive {
            out.push_str(&shown);
            state.in_directive = shown.ends_with('\\');
        } else {
            state.line(&shown, &mut out);
        }
        while out.ends_with(' ') {
            out.pop();
        }
        out.push('\n');
    }
    out
}

/// What a line begins within.
#[derive(Debug, Default)]
struct State {
    in_comment: bool,
    /// A line of the preprocessor that goes on behind a backslash.
    in_directive: bool,
    /// Behind the first word of a rule or fact that is not ended yet.
    in_statement: bool,
    /// Braces of components that are open.
    components: usize,
    /// Brackets that are open within a statement.
    brackets: usize,
}

impl State {
    fn line(&mut self, line: &str, out: &mut String) {
        let letters: Vec<char> = line.chars().collect();
        let mut n = 0;
        let starts_component = line.starts_with(".comp");
        let is_directive = line.starts_with('.');
        while n < letters.len() {
            let (letter, next) = (letters[n], letters.get(n + 1).copied().unwrap_or(' '));
            if self.in_comment {
                out.push(letter);
                if (letter, next) == ('*', '/') {
                    out.push('/');
                    n += 1;
                    self.in_comment = false;
                }
                n += 1;
                continue;
            }
            match (letter, next) {
                ('/', '/') => {
                    out.extend(&letters[n..]);
                    return;
                }
                ('/', '*') => {
                    out.push_str("/*");
                    self.in_comment = true;
                    n += 2;
                    continue;
                }
                ('"', _) => {
                    let mut end = n + 1;
                    while end < letters.len() && letters[end] != '"' {
                        end += 1 + usize::from(letters[end] == '\\');
                    }
                    let end = (end + 1).min(letters.len());
                    out.extend(&letters[n..end]);
                    n = end;
                    self.in_statement |= !is_directive;
                    continue;
                }
                (':', '-') => {
                    blank(out);
                    out.push_str(":- ");
                    n += 2;
                    while letters.get(n) == Some(&' ') {
                        n += 1;
                    }
                    continue;
                }
                (',', _) => {
                    while out.ends_with(' ') && !out.ends_with("    ") {
                        out.pop();
                    }
                    out.push_str(", ");
                    n += 1;
                    while letters.get(n).is_some_and(|letter| letter.is_whitespace()) {
                        n += 1;
                    }
                    continue;
                }
                ('(' | '[', _) => self.brackets += 1,
                (')' | ']', _) => self.brackets = self.brackets.saturating_sub(1),
                ('{', _) if starts_component && self.brackets == 0 => self.components += 1,
                ('{', _) => self.brackets += 1,
                ('}', _) if self.brackets > 0 => self.brackets -= 1,
                ('}', _) => self.components = self.components.saturating_sub(1),
                _ => {}
            }
            out.push(letter);
            let ends = letter == '.' && (next.is_whitespace() || n + 1 == letters.len());
            if ends && self.brackets == 0 && !(is_directive && n == 0) {
                self.in_statement = false;
            } else if !letter.is_whitespace() && !is_directive && !matches!(letter, '}') {
                self.in_statement = true;
            }
            n += 1;
        }
        if is_directive && self.brackets == 0 {
            self.in_statement = false;
        }
    }
}

fn blank(out: &mut String) {
    if !out.ends_with(' ') {
        out.push(' ');
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lex;

    fn words(text: &str) -> Vec<lex::Word> {
        let mut faults = Vec::new();
        lex::words(text, 0, &mut faults).into_iter().map(|token| token.word).collect()
    }

    #[test]
    fn a_text_takes_its_form() {
        let text = "// above\n\n\n\n.decl r(a:number,b:number)   \nr( A,B ):-s(A,  B),\n  t(B). /* why,\n   so */\n.comp C {\n.decl q(x:symbol)\nq(\"a,b:-c\").\n}\n";
        let expected = "// above\n\n.decl r(a:number, b:number)\nr( A, B ) :- s(A, B),\n    t(B). /* why,\n   so */\n.comp C {\n    .decl q(x:symbol)\n    q(\"a,b:-c\").\n}\n";
        assert_eq!(format_rules(text), expected);
    }

    #[test]
    fn lines_that_are_counted_stay() {
        let text = "\n\n.decl r(n: number)\n\n\nr(__LINE__).\n";
        assert_eq!(format_rules(text), text);
    }

    /// Over the project's own rules, all golden programs and Soufflé's: the same words, and the form is its own form.
    #[test]
    #[expect(clippy::print_stdout, reason = "a test that was not made should say so")]
    fn the_words_stay_and_the_form_is_final() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let souffle = root.join("../shared/data/souffle");
        let mut open = vec![root.join("rules"), root.join("tests/golden/datalog")];
        let is_there = souffle.exists();
        assert!(is_there || std::env::var_os("CI").is_none(), "{} is missing", souffle.display());
        if is_there {
            open.push(souffle);
        } else {
            println!("skipped: {} is not there", souffle.display());
        }
        let mut seen = 0;
        while let Some(path) = open.pop() {
            if path.is_dir() {
                open.extend(std::fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
            } else if path.extension().is_some_and(|extension| extension == "dl") {
                let text = std::fs::read_to_string(&path).unwrap();
                let formatted = format_rules(&text);
                assert_eq!(words(&formatted), words(&text), "{}", path.display());
                assert_eq!(format_rules(&formatted), formatted, "{}", path.display());
                seen += 1;
            }
        }
        assert!(seen > 20, "{seen}");
    }
}
