//! Fragment, Map, Domain (paper 1 §4; paper 2 §§5-6), and the [`World`] that holds them all.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::units::{
    AreaId, Cm, Deg, DomainId, DoorId, Frame, Gather as _, MapId, ObjectId, OrFrId, PlaceId, Point,
    ReplicaId, TypeId, ZoneId, name_key,
};

use super::{
    Area, Door, DoorState, Forms, Item, Mark, Object, Orthoframe, Properties, Records, SideRef,
    TypeLists, Zone,
};

/// One placed copy of an Object (table AreaObjects). An Area with its replicas is a Fragment.
#[derive(Debug, Clone, PartialEq)]
pub struct Replica {
    pub id: ReplicaId,
    pub area: AreaId,
    pub object: ObjectId,
    /// Handle and display name, unique in the world: «Стул-1».
    pub name: String,
    pub name_en: String,
    /// X, Y, Z, Ang of the Object's frame within the Area's.
    pub frame: Frame,
    /// 0 never moves, 100 may be anywhere. 0 makes the replica static, all else semi-static (M8).
    pub move_prob: u8,
    /// Over and above the Object's: this chair is the red one.
    pub properties: Properties,
    /// States of the Object's doors on this replica, where they differ from the door's own.
    pub door_states: BTreeMap<DoorId, DoorState>,
    pub forms: Forms,
}

/// A named place to stand: «Точка-А» (paper 1 §8).
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    pub id: PlaceId,
    pub area: AreaId,
    pub name: String,
    pub name_en: String,
    /// Within the Area's frame.
    pub at: Point,
    pub heading: Option<Deg>,
    /// The replica that is served from here: the bedside table of «Точка-К».
    pub serves: Option<ReplicaId>,
    pub forms: Forms,
}

/// An Area placed in a Map (table MapItems). Each Area stands in exactly one Map, once.
#[derive(Debug, Clone, PartialEq)]
pub struct MapItem {
    pub area: AreaId,
    pub frame: Frame,
    pub is_base: bool,
}

/// Sides of two Areas bound together (table MapItemLinks). Offsets as in [`super::ItemLink`], in the frame of the Map.
#[derive(Debug, Clone, PartialEq)]
pub struct MapLink {
    pub area: AreaId,
    pub side: SideRef,
    pub to_area: AreaId,
    pub to_side: SideRef,
    pub rel_x: Cm,
    pub rel_y: Cm,
    pub rel_z: Cm,
    pub rel_a: Deg,
}

/// One floor or flat.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    pub id: MapId,
    pub key: String,
    pub name: String,
    pub name_en: String,
    pub description: String,
    pub map_type: Option<TypeId>,
    /// Whose coordinates the Map's are, where they are not its own: those of the file that it was imported from, in cm.
    /// Empty: its own, and a corner of the base Area stands at the origin (paper 2 §5).
    pub frame: String,
    pub items: Vec<MapItem>,
    /// A copy of the Map has them in common with it until it changes one.
    pub links: Vec<Arc<MapLink>>,
}

/// A Map placed in its Domain (table DomainMaps).
#[derive(Debug, Clone, PartialEq)]
pub struct DomainMap {
    pub map: MapId,
    pub frame: Frame,
    pub is_base: bool,
}

/// One stop of a lift or one end of a flight of stairs: an Area of a Map.
#[derive(Debug, Clone, PartialEq)]
pub struct LiftStop {
    pub area: AreaId,
}

/// How exactly the things of a Domain were measured: the thresholds of relations differ by it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Profile {
    /// Measured by people: what stands on something stands on it.
    #[default]
    Surveyed,
    /// Seen by a robot, or boxes round meshes: off by some centimetres.
    Detected,
}

impl Profile {
    pub const ALL: [Self; 2] = [Self::Surveyed, Self::Detected];

    /// Its name in the rule text, the map file and the store.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Surveyed => "surveyed",
            Self::Detected => "detected",
        }
    }

    /// The profile of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|profile| profile.name() == name)
    }
}

/// A building: Maps in one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Domain {
    pub id: DomainId,
    pub key: String,
    pub name: String,
    pub name_en: String,
    pub description: String,
    pub profile: Profile,
    pub maps: Vec<DomainMap>,
    /// Lifts and stairs (M6): each links the Areas of its stops, which lie on different Maps.
    pub lifts: Vec<(String, Vec<LiftStop>)>,
}

