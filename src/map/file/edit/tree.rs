//! The tree of a map file as a thing to be edited: records found by name, lines added, changed, struck out.
//!
//! What is struck out stays in its place as an empty value until [`Tree::finish`], so that places stay valid.

use std::collections::HashMap;

use super::super::decode::likely;
use super::super::node::{Entry, Node, Span, Value};
use crate::units::name_key;

/// What a name may stand for. The order is that in which a name is understood that several kinds bear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Kind {
    Replica,
    Area,
    Door,
    Place,
    Map,
    Zone,
    Object,
    Orthoframe,
}

/// The words by which an edit tells kinds of things apart that bear one name.
#[must_use]
pub fn kinds() -> [&'static str; 8] {
    Kind::ALL.map(Kind::word)
}

impl Kind {
    pub(super) const ALL: [Self; 8] = [
        Self::Replica,
        Self::Area,
        Self::Door,
        Self::Place,
        Self::Map,
        Self::Zone,
        Self::Object,
        Self::Orthoframe,
    ];

    /// How an edit file names the kind, and the section of a map file where its records stand.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Replica => "replica",
            Self::Area => "area",
            Self::Door => "door",
            Self::Place => "place",
            Self::Map => "map",
            Self::Zone => "zone",
            Self::Object => "object",
            Self::Orthoframe => "orthoframe",
        }
    }

    pub(super) fn title(self) -> (&'static str, &'static str) {
        match self {
            Self::Replica => ("Экземпляр", "Replica"),
            Self::Area => ("Помещение", "Area"),
            Self::Door => ("Дверь", "Door"),
            Self::Place => ("Место", "Place"),
            Self::Map => ("Карта", "Map"),
            Self::Zone => ("Зона", "Zone"),
            Self::Object => ("Объект", "Object"),
            Self::Orthoframe => ("Ортофрейм", "Orthoframe"),
        }
    }

    /// The list within an Area in which the records stand; none for those with a section of their own.
    pub(super) fn lines(self) -> Option<&'static str> {
        match self {
            Self::Replica => Some("replicas"),
            Self::Place => Some("places"),
            _ => None,
        }
    }
}

/// Where a record stands in the tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Handle {
    pub(super) kind: Kind,
    /// The entry of its section; of the section of Areas for a line.
    pub(super) entry: usize,
    pub(super) line: usize,
}

pub(super) struct Tree {
    root: Node,
    names: HashMap<String, Vec<Handle>>,
}

/// A table's entry.
pub(super) fn entry(key: &str, span: &Span, value: Value) -> Entry {
    let node = Node { span: span.clone(), value };
    Entry { key: key.to_owned(), key_span: span.clone(), node }
}

impl Node {
    /// Puts an entry into a table, in place of the one with its key.
    pub(super) fn put(&mut self, new: Entry) {
        let Value::Table(entries) = &mut self.value else { return };
        match entries.iter_mut().find(|e| e.key == new.key) {
            Some(old) => *old = new,
            None => entries.push(new),
        }
    }

    pub(super) fn drop_entry(&mut self, key: &str) {
        if let Value::Table(entries) = &mut self.value {
            entries.retain(|e| e.key != key);
        }
    }

    /// The entry with this key, made with an empty value of the given kind when it is not there.
    fn grow(&mut self, key: &str, empty: Value) -> Option<&mut Entry> {
        let Value::Table(entries) = &mut self.value else { return None };
        if !entries.iter().any(|e| e.key == key) {
            // Beyond the text: nothing that a person wrote is at fault here.
            entries.push(entry(key, &(usize::MAX - 1..usize::MAX), empty));
        }
        entries.iter_mut().find(|e| e.key == key)
    }

    pub(super) fn push(&mut self, list: &str, element: Self) -> usize {
        let Some(entry) = self.grow(list, Value::List(Vec::new())) else { return 0 };
        let Value::List(elements) = &mut entry.node.value else { return 0 };
        elements.push(element);
        elements.len() - 1
    }

