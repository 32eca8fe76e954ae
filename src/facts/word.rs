//! Values and the 32-bit words that stand for them in tuples.
//!
//! A column holds either symbols or numbers, so one word needs no tag. A symbol is its number in the
//! order of first sight. A number within ±2^30 stands in place, shifted so that words compare as the
//! numbers do; any other `i64` is kept in a list and its word, with the top bit set, is the position there.
//! Lengths in hundredths of a centimetre stay in place up to a hundred kilometres.
//!
//! **Invariant**: equal values have equal words, so joins compare words alone.

use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

use foldhash::fast::RandomState;

use super::decimal::Decimal;
use super::program::Kind;

/// One word of a tuple.
pub(super) type Word = u32;

/// No value has this word; a computed column holds it where the computation has no result.
pub(super) const NO_WORD: Word = u32::MAX;

/// The word of the record that is none.
pub(super) const NIL: Word = 0;

/// Words from here on are positions in the list of large numbers.
pub(super) const LARGE: Word = 1 << 31;
const IN_PLACE: i64 = 1 << 30;

/// A value of a tuple, as callers see it.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Value {
    Number(i64),
    Decimal(Decimal),
    Symbol(Arc<str>),
    /// A record or a value of a branched type, as it is written: `[1, nil]`, `$Node($Leaf, $Leaf)`.
    Record(Arc<str>),
}

/// A text as the rules' language writes it.
#[must_use]
pub fn quoted(text: &str) -> String {
    let text = text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n");
    format!("\"{text}\"")
}

impl From<Decimal> for Value {
    fn from(decimal: Decimal) -> Self {
        Self::Decimal(decimal)
    }
}

impl From<i64> for Value {
    fn from(number: i64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Symbol(text.into())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Symbol(text.into())
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Decimal(decimal) => write!(f, "{decimal}"),
            Self::Symbol(text) | Self::Record(text) => write!(f, "{text}"),
        }
    }
}

/// Whether a number's word compares as the number does.
pub(super) fn is_in_place(word: Word) -> bool {
    word < LARGE
}

/// The word of a number that needs no list.
pub(super) fn small_number(number: i64) -> Option<Word> {
    (-IN_PLACE..IN_PLACE).contains(&number).then(|| (number + IN_PLACE) as Word)
}

/// The position in the list of large numbers.
pub(super) fn large_at(word: Word) -> Option<usize> {
    (!is_in_place(word) && word != NO_WORD).then(|| (word - LARGE) as usize)
}

/// What the values of a declared type hold.
#[derive(Debug, Clone)]
pub(super) struct Shape {
    /// For each branch its name and the kinds of its fields; a record has one.
    pub(super) branches: Vec<(String, Vec<Kind>)>,
    pub(super) is_record: bool,
}

/// One layer of interned symbols and large numbers.
#[derive(Debug, Clone, Default)]
struct Layer {
    /// Symbols, large numbers and records of the layers below.
    below: (usize, usize, usize),
    symbols: Vec<Arc<str>>,
    text_bytes: usize,
    symbol_words: HashMap<Arc<str>, Word, RandomState>,
    numbers: Vec<i64>,
    number_words: HashMap<i64, Word, RandomState>,
    records: Vec<Arc<[Word]>>,
    record_bytes: usize,
    record_words: HashMap<Arc<[Word]>, Word, RandomState>,
}

impl Layer {
    fn len(&self) -> usize {
        self.symbols.len() + self.numbers.len() + self.records.len()
    }

    /// Symbols, large numbers and records up to the end of this layer.
    fn end(&self) -> (usize, usize, usize) {
        let (symbols, numbers, records) = self.below;
        (symbols + self.symbols.len(), numbers + self.numbers.len(), records + self.records.len())
    }

    /// Memory held, near enough: each text twice referred to.
    fn bytes(&self) -> usize {
        const A_SYMBOL: usize = 72;
        const A_NUMBER: usize = 32;
        let texts = self.text_bytes + self.symbols.len() * A_SYMBOL;
        texts + self.numbers.len() * A_NUMBER + self.record_bytes + self.records.len() * A_SYMBOL
    }

