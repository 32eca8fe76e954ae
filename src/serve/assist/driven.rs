//! A plan being carried out, and whoever asked for it: a call that waits for its end, or a task of the protocol, whose
//! client asks from time to time how far it is.
//!
//! **Invariant.** Whoever gives it up, by either way, stops the robot; so does the end of the program.

use std::sync::Arc;
use std::time::Duration;

use rmcp::model::{ProgressNotificationParam, ProgressToken, Task};
use rmcp::service::{RequestContext, RoleServer};
use rmcp::task_manager::{TaskContext, TaskExit, TaskManager, TaskOptions};
use serde_json::Value;

use crate::engine::json as views;

use super::super::events::Hearing;
use super::super::fault::Fault;
use super::super::gate::Session;
use super::super::{House, apart};
use super::{complete, refused};

/// How long a task of the protocol is known, while it lasts and after it has ended: what takes longer is stopped.
const KNOWN: Duration = Duration::from_hours(24);
/// How often its client had better ask.
const ASK_EVERY: u64 = 500;
/// Whoever drives must be heard of.
const BEAT: Duration = Duration::from_secs(20);

/// A client that does not take what it is told of the progress within this time hears of the next. Who has gone never
/// takes it, and its call must end all the same.
const HEARS: Duration = Duration::from_secs(1);

/// A plan that was begun.
pub(super) struct Driven {
    house: Arc<House>,
    session: Session,
    id: u64,
    hearing: Hearing,
}

/// How far it is: directives that are done, one under way as a half, of how many.
#[derive(Default)]
struct Far {
    /// Of plans before the one in force.
    before: f64,
    now: f64,
    of: f64,
    /// What it was told last.
    words: String,
}

impl Far {
    /// Whether an event brings it further.
    fn follow(&mut self, event: &Value) -> bool {
        let number = || event["number"].as_f64().unwrap_or_default();
        let now = match (event["event"].as_str(), event["of"].as_f64()) {
            (Some("started"), Some(of)) => {
                self.of = self.before + of;
                self.before + number() - 0.5
            }
            (Some("arrived" | "done"), _) => self.before + number(),
            (Some("started") | None, _) => return false,
            (Some(_), _) => {
                self.before = self.now.ceil();
                return false;
            }
        };
        let is_further = now > self.now;
        self.now = self.now.max(now);
        let told = event["en"].as_str().or(event["do_en"].as_str()).unwrap_or_default();
        if is_further {
            self.words = format!("{}/{}: {told}", self.now.ceil(), self.of.max(self.now));
        }
        is_further
    }

    /// A little further within a long directive, so that its client hears that it goes on; whether one is under way.
    fn goes_on(&mut self) -> bool {
        let left = self.now.ceil() - self.now;
        self.now += left / 10.0;
        left > 0.0
    }
}

/// Whoever is told how far it is, and may give it up.
enum Asker<'c> {
    Call(&'c RequestContext<RoleServer>, Option<ProgressToken>),
    Task(TaskContext),
}

impl Asker<'_> {
    async fn gives_up(&self) {
        match self {
            Self::Call(context, _) => context.ct.cancelled().await,
            Self::Task(context) => context.cancelled().await,
        }
    }

    async fn is_told(&self, far: &Far) {
        let words = far.words.clone();
        match self {
            Self::Call(context, Some(token)) => {
                let progress = ProgressNotificationParam::new(token.clone(), far.now);
                let progress = progress.with_total(far.of).with_message(words);
                let told = context.peer.notify_progress(progress);
                let _ = tokio::time::timeout(HEARS, told).await;
            }
            Self::Call(_, None) => {}
            Self::Task(context) => context.set_status_message(words),
        }
    }
}

impl Driven {
    /// Has a plan begun that a person agreed to.
    pub(super) async fn begin(house: Arc<House>, session: Session, id: u64) -> Result<Self, Fault> {
        let hearing = house.events.listen();
        let (asked, by) = (Arc::clone(&house), session.clone());
        apart(move || Ok(asked.tasks.confirm_alone(&by, id))).await??;
        Ok(Self { house, session, id, hearing })
    }

    /// Tells the call of its progress, until it has ended.
    pub(super) async fn within(self, context: &RequestContext<RoleServer>) -> Result<Value, Fault> {
        let token = context.meta.get_progress_token();
        self.until_its_end(&Asker::Call(context, token)).await.0
    }

    /// As a task of the protocol, which goes on when the call has been answered.
    pub(super) fn into_task(self, tasks: &TaskManager) -> Task {
        let known = u64::try_from(KNOWN.as_millis()).unwrap_or(u64::MAX);
        let options = TaskOptions::new().with_ttl_ms(known).with_poll_interval_ms(ASK_EVERY);
        tasks.spawn(options, |context| {
            Box::pin(async move {
                match self.until_its_end(&Asker::Task(context)).await {
                    (Ok(value), true) if value["state"] == "cancelled" => Err(TaskExit::Cancelled),
                    (Ok(value), _) => Ok(complete(vec![], value)),
                    (Err(fault), _) => Ok(refused(&fault)),
                }
            })
        })
    }

    /// How it ended, and whether it was given up.
    async fn until_its_end(self, asker: &Asker<'_>) -> (Result<Value, Fault>, bool) {
        let Self { house, session, id, mut hearing } = self;
        let mut watch = Watch { house: &house, session: &session, id, is_over: false };
        let (mut far, mut is_given_up) = (Far::default(), false);
        let mut beat = tokio::time::interval(BEAT);
        loop {
            let happened = tokio::select! {
                happened = house.events.next(&mut hearing) => happened,
                () = asker.gives_up(), if !is_given_up => {
                    is_given_up = true;
                    let (house, session) = (Arc::clone(&house), session.clone());
                    if let Err(fault) = apart(move || Ok(house.tasks.cancel(&session, id))).await {
                        return (Err(fault), true);
                    }
                    continue;
                }
                _ = beat.tick() => {
                    let _ = house.tasks.lease(&session);
                    if far.goes_on() {
                        asker.is_told(&far).await;
                    }
                    continue;
                }
            };
            for (kind, data) in happened {
                let event: Value = serde_json::from_str(&data).unwrap_or_default();
                if event["task"] != id {
                    continue;
                }
                let state = event["state"].as_str().unwrap_or_default();
                if kind == "task" && !["queued", "running"].contains(&state) {
                    watch.is_over = true;
                    let text = event["text_end"].as_str().unwrap_or_default().to_owned();
                    return (Ok(views::with_text(event, &text)), is_given_up);
                }
                if kind == "directive" && far.follow(&event) {
                    asker.is_told(&far).await;
                }
            }
        }
    }
}

/// Has the robot stop when what drives it is dropped before its end.
struct Watch<'w> {
    house: &'w Arc<House>,
    session: &'w Session,
    id: u64,
    is_over: bool,
}

impl Drop for Watch<'_> {
    fn drop(&mut self) {
        if !self.is_over {
            // What drops a call must not wait for the disk.
            let (house, session, id) = (Arc::clone(self.house), self.session.clone(), self.id);
            std::thread::spawn(move || house.tasks.cancel(&session, id));
        }
    }
}
