//! Storeys, spaces and furniture of a model.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use nalgebra::Vector3;

use crate::exchange::{Kind, Level, Part, ReadError, Remark, Room, Survey, Thing, outline, shafts};
use crate::geometry::convex_hull;
use crate::map::{Permeability, Properties};
use crate::units::{Cm, Deg, Point};

use super::place::Place;
use super::shape::{Prism, Shapes};
use super::step::{FORMAT, Instance, Instances, Value};

const MOST_ROOMS: usize = 200_000;
const MOST_THINGS: usize = 200_000;
/// Sites are placed in a country's grid; beyond this, in cm, the plan is brought to the first storey's origin.
const FAR: f64 = 1e6;
/// Storeys in storeys, spaces in spaces: deeper is a ring.
const DEEPEST: usize = 16;
/// A thing flatter than this, in cm, is a mark on the floor.
const FLATTEST: f64 = 0.5;

pub(super) struct Reader<'a> {
    pub all: &'a Instances,
    pub shapes: Shapes<'a>,
    /// cm in one of the file's units of length.
    pub scale: f64,
    /// What is taken off every world coordinate, in cm.
    pub shift: Vector3<f64>,
    pub survey: Survey,
    /// The level of a storey.
    pub levels: HashMap<u32, usize>,
    /// Where an element is contained or of what it is a part.
    parents: HashMap<u32, u32>,
    types: HashMap<u32, u32>,
    /// `(level, room)` of a space.
    pub rooms: HashMap<u32, (usize, usize)>,
}

pub(super) fn survey(
    file: &str,
    all: &Instances,
    mut remarks: Vec<Remark>,
) -> Result<Survey, ReadError> {
    let scale = length_unit(all).unwrap_or_else(|| {
        let text = "единица длины не указана, принят метр".to_owned();
        remarks.push(Remark { source: String::new(), text });
        100.0
    });
    let mut reader = Reader {
        all,
        shapes: Shapes::new(all),
        scale,
        shift: Vector3::zeros(),
        survey: Survey { name: name(file, all), remarks, ..Survey::default() },
        levels: HashMap::new(),
        parents: parents(all),
        types: types(all),
        rooms: HashMap::new(),
    };
    reader.storeys();
    reader.spaces()?;
    reader.doors();
    reader.furniture();
    shafts::join(&mut reader.survey);
    reader.finish()
}

/// cm in the project's unit of length.
fn length_unit(all: &Instances) -> Option<f64> {
    let project = all.all("IFCPROJECT").next()?.1;
    let units = all.get(project.at(8).reference()?)?;
    let unit = units.at(0).list().iter().filter_map(|u| all.get(u.reference()?));
    let unit =
        unit.filter(|u| u.at(1).word() == Some("LENGTHUNIT")).find_map(|u| cm_in(all, u, 0))?;
    (1e-4..1e6).contains(&unit).then_some(unit)
}

