//! What there is: types, objects, functions and predicates, declared or inferred.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use super::check::{Checker, places};
use super::domain::{ANY_KIND, Domain, Kind, KindId, KindSet, Predicate, PredicateId};
use super::error::RuleError;
use super::fault::RuleFault;
use super::hint::hint;
use super::syntax::{Atom, Declaration, Document, Name, Parameter};
use crate::units::{name_key, said, word};

impl Checker<'_> {
    /// The type tree. Types named only as parents or in parameters count as declared where nothing else is.
    pub(super) fn kinds(document: &Document, faults: &mut Vec<RuleFault>) -> Domain {
        let mut domain = Domain {
            kinds: vec![Kind { name: "объект".to_owned(), parents: Vec::new() }],
            kind_index: HashMap::from([
                ("объект".to_owned(), ANY_KIND),
                ("object".to_owned(), ANY_KIND),
            ]),
            predicates: Vec::new(),
            predicate_index: HashMap::new(),
            schemas: Vec::new(),
            derived: Vec::new(),
            cost_unit: document.cost_unit(),
            phrases: Arc::default(),
            second: Arc::default(),
            introduced: HashMap::new(),
        };
        fn introduce(domain: &mut Domain, name: &Name) -> KindId {
            let next = KindId(domain.kinds.len() as u32);
            let id = *domain.kind_index.entry(name.key()).or_insert(next);
            if id == next {
                domain.kinds.push(Kind { name: name.first().to_owned(), parents: Vec::new() });
            }
            id
        }
        let mut parents: BTreeMap<KindId, Vec<(KindId, Name)>> = BTreeMap::new();
        for Declaration { name, kinds } in document.types.iter().flatten() {
            let id = introduce(&mut domain, name);
            for parent in kinds {
                let parent_id = introduce(&mut domain, parent);
                parents.entry(id).or_default().push((parent_id, parent.clone()));
            }
        }
        if document.types.is_none() {
            let derived = document.derived.iter().flat_map(|rule| &rule.parameters);
            let parameters = document.actions.iter().flat_map(|a| &a.parameters).chain(derived);
            let in_actions = parameters.flat_map(|p| &p.kinds);
            let in_signatures = document.predicates.iter().flat_map(|s| s.args.iter().flatten());
            let in_objects = document.objects.iter().flat_map(|o| &o.kinds);
            for name in in_actions.chain(in_signatures).chain(in_objects) {
                introduce(&mut domain, name);
            }
            let mut of_bound = |_: &Atom, bound: &[&Parameter]| {
                bound.iter().flat_map(|parameter| &parameter.kinds).for_each(|name| {
                    introduce(&mut domain, name);
                });
            };
            document.each_atom_of_rules(&mut of_bound);
            for condition in document.wanted() {
                condition.for_each_atom(&mut Vec::new(), &mut |atom, bound| of_bound(atom, bound));
            }
        }
        let node = |kind: KindId| NodeIndex::new(kind.index());
        let edges =
            parents.iter().flat_map(|(kind, above)| above.iter().map(move |(p, _)| (*kind, *p)));
        let mut graph: DiGraph<(), ()> =
            DiGraph::from_edges(edges.map(|(kind, parent)| (node(kind), node(parent))));
        while graph.node_count() < domain.kinds.len() {
            graph.add_node(());
        }
        let mut group = vec![0; domain.kinds.len()];
        for (n, members) in kosaraju_scc(&graph).into_iter().enumerate() {
            members.into_iter().for_each(|member| group[member.index()] = n);
        }
        for (kind, above) in parents {
            for (parent, name) in &above {
                // "object" above itself says nothing new.
                if group[kind.index()] == group[parent.index()] && *parent != ANY_KIND {
                    let kind = domain.kinds[parent.index()].name.clone();
                    faults.push(name.fault(|at| RuleError::TypeCycle { name: kind, at }));
                }
            }
            let mut above: Vec<KindId> = above.into_iter().map(|(parent, _)| parent).collect();
            above.retain(|parent| *parent != kind);
            domain.kinds[kind.index()].parents = above;
        }
        domain
    }

    fn add_predicate(&mut self, name: &str, args: Vec<KindSet>) -> PredicateId {
        let id = PredicateId(self.domain.predicates.len() as u32);
        self.domain.predicates.push(Predicate { name: name.to_owned(), args });
        self.domain.predicate_index.insert(name_key(name), id);
        id
    }

    /// Two declarations of one object must agree, or one type inherit from the other; a constant of the domain may be
    /// named in the problem again.
    pub(super) fn declare_objects(&mut self, document: &Document) {
        let mut declared: BTreeMap<String, (String, KindSet)> = BTreeMap::new();
        let mut first: HashMap<String, (&Name, KindSet)> = HashMap::new();
        for Declaration { name, kinds } in &document.objects {
            let mut kinds: KindSet =
                kinds.iter().filter_map(|kind| self.domain.kind(kind.first())).collect();
            let is_untyped = kinds.is_empty();
            if is_untyped {
                kinds.push(ANY_KIND);
            }
            declared.entry(name.key()).or_insert_with(|| (name.text.clone(), kinds.clone()));
            let (known, theirs) = first.entry(name.key()).or_insert((name, kinds.clone()));
            let agree = self.domain.fits(&kinds, theirs) || self.domain.fits(theirs, &kinds);
            if !agree {
                let found = self.domain.kind_names(&kinds);
                let earlier = self.domain.kind_names(theirs);
                let (first, elsewhere) = places(&known.at, name);
                self.faults.push(name.fault(|at| RuleError::ObjectTwice {
                    name: name.text.clone(),
                    found,
                    earlier,
                    help: said!("keep-one", elsewhere),
                    at,
                    first,
                }));
            }
        }
        self.constants = document.objects_closed.then_some(declared);
    }

    /// What no problem needs to declare is the sum itself.
    pub(super) fn declare_functions(&mut self, document: &Document) {
        self.functions.insert("total-cost".to_owned(), 0);
        for signature in &document.functions {
            self.functions.insert(signature.name.key(), signature.args.len());
        }
        for (atom, _) in &document.values {
            self.function(atom);
        }
    }

    pub(super) fn function(&mut self, atom: &Atom) {
        let name = &atom.predicate;
        match self.functions.get(&name.key()) {
            Some(&expected) if expected == atom.args.len() => {}
            Some(&expected) => self.faults.push(name.fault(|at| RuleError::Arity {
                name: name.text.clone(),
                expected,
                found: atom.args.len(),
                help: said!("in-functions-has-so-many", text = name.text, expected),
                at,
            })),
            None => {
                let help = hint(&name.text, self.functions.keys().map(String::as_str))
                    .or_else(|| Some(said!("declare-it-in-functions")));
                self.faults.push(name.fault(|at| RuleError::UnknownFunction {
                    name: name.text.clone(),
                    help,
                    at,
                }));
            }
        }
    }

    pub(super) fn declare_predicates(&mut self, document: &Document) {
        for signature in &document.predicates {
            if let Some(known) = self.domain.predicate(signature.name.first()) {
                let first = self.domain.introduced.get(&known).cloned();
                self.duplicate(word!("the-predicate"), &signature.name, first);
                continue;
            }
            let args = signature.args.iter().map(|kinds| self.kind_set(kinds)).collect();
            let id = self.add_predicate(signature.name.first(), args);
            self.domain.introduced.insert(id, signature.name.at.clone());
        }
    }

    /// Signatures of undeclared predicates: in each place the nearest type that all uses inherit from.
    pub(super) fn infer_predicates(&mut self, document: &Document) {
        let declared = self.domain.predicates.len();
        let arities = arities(document);
        document.each_atom_of_rules(&mut |atom, bound| {
            if arities.get(&atom.predicate.key()) != Some(&atom.args.len()) {
                return;
            }
            let args: Vec<Option<KindSet>> = atom
                .args
                .iter()
                .map(|term| {
                    let by_name = |p: &&&Parameter| p.variable.key() == term.name.key();
                    let names = match bound.iter().rev().find(by_name) {
                        Some(parameter) if term.is_variable => parameter.kinds.as_slice(),
                        _ => term.kind.as_slice(),
                    };
                    let kinds: KindSet =
                        names.iter().filter_map(|name| self.domain.kind(name.first())).collect();
                    (!kinds.is_empty()).then_some(kinds)
                })
                .collect();
            self.infer_from(atom, &args, declared);
        });
    }

    fn infer_from(&mut self, atom: &Atom, args: &[Option<KindSet>], declared: usize) {
        let Some(id) = self.domain.predicate(atom.predicate.first()) else {
            let args = args.iter().map(|kinds| kinds.clone().unwrap_or_default()).collect();
            let id = self.add_predicate(atom.predicate.first(), args);
            self.domain.introduced.insert(id, atom.predicate.at.clone());
            return;
        };
        // A declaration stands as it is; its uses are compared with it later.
        if id.index() < declared || self.domain.predicates[id.index()].args.len() != args.len() {
            return;
        }
        for (place, kinds) in args.iter().enumerate() {
            let Some(kinds) = kinds else { continue };
            let known = &self.domain.predicates[id.index()].args[place];
            let joined = if known.is_empty() {
                Some(kinds.clone())
            } else if kinds.iter().all(|&kind| self.domain.fits(&[kind], known)) {
                None
            } else {
                self.common_ancestor(known, kinds).map(|kind| vec![kind])
            };
            if let Some(joined) = joined {
                self.domain.predicates[id.index()].args[place] = joined;
            }
        }
    }

    /// The first ancestor of `a` that everything in both inherits from; "any object" is none.
    fn common_ancestor(&self, a: &[KindId], b: &[KindId]) -> Option<KindId> {
        self.domain.lineage(a[0]).find(|&ancestor| {
            ancestor != ANY_KIND
                && a.iter().chain(b).all(|&kind| self.domain.inherits(kind, ancestor))
        })
    }
}

/// How many arguments each predicate has by most of its uses; by the first of them where no number leads.
fn arities(document: &Document) -> HashMap<String, usize> {
    let mut counts: HashMap<String, Vec<(usize, usize)>> = HashMap::new();
    let mut count = |atom: &Atom| {
        let of_predicate = counts.entry(atom.predicate.key()).or_default();
        match of_predicate.iter_mut().find(|(arity, _)| *arity == atom.args.len()) {
            Some((_, count)) => *count += 1,
            None => of_predicate.push((atom.args.len(), 1)),
        }
    };
    document.each_atom_of_rules(&mut |atom, _| count(atom));
    for condition in document.facts.iter().chain(&document.assumptions).chain(document.wanted()) {
        condition.for_each_atom(&mut Vec::new(), &mut |atom, _| count(atom));
    }
    let most = |counts: Vec<(usize, usize)>| {
        let most = counts.iter().map(|&(_, count)| count).max()?;
        counts.into_iter().find(|&(_, count)| count == most).map(|(arity, _)| arity)
    };
    counts.into_iter().filter_map(|(key, counts)| Some((key, most(counts)?))).collect()
}
