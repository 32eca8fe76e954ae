//! The order of evaluation: relations that depend on each other in groups, each group after those it reads.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use super::declared::Declared;
use super::fault::{Found, RuleError};
use super::program::{Clause, Literal, Stratum, Subsumption};
use super::relations::RelationId;
use super::syntax::Span;
use crate::units::{Bilingual, InOrder as _, said, word};

/// Relations in groups that depend on each other, each group after those it reads.
pub(super) fn strata(
    declared: &Declared,
    clauses: &[Arc<Clause>],
    subsumptions: &[Subsumption],
    faults: &mut Found,
) -> Vec<Stratum> {
    let mut graph: DiGraph<(), ()> = DiGraph::new();
    let nodes: Vec<NodeIndex> = declared.relations.iter().map(|_| graph.add_node(())).collect();
    let mut edges: BTreeMap<(usize, usize), Option<Span>> = BTreeMap::new();
    let subsuming = subsumptions.iter().map(|of| (of.relation, &of.clause.body));
    for (head, body) in clauses.iter().map(|clause| (clause.head, &clause.body)).chain(subsuming) {
        reads(body, false, &mut |relation, not, at| {
            let edge = edges.entry((head.index(), relation.index())).or_insert(None);
            *edge = edge.or(not.then_some(at));
        });
    }
    for &(head, read) in edges.keys() {
        graph.add_edge(nodes[head], nodes[read], ());
    }
    let groups = by_level(kosaraju_scc(&graph), &graph);
    let mut group_of = vec![0; nodes.len()];
    for (group, members) in groups.iter().enumerate() {
        members.iter().for_each(|node| group_of[node.index()] = group);
    }
    for (&(head, read), not) in &edges {
        if let Some(at) = not.filter(|_| group_of[head] == group_of[read]) {
            let cycle = cycle_text(head, read, &edges, declared);
            faults.push(at, RuleError::Cycle { cycle, at: at.into() });
        }
    }
    let mut strata: Vec<Stratum> = Vec::with_capacity(groups.len());
    for members in groups {
        let mut relations: Vec<_> =
            members.iter().map(|node| RelationId(node.index() as u32)).collect();
        relations.order();
        strata.push(Stratum { relations, clauses: Vec::new(), subsumptions: Vec::new() });
    }
    for (n, clause) in clauses.iter().enumerate() {
        strata[group_of[clause.head.index()]].clauses.push(n);
        let mut is_recursive = false;
        reads(&clause.body, false, &mut |relation, _, _| {
            is_recursive |= group_of[relation.index()] == group_of[clause.head.index()];
        });
        if is_recursive && clause.counts_on() {
            let what = said!("autoinc-in-a-recursive-rule");
            let help = word!("number-the-finished-relation-in-a-rule");
            let at = clause.at;
            faults.push(at, RuleError::Unsupported { what, help, at: at.into() });
        }
    }
    for (n, of) in subsumptions.iter().enumerate() {
        strata[group_of[of.relation.index()]].subsumptions.push(n);
    }
    strata
}

/// Groups, each behind those it reads, so that those which could come at the same time stand together.
fn by_level(groups: Vec<Vec<NodeIndex>>, graph: &DiGraph<(), ()>) -> Vec<Vec<NodeIndex>> {
    // None for those of the group itself, since groups come after those they read.
    let mut level_of: Vec<Option<usize>> = vec![None; graph.node_count()];
    let mut levels: Vec<(usize, Vec<NodeIndex>)> = Vec::with_capacity(groups.len());
    for members in groups {
        let read = members.iter().flat_map(|node| graph.neighbors(*node));
        let level = read.filter_map(|node| level_of[node.index()]).max().map_or(0, |read| read + 1);
        members.iter().for_each(|node| level_of[node.index()] = Some(level));
        levels.push((level, members));
    }
    levels.order_by_key(|(level, _)| *level);
    levels.into_iter().map(|(_, members)| members).collect()
}

/// Every relation that a body reads, whether under a negation or aggregate, and where.
pub(super) fn reads(body: &[Literal], not: bool, f: &mut impl FnMut(RelationId, bool, Span)) {
    for literal in body {
        match literal {
            Literal::Atom(atom) => f(atom.relation, not, atom.at),
            Literal::Not(atom) => f(atom.relation, true, atom.at),
            Literal::Compare(_) | Literal::Range(_) => {}
            Literal::Aggregate(aggregate) => reads(&aggregate.body, true, f),
        }
    }
}

/// `a → не b → c → a`: the shortest way back from `read` to `head`.
fn cycle_text(
    head: usize,
    read: usize,
    edges: &BTreeMap<(usize, usize), Option<Span>>,
    declared: &Declared,
) -> Bilingual {
    let mut came_from = HashMap::from([(read, read)]);
    let mut queue = std::collections::VecDeque::from([read]);
    while let Some(at) = queue.pop_front() {
        for (&(_, next), _) in edges.range((at, 0)..=(at, usize::MAX)) {
            came_from.entry(next).or_insert_with(|| {
                queue.push_back(next);
                at
            });
        }
    }
    let mut way = vec![head];
    while *way.last().expect("the way starts with its end") != read {
        way.push(came_from[way.last().expect("the way starts with its end")]);
    }
    Bilingual::both(|language| {
        let mut text = declared.relations[head].name.clone();
        let mut from = head;
        for &to in way.iter().rev() {
            let is_negated = edges.get(&(from, to)).is_some_and(Option::is_some);
            let not = if is_negated { word!("not").say(language) } else { "".into() };
            text += &format!(" → {not}{}", declared.relations[to].name);
            from = to;
        }
        text
    })
}
