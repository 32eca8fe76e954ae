//! Relations that are measured when somebody asks: how far two things are from each other, how big one is, what lies
//! between two, how things lie about the robot, where a point is. None of them is stored for all: the building has too
//! many pairs, and any number of points.
//!
//! Those that `rules/relations.dl` declares are read by its own rules: what follows from them is derived for the
//! question, and why it holds or not is told from the same measurements.
//!
//! Lengths are tenths of a millimetre, angles hundredths of a degree, areas cm², volumes cm³, as integers.

mod between;
mod gaze;
mod level;
mod robot;
mod spot;

use crate::facts::{Computed, Value};
use crate::map::{Entity, World};
use crate::units::{AreaId, Cm, Deg, MapId, OpeningId, Point, Pose, ReplicaId, Source};

use super::measured::{MEASURED, Measured};
use super::names::Subject;
use super::relations::Relations;

pub(crate) use between::way_between;
pub(crate) use gaze::looks_from;
pub(crate) use spot::ROBOT;

/// What is known beside the relations when something is measured on asking.
#[derive(Debug, Clone, Copy)]
pub struct Around<'w> {
    pub world: &'w World,
    /// Where the robot stands.
    pub robot: Option<(MapId, Pose)>,
    /// Points that are asked of beside the robot's, by their places among these, and which way one looks from them where
    /// that is asked.
    pub spots: &'w [(MapId, Point, Option<Deg>)],
}

impl<'w> Around<'w> {
    /// Of a world in which no robot stands.
    #[must_use]
    pub fn new(world: &'w World) -> Self {
        Self { world, robot: None, spots: &[] }
    }

    /// The same, with where the robot stands.
    #[must_use]
    pub fn with_robot(self, robot: Option<(MapId, Pose)>) -> Self {
        Self { robot, ..self }
    }
}

/// Between the surfaces of two things of one Map, or from a thing to a door or an Area in the plan.
const DISTANCE: &str = "РАССТОЯНИЕ_МЕЖДУ(x: Any, y: Any, d: number) = distance_between";
/// `what` is height, width, depth, longest, narrowest (in the plan), thickness (the least of the three), foot (above
/// the zero of its Map), base or volume; of an Area all but foot and thickness; of a door width.
const SIZE: &str = "РАЗМЕР(x: Any, what: symbol, v: number) = size_of";

/// A relation that geometry computes when asked, of `W`: a World, or what knows more than that.
pub struct OnDemand<'w, W> {
    declaration: Source,
    ways: Vec<(u32, f64)>,
    pub around: &'w W,
    pub relations: &'w Relations,
    rows: Rows<W>,
}

/// Tells the rows that have these values in the columns that are known; none of what has no place.
pub type Rows<W> = fn(&OnDemand<'_, W>, &[Option<Value>], &mut dyn FnMut(&[Value])) -> Option<()>;

impl<'w, W> OnDemand<'w, W> {
    /// By its declaration without `.decl`; for the ways see [`Computed::ways`].
    #[must_use]
    pub fn new(
        declaration: &str,
        ways: Vec<(u32, f64)>,
        (around, relations): (&'w W, &'w Relations),
        rows: Rows<W>,
    ) -> Self {
        let name = declaration.split('(').next().unwrap_or_default();
        let declaration = Source::new(name, format!(".decl {declaration}"));
        Self { declaration, ways, around, relations, rows }
    }

    /// What it is called in the rules.
    pub(crate) fn name(&self) -> &str {
        self.declaration.name()
    }

    /// What the rules call a thing.
    #[must_use]
    pub fn symbol(&self, thing: ReplicaId) -> Option<Value> {
        let symbol = self.relations.symbols().known(Subject::Entity(Entity::Replica(thing)))?;
        Some(Value::Symbol(symbol.clone()))
    }

    /// What the rules call so.
    #[must_use]
    pub fn subject(&self, value: Option<&Value>) -> Option<Subject> {
        let Some(Value::Symbol(symbol)) = value else { return None };
        self.relations.symbols().subject(symbol)
    }
}

impl<W> Computed for OnDemand<'_, W> {
    fn declaration(&self) -> &Source {
        &self.declaration
    }

    fn ways(&self) -> &[(u32, f64)] {
        &self.ways
    }

    fn rows(&self, known: &[Option<Value>], tell: &mut dyn FnMut(&[Value])) {
        let _ = (self.rows)(self, known, tell);
    }
}

