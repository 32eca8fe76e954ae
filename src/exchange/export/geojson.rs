//! Floors as GeoJSON in IMDF's words: levels, units, openings, fixtures, places.
//!
//! Coordinates are metres in the Domain's frame, which the member `units` says; there is no place on the globe in a
//! map. Each floor is a `level` with its ordinal, counted from the base Map's height. Names stand in both languages.
//! What this program writes it also reads: see [`crate::geojson`].

use serde_json::{Map as Members, Value, json};

use crate::geometry::{FloorPlan, PlacedZone, Scene};
use crate::map::{self, Door, DoorKind, DoorStatus, HingeSide, TypeList, World, ZoneKind};
use crate::units::{AreaId, Cm, DoorId, Frame, Point, TypeId};

use super::{metre, metres, ring};

/// All floors of a world as one FeatureCollection.
///
/// # Panics
/// When the world refers to what it does not hold; a checked world does not.
#[must_use]
pub fn to_geojson<'a>(world: &World, floors: impl Iterator<Item = &'a FloorPlan>) -> String {
    let mut features = vec![feature(
        &format!("domain-{}", world.domain.id.0),
        "building",
        Value::Null,
        json!({ "name": label(&world.domain.name, &world.domain.name_en) }),
    )];
    for plan in floors {
        Floor::new(world, plan).write(&mut features);
    }
    let name = &world.domain.name;
    let file =
        json!({ "type": "FeatureCollection", "name": name, "units": "m", "features": features });
    serde_json::to_string_pretty(&file).expect("JSON can say it")
}

fn feature(id: &str, kind: &str, geometry: Value, properties: Value) -> Value {
    let mut feature = json!({ "type": "Feature", "id": id, "feature_type": kind });
    feature["geometry"] = geometry;
    feature["properties"] = properties;
    feature
}

fn label(name: &str, name_en: &str) -> Value {
    let mut label = Members::new();
    for (language, name) in [("ru", name), ("en", name_en)] {
        if !name.is_empty() {
            label.insert(language.to_owned(), json!(name));
        }
    }
    if label.is_empty() { Value::Null } else { label.into() }
}

/// The word of a type by which a reader knows it again: English where there is one.
fn word(list: &TypeList, id: Option<TypeId>) -> Value {
    list.get(id)
        .map_or(Value::Null, |t| json!(if t.name_en.is_empty() { &t.name } else { &t.name_en }))
}

/// One Map, placed in the Domain.
struct Floor<'a> {
    world: &'a World,
    plan: &'a FloorPlan,
    map: &'a map::Map,
    /// Map → Domain.
    frame: Frame,
    level: String,
}

impl<'a> Floor<'a> {
    fn new(world: &'a World, plan: &'a FloorPlan) -> Self {
        let map = &world.maps[&plan.map()];
        let placed = world.domain.maps.iter().find(|m| m.map == map.id);
        let frame = placed.map_or(Frame::IDENTITY, |m| m.frame);
        Self { world, plan, map, frame, level: format!("map-{}", map.id.0) }
    }

    fn write(&self, features: &mut Vec<Value>) {
        let map = self.map;
        features.push(feature(
            &self.level,
            "level",
            Value::Null,
            json!({
                "name": label(&map.name, &map.name_en),
                "ordinal": self.ordinal(),
                "elevation": metre(self.frame.z.get()),
                "category": "unspecified",
            }),
        ));
        let scene = self.plan.scene();
        for area in scene.areas.keys() {
            features.push(self.unit(scene, *area));
        }
        self.openings(scene, features);
        for replica in scene.replicas.keys() {
            features.extend(self.fixtures(scene, *replica));
        }
        let zones = self.plan.with_zones(self.world, |_| true);
        features.extend(zones.zones().iter().map(|zone| self.zone(zone)));
        let placements = self.world.placements();
        for place in self.world.places.values() {
            let Some((on, frame)) = placements.get(&place.area) else { continue };
            if *on == map.id {
                features.push(self.place(place, frame));
            }
        }
    }

