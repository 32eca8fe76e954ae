//! What came of an import: how much was read, what was mended, what was left out, and why.
//!
//! **Invariant.** Every record of the file that does not arrive as it stands has a note with the file's own id; a whole
//! class of which nothing is made has one with the name of the class and how many there are.

use std::collections::BTreeMap;
use std::fmt;

use miette::Diagnostic;
use serde::Serialize;
use thiserror::Error;

use crate::units::{Bilingual, InEnglish, Language, Lengths};

/// What became of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Treatment {
    /// It arrived, but not as the file has it.
    Mended,
    /// It did not arrive.
    Skipped,
    /// It arrived; something of it is worth a word. Never refused by a strict import.
    Noted,
}

/// What sort of record a note speaks of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum What {
    Building,
    Level,
    Room,
    Door,
    Passage,
    Window,
    Lift,
    Kind,
    Thing,
    Place,
    Wall,
    /// A piece of a way that the file says is driven; it makes nothing of the Map.
    Lane,
    /// A relation or edge of the source: `ON`, `INSIDE`.
    Relation,
    /// Anything else that the file holds.
    Record,
}

impl What {
    /// How many of these are counted, in Russian in the plural genitive: «помещений 4», "rooms: 4".
    #[must_use]
    pub fn counted(self) -> (&'static str, &'static str) {
        match self {
            Self::Building => ("зданий", "buildings"),
            Self::Level => ("этажей", "storeys"),
            Self::Room => ("помещений", "rooms"),
            Self::Door => ("дверей", "doors"),
            Self::Passage => ("проходов", "passages"),
            Self::Window => ("окон", "windows"),
            Self::Lift => ("лифтов и лестниц", "lifts and stairs"),
            Self::Kind => ("видов вещей", "kinds of things"),
            Self::Thing => ("вещей", "things"),
            Self::Place => ("точек", "places"),
            Self::Wall => ("стен", "walls"),
            Self::Lane => ("полос движения", "lanes"),
            Self::Relation => ("связей", "relations"),
            Self::Record => ("записей", "records"),
        }
    }

    fn one(self) -> (&'static str, &'static str) {
        match self {
            Self::Building => ("здание", "building"),
            Self::Level => ("этаж", "storey"),
            Self::Room => ("помещение", "room"),
            Self::Door => ("дверь", "door"),
            Self::Passage => ("проход", "passage"),
            Self::Window => ("окно", "window"),
            Self::Lift => ("лифт", "lift"),
            Self::Kind => ("вид вещей", "kind of things"),
            Self::Thing => ("вещь", "thing"),
            Self::Place => ("точка", "place"),
            Self::Wall => ("стена", "wall"),
            Self::Lane => ("полоса движения", "lane"),
            Self::Relation => ("связь", "relation"),
            Self::Record => ("запись", "record"),
        }
    }
}

/// A length in cm.
fn told(cm: u32) -> String {
    Lengths::said().told(f64::from(cm), 0, Language::Russian)
}

