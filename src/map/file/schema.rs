//! The map file as serde types: one struct per kind of table, the same for TOML, YAML and JSON.
//!
//! The types are the one source of the format: reading refuses what they do not name, writing prints them in the
//! order of their fields, and [`json_schema`] is made from them. What they mean is decided in `read` and `write`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use super::table::Table;
use super::text::{Lines, Printed, line};
pub use super::values::{At, Coordinates, Number, pair};
pub use super::words::{
    DoorKindFile, HingeFile, OpensFile, PermeabilityFile, ProfileFile, StatusFile, ZoneWord,
};
use crate::units::InOrder as _;
use crate::{Case, Gender};

/// The only format that this version reads and writes.
pub(super) const FORMAT: u32 = 1;

/// The JSON Schema of a map file, for editors that complete and check.
///
/// # Panics
/// Never: the schema is made from types, not from data.
#[must_use]
pub fn json_schema() -> String {
    format!("{:#}", schemars::schema_for!(MapFile).as_value())
}

pub(super) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// Declares a table of the file: fields without `=` are required, fields with `=` may be left out.
macro_rules! tables {
    ($(
        $(#[$doc:meta])*
        $name:ident {
            $( $(#[$req_doc:meta])* $req:ident: $req_ty:ty; )*
            ..
            $( $(#[$opt_doc:meta])* $opt:ident: $opt_ty:ty; )*
        }
    )+) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            $( $(#[$req_doc])* pub $req: $req_ty, )*
            $(
                $(#[$opt_doc])*
                #[serde(default, skip_serializing_if = "is_default")]
                pub $opt: $opt_ty,
            )*
        }

        impl Printed for $name {
            const IS_TABLE: bool = true;
        }

        impl Lines for $name {
            fn lines(&self) -> String {
                let mut lines = vec![$( Some(line(stringify!($req), &self.$req)), )* $(
                    (!is_default(&self.$opt)).then(|| line(stringify!($opt), &self.$opt)),
                )*];
                // What is said in a word stands before what takes many lines.
                let takes_many = |line: &String| line.matches('\n').count() > 1;
                lines.order_by_key(|line| line.as_ref().is_some_and(takes_many));
                lines.into_iter().flatten().collect()
            }
        }
    )+};
}

/// Name-value pairs.
pub type Pairs = BTreeMap<String, String>;
/// Word forms by grammatical case.
pub type FormsFile = BTreeMap<Case, String>;

tables! {
    /// A map file of orthoframe: a building, its rooms, what stands in them, and the robot.
    MapFile {
        /// Version of the format: 1.
        format: u32;
        ..
        /// The building.
        domain: DomainFile;
        /// The robot that works here.
        robot: RobotFile;
        /// Type lists: what the languages and the rules know of each kind of thing.
        r#type: TypesFile;
        /// Orthoframes: vertical prisms from which everything is built.
        orthoframe: Table<OrthoframeFile>;
        /// Doors, of rooms and of furniture.
        door: Table<DoorFile>;
        /// Kinds of things.
        object: Table<ObjectFile>;
        /// Rooms, corridors, halls, with the replicas that stand in them.
        area: Table<AreaFile>;
        /// Floors or flats: Areas placed and bound together.
        map: Table<PlanFile>;
        /// Regions of the floor with rules of their own.
        zone: Table<ZoneFile>;
    }

    /// The building.
    #[derive(Default)]
    DomainFile {
        ..
        /// Handle of the building; "domain" if left out.
        key: String;
        /// Its number in the store; 1 if left out.
        id: Option<u32>;
        name: String;
        name_en: String;
        description: String;
        /// How exactly its things were measured; "surveyed" if left out.
        profile: ProfileFile;
        /// Where each Map stands in the building; may be left out when there is only one.
        maps: Vec<DomainMapFile>;
        /// Lifts and stairs, each with the Areas in which it stops.
        lifts: Vec<LiftFile>;
    }

    /// A Map placed in its building.
    DomainMapFile {
        /// Key of the Map.
        map: String;
        ..
        /// [x, y] or [x, y, z] in cm.
        at: At;
        /// Degrees counter-clockwise.
        angle: Option<Number>;
        /// The Map whose frame is that of the building; the first one if none says so.
        base: bool;
    }

    /// A lift or a flight of stairs.
    LiftFile {
        name: String;
        /// Keys of the Areas in which it stops, on different Maps.
        stops: Vec<String>;
        ..
    }

    /// The robot. Lengths in cm.
    #[derive(Default)]
    RobotFile {
        ..
        /// Of the disc that covers the footprint.
        radius: Option<Number>;
        /// Corners of a convex footprint, counter-clockwise, [ahead, to the left] of the centre; a disc without it.
        footprint: Vec<[Number; 2]>;
        height: Option<Number>;
        /// The highest step that it climbs or drives over.
        step: Option<Number>;
        /// Kept free around the footprint.
        clearance: Option<Number>;
        /// cm/s
        speed: Option<Number>;
        /// degrees/s
        turn_rate: Option<Number>;
        /// Name of the place where it stands when nothing else is known.
        start: Option<String>;
        /// Whether it opens and shuts the doors, lids and drawers of furniture.
        opens: Option<bool>;
    }

    /// The type lists.
    #[derive(Default)]
    TypesFile {
        ..
        orthoframe: Vec<TypeFile>;
        shape: Vec<TypeFile>;
        side: Vec<TypeFile>;
        object: Vec<TypeFile>;
        area: Vec<TypeFile>;
        map: Vec<TypeFile>;
        door: Vec<TypeFile>;
    }

    /// One type: a kind of room, of furniture, of wall.
    TypeFile {
        name: String;
        ..
        id: Option<u32>;
        name_en: String;
        description: String;
        /// Grammatical gender: m, f, n.
        gender: Option<Gender>;
        animate: bool;
        /// Other words for it, in either language.
        synonyms: Vec<String>;
        /// What the rules may know of it: container, portable, seat, support, corridor …
        traits: Vec<String>;
        /// Singular word forms where the rules of the language would go wrong.
        forms: FormsFile;
    }

    /// A vertical prism. Its base is given by exactly one of `rect`, `regular`, `points`, `sides`.
    #[derive(Default)]
    OrthoframeFile {
        ..
        id: Option<u32>;
        /// The key if left out.
        name: String;
        name_en: String;
        description: String;
        /// Name of an entry of `type.orthoframe`.
        r#type: Option<String>;
        /// Name of an entry of `type.shape`.
        shape: Option<String>;
        /// [width, depth]: side A runs along +x from the origin, then B, C, D counter-clockwise.
        rect: Option<[Number; 2]>;
        /// A regular polygon whose first side A runs along +x from the origin.
        regular: Option<RegularFile>;
        /// Corners counter-clockwise; the sides are A, B, C …
        points: Vec<[Number; 2]>;
        /// Every base vector in full.
        sides: Vec<SideFile>;
        /// Accept a clockwise base and turn it round.
        reverse: bool;
        /// Base to roof, cm; 0 is a flat shelf.
        height: Option<Number>;
        /// Permeability of the base.
        base: PermeabilityFile;
        /// Permeability of the roof.
        roof: PermeabilityFile;
        /// Size of the roof over the size of the base (Uniframe); 1 if left out.
        roof_scale: Option<Number>;
        properties: Pairs;
        /// What differs from side to side, by the id of the side.
        side: Table<SideTraitsFile>;
    }

    /// A regular polygon.
    RegularFile {
        /// At least three.
        corners: u32;
        /// Centre to corner, cm.
        radius: Number;
        ..
    }

    /// One base vector in full.
    SideFile {
        /// Unique in its Orthoframe.
        id: String;
        from: [Number; 2];
        to: [Number; 2];
        ..
        r#type: Option<String>;
        permeability: PermeabilityFile;
        names: Vec<String>;
        properties: Pairs;
    }

    /// What a side has beyond its base vector.
    #[derive(Default)]
    SideTraitsFile {
        ..
        /// Name of an entry of `type.side`.
        r#type: Option<String>;
        permeability: PermeabilityFile;
        /// What people call this side.
        names: Vec<String>;
        properties: Pairs;
    }

    /// A door, or a passage with a name.
    DoorFile {
        kind: DoorKindFile;
        width: Number;
        height: Number;
        ..
        id: Option<u32>;
        /// The key if left out.
        name: String;
        name_en: String;
        /// Name of an entry of `type.door`.
        r#type: Option<String>;
        /// From the right jamb to the left one, seen from the first Area that mounts the door.
        leaves: Vec<LeafFile>;
        /// How it stands: open if left out.
        state: StatusFile;
        /// Percent of the leaves' maximal opening; 100 for an open door if left out.
        opening: Option<Number>;
        properties: Pairs;
        forms: FormsFile;
    }

    /// A door leaf.
    LeafFile {
        /// Where the hinges are, or the side towards which a sliding leaf withdraws.
        hinge: HingeFile;
        ..
        /// Share of the door's width; an equal share if left out.
        share: Option<Number>;
        /// cm; 4 if left out.
        thickness: Option<Number>;
        /// Degrees for a hinged leaf (90 if left out), percent of its width for a sliding one (100 if left out).
        max_open: Option<Number>;
    }

    /// An Orthoframe as a part of an Object or Area.
    ItemFile {
        /// Unique in its Object or Area.
        id: String;
        /// Key of the Orthoframe.
        orthoframe: String;
        ..
        /// [x, y] or [x, y, z] in cm.
        at: At;
        /// Degrees counter-clockwise.
        angle: Option<Number>;
        /// The item with a corner, or its own origin, at the origin; the first one if none says so.
        base: bool;
    }

    /// Faces of two items that belong together.
    ItemLinkFile {
        /// "A.roof", "B.base", or an item and a side: "B.C".
        from: String;
        to: String;
        ..
        /// Offset of the second face from the first, cm; zero when they coincide.
        rel: At;
        /// Angle of the second face less that of the first, degrees.
        angle: Option<Number>;
    }

    /// A door bound to a side.
    MountFile {
        /// "side" or "item.side".
        side: String;
        /// Key of the door.
        door: String;
        ..
        /// Whether the leaves swing into the Area (inside) or out of it.
        opens: OpensFile;
    }

    /// A kind of thing.
    #[derive(Default)]
    ObjectFile {
        items: Vec<ItemFile>;
        ..
        id: Option<u32>;
        /// The key if left out.
        name: String;
        name_en: String;
        description: String;
        /// Name of an entry of `type.object`.
        r#type: Option<String>;
        links: Vec<ItemLinkFile>;
        /// "side" or "item.side" that looks forward; a round table has none.
        front: Option<String>;
        back: Option<String>;
        doors: Vec<MountFile>;
        properties: Pairs;
    }

    /// A room, corridor or hall, with all that stands in it.
    #[derive(Default)]
    AreaFile {
        items: Vec<ItemFile>;
        ..
        id: Option<u32>;
        /// The key if left out.
        name: String;
        name_en: String;
        description: String;
        /// Name of an entry of `type.area`.
        r#type: Option<String>;
        links: Vec<ItemLinkFile>;
        doors: Vec<MountFile>;
        properties: Pairs;
        forms: FormsFile;
        /// Named places to stand.
        places: Vec<PlaceFile>;
        /// What stands in the Area.
        replicas: Vec<ReplicaFile>;
    }

    /// A named place to stand.
    PlaceFile {
        name: String;
        at: [Number; 2];
        ..
        id: Option<u32>;
        name_en: String;
        /// Degrees counter-clockwise from +x of the Area.
        heading: Option<Number>;
        /// Name of the replica that is served from here.
        serves: Option<String>;
        forms: FormsFile;
    }

    /// A region of the floor with a rule of its own. Where it is, is told by exactly one of `rooms` and `points`.
    ZoneFile {
        /// What the robot is to do there.
        kind: ZoneWord;
        ..
        id: Option<u32>;
        /// The key if left out.
        name: String;
        name_en: String;
        /// Keys of the Areas that it is, on one Map or several.
        rooms: Vec<String>;
        /// Key of the Map on which its points lie; may be left out when there is only one.
        map: Option<String>;
        /// Corners [x, y] in the Map, cm, counter-clockwise; it need not be convex.
        points: Vec<[Number; 2]>;
        /// Of a slow zone: the speed that is not exceeded, cm/s.
        speed: Option<Number>;
        /// Of a one-way zone: which way it is driven through, degrees counter-clockwise from +x of the Map.
        heading: Option<Number>;
        /// Why, in the words of people: "the floor is wet".
        reason: String;
        reason_en: String;
        /// The moment when it begins, as 2026-11-21T09:30Z; in force from ever if left out.
        from: Option<String>;
        /// The moment when it ends; never if left out.
        until: Option<String>;
        forms: FormsFile;
    }

    /// One placed copy of an Object.
    ReplicaFile {
        /// Unique in the world.
        name: String;
        /// Key of the Object.
        object: String;
        /// [x, y] or [x, y, z] of the Object's origin in the Area, cm.
        at: At;
        ..
        id: Option<u32>;
        name_en: String;
        /// Degrees counter-clockwise.
        angle: Option<Number>;
        /// 0 never moves, 100 may be anywhere.
        move_prob: u32;
        properties: Pairs;
        /// How this replica's doors stand, by the key of the door, where they differ from the door's own state.
        doors: Table<DoorStateFile>;
        forms: FormsFile;
    }

    /// How a door stands.
    DoorStateFile {
        ..
        state: StatusFile;
        opening: Option<Number>;
    }

    /// A floor or flat.
    #[derive(Default)]
    PlanFile {
        items: Vec<PlanItemFile>;
        ..
        id: Option<u32>;
        /// The key if left out.
        name: String;
        name_en: String;
        description: String;
        /// Name of an entry of `type.map`.
        r#type: Option<String>;
        /// Whose coordinates the map's are, where no corner of the base Area stands at its origin: of which file or survey, or
        /// the map's own from before.
        frame: String;
        links: Vec<PlanLinkFile>;
    }

    /// An Area placed in a Map.
    PlanItemFile {
        /// Key of the Area.
        area: String;
        ..
        /// [x, y] or [x, y, z] in cm.
        at: At;
        /// Degrees counter-clockwise.
        angle: Option<Number>;
        /// The Area with a corner, or its own origin, at the origin; the first one if none says so.
        base: bool;
    }

    /// Sides of two Areas bound together.
    PlanLinkFile {
        /// "area.side" or "area.item.side".
        from: String;
        to: String;
        ..
        /// Offset of the second side from the first, cm; zero when they coincide.
        rel: At;
        /// Angle of the second side less that of the first, turned round; zero when they coincide.
        angle: Option<Number>;
    }
}

impl ZoneFile {
    /// A zone of which nothing is said but what the robot is to do there.
    pub(super) fn of_kind(kind: ZoneWord) -> Self {
        Self {
            kind,
            id: None,
            name: String::new(),
            name_en: String::new(),
            rooms: Vec::new(),
            map: None,
            points: Vec::new(),
            speed: None,
            heading: None,
            reason: String::new(),
            reason_en: String::new(),
            from: None,
            until: None,
            forms: FormsFile::new(),
        }
    }
}
