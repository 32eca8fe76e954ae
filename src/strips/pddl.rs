//! Planning problems of other people: PDDL with :adl :derived-predicates :action-costs.
//!
//! Domain and problem become the same [`Document`] that a rule file becomes, and are checked by the same code.
//! Preferences are read in the goal, with weights in the metric. What lies beyond (numbers, constraints, preferences
//! elsewhere) is refused by name and place.

use miette::SourceSpan;

use super::error::RuleError;
use super::expression::{Expression, expressions};
use super::fault::RuleFault;
use super::syntax::{
    ActionText, Amount, Atom, Condition, ConditionalText, CostTerm, Declaration, DerivedText,
    Document, Name, Parameter, Signature, Term, none_of,
};
use crate::units::{Bilingual, Piece, Source, name_key, word};

type Faults = Vec<RuleFault>;

/// Reads a domain or a problem into `document`.
pub(super) fn read(source: &Source, document: &mut Document, faults: &mut Faults) {
    let (expressions, mut brackets) = expressions(source);
    if expressions.is_empty() && brackets.is_empty() {
        let error = RuleError::Empty { path: source.name().to_owned() };
        return faults.push(RuleFault::placeless(error));
    }
    document.types.get_or_insert_default();
    document.predicates_closed = true;
    document.objects_closed = true;
    let unclosed: Vec<usize> = brackets
        .iter()
        .filter_map(|fault| match &*fault.error {
            RuleError::MissingParenthesis { at } => Some(at.offset()),
            _ => None,
        })
        .collect();
    let mut own = Vec::new();
    let mut reader = Reader { source, document, faults: &mut own };
    // What an open bracket does to the rest of its section is no fault of its own.
    let read = |reader: &mut Reader<'_>, section: &Expression<'_>| {
        let before = reader.faults.len();
        reader.section(section);
        if unclosed.contains(&section.span().offset()) {
            reader.faults.truncate(before);
        }
    };
    let mut closed: Option<SourceSpan> = None;
    let mut ended = false;
    for expression in &expressions {
        if expression.head().as_deref() == Some("define") {
            expression.items()[1..].iter().for_each(|section| read(&mut reader, section));
            closed = Some(expression.span());
        } else if let (Some(define), true) = (closed, expression.is_section()) {
            if !ended {
                reader.early_end(define, expression);
            }
            ended = true;
            read(&mut reader, expression);
        } else {
            reader.expected(word!("define-form"), expression.span());
        }
    }
    if ended {
        // The bracket at the end of the text is the one that came too early.
        let surplus = |fault: &RuleFault| matches!(*fault.error, RuleError::Syntax { .. });
        if let Some(at) = brackets.iter().rposition(surplus) {
            brackets.remove(at);
        }
    }
    faults.extend(brackets);
    faults.extend(own);
}

pub(super) struct Reader<'a> {
    pub(super) source: &'a Source,
    pub(super) document: &'a mut Document,
    pub(super) faults: &'a mut Faults,
}

