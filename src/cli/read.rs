//! `ortho where --read`: a position report read back, as the region of which it is true.

use crate::engine::{Engine, Region, State, json};
use crate::map::Entity;
use crate::semantics::Claim;
use crate::units::{Point, told};

use super::args::{Common, Lang};
use super::fault::Failure;
use super::opened::open;
use super::{Answer, say};

/// Step of the grid that measures a region, cm; wider where the box of the region has more than [`POINTS`].
const STEP: f64 = 10.0;
const POINTS: f64 = 10_000.0;

/// With a pose, the answer is whether the report is true of it.
pub(super) fn run(common: &Common, text: &str, at: Option<&str>) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let pose = at.map(State::parse_pose).transpose()?;
    let region = engine.read_position(text)?;
    let holds = pose.map(|pose| engine.region_contains(&region, pose)).transpose()?;
    let size = region.bounds.max - region.bounds.min;
    let step = (size.x * size.y / POINTS).sqrt().max(STEP);
    let points = engine.region_points(&region, step)?;
    let square = points.len() as f64 * step * step / 1e4;
    let middle = middle_of(&points);
    let world = engine.world()?;
    if common.json {
        let view = json::region(world, &region, square, middle, holds);
        say(&view.to_string())?;
    } else {
        say(&in_words(&engine, &region, square, middle, common.lang)?)?;
        if let Some(holds) = holds {
            say(&match holds {
                true => told!(common.lang.language(), "pose-lies-in-region"),
                false => told!(common.lang.language(), "pose-lies-elsewhere"),
            })?;
        }
    }
    Ok(if holds == Some(false) { Answer::No } else { Answer::Yes })
}

fn in_words(
    engine: &Engine,
    region: &Region,
    square: f64,
    middle: Option<Point>,
    lang: Lang,
) -> Result<String, Failure> {
    let name = engine.world()?.name(Entity::Area(region.area)).to_owned();
    let point =
        middle.map(|p| format!("{}{:.0},{:.0}", told!(lang.language(), "such-as"), p.x, p.y));
    let (head, unit) = (told!(lang.language(), "region"), told!(lang.language(), "square-metres"));
    let kind = match &region.claim {
        Claim::InArea => told!(lang.language(), "anywhere"),
        Claim::InDoorway(_) => told!(lang.language(), "in-the-doorway"),
        Claim::AtDoor(_) => told!(lang.language(), "at-the-door-or-passage"),
        Claim::On(_) => told!(lang.language(), "on-a-thing"),
        Claim::NextTo(_) => told!(lang.language(), "next-to-a-thing"),
        Claim::InCorner => told!(lang.language(), "in-a-corner"),
        Claim::AlongWall => told!(lang.language(), "by-a-wall"),
        Claim::InMiddle => told!(lang.language(), "in-the-middle"),
    };
    Ok(format!("{head}: {name}, {kind}, {square:.2} {unit}{}.", point.unwrap_or_default()))
}

/// The point of the region that lies nearest to the middle of them all.
fn middle_of(points: &[Point]) -> Option<Point> {
    let count = points.len().max(1) as f64;
    let sum = points.iter().fold(crate::units::Vector::zeros(), |sum, p| sum + p.coords);
    let centre = Point::from(sum / count);
    let far = |p: &Point| (p - centre).norm_squared();
    points.iter().copied().min_by(|p, q| far(p).total_cmp(&far(q)))
}
