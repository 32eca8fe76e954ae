//! `ortho query '?- ON_TOP_OF(X, "Стол-1"), way_length("Точка-А", X, D).order D.limit 3'`: a question in the rules' language.

use super::args::{Common, QueryArgs};
use super::fault::Failure;
use super::opened::open;
use super::why::Names;
use super::{Answer, say};
use crate::facts::Limits;
use crate::units::told;

/// Runs the command; no answer at all is "no".
pub(super) fn run(common: &Common, args: &QueryArgs) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let all = Limits::default();
    let limits = Limits {
        time: args.time_limit.unwrap_or(all.time),
        memory_bytes: args.memory_limit.map_or(all.memory_bytes, |mib| mib.saturating_mul(1 << 20)),
        rows: args.row_limit.unwrap_or(all.rows),
        ..all
    };
    let answer = engine.query_within(&args.question, args.explain, limits)?;
    let outcome = if answer.rows.is_empty() { Answer::No } else { Answer::Yes };
    let (names, language) = (Names::of(&engine, common.lang)?, common.lang.language());
    if common.json {
        let view = super::json::query(&engine, &answer, args.explain, language)?;
        say(&view.to_string())?;
        return Ok(outcome);
    }
    if !answer.unknown.is_empty() {
        let (open, close) = language.pick(("«", "»"), ("“", "”"));
        let texts: Vec<String> =
            answer.unknown.iter().map(|text| format!("{open}{text}{close}")).collect();
        let text = told!(common.lang.language(), "no-fact-holds-this");
        super::notes::note(&format!("{}: {text}", texts.join(", ")));
    }
    let mut lines = Vec::new();
    match (answer.columns.is_empty(), answer.rows.is_empty()) {
        (true, false) => lines.push(told!(common.lang.language(), "yes")),
        (true, true) => lines.push(told!(common.lang.language(), "no")),
        (false, true) => {
            lines.push(told!(common.lang.language(), "no-answers"));
        }
        (false, false) => {
            let mut table = super::text::table();
            table.set_header(&answer.columns);
            for row in &answer.rows {
                table.add_row(row.iter().map(|value| engine.value_in_words(value, language)));
            }
            lines.push(table.to_string());
        }
    }
    lines.extend(
        answer.proofs.iter().map(|proof| names.translate(&proof.to_string()).trim_end().to_owned()),
    );
    say(&lines.join("\n\n"))?;
    Ok(outcome)
}
