//! A way in words: the doors to go through, the turns on the way, how far, and what stands beside it.
//!
//! Which way one turns and what one passes is geometry's to find; how people tell it is here. Three levels of detail, as
//! of a position report: the rooms alone, doors and turns, and every stretch with its length and landmarks.
//!
//! Invariant: the sentences depend on the values alone, and no turn is told that is not among them.
//!
//! ```
//! use orthoframe_language::Language;
//! use orthoframe_language::directions::{Directions, Exit, Goal, RoomPart, Stretch, Turns};
//! use orthoframe_language::report::{Detail, Named, OpeningKind};
//! let stretch = |angle| Stretch { angle, at: None, length: 200.0, passed: vec![] };
//! let exit = Exit { opening: OpeningKind::Door, name: Some(Named::plain("Дверь-ВZ")), angle: 0.0 };
//! let first = RoomPart { room: Named::plain("Комната-В"), stretches: vec![stretch(None)], exit: Some(exit) };
//! let last = RoomPart { room: Named::plain("Комната-Z"), stretches: vec![stretch(Some(90.0))], exit: None };
//! let way = Directions { passages: vec![first, last], goal: Goal::Thing(Named::plain("Точка-К")),
//!     turns: Turns::default() };
//! assert_eq!(
//!     way.say_in(Language::Russian, Detail::Spot).join(" "),
//!     "Выйдите из Комнаты-В через Дверь-ВZ в Комнату-Z. Поверните налево и дойдите до Точки-К."
//! );
//! ```

use super::report::{Detail, Named, OpeningKind};
use super::words::russian::{self, Preposition};
use super::words::{Case, Gender, Language, Number, enumerate, length};
use crate::semantics::Thresholds;
use crate::units::capitalized;

/// A change of direction, as people name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Turn {
    Straight,
    SlightlyLeft,
    Left,
    SlightlyRight,
    Right,
    Round,
}

/// From which angles on people speak of a turn, degrees, and from which lengths of a way; the rule text says it («turn
/// straight», «way told» and their kind).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turns {
    /// Up to here one goes straight on.
    pub straight: f64,
    /// Up to here one bears left or right.
    pub slight: f64,
    /// From here on one turns round.
    pub round: f64,
    /// A shorter stretch is not worth a word, cm,
    pub told: f64,
    /// and a shorter way is none.
    pub none: f64,
}

impl Default for Turns {
    /// As the standard rule text has them.
    fn default() -> Self {
        Self::from(&Thresholds::default())
    }
}

impl From<&Thresholds> for Turns {
    fn from(said: &Thresholds) -> Self {
        Self {
            straight: said.turn_straight,
            slight: said.turn_slight,
            round: said.turn_round,
            told: said.way_told,
            none: said.way_none,
        }
    }
}

impl Turns {
    /// The name of an angle in degrees, counter-clockwise, from -180 to 180.
    #[must_use]
    pub fn name(&self, angle: f64) -> Turn {
        match (angle.abs(), angle > 0.0) {
            (a, _) if a < self.straight => Turn::Straight,
            (a, true) if a < self.slight => Turn::SlightlyLeft,
            (a, false) if a < self.slight => Turn::SlightlyRight,
            (a, _) if a > self.round => Turn::Round,
            (_, true) => Turn::Left,
            (_, false) => Turn::Right,
        }
    }
}

impl Turn {
    /// «поверните налево», "turn left"; nothing for straight on.
    fn imperative(self, language: Language) -> Option<&'static str> {
        let (russian, english) = match self {
            Self::Straight => return None,
            Self::SlightlyLeft => ("возьмите левее", "bear left"),
            Self::Left => ("поверните налево", "turn left"),
            Self::SlightlyRight => ("возьмите правее", "bear right"),
            Self::Right => ("поверните направо", "turn right"),
            Self::Round => ("развернитесь", "turn round"),
        };
        Some(if language == Language::Russian { russian } else { english })
    }
}

/// On which hand something is for one who goes the way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    Left,
    Right,
}

/// A straight part of a way within a room.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretch {
    /// The turn at its beginning, degrees counter-clockwise; none where it is not known how one stands.
    pub angle: Option<f64>,
    /// What stands where one turns.
    pub at: Option<Named>,
    /// cm
    pub length: f64,
    /// What one passes, in order.
    pub passed: Vec<(Side, Named)>,
}

/// How a room is left.
#[derive(Debug, Clone, PartialEq)]
pub struct Exit {
    pub opening: OpeningKind,
    pub name: Option<Named>,
    /// The turn into the opening, degrees counter-clockwise.
    pub angle: f64,
}

