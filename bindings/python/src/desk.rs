//! The engine between threads, and what goes wrong as exceptions.
//!
//! Between two calls other programs may write the store; a call that asks takes over what they wrote, and one that writes
//! has the store until it is done. While the robot is under way, the store stays this program's.
//!
//! **Invariant.** One thread at a time has the engine, and no Python runs while it does; who reads has the [`State`] as
//! it stood, and holds nobody up.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

use orthoframe::engine::json;
use orthoframe::{Engine, Error, Language, State};
use pyo3::prelude::*;
use serde_json::Value;

use crate::dict::to_python;

/// What all threads share.
#[derive(Debug)]
pub(crate) struct Desk {
    held: Mutex<Held>,
    pub(crate) language: Language,
    pub(crate) user: String,
}

/// What one thread has at a time. Who takes the robot takes the store with it, and who lets it go puts both down at once:
/// between the two nobody else takes either.
#[derive(Debug)]
struct Held {
    /// None once it was closed.
    engine: Option<Engine>,
    /// The robot is one: while it is under way, nothing else sends it.
    is_under_way: bool,
}

/// Why a call fails.
#[derive(Debug)]
pub(crate) enum Failure {
    /// What the engine says of it.
    Engine(Box<Error>),
    /// It was closed.
    Closed,
    /// A panic left the engine as nobody knows.
    Broken,
    Panicked(String),
    /// The robot is under way already.
    Busy,
    /// The caller is at fault, in English.
    Value(String),
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Engine(Box::new(error.into()))
    }
}

/// A failure told, to be raised where Python is at hand.
#[derive(Debug, Clone)]
pub(crate) struct Told {
    class: &'static str,
    message: String,
    faults: Vec<Value>,
}

impl Desk {
    pub(crate) fn new(mut engine: Engine, language: Language, user: String) -> Self {
        engine.put_down();
        Self {
            held: Mutex::new(Held { engine: Some(engine), is_under_way: false }),
            language,
            user,
        }
    }

    /// Has the engine to oneself, and the store.
    pub(crate) fn write<T>(
        &self,
        work: impl FnOnce(&mut Engine) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let mut held = self.held()?;
        let rests = !held.is_under_way;
        let engine = held.engine()?;
        engine.take_up()?;
        let done = work(engine);
        if rests {
            engine.put_down();
        }
        done
    }

    /// Has the engine to oneself, to ask it.
    pub(crate) fn look<T>(
        &self,
        work: impl FnOnce(&mut Engine) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        self.alone(|engine| {
            engine.catch_up()?;
            work(engine)
        })
    }

    fn alone<T>(&self, work: impl FnOnce(&mut Engine) -> Result<T, Failure>) -> Result<T, Failure> {
        work(self.held()?.engine()?)
    }

    fn held(&self) -> Result<MutexGuard<'_, Held>, Failure> {
        self.held.lock().map_err(|_poison| Failure::Broken)
    }

    /// The robot sets out: what it does will be noted.
    pub(crate) fn sets_out(&self) -> Result<(), Failure> {
        self.alone(|engine| Ok(engine.set_out()?))
    }

    /// What is known now.
    pub(crate) fn state(&self) -> Result<Arc<State>, Failure> {
        self.look(|engine| {
            engine.pass_time(SystemTime::now().into());
            Ok(engine.state()?)
        })
    }

    /// Gives the store back, for others to open.
    pub(crate) fn close(&self) {
        let engine = self.held.lock().unwrap_or_else(PoisonError::into_inner).engine.take();
        drop(engine);
    }

    /// The robot for oneself, until this is dropped.
    pub(crate) fn take_robot(self: &Arc<Self>) -> Result<Robot, Failure> {
        let mut held = self.held()?;
        if held.is_under_way {
            return Err(Failure::Busy);
        }
        held.engine()?.take_up()?;
        held.is_under_way = true;
        Ok(Robot(Arc::clone(self)))
    }

    /// Does something with the interpreter let go; what goes wrong is an exception.
    pub(crate) fn free<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        py.detach(|| guarded(work).map_err(|failure| self.tell(&failure)))
            .map_err(|told| told.raised(py))
    }

    /// The same for what answers with JSON.
    pub(crate) fn answer<'py>(
        &self,
        py: Python<'py>,
        work: impl FnOnce() -> Result<Value, Failure> + Send,
    ) -> PyResult<Bound<'py, PyAny>> {
        let value = self.free(py, work)?;
        to_python(py, &value)
    }

    /// A failure in words.
    pub(crate) fn tell(&self, failure: &Failure) -> Told {
        Told::of(failure, self.language)
    }
}

impl Held {
    fn engine(&mut self) -> Result<&mut Engine, Failure> {
        self.engine.as_mut().ok_or(Failure::Closed)
    }
}

/// See [`Desk::take_robot`].
#[derive(Debug)]
pub(crate) struct Robot(Arc<Desk>);

impl Drop for Robot {
    fn drop(&mut self) {
        // A broken engine, or one that was closed, has nothing to put down.
        let (mut held, is_whole) = match self.0.held.lock() {
            Ok(held) => (held, true),
            Err(poison) => (poison.into_inner(), false),
        };
        held.is_under_way = false;
        if let Some(engine) = held.engine.as_mut().filter(|_| is_whole) {
            engine.come_back();
            engine.put_down();
        }
    }
}

/// Does something; a panic is a failure.
pub(crate) fn guarded<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    catch_unwind(AssertUnwindSafe(work))
        .unwrap_or_else(|panic| Err(Failure::Panicked(words_of(&*panic))))
}

fn words_of(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("a panic").to_owned()
}

impl Told {
    pub(crate) fn of(failure: &Failure, language: Language) -> Self {
        let plain =
            |class, message: &str| Self { class, message: message.to_owned(), faults: Vec::new() };
        match failure {
            Failure::Engine(error) => {
                let english = (language == Language::English).then(|| error.in_english());
                let faults = json::faults(english.as_deref().unwrap_or(&**error));
                let message = match (&**error, &faults[..]) {
                    (Error::Request(_) | Error::Misheard(_), _) => error.say(language),
                    (_, [one]) => one["message"].as_str().unwrap_or_default().to_owned(),
                    _ => english.map_or_else(|| error.to_string(), |english| english.to_string()),
                };
                let class = if error.is_input() { "InputError" } else { "MachineError" };
                Self { class, message, faults }
            }
            Failure::Closed => plain("InputError", "the engine was closed; open it anew"),
            Failure::Broken => plain(
                "MachineError",
                "a fault of the program broke the engine off while it wrote; open it anew",
            ),
            Failure::Panicked(why) => {
                plain("MachineError", &format!("a fault of the program itself: {why}"))
            }
            Failure::Busy => plain(
                "InputError",
                "the robot is under way; wait for that task's result, or cancel it",
            ),
            Failure::Value(why) => plain("InputError", why),
        }
    }

    /// As an exception of `orthoframe.errors`.
    pub(crate) fn raised(&self, py: Python<'_>) -> PyErr {
        let made = || {
            let faults = self.faults.iter().map(|fault| to_python(py, fault));
            let faults = faults.collect::<PyResult<Vec<_>>>()?;
            let class = py.import("orthoframe.errors")?.getattr(self.class)?;
            class.call1((&self.message, faults))
        };
        match made() {
            Ok(exception) => PyErr::from_value(exception),
            Err(error) => error,
        }
    }
}

/// So long is waited before it is looked whether Ctrl-C was pressed.
pub(crate) const GLANCE: std::time::Duration = std::time::Duration::from_millis(50);
