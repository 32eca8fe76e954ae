//! The plan of a Map or of one Fragment (figs. 6, 9-12): rooms, windows, doors as architects draw them, furniture, free
//! floor, Passframes and their network, a route with its directives.

use std::collections::{BTreeMap, BTreeSet};

use crate::geometry::{
    Bounds, FloorPlan, PlacedArea, PlacedReplica, Polygon, Prism, Region, Scene,
};
use crate::map::{DoorStatus, Permeability, RobotProfile, World};
use crate::units::{
    AreaId, DoorId, Gather as _, InOrder as _, Language, Piece, PlaceId, Point, Pose, ReplicaId,
    Vector, told, word,
};

use super::canvas::{Anchor, Canvas, Lettering, Style};
use super::font::text_width;
use super::furniture;
use super::labels::{Ground, Labels, Slant, around};
use super::legend::{
    Entry, Legend, List, Sample, arrow_head, diamond, goal, scale_bar, scale_bar_width,
};
use super::rooms;
use super::zones::{self, ZoneGlyph};

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
                fragment.passframes().iter().map(|p| (p.id, p.polygon.centroid())).gather();
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
                        && let Some(doorway) = floor.doorway_at(fragment.area, doorway)
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
    /// Whether the way ends on this sheet.
    pub has_goal: bool,
}

/// A door leaf where it stands, and the way of its tip from shut to open, on to the hinge.
#[derive(Debug, Clone)]
pub struct DoorGlyph {
    pub leaf: Polygon,
    pub arc: Vec<Point>,
    pub status: DoorStatus,
    pub door: DoorId,
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
    pub places: Vec<(PlaceId, Point, String)>,
    pub zones: Vec<ZoneGlyph>,
    pub language: Language,
}

/// Where what stands below a plan begins, and how large the sheet is.
struct Layout {
    /// Of the rooms.
    extent: Bounds,
    /// Of the rooms and the leaves that swing out of them.
    whole: Bounds,
    /// Where names may stand.
    names: Bounds,
    sheet: Bounds,
    legend: Legend,
    list: List,
}