/// A way's part in one room.
#[derive(Debug, Clone, PartialEq)]
pub struct RoomPart {
    pub room: Named,
    pub stretches: Vec<Stretch>,
    /// None in the last room.
    pub exit: Option<Exit>,
}

/// What the way leads to.
#[derive(Debug, Clone, PartialEq)]
pub enum Goal {
    /// The last room itself.
    Room,
    /// A thing, a place, a door in the last room.
    Thing(Named),
    /// Coordinates, as they were given.
    Point(String),
}

/// A way from room to room on one Map.
#[derive(Debug, Clone, PartialEq)]
pub struct Directions {
    /// One at least.
    pub passages: Vec<RoomPart>,
    pub goal: Goal,
    pub turns: Turns,
}

impl Directions {
    /// The way as sentences, with as much as is asked for.
    #[must_use]
    pub fn say_in(&self, language: Language, detail: Detail) -> Vec<String> {
        let mut sentences = match detail {
            Detail::Region => vec![self.rooms(language)],
            _ => (0..self.passages.len())
                .filter_map(|n| self.say_passage(n, language, detail))
                .collect(),
        };
        if sentences.is_empty() || self.is_there() {
            sentences = vec![self.already_there(language)];
        }
        sentences
    }

    /// Whether no step is left to the goal.
    #[must_use]
    pub fn is_there(&self) -> bool {
        let length = |passage: &RoomPart| passage.stretches.iter().map(|s| s.length).sum::<f64>();
        matches!(&self.passages[..], [only] if length(only) < self.turns.none)
    }

    /// One room's part of the way as a sentence; none where nothing is left to do.
    #[must_use]
    pub fn say_passage(&self, n: usize, language: Language, detail: Detail) -> Option<String> {
        let passage = &self.passages[n];
        let next = self.passages.get(n + 1).map(|p| &p.room);
        let told =
            Told { language, passage, first: n == 0, next, goal: &self.goal, turns: self.turns };
        let text = if detail == Detail::Heading { told.stretches()? } else { told.turns()? };
        Some(sentence(&text))
    }

    fn already_there(&self, language: Language) -> String {
        let room = self.passages.last().map(|p| &p.room);
        match (&self.goal, room, language) {
            (Goal::Thing(thing), _, Language::Russian) => {
                let at = russian::with(Preposition::U, Case::Genitive, thing.phrase());
                format!("Вы уже {at}.")
            }
            (Goal::Thing(thing), _, Language::English) => {
                format!("You are already at {}.", thing.english())
            }
            (Goal::Room, Some(room), Language::Russian) => {
                format!("Вы уже {}.", russian::where_at(room.phrase()))
            }
            (Goal::Room, Some(room), Language::English) => {
                format!("You are already {}.", room.english_place())
            }
            (_, _, Language::Russian) => "Вы уже на месте.".to_owned(),
            (_, _, Language::English) => "You are already there.".to_owned(),
        }
    }

    /// «Пройдите из Комнаты-В через Комнату-Z в Комнату-Y, к Точке-К.»
    fn rooms(&self, language: Language) -> String {
        let rooms: Vec<&Named> = self.passages.iter().map(|p| &p.room).collect();
        let (first, last, between) = match &rooms[..] {
            [first, between @ .., last] => (*first, *last, between),
            _ => {
                let target = self.target(language);
                return match (target, language) {
                    (None, _) => self.already_there(language),
                    (Some(to), Language::Russian) => {
                        let here = capitalized(&russian::where_at(rooms[0].phrase()));
                        format!("{here} пройдите {to}.")
                    }
                    (Some(to), Language::English) => {
                        format!("In {}, go to {to}.", rooms[0].english())
                    }
                };
            }
        };
        let to = self.target(language);
        match language {
            Language::Russian => {
                let through: Vec<String> =
                    between.iter().map(|r| r.phrase().case(Case::Accusative)).collect();
                let through = if through.is_empty() {
                    String::new()
                } else {
                    format!(" через {}", enumerate(&through, language))
                };
                let to = to.map(|to| format!(", {to}")).unwrap_or_default();
                let (from, into) =
                    (russian::whence(first.phrase()), russian::whither(last.phrase()));
                format!("Пройдите {from}{through} {into}{to}.")
            }
            Language::English => {
                let through: Vec<String> = between.iter().map(|r| r.english()).collect();
                let through = if through.is_empty() {
                    String::new()
                } else {
                    format!(" through {}", enumerate(&through, language))
                };
                let to = to.map(|to| format!(", to {to}")).unwrap_or_default();
                format!("Go from {}{through} to {}{to}.", first.english(), last.english())
            }
        }
    }

