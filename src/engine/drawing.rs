//! Drawings of a map with what is known of it.

use std::sync::Arc;

use crate::draw::{
    DoorGlyph, FloorLayer, LeafBody, Mouth, NetworkLayer, PlanDrawing, RouteLayer, ViewDrawing,
    ViewLayer, ZoneGlyph, object_svg,
};
use crate::geometry::{Bounds, FloorPlan, Opening, PlacedZone, Sight};
use crate::language::zone_in_words;
use crate::map::{Entity, Object, World};
use crate::units::{
    AreaId, Language, MapId, PlaceId, Point, Pose, Vector, bilingual, nearest_name,
};

use super::{Error, RequestError, State};

/// What to draw of a map besides rooms, doors and furniture.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    /// Only this room with what stands in it.
    pub only: Option<AreaId>,
    /// Passframes and dead zones.
    pub floor: bool,
    /// The Passframe network.
    pub network: bool,
    /// The legs of a way, each with its directive's number.
    pub legs: Vec<(usize, Vec<Point>)>,
    /// The directives by number, listed below the plan.
    pub directives: Vec<(usize, String)>,
    /// Whether the way ends on this sheet.
    pub has_goal: bool,
    /// Where the robot stands.
    pub robot: Option<Pose>,
    /// What is in view from a pose.
    pub view: Option<Lens>,
    pub language: Language,
}

/// An eye: where it is, how high, how wide and how far it sees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lens {
    pub pose: Pose,
    /// Above the Map's zero, cm.
    pub height: f64,
    /// Degrees.
    pub field: f64,
    /// cm
    pub range: f64,
}

impl State {
    /// The plan of a map as SVG.
    ///
    /// # Errors
    /// There is no map.
    pub fn draw(&self, map: MapId, drawing: &Drawing) -> Result<String, Error> {
        let world = self.world()?;
        let floor = self.floor(map)?;
        let only = drawing.only;
        let drawing = PlanDrawing {
            world,
            scene: floor.scene(),
            only,
            doors: door_glyphs(world, floor, only),
            floor: if drawing.floor {
                floor_layer(floor, only, drawing.language)
            } else {
                FloorLayer::default()
            },
            network: if drawing.network {
                NetworkLayer::of(floor, only)
            } else {
                NetworkLayer::default()
            },
            route: RouteLayer {
                legs: drawing.legs.clone(),
                directives: drawing.directives.clone(),
                start: drawing.robot,
                has_goal: drawing.has_goal,
            },
            view: drawing.view.map(|lens| view_layer(world, floor, lens)).unwrap_or_default(),
            places: places(world, map, only, drawing.language),
            zones: zone_glyphs(world, floor, only, drawing.language),
            language: drawing.language,
        };
        Ok(drawing.to_svg())
    }

    /// The sheets of this name: a room, a map, or without a name every map of the building, the lowest first.
    ///
    /// # Errors
    /// Nothing that can be drawn as a plan bears the name.
    pub fn sheets_named(&self, name: Option<&str>) -> Result<Vec<(MapId, Option<AreaId>)>, Error> {
        let world = self.world()?;
        if name.is_some() || world.domain.maps.len() < 2 {
            return Ok(vec![self.sheet_named(name)?]);
        }
        let mut storeys: Vec<_> = world.domain.maps.iter().collect();
        storeys.sort_by(|a, b| a.frame.z.get().total_cmp(&b.frame.z.get()));
        Ok(storeys.into_iter().map(|placed| (placed.map, None)).collect())
    }

    /// The map, or the room of a map, of this name; without a name, the only map.
    ///
    /// # Errors
    /// Nothing that can be drawn as a plan bears the name.
    pub fn sheet_named(&self, name: Option<&str>) -> Result<(MapId, Option<AreaId>), Error> {
        let world = self.world()?;
        if let Some(name) = name
            && let Ok(Entity::Area(area)) = self.find(name)
            && let Some((map, _)) = world.placement(area)
        {
            return Ok((map, Some(area)));
        }
        Ok((self.map_named(name)?, None))
    }

