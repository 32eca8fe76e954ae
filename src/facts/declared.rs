//! What the declarations say: types and the types they are part of, records and branches, relations.

use std::collections::{BTreeSet, HashMap, HashSet};

use super::fault::{Found, RuleError};
use super::record;
use super::relations::{Names, RelationId, RelationInfo};
use super::syntax::{Kind, Name, Span};
use super::word::{NO_WORD, Shape};
use crate::units::nearest_name;

/// Tuples are kept in rows of at most so many words.
pub(super) const MAX_COLUMNS: usize = 32;

/// A type: its kind and the types that it is part of.
#[derive(Debug, Clone)]
pub(super) struct Type {
    pub(super) name: String,
    pub(super) kind: Kind,
    /// The types declared to be part of it; what is part of these in turn is looked up.
    pub(super) below: Vec<usize>,
    /// Of a union: what its values may be.
    pub(super) parts: Vec<usize>,
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
    pub(super) type_names: HashMap<String, usize>,
    /// What records and branches hold, in the order of their kinds.
    pub(super) structures: Vec<Structure>,
    /// For each branch's name its structure.
    pub(super) branches: HashMap<String, u32>,
    /// Relations whose rules were put where they are read: they have no tuples of their own.
    pub(super) unfolded: BTreeSet<RelationId>,
}

/// A type of records or branches; fields by the positions of their types.
#[derive(Debug, Clone, Default)]
pub(super) struct Structure {
    pub(super) name: String,
    pub(super) branches: Vec<(String, Vec<usize>)>,
    pub(super) is_record: bool,
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
    pub(super) fn put_below(&mut self, one: usize, other: usize) {
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
    pub(super) fn type_of(&self, kind: Kind) -> usize {
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
    pub(super) fn shapes(&self) -> Vec<Shape> {
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

/// Whether a type is one of the program's, and none of the four that there are anyway.
pub(super) fn is_declared(id: usize) -> bool {
    id > 3
}

pub(super) fn primitive(kind: Kind) -> Option<usize> {
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
