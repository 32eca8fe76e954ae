//! Why a goal is out of reach, and what would bring it nearer (SPEC P6).
//!
//! What is lacking is found by [`super::lack`]; here it is told: from the goal backward, action by action, to what
//! nobody stated and no action brings about; what else would do as well; and which other ways turn in a circle.

use std::collections::{BTreeSet, HashSet, VecDeque};
use std::fmt;

use super::attain::Attainable;
use super::domain::{Domain, KindId};
use super::draft::GOAL_STEP;
use super::fault::RuleFaults;
use super::lack::{By, Lacks, fits};
use super::phrase::{Phrases, Said, SaidArgument, Wording};
use super::plain::plain;
use super::problem::Problem;
use super::reachability::Reachability;
use super::resolve::ThingId;
use super::simplify::NO_CASE;
use super::task::Fact;
use super::wanted::Wanted;
use crate::units::{Gather as _, Language, name_key, told};

/// Why one fact of the goal cannot be reached.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Obstacle {
    pub goal: Said,
    /// From the goal backward.
    pub missing: Vec<Missing>,
    /// Other ways to what stands before the last, that need it themselves.
    pub circles: Vec<Missing>,
    /// Sets of facts of which each would do; the first is what the last of `missing` comes to.
    pub help: Vec<Vec<Said>>,
    /// Whether nothing stated would do, since the missing facts only need each other.
    pub turns_in_a_circle: bool,
    /// Whether every single need of the goal could be met, if not together with the others.
    pub is_met_singly: bool,
    /// Then the needs that do not go together, where that was found out.
    pub clash: Option<Clash>,
    /// Why was not looked into: the rules have conditions beyond literals.
    pub is_unexplained: bool,
}

/// An action two of whose needs exclude each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Clash {
    pub action: Said,
    pub needs: (Said, Said),
}

/// A fact that an action needs and that cannot be had.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Missing {
    pub fact: Said,
    /// The action that would give what stands before in the chain, if this fact held.
    pub action: Said,
    /// Facts that hold of the same objects now, such as a door being locked.
    pub now: Vec<Said>,
    /// Whether some action of the rules could give such a fact.
    pub has_action: bool,
    /// The way back to what is named before in the chain; none where there is no such way.
    pub circle: Vec<Turn>,
}

/// A step of a way that turns in a circle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Turn {
    /// It would give what stands before.
    pub action: Said,
    /// The fact that it takes and the next step would give; none where that is named already.
    pub takes: Option<Said>,
}

impl Obstacle {
    /// The goal, below it what is missing, and what would help.
    #[must_use]
    pub fn in_words(&self, wording: &Wording<'_>) -> String {
        let language = wording.language;
        let goal = wording.fact(&self.goal);
        let mut text = match self.goal.name.as_str() {
            NO_CASE => return told!(language, "no-case-of-the-goal"),
            GOAL_STEP => told!(language, "goal-by-none-of-its-ways"),
            _ => told!(language, "goal-out-of-reach", goal),
        };
        if self.is_unexplained {
            return text + &told!(language, "in-whatever-order");
        }
        if self.is_met_singly {
            text += &told!(language, "one-by-one-not-together");
            if let Some(Clash { action, needs: (a, b) }) = &self.clash {
                let (action, a, b) = (wording.action(action), wording.fact(a), wording.fact(b));
                text += "\n  ";
                text += &told!(language, "needs-exclude-each-other", action, a, b);
            }
            return text;
        }
        if self.missing.is_empty() {
            return text + &told!(language, "no-action-brings-it-about");
        }
        for (number, missing) in self.missing.iter().enumerate() {
            text += &missing.in_words(wording);
            if number + 1 == self.missing.len() {
                text += &missing.end_in_words(wording, self.turns_in_a_circle);
            }
        }
        for Missing { fact, action, .. } in &self.circles {
            let (fact, action) = (wording.fact(fact), wording.kind_of_action(action));
            text += "\n  ";
            text += &told!(language, "another-way-is-no-help", action, fact);
        }
        if !self.help.is_empty() {
            let and = told!(language, "help-and");
            let set = |facts: &Vec<Said>| {
                let facts: Vec<String> = facts.iter().map(|fact| wording.fact(fact)).collect();
                facts.join(&and)
            };
            let sets: Vec<String> = self.help.iter().map(set).collect();
            let sets = sets.join(&told!(language, "help-or"));
            text += "\n";
            text += &told!(language, "it-would-help", sets);
        }
        text
    }
}

