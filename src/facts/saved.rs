//! A result as bytes, so that a later start need not derive it anew.
//!
//! ```text
//! saved    := "ORTHOFCT" format:u32 rules:u64 symbols numbers relation*      one relation for each declaration
//! symbols  := count:u32 (length:u32 UTF-8)*          numbers := count:u32 i64*
//! relation := rows told?                             told: only where rules derive the relation
//! rows     := count:u32 word:u32*                    all numbers little-endian
//! ```
//!
//! `rules` is a hash of the rule text: under another text the bytes are not taken.

use super::live::Live;
use super::program::Program;
use super::rows::{SharedRows, Stored, heap};
use super::stored::stored;
use super::word::{Word, Words, is_in_place, large_at};
use super::{Database, Derived};

const MAGIC: &[u8; 8] = b"ORTHOFCT";
const FORMAT: u32 = 1;

impl Live {
    /// The result and its input facts as bytes; none while an edit waits for [`Live::update`], and for a program with
    /// records, which have no place in the format.
    #[must_use]
    pub fn save(&self) -> Option<Vec<u8>> {
        if self.has_edits() || !self.program().words.shapes().is_empty() {
            return None;
        }
        let derived = self.derived();
        let mut bytes = MAGIC.to_vec();
        bytes.extend(FORMAT.to_le_bytes());
        bytes.extend(hash(self.program()).to_le_bytes());
        let words = &derived.kept.words;
        put_count(&mut bytes, words.symbols().count());
        for symbol in words.symbols() {
            put_count(&mut bytes, symbol.len());
            bytes.extend(symbol.as_bytes());
        }
        put_count(&mut bytes, words.numbers().count());
        words.numbers().for_each(|number| bytes.extend(number.to_le_bytes()));
        for (relation, info) in self.program().relations() {
            put_rows(&mut bytes, derived.kept.rows(relation), info.columns.len());
            if let Some(told) = &derived.given[relation.index()] {
                put_rows(&mut bytes, &**told, info.columns.len());
            }
        }
        Some(bytes)
    }

    /// What [`Live::save`] saved; none when the bytes are of another rule text or format, or broken.
    #[must_use]
    pub fn restore(program: &Program, bytes: &[u8]) -> Option<Self> {
        let mut input = Input { rest: bytes };
        let is_ours = input.take(8)? == MAGIC
            && input.count()? == FORMAT as usize
            && input.take(8)? == hash(program).to_le_bytes();
        if !is_ours || !program.words.shapes().is_empty() {
            return None;
        }
        let mut words = Words::default();
        for n in 0..input.count()? {
            let length = input.count()?;
            let text = std::str::from_utf8(input.take(length)?).ok()?;
            if words.symbol(text) as usize != n {
                return None;
            }
        }
        for n in 0..input.count()? {
            let number = i64::from_le_bytes(input.take(8)?.try_into().ok()?);
            if large_at(words.number(number)) != Some(n) {
                return None;
            }
        }
        words.consolidate();
        // The constants of the rules must mean what they meant.
        let same = program.words.symbols().zip(words.symbols()).all(|(one, other)| one == other)
            && program.words.numbers().zip(words.numbers()).all(|(one, other)| one == other)
            && program.words.symbols().count() <= words.symbols().count()
            && program.words.numbers().count() <= words.numbers().count();
        if !same {
            return None;
        }
        let mut is_derived = vec![false; program.relations.len()];
        program.clauses.iter().for_each(|clause| is_derived[clause.head.index()] = true);
        let (mut rows, mut told): (Vec<SharedRows>, Vec<SharedRows>) = (Vec::new(), Vec::new());
        for (relation, info) in program.relations() {
            let kinds: Vec<bool> = info.columns.iter().map(|c| c.kind.is_number()).collect();
            rows.push(input.rows(&kinds, &words)?);
            told.push(match is_derived[relation.index()] {
                true => input.rows(&kinds, &words)?,
                false => SharedRows::clone(&rows[relation.index()]),
            });
        }
        if !input.rest.is_empty() {
            return None;
        }
        let mut tables: Vec<Box<dyn Stored>> =
            told.iter().map(|rows| SharedRows::clone(rows).stored()).collect();
        for fact in program.facts.iter() {
            tables[fact.relation.index()].remove(&fact.words);
        }
        let database = Database::from_tables(program, tables);
        let derived = Derived::new(program, words, rows, told);
        Some(Self::resume(program.clone(), database, derived))
    }
}

fn put_count(bytes: &mut Vec<u8>, count: usize) {
    bytes.extend((count as u32).to_le_bytes());
}

fn put_rows(bytes: &mut Vec<u8>, rows: &dyn Stored, columns: usize) {
    put_count(bytes, rows.len());
    let mut all = rows.starting(&[]);
    while let Some(slot) = all.next(rows) {
        rows.row(slot)[..columns].iter().for_each(|word| bytes.extend(word.to_le_bytes()));
    }
}

/// Bytes still to be read.
struct Input<'a> {
    rest: &'a [u8],
}

impl<'a> Input<'a> {
    fn take(&mut self, length: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(length)?;
        self.rest = rest;
        Some(taken)
    }

    fn count(&mut self) -> Option<usize> {
        Some(u32::from_le_bytes(self.take(4)?.try_into().ok()?) as usize)
    }

    /// Rows whose words all stand for something.
    fn rows(&mut self, is_number: &[bool], words: &Words) -> Option<SharedRows> {
        let count = self.count()?;
        let columns = is_number.len();
        if columns == 0 {
            let mut rows = stored(0);
            if count > 0 {
                rows.insert(&[]);
            }
            return Some(rows.rows());
        }
        let bytes = self.take(count.checked_mul(columns)?.checked_mul(4)?)?;
        let (symbols, numbers) = (words.symbols().count(), words.numbers().count());
        let mut rows = heap(columns);
        let mut row: Vec<Word> = vec![0; columns];
        for from in bytes.chunks_exact(4 * columns) {
            for ((to, from), is_number) in row.iter_mut().zip(from.chunks_exact(4)).zip(is_number) {
                let word = Word::from_le_bytes(from.try_into().ok()?);
                let is_known = match is_number {
                    true => is_in_place(word) || large_at(word).is_some_and(|at| at < numbers),
                    false => (word as usize) < symbols,
                };
                if !is_known {
                    return None;
                }
                *to = word;
            }
            rows.push(&row);
        }
        Some(rows.sort())
    }
}

/// FNV-1a over the rule texts: two texts of one hash would have to be made on purpose.
fn hash(program: &Program) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |byte: u8| hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    for source in program.sources.iter() {
        source.text().bytes().for_each(&mut add);
        add(0xff);
    }
    hash
}
