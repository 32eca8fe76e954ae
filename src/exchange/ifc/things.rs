//! Furniture, fixtures, equipment and free-standing columns → things.
//!
//! Bodies of a thing that stand in one another become one solid over their common footprint; bodies over or beside one
//! another – a table's top and its legs – stay apart. Like things share a kind: what makes them alike is what shape
//! they show and how it is turned against their own front, so that a shape of which there are a thousand is worked out
//! once.

use std::collections::{HashMap, HashSet};

use crate::assemble::ring::{Region, Ring, common};
use crate::map::{Permeability, Properties};
use crate::units::{Bilingual, Cm, Deg, InOrder as _, Point, said, word};
use crate::{Kind, Part, Thing, Treatment, What, outline};

use super::body::{Body, area, hull, rings, together};
use super::building::{Reader, source};
use super::classes::{Becomes, TYPES};
use super::place::Place;
use super::shape::{Else, Key, Shapes, Source};
use super::step::Instance;

const MOST_THINGS: usize = 200_000;
/// Solids of one thing; with more of them they become one.
const MOST_PARTS: usize = 12;
/// Bodies of one thing that are looked at apart.
const MOST_BODIES: usize = 40;
/// Solids have this much of their height in common before they can stand in one another, in cm.
const TOUCH: f64 = 0.5;
/// Common floor of two solids that stand in one another, in cm².
const LEAST_COMMON: f64 = 0.5;
/// A solid with less floor than this, in cm², is a fitting, where there are larger ones.
const LEAST_PART: f64 = 4.0;
/// Outlines with more corners than this lose those that stand out by less than [`FLAT`].
const MANY_CORNERS: usize = 24;
const FLAT: f64 = 0.5;
/// Of a thing whose floor is drawn and whose height is not told, in cm: what stands on the floor bars the way.
const USUAL_HEIGHT: f64 = 75.0;
/// What stands within this of the floor stands on it, in cm.
const ON_FLOOR: f64 = 1.0;
/// Predefined types that name nothing.
const NO_WORD: [&str; 6] = ["NOTDEFINED", "USERDEFINED", "COMPLEX", "ELEMENT", "PARTIAL", "UNSET"];

/// A prism of a thing, in the thing's own frame.
#[derive(Debug, Clone, PartialEq)]
struct Solid {
    floor: Vec<Region>,
    low: f64,
    high: f64,
}

/// What a shape comes to.
#[derive(Debug, Clone)]
struct Look {
    /// None where nothing of the shape could be read.
    parts: Vec<Part>,
    /// Of the lowest part, above the thing's origin.
    bottom: f64,
    /// What is not as in the file.
    doubt: Option<Bilingual>,
}

