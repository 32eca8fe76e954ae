//! Where the robot is, in words: from a situation that geometry found to one sentence.
//!
//! After the source paper 1, section 8: «Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z.» The region is
//! named first, then the strongest thing that can be said of the spot in it: in the doorway, at a door, next to an
//! object, in a corner, along a wall, in the middle. Which of these hold is geometry's to find; how they are said is here.
//!
//! Invariant: the sentence depends on the values alone; every name in it stands in a form of its own.
//!
//! ```
//! use orthoframe_language::Language;
//! use orthoframe_language::report::{Doorway, Named, Position, Spot};
//! let (here, there) = (Named::plain("Комната-В"), Named::plain("Комната-Z"));
//! let position = Position::new(here.clone(), [Spot::InMiddle, Spot::AtDoor(Doorway::door(here, there))]);
//! assert_eq!(
//!     position.say(Language::Russian),
//!     "Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z."
//! );
//! assert_eq!(position.say(Language::English), "I am in Room-B at the door leading from Room-B to Room-Z.");
//! ```

mod english;
mod named;
pub mod read;
mod russian;

pub use named::{Doorway, Named, Opening};

use super::words::Language;

/// How the robot stands to an object that the map has only once, or that is told apart by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Beside {
    /// A rug or mat is underfoot.
    On,
    NextTo,
    /// In front of the object's own front.
    InFrontOf,
    Behind,
    LeftOf,
    RightOf,
}

/// Something that is true of the robot's spot within its Area.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Spot {
    InDoorway(Doorway),
    AtDoor(Doorway),
    Object(Beside, Named),
    /// In a corner, with the thing that tells which where there is one.
    InCorner(Option<Named>),
    /// By a wall, with the thing that tells which where there is one.
    AlongWall(Option<Named>),
    InMiddle,
}

impl Spot {
    /// The order in which spots are preferred, the strongest first.
    fn strength(&self) -> u8 {
        match self {
            Self::InDoorway(_) => 0,
            Self::AtDoor(_) => 1,
            Self::Object(..) => 2,
            Self::InCorner(_) => 3,
            Self::AlongWall(_) => 4,
            Self::InMiddle => 5,
        }
    }
}

/// What the robot faces.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Facing {
    Door(Doorway),
    /// A leaf of a door that stands open.
    Leaf(Doorway),
    Object(Named),
    /// Some wall, where it was not said that the robot is by one.
    Wall,
    /// The wall by which it is said to be.
    OwnWall,
    /// Another than that.
    OtherWall,
    /// Nothing near: free floor.
    Inward,
}

/// How much a report says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Detail {
    /// The region alone: «Я нахожусь в Комнате-В.»
    Region,
    /// The region and the strongest spot: the paper's sentence.
    #[default]
    Spot,
    /// And the heading.
    Heading,
}

/// What tells a room from its namesakes on one floor.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Mark {
    /// The room that lies beside it: «в Ванной, соседней со Спальней».
    Adjoining(Named),
    /// Something that it has: «в Ванной с Душем», «в Палате с Дверью-17».
    With(Named),
}

/// What an Area lies in and by what it is told from others of its name, as far as needed.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Context {
    /// Narrow before wide: storey, building.
    pub within: Vec<Named>,
    pub mark: Option<Mark>,
}

/// A pose as geometry understood it, ready to be said.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Position {
    /// None when the pose is on no Area of the map.
    pub area: Option<Named>,
    /// What tells the Area from others where nothing else is said.
    pub context: Context,
    /// The same where the spot is said too, which may tell enough by itself.
    pub spot_context: Context,
    /// All that holds; the strongest is said, of two equals the first.
    pub spots: Vec<Spot>,
    pub facing: Option<Facing>,
}

impl Position {
    #[must_use]
    pub fn new(area: Named, spots: impl IntoIterator<Item = Spot>) -> Self {
        Self {
            area: Some(area),
            context: Context::default(),
            spot_context: Context::default(),
            spots: spots.into_iter().collect(),
            facing: None,
        }
    }

