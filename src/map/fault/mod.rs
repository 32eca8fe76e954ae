//! What can be wrong with a map, and where: [`MapError`], the [`Spot`] in the model, and [`MapErrors`], all of a file.
//!
//! A fault knows its place as a path into the model; the reader of a file turns that into a place in the text.

use std::fmt;

use miette::{
    Diagnostic, LabeledSpan, MietteError, Severity, SourceCode, SourceSpan, SpanContents,
};

use crate::units::{
    Bilingual, Cm, EnglishGroup, Fault as _, InEnglish, Language, Piece, Source, here, told, word,
};

mod spot;

pub use spot::{Record, Spot, Step};

pub(super) const COORDINATE: Piece = word!("a-coordinate");
pub(super) const WITHIN: Piece = word!("within-100-km");
pub(super) const MORE_THAN_0: Piece = word!("more-than-0");

/// A map that cannot be read, or that contradicts itself. Points are `(x, y)` in cm.
#[derive(Debug, Clone, PartialEq, crate::units::Fault)]
#[fault(map)]
#[non_exhaustive]
pub enum MapError {
    /// The file cannot be opened or is no text.
    Unreadable { path: String, message: Bilingual },

    /// Larger than any building needs.
    TooLarge { bytes: u64, limit: u64 },

    /// Nothing but blanks and comments.
    Empty,

