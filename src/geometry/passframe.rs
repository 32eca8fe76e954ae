//! Passframes (W2; paper 1, section 7): the convex cells of a Fragment's free floor, and what borders them.
//!
//! **Invariant**: the Passframes of a Fragment are convex, do not overlap and together are exactly its free
//! floor. An id follows from the Passframe's place, so that it lasts while the Passframe does.
//!
//! The cells and their ids are made with the floor; what borders them is found when it is first asked for
//! ([`super::borders`]): no way is looked for along it.

use std::collections::HashSet;
use std::fmt;

use crate::map::Permeability;
use crate::units::{AreaId, DoorId, Point};

use super::Polygon;
use super::blocker::Blocker;
use super::mesh::Mesh;

/// Unique in its Fragment; said in digits and letters of which none is taken for another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PassframeId(pub u32);

impl fmt::Display for PassframeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SIGNS: [char; 32] = [
            '0', '1', '2', '3', '4', '5', '6', '7', '8', '9', 'A', 'B', 'C', 'D', 'E', 'F', 'G',
            'H', 'J', 'K', 'M', 'N', 'P', 'Q', 'R', 'S', 'T', 'V', 'W', 'X', 'Y', 'Z',
        ];
        let signs = (0..7).rev().map(|k| SIGNS[(self.0 >> (5 * k)) as usize % SIGNS.len()]);
        write!(f, "П-{}", signs.collect::<String>())
    }
}

/// The paper's marker-types. Where several would fit, the one named first holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PassframeKind {
    /// «Закрытая зона»: no chain of Passframes that the robot can cross leads from it to a door or passage.
    Closed,
    /// «Граница видимости»: it borders a door or passage, where the Fragment ends and the neighbour begins.
    Boundary,
    /// «Тупик»: the robot can leave it over one border at most.
    DeadEnd,
    /// «Проход»: all others.
    Passage,
}

/// What lies on the other side of a border.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Beyond {
    Passframe(PassframeId),
    /// A door (none for an open passage) into an Area; `doorway` is its number, see [`super::FloorPlan::doorway_at`].
    Doorway {
        doorway: usize,
        door: Option<DoorId>,
        area: AreaId,
    },
    /// A face of something solid; `side` counts the faces of the Orthoframe.
    Face {
        blocker: Blocker,
        side: Option<usize>,
    },
    /// Floor that the robot cannot cover, by its index in [`super::FragmentFloor::dead_zones`].
    DeadZone(usize),
}

/// One vector of a Passframe.
#[derive(Debug, Clone, PartialEq)]
pub struct Border {
    pub start: Point,
    pub end: Point,
    /// Inherited from the face beyond; what is floor on both sides is permeable.
    pub permeability: Permeability,
    pub beyond: Beyond,
    /// What people call the face: «Парадный вход».
    pub names: Vec<String>,
    /// Where the robot's centre can cross.
    pub crossing: Option<(Point, Point)>,
    /// The cell beyond.
    pub(super) across: u32,
}

/// A convex cell of free floor.
#[derive(Debug, Clone, PartialEq)]
pub struct Passframe {
    pub id: PassframeId,
    pub polygon: Polygon,
    pub kind: PassframeKind,
    /// Border `i` starts at corner `i`.
    pub borders: Vec<Border>,
}

impl Passframe {
    /// The Passframes that the robot can reach from here over one border.
    pub fn neighbours(&self) -> impl Iterator<Item = (PassframeId, (Point, Point))> + '_ {
        self.borders.iter().filter_map(|b| match b.beyond {
            Beyond::Passframe(id) => Some((id, b.crossing?)),
            _ => None,
        })
    }
}

