//! Conditions beyond literals against an interpreter of their own: it takes a problem as it was made, knows nothing of
//! cases, of grounding or of what is reachable, and looks at every state.

use std::collections::{BTreeSet, HashSet, VecDeque};
use std::fmt::Write as _;

use orthoframe_strips::*;
use orthoframe_units::Source;

const OBJECTS: usize = 3;

#[derive(Debug, Clone)]
enum Term {
    Object(usize),
    /// How many quantifiers, or parameters, stand outside of its own.
    Variable(usize),
}

#[derive(Debug, Clone)]
enum Form {
    Atom(&'static str, Vec<Term>),
    Equal(Term, Term),
    Not(Box<Self>),
    And(Vec<Self>),
    Or(Vec<Self>),
    Imply(Box<Self>, Box<Self>),
    ForAll(Box<Self>),
    Exists(Box<Self>),
}

#[derive(Debug, Clone)]
enum Effect {
    Add(&'static str, Vec<Term>),
    Delete(&'static str, Vec<Term>),
    When(Form, Box<Self>),
    ForAll(Box<Self>),
}

struct Action {
    parameters: usize,
    condition: Form,
    effects: Vec<Effect>,
}

struct Made {
    actions: Vec<Action>,
    /// `d ?0 ?1` and `e ?0`.
    derived: [Form; 2],
    init: State,
    goal: Form,
}

type State = BTreeSet<(&'static str, Vec<usize>)>;

/// A generator of numbers (G. Marsaglia's xorshift): the tests need no better.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % sides as u64) as usize
    }

    fn term(&mut self, bound: usize) -> Term {
        match self.roll(bound + 1) {
            0 => Term::Object(self.roll(OBJECTS)),
            n => Term::Variable(n - 1),
        }
    }

    fn terms(&mut self, count: usize, bound: usize) -> Vec<Term> {
        (0..count).map(|_| self.term(bound)).collect()
    }

    fn base(&mut self, bound: usize) -> (&'static str, Vec<Term>) {
        let (name, count) = [("p", 1), ("q", 1), ("r", 2), ("z", 0)][self.roll(4)];
        (name, self.terms(count, bound))
    }

    fn form(&mut self, depth: usize, bound: usize, derived: bool) -> Form {
        let several = |dice: &mut Self| {
            (0..1 + dice.roll(3)).map(|_| dice.form(depth - 1, bound, derived)).collect()
        };
        match self.roll(if depth == 0 { 4 } else { 12 }) {
            0 if derived => {
                let (name, count) = [("d", 2), ("e", 1)][self.roll(2)];
                Form::Atom(name, self.terms(count, bound))
            }
            1 => Form::Not(Box::new(self.form(0, bound, derived))),
            2 if bound > 0 => Form::Equal(self.term(bound), self.term(bound)),
            0..=3 => {
                let (name, terms) = self.base(bound);
                Form::Atom(name, terms)
            }
            4 | 5 => Form::And(several(self)),
            6 | 7 => Form::Or(several(self)),
            8 => Form::Not(Box::new(self.form(depth - 1, bound, derived))),
            9 => {
                let (a, b) =
                    (self.form(depth - 1, bound, derived), self.form(depth - 1, bound, derived));
                Form::Imply(Box::new(a), Box::new(b))
            }
            10 => Form::ForAll(Box::new(self.form(depth - 1, bound + 1, derived))),
            _ => Form::Exists(Box::new(self.form(depth - 1, bound + 1, derived))),
        }
    }

    fn effect(&mut self, bound: usize, depth: usize) -> Effect {
        match self.roll(if depth == 0 { 4 } else { 8 }) {
            0 | 1 => {
                let (name, terms) = self.base(bound);
                Effect::Delete(name, terms)
            }
            2 | 3 => {
                let (name, terms) = self.base(bound);
                Effect::Add(name, terms)
            }
            4 | 5 => {
                Effect::When(self.form(1, bound, true), Box::new(self.effect(bound, depth - 1)))
            }
            _ => Effect::ForAll(Box::new(self.effect(bound + 1, depth - 1))),
        }
    }

    fn problem(&mut self) -> Made {
        let action = |dice: &mut Self| {
            let parameters = dice.roll(3);
            Action {
                parameters,
                condition: dice.form(2, parameters, true),
                effects: (0..1 + dice.roll(3)).map(|_| dice.effect(parameters, 2)).collect(),
            }
        };
        let mut init = State::new();
        for _ in 0..self.roll(8) {
            let (name, terms) = self.base(0);
            let of = |term: &Term| if let Term::Object(n) = term { *n } else { 0 };
            init.insert((name, terms.iter().map(of).collect()));
        }
        let v = Term::Variable;
        // Ways over r, and what has none.
        let further =
            Form::And(vec![Form::Atom("r", vec![v(0), v(2)]), Form::Atom("d", vec![v(2), v(1)])]);
        let ways =
            Form::Or(vec![Form::Atom("r", vec![v(0), v(1)]), Form::Exists(Box::new(further))]);
        let alone = match self.roll(2) {
            0 => Form::ForAll(Box::new(Form::Not(Box::new(Form::Atom("d", vec![v(0), v(1)]))))),
            _ => self.form(2, 1, false),
        };
        Made {
            actions: (0..1 + self.roll(3)).map(|_| action(self)).collect(),
            derived: [ways, alone],
            init,
            goal: self.form(2, 0, true),
        }
    }
}

fn value(term: &Term, bound: &[usize]) -> usize {
    match term {
        Term::Object(object) => *object,
        Term::Variable(place) => bound[*place],
    }
}

fn holds(form: &Form, bound: &mut Vec<usize>, state: &State) -> bool {
    let each = |inner: &Form, bound: &mut Vec<usize>| -> Vec<bool> {
        (0..OBJECTS)
            .map(|object| {
                bound.push(object);
                let held = holds(inner, bound, state);
                bound.pop();
                held
            })
            .collect()
    };
    match form {
        Form::Atom(name, terms) => {
            state.contains(&(*name, terms.iter().map(|term| value(term, bound)).collect()))
        }
        Form::Equal(a, b) => value(a, bound) == value(b, bound),
        Form::Not(inner) => !holds(inner, bound, state),
        Form::And(parts) => parts.iter().all(|part| holds(part, bound, state)),
        Form::Or(parts) => parts.iter().any(|part| holds(part, bound, state)),
        Form::Imply(a, b) => !holds(a, bound, state) || holds(b, bound, state),
        Form::ForAll(inner) => each(inner, bound).into_iter().all(|held| held),
        Form::Exists(inner) => each(inner, bound).into_iter().any(|held| held),
    }
}

fn come(
    effect: &Effect,
    bound: &mut Vec<usize>,
    state: &State,
    adds: &mut State,
    dels: &mut State,
) {
    match effect {
        Effect::Add(name, terms) => {
            adds.insert((name, terms.iter().map(|term| value(term, bound)).collect()));
        }
        Effect::Delete(name, terms) => {
            dels.insert((name, terms.iter().map(|term| value(term, bound)).collect()));
        }
        Effect::When(form, inner) => {
            if holds(form, bound, state) {
                come(inner, bound, state, adds, dels);
            }
        }
        Effect::ForAll(inner) => {
            for object in 0..OBJECTS {
                bound.push(object);
                come(inner, bound, state, adds, dels);
                bound.pop();
            }
        }
    }
}

fn choices(count: usize) -> Vec<Vec<usize>> {
    (0..OBJECTS.pow(count as u32))
        .map(|number| {
            (0..count).map(|place| number / OBJECTS.pow(place as u32) % OBJECTS).collect()
        })
        .collect()
}

impl Made {
    /// A state with all that is derived in it.
    fn derived(&self, base: &State) -> State {
        let mut state = base.clone();
        for (name, form, count) in [("d", &self.derived[0], 2), ("e", &self.derived[1], 1)] {
            loop {
                let news: Vec<_> = choices(count)
                    .into_iter()
                    .filter(|args| holds(form, &mut args.clone(), &state))
                    .map(|args| (name, args))
                    .collect();
                let before = state.len();
                state.extend(news);
                if state.len() == before {
                    break;
                }
            }
        }
        state
    }

