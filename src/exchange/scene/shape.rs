//! From the box of a thing to Orthoframes: what stands on it and what lies in it must come out as in the room.
//!
//! The box alone says too little: a cup on the seat of a chair is within the box of the chair. Two things say more.
//! The word tells the build ([`Build`]: a table is a top on legs, a wardrobe a case with shelves). And the other things
//! tell where surfaces are, for nothing hovers: a cup whose foot is within the box of a chair, and under which no other
//! thing ends, stands on a surface of the chair at that height ([`levels`]).
//!
//! ```text
//!   Table            Seat              Case               Bowl
//!   ============     |                 +----------+       .          .
//!   |          |     |                 |==========| level :          :
//!   |          |     |=======  level   |          |       :          :
//!   |          |     |######|          +----------+       +----------+
//! ```
//!
//! **Invariant.** Solid parts of one thing do not lie in one another; the first part stands at height 0.

use std::collections::HashMap;

use crate::Part;
use crate::map::Permeability;
use crate::units::{Cm, Point};

use super::plane::difference;

/// Thickness of a table top and of a shelf, cm: what carpenters use.
const TOP: f64 = 4.0;
const SHELF: f64 = 2.0;
/// Thickness of a table leg, cm.
const LEG: f64 = 6.0;
/// Heights nearer to one another than this are one surface, cm: more than a box's own error, less than two shelves.
pub(super) const SAME_LEVEL: f64 = 5.0;
/// A foot this near to a roof stands on it, cm: no box of these formats is off by more. What stands is set down on its roof
/// exactly, so that it rests there whatever gap the rules allow.
pub(super) const STANDS: f64 = 8.0;
/// A foot deeper than this below a roof stands on something else, cm: downwards these boxes are off by less.
pub(super) const SUNK: f64 = 2.0;
/// What holds a thing is so many times as large: two apples whose boxes overlap do not lie in one another.
const ROOMIER: f64 = 2.5;
/// How high a floor covering is at most where a wheel or a foot presses on it, cm: what a box has above that is pile.
pub(super) const PILE: f64 = 2.0;
/// Height of a seat for people where nothing tells it, cm, and its greatest share of the whole.
const SEAT: f64 = 45.0;
const SEAT_SHARE: f64 = 0.6;

/// How things of one word are built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Build {
    /// Solid as far as anyone knows.
    Block,
    /// A top on four legs.
    Table,
    /// A seat or mattress with a back or headboard behind.
    Seat,
    /// A body with shelves: wardrobe, refrigerator, chest of drawers.
    Case,
    /// Open from above: basket, sink.
    Bowl,
    /// Lies on the floor and gives way: one walks and drives over it.
    Covering,
    /// Hangs on a wall or from the ceiling: where its foot ends there is no surface.
    Hung,
    /// The box is only what surrounds a body of unknown build that has room for others.
    Envelope,
}

/// Words of AI2-THOR and VirtualHome, lower case without separators, by their build.
const WORDS: &[(Build, &[&str])] = &[
    (
        Build::Table,
        &["table", "diningtable", "sidetable", "coffeetable", "kitchentable", "desk", "bench"],
    ),
    (
        Build::Seat,
        &["chair", "stool", "armchair", "sofa", "couch", "bed", "ottoman", "dogbed", "loveseat"],
    ),
    (
        Build::Case,
        &[
            "bathroomcabinet",
            "bookcase",
            "bookshelf",
            "cabinet",
            "closet",
            "closetdrawer",
            "cupboard",
            "dishwasher",
            "drawer",
            "dresser",
            "fridge",
            "freezer",
            "kitchencabinet",
            "kitchencabinets",
            "microwave",
            "nightstand",
            "oven",
            "refrigerator",
            "safe",
            "shelf",
            "shelvingunit",
            "stall",
            "storage",
            "stove",
            "tvstand",
            "wallshelf",
            "wardrobe",
            "washingmachine",
            "pantry",
        ],
    ),
    (
        Build::Bowl,
        &[
            "basket",
            "bathtub",
            "bin",
            "bowl",
            "box",
            "bucket",
            "cart",
            "dishbowl",
            "dumpster",
            "garbagecan",
            "laundryhamper",
            "pot",
            "trashcan",
            "trash",
            "wastebasket",
        ],
    ),
    // A rim with a basin in it: what stands on the rim and what lies in the basin.
    (Build::Envelope, &["sink"]),
    (Build::Covering, &["bathmat", "carpet", "doormat", "mat", "rug"]),
    (
        Build::Hung,
        &[
            "blinds",
            "ceilingfan",
            "ceilinglamp",
            "clock",
            "curtain",
            "curtains",
            "handtowel",
            "hanger",
            "handtowelholder",
            "lightswitch",
            "mirror",
            "painting",
            "photograph",
            "poster",
            "powersocket",
            "showerhead",
            "toiletpaperhanger",
            "towel",
            "towelholder",
            "towelrack",
            "walllamp",
            "wallphone",
            "wallpictureframe",
        ],
    ),
];