impl Missing {
    fn in_words(&self, wording: &Wording<'_>) -> String {
        let (fact, action) = (wording.fact(&self.fact), wording.kind_of_action(&self.action));
        let mut text = "\n  ".to_owned();
        text += &match self.action.name == GOAL_STEP {
            true => told!(wording.language, "for-this", fact),
            false => told!(wording.language, "for-this-by-an-action", action, fact),
        };
        if !self.now.is_empty() {
            let now: Vec<String> = self.now.iter().map(|fact| wording.fact(fact)).collect();
            text += &told!(wording.language, "now-it-is", now = now.join(", "));
        }
        text
    }

    fn end_in_words(&self, wording: &Wording<'_>, is_circle: bool) -> String {
        let language = wording.language;
        if !self.circle.is_empty() && !is_circle {
            return self.circle.iter().map(|turn| turn.in_words(wording)).collect();
        }
        match (is_circle, self.has_action) {
            (true, _) => told!(language, "that-takes-what-was-named"),
            (false, true) => told!(language, "nothing-leads-to-it"),
            (false, false) => told!(language, "it-is-not-so-and-no-action"),
        }
    }
}

impl Turn {
    fn in_words(&self, wording: &Wording<'_>) -> String {
        let (language, action) = (wording.language, wording.kind_of_action(&self.action));
        let gives = told!(language, "this-would-bring-it-about", action);
        let takes = match self.takes.as_ref().map(|fact| wording.fact(fact)) {
            Some(fact) => told!(language, "and-takes", fact),
            None => told!(language, "and-takes-what-was-named"),
        };
        gives + &takes
    }
}

/// In Russian.
impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let phrases = Phrases::default();
        let name = |name: &str| name.to_owned();
        let wording = Wording { language: Language::Russian, phrases: &phrases, name: &name };
        f.write_str(&self.in_words(&wording))
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
    let is_plain = !domain.is_beyond_literals() && resolved.goal_formulas.is_empty();
    let plain = if is_plain { None } else { plain(domain, &resolved) };
    let is_unexplained = !is_plain && plain.is_none();
    let domain = plain.as_ref().unwrap_or(domain);
    let reached = Reachability::run(domain, &resolved)?;
    let attainable = Attainable::of(domain, &resolved, &reached);
    let obstacle = |goal: &Fact| {
        let thing = |name| resolved.index.get(&name_key(name)).copied().map(Some);
        let wanted = domain.predicate(&goal.predicate).and_then(|predicate| {
            let args = goal.args.iter().map(|name| thing(name)).collect::<Option<_>>()?;
            Some(Wanted { negated: goal.negated, ..Wanted::of(predicate, args) })
        });
        let none = Obstacle {
            goal: Said::from(goal),
            missing: Vec::new(),
            circles: Vec::new(),
            help: Vec::new(),
            turns_in_a_circle: false,
            is_met_singly: false,
            clash: None,
            is_unexplained,
        };
        let Some(wanted) = wanted.filter(|_| !none.is_unexplained) else { return none };
        if attainable.can_be(&wanted) {
            return Obstacle { is_met_singly: true, ..none };
        }
        let lacks = Lacks::new(domain, &resolved, &reached, &attainable, wanted);
        let chain = Chain::of(&lacks);
        let help = chain.help(&lacks);
        Obstacle {
            missing: chain.missing(&lacks),
            circles: chain.circles(&lacks),
            turns_in_a_circle: help.is_empty(),
            help,
            ..none
        }
    };
    Ok(goals.into_iter().map(obstacle).collect())
}

/// A longer circle is not followed by who reads of it.
const MOST_TURNS: usize = 4;
/// Alternatives beyond these are not read.
const MOST_ALTERNATIVES: usize = 3;

/// The way from the goal to what is lacking.
struct Chain {
    /// Ways, and what is followed of that which they miss.
    links: Vec<(usize, usize)>,
}

impl Chain {
    fn of(lacks: &Lacks<'_>) -> Self {
        let (mut links, mut fact, mut seen) = (Vec::new(), 0, HashSet::new());
        while seen.insert(fact) {
            let way = match lacks.best(fact) {
                Some(By::Statement) => break,
                Some(By::Way(way)) => way,
                // Nothing stated would help: any way shows the circle.
                None => {
                    match lacks.ways_to(fact).min_by_key(|&way| lacks.ways[way].missing.len()) {
                        Some(way) => way,
                        None => break,
                    }
                }
            };
            fact = followed(lacks, &lacks.ways[way].missing);
            links.push((way, fact));
        }
        Self { links }
    }

