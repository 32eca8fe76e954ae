//! What the map does not tell is neither affirmed nor denied: values that it gives of some things alone, what is seen from
//! elsewhere, prices.

use std::collections::BTreeSet;

use orthoframe::engine::Memory;
use orthoframe_language::names::named;
use orthoframe_language::question::Said;
use orthoframe_language::{Gender, russian};
use orthoframe_map::Entity;
use orthoframe_semantics::{RelationRules, derive};

use crate::talk::engine;

const MAPS: [&str; 4] = [
    "maps/rb2.toml",
    "../shared/data/procthor/house_4.json",
    "../shared/data/procthor/house_6.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
];

/// "There are no plastic things in the kitchen" was told of a kitchen of whose 86 things no material is known.
#[test]
fn a_value_that_is_not_known_of_all_is_not_denied() {
    let (mut denied, mut left_open) = (0, 0);
    for map in MAPS {
        let Some(engine) = engine(map) else { continue };
        let world = engine.world().unwrap();
        let relations = derive(world, &RelationRules::standard(), world.domain.profile).unwrap();
        let has = relations.derived().tuples("HAS").expect("a relation of the rules");
        let has: BTreeSet<(String, String)> =
            has.filter_map(|t| Some((t.symbol(0)?.to_owned(), t.symbol(1)?.to_owned()))).collect();
        for (property, values) in [
            ("МАТЕРИАЛ", [("пластиковые", "plastic"), ("стеклянные", "glass")]),
            ("ЦВЕТ", [("зелёные", "green"), ("белые", "white")]),
        ] {
            for area in world.areas.keys() {
                let room = named(world, Entity::Area(*area));
                let own =
                    world.replicas.values().filter(|r| relations.area_of(r.id) == Some(*area));
                let told = |name: &str| has.contains(&(name.to_owned(), property.to_owned()));
                let all_told = own.map(|r| &r.name).all(|name| told(name));
                for (value, in_english) in values {
                    let place = russian::where_at(room.phrase());
                    for question in [
                        format!("Есть ли {place} {value} вещи?"),
                        format!("Are there any {in_english} things in {}?", room.english()),
                    ] {
                        let answer = engine.ask(&question, &mut Memory::default()).unwrap();
                        let Ok(answer) = answer else { continue };
                        let is_denied = matches!(answer.said, Said::No | Said::Nothing);
                        denied += usize::from(is_denied);
                        left_open += usize::from(answer.said == Said::Unknown);
                        assert!(all_told || !is_denied, "{question}: {}", answer.text);
                    }
                }
            }
        }
    }
    assert!(left_open > 20, "{left_open} {denied}");
}

/// "Is the television visible from the sofa?" was denied, as nothing is "out of the sofa".
#[test]
fn what_is_seen_from_elsewhere_is_not_told() {
    for map in MAPS {
        let Some(engine) = engine(map) else { continue };
        let world = engine.world().unwrap();
        let names: Vec<_> =
            world.replicas.keys().map(|id| named(world, Entity::Replica(*id))).collect();
        for pair in names.windows(2).step_by(5) {
            for question in [
                format!("Is {} visible from {}?", pair[0].english(), pair[1].english()),
                format!("Can you see {} from {}?", pair[0].english(), pair[1].english()),
            ] {
                let answer = engine.ask(&question, &mut Memory::default()).unwrap();
                assert!(answer.is_err(), "{question}: {}", answer.unwrap().text);
            }
        }
    }
}

/// «Сколько он стоит?» counted.
#[test]
fn a_price_is_no_count() {
    for map in MAPS {
        let Some(engine) = engine(map) else { continue };
        let world = engine.world().unwrap();
        for id in world.replicas.keys().step_by(7) {
            let called = named(world, Entity::Replica(*id));
            let mut memory = Memory::default();
            let asked = format!("Где {}?", called.phrase().name());
            if engine.ask(&asked, &mut memory).unwrap().is_err() {
                continue;
            }
            let it = match called.phrase().gender() {
                Gender::Masculine => "он",
                Gender::Feminine => "она",
                Gender::Neuter => "оно",
            };
            let question = format!("Сколько {it} стоит?");
            let Ok(answer) = engine.ask(&question, &mut memory).unwrap() else { continue };
            assert_eq!(answer.said, Said::Unknown, "{asked} {question}: {}", answer.text);
        }
    }
}

/// "Why isn't the mug clean?", of which the map tells nothing, is not affirmed: "by the map it is so".
#[test]
fn what_is_denied_of_the_unknown_is_not_affirmed() {
    let mut unknown = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { continue };
        let world = engine.world().unwrap();
        for replica in world.replicas.values().step_by(3) {
            let name = named(world, Entity::Replica(replica.id)).english().to_owned();
            for value in ["clean", "red", "switched on", "wooden"] {
                let asked = engine.ask(&format!("Is {name} {value}?"), &mut Memory::default());
                let Ok(plain) = asked.unwrap() else { continue };
                let why = engine.ask(&format!("Why isn't {name} {value}?"), &mut Memory::default());
                let Ok(why) = why.unwrap() else { continue };
                if plain.said == Said::Unknown {
                    assert!(
                        !why.text.starts_with("By the map it is so"),
                        "{name} {value}: {}",
                        why.text
                    );
                    unknown += 1;
                }
            }
        }
    }
    assert!(unknown > 20, "{unknown}");
}
