//! A directive in words: what it asks for, and what it has done: what was switched, found, put away, who was called.

use crate::language::command::Relation;
use crate::language::report::Named;
use crate::language::words::russian::{self, Preposition};
use crate::language::{Case, Language};
use crate::map::{DoorStatus, Entity, World};
use crate::robot::{Directive, GoalFact, IN_MIDDLE, Primitive, STARTING_POINT};
use crate::semantics::planning::{PLACE_BESIDE, ROBOT_PLACE};
use crate::semantics::{predicate, storey_name};
use crate::units::{Bilingual, Piece, told, word};

use super::located::spot_in_words;

use super::OPERATOR;
use super::lexicon::named;
use super::task::{OPERATOR_PLACE, Report, TaskAnswer, TaskEnding};

/// A sentence for each primitive that the robot's position does not tell; motion and doors are told by that.
#[must_use]
pub(super) fn actions_in_words(
    world: &World,
    directive: &Directive,
    language: Language,
) -> Vec<String> {
    let name = |name: &str| {
        let thing = world.find(name).into_iter().find(|e| matches!(e, Entity::Replica(_)));
        match thing.map(|e| named(world, e)) {
            Some(thing) => thing.form(Case::Accusative, language),
            None => name.to_owned(),
        }
    };
    let sentence = |primitive: &Primitive| {
        Some(match primitive {
            Primitive::Switch { device, on: true } => {
                told!(language, "i-switched-on", device = name(device))
            }
            Primitive::Switch { device, on: false } => {
                told!(language, "i-switched-off", device = name(device))
            }
            Primitive::SetOpen { thing, open: true } => {
                told!(language, "i-opened", thing = name(thing))
            }
            Primitive::SetOpen { thing, open: false } => {
                told!(language, "i-shut", thing = name(thing))
            }
            Primitive::Push(thing) => told!(language, "i-pushed", thing = name(thing)),
            Primitive::Seek(thing) => told!(language, "i-see", thing = name(thing)),
            Primitive::Put { thing, .. } if directive.brings_about(predicate::IN_ITS_PLACE) => {
                told!(language, "i-put-back", thing = name(thing))
            }
            Primitive::Put { thing, .. } if directive.brings_about(predicate::THROWN_AWAY) => {
                told!(language, "i-threw-away", thing = name(thing))
            }
            Primitive::SetDoor { door, .. } if directive.needs(predicate::PERSON_HAS_KEY) => {
                told!(language, "come-and-unlock", door = named_door(world, door, language))
            }
            Primitive::Call(person) => {
                let is_operator = language == Language::English && person == OPERATOR;
                let person = if is_operator { told!(language, "operator") } else { person.clone() };
                told!(language, "come-to-me", person)
            }
            _ => return None,
        })
    };
    directive.primitives().iter().filter_map(sentence).collect()
}

fn named_door(world: &World, name: &str, language: Language) -> String {
    Words { world, language }.name(name, Case::Accusative)
}

/// What a directive asks for, as one tells a person: «открыть Дверь-КY», "open Door KY". An action that asks nothing of
/// the vehicle is told by the words of its name, and what it is done with.
#[must_use]
pub(crate) fn directive_in_words(
    world: &World,
    directive: &Directive,
    language: Language,
) -> String {
    let words = Words { world, language };
    let opened = |status| match (status, directive.needs(predicate::DOOR_LOCKED)) {
        (DoorStatus::Closed, true) if directive.needs(predicate::PERSON_HAS_KEY) => {
            word!("ask-for-someone-to-unlock")
        }
        (DoorStatus::Open, _) => word!("open"),
        (DoorStatus::Closed, true) => word!("unlock"),
        (DoorStatus::Closed, false) => word!("close"),
        (DoorStatus::Locked, _) => word!("lock"),
    };
    let inside = directive.brings_about(predicate::THING_IN);
    let told: Vec<String> =
        directive.primitives().iter().map(|it| words.primitive(it, inside, opened)).collect();
    match told.is_empty() {
        true => words.action(&directive.action, &directive.args),
        false => told.join(&told!(language, "and")),
    }
}

