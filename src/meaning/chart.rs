//! Phrases from words, bottom up: every stretch of a sentence with all that it may be.
//!
//! Invariant: of edges alike over one stretch the cheapest are kept, and no phrase is longer than [`LONGEST`], so that a
//! chart grows with the length of the sentence, however many prepositional phrases stand in a row.

use super::features::Features;
use super::grammar::{Category, Phrase, Slot, Tongue};
use super::sense::{Bound, Sense, Signatures};
use super::words::{Edge, Token};

/// Words of the longest phrase.
const LONGEST: usize = 14;
/// Edges of one category over one stretch.
const MOST_ALIKE: usize = 8;

/// All edges of a sentence, by where they begin.
pub(crate) struct Chart<'t> {
    pub(crate) tokens: &'t [Token],
    edges: Vec<Vec<Edge>>,
}

impl<'t> Chart<'t> {
    /// The phrases over these words.
    pub(crate) fn of(
        tokens: &'t [Token],
        words: Vec<Edge>,
        tongue: &Tongue,
        roles: &Signatures,
    ) -> Self {
        let mut chart = Self { tokens, edges: vec![Vec::new(); tokens.len()] };
        for edge in words {
            chart.add(edge);
        }
        for length in 1..=LONGEST.min(tokens.len()) {
            for from in 0..=tokens.len() - length {
                // A phrase may be another one of the same words: a noun is a noun phrase.
                while chart.step(from, from + length, tongue, roles) {}
            }
        }
        chart
    }

    fn step(&mut self, from: usize, to: usize, tongue: &Tongue, roles: &Signatures) -> bool {
        let mut found = Vec::new();
        for rule in &tongue.rules {
            let mut search = Search { chart: self, rule, from, to, roles, chosen: Vec::new() };
            search.rest(from, &mut found);
        }
        let mut is_new = false;
        for edge in found {
            is_new |= self.add(edge);
        }
        is_new
    }

    /// Whether an edge is news.
    fn add(&mut self, edge: Edge) -> bool {
        let here = &mut self.edges[edge.from];
        let alike = |other: &&Edge| other.category == edge.category && other.to == edge.to;
        let same = |other: &&mut Edge| {
            other.category == edge.category
                && other.to == edge.to
                && other.features == edge.features
                && other.sense == edge.sense
        };
        if let Some(known) = here.iter_mut().find(same) {
            let is_cheaper = edge.cost < known.cost;
            known.cost = known.cost.min(edge.cost);
            return is_cheaper;
        }
        if here.iter().filter(alike).count() >= MOST_ALIKE {
            let dearest = here.iter().enumerate().filter(|(_, other)| alike(other));
            let dearest =
                dearest.max_by_key(|(_, other)| other.cost).map(|(n, other)| (n, other.cost));
            match dearest {
                Some((n, cost)) if cost > edge.cost => here[n] = edge,
                _ => return false,
            }
        } else {
            here.push(edge);
        }
        true
    }

    /// Edges of a category that begin at a word.
    pub(crate) fn at(&self, from: usize, category: Category) -> impl Iterator<Item = &Edge> {
        let here = self.edges.get(from).into_iter().flatten();
        here.filter(move |edge| edge.category == category)
    }

    /// The edges that a word is part of.
    pub(crate) fn over(&self, at: usize) -> impl Iterator<Item = &Edge> {
        self.edges[..=at].iter().flatten().filter(move |edge| edge.to > at)
    }

    /// Whether any edge is of a category.
    pub(crate) fn has(&self, category: Category) -> bool {
        self.edges.iter().flatten().any(|edge| edge.category == category)
    }

    /// The ends of the runs of words that stand at a place.
    pub(crate) fn ends_of<'s>(
        &'s self,
        runs: &'s [Vec<String>],
        from: usize,
    ) -> impl Iterator<Item = usize> + 's {
        let stands = move |run: &&Vec<String>| {
            let said = self.tokens.get(from..from + run.len());
            said.is_some_and(|said| said.iter().map(|t| &t.key).eq(run.iter()))
        };
        runs.iter().filter(stands).map(move |run| from + run.len())
    }
}

/// The ways in which a rule covers a stretch.
struct Search<'c, 't> {
    chart: &'c Chart<'t>,
    rule: &'c Phrase,
    from: usize,
    to: usize,
    roles: &'c Signatures,
    /// The edge of each part so far; none for words.
    chosen: Vec<Option<&'c Edge>>,
}

impl Search<'_, '_> {
    fn rest(&mut self, at: usize, found: &mut Vec<Edge>) {
        let Some(slot) = self.rule.parts.get(self.chosen.len()) else {
            if at == self.to {
                found.extend(self.made());
            }
            return;
        };
        let left = self.rule.parts.len() - self.chosen.len() - 1;
        if at + left >= self.to {
            return;
        }
        let most = self.to - left;
        let chart = self.chart;
        match slot {
            Slot::Words(runs) => {
                let ends: Vec<usize> = chart.ends_of(runs, at).filter(|end| *end <= most).collect();
                for end in ends {
                    self.chosen.push(None);
                    self.rest(end, found);
                    self.chosen.pop();
                }
            }
            Slot::Part { category, features, .. } => {
                for edge in chart.at(at, *category) {
                    // The last part ends where the phrase does.
                    let fits = edge.to <= most && (left > 0 || edge.to == self.to);
                    if fits && !(edge.features & *features).is_empty() {
                        self.chosen.push(Some(edge));
                        self.rest(edge.to, found);
                        self.chosen.pop();
                    }
                }
            }
        }
    }

    fn made(&self) -> Option<Edge> {
        let rule = self.rule;
        let own = |n: usize| {
            let edge = self.chosen[n]?;
            let Slot::Part { features, .. } = &rule.parts[n] else { return None };
            Some(edge.features & *features)
        };
        let agreed = rule.agree.iter().filter_map(|n| own(*n)).fold(Features::ALL, |a, b| a & b);
        if agreed.is_empty() {
            return None;
        }
        let is_agreed = |n: &usize| rule.agree.contains(n);
        let features = match rule.head {
            Some(head) if is_agreed(&head) => agreed,
            Some(head) => own(head).unwrap_or(Features::ALL),
            None => agreed,
        };
        let mut bound: Vec<Option<Bound>> = vec![None; rule.variables];
        let mut cost = rule.cost;
        for (n, slot) in rule.parts.iter().enumerate() {
            let (Slot::Part { variable, .. }, Some(edge)) = (slot, self.chosen[n]) else {
                continue;
            };
            cost += edge.cost;
            let features = if is_agreed(&n) { agreed } else { own(n).unwrap_or(Features::ALL) };
            if let Some(variable) = variable {
                bound[usize::from(*variable)] = Some(Bound { sense: edge.sense.clone(), features });
            }
        }
        let sense = rule.meaning.value(&bound, self.roles)?;
        let (from, to) = (self.from, self.to);
        Some(Edge { category: rule.category, from, to, features, cost, sense })
    }
}

impl Sense {
    /// Whether it asks something.
    pub(crate) fn form(self) -> Option<super::term::Form> {
        match self {
            Self::Form(form) => Some(*form),
            _ => None,
        }
    }
}
