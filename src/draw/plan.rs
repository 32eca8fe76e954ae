//! The plan of a Map or of one Fragment (figs. 6, 9-12): rooms, windows, doors as architects draw them, furniture, free
//! floor, Passframes and their network, a route with its directives.

use std::collections::{BTreeMap, BTreeSet};

use crate::geometry::{
    Bounds, FloorPlan, PlacedArea, PlacedReplica, Polygon, Prism, Region, Scene,
};
use crate::map::{DoorStatus, Permeability, RobotProfile, World};
use crate::units::{AreaId, Language, Point, Pose, ReplicaId, Vector};

use super::canvas::{Anchor, Canvas, Lettering, Style};
use super::font::text_width;
use super::furniture;
use super::labels::{Ground, Labels, Slant, around};
use super::legend::{Entry, Legend, List, scale_bar, scale_bar_width};
use super::rooms;

/// Free floor and its partition, as the drawing needs them.
#[derive(Debug, Clone, Default)]
pub struct FloorLayer {
    /// Convex cells with the short text that stands in them.
    pub passframes: Vec<(Polygon, String)>,
    /// Floor that no position of the robot covers.
    pub dead_zones: Vec<Region>,
}

/// The Passframe network (fig. 12): vertices within Passframes, edges over the borders that the robot can cross.
#[derive(Debug, Clone, Default)]
pub struct NetworkLayer {
    pub vertices: Vec<Point>,
    /// From vertex to vertex through the middle of their border.
    pub edges: Vec<[Point; 3]>,
    /// From vertex to vertex through a doorway.
    pub doors: Vec<[Point; 3]>,
}

impl NetworkLayer {
    /// The network of a floor, or of one Area of it.
    #[must_use]
    pub fn of(floor: &FloorPlan, only: Option<AreaId>) -> Self {
        use crate::geometry::Beyond;
        let mut layer = Self::default();
        let middle = |(a, b): (Point, Point)| nalgebra::center(&a, &b);
        let mut by_doorway: BTreeMap<usize, Vec<(Point, Point)>> = BTreeMap::new();
        for fragment in floor.fragments().filter(|f| only.is_none_or(|a| a == f.area)) {
            let centre: BTreeMap<_, _> =
                fragment.passframes().iter().map(|p| (p.id, p.polygon.centroid())).collect();
            for frame in fragment.passframes() {
                let from = centre[&frame.id];
                layer.vertices.push(from);
                for (to, crossing) in frame.neighbours().filter(|(to, _)| *to > frame.id) {
                    if let Some(&to) = centre.get(&to) {
                        layer.edges.push([from, middle(crossing), to]);
                    }
                }
                for border in &frame.borders {
                    if let (Beyond::Doorway { doorway, .. }, Some(crossing)) =
                        (border.beyond, border.crossing)
                    {
                        by_doorway.entry(doorway).or_default().push((from, middle(crossing)));
                    }
                }
            }
        }
        for ends in by_doorway.into_values() {
            match ends[..] {
                [(from, at), (to, _), ..] => layer.doors.push([from, at, to]),
                [(from, at)] => layer.doors.push([from, at, at]),
                [] => {}
            }
        }
        layer
    }
}

/// A drivable line, cut into the directives' legs.
#[derive(Debug, Clone, Default)]
pub struct RouteLayer {
    /// The number of the directive, and its way.
    pub legs: Vec<(usize, Vec<Point>)>,
    /// The directives by number, listed beside the plan.
    pub directives: Vec<(usize, String)>,
    pub start: Option<Pose>,
}

/// A door leaf where it stands, and the way of its tip from shut to open, on to the hinge.
#[derive(Debug, Clone)]
pub struct DoorGlyph {
    pub leaf: Polygon,
    pub arc: Vec<Point>,
    pub status: DoorStatus,
}

/// What is seen from a pose: the stretches of faces that are in view, within the angle of view.
#[derive(Debug, Clone, Default)]
pub struct ViewLayer {
    pub eye: Option<Pose>,
    /// The floor over which the eye sees, as a fan of triangles about the eye.
    pub fan: Vec<Point>,
    pub seen: Vec<(Point, Point)>,
}