impl Reader<'_> {
    fn section(&mut self, section: &Expression<'_>) {
        let items = section.items();
        match section.head().as_deref() {
            Some(":types") => {
                let types = self.typed(&items[1..]);
                self.document.types.get_or_insert_default().extend(types);
            }
            Some(":constants" | ":objects") => {
                let objects = self.typed(&items[1..]);
                self.document.objects.extend(objects);
            }
            Some(":predicates") => {
                for signature in &items[1..] {
                    let Some((name, rest)) = self.call(signature) else { continue };
                    let args = self.typed(rest).into_iter().map(|arg| arg.kinds).collect();
                    self.document.predicates.push(Signature { name, args });
                }
            }
            Some(":action") => self.action(section),
            Some(":durative-action") => self.durative_action(section),
            Some(":derived") => self.derived(section),
            Some(":init") => items[1..].iter().for_each(|fact| self.fact(fact)),
            Some(":goal") => {
                let (mut goal, before) = (Vec::new(), self.faults.len());
                items[1..].iter().for_each(|part| self.wish(part, &mut goal));
                self.document.goal_is_empty |=
                    goal.is_empty() && items.len() > 1 && self.faults.len() == before;
                self.document.goal.extend(goal);
            }
            Some(":functions") => self.functions(&items[1..]),
            Some(":metric") => self.metric(section),
            Some("domain") => self.document.domain_names.0 = self.own_name(items),
            Some(":domain") => self.document.domain_names.1 = self.own_name(items),
            // Names and promises; what a text really uses shows when it is read.
            Some("problem" | ":length") => {}
            Some(":requirements") => self.requirements(&items[1..]),
            Some(other) => self.unsupported(other, section.head_span()),
            None => self.expected(word!("a-section"), section.span()),
        }
    }

    /// A promise of more than is read harms nobody who does not make use of it.
    fn requirements(&mut self, items: &[Expression<'_>]) {
        const READ: [&str; 15] = [
            ":strips",
            ":adl",
            ":disjunctive-preconditions",
            ":existential-preconditions",
            ":universal-preconditions",
            ":quantified-preconditions",
            ":conditional-effects",
            ":derived-predicates",
            ":durative-actions",
            ":typing",
            ":equality",
            ":negative-preconditions",
            ":action-costs",
            ":preferences",
            ":constants",
        ];
        for item in items {
            let Expression::Word(name, at) = item else { continue };
            if !READ.contains(&name.to_lowercase().as_str()) {
                let error = RuleError::Requirement { name: (*name).to_owned(), at: *at };
                self.document.warnings.push(RuleFault::new(self.source, error));
            }
        }
    }

    fn own_name(&self, items: &[Expression<'_>]) -> Option<Name> {
        match items.get(1) {
            Some(Expression::Word(name, span)) => Some(Name::new(name, self.source, *span)),
            _ => None,
        }
    }

    /// `(total-cost) (distance ?a ?b - place) - number`; the type of a value is always a number.
    fn functions(&mut self, items: &[Expression<'_>]) {
        let mut items = items.iter();
        while let Some(item) = items.next() {
            if matches!(item, Expression::Word("-", _)) {
                items.next();
            } else if let Some((name, rest)) = self.call(item) {
                let args = self.typed(rest).into_iter().map(|arg| arg.kinds).collect();
                self.document.functions.push(Signature { name, args });
            }
        }
    }

    fn action(&mut self, section: &Expression<'_>) {
        let items = section.items();
        let Some(Expression::Word(name, span)) = items.get(1) else {
            return self.expected(word!("the-name-of-an-action"), section.span());
        };
        let mut action = ActionText::new(Name::new(name, self.source, *span));
        let mut rest = items[2..].iter();
        while let Some(key) = rest.next() {
            let Expression::Word(word, span) = key else {
                self.expected(word!("parameters-precondition-or-effect"), key.span());
                continue;
            };
            let Some(body) = rest.next() else {
                self.expected(word!("an-expression-in-brackets"), *span);
                continue;
            };
            match word.to_lowercase().as_str() {
                ":parameters" => action.parameters.extend(self.variables(body.items())),
                ":precondition" => self.condition(body, false, &mut action.precondition),
                ":effect" => self.effect(body, &mut action),
                other => self.unsupported(other, *span),
            }
        }
        renew(&mut action);
        self.document.actions.push(action);
    }

    pub(super) fn condition(
        &mut self,
        part: &Expression<'_>,
        negated: bool,
        into: &mut Vec<Condition>,
    ) {
        let items = part.items();
        match part.head().as_deref() {
            Some("and") => {
                let mut all = Vec::new();
                items[1..].iter().for_each(|p| self.condition(p, false, &mut all));
                if negated { into.push(none_of(all)) } else { into.extend(all) }
            }
            Some("or") => {
                let cases = items[1..].iter().map(|p| self.conjunction(p)).collect();
                let any = Condition::Any(cases);
                into.push(if negated { any.negated() } else { any });
            }
            Some("imply") if items.len() == 3 => {
                let (if_so, then) = (self.conjunction(&items[1]), self.conjunction(&items[2]));
                let implied = Condition::Any(vec![vec![none_of(if_so)], then]);
                into.push(if negated { implied.negated() } else { implied });
            }
            Some(quantifier @ ("forall" | "exists")) if items.len() == 3 => {
                let variables = self.variables(items[1].items());
                let body = self.conjunction(&items[2]);
                let every = quantifier == "forall";
                let quantified = Condition::Quantified { every, variables, body };
                into.push(if negated { quantified.negated() } else { quantified });
            }
            Some("not") if items.len() == 2 => self.condition(&items[1], !negated, into),
            Some("=") if matches!(items, [_, Expression::Word(..), Expression::Word(..)]) => {
                if let (Some(left), Some(right)) = (self.term(&items[1]), self.term(&items[2])) {
                    into.push(Condition::Equal { pair: Box::new((left, right)), negated });
                }
            }
            Some(what @ ("imply" | "forall" | "exists")) => {
                let form = match what {
                    "imply" => word!("imply-condition-condition"),
                    "forall" => word!("forall-variables-condition"),
                    _ => word!("exists-variables-condition"),
                };
                self.expected(form, part.span());
            }
            Some(what @ ("when" | "preference" | "=" | "<" | "<=" | ">" | ">=")) => {
                self.unsupported(what, part.head_span());
            }
            Some(_) => {
                if let Some(atom) = self.atom(part) {
                    into.push(Condition::Holds { atom, negated });
                }
            }
            None if matches!(part, Expression::List(items, _) if items.is_empty()) => {}
            None => self.expected(word!("a-condition-in-brackets"), part.span()),
        }
    }

    pub(super) fn conjunction(&mut self, part: &Expression<'_>) -> Vec<Condition> {
        let mut all = Vec::new();
        self.condition(part, false, &mut all);
        all
    }

    /// `?a ?b - place`
    pub(super) fn variables(&mut self, items: &[Expression<'_>]) -> Vec<Parameter> {
        let mut variables = Vec::new();
        for Declaration { name, kinds } in self.typed(items) {
            if name.text.starts_with('?') {
                variables.push(Parameter { kinds, variable: name });
            } else {
                let what = word!("a-variable-such-as-x");
                self.expected(what, name.at.span);
            }
        }
        variables
    }

    /// `(forall (?x - bag) (when (in ?x) (at ?x ?l)))`: effects under a condition, or for every choice of objects.
    fn conditional(
        &mut self,
        part: &Expression<'_>,
        around: &ConditionalText,
        action: &mut ActionText,
    ) {
        let items = part.items();
        match part.head().as_deref() {
            Some("and") => items[1..].iter().for_each(|p| self.conditional(p, around, action)),
            Some("forall") if items.len() == 3 => {
                let mut around = around.clone();
                around.variables.extend(self.variables(items[1].items()));
                self.conditional(&items[2], &around, action);
            }
            Some("when") if items.len() == 3 => {
                let mut around = around.clone();
                around.condition.extend(self.conjunction(&items[1]));
                self.conditional(&items[2], &around, action);
            }
            _ => {
                // What a plain effect would be, with all that stands around it.
                let mut plain = ActionText::new(action.name.clone());
                self.effect(part, &mut plain);
                if !plain.cost.is_empty() {
                    self.unsupported("increase", part.head_span());
                }
                let (add, del) = (plain.add, plain.del);
                action.conditional.extend(plain.conditional);
                if !add.is_empty() || !del.is_empty() {
                    action.conditional.push(ConditionalText { add, del, ..around.clone() });
                }
            }
        }
    }

    /// `(:derived (above ?x ?y - block) condition)`
    fn derived(&mut self, section: &Expression<'_>) {
        let [_, head, condition] = section.items() else {
            let form = word!("derived-name-x-condition");
            return self.expected(form, section.span());
        };
        let Some((predicate, rest)) = self.call(head) else { return };
        let parameters = self.variables(rest);
        let term = |parameter: &Parameter| Term {
            kind: None,
            name: parameter.variable.clone(),
            is_variable: true,
        };
        let atom = Atom { predicate, args: parameters.iter().map(term).collect() };
        let condition = self.conjunction(condition);
        self.document.derived.push(DerivedText { parameters, atom, condition });
    }

    pub(super) fn effect(&mut self, part: &Expression<'_>, action: &mut ActionText) {
        let items = part.items();
        match part.head().as_deref() {
            Some("and") => items[1..].iter().for_each(|p| self.effect(p, action)),
            Some("not") if items.len() == 2 => {
                action.del.extend(self.atom(&items[1]));
            }
            Some("increase")
                if items.len() == 3 && items[1].head().as_deref() != Some("total-cost") =>
            {
                self.unsupported(&excerpt(self.source, part.span()), part.span());
            }
            Some("increase") if items.len() == 3 => {
                action.cost.extend(match &items[2] {
                    Expression::Word(text, span) => self.number(text, *span).map(CostTerm::Number),
                    list @ Expression::List(..) => self.atom(list).map(CostTerm::Function),
                });
            }
            Some("forall" | "when") if items.len() == 3 => {
                let nothing = ConditionalText {
                    variables: Vec::new(),
                    condition: Vec::new(),
                    add: Vec::new(),
                    del: Vec::new(),
                };
                self.conditional(part, &nothing, action);
            }
            Some(what @ ("assign" | "decrease" | "scale-up" | "scale-down")) => {
                self.unsupported(what, part.head_span());
            }
            Some("forall" | "when") => {
                let form = word!("forall-variables-effect-or-when-condition-effect");
                self.expected(form, part.span());
            }
            Some(_) => action.add.extend(self.atom(part)),
            None if matches!(part, Expression::List(items, _) if items.is_empty()) => {}
            None => self.expected(word!("an-effect-in-brackets"), part.span()),
        }
    }

    fn fact(&mut self, fact: &Expression<'_>) {
        let items = fact.items();
        match (fact.head().as_deref(), items) {
            (Some("="), [_, function, Expression::Word(value, span)]) => {
                let value = self.number(value, *span);
                let function = match function {
                    Expression::Word(name, span) => Some(Atom {
                        predicate: Name::new(name, self.source, *span),
                        args: Vec::new(),
                    }),
                    list @ Expression::List(..) => self.atom(list),
                };
                if let (Some(function), Some(value)) = (function, value) {
                    self.document.values.push((function, value));
                }
            }
            _ => {
                let mut conditions = Vec::new();
                self.condition(fact, false, &mut conditions);
                self.document.facts.append(&mut conditions);
            }
        }
    }

    pub(super) fn number(&mut self, text: &str, at: SourceSpan) -> Option<Amount> {
        let number = Amount::parse(text);
        if number.is_none() {
            let error = RuleError::Cost { text: text.chars().take(40).collect(), at };
            self.faults.push(RuleFault::new(self.source, error));
        }
        number
    }

    pub(super) fn atom(&mut self, expression: &Expression<'_>) -> Option<Atom> {
        let (predicate, rest) = self.call(expression)?;
        let args: Vec<Term> = rest.iter().filter_map(|term| self.term(term)).collect();
        (args.len() == rest.len()).then_some(Atom { predicate, args })
    }

    fn call<'e, 't>(
        &mut self,
        expression: &'e Expression<'t>,
    ) -> Option<(Name, &'e [Expression<'t>])> {
        match expression.items() {
            [Expression::Word(name, span), rest @ ..] => {
                Some((Name::new(name, self.source, *span), rest))
            }
            _ => {
                self.expected(word!("name-arguments"), expression.span());
                None
            }
        }
    }

    fn term(&mut self, expression: &Expression<'_>) -> Option<Term> {
        match expression {
            Expression::Word(word, span) => Some(Term {
                kind: None,
                name: Name::new(word, self.source, *span),
                is_variable: word.starts_with('?'),
            }),
            Expression::List(..) => {
                self.expected(word!("a-variable-or-an-object"), expression.span());
                None
            }
        }
    }

    /// `a b - t c - (either u v) d`
    fn typed(&mut self, items: &[Expression<'_>]) -> Vec<Declaration> {
        let mut declarations: Vec<Declaration> = Vec::new();
        let mut group = 0;
        let mut items = items.iter();
        while let Some(item) = items.next() {
            match item {
                Expression::Word("-", span) => {
                    let Some(kind) = items.next() else {
                        self.expected(word!("a-type-after"), *span);
                        break;
                    };
                    let words = match kind {
                        Expression::Word(..) => std::slice::from_ref(kind),
                        Expression::List(items, _) if kind.head().as_deref() == Some("either") => {
                            &items[1..]
                        }
                        Expression::List(_, span) => {
                            self.expected(word!("a-type-or-either"), *span);
                            continue;
                        }
                    };
                    let kinds: Vec<Name> = words
                        .iter()
                        .filter_map(|word| match word {
                            Expression::Word(word, span) => {
                                Some(Name::new(word, self.source, *span))
                            }
                            Expression::List(..) => None,
                        })
                        .collect();
                    for declaration in &mut declarations[group..] {
                        declaration.kinds.clone_from(&kinds);
                    }
                    group = declarations.len();
                }
                Expression::Word(word, span) => {
                    // "object" is there before anyone declares it.
                    if name_key(word) != "object" || word.starts_with('?') {
                        let name = Name::new(word, self.source, *span);
                        declarations.push(Declaration { name, kinds: Vec::new() });
                    }
                }
                Expression::List(_, span) => self.expected(word!("a-name"), *span),
            }
        }
        declarations
    }

    pub(super) fn expected(&mut self, expected: Piece, at: SourceSpan) {
        let (expected, found) = (expected.into(), Bilingual::quoted(&excerpt(self.source, at)));
        self.faults.push(RuleFault::new(self.source, RuleError::Syntax { expected, found, at }));
    }

    fn early_end(&mut self, define: SourceSpan, next: &Expression<'_>) {
        let next = Bilingual::quoted(&excerpt(self.source, next.head_span()));
        let at = (define.offset() + define.len() - 1, 1).into();
        self.faults.push(RuleFault::new(self.source, RuleError::EarlyEnd { next, at }));
    }

    pub(super) fn unsupported(&mut self, what: &str, at: SourceSpan) {
        let help = way_round(what).into();
        let what: String = what.chars().take(40).collect();
        self.faults.push(RuleFault::new(self.source, RuleError::Unsupported { what, help, at }));
    }
}

const COSTS_ALONE: Piece = word!("numbers-are-read-as-costs-alone-increase");

/// How to say the same without what is not read.
fn way_round(what: &str) -> Piece {
    match what {
        "preference" => word!("preferences-are-read-in-goal-one-by"),
        ":constraints" => word!("there-are-no-constraints-on-the-course"),
        "<" | "<=" | ">" | ">=" | "assign" | "decrease" | "scale-up" | "scale-down" => COSTS_ALONE,
        what if what.starts_with("(increase") => COSTS_ALONE,
        _ => word!("adl-derived-predicates-action-costs-and-what"),
    }
}

/// Adding comes after deleting, so an atom in both is added; it is taken for a moment all the same.
pub(super) fn renew(action: &mut ActionText) {
    let added: Vec<Vec<String>> = action.add.iter().map(atom_key).collect();
    (action.renewed, action.del) = std::mem::take(&mut action.del)
        .into_iter()
        .partition(|atom| added.contains(&atom_key(atom)));
}

/// Equal for atoms that read the same.
pub(super) fn atom_key(atom: &Atom) -> Vec<String> {
    let names = std::iter::once(&atom.predicate).chain(atom.args.iter().map(|term| &term.name));
    names.map(Name::key).collect()
}

/// A stretch of the text, short enough for a message.
pub(super) fn excerpt(source: &Source, at: SourceSpan) -> String {
    let text = &source.text()[at.offset()..at.offset() + at.len()];
    text.chars().take(40).map(|c| if c.is_control() { ' ' } else { c }).collect()
}
