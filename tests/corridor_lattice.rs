//! Random corridor systems on a lattice: a follower that only counts entrances and junctions must arrive.
//!
//! The lattice is the world itself; the descriptions, as a file and as a Map, are made from it. The follower
//! walks on the lattice and knows nothing of the road graphs.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::fmt::Write as _;

use orthoframe_corridor::{
    Command, CorridorSystem, DoubleGraph, JunctionKind, Position, Shape, Side, SingleGraph, Turn,
    VertexIx,
};
use orthoframe_geometry::{Openings, STEP_REACH};
use orthoframe_map::{Permeability, World};
use orthoframe_units::{MapId, Point, Source};
use proptest::prelude::*;

use crate::corridor_floors::{Builder, Gap, WAYS, empty_world, placed};

const STEP: i32 = 1000;
const WIDTH: i32 = 200;
/// Everything stands on multiples of this.
const GRID: i32 = 100;

type Node = (i32, i32);

#[derive(Debug, Clone, PartialEq)]
struct Door {
    room: String,
    /// East or north of the edge's first node, in cm.
    at: i32,
    /// On the left for one who goes east or north.
    left: bool,
}

/// Corridors between neighbouring nodes of a grid.
#[derive(Debug, Clone, Default)]
struct Lattice {
    /// By first node and way (0 east, 1 north).
    edges: BTreeMap<(Node, usize), Vec<Door>>,
    /// Doors in the end wall of dead ends.
    ends: BTreeMap<Node, String>,
}

/// What the follower meets next.
#[derive(Debug, Clone, PartialEq)]
enum Thing {
    Door { room: String, side: Side },
    Junction(JunctionKind),
}

/// Where the follower stands, in cm, and which way it faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Stand {
    at: (i32, i32),
    way: usize,
}

impl Lattice {
    fn opens(&self, node: Node, way: usize) -> bool {
        let (dx, dy) = WAYS[way];
        match way {
            0 | 1 => self.edges.contains_key(&(node, way)),
            _ => self.edges.contains_key(&((node.0 + dx, node.1 + dy), way - 2)),
        }
    }

    fn ways(&self, node: Node) -> Vec<usize> {
        (0..4).filter(|w| self.opens(node, *w)).collect()
    }

    fn nodes(&self) -> BTreeSet<Node> {
        let both = |&((x, y), way): &(Node, usize)| [(x, y), (x + WAYS[way].0, y + WAYS[way].1)];
        self.edges.keys().flat_map(both).collect()
    }

    fn is_junction(&self, node: Node) -> bool {
        match *self.ways(node) {
            [a, b] => b - a != 2,
            ref ways => ways.len() > 2,
        }
    }

    /// The junction as it looks to one who comes to it.
    fn kind(&self, node: Node, way: usize) -> JunctionKind {
        let open = |turn: usize| self.opens(node, (way + turn) % 4);
        match (open(0), open(3), open(1)) {
            (true, true, true) => JunctionKind::Crossing,
            (false, true, true) => JunctionKind::Tee,
            (true, true, false) => JunctionKind::BranchRight,
            (true, false, true) => JunctionKind::BranchLeft,
            (false, true, false) => JunctionKind::TurnRight,
            (false, false, true) => JunctionKind::TurnLeft,
            (_, false, false) => panic!("no junction"),
        }
    }

    /// Everything that stands along the lattice, with its place.
    fn things(&self) -> Vec<((i32, i32), Option<String>)> {
        let mut things = Vec::new();
        for (&((x, y), way), doors) in &self.edges {
            for door in doors {
                let (dx, dy) = WAYS[way];
                let at = (x * STEP + dx * door.at, y * STEP + dy * door.at);
                things.push((at, Some(door.room.clone())));
            }
        }
        for node in self.nodes() {
            let at = (node.0 * STEP, node.1 * STEP);
            if self.is_junction(node) {
                things.push((at, None));
            } else if let Some(room) = self.ends.get(&node) {
                things.push((self.end_wall(node), Some(room.clone())));
            }
        }
        things
    }

    /// Middle of a dead end's end wall.
    fn end_wall(&self, node: Node) -> (i32, i32) {
        let (dx, dy) = WAYS[self.ways(node)[0]];
        (node.0 * STEP - dx * WIDTH / 2, node.1 * STEP - dy * WIDTH / 2)
    }

