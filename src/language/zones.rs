//! Zones in words: what one forbids, why, and until when.

use super::names::named;
use super::report::Named;
use super::words::russian;
use super::words::{Case, Gender, Language, Number};
use crate::map::{Entity, World, ZoneKind};
use crate::units::{Lengths, Timestamp, ZoneId};

/// «Зона-1 закрыта до 2026-11-26 18:00 UTC: мокрый пол», "Zone 1 is closed until 2026-11-26 18:00 UTC: the floor is wet"; of
/// a zone that is not in force yet, since when it will be.
///
/// # Panics
/// When the zone is not of this world.
#[must_use]
pub fn zone_in_words(world: &World, id: ZoneId, language: Language) -> String {
    let zone = &world.zones[&id];
    let name = named(world, Entity::Zone(id));
    let is_russian = language == Language::Russian;
    let form = |case| name.form(case, language);
    let rule = match (zone.kind, is_russian) {
        (ZoneKind::Closed, true) => format!("{} {}", form(Case::Nominative), closed(&name)),
        (ZoneKind::Closed, false) => format!("{} is closed", name.english()),
        (ZoneKind::KeepOut, true) => format!("в {} роботу нельзя", form(Case::Accusative)),
        (ZoneKind::KeepOut, false) => format!("the robot may not enter {}", name.english()),
        (ZoneKind::Slow { speed }, true) => {
            let place = russian::where_at(name.phrase());
            let speed = Lengths::said().told_speed(speed, 1, language);
            format!("{place} можно ехать не быстрее {speed}")
        }
        (ZoneKind::Slow { speed }, false) => {
            let speed = Lengths::said().told_speed(speed, 1, language);
            format!("in {} the robot may drive no faster than {speed}", name.english())
        }
        (ZoneKind::OneWay { heading }, true) => {
            let heading = number(heading.get(), true);
            format!("через {} можно проехать только курсом {heading}°", form(Case::Accusative))
        }
        (ZoneKind::OneWay { heading }, false) => {
            let heading = number(heading.get(), false);
            format!("{} may be crossed only with a heading of {heading}°", name.english())
        }
    };
    let mut told = rule;
    for (moment, ru, en) in [(zone.from, "с", "from"), (zone.until, "до", "until")] {
        if let Some(moment) = moment {
            told += &format!(" {} {}", language.pick(ru, en), when(moment));
        }
    }
    match reason(world, id, language) {
        "" => told,
        reason => format!("{told}: {reason}"),
    }
}

/// Why a zone is as it is, in the language if somebody said it there, else in the other; empty where nobody did.
///
/// # Panics
/// When the zone is not of this world.
#[must_use]
pub fn reason(world: &World, id: ZoneId, language: Language) -> &str {
    let zone = &world.zones[&id];
    let (own, other) = match language {
        Language::Russian => (&zone.reason, &zone.reason_en),
        Language::English => (&zone.reason_en, &zone.reason),
    };
    if own.is_empty() { other } else { own }
}

/// A moment as people write it, to the minute where it is a whole one.
#[must_use]
pub fn when(moment: Timestamp) -> String {
    moment.in_words().replace(":00 UTC", " UTC")
}

fn number(value: f64, is_russian: bool) -> String {
    let text = format!("{:.1}", value).trim_end_matches('0').trim_end_matches('.').to_owned();
    if is_russian { text.replace('.', ",") } else { text }
}

fn closed(name: &Named) -> &'static str {
    match (name.phrase().number(), name.phrase().gender()) {
        (Number::Plural, _) => "закрыты",
        (_, Gender::Feminine) => "закрыта",
        (_, Gender::Neuter) => "закрыто",
        (_, Gender::Masculine) => "закрыт",
    }
}
