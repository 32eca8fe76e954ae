//! Tasks: planned, confirmed, driven one after another on a thread of their own, and how each ended.
//!
//! A line is first heard by a dialogue apart, which drives the simulator in no time: what it would do is the plan that is
//! confirmed. Then it is heard once more, at the pace of the clock, beside the engine that goes on writing edits; what the
//! robot did is noted by the writer after each directive.
//!
//! **Invariant.** One task is driven at a time. A stop needs no lease, and is raised by no queue. A task that may be gone on
//! with stands in the store before it is begun, and until it has ended.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::engine::json::{self as views, TaskEnd};
use crate::engine::{
    After, Dialogue, Engine, Error, Event, Outcome, Progress, Reply, Report, State, TaskEvents,
    rehearsal,
};
use crate::recording::Played;
use crate::robot::{Address, Moment, Patience, Vehicle};
use crate::units::{Language, Stop, told};

use super::book::{Book, Leased, Running, Task};
use super::desk::Desk;
use super::events::Events;
use super::gate::Session;
use super::recorded::Recorded;

/// Between two looks whether the robot is to stop.
pub(super) const GLANCE: Duration = Duration::from_millis(20);
/// Between two poses that are told.
pub(super) const TELL: Duration = Duration::from_millis(90);

/// What drives.
#[derive(Debug, Clone)]
pub(super) enum Wheels {
    /// The simulated robot, so many times as fast as the clock.
    Simulated { pace: f64 },
    /// A robot that speaks the vehicle protocol, and how long it may keep silent.
    Robot { address: Address, patience: Patience },
}

fn open(book: &Mutex<Book>) -> MutexGuard<'_, Book> {
    book.lock().unwrap_or_else(PoisonError::into_inner)
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
    pub(super) desk: Arc<Desk>,
    pub(super) events: Arc<Events>,
    wheels: Wheels,
    /// The folder in which what is driven is recorded.
    records: Option<PathBuf>,
    book: Arc<Mutex<Book>>,
    pub(super) wake: Condvar,
}

impl Tasks {
    /// Plays what is to be played, so many times as fast as it was, and begins to wait for tasks; those that were left wait
    /// until somebody has them gone on with.
    #[must_use]
    pub(super) fn begin(
        desk: Arc<Desk>,
        events: Arc<Events>,
        wheels: Wheels,
        records: Option<PathBuf>,
        replay: Option<(Played, f64)>,
    ) -> Arc<Self> {
        let left = desk.state().waiting().unwrap_or_default();
        let (book, wake) = (Arc::new(Mutex::new(Book::kept(left))), Condvar::new());
        let (of_desk, told) = (Arc::clone(&book), Arc::clone(&events));
        desk.bequeath(move |queue| {
            let mut book = open(&of_desk);
            if book.adopt(queue) {
                told.tell("queue", &views::waiting(&book.waiting()));
            }
        });
        let tasks = Arc::new(Self { desk, events, wheels, records, book, wake });
        let driver = Arc::clone(&tasks);
        std::thread::spawn(move || {
            if let Some((played, pace)) = replay {
                driver.replay(&played, pace);
            }
            while let Some(task) = driver.take_up() {
                driver.drive(task);
            }
        });
        tasks
    }

