//! Furniture and columns: a polygon on the floor and a height; of what says `part_of`, a part of one thing with the others
//! that say the same.

use std::collections::HashMap;

use crate::map::{Permeability, Properties};
use crate::units::{Cm, Deg, Point};
use crate::{Kind, Part, Thing, outline};

use super::feature::Feature;
use super::{Reader, properties};

/// Of a thing whose height the file does not tell.
const USUAL_HEIGHT: f64 = 75.0;
/// Of a column, which stands from floor to ceiling.
const COLUMN_HEIGHT: f64 = 250.0;
const MOST_THINGS: usize = 200_000;

/// The kinds met so far: things of one word, outline and height are of one kind.
#[derive(Debug, Default)]
pub(super) struct Things {
    pub kinds: Vec<Kind>,
    known: HashMap<String, usize>,
    count: usize,
    /// Things of which every part is a feature of its own, in the order of their first parts.
    in_parts: Vec<Whole>,
    /// By what the parts say that they are of.
    by_name: HashMap<String, usize>,
}

/// A thing as its features tell it.
#[derive(Debug)]
struct Whole {
    source: String,
    word: String,
    name: String,
    levels: Vec<usize>,
    properties: Properties,
    bodies: Vec<Body>,
}

/// A prism on the level, in cm.
#[derive(Debug)]
struct Body {
    ring: Vec<Point>,
    bottom: f64,
    height: f64,
}

impl Reader {
    pub(super) fn thing(&mut self, feature: &Feature, word: &str) {
        self.things.count += 1;
        if self.things.count > MOST_THINGS {
            return self.count(feature, &super::Class::Unknown);
        }
        let Some((ring, _)) = self.rings(feature).into_iter().next() else { return };
        let told = feature.number(&["height", "высота"]).filter(|h| (0.01..=20.0).contains(h));
        let usual = if is_column(word) { COLUMN_HEIGHT } else { USUAL_HEIGHT };
        let height = told.map_or(usual, |metres| metres * 100.0);
        let raised = feature.number(&["min_height", "elevation_above_floor"]);
        let bottom = raised.filter(|h| (0.0..=20.0).contains(h)).map_or(0.0, |m| m * 100.0);
        let body = Body { ring, bottom, height };
        let whole = feature.text("part_of").map(std::borrow::Cow::into_owned);
        let known = whole.as_ref().and_then(|whole| self.things.by_name.get(whole));
        if let Some(&known) = known {
            return self.things.in_parts[known].bodies.push(body);
        }
        let thing = Whole {
            source: whole.clone().unwrap_or_else(|| feature.id.clone()),
            word: word.to_owned(),
            name: self.tongue.name(feature).unwrap_or_default(),
            levels: self.levels.of_feature(feature),
            properties: properties(feature),
            bodies: vec![body],
        };
        match whole {
            Some(whole) => {
                self.things.by_name.insert(whole, self.things.in_parts.len());
                self.things.in_parts.push(thing);
            }
            None => self.stand(&thing),
        }
    }

    /// Stands the things of which all parts have been met.
    pub(super) fn things_of_parts(&mut self) {
        for thing in std::mem::take(&mut self.things.in_parts) {
            self.stand(&thing);
        }
    }

    fn stand(&mut self, thing: &Whole) {
        let corners: Vec<Point> =
            thing.bodies.iter().flat_map(|body| body.ring.iter().copied()).collect();
        let (origin, _) = outline::bounds(&corners);
        // To the tenth of a millimetre: two chairs of one catalogue differ by less.
        let own = |p: &Point| Point::from((p - origin).map(|x| (x * 100.0).round() / 100.0));
        let part = |body: &Body| Part {
            word: String::new(),
            outline: body.ring.iter().map(own).collect(),
            bottom: Cm::of(body.bottom),
            height: Cm::of(body.height),
            permeability: Permeability::Impermeable,
        };
        let parts: Vec<Part> = thing.bodies.iter().map(part).collect();
        let word = &thing.word;
        let known = parts.iter().fold(word.clone(), |known, part| {
            known + &format!(" {} {} {:?}", part.height, part.bottom, part.outline)
        });
        let kinds = &mut self.things.kinds;
        let kind = *self.things.known.entry(known).or_insert_with(|| {
            let source = format!("{word} {}", kinds.len() + 1);
            kinds.push(Kind { source, word: word.clone(), parts, ..Kind::default() });
            kinds.len() - 1
        });
        for &level in &thing.levels {
            self.survey.levels[level].things.push(Thing {
                source: thing.source.clone(),
                name: thing.name.clone(),
                kind,
                at: origin,
                z: Cm::ZERO,
                angle: Deg::ZERO,
                room: None,
                move_prob: is_column(word).then_some(0),
                properties: thing.properties.clone(),
            });
        }
    }
}

fn is_column(word: &str) -> bool {
    word == "column"
}
