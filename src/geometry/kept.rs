//! Floors as bytes, for the store: what was built once is taken up again while nothing that made it has changed (D4).
//!
//! ```text
//! file  := version:text count:u32 floor*          numbers little-endian, lengths (7 bits to a byte) before what they count
//! floor := area:u32 digest:u64 fragment           digest: of all that the Fragment was made from, see `digest`
//! ```
//!
//! **Invariant**: what is read equals what was written, bit for bit; bytes that are no such file give nothing.

use std::collections::HashMap;

use crate::map::Permeability;
use crate::units::{AreaId, DoorId, Point, ReplicaId, ZoneId};

use super::blocker::{Blocker, Obstacle};
use super::edging::{Edging, Face, Mark};
use super::floor::{Exit, FragmentFloor};
use super::grid::{Grid, Node, Outlines};
use super::kept_value::Kept;
use super::passframe::{Beyond, PassframeId};
use super::storey::Side;
use super::{Bounds, Polygon};

/// Floors of another version of the crate are not taken up.
const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), " floor 10");

/// The floors with their digests.
pub(super) fn write<'a>(
    floors: impl ExactSizeIterator<Item = (u64, &'a FragmentFloor)>,
) -> Vec<u8> {
    let mut out = Vec::new();
    VERSION.to_owned().put(&mut out);
    (floors.len() as u32).put(&mut out);
    for (digest, floor) in floors {
        digest.put(&mut out);
        floor.put(&mut out);
    }
    out
}

/// The floors by Area, each with its digest; none at all when the bytes are of something else.
pub(super) fn read(mut bytes: &[u8]) -> HashMap<AreaId, (u64, FragmentFloor)> {
    let bytes = &mut bytes;
    let mut floors = HashMap::new();
    if String::take(bytes).is_none_or(|version| version != VERSION) {
        return floors;
    }
    for _ in 0..u32::take(bytes).unwrap_or(0) {
        let Some((digest, floor)) = <(u64, FragmentFloor)>::take(bytes) else {
            return HashMap::new();
        };
        if is_sound(&floor) {
            floors.insert(floor.area, (digest, floor));
        }
    }
    floors
}

/// Whether the numbers by which a floor's parts name each other lead somewhere.
fn is_sound(floor: &FragmentFloor) -> bool {
    let is_doorway = |face: &Face| matches!(face.beyond, Beyond::Doorway { .. });
    let is_edge = |exit: &Exit| {
        (exit.cell as usize) < floor.cells.len() && exit.edge < floor.cells.ring(exit.cell).len()
    };
    let is_filled = |outlines: &Outlines| {
        outlines.ends.is_sorted_by_key(|end| end.0)
            && outlines.ends.last().map_or(0, |end| end.0 as usize) == outlines.nodes.len()
    };
    floor.ids.len() == floor.frames.len()
        && is_filled(&floor.bare)
        && is_filled(&floor.dead)
        && floor.edging.doorways.iter().all(is_doorway)
        && floor.exits.iter().all(is_edge)
}

impl Kept for Point {
    fn put(&self, out: &mut Vec<u8>) {
        (self.x, self.y).put(out);
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Some(Self::new(f64::take(bytes)?, f64::take(bytes)?))
    }
}

impl Kept for Node {
    fn put(&self, out: &mut Vec<u8>) {
        (self.x, self.y).put(out);
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Some(Self::new(i32::take(bytes)?, i32::take(bytes)?))
    }
}

macro_rules! kept_ids {
    ($($id:ident),*) => {$(
        impl Kept for $id {
            fn put(&self, out: &mut Vec<u8>) {
                self.0.put(out);
            }

            fn take(bytes: &mut &[u8]) -> Option<Self> {
                u32::take(bytes).map(Self)
            }
        }
    )*};
}

kept_ids!(AreaId, DoorId, ReplicaId, PassframeId);

macro_rules! kept_structs {
    ($($record:ident { $($field:ident),* })*) => {$(
        impl Kept for $record {
            fn put(&self, out: &mut Vec<u8>) {
                $(self.$field.put(out);)*
            }

            fn take(bytes: &mut &[u8]) -> Option<Self> {
                // Fields are read in the order in which they were written.
                $(let $field = Kept::take(bytes)?;)*
                Some(Self { $($field),* })
            }
        }
    )*};
}

