//! The hierarchical map: Robot → Scene → things → segments (SPEC V12-V14; paper 3, section 4, fig. 1).
//!
//! The Scene is the same point as the Robot, told apart in thought alone. Every thing has a frame and a transition
//! matrix P from it to the robot's; its segments are written in its own frame. So the robot's motion T changes the N
//! matrices, P' = T⁻¹·P with T⁻¹ = [Rᵀ 0; 0 1]·[E −d; 0 1], and no segment.
//!
//! # Invariants
//!
//! Segments are written by [`Scene::set_body`] alone, and it counts them; matrices are counted where they change.

mod observe;
mod tree;

pub use observe::{Change, Odometry, Owner, Report};
pub use tree::{Node, TreeNode};

use crate::{Equality, Euclid, Membership, Model, Motion, Segment, Space, ThingId, Transition};

/// What the map wrote since it was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Writes {
    pub matrices: u64,
    pub segments: u64,
}

/// What a thing, or a part of one, is made of.
#[derive(Debug, Clone, PartialEq)]
pub enum Body<const D: usize> {
    /// Segments that keep their places in its frame.
    Rigid(Model<D>),
    /// Parts that moved by themselves once (V18), each with a frame of its own.
    Parts(Vec<Part<D>>),
}

/// A part of a thing.
#[derive(Debug, Clone, PartialEq)]
pub struct Part<const D: usize> {
    /// From the part's frame to that of the whole.
    pub frame: Transition<D>,
    pub body: Body<D>,
}

/// A thing of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Thing<const D: usize> {
    pub id: ThingId,
    body: Body<D>,
}

impl<const D: usize> Thing<D> {
    #[must_use]
    pub const fn body(&self) -> &Body<D> {
        &self.body
    }
}

/// A rigid leaf of a thing: the way to it, its frame as seen from the thing's, its segments.
#[derive(Debug, Clone, PartialEq)]
pub struct Leaf<'a, const D: usize> {
    /// Which part of which part; empty for a thing that is rigid.
    pub path: Vec<usize>,
    pub frame: Transition<D>,
    pub model: &'a Model<D>,
}

/// The map about a robot.
#[derive(Debug, Clone)]
pub struct Scene<const D: usize> {
    /// P of each thing: from its frame to the robot's. Apart from the things, so that a motion runs through them alone.
    frames: Vec<Transition<D>>,
    things: Vec<Thing<D>>,
    equality: Equality,
    writes: Writes,
    /// Motions since rotations were made exact again.
    motions: u32,
    next: u32,
}