impl Reader<'_> {
    pub(super) fn things(&mut self) {
        let mut looks = HashMap::<Key, Look>::new();
        let mut kinds = HashMap::<String, usize>::new();
        let things = self.elements(Becomes::Thing);
        let pillars = self.elements(Becomes::Pillar);
        let all = self.all;
        let steps = std::mem::take(&mut self.steps);
        let steps = steps.into_iter().filter_map(|id| Some((id, all.get(id)?, false)));
        let every: Vec<(u32, &Instance, bool)> = things
            .into_iter()
            .map(|(id, r)| (id, r, false))
            .chain(pillars.into_iter().map(|(id, r)| (id, r, true)))
            .chain(steps)
            .collect();
        // What consists of other things is those things.
        let wholes: HashSet<u32> =
            every.iter().filter_map(|(id, ..)| self.wholes.get(id)).copied().collect();
        let (mut within, mut of_stairs) = (HashMap::<&str, usize>::new(), HashMap::new());
        for (no, (id, thing, is_pillar)) in every.into_iter().enumerate() {
            let source = source(thing, id);
            if no >= MOST_THINGS {
                self.lose(What::Thing, &source, word!("there-are-too-many-things"));
                continue;
            }
            if is_pillar && self.is_of_stairs(id) {
                *of_stairs.entry(thing.kind).or_default() += 1;
                continue;
            }
            if ["PROVISIONFORVOID", "PROVISIONFORSPACE"]
                .iter()
                .any(|w| thing.at(8).word() == Some(w))
            {
                let text = word!("this-provides-for-an-opening");
                self.tell((Treatment::Noted, What::Thing), (1, 0), &source, text);
                continue;
            }
            let place = self.place_of(thing);
            let key = self.shapes.key(thing.at(6), &place.unturned());
            let look = looks.entry(key).or_insert_with(|| look(&mut self.shapes, thing, &place));
            let look = look.clone();
            if look.parts.is_empty() && wholes.contains(&id) {
                let text = word!("it-consists-of-other-things");
                self.tell((Treatment::Noted, What::Thing), (1, 1), &source, text);
                continue;
            }
            if is_pillar && !self.stands_free(id, &place, &look) {
                *within.entry(thing.kind).or_default() += 1;
                continue;
            }
            if look.parts.is_empty() && thing.at(5).reference().is_none() {
                self.lose(What::Thing, &source, word!("it-is-told-neither-where"));
                continue;
            }
            self.thing(id, thing, &place, look, &mut kinds);
        }
        let told = [
            (within, (1, 0), word!("they-stand-in-walls-and")),
            (of_stairs, (1, 1), word!("parts-of-stairs-the-stairs")),
        ];
        for (counts, (found, taken), why) in told {
            let mut counts: Vec<_> = counts.into_iter().collect();
            counts.order();
            for (kind, n) in counts {
                let text = said!("counted", count = n, why);
                let count = (n * found, n * taken);
                self.tell((Treatment::Noted, What::Thing), count, kind, text);
            }
        }
    }

    /// Whether most corners of a column stand on the floor of rooms.
    fn stands_free(&mut self, id: u32, place: &Place, look: &Look) -> bool {
        let frame = frame(place);
        let level = self.level_of(id, place.origin.z + look.bottom);
        let corners: Vec<Point> =
            look.parts.iter().flat_map(|p| &p.outline).map(|p| frame.apply(*p)).collect();
        let free = corners.iter().filter(|p| !self.rooms_at(level, **p).is_empty()).count();
        free > 0 && 2 * free >= corners.len()
    }

    fn thing(
        &mut self,
        id: u32,
        thing: &Instance,
        place: &Place,
        look: Look,
        kinds: &mut HashMap<String, usize>,
    ) {
        let source_id = source(thing, id);
        let frame = frame(place);
        let at = Point::new(frame.x.get(), frame.y.get());
        let is_far = Cm::new(place.origin.x).is_err() || Cm::new(place.origin.y).is_err();
        let bottom = place.origin.z + look.bottom;
        let level = self.level_of(id, bottom);
        let raised = Cm::new(bottom - self.survey.levels[level].elevation.get());
        let (false, Ok(raised)) = (is_far, raised) else {
            return self.lose(What::Thing, &source_id, word!("it-stands-outside-of-any"));
        };
        if let Some(doubt) = look.doubt {
            self.tell((Treatment::Mended, What::Thing), (0, 0), &source_id, doubt);
        }
        let word = self.word(id, thing);
        let key = format!("{word} {:?}", look.parts);
        let all_kinds = &mut self.survey.kinds;
        let kind = *kinds.entry(key).or_insert_with(|| {
            let source = format!("{word} {}", all_kinds.len() + 1);
            all_kinds.push(Kind { source, word, parts: look.parts, ..Kind::default() });
            all_kinds.len() - 1
        });
        // Contained in a space, it is in that room.
        let room = self.parents.get(&id).and_then(|s| self.rooms.get(s)).filter(|r| r.0 == level);
        let room = room.map(|r| r.1);
        let mut properties = Properties::new();
        properties.extend(thing.at(2).text().map(|n| ("ifc:Name".to_owned(), n.to_owned())));
        self.survey.levels[level].things.push(Thing {
            source: source_id,
            name: String::new(),
            kind,
            at,
            // What a modeller set a hair into the floor stands on it.
            z: Some(raised).filter(|z| z.get().abs() > ON_FLOOR).unwrap_or(Cm::ZERO),
            angle: frame.angle,
            room,
            move_prob: None,
            properties,
        });
    }

    /// What a thing is: `M_Desk:1525 x 762mm:123456` is a Desk.
    fn word(&self, id: u32, thing: &Instance) -> String {
        let said = |w: &&str| !NO_WORD.contains(w);
        let own_type = self.type_of(id);
        let of_type = own_type.and_then(|t| {
            let at = TYPES.iter().find(|(kind, _)| *kind == t.kind).map(|(_, at)| *at)?;
            t.at(at).word().filter(said)
        });
        // A proxy's predefined type is none.
        let is_proxy = thing.kind == "IFCBUILDINGELEMENTPROXY";
        let own = thing.at(8).word().filter(said).filter(|_| !is_proxy);
        let named = own_type.and_then(|t| t.at(2).text().or(t.at(8).text()));
        let texts = named.or(thing.at(4).text()).or(thing.at(2).text());
        let class = words_of(thing.kind);
        let told = own.or(of_type).or(texts).unwrap_or(&class);
        let family = told.split(':').next().unwrap_or_default().trim();
        let word = family.strip_prefix("M_").unwrap_or(family);
        let word = if word.is_empty() { class.as_str() } else { word };
        word.chars().take(100).collect()
    }
}