/// The robot that works here. Lengths in cm.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotProfile {
    /// Of the disc that covers the footprint; the footprint itself where none is given.
    pub radius: Cm,
    /// Corners of a convex footprint in cm, counter-clockwise, x ahead and y to the left of the centre on which the
    /// robot turns; empty for a disc.
    pub footprint: Vec<Point>,
    pub height: Cm,
    /// The highest step that it climbs or drives over.
    pub step: Cm,
    /// Kept free around the footprint beyond its radius.
    pub clearance: Cm,
    /// cm/s
    pub speed: f64,
    /// degrees/s
    pub turn_rate: f64,
    /// Where it stands when nothing else is known.
    pub start: Option<PlaceId>,
    /// Whether it opens and shuts the doors, lids and drawers of furniture.
    pub opens: bool,
}

impl RobotProfile {
    /// The narrowest straight way that the robot passes, its clearance on both sides included, in cm.
    #[must_use]
    pub fn passing_width(&self) -> f64 {
        let radius = self.radius.get();
        let sides = self.footprint.iter().map(|p| (p.y, p.y));
        let (right, left) =
            sides.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or((-radius, radius));
        left - right + 2.0 * self.clearance.get()
    }
}

impl Default for RobotProfile {
    /// A robot of Care-O-bot's size, RB-2's like.
    fn default() -> Self {
        Self {
            radius: Cm::of(25.0),
            footprint: Vec::new(),
            height: Cm::of(120.0),
            step: Cm::of(2.0),
            clearance: Cm::of(2.0),
            speed: 60.0,
            turn_rate: 90.0,
            start: None,
            opens: false,
        }
    }
}

/// Two lists without what they begin and end with alike.
pub(crate) fn but_common_ends<'a, T: PartialEq>(one: &'a [T], other: &'a [T]) -> [&'a [T]; 2] {
    let same = |(a, b): &(&T, &T)| a == b;
    let first = one.iter().zip(other).take_while(same).count();
    let (one, other) = (&one[first..], &other[first..]);
    let last = one.iter().rev().zip(other.iter().rev()).take_while(same).count();
    [&one[..one.len() - last], &other[..other.len() - last]]
}

/// What a name can mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Entity {
    Map(MapId),
    Area(AreaId),
    Door(DoorId),
    Replica(ReplicaId),
    Place(PlaceId),
    Zone(ZoneId),
}

/// The whole model of an operating environment: a Domain with everything in it.
///
/// Records are keyed by their ids; ids are never reused, so holes are normal.
#[derive(Debug, Clone, PartialEq)]
pub struct World {
    pub domain: Domain,
    pub maps: Records<MapId, Map>,
    pub areas: Records<AreaId, Area>,
    pub objects: Records<ObjectId, Object>,
    pub orthoframes: Records<OrFrId, Orthoframe>,
    pub doors: Records<DoorId, Door>,
    pub replicas: Records<ReplicaId, Replica>,
    pub places: Records<PlaceId, Place>,
    pub zones: Records<ZoneId, Zone>,
    pub types: TypeLists,
    pub robot: RobotProfile,
}

impl World {
    /// A Domain without a single Map, from which one can be made by edits.
    #[must_use]
    pub fn empty() -> Self {
        let name = "domain".to_owned();
        Self {
            domain: Domain {
                id: DomainId(1),
                key: name.clone(),
                name,
                name_en: String::new(),
                description: String::new(),
                profile: Profile::default(),
                maps: Vec::new(),
                lifts: Vec::new(),
            },
            maps: Records::new(),
            areas: Records::new(),
            objects: Records::new(),
            orthoframes: Records::new(),
            doors: Records::new(),
            replicas: Records::new(),
            places: Records::new(),
            zones: Records::new(),
            types: TypeLists::default(),
            robot: RobotProfile::default(),
        }
    }

    /// Whether another world differs from this one in its replicas and the states of its doors only.
    #[must_use]
    pub fn is_same_building(&self, other: &Self) -> bool {
        let door = |(_, was, is): (DoorId, Option<&Door>, Option<&Door>)| {
            was.zip(is).is_some_and(|(was, is)| *is == Door { state: is.state, ..was.clone() })
        };
        self.domain == other.domain
            && self.maps == other.maps
            && self.areas == other.areas
            && self.objects == other.objects
            && self.orthoframes == other.orthoframes
            && self.types == other.types
            && self.places == other.places
            && self.zones == other.zones
            && self.robot == other.robot
            && self.doors.changes(&other.doors).into_iter().all(door)
    }

    /// How many records another world has otherwise; what belongs to no record counts for nothing.
    #[must_use]
    pub fn count_changes(&self, other: &Self) -> usize {
        macro_rules! count {
            ($($records:ident)*) => { [$(self.$records.changes(&other.$records).len()),*] };
        }
        let counts = count!(maps areas objects orthoframes doors replicas places zones);
        counts.into_iter().sum()
    }

