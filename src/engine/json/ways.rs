//! Ways, what would open them, what is in view, and where somebody stands, as data.

use serde_json::{Value, json};

use super::values::{merge, point, pose, round};
use crate::engine::{
    Journey, Region, RouteAnswer, Whereabout, World, face_in_words, no_way_in_words,
};
use crate::geometry::{FaceInView, PassframeId, Remedy, Ride, Route};
use crate::language::Language;
use crate::map::Entity;
use crate::semantics::{Claim, Spot};
use crate::units::{AreaId, Point, ReplicaId};

pub fn route(world: &World, answer: &RouteAnswer, language: Language) -> Value {
    let mut view = json!({
        "from": answer.from,
        "to": answer.to,
        "map": world.maps[&answer.map].name,
    });
    match &answer.route {
        Ok(route) => {
            view["outcome"] = json!("route");
            view["areas"] =
                json!(answer.stages.iter().map(|s| &world.areas[&s.area].name).collect::<Vec<_>>());
            merge(&mut view, way(world, route, &answer.chain));
        }
        Err(why) => {
            view["outcome"] = json!("no_route");
            view["explanation"] = json!(no_way_in_words(world, why, language));
        }
    }
    view
}

/// What would open a way: doors to open, and what is to be done once they are.
fn remedy(world: &World, remedy: &Remedy) -> Value {
    let name = |entity: Entity| world.name(entity).to_owned();
    let thing = |id: &ReplicaId| name(Entity::Replica(*id));
    let (Remedy::Open(open)
    | Remedy::Move { open, .. }
    | Remedy::Shut { open, .. }
    | Remedy::Remove { open, .. }) = remedy;
    let open: Vec<String> = open.iter().map(|&door| name(Entity::Door(door))).collect();
    let mut view = json!({ "open": open });
    match remedy {
        Remedy::Open(_) => {}
        Remedy::Move { replica, by, .. } => {
            view["move"] = json!({ "thing": thing(replica), "by": [round(by.x), round(by.y)] });
        }
        Remedy::Shut { door, of, .. } => {
            let of = of.as_ref().map(thing);
            view["shut"] = json!({ "door": name(Entity::Door(*door)), "of": of });
        }
        Remedy::Remove { replicas, .. } => {
            view["remove"] = json!(replicas.iter().map(thing).collect::<Vec<_>>());
        }
    }
    view
}

/// A face in view.
fn face(world: &World, view: &FaceInView, language: Language) -> Value {
    json!({
        "face": face_in_words(world, &view.face, language),
        "area_cm2": round(view.area),
        "whole_cm2": round(view.whole),
        "distance_cm": round(view.distance),
    })
}

/// A single leg as [`route`] gives it; several as a list of those, with the rides between them.
pub fn journey(world: &World, journey: &Journey, language: Language) -> Value {
    let opens: Vec<&str> =
        journey.opens.iter().map(|door| world.name(Entity::Door(*door))).collect();
    if let [leg] = &journey.legs[..] {
        let mut view = route(world, leg, language);
        if !opens.is_empty() {
            view["opens"] = json!(opens);
        }
        if let Some(advice) = &journey.advice {
            view["advice"] = json!(advice.in_words(world, language));
            view["remedy"] = remedy(world, &advice.remedy);
        }
        return view;
    }
    let ride = |ride: &Ride| {
        json!({
            "lift": world.domain.lifts[ride.lift].0,
            "from": world.areas[&ride.from].name,
            "to": world.areas[&ride.to].name,
            "rise_cm": round(ride.rise),
        })
    };
    let length = |leg: &RouteAnswer| leg.route.as_ref().map_or(0.0, |r| r.length);
    let mut view = json!({
        "outcome": "route",
        "length_cm": round(journey.legs.iter().map(length).sum()),
        "legs": journey.legs.iter().map(|leg| route(world, leg, language)).collect::<Vec<_>>(),
        "rides": journey.rides.iter().map(ride).collect::<Vec<_>>(),
    });
    if !opens.is_empty() {
        view["opens"] = json!(opens);
    }
    view
}

