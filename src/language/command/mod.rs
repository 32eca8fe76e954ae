//! Commands: «Принеси лекарство», "Go to Room-Y" – from a sentence to what is to be done, with its references resolved.
//!
//! After the source paper 1, section 8 (commands from a person become data for planning) and SPEC T2, T3. Word order,
//! case, ё and politeness do not matter; a name is found by any form ([`FormIndex`]).
//!
//! Invariant: never a guess. What was not understood, what may mean several things, and what the map does not have are
//! three different errors ([`Misheard`]); a negation is refused, and «стоп» stops whatever else was said.
//!
//! ```
//! use orthoframe_language::command::{Command, Listener};
//! use orthoframe_language::{FormIndex, NounPhrase, WordHints};
//! let mut index = FormIndex::default();
//! for name in ["Лекарство", "Комната-Y", "Дверь-ВZ"] {
//!     index.insert(&NounPhrase::parse(name, &WordHints::default()), name);
//! }
//! let heard = Listener::new(&index).hear("Будь добр, открой дверь-вz!").unwrap();
//! assert!(matches!(&heard[..], [Command::Open(thing)] if thing.id == "Дверь-ВZ"));
//! ```

mod addressee;
mod assemble;
mod blame;
mod clauses;
mod correction;
mod ellipsis;
mod gathered;
mod grammar;
mod hints;
mod kinds;
mod misheard;
mod named;
mod roles;
mod said;
mod spoken;
mod spot;
mod time;
mod verbs;
mod vocabulary;
mod waiting;

pub use addressee::without_another;
pub(crate) use correction::{Correction, correction, correction_of_question, with_object};
pub(crate) use gathered::{gathered, gathered_of};
pub(crate) use hints::{awaited, has_haunt, is_haunt, is_of_another, names_nothing, says_whither};
pub use hints::{
    in_time, is_command, is_order, is_order_by, preamble, whither_alone, without_clock,
};
pub use misheard::Misheard;
pub use named::{with_names_marked, without_marks};
pub use spot::{Pointed, pointed};
pub(crate) use verbs::{
    Sort, clauses, forbids, is_known, link_at, link_before, link_is_open, opens, small_words,
    verbs_of, without_verbs,
};
pub use verbs::{has_verb, likely_verb};
pub use waiting::{Waiting, waiting};

use std::hash::Hash;

use super::words::{FormIndex, word_ranges};

/// How one thing is to lie to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Relation {
    /// At it, whatever that means for it: «к двери».
    At,
    In,
    On,
    Under,
    Behind,
    InFrontOf,
    NextTo,
    /// As seen by it, if it has a front, else by the robot.
    LeftOf,
    RightOf,
    /// Between the anchor and another.
    Between,
    /// In the middle of it: «посреди кухни».
    Middle,
    /// Whither the robot looks: «лицом к столу».
    Facing,
    /// At a window of the Area that is the anchor: its number among the windows of the map.
    AtWindow(u32),
    /// At a point of the Area that is the anchor: whole cm of its Map.
    Spot(i32, i32),
}

/// A place told by a thing or an Area: «на стол», «в Комнату-Y», «у окна в кухне».
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Placement<T> {
    pub relation: Relation,
    pub anchor: T,
    /// Where the anchor is, if it was said.
    pub within: Option<T>,
    /// Beside the anchor, of the two between which the place is.
    pub and: Option<T>,
}

impl<T> Placement<T> {
    pub fn new(relation: Relation, anchor: T) -> Self {
        Self { relation, anchor, within: None, and: None }
    }
}

/// What the robot is to look at where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Facing<T> {
    Thing(T),
    /// By its number among the windows of the map.
    Window(u32),
    /// The nearest to it.
    Wall,
}

/// A thing, and where it was said to be: «чашку со стола».
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Thing<T> {
    pub id: T,
    pub at: Option<Placement<T>>,
    /// Whither it leads, of a door: «дверь из кухни в коридор».
    pub toward: Option<Placement<T>>,
}

