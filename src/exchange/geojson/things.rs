//! Furniture and columns: a polygon on the floor and a height.

use std::collections::HashMap;

use crate::map::Permeability;
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
}

impl Reader {
    pub(super) fn thing(&mut self, feature: &Feature, word: &str) {
        self.things.count += 1;
        if self.things.count > MOST_THINGS {
            return self.count(feature, &super::Class::Unknown);
        }
        let Some((ring, _)) = self.rings(feature).into_iter().next() else { return };
        let is_column = word == "column";
        let told = feature.number(&["height", "высота"]).filter(|h| (0.01..=20.0).contains(h));
        let usual = if is_column { COLUMN_HEIGHT } else { USUAL_HEIGHT };
        let height = told.map_or(usual, |metres| metres * 100.0);
        let raised = feature.number(&["min_height", "elevation_above_floor"]);
        let bottom = raised.filter(|h| (0.0..=20.0).contains(h)).map_or(0.0, |m| m * 100.0);
        let (origin, _) = outline::bounds(&ring);
        // To the tenth of a millimetre: two chairs of one catalogue differ by less.
        let part: Vec<Point> = ring
            .iter()
            .map(|p| Point::from((p - origin).map(|x| (x * 100.0).round() / 100.0)))
            .collect();
        let known = format!("{word} {height} {bottom} {part:?}");
        let kinds = &mut self.things.kinds;
        let kind = *self.things.known.entry(known).or_insert_with(|| {
            kinds.push(Kind {
                source: format!("{word} {}", kinds.len() + 1),
                word: word.to_owned(),
                parts: vec![Part {
                    word: String::new(),
                    outline: part,
                    bottom: Cm::of(bottom),
                    height: Cm::of(height),
                    permeability: Permeability::Impermeable,
                }],
                ..Kind::default()
            });
            kinds.len() - 1
        });
        let name = self.tongue.name(feature).unwrap_or_default();
        for level in self.levels.of_feature(feature) {
            self.survey.levels[level].things.push(Thing {
                source: feature.id.clone(),
                name: name.clone(),
                kind,
                at: origin,
                z: Cm::ZERO,
                angle: Deg::ZERO,
                room: None,
                move_prob: is_column.then_some(0),
                properties: properties(feature),
            });
        }
    }
}
