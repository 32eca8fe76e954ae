//! What a name in an edit may stand for.

use crate::World;
use crate::fault::Record;
use crate::units::InOrder as _;
use crate::units::{Piece, word};

/// The kinds of records that bear names. The order is that in which a name is understood that several kinds bear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Kind {
    Replica,
    Area,
    Door,
    Place,
    Map,
    Zone,
    Object,
    Orthoframe,
}

/// The words by which an edit tells kinds of things apart that bear one name.
#[must_use]
pub fn kinds() -> [&'static str; 8] {
    Kind::ALL.map(Kind::word)
}

impl Kind {
    pub(super) const ALL: [Self; 8] = [
        Self::Replica,
        Self::Area,
        Self::Door,
        Self::Place,
        Self::Map,
        Self::Zone,
        Self::Object,
        Self::Orthoframe,
    ];

    /// How an edit file names the kind, and the section of a map file where its records stand.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Replica => "replica",
            Self::Area => "area",
            Self::Door => "door",
            Self::Place => "place",
            Self::Map => "map",
            Self::Zone => "zone",
            Self::Object => "object",
            Self::Orthoframe => "orthoframe",
        }
    }

    pub(super) fn title(self) -> Piece {
        match self {
            Self::Replica => word!("replica-title"),
            Self::Area => word!("area-title"),
            Self::Door => word!("door"),
            Self::Place => word!("place-title"),
            Self::Map => word!("map"),
            Self::Zone => word!("zone-title"),
            Self::Object => word!("object-title"),
            Self::Orthoframe => word!("orthoframe"),
        }
    }

    /// The kind within a sentence.
    pub(super) fn noun(self) -> Piece {
        match self {
            Self::Replica => word!("replica"),
            Self::Area => word!("area"),
            Self::Door => word!("door-2"),
            Self::Place => word!("place"),
            Self::Map => word!("map-2"),
            Self::Zone => word!("zone"),
            Self::Object => word!("object"),
            Self::Orthoframe => word!("orthoframe-title"),
        }
    }

    /// Whether a file writes the records as lines of an Area: they have names and no keys.
    pub(super) fn is_line(self) -> bool {
        matches!(self, Self::Replica | Self::Place)
    }

    pub(super) fn of(record: Record) -> Option<Self> {
        Some(match record {
            Record::Replica(_) => Self::Replica,
            Record::Area(_) => Self::Area,
            Record::Door(_) => Self::Door,
            Record::Place(_) => Self::Place,
            Record::Map(_) => Self::Map,
            Record::Zone(_) => Self::Zone,
            Record::Object(_) => Self::Object,
            Record::Orthoframe(_) => Self::Orthoframe,
            Record::Domain | Record::Robot | Record::Type(..) => return None,
        })
    }

    /// Every record of the kind in the order of a map file: those with keys by their ids, lines Area after Area.
    pub(super) fn records(self, world: &World) -> Vec<Record> {
        macro_rules! all {
            ($records:ident, $record:ident) => {
                world.$records.keys().map(|id| Record::$record(*id)).collect()
            };
            ($records:ident, $record:ident by area) => {{
                let mut all: Vec<_> = world.$records.values().map(|r| (r.area, r.id)).collect();
                all.order();
                all.into_iter().map(|(_, id)| Record::$record(id)).collect()
            }};
        }
        match self {
            Self::Replica => all!(replicas, Replica by area),
            Self::Area => all!(areas, Area),
            Self::Door => all!(doors, Door),
            Self::Place => all!(places, Place by area),
            Self::Map => all!(maps, Map),
            Self::Zone => all!(zones, Zone),
            Self::Object => all!(objects, Object),
            Self::Orthoframe => all!(orthoframes, Orthoframe),
        }
    }
}

/// The key of a record and its two names; the key of a line is its name.
pub(super) fn names_of(world: &World, record: Record) -> Option<[&str; 3]> {
    macro_rules! keyed {
        ($records:ident, $id:expr) => {{
            let record = world.$records.get(&$id)?;
            Some([&record.key, &record.name, &record.name_en])
        }};
    }
    macro_rules! line {
        ($records:ident, $id:expr) => {{
            let record = world.$records.get(&$id)?;
            Some([&record.name, &record.name, &record.name_en])
        }};
    }
    match record {
        Record::Replica(id) => line!(replicas, id),
        Record::Place(id) => line!(places, id),
        Record::Area(id) => keyed!(areas, id),
        Record::Door(id) => keyed!(doors, id),
        Record::Map(id) => keyed!(maps, id),
        Record::Zone(id) => keyed!(zones, id),
        Record::Object(id) => keyed!(objects, id),
        Record::Orthoframe(id) => keyed!(orthoframes, id),
        Record::Domain | Record::Robot | Record::Type(..) => None,
    }
}
