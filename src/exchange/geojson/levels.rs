//! Storeys: records of their own (IMDF), or a field of each feature (`level=0;1`, `floor`, `этаж`).

use std::collections::HashMap;

use crate::Level;
use crate::units::{Bilingual, Cm, InOrder as _, said};

use super::classify::Class;
use super::feature::{Feature, leading_number};
use super::names::Tongue;

/// Floor to floor, where the file tells no elevation.
const STOREY: f64 = 350.0;
/// More storeys than any building has; what lies beyond goes to the last.
const MOST: usize = 500;
const FIELDS: [&str; 12] = [
    "level_id",
    "level",
    "floor",
    "storey",
    "story",
    "floor_id",
    "level_name",
    "ordinal",
    "floor_number",
    "etage",
    "layer_level",
    "этаж",
];

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Storey {
    /// The file's id or number for it.
    pub key: String,
    pub name: String,
    pub ordinal: f64,
    /// In cm, where the file tells.
    pub elevation: Option<f64>,
}

impl Storey {
    pub(super) fn level(&self) -> Level {
        let elevation = self.elevation.unwrap_or(self.ordinal * STOREY);
        Level {
            source: self.key.clone(),
            name: self.name.clone(),
            elevation: Cm::new(elevation).unwrap_or(Cm::ZERO),
            ..Level::default()
        }
    }
}

/// The storeys of a file, lowest first.
#[derive(Debug)]
pub(super) struct Levels {
    pub list: Vec<Storey>,
    places: HashMap<String, usize>,
    /// By the id of an IMDF unit, for what names its units and no level: amenities.
    units: HashMap<String, usize>,
}

impl Levels {
    pub(super) fn of(features: &[Feature], classes: &[Class]) -> Self {
        let tongue = Tongue::of(features);
        let mut list: Vec<Storey> = Vec::new();
        let mut places = HashMap::<String, usize>::new();
        for (feature, class) in features.iter().zip(classes) {
            let is_level = *class == Class::Level;
            // IMDF refers to a level by its id; other files by the value of a common field.
            let keys = if is_level && !feature.feature_type.is_empty() {
                vec![feature.id.clone()]
            } else if is_level || holds(class) {
                keys_of(feature)
            } else {
                continue;
            };
            for key in keys {
                if let Some(&known) = places.get(&key) {
                    if is_level {
                        list[known].describe(feature, &tongue);
                    }
                } else if list.len() < MOST {
                    let ordinal = leading_number(&key).unwrap_or(list.len() as f64);
                    let name =
                        if key.len() < 24 { format!("Этаж {key}") } else { String::new() };
                    let mut storey = Storey { key: key.clone(), name, ordinal, elevation: None };
                    if is_level {
                        storey.describe(feature, &tongue);
                    }
                    places.insert(key, list.len());
                    list.push(storey);
                }
            }
        }
        if list.is_empty() {
            let name = "Этаж 0".to_owned();
            list.push(Storey { key: "0".to_owned(), name, ordinal: 0.0, elevation: Some(0.0) });
            places.insert("0".to_owned(), 0);
        }
        let mut order: Vec<usize> = (0..list.len()).collect();
        order.order_by(|&a, &b| list[a].ordinal.total_cmp(&list[b].ordinal));
        let mut rank = vec![0; list.len()];
        order.iter().enumerate().for_each(|(new, &old)| rank[old] = new);
        places.values_mut().for_each(|place| *place = rank[*place]);
        let list = order.into_iter().map(|old| list[old].clone()).collect();
        let mut levels = Self { list, places, units: HashMap::new() };
        let units = features.iter().filter(|f| f.feature_type == "unit" && !f.id.is_empty());
        let of_unit = |f: &Feature| Some((f.id.clone(), *levels.of_feature(f).first()?));
        levels.units = units.filter_map(of_unit).collect();
        levels
    }

    /// The storeys of a feature; the lowest at or above the ground when it says nothing.
    pub(super) fn of_feature(&self, feature: &Feature) -> Vec<usize> {
        let known: Vec<usize> =
            keys_of(feature).iter().filter_map(|key| self.places.get(key).copied()).collect();
        if known.is_empty() {
            let by_list = feature.properties.get("unit_ids").and_then(|ids| ids.as_array());
            let units = by_list.into_iter().flatten().chain(feature.properties.get("unit_id"));
            let mut of_units: Vec<usize> =
                units.filter_map(|id| self.units.get(id.as_str()?).copied()).collect();
            of_units.order();
            of_units.dedup();
            if !of_units.is_empty() {
                return of_units;
            }
            let ground = self.list.iter().position(|s| s.ordinal >= 0.0);
            return vec![ground.unwrap_or(self.list.len() - 1)];
        }
        known
    }

    /// What was assumed of the elevations.
    pub(super) fn assumed(&self) -> Option<Bilingual> {
        let bare = self.list.len() > 1 && self.list.iter().any(|s| s.elevation.is_none());
        bare.then(|| said!("storeys-without-heights", storey = STOREY))
    }
}

impl Storey {
    fn describe(&mut self, feature: &Feature, tongue: &Tongue) {
        if let Some(name) = tongue.name(feature) {
            self.name = name;
        }
        if let Some(ordinal) = feature.number(&["ordinal", "vertical_order", "level", "floor"]) {
            self.ordinal = ordinal;
        }
        if let Some(metres) = feature.number(&["elevation", "base_elevation", "ele", "отметка"])
        {
            self.elevation = Some(metres * 100.0);
        }
        if self.name.is_empty() {
            self.name = format!("Этаж {}", self.ordinal);
        }
    }
}

/// Whether a feature of this class stands on a storey.
fn holds(class: &Class) -> bool {
    use Class::{Column, Door, Passage, Room, Spot, Thing, Window};
    matches!(class, Room(_) | Door | Passage | Window | Thing(_) | Spot | Column)
}

/// `"0;1"`, `"0-2"`, `"-1"`, `3`: the storeys that a field names.
fn keys_of(feature: &Feature) -> Vec<String> {
    let Some(value) = feature.first(&FIELDS) else { return Vec::new() };
    let mut keys: Vec<String> = value.split([';', ',']).flat_map(range).collect();
    keys.truncate(MOST);
    keys.dedup();
    keys
}

fn range(text: &str) -> Vec<String> {
    let text = text.trim();
    let ends = text.char_indices().skip(1).find(|(_, c)| *c == '-').and_then(|(at, _)| {
        let (from, to) = (text[..at].trim().parse::<i32>(), text[at + 1..].trim().parse::<i32>());
        from.ok().zip(to.ok())
    });
    match ends {
        Some((from, to)) if from <= to && to.saturating_sub(from) < MOST as i32 => {
            (from..=to).map(|n| n.to_string()).collect()
        }
        _ if text.is_empty() => Vec::new(),
        // 0 and 0.0 are one storey.
        _ => vec![text.parse::<f64>().map_or_else(|_| text.to_owned(), |n| (n + 0.0).to_string())],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_may_name_several_storeys() {
        assert_eq!(range("-2--1"), ["-2", "-1"]);
        assert_eq!(range("0-2"), ["0", "1", "2"]);
        assert_eq!(range("-1"), ["-1"]);
        assert_eq!(range("2.0"), ["2"]);
        assert_eq!(range("f3a1-77"), ["f3a1-77"]);
        assert_eq!(range("0-99999999"), ["0-99999999"]);
    }
}
