//! Curves and profiles → corners. Arcs, ellipses and splines become chords of at most 15°.

use nalgebra::{Point3, Vector3};

use super::body::{Line, Rings};
use super::place::{Place, coordinates, point};
use super::shape::Shapes;
use super::step::{Instance, Value};

/// Curves in curves: deeper is a ring.
pub(super) const DEEPEST: usize = 12;
/// Chords of a whole turn.
const CHORDS: f64 = 24.0;
/// Splines of a higher degree are their control points.
const STEEPEST: usize = 10;

impl Shapes<'_> {
    /// Corners of a curve, in its own space.
    pub(super) fn curve(&mut self, curve: &Instance, depth: usize) -> Line {
        let all = self.all;
        if depth > DEEPEST || self.is_exhausted() {
            return Vec::new();
        }
        let points = match curve.kind {
            "IFCPOLYLINE" => curve.at(0).list().iter().filter_map(|p| point(all, p)).collect(),
            "IFCINDEXEDPOLYCURVE" => self.indexed(curve),
            "IFCCOMPOSITECURVE" | "IFC2DCOMPOSITECURVE" | "IFCCOMPOSITECURVEONSURFACE" => {
                self.composite(curve, depth)
            }
            "IFCTRIMMEDCURVE" => self.trimmed(curve, depth),
            "IFCCIRCLE" | "IFCELLIPSE" => {
                let turn = std::f64::consts::TAU;
                self.conic(curve).map_or_else(Vec::new, |conic| conic.arc(0.0, turn, false))
            }
            kind if kind.contains("BSPLINECURVE") || kind == "IFCBEZIERCURVE" => self.spline(curve),
            "IFCPCURVE" | "IFCSURFACECURVE" | "IFCSEAMCURVE" | "IFCOFFSETCURVE2D"
            | "IFCOFFSETCURVE3D" => {
                let of = all.get(curve.at(0).reference().unwrap_or(0));
                of.map_or_else(Vec::new, |of| self.curve(of, depth + 1))
            }
            _ => Vec::new(),
        };
        self.charge(points.len() + 1);
        points
    }

    /// Lines and arcs over a list of points; without segments all of it in order.
    fn indexed(&mut self, curve: &Instance) -> Line {
        let all = self.all;
        let list = curve.at(0).reference().and_then(|id| all.get(id));
        let list: Vec<_> =
            list.iter().flat_map(|l| l.at(0).list()).filter_map(coordinates).collect();
        self.charge(list.len());
        if curve.at(1).list().is_empty() {
            return list;
        }
        let corner = |v: &Value| list.get((v.number()? as usize).checked_sub(1)?).copied();
        let mut line = Vec::new();
        for segment in curve.at(1).list() {
            let parts = segment.list();
            // Only arcs keep the name of their type.
            let is_arc = parts.first().and_then(Value::word).is_some();
            let parts = if is_arc { parts.get(1).map_or(&[][..], Value::list) } else { parts };
            let corners: Line = parts.iter().filter_map(corner).collect();
            match corners[..] {
                [a, b, c] if is_arc => line.extend(arc_through(a, b, c)),
                _ => line.extend(corners),
            }
        }
        line
    }

    fn composite(&mut self, curve: &Instance, depth: usize) -> Line {
        let all = self.all;
        let mut whole = Vec::new();
        for segment in curve.at(0).list().iter().filter_map(|s| all.get(s.reference()?)) {
            let Some(parent) = segment.at(2).reference().and_then(|id| all.get(id)) else {
                continue;
            };
            let mut part = self.curve(parent, depth + 1);
            if segment.at(1).word() == Some("F") {
                part.reverse();
            }
            whole.append(&mut part);
        }
        whole
    }

    fn trimmed(&mut self, curve: &Instance, depth: usize) -> Line {
        let all = self.all;
        let Some(basis) = curve.at(0).reference().and_then(|id| all.get(id)) else {
            return Vec::new();
        };
        let told = |at: usize| {
            let ends = curve.at(at).list();
            (ends.iter().find_map(|p| point(all, p)), ends.iter().find_map(Value::number))
        };
        let (from, to) = (told(1), told(2));
        let is_reversed = curve.at(3).word() == Some("F");
        match basis.kind {
            "IFCLINE" => {
                let start = point(all, basis.at(0));
                let along = basis.at(1).reference().and_then(|id| all.get(id)).and_then(|v| {
                    let direction = super::place::direction(all, v.at(0))?.try_normalize(1e-12)?;
                    Some(direction * v.at(1).number()?)
                });
                let end = |(at, by): (Option<Point3<f64>>, Option<f64>)| {
                    at.or_else(|| Some(start? + along? * by?))
                };
                [end(from), end(to)].into_iter().flatten().collect()
            }
            "IFCCIRCLE" | "IFCELLIPSE" => {
                let Some(conic) = self.conic(basis) else { return Vec::new() };
                let unit = self.angle_unit;
                let angle = |(at, by): (Option<Point3<f64>>, Option<f64>)| {
                    at.map(|p| conic.angle(p)).or_else(|| Some(by? * unit))
                };
                match (angle(from), angle(to)) {
                    (Some(a), Some(b)) => conic.arc(a, b, is_reversed),
                    _ => Vec::new(),
                }
            }
            _ => {
                let mut line = self.curve(basis, depth + 1);
                // A piece of a spline or polyline: between its told ends, where there are such.
                if let (Some(a), Some(b)) = (from.0, to.0) {
                    let nearest = |p: Point3<f64>| {
                        let away = |i: &usize| (line[*i] - p).norm_squared();
                        (0..line.len()).min_by(|i, j| away(i).total_cmp(&away(j)))
                    };
                    if let (Some(i), Some(j)) = (nearest(a), nearest(b))
                        && i != j
                    {
                        let (low, high) = (i.min(j), i.max(j));
                        line = line[low..=high].to_vec();
                        if i > j {
                            line.reverse();
                        }
                    }
                }
                line
            }
        }
    }

    fn conic(&self, curve: &Instance) -> Option<Conic> {
        let place = Place::of_axis(self.all, curve.at(0));
        let x = curve.at(1).number()?;
        let y = if curve.kind == "IFCELLIPSE" { curve.at(2).number()? } else { x };
        (x > 0.0 && y > 0.0 && x < 1e9 && y < 1e9).then_some(Conic { place, x, y })
    }

    /// IfcBSplineCurve: with knots by de Boor's algorithm, else its control points.
    fn spline(&mut self, curve: &Instance) -> Line {
        let all = self.all;
        let control: Line = curve.at(1).list().iter().filter_map(|p| point(all, p)).collect();
        let degree = curve.at(0).number().unwrap_or(0.0) as usize;
        let numbers = |at: usize| curve.at(at).list().iter().filter_map(Value::number);
        let most = control.len() + degree + 1;
        let knots: Vec<f64> = numbers(6)
            .zip(numbers(5))
            .flat_map(|(knot, times)| std::iter::repeat_n(knot, (times as usize).min(most)))
            .take(most)
            .collect();
        let weights: Vec<f64> = numbers(8).collect();
        let is_sound = (1..=STEEPEST).contains(&degree)
            && knots.len() == most
            && control.len() > degree
            && knots.windows(2).all(|w| w[0] <= w[1]);
        if !is_sound {
            return control;
        }
        let weight = |i: usize| weights.get(i).copied().filter(|w| *w > 1e-9).unwrap_or(1.0);
        let mut line = Vec::new();
        for span in degree..control.len() {
            let (low, high) = (knots[span], knots[span + 1]);
            if high <= low {
                continue;
            }
            let steps = if degree == 1 { 1 } else { 4 };
            let first = usize::from(!line.is_empty());
            for step in first..=steps {
                let t = low + (high - low) * (step as f64 / steps as f64);
                let mut d: Vec<(Vector3<f64>, f64)> = (span - degree..=span)
                    .map(|i| (control[i].coords * weight(i), weight(i)))
                    .collect();
                for r in 1..=degree {
                    for j in (r..=degree).rev() {
                        let i = span - degree + j;
                        let wide = knots[i + degree + 1 - r] - knots[i];
                        let a = if wide > 0.0 { (t - knots[i]) / wide } else { 0.0 };
                        d[j] = (
                            d[j - 1].0 * (1.0 - a) + d[j].0 * a,
                            d[j - 1].1 * (1.0 - a) + d[j].1 * a,
                        );
                    }
                }
                let (at, by) = d[degree];
                line.push(Point3::from(at / by));
            }
        }
        line
    }

    /// Outlines of a profile, in its own plane; several where it is composed.
    pub(super) fn profile(&mut self, profile: &Instance, depth: usize) -> Vec<Rings> {
        let all = self.all;
        if depth > DEEPEST || self.is_exhausted() {
            return Vec::new();
        }
        self.charge(1);
        let of = |v: &Value| all.get(v.reference()?);
        match profile.kind {
            "IFCARBITRARYCLOSEDPROFILEDEF" | "IFCARBITRARYPROFILEDEFWITHVOIDS" => {
                let Some(outer) = of(profile.at(2)) else { return Vec::new() };
                let mut rings = vec![self.curve(outer, 0)];
                for hole in profile.at(3).list().iter().filter_map(of) {
                    rings.push(self.curve(hole, 0));
                }
                vec![rings]
            }
            "IFCCENTERLINEPROFILEDEF" => {
                let Some(middle) = of(profile.at(2)) else { return Vec::new() };
                let line = self.curve(middle, 0);
                let half = profile.at(3).number().unwrap_or(0.0) / 2.0;
                vec![vec![widened(&line, half)]]
            }
            "IFCDERIVEDPROFILEDEF" | "IFCMIRROREDPROFILEDEF" => {
                let Some(parent) = of(profile.at(2)) else { return Vec::new() };
                let place = of(profile.at(3)).map(|o| Place::of_operator(all, o));
                let mirrored = Place { x: -Vector3::x(), ..Place::default() };
                let is_mirror = profile.kind == "IFCMIRROREDPROFILEDEF";
                let place = if is_mirror { mirrored } else { place.unwrap_or_else(Place::default) };
                let mut found = self.profile(parent, depth + 1);
                for p in found.iter_mut().flatten().flatten() {
                    *p = place.apply(*p);
                }
                found
            }
            "IFCCOMPOSITEPROFILEDEF" => {
                let mut found = Vec::new();
                for part in profile.at(2).list().iter().filter_map(of) {
                    found.append(&mut self.profile(part, depth + 1));
                }
                found
            }
            _ => {
                let place = Place::of_axis(all, profile.at(2));
                let rings = parametric(profile).unwrap_or_default();
                let lift = |ring: Vec<(f64, f64)>| -> Line {
                    ring.into_iter().map(|(x, y)| place.apply(Point3::new(x, y, 0.0))).collect()
                };
                let rings: Rings = rings.into_iter().map(lift).collect();
                if rings.is_empty() { Vec::new() } else { vec![rings] }
            }
        }
    }
}

