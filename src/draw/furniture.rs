//! Furniture seen from above, with the signs by which architects tell a bed from a bath.
//!
//! A sign is a few strokes in the unit square of the Object's own box, its front at the bottom; it is looked up by the
//! words of the Object's type, and drawn where the Orthoframes themselves do not show the shape.

use crate::geometry::{PlacedReplica, Prism};
use crate::map::{Object, World};
use crate::units::{InOrder as _, Point, Vector};

use super::canvas::{Canvas, Style};

/// `(x, y)` in the unit square, front at y = 0.
enum Stroke {
    Line(&'static [(f64, f64)]),
    /// Centre and half axes.
    Oval(f64, f64, f64, f64),
    /// Two opposite corners.
    Box(f64, f64, f64, f64),
}

struct Sign {
    /// Any of these English words in the type's names calls for the sign.
    words: &'static [&'static str],
    /// Also where the Object is made of several Orthoframes.
    always: bool,
    strokes: &'static [Stroke],
}

use Stroke::{Box as Frame, Line, Oval};

const SIGNS: &[Sign] = &[
    Sign {
        words: &["bed", "bunk"],
        always: true,
        strokes: &[
            Frame(0.08, 0.76, 0.46, 0.95),
            Frame(0.54, 0.76, 0.92, 0.95),
            Line(&[(0.0, 0.66), (1.0, 0.66)]),
            Line(&[(0.0, 0.58), (1.0, 0.58)]),
        ],
    },
    Sign {
        words: &["sofa", "couch", "loveseat"],
        always: false,
        strokes: &[
            Line(&[(0.1, 0.0), (0.1, 0.72), (0.9, 0.72), (0.9, 0.0)]),
            Line(&[(0.5, 0.0), (0.5, 0.72)]),
        ],
    },
    Sign {
        words: &["armchair"],
        always: false,
        strokes: &[Line(&[(0.17, 0.0), (0.17, 0.74), (0.83, 0.74), (0.83, 0.0)])],
    },
    Sign { words: &["chair"], always: false, strokes: &[Line(&[(0.0, 0.84), (1.0, 0.84)])] },
    Sign { words: &["stool", "ottoman"], always: false, strokes: &[Oval(0.5, 0.5, 0.36, 0.36)] },
    Sign {
        words: &["stove", "oven", "cooker", "range"],
        always: true,
        strokes: &[
            Oval(0.28, 0.3, 0.15, 0.15),
            Oval(0.72, 0.3, 0.13, 0.13),
            Oval(0.28, 0.7, 0.13, 0.13),
            Oval(0.72, 0.7, 0.15, 0.15),
        ],
    },
    Sign {
        words: &["washbasin", "washstand", "sink", "basin"],
        always: true,
        strokes: &[
            Oval(0.5, 0.45, 0.36, 0.32),
            Oval(0.5, 0.5, 0.03, 0.03),
            Line(&[(0.5, 0.95), (0.5, 0.7)]),
        ],
    },
    Sign {
        words: &["toilet"],
        always: true,
        strokes: &[
            Frame(0.08, 0.72, 0.92, 1.0),
            Oval(0.5, 0.36, 0.4, 0.35),
            Oval(0.5, 0.38, 0.27, 0.23),
        ],
    },
    Sign {
        words: &["bathtub", "bath"],
        always: true,
        strokes: &[Frame(0.06, 0.08, 0.94, 0.92), Oval(0.85, 0.5, 0.02, 0.05)],
    },
    Sign {
        words: &["shower"],
        always: true,
        strokes: &[
            Line(&[(0.0, 0.0), (1.0, 1.0)]),
            Line(&[(0.0, 1.0), (1.0, 0.0)]),
            Oval(0.5, 0.5, 0.06, 0.06),
        ],
    },
    Sign {
        words: &["refrigerator", "fridge", "freezer"],
        always: true,
        strokes: &[
            Line(&[(0.0, 0.12), (1.0, 0.12)]),
            Line(&[(0.5, 0.36), (0.5, 0.84)]),
            Line(&[(0.29, 0.48), (0.71, 0.72)]),
            Line(&[(0.29, 0.72), (0.71, 0.48)]),
        ],
    },
    Sign {
        words: &["wardrobe", "closet"],
        always: true,
        strokes: &[
            Line(&[(0.06, 0.5), (0.94, 0.5)]),
            Line(&[(0.18, 0.25), (0.24, 0.78)]),
            Line(&[(0.33, 0.22), (0.35, 0.8)]),
            Line(&[(0.5, 0.24), (0.46, 0.78)]),
            Line(&[(0.63, 0.22), (0.66, 0.8)]),
            Line(&[(0.8, 0.25), (0.77, 0.78)]),
        ],
    },
    Sign {
        words: &["bookshelf", "bookcase", "shelving", "shelving unit", "book shelf"],
        always: true,
        strokes: &[
            Line(&[(0.08, 0.2), (0.08, 0.85)]),
            Line(&[(0.15, 0.2), (0.15, 0.85)]),
            Line(&[(0.21, 0.2), (0.21, 0.85)]),
            Line(&[(0.27, 0.2), (0.33, 0.85)]),
            Line(&[(0.52, 0.2), (0.52, 0.85)]),
            Line(&[(0.58, 0.2), (0.58, 0.85)]),
            Line(&[(0.66, 0.2), (0.66, 0.85)]),
            Line(&[(0.84, 0.2), (0.8, 0.85)]),
            Line(&[(0.92, 0.2), (0.92, 0.85)]),
        ],
    },
    Sign {
        words: &[
            "dresser",
            "chest of drawers",
            "drawer",
            "cabinet",
            "nightstand",
            "side table",
            "cupboard",
            "sideboard",
        ],
        always: false,
        strokes: &[Line(&[(0.0, 0.1), (1.0, 0.1)]), Line(&[(0.42, 0.03), (0.58, 0.03)])],
    },
    Sign {
        words: &["television", "tv", "monitor", "screen"],
        always: true,
        strokes: &[Line(&[(0.0, 0.5), (1.0, 0.5)]), Line(&[(0.3, 0.85), (0.7, 0.85)])],
    },
    Sign {
        words: &["lamp", "light"],
        always: true,
        strokes: &[Line(&[(0.15, 0.15), (0.85, 0.85)]), Line(&[(0.15, 0.85), (0.85, 0.15)])],
    },
    Sign {
        words: &["plant", "flower", "tree"],
        always: true,
        strokes: &[
            Oval(0.5, 0.5, 0.12, 0.12),
            Line(&[(0.5, 0.62), (0.5, 0.98)]),
            Line(&[(0.5, 0.38), (0.5, 0.02)]),
            Line(&[(0.62, 0.5), (0.98, 0.5)]),
            Line(&[(0.38, 0.5), (0.02, 0.5)]),
            Line(&[(0.59, 0.59), (0.84, 0.84)]),
            Line(&[(0.41, 0.41), (0.16, 0.16)]),
            Line(&[(0.41, 0.59), (0.16, 0.84)]),
            Line(&[(0.59, 0.41), (0.84, 0.16)]),
        ],
    },
    Sign {
        words: &["washing machine", "washer", "dryer"],
        always: true,
        strokes: &[
            Oval(0.5, 0.46, 0.34, 0.34),
            Oval(0.5, 0.46, 0.22, 0.22),
            Line(&[(0.0, 0.88), (1.0, 0.88)]),
        ],
    },
    Sign {
        words: &["laptop", "computer"],
        always: true,
        strokes: &[Line(&[(0.0, 0.55), (1.0, 0.55)]), Frame(0.1, 0.12, 0.9, 0.42)],
    },
    Sign { words: &["book"], always: true, strokes: &[Line(&[(0.12, 0.0), (0.12, 1.0)])] },
    Sign {
        words: &["box", "crate", "carton"],
        always: true,
        strokes: &[
            Line(&[(0.0, 0.5), (1.0, 0.5)]),
            Line(&[(0.0, 0.0), (0.2, 0.5)]),
            Line(&[(1.0, 0.0), (0.8, 0.5)]),
        ],
    },
    Sign {
        words: &["piano"],
        always: true,
        strokes: &[Line(&[(0.0, 0.3), (1.0, 0.3)]), Line(&[(0.0, 0.12), (1.0, 0.12)])],
    },
    Sign {
        words: &["bin", "trash", "garbage"],
        always: true,
        strokes: &[Oval(0.5, 0.5, 0.3, 0.3)],
    },
];

