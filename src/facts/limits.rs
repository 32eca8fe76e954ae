//! What an evaluation may take, and the watch that looks at it in the course of its loops.

use std::cell::Cell;
use std::time::{Duration, Instant};

use super::evaluate::MAX_ROWS;

/// How long an evaluation may go on, and how much memory it may hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    pub time: Duration,
    pub memory_bytes: usize,
    /// Of one relation.
    pub rows: usize,
}

/// What a program's own text allows: `.pragma "time-limit" "10"` in seconds, `"memory-limit"` in mebibytes,
/// `"row-limit"` in rows of one relation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Ceilings {
    pub(super) seconds: Option<u64>,
    pub(super) megabytes: Option<u64>,
    pub(super) rows: Option<u64>,
    /// `.pragma "magic-transform" "*"`: what is put out is derived on demand.
    pub(super) on_demand: bool,
}

impl Limits {
    /// The narrower of both.
    pub(super) fn within(self, ceilings: Ceilings) -> Self {
        let time = ceilings.seconds.map_or(self.time, Duration::from_secs);
        let bytes =
            ceilings.megabytes.map_or(u64::MAX, |megabytes| megabytes.saturating_mul(1 << 20));
        Self {
            time: self.time.min(time),
            memory_bytes: self.memory_bytes.min(usize::try_from(bytes).unwrap_or(usize::MAX)),
            rows: ceilings.rows.map_or(self.rows, |rows| {
                self.rows.min(usize::try_from(rows).unwrap_or(usize::MAX))
            }),
        }
    }
}

impl Default for Limits {
    /// Ten minutes and two gigabytes: more than the rules of a large hospital need, less than a machine has.
    fn default() -> Self {
        Self { time: Duration::from_secs(600), memory_bytes: 1 << 31, rows: MAX_ROWS }
    }
}

/// Which limit was reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reached {
    Time,
    Memory,
}

/// Clock and memory of an evaluation under way. Once a limit is reached it stays so, and all loops run out.
#[derive(Debug)]
pub(super) struct Watch {
    /// None where nothing is limited.
    limits: Option<(Limits, Instant)>,
    ticks: Cell<u32>,
    /// Memory that does not change while a rule runs: relations and indexes that are finished.
    held: Cell<usize>,
    reached: Cell<Option<Reached>>,
    /// Rows that the last rule had found when it ended.
    rows: Cell<usize>,
}

/// Looking at the clock costs more than most of what is done between two looks.
const TICKS_A_LOOK: u32 = 1 << 10;

impl Watch {
    pub(super) fn new(limits: Limits) -> Self {
        Self { limits: Some((limits, Instant::now())), ..Self::unlimited() }
    }

    /// For what is bounded by a result that is there already.
    pub(super) fn unlimited() -> Self {
        Self {
            limits: None,
            ticks: Cell::new(0),
            held: Cell::new(0),
            reached: Cell::new(None),
            rows: Cell::new(0),
        }
    }

    pub(super) fn limits(&self) -> Limits {
        self.limits.map_or_else(Limits::default, |(limits, _)| limits)
    }

    /// Ends all loops for a reason of the caller's own.
    pub(super) fn stop(&self) {
        self.reached.set(self.reached.get().or(Some(Reached::Time)));
    }

    pub(super) fn found(&self, rows: usize) {
        self.rows.set(rows);
    }

    pub(super) fn rows(&self) -> usize {
        self.rows.get()
    }

    pub(super) fn reached(&self) -> Option<Reached> {
        self.reached.get()
    }

    pub(super) fn is_over(&self) -> bool {
        self.reached.get().is_some()
    }

    /// Counts a piece of work of a loop; true when it is time to end.
    #[inline]
    pub(super) fn tick(&self) -> bool {
        let ticks = self.ticks.get().wrapping_add(1);
        self.ticks.set(ticks);
        if ticks.is_multiple_of(TICKS_A_LOOK) {
            self.look();
        }
        self.is_over()
    }

    fn look(&self) {
        let Some((limits, since)) = self.limits else { return };
        if since.elapsed() >= limits.time {
            self.reached.set(Some(Reached::Time));
        }
    }

    /// Says how much is held beside what the rule that runs makes.
    pub(super) fn hold(&self, bytes: usize) {
        self.held.set(bytes);
        self.weigh(0);
    }

    /// Looks whether so much more than what is held fits; true when it is time to end.
    pub(super) fn weigh(&self, bytes: usize) -> bool {
        let Some((limits, _)) = self.limits else { return false };
        if self.held.get().saturating_add(bytes) > limits.memory_bytes {
            self.reached.set(Some(Reached::Memory));
        }
        self.look();
        self.is_over()
    }
}
