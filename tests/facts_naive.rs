//! Random Datalog programs and the obvious slow way to evaluate them: try every value for every variable
//! until nothing new follows.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Display, Write};

/// All values that occur; computed values are taken modulo this.
pub(crate) const VALUES: i64 = 5;

pub(crate) type Tuple = Vec<i64>;
pub(crate) type Facts = BTreeMap<String, BTreeSet<Tuple>>;

/// A small generator of numbers: the same seed, the same program.
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub(crate) fn roll(&mut self, sides: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % sides
    }

    pub(crate) fn one_in(&mut self, sides: usize) -> bool {
        self.roll(sides) == 0
    }

    fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[self.roll(from.len())]
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Term {
    Any,
    Constant(i64),
    Variable(usize),
    /// `(A + B) % VALUES`
    Sum(usize, usize),
}

#[derive(Debug, Clone)]
pub(crate) struct Atom {
    relation: String,
    args: Vec<Term>,
}

#[derive(Debug, Clone)]
pub(crate) enum Premise {
    Atom(Atom),
    Not(Atom),
    Compare(Term, &'static str, Term),
    /// `target = (function value : { atom, more }) % VALUES`
    Aggregate {
        target: usize,
        function: &'static str,
        value: usize,
        atoms: Vec<Atom>,
    },
}

#[derive(Debug, Clone)]
pub(crate) struct Rule {
    head: Atom,
    body: Vec<Premise>,
    variables: usize,
}

#[derive(Debug, Clone)]
pub(crate) struct Model {
    /// Name, columns, group; group 0 is input.
    pub(crate) relations: Vec<(String, usize, usize)>,
    rules: Vec<Rule>,
}

impl Model {
    pub(crate) fn random(dice: &mut Dice) -> Self {
        let mut relations = vec![
            ("e".to_owned(), 2, 0),
            ("f".to_owned(), 2, 0),
            ("u".to_owned(), 1, 0),
            ("t".to_owned(), 3, 0),
        ];
        let groups = 1 + dice.roll(3);
        for group in 1..=groups {
            for n in 0..1 + dice.roll(2) {
                relations.push((format!("d{group}_{n}"), 1 + dice.roll(3), group));
            }
        }
        let mut rules = Vec::new();
        for (name, columns, group) in relations.iter().filter(|(_, _, group)| *group > 0) {
            for _ in 0..1 + dice.roll(3) {
                rules.push(random_rule(name, *columns, *group, &relations, dice));
            }
        }
        Self { relations, rules }
    }

    /// A question as a rule for `q`: premises of all groups, negation and aggregates among them.
    pub(crate) fn random_question(&self, dice: &mut Dice) -> Rule {
        let last = self.relations.iter().map(|r| r.2).max().unwrap_or(0);
        let columns = dice.roll(4);
        random_rule("q", columns, last + 1, &self.relations, dice)
    }

    /// The model with a question as one more relation.
    pub(crate) fn with_question(&self, question: &Rule) -> Self {
        let mut model = self.clone();
        let last = self.relations.iter().map(|r| r.2).max().unwrap_or(0);
        model.relations.push(("q".to_owned(), question.head.args.len(), last + 1));
        model.rules.push(question.clone());
        model
    }

    /// The relations of groups up to one, and of those behind it, without directives: the latter may be a question's.
    pub(crate) fn split(&self, group: usize) -> (Self, String) {
        let group_of = |name: &str| {
            self.relations.iter().find(|r| r.0 == name).map_or(0, |relation| relation.2)
        };
        let mut lower = self.clone();
        lower.relations.retain(|relation| relation.2 <= group);
        lower.rules.retain(|rule| group_of(&rule.head.relation) <= group);
        let mut rest = String::new();
        for (name, columns, _) in self.relations.iter().filter(|relation| relation.2 > group) {
            let columns: Vec<String> = (0..*columns).map(|n| format!("c{n}: number")).collect();
            let _ = writeln!(rest, ".decl {name}({})", columns.join(", "));
        }
        for rule in self.rules.iter().filter(|rule| group_of(&rule.head.relation) > group) {
            let _ = writeln!(rest, "{rule}.");
        }
        (lower, rest)
    }

    pub(crate) fn input_names(&self) -> Vec<(String, usize)> {
        let inputs = self.relations.iter().filter(|(_, _, group)| *group == 0);
        inputs.map(|(name, columns, _)| (name.clone(), *columns)).collect()
    }