    /// The next thing on the way, and where it is.
    fn next(&self, stand: Stand) -> Option<(Thing, (i32, i32))> {
        let (dx, dy) = WAYS[stand.way];
        let mut at = stand.at;
        let forward = stand.way < 2;
        loop {
            at = (at.0 + dx * GRID, at.1 + dy * GRID);
            let on_node = at.0 % STEP == 0 && at.1 % STEP == 0;
            let node = (at.0.div_euclid(STEP), at.1.div_euclid(STEP));
            if on_node {
                if self.is_junction(node) {
                    return Some((Thing::Junction(self.kind(node, stand.way)), at));
                }
                if !self.opens(node, stand.way) {
                    let room = self.ends.get(&node)?.clone();
                    return Some((Thing::Door { room, side: Side::Ahead }, self.end_wall(node)));
                }
                continue;
            }
            let along = if dx == 0 { at.1.rem_euclid(STEP) } else { at.0.rem_euclid(STEP) };
            // Out of an end wall the node's own square comes first, where no edge is.
            let Some(doors) = self.edges.get(&(node, stand.way % 2)) else { continue };
            if let Some(door) = doors.iter().find(|d| d.at == along) {
                let side = if door.left == forward { Side::Left } else { Side::Right };
                return Some((Thing::Door { room: door.room.clone(), side }, at));
            }
        }
    }

    /// Executes commands by counting what is seen; gives the place where they end.
    fn follow(&self, mut stand: Stand, commands: &[Command]) -> Stand {
        for command in commands {
            match *command {
                Command::UTurn => stand.way = (stand.way + 2) % 4,
                Command::Face(side) => stand.way = self.facing(stand.at, side),
                Command::Take(turn) => {
                    stand.way = (stand.way + [0, 3, 1][usize::from(turn.code())]) % 4;
                    let node = (stand.at.0 / STEP, stand.at.1 / STEP);
                    assert!(self.opens(node, stand.way), "no corridor that way: {stand:?}");
                }
                Command::ToDoor(wanted) => {
                    let (thing, at) = self.next(stand).expect("a door, not a blank wall");
                    assert!(
                        matches!(thing, Thing::Door { side, .. } if side == wanted),
                        "{thing:?}"
                    );
                    stand.at = at;
                }
                Command::ToJunction(wanted) => {
                    let (thing, at) = self.next(stand).expect("a junction, not a blank wall");
                    assert_eq!(thing, Thing::Junction(wanted));
                    stand.at = at;
                }
            }
        }
        stand
    }

    fn facing(&self, at: (i32, i32), side: Side) -> usize {
        if side == Side::Ahead {
            let node = *self.ends.keys().find(|n| self.end_wall(**n) == at).unwrap();
            return self.ways(node)[0];
        }
        let sees = |way: usize| {
            let back = Stand { at: (at.0 - WAYS[way].0 * GRID, at.1 - WAYS[way].1 * GRID), way };
            matches!(self.next(back), Some((Thing::Door { side: seen, .. }, _)) if seen == side)
        };
        (0..4).find(|&way| self.passes(at, way) && sees(way)).expect("one way has the door there")
    }

    /// Whether a door stands on an edge that runs this way.
    fn passes(&self, at: (i32, i32), way: usize) -> bool {
        let across = if way.is_multiple_of(2) { at.1 } else { at.0 };
        across % STEP == 0
    }

    /// Fewest arcs and U-turns, by breadth-first search over stands.
    fn distance(&self, from: Stand, goal: (i32, i32)) -> Option<usize> {
        let mut queue = VecDeque::from([(from, 0)]);
        let mut seen = BTreeSet::from([from]);
        while let Some((stand, cost)) = queue.pop_front() {
            let node = (stand.at.0.div_euclid(STEP), stand.at.1.div_euclid(STEP));
            let at_junction = stand.at.0 % STEP == 0 && stand.at.1 % STEP == 0;
            if stand.at == goal {
                return Some(cost);
            }
            let mut on = Vec::new();
            if at_junction {
                on.extend((0..4).filter(|w| *w != (stand.way + 2) % 4 && self.opens(node, *w)));
            } else {
                on.push(stand.way);
                let turned = Stand { way: (stand.way + 2) % 4, ..stand };
                if seen.insert(turned) {
                    queue.push_back((turned, cost + 1));
                }
            }
            let at_end = self
                .ends
                .keys()
                .any(|n| self.end_wall(*n) == stand.at && self.ways(*n)[0] != stand.way);
            for way in on.into_iter().filter(|_| !at_end) {
                if let Some((_, at)) = self.next(Stand { way, ..stand }) {
                    let next = Stand { at, way };
                    if seen.insert(next) {
                        queue.push_back((next, cost + 1));
                    }
                }
            }
        }
        None
    }
}

