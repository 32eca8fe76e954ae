//! A position in Russian: «в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z».

use super::{Beside, Doorway, Facing, Mark, Named, Opening, Position, Spot};
use crate::words::russian::{self, Preposition};
use crate::words::{Case, Gender, NounPhrase, Number, WordHints};

impl Position {
    pub(super) fn russian(&self, spot: Option<&Spot>) -> String {
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
                // «в Ванной, стоя на Ковре-1»: what one does besides is set off.
                let is_set_off = *beside == Beside::On && !at.ends_with(',');
                let at = if is_set_off { at + "," } else { at };
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
}

impl Doorway {
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
}

impl Facing {
    /// «лицом к двери, ведущей …», «лицом к ней» where the spot has told it.
    pub(super) fn russian(&self, spot: Option<&Spot>) -> String {
        let told = self.is_told(spot);
        match self {
            Self::Door(door) if told => format!("лицом к {}", door.pronoun()),
            Self::Door(door) => format!("лицом к {}", door.russian(Case::Dative)),
            Self::Leaf(door) => format!("лицом к створке {}", door.russian(Case::Genitive)),
            Self::Object(object) if told => format!("лицом к {}", pronoun(&object.russian)),
            Self::Object(object) => {
                format!("лицом {}", russian::with(Preposition::K, Case::Dative, &object.russian))
            }
            Self::OwnWall if told => "лицом к ней".into(),
            Self::Wall | Self::OwnWall => "лицом к стене".into(),
            Self::OtherWall => "лицом к другой стене".into(),
            Self::Inward => "лицом к свободному месту".into(),
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

fn beside_in_russian(beside: Beside, object: &NounPhrase) -> String {
    match beside {
        Beside::On => {
            format!("стоя {}", russian::with(Preposition::Na, Case::Prepositional, object))
        }
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

/// «к ней», «к нему», «к ним»
fn pronoun(name: &NounPhrase) -> &'static str {
    match (name.number(), name.gender()) {
        (Number::Plural, _) => "ним",
        (_, Gender::Feminine) => "ней",
        _ => "нему",
    }
}
