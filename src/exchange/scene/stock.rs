//! Boxes with words → kinds and things of a [`Survey`](crate::Survey).

use std::collections::BTreeMap;

use crate::map::Properties;
use crate::units::{Cm, Deg, Point};
use crate::{Feet, Kind, Thing};

use super::shape::{self, Bay, Build, Crate};
use super::stacking;

/// One thing as its file gives it. Lengths in cm.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// The file's id.
    pub(super) source: String,
    /// The file's id of its kind; pieces with the same one have boxes of the same size.
    pub(super) kind: String,
    pub(super) word: String,
    /// Middle of its base.
    pub(super) at: Point,
    pub(super) bottom: f64,
    /// Counter-clockwise, in degrees.
    pub(super) angle: f64,
    /// Half of width and depth.
    pub(super) half: [f64; 2],
    /// Where its box is empty.
    pub(super) bay: Option<Bay>,
    pub(super) height: f64,
    pub(super) facing: Facing,
    pub(super) move_prob: Option<u8>,
    pub(super) kind_properties: Properties,
    pub(super) properties: Properties,
}

impl Piece {
    /// A point of the plan in the frame of its box.
    pub(super) fn own(&self, p: Point) -> Point {
        let (sin, cos) = self.angle.to_radians().sin_cos();
        let v = p - self.at;
        Point::new(v.x * cos + v.y * sin, v.y * cos - v.x * sin)
    }
}

/// What a file knows of the way a box is turned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Facing {
    /// The box lies along the thing's own axes, +y ahead.
    Own,
    /// The box lies along the axes of the building, the thing in it anyhow.
    Unknown,
}

/// Things whose front people speak of, besides seats and cases; lower case without separators.
const FACED: [&str; 13] = [
    "television",
    "tv",
    "laptop",
    "computer",
    "cpuscreen",
    "toilet",
    "desk",
    "toaster",
    "coffeemachine",
    "alarmclock",
    "washingmachine",
    "desklamp",
    "sink",
];

const STATE: &str = "СОСТОЯНИЕ";
const CLOSED: &str = "Закрыто";

fn has_front(build: Build, word: &str) -> bool {
    let word: String =
        word.chars().filter(|c| c.is_alphabetic()).flat_map(char::to_lowercase).collect();
    let round = ["ottoman", "dogbed"].contains(&word.as_str());
    (matches!(build, Build::Seat | Build::Case) && !round) || FACED.contains(&word.as_str())
}

/// What pieces become.
pub(super) struct Shelf {
    /// In the order of their first thing.
    pub(super) kinds: Vec<Kind>,
    /// In the order of the file.
    pub(super) things: Vec<Thing>,
    /// As the file has them, before anything was set down.
    pub(super) feet: Feet,
}

pub(super) fn shelve(mut pieces: Vec<Piece>) -> Shelf {
    for piece in pieces.iter_mut().filter(|p| shape::build(&p.word) == Build::Covering) {
        // It lies on the floor, not a centimetre above it.
        if piece.bottom.abs() < shape::SAME_LEVEL {
            piece.bottom = 0.0;
        }
        piece.height = piece.height.min(shape::PILE);
    }
    let mut boxes: Vec<Crate> = pieces
        .iter()
        .map(|p| Crate {
            build: shape::build(&p.word),
            at: p.at,
            angle: p.angle,
            half: p.half,
            bay: p.bay,
            bottom: p.bottom,
            top: p.bottom + p.height,
        })
        .collect();
    let feet = stacking::feet(&boxes);
    for (n, bottom) in stacking::stacked(&boxes).into_iter().enumerate() {
        pieces[n].bottom = bottom;
        (boxes[n].bottom, boxes[n].top) = (bottom, bottom + pieces[n].height);
    }
    for (n, is_closed) in shape::closed(&boxes).into_iter().enumerate() {
        let is_shut = || pieces[n].properties.get(STATE).is_some_and(|state| state == CLOSED);
        if boxes[n].build == Build::Bowl && (is_closed || is_shut()) {
            boxes[n].build = Build::Case;
            pieces[n].kind.push_str(" (закрыто)");
        }
    }
    let levels = shape::levels(&boxes);
    let surrounds = shape::surrounds(&boxes);
    for (i, piece) in pieces.iter().enumerate() {
        let roomy = surrounds[i] || !levels[i].is_empty();
        let known = matches!(boxes[i].build, Build::Hung | Build::Table);
        if piece.facing == Facing::Unknown && roomy && !known {
            boxes[i].build = Build::Envelope;
        }
    }
    let mut by_kind: BTreeMap<&str, (usize, Vec<f64>, Build)> = BTreeMap::new();
    let mut first = Vec::new();
    for (i, piece) in pieces.iter().enumerate() {
        let next = by_kind.len();
        let entry = by_kind.entry(&piece.kind).or_insert_with(|| {
            first.push(i);
            (next, Vec::new(), boxes[i].build)
        });
        entry.1.extend(&levels[i]);
        if boxes[i].build == Build::Envelope {
            entry.2 = Build::Envelope;
        }
    }
    let kinds = first.iter().map(|&i| {
        let piece = &pieces[i];
        let (_, levels, build) = &by_kind[piece.kind.as_str()];
        let faces = piece.facing == Facing::Own && has_front(*build, &piece.word);
        Kind {
            source: piece.kind.clone(),
            word: piece.word.clone(),
            parts: shape::parts(
                *build,
                piece.half,
                piece.bay,
                piece.height,
                &shape::common(levels.iter().copied()),
            ),
            front: faces.then(|| Deg::of(90.0)),
            properties: piece.kind_properties.clone(),
        }
    });
    let kinds = kinds.collect();
    let numbers: Vec<usize> = pieces.iter().map(|p| by_kind[p.kind.as_str()].0).collect();
    let things = pieces.into_iter().zip(numbers).map(|(piece, kind)| Thing {
        source: piece.source,
        name: String::new(),
        kind,
        at: piece.at,
        z: Cm::of(piece.bottom),
        angle: Deg::of(piece.angle),
        room: None,
        move_prob: piece.move_prob,
        properties: piece.properties,
    });
    Shelf { kinds, things: things.collect(), feet }
}

/// СОСТОЯНИЕ from what a file says of being open and switched on; where it says both, the second is ПИТАНИЕ.
pub(super) fn state(open: Option<bool>, on: Option<bool>, properties: &mut Properties) {
    let open = open.map(|o| if o { "Открыто" } else { CLOSED });
    let on = on.map(|o| if o { "Включено" } else { "Выключено" });
    if let (Some(_), Some(on)) = (open, on) {
        properties.insert("ПИТАНИЕ".to_owned(), on.to_owned());
    }
    if let Some(state) = open.or(on) {
        properties.insert(STATE.to_owned(), state.to_owned());
    }
}