/// What a goal asks for, as one tells a person: «поехать в Комнату-Y», "switch on Lamp 1".
#[must_use]
pub(super) fn goal_in_words(world: &World, goal: &GoalFact, language: Language) -> String {
    let words = Words { world, language };
    let other = |n: usize| goal.args.get(n).cloned().unwrap_or_default();
    let name = other(0);
    let accusative = |name: &str| words.name(name, Case::Accusative);
    let wanted = goal.predicate.as_str();
    let primitive = match wanted {
        predicate::ROBOT_AT_PLACE => Primitive::GoToPlace(name),
        predicate::ROBOT_AT_DOOR => Primitive::GoToDoor(name),
        predicate::ROBOT_HOLDS => Primitive::Take(name),
        predicate::FOUND => Primitive::Seek(name),
        predicate::CALLED => Primitive::Call(name),
        predicate::CABIN_AT => Primitive::CallLift { lift: name, door: other(1) },
        predicate::HANDED_OVER => Primitive::HandOver { thing: name, person: other(1) },
        predicate::THING_ON | predicate::THING_IN => {
            Primitive::Put { thing: name, onto: Some(other(1)) }
        }
        predicate::THING_AT_PLACE => Primitive::Put { thing: name, onto: None },
        predicate::DEVICE_ON | predicate::DEVICE_OFF => {
            Primitive::Switch { device: name, on: wanted == predicate::DEVICE_ON }
        }
        predicate::STANDS_OPEN | predicate::STANDS_SHUT => {
            Primitive::SetOpen { thing: name, open: wanted == predicate::STANDS_OPEN }
        }
        predicate::DOOR_OPEN => Primitive::SetDoor { door: name, status: DoorStatus::Open },
        predicate::DOOR_CLOSED => Primitive::SetDoor { door: name, status: DoorStatus::Closed },
        predicate::DOOR_LOCKED => Primitive::SetDoor { door: name, status: DoorStatus::Locked },
        predicate::ROBOT_IN => {
            return told!(language, "drive-to", to = words.through_to(&name));
        }
        predicate::ROBOT_ON_STOREY => {
            let map = world.maps.keys().find(|map| storey_name(world, **map) == name);
            let to = map.map(|map| named(world, Entity::Map(*map)).whither_storey(language));
            return told!(language, "drive-to", to = to.unwrap_or(name));
        }
        predicate::IN_ITS_PLACE => {
            return told!(language, "put-back", thing = accusative(&name));
        }
        predicate::THROWN_AWAY => {
            return told!(language, "throw-away", thing = accusative(&name));
        }
        _ => return words.action(wanted, &goal.args),
    };
    // What is to be closed may be closed now, or locked.
    words.primitive(&primitive, wanted == predicate::THING_IN, |status| match status {
        DoorStatus::Open => word!("open"),
        DoorStatus::Closed => word!("close-not-lock"),
        DoorStatus::Locked => word!("lock"),
    })
}

impl Report {
    /// What the directive asked for: «открыть Дверь-КY», "open Door KY".
    #[must_use]
    pub fn directive_in_words(&self, world: &World, language: Language) -> String {
        directive_in_words(world, &self.directive, language)
    }

    /// What was done and the position does not tell, a sentence each: what was switched, found, put away, who was called.
    #[must_use]
    pub fn actions_in_words(&self, world: &World, language: Language) -> Vec<String> {
        actions_in_words(world, &self.directive, language)
    }
}

impl TaskAnswer {
    /// What a command came to, for who asks afterwards: its steps, and whether it was done.
    #[must_use]
    pub fn in_words(&self, world: &World, command: &str) -> Bilingual {
        let told = |language: Language| {
            let steps =
                self.reports.iter().map(|r| directive_in_words(world, &r.directive, language));
            let steps = steps.collect::<Vec<_>>().join(", ");
            let end = match self.ending {
                TaskEnding::Done => told!(language, "done"),
                TaskEnding::AlreadyTrue => told!(language, "it-was-so-already"),
                TaskEnding::NoPlan(_) => told!(language, "there-was-no-plan"),
                TaskEnding::Stuck(_) => told!(language, "it-did-not-work-out"),
                TaskEnding::Stopped => told!(language, "it-was-stopped"),
                TaskEnding::Failed(_) => told!(language, "the-robot-failed"),
            };
            let stop = if steps.is_empty() { "" } else { "; " };
            told!(language, "last-task", command, steps, stop, end)
        };
        Bilingual::new(told(Language::Russian), told(Language::English))
    }
}

