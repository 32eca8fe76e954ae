//! The reader as a whole: units, storeys, and what is told of the elements that do not arrive.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use nalgebra::Vector3;

use crate::units::{Bilingual, Cm, InOrder as _, Lengths, Point, said, word};
use crate::{Count, Level, ReadError, Remark, Survey, Told, Treatment, What, outline, shafts};

use super::classes::{self, Becomes};
use super::place::Place;
use super::shape::Shapes;
use super::step::{FORMAT, Instance, Instances, Value};

/// Sites are placed in a country's grid; beyond this, in cm, the plan is brought to the first storey's origin.
const FAR: f64 = 1e6;
/// Storeys in storeys, spaces in spaces: deeper is a ring.
const DEEPEST: usize = 16;
/// Rooms that are looked at for what is beside openings, in one file.
const MOST_LOOKS: usize = 400_000_000;

pub(super) struct Reader<'a> {
    pub all: &'a Instances,
    pub shapes: Shapes<'a>,
    /// The file's world on the plan, in cm.
    world: Place,
    pub survey: Survey,
    /// The level of a storey.
    pub levels: HashMap<u32, usize>,
    /// Of what an element is a part.
    pub wholes: HashMap<u32, u32>,
    /// Where an element is contained, else of what it is a part.
    pub parents: HashMap<u32, u32>,
    types: HashMap<u32, u32>,
    /// `(level, room)` of a space.
    pub rooms: HashMap<u32, (usize, usize)>,
    /// The boxes of rooms that were asked for, by level.
    boxes: Vec<Vec<(Point, Point)>>,
    looks: usize,
    /// Flights within one storey: things in the way.
    pub steps: Vec<u32>,
}

pub(super) fn survey(
    file: &str,
    all: &Instances,
    mut remarks: Vec<Remark>,
) -> Result<Survey, ReadError> {
    let unit = length_unit(all).unwrap_or_else(|| {
        let text = word!("the-unit-of-length-is").into();
        remarks.push(Remark { source: String::new(), text });
        100.0
    });
    let wholes = related(all, &[("IFCRELAGGREGATES", 4, 5), ("IFCRELNESTS", 4, 5)]);
    let mut parents = wholes.clone();
    parents.extend(related(all, &[("IFCRELCONTAINEDINSPATIALSTRUCTURE", 5, 4)]));
    let mut reader = Reader {
        all,
        shapes: Shapes::new(all, angle_unit(all)),
        world: Place::of_world(unit, Vector3::zeros()),
        survey: Survey { name: name(file, all), remarks, ..Survey::default() },
        levels: HashMap::new(),
        wholes,
        parents,
        types: types(all),
        rooms: HashMap::new(),
        boxes: Vec::new(),
        looks: 0,
        steps: Vec::new(),
    };
    reader.storeys(unit);
    reader.spaces()?;
    reader.doors();
    reader.passages();
    reader.stairs();
    reader.things();
    shafts::join(&mut reader.survey);
    reader.finish()
}

/// cm in the project's unit of length.
fn length_unit(all: &Instances) -> Option<f64> {
    let unit = unit(all, "LENGTHUNIT")?;
    let unit = in_si(all, unit, 0)? * 100.0;
    (1e-4..1e6).contains(&unit).then_some(unit)
}

/// Radians in the project's unit of angle.
fn angle_unit(all: &Instances) -> f64 {
    let told = unit(all, "PLANEANGLEUNIT").and_then(|unit| in_si(all, unit, 0));
    told.filter(|u| (1e-6..10.0).contains(u)).unwrap_or(1.0)
}

fn unit<'a>(all: &'a Instances, kind: &str) -> Option<&'a Instance> {
    let project = all.all("IFCPROJECT").next()?.1;
    let units = all.get(project.at(8).reference()?)?;
    let mut units = units.at(0).list().iter().filter_map(|u| all.get(u.reference()?));
    units.find(|u| u.at(1).word() == Some(kind))
}

/// Metres or radians in a unit.
fn in_si(all: &Instances, unit: &Instance, depth: usize) -> Option<f64> {
    match unit.kind {
        "IFCSIUNIT" => Some(match unit.at(2).word() {
            None => 1.0,
            Some("MILLI") => 1e-3,
            Some("CENTI") => 1e-2,
            Some("DECI") => 0.1,
            Some("MICRO") => 1e-6,
            Some("KILO") => 1e3,
            Some(_) => return None,
        }),
        kind if kind.starts_with("IFCCONVERSIONBASEDUNIT") && depth < DEEPEST => {
            let measure = all.get(unit.at(3).reference()?)?;
            let base = all.get(measure.at(1).reference()?)?;
            Some(measure.at(0).number()? * in_si(all, base, depth + 1)?)
        }
        _ => None,
    }
}

