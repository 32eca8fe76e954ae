//! What went otherwise than believed, in words.

use super::located::spot_in_words;
use crate::geometry::Remedy;
use crate::language::{Case, Language, enumerate};
use crate::map::{Entity, World};
use crate::robot::{Barred, Obstruction, Refusal, Sighting, Surprise};

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
        Obstruction::Wall(area) => match language {
            Language::Russian => format!("стена ({})", said(Entity::Area(area))),
            Language::English => format!("a wall of {}", said(Entity::Area(area))),
        },
        Obstruction::Door(door) => form(Entity::Door(door), case),
        Obstruction::Replica(id) if world.replicas.contains_key(&id) => {
            form(Entity::Replica(id), case)
        }
        Obstruction::Replica(_) | Obstruction::Something => match case {
            Case::Genitive | Case::Prepositional => language.pick("вещи", "a thing").to_owned(),
            _ => language.pick("вещь", "a thing").to_owned(),
        },
    };
    let thing = |what: Obstruction| in_case(what, Case::Nominative);
    // In Russian in a case, where the pattern asks for one.
    let told_in = |case: Case, ru: &str, en: &str, what: Obstruction| {
        let (pattern, name) = (language.pick(ru, en), in_case(what, case));
        pattern.replacen("{}", &name, 1)
    };
    let told = |ru: &str, en: &str, what: Obstruction| told_in(Case::Nominative, ru, en, what);
    match surprise {
        Surprise::Blocked { bump, .. } => {
            told("путь преграждает {}", "{} is in the way", bump.against)
        }
        Surprise::Displaced => language
            .pick(
                "робот оказался не там, где считал себя",
                "the robot found itself elsewhere than it believed",
            )
            .to_owned(),
        Surprise::Noticed { seen } => {
            let what = match seen {
                Sighting::Door { door, .. } => Obstruction::Door(*door),
                Sighting::Replica { replica, .. } => Obstruction::Replica(*replica),
            };
            told(
                "по дороге видно: {} – не так, как считалось",
                "seen on the way: {} is not as it was believed",
                what,
            )
        }
        Surprise::NoWay { to, why, remedy } => {
            let to = place_in_words(world, to, language);
            let told = format!("{to}: {}", no_way_in_words(world, why, language));
            let Some(remedy) = remedy else { return told };
            let advice = Advice { remedy: Remedy::clone(remedy), whither: None };
            let advice = advice.in_words(world, language);
            match language {
                Language::Russian => format!("{told}; чтобы путь был, {advice}"),
                Language::English => format!("{told}; for a way, {advice}"),
            }
        }
        Surprise::NotSeen { thing, area, next, for_kin } => {
            let area = said(Entity::Area(*area));
            let known = world.find(thing).first().copied();
            let thing = match (known, language) {
                (Some(entity), _) => form(entity, Case::Genitive),
                (None, _) => name_in(world, thing, language),
            };
            let seen = match language {
                Language::Russian => format!("{area}: {thing} не видно"),
                Language::English => format!("{thing} is not seen in {area}"),
            };
            let rooms: Vec<String> = next.iter().map(|area| said(Entity::Area(*area))).collect();
            let rooms = rooms.join(", ");
            match (for_kin, language) {
                (true, Language::Russian) => {
                    format!("{seen}; такие вещи есть здесь: {rooms} – сначала искать там")
                }
                (true, Language::English) => {
                    format!("{seen}; things of its kind are in {rooms}: there first")
                }
                (false, _) => seen,
            }
        }
        Surprise::NoReturn { door, area, by } => {
            let door = form(Entity::Door(*door), Case::Accusative);
            let room = form(Entity::Area(*area), Case::Genitive);
            let (ru, en) = match by.map(thing) {
                Some(by) => {
                    (format!("створке мешает {by}"), format!("{by} is in the way of the leaf"))
                }
                None => {
                    ("там ему негде встать".to_owned(), "it has no place to stand there".to_owned())
                }
            };
            language.pick(
                format!("закрыв {door}, робот не сможет открыть её снова из {room}: {ru}"),
                format!("once {door} is shut, the robot could not open it again from {room}: {en}"),
            )
        }
        Surprise::Unknown { name } => match language {
            Language::Russian => format!("на карте нет «{name}»"),
            Language::English => format!("the map has no “{name}”"),
        },
        Surprise::Refused { refusal, .. } => match *refusal {
            Refusal::Locked(door) => told("{} заперта", "{} is locked", Obstruction::Door(door)),
            Refusal::DoorJammed { door, by, opening } => {
                let how = match opening {
                    0 => language.pick("не открывается", "does not open").to_owned(),
                    _ => language.pick(
                        format!("не движется дальше {opening} %"),
                        format!("does not move past {opening}%"),
                    ),
                };
                let by = by.map_or_else(|| language.pick("робот", "the robot").to_owned(), thing);
                let door = thing(Obstruction::Door(door));
                language.pick(
                    format!("{door} {how}: створке мешает {by}"),
                    format!("{door} {how}: {by} is in the way of its leaf"),
                )
            }
            Refusal::OutOfReach(id) => {
                let what = Obstruction::Replica(id);
                told_in(Case::Genitive, "до {} не дотянуться", "{} is out of reach", what)
            }
            Refusal::NotThere(id) => {
                let what = Obstruction::Replica(id);
                told_in(Case::Genitive, "{} нет на месте", "{} is not in its place", what)
            }
            Refusal::HandFull(id) => told(
                "рука занята: в ней {}",
                "the hand is full: it holds {}",
                Obstruction::Replica(id),
            ),
            Refusal::NotHeld(id) => {
                let what = Obstruction::Replica(id);
                told_in(Case::Genitive, "{} нет в руке", "{} is not in the hand", what)
            }
            // One that opens them found it locked, or shut when it should have been open.
            Refusal::Shut(id) if world.robot.opens => {
                told("{}: закрыто", "{} is shut", Obstruction::Replica(id))
            }
            Refusal::Shut(id) => told(
                "{}: дверцы закрыты, а дверцы мебели робот не открывает",
                "{} is shut, and the robot does not open doors of furniture",
                Obstruction::Replica(id),
            ),
            Refusal::Stays(id) => told_in(
                Case::Accusative,
                "{} туда не подвинуть",
                "{} cannot be pushed there",
                Obstruction::Replica(id),
            ),
            // On it or in it, as was said.
            Refusal::NoRoom(id) => told(
                "{}: свободного места там нет",
                "{} has no room left",
                Obstruction::Replica(id),
            ),
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
        things.push(unknown_thing(language).to_owned());
    }
    let is_one = things.len() == 1;
    let things = enumerate(&things, language);
    let room = named(world, Entity::Area(barred.area));
    let to = barred.to.as_ref().map(|to| match (world.find(to).first(), language) {
        (Some(entity), Language::Russian) => named(world, *entity).form(Case::Dative, language),
        _ => place_in_words(world, to, language),
    });
    let at = barred.at.map(f64::round);
    let at = spot_in_words(at.x, at.y, "; ");
    match language {
        Language::Russian => {
            let room = crate::language::russian::where_at(room.phrase());
            let to = to.map_or_else(String::new, |to| format!(" к {to}"));
            let bars = if is_one { "преграждает" } else { "преграждают" };
            format!("{room} путь{to} {bars} {things} {at}")
        }
        Language::English => {
            let to = to.map_or_else(String::new, |to| format!(" to {to}"));
            let bars = if is_one { "bars" } else { "bar" };
            format!("in {} {things} {bars} the way{to} {at}", room.english())
        }
    }
}
