//! A dialogue: whatever a person says, heard against what was said before.
//!
//! ```
//! use orthoframe::{Engine, World};
//! use orthoframe::engine::Dialogue;
//! # let map = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/rb2.toml");
//! let mut engine = Engine::in_memory(World::load(map).unwrap(), None)?;
//! let mut dialogue = Dialogue::default();
//! for line in ["Где лекарство?", "Поезжай туда", "Почему Книга-4 на Столе-1?"] {
//!     println!("{}", dialogue.hear(&mut engine, line, &mut |_, _| {})?.text());
//! }
//! # Ok::<(), orthoframe::engine::Error>(())
//! ```
//!
//! A line is, in this order: an aside (yes, why, the end), the reply for which an order waits, an order under a
//! condition, several orders and questions, one order, or a question. All parts of a line are read before the first is
//! begun, and what is ordered behind an order that failed is not begun.
//!
//! # Invariants
//!
//! - Every face hears and answers by this; no face has words of its own for it.
//! - What is remembered belongs to a revision of the map: see [`Engine::ask`].

mod command;
mod heard;
mod offered;
mod order;
mod substitute;
mod waiting;

pub use heard::{Event, Heard, Outcome, Reply};
use offered::{Offered, chosen};
pub(crate) use waiting::queue_in_words;

use crate::language::Language;
use crate::language::command::{
    Command, Misheard, has_verb, in_time, is_order, is_too_long, likely_verb, waiting,
    whither_alone,
};
use crate::language::question::{
    Aside, Conditional, Corrected, Doubt, Memory, Unanswered, another_and_order, aside,
    asks_whether, begs, behind_no, conditional, hinged, sentences, unaddressed, unbegged,
};
use crate::map::{Entity, World};
use crate::robot::Vehicle;
use crate::store::StoreError;
use crate::units::{Stop, told};

use super::narration::nothing_to_stop;
use super::task::{OPERATOR, Progress};
use super::{After, Engine, Error, QueuedTask};

/// How whoever speaks is told what happens, as it happens.
pub(super) type Tell<'t> = dyn FnMut(&Engine, &Event<'_>) + 't;

/// What was said so far, and what waits for an answer.
#[derive(Debug)]
pub struct Dialogue {
    memory: Memory,
    /// What may have been meant, until the person says so.
    offered: Option<Offered>,
    /// The order that asked back last.
    open: Option<String>,
    /// The order before this line that lacked nothing but whither something goes.
    unplaced: Option<String>,
    /// Why the last line was not carried out, until another one is answered.
    refusal: Option<String>,
    /// The language of what has no words, and of tasks given by [`Dialogue::order`].
    language: Language,
    keeps: bool,
    wheels: Wheels,
    stop: Stop,
}

/// Where an order comes from.
enum Given {
    /// It was said just now.
    Now,
    /// It waited.
    Before(QueuedTask),
}

/// What carries out the orders of a dialogue.
enum Wheels {
    /// The simulated robot, in a world that is as it is believed to be.
    Simulated,
    /// The simulated robot, in a world that may differ from what it believes.
    InTruth(Box<World>),
    Vehicle(Box<dyn Vehicle + Send>),
}

impl std::fmt::Debug for Wheels {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Simulated => "Simulated",
            Self::InTruth(_) => "InTruth",
            Self::Vehicle(_) => "Vehicle",
        })
    }
}

impl Default for Dialogue {
    fn default() -> Self {
        Self::new(Language::default())
    }
}

impl Dialogue {
    /// Nothing was said yet. Each line is answered in its own language, and what has no words in this one.
    #[must_use]
    pub fn new(language: Language) -> Self {
        Self {
            memory: Memory::speaking(language),
            offered: None,
            open: None,
            unplaced: None,
            refusal: None,
            language,
            keeps: true,
            wheels: Wheels::Simulated,
            stop: Stop::new(),
        }
    }

    /// What is done leaves no trace in the store: it is only read.
    #[must_use]
    pub fn keeping_nothing(self) -> Self {
        Self { keeps: false, ..self }
    }

