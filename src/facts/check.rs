//! Items to a [`Program`]: names resolved, kinds inferred, groundedness and strata checked. Reports everything it finds.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::sync::Arc;

use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use super::clause;
use super::fault::RuleError;
use super::limits::Ceilings;
use super::program::{
    Clause, Column, Fact, Found, Kind, Literal, Names, Program, RelationId, RelationInfo, Stratum,
    Subsumption,
};
use super::record::{self, Shape};
use super::syntax::{Atom, Body, Expr, Item, Name, Role, Rule, Span};
use super::word::{NO_WORD, Words};
use super::{idle, subsume, unify, witness};
use crate::units::{Source, nearest_name};

/// Tuples are kept in rows of at most so many words.
pub(super) const MAX_COLUMNS: usize = 32;

/// A type: its kind and the types that it is part of.
#[derive(Debug, Clone)]
pub(super) struct Type {
    pub(super) name: String,
    pub(super) kind: Kind,
    /// The types declared to be part of it; what is part of these in turn is looked up.
    below: Vec<usize>,
    /// Of a union: what its values may be.
    parts: Vec<usize>,
}

/// What the declarations say.
#[derive(Debug, Clone, Default)]
pub(super) struct Declared {
    pub(super) relations: Vec<RelationInfo>,
    /// For each relation the types of its columns, by position in `types`.
    pub(super) columns: Vec<Vec<usize>>,
    pub(super) places: Vec<Span>,
    pub(super) names: Names,
    pub(super) types: Vec<Type>,
    type_names: HashMap<String, usize>,
    /// What records and branches hold, in the order of their kinds.
    structures: Vec<Structure>,
    /// For each branch's name its structure.
    branches: HashMap<String, u32>,
    /// Relations whose rules were put where they are read: they have no tuples of their own.
    pub(super) unfolded: BTreeSet<RelationId>,
}

/// A type of records or branches; fields by the positions of their types.
#[derive(Debug, Clone, Default)]
struct Structure {
    name: String,
    branches: Vec<(String, Vec<usize>)>,
    is_record: bool,
}

impl Declared {
    /// Whether every value of type `a` is a value of type `b`.
    pub(super) fn is_subtype(&self, a: usize, b: usize) -> bool {
        if a == b {
            return true;
        }
        // A union is part of what all its parts are part of.
        let part_of_b = self.below(b);
        let mut open = vec![a];
        let mut seen = HashSet::from([a]);
        while let Some(one) = open.pop() {
            let parts = &self.types[one].parts;
            if part_of_b.contains(&one) {
                continue;
            }
            if parts.is_empty() {
                return false;
            }
            open.extend(parts.iter().copied().filter(|part| seen.insert(*part)));
        }
        true
    }

    /// A type and all that were declared to be part of it, one by another.
    fn below(&self, of: usize) -> HashSet<usize> {
        let mut found = HashSet::from([of]);
        let mut open = vec![of];
        while let Some(one) = open.pop() {
            let below = self.types[one].below.iter().copied();
            open.extend(below.filter(|other| found.insert(*other)));
        }
        found
    }

    /// Declares that every value of one type is one of another.
    fn put_below(&mut self, one: usize, other: usize) {
        self.types[other].below.push(one);
    }

    /// The structure that has a branch of this name.
    pub(super) fn branch(&self, name: &str) -> Option<u32> {
        self.branches.get(name).copied()
    }

    /// The first word of the branch's records and the types of its fields; of a record's own where no branch is named,
    /// with [`NO_WORD`] for the word that records lack.
    pub(super) fn fields(&self, structure: u32, branch: Option<&Name>) -> Option<(u32, &[usize])> {
        let of = self.structures.get(structure as usize)?;
        match branch {
            None if of.is_record => Some((NO_WORD, &of.branches[0].1)),
            None => None,
            Some(name) => {
                let at = of.branches.iter().position(|(known, _)| *known == name.text)?;
                (!of.is_record).then(|| (record::tag(at), of.branches[at].1.as_slice()))
            }
        }
    }

    /// A type of a kind.
    fn type_of(&self, kind: Kind) -> usize {
        let of_kind = || self.types.iter().position(|of| of.kind == kind);
        primitive(kind).or_else(of_kind).unwrap_or(0)
    }

    /// A kind as messages name it.
    pub(super) fn kind_text(&self, kind: Kind) -> String {
        match kind {
            Kind::Record(of) => {
                self.structures.get(of as usize).map_or("[…]", |of| of.name.as_str()).to_owned()
            }
            plain => kind_name(plain).to_owned(),
        }
    }

