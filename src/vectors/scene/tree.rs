//! The map as a tree, for print and drawing (paper 3, fig. 1).

use std::fmt;

use super::{Body, Scene};
use crate::{Euclid, Segment, Space, ThingId, Transition};

/// What a node of the map stands for.
#[derive(Debug, Clone, PartialEq)]
pub enum Node<const D: usize> {
    Robot,
    /// The same point as the Robot.
    Scene,
    /// A thing, and from its frame to the robot's.
    Thing(ThingId, Transition<D>),
    /// A part, and from its frame to that of the node above.
    Part(usize, Transition<D>),
    /// A segment in the frame of the node above.
    Segment(usize, Segment<D>),
}

/// A node with what hangs below it.
#[derive(Debug, Clone, PartialEq)]
pub struct TreeNode<const D: usize> {
    pub node: Node<D>,
    pub below: Vec<Self>,
}

impl<const D: usize> Scene<D>
where
    Euclid<D>: Space<D>,
{
    /// The whole map: Robot → Scene → things → parts → segments.
    #[must_use]
    pub fn tree(&self) -> TreeNode<D> {
        let things = self.things().iter().zip(self.frames());
        let below = things
            .map(|(t, frame)| TreeNode { node: Node::Thing(t.id, *frame), below: hang(t.body()) });
        let scene = TreeNode { node: Node::Scene, below: below.collect() };
        TreeNode { node: Node::Robot, below: vec![scene] }
    }
}

fn hang<const D: usize>(body: &Body<D>) -> Vec<TreeNode<D>> {
    match body {
        Body::Rigid(model) => {
            let segments = model.segments().iter().enumerate();
            segments
                .map(|(k, s)| TreeNode { node: Node::Segment(k, *s), below: Vec::new() })
                .collect()
        }
        Body::Parts(parts) => {
            let parts = parts.iter().enumerate();
            parts
                .map(|(k, p)| TreeNode { node: Node::Part(k, p.frame), below: hang(&p.body) })
                .collect()
        }
    }
}

impl<const D: usize> fmt::Display for TreeNode<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write(self, 0, f)
    }
}

fn write<const D: usize>(
    tree: &TreeNode<D>,
    depth: usize,
    f: &mut fmt::Formatter<'_>,
) -> fmt::Result {
    let place = |t: &Transition<D>| {
        let shift: Vec<String> = t.translation.vector.iter().map(|x| format!("{x:.1}")).collect();
        format!("({})", shift.join(", "))
    };
    write!(f, "{:indent$}", "", indent = 2 * depth)?;
    match &tree.node {
        Node::Robot => writeln!(f, "Robot")?,
        Node::Scene => writeln!(f, "Scene")?,
        Node::Thing(id, frame) => writeln!(f, "thing {} at {}", id.0, place(frame))?,
        Node::Part(k, frame) => writeln!(f, "part {k} at {}", place(frame))?,
        Node::Segment(k, s) => {
            let point = |p: &nalgebra::SVector<f64, D>| {
                let at: Vec<String> = p.iter().map(|x| format!("{x:.1}")).collect();
                format!("({})", at.join(", "))
            };
            writeln!(f, "segment {k} {} - {}", point(&s.start), point(&s.end))?;
        }
    }
    tree.below.iter().try_for_each(|node| write(node, depth + 1, f))
}
