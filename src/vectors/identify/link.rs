//! What the index is hashed by: two segments near one another on a contour, by invariants alone (SPEC V4, V5, V19).
//!
//! ```text
//!        la            gap            lb
//!   ●─────────── A            B ───────────●        A, B: the inner ends, both true
//!               α \_ _ _ _ _ _/ β
//! ```
//!
//! The gap is what stands, or stood, between: one segment (a triple in a row: its length), several, or an opening.
//! Two segments that meet in a corner have no gap: their turn and their lengths are the key. A length counts where
//! the outer end is true.

use crate::{Euclid, Model, Space, Turn};

/// Whether lengths mean something by themselves, or by their ratios alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Scale {
    /// The sensor measures lengths: laser, stereo.
    Known,
    /// A picture from an unknown distance: g'(α) is to be found as well.
    Free,
}

/// Two segments of a model, `a` before `b` on the contour, and what of them stays the same.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Link {
    pub(crate) a: usize,
    pub(crate) b: usize,
    /// All that stands between is seen and joined: a thing that has all of it has the two as near.
    pub(crate) certain: bool,
    pub(crate) shape: Shape,
}

/// The invariants of a link; angles in rad, lengths in cm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shape {
    pub(crate) corner: bool,
    /// Turn from the gap into either segment; at a corner `alpha` is the turn from one to the other.
    pub(crate) alpha: f64,
    pub(crate) beta: f64,
    /// Turn of one segment against the other about the gap: zero in the plane.
    pub(crate) dihedral: f64,
    pub(crate) gap: f64,
    pub(crate) lengths: [f64; 2],
    /// Whether the lengths are measurements, not lower bounds.
    pub(crate) exact: [bool; 2],
    /// Deviation of a coordinate of an end.
    pub(crate) deviations: [f64; 2],
}

impl Shape {
    /// The same link told from `b`.
    pub(crate) fn swapped(&self) -> Self {
        let [p, q] = self.lengths;
        let [e, f] = self.exact;
        let [s, t] = self.deviations;
        let (alpha, beta) =
            if self.corner { (-self.alpha, self.beta) } else { (self.beta, self.alpha) };
        Self { alpha, beta, lengths: [q, p], exact: [f, e], deviations: [t, s], ..*self }
    }

    pub(crate) const fn is_whole(&self) -> bool {
        self.exact[0] && self.exact[1]
    }
}

/// Links of a stored model, from each segment to the next `reach` ones on its contour.
pub(crate) fn links<const D: usize>(model: &Model<D>, reach: usize) -> impl Iterator<Item = Link>
where
    Euclid<D>: Space<D>,
{
    walks(model, reach, false)
        .filter(move |&(a, b, ..)| !runs_backward(model, a, b, reach))
        .filter_map(link(model))
}

/// Links of a view: what comes last may be beside what comes first, with the hidden side between.
pub(crate) fn links_of_view<const D: usize>(
    view: &Model<D>,
    reach: usize,
) -> impl Iterator<Item = Link>
where
    Euclid<D>: Space<D>,
{
    walks(view, reach, true).filter_map(link(view))
}

/// From each segment to those after it: the two, whether they meet in a corner, and whether all between surely is joined.
fn walks<const D: usize>(
    model: &Model<D>,
    reach: usize,
    around: bool,
) -> impl Iterator<Item = (usize, usize, bool, bool)> {
    (0..model.len()).flat_map(move |a| {
        let (mut certain, mut b) = (true, a);
        (1..=reach).map_while(move |step| {
            let from = b;
            b = model.next(b).or(around.then_some(0)).filter(|&b| b != a)?;
            certain &= model.is_joined(from) && touch(model, from, b);
            Some((a, b, step == 1 && model.is_joined(from), certain))
        })
    })
}

/// Whether one corner was found for both, not two near one another: a small face may hide between those.
fn touch<const D: usize>(model: &Model<D>, a: usize, b: usize) -> bool {
    let (a, b) = (&model.segments()[a], &model.segments()[b]);
    (b.start - a.end).norm() <= 0.1 * a.covariance.deviation().max(b.covariance.deviation())
}

fn link<const D: usize>(model: &Model<D>) -> impl Fn((usize, usize, bool, bool)) -> Option<Link>
where
    Euclid<D>: Space<D>,
{
    |(a, b, corner, certain)| {
        let shape = shape(model, a, b, corner)?;
        Some(Link { a, b, certain, shape })
    }
}

