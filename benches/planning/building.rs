//! A robot's tasks in a large building, by the rules in `rules/service-robot.strips`: corridors with rooms on either
//! side, one corridor behind the other, a lift where there are two floors.

use std::fmt::Write;

use super::Random;

/// Rooms along one corridor.
const ROOMS: usize = 20;
/// Every so many doors are closed, and every so many locked, the key being in the first room.
const CLOSED: usize = 3;
const LOCKED: usize = 31;

/// What the robot is to do.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Errand {
    /// Go to a room at the other end.
    Drive,
    /// Bring a thing from a room in the middle to a person at the other end.
    Fetch,
    /// Bring three things to where they belong.
    Tidy,
    /// Bring so many things from anywhere to anywhere.
    #[allow(dead_code, reason = "the days are asked for by an example, which shares this file")]
    Day(usize),
}

/// A scenario in the rule language, without the rules.
pub(crate) struct Building {
    pub(crate) name: String,
    pub(crate) scenario: String,
}

/// Each room has a table with something on it, a place at it and one at the window; doors are open, closed or locked.
pub(crate) fn building(rooms: usize, floors: usize, errand: Errand) -> Building {
    let mut random = Random::new((rooms + floors) as u64);
    let (mut facts, mut assumptions) = (String::new(), String::new());
    let corridors = rooms.div_ceil(ROOMS);
    let corridors_of_floor = corridors.div_ceil(floors);
    let mut door = |name: String, a: &str, b: &str, state: &str| {
        writeln!(
            facts,
            "ДВЕРЬ_НАХОДИТСЯ-В_({name}, {a}) ДВЕРЬ_НАХОДИТСЯ-В_({name}, {b}) ДВЕРЬ_ИМЕЕТ-СТВОРКУ_({name})"
        )
        .expect("a string takes all text");
        for (from, to) in [(a, b), (b, a)] {
            writeln!(assumptions, "ДВЕРЬ_ИЗ_В_{state}_({name}, {from}, {to})")
                .expect("a string takes all text");
        }
    };
    let locked = |room: usize| room % LOCKED == LOCKED / 2;
    for room in 0..rooms {
        let state = match room {
            _ if locked(room) => "ЗАПЕРТА",
            _ if room % CLOSED == 0 => "ЗАКРЫТА",
            _ => "ОТКРЫТА",
        };
        door(format!("Дверь-{room}"), &format!("Комната-{room}"), &corridor(room / ROOMS), state);
    }
    for next in (1..corridors).filter(|next| next % corridors_of_floor != 0) {
        door(format!("Проход-{next}"), &corridor(next - 1), &corridor(next), "ОТКРЫТА");
    }
    for floor in 0..floors.min(corridors) {
        let hall = corridor(floor * corridors_of_floor);
        writeln!(
            facts,
            "ДВЕРЬ_НАХОДИТСЯ-В_(Дверь-лифта-{floor}, {hall}) ДВЕРЬ_НАХОДИТСЯ-В_(Дверь-лифта-{floor}, Кабина-{floor})\n\
             ЛИФТ_ИМЕЕТ-ДВЕРЬ_(Лифт, Дверь-лифта-{floor}) ЛИФТ_ИМЕЕТ-КАБИНУ_(Лифт, Кабина-{floor})"
        )
        .expect("a string takes all text");
    }
    assumptions += "ЛИФТ-РАБОТАЕТ_(Лифт) КАБИНА_СТОИТ-У_(Лифт, Дверь-лифта-0)\n";
    for number in 0..corridors {
        let (hall, floor) = (corridor(number), number / corridors_of_floor);
        writeln!(facts, "ПОМЕЩЕНИЕ_НАХОДИТСЯ-НА-ЭТАЖЕ_({hall}, Этаж-{floor})")
            .expect("a string takes all text");
    }
    for room in 0..rooms {
        let floor = room / ROOMS / corridors_of_floor;
        writeln!(
            facts,
            "ПОМЕЩЕНИЕ_НАХОДИТСЯ-НА-ЭТАЖЕ_(Комната-{room}, Этаж-{floor})\n\
             ПОЗИЦИЯ_НАХОДИТСЯ-В_(У-стола-{room}, Комната-{room}) ПОЗИЦИЯ_НАХОДИТСЯ-В_(У-окна-{room}, Комната-{room})\n\
             ПОЗИЦИЯ_НАХОДИТСЯ-У_(У-стола-{room}, Стол-{room})"
        )
        .expect("a string takes all text");
        if locked(room) {
            writeln!(
                facts,
                "КЛЮЧ_ПОДХОДИТ-К_(Ключ-{room}, Дверь-{room}) ПРЕДМЕТ_НАХОДИТСЯ-НА_(Ключ-{room}, Стол-0)"
            )
            .expect("a string takes all text");
        }
    }
    facts += "РОБОТ-НАХОДИТСЯ-В_(Комната-1) РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(У-окна-1) РОБОТ-НАХОДИТСЯ-НА-ЭТАЖЕ_(Этаж-0) РУКА-СВОБОДНА_()\n";
    let (middle, last) = (rooms / 2, rooms - 2);
    let goal = match errand {
        Errand::Drive => format!("РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(У-окна-{last})"),
        Errand::Fetch => {
            writeln!(
                facts,
                "ПРЕДМЕТ_НАХОДИТСЯ-НА_(Лекарство, Стол-{middle}) ЧЕЛОВЕК_НАХОДИТСЯ-В-ПОЗИЦИИ_(Больной, У-окна-{last})"
            )
            .expect("a string takes all text");
            "ПРЕДМЕТ_ПЕРЕДАН_(Лекарство, Больной)".to_owned()
        }
        Errand::Tidy => {
            let mut goal = String::new();
            for thing in ["Книга", "Чашка", "Папка"] {
                let (from, to) = (random.below(rooms.min(ROOMS)), random.below(rooms.min(ROOMS)));
                writeln!(
                    facts,
                    "ПРЕДМЕТ_НАХОДИТСЯ-НА_({thing}, Стол-{from}) ПРЕДМЕТ_ХРАНИТСЯ-НА_({thing}, Стол-{to})"
                )
                .expect("a string takes all text");
                goal += &format!("ПРЕДМЕТ-НА-СВОЁМ-МЕСТЕ_({thing}) ");
            }
            goal
        }
        Errand::Day(things) => {
            let mut goal = String::new();
            for thing in 0..things {
                let (from, to) = (random.below(rooms), random.below(rooms));
                let to = if from == to { (to + 1) % rooms } else { to };
                writeln!(
                    facts,
                    "ПРЕДМЕТ_НАХОДИТСЯ-НА_(Вещь-{thing}, Стол-{from}) ПРЕДМЕТ_ХРАНИТСЯ-НА_(Вещь-{thing}, Стол-{to})"
                )
                .expect("a string takes all text");
                goal += &format!("ПРЕДМЕТ-НА-СВОЁМ-МЕСТЕ_(Вещь-{thing}) ");
            }
            goal
        }
    };
    let name = match errand {
        Errand::Day(things) => format!("building-{rooms}-{floors}/day-{things}"),
        errand => format!("building-{rooms}-{floors}/{errand:?}").to_lowercase(),
    };
    Building {
        name,
        scenario: format!("Факты:\n{facts}\nПредположения:\n{assumptions}\nЦель:\n{goal}\n"),
    }
}

fn corridor(number: usize) -> String {
    format!("Коридор-{number}")
}

/// The sizes that are measured.
pub(crate) fn buildings() -> Vec<Building> {
    let mut all = Vec::new();
    for (rooms, floors) in [(20, 1), (60, 1), (150, 1), (150, 2), (300, 2), (500, 3)] {
        let errands = [Errand::Drive, Errand::Fetch, Errand::Tidy];
        all.extend(errands.map(|errand| building(rooms, floors, errand)));
    }
    all
}