    /// What is missing, link by link; of the last also how it would come about, did that not take what stands before.
    fn missing(&self, lacks: &Lacks<'_>) -> Vec<Missing> {
        let mut missing: Vec<Missing> =
            self.links.iter().map(|&(way, fact)| told(lacks, way, fact)).collect();
        if let Some(last) = missing.last_mut() {
            last.circle = self.circle(lacks);
        }
        missing
    }

    /// The shortest way from the last fact back to one of the chain, through facts each of which is all that an action
    /// lacks.
    fn circle(&self, lacks: &Lacks<'_>) -> Vec<Turn> {
        let Some(&(_, last)) = self.links.last() else { return Vec::new() };
        // Of any object there is no saying which way leads to it.
        let is_closed = |fact: usize| lacks.facts[fact].args.iter().all(Option::is_some);
        if !is_closed(last) || lacks.best(last) != Some(By::Statement) {
            return Vec::new();
        }
        let is_named = |fact: &usize| *fact == 0 || self.links.iter().any(|(_, link)| link == fact);
        let (mut open, mut seen) = (VecDeque::from([(last, Vec::new())]), HashSet::from([last]));
        while let Some((fact, turns)) = open.pop_front() {
            let with = |way: usize, takes: Option<usize>| {
                let takes = takes.map(|fact| lacks.shown(&lacks.facts[fact]));
                let mut turns: Vec<Turn> = turns.clone();
                turns.push(Turn { action: lacks.action_of(way), takes });
                turns
            };
            if let Some(way) =
                lacks.ways_to(fact).find(|&w| lacks.ways[w].missing.iter().any(is_named))
            {
                return with(way, None);
            }
            for way in lacks.ways_to(fact).filter(|_| turns.len() + 1 < MOST_TURNS) {
                if let [takes] = lacks.ways[way].missing[..]
                    && is_closed(takes)
                    && !lacks.is_moving(takes)
                    && seen.insert(takes)
                {
                    open.push_back((takes, with(way, Some(takes))));
                }
            }
        }
        Vec::new()
    }

    /// Each set of statements that would do, the cheapest first.
    fn help(&self, lacks: &Lacks<'_>) -> Vec<Vec<Said>> {
        let shown = |facts: BTreeSet<usize>| -> Vec<Said> {
            facts.into_iter().map(|fact| lacks.shown(&lacks.facts[fact])).collect()
        };
        let first: Vec<Said> = shown(lacks.stated(0).collect());
        let Some((last, _)) = self.links.last().filter(|_| !first.is_empty()) else {
            return Vec::new();
        };
        let mut help = vec![first];
        let is_stated = |way: usize| match lacks.ways[way].missing[..] {
            [fact] => !lacks.ways[way].is_far_fetched && lacks.best(fact) == Some(By::Statement),
            _ => false,
        };
        // Where one statement is all it takes, others that give the same fact do as well.
        if lacks.stated(0).count() == 1 && is_stated(*last) {
            for way in lacks.ways_to(lacks.ways[*last].gives).filter(|&way| is_stated(way)) {
                let facts = shown(lacks.ways[way].missing.iter().copied().collect());
                if !help.contains(&facts) && help.len() < MOST_ALTERNATIVES {
                    help.push(facts);
                }
            }
        }
        help
    }

    /// Other ways to what the last one would give that need just that themselves, as a key does that lies behind
    /// the door which it opens.
    fn circles(&self, lacks: &Lacks<'_>) -> Vec<Missing> {
        let Some(&(taken, _)) = self.links.last() else { return Vec::new() };
        let gives = lacks.ways[taken].gives;
        let is_new = |fact: usize| fact != 0 && self.links.iter().all(|&(_, link)| link != fact);
        let mut circles: Vec<Missing> = Vec::new();
        for way in lacks.ways_to(gives).filter(|&way| way != taken && gives != 0) {
            let [fact] = lacks.ways[way].missing[..] else { continue };
            if is_new(fact)
                && lacks.leads_through(fact, gives)
                && lacks.is_of_known_objects(way, fact)
            {
                let circle = told(lacks, way, fact);
                if !circles.contains(&circle) && circles.len() < MOST_ALTERNATIVES {
                    circles.push(circle);
                }
            }
        }
        circles
    }
}

/// Of what a way misses, that on which most hangs, and the nearest such.
fn followed(lacks: &Lacks<'_>, missing: &[usize]) -> usize {
    let all: BTreeSet<usize> = missing.iter().flat_map(|&fact| lacks.stated(fact)).gather();
    let uncovered = |fact: usize| all.len() - lacks.stated(fact).count();
    let is_derived = |fact: usize| lacks.best(fact) != Some(By::Statement);
    let by = |&&fact: &&usize| (lacks.best(fact).is_some(), uncovered(fact), is_derived(fact));
    *missing.iter().min_by_key(by).expect("a way misses something")
}