/// Whether the contour leads from `b` to `a` rather than from `a` to `b`; in a small ring, by the shorter way.
pub(crate) fn runs_backward<const D: usize>(
    model: &Model<D>,
    a: usize,
    b: usize,
    reach: usize,
) -> bool {
    let steps = |from: usize, to: usize| {
        let mut at = from;
        (1..=reach).find(|_| {
            at = model.next(at).unwrap_or(from);
            at == to
        })
    };
    match (steps(a, b), steps(b, a)) {
        (Some(there), Some(back)) => there > back || (there == back && a > b),
        (there, _) => there.is_none(),
    }
}

/// The invariants of segments `a` and `b`; `None` where too little of them was seen to tell.
pub(crate) fn shape<const D: usize>(
    model: &Model<D>,
    a: usize,
    b: usize,
    corner: bool,
) -> Option<Shape>
where
    Euclid<D>: Space<D>,
{
    let (first, second) = (&model.segments()[a], &model.segments()[b]);
    let deviations = [first.covariance.deviation(), second.covariance.deviation()];
    let lengths = [first.length(), second.length()];
    let exact = [first.ends[0].is_true(), second.ends[1].is_true()];
    let noise = deviations[0].max(deviations[1]);
    if corner {
        let alpha = Turn::between(first, second)?.angle();
        return Some(Shape {
            corner,
            alpha,
            beta: 0.0,
            dihedral: 0.0,
            gap: 0.0,
            lengths,
            exact,
            deviations,
        });
    }
    if !first.ends[1].is_true() || !second.ends[0].is_true() {
        return None;
    }
    let between = second.start - first.end;
    let gap = between.norm();
    // Shorter than its own error, a gap has no direction.
    if gap < 6.0 * noise || gap < 1e-6 {
        return None;
    }
    let u = between / gap;
    let (into_a, into_b) =
        (-first.vector().try_normalize(1e-9)?, second.vector().try_normalize(1e-9)?);
    let angle = |(sine, cosine): (f64, f64)| sine.atan2(cosine);
    let alpha = angle(Euclid::turn(&-u, &into_a));
    let beta = angle(Euclid::turn(&u, &into_b));
    let dihedral = Euclid::dihedral(&u, &into_a, &into_b);
    Some(Shape { corner, alpha, beta, dihedral, gap, lengths, exact, deviations })
}

/// Which links can be compared with which.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    Corner,
    /// Both lengths known, and used.
    Whole,
    /// A length is not known.
    Part,
    /// Both lengths known, and not used: for views that do not know them.
    WholeAsPart,
    /// A corner of which a length is not known, by its turn: the last resort.
    Turn,
    /// A corner whose lengths are known, and not used.
    WholeAsTurn,
}

/// One invariant as a coordinate of the hash.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Axis {
    pub(crate) value: f64,
    /// How far it may be from its match.
    pub(crate) tolerance: f64,
    /// Size of a cell.
    pub(crate) grain: f64,
    /// Cells after which it begins anew, for angles.
    pub(crate) period: i64,
    /// How far values are spread, roughly: for what a lookup may cost.
    pub(crate) spread: f64,
}

/// A link as a key: axes of which the last one is kept sorted, not hashed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Key {
    pub(crate) kind: Kind,
    axes: [Axis; 6],
    count: usize,
}

impl Key {
    pub(crate) fn axes(&self) -> &[Axis] {
        &self.axes[..self.count]
    }

    /// Of a shape, with tolerances of `radius` deviations when its match has deviation `stored` cm.
    pub(crate) fn of<const D: usize>(
        shape: &Shape,
        kind: Kind,
        scale: Scale,
        radius: f64,
        stored: f64,
    ) -> Self {
        let [s, t] = shape.deviations.map(|own| radius * own.hypot(stored));
        let both = s.hypot(t);
        let mut key = Self { kind, axes: [Axis::default(); 6], count: 0 };
        // Ends of one segment err by √2 against one another; nothing is known of a direction shorter than its error.
        let swing = |error: f64, length: f64| lean(std::f64::consts::SQRT_2 * error, length);
        let [p, q] = shape.lengths;
        if shape.corner {
            key.angle(shape.alpha, swing(s, p) + swing(t, q));
            if kind != Kind::Corner {
                return key;
            }
            match scale {
                Scale::Known => {
                    key.length(p, std::f64::consts::SQRT_2 * s);
                    key.length(q, std::f64::consts::SQRT_2 * t);
                }
                Scale::Free => key.log(q / p, (s / p).hypot(t / q) * 1.5),
            }
            return key;
        }
        let gap = shape.gap;
        key.angle(shape.alpha, swing(s, p).hypot(lean(both, gap)));
        key.angle(shape.beta, swing(t, q).hypot(lean(both, gap)));
        if D == 3 {
            // Near the gap's own direction a segment has no turn about it.
            let flat = |angle: f64| angle.sin().abs().max(1e-3);
            let tilt = |error: f64, length: f64, angle: f64| {
                (swing(error, length) + lean(both, gap)) / flat(angle)
            };
            key.angle(shape.dihedral, tilt(s, p, shape.alpha).hypot(tilt(t, q, shape.beta)));
        }
        match scale {
            Scale::Known => key.length(gap, both),
            Scale::Free => {}
        }
        if kind == Kind::Whole {
            match scale {
                Scale::Known => {
                    key.length(p, std::f64::consts::SQRT_2 * s);
                    key.length(q, std::f64::consts::SQRT_2 * t);
                }
                Scale::Free => {
                    key.log(p / gap, swing(s, p).hypot(lean(both, gap)));
                    key.log(q / gap, swing(t, q).hypot(lean(both, gap)));
                }
            }
        }
        key
    }

