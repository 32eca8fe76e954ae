//! Corridor systems from Maps: lanes become corridors, their crossings junctions, their doors entrances.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crate::geometry::Openings;
use crate::map::World;
use crate::units::{Cm, Deg, Gather as _, InOrder as _, MapId, Point};

use super::CorridorError;
use super::lanes::{Lanes, Shape, find, unite};
use super::plan::{Doorstep, Plan};
use super::system::{
    CorridorSystem, Entrance, Junction, Port, Side, Stretch, Vertex, VertexIx, VertexKind,
};

impl CorridorSystem {
    /// The corridors of one Map.
    ///
    /// Lengths come from the centre lines; the weights are those of [`super::Weights::default`].
    ///
    /// # Errors
    /// [`CorridorError::UnknownMap`], [`CorridorError::NoCorridors`].
    pub fn from_map(
        world: &World,
        openings: &Openings,
        map: MapId,
        shape: &Shape,
    ) -> Result<Self, CorridorError> {
        let found = world.maps.get(&map).ok_or(CorridorError::UnknownMap { map: map.0 })?;
        let mut system = Self::from_maps(world, openings, &[map], shape, &found.name)?;
        system.name_en.clone_from(&found.name_en);
        Ok(system)
    }

    /// The corridors of every floor; vertices are numbered through.
    ///
    /// # Errors
    /// [`CorridorError::NoCorridors`].
    pub fn from_world(
        world: &World,
        openings: &Openings,
        shape: &Shape,
    ) -> Result<Self, CorridorError> {
        let maps: Vec<MapId> = world.maps.keys().copied().collect();
        let mut system = Self::from_maps(world, openings, &maps, shape, &world.domain.name)?;
        system.name_en.clone_from(&world.domain.name_en);
        Ok(system)
    }

    fn from_maps(
        world: &World,
        openings: &Openings,
        maps: &[MapId],
        shape: &Shape,
        name: &str,
    ) -> Result<Self, CorridorError> {
        let mut parts = Parts::default();
        for map in maps {
            let plan = Plan::of(world, openings, *map);
            parts.floor.clone_from(&world.maps[map].name);
            let mut floors: Vec<Floor> = plan
                .shapes
                .iter()
                .map(|floor| Floor::new(Lanes::of(floor, shape), *shape))
                .collect();
            for entrance in &plan.entrances {
                attach(&mut floors, entrance);
            }
            for floor in floors {
                parts.add(floor);
            }
        }
        if parts.vertices.is_empty() {
            return Err(CorridorError::NoCorridors { name: name.to_owned() });
        }
        let system = Self::assemble(name.to_owned(), parts.vertices, parts.stretches);
        Ok(system.renumbered())
    }

    /// Numbers the vertices as one would walk: from an end straight on, then the branches, as the paper does.
    fn renumbered(self) -> Self {
        let mut order: Vec<VertexIx> = Vec::new();
        let mut seen = BTreeSet::new();
        let mut ends: Vec<VertexIx> = self.vertices().map(|(v, _)| v).collect();
        ends.order_by_key(|&v| self.departures(v).count() > 1);
        for start in ends {
            let mut queue = VecDeque::from([(start, None)]);
            while let Some((mut vertex, mut arrived)) = queue.pop_front() {
                while seen.insert(vertex) {
                    order.push(vertex);
                    let mut ways = match arrived {
                        Some(arc) => self.successors(arc).into_iter().map(|(a, _)| a).collect(),
                        None => self.departures(vertex).collect::<Vec<_>>(),
                    }
                    .into_iter();
                    let Some(on) = ways.next() else { break };
                    queue.extend(ways.map(|arc| (self.head(arc).vertex, Some(arc))));
                    (vertex, arrived) = (self.head(on).vertex, Some(on));
                }
            }
        }
        let place: BTreeMap<VertexIx, usize> =
            order.iter().enumerate().map(|(at, &v)| (v, at)).gather();
        let vertices = order.iter().zip(0..).map(|(&v, number)| {
            let mut vertex = self.vertex(v).clone();
            vertex.number = number;
            vertex
        });
        let moved = |end: Port| Port { vertex: VertexIx(place[&end.vertex]), ..end };
        let stretches = self
            .stretches()
            .iter()
            .map(|s| Stretch { ends: s.ends.map(moved), length: s.length })
            .collect();
        Self::assemble(self.name.clone(), vertices.collect(), stretches)
    }
}