    /// Strikes out the elements of a list for which this holds; says whether there were any.
    pub(super) fn strike(&mut self, list: &str, mut is: impl FnMut(&Self) -> bool) -> bool {
        let mut any = false;
        if let Some(Value::List(elements)) = self.entry_mut(list).map(|e| &mut e.node.value) {
            for element in elements.iter_mut().filter(|e| e.value != Value::Nothing) {
                if is(element) {
                    element.value = Value::Nothing;
                    any = true;
                }
            }
        }
        any
    }

    fn prune(&mut self) {
        match &mut self.value {
            Value::List(elements) => {
                elements.retain(|e| e.value != Value::Nothing);
                elements.iter_mut().for_each(Self::prune);
            }
            Value::Table(entries) => {
                entries.retain(|e| e.node.value != Value::Nothing);
                entries.iter_mut().for_each(|e| e.node.prune());
            }
            _ => {}
        }
    }

    /// Moves every place in the text by so many bytes.
    fn displace(&mut self, by: usize) {
        let moved = |span: &Span| span.start + by..span.end + by;
        self.span = moved(&self.span);
        match &mut self.value {
            Value::List(elements) => elements.iter_mut().for_each(|e| e.displace(by)),
            Value::Table(entries) => {
                for entry in entries {
                    entry.key_span = moved(&entry.key_span);
                    entry.node.displace(by);
                }
            }
            _ => {}
        }
    }
}

impl Tree {
    /// The tree of the map as it stands. Its places lie behind the text that edits it, whose length is given.
    pub(super) fn new(mut root: Node, text: usize) -> Self {
        root.displace(text + 1);
        let mut tree = Self { root, names: HashMap::new() };
        for kind in Kind::ALL {
            for (at, names) in tree.names_of(kind) {
                names.iter().for_each(|name| tree.note(name, at));
            }
        }
        tree
    }

    fn names_of(&self, kind: Kind) -> Vec<(Handle, Vec<String>)> {
        let names = |node: &Node| -> Vec<String> {
            ["name", "name_en"]
                .iter()
                .filter_map(|f| node.entry(f)?.node.text())
                .map(str::to_owned)
                .collect()
        };
        let mut found = Vec::new();
        let section = if kind.lines().is_some() { "area" } else { kind.word() };
        for (entry, record) in self.section(section).iter().enumerate() {
            match kind.lines() {
                None => {
                    let all = std::iter::once(record.key.clone()).chain(names(&record.node));
                    found.push((Handle { kind, entry, line: 0 }, all.collect()));
                }
                Some(list) => {
                    let lines = record.node.entry(list).map_or(&[][..], |e| e.node.elements());
                    for (line, node) in lines.iter().enumerate() {
                        found.push((Handle { kind, entry, line }, names(node)));
                    }
                }
            }
        }
        found
    }

    pub(super) fn section(&self, section: &str) -> &[Entry] {
        self.root.entry(section).map_or(&[][..], |e| e.node.entries())
    }

    /// Makes a name known.
    pub(super) fn note(&mut self, name: &str, at: Handle) {
        let handles = self.names.entry(name_key(name)).or_default();
        if !name.is_empty() && !handles.contains(&at) {
            handles.push(at);
        }
    }

    /// What bears a name among some kinds: all of the first kind in which there is any.
    pub(super) fn find(&self, name: &str, kinds: &[Kind]) -> Vec<Handle> {
        let handles = self.names.get(&name_key(name)).map_or(&[][..], Vec::as_slice);
        let standing = |h: &&Handle| self.get(**h).is_some_and(|n| n.value != Value::Nothing);
        let of = |kind: &Kind| -> Vec<Handle> {
            let of_kind: Vec<Handle> =
                handles.iter().filter(|h| h.kind == *kind).filter(standing).copied().collect();
            // A key is exact: it goes before a name that looks like it.
            match of_kind.iter().find(|h| h.kind.lines().is_none() && self.key(**h) == name) {
                Some(exact) => vec![*exact],
                None => of_kind,
            }
        };
        kinds.iter().map(of).find(|found| !found.is_empty()).unwrap_or_default()
    }