/// The sign of an Object, by the words of its type. The longest word decides: an armchair is no chair, a bookshelf no book.
fn sign(world: &World, object: &Object) -> Option<&'static Sign> {
    let entry = world.types.object.get(object.object_type);
    let names = entry.into_iter().flat_map(|e| [&e.name_en].into_iter().chain(&e.synonyms));
    let names: Vec<String> = names.chain([&object.name_en]).map(|n| n.to_lowercase()).collect();
    let longest = |sign: &Sign| {
        let called = |word: &&&str| names.iter().any(|name| has_word(name, word));
        sign.words.iter().filter(called).map(|w| w.len()).max()
    };
    SIGNS
        .iter()
        .filter_map(|sign| Some((longest(sign)?, sign)))
        .max_by_key(|(length, _)| *length)
        .map(|(_, s)| s)
}

fn has_word(name: &str, word: &str) -> bool {
    name.match_indices(word).any(|(at, _)| {
        let edge = |c: Option<char>| c.is_none_or(|c| !c.is_alphabetic());
        edge(name[..at].chars().next_back()) && edge(name[at + word.len()..].chars().next())
    })
}

/// The unit square of an Object's signs on the Map.
struct Square {
    corner: Point,
    /// Along the front, to the right for one who looks at the front.
    right: Vector,
    /// From front to back.
    deep: Vector,
}

