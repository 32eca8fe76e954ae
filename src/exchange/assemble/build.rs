//! The world from its parts: levels as Maps, rooms as Areas, each in a frame of its own.

use std::collections::BTreeMap;

use crate::map::BaseVector;
use crate::map::plane::edges;
use crate::map::{
    Area, Domain, DomainMap, DoorMount, Forms, Gender, Item, LiftStop, Map, MapItem, Mark,
    Orthoframe, Permeability, Properties, TypeKind, World,
};
use crate::report::{What, Why};
use crate::synonyms::{Synonyms, Vocabulary};
use crate::units::{
    AreaId, Cm, Deg, DoorId, Frame, Gather as _, MapId, OrFrId, PlaceId, Point, TypeId,
    capitalized, said, word,
};
use crate::{ImportError, Level, OpeningKind, Report, Room, Survey};

use super::names::{self, Names, letters};
use super::openings::{self, Placed};
use super::ring::{Region, pieces};
use super::rooms;
use super::types::Types;
use super::wall::{SideUse, as_region};

/// Floor to ceiling where the file does not tell, cm.
pub(super) const HEIGHT: f64 = 270.0;
/// Of a door where the file does not tell, cm.
const DOOR_HEIGHT: f64 = 205.0;
/// The property that holds the file's own id.
pub(super) const SOURCE: &str = Mark::Source.names()[0];

/// The world in the making, and what the makers of its parts share.
pub(super) struct Maker<'a> {
    pub(super) survey: &'a Survey,
    pub(super) synonyms: &'a Synonyms,
    pub(super) report: &'a mut Report,
    pub(super) world: World,
    pub(super) types: Types,
    pub(super) names: Names,
    pub(super) side_types: SideTypes,
    orthoframes: u32,
    /// The first place to charge.
    pub(super) charger: Option<PlaceId>,
}

pub(super) struct SideTypes {
    wall: TypeId,
    pub(super) window: TypeId,
    door: TypeId,
    passage: TypeId,
    part: TypeId,
}

/// A level with its rooms as they stand.
pub(super) struct Storey {
    pub(super) map: MapId,
    /// The level with the rooms that were cut off from others, where there are such.
    parted: Option<Level>,
    pub(super) placed: Placed,
    /// The floor of each room with its bays.
    pub(super) floors: Vec<Option<Region>>,
    pub(super) areas: Vec<Option<AreaId>>,
    /// Of the Area's frame, in the level's coordinates.
    pub(super) origins: Vec<Point>,
    pub(super) heights: Vec<f64>,
}

pub(super) fn build(
    survey: &Survey,
    synonyms: &Synonyms,
    report: &mut Report,
) -> Result<World, ImportError> {
    let mut types = Types::default();
    let side = |types: &mut Types, name, name_en, gender| {
        types.plain(TypeKind::Side, name, name_en, gender)
    };
    let side_types = SideTypes {
        wall: side(&mut types, "Стена", "wall", Gender::Feminine),
        window: side(&mut types, "Окно", "window", Gender::Neuter),
        door: side(&mut types, "Дверь", "door", Gender::Feminine),
        passage: side(&mut types, "Проход", "passage", Gender::Masculine),
        part: types.plain(
            TypeKind::Orthoframe,
            "Часть помещения",
            "part of a room",
            Gender::Feminine,
        ),
    };
    let world = empty(survey);
    let mut maker = Maker {
        survey,
        synonyms,
        report,
        world,
        types,
        names: Names::default(),
        side_types,
        orthoframes: 0,
        charger: None,
    };
    let storeys = maker.storeys()?;
    maker.lifts(&storeys);
    let kinds = maker.objects();
    for (level, storey) in survey.levels.iter().zip(&storeys) {
        if let Some(storey) = storey {
            let level = storey.parted.as_ref().unwrap_or(level);
            maker.things(level, storey, &kinds);
            maker.spots(level, storey);
            maker.lanes(level, storey);
        }
    }
    // A robot of which the file says nothing waits where it charges.
    maker.world.robot.start = maker.world.robot.start.or(maker.charger);
    maker.world.types = std::mem::take(&mut maker.types.lists);
    Ok(maker.world)
}