    /// What the values of each structure hold.
    fn shapes(&self) -> Vec<Shape> {
        let kinds = |fields: &[usize]| fields.iter().map(|of| self.types[*of].kind).collect();
        let shape = |of: &Structure| Shape {
            branches: of.branches.iter().map(|(name, of)| (name.clone(), kinds(of))).collect(),
            is_record: of.is_record,
        };
        self.structures.iter().map(shape).collect()
    }

    /// The position of a type in `types`.
    pub(super) fn type_named(&self, name: &str) -> Option<usize> {
        self.type_names.get(name).copied()
    }

    pub(super) fn relation(&self, name: &Name, faults: &mut Found) -> Option<RelationId> {
        let found = self.names.find(&name.text);
        if found.is_none() {
            let nearest = nearest_name(&name.text, self.names.all()).map(str::to_owned);
            let (at, name) = (name.at, name.text.clone());
            faults.push(at, RuleError::UnknownRelation { name, nearest, at: at.into() });
        }
        found
    }
}

pub(super) fn program(sources: &[Source], items: &[Item], faults: &mut Found) -> Program {
    let mut declared = declare(items, faults);
    direct(items, &mut declared, faults);
    let mut words = Words::default();
    words.set_shapes(declared.shapes());
    let mut dominated: HashMap<RelationId, RelationId> = HashMap::new();
    let subsuming: Vec<Rule> = items
        .iter()
        .filter_map(|item| subsume::rule(item, &mut declared, &mut dominated, faults))
        .collect();
    let (mut clauses, mut facts) = (Vec::new(), Vec::new());
    let mut made = clause::Made::default();
    let closed: Vec<Rule> = items.iter().flat_map(|item| equivalence(item, faults)).collect();
    let rule = |item: &Item| if let Item::Rule(rule) = item { Some(rule.clone()) } else { None };
    let rules: Vec<Rule> = items.iter().filter_map(rule).chain(closed).chain(subsuming).collect();
    rules.iter().for_each(|rule| single_variables(rule, faults));
    let (rules, gone) = super::inline::unfold(rules, items, &declared, faults);
    let mut subsumptions = Vec::new();
    for rule in &rules {
        let rule = &witness::brought_out(&unify::unified(rule));
        for clause in clause::clauses(rule, &declared, &mut words, &mut made, faults) {
            if let Some(relation) = dominated.get(&clause.head) {
                subsumptions.push(Subsumption { relation: *relation, clause });
                continue;
            }
            match constant_words(&clause) {
                Some(words) => facts.push(Fact { relation: clause.head, words, at: clause.at }),
                None => clauses.push(clause),
            }
        }
    }
    for (info, at) in made.relations {
        declared
            .columns
            .push(info.columns.iter().map(|column| declared.type_of(column.kind)).collect());
        declared.relations.push(info);
        declared.places.push(at);
    }
    clauses.extend(made.clauses);
    let clauses: Vec<Arc<Clause>> = clauses.into_iter().map(Arc::new).collect();
    let strata = strata(&declared, &clauses, &subsumptions, faults);
    let hidden = gone.iter().copied().chain(dominated.into_keys()).collect();
    unused(&declared, &clauses, &subsumptions, &facts, &hidden, faults);
    hints(items, faults);
    idle::warn(&declared, &clauses, &facts, faults);
    declared.unfolded = gone;
    Program {
        sources: sources.into(),
        relations: Arc::new(declared.relations.iter().cloned().map(Arc::new).collect()),
        names: Arc::new(declared.names.clone()),
        declared: Arc::new(declared),
        clauses: clauses.into(),
        facts: facts.into(),
        strata: strata.into(),
        subsumptions: subsumptions.into(),
        limits: limits(items, faults),
        words,
        warnings: [].into(),
    }
}

