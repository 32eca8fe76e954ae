//! Tasks: planned, confirmed, driven one after another on a thread of their own, and how each ended.
//!
//! A line is first heard by a dialogue apart, which drives the simulator in no time: what it would do is the plan that is
//! confirmed. Then it is heard once more, at the pace of the clock, beside the engine that goes on writing edits; what the
//! robot did is noted by the writer after each task.
//!
//! **Invariant.** One task is driven at a time. A stop needs no lease, and is raised by no queue.

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, Weak};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::engine::{
    Dialogue, Engine, Error, Event, Outcome, Progress, Reply, State, TaskEvent, TaskEvents, json,
};
use crate::robot::Moment;
use crate::units::{Language, Stop};

use super::desk::Desk;
use super::events::Events;
use super::gate::Session;

/// So many tasks that ended are remembered, and so many plans that wait for a word.
const REMEMBERED: usize = 50;
/// How long whoever drives may be silent.
const LEASE: Duration = Duration::from_secs(120);
/// Between two looks whether the robot is to stop.
const GLANCE: Duration = Duration::from_millis(20);
/// Between two poses that are told.
const TELL: Duration = Duration::from_millis(90);

/// A task that is known here.
#[derive(Debug)]
struct Task {
    id: u64,
    text: String,
    by: Session,
    /// As it was before the line.
    before: Dialogue,
    /// Of the state for which the plan was made.
    revision: u64,
    state: Weak<State>,
    plan: Value,
    /// This plan was agreed to and no other: where the world turns out to differ, the robot stops.
    is_strict: bool,
}

#[derive(Debug, Default)]
struct Book {
    next: u64,
    talks: BTreeMap<u64, Dialogue>,
    planned: BTreeMap<u64, Task>,
    queue: VecDeque<Task>,
    running: Option<Running>,
    ended: VecDeque<Value>,
    lease: Option<Lease>,
    is_over: bool,
}

#[derive(Debug)]
struct Running {
    id: u64,
    by: Session,
    view: Value,
    stop: Stop,
    why: Option<String>,
}

#[derive(Debug, Clone)]
struct Lease {
    holder: Session,
    until: Instant,
}

/// Why a task is not taken up.
#[derive(Debug)]
pub(super) enum Declined {
    /// None of that number waits.
    Unknown,
    /// Somebody else drives.
    Leased {
        holder: String,
        seconds: u64,
    },
    /// The map, or what the plan rested on, changed since it was planned.
    Expired {
        /// What the same line is answered now.
        replies: Vec<Value>,
        /// The plan as it is now, which waits for a word; none where there is none any more.
        task: Option<Value>,
    },
    /// The robot drives, or something waits before it.
    Busy,
    Failed(Box<Error>),
}

/// What came of a line that was to be a question.
#[derive(Debug)]
pub(super) enum Answered {
    Told(Value),
    IsOrder,
}

/// See the head of this file.
#[derive(Debug)]
pub(super) struct Tasks {
    desk: Arc<Desk>,
    events: Arc<Events>,
    /// Times as fast as the clock.
    pace: f64,
    book: Mutex<Book>,
    wake: Condvar,
}

impl Tasks {
    /// Begins to wait for tasks.
    #[must_use]
    pub(super) fn begin(desk: Arc<Desk>, events: Arc<Events>, pace: f64) -> Arc<Self> {
        let book = Mutex::default();
        let tasks = Arc::new(Self { desk, events, pace, book, wake: Condvar::new() });
        let driver = Arc::clone(&tasks);
        std::thread::spawn(move || {
            while let Some(task) = driver.take_up() {
                driver.drive(&task);
            }
        });
        tasks
    }

    fn book(&self) -> MutexGuard<'_, Book> {
        self.book.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Hears a line of whoever speaks: a question is answered; an order waits to be confirmed.
    ///
    /// # Errors
    /// There is no map, or the disk refused.
    pub(super) fn say(
        &self,
        session: &Session,
        text: &str,
        language: Language,
    ) -> Result<Value, Error> {
        let (state, before) = (self.desk.state(), self.talk_of(session, language));
        let mut heard = json::rehearse(&state, &before, text)?;
        // The dialogue knows of nothing that is under way.
        if heard.stops && self.stop(&session.name) {
            let standing = language.pick("Останавливаюсь.", "I am stopping.");
            heard.replies = vec![json!({ "outcome": "stopped", "text": standing })];
        }
        let mut view = self.told(&heard.replies, &state, language);
        match heard.plan {
            Some(plan) => view["task"] = self.propose(session, text, before, plan, &state),
            None => self.keep(session, heard.dialogue),
        }
        Ok(view)
    }

