//! How a door opens (M7): where its leaves stand for an opening, what they pass over, how wide a way they leave, and
//! what they strike. The one place that knows it, for doors between Areas and for those of Objects.
//!
//! A hinged leaf turns about the corner of its jamb on the face towards which it opens; closed, it lies within the
//! wall. A sliding leaf runs along the middle of the wall into its pocket. Openings are in per cent of the most that a
//! leaf opens, the same for all leaves of a door.
//!
//! ```text
//!            │ leaf at 100 %
//!            │ . ˙ way of its tip
//!   ▁▁▁▁▁▁▁▁▁│▁▁▁▁▁▁▁▁▁▁.┌▁▁▁▁   the face towards which it opens
//!        wall└───────────┤ wall  leaf at 0 %
//! ```

use std::f64::consts::PI;

use crate::map::{Door, DoorKind, DoorLeaf, DoorMount, DoorState, DoorStatus, HingeSide, OpensTo};
use crate::units::{Point, Vector};

use super::apart::distance;
use super::{Bounds, Polygon, Prism};

/// A leaf that comes no nearer than this has not struck a thing, cm: coordinates are rounded, and hinges have play.
const PLAY: f64 = 0.1;
/// A leaf passes over what is no higher, such as a mat, cm.
const UNDER_LEAF: f64 = 2.0;
/// Of the straight pieces by which the arc of a leaf's tip is drawn.
const ARC: f64 = PI / 36.0;

/// A door's leaves as they hang in a hole of a wall, or on a side of an Object.
#[derive(Debug, Clone, Copy)]
pub struct Leaves<'d> {
    pub(super) door: &'d Door,
    pub(super) bay: Bay,
    /// 0: against `out`; 1: along it.
    pub(super) opens_to: usize,
}

/// Where a leaf strikes on its way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strike<T> {
    pub against: T,
    /// How far the door then stands open, in per cent.
    pub opening: f64,
}

/// The space that a door's leaves may pass through; what stands elsewhere they do not strike.
#[derive(Debug, Clone, Copy)]
pub struct LeafSpace {
    pub near: Bounds,
    /// cm above the Map's zero.
    heights: (f64, f64),
}

impl LeafSpace {
    #[must_use]
    pub fn meets(&self, prism: &Prism) -> bool {
        let (bottom, top) = self.heights;
        prism.bounds.meets(&self.near) && prism.top > bottom && prism.bottom < top
    }
}

/// How far leaves stand open, in per cent.
#[must_use]
pub fn opening_of(state: DoorState) -> f64 {
    if state.status == DoorStatus::Open { state.opening } else { 0.0 }
}

/// The widest gap that a door's leaves leave between each other and the jambs of an opening `width` wide in a wall
/// `gap` thick, in cm: what a disc of that diameter passes.
#[must_use]
pub fn clear_width(door: &Door, state: DoorState, width: f64, gap: f64) -> f64 {
    let bay = Bay { origin: Point::origin(), along: Vector::x(), span: (0.0, width), gap };
    Leaves { door, bay, opens_to: 0 }.clear_width(state)
}

impl<'d> Leaves<'d> {
    /// The leaves of a door on a side of an Object's placed Orthoframe: a wardrobe's. They open outwards or inwards of
    /// the Object; `a` to `b` is the side, counter-clockwise round the Object.
    #[must_use]
    pub fn of_object(door: &'d Door, mount: &DoorMount, a: Point, b: Point) -> Option<Self> {
        let along = (b - a).try_normalize(0.0)?;
        let bay = Bay { origin: a, along, span: (0.0, (b - a).norm()), gap: 0.0 };
        Some(Self { door, bay, opens_to: usize::from(mount.opens == OpensTo::Outside) })
    }

    /// What the leaves occupy, their pockets in the wall included.
    #[must_use]
    pub fn at(&self, state: DoorState) -> Vec<Polygon> {
        let leaf = |(leaf, share)| self.leaf(leaf, share, opening_of(state) / 100.0);
        self.shares().map(leaf).collect()
    }

    /// What the leaves occupy outside of their pockets in the wall: the obstacles that they are.
    #[must_use]
    pub fn obstacles(&self, state: DoorState) -> Vec<Polygon> {
        let placed = self.at(state).into_iter();
        match self.door.kind {
            DoorKind::Hinged | DoorKind::Passage => placed.collect(),
            DoorKind::Sliding => placed.filter_map(|l| self.bay.between_jambs(&l)).collect(),
        }
    }

    /// All that the leaves pass over, outside of their pockets, between two openings.
    #[must_use]
    pub fn swept(&self, openings: (f64, f64)) -> Vec<Polygon> {
        self.shares().filter_map(|(leaf, share)| self.way(leaf, share, openings, 0.0)).collect()
    }