    /// Another dialogue that begins where this one is, with the simulated robot, and leaves this one as it is: what a line
    /// would come to, before it is meant. It keeps what it does, as a new one.
    #[must_use]
    pub fn apart(&self) -> Self {
        Self {
            memory: self.memory.clone(),
            offered: self.offered.clone(),
            open: self.open.clone(),
            unplaced: self.unplaced.clone(),
            refusal: self.refusal.clone(),
            language: self.language,
            keeps: true,
            wheels: Wheels::Simulated,
            stop: Stop::new(),
        }
    }

    /// The simulated robot drives in a world that may differ from what it believes, and leaves it as it then is.
    #[must_use]
    pub fn in_truth(self, truth: World) -> Self {
        Self { wheels: Wheels::InTruth(Box::new(truth)), ..self }
    }

    /// This vehicle carries out the orders, in place of the simulated robot.
    #[must_use]
    pub fn driving(self, vehicle: Box<dyn Vehicle + Send>) -> Self {
        Self { wheels: Wheels::Vehicle(vehicle), ..self }
    }

    /// Raised, by another thread or a signal, it ends the order that is under way, and each that follows until another
    /// is given here.
    pub fn stopped_by(&mut self, stop: Stop) {
        self.stop = stop;
    }

    /// What was spoken of.
    #[must_use]
    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    /// Hears a line, whatever it is, and does what it asks and orders.
    ///
    /// # Errors
    /// There is no map, or the disk refused. What is not understood or cannot be done is an outcome.
    pub fn hear(
        &mut self,
        engine: &mut Engine,
        text: &str,
        tell: &mut Tell<'_>,
    ) -> Result<Heard, Error> {
        engine.pass_time(std::time::SystemTime::now().into());
        let mut hearing = Hearing { dialogue: self, engine, tell, heard: Heard::default() };
        match hearing.hear(text.trim()) {
            // Not for ever: the dialogue goes on.
            Err(error @ Error::Store(StoreError::Locked { .. })) => {
                hearing.refuse(error, Language::of(text))?;
            }
            heard => heard?,
        }
        Ok(hearing.heard)
    }

    /// Has an order wait.
    ///
    /// # Errors
    /// As [`Dialogue::hear`].
    pub fn later(
        &mut self,
        engine: &mut Engine,
        task: &str,
        tell: &mut Tell<'_>,
    ) -> Result<Heard, Error> {
        let language = self.language;
        let mut hearing = Hearing { dialogue: self, engine, tell, heard: Heard::default() };
        hearing.wait(task, language)?;
        Ok(hearing.heard)
    }

    /// Does what waits, in the order of the shortest way, until nothing waits or the robot is stopped.
    ///
    /// # Errors
    /// As [`Dialogue::hear`].
    pub fn go_on(&mut self, engine: &mut Engine, tell: &mut Tell<'_>) -> Result<Heard, Error> {
        let language = self.language;
        let mut hearing = Hearing { dialogue: self, engine, tell, heard: Heard::default() };
        hearing.go_on(language)?;
        Ok(hearing.heard)
    }

    /// Hears a question, and nothing else: no order is carried out.
    ///
    /// # Errors
    /// As [`Dialogue::hear`].
    pub fn ask(&mut self, engine: &Engine, question: &str) -> Result<Reply, Error> {
        Ok(match engine.ask(question, &mut self.memory)? {
            Ok(answer) => Reply::answer(answer),
            Err(unanswered) => self.offer_questions(engine, question, unanswered)?,
        })
    }

    /// Hears what is meant as an order, and is told of in the dialogue's language: a question in it is answered, but
    /// nothing waits for a reply.
    ///
    /// # Errors
    /// As [`Dialogue::hear`].
    pub fn order(
        &mut self,
        engine: &mut Engine,
        task: &str,
        tell: &mut Tell<'_>,
    ) -> Result<Heard, Error> {
        let mut hearing = Hearing { dialogue: self, engine, tell, heard: Heard::default() };
        hearing.order(task)?;
        Ok(hearing.heard)
    }
}

impl Reply {
    fn answer(answer: crate::language::question::Answer) -> Self {
        let (text, language) = (answer.text.clone(), answer.language);
        Self { outcome: Outcome::Answered(Box::new(answer)), text, language }
    }

    fn unanswered(unanswered: Unanswered) -> Self {
        let (text, language) = (unanswered.text.clone(), unanswered.language);
        Self { outcome: Outcome::Unanswered(Box::new(unanswered)), text, language }
    }
}