    /// What was said with somebody so far, as it may be gone on with apart.
    fn talk_of(&self, session: &Session, language: Language) -> Dialogue {
        let book = self.book();
        let talk = book.talks.get(&session.number);
        talk.map_or_else(|| Dialogue::new(language), Dialogue::apart)
    }

    fn keep(&self, session: &Session, dialogue: Dialogue) {
        self.book().talks.insert(session.number, dialogue);
    }

    fn told(&self, replies: &[Value], state: &State, language: Language) -> Value {
        let mut view = json!({ "replies": replies, "revision": state.revision() });
        if let Some(robot) = self.under_way(language) {
            view["caution"] = robot;
        }
        view
    }

    /// What an answer lacks while the robot is under way: what it has done since it set out is noted when it is done.
    fn under_way(&self, language: Language) -> Option<Value> {
        self.book().running.as_ref()?;
        let robot = self.events.robot();
        let place = robot[language.pick("ru", "en")].as_str().map(str::to_owned);
        let known = language.pick(
            "Робот едет; что он сделал с начала задания, в ответе ещё не учтено.",
            "The robot is under way; what it did since it set out is not in this answer yet.",
        );
        Some(json!([known, place.as_deref().unwrap_or_default()].join(" ").trim()))
    }

    /// Answers a question of whoever speaks. An order is not followed, and not planned.
    ///
    /// # Errors
    /// There is no map, or the disk refused.
    pub(super) fn answer(
        &self,
        session: &Session,
        text: &str,
        language: Language,
    ) -> Result<Answered, Error> {
        let (state, before) = (self.desk.state(), self.talk_of(session, language));
        let heard = json::rehearse(&state, &before, text)?;
        if heard.plan.is_some() || heard.stops {
            return Ok(Answered::IsOrder);
        }
        let view = self.told(&heard.replies, &state, language);
        self.keep(session, heard.dialogue);
        Ok(Answered::Told(view))
    }

    /// A plan that waits for a word.
    pub(super) fn planned(&self, id: u64) -> Option<Value> {
        self.book().planned.get(&id).map(|task| task.view("planned"))
    }

    fn propose(
        &self,
        session: &Session,
        text: &str,
        before: Dialogue,
        plan: Value,
        state: &Arc<State>,
    ) -> Value {
        let mut book = self.book();
        book.next += 1;
        let (id, text, by) = (book.next, text.to_owned(), session.clone());
        let (revision, state) = (state.revision(), Arc::downgrade(state));
        let task = Task { id, text, by, before, revision, state, plan, is_strict: false };
        let view = task.view("planned");
        book.planned.insert(id, task);
        while book.planned.len() > REMEMBERED {
            book.planned.pop_first();
        }
        view
    }

    /// Takes the lease, or keeps it.
    ///
    /// # Errors
    /// [`Declined::Leased`].
    pub(super) fn lease(&self, session: &Session) -> Result<Value, Declined> {
        let view = {
            let mut book = self.book();
            let now = Instant::now();
            if let Some(lease) = &book.lease
                && lease.until > now
                && lease.holder.number != session.number
            {
                let seconds = (lease.until - now).as_secs();
                return Err(Declined::Leased { holder: lease.holder.name.clone(), seconds });
            }
            let is_new = book.lease.as_ref().is_none_or(|l| l.holder.number != session.number);
            book.lease = Some(Lease { holder: session.clone(), until: now + LEASE });
            is_new.then(|| book.lease_view())
        };
        if let Some(view) = &view {
            self.events.tell("lease", view);
        }
        Ok(self.book().lease_view())
    }

