//! A new observation against the map: what moved, what came apart, where the robot is (SPEC V15, V17, V18; paper 3,
//! section 4, fig. 2).

use nalgebra::Vector2;

use super::{Body, Part, Scene, middle, rigid};
use crate::{
    Difference, Euclid, Model, Motion, Observer, Residual, RigidPart, Segment, Space, ThingId,
    Transition, change::aligned, difference, project, radius, rigid_parts,
};

/// What is known of the robot's own motion since the last observation (V15).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Odometry<const D: usize> {
    /// It is so; what seems to have moved has moved.
    Exact(Transition<D>),
    /// It is about so; what most things say is believed more.
    Poor(Transition<D>),
    /// Switched on anywhere: the robot is where the things that it knows say.
    Unknown,
}

/// What became of a thing.
#[derive(Debug, Clone, PartialEq)]
pub enum Change<const D: usize> {
    /// It moved as a whole, in the robot's frame: its matrix alone is new (V17).
    Moved { thing: ThingId, motion: Transition<D> },
    /// A part known before moved against the whole.
    PartMoved { thing: ThingId, path: Vec<usize>, motion: Transition<D> },
    /// What was rigid fell into parts (V18): below `path` the tree grew a level.
    Reconfigured { thing: ThingId, path: Vec<usize>, parts: usize },
}

/// What an observation told.
#[derive(Debug, Clone, PartialEq)]
pub struct Report<const D: usize> {
    /// How the robot moved, in its old frame, as far as it was found: odometry corrected by the things at rest.
    pub robot: Transition<D>,
    pub changes: Vec<Change<D>>,
    /// Which segment of the map (thing, leaf, segment) each segment of the view is.
    pub known: Vec<Option<Owner>>,
    /// Segments of the view that the map does not have.
    pub appeared: Vec<usize>,
}

/// A segment of the map: position of its thing, of the leaf in the thing, of the segment in the leaf, as they were
/// before the observation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Owner {
    pub thing: usize,
    pub leaf: usize,
    pub segment: usize,
}

/// One leaf of a thing and how it was seen to move.
struct Motions<const D: usize> {
    path: Vec<usize>,
    /// Robot ← leaf, before.
    place: Transition<D>,
    /// Motion in the robot's frame, and by how many segments; none where nothing of it was seen.
    motion: Option<(Transition<D>, usize)>,
    told: Vec<(Segment<D>, Segment<D>)>,
}

