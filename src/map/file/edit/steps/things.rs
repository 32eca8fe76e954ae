//! What stands in an Area: replicas and places put down, moved and turned.

use super::super::said::{entry, table};
use super::super::verbs::Edit;
use super::{Deg, Done, Frame, Kind, MapError, Outcome, Record, Span, Step, Steps};
use super::{cm, misprint, too_large};
use crate::file::decode::shortened;
use crate::file::node::{Entry, Node, Value};
use crate::file::schema::{At, Coordinates, Number, PlaceFile, ReplicaFile};
use crate::units::{AreaId, Piece, PlaceId, Point, ReplicaId, word};

pub(super) const EITHER: Piece = word!("give-either-to-or-by");

/// Where something is told to stand.
struct Spot {
    at: Vec<Number>,
    angle: Option<Number>,
}

impl Steps<'_> {
    pub(super) fn place(&mut self, step: &Step<'_>, edit: &Edit, is_broken: bool) -> Done {
        let Edit::Place {
            name,
            object,
            area,
            at,
            pose,
            angle,
            name_en,
            move_prob,
            properties,
            doors,
            forms,
        } = edit
        else {
            unreachable!("it is of its verb")
        };
        let area = self.area(area, step.at("area"))?;
        self.is_free(name, Kind::Replica, step.span())?;
        let object = self.reference(self.find(object, step.at("object"), &[Kind::Object])?);
        let list = |at: &Coordinates| at.numbers();
        let told = (at.as_ref().map(list), pose.as_ref().map(list), *angle);
        let Spot { at, angle } = self.spot(step, area, told, "angle")?;
        let id = ReplicaId(self.fresh_id(Kind::Replica));
        let file = ReplicaFile {
            name: name.clone(),
            object,
            at: At(at),
            id: Some(id.0),
            name_en: name_en.clone().unwrap_or_default(),
            angle,
            move_prob: move_prob.unwrap_or_default(),
            properties: properties.clone(),
            doors: doors.clone(),
            forms: forms.clone(),
        };
        self.tell_line(step, Record::Replica(id), name, is_broken);
        let read = self.reading(|reader| reader.replica((area, id, file)));
        self.world.replicas.extend(read);
        Ok(())
    }

    pub(super) fn point(&mut self, step: &Step<'_>, edit: &Edit, is_broken: bool) -> Done {
        let Edit::Point { name, area, at, pose, heading, serves, name_en, forms } = edit else {
            unreachable!("it is of its verb")
        };
        let area = self.area(area, step.at("area"))?;
        self.is_free(name, Kind::Place, step.span())?;
        let serves = match serves {
            Some(serves) => Some(self.find(serves, step.at("serves"), &[Kind::Replica])?),
            None => None,
        };
        let told = (at.map(Vec::from), pose.map(Vec::from), *heading);
        let Spot { at, angle } = self.spot(step, area, told, "heading")?;
        let id = PlaceId(self.fresh_id(Kind::Place));
        let file = PlaceFile {
            name: name.clone(),
            at: [at[0], at[1]],
            id: Some(id.0),
            name_en: name_en.clone().unwrap_or_default(),
            heading: angle,
            serves: None,
            forms: forms.clone(),
        };
        self.tell_line(step, Record::Place(id), name, is_broken);
        let (id, mut place) = self.reading(|reader| reader.place((area, id, file)));
        if let Some(Record::Replica(served)) = serves {
            place.serves = Some(served);
        }
        self.world.places.insert(id, place);
        Ok(())
    }

    pub(super) fn area(&self, name: &str, at: &Span) -> Outcome<AreaId> {
        match self.find(name, at, &[Kind::Area])? {
            Record::Area(id) => Ok(id),
            _ => unreachable!("it was looked for among Areas"),
        }
    }

    fn is_free(&self, name: &str, kind: Kind, at: &Span) -> Done {
        if self.bearers(name, kind).is_empty() {
            return Ok(());
        }
        let (what, name) = (kind.title().into(), shortened(name));
        Err(misprint(MapError::AlreadyThere { what, name }, at))
    }

    /// The line is told of at the verb, as a line of a map file is where it begins.
    fn tell_line(&mut self, step: &Step<'_>, record: Record, name: &str, is_broken: bool) {
        let mut fields: Vec<Entry> = step.node.entries().to_vec();
        let of = |e: &Entry| e.key == step.verb.key;
        fields.iter_mut().filter(|e| of(e)).for_each(|e| "name".clone_into(&mut e.key));
        for pose in fields.iter_mut().filter(|e| e.key == "pose") {
            *pose = entry("at", &pose.node.span, Value::Nothing);
        }
        let node = table(step.key_span(), fields);
        self.said.new_record(record, step.key_span(), node);
        self.note(name, record);
        if is_broken {
            self.broken.insert(record);
        }
    }

    /// Where something stands in the axes of the Area. `pose` tells in the frame of the Map what `at` and the angle tell in
    /// that of the Area.
    fn spot(
        &self,
        step: &Step<'_>,
        area: AreaId,
        (at, pose, turned): (Option<Vec<Number>>, Option<Vec<Number>>, Option<Number>),
        field: &str,
    ) -> Outcome<Spot> {
        let Some(told) = pose else {
            // What could not be read is told already.
            let unread = || step.entry("at").map(|_| vec![Number::ZERO; 2]);
            let at = at.or_else(unread).ok_or_else(|| step.missing("at"))?;
            return Ok(Spot { at, angle: turned });
        };
        if at.is_some() {
            return Err(step.bad("pose", word!("give-either-at-or-pose")));
        }
        let Some((_, frame)) = self.start.placement(area) else {
            return Err(step.bad("pose", word!("the-room-stands-on-no-map-yet")));
        };
        let place = frame.invert(Point::new(told[0].get(), told[1].get()));
        let height = told.get(2).map(|z| z.get() - frame.z.get());
        let mut at = Vec::new();
        for axis in [Some(place.x), Some(place.y), height].into_iter().flatten() {
            at.push(Number::from(cm(hundredths(axis), step.at("pose"))?));
        }
        let angle = match turned {
            Some(turned) => Some((turned.get() - frame.angle.get()).rem_euclid(360.0)),
            // A thing of which no angle is said stands along the axes of the Map.
            None if field == "angle" && frame.angle != Deg::ZERO => {
                Some((-frame.angle.get()).rem_euclid(360.0))
            }
            None => None,
        };
        let number = |angle: f64| {
            let at = if turned.is_some() { field } else { "pose" };
            cm(angle, step.at(at)).map(Number::from)
        };
        Ok(Spot { at, angle: angle.map(number).transpose()? })
    }

    /// `move`: to a place, by an offset, into another Area. Coordinates are those of the Area.
    pub(super) fn shift(
        &mut self,
        step: &Step<'_>,
        name: &str,
        (to, by): (Option<&Coordinates>, Option<&Coordinates>),
        area: Option<&str>,
        carry: bool,
    ) -> Done {
        let kinds = [Kind::Replica, Kind::Area, Kind::Place, Kind::Zone];
        let record = self.find(name, step.span(), &kinds)?;
        match record {
            Record::Zone(id) => return self.shift_zone(id, step, (to, by)),
            Record::Area(id) => return self.shift_area(id, step, (to, by)),
            _ => {}
        }
        self.note_carrier(record, step, carry)?;
        let (field, told) = match (to, by) {
            (Some(to), None) => ("to", Some((to, false))),
            (None, Some(by)) => ("by", Some((by, true))),
            (None, None) if area.is_some() => ("area", None),
            (None, None) => return Err(step.missing("to")),
            (Some(_), Some(_)) => return Err(step.bad("by", EITHER)),
        };
        let at = step.at(field);
        if let Some((told, is_offset)) = told {
            let from = |was: f64| if is_offset { was } else { 0.0 };
            match record {
                Record::Replica(id) => {
                    let was = self.world.replicas[&id].frame;
                    let x = cm(from(was.x.get()) + told.x.get(), at)?;
                    let y = cm(from(was.y.get()) + told.y.get(), at)?;
                    // A height that was there stays when the new place says none.
                    let z = told.z.map(|z| cm(from(was.z.get()) + z.get(), at)).transpose()?;
                    let frame = Frame { x, y, z: z.unwrap_or(was.z), angle: was.angle };
                    self.replica_mut(id).frame = frame;
                }
                Record::Place(id) => {
                    let was = self.world.places[&id].at;
                    let x = cm(from(was.x) + told.x.get(), at)?;
                    let y = cm(from(was.y) + told.y.get(), at)?;
                    self.place_mut(id).at = Point::new(x.get(), y.get());
                }
                _ => unreachable!("it was looked for among these"),
            }
            let nodes = step.entry(field).map_or(&[][..], |e| e.node.elements()).to_vec();
            let list = if is_offset { Vec::new() } else { nodes };
            self.said.of(record).put(entry("at", at, Value::List(list)));
        }
        let Some(area) = area else { return Ok(()) };
        let area = self.area(area, step.at("area"))?;
        let is_there = match record {
            Record::Replica(id) => std::mem::replace(&mut self.replica_mut(id).area, area) == area,
            Record::Place(id) => std::mem::replace(&mut self.place_mut(id).area, area) == area,
            _ => unreachable!("it was looked for among these"),
        };
        if !is_there {
            self.said.rename(record, step.key_span());
        }
        Ok(())
    }

    pub(super) fn replica_mut(&mut self, id: ReplicaId) -> &mut crate::Replica {
        self.world.replicas.get_mut(&id).expect("what was found is in the world")
    }

    pub(super) fn place_mut(&mut self, id: PlaceId) -> &mut crate::Place {
        self.world.places.get_mut(&id).expect("what was found is in the world")
    }

    /// `carry = true`: what stands on the thing goes with it.
    fn note_carrier(&mut self, record: Record, step: &Step<'_>, carry: bool) -> Done {
        match record {
            _ if !carry => Ok(()),
            Record::Replica(id) => {
                self.carriers.insert(id);
                Ok(())
            }
            _ => Err(step.bad("carry", word!("carry-nothing-stands-on-a-place"))),
        }
    }

    pub(super) fn turn(
        &mut self,
        step: &Step<'_>,
        name: &str,
        told: (Option<Number>, Option<Number>),
        carry: bool,
    ) -> Done {
        let record = self.find(name, step.span(), &[Kind::Replica, Kind::Place])?;
        self.note_carrier(record, step, carry)?;
        let before = match record {
            Record::Replica(id) => self.world.replicas[&id].frame.angle,
            Record::Place(id) => self.world.places[&id].heading.unwrap_or(Deg::ZERO),
            _ => unreachable!("it was looked for among these"),
        };
        let (angle, field) = match told {
            (Some(to), None) => (to.get(), "to"),
            (None, Some(by)) => (before.get() + by.get(), "by"),
            (Some(_), Some(_)) => return Err(step.bad("by", EITHER)),
            (None, None) => return Err(step.missing("by")),
        };
        let at = step.at(field);
        let Ok(angle) = Deg::new(angle) else { return Err(too_large(angle, at)) };
        let told = match record {
            Record::Replica(id) => {
                self.replica_mut(id).frame.angle = angle;
                "angle"
            }
            Record::Place(id) => {
                self.place_mut(id).heading = Some(angle);
                "heading"
            }
            _ => unreachable!("it was looked for among these"),
        };
        let node = Node { span: at.clone(), value: Value::Nothing };
        let key_span = at.clone();
        self.said.of(record).put(Entry { key: told.to_owned(), key_span, node });
        Ok(())
    }
}

/// A tenth of a millimetre: what a turned frame adds behind it nobody measured.
fn hundredths(x: f64) -> f64 {
    (x * 100.0).round() / 100.0 + 0.0
}
