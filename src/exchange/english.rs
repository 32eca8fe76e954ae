//! Why a foreign file gives no map, or not all of one, in English.

use super::report::Why;
use super::{ImportError, ReadError, Treatment};
use crate::units::{Bilingual, InEnglish, Language, Lengths};

fn en(words: &Bilingual) -> &str {
    words.say(Language::English)
}

impl InEnglish for ReadError {
    fn english(&self) -> String {
        match self {
            Self::Unreadable { path, reason } => format!("“{path}” cannot be read: {}", en(reason)),
            Self::TooLarge { bytes, limit } => {
                format!("the file takes {bytes} bytes, and the limit is {limit}")
            }
            Self::NotText { name, at, byte } => {
                format!("“{name}” is no text: byte {at} is {byte:#04x}")
            }
            Self::Archive { name } => format!("“{name}” is a ZIP archive"),
            Self::Picture { name } => {
                format!("“{name}” is a picture, which does not tell its scale")
            }
            Self::Syntax { format, what, .. } => format!("{format}: {}", en(what)),
            Self::Bytes { format, what, at } => format!("{format}, byte {at}: {}", en(what)),
            Self::TooMany { format, what, limit } => {
                format!("{format}: more than {limit} {}", en(what))
            }
            Self::NoSizes { format, what, count } => {
                format!("{format}: none of {count} things has a size: {}", en(what))
            }
            Self::NoBuilding { format, what } => format!("{format}: {}", en(what)),
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Unreadable { .. } => "check the path and the permissions",
            Self::TooLarge { .. } | Self::TooMany { .. } => {
                "divide the building into several files"
            }
            Self::NotText { .. } => {
                "a text in UTF-8, UTF-16 with a byte order mark, or Windows-1251 is needed"
            }
            Self::Archive { .. } => {
                "unpack it and name the folder: archives of IMDF are read so as well"
            }
            Self::Picture { .. } => {
                "say how many centimetres a pixel of the PNG or PGM is: --pixel 2; or name a YAML file with image, resolution and origin, as ROS map_server has it"
            }
            Self::Syntax { .. } => "correct the file in this place",
            Self::Bytes { .. } => "save the file anew with the program that made it",
            Self::NoSizes { .. } => {
                "put asset-database.json beside the house’s file, or name it: --assets FILE"
            }
            Self::NoBuilding { .. } => "a file with at least one room is needed",
        };
        Some(help.to_owned())
    }
}

impl InEnglish for ImportError {
    fn english(&self) -> String {
        match self {
            Self::Read(error) => error.english(),
            Self::Limit { what, count, limit } => {
                format!("{}: {count}, and the limit is {limit}", en(what))
            }
            Self::UnknownFormat { path, .. } => {
                format!("the format of the file “{path}” is not recognised")
            }
            Self::Content { format, message, .. } => format!("{format}: {}", en(message)),
            Self::NoAssets { wanted } => format!("the file of sizes is not found: {wanted}"),
            Self::Synonyms { message, .. } => format!("table of synonyms: {}", en(message)),
            Self::Strict { report } => format!(
                "strict import: {} mended, {} left out",
                report.count(Treatment::Mended),
                report.count(Treatment::Skipped)
            ),
            Self::Map(faults) => faults.in_english().to_string(),
        }
    }

    fn english_help(&self) -> Option<String> {
        Some(match self {
            Self::Read(error) => return error.english_help(),
            Self::Limit { .. } => "divide the building into several files".to_owned(),
            Self::UnknownFormat { known, .. } => {
                format!("there are read: {known}; the format may be named: --format")
            }
            Self::Content { help, .. } => en(help).to_owned(),
            Self::NoAssets { .. } => "name it: --assets FILE".to_owned(),
            Self::Synonyms { .. } => "an example: rules/import-synonyms.toml".to_owned(),
            Self::Strict { report } => format!(
                "mend the file, or import without --strict\n{}",
                report.say(Language::English)
            ),
            Self::Map(_) => return None,
        })
    }
}

