//! `ortho replay`: a recording of a mission told again.

use std::time::Duration;

use crate::engine::{Recording, json};
use crate::recording::{Played, Told};
use crate::units::{Timestamp, told};

use super::args::{Common, ReplayArgs};
use super::fault::Failure;
use super::notes::{note_cut, seconds};
use super::{Answer, say};

/// Tells a recording again, and where it was cut off.
pub(super) fn run(common: &Common, args: &ReplayArgs) -> Result<Answer, Failure> {
    let played = Recording::read(&args.file)?;
    let Played { about, told, cut, .. } = &played;
    let begun = told.first().map_or(0, |first| first.time);
    if !common.json {
        let domain = about.get("domain").map_or("", String::as_str);
        let at = Timestamp((begun / 1_000_000) as i64).in_words();
        say(&told!(common.lang.language(), "recording-of", domain, at))?;
    }
    let mut before = begun;
    for one in told {
        let Some(line) = line(common, one, begun) else { continue };
        if let Some(pace) = args.pace {
            let seconds = one.time.saturating_sub(before) as f64 / 1e9 / pace;
            std::thread::sleep(Duration::try_from_secs_f64(seconds).unwrap_or_default());
        }
        before = one.time;
        say(&line)?;
    }
    if common.json {
        let cut = cut.as_ref().map(|cut| cut.say(common.lang.language()));
        let whole = json::told_to_its_end(seconds(played.end(), begun), cut);
        return say(&whole.to_string());
    }
    note_cut(common, &played);
    Ok(Answer::Yes)
}

/// Of a message what is told; nothing of one that is drawn.
fn line(common: &Common, told: &Told, begun: u64) -> Option<String> {
    let is_event = ["/directives", "/surprises", "/tasks"].contains(&told.topic.as_str());
    match common.json {
        true if is_event => told
            .value
            .is_object()
            .then(|| json::told_again(&told.value, seconds(told.time, begun)).to_string()),
        false if told.topic == "/words" => {
            let text = told.value["message"].as_str()?;
            let mark = if told.value["name"] == "operator" { "> " } else { "" };
            Some(format!(
                "{:>7.1}  {mark}{}",
                seconds(told.time, begun),
                text.replace('\n', "\n         ")
            ))
        }
        _ => None,
    }
}