kept_structs! {
    Polygon { corners }
    Grid { origin, scale, cos, sin }
    Outlines { nodes, ends }
    Bounds { min, max }
    Obstacle { blocker, polygon, side, bottom, top }
    Side { item, side, start, end, permeability }
    Face { start, end, beyond, permeability, names }
    Mark { blocker, side, permeability, names }
    Edging { doorways, sides, marks }
    Exit { doorway, cell, edge }
    FragmentFloor {
        area, bounds, level, bare, grid, obstacles, walls, dead, dead_zones, edging, frames, ids,
        passframes, lanes, cells, exits
    }
}

macro_rules! kept_words {
    ($($word:ident { $($number:literal => $value:ident),* })*) => {$(
        impl Kept for $word {
            fn put(&self, out: &mut Vec<u8>) {
                let number: u8 = match self { $(Self::$value => $number),* };
                number.put(out);
            }

            fn take(bytes: &mut &[u8]) -> Option<Self> {
                match u8::take(bytes)? {
                    $($number => Some(Self::$value),)*
                    _ => None,
                }
            }
        }
    )*};
}

kept_words! {
    Permeability { 0 => Permeable, 1 => Conditional, 2 => Impermeable }
}

impl Kept for Blocker {
    fn put(&self, out: &mut Vec<u8>) {
        match *self {
            Self::Replica { replica, item } => (0_u8, (replica, item)).put(out),
            Self::DoorLeaf { door, leaf } => (1_u8, (door, leaf)).put(out),
            Self::ReplicaLeaf { replica, door, leaf } => (2_u8, (replica, (door, leaf))).put(out),
            Self::Wall { area, item, side } => (3_u8, (area, (item, side))).put(out),
            Self::Floor { area, item } => (4_u8, (area, item)).put(out),
            Self::Zone { zone } => (5_u8, zone.0).put(out),
        }
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(bytes)? {
            0 => Self::Replica { replica: Kept::take(bytes)?, item: Kept::take(bytes)? },
            1 => Self::DoorLeaf { door: Kept::take(bytes)?, leaf: Kept::take(bytes)? },
            2 => {
                let (replica, (door, leaf)) = Kept::take(bytes)?;
                Self::ReplicaLeaf { replica, door, leaf }
            }
            3 => {
                let (area, (item, side)) = Kept::take(bytes)?;
                Self::Wall { area, item, side }
            }
            4 => Self::Floor { area: Kept::take(bytes)?, item: Kept::take(bytes)? },
            5 => Self::Zone { zone: ZoneId(Kept::take(bytes)?) },
            _ => return None,
        })
    }
}

impl Kept for Beyond {
    fn put(&self, out: &mut Vec<u8>) {
        match *self {
            Self::Passframe(id) => (0_u8, id).put(out),
            Self::Doorway { doorway, door, area } => (1_u8, (doorway, (door, area))).put(out),
            Self::Face { blocker, side } => (2_u8, (blocker, side)).put(out),
            Self::DeadZone(zone) => (3_u8, zone).put(out),
        }
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(bytes)? {
            0 => Self::Passframe(Kept::take(bytes)?),
            1 => {
                let (doorway, (door, area)) = Kept::take(bytes)?;
                Self::Doorway { doorway, door, area }
            }
            2 => Self::Face { blocker: Kept::take(bytes)?, side: Kept::take(bytes)? },
            3 => Self::DeadZone(Kept::take(bytes)?),
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::on_demand::Folded;
    use super::*;

    #[test]
    fn lengths_of_any_size_come_back() {
        for number in [0, 1, 127, 128, 300, usize::MAX >> 1, usize::MAX] {
            let mut bytes = Vec::new();
            number.put(&mut bytes);
            assert_eq!(usize::take(&mut &bytes[..]), Some(number));
            assert_eq!(usize::take(&mut &bytes[..bytes.len() - 1]), None);
        }
        // Eleven bytes that all say that more follows; ten that say more than a number holds.
        assert_eq!(usize::take(&mut &[255; 11][..]), None);
        assert_eq!(usize::take(&mut &[255, 255, 255, 255, 255, 255, 255, 255, 255, 127][..]), None);
    }

    #[test]
    fn what_is_folded_is_kept_as_it_is_and_comes_back() {
        let names = vec!["стол".to_owned(), String::new()];
        let folded = Folded::of(&names);
        let (mut bytes, mut plain) = (Vec::new(), Vec::new());
        folded.put(&mut bytes);
        names.put(&mut plain);
        assert_eq!(bytes, plain);
        bytes.push(7);
        let rest = &mut &bytes[..];
        let again: Folded<Vec<String>> = Kept::take(rest).unwrap();
        assert_eq!((again.get(), *rest), (&names, &[7][..]));
        assert_eq!(again, folded);
        assert!(Folded::<Vec<String>>::take(&mut &plain[..plain.len() - 1]).is_none());
    }
}
