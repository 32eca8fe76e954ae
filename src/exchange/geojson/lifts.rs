//! Lifts and stairs by IMDF's relationships; where there are none, by the shafts.

use std::collections::BTreeSet;

use crate::{Lift, shafts};

use super::classify::Class;
use super::feature::Feature;
use super::{Reader, ids};
use crate::units::Gather as _;

impl Reader {
    pub(super) fn lifts(&mut self, features: &[Feature], classes: &[Class]) {
        for (feature, _) in features.iter().zip(classes).filter(|(_, c)| **c == Class::Relationship)
        {
            let p = &feature.properties;
            let one = |key: &str| {
                let id = p.get(key).and_then(|v| v.get("id").unwrap_or(v).as_str());
                id.map(str::to_owned)
            };
            let ends = one("origin").into_iter().chain(ids(p.get("intermediary")));
            let units = ends.chain(one("destination"));
            let stops: Vec<_> =
                units.filter_map(|id| self.room_places.get(&id)).flatten().copied().collect();
            let levels: BTreeSet<usize> = stops.iter().map(|s| s.0).gather();
            if levels.len() > 1 && levels.len() == stops.len() {
                let name = self.tongue.name(feature).unwrap_or_default();
                let source = feature.id.clone();
                self.survey.lifts.push(Lift { source, name, stops, is_told: true });
            }
        }
        shafts::join(&mut self.survey);
    }
}
