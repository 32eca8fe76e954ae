//! `ortho talk`: a dialogue on the terminal, or over lines from a pipe.
//!
//! A line that begins with a verb of command is a task; every other line is a question. `.rule` before a line shows
//! the query behind it; an empty line, `выход`, `exit` or the end of input ends the dialogue.

use std::io::{BufRead, IsTerminal};

use rustyline::completion::Completer;
use rustyline::error::ReadlineError;
use rustyline::highlight::Highlighter;
use rustyline::hint::Hinter;
use rustyline::history::MemHistory;
use rustyline::validate::Validator;
use rustyline::{Config, Context, Editor, Helper};
use serde_json::json;

use crate::engine::{Engine, Error, Memory, TaskAnswer, task_in_words};
use crate::language::Language;
use crate::language::command::{
    Command, Misheard, has_verb, in_time, is_order, is_too_long, likely_verb,
};
use crate::language::question::{Conditional, conditional, sentences};
use crate::units::name_key;

use super::args::{Common, Lang};
use super::ask::{doubt, explained, view};
use super::commands::open;
use super::fault::Failure;
use super::{Answer, demo, say};

pub(super) fn run(common: &Common) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let keeps = !common.read_only && common.as_of.is_none();
    let mut dialogue = Dialogue {
        engine,
        memory: Memory::speaking(common.lang.language()),
        offered: None,
        awaited: false,
        refusal: None,
        json: common.json,
        keeps,
    };
    if std::io::stdin().is_terminal() {
        return on_terminal(common, &mut dialogue);
    }
    for line in std::io::stdin().lock().split(b'\n') {
        let Ok(line) = line else { break };
        let line = String::from_utf8_lossy(&line);
        if !dialogue.hear(line.trim())? {
            break;
        }
    }
    Ok(Answer::Yes)
}

fn on_terminal(common: &Common, dialogue: &mut Dialogue) -> Result<Answer, Failure> {
    let config = Config::builder().auto_add_history(true).build();
    let terminal = |e: &ReadlineError| Failure::output(&std::io::Error::other(e.to_string()));
    let mut editor: Editor<Names, MemHistory> =
        Editor::with_history(config, MemHistory::new()).map_err(|e| terminal(&e))?;
    let names = dialogue.engine.names()?;
    editor.set_helper(Some(Names { names }));
    say(common.lang.pick(
        "Спрашивайте или приказывайте; Tab дополняет имена, пустая строка – конец.",
        "Ask or command; Tab completes names, an empty line ends.",
    ))?;
    let mut interrupted = false;
    loop {
        let read = editor.readline("> ");
        // Once drops the line that was begun, twice ends.
        if matches!(read, Err(ReadlineError::Interrupted)) && !interrupted {
            interrupted = true;
            say(common
                .lang
                .pick("Ещё раз Ctrl-C или Ctrl-D – конец.", "Ctrl-C again or Ctrl-D ends."))?;
            continue;
        }
        interrupted = false;
        match read {
            Ok(line) if line.trim().is_empty() => break,
            // What is pasted may be several lines.
            Ok(text) => {
                for line in text.lines() {
                    if !dialogue.hear(line.trim())? {
                        return Ok(Answer::Yes);
                    }
                }
            }
            Err(ReadlineError::Eof | ReadlineError::Interrupted) => break,
            // What was typed is no UTF-8: another line may be.
            Err(ReadlineError::Io(e)) if e.kind() == std::io::ErrorKind::InvalidData => {
                say(common.lang.pick(
                    "Эта строка записана не в UTF-8, прочесть её нельзя.",
                    "This line is no UTF-8 and cannot be read.",
                ))?;
            }
            Err(e) => return Err(terminal(&e)),
        }
    }
    Ok(Answer::Yes)
}

/// One dialogue and what was said in it.
struct Dialogue {
    engine: Engine,
    memory: Memory,
    /// A line with its verb put right, until the person says that it was meant.
    offered: Option<String>,
    /// Whether such a line waited for the person when this one was said.
    awaited: bool,
    /// Why the last line was not carried out, until another one is answered.
    refusal: Option<String>,
    json: bool,
    /// A store that is only read keeps nothing.
    keeps: bool,
}

