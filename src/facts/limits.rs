//! What an evaluation may take, and the watch that looks at it in the course of its loops.

use std::cell::Cell;
use std::sync::atomic::{AtomicU8, AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock};
use std::thread;
use std::time::{Duration, Instant};

use crate::units::Stop;

/// A relation's rows at most, unless `.limitsize` says less.
pub(super) const MAX_ROWS: usize = 1 << 27;

/// Longer texts are no values: a recursive rule with `cat` would fill the memory.
pub(super) const MAX_TEXT: usize = 1 << 16;

/// How long an evaluation may go on, how much memory it may hold, and over how many threads it may spread.
#[derive(Debug, Clone)]
pub struct Limits {
    pub time: Duration,
    /// Raised from outside when nobody waits for the result any more.
    pub stop: Option<Stop>,
    pub memory_bytes: usize,
    /// Of one relation.
    pub rows: usize,
    /// Threads among which the rows of a large join are divided; the result and its order are those of one.
    pub threads: usize,
    /// How long the rest of a join must seem to take to be divided. A thread costs some tens of microseconds.
    pub spread_from: Duration,
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

impl Ceilings {
    /// What both allow.
    pub(super) fn within(self, other: Self) -> Self {
        let least = |one: Option<u64>, other: Option<u64>| one.into_iter().chain(other).min();
        Self {
            seconds: least(self.seconds, other.seconds),
            megabytes: least(self.megabytes, other.megabytes),
            rows: least(self.rows, other.rows),
            on_demand: self.on_demand || other.on_demand,
        }
    }
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
            ..self
        }
    }
}

/// How many there are is read from files, which takes longer than a small change of the facts.
static CORES: LazyLock<usize> =
    LazyLock::new(|| thread::available_parallelism().map_or(1, usize::from));

impl Default for Limits {
    /// Ten minutes and two gigabytes: more than the rules of a large hospital need, less than a machine has. All cores.
    fn default() -> Self {
        Self {
            time: Duration::from_secs(600),
            stop: None,
            memory_bytes: 1 << 31,
            rows: MAX_ROWS,
            threads: *CORES,
            spread_from: Duration::from_millis(1),
        }
    }
}

/// Which limit was reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reached {
    Time,
    Memory,
    /// Nobody waits any more.
    Stop,
}

impl Reached {
    const ALL: [Self; 3] = [Self::Time, Self::Memory, Self::Stop];
}

/// What the watches of one evaluation's threads have in common.
#[derive(Debug, Default)]
struct Common {
    /// Behind the place in [`Reached::ALL`]; 0 for none.
    reached: AtomicU8,
    /// Memory that the rule makes that runs, in all threads.
    made: AtomicUsize,
    /// Memory of relations that threads have finished of which the others do not know yet.
    kept: AtomicUsize,
    /// Threads that have strata of their own.
    busy: AtomicUsize,
}

/// Clock and memory of an evaluation under way, as one thread sees them. Once a limit is reached it stays so, and all
/// loops run out.
#[derive(Debug)]
pub(super) struct Watch {
    /// None where nothing is limited.
    limits: Option<(Limits, Instant)>,
    ticks: Cell<u32>,
    /// Memory that does not change while a rule runs: relations and indexes that are finished.
    held: Cell<usize>,
    /// What this thread has added to [`Common::made`].
    made: Cell<usize>,
    common: Arc<Common>,
    /// Rows that the last rule had found when it ended.
    rows: Cell<usize>,
}

/// Looking at the clock costs more than most of what is done between two looks.
const TICKS_A_LOOK: u32 = 1 << 10;

impl Watch {
    pub(super) fn new(limits: Limits) -> Self {
        let mut watch = Self::unlimited();
        watch.limits = Some((limits, Instant::now()));
        watch
    }

    /// For what is bounded by a result that is there already.
    pub(super) fn unlimited() -> Self {
        Self {
            limits: None,
            ticks: Cell::new(0),
            held: Cell::new(0),
            made: Cell::new(0),
            common: Arc::default(),
            rows: Cell::new(0),
        }
    }

    /// The same evaluation's watch for another thread.
    pub(super) fn branch(&self) -> Branch {
        Branch {
            limits: self.limits.clone(),
            held: self.held.get(),
            common: Arc::clone(&self.common),
        }
    }