/// What a person wants done.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Command<T> {
    GoTo {
        to: Placement<T>,
        via: Option<T>,
        facing: Option<Facing<T>>,
    },
    /// «Повернись к окну»: where it is.
    Face(Facing<T>),
    /// «Проедь через дверь»: to its other side.
    GoThrough(T),
    /// Out of a room; without one, out of that in which the robot is.
    Leave(Option<T>),
    /// «Подъедь ко мне»
    ComeHere,
    /// «Вернись»: to where the robot was when it was sent away.
    ComeBack,
    /// «Зарядись»: to the nearest place where it charges.
    Charge,
    /// «Домой»: to the place where it begins.
    GoHome,
    /// It stays where it is.
    Wait,
    /// To the person who asks, unless a place is given.
    Bring {
        what: Thing<T>,
        to: Option<Placement<T>>,
    },
    Take {
        what: Thing<T>,
    },
    Put {
        what: Thing<T>,
        to: Placement<T>,
    },
    /// «Поставь на пол»: on the floor of what is named, else of the room where it is.
    SetDown {
        what: Thing<T>,
        within: Option<T>,
    },
    /// «Верни на место»: to where it is kept.
    PutBack(Thing<T>),
    /// «Убери»: the same, but what lies where it is kept is to go elsewhere, and whither was not said.
    PutAway(Thing<T>),
    /// «Выброси»: into what is there for rubbish.
    ThrowAway(Thing<T>),
    Open(Thing<T>),
    Close(Thing<T>),
    Lock(Thing<T>),
    Unlock(Thing<T>),
    SwitchOn(Thing<T>),
    SwitchOff(Thing<T>),
    Find(Thing<T>),
    /// Everywhere, unless a place is given.
    Tidy(Option<T>),
    /// What lies on a thing is put away, or whither it is said; a room is tidied.
    Clear {
        from: T,
        to: Option<Placement<T>>,
    },
    /// A room is tidied; of a thing the surface is meant.
    Clean(Option<T>),
    CallOperator,
    /// The nearest cabin to this storey.
    CallLift,
    Report,
    /// Whatever the robot does now, it is to leave off.
    Stop,
}

impl<T> Command<T> {
    /// What is carried, opened, switched or sought, with what was said of where it is.
    #[must_use]
    pub fn what(&self) -> Option<&Thing<T>> {
        match self {
            Self::Bring { what, .. }
            | Self::Take { what }
            | Self::Put { what, .. }
            | Self::SetDown { what, .. }
            | Self::PutBack(what)
            | Self::PutAway(what)
            | Self::ThrowAway(what)
            | Self::Open(what)
            | Self::Close(what)
            | Self::Lock(what)
            | Self::Unlock(what)
            | Self::SwitchOn(what)
            | Self::SwitchOff(what)
            | Self::Find(what) => Some(what),
            _ => None,
        }
    }

    /// Whether it says where a thing is left: put somewhere, set down, thrown away.
    #[must_use]
    pub fn places(&self, id: &T) -> bool
    where
        T: PartialEq,
    {
        match self {
            Self::Put { what, .. }
            | Self::SetDown { what, .. }
            | Self::Bring { what, to: Some(_) }
            | Self::PutBack(what)
            | Self::PutAway(what)
            | Self::ThrowAway(what) => what.id == *id,
            _ => false,
        }
    }

    /// Whither the robot goes, or something is put.
    #[must_use]
    pub fn place(&self) -> Option<&Placement<T>> {
        match self {
            Self::GoTo { to, .. } | Self::Put { to, .. } => Some(to),
            Self::Bring { to, .. } | Self::Clear { to, .. } => to.as_ref(),
            _ => None,
        }
    }
}

/// Whether a text is longer than anything that is said to a robot in one breath. The readers look at each word beside
/// the others, so that what is longer is refused before it is read.
#[must_use]
pub fn is_too_long(text: &str) -> bool {
    /// Words of the longest command or question that is read.
    const WORDS: usize = 150;
    text.chars().nth(Listener::<()>::LONGEST).is_some() || word_ranges(text).len() > WORDS
}

/// Understands commands about the things of one index.
pub struct Listener<'i, T> {
    index: &'i FormIndex<T>,
    last: Vec<T>,
    meant: Vec<T>,
    any: Option<&'i Any<'i, T>>,
    fixed: Option<&'i Fixed<'i, T>>,
    rooms: Option<&'i Fixed<'i, T>>,
    held: Option<&'i Fixed<'i, T>>,
}

/// Of several things any of which will do, the one to take: the nearest, say.
pub type Any<'a, T> = dyn Fn(&[T]) -> Option<T> + 'a;

