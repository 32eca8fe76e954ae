//! What is wrong with a map, in English.

use std::fmt;

use miette::{Diagnostic, Severity, SourceCode};

use super::{Fault, MapError, MapErrors};
use crate::units::{Bilingual, Cm, English, InEnglish, Language};

fn en(words: &Bilingual) -> &str {
    words.say(Language::English)
}

fn cm(length: &Cm) -> String {
    length.say(Language::English)
}

fn perhaps(nearest: &Option<String>) -> String {
    nearest.as_ref().map(|name| format!("; perhaps “{name}”?")).unwrap_or_default()
}

impl MapError {
    /// The fault in English.
    #[must_use]
    pub fn english(&self) -> String {
        match self {
            Self::Unreadable { path, message } => {
                format!("the file “{path}” cannot be read: {}", en(message))
            }
            Self::TooLarge { bytes, limit } => {
                format!("the map file is too large: {bytes} bytes, the limit is {limit}")
            }
            Self::Empty => "the map file is empty".to_owned(),
            Self::Syntax { format, message } => format!("no valid {format}: {}", en(message)),
            Self::Format { found } => format!("unknown version of the format: {found}"),
            Self::UnknownField { field, nearest, .. } => {
                format!("unknown field “{field}”{}", perhaps(nearest))
            }
            Self::MissingField { field } => format!("the field “{field}” is missing"),
            Self::WrongKind { found, expected } => {
                format!("{} stands here, and {} is needed", en(found), en(expected))
            }
            Self::UnknownWord { word, nearest, .. } => {
                format!("unknown word “{word}”{}", perhaps(nearest))
            }
            Self::BadValue { message } => format!("bad value: {}", en(message)),
            Self::OutOfRange { what, value, range } => {
                format!("{} = {value}, and must be {}", en(what), en(range))
            }
            Self::UnknownReference { what, name, nearest } => {
                format!("{} “{name}” does not exist{}", en(what), perhaps(nearest))
            }
            Self::AmbiguousName { name, candidates } => {
                format!("the name “{name}” can mean several: {candidates}")
            }
            Self::BadReference { text, .. } => format!("the reference “{text}” makes no sense"),
            Self::DuplicateId { what, id } => {
                format!("{}: the number {id} is given twice", en(what))
            }
            Self::BadZone { owner, message } => format!("{}: {}", en(owner), en(message)),
            Self::DanglingId { owner, what, id } => {
                format!("{}: there is no {} of the number {id}", en(owner), en(what))
            }
            Self::DuplicateName { name, first, second } => {
                format!("two bear the name “{name}”: {} and {}", en(first), en(second))
            }
            Self::NoName { what } => format!("{} without a name", en(what)),
            Self::BadId { owner, id } => format!("{}: bad id “{id}”", en(owner)),
            Self::DuplicatePart { owner, id } => {
                format!("{}: the id “{id}” is given twice", en(owner))
            }

            Self::BaseForm { name, count } => {
                format!("Orthoframe “{name}”: the Base is given in {count} ways instead of one")
            }
            Self::BaseTooShort { name, count } => {
                format!(
                    "Orthoframe “{name}”: the Base has {count} vectors and needs at least three"
                )
            }
            Self::BaseZeroLength { name, side, at } => {
                format!("Orthoframe “{name}”: the vector {side} has no length, at {at}")
            }
            Self::BaseNotConnected { name, side, end, next, start } => format!(
                "Orthoframe “{name}”: the Base is not connected: the vector {side} ends at {end}, and the next, {next}, begins at {start}"
            ),
            Self::BaseNotClosed { name, side, end, next, start } => format!(
                "Orthoframe “{name}”: the Base is not closed: the last vector {side} ends at {end}, and the first, {next}, begins at {start}"
            ),
            Self::BaseCrossesItself { name, side, other, at } => format!(
                "Orthoframe “{name}”: the Base crosses itself: the vectors {side} and {other} meet at {at}"
            ),
            Self::BaseClockwise { name } => {
                format!("Orthoframe “{name}”: the vectors of the Base run clockwise")
            }
            Self::BaseNoArea { name } => format!("Orthoframe “{name}”: the Base has no area"),
            Self::NegativeHeight { name, height } => {
                format!("Orthoframe “{name}”: the height {} is negative", cm(height))
            }

            Self::NoItems { owner } => format!("{}: it has no parts", en(owner)),
            Self::BaseItemCount { owner, count } => {
                format!("{}: {count} base parts, and exactly one is needed", en(owner))
            }
            Self::BaseItemOffOrigin { owner, item, nearest } => format!(
                "{}: no corner of the base part “{item}” stands at the origin; the nearest is {nearest}",
                en(owner)
            ),
            Self::UnknownItem { owner, item, .. } => {
                format!("{}: there is no part “{item}”", en(owner))
            }
            Self::UnknownSide { owner, item, side, .. } => {
                format!("{}: the part “{item}” has no side “{side}”", en(owner))
            }
            Self::LinkFaces { owner, link } => {
                format!(
                    "{}: the link {link} joins a horizontal face with an upright one",
                    en(owner)
                )
            }
            Self::LinkContradicts { owner, link, claimed, found } => format!(
                "{}: the link {link} and the positions contradict: by the link {}, by the positions {}",
                en(owner),
                en(claimed),
                en(found)
            ),
            Self::LinkLength { owner, link, length, other } => format!(
                "{}: the link {link} joins openings of different widths: {} and {}",
                en(owner),
                cm(length),
                cm(other)
            ),
            Self::LinkPermeability { owner, link } => {
                format!("{}: the link {link} joins faces of different permeability", en(owner))
            }
            Self::LinkApart { owner, link, distance } => format!(
                "{}: the openings of the link {link} do not meet: they are {} apart",
                en(owner),
                cm(distance)
            ),
            Self::ItemsOverlap { owner, item, other, at } => {
                format!("{}: the parts “{item}” and “{other}” overlap, for one at {at}", en(owner))
            }
            Self::ItemsApart { owner, item } => {
                format!("{}: the part “{item}” is not connected with the others", en(owner))
            }

            Self::AreasOverlap { map, area, other, at } => {
                format!("{}: the areas “{area}” and “{other}” overlap, for one at {at}", en(map))
            }
            Self::AreasApart { map, area } => {
                format!("{}: the area “{area}” is not connected with the others", en(map))
            }
            Self::AreaTwice { area } => format!("the area “{area}” stands on maps twice"),
            Self::AreaNowhere { area } => format!("the area “{area}” stands on no map"),
            Self::DomainMaps { map, count } => {
                format!("the map “{map}” stands in the domain {count} times, and must once")
            }
            Self::LiftStops { lift } => {
                format!("the lift “{lift}” joins no areas of different maps")
            }

            Self::DoorOnWrongSide { owner, door, side, why } => format!(
                "{}: the door “{door}” hangs on the side {side}, which does not fit it: {}",
                en(owner),
                en(why)
            ),
            Self::SideWithoutDoor { owner, side } => {
                format!("{}: the conditional side {side} has no door", en(owner))
            }
            Self::SideTwoDoors { owner, side } => {
                format!("{}: the side {side} has two doors", en(owner))
            }
            Self::DoorTooWide { owner, door, width, side, length } => format!(
                "{}: the door “{door}”, {} wide, does not go into the side {side}, {} long",
                en(owner),
                cm(width),
                cm(length)
            ),
            Self::DoorTooHigh { owner, door, height, side, wall } => format!(
                "{}: the door “{door}”, {} high, is higher than the side {side} with its {}",
                en(owner),
                cm(height),
                cm(wall)
            ),
            Self::DoorUnused { door } => format!("the door “{door}” hangs nowhere"),
            Self::DoorMounts { door, count } => {
                format!("the door “{door}” hangs {count} times; a door joins at most two areas")
            }
            Self::DoorApart { door, side, other } => format!(
                "door “{door}”: the sides {side} and {other} on which it hangs do not meet on the map"
            ),
            Self::DoorDirection { door, way } => {
                format!("door “{door}”: both areas say that it opens {}", en(way))
            }
            Self::DoorLeaves { door, why } => format!("door “{door}”: {}", en(why)),
            Self::LeafShares { door, sum } => {
                format!("door “{door}”: the shares of its leaves sum up to {sum}, not to 1")
            }
            Self::DoorState { door, opening, status } => format!(
                "door “{door}”: an opening of {opening} % does not go with the state “{}”",
                en(status)
            ),

            Self::ReplicaOutside { replica, area, at } => {
                format!("“{replica}” stands outside its area “{area}”: its middle is at {at}")
            }
            Self::ReplicaThroughWall { replica, area, by, at } => format!(
                "“{replica}” sticks through the walls of the area “{area}” by {}, as far as {at}",
                cm(by)
            ),
            Self::ReplicaHeight { replica, area, bottom, top, floor, ceiling } => format!(
                "“{replica}” takes the heights from {} to {}, and the area “{area}” has {} to {}",
                cm(bottom),
                cm(top),
                cm(floor),
                cm(ceiling)
            ),
            Self::PlaceOutside { place, area } => {
                format!("the place “{place}” lies outside its area “{area}”")
            }
            Self::BadFootprint { reason } => format!("the robot's footprint: {}", en(reason)),

            Self::NoEdits => "the edit file says nothing".to_owned(),
            Self::UnknownVerb { found, nearest, .. } => {
                format!("unknown step “{found}”{}", perhaps(nearest))
            }
            Self::AlreadyThere { what, name } => {
                format!("{} “{name}” is on the map already", en(what))
            }
            Self::StillUsed { what, name, by } => {
                format!("{} “{name}” is still needed: {}", en(what), en(by))
            }
            Self::NotBound { door } => format!("the door “{door}” does not hang there"),
            Self::NotLinked { link } => format!("there is no link {link}"),
            Self::AreaNowhereYet { area } => format!("the area “{area}” stands on no map yet"),
            Self::ThingsOverlap { thing, other, at } => {
                format!("“{thing}” and “{other}” are in one another, for instance at {at}")
            }
            Self::ThingHovers { thing, over, height } => format!(
                "“{thing}” hovers: {} above {}, and neither a wall nor the ceiling holds it",
                cm(height),
                en(over)
            ),
            Self::DoorwayBarred { door, things, free, width } => format!(
                "in the doorway “{door}”, {} wide, there stands {}: {} is free",
                cm(width),
                en(things),
                cm(free)
            ),
            Self::PlaceUnder { place, thing } => {
                format!("the place “{place}” lies under “{thing}”: the robot cannot stand there")
            }
            Self::NamesNothing { property, what, name, nearest } => format!(
                "{property} names “{name}”, and there is no such {} on the map{}",
                en(what),
                perhaps(nearest)
            ),
            Self::UnknownState { property, value, .. } => {
                format!("{property} = “{value}”: the program knows no such state")
            }
            Self::UnknownTrait { owner, word, nearest, .. } => format!(
                "the type “{owner}”: neither the program nor a rule knows the trait “{word}”{}",
                perhaps(nearest)
            ),
            Self::Metres { what, size, .. } => {
                format!("{}: the size is {size}; are these metres?", en(what))
            }
            Self::MoreAlike { count, kind } => format!("and {count} more of this sort ({kind})"),
            Self::OtherBuilding { what, how } => format!("{}: {}", en(what), en(how)),
            Self::Carried { name } => format!(
                "the robot, or whom it was handed to, has “{name}”, which stands nowhere on the map now"
            ),
            Self::More { count } => format!("and {count} more"),
        }
    }

