//! Why a goal is out of reach, and what would bring it nearer (SPEC P6).
//!
//! From the goal the rules are walked backward: an action that would give the fact, with all its preconditions
//! reachable but one (two, where one is not enough), shifts the question to the precondition that is missing. The
//! cheapest such chain that ends in something no action gives is the explanation. Objects are preferred that
//! the facts already bring together: a door that stands between these two rooms, locked, rather than any door.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap, HashSet};
use std::fmt;

use super::domain::{Domain, PredicateId, SchemaAtom, SchemaTerm};
use super::error::RuleFaults;
use super::ground::{Binding, Reachability};
use super::problem::{GroundAtom, Problem, Resolved, ThingId};
use super::task::Fact;
use crate::units::{Language, name_key};

/// Why one fact of the goal cannot be reached.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Obstacle {
    pub goal: String,
    /// From the goal backward; what the last one names is given by no action. Each would help.
    pub missing: Vec<Missing>,
}

/// A fact that an action needs and that cannot be had.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Missing {
    pub fact: String,
    /// The action that would give what stands before in the chain, if this fact held.
    pub action: String,
    /// Facts that hold of the same objects now, such as a door being locked.
    pub now: Vec<String>,
    /// Whether some action of the rules could give such a fact.
    pub has_action: bool,
}

impl Obstacle {
    /// The goal, and below it what is missing.
    #[must_use]
    pub fn in_words(&self, language: Language) -> String {
        let goal = &self.goal;
        let mut text = language
            .pick(format!("цель {goal} недостижима"), format!("the goal {goal} is out of reach"));
        if self.missing.is_empty() {
            text += language
                .pick(": ни одно действие не даёт этого факта", ": no action brings it about");
        }
        for Missing { fact, action, now, has_action } in &self.missing {
            text += &language.pick(
                format!("\n  для этого ({action}) нужно {fact}"),
                format!("\n  for this ({action}) it takes {fact}"),
            );
            if !now.is_empty() {
                text += language.pick("; сейчас ", "; now it is ");
                text += &now.join(", ");
            }
            if !has_action {
                text += language.pick(
                    "; это не так, и ни одно действие этого не даёт",
                    "; it is not so, and no action brings it about",
                );
            }
        }
        text
    }
}

/// In Russian.
impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_words(Language::Russian))
    }
}

/// Explains facts that no action can reach.
///
/// # Errors
/// As [`super::ground`], when the problem does not even ground.
pub fn explain_unreachable<'a>(
    domain: &Domain,
    problem: &Problem,
    goals: impl IntoIterator<Item = &'a Fact>,
) -> Result<Vec<Obstacle>, RuleFaults> {
    let resolved = problem.resolve(domain)?;
    let reached = Reachability::run(domain, &resolved)?;
    let explainer = Explainer { domain, resolved: &resolved, reached: &reached };
    Ok(goals.into_iter().map(|goal| explainer.obstacle(goal)).collect())
}

/// An atom whose open places are any object.
type OpenAtom = (PredicateId, Vec<Option<ThingId>>);

struct Explainer<'a> {
    domain: &'a Domain,
    resolved: &'a Resolved,
    reached: &'a Reachability<'a>,
}

/// A node of the search: an atom that is missing, and how it came to be asked for.
struct Node {
    atom: OpenAtom,
    parent: Option<usize>,
    schema: usize,
}

/// Nobody reads an explanation that took longer to find.
const MOST_NODES: usize = 2_000;
const MOST_BINDINGS: usize = 500;