    pub(crate) fn evaluate(&self, input: &Facts) -> Facts {
        let mut facts: Facts =
            self.relations.iter().map(|(name, ..)| (name.clone(), BTreeSet::new())).collect();
        for (name, tuples) in input {
            facts.get_mut(name).expect("inputs are declared").extend(tuples.iter().cloned());
        }
        let group_of: BTreeMap<&str, usize> =
            self.relations.iter().map(|r| (r.0.as_str(), r.2)).collect();
        let last = self.relations.iter().map(|r| r.2).max().unwrap_or(0);
        for group in 1..=last {
            loop {
                let mut new = Vec::new();
                for rule in
                    self.rules.iter().filter(|rule| group_of[rule.head.relation.as_str()] == group)
                {
                    new.extend(rule.consequences(&facts, &facts));
                }
                let mut changed = false;
                for (relation, tuple) in new {
                    changed |= facts.get_mut(&relation).expect("heads are declared").insert(tuple);
                }
                if !changed {
                    break;
                }
            }
        }
        facts
    }
}

/// The height of the lowest proof of every tuple: rounds of all rules together, negations and aggregates
/// looked up in the finished relations.
pub(crate) fn heights(
    model: &Model,
    input: &Facts,
    finished: &Facts,
) -> BTreeMap<(String, Tuple), u32> {
    let mut known: Facts = finished.keys().map(|name| (name.clone(), BTreeSet::new())).collect();
    let mut heights = BTreeMap::new();
    let mut new: Vec<(String, Tuple)> = input
        .iter()
        .flat_map(|(name, tuples)| tuples.iter().map(|t| (name.clone(), t.clone())))
        .collect();
    for height in 0.. {
        let mut changed = false;
        for (relation, tuple) in new {
            if known.get_mut(&relation).expect("declared").insert(tuple.clone()) {
                changed = true;
                heights.insert((relation, tuple), height);
            }
        }
        if !changed && height > 0 {
            break;
        }
        new = model.rules.iter().flat_map(|rule| rule.consequences(&known, finished)).collect();
    }
    heights
}

/// The least number of premises that fail in any instance of any rule for the tuple, over the instances whose
/// variables all stand in the head or in a premise that holds; none where there is no such instance.
pub(crate) fn nearest(model: &Model, name: &str, tuple: &Tuple, finished: &Facts) -> Option<usize> {
    let rules = model.rules.iter().filter(|rule| rule.head.relation == name);
    rules.filter_map(|rule| rule.fewest_failures(tuple, finished)).min()
}

fn random_rule(
    head: &str,
    columns: usize,
    group: usize,
    relations: &[(String, usize, usize)],
    dice: &mut Dice,
) -> Rule {
    let positive: Vec<_> = relations.iter().filter(|r| r.2 <= group).collect();
    let below: Vec<_> = relations.iter().filter(|r| r.2 < group).collect();
    let mut variables = 1 + dice.roll(3);
    let mut body = Vec::new();
    let mut bound = BTreeSet::new();
    for _ in 0..1 + dice.roll(3) {
        let (name, columns, _) = *dice.pick(&positive);
        let args: Vec<Term> = (0..*columns)
            .map(|_| match dice.roll(8) {
                0 => Term::Any,
                1 => Term::Constant(dice.roll(VALUES as usize) as i64),
                _ => Term::Variable(dice.roll(variables)),
            })
            .collect();
        bound.extend(
            args.iter().filter_map(|arg| if let Term::Variable(v) = arg { Some(*v) } else { None }),
        );
        body.push(Premise::Atom(Atom { relation: name.clone(), args }));
    }
    let known: Vec<usize> = bound.into_iter().collect();
    let term = |dice: &mut Dice, known: &[usize]| match known {
        [] => Term::Constant(dice.roll(VALUES as usize) as i64),
        _ if dice.one_in(6) => Term::Constant(dice.roll(VALUES as usize) as i64),
        _ if dice.one_in(6) => Term::Sum(*dice.pick(known), *dice.pick(known)),
        _ => Term::Variable(*dice.pick(known)),
    };
    let mut known = known;
    if dice.one_in(3) {
        let (name, columns, _) = *dice.pick(&below);
        let args = (0..*columns)
            .map(|_| if dice.one_in(4) { Term::Any } else { term(dice, &known) })
            .collect();
        body.push(Premise::Not(Atom { relation: name.clone(), args }));
    }
    if dice.one_in(2) {
        let op = *dice.pick(&["=", "!=", "<", "<=", ">", ">="]);
        body.push(Premise::Compare(term(dice, &known), op, term(dice, &known)));
    }
    if dice.one_in(4) {
        let value = variables;
        let mut atoms = Vec::new();
        for n in 0..1 + dice.roll(2) {
            let (name, columns, _) = *dice.pick(&below);
            let mut args: Vec<Term> = (0..*columns)
                .map(|_| if dice.one_in(2) { Term::Any } else { term(dice, &known) })
                .collect();
            args.iter_mut().for_each(|arg| {
                if matches!(arg, Term::Sum(..)) {
                    *arg = Term::Any;
                }
            });
            if n == 0 || dice.one_in(2) {
                args[dice.roll(*columns)] = Term::Variable(value);
            }
            atoms.push(Atom { relation: name.clone(), args });
        }
        let function = *dice.pick(&["count", "sum", "min", "max"]);
        let target = value + 1;
        body.push(Premise::Aggregate { target, function, value, atoms });
        variables += 2;
        known.push(target);
    }
    // The order of premises must not matter.
    for n in (1..body.len()).rev() {
        body.swap(n, dice.roll(n + 1));
    }
    let args = (0..columns).map(|_| term(dice, &known)).collect();
    Rule { head: Atom { relation: head.to_owned(), args }, body, variables }
}

impl Rule {
    fn fewest_failures(&self, tuple: &Tuple, finished: &Facts) -> Option<usize> {
        let instances = (0..VALUES.pow(self.variables as u32)).map(|n| {
            let digit = |v: usize| n / VALUES.pow(v as u32) % VALUES;
            (0..self.variables).map(digit).collect::<Vec<i64>>()
        });
        let failures = instances.filter_map(|values| {
            let mut known: BTreeSet<usize> = BTreeSet::new();
            // The first column of a variable is where it takes its value; a further one compares.
            let mut count = 0;
            for (arg, wanted) in self.head.args.iter().zip(tuple) {
                match arg {
                    Term::Variable(v) if known.insert(*v) => {
                        if values[*v] != *wanted {
                            return None;
                        }
                    }
                    _ => count += usize::from(value(*arg, &values) != *wanted),
                }
            }
            let mut used: BTreeSet<usize> = self.head.args.iter().flat_map(variables_of).collect();
            for premise in &self.body {
                let does_hold = holds(premise, &values, finished, finished);
                match premise {
                    Premise::Atom(atom) | Premise::Not(atom) => {
                        let variables = atom.args.iter().flat_map(variables_of);
                        used.extend(variables.clone());
                        if does_hold && matches!(premise, Premise::Atom(_)) {
                            known.extend(variables);
                        }
                    }
                    Premise::Compare(a, _, b) => {
                        used.extend([a, b].into_iter().flat_map(variables_of));
                    }
                    Premise::Aggregate { target, .. } => {
                        used.insert(*target);
                        if does_hold {
                            known.insert(*target);
                        }
                    }
                }
                // The engine judges an aggregate and its comparison apart.
                let worth = if matches!(premise, Premise::Aggregate { .. }) { 2 } else { 1 };
                count += if does_hold { 0 } else { worth };
            }
            used.is_subset(&known).then_some(count)
        });
        failures.min()
    }

