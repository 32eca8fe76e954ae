//! The tables of paper 2, one record type each, with the paper's table and column names (its `Hieght` too).
//!
//! Paper 2 §§2-7. Every record bears, beside these columns, `RecDate`, `RecUser`, `Deleted` and its revision:
//! see [`Stamp`](super::Stamp). Columns and tables that no paper has are marked `beyond` and stand last.
//! Lengths are cm, angles degrees; permeability is 0, 1 or 2.
//!
//! **Invariant**: a table's code stands in the journal; codes and columns are only ever added, never changed.
#![allow(missing_docs, reason = "the columns are described in paper 2, whose names they bear")]

use super::cell::{Cell, Field, Key, Row};
use super::schema::{Column, Origin, column, field, key_of, role, tables};

/// A record type: one struct a table.
pub trait Record: Sized {
    const TABLE: Table;

    #[doc(hidden)]
    fn to_row(&self) -> Row;

    /// None when a cell does not fit its column.
    #[doc(hidden)]
    fn from_row(row: &[Cell]) -> Option<Self>;
}

/// The key of a record.
pub(crate) fn key_of_record<T: Record>(record: &T) -> Key {
    key_of_row::<T>(&record.to_row())
}

/// The key of a record by its row.
pub(crate) fn key_of_row<T: Record>(row: &Row) -> Key {
    key_of(T::TABLE.columns(), row).expect("a record's key fields are ids and texts")
}