fn way(world: &World, route: &Route, chain: &[(AreaId, PassframeId)]) -> Value {
    let moved = |m: &Option<crate::geometry::Moved>| {
        m.as_ref().map(|m| json!({"from": point(m.from), "to": point(m.to)}))
    };
    json!({
        "length_cm": round(route.length),
        "points": route.points.iter().map(|&p| point(p)).collect::<Vec<_>>(),
        "heading_deg": route.heading.map(|h| round(h.get())),
        "passframes": chain
            .iter()
            .map(|(area, id)| json!({"area": world.areas[area].name, "id": id.to_string()}))
            .collect::<Vec<_>>(),
        "moved_start": moved(&route.moved_start),
        "moved_goal": moved(&route.moved_goal),
    })
}

pub fn whereabout(world: &World, found: &Whereabout) -> Value {
    let terms = &found.terms;
    let map = &world.maps[&found.map];
    let mut view = json!({
        "map": map.name,
        "frame": Some(&map.frame).filter(|frame| !frame.is_empty()),
        "pose": pose(found.pose),
        "area": world.areas[&terms.area].name,
        "ru": found.position.say(Language::Russian),
        "en": found.position.say(Language::English),
    });
    let spot = match terms.spot {
        Spot::InDoorway(way) => json!({"kind": "in_doorway", "way": self::passage(world, &way)}),
        Spot::AtDoor { way, distance } => {
            json!({"kind": "at_door", "way": self::passage(world, &way), "distance_cm": round(distance)})
        }
        Spot::On { replica } => {
            json!({"kind": "on", "thing": world.name(Entity::Replica(replica))})
        }
        Spot::NextTo { replica, distance } => {
            json!({"kind": "next_to", "thing": world.name(Entity::Replica(replica)), "distance_cm": round(distance)})
        }
        Spot::InCorner => json!({"kind": "in_corner"}),
        Spot::AlongWall => json!({"kind": "along_wall"}),
        Spot::InMiddle => json!({"kind": "in_middle"}),
        Spot::Inside => json!({"kind": "inside"}),
    };
    view["spot"] = spot;
    view
}

fn passage(world: &World, way: &crate::semantics::Way) -> Value {
    json!({
        "door": way.door.map(|d| world.name(Entity::Door(d))),
        "is_passage": way.is_passage,
        "from": world.name(Entity::Area(way.from)),
        "to": way.to.map(|a| world.name(Entity::Area(a))),
    })
}

/// Faces in view, the nearest first.
#[must_use]
pub(crate) fn faces(world: &World, seen: &[FaceInView], language: Language) -> Value {
    seen.iter().map(|one| face(world, one, language)).collect()
}

/// A way with what is said of it.
#[must_use]
pub(crate) fn with_words(mut view: Value, words: &[String]) -> Value {
    view["words"] = json!(words);
    view
}

/// The region in which a report of a position is true: how large it is, a point of it, and whether a pose lies in it.
#[must_use]
pub fn region(
    world: &World,
    region: &Region,
    square_m2: f64,
    point: Option<Point>,
    contains: Option<bool>,
) -> Value {
    let claim = match region.claim {
        Claim::InArea => "in_area",
        Claim::InDoorway(_) => "in_doorway",
        Claim::AtDoor(_) => "at_door",
        Claim::On(_) => "on",
        Claim::NextTo(_) => "next_to",
        Claim::InCorner => "in_corner",
        Claim::AlongWall => "along_wall",
        Claim::InMiddle => "in_middle",
    };
    json!({
        "map": world.maps[&region.map].name,
        "area": world.name(Entity::Area(region.area)),
        "claim": claim,
        "square_m2": square_m2,
        "point": point.map(|p| [p.x, p.y]),
        "contains": contains,
    })
}
