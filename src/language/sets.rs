//! The words that code looks for, in common sets: text of `rules/language/*/sets.txt` and `commands.txt`, none of it Rust.
//!
//! ```text
//! set ButNot = но не | а не | только не      any of these
//! set Ordinal = верхн* > 1 | втор* > 2       each with what it stands for; «*»: a word may go on
//! ```
//!
//! The sets of all languages that have one name are one set, in the order of the files. They are built in: what code asks of
//! a set it asks of every word in it, so a file of the user's own does not change them.
//!
//! Invariant: every set that code names is there (a test reads the sources), and nothing else is.

use std::collections::HashMap;
use std::ops::{Deref, Range};
use std::sync::OnceLock;

use crate::scan::{Scanner, Unread, statements};
use crate::units::{Carried, carried};

/// The files, by their paths within `rules/language`.
static FILES: [(&str, Carried); 4] = [
    ("ru/sets.txt", carried!("../../rules/language/ru/sets.txt")),
    ("en/sets.txt", carried!("../../rules/language/en/sets.txt")),
    ("ru/commands.txt", carried!("../../rules/language/ru/commands.txt")),
    ("en/commands.txt", carried!("../../rules/language/en/commands.txt")),
];

/// The words of one name, and what some of them stand for.
#[derive(Debug, Default)]
struct Words {
    all: Vec<&'static str>,
    meant: Vec<(&'static str, &'static str)>,
}

/// The words that files give a name.
#[derive(Debug)]
pub(crate) struct Set {
    name: &'static str,
    words: OnceLock<Words>,
}

/// The words of a set, where they are looked for.
macro_rules! set {
    ($name:literal) => {{
        static SET: $crate::sets::Set = $crate::sets::Set::named($name);
        &*SET
    }};
}
pub(crate) use set;

/// Lets files name the variants of an enum, each by its own name.
macro_rules! named {
    ($of:ident: $($variant:ident)+) => {
        impl $of {
            pub(crate) fn named(name: &str) -> Option<Self> {
                let all = [$((stringify!($variant), Self::$variant)),+];
                all.into_iter().find(|(own, _)| *own == name).map(|(_, variant)| variant)
            }
        }
    };
}
pub(crate) use named;

impl Set {
    pub(crate) const fn named(name: &'static str) -> Self {
        Self { name, words: OnceLock::new() }
    }

    fn words(&self) -> &Words {
        self.words.get_or_init(|| {
            let mut words = Words::default();
            for (_, own) in all().get(self.name).into_iter().flatten() {
                words.all.extend(&own.all);
                words.meant.extend(&own.meant);
            }
            words
        })
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.words().all.contains(&key)
    }

    /// Each word with what it stands for.
    pub(crate) fn meant(&self) -> &[(&'static str, &'static str)] {
        &self.words().meant
    }
}

impl Deref for Set {
    type Target = [&'static str];

    fn deref(&self) -> &Self::Target {
        &self.words().all
    }
}

/// The sets of a kind, «Verb.», in the order of the files: what each is called behind that, with its words.
pub(crate) fn of_kind(kind: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let own = all().get(kind).into_iter().flatten();
    own.flat_map(|(name, words)| words.all.iter().map(move |word| (*name, *word)))
}

/// Sets by their names or, up to a full stop, by their kinds, with what stands behind it.
type Sets = HashMap<&'static str, Vec<(&'static str, Words)>>;

fn all() -> &'static Sets {
    static ALL: OnceLock<Sets> = OnceLock::new();
    ALL.get_or_init(|| {
        let mut all = Sets::new();
        for (_, text) in &FILES {
            // A test reads every one.
            for (name, words) in statements(text).iter().filter_map(|at| read(text, at).ok()) {
                let (own, rest) = name.split_at(name.find('.').map_or(name.len(), |dot| dot + 1));
                all.entry(own).or_default().push((rest, words));
            }
        }
        all
    })
}

