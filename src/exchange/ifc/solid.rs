//! Shape items → bodies of faces: swept, faceted, tessellated and bounded solids, surface models, CSG.
//!
//! What has curved faces that its edges do not tell (a sphere, a bent sheet of an IfcAdvancedBrep) is a *round* body:
//! the hull of its edges and control points stands for it. Half spaces cut faces; other bodies that are taken away
//! are kept beside the one they are taken from.

use nalgebra::{Point3, Vector3};

use super::body::{Body, Line, Rings, between};
use super::curve::DEEPEST;
use super::place::{Place, coordinates, direction, point};
use super::shape::Shapes;
use super::step::{Instance, Value};

/// Steps of a whole turn of a revolved profile, a disk, a sphere.
const STEPS: f64 = 24.0;

impl Shapes<'_> {
    /// The bodies of one item, in the frame `place`.
    pub(super) fn solid(
        &mut self,
        item: &Instance,
        place: &Place,
        depth: usize,
        into: &mut Vec<Body>,
    ) {
        self.charge(1);
        if depth > DEEPEST || self.is_exhausted() {
            return;
        }
        let all = self.all;
        let of = |v: &Value| all.get(v.reference()?);
        match item.kind {
            "IFCEXTRUDEDAREASOLID" => into.extend(self.extruded(item, place)),
            "IFCEXTRUDEDAREASOLIDTAPERED" => into.extend(self.tapered(item, place)),
            "IFCREVOLVEDAREASOLID" | "IFCREVOLVEDAREASOLIDTAPERED" => {
                into.extend(self.revolved(item, place));
            }
            "IFCSWEPTDISKSOLID" | "IFCSWEPTDISKSOLIDPOLYGONAL" => {
                let line = of(item.at(0)).map(|c| self.curve(c, 0)).unwrap_or_default();
                let radius = item.at(1).number().unwrap_or(0.0);
                into.extend(self.tube(&line, radius, place));
            }
            "IFCSURFACECURVESWEPTAREASOLID"
            | "IFCFIXEDREFERENCESWEPTAREASOLID"
            | "IFCDIRECTRIXCURVESWEPTAREASOLID"
            | "IFCDIRECTRIXDERIVEDREFERENCESWEPTAREASOLID" => {
                // As far from its line as the profile reaches.
                let own = place.compose(&Place::of_axis(all, item.at(1)));
                let line = of(item.at(2)).map(|c| self.curve(c, 0)).unwrap_or_default();
                let profile = of(item.at(0)).map(|p| self.profile(p, 0)).unwrap_or_default();
                let reach = profile.iter().flatten().flatten().map(|p| p.coords.norm());
                let tube = self.tube(&line, reach.fold(0.0, f64::max), &own);
                into.extend(tube.map(|tube| Body { is_round: true, ..tube }));
            }
            "IFCBOUNDINGBOX" => {
                let corner = point(all, item.at(0));
                let size = [1, 2, 3].map(|at| item.at(at).number());
                if let (Some(corner), [Some(x), Some(y), Some(z)]) = (corner, size) {
                    into.push(boxed(place, corner, x, y, z));
                }
            }
            "IFCFACETEDBREP"
            | "IFCFACETEDBREPWITHVOIDS"
            | "IFCADVANCEDBREP"
            | "IFCADVANCEDBREPWITHVOIDS" => into.extend(self.shells(&[item.at(0)], place)),
            "IFCSHELLBASEDSURFACEMODEL" | "IFCFACEBASEDSURFACEMODEL" => {
                let shells: Vec<&Value> = item.at(0).list().iter().collect();
                into.extend(self.shells(&shells, place));
            }
            "IFCCLOSEDSHELL" | "IFCOPENSHELL" | "IFCCONNECTEDFACESET" => {
                let mut body = Body::default();
                self.shell(item, place, &mut body);
                into.push(body);
            }
            "IFCFACE" | "IFCFACESURFACE" | "IFCADVANCEDFACE" => {
                let mut body = Body::default();
                self.face(item, place, &mut body);
                into.push(body);
            }
            "IFCPOLYGONALFACESET" => into.extend(self.face_set(item, 2, true, place)),
            "IFCTRIANGULATEDFACESET" | "IFCTRIANGULATEDIRREGULARNETWORK" => {
                into.extend(self.face_set(item, 3, false, place));
            }
            "IFCBOOLEANCLIPPINGRESULT" | "IFCBOOLEANRESULT" => {
                self.boolean(item, place, depth, into);
            }
            "IFCCSGSOLID" => {
                if let Some(root) = of(item.at(0)) {
                    self.solid(root, place, depth + 1, into);
                }
            }
            "IFCMAPPEDITEM" => self.mapped(item, place, depth, into),
            "IFCGEOMETRICCURVESET" | "IFCGEOMETRICSET" => {
                for part in item.at(0).list().iter().filter_map(of) {
                    self.solid(part, place, depth + 1, into);
                }
            }
            "IFCCURVEBOUNDEDPLANE" => {
                let own = of(item.at(0)).map(|plane| Place::of_axis(all, plane.at(0)));
                let own = place.compose(&own.unwrap_or_default());
                let line = of(item.at(1)).map(|c| self.curve(c, 0)).unwrap_or_default();
                into.push(Body::of(vec![vec![line.iter().map(|p| own.apply(*p)).collect()]]));
            }
            "IFCSURFACEOFLINEAREXTRUSION" => into.extend(self.curtain(item, place)),
            kind if kind.ends_with("CURVE") || kind == "IFCCIRCLE" || kind == "IFCELLIPSE" => {
                let line = self.curve(item, depth);
                into.push(Body::of(vec![vec![line.iter().map(|p| place.apply(*p)).collect()]]));
            }
            "IFCPOLYLINE" => {
                let line = self.curve(item, depth);
                into.push(Body::of(vec![vec![line.iter().map(|p| place.apply(*p)).collect()]]));
            }
            _ => into.extend(self.primitive(item, place)),
        }
    }

    fn mapped(&mut self, item: &Instance, place: &Place, depth: usize, into: &mut Vec<Body>) {
        let all = self.all;
        let Some((map, place)) = self.target(item, place) else { return };
        let Some(map) = all.get(map) else { return };
        let Some(shape) = map.at(1).reference().and_then(|id| all.get(id)) else { return };
        for part in shape.at(3).list() {
            if let Some(part) = part.reference().and_then(|id| all.get(id)) {
                self.solid(part, &place, depth + 1, into);
            }
        }
    }

    /// Which map a mapped item shows, and where.
    pub(super) fn target(&self, item: &Instance, place: &Place) -> Option<(u32, Place)> {
        let all = self.all;
        let id = item.at(0).reference()?;
        let map = all.get(id).filter(|m| m.kind == "IFCREPRESENTATIONMAP")?;
        let operator = item.at(1).reference().and_then(|id| all.get(id));
        let target = operator.map_or_else(Place::default, |o| Place::of_operator(all, o));
        Some((id, place.compose(&target).compose(&Place::of_axis(all, map.at(0)))))
    }

    /// Rings of an item's profile, in the frame of the item's position, and that frame.
    fn section(
        &mut self,
        item: &Instance,
        at: usize,
        place: &Place,
    ) -> Option<(Vec<Rings>, Place)> {
        let all = self.all;
        let own = place.compose(&Place::of_axis(all, item.at(1)));
        let profile = self.profile(all.get(item.at(at).reference()?)?, 0);
        Some((profile, own))
    }

    fn extruded(&mut self, item: &Instance, place: &Place) -> Vec<Body> {
        let Some((profile, own)) = self.section(item, 0, place) else { return Vec::new() };
        let Some(along) = self.extrusion(item, &own) else { return Vec::new() };
        let swept = |rings: Rings| Body::swept(&placed(&rings, &own), along);
        profile.into_iter().map(swept).collect()
    }

    /// Direction times depth of an extrusion.
    fn extrusion(&self, item: &Instance, own: &Place) -> Option<Vector3<f64>> {
        let towards = direction(self.all, item.at(2)).unwrap_or_else(Vector3::z);
        let depth = item.at(3).number().filter(|d| d.abs() < 1e9)?;
        Some(own.turn(towards.try_normalize(1e-12)? * depth))
    }

    /// From one profile to another of as many corners; else their hull.
    fn tapered(&mut self, item: &Instance, place: &Place) -> Option<Body> {
        let (from, own) = self.section(item, 0, place)?;
        let (to, _) = self.section(item, 4, place)?;
        let along = self.extrusion(item, &own)?;
        let (from, mut to) = (placed(from.first()?, &own), placed(to.first()?, &own));
        to.iter_mut().flatten().for_each(|p| *p += along);
        let is_round = from.iter().map(Vec::len).ne(to.iter().map(Vec::len));
        let mut faces = between(&from, &to);
        faces.extend([from, to]);
        Some(Body { is_round, ..Body::of(faces) })
    }

    fn revolved(&mut self, item: &Instance, place: &Place) -> Vec<Body> {
        let Some((profile, own)) = self.section(item, 0, place) else { return Vec::new() };
        let axis = Place::of_axis(self.all, item.at(2));
        let unit = self.angle_unit;
        let Some(angle) = item.at(3).number().map(|a| a * unit) else { return Vec::new() };
        let angle = angle.clamp(-std::f64::consts::TAU, std::f64::consts::TAU);
        let steps = (angle.abs() / std::f64::consts::TAU * STEPS).ceil().max(1.0) as usize;
        let Some(about) = nalgebra::Unit::try_new(axis.z, 1e-12) else { return Vec::new() };
        let turned = |rings: &Rings, k: usize| -> Rings {
            let by = angle * k as f64 / steps as f64;
            let turn = nalgebra::Rotation3::from_axis_angle(&about, by);
            let turn = |p: &Point3<f64>| own.apply(axis.origin + turn * (p - axis.origin));
            rings.iter().map(|ring| ring.iter().map(turn).collect()).collect()
        };
        let mut bodies = Vec::new();
        for rings in &profile {
            self.charge(rings.iter().map(Vec::len).sum::<usize>() * steps);
            if self.is_exhausted() {
                break;
            }
            let mut faces = vec![turned(rings, 0), turned(rings, steps)];
            for k in 0..steps {
                faces.extend(between(&turned(rings, k), &turned(rings, k + 1)));
            }
            bodies.push(Body::of(faces));
        }
        bodies
    }

    /// A disk swept along a line.
    fn tube(&mut self, line: &Line, radius: f64, place: &Place) -> Option<Body> {
        if line.len() < 2 || !(1e-9..1e9).contains(&radius) {
            return None;
        }
        self.charge(line.len() * 16);
        let mut faces = Vec::new();
        // Each straight piece by itself, as wide as the disk up to its very ends.
        for piece in line.windows(2) {
            let Some(along) = (piece[1] - piece[0]).try_normalize(1e-12) else { continue };
            let aside = if along.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
            let u = along.cross(&aside).normalize();
            let v = along.cross(&u);
            let disk = |at: Point3<f64>| -> Rings {
                let corner = |k: u32| {
                    let (sin, cos) = (f64::from(k) / 8.0 * std::f64::consts::TAU).sin_cos();
                    place.apply(at + (u * cos + v * sin) * radius)
                };
                vec![(0..8).map(corner).collect()]
            };
            let (from, to) = (disk(piece[0]), disk(piece[1]));
            faces.extend(between(&from, &to));
            faces.extend([from, to]);
        }
        Some(Body::of(faces))
    }

    fn curtain(&mut self, item: &Instance, place: &Place) -> Option<Body> {
        let all = self.all;
        let own = place.compose(&Place::of_axis(all, item.at(1)));
        let along = self.extrusion(item, &own)?;
        let profile = all.get(item.at(0).reference()?)?;
        // The profile is open: a curve, not what it encloses.
        let curve = all.get(profile.at(2).reference()?)?;
        let line = self.curve(curve, 0);
        let line: Line = line.iter().map(|p| own.apply(*p)).collect();
        let faces = line.windows(2).map(|w| vec![vec![w[0], w[1], w[1] + along, w[0] + along]]);
        Some(Body::of(faces.collect()))
    }

    fn shells(&mut self, shells: &[&Value], place: &Place) -> Option<Body> {
        let all = self.all;
        let mut body = Body::default();
        for shell in shells.iter().filter_map(|s| all.get(s.reference()?)) {
            self.shell(shell, place, &mut body);
        }
        (!body.faces.is_empty()).then_some(body)
    }

    fn shell(&mut self, shell: &Instance, place: &Place, body: &mut Body) {
        let all = self.all;
        for face in shell.at(0).list().iter().filter_map(|f| all.get(f.reference()?)) {
            self.face(face, place, body);
            if self.is_exhausted() {
                return;
            }
        }
    }

    fn face(&mut self, face: &Instance, place: &Place, body: &mut Body) {
        let all = self.all;
        let of = |v: &Value| all.get(v.reference()?);
        let mut rings: Rings = Vec::new();
        for bound in face.at(0).list().iter().filter_map(of) {
            let Some(around) = of(bound.at(0)) else { continue };
            let ring = self.around(around);
            self.charge(ring.len() + 1);
            let ring: Line = ring.iter().map(|p| place.apply(*p)).collect();
            if ring.len() < 3 {
                continue;
            }
            // The outer bound leads, wherever it stands.
            if bound.kind == "IFCFACEOUTERBOUND" {
                rings.insert(0, ring);
            } else {
                rings.push(ring);
            }
        }
        if let Some(surface) = of(face.at(1)).filter(|s| s.kind != "IFCPLANE") {
            body.is_round = true;
            let reach = self.surface(surface);
            self.charge(reach.len());
            rings.push(reach.iter().map(|p| place.apply(*p)).collect());
        }
        if !rings.is_empty() {
            body.faces.push(rings);
        }
    }

    /// The corners of a loop.
    fn around(&mut self, around: &Instance) -> Line {
        let all = self.all;
        let of = |v: &Value| all.get(v.reference()?);
        if around.kind == "IFCPOLYLOOP" {
            return around.at(0).list().iter().filter_map(|p| point(all, p)).collect();
        }
        let vertex = |v: &Value| point(all, of(v)?.at(0));
        let mut ring = Vec::new();
        for oriented in around.at(0).list().iter().filter_map(of) {
            if self.is_exhausted() {
                break;
            }
            let Some(edge) = of(oriented.at(2)) else { continue };
            let (start, end) = (vertex(edge.at(0)), vertex(edge.at(1)));
            let geometry = of(edge.at(2)).filter(|_| edge.kind == "IFCEDGECURVE");
            let mut line = self.edge(geometry, edge, start, end);
            if oriented.at(3).word() == Some("F") {
                line.reverse();
            }
            ring.append(&mut line);
        }
        ring
    }

    /// From vertex to vertex along the edge's curve.
    fn edge(
        &mut self,
        geometry: Option<&Instance>,
        edge: &Instance,
        start: Option<Point3<f64>>,
        end: Option<Point3<f64>>,
    ) -> Line {
        let ends = || [start, end].into_iter().flatten().collect::<Line>();
        let Some(curve) = geometry.filter(|g| g.kind != "IFCLINE") else { return ends() };
        let whole = self.curve(curve, 0);
        let (Some(start), Some(end)) = (start, end) else { return whole };
        if (start - end).norm() < 1e-9 || whole.len() < 3 {
            return if whole.is_empty() { ends() } else { whole };
        }
        let nearest = |p: Point3<f64>| {
            let away = |i: &usize| (whole[*i] - p).norm_squared();
            (0..whole.len()).min_by(|i, j| away(i).total_cmp(&away(j))).unwrap_or(0)
        };
        let (from, to) = (nearest(start), nearest(end));
        let is_closed =
            (whole[0] - whole[whole.len() - 1]).norm() < 1e-6 * (1.0 + whole.len() as f64);
        let forward = edge.at(3).word() != Some("F");
        let n = whole.len();
        let mut line = vec![start];
        let mut i = from;
        // Chords between the ends, the way round that the edge takes.
        for _ in 0..n {
            if i == to {
                break;
            }
            i = if forward { i + 1 } else { i + n - 1 };
            if !is_closed && i >= n && (forward || i - n >= n - 1) {
                break;
            }
            i %= n;
            line.push(whole[i]);
        }
        line.push(end);
        line
    }

    /// How far a curved surface may reach beyond the edges of its face.
    fn surface(&mut self, surface: &Instance) -> Line {
        let all = self.all;
        let place = Place::of_axis(all, surface.at(0));
        let n = |at: usize| surface.at(at).number().filter(|n| n.abs() < 1e9).unwrap_or(0.0);
        let about = |wide: f64, high: f64| -> Line {
            let corners = [-1.0, 1.0].map(|z| {
                [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                    .map(|(x, y)| place.apply(Point3::new(x * wide, y * wide, z * high)))
            });
            corners.concat()
        };
        match surface.kind {
            "IFCSPHERICALSURFACE" => about(n(1), n(1)),
            "IFCTOROIDALSURFACE" => about(n(1) + n(2), n(2)),
            kind if kind.contains("BSPLINESURFACE") => {
                let rows = surface.at(2).list().iter().flat_map(Value::list);
                rows.filter_map(|p| point(all, p)).collect()
            }
            // A cylinder or a cone is held by its edges.
            _ => Vec::new(),
        }
    }

    /// Faces given by indices into a list of points, from 1.
    fn face_set(
        &mut self,
        item: &Instance,
        at: usize,
        are_faces: bool,
        place: &Place,
    ) -> Option<Body> {
        let all = self.all;
        let list = all.get(item.at(0).reference()?)?;
        let points: Line =
            list.at(0).list().iter().filter_map(coordinates).map(|p| place.apply(p)).collect();
        self.charge(points.len());
        // A second list of indices may stand between the faces and the points.
        let through = item.at(at + 1).list();
        let corner = |v: &Value| {
            let mut index = v.number()?;
            if !through.is_empty() {
                index = through.get((index as usize).checked_sub(1)?)?.number()?;
            }
            points.get((index as usize).checked_sub(1)?).copied()
        };
        let ring = |list: &Value| list.list().iter().filter_map(corner).collect::<Line>();
        let mut faces = Vec::new();
        for face in item.at(at).list() {
            let mut rings = Vec::new();
            if are_faces {
                let Some(face) = face.reference().and_then(|id| all.get(id)) else { continue };
                rings.push(ring(face.at(0)));
                rings.extend(face.at(1).list().iter().map(ring));
            } else {
                rings.push(ring(face));
            }
            self.charge(rings.iter().map(Vec::len).sum::<usize>() + 1);
            if self.is_exhausted() {
                return None;
            }
            if rings[0].len() >= 3 {
                faces.push(rings);
            }
        }
        (!faces.is_empty()).then(|| Body::of(faces))
    }

    fn boolean(&mut self, item: &Instance, place: &Place, depth: usize, into: &mut Vec<Body>) {
        let all = self.all;
        let of = |v: &Value| all.get(v.reference()?);
        let mut first = Vec::new();
        if let Some(one) = of(item.at(1)) {
            self.solid(one, place, depth + 1, &mut first);
        }
        if let Some(other) = of(item.at(2)) {
            let is_union = item.at(0).word() == Some("UNION");
            let is_difference = item.at(0).word() == Some("DIFFERENCE");
            if other.kind.ends_with("HALFSPACE") || other.kind == "IFCHALFSPACESOLID" {
                self.half_space(other, place, is_difference, &mut first);
            } else if is_union {
                self.solid(other, place, depth + 1, &mut first);
            } else if is_difference {
                let mut less = Vec::new();
                self.solid(other, place, depth + 1, &mut less);
                first.iter_mut().for_each(|body| body.less.extend(less.iter().cloned()));
                self.charge(first.len() * less.iter().map(|b| b.faces.len()).sum::<usize>());
            }
            // Of what two bodies have in common the first one is taken whole.
        }
        into.append(&mut first);
    }

    /// Takes a half space off some bodies, or all that is not in it.
    fn half_space(
        &mut self,
        half: &Instance,
        place: &Place,
        is_difference: bool,
        bodies: &mut [Body],
    ) {
        let all = self.all;
        let Some(surface) = half.at(0).reference().and_then(|id| all.get(id)) else { return };
        if surface.kind != "IFCPLANE" {
            return;
        }
        let plane = place.compose(&Place::of_axis(all, surface.at(0)));
        let agrees = half.at(1).word() != Some("F");
        // With agreement the half space lies against the normal.
        let within = if agrees { -plane.z } else { plane.z };
        let away = if is_difference { within } else { -within };
        if half.kind != "IFCPOLYGONALBOUNDEDHALFSPACE" {
            bodies.iter_mut().for_each(|body| body.clip(plane.origin, away));
            return;
        }
        let own = place.compose(&Place::of_axis(all, half.at(2)));
        let curve = half.at(3).reference().and_then(|id| all.get(id));
        let ring = curve.map(|c| self.curve(c, 0)).unwrap_or_default();
        if !is_difference || ring.len() < 3 {
            return;
        }
        // The column over the polygon, as long as the bodies reach, less what is beyond the plane.
        let Some(up) = own.z.try_normalize(1e-12) else { return };
        for body in bodies.iter_mut() {
            self.charge(ring.len() * 4);
            let heights = body.corners().map(|p| (p - own.origin).dot(&up));
            let (low, high) =
                heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
            if low > high {
                continue;
            }
            let (low, high) = (low - 10.0, high + 10.0);
            let ring: Line = ring.iter().map(|p| own.apply(*p) + up * low).collect();
            let mut column = Body::swept(&vec![ring], up * (high - low));
            column.clip(plane.origin, -within);
            if column.heights().is_some() {
                body.less.push(column);
            }
        }
    }

    fn primitive(&mut self, item: &Instance, place: &Place) -> Option<Body> {
        let own = place.compose(&Place::of_axis(self.all, item.at(0)));
        let n = |at: usize| item.at(at).number().filter(|n| n.abs() < 1e9);
        let circle = |radius: f64, z: f64| -> Line {
            let corner = |k: u32| {
                let (sin, cos) = (f64::from(k) / STEPS * std::f64::consts::TAU).sin_cos();
                own.apply(Point3::new(radius * cos, radius * sin, z))
            };
            (0..STEPS as u32).map(corner).collect()
        };
        let base = Point3::origin();
        match item.kind {
            "IFCBLOCK" => Some(boxed(&own, base, n(1)?, n(2)?, n(3)?)),
            "IFCRECTANGULARPYRAMID" => {
                let (x, y) = (n(1)?, n(2)?);
                let tip = own.apply(Point3::new(x / 2.0, y / 2.0, n(3)?));
                let ring = [(0.0, 0.0), (x, 0.0), (x, y), (0.0, y)];
                let ring = ring.map(|(x, y)| own.apply(Point3::new(x, y, 0.0))).to_vec();
                let mut faces: Vec<Rings> =
                    (0..4).map(|i| vec![vec![ring[i], ring[(i + 1) % 4], tip]]).collect();
                faces.push(vec![ring]);
                Some(Body::of(faces))
            }
            "IFCRIGHTCIRCULARCYLINDER" => {
                Some(Body::swept(&vec![circle(n(2)?, 0.0)], own.z * n(1)?))
            }
            "IFCRIGHTCIRCULARCONE" => {
                let (ring, tip) = (circle(n(2)?, 0.0), own.apply(Point3::new(0.0, 0.0, n(1)?)));
                let sides = (0..ring.len()).map(|i| vec![ring[i], ring[(i + 1) % ring.len()], tip]);
                let mut faces: Vec<Rings> = sides.map(|side| vec![side]).collect();
                faces.push(vec![ring]);
                Some(Body::of(faces))
            }
            "IFCSPHERE" => {
                let radius = n(1)?;
                let ring = |k: i32| {
                    let (sin, cos) = (f64::from(k) / 6.0 * std::f64::consts::FRAC_PI_2).sin_cos();
                    vec![circle(radius * cos, radius * sin)]
                };
                Some(Body::of((-6..6).flat_map(|k| between(&ring(k), &ring(k + 1))).collect()))
            }
            _ => None,
        }
    }
}

fn placed(rings: &Rings, place: &Place) -> Rings {
    rings.iter().map(|ring| ring.iter().map(|p| place.apply(*p)).collect()).collect()
}

fn boxed(place: &Place, corner: Point3<f64>, x: f64, y: f64, z: f64) -> Body {
    let ring = [(0.0, 0.0), (x, 0.0), (x, y), (0.0, y)];
    let ring = ring.map(|(x, y)| place.apply(corner + Vector3::new(x, y, 0.0)));
    Body::swept(&vec![ring.to_vec()], place.turn(Vector3::new(0.0, 0.0, z)))
}
