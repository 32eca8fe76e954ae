//! A way that is barred: the robot stands, and whoever may drive is asked whether it is clear by now.
//!
//! **Invariant.** An answer counts for the question that is open; a stop, and the end of the lease, are answers too.

use std::time::{Duration, Instant};

use serde_json::Value;

use crate::engine::json as views;
use crate::robot::Answer;
use crate::units::Stop;

use super::drive::{Declined, GLANCE, Tasks};

/// So long an answer is waited for.
const PATIENCE: Duration = Duration::from_secs(120);

impl Tasks {
    /// Waits for what somebody says of what bars the way of the task that is driven.
    pub(super) fn ask_to_clear(&self, id: u64, stop: &Stop, barred: &Value) -> Answer {
        if let Some(running) = self.book().running.as_mut().filter(|running| running.id == id) {
            views::barred(&mut running.view, barred.clone());
            running.answer = None;
        }
        let until = Instant::now() + PATIENCE;
        let answer = loop {
            if !self.is_leased() {
                stop.raise();
            }
            let said = self.book().running.as_ref().and_then(|running| running.answer);
            let is_over = stop.is_raised() || Instant::now() >= until;
            match said {
                Some(answer) => break answer,
                None if is_over => break Answer::Silence,
                None => std::thread::sleep(GLANCE),
            }
        };
        if let Some(running) = self.book().running.as_mut() {
            views::barred(&mut running.view, Value::Null);
        }
        let told = match answer {
            Answer::Clear => "clear",
            Answer::GiveUp => "give_up",
            Answer::Silence => "silence",
        };
        self.events.tell("directive", &views::cleared(told, id));
        answer
    }

    /// Says whether the way is clear before which a task waits.
    ///
    /// # Errors
    /// [`Declined::Unknown`] where it waits before none.
    pub(super) fn answer_barred(&self, id: u64, is_clear: bool) -> Result<(), Declined> {
        let mut book = self.book();
        let waits = book.running.as_mut().filter(|running| {
            running.id == id && !running.view["barred"].is_null() && running.answer.is_none()
        });
        let running = waits.ok_or(Declined::Unknown)?;
        running.answer = Some(if is_clear { Answer::Clear } else { Answer::GiveUp });
        // A question is answered once; the next one is told anew.
        views::barred(&mut running.view, Value::Null);
        Ok(())
    }
}