    fn append(&mut self, above: Self) {
        self.text_bytes += above.text_bytes;
        self.symbols.extend(above.symbols);
        self.symbol_words.extend(above.symbol_words);
        self.numbers.extend(above.numbers);
        self.number_words.extend(above.number_words);
        self.record_bytes += above.record_bytes;
        self.records.extend(above.records);
        self.record_words.extend(above.record_words);
    }
}

/// Symbols and large numbers by word: layers shared with others and one of its own.
///
/// An evaluation shares the layers of its input and adds what its rules compute. Each shared layer is more than
/// twice as large as the next, so there are few.
#[derive(Debug, Clone, Default)]
pub(super) struct Words {
    shared: Vec<Arc<Layer>>,
    own: Layer,
    shapes: Arc<[Shape]>,
    /// What `autoinc()` gives next.
    counter: i64,
    /// The first value since [`Self::take_note`] that Soufflé would have computed otherwise.
    note: Option<Note>,
}

/// A value that Soufflé would have computed otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Note {
    /// Beyond the 32 bits that it counts with.
    Wide(i64),
    /// Rounded to millionths here, binary there.
    Rounded(Decimal),
    /// Longer than a text may be here; the row that it belongs to is left out.
    LongText,
}

impl Words {
    /// Another table that starts with the shared words of this one; costs nothing after [`Self::consolidate`].
    pub(super) fn share(&self) -> Self {
        let mut all = self.clone();
        all.consolidate();
        (all.counter, all.note) = (0, None);
        all
    }

    /// Moves all words into the layers that [`Self::share`] shares.
    pub(super) fn consolidate(&mut self) {
        if self.own.len() == 0 {
            return;
        }
        let above = Layer { below: self.own.end(), ..Layer::default() };
        let mut own = std::mem::replace(&mut self.own, above);
        while let Some(last) = self.shared.last_mut() {
            // A layer that nobody else has grows in place.
            if let Some(last) = Arc::get_mut(last) {
                last.append(own);
                return;
            }
            if last.len() > 2 * own.len() {
                break;
            }
            let mut below = Layer::clone(last);
            below.append(own);
            own = below;
            self.shared.pop();
        }
        self.shared.push(Arc::new(own));
    }

    pub(super) fn symbol(&mut self, text: &str) -> Word {
        if let Some(word) = self.find_symbol(text) {
            return word;
        }
        let word = self.own.end().0 as Word;
        assert!(word < NO_WORD, "fewer than 2^32 - 1 symbols fit into the memory that holds them");
        self.own.text_bytes += text.len();
        let text: Arc<str> = text.into();
        self.own.symbols.push(Arc::clone(&text));
        self.own.symbol_words.insert(text, word);
        word
    }

    /// Memory that symbols and large numbers take, near enough.
    pub(super) fn bytes(&self) -> usize {
        self.layers().map(Layer::bytes).sum()
    }

    /// The types of records; set once, before any record is made.
    pub(super) fn set_shapes(&mut self, shapes: Vec<Shape>) {
        self.shapes = shapes.into();
    }

    pub(super) fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    pub(super) fn next_number(&mut self) -> Word {
        self.counter += 1;
        self.number(self.counter - 1)
    }

    /// All large numbers that have a word.
    pub(super) fn large_numbers(&self) -> usize {
        self.own.end().1
    }

    /// Large numbers of the layers that are shared.
    pub(super) fn shared_numbers(&self) -> usize {
        self.own.below.1
    }

    /// Large numbers that are no other table's yet, in the order of their making.
    pub(super) fn own_numbers(&self) -> &[i64] {
        &self.own.numbers
    }

    /// Whether a word was named here that no other table has.
    pub(super) fn has_own(&self) -> bool {
        self.own.len() > 0
    }

    pub(super) fn note(&mut self, note: Note) {
        self.note.get_or_insert(note);
    }

    pub(super) fn take_note(&mut self) -> Option<Note> {
        self.note.take()
    }