/// The rules that close a relation declared `eqrel` under equivalence.
pub(super) fn equivalence(item: &Item, faults: &mut Found) -> Vec<Rule> {
    let Item::Relation { names, columns, roles, .. } = item else { return Vec::new() };
    if !roles.contains(&Role::Equivalence) {
        return Vec::new();
    }
    let mut rules = Vec::new();
    for name in names {
        let at = name.at;
        if columns.len() != 2 {
            let (expected, found) = (2, columns.len());
            let fault =
                RuleError::Arity { name: name.text.clone(), expected, found, at: at.into() };
            faults.push(at, fault);
            continue;
        }
        let variable = |text: &str| Expr::Variable(Name { text: text.into(), at });
        let pair = |x: &str, y: &str| Atom {
            relation: name.clone(),
            args: vec![variable(x), variable(y)],
            at,
        };
        let all = |atoms: Vec<Atom>| Body::All(atoms.into_iter().map(Body::Atom).collect());
        let rule = |head: Atom, body| Rule { heads: vec![head], body, at };
        rules.push(rule(pair("x", "y"), all(vec![pair("y", "x")])));
        rules.push(rule(pair("x", "z"), all(vec![pair("x", "y"), pair("y", "z")])));
    }
    rules
}

/// A fact's words; none for a proper rule.
fn constant_words(clause: &Clause) -> Option<Box<[u32]>> {
    use super::program::Expr;
    let constants = clause.args.iter().map(|arg| match arg {
        Expr::Constant(word) => Some(*word),
        _ => None,
    });
    clause.body.is_empty().then(|| constants.collect()).flatten()
}

fn declare(items: &[Item], faults: &mut Found) -> Declared {
    let mut declared = Declared::default();
    for kind in [Kind::Symbol, Kind::Number, Kind::Unsigned, Kind::Float] {
        let name = kind_name(kind);
        declared.type_names.insert(name.into(), declared.types.len());
        declared.types.push(Type { name: name.into(), kind, below: vec![], parts: vec![] });
    }
    declare_structures(items, &mut declared, faults);
    declare_more(items, &mut declared, faults);
    declare_fields(items, &mut declared, faults);
    declared
}

/// Adds types and relations to those that are declared already.
pub(super) fn declare_more(items: &[Item], declared: &mut Declared, faults: &mut Found) {
    declare_types(items, declared, faults);
    for item in items {
        if let Item::Relation { names, columns, second, roles, domains } = item {
            for name in names {
                declare_relation(name, columns, second.as_ref(), roles, declared, faults);
                choose(name, domains, declared, faults);
            }
        }
    }
}

/// The names of records and of branched types, so that their fields may be of them.
fn declare_structures(items: &[Item], declared: &mut Declared, faults: &mut Found) {
    for item in items {
        let Item::Structure { name, is_record, .. } = item else { continue };
        if declared.type_names.contains_key(&name.text) {
            let fault = RuleError::Duplicate { name: name.text.clone(), at: name.at.into() };
            faults.push(name.at, fault);
            continue;
        }
        let kind = Kind::Record(declared.structures.len() as u32);
        declared.type_names.insert(name.text.clone(), declared.types.len());
        let name = name.text.clone();
        declared.types.push(Type { name: name.clone(), kind, below: vec![], parts: vec![] });
        declared.structures.push(Structure { name, branches: Vec::new(), is_record: *is_record });
    }
}

/// The fields of records and branches, once all types are known.
fn declare_fields(items: &[Item], declared: &mut Declared, faults: &mut Found) {
    for item in items {
        let Item::Structure { name, branches, is_record } = item else { continue };
        let Some(Kind::Record(of)) =
            declared.type_named(&name.text).map(|id| declared.types[id].kind)
        else {
            continue;
        };
        if !declared.structures[of as usize].branches.is_empty() {
            continue;
        }
        for branch in branches {
            let types = branch.fields.iter();
            let types: Vec<usize> =
                types.map(|(_, field)| type_named(field, declared, faults).unwrap_or(0)).collect();
            if types.len() >= MAX_COLUMNS {
                let (what, limit, at) = ("полей записи", MAX_COLUMNS, branch.name.at);
                faults.push(at, RuleError::TooLarge { what, limit, at: at.into() });
            }
            let is_new =
                *is_record || declared.branches.insert(branch.name.text.clone(), of).is_none();
            if !is_new {
                let (name, at) = (branch.name.text.clone(), branch.name.at);
                faults.push(at, RuleError::Duplicate { name, at: at.into() });
            }
            declared.structures[of as usize].branches.push((branch.name.text.clone(), types));
        }
    }
}

