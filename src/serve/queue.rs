//! What becomes of tasks before and between their drives: confirmed, put off, put in order, held, gone on with, dropped.
//!
//! **Invariant.** What is changed here stands in the store before the one who asked is answered.

use std::sync::Arc;

use serde_json::Value;

use crate::engine::{Dialogue, Error, Waiting, json as views, queue_in_words, waiting};
use crate::units::{Language, told};

use super::book::Task;
use super::drive::{Declined, Tasks};
use super::gate::{Role, Session};
use crate::engine::rehearsal::{Line, is_same_plan, rehearse};

impl Tasks {
    /// Says yes to a plan: it is driven when those before it are done.
    ///
    /// # Errors
    /// See [`Declined`].
    pub(super) fn confirm(&self, session: &Session, id: u64) -> Result<Value, Declined> {
        self.begin_when_its_turn_comes(session, id, false)
    }

    /// The same for a plan to which nothing may be added: the robot stands, and nothing waits.
    ///
    /// # Errors
    /// See [`Declined`].
    pub(super) fn confirm_alone(&self, session: &Session, id: u64) -> Result<Value, Declined> {
        self.begin_when_its_turn_comes(session, id, true)
    }

    fn begin_when_its_turn_comes(
        &self,
        session: &Session,
        id: u64,
        is_strict: bool,
    ) -> Result<Value, Declined> {
        self.lease(session)?;
        let Some(mut task) = self.book().take_planned(id) else { return Err(Declined::Unknown) };
        // A person may have thought it over for long.
        let _ = self.desk.fresh_from_thread();
        let state = self.desk.state();
        let is_same_state = task.state.upgrade().is_some_and(|then| Arc::ptr_eq(&then, &state));
        let before = task.before.take().expect("a plan that waits for a word was heard here");
        if !is_same_state {
            // What was seen since need not change the map, and yet may change the plan.
            let again = rehearse(&state, &before, &Line::Said(&task.text));
            let again = again.map_err(|error| Declined::Failed(Box::new(error)))?;
            let is_same = again.plan.as_ref().is_some_and(|plan| is_same_plan(plan, &task.plan));
            if state.revision() != task.revision || !is_same {
                let text = task.text;
                let anew = |plan| self.propose(session, &text, before, plan, &state);
                let replies = again.replies;
                return Err(Declined::Expired { replies, task: again.plan.map(anew) });
            }
        }
        // What means something else alone, or nothing, could not be gone on with by another run of the program.
        let alone =
            rehearse(&state, &Dialogue::new(Language::of(&task.text)), &Line::Said(&task.text));
        let is_plain = alone.is_ok_and(|alone| {
            alone.plan.is_some_and(|plan| plan["more"] == 0 && is_same_plan(&plan, &task.plan))
        });
        task.before = Some(before);
        task.is_strict = is_strict;
        if is_strict && self.book().is_busy() {
            self.book().propose(task);
            return Err(Declined::Busy);
        }
        if is_plain && !is_strict {
            let (text, by) = (task.text.clone(), session.name.clone());
            let noted = self.desk.ask_from_thread(move |engine| engine.enqueue(&text, &by));
            task.noted = noted.ok().and_then(Result::ok);
        }
        let view = {
            let mut book = self.book();
            task.has_waited = book.is_busy();
            let view = task.view("queued");
            book.wait(task);
            view
        };
        self.note(&session.name);
        self.wake.notify_all();
        Ok(view)
    }

    /// Drops a plan or a task that waits; one that is driven is stopped, and not gone on with. False where there is none.
    pub(super) fn cancel(&self, session: &Session, id: u64) -> bool {
        let is_running = {
            let mut book = self.book();
            let running = book.running.as_mut().filter(|running| running.id == id);
            running.map(|running| running.is_dropped = true).is_some()
        };
        if is_running {
            self.stop_for(id, &session.name);
            return true;
        }
        let dropped = {
            let mut book = self.book();
            let planned = book.take_planned(id).map(|task| task.view("declined"));
            planned.or_else(|| book.take_waiting(id).map(|task| task.view("cancelled")))
        };
        let Some(view) = dropped else { return false };
        self.end(&view);
        self.note(&session.name);
        true
    }

    /// Stops the robot at once. What waits begins no more by itself, and what is driven may be gone on with.
    pub(super) fn stop(&self, by: &str) -> bool {
        let is_running = {
            let mut book = self.book();
            book.hold();
            book.running.as_mut().is_some_and(|running| {
                running.stop.raise();
                running.why.get_or_insert_with(|| by.to_owned());
                true
            })
        };
        self.events.tell("stop", &views::stop_raised(by, is_running));
        self.note(by);
        is_running
    }