fn empty(survey: &Survey) -> World {
    let mut name = names::tidy(&survey.name);
    let mut name_en = if names::is_russian(&name) { String::new() } else { name.clone() };
    if name.is_empty() {
        (name, name_en) = ("Здание".to_owned(), "Building".to_owned());
    }
    let empty = World::empty();
    World { domain: Domain { key: "building".to_owned(), name_en, name, ..empty.domain }, ..empty }
}

impl Maker<'_> {
    /// Every level that has a room, as a Map in the Domain.
    fn storeys(&mut self) -> Result<Vec<Option<Storey>>, ImportError> {
        let survey = self.survey;
        let mut storeys = Vec::new();
        for level in &survey.levels {
            self.report.found(What::Level, 1);
            let storey = self.storey(level);
            if storey.is_some() {
                self.report.taken(What::Level, 1);
            } else {
                self.report.skipped(What::Level, &level.source, Why::EmptyLevel);
            }
            storeys.push(storey);
        }
        // Heights too are the file's where it has a floor at zero: that is the base.
        let made =
            || survey.levels.iter().zip(&storeys).filter_map(|(l, s)| Some((l, s.as_ref()?)));
        let heights = made().map(|(level, _)| level.elevation.get());
        let zero = heights.reduce(|a, b| if b.abs() < a.abs() { b } else { a }).unwrap_or(0.0);
        let mut maps: Vec<DomainMap> = made()
            .map(|(level, storey)| DomainMap {
                map: storey.map,
                frame: Frame::new(0.0, 0.0, level.elevation.get() - zero, Deg::ZERO),
                is_base: false,
            })
            .collect();
        if let Some(base) = maps.iter_mut().find(|m| m.frame == Frame::IDENTITY) {
            base.is_base = true;
        }
        self.world.domain.maps = maps;
        if self.world.maps.is_empty() {
            return Err(ImportError::content(
                "import",
                said!("no-room-of-use", report = *self.report),
                word!("check-the-file-rooms-are"),
            ));
        }
        Ok(storeys)
    }

    fn storey(&mut self, level: &Level) -> Option<Storey> {
        self.report.found(What::Room, level.rooms.len());
        let count = level.rooms.len();
        let rooms = rooms::floors(level, self.report);
        let parted = rooms.parted(level);
        let (level, regions) = (parted.as_ref().unwrap_or(level), rooms.regions);
        let first = regions.iter().position(Option::is_some)?;
        let placed = openings::place(level, &regions, self.report);
        let map = MapId(self.world.maps.len() as u32 + 1);
        let floors: Vec<Option<Region>> =
            placed.walls.iter().map(|w| w.as_ref().map(|w| as_region(&w.outline()))).collect();
        let heights = level
            .rooms
            .iter()
            .map(|room| room.height.map_or(HEIGHT, Cm::get).clamp(1.0, 10_000.0))
            .collect();
        let mut storey = Storey {
            map,
            parted: None,
            placed,
            areas: vec![None; level.rooms.len()],
            origins: floors
                .iter()
                .map(|f| f.as_ref().map_or(Point::origin(), |f| f.outer[0]))
                .collect(),
            floors,
            heights,
        };
        let named = self.map_name(level);
        let meaning = self.synonyms.find(Vocabulary::Map, &level.name).map(|f| f.meaning.clone());
        let map_type = meaning.map(|m| self.types.of(TypeKind::Map, &m));
        let mut items = Vec::new();
        let mut doors = self.doors(level, &storey);
        for (i, room) in level.rooms.iter().enumerate() {
            if storey.floors[i].is_none() {
                continue;
            }
            let area = self.area(level, &storey, i, room, &mut doors);
            storey.areas[i] = Some(area);
            let at = storey.origins[i];
            let frame = Frame::new(at.x, at.y, 0.0, Deg::ZERO);
            items.push(MapItem { area, frame, is_base: i == first });
        }
        let taken = storey.areas.iter().take(count).flatten().count();
        self.report.taken(What::Room, taken);
        let key = self.names.key("map", &level.source);
        self.world.maps.insert(
            map,
            Map {
                id: map,
                key,
                name: named.name,
                name_en: named.name_en,
                description: String::new(),
                map_type,
                frame: self.frame(),
                items,
                links: Vec::new(),
            },
        );
        self.links(level, &storey, &doors);
        storey.parted = parted;
        Some(storey)
    }

    /// Whose coordinates the Maps keep.
    fn frame(&self) -> String {
        let frame = names::tidy(&self.survey.frame);
        if frame.is_empty() { "исходный файл".to_owned() } else { frame }
    }

    fn map_name(&mut self, level: &Level) -> names::Named {
        let name = names::tidy(&level.name);
        let is_number =
            !name.is_empty() && name.chars().all(|c| c.is_numeric() || "-+".contains(c));
        if name.is_empty() || is_number {
            let source = if name.is_empty() { names::tidy(&level.source) } else { name };
            return self
                .names
                .unique(format!("Этаж {source}").trim(), format!("Floor {source}").trim());
        }
        let name_en = if names::is_russian(&name) { String::new() } else { name.clone() };
        self.names.unique(&name, &name_en)
    }

    fn area(
        &mut self,
        level: &Level,
        storey: &Storey,
        index: usize,
        room: &Room,
        doors: &mut Doors,
    ) -> AreaId {
        let id = AreaId(self.world.areas.len() as u32 + 1);
        let (named, area_type) = self.room_name(room);
        let walls = storey.placed.walls[index].as_ref().expect("a room with floor has walls");
        let shapes = shapes(&walls.outline());
        let origin = storey.origins[index];
        let mut items = Vec::with_capacity(shapes.len());
        let mut mounts = Vec::new();
        for (k, shape) in shapes.iter().enumerate() {
            let item = letters(k);
            let mut base = Vec::with_capacity(shape.len());
            for (s, &(start, used)) in shape.iter().enumerate() {
                let end = shape[(s + 1) % shape.len()].0;
                let side = letters(s);
                let mut vector = BaseVector {
                    id: side.clone(),
                    start: Point::from(start - origin),
                    end: Point::from(end - origin),
                    side_type: Some(self.side_types.wall),
                    permeability: Permeability::Impermeable,
                    names: Vec::new(),
                    properties: Properties::new(),
                };
                match used {
                    Side::Wall => {}
                    Side::Seam => {
                        vector.permeability = Permeability::Permeable;
                        vector.side_type = None;
                    }
                    Side::Opening(o) => {
                        let opening = &level.openings[o];
                        match opening.what {
                            OpeningKind::Window => {
                                vector.side_type = Some(self.side_types.window);
                                vector.names = doors.window_name(o).into_iter().collect();
                                vector.properties = opening.properties.clone();
                            }
                            OpeningKind::Passage => {
                                vector.side_type = Some(self.side_types.passage);
                                vector.permeability = Permeability::Permeable;
                            }
                            OpeningKind::Door { .. } => {
                                vector.side_type = Some(self.side_types.door);
                                vector.permeability = Permeability::Conditional;
                            }
                        }
                        if let Some(door) = doors.ids[o] {
                            let opens = doors.opens(o, index);
                            mounts.push(DoorMount {
                                item: item.clone(),
                                side: side.clone(),
                                door,
                                opens,
                            });
                            doors.sides.entry(o).or_default().push((id, item.clone(), side));
                        }
                    }
                }
                base.push(vector);
            }
            let orthoframe =
                self.orthoframe(&format!("{} {item}", named.name), base, storey.heights[index]);
            items.push(Item { id: item, orthoframe, frame: Frame::IDENTITY, is_base: k == 0 });
        }
        let mut properties = room.properties.clone();
        properties.insert(SOURCE.to_owned(), room.source.clone());
        let key = self.names.key("area", &room.source);
        self.world.areas.insert(
            id,
            Area {
                id,
                key,
                name: named.name,
                name_en: named.name_en,
                description: String::new(),
                area_type,
                items,
                links: Vec::new(),
                doors: mounts,
                properties,
                forms: Forms::new(),
            },
        );
        id
    }

    fn orthoframe(&mut self, name: &str, base: Vec<BaseVector>, height: f64) -> OrFrId {
        let frame_type = Some(self.side_types.part);
        self.insert_orthoframe(name, base, height, frame_type, Permeability::Impermeable)
    }

    pub(super) fn insert_orthoframe(
        &mut self,
        name: &str,
        base: Vec<BaseVector>,
        height: f64,
        frame_type: Option<TypeId>,
        permeability: Permeability,
    ) -> OrFrId {
        self.orthoframes += 1;
        let id = OrFrId(self.orthoframes);
        self.world.orthoframes.insert(
            id,
            Orthoframe {
                id,
                key: format!("of-{}", id.0),
                name: name.to_owned(),
                name_en: String::new(),
                description: String::new(),
                frame_type,
                shape: None,
                base,
                height: Cm::of(height),
                base_permeability: permeability,
                roof_permeability: permeability,
                roof_scale: 1.0,
                properties: Properties::new(),
            },
        );
        id
    }

    /// What a room is called: as the file calls it, where that says more than its type does.
    fn room_name(&mut self, room: &Room) -> (names::Named, Option<TypeId>) {
        let name = names::tidy(&room.name);
        let by_name = self.synonyms.find(Vocabulary::Area, &name);
        let by_kind = self.synonyms.find(Vocabulary::Area, &room.kind);
        let meaning = by_kind
            .filter(|f| !f.meaning.name.eq_ignore_ascii_case("Помещение"))
            .or(by_name)
            .or(by_kind)
            .map(|f| f.meaning.clone());
        let area_type = meaning.as_ref().map(|m| self.types.of(TypeKind::Area, m));
        let says_only_type = name.is_empty() || by_name.is_some_and(|f| f.is_whole);
        let given = match (&meaning, says_only_type) {
            (meaning, true) if !room.called.is_empty() => {
                // In Russian as without that name: numbers stay what they are.
                let russian = match meaning {
                    Some(m) => self.names.unique(&m.name, ""),
                    None => self.names.numbered("Помещение", ""),
                };
                let english = self.names.unique("", &room.called);
                names::Named { name: russian.name, name_en: english.name_en }
            }
            (Some(m), true) => {
                let own = by_name.filter(|f| f.is_whole).map_or(m, |f| f.meaning);
                let (ru, en) = (own.name.clone(), capitalized(&own.name_en));
                match trailing_number(&name) {
                    Some(n) => self.names.unique(&format!("{ru}-{n}"), &format!("{en} {n}")),
                    None => self.names.unique(&ru, &en),
                }
            }
            (None, true) => self.names.numbered("Помещение", "Room"),
            (_, false) => {
                let is_number = name.chars().all(|c| c.is_numeric());
                let (ru, en) = if is_number {
                    (format!("Помещение {name}"), format!("Room {name}"))
                } else if names::is_russian(&name) {
                    (name.clone(), String::new())
                } else {
                    (name.clone(), name.clone())
                };
                let named = self.names.unique(&ru, &en);
                if named.name != ru {
                    let why = Why::DuplicateName { name, given: named.name.clone() };
                    self.report.mended(What::Room, &room.source, why);
                }
                named
            }
        };
        (given, area_type)
    }

    fn lifts(&mut self, storeys: &[Option<Storey>]) {
        let survey = self.survey;
        self.report.found(What::Lift, survey.lifts.len());
        for lift in &survey.lifts {
            let mut stops: Vec<(MapId, AreaId)> = lift
                .stops
                .iter()
                .filter_map(|&(level, room)| {
                    let storey = storeys.get(level)?.as_ref()?;
                    Some((storey.map, (*storey.areas.get(room)?)?))
                })
                .collect();
            stops.dedup();
            let floors: std::collections::BTreeSet<MapId> = stops.iter().map(|s| s.0).gather();
            if floors.len() < 2 {
                self.report.skipped(What::Lift, &lift.source, Why::LiftStops);
                continue;
            }
            let is_shaft = |&(_, area): &(MapId, AreaId)| {
                let area_type = self.world.areas.get(&area).and_then(|area| area.area_type);
                let types = &self.types.lists.area;
                ["lift", "stairs"].iter().any(|wanted| types.has_trait(area_type, wanted))
            };
            if !lift.is_told && !stops.iter().all(is_shaft) {
                self.report.skipped(What::Lift, &lift.source, Why::NoLift);
                continue;
            }
            self.report.taken(What::Lift, 1);
            let name = names::tidy(if lift.name.is_empty() { &lift.source } else { &lift.name });
            let stops = stops.into_iter().map(|(_, area)| LiftStop { area }).collect();
            self.world.domain.lifts.push((name, stops));
        }
    }
}