impl<const D: usize> Scene<D>
where
    Euclid<D>: Space<D>,
{
    /// An empty scene in which segments are equal by `equality`.
    #[must_use]
    pub fn new(equality: Equality) -> Self {
        Self {
            frames: Vec::new(),
            things: Vec::new(),
            equality,
            writes: Writes::default(),
            motions: 0,
            next: 0,
        }
    }

    #[must_use]
    pub fn things(&self) -> &[Thing<D>] {
        &self.things
    }

    /// From each thing's frame to the robot's, in the order of [`things`](Self::things).
    #[must_use]
    pub fn frames(&self) -> &[Transition<D>] {
        &self.frames
    }

    #[must_use]
    pub const fn writes(&self) -> Writes {
        self.writes
    }

    #[must_use]
    pub const fn equality(&self) -> &Equality {
        &self.equality
    }

    /// Adds a thing seen from where the robot is; its own frame begins in its middle.
    pub fn add(&mut self, seen: &Model<D>) -> ThingId {
        let frame = middle(seen);
        let id = ThingId(self.next);
        self.next += 1;
        self.frames.push(frame);
        self.things.push(Thing { id, body: Body::Parts(Vec::new()) });
        self.writes.matrices += 1;
        let at = self.things.len() - 1;
        self.set_body(at, &[], Body::Rigid(seen.moved(&rigid(&frame.inverse()))));
        id
    }

    /// Adds what joins, corner by corner, as one thing each: of the segments of a view those listed.
    pub fn add_contours(&mut self, view: &Model<D>, segments: &[usize]) -> Vec<ThingId> {
        let mut listed = vec![false; view.len()];
        for &k in segments {
            listed[k] = true;
        }
        let mut added = Vec::new();
        for first in 0..view.len() {
            let begins = view.previous(first).is_none_or(|p| !view.is_joined(p) || !listed[p]);
            if !listed[first] || !begins {
                continue;
            }
            added.push(self.add(&view.part(&run(view, first, &mut listed))));
        }
        // What is left are rings.
        for first in 0..view.len() {
            if listed[first] {
                added.push(self.add(&view.part(&run(view, first, &mut listed))));
            }
        }
        added
    }

    /// Position of a thing in [`things`](Self::things).
    #[must_use]
    pub fn position(&self, thing: ThingId) -> Option<usize> {
        self.things.iter().position(|t| t.id == thing)
    }

    /// Takes a thing out of the map.
    pub fn remove(&mut self, thing: ThingId) -> Option<Thing<D>> {
        let at = self.position(thing)?;
        self.frames.swap_remove(at);
        Some(self.things.swap_remove(at))
    }

    /// The robot moved: `motion` is its new pose in its old frame. Every matrix changes, no segment.
    pub fn robot_moved(&mut self, motion: &Transition<D>) {
        let back = motion.inverse();
        for frame in &mut self.frames {
            *frame = back * *frame;
        }
        self.writes.matrices += self.frames.len() as u64;
        self.motions += 1;
        // Rounding must not make rotations shear.
        if self.motions.is_multiple_of(1024) {
            for frame in &mut self.frames {
                frame.rotation = Euclid::<D>::turning(frame.rotation.matrix());
            }
        }
    }

    /// A thing moved as a whole: its matrix alone is new (V17). `motion` is told in the robot's frame.
    pub fn thing_moved(&mut self, at: usize, motion: &Transition<D>) {
        self.frames[at] = motion * self.frames[at];
        self.writes.matrices += 1;
    }

    /// The rigid leaves of a thing.
    #[must_use]
    pub fn leaves(&self, at: usize) -> Vec<Leaf<'_, D>> {
        let mut found = Vec::new();
        collect(&self.things[at].body, &Transition::identity(), &mut Vec::new(), &mut found);
        found
    }

    /// A thing's segments as the robot has them before it, leaf by leaf.
    #[must_use]
    pub fn seen(&self, at: usize) -> Model<D> {
        let (mut segments, mut membership): (Vec<Segment<D>>, Vec<Membership>) =
            (Vec::new(), Vec::new());
        for leaf in self.leaves(at) {
            let frame = rigid(&(self.frames[at] * leaf.frame));
            segments.extend(leaf.model.segments().iter().map(|s| s.moved(&frame)));
            membership.extend((0..leaf.model.len()).map(|k| leaf.model.membership(k)));
        }
        Model::with_membership(segments, membership)
    }

    /// Writes what a thing or a part of it is made of: the only place where segments are written.
    pub(crate) fn set_body(&mut self, at: usize, path: &[usize], body: Body<D>) {
        self.writes.segments += count(&body);
        *body_at(&mut self.things[at].body, path) = body;
    }

    /// Sets the frame of a part against the whole that it is a part of.
    pub(crate) fn set_frame(&mut self, at: usize, path: &[usize], frame: Transition<D>) {
        let Some((&last, above)) = path.split_last() else {
            self.frames[at] = frame;
            self.writes.matrices += 1;
            return;
        };
        if let Body::Parts(parts) = body_at(&mut self.things[at].body, above) {
            parts[last].frame = frame;
            self.writes.matrices += 1;
        }
    }

    /// Levels below the Scene: 1 for a thing of segments, 2 for one of rigid parts, and so on.
    #[must_use]
    pub fn depth(&self, at: usize) -> usize {
        self.leaves(at).iter().map(|leaf| leaf.path.len() + 1).max().unwrap_or(1)
    }
}

/// The segments from `first` on that are joined and listed; they are listed no more.
fn run<const D: usize>(view: &Model<D>, first: usize, listed: &mut [bool]) -> Vec<usize> {
    let mut members = Vec::new();
    let mut at = Some(first);
    while let Some(k) = at.filter(|&k| listed[k]) {
        listed[k] = false;
        members.push(k);
        at = view.next(k).filter(|_| view.is_joined(k));
    }
    members
}

/// A frame in the middle of a model, not turned.
pub(crate) fn middle<const D: usize>(model: &Model<D>) -> Transition<D> {
    let sum: nalgebra::SVector<f64, D> = model.segments().iter().map(|s| s.at(0.5)).sum();
    let shift = sum / model.len().max(1) as f64;
    Transition::from_parts(shift.into(), nalgebra::Rotation::identity())
}

/// A transition as a motion without scaling.
pub(crate) fn rigid<const D: usize>(transition: &Transition<D>) -> Motion<D> {
    Motion::from_isometry(*transition, 1.0)
}

fn count<const D: usize>(body: &Body<D>) -> u64 {
    match body {
        Body::Rigid(model) => model.len() as u64,
        Body::Parts(parts) => parts.iter().map(|p| count(&p.body)).sum(),
    }
}

fn collect<'a, const D: usize>(
    body: &'a Body<D>,
    frame: &Transition<D>,
    path: &mut Vec<usize>,
    found: &mut Vec<Leaf<'a, D>>,
) {
    match body {
        Body::Rigid(model) => found.push(Leaf { path: path.clone(), frame: *frame, model }),
        Body::Parts(parts) => {
            for (k, part) in parts.iter().enumerate() {
                path.push(k);
                collect(&part.body, &(frame * part.frame), path, found);
                path.pop();
            }
        }
    }
}

/// What is at the end of a way; a way that leads nowhere ends where it leads to last.
fn body_at<'a, const D: usize>(body: &'a mut Body<D>, path: &[usize]) -> &'a mut Body<D> {
    match path.split_first() {
        Some((&first, rest)) if matches!(body, Body::Parts(parts) if first < parts.len()) => {
            match body {
                Body::Parts(parts) => body_at(&mut parts[first].body, rest),
                Body::Rigid(_) => body,
            }
        }
        _ => body,
    }
}