/// The build of what a word names.
pub(super) fn build(word: &str) -> Build {
    let word: String =
        word.chars().filter(|c| c.is_alphabetic()).flat_map(char::to_lowercase).collect();
    let known = WORDS.iter().find(|(_, words)| words.contains(&word.as_str()));
    known.map_or(Build::Block, |(build, _)| *build)
}

/// A rectangle of a box in which there is nothing of the thing: the corner of an L, the bay of a U. In the thing's own
/// frame, the middle of its box at the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bay {
    pub(super) low: Point,
    pub(super) high: Point,
}

impl Bay {
    pub(super) fn contains(&self, p: Point) -> bool {
        p.x > self.low.x && p.x < self.high.x && p.y > self.low.y && p.y < self.high.y
    }
}

/// A thing as its file gives it: an upright box.
#[derive(Debug, Clone)]
pub(super) struct Crate {
    pub(super) build: Build,
    /// Middle of the base.
    pub(super) at: Point,
    /// Counter-clockwise, in degrees.
    pub(super) angle: f64,
    /// Half of width and depth.
    pub(super) half: [f64; 2],
    pub(super) bay: Option<Bay>,
    pub(super) bottom: f64,
    pub(super) top: f64,
}

impl Crate {
    fn volume(&self) -> f64 {
        self.half[0] * self.half[1] * (self.top - self.bottom)
    }

    fn covers(&self, p: Point) -> bool {
        let (sin, cos) = self.angle.to_radians().sin_cos();
        let v = p - self.at;
        let own = Point::new(v.x * cos + v.y * sin, v.y * cos - v.x * sin);
        own.x.abs() <= self.half[0]
            && own.y.abs() <= self.half[1]
            && !self.bay.is_some_and(|bay| bay.contains(own))
    }

    fn grown(&self, by: f64) -> Self {
        Self { half: self.half.map(|h| h + by), ..self.clone() }
    }

    fn corners(&self) -> [Point; 4] {
        let (sin, cos) = self.angle.to_radians().sin_cos();
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
            let (x, y) = (x * self.half[0], y * self.half[1]);
            self.at + nalgebra::Vector2::new(x * cos - y * sin, x * sin + y * cos)
        })
    }

    fn reach(&self) -> f64 {
        self.half[0].hypot(self.half[1])
    }

    /// Whether a thing stands within this box: its foot is in it, and there is room for it.
    pub(super) fn holds(&self, thing: &Self) -> bool {
        self.volume() > ROOMIER * thing.volume()
            && thing.bottom >= self.bottom - STANDS
            && thing.bottom < self.top - SUNK
            && !self.is_over_floor(thing)
    }

    /// Whether a thing stands on the top of this one, as well as boxes tell.
    pub(super) fn bears(&self, thing: &Self) -> bool {
        // Furniture that stands on the floor where a rug lies too.
        let on_floor =
            self.build == Build::Covering && thing.bottom < f64::midpoint(self.bottom, self.top);
        !on_floor && (-SUNK..=STANDS).contains(&(thing.bottom - self.top))
    }

    /// Whether a thing beneath this table or seat stands on the floor that this stands on.
    pub(super) fn is_over_floor(&self, thing: &Self) -> bool {
        matches!(self.build, Build::Table | Build::Seat) && thing.bottom < self.bottom + STANDS
    }
}

/// The things whose boxes are over or under the middle of this one, or round it, and that may carry it.
pub(super) fn around<'a>(
    things: &'a [Crate],
    near: &'a Neighbours,
    thing: &'a Crate,
) -> impl Iterator<Item = usize> + 'a {
    near.at(thing.at).copied().filter(move |&i| {
        let other = &things[i];
        !std::ptr::eq(other, thing) && other.build != Build::Hung && other.covers(thing.at)
    })
}

