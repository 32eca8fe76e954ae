//! Walls of a room: a stretch of a side made a side of its own, so that a door can hang in it; corners put elsewhere.
//!
//! **Invariant**: a side keeps its id, and with it its links, doors and properties; what is cut off gets an id of its own, and
//! what links say of where sides lie is told anew. An Orthoframe that others are made of too is left to them: the room gets a
//! copy. Coordinates stay what they were: whatever stands in a room, on its Map, or was seen there, stays where it is, also
//! where a corner leaves the origin.

use std::collections::BTreeSet;

use super::word::{Done, Outcome, Step, misprint, number, numbers, table, text_of, written};
use super::{GROUPS, Steps};
use crate::fault::MapError;
use crate::file::corners::letters;
use crate::file::decode::shortened;
use crate::file::edit::tree::{Handle, Kind, entry};
use crate::file::node::{Entry, Node, Span, Value};

/// Shorter than this is no side, cm.
const LEAST: f64 = 1.0;
/// What is nearer to the origin than this stands there, cm.
const THERE: f64 = 0.01;
/// What differs by no more is the same number, worked out in another way; cm or degrees.
const EXACT: f64 = 1e-6;

/// One base vector as it is written, with what else is said of it.
struct Side {
    id: String,
    from: [f64; 2],
    to: [f64; 2],
    traits: Vec<Entry>,
}

impl Side {
    fn length(&self) -> f64 {
        (self.to[0] - self.from[0]).hypot(self.to[1] - self.from[1])
    }

