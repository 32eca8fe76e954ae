//! A position in English: "in Room V at the door leading from Room V to Room Z".

use super::{Beside, Doorway, Facing, Mark, Named, Opening, Position, Spot};
use crate::words::PlaceSense::{Inside, Upon};

impl Position {
    pub(super) fn english(&self, spot: Option<&Spot>) -> String {
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
                let comma = if *beside == Beside::On { "," } else { "" };
                format!("{at}{comma} {} {}", beside_in_english(*beside), object.english())
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

impl Named {
    /// "in the corridor", but "on the balcony".
    pub(crate) fn english_place(&self) -> String {
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

impl Doorway {
    fn english(&self) -> String {
        let opening = self.opening;
        let noun = match &self.name {
            Some(name) => name.english_door(opening),
            None => opening.english().to_owned(),
        };
        match &self.to {
            Some(to) => format!("{noun} leading from {} to {}", self.from.english(), to.english()),
            None => format!("{noun} leading out of {}", self.from.english()),
        }
    }
}

impl Mark {
    fn english(&self) -> String {
        match self {
            Self::Adjoining(room) => format!(" adjoining {}", room.english()),
            Self::With(thing) => format!(" with {}", thing.english()),
        }
    }
}

impl Facing {
    pub(super) fn english(&self, spot: Option<&Spot>) -> String {
        match self {
            _ if self.is_told(spot) => "facing it".into(),
            Self::Door(door) => format!("facing {}", door.english()),
            Self::Leaf(door) => format!("facing a leaf of {}", door.english()),
            Self::Object(object) => format!("facing {}", object.english()),
            Self::Wall | Self::OwnWall => "facing the wall".into(),
            Self::OtherWall => "facing another wall".into(),
            Self::Inward => "facing free space".into(),
        }
    }
}

fn doorway_in_english(door: &Doorway) -> String {
    let opening = match (&door.name, door.opening) {
        (Some(name), opening) => format!("in the doorway of {}", name.english_door(opening)),
        (None, Opening::Door) => "in the doorway".into(),
        (None, Opening::Passage) => "in the passage".into(),
    };
    match &door.to {
        Some(to) => format!("{opening} between {} and {}", door.from.english(), to.english()),
        None => format!("{opening} leading out of {}", door.from.english()),
    }
}

fn beside_in_english(beside: Beside) -> &'static str {
    match beside {
        Beside::On => "standing on",
        Beside::NextTo => "next to",
        Beside::InFrontOf => "in front of",
        Beside::Behind => "behind",
        Beside::LeftOf => "to the left of",
        Beside::RightOf => "to the right of",
    }
}