/// The tightest of the boxes within which a thing stands.
pub(super) fn holder(things: &[Crate], around: &[usize], thing: &Crate) -> Option<usize> {
    let holders = around.iter().copied().filter(|&i| things[i].holds(thing));
    holders.min_by(|&i, &j| things[i].volume().total_cmp(&things[j].volume()))
}

/// For each thing the heights above its own bottom at which others stand in it. Sorted, no two nearer than 5 cm.
pub(super) fn levels(things: &[Crate]) -> Vec<Vec<f64>> {
    let near = Neighbours::of(things);
    let mut found = vec![Vec::new(); things.len()];
    for thing in things.iter().filter(|t| t.build != Build::Hung) {
        let around: Vec<usize> = around(things, &near, thing).collect();
        let carried =
            around.iter().any(|&i| (-SUNK..=STANDS).contains(&(thing.bottom - things[i].top)));
        if let Some(i) = holder(things, &around, thing).filter(|_| !carried) {
            found[i].push((thing.bottom - things[i].bottom).max(0.0));
        }
    }
    found.into_iter().map(distinct).collect()
}

/// Which open vessels have something standing on top of them and nothing that sticks out of them: they are closed.
pub(super) fn closed(things: &[Crate]) -> Vec<bool> {
    let near = Neighbours::of(things);
    let mut is_trodden = vec![false; things.len()];
    let mut is_heaped = vec![false; things.len()];
    for thing in things.iter().filter(|t| t.build != Build::Hung) {
        for i in around(things, &near, thing).filter(|&i| things[i].build == Build::Bowl) {
            let vessel = &things[i];
            let gap = thing.bottom - vessel.top;
            is_trodden[i] |= gap.abs() <= SUNK;
            is_heaped[i] |= gap < -SUNK
                && thing.bottom >= vessel.bottom - STANDS
                && thing.top > vessel.top + SUNK;
        }
    }
    is_trodden.into_iter().zip(is_heaped).map(|(trodden, heaped)| trodden && !heaped).collect()
}

/// Which boxes hold another box wholly: no solid body does.
pub(super) fn surrounds(things: &[Crate]) -> Vec<bool> {
    /// The rounding of a file that writes single precision, cm.
    const ROUNDING: f64 = 0.05;
    let near = Neighbours::of(things);
    let mut found = vec![false; things.len()];
    for (i, thing) in things.iter().enumerate() {
        for &j in near.at(thing.at) {
            let other = &things[j];
            found[j] |= i != j
                && thing.volume() < other.volume()
                && thing.bottom >= other.bottom - ROUNDING
                && thing.top <= other.top + ROUNDING
                && thing.corners().iter().all(|&p| other.grown(ROUNDING).covers(p));
        }
    }
    found
}

/// One height for each group of heights that are nearly the same: the lowest of them.
fn distinct(mut heights: Vec<f64>) -> Vec<f64> {
    heights.sort_by(f64::total_cmp);
    let mut kept: Vec<f64> = Vec::new();
    for height in heights {
        if kept.last().is_none_or(|last| height - last > SAME_LEVEL) {
            kept.push(height);
        }
    }
    kept
}

/// Levels of all things of a kind as those of the kind.
pub(super) fn common(levels: impl IntoIterator<Item = f64>) -> Vec<f64> {
    distinct(levels.into_iter().collect())
}

/// Which things may stand over a point: a grid of two-metre cells, and the few things too large for it.
pub(super) struct Neighbours {
    cells: HashMap<(i64, i64), Vec<usize>>,
    large: Vec<usize>,
}

impl Neighbours {
    const CELL: f64 = 200.0;

    pub(super) fn of(things: &[Crate]) -> Self {
        let mut near = Self { cells: HashMap::new(), large: Vec::new() };
        for (i, thing) in things.iter().enumerate() {
            let reach = thing.reach();
            if reach > 5.0 * Self::CELL {
                near.large.push(i);
                continue;
            }
            let (x0, y0) = Self::cell(thing.at.x - reach, thing.at.y - reach);
            let (x1, y1) = Self::cell(thing.at.x + reach, thing.at.y + reach);
            for cell in (x0..=x1).flat_map(|x| (y0..=y1).map(move |y| (x, y))) {
                near.cells.entry(cell).or_default().push(i);
            }
        }
        near
    }

    fn cell(x: f64, y: f64) -> (i64, i64) {
        ((x / Self::CELL).floor() as i64, (y / Self::CELL).floor() as i64)
    }

    fn at(&self, p: Point) -> impl Iterator<Item = &usize> {
        self.large.iter().chain(self.cells.get(&Self::cell(p.x, p.y)).into_iter().flatten())
    }
}

