//! A wall around a foreign library: it works on a thread of its own, and whoever asks it waits a bounded time.
//!
//! sled may refuse, panic, be slow, or never come back: on a full disk it waits, while it opens or closes, for a flush
//! that has failed. Behind the wall all this is one thing: a [`Fault`], told within a bounded time. What hangs is left
//! where it is, with all that it holds; the program goes on and ends without it.
//!
//! **Invariant**: no call here takes longer than [`Wall`]'s patience after the last sign of progress ([`Pulse`]).

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::units::{Bilingual, said, word};

/// Why what is behind the wall did not do what it was asked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Fault {
    pub(super) what: Bilingual,
    /// It must not be touched again, not even to be closed.
    pub(super) is_final: bool,
}

impl Fault {
    pub(super) fn new(what: impl Into<Bilingual>) -> Self {
        Self { what: what.into(), is_final: false }
    }
}

/// What works behind the wall beats it, so that long work is told from work that will never end.
#[derive(Clone, Default)]
pub(super) struct Pulse(Arc<AtomicU64>);

impl Pulse {
    pub(super) fn beat(&self) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }

    fn count(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}

type Job<S> = Box<dyn FnOnce(&mut Option<S>) + Send>;

/// A service behind a wall. It is made, used and dropped on its own thread.
pub(super) struct Wall<S> {
    jobs: Sender<Job<S>>,
    pulse: Pulse,
    patience: Duration,
    failed: Mutex<Option<Fault>>,
}

/// Answers sent on while the work goes on, so that it runs ahead of who reads them, but not far.
const AHEAD: usize = 4;

impl<S: 'static> Wall<S> {
    /// Makes the service on its thread.
    ///
    /// # Errors
    /// It refused, panicked, or was not there in time.
    pub(super) fn raise(
        patience: Duration,
        make: impl FnOnce(&Pulse) -> Result<S, Fault> + Send + 'static,
    ) -> Result<Self, Fault> {
        let (jobs, todo) = channel::<Job<S>>();
        let pulse = Pulse::default();
        let wall = Self { jobs, pulse: pulse.clone(), patience, failed: Mutex::default() };
        let (answer, heard) = sync_channel(1);
        let work = move || {
            let mut service = match guarded(|| make(&pulse)) {
                Ok(service) => Some(service),
                Err(fault) => {
                    let _ = answer.send(Err(fault));
                    return;
                }
            };
            // Who has stopped waiting drops the wall, and with it the jobs.
            let _ = answer.send(Ok(()));
            while let Ok(job) = todo.recv() {
                job(&mut service);
            }
            let _ = guarded(|| {
                drop(service);
                Ok(())
            });
        };
        let thread = std::thread::Builder::new().name("orthoframe-sled".to_owned());
        thread.spawn(work).map_err(|e| Fault::new(e.to_string()))?;
        // What refused to be made is gone already.
        wall.hear(&heard)?.map(|()| wall).map_err(|fault| Fault::new(fault.what))
    }

    /// One call.
    ///
    /// # Errors
    /// This call failed, or one before it did.
    pub(super) fn ask<T: Send + 'static>(
        &self,
        job: impl FnOnce(&S, &Pulse) -> Result<T, Fault> + Send + 'static,
    ) -> Result<T, Fault> {
        let (answer, heard) = sync_channel(1);
        self.send(answer, move |service, pulse, answer| {
            let done = guarded(|| job(service, pulse));
            let _ = answer.send(done);
        })?;
        let done = self.hear(&heard)?;
        if let Err(fault) = &done {
            self.fail(fault);
        }
        done
    }

    /// A call that gives many things, one after the other; `visit` returns whether to go on.
    ///
    /// # Errors
    /// As [`Wall::ask`]; inside, whatever `visit` says.
    pub(super) fn each<T: Send + 'static, E>(
        &self,
        job: impl FnOnce(&S, &mut dyn FnMut(T) -> bool) -> Result<(), Fault> + Send + 'static,
        mut visit: impl FnMut(T) -> Result<bool, E>,
    ) -> Result<Result<(), E>, Fault> {
        let (answer, heard) = sync_channel(AHEAD);
        self.send(answer, move |service, _, answer| {
            let mut give = |thing| answer.send(Ok(Some(thing))).is_ok();
            let done = guarded(|| job(service, &mut give));
            let _ = answer.send(done.map(|()| None));
        })?;
        loop {
            match self.hear(&heard)? {
                Ok(Some(thing)) => match visit(thing) {
                    Ok(true) => {}
                    Ok(false) => return Ok(Ok(())),
                    Err(error) => return Ok(Err(error)),
                },
                Ok(None) => return Ok(Ok(())),
                Err(fault) => {
                    self.fail(&fault);
                    return Err(fault);
                }
            }
        }
    }

    /// Whether the service was left behind with all that it holds.
    pub(super) fn is_abandoned(&self) -> bool {
        self.failure().as_ref().is_some_and(|fault| fault.is_final)
    }

    /// Lets the service go, in good order where it still works.
    pub(super) fn close(&self) {
        if self.is_abandoned() {
            // Its own closing could wait for ever.
            let _ = self.jobs.send(Box::new(|service| std::mem::forget(service.take())));
            return;
        }
        let (answer, heard) = sync_channel(1);
        let closing: Job<S> = Box::new(move |service| {
            let service = service.take();
            let done = guarded(|| {
                drop(service);
                Ok(())
            });
            let _ = answer.send(done);
        });
        if self.jobs.send(closing).is_ok() {
            let _ = self.hear(&heard);
        }
    }

    fn send<T: Send + 'static>(
        &self,
        answer: SyncSender<Result<T, Fault>>,
        job: impl FnOnce(&S, &Pulse, &SyncSender<Result<T, Fault>>) + Send + 'static,
    ) -> Result<(), Fault> {
        if let Some(fault) = self.failure().clone() {
            return Err(fault);
        }
        let pulse = self.pulse.clone();
        let job: Job<S> = Box::new(move |service| match service {
            Some(service) => job(service, &pulse, &answer),
            None => {
                let _ = answer.send(Err(Fault::new(word!("it-is-closed"))));
            }
        });
        self.jobs.send(job).map_err(|_ended| Fault::new(word!("it-has-stopped")))
    }

    /// Waits for an answer as long as there is progress.
    fn hear<T>(&self, heard: &Receiver<T>) -> Result<T, Fault> {
        loop {
            let before = self.pulse.count();
            match heard.recv_timeout(self.patience) {
                Ok(answer) => return Ok(answer),
                Err(RecvTimeoutError::Timeout) if self.pulse.count() != before => {}
                Err(RecvTimeoutError::Timeout) => {
                    let seconds = self.patience.as_secs_f64();
                    let what = said!("no-answer-for-s", seconds);
                    let fault = Fault { what, is_final: true };
                    self.fail(&fault);
                    return Err(fault);
                }
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(Fault::new(word!("it-has-stopped")));
                }
            }
        }
    }

    fn failure(&self) -> MutexGuard<'_, Option<Fault>> {
        self.failed.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn fail(&self, fault: &Fault) {
        let mut failed = self.failure();
        if failed.as_ref().is_none_or(|known| !known.is_final) {
            *failed = Some(fault.clone());
        }
    }
}

