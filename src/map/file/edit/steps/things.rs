//! What stands in an Area: replicas and places put down, moved and turned.

use super::word::{Done, Step, misprint, number, numbers, table, written, wrong_kind};
use super::{Steps, VERBS};
use crate::fault::MapError;
use crate::file::decode::{BOOLEAN, shortened};
use crate::file::edit::tree::{Handle, Kind, entry};
use crate::file::node::{Entry, Node, Value};
use crate::units::{AreaId, Bilingual, Deg, Point, ReplicaId};

impl Steps<'_> {
    pub(super) fn place(&mut self, step: &Step<'_>) -> Done {
        let area = self.find(step.required("area")?, &[Kind::Area])?;
        let is_kept = |field: &&&str| !["area", "pose"].contains(*field);
        let fields = VERBS[0].1.iter().filter(is_kept).copied().collect::<Vec<_>>();
        self.new_line(Kind::Replica, area, step, &fields)
    }

    pub(super) fn point(&mut self, step: &Step<'_>) -> Done {
        let area = self.find(step.required("area")?, &[Kind::Area])?;
        self.new_line(Kind::Place, area, step, &["at", "heading", "serves", "name_en", "forms"])
    }

    fn new_line(&mut self, kind: Kind, area: Handle, step: &Step<'_>, fields: &[&str]) -> Done {
        let name = step.what()?;
        if !self.tree.find(name, &[kind]).is_empty() {
            let error = MapError::AlreadyThere { what: kind.title().into(), name: shortened(name) };
            return Err(misprint(error, step.span()));
        }
        let mut entries = step.copies(fields);
        for entry in &mut entries {
            let kinds = match entry.key.as_str() {
                "object" => &[Kind::Object],
                "serves" => &[Kind::Replica],
                _ => continue,
            };
            entry.node = self.reference(&entry.node, kinds)?;
        }
        self.stand_at_pose(area, step, &mut entries)?;
        entries.push(Entry { key: "name".to_owned(), ..step.verb.clone() });
        entries.push(self.fresh_id(kind, step.span()));
        // The place of the line is that of the whole step, as a line of a map file is that of its fields.
        self.tree.add_line(kind, area, table(&step.verb.key_span, entries));
        Ok(())
    }

    /// `pose` tells in the frame of the Map what `at` and the angle tell in that of the Area.
    fn stand_at_pose(&self, area: Handle, step: &Step<'_>, entries: &mut Vec<Entry>) -> Done {
        let Some(pose) = step.field("pose") else { return Ok(()) };
        let wrong = |message: Bilingual| Err(misprint(MapError::BadValue { message }, &pose.span));
        if step.field("at").is_some() {
            return wrong(("дайте либо at, либо pose", "give either at or pose").into());
        }
        let id = match self.tree.get(area).and_then(|n| Some(&n.entry("id")?.node.value)) {
            Some(Value::Integer(id)) => u32::try_from(*id).ok().map(AreaId),
            _ => None,
        };
        let Some((_, frame)) = id.and_then(|id| self.world.placement(id)) else {
            return wrong(
                (
                    "помещение ещё не стоит на карте: дайте at в его системе координат",
                    "the room stands on no map yet: give at in its own frame",
                )
                    .into(),
            );
        };
        let told = numbers(pose)?;
        let at = frame.invert(Point::new(told[0], told[1]));
        let height = told.get(2).map(|z| z - frame.z.get());
        let at = [Some(at.x), Some(at.y), height].into_iter().flatten();
        let at = at.map(|x| Node { span: pose.span.clone(), value: written(hundredths(x)) });
        entries.push(entry("at", &pose.span, Value::List(at.collect())));
        for turned in entries.iter_mut().filter(|e| ["angle", "heading"].contains(&&*e.key)) {
            let angle = (number(&turned.node)? - frame.angle.get()).rem_euclid(360.0);
            turned.node.value = written(angle);
        }
        // A thing of which no angle is said stands along the axes of the Map.
        let is_thing = step.verb.key == "place";
        if is_thing && frame.angle != Deg::ZERO && !entries.iter().any(|e| e.key == "angle") {
            let angle = (-frame.angle.get()).rem_euclid(360.0);
            entries.push(entry("angle", &pose.span, written(angle)));
        }
        Ok(())
    }

    /// `move`: to a place, by an offset, into another Area. Coordinates are those of the Area.
    pub(super) fn shift(&mut self, step: &Step<'_>) -> Done {
        let at = self.find(&step.verb.node, &[Kind::Replica, Kind::Place, Kind::Zone])?;
        if at.kind == Kind::Zone {
            return self.shift_zone(at, step);
        }
        self.note_carrier(at, step)?;
        let before = self.tree.get(at).and_then(|n| n.entry("at")).map(|e| numbers(&e.node));
        let before = before.transpose()?.unwrap_or_default();
        let (to, by) = (step.field("to"), step.field("by"));
        let new = match (to, by) {
            (Some(to), None) => Some((numbers(to)?, to)),
            (None, Some(by)) => {
                let by_how_much = numbers(by)?;
                let sum = |i: usize| {
                    before.get(i).copied().unwrap_or(0.0)
                        + by_how_much.get(i).copied().unwrap_or(0.0)
                };
                let count = before.len().max(by_how_much.len());
                Some(((0..count).map(sum).collect(), by))
            }
            (None, None) if step.field("area").is_some() => None,
            (None, None) => {
                return Err(misprint(MapError::MissingField { field: "to" }, &step.verb.key_span));
            }
            (Some(_), Some(by)) => {
                let message = ("дайте либо to, либо by", "give either to or by").into();
                return Err(misprint(MapError::BadValue { message }, &by.span));
            }
        };
        if let Some((new, node)) = new {
            // A height that was there stays when the new place says none.
            let mut new = new;
            if let (2, Some(z)) = (new.len(), before.get(2)) {
                new.push(*z);
            }
            if at.kind == Kind::Place {
                new.truncate(2);
            }
            let list = new.iter().map(|x| Node { span: node.span.clone(), value: written(*x) });
            let value = Value::List(list.collect());
            self.change(at).put(entry("at", &node.span, value));
        }
        let Some(area) = step.field("area") else { return Ok(()) };
        let area = self.find(area, &[Kind::Area])?;
        if area.entry != at.entry {
            let record = self.change(at);
            let line = Node { span: step.verb.key_span.clone(), value: record.value.clone() };
            record.value = Value::Nothing;
            self.tree.add_line(at.kind, area, line);
        }
        Ok(())
    }

    /// `carry = true`: what stands on the thing goes with it.
    fn note_carrier(&mut self, at: Handle, step: &Step<'_>) -> Done {
        match step.field("carry") {
            None => Ok(()),
            Some(Node { value: Value::Bool(carry), span }) => {
                let id = self.tree.get(at).and_then(|n| match n.entry("id")?.node.value {
                    Value::Integer(id) => u32::try_from(id).ok(),
                    _ => None,
                });
                match id {
                    _ if !carry => Ok(()),
                    Some(id) if at.kind == Kind::Replica => {
                        self.carriers.insert(ReplicaId(id));
                        Ok(())
                    }
                    _ => {
                        let message =
                            ("carry: на точке ничего не стоит", "carry: nothing stands on a place")
                                .into();
                        Err(misprint(MapError::BadValue { message }, span))
                    }
                }
            }
            Some(node) => Err(wrong_kind(node, BOOLEAN)),
        }
    }

    pub(super) fn turn(&mut self, step: &Step<'_>) -> Done {
        let at = self.find(&step.verb.node, &[Kind::Replica, Kind::Place])?;
        self.note_carrier(at, step)?;
        let field = if at.kind == Kind::Place { "heading" } else { "angle" };
        let before = self.tree.get(at).and_then(|n| n.entry(field)).map(|e| number(&e.node));
        let before = before.transpose()?.unwrap_or(0.0);
        let (angle, node) = match (step.field("to"), step.field("by")) {
            (Some(to), None) => (number(to)?, to),
            (None, Some(by)) => ((before + number(by)?).rem_euclid(360.0), by),
            (Some(_), Some(by)) => {
                let message = ("дайте либо to, либо by", "give either to or by").into();
                return Err(misprint(MapError::BadValue { message }, &by.span));
            }
            (None, None) => {
                return Err(misprint(MapError::MissingField { field: "by" }, &step.verb.key_span));
            }
        };
        self.change(at).put(entry(field, &node.span, written(angle)));
        Ok(())
    }
}

/// A tenth of a millimetre: what a turned frame adds behind it nobody measured.
fn hundredths(x: f64) -> f64 {
    (x * 100.0).round() / 100.0 + 0.0
}