/// A lattice of `columns` × `rows` nodes; each corridor is there or not, with doors here and there.
fn lattices() -> impl Strategy<Value = Lattice> {
    let door = (0..7_i32, any::<bool>());
    let edge = proptest::option::weighted(0.6, proptest::collection::vec(door, 0..3));
    (proptest::collection::vec(edge, 17), proptest::collection::vec(any::<bool>(), 16)).prop_map(
        |(edges, ends)| {
            let mut lattice = Lattice::default();
            let places = (0..4).flat_map(|x| (0..3).flat_map(move |y| [((x, y), 0), ((x, y), 1)]));
            let fits = |&((x, y), way): &(Node, usize)| if way == 0 { x < 3 } else { y < 2 };
            let mut rooms = 0;
            for (place, doors) in places.filter(fits).zip(edges) {
                let Some(doors) = doors else { continue };
                let mut stand = BTreeMap::new();
                for (slot, left) in doors {
                    rooms += 1;
                    let at = 200 + 100 * slot;
                    stand.insert(at, Door { room: format!("К{rooms}"), at, left });
                }
                lattice.edges.insert(place, stand.into_values().collect());
            }
            let dead: Vec<Node> =
                lattice.nodes().into_iter().filter(|n| lattice.ways(*n).len() == 1).collect();
            for (node, _) in dead.into_iter().zip(ends).filter(|(_, end)| *end) {
                rooms += 1;
                lattice.ends.insert(node, format!("К{rooms}"));
            }
            lattice
        },
    )
}

/// The lattice as a corridor file: a corridor from junction to junction or dead end.
fn as_file(lattice: &Lattice) -> (String, BTreeMap<u32, (i32, i32)>) {
    let places: Vec<(i32, i32)> = lattice.things().into_iter().map(|(at, _)| at).collect();
    let number = |at: (i32, i32)| places.iter().position(|p| *p == at).unwrap();
    let mut text = String::from("format = 1\n");
    let mut declared = BTreeSet::new();
    let mut done = BTreeSet::new();
    let starts = lattice
        .nodes()
        .into_iter()
        .filter(|n| lattice.is_junction(*n) || lattice.ways(*n).len() == 1);
    for node in starts {
        for way in lattice.ways(node) {
            let at = (node.0 * STEP, node.1 * STEP);
            let mut stops = Vec::new();
            let mut stand = Stand { at, way };
            let back = (way + 2) % 4;
            if lattice.is_junction(node) {
                stops.push((at, Thing::Junction(lattice.kind(node, back)), back));
            } else if let Some(room) = lattice.ends.get(&node) {
                stand.at = lattice.end_wall(node);
                let door = Thing::Door { room: room.clone(), side: Side::Ahead };
                stops.push((stand.at, door, way));
            }
            while let Some((thing, next)) = lattice.next(stand) {
                stand.at = next;
                let stop =
                    matches!(thing, Thing::Junction(_) | Thing::Door { side: Side::Ahead, .. });
                stops.push((next, thing, way));
                if stop {
                    break;
                }
            }
            let key: BTreeSet<_> = stops.iter().map(|s| s.0).collect();
            let single_junction = stops.len() == 1 && matches!(stops[0].1, Thing::Junction(_));
            if stops.is_empty() || single_junction || !done.insert(key) {
                continue;
            }
            text.push_str("[[corridor]]\nalong = [\n");
            for (at, thing, way) in &stops {
                write!(text, "  {{ vertex = {}", number(*at)).unwrap();
                match thing {
                    Thing::Door { room, side } => {
                        let side = ["right", "left", "ahead"][*side as usize];
                        write!(text, ", room = \"{room}\", side = \"{side}\"").unwrap();
                    }
                    Thing::Junction(kind) if declared.insert(*at) => {
                        text.push_str(&junction_fields(lattice, *at, *way, *kind, &number));
                    }
                    Thing::Junction(_) => {}
                }
                text.push_str(" },\n");
            }
            text.push_str("]\n");
        }
    }
    (text, places.iter().copied().enumerate().map(|(i, at)| (i as u32, at)).collect())
}