tables! {
    /// Orthoframes (paper 2 §2).
    Paper OrFr = 1 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        col type_id: Option<u32> = "TypeID",
        col shape_id: Option<u32> = "ShapeID",
        col side_count: u32 = "SideCount",
        col base_pntr: u32 = "BasePntr",
        col roof: f64 = "Roof",
        col roof_pntr: u32 = "RoofPntr",
        col size_x: f64 = "SizeX",
        col size_y: f64 = "SizeY",
        beyond key: String = "Key",
        beyond name_en: String = "NameEn",
        beyond roof_scale: f64 = "RoofScale",
    }
    /// Geometric figures of bases: «Квадрат».
    Paper OrtFrmShapeList = 2 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        beyond name_en: String = "NameEn",
        beyond gender: String = "Gender",
        beyond animate: bool = "Animate",
    }
    /// Types of Orthoframes: «Часть мебели».
    Paper OrtFrmTypeList = 3 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        beyond name_en: String = "NameEn",
        beyond gender: String = "Gender",
        beyond animate: bool = "Animate",
    }
    /// Properties of Orthoframes: «Цвет» = «Черный».
    Paper OrtFrmProperties = 4 {
        key or_fr_id: u32 = "OrFrID",
        key prop: String = "Prop",
        col prop_val: String = "PropVal",
    }
    /// Base vectors of Orthoframes and the sides on them.
    Paper OrtFrmSides = 5 {
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        col side_type_id: Option<u32> = "SideTypeID",
        col side_pntr: u32 = "SidePntr",
        col x1: f64 = "X1",
        col y1: f64 = "Y1",
        col x2: f64 = "X2",
        col y2: f64 = "Y2",
        col len: f64 = "Len",
        col ang: f64 = "Ang",
        beyond no: u32 = "No",
    }
    /// Types of sides: «Стена», «Проход».
    Paper OrtFrmSideTypeList = 6 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        beyond name_en: String = "NameEn",
        beyond gender: String = "Gender",
        beyond animate: bool = "Animate",
    }
    /// Properties of sides.
    Paper OrtFrmSideProperties = 7 {
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        key prop: String = "Prop",
        col prop_val: String = "PropVal",
    }
    /// Kinds of things (paper 2 §3).
    Paper Object = 8 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        col type_id: Option<u32> = "TypeID",
        col size_x: f64 = "SizeX",
        col size_y: f64 = "SizeY",
        col height: f64 = "Hieght",
        beyond key: String = "Key",
        beyond name_en: String = "NameEn",
        beyond front_item: Option<String> = "FrontItemID",
        beyond front_side: Option<String> = "FrontSideID",
        beyond back_item: Option<String> = "BackItemID",
        beyond back_side: Option<String> = "BackSideID",
    }
    /// Types of Objects: «Стол».
    Paper ObjectTypeList = 9 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        beyond name_en: String = "NameEn",
        beyond gender: String = "Gender",
        beyond animate: bool = "Animate",
    }
    /// The Orthoframes of an Object.
    Paper ObjectItems = 10 {
        key object_id: u32 = "ObjectID",
        key item_id: String = "ItemID",
        col or_fr_id: u32 = "OrFrID",
        col pos_x: f64 = "PosX",
        col pos_y: f64 = "PosY",
        col pos_z: f64 = "PosZ",
        col pos_a: f64 = "PosA",
        col base: bool = "Base",
        beyond no: u32 = "No",
    }
    /// Links between items of an Object. A base is written `@base`, a roof `@roof` in `SideID`.
    Paper ObjectItemLinks = 11 {
        key object_id: u32 = "ObjectID",
        key item_id: String = "ItemID",
        key item_id2: String = "ItemID2",
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        key or_fr_id2: u32 = "OrFrID2",
        key side_id2: String = "SideID2",
        col rel_x: f64 = "RelX",
        col rel_y: f64 = "RelY",
        col rel_a: f64 = "RelA",
        col rel_xy: f64 = "RelXY",
        col rel_z: f64 = "RelZ",
        beyond no: u32 = "No",
    }
    /// Doors of Objects. `SetInside`: 1 into, -1 out of.
    Paper ObjectDoors = 12 {
        key object_id: u32 = "ObjectID",
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        key door_id: u32 = "DoorID",
        col set_inside: i64 = "SetInside",
        beyond_key item_id: String = "ItemID",
        beyond no: u32 = "No",
    }
    /// Rooms, corridors, halls (paper 2 §4).
    Paper Area = 13 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        col type_id: Option<u32> = "TypeID",
        col size_x: f64 = "SizeX",
        col size_y: f64 = "SizeY",
        col height: f64 = "Hieght",
        beyond key: String = "Key",
        beyond name_en: String = "NameEn",
    }
    /// Types of Areas: «Коридор».
    Paper AreaTypeList = 14 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        beyond name_en: String = "NameEn",
        beyond gender: String = "Gender",
        beyond animate: bool = "Animate",
    }
    /// The Orthoframes of an Area.
    Paper AreaItems = 15 {
        key area_id: u32 = "AreaID",
        key item_id: String = "ItemID",
        col or_fr_id: u32 = "OrFrID",
        col pos_x: f64 = "PosX",
        col pos_y: f64 = "PosY",
        col pos_z: f64 = "PosZ",
        col pos_a: f64 = "PosA",
        col base: bool = "Base",
        beyond no: u32 = "No",
    }
    /// Links between items of an Area; as [`ObjectItemLinks`].
    Paper AreaItemLinks = 16 {
        key area_id: u32 = "AreaID",
        key item_id: String = "ItemID",
        key item_id2: String = "ItemID2",
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        key or_fr_id2: u32 = "OrFrID2",
        key side_id2: String = "SideID2",
        col rel_x: f64 = "RelX",
        col rel_y: f64 = "RelY",
        col rel_a: f64 = "RelA",
        col rel_xy: f64 = "RelXY",
        col rel_z: f64 = "RelZ",
        beyond no: u32 = "No",
    }
    /// Doors of Areas. `SetInside`: 1 into the Area, -1 out of it.
    Paper AreaDoors = 17 {
        key area_id: u32 = "AreaID",
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        key door_id: u32 = "DoorID",
        col set_inside: i64 = "SetInside",
        beyond_key item_id: String = "ItemID",
        beyond no: u32 = "No",
    }
    /// Fragments: the replicas of Objects that stand in an Area (paper 2 §5).
    Paper AreaObjects = 18 {
        key area_id: u32 = "AreaID",
        key object_id: u32 = "ObjectID",
        key repl_id: u32 = "ReplID",
        col x: f64 = "X",
        col y: f64 = "Y",
        col z: f64 = "Z",
        col ang: f64 = "Ang",
        col move_prob: u32 = "MoveProb",
        beyond name: String = "Name",
        beyond name_en: String = "NameEn",
    }
    /// Floors and flats (paper 2 §6).
    Paper Map = 19 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        col type_id: Option<u32> = "TypeID",
        col size_x: f64 = "SizeX",
        col size_y: f64 = "SizeY",
        col height: f64 = "Hieght",
        beyond key: String = "Key",
        beyond name_en: String = "NameEn",
        beyond frame: String = "Frame",
    }
    /// Types of Maps: «Квартира».
    Paper MapTypeList = 20 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        beyond name_en: String = "NameEn",
        beyond gender: String = "Gender",
        beyond animate: bool = "Animate",
    }
    /// The Areas of a Map. An Area stands in one Map once, so its id serves as `ItemID`; `OrFrID` is that of
    /// its base item.
    Paper MapItems = 21 {
        key map_id: u32 = "MapID",
        key item_id: u32 = "ItemID",
        col area_id: u32 = "AreaID",
        col or_fr_id: u32 = "OrFrID",
        col pos_x: f64 = "PosX",
        col pos_y: f64 = "PosY",
        col pos_z: f64 = "PosZ",
        col pos_a: f64 = "PosA",
        col base: bool = "Base",
        beyond no: u32 = "No",
    }
    /// Links between sides of the Areas of a Map. The paper names a side by its Orthoframe, which may serve
    /// an Area more than once; hence the items.
    Paper MapItemLinks = 22 {
        key map_id: u32 = "MapID",
        key item_id: u32 = "ItemID",
        key item_id2: u32 = "ItemID2",
        col area_id: u32 = "AreaID",
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        col area_id2: u32 = "AreaID2",
        key or_fr_id2: u32 = "OrFrID2",
        key side_id2: String = "SideID2",
        col rel_x: f64 = "RelX",
        col rel_y: f64 = "RelY",
        col rel_a: f64 = "RelA",
        col rel_z: f64 = "RelZ",
        beyond_key area_item_id: String = "AreaItemID",
        beyond_key area_item_id2: String = "AreaItemID2",
        beyond no: u32 = "No",
    }
    /// Buildings.
    Paper Domain = 23 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        beyond key: String = "Key",
        beyond name_en: String = "NameEn",
        // Empty: surveyed.
        beyond profile: String = "Profile",
    }
    /// The Maps of a Domain.
    Paper DomainMaps = 24 {
        key domain_id: u32 = "DomainID",
        key map_id: u32 = "MapID",
        col pos_x: f64 = "PosX",
        col pos_y: f64 = "PosY",
        col pos_z: f64 = "PosZ",
        col pos_a: f64 = "PosA",
        col base: bool = "Base",
        beyond no: u32 = "No",
    }
    /// Doors (paper 2 §7).
    Paper Door = 25 {
        key id: u32 = "ID",
        col type_id: Option<u32> = "TypeID",
        col side_count: u32 = "SideCount",
        col width: f64 = "Width",
        col height: f64 = "Height",
        beyond key: String = "Key",
        beyond name: String = "Name",
        beyond name_en: String = "NameEn",
        beyond kind: String = "Kind",
        beyond status: String = "Status",
        beyond opening: f64 = "Opening",
    }
    /// Types of Doors: «Распашная».
    Paper DoorTypeList = 26 {
        key id: u32 = "ID",
        col name: String = "Name",
        col desc: String = "Desc",
        beyond name_en: String = "NameEn",
        beyond gender: String = "Gender",
        beyond animate: bool = "Animate",
    }
    /// Leaves of doors. `JointSide`: 0 right, 1 left.
    Paper DoorSides = 27 {
        key door_id: u32 = "DoorID",
        key side_id: u32 = "SideID",
        col joint_side: u32 = "JointSide",
        col side_part: f64 = "SidePart",
        col thick: f64 = "Thick",
        col max_open: f64 = "MaxOpen",
    }
    /// All sides of an Object's items, in the Object's frame.
    Derived ObjectItemSides = 28 {
        key object_id: u32 = "ObjectID",
        key item_id: String = "ItemID",
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        col side_type_id: Option<u32> = "SideTypeID",
        col side_pntr: u32 = "SidePntr",
        col base: bool = "Base",
        col x1: f64 = "X1",
        col y1: f64 = "Y1",
        col x2: f64 = "X2",
        col y2: f64 = "Y2",
        col len: f64 = "Len",
        col ang: f64 = "Ang",
        col z: f64 = "Z",
        col height: f64 = "Hieght",
    }
    /// All sides of an Area's items, in the Area's frame.
    Derived AreaItemSides = 29 {
        key area_id: u32 = "AreaID",
        key item_id: String = "ItemID",
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        col side_type_id: Option<u32> = "SideTypeID",
        col side_pntr: u32 = "SidePntr",
        col base: bool = "Base",
        col x1: f64 = "X1",
        col y1: f64 = "Y1",
        col x2: f64 = "X2",
        col y2: f64 = "Y2",
        col len: f64 = "Len",
        col ang: f64 = "Ang",
        col z: f64 = "Z",
        col height: f64 = "Hieght",
    }
    /// All sides of the replicas of a Fragment, in the Area's frame.
    Derived AreaObjectSides = 30 {
        key area_id: u32 = "AreaID",
        key object_id: u32 = "ObjectID",
        key repl_id: u32 = "ReplID",
        key item_id: String = "ItemID",
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        col side_type_id: Option<u32> = "SideTypeID",
        col side_pntr: u32 = "SidePntr",
        col base: bool = "Base",
        col x1: f64 = "X1",
        col y1: f64 = "Y1",
        col x2: f64 = "X2",
        col y2: f64 = "Y2",
        col len: f64 = "Len",
        col ang: f64 = "Ang",
        col z: f64 = "Z",
        col height: f64 = "Hieght",
    }
    /// All sides of the Areas of a Map, in the Map's frame.
    Derived MapItemSides = 31 {
        key map_id: u32 = "MapID",
        key item_id: u32 = "ItemID",
        key area_id: u32 = "AreaID",
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        col side_type_id: Option<u32> = "SideTypeID",
        col side_pntr: u32 = "SidePntr",
        col base: bool = "Base",
        col x1: f64 = "X1",
        col y1: f64 = "Y1",
        col x2: f64 = "X2",
        col y2: f64 = "Y2",
        col len: f64 = "Len",
        col ang: f64 = "Ang",
        col z: f64 = "Z",
        col height: f64 = "Hieght",
        beyond_key area_item_id: String = "AreaItemID",
    }
    /// What people call a side: «Парадный вход».
    Beyond SideNames = 40 {
        key or_fr_id: u32 = "OrFrID",
        key side_id: String = "SideID",
        key no: u32 = "No",
        col name: String = "Name",
    }
    Beyond ObjectProperties = 41 {
        key object_id: u32 = "ObjectID",
        key prop: String = "Prop",
        col prop_val: String = "PropVal",
    }
    Beyond AreaProperties = 42 {
        key area_id: u32 = "AreaID",
        key prop: String = "Prop",
        col prop_val: String = "PropVal",
    }
    Beyond DoorProperties = 43 {
        key door_id: u32 = "DoorID",
        key prop: String = "Prop",
        col prop_val: String = "PropVal",
    }
    Beyond ReplicaProperties = 44 {
        key repl_id: u32 = "ReplID",
        key prop: String = "Prop",
        col prop_val: String = "PropVal",
    }
    /// States of an Object's doors on one replica.
    Beyond ReplicaDoors = 45 {
        key repl_id: u32 = "ReplID",
        key door_id: u32 = "DoorID",
        col status: String = "Status",
        col opening: f64 = "Opening",
    }
    /// Synonyms and traits of the entries of the type lists. `List` is the list's table, `Role` the word's.
    Beyond TypeWords = 46 {
        key list: String = "List",
        key type_id: u32 = "TypeID",
        key role: String = "Role",
        key no: u32 = "No",
        col word: String = "Word",
    }
    /// Word forms given by hand. `Kind` is the table in which the named thing stands.
    Beyond NameForms = 47 {
        key kind: String = "Kind",
        key id: u32 = "ID",
        key case: String = "Case",
        col form: String = "Form",
    }
    /// Named places to stand.
    Beyond Places = 48 {
        key area_id: u32 = "AreaID",
        key place_id: u32 = "PlaceID",
        col name: String = "Name",
        col name_en: String = "NameEn",
        col x: f64 = "X",
        col y: f64 = "Y",
        col ang: Option<f64> = "Ang",
        col serves: Option<u32> = "ServesReplID",
    }
    /// Lifts and stairs.
    Beyond Lifts = 49 {
        key domain_id: u32 = "DomainID",
        key lift_no: u32 = "LiftNo",
        col name: String = "Name",
    }
    Beyond LiftStops = 50 {
        key domain_id: u32 = "DomainID",
        key lift_no: u32 = "LiftNo",
        key stop_no: u32 = "StopNo",
        col area_id: u32 = "AreaID",
    }
    /// The robot that works in the Domain.
    Beyond Robot = 51 {
        key domain_id: u32 = "DomainID",
        col radius: f64 = "Radius",
        col height: f64 = "Height",
        col step: f64 = "Step",
        col clearance: f64 = "Clearance",
        col speed: f64 = "Speed",
        col turn_rate: f64 = "TurnRate",
        col start: Option<u32> = "StartPlaceID",
        // Corners, "x,y x,y …"; empty for a disc.
        col footprint: String = "Footprint",
        col opens: bool = "Opens",
    }
    /// Regions of the floor with rules of their own. Their places: points here, or Areas in `ZoneAreas`.
    Beyond Zones = 52 {
        key zone_id: u32 = "ZoneID",
        col key: String = "Key",
        col name: String = "Name",
        col name_en: String = "NameEn",
        // keep-out, closed, slow, one-way
        col kind: String = "Kind",
        // cm/s of a slow zone, degrees of a one-way one.
        col measure: f64 = "Measure",
        col map_id: Option<u32> = "MapID",
        // Corners, "x,y x,y …"; empty where it is made of Areas.
        col points: String = "Points",
        col reason: String = "Reason",
        col reason_en: String = "ReasonEn",
        // Moments; empty where it has none.
        col starts: String = "StartsAt",
        col ends: String = "EndsAt",
    }
    Beyond ZoneAreas = 53 {
        key zone_id: u32 = "ZoneID",
        key no: u32 = "No",
        col area_id: u32 = "AreaID",
    }
    /// Where the robot stood last. `RecDate` says when, `RecUser` who said so.
    Log RobotPose = 60 {
        key robot_id: u32 = "RobotID",
        col map_id: u32 = "MapID",
        col x: f64 = "X",
        col y: f64 = "Y",
        col ang: f64 = "Ang",
    }
    /// What was seen of a replica (D5): at a place, or not where it was expected.
    Log Observations = 61 {
        key repl_id: u32 = "ReplID",
        key at: i64 = "At",
        key no: u32 = "No",
        col seen: bool = "Seen",
        col area_id: u32 = "AreaID",
        col x: f64 = "X",
        col y: f64 = "Y",
        col z: f64 = "Z",
        col ang: f64 = "Ang",
        col sure: f64 = "Sure",
        col observer: String = "Observer",
    }
    /// Every change of the map: who and when stand in its `RecUser` and `RecDate`.
    Log Revisions = 62 {
        key revision: u32 = "Revision",
        col kind: String = "Kind",
        col reason: String = "Reason",
        col undoes: Option<u32> = "Undoes",
        col created: u32 = "CreatedCount",
        col changed: u32 = "ChangedCount",
        col deleted: u32 = "DeletedCount",
    }
    /// The highest id ever given in a table, so that none is given twice.
    Log LastIds = 63 {
        key kind: String = "Kind",
        col last_id: u32 = "LastID",
    }
    /// What a person said of the observations up to a moment: that they are wrong. Of those of the very moment it speaks
    /// of the first `Same`.
    Log Verdicts = 64 {
        key repl_id: u32 = "ReplID",
        key at: i64 = "At",
        col verdict: String = "Verdict",
        col reason: String = "Reason",
        col same: u32 = "Same",
    }
    /// Doors that stand otherwise than the map says, as the robot saw or left them.
    Log DoorStates = 65 {
        key door_id: u32 = "DoorID",
        col status: String = "Status",
        col opening: f64 = "Opening",
    }
    /// What the robot took off the map: in its hand, where `Holder` is empty, or given to that person.
    Log Carried = 66 {
        key repl_id: u32 = "ReplID",
        col holder: String = "Holder",
    }
    /// Devices that the robot left switched otherwise than the map says.
    Log DeviceStates = 67 {
        key repl_id: u32 = "ReplID",
        col is_on: bool = "IsOn",
    }
    /// What all that was seen of a replica came to, so that it need not be gone through again: see `observe`.
    Log Beliefs = 68 {
        key repl_id: u32 = "ReplID",
        // Of the last of all that was seen, counted or not.
        col newest: i64 = "Newest",
        // The revision in which the place was written down from which this began.
        col survey: u32 = "Survey",
        col area_id: u32 = "AreaID",
        col x: f64 = "X",
        col y: f64 = "Y",
        col z: f64 = "Z",
        col ang: f64 = "Ang",
        col confidence: f64 = "Confidence",
        col at: i64 = "At",
        col since: i64 = "Since",
        col last_seen: Option<i64> = "LastSeen",
        col missed: Option<i64> = "Missed",
    }
    /// What was seen to stand where the map has nothing. `At` says when it was seen, `RecDate` when it was last noted.
    Log Obstacles = 69 {
        key no: u32 = "No",
        col area_id: u32 = "AreaID",
        // Convex pieces, "x,y x,y …", one after the other with ";" between.
        col pieces: String = "Pieces",
        col top: f64 = "Top",
        col at: i64 = "At",
        col sure: f64 = "Sure",
    }
    /// How the robot's laser told where it stood last: one row for each pose that fitted, the best first.
    Log FoundPoses = 70 {
        key no: u32 = "No",
        col map_id: u32 = "MapID",
        col x: f64 = "X",
        col y: f64 = "Y",
        col ang: f64 = "Ang",
        col off: f64 = "Off",
        col off_ang: f64 = "OffAng",
        col explained: f64 = "Explained",
        col at: i64 = "At",
    }
    /// Things with doors, lids or drawers that the robot left otherwise than the map says: whether they stand open.
    Log OpenStates = 71 {
        key repl_id: u32 = "ReplID",
        col is_open: bool = "IsOpen",
    }
    /// Tasks that are to be done, in their order. `RecUser` gave them, `RecDate` is when they were noted last.
    Log Tasks = 72 {
        key no: u32 = "No",
        col task_id: u32 = "TaskID",
        col text: String = "Text",
        col by: String = "By",
        col at: i64 = "At",
        // waiting, begun
        col state: String = "State",
        // Where the person stood who gave it, and is brought what is to be brought.
        col map_id: Option<u32> = "MapID",
        col x: f64 = "X",
        col y: f64 = "Y",
    }
    /// Whether the tasks wait: one row while they do.
    Log Pause = 73 {
        key robot_id: u32 = "RobotID",
        col at: i64 = "At",
    }
}

impl Table {
    /// Whether a change of this table is a change of the map, which makes a new revision.
    #[must_use]
    pub fn is_map(self) -> bool {
        matches!(self.origin(), Origin::Paper | Origin::Beyond)
    }

    /// Whether records of this table are kept in the store.
    #[must_use]
    pub fn is_stored(self) -> bool {
        self.origin() != Origin::Derived
    }

    #[must_use]
    pub fn code(self) -> u8 {
        self as u8
    }

    #[must_use]
    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.iter().copied().find(|table| table.code() == code)
    }

    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|table| table.name() == name)
    }
}

#[cfg(test)]
mod tests;
