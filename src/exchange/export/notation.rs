//! The whole map as a map file in one of its notations: TOML, YAML, JSON.

use crate::map::{Format, World};

/// The map file of a world. Reading it gives the same world, ids included.
///
/// # Panics
/// When the world refers to what it does not hold; a checked world does not.
#[must_use]
pub fn to_map_file(world: &World, format: Format) -> String {
    let text = world.to_toml();
    let table = || -> toml::Table { text.parse().expect("a map file is TOML") };
    match format {
        Format::Toml => text,
        Format::Json => serde_json::to_string_pretty(&table()).expect("JSON can say what TOML can"),
        Format::Yaml => serde_saphyr::to_string(&table()).expect("YAML can say what TOML can"),
    }
}