impl Dialogue {
    /// Answers a line; false when it ends the dialogue.
    fn hear(&mut self, line: &str) -> Result<bool, Failure> {
        let (line, shows) = match line.strip_prefix(".rule") {
            Some(rest) => (rest.trim(), true),
            None => (line, false),
        };
        match line {
            "" => return Ok(true),
            "выход" | "exit" | "quit" | "конец" => return Ok(false),
            _ => {}
        }
        if is_too_long(line) {
            return self.answer(line, shows).map(|()| true);
        }
        let offered = self.offered.take();
        self.awaited = offered.is_some();
        if let Some(reason) = self.refusal.take().filter(|_| is_why(line)) {
            let text = match Language::of(line) {
                Language::Russian => format!("Вот причина: {reason}"),
                Language::English => format!("The reason: {reason}"),
            };
            return self.put("found", &text).map(|()| true);
        }
        if let Some(meant) = offered.filter(|_| is_yes(line)) {
            return self.command(&meant).map(|()| true);
        }
        if let Some(whole) = self.engine.resumed(line, &self.memory)? {
            return self.command(&whole).map(|()| true);
        }
        if let Some(line) = in_time(line).filter(|line| is_order(line)) {
            return self.command(&line).map(|()| true);
        }
        if let Some(conditional) = conditional(line) {
            return self.if_so(&conditional, shows).map(|()| true);
        }
        // «Где пульт? Принеси его.»: a question and a command.
        let parts = sentences(line);
        if parts.len() > 1 && self.engine.is_command(parts.last().copied().unwrap_or_default())? {
            let (order, before) = parts.split_last().expect("there are several");
            let mut heard = Vec::new();
            for part in before {
                // "I am thirsty. Bring me a cup.": what asks nothing and commands nothing is let pass.
                let asked = part.ends_with('?') || self.engine.is_command(part)?;
                if asked || self.engine.ask(part, &mut self.memory.clone())?.is_ok() {
                    heard.push((*part).to_owned());
                }
            }
            heard.push((*order).to_owned());
            return self.hear_each(&heard, shows).map(|()| true);
        }
        if let Some(parts) = self.engine.parts_of(line)? {
            return self.hear_each(&parts, shows).map(|()| true);
        }
        self.hear_one(line, shows).map(|()| true)
    }

    /// Orders and questions of one line: none is begun where another cannot be followed.
    fn hear_each(&mut self, parts: &[String], shows: bool) -> Result<(), Failure> {
        if parts.len() > 1
            && let Err(error) = self.engine.read_ahead(parts, &self.memory)
        {
            let language = Language::of(&parts.join(" "));
            return match error {
                Error::Misheard(misheard) => {
                    let text = misheard.say(language);
                    self.refusal = Some(text.clone());
                    self.put("misheard", &text)
                }
                other => self.refuse(&other, language),
            };
        }
        parts.iter().try_for_each(|part| self.hear_one(part, shows))
    }

    /// What is found out is told, and what then is to be done follows.
    fn if_so(&mut self, conditional: &Conditional, shows: bool) -> Result<(), Failure> {
        if let Some(first) = &conditional.first {
            self.hear_one(first, shows)?;
        }
        let (holds, answer) = match self.engine.holds(conditional, &mut self.memory)? {
            Ok(found) => found,
            Err(unanswered) => {
                let text = conditional.unwatched().unwrap_or(&unanswered.text);
                return self.put("not_understood", text);
            }
        };
        self.put("found", &answer.text)?;
        let order = if holds { &conditional.then } else { &conditional.otherwise };
        match order {
            Some(order) => self.hear(order).map(|_| ()),
            // What was waited for is so.
            None if holds && conditional.waits => Ok(()),
            None => self.put("waiting", conditional.undone()),
        }
    }

    fn hear_one(&mut self, line: &str, shows: bool) -> Result<(), Failure> {
        // "I need to read something. Where are the books?" asks, whatever is said before.
        let asks = match &sentences(line)[..] {
            [_, .., last] => last.ends_with('?') && !self.engine.is_command(last)?,
            _ => false,
        };
        // "Two spoons to the table, please" asks nothing, though a question may begin so.
        let please = |word: &str| matches!(name_key(word).as_str(), "please" | "пожалуйста");
        let words = || line.split(|c: char| !c.is_alphanumeric());
        let begs = !asks
            && !line.contains('?')
            && words().any(please)
            && !self.engine.asks_something(line)?;
        if !asks && self.engine.is_command(line)? || begs && self.engine.orders_tersely(line)? {
            return self.command(line);
        }
        self.answer(line, shows)
    }

