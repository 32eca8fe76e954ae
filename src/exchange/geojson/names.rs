//! Names in several languages: IMDF's labels `{"en": "Kitchen", "ru": "Кухня"}`, OpenStreetMap's `name:ru`.

use std::collections::BTreeMap;

use serde_json::Value;

use super::feature::Feature;
use crate::units::InOrder as _;

/// Which language of a label is shown: Russian, else the one that most labels of the file have, English before others.
#[derive(Debug, Clone)]
pub(super) struct Tongue(Vec<String>);

impl Tongue {
    pub(super) fn of(features: &[Feature]) -> Self {
        let mut counts = BTreeMap::<&str, usize>::new();
        for label in features.iter().filter_map(|f| f.properties.get("name")?.as_object()) {
            for language in label.keys() {
                *counts.entry(language).or_default() += 1;
            }
        }
        let mut order: Vec<&str> = counts.keys().copied().collect();
        let rank = |language: &str| match language.split('-').next() {
            Some("ru") => 0,
            Some("en") => 1,
            _ => 2,
        };
        order.order_by_key(|l| (rank(l), std::cmp::Reverse(counts[l])));
        Self(order.into_iter().map(str::to_owned).collect())
    }

    /// The name of a feature in the preferred language.
    pub(super) fn name(&self, feature: &Feature) -> Option<String> {
        let from_label = |key: &str| {
            let label = feature.properties.get(key)?.as_object()?;
            let in_order = self.0.iter().filter_map(|l| label.get(l));
            in_order.chain(label.values()).find_map(text)
        };
        const KEYS: [&str; 12] = [
            "name:ru",
            "name",
            "title",
            "label",
            "ref",
            "room_number",
            "number",
            "room_name",
            "short_name",
            "название",
            "имя",
            "номер",
        ];
        from_label("name")
            .or_else(|| feature.first(&KEYS).map(|n| n.trim().to_owned()))
            .or_else(|| from_label("alt_name"))
            .or_else(|| from_label("short_name"))
            .filter(|n| !n.is_empty())
            .map(|n| n.chars().take(200).collect())
    }
}

fn text(value: &Value) -> Option<String> {
    value.as_str().map(str::trim).filter(|t| !t.is_empty()).map(str::to_owned)
}

/// The labels of a feature as properties `name:en`, `name:de`.
pub(super) fn other_languages(feature: &Feature) -> impl Iterator<Item = (String, String)> + '_ {
    let labels = feature.properties.get("name").and_then(Value::as_object).into_iter().flatten();
    labels.take(16).filter_map(|(language, name)| Some((format!("name:{language}"), text(name)?)))
}
