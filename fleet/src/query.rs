//! Questions in the rules' language over all buildings, run by the database.
//!
//! ```text
//! ?- IS_A(X, "Кружка"), ON_TOP_OF(X, Y), IS_A(Y, "Стол"), !CLOSE_TO(X, Z), X != Y.
//! ```
//! The relations are those that are derived, by their English names, between two things of one building; `IS_A(X, kind)`
//! and `HAS:property(X, value)` beside them. Every premise is a row of `fleet.fact` of the same robot of the same building.
//! A variable of a negated premise alone stands for anything; `_` does so everywhere.
//!
//! **Invariant**: a question's text reaches the database as parameters only.

use std::collections::BTreeMap;

use deadpool_postgres::Transaction;
use nom::branch::alt;
use nom::bytes::complete::{tag, take_while1};
use nom::character::complete::{char, multispace0};
use nom::combinator::{map, opt, value};
use nom::multi::separated_list1;
use nom::sequence::{delimited, preceded};
use nom::{IResult, Parser};
use tokio_postgres::types::ToSql;

use crate::error::{FleetError, Result};
use crate::units::said;

/// A variable, a name, or anything.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Term {
    Variable(String),
    Name(String),
    Any,
}

/// One condition of a question.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Premise {
    Fact { relation: String, terms: Vec<Term>, negated: bool },
    Compared { left: Term, right: Term, same: bool },
}

/// A question: all of its conditions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Question {
    pub premises: Vec<Premise>,
}

/// The rows of an answer: building, robot, then the variables.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub struct Table {
    pub columns: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

/// Rows of an answer at most.
const MOST_ROWS: usize = 100_000;
/// Premises of a question at most.
const MOST_PREMISES: usize = 20;

fn spaced<'a, T>(
    inner: impl Parser<&'a str, Output = T, Error = nom::error::Error<&'a str>>,
) -> impl Parser<&'a str, Output = T, Error = nom::error::Error<&'a str>> {
    delimited(multispace0, inner, multispace0)
}

fn word(text: &str) -> IResult<&str, &str> {
    take_while1(|c: char| c.is_alphanumeric() || c == '_' || c == ':').parse(text)
}

fn term(text: &str) -> IResult<&str, Term> {
    let quoted = delimited(char('"'), opt(take_while1(|c| c != '"')), char('"'));
    alt((
        map(quoted, |name: Option<&str>| Term::Name(name.unwrap_or_default().to_owned())),
        map(word, |word| match word {
            "_" => Term::Any,
            word => Term::Variable(word.to_owned()),
        }),
    ))
    .parse(text)
}

fn premise(text: &str) -> IResult<&str, Premise> {
    let terms = delimited(char('('), separated_list1(char(','), spaced(term)), char(')'));
    let not = map(opt(alt((value((), char('!')), value((), tag("not "))))), |n| n.is_some());
    let fact = map((spaced(not), word, multispace0, terms), |(negated, relation, _, terms)| {
        Premise::Fact { relation: relation.to_owned(), terms, negated }
    });
    let compared = map(
        (term, spaced(alt((value(false, tag("!=")), value(true, tag("="))))), term),
        |(left, same, right)| Premise::Compared { left, right, same },
    );
    alt((fact, compared)).parse(text)
}

impl Question {
    /// Reads a question; the `?-` before it and the full stop behind it may be missing.
    ///
    /// # Errors
    /// [`FleetError::Content`] with what could not be read.
    pub fn parse(text: &str) -> Result<Self> {
        let bad = |rest: &str| FleetError::content(said!("question-unreadable-at", rest));
        let whole = text.trim();
        let mut reading =
            preceded(opt(spaced(tag("?-"))), separated_list1(char(','), spaced(premise)));
        let (rest, premises) = reading.parse(whole).map_err(|error| match error {
            nom::Err::Error(e) | nom::Err::Failure(e) => bad(e.input),
            nom::Err::Incomplete(_) => bad(""),
        })?;
        if !rest.trim().trim_end_matches('.').is_empty() {
            return Err(bad(rest));
        }
        if premises.len() > MOST_PREMISES {
            return Err(FleetError::content(said!("too-many-premises", most = MOST_PREMISES)));
        }
        Ok(Self { premises })
    }

