//! What links say of where sides lie, told anew where a room or its walls went elsewhere.

use super::super::Steps;
use super::super::word::{number, numbers, written};
use super::stands::Stands;
use crate::file::edit::tree::{Handle, Kind, entry};
use crate::file::node::{Node, Value};

/// What differs by no more is the same number, worked out in another way; cm or degrees.
const EXACT: f64 = 1e-6;

impl Steps<'_> {
    /// Where the sides of an Area lie to those that they are linked with, on the Map and in the Area, is told anew.
    pub(in crate::file::edit::steps) fn relink(&mut self, area: Handle) {
        let key = self.tree.key(area).to_owned();
        let speaks = |text: &str| text.strip_prefix(&key).is_some_and(|rest| rest.starts_with('.'));
        for map in self.tree.all(Kind::Map) {
            self.relink_in(map, speaks, |steps, side| steps.placed(map, side));
        }
        self.relink_in(area, |_| true, |steps, side| steps.placed_in(area, side));
    }

    /// The links of a Map or an Area that speak of what was changed, by where their sides are placed now.
    fn relink_in(
        &mut self,
        owner: Handle,
        speaks: impl Fn(&str) -> bool,
        placed: impl Fn(&Self, &str) -> Option<[[f64; 2]; 2]>,
    ) {
        let links = self.tree.get(owner).and_then(|m| m.entry("links"));
        let links = links.map_or(&[][..], |e| e.node.elements());
        let text = |link: &Node, end: &str| Some(link.entry(end)?.node.text()?.to_owned());
        let mut found = Vec::new();
        for (at, link) in links.iter().enumerate() {
            let (Some(from), Some(to)) = (text(link, "from"), text(link, "to")) else { continue };
            if !speaks(&from) && !speaks(&to) {
                continue;
            }
            // What cannot be measured is told by the checks.
            if let (Some(one), Some(other)) = (placed(self, &from), placed(self, &to)) {
                let rel = link.entry("rel").and_then(|e| numbers(&e.node).ok()).unwrap_or_default();
                let angle = link.entry("angle").and_then(|e| number(&e.node).ok()).unwrap_or(0.0);
                let told = |axis: usize| rel.get(axis).copied().unwrap_or(0.0);
                let (by, degrees) = offset(&one, &other);
                let is_as_told = |is: f64, told: f64| (is - told).abs() < EXACT;
                if !(is_as_told(by[0], told(0))
                    && is_as_told(by[1], told(1))
                    && is_as_told(degrees, angle))
                {
                    found.push((at, (by, degrees), told(2)));
                }
            }
        }
        if found.is_empty() {
            return;
        }
        let links = self.change(owner).entry_mut("links").map(|e| &mut e.node.value);
        let Some(Value::List(links)) = links else { return };
        for (at, (by, degrees), height) in found {
            let span = links[at].span.clone();
            let node = |x: f64| Node { span: span.clone(), value: written(x) };
            let rel = [by[0], by[1], height].map(node);
            links[at].put(entry("rel", &span, Value::List(rel.into())));
            links[at].put(entry("angle", &span, written(degrees)));
        }
    }

    /// A side «item.side» of an Area, in its frame; none where that is no side.
    fn placed_in(&self, area: Handle, side: &str) -> Option<[[f64; 2]; 2]> {
        let (item, side) = side.rsplit_once('.')?;
        let items = self.tree.get(area)?.entry("items")?.node.elements();
        let id = |n: &Node| Some(n.entry("id")?.node.text()?.to_owned());
        let item = items.iter().find(|n| id(n).as_deref() == Some(item))?;
        let stands = Stands::of(item).ok()?;
        let sides = self.sides_of(item)?;
        let side = sides.iter().find(|s| s.id == side)?;
        Some([side.from, side.to].map(|p| stands.apply(p)))
    }

    /// A side «area.item.side» or «area.side» on a Map: where it begins and where it ends.
    fn placed(&self, map: Handle, side: &str) -> Option<[[f64; 2]; 2]> {
        let parts: Vec<&str> = side.split('.').collect();
        let (key, item, side) = match parts[..] {
            [area, item, side] => (area, Some(item), side),
            [area, side] => (area, None, side),
            _ => return None,
        };
        let text = |node: &Node, field: &str| Some(node.entry(field)?.node.text()?.to_owned());
        let mut on_map = self.tree.get(map)?.entry("items")?.node.elements().iter();
        let on_map = on_map.find(|line| text(line, "area").as_deref() == Some(key))?;
        let area = self.tree.find(key, &[Kind::Area]);
        let area = area.into_iter().find(|h| self.tree.key(*h) == key)?;
        let items = self.tree.get(area)?.entry("items")?.node.elements();
        let item = match item {
            Some(name) => items.iter().find(|i| text(i, "id").as_deref() == Some(name))?,
            None => items.first()?,
        };
        let sides = self.sides_of(item)?;
        let side = sides.iter().find(|s| s.id == side)?;
        let (inner, outer) = (Stands::of(item).ok()?, Stands::of(on_map).ok()?);
        Some([side.from, side.to].map(|p| outer.apply(inner.apply(p))))
    }
}

/// The offset of a side from another, and its angle less that of the other, turned round where they lie back to back.
fn offset(one: &[[f64; 2]; 2], other: &[[f64; 2]; 2]) -> ([f64; 2], f64) {
    let direction = |s: &[[f64; 2]; 2]| (s[1][1] - s[0][1]).atan2(s[1][0] - s[0][0]).to_degrees();
    let signed = |degrees: f64| (degrees + 180.0).rem_euclid(360.0) - 180.0;
    let turn = signed(direction(other) - direction(one));
    let is_reversed = turn.abs() > 90.0;
    let corner = if is_reversed { other[1] } else { other[0] };
    let angle = if is_reversed { signed(turn - 180.0) } else { turn };
    ([corner[0] - one[0][0], corner[1] - one[0][1]], angle)
}
