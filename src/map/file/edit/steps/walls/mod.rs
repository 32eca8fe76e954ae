//! Walls of a room: a stretch of a side made a side of its own, so that a door can hang in it; corners put elsewhere.
//!
//! **Invariant**: a side keeps its id, and with it its links, doors and properties; what is cut off gets an id of its own, and
//! what links say of where sides lie is told anew. An Orthoframe that others are made of too is left to them: the room gets a
//! copy. Coordinates stay what they were: whatever stands in a room, on its Map, or was seen there, stays where it is, also
//! where a corner leaves the origin.

mod relink;
mod side;
mod stands;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;

use super::word::{Done, Outcome, Step, misprint, number, numbers, text_of};
use super::{GROUPS, Steps};
use crate::fault::MapError;
use crate::file::corners::letters;
use crate::file::decode::shortened;
use crate::file::edit::tree::{Handle, Kind, entry};
use crate::file::node::{Entry, Node, Value};
use side::Side;
use stands::{Stands, base_of, is_origin};

/// Shorter than this is no side, cm.
const LEAST: f64 = 1.0;

impl Steps<'_> {
    /// `cut`: of a side of an Area the stretch `from … to`, cm from where the side begins, as a side `as` with a type and a
    /// permeability of its own.
    pub(super) fn cut(&mut self, step: &Step<'_>) -> Done {
        let area = self.find(&step.verb.node, &[Kind::Area])?;
        let side_node = step.required("side")?;
        let (item, side) = split(text_of(side_node)?);
        let (from, to) = (number(step.required("from")?)?, number(step.required("to")?)?);
        let (own, _) = self.own_base(area, item, step)?;
        let mut sides = self.sides(own, step.span())?;
        let Some(index) = sides.iter().position(|s| s.id == side) else {
            let (what, name, nearest) = (("Сторона", "Side").into(), shortened(side), None);
            return Err(misprint(
                MapError::UnknownReference { what, name, nearest },
                &side_node.span,
            ));
        };
        let whole = sides.remove(index);
        let length = whole.length();
        let fits = from > -LEAST && to < length + LEAST && to - from >= LEAST;
        if !fits {
            let message = (
                "отрезок стороны: от from до to, в пределах её длины",
                "a stretch of the side: from … to, within its length",
            );
            return Err(misprint(MapError::BadValue { message: message.into() }, step.span()));
        }
        // What is left of a side and is no longer than that belongs to the stretch.
        let from = if from < LEAST { 0.0 } else { from };
        let to = if to > length - LEAST { length } else { to };
        let mut taken: BTreeSet<String> = sides.iter().map(|s| s.id.clone()).collect();
        taken.insert(whole.id.clone());
        let mut fresh = || {
            let free = (0..).map(letters).find(|id| !taken.contains(id)).expect("there are more");
            taken.insert(free.clone());
            free
        };
        let named = match step.field("as") {
            Some(name) => text_of(name)?.to_owned(),
            None => fresh(),
        };
        let mut pieces = Vec::new();
        if from > 0.0 {
            let traits = whole.traits.clone();
            pieces.push(Side { id: whole.id.clone(), to: whole.at(from), traits, ..whole });
        }
        let traits = step.copies(&["type", "permeability"]);
        let stretch = Side { id: named, from: whole.at(from), to: whole.at(to), traits };
        pieces.push(stretch);
        if to < length {
            let id = if from > 0.0 { fresh() } else { whole.id.clone() };
            pieces.push(Side { id, from: whole.at(to), to: whole.to, traits: whole.traits });
        }
        sides.splice(index..index, pieces);
        self.put_sides(own, sides, step.span());
        self.relink(area);
        Ok(())
    }

    /// `shape`: the corners of an Area's item elsewhere, in the Area's frame; there are as many as before.
    pub(super) fn shape(&mut self, step: &Step<'_>) -> Done {
        let area = self.find(&step.verb.node, &[Kind::Area])?;
        let points_node = step.required("points")?;
        let points: Vec<Vec<f64>> =
            points_node.elements().iter().map(numbers).collect::<Result<_, _>>()?;
        let item = step.field("item").map(text_of).transpose()?;
        let (own, item) = self.own_base(area, item, step)?;
        let mut sides = self.sides(own, step.span())?;
        if sides.len() != points.len() {
            let message = (
                "углов столько же, сколько у помещения; новый угол делает cut",
                "as many corners as the area has; cut makes a new one",
            );
            return Err(misprint(
                MapError::BadValue { message: message.into() },
                &points_node.span,
            ));
        }
        let mut stands = self.frame_of(area, &item)?;
        // The base item gives the room its coordinates: where no corner of it stands at their origin any more, its own
        // origin does.
        let leaves = !points.iter().any(|p| is_origin([p[0], p[1]])) && !is_origin(stands.at);
        if leaves && self.is_base(area, &item) {
            stands = Stands::default();
            self.stand_at_origin(area, &item);
        }
        let corners: Vec<[f64; 2]> = points.iter().map(|p| stands.invert([p[0], p[1]])).collect();
        for (index, side) in sides.iter_mut().enumerate() {
            (side.from, side.to) = (corners[index], corners[(index + 1) % corners.len()]);
        }
        self.put_sides(own, sides, step.span());
        self.keep_coordinates(area, step.span());
        self.relink(area);
        Ok(())
    }

    /// Whether an item is the one that gives its Area the coordinates.
    fn is_base(&self, area: Handle, item: &str) -> bool {
        let items = self.tree.get(area).and_then(|n| n.entry("items"));
        let base = base_of(items.map_or(&[][..], |e| e.node.elements()));
        base.and_then(|n| n.entry("id")).and_then(|e| e.node.text()) == Some(item)
    }

    /// An item that stands with its own origin at that of its Area, and along its axes.
    fn stand_at_origin(&mut self, area: Handle, item: &str) {
        let items = self.change(area).entry_mut("items").map(|e| &mut e.node.value);
        let Some(Value::List(items)) = items else { return };
        let is_it = |n: &&mut Node| n.entry("id").and_then(|e| e.node.text()) == Some(item);
        items.iter_mut().filter(is_it).for_each(|n| {
            n.drop_entry("at");
            n.drop_entry("angle");
        });
    }

    /// The Orthoframe of an Area's item, made its own where others have it too, and the item's name. Without a name it is the
    /// only item.
    fn own_base(
        &mut self,
        area: Handle,
        item: Option<&str>,
        step: &Step<'_>,
    ) -> Outcome<(Handle, String)> {
        let id_of = |n: &Node| n.entry("id").and_then(|e| e.node.text()).map(str::to_owned);
        let items = self.tree.get(area).and_then(|n| n.entry("items"));
        let items = items.map_or(&[][..], |e| e.node.elements());
        let standing = || items.iter().filter(|n| n.value != Value::Nothing);
        let found = match item {
            Some(name) => standing().find(|n| id_of(n).as_deref() == Some(name)),
            None if standing().count() == 1 => standing().next(),
            None => None,
        };
        let frame = found.and_then(|n| n.entry("orthoframe")).and_then(|e| e.node.text());
        let (Some(found), Some(frame)) = (found, frame) else {
            let (what, nearest) = (("Часть помещения", "Item of the area").into(), None);
            let name = shortened(item.unwrap_or("?"));
            return Err(misprint(MapError::UnknownReference { what, name, nearest }, step.span()));
        };
        let (name, key) = (id_of(found).unwrap_or_default(), frame.to_owned());
        let base = self.tree.find(&key, &[Kind::Orthoframe]).into_iter();
        let Some(base) = base.into_iter().find(|h| self.tree.key(*h) == key) else {
            let (what, nearest) = (Kind::Orthoframe.title().into(), None);
            return Err(misprint(
                MapError::UnknownReference { what, name: key, nearest },
                step.span(),
            ));
        };
        let is_it = |n: &&Node| {
            n.value != Value::Nothing
                && n.entry("orthoframe").and_then(|e| e.node.text()) == Some(key.as_str())
        };
        let groups = GROUPS.iter().flat_map(|kind| self.tree.all(*kind));
        let uses: usize = groups
            .filter_map(|group| self.tree.get(group)?.entry("items"))
            .map(|items| items.node.elements().iter().filter(is_it).count())
            .sum();
        if uses < 2 {
            return Ok((base, name));
        }
        let mut copy = self.tree.get(base).expect("it was found").clone();
        let own_key = format!("{}-{}", self.tree.key(area), name);
        let own_key = (1..)
            .map(|n| if n == 1 { own_key.clone() } else { format!("{own_key}-{n}") })
            .find(|key| self.tree.find(key, &[Kind::Orthoframe]).is_empty())
            .expect("some number is free");
        ["id", "name", "name_en"].iter().for_each(|field| copy.drop_entry(field));
        copy.put(self.fresh_id(Kind::Orthoframe, step.span()));
        let record = Entry { key: own_key.clone(), key_span: step.span().clone(), node: copy };
        let own = self.tree.add(Kind::Orthoframe, record).expect("the section is a table");
        let items = self.change(area).entry_mut("items").map(|e| &mut e.node.value);
        if let Some(Value::List(items)) = items {
            for item in items.iter_mut().filter(|n| id_of(n).as_deref() == Some(name.as_str())) {
                item.put(entry("orthoframe", step.span(), Value::Text(own_key.clone())));
            }
        }
        Ok((own, name))
    }
}

/// «A.B» as item and side; a side alone is that of the only item.
fn split(side: &str) -> (Option<&str>, &str) {
    match side.split_once('.') {
        Some((item, side)) => (Some(item), side),
        None => (None, side),
    }
}
