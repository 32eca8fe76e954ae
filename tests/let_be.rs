//! Orders that tell of each place, or of a place where all is to be let be: as many things as are said, and none of those.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::command::Command;
use orthoframe_language::{Case, Gender, NounPhrase, Number, WordHints, english};
use orthoframe_map::{Area, Entity, World};
use orthoframe_units::ReplicaId;

use crate::talk::engine;

const HOUSES: [&str; 3] = [
    "../shared/data/procthor/house_1.json",
    "../shared/data/procthor/house_2.json",
    "../shared/data/procthor/house_6.json",
];

/// What an order is done to; none where it is refused.
fn done_to(engine: &Engine, order: &str) -> Option<BTreeSet<ReplicaId>> {
    let commands = engine.understand_in(order, &mut Memory::default()).ok()?;
    let of = |entity| if let Entity::Replica(id) = entity { Some(id) } else { None };
    Some(commands.iter().filter_map(|command| of(command.what()?.id)).collect())
}

/// A kind by its forms: "pen", "pens", «ручки», «ручке», and how one is counted in the dative.
struct Kind {
    en: String,
    many_en: String,
    many: String,
    to_one: String,
    one: &'static str,
}

/// The kinds of what can be carried and of which there are several.
fn kinds(world: &World) -> Vec<Kind> {
    let mut count: BTreeMap<_, usize> = BTreeMap::new();
    for thing in world.replicas.values().filter(|r| world.has_trait(r.id, "portable")) {
        *count.entry(world.objects[&thing.object].object_type).or_default() += 1;
    }
    let several = count.into_iter().filter(|(_, count)| *count > 1);
    let kinds = several.filter_map(|(kind, _)| world.types.object.get(kind));
    kinds
        .map(|kind| {
            let phrase = NounPhrase::parse(&kind.name.to_lowercase(), &WordHints::default());
            Kind {
                en: kind.name_en.to_lowercase(),
                many_en: english::plural(&kind.name_en.to_lowercase()),
                many: phrase.form(Case::Accusative, Number::Plural),
                to_one: phrase.form(Case::Dative, Number::Singular),
                one: match phrase.gender() {
                    Gender::Feminine => "одной",
                    Gender::Masculine | Gender::Neuter => "одному",
                },
            }
        })
        .collect()
}

fn in_case(area: &Area, case: Case) -> String {
    let hints = WordHints::default();
    NounPhrase::parse(&area.name.to_lowercase(), &hints).form(case, Number::Singular)
}

/// Tries every kind of every house with all that are brought of it; how often something was tried, none where the houses
/// are not there.
fn of_each_kind(
    mut tries: impl FnMut(&Engine, &Kind, &BTreeSet<ReplicaId>) -> usize,
) -> Option<usize> {
    let mut told = 0;
    for map in HOUSES {
        let engine = engine(map)?;
        for kind in kinds(engine.world().unwrap()) {
            if let Some(all) = done_to(&engine, &format!("Bring all the {}", kind.many_en)) {
                told += tries(&engine, &kind, &all);
            }
        }
    }
    Some(told)
}

/// «Принеси все ручки, а в спальне не надо»: all but those that are there.
#[test]
fn what_is_let_be_in_a_room_stays_there() {
    let told = of_each_kind(|engine, kind, all| {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        let mut told = 0;
        for area in world.areas.values() {
            let (there, elsewhere): (BTreeSet<_>, BTreeSet<_>) =
                all.iter().partition(|id| relations.area_of(**id) == Some(area.id));
            if there.is_empty() || elsewhere.is_empty() {
                continue;
            }
            let (many, many_en) = (&kind.many, &kind.many_en);
            let (inside, out) = (in_case(area, Case::Locative), in_case(area, Case::Genitive));
            let room = area.name_en.to_lowercase();
            for order in [
                format!("Принеси все {many}, а из {out} не надо"),
                format!("Принеси все {many}, а в {inside} не надо"),
                format!("Принеси все {many}, только не надо из {out}"),
                format!("Bring all the {many_en}, in the {room} no need"),
                format!("Bring all the {many_en}, but not from the {room}"),
            ] {
                let Some(taken) = done_to(engine, &order) else { continue };
                assert_eq!(taken, elsewhere, "{order}");
                told += 1;
            }
        }
        told
    });
    assert!(told.is_none_or(|told| told > 60), "{told:?}");
}

/// "Bring one pen from each room", «по одной ручке из каждой комнаты»: one of those in each room that has any.
#[test]
fn one_from_each_room_is_one_of_each() {
    let told = of_each_kind(|engine, kind, all| {
        let relations = engine.relations().unwrap();
        let rooms = |things: &BTreeSet<ReplicaId>| -> BTreeSet<_> {
            things.iter().map(|id| relations.area_of(*id)).collect()
        };
        let mut told = 0;
        for order in [
            format!("Bring one {} from each room", kind.en),
            format!("Bring a {} from every room", kind.en),
            format!("Принеси по {} {} из каждой комнаты", kind.one, kind.to_one),
        ] {
            let Some(taken) = done_to(engine, &order) else { continue };
            assert!(taken.is_subset(all), "{order}: {taken:?}");
            assert_eq!(rooms(&taken), rooms(all), "{order}");
            assert_eq!(taken.len(), rooms(all).len(), "{order}");
            told += 1;
        }
        told
    });
    assert!(told.is_none_or(|told| told > 40), "{told:?}");
}

/// "The other pens": all but those that were spoken of; before any was, they are none.
#[test]
fn others_are_other_than_something() {
    let told = of_each_kind(|engine, kind, all| {
        let order = format!("Bring the other {}", kind.many_en);
        assert_eq!(done_to(engine, &order), None, "{order}");
        let mut memory = Memory::default();
        let one = format!("Bring one {}", kind.en);
        let Ok(first) = engine.understand_in(&one, &mut memory) else { return 0 };
        let Ok(rest) = engine.understand_in(&order, &mut memory) else { return 0 };
        let is_first = |command: &Command<Entity>| first[0].what() == command.what();
        assert!(rest.len() + 1 == all.len() && !rest.iter().any(is_first), "{order}: {rest:?}");
        1
    });
    assert!(told.is_none_or(|told| told > 10), "{told:?}");
}