/// The Orthoframes of a box, its middle at the origin, its bottom at height 0, its front towards +y.
pub(super) fn parts(
    build: Build,
    half: [f64; 2],
    bay: Option<Bay>,
    height: f64,
    levels: &[f64],
) -> Vec<Part> {
    let [w, d] = half;
    let whole = ground(half, bay);
    let solid = |word: &str, outline: Vec<Point>, bottom: f64, top: f64| Part {
        word: word.to_owned(),
        outline,
        bottom: Cm::of(bottom),
        height: Cm::of((top - bottom).max(0.0)),
        permeability: Permeability::Impermeable,
    };
    let hollow = |word: &str| Part {
        permeability: Permeability::Permeable,
        ..solid(word, whole.clone(), 0.0, height)
    };
    let shelves = |from: f64, to: f64| {
        let inside = levels.iter().copied().filter(move |&l| l > from && l < to - SHELF);
        inside.map(|l| solid("shelf", whole.clone(), (l - SHELF).max(from), l)).collect::<Vec<_>>()
    };
    let thin = height < 2.0 * SAME_LEVEL || w.min(d) < SAME_LEVEL;
    match build {
        _ if thin && build != Build::Envelope => vec![solid("", whole.clone(), 0.0, height)],
        Build::Table => {
            let top = (height - TOP).max(height / 2.0);
            let leg = LEG.min(w).min(d);
            let feet = [(-w, -d), (w - leg, -d), (w - leg, d - leg), (-w, d - leg)];
            // A shelf or a lower top ends where the legs stand: they are cut through by it.
            let mut floors = shelves(0.0, top);
            let bounds = floors.iter().map(|s| (s.bottom.get(), s.bottom.get() + s.height.get()));
            let gaps = between(bounds, top);
            let legs = gaps.iter().flat_map(|&(low, high)| {
                feet.map(|(x, y)| solid("leg", rectangle(x, y, x + leg, y + leg), low, high))
            });
            let mut parts: Vec<Part> = legs.collect();
            parts.append(&mut floors);
            parts.push(solid("tabletop", whole.clone(), top, height));
            parts
        }
        Build::Seat => {
            let seat = seat_level(height, levels);
            let back = (0.15 * d * 2.0).clamp(5.0, 25.0);
            let mut parts = if levels.first().is_some_and(|&low| low < seat - SAME_LEVEL) {
                let mut plates = shelves(0.0, seat - SHELF);
                plates.insert(
                    0,
                    solid(
                        "base",
                        whole.clone(),
                        0.0,
                        plates.first().map_or(SHELF, |p| p.bottom.get().min(SHELF)),
                    ),
                );
                plates.push(solid("seat", whole.clone(), seat - SHELF, seat));
                plates
            } else {
                vec![solid("seat", whole.clone(), 0.0, seat)]
            };
            if height - seat > SAME_LEVEL {
                parts.push(solid("back", rectangle(-w, -d, w, -d + back), seat, height));
            }
            parts
        }
        Build::Case => {
            let mut parts = vec![hollow("case"), solid("bottom", whole.clone(), 0.0, SHELF)];
            parts.append(&mut shelves(SHELF, height - SHELF));
            parts.push(solid("top", whole.clone(), height - SHELF, height));
            parts
        }
        Build::Bowl => vec![hollow("body"), solid("bottom", whole.clone(), 0.0, SHELF)],
        Build::Envelope => {
            let mut parts = vec![hollow("body")];
            parts.append(&mut shelves(0.0, height - SHELF));
            let top = height.min(SHELF);
            parts.push(solid("rim", whole.clone(), height - top, height));
            parts
        }
        Build::Block | Build::Covering | Build::Hung => match levels.first() {
            None => vec![solid("", whole.clone(), 0.0, height)],
            Some(_) => self::parts(Build::Envelope, half, bay, height, levels),
        },
    }
}

/// Where the things on a seat stand; where there are none, as high as people sit.
pub(super) fn seat_level(height: f64, levels: &[f64]) -> f64 {
    let told = levels.iter().copied().rfind(|&l| l < height - SAME_LEVEL && l > height / 4.0);
    told.unwrap_or_else(|| {
        let usual = SEAT.min(height * SEAT_SHARE);
        if height <= SEAT + SAME_LEVEL { height } else { usual }
    })
}

