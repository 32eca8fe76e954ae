//! Questions: `?- ON_TOP_OF(X, "Стол-1"), CLOSE_TO(X, Y).`
//!
//! ```text
//! question := statement* asked order? limit? "."?
//! asked    := "?-"? body  |  "?-"? name "(" expressions ")" ":-" body
//! order    := "." "order" variable "desc"? ("," …)*          limit := "." "limit" number
//! ```
//!
//! A question asks for its variables, those whose names start with `_` left out, or for what its head says. Statements
//! before it – declarations, rules, facts – hold for this question alone; they may read every relation of the program
//! and add to none of them. Answers ascend by their columns from the first to the last unless `order` says otherwise.
//!
//! The question becomes one more relation of the program, with the question's own relations before it: nothing is
//! copied but what the question adds.

use std::cell::RefCell;
use std::sync::Arc;

use nom::Parser;
use nom::branch::alt;
use nom::combinator::opt;
use nom::sequence::preceded;

use super::check::{equivalence, limits};
use super::clause::{self, Made};
use super::declare::declare_more;
use super::declared::{Declared, kind_name};
use super::fault::{Faults, Found, RuleError, by_file};
use super::lex::{self, Token, Word};
use super::parse::{atom, disjunction, items_of};
use super::program::{Clause, Kind, Program};
use super::read::{Furthest, Input, Read, list, name, number, sign};
use super::relations::{Column, RelationId, RelationInfo};
use super::strata::strata;
use super::syntax::{self, Item, Rule, Span};
use super::word::Words;
use crate::units::{Source, said, word};

/// The text that facts hold for what a question calls something.
pub type FirstName<'c> = &'c dyn Fn(&str) -> Option<String>;

/// A question about a program, checked.
#[derive(Debug, Clone)]
pub(super) struct Question {
    /// The program with the relations of the question behind its own.
    pub(super) program: Program,
    /// Relations of the program without the question.
    pub(super) known: usize,
    /// The last of the question's relations: its answers.
    pub(super) answer: RelationId,
    /// Columns of the answer to order by, each with whether it descends.
    pub(super) order: Vec<(usize, bool)>,
    pub(super) limit: Option<usize>,
}

impl Program {
    /// Reads a question; `words` are those of what will be asked, and take the question's constants in.
    ///
    /// `more` declares relations that are neither the program's nor the question's.
    pub(super) fn question(
        &self,
        source: &Source,
        more: &[&Source],
        called: FirstName<'_>,
        words: &mut Words,
    ) -> Result<Question, Faults> {
        let mut sources: Vec<Source> = self.sources.to_vec();
        sources.extend(more.iter().copied().cloned());
        sources.push(source.clone());
        let file = sources.len() as u32 - 1;
        let mut faults = Found::default();
        let mut items = Vec::new();
        for (n, more) in more.iter().enumerate() {
            let mut here = Vec::new();
            let file = (self.sources.len() + n) as u32;
            items.extend(super::parse::items(more, file, &mut here));
            faults.all.extend(here.into_iter().map(|fault| (file, fault)));
        }
        let mut here = Vec::new();
        let first = |text: &str| called(text).filter(|_| words.find_symbol(text).is_none());
        let asked = read(source, file, &first, &mut items, &mut here);
        faults.all.extend(here.into_iter().map(|fault| (file, fault)));
        let question =
            asked.and_then(|asked| self.extended(&sources, &items, &asked, words, &mut faults));
        faults.all.retain(|(_, fault)| !fault.is_warning());
        match question {
            Some(question) if faults.all.is_empty() => Ok(question),
            _ => Err(Faults { files: by_file(&sources, faults.all) }),
        }
    }

