//! Lifts and stairs of files that do not say which rooms they join: shafts that lie above one another.

use std::collections::{BTreeMap, BTreeSet};

use super::{Level, Lift, Room, Survey, outline};
use crate::units::Gather as _;

/// Words for rooms that lead to other storeys, and what they have in common.
const VERTICAL: [(&str, &str); 14] = [
    ("elevator", "lift"),
    ("lift", "lift"),
    ("лифт", "lift"),
    ("aufzug", "lift"),
    ("stairs", "stairs"),
    ("staircase", "stairs"),
    ("stair", "stairs"),
    ("steps", "stairs"),
    ("stairwell", "stairs"),
    ("treppe", "stairs"),
    ("лестница", "stairs"),
    ("escalator", "escalator"),
    ("эскалатор", "escalator"),
    ("ramp", "ramp"),
];
/// Shafts of one storey that are compared with one another.
const MOST_SHAFTS: usize = 2000;

/// What a room has in common with others that lead to other storeys: `stairs`.
pub(super) fn vertical(room: &Room) -> Option<&'static str> {
    let kind = room.kind.to_lowercase();
    kind.split(|c: char| !c.is_alphanumeric())
        .find_map(|word| VERTICAL.iter().find(|(v, _)| word == *v).map(|(_, what)| *what))
}

/// Adds a [`Lift`] for every pile of shafts of one sort on successive storeys, of which one lies above the middle of
/// the other. What is joined already is left as it is.
pub(super) fn join(survey: &mut Survey) {
    let joined: BTreeSet<(usize, usize)> =
        survey.lifts.iter().flat_map(|l| l.stops.iter().copied()).gather();
    let of_level = |(level, l): (usize, &Level)| {
        let shafts = l.rooms.iter().enumerate().filter_map(|(no, room)| {
            Some((level, no, vertical(room).filter(|_| !joined.contains(&(level, no)))?))
        });
        shafts.take(MOST_SHAFTS).collect::<Vec<_>>()
    };
    let shafts: Vec<Vec<_>> = survey.levels.iter().enumerate().map(of_level).collect();
    // The lift that serves a shaft so far, by the shaft on its highest storey.
    let mut open = BTreeMap::<(usize, usize), usize>::new();
    let mut found: Vec<Lift> = Vec::new();
    for storeys in shafts.windows(2) {
        for &(level, no, what) in &storeys[1] {
            let here = &survey.levels[level].rooms[no];
            let below = storeys[0].iter().find(|&&(below, other, kind)| {
                let there = &survey.levels[below].rooms[other];
                let over =
                    |a: &Room, b: &Room| outline::contains(&a.outline, outline::middle(&b.outline));
                kind == what && (over(here, there) || over(there, here))
            });
            let Some(&(below, other, _)) = below else { continue };
            let lift = open.remove(&(below, other)).unwrap_or_else(|| {
                let room = &survey.levels[below].rooms[other];
                let (source, name) = (room.source.clone(), room.name.clone());
                found.push(Lift { source, name, stops: vec![(below, other)], is_told: true });
                found.len() - 1
            });
            found[lift].stops.push((level, no));
            open.insert((level, no), lift);
        }
    }
    survey.lifts.append(&mut found);
}