/// A part of a lane between two nodes, or from a node to the lane's end.
#[derive(Debug)]
struct Segment {
    lane: usize,
    /// Along the lane, rising.
    t: [f64; 2],
    nodes: [Option<usize>; 2],
    doors: Vec<Door>,
}

#[derive(Debug)]
struct Door {
    entrance: Entrance,
    t: f64,
    /// From the lane, to the left.
    offset: f64,
    ahead: bool,
}

/// One connected shape of floor: its lanes cut at the nodes where they meet.
#[derive(Debug)]
struct Floor {
    shape: Shape,
    lanes: Lanes,
    nodes: Vec<Point>,
    segments: Vec<Segment>,
    /// By lane: parameter and node, rising.
    stops: Vec<Vec<(f64, usize)>>,
}

impl Floor {
    fn new(lanes: Lanes, shape: Shape) -> Self {
        let (nodes, stops) = nodes_of(&lanes);
        let mut floor = Self { shape, lanes, nodes, segments: Vec::new(), stops };
        for lane in 0..floor.lanes.lanes.len() {
            floor.cut(lane);
        }
        floor
    }

    /// Cuts a lane at its nodes, and leaves out what has no walls of its own.
    fn cut(&mut self, at: usize) {
        let lane = &self.lanes.lanes[at];
        let stops = &self.stops[at];
        let half_width = |node: usize| self.breadth_at(node, at) / 2.0;
        let walled = |low: f64, high: f64| high.min(lane.walled[1]) - low.max(lane.walled[0]);
        let mut found = Vec::new();
        let mut add = |t: [f64; 2], nodes: [Option<usize>; 2]| {
            found.push(Segment { lane: at, t, nodes, doors: Vec::new() });
        };
        match (stops.first(), stops.last()) {
            (Some(&(first, a)), Some(&(last, b))) => {
                if walled(lane.reach[0], first - half_width(a)) > self.shape.arm {
                    add([lane.reach[0], first], [None, Some(a)]);
                }
                for pair in stops.windows(2) {
                    let [(low, a), (high, b)] = [pair[0], pair[1]];
                    if a != b && walled(low, high) > 10.0 {
                        add([low, high], [Some(a), Some(b)]);
                    }
                }
                if walled(last + half_width(b), lane.reach[1]) > self.shape.arm {
                    add([last, lane.reach[1]], [Some(b), None]);
                }
            }
            _ => add(lane.reach, [None, None]),
        }
        self.segments.extend(found);
    }

    /// The widest lane through a node, other than the given one.
    fn breadth_at(&self, node: usize, but: usize) -> f64 {
        let through = |lane: &usize| self.stops[*lane].iter().any(|(_, n)| *n == node);
        let others = (0..self.stops.len()).filter(|lane| *lane != but && through(lane));
        others.map(|lane| self.lanes.lanes[lane].width).fold(0.0, f64::max)
    }

    /// The segment ends at a node: segment and which of its ends.
    fn ends_at(&self, node: usize) -> Vec<(usize, usize)> {
        let mut ends = Vec::new();
        for (at, segment) in self.segments.iter().enumerate() {
            for end in [0, 1] {
                if segment.nodes[end] == Some(node) {
                    ends.push((at, end));
                }
            }
        }
        ends
    }

    /// The way in which a segment leaves its end.
    fn leaving(&self, (segment, end): (usize, usize)) -> Deg {
        let dir = self.lanes.lanes[self.segments[segment].lane].dir;
        let out = Deg::from_radians(dir.y.atan2(dir.x));
        if end == 0 { out } else { out + Deg::of(180.0) }
    }

    /// Where a doorway is best reached from: how far it is from there, the segment, the door.
    fn place(&self, entrance: &Doorstep) -> Option<(f64, usize, Door)> {
        self.ahead(entrance).or_else(|| self.beside(entrance)).or_else(|| self.nearby(entrance))
    }

    fn door(entrance: &Doorstep, t: f64, offset: f64, ahead: bool) -> Door {
        let side = match (ahead, offset > 0.0) {
            (true, _) => Side::Ahead,
            (false, true) => Side::Left,
            (false, false) => Side::Right,
        };
        let (room, room_en) = (entrance.room.clone(), entrance.room_en.clone());
        Door { entrance: Entrance { room, room_en, side }, t, offset, ahead }
    }

