//! A line carried out on a thread of its own: what happens is told as it happens, and it can be stopped from any thread.

use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant, SystemTime};

use orthoframe::engine::{Dialogue, Event, Outcome, Progress, Reply, TaskEvents, json};
use orthoframe::vehicle::{Address, Moment, Patience, RemoteVehicle};
use orthoframe::{Engine, Stop, Vehicle};
use pyo3::exceptions::PyTimeoutError;
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::desk::{Desk, Failure, GLANCE, Told, guarded};
use crate::dict::to_python;
use crate::vehicle::{Hears, Orders};

/// What came of it, once it came to an end.
type Ending = Option<Result<Value, Told>>;

/// An order under way, or done. Iterated, it tells what happens.
#[pyclass(frozen)]
#[derive(Debug)]
pub(crate) struct Task {
    events: Mutex<Receiver<Value>>,
    ended: Arc<(Mutex<Ending>, Condvar)>,
    stop: Stop,
}

/// What is to drive.
#[derive(Debug)]
pub(crate) enum Wheels {
    Simulated,
    /// A robot elsewhere: `cmd:…` or `tcp:…`.
    Elsewhere(Address),
    /// One written in Python.
    Python(Hears, Orders),
}

impl Task {
    /// Begins.
    ///
    /// # Errors
    /// The robot is under way, or there is no map.
    pub(crate) fn begin(
        desk: &Arc<Desk>,
        text: String,
        wheels: Wheels,
        patience: Patience,
        with_poses: bool,
    ) -> Result<Self, Failure> {
        let robot = desk.take_robot()?;
        desk.sets_out()?;
        let state = desk.state()?;
        let (tell, events) = channel();
        let ended = Arc::new((Mutex::new(None), Condvar::new()));
        let stop = Stop::new();
        let (at_end, stopped) = (Arc::clone(&ended), stop.clone());
        let (desk, of_desk) = (Arc::clone(desk), Arc::clone(desk));
        let drive = move || {
            let world = state.world()?.clone();
            let mut engine = Engine::beside(state);
            let mut dialogue = Dialogue::new(desk.language);
            dialogue.stopped_by(stopped);
            let vehicle: Option<Box<dyn Vehicle + Send>> = match wheels {
                Wheels::Simulated => None,
                Wheels::Elsewhere(at) => {
                    Some(Box::new(at.connect(&world, patience).map_err(Box::new)?))
                }
                Wheels::Python(hears, orders) => {
                    let robot = RemoteVehicle::over(hears, orders, &world, patience);
                    Some(Box::new(robot.map_err(Box::new)?))
                }
            };
            if let Some(vehicle) = vehicle {
                dialogue = dialogue.driving(vehicle);
            }
            let mut teller = Teller { tell, events: TaskEvents::default(), with_poses };
            let mut not_noted = None;
            let heard = dialogue.hear(&mut engine, &text, &mut |_, event| {
                teller.tell(event);
                if let Event::Replied(Reply { outcome: Outcome::Task(task), .. }) = event
                    && let Some(after) = &task.after
                {
                    let at = SystemTime::now().into();
                    let noted = desk.write(|engine| Ok(engine.remember_after(after, at)?));
                    not_noted = not_noted.take().or(noted.err());
                }
            })?;
            if let Some(failure) = not_noted {
                return Err(failure);
            }
            let worst = heard.replies.iter().find(|reply| reply.outcome.has_failed());
            let outcome = worst.or(heard.replies.last()).map_or("done", |r| r.outcome.word());
            let replies = json::heard(&engine, &heard)?;
            Ok(json!({ "outcome": outcome, "text": heard.text(), "replies": replies }))
        };
        std::thread::Builder::new()
            .name("orthoframe task".to_owned())
            .spawn(move || {
                let came = guarded(drive).map_err(|failure| of_desk.tell(&failure));
                // Whoever waits for the end may send the robot anew at once.
                drop(robot);
                let (ending, is_over) = &*at_end;
                *ending.lock().unwrap_or_else(PoisonError::into_inner) = Some(came);
                is_over.notify_all();
            })
            .map_err(|error| Failure::Panicked(error.to_string()))?;
        Ok(Self { events: Mutex::new(events), ended, stop })
    }

    fn wait(&self, until: Option<Instant>) -> Ending {
        let (ending, is_over) = &*self.ended;
        let ending = ending.lock().unwrap_or_else(PoisonError::into_inner);
        let left = until
            .map_or(GLANCE, |until| until.saturating_duration_since(Instant::now()).min(GLANCE));
        let (ending, _) = is_over
            .wait_timeout_while(ending, left, |ending| ending.is_none())
            .unwrap_or_else(PoisonError::into_inner);
        ending.clone()
    }
}

/// Makes events of what happens.
struct Teller {
    tell: Sender<Value>,
    events: TaskEvents,
    with_poses: bool,
}

impl Teller {
    fn tell(&mut self, event: &Event<'_>) {
        let told = match event {
            Event::Progress { progress: Progress::Moved(moment), world, .. } if self.with_poses => {
                let Moment { time, map, pose } = **moment;
                Some(json!({
                    "event": "moved",
                    "time": time,
                    "map": world.maps.get(&map).map(|map| &map.name),
                    "x": pose.at.x,
                    "y": pose.at.y,
                    "heading_deg": pose.heading.get(),
                }))
            }
            Event::Progress { progress, world, .. } => self.events.of(world, progress),
            Event::Replied(reply) => Some(json!({
                "event": "replied", "outcome": reply.outcome.word(), "text": reply.text,
            })),
            _ => None,
        };
        if let Some(told) = told {
            // Who holds the task no more need not be told.
            let _ = self.tell.send(told);
        }
    }
}

#[pymethods]
impl Task {
    fn __iter__(this: PyRef<'_, Self>) -> PyRef<'_, Self> {
        this
    }

    /// The next event; waits for it.
    fn __next__<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        loop {
            let got = py.detach(|| {
                let events = self.events.lock().unwrap_or_else(PoisonError::into_inner);
                events.recv_timeout(GLANCE)
            });
            match got {
                Ok(event) => return to_python(py, &event).map(Some),
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
                Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            }
        }
    }

    /// Stops the robot at once; may be called from any thread, and more than once.
    fn cancel(&self) {
        self.stop.raise();
    }

    /// Whether it came to an end.
    #[getter]
    fn done(&self) -> bool {
        self.ended.0.lock().unwrap_or_else(PoisonError::into_inner).is_some()
    }

    /// What it came to; waits for so many seconds, for ever without a number.
    #[pyo3(signature = (timeout=None))]
    fn result<'py>(&self, py: Python<'py>, timeout: Option<f64>) -> PyResult<Bound<'py, PyAny>> {
        let until = timeout
            .and_then(|seconds| Duration::try_from_secs_f64(seconds.max(0.0)).ok())
            .and_then(|whole| Instant::now().checked_add(whole));
        loop {
            match py.detach(|| self.wait(until)) {
                Some(Ok(value)) => return to_python(py, &value),
                Some(Err(told)) => return Err(told.raised(py)),
                None => py.check_signals()?,
            }
            if until.is_some_and(|until| Instant::now() >= until) {
                return Err(PyTimeoutError::new_err("the task is still under way"));
            }
        }
    }
}