    /// The way of each hinged leaf's tip from shut to fully open, and on to its hinge: what
    /// architects draw of a door. A sliding leaf has none.
    #[must_use]
    pub fn arcs(&self) -> Vec<Vec<Point>> {
        if self.door.kind != DoorKind::Hinged {
            return Vec::new();
        }
        let arc = |(leaf, share): (&DoorLeaf, _)| {
            let swing = self.bay.swing(leaf, share, self.opens_to, 0.0);
            let most = leaf.max_open.to_radians();
            let steps = (most / ARC).ceil().max(1.0);
            let tip = |k: i32| swing.ray(most * f64::from(k) / steps, swing.length);
            (0..=steps as i32).map(tip).chain([swing.hinge]).collect()
        };
        self.shares().map(arc).collect()
    }

    /// The widest gap that the leaves leave between each other and the jambs, in cm.
    #[must_use]
    pub fn clear_width(&self, state: DoorState) -> f64 {
        let width = self.bay.span.1 - self.bay.span.0;
        if self.door.kind == DoorKind::Passage {
            return width;
        }
        if opening_of(state) <= 0.0 {
            return 0.0;
        }
        let jamb = |t: f64| Polygon::new(vec![self.bay.at(t, 0.0), self.bay.at(t, self.bay.gap)]);
        let solids: Vec<Polygon> = std::iter::once(jamb(self.bay.span.0))
            .chain(self.obstacles(state))
            .chain([jamb(self.bay.span.1)])
            .collect();
        let gaps = solids.windows(2).map(|pair| distance(&pair[0], &pair[1]));
        gaps.fold(0.0, f64::max).min(width)
    }

    /// Where the leaves may strike something, over a floor at this height, cm.
    #[must_use]
    pub fn space(&self, floor: f64) -> LeafSpace {
        let (bay, height) = (&self.bay, self.door.height.get());
        let (right, left) = bay.span;
        let middle = bay.at(f64::midpoint(right, left), bay.gap / 2.0);
        let top = if height > 0.0 { floor + height } else { f64::INFINITY };
        LeafSpace {
            near: Bounds::of([middle]).grown(2.0 * (left - right) + bay.gap),
            heights: (floor + UNDER_LEAF, top),
        }
    }

    /// What the leaves strike first between two openings, and how far they get; solids are given by what they take of
    /// the floor, at the height of the leaves.
    pub fn strikes<'s, T: Copy>(
        &self,
        openings: (f64, f64),
        solids: impl IntoIterator<Item = (T, &'s Polygon)>,
    ) -> Option<Strike<T>> {
        /// A share of the way is known so exactly: 2^-12.
        const HALVINGS: usize = 12;
        let meets = |to: f64, solid: &Polygon| {
            let near = solid.bounds();
            self.shares()
                .filter_map(|(leaf, share)| self.way(leaf, share, (openings.0, to), PLAY))
                .any(|way| way.bounds().meets(&near) && distance(&way, solid) <= 0.0)
        };
        let (from, mut first) = (openings.0, openings.1);
        let mut against = None;
        for (owner, solid) in solids {
            if !meets(first, solid) {
                continue;
            }
            // What is passed over grows with the way, so the first contact is found by halving.
            let (mut free, mut struck) = (from, first);
            for _ in 0..HALVINGS {
                let middle = f64::midpoint(free, struck);
                *(if meets(middle, solid) { &mut struck } else { &mut free }) = middle;
            }
            (first, against) = (free, Some(owner));
        }
        against.map(|against| Strike { against, opening: first })
    }

    /// Every leaf with the stretch of the width that it closes, as shares from the right.
    fn shares(&self) -> impl Iterator<Item = (&'d DoorLeaf, (f64, f64))> + use<'d> {
        self.door.leaves.iter().scan(0.0, |from, leaf| {
            let share = (*from, *from + leaf.share);
            *from = share.1;
            Some((leaf, share))
        })
    }

    fn leaf(&self, leaf: &DoorLeaf, share: (f64, f64), opening: f64) -> Polygon {
        match self.door.kind {
            DoorKind::Hinged => {
                let swing = self.bay.swing(leaf, share, self.opens_to, 0.0);
                swing.leaf_at((leaf.max_open * opening).to_radians(), leaf.thickness.get())
            }
            DoorKind::Sliding | DoorKind::Passage => {
                self.bay.slid(leaf, share, leaf.max_open / 100.0 * opening)
            }
        }
        .counter_clockwise()
    }

    /// A leaf's way between two openings: a sector of a circle, or the stretch that it slides over; smaller by `play`
    /// on all sides.
    fn way(
        &self,
        leaf: &DoorLeaf,
        share: (f64, f64),
        (from, to): (f64, f64),
        play: f64,
    ) -> Option<Polygon> {
        let (least, most) = (from.min(to) / 100.0, from.max(to) / 100.0);
        match self.door.kind {
            DoorKind::Hinged => {
                let angle = |opening: f64| (leaf.max_open * opening).to_radians();
                let swing = self.bay.swing(leaf, share, self.opens_to, play);
                Some(swing.sector(angle(least), angle(most), leaf.thickness.get()))
            }
            DoorKind::Sliding | DoorKind::Passage => {
                let at = |opening: f64| self.bay.slid(leaf, share, leaf.max_open / 100.0 * opening);
                let ends = [at(least), at(most)];
                // Both are the same rectangle, moved along the doorway: corners 0 and 1 lie to the right.
                let [right, left] = if leaf.hinge == HingeSide::Right { [1, 0] } else { [0, 1] };
                let (right, left) = (&ends[right].corners, &ends[left].corners);
                let whole = Polygon::new(vec![right[0], right[1], left[2], left[3]]);
                self.bay.between_jambs(&whole)
            }
        }
        .map(Polygon::counter_clockwise)
    }
}

/// The hole in the wall that leaves close; its coordinates are those of [`super::Opening`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Bay {
    pub(super) origin: Point,
    pub(super) along: Vector,
    pub(super) span: (f64, f64),
    pub(super) gap: f64,
}

