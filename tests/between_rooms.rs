//! What is between two rooms: the doors and passages that join them, and where none does, the way that leads through others;
//! never "nothing".

use std::collections::BTreeSet;

use orthoframe::engine::Memory;
use orthoframe_language::Case;
use orthoframe_language::names::named;
use orthoframe_language::question::Said;
use orthoframe_map::Entity;
use orthoframe_semantics::{RelationRules, derive};

use crate::talk::engine;

const MAPS: [&str; 5] = [
    "maps/rb2.toml",
    "../shared/data/procthor/house_4.json",
    "../shared/data/procthor/house_6.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
    "../shared/data/rmf/office.building.yaml",
];

#[test]
fn between_two_rooms_is_what_joins_them_or_the_way() {
    let (mut joined, mut apart) = (0, 0);
    for map in MAPS {
        let Some(engine) = engine(map) else { continue };
        let world = engine.world().unwrap();
        let relations = derive(world, &RelationRules::standard(), world.domain.profile).unwrap();
        let joins = relations.joins();
        let rooms: BTreeSet<_> = joins.iter().map(|join| join.from).collect();
        for (a, b) in rooms.iter().flat_map(|a| rooms.range(..a).map(move |b| (*a, *b))) {
            let [one, other] = [a, b].map(|id| named(world, Entity::Area(id)));
            let [first, second] = [&one, &other].map(|room| room.phrase().case(Case::Instrumental));
            for question in [
                format!("Что находится между {first} и {second}?"),
                format!("What is between {} and {}?", one.english(), other.english()),
                format!("What's there between {} and {}?", one.english(), other.english()),
            ] {
                let answer = engine.ask(&question, &mut Memory::default()).unwrap();
                let answer = answer.unwrap_or_else(|doubt| panic!("{question}: {}", doubt.text));
                let own = joins.iter().filter(|j| (j.from, j.to) == (a, b));
                let openings: BTreeSet<String> = own.map(|j| j.opening.clone()).collect();
                let found: BTreeSet<String> = answer.symbols.iter().cloned().collect();
                assert_eq!(found, openings, "{question}: {}", answer.text);
                if !openings.is_empty() {
                    joined += 1;
                    continue;
                }
                apart += 1;
                assert_eq!(answer.said, Said::Nothing, "{question}: {}", answer.text);
                let way = ["путь", "the way"].iter().any(|way| answer.text.contains(way));
                assert!(way, "{question}: {}", answer.text);
            }
        }
    }
    assert!(joined > 20 && apart > 10, "{joined} {apart}");
}