    /// Gives the lease back, where one has it.
    pub(super) fn give_back(&self, session: &Session) -> Value {
        let given = {
            let mut book = self.book();
            let is_ours = book.lease.as_ref().is_some_and(|l| l.holder.number == session.number);
            if is_ours {
                book.lease = None;
            }
            is_ours
        };
        if given {
            self.events.tell("lease", &Value::Null);
        }
        Value::Null
    }

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
        let Some(mut task) = self.book().planned.remove(&id) else { return Err(Declined::Unknown) };
        let state = self.desk.state();
        let is_same_state = task.state.upgrade().is_some_and(|then| Arc::ptr_eq(&then, &state));
        if !is_same_state {
            // What was seen since need not change the map, and yet may change the plan.
            let again = json::rehearse(&state, &task.before, &task.text);
            let again = again.map_err(|error| Declined::Failed(Box::new(error)))?;
            let is_same =
                again.plan.as_ref().is_some_and(|plan| json::is_same_plan(plan, &task.plan));
            if state.revision() != task.revision || !is_same {
                let (text, before) = (task.text, task.before);
                let anew = |plan| self.propose(session, &text, before, plan, &state);
                let replies = again.replies;
                return Err(Declined::Expired { replies, task: again.plan.map(anew) });
            }
        }
        let view = {
            let mut book = self.book();
            if is_strict && (book.running.is_some() || !book.queue.is_empty()) {
                book.planned.insert(id, task);
                return Err(Declined::Busy);
            }
            task.is_strict = is_strict;
            let view = task.view("queued");
            book.queue.push_back(task);
            view
        };
        self.wake.notify_all();
        self.tell_queue();
        Ok(view)
    }

    /// Drops a plan or a queued task; one that is driven is stopped. False where there is none.
    pub(super) fn cancel(&self, session: &Session, id: u64) -> bool {
        let is_running = self.book().running.as_ref().is_some_and(|r| r.id == id);
        if is_running {
            self.stop(&session.name);
            return true;
        }
        let dropped = {
            let mut book = self.book();
            let planned = book.planned.remove(&id).map(|task| ("declined", task));
            let at = book.queue.iter().position(|task| task.id == id);
            let queued = at.and_then(|at| book.queue.remove(at)).map(|task| ("cancelled", task));
            planned.or(queued)
        };
        let Some((state, task)) = dropped else { return false };
        self.end(&task.view(state));
        self.tell_queue();
        true
    }

    /// Puts a queued task before another, or last. False where there is none.
    pub(super) fn reorder(&self, id: u64, before: Option<u64>) -> bool {
        {
            let mut book = self.book();
            let Some(at) = book.queue.iter().position(|task| task.id == id) else { return false };
            let Some(task) = book.queue.remove(at) else { return false };
            let to = before.and_then(|before| book.queue.iter().position(|t| t.id == before));
            let to = to.unwrap_or(book.queue.len());
            book.queue.insert(to, task);
        }
        self.tell_queue();
        true
    }

    /// Stops the robot at once; what is queued waits no longer for it, so it is dropped too.
    pub(super) fn stop(&self, by: &str) -> bool {
        let (is_running, dropped) = {
            let mut book = self.book();
            let dropped: Vec<Task> = book.queue.drain(..).collect();
            let is_running = book.running.as_mut().is_some_and(|running| {
                running.stop.raise();
                running.why.get_or_insert_with(|| by.to_owned());
                true
            });
            (is_running, dropped)
        };
        for task in &dropped {
            self.end(&task.view("cancelled"));
        }
        if !dropped.is_empty() {
            self.tell_queue();
        }
        self.events.tell("stop", &json!({ "by": by, "is_running": is_running }));
        is_running
    }

    /// Ends all: the robot stops, and no task is taken up any more.
    pub(super) fn close(&self) {
        self.book().is_over = true;
        self.stop("ortho serve");
        self.wake.notify_all();
        let patience = Instant::now() + Duration::from_secs(5);
        while self.book().running.is_some() && Instant::now() < patience {
            std::thread::sleep(GLANCE);
        }
    }

    /// What is driven, what waits, what ended, who drives.
    #[must_use]
    pub(super) fn view(&self) -> Value {
        let waiting = self.desk.state().waiting().map(|queue| json::queue(&queue)).ok();
        let book = self.book();
        json!({
            "waiting": waiting,
            "task": book.running.as_ref().map(|running| &running.view),
            "queue": book.queue.iter().map(|task| task.view("queued")).collect::<Vec<_>>(),
            "ended": book.ended,
            "lease": book.lease_view(),
        })
    }

    fn tell_queue(&self) {
        let queue: Vec<Value> = self.book().queue.iter().map(|t| t.view("queued")).collect();
        self.events.tell("queue", &json!(queue));
    }

    fn end(&self, view: &Value) {
        {
            let mut book = self.book();
            book.ended.push_back(view.clone());
            if book.ended.len() > REMEMBERED {
                book.ended.pop_front();
            }
        }
        self.events.tell("task", view);
    }

    /// The next task, when there is one; none at the end of all.
    fn take_up(&self) -> Option<Task> {
        let mut book = self.book();
        loop {
            if book.is_over {
                return None;
            }
            if let Some(task) = book.queue.pop_front() {
                let (id, view, by) = (task.id, task.view("running"), task.by.clone());
                book.running = Some(Running { id, by, view, stop: Stop::new(), why: None });
                return Some(task);
            }
            book = self.wake.wait(book).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn drive(&self, task: &Task) {
        let (mut view, stop) = {
            let book = self.book();
            let running = book.running.as_ref().expect("it was just taken up");
            (running.view.clone(), running.stop.clone())
        };
        self.tell_queue();
        self.events.tell("task", &view);
        let mut dialogue = task.before.apart();
        dialogue.stopped_by(stop.clone());
        let mut engine = Engine::beside(self.desk.state());
        let mut drive = Drive::new(self, task, stop);
        let heard = dialogue.hear(&mut engine, &task.text, &mut |engine, event| {
            drive.follow(engine, event);
        });
        let failed_to_note = drive.failure.take();
        match heard {
            Ok(heard) => {
                let tasks = heard.replies.iter().rev();
                let last = tasks.clone().find(|reply| matches!(reply.outcome, Outcome::Task(_)));
                let worst = heard.replies.iter().find(|reply| reply.outcome.has_failed());
                let outcome = worst.or(last).map_or("done", |reply| reply.outcome.word());
                view["state"] = json!(outcome);
                view["text_end"] = json!(heard.text());
                let replies = heard.replies.iter().filter_map(|r| json::reply(&engine, r).ok());
                view["replies"] = json!(replies.collect::<Vec<_>>());
            }
            Err(error) => {
                view["state"] = json!("failed");
                view["text_end"] = json!(error.to_string());
            }
        }
        if let Some(failure) = failed_to_note {
            view["not_noted"] = json!(failure);
        }
        let why = {
            let mut book = self.book();
            // Who spoke since has said something newer.
            let spoke = book.talks.contains_key(&task.by.number);
            if !spoke {
                book.talks.insert(task.by.number, dialogue);
            }
            book.running.take().and_then(|running| running.why)
        };
        view["stopped_by"] = json!(why);
        self.events.robot_is(Value::Null);
        if view["state"] == "stopped" {
            self.events.tell("stopped", &json!({ "by": why, "task": task.id }));
        }
        self.end(&view);
    }

    /// Stops a task that is driven, for a reason.
    fn stop_for(&self, id: u64, why: &str) {
        if let Some(running) = self.book().running.as_mut().filter(|running| running.id == id) {
            running.stop.raise();
            running.why.get_or_insert_with(|| why.to_owned());
        }
    }

    /// Whether who has the robot driven is still there.
    fn is_leased(&self) -> bool {
        let mut book = self.book();
        let Some(running) = &book.running else { return false };
        let holds = |lease: &Lease| {
            lease.holder.number != running.by.number || lease.until > Instant::now()
        };
        let is_leased = book.lease.as_ref().is_some_and(holds);
        if !is_leased && let Some(running) = &mut book.running {
            running.why.get_or_insert_with(|| "lease".to_owned());
        }
        is_leased
    }
}

impl Book {
    fn lease_view(&self) -> Value {
        let now = Instant::now();
        let lease = self.lease.as_ref().filter(|lease| lease.until > now);
        lease.map_or(Value::Null, |lease| {
            json!({
                "holder": lease.holder.name,
                "session": lease.holder.number,
                "seconds": (lease.until - now).as_secs(),
            })
        })
    }
}

impl Task {
    fn view(&self, state: &str) -> Value {
        json!({
            "task": self.id, "text": self.text, "by": self.by.name, "state": state,
            "revision": self.revision, "plan": self.plan,
        })
    }
}

/// What is told while a task is driven, at the pace of the clock.
struct Drive<'t> {
    tasks: &'t Tasks,
    id: u64,
    stop: Stop,
    events: TaskEvents,
    /// The vehicle's clock, when it last told of its way.
    clock: Option<f64>,
    /// How much of the directive's time has passed.
    passed: f64,
    told: Instant,
    failure: Option<String>,
    /// The plans still to come to which alone was agreed; none where any will do.
    agreed: Option<VecDeque<Value>>,
}

