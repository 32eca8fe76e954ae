//! What is planned, waits, is driven and has ended, and who drives.
//!
//! **Invariant.** The tasks that wait stand here in the order in which they are done, what was begun first; the store has
//! those of them that mean the same alone, in the same order. None begins before somebody of this run of the program has said so.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Weak;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::engine::{Dialogue, Queue, QueuedTask, State, json as views};
use crate::robot::Answer;
use crate::store::Timestamp;
use crate::units::{InOrder as _, Stop};

use super::gate::{Role, Session};

/// So many tasks that ended are remembered, and so many plans that wait for a word.
const REMEMBERED: usize = 50;
/// How long whoever drives may be silent.
const LEASE: Duration = Duration::from_secs(120);

/// A task that is known here.
#[derive(Debug)]
pub(super) struct Task {
    pub(super) id: u64,
    pub(super) text: String,
    pub(super) by: Session,
    /// As it was before the line; none for one that an earlier run of the program left.
    pub(super) before: Option<Dialogue>,
    /// Of the state for which the plan was made.
    pub(super) revision: u64,
    pub(super) state: Weak<State>,
    /// None of a task that came without one: it is made when its turn comes.
    pub(super) plan: Value,
    /// This plan was agreed to and no other: where the world turns out to differ, the robot stops.
    pub(super) is_strict: bool,
    /// As the store has it; none for one that means something only after what was said before.
    pub(super) noted: Option<QueuedTask>,
    /// It begins when its turn comes.
    pub(super) is_released: bool,
    /// It stood behind others, or was broken off: what is to be brought is brought to where the robot stood when it was given.
    pub(super) has_waited: bool,
}

impl Task {
    /// One that the store kept.
    pub(super) fn kept(id: u64, noted: QueuedTask) -> Self {
        Self {
            id,
            text: noted.text.clone(),
            by: Session::of(0, Role::Drive, &noted.by),
            before: None,
            revision: 0,
            state: Weak::new(),
            plan: Value::Null,
            is_strict: false,
            noted: Some(noted),
            is_released: false,
            has_waited: true,
        }
    }

    pub(super) fn is_begun(&self) -> bool {
        self.noted.as_ref().is_some_and(|noted| noted.is_begun)
    }

    pub(super) fn view(&self, state: &str) -> Value {
        let view = views::TaskView {
            task: self.id,
            text: &self.text,
            by: &self.by.name,
            state,
            revision: self.revision,
            plan: &self.plan,
            is_begun: self.is_begun(),
            is_released: self.is_released,
            is_kept: self.noted.is_some(),
            at: self.noted.as_ref().map(|noted| noted.at.to_string()),
        };
        view.to_json()
    }
}

#[derive(Debug)]
pub(super) struct Running {
    pub(super) id: u64,
    pub(super) view: Value,
    pub(super) stop: Stop,
    pub(super) why: Option<String>,
    pub(super) noted: Option<QueuedTask>,
    /// It is not to be gone on with.
    pub(super) is_dropped: bool,
    /// What was said of what bars its way; `barred` in its view is the question.
    pub(super) answer: Option<Answer>,
}

#[derive(Debug, Clone)]
struct Lease {
    holder: Session,
    until: Instant,
}

/// Somebody else drives.
#[derive(Debug)]
pub(super) struct Leased {
    pub(super) holder: String,
    pub(super) seconds: u64,
}

#[derive(Debug, Default)]
pub(super) struct Book {
    next: u64,
    pub(super) talks: BTreeMap<u64, Dialogue>,
    planned: BTreeMap<u64, Task>,
    pub(super) queue: VecDeque<Task>,
    /// The numbers of the tasks that the store had when it was looked last.
    stored: BTreeSet<u32>,
    pub(super) running: Option<Running>,
    ended: VecDeque<Value>,
    lease: Option<Lease>,
    pub(super) paused: Option<Timestamp>,
    pub(super) is_over: bool,
}

/// Plans that wait for a word, and tasks that wait for their turn.
impl Book {
    /// What an earlier run of the program left to be done.
    pub(super) fn kept(queue: Queue) -> Self {
        let mut book = Self { paused: queue.paused, ..Self::default() };
        book.stands(&queue);
        for noted in queue.tasks {
            let id = book.next_id();
            book.queue.push_back(Task::kept(id, noted));
        }
        book
    }

