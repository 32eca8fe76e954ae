//! Commands for the robot, in the paper's words and in English.

use std::borrow::Cow;

use crate::units::{Language, capitalized};

use super::system::{JunctionKind, Side, Turn};

/// One manoeuvre. The robot needs no coordinates for it, only what it sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Command {
    /// Where the heading is unknown: stand along the corridor with this entrance on this side;
    /// with [`Side::Ahead`], with one's back to it.
    Face(Side),
    /// Drive on to the next junction, which looks like this.
    ToJunction(JunctionKind),
    /// At the junction.
    Take(Turn),
    /// Drive on to the next entrance, which is on this side.
    ToDoor(Side),
    UTurn,
}

impl Command {
    /// «движение до двери слева»
    #[must_use]
    pub fn russian(self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::Face(Side::Right) => "встать вдоль коридора, чтобы дверь была справа",
            Self::Face(Side::Left) => "встать вдоль коридора, чтобы дверь была слева",
            Self::Face(Side::Ahead) => "встать спиной к двери",
            Self::ToJunction(_) => "движение до соединения коридоров",
            Self::Take(Turn::Straight) => "движение прямо",
            Self::Take(Turn::Right) => "поворот направо",
            Self::Take(Turn::Left) => "поворот налево",
            Self::Take(Turn::Nth(n)) => {
                return format!("поворот {}, считая справа", nth_corridor(n)).into();
            }
            Self::ToDoor(Side::Right) => "движение до двери справа",
            Self::ToDoor(Side::Left) => "движение до двери слева",
            Self::ToDoor(Side::Ahead) => "движение до двери прямо",
            Self::UTurn => "разворот",
        })
    }

    /// "drive to the door on the left"
    #[must_use]
    pub fn english(self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::Face(Side::Right) => "stand along the corridor with the door on the right",
            Self::Face(Side::Left) => "stand along the corridor with the door on the left",
            Self::Face(Side::Ahead) => "stand with your back to the door",
            Self::ToJunction(_) => "drive to the corridor junction",
            Self::Take(Turn::Straight) => "go straight on",
            Self::Take(Turn::Right) => "turn right",
            Self::Take(Turn::Left) => "turn left",
            Self::Take(Turn::Nth(n)) => {
                let nth = english_ordinal(usize::from(n));
                return format!("take the {nth} corridor from the right").into();
            }
            Self::ToDoor(Side::Right) => "drive to the door on the right",
            Self::ToDoor(Side::Left) => "drive to the door on the left",
            Self::ToDoor(Side::Ahead) => "drive to the door straight ahead",
            Self::UTurn => "make a U-turn",
        })
    }

    /// A stable word for programs: `to_door_left`, `take_3_from_right`.
    #[must_use]
    pub fn key(self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::Face(Side::Right) => "face_door_right",
            Self::Face(Side::Left) => "face_door_left",
            Self::Face(Side::Ahead) => "face_door_behind",
            Self::ToJunction(_) => "to_junction",
            Self::Take(Turn::Straight) => "straight",
            Self::Take(Turn::Right) => "turn_right",
            Self::Take(Turn::Left) => "turn_left",
            Self::Take(Turn::Nth(n)) => return format!("take_{n}_from_right").into(),
            Self::ToDoor(Side::Right) => "to_door_right",
            Self::ToDoor(Side::Left) => "to_door_left",
            Self::ToDoor(Side::Ahead) => "to_door_ahead",
            Self::UTurn => "u_turn",
        })
    }

    /// The commands as whole sentences, entrances counted rather than named one by one:
    /// «Проезжайте до 3-го входа (дверь слева).»
    #[must_use]
    pub fn sentences(commands: &[Self], language: Language) -> Vec<String> {
        let mut out = Vec::new();
        let mut passed = 0;
        for (at, command) in commands.iter().enumerate() {
            let goes_on =
                matches!(commands.get(at + 1), Some(Self::ToDoor(_) | Self::ToJunction(_)));
            match command {
                Self::ToDoor(_) if goes_on => passed += 1,
                _ => {
                    out.push(command.sentence(language, passed));
                    passed = 0;
                }
            }
        }
        out
    }
}