    /// An Object, given by its own name or by that of a thing of its kind, as façade, profile and plan.
    ///
    /// # Errors
    /// Nothing bears the name.
    pub fn draw_object(&self, name: &str, language: Language) -> Result<String, Error> {
        Ok(object_svg(self.world()?, self.object_named(name)?, language))
    }

    /// What the robot would see through a lens, in perspective.
    ///
    /// # Errors
    /// There is no map.
    pub fn draw_view(&self, map: MapId, lens: Lens, language: Language) -> Result<String, Error> {
        let world = self.world()?;
        let floor = self.floor(map)?;
        let drawing = ViewDrawing {
            world,
            scene: floor.scene(),
            leaves: leaf_bodies(world, floor),
            mouths: mouths(world, floor),
            pose: lens.pose,
            height: lens.height,
            field: lens.field,
            range: lens.range,
            language,
        };
        Ok(drawing.to_svg())
    }

    fn object_named(&self, name: &str) -> Result<&Object, Error> {
        let world = self.world()?;
        let wanted = crate::units::name_key(name);
        let bears = |object: &&Object| {
            [&object.key, &object.name, &object.name_en]
                .into_iter()
                .any(|n| crate::units::name_key(n) == wanted)
        };
        if let Some(object) = world.objects.values().find(bears) {
            return Ok(object);
        }
        match self.find(name) {
            Ok(Entity::Replica(id)) => Ok(&world.objects[&world.replicas[&id].object]),
            Ok(_) => {
                let names = world.objects.values().map(|o| o.name.as_str());
                let help = nearest_name(name, names)
                    .map(|near| bilingual!("может быть, «{near}»?", "perhaps “{near}”?"));
                Err(RequestError::UnknownName { name: name.to_owned(), help }.into())
            }
            Err(error) => Err(error),
        }
    }
}

fn door_glyphs(world: &World, floor: &FloorPlan, only: Option<AreaId>) -> Vec<DoorGlyph> {
    let glyphs = |doorway: &Opening| {
        let Some(door) = doorway.door.and_then(|id| world.doors.get(&id)) else {
            return Vec::new();
        };
        let leaves = doorway.leaves(door).at(door.state);
        let mut arcs = doorway.leaves(door).arcs().into_iter();
        let status = door.state.status;
        leaves
            .into_iter()
            .map(|leaf| DoorGlyph {
                leaf,
                arc: arcs.next().unwrap_or_default(),
                status,
                door: door.id,
            })
            .collect()
    };
    let doorways = floor.doorways().iter().map(Arc::as_ref);
    let between = doorways.filter(|d| only.is_none_or(|a| d.areas.contains(&a)));
    between.chain(outer_doors(floor, only)).flat_map(glyphs).collect()
}

/// Door leaves as they stand on the floor of the first Area.
fn leaf_bodies(world: &World, floor: &FloorPlan) -> Vec<LeafBody> {
    /// Of a door of which the map does not say how high it is, cm.
    const USUAL: f64 = 200.0;
    let bodies = |doorway: &Opening| {
        let Some(door) = doorway.door.and_then(|id| world.doors.get(&id)) else {
            return Vec::new();
        };
        let room = floor.scene().areas.get(&doorway.areas[0]).and_then(|a| a.prisms.first());
        let bottom = room.map_or(0.0, |p| p.bottom);
        let top = bottom + if door.height.get() > 0.0 { door.height.get() } else { USUAL };
        let body = |base| LeafBody { base, bottom, top, status: door.state.status };
        doorway.leaves(door).at(door.state).into_iter().map(body).collect()
    };
    let doorways = floor.doorways().iter().map(Arc::as_ref);
    doorways.chain(outer_doors(floor, None)).flat_map(bodies).collect()
}

