//! The map file: [`World`] from and to a text that a person writes (TOML; YAML and JSON through the same types).
//!
//! Reading reports all faults at once, each at its line and character column. Writing loses nothing: what is
//! written reads as the same [`World`], ids included.

mod corners;
mod decode;
mod edit;
mod misprint;
mod node;
mod read;
mod records;
pub mod schema;
mod table;
mod text;
mod truth;
mod values;
mod words;
mod write;

use std::collections::HashSet;
use std::path::Path;

use miette::SourceSpan;

use self::node::{Node, Span, Value};
use self::read::{Draft, Origin};
use super::World;
use super::fault::{Fault, MapError, MapErrors, Record, Spot, Step};
use crate::units::{Bilingual, FileFault, InOrder as _, Source, said};

pub use edit::{Edit, EditReading, Edits, Naming, NewRecord, NextIds, RobotSaid, edit, kinds};
pub use schema::json_schema;
pub use truth::{Truth, read_truth};

/// Bytes. A text larger than this is no map: forty thousand replicas take some five megabytes.
const LIMIT: u64 = 64 << 20;
/// Faults reported before the rest is only counted.
const MOST_FAULTS: usize = 200;

/// The notation of a map file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    Toml,
    Yaml,
    Json,
}

impl Format {
    /// By the ending of the file's name; where that says nothing, JSON if the text begins as JSON does, else TOML.
    #[must_use]
    pub fn of_text(path: &Path, text: &str) -> Self {
        let told = path.extension().and_then(|e| e.to_str()).map(str::to_lowercase);
        match told.as_deref() {
            Some("yaml" | "yml" | "json" | "toml") => Self::of(path),
            _ if text.trim_start_matches('\u{FEFF}').trim_start().starts_with('{') => Self::Json,
            _ => Self::Toml,
        }
    }

    /// By the ending of the file's name; TOML when it says nothing.
    #[must_use]
    pub fn of(path: &Path) -> Self {
        match path.extension().and_then(|e| e.to_str()).map(str::to_lowercase).as_deref() {
            Some("yaml" | "yml") => Self::Yaml,
            Some("json") => Self::Json,
            _ => Self::Toml,
        }
    }
}

/// What came of reading a map: the world when nothing forbids its use, and every fault.
#[derive(Debug, Clone)]
pub struct Reading {
    /// Absent when there are errors; warnings do not hinder.
    pub world: Option<World>,
    pub faults: MapErrors,
}

/// Reads a map with all its faults, warnings included.
#[must_use]
pub fn read(source: &Source, format: Format) -> Reading {
    let text = source.text();
    let fail = |faults: Vec<Fault>| Reading { world: None, faults: report(source, faults) };
    if text.len() as u64 > LIMIT {
        let error = MapError::TooLarge { bytes: text.len() as u64, limit: LIMIT };
        return Reading { world: None, faults: MapErrors::of(error) };
    }
    let root = match node::parse(text, format) {
        Ok(root) => root,
        Err(misprints) => return fail(misprints.into_iter().map(Fault::from).collect()),
    };
    match &root.value {
        Value::Table(entries) if !entries.is_empty() => {}
        Value::Table(_) | Value::Nothing => {
            return fail(vec![Fault::new(MapError::Empty, Vec::new())]);
        }
        _ => {
            let expected = said!("a-table-with-a-field-format");
            let error = MapError::WrongKind { found: said!("a-value"), expected };
            return fail(vec![Fault::new(error, Vec::new())]);
        }
    }
    let Draft { world, mut faults, origins, broken, left_out } = read::build(&root);
    for mut fault in super::check::check_except(&world, &broken) {
        fault.locate(|record| origins.get(&record).cloned(), &left_out);
        faults.push(fault);
    }
    let faults = report(source, faults);
    Reading { world: (!faults.has_errors()).then_some(world), faults }
}

impl Step {
    fn name(&self) -> Option<&str> {
        match self {
            Self::Field(name) => Some(name),
            Self::Key(key) => Some(key),
            Self::Index(_) => None,
        }
    }
}

impl Fault {
    /// Finds the places in the text of the places in the model.
    fn locate<'n>(
        &mut self,
        origin: impl Fn(Record) -> Option<Origin<'n>>,
        left_out: &HashSet<Span>,
    ) {
        let place =
            |spot: &Spot| origin(spot.record).map(|o| SourceSpan::from(place(&o, spot, left_out)));
        self.spans = self.spots.iter().filter_map(place).collect();
    }
}

