//! A Map with every Orthoframe brought into the Map's own frame: what all measuring starts from.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::map::{Item, Orthoframe, Permeability, World};
use crate::units::{AreaId, Frame, Gather as _, MapId, OrFrId, Point, ReplicaId};

use super::{Bounds, Polygon};

/// Whose part a prism is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Owner {
    Area(AreaId),
    Replica(ReplicaId),
}

/// A side of a placed prism; it stands on the polygon's edge, and is its Orthoframe's base vector, of the same index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrismSide {
    pub permeability: Permeability,
}

/// A placed Orthoframe: `polygon` × `[bottom, top]` in the Map's frame, cm.
#[derive(Debug, Clone, PartialEq)]
pub struct Prism {
    pub owner: Owner,
    /// Which item of the owner's Object or Area.
    pub item: usize,
    pub orthoframe: OrFrId,
    pub polygon: Polygon,
    pub bounds: Bounds,
    pub bottom: f64,
    pub top: f64,
    /// See [`crate::map::Orthoframe::roof_scale`].
    pub roof_scale: f64,
    pub sides: Cow<'static, [PrismSide]>,
    /// No side has names or lets anything through.
    pub(super) is_plain: bool,
    pub base_permeability: Permeability,
    pub roof_permeability: Permeability,
}

impl Prism {
    /// A box around its roof.
    fn roof_bounds(&self) -> Bounds {
        self.roof().bounds()
    }

    /// Its roof as seen from above.
    pub(super) fn roof(&self) -> Polygon {
        self.scaled(self.roof_scale)
    }

    /// Its outline at a height: a Uniframe narrows or widens towards its roof.
    #[must_use]
    pub fn section(&self, height: f64) -> Polygon {
        let share = ((height - self.bottom) / (self.top - self.bottom)).clamp(0.0, 1.0);
        self.scaled(1.0 + (self.roof_scale - 1.0) * share)
    }

    fn scaled(&self, scale: f64) -> Polygon {
        let centre = self.polygon.centroid();
        Polygon::new(self.polygon.corners.iter().map(|c| centre + (c - centre) * scale).collect())
    }
}

/// No leaf of a wardrobe sticks out further than this, in cm.
const STICKS_OUT: f64 = 150.0;

/// An Area as it stands in its Map.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedArea {
    pub id: AreaId,
    /// Area → Map.
    pub frame: Frame,
    /// In the order of the Area's items.
    pub prisms: Vec<Prism>,
}

/// A replica as it stands in its Map.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedReplica {
    pub id: ReplicaId,
    pub area: AreaId,
    /// Object → Map.
    pub frame: Frame,
    /// In the order of the Object's items.
    pub prisms: Vec<Prism>,
    pub bounds: Bounds,
    /// Whether doors of its own are mounted on it.
    pub(super) has_doors: bool,
    pub bottom: f64,
    pub top: f64,
}

/// All prisms of one Map.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    pub map: MapId,
    pub areas: BTreeMap<AreaId, PlacedArea>,
    pub replicas: BTreeMap<ReplicaId, PlacedReplica>,
}

impl Scene {
    /// Places every Area of a Map and every replica of its Fragments.
    ///
    /// # Panics
    /// When the map is not of this world.
    #[must_use]
    pub fn of(world: &World, map: MapId) -> Self {
        let areas = Self::areas_of(world, map);
        let replicas = world
            .replicas
            .values()
            .filter_map(|r| {
                let frame = areas.get(&r.area)?.frame.compose(&r.frame);
                Some((r.id, PlacedReplica::new(world, r.id, frame)))
            })
            .collect();
        Self { map, areas, replicas }
    }

    /// The Areas of a Map alone, as they stand in it.
    pub(super) fn areas_of(world: &World, map: MapId) -> BTreeMap<AreaId, PlacedArea> {
        let items = world.maps[&map].items.iter();
        items.map(|item| (item.area, PlacedArea::new(world, item.area, item.frame))).gather()
    }