/// Whether a thing cannot be carried, say.
pub type Fixed<'a, T> = dyn Fn(&T) -> bool + 'a;

impl<'i, T: Clone + Eq + Hash> Listener<'i, T> {
    /// Characters of the longest command that is read.
    pub const LONGEST: usize = 2_000;

    #[must_use]
    pub fn new(index: &'i FormIndex<T>) -> Self {
        let (last, meant) = (Vec::new(), Vec::new());
        Self { index, last, meant, any: None, fixed: None, rooms: None, held: None }
    }

    /// What "them" means when the sentence itself has named nothing; «её» is the last of it.
    #[must_use]
    pub fn remembering(self, last: Vec<T>) -> Self {
        Self { last, ..self }
    }

    /// What is known to be meant by names of the sentence that several things bear, in the order of the sentence.
    #[must_use]
    pub fn knowing(self, meant: Vec<T>) -> Self {
        Self { meant, ..self }
    }

    /// Lets the caller choose where any of several things will do: «Найди чашку» is done when one is found, while
    /// «Принеси чашку» is asked back.
    #[must_use]
    pub fn choosing(self, any: &'i Any<'i, T>) -> Self {
        Self { any: Some(any), ..self }
    }

    /// "Clear the table" puts away what is on it, "clear the cup" the cup.
    #[must_use]
    pub fn clearing(self, fixed: &'i Fixed<'i, T>) -> Self {
        Self { fixed: Some(fixed), ..self }
    }

    /// «Обойди» is done to what is a room.
    #[must_use]
    pub fn visiting(self, rooms: &'i Fixed<'i, T>) -> Self {
        Self { rooms: Some(rooms), ..self }
    }

    /// «Поставь её» sets down what is held; of anything else it is asked whither.
    #[must_use]
    pub fn holding(self, held: &'i Fixed<'i, T>) -> Self {
        Self { held: Some(held), ..self }
    }

    /// The commands of a sentence, in the order in which they are to be done; at least one.
    ///
    /// # Errors
    /// [`Misheard`], at the first word that stands in the way.
    pub fn hear(&self, text: &str) -> Result<Vec<Command<T>>, Misheard> {
        if is_too_long(text) {
            let length = text.chars().take(100_000).count();
            return Err(Misheard::TooLong { length });
        }
        assemble::commands(text, self)
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};
    use miette::Diagnostic;

    use super::super::words::{Language, NounPhrase, WordHints};
    use super::*;

    const NAMES: [&str; 20] = [
        "Комната-В",
        "Комната-Y",
        "Кухня",
        "Коридор",
        "Дверь-ВZ",
        "Дверь-ZY",
        "Лекарство",
        "Книга",
        "Красная чашка",
        "Белая чашка",
        "Письменный стол",
        "Шкаф",
        "Тумбочка-1",
        "Кресло у окна",
        "Окно",
        "Лампа",
        "Полка",
        "Лобби",
        "Стул",
        "Ворота",
    ];

