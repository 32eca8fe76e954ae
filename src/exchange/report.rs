//! What came of an import: how much was read, what was mended, what was left out, and why.
//!
//! **Invariant.** Every record of the file that does not arrive as it stands has a note with the file's own id; a whole
//! class of which nothing is made has one with the name of the class and how many there are.

use std::collections::BTreeMap;
use std::fmt;

use miette::Diagnostic;
use serde::Serialize;

use crate::units::{Bilingual, Fault as _, Language, Piece, told, word};

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
    pub fn counted(self) -> Piece {
        match self {
            Self::Building => word!("buildings"),
            Self::Level => word!("storeys"),
            Self::Room => word!("rooms"),
            Self::Door => word!("doors"),
            Self::Passage => word!("passages"),
            Self::Window => word!("windows"),
            Self::Lift => word!("lifts-and-stairs"),
            Self::Kind => word!("kinds-of-things"),
            Self::Thing => word!("things"),
            Self::Place => word!("places"),
            Self::Wall => word!("walls"),
            Self::Lane => word!("lanes"),
            Self::Relation => word!("relations"),
            Self::Record => word!("records"),
        }
    }

    fn one(self) -> Piece {
        match self {
            Self::Building => word!("building"),
            Self::Level => word!("storey"),
            Self::Room => word!("room"),
            Self::Door => word!("door"),
            Self::Passage => word!("passage"),
            Self::Window => word!("window"),
            Self::Lift => word!("lift"),
            Self::Kind => word!("kind-of-things"),
            Self::Thing => word!("thing"),
            Self::Place => word!("place"),
            Self::Wall => word!("wall"),
            Self::Lane => word!("lane"),
            Self::Relation => word!("relation"),
            Self::Record => word!("record"),
        }
    }
}

/// Why a record was mended or left out. Numbers are rounded for people; lengths in cm, areas in m².
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, crate::units::Fault)]
#[fault(import)]
#[non_exhaustive]
pub enum Why {
    /// Fewer than three different corners, or less floor than a robot's foot.
    NoOutline { least: u32 },

    /// Rings that cross themselves: the largest simple part is kept.
    OutlineCrosses,

    /// Two rooms claim one piece of floor.
    RoomsOverlap { other: String },

    /// One room drawn twice.
    RoomTwice { other: String },

    /// Subtraction cut pieces off a room that are too narrow to be floor.
    RoomCut,

    /// Subtraction cut a room apart.
    RoomParted { parts: usize },

    /// A hole outside of its room, or without area.
    BadHole,

    /// One id or name for several records.
    DuplicateName { name: String, given: String },

    /// One id for several records.
    DuplicateId { id: String },

    /// A reference that leads nowhere.
    Dangling { to: String },

    /// An opening with no room beside it.
    NoRoom,

    /// An opening amid one room's floor.
    WithinRoom,

    /// An opening that lies along three rooms or more.
    SeveralRooms { one: String, other: String },

    /// The rooms that a door names lie elsewhere.
    OtherRoom { room: String },

    /// Narrower than nothing can pass.
    TooNarrow { least: u32 },

    /// The wall is shorter than the opening.
    Narrowed { from: u32, to: u32 },

    /// No free stretch of wall.
    NoWall,

    /// A value out of its range.
    BadValue { what: Bilingual, value: Bilingual },

    /// A field that should be there.
    MissingField { field: &'static str },

    /// A thing in no room.
    Outside,

    /// A thing elsewhere than said.
    ThingElsewhere { room: String },

    /// A kind whose parts lie in one another.
    PartsOverlap,

    /// The file does not tell how large it is.
    UnknownSize { kind: String },

    /// A word that the synonym table lacks.
    UnknownWord { word: String },

    /// A lift that stops on one floor only.
    LiftStops,

    /// Rooms of several storeys that belong together.
    NoLift,

    /// Rooms that no door joins with the others.
    Island,

    /// A lane that ends where no room is.
    LaneOffFloor,

    /// A lane that leads through a wall.
    LaneThroughWall { rooms: String },

    /// A level without a room.
    EmptyLevel,

    /// A record of a sort that the Map has no place for.
    NotCarried { kind: String },

    /// Boxes that a person's measuring would not have given.
    LooseBoxes { off: usize, of: usize },

    /// What a reader has to tell beyond these.
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
        self.tell(language)
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
        let one = |what: What| what.one().say(language);
        let counted =
            |what: What, count: usize| told!(language, "counted-of", what = what.counted(), count);
        let quoted = |text: &str| Bilingual::quoted(text).say(language).to_owned();
        let (file, format) = (quoted(&self.file), &self.format);
        let mut told = told!(language, "import-of-format", file, format);
        let of = told!(language, "of");
        let count = |(what, c): (&What, &Count)| match c.found == c.taken {
            true => counted(*what, c.taken),
            false => format!("{} {of} {}", counted(*what, c.taken), c.found),
        };
        let counts: Vec<String> = self.counts.iter().map(count).collect();
        if !counts.is_empty() {
            let read = told!(language, "read");
            told.push_str(&format!("\n{read}: {}.", counts.join(", ")));
        }
        for (treatment, title) in [
            (Treatment::Mended, told!(language, "mended")),
            (Treatment::Skipped, told!(language, "left-out")),
            (Treatment::Noted, told!(language, "noted")),
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
                let of_these = what.counted().say(language);
                told.push_str(&format!("\n  {of_these}: {} ({code})", notes.len()));
                for note in notes.iter().take(SHOWN) {
                    told.push_str(&format!("\n    {}", line(note)));
                }
                if notes.len() > SHOWN {
                    let more = told!(language, "and-more");
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

impl crate::units::Value for Report {
    fn told(&self, language: Language) -> Option<crate::units::Argument<'_>> {
        Some(self.say(language).into())
    }
}
