//! The Orthoframe: a vertical prism (paper 1 §2; paper 2 §2, tables OrFr, OrtFrmSides, …Properties).

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::units::{Cm, Deg, OrFrId, Point, TypeId};

/// Name-value pairs set by hand (M10): ЦВЕТ = Чёрный. Names keep the spelling of the map.
pub type Properties = BTreeMap<String, String>;

/// Whether a face lets things through (paper 2 §1: 0, 1, 2).
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize,
)]
pub enum Permeability {
    /// A solid surface.
    #[default]
    Impermeable,
    /// Anything narrower and lower passes: a passage, the open front of a bookshelf.
    Permeable,
    /// A door: permeable while it is open.
    Conditional,
}

impl Permeability {
    /// The paper's code.
    #[must_use]
    pub fn code(self) -> u8 {
        match self {
            Self::Impermeable => 0,
            Self::Permeable => 1,
            Self::Conditional => 2,
        }
    }

    #[must_use]
    pub fn from_code(code: u8) -> Option<Self> {
        [Self::Impermeable, Self::Permeable, Self::Conditional].get(usize::from(code)).copied()
    }
}

/// One vector of a base and the side that stands on it (table OrtFrmSides).
#[derive(Debug, Clone, PartialEq)]
pub struct BaseVector {
    /// Unique within its Orthoframe, usually a letter: `"A"`.
    pub id: String,
    pub start: Point,
    pub end: Point,
    /// Wall, passage, door …
    pub side_type: Option<TypeId>,
    pub permeability: Permeability,
    /// What people call this side: «Парадный вход».
    pub names: Vec<String>,
    pub properties: Properties,
}

impl BaseVector {
    #[must_use]
    pub fn length(&self) -> Cm {
        Cm::of((self.end - self.start).norm())
    }

    /// Direction of the vector, counter-clockwise from +x of the Orthoframe's own frame.
    #[must_use]
    pub fn angle(&self) -> Deg {
        let v = self.end - self.start;
        // atan2 is exact on the axes, so that straight walls have straight angles.
        Deg::from_radians(v.y.atan2(v.x))
    }
}

/// A vertical prism over a simple polygon, or its frustum when [`Self::roof_scale`] is not 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Orthoframe {
    pub id: OrFrId,
    /// The handle that the map file uses; unique among Orthoframes.
    pub key: String,
    pub name: String,
    pub name_en: String,
    pub description: String,
    pub frame_type: Option<TypeId>,
    /// Geometric figure of the base: «Прямоугольник».
    pub shape: Option<TypeId>,
    /// Counter-clockwise, closed, simple; at least three vectors.
    pub base: Vec<BaseVector>,
    /// Base to roof; 0 is a flat shelf.
    pub height: Cm,
    pub base_permeability: Permeability,
    pub roof_permeability: Permeability,
    /// Uniframe (M9): size of the roof polygon over the size of the base, about the base's centroid. An Orthoframe has 1.
    pub roof_scale: f64,
    pub properties: Properties,
}

impl Orthoframe {
    /// Corners of the base, counter-clockwise; corner `i` starts side `i`.
    pub fn corners(&self) -> impl ExactSizeIterator<Item = Point> + '_ {
        self.base.iter().map(|v| v.start)
    }

    #[must_use]
    pub fn side(&self, id: &str) -> Option<(usize, &BaseVector)> {
        self.base.iter().enumerate().find(|(_, v)| v.id == id)
    }

    /// Overall sizes of the base along its own axes (SizeX, SizeY).
    #[must_use]
    pub fn size(&self) -> (Cm, Cm) {
        let extent = |axis: fn(&Point) -> f64| {
            let (low, high) =
                self.corners().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
                    (low.min(axis(&p)), high.max(axis(&p)))
                });
            Cm::of(if low <= high { high - low } else { 0.0 })
        };
        (extent(|p| p.x), extent(|p| p.y))
    }

    /// A frustum rather than a prism.
    #[must_use]
    pub fn is_uniframe(&self) -> bool {
        (self.roof_scale - 1.0).abs() > f64::EPSILON
    }
}
