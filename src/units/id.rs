//! Ids of the paper's tables (paper 2). Each table has a type of its own, so that none is taken for another.

use serde::{Deserialize, Serialize};

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident),+ $(,)?) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        #[serde(transparent)]
        pub struct $name(pub u32);
    )+};
}

ids! {
    /// `OrFr.ID`
    OrFrId,
    /// `Object.ID`: a kind of chair.
    ObjectId,
    /// `AreaObjects.ReplID`: one placed chair; unique over all Areas.
    ReplicaId,
    /// `Area.ID`
    AreaId,
    /// A named place to stand; beyond the paper's tables.
    PlaceId,
    /// `Map.ID`
    MapId,
    /// `Domain.ID`
    DomainId,
    /// `Door.ID`
    DoorId,
    /// A door or passage between Areas: numbered when a building is measured, the same as long as its walls and doors are.
    OpeningId,
    /// `ID` of one of the …TypeList tables.
    TypeId,
    /// A region of the floor with a rule of its own; beyond the paper's tables.
    ZoneId,
}