/// The columns of a relation's choice domains.
fn choose(name: &Name, domains: &[Vec<Name>], declared: &mut Declared, faults: &mut Found) {
    let Some(id) = declared.names.find(&name.text) else { return };
    let info = &mut declared.relations[id.index()];
    for domain in domains {
        let mut columns = Vec::with_capacity(domain.len());
        for column in domain {
            match info.columns.iter().position(|known| known.name == column.text) {
                Some(at) => columns.push(at),
                None => {
                    let what = format!("choice-domain «{}» без такого столбца", column.text);
                    let help = "назовите столбцы этого отношения";
                    let at = column.at;
                    faults.push(at, RuleError::Unsupported { what, help, at: at.into() });
                }
            }
        }
        if columns.len() == domain.len() {
            info.choices.push(columns);
        }
    }
}

/// The pragmas that say how much an evaluation may take.
fn limits(items: &[Item], faults: &mut Found) -> Ceilings {
    let mut limits = Ceilings::default();
    for item in items {
        let Item::Pragma { name, value, at } = item else { continue };
        limits.on_demand |= name == "magic-transform";
        let Ok(number) = value.trim().parse::<u64>() else {
            if is_limit(name) {
                let (expected, found) = ("целое число в кавычках".to_owned(), format!("«{value}»"));
                faults.push(*at, RuleError::Syntax { expected, found, at: (*at).into() });
            }
            continue;
        };
        match name.as_str() {
            "time-limit" => limits.seconds = Some(number),
            "memory-limit" => limits.megabytes = Some(number),
            "row-limit" => limits.rows = Some(number),
            _ => {}
        }
    }
    limits
}

fn is_limit(name: &str) -> bool {
    matches!(name, "time-limit" | "memory-limit" | "row-limit")
}

/// Says what is read and has no effect.
fn hints(items: &[Item], faults: &mut Found) {
    for item in items {
        let (what, at) = match item {
            Item::Hint { what, at } => (what.clone(), *at),
            Item::Pragma { name, at, .. }
                if !is_limit(name) && !matches!(name.as_str(), "magic-transform" | "once") =>
            {
                (format!(".pragma «{name}»"), *at)
            }
            _ => continue,
        };
        faults.push(at, RuleError::Hint { what, at: at.into() });
    }
}

/// A type may be named before it is declared: it waits until all its bases are. What is left when nothing more fits
/// names what nobody declares.
fn declare_types(items: &[Item], declared: &mut Declared, faults: &mut Found) {
    let types: Vec<(&Name, &[Name], bool)> = items
        .iter()
        .filter_map(|item| match item {
            Item::Type { name, bases, is_union } => Some((name, bases.as_slice(), *is_union)),
            _ => None,
        })
        .collect();
    let mut waiting: HashMap<&str, Vec<usize>> = HashMap::new();
    let mut missing = vec![0_usize; types.len()];
    for (number, (_, bases, _)) in types.iter().enumerate() {
        for base in *bases {
            if !declared.type_names.contains_key(&base.text) {
                waiting.entry(&base.text).or_default().push(number);
                missing[number] += 1;
            }
        }
    }
    let mut left: BTreeSet<usize> = (0..types.len()).collect();
    let mut ready: BTreeSet<usize> =
        (0..types.len()).filter(|number| missing[*number] == 0).collect();
    while let Some(next) = ready.pop_first().or_else(|| left.first().copied()) {
        left.remove(&next);
        ready.remove(&next);
        let (name, bases, is_union) = types[next];
        declare_type(name, bases, is_union, declared, faults);
        if declared.type_names.contains_key(&name.text) {
            for number in waiting.remove(name.text.as_str()).into_iter().flatten() {
                missing[number] -= 1;
                if missing[number] == 0 && left.contains(&number) {
                    ready.insert(number);
                }
            }
        }
    }
}

/// `<:` puts the new type below its base; `=` with several bases puts it above all of them.
fn declare_type(
    name: &Name,
    bases: &[Name],
    is_union: bool,
    declared: &mut Declared,
    faults: &mut Found,
) {
    let known: Vec<usize> =
        bases.iter().filter_map(|base| type_named(base, declared, faults)).collect();
    let Some(first) = known.first().copied() else { return };
    let id = declared.types.len();
    if declared.type_names.contains_key(&name.text) {
        let fault = RuleError::Duplicate { name: name.text.clone(), at: name.at.into() };
        faults.push(name.at, fault);
        return;
    }
    let kind = declared.types[first].kind;
    let parts = if is_union { known.clone() } else { Vec::new() };
    declared.type_names.insert(name.text.clone(), id);
    declared.types.push(Type { name: name.text.clone(), kind, below: Vec::new(), parts });
    // The primitive type is above a union as it is above the union's parts.
    declared.put_below(id, if bases.len() == 1 { first } else { primitive(kind).unwrap_or(first) });
    if is_union {
        for (part, base) in known.iter().zip(bases) {
            if declared.types[*part].kind != kind {
                let expected = declared.kind_text(kind);
                let found = declared.kind_text(declared.types[*part].kind);
                let fault = RuleError::Types {
                    what: base.text.clone(),
                    expected,
                    found,
                    at: base.at.into(),
                };
                faults.push(base.at, fault);
            }
        }
        for part in known {
            if declared.types[part].kind == kind {
                declared.put_below(part, id);
            }
        }
    }
}