impl Square {
    /// The box of the Object along its own axes, turned so that the marked front is at the bottom.
    fn of(world: &World, object: &Object, placed: &PlacedReplica) -> Self {
        let corners = object.items.iter().flat_map(|item| {
            world.orthoframe_of(item).corners().map(|p| item.frame.apply(p)).collect::<Vec<_>>()
        });
        let bounds = crate::geometry::Bounds::of(corners);
        let extent = bounds.max - bounds.min;
        let front = object.front.as_ref().and_then(|side| {
            let item = object.item(&side.item)?;
            let (_, vector) = world.orthoframe_of(item).side(&side.side)?;
            let along = item.frame.apply(vector.end) - item.frame.apply(vector.start);
            Some(Vector::new(along.y, -along.x))
        });
        let out = front.unwrap_or(Vector::new(0.0, -1.0));
        let (corner, right, deep) = if out.y.abs() >= out.x.abs() {
            if out.y <= 0.0 {
                (bounds.min, Vector::new(extent.x, 0.0), Vector::new(0.0, extent.y))
            } else {
                (bounds.max, Vector::new(-extent.x, 0.0), Vector::new(0.0, -extent.y))
            }
        } else if out.x > 0.0 {
            let corner = Point::new(bounds.max.x, bounds.min.y);
            (corner, Vector::new(0.0, extent.y), Vector::new(-extent.x, 0.0))
        } else {
            let corner = Point::new(bounds.min.x, bounds.max.y);
            (corner, Vector::new(0.0, -extent.y), Vector::new(extent.x, 0.0))
        };
        let on_map = |v: Vector| placed.frame.apply(corner + v) - placed.frame.apply(corner);
        Self { corner: placed.frame.apply(corner), right: on_map(right), deep: on_map(deep) }
    }

    fn at(&self, x: f64, y: f64) -> Point {
        self.corner + self.right * x + self.deep * y
    }

    fn draw(&self, canvas: &mut Canvas, stroke: &Stroke, style: Style) {
        const OVAL: i32 = 28;
        let line: Vec<Point> = match *stroke {
            Line(points) => points.iter().map(|&(x, y)| self.at(x, y)).collect(),
            Frame(x1, y1, x2, y2) => [(x1, y1), (x2, y1), (x2, y2), (x1, y2), (x1, y1)]
                .map(|(x, y)| self.at(x, y))
                .into(),
            Oval(x, y, rx, ry) => {
                // Round where the Object is long: the smaller half axis counts, in cm.
                let (wide, deep) = (self.right.norm() * rx, self.deep.norm() * ry);
                let (rx, ry) = if (rx - ry).abs() < 1e-9 {
                    let radius = wide.min(deep);
                    (radius / self.right.norm().max(1e-9), radius / self.deep.norm().max(1e-9))
                } else {
                    (rx, ry)
                };
                (0..=OVAL)
                    .map(|i| (f64::from(i) * std::f64::consts::TAU / f64::from(OVAL)).sin_cos())
                    .map(|(sin, cos)| self.at(x + rx * cos, y + ry * sin))
                    .collect()
            }
        };
        canvas.polyline(&line, style);
    }
}

/// Above this, in cm, a thing hangs over people's heads and is drawn in dashes.
pub(super) const OVERHEAD: f64 = 180.0;