/// A length in cm.
fn told(cm: u32) -> String {
    Lengths::said().told(f64::from(cm), 0, Language::English)
}

impl InEnglish for Why {
    fn english(&self) -> String {
        match self {
            Self::NoOutline { least } => {
                let least = Lengths::said().told_area(f64::from(*least), 0, Language::English);
                format!("the outline has no floor: its area is less than {least}")
            }
            Self::OutlineCrosses => {
                "the outline crossed itself; the largest part is kept".to_owned()
            }
            Self::RoomsOverlap { other } => {
                format!("overlapped “{other}”, which keeps the common floor")
            }
            Self::RoomTwice { other } => format!("repeats “{other}”"),
            Self::RoomCut => format!("cut by overlapping; parts narrower than {} are dropped", told(20)),
            Self::RoomParted { parts } => {
                format!("cut by overlapping into {parts}; each part became a room")
            }
            Self::BadHole => "a hole in the outline is of no use".to_owned(),
            Self::DuplicateName { name, given } => {
                format!("the name “{name}” is taken; the name “{given}” is given")
            }
            Self::DuplicateId { id } => format!("the id “{id}” is given more than once"),
            Self::Dangling { to } => format!("refers to “{to}”, which the file does not have"),
            Self::NoRoom => "no room is beside it".to_owned(),
            Self::WithinRoom => "stands within one room, away from walls".to_owned(),
            Self::SeveralRooms { one, other } => {
                format!("touches not two rooms; “{one}” and “{other}” are taken")
            }
            Self::OtherRoom { room } => {
                format!("is not at “{room}”, which it names; its rooms are found by place")
            }
            Self::TooNarrow { least } => format!("narrower than {}", told(*least)),
            Self::Narrowed { from, to } => format!(
                "narrowed from {} to {}: the wall is shorter, or the opening is taken",
                told(*from),
                told(*to)
            ),
            Self::NoWall => {
                "does not fit into a wall: another opening is there, or it is too short or far"
                    .to_owned()
            }
            Self::BadValue { what, value } => format!("{}: bad value {}", en(what), en(value)),
            Self::MissingField { field } => format!("the field “{field}” is missing"),
            Self::Outside => "stands outside of all rooms".to_owned(),
            Self::ThingElsewhere { room } => {
                format!("stands not in “{room}”, which is named; the room is found by place")
            }
            Self::PartsOverlap => {
                "parts of the kind overlapped; what was too much is cut off".to_owned()
            }
            Self::UnknownSize { kind } => {
                format!("the size of the kind “{kind}” is not known: a flat mark is put")
            }
            Self::UnknownWord { word } => {
                format!("the word “{word}” is not in the table of synonyms: no type is given")
            }
            Self::LiftStops => "joins fewer than two storeys".to_owned(),
            Self::NoLift => {
                "joins storeys, and the file does not say whether it is a lift or stairs; no way leads by it"
                    .to_owned()
            }
            Self::Island => {
                "no door joins it with the rest; its place is given by a link of blind walls"
                    .to_owned()
            }
            Self::LaneOffFloor => "ends outside of all rooms".to_owned(),
            Self::LaneThroughWall { rooms } => {
                format!("leads through a wall where there is no opening: “{rooms}”")
            }
            Self::EmptyLevel => "the storey has no room".to_owned(),
            Self::NotCarried { kind } => format!("records of the kind “{kind}” are not carried over"),
            Self::LooseBoxes { off, of } => format!(
                "the boxes are not exact: {off} of {of} things have their bottom more than {} off what they stand on; the profile “detected” is taken (another: --profile surveyed)",
                told(2)
            ),
            Self::Other { text } => en(text).to_owned(),
        }
    }

    fn english_help(&self) -> Option<String> {
        None
    }
}