impl Command {
    /// A command after `passed` entrances that were driven by.
    fn sentence(self, language: Language, passed: usize) -> String {
        match (language, self) {
            (Language::Russian, Self::ToDoor(side)) => {
                let hand = match side {
                    Side::Right => "справа",
                    Side::Left => "слева",
                    Side::Ahead => "прямо",
                };
                format!("Проезжайте до {}-го входа, дверь {hand}.", passed + 1)
            }
            (Language::Russian, Self::ToJunction(_)) if passed > 0 => {
                // «мимо» takes the genitive: мимо 1 входа, мимо 2 входов, мимо 21 входа.
                let one = passed % 10 == 1 && passed % 100 != 11;
                let word = if one { "входа" } else { "входов" };
                format!("Проезжайте мимо {passed} {word} до соединения коридоров.")
            }
            (Language::English, Self::ToDoor(side)) => {
                let hand = match side {
                    Side::Right => "on the right",
                    Side::Left => "on the left",
                    Side::Ahead => "straight ahead",
                };
                format!("Drive to the {} entrance, the door {hand}.", english_ordinal(passed + 1))
            }
            (Language::English, Self::ToJunction(_)) if passed > 0 => {
                let word = if passed == 1 { "entrance" } else { "entrances" };
                format!("Drive past {passed} {word} to the corridor junction.")
            }
            (Language::Russian, Self::Take(Turn::Nth(n))) => {
                format!("Сверните {}, считая справа.", nth_corridor(n))
            }
            (Language::Russian, other) => imperative(other).to_owned(),
            (Language::English, other) => format!("{}.", capitalized(&other.english())),
        }
    }
}

fn imperative(command: Command) -> &'static str {
    match command {
        Command::Face(Side::Right) => "Встаньте вдоль коридора, чтобы дверь была справа.",
        Command::Face(Side::Left) => "Встаньте вдоль коридора, чтобы дверь была слева.",
        Command::Face(Side::Ahead) => "Встаньте спиной к двери.",
        Command::ToJunction(_) => "Проезжайте до соединения коридоров.",
        Command::Take(Turn::Straight) => "Двигайтесь прямо.",
        Command::Take(Turn::Right) => "Поверните направо.",
        Command::Take(Turn::Left) => "Поверните налево.",
        Command::Take(Turn::Nth(_)) => "Сверните.",
        Command::ToDoor(_) => "Проезжайте до двери.",
        Command::UTurn => "Развернитесь.",
    }
}

/// «в 3-й коридор», «во 2-й коридор»
fn nth_corridor(n: u8) -> String {
    format!("{} {n}-й коридор", if n == 2 { "во" } else { "в" })
}

fn english_ordinal(n: usize) -> String {
    let ending = match (n % 10, n % 100) {
        (1, t) if t != 11 => "st",
        (2, t) if t != 12 => "nd",
        (3, t) if t != 13 => "rd",
        _ => "th",
    };
    format!("{n}{ending}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entrances_are_counted() {
        let way = [
            Command::UTurn,
            Command::ToDoor(Side::Left),
            Command::ToJunction(JunctionKind::Tee),
            Command::Take(Turn::Right),
            Command::ToDoor(Side::Left),
            Command::ToDoor(Side::Right),
        ];
        assert_eq!(
            Command::sentences(&way, Language::Russian),
            [
                "Развернитесь.",
                "Проезжайте мимо 1 входа до соединения коридоров.",
                "Поверните направо.",
                "Проезжайте до 2-го входа, дверь справа."
            ]
        );
        assert_eq!(
            Command::sentences(&way, Language::English)[3],
            "Drive to the 2nd entrance, the door on the right."
        );
    }

    #[test]
    fn ways_of_a_star_are_counted() {
        let way = [Command::ToJunction(JunctionKind::Star(4)), Command::Take(Turn::Nth(2))];
        assert_eq!(
            Command::sentences(&way, Language::Russian)[1],
            "Сверните во 2-й коридор, считая справа."
        );
        assert_eq!(
            Command::sentences(&way, Language::English)[1],
            "Take the 2nd corridor from the right."
        );
        assert_eq!(way[1].russian(), "поворот во 2-й коридор, считая справа");
        assert_eq!(way[1].key(), "take_2_from_right");
    }

    #[test]
    fn ordinals() {
        let all = [1, 2, 3, 4, 11, 12, 13, 21, 111].map(english_ordinal);
        assert_eq!(all, ["1st", "2nd", "3rd", "4th", "11th", "12th", "13th", "21st", "111th"]);
    }
}
