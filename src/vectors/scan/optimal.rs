//! The polylines over returns that miss the beams least, with a price on each vertex (dynamic programming; the measure is
//! that of Schaefer et al. 2018, IROS: «A maximum likelihood approach to extract polylines from 2-D laser range scans»).
//!
//! A sensor errs along its beams: an edge costs the sum over the beams between its ends of the squared difference between
//! the range measured, r, and the range f at which the beam meets it, in deviations; a beam that no edge explains costs as
//! much as one missed by [`LOST`]. The range of a line is 1/f = α cos θ + β sin θ, so that r²(1/f − 1/r), which is r − f to
//! first order, is linear in α and β: what an edge costs is a quadratic form over sums that are kept from hit to hit.
//!
//! ```text
//!  open   B(j+1) = min( B(j) + lost(j),  A(j) )              hits before j + 1 are explained, no polyline goes on
//!  vertex A(j)   = λ + min over i of min( B(i) + λ, A(i) ) + edge(i, j)         a polyline has come to hit j
//! ```

use super::run::Hit;
use super::sensor::Sensor;

/// How far a beam may be missed, in cm, before it is as good as unexplained: the published choice.
pub(super) const LOST: f64 = 50.0;
/// A vertex that saves no more than so many deviations, squared, is noise.
const NOISE: f64 = 4.0;
/// Hits that one edge passes over at most.
const LONGEST: usize = 256;
/// Prices tried for a vertex.
const PRICES: usize = 12;

/// Sums over the hits before each: r⁴c², r⁴cs, r⁴s², r³c, r³s, r², weighted by the noise.
type Sums = [f64; 6];

/// Hits of which each is joined to the next or not, and what their edges cost.
pub(super) struct Hops<'a> {
    hits: &'a [Hit],
    /// For each hit the first one that an edge may come from.
    low: Vec<usize>,
    /// For each hit where the costs of edges that come to it begin in `costs`.
    rows: Vec<usize>,
    costs: Vec<f32>,
    sums: Vec<Sums>,
    lost: Vec<f64>,
}

impl<'a> Hops<'a> {
    /// `chains` are the runs of hits `from..to` whose neighbours are joined.
    pub(super) fn of(hits: &'a [Hit], sensor: &Sensor, chains: Vec<(usize, usize)>) -> Self {
        let weight = |hit: &Hit| 1.0 / sensor.noise.along(hit.r);
        let lost: Vec<f64> = hits.iter().map(|hit| LOST * LOST * weight(hit)).collect();
        let mut sums: Vec<Sums> = vec![[0.0; 6]];
        for (at, hit) in hits.iter().enumerate() {
            let (u, r) = (sensor.directions[hit.beam as usize], hit.r);
            let (x, y, w) = (u.x * r * r, u.y * r * r, weight(hit));
            let own = [x * x, x * y, y * y, x * r, y * r, r * r];
            sums.push(std::array::from_fn(|k| w * own[k] + sums[at][k]));
        }
        let low = (0..hits.len()).collect();
        let mut all = Self { hits, low, rows: vec![0; hits.len()], costs: Vec::new(), sums, lost };
        for (from, to) in chains {
            for at in from..to {
                all.low[at] = from.max(at.saturating_sub(LONGEST));
                all.rows[at] = all.costs.len();
                for start in all.low[at]..at {
                    all.costs.push(all.cost(start, at) as f32);
                }
            }
        }
        all
    }

    /// The polylines of at most `most` vertices that cost least, or nearly: each the hits that are its vertices.
    pub(super) fn best(&self, most: usize) -> Vec<Vec<usize>> {
        let mut best = self.at_price(NOISE * NOISE);
        // Fewer vertices the dearer they are; many have one price, so that no price may leave just as many.
        let (mut low, mut high) =
            ((NOISE * NOISE).ln(), self.lost.iter().sum::<f64>().max(NOISE * NOISE).ln());
        for _ in 0..PRICES {
            if count(&best) <= most {
                break;
            }
            let middle = 0.5 * (low + high);
            let found = self.at_price(middle.exp());
            if count(&found) >= most {
                (low, best) = (middle, found);
            } else {
                high = middle;
            }
        }
        while count(&best) > most {
            self.drop_one(&mut best);
        }
        best
    }

