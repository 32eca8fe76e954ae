//! Kinds of things as Objects: each part an Orthoframe, the lowest part the base item with a corner at the origin.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::map::plane::{bounds, doubled_area};
use crate::map::{Face, Item, ItemLink, Permeability, SideRef};
use crate::report::{What, Why};
use crate::units::{Cm, Deg, Frame, InOrder as _, Point, Vector, said, word};
use crate::{Kind, Part, Report};

use super::names::letters;
use super::ring::{Ring, clean_part, overlay};

/// Width of the mark that stands for a thing of unknown size, cm.
const MARK: f64 = 20.0;
/// Common floor of two solid parts, cm²; the map's checks allow 1.
const TOUCH: f64 = 0.5;
/// Parts that a kind may have.
const MOST_PARTS: usize = 200;

/// A kind's bodies, ready to be Orthoframes.
pub(super) struct Built {
    pub(super) bodies: Vec<Body>,
    /// The Object's origin in the kind's frame.
    pub(super) origin: Point,
    pub(super) bottom: f64,
    /// Whether its size is the usual one of such things.
    pub(super) is_usual: bool,
    pub(super) front: Option<SideRef>,
    pub(super) back: Option<SideRef>,
}

/// A prism in the Object's frame.
pub(super) struct Body {
    pub(super) word: String,
    pub(super) corners: Ring,
    pub(super) bottom: f64,
    pub(super) height: f64,
    pub(super) permeability: Permeability,
}

impl Body {
    fn meets(&self, other: &Self) -> bool {
        let solid = |b: &Self| b.permeability == Permeability::Impermeable;
        solid(self)
            && solid(other)
            && self.bottom < other.bottom + other.height - 0.01
            && other.bottom < self.bottom + self.height - 0.01
    }
}

