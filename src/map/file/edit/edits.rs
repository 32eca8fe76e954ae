//! A list of edits, made of values or read from a text: each with the place where it is told.

use std::collections::HashSet;

use serde::Deserialize;

use super::super::decode::{NUMBER, TABLE, decode};
use super::super::node::{self, Entry, Misprint, Node, Span, Value};
use super::super::schema::FORMAT;
use super::super::{Format, LIMIT};
use super::kind::Kind;
use super::verbs::{self, Edit, NewRecord, RobotSaid};
use super::word::{Done, Slips, misprint, text_of, unknown_field, wrong_kind};
use crate::TypeKind;
use crate::fault::MapError;
use crate::units::{OwnText, Source, name_key, said, word};

/// Edits that make one transaction.
///
/// A text of edits is read into the same values that a program makes; either is worked into the map by
/// [`edit`](super::edit()). The faults of a text are kept until then and told with those of the map that it would make.
#[derive(Debug, Clone)]
pub struct Edits {
    pub(super) told: Vec<Told>,
    pub(super) source: Source,
    pub(super) reason: Option<String>,
    pub(super) misprints: Vec<Misprint>,
    /// Entries and lines that could not be read.
    pub(super) left_out: HashSet<Span>,
    /// Names of what is new and could not be read, as they are compared: that they lead nowhere is no second fault.
    pub(super) unread: HashSet<String>,
    /// Whether it is worth looking at what the map would become.
    pub(super) is_read: bool,
    /// Whether there is nothing but one step, which answers for all that it spoils elsewhere.
    pub(super) is_one_step: bool,
}

/// An edit with its place.
#[derive(Debug, Clone)]
pub(super) struct Told {
    pub(super) edit: Edit,
    /// The place of the verb, or of the key of what is new.
    pub(super) key_span: Span,
    /// The table of the step, or of what is new.
    pub(super) node: Node,
    /// Whether something of it could not be read.
    pub(super) is_broken: bool,
}

impl Edits {
    /// The edits, without those that could not be read.
    pub fn values(&self) -> impl Iterator<Item = &Edit> {
        self.told.iter().map(|told| &told.edit)
    }

    /// Whether all that stands in the text could be read.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.misprints.is_empty()
    }

    /// The same, told in a text of this name where something is at fault.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        self.source = Source::new(name, self.source.text());
        self
    }

    /// The place of the only step, if there is nothing but one: what it spoils elsewhere is told there.
    pub(super) fn only_step(&self) -> Option<Span> {
        let [only] = &self.told[..] else { return None };
        let verb = only.node.entry(only.edit.verb().filter(|_| self.is_one_step)?)?;
        Some(verb.key_span.start..verb.node.span.end.max(verb.key_span.end))
    }

    /// Reads a text of edits: the sections of a map file for what is new, and a list of steps for all else.
    #[must_use]
    pub fn read(source: &Source, format: Format) -> Self {
        let mut edits = Self::of_source(source.clone());
        let refuse = |mut edits: Self, misprints: Vec<Misprint>| {
            edits.is_read = false;
            edits.misprints = misprints;
            edits
        };
        let text = source.text();
        if text.len() as u64 > LIMIT {
            let error = MapError::TooLarge { bytes: text.len() as u64, limit: LIMIT };
            return refuse(edits, vec![Misprint { error, span: None }]);
        }
        let root = match node::parse(text, format) {
            Ok(root) => root,
            Err(misprints) => return refuse(edits, misprints),
        };
        if !matches!(&root.value, Value::Table(entries) if !entries.is_empty()) {
            return refuse(edits, vec![Misprint { error: MapError::NoEdits, span: None }]);
        }
        edits.take(&root);
        edits
    }

    fn of_source(source: Source) -> Self {
        Self {
            told: Vec::new(),
            source,
            reason: None,
            misprints: Vec::new(),
            left_out: HashSet::new(),
            unread: HashSet::new(),
            is_read: true,
            is_one_step: false,
        }
    }

    /// Takes a whole file: what is new first, then the steps in their order.
    fn take(&mut self, root: &Node) {
        let Self { told, misprints, left_out, unread, reason, .. } = self;
        let mut reading = Reading { told, unread, slips: Slips { misprints, left_out } };
        for entry in root.entries() {
            let done = match entry.key.as_str() {
                "format" => check_format(&entry.node),
                "reason" => text_of(&entry.node).map(|r| *reason = Some(r.to_owned())),
                "edit" => Ok(()),
                "type" => reading.types(&entry.node),
                "robot" => reading.robot(entry),
                other => match Kind::ALL.into_iter().find(|k| !k.is_line() && k.word() == other) {
                    Some(kind) => reading.section(kind, entry),
                    None => Err(unknown_field(entry, &SECTIONS)),
                },
            };
            reading.slips.misprints.extend(done.err().map(|fault| *fault));
        }
        let Some(list) = root.entry("edit") else { return };
        if !matches!(list.node.value, Value::List(_)) {
            let wanted = word!("a-list-of-steps-edit");
            reading.slips.misprints.push(*wrong_kind(&list.node, wanted));
        }
        let steps = list.node.elements();
        steps.iter().for_each(|node| reading.step(node));
        let is_beside = |e: &Entry| ["edit", "reason", "format"].contains(&e.key.as_str());
        self.is_one_step = steps.len() == 1 && root.entries().iter().all(is_beside);
    }
}

