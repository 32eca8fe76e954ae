//! Grammar files checked and made ready to read with.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

use super::features::Features;
use super::file::Repeat;
use super::sense::{Meaning, Signatures, Type};
use super::term::Sorts;
use crate::language::Language;
use crate::language::paraphrase::{self, Paraphrases};
use crate::language::question::Part;
use crate::units::{Carried, Source, carried};

/// Every grammar that there is: what roles mean, and each language's words, phrases and frames.
#[derive(Debug)]
pub struct Grammar {
    pub(crate) roles: Vec<Role>,
    pub(crate) signatures: Signatures,
    pub(super) tongues: BTreeMap<String, Tongue>,
    /// Other ways to ask, for the older reading.
    pub paraphrases: Arc<Paraphrases>,
}

/// A relation between things as a language names it, and the relations of the rules that it stands for.
#[derive(Debug)]
pub(crate) struct Role {
    pub(crate) name: String,
    pub(crate) overloads: Vec<Overload>,
}

#[derive(Debug)]
pub(crate) struct Overload {
    pub(crate) variables: Vec<String>,
    pub(crate) sorts: Vec<Sorts>,
    /// Premises; any of them will do.
    pub(crate) bodies: Vec<String>,
    /// What must hold for anything to be told.
    pub(crate) needs: Option<String>,
}

/// A category of words or phrases.
pub(crate) type Category = u16;

/// Categories that the map's names fill.
pub(crate) const NOUN: Category = 0;
pub(crate) const VALUE: Category = 1;
pub(crate) const NUMBER: Category = 2;
pub(crate) const PROPERTY: Category = 3;
/// What serves for an activity that words say, by the part that it has: the first of [`PARTS`] and those after it.
pub(crate) const SERVING: Category = 4;
pub(crate) const PARTS: [Part; 6] =
    [Part::With, Part::From, Part::At, Part::By, Part::To, Part::Any];
pub(super) const OF_THE_MAP: [(&str, Type); 10] = [
    ("Noun", Type::Desc),
    ("Adj", Type::Mods),
    ("Num", Type::Number),
    ("Prop", Type::Property),
    ("Done_with", Type::Desc),
    ("Done_from", Type::Desc),
    ("Done_at", Type::Desc),
    ("Done_by", Type::Desc),
    ("Done_to", Type::Desc),
    ("Done_any", Type::Desc),
];

/// A language.
#[derive(Debug, Default)]
pub(crate) struct Tongue {
    /// Parts of a frame may stand in any order.
    pub(crate) free: bool,
    /// Words that may be passed over, by the first of them, at a cost.
    pub(crate) skipped: HashMap<String, Vec<(Vec<String>, u32)>>,
    /// Words of categories, by all of them with blanks between.
    pub(crate) words: HashMap<String, Vec<Entry>>,
    pub(crate) longest: usize,
    /// Categories whose words no frame may have as its own, and no question leave out.
    pub(crate) reserved: Vec<Category>,
    /// Words that stand in frames as themselves.
    pub(crate) literals: HashSet<String>,
    pub(crate) rules: Vec<Phrase>,
    pub(crate) frames: Vec<Frame>,
    /// How answers are told.
    pub(crate) says: HashMap<String, String>,
    /// The first word for each value of which the files speak: the name by which the map knows it, and the word.
    pub(crate) qualities: Vec<(String, String)>,
}

#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) category: Category,
    pub(crate) features: Features,
    pub(crate) cost: u32,
    pub(crate) meaning: Meaning,
}

#[derive(Debug)]
pub(crate) struct Phrase {
    pub(crate) category: Category,
    pub(crate) parts: Vec<Slot>,
    pub(crate) agree: Vec<usize>,
    /// The part whose features are those of the whole.
    pub(crate) head: Option<usize>,
    pub(crate) cost: u32,
    pub(crate) meaning: Meaning,
    pub(crate) variables: usize,
}

#[derive(Debug)]
pub(crate) struct Frame {
    pub(crate) parts: Vec<(Slot, Repeat)>,
    pub(crate) cost: u32,
    pub(crate) meaning: Meaning,
    pub(crate) variables: usize,
    /// Where it stands, for who wants to know which line read a sentence.
    pub(crate) place: String,
}

/// What a part of a rule is filled with.
#[derive(Debug, Clone)]
pub(crate) enum Slot {
    /// One of these runs of words.
    Words(Vec<Vec<String>>),
    Part {
        category: Category,
        features: Features,
        variable: Option<u8>,
    },
}

macro_rules! files {
    ($($name:literal),+ $(,)?) => {
        [$(($name, carried!("../../rules/language/" $name))),+]
    };
}

