//! The hand-written corridor file: corridors as sequences of entrances and junctions.
//!
//! ```toml
//! format = 1
//! name = "Третий этаж"
//!
//! [[corridor]]
//! name = "Главный коридор"
//! along = [
//!   { vertex = 0, room = "301", side = "left" },
//!   { vertex = 1, junction = "branch-right" },   # as it looks to one who comes along the list
//!   { vertex = 2, room = "302", side = "ahead" },
//! ]
//!
//! [[corridor]]
//! along = [ { vertex = 1 }, { vertex = 3, room = "303", side = "right" } ]
//! ```
//!
//! **Invariant**: what comes out is consistent; a text with any fault gives all its faults and no system.

use std::collections::BTreeMap;
use std::ops::Range;

use miette::SourceSpan;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::units::{
    Bilingual, Cm, Gather as _, InOrder as _, Language, Source, nearest_name, said, told, word,
};

use super::arms::{self, Declared};
use super::fault::{CorridorFault, CorridorFileError};
use super::system::{
    CorridorSystem, Entrance, Junction, Port, Side, Stretch, Turn, Vertex, VertexIx, VertexKind,
    Weights,
};
use super::words::{KINDS, MEASURES, SIDES, TURNS, Words, turn_word};

const FILE_FIELDS: &[&str] = &["format", "name", "name_en", "measure", "u_turn", "corridor"];
const CORRIDOR_FIELDS: &[&str] = &["name", "closed", "along"];
const STOP_FIELDS: &[&str] = &[
    "vertex", "room", "room_en", "side", "junction", "straight", "right", "left", "blind", "metres",
];

impl CorridorSystem {
    /// Reads a corridor file.
    ///
    /// # Errors
    /// [`CorridorFileError`] with every fault of the text.
    pub fn from_toml(source: &Source) -> Result<Self, CorridorFileError> {
        let mut reader = Reader { faults: Vec::new() };
        let system = reader.file(source.text());
        let mut faults = reader.faults;
        match system {
            Some(system) if faults.is_empty() => Ok(system),
            _ => {
                faults.order_by_key(CorridorFault::offset);
                Err(CorridorFileError { source_text: source.clone(), faults })
            }
        }
    }
}

/// One entry of `along`.
#[derive(Debug, Clone)]
struct Stop {
    number: u32,
    at: SourceSpan,
    entrance: Option<(Entrance, SourceSpan)>,
    junction: Option<Declared>,
    metres: Option<Cm>,
    /// Something is said of what stands here, be it faulty: one fault is enough.
    says: bool,
}

#[derive(Debug, Default)]
struct Corridor {
    closed: bool,
    stops: Vec<Stop>,
}

type Value<'a, 'i> = &'a Spanned<DeValue<'i>>;
type Table<'a, 'i> = &'a DeTable<'i>;

struct Reader {
    faults: Vec<CorridorFault>,
}

impl Reader {
    fn file(&mut self, text: &str) -> Option<CorridorSystem> {
        // No TOML begins so; each of its lines would be a fault.
        let said = text.trim_start_matches('\u{feff}').trim_start();
        if said.starts_with('{') {
            self.faults.push(CorridorFault::Notation { at: (text.len() - said.len(), 1).into() });
            return None;
        }
        let (document, errors) = DeTable::parse_recoverable(text);
        for error in errors {
            let at = error.span().map_or(0..0, |s| s.start..s.end.max(s.start));
            let message = error.message().to_owned();
            self.faults.push(CorridorFault::Syntax { message, at: at.into() });
        }
        if !self.faults.is_empty() {
            return None;
        }
        let table = document.get_ref();
        self.check_fields(table, FILE_FIELDS);
        self.check_format(table);
        let name = self.text(table, "name").unwrap_or_default();
        let name_en = self.text(table, "name_en").unwrap_or_default();
        let weights = self.weights(table);
        let corridors: Vec<Corridor> =
            self.list(table, "corridor").into_iter().filter_map(|v| self.corridor(v)).collect();
        if table.get("corridor").is_none() {
            self.faults.push(CorridorFault::Empty { at: (0..0).into() });
        }
        let mut system = self.system(name, &corridors)?;
        system.name_en = name_en;
        system.weights = weights;
        Some(system)
    }

    fn check_format(&mut self, table: Table<'_, '_>) {
        let hint = said!("in-the-first-line-format-1");
        match table.get("format") {
            None => {
                let at = (0..0).into();
                self.faults.push(CorridorFault::MissingField { field: "format", hint, at });
            }
            Some(value) => {
                if let Some(found) = self.integer("format", value)
                    && found != 1
                {
                    let at = span(value);
                    self.faults.push(CorridorFault::UnknownFormat { found, at });
                }
            }
        }
    }

