//! What must hold in a [`World`] (SPEC M1-M7), with every fault at once.
//!
//! A fault that only follows from another is not reported: what stands on a broken base is not measured.

mod base;
mod doors;
mod doubts;
mod group;
mod maps;
mod names;
mod news;
mod placed;
pub mod plane;
mod scope;
mod zones;

use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet};

use crate::units::{
    AreaId, Bilingual, Cm, Frame, InOrder as _, MapId, OrFrId, Piece, Point, TypeId, word,
};

pub use doubts::{LeastSizes, Tolerances, doubts};
pub use group::THICKEST_WALL;
pub use news::news;
use scope::Scope;

use super::fault::{COORDINATE, Fault, MapError, Record, Spot, WITHIN};
use super::{Item, Map, TypeKind, World};

/// Lengths and places that differ less are the same: half a millimetre, since people write round numbers.
const TOLERANCE: f64 = 0.05;
/// Likewise for angles, in degrees.
const ANGLE_TOLERANCE: f64 = 0.05;
/// An overlap smaller than this, in cm², is a touch.
const OVERLAP: f64 = 1.0;
/// Overlaps reported of one Area or Map; a map shifted against itself has them by thousands.
const MOST_OVERLAPS: usize = 20;

/// Every fault of a world, warnings included.
///
/// ```
/// use orthoframe_map::{World, check};
///
/// # std::env::set_current_dir("../..").unwrap();
/// let mut world = World::load("maps/rb2.toml").unwrap();
/// assert!(check(&world).is_empty());
/// let chair = *world.replicas.keys().next().unwrap();
/// world.replicas.get_mut(&chair).unwrap().name = "Комната-Z".to_owned();
/// assert!(check(&world)[0].to_string().starts_with("имя «Комната-Z» носят двое"));
/// ```
#[must_use]
pub fn check(world: &World) -> Vec<Fault> {
    check_except(world, &BTreeSet::new())
}

/// [`check`] for a world of which some records are known to be faulty already.
pub(super) fn check_except(world: &World, broken: &BTreeSet<Record>) -> Vec<Fault> {
    Checker::new(world, broken).all()
}

struct Checker<'w> {
    world: &'w World,
    /// Records with faults of their own, found before.
    broken: &'w BTreeSet<Record>,
    /// What alone is looked at; all where there is none.
    scope: Option<&'w Scope<'w>>,
    /// Where each Area stands: its Map, and which of the Map's items it is. Sorted, made when it is first asked for.
    placed: OnceCell<Vec<(AreaId, (MapId, usize))>>,
    /// Of Orthoframes whether their bases can be measured, as far as it is known.
    sound: RefCell<BTreeMap<OrFrId, bool>>,
    faults: Vec<Fault>,
}

impl<'w> Checker<'w> {
    fn new(world: &'w World, broken: &'w BTreeSet<Record>) -> Self {
        let (placed, sound) = (OnceCell::new(), RefCell::default());
        Self { world, broken, scope: None, placed, sound, faults: Vec::new() }
    }

    /// All faults, or those within the scope.
    fn all(mut self) -> Vec<Fault> {
        self.bases();
        self.groups();
        self.doors();
        self.maps();
        self.domain();
        self.replicas();
        self.places();
        self.zones();
        self.robot();
        self.names();
        self.faults
    }

    /// Where an Area stands: its Map, and which of the Map's items it is; where it stands twice, the first time.
    fn placed(&self, area: AreaId) -> Option<(MapId, usize)> {
        let placed = self.placed.get_or_init(|| {
            let items =
                |map: &'w Map| map.items.iter().enumerate().map(|(n, i)| (i.area, (map.id, n)));
            let mut all: Vec<_> = self.world.maps.values().flat_map(items).collect();
            all.order_by_key(|(area, _)| *area);
            all
        });
        let at = placed.partition_point(|(other, _)| *other < area);
        placed.get(at).filter(|(other, _)| *other == area).map(|(_, place)| *place)
    }

    /// Whether a record is to be looked at.
    fn asks_for(&self, record: Record) -> bool {
        self.scope.is_none_or(|scope| scope.records.contains(&record))
    }
}

impl Checker<'_> {
    fn fault(&mut self, error: MapError, spot: Spot) {
        self.faults.push(Fault::new(error, vec![spot]));
    }

    fn contradiction(&mut self, error: MapError, one: Spot, other: Spot) {
        self.faults.push(Fault::new(error, vec![one, other]));
    }

    fn is_broken(&self, record: Record) -> bool {
        self.broken.contains(&record)
    }

    /// A reference by id that must lead somewhere.
    fn exists(
        &mut self,
        exists: bool,
        owner: &Bilingual,
        what: Piece,
        id: u32,
        spot: Spot,
    ) -> bool {
        if !exists {
            self.fault(MapError::DanglingId { owner: owner.clone(), what: what.into(), id }, spot);
        }
        exists
    }

    fn type_exists(&mut self, kind: TypeKind, id: Option<TypeId>, owner: &Bilingual, spot: &Spot) {
        if let Some(id) = id {
            let exists = self.world.types.list(kind).entries.contains_key(&id);
            self.exists(exists, owner, word!("type"), id.0, spot.clone().field("type"));
        }
    }

    /// A number that must be finite and within its range; the range is written as people write it.
    fn in_range(
        &mut self,
        what: impl Into<Bilingual>,
        value: f64,
        fits: bool,
        range: Piece,
        spot: Spot,
    ) {
        if !value.is_finite() || !fits {
            let (what, range) = (what.into(), range.into());
            self.fault(MapError::OutOfRange { what, value, range }, spot);
        }
    }

    /// Whether a frame made by hand has numbers that can be computed with.
    fn frame_is_finite(&mut self, frame: &Frame, spot: &Spot) -> bool {
        let numbers = [frame.x.get(), frame.y.get(), frame.z.get(), frame.angle.get()];
        let wrong = numbers.into_iter().find(|&n| Cm::new(n).is_err());
        if let Some(value) = wrong {
            let (what, range) = (COORDINATE.into(), WITHIN.into());
            self.fault(MapError::OutOfRange { what, value, range }, spot.clone().field("at"));
        }
        wrong.is_none()
    }

    /// Whether all items can be measured.
    fn is_sound(&self, items: &[Item]) -> bool {
        items.iter().all(|item| self.can_be_measured(item.orthoframe))
    }

    /// Whether the base of an Orthoframe is in order.
    fn can_be_measured(&self, id: OrFrId) -> bool {
        if let Some(is_sound) = self.sound.borrow().get(&id) {
            return *is_sound;
        }
        let is_sound = self.world.orthoframes.get(&id).is_some_and(|frame| {
            !self.is_broken(Record::Orthoframe(id))
                && Checker::new(self.world, self.broken).has_sound_base(frame)
        });
        self.sound.borrow_mut().insert(id, is_sound);
        is_sound
    }
}

/// A point as people write it.
fn at(p: Point) -> String {
    format!("({}; {})", Short(p.x), Short(p.y))
}

/// Two decimals at most.
struct Short(f64);

impl std::fmt::Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", (self.0 * 100.0).round() / 100.0 + 0.0)
    }
}

/// What an area is called; by its number where the map has none of it.
fn area_title(world: &World, area: crate::units::AreaId) -> String {
    world.areas.get(&area).map_or_else(|| area.0.to_string(), |a| a.name.clone())
}
