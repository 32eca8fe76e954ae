//! Things as replicas in the Area whose floor they stand on, kinds as Objects, and named places.

use std::collections::BTreeMap;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::map::plane::{bounds, doubled_area, edges, meeting};
use crate::map::{BaseVector, Forms, Mark, Object, Place, Properties, Replica, TypeKind};
use crate::report::{What, Why};
use crate::synonyms::{Meaning, Vocabulary};
use crate::units::{Frame, ObjectId, PlaceId, Point, ReplicaId, Vector, capitalized, said};
use crate::{Kind, Level, Spot, Thing};

use super::build::{Maker, SOURCE, Storey};
use super::fitted;
use super::index::Index;
use super::kinds::{self, Built};
use super::names::{self, Named};
use super::ring::{Region, Ring, overlay};

/// The word of the formats for a place where robots charge.
const CHARGER: &str = "charger";
/// How far a thing may be moved into its room, cm.
const NUDGE: f64 = 60.0;
/// Of a thing's base at least so much must stand in its room; the map's checks ask for half.
const LEAST_SHARE: f64 = 0.55;

/// A kind that is an Object now.
pub(super) struct Made {
    object: ObjectId,
    built: Built,
    meaning: Option<Meaning>,
}

impl Made {
    /// The thing's frame on the level.
    fn frame(&self, thing: &Thing) -> Frame {
        let turn = Frame::new(0.0, 0.0, 0.0, thing.angle);
        let at = thing.at + turn.turn(self.built.origin.coords);
        Frame::new(at.x, at.y, thing.z.get() + self.built.bottom, thing.angle)
    }

    /// The bases of its parts on the level.
    fn bases(&self, frame: &Frame) -> Vec<Ring> {
        let place = |ring: &Ring| ring.iter().map(|&p| frame.apply(p)).collect();
        self.built.bodies.iter().map(|body| place(&body.corners)).collect()
    }
}

