//! Questions and orders from the nodes of ROS: `/orthoframe/ask`, `/orthoframe/run`; and what they may look at: `/map`,
//! `/orthoframe/markers`, `/diagnostics`.
//!
//! **Invariant.** One order is carried out at a time; another is refused, not queued. Every goal that was accepted gets a
//! result, whatever becomes of `ortho` or of the robot.

use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::time::{Duration, Instant};

use ros2_client::action::{
    ActionServer, CancelGoalRequest, CancelGoalResponse, GetResultResponse, GoalId, GoalInfo,
    GoalStatusEnum, SendGoalResponse,
};
use ros2_client::action_msgs::{CancelGoalResponseEnum, GoalStatus, GoalStatusArray};
use ros2_client::builtin_interfaces::Time;
use ros2_client::service::Server;
use ros2_client::{Publisher, RmwRequestId};
use serde_json::Value;

use crate::house::{Errand, House};
use crate::messages::{
    AskRequest, AskResponse, DiagnosticArray, DiagnosticStatus, KeyValue, MarkerArray,
    OccupancyGrid, RunFeedback, RunGoal, RunResult, header,
};
use crate::ros::{Fault, Kept, Ros};

const GLANCE: Duration = Duration::from_millis(20);
const HEARTBEAT: Duration = Duration::from_secs(1);
/// So many results are kept for who asks late.
const KEPT: usize = 20;

struct UnderWay {
    goal: GoalId,
    accepted: Time,
    errand: Errand,
    /// The last value that was told: the task's, once it has ended.
    last: Option<Value>,
}

/// An answer, and who asked.
type Answered = (RmwRequestId, AskResponse);

pub(crate) struct Service {
    house: House,
    asks: Server<AskRequest, AskResponse>,
    runs: ActionServer<RunGoal, RunResult, RunFeedback>,
    diagnostics: Publisher<DiagnosticArray>,
    /// Answers that are being looked for.
    answers: (mpsc::Sender<Answered>, Receiver<Answered>),
    under_way: Option<UnderWay>,
    ended: Vec<(GoalId, Time, GoalStatusEnum, RunResult)>,
    /// Who waits for the result of which goal.
    waiting: Vec<(RmwRequestId, GoalId)>,
    told: Instant,
    _shown: (Publisher<OccupancyGrid>, Publisher<MarkerArray>),
    _ros: Ros,
}

impl Service {
    pub(crate) fn new(mut ros: Ros, house: House) -> Result<Self, Fault> {
        let (grid, markers) = house.map("map")?;
        let map = ros.publish("/map", ("nav_msgs", "OccupancyGrid"), Kept::Latched)?;
        map.publish(grid).map_err(|e| format!("/map: {e:?}"))?;
        let shown = ("visualization_msgs", "MarkerArray");
        let marked = ros.publish("/orthoframe/markers", shown, Kept::Latched)?;
        marked
            .publish(MarkerArray { markers })
            .map_err(|e| format!("/orthoframe/markers: {e:?}"))?;
        let diagnostics = ("diagnostic_msgs", "DiagnosticArray");
        Ok(Self {
            asks: ros.server("/orthoframe/ask", ("orthoframe_msgs", "Ask"))?,
            runs: ros.action_server("/orthoframe/run", ("orthoframe_msgs", "Run"))?,
            diagnostics: ros.publish("/diagnostics", diagnostics, Kept::Said)?,
            house,
            answers: mpsc::channel(),
            under_way: None,
            ended: Vec::new(),
            waiting: Vec::new(),
            told: Instant::now(),
            _shown: (map, marked),
            _ros: ros,
        })
    }

    /// Serves until the program is ended.
    ///
    /// # Errors
    /// Nothing ends it today but a signal.
    pub(crate) fn serve(&mut self) -> Result<(), Fault> {
        loop {
            self.hear_questions();
            self.hear_orders();
            self.follow();
            self.give_results();
            if self.told.elapsed() >= HEARTBEAT {
                self.told = Instant::now();
                self.diagnose();
            }
            std::thread::sleep(GLANCE);
        }
    }