fn cm_in(all: &Instances, unit: &Instance, depth: usize) -> Option<f64> {
    match unit.kind {
        "IFCSIUNIT" => Some(match unit.at(2).word() {
            None => 100.0,
            Some("MILLI") => 0.1,
            Some("CENTI") => 1.0,
            Some("DECI") => 10.0,
            Some("MICRO") => 1e-4,
            Some("KILO") => 1e5,
            Some(_) => return None,
        }),
        "IFCCONVERSIONBASEDUNIT" if depth < DEEPEST => {
            let measure = all.get(unit.at(3).reference()?)?;
            let base = all.get(measure.at(1).reference()?)?;
            Some(measure.at(0).number()? * cm_in(all, base, depth + 1)?)
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

/// Part → whole: aggregation, containment.
fn parents(all: &Instances) -> HashMap<u32, u32> {
    let mut parents = HashMap::new();
    for (kind, whole, parts) in
        [("IFCRELAGGREGATES", 4, 5), ("IFCRELCONTAINEDINSPATIALSTRUCTURE", 5, 4)]
    {
        for (_, relation) in all.all(kind) {
            let Some(whole) = relation.at(whole).reference() else { continue };
            let parts = relation.at(parts).list().iter().filter_map(Value::reference);
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

impl Reader<'_> {
    pub(super) fn remark(&mut self, source: &str, text: impl Into<String>) {
        self.survey.remarks.push(Remark { source: source.to_owned(), text: text.into() });
    }

    /// The type record of an element.
    pub(super) fn type_of(&self, id: u32) -> Option<&Instance> {
        self.all.get(*self.types.get(&id)?)
    }

    pub(super) fn place_of(&self, record: &Instance) -> Place {
        Place::of_object(self.all, record.at(5).reference())
    }

    /// A point of the file's world on the plan, in cm.
    pub(super) fn plan(&self, p: Point) -> Point {
        Point::new(p.x * self.scale - self.shift.x, p.y * self.scale - self.shift.y)
    }

    pub(super) fn height(&self, z: f64) -> f64 {
        z * self.scale - self.shift.z
    }

    fn storeys(&mut self) {
        let mut storeys: Vec<(u32, f64, &Instance)> = self
            .all
            .all("IFCBUILDINGSTOREY")
            .map(|(id, storey)| {
                let placed = self.place_of(storey).origin.z;
                // Some exporters leave the placement at 0 and tell the elevation alone.
                let told = storey.at(9).number().filter(|_| placed.abs() * self.scale < 1.0);
                (id, told.unwrap_or(placed) * self.scale, storey)
            })
            .collect();
        if let Some((_, z, first)) = storeys.first() {
            let origin = self.place_of(first).origin.coords * self.scale;
            if origin.xy().amax() > FAR || z.abs() > FAR {
                self.shift = origin.map(f64::floor);
                let text = format!(
                    "план сдвинут к началу координат: {}, {}, {} см",
                    self.shift.x, self.shift.y, self.shift.z
                );
                self.survey.frame.clone_from(&text);
                self.remark("", text);
            }
        }
        storeys.sort_by(|a, b| a.1.total_cmp(&b.1));
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
                elevation: Cm::new(z - self.shift.z).unwrap_or(Cm::ZERO),
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
            self.remark("", "этажей (IfcBuildingStorey) нет, принят один");
            let name = "Этаж 1".to_owned();
            self.survey.levels.push(Level { source: "0".to_owned(), name, ..Level::default() });
        }
        // Half a metre below a floor still belongs to it.
        let below = self.survey.levels.iter().rposition(|l| l.elevation.get() <= bottom + 50.0);
        below.unwrap_or(0)
    }

    fn spaces(&mut self) -> Result<(), ReadError> {
        let spaces: Vec<(u32, &Instance)> = self.all.all("IFCSPACE").collect();
        if spaces.len() > MOST_ROOMS {
            return Err(ReadError::TooMany {
                format: FORMAT,
                what: "помещений",
                limit: MOST_ROOMS,
            });
        }
        let wholes: HashSet<u32> =
            spaces.iter().filter_map(|(id, _)| self.parents.get(id)).copied().collect();
        for (id, space) in spaces {
            let source = source(space, id);
            if wholes.contains(&id) {
                self.remark(&source, "помещение состоит из других, взяты они");
                continue;
            }
            let place = self.place_of(space);
            let prisms = self.shapes.of_product(space.at(6), &place);
            let largest = prisms.iter().max_by(|a, b| a.area().total_cmp(&b.area()));
            let Some(prism) = largest else {
                self.remark(&source, "у помещения нет контура, пропущено");
                continue;
            };
            if prisms.iter().any(|p| p != prism && p.area() > 0.1 * prism.area()) {
                self.remark(&source, "помещение из нескольких тел, взято наибольшее");
            }
            self.space(id, space, prism);
        }
        Ok(())
    }

    fn space(&mut self, id: u32, space: &Instance, prism: &Prism) {
        let source = source(space, id);
        let ring = |ring: &[Point]| {
            let ring = outline::ring(ring.iter().map(|p| self.plan(*p)))?;
            (ring.len() <= outline::MOST_CORNERS).then_some(ring)
        };
        let Some(outline) = ring(&prism.outline) else {
            return self.remark(&source, "контур вырожден или слишком подробен, пропущен");
        };
        let holes = prism.holes.iter().filter_map(|h| ring(h)).collect();
        let level = self.level_of(id, self.height(prism.bottom));
        let (number, long) = (space.at(2).text(), space.at(7).text());
        let name = match (long, number) {
            (Some(long), Some(number)) if long != number => format!("{long} {number}"),
            (long, number) => long.or(number).unwrap_or_default().to_owned(),
        };
        let kind = long.or(space.at(4).text()).or(number).unwrap_or_default().to_owned();
        let height = (prism.top - prism.bottom) * self.scale;
        let mut properties = Properties::new();
        for (key, value) in [("ifc:Name", number), ("ifc:ObjectType", space.at(4).text())] {
            properties.extend(value.map(|v| (key.to_owned(), v.to_owned())));
        }
        let rooms = &mut self.survey.levels[level].rooms;
        self.rooms.insert(id, (level, rooms.len()));
        rooms.push(Room {
            source,
            name,
            kind,
            outline,
            holes,
            height: Cm::new(height).ok().filter(|h| h.get() >= 50.0),
            properties,
        });
    }

    fn furniture(&mut self) {
        let mut known = HashMap::<String, usize>::new();
        let things = ["IFCFURNISHINGELEMENT", "IFCFURNITURE", "IFCSYSTEMFURNITUREELEMENT"]
            .iter()
            .flat_map(|kind| self.all.all(kind));
        let things: Vec<(u32, &Instance)> = things.take(MOST_THINGS).collect();
        for (id, thing) in things {
            let place = self.place_of(thing);
            let prisms = self.shapes.of_product(thing.at(6), &place);
            if self.thing(id, thing, &place, &prisms, &mut known).is_none() {
                self.remark(&source(thing, id), "у вещи нет тела, пропущена");
            }
        }
    }

    fn thing(
        &mut self,
        id: u32,
        thing: &Instance,
        place: &Place,
        prisms: &[Prism],
        known: &mut HashMap<String, usize>,
    ) -> Option<()> {
        let bottom = prisms.iter().map(|p| p.bottom).min_by(f64::total_cmp)?;
        let angle = Deg::from_radians(place.x.y.atan2(place.x.x));
        let at = self.plan(Point::new(place.origin.x, place.origin.y));
        let frame = crate::units::Frame {
            x: Cm::new(at.x).ok()?,
            y: Cm::new(at.y).ok()?,
            z: Cm::ZERO,
            angle,
        };
        let local = |p: &Point| {
            let p = frame.invert(self.plan(*p));
            Point::from(p.coords.map(|x| (x * 100.0).round() / 100.0))
        };
        let hundredth = |x: f64| (x * 100.0).round() / 100.0;
        let mut parts: Vec<Part> = prisms
            .iter()
            .filter_map(|prism| {
                let outline = outline::ring(prism.outline.iter().map(local))?;
                let height = hundredth((prism.top - prism.bottom) * self.scale);
                (outline.len() <= outline::MOST_CORNERS && height > FLATTEST).then(|| Part {
                    word: String::new(),
                    outline,
                    bottom: Cm::of(hundredth((prism.bottom - bottom) * self.scale)),
                    height: Cm::of(height),
                    permeability: Permeability::Impermeable,
                })
            })
            .collect();
        if parts.len() > 1 {
            // Bodies of one thing run into one another; the solid parts of an Object may not. Its hull stands for it.
            let corners: Vec<Point> =
                parts.iter().flat_map(|p| p.outline.iter().copied()).collect();
            let top = parts.iter().map(|p| p.bottom.get() + p.height.get()).fold(0.0, f64::max);
            let outline = convex_hull(corners);
            parts.truncate(1);
            parts[0] = Part { outline, bottom: Cm::ZERO, height: Cm::of(top), ..parts[0].clone() };
        }
        parts.first()?;
        let word = self.word(id, thing);
        let key = format!("{word} {parts:?}");
        let kinds = &mut self.survey.kinds;
        let kind = *known.entry(key).or_insert_with(|| {
            let source = format!("{word} {}", kinds.len() + 1);
            kinds.push(Kind { source, word, parts, ..Kind::default() });
            kinds.len() - 1
        });
        let z = self.height(bottom);
        let level = self.level_of(id, z);
        // Contained in a space, it is in that room.
        let room = self.parents.get(&id).and_then(|s| self.rooms.get(s)).filter(|r| r.0 == level);
        let raised = z - self.survey.levels[level].elevation.get();
        let room = room.map(|r| r.1);
        self.survey.levels[level].things.push(Thing {
            source: source(thing, id),
            name: String::new(),
            kind,
            at,
            // What a modeller set a hair into the floor stands on it.
            z: Cm::new(raised).ok().filter(|z| z.get().abs() > 1.0).unwrap_or(Cm::ZERO),
            angle,
            room,
            move_prob: None,
            properties: Properties::new(),
        });
        Some(())
    }

    /// What a thing is: `M_Desk:1525 x 762mm:123456` is a Desk.
    fn word(&self, id: u32, thing: &Instance) -> String {
        let of_type = self.type_of(id).and_then(|t| t.at(2).text().or(t.at(8).text()));
        let predefined = thing.at(8).word().filter(|w| !["NOTDEFINED", "USERDEFINED"].contains(w));
        let told = predefined.or(of_type).or(thing.at(4).text()).or(thing.at(2).text());
        let family = told.unwrap_or("furniture").split(':').next().unwrap_or_default().trim();
        let word = family.strip_prefix("M_").unwrap_or(family);
        word.chars().take(100).collect()
    }

    fn finish(mut self) -> Result<Survey, ReadError> {
        if self.shapes.is_exhausted() {
            self.remark("", "тел слишком много, часть пропущена");
        }
        if self.survey.levels.iter().all(|l| l.rooms.is_empty()) {
            let what = if self.all.all("IFCSPACE").next().is_none() {
                "в модели нет помещений (IfcSpace)".to_owned()
            } else {
                "ни у одного помещения (IfcSpace) нет контура".to_owned()
            };
            return Err(ReadError::NoBuilding { format: FORMAT, what });
        }
        // A storey without spaces, the foundation for one, is no floor to drive on.
        let is_empty = |l: &Level| l.rooms.is_empty();
        let empty = self.survey.levels.iter().filter(|l| is_empty(l)).map(|l| l.name.clone());
        let empty: Vec<String> = empty.collect();
        if !empty.is_empty() {
            self.remark("", format!("этажи без помещений пропущены: {}", empty.join(", ")));
            let mut place = Vec::new();
            let mut next = 0;
            for level in &self.survey.levels {
                place.push(next);
                next += usize::from(!is_empty(level));
            }
            for stop in self.survey.lifts.iter_mut().flat_map(|l| &mut l.stops) {
                stop.0 = place[stop.0];
            }
            self.survey.levels.retain(|l| !is_empty(l));
        }
        Ok(self.survey)
    }
}

/// The model's own id of a record: its GlobalId, else its number in the file.
pub(super) fn source(record: &Instance, id: u32) -> String {
    record.at(0).text().map_or_else(|| format!("#{id}"), str::to_owned)
}