/// A line on its way to what comes of it.
struct Hearing<'h, 't> {
    dialogue: &'h mut Dialogue,
    engine: &'h mut Engine,
    tell: &'h mut Tell<'t>,
    heard: Heard,
}

impl Hearing<'_, '_> {
    fn hear(&mut self, line: &str) -> Result<(), Error> {
        if line.is_empty() {
            return Ok(());
        }
        match self.engine.corrected(line, &self.dialogue.memory)? {
            Some(Corrected::Meant(meant)) => return self.hear(&meant),
            Some(Corrected::Cancelled) => return self.stop(true, Language::of(line)),
            Some(Corrected::Unclear(_)) => return self.command(line, false),
            None => {}
        }
        let line = unbegged(&unaddressed(line)).to_owned();
        let line = &*line;
        let said = aside(line);
        if said == Some(Aside::End) {
            return self.put(Outcome::Ended, "", self.dialogue.language);
        }
        if is_too_long(line) {
            return self.ask(line);
        }
        if let Err(error) = self.engine.without_another(line) {
            return self.refuse(error, self.spoken(line));
        }
        if let (Some(order), Some(place)) = (self.dialogue.unplaced.take(), whither_alone(line)) {
            let whole = format!("{} {place}", order.trim_end_matches(['.', '!', ' ']));
            if self.engine.understand_in(&whole, &mut self.dialogue.memory.clone()).is_ok() {
                return self.obey(&whole, true);
            }
        }
        let offered = self.dialogue.offered.take();
        let order_waits = matches!(offered, Some(Offered::Order(_)));
        let awaited = order_waits || self.dialogue.memory.awaits_reply();
        let refusal = self.dialogue.refusal.take();
        let language = self.spoken(line);
        match (said, refusal, offered) {
            (Some(Aside::Why), Some(reason), _) => {
                let text = told!(language, "the-reason", reason);
                return self.put(Outcome::Reason, &text, language);
            }
            (Some(Aside::Yes), _, Some(Offered::Order(meant))) => return self.obey(&meant, true),
            (_, _, Some(Offered::Questions(all))) if let Some(meant) = chosen(line, said, &all) => {
                return self.ask(&meant);
            }
            (Some(Aside::No), _, offered) if awaited || offered.is_some() => {
                return self.stop(true, language);
            }
            _ => {}
        }
        if let Some(said) = waiting(line)
            && self.of_waiting(said, awaited, language)?
        {
            return Ok(());
        }
        if has_verb(line) && !line.contains('?') {
            match self.engine.with_pointed(line, &self.dialogue.memory)? {
                Ok(None) => {}
                Ok(Some(named)) => return self.hear(&named),
                Err(unanswered) => {
                    return self.refuse(Misheard::NoneSuch(unanswered).into(), language);
                }
            }
        }
        if let Some(whole) = self.engine.resumed(line, &self.dialogue.memory)? {
            return self.obey(&whole, awaited);
        }
        if let Some([other, order]) = another_and_order(line) {
            self.hear(&other)?;
            let told = self.heard.replies.last().map(|reply| &reply.outcome);
            let is_done = matches!(told, Some(Outcome::Task(task)) if task.ending.is_done());
            return if is_done { self.hear(&order) } else { self.not_begun(&order) };
        }
        // "No, put the other one there" amends nothing, and is an order of its own.
        if let Some(order) = behind_no(line).filter(|order| !order.contains('?') && has_verb(order))
            && (is_order(order)
                || self.engine.understand_in(order, &mut self.dialogue.memory.clone()).is_ok())
        {
            return self.hear(order);
        }
        if let (Some(Aside::Yes | Aside::No), false) = (said, awaited) {
            let text = told!(language, "i-asked-nothing-ask-or");
            return self.put(Outcome::NothingOffered, &text, language);
        }
        if self.headed(line)? {
            return Ok(());
        }
        if let Some(line) =
            in_time(line, &self.engine.rules.paraphrases()).filter(|line| is_order(line))
        {
            return self.command(&line, awaited);
        }
        if let Some(conditional) = conditional(line) {
            return self.if_so(&conditional);
        }
        // «Где пульт? Принеси его.»: a question and a command.
        let parts = sentences(line);
        if let Some((order, before)) = parts.split_last().filter(|(_, before)| !before.is_empty())
            && self.engine.is_command(order)?
            && !self.engine.asks_by_a_word(order)?
        {
            let mut heard = Vec::new();
            for part in before {
                // "I am thirsty. Bring me a cup.": what asks nothing and commands nothing is let pass.
                let asked = part.ends_with('?') || self.engine.is_command(part)?;
                if asked || self.engine.ask(part, &mut self.dialogue.memory.clone())?.is_ok() {
                    heard.push((*part).to_owned());
                }
            }
            heard.push((*order).to_owned());
            return self.hear_each(&heard, awaited);
        }
        if let Some(parts) = self.engine.parts_of(line, &self.dialogue.memory)? {
            return self.hear_each(&parts, awaited);
        }
        self.hear_one(line, awaited)
    }