    /// Where every Area stands; for work that asks for many of them, see [`Self::placement`] for one.
    #[must_use]
    pub fn placements(&self) -> BTreeMap<AreaId, (MapId, Frame)> {
        let items = self.maps.values().flat_map(|m| m.items.iter().map(|i| (m.id, i)));
        items.map(|(map, item)| (item.area, (map, item.frame))).gather()
    }

    /// The Map in which an Area stands, and the Area's frame within it: a search through the Maps' items.
    #[must_use]
    pub fn placement(&self, area: AreaId) -> Option<(MapId, Frame)> {
        self.maps.values().find_map(|map| {
            map.items.iter().find(|item| item.area == area).map(|item| (map.id, item.frame))
        })
    }

    /// Whether a thing has the usual size of its kind, which nobody measured.
    #[must_use]
    pub fn is_of_usual_size(&self, replica: ReplicaId) -> bool {
        let object = self.replicas.get(&replica).map(|replica| &self.objects[&replica.object]);
        object.is_some_and(|object| Mark::UsualSize.of(&object.properties).is_some())
    }

    /// Whether the type of a replica's Object has a trait.
    #[must_use]
    pub fn has_trait(&self, replica: ReplicaId, wanted: &str) -> bool {
        let object = self.replicas.get(&replica).and_then(|r| self.objects.get(&r.object));
        object.is_some_and(|object| self.types.object.has_trait(object.object_type, wanted))
    }

    /// Whether the type of an Area has a trait.
    #[must_use]
    pub fn area_has_trait(&self, area: AreaId, wanted: &str) -> bool {
        let area = self.areas.get(&area);
        area.is_some_and(|area| self.types.area.has_trait(area.area_type, wanted))
    }