    /// Answers a question, or carries out what proves to be none.
    fn answer(&mut self, line: &str, shows: bool) -> Result<(), Failure> {
        match self.engine.ask(line, &mut self.memory)? {
            Ok(answer) if self.json => {
                say(&view(&self.engine, &answer)?.to_string())?;
            }
            Ok(answer) => {
                say(&answer.text)?;
                if shows {
                    say(&explained(&self.engine, &answer)?)?;
                }
            }
            Err(unanswered) => {
                // «Дверь-ВZ закрой»: no question, but a command with its verb behind.
                let kind = unanswered.doubt.kind();
                if is_too_long(line) {
                    return self.put(kind, &unanswered.text);
                }
                let not_understood = kind != "ambiguous" && !line.contains('?');
                // What the map lacks is an answer to a question, whatever its words are like.
                let asked = kind == "unknown" && self.engine.asks_something(line)?;
                let heard = || self.engine.understand_in(line, &mut self.memory.clone());
                let commands = || match heard() {
                    // A question with such a verb in it stays a question.
                    Err(Error::Misheard(Misheard::NotUnderstood { .. })) => false,
                    Err(_) => has_verb(line),
                    Ok(_) => true,
                };
                // «Дойдёшь ли ты до спальни?» asks, whatever its verb.
                let asks = line.split_whitespace().nth(1).is_some_and(|word| word == "ли");
                let orders = not_understood && !asks;
                if orders && (commands() || self.engine.orders_tersely(line)?) {
                    return self.command(line);
                }
                if let Some((at, verb)) = likely_verb(line).filter(|_| !asked) {
                    let said = &line[at.clone()];
                    let text = match Language::of(line) {
                        Language::Russian => {
                            format!("Я не понимаю слова «{said}». Может быть, «{verb}»?")
                        }
                        Language::English => {
                            format!(
                                "I do not understand the word \"{said}\". Do you mean \"{verb}\"?"
                            )
                        }
                    };
                    let mut meant = line.to_owned();
                    meant.replace_range(at, verb);
                    self.offered = Some(meant);
                    return self.put("not_understood", &text);
                }
                say(&match self.json {
                    true => doubt(&unanswered).to_string(),
                    false => unanswered.text,
                })?;
            }
        }
        Ok(())
    }

    fn command(&mut self, line: &str) -> Result<(), Failure> {
        let language = Language::of(line);
        let lang = if language == Language::Russian { Lang::Ru } else { Lang::En };
        let waited = self.memory.awaits_reply() || self.awaited;
        let commands = match self.engine.understand_in(line, &mut self.memory) {
            Ok(commands) => commands,
            Err(Error::Misheard(misheard)) => {
                let text = misheard.say(language);
                self.refusal = Some(text.clone());
                return self.put("misheard", &text);
            }
            Err(other) => return self.refuse(&other, language),
        };
        match &commands[..] {
            [Command::Stop] => return self.stop(waited, lang),
            [Command::Wait] => return self.put("waiting", lang.pick("Жду.", "I am waiting.")),
            [Command::ComeBack] => {
                let text = lang.pick(
                    "Я ещё никуда не уезжал. Скажите, куда ехать.",
                    "I have not been sent anywhere yet. Say where to go.",
                );
                return self.put("refused", text);
            }
            [Command::Report] => {
                let asked = lang.pick("Где ты?", "Where are you?");
                let text = match self.engine.ask(asked, &mut self.memory)? {
                    Ok(answer) => answer.text,
                    Err(unanswered) => unanswered.text,
                };
                return self.put("reported", &text);
            }
            _ => {}
        }
        // A task that cannot be done is an answer within a dialogue, not its end.
        if self.json {
            return match self.engine.carry_out(&commands, &mut |_| {}) {
                Ok(answer) => {
                    self.remember(line, &answer)?;
                    say(&super::json::task(self.engine.world()?, &answer).to_string()).map(|_| ())
                }
                Err(error) => self.refuse(&error, language),
            };
        }
        match demo::carry_out(&self.engine, &commands, lang) {
            Ok(answer) => self.remember(line, &answer),
            Err(Failure::Engine(error)) => self.refuse(&error, language),
            Err(failure) => Err(failure),
        }
    }

