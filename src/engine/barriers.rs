//! Why there is no way, in words of both languages.
//!
//! Invariant: every barrier that the route names is told, in the order of the way.

use crate::geometry::{Barrier, Blocker, NoRoute};
use crate::language::report::Named;
use crate::language::{Case, Gender, Language, Number, enumerate, zone_in_words};
use crate::map::{DoorStatus, Entity, LiftStop, World};
use crate::units::{AreaId, DoorId, Lengths, ReplicaId};

use super::RouteAnswer;
use super::lexicon::named;

impl RouteAnswer {
    /// Why there is no way, without a full stop; none where there is one.
    #[must_use]
    pub fn no_way_in_words(&self, world: &World, language: Language) -> Option<String> {
        self.route.as_ref().err().map(|no| no_way_in_words(world, no, language))
    }
}

/// «Дверь-ВZ заперта», "Door VZ is locked"; several barriers one after the other.
#[must_use]
pub(crate) fn no_way_in_words(world: &World, no: &NoRoute, language: Language) -> String {
    let russian = language == Language::Russian;
    match no {
        NoRoute::Blocked { barriers } => {
            let told: Vec<String> = barriers.iter().map(|b| barrier(world, b, language)).collect();
            told.join("; ")
        }
        NoRoute::NoFloor if russian => {
            "у начала или цели нет места, где робот помещается".to_owned()
        }
        NoRoute::NoFloor => "the robot does not fit near the start or the goal".to_owned(),
        NoRoute::OtherMap { area } => {
            let room = named(world, Entity::Area(*area));
            let name = if russian { room.phrase().name().to_owned() } else { room.english() };
            let (ru, en) = match storey_is_reached(world, *area) {
                By::Lift => ("находится на другой карте", "is on another map"),
                By::Stairs => (
                    "находится на другом этаже, куда ведёт только лестница, а по ней роботу не проехать",
                    "is on another storey, to which only stairs lead, and the robot cannot climb them",
                ),
                By::Nothing => (
                    "находится на другой карте, куда не ведёт ни лифт, ни лестница",
                    "is on another map, to which neither lift nor stairs lead",
                ),
            };
            format!("{name} {}", language.pick(ru, en))
        }
    }
}

/// What was seen and is on no map.
pub(super) fn unknown_thing(language: Language) -> &'static str {
    language.pick("что-то, чего нет на карте", "something that is not on the map")
}

/// A thing that stands in a way. What the robot met and nobody surveyed has no name.
pub(super) fn thing_in_words(
    world: &World,
    thing: ReplicaId,
    case: Case,
    language: Language,
) -> String {
    match world.replicas.contains_key(&thing) {
        true => named(world, Entity::Replica(thing)).form(case, language),
        false => unknown_thing(language).to_owned(),
    }
}

/// What leads to a storey from others.
enum By {
    /// A lift, whether or not from where the robot is.
    Lift,
    Stairs,
    Nothing,
}

fn storey_is_reached(world: &World, area: AreaId) -> By {
    let map_of = |area| world.placement(area).map(|(map, _)| map);
    let here = map_of(area);
    let stops_here = world.domain.lifts.iter().map(|(_, stops)| stops).filter(|stops| {
        let mut maps = stops.iter().map(|stop| map_of(stop.area));
        maps.any(|map| map == here)
    });
    let is_stairs =
        |stops: &&Vec<LiftStop>| stops.iter().any(|stop| world.area_has_trait(stop.area, "stairs"));
    let (stairs, lifts): (Vec<_>, Vec<_>) = stops_here.partition(is_stairs);
    match (lifts.is_empty(), stairs.is_empty()) {
        (false, _) => By::Lift,
        (true, false) => By::Stairs,
        (true, true) => By::Nothing,
    }
}

