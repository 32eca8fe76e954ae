//! `ortho ask`: one question, one answer.

use serde_json::{Value, json};

use crate::engine::{Engine, Memory, Unanswered};
use crate::language::question::{Answer, Said};

use super::args::{AskArgs, Common};
use super::commands::open;
use super::fault::Failure;
use super::{Answer as Outcome, say};

pub(super) fn run(common: &Common, args: &AskArgs) -> Result<Outcome, Failure> {
    answer(common, &open(common)?, &args.question, args.explain)
}

pub(super) fn answer(
    common: &Common,
    engine: &Engine,
    question: &str,
    explain: bool,
) -> Result<Outcome, Failure> {
    let mut memory = Memory::speaking(common.lang.language());
    match engine.ask(question, &mut memory)? {
        Ok(answer) => {
            if common.json {
                say(&view(engine, &answer)?.to_string())?;
            } else {
                say(&answer.text)?;
                if explain {
                    say(&explained(engine, &answer)?)?;
                }
            }
            let is_no = matches!(answer.said, Said::No | Said::Nothing | Said::Unknown);
            Ok(if is_no { Outcome::No } else { Outcome::Yes })
        }
        Err(unanswered) => {
            let text = match common.json {
                true => doubt(&unanswered).to_string(),
                false => unanswered.text,
            };
            say(&text)?;
            Ok(Outcome::Wrong)
        }
    }
}

/// The rule, and below it the proof of each fact.
pub(super) fn explained(engine: &Engine, answer: &Answer) -> Result<String, Failure> {
    let mut lines = vec![engine.rule_of(answer)?];
    for fact in answer.facts.iter().take(3) {
        let sign = if fact.holds { "" } else { "!" };
        lines.push(format!("{sign}{}({})", fact.relation, fact.args.join(", ")));
        let proof = engine.proof_of(fact, answer.language)?;
        lines.extend(proof.into_iter().map(|line| format!("    {line}")));
    }
    Ok(lines.join("\n"))
}

/// The answer as data: outcome, query, bindings, facts.
pub(super) fn view(engine: &Engine, answer: &Answer) -> Result<Value, Failure> {
    let mut facts = Vec::new();
    for fact in answer.facts.iter().take(20) {
        facts.push(json!({
            "relation": fact.relation,
            "args": fact.args,
            "holds": fact.holds,
            "proof": engine.proof_of(fact, answer.language)?,
        }));
    }
    Ok(json!({
        "outcome": answer.said.word(),
        "kind": answer.query.kind(),
        "rule": engine.rule_of(answer)?,
        "bindings": answer.symbols,
        "number": answer.number,
        "facts": facts,
        "text": answer.text,
    }))
}

pub(super) fn doubt(unanswered: &Unanswered) -> Value {
    json!({
        "outcome": unanswered.doubt.kind(),
        "candidates": unanswered.names,
        "text": unanswered.text,
    })
}