    fn extended(
        &self,
        sources: &[Source],
        items: &[Item],
        asked: &syntax::Question,
        words: &mut Words,
        faults: &mut Found,
    ) -> Option<Question> {
        let mut declared = Arc::clone(&self.declared);
        if !items.is_empty() {
            declare_more(items, Arc::make_mut(&mut declared), faults);
        }
        let known = self.declared.relations.len();
        let mut made = Made::default();
        let mut clauses = self.own_clauses(items, &declared, words, &mut made, faults);
        let (answers, columns) = clause::asking(asked, &declared, words, &mut made, faults);
        let is_read = |clause: &Clause| {
            let mut all = true;
            super::strata::reads(&clause.body, false, &mut |of, _, at| {
                if declared.unfolded.contains(&of) {
                    let name = &declared.relations[of.index()].name;
                    let what = said!("a-question-of-the-inline-relation", name);
                    let help = word!("remove-inline-such-a-relation-has-no");
                    faults.push(at, RuleError::Unsupported { what, help, at: at.into() });
                    all = false;
                }
            });
            all
        };
        if !clauses.iter().chain(&answers).map(is_read).fold(true, |all, one| all & one) {
            return None;
        }
        let mut infos: Vec<RelationInfo> = declared.relations[known..].to_vec();
        infos.extend(made.relations.into_iter().map(|(info, _)| info));
        let answer = RelationId((known + infos.len()) as u32);
        infos.push(RelationInfo {
            name: "?".to_owned(),
            columns: columns.into_iter().map(|(name, kind)| column(name, kind)).collect(),
            ..RelationInfo::default()
        });
        clauses.extend(made.clauses);
        clauses.extend(answers.into_iter().map(|clause| Clause { head: answer, ..clause }));
        if !faults.all.iter().all(|(_, fault)| fault.is_warning()) {
            return None;
        }
        // What a call derives must not depend on which calls came before.
        let depends = clauses.iter().any(|clause| clause.counts_on())
            || infos.iter().any(|info| !info.choices.is_empty() || info.limit_size.is_some());
        if depends {
            let what = word!("choice-domain-autoinc-or-limitsize-in-a").into();
            let help = word!("put-such-a-relation-into-the-program");
            let at = asked.at;
            faults.push(at, RuleError::Unsupported { what, help, at: at.into() });
            return None;
        }
        let order = order(asked, &infos[infos.len() - 1], faults)?;
        let mut program = self.with(sources, &declared, infos, clauses, faults);
        program.limits = self.limits.within(limits(items, faults));
        Some(Question { program, known, answer, order, limit: asked.limit })
    }

    /// The clauses of the question's own rules.
    fn own_clauses(
        &self,
        items: &[Item],
        declared: &Declared,
        words: &mut Words,
        made: &mut Made,
        faults: &mut Found,
    ) -> Vec<Clause> {
        let known = self.declared.relations.len();
        let closed: Vec<Rule> = items.iter().flat_map(|item| equivalence(item, faults)).collect();
        let mut rules = Vec::new();
        for item in items {
            match item {
                Item::Rule(rule) => rules.push(rule.clone()),
                Item::Type { .. } | Item::Relation { .. } => {}
                Item::Plan { .. } | Item::Pragma { .. } => {}
                other => {
                    let at = other.at();
                    let what = said!("such-a-directive-in-a-question");
                    let help = word!("decl-type-rules-and-facts-serve-in");
                    faults.push(at, RuleError::Unsupported { what, help, at: at.into() });
                }
            }
        }
        rules.extend(closed);
        let (rules, _) = super::inline::unfold(rules, items, declared, faults);
        let mut clauses = Vec::new();
        for rule in &rules {
            for head in &rule.heads {
                let of = declared.names.find(&head.relation.text);
                if of.is_some_and(|of| of.index() < known) {
                    let what = said!("a-rule-of-the-question-for-the", text = head.relation.text);
                    let help = word!("declare-a-relation-of-its-own-in");
                    let at = head.at;
                    faults.push(at, RuleError::Unsupported { what, help, at: at.into() });
                }
            }
            let rule = &super::witness::brought_out(&super::unify::unified(rule));
            clauses.extend(clause::clauses(rule, declared, words, made, faults));
        }
        clauses
    }

    /// The program with more relations and what derives them.
    pub(super) fn with(
        &self,
        sources: &[Source],
        declared: &Arc<Declared>,
        infos: Vec<RelationInfo>,
        clauses: Vec<Clause>,
        faults: &mut Found,
    ) -> Self {
        let mut relations = Vec::clone(&self.relations);
        relations.extend(infos.into_iter().map(Arc::new));
        let more: Vec<Arc<Clause>> = clauses.into_iter().map(Arc::new).collect();
        let mut wide = Declared::default();
        wide.relations.extend(
            relations
                .iter()
                .map(|info| RelationInfo { name: info.name.clone(), ..RelationInfo::default() }),
        );
        let known = self.relations.len();
        let offset = self.clauses.len();
        let mut own = strata(&wide, &more, &[], faults);
        own.retain(|stratum| stratum.relations.iter().any(|of| of.index() >= known));
        for stratum in &mut own {
            stratum.clauses.iter_mut().for_each(|n| *n += offset);
        }
        Self {
            sources: sources.into(),
            relations: Arc::new(relations),
            names: Arc::clone(&self.names),
            clauses: self.clauses.iter().cloned().chain(more).collect(),
            facts: Arc::clone(&self.facts),
            strata: self.strata.iter().cloned().chain(own).collect(),
            subsumptions: Arc::clone(&self.subsumptions),
            limits: self.limits,
            words: self.words.share(),
            warnings: [].into(),
            declared: Arc::clone(declared),
        }
    }
}