/// An object of a plan as it is called in a language: by its English name, where the map gives one; in Russian as the
/// plan has it.
#[must_use]
pub(crate) fn name_in(world: &World, name: &str, language: Language) -> String {
    match (language, name.strip_prefix(PLACE_BESIDE)) {
        (Language::Russian, _) => name.to_owned(),
        (Language::English, _) if name == OPERATOR => told!(language, "operator-accusative"),
        (Language::English, beside) => {
            let told = Words { world, language }.name(name, Case::Nominative);
            if beside.is_some() { format!("the place by {told}") } else { told }
        }
    }
}

/// A point that a task gives a name, and how it is told: by words before the names of what it is at.
struct TaskPoint {
    /// What its name begins with.
    prefix: &'static str,
    /// In the dative and otherwise.
    dative: Piece,
    other: Piece,
    preposition: Option<Preposition>,
    case: Case,
}

const TASK_POINTS: [TaskPoint; 13] = [
    TaskPoint {
        prefix: OPERATOR_PLACE,
        dative: word!("point-of-operator-dative"),
        other: word!("point-of-operator"),
        preposition: None,
        case: Case::Genitive,
    },
    TaskPoint {
        prefix: BY_WINDOW,
        dative: word!("point-by-window-dative"),
        other: word!("point-by-window"),
        preposition: Some(Preposition::V),
        case: Case::Prepositional,
    },
    TaskPoint {
        prefix: ON_FLOOR,
        dative: word!("point-on-floor-dative"),
        other: word!("point-on-floor"),
        preposition: Some(Preposition::V),
        case: Case::Prepositional,
    },
    TaskPoint {
        prefix: IN_MIDDLE,
        dative: word!("point-in-middle-dative"),
        other: word!("point-in-middle"),
        preposition: None,
        case: Case::Genitive,
    },
    TaskPoint {
        prefix: AT_SPOT,
        dative: word!("point-of-floor-dative"),
        other: word!("point-of-floor"),
        preposition: None,
        case: Case::Genitive,
    },
    TaskPoint {
        prefix: FACING_WINDOW,
        dative: word!("point-facing-window-dative"),
        other: word!("point-facing-window"),
        preposition: Some(Preposition::V),
        case: Case::Prepositional,
    },
    TaskPoint {
        prefix: FACING_WALL,
        dative: word!("point-facing-wall-dative"),
        other: word!("point-facing-wall"),
        preposition: Some(Preposition::V),
        case: Case::Prepositional,
    },
    TaskPoint {
        prefix: FACING,
        dative: word!("point-facing-dative"),
        other: word!("point-facing"),
        preposition: Some(Preposition::K),
        case: Case::Dative,
    },
    TaskPoint {
        prefix: BETWEEN,
        dative: word!("point-between-dative"),
        other: word!("point-between"),
        preposition: None,
        case: Case::Instrumental,
    },
    TaskPoint {
        prefix: LEFT_OF,
        dative: word!("point-left-of-dative"),
        other: word!("point-left-of"),
        preposition: Some(Preposition::Ot),
        case: Case::Genitive,
    },
    TaskPoint {
        prefix: RIGHT_OF,
        dative: word!("point-right-of-dative"),
        other: word!("point-right-of"),
        preposition: Some(Preposition::Ot),
        case: Case::Genitive,
    },
    TaskPoint {
        prefix: BEHIND,
        dative: word!("point-behind-dative"),
        other: word!("point-behind"),
        preposition: Some(Preposition::Za),
        case: Case::Instrumental,
    },
    TaskPoint {
        prefix: IN_FRONT_OF,
        dative: word!("point-in-front-of-dative"),
        other: word!("point-in-front-of"),
        preposition: Some(Preposition::Pered),
        case: Case::Instrumental,
    },
];

const BY_WINDOW: &str = "Место-у-окна-в-";
const ON_FLOOR: &str = "Место-на-полу-в-";
const AT_SPOT: &str = "Точка-пола-";
const FACING_WINDOW: &str = "Место-лицом-к-окну-в-";
const FACING_WALL: &str = "Место-лицом-к-стене-в-";
const FACING: &str = "Место-лицом-к-";
const BETWEEN: &str = "Место-между-";
const LEFT_OF: &str = "Место-слева-от-";
const RIGHT_OF: &str = "Место-справа-от-";
const BEHIND: &str = "Место-за-";
const IN_FRONT_OF: &str = "Место-перед-";
/// Between the names of two things.
const AND: &str = "-и-";