fn name(file: &str, all: &Instances) -> String {
    let of = |kind: &str, fields: &[usize]| {
        let record = all.all(kind).next()?.1;
        fields.iter().find_map(|i| record.at(*i).text()).map(str::to_owned)
    };
    let stem = || Path::new(file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    of("IFCBUILDING", &[7, 2]).or_else(|| of("IFCPROJECT", &[5, 2])).unwrap_or_else(stem)
}

/// Part → whole, by relations of these kinds with the whole and the parts at these places.
fn related(all: &Instances, kinds: &[(&str, usize, usize)]) -> HashMap<u32, u32> {
    let mut parents = HashMap::new();
    for (kind, whole, parts) in kinds {
        for (_, relation) in all.all(kind) {
            let Some(whole) = relation.at(*whole).reference() else { continue };
            let parts = relation.at(*parts).list().iter().filter_map(Value::reference);
            parents.extend(parts.map(|part| (part, whole)));
        }
    }
    parents
}

fn types(all: &Instances) -> HashMap<u32, u32> {
    let relations = all
        .all("IFCRELDEFINESBYTYPE")
        .filter_map(|(_, r)| Some((r.at(4).list(), r.at(5).reference()?)));
    relations
        .flat_map(|(parts, of)| parts.iter().filter_map(Value::reference).map(move |p| (p, of)))
        .collect()
}

impl<'a> Reader<'a> {
    pub(super) fn remark(&mut self, source: &str, text: impl Into<Bilingual>) {
        self.survey.remarks.push(Remark { source: source.to_owned(), text: text.into() });
    }

    /// Tells of a record: `found` of them are in the file and in no list of the survey, `taken` of those arrived all
    /// the same.
    pub(super) fn tell(
        &mut self,
        (treatment, what): (Treatment, What),
        (found, taken): (usize, usize),
        source: &str,
        text: impl Into<Bilingual>,
    ) {
        let (source, text) = (source.to_owned(), text.into());
        self.survey.told.push(Told {
            treatment,
            what,
            source,
            text,
            count: Count { found, taken },
        });
    }

    /// A record that does not arrive.
    pub(super) fn lose(&mut self, what: What, source: &str, text: impl Into<Bilingual>) {
        self.tell((Treatment::Skipped, what), (1, 0), source, text);
    }

    /// Elements that become what is asked for, by class, in the order of the file.
    pub(super) fn elements(&self, wanted: Becomes) -> Vec<(u32, &'a Instance)> {
        let all = self.all;
        classes::that(wanted).flat_map(|kind| all.all(kind)).collect()
    }

    /// The type record of an element.
    pub(super) fn type_of(&self, id: u32) -> Option<&'a Instance> {
        self.all.get(*self.types.get(&id)?)
    }

    /// Where a product stands on the plan, in cm.
    pub(super) fn place_of(&self, record: &Instance) -> Place {
        self.world.compose(&Place::of_object(self.all, record.at(5).reference()))
    }

    fn storeys(&mut self, unit: f64) {
        let mut storeys: Vec<(u32, f64, &Instance)> = self
            .all
            .all("IFCBUILDINGSTOREY")
            .map(|(id, storey)| {
                let placed = self.place_of(storey).origin.z;
                // Some exporters leave the placement at 0 and tell the elevation alone.
                let told = storey.at(9).number().filter(|_| placed.abs() < 1.0).map(|z| z * unit);
                (id, told.unwrap_or(placed), storey)
            })
            .collect();
        let mut shift = Vector3::zeros();
        if let Some((_, z, first)) = storeys.first() {
            let origin = self.place_of(first).origin.coords;
            if origin.xy().amax() > FAR || z.abs() > FAR {
                shift = origin.map(f64::floor);
                let lengths = Lengths::said();
                let by = [shift.x, shift.y, shift.z].map(|by| lengths.short(by, 0)).join(", ");
                let text = said!("plan-moved", by);
                // What stands in the map is the same whoever reads it in.
                let [x, y, z] = [shift.x, shift.y, shift.z];
                self.survey.frame = format!("план сдвинут к началу координат: {x}, {y}, {z} см");
                self.remark("", text);
            }
        }
        self.world = Place::of_world(unit, shift);
        storeys.order_by(|a, b| a.1.total_cmp(&b.1));
        let buildings: HashSet<_> = storeys.iter().map(|s| self.parents.get(&s.0)).collect();
        for (no, (id, z, storey)) in storeys.into_iter().enumerate() {
            let own = storey.at(2).text().or(storey.at(7).text());
            let mut name = own.map_or_else(|| format!("Этаж {}", no + 1), str::to_owned);
            let building = self.parents.get(&id).and_then(|b| self.all.get(*b));
            if buildings.len() > 1
                && let Some(building) = building.and_then(|b| b.at(2).text())
            {
                name = format!("{building}, {name}");
            }
            self.levels.insert(id, self.survey.levels.len());
            self.survey.levels.push(Level {
                source: source(storey, id),
                name,
                elevation: Cm::new(z - shift.z).unwrap_or(Cm::ZERO),
                ..Level::default()
            });
        }
    }

    /// The storey in which an element stands, through whatever it is a part of; else the one at its height.
    pub(super) fn level_of(&mut self, id: u32, bottom: f64) -> usize {
        let mut whole = Some(id);
        for _ in 0..DEEPEST {
            if let Some(level) = whole.and_then(|id| self.levels.get(&id)) {
                return *level;
            }
            whole = whole.and_then(|id| self.parents.get(&id).copied());
        }
        if self.survey.levels.is_empty() {
            self.remark("", word!("there-are-no-storeys-ifcbuildingstorey"));
            let name = "Этаж 1".to_owned();
            self.survey.levels.push(Level { source: "0".to_owned(), name, ..Level::default() });
        }
        self.level_at(bottom)
    }

    /// The storey whose floor is at this height or below; half a metre below a floor still belongs to it.
    pub(super) fn level_at(&self, z: f64) -> usize {
        let levels = &self.survey.levels;
        levels.iter().rposition(|l| l.elevation.get() <= z + 50.0).unwrap_or(0)
    }

    /// The rooms of a level whose boxes meet a box, in their order.
    pub(super) fn rooms_near(&mut self, level: usize, (low, high): (Point, Point)) -> Vec<usize> {
        let rooms = &self.survey.levels[level].rooms;
        self.boxes.resize(self.survey.levels.len(), Vec::new());
        let boxes = &mut self.boxes[level];
        for room in rooms.iter().skip(boxes.len()) {
            boxes.push(outline::bounds(&room.outline));
        }
        self.looks = self.looks.saturating_add(rooms.len());
        if self.looks > MOST_LOOKS {
            return Vec::new();
        }
        let meets = |(from, to): &(Point, Point)| {
            from.x <= high.x && to.x >= low.x && from.y <= high.y && to.y >= low.y
        };
        (0..rooms.len()).filter(|i| meets(&boxes[*i])).collect()
    }

    /// The rooms of a level whose floor has this place.
    pub(super) fn rooms_at(&mut self, level: usize, p: Point) -> Vec<usize> {
        let near = self.rooms_near(level, (p, p));
        let rooms = &self.survey.levels[level].rooms;
        self.looks += near.iter().map(|r| rooms[*r].outline.len()).sum::<usize>();
        let holds = |room: &usize| {
            let room = &rooms[*room];
            outline::contains(&room.outline, p)
                && !room.holes.iter().any(|h| outline::contains(h, p))
        };
        near.into_iter().filter(holds).collect()
    }

    fn finish(mut self) -> Result<Survey, ReadError> {
        if self.shapes.is_exhausted() {
            self.remark("", word!("there-are-too-many-bodies"));
        }
        if self.looks > MOST_LOOKS {
            self.remark("", word!("there-are-too-many-openings"));
        }
        if self.shapes.effort.hulls > 0 {
            let text = said!("outlines-with-too-much-detail", hulls = self.shapes.effort.hulls);
            self.remark("", text);
        }
        if self.survey.levels.iter().all(|l| l.rooms.is_empty()) {
            let what = if self.all.all("IFCSPACE").next().is_none() {
                said!("the-model-has-no-rooms")
            } else {
                word!("no-room-ifcspace-has-an").into()
            };
            return Err(ReadError::NoBuilding { format: FORMAT, what });
        }
        self.count_others();
        self.drop_empty();
        Ok(self.survey)
    }

    /// Elements of which nothing is made, by class.
    fn count_others(&mut self) {
        let all = self.all;
        for (kind, becomes) in classes::ELEMENTS {
            let Becomes::Nothing(why) = becomes else { continue };
            let count = all.count(kind);
            if count > 0 {
                let text = said!("counted", count, why);
                self.tell((Treatment::Noted, What::Record), (count, 0), kind, text);
            }
        }
    }

    /// A storey without spaces, the foundation for one, is no floor to drive on; what stands on it is in no room.
    fn drop_empty(&mut self) {
        let mut place = Vec::new();
        let mut kept = Vec::new();
        for level in std::mem::take(&mut self.survey.levels) {
            place.push(kept.len());
            if !level.rooms.is_empty() {
                kept.push(level);
                continue;
            }
            let text = said!("the-storey-without-rooms-is", level = level.name);
            self.lose(What::Level, &level.source, text);
            let text = word!("on-a-storey-without-rooms");
            for thing in &level.things {
                self.lose(What::Thing, &thing.source, text);
            }
            for opening in &level.openings {
                let what = match opening.what {
                    crate::OpeningKind::Door { .. } => What::Door,
                    crate::OpeningKind::Window => What::Window,
                    crate::OpeningKind::Passage => What::Passage,
                };
                self.lose(what, &opening.source, text);
            }
        }
        for stop in self.survey.lifts.iter_mut().flat_map(|l| &mut l.stops) {
            stop.0 = place[stop.0];
        }
        self.survey.levels = kept;
    }
}

/// The model's own id of a record: its GlobalId, else its number in the file.
pub(super) fn source(record: &Instance, id: u32) -> String {
    record.at(0).text().map_or_else(|| format!("#{id}"), str::to_owned)
}