/// A circle or an ellipse.
struct Conic {
    place: Place,
    x: f64,
    y: f64,
}

impl Conic {
    fn at(&self, angle: f64) -> Point3<f64> {
        let (sin, cos) = angle.sin_cos();
        self.place.apply(Point3::new(self.x * cos, self.y * sin, 0.0))
    }

    fn angle(&self, p: Point3<f64>) -> f64 {
        let v = p - self.place.origin;
        (v.dot(&self.place.y) / self.y).atan2(v.dot(&self.place.x) / self.x)
    }

    /// From one angle to another, counter-clockwise or clockwise; equal ones are a whole turn.
    fn arc(&self, from: f64, to: f64, clockwise: bool) -> Line {
        let turn = std::f64::consts::TAU;
        let ahead = if clockwise { from - to } else { to - from };
        let mut by = ahead.rem_euclid(turn);
        if by < 1e-9 {
            by = turn;
        }
        let steps = (by / turn * CHORDS).ceil().max(1.0) as usize;
        let sign = if clockwise { -1.0 } else { 1.0 };
        (0..=steps).map(|k| self.at(from + sign * by * k as f64 / steps as f64)).collect()
    }
}

/// The arc from `a` over `b` to `c`; the corners themselves when they lie in one line.
fn arc_through(a: Point3<f64>, b: Point3<f64>, c: Point3<f64>) -> Line {
    let (u, v) = (b - a, c - a);
    let normal = u.cross(&v);
    let flat = normal.norm_squared();
    if flat <= 1e-12 * u.norm_squared() * v.norm_squared() {
        return vec![a, b, c];
    }
    let middle = a
        + (normal.cross(&u) * v.norm_squared() + v.cross(&normal) * u.norm_squared())
            / (2.0 * flat);
    let radius = (a - middle).norm();
    let (Some(x), Some(z)) = ((a - middle).try_normalize(1e-12), normal.try_normalize(1e-12))
    else {
        return vec![a, b, c];
    };
    let place = Place { origin: middle, x, y: z.cross(&x), z };
    let conic = Conic { place, x: radius, y: radius };
    conic.arc(0.0, conic.angle(c), false)
}