    pub(super) fn book(&self) -> MutexGuard<'_, Book> {
        open(&self.book)
    }

    /// Has the store keep what the book says when its turn comes, and tells who listens.
    pub(super) fn note(&self, by: &str) {
        let (book, by) = (Arc::clone(&self.book), by.to_owned());
        let noted = self.desk.ask_from_thread(move |engine| {
            let queue = open(&book).noted();
            engine.put_queue(queue.clone(), &by).inspect(|()| open(&book).stands(&queue))
        });
        let failed = match noted {
            Ok(noted) => noted.err().map(|error| error.to_string()),
            Err(_gone) => Some("the engine has stopped".to_owned()),
        };
        if let Some(failure) = failed {
            tracing::error!(failure, "the queue is not kept");
        }
        let book = self.book();
        self.events.tell("queue", &views::waiting(&book.waiting()));
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
        stop: &Stop,
    ) -> Result<Value, Error> {
        let (state, before) = (self.heeding(stop), self.talk_of(session, language));
        let mut heard = rehearsal::rehearse(&state, &before, &rehearsal::Line::Said(text))?;
        // The dialogue knows of nothing that is under way.
        if heard.stops && self.stop(&session.name) {
            let standing = told!(language, "i-am-stopping");
            heard.replies = vec![views::said("stopped", &standing, None)];
        }
        let task = match heard.plan {
            // What nobody has heard was not said.
            _ if stop.is_raised() => None,
            Some(plan) => Some(self.propose(session, text, before, plan, &state)),
            None => {
                self.keep(session, heard.dialogue);
                None
            }
        };
        let caution = self.under_way(language);
        Ok(views::line(&heard.replies, state.revision(), caution.as_deref(), task))
    }

    /// What is known now, to be asked while somebody waits for the answer.
    fn heeding(&self, stop: &Stop) -> Arc<State> {
        Arc::new(self.desk.state().heeding(stop))
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

    /// What an answer lacks while the robot is under way: what it has done since it set out is noted when it is done.
    fn under_way(&self, language: Language) -> Option<String> {
        self.book().running.as_ref()?;
        let robot = self.events.robot();
        let place = robot[language.pick("ru", "en")].as_str().map(str::to_owned);
        let known = told!(language, "under-way");
        Some([known.as_str(), place.as_deref().unwrap_or_default()].join(" ").trim().to_owned())
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
        stop: &Stop,
    ) -> Result<Answered, Error> {
        let (state, before) = (self.heeding(stop), self.talk_of(session, language));
        let heard = rehearsal::rehearse(&state, &before, &rehearsal::Line::Said(text))?;
        if heard.plan.is_some() || heard.stops {
            return Ok(Answered::IsOrder);
        }
        let caution = self.under_way(language);
        if !stop.is_raised() {
            self.keep(session, heard.dialogue);
        }
        Ok(Answered::Told(views::line(&heard.replies, state.revision(), caution.as_deref(), None)))
    }

    /// A plan that waits for a word.
    pub(super) fn planned(&self, id: u64) -> Option<Value> {
        self.book().planned(id).map(|task| task.view("planned"))
    }

    pub(super) fn propose(
        &self,
        session: &Session,
        text: &str,
        before: Dialogue,
        plan: Value,
        state: &Arc<State>,
    ) -> Value {
        let mut book = self.book();
        let task = Task {
            id: book.next_id(),
            text: text.to_owned(),
            by: session.clone(),
            before: Some(before),
            revision: state.revision(),
            state: Arc::downgrade(state),
            plan,
            is_strict: false,
            noted: None,
            is_released: true,
            has_waited: false,
        };
        let view = task.view("planned");
        book.propose(task);
        view
    }

    /// Takes the lease, or keeps it.
    ///
    /// # Errors
    /// [`Declined::Leased`].
    pub(super) fn lease(&self, session: &Session) -> Result<Value, Declined> {
        let (is_new, view) = {
            let mut book = self.book();
            (book.lease(session)?, book.lease_view())
        };
        if is_new {
            self.events.tell("lease", &view);
        }
        Ok(view)
    }

    /// Gives the lease back, where one has it.
    pub(super) fn give_back(&self, session: &Session) -> Value {
        let given = self.book().give_back(session);
        if given {
            self.events.tell("lease", &Value::Null);
        }
        Value::Null
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
        self.book().view()
    }

    pub(super) fn end(&self, view: &Value) {
        self.book().end(view);
        self.events.tell("task", view);
    }

    /// The next task, when there is one; none at the end of all.
    fn take_up(&self) -> Option<Task> {
        let mut book = self.book();
        loop {
            if book.is_over {
                return None;
            }
            if let Some(mut task) = book.take_next() {
                if let Some(noted) = &mut task.noted {
                    // What was broken off goes on with the rest; its plan is not the one that it had.
                    task.has_waited |= noted.is_begun;
                    noted.is_begun = true;
                }
                let (id, view, noted) = (task.id, task.view("running"), task.noted.clone());
                let (stop, why, answer) = (Stop::new(), None, None);
                let is_dropped = false;
                book.running = Some(Running { id, view, stop, why, noted, is_dropped, answer });
                return Some(task);
            }
            book = self.wake.wait(book).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// The plan of a task whose turn has come, as it is now.
    fn plan_now(&self, task: &mut Task, state: &Arc<State>) {
        let Some(noted) = task.noted.as_ref().filter(|_| task.has_waited) else { return };
        let before = Dialogue::new(Language::of(&task.text));
        if let Ok(heard) = rehearsal::rehearse(state, &before, &rehearsal::Line::Waited(noted))
            && let Some(plan) = heard.plan
        {
            task.plan = plan;
        }
        let view = task.view("running");
        if let Some(running) = &mut self.book().running {
            running.view = view;
        }
    }

    fn drive(&self, mut task: Task) {
        let driven = self.desk.set_out();
        self.note(&task.by.name);
        let state = self.desk.state();
        if let Err(error) = driven {
            let text_end = error.say(Language::of(&task.text));
            let end = TaskEnd { state: "failed".to_owned(), text_end, ..TaskEnd::default() };
            let view = task.view("running");
            return self.ended(task, view, end, None);
        }
        self.plan_now(&mut task, &state);
        let (view, stop) = {
            let book = self.book();
            let running = book.running.as_ref().expect("it was just taken up");
            (running.view.clone(), running.stop.clone())
        };
        self.events.tell("task", &view);
        let mut dialogue = task
            .before
            .as_ref()
            .map_or_else(|| Dialogue::new(Language::of(&task.text)), Dialogue::apart);
        dialogue.stopped_by(stop.clone());
        let line = match &task.noted {
            Some(noted) if task.has_waited => rehearsal::Line::Waited(noted),
            _ => rehearsal::Line::Said(&task.text),
        };
        let mut engine = Engine::beside(Arc::clone(&state));
        let mut drive = Drive::new(self, &task, stop);
        let records = self.records.as_ref();
        let mut recorded = records.map(|folder| Recorded::begin(folder, task.id, &state));
        let heard = self.connect(&state, dialogue).and_then(|mut dialogue| {
            let mut tell = |engine: &Engine, event: &Event<'_>| {
                if let Some(Ok(recorded)) = &mut recorded {
                    recorded.tell(engine, event);
                }
                drive.follow(engine, event);
            };
            let heard = rehearsal::hear(&mut dialogue, &mut engine, &line, &mut tell)?;
            Ok((heard, dialogue))
        });
        let failed_to_note = drive.failure.lock().unwrap_or_else(PoisonError::into_inner).take();
        let mut end = TaskEnd { not_noted: failed_to_note, ..TaskEnd::default() };
        let dialogue = match heard {
            Ok((heard, dialogue)) => {
                let tasks = heard.replies.iter().rev();
                let last = tasks.clone().find(|reply| matches!(reply.outcome, Outcome::Task(_)));
                let worst = heard.replies.iter().find(|reply| reply.outcome.has_failed());
                let outcome = worst.or(last).map_or("done", |reply| reply.outcome.word());
                outcome.clone_into(&mut end.state);
                let told = heard.replies.iter();
                let told = told.filter(|reply| !matches!(reply.outcome, Outcome::Begun { .. }));
                let told: Vec<&str> = told.map(|reply| reply.text.as_str()).collect();
                told.join("\n").trim().clone_into(&mut end.text_end);
                let replies = heard.replies.iter().filter_map(|r| views::reply(&engine, r).ok());
                end.replies = Some(replies.collect());
                Some(dialogue)
            }
            Err(error) => {
                end.state = "failed".to_owned();
                end.text_end = error.say(Language::of(&task.text));
                None
            }
        };
        if let Some(recorded) = recorded {
            let kept = recorded.and_then(|recorded| {
                end.recorded = Some(recorded.file.display().to_string());
                recorded.end()
            });
            if let Err(error) = kept {
                tracing::error!(%error, "a task is not recorded");
                end.not_recorded = Some(error.to_string());
            }
        }
        self.ended(task, view, end, dialogue);
    }

    /// Notes how a task ended. One that was broken off waits on, and begins when somebody says so.
    fn ended(&self, mut task: Task, view: Value, mut end: TaskEnd, dialogue: Option<Dialogue>) {
        let (id, by) = (task.id, task.by.name.clone());
        // Who looks sees it driven or ended, and never neither.
        let ended = {
            let mut book = self.book();
            // Who spoke since has said something newer.
            if let Some(dialogue) = dialogue
                && task.by.number > 0
                && !book.talks.contains_key(&task.by.number)
            {
                book.talks.insert(task.by.number, dialogue);
            }
            let running = book.running.take();
            let is_dropped = running.as_ref().is_some_and(|running| running.is_dropped);
            let was_broken_off =
                ["stopped", "vehicle_failed", "failed"].contains(&end.state.as_str());
            if is_dropped && end.state == "stopped" {
                end.state = "cancelled".to_owned();
            }
            if was_broken_off && !is_dropped && !task.is_strict && task.noted.is_some() {
                end.waits = true;
                (task.is_released, task.has_waited) = (false, true);
                if let Some(noted) = &mut task.noted {
                    noted.is_begun = true;
                }
                book.wait(task);
            }
            end.stopped_by = running.and_then(|running| running.why);
            let ended = views::ended(view, &end);
            book.end(&ended);
            ended
        };
        self.events.robot_is(Value::Null);
        if let Some(why) = &end.stopped_by {
            self.events.tell("stopped", &views::stopped(why, id));
        }
        self.events.tell("task", &ended);
        self.note(&by);
    }

    /// A dialogue whose orders the vehicle of this house carries out.
    fn connect(&self, state: &State, dialogue: Dialogue) -> Result<Dialogue, Error> {
        match &self.wheels {
            Wheels::Simulated { .. } => Ok(dialogue),
            Wheels::Robot { address, patience } => {
                let robot = address.connect(state.world()?, *patience).map_err(Box::new)?;
                let robot: Box<dyn Vehicle + Send> = Box::new(robot);
                Ok(dialogue.driving(robot))
            }
        }
    }

    /// Stops a task that is driven, for a reason.
    pub(super) fn stop_for(&self, id: u64, why: &str) {
        if let Some(running) = self.book().running.as_mut().filter(|running| running.id == id) {
            running.stop.raise();
            running.why.get_or_insert_with(|| why.to_owned());
        }
    }

    /// Whether who has the robot driven is still there.
    pub(super) fn is_leased(&self) -> bool {
        let mut book = self.book();
        let is_leased = book.is_leased();
        if !is_leased && let Some(running) = &mut book.running {
            running.why.get_or_insert_with(|| "lease".to_owned());
        }
        is_leased
    }
}

impl From<Leased> for Declined {
    fn from(Leased { holder, seconds }: Leased) -> Self {
        Self::Leased { holder, seconds }
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
    /// What was noted so far.
    kept: Arc<Mutex<After>>,
    failure: Arc<Mutex<Option<String>>>,
    /// The plans still to come to which alone was agreed; none where any will do.
    agreed: Option<VecDeque<Value>>,
}

impl<'t> Drive<'t> {
    fn new(tasks: &'t Tasks, task: &Task, stop: Stop) -> Self {
        let (events, told) = (TaskEvents::default(), Instant::now());
        let (id, clock, passed) = (task.id, None, 0.0);
        let (kept, failure) = Default::default();
        let agreed = task.is_strict.then(|| rehearsal::plans_of(&task.plan).cloned().collect());
        Self { tasks, id, stop, events, clock, passed, told, kept, failure, agreed }
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
                        self.note_so_far(report);
                    }
                    _ => {}
                }
                if let Some(view) = self.events.of(world, progress) {
                    if matches!(progress, Progress::Planned(_))
                        && let Some(agreed) = &mut self.agreed
                        && agreed.pop_front().as_ref() != Some(&view)
                    {
                        self.tasks.stop_for(self.id, "another plan");
                    }
                    let view = views::of_task(view, Some(self.id));
                    self.tasks.events.tell("directive", &view);
                    if let Progress::Barred { answer, .. } = progress {
                        answer.set(self.tasks.ask_to_clear(self.id, &self.stop, &view));
                    }
                }
            }
            Event::Replied(Reply { outcome: Outcome::Task(task), .. }) => {
                let Some(mut after) = task.after.clone() else { return };
                let (kept, at) = (Arc::clone(&self.kept), std::time::SystemTime::now().into());
                let noted = self.tasks.desk.ask_from_thread(move |engine| {
                    // What each directive did is noted already.
                    let kept =
                        std::mem::take(&mut *kept.lock().unwrap_or_else(PoisonError::into_inner));
                    after.moved.retain(|id, seen| kept.moved.get(id) != Some(seen));
                    engine.remember_after(&after, at)
                });
                let failure = match noted {
                    Ok(Ok(())) => {
                        self.tasks.events.tell("known", &views::known_changed(Some(self.id)));
                        return;
                    }
                    Ok(Err(error)) => error.to_string(),
                    Err(_gone) => "the engine has stopped".to_owned(),
                };
                *self.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(failure);
            }
            _ => {}
        }
    }

    /// Has the writer note what a directive changed; the robot does not wait for it.
    fn note_so_far(&self, report: &Report) {
        let (after, kept, failure) =
            (report.after.clone(), Arc::clone(&self.kept), Arc::clone(&self.failure));
        let (events, id) = (Arc::clone(&self.tasks.events), self.id);
        self.tasks.desk.send(move |engine| {
            let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
            match engine.remember_so_far(&after, &mut kept) {
                Ok(true) => {
                    Some(Box::new(move || events.tell("known", &views::known_changed(Some(id)))))
                }
                Ok(false) => None,
                Err(error) => {
                    *failure.lock().unwrap_or_else(PoisonError::into_inner) =
                        Some(error.to_string());
                    None
                }
            }
        });
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
        self.tasks.events.robot_is(views::robot(engine, moment));
    }

    /// Lets the vehicle's time pass by the clock; told to stop, it waits no more.
    fn wait(&self, seconds: f64) {
        // A robot of its own takes its own time; whether somebody drives is looked at all the same.
        let seconds = match self.tasks.wheels {
            Wheels::Simulated { pace } => seconds / pace,
            Wheels::Robot { .. } => 0.0,
        };
        let Ok(whole) = Duration::try_from_secs_f64(seconds.max(0.0)) else { return };
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
