//! A judge of plans that shares no code with the planner, nor with the reading of rules: it reads PDDL or a rule file, and
//! the plan's text, by itself, and carries the plan out on sets of words, by the rules as they are given: conditions with
//! `or` and quantifiers, effects that hang on conditions, what is derived, actions that last, wishes.
//!
//! A plan must work in three ways: step by step, where every action of a step can be carried out before the step and
//! none takes what another needs or brings; one action after the other as they are written; and with each step written
//! backwards; and all must end alike. An action that lasts goes from its start over what it asks throughout to its end before
//! another begins. What it does not know it does not judge, and says so: numbers but as costs, what other files say. An object whose type is stated nowhere is of every type that a parameter
//! has of which some rule says what a fact says of the object.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

#[path = "judge/pddl.rs"]
mod pddl;
#[path = "judge/rules.rs"]
mod rules;

/// A predicate and its arguments; in a rule variables among them, with their question marks.
type Atom = Vec<String>;
type State = BTreeSet<Atom>;
type Binding = BTreeMap<String, String>;
/// Variables or names, each with its types; none means any.
type Typed = Vec<(String, Vec<String>)>;

#[derive(Debug, Clone)]
enum Condition {
    Holds(Atom),
    Equal(String, String),
    Not(Box<Self>),
    All(Vec<Self>),
    Any(Vec<Self>),
    Every(Typed, Box<Self>),
    Some(Typed, Box<Self>),
}

/// What comes about where a condition holds before, for every choice of objects.
#[derive(Debug, Clone)]
struct Effect {
    variables: Typed,
    condition: Condition,
    adds: bool,
    atom: Atom,
}

/// What is asked at a moment, and comes about at it.
#[derive(Debug, Clone)]
struct Moment {
    precondition: Condition,
    effects: Vec<Effect>,
}

impl Moment {
    const fn none() -> Self {
        Self { precondition: Condition::All(Vec::new()), effects: Vec::new() }
    }
}

#[derive(Debug, Clone)]
struct Action {
    parameters: Typed,
    /// All of an action that does not last.
    start: Moment,
    /// Asked when its start has come about, and when its end comes.
    throughout: Condition,
    end: Moment,
}

impl Action {
    fn new(parameters: Typed) -> Self {
        let (start, end) = (Moment::none(), Moment::none());
        Self { parameters, start, throughout: Condition::All(Vec::new()), end }
    }

    fn moments(&self) -> [&Moment; 2] {
        [&self.start, &self.end]
    }
}

/// A domain with its problem, as given.
#[derive(Debug)]
struct Given {
    /// Of each type those that it is one of.
    kinds: BTreeMap<String, Vec<String>>,
    objects: BTreeMap<String, BTreeSet<String>>,
    actions: BTreeMap<String, Action>,
    /// An atom of variables holds where the condition does.
    derived: Vec<(Typed, Atom, Condition)>,
    init: State,
    goal: Vec<Condition>,
    /// By names.
    wishes: Vec<(String, Condition)>,
    /// Equal for names that are the same.
    key: fn(&str) -> String,
}

impl Given {
    fn new(key: fn(&str) -> String) -> Self {
        Self {
            kinds: BTreeMap::new(),
            objects: BTreeMap::new(),
            actions: BTreeMap::new(),
            derived: Vec::new(),
            init: State::new(),
            goal: Vec::new(),
            wishes: Vec::new(),
            key,
        }
    }

    fn is_a(&self, object: &str, wanted: &[String]) -> bool {
        if wanted.is_empty() || wanted.iter().any(|kind| kind == "object" || kind == "объект")
        {
            return true;
        }
        let mut open: Vec<&String> = self.objects.get(object).into_iter().flatten().collect();
        let mut seen = BTreeSet::new();
        while let Some(kind) = open.pop() {
            if wanted.contains(kind) {
                return true;
            }
            if seen.insert(kind) {
                open.extend(self.kinds.get(kind).into_iter().flatten());
            }
        }
        false
    }