impl<'t> Drive<'t> {
    fn new(tasks: &'t Tasks, task: &Task, stop: Stop) -> Self {
        let (events, told) = (TaskEvents::default(), Instant::now());
        let (id, clock, passed, failure) = (task.id, None, 0.0, None);
        let agreed = task.is_strict.then(|| json::plans_of(&task.plan).cloned().collect());
        Self { tasks, id, stop, events, clock, passed, told, failure, agreed }
    }

    fn follow(&mut self, engine: &Engine, event: &Event<'_>) {
        match event {
            Event::Progress { progress, world, .. } => {
                match progress {
                    Progress::Moved(moment) => self.moved(engine, moment),
                    Progress::Started { .. } => (self.clock, self.passed) = (None, 0.0),
                    Progress::Finished(report) => {
                        self.wait(report.seconds - self.passed);
                        let pose = Moment { time: 0.0, map: report.map, pose: report.pose };
                        self.tell_pose(engine, &pose);
                    }
                    _ => {}
                }
                if let Some(event) = self.events.of(world, progress) {
                    let mut view = json!(event);
                    let is_plan = matches!(event, TaskEvent::Planned(_) | TaskEvent::Replanned(_));
                    if is_plan
                        && let Some(agreed) = &mut self.agreed
                        && agreed.pop_front().as_ref() != Some(&view)
                    {
                        self.tasks.stop_for(self.id, "another plan");
                    }
                    view["task"] = json!(self.id);
                    self.tasks.events.tell("directive", &view);
                }
            }
            Event::Replied(Reply { outcome: Outcome::Task(task), .. }) => {
                let Some(after) = task.after.clone() else { return };
                let at = std::time::SystemTime::now().into();
                let noted = self
                    .tasks
                    .desk
                    .ask_from_thread(move |engine| engine.remember_after(&after, at));
                match noted {
                    Ok(Ok(())) => {
                        self.tasks.events.tell("known", &json!({ "task": self.id }));
                    }
                    Ok(Err(error)) => self.failure = Some(error.to_string()),
                    Err(_gone) => self.failure = Some("the engine has stopped".to_owned()),
                }
            }
            _ => {}
        }
    }

