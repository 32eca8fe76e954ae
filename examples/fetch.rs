//! A robot's program in twenty lines: open a store, import a map, ask, plan and drive, hear where it is.

#![expect(clippy::print_stdout, reason = "an example shows what it finds")]

use std::error::Error;
use std::path::Path;

use orthoframe::engine::{Dialogue, Method, change_now};
use orthoframe::{Engine, Language};

fn main() -> Result<(), Box<dyn Error>> {
    let dir = tempfile::tempdir()?;
    let mut engine = Engine::open(&dir.path().join("store"), None)?;
    let map = Path::new(env!("CARGO_MANIFEST_DIR")).join("maps/rb2.toml");
    engine.import(&map, &change_now("operator", "survey"))?;

    // What lies on the table? Either name of a relation serves.
    for (relation, fact) in engine.facts(Some("ON_TOP_OF"), Some("Стол-1"))? {
        println!("{} {relation} {}", fact[0], fact[1]);
    }
    let way = engine.route("Точка-А", "Комната-Y", Method::Shortest)?;
    match &way.route {
        Ok(route) => println!("{:.1} м", route.length / 100.0),
        Err(_) => println!(
            "{}",
            way.no_way_in_words(engine.world()?, Language::Russian).unwrap_or_default()
        ),
    }

    let mut dialogue = Dialogue::default();
    for line in ["Где лекарство?", "Принеси его", "What did you do?"] {
        dialogue.hear(&mut engine, line, &mut |_, event| {
            event.in_words().iter().for_each(|told| println!("{told}"));
        })?;
    }
    Ok(())
}
