//! Plans as text, in the format that plan validators read; [`super::replay`] checks such a text.
//!
//! `0: (move ball1 rooma roomb)` – the number is the parallel step. A name with blanks stands in double quotes.

use std::fmt::{self, Write};
use std::path::Path;

use miette::SourceSpan;

use super::error::{RuleError, RuleFault, RuleFaults};
use super::load::read_source;
use super::pddl::{Expression, expressions};
use super::task::{OperatorId, Task};
use crate::units::Source;

/// An action of a plan text and where it stands.
#[derive(Debug, Clone)]
pub struct Directive {
    pub step: u32,
    pub action: String,
    pub args: Vec<String>,
    pub(super) at: SourceSpan,
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

    /// Reads `step: (action object …)`; without numbers each action is a step of its own.
    ///
    /// # Errors
    /// All places where the text is no plan.
    pub fn parse(source: &Source) -> Result<Self, RuleFaults> {
        let mut directives = Vec::new();
        let mut faults = Vec::new();
        let mut time = None;
        for expression in expressions(source)? {
            let at = expression.span();
            match &expression {
                Expression::Word(word, _) => match word.trim_end_matches(':').parse::<f64>() {
                    Ok(number) if (0.0..1e9).contains(&number) => {
                        time = Some(number.floor() as u32)
                    }
                    // `[1]`, the duration that some planners add.
                    _ if word.starts_with('[') => {}
                    _ => faults.push(syntax(source, "«шаг: (действие объект …)»", word, at)),
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
                        Some([action, args @ ..]) => directives.push(Directive {
                            step: time.take().unwrap_or(directives.len() as u32),
                            action: action.clone(),
                            args: args.to_vec(),
                            at,
                        }),
                        _ => faults.push(syntax(source, "«(действие объект …)»", "список", at)),
                    }
                }
            }
        }
        directives.sort_by_key(|directive| directive.step);
        if faults.is_empty() {
            Ok(Self { source: source.clone(), directives })
        } else {
            Err(RuleFaults(faults))
        }
    }
}

fn quoted(name: &str) -> String {
    if name.contains([' ', '(', ')', ';']) { format!("\"{name}\"") } else { name.to_owned() }
}

fn syntax(source: &Source, expected: &str, found: &str, at: SourceSpan) -> RuleFault {
    let found = format!("«{}»", found.chars().take(40).collect::<String>());
    RuleFault::new(source, RuleError::Syntax { expected: expected.to_owned(), found, at })
}