    /// Objects that nobody declared get the types of the parameters that stand where facts name them.
    fn find_types(&mut self) {
        let declared: BTreeSet<String> = self
            .objects
            .iter()
            .filter(|(_, kinds)| !kinds.is_empty())
            .map(|(o, _)| o.clone())
            .collect();
        let mut places: BTreeMap<(String, usize), BTreeSet<String>> = BTreeMap::new();
        let mut note = |atom: &Atom, variables: &Typed| {
            for (at, argument) in atom[1..].iter().enumerate() {
                let kinds =
                    variables.iter().find(|(name, _)| name == argument).map(|(_, kinds)| kinds);
                let place = places.entry((atom[0].clone(), at)).or_default();
                place.extend(kinds.into_iter().flatten().cloned());
            }
        };
        for action in self.actions.values() {
            action.throughout.each_atom(&action.parameters, &mut note);
            for moment in action.moments() {
                moment.precondition.each_atom(&action.parameters, &mut note);
                for effect in &moment.effects {
                    let bound = both(&action.parameters, &effect.variables);
                    effect.condition.each_atom(&bound, &mut note);
                    note(&effect.atom, &bound);
                }
            }
        }
        for (variables, atom, condition) in &self.derived {
            note(atom, variables);
            condition.each_atom(variables, &mut note);
        }
        let mut named: Vec<Atom> = self.init.iter().cloned().collect();
        let mut keep = |atom: &Atom, _: &Typed| named.push(atom.clone());
        let wishes = self.wishes.iter().map(|(_, wish)| wish);
        self.goal.iter().chain(wishes).for_each(|goal| goal.each_atom(&Vec::new(), &mut keep));
        for atom in named {
            for (at, object) in atom[1..].iter().enumerate() {
                if !declared.contains(object) && !object.starts_with('?') {
                    let kinds = places.get(&(atom[0].clone(), at)).cloned().unwrap_or_default();
                    self.objects.entry(object.clone()).or_default().extend(kinds);
                }
            }
        }
    }

    /// Every choice of objects for variables.
    fn choices(&self, variables: &[(String, Vec<String>)], around: &Binding) -> Vec<Binding> {
        let mut all = vec![around.clone()];
        for (name, kinds) in variables {
            let fitting: Vec<&String> =
                self.objects.keys().filter(|o| self.is_a(o, kinds)).collect();
            let with = |binding: &Binding| -> Vec<Binding> {
                let one = |object: &&String| {
                    let mut binding = binding.clone();
                    binding.insert(name.clone(), (*object).clone());
                    binding
                };
                fitting.iter().map(one).collect()
            };
            all = all.iter().flat_map(with).collect();
        }
        all
    }

    fn holds(&self, condition: &Condition, state: &State, binding: &Binding) -> bool {
        let each = |variables: &Typed| self.choices(variables, binding);
        match condition {
            Condition::Holds(atom) => state.contains(&ground(atom, binding)),
            Condition::Equal(a, b) => value(a, binding) == value(b, binding),
            Condition::Not(inner) => !self.holds(inner, state, binding),
            Condition::All(parts) => parts.iter().all(|part| self.holds(part, state, binding)),
            Condition::Any(parts) => parts.iter().any(|part| self.holds(part, state, binding)),
            Condition::Every(variables, inner) => {
                each(variables).iter().all(|binding| self.holds(inner, state, binding))
            }
            Condition::Some(variables, inner) => {
                each(variables).iter().any(|binding| self.holds(inner, state, binding))
            }
        }
    }

    /// A state with all that is derived in it, stratum by stratum.
    fn with_derived<'s>(&self, state: &'s State) -> Cow<'s, State> {
        if self.derived.is_empty() {
            return Cow::Borrowed(state);
        }
        let mut full = state.clone();
        let strata = self.strata();
        for stratum in 0..=strata.values().copied().max().unwrap_or_default() {
            let rules: Vec<_> =
                self.derived.iter().filter(|(_, atom, _)| strata[&atom[0]] == stratum).collect();
            loop {
                let before = full.len();
                for (variables, atom, condition) in &rules {
                    for binding in self.choices(variables, &Binding::new()) {
                        let atom = ground(atom, &binding);
                        if !full.contains(&atom) && self.holds(condition, &full, &binding) {
                            full.insert(atom);
                        }
                    }
                }
                if full.len() == before {
                    break;
                }
            }
        }
        Cow::Owned(full)
    }

    /// A derived predicate stands above those whose absence it asks for.
    fn strata(&self) -> BTreeMap<String, usize> {
        let heads: BTreeSet<String> =
            self.derived.iter().map(|(_, atom, _)| atom[0].clone()).collect();
        let mut strata: BTreeMap<String, usize> =
            heads.iter().map(|name| (name.clone(), 0)).collect();
        for _ in 0..=heads.len() {
            for (_, atom, condition) in &self.derived {
                let mut least = strata[&atom[0]];
                condition.each_sign(false, &mut |name, negated| {
                    if let Some(below) = strata.get(name) {
                        least = least.max(below + usize::from(negated));
                    }
                });
                strata.insert(atom[0].clone(), least);
            }
        }
        strata
    }
}

impl Condition {
    fn each_atom(&self, bound: &Typed, f: &mut dyn FnMut(&Atom, &Typed)) {
        match self {
            Self::Holds(atom) => f(atom, bound),
            Self::Equal(..) => {}
            Self::Not(inner) => inner.each_atom(bound, f),
            Self::All(parts) | Self::Any(parts) => parts.iter().for_each(|p| p.each_atom(bound, f)),
            Self::Every(variables, inner) | Self::Some(variables, inner) => {
                inner.each_atom(&both(bound, variables), f);
            }
        }
    }