impl<const D: usize> Scene<D>
where
    Euclid<D>: Space<D>,
{
    /// Holds a view against the map, and the map against it. Segments are written only where a thing comes apart.
    pub fn observe(&mut self, view: &Model<D>, odometry: Odometry<D>) -> Report<D> {
        let told = match odometry {
            Odometry::Exact(motion) | Odometry::Poor(motion) => motion,
            Odometry::Unknown => Transition::identity(),
        };
        if told != Transition::identity() {
            self.robot_moved(&told);
        }
        let (expected, owners) = self.expected();
        let guess = Motion::identity();
        let start = (odometry != Odometry::Unknown).then_some(&guess);
        let found = difference(&expected, view, start, &self.equality);
        let rest = match odometry {
            Odometry::Exact(_) => Transition::identity(),
            _ => found.parts.first().map_or_else(Transition::identity, |part| part.motion.isometry),
        };
        let mut known = vec![None; view.len()];
        for &(k, j, _) in &found.pairs {
            known[j] = Some(owners[k]);
        }
        let mut changes = Vec::new();
        for at in 0..self.things().len() {
            self.follow(at, &expected, view, &found, &owners, &rest, &mut changes);
        }
        // Everything at rest before the robot shows how the robot moved.
        let correction = rest.inverse();
        Report { robot: told * correction, changes, known, appeared: found.appeared }
    }

    /// All segments of the map before the robot, and whose they are.
    fn expected(&self) -> (Model<D>, Vec<Owner>) {
        let (mut segments, mut owners) = (Vec::new(), Vec::new());
        for (thing, frame) in self.frames().iter().enumerate() {
            for (leaf, below) in self.leaves(thing).into_iter().enumerate() {
                let place = rigid(&(frame * below.frame));
                for (segment, s) in below.model.segments().iter().enumerate() {
                    segments.push(s.moved(&place));
                    owners.push(Owner { thing, leaf, segment });
                }
            }
        }
        (Model::of_contour(segments), owners)
    }

    /// One thing: first whether its leaves are rigid still, then how they moved, then how the whole did.
    #[expect(clippy::too_many_arguments, reason = "one step of observe, with what observe found")]
    fn follow(
        &mut self,
        at: usize,
        expected: &Model<D>,
        view: &Model<D>,
        found: &Difference<D>,
        owners: &[Owner],
        rest: &Transition<D>,
        changes: &mut Vec<Change<D>>,
    ) {
        let thing = self.things()[at].id;
        let leaves: Vec<(Vec<usize>, Transition<D>)> = self
            .leaves(at)
            .into_iter()
            .map(|leaf| (leaf.path, self.frames()[at] * leaf.frame))
            .collect();
        let mut motions: Vec<Motions<D>> = Vec::new();
        for (leaf, (path, place)) in leaves.into_iter().enumerate() {
            let own: Vec<(usize, usize, bool)> = found
                .pairs
                .iter()
                .filter(|(k, ..)| owners[*k].thing == at && owners[*k].leaf == leaf)
                .copied()
                .collect();
            let (told, next) = aligned(expected, view, &own);
            let parts = rigid_parts(&told, &next, &rigid(rest), &self.equality);
            let segments: Vec<usize> = own.iter().map(|(k, ..)| owners[*k].segment).collect();
            if parts.len() < 2 {
                let motion = parts.first().map(|p| (p.motion.isometry, p.members.len()));
                motions.push(Motions { path, place, motion, told });
                continue;
            }
            changes.push(Change::Reconfigured { thing, path: path.clone(), parts: parts.len() });
            for (k, (part, frame)) in
                parts.iter().zip(self.take_apart(at, &path, &parts, &segments)).enumerate()
            {
                let mut below = path.clone();
                below.push(k);
                let told = part.members.iter().map(|&m| told[m]).collect();
                let motion = Some((part.motion.isometry, part.members.len()));
                motions.push(Motions { path: below, place: place * frame, motion, told });
            }
        }
        self.place(at, &motions, rest, changes);
    }

    /// Puts a thing and its leaves where they were seen.
    fn place(
        &mut self,
        at: usize,
        motions: &[Motions<D>],
        rest: &Transition<D>,
        changes: &mut Vec<Change<D>>,
    ) {
        let thing = self.things()[at].id;
        let seen = |m: &&Motions<D>| m.motion.is_some();
        let reference = motions.iter().filter(seen).max_by_key(|m| m.motion.map(|m| m.1));
        let whole = match reference {
            Some(m) => match m.motion {
                Some((motion, _)) if moved(&m.told, rest, &motion) => {
                    changes.push(Change::Moved { thing, motion });
                    motion
                }
                _ => *rest,
            },
            None => *rest,
        };
        if whole != Transition::identity() {
            self.thing_moved(at, &whole);
        }
        let after = self.frames()[at];
        for leaf in motions {
            let Some((motion, _)) = leaf.motion else { continue };
            if leaf.path.is_empty() || !moved(&leaf.told, &whole, &motion) {
                continue;
            }
            // Thing ← leaf, as it is now; then against the part above it.
            let now = after.inverse() * motion * leaf.place;
            let above = self.above(at, &leaf.path);
            self.set_frame(at, &leaf.path, above.inverse() * now);
            changes.push(Change::PartMoved { thing, path: leaf.path.clone(), motion });
        }
    }

    /// Thing ← the node above a leaf.
    fn above(&self, at: usize, path: &[usize]) -> Transition<D> {
        let mut frame = Transition::identity();
        let mut body = self.things()[at].body();
        for &k in &path[..path.len() - 1] {
            let Body::Parts(parts) = body else { break };
            frame *= parts[k].frame;
            body = &parts[k].body;
        }
        frame
    }

    /// Puts a level between a leaf and its segments: one part for each set that moved by itself. Segments that were
    /// not seen stay with their neighbours on the contour. Returns the parts' frames.
    fn take_apart(
        &mut self,
        at: usize,
        path: &[usize],
        parts: &[RigidPart<D>],
        segments: &[usize],
    ) -> Vec<Transition<D>> {
        let leaf = self
            .leaves(at)
            .into_iter()
            .find(|leaf| leaf.path == path)
            .map(|leaf| leaf.model.clone());
        let Some(model) = leaf else { return Vec::new() };
        let mut part_of: Vec<Option<usize>> = vec![None; model.len()];
        for (p, part) in parts.iter().enumerate() {
            for &m in &part.members {
                part_of[segments[m]] = Some(p);
            }
        }
        // Outward from what was seen, one segment to either side at a time.
        loop {
            let before = part_of.clone();
            for k in 0..model.len() {
                if before[k].is_none() {
                    part_of[k] = [model.previous(k), model.next(k)]
                        .into_iter()
                        .flatten()
                        .find_map(|n| before[n]);
                }
            }
            if part_of == before {
                break;
            }
        }
        let mut frames = Vec::new();
        let bodies = (0..parts.len()).map(|p| {
            let members: Vec<usize> =
                (0..model.len()).filter(|&k| part_of[k].unwrap_or(0) == p).collect();
            let part = model.part(&members);
            let frame = middle(&part);
            frames.push(frame);
            Part { frame, body: Body::Rigid(part.moved(&rigid(&frame.inverse()))) }
        });
        let body = Body::Parts(bodies.collect());
        self.set_body(at, path, body);
        self.writes.matrices += parts.len() as u64;
        frames
    }

    /// Joins what a view showed into the map (V6): what is known becomes surer, in its own frame.
    pub fn learn(&mut self, view: &Model<D>, report: &Report<D>) {
        for at in 0..self.things().len() {
            let id = self.things()[at].id;
            // The leaves that the report names are not there any more.
            let apart =
                |c: &Change<D>| matches!(c, Change::Reconfigured { thing, .. } if *thing == id);
            if report.changes.iter().any(apart) {
                continue;
            }
            let leaves = self.leaves(at);
            let mut updates = Vec::new();
            for (leaf, below) in leaves.iter().enumerate() {
                let place = rigid(&(self.frames()[at] * below.frame)).inverse();
                let own =
                    |j: &usize| report.known[*j].is_some_and(|o| o.thing == at && o.leaf == leaf);
                let seen: Vec<usize> = (0..view.len()).filter(own).collect();
                if !seen.is_empty() {
                    let united =
                        below.model.united(&view.part(&seen).moved(&place), &self.equality);
                    updates.push((below.path.clone(), united));
                }
            }
            for (path, model) in updates {
                self.set_body(at, &path, Body::Rigid(model));
            }
        }
    }
}