impl Maker<'_> {
    /// Every kind of which there is a thing.
    pub(super) fn objects(&mut self) -> Vec<Option<Made>> {
        let survey = self.survey;
        let mut is_used = vec![false; survey.kinds.len()];
        for thing in survey.levels.iter().flat_map(|l| &l.things) {
            if let Some(used) = is_used.get_mut(thing.kind) {
                *used = true;
            }
        }
        let mut made = Vec::with_capacity(survey.kinds.len());
        for (n, (kind, is_used)) in survey.kinds.iter().zip(is_used).enumerate() {
            made.push(is_used.then(|| self.object(n, kind)));
        }
        made
    }

    fn object(&mut self, n: usize, kind: &Kind) -> Made {
        let found = self
            .synonyms
            .find(Vocabulary::Object, &kind.word)
            .or_else(|| self.synonyms.find(Vocabulary::Object, &kind.source));
        let (meaning, mut size) = (found.map(|f| f.meaning.clone()), found.and_then(|f| f.size));
        if meaning.is_none() {
            let word = kind.word.clone();
            self.report.noted(What::Kind, &kind.source, Why::UnknownWord { word });
        }
        if kind.parts.is_empty() && size.is_none() {
            let kind_name = kind.word.clone();
            self.report.mended(What::Kind, &kind.source, Why::UnknownSize { kind: kind_name });
        }
        if let Some([width, depth, _]) = size.as_mut().filter(|_| kind.parts.is_empty()) {
            let clearance = self.world.robot.passing_width() / 2.0;
            let share = fitted::share_of(self.survey, n, [*width, *depth], clearance);
            if share < 1.0 {
                (*width, *depth) = (*width * share, *depth * share);
                let text = said!("usual-size-made-smaller", share = (share * 100.0).floor());
                self.report.noted(What::Kind, &kind.source, Why::Other { text });
            }
        }
        let built = kinds::build(kind, size, self.report);
        let id = ObjectId(self.world.objects.len() as u32 + 1);
        let words = names::words(&kind.word);
        let (name, name_en) = match &meaning {
            Some(m) => {
                let words = words.to_lowercase();
                (m.name.clone(), own_words(&words, m).unwrap_or(&m.name_en).to_owned())
            }
            None if words.is_empty() => ("Предмет".to_owned(), "thing".to_owned()),
            None => (words.clone(), words),
        };
        let orthoframes: Vec<_> =
            built.bodies.iter().enumerate().map(|(i, body)| self.part(&name, i, body)).collect();
        let (items, links) = kinds::items(&built, &orthoframes);
        let mut properties = kind.properties.clone();
        for (property, value) in self.synonyms.looks(&kind.word) {
            properties.entry(property.to_owned()).or_insert(value);
        }
        properties.insert(SOURCE.to_owned(), kind.source.clone());
        if built.is_usual {
            properties.insert(Mark::UsualSize.names()[0].to_owned(), "да".to_owned());
        }
        let object_type = meaning.as_ref().map(|m| self.types.of(TypeKind::Object, m));
        let key = self.names.key("object", &kind.source);
        self.world.objects.insert(
            id,
            Object {
                id,
                key,
                name,
                name_en,
                description: String::new(),
                object_type,
                items,
                links,
                front: built.front.clone(),
                back: built.back.clone(),
                doors: Vec::new(),
                properties,
            },
        );
        Made { object: id, built, meaning }
    }

    fn part(&mut self, of: &str, i: usize, body: &kinds::Body) -> crate::units::OrFrId {
        let meaning = self.synonyms.find(Vocabulary::Part, &body.word).map(|f| f.meaning.clone());
        let frame_type = meaning.map(|m| self.types.of(TypeKind::Orthoframe, &m));
        let base = edges(&body.corners)
            .enumerate()
            .map(|(s, (start, end))| BaseVector {
                id: names::letters(s),
                start,
                end,
                side_type: None,
                permeability: body.permeability,
                names: Vec::new(),
                properties: Properties::new(),
            })
            .collect();
        let name = format!("{of} {}", names::letters(i));
        self.insert_orthoframe(&name, base, body.height, frame_type, body.permeability)
    }

    pub(super) fn things(&mut self, level: &Level, storey: &Storey, kinds: &[Option<Made>]) {
        self.report.found(What::Thing, level.things.len());
        let index = Index::of(&storey.floors);
        for thing in &level.things {
            let Some(Some(made)) = kinds.get(thing.kind) else { continue };
            match self.seat_of(level, storey, &index, made, thing) {
                Some((room, frame)) => {
                    self.replica(storey, made, thing, room, frame);
                    self.report.taken(What::Thing, 1);
                }
                None => self.report.skipped(What::Thing, &thing.source, Why::Outside),
            }
        }
    }

    /// The room in which a thing stands, and where.
    fn seat_of(
        &mut self,
        level: &Level,
        storey: &Storey,
        index: &Index,
        made: &Made,
        thing: &Thing,
    ) -> Option<(usize, Frame)> {
        let frame = made.frame(thing);
        let bases = made.bases(&frame);
        let said = thing.room.filter(|&r| storey.floors.get(r).is_some_and(Option::is_some));
        let share = |room: usize, bases: &[Ring]| {
            storey.floors[room].as_ref().map_or(0.0, |floor| share_within(bases, floor))
        };
        if let Some(room) = said
            && share(room, &bases) >= LEAST_SHARE
        {
            return Some((room, frame));
        }
        let area = bounds(bases.iter().flatten().copied());
        let near = index.near_box(area);
        let best = near
            .iter()
            .map(|&room| (share(room, &bases), room))
            .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        if let Some((at_least, room)) = best
            && at_least >= LEAST_SHARE
        {
            // Another piece of the room that is said is that room.
            if let Some(said) = said.filter(|&r| level.rooms[r].source != level.rooms[room].source)
            {
                let room = level.rooms[said].source.clone();
                self.report.mended(What::Thing, &thing.source, Why::ThingElsewhere { room });
            }
            return Some((room, frame));
        }
        // Sunk into a wall, or astride of two rooms: it is moved into the one said, or that has most of it.
        let centre = nalgebra::center(&area.0, &area.1);
        let nearest = || {
            let away = |r: usize| {
                storey.floors[r].as_ref().map_or(f64::INFINITY, |f| f.border_distance(centre))
            };
            index
                .near(centre, NUDGE)
                .into_iter()
                .map(|r| (away(r), r))
                .filter(|(d, _)| *d <= NUDGE)
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .map(|(_, r)| r)
        };
        let room = said
            .or_else(|| best.filter(|(share, _)| *share > 0.0).map(|(_, room)| room))
            .or_else(nearest)?;
        let floor = storey.floors[room].as_ref()?;
        let shift = inward(floor, centre, area)?;
        let moved = Frame {
            ..Frame::new(
                frame.x.get() + shift.x,
                frame.y.get() + shift.y,
                frame.z.get(),
                frame.angle,
            )
        };
        if share(room, &made.bases(&moved)) < LEAST_SHARE {
            return None;
        }
        let text = said!("moved-out-of-the-wall", by = shift.norm());
        self.report.mended(What::Thing, &thing.source, Why::Other { text });
        Some((room, moved))
    }

    fn replica(&mut self, storey: &Storey, made: &Made, thing: &Thing, room: usize, frame: Frame) {
        let Some(area) = storey.areas[room] else { return };
        let id = ReplicaId(self.world.replicas.len() as u32 + 1);
        let named = self.thing_name(made, thing);
        let origin = storey.origins[room];
        let mut properties = thing.properties.clone();
        properties.insert(SOURCE.to_owned(), thing.source.clone());
        self.world.replicas.insert(
            id,
            Replica {
                id,
                area,
                object: made.object,
                name: named.name,
                name_en: named.name_en,
                frame: Frame::new(
                    frame.x.get() - origin.x,
                    frame.y.get() - origin.y,
                    frame.z.get(),
                    frame.angle,
                ),
                move_prob: thing.move_prob.unwrap_or_else(|| usual_move_prob(made)).min(100),
                properties,
                door_states: BTreeMap::new(),
                forms: Forms::new(),
            },
        );
    }

    fn thing_name(&mut self, made: &Made, thing: &Thing) -> Named {
        let name = names::tidy(&thing.name);
        let object = &self.world.objects[&made.object];
        let known = self.synonyms.find(Vocabulary::Object, &name);
        if name.is_empty() || known.is_some() || name == object.properties[SOURCE] {
            let en = made.meaning.as_ref().map_or(&object.name_en, |meaning| &meaning.name_en);
            let (ru, en) = (object.name.clone(), capitalized(en));
            return self.names.numbered(&ru, &en);
        }
        let name_en = if names::is_russian(&name) { String::new() } else { name.clone() };
        self.names.unique(&name, &name_en)
    }

    pub(super) fn spots(&mut self, level: &Level, storey: &Storey) {
        self.report.found(What::Place, level.spots.len());
        let index = Index::of(&storey.floors);
        for spot in &level.spots {
            let is_in =
                |r: &usize| storey.floors[*r].as_ref().is_some_and(|floor| floor.contains(spot.at));
            let room = index.near(spot.at, 1.0).into_iter().find(is_in);
            let Some((room, area)) = room.and_then(|r| Some((r, storey.areas[r]?))) else {
                self.report.skipped(What::Place, &spot.source, Why::Outside);
                continue;
            };
            self.report.taken(What::Place, 1);
            let id = PlaceId(self.world.places.len() as u32 + 1);
            if spot.is_start && self.world.robot.start.is_none() {
                self.world.robot.start = Some(id);
            }
            if spot.kind == CHARGER && self.charger.is_none() {
                self.charger = Some(id);
            }
            let named = self.spot_name(spot);
            self.world.places.insert(
                id,
                Place {
                    id,
                    area,
                    name: named.name,
                    name_en: named.name_en,
                    at: Point::from(spot.at - storey.origins[room]),
                    heading: spot.heading,
                    serves: None,
                    forms: Forms::new(),
                },
            );
        }
    }

    fn spot_name(&mut self, spot: &Spot) -> Named {
        let name = names::tidy(&spot.name);
        let by_name = self.synonyms.find(Vocabulary::Place, &name);
        let by_kind = self.synonyms.find(Vocabulary::Place, &spot.kind);
        // What a place is for goes before what it is called: where robots charge in a waiting area is a charger.
        let charger = by_kind.filter(|_| spot.kind == CHARGER);
        let (ru, en) = charger.or(by_name).or(by_kind).map_or_else(
            || ("Точка".to_owned(), "Point".to_owned()),
            |f| (f.meaning.name.clone(), capitalized(&f.meaning.name_en)),
        );
        if name.is_empty() || by_name.is_some_and(|f| f.is_whole) {
            return self.names.numbered(&ru, &en);
        }
        if names::is_russian(&name) {
            return self.names.unique(&name, "");
        }
        // A number of ours would hide the name that people know the place by.
        self.names.unique(&format!("{ru} {name}"), &name)
    }
}