    /// Takes away the vertex that is missed least, or the line of two that is.
    fn drop_one(&self, lines: &mut Vec<Vec<usize>>) {
        let lost = |from: usize, to: usize| self.lost[from..to].iter().sum::<f64>();
        let price = |line: &[usize], k: usize| match line {
            [a, b] => 0.5 * (lost(*a, b + 1) - self.cost(*a, *b)),
            [a, b, ..] if k == 0 => lost(*a, *b) - self.cost(*a, *b),
            [.., a, b] if k + 1 == line.len() => lost(a + 1, b + 1) - self.cost(*a, *b),
            _ => {
                let (a, v, b) = (line[k - 1], line[k], line[k + 1]);
                self.cost(a, b) - self.cost(a, v) - self.cost(v, b)
            }
        };
        let all =
            lines.iter().enumerate().flat_map(|(l, line)| (0..line.len()).map(move |k| (l, k)));
        let least =
            all.map(|(l, k)| (price(&lines[l], k), l, k)).min_by(|a, b| a.0.total_cmp(&b.0));
        match least {
            Some((_, l, _)) if lines[l].len() == 2 => drop(lines.remove(l)),
            Some((_, l, k)) => drop(lines[l].remove(k)),
            None => {}
        }
    }

    /// What the edge from one hit to a later one costs.
    fn cost(&self, from: usize, to: usize) -> f64 {
        edge(&self.hits[from], &self.hits[to], &self.sums[from + 1], &self.sums[to])
    }

    fn at_price(&self, price: f64) -> Vec<Vec<usize>> {
        let count = self.hits.len();
        // Of each hit: cost so far with a polyline that has come here, or begins here; and where it came from.
        let mut starts = vec![f64::INFINITY; count];
        let mut ends = vec![f64::INFINITY; count];
        let mut from = vec![usize::MAX; count];
        let mut open = vec![0.0; count + 1];
        for at in 0..count {
            let (low, row) = (self.low[at], self.rows[at]);
            let costs = &self.costs[row..row + at - low];
            let mut least = f64::INFINITY;
            for (k, cost) in costs.iter().enumerate() {
                let sum = starts[low + k] + f64::from(*cost);
                if sum < least {
                    (least, from[at]) = (sum, low + k);
                }
            }
            ends[at] = least + price;
            starts[at] = ends[at].min(open[at] + price);
            open[at + 1] = ends[at].min(open[at] + self.lost[at]);
        }
        let mut lines: Vec<Vec<usize>> = Vec::new();
        let mut at = count;
        while at > 0 {
            if ends[at - 1] > open[at] {
                at -= 1;
                continue;
            }
            let mut line = vec![at - 1];
            let mut vertex = from[at - 1];
            loop {
                line.push(vertex);
                if starts[vertex] < ends[vertex] {
                    break;
                }
                vertex = from[vertex];
            }
            line.reverse();
            at = line[0];
            lines.push(line);
        }
        lines.reverse();
        lines
    }
}

/// Vertices of polylines.
pub(super) fn count(lines: &[Vec<usize>]) -> usize {
    lines.iter().map(Vec::len).sum()
}

