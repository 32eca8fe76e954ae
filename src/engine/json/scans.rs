//! What scans and pictures show: segments, things, what moved, where they were taken and what they contradict, as data.

use serde_json::{Value, json};

use super::segments::segment;
use super::values::{point, pose, round};
use super::ways::whereabout;
use crate::engine::differences::{Differing, ThingNews};
use crate::engine::{Changes, FoundScan, Things, View, World};
use crate::map::{DoorStatus, Entity};
use crate::vectors::Segment;

/// Where scans can have been taken.
#[must_use]
pub(crate) fn found_scans(world: &World, found: &[FoundScan]) -> Value {
    let scan = |found: &FoundScan| {
        let poses = found.poses.iter().map(|at| {
            json!({
                "pose": pose(at.pose),
                "deviation_cm": round(at.deviation.0),
                "deviation_deg": at.deviation.1,
                "explained": at.explained,
                "through": at.through,
                "place": at.place.as_ref().map(|place| whereabout(world, place)),
            })
        });
        json!({
            "scan": found.scan,
            "line": found.line,
            "found": found.outcome(),
            "at_least": found.at_least(),
            "event": found.event(),
            "telling_move": found.telling.map(|by| json!({
                "turn_deg": round(by.turn.to_degrees()),
                "ahead_cm": round(by.ahead),
                "tells": by.tells,
            })),
            "poses": poses.collect::<Vec<_>>(),
        })
    };
    json!({"outcome": "scans", "found": found.iter().map(scan).collect::<Vec<_>>()})
}

/// What scans see that a map has otherwise.
#[must_use]
pub(crate) fn differing(world: &World, seen: &Differing) -> Value {
    let place = |seen: &crate::store::Seen| {
        json!({
            "area": world.name(Entity::Area(seen.area)),
            "x": round(seen.frame.x.get()),
            "y": round(seen.frame.y.get()),
            "angle": round(seen.frame.angle.get()),
        })
    };
    let things = seen.things.iter().map(|(id, (news, sure))| {
        let (kind, to) = match news {
            ThingNews::There => ("there", None),
            ThingNews::Missed => ("missed", None),
            ThingNews::Moved(to) => ("moved", Some(place(to))),
        };
        json!({"thing": world.name(Entity::Replica(*id)), "seen": kind, "place": to, "sure": sure})
    });
    let doors = seen.doors.iter().map(|(id, news)| {
        json!({
            "door": world.name(Entity::Door(*id)),
            "open": news.state.status == DoorStatus::Open,
            "opening": round(news.state.opening),
            "least": news.between.0,
            "most": news.between.1,
            "as_mapped": news.is_as_mapped,
            "sure": news.sure,
        })
    });
    let obstacles = seen.obstacles.iter().map(|obstacle| {
        let piece = |piece: &Vec<crate::units::Point>| {
            piece.iter().map(|p| json!([round(p.x), round(p.y)])).collect::<Vec<_>>()
        };
        json!({
            "area": world.name(Entity::Area(obstacle.area)),
            "pieces": obstacle.pieces.iter().map(piece).collect::<Vec<_>>(),
            "top": round(obstacle.top),
            "sure": obstacle.sure,
        })
    });
    json!({
        "outcome": "differences",
        "scans": seen.scans,
        "held": seen.held,
        "things": things.collect::<Vec<_>>(),
        "doors": doors.collect::<Vec<_>>(),
        "obstacles": obstacles.collect::<Vec<_>>(),
        "gone": seen.gone.len(),
    })
}

/// The segments of a scan or a picture.
pub(crate) fn view(view: &View) -> Value {
    json!({
        "outcome": "segments",
        "unit": if view.is_picture { "px" } else { "cm" },
        "scan": view.scan,
        "line": (!view.is_picture).then_some(view.line),
        "beams": view.beams,
        "returned": view.returns.len(),
        "pose": view.pose.map(pose),
        "segments": view.segments.iter().map(segment).collect::<Vec<_>>(),
        "points": view.points.iter().map(|p| json!([round(p.x), round(p.y)])).collect::<Vec<_>>(),
    })
}

/// The things of a log, a scan or a picture; each with its place and its segments in its own frame.
pub fn things(things: &Things) -> Value {
    let scene = &things.scene;
    let thing = |(at, thing): (usize, &crate::vectors::Thing<2>)| {
        let frame = scene.frames()[at].translation.vector;
        let leaves = scene.leaves(at);
        let of_leaf = |leaf: &crate::vectors::Leaf<'_, 2>| -> Vec<Value> {
            let told = |(k, s): (usize, &Segment<2>)| {
                let mut view = segment(s);
                let counts = leaf.model.membership(k);
                view["seen"] = json!(counts.seen);
                view["expected"] = json!(counts.expected);
                view["probability"] = json!(round(counts.probability()));
                view
            };
            leaf.model.segments().iter().enumerate().map(told).collect()
        };
        json!({
            "id": thing.id.0,
            "at": point(frame.into()),
            "segments": leaves.iter().flat_map(of_leaf).collect::<Vec<_>>(),
        })
    };
    json!({
        "outcome": "things",
        "unit": if things.is_picture { "px" } else { "cm" },
        "views": things.views,
        "without_pose": things.without_pose,
        "things": scene.things().iter().enumerate().map(thing).collect::<Vec<_>>(),
    })
}

/// Two scans: which segment is which, what moved by itself, what is new or not found again.
pub(crate) fn changes(changes: &Changes) -> Value {
    let found = &changes.difference;
    let part = |part: &crate::vectors::RigidPart<2>| {
        let motion = part.motion.isometry;
        json!({
            "pairs": part.members,
            "shift": point(motion.translation.vector.into()),
            "turn_deg": round(motion.rotation.angle().to_degrees()),
        })
    };
    json!({
        "outcome": "changes",
        "before": view(&changes.before),
        "after": view(&changes.after),
        "pairs": found.pairs.iter().map(|&(was, is, _)| [was, is]).collect::<Vec<_>>(),
        "parts": found.parts.iter().map(part).collect::<Vec<_>>(),
        "vanished": found.vanished,
        "appeared": found.appeared,
        "comparisons": found.counters.comparisons(),
    })
}