/// A relation of which all rows are there for one question.
pub struct Listed {
    declaration: Source,
    ways: [(u32, f64); 1],
    rows: Vec<Vec<Value>>,
}

impl Listed {
    /// Rows of a relation of the table; none where it has no such relation.
    #[must_use]
    pub fn of(name: &str, rows: Vec<Vec<Value>>) -> Option<Self> {
        Some(Self::new(MEASURED.iter().find(|measured| measured.name == name)?, rows))
    }

    pub(crate) fn new(relation: &Measured, rows: Vec<Vec<Value>>) -> Self {
        let declaration = Source::new(relation.name, relation.declared());
        Self { declaration, ways: [(0, rows.len() as f64)], rows }
    }
}

impl Computed for Listed {
    fn declaration(&self) -> &Source {
        &self.declaration
    }

    fn ways(&self) -> &[(u32, f64)] {
        &self.ways
    }

    fn rows(&self, known: &[Option<Value>], tell: &mut dyn FnMut(&[Value])) {
        let fits = |row: &&Vec<Value>| {
            known.iter().zip(*row).all(|(known, value)| known.as_ref().is_none_or(|k| k == value))
        };
        self.rows.iter().filter(fits).for_each(|row| tell(row));
    }
}

/// A length of so many cm, as the rules count it.
#[must_use]
pub fn length(cm: f64) -> Option<Value> {
    Cm::new(cm).ok().map(|cm| Value::Number(cm.to_tenths_mm()))
}

type Asked<'r, 'w> = OnDemand<'r, Around<'w>>;

