//! Floors of growing size, the same on every machine: rooms on both sides of corridors that meet in a hall.
//!
//! ```text
//!   +-----+-----+-----+
//!   |     |     |     |     rooms of 400 × 500, a door of 100 to the corridor
//!   +--D--+--D--+--D--+
//!   P  corridor       |     250 wide, open to the hall on the left
//!   +--D--+--D--+--D--+
//!   |     |     |     |
//!   +-----+-----+-----+
//! ```

use std::collections::BTreeMap;

use orthoframe_geometry::{Polygon, Scene};
use orthoframe_map::{DoorKind, DoorState};
use orthoframe_units::{AreaId, Deg, DoorId, Frame, MapId, Point};

use crate::floors::{Builder, Opening, p, rectangle};

/// A building and the middles of its rooms.
pub(crate) struct Generated {
    pub(crate) builder: Builder,
    pub(crate) rooms: Vec<(AreaId, Point)>,
}

/// SplitMix64.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * (((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

impl Generated {
    /// Pairs of places all over the rooms where a disc fits with a centimetre to spare, by the obvious test.
    pub(crate) fn pairs(&self, count: usize, radius: f64) -> Vec<(Point, Point)> {
        let scene = Scene::of(&self.builder.world, MapId(1));
        let mut things: BTreeMap<AreaId, Vec<&Polygon>> = BTreeMap::new();
        for replica in scene.replicas.values() {
            let parts = replica.prisms.iter().map(|p| &p.polygon);
            things.entry(replica.area).or_default().extend(parts);
        }
        let mut random = Random(11);
        let mut spot = || loop {
            let number = random.between(0.0, self.rooms.len() as f64) as usize;
            let area = self.rooms[number].0;
            let walls = &scene.areas[&area].prisms[0];
            let (low, high) = (walls.bounds.min, walls.bounds.max);
            let at = p(random.between(low.x, high.x), random.between(low.y, high.y));
            let clear = |thing: &&Polygon| {
                !thing.contains(at, 0.0) && thing.border_distance(at) > radius + 1.0
            };
            if walls.polygon.border_distance(at) > radius + 1.0
                && things.get(&area).is_none_or(|things| things.iter().all(clear))
            {
                return at;
            }
        };
        (0..count).map(|_| (spot(), spot())).collect()
    }
}

const ROOM: (f64, f64) = (400.0, 500.0);
const CORRIDOR: f64 = 250.0;

/// One room with things.
pub(crate) fn room(things: usize) -> Generated {
    let mut builder = Builder::new();
    let area = builder.area("Комната", &rectangle(800.0, 600.0), Frame::IDENTITY, &[]);
    furnish(&mut builder, area, (800.0, 600.0), things, &mut Random(7));
    Generated { builder, rooms: vec![(area, p(400.0, 300.0))] }
}

/// `corridors` with `pairs` of rooms each.
pub(crate) fn building(corridors: usize, pairs: usize, things: usize) -> Generated {
    let mut b = Builder::new();
    let mut random = Random(42);
    let mut rooms = Vec::new();
    let pitch = 2.0 * ROOM.1 + CORRIDOR + 40.0;
    let length = pairs as f64 * ROOM.0;
    let mut hall_sides = vec![p(-300.0, 0.0), p(0.0, 0.0)];
    let mut hall_open = Vec::new();
    for k in 0..corridors {
        let y = k as f64 * pitch;
        let mid = y + ROOM.1 + CORRIDOR / 2.0;
        let mut corners = vec![p(0.0, mid - CORRIDOR / 2.0)];
        let mut open = Vec::new();
        let mut doors: Vec<(DoorId, usize)> = Vec::new();
        for i in 0..pairs {
            let x = i as f64 * ROOM.0 + 150.0;
            let door = b.door(DoorKind::Sliding, 100.0, DoorState::OPEN);
            corners.push(p(x, mid - CORRIDOR / 2.0));
            open.push((corners.len() - 1, Opening::Door(door)));
            doors.push((door, i));
            corners.push(p(x + 100.0, mid - CORRIDOR / 2.0));
        }
        corners.push(p(length, mid - CORRIDOR / 2.0));
        corners.push(p(length, mid + CORRIDOR / 2.0));
        for i in (0..pairs).rev() {
            let x = i as f64 * ROOM.0 + 150.0;
            let door = b.door(DoorKind::Sliding, 100.0, DoorState::OPEN);
            corners.push(p(x + 100.0, mid + CORRIDOR / 2.0));
            open.push((corners.len() - 1, Opening::Door(door)));
            doors.push((door, pairs + i));
            corners.push(p(x, mid + CORRIDOR / 2.0));
        }
        corners.push(p(0.0, mid + CORRIDOR / 2.0));
        open.push((corners.len() - 1, Opening::Passage));
        b.area("Коридор", &corners, Frame::IDENTITY, &open);
        for (door, i) in doors {
            let below = i < pairs;
            let (w, d) = ROOM;
            let x = (i % pairs) as f64 * w;
            let (corners, origin) = if below {
                let c = vec![p(0., 0.), p(w, 0.), p(w, d), p(250., d), p(150., d), p(0., d)];
                (c, p(x, mid - CORRIDOR / 2.0 - d))
            } else {
                let c = vec![p(0., 0.), p(150., 0.), p(250., 0.), p(w, 0.), p(w, d), p(0., d)];
                (c, p(x, mid + CORRIDOR / 2.0))
            };
            let frame = Frame::new(origin.x, origin.y, 0.0, Deg::ZERO);
            let side = if below { 3 } else { 1 };
            let area = b.area("Комната", &corners, frame, &[(side, Opening::Door(door))]);
            furnish(&mut b, area, ROOM, things, &mut random);
            rooms.push((area, origin + nalgebra::Vector2::new(w / 2.0, d / 2.0)));
        }
        hall_sides.push(p(0.0, mid - CORRIDOR / 2.0));
        hall_open.push((hall_sides.len() - 1, Opening::Passage));
        hall_sides.push(p(0.0, mid + CORRIDOR / 2.0));
    }
    let top = corridors as f64 * pitch;
    hall_sides.extend([p(0.0, top), p(-300.0, top)]);
    b.area("Холл", &hall_sides, Frame::IDENTITY, &hall_open);
    Generated { builder: b, rooms }
}

/// Things of all sizes, half of them askew, none before the doors.
fn furnish(b: &mut Builder, area: AreaId, size: (f64, f64), things: usize, random: &mut Random) {
    for k in 0..things {
        let (w, d) = (random.between(25.0, 90.0), random.between(25.0, 70.0));
        let turn = if k % 2 == 0 { 0.0 } else { random.between(0.0, 360.0) };
        let along_wall = random.between(0.0, 1.0) < 0.6;
        let (x, y) = if along_wall {
            let x = if random.between(0.0, 1.0) < 0.5 { 5.0 } else { size.0 - w - 5.0 };
            (x, random.between(60.0, size.1 - 130.0))
        } else {
            (random.between(100.0, size.0 - 190.0), random.between(150.0, size.1 - 220.0))
        };
        b.put(area, x, y, w, d, turn, 80.0);
    }
}
