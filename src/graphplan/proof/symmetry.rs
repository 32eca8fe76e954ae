//! Objects that the initial state does not tell apart, so that what fails for one fails for the other.
//!
//! Two objects are interchangeable when swapping them turns the initial state and the set of operators into
//! themselves. A set of facts out of reach then stays out of reach under every exchange of such objects (the goal
//! plays no part), and [`super::no_good`] keeps one no-good for all of its images.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

use crate::Limits;
use crate::strips::{Fact, FactId, Operator, OperatorId, Task};
use crate::units::{Gather as _, InOrder as _};

/// For each fact, the object of it that may be exchanged, and the fact's image for the first of its kin.
#[derive(Debug)]
pub(crate) struct Symmetry {
    roles: Vec<Option<Role>>,
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Role {
    /// Which interchangeable object the fact is about.
    pub(crate) object: u32,
    /// The same fact about the first object of the class.
    pub(crate) image: FactId,
}

impl Symmetry {
    /// Once a limit is reached no further objects are found to be alike.
    pub(crate) fn of(task: &Task, limits: &Limits) -> Self {
        let index = Index::new(task);
        let mut roles = vec![None; task.facts.len()];
        let mut taken: HashSet<&Arc<str>> = HashSet::new();
        let mut classes =
            index.classes(|a, b| limits.check(0).is_ok() && index.interchangeable(a, b));
        classes.order_by_key(|class| std::cmp::Reverse(class.len()));
        for class in classes {
            // A fact may speak of one exchangeable object only: images of sets are then found object by object.
            let members: HashSet<&Arc<str>> = class.iter().copied().collect();
            let alone = task.facts.iter().all(|fact| {
                let own = fact.args.iter().filter(|arg| members.contains(arg)).count();
                own == 0 || own == 1 && !fact.args.iter().any(|arg| taken.contains(arg))
            });
            if !alone {
                continue;
            }
            let first = class[0];
            for object in &class {
                for &fact in index.facts_of.get(*object).into_iter().flatten() {
                    let image = index.swapped_fact(fact, first, object);
                    let image =
                        image.expect("swapping interchangeable objects maps facts to facts");
                    let object = index.numbers[*object];
                    roles[fact.index()] = Some(Role { object, image });
                }
            }
            taken.extend(members);
        }
        Self { roles }
    }

    pub(crate) fn role(&self, fact: FactId) -> Option<Role> {
        self.roles[fact.index()]
    }
}

/// For each class of objects that neither initial state nor goal nor costs tell apart, for each object in the order of
/// names, the operators that it takes part in.
pub(crate) fn users_of_alike(task: &Task, limits: &Limits) -> Vec<Vec<Vec<OperatorId>>> {
    let index = Index::new(task);
    let users = |object: &Arc<str>| -> Vec<OperatorId> {
        let numbers = index.operators_of.get(object).into_iter().flatten();
        numbers.map(|&number| OperatorId(number as u32)).collect()
    };
    let are_alike = |a: &_, b: &_| index.interchangeable(a, b) && index.serve_alike(a, b);
    let classes = index.classes(|a, b| limits.check(0).is_ok() && are_alike(a, b));
    classes.into_iter().map(|class| class.into_iter().map(users).collect()).collect()
}

type Key = (Arc<str>, Vec<Arc<str>>, bool);

struct Index<'a> {
    task: &'a Task,
    numbers: BTreeMap<&'a Arc<str>, u32>,
    facts: HashMap<Key, FactId>,
    operators: HashMap<Key, usize>,
    facts_of: HashMap<&'a Arc<str>, Vec<FactId>>,
    operators_of: HashMap<&'a Arc<str>, Vec<usize>>,
    initially: Vec<bool>,
}

fn fact_key(fact: &Fact) -> Key {
    (fact.predicate.clone(), fact.args.clone(), fact.negated)
}

fn operator_key(operator: &Operator) -> Key {
    (operator.name.clone(), operator.args.clone(), false)
}

