//! The words under which the tables hold what the Map says otherwise.

use crate::map::{Case, DoorKind, DoorStatus, Face, Gender};

pub(super) const SYNONYM: &str = "synonym";
pub(super) const TRAIT: &str = "trait";

/// The words under which states and cases stand in the tables.
pub(super) const STATUSES: &[(DoorStatus, &str)] =
    &[(DoorStatus::Open, "open"), (DoorStatus::Closed, "closed"), (DoorStatus::Locked, "locked")];
pub(super) const DOOR_KINDS: &[(DoorKind, &str)] =
    &[(DoorKind::Hinged, "hinged"), (DoorKind::Sliding, "sliding"), (DoorKind::Passage, "passage")];
pub(super) const GENDERS: &[(Gender, &str)] =
    &[(Gender::Masculine, "m"), (Gender::Feminine, "f"), (Gender::Neuter, "n")];
pub(super) const CASES: &[(Case, &str)] = &[
    (Case::Nominative, "nom"),
    (Case::Genitive, "gen"),
    (Case::Dative, "dat"),
    (Case::Accusative, "acc"),
    (Case::Instrumental, "ins"),
    (Case::Prepositional, "loc"),
];

/// The words that stand for the kinds of zones.
pub(super) const KEEP_OUT: &str = "keep-out";
pub(super) const CLOSED: &str = "closed";
pub(super) const SLOW: &str = "slow";
pub(super) const ONE_WAY: &str = "one-way";

/// A face as `SideID` holds it; a side whose own name begins with `@` gets a second one.
pub(super) fn face_text(face: &Face) -> String {
    match face {
        Face::Base => "@base".into(),
        Face::Roof => "@roof".into(),
        Face::Side(id) if id.starts_with('@') => format!("@{id}"),
        Face::Side(id) => id.clone(),
    }
}

pub(super) fn face(text: &str) -> Option<Face> {
    match text {
        "@base" => Some(Face::Base),
        "@roof" => Some(Face::Roof),
        text => match text.strip_prefix('@') {
            Some(id) if id.starts_with('@') => Some(Face::Side(id.to_owned())),
            Some(_) => None,
            None => Some(Face::Side(text.to_owned())),
        },
    }
}
