//! Plans as text, in the format that plan validators read; [`super::replay`] checks such a text.
//!
//! `0: (move ball1 rooma roomb)` – the number is the parallel step. A name with blanks stands in double quotes.

use std::fmt::{self, Write};
use std::path::Path;

use miette::SourceSpan;

use super::error::RuleError;
use super::expression::{Expression, expressions};
use super::fault::{RuleFault, RuleFaults};
use super::load::read_source;
use super::task::{OperatorId, Task};
use crate::units::{Bilingual, InOrder as _, Piece, Source, word};

/// An action of a plan text and where it stands.
#[derive(Debug, Clone)]
pub struct Directive {
    pub step: u32,
    pub action: String,
    pub args: Vec<String>,
    pub(super) at: SourceSpan,
    /// Where each of the arguments stands.
    pub(super) args_at: Vec<SourceSpan>,
}

/// As the paper prints a directive.
impl fmt::Display for Directive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}_({})", self.action.trim_end_matches('_'), self.args.join(", "))
    }
}

/// A plan that was read.
#[derive(Debug, Clone)]
pub struct PlanText {
    pub(super) source: Source,
    /// In the order of their steps.
    pub directives: Vec<Directive>,
}

impl PlanText {
    /// Writes parallel steps of operators.
    #[must_use]
    pub fn write(task: &Task, steps: &[Vec<OperatorId>]) -> String {
        let mut text = String::new();
        let mut cost = 0;
        for (step, operators) in steps.iter().enumerate() {
            for &id in operators {
                let operator = task.operator(id);
                cost += u64::from(operator.cost);
                let names = std::iter::once(&operator.name).chain(&operator.args);
                let words: Vec<String> = names.map(|name| quoted(name)).collect();
                writeln!(text, "{step}: ({})", words.join(" ")).expect("a string takes all text");
            }
        }
        writeln!(text, "; cost = {cost}").expect("a string takes all text");
        text
    }

    /// # Errors
    /// The file cannot be read or holds no plan.
    pub fn read(path: &Path) -> Result<Self, RuleFaults> {
        Self::parse(&read_source(path)?)
    }

    /// Reads `step: (action object …)`; without numbers each action is a step of its own. Where times are told apart
    /// by fractions, as 0.001 and 0.002, each time is a step.
    ///
    /// # Errors
    /// All places where the text is no plan.
    pub fn parse(source: &Source) -> Result<Self, RuleFaults> {
        let mut directives = Vec::new();
        let mut times = Vec::new();
        let mut faults = Vec::new();
        let mut time = None;
        let (expressions, broken) = expressions(source);
        faults.extend(broken);
        for expression in expressions {
            let at = expression.span();
            match &expression {
                Expression::Word(word, _) => match word.trim_end_matches(':').parse::<f64>() {
                    Ok(number) if (0.0..1e9).contains(&number) => {
                        time = Some(number);
                    }
                    // `[1]`, the duration that some planners add.
                    _ if word.starts_with('[') && word.ends_with(']') => {}
                    _ => faults.push(syntax(source, STEP, word, at)),
                },
                Expression::List(items, _) => {
                    let words: Option<Vec<String>> = items
                        .iter()
                        .map(|item| match item {
                            Expression::Word(word, _) => Some((*word).to_owned()),
                            Expression::List(..) => None,
                        })
                        .collect();
                    match words.as_deref() {
                        Some([action, args @ ..]) => {
                            times.push(time.take().unwrap_or(directives.len() as f64));
                            let (action, args) = (action.clone(), args.to_vec());
                            let args_at = items[1..].iter().map(Expression::span).collect();
                            directives.push(Directive { step: 0, action, args, at, args_at });
                        }
                        _ => faults.push(syntax(source, ACTION, "(…)", at)),
                    }
                }
            }
        }
        for (directive, step) in directives.iter_mut().zip(steps(&times)) {
            directive.step = step;
        }
        directives.order_by_key(|directive| directive.step);
        if faults.is_empty() {
            Ok(Self { source: source.clone(), directives })
        } else {
            Err(RuleFaults(faults))
        }
    }
}

/// The step of each time: its whole part, or its rank where whole parts would throw different times together.
fn steps(times: &[f64]) -> Vec<u32> {
    let mut distinct = times.to_vec();
    distinct.sort_by(f64::total_cmp);
    distinct.dedup();
    let whole = |time: f64| time.floor() as u32;
    let is_told_apart = distinct.windows(2).all(|pair| whole(pair[0]) < whole(pair[1]));
    let rank = |time: &f64| distinct.partition_point(|earlier| earlier < time) as u32;
    times.iter().map(|time| if is_told_apart { whole(*time) } else { rank(time) }).collect()
}

/// A name that is not one word to whoever reads the plan stands in quotes: in «», where it has others within.
fn quoted(name: &str) -> String {
    let is_sign = |c: char| c.is_whitespace() || "()\";«»".contains(c);
    match name.contains('"') {
        true => format!("«{name}»"),
        false if name.contains(is_sign) => format!("\"{name}\""),
        false => name.to_owned(),
    }
}

const STEP: Piece = word!("step-action-object");
const ACTION: Piece = word!("action-object");

fn syntax(source: &Source, expected: Piece, found: &str, at: SourceSpan) -> RuleFault {
    let found = Bilingual::quoted(&found.chars().take(40).collect::<String>());
    RuleFault::new(source, RuleError::Syntax { expected: expected.into(), found, at })
}
