//! A recording played into the console: what happened then is told as if it happened now.
//!
//! **Invariant.** Nothing is driven and nothing is written: things stand as they stood when the recording began. A stop
//! ends what is played.

use std::time::{Duration, Instant};

use serde_json::Value;

use crate::engine::json::{self as views, TaskEnd};
use crate::engine::{QueuedTask, State};
use crate::recording::{Played, Told};
use crate::robot::Moment;
use crate::store::Timestamp;
use crate::units::{Deg, Point, Pose, Stop};

use super::book::{Running, Task};
use super::drive::{GLANCE, TELL, Tasks};

/// Whose tasks they are.
const BY: &str = "replay";

impl Tasks {
    /// Plays a recording to its end, so many times as fast as it was, once somebody looks on.
    pub(super) fn replay(&self, played: &Played, pace: f64) {
        let (state, stop) = (self.desk.state(), Stop::new());
        let Some(first) = played.told.first() else { return };
        while !self.events.is_heard() {
            if self.book().is_over {
                return;
            }
            std::thread::sleep(GLANCE);
        }
        let (begun, mut shown) = (Instant::now(), None);
        // A pose that came too soon after another; where it stood when something happened is told before that.
        let mut left_out = None;
        for (number, told) in played.told.iter().enumerate() {
            let seconds = told.time.saturating_sub(first.time) as f64 / 1e9 / pace;
            let at = Duration::try_from_secs_f64(seconds).unwrap_or_default();
            if !self.wait_until(begun + at, &stop) {
                break;
            }
            let is_due = shown.is_none_or(|shown: Instant| shown.elapsed() >= TELL);
            let pose = match told.topic == "/pose" {
                true if is_due => Some(&told.value),
                true => {
                    left_out = Some(&told.value);
                    continue;
                }
                false => left_out,
            };
            left_out = None;
            if let Some(moment) = pose.and_then(|pose| moment(&state, pose)) {
                shown = Some(Instant::now());
                self.events.robot_is(views::robot(&state, &moment));
            }
            self.happened(told, &played.told[number + 1..], &stop);
        }
        // One that the recording breaks off, or a stop.
        self.ended_again("stopped", "");
    }

    /// Whether it is to be gone on with when that moment has come.
    fn wait_until(&self, moment: Instant, stop: &Stop) -> bool {
        loop {
            if stop.is_raised() || self.book().is_over {
                return false;
            }
            let left = moment.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return true;
            }
            std::thread::sleep(left.min(GLANCE));
        }
    }

    fn happened(&self, told: &Told, then: &[Told], stop: &Stop) {
        let value = &told.value;
        let text = |key: &str| value[key].as_str().unwrap_or_default();
        match (told.topic.as_str(), text("event")) {
            ("/tasks", "task") => {
                let mut book = self.book();
                let at = Timestamp((told.time / 1_000_000) as i64);
                let (text, by) = (text("text").to_owned(), BY.to_owned());
                let noted = QueuedTask { id: 0, text, by, at, from: None, is_begun: true };
                let id = book.next_id();
                let task = Task::kept(id, noted).view("running");
                let view = views::played_again(task, &as_it_went(then));
                let (stop, is_dropped) = (stop.clone(), false);
                let (why, noted, answer) = (None, None, None);
                let shown = view.clone();
                book.running =
                    Some(Running { id, view: shown, stop, why, noted, is_dropped, answer });
                drop(book);
                self.events.tell("task", &view);
            }
            ("/tasks", _) => self.ended_again(text("outcome"), text("text")),
            ("/directives" | "/surprises", _) => {
                let task = self.book().running.as_ref().map(|running| running.id);
                self.events.tell("directive", &views::of_task(value.clone(), task));
            }
            _ => {}
        }
    }

    fn ended_again(&self, state: &str, text: &str) {
        let Some(running) = self.book().running.take() else { return };
        if let Some(why) = &running.why {
            self.events.tell("stopped", &views::stopped(why, running.id));
        }
        let end = TaskEnd {
            state: state.to_owned(),
            text_end: text.to_owned(),
            stopped_by: running.why,
            ..TaskEnd::default()
        };
        self.end(&views::ended(running.view, &end));
    }
}

/// How a task went by what was told after it began: its directives with their times. None where it was broken off or
/// planned anew: then the plan is told when its turn comes.
fn as_it_went(then: &[Told]) -> Value {
    let mut directives = Vec::new();
    for told in then {
        match (told.topic.as_str(), told.value["event"].as_str().unwrap_or_default()) {
            ("/tasks", "task_ended") if told.value["outcome"] == "done" => {
                let planned = then.iter().map(|told| &told.value);
                let planned = planned.filter(|event| event["event"] == "planned").take(1);
                let planned: Vec<&Value> = planned.collect();
                return views::as_it_went(&directives, &planned);
            }
            ("/tasks", _) | ("/directives", "replanned") | ("/surprises", _) => break,
            ("/directives", "arrived" | "done") => {
                let mut directive = told.value.clone();
                if let Some(fields) = directive.as_object_mut() {
                    fields.remove("event");
                }
                directives.push(directive);
            }
            _ => {}
        }
    }
    Value::Null
}

/// Where a foxglove.PoseInFrame has the robot: its frame is called by the key of a Map. None of one of another house.
fn moment(state: &State, value: &Value) -> Option<Moment> {
    let frame = value["frame_id"].as_str()?;
    let (map, _) = state.world().ok()?.maps.iter().find(|(_, map)| map.key == frame)?;
    let number = |value: &Value| value.as_f64().filter(|number| number.is_finite());
    let (position, turn) = (&value["pose"]["position"], &value["pose"]["orientation"]);
    let at = Point::new(number(&position["x"])? * 100.0, number(&position["y"])? * 100.0);
    let heading = Deg::from_radians(2.0 * number(&turn["z"])?.atan2(number(&turn["w"])?));
    Some(Moment { time: 0.0, map: *map, pose: Pose { at, heading } })
}