/// What a thing covers of its box.
fn ground([w, d]: [f64; 2], bay: Option<Bay>) -> Vec<Point> {
    let whole = rectangle(-w, -d, w, d);
    let Some(Bay { low, high }) = bay else { return whole };
    let bay = rectangle(low.x, low.y, high.x, high.y);
    difference(std::slice::from_ref(&whole), &[bay]).into_iter().next().unwrap_or(whole)
}

/// The stretches of height below `top` that floors leave free.
fn between(floors: impl Iterator<Item = (f64, f64)>, top: f64) -> Vec<(f64, f64)> {
    let mut free = Vec::new();
    let mut from = 0.0;
    for (low, high) in floors.chain([(top, top)]) {
        if low > from {
            free.push((from, low));
        }
        from = high;
    }
    free
}

pub(super) fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> Vec<Point> {
    vec![Point::new(x0, y0), Point::new(x1, y0), Point::new(x1, y1), Point::new(x0, y1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thing(build: Build, at: (f64, f64), half: f64, bottom: f64, top: f64) -> Crate {
        let at = Point::new(at.0, at.1);
        Crate { build, at, angle: 0.0, half: [half, half], bay: None, bottom, top }
    }

    #[test]
    fn what_stands_in_a_box_shows_its_surfaces() {
        let things = [
            thing(Build::Case, (0.0, 0.0), 40.0, 0.0, 200.0),
            thing(Build::Block, (0.0, 0.0), 5.0, 100.0, 110.0),
            thing(Build::Block, (20.0, 0.0), 5.0, 101.0, 110.0),
            // On the first one, not in the case.
            thing(Build::Block, (0.0, 0.0), 4.0, 110.5, 115.0),
            // On top of the case.
            thing(Build::Block, (0.0, 0.0), 5.0, 200.0, 210.0),
            thing(Build::Block, (0.0, 0.0), 5.0, 30.0, 40.0),
        ];
        let found = levels(&things);
        assert_eq!(found[0], [30.0, 100.0]);
        assert!(found[1..].iter().all(Vec::is_empty));
    }

    #[test]
    fn what_is_hardly_larger_holds_nothing() {
        // Two apples in one bowl, whose boxes overlap.
        let things = [
            thing(Build::Block, (0.0, 0.0), 8.0, 95.0, 112.0),
            thing(Build::Block, (1.0, 0.0), 7.0, 103.0, 117.0),
        ];
        assert!(levels(&things).iter().all(Vec::is_empty));
    }

    #[test]
    fn solid_parts_do_not_lie_in_one_another() {
        let all =
            [Build::Block, Build::Table, Build::Seat, Build::Case, Build::Bowl, Build::Envelope];
        let cases: [&[f64]; 6] = [&[], &[0.0], &[1.0], &[30.0], &[10.0, 45.0], &[5.0, 20.0, 88.0]];
        for (build, levels) in all.iter().flat_map(|b| cases.iter().map(move |l| (*b, *l))) {
            for height in [0.0, 3.0, 11.0, 40.0, 90.0, 210.0] {
                let parts = parts(build, [40.0, 30.0], None, height, levels);
                let solid: Vec<_> = parts
                    .iter()
                    .filter(|p| p.permeability == Permeability::Impermeable)
                    .map(|p| (p.bottom.get(), (p.bottom + p.height).get(), p))
                    .collect();
                assert!(parts.iter().any(|p| p.bottom.get() == 0.0), "{build:?} {levels:?}");
                for (i, &(low, high, p)) in solid.iter().enumerate() {
                    assert!(low >= 0.0 && high <= height + 1e-9, "{build:?} {levels:?} {height}");
                    for &(l, h, q) in &solid[i + 1..] {
                        let apart = high <= l + 1e-9 || h <= low + 1e-9;
                        let legs = p.word == "leg" && q.word == "leg";
                        assert!(apart || legs, "{build:?} {levels:?} {height}: {p:?} {q:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_chair_without_anything_on_it_has_a_seat_at_the_usual_height() {
        let chair = parts(build("Chair"), [25.0, 25.0], None, 90.0, &[]);
        assert_eq!(chair.len(), 2);
        assert_eq!(chair[0].height, Cm::of(45.0));
        assert_eq!((chair[1].word.as_str(), chair[1].bottom), ("back", Cm::of(45.0)));
        let table = parts(build("Dining_Table"), [60.0, 40.0], None, 75.0, &[]);
        assert_eq!(table.iter().filter(|p| p.word == "leg").count(), 4);
    }
}