    pub(super) fn record(&mut self, row: &[Word]) -> Word {
        if let Some(word) = self.find_record(row) {
            return word;
        }
        self.own.record_bytes += 2 * size_of_val(row);
        let row: Arc<[Word]> = row.into();
        self.own.records.push(Arc::clone(&row));
        // `nil` is word 0.
        let word = self.own.end().2 as Word;
        self.own.record_words.insert(row, word);
        word
    }

    pub(super) fn find_record(&self, row: &[Word]) -> Option<Word> {
        self.layers().find_map(|layer| layer.record_words.get(row)).copied()
    }

    /// The words of a record's fields; none for `nil`.
    pub(super) fn record_of(&self, word: Word) -> &[Word] {
        if word == NIL {
            return &[];
        }
        let at = word as usize - 1;
        let layer = self.layers().find(|layer| at < layer.end().2);
        let layer = layer.expect("a word stands for a record of one of the layers");
        &layer.records[at - layer.below.2]
    }

    /// All symbols in the order of their words.
    pub(super) fn symbols(&self) -> impl Iterator<Item = &Arc<str>> {
        self.layers().flat_map(|layer| &layer.symbols)
    }

    /// All large numbers in the order of their words.
    pub(super) fn numbers(&self) -> impl Iterator<Item = &i64> {
        self.layers().flat_map(|layer| &layer.numbers)
    }

    fn layers(&self) -> impl Iterator<Item = &Layer> {
        self.shared.iter().map(|layer| &**layer).chain(std::iter::once(&self.own))
    }

    pub(super) fn find_symbol(&self, text: &str) -> Option<Word> {
        self.layers().find_map(|layer| layer.symbol_words.get(text)).copied()
    }

    pub(super) fn text(&self, word: Word) -> &Arc<str> {
        let word = word as usize;
        let layer = self.layers().find(|layer| word < layer.end().0);
        let layer = layer.expect("a word stands for a symbol of one of the layers");
        &layer.symbols[word - layer.below.0]
    }

    /// For each symbol its place in the alphabet.
    pub(super) fn symbol_ranks(&self) -> Vec<u32> {
        let texts: Vec<&Arc<str>> = self.symbols().collect();
        let mut order: Vec<u32> = (0..texts.len() as u32).collect();
        order.sort_unstable_by_key(|word| texts[*word as usize]);
        let mut ranks = vec![0; order.len()];
        for (rank, word) in order.into_iter().enumerate() {
            ranks[word as usize] = rank as u32;
        }
        ranks
    }

    pub(super) fn number(&mut self, number: i64) -> Word {
        if let Some(word) = self.find_number(number) {
            return word;
        }
        let word = LARGE + self.own.end().1 as Word;
        self.own.numbers.push(number);
        self.own.number_words.insert(number, word);
        word
    }

    pub(super) fn find_number(&self, number: i64) -> Option<Word> {
        small_number(number)
            .or_else(|| self.layers().find_map(|layer| layer.number_words.get(&number)).copied())
    }

    pub(super) fn to_number(&self, word: Word) -> i64 {
        if is_in_place(word) {
            return i64::from(word) - IN_PLACE;
        }
        let at = (word - LARGE) as usize;
        let layer = self.layers().find(|layer| at < layer.end().1);
        let layer = layer.expect("a word stands for a number of one of the layers");
        layer.numbers[at - layer.below.1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_return_as_they_went() {
        let mut words = Words::default();
        for n in [0, 1, -1, IN_PLACE - 1, IN_PLACE, -IN_PLACE, -IN_PLACE - 1, i64::MAX, i64::MIN] {
            let word = words.number(n);
            assert_eq!((words.to_number(word), words.number(n)), (n, word));
        }
        assert!(words.number(-5) < words.number(3));
    }

    #[test]
    fn an_extension_knows_what_the_original_knew_and_leaves_it_alone() {
        let mut words = Words::default();
        let table = words.symbol("стол");
        let large = words.number(i64::MAX);
        words.consolidate();
        let mut more = words.share();
        assert_eq!((more.symbol("стол"), more.number(i64::MAX)), (table, large));
        let chair = more.symbol("стул");
        assert_eq!(more.text(chair).as_ref(), "стул");
        assert_eq!(words.find_symbol("стул"), None);
    }
}