/// What stands on a side of a piece of floor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Wall,
    /// The cut between two pieces of one room.
    Seam,
    Opening(usize),
}

/// The pieces of a room's outline, each corner with what stands on the side that begins there.
fn shapes(outline: &[Vec<(Point, SideUse)>]) -> Vec<Vec<(Point, Side)>> {
    let used = |side| match side {
        SideUse::Wall => Side::Wall,
        SideUse::Opening(i) => Side::Opening(i),
    };
    if let [only] = outline {
        return vec![only.iter().map(|&(p, side)| (p, used(side))).collect()];
    }
    let sides: Vec<(Point, Point, Side)> = outline
        .iter()
        .flat_map(|ring| {
            (0..ring.len()).map(|i| (ring[i].0, ring[(i + 1) % ring.len()].0, used(ring[i].1)))
        })
        .collect();
    // Sides are found again after the cut by their ends.
    let known = |p: Point, q: Point| {
        sides.iter().find(|(a, b, _)| same(*a, p) && same(*b, q)).map(|&(.., side)| side)
    };
    let is_opening = |p: Point, q: Point| matches!(known(p, q), Some(Side::Opening(_)));
    let pieces = pieces(&as_region(outline), is_opening);
    let is_seam = |p: Point, q: Point| {
        pieces.iter().flat_map(|ring| edges(ring)).any(|(a, b)| same(a, q) && same(b, p))
    };
    let side = |p: Point, q: Point| {
        known(p, q).unwrap_or(if is_seam(p, q) { Side::Seam } else { Side::Wall })
    };
    let mut shapes: Vec<Vec<(Point, Side)>> =
        pieces.iter().map(|ring| edges(ring).map(|(p, q)| (p, side(p, q))).collect()).collect();
    // The Area's origin is a corner of its base item.
    if let Some(first) = outline.first().and_then(|ring| ring.first()) {
        let base = shapes.iter().position(|s| s.iter().any(|(p, _)| same(*p, first.0)));
        if let Some(base) = base {
            shapes.swap(0, base);
        }
    }
    shapes
}