    pub(super) fn next_id(&mut self) -> u64 {
        self.next += 1;
        self.next
    }

    /// What the store is to have.
    pub(super) fn noted(&self) -> Queue {
        let running = self.running.as_ref().and_then(|running| running.noted.clone());
        let waiting = self.queue.iter().filter_map(|task| task.noted.clone());
        Queue { tasks: running.into_iter().chain(waiting).collect(), paused: self.paused }
    }

    /// This is what the store has.
    pub(super) fn stands(&mut self, queue: &Queue) {
        self.stored = queue.tasks.iter().map(|task| task.id).collect();
    }

    /// Takes over what another program made of the tasks that wait: theirs wait here, too, and what they dropped does not.
    /// A pause holds, whoever asked for it. Whether anything changed.
    pub(super) fn adopt(&mut self, queue: &Queue) -> bool {
        let (waited, before) = (self.queue.len(), self.paused);
        let there: BTreeSet<u32> = queue.tasks.iter().map(|task| task.id).collect();
        let is_gone = |id: u32| self.stored.contains(&id) && !there.contains(&id);
        self.queue.retain(|task| task.noted.as_ref().is_none_or(|noted| !is_gone(noted.id)));
        let left = self.queue.len();
        let here = self.noted().tasks;
        let new = queue.tasks.iter().filter(|task| !self.stored.contains(&task.id));
        let new: Vec<_> =
            new.filter(|task| here.iter().all(|t| t.id != task.id)).cloned().collect();
        for noted in new {
            let id = self.next_id();
            self.queue.push_back(Task::kept(id, noted));
        }
        self.stored = there;
        self.paused = self.paused.or(queue.paused);
        waited != left || left != self.queue.len() || before != self.paused
    }

    pub(super) fn propose(&mut self, task: Task) {
        self.planned.insert(task.id, task);
        while self.planned.len() > REMEMBERED {
            self.planned.pop_first();
        }
    }

    pub(super) fn planned(&self, id: u64) -> Option<&Task> {
        self.planned.get(&id)
    }

    pub(super) fn take_planned(&mut self, id: u64) -> Option<Task> {
        self.planned.remove(&id)
    }

    /// Has a task wait: one that was begun before all others.
    pub(super) fn wait(&mut self, task: Task) {
        // What stood in the store before it stood here may have been taken for another program's.
        if let Some(noted) = &task.noted {
            let is_it = |other: &Task| other.noted.as_ref().is_some_and(|o| o.id == noted.id);
            self.queue.retain(|other| !is_it(other));
        }
        match task.is_begun() {
            true => self.queue.push_front(task),
            false => self.queue.push_back(task),
        }
    }

    /// The next that may begin.
    pub(super) fn take_next(&mut self) -> Option<Task> {
        if self.paused.is_some() {
            return None;
        }
        let at = self.queue.iter().position(|task| task.is_released)?;
        self.queue.remove(at)
    }

    /// Nothing more begins by itself.
    pub(super) fn hold(&mut self) {
        self.queue.iter_mut().for_each(|task| (task.is_released, task.has_waited) = (false, true));
    }

    /// Lets all that waits begin in its turn, or one alone; how many those are.
    pub(super) fn release(&mut self, only: Option<u64>) -> usize {
        self.paused = None;
        let all = self.queue.iter_mut().filter(|task| only.is_none_or(|id| id == task.id));
        all.map(|task| task.is_released = true).count()
    }

    /// Whether anything is to begin.
    pub(super) fn is_busy(&self) -> bool {
        self.running.is_some() || self.queue.iter().any(|task| task.is_released)
    }

    pub(super) fn take_waiting(&mut self, id: u64) -> Option<Task> {
        let at = self.queue.iter().position(|task| task.id == id)?;
        self.queue.remove(at)
    }

    /// Puts a task that waits before another, or last. False where there is none.
    pub(super) fn reorder(&mut self, id: u64, before: Option<u64>) -> bool {
        let Some(task) = self.take_waiting(id) else { return false };
        let to = before.and_then(|before| self.queue.iter().position(|t| t.id == before));
        self.queue.insert(to.unwrap_or(self.queue.len()), task);
        true
    }