    fn moved(&mut self, engine: &Engine, moment: &Moment) {
        let step = moment.time - self.clock.unwrap_or(moment.time);
        self.clock = Some(moment.time);
        self.passed += step;
        self.wait(step);
        if self.told.elapsed() >= TELL {
            self.tell_pose(engine, moment);
        }
    }

    fn tell_pose(&mut self, engine: &Engine, moment: &Moment) {
        self.told = Instant::now();
        self.tasks.events.robot_is(pose_view(engine, moment));
    }

    /// Lets the vehicle's time pass by the clock; told to stop, it waits no more.
    fn wait(&self, seconds: f64) {
        let Ok(whole) = Duration::try_from_secs_f64(seconds.max(0.0) / self.tasks.pace) else {
            return;
        };
        let until = Instant::now() + whole;
        loop {
            if !self.tasks.is_leased() {
                self.stop.raise();
            }
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() || self.stop.is_raised() {
                return;
            }
            std::thread::sleep(left.min(GLANCE));
        }
    }
}

/// Where the robot is, in numbers and in words.
#[must_use]
pub(super) fn pose_view(state: &State, moment: &Moment) -> Value {
    let mut view = state
        .locate(moment.map, moment.pose, true)
        .map_or(Value::Null, |found| json::whereabout(state.world().expect("it located"), &found));
    if view.is_null() {
        let map = state.world().ok().and_then(|world| world.maps.get(&moment.map));
        let hundredths = |value: f64| (value * 100.0).round() / 100.0;
        let (at, heading) = (moment.pose.at, moment.pose.heading.get());
        view = json!({
            "map": map.map(|map| &map.name),
            "pose": {
                "x": hundredths(at.x), "y": hundredths(at.y), "heading_deg": hundredths(heading),
            },
        });
    }
    view
}
