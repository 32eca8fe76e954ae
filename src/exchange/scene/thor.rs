//! Scene metadata as AI2-THOR's controller returns it: one room, things with boxes in the frame of the building.
//!
//! `event.metadata` with `objects`, each with `axisAlignedBoundingBox` (`center`, `size`) and, for what can be taken in
//! hand, `objectOrientedBoundingBox` (`cornerPoints`). There are no rooms in it: the floor's box, or the scene's, is the
//! one room; the number of the scene tells its kind.

use serde_json::Value;

use crate::map::Properties;
use crate::units::{Cm, Deg, Point, Source, word};
use crate::{Level, ReadError, Remark, Room, Spot, Survey};

use super::colour;
use super::json::{angles, length, list, parse, plan, remark, text, triple};
use super::shape::rectangle;
use super::stock::{Facing, Piece, Shelf, shelve, state};

const FORMAT: &str = "AI2-THOR";
/// What is part of the building.
const STRUCTURE: [&str; 6] = ["Floor", "Wall", "Ceiling", "Window", "Doorway", "Room"];

fn metadata(value: &Value) -> &Value {
    value.get("metadata").filter(|m| m.get("objects").is_some()).unwrap_or(value)
}

/// Reads the metadata of a scene.
///
/// # Errors
/// [`ReadError::Syntax`]; [`ReadError::NoBuilding`] when neither floor nor scene has a box.
pub fn read_thor(source: &Source) -> Result<Survey, ReadError> {
    let value = parse(FORMAT, source)?;
    let scene = metadata(&value);
    let objects = list(scene, "objects");
    let floor = objects.iter().filter(|o| text(o, "objectType") == Some("Floor"));
    let floors: Vec<Box3> =
        floor.filter_map(|o| Box3::of(o.get("axisAlignedBoundingBox")?)).collect();
    let bounds = scene.get("sceneBounds").and_then(Box3::of);
    let Some(first) = floors.first().copied().or(bounds) else {
        let what = word!("there-is-neither-a-floor").into();
        return Err(ReadError::NoBuilding { format: FORMAT, what });
    };
    let room = floors.iter().fold(first, |b, f| b.union(f));
    let ceiling = bounds.map(|b| b.high[1] - room.low[1]).filter(|h| *h > 100.0);
    let mut remarks: Vec<Remark> = Vec::new();
    let mut pieces = Vec::new();
    for object in objects {
        let id = text(object, "objectId").or_else(|| text(object, "name")).unwrap_or_default();
        let word = text(object, "objectType").unwrap_or_default();
        if STRUCTURE.contains(&word) {
            continue;
        }
        match piece(object, id, word) {
            Some(piece) => pieces.push(piece),
            None => remarks.push(remark(id, word!("the-thing-is-left-out-the-box"))),
        }
    }
    let Shelf { kinds, things, feet } = shelve(pieces);
    let agent = scene.get("agent").and_then(|a| {
        let heading = Deg::of(90.0 - angles(a.get("rotation"))[1]);
        let at = plan(triple(a.get("position"))?);
        let (name, kind) = (String::new(), String::new());
        let (source, heading) = ("agent".to_owned(), Some(heading));
        Some(Spot { source, name, kind, at, heading, is_start: true })
    });
    let scene_name = text(scene, "sceneName").unwrap_or_default();
    let level = Level {
        source: "0".to_owned(),
        rooms: vec![Room {
            source: scene_name.to_owned(),
            kind: room_kind(scene_name).to_owned(),
            outline: rectangle(room.low[0], room.low[2], room.high[0], room.high[2]),
            height: ceiling.map(Cm::of),
            ..Room::default()
        }],
        things,
        spots: agent.into_iter().collect(),
        ..Level::default()
    };
    Ok(Survey { levels: vec![level], kinds, feet, remarks, ..Survey::default() })
}

/// By the number of the scene: 1-30 kitchens, 201-230 living rooms, 301-330 bedrooms, 401-430 bathrooms.
fn room_kind(scene: &str) -> &'static str {
    let digits: String = scene
        .trim_start_matches("FloorPlan")
        .chars()
        .take_while(char::is_ascii_digit)
        .take(4)
        .collect();
    match digits.parse::<u16>().ok().map(|n| n / 100) {
        Some(0) => "Kitchen",
        Some(2) => "LivingRoom",
        Some(3) => "Bedroom",
        Some(4) => "Bathroom",
        _ => "Room",
    }
}

#[derive(Debug, Clone, Copy)]
struct Box3 {
    low: [f64; 3],
    high: [f64; 3],
}

impl Box3 {
    fn of(record: &Value) -> Option<Self> {
        let (centre, size) = (triple(record.get("center"))?, triple(record.get("size"))?);
        let at = |sign: f64| std::array::from_fn(|i| centre[i] + sign * size[i].abs() / 2.0);
        Some(Self { low: at(-1.0), high: at(1.0) })
    }

