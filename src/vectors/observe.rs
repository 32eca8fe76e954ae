//! What of a full model an observer has before him: H → M → Pr → O → μ (SPEC V7, V8; paper 3, sections 2 and 3).
//!
//! `Pr` takes what the thing itself hides from a place; it is idempotent, and only turning acts on it. `O` is the
//! sensor: a field of view, a range and a resolution; only scaling (distance) acts on it. What `O` does not deliver
//! is its kernel: lost, and told as lost, not as absent.

use nalgebra::{SVector, Vector2};

use crate::{Cut, End, Model, Segment};

/// Part of a stored segment, as a place or a sensor has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Image<const D: usize> {
    /// Which segment of the model it is a part of.
    pub source: usize,
    pub segment: Segment<D>,
}

/// Why a part of a model did not reach the observation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Loss {
    /// Its image is smaller than what the sensor tells apart: δx > α·|Pr σ|.
    Resolution,
    /// Outside the field of view.
    Field,
    /// Nearer or farther than the sensor measures.
    Range,
}

/// An observer at the origin and the sensor that it sees with: the operator O.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observer<const D: usize> {
    /// Middle of the field of view, a unit vector.
    pub axis: SVector<f64, D>,
    /// Half the field of view, in rad; π sees all around.
    pub half_field: f64,
    /// Least and greatest distance, in cm.
    pub range: (f64, f64),
    /// The angle that an image must span, in rad.
    pub resolution: f64,
}

/// What a sensor delivers of what is before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation<const D: usize> {
    pub images: Vec<Image<D>>,
    /// Source segments of which some part was there and not delivered.
    pub lost: Vec<(usize, Loss)>,
}

impl Model<2> {
    /// Pr: the parts of the segments that are seen from `eye`, whatever the sensor; segments hide what lies behind.
    #[must_use]
    pub fn projected(&self, eye: &Vector2<f64>) -> Vec<Image<2>> {
        project(&self.whole_images(), eye)
    }
}

impl<const D: usize> Model<D> {
    /// Each segment as an image of itself: where nothing hides anything.
    #[must_use]
    pub fn whole_images(&self) -> Vec<Image<D>> {
        self.segments()
            .iter()
            .enumerate()
            .map(|(source, &segment)| Image { source, segment })
            .collect()
    }
}

/// Pr of any images: what is hidden from `eye` by others is taken away; ends that arise so are cut.
#[must_use]
pub fn project(images: &[Image<2>], eye: &Vector2<f64>) -> Vec<Image<2>> {
    let mut around: Vec<Vec<Shadow>> = vec![Vec::new(); SECTORS];
    for shadow in images.iter().filter_map(|i| Shadow::of(&i.segment, eye)) {
        sectors(&shadow.right, &shadow.left).for_each(|k| around[k].push(shadow));
    }
    let mut seen = Vec::with_capacity(images.len());
    for image in images {
        let (p, q) = (image.segment.start - eye, image.segment.end - eye);
        let (right, left) = if p.perp(&q) < 0.0 { (&q, &p) } else { (&p, &q) };
        // What is met in several sectors is hidden once, however often it is told.
        let shadows = sectors(right, left).flat_map(|k| &around[k]);
        let mut hidden: Vec<(f64, f64)> = shadows.filter_map(|s| s.on(&p, &q)).collect();
        hidden.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut from = 0.0;
        let mut open = Vec::new();
        for (a, b) in hidden {
            if a > from {
                open.push((from, a));
            }
            from = from.max(b);
        }
        open.push((from, 1.0));
        // What is left between two shadows that meet is rounding, not sight.
        let least = 1e-7 / image.segment.length().max(1e-7);
        for (a, b) in open.into_iter().filter(|(a, b)| b - a > least) {
            seen.push(Image {
                source: image.source,
                segment: image.segment.piece(a, b, Cut::Occluded),
            });
        }
    }
    seen
}

/// Sectors about the eye: only what shares one can hide.
const SECTORS: usize = 256;

/// The sectors from the bearing of `right` counter-clockwise to that of `left`.
fn sectors(right: &Vector2<f64>, left: &Vector2<f64>) -> impl Iterator<Item = usize> + use<> {
    let of = |v: &Vector2<f64>| {
        let share = v.y.atan2(v.x) / std::f64::consts::TAU + 0.5;
        (share * SECTORS as f64) as usize % SECTORS
    };
    let (from, to) = (of(right), of(left));
    (0..=(to + SECTORS - from) % SECTORS).map(move |k| (from + k) % SECTORS)
}

