//! The engine on its own thread: work for it comes one piece after another, and what it then knows is shared.
//!
//! **Invariant.** Nothing but this thread writes; whoever reads has the [`State`] as it stood when it was taken.

use std::sync::{Arc, PoisonError, RwLock, mpsc};
use std::thread;

use serde_json::Value;
use tokio::sync::oneshot;

use crate::engine::{Engine, Error, State, json as views};

use super::events::Events;

/// What is done when what came of a piece of work is shared.
type Then = Box<dyn FnOnce() + Send>;
type Work = Box<dyn FnOnce(&mut Engine) -> Option<Then> + Send>;

/// The way to the engine.
#[derive(Debug)]
pub(super) struct Desk {
    work: mpsc::Sender<Work>,
    state: Arc<RwLock<Arc<State>>>,
}

/// The engine's thread has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Gone;

impl Desk {
    /// Moves an engine to its thread.
    ///
    /// # Errors
    /// What follows from the map cannot be derived, or the system gives no thread.
    pub(super) fn open(mut engine: Engine, events: Arc<Events>) -> Result<Self, Error> {
        let state = Arc::new(RwLock::new(engine.state()?));
        let shared = Arc::clone(&state);
        let (work, to_do) = mpsc::channel::<Work>();
        thread::spawn(move || {
            for piece in to_do {
                let before = engine.revision();
                let then = piece(&mut engine);
                // What cannot be derived is told to whoever asks.
                if let Ok(state) = engine.state() {
                    *shared.write().unwrap_or_else(PoisonError::into_inner) = state;
                }
                if engine.revision() != before {
                    events.tell("revision", &revision(&engine));
                }
                if let Some(then) = then {
                    then();
                }
            }
        });
        Ok(Self { work, state })
    }

    /// What is known now.
    #[must_use]
    pub(super) fn state(&self) -> Arc<State> {
        Arc::clone(&self.state.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// Has the engine do something; what comes of it is known to [`Desk::state`] soon after.
    ///
    /// # Errors
    /// The engine's thread has ended.
    pub(super) async fn ask<T: Send + 'static>(
        &self,
        work: impl FnOnce(&mut Engine) -> T + Send + 'static,
    ) -> Result<T, Gone> {
        let (answer, answered) = oneshot::channel();
        let work = move |engine: &mut Engine| {
            drop(answer.send(work(engine)));
            None
        };
        self.work.send(Box::new(work)).map_err(|_gone| Gone)?;
        let answer = answered.await.map_err(|_gone| Gone)?;
        // When this one is begun, the state of the one before is shared.
        self.flush().await?;
        Ok(answer)
    }

    async fn flush(&self) -> Result<(), Gone> {
        let (answer, answered) = oneshot::channel();
        let nothing = move |_: &mut Engine| {
            // Who asked may have gone.
            let _ = answer.send(());
            None
        };
        self.work.send(Box::new(nothing)).map_err(|_gone| Gone)?;
        answered.await.map_err(|_gone| Gone)
    }

    /// Has the engine do something, and waits for nothing; what it returns is done when what came of it is known.
    pub(super) fn send(&self, work: impl FnOnce(&mut Engine) -> Option<Then> + Send + 'static) {
        // Without an engine nothing is left to be done.
        let _ = self.work.send(Box::new(work));
    }

    /// The same from a thread of one's own.
    ///
    /// # Errors
    /// The engine's thread has ended.
    pub(super) fn ask_from_thread<T: Send + 'static>(
        &self,
        work: impl FnOnce(&mut Engine) -> T + Send + 'static,
    ) -> Result<T, Gone> {
        let (answer, answered) = mpsc::channel();
        let work = move |engine: &mut Engine| {
            drop(answer.send(work(engine)));
            None
        };
        self.work.send(Box::new(work)).map_err(|_gone| Gone)?;
        let answer = answered.recv().map_err(|_gone| Gone)?;
        let (flushed, has_flushed) = mpsc::channel();
        let nothing = move |_: &mut Engine| {
            let _ = flushed.send(());
            None
        };
        self.work.send(Box::new(nothing)).map_err(|_gone| Gone)?;
        has_flushed.recv().map_err(|_gone| Gone)?;
        Ok(answer)
    }
}

fn revision(engine: &Engine) -> Value {
    let last = engine.revisions().ok().and_then(|all| all.into_iter().last());
    views::revised(engine.revision(), last.as_ref())
}