    /// Puts a task that waits before another, or last. False where there is none.
    pub(super) fn reorder(&self, session: &Session, id: u64, before: Option<u64>) -> bool {
        let is_moved = self.book().reorder(id, before);
        if is_moved {
            self.note(&session.name);
        }
        is_moved
    }

    /// Puts what waits in the order of the shortest way.
    ///
    /// # Errors
    /// There is no map.
    pub(super) fn sort(&self, session: &Session) -> Result<(), Error> {
        let tasks = self.book().noted().tasks;
        let order = self.desk.state().in_order(&tasks)?;
        self.book().sort(&order.iter().map(|task| task.id).collect::<Vec<_>>());
        self.note(&session.name);
        Ok(())
    }

    /// Holds what is driven, and lets nothing begin until somebody has it gone on with.
    pub(super) fn pause(&self, session: &Session) {
        self.book().paused = Some(std::time::SystemTime::now().into());
        self.stop(&session.name);
    }

    /// Goes on with all that waits, or with one task alone.
    ///
    /// # Errors
    /// [`Declined::Leased`], and [`Declined::Unknown`] where the one does not wait.
    pub(super) fn go_on(&self, session: &Session, only: Option<u64>) -> Result<(), Declined> {
        self.lease(session)?;
        let released = self.book().release(only);
        if only.is_some() && released == 0 {
            return Err(Declined::Unknown);
        }
        self.note(&session.name);
        self.wake.notify_all();
        Ok(())
    }

    /// Has an order wait until somebody has it begun.
    ///
    /// # Errors
    /// It is not understood by itself, or the disk refused.
    pub(super) fn later(&self, session: &Session, text: &str) -> Result<(), Error> {
        let (order, by) = (text.to_owned(), session.name.clone());
        let noted = self.desk.ask_from_thread(move |engine| engine.enqueue(&order, &by));
        let Ok(noted) = noted else { return Ok(()) };
        let task = {
            let mut book = self.book();
            Task::kept(book.next_id(), noted?)
        };
        self.book().wait(task);
        self.note(&session.name);
        Ok(())
    }

    /// Does what a line says of the tasks that wait; none where it is about something else.
    pub(super) fn of_queue(
        &self,
        session: &Session,
        line: &str,
        language: Language,
    ) -> Result<Option<Value>, Error> {
        let Some(said) = waiting(line) else { return Ok(None) };
        let words = Language::of(line);
        let language = if line.chars().any(char::is_alphabetic) { words } else { language };
        let tell = |outcome: &str, text: &str| {
            let reply = views::said(outcome, text, Some(language));
            Ok(Some(views::line(&[reply], self.desk.state().revision(), None, None)))
        };
        let ids: Vec<(u64, String)> = {
            let book = self.book();
            let running = book.running.as_ref();
            let running =
                running.map(|r| (r.id, r.view["text"].as_str().unwrap_or_default().to_owned()));
            let queued = book.queue.iter().map(|task| (task.id, task.text.clone()));
            running.into_iter().chain(queued).collect()
        };
        let drops = matches!(said, Waiting::Cancel(_) | Waiting::CancelAll);
        if drops && ids.is_empty() {
            return Ok(None);
        }
        if session.role < Role::Drive && !matches!(said, Waiting::Pause | Waiting::List) {
            let no = told!(language, "your-role-is-not-enough");
            return tell("refused", &no);
        }
        match said {
            Waiting::Pause => {
                self.pause(session);
                tell("paused", &told!(language, "paused-by-operator"))
            }
            Waiting::Resume => match self.go_on(session, None) {
                Ok(()) if ids.is_empty() => tell("queue", &told!(language, "nothing-is-waiting")),
                Ok(()) => tell("resumed", &told!(language, "i-go-on")),
                Err(Declined::Leased { holder, seconds }) => {
                    tell("refused", &told!(language, "drives-the-robot-s-more", holder, seconds))
                }
                Err(_) => Ok(None),
            },
            Waiting::List => {
                let queue = self.book().noted();
                tell("queue", &queue_in_words(&queue, language))
            }
            Waiting::Cancel(number) => {
                let at = match number {
                    Some(number) => number.checked_sub(1),
                    None => (ids.len() == 1).then_some(0),
                };
                let Some((id, text)) = at.and_then(|at| ids.get(at)) else {
                    return tell("refused", &told!(language, "which-task", ids = ids.len()));
                };
                self.cancel(session, *id);
                tell("cancelled", &told!(language, "cancelled", text))
            }
            Waiting::CancelAll => {
                let count = ids.iter().filter(|(id, _)| self.cancel(session, *id)).count();
                tell("cancelled", &told!(language, "cancelled-tasks", count))
            }
            Waiting::Add(order) => match self.later(session, order) {
                Ok(()) => tell("queued", &told!(language, "waiting", order)),
                Err(error) => tell("misheard", &error.say(language)),
            },
        }
    }
}