fn junction_fields(
    lattice: &Lattice,
    at: (i32, i32),
    way: usize,
    kind: JunctionKind,
    number: &dyn Fn((i32, i32)) -> usize,
) -> String {
    let word = ["crossing", "tee", "branch-right", "branch-left", "turn-right", "turn-left"];
    let mut text = format!(", junction = \"{}\"", word[usize::from(kind.code()) - 1]);
    let mut blind = Vec::new();
    for turn in kind.ways().iter() {
        let name = ["straight", "right", "left"][usize::from(turn.code())];
        let on = (way + [0, 3, 1][usize::from(turn.code())]) % 4;
        match lattice.next(Stand { at, way: on }) {
            Some((_, next)) => write!(text, ", {name} = {}", number(next)).unwrap(),
            None => blind.push(format!("\"{name}\"")),
        }
    }
    write!(text, ", blind = [{}]", blind.join(", ")).unwrap();
    text
}

/// Every state and goal: both variants alike, the follower arrives, and no shorter way exists.
fn check_all_pairs(
    lattice: &Lattice,
    system: &CorridorSystem,
    place: &dyn Fn(u32) -> (i32, i32),
) -> Result<(), TestCaseError> {
    system.check_invariants();
    let (single, double) = (SingleGraph::new(system).unwrap(), DoubleGraph::new(system).unwrap());
    let number = |v| system.vertex(v).number;
    let goals: Vec<VertexIx> =
        system.vertices().filter(|(_, v)| v.entrance().is_some()).map(|(v, _)| v).collect();
    for arc in system.arcs() {
        let vertex = system.head(arc).vertex;
        if system.vertex(vertex).entrance().is_none() {
            continue;
        }
        let (from, to) = (place(number(system.tail(arc).vertex)), place(number(vertex)));
        let step = ((to.0 - from.0).signum(), (to.1 - from.1).signum());
        let way = WAYS.iter().position(|w| *w == step).expect("neighbours are in one line");
        let stand = Stand { at: to, way };
        for &goal in goals.iter().filter(|goal| **goal != vertex) {
            let shortest = lattice.distance(stand, place(number(goal)));
            for last in [Some(arc), None] {
                let position = Position { vertex, last };
                let one = single.way(position, &[goal]);
                let two = double.way(position, &[goal]).unwrap();
                let (Some(one), Some(two)) = (&one, &two) else {
                    prop_assert!(one.is_none() && two.is_none());
                    prop_assert_eq!(shortest, None);
                    continue;
                };
                prop_assert_eq!(&one.commands, &two.commands);
                prop_assert_eq!((one.cost, one.arrived_by), (two.cost, two.arrived_by));
                let end = lattice.follow(stand, &one.commands);
                prop_assert_eq!(end.at, place(number(goal)));
                if last.is_some() {
                    prop_assert_eq!(Some(one.cost as usize / 10_000), shortest);
                }
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, max_shrink_iters: 300, ..ProptestConfig::default() })]

    #[test]
    fn followers_arrive_by_the_file(lattice in lattices()) {
        let (text, places) = as_file(&lattice);
        if !text.contains("corridor") {
            return Ok(());
        }
        let system = CorridorSystem::from_toml(&Source::new("random.toml", &text))
            .map_err(|e| TestCaseError::fail(format!("{e}\n{text}")))?;
        check_all_pairs(&lattice, &system, &|number| places[&number])?;
    }

    #[test]
    fn followers_arrive_by_the_map(
        lattice in lattices(),
        turned in prop_oneof![Just(0.0), Just(90.0), 0.0..360.0_f64],
        wall in prop_oneof![Just(0), Just(15)],
        apart in any::<bool>(),
    ) {
        let world = as_world(&lattice, turned, wall, apart);
        let openings = Openings::of(&world, STEP_REACH);
        let Ok(system) = CorridorSystem::from_map(&world, &openings, MapId(1), &Shape::default()) else {
            prop_assert!(lattice.edges.is_empty());
            return Ok(());
        };
        let doors = lattice.edges.values().flatten().count() + lattice.ends.len();
        let found = system.vertices().filter(|(_, v)| v.entrance().is_some()).count();
        prop_assert_eq!(found, doors);
        let frame = placed(turned);
        let things = lattice.things();
        let place = |number: u32| {
            let at = frame.invert(system.vertex(system.numbered(number).unwrap()).at.unwrap());
            let near = things.iter().min_by(|a, b| {
                let away = |t: (i32, i32)| (Point::new(f64::from(t.0), f64::from(t.1)) - at).norm();
                away(a.0).total_cmp(&away(b.0))
            });
            near.unwrap().0
        };
        check_all_pairs(&lattice, &system, &place)?;
    }
}

