//! Shapes → prisms: an outline on the floor, its lower and upper end.
//!
//! A vertical extrusion is its profile. A body of faces is what its lowest faces leave when they are joined; where
//! they do not make most of it, its convex hull. Boxes, mapped shapes, footprints and the first operand of a clipping
//! are followed. Lengths stay in the file's unit.

use std::collections::HashMap;

use nalgebra::{Point3, Vector3};

use crate::exchange::outline;
use crate::geometry::convex_hull;
use crate::units::Point;

use super::place::{Place, coordinates, point};
use super::step::{Instance, Instances, Value};

const DEEPEST: usize = 12;
/// Shape items and corners looked at in one file: shapes that map shapes that map shapes grow without end.
const MOST_WORK: usize = 20_000_000;

/// A vertical prism in the frame of its Place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Prism {
    pub outline: Vec<Point>,
    pub holes: Vec<Vec<Point>>,
    pub bottom: f64,
    pub top: f64,
}

impl Prism {
    pub(super) fn area(&self) -> f64 {
        outline::area(&self.outline).abs()
    }
}

/// Points of the file's space, in order along a line.
type Line = Vec<Point3<f64>>;

pub(super) struct Shapes<'a> {
    all: &'a Instances,
    work: usize,
}

impl<'a> Shapes<'a> {
    pub(super) fn new(all: &'a Instances) -> Self {
        Self { all, work: 0 }
    }

    /// Whether shapes were left out because there was no end of them.
    pub(super) fn is_exhausted(&self) -> bool {
        self.work > MOST_WORK
    }

    /// The prisms of a product's representation (IfcProductDefinitionShape), seen in the frame `place`.
    ///
    /// Of the body when it has one, else of the footprint, else of the box.
    pub(super) fn of_product(&mut self, representation: &Value, place: &Place) -> Vec<Prism> {
        let all = self.all;
        let Some(shape) = representation.reference().and_then(|id| all.get(id)) else {
            return Vec::new();
        };
        let named: Vec<(&Instance, &str)> = shape
            .at(2)
            .list()
            .iter()
            .filter_map(|v| all.get(v.reference()?))
            .filter(|r| r.kind == "IFCSHAPEREPRESENTATION")
            .map(|r| (r, r.at(1).text().unwrap_or("Body")))
            .collect();
        for wanted in ["body", "facetation", "footprint", "box"] {
            let chosen = named.iter().filter(|(_, name)| name.eq_ignore_ascii_case(wanted));
            let mut prisms = Vec::new();
            for (representation, _) in chosen {
                self.items(representation.at(3), place, 0, &mut prisms);
            }
            if !prisms.is_empty() {
                return prisms;
            }
        }
        Vec::new()
    }

    fn items(&mut self, items: &Value, place: &Place, depth: usize, into: &mut Vec<Prism>) {
        for item in items.list() {
            self.item(item, place, depth, into);
        }
    }

    fn item(&mut self, item: &Value, place: &Place, depth: usize, into: &mut Vec<Prism>) {
        self.work += 1;
        let all = self.all;
        let Some(item) = item.reference().and_then(|id| all.get(id)) else { return };
        if depth > DEEPEST || self.is_exhausted() {
            return;
        }
        let found = match item.kind {
            "IFCEXTRUDEDAREASOLID" => self.extrusion(item, place),
            "IFCBOUNDINGBOX" => bounding_box(all, item, place),
            "IFCFACETEDBREP" | "IFCFACETEDBREPWITHVOIDS" => self.shells(&[item.at(0)], place),
            "IFCSHELLBASEDSURFACEMODEL" | "IFCFACEBASEDSURFACEMODEL" => {
                self.shells(&item.at(0).list().iter().collect::<Vec<_>>(), place)
            }
            "IFCPOLYGONALFACESET" => self.face_set(item, 2, true, place),
            "IFCTRIANGULATEDFACESET" => self.face_set(item, 3, false, place),
            "IFCBOOLEANCLIPPINGRESULT" | "IFCBOOLEANRESULT" => {
                return self.item(item.at(1), place, depth + 1, into);
            }
            "IFCMAPPEDITEM" => return self.mapped(item, place, depth, into),
            "IFCGEOMETRICCURVESET" | "IFCGEOMETRICSET" => {
                return self.items(item.at(0), place, depth + 1, into);
            }
            "IFCPOLYLINE" | "IFCINDEXEDPOLYCURVE" | "IFCCOMPOSITECURVE" => {
                let line = self.curve(item, 0);
                prism_of(
                    &line.iter().map(|p| place.apply(*p)).collect::<Line>(),
                    &[],
                    Vector3::zeros(),
                )
            }
            _ => None,
        };
        into.extend(found);
    }

