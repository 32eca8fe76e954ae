//! Writing behind: what is acknowledged is in the journal and in memory; sled follows at its own pace.
//!
//! A thread takes the keys that were written since it last looked, in their order, and brings sled to the state that
//! memory has now: so a record that changed ten times meanwhile is written once. What sled has not got when the
//! program ends without warning comes from the journal at the next opening, as it always did. When sled fails, it is
//! left alone from then on: the journal has everything, and whoever writes need not know.
//!
//! **Invariant**: sled's state mark never runs ahead of its records: keys, values and state are taken under one lock.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::error::{Result, StoreError};
use super::frame::Op;
use super::head::Head;
use super::memory::MemoryTrees;
use super::trees::{State, Trees};
use crate::units::Bilingual;

/// Operations that sled takes though more are being written: replaying them takes less than a second.
const TURN: usize = 512 << 10;
/// Operations beyond which the writer waits for sled.
const MOST_BEHIND: usize = 2 << 20;
/// Sled follows when nothing was written for so long, so that it does not take the processor from who writes.
const PATIENCE: Duration = Duration::from_millis(300);

#[derive(Default)]
struct Queue {
    /// Keys of what sled lacks.
    dirty: Vec<(u8, Vec<u8>)>,
    is_busy: bool,
    /// Someone waits for sled to be in step.
    is_wanted: bool,
    ends: bool,
    failed: Option<Bilingual>,
}

struct Shared {
    memory: Arc<MemoryTrees>,
    /// None: sled is not followed, and `Queue::failed` says why.
    trees: Option<Arc<dyn Trees>>,
    head: Option<Head>,
    queue: Mutex<Queue>,
    /// Told of work for the thread, and of work done.
    news: Condvar,
}

/// Memory, and sled behind it.
pub(crate) struct Behind {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'q>(&self, queue: MutexGuard<'q, Queue>) -> MutexGuard<'q, Queue> {
        self.news.wait(queue).unwrap_or_else(PoisonError::into_inner)
    }

    /// Brings the trees into step; gives the lock up while it writes.
    fn turn<'q>(&'q self, mut queue: MutexGuard<'q, Queue>) -> MutexGuard<'q, Queue> {
        let (ops, state) = self.memory.current(std::mem::take(&mut queue.dirty));
        queue.is_busy = true;
        drop(queue);
        if let Some(Err(error)) = self.head.as_ref().map(Head::sync) {
            tracing::debug!(%error, "head is not on the disk yet");
        }
        let done = self.trees.as_ref().map_or(Ok(()), |trees| trees.apply(ops, &state));
        let mut queue = self.lock();
        queue.is_busy = false;
        if let Err(error) = done {
            tracing::warn!(%error, "sled is not followed any more");
            queue.failed.get_or_insert(Bilingual::of(&error));
        }
        self.news.notify_all();
        queue
    }

    fn work(&self) {
        let mut queue = self.lock();
        loop {
            if queue.dirty.is_empty() || queue.failed.is_some() {
                if queue.ends {
                    return;
                }
                queue = self.wait(queue);
                continue;
            }
            if queue.dirty.len() < TURN && !queue.is_wanted && !queue.ends {
                let before = queue.dirty.len();
                let waited = self.news.wait_timeout(queue, PATIENCE);
                queue = waited.unwrap_or_else(PoisonError::into_inner).0;
                if queue.dirty.len() != before {
                    continue;
                }
            }
            queue = self.turn(queue);
        }
    }
}

impl Behind {
    /// `dirty` are the keys in which the trees differ from memory; instead of trees there may be a reason why none
    /// follow. Without a thread of its own, the trees follow when [`Behind::catch_up`] is called and at no other time.
    ///
    /// # Errors
    /// [`StoreError::Tables`] when the system has no thread to give.
    pub(crate) fn new(
        memory: Arc<MemoryTrees>,
        trees: std::result::Result<Arc<dyn Trees>, Bilingual>,
        head: Option<Head>,
        dirty: Vec<(u8, Vec<u8>)>,
        has_thread: bool,
    ) -> Result<Self> {
        let (trees, failed) = match trees {
            Ok(trees) => (Some(trees), None),
            Err(why) => (None, Some(why)),
        };
        let follows = has_thread && failed.is_none();
        let queue = Mutex::new(Queue { dirty, failed, ..Queue::default() });
        let shared = Arc::new(Shared { memory, trees, head, queue, news: Condvar::new() });
        let thread = if follows {
            let shared = Arc::clone(&shared);
            let spawned = std::thread::Builder::new()
                .name("orthoframe-store".to_owned())
                .spawn(move || shared.work());
            Some(spawned.map_err(|e| StoreError::Tables { what: e.to_string().into() })?)
        } else {
            None
        };
        Ok(Self { shared, thread })
    }

    /// Takes a transaction into memory; sled follows.
    pub(crate) fn apply(&self, ops: Vec<Op>, state: &State) -> Result<()> {
        let mut queue = self.shared.lock();
        while self.thread.is_some() && queue.dirty.len() > MOST_BEHIND && queue.failed.is_none() {
            queue = self.shared.wait(queue);
        }
        let before = queue.dirty.len();
        if queue.failed.is_none() {
            queue.dirty.extend(ops.iter().map(|op| (op.tree, op.key.clone())));
        }
        self.shared.memory.apply(ops, state)?;
        if before == 0 || (before < TURN && queue.dirty.len() >= TURN) {
            self.shared.news.notify_all();
        }
        Ok(())
    }

    /// Returns when sled has all that memory has.
    ///
    /// # Errors
    /// [`StoreError::Tables`] when sled failed.
    pub(crate) fn catch_up(&self) -> Result<()> {
        let mut queue = self.shared.lock();
        if self.thread.is_none() && queue.failed.is_none() {
            queue = self.shared.turn(queue);
        }
        queue.is_wanted = true;
        self.shared.news.notify_all();
        while (!queue.dirty.is_empty() || queue.is_busy) && queue.failed.is_none() {
            queue = self.shared.wait(queue);
        }
        queue.is_wanted = false;
        match &queue.failed {
            Some(what) => Err(StoreError::Tables { what: what.clone() }),
            None => Ok(()),
        }
    }

    /// As [`Behind::catch_up`], and gives sled's own buffers to the system.
    pub(crate) fn flush(&self) -> Result<()> {
        self.catch_up()?;
        self.shared.trees.as_ref().map_or(Ok(()), |trees| trees.flush())
    }
}

impl Drop for Behind {
    /// The next opening then has nothing to catch up with.
    fn drop(&mut self) {
        self.shared.lock().ends = true;
        self.shared.news.notify_all();
        if let Some(thread) = self.thread.take() {
            // It ends: sled answers in a bounded time or not at all. A thread that panicked left sled behind; the
            // journal has it all.
            let _ = thread.join();
        }
    }
}