    /// Atoms are looked up in `facts`, negations and aggregates in `finished`.
    pub(crate) fn consequences(&self, facts: &Facts, finished: &Facts) -> Vec<(String, Tuple)> {
        let mut found = Vec::new();
        let local: Vec<usize> = self
            .body
            .iter()
            .filter_map(|premise| {
                if let Premise::Aggregate { value, .. } = premise { Some(*value) } else { None }
            })
            .collect();
        let free: Vec<usize> = (0..self.variables).filter(|v| !local.contains(v)).collect();
        for n in 0..VALUES.pow(free.len() as u32) {
            let mut values = vec![0; self.variables];
            let mut rest = n;
            for v in &free {
                values[*v] = rest % VALUES;
                rest /= VALUES;
            }
            if self.body.iter().all(|premise| holds(premise, &values, facts, finished)) {
                let tuple = self.head.args.iter().map(|arg| value(*arg, &values)).collect();
                found.push((self.head.relation.clone(), tuple));
            }
        }
        found
    }
}

fn variables_of(term: &Term) -> impl Iterator<Item = usize> + Clone + use<> {
    let both = match term {
        Term::Variable(v) => [Some(*v), None],
        Term::Sum(a, b) => [Some(*a), Some(*b)],
        Term::Any | Term::Constant(_) => [None, None],
    };
    both.into_iter().flatten()
}

fn value(term: Term, values: &[i64]) -> i64 {
    match term {
        Term::Any => panic!("a wildcard has no value"),
        Term::Constant(value) => value,
        Term::Variable(v) => values[v],
        Term::Sum(a, b) => (values[a] + values[b]) % VALUES,
    }
}

fn matches(args: &[Term], tuple: &Tuple, values: &[i64]) -> bool {
    args.iter().zip(tuple).all(|(arg, found)| *arg == Term::Any || value(*arg, values) == *found)
}

fn holds(premise: &Premise, values: &[i64], facts: &Facts, finished: &Facts) -> bool {
    match premise {
        Premise::Atom(atom) => {
            facts[&atom.relation].iter().any(|tuple| matches(&atom.args, tuple, values))
        }
        Premise::Not(atom) => {
            !finished[&atom.relation].iter().any(|tuple| matches(&atom.args, tuple, values))
        }
        Premise::Compare(a, op, b) => {
            let (a, b) = (value(*a, values), value(*b, values));
            match *op {
                "=" => a == b,
                "!=" => a != b,
                "<" => a < b,
                "<=" => a <= b,
                ">" => a > b,
                _ => a >= b,
            }
        }
        Premise::Aggregate { target, function, value: local, atoms } => {
            let mut found = Vec::new();
            for guess in 0..VALUES {
                let mut values = values.to_vec();
                values[*local] = guess;
                // Each combination of matching tuples counts.
                let ways: usize = atoms
                    .iter()
                    .map(|atom| {
                        finished[&atom.relation]
                            .iter()
                            .filter(|t| matches(&atom.args, t, &values))
                            .count()
                    })
                    .product();
                found.extend(std::iter::repeat_n(guess, ways));
            }
            let result = match *function {
                "count" => Some(found.len() as i64),
                "sum" => Some(found.iter().sum()),
                "min" => found.iter().min().copied(),
                _ => found.iter().max().copied(),
            };
            result.is_some_and(|result| result % VALUES == values[*target])
        }
    }
}

impl Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Any => write!(f, "_"),
            Self::Constant(value) => write!(f, "{value}"),
            Self::Variable(v) => write!(f, "V{v}"),
            Self::Sum(a, b) => write!(f, "(V{a} + V{b}) % {VALUES}"),
        }
    }
}