fn swapped((name, args, negated): Key, a: &Arc<str>, b: &Arc<str>) -> Key {
    let swap = |arg: Arc<str>| match &arg {
        arg if arg == a => b.clone(),
        arg if arg == b => a.clone(),
        _ => arg,
    };
    (name, args.into_iter().map(swap).collect(), negated)
}

impl<'a> Index<'a> {
    fn new(task: &'a Task) -> Self {
        let mut facts_of: HashMap<&Arc<str>, Vec<FactId>> = HashMap::new();
        let mut operators_of: HashMap<&Arc<str>, Vec<usize>> = HashMap::new();
        for id in task.fact_ids() {
            for arg in &task.fact(id).args {
                let facts = facts_of.entry(arg).or_default();
                if facts.last() != Some(&id) {
                    facts.push(id);
                }
            }
        }
        for (number, operator) in task.operators.iter().enumerate() {
            // A rule may name an object that is none of its parameters.
            let lists = [&operator.preconditions, &operator.add_effects, &operator.del_effects];
            let facts = lists.into_iter().flatten();
            let named = facts.flat_map(|&fact| &task.fact(fact).args);
            for arg in operator.args.iter().chain(named) {
                let operators = operators_of.entry(arg).or_default();
                if operators.last() != Some(&number) {
                    operators.push(number);
                }
            }
        }
        let names: std::collections::BTreeSet<&Arc<str>> = facts_of.keys().copied().gather();
        let mut initially = vec![false; task.facts.len()];
        task.init.iter().for_each(|fact| initially[fact.index()] = true);
        Self {
            task,
            numbers: names.into_iter().zip(0..).collect(),
            facts: task.fact_ids().map(|id| (fact_key(task.fact(id)), id)).collect(),
            operators: task.operators.iter().map(operator_key).zip(0..).collect(),
            facts_of,
            operators_of,
            initially,
        }
    }