/// Why a record was mended or left out. Numbers are rounded for people; lengths in cm, areas in m².
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Error, Diagnostic)]
#[non_exhaustive]
pub enum Why {
    /// Fewer than three different corners, or less floor than a robot's foot.
    #[error("контур вырожден: площадь меньше {}", Lengths::said().told_area(f64::from(*least), 0, Language::Russian))]
    #[diagnostic(code(import::no_outline))]
    NoOutline { least: u32 },
    /// Rings that cross themselves: the largest simple part is kept.
    #[error("контур пересекал сам себя; оставлена наибольшая часть")]
    #[diagnostic(code(import::outline_crosses))]
    OutlineCrosses,
    /// Two rooms claim one piece of floor.
    #[error("накладывалось на «{other}»; общий пол остался за ним")]
    #[diagnostic(code(import::rooms_overlap))]
    RoomsOverlap { other: String },
    /// One room drawn twice.
    #[error("повторяет «{other}»")]
    #[diagnostic(code(import::room_twice))]
    RoomTwice { other: String },
    /// Subtraction cut pieces off a room that are too narrow to be floor.
    #[error("разрезано наложением; части уже {} отброшены", told(20))]
    #[diagnostic(code(import::room_cut))]
    RoomCut,
    /// Subtraction cut a room apart.
    #[error("разрезано наложением на {parts}; каждая часть стала помещением")]
    #[diagnostic(code(import::room_parted))]
    RoomParted { parts: usize },
    /// A hole outside of its room, or without area.
    #[error("вырез в контуре непригоден")]
    #[diagnostic(code(import::bad_hole))]
    BadHole,
    /// One id or name for several records.
    #[error("имя «{name}» уже занято; дано имя «{given}»")]
    #[diagnostic(code(import::duplicate_name))]
    DuplicateName { name: String, given: String },
    /// One id for several records.
    #[error("обозначение «{id}» дано не один раз")]
    #[diagnostic(code(import::duplicate_id))]
    DuplicateId { id: String },
    /// A reference that leads nowhere.
    #[error("ссылается на «{to}», чего в файле нет")]
    #[diagnostic(code(import::dangling))]
    Dangling { to: String },
    /// An opening with no room beside it.
    #[error("рядом нет ни одного помещения")]
    #[diagnostic(code(import::no_room))]
    NoRoom,
    /// An opening amid one room's floor.
    #[error("стоит внутри одного помещения, вдали от стен")]
    #[diagnostic(code(import::within_room))]
    WithinRoom,
    /// An opening that lies along three rooms or more.
    #[error("касается не двух помещений; взяты «{one}» и «{other}»")]
    #[diagnostic(code(import::several_rooms))]
    SeveralRooms { one: String, other: String },
    /// The rooms that a door names lie elsewhere.
    #[error("не примыкает к «{room}», которое называет; помещения найдены по месту")]
    #[diagnostic(code(import::other_room))]
    OtherRoom { room: String },
    /// Narrower than nothing can pass.
    #[error("ширина меньше {}", told(*least))]
    #[diagnostic(code(import::too_narrow))]
    TooNarrow { least: u32 },
    /// The wall is shorter than the opening.
    #[error("ширина уменьшена с {} до {}: стена короче или проём занят", told(*from), told(*to))]
    #[diagnostic(code(import::narrowed))]
    Narrowed { from: u32, to: u32 },
    /// No free stretch of wall.
    #[error("не помещается в стену: она занята другим проёмом, слишком коротка или далека")]
    #[diagnostic(code(import::no_wall))]
    NoWall,
    /// A value out of its range.
    #[error("{what}: негодное значение {value}")]
    #[diagnostic(code(import::bad_value))]
    BadValue { what: Bilingual, value: Bilingual },
    /// A field that should be there.
    #[error("нет поля «{field}»")]
    #[diagnostic(code(import::missing_field))]
    MissingField { field: &'static str },
    /// A thing in no room.
    #[error("стоит вне всех помещений")]
    #[diagnostic(code(import::outside))]
    Outside,
    /// A thing elsewhere than said.
    #[error("стоит не в «{room}», которое названо; помещение найдено по месту")]
    #[diagnostic(code(import::thing_elsewhere))]
    ThingElsewhere { room: String },
    /// A kind whose parts lie in one another.
    #[error("части вида накладывались; лишнее отрезано")]
    #[diagnostic(code(import::parts_overlap))]
    PartsOverlap,
    /// The file does not tell how large it is.
    #[error("размеры вида «{kind}» неизвестны: поставлена плоская метка")]
    #[diagnostic(code(import::unknown_size))]
    UnknownSize { kind: String },
    /// A word that the synonym table lacks.
    #[error("слово «{word}» не значится в таблице синонимов: тип не дан")]
    #[diagnostic(code(import::unknown_word))]
    UnknownWord { word: String },
    /// A lift that stops on one floor only.
    #[error("соединяет меньше двух этажей")]
    #[diagnostic(code(import::lift_stops))]
    LiftStops,
    /// Rooms of several storeys that belong together.
    #[error("соединяет этажи, но ни лифт это, ни лестница, файл не говорит; пути по нему нет")]
    #[diagnostic(code(import::no_lift))]
    NoLift,
    /// Rooms that no door joins with the others.
    #[error("дверями с остальными не соединено; положение задано связью глухих стен")]
    #[diagnostic(code(import::island))]
    Island,
    /// A lane that ends where no room is.
    #[error("кончается вне всех помещений")]
    #[diagnostic(code(import::lane_off_floor))]
    LaneOffFloor,
    /// A lane that leads through a wall.
    #[error("проходит сквозь стену, где нет проёма: «{rooms}»")]
    #[diagnostic(code(import::lane_through_wall))]
    LaneThroughWall { rooms: String },
    /// A level without a room.
    #[error("на этаже нет ни одного помещения")]
    #[diagnostic(code(import::empty_level))]
    EmptyLevel,
    /// A record of a sort that the Map has no place for.
    #[error("записи вида «{kind}» не переносятся")]
    #[diagnostic(code(import::not_carried))]
    NotCarried { kind: String },
    /// Boxes that a person's measuring would not have given.
    #[error(
        "коробки неточны: у вещей {off} из {of} низ дальше {} от того, на чём они стоят; взят профиль «detected» \
         (другой: --profile surveyed)",
        told(2)
    )]
    #[diagnostic(code(import::loose_boxes))]
    LooseBoxes { off: usize, of: usize },
    /// What a reader has to tell beyond these.
    #[error("{text}")]
    #[diagnostic(code(import::other))]
    Other { text: Bilingual },
}

