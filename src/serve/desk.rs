//! The engine on its own thread: work for it comes one piece after another, and what it then knows is shared.
//!
//! The store is in hand while there is something to write, and while the robot drives; else other programs may write it.
//! What they wrote is looked for before each piece of work, by whoever is about to ask ([`Desk::fresh`]), and now and then.
//!
//! **Invariant.** Nothing of this program but this thread writes; whoever reads has the [`State`] as it stood when it was
//! taken.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Arc, OnceLock, PoisonError, RwLock, mpsc};
use std::thread;
use std::time::Duration;

use serde_json::Value;
use tokio::sync::oneshot;

use crate::engine::{Engine, Error, Queue, State, json as views};
use crate::store::{Store, last_transaction};

use super::events::Events;

/// What is done when what came of a piece of work is shared.
type Then = Box<dyn FnOnce() + Send>;
type Piece = Box<dyn FnOnce(&mut Engine) -> Option<Then> + Send>;

struct Work {
    /// The store is taken up for it.
    writes: bool,
    piece: Piece,
}

/// So long the store stays in hand after a piece of work: the next one may come at once.
const REST: Duration = Duration::from_millis(50);
/// Between two looks at what others wrote, when nobody asks.
const GLANCE: Duration = Duration::from_millis(500);

/// The way to the engine.
#[derive(Debug)]
pub(super) struct Desk {
    work: mpsc::Sender<Work>,
    shared: Arc<Shared>,
}

/// Told the tasks that wait, where another program may have changed them.
type Heir = Box<dyn Fn(&Queue) + Send + Sync>;

/// What the engine's thread and all others have.
struct Shared {
    state: RwLock<Arc<State>>,
    /// The store's folder; none for a map in memory.
    store: Option<PathBuf>,
    /// The last transaction that the state knows of.
    known: AtomicU64,
    in_hand: AtomicBool,
    /// The robot is under way: the store stays in hand.
    is_driven: AtomicBool,
    heir: OnceLock<Heir>,
}

impl std::fmt::Debug for Shared {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Shared").field("store", &self.store).finish_non_exhaustive()
    }
}

impl Shared {
    /// Whether another program wrote what is not known here.
    fn is_behind(&self) -> bool {
        let Some(store) = self.store.as_deref() else { return false };
        !self.in_hand.load(Ordering::Acquire)
            && last_transaction(store).is_ok_and(|n| n != self.known.load(Ordering::Acquire))
    }
}

/// The store stays this program's until this is dropped.
#[derive(Debug)]
pub(super) struct Driven<'d>(&'d Desk);

impl Drop for Driven<'_> {
    fn drop(&mut self) {
        self.0.shared.is_driven.store(false, Ordering::Release);
        self.0.put(false, |engine| {
            engine.come_back();
            None
        });
    }
}

/// The thread's own side.
struct Clerk {
    engine: Engine,
    shared: Arc<Shared>,
    events: Arc<Events>,
}