    fn mapped(&mut self, item: &Instance, place: &Place, depth: usize, into: &mut Vec<Prism>) {
        let all = self.all;
        let map = item.at(0).reference().and_then(|id| all.get(id));
        let Some(map) = map.filter(|m| m.kind == "IFCREPRESENTATIONMAP") else { return };
        let operator = item.at(1).reference().and_then(|id| all.get(id));
        let target = operator.map_or_else(Place::default, |o| Place::of_operator(all, o));
        let place = place.compose(&target).compose(&Place::of_axis(all, map.at(0)));
        let Some(shape) = map.at(1).reference().and_then(|id| all.get(id)) else { return };
        self.items(shape.at(3), &place, depth + 1, into);
    }

    fn extrusion(&mut self, item: &Instance, place: &Place) -> Option<Prism> {
        let all = self.all;
        let place = place.compose(&Place::of_axis(all, item.at(1)));
        let profile = all.get(item.at(0).reference()?)?;
        let (outer, holes) = self.profile(profile)?;
        let direction = all.get(item.at(2).reference()?).and_then(|d| coordinates(d.at(0)));
        let depth = item.at(3).number()?;
        let along = direction.map_or_else(Vector3::z, |d| d.coords).try_normalize(1e-12)?;
        let along = place.turn(along * depth);
        let world = |ring: &[Point3<f64>]| -> Vec<Point3<f64>> {
            ring.iter().map(|p| place.apply(*p)).collect()
        };
        let holes: Vec<Line> = holes.iter().map(|h| world(h)).collect();
        prism_of(&world(&outer), &holes, along)
    }

    /// Outer line and holes of a profile, in its own plane.
    fn profile(&mut self, profile: &Instance) -> Option<(Line, Vec<Line>)> {
        let all = self.all;
        let at = |corners: Vec<(f64, f64)>| {
            let place = Place::of_axis(all, profile.at(2));
            corners.into_iter().map(|(x, y)| place.apply(Point3::new(x, y, 0.0))).collect()
        };
        match profile.kind {
            "IFCARBITRARYCLOSEDPROFILEDEF" | "IFCARBITRARYPROFILEDEFWITHVOIDS" => {
                let outer = self.curve(all.get(profile.at(2).reference()?)?, 0);
                let holes = profile.at(3).list().iter().filter_map(|v| all.get(v.reference()?));
                let holes: Vec<&Instance> = holes.collect();
                Some((outer, holes.into_iter().map(|h| self.curve(h, 0)).collect()))
            }
            "IFCRECTANGLEPROFILEDEF"
            | "IFCRECTANGLEHOLLOWPROFILEDEF"
            | "IFCROUNDEDRECTANGLEPROFILEDEF" => {
                let (x, y) = (profile.at(3).number()? / 2.0, profile.at(4).number()? / 2.0);
                Some((at(vec![(-x, -y), (x, -y), (x, y), (-x, y)]), Vec::new()))
            }
            "IFCCIRCLEPROFILEDEF" | "IFCCIRCLEHOLLOWPROFILEDEF" => {
                let radius = profile.at(3).number()?;
                let corner = |n: u32| {
                    let (sin, cos) = (f64::from(n) * std::f64::consts::TAU / 16.0).sin_cos();
                    (radius * cos, radius * sin)
                };
                Some((at((0..16).map(corner).collect()), Vec::new()))
            }
            _ => None,
        }
    }