    /// Every predicate, and whether it is asked to be absent.
    fn each_sign(&self, negated: bool, f: &mut dyn FnMut(&str, bool)) {
        match self {
            Self::Holds(atom) => f(&atom[0], negated),
            Self::Equal(..) => {}
            Self::Not(inner) => inner.each_sign(!negated, f),
            Self::All(parts) | Self::Any(parts) => {
                parts.iter().for_each(|p| p.each_sign(negated, f))
            }
            Self::Every(_, inner) | Self::Some(_, inner) => inner.each_sign(negated, f),
        }
    }

    /// The facts that it asks for and those whose absence it asks for, as far as all must be so.
    fn literals(&self, binding: &Binding, holding: &mut State, lacking: &mut State) {
        match self {
            Self::Holds(atom) => drop(holding.insert(ground(atom, binding))),
            Self::All(parts) => parts.iter().for_each(|p| p.literals(binding, holding, lacking)),
            Self::Not(inner) => {
                if let Self::Holds(atom) = &**inner {
                    lacking.insert(ground(atom, binding));
                }
            }
            _ => {}
        }
    }
}

fn both(some: &Typed, more: &Typed) -> Typed {
    // The inner ones first: they hide what bears the same name outside.
    more.iter().chain(some).cloned().collect()
}

fn value(word: &str, binding: &Binding) -> String {
    binding.get(word).map_or_else(|| word.to_owned(), Clone::clone)
}

fn ground(atom: &Atom, binding: &Binding) -> Atom {
    atom.iter().map(|word| value(word, binding)).collect()
}

/// A line of a plan.
struct Done<'g> {
    line: String,
    action: &'g Action,
    binding: Binding,
}

/// What a line comes to in a state.
#[derive(Default)]
struct Change {
    holding: State,
    lacking: State,
    adds: State,
    deletes: State,
}

impl Done<'_> {
    /// None where it cannot be carried out.
    fn change(&self, given: &Given, state: &State) -> Option<Change> {
        let mut change = Change::default();
        let met = |condition: &Condition, full: &State| given.holds(condition, full, &self.binding);
        let full = given.with_derived(state);
        if !met(&self.action.start.precondition, &full) {
            return None;
        }
        self.pass(&self.action.start, given, &full, &mut change);
        let mut meanwhile = state.clone();
        change.carry_out(&mut meanwhile);
        let full = given.with_derived(&meanwhile);
        if !met(&self.action.throughout, &full) || !met(&self.action.end.precondition, &full) {
            return None;
        }
        let mut end = Change::default();
        self.action.throughout.literals(&self.binding, &mut end.holding, &mut end.lacking);
        self.pass(&self.action.end, given, &full, &mut end);
        change.go_on(end);
        Some(change)
    }

    /// What a moment asks and brings about.
    fn pass(&self, moment: &Moment, given: &Given, full: &State, change: &mut Change) {
        let Change { holding, lacking, adds, deletes } = change;
        moment.precondition.literals(&self.binding, holding, lacking);
        for effect in &moment.effects {
            for binding in given.choices(&effect.variables, &self.binding) {
                if given.holds(&effect.condition, full, &binding) {
                    effect.condition.literals(&binding, holding, lacking);
                    let atom = ground(&effect.atom, &binding);
                    if effect.adds {
                        adds.insert(atom)
                    } else {
                        deletes.insert(atom)
                    };
                }
            }
        }
    }
}

impl Change {
    /// What is deleted and added holds.
    fn carry_out(&self, state: &mut State) {
        state.retain(|fact| !self.deletes.contains(fact));
        state.extend(self.adds.iter().cloned());
    }

    /// What comes behind may ask for what this one has brought about.
    fn go_on(&mut self, end: Self) {
        self.holding.extend(end.holding.difference(&self.adds).cloned());
        let gone = self.deletes.difference(&self.adds).cloned().collect();
        self.lacking.extend(end.lacking.difference(&gone).cloned());
        self.adds.retain(|fact| !end.deletes.contains(fact));
        self.adds.extend(end.adds);
        self.deletes.extend(end.deletes);
    }

    fn spoils(&self, other: &Self) -> bool {
        let needed = other.holding.union(&other.adds).any(|fact| self.deletes.contains(fact));
        needed || other.lacking.iter().any(|fact| self.adds.contains(fact))
    }
}