/// What an edge costs over the beams between its two hits, whose sums are those before `first` and up to `last`.
fn edge(start: &Hit, end: &Hit, first: &Sums, last: &Sums) -> f64 {
    let (a, b) = (start.p, end.p);
    let area = a.perp(&b);
    if area <= 0.0 {
        return f64::INFINITY;
    }
    let (alpha, beta) = ((b.y - a.y) / area, (a.x - b.x) / area);
    let s: Sums = std::array::from_fn(|k| last[k] - first[k]);
    let square = alpha * alpha * s[0] + 2.0 * alpha * beta * s[1] + beta * beta * s[2];
    (square - 2.0 * (alpha * s[3] + beta * s[4]) + s[5]).max(0.0)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::scan::Noise;

    /// What polylines cost at a price: the obvious way, every beam against its edge.
    fn cost(hops: &Hops<'_>, lines: &[Vec<usize>], price: f64) -> f64 {
        let explained =
            |at: usize| lines.iter().any(|line| line[0] <= at && at <= line[line.len() - 1]);
        let lost: f64 =
            (0..hops.hits.len()).filter(|at| !explained(*at)).map(|at| hops.lost[at]).sum();
        let edges = lines.iter().flat_map(|line| line.windows(2));
        edges.map(|pair| hops.cost(pair[0], pair[1])).sum::<f64>()
            + lost
            + price * count(lines) as f64
    }

    /// All ways to lay polylines over hits: each hit a vertex that goes on, one that ends a line, or none.
    fn all(hops: &Hops<'_>, chains: &[(usize, usize)]) -> Vec<Vec<Vec<usize>>> {
        let count = hops.hits.len();
        let mut found = Vec::new();
        for code in 0..3_usize.pow(count as u32) {
            let digit = |at: usize| code / 3_usize.pow(at as u32) % 3;
            let mut lines: Vec<Vec<usize>> = vec![Vec::new()];
            for at in (0..count).filter(|at| digit(*at) > 0) {
                lines.last_mut().expect("one is begun").push(at);
                if digit(at) == 2 {
                    lines.push(Vec::new());
                }
            }
            let open = lines.pop().expect("one is begun");
            let joined = |line: &Vec<usize>| {
                chains.iter().any(|(from, to)| *from <= line[0] && line[line.len() - 1] < *to)
            };
            if open.is_empty() && lines.iter().all(|line| line.len() > 1 && joined(line)) {
                found.push(lines);
            }
        }
        found
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        #[test]
        fn nothing_costs_less(
            ranges in prop::collection::vec(prop_oneof![150.0..160.0_f64, 100.0..400.0_f64], 2..8),
            torn in 0..8_usize, price in 1.0..4000.0_f64,
        ) {
            let noise = Noise { range: 1.0, share: 0.002, bearing: 0.0 };
            let sensor = Sensor::new(0.0, 0.02, 8, (1.0, 1000.0), noise).expect("a sensor");
            let beams = sensor.directions.iter().zip(&ranges).enumerate();
            let hits: Vec<Hit> = beams
                .map(|(beam, (u, r))| Hit { p: u * *r, r: *r, beam: beam as u32 })
                .collect();
            let torn = torn.min(hits.len());
            let chains = vec![(0, torn), (torn, hits.len())];
            let hops = Hops::of(&hits, &sensor, chains.clone());
            let least = all(&hops, &chains)
                .iter()
                .map(|lines| cost(&hops, lines, price))
                .fold(f64::INFINITY, f64::min);
            let found = cost(&hops, &hops.at_price(price), price);
            prop_assert!((found - least).abs() <= 1e-4 * least.max(1.0), "{found} is not {least}");
            // Within a number of vertices nothing is explained better, but for what one price leaves open.
            for most in 0..=hits.len() {
                let lines = hops.best(most);
                prop_assert!(count(&lines) <= most);
                prop_assert!(lines.iter().all(|line| line.len() > 1 && line.is_sorted()));
            }
        }

        /// The sums tell what an edge costs as the beams themselves do, near the edge.
        #[test]
        fn sums_cost_what_beams_cost(
            start in 50.0..3000.0_f64, end in 50.0..3000.0_f64, noise in prop::collection::vec(-0.03..0.03_f64, 12),
        ) {
            let noise_of = Noise { range: 2.0, share: 0.0, bearing: 0.0 };
            let sensor = Sensor::new(-1.0, 0.03, 12, (1.0, 5000.0), noise_of).expect("a sensor");
            let (a, b) = (sensor.directions[0] * start, sensor.directions[11] * end);
            let area = a.perp(&b);
            let line = |beam: usize| area / sensor.directions[beam].perp(&(b - a));
            let mut obvious = 0.0;
            let hits: Vec<Hit> = (0..12)
                .map(|beam| {
                    let is_end = beam == 0 || beam == 11;
                    let r = line(beam) * if is_end { 1.0 } else { 1.0 + noise[beam] };
                    obvious += ((line(beam) - r) / 2.0).powi(2);
                    Hit { p: sensor.directions[beam] * r, r, beam: beam as u32 }
                })
                .collect();
            let hops = Hops::of(&hits, &sensor, vec![(0, 12)]);
            let found = hops.cost(0, 11);
            prop_assert!((found - obvious).abs() <= 0.08 * obvious + 1e-3, "{found} is not {obvious}");
        }
    }
}
