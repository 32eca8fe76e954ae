//! A judge of plans that shares no code with the planner, nor with the reading of rules: it reads PDDL and the plan's
//! text by itself, and carries the plan out on sets of words.
//!
//! A plan must work in three ways: step by step, where every action of a step can be carried out before the step and
//! none takes what another needs or brings; one action after the other as they are written; and with each step written
//! backwards. It knows `and`, `not`, `=`, `when` without variables of its own, types as the reader of an action's
//! parameters, and nothing else: what it does not know it refuses.

use std::collections::{BTreeMap, BTreeSet};

/// A word or a list in brackets.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Form {
    Word(String),
    List(Vec<Self>),
}

impl Form {
    fn word(&self) -> &str {
        match self {
            Self::Word(word) => word,
            Self::List(_) => panic!("a word is wanted: {self:?}"),
        }
    }

    fn list(&self) -> &[Self] {
        match self {
            Self::List(list) => list,
            Self::Word(_) => panic!("a list is wanted: {self:?}"),
        }
    }

    fn head(&self) -> &str {
        self.list().first().map_or("", Self::word)
    }
}

fn read(text: &str) -> Vec<Form> {
    let mut open = vec![Vec::new()];
    let without_comments: String = text
        .lines()
        .map(|line| line.split(';').next().unwrap_or_default().to_lowercase() + "\n")
        .collect();
    let spaced = without_comments.replace('(', " ( ").replace(')', " ) ");
    for word in spaced.split_whitespace() {
        match word {
            "(" => open.push(Vec::new()),
            ")" => {
                let list = open.pop().expect("a bracket was opened");
                open.last_mut().expect("the text itself is open").push(Form::List(list));
            }
            word => open.last_mut().expect("the text is open").push(Form::Word(word.to_owned())),
        }
    }
    assert_eq!(open.len(), 1, "all brackets are closed");
    open.remove(0)
}

/// `a b - kind c - other` as names with their kinds.
fn typed(forms: &[Form]) -> Vec<(String, Vec<String>)> {
    let (mut all, mut names) = (Vec::new(), Vec::new());
    let mut forms = forms.iter();
    while let Some(form) = forms.next() {
        if *form == Form::Word("-".to_owned()) {
            let kinds: Vec<String> = match forms.next().expect("a kind follows") {
                Form::Word(kind) => vec![kind.clone()],
                Form::List(either) => {
                    either[1..].iter().map(|kind| kind.word().to_owned()).collect()
                }
            };
            all.extend(names.drain(..).map(|name| (name, kinds.clone())));
        } else {
            names.push(form.word().to_owned());
        }
    }
    all.extend(names.into_iter().map(|name| (name, vec!["object".to_owned()])));
    all
}

type State = BTreeSet<Vec<String>>;
type Binding = BTreeMap<String, String>;

fn atom(form: &Form, binding: &Binding) -> Vec<String> {
    let value =
        |form: &Form| binding.get(form.word()).cloned().unwrap_or_else(|| form.word().to_owned());
    form.list().iter().map(value).collect()
}

/// What a condition asks for: these hold, those do not. None where an equation is wrong.
fn asked(form: &Form, binding: &Binding) -> Option<(State, State)> {
    let (mut holding, mut lacking) = (State::new(), State::new());
    match form.head() {
        "" => {}
        "and" => {
            for part in &form.list()[1..] {
                let (more, less) = asked(part, binding)?;
                holding.extend(more);
                lacking.extend(less);
            }
        }
        "=" => {
            let sides = atom(form, binding);
            if sides[1] != sides[2] {
                return None;
            }
        }
        "not" if form.list()[1].head() == "=" => {
            let sides = atom(&form.list()[1], binding);
            if sides[1] == sides[2] {
                return None;
            }
        }
        "not" => drop(lacking.insert(atom(&form.list()[1], binding))),
        "or" | "imply" | "forall" | "exists" | "when" => panic!("not for this judge: {form:?}"),
        _ => drop(holding.insert(atom(form, binding))),
    }
    Some((holding, lacking))
}

/// What an effect adds and deletes.
fn effects(form: &Form, binding: &Binding, adds: &mut State, deletes: &mut State) {
    match form.head() {
        "" | "increase" => {}
        "and" => form.list()[1..].iter().for_each(|part| effects(part, binding, adds, deletes)),
        "not" => drop(deletes.insert(atom(&form.list()[1], binding))),
        "when" | "forall" => panic!("not for this judge: {form:?}"),
        _ => drop(adds.insert(atom(form, binding))),
    }
}

struct Done {
    name: String,
    holding: State,
    lacking: State,
    adds: State,
    deletes: State,
}

impl Done {
    fn is_possible(&self, state: &State) -> bool {
        self.holding.is_subset(state) && self.lacking.is_disjoint(state)
    }

    /// What is deleted and added holds.
    fn carry_out(&self, state: &mut State) {
        state.retain(|fact| !self.deletes.contains(fact));
        state.extend(self.adds.iter().cloned());
    }

    fn spoils(&self, other: &Self) -> bool {
        let needed = other.holding.union(&other.adds).any(|fact| self.deletes.contains(fact));
        needed || other.lacking.iter().any(|fact| self.adds.contains(fact))
    }
}

