//! What edits said of records, with its places in their text: what is found wrong in the edited map is told there.
//!
//! Of each record the fields that an edit gave, as a map file would write them; all else of it lies nowhere.

use std::collections::{BTreeMap, HashSet};

use super::super::node::{Entry, Node, Span, Value};
use super::super::read::Origin;
use crate::fault::{Fault, Record};

/// Beyond every text: nothing that a person wrote is at fault here.
pub(super) const NOWHERE: Span = usize::MAX - 1..usize::MAX;

/// A table's entry.
pub(super) fn entry(key: &str, span: &Span, value: Value) -> Entry {
    let node = Node { span: span.clone(), value };
    Entry { key: key.to_owned(), key_span: span.clone(), node }
}

pub(super) fn table(span: &Span, entries: Vec<Entry>) -> Node {
    Node { span: span.clone(), value: Value::Table(entries) }
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

    /// The table under a key, made where there is none.
    pub(super) fn table_at(&mut self, key: &str) -> &mut Self {
        self.grown(key, Value::Table(Vec::new()))
    }

    /// An element of the list under a key; those before it that nobody spoke of lie nowhere.
    pub(super) fn element_at(&mut self, list: &str, index: usize) -> &mut Self {
        let Value::List(elements) = &mut self.grown(list, Value::List(Vec::new())).value else {
            unreachable!("it was made a list")
        };
        while elements.len() <= index {
            elements.push(table(&NOWHERE, Vec::new()));
        }
        &mut elements[index]
    }

    /// Strikes an element out of the list under a key, if anything was said of it.
    pub(super) fn drop_element(&mut self, list: &str, index: usize) {
        if let Some(Value::List(elements)) = self.entry_mut(list).map(|e| &mut e.node.value)
            && index < elements.len()
        {
            elements.remove(index);
        }
    }

    /// The value under a key, of the kind of this empty one.
    fn grown(&mut self, key: &str, empty: Value) -> &mut Self {
        if !matches!(self.value, Value::Table(_)) {
            self.value = Value::Table(Vec::new());
        }
        let Value::Table(entries) = &mut self.value else { unreachable!("it was made a table") };
        let at = entries.iter().position(|e| e.key == key).unwrap_or_else(|| {
            entries.push(entry(key, &NOWHERE, empty.clone()));
            entries.len() - 1
        });
        let node = &mut entries[at].node;
        if std::mem::discriminant(&node.value) != std::mem::discriminant(&empty) {
            node.value = empty;
        }
        node
    }
}

/// What was said of one record.
#[derive(Debug)]
struct Of {
    node: Node,
    /// What to show for the record as a whole: nothing of one that was there before.
    name: Span,
}

impl Of {
    fn origin(&self) -> Origin<'_> {
        Origin { node: &self.node, name: self.name.clone() }
    }
}

/// What was said of all.
#[derive(Debug, Default)]
pub(super) struct Said {
    records: BTreeMap<Record, Of>,
}

impl Said {
    /// What was said of a record, to be added to.
    pub(super) fn of(&mut self, record: Record) -> &mut Node {
        let nothing = || Of { node: table(&NOWHERE, Vec::new()), name: NOWHERE };
        &mut self.records.entry(record).or_insert_with(nothing).node
    }

    /// A record that is new: the place where it is told of as a whole, and what is said of it.
    pub(super) fn new_record(&mut self, record: Record, name: &Span, node: Node) {
        self.records.insert(record, Of { node, name: name.clone() });
    }

    /// Told of as a whole at another place.
    pub(super) fn rename(&mut self, record: Record, name: &Span) {
        self.of(record);
        self.records.get_mut(&record).expect("made by the line before").name = name.clone();
    }

    /// Where a record stands of which something was said.
    pub(super) fn origin(&self, record: Record) -> Option<Origin<'_>> {
        self.records.get(&record).map(Of::origin)
    }

    /// Finds the places of a fault in the text.
    pub(super) fn locate(&self, fault: &mut Fault, left_out: &HashSet<Span>) {
        fault.locate(|record| self.origin(record), left_out);
    }
}
