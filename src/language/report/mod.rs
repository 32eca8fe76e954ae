//! Where the robot is, in words: from a situation that geometry found to one sentence.
//!
//! After the source paper 1, section 8: «Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z.» The region is
//! named first, then the strongest thing that can be said of the spot in it: in the doorway, at a door, next to an
//! object, in a corner, along a wall, in the middle. Which of these hold is geometry's to find; how they are said is here.
//!
//! Invariant: the sentence depends on the values alone; every name in it stands in a form of its own.
//!
//! ```
//! use orthoframe::language::Language;
//! use orthoframe::language::report::{Doorway, Named, Position, Spot};
//! let (here, there) = (Named::plain("Комната-В"), Named::plain("Комната-Z"));
//! let position = Position::new(here.clone(), [Spot::InMiddle, Spot::AtDoor(Doorway::door(here, there))]);
//! assert_eq!(
//!     position.say(Language::Russian),
//!     "Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z."
//! );
//! assert_eq!(position.say(Language::English), "I am in Room-B at the door leading from Room-B to Room-Z.");
//! ```

pub mod read;

use super::words::russian::{self, Preposition};
use super::words::{Case, Gender, Language, NounPhrase, Number, WordHints, english};

/// A name of the map in both languages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Named {
    /// Boxed, since a doorway holds three names and a report several doorways.
    russian: Box<NounPhrase>,
    english: String,
}

impl Named {
    /// A name with what the map knows of it. Without an English name one is made where every word is known, and else
    /// the Russian one is kept.
    #[must_use]
    pub fn new(name: &str, hints: &WordHints, english_name: Option<&str>) -> Self {
        let english = english_name
            .map(Into::into)
            .or_else(|| english::name_of(name))
            .unwrap_or_else(|| name.to_owned());
        Self { russian: Box::new(NounPhrase::parse(name, hints)), english }
    }

    /// A name of which nothing more is known.
    #[must_use]
    pub fn plain(name: &str) -> Self {
        Self::new(name, &WordHints::default(), None)
    }

    #[must_use]
    pub fn phrase(&self) -> &NounPhrase {
        &self.russian
    }

    /// The English name as it is.
    #[must_use]
    pub fn english_name(&self) -> &str {
        &self.english
    }

    /// The English name within a sentence, with its article.
    #[must_use]
    pub fn english(&self) -> String {
        english::with_article(&self.english)
    }

    /// The name within a sentence: in a case, or with its article.
    #[must_use]
    pub fn form(&self, case: Case, language: Language) -> String {
        match language {
            Language::Russian => self.russian.case(case),
            Language::English => self.english(),
        }
    }

    /// "in the corridor", but "on the balcony".
    fn english_place(&self) -> String {
        use super::words::PlaceSense::{Inside, Upon};
        let on = [
            "balcony", "stairs", "terrace", "porch", "roof", "floor", "storey", "landing",
            "street", "bridge", "veranda",
        ];
        let lower = self.english.to_lowercase();
        match self.russian.place() {
            Upon if on
                .iter()
                .any(|word| lower.split(|c: char| !c.is_alphabetic()).any(|w| w == *word)) =>
            {
                format!("on {}", self.english())
            }
            Upon | Inside => format!("in {}", self.english()),
        }
    }
}

/// What leads from one Area to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Opening {
    Door,
    /// An opening without a leaf.
    Passage,
}

/// A door or passage, told by the Areas on its two sides.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Doorway {
    pub opening: Opening,
    /// Its own name, where the two Areas do not tell it from another.
    pub name: Option<Named>,
    pub from: Named,
    /// None for a door that leads out of the map.
    pub to: Option<Named>,
}

impl Doorway {
    /// The only door from one Area to another.
    #[must_use]
    pub fn door(from: Named, to: Named) -> Self {
        Self { opening: Opening::Door, name: None, from, to: Some(to) }
    }

    /// The only passage from one Area to another.
    #[must_use]
    pub fn passage(from: Named, to: Named) -> Self {
        Self { opening: Opening::Passage, ..Self::door(from, to) }
    }