    fn hear_questions(&mut self) {
        while let Ok(Some((id, AskRequest { text }))) = self.asks.receive_request() {
            let (house, say) = (self.house.clone(), self.answers.0.clone());
            std::thread::spawn(move || {
                let answer = match house.ask(&text) {
                    Ok(value) => {
                        let (text, json) = within_one(told(&value), value.to_string());
                        AskResponse { outcome: word(&value, "outcome"), text, json }
                    }
                    Err(why) => {
                        let (text, json) = within_one(why, String::new());
                        AskResponse { outcome: "error".to_owned(), text, json }
                    }
                };
                // The node may have ended.
                let _ = say.send((id, answer));
            });
        }
        while let Ok((id, answer)) = self.answers.1.try_recv() {
            note(self.asks.send_response(id, answer), "an answer");
        }
    }

    fn hear_orders(&mut self) {
        while let Ok(Some((id, asked))) = self.runs.receive_goal() {
            let stamp = Time::now();
            let begun = match self.under_way {
                Some(_) => None,
                None => match self.house.run(&asked.goal.text) {
                    Ok(errand) => Some(errand),
                    Err(why) => {
                        eprintln!("ortho-ros2: {why}");
                        None
                    }
                },
            };
            let accepted = begun.is_some();
            if let Some(errand) = begun {
                let goal = asked.goal_id;
                self.under_way = Some(UnderWay { goal, accepted: stamp, errand, last: None });
            }
            note(self.runs.send_goal_response(id, SendGoalResponse { accepted, stamp }), "a goal");
            self.tell_statuses();
        }
        while let Ok(Some((id, asked))) = self.runs.receive_cancel_request() {
            let Some(wanted) = goal_of(&asked) else { continue };
            let ours =
                self.under_way.as_ref().filter(|one| wanted == one.goal || wanted == GoalId::ZERO);
            let goals: Vec<GoalInfo> = ours
                .map(|one| {
                    one.errand.stop();
                    GoalInfo { goal_id: one.goal, stamp: one.accepted }
                })
                .into_iter()
                .collect();
            let return_code = match goals.is_empty() {
                true => CancelGoalResponseEnum::UnknownGoal,
                false => CancelGoalResponseEnum::None,
            };
            let answer = CancelGoalResponse { return_code, goals_canceling: goals };
            note(self.runs.send_cancel_response(id, answer), "a cancel");
        }
        while let Ok(Some((id, asked))) = self.runs.receive_result_request() {
            self.waiting.push((id, asked.goal_id));
        }
    }

    /// Tells what happens on the way, and how it ends.
    fn follow(&mut self) {
        let Some(one) = &mut self.under_way else { return };
        loop {
            match one.errand.lines.try_recv() {
                Ok(value) if value.get("event").is_some() => {
                    let feedback = RunFeedback {
                        event: word(&value, "event"),
                        text: told(&value),
                        json: value.to_string(),
                    };
                    note(self.runs.send_feedback(one.goal, feedback), "feedback");
                }
                Ok(value) => one.last = Some(value),
                Err(TryRecvError::Empty) => return,
                Err(TryRecvError::Disconnected) => break,
            }
        }
        let Some(one) = self.under_way.take() else { return };
        one.errand.reap();
        let value = one.last.unwrap_or(Value::Null);
        let outcome = match word(&value, "outcome") {
            outcome if outcome.is_empty() => "error".to_owned(),
            outcome => outcome,
        };
        let status = match outcome.as_str() {
            "done" | "already_true" => GoalStatusEnum::Succeeded,
            "stopped" => GoalStatusEnum::Canceled,
            _ => GoalStatusEnum::Aborted,
        };
        let (text, json) = within_one(told(&value), value.to_string());
        let result = RunResult { outcome, text, json };
        self.ended.push((one.goal, one.accepted, status, result));
        if self.ended.len() > KEPT {
            self.ended.remove(0);
        }
        self.tell_statuses();
    }