    /// «к Точке-К», "Point K"
    fn target(&self, language: Language) -> Option<String> {
        match (&self.goal, language) {
            (Goal::Room, _) => None,
            (Goal::Thing(thing), Language::Russian) => {
                Some(russian::with(Preposition::K, Case::Dative, thing.phrase()))
            }
            (Goal::Thing(thing), Language::English) => Some(thing.english()),
            (Goal::Point(at), Language::Russian) => Some(format!("к точке {at}")),
            (Goal::Point(at), Language::English) => Some(format!("the point {at}")),
        }
    }
}

/// One room's part of a way, about to be said.
#[derive(Clone, Copy)]
struct Told<'a> {
    language: Language,
    passage: &'a RoomPart,
    first: bool,
    next: Option<&'a Named>,
    goal: &'a Goal,
    turns: Turns,
}

impl Told<'_> {
    fn is_russian(&self) -> bool {
        self.language == Language::Russian
    }

    fn pick<'a>(&self, russian: &'a str, english: &'a str) -> &'a str {
        if self.is_russian() { russian } else { english }
    }

    /// Doors and turns: «Поверните налево, затем направо и выйдите через Дверь-ZY в Комнату-Y.»
    fn turns(&self) -> Option<String> {
        let end = self.end()?;
        // How one stands in the first room is mostly unknown: without that no turn has a meaning.
        if self.first && self.passage.stretches.first().is_none_or(|s| s.angle.is_none()) {
            return Some(end);
        }
        let turns = self.main_turns();
        let Some((first, rest)) = turns.split_first() else {
            return Some(match (self.first, self.is_russian()) {
                (true, _) => end,
                (false, true) => match self.target_after_walk() {
                    Some(to) => format!("идите прямо {to}"),
                    None => format!("идите прямо и {end}"),
                },
                (false, false) => {
                    let way = self
                        .target_after_walk()
                        .unwrap_or_else(|| end.strip_prefix("go ").unwrap_or(&end).to_owned());
                    format!("go straight on {way}")
                }
            });
        };
        let mut text = first.imperative(self.language).unwrap_or_default().to_owned();
        let mut before = *first;
        for turn in rest {
            text.push_str(self.pick(", затем ", ", then "));
            let whole = turn.imperative(self.language).unwrap_or_default();
            // «Поверните направо, затем налево»
            let verb = before.imperative(self.language).and_then(|b| b.split(' ').next());
            let shorter = verb.and_then(|verb| whole.strip_prefix(verb)).map(str::trim_start);
            text.push_str(shorter.filter(|rest| !rest.is_empty()).unwrap_or(whole));
            before = *turn;
        }
        Some(format!("{text}{}{end}", self.pick(" и ", " and ")))
    }

    /// The turns of the room that are worth a word: slight ones to one side are one turn, lone slight ones none but
    /// the first.
    fn main_turns(&self) -> Vec<Turn> {
        let inner = self.passage.stretches.iter().filter_map(|s| s.angle);
        let angles = inner.chain(self.passage.exit.iter().map(|e| e.angle));
        let mut merged: Vec<f64> = Vec::new();
        for angle in angles.filter(|a| a.abs() >= self.turns.straight) {
            let slight = |a: f64| a.abs() < self.turns.slight;
            match merged.last_mut() {
                Some(last) if slight(angle) && slight(*last) && (*last > 0.0) == (angle > 0.0) => {
                    *last += angle
                }
                _ => merged.push(angle),
            }
        }
        let mut turns: Vec<Turn> = merged.into_iter().map(|angle| self.turns.name(angle)).collect();
        if turns.iter().any(|t| !is_slight(*t)) {
            turns.retain(|t| !is_slight(*t));
        }
        // A bend to one side and back is a way round something, not a way to remember.
        if turns.iter().all(|t| is_slight(*t)) {
            turns.truncate(1);
        }
        turns
    }

    /// Every stretch: «В Комнате-Z поверните налево, пройдите 2 м мимо Стола (он слева) и выйдите через …».
    fn stretches(&self) -> Option<String> {
        // The room stands at the beginning of the sentence already.
        let end = Told { first: false, ..*self }.end();
        let length: f64 = self.passage.stretches.iter().map(|stretch| stretch.length).sum();
        if end.is_none() && !self.first && length < self.turns.told {
            return None;
        }
        let mut clauses: Vec<String> = Vec::new();
        for stretch in &self.passage.stretches {
            if let Some(turn) =
                stretch.angle.and_then(|a| self.turns.name(a).imperative(self.language))
            {
                clauses.push(match (&stretch.at, self.is_russian()) {
                    (Some(at), true) => format!(
                        "{} {turn}",
                        russian::with(Preposition::U, Case::Genitive, at.phrase())
                    ),
                    (Some(at), false) => format!("{turn} at {}", at.english()),
                    (None, _) => turn.to_owned(),
                });
            }
            clauses.push(self.walk(stretch));
        }
        if clauses.is_empty() && end.is_none() {
            return None;
        }
        let at = match self.is_russian() {
            true => russian::where_at(self.passage.room.phrase()),
            false => format!("in {},", self.passage.room.english()),
        };
        // «пройдите 3,8 м мимо Стола-1 (он слева) до Стула-2»
        let end = match (self.target_after_walk(), clauses.last_mut()) {
            (Some(to), Some(walk)) => {
                walk.push(' ');
                walk.push_str(&to);
                None
            }
            _ => end,
        };
        let end = end.into_iter().map(|end| match &self.passage.exit {
            Some(exit) if self.turns.name(exit.angle) != Turn::Straight => {
                let turn =
                    self.turns.name(exit.angle).imperative(self.language).unwrap_or_default();
                format!("{turn}{}{end}", self.pick(" и ", " and "))
            }
            _ => end,
        });
        let all: Vec<String> = clauses.into_iter().chain(end).collect();
        let text = match all.last() {
            // «… и выйдите», but «…, поверните налево и выйдите».
            Some(last) if last.contains(self.pick(" и ", " and ")) => all.join(", "),
            _ => enumerate(&all, self.language),
        };
        Some(format!("{at} {text}"))
    }

    fn walk(&self, stretch: &Stretch) -> String {
        let far = length(round_length(stretch.length), self.language);
        let passed: Vec<String> = stretch
            .passed
            .iter()
            .map(|(side, thing)| match (side, self.is_russian()) {
                (side, true) => {
                    let phrase = thing.phrase();
                    let it = match (phrase.number(), phrase.gender()) {
                        (Number::Plural, _) => "они",
                        (_, Gender::Feminine) => "она",
                        (_, Gender::Neuter) => "оно",
                        (_, Gender::Masculine) => "он",
                    };
                    let side = if *side == Side::Left { "слева" } else { "справа" };
                    format!("{} ({it} {side})", phrase.case(Case::Genitive))
                }
                (Side::Left, false) => format!("{} (on your left)", thing.english()),
                (Side::Right, false) => format!("{} (on your right)", thing.english()),
            })
            .collect();
        let by = match (passed.is_empty(), self.is_russian()) {
            (true, _) => String::new(),
            (false, true) => format!(" мимо {}", enumerate(&passed, self.language)),
            (false, false) => format!(" past {}", enumerate(&passed, self.language)),
        };
        format!("{} {far}{by}", self.pick("пройдите", "walk"))
    }

    /// «до Точки-К», "to Point K", behind a way that was told; none where the way goes on, or the room was the goal.
    fn target_after_walk(&self) -> Option<String> {
        if self.passage.exit.is_some() && self.next.is_some() {
            return None;
        }
        match (self.goal, self.is_russian()) {
            (Goal::Room, _) => None,
            (Goal::Thing(thing), true) => {
                Some(russian::with(Preposition::Do, Case::Genitive, thing.phrase()))
            }
            (Goal::Thing(thing), false) => Some(format!("to {}", thing.english())),
            (Goal::Point(at), true) => Some(format!("до точки {at}")),
            (Goal::Point(at), false) => Some(format!("to the point {at}")),
        }
    }

    /// «выйдите через Дверь-ВZ в Комнату-Z», «дойдите до Точки-К»; none where the room itself was the goal.
    fn end(&self) -> Option<String> {
        let (Some(exit), Some(next)) = (&self.passage.exit, self.next) else {
            let verb = match self.goal {
                Goal::Thing(_) => self.pick("дойдите", "walk up"),
                _ => self.pick("дойдите", "walk"),
            };
            return self.target_after_walk().map(|to| format!("{verb} {to}"));
        };
        Some(match self.is_russian() {
            true => {
                let door = match (&exit.name, exit.opening) {
                    (Some(name), _) => name.phrase().case(Case::Accusative),
                    (None, OpeningKind::Door) => "дверь".to_owned(),
                    (None, OpeningKind::Passage) => "проход".to_owned(),
                };
                let from = if self.first {
                    format!(" {}", russian::whence(self.passage.room.phrase()))
                } else {
                    String::new()
                };
                format!("выйдите{from} через {door} {}", russian::whither(next.phrase()))
            }
            false => {
                let door = match (&exit.name, exit.opening) {
                    (Some(name), opening) => name.english_door(opening),
                    (None, opening) => opening.english().to_owned(),
                };
                match self.first {
                    true => format!(
                        "leave {} through {door} into {}",
                        self.passage.room.english(),
                        next.english()
                    ),
                    false => format!("go through {door} into {}", next.english()),
                }
            }
        })
    }
}

