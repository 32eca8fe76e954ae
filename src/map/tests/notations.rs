//! One world in the notations that are read, and how it is written.

use orthoframe_map::{Format, World, json_schema};
use orthoframe_units::Source;

fn example(name: &str) -> World {
    let path = format!("{}/../../maps/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    World::load(path).expect("the examples are sound")
}

fn check_reads_back(world: &World, text: &str, format: Format) {
    let again = World::parse(&Source::new("copy", text), format);
    let again = again.unwrap_or_else(|e| panic!("{e:#?}\n{text}"));
    assert_eq!(again, *world, "{text}");
}

#[test]
fn one_world_in_three_notations() {
    for name in ["rb2", "box", "room"] {
        let world = example(name);
        let text = world.to_toml();
        check_reads_back(&world, &text, Format::Toml);
        let file: toml::Table = toml::from_str(&text).expect("it is TOML");
        let yaml = serde_saphyr::to_string(&file).expect("YAML can say it");
        check_reads_back(&world, &yaml, Format::Yaml);
        let json = serde_json::to_string_pretty(&file).expect("JSON can say it");
        check_reads_back(&world, &json, Format::Json);
        let in_tabs = json.replace("  ", "\t");
        check_reads_back(&world, &in_tabs, Format::Json);
    }
}

#[test]
fn a_replica_takes_one_line() {
    let text = example("rb2").to_toml();
    let chair = text.lines().find(|line| line.contains("Стул-3")).expect("rb2 has this chair");
    let line = "  { name = \"Стул-3\", object = \"chair\", at = [129, 332], name_en = \"Chair 3\", move_prob = 80, \
                    properties = { \"ЦВЕТ\" = \"Белый\" } },";
    assert_eq!(chair, line);
}

#[test]
fn the_schema_forbids_what_the_reader_refuses() {
    let schema = json_schema();
    for word in ["\"orthoframe\"", "\"replicas\"", "\"conditional\"", "\"hinged\"", "\"gender\""] {
        assert!(schema.contains(word), "{word}");
    }
    let tables = schema.matches("\"deny_unknown_fields\"").count()
        + schema.matches("\"additionalProperties\": false").count();
    assert!(tables >= 20, "{tables} closed tables");
}