    fn push(&mut self, axis: Axis) {
        self.axes[self.count] = axis;
        self.count += 1;
    }

    fn angle(&mut self, value: f64, tolerance: f64) {
        // 64 cells to the turn.
        let grain = std::f64::consts::TAU / 64.0;
        self.push(Axis { value, tolerance, grain, period: 64, spread: 3.0 });
    }

    fn length(&mut self, value: f64, tolerance: f64) {
        self.push(Axis { value, tolerance, grain: 8.0, period: 0, spread: 150.0 });
    }

    fn log(&mut self, ratio: f64, tolerance: f64) {
        self.push(Axis {
            value: ratio.max(1e-12).ln(),
            tolerance,
            grain: 0.1,
            period: 0,
            spread: 2.0,
        });
    }

    /// Whether a stored link of the same kind lies within the tolerances.
    pub(crate) fn admits(&self, other: &Self) -> bool {
        self.axes().iter().zip(other.axes()).all(|(axis, theirs)| {
            let apart = (axis.value - theirs.value).abs();
            let apart =
                if axis.period > 0 { apart.min(std::f64::consts::TAU - apart) } else { apart };
            apart <= axis.tolerance + 1e-9
        })
    }

    /// The cells that the tolerances reach, of all axes but the last: how many.
    pub(crate) fn cells(&self) -> f64 {
        self.axes()[..self.count - 1].iter().map(|axis| axis.span().1 as f64).product()
    }

    /// Share of stored links of this kind that may fit.
    pub(crate) fn share(&self) -> f64 {
        let hashed =
            self.axes()[..self.count - 1].iter().map(|a| a.span().1 as f64 * a.grain / a.spread);
        let last = self.axes()[self.count - 1];
        hashed.chain([2.0 * last.tolerance / last.spread]).map(|s| s.min(1.0)).product()
    }
}

impl Axis {
    /// First cell within the tolerance, and how many there are.
    pub(crate) fn span(&self) -> (i64, i64) {
        let cell = |x: f64| (x / self.grain).floor().clamp(-1e9, 1e9) as i64;
        let (low, high) = (cell(self.value - self.tolerance), cell(self.value + self.tolerance));
        let count = high - low + 1;
        (low, if self.period > 0 { count.min(self.period) } else { count })
    }

    /// The cell that the value itself lies in.
    pub(crate) fn cell(&self) -> i64 {
        self.wrapped((self.value / self.grain).floor().clamp(-1e9, 1e9) as i64)
    }

    pub(crate) const fn wrapped(&self, cell: i64) -> i64 {
        if self.period > 0 { cell.rem_euclid(self.period) } else { cell }
    }
}

/// The greatest angle by which a vector of this length is turned by an error across it.
fn lean(error: f64, length: f64) -> f64 {
    if error < length { (error / length).asin() } else { std::f64::consts::PI }
}

/// The order in which a link is stored: the longer segment first, or, where lengths are not known, the greater turn.
///
/// Returns whether `shape` is to be swapped, and whether the order is within its own errors, so that both are asked.
pub(crate) fn canonical(shape: &Shape, kind: Kind, radius: f64, stored: f64) -> (bool, bool) {
    let [s, t] = shape.deviations.map(|own| radius * own.hypot(stored));
    match kind {
        // A turn alone does not say which is which.
        Kind::Turn | Kind::WholeAsTurn => (false, true),
        Kind::Corner | Kind::Whole => {
            let apart = shape.lengths[0] - shape.lengths[1];
            (apart < 0.0, apart.abs() <= std::f64::consts::SQRT_2 * (s + t))
        }
        Kind::Part | Kind::WholeAsPart => {
            let apart = shape.alpha.abs() - shape.beta.abs();
            let error = std::f64::consts::SQRT_2
                * (s / shape.lengths[0] + t / shape.lengths[1] + (s + t) / shape.gap);
            (apart < 0.0, apart.abs() <= error)
        }
    }
}