    /// The fewest actions by which the goal is met, where these are no more than `most`.
    fn fewest(&self, most: usize) -> Option<usize> {
        let mut seen = HashSet::from([self.init.clone()]);
        let mut open = VecDeque::from([(self.init.clone(), 0)]);
        while let Some((base, depth)) = open.pop_front() {
            let state = self.derived(&base);
            if holds(&self.goal, &mut Vec::new(), &state) {
                return Some(depth);
            }
            if depth == most {
                continue;
            }
            for action in &self.actions {
                for mut args in choices(action.parameters) {
                    if !holds(&action.condition, &mut args, &state) {
                        continue;
                    }
                    let (mut adds, mut dels) = (State::new(), State::new());
                    for effect in &action.effects {
                        come(effect, &mut args, &state, &mut adds, &mut dels);
                    }
                    let mut next: State = base.difference(&dels).cloned().collect();
                    next.extend(adds);
                    if seen.insert(next.clone()) {
                        open.push_back((next, depth + 1));
                    }
                }
            }
        }
        None
    }

    fn domain(&self) -> String {
        let mut text = "(define (domain made) (:requirements :adl :derived-predicates)
            (:predicates (p ?x) (q ?x) (r ?x ?y) (z) (d ?x ?y) (e ?x))\n"
            .to_owned();
        let _ = writeln!(text, "(:derived (d ?v0 ?v1) {})", written(&self.derived[0], 2));
        let _ = writeln!(text, "(:derived (e ?v0) {})", written(&self.derived[1], 1));
        for (number, action) in self.actions.iter().enumerate() {
            let parameters: Vec<String> =
                (0..action.parameters).map(|n| format!("?v{n}")).collect();
            let effects: Vec<String> =
                action.effects.iter().map(|e| effect_written(e, action.parameters)).collect();
            let _ = writeln!(
                text,
                "(:action a{number} :parameters ({}) :precondition {} :effect (and {}))",
                parameters.join(" "),
                written(&action.condition, action.parameters),
                effects.join(" ")
            );
        }
        text + ")"
    }

