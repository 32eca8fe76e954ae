//! `ortho talk`: a dialogue on the terminal, or over lines from a pipe.
//!
//! What a line is, a question, an order or both, the [`Dialogue`] tells. `.rule` before a line shows the query behind it; an
//! empty line, a word of leave or the end of input ends the dialogue. Between two lines other programs may write the store.

use std::io::{BufRead, IsTerminal};

use crate::engine::{Dialogue, Engine, queue_in_words};
use crate::units::{name_key, told};
use rustyline::completion::Completer;
use rustyline::error::ReadlineError;
use rustyline::highlight::Highlighter;
use rustyline::hint::Hinter;
use rustyline::history::MemHistory;
use rustyline::validate::Validator;
use rustyline::{Config, Context, Editor, Helper};

use super::args::Common;
use super::fault::Failure;
use super::opened::open_held;
use super::teller::{RecordArgs, Teller};
use super::{Answer, say};

pub(super) fn run(common: &Common, record: &RecordArgs) -> Result<Answer, Failure> {
    let mut engine = open_held(common)?;
    let mut dialogue = Dialogue::new(common.lang.language());
    if common.read_only || common.as_of.is_some() {
        dialogue = dialogue.keeping_nothing();
    }
    let waiting = engine.queue()?;
    if !waiting.tasks.is_empty() && !common.json {
        say(&queue_in_words(&waiting, common.lang.language()))?;
    }
    engine.put_down();
    // Of a pipe the next line is the next order, and no answer.
    let is_attended = std::io::stdin().is_terminal();
    let teller = Teller::of_dialogue(common, record.begin(&engine)?).attended(is_attended);
    let mut talk = Talk { engine, dialogue, teller };
    if is_attended {
        let answer = on_terminal(common, &mut talk)?;
        return talk.teller.close().map(|()| answer);
    }
    for line in std::io::stdin().lock().split(b'\n') {
        let Ok(line) = line else { break };
        let line = String::from_utf8_lossy(&line);
        if !talk.hear(line.trim())? {
            break;
        }
    }
    talk.teller.close()?;
    Ok(Answer::Yes)
}

fn on_terminal(common: &Common, talk: &mut Talk) -> Result<Answer, Failure> {
    let config = Config::builder().auto_add_history(true).build();
    let terminal = |e: &ReadlineError| Failure::output(&std::io::Error::other(e.to_string()));
    let mut editor: Editor<Names, MemHistory> =
        Editor::with_history(config, MemHistory::new()).map_err(|e| terminal(&e))?;
    let names = talk.engine.names()?;
    editor.set_helper(Some(Names { names }));
    say(&told!(common.lang.language(), "talk-begins"))?;
    let mut interrupted = false;
    loop {
        let read = editor.readline("> ");
        // Once drops the line that was begun, twice ends.
        if matches!(read, Err(ReadlineError::Interrupted)) && !interrupted {
            interrupted = true;
            say(&told!(common.lang.language(), "ctrl-c-again"))?;
            continue;
        }
        interrupted = false;
        match read {
            Ok(line) if line.trim().is_empty() => break,
            // What is pasted may be several lines.
            Ok(text) => {
                for line in text.lines() {
                    if !talk.hear(line.trim())? {
                        return Ok(Answer::Yes);
                    }
                }
            }
            Err(ReadlineError::Eof | ReadlineError::Interrupted) => break,
            // What was typed is no UTF-8: another line may be.
            Err(ReadlineError::Io(e)) if e.kind() == std::io::ErrorKind::InvalidData => {
                say(&told!(common.lang.language(), "line-is-no-text"))?;
            }
            Err(e) => return Err(terminal(&e)),
        }
    }
    Ok(Answer::Yes)
}

/// One dialogue, the store that it is about, and who tells it.
struct Talk {
    engine: Engine,
    dialogue: Dialogue,
    teller: Teller,
}

impl Talk {
    /// Answers a line; false when it ends the dialogue.
    fn hear(&mut self, line: &str) -> Result<bool, Failure> {
        let (line, shows) = match line.strip_prefix(".rule") {
            Some(rest) => (rest.trim(), true),
            None => (line, false),
        };
        let Self { engine, dialogue, teller } = self;
        teller.explains = shows;
        engine.take_up()?;
        let heard = dialogue.hear(engine, line, &mut |engine, event| teller.tell(engine, event));
        engine.put_down();
        let heard = heard?;
        teller.end()?;
        Ok(!heard.ended())
    }
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
