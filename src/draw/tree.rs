//! A tree from the top down, each node under the middle of what hangs above it (paper 3, fig. 1).
//!
//! **Invariant.** No two nodes overlap, and a node stands between its first and its last child.

use crate::geometry::Bounds;
use crate::units::{Point, Vector};

use super::canvas::{Anchor, Canvas, Lettering, Style};
use super::font::text_width;

/// A node with what hangs below it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TreeNode {
    /// One or two lines.
    pub lines: Vec<String>,
    pub below: Vec<Self>,
    /// The same point as its parent: joined by a double line.
    pub is_same: bool,
}

const LETTER: f64 = 12.0;
const LEVEL: f64 = 92.0;
const GAP: f64 = 14.0;
const LINE: f64 = 16.0;
const INK: &str = "#22303c";
const BOX: Style = Style::fill("#eef3f7").outlined("#2c5f8a", 1.4);
const LEAF: Style = Style::fill("#ffffff").outlined("#9aa7b0", 1.0);
const JOINT: Style = Style::line("#5b6770", 1.2);

/// The tree as an SVG document.
#[must_use]
pub fn tree_svg(title: &str, root: &TreeNode) -> String {
    let mut placed = Vec::new();
    let mut joints = Vec::new();
    let mut free = 0.0;
    place(root, 0, &mut free, &mut placed, &mut joints);
    let depth = placed.iter().map(|p| p.level).max().unwrap_or(0) as f64;
    let width = (free - GAP).max(text_width(title, 17.0, true)).max(300.0);
    let sheet = Bounds {
        min: Point::new(-20.0, -LEVEL * depth - 50.0),
        max: Point::new(width + 20.0, 80.0),
    };
    let mut canvas = Canvas::new(sheet).wide((sheet.max.x - sheet.min.x).clamp(500.0, 2400.0));
    canvas.mark("heading");
    let head = Lettering { anchor: Anchor::Start, halo: false, ..Lettering::bold(17.0, INK) };
    canvas.text(Point::new(0.0, 58.0), title, head);
    canvas.mark("joint");
    for (above, below, is_same) in joints {
        let (a, b) = (placed[above].at, placed[below].at);
        let shift = Vector::new(if is_same { 3.0 } else { 0.0 }, 0.0);
        canvas.segment(a - shift, b - shift, JOINT);
        if is_same {
            canvas.segment(a + shift, b + shift, JOINT);
        }
    }
    for node in &placed {
        canvas.mark(if node.is_leaf { "leaf" } else { "node" });
        let half = Vector::new(node.wide / 2.0, node.tall / 2.0);
        let frame = Bounds { min: node.at - half, max: node.at + half };
        canvas.rectangle(frame, if node.is_leaf { LEAF } else { BOX }, 4.0);
        let top = node.at.y + LINE * (node.lines.len() as f64 - 1.0) / 2.0;
        for (k, line) in node.lines.iter().enumerate() {
            let at = Point::new(node.at.x, top - LINE * k as f64);
            canvas.text(at, line, Lettering { halo: false, ..Lettering::plain(LETTER, INK) });
        }
    }
    canvas.into_svg(title)
}

struct Placed<'t> {
    at: Point,
    level: usize,
    wide: f64,
    tall: f64,
    lines: &'t [String],
    is_leaf: bool,
}

/// Places a node and all below it, leaves from left to right; gives its number.
fn place<'t>(
    node: &'t TreeNode,
    level: usize,
    free: &mut f64,
    placed: &mut Vec<Placed<'t>>,
    joints: &mut Vec<(usize, usize, bool)>,
) -> usize {
    let wide = node.lines.iter().map(|l| text_width(l, LETTER, false)).fold(16.0, f64::max) + 16.0;
    let tall = LINE * node.lines.len().max(1) as f64 + 10.0;
    let start = *free;
    let below: Vec<(usize, bool)> = node
        .below
        .iter()
        .map(|child| (place(child, level + 1, free, placed, joints), child.is_same))
        .collect();
    let middle = match (below.first(), below.last()) {
        (Some(first), Some(last)) => (placed[first.0].at.x + placed[last.0].at.x) / 2.0,
        _ => start + wide / 2.0,
    };
    // A node wider than what hangs below it takes its room to both sides.
    let x = middle.max(start + wide / 2.0);
    if x > middle {
        let shift = x - middle;
        shift_all(&below, placed, joints, shift);
        *free += shift;
    }
    *free = free.max(x + wide / 2.0 + GAP);
    let at = Point::new(x, -LEVEL * level as f64);
    let is_leaf = node.below.is_empty();
    placed.push(Placed { at, level, wide, tall, lines: &node.lines, is_leaf });
    let number = placed.len() - 1;
    joints.extend(below.into_iter().map(|(child, is_same)| (number, child, is_same)));
    number
}

/// Moves subtrees to the right.
fn shift_all(
    roots: &[(usize, bool)],
    placed: &mut [Placed<'_>],
    joints: &[(usize, usize, bool)],
    by: f64,
) {
    let mut open: Vec<usize> = roots.iter().map(|r| r.0).collect();
    while let Some(node) = open.pop() {
        placed[node].at.x += by;
        open.extend(joints.iter().filter(|j| j.0 == node).map(|j| j.1));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node(text: &str, below: Vec<TreeNode>) -> TreeNode {
        TreeNode { lines: vec![text.to_owned()], below, is_same: false }
    }

    #[test]
    fn no_nodes_overlap() {
        let leaf = |k: usize| node(&"я".repeat(1 + 7 * (k % 4)), Vec::new());
        let wide = node(&"широкий".repeat(6), vec![leaf(0), leaf(1)]);
        let root = node("R", vec![node("S", vec![leaf(3), wide, leaf(2)]), leaf(1)]);
        let (mut placed, mut joints, mut free) = (Vec::new(), Vec::new(), 0.0);
        place(&root, 0, &mut free, &mut placed, &mut joints);
        for (i, a) in placed.iter().enumerate() {
            assert!(a.at.x - a.wide / 2.0 >= -1e-9 && a.at.x + a.wide / 2.0 <= free + 1e-9);
            for b in placed[..i].iter().filter(|b| b.level == a.level) {
                let apart = (a.at.x - b.at.x).abs() >= (a.wide + b.wide) / 2.0;
                assert!(apart, "{:?} over {:?}", a.lines, b.lines);
            }
        }
        assert_eq!(joints.len(), placed.len() - 1);
    }
}