    /// The likeliest name among some kinds.
    pub(super) fn nearest(&self, name: &str, kinds: &[Kind]) -> Option<String> {
        let names: Vec<String> =
            kinds.iter().flat_map(|k| self.names_of(*k)).flat_map(|(_, names)| names).collect();
        likely(name, &names.iter().map(String::as_str).collect::<Vec<_>>())
    }

    pub(super) fn get(&self, at: Handle) -> Option<&Node> {
        match at.kind.lines() {
            None => Some(&self.section(at.kind.word()).get(at.entry)?.node),
            Some(list) => {
                self.section("area").get(at.entry)?.node.entry(list)?.node.elements().get(at.line)
            }
        }
    }

    pub(super) fn get_mut(&mut self, at: Handle) -> Option<&mut Node> {
        let section = if at.kind.lines().is_some() { "area" } else { at.kind.word() };
        let Value::Table(records) = &mut self.root.entry_mut(section)?.node.value else {
            return None;
        };
        let record = &mut records.get_mut(at.entry)?.node;
        let Some(list) = at.kind.lines() else { return Some(record) };
        let Value::List(lines) = &mut record.entry_mut(list)?.node.value else { return None };
        lines.get_mut(at.line)
    }

    /// The key of a record of a section; for a line, that of its Area.
    pub(super) fn key(&self, at: Handle) -> &str {
        let section = if at.kind.lines().is_some() { "area" } else { at.kind.word() };
        self.section(section).get(at.entry).map_or("", |e| e.key.as_str())
    }

    /// The word by which other records refer to this one.
    pub(super) fn reference(&self, at: Handle) -> String {
        let own_name = || self.get(at)?.entry("name")?.node.text();
        match at.kind.lines() {
            Some(_) => own_name().unwrap_or_default().to_owned(),
            None => self.key(at).to_owned(),
        }
    }

    /// Adds a record to its section.
    pub(super) fn add(&mut self, kind: Kind, record: Entry) -> Option<Handle> {
        let section = self.root.grow(kind.word(), Value::Table(Vec::new()))?;
        let Value::Table(records) = &mut section.node.value else { return None };
        let mut names = vec![record.key.clone()];
        let text = |f: &&str| record.node.entry(f)?.node.text().map(str::to_owned);
        names.extend(["name", "name_en"].iter().filter_map(text));
        records.push(record);
        let at = Handle { kind, entry: records.len() - 1, line: 0 };
        names.iter().for_each(|name| self.note(name, at));
        Some(at)
    }

    /// Adds a line to a list of an Area.
    pub(super) fn add_line(&mut self, kind: Kind, area: Handle, line: Node) -> Option<Handle> {
        let names: Vec<String> = ["name", "name_en"]
            .iter()
            .filter_map(|f| line.entry(f)?.node.text().map(str::to_owned))
            .collect();
        let number = self.get_mut(area)?.push(kind.lines()?, line);
        let at = Handle { kind, entry: area.entry, line: number };
        names.iter().for_each(|name| self.note(name, at));
        Some(at)
    }

    /// A table of the file itself: `domain`, `robot`, `type`.
    pub(super) fn table_mut(&mut self, name: &str) -> Option<&mut Node> {
        self.root.grow(name, Value::Table(Vec::new())).map(|e| &mut e.node)
    }

    /// Every record of a kind that still stands.
    pub(super) fn all(&self, kind: Kind) -> Vec<Handle> {
        let standing = |(entry, record): (usize, &Entry)| {
            (record.node.value != Value::Nothing).then_some(Handle { kind, entry, line: 0 })
        };
        self.section(kind.word()).iter().enumerate().filter_map(standing).collect()
    }

    /// The tree without what was struck out.
    pub(super) fn finish(mut self) -> Node {
        self.root.prune();
        self.root
    }
}