    /// The golden house: each name under itself, «чашка» under both cups, English names beside the Russian ones.
    fn index() -> FormIndex<&'static str> {
        let mut index = FormIndex::default();
        let phrase = |name| NounPhrase::parse(name, &WordHints::default());
        for name in NAMES {
            index.insert(&phrase(name), name);
            if let Some(english) = crate::english::name_of(name) {
                index.insert_english(&english, name);
            }
        }
        for cup in ["Красная чашка", "Белая чашка"] {
            index.insert(&phrase("чашка"), cup);
        }
        index
    }

    fn heard(text: &str) -> String {
        let index = index();
        match Listener::new(&index).hear(text) {
            Ok(commands) => {
                commands.iter().map(|command| format!("{command:?}")).collect::<Vec<_>>().join("; ")
            }
            Err(misheard) => {
                let code = misheard.code().map(|code| code.to_string()).unwrap_or_default();
                format!("{code}: {}", misheard.say(Language::of(text)))
            }
        }
    }

    fn check(texts: &[&str], expected: &Expect) {
        expected.assert_eq(
            &texts.iter().map(|text| format!("{text}\n    {}\n", heard(text))).collect::<String>(),
        );
    }

    #[test]
    fn the_specified_commands() {
        check(
            &[
                "Принеси лекарство",
                "Поезжай в Комнату-Y",
                "Открой Дверь-ВZ",
                "Положи книгу на стол",
                "Положи книгу на письменный стол",
                "Bring the medicine",
                "Go to Room-Y",
            ],
            &expect![[r#"
                Принеси лекарство
                    Bring { what: Thing { id: "Лекарство", at: None, toward: None }, to: None }
                Поезжай в Комнату-Y
                    GoTo { to: Placement { relation: In, anchor: "Комната-Y", within: None, and: None }, via: None, facing: None }
                Открой Дверь-ВZ
                    Open(Thing { id: "Дверь-ВZ", at: None, toward: None })
                Положи книгу на стол
                    Put { what: Thing { id: "Книга", at: None, toward: None }, to: Placement { relation: On, anchor: "Письменный стол", within: None, and: None } }
                Положи книгу на письменный стол
                    Put { what: Thing { id: "Книга", at: None, toward: None }, to: Placement { relation: On, anchor: "Письменный стол", within: None, and: None } }
                Bring the medicine
                    Bring { what: Thing { id: "Лекарство", at: None, toward: None }, to: None }
                Go to Room-Y
                    GoTo { to: Placement { relation: At, anchor: "Комната-Y", within: None, and: None }, via: None, facing: None }
            "#]],
        );
    }

    #[test]
    fn order_politeness_and_spelling_do_not_matter() {
        check(
            &[
                "пожалуйста, лекарство мне принеси!",
                "Не могли бы вы открыть дверь bz?",
                "ЗАКРОЙ ДВЕРЬ ВZ",
                "Робот, будь добр, поезжай на кухню",
                "Could you please bring me the red cup?",
                "мне нужно лекарство",
                "Я хочу, чтобы ты принёс лекарство",
                "Дверь-ZY запри",
                "закрой дверь-zy на ключ",
                "открой ворота",
            ],
            &expect![[r#"
                пожалуйста, лекарство мне принеси!
                    Bring { what: Thing { id: "Лекарство", at: None, toward: None }, to: None }
                Не могли бы вы открыть дверь bz?
                    Open(Thing { id: "Дверь-ВZ", at: None, toward: None })
                ЗАКРОЙ ДВЕРЬ ВZ
                    Close(Thing { id: "Дверь-ВZ", at: None, toward: None })
                Робот, будь добр, поезжай на кухню
                    GoTo { to: Placement { relation: On, anchor: "Кухня", within: None, and: None }, via: None, facing: None }
                Could you please bring me the red cup?
                    Bring { what: Thing { id: "Красная чашка", at: None, toward: None }, to: None }
                мне нужно лекарство
                    Bring { what: Thing { id: "Лекарство", at: None, toward: None }, to: None }
                Я хочу, чтобы ты принёс лекарство
                    Bring { what: Thing { id: "Лекарство", at: None, toward: None }, to: None }
                Дверь-ZY запри
                    Lock(Thing { id: "Дверь-ZY", at: None, toward: None })
                закрой дверь-zy на ключ
                    Lock(Thing { id: "Дверь-ZY", at: None, toward: None })
                открой ворота
                    Open(Thing { id: "Ворота", at: None, toward: None })
            "#]],
        );
    }

    #[test]
    fn places_and_chains() {
        check(
            &[
                "Возьми красную чашку со стола в кухне",
                "Возьми книгу с полки и положи её на тумбочку 1",
                "Принеси книгу из шкафа в Комнату-В",
                "Take the book from the shelf to the kitchen",
                "Поезжай в коридор через дверь-вz",
                "Подъедь ко мне",
                "Подъезжай к креслу у окна",
                "Поезжай в лобби",
                "Включи лампу на письменном столе",
                "Найди книгу в комнате-в",
                "Приберись на кухне",
                "убери книгу в шкаф",
                "Позови оператора",
                "Где ты?",
                "Report your position",
                "Принеси книгу и белую чашку",
                "go to the kitchen, then open Door-ZY",
                "put the book under the chair",
                "Принеси лекарство с тумбочки-1 из комнаты-y",
                "Убери чашку красную в шкаф",
                "Закрой все двери",
                "Открой Дверь-ВZ из кухни в коридор",
                "Открой дверь-вZ и дверь-zy",
                "Стоп, не едь!",
            ],
            &expect![[r#"
                Возьми красную чашку со стола в кухне
                    Take { what: Thing { id: "Красная чашка", at: Some(Placement { relation: On, anchor: "Письменный стол", within: Some("Кухня"), and: None }), toward: None } }
                Возьми книгу с полки и положи её на тумбочку 1
                    Take { what: Thing { id: "Книга", at: Some(Placement { relation: On, anchor: "Полка", within: None, and: None }), toward: None } }; Put { what: Thing { id: "Книга", at: None, toward: None }, to: Placement { relation: On, anchor: "Тумбочка-1", within: None, and: None } }
                Принеси книгу из шкафа в Комнату-В
                    Bring { what: Thing { id: "Книга", at: Some(Placement { relation: In, anchor: "Шкаф", within: None, and: None }), toward: None }, to: Some(Placement { relation: In, anchor: "Комната-В", within: None, and: None }) }
                Take the book from the shelf to the kitchen
                    Bring { what: Thing { id: "Книга", at: Some(Placement { relation: At, anchor: "Полка", within: None, and: None }), toward: None }, to: Some(Placement { relation: At, anchor: "Кухня", within: None, and: None }) }
                Поезжай в коридор через дверь-вz
                    GoTo { to: Placement { relation: In, anchor: "Коридор", within: None, and: None }, via: Some("Дверь-ВZ"), facing: None }
                Подъедь ко мне
                    ComeHere
                Подъезжай к креслу у окна
                    GoTo { to: Placement { relation: At, anchor: "Кресло у окна", within: None, and: None }, via: None, facing: None }
                Поезжай в лобби
                    GoTo { to: Placement { relation: In, anchor: "Лобби", within: None, and: None }, via: None, facing: None }
                Включи лампу на письменном столе
                    SwitchOn(Thing { id: "Лампа", at: Some(Placement { relation: On, anchor: "Письменный стол", within: None, and: None }), toward: None })
                Найди книгу в комнате-в
                    Find(Thing { id: "Книга", at: Some(Placement { relation: In, anchor: "Комната-В", within: None, and: None }), toward: None })
                Приберись на кухне
                    Tidy(Some("Кухня"))
                убери книгу в шкаф
                    Put { what: Thing { id: "Книга", at: None, toward: None }, to: Placement { relation: In, anchor: "Шкаф", within: None, and: None } }
                Позови оператора
                    CallOperator
                Где ты?
                    Report
                Report your position
                    Report
                Принеси книгу и белую чашку
                    Bring { what: Thing { id: "Книга", at: None, toward: None }, to: None }; Bring { what: Thing { id: "Белая чашка", at: None, toward: None }, to: None }
                go to the kitchen, then open Door-ZY
                    GoTo { to: Placement { relation: At, anchor: "Кухня", within: None, and: None }, via: None, facing: None }; Open(Thing { id: "Дверь-ZY", at: None, toward: None })
                put the book under the chair
                    Put { what: Thing { id: "Книга", at: None, toward: None }, to: Placement { relation: Under, anchor: "Стул", within: None, and: None } }
                Принеси лекарство с тумбочки-1 из комнаты-y
                    Bring { what: Thing { id: "Лекарство", at: Some(Placement { relation: On, anchor: "Тумбочка-1", within: Some("Комната-Y"), and: None }), toward: None }, to: None }
                Убери чашку красную в шкаф
                    Put { what: Thing { id: "Красная чашка", at: None, toward: None }, to: Placement { relation: In, anchor: "Шкаф", within: None, and: None } }
                Закрой все двери
                    Close(Thing { id: "Дверь-ВZ", at: None, toward: None }); Close(Thing { id: "Дверь-ZY", at: None, toward: None })
                Открой Дверь-ВZ из кухни в коридор
                    Open(Thing { id: "Дверь-ВZ", at: Some(Placement { relation: In, anchor: "Кухня", within: None, and: None }), toward: Some(Placement { relation: In, anchor: "Коридор", within: None, and: None }) })
                Открой дверь-вZ и дверь-zy
                    Open(Thing { id: "Дверь-ВZ", at: None, toward: None }); Open(Thing { id: "Дверь-ZY", at: None, toward: None })
                Стоп, не едь!
                    Stop
            "#]],
        );
    }

    #[test]
    fn three_ways_of_not_understanding() {
        check(
            &[
                "Отрой Дверь-ВZ",
                "Принеси чашку",
                "Bring the cup",
                "Поезжай в Комнату-X",
                "Принеси синюю чашку",
                "Принеси",
                "Дверь-ВZ",
                "Открой на",
                "Иди к двери вз",
                "Открой дверь в коридор",
                "Принеси 2 книги",
                "не открывай Дверь-ВZ",
                "абракадабра",
                "Go to Room-Q",
                "bring it",
                "",
                "😀😀",
                "Положи книгу",
                "SELECT * FROM Area; DROP TABLE",
            ],
            &expect![[r#"
                Отрой Дверь-ВZ
                    language::not_understood: Слово «Отрой» непонятно. Может быть, «открой»?
                Принеси чашку
                    language::ambiguous: «чашку» – это «Красная чашка» или «Белая чашка»? Назовите одно из них полностью.
                Bring the cup
                    language::ambiguous: By "cup", do you mean "Red cup" or "White cup"?
                Поезжай в Комнату-X
                    language::unknown_name: На карте нет «Комнату-X». Есть «Комната-В» или «Комната-Y».
                Принеси синюю чашку
                    language::unknown_name: На карте нет «синюю чашку». Есть «Красная чашка» или «Белая чашка».
                Принеси
                    language::incomplete: Не сказано, что принести. Дополните задание.
                Дверь-ВZ
                    language::incomplete: Не сказано, что с этим сделать. Дополните задание.
                Открой на
                    language::incomplete: Не сказано, где или куда. Дополните задание.
                Иди к двери вз
                    language::unknown_name: На карте нет «двери вз». Есть «Дверь-ВZ» или «Дверь-ZY».
                Открой дверь в коридор
                    language::ambiguous: «дверь» – это «Дверь-ВZ» или «Дверь-ZY»? Назовите одно из них полностью.
                Принеси 2 книги
                    language::unknown_name: На карте нет «2 книги». Есть «Книга».
                не открывай Дверь-ВZ
                    language::forbidden: Запретов я не запоминаю. Без задания я ничего не делаю; скажите, что сделать.
                абракадабра
                    language::not_understood: Слово «абракадабра» непонятно. Начните с того, что сделать: «Принеси …», «Поезжай в …», «Открой …».
                Go to Room-Q
                    language::unknown_name: The map has no "Room-Q". There is "Room-B" or "Room-Y".
                bring it
                    language::incomplete: You did not say what you mean.

                    language::empty: Задание пусто. Скажите, что сделать, например «Принеси лекарство».
                😀😀
                    language::empty: Задание пусто. Скажите, что сделать, например «Принеси лекарство».
                Положи книгу
                    language::incomplete: Не сказано, куда положить. Дополните задание.
                SELECT * FROM Area; DROP TABLE
                    language::not_understood: I do not understand the word "SELECT".
            "#]],
        );
    }

    #[test]
    fn a_pronoun_is_what_was_spoken_of_last() {
        let index = index();
        let listener = Listener::new(&index).remembering(vec!["Книга"]);
        assert!(
            matches!(&listener.hear("Принеси её").unwrap()[..], [Command::Bring { what, .. }] if what.id == "Книга")
        );
    }

    #[test]
    fn nothing_from_outside_makes_it_panic() {
        let index = index();
        let long = "принеси ".repeat(200);
        let mut texts = vec![
            "я".repeat(100_000),
            "\u{0}\u{1}\u{7f}".into(),
            "в на под за".into(),
            "«\"('".into(),
            "и и и".into(),
            "-".repeat(500),
            long,
        ];
        let words: Vec<&str> = "принеси в на книгу и её мне стол не дверь вz 2 - , путь 😀 the go to и\u{306} room \u{301} с у окна".split(' ').collect();
        for seed in 0_usize..3000 {
            let text: Vec<&str> = (0..seed % 9)
                .map(|at| words[(seed * 31 + at * at * 17 + at * seed) % words.len()])
                .collect();
            texts.push(text.join(" "));
        }
        for text in texts {
            if let Err(misheard) = Listener::new(&index).hear(&text) {
                let _ = (misheard.say(Language::Russian), misheard.say(Language::English));
            }
        }
    }
}
