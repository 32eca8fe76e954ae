//! Zones laid out, changed and moved.

use super::word::{Done, Step, misprint, numbers, table, text_of, written};
use super::{Steps, ZONE};
use crate::fault::MapError;
use crate::file::decode::shortened;
use crate::file::edit::tree::{Handle, Kind, entry};
use crate::file::node::{Entry, Node, Value};

impl Steps<'_> {
    /// `zone`: a new one, or what is said anew of one that is there. A field that is empty is taken back.
    pub(super) fn zone(&mut self, step: &Step<'_>) -> Done {
        let name = step.what()?;
        let mut said = step.copies(ZONE);
        for field in &mut said {
            match (field.key.as_str(), &mut field.node.value) {
                ("rooms", Value::List(rooms)) => {
                    for room in rooms {
                        *room = self.reference(room, &[Kind::Area])?;
                    }
                }
                ("map", Value::Text(map)) if !map.is_empty() => {
                    field.node = self.reference(&field.node, &[Kind::Map])?;
                }
                _ => {}
            }
        }
        if self.tree.find(name, &[Kind::Zone]).is_empty() && (self.names)(name).is_empty() {
            return self.new_zone(step, said);
        }
        let at = self.find(&step.verb.node, &[Kind::Zone])?;
        let zone = self.change(at);
        // A zone is told in one way, and has the number that its kind has.
        for (field, others) in [
            ("rooms", &["points", "map"][..]),
            ("points", &["rooms"]),
            ("kind", &["speed", "heading"]),
        ] {
            if said.iter().any(|e| e.key == field) {
                others.iter().for_each(|other| zone.drop_entry(other));
            }
        }
        for field in said {
            match &field.node.value {
                Value::Text(text) if text.is_empty() => zone.drop_entry(&field.key),
                _ => zone.put(field),
            }
        }
        Ok(())
    }

    fn new_zone(&mut self, step: &Step<'_>, mut said: Vec<Entry>) -> Done {
        step.required("kind")?;
        let name = text_of(&step.verb.node)?;
        let span = step.span();
        // A key has no point, which is what parts keys in a reference.
        let key = name.replace('.', "-");
        if !self.tree.find(&key, &[Kind::Zone]).is_empty() {
            let (what, name) = (Kind::Zone.title().into(), shortened(name));
            return Err(misprint(MapError::AlreadyThere { what, name }, span));
        }
        said.push(Entry { key: "name".to_owned(), ..step.verb.clone() });
        said.push(self.fresh_id(Kind::Zone, span));
        let node = table(&step.verb.key_span, said);
        self.tree.add(Kind::Zone, Entry { key, key_span: span.clone(), node });
        Ok(())
    }

    /// `move` of a zone: all its corners by an offset, or so that the first one comes to a place.
    pub(super) fn shift_zone(&mut self, at: Handle, step: &Step<'_>) -> Done {
        let corners = self.tree.get(at).and_then(|n| n.entry("points"));
        let corners: Vec<Vec<f64>> = match corners {
            Some(points) => points.node.elements().iter().map(numbers).collect::<Result<_, _>>()?,
            None => Vec::new(),
        };
        let Some(first) = corners.first() else {
            let message = (
                "зона состоит из помещений: её не сдвинуть, назовите другие в zone … rooms",
                "the zone is made of areas and cannot be moved; name others by zone … rooms",
            );
            return Err(misprint(MapError::BadValue { message: message.into() }, step.span()));
        };
        if let Some(field) = ["area", "carry"].iter().find_map(|f| step.field(f)) {
            let message = ("у зоны такого нет", "a zone has no such thing").into();
            return Err(misprint(MapError::BadValue { message }, &field.span));
        }
        let component = |list: &[f64], axis: usize| list.get(axis).copied().unwrap_or(0.0);
        let (by, node) = match (step.field("to"), step.field("by")) {
            (Some(to), None) => {
                let place = numbers(to)?;
                ([0, 1].map(|k| component(&place, k) - component(first, k)), to)
            }
            (None, Some(by)) => {
                let offset = numbers(by)?;
                ([0, 1].map(|k| component(&offset, k)), by)
            }
            (None, None) => {
                return Err(misprint(MapError::MissingField { field: "to" }, &step.verb.key_span));
            }
            (Some(_), Some(by)) => {
                let message = ("дайте либо to, либо by", "give either to or by").into();
                return Err(misprint(MapError::BadValue { message }, &by.span));
            }
        };
        let at_node = |value: Value| Node { span: node.span.clone(), value };
        let corner = |corner: &Vec<f64>| {
            let axes = [0, 1].map(|k| at_node(written(component(corner, k) + by[k])));
            at_node(Value::List(axes.into()))
        };
        let moved = Value::List(corners.iter().map(corner).collect());
        self.change(at).put(entry("points", &node.span, moved));
        Ok(())
    }
}