fn is_slight(turn: Turn) -> bool {
    matches!(turn, Turn::SlightlyLeft | Turn::SlightlyRight)
}

/// Nobody counts centimetres of a way: tenths of a metre, and below one metre tens of centimetres.
fn round_length(cm: f64) -> f64 {
    (cm / 10.0).round().max(1.0) * 10.0
}

fn sentence(text: &str) -> String {
    format!("{}.", capitalized(text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::WordHints;
    use expect_test::{Expect, expect};

    fn name(name: &str) -> Named {
        Named::plain(name)
    }

    fn stretch(angle: Option<f64>, length: f64) -> Stretch {
        Stretch { angle, at: None, length, passed: vec![] }
    }

    fn check(way: &Directions, expected: &Expect) {
        let mut text = String::new();
        for language in [Language::Russian, Language::English] {
            for detail in [Detail::Region, Detail::Spot, Detail::Heading] {
                text.push_str(&way.say_in(language, detail).join(" "));
                text.push('\n');
            }
        }
        expected.assert_eq(&text);
    }

    #[test]
    fn three_levels_in_two_languages() {
        let door = |door: &str, angle| {
            Some(Exit { opening: OpeningKind::Door, name: Some(name(door)), angle })
        };
        let office =
            Named::new("Кабинет директора", &WordHints::default(), Some("director's office"));
        let mut last = stretch(Some(-80.0), 213.0);
        last.at = Some(name("Кресло у окна"));
        last.passed = vec![(Side::Left, name("Письменный стол"))];
        let way = Directions {
            passages: vec![
                RoomPart {
                    room: name("Комната-В"),
                    stretches: vec![stretch(None, 320.0)],
                    exit: door("Дверь-ВZ", 30.0),
                },
                RoomPart {
                    room: name("Кухня"),
                    stretches: vec![stretch(Some(40.0), 95.0), stretch(Some(-35.0), 55.0)],
                    exit: door("Дверь-ZY", 45.0),
                },
                RoomPart { room: office, stretches: vec![last], exit: None },
            ],
            goal: Goal::Thing(name("Точка-К")),
            turns: Turns::default(),
        };
        check(
            &way,
            &expect![[r#"
                Пройдите из Комнаты-В через Кухню в Кабинет директора, к Точке-К.
                Выйдите из Комнаты-В через Дверь-ВZ на Кухню. Возьмите левее и выйдите через Дверь-ZY в Кабинет директора. Поверните направо и дойдите до Точки-К.
                В Комнате-В пройдите 3,2 м, возьмите левее и выйдите через Дверь-ВZ на Кухню. На Кухне возьмите левее, пройдите 1 м, возьмите правее, пройдите 60 см, возьмите левее и выйдите через Дверь-ZY в Кабинет директора. В Кабинете директора у Кресла у окна поверните направо и пройдите 2,1 м мимо Письменного стола (он слева) до Точки-К.
                Go from Room-B through the kitchen to director's office, to Point-K.
                Leave Room-B through Door-BZ into the kitchen. Bear left and go through Door-ZY into director's office. Turn right and walk up to Point-K.
                In Room-B, walk 3.2 m, bear left and go through Door-BZ into the kitchen. In the kitchen, bear left, walk 1 m, bear right, walk 60 cm, bear left and go through Door-ZY into director's office. In director's office, turn right at Кресло у окна and walk 2.1 m past the desk (on your left) to Point-K.
            "#]],
        );
    }

    #[test]
    fn who_is_there_already_is_told_so() {
        let here = || RoomPart { room: name("Кухня"), stretches: vec![], exit: None };
        let at = Directions {
            passages: vec![here()],
            goal: Goal::Thing(name("Стол")),
            turns: Turns::default(),
        };
        check(
            &at,
            &expect![[r#"
            Вы уже у Стола.
            Вы уже у Стола.
            Вы уже у Стола.
            You are already at the table.
            You are already at the table.
            You are already at the table.
        "#]],
        );
        check(
            &Directions { passages: vec![here()], goal: Goal::Room, turns: Turns::default() },
            &expect![[r#"
            Вы уже на Кухне.
            Вы уже на Кухне.
            Вы уже на Кухне.
            You are already in the kitchen.
            You are already in the kitchen.
            You are already in the kitchen.
        "#]],
        );
    }
}
