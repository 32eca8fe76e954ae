//! Where on the Map the measurements stand that a reason rests on: between which two things, and how much was measured.
//!
//! **Invariant.** What was measured comes from the facts; here is only found where on the plan it is to be shown.

use crate::facts::{Because, Below, FailedRule, Premise, Proof, Value, WhyNot};
use crate::geometry::{FloorPlan, Polygon, nearest_on_segment};
use crate::language::Language;
use crate::language::question::{Asker, Fact};
use crate::map::Entity;
use crate::semantics::{MEASURED, Subject};
use crate::units::{InOrder as _, MapId, Point};

use super::talk::RobotSenses;
use super::{Error, State};

/// Lengths stand in facts in tenths of a millimetre.
const IN_CM: f64 = 100.0;
/// The columns that say how far two are from each other, aside or in height: what else is measured has no place between them.
const BETWEEN: [&str; 4] = ["d", "distance", "gap", "escape"];

/// A measurement where it was made.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Measurement {
    pub relation: String,
    /// The names of the two.
    pub of: [String; 2],
    pub map: MapId,
    /// Where the two are nearest to each other; twice the same point where one lies over the other.
    pub ends: [Point; 2],
    /// cm
    pub length: f64,
    /// The measurement in a sentence.
    pub text: Option<String>,
    /// Whether a condition on it failed: of what does not hold.
    pub fails: bool,
}

/// Why a relation holds, or does not.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reason {
    /// Its proof, or what is lacking of one.
    pub because: Result<Proof, WhyNot>,
    /// «Чашка-1 не находится на Столе-2, потому что …»
    pub text: String,
    /// What of the map the reason speaks of.
    pub about: Vec<String>,
    pub measurements: Vec<Measurement>,
}

impl State {
    /// Why a relation holds or does not, in a sentence and by its measurements, on the map as surveyed.
    ///
    /// # Errors
    /// There is no map, or it knows no such relation, or nothing of such a name.
    pub(crate) fn reason(
        &self,
        relation: &str,
        of: &[&str],
        language: Language,
    ) -> Result<Reason, Error> {
        let relations = self.relations()?;
        let because = self.why(relation, of)?;
        let of = &self.arguments(of)?;
        let mut found = Found { state: self, about: Vec::new(), facts: Vec::new() };
        match &because {
            Ok(proof) => found.of_proof(proof),
            Err(WhyNot::Nearest(rule)) => found.of_failed(rule),
            Err(WhyNot::NotTold | WhyNot::Holds) => {}
        }
        let senses = RobotSenses { engine: self };
        let asker = Asker { world: self.world()?, relations, mind: self.mind()?, senses: &senses };
        let fact = Fact {
            relation: relations.display_name(relation, Language::English),
            args: of.iter().map(|name| (*name).to_owned()).collect(),
            holds: because.is_ok(),
        };
        let measurements = found.facts.iter().filter_map(|(name, values, fails)| {
            let measured = self.measurement(name, values)?;
            let text = asker.measurement(name, values, language);
            Some(Measurement { text, fails: *fails, ..measured })
        });
        let mut measurements: Vec<Measurement> = measurements.collect();
        measurements.dedup();
        found.about.extend(of.iter().map(|name| (*name).to_owned()));
        found.about.order();
        found.about.dedup();
        let text = asker.because(&fact, language);
        Ok(Reason { because, text, about: found.about, measurements })
    }

    /// A measured fact about two things that stand on one Map.
    fn measurement(&self, name: &str, values: &[Value]) -> Option<Measurement> {
        let measured = MEASURED.iter().find(|measured| measured.name == name)?;
        let columns = || measured.columns.iter().zip(values);
        let length = columns().find_map(|((column, ..), value)| match value {
            Value::Number(number) if BETWEEN.contains(column) => Some(*number as f64 / IN_CM),
            _ => None,
        })?;
        let texts = columns().filter_map(|(_, value)| match value {
            Value::Symbol(text) => Some(&**text),
            _ => None,
        });
        let mut placed = texts.filter_map(|text| Some((text.to_owned(), self.outline(text)?)));
        let ((one, a), (other, b)) = (placed.next()?, placed.next()?);
        if a.map != b.map {
            return None;
        }
        let ends = a.nearest(&b, length);
        let (relation, map, of) = (name.to_owned(), a.map, [one, other]);
        Some(Measurement { relation, of, map, ends, length, text: None, fails: false })
    }