    /// Corners of a curve; an arc is its chord through the middle point, where one is given.
    fn curve(&mut self, curve: &Instance, depth: usize) -> Vec<Point3<f64>> {
        let all = self.all;
        if depth > DEEPEST || self.is_exhausted() {
            return Vec::new();
        }
        let points: Vec<Point3<f64>> = match curve.kind {
            "IFCPOLYLINE" => curve.at(0).list().iter().filter_map(|p| point(all, p)).collect(),
            "IFCINDEXEDPOLYCURVE" => {
                let list = curve.at(0).reference().and_then(|id| all.get(id));
                let list: Vec<_> =
                    list.iter().flat_map(|l| l.at(0).list()).filter_map(coordinates).collect();
                let segments = curve.at(1).list();
                if segments.is_empty() {
                    list
                } else {
                    let index = segments.iter().flat_map(Value::list).filter_map(Value::number);
                    index.filter_map(|n| list.get((n as usize).checked_sub(1)?).copied()).collect()
                }
            }
            "IFCCOMPOSITECURVE" => {
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
            "IFCTRIMMEDCURVE" => {
                let end = |v: &Value| v.list().iter().find_map(|p| point(all, p));
                [end(curve.at(1)), end(curve.at(2))].into_iter().flatten().collect()
            }
            _ => Vec::new(),
        };
        self.work += points.len();
        points
    }

    fn shells(&mut self, shells: &[&Value], place: &Place) -> Option<Prism> {
        let all = self.all;
        let mut faces = Vec::new();
        let shells = shells.iter().filter_map(|s| all.get(s.reference()?));
        for face in shells.flat_map(|s| s.at(0).list()).filter_map(|f| all.get(f.reference()?)) {
            for bound in face.at(0).list().iter().filter_map(|b| all.get(b.reference()?)) {
                let Some(ring) = bound.at(0).reference().and_then(|id| all.get(id)) else {
                    continue;
                };
                let ring = ring.at(0).list().iter().filter_map(|p| point(all, p));
                let mut ring: Vec<_> = ring.map(|p| place.apply(p)).collect();
                if bound.at(1).word() == Some("F") {
                    ring.reverse();
                }
                self.work += ring.len();
                if self.is_exhausted() {
                    return None;
                }
                faces.push(ring);
            }
        }
        prism_of_faces(&faces)
    }

    /// Faces given by indices into a list of points, from 1.
    fn face_set(
        &mut self,
        item: &Instance,
        at: usize,
        are_faces: bool,
        place: &Place,
    ) -> Option<Prism> {
        let all = self.all;
        let list = all.get(item.at(0).reference()?)?;
        let points: Vec<Point3<f64>> =
            list.at(0).list().iter().filter_map(coordinates).map(|p| place.apply(p)).collect();
        let mut faces = Vec::new();
        for face in item.at(at).list() {
            let index = if are_faces { all.get(face.reference()?)?.at(0) } else { face };
            let corner = |v: &Value| points.get((v.number()? as usize).checked_sub(1)?).copied();
            let ring: Vec<_> = index.list().iter().filter_map(corner).collect();
            self.work += ring.len() + 1;
            if self.is_exhausted() {
                return None;
            }
            faces.push(ring);
        }
        prism_of_faces(&faces)
    }
}

fn flat(p: &Point3<f64>) -> Point {
    Point::new(p.x, p.y)
}

/// A ring swept along a vector. Swept level (a door panel lying on its profile), it is what it covers.
fn prism_of(ring: &[Point3<f64>], holes: &[Line], along: Vector3<f64>) -> Option<Prism> {
    let heights = || ring.iter().flat_map(|p| [p.z, p.z + along.z]);
    let bottom = heights().fold(f64::INFINITY, f64::min);
    let top = heights().fold(f64::NEG_INFINITY, f64::max);
    if !(bottom.is_finite() && top.is_finite()) {
        return None;
    }
    let steep = along.xy().norm() <= 1e-3 * along.norm();
    let is_level = ring.iter().all(|p| (p.z - ring[0].z).abs() <= 1e-3 * (1.0 + along.norm()));
    let outline: Vec<Point> = if steep && is_level {
        ring.iter().map(flat).collect()
    } else {
        let swept = ring.iter().flat_map(|p| [flat(p), flat(&(p + along))]);
        convex_hull(swept.collect())
    };
    let holes = holes.iter().map(|h| h.iter().map(flat).collect()).collect();
    (outline.len() >= 3).then_some(Prism { outline, holes, bottom, top })
}

fn bounding_box(all: &Instances, item: &Instance, place: &Place) -> Option<Prism> {
    let corner = point(all, item.at(0))?;
    let size = [item.at(1).number()?, item.at(2).number()?, item.at(3).number()?];
    let ring = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let ring = ring.map(|(x, y)| place.apply(corner + Vector3::new(x * size[0], y * size[1], 0.0)));
    prism_of(&ring, &[], place.turn(Vector3::new(0.0, 0.0, size[2])))
}

/// The prism of a closed body: what its lowest faces make, or its hull.
fn prism_of_faces(faces: &[Vec<Point3<f64>>]) -> Option<Prism> {
    let corners: Vec<Point> = faces.iter().flatten().map(flat).collect();
    let heights = || faces.iter().flatten().map(|p| p.z);
    let bottom = heights().fold(f64::INFINITY, f64::min);
    let top = heights().fold(f64::NEG_INFINITY, f64::max);
    let hull = convex_hull(corners);
    if hull.len() < 3 {
        return None;
    }
    let lowest =
        |f: &&Vec<Point3<f64>>| f.iter().all(|p| p.z - bottom <= 1e-3 * (1.0 + top - bottom));
    let mut rings = joined(faces.iter().filter(lowest));
    rings.sort_by(|a, b| outline::area(b).abs().total_cmp(&outline::area(a).abs()));
    let whole = outline::area(&hull);
    let outer = rings.first().filter(|r| outline::area(r).abs() >= 0.3 * whole).cloned();
    let holes = if outer.is_some() { rings.split_off(1) } else { Vec::new() };
    Some(Prism { outline: outer.unwrap_or(hull), holes, bottom, top })
}

/// The borders of faces that lie side by side: edges that two of them share are inside.
fn joined<'f>(faces: impl Iterator<Item = &'f Vec<Point3<f64>>>) -> Vec<Vec<Point>> {
    let key = |p: &Point3<f64>| (p.x.to_bits(), p.y.to_bits());
    type Corner = (u64, u64);
    let mut next = HashMap::<Corner, Vec<Corner>>::new();
    let mut places = HashMap::<Corner, Point>::new();
    let mut order = Vec::new();
    for face in faces {
        for (a, b) in face.iter().zip(face.iter().cycle().skip(1)) {
            let (from, to) = (key(a), key(b));
            if from == to {
                continue;
            }
            places.insert(from, flat(a));
            let back = next.get_mut(&to).and_then(|ends| {
                let at = ends.iter().position(|end| *end == from)?;
                Some(ends.swap_remove(at))
            });
            if back.is_none() {
                next.entry(from).or_default().push(to);
                order.push(from);
            }
        }
    }
    let mut rings = Vec::new();
    for start in order {
        let mut ring = Vec::new();
        let mut here = start;
        while let Some(to) = next.get_mut(&here).and_then(Vec::pop) {
            ring.extend(places.get(&here));
            here = to;
        }
        if ring.len() >= 3 {
            rings.push(ring);
        }
    }
    rings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_of_a_floor_make_its_outline() {
        // A rectangle of two triangles, and a roof that does not count.
        let p = |x: f64, y: f64, z: f64| Point3::new(x, y, z);
        let quad = |x0: f64, y0: f64, x1: f64, y1: f64| {
            let c = [p(x0, y0, 0.0), p(x1, y0, 0.0), p(x1, y1, 0.0), p(x0, y1, 0.0)];
            [vec![c[0], c[1], c[2]], vec![c[0], c[2], c[3]]]
        };
        let mut faces: Vec<_> = quad(0.0, 0.0, 4.0, 2.0).into();
        faces.push(vec![p(0.0, 0.0, 3.0), p(4.0, 0.0, 3.0), p(4.0, 2.0, 3.0)]);
        let prism = prism_of_faces(&faces).unwrap();
        assert_eq!((prism.bottom, prism.top), (0.0, 3.0));
        assert_eq!(prism.outline.len(), 4);
        assert!((prism.area() - 8.0).abs() < 1e-9);
    }
}
