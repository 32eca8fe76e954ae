//! What records are like: their properties and those of their sides, probabilities, the states of doors.

use super::Steps;
use super::word::{Done, Outcome, Step, misprint, number, table, text_of};
use crate::fault::MapError;
use crate::file::decode::shortened;
use crate::file::edit::tree::{Kind, entry};
use crate::file::node::{Entry, Node, Value};

/// Kinds that have properties.
const PROPERTIED: &[Kind] =
    &[Kind::Replica, Kind::Area, Kind::Door, Kind::Object, Kind::Orthoframe];

impl Steps<'_> {
    pub(super) fn set(&mut self, step: &Step<'_>) -> Done {
        if let Some(probability) = step.field("move_prob") {
            let at = self.find(&step.verb.node, &[Kind::Replica])?;
            number(probability)?;
            let new = step.copies(&["move_prob"]).remove(0);
            self.change(at).put(new);
            if step.field("property").is_none() {
                return Ok(());
            }
        }
        let property = step.required("property")?;
        let value = step.required("value")?.clone();
        let name = text_of(property)?.to_owned();
        text_of(&value)?;
        let properties = self.properties(step)?;
        properties.put(Entry { key: name, key_span: property.span.clone(), node: value });
        Ok(())
    }

    pub(super) fn unset(&mut self, step: &Step<'_>) -> Done {
        let property = step.required("property")?;
        let name = text_of(property)?.to_owned();
        let properties = self.properties(step)?;
        if properties.entry(&name).is_none() {
            let nearest = None;
            let error =
                MapError::UnknownReference {
                    what: ("Свойство", "Property").into(), name, nearest
                };
            return Err(misprint(error, &property.span));
        }
        properties.drop_entry(&name);
        Ok(())
    }

    /// The table of properties of what a step speaks of, or of one of its sides.
    fn properties(&mut self, step: &Step<'_>) -> Outcome<&mut Node> {
        let kinds = if step.field("side").is_some() {
            vec![Kind::Orthoframe]
        } else {
            self.kinds(step, PROPERTIED)?
        };
        let at = self.find(&step.verb.node, &kinds)?;
        let side = step.field("side").map(text_of).transpose()?;
        let mut record = self.change(at);
        if let Some(side) = side {
            record = side_of(record, side).ok_or_else(|| {
                let (what, name, nearest) = (("Сторона", "Side").into(), shortened(side), None);
                misprint(MapError::UnknownReference { what, name, nearest }, step.span())
            })?;
        }
        if record.entry("properties").is_none() {
            record.put(entry("properties", step.span(), Value::Table(Vec::new())));
        }
        Ok(&mut record.entry_mut("properties").expect("it was put there").node)
    }

    /// The state of a door, or of a door of a replica's Object on that replica.
    pub(super) fn state(&mut self, step: &Step<'_>) -> Done {
        let door = self.find(&step.verb.node, &[Kind::Door])?;
        let is = step.required("is")?;
        let mut state =
            vec![Entry { key: "state".into(), key_span: is.span.clone(), node: is.clone() }];
        state.extend(step.copies(&["opening"]));
        let Some(on) = step.field("on") else {
            let record = self.change(door);
            record.drop_entry("opening");
            state.into_iter().for_each(|field| record.put(field));
            return Ok(());
        };
        let replica = self.find(on, &[Kind::Replica])?;
        let key = self.tree.key(door).to_owned();
        let record = self.change(replica);
        if record.entry("doors").is_none() {
            record.put(entry("doors", &on.span, Value::Table(Vec::new())));
        }
        let doors = &mut record.entry_mut("doors").expect("it was put there").node;
        doors.put(Entry { key, key_span: step.span().clone(), node: table(&is.span, state) });
        Ok(())
    }
}

/// The table of one side of an Orthoframe's base, made where its corners alone are written.
fn side_of<'t>(record: &'t mut Node, side: &str) -> Option<&'t mut Node> {
    if record.entry("sides").is_some() {
        let Value::List(sides) = &mut record.entry_mut("sides")?.node.value else { return None };
        return sides.iter_mut().find(|s| s.entry("id").and_then(|e| e.node.text()) == Some(side));
    }
    let span = record.span.clone();
    if record.entry("side").is_none() {
        record.put(entry("side", &span, Value::Table(Vec::new())));
    }
    let traits = &mut record.entry_mut("side")?.node;
    if traits.entry(side).is_none() {
        traits.put(entry(side, &span, Value::Table(Vec::new())));
    }
    Some(&mut traits.entry_mut(side)?.node)
}