/// The file's words for a kind, where they tell of which sort of its meaning it is: "nurse desk" of a desk.
fn own_words<'w>(words: &'w str, meaning: &Meaning) -> Option<&'w str> {
    let sort = words.strip_suffix(&*meaning.name_en)?.strip_suffix(' ')?;
    let is_plain = sort.chars().all(|c| c.is_ascii_lowercase() || c == ' ');
    (is_plain && !sort.trim().is_empty()).then_some(words)
}

fn usual_move_prob(made: &Made) -> u8 {
    let Some(meaning) = &made.meaning else { return 0 };
    let has = |wanted: &str| meaning.traits.iter().any(|t| t == wanted);
    meaning.move_prob.unwrap_or(if has("portable") {
        90
    } else if has("movable") {
        80
    } else {
        0
    })
}

/// The share of a thing's bases that lies in a room.
fn share_within(bases: &[Ring], floor: &Region) -> f64 {
    let (mut whole, mut within) = (0.0, 0.0);
    for base in bases {
        let area = doubled_area(base) / 2.0;
        whole += area;
        if is_well_within(base, floor) {
            within += area;
        } else {
            let rings: Vec<Ring> = floor.rings().cloned().collect();
            let common = overlay(
                &rings,
                std::slice::from_ref(base),
                OverlayRule::Intersect,
                FillRule::NonZero,
            );
            within += common.iter().map(Region::area).sum::<f64>();
        }
    }
    if whole > 0.0 { within / whole } else { 0.0 }
}