    /// The strongest thing that can be said of the spot.
    #[must_use]
    pub fn strongest(&self) -> Option<&Spot> {
        self.spots.iter().min_by_key(|spot| spot.strength())
    }

    /// The paper's sentence: region and spot; the heading too where it is given.
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        self.say_in(language, if self.facing.is_some() { Detail::Heading } else { Detail::Spot })
    }

    /// The report with as much as is asked for, one sentence.
    #[must_use]
    pub fn say_in(&self, language: Language, detail: Detail) -> String {
        let spot = self.strongest().filter(|_| detail > Detail::Region);
        let facing = self.facing.as_ref().filter(|_| detail >= Detail::Heading);
        let (start, place, heading) = match language {
            Language::Russian => {
                ("Я нахожусь", self.russian(spot), facing.map(|facing| facing.russian(spot)))
            }
            Language::English => {
                ("I am", self.english(spot), facing.map(|facing| facing.english(spot)))
            }
        };
        let heading = heading.map(|heading| format!(", {heading}")).unwrap_or_default();
        format!("{start} {place}{heading}.")
    }

    fn context(&self, spot: Option<&Spot>) -> &Context {
        if spot.is_some() { &self.spot_context } else { &self.context }
    }
}

impl Facing {
    /// Whether the spot has told already what is faced, so that «к ней» is enough.
    fn is_told(&self, spot: Option<&Spot>) -> bool {
        match (self, spot) {
            (Self::Door(door), Some(Spot::AtDoor(told))) => door == told,
            (Self::Object(object), Some(Spot::Object(_, told))) => object == told,
            (Self::OwnWall, Some(Spot::AlongWall(_))) => true,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::words::WordHints;

    fn check(position: &Position, expected: &Expect) {
        expected.assert_eq(&format!(
            "{}\n{}",
            position.say(Language::Russian),
            position.say(Language::English)
        ));
    }

    fn name(name: &str) -> Named {
        Named::plain(name)
    }

    fn at(area: &str, spot: Spot) -> Position {
        Position::new(name(area), [Spot::InMiddle, spot])
    }

    #[test]
    fn the_papers_sentence() {
        let door = Doorway::door(name("Комната-В"), name("Комната-Z"));
        check(
            &at("Комната-В", Spot::AtDoor(door)),
            &expect![[r#"
            Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z.
            I am in Room-B at the door leading from Room-B to Room-Z."#]],
        );
    }

    #[test]
    fn every_kind_of_spot_reads_well() {
        check(
            &at("Кухня", Spot::AtDoor(Doorway::passage(name("Кухня"), name("Коридор")))),
            &expect![[r#"
            Я нахожусь на Кухне у прохода, ведущего с Кухни в Коридор.
            I am in the kitchen at the passage leading from the kitchen to the corridor."#]],
        );
        check(
            &at("Комната-В", Spot::InDoorway(Doorway::door(name("Комната-В"), name("Коридор")))),
            &expect![[r#"
            Я нахожусь в дверном проёме между Комнатой-В и Коридором.
            I am in the doorway between Room-B and the corridor."#]],
        );
        check(
            &at("Гостиная 2", Spot::Object(Beside::NextTo, name("Шкаф-бар"))),
            &expect![[r#"
            Я нахожусь в Гостиной 2 рядом со Шкафом-баром.
            I am in Living room 2 next to the bar cabinet."#]],
        );
        check(
            &at("Балкон", Spot::Object(Beside::LeftOf, name("Кресло-качалка"))),
            &expect![[r#"
            Я нахожусь на Балконе слева от Кресла-качалки.
            I am on the balcony to the left of the rocking chair."#]],
        );
        check(
            &at("Спальня", Spot::InCorner(Some(name("Окно")))),
            &expect![[r#"
            Я нахожусь в углу Спальни у Окна.
            I am in the corner of the bedroom by the window."#]],
        );
        check(
            &at("Холл", Spot::AlongWall(None)),
            &expect![[r#"
            Я нахожусь в Холле у стены.
            I am in the hall by the wall."#]],
        );
        check(
            &at("Кабинет 305", Spot::InMiddle),
            &expect![[r#"
            Я нахожусь в середине Кабинета 305.
            I am in the middle of Study 305."#]],
        );
    }

    #[test]
    fn a_named_door_is_told_from_its_neighbour() {
        let door = Doorway {
            name: Some(name("Ворота")),
            ..Doorway::door(name("Гараж"), name("Двор"))
        };
        let mut position = at("Гараж", Spot::AtDoor(door.clone()));
        check(
            &position,
            &expect![[r#"
            Я нахожусь в Гараже у Ворот, ведущих из Гаража во Двор.
            I am in the garage at the gate leading from the garage to the yard."#]],
        );
        position.facing = Some(Facing::Door(door));
        assert!(position.say(Language::Russian).ends_with("во Двор, лицом к ним."));
    }

    #[test]
    fn heading_and_wider_context_on_request() {
        let mut position = at("Палата 3", Spot::Object(Beside::InFrontOf, name("Кровать")));
        position.facing = Some(Facing::Object(name("Тумбочка-1")));
        position.context.within = vec![name("2-й этаж"), name("Корпус 1")];
        position.spot_context = position.context.clone();
        check(
            &position,
            &expect![[r#"
                Я нахожусь в Корпусе 1 на 2-м этаже в Палате 3 перед Кроватью, лицом к Тумбочке-1.
                I am in Ward 3 in front of the bed, on the 2nd floor, in Building 1, facing Bedside table 1."#]],
        );
        assert_eq!(
            position.say_in(Language::Russian, Detail::Region),
            "Я нахожусь в Корпусе 1 на 2-м этаже в Палате 3."
        );
        position.facing = Some(Facing::Door(Doorway::door(name("Палата 3"), name("Коридор"))));
        check(
            &position,
            &expect![[r#"
                Я нахожусь в Корпусе 1 на 2-м этаже в Палате 3 перед Кроватью, лицом к двери, ведущей из Палаты 3 в Коридор.
                I am in Ward 3 in front of the bed, on the 2nd floor, in Building 1, facing the door leading from Ward 3 to the corridor."#]],
        );
    }

    #[test]
    fn a_namesake_on_the_same_floor_is_told_by_a_mark() {
        let mut position = at("Ванная", Spot::AlongWall(None));
        position.spot_context.mark = Some(Mark::Adjoining(name("Спальня")));
        check(
            &position,
            &expect![[r#"
            Я нахожусь в Ванной, соседней со Спальней, у стены.
            I am in the bathroom adjoining the bedroom by the wall."#]],
        );
        position.context.mark = Some(Mark::Adjoining(name("Коридор")));
        assert_eq!(
            position.say_in(Language::Russian, Detail::Region),
            "Я нахожусь в Ванной, соседней с Коридором."
        );
        let mut position = Position::new(name("Палата"), [Spot::InMiddle]);
        position.spot_context.mark = Some(Mark::With(name("Дверь-17")));
        check(
            &position,
            &expect![[r#"
                Я нахожусь в середине Палаты с Дверью-17.
                I am in the middle of the ward with Door-17."#]],
        );
    }

    #[test]
    fn a_pose_on_no_area_is_said_to_be_off_the_map() {
        let (context, spot_context) = (Context::default(), Context::default());
        let position = Position { area: None, context, spot_context, spots: vec![], facing: None };
        check(
            &position,
            &expect![[r#"
            Я нахожусь вне карты.
            I am off the map."#]],
        );
    }

    #[test]
    fn names_with_an_english_twin_keep_it() {
        let own = Named::new("Кабинет директора", &WordHints::default(), Some("Director's office"));
        check(
            &Position::new(own, [Spot::AlongWall(Some(name("Диван")))]),
            &expect![[r#"
            Я нахожусь в Кабинете директора у стены возле Дивана.
            I am in Director's office by the wall near the sofa."#]],
        );
    }
}