    fn at(&self, along: f64) -> [f64; 2] {
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
        let leaves = !points.iter().any(|p| p[0].hypot(p[1]) < THERE) && !stands.is_at_origin();
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

    /// A Map whose coordinates an Area gave keeps them as its own when that one leaves their origin: what was seen there, and
    /// the robot, are told in them.
    pub(super) fn keep_coordinates(&mut self, area: Handle, span: &Span) {
        let key = self.tree.key(area).to_owned();
        for map in self.tree.all(Kind::Map) {
            let Some(record) = self.tree.get(map) else { continue };
            let has_own = record.entry("frame").and_then(|e| e.node.text());
            let items = record.entry("items").map_or(&[][..], |e| e.node.elements());
            let base = base_of(items);
            let is_of = |n: &&Node| n.entry("area").and_then(|e| e.node.text()) == Some(&key);
            let Some(base) = base.filter(is_of) else { continue };
            if has_own.is_some_and(|frame| !frame.is_empty()) || self.is_at_origin(area, base) {
                continue;
            }
            let frame = Value::Text(self.tree.key(map).to_owned());
            self.change(map).put(entry("frame", span, frame));
        }
    }

    /// Whether the base item of an Area that stands so on a Map has a corner, or its own origin, at that of the Map. What cannot
    /// be measured is told by the checks.
    fn is_at_origin(&self, area: Handle, on_map: &Node) -> bool {
        let items = self.tree.get(area).and_then(|n| n.entry("items"));
        let Some(base) = base_of(items.map_or(&[][..], |e| e.node.elements())) else { return true };
        let (Ok(inner), Ok(outer)) = (Stands::of(base), Stands::of(on_map)) else { return true };
        let Some(sides) = self.sides_of(base) else { return true };
        let corners = sides.iter().map(|side| side.from);
        let mut all = corners.map(|p| inner.apply(p)).chain([inner.at]);
        all.any(|p| {
            let [x, y] = outer.apply(p);
            x.hypot(y) < THERE
        })
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

    /// The base of an Orthoframe in full, however it is written.
    fn sides(&self, at: Handle, span: &Span) -> Outcome<Vec<Side>> {
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

    fn put_sides(&mut self, at: Handle, sides: Vec<Side>, span: &Span) {
        let record = self.change(at);
        ["rect", "points", "side"].iter().for_each(|field| record.drop_entry(field));
        let sides = sides.into_iter().map(|side| side.node(span)).collect();
        record.put(entry("sides", span, Value::List(sides)));
    }

    /// Where an item stands in its Area.
    fn frame_of(&self, area: Handle, item: &str) -> Outcome<Stands> {
        let items = self.tree.get(area).and_then(|n| n.entry("items"));
        let items = items.map_or(&[][..], |e| e.node.elements());
        let is_it = |n: &&Node| n.entry("id").and_then(|e| e.node.text()) == Some(item);
        items.iter().find(is_it).map_or(Ok(Stands::default()), Stands::of)
    }

    /// Where the sides of an Area lie to those that they are linked with, on the Map and in the Area, is told anew.
    pub(super) fn relink(&mut self, area: Handle) {
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

    /// The base of what an item is made of, where it is written soundly.
    fn sides_of(&self, item: &Node) -> Option<Vec<Side>> {
        let key = item.entry("orthoframe")?.node.text()?;
        let all = self.tree.find(key, &[Kind::Orthoframe]);
        let base = all.into_iter().find(|h| self.tree.key(*h) == key)?;
        self.sides(base, &item.span).ok()
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

/// Of the items of an Area, or of a Map, the one that gives it its coordinates: that which says so, or else the first.
fn base_of(items: &[Node]) -> Option<&Node> {
    let mut standing = items.iter().filter(|n| n.value != Value::Nothing);
    let is_base = |n: &&Node| n.entry("base").is_some_and(|e| e.node.value == Value::Bool(true));
    standing.clone().find(is_base).or_else(|| standing.next())
}

/// Where something stands: its origin, and its angle in degrees.
#[derive(Debug, Clone, Copy, Default)]
struct Stands {
    at: [f64; 2],
    degrees: f64,
}

impl Stands {
    fn of(node: &Node) -> Outcome<Self> {
        let at = node.entry("at").map(|e| numbers(&e.node)).transpose()?;
        let degrees = node.entry("angle").map(|e| number(&e.node)).transpose()?;
        Ok(Self {
            at: at.map_or([0.0; 2], |list| [list[0], list[1]]),
            degrees: degrees.unwrap_or(0.0),
        })
    }

    fn is_at_origin(self) -> bool {
        self.at[0].hypot(self.at[1]) < THERE
    }

    fn invert(self, p: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = sin_cos(self.degrees);
        let (dx, dy) = (p[0] - self.at[0], p[1] - self.at[1]);
        [cos * dx + sin * dy, cos * dy - sin * dx]
    }

    fn apply(self, p: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = sin_cos(self.degrees);
        [self.at[0] + cos * p[0] - sin * p[1], self.at[1] + sin * p[0] + cos * p[1]]
    }
}

fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        // Exact on the axes, so that straight walls stay straight.
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => other.to_radians().sin_cos(),
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

/// «A.B» as item and side; a side alone is that of the only item.
fn split(side: &str) -> (Option<&str>, &str) {
    match side.split_once('.') {
        Some((item, side)) => (Some(item), side),
        None => (None, side),
    }
}

#[cfg(test)]
mod tests {
    use crate::file::edit::{NextIds, edit};
    use crate::units::{AreaId, Point, Source};
    use crate::{Format, NameIndex, Naming, Permeability, World};

    fn rb2() -> World {
        World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/rb2.toml"))
            .expect("the map is sound")
    }

    fn edited(world: &World, text: &str) -> Result<World, String> {
        let source = Source::new("edits.toml", text);
        let naming = Naming { exact: &NameIndex::of(world), in_other_words: &|_| Vec::new() };
        let done = edit(world, &source, Format::Toml, &NextIds::after(world), naming);
        let faults = || done.faults.faults.iter().map(|f| f.error.to_string()).collect::<Vec<_>>();
        done.world.ok_or_else(|| faults().join("; "))
    }

    fn size(world: &World, area: AreaId) -> f64 {
        let doubled = |corners: &Vec<Point>| {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>()
        };
        world.area_polygons(area).iter().map(doubled).sum::<f64>() / 2.0
    }

    #[test]
    fn a_stretch_cut_out_of_any_wall_changes_no_room_and_no_door() {
        let world = rb2();
        let mut cuts = 0;
        for area in world.areas.values() {
            for item in &area.items {
                for side in &world.orthoframe_of(item).base {
                    let length = side.length().get();
                    let has_door =
                        area.doors.iter().any(|m| m.item == item.id && m.side == side.id);
                    if has_door || length < 10.0 {
                        continue;
                    }
                    for (from, to, more) in [(0.0, length, 0), (0.0, 5.0, 1), (2.0, 6.0, 2)] {
                        let text = format!(
                            "[[edit]]\ncut = {:?}\nside = \"{}.{}\"\nfrom = {from}\nto = {to}\nas = \"neu\"\n",
                            area.name, item.id, side.id
                        );
                        let cut =
                            edited(&world, &text).unwrap_or_else(|why| panic!("{text}: {why}"));
                        let base = cut.areas[&area.id].item(&item.id).map(|i| cut.orthoframe_of(i));
                        let base = base.expect("the item stays");
                        assert_eq!(base.base.len(), world.orthoframe_of(item).base.len() + more);
                        let (_, new) = base.side("neu").expect("it was cut");
                        assert!((new.length().get() - (to - from)).abs() < 1e-6, "{text}");
                        for other in world.areas.keys() {
                            let (was, is) = (size(&world, *other), size(&cut, *other));
                            assert!((was - is).abs() < 1e-3, "{text}: {was} {is}");
                        }
                        for door in world.doors.keys() {
                            for room in world.door_areas(*door) {
                                assert_eq!(
                                    world.threshold(room, *door),
                                    cut.threshold(room, *door)
                                );
                            }
                        }
                        cuts += 1;
                    }
                }
            }
        }
        assert!(cuts > 20, "{cuts}");
    }

    #[test]
    fn a_stretch_beyond_the_wall_and_a_side_that_is_none_are_refused_at_their_place() {
        let world = rb2();
        let room = world.areas.values().next().expect("there is one");
        let side = &world.orthoframe_of(&room.items[0]).base[0];
        let text = |side: &str, from: f64, to: f64| {
            let (name, item) = (&room.name, &room.items[0].id);
            format!(
                "[[edit]]\ncut = {name:?}\nside = \"{item}.{side}\"\nfrom = {from}\nto = {to}\n"
            )
        };
        let length = side.length().get();
        for (side, from, to) in [
            (side.id.as_str(), 10.0, length + 5.0),
            (side.id.as_str(), -9.0, 20.0),
            (side.id.as_str(), 20.0, 20.0),
            ("nichts", 0.0, 20.0),
        ] {
            assert!(edited(&world, &text(side, from, to)).is_err(), "{side} {from} {to}");
        }
    }

    #[test]
    fn a_room_takes_the_corners_that_it_is_given_and_leaves_those_of_others() {
        let old = rb2();
        let neighbour = old.areas.values().next().expect("there is one");
        let item = &neighbour.items[0];
        let walls = old.orthoframe_of(item).base.iter();
        let wall = walls.clone().find(|v| v.permeability == Permeability::Impermeable);
        let wall = format!("{}.{}.{}", neighbour.name, item.id, wall.expect("there is a wall").id);
        let tied = |key: &str, y: u32| {
            let stands = format!("[[edit]]\nstand = {key:?}\nat = [5000, {y}]\n");
            format!(
                "{stands}[[edit]]\nlink = \"{key}.A.A\"\nto = {wall:?}\n{stands}relink = true\n"
            )
        };
        let text = format!(
            r#"
            [orthoframe.square]
            height = 270
            rect = [400, 300]
            [area.one]
            name = "Раз"
            items = [{{ id = "A", orthoframe = "square", angle = 90, at = [300, 0] }}]
            [area.two]
            name = "Два"
            items = [{{ id = "A", orthoframe = "square" }}]
            {}{}"#,
            tied("one", 5000),
            tied("two", 7000)
        );
        let world = edited(&old, &text).expect("two rooms of one shape");
        let room = |world: &World, name: &str| {
            let area = world.areas.values().find(|area| area.name == name).expect("it is there");
            world.area_polygons(area.id).remove(0)
        };
        let shape =
            "[[edit]]\nshape = \"Раз\"\npoints = [[300, 0], [300, 400], [0, 450], [0, 0]]\n";
        let shaped = edited(&world, shape).expect("four corners");
        let corners: Vec<[f64; 2]> = room(&shaped, "Раз").iter().map(|p| [p.x, p.y]).collect();
        for (is, wanted) in
            corners.iter().zip([[300.0, 0.0], [300.0, 400.0], [0.0, 450.0], [0.0, 0.0]])
        {
            assert!((is[0] - wanted[0]).hypot(is[1] - wanted[1]) < 1e-6, "{corners:?}");
        }
        assert_eq!(room(&shaped, "Два"), room(&world, "Два"));
        let fewer = "[[edit]]\nshape = \"Раз\"\npoints = [[300, 0], [300, 400], [0, 0]]\n";
        assert!(edited(&world, fewer).is_err());
    }

    /// Where all things, places and rooms but one are on their Maps.
    fn standing(world: &World, but: AreaId) -> Vec<(String, [f64; 4])> {
        let placed = |area: AreaId| world.placement(area).expect("every room stands on a map").1;
        let things = world.replicas.values().map(|r| {
            let on = placed(r.area).compose(&r.frame);
            (r.name.clone(), [on.x.get(), on.y.get(), on.z.get(), on.angle.get()])
        });
        let places = world.places.values().map(|p| {
            let at = placed(p.area).apply(p.at);
            (p.name.clone(), [at.x, at.y, 0.0, 0.0])
        });
        let rooms = world.areas.values().filter(|area| area.id != but).flat_map(|area| {
            let corners = world.area_polygons(area.id).concat().into_iter();
            corners
                .map(|p| placed(area.id).apply(p))
                .map(|p| (area.name.clone(), [p.x, p.y, 0.0, 0.0]))
        });
        things.chain(places).chain(rooms).collect()
    }

    fn is_same(was: &[(String, [f64; 4])], is: &[(String, [f64; 4])]) -> bool {
        let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-6;
        was.len() == is.len()
            && was.iter().zip(is).all(|((a, p), (b, q))| a == b && p.iter().zip(q).all(near))
    }

    /// The corners of the parts of an Area as they stand in it, by the item's id.
    fn corners(world: &World, area: AreaId) -> Vec<(String, Vec<Point>)> {
        let items = world.areas[&area].items.iter();
        let of = |item: &crate::Item| {
            let corners = world.orthoframe_of(item).corners();
            (item.id.clone(), corners.map(|p| item.frame.apply(p)).collect())
        };
        items.map(of).collect()
    }

    /// Puts every corner of every room elsewhere, those at the origins among them; how many edits there were, and how many of
    /// these of corners at the origin of their room.
    fn put_elsewhere(world: &World, by: [f64; 2]) -> (usize, usize) {
        let (mut done, mut at_origin) = (0, 0);
        for area in world.areas.values() {
            let before = standing(world, area.id);
            for (item, was) in corners(world, area.id) {
                for moved in 0..was.len() {
                    let mut wanted = was.clone();
                    (wanted[moved].x, wanted[moved].y) =
                        (wanted[moved].x + by[0], wanted[moved].y + by[1]);
                    let points: Vec<String> =
                        wanted.iter().map(|p| format!("[{}, {}]", p.x, p.y)).collect();
                    let text = format!(
                        "[[edit]]\nshape = {:?}\nitem = {item:?}\npoints = [{}]\n",
                        area.name,
                        points.join(", ")
                    );
                    let after = match edited(world, &text) {
                        Ok(after) => after,
                        Err(why) => {
                            // A door that would not fit, a room that would lie over another: never the origin.
                            assert!(!why.contains("начале координат"), "{text}: {why}");
                            continue;
                        }
                    };
                    assert!(is_same(&before, &standing(&after, area.id)), "{text}");
                    for (id, is) in corners(&after, area.id) {
                        let own = was_of(world, area.id, &id);
                        let wanted = if id == item { &wanted } else { &own };
                        assert!(
                            is.iter().zip(wanted).all(|(p, q)| (p - q).norm() < 1e-6),
                            "{text}: {is:?}"
                        );
                    }
                    // What is written reads back as the same map.
                    let file = Source::new("map.toml", after.to_toml());
                    let again = World::parse(&file, Format::Toml).expect("it is sound");
                    assert!(is_same(&standing(&after, area.id), &standing(&again, area.id)));
                    done += 1;
                    at_origin += usize::from(was[moved].coords.norm() < 0.01);
                }
            }
        }
        (done, at_origin)
    }

    fn was_of(world: &World, area: AreaId, item: &str) -> Vec<Point> {
        let all = corners(world, area);
        all.into_iter().find(|(id, _)| id == item).expect("no item goes").1
    }

    #[test]
    fn a_corner_at_the_origin_is_put_elsewhere_and_all_that_stands_there_stays() {
        let mut sums = (0, 0);
        for map in ["rb2", "lab", "two-storeys"] {
            let path = format!("{}/../../maps/{map}.toml", env!("CARGO_MANIFEST_DIR"));
            let world = World::load(path).expect("the map is sound");
            for by in [[0.0, 3.0], [4.0, 0.0], [-2.0, -2.0], [2.5, 1.5]] {
                let (done, at_origin) = put_elsewhere(&world, by);
                sums = (sums.0 + done, sums.1 + at_origin);
            }
        }
        assert!(sums.0 > 60 && sums.1 > 5, "{sums:?}");
    }

    /// A room whose base item stands turned, with another part linked to it, which gives the Map its coordinates too.
    #[test]
    fn a_room_of_two_parts_gives_up_the_origin_of_its_map() {
        let text = r#"
            format = 1
            [orthoframe.square]
            height = 270
            rect = [400, 300]
            [orthoframe.annex]
            height = 270
            rect = [200, 400]
            [object.box]
            name = "Ящик"
            items = [{ id = "A", orthoframe = "cube" }]
            [orthoframe.cube]
            height = 30
            rect = [30, 30]
            [area.one]
            name = "Раз"
            items = [
                { id = "A", orthoframe = "square", angle = 90, at = [300, 0] },
                { id = "B", orthoframe = "annex", at = [300, 0] },
            ]
            links = [{ from = "A.A", to = "B.D" }]
            replicas = [{ name = "Ящик-1", object = "box", at = [100, 100] }]
            places = [{ name = "Пост", at = [200, 200] }]
            [map.floor]
            name = "Этаж"
            items = [{ area = "one", angle = 90, at = [400, 0] }]
            [robot]
            start = "Пост"
        "#;
        let world = World::parse(&Source::new("map.toml", text), Format::Toml);
        let world = world.unwrap_or_else(|faults| panic!("{faults}"));
        for by in [[0.0, 30.0], [15.0, 0.0], [-20.0, -25.0]] {
            let (done, at_origin) = put_elsewhere(&world, by);
            assert!(done >= 4 && at_origin >= 1, "{by:?}: {done} {at_origin}");
        }
        let stands = "[[edit]]\nstand = \"Раз\"\nat = [340, 25]\nrelink = true\n";
        let moved = edited(&world, stands).expect("the map keeps its coordinates");
        assert_eq!(moved.maps.values().next().expect("there is one").frame, "floor");
        let told = "[[edit]]\nstand = \"Раз\"\nat = [340, 25]\n";
        assert!(edited(&world, told).is_err(), "a file says what it means");
    }
}