/// The region behind a segment: three half-planes about the eye.
#[derive(Clone, Copy)]
struct Shadow {
    /// Clockwise end and counter-clockwise end, from the eye.
    right: Vector2<f64>,
    left: Vector2<f64>,
}

impl Shadow {
    /// `None` for a segment seen end on, which hides nothing.
    fn of(segment: &Segment<2>, eye: &Vector2<f64>) -> Option<Self> {
        let (a, b) = (segment.start - eye, segment.end - eye);
        let width = a.perp(&b);
        if width.abs() <= 1e-9 * a.norm() * b.norm() {
            return None;
        }
        Some(if width > 0.0 { Self { right: a, left: b } } else { Self { right: b, left: a } })
    }

    /// Where the segment from `p` to `q` lies in the shadow, as shares of its length.
    fn on(&self, p: &Vector2<f64>, q: &Vector2<f64>) -> Option<(f64, f64)> {
        let front = self.left - self.right;
        let scale = front.norm();
        // Each is positive inside, and linear along the segment.
        let inside = |x: &Vector2<f64>| {
            [self.right.perp(x), x.perp(&self.left), (x - self.right).perp(&front) / scale - 1e-7]
        };
        let (at_p, at_q) = (inside(p), inside(q));
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (f, g) in at_p.into_iter().zip(at_q) {
            match (f > 0.0, g > 0.0) {
                (false, false) => return None,
                (true, true) => {}
                (true, false) => to = to.min(f / (f - g)),
                (false, true) => from = from.max(f / (f - g)),
            }
        }
        (to > from).then_some((from, to))
    }
}

impl<const D: usize> Observer<D> {
    /// One that sees all around, without limits: the ideal observation, μ ≡ Pr M.
    #[must_use]
    pub fn ideal() -> Self {
        let axis = SVector::from_fn(|k, _| if k == 0 { 1.0 } else { 0.0 });
        Self {
            axis,
            half_field: std::f64::consts::PI,
            range: (0.0, f64::INFINITY),
            resolution: 0.0,
        }
    }

    /// O: what the sensor delivers of images in its own frame, and what it loses.
    #[must_use]
    pub fn observe(&self, images: &[Image<D>]) -> Observation<D> {
        let mut observation = Observation { images: Vec::new(), lost: Vec::new() };
        for image in images {
            let cuts = self.crossings(&image.segment);
            let middle = |k: usize| image.segment.at(0.5 * (cuts[k] + cuts[k + 1]));
            let state = |k: usize| self.loses(&middle(k));
            let mut k = 0;
            while k + 1 < cuts.len() {
                let first = k;
                let here = state(k);
                while k + 1 < cuts.len() && state(k) == here {
                    k += 1;
                }
                let cut = |at: usize| {
                    let beyond = if at == first {
                        at.checked_sub(1).map(state)
                    } else {
                        (at + 1 < cuts.len()).then(|| state(at))
                    };
                    match beyond.flatten() {
                        Some(Loss::Range) => Cut::Range,
                        _ => Cut::Field,
                    }
                };
                let piece = image.segment.pieced(cuts[first], cuts[k], cut(first), cut(k));
                match here {
                    Some(loss) => observation.lost.push((image.source, loss)),
                    None if self.spans(&piece) < self.resolution => {
                        observation.lost.push((image.source, Loss::Resolution));
                    }
                    None => observation.images.push(Image { source: image.source, segment: piece }),
                }
            }
        }
        observation
    }

    /// The angle under which a segment appears, in rad.
    #[must_use]
    pub fn spans(&self, segment: &Segment<D>) -> f64 {
        let (a, b) = (segment.start, segment.end);
        let dot = a.dot(&b);
        let cross = (a.norm_squared() * b.norm_squared() - dot * dot).max(0.0).sqrt();
        cross.atan2(dot)
    }

    fn loses(&self, point: &SVector<f64, D>) -> Option<Loss> {
        let distance = point.norm();
        if self.half_field < std::f64::consts::PI
            && point.dot(&self.axis) < distance * self.half_field.cos()
        {
            Some(Loss::Field)
        } else if distance < self.range.0 || distance > self.range.1 {
            Some(Loss::Range)
        } else {
            None
        }
    }