/// Edits made by a program. Each is written as a text would tell it, for the faults that are told there.
impl From<Vec<Edit>> for Edits {
    fn from(values: Vec<Edit>) -> Self {
        let (mut text, mut told, mut misprints) = (String::new(), Vec::new(), Vec::new());
        let is_one_step = values.len() == 1 && values[0].verb().is_some();
        for edit in values {
            let piece = edit.text();
            let by = text.len();
            text.push_str(&piece);
            match node::parse(&piece, Format::Toml) {
                Ok(mut root) => {
                    root.displace(by);
                    told.push(Told::of_piece(edit, &root));
                }
                // A table that has one key twice cannot be written.
                Err(found) => misprints.extend(found.into_iter().map(|found| Misprint {
                    span: found.span.map(|span| span.start + by..span.end + by),
                    ..found
                })),
            }
        }
        Self { told, misprints, is_one_step, ..Self::of_source(Source::own(OwnText::Edit, text)) }
    }
}

impl Told {
    /// An edit that stands alone in a piece of a text.
    fn of_piece(edit: Edit, root: &Node) -> Self {
        let section = root.entries().first().expect("an edit is told in a section");
        let (key_span, node) = match (&edit, edit.verb()) {
            (_, Some(verb)) => {
                let node = section.node.elements().first().expect("the list of steps has one");
                (node.entry(verb).expect("a step has its verb").key_span.clone(), node)
            }
            (Edit::Robot(_), _) => (section.key_span.clone(), &section.node),
            (Edit::New(new), _) => {
                let record = section.node.entries().first().expect("a section has its record");
                match **new {
                    NewRecord::Type(..) => {
                        let line = record.node.elements().first().expect("the list has its type");
                        (line.span.clone(), line)
                    }
                    _ => (record.key_span.clone(), &record.node),
                }
            }
            _ => unreachable!("all others have a verb"),
        };
        Self { key_span, node: node.clone(), edit, is_broken: false }
    }
}

impl Node {
    /// Moves every place in the text by so many bytes.
    fn displace(&mut self, by: usize) {
        let moved = |span: &Span| span.start + by..span.end + by;
        self.span = moved(&self.span);
        match &mut self.value {
            Value::List(elements) => elements.iter_mut().for_each(|e| e.displace(by)),
            Value::Table(entries) => {
                for entry in entries {
                    entry.key_span = moved(&entry.key_span);
                    entry.node.displace(by);
                }
            }
            _ => {}
        }
    }
}

/// What may stand in an edit file beside `edit`.
const SECTIONS: [&str; 11] = [
    "format",
    "reason",
    "edit",
    "robot",
    "type",
    "orthoframe",
    "door",
    "object",
    "area",
    "map",
    "zone",
];

