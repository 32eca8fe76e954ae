//! The base of an Orthoframe as sides that are written one by one, however it was written.

use super::super::Steps;
use super::super::word::{Outcome, misprint, numbers, table, text_of, written};
use crate::fault::MapError;
use crate::file::corners::letters;
use crate::file::edit::tree::{Handle, Kind, entry};
use crate::file::node::{Entry, Node, Span, Value};

/// One base vector as it is written, with what else is said of it.
pub(super) struct Side {
    pub(super) id: String,
    pub(super) from: [f64; 2],
    pub(super) to: [f64; 2],
    pub(super) traits: Vec<Entry>,
}

impl Side {
    pub(super) fn length(&self) -> f64 {
        (self.to[0] - self.from[0]).hypot(self.to[1] - self.from[1])
    }

    pub(super) fn at(&self, along: f64) -> [f64; 2] {
        let share = along / self.length();
        [0, 1].map(|axis| self.from[axis] + (self.to[axis] - self.from[axis]) * share)
    }

    fn node(self, span: &Span) -> Node {
        let mut fields = vec![
            entry("id", span, Value::Text(self.id)),
            entry("from", span, corner(self.from, span)),
            entry("to", span, corner(self.to, span)),
        ];
        fields.extend(self.traits);
        table(span, fields)
    }
}

fn corner(at: [f64; 2], span: &Span) -> Value {
    Value::List(at.map(|x| Node { span: span.clone(), value: written(x) }).into())
}

impl Steps<'_> {
    /// The base of an Orthoframe in full, however it is written.
    pub(super) fn sides(&self, at: Handle, span: &Span) -> Outcome<Vec<Side>> {
        let record = self.tree.get(at).expect("it was found");
        let pair = |node: &Node| numbers(node).map(|list| [list[0], list[1]]);
        if let Some(sides) = record.entry("sides").map(|e| e.node.elements())
            && !sides.is_empty()
        {
            let own = ["id", "from", "to"];
            let side = |node: &Node| {
                let field = |name: &'static str| {
                    let missing = || misprint(MapError::MissingField { field: name }, &node.span);
                    node.entry(name).map(|e| &e.node).ok_or_else(missing)
                };
                let traits = node.entries().iter().filter(|e| !own.contains(&e.key.as_str()));
                Ok(Side {
                    id: text_of(field("id")?)?.to_owned(),
                    from: pair(field("from")?)?,
                    to: pair(field("to")?)?,
                    traits: traits.cloned().collect(),
                })
            };
            return sides.iter().map(side).collect();
        }
        let corners: Vec<[f64; 2]> = match (record.entry("points"), record.entry("rect")) {
            (Some(points), _) => {
                points.node.elements().iter().map(pair).collect::<Result<_, _>>()?
            }
            (None, Some(rect)) => {
                let [w, d] = pair(&rect.node)?;
                vec![[0.0, 0.0], [w, 0.0], [w, d], [0.0, d]]
            }
            _ => {
                let message = (
                    "у этого помещения правильный многоугольник: задайте его углами (points)",
                    "this area is a regular polygon: give its corners (points)",
                );
                return Err(misprint(MapError::BadValue { message: message.into() }, span));
            }
        };
        let traits = |id: &str| {
            let all = record.entry("side").and_then(|e| e.node.entry(id));
            all.map_or_else(Vec::new, |e| e.node.entries().to_vec())
        };
        let ends = corners.iter().zip(corners.iter().cycle().skip(1));
        let side = |(index, (from, to)): (usize, (&[f64; 2], &[f64; 2]))| {
            let id = letters(index);
            Side { traits: traits(&id), id, from: *from, to: *to }
        };
        Ok(ends.enumerate().map(side).collect())
    }

    pub(super) fn put_sides(&mut self, at: Handle, sides: Vec<Side>, span: &Span) {
        let record = self.change(at);
        ["rect", "points", "side"].iter().for_each(|field| record.drop_entry(field));
        let sides = sides.into_iter().map(|side| side.node(span)).collect();
        record.put(entry("sides", span, Value::List(sides)));
    }

    /// The base of what an item is made of, where it is written soundly.
    pub(super) fn sides_of(&self, item: &Node) -> Option<Vec<Side>> {
        let key = item.entry("orthoframe")?.node.text()?;
        let all = self.tree.find(key, &[Kind::Orthoframe]);
        let base = all.into_iter().find(|h| self.tree.key(*h) == key)?;
        self.sides(base, &item.span).ok()
    }
}
