//! What is exported in our own notations.

use orthoframe_exchange::to_map_file;
use orthoframe_map::{Format, World};
use orthoframe_units::Source;

#[test]
fn every_notation_reads_back_as_the_same_world() {
    for name in ["rb2", "box", "room"] {
        let path = format!("{}/../../maps/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let world = World::load(path).expect("the examples are sound");
        for format in [Format::Toml, Format::Json, Format::Yaml] {
            let text = to_map_file(&world, format);
            let again = World::parse(&Source::new("copy", &text), format);
            assert_eq!(again.unwrap_or_else(|e| panic!("{e:#?}")), world, "{name} {format:?}");
        }
    }
}