    /// The notation itself is broken.
    Syntax { format: &'static str, message: Bilingual },

    /// Written for another version.
    Format { found: String },

    /// A key that the format does not have.
    UnknownField { field: String, nearest: Option<String>, expected: String },

    /// A key that the format requires.
    MissingField { field: &'static str },

    /// A text where a number belongs, and the like.
    WrongKind { found: Bilingual, expected: Bilingual },

    /// None of the words that may stand here.
    UnknownWord { word: String, nearest: Option<String>, expected: String },

    /// A value of the right kind that makes no sense.
    BadValue { message: Bilingual },

    /// A number out of its range.
    OutOfRange { what: Bilingual, value: f64, range: Bilingual },

    /// A name that nothing bears.
    UnknownReference { what: Bilingual, name: String, nearest: Option<String> },

    /// A name that several things bear, or that could be read in several ways.
    AmbiguousName { name: String, candidates: String },

    /// "A.roof" and its like, misspelt.
    BadReference { text: String, wanted: Bilingual },

    /// Two records of one kind with one id.
    DuplicateId { what: Bilingual, id: u32 },

    /// An id from another world.
    DanglingId { owner: Bilingual, what: Bilingual, id: u32 },

    /// One name for two things.
    DuplicateName { name: String, other: String, first: Bilingual, second: Bilingual },

    /// A record without a name.
    NoName { what: Bilingual },

    /// A handle that references could not tell from something else.
    BadId { owner: Bilingual, id: String },

    /// Two parts or sides with one id.
    DuplicatePart { owner: Bilingual, id: String },

    /// A zone that is none: nowhere, never, or with an outline that crosses itself.
    BadZone { owner: Bilingual, message: Bilingual },

    /// None or several of the ways to give a base.
    BaseForm { name: String, count: usize },

    /// Fewer than three vectors.
    BaseTooShort { name: String, count: usize },

    /// A vector of no length.
    BaseZeroLength { name: String, side: String, at: String },

    /// A vector does not begin where the one before it ends.
    BaseNotConnected { name: String, side: String, end: String, next: String, start: String },

    /// The last vector does not return to the first.
    BaseNotClosed { name: String, side: String, end: String, next: String, start: String },

    /// Two vectors cross or touch.
    BaseCrossesItself { name: String, side: String, other: String, at: String },

    /// Clockwise.
    BaseClockwise { name: String },

    /// All corners on one line.
    BaseNoArea { name: String },

    /// Below the ground.
    NegativeHeight { name: String, height: Cm },

    /// Nothing in it.
    NoItems { owner: Bilingual },

    /// None or several base items.
    BaseItemCount { owner: Bilingual, count: usize },

    /// The base item stands off the origin.
    BaseItemOffOrigin { owner: Bilingual, item: String, nearest: String },

    /// An id of an item that the group does not have.
    UnknownItem { owner: Bilingual, item: String, known: String },

    /// An id of a side that the Orthoframe does not have.
    UnknownSide { owner: Bilingual, item: String, side: String, known: String },

    /// A horizontal face bound to a vertical one.
    LinkFaces { owner: Bilingual, link: String },

    /// A link and the positions say different things.
    LinkContradicts { owner: Bilingual, link: String, claimed: Bilingual, found: Bilingual },

    /// A passage bound to a narrower one.
    LinkLength { owner: Bilingual, link: String, length: Cm, other: Cm },

    /// A door bound to a wall.
    LinkPermeability { owner: Bilingual, link: String },

    /// A passage that does not lie on the passage that it is bound to.
    LinkApart { owner: Bilingual, link: String, distance: Cm },

    /// Two parts of an Area, or two solid parts of an Object, lie in one another.
    ItemsOverlap { owner: Bilingual, item: String, other: String, at: String },

    /// A part that nothing holds.
    ItemsApart { owner: Bilingual, item: String },

    /// Two rooms in one place.
    AreasOverlap { map: Bilingual, area: String, other: String, at: String },

    /// A room bound to no other.
    AreasApart { map: Bilingual, area: String },

    /// A room that stands in two places.
    AreaTwice { area: String },

    /// A room that stands nowhere.
    #[fault(warning)]
    AreaNowhere { area: String },

    /// A floor that the building does not hold, or holds twice.
    DomainMaps { map: String, count: usize },

    /// A lift within one floor.
    LiftStops { lift: String },

    /// A door in a solid wall, or leaves in an open passage.
    DoorOnWrongSide { owner: Bilingual, door: String, side: String, why: Bilingual },

    /// A doorway in which no door hangs.
    SideWithoutDoor { owner: Bilingual, side: String },

    /// Two doors in one doorway.
    SideTwoDoors { owner: Bilingual, side: String },

    /// A door that does not fit.
    DoorTooWide { owner: Bilingual, door: String, width: Cm, side: String, length: Cm },

    /// A door higher than its wall.
    DoorTooHigh { owner: Bilingual, door: String, height: Cm, side: String, wall: Cm },

    /// A door that hangs nowhere.
    #[fault(warning)]
    DoorUnused { door: String },

    /// A door between three rooms.
    DoorMounts { door: String, count: usize },

    /// The two sides of a door lie apart.
    DoorApart { door: String, side: String, other: String },

    /// Leaves that open into both rooms, or into none.
    DoorDirection { door: String, way: Bilingual },

    /// No leaves, or leaves in a passage.
    DoorLeaves { door: String, why: Bilingual },

    /// Leaves that do not fill the door.
    LeafShares { door: String, sum: f64 },

    /// A passage that is closed, a closed door that stands open.
    DoorState { door: String, opening: f64, status: Bilingual },

    /// A thing that stands in another room.
    ReplicaOutside { replica: String, area: String, at: String },

    /// A thing that sticks through a wall.
    #[fault(warning)]
    ReplicaThroughWall { replica: String, area: String, by: Cm, at: String },

    /// A thing above the ceiling or below the floor.
    #[fault(warning)]
    ReplicaHeight { replica: String, area: String, bottom: Cm, top: Cm, floor: Cm, ceiling: Cm },

    /// A place in another room.
    PlaceOutside { place: String, area: String },

    /// A robot's footprint that is no convex polygon round its centre, or that its radius does not cover.
    BadFootprint { reason: Bilingual },

    /// Two solid things in one place.
    #[fault(warning)]
    ThingsOverlap { thing: String, other: String, at: String },

    /// A thing that nothing holds.
    #[fault(warning)]
    ThingHovers { thing: String, over: Bilingual, height: Cm },

    /// Things that leave too little of a doorway.
    #[fault(warning)]
    DoorwayBarred { door: String, things: Bilingual, free: Cm, width: Cm },

    /// A place where the robot cannot stand.
    #[fault(warning)]
    PlaceUnder { place: String, thing: String },

    /// A property that must name something of the map and names nothing.
    #[fault(warning)]
    NamesNothing { property: String, what: Bilingual, name: String, nearest: Option<String> },

    /// A state that the program does not understand.
    #[fault(warning)]
    UnknownState { property: String, value: String, wanted: Bilingual },

    /// A trait that neither the program nor a rule reads.
    #[fault(warning)]
    UnknownTrait { owner: String, word: String, nearest: Option<String>, known: String },

    /// A size that fits if it is taken for metres.
    #[fault(warning)]
    Metres { what: Bilingual, size: String, wanted: String },

    /// The rest of the warnings of one sort.
    #[fault(warning)]
    MoreAlike { count: usize, kind: String },

    /// An edit file that says nothing.
    NoEdits,

    /// A step of an edit file that does nothing that is known.
    UnknownVerb { found: String, nearest: Option<String>, expected: String },

    /// A new record under a name that is taken.
    AlreadyThere { what: Bilingual, name: String },

    /// Something is to be removed that other things are made of, or stand by.
    StillUsed { what: Bilingual, name: String, by: Bilingual },

    /// A door that hangs nowhere, or not there.
    NotBound { door: String },

    /// A link that is not there.
    NotLinked { link: String },

    /// A link of a room that stands on no map.
    AreaNowhereYet { area: String },

    /// A truth in which another building stands than the one that the robot knows.
    OtherBuilding { what: Bilingual, how: Bilingual },

    /// A truth that moves what the robot holds, or a person from it.
    Carried { name: String },

    /// More faults than anyone reads.
    More { count: usize },
}

/// One fault with its places: in the model, and in the text when it was read from one.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    pub error: MapError,
    /// The first is where to look; a contradiction names a second.
    pub spots: Vec<Spot>,
    /// Bytes of the text, likewise.
    pub spans: Vec<SourceSpan>,
}

impl Fault {
    pub(super) fn new(error: MapError, spots: Vec<Spot>) -> Self {
        Self { error, spots, spans: Vec::new() }
    }