const LEAF: Style = Style::fill("#ffffff").outlined("#3b3a36", 1.2);
const LOCKED: Style = Style::fill("#b3261e").outlined("#3b3a36", 1.2);
const SWING: Style = Style::line("#8c887d", 0.9).dashed(3.0, 3.0);
const PASSFRAME: Style = Style::fill("#e4f1e3").outlined("#69a869", 0.9);
const DEAD_ZONE: Style = Style::fill("#e8a39b").faint(0.75);
const NETWORK: Style = Style::line("#7a4fa3", 1.3);
const THROUGH: Style = Style::line(DOORWAY, 1.6);
const VERTEX: Style = Style::fill("#7a4fa3");
const START: Style = Style::fill("#ffffff").outlined("#1f5fbf", 2.6);
const ROUTE: Style = Style::line("#1f5fbf", 4.0);
const BADGE: Style = Style::fill("#1f5fbf").outlined("#ffffff", 1.6);
const SIGHT: Style = Style::fill("#ffd766").faint(0.35);
const SEEN: Style = Style::line("#e07b00", 3.4);
/// From this pen on a sheet shows a large building: some twenty metres.
const LARGE: f64 = 1.5;
/// The smallest letter of a sheet, as a share of its longer side: 7 pixels of 1600, 2 mm on a sheet of A3.
const READABLE: f64 = 0.0045;
/// That letter, in pens: the name of a thing where it is set smallest.
const SMALLEST_LETTER: f64 = 8.0;
const HEADING: f64 = 18.0;
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
    ///
    /// Letters and lines grow with the building, but slower, so that a hospital's rooms keep their names, and never so
    /// slowly that the smallest letter is less than `READABLE` of the sheet.
    #[must_use]
    pub fn to_svg(&self) -> String {
        /// How often the pen is made broader; each time the sheet grows by less.
        const MOST: usize = 6;
        let rooms = self.areas().flat_map(|a| &a.prisms);
        let mut extent = rooms.fold(Bounds::EMPTY, |b, prism| b.union(&prism.bounds));
        if extent.min.x > extent.max.x {
            extent = Bounds::of([Point::origin()]).grown(100.0);
        }
        let mut pen = ((extent.max - extent.min).amax() / 1000.0).max(0.35).sqrt();
        let mut layout = self.layout(extent, pen);
        for _ in 0..MOST {
            let needed = (layout.sheet.max - layout.sheet.min).amax() * READABLE / SMALLEST_LETTER;
            if pen >= needed {
                break;
            }
            pen = needed * 1.02;
            layout = self.layout(extent, pen);
        }
        self.sheet(&layout, pen)
    }

    /// Where everything stands with letters and lines of this size.
    fn layout(&self, extent: Bounds, pen: f64) -> Layout {
        // A leaf that swings out of the rooms is shown whole, and what stands below the plan keeps clear of it.
        let shown = self.doors.iter().filter(|d| extent.meets(&d.leaf.bounds()));
        let leaves = shown.flat_map(|d| d.leaf.corners.iter().chain(&d.arc));
        let whole = extent.union(&Bounds::of(leaves.copied()));
        let legend = self.legend(extent, whole, pen);
        // Names are placed before the sheet's size is known, which hangs on how many are listed below the plan.
        let names = whole.grown(30.0 * pen);
        let numbered = self.labels(&mut Canvas::new(whole), names, pen);
        let mut sheet = whole.grown(34.0 * pen);
        let heading = self.heading().map_or(0.0, |text| text_width(text, HEADING, true) + 60.0);
        sheet.max.x = sheet.max.x.max(sheet.min.x + heading.max(640.0) * pen);
        sheet.max.x = sheet.max.x.max(legend.right() + 20.0 * pen);
        let list = Point::new(whole.min.x, whole.min.y - legend.height() - 24.0 * pen);
        let list = List::new(numbered, list, sheet.max.x - 20.0 * pen - whole.min.x, pen);
        sheet.max.x = sheet.max.x.max(list.right() + 20.0 * pen);
        sheet.min.y -= legend.height() + list.height() + 22.0 * pen;
        if self.heading().is_some() {
            sheet.max.y += 30.0 * pen;
        }
        Layout { whole, names, sheet, legend, list, extent }
    }

    fn sheet(&self, layout: &Layout, pen: f64) -> String {
        let Layout { whole, names, sheet, legend, list, extent } = layout;
        let width = sheet.max.x - sheet.min.x;
        let mut canvas = Canvas::new(*sheet).wide((width / pen).clamp(760.0, 4000.0));
        for area in self.areas() {
            rooms::floor(&mut canvas, self.world, area, pen);
        }
        self.floor(&mut canvas, pen);
        zones::draw(&mut canvas, &self.zones, pen);
        furniture::draw(&mut canvas, self.world, self.things(), pen);
        rooms::walls(&mut canvas, self.world, self.areas(), pen);
        for door in self.doors.iter().filter(|d| extent.meets(&d.leaf.bounds())) {
            draw_door(&mut canvas, door, pen);
        }
        self.network(&mut canvas, pen);
        self.view(&mut canvas, pen);
        self.route(&mut canvas, pen);
        self.labels(&mut canvas, *names, pen);
        zones::names(&mut canvas, &self.zones, pen);
        if let Some(heading) = self.heading() {
            let lettering = Lettering {
                anchor: Anchor::Start,
                halo: false,
                ..Lettering::bold(HEADING * pen, INK)
            };
            canvas.mark("heading");
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
        canvas.mark("passframe");
        for (cell, id) in &self.floor.passframes {
            let number = id.split(' ').next().unwrap_or_default();
            canvas.mark_of("passframe", format!("passframe-{number}"));
            canvas.polygon(cell, PASSFRAME.thick(pen), Some(id));
        }
        canvas.mark("dead-zone");
        for zone in &self.floor.dead_zones {
            canvas.polygons(zone.contours().map(|c| c.corners.as_slice()), DEAD_ZONE, None);
        }
    }

    fn network(&self, canvas: &mut Canvas, pen: f64) {
        canvas.mark("network");
        for edge in &self.network.edges {
            canvas.polyline(edge, NETWORK.thick(pen));
        }
        for [from, at, to] in &self.network.doors {
            canvas.mark("doorway-edge");
            canvas.polyline(&[*from, *at, *to], THROUGH.thick(pen));
            canvas.mark("doorway");
            canvas.polygon(&diamond(*at, 4.5 * pen), Style::fill(DOORWAY), None);
        }
        canvas.mark("vertex");
        for vertex in &self.network.vertices {
            canvas.circle(*vertex, 3.2 * pen, VERTEX);
        }
    }

    fn view(&self, canvas: &mut Canvas, pen: f64) {
        let Some(eye) = self.view.eye else { return };
        if self.view.fan.len() >= 2 {
            let mut outline = vec![eye.at];
            outline.extend(&self.view.fan);
            canvas.mark("sight");
            canvas.polygon(&Polygon::new(outline), SIGHT, None);
        }
        canvas.mark("seen");
        for &(a, b) in &self.view.seen {
            canvas.segment(a, b, SEEN.thick(pen));
        }
        robot(canvas, eye, &self.world.robot, pen);
    }

    fn route(&self, canvas: &mut Canvas, pen: f64) {
        // What is done without driving is a leg of one point.
        for (number, leg) in self.route.legs.iter().filter(|(_, leg)| leg.len() > 1) {
            canvas.mark_of("route", format!("leg-{number}"));
            canvas.polyline(leg, ROUTE.thick(pen));
            for head in arrows(leg, pen) {
                canvas.polygon(&head, Style::fill("#1f5fbf"), None);
            }
        }
        if let Some(end) = self.goal() {
            canvas.mark("goal");
            goal(canvas, end, pen);
        }
        match (self.route.start, self.route.legs.first().and_then(|(_, leg)| leg.first())) {
            (Some(pose), _) => robot(canvas, pose, &self.world.robot, pen),
            (None, Some(&first)) => {
                canvas.mark("start");
                canvas.circle(first, 5.5 * pen, START.thick(pen));
            }
            (None, None) => {}
        }
    }

    /// Where the way ends.
    fn goal(&self) -> Option<Point> {
        let end = || self.route.legs.iter().rev().find_map(|(_, leg)| leg.last()).copied();
        end().filter(|_| self.route.has_goal)
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
        canvas.mark("badge");
        // A way of one leg needs no number, and its goal stays in sight.
        if self.route.directives.is_empty() {
            return;
        }
        for (at, numbers) in badges {
            let numbers: Vec<String> = numbers.iter().map(usize::to_string).collect();
            let text = numbers.join(" · ");
            // At the goal the badge stands above its sign.
            let lifted = self.goal().is_some_and(|end| (end - at).norm() < 20.0 * pen);
            let at = if lifted { at + Vector::new(0.0, 20.0 * pen) } else { at };
            let wide = (text_width(&text, size, true) + 10.0 * pen).max(18.0 * pen);
            let frame = around(at, wide, 18.0 * pen);
            canvas.rectangle(frame, BADGE.thick(pen), 9.0 * pen);
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
        for (id, p, _) in &self.places {
            canvas.mark_of("place", format!("place-{}", id.0));
            canvas.circle(*p, 3.2 * pen, Style::fill(PLACE));
            labels.take(around(*p, 7.0 * pen, 7.0 * pen));
        }
        self.badges(canvas, &mut labels, pen);
        for pose in self.route.start.iter().chain(&self.view.eye) {
            let wide = 2.0 * robot_reach(&self.world.robot, pen);
            labels.take(around(pose.at, wide, wide));
        }
        if let Some(end) = self.goal() {
            labels.take(around(end, 20.0 * pen, 20.0 * pen));
        }
        canvas.mark("name");
        for (_, p, name) in &self.places {
            labels.beside(canvas, *p, name, Lettering::bold(12.0 * pen, PLACE));
        }
        let mut small_rooms = Vec::new();
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
            let style = Lettering::bold(20.0 * pen, INK);
            // Without its size rather than without its name; a closet in a large building bears a number.
            let is_named = labels.in_room(canvas, &prism.polygon, &furniture, name, &size, style)
                || labels.in_room(canvas, &prism.polygon, &furniture, name, "", style);
            if !is_named {
                small_rooms.push((prism, name));
            }
        }
        let mut numbered = Vec::new();
        for (prism, name) in small_rooms {
            let number = (numbered.len() + 1).to_string();
            let style = Lettering::bold(20.0 * pen, INK);
            if labels.in_room(canvas, &prism.polygon, &[], &number, "", style) {
                numbered.push(name.to_owned());
            }
        }
        let crowded = if pen < LARGE { self.crowded() } else { BTreeSet::new() };
        let mut things: Vec<_> = self.things().collect();
        let size = |b: &Bounds| (b.max.x - b.min.x) * (b.max.y - b.min.y);
        things.order_by(|a, b| size(&b.bounds).total_cmp(&size(&a.bounds)).then(a.id.cmp(&b.id)));
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
            return numbered;
        }
        let row = |b: &Bounds| (-b.max.y / (40.0 * pen)).floor();
        nameless.order_by(|(a, ..), (b, ..)| {
            let down = row(&a.bounds).total_cmp(&row(&b.bounds));
            let right = a.bounds.min.x.total_cmp(&b.bounds.min.x);
            a.area.cmp(&b.area).then(down).then(right).then(a.id.cmp(&b.id))
        });
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
        crowds.into_values().filter(|crowd| crowd.len() >= CROWD).flatten().gather()
    }

    /// «23,5 м²»
    fn square_metres(&self, square_cm: f64) -> String {
        let metres = format!("{:.1}", square_cm / 1e4);
        let number = self.language.pick(metres.replace('.', ","), metres);
        told!(self.language, "square-metres", number)
    }

    fn legend(&self, rooms: Bounds, above: Bounds, pen: f64) -> Legend {
        let mut entries = Vec::new();
        let mut entry = |is_shown: bool, sample: Sample, class: &'static str, words: Piece| {
            if is_shown {
                let text = words.say(self.language).into_owned();
                entries.push(Entry::Sign(sample, class, text));
            }
        };
        let dot = |style| Sample::Dot(style);
        let (network, route) = (&self.network, &self.route);
        entry(!self.places.is_empty(), dot(Style::fill(PLACE)), "key place", word!("place"));
        entry(!network.vertices.is_empty(), dot(VERTEX), "key vertex", word!("vertex"));
        entry(!network.edges.is_empty(), Sample::Stroke(NETWORK), "key network", word!("edge"));
        let has_doors = !network.doors.is_empty();
        entry(has_doors, Sample::Stroke(THROUGH), "key doorway-edge", word!("doorway-edge"));
        let diamond = Sample::Diamond(Style::fill(DOORWAY));
        entry(has_doors, diamond, "key doorway", word!("doorway"));
        let has_robot = route.start.is_some() || self.view.eye.is_some();
        entry(has_robot, dot(ROBOT), "key robot", word!("robot"));
        let has_way = route.legs.iter().any(|(_, leg)| leg.len() > 1);
        entry(has_way, Sample::Arrow(ROUTE), "key route", word!("route"));
        let has_start = !route.legs.is_empty() && route.start.is_none();
        entry(has_start, dot(START), "key start", word!("start"));
        entry(self.goal().is_some(), Sample::Goal, "key goal", word!("goal"));
        let has_badges = !route.directives.is_empty() && !route.legs.is_empty();
        entry(has_badges, dot(BADGE), "key badge", word!("badge"));
        for kind in furniture::Looseness::ALL {
            let (style, class) = kind.key();
            let words = match kind {
                furniture::Looseness::Fixed => word!("fixed"),
                furniture::Looseness::Movable => word!("movable"),
                furniture::Looseness::Portable => word!("portable"),
                furniture::Looseness::Overhead => word!("overhead"),
            };
            let is_shown = self.things().any(|r| furniture::Looseness::of(self.world, r) == kind);
            entry(is_shown, Sample::Fill(style), class, words);
        }
        let has_cells = !self.floor.passframes.is_empty();
        entry(has_cells, Sample::Fill(PASSFRAME), "key passframe", word!("passframe"));
        let has_dead = !self.floor.dead_zones.is_empty();
        entry(has_dead, Sample::Fill(DEAD_ZONE), "key dead-zone", word!("dead-zone"));
        let mut told = Vec::new();
        for zone in &self.zones {
            let (style, _, class, words) = zones::look(zone.kind);
            if !told.contains(&class) {
                told.push(class);
                entry(true, Sample::Fill(style), class, words);
            }
        }
        let has_eye = self.view.eye.is_some();
        let has_fan = has_eye && self.view.fan.len() >= 2;
        entry(has_fan, Sample::Fill(SIGHT), "key sight", word!("sight"));
        let has_seen = has_eye && !self.view.seen.is_empty();
        entry(has_seen, Sample::Stroke(SEEN), "key seen", word!("seen"));
        let marks = rooms::marks(self.world, self.areas());
        for (class, sample, words) in marks {
            entry(true, sample, class, words);
        }
        let is_shown = |d: &&DoorGlyph| rooms.meets(&d.leaf.bounds());
        let doors = || self.doors.iter().filter(is_shown);
        let status = |locked: bool| doors().any(|d| (d.status == DoorStatus::Locked) == locked);
        entry(status(false), Sample::Fill(LEAF), "key door", word!("door"));
        entry(
            doors().any(|d| !d.arc.is_empty()),
            Sample::Stroke(SWING),
            "key swing",
            word!("swing"),
        );
        entry(status(true), Sample::Fill(LOCKED), "key door locked", word!("locked"));
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