/// What is to be drawn of a Map.
#[derive(Debug)]
pub struct PlanDrawing<'a> {
    pub world: &'a World,
    pub scene: &'a Scene,
    /// Only this Area with what stands in it: a Fragment.
    pub only: Option<AreaId>,
    pub doors: Vec<DoorGlyph>,
    pub floor: FloorLayer,
    pub network: NetworkLayer,
    pub route: RouteLayer,
    pub view: ViewLayer,
    /// Points with a name: «Точка-А».
    pub places: Vec<(Point, String)>,
    pub language: Language,
}

const LEAF: Style = Style::fill("#ffffff").outlined("#3b3a36", 1.2);
const LOCKED: Style = Style::fill("#b3261e").outlined("#3b3a36", 1.2);
const SWING: Style = Style::line("#8c887d", 0.9).dashed(3.0, 3.0);
const PASSFRAME: Style = Style::fill("#e4f1e3").outlined("#69a869", 0.9);
const DEAD_ZONE: Style = Style::fill("#e8a39b").faint(0.75);
const NETWORK: Style = Style::line("#7a4fa3", 1.3);
const VERTEX: Style = Style::fill("#7a4fa3");
const ROUTE: Style = Style::line("#1f5fbf", 4.0);
const SIGHT: Style = Style::fill("#ffd766").faint(0.35);
const SEEN: Style = Style::line("#e07b00", 3.4);
/// From this pen on a sheet shows a large building: some twenty metres.
const LARGE: f64 = 1.5;
const INK: &str = "#2b2a27";
const PLACE: &str = "#b3261e";
const DOORWAY: &str = "#b3261e";
const ROBOT: Style = Style::fill("#9cc2f2").outlined("#1f5fbf", 2.0).faint(0.85);
/// From so many things on it a table is crowded: the small ones then bear their names only where these fit on them.
const CROWD: usize = 7;

