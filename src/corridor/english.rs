//! What can be wrong with a corridor file, or with a question about the way, in English.

use super::error::CorridorError;
use super::fault::{CorridorFault, CorridorFileError};
use crate::units::{Bilingual, English, EnglishGroup, InEnglish, Language};

fn en(words: &Bilingual) -> &str {
    words.say(Language::English)
}

impl InEnglish for CorridorError {
    fn english(&self) -> String {
        match self {
            Self::UnknownRoom { room, .. } => {
                format!("unknown room “{room}”: no entrance of this name is on the corridors")
            }
            Self::UnknownVertex { vertex, .. } => {
                format!("the corridors have no vertex {vertex}")
            }
            Self::SeveralEntrances { room, vertices, .. } => {
                format!("the room “{room}” has several entrances: the vertices {vertices}")
            }
            Self::UnknownArc { from, to, .. } => {
                format!("the graph has no arc ({from}, {to})")
            }
            Self::LastArcElsewhere { vertex, from, to } => format!(
                "the robot cannot stand at the vertex {vertex} if the last arc was ({from}, {to})"
            ),
            Self::Unreachable { from, to, .. } => {
                format!("the corridors do not lead from “{from}” to “{to}”")
            }
            Self::AtJunction { vertex } => format!(
                "the vertex {vertex} is a junction: the second kind of graph has no such vertex"
            ),
            Self::HeadingNeeded { vertex } => format!(
                "the vertex {vertex} is a junction: without a heading it cannot be said where to turn"
            ),
            Self::GoalIsJunction { vertex } => {
                format!("the goal is the vertex {vertex}, a junction and no entrance")
            }
            Self::NoLength { from, to } => format!(
                "the length of the stretch ({from}, {to}) is not known, and the way is to be measured in metres"
            ),
            Self::UnknownMap { map } => format!("the world has no map of the number {map}"),
            Self::NoCorridors { name } => format!("the map “{name}” has no corridors"),
        }
    }

    fn english_help(&self) -> Option<String> {
        Some(match self {
            Self::UnknownRoom { hint, .. } | Self::Unreachable { hint, .. } => en(hint).to_owned(),
            Self::UnknownVertex { known, .. } => format!("the vertices are numbered: {known}"),
            Self::SeveralEntrances { example, .. } => {
                format!("name a vertex (such as #{example}), or the last arc that was driven")
            }
            Self::UnknownArc { to, neighbours, .. } => {
                format!("the last arc leads to the vertex {to} from one beside it: {neighbours}")
            }
            Self::LastArcElsewhere { vertex, .. } => format!(
                "the last arc must lead to the vertex {vertex}; if the heading is not known, leave it out"
            ),
            Self::AtJunction { .. } => {
                "begin at an entrance, or take the first kind of graph".to_owned()
            }
            Self::HeadingNeeded { .. } => "name the last arc that was driven".to_owned(),
            Self::GoalIsJunction { .. } => "name a room, or the vertex of an entrance".to_owned(),
            Self::NoLength { .. } => {
                "give metres for all stretches, or measure = \"arcs\"".to_owned()
            }
            Self::UnknownMap { .. } => return None,
            Self::NoCorridors { .. } => {
                "give corridors a type of rooms with the trait corridor".to_owned()
            }
        })
    }
}