/// The plan's lines by their steps: `step: (action object …)`.
fn lines<'g>(given: &'g Given, plan: &str) -> Result<Vec<Vec<Done<'g>>>, String> {
    let mut steps: BTreeMap<usize, Vec<Done<'g>>> = BTreeMap::new();
    for line in plan.lines().map(|line| line.split(';').next().unwrap_or_default()) {
        let Some((step, call)) = line.split_once(':') else { continue };
        let step = step
            .trim()
            .parse()
            .map_err(|why: std::num::ParseIntError| format!("no step ({why}): {line}"))?;
        let words = called(call, given.key);
        let name = words.first().ok_or_else(|| format!("no action: {line}"))?;
        let action = given.actions.get(name).ok_or_else(|| format!("no such action: {line}"))?;
        if action.parameters.len() != words.len() - 1 {
            return Err(format!("not so many arguments: {line}"));
        }
        let mut binding = Binding::new();
        for ((name, kinds), word) in action.parameters.iter().zip(&words[1..]) {
            if !given.is_a(word, kinds) {
                return Err(format!("{word} is no {kinds:?}: {line}"));
            }
            binding.insert(name.clone(), word.clone());
        }
        let done = Done { line: line.trim().to_owned(), action, binding };
        steps.entry(step).or_default().push(done);
    }
    Ok(steps.into_values().collect())
}

/// The words of a call in brackets; those with blanks stand in quotation marks.
fn called(call: &str, key: fn(&str) -> String) -> Vec<String> {
    let (mut words, mut word, mut until) = (Vec::new(), String::new(), None);
    for sign in call.chars() {
        match (until, sign) {
            (Some(end), sign) if sign == end => until = None,
            (None, '«') => until = Some('»'),
            (None, '"') => until = Some('"'),
            (None, '(' | ')' | ' ' | '\t') => words.push(std::mem::take(&mut word)),
            _ => word.push(sign),
        }
    }
    words.push(word);
    words.into_iter().filter(|word| !word.is_empty()).map(|word| key(&word)).collect()
}

/// What is judged by: the text of a rule file, or those of a domain and a problem.
#[derive(Debug, Clone)]
pub(crate) enum Texts {
    Pddl { domain: String, problem: String },
    Rules(String),
}

/// A judgement.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Verdict {
    Works,
    /// The first reason why not.
    Fails(String),
    /// The texts say what the judge does not read.
    Unread(String),
}

/// Whether the plan works.
pub(crate) fn judge(texts: &Texts, plan: &str) -> Verdict {
    match end(texts, plan) {
        Ok(_) => Verdict::Works,
        Err(verdict) => verdict,
    }
}

/// The names of the wishes that a plan which works leaves open.
///
/// # Errors
/// It does not work, or nobody can say.
#[allow(dead_code, reason = "not asked for by all who judge")]
pub(crate) fn left_open(texts: &Texts, plan: &str) -> Result<Vec<String>, Verdict> {
    let (given, state) = end(texts, plan)?;
    let full = given.with_derived(&state);
    let open = given.wishes.iter().filter(|(_, wish)| !given.holds(wish, &full, &Binding::new()));
    Ok(open.map(|(name, _)| name.clone()).collect())
}

fn end(texts: &Texts, plan: &str) -> Result<(Given, State), Verdict> {
    let given = match texts {
        Texts::Pddl { domain, problem } => pddl::read(domain, problem),
        Texts::Rules(text) => rules::read(text),
    };
    let mut given = given.map_err(Verdict::Unread)?;
    given.find_types();
    let state = carried_out(&given, plan).map_err(Verdict::Fails)?;
    Ok((given, state))
}

/// The state at the end.
fn carried_out(given: &Given, plan: &str) -> Result<State, String> {
    let steps = lines(given, plan)?;
    let is_reached = |state: &State| {
        let full = given.with_derived(state);
        given.goal.iter().all(|goal| given.holds(goal, &full, &Binding::new()))
    };
    let mut state = given.init.clone();
    for step in &steps {
        let mut changes: Vec<(Change, &str)> = Vec::new();
        for action in step {
            let Some(change) = action.change(given, &state) else {
                return Err(format!("cannot be carried out: {}", action.line));
            };
            if let Some((_, other)) =
                changes.iter().find(|(c, _)| c.spoils(&change) || change.spoils(c))
            {
                return Err(format!("not in one step: {} and {other}", action.line));
            }
            changes.push((change, &action.line));
        }
        changes.iter().for_each(|(change, _)| change.carry_out(&mut state));
    }
    if !is_reached(&state) {
        return Err("the goal is missed".to_owned());
    }
    for backwards in [false, true] {
        let mut in_turn = given.init.clone();
        for step in &steps {
            let order: Vec<&Done<'_>> =
                if backwards { step.iter().rev().collect() } else { step.iter().collect() };
            for action in order {
                let Some(change) = action.change(given, &in_turn) else {
                    return Err(format!("cannot be carried out in turn: {}", action.line));
                };
                change.carry_out(&mut in_turn);
            }
        }
        if in_turn != state {
            return Err("another end in turn".to_owned());
        }
    }
    Ok(state)
}
