//! GeoJSON of buildings → [`Survey`]: IMDF (OGC 20-094), OpenStreetMap's Simple Indoor Tagging, and plain files whose
//! polygons are rooms.
//!
//! IMDF comes as a folder of `*.geojson`, one file a feature type, or as one collection of all. A feature says what it
//! is by `feature_type`, by `indoor=room`, or by a field such as `type` or `class`; a polygon that says nothing is a
//! room. Coordinates may be degrees, metres, centimetres or millimetres; what was assumed stands in the remarks.
//!
//! ```
//! use orthoframe_exchange::geojson;
//! use orthoframe_units::Source;
//!
//! let text = r#"{"type": "FeatureCollection", "features": [{"type": "Feature", "id": "r1",
//!     "properties": {"name": "Кухня", "level": "0"},
//!     "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 3], [0, 3], [0, 0]]]}}]}"#;
//! let survey = geojson::read(&Source::new("flat.geojson", text))?;
//! assert_eq!(survey.levels[0].rooms[0].name, "Кухня");
//! assert_eq!(survey.levels[0].rooms[0].outline[2], orthoframe_units::Point::new(400.0, 300.0));
//! # Ok::<(), orthoframe_exchange::ReadError>(())
//! ```

mod classify;
mod doors;
pub(super) mod feature;
mod ground;
mod levels;
mod lifts;
mod names;
mod things;

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

use crate::map::Properties;
use crate::units::{
    Bilingual, Cm, Gather as _, InOrder as _, Language, Piece, Point, Source, said, word,
};

use super::{ReadError, Remark, Room, Spot, Survey, input, outline};
use classify::{Class, class};
use feature::{FORMAT, Feature, Shape, Surroundings};
use ground::Ground;
use levels::Levels;
use names::Tongue;
use things::Things;

/// Rooms of one file.
const MOST_ROOMS: usize = 200_000;
/// Properties that are kept of one feature.
const MOST_PROPERTIES: usize = 32;

/// Reads one GeoJSON text.
///
/// # Errors
/// [`ReadError::Syntax`] when it is no JSON, [`ReadError::NoBuilding`] when it has no room,
/// [`ReadError::TooMany`] when it has more than any building.
pub fn read(source: &Source) -> Result<Survey, ReadError> {
    let mut remarks = Vec::new();
    let (around, features) = feature::features(source, &mut remarks)?;
    survey(source.name(), &around, &features, remarks)
}

/// Whether a text says that it is GeoJSON. Looks at its beginning only.
#[must_use]
pub fn recognises(text: &str) -> bool {
    let mut end = text.len().min(4096);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let head: String = text[..end].chars().filter(|c| !c.is_whitespace()).collect();
    head.starts_with('{')
        && (head.contains("\"FeatureCollection\"")
            || head.contains("\"features\":[")
            || head.contains("\"type\":\"Feature\""))
}

/// Whether a folder holds an IMDF archive: `unit.geojson` or `level.geojson`.
#[must_use]
pub fn recognises_folder(dir: &Path) -> bool {
    ["unit.geojson", "level.geojson"].iter().any(|name| dir.join(name).is_file())
}