/// Runs a call, turning a panic into a fault.
fn guarded<T>(call: impl FnOnce() -> Result<T, Fault>) -> Result<T, Fault> {
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|&text| text.to_owned()));
        Err(Fault::new(text.map_or(said!("it-failed"), Bilingual::from)))
    })
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::*;

    /// With what never answers.
    const PATIENCE: Duration = Duration::from_millis(500);
    /// With what does: telling of a panic alone can take a busy machine a while.
    const ENOUGH: Duration = Duration::from_secs(60);

    /// What its drop does.
    enum End {
        Quick,
        Hangs,
        Panics,
    }

    struct Service(End);

    impl Drop for Service {
        fn drop(&mut self) {
            match self.0 {
                End::Quick => {}
                End::Hangs => std::thread::sleep(Duration::from_secs(3600)),
                End::Panics => panic!("closing failed"),
            }
        }
    }

    fn wall(end: End) -> Wall<Service> {
        Wall::raise(PATIENCE, |_| Ok(Service(end))).expect("it is made")
    }

    fn forever<T>() -> Result<T, Fault> {
        loop {
            std::thread::sleep(Duration::from_secs(3600));
        }
    }

    #[test]
    fn whatever_it_does_every_call_ends() {
        let begin = Instant::now();
        for end in [End::Quick, End::Hangs, End::Panics] {
            wall(end).close();
        }
        let hung = Wall::<Service>::raise(PATIENCE, |_| forever()).err().expect("it never opens");
        assert!(hung.is_final);
        let refused =
            Wall::<Service>::raise(ENOUGH, |_| Err(Fault::new(("нет места", "no room")))).err();
        assert_eq!(refused, Some(Fault::new(("нет места", "no room"))));

        let service = wall(End::Hangs);
        assert_eq!(service.ask(|_, _| Ok(7)), Ok(7));
        assert!(service.ask(|_, _| forever::<()>()).is_err_and(|fault| fault.is_final));
        assert!(service.is_abandoned());
        assert!(service.ask(|_, _| Ok(7)).is_err(), "what hangs is not asked again");
        service.close();

        let service = Wall::raise(ENOUGH, |_| Ok(Service(End::Quick))).expect("it is made");
        let panicked: Result<(), Fault> = service.ask(|_, _| panic!("broken page"));
        assert_eq!(panicked, Err(Fault::new("broken page")));
        assert!(service.ask(|_, _| Ok(7)).is_err(), "what has failed is not asked again");
        service.close();

        let service = wall(End::Quick);
        let mut seen = Vec::new();
        let given = service.each(
            |_, give| {
                (0..3).for_each(|n| assert!(give(n)));
                forever()
            },
            |n: i32| {
                seen.push(n);
                Ok::<_, ()>(true)
            },
        );
        assert!(given.is_err_and(|fault| fault.is_final));
        assert_eq!(seen, [0, 1, 2]);
        assert!(begin.elapsed() < Duration::from_secs(60), "bounded, on a busy machine too");
    }

    #[test]
    fn slow_work_that_goes_on_is_waited_for() {
        let service = wall(End::Quick);
        let done = service.ask(|_, pulse| {
            for _ in 0..30 {
                std::thread::sleep(PATIENCE / 10);
                pulse.beat();
            }
            Ok("done")
        });
        assert_eq!(done, Ok("done"));
        let mut visited = 0;
        let stopped = service.each(
            |_, give| {
                let _ = (0..1000).take_while(|n| give(*n)).count();
                Ok(())
            },
            |_: i32| {
                visited += 1;
                Ok::<_, ()>(visited < 3)
            },
        );
        assert_eq!((stopped, visited), (Ok(Ok(())), 3));
        assert_eq!(service.ask(|_, _| Ok(7)), Ok(7), "a reader that stops does no harm");
        service.close();
    }
}