    fn union(&self, other: &Self) -> Self {
        Self {
            low: std::array::from_fn(|i| self.low[i].min(other.low[i])),
            high: std::array::from_fn(|i| self.high[i].max(other.high[i])),
        }
    }
}

fn piece(object: &Value, id: &str, word: &str) -> Option<Piece> {
    let turn = angles(object.get("rotation"));
    let corners: Vec<[f64; 3]> = object
        .get("objectOrientedBoundingBox")
        .map(|b| list(b, "cornerPoints"))
        .unwrap_or_default()
        .iter()
        .filter_map(corner)
        .collect();
    let own = corners.len() == 8;
    let (angle, low, high) = if own {
        // Along the thing's own axes: turned back by its rotation about y.
        let (sin, cos) = turn[1].to_radians().sin_cos();
        let back = |[x, y, z]: [f64; 3]| [x * cos - z * sin, y, x * sin + z * cos];
        let turned = corners.into_iter().map(back);
        let edge = |pick: fn(f64, f64) -> f64, from: f64| {
            turned.clone().fold([from; 3], |m, c| std::array::from_fn(|i| pick(m[i], c[i])))
        };
        (-turn[1], edge(f64::min, f64::INFINITY), edge(f64::max, f64::NEG_INFINITY))
    } else {
        let b = Box3::of(object.get("axisAlignedBoundingBox")?)?;
        (0.0, b.low, b.high)
    };
    let half: [f64; 3] = std::array::from_fn(|i| (high[i] - low[i]) / 2.0);
    let middle = Point::new((low[0] + high[0]) / 2.0, (low[2] + high[2]) / 2.0);
    let (sin, cos) = f64::to_radians(angle).sin_cos();
    let at = Point::new(middle.x * cos - middle.y * sin, middle.x * sin + middle.y * cos);
    let flag = |can: &str, is: &str| {
        let able = object.get(can).and_then(Value::as_bool) != Some(false);
        object.get(is).and_then(Value::as_bool).filter(|_| able)
    };
    let mut properties = Properties::new();
    state(flag("openable", "isOpen"), flag("toggleable", "isToggled"), &mut properties);
    if let Some(dirty) = flag("dirtyable", "isDirty") {
        properties
            .insert("ЧИСТОТА".to_owned(), if dirty { "Грязное" } else { "Чистое" }.to_owned());
    }
    let materials = list(object, "salientMaterials").iter().filter_map(Value::as_str);
    if let Some(material) = materials.into_iter().find_map(colour::material) {
        properties.insert("МАТЕРИАЛ".to_owned(), material.to_owned());
    }
    let can = |what: &str| object.get(what).and_then(Value::as_bool) == Some(true);
    let fixed = object.get("pickupable").is_some() && !can("pickupable") && !can("moveable");
    Some(Piece {
        source: id.to_owned(),
        kind: format!("{word}@{:.1}x{:.1}x{:.1}", half[0] * 2.0, half[2] * 2.0, half[1] * 2.0),
        word: word.to_owned(),
        at,
        bottom: low[1],
        angle,
        half: [half[0], half[2]],
        bay: None,
        height: half[1] * 2.0,
        facing: if own { Facing::Own } else { Facing::Unknown },
        move_prob: fixed.then_some(0),
        kind_properties: Properties::new(),
        properties,
    })
}

/// `[x, y, z]` in metres.
fn corner(value: &Value) -> Option<[f64; 3]> {
    let [x, y, z] = value.as_array()?.as_slice() else { return None };
    Some([length(x)?, length(y)?, length(z)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_box_keeps_its_size_and_its_place() {
        // 20 x 10 cm, turned by 45° clockwise about (1 m, 2 m).
        let (w, d) = (0.1, 0.05);
        let corners: Vec<Value> = [(-w, -d), (w, -d), (w, d), (-w, d)]
            .into_iter()
            .flat_map(|(x, z)| [0.7, 0.8].map(|y| (x, y, z)))
            .map(|(x, y, z)| {
                let s = std::f64::consts::FRAC_1_SQRT_2;
                serde_json::json!([1.0 + x * s + z * s, y, 2.0 - x * s + z * s])
            })
            .collect();
        let object = serde_json::json!({
            "rotation": {"x": 0, "y": 45, "z": 0},
            "objectOrientedBoundingBox": {"cornerPoints": corners},
        });
        let found = piece(&object, "Book|1", "Book").expect("it has a box");
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-6, "{a} {b}");
        near(found.half[0], 10.0);
        near(found.half[1], 5.0);
        near(found.at.x, 100.0);
        near(found.at.y, 200.0);
        near(found.bottom, 70.0);
        near(found.angle, -45.0);
    }
}