/// The lattice as a Map: squares at the nodes, rectangles between them, in one Area or each in its own.
fn as_world(lattice: &Lattice, turned: f64, wall: i32, apart: bool) -> World {
    let mut builder = Builder { world: empty_world(), frame: placed(turned) };
    let half = WIDTH / 2;
    let whole = (!apart).then(|| builder.area("Коридор", true));
    for node in lattice.nodes() {
        let (x, y) = (node.0 * STEP, node.1 * STEP);
        let area = whole.unwrap_or_else(|| builder.area(&format!("Узел {node:?}"), true));
        // Sides in the order of `Gap`, ways in the order of WAYS.
        let side = [1, 2, 3, 0];
        let mut gaps: Vec<Gap> = lattice
            .ways(node)
            .into_iter()
            .map(|w| {
                (side[w], if w.is_multiple_of(2) { y } else { x }, WIDTH, Permeability::Permeable)
            })
            .collect();
        if let Some(room) = lattice.ends.get(&node) {
            let out = (lattice.ways(node)[0] + 2) % 4;
            gaps.push((
                side[out],
                if out.is_multiple_of(2) { y } else { x },
                80,
                Permeability::Conditional,
            ));
            builder.room(room, lattice.end_wall(node), out, wall);
        }
        builder.rectangle(area, [x - half, y - half, x + half, y + half], &gaps);
    }
    for (&((nx, ny), way), doors) in &lattice.edges {
        let (x, y) = (nx * STEP, ny * STEP);
        let area = whole.unwrap_or_else(|| builder.area(&format!("Ход {nx} {ny} {way}"), true));
        let (across, mut gaps): (i32, Vec<Gap>) = match way {
            0 => (
                y,
                vec![
                    (1, y, WIDTH, Permeability::Permeable),
                    (3, y, WIDTH, Permeability::Permeable),
                ],
            ),
            _ => (
                x,
                vec![
                    (0, x, WIDTH, Permeability::Permeable),
                    (2, x, WIDTH, Permeability::Permeable),
                ],
            ),
        };
        for door in doors {
            let along = door.at + if way == 0 { x } else { y };
            let (side, out) = match (way, door.left) {
                (0, true) => (2, 1),
                (0, false) => (0, 3),
                (_, true) => (3, 2),
                (_, false) => (1, 0),
            };
            gaps.push((side, along, 80, Permeability::Conditional));
            let off = across + if out < 2 { half } else { -half };
            let at = if way == 0 { (along, off) } else { (off, along) };
            builder.room(&door.room, at, out, wall);
        }
        let rectangle = match way {
            0 => [x + half, y - half, x + STEP - half, y + half],
            _ => [x - half, y + half, x + half, y + STEP - half],
        };
        builder.rectangle(area, rectangle, &gaps);
    }
    builder.world
}

#[test]
fn the_lattice_sees_itself_right() {
    let mut lattice = Lattice::default();
    lattice.edges.insert(((0, 0), 0), vec![Door { room: "К".into(), at: 300, left: true }]);
    lattice.edges.insert(((1, 0), 0), Vec::new());
    lattice.edges.insert(((1, 0), 1), Vec::new());
    let east = Stand { at: (0, 0), way: 0 };
    let door = |side| Thing::Door { room: "К".into(), side };
    assert_eq!(lattice.next(east), Some((door(Side::Left), (300, 0))));
    let west = Stand { at: (1000, 0), way: 2 };
    assert_eq!(lattice.next(west), Some((door(Side::Right), (300, 0))));
    let on = Stand { at: (300, 0), way: 0 };
    assert_eq!(lattice.next(on).unwrap().0, Thing::Junction(JunctionKind::BranchLeft));
    let left = lattice
        .follow(on, &[Command::ToJunction(JunctionKind::BranchLeft), Command::Take(Turn::Left)]);
    assert_eq!(left, Stand { at: (1000, 0), way: 1 });
}