/// A place of a plan as one tells a person, in the nominative.
pub(super) fn place_in_words(world: &World, name: &str, language: Language) -> String {
    let is_point = TASK_POINTS.iter().any(|point| name.starts_with(point.prefix));
    match is_point {
        true => Words { world, language }.name(name, Case::Accusative),
        false => name_in(world, name, language),
    }
}

/// The name of the point at a window of a room, for the time of a task.
pub(super) fn window_place(room: &str) -> String {
    format!("{BY_WINDOW}{room}")
}

/// The name of the point on the floor of a room, for the time of a task.
pub(super) fn floor_place(room: &str) -> String {
    format!("{ON_FLOOR}{room}")
}

/// The name of the point in the middle of a room, for the time of a task.
pub(super) fn middle_place(room: &str) -> String {
    format!("{IN_MIDDLE}{room}")
}

/// The name of a point of the floor that was told by its coordinates, for the time of a task.
pub(super) fn spot_place(x: i32, y: i32) -> String {
    format!("{AT_SPOT}{}", spot_in_words(f64::from(x), f64::from(y), "; "))
}

/// The name of a point from which the robot is to look at something, for the time of a task.
pub(super) fn facing_place(thing: &str) -> String {
    format!("{FACING}{thing}")
}

/// The name of a point from which the robot is to look at a window of a room, for the time of a task.
pub(super) fn facing_window(room: &str) -> String {
    format!("{FACING_WINDOW}{room}")
}

/// The name of a point in a room from which the robot is to look at a wall, for the time of a task.
pub(super) fn facing_wall(room: &str) -> String {
    format!("{FACING_WALL}{room}")
}

/// The name of the point between two things, for the time of a task.
pub(super) fn between_places(one: &str, other: &str) -> String {
    format!("{BETWEEN}{one}{AND}{other}")
}

/// What the name of a point on one side of a thing begins with; none where the relation tells no side.
pub(super) fn side_of(relation: Relation) -> Option<&'static str> {
    match relation {
        Relation::LeftOf => Some(LEFT_OF),
        Relation::RightOf => Some(RIGHT_OF),
        Relation::Behind => Some(BEHIND),
        Relation::InFrontOf => Some(IN_FRONT_OF),
        _ => None,
    }
}

/// The name of a point on one side of a thing, for the time of a task.
pub(super) fn side_place(side: &str, thing: &str) -> String {
    format!("{side}{thing}")
}

struct Words<'w> {
    world: &'w World,
    language: Language,
}

