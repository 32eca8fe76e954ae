//! A replica made ready for measuring: its Orthoframes in the Map's frame, its foot, outline, sizes and front.
//!
//! What all replicas of an Object share is worked out once, in the Object's own frame ([`Kind`]).

use std::collections::BTreeMap;

use crate::geometry::contact::{Footprint, extent, outline};
use crate::geometry::{Bounds, Polygon, convex_hull};
use crate::map::{Object, Permeability, SideRef, World};
use crate::units::{AreaId, Frame, MapId, ObjectId, Point, ReplicaId, Vector};

/// Orthoframes whose bases lie within this of the lowest one, in cm, are what the thing stands on: drawings of one foot
/// differ by as much. How far a foot may be from what bears it the rules say.
const FOOT_SLACK: f64 = 0.5;

/// One Orthoframe, in the Object's frame or in the Map's.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Block {
    pub(super) base: Footprint,
    /// A Uniframe's roof; a prism's is its base.
    uniframe_roof: Option<Footprint>,
    pub(super) bottom: f64,
    pub(super) top: f64,
    pub(super) solid_base: bool,
    pub(super) solid_roof: bool,
    /// Some face lets things in, so that they can be in it.
    pub(super) hollow: bool,
    pub(super) open_top: bool,
}

impl Block {
    pub(super) fn roof(&self) -> &Footprint {
        self.uniframe_roof.as_ref().unwrap_or(&self.base)
    }

    /// Base and roof of a Uniframe, whichever reaches farther.
    pub(super) fn widest(&self) -> &Footprint {
        match &self.uniframe_roof {
            Some(roof) if roof.area > self.base.area => roof,
            _ => &self.base,
        }
    }

    fn placed(&self, frame: &Frame) -> Self {
        let z = frame.z.get();
        Self {
            base: self.base.placed(frame),
            uniframe_roof: self.uniframe_roof.as_ref().map(|r| r.placed(frame)),
            bottom: self.bottom + z,
            top: self.top + z,
            ..*self
        }
    }
}

/// What the replicas of one Object have in common.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Kind {
    pub(super) blocks: Vec<Block>,
    /// Border of all bases together, holes filled.
    outline: Vec<Footprint>,
    hull: Footprint,
    /// Indices of the blocks that it stands on.
    pub(super) foot: Vec<usize>,
    pub(super) foot_area: f64,
    pub(super) outline_area: f64,
    /// cm³ of outline times height.
    pub(super) volume: f64,
    centre: Point,
    /// Outward normal of the front.
    pub(super) front: Option<Vector>,
    /// Along the Object's own axes: width, depth.
    pub(super) size: (f64, f64),
    pub(super) container: bool,
}

impl Kind {
    pub(super) fn extent_along(&self, way: Vector) -> (f64, f64) {
        extent(&self.hull.polygon.corners, way)
    }

    /// None for an Object without Orthoframes: it has no place in space.
    pub(super) fn of(world: &World, object: &Object) -> Option<Self> {
        let blocks: Vec<Block> = object
            .items
            .iter()
            .map(|item| {
                let o = world.orthoframe_of(item);
                let base = Polygon::new(o.corners().map(|p| item.frame.apply(p)).collect());
                let centre = base.centroid();
                let grown = |p: &Point| centre + (p - centre) * o.roof_scale;
                let roof =
                    o.is_uniframe().then(|| Polygon::new(base.corners.iter().map(grown).collect()));
                let solid = |p: Permeability| p == Permeability::Impermeable;
                let sides_solid = o.base.iter().all(|v| solid(v.permeability));
                Block {
                    base: Footprint::new(base),
                    uniframe_roof: roof.map(Footprint::new),
                    bottom: item.frame.z.get(),
                    top: item.frame.z.get() + o.height.get(),
                    solid_base: solid(o.base_permeability),
                    solid_roof: solid(o.roof_permeability),
                    hollow: !(sides_solid
                        && solid(o.base_permeability)
                        && solid(o.roof_permeability)),
                    open_top: o.roof_permeability == Permeability::Permeable,
                }
            })
            .collect();
        let bottom = blocks.iter().map(|b| b.bottom).reduce(f64::min)?;
        let top = blocks.iter().map(|b| b.top).fold(bottom, f64::max);
        let widest: Vec<&Polygon> = blocks.iter().map(|b| &b.widest().polygon).collect();
        let outline: Vec<Footprint> = outline(&widest).into_iter().map(Footprint::new).collect();
        let corners: Vec<Point> = widest.iter().flat_map(|p| p.corners.iter().copied()).collect();
        let foot: Vec<usize> =
            (0..blocks.len()).filter(|&i| blocks[i].bottom <= bottom + FOOT_SLACK).collect();
        let outline_area: f64 = outline.iter().map(|f| f.area).sum();
        let axis = |v: Vector| {
            let (low, high) = extent(&corners, v);
            high - low
        };
        let object_type = world.types.object.get(object.object_type);
        Some(Self {
            foot_area: foot.iter().map(|&i| blocks[i].base.area).sum(),
            foot,
            volume: outline_area * (top - bottom),
            centre: weighted_centre(&outline).unwrap_or_else(|| corners[0]),
            front: front_of(world, object),
            size: (axis(Vector::x()), axis(Vector::y())),
            container: object_type.is_some_and(|t| t.traits.iter().any(|t| t == "container")),
            hull: Footprint::new(Polygon::new(convex_hull(corners))),
            outline_area,
            outline,
            blocks,
        })
    }
}