    /// A warning lets the map be used.
    #[must_use]
    pub fn is_warning(&self) -> bool {
        self.error.is_warning()
    }
}

impl InEnglish for Fault {
    fn english(&self) -> String {
        self.error.english()
    }
    fn english_help(&self) -> Option<String> {
        self.error.english_help()
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt(f)
    }
}

impl std::error::Error for Fault {}

impl Diagnostic for Fault {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.error.code()
    }
    fn severity(&self) -> Option<Severity> {
        self.error.severity()
    }
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.error.help()
    }
    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = |(i, span): (usize, &SourceSpan)| {
            LabeledSpan::new_with_span(Some(here(i, Language::Russian)), *span)
        };
        (!self.spans.is_empty()).then(|| Box::new(self.spans.iter().enumerate().map(label)) as _)
    }
}

/// Every fault of a map file, with the file.
#[derive(Debug, Clone)]
pub struct MapErrors {
    pub source: Option<Source>,
    /// Errors and warnings, in the order of the text.
    pub faults: Vec<Fault>,
}

impl MapErrors {
    pub fn of(error: MapError) -> Self {
        Self { source: None, faults: vec![Fault::new(error, Vec::new())] }
    }

    pub fn errors(&self) -> impl Iterator<Item = &Fault> + '_ {
        self.faults.iter().filter(|fault| !fault.is_warning())
    }

    pub fn warnings(&self) -> impl Iterator<Item = &Fault> + '_ {
        self.faults.iter().filter(|fault| fault.is_warning())
    }

    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.errors().next().is_some()
    }

    /// Line and character column of a fault's first place, from 1.
    #[must_use]
    pub fn position(&self, fault: &Fault) -> Option<(usize, usize)> {
        Some(self.source.as_ref()?.position(fault.spans.first()?.offset()))
    }
}

impl MapErrors {
    /// How many there are, in a line.
    fn told(&self, language: Language) -> String {
        let (errors, warnings) = (self.errors().count(), self.warnings().count());
        match &self.source {
            Some(source) => {
                told!(language, "map-faults", name = source.name(), errors, warnings)
            }
            None => told!(language, "map-nameless-faults", errors, warnings),
        }
    }

    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishGroup<'_> {
        EnglishGroup::new(self, self.told(Language::English), &self.faults)
    }
}

impl InEnglish for MapErrors {
    fn english(&self) -> String {
        self.told(Language::English)
    }
    fn english_help(&self) -> Option<String> {
        None
    }
}

impl fmt::Display for MapErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told(Language::Russian))
    }
}

impl std::error::Error for MapErrors {}

/// The text, for excerpts beside the faults.
impl SourceCode for MapErrors {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let source = self.source.as_ref().ok_or(MietteError::OutOfBounds)?;
        source.read_span(span, lines_before, lines_after)
    }
}

impl Diagnostic for MapErrors {
    fn severity(&self) -> Option<Severity> {
        Some(if self.has_errors() { Severity::Error } else { Severity::Warning })
    }
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|_| self as _)
    }
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.faults.iter().map(|fault| fault as _)))
    }
}