    /// Where a segment crosses the borders of the field and of the range: 0, the crossings ascending, 1.
    fn crossings(&self, segment: &Segment<D>) -> Vec<f64> {
        let (p, v) = (segment.start, segment.vector());
        let (pp, pv, vv) = (p.norm_squared(), p.dot(&v), v.norm_squared());
        let mut at = vec![0.0];
        for limit in [self.range.0, self.range.1] {
            if limit.is_finite() {
                at.extend(roots(vv, 2.0 * pv, pp - limit * limit));
            }
        }
        if self.half_field < std::f64::consts::PI {
            let c = self.half_field.cos().powi(2);
            let (pa, va) = (p.dot(&self.axis), v.dot(&self.axis));
            at.extend(roots(va * va - c * vv, 2.0 * (pa * va - c * pv), pa * pa - c * pp));
        }
        at.retain(|t| *t >= 0.0 && *t < 1.0);
        at.sort_by(f64::total_cmp);
        at.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
        at.push(1.0);
        at
    }
}

/// Real roots of a t² + b t + c.
fn roots(a: f64, b: f64, c: f64) -> Vec<f64> {
    if a.abs() <= 1e-12 * b.abs().max(c.abs()) {
        return if b == 0.0 { Vec::new() } else { vec![-c / b] };
    }
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return Vec::new();
    }
    // Without cancellation: the greater root by addition, the other by their product.
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    if q == 0.0 { vec![0.0] } else { vec![q / a, c / q] }
}

impl<const D: usize> Segment<D> {
    /// The point at a share of the length.
    #[must_use]
    pub fn at(&self, share: f64) -> SVector<f64, D> {
        self.start + self.vector() * share
    }

    /// The part between two shares of the length; ends that arise are cut for the reason given.
    #[must_use]
    pub fn piece(&self, from: f64, to: f64, cut: Cut) -> Self {
        self.pieced(from, to, cut, cut)
    }

    fn pieced(&self, from: f64, to: f64, first: Cut, last: Cut) -> Self {
        let c = &self.covariance;
        let between = |p: f64, q: f64| {
            c.start * ((1.0 - p) * (1.0 - q))
                + c.end * (p * q)
                + c.cross * ((1.0 - p) * q)
                + c.cross.transpose() * (p * (1.0 - q))
        };
        let covariance = crate::Covariance {
            start: between(from, from),
            end: between(to, to),
            cross: between(from, to),
        };
        let start_end = if from > 0.0 { End::Cut(first) } else { self.ends[0] };
        let end_end = if to < 1.0 { End::Cut(last) } else { self.ends[1] };
        Self { start: self.at(from), end: self.at(to), ends: [start_end, end_end], covariance }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation2, Vector3};
    use proptest::prelude::*;

    use super::*;
    use crate::{Model, Motion};

    fn lengths(images: &[Image<2>], count: usize) -> Vec<f64> {
        let mut sums = vec![0.0; count];
        for image in images {
            sums[image.source] += image.segment.length();
        }
        sums
    }

    fn segments() -> impl Strategy<Value = Vec<Segment<2>>> {
        prop::collection::vec((-300.0..300.0, -300.0..300.0, 10.0..200.0, -3.1..3.1), 1..20)
            .prop_map(|ends| {
                ends.into_iter()
                    .map(|(x, y, l, a): (f64, f64, f64, f64)| {
                        let start = Vector2::new(x, y);
                        Segment::given(start, start + Vector2::new(a.cos(), a.sin()) * l, 1.0)
                    })
                    .collect()
            })
    }