impl Words<'_> {
    /// `inside`: what is put somewhere is put into it.
    fn primitive(
        &self,
        primitive: &Primitive,
        inside: bool,
        opened: impl Fn(DoorStatus) -> Piece,
    ) -> String {
        let language = self.language;
        let accusative = |name: &str| self.name(name, Case::Accusative);
        let lift_named = |lift: &str| match language {
            Language::Russian => lift.to_owned(),
            Language::English => self.name(lift, Case::Nominative),
        };
        match primitive {
            Primitive::GoToPlace(to) | Primitive::GoToDoor(to) => {
                told!(language, "drive-up", to = self.at(Preposition::K, "to", to))
            }
            Primitive::Cross { door, into } => {
                let (door, into) = (accusative(door), self.through_to(into));
                told!(language, "go-through", door, into)
            }
            Primitive::SetDoor { door, status } => {
                format!("{} {}", opened(*status).say(language), accusative(door))
            }
            Primitive::CallLift { lift, .. } => {
                told!(language, "call-lift", lift = lift_named(lift))
            }
            Primitive::Ride { lift, to, .. } => {
                told!(language, "ride-lift", lift = lift_named(lift), to = self.storey(to))
            }
            Primitive::SetOpen { thing, open: true } => {
                told!(language, "open-thing", thing = accusative(thing))
            }
            Primitive::SetOpen { thing, open: false } => {
                told!(language, "shut-thing", thing = accusative(thing))
            }
            Primitive::Push(thing) => told!(language, "push-aside", thing = accusative(thing)),
            Primitive::Take(thing) => told!(language, "take", thing = accusative(thing)),
            Primitive::Put { thing, onto: Some(onto) } if inside => {
                let (thing, into) = (accusative(thing), self.at(Preposition::V, "in", onto));
                told!(language, "put-into", thing, into)
            }
            Primitive::Put { thing, onto: Some(onto) } => {
                told!(language, "put-onto", thing = accusative(thing), onto = accusative(onto))
            }
            Primitive::Put { thing, onto: None } => {
                told!(language, "put-down", thing = accusative(thing))
            }
            Primitive::HandOver { thing, person } => {
                let person = self.person(person, Case::Dative);
                told!(language, "give-to", thing = accusative(thing), person)
            }
            Primitive::Switch { device, on: true } => {
                told!(language, "switch-on", device = accusative(device))
            }
            Primitive::Switch { device, on: false } => {
                told!(language, "switch-off", device = accusative(device))
            }
            Primitive::LookRound => told!(language, "look-round"),
            Primitive::Seek(thing) => told!(language, "look-for", thing = accusative(thing)),
            Primitive::Call(person) => {
                told!(language, "call", person = self.person(person, Case::Accusative))
            }
        }
    }

    /// «Вымыть_посуду_(Тарелка-1)» as «вымыть посуду: Тарелка-1».
    fn action(&self, action: &str, args: &[impl AsRef<str>]) -> String {
        let name = action.split('_').filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ");
        let args: Vec<String> =
            args.iter().map(|arg| self.name(arg.as_ref(), Case::Nominative)).collect();
        match args.is_empty() {
            true => name.to_lowercase(),
            false => format!("{}: {}", name.to_lowercase(), args.join(", ")),
        }
    }

    /// «на Кухню», "into the kitchen"
    fn through_to(&self, room: &str) -> String {
        match (self.language, self.world.find(room).first()) {
            (Language::Russian, Some(&entity)) => named(self.world, entity).whither(),
            _ => self.at(Preposition::V, "into", room),
        }
    }

    /// A name after a preposition, «ко Входной двери», "to the entrance door".
    fn at(&self, preposition: Preposition, english: &str, name: &str) -> String {
        let case = if preposition == Preposition::K { Case::Dative } else { Case::Accusative };
        let name = self.name(name, case);
        match self.language {
            Language::Russian => format!("{} {name}", russian::preposition(preposition, &name)),
            Language::English => format!("{english} {name}"),
        }
    }

    /// A name of the map; a place of the plan that the map has not is told by the thing that it is before.
    fn name(&self, name: &str, case: Case) -> String {
        for point in &TASK_POINTS {
            let Some(at) = name.strip_prefix(point.prefix) else { continue };
            if point.prefix == AT_SPOT && self.language == Language::English {
                return format!("{} {}", point.other.say(self.language), at.replace("; ", ", "));
            }
            let told: Vec<String> = at.split(AND).map(|name| self.name(name, point.case)).collect();
            let told = told.join(&told!(self.language, "and"));
            let of = if case == Case::Dative { point.dative } else { point.other };
            let of = of.say(self.language);
            return match point.preposition {
                Some(preposition) if self.language == Language::Russian => {
                    format!("{of} {} {told}", russian::preposition(preposition, &told))
                }
                _ => format!("{of} {told}"),
            };
        }
        let known = name.strip_prefix(PLACE_BESIDE).unwrap_or(name);
        match (self.world.find(known).first(), self.language) {
            (Some(&entity), language) => named(self.world, entity).form(case, language),
            (None, language) if name == STARTING_POINT || name == ROBOT_PLACE => match case {
                Case::Dative => told!(language, "starting-point-dative"),
                _ => told!(language, "starting-point"),
            },
            (None, Language::English) if self.is_lift(name) => {
                Named::plain(name).english_name().to_owned()
            }
            (None, _) => name.to_owned(),
        }
    }

    fn is_lift(&self, name: &str) -> bool {
        self.world.domain.lifts.iter().any(|(lift, _)| lift == name)
    }

    /// The storey of a room, as it is called on the map.
    fn storey(&self, room: &str) -> String {
        let area = |e| if let Entity::Area(id) = e { Some(id) } else { None };
        let area = self.world.find(room).into_iter().find_map(area);
        let map = area.and_then(|id| self.world.placement(id)).map(|(map, _)| map);
        let map = map.map(|map| named(self.world, Entity::Map(map)));
        map.map_or(room.to_owned(), |map| map.whither_storey(self.language))
    }

    fn person(&self, person: &str, case: Case) -> String {
        match case {
            Case::Dative if person == OPERATOR => told!(self.language, "operator-dative"),
            _ if person == OPERATOR => told!(self.language, "operator-accusative"),
            _ => self.name(person, case),
        }
    }
}
