//! Commands for the robot, in the paper's words and in English.

use std::borrow::Cow;

use crate::units::{Argument, Language, Value, told, word};

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
        self.words(Language::Russian)
    }

    /// "drive to the door on the left"
    #[must_use]
    pub fn english(self) -> Cow<'static, str> {
        self.words(Language::English)
    }

    fn words(self, language: Language) -> Cow<'static, str> {
        let words = match self {
            Self::Face(Side::Right) => word!("face-right"),
            Self::Face(Side::Left) => word!("face-left"),
            Self::Face(Side::Ahead) => word!("face-ahead"),
            Self::ToJunction(_) => word!("to-junction"),
            Self::Take(Turn::Straight) => word!("take-straight"),
            Self::Take(Turn::Right) => word!("take-right"),
            Self::Take(Turn::Left) => word!("take-left"),
            Self::Take(Turn::Nth(n)) => {
                return told!(language, "take-nth", n, nth = Nth(n.into())).into();
            }
            Self::ToDoor(Side::Right) => word!("to-door-right"),
            Self::ToDoor(Side::Left) => word!("to-door-left"),
            Self::ToDoor(Side::Ahead) => word!("to-door-ahead"),
            Self::UTurn => word!("u-turn"),
        };
        words.say(language)
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
        match self {
            Self::ToDoor(side) => {
                let side = match side {
                    Side::Right => "right",
                    Side::Left => "left",
                    Side::Ahead => "ahead",
                };
                told!(language, "drive-to-entrance", nth = Nth(passed + 1), side)
            }
            Self::ToJunction(_) if passed > 0 => told!(language, "drive-past-entrances", passed),
            Self::ToJunction(_) => told!(language, "drive-to-junction"),
            Self::Face(Side::Right) => told!(language, "stand-right"),
            Self::Face(Side::Left) => told!(language, "stand-left"),
            Self::Face(Side::Ahead) => told!(language, "stand-ahead"),
            Self::Take(Turn::Straight) => told!(language, "go-straight"),
            Self::Take(Turn::Right) => told!(language, "turn-right"),
            Self::Take(Turn::Left) => told!(language, "turn-left"),
            Self::Take(Turn::Nth(n)) => told!(language, "turn-nth", n, nth = Nth(n.into())),
            Self::UTurn => told!(language, "make-u-turn"),
        }
    }
}

/// Which one: in Russian the number, to which each message has the ending that its noun asks for; in English the ordinal.
struct Nth(usize);

impl Value for Nth {
    fn told(&self, language: Language) -> Option<Argument<'_>> {
        let told = match language {
            Language::Russian => self.0.to_string(),
            Language::English => english_ordinal(self.0),
        };
        Some(told.into())
    }
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