/// `IFCSPACEHEATER` → `spaceheater`.
fn words_of(kind: &str) -> String {
    kind.strip_prefix("IFC").unwrap_or(kind).to_lowercase()
}

fn frame(place: &Place) -> crate::units::Frame {
    let x = Cm::new(place.origin.x).unwrap_or(Cm::ZERO);
    let y = Cm::new(place.origin.y).unwrap_or(Cm::ZERO);
    let degrees = (place.heading().to_degrees() * 1e6).round() / 1e6;
    crate::units::Frame { x, y, z: Cm::ZERO, angle: Deg::of(degrees) }
}

/// The parts of a thing's shape.
fn look(shapes: &mut Shapes<'_>, thing: &Instance, place: &Place) -> Look {
    let (bodies, from) = shapes.of_product(thing.at(6), &place.unturned(), Else::Box);
    let mut doubt = match from {
        Source::Body if bodies.is_empty() => Some(said!("there-is-no-body-that")),
        Source::Body if bodies.iter().any(|b| b.is_round) => {
            Some(said!("a-body-with-curved-faces"))
        }
        Source::Body => None,
        Source::Box => Some(said!("there-is-no-body-its")),
        Source::Footprint => Some(said!("no-body-but-outline", height = USUAL_HEIGHT)),
    };
    let mut solids = solids(&bodies, shapes);
    if from == Source::Footprint {
        solids.iter_mut().for_each(|s| s.high = s.low + USUAL_HEIGHT);
    }
    let bottom = solids.iter().map(|s| s.low).min_by(f64::total_cmp).unwrap_or(0.0);
    let hundredth = |x: f64| (x * 100.0).round() / 100.0;
    let mut parts = Vec::new();
    for (solid, outer) in solids.iter().flat_map(|s| s.floor.iter().map(move |f| (s, &f.outer))) {
        let ring = outer.iter().map(|p| Point::new(hundredth(p.x), hundredth(p.y)));
        let Some(outline) = outline::ring(lighter(ring.collect())) else { continue };
        let measures =
            (Cm::new(hundredth(solid.low - bottom)), Cm::new(hundredth(solid.high - solid.low)));
        if let (true, (Ok(bottom), Ok(height))) = (outline.len() <= outline::MOST_CORNERS, measures)
        {
            let permeability = Permeability::Impermeable;
            parts.push(Part { word: String::new(), outline, bottom, height, permeability });
        }
    }
    if parts.is_empty() && !bodies.is_empty() {
        doubt = Some(said!("the-body-has-no-volume"));
    }
    Look { parts, bottom, doubt }
}

