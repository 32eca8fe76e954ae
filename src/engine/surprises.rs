//! What went otherwise than believed, in words.

use super::located::spot_in_words;
use crate::geometry::Remedy;
use crate::language::{Case, Language, enumerate};
use crate::map::{Entity, World};
use crate::robot::{Barred, Obstruction, Refusal, Sighting, Surprise};
use crate::units::told;

use super::advice::Advice;
use super::barriers::{no_way_in_words, thing_in_words, unknown_thing};
use super::directive_words::{name_in, place_in_words};
use super::lexicon::named;

/// What stood in the way, what the vehicle would not do, or what the map does not know.
#[must_use]
pub(super) fn surprise_in_words(world: &World, surprise: &Surprise, language: Language) -> String {
    let form = |entity: Entity, case: Case| named(world, entity).form(case, language);
    let said = |entity: Entity| form(entity, Case::Nominative);
    let in_case = |what: Obstruction, case: Case| match what {
        Obstruction::Wall(area) => told!(language, "a-wall-of", said = said(Entity::Area(area))),
        Obstruction::Door(door) => form(Entity::Door(door), case),
        Obstruction::Replica(id) if world.replicas.contains_key(&id) => {
            form(Entity::Replica(id), case)
        }
        Obstruction::Replica(_) | Obstruction::Something => match case {
            Case::Genitive | Case::Prepositional => told!(language, "a-thing-genitive"),
            _ => told!(language, "a-thing"),
        },
    };
    let thing = |what: Obstruction| in_case(what, Case::Nominative);
    let the = |id| thing(Obstruction::Replica(id));
    let of = |id| in_case(Obstruction::Replica(id), Case::Genitive);
    match surprise {
        Surprise::Blocked { bump, .. } => {
            told!(language, "in-the-way", thing = thing(bump.against))
        }
        Surprise::Displaced => told!(language, "found-elsewhere"),
        Surprise::Noticed { seen } => {
            let what = match seen {
                Sighting::Door { door, .. } => Obstruction::Door(*door),
                Sighting::Replica { replica, .. } => Obstruction::Replica(*replica),
            };
            told!(language, "seen-on-the-way", thing = thing(what))
        }
        Surprise::NoWay { to, why, remedy } => {
            let to = place_in_words(world, to, language);
            let told = format!("{to}: {}", no_way_in_words(world, why, language));
            let Some(remedy) = remedy else { return told };
            let advice = Advice { remedy: Remedy::clone(remedy), whither: None };
            let advice = advice.in_words(world, language);
            told!(language, "for-a-way", told, advice)
        }
        Surprise::NotSeen { thing, area, next, for_kin } => {
            let area = said(Entity::Area(*area));
            let known = world.find(thing).first().copied();
            let thing = match (known, language) {
                (Some(entity), _) => form(entity, Case::Genitive),
                (None, _) => name_in(world, thing, language),
            };
            let seen = told!(language, "not-seen-in", area, thing);
            let rooms: Vec<String> = next.iter().map(|area| said(Entity::Area(*area))).collect();
            let rooms = rooms.join(", ");
            match for_kin {
                true => told!(language, "look-among-its-kin", seen, rooms),
                false => seen,
            }
        }
        Surprise::NoReturn { door, area, by } => {
            let door = form(Entity::Door(*door), Case::Accusative);
            let room = form(Entity::Area(*area), Case::Genitive);
            let why = match by.map(thing) {
                Some(by) => told!(language, "in-the-way-of-the-leaf", by),
                None => told!(language, "no-place-to-stand-there"),
            };
            told!(language, "no-return", door, room, why)
        }
        Surprise::Unknown { name } => told!(language, "the-map-has-no", name),
        Surprise::Refused { refusal, .. } => match *refusal {
            Refusal::Locked(door) => {
                told!(language, "is-locked", door = thing(Obstruction::Door(door)))
            }
            Refusal::DoorJammed { door, by, opening } => {
                let how = match opening {
                    0 => told!(language, "does-not-open"),
                    _ => told!(language, "moves-no-farther", opening),
                };
                let by = by.map_or_else(|| told!(language, "the-robot"), thing);
                let door = thing(Obstruction::Door(door));
                told!(language, "in-the-way-of-a-leaf", door, how, by)
            }
            Refusal::OutOfReach(id) => told!(language, "out-of-reach", thing = of(id)),
            Refusal::NotThere(id) => told!(language, "not-in-its-place", thing = of(id)),
            Refusal::HandFull(id) => told!(language, "hand-full", thing = the(id)),
            Refusal::NotHeld(id) => told!(language, "not-in-the-hand", thing = of(id)),
            // One that opens them found it locked, or shut when it should have been open.
            Refusal::Shut(id) if world.robot.opens => {
                told!(language, "thing-shut", thing = the(id))
            }
            Refusal::Shut(id) => told!(language, "thing-shut-for-good", thing = the(id)),
            Refusal::Stays(id) => {
                let thing = in_case(Obstruction::Replica(id), Case::Accusative);
                told!(language, "not-to-be-pushed", thing)
            }
            // On it or in it, as was said.
            Refusal::NoRoom(id) => told!(language, "no-room-left", thing = the(id)),
        },
    }
}

/// What bars the only way, and where: «В Коридоре путь к Двери-1 преграждает Стул-2 (345; 125)».
#[must_use]
pub(super) fn barred_in_words(world: &World, barred: &Barred, language: Language) -> String {
    let known =
        barred.things.iter().map(|id| thing_in_words(world, *id, Case::Nominative, language));
    let mut things: Vec<String> = known.collect();
    if things.is_empty() || !barred.unknown.is_empty() {
        things.push(unknown_thing(language));
    }
    let count = things.len();
    let things = enumerate(&things, language);
    let room = named(world, Entity::Area(barred.area));
    let to = barred.to.as_ref().map(|to| match (world.find(to).first(), language) {
        (Some(entity), Language::Russian) => named(world, *entity).form(Case::Dative, language),
        _ => place_in_words(world, to, language),
    });
    let at = barred.at.map(f64::round);
    let at = spot_in_words(at.x, at.y, "; ");
    let room = match language {
        Language::Russian => crate::language::russian::where_at(room.phrase()),
        Language::English => told!(language, "in-room", room = room.english()),
    };
    match to {
        Some(to) => told!(language, "way-to-barred", room, to, count, things, at),
        None => told!(language, "way-barred", room, count, things, at),
    }
}