fn same(p: Point, q: Point) -> bool {
    (p.x - q.x).abs() < 1e-3 && (p.y - q.y).abs() < 1e-3
}

/// `Bedroom 2`: 2.
fn trailing_number(name: &str) -> Option<u32> {
    let digits: String = name
        .chars()
        .rev()
        .take_while(char::is_ascii_digit)
        .collect::<Vec<_>>()
        .into_iter()
        .rev()
        .collect();
    digits.parse().ok()
}

/// The doors of one level.
pub(super) struct Doors {
    /// By opening.
    pub(super) ids: Vec<Option<DoorId>>,
    pub(super) windows: Vec<Option<String>>,
    /// Where each opening's sides are, in the order of the Areas.
    pub(super) sides: BTreeMap<usize, Vec<(AreaId, String, String)>>,
    /// For each opening, whether it opens into each of its rooms.
    pub(super) into: Vec<Vec<(usize, bool)>>,
}

impl Doors {
    fn window_name(&self, opening: usize) -> Option<String> {
        self.windows[opening].clone()
    }

    fn opens(&self, opening: usize, room: usize) -> crate::map::OpensTo {
        let into = self.into[opening].iter().find(|(r, _)| *r == room);
        if into.is_some_and(|(_, inside)| *inside) {
            crate::map::OpensTo::Inside
        } else {
            crate::map::OpensTo::Outside
        }
    }
}

pub(super) fn door_height(given: Option<Cm>, wall: f64) -> f64 {
    given.map_or(DOOR_HEIGHT, Cm::get).clamp(1.0, wall)
}