    /// What bears a name of the facts, as it lies on its Map.
    fn outline(&self, symbol: &str) -> Option<Outline> {
        let floors = self.floors().ok()?;
        let of_prisms = |prisms: &[crate::geometry::Prism]| {
            prisms.iter().map(|prism| prism.polygon.clone()).collect::<Vec<Polygon>>()
        };
        let subject = self.relations().ok()?.symbols().subject(symbol);
        floors.iter().find_map(|(&map, floor)| {
            let scene = floor.scene();
            let (polygons, is_room) = match subject {
                Some(Subject::Entity(Entity::Replica(id))) => {
                    (of_prisms(&scene.replicas.get(&id)?.prisms), false)
                }
                Some(Subject::Entity(Entity::Area(id))) => {
                    (of_prisms(&scene.areas.get(&id)?.prisms), true)
                }
                Some(Subject::Entity(Entity::Door(_))) | None => (vec![gap(floor, symbol)?], false),
                Some(_) => return None,
            };
            Some(Outline { map, polygons, is_room })
        })
    }
}

/// The gap of a door or passage of this name.
fn gap(floor: &FloorPlan, name: &str) -> Option<Polygon> {
    let mut all = floor.doorways().iter().chain(floor.blind_openings());
    let opening = all.find(|opening| opening.name == name)?;
    let ((from, to), depth) = (opening.span(), opening.gap);
    let corners = [(from, 0.0), (to, 0.0), (to, depth), (from, depth)];
    Some(Polygon::new(corners.map(|(along, across)| opening.at(along, across)).to_vec()))
}

/// Something as it lies on a Map.
struct Outline {
    map: MapId,
    polygons: Vec<Polygon>,
    /// Distances are measured from within, to one of its walls.
    is_room: bool,
}

impl Outline {
    fn edges(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        self.polygons.iter().flat_map(|polygon| polygon.edges())
    }

    fn holds(&self, p: Point) -> bool {
        !self.is_room && self.polygons.iter().any(|polygon| polygon.contains(p, 0.0))
    }

    /// The ends of the shortest line between two; of a room's walls it goes to the one that lies as far away as was measured.
    fn nearest(&self, other: &Self, measured: f64) -> [Point; 2] {
        let inside = self.edges().map(|(a, _)| a).find(|p| other.holds(*p));
        if let Some(p) = inside.or_else(|| other.edges().map(|(a, _)| a).find(|p| self.holds(*p))) {
            return [p, p];
        }
        let wanted = (self.is_room || other.is_room).then_some(measured);
        let mut best: Option<(f64, [Point; 2])> = None;
        for one in self.edges() {
            for two in other.edges() {
                let ends = between(one, two);
                let length = (ends[1] - ends[0]).norm();
                let off = wanted.map_or(length, |wanted| (length - wanted).abs());
                if best.is_none_or(|(least, _)| off < least) {
                    best = Some((off, ends));
                }
            }
        }
        best.map_or([Point::origin(); 2], |(_, ends)| ends)
    }
}

/// The points of two segments that do not cross that are nearest to each other.
fn between((a, b): (Point, Point), (c, d): (Point, Point)) -> [Point; 2] {
    let onto = nearest_on_segment;
    let pairs = [[a, onto(a, c, d)], [b, onto(b, c, d)], [onto(c, a, b), c], [onto(d, a, b), d]];
    let length = |[p, q]: &[Point; 2]| (q - p).norm();
    pairs.into_iter().min_by(|x, y| length(x).total_cmp(&length(y))).expect("there are four")
}

/// What a reason speaks of, gathered.
struct Found<'s> {
    state: &'s State,
    about: Vec<String>,
    /// Measured facts, and whether a condition on them fails.
    facts: Vec<(String, Vec<Value>, bool)>,
}

impl Found<'_> {
    fn names(&mut self, values: &[Value]) {
        let Ok(relations) = self.state.relations() else { return };
        for value in values {
            if let Value::Symbol(text) = value
                && matches!(relations.symbols().subject(text), Some(Subject::Entity(_)))
            {
                self.about.push(text.to_string());
            }
        }
    }

    fn of_proof(&mut self, proof: &Proof) {
        for step in &proof.steps {
            self.names(&step.fact.values);
            if step.because == Because::Told {
                self.facts.push((step.fact.name.clone(), step.fact.values.clone(), false));
            }
        }
    }

    /// Measurements that hold, with what failed of those that the rule compared.
    fn of_failed(&mut self, rule: &FailedRule) {
        let fails = |(premise, holds): &(Premise, Option<bool>)| {
            *holds == Some(false) && matches!(premise, Premise::Compared { .. })
        };
        let fails = rule.premises.iter().any(fails);
        for (premise, holds) in &rule.premises {
            let (Premise::Pattern { name, values } | Premise::Absent { name, values }) = premise
            else {
                continue;
            };
            let known: Vec<Value> = values.iter().flatten().cloned().collect();
            self.names(&known);
            if *holds == Some(true) && known.len() == values.len() {
                self.facts.push((name.clone(), known, fails));
            }
        }
        for (_, below) in &rule.below {
            match below {
                Below::Missing(rule) => self.of_failed(rule),
                Below::There(proof) => self.of_proof(proof),
            }
        }
    }
}
