//! A position report read back: from a sentence that [`Position::say_in`](super::Position::say_in) makes to its terms.
//!
//! The grammar is that of the sentences, word by word, in both languages; names are found in any form through the
//! caller's index, and a name that several things bear stays several. Case, ё, hyphens and stops do not matter.
//!
//! Invariant: every sentence that `say_in` makes over names of the index reads, and gives back what it was made of
//! (a property test over whole maps shows it); no text makes it panic.
//!
//! ```
//! use orthoframe_language::{FormIndex, WordHints};
//! use orthoframe_language::report::read::{SaidSpot, read};
//! let mut index = FormIndex::default();
//! index.insert_name("Комната-В", &WordHints::default(), 1);
//! index.insert_name("Комната-Z", &WordHints::default(), 2);
//! let text = "Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z.";
//! let said = read(text, &index).unwrap();
//! assert_eq!(said.area, [1]);
//! let SaidSpot::AtDoor(door) = said.spot.unwrap() else { panic!() };
//! assert_eq!((door.from, door.to), (vec![1], Some(vec![2])));
//! ```

use std::hash::Hash;
use std::ops::Range;

use super::super::words::{FormIndex, Language, word_ranges};
use super::{Beside, Opening};

/// Words of a report that do not read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unread {
    /// The first bytes that no sentence of this beginning goes on with.
    pub at: Range<usize>,
}

/// A doorway as a report speaks of it. Where a name is borne by several things, all of them stand here.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SaidDoorway<T> {
    /// None where the door is called by its own name.
    pub opening: Option<Opening>,
    pub name: Option<Vec<T>>,
    pub from: Vec<T>,
    /// None: out of the map.
    pub to: Option<Vec<T>>,
}

/// The spot that a report tells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SaidSpot<T> {
    InDoorway(SaidDoorway<T>),
    AtDoor(SaidDoorway<T>),
    Object(Beside, Vec<T>),
    InCorner(Option<Vec<T>>),
    AlongWall(Option<Vec<T>>),
    InMiddle,
}

/// What a report says is faced.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SaidFacing<T> {
    Door(SaidDoorway<T>),
    Object(Vec<T>),
    Wall,
    /// That by which it is said to be, and another than that.
    OwnWall,
    OtherWall,
    /// A leaf of a door that stands open.
    Leaf(SaidDoorway<T>),
    /// Free floor.
    Inward,
}

/// What a report says of a room to tell it from its namesakes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SaidMark<T> {
    Adjoining(Vec<T>),
    With(Vec<T>),
}

/// A report in terms. Empty `area`: in a doorway, whose two sides are told, or off the map.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SaidPosition<T> {
    pub language: Language,
    pub area: Vec<T>,
    /// Storey, building: narrow before wide.
    pub within: Vec<Vec<T>>,
    pub mark: Option<SaidMark<T>>,
    pub spot: Option<SaidSpot<T>>,
    pub facing: Option<SaidFacing<T>>,
}

/// Reads one report.
///
/// # Errors
/// It is not a sentence that reports are made of, or speaks of something that the index does not have.
pub fn read<T: Clone + Eq + Hash>(
    text: &str,
    index: &FormIndex<T>,
) -> Result<SaidPosition<T>, Unread> {
    let words = word_ranges(text);
    let lower = words.iter().map(|range| text[range.clone()].to_lowercase()).collect();
    let mut reader = Reader { text, words, lower, index, mark: None, at: 0, farthest: 0 };
    let found = match Language::of(text) {
        Language::Russian => reader.russian(),
        Language::English => reader.english(),
    };
    match found.filter(|_| reader.at == reader.words.len()) {
        Some(found) => Ok(found),
        None => {
            let end = text.len();
            Err(Unread { at: reader.words.get(reader.farthest).cloned().unwrap_or(end..end) })
        }
    }
}