fn barrier(world: &World, barrier: &Barrier, language: Language) -> String {
    let russian = language == Language::Russian;
    let of = |entity: Entity| named(world, entity);
    let form = |name: &Named, case: Case| name.form(case, language);
    let room = |id: AreaId, case| form(&of(Entity::Area(id)), case);
    let door = |id: DoorId| of(Entity::Door(id));
    let pair = |areas: &[AreaId; 2]| {
        let names = [room(areas[0], Case::Instrumental), room(areas[1], Case::Instrumental)];
        enumerate(&names, language)
    };
    let cm = |length: f64| {
        // Rounded down, so that 59.96 cm never reads as the 60 that are needed.
        Lengths::said().told((length * 10.0 + 1e-6).floor() / 10.0, 1, language)
    };
    let list = |blockers: &[Blocker]| {
        let leaf = |entity: Entity| match russian {
            true => format!("створка {}", form(&of(entity), Case::Genitive)),
            false => format!("a leaf of {}", form(&of(entity), Case::Nominative)),
        };
        let name = |b: &Blocker| match (b, russian) {
            (Blocker::Replica { replica, item }, _) => {
                let name = thing_in_words(world, *replica, Case::Nominative, language);
                match overhang(world, *replica, *item) {
                    Some((low, tall)) if russian => {
                        format!("{name} (низ на высоте {}, робот высотой {})", cm(low), cm(tall))
                    }
                    Some((low, tall)) => {
                        let (low, tall) = (cm(low), cm(tall));
                        format!("{name} (its underside at {low}, the robot is {tall} tall)")
                    }
                    None => name,
                }
            }
            (Blocker::DoorLeaf { door, .. }, _) => leaf(Entity::Door(*door)),
            (Blocker::ReplicaLeaf { replica, .. }, _) => leaf(Entity::Replica(*replica)),
            (Blocker::Wall { .. }, true) => "стена".to_owned(),
            (Blocker::Wall { .. }, false) => "a wall".to_owned(),
            (Blocker::Floor { .. }, true) => "ступень или низкий потолок".to_owned(),
            (Blocker::Floor { .. }, false) => "a step or a low ceiling".to_owned(),
            (Blocker::Zone { zone }, _) => form(&of(Entity::Zone(*zone)), Case::Nominative),
        };
        let mut names: Vec<String> = blockers.iter().map(name).collect();
        names.dedup();
        enumerate(&names, language)
    };
    match barrier {
        Barrier::Door { door: id, status } => {
            let name = door(*id);
            let locked = *status == DoorStatus::Locked;
            match russian {
                true => format!("{} {}", form(&name, Case::Nominative), shut(&name, locked)),
                false if locked => format!("{} is locked", name.english()),
                false => format!("{} is closed", name.english()),
            }
        }
        Barrier::Narrow { door: id, areas, width, needed } => {
            let what = match (id, russian) {
                (Some(id), true) => format!("проём {}", form(&door(*id), Case::Genitive)),
                (Some(id), false) => format!("the doorway of {}", door(*id).english()),
                (None, true) => format!("проход между {}", pair(areas)),
                (None, false) => format!("the passage between {}", pair(areas)),
            };
            match russian {
                true => format!("{what} шириной {}, роботу нужно {}", cm(*width), cm(*needed)),
                false => format!("{what} is {} wide, the robot needs {}", cm(*width), cm(*needed)),
            }
        }
        Barrier::Low { door: id, height, needed } => match russian {
            true => format!(
                "высота {} – {}, а робота – {}",
                form(&door(*id), Case::Genitive),
                cm(*height),
                cm(*needed)
            ),
            false => format!(
                "{} is {} high, the robot {}",
                door(*id).english(),
                cm(*height),
                cm(*needed)
            ),
        },
        Barrier::Step { areas, rise } => match russian {
            true => format!("ступень {} между {}", cm(rise.abs()), pair(areas)),
            false => format!("there is a step of {} between {}", cm(rise.abs()), pair(areas)),
        },
        Barrier::Gap { area, width, needed, between } => match russian {
            true => format!(
                "промежуток {} – {}, роботу нужно {} ({})",
                crate::language::russian::where_at(of(Entity::Area(*area)).phrase()),
                cm(*width),
                cm(*needed),
                list(between)
            ),
            false => format!(
                "a gap in {} is {} wide, the robot needs {} ({})",
                room(*area, Case::Nominative),
                cm(*width),
                cm(*needed),
                list(between)
            ),
        },
        Barrier::Enclosed { area, by } => match (by.is_empty(), russian) {
            (true, true) => format!("из {} выхода нет", room(*area, Case::Genitive)),
            (true, false) => format!("{} has no way out", room(*area, Case::Nominative)),
            (false, true) => format!(
                "{} путь загораживают: {}",
                crate::language::russian::where_at(of(Entity::Area(*area)).phrase()),
                list(by)
            ),
            (false, false) => {
                format!("in {} the way is shut off by {}", room(*area, Case::Nominative), list(by))
            }
        },
        Barrier::Zone { zone } => zone_in_words(world, *zone, language),
        Barrier::Doorless { area } => match russian {
            true => format!(
                "из {} нет ни двери, ни прохода в другие помещения",
                room(*area, Case::Genitive)
            ),
            false => format!(
                "no door or passage leads from {} to another room",
                room(*area, Case::Nominative)
            ),
        },
        Barrier::Apart { areas } => match russian {
            true => format!(
                "{} и {} не соединены ни дверью, ни проходом",
                room(areas[0], Case::Nominative),
                room(areas[1], Case::Nominative)
            ),
            false => format!("no door or passage joins {}", pair(areas)),
        },
    }
}

fn shut(name: &Named, locked: bool) -> &'static str {
    match (name.phrase().number(), name.phrase().gender(), locked) {
        (Number::Plural, _, true) => "заперты",
        (Number::Plural, _, false) => "закрыты",
        (_, Gender::Feminine, true) => "заперта",
        (_, Gender::Feminine, false) => "закрыта",
        (_, Gender::Neuter, true) => "заперто",
        (_, Gender::Neuter, false) => "закрыто",
        (_, Gender::Masculine, true) => "заперт",
        (_, Gender::Masculine, false) => "закрыт",
    }
}

/// How high above the floor the part of a thing hangs that is in the robot's way, and how tall the robot is; none for
/// what the robot would meet with its wheels.
fn overhang(world: &World, replica: ReplicaId, item: usize) -> Option<(f64, f64)> {
    let model = world.replicas.get(&replica)?;
    let part = world.objects[&model.object].items.get(item)?;
    let low = model.frame.z.get() + part.frame.z.get();
    (low > world.robot.step.get()).then(|| (low, world.robot.height.get()))
}