/// Grammar files that are built in beside the paraphrases, by their paths within `rules/language`.
static FILES: [(&str, Carried); 10] = files![
    "forms.lang",
    "ru/words.lang",
    "ru/phrases.lang",
    "ru/frames.lang",
    "en/words.lang",
    "en/phrases.lang",
    "en/frames.lang",
    "de/words.lang",
    "de/phrases.lang",
    "de/frames.lang",
];

/// Every language file that is built in: its path within `rules/language`, and its text.
pub fn files() -> impl Iterator<Item = (&'static str, &'static str)> {
    FILES.iter().chain(&paraphrase::FILES).map(|(path, text)| (*path, **text))
}

impl Grammar {
    /// The grammar of the files that are built in.
    ///
    /// # Panics
    /// When these have a fault, which a test rules out.
    #[must_use]
    pub fn built_in() -> Self {
        let files = files().map(|(name, text)| (name, Source::new(name, text)));
        let (grammar, faults) = Self::of(&files.collect::<Vec<_>>());
        assert!(faults.is_none(), "the built-in grammar is sound: {faults:?}");
        grammar
    }

    /// The language of a folder.
    pub(crate) fn tongue_of(&self, folder: &str) -> Option<&Tongue> {
        self.tongues.get(folder)
    }

    /// The languages that a text may be in, the likeliest first: that of its letters, then those which the program
    /// itself does not speak.
    pub(crate) fn tongues_for(&self, language: Language) -> impl Iterator<Item = (&str, &Tongue)> {
        let own = folder(language);
        let other = folder(match language {
            Language::Russian => Language::English,
            Language::English => Language::Russian,
        });
        let first = self.tongues.get_key_value(own);
        let others = self.tongues.iter().filter(move |(name, _)| *name != own && *name != other);
        first.into_iter().chain(others).map(|(name, tongue)| (name.as_str(), tongue))
    }
}

fn folder(language: Language) -> &'static str {
    language.pick("ru", "en")
}

#[cfg(test)]
mod tests {
    use super::*;
    use miette::Diagnostic;

    #[test]
    fn the_built_in_grammar_is_sound() {
        let grammar = Grammar::built_in();
        let tongue = grammar.tongue_of("ru").expect("a folder of its own");
        assert!(tongue.free && tongue.frames.len() > 30);
        assert!(!grammar.tongue_of("en").expect("a folder of its own").free);
    }

    /// The type of a category may follow from files that are read after it, in any order.
    #[test]
    fn the_order_of_the_files_does_not_matter() {
        let mut files: Vec<(&str, Source)> =
            files().map(|(name, text)| (name, Source::new(name, text))).collect();
        files.reverse();
        let (grammar, faults) = Grammar::of(&files);
        assert!(faults.is_none(), "{faults:?}");
        let frames = |grammar: &Grammar| grammar.tongue_of("en").map(|t| t.frames.len());
        assert_eq!(frames(&grammar), frames(&Grammar::built_in()));
    }

    #[test]
    fn faults_come_all_at_once_each_with_its_line_and_column() {
        let roles =
            "role on(x: Thing, y: Thing) = ON(x, y)\nrole in(x: Thing, y: Hall) = IN(x, y)\n";
        let words = "reserved Not\nNot <- не\nPos <- стоит\nPrep <- на[loc] = on\nPrep <- под[ins] = over\nNP <- n:Noun = n\n\
                     NP <- a:Adj n:Noun = n\nNP <- n:Nuon = n\nPP <- r:Prep n:NP {agree r n} = n & r\n\
                     place(x) <- где не стоит x:NP\nplace(x) <- Pos? x:NP?\nlist(x) <- где x:NP\ncount(x) <- где x:NP\nplace(x) <- (где x:NP\nWhich <- ~брын\nWhich <- ~который | ~комната\n";
        let files = [
            ("forms.lang", Source::new("forms.lang", roles)),
            ("ru/a.lang", Source::new("ru/a.lang", words)),
        ];
        let (_, faults) = Grammar::of(&files);
        let all = faults.expect("there are faults").faults;
        let mut told: Vec<(usize, usize, String)> = all
            .iter()
            .filter(|fault| fault.file.name() == "ru/a.lang")
            .map(|fault| {
                let (_, line, column) = fault.place();
                (line, column, fault.code().expect("each has one").to_string())
            })
            .collect();
        told.sort();
        let told: Vec<String> =
            told.into_iter().map(|(l, c, code)| format!("{l}:{c} {code}")).collect();
        assert_eq!(
            told,
            [
                "5:20 language::unknown",
                "7:7 language::one_side",
                "8:9 language::unknown",
                "9:37 language::type_mismatch",
                "10:17 language::reserved",
                "11:1 language::nothing_required",
                "13:1 language::twice",
                "14:22 language::syntax",
                "15:11 language::forms",
            ]
        );
        assert_eq!(all.len(), told.len() + 1, "the type of a role is unknown too");
    }
}