impl Explainer<'_> {
    fn obstacle(&self, goal: &Fact) -> Obstacle {
        let shown = goal.to_string();
        let Some(atom) = self.atom(goal).filter(|_| !goal.negated) else {
            return Obstacle { goal: shown, missing: Vec::new() };
        };
        Obstacle { goal: shown, missing: self.chain(&atom) }
    }

    fn atom(&self, fact: &Fact) -> Option<GroundAtom> {
        let thing = |name| self.resolved.index.get(&name_key(name)).copied();
        Some(GroundAtom {
            predicate: self.domain.predicate(&fact.predicate)?,
            args: fact.args.iter().map(|name| thing(name)).collect::<Option<_>>()?,
        })
    }

    /// The cheapest chain of missing facts from the goal to one that no action gives.
    fn chain(&self, goal: &GroundAtom) -> Vec<Missing> {
        let start = (goal.predicate, goal.args.iter().copied().map(Some).collect());
        let mut nodes = vec![Node { atom: start, parent: None, schema: 0 }];
        let mut queue = BinaryHeap::from([Reverse((0, 0))]);
        let mut seen: HashSet<OpenAtom> = HashSet::new();
        let mut deepest = 0;
        while let Some(Reverse((cost, number))) = queue.pop() {
            if nodes.len() > MOST_NODES {
                break;
            }
            if !seen.insert(nodes[number].atom.clone()) {
                continue;
            }
            deepest = number;
            let reasons = self.reasons(&nodes[number].atom);
            if reasons.is_empty() && number != 0 {
                return self.told(&nodes, number);
            }
            for ((schema, atom), price) in reasons {
                queue.push(Reverse((cost + price, nodes.len())));
                nodes.push(Node { atom, parent: Some(number), schema });
            }
        }
        self.told(&nodes, deepest)
    }

    /// Missing preconditions of actions that would give `atom`, with a price each.
    fn reasons(&self, (predicate, args): &OpenAtom) -> BTreeMap<(usize, OpenAtom), u32> {
        let mut reasons: BTreeMap<(usize, OpenAtom), u32> = BTreeMap::new();
        for (number, schema) in self.domain.schemas.iter().enumerate() {
            for effect in schema.add_effects.iter().filter(|effect| effect.predicate == *predicate)
            {
                let mut binding: Binding = vec![None; schema.parameters.len()];
                if !self.bind(number, &mut binding, &effect.args, args) {
                    continue;
                }
                let places: Vec<usize> = (0..schema.preconditions.len()).collect();
                let single: Vec<Vec<usize>> = places.iter().map(|&at| vec![at]).collect();
                let double =
                    places.iter().flat_map(|&a| places[..a].iter().map(move |&b| vec![a, b]));
                for omitted in [single, double.collect()] {
                    let found = self.without(number, &binding, &omitted);
                    let any = !found.is_empty();
                    for (atoms, price) in found {
                        for atom in atoms {
                            let price = price + u32::from(!self.belong_together(&atom)) * 3;
                            let known = reasons.entry((number, atom)).or_insert(price);
                            *known = price.min(*known);
                        }
                    }
                    if any {
                        break;
                    }
                }
            }
        }
        reasons
    }

    fn bind(
        &self,
        schema: usize,
        binding: &mut Binding,
        terms: &[SchemaTerm],
        args: &[Option<ThingId>],
    ) -> bool {
        terms.iter().zip(args).all(|(term, arg)| match (term, arg) {
            (_, None) => true,
            (SchemaTerm::Constant(name), Some(thing)) => {
                self.resolved.index[&name_key(name)] == *thing
            }
            (SchemaTerm::Parameter(parameter), Some(thing)) => {
                let parameter = *parameter as usize;
                binding[parameter].is_none_or(|bound| bound == *thing) && {
                    binding[parameter] = Some(*thing);
                    self.reached.may_stand(schema, parameter, *thing)
                }
            }
        })
    }

    /// Ways to satisfy all preconditions but the omitted ones, which are then what is missing.
    fn without(
        &self,
        schema: usize,
        head: &Binding,
        omitted: &[Vec<usize>],
    ) -> Vec<(Vec<OpenAtom>, u32)> {
        let rule = &self.domain.schemas[schema];
        let mut found = Vec::new();
        for left_out in omitted {
            let open: Vec<usize> =
                (0..rule.preconditions.len()).filter(|at| !left_out.contains(at)).collect();
            let mut bindings = Vec::new();
            self.reached.bindings(schema, head.clone(), &open, MOST_BINDINGS, &mut bindings);
            for binding in bindings {
                let (mut missing, mut price) = (Vec::new(), 1 + 10 * (left_out.len() as u32 - 1));
                for &at in left_out {
                    let (atom, extra) = self.missing(&rule.preconditions[at], head, &binding);
                    price += extra;
                    missing.push(atom);
                }
                if missing.iter().all(|atom| !self.holds_somewhere(atom)) {
                    found.push((missing, price));
                }
            }
        }
        found
    }

    /// An omitted precondition as what is missing, and what it costs to believe so.
    ///
    /// A predicate that no action changes is the world's make. If it holds of no object at all in the places
    /// that the action leaves open, that is a true lack ("no key fits this door"); if it holds of another
    /// object there, it was only the wrong choice of object.
    fn missing(&self, atom: &SchemaAtom, head: &Binding, binding: &Binding) -> (OpenAtom, u32) {
        const WRONG_CHOICE: u32 = 50;
        let under = |binding: &Binding| -> OpenAtom {
            let value = |term| self.reached.value(binding, term);
            (atom.predicate, atom.args.iter().map(value).collect())
        };
        if self.domain.is_changed_by_actions(atom.predicate) {
            return (under(binding), 0);
        }
        let open = under(head);
        if self.holds_somewhere(&open) { (under(binding), WRONG_CHOICE) } else { (open, 0) }
    }

    fn holds_somewhere(&self, (predicate, args): &OpenAtom) -> bool {
        self.reached.atoms.iter().any(|atom| {
            atom.predicate == *predicate
                && atom
                    .args
                    .iter()
                    .zip(args)
                    .all(|(have, want)| want.is_none_or(|want| want == *have))
        })
    }

    /// Whether some initial fact of another predicate is about the same objects.
    fn belong_together(&self, atom: &OpenAtom) -> bool {
        atom.1.len() < 2 || !self.facts_about(atom).is_empty()
    }

    fn facts_about(&self, (predicate, args): &OpenAtom) -> Vec<&GroundAtom> {
        let wanted: BTreeSet<ThingId> = args.iter().flatten().copied().collect();
        if wanted.len() < 2 {
            return Vec::new();
        }
        let about = |atom: &&GroundAtom| {
            atom.predicate != *predicate
                && atom.args.len() == args.len()
                && atom
                    .args
                    .iter()
                    .zip(args)
                    .all(|(have, want)| want.is_none_or(|want| want == *have))
        };
        self.resolved.facts.iter().map(|(atom, _)| atom).filter(about).collect()
    }

    fn told(&self, nodes: &[Node], last: usize) -> Vec<Missing> {
        let mut missing = Vec::new();
        let mut at = last;
        while let Some(parent) = nodes[at].parent {
            let atom = &nodes[at].atom;
            missing.push(Missing {
                fact: self.shown(atom),
                action: self.domain.schemas[nodes[at].schema].name.clone(),
                now: self
                    .facts_about(atom)
                    .into_iter()
                    .map(|fact| {
                        self.shown(&(fact.predicate, fact.args.iter().copied().map(Some).collect()))
                    })
                    .collect(),
                has_action: self.domain.is_changed_by_actions(atom.0),
            });
            at = parent;
        }
        missing.reverse();
        missing
    }

    /// An open place as the rule language writes a variable: `КЛЮЧ_ПОДХОДИТ-К_(предмет ?, Дверь-ZY)`.
    fn shown(&self, (predicate, args): &OpenAtom) -> String {
        let predicate = &self.domain.predicates[predicate.index()];
        let args: Vec<String> = args
            .iter()
            .zip(&predicate.args)
            .map(|(arg, kinds)| match arg {
                Some(thing) => self.resolved.things[thing.index()].name.clone(),
                None if kinds.is_empty() => "?".to_owned(),
                None => format!("{} ?", self.domain.kind_names(kinds)),
            })
            .collect();
        format!("{}_({})", predicate.name, args.join(", "))
    }
}
