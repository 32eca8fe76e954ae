//! Walls of a room: a stretch of a side made a side of its own, so that a door can hang in it; corners put elsewhere.
//!
//! **Invariant**: a side keeps its id, and with it its links, doors and properties; what is cut off gets an id of its own, and
//! what links say of where sides lie is told anew. An Orthoframe that others are made of too is left to them: the room gets a
//! copy. Coordinates stay what they were: whatever stands in a room, on its Map, or was seen there, stays where it is, also
//! where a corner leaves the origin.

mod relink;

use std::collections::BTreeSet;

use super::super::said::{entry, table};
use super::super::verbs::Edit;
use super::{Done, Kind, MapError, Outcome, Record, Span, Step, Steps, misprint};
use crate::file::corners::letters;
use crate::file::decode::shortened;
use crate::file::node::{Node, Value};
use crate::file::schema::Number;
use crate::units::{AreaId, Deg, Frame, Gather as _, OrFrId, Point, said, word};
use crate::{BaseVector, Item, MapItem, Orthoframe, Permeability};

/// Shorter than this is no side, cm.
const LEAST: f64 = 1.0;
/// What is nearer to the origin than this stands there, cm.
const THERE: f64 = 0.01;

/// Whether a point is that from which all is measured.
fn is_origin(p: Point) -> bool {
    p.coords.norm() < THERE
}

/// Of the items of an Area the one that gives it its coordinates: that which says so, or else the first.
fn base_item(items: &[Item]) -> Option<&Item> {
    items.iter().find(|item| item.is_base).or_else(|| items.first())
}