    /// Orders and questions of one line: none is begun where another cannot be followed.
    fn hear_each(&mut self, parts: &[String], awaited: bool) -> Result<(), Error> {
        if parts.len() > 1
            && let Err(error) = self.engine.read_ahead(parts, &self.dialogue.memory)
        {
            self.leave_order()?;
            self.dialogue.memory.forget_reply();
            let line = parts.join(" ");
            let language = Language::of(&line);
            return match self.offer_core(&line, &error, language)? {
                true => Ok(()),
                false => self.refuse(error, language),
            };
        }
        for part in parts {
            if self.has_failed() && self.engine.is_command(part)? {
                self.not_begun(part)?;
            } else if let Some(whole) = self.engine.resumed(part, &self.dialogue.memory)? {
                self.obey(&whole, awaited)?;
            } else {
                self.hear_one(part, awaited)?;
            }
        }
        Ok(())
    }

    /// What is found out is told, and what then is to be done follows.
    fn if_so(&mut self, conditional: &Conditional) -> Result<(), Error> {
        if let Some(first) = &conditional.first {
            self.hear_one(first, false)?;
            if self.has_failed() {
                let parts = [&conditional.then, &conditional.otherwise, &conditional.also];
                return parts.into_iter().flatten().try_for_each(|part| self.not_begun(part));
            }
        }
        let (holds, answer) = match self.engine.holds(conditional, &mut self.dialogue.memory)? {
            Ok(found) => found,
            Err(unanswered) => {
                self.condition_unknown(conditional, unanswered)?;
                return conditional.also.iter().try_for_each(|also| self.not_begun(also));
            }
        };
        let (text, language) = (answer.text.clone(), answer.language);
        self.put(Outcome::Condition { holds, answer: Box::new(answer) }, &text, language)?;
        let order = if holds { &conditional.then } else { &conditional.otherwise };
        match order {
            Some(order) => self.hear(order)?,
            // What was waited for is so.
            None if holds && conditional.waits => {}
            None => self.put(Outcome::Waiting, conditional.undone(), language)?,
        }
        match &conditional.also {
            Some(also) if self.has_failed() => self.not_begun(also),
            Some(also) => self.hear(also),
            None => Ok(()),
        }
    }

    fn hear_one(&mut self, line: &str, awaited: bool) -> Result<(), Error> {
        if hinged(line).is_some() {
            return self.command(line, awaited);
        }
        // "I need to read something. Where are the books?" asks, whatever is said before.
        let asks = match &sentences(line)[..] {
            [_, .., last] => {
                last.ends_with('?')
                    && (!self.engine.is_command(last)? || self.engine.asks_by_a_word(last)?)
            }
            _ => {
                self.engine.asks_behind_what_is_told(line, &self.dialogue.memory)?
                    || self.engine.asks_by_a_word(line)?
            }
        };
        // "Two spoons to the table, please" asks nothing, though a question may begin so.
        let begs =
            !asks && !line.contains('?') && begs(line) && !self.engine.asks_something(line)?;
        if !asks && self.engine.is_command(line)? || begs && self.engine.orders_tersely(line)? {
            return self.command(line, awaited);
        }
        self.answer(line, awaited)
    }