    /// A zone is a geofence, with what it says to the robot.
    fn zone(&self, placed: &PlacedZone) -> Value {
        let zone = &self.world.zones[&placed.id];
        let (kind, speed, heading) = match zone.kind {
            ZoneKind::KeepOut => ("keep-out", None, None),
            ZoneKind::Closed => ("closed", None, None),
            ZoneKind::Slow { speed } => ("slow", Some(metre(speed)), None),
            ZoneKind::OneWay { heading } => {
                ("one-way", None, Some((heading + self.frame.angle).get()))
            }
        };
        let mut properties = json!({
            "name": label(&zone.name, &zone.name_en),
            "category": kind,
            "level_id": self.level,
            "reason": label(&zone.reason, &zone.reason_en),
        });
        for (name, value) in [("speed", speed), ("heading", heading)] {
            if let Some(value) = value {
                properties[name] = json!(value);
            }
        }
        for (name, moment) in [("from", zone.from), ("until", zone.until)] {
            if let Some(moment) = moment {
                properties[name] = json!(moment.to_string());
            }
        }
        let geometry = self.rings(placed.polygons.iter());
        feature(&format!("zone-{}", zone.id.0), "geofence", geometry, properties)
    }

    /// Floors below the base are negative.
    fn ordinal(&self) -> i64 {
        let height = |m: &map::DomainMap| m.frame.z;
        let domain = &self.world.domain.maps;
        let base = domain.iter().find(|m| m.is_base).map_or(Cm::ZERO, height);
        let mut heights: Vec<f64> = domain.iter().map(|m| m.frame.z.get()).collect();
        heights.sort_by(f64::total_cmp);
        heights.dedup();
        let rank = |z: Cm| heights.iter().position(|h| *h >= z.get()).unwrap_or(0) as i64;
        rank(self.frame.z) - rank(base)
    }