/// Heads of arrows along a way: on every stretch that is long enough for one, and about as far apart as it is long.
fn arrows(way: &[Point], pen: f64) -> Vec<Polygon> {
    let mut heads = Vec::new();
    let mut since = 40.0 * pen;
    for pair in way.windows(2) {
        let length = (pair[1] - pair[0]).norm();
        let mut at = (90.0 * pen - since).max(14.0 * pen);
        while at < length - 14.0 * pen {
            heads.push(arrow_head((pair[0], pair[1]), at / length, pen));
            since = -at;
            at += 90.0 * pen;
        }
        since += length;
    }
    // A short way has its direction all the same.
    if heads.is_empty()
        && let Some((a, b)) = way
            .windows(2)
            .map(|p| (p[0], p[1]))
            .max_by(|a, b| (a.1 - a.0).norm().total_cmp(&(b.1 - b.0).norm()))
    {
        heads.push(arrow_head((a, b), 0.5, pen));
    }
    heads
}

fn draw_door(canvas: &mut Canvas, door: &DoorGlyph, pen: f64) {
    if !door.arc.is_empty() {
        canvas.mark("swing");
        canvas.polyline(&door.arc, SWING.thick(pen));
    }
    let (style, class) = match door.status {
        DoorStatus::Locked => (LOCKED, "door locked"),
        DoorStatus::Open | DoorStatus::Closed => (LEAF, "door"),
    };
    canvas.mark_of(class, format!("door-{}", door.door.0));
    canvas.polygon(&door.leaf, style.thick(pen), None);
}

/// How far ahead the drawn robot reaches: what is too small to be seen is drawn larger.
fn robot_reach(profile: &RobotProfile, pen: f64) -> f64 {
    let ahead = profile.footprint.iter().map(|p| p.x).reduce(f64::max);
    ahead.unwrap_or(profile.radius.get()).max(6.0 * pen)
}

fn robot(canvas: &mut Canvas, pose: Pose, profile: &RobotProfile, pen: f64) {
    canvas.mark("robot");
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