/// A line with so much on both sides of it, on the plan of its own space.
fn widened(line: &[Point3<f64>], half: f64) -> Line {
    let offset = |i: usize, side: f64| {
        let (before, after) = (line[i.saturating_sub(1)], line[(i + 1).min(line.len() - 1)]);
        let along = (after - before).try_normalize(1e-12).unwrap_or_else(Vector3::x);
        line[i] + Vector3::new(-along.y, along.x, 0.0) * (half * side)
    };
    let left = (0..line.len()).map(|i| offset(i, 1.0));
    left.chain((0..line.len()).rev().map(|i| offset(i, -1.0))).collect()
}

/// The rings of a profile that is told by measures, about the middle of its box.
fn parametric(profile: &Instance) -> Option<Vec<Vec<(f64, f64)>>> {
    let n = |at: usize| profile.at(at).number().filter(|n| n.abs() < 1e9);
    let rect = |x: f64, y: f64| vec![(-x, -y), (x, -y), (x, y), (-x, y)];
    let oval = |x: f64, y: f64| {
        let corner = |k: u32| {
            let (sin, cos) = (f64::from(k) / CHORDS * std::f64::consts::TAU).sin_cos();
            (x * cos, y * sin)
        };
        (0..CHORDS as u32).map(corner).collect::<Vec<_>>()
    };
    let rings = match profile.kind {
        "IFCRECTANGLEPROFILEDEF" | "IFCROUNDEDRECTANGLEPROFILEDEF" => {
            vec![rect(n(3)? / 2.0, n(4)? / 2.0)]
        }
        "IFCRECTANGLEHOLLOWPROFILEDEF" => {
            let (x, y, t) = (n(3)? / 2.0, n(4)? / 2.0, n(5)?);
            vec![rect(x, y), rect((x - t).max(0.0), (y - t).max(0.0))]
        }
        "IFCCIRCLEPROFILEDEF" => vec![oval(n(3)?, n(3)?)],
        "IFCCIRCLEHOLLOWPROFILEDEF" => {
            let inner = (n(3)? - n(4)?).max(0.0);
            vec![oval(n(3)?, n(3)?), oval(inner, inner)]
        }
        "IFCELLIPSEPROFILEDEF" => vec![oval(n(3)?, n(4)?)],
        "IFCTRAPEZIUMPROFILEDEF" => {
            let (bottom, top, y, offset) = (n(3)?, n(4)?, n(5)? / 2.0, n(6)?);
            let x = bottom / 2.0;
            vec![vec![(-x, -y), (x, -y), (-x + offset + top, y), (-x + offset, y)]]
        }
        "IFCISHAPEPROFILEDEF" => {
            let (x, y, w, f) = (n(3)? / 2.0, n(4)? / 2.0, n(5)? / 2.0, n(6)?);
            let (low, high) = (-y + f, y - f);
            vec![vec![
                (-x, -y),
                (x, -y),
                (x, low),
                (w, low),
                (w, high),
                (x, high),
                (x, y),
                (-x, y),
                (-x, high),
                (-w, high),
                (-w, low),
                (-x, low),
            ]]
        }
        "IFCLSHAPEPROFILEDEF" => {
            let (y, x, t) = (n(3)? / 2.0, n(4).or(n(3))? / 2.0, n(5)?);
            vec![vec![(-x, -y), (x, -y), (x, -y + t), (-x + t, -y + t), (-x + t, y), (-x, y)]]
        }
        "IFCTSHAPEPROFILEDEF" => {
            let (y, x, w, f) = (n(3)? / 2.0, n(4)? / 2.0, n(5)? / 2.0, n(6)?);
            let under = y - f;
            vec![vec![
                (-w, -y),
                (w, -y),
                (w, under),
                (x, under),
                (x, y),
                (-x, y),
                (-x, under),
                (-w, under),
            ]]
        }
        "IFCUSHAPEPROFILEDEF" => {
            let (y, x, w, f) = (n(3)? / 2.0, n(4)? / 2.0, n(5)?, n(6)?);
            let (inner, low, high) = (-x + w, -y + f, y - f);
            vec![vec![
                (-x, -y),
                (x, -y),
                (x, low),
                (inner, low),
                (inner, high),
                (x, high),
                (x, y),
                (-x, y),
            ]]
        }
        // Their box: what they enclose is no room for anybody.
        "IFCCSHAPEPROFILEDEF" => vec![rect(n(4)? / 2.0, n(3)? / 2.0)],
        "IFCZSHAPEPROFILEDEF" => vec![rect(n(4)? - n(5)? / 2.0, n(3)? / 2.0)],
        "IFCASYMMETRICISHAPEPROFILEDEF" => {
            vec![rect(n(3)?.max(n(7).unwrap_or(0.0)) / 2.0, n(4)? / 2.0)]
        }
        _ => return None,
    };
    Some(rings)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_over_three_points_is_that_of_its_circle() {
        let p = |x: f64, y: f64| Point3::new(x, y, 0.0);
        let arc = arc_through(p(1.0, 0.0), p(0.0, 1.0), p(-1.0, 0.0));
        assert_eq!(arc.len(), 13);
        assert!(arc.iter().all(|q| (q.coords.norm() - 1.0).abs() < 1e-12 && q.y > -1e-12));
        let other = arc_through(p(1.0, 0.0), p(0.0, -1.0), p(-1.0, 0.0));
        assert!(other.iter().all(|q| q.y < 1e-12));
        assert_eq!(arc_through(p(0.0, 0.0), p(1.0, 0.0), p(2.0, 0.0)).len(), 3);
    }
}