    fn rings<'p>(&self, polygons: impl Iterator<Item = &'p crate::geometry::Polygon>) -> Value {
        let polygons: Vec<Vec<Vec<[f64; 2]>>> =
            polygons.map(|p| vec![ring(p.corners.iter().map(|c| self.frame.apply(*c)))]).collect();
        match &polygons[..] {
            [only] => json!({ "type": "Polygon", "coordinates": only }),
            _ => json!({ "type": "MultiPolygon", "coordinates": polygons }),
        }
    }

    fn unit(&self, scene: &Scene, id: AreaId) -> Value {
        let area = &self.world.areas[&id];
        let prisms = &scene.areas[&id].prisms;
        let height = prisms.iter().map(|p| p.top - p.bottom).fold(0.0, f64::max);
        let mut properties = json!({
            "name": label(&area.name, &area.name_en),
            "category": word(&self.world.types.area, area.area_type),
            "level_id": self.level,
            "height": metre(height),
        });
        extend(&mut properties, &area.properties);
        let geometry = self.rings(prisms.iter().map(|p| &p.polygon));
        feature(&format!("area-{}", id.0), "unit", geometry, properties)
    }

    /// Doors and passages between rooms, and doors that lead out of the map.
    fn openings(&self, scene: &Scene, features: &mut Vec<Value>) {
        for (no, doorway) in self.plan.doorways().iter().enumerate() {
            let line = doorway.line();
            let id = doorway.door.map_or_else(|| format!("gap-{no}"), |d| format!("door-{}", d.0));
            features.push(self.opening(&id, doorway.door, line));
        }
        let joined = |door: DoorId| self.plan.doorways_of(door).next().is_some();
        for (id, placed) in &scene.areas {
            for mount in self.world.areas[id].doors.iter().filter(|m| !joined(m.door)) {
                let Some((right, left)) = self.world.threshold(*id, mount.door) else { continue };
                let line = (placed.frame.apply(right), placed.frame.apply(left));
                features.push(self.opening(
                    &format!("door-{}", mount.door.0),
                    Some(mount.door),
                    line,
                ));
            }
        }
    }

    fn opening(&self, id: &str, door: Option<DoorId>, (a, b): (Point, Point)) -> Value {
        let door = door.map(|d| &self.world.doors[&d]);
        let mut properties = json!({
            "category": "pedestrian",
            "level_id": self.level,
            "door": door.and_then(leaf_kind),
        });
        if let Some(door) = door {
            let status = match door.state.status {
                DoorStatus::Open => "open",
                DoorStatus::Closed => "closed",
                DoorStatus::Locked => "locked",
            };
            properties["name"] = label(&door.name, &door.name_en);
            properties["status"] = json!(status);
            properties["height"] = json!(metre(door.height.get()));
            let hinges = door.leaves.iter().map(|l| match l.hinge {
                HingeSide::Right => "right",
                HingeSide::Left => "left",
            });
            properties["hinges"] = json!(hinges.collect::<Vec<_>>().join(","));
            extend(&mut properties, &door.properties);
        }
        let line = [a, b].map(|p| metres(self.frame.apply(p)));
        feature(id, "opening", json!({ "type": "LineString", "coordinates": line }), properties)
    }

    /// The bases of a thing's Orthoframes, each with its height, and of which thing each is, where they are several.
    fn fixtures(&self, scene: &Scene, id: crate::units::ReplicaId) -> Vec<Value> {
        let replica = &self.world.replicas[&id];
        let object = &self.world.objects[&replica.object];
        let placed = &scene.replicas[&id];
        let floor = scene.areas.get(&placed.area).map_or(0.0, |a| a.frame.z.get());
        let several = placed.prisms.len() > 1;
        let part = |(no, prism): (usize, &crate::geometry::Prism)| {
            let mut properties = json!({
                "name": label(&replica.name, &replica.name_en),
                "category": word(&self.world.types.object, object.object_type),
                "level_id": self.level,
                "height": metre((prism.top - prism.bottom).max(1.0)),
                "min_height": metre(prism.bottom - floor),
                "object": object.name,
                "area": format!("area-{}", replica.area.0),
                "move_prob": replica.move_prob,
            });
            if several {
                properties["part_of"] = json!(format!("replica-{}", id.0));
            }
            extend(&mut properties, &replica.properties);
            let id = if several {
                format!("replica-{}/{}", id.0, no + 1)
            } else {
                format!("replica-{}", id.0)
            };
            let geometry = self.rings(std::iter::once(&prism.polygon));
            feature(&id, "fixture", geometry, properties)
        };
        placed.prisms.iter().enumerate().map(part).collect()
    }

    fn place(&self, place: &map::Place, area: &Frame) -> Value {
        let at = metres(self.frame.apply(area.apply(place.at)));
        let heading = place.heading.map(|h| (h + area.angle + self.frame.angle).get());
        let properties = json!({
            "name": label(&place.name, &place.name_en),
            "category": "place",
            "level_id": self.level,
            "heading": heading,
        });
        let geometry = json!({ "type": "Point", "coordinates": at });
        feature(&format!("place-{}", place.id.0), "amenity", geometry, properties)
    }
}

/// IMDF's `door` of an opening; null for a plain passage.
fn leaf_kind(door: &Door) -> Option<Value> {
    let kind = match door.kind {
        DoorKind::Hinged => "swinging",
        DoorKind::Sliding => "sliding",
        DoorKind::Passage => return None,
    };
    Some(json!({ "type": kind, "automatic": false, "material": null }))
}

/// Properties that the map has by hand, under their own names; a name that the format has is not overwritten.
fn extend(properties: &mut Value, more: &map::Properties) {
    let Some(members) = properties.as_object_mut() else { return };
    for (key, value) in more {
        members.entry(key.clone()).or_insert_with(|| json!(value));
    }
}
