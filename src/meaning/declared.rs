//! Words of a relation where it is declared: comments of a rule file that a grammar can read.
//!
//! ```text
//! .decl ПОД_РУКОЙ_У(x: Thing, y: Thing) = AT_HAND_OF
//! // ru: под рукой у[gen]
//! // en: within reach of | handy from
//! ```
//!
//! makes the role `AT_HAND_OF(x: Thing, y: Thing)` and a preposition of it in each language; of a relation of one thing,
//! words that are said of it by themselves («шатается»).

use std::collections::BTreeMap;

use crate::units::Source;

/// What stands before the words, by how many things a relation is of; as long as `// ru: `, so that a fault is told in
/// its own column.
const OF_ONE: &str = "PP   <-";
const OF_TWO: &str = "Prep <-";

/// The grammar files that a rule file holds, by their paths within `rules/language`; none for most. Their lines are those
/// of the rule file.
#[must_use]
pub fn words_beside(rules: &Source) -> Vec<(String, Source)> {
    let mut files: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut declared: Option<(&str, &str)> = None;
    for (n, line) in rules.text().lines().enumerate() {
        let bare = line.trim();
        if let Some(rest) = bare.strip_prefix(".decl ") {
            declared = declaration(rest);
            continue;
        }
        let (Some((name, parameters)), Some((language, words))) = (declared, words(line)) else {
            // Other remarks may stand between.
            declared = declared.filter(|_| bare.starts_with("//"));
            continue;
        };
        let variables: Vec<&str> =
            parameters.split(',').map(|p| p.split(':').next().unwrap_or_default().trim()).collect();
        let before = if variables.len() == 1 { OF_ONE } else { OF_TWO };
        let role = format!("role {name}({parameters}) = {name}({})", variables.join(", "));
        let mut put = |folder: &str, text: String| {
            let lines = files.entry(folder.to_owned()).or_default();
            if lines.last() != Some(&text) && !lines.contains(&text) {
                lines.resize(lines.len().max(n), String::new());
                lines.push(text);
            }
        };
        put("", role);
        put(&format!("{language}/"), format!("{before}{words} = {name}"));
    }
    // Within the folder of its language, wherever the rules lie.
    let named = rules.name().rsplit(['/', '\\']).next().unwrap_or_default();
    let file = |(folder, lines): (String, Vec<String>)| {
        let path = format!("{folder}{named}.lang");
        (path, Source::new(rules.name(), lines.join("\n")))
    };
    files.into_iter().map(file).collect()
}

/// The name by which a relation is asked, its English one where it has one, and its parameters.
fn declaration(rest: &str) -> Option<(&str, &str)> {
    let (name, rest) = rest.split_once('(')?;
    let (parameters, rest) = rest.split_once(')')?;
    let rest = rest.split("//").next().unwrap_or_default();
    let english = rest.trim().strip_prefix('=').map(str::trim);
    let english = english.and_then(|e| e.split_whitespace().next());
    Some((english.unwrap_or_else(|| name.trim()), parameters))
}

/// `// ru: words`, from the first column on: the language and the words.
fn words(line: &str) -> Option<(&str, &str)> {
    let (language, words) = line.strip_prefix("// ")?.split_once(": ")?;
    let is_folder = language.len() == 2 && language.chars().all(|c| c.is_ascii_lowercase());
    is_folder.then_some((language, words))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grammar::{Grammar, files};

    fn with(rules: &str) -> Option<crate::fault::LangFaults> {
        let beside = words_beside(&Source::new("own.dl", rules));
        let built_in = files().map(|(name, text)| (name, Source::new(name, text)));
        let own = beside.iter().map(|(path, source)| (path.as_str(), source.clone()));
        Grammar::of(&built_in.chain(own).collect::<Vec<_>>()).1
    }

    #[test]
    fn a_declaration_has_words_in_two_languages() {
        let rules = ".decl A(x: Thing, y: Thing) = AT_HAND_OF   // nearer than an arm\n// ru: под рукой у[gen]\n// a remark: en\n// en: handy from\n\n\
                     .decl SHAKY(x: Thing)\n// ru: шатается\nSHAKY(X) :- f(X).\n// en: nothing is declared here\n";
        let files: Vec<(String, String)> = words_beside(&Source::new("own.dl", rules))
            .into_iter()
            .map(|(path, source)| (path, source.text().to_owned()))
            .collect();
        assert_eq!(
            files,
            [
                (
                    "own.dl.lang".to_owned(),
                    "\nrole AT_HAND_OF(x: Thing, y: Thing) = AT_HAND_OF(x, y)\n\n\n\n\nrole SHAKY(x: Thing) = SHAKY(x)".to_owned()
                ),
                (
                    "en/own.dl.lang".to_owned(),
                    "\n\n\nPrep <-handy from = AT_HAND_OF".to_owned()
                ),
                (
                    "ru/own.dl.lang".to_owned(),
                    "\nPrep <-под рукой у[gen] = AT_HAND_OF\n\n\n\n\nPP   <-шатается = SHAKY".to_owned()
                ),
            ]
        );
        assert!(with(rules).is_none());
    }

    #[test]
    fn a_fault_has_the_place_of_the_rule_file() {
        let faults =
            with(".decl A(x: Thing, y: Thing)\n// ru: под рукой у[вин]\n").expect("a fault");
        let places: Vec<_> = faults.faults.iter().map(crate::fault::LangFault::place).collect();
        assert!(matches!(&places[..], [(file, 2, 20)] if file == "own.dl"), "{places:?}");
    }
}