    /// Puts those that the store has into this order, by their numbers there; what it does not know stays behind them.
    pub(super) fn sort(&mut self, order: &[u32]) {
        let place = |task: &Task| {
            let number = task.noted.as_ref().map(|noted| noted.id);
            number.and_then(|n| order.iter().position(|o| *o == n)).unwrap_or(order.len())
        };
        self.queue.make_contiguous().order_by_key(place);
    }

    pub(super) fn end(&mut self, view: &Value) {
        self.ended.push_back(view.clone());
        if self.ended.len() > REMEMBERED {
            self.ended.pop_front();
        }
    }

    pub(super) fn waiting(&self) -> views::Waiting {
        let tasks = self.queue.iter().map(|task| task.view("queued")).collect();
        views::Waiting { tasks, paused: self.paused }
    }

    pub(super) fn view(&self) -> Value {
        let running = self.running.as_ref().map(|running| &running.view);
        views::tasks(running, &self.waiting(), self.ended.iter().cloned(), &self.lease_view())
    }
}

/// Who drives.
impl Book {
    /// Takes the lease, or keeps it; whether it changed hands.
    pub(super) fn lease(&mut self, session: &Session) -> Result<bool, Leased> {
        let now = Instant::now();
        if let Some(lease) = &self.lease
            && lease.until > now
            && lease.holder.number != session.number
        {
            let seconds = (lease.until - now).as_secs();
            return Err(Leased { holder: lease.holder.name.clone(), seconds });
        }
        let is_new = self.lease.as_ref().is_none_or(|l| l.holder.number != session.number);
        self.lease = Some(Lease { holder: session.clone(), until: now + LEASE });
        Ok(is_new)
    }

    /// Gives the lease back; whether one had it.
    pub(super) fn give_back(&mut self, session: &Session) -> bool {
        let is_ours = self.lease.as_ref().is_some_and(|l| l.holder.number == session.number);
        if is_ours {
            self.lease = None;
        }
        is_ours
    }

    /// Whether somebody who drives is there.
    pub(super) fn is_leased(&self) -> bool {
        self.lease.as_ref().is_some_and(|lease| lease.until > Instant::now())
    }

    pub(super) fn lease_view(&self) -> Value {
        let now = Instant::now();
        let lease = self.lease.as_ref().filter(|lease| lease.until > now);
        lease.map_or(Value::Null, |lease| {
            let seconds = (lease.until - now).as_secs();
            views::lease(&lease.holder.name, lease.holder.number, seconds)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noted(id: u32, is_begun: bool) -> QueuedTask {
        let (text, by) = (format!("задание {id}"), "оператор".to_owned());
        QueuedTask { id, text, by, at: Timestamp(7), from: None, is_begun }
    }

    fn order(book: &Book) -> Vec<u64> {
        book.queue.iter().map(|task| task.id).collect()
    }

    #[test]
    fn what_was_left_waits_in_its_order_and_begins_only_when_somebody_says_so() {
        let tasks = vec![noted(4, true), noted(2, false), noted(9, false)];
        let left = Queue { tasks, paused: Some(Timestamp(3)) };
        let mut book = Book::kept(left.clone());
        assert_eq!(book.noted(), left);
        assert!(book.take_next().is_none() && !book.is_busy());
        assert!(book.reorder(3, Some(2)) && !book.reorder(8, None));
        assert_eq!(order(&book), [1, 3, 2]);
        book.sort(&[9, 2, 4]);
        assert_eq!(order(&book), [3, 2, 1]);
        assert_eq!(book.release(Some(2)), 1);
        assert_eq!(book.take_next().map(|task| task.id), Some(2));
        assert!(book.take_next().is_none());
        assert_eq!(book.release(None), 2);
        book.hold();
        assert!(book.take_next().is_none());
        // What is broken off comes first again.
        let mut task = Task::kept(7, noted(11, true));
        task.is_released = true;
        book.wait(task);
        assert_eq!(order(&book), [7, 3, 1]);
        assert_eq!(book.noted().tasks.iter().map(|t| t.id).collect::<Vec<_>>(), [11, 9, 4]);
        book.paused = Some(Timestamp(5));
        assert!(book.take_next().is_none());
    }
}