/// The doorways and passages through walls that are no mere lines.
fn mouths(world: &World, floor: &FloorPlan) -> Vec<Mouth> {
    const THIN: f64 = 0.5;
    let mouth = |doorway: &Opening| {
        let room = floor.scene().areas.get(&doorway.areas[0])?.prisms.first()?;
        let door = doorway.door.and_then(|id| world.doors.get(&id));
        let height = door.map_or(0.0, |d| d.height.get());
        let (t0, t1) = doorway.span();
        let jamb = |t: f64| (doorway.at(t, 0.0), doorway.at(t, doorway.gap));
        let top = if height > 0.0 { room.bottom + height } else { room.top };
        Some(Mouth { jambs: [jamb(t0), jamb(t1)], bottom: room.bottom, top: top.min(room.top) })
    };
    floor.doorways().iter().filter(|d| d.gap > THIN).filter_map(|d| mouth(d)).collect()
}

/// The doors that join no two Areas: they lead out of the map.
fn outer_doors(floor: &FloorPlan, only: Option<AreaId>) -> impl Iterator<Item = &Opening> {
    let joined: std::collections::HashSet<_> =
        floor.doorways().iter().filter_map(|d| d.door).collect();
    let outer = floor.blind_openings().iter().map(Arc::as_ref);
    outer.filter(move |o| {
        o.door.is_some_and(|door| !joined.contains(&door)) && only.is_none_or(|only| o.is_of(only))
    })
}

fn floor_layer(floor: &FloorPlan, only: Option<AreaId>, language: Language) -> FloorLayer {
    let mut layer = FloorLayer::default();
    for fragment in floor.fragments().filter(|f| only.is_none_or(|a| a == f.area)) {
        layer.passframes.extend(
            fragment
                .passframes()
                .iter()
                .map(|p| (p.polygon.clone(), format!("{} · {}", p.id, p.kind.name(language)))),
        );
        layer.dead_zones.extend(fragment.dead_zones().iter().cloned());
    }
    layer
}

/// Beams to the edge of the fan: one a half degree.
fn view_layer(world: &World, floor: &FloorPlan, lens: Lens) -> ViewLayer {
    let sight: Sight = floor.sight(world, lens.height);
    let beams = (lens.field * 2.0).ceil().max(2.0) as usize;
    let end = |beam: crate::geometry::Beam| {
        lens.pose.at + Vector::new(beam.direction.cos(), beam.direction.sin()) * beam.distance
    };
    let fan = sight.scan(lens.pose, lens.field, beams, lens.range).into_iter().map(end).collect();
    let seen = sight.visible(lens.pose, lens.field, lens.range);
    let seen = seen.into_iter().map(|v| (v.right, v.left)).collect();
    ViewLayer { eye: Some(lens.pose), fan, seen }
}

/// The zones of a map, those for a time among them.
fn zone_glyphs(
    world: &World,
    floor: &FloorPlan,
    only: Option<AreaId>,
    language: Language,
) -> Vec<ZoneGlyph> {
    let all = floor.with_zones(world, |_| true);
    let room = only.and_then(|area| floor.scene().areas.get(&area));
    let room =
        room.map(|a| a.prisms.iter().map(|p| p.bounds).fold(Bounds::EMPTY, |a, b| a.union(&b)));
    let is_shown =
        |zone: &&PlacedZone| room.is_none_or(|room| room.grown(-1.0).meets(&zone.bounds()));
    let glyph = |zone: &PlacedZone| ZoneGlyph {
        kind: zone.kind,
        name: match (language, &world.zones[&zone.id]) {
            (Language::English, zone) if !zone.name_en.is_empty() => zone.name_en.clone(),
            (_, zone) => zone.name.clone(),
        },
        rule: zone_in_words(world, zone.id, language),
        polygons: zone.polygons.clone(),
        is_timed: !world.zones[&zone.id].is_standing(),
    };
    all.zones().iter().filter(is_shown).map(glyph).collect()
}

fn places(
    world: &World,
    map: MapId,
    only: Option<AreaId>,
    language: Language,
) -> Vec<(PlaceId, Point, String)> {
    let placements = world.placements();
    let shown = world.places.values().filter(|p| only.is_none_or(|a| a == p.area));
    shown
        .filter_map(|place| {
            let &(on, frame) = placements.get(&place.area)?;
            let english = language == Language::English && !place.name_en.is_empty();
            let name = if english { &place.name_en } else { &place.name };
            (on == map).then(|| (place.id, frame.apply(place.at), name.clone()))
        })
        .collect()
}
