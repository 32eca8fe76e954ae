//! A statement of a language file as a paraphrase, or words in common: see the head of the folder.

use std::ops::Range;

use super::pattern::{Part, Pattern, Run, Word};
use super::row::{Paraphrase, Put, Sets, Stage};
use super::words::Kind;
use crate::scan::{Scanner, Unread};
use crate::units::Bilingual;
use crate::words::{Case, Language, word_keys};

type Parsed<T> = Result<T, Unread>;

/// What stands for the words before and behind.
const OPEN: &str = "…";

/// Words that several statements have in common, with their name.
pub(super) fn set(
    scan: Scanner<'_>,
    sets: &Sets,
    language: Language,
) -> Parsed<(String, Vec<Run>)> {
    let mut reader = Reader { scan, names: Vec::new(), sets, language };
    let Some((name, _)) = reader.name() else {
        return reader.scan.wants(("имя с латинской прописной", "a name in Latin capitals"));
    };
    reader.scan.needs("=", ("«=»", "“=”"))?;
    let runs = reader.runs()?;
    reader.scan.ends()?;
    Ok((name.to_owned(), runs))
}

pub(super) fn paraphrase(scan: Scanner<'_>, sets: &Sets, language: Language) -> Parsed<Paraphrase> {
    let mut reader = Reader { scan, names: Vec::new(), sets, language };
    let pattern = reader.pattern()?;
    reader.scan.needs("=", ("«=», слово или пропуск", "“=”, a word or a gap"))?;
    let open = |is_open| match is_open {
        true => ("«…», как слева", "“…” as on the left"),
        false => ("слово: слева здесь нет «…»", "a word: on the left there is no “…”"),
    };
    if reader.scan.takes(OPEN) != pattern.is_open.0 {
        return reader.scan.wants(open(pattern.is_open.0));
    }
    let (plain, used) = reader.plain(&pattern)?;
    let asks = reader.scan.takes("?");
    if !asks && reader.scan.takes(OPEN) != pattern.is_open.1 {
        return reader.scan.wants(open(pattern.is_open.1));
    }
    let (mut only, mut unless) = (Vec::new(), Vec::new());
    let (mut drops, mut stage) = (false, Stage::Late);
    let mut told = used;
    if reader.scan.takes("{") {
        loop {
            if reader.scan.takes("unless ") {
                unless.extend(reader.runs()?);
            } else if reader.scan.takes("if ") {
                only.extend(reader.runs()?);
            } else if reader.scan.takes("early") {
                stage = Stage::Early;
            } else if reader.scan.takes("in time") {
                stage = Stage::InTime;
            } else if reader.scan.takes("drops") {
                drops = true;
                told.extend(reader.parts_named()?);
            } else if reader.scan.takes("skips ") {
                told.extend(reader.parts_named()?);
            } else if reader.scan.takes("}") {
                break;
            } else {
                return reader.scan.wants(("условие или «}»", "a condition, or “}”"));
            }
        }
    }
    reader.scan.ends()?;
    reader.all_told(&told)?;
    Ok(Paraphrase { pattern, only, unless, plain, asks, drops, is_order: false, stage })
}

struct Reader<'t> {
    scan: Scanner<'t>,
    /// The parts that have a name, with its place.
    names: Vec<(&'t str, Range<usize>, usize)>,
    sets: &'t Sets,
    language: Language,
}

fn is_of_word(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '\'' | '’' | '-' | '*')
}

/// Marks that conditions may have; in a pattern «,» is any that parts.
const MARKS: [char; 5] = [',', '.', ':', ';', '?'];

/// A gap or words that are kept have a name of Latin capitals.
fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_uppercase())
}

impl<'t> Reader<'t> {
    fn pattern(&mut self) -> Parsed<Pattern> {
        let begins = self.scan.takes(OPEN);
        let start = self.scan.at;
        let mut parts = Vec::new();
        while !self.scan.rest().starts_with(['=', '…']) {
            if self.scan.rest().is_empty() {
                return self.scan.wants(("«=», слово или пропуск", "“=”, a word or a gap"));
            }
            let part = self.part(parts.len())?;
            parts.push(part);
        }
        let is_open = (begins, self.scan.takes(OPEN));
        let required = |part: &Part| matches!(part, Part::Words { optional: false, .. });
        if !parts.iter().any(required) {
            self.scan.at = start;
            return self.scan.wants(("слово, которое обязательно", "a word that is required"));
        }
        Ok(Pattern { is_open, parts })
    }