/// Reads a folder of GeoJSON files as one building: an IMDF archive, unpacked.
///
/// # Errors
/// As [`read`], and whatever the file system says.
pub fn read_folder(dir: &Path) -> Result<Survey, ReadError> {
    let entries = std::fs::read_dir(dir).map_err(ReadError::unreadable(dir))?;
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.map_err(ReadError::unreadable(dir))?.path();
        let ending = path.extension().and_then(|e| e.to_str()).map(str::to_lowercase);
        if ending.as_deref() == Some("geojson") {
            files.push(path);
        }
    }
    // The order of a folder is the file system's; that of the names is the same everywhere.
    files.order();
    let (mut all, mut remarks) = (Vec::new(), Vec::new());
    let (mut around, mut bytes) = (Surroundings::default(), 0);
    for path in files {
        let source = input::file_text(&path)?;
        bytes += source.text().len() as u64;
        if bytes > input::LARGEST {
            return Err(ReadError::TooLarge { bytes, limit: input::LARGEST });
        }
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let (own, features) = match feature::features(&source, &mut remarks) {
            // One file of the archive may be empty of features; the others make the building.
            Err(ReadError::NoBuilding { what, .. }) => {
                remarks.push(Remark { source: stem, text: said!("file-left-out", what) });
                continue;
            }
            read => read?,
        };
        around.crs = if around.crs.is_empty() { own.crs } else { around.crs };
        around.units = if around.units.is_empty() { own.units } else { around.units };
        all.extend(features.into_iter().map(|mut f| {
            // In a folder a file's name says what is in it.
            let is_type = classify::IMDF_TYPES.contains(&stem.as_str());
            if f.feature_type.is_empty() && is_type {
                f.feature_type.clone_from(&stem);
            }
            f
        }));
    }
    let name = dir.file_name().unwrap_or_default().to_string_lossy().into_owned();
    survey(&name, &around, &all, remarks)
}

fn survey(
    name: &str,
    around: &Surroundings,
    features: &[Feature],
    remarks: Vec<Remark>,
) -> Result<Survey, ReadError> {
    let classes: Vec<Class> = features.iter().map(class).collect();
    let is_imdf = features.iter().any(|f| !f.feature_type.is_empty());
    let rooms = || {
        features.iter().zip(&classes).filter(|(_, c)| matches!(c, Class::Room(_))).map(|(f, _)| f)
    };
    if rooms().count() > MOST_ROOMS {
        return Err(ReadError::TooMany { format: FORMAT, what: said!("rooms"), limit: MOST_ROOMS });
    }
    let positions = || features.iter().filter_map(|f| f.shape.as_ref()).flat_map(Shape::positions);
    let (ground, says) =
        Ground::of(around, is_imdf, positions(), rooms().filter_map(size).collect());
    let mut reader = Reader {
        ground,
        tongue: Tongue::of(features),
        levels: Levels::of(features, &classes),
        survey: Survey {
            name: building_name(name, around, features, &classes),
            remarks,
            ..Survey::default()
        },
        things: Things::default(),
        room_places: HashMap::new(),
        left_out: BTreeMap::new(),
    };
    reader.survey.frame = says.to_string();
    reader.remark("", says);
    if let Some(assumed) = reader.levels.assumed() {
        reader.remark("", assumed);
    }
    let names = reader.levels.list.iter().map(levels::Storey::level);
    reader.survey.levels = names.collect();
    for (feature, class) in features.iter().zip(&classes) {
        if let Class::Room(word) = class {
            reader.room(feature, word);
        }
    }
    reader.occupants(features, &classes);
    reader.doors(features, &classes)?;
    for (feature, class) in features.iter().zip(&classes) {
        match class {
            Class::Thing(word) => reader.thing(feature, word),
            Class::Column => reader.thing(feature, "column"),
            Class::Spot => reader.spot(feature),
            Class::Unknown | Class::Structure | Class::Silent => reader.count(feature, class),
            _ => {}
        }
    }
    reader.lifts(features, &classes);
    reader.finish()
}