impl PlanDrawing<'_> {
    fn areas(&self) -> impl Iterator<Item = &PlacedArea> + '_ {
        self.scene.areas.values().filter(|a| self.only.is_none_or(|only| only == a.id))
    }

    fn things(&self) -> impl Iterator<Item = &PlacedReplica> + '_ {
        self.scene.replicas.values().filter(|r| self.only.is_none_or(|only| only == r.area))
    }

    /// The drawing as SVG text.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let rooms = self.areas().flat_map(|a| &a.prisms);
        let mut extent = rooms.fold(Bounds::EMPTY, |b, prism| b.union(&prism.bounds));
        if extent.min.x > extent.max.x {
            extent = Bounds::of([Point::origin()]).grown(100.0);
        }
        let longest = (extent.max.x - extent.min.x).max(extent.max.y - extent.min.y);
        // Letters and lines grow with the building, but slower, so that a hospital's rooms keep their names.
        let pen = (longest / 1000.0).max(0.35).sqrt();
        // A leaf that swings out of the rooms is shown whole, and what stands below the plan keeps clear of it.
        let doors: Vec<&DoorGlyph> =
            self.doors.iter().filter(|d| extent.meets(&d.leaf.bounds())).collect();
        let leaves = doors.iter().flat_map(|d| d.leaf.corners.iter().chain(&d.arc));
        let whole = extent.union(&Bounds::of(leaves.copied()));
        let legend = self.legend(whole, pen);
        // Names are placed before the sheet's size is known, which hangs on how many are listed below the plan.
        let names = whole.grown(30.0 * pen);
        let numbered = self.labels(&mut Canvas::new(whole), names, pen);
        let mut sheet = whole.grown(34.0 * pen);
        sheet.max.x = sheet.max.x.max(sheet.min.x + 640.0 * pen).max(legend.right() + 20.0 * pen);
        let list = Point::new(whole.min.x, whole.min.y - legend.height() - 24.0 * pen);
        let list = List::new(numbered, list, sheet.max.x - 20.0 * pen - whole.min.x, pen);
        sheet.min.y -= legend.height() + list.height() + 22.0 * pen;
        let heading = self.heading();
        if heading.is_some() {
            sheet.max.y += 30.0 * pen;
        }
        let width = sheet.max.x - sheet.min.x;
        let mut canvas = Canvas::new(sheet).wide((width / pen).clamp(760.0, 4000.0));
        for area in self.areas() {
            rooms::floor(&mut canvas, self.world, area, pen);
        }
        self.floor(&mut canvas, pen);
        furniture::draw(&mut canvas, self.world, self.things(), pen);
        rooms::walls(&mut canvas, self.world, self.areas(), pen);
        for door in doors {
            draw_door(&mut canvas, door, pen);
        }
        self.network(&mut canvas, pen);
        self.view(&mut canvas, pen);
        self.route(&mut canvas, pen);
        self.labels(&mut canvas, names, pen);
        if let Some(heading) = heading {
            let lettering = Lettering {
                anchor: Anchor::Start,
                halo: false,
                ..Lettering::bold(18.0 * pen, INK)
            };
            canvas.text(Point::new(whole.min.x, whole.max.y + 44.0 * pen), heading, lettering);
        }
        let below = Point::new(whole.min.x, whole.min.y - 42.0 * pen);
        scale_bar(&mut canvas, below, pen, self.language);
        legend.draw(&mut canvas);
        list.draw(&mut canvas);
        canvas.into_svg(&self.title())
    }

    fn title(&self) -> String {
        let map = &self.world.maps[&self.scene.map];
        match self.only.map(|id| &self.world.areas[&id]) {
            Some(area) => self.named(&area.name, &area.name_en).to_owned(),
            None => self.named(&map.name, &map.name_en).to_owned(),
        }
    }

    /// Which of several storeys this is.
    fn heading(&self) -> Option<&str> {
        let map = &self.world.maps[&self.scene.map];
        let is_one_of_many = self.only.is_none() && self.world.maps.len() > 1;
        is_one_of_many.then(|| self.named(&map.name, &map.name_en))
    }

    fn named<'n>(&self, russian: &'n str, english: &'n str) -> &'n str {
        if self.language == Language::English && !english.is_empty() { english } else { russian }
    }

    fn floor(&self, canvas: &mut Canvas, pen: f64) {
        for (cell, id) in &self.floor.passframes {
            canvas.polygon(cell, PASSFRAME.thick(pen), Some(id));
        }
        for zone in &self.floor.dead_zones {
            canvas.polygons(zone.contours().map(|c| c.corners.as_slice()), DEAD_ZONE, None);
        }
    }

    fn network(&self, canvas: &mut Canvas, pen: f64) {
        for edge in &self.network.edges {
            canvas.polyline(edge, NETWORK.thick(pen));
        }
        for [from, at, to] in &self.network.doors {
            canvas.polyline(&[*from, *at, *to], Style::line(DOORWAY, 1.6).thick(pen));
            let r = 4.5 * pen;
            let corners =
                [(r, 0.0), (0.0, r), (-r, 0.0), (0.0, -r)].map(|(x, y)| at + Vector::new(x, y));
            canvas.polygon(&Polygon::new(corners.into()), Style::fill(DOORWAY), None);
        }
        for vertex in &self.network.vertices {
            canvas.circle(*vertex, 3.2 * pen, VERTEX);
        }
    }

    fn view(&self, canvas: &mut Canvas, pen: f64) {
        let Some(eye) = self.view.eye else { return };
        if self.view.fan.len() >= 2 {
            let mut outline = vec![eye.at];
            outline.extend(&self.view.fan);
            canvas.polygon(&Polygon::new(outline), SIGHT, None);
        }
        for &(a, b) in &self.view.seen {
            canvas.segment(a, b, SEEN.thick(pen));
        }
        robot(canvas, eye, &self.world.robot, pen);
    }

    fn route(&self, canvas: &mut Canvas, pen: f64) {
        // What is done without driving is a leg of one point.
        for (_, leg) in self.route.legs.iter().filter(|(_, leg)| leg.len() > 1) {
            canvas.polyline(leg, ROUTE.thick(pen));
        }
        match (self.route.start, self.route.legs.first().and_then(|(_, leg)| leg.first())) {
            (Some(pose), _) => robot(canvas, pose, &self.world.robot, pen),
            (None, Some(&first)) => {
                let ring = Style::fill("#ffffff").outlined("#1f5fbf", 2.6).thick(pen);
                canvas.circle(first, 5.5 * pen, ring);
            }
            (None, None) => {}
        }
    }

    /// Numbers of the directives at the ends of their legs; those that end near one point share a badge.
    fn badges(&self, canvas: &mut Canvas, labels: &mut Labels, pen: f64) {
        let mut badges: Vec<(Point, Vec<usize>)> = Vec::new();
        for (number, leg) in &self.route.legs {
            let Some(&end) = leg.last() else { continue };
            match badges.iter_mut().find(|(at, _)| (at - end).norm() < 20.0 * pen) {
                Some((_, numbers)) => numbers.push(*number),
                None => badges.push((end, vec![*number])),
            }
        }
        let size = 11.0 * pen;
        for (at, numbers) in badges {
            let numbers: Vec<String> = numbers.iter().map(usize::to_string).collect();
            let text = numbers.join(" · ");
            let frame = around(
                at,
                (text_width(&text, size, true) + 10.0 * pen).max(18.0 * pen),
                18.0 * pen,
            );
            let style = Style::fill("#1f5fbf").outlined("#ffffff", 1.6).thick(pen);
            canvas.rectangle(frame, style, 9.0 * pen);
            canvas.text(at, &text, Lettering { halo: false, ..Lettering::bold(size, "#ffffff") });
            labels.take(frame);
        }
    }

    /// Names of places, rooms and furniture, the large before the small. Things whose names find no place bear numbers
    /// where a way bears none: gives their names in the order of the numbers, which is that of the rooms.
    fn labels(&self, canvas: &mut Canvas, sheet: Bounds, pen: f64) -> Vec<String> {
        let mut labels = Labels::new(10.0 * pen).within(sheet);
        for (_, leg) in &self.route.legs {
            leg.windows(2).for_each(|w| labels.avoid_line(w[0], w[1]));
        }
        let sides = self
            .areas()
            .flat_map(|a| &a.prisms)
            .flat_map(|p| p.polygon.edges().zip(p.sides.iter()));
        for ((a, b), _) in sides.filter(|(_, s)| s.permeability == Permeability::Impermeable) {
            labels.avoid_line(a, b);
        }
        for door in &self.doors {
            labels.take(door.leaf.bounds());
        }
        for (p, _) in &self.places {
            canvas.circle(*p, 3.2 * pen, Style::fill(PLACE));
            labels.take(around(*p, 7.0 * pen, 7.0 * pen));
        }
        self.badges(canvas, &mut labels, pen);
        for pose in self.route.start.iter().chain(&self.view.eye) {
            let wide = 2.0 * robot_reach(&self.world.robot, pen);
            labels.take(around(pose.at, wide, wide));
        }
        for (p, name) in &self.places {
            labels.beside(canvas, *p, name, Lettering::bold(12.0 * pen, PLACE));
        }
        for placed in self.areas() {
            let area_of = |prism: &Prism| prism.polygon.signed_area();
            let Some(prism) = placed.prisms.iter().max_by(|a, b| area_of(a).total_cmp(&area_of(b)))
            else {
                continue;
            };
            let furniture: Vec<Bounds> =
                self.scene.replicas_in(placed.id).map(|r| r.bounds).collect();
            let area = &self.world.areas[&placed.id];
            let name = self.named(&area.name, &area.name_en);
            let size = self.square_metres(placed.prisms.iter().map(area_of).sum());
            labels.in_room(
                canvas,
                &prism.polygon,
                &furniture,
                name,
                &size,
                Lettering::bold(20.0 * pen, INK),
            );
        }
        let crowded = if pen < LARGE { self.crowded() } else { BTreeSet::new() };
        let mut things: Vec<_> = self.things().collect();
        let size = |b: &Bounds| (b.max.x - b.min.x) * (b.max.y - b.min.y);
        things.sort_by(|a, b| size(&b.bounds).total_cmp(&size(&a.bounds)).then(a.id.cmp(&b.id)));
        let mut nameless = Vec::new();
        for (k, thing) in things.iter().enumerate() {
            let upon = things[k + 1..].iter().map(|t| t.bounds).filter(|b| b.meets(&thing.bounds));
            let upon: Vec<Bounds> = upon.collect();
            let replica = &self.world.replicas[&thing.id];
            let name = self.named(&replica.name, &replica.name_en);
            // On the sheet of a large building names beside small things would hide the things.
            let lettering = Lettering::plain(9.5 * pen, "#5b5647");
            let home = self.scene.areas.get(&thing.area).filter(|_| pen < LARGE);
            let home = home.filter(|_| !crowded.contains(&thing.id));
            let rooms: Vec<&Polygon> =
                home.iter().flat_map(|a| &a.prisms).map(|p| &p.polygon).collect();
            let corners = thing.prisms.iter().flat_map(|p| p.polygon.corners.iter().copied());
            let slant = Slant::of(&thing.frame, corners);
            let ground = Ground { bounds: thing.bounds, upon: &upon, slant };
            if !labels.on_thing(canvas, &ground, name, lettering, Some(&rooms)) {
                nameless.push((thing, upon, name));
            }
        }
        if !self.route.legs.is_empty() {
            return Vec::new();
        }
        let row = |b: &Bounds| (-b.max.y / (40.0 * pen)).floor();
        nameless.sort_by(|(a, ..), (b, ..)| {
            let down = row(&a.bounds).total_cmp(&row(&b.bounds));
            let right = a.bounds.min.x.total_cmp(&b.bounds.min.x);
            a.area.cmp(&b.area).then(down).then(right).then(a.id.cmp(&b.id))
        });
        let mut numbered = Vec::new();
        for (thing, upon, name) in nameless {
            let number = (numbered.len() + 1).to_string();
            let ground = Ground { bounds: thing.bounds, upon: &upon, slant: None };
            let lettering = Lettering::plain(9.5 * pen, INK);
            if labels.on_thing(canvas, &ground, &number, lettering, Some(&[])) {
                numbered.push(name.to_owned());
            }
        }
        numbered
    }

    /// What stands in a crowd on or in another thing.
    fn crowded(&self) -> BTreeSet<ReplicaId> {
        /// What is no higher, such as a carpet, holds nothing, cm.
        const FLAT: f64 = 10.0;
        let size = |b: &Bounds| (b.max.x - b.min.x) * (b.max.y - b.min.y);
        let mut crowds: BTreeMap<ReplicaId, Vec<ReplicaId>> = BTreeMap::new();
        for area in self.areas() {
            let things: Vec<&PlacedReplica> = self.scene.replicas_in(area.id).collect();
            let holders: Vec<_> = things.iter().filter(|t| t.top - t.bottom > FLAT).collect();
            for thing in &things {
                let middle = nalgebra::center(&thing.bounds.min, &thing.bounds.max);
                let holds = |h: &&&&PlacedReplica| {
                    h.id != thing.id
                        && h.bounds.contains(middle)
                        && size(&h.bounds) > 1.5 * size(&thing.bounds)
                };
                let holder = holders
                    .iter()
                    .filter(holds)
                    .min_by(|a, b| size(&a.bounds).total_cmp(&size(&b.bounds)));
                if let Some(holder) = holder {
                    crowds.entry(holder.id).or_default().push(thing.id);
                }
            }
        }
        crowds.into_values().filter(|crowd| crowd.len() >= CROWD).flatten().collect()
    }

    /// «23,5 м²»
    fn square_metres(&self, square_cm: f64) -> String {
        let metres = format!("{:.1}", square_cm / 1e4);
        self.language.pick(format!("{} м²", metres.replace('.', ",")), format!("{metres} m²"))
    }

    fn legend(&self, above: Bounds, pen: f64) -> Legend {
        let mut entries = Vec::new();
        let said = |russian: &str, english: &str| self.language.pick(russian, english).to_owned();
        if !self.places.is_empty() {
            entries.push(Entry::Dot(Style::fill(PLACE), said("место", "place")));
        }
        if !self.network.vertices.is_empty() {
            entries.push(Entry::Dot(VERTEX, said("сеть Пассфреймов", "Passframe network")));
        }
        if !self.network.doors.is_empty() {
            entries.push(Entry::Dot(Style::fill(DOORWAY), said("проём", "doorway")));
        }
        if self.route.start.is_some() || self.view.eye.is_some() {
            entries.push(Entry::Dot(ROBOT, said("робот", "robot")));
        }
        let mut entry = |style: Style, russian: &str, english: &str| {
            entries.push(Entry::Swatch(style, said(russian, english)));
        };
        let movable = |r: &PlacedReplica| self.world.replicas[&r.id].move_prob > 0;
        let overhead = |r: &PlacedReplica| r.bottom >= furniture::OVERHEAD;
        if self.things().any(|r| !movable(r) && !overhead(r)) {
            entry(furniture::FIXED, "мебель", "furniture");
        }
        if self.things().any(|r| movable(r) && !overhead(r)) {
            entry(furniture::MOVABLE, "подвижное", "movable");
        }
        if self.things().any(overhead) {
            entry(furniture::HANGING, "под потолком", "overhead");
        }
        if !self.floor.passframes.is_empty() {
            entry(PASSFRAME, "Пассфреймы", "Passframes");
        }
        if !self.floor.dead_zones.is_empty() {
            entry(DEAD_ZONE, "мёртвые зоны", "dead zones");
        }
        if !self.route.legs.is_empty() {
            entry(Style::fill("#1f5fbf"), "маршрут", "route");
        }
        if self.view.eye.is_some() {
            entry(SIGHT.outlined("#e07b00", 1.0), "видно", "in view");
        }
        if self.doors.iter().any(|d| d.status == DoorStatus::Locked) {
            entry(LOCKED, "заперто", "locked");
        }
        for (number, directive) in &self.route.directives {
            entries.push(Entry::Line(format!("{number}. {directive}")));
        }
        let at = Point::new(
            above.min.x + scale_bar_width(pen).max(220.0 * pen) + 30.0 * pen,
            above.min.y - 42.0 * pen,
        );
        let line_start = Point::new(above.min.x, at.y);
        Legend::new(entries, at, line_start, (above.max.x - at.x).max(350.0 * pen), pen)
    }
}

