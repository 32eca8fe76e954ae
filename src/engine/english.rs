//! What a person asked that has no answer, in English.

use super::error::RequestError;
use crate::units::{Bilingual, InEnglish, Language, Lengths};

fn en(words: &Bilingual) -> &str {
    words.say(Language::English)
}

impl InEnglish for RequestError {
    fn english(&self) -> String {
        match self {
            Self::OutOfRange { what, value, low, high } => {
                format!("{what} = {value}, and it must be from {low} to {high}")
            }
            Self::NoScan { scan, count } => {
                format!("there is no scan {scan}, the log has {count}")
            }
            Self::NoLog => "this is a picture, and a log of scans is needed".to_owned(),
            Self::NoOdometry { line } => format!("the scan in line {line} tells no odometry"),
            Self::NoPose { line } => format!("the scan in line {line} tells no pose"),
            Self::NoPoses { count } => format!(
                "of {count} scans none tells a pose: it is not known what is seen from where"
            ),
            Self::NoPng => "this build cannot write PNG".to_owned(),
            Self::ManySheets { count } => {
                format!("there are {count} storeys, each with a sheet of its own")
            }
            Self::DrawingFormat { ending } => {
                format!("“.{ending}”: a drawing is written as SVG or PNG")
            }
            Self::NoMaps => "the domain has no map".to_owned(),
            Self::BeforeTheMap => "there was no map yet: the history begins later".to_owned(),
            Self::NoMap { store } => format!("the store “{store}” has no map"),
            Self::Fact { text } => format!("“{text}” cannot be read as a fact"),
            Self::UnknownName { name, .. } => format!("the map has no name “{name}”"),
            Self::AmbiguousName { name, candidates } => {
                format!("the name “{name}” can mean several: {}", en(candidates))
            }
            Self::UnknownRelation { name, .. } => format!("there is no relation “{name}”"),
            Self::NotThere { thing, place } => {
                format!("{} is not where you say: {}", en(thing), en(place))
            }
            Self::NotAPlace { name } => format!("the robot cannot stand at {}", en(name)),
            Self::OtherMap { from, to } => format!("“{from}” and “{to}” are on different maps"),
            Self::Nowhere { at, map, .. } => {
                format!("the point {at} lies in no room of the map “{}”", en(map))
            }
            Self::BadPose { text, reason } => format!("“{text}” is no pose: {}", en(reason)),
            Self::NoReport { text, word } => {
                format!("“{text}” cannot be read as a report of a position, from “{word}” on")
            }
            Self::NoSuchPlace { reason } => format!("the map has no such place: {}", en(reason)),
            Self::WhichMap { candidates } => {
                format!("the domain has several maps: {}", en(candidates))
            }
            Self::NoFloorThere { name } => {
                format!("there is no floor for the robot on that side of {}", en(name))
            }
            Self::NoFloorAt { at } => {
                format!("the robot does not fit at the point {at}, nor close by")
            }
            Self::OnlyGoneTo { at } => format!("to the point {at} I can only go"),
            Self::NotPutThere { name } => format!(
                "I put things onto, into or beside what is named, or in rooms, and not under, behind, in front or to one side of {}",
                en(name)
            ),
            Self::Untimed { names } => format!(
                "the map does not tell where this is: {}; how long the way takes is unknown",
                en(names)
            ),
            Self::NoCharger => "the map has no place to charge".to_owned(),
            Self::NoStart => "the map does not tell where the robot belongs".to_owned(),
            Self::NoLift => "there is no lift on this floor".to_owned(),
            Self::NotPortable { name } => format!("the robot does not carry {}", en(name)),
            Self::NotHollow { name } => {
                format!("nothing can be put into {}: the map knows of no room in it", en(name))
            }
            Self::Shut { name } => {
                format!("{} is shut, and the robot does not open doors of furniture", en(name))
            }
            Self::ShutIn { thing, container } => format!(
                "{} is in {}, which is shut, and the robot does not open doors of furniture",
                en(thing),
                en(container)
            ),
            Self::NoSpace { thing, area } => {
                format!("in {} there is nothing that {} could be put on", en(area), en(thing))
            }
            Self::Locked { name } => {
                format!("{} is locked, and the robot has no keys to furniture", en(name))
            }
            Self::WhichQueued { waiting } => {
                format!("it is not said which task: {waiting} are waiting")
            }
            Self::NoBin { thing } => {
                format!("the map has nothing into which to throw {}", en(thing))
            }
            Self::NotADoor { name } => format!(
                "{} is no door between rooms, and the robot opens and shuts no others",
                en(name)
            ),
            Self::LeadsOutside { name } => {
                format!("{} leads outside, and the robot uses only doors between rooms", en(name))
            }
            Self::NotCleaned { name } => format!(
                "the robot tidies up, and does not wash or wipe: {} stays as it is",
                en(name)
            ),
            Self::KeptThere { things, name } => {
                let things: Vec<&str> = things.iter().map(en).collect();
                let (name, things) = (en(name), things.join(", "));
                format!(
                    "nothing on {name} is known to be kept elsewhere: {things}; where is it to be put?"
                )
            }
            Self::OneHand { things } => {
                let things: Vec<&str> = things.iter().map(en).collect();
                let things = things.join(", ");
                format!(
                    "I have one hand and cannot hold all of these: {things}; where are they to be put?"
                )
            }
            Self::AtHome { things } => {
                let told =
                    |thing, home| format!("{} lies where it is kept: {}", en(thing), en(home));
                let each = things.iter().map(|(thing, home)| told(thing, home));
                each.collect::<Vec<_>>().join("; ")
            }
            Self::NotADevice { name } => {
                format!("{} can be switched neither on nor off", en(name))
            }
            Self::Homeless { things } => {
                let things: Vec<&str> = things.iter().map(en).collect();
                let belong = if things.len() == 1 { "belongs" } else { "belong" };
                format!("it is not known where {} {belong}", things.join(", "))
            }
            Self::NoHome { thing, home } => {
                format!("{} is kept on \"{home}\", and the map has no such thing", en(thing))
            }
            Self::PastIsPast => "the map’s past cannot be edited".to_owned(),
            Self::NotAThing { name } => format!("{} is no thing", en(name)),
            Self::NotAnArea { name } => format!("{} is no room", en(name)),
            Self::NotYet { name } => format!("{} was not on the map then", en(name)),
            Self::NothingProposed { name } => {
                format!("{}: nothing is proposed, it stands where the map has it", en(name))
            }
            Self::RobotNowhere => "it is not known where the robot is".to_owned(),
            Self::TruthOnRobot { thing } => {
                format!("in truth {} is where the robot stands", en(thing))
            }
            Self::NoRules { dir } => format!("there is no directory of rules “{dir}”"),
            Self::RulesThere { files } => format!("there are rule files already: {files}"),
            Self::GridTooLarge { map, limit } => {
                format!("the storey “{}” does not fit into a picture of {limit} cells", en(map))
            }
            Self::File { path, reason, .. } => format!("file “{path}”: {}", en(reason)),
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::OutOfRange { what, low, high, .. } => {
                return Some(format!("give --{what} from {low} to {high}"));
            }
            Self::NoScan { count, .. } => {
                return Some(format!("scans are counted from 1: --scan from 1 to {count}"));
            }
            Self::NoLog => "name a log: CARMEN, rows of ranges or Breezy",
            Self::NoOdometry { .. } => "leave out --follow: each scan by itself",
            Self::NoPose { .. } => {
                "leave out --posed: the place will be found on the map; or take a log with poses"
            }
            Self::NoPoses { .. } => {
                "build the things of one scan (--scan 1 --models), or take a log with poses"
            }
            Self::NoPng => "build it with `--features pictures`, or write SVG",
            Self::ManySheets { .. } => {
                "name a file: -o plan.svg; the next sheets are plan-2.svg and so on; or name a storey"
            }
            Self::DrawingFormat { .. } => "name a file that ends in .svg or .png, or add --png",
            Self::NoMaps => "draw an object: ortho draw object NAME",
            Self::BeforeTheMap => "what was when: ortho history",
            Self::NoMap { .. } => "import a map: ortho import maps/rb2.toml",
            Self::Fact { .. } => {
                "a fact is written RELATION(name, name), such as ON_TOP_OF(Cup, Table)"
            }
            Self::UnknownName { help, .. } | Self::UnknownRelation { help, .. } => {
                return help.as_ref().map(|help| en(help).to_owned());
            }
            Self::AmbiguousName { .. } => "name one of them in full",
            Self::NotThere { .. } => "ask “Where is …?”, and say what was meant",
            Self::NotAPlace { .. } => "name a place, a room, a door or a thing",
            Self::OtherMap { .. } => "name places on one storey",
            Self::Nowhere { extent, .. } => {
                return Some(format!(
                    "coordinates are in the map’s frame, {}: the map takes up {extent}",
                    Lengths::said().word(Language::English)
                ));
            }
            Self::BadPose { .. } => "write X,Y or X,Y,HEADING, such as 250,380,90",
            Self::NoReport { .. } => {
                "for example: “I am in Room V at the door leading from Room V to Room Z.”"
            }
            Self::NoSuchPlace { .. } => "the words are understood: compare the names with the map",
            Self::WhichMap { .. } => "name one of them",
            Self::NoFloorThere { .. } => {
                "name another side: in front, behind, to the left or to the right"
            }
            Self::NoFloorAt { .. } => "choose a point of the free floor",
            Self::OnlyGoneTo { .. } => {
                "to put something there, name a thing, a room or a place of the map"
            }
            Self::NotPutThere { .. } => "say onto or into what to put it, or in which room",
            Self::Untimed { .. } => {
                "name places and doors as the map knows them (ortho plan --facts), or leave out --metric time"
            }
            Self::NoCharger => {
                "a place to charge is a place or thing with “charger” in its name or type"
            }
            Self::NoStart => "give start in the section robot of the map",
            Self::NoLift => "a building’s lifts are declared in the section domain of the map",
            Self::NotPortable { .. } => "things can be carried whose type has the trait portable",
            Self::NotHollow { .. } => "say onto what to put it",
            Self::Shut { .. } | Self::ShutIn { .. } => {
                "open it yourself, and tell the map: ortho edit state DOOR open"
            }
            Self::NoSpace { .. } => "name what to put it on",
            Self::Locked { .. } => "open it yourself, and tell the map: ortho edit state DOOR open",
            Self::WhichQueued { .. } => "name its number: “cancel 2”, or “cancel all”",
            Self::NoBin { .. } => "a bin is a thing whose type, or a synonym of it, says so",
            Self::NotADoor { .. } | Self::LeadsOutside { .. } => {
                "the map’s doors: ortho relations --name CONNECTS"
            }
            Self::NotCleaned { .. } => {
                "rooms are tidied, and what things lie on: “Tidy up the table”"
            }
            Self::KeptThere { .. } | Self::AtHome { .. } | Self::OneHand { .. } => {
                "say where to put it"
            }
            Self::NotADevice { .. } => "a device is what has a type with the trait device",
            Self::Homeless { .. } => {
                "say where to put it, or give the thing the property ХРАНИТСЯ_НА"
            }
            Self::NoHome { .. } => "correct the property ХРАНИТСЯ_НА",
            Self::PastIsPast => {
                "leave out --as-of; to bring the map back: ortho as-of WHEN --restore"
            }
            Self::NotAThing { .. } => "the map’s things: ortho relations --name CONTAINS",
            Self::NotAnArea { .. } => "name a room of the map",
            Self::NotYet { .. } => "name a later time; a thing’s story: ortho find NAME --story",
            Self::NothingProposed { .. } => "what is proposed: ortho proposals",
            Self::RobotNowhere => {
                "tell its place: ortho do … --from PLACE, or in the map: [robot] start = \"place\""
            }
            Self::TruthOnRobot { .. } => {
                "move the thing in the file of --truth, or the robot: --from PLACE"
            }
            Self::NoRules { .. } => {
                "name a directory with relations.dl or service-robot.strips, or leave out --rules: the program itself has rules"
            }
            Self::RulesThere { .. } => {
                "name another directory, or overwrite them: ortho rules --export DIRECTORY --force"
            }
            Self::GridTooLarge { .. } => "take larger cells: --cell 10",
            Self::File { .. } => "check the path and the permissions",
        };
        Some(help.to_owned())
    }
}