/// Ids from the corners' places in the Map, to the tenth of a millimetre: what lasts keeps its id, whatever comes or
/// goes elsewhere.
pub(super) fn ids(frames: &Mesh) -> Vec<PassframeId> {
    let hash = |cell: usize, round: u32| {
        let mut hash = 0xcbf2_9ce4_8422_2325_u64; // FNV-1a
        let mut mix = |byte: u8| hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        for p in frames.corners(cell as u32) {
            for x in [p.x, p.y] {
                // The exact place tells slivers apart.
                let word = if round == 0 { (x * 100.0).round() as i64 as u64 } else { x.to_bits() };
                word.to_le_bytes().into_iter().for_each(&mut mix);
            }
        }
        if round > 0 {
            round.to_le_bytes().into_iter().for_each(&mut mix);
        }
        // The upper half depends on every byte.
        (hash >> 32) as u32
    };
    distinct(frames.len(), hash).into_iter().map(PassframeId).collect()
}

/// Numbers for things, no two alike, from what each hashes to in round after round: whoever meets nobody keeps the
/// number, all who meet go on to the next round. So a thing's number hangs on those that it meets and on no order; two of
/// a thousand have one 32-bit hash in one of nine thousand Fragments.
fn distinct(count: usize, hash: impl Fn(usize, u32) -> u32) -> Vec<u32> {
    let mut numbers = vec![0; count];
    let mut taken = HashSet::with_capacity(count);
    let mut open: Vec<usize> = (0..count).collect();
    let mut round = 0;
    while !open.is_empty() {
        let mut sorted: Vec<(u32, usize)> = open.drain(..).map(|i| (hash(i, round), i)).collect();
        sorted.sort_unstable();
        for alike in sorted.chunk_by(|a, b| a.0 == b.0) {
            match alike {
                &[(number, i)] if taken.insert(number) => numbers[i] = number,
                // The same in every round: nothing but the order is left to tell them apart.
                _ if round >= LAST_ROUND => {
                    for &(number, i) in alike {
                        numbers[i] = (number..=u32::MAX)
                            .chain(0..number)
                            .find(|&n| taken.insert(n))
                            .unwrap_or(number);
                    }
                }
                _ => open.extend(alike.iter().map(|a| a.1)),
            }
        }
        round += 1;
    }
    numbers
}

/// After so many rounds things that meet are the same in all that is hashed.
const LAST_ROUND: u32 = 16;

#[cfg(test)]
mod tests {
    use super::*;

    /// Hashes that meet often: of a thing's own name and the round alone.
    fn poor(name: u32, round: u32) -> u32 {
        let hash = name.wrapping_mul(0x9e37_79b9).rotate_left(7 * round + 3);
        if round == 0 { hash % 40 } else { hash }
    }

    fn numbers(names: &[u32]) -> Vec<(u32, u32)> {
        let found = distinct(names.len(), |i, round| poor(names[i], round));
        let mut named: Vec<(u32, u32)> = names.iter().copied().zip(found).collect();
        named.sort_unstable();
        named
    }

    #[test]
    fn ids_that_meet_hang_on_no_order_and_on_nobody_else() {
        let names: Vec<u32> = (0..30).map(|k| k * k * 7 + 1).collect();
        let whole = numbers(&names);
        let met = names
            .iter()
            .filter(|&&n| names.iter().any(|&other| other != n && poor(other, 0) == poor(n, 0)));
        assert!(met.count() > 6);
        let distinct: HashSet<u32> = whole.iter().map(|n| n.1).collect();
        assert_eq!(distinct.len(), names.len());
        let turned: Vec<u32> = names.iter().rev().copied().collect();
        assert_eq!(numbers(&turned), whole);
        // Whoever goes changes only those that it met.
        for gone in &names {
            let rest: Vec<u32> = names.iter().copied().filter(|n| n != gone).collect();
            for (name, number) in numbers(&rest) {
                let meets = poor(name, 0) == poor(*gone, 0);
                assert!(meets || whole.contains(&(name, number)), "{name} without {gone}");
            }
        }
        // What hashes alike for ever is told apart all the same.
        assert_eq!(super::distinct(3, |_, _| u32::MAX), [u32::MAX, 0, 1]);
    }
}