/// All that is measured on asking: `distance_between(+x, y, d)` or `(x, +y, d)`, `size_of(+x, what, v)`, and what
/// `rules/relations.dl` declares of it.
#[must_use]
pub fn on_demand<'r, 'w>(
    around: &'r Around<'w>,
    relations: &'r Relations,
) -> Vec<OnDemand<'r, Around<'w>>> {
    let both = (around, relations);
    let pairs = vec![(0b11, 1.0), (0b01, 1e4), (0b10, 1e4)];
    let mut all = vec![
        OnDemand::new(DISTANCE, pairs, both, distances),
        OnDemand::new(SIZE, vec![(0b11, 1.0), (0b01, 9.0)], both, sizes),
    ];
    let declared: [(&str, u32, Rows<Around<'w>>); 12] = [
        ("amid", 0b110, between::amid),
        ("before_wall", 0b10, between::before_wall),
        ("shelf", 0b1, level::shelves),
        ("view", 0, robot::view),
        ("about_robot", 0, robot::about),
        ("gaze", 0, gaze::gaze),
        ("spot", 0, spot::spots),
        ("spot_side", 0, spot::sides),
        ("spot_opening", 0, spot::openings),
        ("spot_thing", 0, spot::things),
        ("spot_wall", 0, spot::walls),
        ("spot_middle", 0, spot::middles),
    ];
    all.extend(declared.into_iter().filter_map(|(name, needs, rows)| {
        let measured = MEASURED.iter().find(|measured| measured.name == name)?;
        Some(OnDemand::new(
            measured.declared().trim_start_matches(".decl "),
            vec![(needs, 30.0)],
            both,
            rows,
        ))
    }));
    all
}

/// What has a place of its own.
#[derive(Clone, Copy, PartialEq)]
enum Placed {
    Thing(ReplicaId),
    Area(AreaId),
    Opening(OpeningId),
}

impl Asked<'_, '_> {
    fn placed(&self, value: Option<&Value>) -> Option<Placed> {
        let Some(Value::Symbol(symbol)) = value else { return None };
        match self.subject(value) {
            Some(Subject::Entity(Entity::Replica(id))) => Some(Placed::Thing(id)),
            Some(Subject::Entity(Entity::Area(id))) => Some(Placed::Area(id)),
            Some(Subject::Entity(Entity::Door(_))) | None => {
                let mut all = self.relations.openings().iter();
                all.find(|opening| opening.name == **symbol).map(|o| Placed::Opening(o.id))
            }
            Some(_) => None,
        }
    }

    /// cm
    fn between(&self, thing: ReplicaId, other: Placed) -> Option<f64> {
        match other {
            Placed::Thing(other) => {
                (thing != other).then(|| self.relations.distance(thing, other)).flatten()
            }
            Placed::Area(area) => self.relations.distance_to_area(thing, area),
            Placed::Opening(id) => {
                let opening = self.relations.openings().opening(id)?;
                let (map, _) = self.relations.centre(thing)?;
                let side = opening.sides.iter().min_by_key(|side| side.area)?;
                (map == opening.map)
                    .then(|| self.relations.distance_to_segment(thing, side.ends))
                    .flatten()
            }
        }
    }
}

fn distances(
    asked: &Asked<'_, '_>,
    known: &[Option<Value>],
    tell: &mut dyn FnMut(&[Value]),
) -> Option<()> {
    let ends = [asked.placed(known[0].as_ref()), asked.placed(known[1].as_ref())];
    let mut tell_of = |thing: ReplicaId, other: Placed, others: Value, is_first: bool| {
        let row = || {
            let d = length(asked.between(thing, other)?)?;
            let thing = asked.symbol(thing)?;
            Some(if is_first { [thing, others.clone(), d] } else { [others.clone(), thing, d] })
        };
        if let Some(row) = row() {
            tell(&row);
        }
    };
    match (&known[0], &known[1]) {
        (Some(_), Some(second)) => match (ends[0]?, ends[1]?) {
            (Placed::Thing(thing), other) => tell_of(thing, other, second.clone(), true),
            (other, Placed::Thing(thing)) => tell_of(thing, other, known[0].clone()?, false),
            _ => return None,
        },
        (Some(first), None) => {
            let other = ends[0]?;
            let all = asked.around.world.replicas.keys();
            all.for_each(|thing| tell_of(*thing, other, first.clone(), false));
        }
        (None, Some(second)) => {
            let other = ends[1]?;
            let all = asked.around.world.replicas.keys();
            all.for_each(|thing| tell_of(*thing, other, second.clone(), true));
        }
        (None, None) => return None,
    }
    Some(())
}

fn sizes(
    asked: &Asked<'_, '_>,
    known: &[Option<Value>],
    tell: &mut dyn FnMut(&[Value]),
) -> Option<()> {
    let x = known[0].clone()?;
    let wanted = known[1].as_ref().map(ToString::to_string);
    let mut one = |what: &str, v: Option<Value>| {
        if let Some(v) = v.filter(|_| wanted.as_ref().is_none_or(|wanted| wanted == what)) {
            tell(&[x.clone(), Value::Symbol(what.into()), v]);
        }
    };
    let whole = |v: f64| Some(Value::Number(v.round() as i64));
    let (extent, is_thing) = match asked.placed(Some(&x))? {
        Placed::Thing(id) => (asked.relations.extent(id)?, true),
        Placed::Area(id) => (asked.relations.area_extent(id)?, false),
        Placed::Opening(id) => {
            let opening = asked.relations.openings().opening(id)?;
            let side = opening.sides.iter().min_by_key(|side| side.area)?;
            one("width", length((side.ends.1 - side.ends.0).norm()));
            return Some(());
        }
    };
    let (width, depth, height) = (extent.width, extent.depth, extent.height);
    one("height", length(height));
    one("width", length(width));
    one("depth", length(depth));
    one("longest", length(width.max(depth)));
    one("narrowest", length(width.min(depth)));
    if is_thing {
        one("thickness", length(width.min(depth).min(height)));
        one("foot", length(extent.bottom));
    }
    one("base", whole(extent.base));
    one("volume", whole(extent.base * height));
    Some(())
}