    fn part(&mut self, number: usize) -> Parsed<Part> {
        if let Some((name, at)) = self.name() {
            if self.names.iter().any(|(other, ..)| *other == name) {
                self.scan.at = at.start;
                return self.scan.wants(("другое имя: это уже занято", "another name"));
            }
            self.names.push((name, at, number));
            if !self.scan.takes(":") {
                return self.gap();
            }
        }
        let choices = match self.scan.takes("(") {
            true => {
                let choices = self.runs()?;
                self.scan.needs(")", ("«)» или «|»", "“)” or “|”"))?;
                if self.scan.takes("*") {
                    return Ok(Part::Repeated { choices });
                }
                choices
            }
            false => self.alternative()?,
        };
        Ok(Part::Words { choices, optional: self.scan.takes("?") })
    }

    /// A name, where one stands here.
    fn name(&mut self) -> Option<(&'t str, Range<usize>)> {
        is_name(self.scan.rest()).then(|| self.scan.run(char::is_alphanumeric)).flatten()
    }

    /// How many words fill a gap, and which do not stand in it.
    fn gap(&mut self) -> Parsed<Part> {
        let (mut least, mut most, mut without) = (1, usize::MAX, Vec::new());
        let mut is_clause = false;
        if self.scan.takes("{") {
            if let Some(number) = self.number()? {
                (least, most) = (number, number);
                if self.scan.takes("-") {
                    most = self.number()?.unwrap_or(usize::MAX);
                }
            }
            is_clause = self.scan.takes("clause");
            if self.scan.takes("not ") {
                without = self.runs()?;
            }
            self.scan.needs("}", ("число, «not» или «}»", "a number, “not” or “}”"))?;
        }
        Ok(Part::Gap { least, most, without, is_clause })
    }

    fn number(&mut self) -> Parsed<Option<usize>> {
        match self.scan.run(|c| c.is_ascii_digit()).map(|(digits, _)| digits.parse()) {
            Some(Ok(number)) => Ok(Some(number)),
            Some(Err(_)) => self.scan.wants(("меньшее число", "a smaller number")),
            None => Ok(None),
        }
    }

    fn runs(&mut self) -> Parsed<Vec<Run>> {
        let mut runs = Vec::new();
        loop {
            let first = runs.len();
            runs.extend(self.alternative()?);
            while self.scan.rest().starts_with(|c| is_of_word(c) || MARKS.contains(&c) || c == '<')
            {
                let word = self.word()?;
                runs[first..].iter_mut().for_each(|run| run.extend(word.clone()));
            }
            if !self.scan.takes("|") {
                return Ok(runs);
            }
        }
    }

    /// A word, or the words that have a name in common.
    fn alternative(&mut self) -> Parsed<Vec<Run>> {
        let Some((name, at)) = self.name() else { return Ok(vec![self.word()?]) };
        match self.sets.get(name) {
            Some(runs) => Ok(runs.clone()),
            None => {
                self.scan.at = at.start;
                self.scan
                    .wants(("слово или имя из строки «set»", "a word, or a name of a line “set”"))
            }
        }
    }

    /// A word as sentences are cut into words: “what's” are two.
    fn word(&mut self) -> Parsed<Run> {
        const EXPECTED: (&str, &str) = ("слово", "a word");
        if let Some((mark, _)) = self.scan.run(|c| MARKS.contains(&c)) {
            return Ok(vec![Word::Mark(mark.to_owned())]);
        }
        if self.scan.takes("~") {
            return Ok(vec![Word::Unparted]);
        }
        if self.scan.takes("<") {
            return Ok(vec![self.kind()?]);
        }
        let Some((word, _)) = self.scan.run(is_of_word) else { return self.scan.wants(EXPECTED) };
        let mut keys = word_keys(word);
        let key = |keys: &mut Vec<String>| keys.pop().unwrap_or_default();
        Ok(match (word.starts_with('*'), word.ends_with('*')) {
            _ if keys.is_empty() => return self.scan.wants(EXPECTED),
            (true, _) => vec![Word::Ends(key(&mut keys))],
            (_, true) => vec![Word::Begins(key(&mut keys))],
            _ => keys.into_iter().map(Word::Whole).collect(),
        })
    }

    /// «go>»: what a word does in an order.
    fn kind(&mut self) -> Parsed<Word> {
        let start = self.scan.at;
        let name = self.scan.run(char::is_alphabetic).map(|(name, _)| name);
        let Some((_, kind)) = Kind::NAMED.iter().find(|(known, _)| Some(*known) == name) else {
            self.scan.at = start;
            let all: Vec<&str> = Kind::NAMED.iter().map(|(name, _)| *name).collect();
            return self.scan.wants(Bilingual::new(
                format!("что слово делает: {}", all.join(", ")),
                format!("what a word does: {}", all.join(", ")),
            ));
        };
        self.scan.needs(">", ("«>»", "“>”"))?;
        Ok(Word::Kind(*kind, self.language))
    }