    /// Answers a question, or carries out what proves to be none.
    fn answer(&mut self, line: &str, awaited: bool) -> Result<(), Error> {
        let asked_back = !self.dialogue.memory.asked_about().is_empty();
        let unanswered = match self.engine.ask(line, &mut self.dialogue.memory)? {
            Ok(answer) => return self.reply(Reply::answer(answer)),
            Err(unanswered) => unanswered,
        };
        // A question that asks back in its turn is the one to which the next line replies.
        if asked_back
            && self.dialogue.memory.asked_about().is_empty()
            && let Some(order) = self.dialogue.open.take()
        {
            self.not_begun(&order)?;
        }
        // «Дверь-ВZ закрой»: no question, but a command with its verb behind.
        let kind = unanswered.doubt.kind();
        let not_understood = kind != "ambiguous" && !line.contains('?');
        // What the map lacks is an answer to a question, whatever its words are like.
        let asked = kind == "unknown" && self.engine.asks_something(line)?;
        let heard = || self.engine.understand_in(line, &mut self.dialogue.memory.clone());
        let commands = || match heard() {
            // A question with such a verb in it stays a question.
            Err(Error::Misheard(Misheard::NotUnderstood { .. })) => false,
            Err(_) => has_verb(line),
            Ok(_) => true,
        };
        // «Дойдёшь ли ты до спальни?» asks, whatever its verb.
        let asks = self.engine.asks_by_a_word(line)?;
        // A name alone that answers nothing of what was asked back orders nothing either.
        let answers = asked_back && !has_verb(line) && !begs(line);
        let orders = not_understood && !asks_whether(line) && !asks && !answers;
        if orders && (commands() || self.engine.orders_tersely(line)?) {
            return self.command(line, awaited);
        }
        // «Эти вещи белые?», where nothing was spoken of, has no word that is not known.
        let read = matches!(unanswered.doubt, Doubt::NoReferent { .. });
        let Some((at, verb)) = likely_verb(line).filter(|_| !asked && !asks && !read) else {
            let reply = self.dialogue.offer_questions(self.engine, line, unanswered)?;
            return self.reply(reply);
        };
        let (said, language) = (&line[at.clone()], Language::of(line));
        let text = told!(language, "do-you-mean", said, verb);
        let mut order = line.to_owned();
        order.replace_range(at, verb);
        self.dialogue.offered = Some(Offered::Order(order.clone()));
        self.put(Outcome::Offered { order }, &text, language)
    }

    /// A question alone, whatever it may order.
    fn ask(&mut self, line: &str) -> Result<(), Error> {
        let reply = self.dialogue.ask(self.engine, line)?;
        self.reply(reply)
    }

    /// A task that cannot be done is an answer within a dialogue, not its end. The robot does not set out where what it
    /// does could not be noted.
    fn carry_out(
        &mut self,
        line: &str,
        commands: &[Command<Entity>],
        given: &Given,
        language: Language,
    ) -> Result<(), Error> {
        if self.dialogue.keeps {
            self.engine.set_out()?;
        }
        let done = self.carry_out_alone(line, commands, given, language);
        if self.dialogue.keeps {
            self.engine.come_back();
        }
        done
    }

    fn carry_out_alone(
        &mut self,
        line: &str,
        commands: &[Command<Entity>],
        given: &Given,
        language: Language,
    ) -> Result<(), Error> {
        let noted = match given {
            Given::Now if self.is_paused()? => return self.wait(line, language),
            Given::Now => self.note(line, commands)?,
            Given::Before(_) => None,
        };
        let person = match given {
            Given::Before(task) => task.from,
            Given::Now => None,
        };
        let state = self.engine.state()?;
        let world = state.world()?;
        let keeps = self.dialogue.keeps && self.engine.is_kept();
        let (engine, tell) = (&mut *self.engine, &mut *self.tell);
        let (mut kept, mut failed) = (After::default(), None);
        let mut told = |progress: &Progress<'_>| {
            if let (true, Progress::Finished(report)) = (keeps, progress)
                && let Err(error) = engine.remember_so_far(&report.after, &mut kept)
            {
                failed.get_or_insert(error);
            }
            tell(engine, &Event::Progress { progress, world, language });
        };
        let stop = &self.dialogue.stop;
        let told: &mut dyn FnMut(&Progress<'_>) = &mut told;
        let carried_out = match &mut self.dialogue.wheels {
            Wheels::Simulated => state.simulator(None).and_then(|mut robot| {
                state.carry_out_for(commands, person, &mut robot, told, stop)
            }),
            Wheels::InTruth(truth) => {
                let mut robot = state.simulator(Some(World::clone(truth)))?;
                let carried_out = state.carry_out_for(commands, person, &mut robot, told, stop);
                **truth = robot.into_truth();
                carried_out
            }
            Wheels::Vehicle(vehicle) => {
                state.carry_out_for(commands, person, &mut **vehicle, told, stop)
            }
        };
        if let Some(error) = failed {
            return Err(error);
        }
        let carried_out = carried_out.map(|mut task| {
            if let Some(after) = &mut task.after {
                after.moved.retain(|id, seen| kept.moved.get(id) != Some(seen));
            }
            task
        });
        let ended = match carried_out {
            Ok(task) => self.done(line, task, None, language),
            Err(error) => self.refuse_order(line, error, language),
        };
        ended?;
        if let Some(id) = noted {
            self.engine.drop_queued(id, OPERATOR)?;
        }
        Ok(())
    }