impl Scene<2> {
    /// Counts what of the map should have been in a view, and was (V9): what no nearer segment hides and the sensor
    /// delivers for more than half of its length. What the sensor loses counts neither way (V7).
    pub fn witness(&mut self, report: &Report<2>, sensor: &Observer<2>) {
        let (expected, owners) = self.expected();
        let images = sensor.observe(&project(&expected.whole_images(), &Vector2::zeros()));
        let mut visible = vec![0.0; expected.len()];
        for image in &images.images {
            visible[image.source] +=
                image.segment.length() / expected.segments()[image.source].length().max(1e-9);
        }
        let seen: std::collections::HashSet<Owner> =
            report.known.iter().copied().flatten().collect();
        let mut counts: std::collections::BTreeMap<(usize, usize), (Vec<usize>, Vec<usize>)> =
            std::collections::BTreeMap::new();
        for (k, owner) in owners.iter().enumerate() {
            let (was, should) = counts.entry((owner.thing, owner.leaf)).or_default();
            if visible[k] > 0.5 || seen.contains(owner) {
                should.push(owner.segment);
            }
            if seen.contains(owner) {
                was.push(owner.segment);
            }
        }
        for ((at, leaf), (was, should)) in counts {
            let path = self.leaves(at)[leaf].path.clone();
            if let Body::Rigid(model) = super::body_at(&mut self.things[at].body, &path) {
                model.witness(was, should);
            }
        }
    }
}

/// Whether one motion explains what was seen so much better than another that chance does not.
fn moved<const D: usize>(
    told: &[(Segment<D>, Segment<D>)],
    still: &Transition<D>,
    motion: &Transition<D>,
) -> bool {
    let sum = |t: &Transition<D>| -> f64 {
        let motion = rigid(t);
        told.iter()
            .map(|(before, after)| {
                Residual::between(&before.moved(&motion), after)
                    .map_or(100.0, |r| r.squared().min(100.0))
            })
            .sum()
    };
    let freedom = if D == 2 { 3 } else { 6 };
    sum(still) - sum(motion) > radius(0.9997, freedom).powi(2)
}