impl Why {
    /// The stable code of the text: `import::dangling`.
    #[must_use]
    pub fn code(&self) -> String {
        Diagnostic::code(self).map_or_else(String::new, |code| code.to_string())
    }

    /// The text in a language.
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        match language {
            Language::Russian => self.to_string(),
            Language::English => self.english(),
        }
    }
}

/// One thing that happened to one record of the file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Note {
    pub treatment: Treatment,
    pub what: What,
    /// The record's id in the file.
    pub source: String,
    pub why: Why,
}

/// Records of one sort: how many the file has, how many of them arrived.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Count {
    pub found: usize,
    pub taken: usize,
}

/// What came of an import.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Report {
    /// Of the file: `Open-RMF`.
    pub format: String,
    /// The file's name.
    pub file: String,
    pub counts: BTreeMap<What, Count>,
    /// In the order in which they arose, which follows the file.
    pub notes: Vec<Note>,
}

/// Ids shown of one group of notes.
const SHOWN: usize = 5;

impl Report {
    #[must_use]
    pub fn new(format: &str, file: &str) -> Self {
        Self { format: format.to_owned(), file: file.to_owned(), ..Self::default() }
    }

    pub fn note(&mut self, treatment: Treatment, what: What, source: &str, why: Why) {
        self.notes.push(Note { treatment, what, source: source.to_owned(), why });
    }

    pub fn mended(&mut self, what: What, source: &str, why: Why) {
        self.note(Treatment::Mended, what, source, why);
    }

    pub fn skipped(&mut self, what: What, source: &str, why: Why) {
        self.note(Treatment::Skipped, what, source, why);
    }

    pub fn noted(&mut self, what: What, source: &str, why: Why) {
        self.note(Treatment::Noted, what, source, why);
    }

    /// Counts records that the file has.
    pub fn found(&mut self, what: What, count: usize) {
        self.counts.entry(what).or_default().found += count;
    }

    /// Counts records that arrived.
    pub fn taken(&mut self, what: What, count: usize) {
        self.counts.entry(what).or_default().taken += count;
    }

    #[must_use]
    pub fn count(&self, treatment: Treatment) -> usize {
        self.notes.iter().filter(|note| note.treatment == treatment).count()
    }