/// The actions of the plan by steps, what holds at first, and the goal.
struct Case {
    steps: Vec<Vec<Done>>,
    init: State,
    goal: (State, State),
}

fn section<'f>(forms: &'f [Form], name: &str) -> &'f [Form] {
    forms
        .iter()
        .find(|form| matches!(form, Form::List(_)) && form.head() == name)
        .map_or(&[], |f| &f.list()[1..])
}

fn case(domain: &str, problem: &str, plan: &str) -> Result<Case, String> {
    let (domain, problem) = (read(domain), read(problem));
    let (domain, problem) = (domain[0].list(), problem[0].list());
    let parents: BTreeMap<String, Vec<String>> =
        typed(section(domain, ":types")).into_iter().collect();
    let objects: BTreeMap<String, Vec<String>> = typed(section(domain, ":constants"))
        .into_iter()
        .chain(typed(section(problem, ":objects")))
        .collect();
    let is_a = |object: &str, wanted: &[String]| {
        let mut open = objects.get(object).cloned().unwrap_or_default();
        let mut seen = BTreeSet::new();
        while let Some(kind) = open.pop() {
            if wanted.contains(&kind) || wanted.contains(&"object".to_owned()) {
                return true;
            }
            if seen.insert(kind.clone()) {
                open.extend(parents.get(&kind).cloned().unwrap_or_default());
            }
        }
        false
    };
    let mut actions: BTreeMap<&str, BTreeMap<&str, &Form>> = BTreeMap::new();
    for form in domain.iter().filter(|f| matches!(f, Form::List(_)) && f.head() == ":action") {
        let parts = form.list()[2..].chunks(2).map(|pair| (pair[0].word(), &pair[1])).collect();
        actions.insert(form.list()[1].word(), parts);
    }
    let none = Form::List(Vec::new());
    let mut steps: BTreeMap<usize, Vec<Done>> = BTreeMap::new();
    for line in plan.lines().map(|line| line.split(';').next().unwrap_or_default()) {
        let Some((step, call)) = line.split_once(':') else { continue };
        let step = step
            .trim()
            .parse()
            .map_err(|why: std::num::ParseIntError| format!("no step ({why}): {line}"))?;
        let call = read(call);
        let words: Vec<&str> = call[0].list().iter().map(Form::word).collect();
        let action = actions.get(words[0]).ok_or_else(|| format!("no such action: {line}"))?;
        let parameters = typed(action.get(":parameters").unwrap_or(&&none).list());
        if parameters.len() != words.len() - 1 {
            return Err(format!("not so many arguments: {line}"));
        }
        let mut binding = Binding::new();
        for ((name, kinds), word) in parameters.iter().zip(&words[1..]) {
            if !is_a(word, kinds) {
                return Err(format!("{word} is no {kinds:?}: {line}"));
            }
            binding.insert(name.clone(), (*word).to_owned());
        }
        let asked = asked(action.get(":precondition").unwrap_or(&&none), &binding);
        let (holding, lacking) = asked.ok_or_else(|| format!("equal or not: {line}"))?;
        let (mut adds, mut deletes) = (State::new(), State::new());
        effects(action.get(":effect").unwrap_or(&&none), &binding, &mut adds, &mut deletes);
        let done = Done { name: line.trim().to_owned(), holding, lacking, adds, deletes };
        steps.entry(step).or_default().push(done);
    }
    let nothing = Binding::new();
    let init = section(problem, ":init")
        .iter()
        .filter(|f| f.head() != "=")
        .map(|f| atom(f, &nothing))
        .collect();
    let goal =
        asked(section(problem, ":goal").first().unwrap_or(&none), &nothing).ok_or("no goal")?;
    Ok(Case { steps: steps.into_values().collect(), init, goal })
}

/// Whether the plan works; the first reason why not.
///
/// # Errors
/// Why it does not.
pub(crate) fn judge(domain: &str, problem: &str, plan: &str) -> Result<(), String> {
    let case = case(domain, problem, plan)?;
    let mut state = case.init.clone();
    for step in &case.steps {
        for (at, action) in step.iter().enumerate() {
            if !action.is_possible(&state) {
                return Err(format!("cannot be carried out: {}", action.name));
            }
            for other in &step[..at] {
                if action.spoils(other) || other.spoils(action) {
                    return Err(format!("not in one step: {} and {}", action.name, other.name));
                }
            }
        }
        step.iter().for_each(|action| action.carry_out(&mut state));
    }
    let reached = |state: &State| case.goal.0.is_subset(state) && case.goal.1.is_disjoint(state);
    if !reached(&state) {
        return Err("the goal is missed".to_owned());
    }
    for backwards in [false, true] {
        let mut state = case.init.clone();
        for step in &case.steps {
            let order: Vec<&Done> =
                if backwards { step.iter().rev().collect() } else { step.iter().collect() };
            for action in order {
                if !action.is_possible(&state) {
                    return Err(format!("cannot be carried out in turn: {}", action.name));
                }
                action.carry_out(&mut state);
            }
        }
        if !reached(&state) {
            return Err("the goal is missed in turn".to_owned());
        }
    }
    Ok(())
}