fn is_well_within(base: &[Point], floor: &Region) -> bool {
    base.iter().all(|&p| floor.contains(p))
        && !edges(base).any(|side| {
            let (low, high) = bounds([side.0, side.1]);
            floor.rings().flat_map(|ring| edges(ring)).any(|wall| {
                let (from, to) = bounds([wall.0, wall.1]);
                let apart = to.x < low.x || from.x > high.x || to.y < low.y || from.y > high.y;
                !apart && meeting(side, wall).is_some()
            })
        })
}

/// The shift that brings a box from a wall of the room to its inner side.
fn inward(floor: &Region, centre: Point, (low, high): (Point, Point)) -> Option<Vector> {
    let mut best: Option<(f64, Vector)> = None;
    for (a, b) in floor.rings().flat_map(|ring| edges(ring)) {
        let Some(along) = (b - a).try_normalize(1e-9) else { continue };
        let inside = Vector::new(-along.y, along.x);
        let t = (centre - a).dot(&along).clamp(0.0, (b - a).norm());
        let foot = a + along * t;
        let half = (high - low) / 2.0;
        let depth = (half.x * inside.x).abs() + (half.y * inside.y).abs();
        let shift = foot + inside * (depth + 0.5) - centre;
        if best.is_none_or(|(least, _)| shift.norm() < least) {
            best = Some((shift.norm(), shift));
        }
    }
    let limit = NUDGE + (high - low).norm() / 2.0;
    best.filter(|(length, _)| *length <= limit).map(|(_, shift)| shift)
}