    /// Nothing is under way between two lines; what waited for an answer is dropped.
    fn stop(&mut self, waited: bool, lang: Lang) -> Result<(), Failure> {
        self.memory.forget_reply();
        let text = match waited {
            true => lang.pick("Хорошо, отменено.", "All right, that is cancelled."),
            false => lang.pick(demo::NOTHING_TO_STOP[0], demo::NOTHING_TO_STOP[1]),
        };
        self.put("stopped", text)
    }

    fn refuse(&mut self, error: &Error, language: Language) -> Result<(), Failure> {
        let text = error.say(self.engine.world()?, language);
        self.refusal = Some(text.clone());
        self.put("refused", &text)
    }

    fn remember(&mut self, line: &str, answer: &TaskAnswer) -> Result<(), Failure> {
        self.memory.did(task_in_words(self.engine.world()?, line, answer));
        if self.keeps {
            self.engine.remember(answer, std::time::SystemTime::now().into())?;
        }
        Ok(())
    }

    fn put(&self, outcome: &str, text: &str) -> Result<(), Failure> {
        match self.json {
            true => say(&json!({ "outcome": outcome, "text": text }).to_string()),
            false => say(text),
        }
        .map(|_| ())
    }
}

fn is_why(line: &str) -> bool {
    let key = name_key(line.trim_matches(|c: char| !c.is_alphanumeric()));
    matches!(key.as_str(), "почему" | "а почему" | "почему нет" | "почему же" | "why" | "why not")
}

fn is_yes(line: &str) -> bool {
    let key = name_key(line.trim_matches(|c: char| !c.is_alphanumeric()));
    matches!(
        key.as_str(),
        "да" | "ага" | "верно" | "конечно" | "yes" | "yeah" | "yep" | "sure" | "right"
    )
}

/// Completes names of the map.
struct Names {
    names: Vec<String>,
}

impl Completer for Names {
    type Candidate = String;

    fn complete(
        &self,
        line: &str,
        pos: usize,
        _: &Context<'_>,
    ) -> rustyline::Result<(usize, Vec<String>)> {
        /// Words of the longest name.
        const WORDS: usize = 6;
        let before = &line[..pos];
        let begins = before.match_indices([' ', '«', '"', ',']).map(|(at, mark)| at + mark.len());
        let starts: Vec<usize> = std::iter::once(0).chain(begins).collect();
        // The more words of a name stand there the surer is what is meant: «письменный с» is no «Спальня».
        for &start in &starts[starts.len().saturating_sub(WORDS)..] {
            let typed = name_key(&before[start..]);
            let fits = |name: &&String| !typed.is_empty() && name_key(name).starts_with(&typed);
            let found: Vec<String> = self.names.iter().filter(fits).take(40).cloned().collect();
            if !found.is_empty() {
                return Ok((start, found));
            }
        }
        Ok((pos, Vec::new()))
    }
}

impl Hinter for Names {
    type Hint = String;
}
impl Highlighter for Names {}
impl Validator for Names {}
impl Helper for Names {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_more_words_of_a_name_stand_there_the_surer_it_is() {
        let names = ["Письменный стол", "Спальня", "Стол-1"].map(String::from).to_vec();
        let (names, history) = (Names { names }, MemHistory::new());
        let complete = |line: &str| {
            let (start, found) = names.complete(line, line.len(), &Context::new(&history)).unwrap();
            (line[start..].to_owned(), found.join(", "))
        };
        let pair = |typed: &str, found: &str| (typed.to_owned(), found.to_owned());
        assert_eq!(complete("Где письменный с"), pair("письменный с", "Письменный стол"));
        assert_eq!(complete("Где с"), pair("с", "Спальня, Стол-1"));
        assert_eq!(complete("Где "), pair("", ""));
    }
}