    /// The remedy in English.
    fn english_help(&self) -> String {
        let told = match self {
            Self::Unreadable { .. } => "check the path of the file; a map is a text in UTF-8",
            Self::TooLarge { .. } => "divide the map into several files",
            Self::Empty => "a map begins with the line `format = 1`; an example is maps/lab.toml",
            Self::Syntax { .. } => "mend this place; an example is maps/lab.toml",
            Self::Format { .. } => "this program reads maps of version 1: `format = 1`",
            Self::UnknownField { expected, .. } => {
                return format!("these fields may stand here: {expected}");
            }
            Self::MissingField { field } => return format!("add the field “{field}”"),
            Self::WrongKind { expected, .. } => {
                return format!("replace the value; needed is {}", en(expected));
            }
            Self::UnknownWord { expected, .. } => {
                return format!("one of these words may stand here: {expected}");
            }
            Self::BadValue { .. } => "mend the value",
            Self::OutOfRange { what, range, .. } => {
                return format!("make {} {}", en(what), en(range));
            }
            Self::UnknownReference { what, name, .. } => {
                return format!("correct the name, or describe {} “{name}”", en(what));
            }
            Self::AmbiguousName { .. } => "name one of them in full",
            Self::BadReference { wanted, .. } => {
                return format!("write the reference as {}", en(wanted));
            }
            Self::DuplicateId { .. } => "remove the field id, or give another number",
            Self::DanglingId { .. } => "add what is missing, or remove the reference",
            Self::DuplicateName { name, .. } => {
                return format!("give each a name of its own, such as “{}-2”", name.trim());
            }
            Self::NoName { .. } => "give it a name in the field name",
            Self::BadId { .. } => {
                "an id is not empty, holds no dot, and is none of base, roof, база, потолок"
            }
            Self::DuplicatePart { .. } => "ids of parts and sides do not repeat",

            Self::BaseForm { .. } => "keep one of the fields rect, regular, points, sides",
            Self::BaseTooShort { .. } => "describe a closed polygon of three sides or more",
            Self::BaseZeroLength { side, .. } => {
                return format!("remove the vector {side}, or move its ends apart");
            }
            Self::BaseNotConnected { next, end, .. } => {
                return format!("begin the vector {next} at {end}");
            }
            Self::BaseNotClosed { side, start, .. } => {
                return format!("end the vector {side} at {start}");
            }
            Self::BaseCrossesItself { .. } => "place the corners so that the sides do not meet",
            Self::BaseClockwise { .. } => {
                "write the corners counter-clockwise, or add `reverse = true`"
            }
            Self::BaseNoArea { .. } => "the corners of the Base lie on one line: move them apart",
            Self::NegativeHeight { .. } => {
                "the height is the distance from Base to Roof, 0 or more"
            }

            Self::NoItems { .. } => "list the parts in the field items",
            Self::BaseItemCount { .. } => "mark exactly one part with `base = true`",
            Self::BaseItemOffOrigin { .. } => {
                "move the part so that a corner of it falls on [0, 0]; a map with coordinates of another names them in its field frame"
            }
            Self::UnknownItem { known, .. } => return format!("there are the parts: {known}"),
            Self::UnknownSide { known, .. } => return format!("there are the sides: {known}"),
            Self::LinkFaces { .. } => "a Roof is linked with a Base, or a side with a side",
            Self::LinkContradicts { .. } => {
                "correct the position (at, angle) of one of the parts, or the offset (rel, angle) of the link"
            }
            Self::LinkLength { .. } => "permeable and conditional sides are of equal length",
            Self::LinkPermeability { .. } => "make both sides permeable, or both impermeable",
            Self::LinkApart { .. } => "bring the sides together: their ends lie in the same points",
            Self::ItemsOverlap { .. } => "move the parts apart: they may only touch",
            Self::ItemsApart { .. } => "add a link in links, or move the part close",

            Self::AreasOverlap { .. } => "move one of the areas",
            Self::AreasApart { .. } => {
                "link one of its sides with a neighbour's in the field links of the map"
            }
            Self::AreaTwice { .. } => "each area stands on one map, once",
            Self::AreaNowhere { .. } => "add it to the items of a map",
            Self::DomainMaps { .. } => "list each map once in the field maps of the domain",
            Self::LiftStops { .. } => "list areas of two maps or more in stops",

            Self::DoorOnWrongSide { .. } => {
                "a door hangs on a conditional side (permeability = \"conditional\"), a passage on a permeable one"
            }
            Self::SideWithoutDoor { .. } => {
                "hang a door in the field doors, or change the permeability"
            }
            Self::SideTwoDoors { .. } => "leave one door on the side",
            Self::DoorTooWide { .. } => "make the door no wider than the side",
            Self::DoorTooHigh { .. } => "make the door no higher than the area",
            Self::DoorUnused { .. } => "name it in the field doors of an area or an object",
            Self::DoorMounts { .. } => "make a door of its own for each opening",
            Self::DoorApart { .. } => "a door joins sides that are linked in the links of the map",
            Self::DoorDirection { .. } => {
                "opens = \"inside\" for one of the areas, \"outside\" for the other"
            }
            Self::DoorLeaves { .. } => {
                "a door needs at least one leaf in leaves, a passage has none"
            }
            Self::LeafShares { .. } => "the shares (share) of all leaves sum up to 1",
            Self::DoorState { .. } => {
                "a closed or locked door has an opening of 0, a passage without leaves of 100"
            }

            Self::ReplicaOutside { .. } => "correct at, or move the replica to another area",
            Self::ReplicaThroughWall { .. } => "move the replica away from the wall",
            Self::ReplicaHeight { .. } => "correct the third number of at",
            Self::PlaceOutside { .. } => "correct at, or move the place to another area",
            Self::BadFootprint { .. } => {
                "list the corners of a convex outline counter-clockwise, [ahead, left] of the centre, in cm"
            }

            Self::NoEdits => {
                "describe what is new as in a map file, or a step: [[edit]] move = \"Chair 1\", to = [120, 80]"
            }
            Self::UnknownVerb { expected, .. } => {
                return format!("a step of an edit begins with one of these words: {expected}");
            }
            Self::AlreadyThere { .. } => {
                "give the new one another name; what is there is changed by steps [[edit]]: move, turn, set, rename, remove"
            }
            Self::StillUsed { .. } => "first remove what is named",
            Self::NotBound { .. } => "remove this step, or correct from",
            Self::NotLinked { .. } => "remove this step, or correct the ends of the link",
            Self::AreaNowhereYet { area } => {
                return format!(
                    "first make it stand: [[edit]] stand = \"{area}\", map = …, at = [x, y]"
                );
            }
            Self::ThingsOverlap { .. } => "move them apart: correct the `at` of one of them",
            Self::ThingHovers { .. } => {
                "correct the third coordinate of `at`, or put beneath the thing what it stands on"
            }
            Self::DoorwayBarred { .. } => {
                "move away from the doorway what is named, or correct the place of the door"
            }
            Self::PlaceUnder { .. } => "move the place to where the floor is free",
            Self::NamesNothing { .. } => "correct the name, or describe on the map what is named",
            Self::UnknownState { wanted, .. } => {
                return format!(
                    "write {}; what else is to be said of the state stands in a property of its own",
                    en(wanted)
                );
            }
            Self::UnknownTrait { known, .. } => {
                return format!(
                    "the traits are known: {known}; one of your own must stand in a rule file"
                );
            }
            Self::Metres { wanted, .. } => {
                return format!(
                    "lengths on a map are centimetres; if these are metres, write {wanted}"
                );
            }
            Self::MoreAlike { .. } => "mend what is shown, and check the map again",
            Self::OtherBuilding { .. } => {
                "a truth is the same building: doors open or locked, things moved, gone or new; where the building has changed, edit the map: ortho edit"
            }
            Self::Carried { .. } => {
                "leave out the edit of this thing, or begin anew: ortho do … --reset"
            }
            Self::BadZone { .. } => "mend the zone; how one is written: docs/map.md",
            Self::More { .. } => "mend what is shown, and check the map again",
        };
        told.to_owned()
    }
}

