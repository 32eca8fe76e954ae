//! Why there is no way, in words of both languages.
//!
//! Invariant: every barrier that the route names is told, in the order of the way.

use crate::geometry::{Barrier, Blocker, NoRoute};
use crate::language::report::Named;
use crate::language::words::NounPhrase;
use crate::language::{Case, Gender, Language, Number, enumerate, zone_in_words};
use crate::map::{DoorStatus, Entity, LiftStop, World};
use crate::units::{AreaId, DoorId, Lengths, ReplicaId, told, word};

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
        NoRoute::NoFloor => told!(language, "no-floor-for-the-robot"),
        NoRoute::OtherMap { area } => {
            let room = named(world, Entity::Area(*area));
            let name = if russian { room.phrase().name().to_owned() } else { room.english() };
            let how = match storey_is_reached(world, *area) {
                By::Lift => word!("on-another-map"),
                By::Stairs => word!("on-another-storey"),
                By::Nothing => word!("on-another-map-unreached"),
            };
            format!("{name} {}", how.say(language))
        }
    }
}

/// What was seen and is on no map.
pub(super) fn unknown_thing(language: Language) -> String {
    told!(language, "something-unmapped")
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
        false => unknown_thing(language),
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
    let of = |entity: Entity| named(world, entity);
    let form = |name: &Named, case: Case| name.form(case, language);
    let room = |id: AreaId, case| form(&of(Entity::Area(id)), case);
    let place = |area: AreaId| match language {
        Language::Russian => crate::language::russian::where_at(of(Entity::Area(area)).phrase()),
        Language::English => told!(language, "in-room", room = room(area, Case::Nominative)),
    };
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
        let leaf = |entity| told!(language, "leaf-of", of = form(&of(entity), Case::Genitive));
        let name = |b: &Blocker| match b {
            Blocker::Replica { replica, item } => {
                let name = thing_in_words(world, *replica, Case::Nominative, language);
                match overhang(world, *replica, *item) {
                    Some((low, tall)) => {
                        told!(language, "overhanging", name, low = cm(low), tall = cm(tall))
                    }
                    None => name,
                }
            }
            Blocker::DoorLeaf { door, .. } => leaf(Entity::Door(*door)),
            Blocker::ReplicaLeaf { replica, .. } => leaf(Entity::Replica(*replica)),
            Blocker::Wall { .. } => told!(language, "a-wall"),
            Blocker::Floor { .. } => told!(language, "a-step-or-a-low-ceiling"),
            Blocker::Zone { zone } => form(&of(Entity::Zone(*zone)), Case::Nominative),
        };
        let mut names: Vec<String> = blockers.iter().map(name).collect();
        names.dedup();
        let list = enumerate(&names, language);
        // What stands in the way by a size that nobody measured may stand beside it.
        let is_usual = |blocker: &Blocker| matches!(blocker, Blocker::Replica { replica, .. } if world.is_of_usual_size(*replica));
        match blockers.iter().any(is_usual) {
            true => told!(language, "by-usual-sizes", list),
            false => list,
        }
    };
    match barrier {
        Barrier::Door { door: id, status } => {
            let name = door(*id);
            let locked = *status == DoorStatus::Locked;
            let (door, agrees) = (form(&name, Case::Nominative), agrees(name.phrase()));
            match locked {
                true => told!(language, "door-locked", door, agrees),
                false => told!(language, "door-closed", door, agrees),
            }
        }
        Barrier::Narrow { door: id, areas, width, needed } => {
            let what = match id {
                Some(id) => told!(language, "doorway-of", of = form(&door(*id), Case::Genitive)),
                None => told!(language, "passage-between", pair = pair(areas)),
            };
            let (width, needed) = (cm(*width), cm(*needed));
            told!(language, "too-narrow", what, width, needed)
        }
        Barrier::Low { door: id, height, needed } => {
            let of = form(&door(*id), Case::Genitive);
            told!(language, "too-low", of, height = cm(*height), needed = cm(*needed))
        }
        Barrier::Step { areas, rise } => {
            told!(language, "step-between", rise = cm(rise.abs()), pair = pair(areas))
        }
        Barrier::Gap { area, width, needed, between } => {
            let (width, needed) = (cm(*width), cm(*needed));
            told!(language, "gap", place = place(*area), width, needed, between = list(between))
        }
        Barrier::Enclosed { area, by } if by.is_empty() => {
            told!(language, "no-way-out", room = room(*area, Case::Genitive))
        }
        Barrier::Enclosed { area, by } => {
            told!(language, "shut-off", place = place(*area), by = list(by))
        }
        Barrier::Zone { zone } => zone_in_words(world, *zone, language),
        Barrier::Doorless { area } => {
            told!(language, "doorless", room = room(*area, Case::Genitive))
        }
        Barrier::Apart { areas } => {
            let rooms = areas.map(|area| room(area, Case::Nominative));
            told!(language, "joined-by-nothing", rooms = enumerate(&rooms, language))
        }
    }
}

/// With what a word about it agrees.
pub(super) fn agrees(name: &NounPhrase) -> &'static str {
    match (name.number(), name.gender()) {
        (Number::Plural, _) => "plural",
        (_, Gender::Feminine) => "feminine",
        (_, Gender::Neuter) => "neuter",
        (_, Gender::Masculine) => "masculine",
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