impl InEnglish for CorridorFault {
    fn english(&self) -> String {
        match self {
            Self::Syntax { message, .. } => format!("the text is no TOML: {message}"),
            Self::Notation { .. } => {
                "this is no corridor file: the text begins as JSON, and a corridor file is TOML"
                    .to_owned()
            }
            Self::UnknownField { field, .. } => format!("unknown field “{field}”"),
            Self::MissingField { field, .. } => format!("the field “{field}” is missing"),
            Self::WrongValue { field, expected, .. } => {
                format!("field “{field}”: {} is needed", en(expected))
            }
            Self::UnknownFormat { found, .. } => format!("unknown format {found}"),
            Self::Empty { .. } => "the description has no corridor".to_owned(),
            Self::RoomAndJunction { vertex, .. } => {
                format!("the vertex {vertex} is both an entrance and a junction")
            }
            Self::RepeatedEntrance { vertex, .. } => {
                format!("the entrance {vertex} stands elsewhere already")
            }
            Self::UndeclaredVertex { vertex, .. } => format!(
                "nowhere is said whether the vertex {vertex} is an entrance, or what junction it is"
            ),
            Self::VertexMeetsItself { vertex, .. } => {
                format!("the vertex {vertex} stands twice running in the list")
            }
            Self::AheadNotAtEnd { vertex, .. } => format!(
                "the door of the vertex {vertex} is ahead, but the corridor goes on behind it"
            ),
            Self::JunctionWithoutApproach { vertex, .. } => {
                format!("no stretch of this corridor leads to the junction {vertex}")
            }
            Self::NoSuchWay { vertex, kind, way, .. } => {
                format!("junction {vertex}: the kind “{kind}” has no way {way}")
            }
            Self::NoSuchNeighbour { vertex, neighbour, .. } => format!(
                "junction {vertex}: it has no neighbour {neighbour}, or several corridors lead to that"
            ),
            Self::ArmsDisagree { vertex, kind, wanted, found, neighbours, .. } => format!(
                "junction {vertex}: the kind “{kind}” takes {wanted} corridors, and {found} are described (neighbours {neighbours})"
            ),
            Self::AmbiguousArms { vertex, neighbours, .. } => format!(
                "junction {vertex}: it is not clear which corridor leads where (neighbours {neighbours})"
            ),
            Self::JunctionDisagrees { vertex, said, seen, .. } => format!(
                "junction {vertex}: here it is “{said}”, and by another corridor’s description it looks “{seen}” from here"
            ),
            Self::WayDisagrees { vertex, way, said, seen, .. } => format!(
                "junction {vertex}: the way {way} leads from here to “{}”, and by another corridor’s description to “{}”",
                en(said),
                en(seen)
            ),
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Syntax { .. } => "an example: maps/corridor-paper4.toml",
            Self::Notation { .. } => {
                "an example: maps/corridor-paper4.toml; on a map: ortho corridor --map FILE"
            }
            Self::UnknownField { hint, .. } | Self::MissingField { hint, .. } => en(hint),
            Self::WrongValue { .. } => "correct the value",
            Self::UnknownFormat { .. } => "this version of the program reads format = 1",
            Self::Empty { .. } => "add [[corridor]] with a list along",
            Self::RoomAndJunction { .. } => {
                "keep room with side, or junction; different places have different numbers"
            }
            Self::RepeatedEntrance { .. } => {
                "each entrance is described once; only a junction is common to two corridors"
            }
            Self::UndeclaredVertex { .. } => {
                "give room and side (an entrance) or junction (its kind) in one corridor at least"
            }
            Self::VertexMeetsItself { .. } => "remove the repetition; closed = true closes a ring",
            Self::AheadNotAtEnd { .. } => {
                "only the door at the end of a blind alley is ahead: the first or the last of the list"
            }
            Self::JunctionWithoutApproach { .. } => {
                "a junction is described as it looks from this corridor: add the vertex beside it"
            }
            Self::NoSuchWay { ways, .. } => return Some(format!("the ways of this kind: {ways}")),
            Self::NoSuchNeighbour { neighbours, .. } => {
                return Some(format!("the neighbours as described: {neighbours}"));
            }
            Self::ArmsDisagree { .. } => {
                "correct the kind, add a corridor, or mark the empty way: blind = [\"right\"]"
            }
            Self::AmbiguousArms { .. } => {
                "name the neighbours as seen from this corridor: straight = …, right = …, left = …"
            }
            Self::JunctionDisagrees { .. } => {
                "one junction looks different from different sides; correct one of the descriptions"
            }
            Self::WayDisagrees { .. } => "correct one of the descriptions",
        };
        Some(help.to_owned())
    }

    fn english_labels(&self) -> [&'static str; 2] {
        match self {
            Self::UnknownField { .. } => ["this field", ""],
            Self::WrongValue { .. } => ["this value", ""],
            Self::UnknownFormat { .. } => ["this number", ""],
            Self::RepeatedEntrance { .. } => ["the second time here", "the first time here"],
            Self::VertexMeetsItself { .. } => ["the second time here", ""],
            Self::AheadNotAtEnd { .. } => ["this side", ""],
            Self::NoSuchWay { .. } | Self::WayDisagrees { .. } => ["this way", ""],
            Self::NoSuchNeighbour { .. } => ["this neighbour", ""],
            Self::ArmsDisagree { .. } => ["this kind", ""],
            Self::AmbiguousArms { .. } => ["this junction", ""],
            Self::JunctionDisagrees { .. } => ["this description", "the other description"],
            Self::Syntax { .. }
            | Self::Notation { .. }
            | Self::MissingField { .. }
            | Self::Empty { .. }
            | Self::RoomAndJunction { .. }
            | Self::UndeclaredVertex { .. }
            | Self::JunctionWithoutApproach { .. } => ["here", ""],
        }
    }
}

impl CorridorFileError {
    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishGroup<'_, CorridorFault> {
        let mut title = format!("the corridors are not accepted, faults: {}", self.faults.len());
        for fault in &self.faults {
            let (line, column) = self.source_text.position(fault.offset());
            let name = self.source_text.name();
            title.push_str(&format!("\n{name}:{line}:{column}: {}", fault.english()));
        }
        EnglishGroup {
            all: self,
            title,
            help: Some("correct the places that are marked".to_owned()),
            faults: self.faults.iter().map(English).collect(),
        }
    }
}