impl Steps<'_> {
    /// `cut`: of a side of an Area the stretch `from … to`, cm from where the side begins, as a side `as` with a type and a
    /// permeability of its own.
    pub(super) fn cut(&mut self, step: &Step<'_>, edit: &Edit) -> Done {
        let Edit::Cut { name, side, from, to, r#as, r#type, permeability } = edit else {
            unreachable!("it is of its verb")
        };
        let area = self.area(name, step.span())?;
        let (item, side) = match side.split_once('.') {
            Some((item, side)) => (Some(item), side),
            None => (None, side.as_str()),
        };
        let (from, to) = (from.get(), to.get());
        let (own, _) = self.own_base(area, item, step)?;
        let mut sides = self.world.orthoframes[&own].base.clone();
        let Some(index) = sides.iter().position(|s| s.id == side) else {
            let (what, name, nearest) = (said!("side"), shortened(side), None);
            let error = MapError::UnknownReference { what, name, nearest };
            return Err(misprint(error, step.at("side")));
        };
        let whole = sides.remove(index);
        let way = whole.end - whole.start;
        let length = way.x.hypot(way.y);
        let fits = from > -LEAST && to < length + LEAST && to - from >= LEAST;
        if !fits {
            let message = word!("a-stretch-of-the-side-from-to");
            return Err(misprint(MapError::BadValue { message: message.into() }, step.span()));
        }
        // What is left of a side and is no longer than that belongs to the stretch.
        let from = if from < LEAST { 0.0 } else { from };
        let to = if to > length - LEAST { length } else { to };
        let along = |way: f64| whole.start + (whole.end - whole.start) * (way / length);
        let mut taken: BTreeSet<String> = sides.iter().map(|s| s.id.clone()).gather();
        taken.insert(whole.id.clone());
        let mut fresh = || {
            let free = (0..).map(letters).find(|id| !taken.contains(id)).expect("there are more");
            taken.insert(free.clone());
            free
        };
        let id = r#as.clone().unwrap_or_else(&mut fresh);
        let mut pieces = Vec::new();
        if from > 0.0 {
            pieces.push(BaseVector { end: along(from), ..whole.clone() });
        }
        let stretch = pieces.len();
        pieces.push(BaseVector {
            id,
            start: along(from),
            end: along(to),
            side_type: None,
            permeability: permeability.unwrap_or(Permeability::Impermeable),
            names: Vec::new(),
            properties: Default::default(),
        });
        if to < length {
            let id = if from > 0.0 { fresh() } else { whole.id.clone() };
            pieces.push(BaseVector { id, start: along(to), ..whole });
        }
        sides.splice(index..index, pieces);
        self.tell_sides(own, sides.len(), step.span());
        let record = Record::Orthoframe(own);
        let told = self.said.of(record).element_at("sides", index + stretch);
        step.copies(&["type", "permeability"]).into_iter().for_each(|field| told.put(field));
        let spot = crate::Spot::of(record).field("sides").index(index + stretch).field("type");
        let kind = crate::TypeKind::Side;
        let read = self.reading(|reader| reader.type_of(kind, r#type.as_deref(), spot));
        sides[index + stretch].side_type = read;
        self.orthoframe_mut(own).base = sides;
        self.relink(area);
        Ok(())
    }

    fn orthoframe_mut(&mut self, id: OrFrId) -> &mut Orthoframe {
        self.world.orthoframes.get_mut(&id).expect("what was found is in the world")
    }

    /// The sides are told where the step is.
    fn tell_sides(&mut self, of: OrFrId, count: usize, at: &Span) {
        let said = self.said.of(Record::Orthoframe(of));
        ["rect", "points", "side"].iter().for_each(|field| said.drop_entry(field));
        let sides: Vec<Node> = (0..count).map(|_| table(at, Vec::new())).collect();
        said.put(entry("sides", at, Value::List(sides)));
    }

    /// `shape`: the corners of an Area's item elsewhere, in the Area's frame; there are as many as before.
    pub(super) fn shape(
        &mut self,
        step: &Step<'_>,
        name: &str,
        points: &[[Number; 2]],
        item: Option<&str>,
    ) -> Done {
        let area = self.area(name, step.span())?;
        let (own, no) = self.own_base(area, item, step)?;
        if self.world.orthoframes[&own].base.len() != points.len() {
            let message = word!("as-many-corners-as-the-area-has");
            return Err(step.bad("points", message));
        }
        let points: Vec<Point> = points.iter().map(|[x, y]| Point::new(x.get(), y.get())).collect();
        let items = &self.world.areas[&area].items;
        let mut stands = items[no].frame;
        // The base item gives the room its coordinates: where no corner of it stands at their origin any more, its own
        // origin does.
        let leaves = !points.iter().any(|p| is_origin(*p)) && !is_origin(stands.origin());
        if leaves && base_item(items).is_some_and(|base| base.id == items[no].id) {
            stands = Frame { angle: Deg::ZERO, ..Frame::IDENTITY };
            self.area_mut(area).items[no].frame = stands;
        }
        let corners: Vec<Point> = points.iter().map(|p| stands.invert(*p)).collect();
        let count = corners.len();
        for (index, side) in self.orthoframe_mut(own).base.iter_mut().enumerate() {
            (side.start, side.end) = (corners[index], corners[(index + 1) % count]);
        }
        self.tell_sides(own, count, step.span());
        self.keep_coordinates(area, step.span());
        self.relink(area);
        Ok(())
    }

    /// The Orthoframe of an Area's item, made its own where others have it too, and which item that is. Without a name it is
    /// the only one.
    fn own_base(
        &mut self,
        area: AreaId,
        item: Option<&str>,
        step: &Step<'_>,
    ) -> Outcome<(OrFrId, usize)> {
        let items = &self.world.areas[&area].items;
        let found = match item {
            Some(name) => items.iter().position(|own| own.id == name),
            None if items.len() == 1 => Some(0),
            None => None,
        };
        let Some(no) = found else {
            let (what, nearest) = (said!("item-of-the-area"), None);
            let name = shortened(item.unwrap_or("?"));
            return Err(misprint(MapError::UnknownReference { what, name, nearest }, step.span()));
        };
        let base = items[no].orthoframe;
        let areas = self.world.areas_made_of(|id| id == base).map(|a| &a.items);
        let objects = self.world.objects_made_of(|id| id == base).map(|o| &o.items);
        let uses = areas.chain(objects).flatten().filter(|i| i.orthoframe == base).count();
        if uses < 2 {
            return Ok((base, no));
        }
        let key = format!("{}-{}", self.world.areas[&area].key, items[no].id);
        let key = (1..)
            .map(|n| if n == 1 { key.clone() } else { format!("{key}-{n}") })
            .find(|key| self.bearers(key, Kind::Orthoframe).is_empty())
            .expect("some number is free");
        let own = OrFrId(self.fresh_id(Kind::Orthoframe));
        let (name, name_en) = (key.clone(), String::new());
        let copy = self.world.orthoframes[&base].clone();
        let record = Record::Orthoframe(own);
        self.note(&key, record);
        self.world.orthoframes.insert(own, Orthoframe { id: own, key, name, name_en, ..copy });
        self.said.new_record(record, step.span(), table(step.span(), Vec::new()));
        self.area_mut(area).items[no].orthoframe = own;
        let told = self.said.of(Record::Area(area)).element_at("items", no);
        told.put(entry("orthoframe", step.span(), Value::Nothing));
        Ok((own, no))
    }

    /// A Map whose coordinates an Area gave keeps them as its own when that one leaves their origin: what was seen there, and
    /// the robot, are told in them.
    pub(super) fn keep_coordinates(&mut self, area: AreaId, at: &Span) {
        let leaves = |map: &&crate::Map| {
            let base = map.items.iter().find(|item| item.is_base).or_else(|| map.items.first());
            let base = base.filter(|item| item.area == area);
            map.frame.is_empty() && base.is_some_and(|base| !self.is_at_origin(base))
        };
        let left: Vec<_> = self.world.maps.values().filter(leaves).map(|map| map.id).collect();
        for map in left {
            let frame = self.world.maps[&map].key.clone();
            self.map_mut(map).frame = frame;
            self.said.of(Record::Map(map)).put(entry("frame", at, Value::Nothing));
        }
    }

    /// Whether the base item of an Area that stands so on a Map has a corner, or its own origin, at that of the Map. What cannot
    /// be measured is told by the checks.
    fn is_at_origin(&self, on_map: &MapItem) -> bool {
        let items = self.world.areas.get(&on_map.area).map_or(&[][..], |area| &area.items);
        let Some(base) = base_item(items) else { return true };
        let Some(part) = self.world.orthoframes.get(&base.orthoframe) else { return true };
        let corners = part.base.iter().map(|side| base.frame.apply(side.start));
        let mut all = corners.chain([base.frame.origin()]);
        all.any(|p| is_origin(on_map.frame.apply(p)))
    }
}
