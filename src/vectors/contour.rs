//! Order along the contour: after each segment the one whose end is nearest (SPEC V5; paper 3, section 4:
//! |p₁ⱼ − p₂ⱼ₋₁| → min).
//!
//! Ends that lie on one another are joined first, so that a chain entered in its middle does not come apart.

use nalgebra::SVector;

use crate::Segment;

/// An end of segment `.0`: its start (0) or end (1).
type Tip = (usize, usize);

/// The segments in order, each with its former place, reversed where the contour runs the other way.
pub(crate) fn order<const D: usize>(segments: &[Segment<D>]) -> Vec<(usize, Segment<D>)> {
    let point = |(k, side): Tip| if side == 0 { segments[k].start } else { segments[k].end };
    let partner = joints(segments, &point);
    let mut used = vec![false; segments.len()];
    let mut chains: Vec<Vec<Tip>> = Vec::new();
    // Open chains begin where no partner is; what is left over are rings.
    let open = (0..segments.len())
        .flat_map(|k| [(k, 0), (k, 1)])
        .filter(|&(k, s)| partner[k][s].is_none());
    for first in open.chain((0..segments.len()).map(|k| (k, 0))) {
        let mut chain = Vec::new();
        let mut tip = first;
        while !std::mem::replace(&mut used[tip.0], true) {
            chain.push(tip);
            match partner[tip.0][1 - tip.1] {
                Some(next) => tip = next,
                None => break,
            }
        }
        if !chain.is_empty() {
            chains.push(chain);
        }
    }
    link(chains, &point)
        .into_iter()
        .map(|(k, side)| (k, if side == 0 { segments[k] } else { segments[k].reversed() }))
        .collect()
}

/// For each end the end that lies on it: true, within the errors of both, nearest to one another.
fn joints<const D: usize>(
    segments: &[Segment<D>],
    point: &impl Fn(Tip) -> SVector<f64, D>,
) -> Vec<[Option<Tip>; 2]> {
    let mut tips: Vec<Tip> = (0..segments.len())
        .flat_map(|k| [(k, 0), (k, 1)])
        .filter(|&(k, side)| segments[k].ends[side].is_true())
        .collect();
    tips.sort_by(|&a, &b| point(a)[0].total_cmp(&point(b)[0]));
    let slack = |(k, side): Tip| {
        let c = &segments[k].covariance;
        14.0 / D as f64 * if side == 0 { c.start.trace() } else { c.end.trace() }
    };
    let widest = tips.iter().map(|&t| slack(t)).fold(0.0, f64::max);
    let mut meets = Vec::new();
    for (i, &a) in tips.iter().enumerate() {
        for &b in &tips[i + 1..] {
            if (point(b)[0] - point(a)[0]).powi(2) > 2.0 * widest + 1e-6 {
                break;
            }
            let gap = (point(a) - point(b)).norm_squared();
            if a.0 != b.0 && gap <= slack(a) + slack(b) + 1e-6 {
                meets.push((gap, a, b));
            }
        }
    }
    meets.sort_by(|p, q| p.0.total_cmp(&q.0));
    let mut partner = vec![[None; 2]; segments.len()];
    for (_, a, b) in meets {
        if partner[a.0][a.1].is_none() && partner[b.0][b.1].is_none() {
            partner[a.0][a.1] = Some(b);
            partner[b.0][b.1] = Some(a);
        }
    }
    partner
}

/// Chains one after another, each entered at the end nearest to where the last one ended.
fn link<const D: usize>(
    chains: Vec<Vec<Tip>>,
    point: &impl Fn(Tip) -> SVector<f64, D>,
) -> Vec<Tip> {
    let mut rest = chains;
    let mut ordered: Vec<Tip> = Vec::new();
    while !rest.is_empty() {
        let (k, turned) = ordered.last().map_or((0, false), |&(k, side)| {
            let here = point((k, 1 - side));
            let gap = |tip: Tip| (point(tip) - here).norm_squared();
            let nearest = rest.iter().enumerate().flat_map(|(k, chain)| {
                let (first, last) = (chain[0], chain[chain.len() - 1]);
                [(gap(first), k, false), (gap((last.0, 1 - last.1)), k, true)]
            });
            let best = nearest.min_by(|p, q| p.0.total_cmp(&q.0)).expect("chains are left");
            (best.1, best.2)
        });
        let chain = rest.remove(k);
        if turned {
            ordered.extend(chain.into_iter().rev().map(|(k, side)| (k, 1 - side)));
        } else {
            ordered.extend(chain);
        }
    }
    ordered
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;
    use proptest::prelude::*;

    use crate::{Equality, Model, Segment};

    proptest! {
        /// Segments of a polygon, shuffled and turned about, come out as the polygon.
        #[test]
        fn a_shuffled_contour_is_ordered_again(
            radii in prop::collection::vec(100.0..300.0, 3..25), order in any::<u64>(), flips in any::<u32>(),
        ) {
            let count = radii.len();
            let corners: Vec<Vector2<f64>> = radii.iter().enumerate()
                .map(|(k, r): (usize, &f64)| {
                    let angle = k as f64 / count as f64 * std::f64::consts::TAU;
                    Vector2::new(angle.cos(), angle.sin()) * *r
                }).collect();
            let mut segments: Vec<Segment<2>> = (0..count).map(|k| {
                let s = Segment::given(corners[k], corners[(k + 1) % count], 0.1);
                if flips >> (k % 32) & 1 == 1 { s.reversed() } else { s }
            }).collect();
            fastrand::Rng::with_seed(order).shuffle(&mut segments);
            let model = Model::of_set(&segments);
            prop_assert_eq!(model.len(), count);
            for k in 0..count {
                prop_assert!(model.is_joined(k));
            }
            prop_assert_eq!(model.pairs().len(), count);
            prop_assert!(model.equals(&Model::of_contour(segments), &Equality::at(0.99)));
        }
    }

    #[test]
    fn loose_segments_follow_the_nearest_end() {
        let at = |a: f64, b: f64| Segment::given(Vector2::new(a, 0.0), Vector2::new(b, 0.0), 0.1);
        let model = Model::of_set(&[at(0.0, 10.0), at(50.0, 60.0), at(30.0, 20.0)]);
        let starts: Vec<f64> = model.segments().iter().map(|s| s.start.x).collect();
        assert_eq!(starts, [0.0, 20.0, 50.0]);
        assert_eq!((model.pairs().len(), model.triples().len()), (2, 1));
    }
}
