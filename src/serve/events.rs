//! What happens, told to all who listen: numbered, so that whoever was cut off hears what was missed.
//!
//! **Invariant.** Events are numbered without gaps from the program's start; an id names the start too, so that one of
//! another run is never taken for one of this. Where the robot is has no number: only the newest counts.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use axum::response::sse;
use futures_util::Stream;
use futures_util::stream;
use serde_json::{Value, json};
use tokio::sync::watch;

/// So many events are kept for those who were cut off, and so many bytes of what they tell; the newest always.
const KEPT: usize = 4096;
const KEPT_BYTES: usize = 2 << 20;
/// Of silence, until a word is said that the line stands.
const HELLO: Duration = Duration::from_secs(5);

#[derive(Debug, Clone)]
struct Happened {
    number: u64,
    kind: &'static str,
    data: String,
}

/// The newest events, as many as there is room for.
#[derive(Debug, Default)]
struct Kept {
    events: VecDeque<Happened>,
    bytes: usize,
}

impl Kept {
    fn push(&mut self, happened: Happened) {
        self.bytes += happened.data.len();
        self.events.push_back(happened);
        while self.events.len() > 1 && (self.events.len() > KEPT || self.bytes > KEPT_BYTES) {
            self.bytes -= self.events.pop_front().map_or(0, |first| first.data.len());
        }
    }
}

/// All that happened, and who is told of it.
#[derive(Debug)]
pub(super) struct Events {
    /// Of this run of the program.
    run: String,
    kept: Mutex<Kept>,
    last: watch::Sender<u64>,
    robot: watch::Sender<Value>,
}

impl Events {
    #[must_use]
    pub(super) fn new(run: &str) -> Self {
        Self {
            run: run.to_owned(),
            kept: Mutex::default(),
            last: watch::Sender::new(0),
            robot: watch::Sender::new(Value::Null),
        }
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Tells all who listen.
    pub(super) fn tell(&self, kind: &'static str, data: &Value) {
        let number = {
            let mut kept = self.kept();
            let number = *self.last.borrow() + 1;
            kept.push(Happened { number, kind, data: data.to_string() });
            self.last.send_replace(number);
            number
        };
        tracing::trace!(number, kind, "told");
    }

    /// Tells where the robot is; who is slow hears only the last.
    pub(super) fn robot_is(&self, data: Value) {
        self.robot.send_replace(data);
    }

    /// Whether anybody listens.
    #[must_use]
    pub(super) fn is_heard(&self) -> bool {
        self.robot.receiver_count() > 0
    }

    /// Where the robot was last told to be, while it drives.
    #[must_use]
    pub(super) fn robot(&self) -> Value {
        self.robot.borrow().clone()
    }

    /// The id of the last event.
    #[must_use]
    pub(super) fn last_id(&self) -> String {
        self.id(*self.last.borrow())
    }

    fn id(&self, number: u64) -> String {
        format!("{}-{number}", self.run)
    }

    /// The number that an id of this run names.
    fn number(&self, id: &str) -> Option<u64> {
        let (run, number) = id.rsplit_once('-')?;
        let number = number.parse().ok()?;
        (run == self.run && number <= *self.last.borrow()).then_some(number)
    }

    /// What has happened since, and whether all of it is still known.
    fn since(&self, number: u64) -> Option<Vec<Happened>> {
        let kept = self.kept();
        let first = kept.events.front().map_or(number + 1, |first| first.number);
        (first <= number + 1)
            .then(|| kept.events.iter().filter(|h| h.number > number).cloned().collect())
    }
}

/// Up to where one who listens within the program has heard.
#[derive(Debug)]
pub(super) struct Hearing {
    number: u64,
    last: watch::Receiver<u64>,
}

impl Events {
    /// Begins to listen: to what is told from now on.
    #[must_use]
    pub(super) fn listen(&self) -> Hearing {
        let mut last = self.last.subscribe();
        let number = *last.borrow_and_update();
        Hearing { number, last }
    }

