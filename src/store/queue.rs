//! The tasks that are to be done, in their order: they outlive the process that was to do them.
//!
//! Invariant: the queue is written whole, in one transaction, before anything of it is begun; what was begun stays in it
//! until it has ended.

use super::cell::Key;
use super::edits::Draft;
use super::error::Result;
use super::keep::Store;
use super::observe::ROBOT;
use super::reader::Reader;
use super::tables::{self as t, Record, Table};
use crate::units::{MapId, Point, Timestamp};

const BEGUN: &str = "begun";
const WAITING: &str = "waiting";

/// A task in the words in which it was given.
#[derive(Debug, Clone, PartialEq)]
pub struct QueuedTask {
    /// Of all that ever waited at the same time no two have the same.
    pub id: u32,
    pub text: String,
    pub by: String,
    pub at: Timestamp,
    /// Where the person stood who gave it, in the Map's frame, cm: there is brought what is to be brought.
    pub from: Option<(MapId, Point)>,
    /// Whether it was being done when it was noted last.
    pub is_begun: bool,
}

/// What is to be done.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Queue {
    pub tasks: Vec<QueuedTask>,
    /// Nothing of it is begun until somebody says so; since when.
    pub paused: Option<Timestamp>,
}

impl Reader {
    /// The tasks that are to be done.
    ///
    /// # Errors
    /// [`BadRecord`](super::StoreError::BadRecord) when a record is broken.
    pub fn queue(&self) -> Result<Queue> {
        let task = |r: t::Tasks| QueuedTask {
            id: r.task_id,
            text: r.text,
            by: r.by,
            at: Timestamp(r.at),
            from: r.map_id.map(|map| (MapId(map), Point::new(r.x, r.y))),
            is_begun: r.state == BEGUN,
        };
        let tasks = self.records::<t::Tasks>(&Key::new())?.into_iter().map(task).collect();
        let pause = self.records::<t::Pause>(&Key::new())?.into_iter().next();
        Ok(Queue { tasks, paused: pause.map(|r| Timestamp(r.at)) })
    }
}

impl Store {
    /// Puts tasks in the place of those that were noted before. The map and its revision stay as they are.
    ///
    /// # Errors
    /// [`ReadOnly`](super::StoreError::ReadOnly), [`Io`](super::StoreError::Io).
    pub fn put_queue(&mut self, queue: &Queue, user: &str, now: Timestamp) -> Result<()> {
        let stamp = self.stamp(user, now);
        let mut draft = Draft::default();
        for (no, task) in (0..).zip(&queue.tasks) {
            let (x, y) = task.from.map_or((0.0, 0.0), |(_, at)| (at.x, at.y));
            let record = t::Tasks {
                no,
                task_id: task.id,
                text: task.text.clone(),
                by: task.by.clone(),
                at: task.at.0,
                state: if task.is_begun { BEGUN } else { WAITING }.to_owned(),
                map_id: task.from.map(|(map, _)| map.0),
                x,
                y,
            };
            self.put_log(&mut draft, &record, &stamp)?;
        }
        let stale = |row: &[super::Cell]| {
            t::Tasks::from_row(row).is_none_or(|r| r.no as usize >= queue.tasks.len())
        };
        self.drop_all(Table::Tasks, stale, &mut draft, &stamp)?;
        match queue.paused {
            Some(at) => {
                self.put_log(&mut draft, &t::Pause { robot_id: ROBOT, at: at.0 }, &stamp)?;
            }
            None => self.drop_all(Table::Pause, |_| true, &mut draft, &stamp)?,
        }
        self.commit_log(draft)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn task(id: u32, text: &str, is_begun: bool) -> QueuedTask {
        let from = is_begun.then_some((MapId(id), Point::new(1.5, -2.0)));
        QueuedTask {
            id,
            text: text.to_owned(),
            by: "op".to_owned(),
            at: Timestamp(7),
            from,
            is_begun,
        }
    }

    #[test]
    fn the_queue_is_what_was_put_last() {
        let dir = tempfile::tempdir().expect("a directory");
        let path = dir.path().join("store");
        let queues = [
            Queue { tasks: vec![task(1, "а", true), task(2, "b", false)], paused: None },
            Queue { tasks: vec![task(2, "b", false)], paused: Some(Timestamp(9)) },
            Queue {
                tasks: vec![task(4, "d", false), task(2, "b", true), task(5, "e", false)],
                paused: Some(Timestamp(11)),
            },
            Queue::default(),
        ];
        for (n, queue) in queues.iter().enumerate() {
            let (mut store, _) = Store::open(&path).expect("opens");
            if n > 0 {
                assert_eq!(store.reader().queue().expect("reads"), queues[n - 1]);
            }
            store.put_queue(queue, "op", Timestamp(20)).expect("writes");
            assert_eq!(store.reader().queue().expect("reads"), *queue);
        }
    }
}
