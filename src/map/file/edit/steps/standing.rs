//! Where the large things stand: Areas on a Map, Maps in the Domain, lifts between them.

use super::Steps;
use super::word::{Done, Outcome, Step, misprint, table};
use crate::fault::MapError;
use crate::file::edit::tree::{Handle, Kind, entry};
use crate::file::node::{Entry, Node, Value};

impl Steps<'_> {
    /// Where an Area stands on a Map; with `relink` what its links say of that is told anew, and the Map keeps its coordinates.
    pub(super) fn stand(&mut self, step: &Step<'_>) -> Done {
        let area = self.find(&step.verb.node, &[Kind::Area])?;
        let map = match step.field("map") {
            Some(map) => self.find(map, &[Kind::Map])?,
            None => self.only_map(step)?,
        };
        self.put_down("items", "area", area, map, step)?;
        if step.field("relink").is_some_and(|node| node.value == Value::Bool(true)) {
            self.keep_coordinates(area, step.span());
            self.relink(area);
        }
        Ok(())
    }

    fn only_map(&self, step: &Step<'_>) -> Outcome<Handle> {
        match self.tree.all(Kind::Map)[..] {
            [only] => Ok(only),
            _ => Err(misprint(MapError::MissingField { field: "map" }, &step.verb.key_span)),
        }
    }

    fn put_down(
        &mut self,
        list: &str,
        field: &str,
        what: Handle,
        on: Handle,
        step: &Step<'_>,
    ) -> Done {
        let key = self.tree.key(what).to_owned();
        let mut fields = step.copies(&["at", "angle", "base"]);
        let owner = self.change(on);
        let known = owner.entry_mut(list).and_then(|e| match &mut e.node.value {
            Value::List(lines) => lines
                .iter_mut()
                .find(|l| l.entry(field).and_then(|e| e.node.text()) == Some(key.as_str())),
            _ => None,
        });
        if let Some(line) = known {
            fields.into_iter().for_each(|f| line.put(f));
        } else {
            fields.push(entry(field, step.span(), Value::Text(key)));
            owner.push(list, table(&step.verb.key_span, fields));
        }
        Ok(())
    }

    /// Where a Map stands in the Domain.
    pub(super) fn include(&mut self, step: &Step<'_>) -> Done {
        let map = self.find(&step.verb.node, &[Kind::Map])?;
        let key = self.tree.key(map).to_owned();
        let fields = step.copies(&["at", "angle", "base"]);
        let Some(domain) = self.tree.table_mut("domain") else { return Ok(()) };
        let known = domain.entry_mut("maps").and_then(|e| match &mut e.node.value {
            Value::List(lines) => lines
                .iter_mut()
                .find(|l| l.entry("map").and_then(|e| e.node.text()) == Some(key.as_str())),
            _ => None,
        });
        match known {
            Some(line) => fields.into_iter().for_each(|f| line.put(f)),
            None => {
                let mut line = fields;
                line.push(entry("map", step.span(), Value::Text(key)));
                domain.push("maps", table(&step.verb.key_span, line));
            }
        }
        Ok(())
    }

    /// A lift, or a flight of stairs, with its stops; one of this name gets these stops.
    pub(super) fn lift(&mut self, step: &Step<'_>) -> Done {
        let name = step.what()?.to_owned();
        let stops = step.required("stops")?;
        let areas: Vec<Node> = stops
            .elements()
            .iter()
            .map(|stop| self.reference(stop, &[Kind::Area]))
            .collect::<Result<_, _>>()?;
        let line = vec![
            Entry { key: "name".into(), ..step.verb.clone() },
            entry("stops", &stops.span, Value::List(areas)),
        ];
        let Some(domain) = self.tree.table_mut("domain") else { return Ok(()) };
        domain
            .strike("lifts", |lift| lift.entry("name").and_then(|e| e.node.text()) == Some(&name));
        domain.push("lifts", table(&step.verb.key_span, line));
        Ok(())
    }
}