    pub(super) fn limits(&self) -> &Limits {
        static USUAL: LazyLock<Limits> = LazyLock::new(Limits::default);
        self.limits.as_ref().map_or_else(|| &*USUAL, |(limits, _)| limits)
    }

    /// Ends all loops for a reason of the caller's own.
    pub(super) fn stop(&self) {
        self.reach(Reached::Time);
    }

    /// Threads that may have a part in what this one does.
    pub(super) fn threads(&self) -> usize {
        let busy = self.common.busy.load(Ordering::Relaxed).max(1);
        (self.limits().threads / busy).max(1)
    }

    /// Until it is dropped this thread has strata of its own.
    pub(super) fn busy(&self) -> Busy {
        self.common.busy.fetch_add(1, Ordering::Relaxed);
        Busy(Arc::clone(&self.common))
    }

    /// So much more is held by what this thread has finished.
    pub(super) fn keep(&self, bytes: usize) {
        self.common.kept.fetch_add(bytes, Ordering::Relaxed);
    }

    /// What threads have finished is known to all from now on.
    pub(super) fn kept_is_held(&self) {
        self.common.kept.store(0, Ordering::Relaxed);
    }

    pub(super) fn found(&self, rows: usize) {
        self.rows.set(rows);
    }

    pub(super) fn rows(&self) -> usize {
        self.rows.get()
    }

    /// The first limit that was reached.
    pub(super) fn reached(&self) -> Option<Reached> {
        let behind = usize::from(self.common.reached.load(Ordering::Relaxed));
        Reached::ALL.get(behind.checked_sub(1)?).copied()
    }

    fn reach(&self, limit: Reached) {
        let place = Reached::ALL.iter().position(|known| *known == limit).unwrap_or(0) as u8;
        let _ = self.common.reached.compare_exchange(
            0,
            place + 1,
            Ordering::Relaxed,
            Ordering::Relaxed,
        );
    }

    #[inline]
    pub(super) fn is_over(&self) -> bool {
        self.common.reached.load(Ordering::Relaxed) != 0
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
        let Some((limits, since)) = &self.limits else { return };
        if limits.stop.as_ref().is_some_and(Stop::is_raised) {
            self.reach(Reached::Stop);
        } else if since.elapsed() >= limits.time {
            self.reach(Reached::Time);
        }
    }

    /// Says how much is held beside what the rule that runs makes.
    pub(super) fn hold(&self, bytes: usize) {
        self.held.set(bytes);
        self.weigh(0);
    }

    fn make(&self, bytes: usize) {
        let before = self.made.replace(bytes);
        // In two steps, so that nothing falls below zero.
        self.common.made.fetch_add(bytes, Ordering::Relaxed);
        self.common.made.fetch_sub(before, Ordering::Relaxed);
    }

    /// Looks whether so much more than what is held fits; true when it is time to end.
    pub(super) fn weigh(&self, bytes: usize) -> bool {
        let Some((limits, _)) = &self.limits else { return false };
        self.make(bytes);
        let made = self.common.made.load(Ordering::Relaxed);
        let made = made.saturating_add(self.common.kept.load(Ordering::Relaxed));
        if self.held.get().saturating_add(made) > limits.memory_bytes {
            self.reach(Reached::Memory);
        }
        self.look();
        self.is_over()
    }
}

/// A thread that has strata of its own.
pub(super) struct Busy(Arc<Common>);

impl Drop for Busy {
    fn drop(&mut self) {
        self.0.busy.fetch_sub(1, Ordering::Relaxed);
    }
}

/// A watch on its way to another thread.
pub(super) struct Branch {
    limits: Option<(Limits, Instant)>,
    held: usize,
    common: Arc<Common>,
}

impl Branch {
    pub(super) fn watch(self) -> Watch {
        Watch {
            limits: self.limits,
            held: Cell::new(self.held),
            made: Cell::new(0),
            common: self.common,
            ticks: Cell::new(0),
            rows: Cell::new(0),
        }
    }
}

impl Drop for Watch {
    /// What a thread has made is handed over.
    fn drop(&mut self) {
        self.make(0);
    }
}
