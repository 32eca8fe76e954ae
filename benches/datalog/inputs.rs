//! Deterministic inputs: graphs, a tree, boxes in rooms.

use std::collections::BTreeSet;

pub(crate) type Edge = (u32, u32);

/// A small generator of numbers: the same seed, the same input on every machine.
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    /// A number from `least` to `most`, both included.
    pub(crate) fn between(&mut self, least: i64, most: i64) -> i64 {
        least + ((self.next() >> 33) as i64) % (most - least + 1)
    }

    fn chance(&mut self, of_ten: i64) -> bool {
        self.between(0, 9) < of_ten
    }
}

pub(crate) fn chain(nodes: u32) -> Vec<Edge> {
    (0..nodes).map(|n| (n, n + 1)).collect()
}

/// Right and down on a square.
pub(crate) fn grid(side: u32) -> Vec<Edge> {
    let mut edges = Vec::new();
    for i in 0..side {
        for j in 0..side {
            if i + 1 < side {
                edges.push((i * side + j, (i + 1) * side + j));
            }
            if j + 1 < side {
                edges.push((i * side + j, i * side + j + 1));
            }
        }
    }
    edges
}

pub(crate) fn random(nodes: i64, edges: usize, seed: u64) -> Vec<Edge> {
    let mut dice = Dice::new(seed);
    let mut edge = || (dice.between(0, nodes - 1) as u32, dice.between(0, nodes - 1) as u32);
    let distinct: BTreeSet<Edge> = (0..edges).map(|_| edge()).collect();
    distinct.into_iter().collect()
}

/// Parent and child in a full binary tree.
pub(crate) fn tree(depth: u32) -> Vec<Edge> {
    (1..1 << depth).flat_map(|n| [(n, 2 * n), (n, 2 * n + 1)]).collect()
}

/// Id, room, corners on the floor, height above it, own height.
pub(crate) type Box8 = [i64; 8];

/// A floor plan of rooms in rows of ten, each with furniture, things on it and things in it; and the doors.
pub(crate) fn boxes(count: usize, per_room: usize, seed: u64) -> (Vec<Box8>, Vec<Edge>) {
    let mut dice = Dice::new(seed);
    let mut boxes: Vec<Box8> = Vec::new();
    let mut doors = BTreeSet::new();
    let rooms = (count / per_room) as i64;
    for room in 0..rooms {
        let (floor, place) = (room / 100, room % 100);
        let (row, column) = (place / 10, place % 10);
        let corner = (column * 520, row * 420, floor * 350);
        let mut mine: Vec<[i64; 6]> = Vec::new();
        let mut add = |mine: &mut Vec<[i64; 6]>, b: [i64; 6]| {
            let [x1, y1, x2, y2, z, h] = b;
            let id = boxes.len() as i64;
            boxes.push([
                id,
                room,
                corner.0 + x1,
                corner.1 + y1,
                corner.0 + x2,
                corner.1 + y2,
                corner.2 + z,
                h,
            ]);
            mine.push(b);
        };
        let furniture = per_room * 2 / 5;
        for _ in 0..furniture {
            let (w, d, h) = (dice.between(40, 120), dice.between(40, 120), dice.between(40, 90));
            let (x, y) = (dice.between(0, 500 - w), dice.between(0, 400 - d));
            add(&mut mine, [x, y, x + w, y + d, 0, h]);
        }
        for _ in 0..furniture {
            let under = loop {
                let under = mine[dice.between(0, mine.len() as i64 - 1) as usize];
                if under[2] - under[0] >= 6 && under[3] - under[1] >= 6 && under[4] + under[5] < 260
                {
                    break under;
                }
            };
            let w = dice.between(5, 30.min(under[2] - under[0]));
            let d = dice.between(5, 30.min(under[3] - under[1]));
            let h = dice.between(5, 30);
            let (x, y) =
                (dice.between(under[0], under[2] - w), dice.between(under[1], under[3] - d));
            add(&mut mine, [x, y, x + w, y + d, under[4] + under[5], h]);
        }
        for _ in 0..per_room / 5 {
            let around = mine[dice.between(0, furniture as i64 - 1) as usize];
            let (w, d, h) = (dice.between(5, 20), dice.between(5, 20), dice.between(5, 20));
            let x = dice.between(around[0] + 1, around[2] - w - 1);
            let y = dice.between(around[1] + 1, around[3] - d - 1);
            let z = dice.between(around[4] + 1, around[4] + around[5] - h - 1);
            add(&mut mine, [x, y, x + w, y + d, z, h]);
        }
        let mut door = |to: i64| doors.extend([(room as u32, to as u32), (to as u32, room as u32)]);
        if column < 9 && place < 99 && room + 1 < rooms && dice.chance(8) {
            door(room + 1);
        }
        if row < 9 && room + 10 < rooms && dice.chance(8) {
            door(room + 10);
        }
    }
    (boxes, doors.into_iter().collect())
}
