//! What an edit file brings: records of a section, lines of an Area, types, each under an id never given before.

use super::Steps;
use super::word::{Done, misprint, table, unknown_field, wrong_kind};
use crate::TypeKind;
use crate::fault::MapError;
use crate::file::decode::{TABLE, shortened};
use crate::file::edit::tree::{Kind, entry};
use crate::file::node::{Entry, Node, Span, Value};

impl Steps<'_> {
    pub(super) fn fresh_id(&mut self, kind: Kind, span: &Span) -> Entry {
        let next = self.ids.of(kind);
        let id = *next;
        *next = next.saturating_add(1);
        entry("id", span, Value::Integer(i64::from(id)))
    }

    /// What is said of the robot; the rest of it stays.
    pub(super) fn robot(&mut self, said: &Node) -> Done {
        if !matches!(said.value, Value::Table(_)) {
            return Err(wrong_kind(said, TABLE));
        }
        let robot = self.tree.table_mut("robot").expect("a map file has room for its robot");
        said.entries().iter().for_each(|entry| robot.put(entry.clone()));
        Ok(())
    }

    /// New records of one section.
    pub(super) fn section(&mut self, kind: Kind, section: &Entry) {
        for record in section.node.entries() {
            let known = self.tree.find(&record.key, &[kind]);
            if known.iter().any(|h| self.tree.key(*h) == record.key) {
                let error =
                    MapError::AlreadyThere { what: kind.title().into(), name: record.key.clone() };
                self.misprints.push(*misprint(error, &record.key_span));
                continue;
            }
            if kind == Kind::Map {
                self.spell_out_domain();
            }
            let mut record = record.clone();
            if kind == Kind::Area {
                for lines in [Kind::Replica, Kind::Place] {
                    self.number_lines(lines, &mut record.node);
                }
            }
            if record.node.entry("id").is_none() {
                let id = self.fresh_id(kind, &record.key_span.clone());
                record.node.put(id);
            }
            self.tree.add(kind, record);
        }
    }

    fn number_lines(&mut self, kind: Kind, area: &mut Node) {
        let Some(list) = kind.lines().and_then(|l| area.entry_mut(l)) else { return };
        let Value::List(lines) = &mut list.node.value else { return };
        for line in lines {
            let span = line.span.clone();
            if line.entry("id").is_none() {
                line.put(self.fresh_id(kind, &span));
            }
        }
    }

    /// A building of one Map need not say where it stands; one of several must.
    fn spell_out_domain(&mut self) {
        let maps = self.tree.all(Kind::Map);
        let [only] = maps[..] else { return };
        let key = self.tree.key(only).to_owned();
        if let Some(domain) = self.tree.table_mut("domain")
            && domain.entry("maps").is_none()
        {
            let nowhere = usize::MAX - 1..usize::MAX;
            let line = table(&nowhere, vec![entry("map", &nowhere, Value::Text(key))]);
            domain.push("maps", line);
        }
    }

    pub(super) fn types(&mut self, section: &Node) {
        for list in section.entries() {
            let Some(kind) = TypeKind::ALL.into_iter().find(|k| k.field() == list.key) else {
                self.misprints.push(*unknown_field(list, &TypeKind::ALL.map(TypeKind::field)));
                continue;
            };
            for line in list.node.elements() {
                let mut line = line.clone();
                if let Some(name) = line.entry("name").and_then(|n| n.node.text())
                    && self.world.types.list(kind).named(name).is_some()
                {
                    let error = MapError::AlreadyThere {
                        what: ("Тип", "Type").into(),
                        name: shortened(name),
                    };
                    self.misprints.push(*misprint(error, &line.span));
                    continue;
                }
                let next = self.ids.types.entry(kind).or_insert(1);
                line.put(entry("id", &line.span.clone(), Value::Integer(i64::from(*next))));
                *next = next.saturating_add(1);
                if let Some(types) = self.tree.table_mut("type") {
                    types.push(kind.field(), line);
                }
            }
        }
    }
}