    fn done(
        &mut self,
        line: &str,
        task: super::TaskAnswer,
        text: Option<&str>,
        language: Language,
    ) -> Result<(), Error> {
        let ending = match text {
            Some(text) => text.to_owned(),
            None => self.engine.ending_in_words(&task, language)?,
        };
        if !task.ending.is_done() {
            self.dialogue.refusal = Some(ending.clone());
        }
        self.dialogue.memory.did(task.in_words(self.engine.world()?, line));
        self.put(Outcome::Task(Box::new(task)), &ending, language)?;
        let done = self.heard.replies.last().map(|reply| &reply.outcome);
        if let (true, Some(Outcome::Task(task))) = (self.dialogue.keeps, done) {
            self.engine.remember(task, std::time::SystemTime::now().into())?;
        }
        Ok(())
    }

    /// Nothing is under way between two lines; what waited for an answer is dropped.
    fn stop(&mut self, waited: bool, language: Language) -> Result<(), Error> {
        self.dialogue.memory.forget_reply();
        let text = match waited {
            true => told!(language, "all-right-that-is-cancelled"),
            false => nothing_to_stop(language),
        };
        self.put(Outcome::Stopped { waited }, &text, language)
    }

    fn refuse(&mut self, error: Error, language: Language) -> Result<(), Error> {
        let (outcome, text) = match error {
            Error::Misheard(misheard) => {
                let text = misheard.say(language);
                (Outcome::Misheard(Box::new(misheard)), text)
            }
            other => {
                let text = other.say(language);
                (Outcome::Refused(Box::new(other)), text)
            }
        };
        self.dialogue.refusal = Some(text.clone());
        self.put(outcome, &text, language)
    }

    /// An order that lacks nothing but whither something goes can be completed by a place.
    fn refuse_order(&mut self, line: &str, error: Error, language: Language) -> Result<(), Error> {
        self.dialogue.unplaced = error.asks_whither().then(|| line.to_owned());
        self.refuse(error, language)
    }

    fn not_begun(&mut self, order: &str) -> Result<(), Error> {
        let (language, said) = (self.spoken(order), order.trim_end_matches('.'));
        let text = told!(language, "not-begun", said);
        self.put(Outcome::NotBegun { order: order.to_owned() }, &text, language)
    }

    /// Whether an order of this line has failed.
    fn has_failed(&self) -> bool {
        self.heard.replies.iter().any(|reply| reply.outcome.has_failed())
    }

    /// The language of a line; of one without words, that of the dialogue.
    fn spoken(&self, line: &str) -> Language {
        match line.chars().any(char::is_alphabetic) {
            true => Language::of(line),
            false => self.dialogue.language,
        }
    }

    fn put(&mut self, outcome: Outcome, text: &str, language: Language) -> Result<(), Error> {
        self.reply(Reply { outcome, text: text.to_owned(), language })
    }

    #[expect(clippy::unnecessary_wraps, reason = "what is put is the end of many a fallible way")]
    fn reply(&mut self, reply: Reply) -> Result<(), Error> {
        (self.tell)(self.engine, &Event::Replied(&reply));
        self.heard.replies.push(reply);
        Ok(())
    }
}