struct Reader<'t, T> {
    text: &'t str,
    words: Vec<Range<usize>>,
    lower: Vec<String>,
    index: &'t FormIndex<T>,
    mark: Option<SaidMark<T>>,
    at: usize,
    /// The first word that could not be read on the way that led farthest.
    farthest: usize,
}

const IN: [&str; 3] = ["в", "во", "на"];
const FROM: [&str; 4] = ["из", "изо", "с", "со"];
const LEADING: [&str; 5] = ["ведущей", "ведущего", "ведущих", "ведущему", "ведущим"];

impl<T: Clone + Eq + Hash> Reader<'_, T> {
    /// Goes past one of these words.
    fn one_of(&mut self, wanted: &[&str]) -> Option<()> {
        let found = self.lower.get(self.at).is_some_and(|word| wanted.contains(&word.as_str()));
        self.at += usize::from(found);
        self.farthest = self.farthest.max(self.at);
        found.then_some(())
    }

    /// Goes past these words in their order, or past none of them.
    fn all_of(&mut self, wanted: &str) -> Option<()> {
        let start = self.at;
        let found = wanted.split(' ').all(|word| self.one_of(&[word]).is_some());
        if !found {
            self.at = start;
        }
        found.then_some(())
    }

    /// Reads with `rule`, or stays where it was.
    fn maybe<R>(&mut self, rule: impl FnOnce(&mut Self) -> Option<R>) -> Option<R> {
        let start = self.at;
        let found = rule(self);
        if found.is_none() {
            self.at = start;
        }
        found
    }

    /// The longest name that begins here, with the English article before it.
    fn name(&mut self) -> Option<Vec<T>> {
        let mut from = self.at;
        let mut found = self.index.longest_at(self.text, &self.words, from);
        if found.is_none() && self.lower.get(from).is_some_and(|word| word == "the") {
            from += 1;
            found = self.index.longest_at(self.text, &self.words, from);
        }
        let (taken, hits) = found?;
        self.at = from + taken;
        self.farthest = self.farthest.max(self.at);
        Some(hits.into_iter().map(|hit| hit.id.clone()).collect())
    }

    fn is_at_end(&self) -> bool {
        self.at == self.words.len()
    }

    fn russian(&mut self) -> Option<SaidPosition<T>> {
        self.all_of("я");
        self.one_of(&["нахожусь", "стою"]);
        if self.all_of("вне карты").is_some() {
            return Some(SaidPosition::off_the_map(Language::Russian));
        }
        // Wide before narrow: every place but the last is what the Area lies in.
        let mut within = Vec::new();
        loop {
            let wider = self.maybe(|r| {
                let place = r.russian_place()?;
                // Another place follows: «в Корпусе 1 на 2-м этаже», «на 2-м этаже в углу Кухни».
                let goes_on = r.lower.get(r.at).is_some_and(|word| IN.contains(&word.as_str()));
                goes_on.then_some(place)
            });
            match wider {
                Some(place) => within.insert(0, place),
                None => break,
            }
        }
        let (area, spot) = self
            .maybe(|r| Some((Vec::new(), Some(SaidSpot::InDoorway(r.russian_in_doorway()?)))))
            .or_else(|| self.maybe(Self::russian_part))
            .or_else(|| {
                let area = self.russian_place()?;
                self.mark = self.maybe(Self::russian_mark);
                Some((area, self.maybe(Self::russian_spot)))
            })?;
        let facing = match self.is_at_end() {
            true => None,
            false => Some(self.russian_facing(spot.as_ref())?),
        };
        let mark = self.mark.take();
        Some(SaidPosition { language: Language::Russian, area, within, mark, spot, facing })
    }

    fn russian_place(&mut self) -> Option<Vec<T>> {
        self.one_of(&IN)?;
        self.name()
    }

    /// «в углу Спальни у Окна», «в середине Спальни»
    fn russian_part(&mut self) -> Option<(Vec<T>, Option<SaidSpot<T>>)> {
        if self.all_of("в углу").is_some() {
            let area = self.name()?;
            self.mark = self.maybe(Self::russian_mark);
            let thing = self.maybe(|r| {
                r.one_of(&["у"])?;
                r.name()
            });
            return Some((area, Some(SaidSpot::InCorner(thing))));
        }
        self.all_of("в середине")?;
        let area = self.name()?;
        self.mark = self.maybe(Self::russian_mark);
        Some((area, Some(SaidSpot::InMiddle)))
    }

    /// What tells a room from its namesakes: «соседней со Спальней», «с Душем».
    fn russian_mark(&mut self) -> Option<SaidMark<T>> {
        let adjoining = self.one_of(&["соседней", "соседнем", "соседнего", "соседних"]).is_some();
        self.one_of(&["с", "со"])?;
        let name = self.name()?;
        Some(if adjoining { SaidMark::Adjoining(name) } else { SaidMark::With(name) })
    }

    /// What follows the Area: «у двери, ведущей …», «у стены возле Дивана», «рядом со Шкафом».
    fn russian_spot(&mut self) -> Option<SaidSpot<T>> {
        let door = self.maybe(|r| {
            r.one_of(&["у"])?;
            r.russian_doorway()
        });
        if let Some(door) = door {
            return Some(SaidSpot::AtDoor(door));
        }
        if self.all_of("у стены").is_some() {
            let thing = self.maybe(|r| {
                r.one_of(&["возле"])?;
                r.name()
            });
            return Some(SaidSpot::AlongWall(thing));
        }
        let beside = if self.all_of("стоя на").is_some() {
            Beside::On
        } else if self.all_of("рядом").is_some() {
            self.one_of(&["с", "со"])?;
            Beside::NextTo
        } else if self.one_of(&["перед", "передо"]).is_some() {
            Beside::InFrontOf
        } else if self.one_of(&["за"]).is_some() {
            Beside::Behind
        } else {
            let beside = match self.all_of("слева") {
                Some(()) => Beside::LeftOf,
                None => self.all_of("справа").map(|()| Beside::RightOf)?,
            };
            self.one_of(&["от", "ото"])?;
            beside
        };
        Some(SaidSpot::Object(beside, self.name()?))
    }

    /// «двери, ведущей из Комнаты-В в Комнату-Z», «Ворот, ведущих из Гаража наружу»
    fn russian_doorway(&mut self) -> Option<SaidDoorway<T>> {
        let common = self.maybe(|r| {
            let opening = match r.one_of(&["двери"]) {
                Some(()) => Opening::Door,
                None => r.one_of(&["прохода", "проходу"]).map(|()| Opening::Passage)?,
            };
            r.one_of(&LEADING).map(|()| opening)
        });
        let name = match common {
            Some(_) => None,
            None => {
                let name = self.name()?;
                self.one_of(&LEADING)?;
                Some(name)
            }
        };
        let (from, to) = self.russian_way()?;
        Some(SaidDoorway { opening: common, name, from, to })
    }

    /// «из Комнаты-В в Комнату-Z», «из Комнаты-В наружу»
    fn russian_way(&mut self) -> Option<(Vec<T>, Option<Vec<T>>)> {
        self.one_of(&FROM)?;
        let from = self.name()?;
        if self.one_of(&["наружу"]).is_some() {
            return Some((from, None));
        }
        Some((from, Some(self.russian_place()?)))
    }

    /// «в дверном проёме между Комнатой-В и Коридором», «в проёме Ворот из Гаража наружу»
    fn russian_in_doorway(&mut self) -> Option<SaidDoorway<T>> {
        self.one_of(&["в"])?;
        let mut name = None;
        let opening = if self.maybe(|r| r.all_of("дверном")).is_some() {
            self.one_of(&["проёме", "проеме"])?;
            Some(Opening::Door)
        } else if self.one_of(&["проходе"]).is_some() {
            Some(Opening::Passage)
        } else {
            self.one_of(&["проёме", "проеме"])?;
            name = Some(self.name()?);
            None
        };
        let (from, to) = match self.one_of(&["между"]) {
            Some(()) => {
                let from = self.name()?;
                self.one_of(&["и"])?;
                (from, Some(self.name()?))
            }
            None => self.russian_way().filter(|(_, to)| to.is_none())?,
        };
        Some(SaidDoorway { opening, name, from, to })
    }

    fn russian_facing(&mut self, spot: Option<&SaidSpot<T>>) -> Option<SaidFacing<T>> {
        self.all_of("лицом")?;
        self.one_of(&["к", "ко"])?;
        if self.maybe(|r| r.all_of("другой стене")).is_some() {
            return Some(SaidFacing::OtherWall);
        }
        if self.one_of(&["стене"]).is_some() {
            return Some(SaidFacing::Wall);
        }
        if self.maybe(|r| r.all_of("свободному месту")).is_some() {
            return Some(SaidFacing::Inward);
        }
        if self.one_of(&["створке"]).is_some() {
            return self.russian_doorway().map(SaidFacing::Leaf);
        }
        if self.one_of(&["ней", "нему", "ним"]).is_some() {
            return SaidFacing::it(spot);
        }
        match self.maybe(Self::russian_doorway) {
            Some(door) => Some(SaidFacing::Door(door)),
            None => self.name().map(SaidFacing::Object),
        }
    }

    fn english(&mut self) -> Option<SaidPosition<T>> {
        self.all_of("i");
        self.one_of(&["am", "m"]);
        if self.all_of("off the map").is_some() {
            return Some(SaidPosition::off_the_map(Language::English));
        }
        let (area, spot) = self
            .maybe(|r| Some((Vec::new(), Some(SaidSpot::InDoorway(r.english_in_doorway()?)))))
            .or_else(|| self.maybe(Self::english_part))
            .or_else(|| {
                let area = self.english_place()?;
                self.mark = self.maybe(Self::english_mark);
                Some((area, self.maybe(Self::english_spot)))
            })?;
        let mut within = Vec::new();
        while let Some(place) = self.maybe(Self::english_place) {
            within.push(place);
        }
        let facing = match self.is_at_end() {
            true => None,
            false => Some(self.english_facing(spot.as_ref())?),
        };
        let mark = self.mark.take();
        Some(SaidPosition { language: Language::English, area, within, mark, spot, facing })
    }

    fn english_place(&mut self) -> Option<Vec<T>> {
        self.one_of(&["in", "on"])?;
        self.name()
    }

    /// "in the corner of the bedroom by the window", "in the middle of the bedroom"
    fn english_part(&mut self) -> Option<(Vec<T>, Option<SaidSpot<T>>)> {
        if self.all_of("in the corner of").is_some() {
            let area = self.name()?;
            self.mark = self.maybe(Self::english_mark);
            let thing = self.maybe(|r| {
                r.one_of(&["by"])?;
                r.name()
            });
            return Some((area, Some(SaidSpot::InCorner(thing))));
        }
        self.all_of("in the middle of")?;
        let area = self.name()?;
        self.mark = self.maybe(Self::english_mark);
        Some((area, Some(SaidSpot::InMiddle)))
    }

    /// "adjoining the bedroom", "with the shower"
    fn english_mark(&mut self) -> Option<SaidMark<T>> {
        let adjoining = self.one_of(&["adjoining"]).is_some();
        if !adjoining {
            self.one_of(&["with"])?;
        }
        let name = self.name()?;
        Some(if adjoining { SaidMark::Adjoining(name) } else { SaidMark::With(name) })
    }

    fn english_spot(&mut self) -> Option<SaidSpot<T>> {
        if self.one_of(&["at"]).is_some() {
            return self.english_doorway().map(SaidSpot::AtDoor);
        }
        if self.all_of("by the wall").is_some() {
            let thing = self.maybe(|r| {
                r.one_of(&["near"])?;
                r.name()
            });
            return Some(SaidSpot::AlongWall(thing));
        }
        let beside = [
            ("standing on", Beside::On),
            ("next to", Beside::NextTo),
            ("in front of", Beside::InFrontOf),
            ("behind", Beside::Behind),
            ("to the left of", Beside::LeftOf),
            ("to the right of", Beside::RightOf),
        ];
        let (_, beside) = beside.into_iter().find(|(words, _)| self.all_of(words).is_some())?;
        Some(SaidSpot::Object(beside, self.name()?))
    }

    /// "the door leading from Room-B to Room-Z", "the gate leading out of the garage"
    fn english_doorway(&mut self) -> Option<SaidDoorway<T>> {
        let common = self.maybe(|r| {
            let opening = match r.all_of("the door leading") {
                Some(()) => Opening::Door,
                None => r.all_of("the passage leading").map(|()| Opening::Passage)?,
            };
            Some(opening)
        });
        let name = match common {
            Some(_) => None,
            None => {
                let name = self.english_door()?;
                self.one_of(&["leading"])?;
                Some(name)
            }
        };
        let (from, to) = if self.all_of("out of").is_some() {
            (self.name()?, None)
        } else {
            self.one_of(&["from"])?;
            let from = self.name()?;
            self.one_of(&["to"])?;
            (from, Some(self.name()?))
        };
        Some(SaidDoorway { opening: common, name, from, to })
    }

    /// "the gate", "the door L1_office"
    fn english_door(&mut self) -> Option<Vec<T>> {
        self.maybe(Self::name).or_else(|| {
            self.one_of(&["the"])?;
            self.one_of(&["door", "passage"])?;
            self.name()
        })
    }

    fn english_in_doorway(&mut self) -> Option<SaidDoorway<T>> {
        let mut name = None;
        let opening = if self.all_of("in the doorway of").is_some() {
            name = Some(self.english_door()?);
            None
        } else if self.all_of("in the doorway").is_some() {
            Some(Opening::Door)
        } else {
            self.all_of("in the passage")?;
            Some(Opening::Passage)
        };
        let (from, to) = if self.all_of("leading out of").is_some() {
            (self.name()?, None)
        } else {
            self.one_of(&["between"])?;
            let from = self.name()?;
            self.one_of(&["and"])?;
            (from, Some(self.name()?))
        };
        Some(SaidDoorway { opening, name, from, to })
    }

    fn english_facing(&mut self, spot: Option<&SaidSpot<T>>) -> Option<SaidFacing<T>> {
        self.all_of("facing")?;
        if self.all_of("another wall").is_some() {
            return Some(SaidFacing::OtherWall);
        }
        if self.all_of("the wall").is_some() {
            return Some(SaidFacing::Wall);
        }
        if self.all_of("free space").is_some() {
            return Some(SaidFacing::Inward);
        }
        if self.all_of("a leaf of").is_some() {
            return self.english_doorway().map(SaidFacing::Leaf);
        }
        if self.all_of("it").is_some() {
            return SaidFacing::it(spot);
        }
        match self.maybe(Self::english_doorway) {
            Some(door) => Some(SaidFacing::Door(door)),
            None => self.name().map(SaidFacing::Object),
        }
    }
}

impl<T: Clone> SaidFacing<T> {
    /// The door or thing that the spot has named.
    fn it(spot: Option<&SaidSpot<T>>) -> Option<Self> {
        match spot {
            Some(SaidSpot::AtDoor(door)) => Some(Self::Door(door.clone())),
            Some(SaidSpot::Object(_, things)) => Some(Self::Object(things.clone())),
            Some(SaidSpot::AlongWall(_)) => Some(Self::OwnWall),
            _ => None,
        }
    }
}

impl<T> SaidPosition<T> {
    fn off_the_map(language: Language) -> Self {
        let (area, within) = (Vec::new(), Vec::new());
        Self { language, area, within, mark: None, spot: None, facing: None }
    }

    /// Whether the report says that the pose is on no Area.
    #[must_use]
    pub fn is_off_the_map(&self) -> bool {
        self.area.is_empty() && self.spot.is_none()
    }
}