/// Reads a map file with all its faults, warnings included; its notation follows from its name.
#[must_use]
pub fn read_file(path: &Path) -> Reading {
    let fail = |error| Reading { world: None, faults: MapErrors::of(error) };
    match Source::read_within(path, LIMIT) {
        Ok(source) => read(&source, Format::of_text(path, source.text())),
        Err(FileFault::TooLarge { bytes, limit }) => fail(MapError::TooLarge { bytes, limit }),
        Err(fault) => {
            let path = path.to_string_lossy().into_owned();
            let message = Bilingual::from(&fault);
            fail(MapError::Unreadable { path, message })
        }
    }
}

/// Finds in the text that a map was read from the places of faults which were found in its world afterwards, and puts
/// them in the order of the text.
pub fn locate(source: &Source, format: Format, faults: &mut [Fault]) {
    let Ok(root) = node::parse(source.text(), format) else { return };
    let Draft { origins, left_out, .. } = read::build(&root);
    let origin = |record| origins.get(&record).cloned();
    faults.iter_mut().for_each(|fault| fault.locate(origin, &left_out));
    faults.order_by_key(|fault| fault.spans.first().map(|span| (span.offset(), span.len())));
}

/// The place in the text of a place in the model, or of the nearest thing around it that the text spells out.
fn place(origin: &Origin<'_>, spot: &Spot, left_out: &HashSet<Span>) -> Span {
    let mut node: &Node = origin.node;
    let mut span = &origin.name;
    let mut steps = spot.steps.iter().peekable();
    while let Some(step) = steps.next() {
        let inner = match step {
            // A base is written in one of several ways.
            Step::Field("base_vectors") => ["sides", "points", "rect", "regular"]
                .iter()
                .find_map(|way| node.entry(way).map(|entry| &entry.node)),
            Step::Field(name) => node.entry(name).map(|entry| &entry.node),
            Step::Key(key) => node.entry(key).map(|entry| &entry.node),
            Step::Index(index) => {
                node.elements().iter().filter(|e| !left_out.contains(&e.span)).nth(*index)
            }
        };
        let Some(inner) = inner else { break };
        if let (Value::Table(_), None) = (&inner.value, steps.peek())
            && let Some(name) = step.name()
            && let Some(entry) = node.entry(name)
        {
            // The name of a table says where it is; its extent may be pages.
            span = &entry.key_span;
        } else {
            span = &inner.span;
        }
        node = inner;
    }
    span.clone()
}

/// In the order of the text, without repetitions, at most [`MOST_FAULTS`].
fn report(source: &Source, mut faults: Vec<Fault>) -> MapErrors {
    faults.order_by_key(|fault| fault.spans.first().map(|span| (span.offset(), span.len())));
    faults.dedup();
    if faults.len() > MOST_FAULTS {
        let count = faults.len() - MOST_FAULTS;
        // Errors are kept before warnings, else a map could fail without a reason given.
        faults.order_by_key(Fault::is_warning);
        let hides_errors = !faults[MOST_FAULTS].is_warning();
        faults.truncate(MOST_FAULTS);
        if hides_errors {
            faults.push(Fault::new(MapError::More { count }, Vec::new()));
        }
    }
    MapErrors { source: Some(source.clone()), faults }
}

impl World {
    /// Reads a map file; its notation follows from its name.
    ///
    /// # Errors
    /// [`MapErrors`] with every fault of the file. Warnings alone are no error; [`read`] shows them.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, MapErrors> {
        let reading = read_file(path.as_ref());
        reading.world.ok_or(reading.faults)
    }

    /// Reads a map from a text.
    ///
    /// # Errors
    /// [`MapErrors`] with every fault of the text. Warnings alone are no error; [`read`] shows them.
    pub fn parse(source: &Source, format: Format) -> Result<Self, MapErrors> {
        let reading = read(source, format);
        reading.world.ok_or(reading.faults)
    }

    /// The map file of this world. Reading it gives the same world.
    ///
    /// # Panics
    /// When the world refers to what it does not hold; a checked world does not.
    #[must_use]
    pub fn to_toml(&self) -> String {
        write::to_toml(self)
    }
}
