//! What a foreign file says of a building, in terms that every such file shares: a [`Survey`].
//!
//! A reader turns its format into a `Survey` and judges nothing beyond its own syntax; one assembler, the same for all
//! formats, makes of it Areas, doors, Objects and links that pass the checks of [`crate::map`], mending and leaving out
//! as the report tells. Lengths are cm, angles degrees counter-clockwise from +x, x to the right and y up; a format
//! with another frame is turned by its reader. A Map keeps these coordinates, so that a robot's pose in the frame of
//! the file names the same place on it.
//!
//! **Invariant.** Every number in a `Survey` is finite; indices into its lists are in range. Order follows the file, so
//! that two readings of one file give the same ids.

use crate::map::{DoorKind, DoorLeaf, DoorStatus, OpensTo, Permeability, Properties};
use crate::units::{Bilingual, Cm, Deg, Point};

use super::report::{Count, Treatment, What};

/// A building as a foreign file describes it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Survey {
    /// Of the building; the file's name when the file gives none.
    pub name: String,
    pub levels: Vec<Level>,
    /// Kinds of things, shared by all levels.
    pub kinds: Vec<Kind>,
    pub lifts: Vec<Lift>,
    /// Whose coordinates these are, in words; what lies at the zero point where that is not the file's own zero.
    pub frame: String,
    /// How near the feet of its things are to what they stand on.
    pub feet: Feet,
    /// What the reader left out or had to assume, for the report.
    pub remarks: Vec<Remark>,
    /// What became of records of the file that stand in none of the lists above, or stand there otherwise than in the
    /// file: with them the report counts what the file has.
    pub told: Vec<Told>,
    /// What it took as the file has it, and that is worth a word.
    pub notes: Vec<Remark>,
}

/// What a reader tells of records of its file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Told {
    pub treatment: Treatment,
    pub what: What,
    /// The file's id of the record, or the name of a whole class of records.
    pub source: String,
    /// For the person who imports.
    pub text: Bilingual,
    /// Records that the lists of the survey do not hold; none where they do.
    pub count: Count,
}

/// The words for a plane that touches the globe: x runs east and y north from here, degrees.
pub(super) fn zero_of(lat: f64, lon: f64) -> String {
    format!("начало координат: {lat:.8}° с. ш., {lon:.8}° в. д.; x на восток, y на север")
}

/// Of the things that a file has standing on something: how many there are, and how many of them stand above it or are
/// sunk into it by more than a person's measuring would be off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Feet {
    pub off: usize,
    pub of: usize,
}

impl Feet {
    /// Whether the boxes are a detector's, or lie round meshes. What a person measures is within 2 cm in 19 of 20 cases:
    /// boxes are loose where more are off than by two standard deviations of that.
    #[must_use]
    pub fn are_loose(self) -> bool {
        const SHARE: f64 = 0.05;
        let of = self.of as f64;
        self.off as f64 > of * SHARE + 2.0 * (of * SHARE * (1.0 - SHARE)).sqrt()
    }
}

/// What a reader left out, mended or had to assume.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// The file's id of the record that it is about; empty when it is about the whole file.
    pub source: String,
    /// For the person who imports.
    pub text: Bilingual,
}

/// One storey: it becomes a Map.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Level {
    /// The file's own name or number for it.
    pub source: String,
    pub name: String,
    /// Floor level above the building's zero.
    pub elevation: Cm,
    pub rooms: Vec<Room>,
    pub openings: Vec<Opening>,
    pub things: Vec<Thing>,
    pub spots: Vec<Spot>,
    pub lanes: Vec<Lane>,
}

/// A straight piece of a way that the file says is driven. It is a hint that is checked, and no record of the Map.
#[derive(Debug, Clone, PartialEq)]
pub struct Lane {
    pub source: String,
    pub ends: [Point; 2],
}