impl Bay {
    fn out(&self) -> Vector {
        Vector::new(self.along.y, -self.along.x)
    }

    fn at(&self, t: f64, s: f64) -> Point {
        self.origin + self.along * t + self.out() * s
    }

    fn stretch(&self, share: (f64, f64)) -> (f64, f64) {
        let width = self.span.1 - self.span.0;
        (self.span.0 + width * share.0, self.span.0 + width * share.1)
    }

    /// A leaf on its hinge, which stands `play` off the corner of the jamb and ends as far before the other one.
    fn swing(&self, leaf: &DoorLeaf, share: (f64, f64), opens_to: usize, play: f64) -> Swing {
        let (right, left) = self.stretch(share);
        let (right, left) = (right + play, left - play);
        let (face, opens) =
            if opens_to == 0 { (-play, -self.out()) } else { (self.gap + play, self.out()) };
        let (t, closed) = match leaf.hinge {
            HingeSide::Right => (right, self.along),
            HingeSide::Left => (left, -self.along),
        };
        Swing { hinge: self.at(t, face), closed, opens, length: (left - right).max(0.0) }
    }

    /// A sliding leaf, `shift` of its length withdrawn.
    fn slid(&self, leaf: &DoorLeaf, share: (f64, f64), shift: f64) -> Polygon {
        let (right, left) = self.stretch(share);
        let way = (left - right) * shift * if leaf.hinge == HingeSide::Right { -1.0 } else { 1.0 };
        let (t0, t1) = (right + way, left + way);
        let half = leaf.thickness.get() / 2.0;
        let (s0, s1) = (self.gap / 2.0 - half, self.gap / 2.0 + half);
        Polygon::new(vec![self.at(t0, s0), self.at(t0, s1), self.at(t1, s1), self.at(t1, s0)])
    }

    fn between_jambs(&self, leaf: &Polygon) -> Option<Polygon> {
        let corners = leaf.corners.iter().map(|&p| {
            let v = p - self.origin;
            self.at(v.dot(&self.along).clamp(self.span.0, self.span.1), v.dot(&self.out()))
        });
        let cut = Polygon::new(corners.collect());
        (cut.signed_area().abs() > 1e-6).then_some(cut)
    }
}

/// A leaf on its hinge.
struct Swing {
    hinge: Point,
    /// From the hinge along the closed leaf.
    closed: Vector,
    opens: Vector,
    length: f64,
}

impl Swing {
    fn ray(&self, angle: f64, reach: f64) -> Point {
        self.hinge + (self.closed * angle.cos() + self.opens * angle.sin()) * reach
    }

    fn leaf_at(&self, angle: f64, thickness: f64) -> Polygon {
        let (sin, cos) = angle.sin_cos();
        let along = self.closed * cos + self.opens * sin;
        // The leaf's body lies behind the face that shuts flush with the wall.
        let back = (self.closed * sin - self.opens * cos) * thickness;
        let tip = self.hinge + along * self.length;
        Polygon::new(vec![self.hinge, tip, tip + back, self.hinge + back])
    }

    /// The leaf's way between two angles, its arc by tangents from outside.
    fn sector(&self, from: f64, to: f64, thickness: f64) -> Polygon {
        let reach = self.length.hypot(thickness);
        // The back of the leaf trails behind its face; in a shut one it lies in the wall.
        let from = (from - (thickness / self.length.max(1e-9)).atan()).max(0.0);
        let steps = ((to - from) / ARC).ceil().max(1.0);
        let half = (to - from) / steps / 2.0;
        let tangent = |k: usize| self.ray(from + half * (2 * k + 1) as f64, reach / half.cos());
        let mut corners = vec![self.hinge, self.ray(from, reach)];
        corners.extend((0..steps as usize).map(tangent));
        corners.push(self.ray(to, reach));
        Polygon::new(corners)
    }
}