    /// Waits until something is told: kinds and data, in order. What was forgotten meanwhile is left out.
    pub(super) async fn next(&self, hearing: &mut Hearing) -> Vec<(&'static str, String)> {
        // The sender lives as long as the events.
        let _ = hearing.last.changed().await;
        let now = *hearing.last.borrow_and_update();
        let happened = self
            .since(hearing.number)
            .unwrap_or_else(|| self.kept().events.iter().cloned().collect());
        hearing.number = now;
        let until_now = happened.into_iter().filter(|h| h.number <= now);
        until_now.map(|h| (h.kind, h.data)).collect()
    }
}

/// What one listener was told so far.
struct Listener<E> {
    events: E,
    number: u64,
    last: watch::Receiver<u64>,
    robot: watch::Receiver<Value>,
    ready: VecDeque<sse::Event>,
}

/// What happens from now on; after `last_id`, where that is told, or first a `gap` where it is not known any more.
pub(super) fn stream<E>(
    events: E,
    last_id: Option<&str>,
) -> impl Stream<Item = Result<sse::Event, Infallible>> + use<E>
where
    E: std::ops::Deref<Target = Events>,
{
    let (mut last, mut robot) = (events.last.subscribe(), events.robot.subscribe());
    let now = *last.borrow_and_update();
    let mut ready = VecDeque::new();
    let known = last_id.map(|id| events.number(id).filter(|n| events.since(*n).is_some()));
    let number = match known {
        None => now,
        Some(Some(number)) => number,
        Some(None) => {
            let data = json!({ "event": events.id(now) }).to_string();
            ready.push_back(sse::Event::default().id(events.id(now)).event("gap").data(data));
            now
        }
    };
    ready.push_back(hello(&events));
    let is_driving = !robot.borrow_and_update().is_null();
    if is_driving {
        robot.mark_changed();
    }
    if number < now {
        last.mark_changed();
    }
    let listener = Listener { events, number, last, robot, ready };
    stream::unfold(listener, |mut listener| async move {
        loop {
            if let Some(event) = listener.ready.pop_front() {
                return Some((Ok(event), listener));
            }
            tokio::select! {
                changed = listener.last.changed() => {
                    changed.ok()?;
                    listener.catch_up();
                }
                changed = listener.robot.changed() => {
                    changed.ok()?;
                    let data = listener.robot.borrow_and_update().to_string();
                    listener.ready.push_back(sse::Event::default().event("robot").data(data));
                }
                () = tokio::time::sleep(HELLO) => listener.ready.push_back(hello(&listener.events)),
            }
        }
    })
}

fn hello(events: &Events) -> sse::Event {
    let data = json!({ "event": events.last_id() }).to_string();
    sse::Event::default().event("hello").data(data)
}

impl<E: std::ops::Deref<Target = Events>> Listener<E> {
    fn catch_up(&mut self) {
        let now = *self.last.borrow_and_update();
        match self.events.since(self.number) {
            Some(happened) => {
                for Happened { number, kind, data } in happened {
                    self.number = number;
                    let event = sse::Event::default().id(self.events.id(number));
                    self.ready.push_back(event.event(kind).data(data));
                }
            }
            // Too slow: what was to be told is forgotten already.
            None => {
                self.number = now;
                let id = self.events.id(now);
                let data = json!({ "event": id }).to_string();
                self.ready.push_back(sse::Event::default().id(id).event("gap").data(data));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_missed_is_known_and_what_is_forgotten_is_owned_up_to() {
        let events = Events::new("a");
        for number in 0..3 {
            events.tell("task", &json!(number));
        }
        let numbers = |since| {
            let since: Option<Vec<Happened>> = events.since(since);
            since.map(|all| all.iter().map(|h| h.number).collect::<Vec<_>>())
        };
        assert_eq!(numbers(1), Some(vec![2, 3]));
        assert_eq!(numbers(3), Some(vec![]));
        assert_eq!(events.number("a-2"), Some(2));
        for foreign in ["b-2", "a-4", "a-", "2", ""] {
            assert_eq!(events.number(foreign), None, "{foreign}");
        }
        for number in 0..KEPT {
            events.tell("task", &json!(number));
        }
        assert_eq!(events.since(2).map(|all| all.len()), None);
        assert_eq!(events.since(3).map(|all| all.len()), Some(KEPT));
    }

    /// An event of any size is told; what is kept of earlier ones has its bound.
    #[test]
    fn what_is_kept_has_a_bound_in_bytes() {
        let events = Events::new("a");
        for length in [KEPT_BYTES / 2, KEPT_BYTES / 3, KEPT_BYTES / 3, 2 * KEPT_BYTES, 3, 5] {
            let newest = *events.last.borrow();
            events.tell("task", &json!("x".repeat(length)));
            assert_eq!(events.since(newest).map(|all| all.len()), Some(1), "{length}");
            let kept = events.kept();
            assert_eq!(kept.bytes, kept.events.iter().map(|h| h.data.len()).sum::<usize>());
            assert!(kept.bytes <= KEPT_BYTES || kept.events.len() == 1, "{length}");
        }
        assert_eq!(events.kept().events.len(), 2);
    }
}
