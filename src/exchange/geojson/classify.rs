//! What a feature is: by IMDF's types, by OpenStreetMap's indoor tags, else by the words people use for fields.

use super::feature::{Feature, Shape};

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Class {
    /// With the file's word for what kind of room it is.
    Room(String),
    Door,
    Passage,
    Window,
    Thing(String),
    /// A named point.
    Spot,
    /// A storey as a record of its own.
    Level,
    /// The building or venue.
    Building,
    /// Says who uses a room.
    Occupant,
    /// Joins rooms of different storeys.
    Relationship,
    /// A body of the building: wall, slab. What is between rooms is wall already.
    Structure,
    Column,
    /// Not for a robot: address, footprint, drawing lines.
    Silent,
    Unknown,
}

/// Fields that say what a feature is, the most telling first.
const KIND_FIELDS: [&str; 13] = [
    "feature_type",
    "indoor",
    "class",
    "kind",
    "type",
    "layer",
    "category",
    "element",
    "object_type",
    "use_type",
    "usage",
    "тип",
    "вид",
];
/// Fields that say what kind of room a room is.
const ROOM_FIELDS: [&str; 9] = [
    "room",
    "room_type",
    "category",
    "use_type",
    "usage",
    "use",
    "function",
    "назначение",
    "highway",
];
const DOORS: [&str; 9] =
    ["door", "doorway", "entrance", "exit", "gate", "tür", "tuer", "porte", "дверь"];
const PASSAGES: [&str; 5] = ["opening", "passage", "portal", "проём", "проход"];
const ROOMS: [&str; 26] = [
    "room",
    "area",
    "corridor",
    "unit",
    "space",
    "hall",
    "hallway",
    "zone",
    "office",
    "lobby",
    "kitchen",
    "bathroom",
    "toilet",
    "toilets",
    "stairs",
    "staircase",
    "elevator",
    "lift",
    "lab",
    "laboratory",
    "storage",
    "raum",
    "flur",
    "помещение",
    "комната",
    "коридор",
];
const THINGS: [&str; 20] = [
    "fixture",
    "furniture",
    "kiosk",
    "desk",
    "table",
    "chair",
    "bed",
    "sofa",
    "shelf",
    "cabinet",
    "wardrobe",
    "machine",
    "equipment",
    "counter",
    "bench",
    "мебель",
    "стол",
    "стул",
    "шкаф",
    "кровать",
];
const SILENT: [&str; 13] = [
    "address",
    "footprint",
    "geofence",
    "section",
    "detail",
    "site",
    "manifest",
    "outline",
    "label",
    "grid",
    "dimension",
    "route",
    "path",
];

fn is_one(word: &str, of: &[&str]) -> bool {
    of.iter().any(|w| word == *w || word.strip_suffix('s') == Some(*w))
}

pub(super) fn class(feature: &Feature) -> Class {
    if !feature.feature_type.is_empty() {
        return imdf(feature);
    }
    let is_polygon = matches!(feature.shape, Some(Shape::Polygons(_)));
    let word = |key: &str| feature.text(key).map(|w| w.to_lowercase());
    let kind = feature.first(&KIND_FIELDS).map(|w| w.to_lowercase()).unwrap_or_default();
    let room_word = || {
        let word = feature.first(&ROOM_FIELDS).filter(|w| !["yes", "no"].contains(&&**w));
        let amenity = feature.text("amenity").or_else(|| feature.text("shop"));
        let stairs = ["stairs", "elevator"].into_iter().find(|k| word_is_yes(feature, k));
        word.map(std::borrow::Cow::into_owned)
            .or_else(|| stairs.map(str::to_owned))
            .or_else(|| amenity.map(std::borrow::Cow::into_owned))
            .unwrap_or_else(|| kind.clone())
    };
    if !is_polygon {
        let door = word("door").or_else(|| word("entrance"));
        return match door.as_deref() {
            Some("no") => Class::Passage,
            Some(_) => Class::Door,
            None if is_one(&kind, &DOORS) => Class::Door,
            None if is_one(&kind, &PASSAGES) => Class::Passage,
            None if is_one(&kind, &["window", "окно"]) => Class::Window,
            None if is_one(&kind, &SILENT) || is_one(&kind, &["wall", "corridor"]) => Class::Silent,
            None if matches!(feature.shape, Some(Shape::Points(_))) => Class::Spot,
            None => Class::Unknown,
        };
    }
    match kind.as_str() {
        "level" | "floor" | "storey" | "story" | "этаж" => Class::Level,
        "building" | "venue" | "facility" | "здание" => Class::Building,
        "wall" | "walls" | "slab" | "стена" => Class::Structure,
        "column" | "pillar" | "колонна" => Class::Column,
        "window" | "окно" => Class::Window,
        "no" => Class::Silent,
        "stair" => Class::Room("stairs".to_owned()),
        k if is_one(k, &DOORS) => Class::Door,
        k if is_one(k, &PASSAGES) => Class::Passage,
        k if is_one(k, &THINGS) => Class::Thing(thing_word(feature, k)),
        k if is_one(k, &SILENT) => Class::Silent,
        k if is_one(k, &ROOMS) => Class::Room(room_word()),
        _ if word("building").is_some() && word("indoor").is_none() => Class::Building,
        // A polygon that says nothing of itself is most likely what the file is about: a room.
        _ => Class::Room(room_word()),
    }
}

fn word_is_yes(feature: &Feature, key: &str) -> bool {
    feature.text(key).is_some_and(|v| v == "yes")
        || feature.text("highway").is_some_and(|v| v == key || (v == "steps" && key == "stairs"))
}

/// The narrowest word that tells what a piece of furniture is.
fn thing_word(feature: &Feature, kind: &str) -> String {
    ["furniture", "fixture", "category", "type", "object", "вид"]
        .iter()
        .filter_map(|key| feature.text(key))
        .find(|w| w != "yes" && !w.eq_ignore_ascii_case(kind))
        .map_or_else(|| kind.to_owned(), std::borrow::Cow::into_owned)
}

/// Categories of IMDF units that are bodies, not rooms.
const SOLID: [&str; 6] = ["brick", "concrete", "drywall", "glass", "wood", "structure"];

/// The feature types of IMDF, which are also the names of an archive's files.
pub(super) const IMDF_TYPES: [&str; 16] = [
    "address",
    "amenity",
    "anchor",
    "building",
    "detail",
    "fixture",
    "footprint",
    "geofence",
    "kiosk",
    "level",
    "occupant",
    "opening",
    "relationship",
    "section",
    "unit",
    "venue",
];

fn imdf(feature: &Feature) -> Class {
    let category = feature.text("category").map(|c| c.to_lowercase()).unwrap_or_default();
    match feature.feature_type.as_str() {
        "venue" | "building" => Class::Building,
        "level" => Class::Level,
        "unit" if category == "column" => Class::Column,
        "unit" if SOLID.contains(&category.as_str()) => Class::Structure,
        "unit" if category == "opentobelow" => Class::Silent,
        "unit" => Class::Room(category),
        "opening" => Class::Door,
        "fixture" if category == "wall" => Class::Structure,
        "fixture" => {
            Class::Thing(if category.is_empty() { "fixture".to_owned() } else { category })
        }
        "kiosk" => Class::Thing("kiosk".to_owned()),
        "amenity" | "anchor" => Class::Spot,
        "occupant" => Class::Occupant,
        "relationship" => Class::Relationship,
        "address" | "footprint" | "geofence" | "section" | "detail" | "manifest" => Class::Silent,
        _ => Class::Unknown,
    }
}