/// A statement: the name of a set, and its words.
fn read(text: &'static str, statement: &Range<usize>) -> Result<(&'static str, Words), Unread> {
    let mut scan = Scanner::of(text, statement);
    scan.needs("set ", ("«set»", "“set”"))?;
    let is_name = scan.rest().starts_with(|c: char| c.is_ascii_uppercase());
    let name = is_name.then(|| scan.run(|c| c.is_ascii_alphanumeric() || c == '.')).flatten();
    let Some((name, _)) = name else {
        return scan.wants(("имя с латинской прописной", "a name in Latin capitals"));
    };
    scan.needs("=", ("«=»", "“=”"))?;
    let mut words = Words::default();
    loop {
        let said = word(&mut scan)?;
        words.all.push(said);
        if scan.takes(">") {
            words.meant.push((said, word(&mut scan)?));
        }
        if !scan.takes("|") {
            break;
        }
    }
    scan.ends()?;
    Ok((name, words))
}

/// A word or several.
fn word(scan: &mut Scanner<'static>) -> Result<&'static str, Unread> {
    let Some((said, _)) = scan.run(|c| !matches!(c, '|' | '>' | '*' | '=' | '\n')) else {
        return scan.wants(("слово", "a word"));
    };
    scan.takes("*");
    Ok(said.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{Source, name_key};
    use crate::words::Language;

    fn faults(text: &'static str) -> String {
        let source = Source::new("a.lang", text);
        let unread = |at: &Range<usize>| {
            let Unread { expected, at } = read(text, at).err()?;
            let (line, column) = source.position(at.start);
            Some(format!("{line}:{column} {}\n", expected.say(Language::English)))
        };
        statements(text).iter().filter_map(unread).collect()
    }

    #[test]
    fn every_line_of_the_files_is_read() {
        for (path, text) in &FILES {
            assert_eq!(faults(text), "", "{path}");
            let mut names = std::collections::HashSet::new();
            for (name, _) in statements(text).iter().filter_map(|at| read(text, at).ok()) {
                assert!(names.insert(name), "{path} has {name} twice");
            }
        }
        for (name, sets) in all().iter().filter(|(name, _)| !name.ends_with('.')) {
            // What stands for something else is compared as the map or a list has it.
            let keys = sets.iter().filter(|(_, words)| words.meant.is_empty());
            for word in keys.flat_map(|(_, words)| &words.all) {
                assert_eq!(name_key(word), *word, "{name} is looked for by keys");
            }
        }
    }

    #[test]
    fn a_fault_has_its_place() {
        let text = "set = a\nset A a\nset A = a |\nset A = a > | b\nlet A = a\nset A = a = b\n";
        expect_test::expect![[r#"
            1:5 a name in Latin capitals
            2:7 “=”
            3:12 a word
            4:13 a word
            5:1 “set”
            6:11 the end of the line
        "#]]
        .assert_eq(&faults(text));
        let (name, words) = read("set A = a b*\n    | c > d\n", &(0..25)).expect("it is sound");
        assert_eq!(
            (name, &words.all[..], &words.meant[..]),
            ("A", &["a b", "c"][..], &[("c", "d")][..])
        );
    }

    /// What code names is there, and what is there is named by code.
    #[test]
    fn code_and_files_name_the_same_sets() {
        fn sources(folder: &std::path::Path, code: &mut String) {
            for entry in std::fs::read_dir(folder).expect("a folder of the project") {
                let path = entry.expect("a folder of the project").path();
                if path.is_dir() {
                    sources(&path, code);
                } else if path.extension().is_some_and(|e| e == "rs") && !path.ends_with("sets.rs")
                {
                    code.push_str(&std::fs::read_to_string(&path).expect("a source is UTF-8"));
                }
            }
        }
        let mut code = String::new();
        sources(std::path::Path::new(env!("CARGO_MANIFEST_DIR")), &mut code);
        for name in all().keys() {
            let named = [format!("(\"{name}\")"), format!("\"{name}\"")];
            assert!(code.contains(&named[usize::from(name.ends_with('.'))]), "nobody uses {name}");
        }
        for before in ["Set::named(\"", "set!(\"", "of_kind(\""] {
            for behind in code.split(before).skip(1) {
                let name = behind.split('"').next().unwrap_or_default();
                assert!(all().contains_key(name), "{name} is nowhere");
            }
        }
    }
}
