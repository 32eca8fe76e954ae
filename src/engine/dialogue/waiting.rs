//! Orders that wait: paused, gone on with, told, dropped.

use crate::engine::queue::numbered;
use crate::engine::task::OPERATOR;
use crate::engine::{Error, Queue, TaskEnding};
use crate::language::Language;
use crate::language::command::{Command, Waiting};
use crate::language::question::Memory;
use crate::map::Entity;
use crate::units::told;

use super::{Given, Hearing, Outcome};

impl Hearing<'_, '_> {
    /// Does what a line says of the orders that wait; whether it was about them: "cancel" drops what was offered, if
    /// anything was, and is about nothing where nothing waits.
    pub(super) fn of_waiting(
        &mut self,
        said: Waiting<'_>,
        awaited: bool,
        language: Language,
    ) -> Result<bool, Error> {
        let queue = self.engine.queue()?;
        let drops = matches!(said, Waiting::Cancel(_) | Waiting::CancelAll);
        if drops && (queue.tasks.is_empty() || awaited) {
            return Ok(false);
        }
        match said {
            Waiting::Pause => {
                self.engine.pause_queue(true, OPERATOR)?;
                let text = told!(language, "paused-until");
                self.put(Outcome::Paused, &text, language)?;
            }
            Waiting::Resume => self.go_on(language)?,
            Waiting::List => {
                let text = queue_in_words(&queue, language);
                self.put(Outcome::Waits(queue), &text, language)?;
            }
            Waiting::Cancel(number) => {
                let dropped = match numbered(&queue, number) {
                    Ok(id) => id,
                    Err(error) => {
                        self.refuse(error.into(), language)?;
                        return Ok(true);
                    }
                };
                self.engine.drop_queued(dropped, OPERATOR)?;
                let text =
                    queue.tasks.iter().find(|task| task.id == dropped).map(|t| t.text.as_str());
                let text = text.unwrap_or_default();
                let text = told!(language, "cancelled", text);
                self.put(Outcome::Cancelled { tasks: vec![dropped] }, &text, language)?;
            }
            Waiting::CancelAll => {
                let tasks: Vec<u32> = queue.tasks.iter().map(|task| task.id).collect();
                self.engine.put_queue(Queue { tasks: Vec::new(), ..queue }, OPERATOR)?;
                let text = told!(language, "cancelled-tasks-tasks", tasks = tasks.len());
                self.put(Outcome::Cancelled { tasks }, &text, language)?;
            }
            Waiting::Add(order) => self.wait(order, language)?,
        }
        Ok(true)
    }

    pub(super) fn is_paused(&self) -> Result<bool, Error> {
        Ok(self.dialogue.keeps && self.engine.queue()?.paused.is_some())
    }

    /// Has an order wait.
    pub(super) fn wait(&mut self, order: &str, language: Language) -> Result<(), Error> {
        match self.engine.enqueue(order, OPERATOR) {
            Ok(task) => {
                let waiting = self.engine.queue()?.tasks.len();
                let text = told!(language, "waiting-in-all", order, waiting);
                self.put(Outcome::Queued { task: task.id }, &text, language)
            }
            Err(error) => self.refuse(error, language),
        }
    }

    /// Notes an order that is begun now, so that it is gone on with should this process end; its number. None for one that
    /// means something only after what was said before.
    pub(super) fn note(
        &mut self,
        line: &str,
        commands: &[Command<Entity>],
    ) -> Result<Option<u32>, Error> {
        if !self.dialogue.keeps || !self.engine.is_kept() {
            return Ok(None);
        }
        let alone = self.engine.understand_in(line, &mut Memory::default());
        if alone.is_ok_and(|alone| alone == commands) {
            let mut queue = self.engine.queue()?;
            let Ok(mut task) = self.engine.queued(line, OPERATOR, &queue) else { return Ok(None) };
            task.is_begun = true;
            let id = task.id;
            queue.tasks.insert(0, task);
            self.engine.put_queue(queue, OPERATOR)?;
            return Ok(Some(id));
        }
        Ok(None)
    }

    /// Does what waits, one after the other; what was begun first. Where the robot is stopped, or fails, the rest waits on.
    pub(super) fn go_on(&mut self, language: Language) -> Result<(), Error> {
        self.engine.pause_queue(false, OPERATOR)?;
        if self.engine.queue()?.tasks.is_empty() {
            let text = queue_in_words(&Queue::default(), language);
            return self.put(Outcome::Waits(Queue::default()), &text, language);
        }
        loop {
            let mut queue = self.engine.queue()?;
            let Some(next) = self.engine.in_order(&queue.tasks)?.into_iter().next() else {
                return Ok(());
            };
            let at = queue.tasks.iter().position(|task| task.id == next.id).unwrap_or_default();
            let mut task = queue.tasks.remove(at);
            task.is_begun = true;
            queue.tasks.insert(0, task.clone());
            if self.dialogue.keeps {
                self.engine.put_queue(queue, OPERATOR)?;
            }
            let (id, text) = (task.id, task.text.clone());
            let spoken = Language::of(&text);
            let begun = told!(spoken, "i-begin", text);
            (self.tell)(self.engine, &super::Event::Ordered(&text));
            self.put(Outcome::Begun { task: id }, &begun, spoken)?;
            match self.engine.understand_in(&text, &mut Memory::default()) {
                Ok(commands) => self.carry_out(&text, &commands, &Given::Before(task), spoken)?,
                Err(error) => self.refuse(error, spoken)?,
            }
            let last = self.heard.replies.last().map(|reply| &reply.outcome);
            if let Some(Outcome::Task(task)) = last
                && matches!(task.ending, TaskEnding::Stopped | TaskEnding::Failed(_))
            {
                self.engine.pause_queue(true, OPERATOR)?;
                return Ok(());
            }
            if !self.dialogue.keeps {
                return Ok(());
            }
            self.engine.drop_queued(id, OPERATOR)?;
        }
    }
}

/// «В очереди 2 задания …», a task a line.
#[must_use]
pub(crate) fn queue_in_words(queue: &Queue, language: Language) -> String {
    if queue.tasks.is_empty() {
        return told!(language, "nothing-is-waiting");
    }
    let paused = match queue.paused {
        Some(_) => told!(language, "paused"),
        None => String::new(),
    };
    let count = queue.tasks.len();
    let mut lines = vec![told!(language, "tasks-waiting", count, paused)];
    for (n, task) in queue.tasks.iter().enumerate() {
        let begun = match task.is_begun {
            true => told!(language, "begun"),
            false => String::new(),
        };
        lines.push(match language {
            Language::Russian => format!("  {}. «{}»{begun}", n + 1, task.text),
            Language::English => format!("  {}. \"{}\"{begun}", n + 1, task.text),
        });
    }
    lines.join("\n")
}