impl Display for Atom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let args: Vec<String> = self.args.iter().map(ToString::to_string).collect();
        write!(f, "{}({})", self.relation, args.join(", "))
    }
}

impl Display for Premise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Atom(atom) => write!(f, "{atom}"),
            Self::Not(atom) => write!(f, "!{atom}"),
            Self::Compare(a, op, b) => write!(f, "{a} {op} {b}"),
            Self::Aggregate { target, function, value, atoms } => {
                let of = if *function == "count" { String::new() } else { format!("V{value} ") };
                let atoms: Vec<String> = atoms.iter().map(ToString::to_string).collect();
                write!(f, "V{target} = ({function} {of}: {{ {} }}) % {VALUES}", atoms.join(", "))
            }
        }
    }
}

impl Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, columns, group) in &self.relations {
            let columns: Vec<String> = (0..*columns).map(|n| format!("c{n}: number")).collect();
            let role = if *group == 0 { "input" } else { "output" };
            writeln!(f, ".decl {name}({}) .{role} {name}", columns.join(", "))?;
        }
        for rule in &self.rules {
            writeln!(f, "{rule}.")?;
        }
        Ok(())
    }
}

impl Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let body: Vec<String> = self.body.iter().map(ToString::to_string).collect();
        write!(f, "{} :- {}", self.head, body.join(", "))
    }
}

/// Random input tuples.
pub(crate) fn random_facts(model: &Model, dice: &mut Dice) -> Facts {
    let mut facts = Facts::new();
    for (name, columns) in model.input_names() {
        let tuples = facts.entry(name).or_default();
        for _ in 0..dice.roll(10) {
            tuples.insert(random_tuple(columns, dice));
        }
    }
    facts
}

pub(crate) fn random_tuple(columns: usize, dice: &mut Dice) -> Tuple {
    (0..columns).map(|_| dice.roll(VALUES as usize) as i64).collect()
}

pub(crate) fn show(facts: &Facts) -> String {
    let mut text = String::new();
    for (name, tuples) in facts {
        let _ = writeln!(text, "{name}: {tuples:?}");
    }
    text
}