    /// In the end wall of a dead end.
    fn ahead(&self, entrance: &Doorstep) -> Option<(f64, usize, Door)> {
        let fits = |(at, segment): (usize, &Segment), end: usize| {
            let lane = &self.lanes.lanes[segment.lane];
            let outward = if end == 0 { -lane.dir } else { lane.dir };
            let (t, offset) = lane.locate(entrance.at);
            let away = (t - segment.t[end]).abs();
            let fits = segment.nodes[end].is_none()
                && entrance.inward.dot(&-outward) >= self.shape.askew.to_radians().cos()
                && offset.abs() <= self.shape.aside * lane.width
                && away <= self.shape.ahead;
            let door = Self::door(entrance, segment.t[end], offset, true);
            fits.then_some((away + offset.abs(), at, door))
        };
        let all = self.segments.iter().enumerate();
        all.flat_map(|s| [fits(s, 0), fits(s, 1)]).flatten().min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// In a side wall: straight across from the doorway runs the lane.
    fn beside(&self, entrance: &Doorstep) -> Option<(f64, usize, Door)> {
        let from = entrance.at + entrance.inward * 2.0;
        let free = self.lanes.free_way(from, entrance.inward);
        if !free.is_finite() {
            return None;
        }
        let hit = |(at, lane): (usize, &super::lanes::Lane)| {
            let turn = entrance.inward.perp(&lane.dir);
            if turn.abs() < 0.5 {
                return None;
            }
            let to = lane.origin - from;
            let (r, t) = (to.perp(&lane.dir) / turn, to.perp(&entrance.inward) / turn);
            let holds = r > -3.0 && r <= free + 1.0;
            (holds && t >= lane.reach[0] - 1.0 && t <= lane.reach[1] + 1.0).then_some((r, at, t))
        };
        let lanes = self.lanes.lanes.iter().enumerate();
        let (r, lane, t) = lanes.filter_map(hit).min_by(|a, b| a.0.total_cmp(&b.0))?;
        let segment = self.segment_near(lane, t)?;
        let (_, offset) = self.lanes.lanes[lane].locate(entrance.at);
        Some((r, segment, self.door_on(segment, entrance, lane, t, offset)))
    }

    /// Anywhere else: the nearest segment of the shape, when it is not far.
    fn nearby(&self, entrance: &Doorstep) -> Option<(f64, usize, Door)> {
        let distance = |(at, segment): (usize, &Segment)| {
            let lane = &self.lanes.lanes[segment.lane];
            let (t, offset) = lane.locate(entrance.at);
            let t = t.clamp(segment.t[0], segment.t[1]);
            let away = (lane.at(t) - entrance.at).norm();
            (away < 2.0 * lane.width).then(|| (away, at, Self::door(entrance, t, offset, false)))
        };
        let all = self.segments.iter().enumerate();
        all.filter_map(distance).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// A door on a segment that may belong to another lane than the one across from the door.
    fn door_on(
        &self,
        segment: usize,
        entrance: &Doorstep,
        lane: usize,
        t: f64,
        offset: f64,
    ) -> Door {
        let found = &self.segments[segment];
        if found.lane == lane {
            return Self::door(entrance, t.clamp(found.t[0], found.t[1]), offset, false);
        }
        let (t, offset) = self.lanes.lanes[found.lane].locate(entrance.at);
        Self::door(entrance, t.clamp(found.t[0], found.t[1]), offset, false)
    }

    /// The segment of a lane at a parameter; where the lane was cut away, a segment at the next node.
    fn segment_near(&self, lane: usize, t: f64) -> Option<usize> {
        let gap = |s: &Segment| (s.t[0] - t).max(t - s.t[1]).max(0.0);
        let own = self.segments.iter().enumerate().filter(|(_, s)| s.lane == lane);
        if let Some((at, _)) = own.min_by(|a, b| gap(a.1).total_cmp(&gap(b.1))) {
            return Some(at);
        }
        let near =
            self.stops[lane].iter().min_by(|a, b| (a.0 - t).abs().total_cmp(&(b.0 - t).abs()));
        self.ends_at(near?.1).first().map(|(at, _)| *at)
    }
}

/// The places where lanes meet; meetings nearer than half a corridor's width are one place.
fn nodes_of(lanes: &Lanes) -> (Vec<Point>, Vec<Vec<(f64, usize)>>) {
    let points: Vec<Point> =
        lanes.meetings.iter().map(|m| lanes.lanes[m.lanes[0]].at(m.t[0])).collect();
    let width = |m: usize| {
        let [a, b] = lanes.meetings[m].lanes;
        lanes.lanes[a].width.min(lanes.lanes[b].width)
    };
    let mut group: Vec<usize> = (0..points.len()).collect();
    for a in 0..points.len() {
        for b in a + 1..points.len() {
            if (points[a] - points[b]).norm() < 0.45 * width(a).min(width(b)) {
                unite(&mut group, a, b);
            }
        }
    }
    let mut stops = vec![Vec::new(); lanes.lanes.len()];
    for (at, meeting) in lanes.meetings.iter().enumerate() {
        for side in [0, 1] {
            stops[meeting.lanes[side]].push((meeting.t[side], find(&group, at)));
        }
    }
    for lane in &mut stops {
        lane.order_by(|a, b| a.0.total_cmp(&b.0));
    }
    (points, stops)
}

/// Puts an entrance on the shape whose lane is nearest.
fn attach(floors: &mut [Floor], entrance: &Doorstep) {
    let places =
        floors.iter().enumerate().filter_map(|(at, floor)| Some((at, floor.place(entrance)?)));
    let inside = |floor: &Floor| {
        let walls = &floor.lanes.walls;
        let on = |w: &super::lanes::Wall| {
            (entrance.at - crate::geometry::nearest_on_segment(entrance.at, w.a, w.b)).norm()
        };
        walls.iter().map(on).fold(f64::INFINITY, f64::min)
    };
    let best: Option<(usize, (f64, usize, Door))> = places.min_by(|(a, x), (b, y)| {
        let wall = |f: usize| inside(&floors[f]).round();
        wall(*a).total_cmp(&wall(*b)).then(x.0.total_cmp(&y.0))
    });
    if let Some((floor, (_, segment, door))) = best {
        floors[floor].segments[segment].doors.push(door);
    }
}

/// By node: its vertex, and the segment ends that are its arms.
type Junctions = BTreeMap<usize, (VertexIx, Vec<(usize, usize)>)>;

/// Vertices and stretches gathered from all floors.
#[derive(Debug, Default)]
struct Parts {
    floor: String,
    vertices: Vec<Vertex>,
    stretches: Vec<Stretch>,
}

/// One way along a corridor, from junction or end to junction or end, through bends.
struct Walk {
    /// Segment and the end at which it is entered.
    along: Vec<(usize, usize)>,
    closed: bool,
}

impl Parts {
    fn add(&mut self, mut floor: Floor) {
        floor.segments.iter_mut().for_each(order_doors);
        let mut junctions = BTreeMap::new();
        for node in 0..floor.nodes.len() {
            let ends = floor.ends_at(node);
            if !goes_through(&floor, &ends) {
                junctions.insert(node, self.junction(&floor, node, &ends));
            }
        }
        for walk in walks(&floor, &junctions) {
            self.corridor(&floor, &walk, &junctions);
        }
    }

    /// A vertex for a node, with the order of its arms.
    fn junction(
        &mut self,
        floor: &Floor,
        node: usize,
        ends: &[(usize, usize)],
    ) -> (VertexIx, Vec<(usize, usize)>) {
        let at = floor.nodes[node];
        let arms = ends.iter().map(|&end| floor.leaving(end)).collect();
        let vertex = self.vertex(VertexKind::Junction(Junction { arms }), at);
        (vertex, ends.to_vec())
    }

    fn vertex(&mut self, kind: VertexKind, at: Point) -> VertexIx {
        let number = self.vertices.len() as u32;
        self.vertices.push(Vertex { number, kind, floor: self.floor.clone(), at: Some(at) });
        VertexIx(self.vertices.len() - 1)
    }

    fn corridor(&mut self, floor: &Floor, walk: &Walk, junctions: &Junctions) {
        let port_at = |end: (usize, usize)| {
            let node = floor.segments[end.0].nodes[end.1]?;
            let (vertex, ends) = junctions.get(&node)?;
            Some(Port { vertex: *vertex, port: ends.iter().position(|e| *e == end)? })
        };
        let (mut driven, mut last) = (0.0, None);
        let mut first: Option<(Port, f64)> = None;
        if let Some(port) = port_at(walk.along[0]) {
            last = Some((port, 0.0));
        }
        for &(at, entered) in &walk.along {
            let segment = &floor.segments[at];
            let lane = &floor.lanes.lanes[segment.lane];
            let mut doors: Vec<&Door> = segment.doors.iter().collect();
            if entered == 1 {
                doors.reverse();
            }
            for door in doors {
                let mut entrance = door.entrance.clone();
                if entered == 1 {
                    entrance.side = entrance.side.opposite();
                }
                let here = driven + (door.t - segment.t[entered]).abs();
                let vertex = self.vertex(VertexKind::Entrance(entrance), lane.at(door.t));
                self.stretch(last, Port { vertex, port: 0 }, here);
                first.get_or_insert((Port { vertex, port: 0 }, here));
                last = Some((Port { vertex, port: 1 }, here));
            }
            driven += segment.t[1] - segment.t[0];
        }
        let (end, entered) = *walk.along.last().expect("a walk has a segment");
        if let Some(port) = port_at((end, 1 - entered)) {
            self.stretch(last, port, driven);
        } else if walk.closed
            && let Some((port, here)) = first
            && last.is_some_and(|(l, _)| l.vertex != port.vertex)
        {
            self.stretch(last, port, driven + here);
        }
    }

    fn stretch(&mut self, from: Option<(Port, f64)>, to: Port, here: f64) {
        if let Some((port, there)) = from {
            let length = Some(Cm::of(here - there));
            self.stretches.push(Stretch { ends: [port, to], length });
        }
    }
}

/// Orders the doors of a segment; of several doors in one end wall only the middle one is straight ahead.
fn order_doors(segment: &mut Segment) {
    for end in segment.t {
        let in_end = |d: &Door| d.ahead && (d.t - end).abs() < 1.0;
        let middle = segment.doors.iter().filter(|d| in_end(d)).map(|d| d.offset.abs());
        let middle = middle.fold(f64::INFINITY, f64::min);
        let mut kept = false;
        for door in segment.doors.iter_mut().filter(|d| in_end(d)) {
            if !kept && door.offset.abs() <= middle {
                kept = true;
                continue;
            }
            door.ahead = false;
            door.entrance.side = if door.offset > 0.0 { Side::Left } else { Side::Right };
        }
    }
    let inner = |d: &Door| {
        let low = (d.t - segment.t[0]).abs() < (d.t - segment.t[1]).abs();
        // The door ahead is the last one, at whichever end it is.
        match (d.ahead, low) {
            (false, _) => 0,
            (true, true) => -1,
            (true, false) => 1,
        }
    };
    segment.doors.order_by(|a, b| {
        inner(a)
            .cmp(&inner(b))
            .then(a.t.total_cmp(&b.t))
            .then(a.offset.total_cmp(&b.offset))
            .then_with(|| a.entrance.room.cmp(&b.entrance.room))
    });
}

/// Whether a node is no junction: nothing, an end, or a mere bend.
fn goes_through(floor: &Floor, ends: &[(usize, usize)]) -> bool {
    match *ends {
        [a, b] => (floor.leaving(a) - floor.leaving(b)).signed().abs() >= 180.0 - floor.shape.bend,
        ref others => others.len() < 2,
    }
}

/// Cuts the segments into walks; each segment is in one of them.
fn walks(floor: &Floor, junctions: &Junctions) -> Vec<Walk> {
    let mut walked = BTreeSet::new();
    let mut found = Vec::new();
    // The end of another segment at which a corridor goes on.
    let continuation = |(segment, end): (usize, usize)| {
        let node = floor.segments[segment].nodes[end].filter(|n| !junctions.contains_key(n))?;
        floor.ends_at(node).into_iter().find(|other| *other != (segment, end))
    };
    let follow = |start: (usize, usize), walked: &mut BTreeSet<usize>| {
        let mut along = vec![start];
        walked.insert(start.0);
        while let Some(next) =
            continuation((along[along.len() - 1].0, 1 - along[along.len() - 1].1))
        {
            if !walked.insert(next.0) {
                break;
            }
            along.push(next);
        }
        along
    };
    for closed in [false, true] {
        for segment in 0..floor.segments.len() {
            for end in [0, 1] {
                if walked.contains(&segment) || (!closed && continuation((segment, end)).is_some())
                {
                    continue;
                }
                found.push(Walk { along: follow((segment, end), &mut walked), closed });
            }
        }
    }
    found
}