fn primitive(kind: Kind) -> Option<usize> {
    match kind {
        Kind::Symbol => Some(0),
        Kind::Number => Some(1),
        Kind::Unsigned => Some(2),
        Kind::Float => Some(3),
        Kind::Record(_) => None,
    }
}

pub(super) fn kind_name(kind: Kind) -> &'static str {
    match kind {
        Kind::Symbol => "symbol",
        Kind::Number => "number",
        Kind::Unsigned => "unsigned",
        Kind::Float => "float",
        Kind::Record(_) => "record",
    }
}

fn type_named(name: &Name, declared: &Declared, faults: &mut Found) -> Option<usize> {
    let found = declared.type_names.get(&name.text).copied();
    if found.is_none() {
        let nearest =
            nearest_name(&name.text, declared.types.iter().map(|known| known.name.as_str()));
        let nearest = nearest.map(str::to_owned);
        let fault = RuleError::UnknownType { name: name.text.clone(), nearest, at: name.at.into() };
        faults.push(name.at, fault);
    }
    found
}

fn declare_relation(
    name: &Name,
    columns: &[(Name, Name)],
    second: Option<&Name>,
    roles: &[Role],
    declared: &mut Declared,
    faults: &mut Found,
) {
    if columns.len() > MAX_COLUMNS {
        let (what, limit) = ("столбцов отношения", MAX_COLUMNS);
        faults.push(name.at, RuleError::TooLarge { what, limit, at: name.at.into() });
        return;
    }
    let id = RelationId(declared.relations.len() as u32);
    for name in std::iter::once(name).chain(second) {
        if !declared.names.insert(&name.text, id) {
            let fault = RuleError::Duplicate { name: name.text.clone(), at: name.at.into() };
            faults.push(name.at, fault);
        }
    }
    // A column of unknown type is taken for a symbol, so that the relation's other uses are still checked.
    let types: Vec<usize> =
        columns.iter().map(|(_, of)| type_named(of, declared, faults).unwrap_or(0)).collect();
    let column = |((name, _), id): (&(Name, Name), &usize)| {
        let Type { name: type_name, kind, .. } = &declared.types[*id];
        Column { name: name.text.clone(), kind: *kind, type_name: type_name.clone() }
    };
    let mut info = RelationInfo {
        name: name.text.clone(),
        second_name: second.map(|name| name.text.clone()),
        columns: columns.iter().zip(&types).map(column).collect(),
        ..RelationInfo::default()
    };
    roles.iter().for_each(|role| give_role(*role, &[], &mut info));
    declared.relations.push(info);
    declared.columns.push(types);
    declared.places.push(name.at);
}

fn direct(items: &[Item], declared: &mut Declared, faults: &mut Found) {
    for item in items {
        if let Item::Directive { role, relations, parameters } = item {
            for name in relations {
                if let Some(id) = declared.relation(name, faults) {
                    give_role(*role, parameters, &mut declared.relations[id.index()]);
                }
            }
        }
    }
}