pub(super) fn column(name: String, kind: Kind) -> Column {
    Column { name, kind, type_name: kind_name(kind).to_owned() }
}

/// The positions of what the question orders by.
fn order(
    asked: &syntax::Question,
    answer: &RelationInfo,
    faults: &mut Found,
) -> Option<Vec<(usize, bool)>> {
    let mut order = Vec::new();
    for (name, descends) in &asked.order {
        match answer.columns.iter().position(|column| column.name == name.text) {
            Some(at) => order.push((at, *descends)),
            None => {
                let (variable, at) = (name.text.clone(), name.at);
                faults.push(at, RuleError::Ungrounded { variable, at: at.into() });
                return None;
            }
        }
    }
    Some(order)
}

/// The question of a text, and the statements before it.
fn read(
    source: &Source,
    file: u32,
    called: FirstName<'_>,
    items: &mut Vec<Item>,
    faults: &mut Vec<RuleError>,
) -> Option<syntax::Question> {
    let text = source.text();
    let mut words = super::preprocess::expand(lex::words(text, file, faults), source, file, faults);
    for token in &mut words {
        if let Word::Text(text) = &mut token.word
            && let Some(first) = called(text)
        {
            *text = first;
        }
    }
    let at = words.iter().position(|token| token.word == Word::Sign("?-"));
    let (before, asked) = words.split_at(at.unwrap_or(0));
    items.extend(items_of(before, text.len(), file, faults));
    let furthest = RefCell::new(Furthest::default());
    let asked = asked.strip_prefix_sign("?-");
    let input = Input { rest: asked, length: words.len(), furthest: &furthest };
    match question(input, text) {
        Ok((_, question)) => Some(question),
        Err(_) => {
            faults.push(furthest.borrow().describe(asked, file, text.len()));
            None
        }
    }
}

trait StripSign {
    fn strip_prefix_sign(&self, sign: &str) -> &Self;
}

impl StripSign for [Token] {
    fn strip_prefix_sign(&self, sign: &str) -> &Self {
        match self {
            [Token { word: Word::Sign(first), .. }, rest @ ..] if *first == sign => rest,
            all => all,
        }
    }
}

fn question<'a>(input: Input<'a>, text: &str) -> Read<'a, syntax::Question> {
    let start = input.at();
    let headed = (atom, preceded(sign(":-"), disjunction)).map(|(head, body)| (Some(head), body));
    let (rest, (head, body)) = alt((headed, disjunction.map(|body| (None, body)))).parse(input)?;
    let end = last_word(input, rest);
    let (rest, order) = opt(preceded(clause_word("order"), list(key, sign(",")))).parse(rest)?;
    let (rest, limit) = opt(preceded(clause_word("limit"), number)).parse(rest)?;
    let (rest, _) = opt(sign(".")).parse(rest)?;
    if !rest.rest.is_empty() {
        return rest.fail(word!("the-end-of-the-question"));
    }
    let limit = match limit {
        None => None,
        Some((limit, at)) => match usize::try_from(limit) {
            Ok(limit) => Some(limit),
            Err(_) => {
                let text = limit.to_string();
                return rest.refuse(RuleError::Number { text, at: at.into() });
            }
        },
    };
    let question = syntax::Question {
        exprs: head.map(|head| head.args),
        body,
        order: order.unwrap_or_default(),
        limit,
        text: text.to_owned(),
        at: start.to(end),
    };
    Ok((rest, question))
}

/// The place of the last word that was read.
fn last_word(all: Input<'_>, rest: Input<'_>) -> Span {
    let read = all.rest.len() - rest.rest.len();
    all.rest[..read].last().map_or_else(|| all.at(), |token| token.at)
}

// .order
fn clause_word<'a>(word: &'static str) -> impl Fn(Input<'a>) -> Read<'a, ()> {
    move |input| match input.rest {
        [Token { word: Word::Sign("."), .. }, Token { word: Word::Name(found), .. }, rest @ ..]
            if found == word =>
        {
            Ok((Input { rest, ..input }, ()))
        }
        _ => input.fail(match word {
            "order" => word!("order-clause"),
            _ => word!("limit-clause"),
        }),
    }
}

// X desc
fn key(input: Input<'_>) -> Read<'_, (syntax::Name, bool)> {
    let (input, column) = name(input)?;
    match input.rest {
        [Token { word: Word::Name(word), .. }, rest @ ..] if word == "desc" => {
            Ok((Input { rest, ..input }, (column, true)))
        }
        [Token { word: Word::Name(word), .. }, rest @ ..] if word == "asc" => {
            Ok((Input { rest, ..input }, (column, false)))
        }
        _ => Ok((input, (column, false))),
    }
}