/// The building's own name, else the file's.
fn building_name(
    file: &str,
    around: &Surroundings,
    features: &[Feature],
    classes: &[Class],
) -> String {
    let tongue = Tongue::of(features);
    let of = |f: &Feature| tongue.name(f).filter(|n| !n.is_empty());
    let buildings = || features.iter().zip(classes).filter(|(_, c)| **c == Class::Building);
    let venue = buildings().filter(|(f, _)| f.feature_type == "venue").find_map(|(f, _)| of(f));
    let stem = Path::new(file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    venue
        .or_else(|| buildings().find_map(|(f, _)| of(f)))
        .or_else(|| Some(around.name.clone()).filter(|n| !n.is_empty()))
        .unwrap_or(stem)
}

/// Side of a square as large as a room's bounding box.
fn size(feature: &Feature) -> Option<f64> {
    let Some(Shape::Polygons(polygons)) = &feature.shape else { return None };
    let points: Vec<Point> =
        polygons.first()?.first()?.iter().map(|p| Point::new(p[0], p[1])).collect();
    let (low, high) = outline::bounds(&points);
    let size = high - low;
    // What is no length tells nothing of the unit.
    Some((size.x * size.y).sqrt()).filter(|s| *s < 1e6)
}

struct Reader {
    ground: Ground,
    tongue: Tongue,
    levels: Levels,
    survey: Survey,
    things: Things,
    /// Where the room of a feature went: `(level, room)`.
    room_places: HashMap<String, Vec<(usize, usize)>>,
    /// What was left out without a word for each.
    left_out: BTreeMap<Cow<'static, str>, (Piece, usize)>,
}

impl Reader {
    fn remark(&mut self, source: &str, text: impl Into<Bilingual>) {
        self.survey.remarks.push(Remark { source: source.to_owned(), text: text.into() });
    }

    fn points(&self, positions: &[feature::Position]) -> Vec<Point> {
        positions.iter().map(|p| self.ground.place(*p)).collect()
    }

    /// The rings of a feature's polygons, in cm: outer and holes.
    fn rings(&mut self, feature: &Feature) -> Vec<(Vec<Point>, Vec<Vec<Point>>)> {
        let Some(Shape::Polygons(polygons)) = &feature.shape else { return Vec::new() };
        let mut parts = Vec::new();
        for polygon in polygons {
            let mut rings = polygon.iter().map(|ring| outline::ring(self.points(ring)));
            match rings.next().flatten() {
                Some(outer) if outer.len() <= outline::MOST_CORNERS => {
                    let holes = rings.flatten().filter(|h| h.len() <= outline::MOST_CORNERS);
                    parts.push((outer, holes.collect()));
                }
                Some(outer) => {
                    let text = said!("an-outline-of-corners-is", outer = outer.len());
                    self.remark(&feature.id, text);
                }
                None => self.remark(&feature.id, word!("the-outline-is-not-closed")),
            }
        }
        parts
    }

    fn room(&mut self, feature: &Feature, word: &str) {
        let parts = self.rings(feature);
        if parts.is_empty() && !matches!(feature.shape, Some(Shape::Polygons(_))) {
            return self.remark(&feature.id, word!("the-room-has-no-outline"));
        }
        let name = self.tongue.name(feature).unwrap_or_default();
        let height = feature.number(&["height", "room_height", "ceiling_height", "высота"]);
        // Metres, as OpenStreetMap and IMDF have them; what is no storey's height is not believed.
        let height = height.filter(|h| (1.0..=100.0).contains(h)).map(|h| Cm::of(h * 100.0));
        let several = parts.len() > 1;
        let storeys = self.levels.of_feature(feature);
        for &level in &storeys {
            for (no, (outline, holes)) in parts.iter().enumerate() {
                let mut source = feature.id.clone();
                if storeys.len() > 1 {
                    source += &format!("@{}", self.levels.list[level].key);
                }
                if several {
                    source += &format!("/{}", no + 1);
                }
                let rooms = &mut self.survey.levels[level].rooms;
                rooms.push(Room {
                    source,
                    name: name.clone(),
                    kind: word.to_owned(),
                    called: String::new(),
                    outline: outline.clone(),
                    holes: holes.clone(),
                    height,
                    properties: properties(feature),
                });
                let place = (level, rooms.len() - 1);
                self.room_places.entry(feature.id.clone()).or_default().push(place);
            }
        }
    }

    /// A shop's name goes to the unit in which its anchor stands, when the unit has none of its own.
    fn occupants(&mut self, features: &[Feature], classes: &[Class]) {
        let anchors: HashMap<&str, &Feature> = features
            .iter()
            .filter(|f| f.feature_type == "anchor")
            .map(|f| (f.id.as_str(), f))
            .collect();
        for (feature, _) in features.iter().zip(classes).filter(|(_, c)| **c == Class::Occupant) {
            let Some(name) = self.tongue.name(feature) else { continue };
            let unit = feature.text("anchor_id").and_then(|a| anchors.get(&*a)?.text("unit_id"));
            let places = unit.and_then(|u| self.room_places.get(&*u)).cloned().unwrap_or_default();
            if places.is_empty() {
                self.remark(&feature.id, said!("the-room-is-not-found", name));
            }
            for (level, room) in places {
                let room = &mut self.survey.levels[level].rooms[room];
                if room.name.is_empty() {
                    room.name.clone_from(&name);
                } else {
                    room.properties.insert("occupant".to_owned(), name.clone());
                }
            }
        }
    }

    fn spot(&mut self, feature: &Feature) {
        // An anchor bears no name: it only says where its occupant is.
        if feature.feature_type == "anchor" {
            return;
        }
        let Some(Shape::Points(points)) = &feature.shape else { return };
        let Some(&at) = points.first() else { return };
        let word = feature.first(&["category", "amenity", "type", "class", "kind"]);
        let kind = word.map(std::borrow::Cow::into_owned);
        let name = self.tongue.name(feature).or_else(|| kind.clone());
        let Some(name) = name else { return self.count(feature, &Class::Unknown) };
        let at = self.ground.place(at);
        if Cm::new(at.x).is_err() || Cm::new(at.y).is_err() {
            return self.remark(&feature.id, word!("the-point-s-coordinates-are"));
        }
        let heading = feature.number(&["heading", "direction", "yaw"]);
        let heading = heading.and_then(|h| crate::units::Deg::new(h).ok());
        for level in self.levels.of_feature(feature) {
            let (source, name) = (feature.id.clone(), name.clone());
            let kind = kind.clone().unwrap_or_default();
            let spot = Spot { source, name, kind, at, heading, is_start: false };
            self.survey.levels[level].spots.push(spot);
        }
    }

    fn count(&mut self, feature: &Feature, class: &Class) {
        let what = match (class, &feature.shape) {
            (Class::Structure, _) => word!("walls-and-structures-walls-stand"),
            (Class::Silent, _) => word!("addresses-outlines-of-buildings-ways"),
            (_, Some(Shape::Lines(_))) => {
                word!("lines-that-nothing-marks-as")
            }
            (_, Some(Shape::Points(_))) => word!("points-without-a-name"),
            _ => word!("records-of-an-unknown-kind"),
        };
        self.left_out.entry(what.say(Language::Russian)).or_insert((what, 0)).1 += 1;
    }

    fn finish(mut self) -> Result<Survey, ReadError> {
        self.things_of_parts();
        self.survey.kinds = self.things.kinds;
        for (what, count) in std::mem::take(&mut self.left_out).into_values() {
            let text = said!("left-out-counted", what, count);
            self.survey.remarks.push(Remark { source: String::new(), text });
        }
        if self.survey.levels.iter().all(|l| l.rooms.is_empty()) {
            let what = match self.survey.remarks.iter().find(|r| !r.source.is_empty()) {
                Some(r) => said!("no-room-since", source = r.source, why = r.text),
                None => said!("there-is-no-room"),
            };
            return Err(ReadError::NoBuilding { format: FORMAT, what });
        }
        Ok(self.survey)
    }
}

/// What a feature says beside its name and place, as far as it is words and numbers.
fn properties(feature: &Feature) -> Properties {
    const TOLD: [&str; 9] = [
        "name",
        "level",
        "level_id",
        "display_point",
        "alt_name",
        "height",
        "id",
        "geometry",
        "part_of",
    ];
    feature
        .properties
        .keys()
        .filter(|key| !TOLD.contains(&key.as_str()) && !key.is_empty() && key.len() <= 100)
        .filter_map(|key| Some((key.clone(), feature.text(key)?.into_owned())))
        .filter(|(_, value)| value.len() <= 500)
        .take(MOST_PROPERTIES)
        .chain(names::other_languages(feature))
        .collect()
}

/// The rooms' ids that IMDF refers to, once each.
fn ids(value: Option<&serde_json::Value>) -> BTreeSet<String> {
    let list = value.and_then(serde_json::Value::as_array).into_iter().flatten();
    list.filter_map(|v| v.get("id").unwrap_or(v).as_str()).map(str::to_owned).gather()
}