fn give_role(role: Role, parameters: &[(String, String)], info: &mut RelationInfo) {
    match role {
        Role::Input => info.input = Some(parameters.to_vec()),
        Role::Output => {
            if !info.outputs.iter().any(|known| known == parameters) {
                info.outputs.push(parameters.to_vec());
            }
        }
        Role::PrintSize => info.print_size = true,
        // Becomes rules, see `equivalence`.
        Role::Equivalence => {}
        // Is unfolded where it must be, see `inline`.
        Role::Inline => {}
        // Was seen to when the component was made.
        Role::Overridable => {}
        Role::LimitSize => {
            let limit = parameters.iter().find(|(name, _)| name == "n");
            info.limit_size = limit.and_then(|(_, n)| n.parse().ok()).or(info.limit_size);
        }
    }
}

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
    let groups = kosaraju_scc(&graph);
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
        relations.sort();
        strata.push(Stratum { relations, clauses: Vec::new(), subsumptions: Vec::new() });
    }
    for (n, clause) in clauses.iter().enumerate() {
        strata[group_of[clause.head.index()]].clauses.push(n);
        let mut is_recursive = false;
        reads(&clause.body, false, &mut |relation, _, _| {
            is_recursive |= group_of[relation.index()] == group_of[clause.head.index()];
        });
        if is_recursive && clause.counts_on() {
            let what = "autoinc() в рекурсивном правиле".to_owned();
            let help = "пронумеруйте готовое отношение отдельным правилом";
            let at = clause.at;
            faults.push(at, RuleError::Unsupported { what, help, at: at.into() });
        }
    }
    for (n, of) in subsumptions.iter().enumerate() {
        strata[group_of[of.relation.index()]].subsumptions.push(n);
    }
    strata
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
) -> String {
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
    let mut text = declared.relations[head].name.clone();
    let mut from = head;
    for &to in way.iter().rev() {
        let not = if edges.get(&(from, to)).is_some_and(Option::is_some) { "не " } else { "" };
        text += &format!(" → {not}{}", declared.relations[to].name);
        from = to;
    }
    text
}

fn unused(
    declared: &Declared,
    clauses: &[Arc<Clause>],
    subsumptions: &[Subsumption],
    facts: &[Fact],
    unfolded: &BTreeSet<RelationId>,
    faults: &mut Found,
) {
    let mut read = vec![false; declared.relations.len()];
    let mut filled = vec![false; declared.relations.len()];
    for clause in clauses {
        filled[clause.head.index()] = true;
        reads(&clause.body, false, &mut |relation, _, _| read[relation.index()] = true);
    }
    for of in subsumptions {
        reads(&of.clause.body, false, &mut |relation, _, _| {
            read[relation.index()] |= relation != of.relation;
        });
    }
    facts.iter().for_each(|fact| filled[fact.relation.index()] = true);
    for (n, info) in declared.relations.iter().enumerate() {
        let (name, at) = (info.name.clone(), declared.places[n]);
        if unfolded.contains(&RelationId(n as u32)) {
            continue;
        }
        let is_seen = !info.outputs.is_empty() || info.print_size;
        if read[n] && !filled[n] && info.input.is_none() {
            faults.push(at, RuleError::NeverDerived { name, at: at.into() });
        } else if !read[n] && !is_seen {
            faults.push(at, RuleError::NeverUsed { name, at: at.into() });
        }
    }
}

fn single_variables(rule: &Rule, faults: &mut Found) {
    let mut seen: BTreeMap<&str, (Span, usize)> = BTreeMap::new();
    for head in &rule.heads {
        head.args.iter().for_each(|arg| count_in_expr(arg, &mut seen));
    }
    count_in_body(&rule.body, &mut seen);
    for (name, (at, count)) in seen {
        // A variable of a bodiless rule is reported as ungrounded.
        if count == 1 && !name.starts_with('_') && rule.body != Body::All(Vec::new()) {
            faults.push(at, RuleError::SingleVariable { variable: name.into(), at: at.into() });
        }
    }
}

fn count_in_body<'a>(body: &'a Body, seen: &mut BTreeMap<&'a str, (Span, usize)>) {
    match body {
        Body::All(parts) | Body::Any(parts) => {
            parts.iter().for_each(|part| count_in_body(part, seen))
        }
        Body::Not(part) => count_in_body(part, seen),
        Body::Atom(atom) => atom.args.iter().for_each(|arg| count_in_expr(arg, seen)),
        Body::Compare { left, right, .. } => {
            count_in_expr(left, seen);
            count_in_expr(right, seen);
        }
    }
}

fn count_in_expr<'a>(expr: &'a Expr, seen: &mut BTreeMap<&'a str, (Span, usize)>) {
    match expr {
        Expr::Variable(name) => seen.entry(&name.text).or_insert((name.at, 0)).1 += 1,
        Expr::Call { args, .. } | Expr::Record { args, .. } => {
            args.iter().for_each(|arg| count_in_expr(arg, seen));
        }
        Expr::Aggregate { value, body, .. } => {
            value.iter().for_each(|value| count_in_expr(value, seen));
            count_in_body(body, seen);
        }
        Expr::As { value, .. } => count_in_expr(value, seen),
        Expr::Any(_)
        | Expr::Nil(_)
        | Expr::Number(..)
        | Expr::Unsigned(..)
        | Expr::Decimal(..)
        | Expr::Text(..) => {}
    }
}