/// Draws the things of a plan, low ones first, so that what stands on a table is seen; `pen` scales the lines.
pub(super) fn draw<'a>(
    canvas: &mut Canvas,
    world: &World,
    things: impl Iterator<Item = &'a PlacedReplica>,
    pen: f64,
) {
    let mut prisms: Vec<(&PlacedReplica, &Prism)> =
        things.flat_map(|r| r.prisms.iter().map(move |p| (r, p))).collect();
    prisms.order_by(|(r, a), (s, b)| {
        a.top.total_cmp(&b.top).then(b.bottom.total_cmp(&a.bottom)).then(r.id.cmp(&s.id))
    });
    let last: std::collections::HashMap<_, usize> =
        prisms.iter().enumerate().map(|(i, (r, _))| (r.id, i)).collect();
    for (i, (placed, prism)) in prisms.iter().enumerate() {
        let replica = &world.replicas[&placed.id];
        let kind = Looseness::of(world, placed);
        let style = kind.style(prism);
        canvas.mark_of(kind.class(), format!("thing-{}", placed.id.0));
        canvas.polygon(&prism.polygon, style.thick(pen), Some(&replica.name));
        if last[&placed.id] == i {
            let object = &world.objects[&replica.object];
            let shown = sign(world, object).filter(|s| s.always || placed.prisms.len() == 1);
            if let Some(sign) = shown {
                let square = Square::of(world, object, placed);
                canvas.mark("sign");
                for stroke in sign.strokes {
                    square.draw(canvas, stroke, SIGN.thick(pen));
                }
            }
        }
    }
}

const SIGN: Style = Style::line("#8a7a5c", 0.8).faint(0.9);
pub(super) const HANGING: Style = Style::line("#8a7a5c", 0.9).dashed(5.0, 3.0);
pub(super) const FIXED: Style = Style::fill("#e0cba6").outlined("#8a7a5c", 0.9);
pub(super) const MOVABLE: Style = Style::fill("#cfd6c4").outlined("#8a7a5c", 0.9);
pub(super) const PORTABLE: Style = Style::fill("#c9d8e6").outlined("#8a7a5c", 0.9);

/// How a thing stands, by the traits of its type.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Looseness {
    /// Furniture: neither of the others.
    Fixed,
    /// With the trait `movable`.
    Movable,
    /// With the trait `portable`.
    Portable,
    /// Over people's heads, whatever its traits.
    Overhead,
}

impl Looseness {
    pub(super) const ALL: [Self; 4] = [Self::Fixed, Self::Movable, Self::Portable, Self::Overhead];

    pub(super) fn of(world: &World, placed: &PlacedReplica) -> Self {
        match () {
            () if placed.bottom >= OVERHEAD => Self::Overhead,
            () if world.has_trait(placed.id, "movable") => Self::Movable,
            () if world.has_trait(placed.id, "portable") => Self::Portable,
            () => Self::Fixed,
        }
    }

    pub(super) fn class(self) -> &'static str {
        match self {
            Self::Fixed => "thing",
            Self::Movable => "thing movable",
            Self::Portable => "thing portable",
            Self::Overhead => "thing overhead",
        }
    }

    pub(super) fn key(self) -> (Style, &'static str) {
        match self {
            Self::Fixed => (FIXED, "key thing"),
            Self::Movable => (MOVABLE, "key thing movable"),
            Self::Portable => (PORTABLE, "key thing portable"),
            Self::Overhead => (HANGING, "key thing overhead"),
        }
    }

    /// Wood for furniture, cooler for what is loose; flat boards lighter than solid blocks.
    fn style(self, prism: &Prism) -> Style {
        let fill = match (self, prism.top - prism.bottom > 5.0) {
            (Self::Overhead, _) => return HANGING,
            (Self::Fixed, true) => "#e0cba6",
            (Self::Fixed, false) => "#efe2c8",
            (Self::Movable, true) => "#cfd6c4",
            (Self::Movable, false) => "#dfe4d8",
            (Self::Portable, true) => "#c9d8e6",
            (Self::Portable, false) => "#dde7f0",
        };
        Style::fill(fill).outlined("#8a7a5c", 0.9).faint(0.92)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_word_decides() {
        assert!(has_word("coffee table", "table"));
        assert!(!has_word("armchair", "chair"));
        assert!(!has_word("tablet", "table"));
    }
}
