//! What is read when all steps are done: zones, what the robot is, and references to what a step may have made or taken away.

use super::super::verbs::RobotSaid;
use super::{Fault, Kind, MapError, Record, Span, Steps};
use crate::file::decode::shortened;
use crate::file::read::Raw;
use crate::units::{Cm, PlaceId, Point};

/// What waits for the end of the steps.
#[derive(Default)]
pub(super) struct Late {
    /// What is said of the robot.
    pub(super) robot: Vec<RobotSaid>,
    /// What is served from places that were brought.
    pub(super) serves: Vec<(PlaceId, String)>,
    /// What was taken out, by which name, and where that is told.
    removed: Vec<(Record, String, Span)>,
}

impl Late {
    pub(super) fn note_removal(&mut self, record: Record, name: &str, at: &Span) {
        self.removed.push((record, name.to_owned(), at.clone()));
    }
}

impl Steps<'_> {
    pub(super) fn finish(&mut self) {
        for (id, draft) in std::mem::take(&mut self.zones) {
            if self.broken.contains(&Record::Zone(id)) {
                continue;
            }
            let raw = Raw { id, key: draft.key, file: draft.file };
            let read = self.reading(|reader| reader.zone(raw));
            self.world.zones.extend(read.map(|zone| (id, zone)));
        }
        for (id, served) in std::mem::take(&mut self.late.serves) {
            let read = self.reading(|reader| reader.served(id, &served));
            if let Some(place) = self.world.places.get_mut(&id) {
                place.serves = read;
            }
        }
        for said in std::mem::take(&mut self.late.robot) {
            self.robot(&said);
        }
        for (record, name, at) in std::mem::take(&mut self.late.removed) {
            self.miss(record, &name, &at);
        }
        self.spell_out_domain();
    }

    /// What is said of the robot; the rest of it stays.
    fn robot(&mut self, said: &RobotSaid) {
        let robot = &mut self.world.robot;
        for (length, told) in [
            (&mut robot.radius, said.radius),
            (&mut robot.height, said.height),
            (&mut robot.step, said.step),
            (&mut robot.clearance, said.clearance),
        ] {
            *length = told.map_or(*length, |n| Cm::of(n.get()));
        }
        if let Some(corners) = &said.footprint {
            robot.footprint = corners.iter().map(|[x, y]| Point::new(x.get(), y.get())).collect();
        }
        robot.speed = said.speed.map_or(robot.speed, |n| n.get());
        robot.turn_rate = said.turn_rate.map_or(robot.turn_rate, |n| n.get());
        robot.opens = said.opens.unwrap_or(robot.opens);
        if let Some(start) = &said.start {
            self.world.robot.start = self.reading(|reader| reader.start(start));
        }
    }

    /// What speaks of a record that is gone is a fault of the step that took it, and speaks of nothing any more.
    fn miss(&mut self, record: Record, name: &str, at: &Span) {
        let is_missed = match record {
            Record::Door(id) => {
                let set = self.world.replicas.values();
                let set: Vec<_> =
                    set.filter(|r| r.door_states.contains_key(&id)).map(|r| r.id).collect();
                for replica in &set {
                    self.replica_mut(*replica).door_states.remove(&id);
                    self.broken.insert(Record::Replica(*replica));
                }
                !set.is_empty()
            }
            Record::Area(id) => {
                let mut any = false;
                for (_, stops) in &mut self.world.domain.lifts {
                    let before = stops.len();
                    stops.retain(|stop| stop.area != id);
                    any |= stops.len() < before;
                }
                if any {
                    self.broken.insert(Record::Domain);
                }
                any
            }
            Record::Replica(id) => {
                let places = self.world.places.values().filter(|p| p.serves == Some(id));
                let places: Vec<_> = places.map(|p| p.id).collect();
                for place in &places {
                    self.place_mut(*place).serves = None;
                    self.broken.insert(Record::Place(*place));
                }
                !places.is_empty()
            }
            Record::Place(id) if self.world.robot.start == Some(id) => {
                self.world.robot.start = None;
                self.broken.insert(Record::Robot);
                true
            }
            _ => false,
        };
        let kind = Kind::of(record).filter(|_| is_missed);
        self.faults.extend(kind.map(|kind| {
            let (what, nearest) = (kind.title().into(), self.nearest(name, &[kind]));
            let error = MapError::UnknownReference { what, name: shortened(name), nearest };
            let mut fault = Fault::new(error, Vec::new());
            fault.spans.push(at.clone().into());
            fault
        }));
    }
}
