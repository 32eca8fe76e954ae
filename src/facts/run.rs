//! A planned rule body, run: nested loops over indexed sources, depth first.
//!
//! Registers are the clause's variables. A step either fails, or runs the steps behind it once for each
//! of its partners; the last step hands the registers to a [`Goal`].

use std::collections::HashSet;
use std::ops::Range;
use std::sync::Arc;

use super::called::Called;
use super::decimal::{self, Decimal};
use super::filter::{ColumnFilter, choose, narrow, retain};
use super::index::Index;
use super::limits::Watch;
use super::program::{Bounds, Compare, Expr, Kind};
use super::rows::{RowSet, Slot, Stored};
use super::slots::KeptIndex;
use super::step::{Scan, Step};
use super::syntax::Aggregation;
use super::value::{self, column_word};
use super::word::{NO_WORD, Note, Word, Words};

/// Where a scan finds its rows.
pub(super) enum Source<'a> {
    Index(&'a Index),
    /// Parts of one relation, each in the order of the scan's key.
    Rows(Vec<&'a dyn RowSet>),
    Kept(Kept<'a>),
    /// Rows that are found when they are asked for.
    Called(Called<'a>),
}

/// A relation that is kept in step with its input.
pub(super) struct Kept<'a> {
    pub(super) rows: &'a dyn Stored,
    /// None where the rows stand in the order of the key.
    pub(super) index: Option<&'a Arc<KeptIndex>>,
    /// What a scan's slots mean; none where they are the relation's columns.
    pub(super) columns: Option<&'a [Expr]>,
    pub(super) hidden: Option<&'a HashSet<Slot>>,
}

impl Kept<'_> {
    /// The rows with the key that are to be seen.
    pub(super) fn collect(&self, key: &[Word], found: &mut Vec<Slot>) {
        match self.index {
            Some(index) => {
                index.collect(key, found);
                found.retain(|slot| self.rows.is_there(*slot));
            }
            None => {
                let mut starting = self.rows.starting(key);
                while let Some(slot) = starting.next(self.rows) {
                    found.push(slot);
                }
            }
        }
        if let Some(hidden) = self.hidden {
            found.retain(|slot| !hidden.contains(slot));
        }
    }

    fn count(&self, key: &[Word]) -> usize {
        if self.index.is_none() && self.hidden.is_none() {
            return self.rows.starting(key).len;
        }
        let mut found = Vec::new();
        self.collect(key, &mut found);
        found.len()
    }

    fn word(&self, slot: Slot, column: usize, words: &mut Words) -> Word {
        let row = self.rows.row(slot);
        match self.columns {
            Some(columns) => column_word(&columns[column], row, words),
            None => row[column],
        }
    }
}

/// A source that threads may share.
pub(super) enum Plain<'a> {
    Index(&'a Index),
    Rows(Vec<&'a dyn RowSet>),
}

impl<'a> Plain<'a> {
    pub(super) fn of(source: &Source<'a>) -> Option<Self> {
        match source {
            Source::Index(index) => Some(Self::Index(index)),
            Source::Rows(parts) => Some(Self::Rows(parts.clone())),
            Source::Kept(_) | Source::Called(_) => None,
        }
    }

    pub(super) fn source(&self) -> Source<'a> {
        match self {
            Self::Index(index) => Source::Index(index),
            Self::Rows(parts) => Source::Rows(parts.clone()),
        }
    }
}

/// What a body's solutions are for; true when one was accepted.
pub(super) trait Goal {
    fn reached(&mut self, registers: &[Word], words: &mut Words) -> bool;
}

impl<F: FnMut(&[Word], &mut Words) -> bool> Goal for F {
    fn reached(&mut self, registers: &[Word], words: &mut Words) -> bool {
        self(registers, words)
    }
}

/// Runs the steps from the given registers; true when the goal accepted something. When the watch says that it is
/// over, what was found so far is all.
pub(super) fn run(
    steps: &[Step],
    sources: &[Source<'_>],
    registers: &mut [Word],
    words: &mut Words,
    watch: &Watch,
    goal: &mut dyn Goal,
) -> bool {
    Machine { steps, sources, registers, words, watch, goal, spare: Vec::new() }.run(0)
}

/// As [`run`], the first step being a scan, over those of the scan's rows only that stand in the window.
pub(super) fn run_window(
    steps: &[Step],
    sources: &[Source<'_>],
    registers: &mut [Word],
    words: &mut Words,
    watch: &Watch,
    goal: &mut dyn Goal,
    window: Range<usize>,
) -> bool {
    let mut machine = Machine { steps, sources, registers, words, watch, goal, spare: Vec::new() };
    machine.run_window(window)
}

/// The window of the first step's scan outside of which no row passes its first filter; none where it is no scan, or no
/// scan of rows that are there, or stops at its first success.
pub(super) fn extent(
    steps: &[Step],
    sources: &[Source<'_>],
    registers: &mut [Word],
    words: &mut Words,
    watch: &Watch,
) -> Option<Range<usize>> {
    let Step::Scan(scan) = steps.first()? else { return None };
    if scan.once {
        return None;
    }
    let goal = &mut |_: &[Word], _: &mut Words| false;
    let mut machine = Machine { steps, sources, registers, words, watch, goal, spare: Vec::new() };
    let key = machine.key(&scan.key)?;
    match &sources[scan.source] {
        Source::Index(index) => Some(0..index.range(key.words()).len()),
        Source::Rows(parts) => match (parts.as_slice(), scan.filters.first()) {
            ([rows], Some(filter)) => {
                let whole = rows.range(key.words());
                let word = machine.compute(&filter.value)?;
                let (near, far) = narrow(*rows, whole.clone(), key.len, filter, word);
                let parts = || [&near, &far].into_iter().filter(|part| !part.is_empty());
                let from = parts().map(|part| part.start).min().unwrap_or(whole.start);
                let to = parts().map(|part| part.end).max().unwrap_or(whole.start);
                Some(from - whole.start..to - whole.start)
            }
            (parts, _) => Some(0..parts.iter().map(|rows| rows.range(key.words()).len()).sum()),
        },
        Source::Kept(_) | Source::Called(_) => None,
    }
}

/// All rows of a scan.
const ALL: Range<usize> = 0..usize::MAX;

/// What of a range of rows lies in a window, when so many rows are before the range.
#[inline]
fn clip(range: Range<usize>, before: usize, window: &Range<usize>) -> Range<usize> {
    let from = range.start + window.start.saturating_sub(before).min(range.len());
    let to = range.start + window.end.saturating_sub(before).min(range.len());
    from..to
}

struct Machine<'a, 'b> {
    steps: &'a [Step],
    sources: &'a [Source<'b>],
    registers: &'a mut [Word],
    words: &'a mut Words,
    watch: &'a Watch,
    goal: &'a mut dyn Goal,
    /// Buffers for selected rows, one for each scan that is not using one now.
    spare: Vec<Vec<u32>>,
}

/// What an aggregate has seen so far.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Count {
    count: i64,
    /// i128 holds any sum of fewer than 2^64 numbers.
    sum: i128,
    least: Option<i64>,
    most: Option<i64>,
}

impl Count {
    pub(super) fn add(&mut self, number: i64) {
        self.count += 1;
        self.sum += i128::from(number);
        self.least = Some(self.least.map_or(number, |least| least.min(number)));
        self.most = Some(self.most.map_or(number, |most| most.max(number)));
    }

    /// No value for the extremes and the mean of nothing, or for a sum beyond `i64`.
    pub(super) fn value(&self, function: Aggregation, kind: Kind) -> Option<i64> {
        match function {
            Aggregation::Count => Some(self.count),
            Aggregation::Sum => i64::try_from(self.sum).ok(),
            Aggregation::Min => self.least,
            Aggregation::Max => self.most,
            Aggregation::Mean if kind == Kind::Float => {
                decimal::rounded(self.sum, self.count.into())
            }
            // Rounded towards zero, as whole numbers are divided.
            Aggregation::Mean => i64::try_from(self.sum.checked_div(self.count.into())?).ok(),
        }
    }
}

impl<'a> Machine<'a, '_> {
    fn run_window(&mut self, window: Range<usize>) -> bool {
        let (steps, sources) = (self.steps, self.sources);
        let Some(Step::Scan(scan)) = steps.first() else { return self.run(0) };
        let Some(key) = self.key(&scan.key) else { return false };
        match &sources[scan.source] {
            Source::Index(index) => {
                let range = clip(index.range(key.words()), 0, &window);
                self.scan_index(scan, index, range, 1)
            }
            Source::Rows(parts) => self.scan_rows(scan, parts, key.words(), &window, 1),
            Source::Kept(_) | Source::Called(_) => self.run(0),
        }
    }

    fn run(&mut self, at: usize) -> bool {
        match &self.steps[at] {
            Step::Scan(scan) => self.scan(scan, at + 1),
            Step::Filter(compare) => self.holds(compare) && self.run(at + 1),
            Step::Let { register, value } => match self.compute(value) {
                Some(word) => {
                    self.registers[*register as usize] = word;
                    self.run(at + 1)
                }
                None => false,
            },
            Step::Each { register, bounds, is_known } => {
                self.each(*register, bounds, *is_known, at + 1)
            }
            Step::Absent { source, key } => {
                let has_row = match key.as_slice() {
                    [one] => match self.compute(one) {
                        Some(word) => self.has_row(*source, &[word]),
                        // A key without a value is in no relation.
                        None => false,
                    },
                    many => match self.key(many) {
                        Some(key) => self.has_row(*source, key.words()),
                        None => false,
                    },
                };
                !has_row && self.run(at + 1)
            }
            Step::Aggregate { function, kind, value, register, is_known, end } => {
                let Some(number) = self.aggregate((*function, *kind), value.as_ref(), at + 1, *end)
                else {
                    return false;
                };
                let word = self.words.number(number);
                let register = &mut self.registers[*register as usize];
                if *is_known && *register != word {
                    return false;
                }
                *register = word;
                self.run(*end)
            }
            Step::Reached => self.goal.reached(self.registers, self.words),
        }
    }

    fn each(&mut self, register: u32, bounds: &Bounds, is_known: bool, next: usize) -> bool {
        let known = |v: u32| self.registers[v as usize];
        let Some(numbers) = value::numbers(bounds, &known, self.words) else { return false };
        let register = register as usize;
        if is_known {
            let number = self.words.to_number(self.registers[register]);
            return numbers.contains(number) && self.run(next);
        }
        let mut found = false;
        for number in numbers.iter() {
            if self.watch.tick() {
                break;
            }
            self.registers[register] = self.words.number(number);
            found |= self.run(next);
        }
        found
    }

    fn compute(&mut self, expr: &Expr) -> Option<Word> {
        match expr {
            Expr::Variable(v) => Some(self.registers[*v as usize]),
            Expr::Constant(word) => Some(*word),
            Expr::Call(..) => value::compute(expr, &|v| self.registers[v as usize], self.words),
        }
    }

    fn holds(&mut self, compare: &Compare) -> bool {
        match (self.compute(&compare.left), self.compute(&compare.right)) {
            (Some(left), Some(right)) => {
                value::holds(compare.op, compare.kind.is_number(), left, right, self.words)
            }
            _ => false,
        }
    }

    fn key(&mut self, exprs: &[Expr]) -> Option<Key> {
        let mut key = Key { words: [0; MAX_KEY], len: exprs.len() };
        for (word, expr) in key.words.iter_mut().zip(exprs) {
            *word = self.compute(expr)?;
        }
        Some(key)
    }

    fn has_row(&mut self, source: usize, key: &[Word]) -> bool {
        match &self.sources[source] {
            Source::Index(index) => !index.range(key).is_empty(),
            Source::Rows(parts) => parts.iter().any(|rows| !rows.range(key).is_empty()),
            Source::Kept(kept) => kept.count(key) > 0,
            Source::Called(called) => called.has_rows(key, self.words),
        }
    }

    fn scan(&mut self, scan: &'a Scan, next: usize) -> bool {
        if self.watch.tick() {
            return false;
        }
        let sources = self.sources;
        if let [one] = scan.key.as_slice() {
            let Some(word) = self.compute(one) else { return false };
            return match &sources[scan.source] {
                Source::Index(index) => self.scan_index(scan, index, index.range(&[word]), next),
                Source::Rows(parts) => self.scan_rows(scan, parts, &[word], &ALL, next),
                Source::Kept(kept) => self.scan_kept(scan, kept, &[word], next),
                Source::Called(called) => self.scan_called(scan, called, &[word], next),
            };
        }
        let Some(key) = self.key(&scan.key) else { return false };
        match &sources[scan.source] {
            Source::Index(index) => self.scan_index(scan, index, index.range(key.words()), next),
            Source::Rows(parts) => self.scan_rows(scan, parts, key.words(), &ALL, next),
            Source::Kept(kept) => self.scan_kept(scan, kept, key.words(), next),
            Source::Called(called) => self.scan_called(scan, called, key.words(), next),
        }
    }

    /// The filters of a scan with the words that they compare with; none where one has no value.
    fn passing(&mut self, scan: &'a Scan) -> Option<Vec<(&'a ColumnFilter, Word)>> {
        scan.filters.iter().map(|filter| Some((filter, self.compute(&filter.value)?))).collect()
    }

    fn scan_rows(
        &mut self,
        scan: &'a Scan,
        parts: &[&dyn RowSet],
        key: &[Word],
        window: &Range<usize>,
        next: usize,
    ) -> bool {
        let Some(passing) = self.passing(scan) else { return false };
        let mut found = false;
        let mut before = 0;
        for rows in parts {
            let mut is_first = true;
            let whole = rows.range(key);
            let range = clip(whole.clone(), before, window);
            before += whole.len();
            let (near, far) = match passing.first() {
                Some((filter, word)) => narrow(*rows, range, key.len(), filter, *word),
                None => (range, 0..0),
            };
            for at in near.chain(far) {
                let row = rows.row(at);
                let passes = |(filter, word): &(&ColumnFilter, Word)| {
                    value::holds(filter.op, filter.is_number, row[filter.column], *word, self.words)
                };
                if !passing.iter().all(passes) {
                    continue;
                }
                // Rows that differ only in what is not loaded stand together; one of them is enough.
                let mut is_new = is_first || scan.counts;
                is_first = false;
                for (column, register) in &scan.loads {
                    let register = &mut self.registers[*register as usize];
                    is_new |= *register != row[*column];
                    *register = row[*column];
                }
                if !is_new && scan.same.is_empty() {
                    continue;
                }
                let same =
                    scan.same.iter().all(|(column, v)| self.registers[*v as usize] == row[*column]);
                if same && self.run(next) {
                    found = true;
                    if scan.once {
                        return true;
                    }
                }
            }
        }
        found
    }

    fn scan_index(
        &mut self,
        scan: &'a Scan,
        index: &Index,
        range: Range<usize>,
        next: usize,
    ) -> bool {
        let mut found = false;
        let Some((first, more)) = scan.filters.split_first() else {
            for at in range {
                if self.visit(scan, index, at, next) {
                    found = true;
                    if scan.once {
                        return true;
                    }
                }
            }
            return found;
        };
        let Some(word) = self.compute(&first.value).filter(|_| !range.is_empty()) else {
            return false;
        };
        let mut chosen = self.spare.pop().unwrap_or_default();
        choose(&mut chosen, range, index.at(first.column), first, word, self.words);
        for filter in more {
            if chosen.is_empty() {
                break;
            }
            match self.compute(&filter.value) {
                Some(word) => {
                    retain(&mut chosen, index.at(filter.column), filter, word, self.words)
                }
                None => chosen.clear(),
            }
        }
        for at in &chosen {
            if self.visit(scan, index, *at as usize, next) {
                found = true;
                if scan.once {
                    break;
                }
            }
        }
        self.spare.push(chosen);
        found
    }

    fn scan_kept(&mut self, scan: &'a Scan, kept: &Kept<'_>, key: &[Word], next: usize) -> bool {
        let mut chosen = self.spare.pop().unwrap_or_default();
        chosen.clear();
        kept.collect(key, &mut chosen);
        let passing = self.passing(scan);
        if passing.is_none() {
            chosen.clear();
        }
        let passing = passing.unwrap_or_default();
        let mut found = false;
        for slot in &chosen {
            let passes = passing.iter().all(|(filter, word)| {
                let known = kept.word(*slot, filter.column, self.words);
                known != NO_WORD
                    && value::holds(filter.op, filter.is_number, known, *word, self.words)
            });
            if !passes {
                continue;
            }
            for (column, register) in &scan.loads {
                self.registers[*register as usize] = kept.word(*slot, *column, self.words);
            }
            let same = scan.same.iter().all(|(column, v)| {
                self.registers[*v as usize] == kept.word(*slot, *column, self.words)
            });
            if same && self.run(next) {
                found = true;
                if scan.once {
                    break;
                }
            }
        }
        self.spare.push(chosen);
        found
    }

    fn scan_called(
        &mut self,
        scan: &'a Scan,
        called: &Called<'_>,
        key: &[Word],
        next: usize,
    ) -> bool {
        if scan.once && scan.filters.is_empty() && scan.loads.is_empty() && scan.same.is_empty() {
            return called.has_rows(key, self.words) && self.run(next);
        }
        let rows = called.rows(key, self.words);
        let Some(passing) = self.passing(scan) else { return false };
        let mut found = false;
        for row in rows.iter() {
            let passes = passing.iter().all(|(filter, word)| {
                let known = called.word(row, filter.column, self.words);
                known != NO_WORD
                    && value::holds(filter.op, filter.is_number, known, *word, self.words)
            });
            if !passes {
                continue;
            }
            for (column, register) in &scan.loads {
                self.registers[*register as usize] = called.word(row, *column, self.words);
            }
            let same = scan.same.iter().all(|(column, v)| {
                self.registers[*v as usize] == called.word(row, *column, self.words)
            });
            if same && self.run(next) {
                found = true;
                if scan.once {
                    break;
                }
            }
        }
        found
    }

    fn visit(&mut self, scan: &'a Scan, index: &Index, at: usize, next: usize) -> bool {
        for (column, register) in &scan.loads {
            self.registers[*register as usize] = index.at(*column).words[at];
        }
        let same =
            |(column, v): &(usize, u32)| self.registers[*v as usize] == index.at(*column).words[at];
        scan.same.iter().all(same) && self.run(next)
    }

    /// The count of a single lookup is the length of its range.
    fn count_range(&mut self, function: Aggregation, first: usize, end: usize) -> Option<i64> {
        let Step::Scan(scan) = &self.steps[first] else { return None };
        let is_plain = scan.filters.is_empty() && scan.same.is_empty() && first + 2 == end;
        if function != Aggregation::Count || !is_plain {
            return None;
        }
        let Some(key) = self.key(&scan.key) else { return Some(0) };
        Some(match &self.sources[scan.source] {
            Source::Index(index) => index.range(key.words()).len() as i64,
            Source::Rows(parts) => {
                parts.iter().map(|rows| rows.range(key.words()).len() as i64).sum()
            }
            Source::Kept(kept) => kept.count(key.words()) as i64,
            Source::Called(called) => called.rows(key.words(), self.words).len as i64,
        })
    }

    /// None where the aggregate has no value.
    fn aggregate(
        &mut self,
        (function, kind): (Aggregation, Kind),
        value: Option<&Expr>,
        first: usize,
        end: usize,
    ) -> Option<i64> {
        if let Some(count) = self.count_range(function, first, end) {
            return Some(count);
        }
        let mut count = Count::default();
        let mut each = |registers: &[Word], words: &mut Words| {
            let number = match value {
                Some(value) => value::number(value, &|v| registers[v as usize], words),
                None => Some(0),
            };
            if let Some(number) = number {
                count.add(number);
            }
            true
        };
        let steps = &self.steps[..end];
        let mut inner = Machine {
            steps,
            sources: self.sources,
            registers: &mut *self.registers,
            words: &mut *self.words,
            watch: self.watch,
            goal: &mut each,
            spare: Vec::new(),
        };
        inner.run(first);
        let value = count.value(function, kind);
        if let Some(rounded) =
            value.filter(|_| function == Aggregation::Mean && kind == Kind::Float)
            && count.sum % i128::from(count.count) != 0
        {
            self.words.note(Note::Rounded(Decimal::from_millionths(rounded)));
        }
        value
    }
}

/// A key has at most the words of a row.
const MAX_KEY: usize = super::declared::MAX_COLUMNS;

struct Key {
    words: [Word; MAX_KEY],
    len: usize,
}

impl Key {
    fn words(&self) -> &[Word] {
        &self.words[..self.len]
    }
}