fn draw_door(canvas: &mut Canvas, door: &DoorGlyph, pen: f64) {
    if !door.arc.is_empty() {
        canvas.polyline(&door.arc, SWING.thick(pen));
    }
    let style = if door.status == DoorStatus::Locked { LOCKED } else { LEAF };
    canvas.polygon(&door.leaf, style.thick(pen), None);
}

/// How far ahead the drawn robot reaches: what is too small to be seen is drawn larger.
fn robot_reach(profile: &RobotProfile, pen: f64) -> f64 {
    let ahead = profile.footprint.iter().map(|p| p.x).reduce(f64::max);
    ahead.unwrap_or(profile.radius.get()).max(6.0 * pen)
}

fn robot(canvas: &mut Canvas, pose: Pose, profile: &RobotProfile, pen: f64) {
    let (sin, cos) = pose.heading.sin_cos();
    let at = |p: Point| pose.at + Vector::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos);
    let style = ROBOT.thick(pen);
    let nose = robot_reach(profile, pen);
    if profile.footprint.is_empty() {
        canvas.circle(pose.at, nose, style);
    } else {
        let outline = profile.footprint.iter().map(|&p| at(p)).collect();
        canvas.polygon(&Polygon::new(outline), style, None);
    }
    let style = Style::line("#1f5fbf", 2.5).thick(pen);
    canvas.segment(pose.at, at(Point::new(nose, 0.0)), style);
}