    fn give_results(&mut self) {
        let is_under_way =
            |goal: &GoalId| self.under_way.as_ref().is_some_and(|one| one.goal == *goal);
        let (wait, ready): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.waiting).into_iter().partition(|(_, goal)| is_under_way(goal));
        self.waiting = wait;
        for (id, goal) in ready {
            let known = self.ended.iter().find(|(ended, ..)| *ended == goal);
            let (status, result) = match known {
                Some((_, _, status, result)) => (*status, result.clone()),
                None => {
                    let text = "no such goal was accepted".to_owned();
                    let result =
                        RunResult { outcome: "error".to_owned(), text, json: String::new() };
                    (GoalStatusEnum::Unknown, result)
                }
            };
            note(self.runs.send_result(id, GetResultResponse { status, result }), "a result");
        }
    }

    fn tell_statuses(&mut self) {
        let running =
            self.under_way.as_ref().map(|one| (one.goal, one.accepted, GoalStatusEnum::Executing));
        let ended =
            self.ended.iter().map(|(goal, accepted, status, _)| (*goal, *accepted, *status));
        let status_list = ended
            .chain(running)
            .map(|(goal_id, stamp, status)| GoalStatus {
                goal_info: GoalInfo { goal_id, stamp },
                status,
            })
            .collect();
        note(self.runs.send_goal_statuses(GoalStatusArray { status_list }), "statuses");
    }

    fn diagnose(&mut self) {
        let last = self.ended.last().map(|(_, _, status, result)| (*status, result));
        let (level, message) = match (&self.under_way, last) {
            (Some(_), _) => (0, "an order is carried out".to_owned()),
            (None, Some((GoalStatusEnum::Aborted, result))) => {
                // A robot that fails is an error; that something cannot be done is none.
                let level = if result.outcome == "vehicle_failed" || result.outcome == "error" {
                    2
                } else {
                    1
                };
                (level, format!("the last order ended: {}", result.outcome))
            }
            (None, _) => (0, "waiting for orders".to_owned()),
        };
        let value = |key: &str, value: String| KeyValue { key: key.to_owned(), value };
        let values = vec![
            value("store", self.house.store.display().to_string()),
            value("vehicle", self.house.vehicle.clone().unwrap_or_else(|| "simulator".to_owned())),
            value("last", last.map(|(_, result)| result.text.clone()).unwrap_or_default()),
        ];
        let name = "orthoframe: orders".to_owned();
        let status = DiagnosticStatus { level, name, message, hardware_id: String::new(), values };
        let told = DiagnosticArray { header: header(""), status: vec![status] };
        note(self.diagnostics.publish(told), "diagnostics");
    }
}

/// Which goal is to be cancelled. ros2-client keeps the field to itself; as a message it shows it.
fn goal_of(asked: &CancelGoalRequest) -> Option<GoalId> {
    let mut shown = serde_json::to_value(asked).ok()?;
    serde_json::from_value::<GoalInfo>(shown["goal_info"].take()).ok().map(|info| info.goal_id)
}

fn word(value: &Value, key: &str) -> String {
    value[key].as_str().unwrap_or_default().to_owned()
}

/// What a value says in words, by the fields in which `ortho` has them.
fn told(value: &Value) -> String {
    let texts = ["text", "explanation", "ru", "do_ru", "message"];
    let found = texts.iter().find_map(|key| value[key].as_str()).map(str::to_owned);
    let fault = || Some(value["errors"].as_array()?.first()?["message"].as_str()?.to_owned());
    found.or_else(fault).unwrap_or_default()
}

/// So many bytes of an answer go in one message with all that stands about them.
const WITHIN_ONE: usize = 1200;

/// An answer that needs no second message: in pieces, RustDDS (0.15.1) writes a byte too many before what an answer belongs
/// to, and nobody can read it. The value is left out where both do not fit, and the end of a text that does not fit alone.
fn within_one(mut text: String, json: String) -> (String, String) {
    if text.len() + json.len() <= WITHIN_ONE {
        return (text, json);
    }
    if text.len() > WITHIN_ONE {
        const CUT: &str = " …";
        text.truncate(text.floor_char_boundary(WITHIN_ONE - CUT.len()));
        text.push_str(CUT);
    }
    (text, String::new())
}

/// A message that cannot be sent is told of, and the node goes on.
fn note<Ok, Error: std::fmt::Debug>(sent: Result<Ok, Error>, what: &str) {
    if let Err(error) = sent {
        eprintln!("ortho-ros2: {what} could not be sent: {error:?}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_goes_in_one_message() {
        let small = ("да".to_owned(), "{}".to_owned());
        assert_eq!(within_one(small.0.clone(), small.1.clone()), small);
        let value = "{}".repeat(WITHIN_ONE);
        assert_eq!(within_one("да".to_owned(), value), ("да".to_owned(), String::new()));
        for length in WITHIN_ONE / 2 - 3..WITHIN_ONE / 2 + 3 {
            let (text, json) = within_one("ы".repeat(length), "{}".to_owned());
            assert!(text.len() + json.len() <= WITHIN_ONE);
            assert_eq!(text.ends_with(" …"), length * 2 > WITHIN_ONE, "{length}");
        }
    }
}