    fn problem(&self) -> String {
        let facts: Vec<String> = self
            .init
            .iter()
            .map(|(name, args)| {
                let args: Vec<String> = args.iter().map(|n| format!(" o{n}")).collect();
                format!("({name}{})", args.concat())
            })
            .collect();
        format!(
            "(define (problem one) (:domain made) (:objects o0 o1 o2) (:init {}) (:goal {}))",
            facts.join(" "),
            written(&self.goal, 0)
        )
    }
}

fn word(term: &Term) -> String {
    match term {
        Term::Object(object) => format!("o{object}"),
        Term::Variable(place) => format!("?v{place}"),
    }
}

fn atom(name: &str, terms: &[Term]) -> String {
    let terms: Vec<String> = terms.iter().map(|term| format!(" {}", word(term))).collect();
    format!("({name}{})", terms.concat())
}

fn written(form: &Form, bound: usize) -> String {
    let all = |parts: &[Form]| {
        parts.iter().map(|part| written(part, bound)).collect::<Vec<_>>().join(" ")
    };
    match form {
        Form::Atom(name, terms) => atom(name, terms),
        Form::Equal(a, b) => format!("(= {} {})", word(a), word(b)),
        Form::Not(inner) => format!("(not {})", written(inner, bound)),
        Form::And(parts) => format!("(and {})", all(parts)),
        Form::Or(parts) => format!("(or {})", all(parts)),
        Form::Imply(a, b) => format!("(imply {} {})", written(a, bound), written(b, bound)),
        Form::ForAll(inner) => format!("(forall (?v{bound}) {})", written(inner, bound + 1)),
        Form::Exists(inner) => format!("(exists (?v{bound}) {})", written(inner, bound + 1)),
    }
}

fn effect_written(effect: &Effect, bound: usize) -> String {
    match effect {
        Effect::Add(name, terms) => atom(name, terms),
        Effect::Delete(name, terms) => format!("(not {})", atom(name, terms)),
        Effect::When(form, inner) => {
            format!("(when {} {})", written(form, bound), effect_written(inner, bound))
        }
        Effect::ForAll(inner) => {
            format!("(forall (?v{bound}) {})", effect_written(inner, bound + 1))
        }
    }
}

/// A plan of the fewest actions over a ground task, where they are no more than `most`.
fn fewest(task: &Task, most: usize) -> Option<Vec<OperatorId>> {
    let start: BTreeSet<FactId> = task.init.iter().copied().collect();
    let mut seen = HashSet::from([start.clone()]);
    let mut open = VecDeque::from([(start, Vec::new())]);
    while let Some((state, plan)) = open.pop_front() {
        if task.goal.iter().all(|fact| state.contains(fact)) {
            return Some(plan);
        }
        if plan.len() == most {
            continue;
        }
        for id in task.operator_ids() {
            let operator = task.operator(id);
            if !operator.preconditions.iter().all(|fact| state.contains(fact)) {
                continue;
            }
            let mut next = state.clone();
            operator.del_effects.iter().for_each(|fact| {
                next.remove(fact);
            });
            next.extend(operator.add_effects.iter().copied());
            if seen.insert(next.clone()) {
                open.push_back((next, [plan.as_slice(), &[id]].concat()));
            }
        }
    }
    None
}

/// Plans are as long as the interpreter's, and the replay on the rules carries them out.
#[test]
fn as_many_actions_as_an_interpreter_of_the_text_needs() {
    const MOST: usize = 3;
    let (mut planned, mut divided, mut without) = (0, 0, 0);
    for seed in 1..=6000_u64 {
        let made = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1).problem();
        let (domain, problem) = (Source::new("d", made.domain()), Source::new("p", made.problem()));
        let scenario = match Scenario::parse_pddl(&domain, &problem) {
            Ok(scenario) => scenario,
            // A condition that cannot be is a fault, as it is in rules without «or».
            Err(faults)
                if faults.codes().iter().all(|code| code.starts_with("strips::contradictory")) =>
            {
                continue;
            }
            Err(faults) => panic!("{seed}: {faults}\n{}\n{}", made.domain(), made.problem()),
        };
        let task = match scenario.ground() {
            Ok(task) => task,
            // Told, and not guessed.
            Err(faults) if faults.codes() == ["strips::too_many_cases"] => continue,
            Err(faults) => panic!("{seed}: {faults}"),
        };
        task.check_invariants();
        let by_cases = task.facts.iter().any(|fact| &*fact.predicate == GOAL_STEP);
        divided += usize::from(by_cases);
        let wanted = made.fewest(MOST);
        let found = fewest(&task, MOST + usize::from(by_cases));
        let shown = || format!("{seed}\n{}\n{}", made.domain(), made.problem());
        assert_eq!(
            found.as_ref().map(|plan| plan.len() - usize::from(by_cases)),
            wanted,
            "{}",
            shown()
        );
        let Some(plan) = found else {
            without += 1;
            continue;
        };
        let mut steps: Vec<Vec<OperatorId>> = plan.iter().map(|&id| vec![id]).collect();
        let mut chosen = task.clone();
        chosen.choose_disjunct(&mut steps);
        chosen.check_invariants();
        assert_eq!(steps.len() + usize::from(by_cases), plan.len(), "{}", shown());
        planned += usize::from(!steps.is_empty());
        let lines: Vec<String> = steps
            .iter()
            .flatten()
            .enumerate()
            .map(|(step, &id)| {
                let operator = task.operator(id);
                format!("{}: ({} {})\n", step + 1, operator.name, operator.args.join(" "))
            })
            .collect();
        let text = PlanText::parse(&Source::new("plan", lines.concat()));
        if lines.is_empty() {
            continue;
        }
        let checked = text.and_then(|text| text.check(&scenario.domain, &scenario.problem));
        assert!(checked.is_ok(), "{}\n{}\n{}", shown(), lines.concat(), checked.unwrap_err());
    }
    assert!(planned > 300 && divided > 200 && without > 1000, "{planned} {divided} {without}");
}