    /// Whether everything arrived as the file has it.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.notes.iter().all(|note| note.treatment == Treatment::Noted)
    }

    /// The report as data: counts by sort, notes with stable codes.
    #[must_use]
    pub fn to_json(&self, language: Language) -> serde_json::Value {
        let counts: Vec<_> = self
            .counts
            .iter()
            .map(|(what, count)| {
                serde_json::json!({ "what": what, "found": count.found, "taken": count.taken })
            })
            .collect();
        let notes: Vec<_> = self
            .notes
            .iter()
            .map(|n| {
                serde_json::json!({
                    "treatment": n.treatment,
                    "what": n.what,
                    "source": n.source,
                    "code": n.why.code(),
                    "why": n.why.say(language),
                })
            })
            .collect();
        serde_json::json!({
            "format": self.format,
            "file": self.file,
            "read": counts,
            "mended": self.count(Treatment::Mended),
            "skipped": self.count(Treatment::Skipped),
            "notes": notes,
        })
    }
}

impl Report {
    /// The report for a person.
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        let one = |what: What| language.pick(what.one().0, what.one().1);
        let counted = |what: What, count: usize| {
            let (russian, english) = what.counted();
            match language {
                Language::Russian => format!("{russian} {count}"),
                Language::English => format!("{english}: {count}"),
            }
        };
        let quoted = |text: &str| Bilingual::quoted(text).say(language).to_owned();
        let (file, format) = (quoted(&self.file), &self.format);
        let mut told = match language {
            Language::Russian => format!("Импорт {file}, формат {format}."),
            Language::English => format!("Import of {file}, format {format}."),
        };
        let of = language.pick("из", "of");
        let count = |(what, c): (&What, &Count)| match c.found == c.taken {
            true => counted(*what, c.taken),
            false => format!("{} {of} {}", counted(*what, c.taken), c.found),
        };
        let counts: Vec<String> = self.counts.iter().map(count).collect();
        if !counts.is_empty() {
            let read = language.pick("Прочитано", "Read");
            told.push_str(&format!("\n{read}: {}.", counts.join(", ")));
        }
        for (treatment, title) in [
            (Treatment::Mended, language.pick("Исправлено", "Mended")),
            (Treatment::Skipped, language.pick("Пропущено", "Left out")),
            (Treatment::Noted, language.pick("Замечено", "Noted")),
        ] {
            let mut groups: BTreeMap<(String, What), Vec<&Note>> = BTreeMap::new();
            for note in self.notes.iter().filter(|n| n.treatment == treatment) {
                groups.entry((note.why.code(), note.what)).or_default().push(note);
            }
            if groups.is_empty() {
                continue;
            }
            told.push_str(&format!("\n{title}: {}.", self.count(treatment)));
            // Of the whole file no id is told.
            let about = |note: &Note, before: &str| match note.source.is_empty() {
                true => String::new(),
                false => format!("{before}{}: ", quoted(&note.source)),
            };
            let line = |note: &Note| format!("{}{}", about(note, ""), note.why.say(language));
            for ((code, what), notes) in groups {
                if let [only] = notes[..] {
                    let (what, why) = (one(what), only.why.say(language));
                    told.push_str(&match about(only, " ") {
                        nothing if nothing.is_empty() => format!("\n  {what}: {why}"),
                        source => format!("\n  {what}{source}{why}"),
                    });
                    continue;
                }
                let (russian, english) = what.counted();
                let of_these = language.pick(russian, english);
                told.push_str(&format!("\n  {of_these}: {} ({code})", notes.len()));
                for note in notes.iter().take(SHOWN) {
                    told.push_str(&format!("\n    {}", line(note)));
                }
                if notes.len() > SHOWN {
                    let more = language.pick("и ещё", "and more:");
                    told.push_str(&format!("\n    {more} {}", notes.len() - SHOWN));
                }
            }
        }
        told
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.say(Language::Russian))
    }
}