/// Edits on their way from a text.
struct Reading<'e> {
    told: &'e mut Vec<Told>,
    unread: &'e mut HashSet<String>,
    slips: Slips<'e>,
}

impl Reading<'_> {
    fn tell(&mut self, edit: Option<Edit>, key_span: &Span, node: &Node, is_broken: bool) {
        let (key_span, node) = (key_span.clone(), node.clone());
        self.told.extend(edit.map(|edit| Told { edit, key_span, node, is_broken }));
    }

    fn decode<T: for<'n> Deserialize<'n>>(
        &mut self,
        node: &Node,
        name: &Span,
    ) -> (Option<T>, bool) {
        let before = self.slips.misprints.len();
        let read = decode(node, name, self.slips.left_out, self.slips.misprints);
        (read, self.slips.misprints.len() > before)
    }

    fn step(&mut self, node: &Node) {
        let before = self.slips.misprints.len();
        let edit = verbs::read_step(&mut self.slips, node);
        let verb = edit.as_ref().and_then(Edit::verb).and_then(|verb| node.entry(verb));
        let key_span = verb.map_or(node.span.clone(), |verb| verb.key_span.clone());
        let is_broken = self.slips.misprints.len() > before;
        if edit.is_none() {
            let names = verbs::MAKING.iter().filter_map(|verb| node.entry(verb)?.node.text());
            self.unread.extend(names.map(name_key));
        }
        self.tell(edit, &key_span, node, is_broken);
    }

    /// New records of one section.
    fn section(&mut self, kind: Kind, section: &Entry) -> Done {
        if !matches!(section.node.value, Value::Table(_)) {
            let word = kind.word();
            let expected = said!("tables-key", word);
            let found = said!("a-value");
            return Err(misprint(MapError::WrongKind { found, expected }, &section.key_span));
        }
        for record in section.node.entries() {
            macro_rules! new {
                ($variant:ident) => {{
                    let (file, is_broken) = self.decode(&record.node, &record.key_span);
                    let new = file.map(|file| NewRecord::$variant(record.key.clone(), file));
                    (new, is_broken)
                }};
            }
            let (new, is_broken) = match kind {
                Kind::Orthoframe => new!(Orthoframe),
                Kind::Door => new!(Door),
                Kind::Object => new!(Object),
                Kind::Area => new!(Area),
                Kind::Map => new!(Map),
                Kind::Zone => new!(Zone),
                Kind::Replica | Kind::Place => unreachable!("lines have no section"),
            };
            if new.is_none() {
                let name = record.node.entry("name").and_then(|e| e.node.text());
                self.unread.extend(name.into_iter().chain([&*record.key]).map(name_key));
            }
            let edit = new.map(|new| Edit::New(Box::new(new)));
            self.tell(edit, &record.key_span, &record.node, is_broken);
        }
        Ok(())
    }

    fn types(&mut self, section: &Node) -> Done {
        for list in section.entries() {
            let Some(kind) = TypeKind::ALL.into_iter().find(|k| k.field() == list.key) else {
                self.slips
                    .misprints
                    .push(*unknown_field(list, &TypeKind::ALL.map(TypeKind::field)));
                continue;
            };
            for line in list.node.elements() {
                let (file, is_broken) = self.decode(line, &line.span);
                let edit = file.map(|file| Edit::New(Box::new(NewRecord::Type(kind, file))));
                self.tell(edit, &line.span, line, is_broken);
            }
        }
        Ok(())
    }

    fn robot(&mut self, entry: &Entry) -> Done {
        if !matches!(entry.node.value, Value::Table(_)) {
            return Err(wrong_kind(&entry.node, TABLE));
        }
        let (said, is_broken) = self.decode::<RobotSaid>(&entry.node, &entry.key_span);
        self.tell(said.map(Edit::Robot), &entry.key_span, &entry.node, is_broken);
        Ok(())
    }
}

fn check_format(node: &Node) -> Done {
    match node.value {
        Value::Integer(n) if n == i64::from(FORMAT) => Ok(()),
        Value::Integer(n) => Err(misprint(MapError::Format { found: n.to_string() }, &node.span)),
        _ => Err(wrong_kind(node, NUMBER)),
    }
}