    /// The parts of some names of the left side.
    fn parts_named(&mut self) -> Parsed<Vec<usize>> {
        let mut parts = Vec::new();
        while let Some((name, at)) = self.name() {
            parts.push(self.part_named(name, &at)?);
        }
        Ok(parts)
    }

    fn part_named(&mut self, name: &str, at: &Range<usize>) -> Parsed<usize> {
        if let Some((_, _, part)) = self.names.iter().find(|(own, ..)| *own == name) {
            return Ok(*part);
        }
        self.scan.at = at.start;
        let all: Vec<&str> = self.names.iter().map(|(name, ..)| *name).collect();
        self.scan.wants(Bilingual::new(
            format!("имя из левой части: {}", all.join(", ")),
            format!("a name of the left side: {}", all.join(", ")),
        ))
    }

    /// That nothing which was named is lost.
    fn all_told(&self, told: &[usize]) -> Parsed<()> {
        match self.names.iter().find(|(_, _, part)| !told.contains(part)) {
            Some((name, at, _)) => Err(Unread {
                expected: Bilingual::new(
                    format!("имя, которое стоит и справа: «{name}» пропало бы"),
                    format!("a name that stands on the right too: “{name}” would be lost"),
                ),
                at: at.clone(),
            }),
            None => Ok(()),
        }
    }

    /// What is put, and the parts that stand in it.
    fn plain(&mut self, pattern: &Pattern) -> Parsed<(Vec<Put>, Vec<usize>)> {
        let mut plain = Vec::new();
        let mut used = Vec::new();
        while !self.scan.rest().is_empty() && !self.scan.rest().starts_with(['…', '{', '?']) {
            let Some((name, at)) = self.name() else {
                plain.push(Put::Word(match self.scan.run(is_of_word) {
                    Some((word, _)) => word.to_owned(),
                    None if self.scan.takes(",") => ",".to_owned(),
                    None => return self.scan.wants(("слово или пропуск", "a word or a gap")),
                }));
                continue;
            };
            let part = self.part_named(name, &at)?;
            used.push(part);
            plain.push(if self.scan.takes(":") {
                self.choice(part, &pattern.parts[part])?
            } else {
                Put::Taken(part, self.case()?)
            });
        }
        Ok((plain, used))
    }

    /// For each choice of a part what is put for it.
    fn choice(&mut self, part: usize, of: &Part) -> Parsed<Put> {
        let Part::Words { choices, .. } = of else {
            return self
                .scan
                .wants(("слово: у пропуска нет вариантов", "a word: a gap has no choices"));
        };
        let mut put: Vec<String> = Vec::new();
        let is_list = self.scan.takes("(");
        loop {
            let mut words = Vec::new();
            while let Some((word, _)) = self.scan.run(is_of_word) {
                words.push(word);
                if !is_list {
                    break;
                }
            }
            put.push(words.join(" "));
            if !(is_list && self.scan.takes("|")) {
                break;
            }
        }
        if !is_list {
            put = vec![put.concat(); choices.len()];
        }
        if put.len() != choices.len() {
            let many = choices.len();
            return self.scan.wants(Bilingual::new(
                format!("столько же вариантов, сколько слева: {many}"),
                format!("as many choices as on the left: {many}"),
            ));
        }
        if is_list {
            self.scan.needs(")", ("«)» или «|»", "“)” or “|”"))?;
        }
        Ok(Put::Choice(part, put))
    }

    /// «[gen]».
    fn case(&mut self) -> Parsed<Option<Case>> {
        if !self.scan.takes("[") {
            return Ok(None);
        }
        let case = match self.scan.run(char::is_alphabetic).map(|(name, _)| name) {
            Some("nom") => Case::Nominative,
            Some("gen") => Case::Genitive,
            Some("dat") => Case::Dative,
            Some("acc") => Case::Accusative,
            Some("ins") => Case::Instrumental,
            Some("loc") => Case::Prepositional,
            _ => {
                return self.scan.wants((
                    "падеж: nom, gen, dat, acc, ins или loc",
                    "a case: nom, gen, dat, acc, ins or loc",
                ));
            }
        };
        self.scan.needs("]", ("«]»", "“]”"))?;
        Ok(Some(case))
    }
}