/// A room: it becomes an Area.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Room {
    /// The file's id; what other records refer to.
    pub source: String,
    /// As the file names it; may be empty or shared with others.
    pub name: String,
    /// The file's word for what it is, looked up in the synonym table: `Bedroom`, `corridor`.
    pub kind: String,
    /// What it is called by what belongs to it, in English, where the file gives it no name: `Left consult room 3`, of
    /// whose doors each is called so.
    pub called: String,
    /// On its level, without the closing point; either sense of rotation, any dirt.
    pub outline: Vec<Point>,
    /// Parts of the outline that are no floor: columns, courtyards.
    pub holes: Vec<Vec<Point>>,
    /// Floor to ceiling; None where the file does not tell.
    pub height: Option<Cm>,
    pub properties: Properties,
}

/// A door, passage or window in a wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening {
    pub source: String,
    pub name: String,
    pub what: OpeningKind,
    /// From jamb to jamb, in the wall or near it. The *first side* of the opening is the one from which the first is the
    /// right jamb: the side to the left of the way from the first to the second. Leaves are counted from the first jamb,
    /// and `opens` says whether they swing into the first side, whichever rooms lie there.
    pub jambs: [Point; 2],
    /// Rooms of the level that the file says it joins (indices), in any order; None where it does not say: the assembler
    /// steps off both sides and looks. `Some([a, None])` leads outside.
    pub rooms: Option<[Option<usize>; 2]>,
    pub height: Option<Cm>,
    /// Lower edge above the floor: windows.
    pub sill: Cm,
    pub properties: Properties,
}

#[derive(Debug, Clone, PartialEq)]
pub enum OpeningKind {
    /// Leaves from the first jamb to the second (`HingeSide::Right`: hinged towards the first); empty: one leaf of the
    /// usual sort. `opens`: into the first side or out of it.
    Door {
        kind: DoorKind,
        leaves: Vec<DoorLeaf>,
        opens: Option<OpensTo>,
        status: DoorStatus,
        opening: f64,
    },
    Passage,
    Window,
}

/// A kind of thing: it becomes an Object, its boxes Orthoframes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Kind {
    /// The file's id of the kind, unique among the kinds: `Dresser_315_1`.
    pub source: String,
    /// The file's word for what it is, looked up in the synonym table: `Dresser`, `OfficeChair`.
    pub word: String,
    pub parts: Vec<Part>,
    /// Direction of its front in its own frame, where the format has one.
    pub front: Option<Deg>,
    pub properties: Properties,
}

/// A prism of a kind, in the kind's own frame, whose origin the reader chooses.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// What it is, where the file tells: `shelf`.
    pub word: String,
    pub outline: Vec<Point>,
    pub bottom: Cm,
    pub height: Cm,
    /// Of all faces; `Permeable` for a body that holds things within its bounding box.
    pub permeability: Permeability,
}

/// One thing of a kind, placed: it becomes a replica.
#[derive(Debug, Clone, PartialEq)]
pub struct Thing {
    pub source: String,
    pub name: String,
    /// Index into [`Survey::kinds`].
    pub kind: usize,
    /// Where the kind's origin stands on the level.
    pub at: Point,
    /// Of the kind's origin, above the level's floor.
    pub z: Cm,
    pub angle: Deg,
    /// Index into [`Level::rooms`] where the file says in which room it is; else it is found by its place.
    pub room: Option<usize>,
    /// 0..=100; None: by the kind's traits.
    pub move_prob: Option<u8>,
    pub properties: Properties,
}

/// A named place to stand: a charger, a waypoint.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    pub source: String,
    pub name: String,
    /// The file's word for what it is, whatever its name: `charger`; empty when it does not tell.
    pub kind: String,
    pub at: Point,
    pub heading: Option<Deg>,
    /// Whether a robot begins here.
    pub is_start: bool,
}

/// A lift or a flight of stairs.
#[derive(Debug, Clone, PartialEq)]
pub struct Lift {
    pub source: String,
    pub name: String,
    /// `(level, room)` for each level that it serves: the cabin's floor there is a room of that level.
    pub stops: Vec<(usize, usize)>,
    /// Whether the file itself calls it a lift or stairs. Else only rooms of several storeys belong together somehow, and it is
    /// one if all of them are of a type that is.
    pub is_told: bool,
}