fn weighted_centre(outline: &[Footprint]) -> Option<Point> {
    let area: f64 = outline.iter().map(|f| f.area).sum();
    let sum: Vector = outline.iter().map(|f| f.polygon.centroid().coords * f.area).sum();
    (area > 0.0).then(|| Point::from(sum / area))
}

/// The way an Object faces: its front's outward normal, or the opposite of its back's.
fn front_of(world: &World, object: &Object) -> Option<Vector> {
    let normal = |at: &SideRef| {
        let item = object.item(&at.item)?;
        let (_, side) = world.orthoframe_of(item).side(&at.side)?;
        let along = item.frame.turn(side.end - side.start).try_normalize(1e-9)?;
        // Counter-clockwise round the base, so the outside is on the right.
        Some(Vector::new(along.y, -along.x))
    };
    object
        .front
        .as_ref()
        .and_then(normal)
        .or_else(|| object.back.as_ref().and_then(normal).map(|n| -n))
}

/// A replica as it stands in its Map.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Body {
    pub(super) id: ReplicaId,
    pub(super) map: MapId,
    /// The Fragment to which the Map's maker gave it.
    pub(super) fragment: AreaId,
    /// Of the replica within its Fragment.
    pub(super) frame: Frame,
    pub(super) object: ObjectId,
    pub(super) move_prob: u8,
    pub(super) blocks: Vec<Block>,
    pub(super) outline: Vec<Footprint>,
    pub(super) hull: Footprint,
    pub(super) bounds: Bounds,
    pub(super) bottom: f64,
    pub(super) top: f64,
    pub(super) centre: Point,
    pub(super) front: Option<Vector>,
}

impl Body {
    pub(super) fn new(
        world: &World,
        kinds: &BTreeMap<ObjectId, Kind>,
        areas: &BTreeMap<AreaId, (MapId, Frame)>,
        id: ReplicaId,
    ) -> Option<Self> {
        let replica = world.replicas.get(&id)?;
        let kind = kinds.get(&replica.object)?;
        let (map, area_frame) = areas.get(&replica.area)?;
        let frame = area_frame.compose(&replica.frame);
        let blocks: Vec<Block> = kind.blocks.iter().map(|b| b.placed(&frame)).collect();
        let hull = kind.hull.placed(&frame);
        Some(Self {
            id,
            map: *map,
            fragment: replica.area,
            frame: replica.frame,
            object: replica.object,
            move_prob: replica.move_prob,
            outline: kind.outline.iter().map(|f| f.placed(&frame)).collect(),
            bounds: hull.bounds,
            hull,
            bottom: blocks.iter().map(|b| b.bottom).fold(f64::INFINITY, f64::min),
            top: blocks.iter().map(|b| b.top).fold(f64::NEG_INFINITY, f64::max),
            centre: frame.apply(kind.centre),
            front: kind.front.map(|n| frame.turn(n)),
            blocks,
        })
    }

    /// A point of its own outline: the centre, or where that falls into a notch, a point beside it.
    pub(super) fn interior_point(&self) -> Point {
        if self.outline.iter().any(|f| f.contains(self.centre)) {
            return self.centre;
        }
        let largest = self.outline.iter().max_by(|a, b| a.area.total_cmp(&b.area));
        largest.map_or(self.centre, Footprint::interior_point)
    }

    /// Degrees from the front at which `p` lies, counter-clockwise positive; none without a front.
    pub(super) fn bearing_of(&self, p: Point) -> Option<f64> {
        self.bearing_from(self.front?, p)
    }

    /// Degrees from `ahead` at which `p` lies, in (-180, 180]; none for a point within the thing's own extents.
    ///
    /// ```text
    ///   left 135° \        / 45° left      the four sectors start at the corners of the thing's
    ///              +------+                extents along and across the way ahead
    ///        behind |      |  ahead  →
    ///              +------+
    ///             /        \
    /// ```
    pub(super) fn bearing_from(&self, ahead: Vector, p: Point) -> Option<f64> {
        let left = Vector::new(-ahead.y, ahead.x);
        let beyond = |along: Vector| {
            let (low, high) = extent(&self.hull.polygon.corners, along);
            let at = p.coords.dot(&along);
            (at - high).max(0.0) + (at - low).min(0.0)
        };
        let (forward, sideways) = (beyond(ahead), beyond(left));
        (forward.hypot(sideways) > 1e-6).then(|| sideways.atan2(forward).to_degrees())
    }
}
