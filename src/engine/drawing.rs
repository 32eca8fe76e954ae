//! Drawings of a map with what is known of it.

use std::sync::Arc;

use crate::draw::{
    FloorLayer, LeafBody, Mouth, NetworkLayer, PlanDrawing, RouteLayer, ViewDrawing, ViewLayer,
    object_svg, outer_doors,
};
use crate::geometry::{FloorPlan, Opening, PassframeKind, Sight};
use crate::language::zone_in_words;
use crate::map::{Entity, Object, World};
use crate::units::{
    AreaId, InOrder as _, Language, MapId, Piece, Point, Pose, Vector, nearest_name, said, word,
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
        let rule = |zone| zone_in_words(world, zone, drawing.language);
        let drawing = PlanDrawing {
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
            ..PlanDrawing::of(world, floor, only, drawing.language, &rule)
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
        storeys.order_by(|a, b| a.frame.z.get().total_cmp(&b.frame.z.get()));
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
                let help = nearest_name(name, names).map(|near| said!("perhaps-near", near));
                Err(RequestError::UnknownName { name: name.to_owned(), help }.into())
            }
            Err(error) => Err(error),
        }
    }
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

/// The paper's word for a Passframe of this kind.
pub(super) fn kind_of_floor(kind: PassframeKind) -> Piece {
    match kind {
        PassframeKind::Closed => word!("closed-zone"),
        PassframeKind::Boundary => word!("boundary"),
        PassframeKind::DeadEnd => word!("dead-end"),
        PassframeKind::Passage => word!("passage"),
    }
}

fn floor_layer(floor: &FloorPlan, only: Option<AreaId>, language: Language) -> FloorLayer {
    let mut layer = FloorLayer::default();
    for fragment in floor.fragments().filter(|f| only.is_none_or(|a| a == f.area)) {
        layer.passframes.extend(fragment.passframes().iter().map(|p| {
            (p.polygon.clone(), format!("{} · {}", p.id, kind_of_floor(p.kind).say(language)))
        }));
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