    /// The replicas of a Fragment, in the order of their ids.
    pub fn replicas_in(&self, area: AreaId) -> impl Iterator<Item = &Replica> + '_ {
        self.replicas_within(move |own| own == area)
    }

    /// The replicas of the Fragments that are wanted, in the order of their ids.
    pub fn replicas_within<'a>(
        &'a self,
        is_wanted: impl Fn(AreaId) -> bool + Copy + 'a,
    ) -> impl Iterator<Item = &'a Replica> + 'a {
        self.replicas.of_groups(0, |r, put| put(r.area.0), move |area| is_wanted(AreaId(area)))
    }

    /// The replicas of the Objects that are wanted, in the order of their ids.
    pub fn replicas_of<'a>(
        &'a self,
        is_wanted: impl Fn(ObjectId) -> bool + Copy + 'a,
    ) -> impl Iterator<Item = &'a Replica> + 'a {
        self.replicas.of_groups(1, |r, put| put(r.object.0), move |kind| is_wanted(ObjectId(kind)))
    }

    /// The Areas of which an item is made of an Orthoframe that is wanted, in the order of their ids.
    pub fn areas_made_of<'a>(
        &'a self,
        is_wanted: impl Fn(OrFrId) -> bool + Copy + 'a,
    ) -> impl Iterator<Item = &'a Area> + 'a {
        let parts = |area: &Area, put: &mut dyn FnMut(u32)| {
            area.items.iter().for_each(|item| put(item.orthoframe.0));
        };
        self.areas.of_groups(0, parts, move |part| is_wanted(OrFrId(part)))
    }

    /// The Areas in which a door that is wanted is mounted, in the order of their ids.
    pub fn areas_hung_with<'a>(
        &'a self,
        is_wanted: impl Fn(DoorId) -> bool + Copy + 'a,
    ) -> impl Iterator<Item = &'a Area> + 'a {
        let doors = |area: &Area, put: &mut dyn FnMut(u32)| {
            area.doors.iter().for_each(|mount| put(mount.door.0));
        };
        self.areas.of_groups(1, doors, move |door| is_wanted(DoorId(door)))
    }

    /// The Objects of which an item is made of an Orthoframe that is wanted, in the order of their ids.
    pub fn objects_made_of<'a>(
        &'a self,
        is_wanted: impl Fn(OrFrId) -> bool + Copy + 'a,
    ) -> impl Iterator<Item = &'a Object> + 'a {
        let parts = |object: &Object, put: &mut dyn FnMut(u32)| {
            object.items.iter().for_each(|item| put(item.orthoframe.0));
        };
        self.objects.of_groups(0, parts, move |part| is_wanted(OrFrId(part)))
    }

    /// The Objects on which a door that is wanted is mounted, in the order of their ids.
    pub fn objects_hung_with<'a>(
        &'a self,
        is_wanted: impl Fn(DoorId) -> bool + Copy + 'a,
    ) -> impl Iterator<Item = &'a Object> + 'a {
        let doors = |object: &Object, put: &mut dyn FnMut(u32)| {
            object.doors.iter().for_each(|mount| put(mount.door.0));
        };
        self.objects.of_groups(1, doors, move |door| is_wanted(DoorId(door)))
    }

    /// Where the lists of items of two worlds' Maps differ: of each Map that does, its items in this world and in the other
    /// but for those at both ends of the lists that are the same in both.
    #[must_use]
    pub fn items_changed<'a>(&'a self, other: &'a Self) -> Vec<(MapId, [&'a [MapItem]; 2])> {
        let items = |map: Option<&'a Map>| map.map_or(&[][..], |map| &map.items);
        let changes = self.maps.changes(&other.maps).into_iter();
        changes.map(|(id, was, is)| (id, but_common_ends(items(was), items(is)))).collect()
    }

    /// The Orthoframe of an item.
    ///
    /// # Panics
    /// When the item is not of this world.
    #[must_use]
    pub fn orthoframe_of(&self, item: &Item) -> &Orthoframe {
        self.orthoframes
            .get(&item.orthoframe)
            .expect("a checked world has every Orthoframe its items name")
    }

    /// Everything that bears this name, in either language, in the order of [`Entity`].
    #[must_use]
    pub fn find(&self, name: &str) -> Vec<Entity> {
        let key = name_key(name);
        let mut found: Vec<Entity> =
            self.names().filter(|(_, n)| name_key(n) == key).map(|(e, _)| e).collect();
        // A name that is the same in both languages is still one entity's.
        found.dedup();
        found
    }

    /// Every name of every entity that a person can speak of, Russian and English.
    pub fn names(&self) -> impl Iterator<Item = (Entity, &str)> + '_ {
        let maps = self.maps.values().map(|m| (Entity::Map(m.id), [&m.name, &m.name_en]));
        let areas = self.areas.values().map(|a| (Entity::Area(a.id), [&a.name, &a.name_en]));
        let doors = self.doors.values().map(|d| (Entity::Door(d.id), [&d.name, &d.name_en]));
        let replicas =
            self.replicas.values().map(|r| (Entity::Replica(r.id), [&r.name, &r.name_en]));
        let places = self.places.values().map(|p| (Entity::Place(p.id), [&p.name, &p.name_en]));
        let zones = self.zones.values().map(|z| (Entity::Zone(z.id), [&z.name, &z.name_en]));
        let all = maps.chain(areas).chain(doors).chain(replicas).chain(places).chain(zones);
        all.flat_map(|(e, names)| {
            names.into_iter().filter(|n| !n.is_empty()).map(move |n| (e, n.as_str()))
        })
    }

    /// The names that an entity bears, Russian and English; empty ones among them, and for what is not of this world.
    #[must_use]
    pub fn both_names(&self, entity: Entity) -> [&str; 2] {
        macro_rules! names {
            ($records:ident, $id:expr) => {
                self.$records.get(&$id).map_or([""; 2], |r| [r.name.as_str(), r.name_en.as_str()])
            };
        }
        match entity {
            Entity::Map(id) => names!(maps, id),
            Entity::Area(id) => names!(areas, id),
            Entity::Door(id) => names!(doors, id),
            Entity::Replica(id) => names!(replicas, id),
            Entity::Place(id) => names!(places, id),
            Entity::Zone(id) => names!(zones, id),
        }
    }

    /// Whether an entity is of this world.
    #[must_use]
    pub fn has(&self, entity: Entity) -> bool {
        match entity {
            Entity::Map(id) => self.maps.contains_key(&id),
            Entity::Area(id) => self.areas.contains_key(&id),
            Entity::Door(id) => self.doors.contains_key(&id),
            Entity::Replica(id) => self.replicas.contains_key(&id),
            Entity::Place(id) => self.places.contains_key(&id),
            Entity::Zone(id) => self.zones.contains_key(&id),
        }
    }

    /// The display name of an entity.
    ///
    /// # Panics
    /// When the entity is not of this world.
    #[must_use]
    pub fn name(&self, entity: Entity) -> &str {
        match entity {
            Entity::Map(id) => &self.maps[&id].name,
            Entity::Area(id) => &self.areas[&id].name,
            Entity::Door(id) => &self.doors[&id].name,
            Entity::Replica(id) => &self.replicas[&id].name,
            Entity::Place(id) => &self.places[&id].name,
            Entity::Zone(id) => &self.zones[&id].name,
        }
    }
}