    /// The replicas that stand in an Area.
    pub fn replicas_in(&self, area: AreaId) -> impl Iterator<Item = &PlacedReplica> + '_ {
        self.replicas.values().filter(move |r| r.area == area)
    }

    /// The Area that holds a point of the floor; the lowest id where borders meet.
    #[must_use]
    pub fn area_at(&self, p: Point) -> Option<AreaId> {
        self.areas
            .values()
            .find(|a| {
                a.prisms
                    .iter()
                    .any(|f| f.bounds.grown(1e-6).contains(p) && f.polygon.contains(p, 1e-6))
            })
            .map(|a| a.id)
    }
}

impl PlacedArea {
    pub(super) fn new(world: &World, id: AreaId, frame: Frame) -> Self {
        Self { id, frame, prisms: prisms(world, Owner::Area(id), &world.areas[&id].items, &frame) }
    }
}

impl PlacedReplica {
    /// A replica whose Object frame stands at `frame` of the Map.
    ///
    /// # Panics
    /// When the replica is not of this world.
    #[must_use]
    pub fn new(world: &World, id: ReplicaId, frame: Frame) -> Self {
        let replica = &world.replicas[&id];
        let object = &world.objects[&replica.object];
        let has_doors = !object.doors.is_empty();
        let prisms = prisms(world, Owner::Replica(id), &object.items, &frame);
        let bounds = prisms.iter().fold(Bounds::EMPTY, |b, f| b.union(&f.bounds));
        let bottom = prisms.iter().map(|f| f.bottom).fold(f64::INFINITY, f64::min);
        let top = prisms.iter().map(|f| f.top).fold(f64::NEG_INFINITY, f64::max);
        Self { id, area: replica.area, frame, prisms, bounds, has_doors, bottom, top }
    }

    /// All that it may ever take: open leaves stick out, a Uniframe may be wider than its base.
    pub(super) fn reach(&self) -> Bounds {
        // A Uniframe is as wide as its roof where that is wider than its base.
        let widest = self.prisms.iter().filter(|p| p.roof_scale > 1.0).map(Prism::roof_bounds);
        let widest = widest.fold(self.bounds, |b, roof| b.union(&roof));
        let mut sides = self.prisms.iter().flat_map(|p| p.sides.iter());
        let has_leaves = sides.any(|s| s.permeability == Permeability::Conditional);
        widest.grown(if has_leaves { STICKS_OUT } else { 0.0 })
    }
}

/// The sides of an Orthoframe; most are solid all round, and need no list of their own.
fn sides(orthoframe: &Orthoframe) -> Cow<'static, [PrismSide]> {
    static SOLID: [PrismSide; 16] = [PrismSide { permeability: Permeability::Impermeable }; 16];
    let own = orthoframe.base.iter().map(|v| PrismSide { permeability: v.permeability });
    match SOLID.get(..own.len()) {
        Some(solid) if own.clone().eq(solid.iter().copied()) => Cow::Borrowed(solid),
        _ => Cow::Owned(own.collect()),
    }
}

fn prisms(world: &World, owner: Owner, items: &[Item], frame: &Frame) -> Vec<Prism> {
    let place = |(index, item): (usize, &Item)| {
        let orthoframe = world.orthoframe_of(item);
        let placed = frame.compose(&item.frame);
        let polygon = Polygon::new(orthoframe.corners().map(|p| placed.apply(p)).collect());
        let bottom = placed.z.get();
        Prism {
            owner,
            item: index,
            orthoframe: orthoframe.id,
            bounds: polygon.bounds(),
            polygon,
            bottom,
            top: bottom + orthoframe.height.get(),
            roof_scale: orthoframe.roof_scale,
            sides: sides(orthoframe),
            is_plain: orthoframe
                .base
                .iter()
                .all(|v| v.permeability == Permeability::Impermeable && v.names.is_empty()),
            base_permeability: orthoframe.base_permeability,
            roof_permeability: orthoframe.roof_permeability,
        }
    };
    items.iter().enumerate().map(place).collect()
}