    /// «к ней», «к нему», «к ним»
    fn pronoun(&self) -> &'static str {
        match (&self.name, self.opening) {
            (Some(name), _) => pronoun(&name.russian),
            (None, Opening::Door) => "ней",
            (None, Opening::Passage) => "нему",
        }
    }

    /// «двери, ведущей из Комнаты-В в Комнату-Z», in the case that the sentence needs.
    fn russian(&self, case: Case) -> String {
        let (noun, gender, number) = match (&self.name, self.opening) {
            (Some(name), _) => {
                (name.russian.case(case), name.russian.gender(), name.russian.number())
            }
            (None, Opening::Door) => {
                (common("дверь").case(case), Gender::Feminine, Number::Singular)
            }
            (None, Opening::Passage) => {
                (common("проход").case(case), Gender::Masculine, Number::Singular)
            }
        };
        let leading = russian::agreeing("ведущий", case, number, gender);
        match &self.to {
            Some(to) => {
                format!(
                    "{noun}, {leading} {} {}",
                    russian::whence(&self.from.russian),
                    russian::whither(&to.russian)
                )
            }
            None => format!("{noun}, {leading} {} наружу", russian::whence(&self.from.russian)),
        }
    }

    fn english(&self) -> String {
        let noun = self.name.as_ref().map_or_else(
            || {
                if self.opening == Opening::Door {
                    "the door".to_owned()
                } else {
                    "the passage".to_owned()
                }
            },
            Named::english,
        );
        match &self.to {
            Some(to) => format!("{noun} leading from {} to {}", self.from.english(), to.english()),
            None => format!("{noun} leading out of {}", self.from.english()),
        }
    }
}

/// How the robot stands to an object that the map has only once, or that is told apart by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Beside {
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
    Object(Named),
    Wall,
    /// Into the free middle of the Area.
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
            Language::Russian => (
                "Я нахожусь",
                self.russian(spot),
                facing.map(|facing| facing_in_russian(facing, spot)),
            ),
            Language::English => {
                ("I am", self.english(spot), facing.map(|facing| facing_in_english(facing, spot)))
            }
        };
        let heading = heading.map(|heading| format!(", {heading}")).unwrap_or_default();
        format!("{start} {place}{heading}.")
    }

    fn context(&self, spot: Option<&Spot>) -> &Context {
        if spot.is_some() { &self.spot_context } else { &self.context }
    }

    fn russian(&self, spot: Option<&Spot>) -> String {
        let Some(area) = &self.area else { return "вне карты".into() };
        let area = &area.russian;
        let context = self.context(spot);
        let mark = |case| context.mark.as_ref().map(|m| m.russian(area, case)).unwrap_or_default();
        // A mark set off by a comma ends with one where the sentence goes on.
        let at = format!("{}{}", russian::where_at(area), mark(Case::Prepositional));
        let at = if spot.is_none() { at.trim_end_matches(',').to_owned() } else { at };
        let of = format!("{}{}", area.case(Case::Genitive), mark(Case::Genitive));
        let of = match spot {
            Some(Spot::InCorner(Some(_))) => of,
            _ => of.trim_end_matches(',').to_owned(),
        };
        let near = |thing: &Option<Named>| {
            thing
                .as_ref()
                .map(|thing| {
                    format!(" {}", russian::with(Preposition::U, Case::Genitive, &thing.russian))
                })
                .unwrap_or_default()
        };
        let place = match spot {
            None => at,
            Some(Spot::InDoorway(door)) => doorway_in_russian(door),
            Some(Spot::AtDoor(door)) => format!("{at} у {}", door.russian(Case::Genitive)),
            Some(Spot::Object(beside, object)) => {
                format!("{at} {}", beside_in_russian(*beside, &object.russian))
            }
            Some(Spot::InCorner(thing)) => format!("в углу {of}{}", near(thing)),
            Some(Spot::AlongWall(thing)) => {
                format!("{at} у стены{}", near(thing).replacen(" у ", " возле ", 1))
            }
            Some(Spot::InMiddle) => format!("в середине {of}"),
        };
        let wider = context.within.iter().rev();
        let wider = wider.map(|wide| russian::where_at(&wide.russian) + " ");
        wider.chain([place]).collect()
    }

    fn english(&self, spot: Option<&Spot>) -> String {
        let Some(area) = &self.area else { return "off the map".into() };
        let context = self.context(spot);
        let mark = context.mark.as_ref().map(Mark::english).unwrap_or_default();
        let (at, of) = (area.english_place() + &mark, area.english() + &mark);
        let near = |thing: &Option<Named>| {
            thing.as_ref().map(|thing| format!(" by {}", thing.english())).unwrap_or_default()
        };
        let place = match spot {
            None => at,
            Some(Spot::InDoorway(door)) => doorway_in_english(door),
            Some(Spot::AtDoor(door)) => format!("{at} at {}", door.english()),
            Some(Spot::Object(beside, object)) => {
                format!("{at} {} {}", beside_in_english(*beside), object.english())
            }
            Some(Spot::InCorner(thing)) => format!("in the corner of {of}{}", near(thing)),
            Some(Spot::AlongWall(thing)) => {
                format!("{at} by the wall{}", near(thing).replacen(" by ", " near ", 1))
            }
            Some(Spot::InMiddle) => format!("in the middle of {of}"),
        };
        let wider = context.within.iter().map(|wide| format!(", {}", wide.english_place()));
        std::iter::once(place).chain(wider).collect()
    }
}