/// Without corners that hardly stand out, where there are many.
pub(super) fn lighter(mut ring: Ring) -> Ring {
    if ring.len() <= MANY_CORNERS {
        return ring;
    }
    let mut i = 0;
    let mut left = ring.len();
    // Once round; a corner that goes takes its neighbours' place in the next look.
    while left > 0 && ring.len() > 8 {
        let n = ring.len();
        let (a, p, b) = (ring[(i + n - 1) % n], ring[i % n], ring[(i + 1) % n]);
        let near = crate::geometry::nearest_on_segment(p, a, b);
        if (near - p).norm() < FLAT && (b - a).norm() < 50.0 {
            ring.remove(i % n);
        }
        i += 1;
        left -= 1;
        if i >= ring.len() {
            i = 0;
        }
    }
    ring
}

/// Bodies as solids of which none stands in another.
fn solids(bodies: &[Body], shapes: &mut Shapes<'_>) -> Vec<Solid> {
    let mut solids: Vec<Solid> = Vec::new();
    for body in bodies {
        let Some((low, high)) = body.heights() else { continue };
        let floor = body.footprint(&mut shapes.effort);
        if !floor.is_empty() {
            solids.push(Solid { floor, low, high });
        }
    }
    let largest = solids.iter().map(|s| area(&s.floor)).fold(0.0, f64::max);
    if largest > LEAST_PART {
        solids.retain(|s| area(&s.floor) > LEAST_PART);
    }
    if solids.len() > MOST_BODIES {
        return one_of(solids, shapes);
    }
    // A solid that has taken in another may now reach into a third.
    'again: loop {
        for i in 0..solids.len() {
            for j in i + 1..solids.len() {
                if meet(&solids[i], &solids[j], shapes) {
                    let other = solids.remove(j);
                    let one = solids.remove(i);
                    solids.extend(one_of(vec![one, other], shapes));
                    continue 'again;
                }
            }
        }
        break;
    }
    let parts: usize = solids.iter().map(|s| s.floor.len()).sum();
    if parts <= MOST_PARTS {
        return solids;
    }
    let mut one = one_of(solids, shapes);
    if let Some(solid) = one.first_mut().filter(|s| s.floor.len() > MOST_PARTS) {
        solid.floor = hull(&rings(&solid.floor).concat());
    }
    one
}

/// One solid over all that some take up.
fn one_of(solids: Vec<Solid>, shapes: &mut Shapes<'_>) -> Vec<Solid> {
    let low = solids.iter().map(|s| s.low).fold(f64::INFINITY, f64::min);
    let high = solids.iter().map(|s| s.high).fold(f64::NEG_INFINITY, f64::max);
    let floors: Vec<Region> = solids.into_iter().flat_map(|s| s.floor).collect();
    let mut floor = together(&floors, &mut shapes.effort);
    // Crumbs between larger pieces are fittings.
    let largest = floor.iter().map(Region::area).fold(0.0, f64::max);
    floor.retain(|r| r.area() > LEAST_PART || largest <= LEAST_PART);
    if floor.is_empty() { Vec::new() } else { vec![Solid { floor, low, high }] }
}

fn meet(one: &Solid, other: &Solid, shapes: &mut Shapes<'_>) -> bool {
    if one.high.min(other.high) - one.low.max(other.low) <= TOUCH {
        return false;
    }
    one.floor.iter().any(|a| {
        other.floor.iter().any(|b| {
            let (a_low, a_high) = outline::bounds(&a.outer);
            let (b_low, b_high) = outline::bounds(&b.outer);
            let is_apart = a_high.x <= b_low.x
                || b_high.x <= a_low.x
                || a_high.y <= b_low.y
                || b_high.y <= a_low.y;
            if is_apart {
                return false;
            }
            !shapes.effort.allows(a.outer.len() + b.outer.len()) || common(a, b).0 > LEAST_COMMON
        })
    })
}