impl InEnglish for Fault {
    fn english(&self) -> String {
        self.error.english()
    }
    fn english_help(&self) -> Option<String> {
        Some(self.error.english_help())
    }
    fn english_labels(&self) -> [&'static str; 2] {
        ["here", "and here"]
    }
}

impl MapErrors {
    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishMapErrors<'_> {
        self.into()
    }
}

/// Faults of a map as English tells them.
#[derive(Debug, Clone)]
pub struct EnglishMapErrors<'f> {
    all: &'f MapErrors,
    faults: Vec<English<'f, Fault>>,
}

impl<'f> From<&'f MapErrors> for EnglishMapErrors<'f> {
    fn from(all: &'f MapErrors) -> Self {
        Self { all, faults: all.faults.iter().map(English).collect() }
    }
}

impl fmt::Display for EnglishMapErrors<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.all.source {
            Some(source) => write!(f, "map “{}”: ", source.name())?,
            None => write!(f, "map: ")?,
        }
        let some =
            |count: usize, what| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
        let (errors, warnings) = (self.all.errors().count(), self.all.warnings().count());
        write!(f, "{}, {}", some(errors, "error"), some(warnings, "warning"))
    }
}

impl std::error::Error for EnglishMapErrors<'_> {}

impl Diagnostic for EnglishMapErrors<'_> {
    fn severity(&self) -> Option<Severity> {
        self.all.severity()
    }
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.all.source_code()
    }
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.faults.iter().map(|fault| fault as _)))
    }
}