    /// Classes of two or more interchangeable objects, each in the order of names.
    fn classes(&self, are_alike: impl Fn(&Arc<str>, &Arc<str>) -> bool) -> Vec<Vec<&'a Arc<str>>> {
        // Objects that could be alike at all: as many facts, at first and in all, and as many operators.
        let mut alike: BTreeMap<(usize, usize, usize), Vec<&Arc<str>>> = BTreeMap::new();
        for &object in self.numbers.keys() {
            let facts = &self.facts_of[object];
            let held = facts.iter().filter(|fact| self.initially[fact.index()]).count();
            let used = self.operators_of.get(object).map_or(0, Vec::len);
            alike.entry((facts.len(), held, used)).or_default().push(object);
        }
        let mut classes: Vec<Vec<&Arc<str>>> = Vec::new();
        for objects in alike.into_values() {
            let before = classes.len();
            for object in objects {
                let home = classes[before..].iter_mut().find(|class| are_alike(class[0], object));
                match home {
                    Some(class) => class.push(object),
                    None => classes.push(vec![object]),
                }
            }
        }
        classes.retain(|class| class.len() > 1);
        classes
    }

    fn swapped_fact(&self, fact: FactId, a: &Arc<str>, b: &Arc<str>) -> Option<FactId> {
        self.facts.get(&swapped(fact_key(self.task.fact(fact)), a, b)).copied()
    }

    fn interchangeable(&self, a: &Arc<str>, b: &Arc<str>) -> bool {
        let facts = self.facts_of[a].iter().chain(&self.facts_of[b]);
        let operators =
            [a, b].into_iter().filter_map(|object| self.operators_of.get(object)).flatten();
        facts.into_iter().all(|&fact| {
            self.swapped_fact(fact, a, b)
                .is_some_and(|image| self.initially[image.index()] == self.initially[fact.index()])
        }) && operators.into_iter().all(|&number| self.operator_maps(number, a, b))
    }

    /// Whether the goal is the same after a swap, and what operators cost.
    fn serve_alike(&self, a: &Arc<str>, b: &Arc<str>) -> bool {
        let goal = &self.task.goal;
        let operators =
            [a, b].into_iter().filter_map(|object| self.operators_of.get(object)).flatten();
        goal.iter()
            .all(|&fact| self.swapped_fact(fact, a, b).is_some_and(|image| goal.contains(&image)))
            && operators.into_iter().all(|&number| {
                let operator = &self.task.operators[number];
                let image = self.operators.get(&swapped(operator_key(operator), a, b));
                image.is_some_and(|&image| self.task.operators[image].cost == operator.cost)
            })
    }

    fn operator_maps(&self, number: usize, a: &Arc<str>, b: &Arc<str>) -> bool {
        let operator = &self.task.operators[number];
        let Some(&image) = self.operators.get(&swapped(operator_key(operator), a, b)) else {
            return false;
        };
        let image = &self.task.operators[image];
        let maps = |from: &[FactId], to: &[FactId]| {
            from.len() == to.len()
                && from
                    .iter()
                    .all(|&fact| self.swapped_fact(fact, a, b).is_some_and(|f| to.contains(&f)))
        };
        maps(&operator.preconditions, &image.preconditions)
            && maps(&operator.add_effects, &image.add_effects)
            && maps(&operator.del_effects, &image.del_effects)
            && maps(&operator.renewed, &image.renewed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Facts `a`, `b` and an operator from the one to the other, for each of three objects.
    fn task() -> Task {
        let object = |number: usize| -> Vec<Arc<str>> { vec![format!("object{number}").into()] };
        let fact = |name: &str, number| Fact {
            predicate: name.into(),
            args: object(number),
            negated: false,
        };
        Task {
            facts: (0..3).flat_map(|number| [fact("a", number), fact("b", number)]).collect(),
            operators: (0..3)
                .map(|number| Operator {
                    name: "swap".into(),
                    args: object(number),
                    preconditions: vec![FactId(2 * number as u32)],
                    add_effects: vec![FactId(2 * number as u32 + 1)],
                    del_effects: vec![FactId(2 * number as u32)],
                    renewed: Vec::new(),
                    cost: 1,
                })
                .collect(),
            init: [0, 2, 4].map(FactId).into(),
            goal: vec![FactId(1)],
            ..Task::default()
        }
    }

    /// The image of each fact, itself where it has none.
    fn images(task: &Task) -> Vec<u32> {
        let symmetry = Symmetry::of(task, &Limits::default());
        task.fact_ids().map(|fact| symmetry.role(fact).map_or(fact, |role| role.image).0).collect()
    }

    #[test]
    fn objects_alike_share_an_image() {
        // The goal speaks of one object only; what can be reached does not depend on it.
        assert_eq!(images(&task()), [0, 1, 0, 1, 0, 1]);
    }

    #[test]
    fn what_the_goal_tells_apart_is_not_used_in_order() {
        assert_eq!(
            users_of_alike(&task(), &Limits::default()),
            [[vec![OperatorId(1)], vec![OperatorId(2)]]]
        );
        let mut task = task();
        task.operators[2].cost = 2;
        assert!(users_of_alike(&task, &Limits::default()).is_empty());
    }

    #[test]
    fn another_initial_fact_tells_an_object_apart() {
        let mut task = task();
        task.init = [0, 3, 4].map(FactId).into();
        assert_eq!(images(&task), [0, 1, 2, 3, 0, 1]);
    }

    #[test]
    fn an_operator_that_names_an_object_without_a_parameter_tells_it_apart() {
        let mut task = task();
        let named =
            Operator { name: "first".into(), args: Vec::new(), ..task.operators[0].clone() };
        task.operators.push(named);
        assert_eq!(images(&task), [0, 1, 2, 3, 2, 3]);
    }

    #[test]
    fn another_effect_tells_an_object_apart() {
        let mut task = task();
        task.operators[1].del_effects.clear();
        assert_eq!(images(&task), [0, 1, 2, 3, 0, 1]);
    }
}