impl Clerk {
    fn work(mut self, to_do: &Receiver<Work>) {
        loop {
            let in_hand = self.shared.in_hand.load(Ordering::Acquire);
            match to_do.recv_timeout(if in_hand { REST } else { GLANCE }) {
                Ok(work) => {
                    self.look(work.writes);
                    let before = self.engine.revision();
                    let then = (work.piece)(&mut self.engine);
                    self.share(before);
                    if let Some(then) = then {
                        then();
                    }
                }
                Err(RecvTimeoutError::Timeout) if !in_hand => self.look(false),
                Err(RecvTimeoutError::Timeout) => {
                    if !self.shared.is_driven.load(Ordering::Acquire) {
                        self.engine.put_down();
                        self.shared.in_hand.store(false, Ordering::Release);
                    }
                }
                Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    /// Takes over what other programs wrote; takes the store up where something is to be written.
    fn look(&mut self, writes: bool) {
        let before = self.engine.revision();
        let found = match writes {
            true => self.engine.take_up(),
            false => self.engine.catch_up(),
        };
        let in_hand = self.engine.store().is_ok_and(Store::is_in_hand);
        self.shared.in_hand.store(in_hand, Ordering::Release);
        match found {
            Ok(false) => {}
            Ok(true) => {
                self.share(before);
                self.events.tell("known", &views::known_changed(None));
                if let (Some(heir), Ok(queue)) = (self.shared.heir.get(), self.engine.queue()) {
                    heir(&queue);
                }
            }
            Err(error) => tracing::warn!(%error, "what others wrote is not known"),
        }
    }

    /// Shares what is known now, and tells of a new revision.
    fn share(&self, before: u64) {
        // What cannot be derived is told to whoever asks.
        if let Ok(state) = self.engine.state() {
            *self.shared.state.write().unwrap_or_else(PoisonError::into_inner) = state;
        }
        self.shared.known.store(transaction(&self.engine), Ordering::Release);
        if self.engine.revision() != before {
            self.events.tell("revision", &revision(&self.engine));
        }
    }
}

fn transaction(engine: &Engine) -> u64 {
    engine.store().map_or(0, Store::transaction)
}

/// The engine's thread has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Gone;

impl Desk {
    /// Moves an engine to its thread.
    ///
    /// # Errors
    /// What follows from the map cannot be derived, or the system gives no thread.
    pub(super) fn open(engine: Engine, events: Arc<Events>) -> Result<Self, Error> {
        let shared = Arc::new(Shared {
            state: RwLock::new(engine.state()?),
            store: engine.store().ok().map(|store| store.dir().to_owned()),
            known: transaction(&engine).into(),
            in_hand: engine.store().is_ok_and(Store::is_in_hand).into(),
            is_driven: false.into(),
            heir: OnceLock::new(),
        });
        let (work, to_do) = mpsc::channel::<Work>();
        let clerk = Clerk { engine, shared: Arc::clone(&shared), events };
        thread::spawn(move || clerk.work(&to_do));
        Ok(Self { work, shared })
    }

    /// Who is told the tasks that wait, where another program may have changed them; on the engine's thread.
    pub(super) fn bequeath(&self, heir: impl Fn(&Queue) + Send + Sync + 'static) {
        // There is one.
        let _ = self.shared.heir.set(Box::new(heir));
    }

    /// What is known now.
    #[must_use]
    pub(super) fn state(&self) -> Arc<State> {
        Arc::clone(&self.shared.state.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// Has the engine do something that writes; what comes of it is known to [`Desk::state`] soon after.
    ///
    /// # Errors
    /// The engine's thread has ended.
    pub(super) async fn ask<T: Send + 'static>(
        &self,
        work: impl FnOnce(&mut Engine) -> T + Send + 'static,
    ) -> Result<T, Gone> {
        let answer = self.answered(true, work).await?;
        // When this one is begun, the state of the one before is shared.
        self.answered(false, |_| ()).await?;
        Ok(answer)
    }

    /// Asks the engine what it alone knows.
    ///
    /// # Errors
    /// The engine's thread has ended.
    pub(super) async fn look<T: Send + 'static>(
        &self,
        work: impl FnOnce(&Engine) -> T + Send + 'static,
    ) -> Result<T, Gone> {
        self.answered(false, |engine| work(engine)).await
    }

    /// Returns when [`Desk::state`] has what other programs wrote until now.
    ///
    /// # Errors
    /// The engine's thread has ended.
    pub(super) async fn fresh(&self) -> Result<(), Gone> {
        if self.shared.is_behind() { self.answered(false, |_| ()).await } else { Ok(()) }
    }

    /// The same from a thread of one's own.
    ///
    /// # Errors
    /// The engine's thread has ended.
    pub(super) fn fresh_from_thread(&self) -> Result<(), Gone> {
        if self.shared.is_behind() { self.waited_for(false, |_| ()) } else { Ok(()) }
    }

    /// Keeps the store while the robot drives.
    ///
    /// # Errors
    /// Another program has it, or it cannot be written: what the robot does could not be noted.
    pub(super) fn set_out(&self) -> Result<Driven<'_>, Error> {
        self.shared.is_driven.store(true, Ordering::Release);
        let driven = Driven(self);
        match self.ask_from_thread(Engine::set_out) {
            Ok(Err(error)) => Err(error),
            // With the engine's thread all comes to its end.
            Ok(Ok(())) | Err(Gone) => Ok(driven),
        }
    }

    fn put(
        &self,
        writes: bool,
        piece: impl FnOnce(&mut Engine) -> Option<Then> + Send + 'static,
    ) -> bool {
        self.work.send(Work { writes, piece: Box::new(piece) }).is_ok()
    }

    async fn answered<T: Send + 'static>(
        &self,
        writes: bool,
        work: impl FnOnce(&mut Engine) -> T + Send + 'static,
    ) -> Result<T, Gone> {
        let (answer, answered) = oneshot::channel();
        self.put(writes, move |engine| {
            // Who asked may have gone.
            drop(answer.send(work(engine)));
            None
        });
        answered.await.map_err(|_gone| Gone)
    }

    fn waited_for<T: Send + 'static>(
        &self,
        writes: bool,
        work: impl FnOnce(&mut Engine) -> T + Send + 'static,
    ) -> Result<T, Gone> {
        let (answer, answered) = mpsc::channel();
        self.put(writes, move |engine| {
            drop(answer.send(work(engine)));
            None
        });
        answered.recv().map_err(|_gone| Gone)
    }

    /// Has the engine note something, and waits for nothing; what it returns is done when what came of it is known.
    pub(super) fn send(&self, work: impl FnOnce(&mut Engine) -> Option<Then> + Send + 'static) {
        // Without an engine nothing is left to be done.
        self.put(true, work);
    }

    /// As [`Desk::ask`], from a thread of one's own.
    ///
    /// # Errors
    /// The engine's thread has ended.
    pub(super) fn ask_from_thread<T: Send + 'static>(
        &self,
        work: impl FnOnce(&mut Engine) -> T + Send + 'static,
    ) -> Result<T, Gone> {
        let answer = self.waited_for(true, work)?;
        self.waited_for(false, |_| ())?;
        Ok(answer)
    }
}

fn revision(engine: &Engine) -> Value {
    let last = engine.revisions().ok().and_then(|all| all.into_iter().last());
    views::revised(engine.revision(), last.as_ref())
}