    fn weights(&mut self, table: Table<'_, '_>) -> Weights {
        let mut weights = Weights::default();
        if let Some(value) = table.get("measure")
            && let Some(measure) = self.word("measure", value, MEASURES)
        {
            weights.measure = measure;
        }
        if let Some(value) = table.get("u_turn") {
            match number(value.get_ref()) {
                Some(u_turn) if (0.0..=1e6).contains(&u_turn) => weights.u_turn = u_turn,
                _ => self.wrong("u_turn", word!("a-number-from-0-to-1000000"), value),
            }
        }
        weights
    }

    fn corridor(&mut self, value: Value<'_, '_>) -> Option<Corridor> {
        let Some(table) = value.get_ref().as_table() else {
            self.wrong("corridor", word!("tables-corridor"), value);
            return None;
        };
        self.check_fields(table, CORRIDOR_FIELDS);
        self.text(table, "name");
        let closed = match table.get("closed") {
            None => false,
            Some(value) => value.get_ref().as_bool().unwrap_or_else(|| {
                self.wrong("closed", word!("true-or-false"), value);
                false
            }),
        };
        if table.get("along").is_none() {
            let hint = "along = [ { vertex = 0, room = \"201\", side = \"right\" } ]".into();
            let at = span(value);
            self.faults.push(CorridorFault::MissingField { field: "along", hint, at });
        }
        let stops: Vec<Stop> =
            self.list(table, "along").into_iter().filter_map(|v| self.stop(v)).collect();
        Some(Corridor { closed, stops })
    }

    fn stop(&mut self, value: Value<'_, '_>) -> Option<Stop> {
        let Some(table) = value.get_ref().as_table() else {
            self.wrong("along", word!("an-entry-like-vertex-0"), value);
            return None;
        };
        self.check_fields(table, STOP_FIELDS);
        let at = span(value);
        let entrance = self.entrance(table, at);
        let junction = self.junction(table, at);
        let metres = table.get("metres").and_then(|value| match number(value.get_ref()) {
            Some(m) if m > 0.0 && m <= Cm::LIMIT / 100.0 => Some(Cm::of(m * 100.0)),
            _ => {
                self.wrong("metres", word!("a-positive-number-of-metres"), value);
                None
            }
        });
        let Some(vertex) = table.get("vertex") else {
            let hint = word!("the-vertexs-number-such-as-vertex-7").into();
            self.faults.push(CorridorFault::MissingField { field: "vertex", hint, at });
            return None;
        };
        let Some(number) = vertex_number(vertex.get_ref()) else {
            self.wrong("vertex", word!("an-integer-from-0-to-4294967295"), vertex);
            return None;
        };
        if entrance.is_some() && junction.is_some() {
            self.faults.push(CorridorFault::RoomAndJunction { vertex: number, at });
        }
        let says = ["room", "side", "junction"].iter().any(|field| table.get(*field).is_some());
        Some(Stop { number, at, entrance, junction, metres, says })
    }

    fn entrance(&mut self, table: Table<'_, '_>, at: SourceSpan) -> Option<(Entrance, SourceSpan)> {
        let side = table.get("side").map(|v| (self.word("side", v, SIDES), span(v)));
        let room = table.get("room").is_some().then(|| self.text(table, "room"));
        let room_en = self.text(table, "room_en").unwrap_or_default();
        match (room, side) {
            (Some(room), Some((side, at))) => {
                Some((Entrance { room: room?, room_en, side: side? }, at))
            }
            (None, None) => None,
            (room, _) => {
                let (field, hint) = match room {
                    Some(_) => ("side", word!("on-which-side-the-door-is-side")),
                    None => ("room", word!("which-room-is-behind-the-door-room")),
                };
                self.faults.push(CorridorFault::MissingField { field, hint: hint.into(), at });
                None
            }
        }
    }

    fn junction(&mut self, table: Table<'_, '_>, stop: SourceSpan) -> Option<Declared> {
        let mut neighbours = Vec::new();
        for turn in Turn::ALL {
            if let Some(value) = table.get(turn_word(turn))
                && let Some(neighbour) = self.integer(turn_word(turn), value)
            {
                neighbours.push((turn, neighbour, span(value)));
            }
        }
        let mut blind = Vec::new();
        for value in self.list(table, "blind") {
            if let Some(turn) = self.word("blind", value, TURNS) {
                blind.push((turn, span(value)));
            }
        }
        let Some(value) = table.get("junction") else {
            if !neighbours.is_empty() || !blind.is_empty() {
                let hint = word!("the-kind-of-the-junction-junction-branch");
                let at = stop;
                self.faults.push(CorridorFault::MissingField {
                    field: "junction",
                    hint: hint.into(),
                    at,
                });
            }
            return None;
        };
        let kind = self.word("junction", value, KINDS)?;
        Some(Declared { kind, at: span(value), neighbours, blind })
    }