fn told(lacks: &Lacks<'_>, way: usize, fact: usize) -> Missing {
    let wanted = &lacks.facts[fact];
    Missing {
        fact: lacks.shown(wanted),
        action: lacks.action_of(way),
        now: lacks.said_of_the_same(wanted),
        has_action: lacks.is_given_by_an_action(wanted),
        circle: Vec::new(),
    }
}

impl Lacks<'_> {
    /// Whether any action of the rules has such an effect.
    fn is_given_by_an_action(&self, wanted: &Wanted) -> bool {
        self.domain.schemas.iter().enumerate().any(|(number, schema)| {
            let effects = if wanted.negated { &schema.del_effects } else { &schema.add_effects };
            let same = effects.iter().filter(|effect| effect.predicate == wanted.predicate);
            same.into_iter().any(|effect| self.bound(number, &effect.args, &wanted.args).is_some())
        })
    }

    /// Initial facts of other predicates about the same two or more objects.
    fn said_of_the_same(&self, wanted: &Wanted) -> Vec<Said> {
        let objects: BTreeSet<ThingId> = wanted.args.iter().flatten().copied().gather();
        if objects.len() < 2 || wanted.negated {
            return Vec::new();
        }
        let facts = self.resolved.facts.iter().map(|(atom, _)| atom).filter(|atom| {
            atom.predicate != wanted.predicate
                && atom.args.len() == wanted.args.len()
                && fits(&atom.args, &wanted.args)
        });
        let shown = facts
            .map(|atom| Wanted::of(atom.predicate, atom.args.iter().copied().map(Some).collect()));
        shown.map(|wanted| self.shown(&wanted)).collect()
    }

    /// Whether a way speaks of objects that the facts already bring together, as a key and the door that it fits.
    fn is_of_known_objects(&self, way: usize, fact: usize) -> bool {
        let gives = &self.facts[self.ways[way].gives];
        let (of_fact, of_given) = (&self.facts[fact].args, &gives.args);
        let together = |a: &ThingId, b: &ThingId| {
            let facts = self.resolved.facts.iter();
            facts.map(|(atom, _)| &atom.args).any(|args| args.contains(a) && args.contains(b))
        };
        of_fact.iter().flatten().any(|a| {
            !of_given.contains(&Some(*a)) && of_given.iter().flatten().any(|b| together(a, b))
        })
    }

    /// The action of a way, with the objects that what it is to give names.
    fn action_of(&self, way: usize) -> Said {
        let (number, gives) = (self.ways[way].schema, &self.facts[self.ways[way].gives]);
        let schema = &self.domain.schemas[number];
        let effects = if gives.negated { &schema.del_effects } else { &schema.add_effects };
        let binding = effects
            .iter()
            .filter(|effect| effect.predicate == gives.predicate)
            .find_map(|effect| self.bound(number, &effect.args, &gives.args));
        let binding = binding.unwrap_or_else(|| vec![None; schema.parameters.len()]);
        // What only a quantifier speaks of is no object of the action.
        let is_named = |(number, _): &(usize, _)| {
            schema.parameter_names.get(*number).is_none_or(|name| !name.is_empty())
        };
        let args = binding.iter().zip(&schema.parameters).enumerate().filter(is_named);
        let args =
            args.map(|(_, pair)| pair).map(|(thing, kinds)| self.argument(*thing, kinds)).collect();
        Said { name: schema.name.clone(), args, negated: false }
    }

    /// An open place is told by its type.
    fn shown(&self, wanted: &Wanted) -> Said {
        let predicate = &self.domain.predicates[wanted.predicate.index()];
        let kinds = wanted.kinds.iter().zip(&predicate.args);
        let kinds = kinds.map(|(asked, taken)| if asked.is_empty() { taken } else { asked });
        let args = wanted.args.iter().zip(kinds);
        let args = args.map(|(thing, kinds)| self.argument(*thing, kinds)).collect();
        Said { name: predicate.name.clone(), args, negated: wanted.negated }
    }

    fn argument(&self, thing: Option<ThingId>, kinds: &[KindId]) -> SaidArgument {
        let name = |kind: &KindId| self.domain.kinds[kind.index()].name.clone();
        match thing {
            Some(thing) => SaidArgument::Object(self.resolved.things[thing.index()].name.clone()),
            None => SaidArgument::Any(kinds.iter().map(name).collect()),
        }
    }
}