impl Mark {
    /// «, соседней со Спальней,», « с Душем»
    fn russian(&self, area: &NounPhrase, case: Case) -> String {
        match self {
            Self::Adjoining(room) => {
                let beside = russian::agreeing("соседний", case, area.number(), area.gender());
                let room = russian::with(Preposition::S, Case::Instrumental, &room.russian);
                format!(", {beside} {room},")
            }
            Self::With(thing) => {
                format!(" {}", russian::with(Preposition::S, Case::Instrumental, &thing.russian))
            }
        }
    }

    fn english(&self) -> String {
        match self {
            Self::Adjoining(room) => format!(" adjoining {}", room.english()),
            Self::With(thing) => format!(" with {}", thing.english()),
        }
    }
}

fn common(noun: &str) -> NounPhrase {
    NounPhrase::parse(noun, &WordHints::default())
}

fn doorway_in_russian(door: &Doorway) -> String {
    let opening = match (&door.name, door.opening) {
        (Some(name), _) => format!("в проёме {}", name.russian.case(Case::Genitive)),
        (None, Opening::Door) => "в дверном проёме".into(),
        (None, Opening::Passage) => "в проходе".into(),
    };
    let from = door.from.russian.case(Case::Instrumental);
    match &door.to {
        Some(to) => format!("{opening} между {from} и {}", to.russian.case(Case::Instrumental)),
        None => format!("{opening} {} наружу", russian::whence(&door.from.russian)),
    }
}

fn doorway_in_english(door: &Doorway) -> String {
    let opening = match (&door.name, door.opening) {
        (Some(name), _) => format!("in the doorway of {}", name.english()),
        (None, Opening::Door) => "in the doorway".into(),
        (None, Opening::Passage) => "in the passage".into(),
    };
    match &door.to {
        Some(to) => format!("{opening} between {} and {}", door.from.english(), to.english()),
        None => format!("{opening} leading out of {}", door.from.english()),
    }
}

fn beside_in_russian(beside: Beside, object: &NounPhrase) -> String {
    match beside {
        Beside::NextTo => {
            format!("рядом {}", russian::with(Preposition::S, Case::Instrumental, object))
        }
        Beside::InFrontOf => russian::with(Preposition::Pered, Case::Instrumental, object),
        Beside::Behind => russian::with(Preposition::Za, Case::Instrumental, object),
        Beside::LeftOf => {
            format!("слева {}", russian::with(Preposition::Ot, Case::Genitive, object))
        }
        Beside::RightOf => {
            format!("справа {}", russian::with(Preposition::Ot, Case::Genitive, object))
        }
    }
}

fn beside_in_english(beside: Beside) -> &'static str {
    match beside {
        Beside::NextTo => "next to",
        Beside::InFrontOf => "in front of",
        Beside::Behind => "behind",
        Beside::LeftOf => "to the left of",
        Beside::RightOf => "to the right of",
    }
}

/// Whether the spot has named this door already, so that «к ней» is enough.
fn is_named(spot: Option<&Spot>, door: &Doorway) -> bool {
    matches!(spot, Some(Spot::AtDoor(other)) if other == door)
}

/// As [`is_named`], of a thing.
fn is_told(spot: Option<&Spot>, object: &Named) -> bool {
    matches!(spot, Some(Spot::Object(_, other)) if other == object)
}

/// «к ней», «к нему», «к ним»
fn pronoun(name: &NounPhrase) -> &'static str {
    match (name.number(), name.gender()) {
        (Number::Plural, _) => "ним",
        (_, Gender::Feminine) => "ней",
        _ => "нему",
    }
}

fn facing_in_russian(facing: &Facing, spot: Option<&Spot>) -> String {
    match facing {
        Facing::Door(door) if is_named(spot, door) => format!("лицом к {}", door.pronoun()),
        Facing::Door(door) => format!("лицом к {}", door.russian(Case::Dative)),
        Facing::Object(object) if is_told(spot, object) => {
            format!("лицом к {}", pronoun(&object.russian))
        }
        Facing::Object(object) => {
            format!("лицом {}", russian::with(Preposition::K, Case::Dative, &object.russian))
        }
        Facing::Wall => "лицом к стене".into(),
        Facing::Inward => "лицом к середине".into(),
    }
}

fn facing_in_english(facing: &Facing, spot: Option<&Spot>) -> String {
    match facing {
        Facing::Door(door) if is_named(spot, door) => "facing it".into(),
        Facing::Door(door) => format!("facing {}", door.english()),
        Facing::Object(object) if is_told(spot, object) => "facing it".into(),
        Facing::Object(object) => format!("facing {}", object.english()),
        Facing::Wall => "facing the wall".into(),
        Facing::Inward => "facing the middle".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};

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