    /// Joins the corridors; none where a fault leaves no sense.
    fn system(&mut self, name: String, corridors: &[Corridor]) -> Option<CorridorSystem> {
        let mut vertices = self.vertices(corridors);
        if !self.faults.is_empty() {
            return None;
        }
        let index: BTreeMap<u32, VertexIx> =
            vertices.iter().enumerate().map(|(i, v)| (v.number, VertexIx(i))).gather();
        let mut layout = arms::Layout::new(vertices.len());
        for corridor in corridors {
            self.lay(corridor, &index, &vertices, &mut layout);
        }
        for (at, vertex) in vertices.iter_mut().enumerate() {
            if let VertexKind::Junction(junction) = &mut vertex.kind {
                *junction =
                    layout.assign_ports(VertexIx(at), vertex.number, &mut self.faults, |v| {
                        index.iter().find(|(_, i)| **i == v).map_or(0, |(number, _)| *number)
                    });
            }
        }
        self.check_ahead(corridors, &index, &layout);
        let stretches = layout.into_stretches();
        self.faults.is_empty().then(|| CorridorSystem::assemble(name, vertices, stretches))
    }

    /// Each vertex once, in the order of their first mention.
    fn vertices(&mut self, corridors: &[Corridor]) -> Vec<Vertex> {
        let mut first: BTreeMap<u32, (usize, SourceSpan, Option<SourceSpan>, bool)> =
            BTreeMap::new();
        let mut vertices: Vec<Vertex> = Vec::new();
        for stop in corridors.iter().flat_map(|c| &c.stops) {
            let junction = || VertexKind::Junction(Junction { arms: Vec::new() });
            let kind =
                stop.entrance.clone().map_or_else(junction, |(e, _)| VertexKind::Entrance(e));
            let entrance_at = stop.entrance.as_ref().map(|_| stop.at);
            let declares = stop.junction.is_some();
            let Some((at, _, entrance, declared)) = first.get_mut(&stop.number) else {
                first.insert(stop.number, (vertices.len(), stop.at, entrance_at, stop.says));
                let (number, floor) = (stop.number, String::new());
                vertices.push(Vertex { number, kind, floor, at: None });
                continue;
            };
            let (vertex, at_stop) = (stop.number, stop.at);
            match (*entrance, entrance_at) {
                (Some(first), _) if !declares => {
                    self.faults.push(CorridorFault::RepeatedEntrance {
                        vertex,
                        at: at_stop,
                        first,
                    });
                }
                (Some(_), _) => {
                    self.faults.push(CorridorFault::RoomAndJunction { vertex, at: at_stop });
                }
                (None, Some(_)) => {
                    // Mentioned before without room: a stop of two corridors is no entrance.
                    self.faults.push(CorridorFault::RoomAndJunction { vertex, at: at_stop });
                    vertices[*at].kind = kind;
                    *entrance = entrance_at;
                }
                (None, None) => {}
            }
            *declared |= stop.says;
        }
        for (&vertex, &(_, at, entrance, declared)) in &first {
            if entrance.is_none() && !declared {
                self.faults.push(CorridorFault::UndeclaredVertex { vertex, at });
            }
        }
        vertices
    }

    /// Adds the stretches of one corridor, and what it says of its junctions.
    fn lay(
        &mut self,
        corridor: &Corridor,
        index: &BTreeMap<u32, VertexIx>,
        vertices: &[Vertex],
        layout: &mut arms::Layout,
    ) {
        let stops = &corridor.stops;
        let mut links: Vec<(usize, usize)> = (1..stops.len()).map(|i| (i - 1, i)).collect();
        if corridor.closed && stops.len() > 1 {
            links.push((stops.len() - 1, 0));
        }
        // Ends of stretches on either side of each stop.
        let mut before = vec![None; stops.len()];
        let mut after = vec![None; stops.len()];
        for (a, b) in links {
            if stops[a].number == stops[b].number {
                let (vertex, at) = (stops[b].number, stops[b].at);
                self.faults.push(CorridorFault::VertexMeetsItself { vertex, at });
                continue;
            }
            let port = |stop: usize, forth: usize| {
                let vertex = index[&stops[stop].number];
                // The port of a junction is known when all its stretches are known.
                let port = if vertices[vertex.0].entrance().is_some() { forth } else { usize::MAX };
                Port { vertex, port }
            };
            let ends = [port(a, 1), port(b, 0)];
            let stretch = layout.add(Stretch { ends, length: stops[b].metres });
            after[a] = Some((stretch, 0));
            before[b] = Some((stretch, 1));
        }
        for (at, stop) in stops.iter().enumerate() {
            let Some(declared) = &stop.junction else { continue };
            // At the first place of the list the corridor is seen as one comes against the list.
            let (back, on) =
                if before[at].is_some() { (before[at], after[at]) } else { (after[at], None) };
            match back {
                Some(back) => layout.declare(index[&stop.number], declared.clone(), back, on),
                None => {
                    let (vertex, at) = (stop.number, stop.at);
                    self.faults.push(CorridorFault::JunctionWithoutApproach { vertex, at });
                }
            }
        }
    }