    /// The question in SQL, with its parameters and the names of its columns.
    ///
    /// # Errors
    /// [`FleetError::Content`]: nothing but negations, a comparison of what no premise binds, or too many places.
    pub fn to_sql(&self) -> Result<(String, Vec<String>, Vec<String>)> {
        let mut sql = Sql::default();
        let facts = |wanted: bool| {
            self.premises.iter().filter_map(move |premise| match premise {
                Premise::Fact { relation, terms, negated } if *negated == wanted => {
                    Some((relation, terms))
                }
                _ => None,
            })
        };
        for (relation, terms) in facts(false) {
            sql.fact(relation, terms)?;
        }
        if sql.tables.is_empty() {
            return Err(FleetError::content(said!("one-premise-must-affirm")));
        }
        for (relation, terms) in facts(true) {
            sql.no_fact(relation, terms)?;
        }
        for premise in &self.premises {
            if let Premise::Compared { left, right, same } = premise {
                let (left, right) = (sql.compared(left)?, sql.compared(right)?);
                sql.conditions.push(format!("{left} {} {right}", if *same { "=" } else { "<>" }));
            }
        }
        let mut columns = vec!["building".to_owned(), "robot".to_owned()];
        let mut chosen = vec!["f0.building::text".to_owned(), "f0.robot::text".to_owned()];
        for name in &sql.order {
            columns.push(name.clone());
            chosen.push(sql.bound[name].clone());
        }
        let text = format!(
            "SELECT DISTINCT {} FROM {} WHERE {} ORDER BY {} LIMIT {}",
            chosen.join(", "),
            sql.tables.join(", "),
            sql.conditions.join(" AND "),
            (1..=chosen.len()).map(|n| n.to_string()).collect::<Vec<_>>().join(", "),
            MOST_ROWS + 1
        );
        Ok((text, sql.parameters, columns))
    }

    /// Runs it under what the transaction may see.
    ///
    /// # Errors
    /// [`FleetError::Content`], [`FleetError::Database`].
    pub async fn run(&self, transaction: &Transaction<'_>) -> Result<Table> {
        let (text, parameters, columns) = self.to_sql()?;
        let given: Vec<&(dyn ToSql + Sync)> =
            parameters.iter().map(|p| p as &(dyn ToSql + Sync)).collect();
        let found = transaction.query(&text, &given).await?;
        if found.len() > MOST_ROWS {
            return Err(FleetError::content(said!("too-many-answers", most = MOST_ROWS)));
        }
        let row = |row: &tokio_postgres::Row| {
            (0..columns.len()).map(|at| row.try_get::<_, String>(at)).collect::<Result<_, _>>()
        };
        let rows = found.iter().map(row).collect::<Result<Vec<Vec<String>>, _>>()?;
        Ok(Table { columns, rows })
    }
}

#[derive(Default)]
struct Sql {
    tables: Vec<String>,
    conditions: Vec<String>,
    parameters: Vec<String>,
    bound: BTreeMap<String, String>,
    order: Vec<String>,
}

const PLACES: [&str; 2] = ["subject", "object"];

impl Sql {
    fn parameter(&mut self, text: &str) -> String {
        self.parameters.push(text.replace('\0', "\u{2400}"));
        format!("${}", self.parameters.len())
    }

    fn check(relation: &str, terms: &[Term]) -> Result<()> {
        match terms.len() {
            1 | 2 => Ok(()),
            n => Err(FleetError::content(said!("one-place-or-two", relation, n))),
        }
    }

    fn fact(&mut self, relation: &str, terms: &[Term]) -> Result<()> {
        Self::check(relation, terms)?;
        let alias = format!("f{}", self.tables.len());
        let name = self.parameter(relation);
        self.conditions.push(format!("{alias}.relation = {name} AND {alias}.revision_to IS NULL"));
        if !self.tables.is_empty() {
            self.conditions
                .push(format!("{alias}.building = f0.building AND {alias}.robot = f0.robot"));
        }
        self.tables.push(format!("fleet.fact {alias}"));
        for (place, term) in PLACES.iter().zip(terms) {
            let column = format!("{alias}.{place}");
            match term {
                Term::Any => {}
                Term::Name(name) => {
                    let name = self.parameter(name);
                    self.conditions.push(format!("{column} = {name}"));
                }
                Term::Variable(variable) => match self.bound.get(variable) {
                    Some(other) => self.conditions.push(format!("{column} = {other}")),
                    None => {
                        self.bound.insert(variable.clone(), column);
                        self.order.push(variable.clone());
                    }
                },
            }
        }
        Ok(())
    }

    fn no_fact(&mut self, relation: &str, terms: &[Term]) -> Result<()> {
        Self::check(relation, terms)?;
        let name = self.parameter(relation);
        let mut inner = format!(
            "n.building = f0.building AND n.robot = f0.robot AND n.relation = {name} AND n.revision_to IS NULL"
        );
        let mut own = BTreeMap::<&str, String>::new();
        for (place, term) in PLACES.iter().zip(terms) {
            let column = format!("n.{place}");
            let same = match term {
                Term::Any => continue,
                Term::Name(name) => self.parameter(name),
                Term::Variable(v) => match self.bound.get(v).or_else(|| own.get(v.as_str())) {
                    Some(other) => other.clone(),
                    None => {
                        own.insert(v, column);
                        continue;
                    }
                },
            };
            inner += &format!(" AND {column} = {same}");
        }
        self.conditions.push(format!("NOT EXISTS (SELECT FROM fleet.fact n WHERE {inner})"));
        Ok(())
    }

    fn compared(&mut self, term: &Term) -> Result<String> {
        match term {
            Term::Name(name) => Ok(self.parameter(name)),
            Term::Variable(v) => {
                let unbound = || FleetError::content(said!("bound-by-no-premise", name = v));
                self.bound.get(v).cloned().ok_or_else(unbound)
            }
            Term::Any => Err(FleetError::content(said!("anything-is-not-compared"))),
        }
    }
}