/// Makes an Object's bodies of a kind. `size` serves a kind without parts: width, depth, height.
pub(super) fn build(kind: &Kind, size: Option<[f64; 3]>, report: &mut Report) -> Built {
    let mut bodies = bodies(kind, report);
    let is_usual = bodies.is_empty() && size.is_some();
    if bodies.is_empty() {
        let [w, d, h] = size.unwrap_or([MARK, MARK, 0.0]);
        let (x, y) = (w / 2.0, d / 2.0);
        let corners = [(-x, -y), (x, -y), (x, y), (-x, y)].map(|(x, y)| Point::new(x, y)).to_vec();
        bodies.push(Body {
            word: String::new(),
            corners,
            bottom: 0.0,
            height: h,
            permeability: Permeability::Impermeable,
        });
    }
    part(&mut bodies, kind, report);
    // The base item first: the lowest, then the largest.
    let rank = |b: &Body| (b.bottom, -doubled_area(&b.corners));
    let base = (0..bodies.len())
        .min_by(|&i, &j| {
            let (a, b) = (rank(&bodies[i]), rank(&bodies[j]));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
        .unwrap_or(0);
    bodies.swap(0, base);
    let (origin, bottom) = (bodies[0].corners[0], bodies[0].bottom);
    for body in &mut bodies {
        body.bottom -= bottom;
        body.corners.iter_mut().for_each(|p| *p = Point::from(*p - origin));
    }
    let side = |towards: Vector| {
        facing(&bodies[0].corners, towards).map(|i| SideRef { item: letters(0), side: letters(i) })
    };
    let ahead = kind.front.map(|deg| {
        let (sin, cos) = deg.sin_cos();
        Vector::new(cos, sin)
    });
    Built {
        front: ahead.and_then(side),
        back: ahead.and_then(|v| side(-v)),
        bodies,
        origin,
        bottom,
        is_usual,
    }
}

fn bodies(kind: &Kind, report: &mut Report) -> Vec<Body> {
    let mut bodies = Vec::new();
    for part in kind.parts.iter().take(MOST_PARTS) {
        match clean_part(&part.outline).or_else(|| thickened(&part.outline)) {
            Some(corners) => bodies.push(Body {
                word: part.word.clone(),
                corners,
                bottom: part.bottom.get(),
                height: part.height.get().max(0.0),
                permeability: part.permeability,
            }),
            None => flat_part(part, kind, report),
        }
    }
    bodies
}

/// A sheet seen edge-on, such as a picture on a wall, gets half a centimetre.
fn thickened(outline: &[Point]) -> Option<Ring> {
    let (low, high) = bounds(outline.iter().copied());
    let size = high - low;
    if !(size.x >= 0.0 && size.y >= 0.0) || size.x.max(size.y) < 0.1 {
        return None;
    }
    let by = Vector::new((0.5 - size.x).max(0.0), (0.5 - size.y).max(0.0)) / 2.0;
    let (low, high) = (low - by, high + by);
    clean_part(&[low, Point::new(high.x, low.y), high, Point::new(low.x, high.y)])
}

fn flat_part(part: &Part, kind: &Kind, report: &mut Report) {
    let what = if part.word.is_empty() { word!("a-part-of-the-kind") } else { word!("a-part") };
    let value = if part.word.is_empty() { said!("without-area") } else { part.word.clone().into() };
    report.mended(What::Kind, &kind.source, Why::BadValue { what: what.into(), value });
}

/// Solid parts must not lie in one another: what is common stays with the larger one.
fn part(bodies: &mut Vec<Body>, kind: &Kind, report: &mut Report) {
    let mut was_cut = false;
    let mut order: Vec<usize> = (0..bodies.len()).collect();
    order.order_by(|&i, &j| {
        doubled_area(&bodies[j].corners).total_cmp(&doubled_area(&bodies[i].corners))
    });
    let mut gone = vec![false; bodies.len()];
    for (n, &i) in order.iter().enumerate() {
        for &j in &order[n + 1..] {
            if gone[i] || gone[j] || !bodies[i].meets(&bodies[j]) {
                continue;
            }
            let (one, other) = ([bodies[i].corners.clone()], [bodies[j].corners.clone()]);
            let common = overlay(&one, &other, OverlayRule::Intersect, FillRule::NonZero);
            if common.iter().map(super::ring::Region::area).sum::<f64>() <= TOUCH {
                continue;
            }
            was_cut = true;
            let rest = overlay(&other, &one, OverlayRule::Difference, FillRule::NonZero)
                .into_iter()
                .filter(|r| r.holes.is_empty())
                .max_by(|a, b| a.area().total_cmp(&b.area()))
                .and_then(|r| clean_part(&r.outer));
            match rest {
                Some(corners) => bodies[j].corners = corners,
                None => gone[j] = true,
            }
        }
    }
    let mut gone = gone.into_iter();
    bodies.retain(|_| !gone.next().unwrap_or(false));
    if was_cut {
        report.mended(What::Kind, &kind.source, Why::PartsOverlap);
    }
}

/// The side whose outward normal comes nearest to a direction, at most 46° from it.
fn facing(corners: &[Point], towards: Vector) -> Option<usize> {
    let normal = |i: usize| {
        let v = corners[(i + 1) % corners.len()] - corners[i];
        Vector::new(v.y, -v.x).normalize().dot(&towards)
    };
    let length = |i: usize| (corners[(i + 1) % corners.len()] - corners[i]).norm();
    (0..corners.len()).filter(|&i| normal(i) > 0.69).max_by(|&i, &j| {
        // Of sides that face equally, the longer one.
        ((normal(i) * 1e3).round(), length(i))
            .partial_cmp(&((normal(j) * 1e3).round(), length(j)))
            .unwrap_or(std::cmp::Ordering::Equal)
    })
}

/// Items over the bodies' Orthoframes, and the links that hold the parts to the base.
pub(super) fn items(
    built: &Built,
    orthoframes: &[crate::units::OrFrId],
) -> (Vec<Item>, Vec<ItemLink>) {
    let items: Vec<Item> = built
        .bodies
        .iter()
        .zip(orthoframes)
        .enumerate()
        .map(|(i, (body, &orthoframe))| Item {
            id: letters(i),
            orthoframe,
            frame: Frame::new(0.0, 0.0, body.bottom, Deg::ZERO),
            is_base: i == 0,
        })
        .collect();
    let roof = built.bodies[0].height;
    let link = |(i, body): (usize, &Body)| ItemLink {
        item: letters(0),
        face: Face::Roof,
        to_item: letters(i),
        to_face: Face::Base,
        rel_x: Cm::ZERO,
        rel_y: Cm::ZERO,
        rel_z: Cm::of(body.bottom - roof),
        rel_a: Deg::ZERO,
    };
    let links = built.bodies.iter().enumerate().skip(1).map(link).collect();
    (items, links)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part_at(x: f64, w: f64, bottom: f64, height: f64) -> Part {
        let corners = [(x, 0.0), (x + w, 0.0), (x + w, 50.0), (x, 50.0)];
        Part {
            word: String::new(),
            outline: corners.map(|(x, y)| Point::new(x, y)).to_vec(),
            bottom: Cm::of(bottom),
            height: Cm::of(height),
            permeability: Permeability::Impermeable,
        }
    }

    #[test]
    fn the_lowest_part_is_the_base_and_the_front_is_found() {
        let kind = Kind {
            parts: vec![part_at(-10.0, 120.0, 70.0, 3.0), part_at(0.0, 100.0, 20.0, 50.0)],
            front: Some(Deg::of(270.0)),
            ..Kind::default()
        };
        let mut report = Report::default();
        let built = build(&kind, None, &mut report);
        assert_eq!((built.origin, Cm::of(built.bottom)), (Point::new(0.0, 0.0), Cm::of(20.0)));
        assert_eq!(Cm::of(built.bodies[1].bottom), Cm::of(50.0));
        assert_eq!(built.front, Some(SideRef { item: "A".into(), side: "A".into() }));
        assert_eq!(built.back, Some(SideRef { item: "A".into(), side: "C".into() }));
        assert!(report.is_clean());
    }

    #[test]
    fn parts_in_one_another_are_parted() {
        let kind = Kind {
            parts: vec![part_at(0.0, 100.0, 0.0, 50.0), part_at(80.0, 40.0, 10.0, 50.0)],
            ..Kind::default()
        };
        let mut report = Report::default();
        let built = build(&kind, None, &mut report);
        let area: f64 = built.bodies.iter().map(|b| doubled_area(&b.corners) / 2.0).sum();
        assert!((area - 6000.0).abs() < 1.0, "{area}");
        assert_eq!(report.count(crate::Treatment::Mended), 1);
    }
}