    fn check_ahead(
        &mut self,
        corridors: &[Corridor],
        index: &BTreeMap<u32, VertexIx>,
        layout: &arms::Layout,
    ) {
        for stop in corridors.iter().flat_map(|c| &c.stops) {
            if let Some((Entrance { side: Side::Ahead, .. }, at)) = &stop.entrance
                && layout.degree(index[&stop.number]) > 1
            {
                let (vertex, at) = (stop.number, *at);
                self.faults.push(CorridorFault::AheadNotAtEnd { vertex, at });
            }
        }
    }

    // Values of the file.

    fn check_fields(&mut self, table: Table<'_, '_>, known: &[&str]) {
        for (key, _) in table.iter().filter(|(key, _)| !known.contains(&key.get_ref().as_ref())) {
            let field = key.get_ref().to_string();
            let hint = match nearest_name(&field, known.iter().copied()) {
                Some(near) => {
                    said!("perhaps-2", near)
                }
                None => {
                    let known = known.join(", ");
                    said!("here-there-may-be", known)
                }
            };
            self.faults.push(CorridorFault::UnknownField { field, hint, at: key.span().into() });
        }
    }

    fn list<'a, 'i>(&mut self, table: Table<'a, 'i>, field: &str) -> Vec<Value<'a, 'i>> {
        let Some(value) = table.get(field) else { return Vec::new() };
        if let Some(items) = value.get_ref().as_array() {
            return items.iter().collect();
        }
        let expected = if field == "corridor" { word!("tables-corridor") } else { word!("a-list") };
        self.wrong(field, expected, value);
        Vec::new()
    }

    /// A name: not empty, on one line.
    fn text(&mut self, table: Table<'_, '_>, field: &str) -> Option<String> {
        let value = table.get(field)?;
        match value.get_ref().as_str() {
            Some(text) if !text.trim().is_empty() && !text.chars().any(char::is_control) => {
                Some(text.trim().to_owned())
            }
            _ => {
                self.wrong(field, word!("a-text-in-quotation-marks-not-empty"), value);
                None
            }
        }
    }

    fn integer(&mut self, field: &str, value: Value<'_, '_>) -> Option<i64> {
        let found = integer(value.get_ref());
        if found.is_none() {
            self.wrong(field, word!("an-integer"), value);
        }
        found
    }

    fn word<T: Copy>(&mut self, field: &str, value: Value<'_, '_>, words: Words<T>) -> Option<T> {
        let key = value.get_ref().as_str().map(crate::units::name_key);
        let found = key.and_then(|key| {
            words.iter().find(|(spellings, _)| spellings.contains(&key.as_str())).map(|(_, t)| *t)
        });
        if found.is_none() {
            let all: Vec<&str> =
                words.iter().flat_map(|(spellings, _)| *spellings).copied().collect();
            let expected = Bilingual::both(|language| {
                let said = |word: &&&str| language == Language::Russian || word.is_ascii();
                let all: Vec<&str> = all.iter().filter(said).copied().collect();
                told!(language, "one-of-the-words", words = all.join(", "))
            });
            self.wrong(field, expected, value);
        }
        found
    }

    fn wrong(&mut self, field: &str, expected: impl Into<Bilingual>, value: Value<'_, '_>) {
        self.faults.push(CorridorFault::WrongValue {
            field: field.to_owned(),
            expected: expected.into(),
            at: span(value),
        });
    }
}

fn span(value: Value<'_, '_>) -> SourceSpan {
    let Range { start, end } = value.span();
    (start..end).into()
}

fn integer(value: &DeValue<'_>) -> Option<i64> {
    let integer = value.as_integer()?;
    i64::from_str_radix(integer.as_str(), integer.radix()).ok()
}

fn vertex_number(value: &DeValue<'_>) -> Option<u32> {
    integer(value)?.try_into().ok()
}

fn number(value: &DeValue<'_>) -> Option<f64> {
    let float = value.as_float().and_then(|f| f.as_str().parse::<f64>().ok());
    float.or_else(|| integer(value).map(|i| i as f64)).filter(|v| v.is_finite())
}