    proptest! {
        /// Pr Pr = Pr, and what is seen is what a ray meets first.
        #[test]
        fn projecting_twice_is_projecting_once(segments in segments(), x in -300.0..300.0, y in -300.0..300.0) {
            let eye: Vector2<f64> = Vector2::new(x, y);
            prop_assume!(segments.iter().all(|s| s.vector().perp(&(eye - s.start)).abs() / s.length() > 1.0));
            let model = Model::of_contour(segments);
            let once = model.projected(&eye);
            let twice = project(&once, &eye);
            for (a, b) in lengths(&once, model.len()).into_iter().zip(lengths(&twice, model.len())) {
                prop_assert!((a - b).abs() < 1e-4, "{a} {b}");
            }
            for k in 0..720 {
                let angle = f64::from(k) * 0.00872 + 0.0001;
                let ray = Vector2::new(angle.cos(), angle.sin());
                let hit = |s: &Segment<2>| {
                    let across = ray.perp(&s.vector());
                    let t = (s.start - eye).perp(&ray) / across;
                    let r = (s.start - eye).perp(&s.vector()) / across;
                    (t > 1e-6 && t < 1.0 - 1e-6 && r > 0.0).then_some(r)
                };
                let first = |all: &mut dyn Iterator<Item = Segment<2>>| {
                    all.filter_map(|s| hit(&s)).fold(f64::INFINITY, f64::min)
                };
                let truth = first(&mut model.segments().iter().copied());
                let seen = first(&mut once.iter().map(|i| i.segment));
                prop_assert!((truth - seen).abs() < 1e-3 || (truth.is_infinite() && seen.is_infinite())
                    || once.iter().any(|i| (i.segment.start - eye).normalize().perp(&ray).abs() < 1e-3
                        || (i.segment.end - eye).normalize().perp(&ray).abs() < 1e-3), "{truth} {seen}");
            }
        }

        /// Scaling does not act on Pr: the same parts are seen of a thing α times as large and as far.
        #[test]
        fn scaling_does_not_act_on_projection(segments in segments(), scale in 0.2..5.0) {
            let eye = Vector2::zeros();
            prop_assume!(segments.iter().all(|s| s.vector().perp(&(eye - s.start)).abs() / s.length() > 1.0));
            let model = Model::of_contour(segments);
            let scaled = model.moved(&Motion::<2>::from_scaling(scale));
            let before = lengths(&model.projected(&eye), model.len());
            let after = lengths(&scaled.projected(&eye), model.len());
            for (a, b) in before.into_iter().zip(after) {
                prop_assert!((a * scale - b).abs() < 1e-4 * scale.max(1.0));
            }
        }

        /// Turning does not act on O of a sensor that sees all around.
        #[test]
        fn turning_does_not_act_on_a_round_sensor(segments in segments(), angle in -3.1..3.1) {
            let model = Model::of_contour(segments);
            let sensor = Observer { range: (20.0, 250.0), resolution: 0.05, ..Observer::ideal() };
            let turned = model.moved(&Motion::<2>::from_parts(Vector2::zeros().into(), Rotation2::new(angle), 1.0));
            let before = sensor.observe(&model.whole_images());
            let after = sensor.observe(&turned.whole_images());
            for (a, b) in lengths(&before.images, model.len()).into_iter().zip(lengths(&after.images, model.len())) {
                prop_assert!((a - b).abs() < 1e-6);
            }
            prop_assert_eq!(before.lost, after.lost);
        }
    }

    #[test]
    fn what_is_lost_is_told() {
        let at = |a: [f64; 3], b: [f64; 3]| Segment::given(Vector3::from(a), Vector3::from(b), 1.0);
        let model = Model::of_contour(vec![
            at([100.0, -300.0, 0.0], [100.0, 300.0, 0.0]),
            at([900.0, 0.0, 0.0], [900.0, 1.0, 0.0]),
            at([-100.0, 0.0, 0.0], [-100.0, 0.0, 50.0]),
            at([200.0, 0.0, 0.0], [2000.0, 0.0, 10.0]),
        ]);
        let sensor = Observer {
            half_field: std::f64::consts::FRAC_PI_4,
            range: (10.0, 1000.0),
            resolution: 0.002,
            ..Observer::ideal()
        };
        let seen = sensor.observe(&model.whole_images());
        let wall =
            seen.images.iter().find(|i| i.source == 0).expect("its middle is in view").segment;
        assert!((wall.length() - 200.0).abs() < 1e-9);
        assert_eq!(wall.ends, [End::Cut(Cut::Field); 2]);
        assert!(seen.lost.contains(&(0, Loss::Field)));
        assert!(seen.lost.contains(&(1, Loss::Resolution)));
        assert!(seen.lost.contains(&(2, Loss::Field)));
        let far =
            seen.images.iter().find(|i| i.source == 3).expect("its near end is in range").segment;
        assert_eq!(far.ends[1], End::Cut(Cut::Range));
        assert!(far.ends[0].is_true() && (far.end.norm() - 1000.0).abs() < 1e-6);
        // From nearer its image is greater, and the small one is told apart: scaling acts on O.
        let near = model.moved(&Motion::<3>::from_parts(
            Vector3::new(-500.0, 0.0, 0.0).into(),
            nalgebra::Rotation3::identity(),
            1.0,
        ));
        assert!(sensor.observe(&near.whole_images()).images.iter().any(|i| i.source == 1));
    }
}
