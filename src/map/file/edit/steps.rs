//! The steps of an edit file, each a change of the tree.

use super::super::decode::{likely, shortened};
use super::super::node::{Entry, Misprint, Node, Span, Value};
use super::super::schema::FORMAT;
use super::NextIds;
use super::tree::{Handle, Kind, Tree, entry};
use crate::map::fault::MapError;
use crate::map::{Entity, TypeKind, World};

/// Every verb with the fields that may stand beside it.
const VERBS: &[(&str, &[&str])] = &[
    (
        "place",
        &["object", "area", "at", "angle", "name_en", "move_prob", "properties", "doors", "forms"],
    ),
    ("point", &["area", "at", "heading", "serves", "name_en", "forms"]),
    ("move", &["to", "by", "area"]),
    ("turn", &["to", "by"]),
    ("remove", &["kind"]),
    ("rename", &["to", "en", "forms", "kind"]),
    ("set", &["property", "value", "side", "move_prob", "kind"]),
    ("unset", &["property", "side", "kind"]),
    ("state", &["is", "opening", "on"]),
    ("bind", &["to", "side", "opens"]),
    ("unbind", &["from"]),
    ("item", &["of", "orthoframe", "at", "angle", "base"]),
    ("link", &["to", "of", "rel", "angle"]),
    ("unlink", &["to", "of"]),
    ("stand", &["map", "at", "angle", "base"]),
    ("include", &["at", "angle", "base"]),
    ("lift", &["stops"]),
];

/// What may stand in an edit file beside `edit`.
const SECTIONS: [&str; 9] =
    ["format", "reason", "edit", "type", "orthoframe", "door", "object", "area", "map"];

/// Kinds that have properties.
const PROPERTIED: &[Kind] =
    &[Kind::Replica, Kind::Area, Kind::Door, Kind::Object, Kind::Orthoframe];
const GROUPS: &[Kind] = &[Kind::Area, Kind::Object];

/// A step's work, or its fault.
type Outcome<T> = Result<T, Box<Misprint>>;
type Done = Outcome<()>;

pub(super) struct Steps<'a> {
    pub(super) tree: Tree,
    world: &'a World,
    ids: NextIds,
    names: &'a dyn Fn(&str) -> Vec<Entity>,
    pub(super) misprints: Vec<Misprint>,
    pub(super) reason: Option<String>,
    /// The place of the only step, if there is but one: what it spoils elsewhere is told there.
    pub(super) only: Option<Span>,
}

/// One step: its verb with what it is done to, and its other fields.
struct Step<'n> {
    node: &'n Node,
    verb: &'n Entry,
}

fn misprint(error: MapError, span: &Span) -> Box<Misprint> {
    Box::new(Misprint { error, span: Some(span.clone()) })
}

impl<'n> Step<'n> {
    /// What the verb is done to.
    fn what(&self) -> Outcome<&'n str> {
        text_of(&self.verb.node)
    }

    fn field(&self, name: &str) -> Option<&'n Node> {
        self.node.entry(name).map(|e| &e.node)
    }

    fn required(&self, name: &'static str) -> Outcome<&'n Node> {
        self.field(name)
            .ok_or_else(|| misprint(MapError::MissingField { field: name }, &self.verb.key_span))
    }

    /// The fields of these names, as they are.
    fn copies(&self, names: &[&str]) -> Vec<Entry> {
        self.node.entries().iter().filter(|e| names.contains(&e.key.as_str())).cloned().collect()
    }

    fn span(&self) -> &'n Span {
        &self.verb.node.span
    }
}

fn text_of(node: &Node) -> Outcome<&str> {
    node.text().ok_or_else(|| wrong_kind(node, "текст"))
}

fn wrong_kind(node: &Node, expected: &str) -> Box<Misprint> {
    let found = match &node.value {
        Value::Nothing => "пустое значение".to_owned(),
        Value::Bool(b) => format!("«{b}»"),
        Value::Integer(n) => format!("число {n}"),
        Value::Float(x) => format!("число {x}"),
        Value::Text(text) => format!("текст «{}»", shortened(text)),
        Value::List(_) => "список".to_owned(),
        Value::Table(_) => "таблица".to_owned(),
    };
    misprint(MapError::WrongKind { found, expected: expected.to_owned() }, &node.span)
}

fn number(node: &Node) -> Outcome<f64> {
    match node.value {
        Value::Integer(n) => Ok(n as f64),
        Value::Float(x) => Ok(x),
        _ => Err(wrong_kind(node, "число")),
    }
}

fn numbers(node: &Node) -> Outcome<Vec<f64>> {
    let list: Vec<f64> = node.elements().iter().map(number).collect::<Result<_, _>>()?;
    if (2..=3).contains(&list.len()) {
        Ok(list)
    } else {
        Err(wrong_kind(node, "два или три числа [x, y, z]"))
    }
}

/// A number as a person would have written it.
fn written(x: f64) -> Value {
    if x.fract() == 0.0 && x.abs() < 1e9 { Value::Integer(x as i64) } else { Value::Float(x) }
}

fn table(span: &Span, entries: Vec<Entry>) -> Node {
    Node { span: span.clone(), value: Value::Table(entries) }
}

impl<'a> Steps<'a> {
    pub(super) fn new(
        tree: Tree,
        world: &'a World,
        ids: NextIds,
        names: &'a dyn Fn(&str) -> Vec<Entity>,
    ) -> Self {
        Self { tree, world, ids, names, misprints: Vec::new(), reason: None, only: None }
    }

    /// Works a whole file in: what is new first, then the steps in their order.
    pub(super) fn take(&mut self, edits: &Node) {
        for entry in edits.entries() {
            let done = match entry.key.as_str() {
                "format" => check_format(&entry.node),
                "reason" => text_of(&entry.node).map(|r| self.reason = Some(r.to_owned())),
                "type" => {
                    self.types(&entry.node);
                    Ok(())
                }
                "edit" => Ok(()),
                other => {
                    match Kind::ALL.into_iter().find(|k| k.lines().is_none() && k.word() == other) {
                        Some(kind) => {
                            self.section(kind, entry);
                            Ok(())
                        }
                        None => Err(unknown_field(entry, &SECTIONS)),
                    }
                }
            };
            self.misprints.extend(done.err().map(|fault| *fault));
        }
        let Some(list) = edits.entry("edit") else { return };
        if !matches!(list.node.value, Value::List(_)) {
            self.misprints.push(*wrong_kind(&list.node, "список шагов [[edit]]"));
        }
        for node in list.node.elements() {
            if let Err(fault) = self.step(node) {
                self.misprints.push(*fault);
            }
        }
        if let ([only], true) = (
            list.node.elements(),
            edits.entries().iter().all(|e| ["edit", "reason", "format"].contains(&e.key.as_str())),
        ) {
            let verb = only.entries().iter().find(|e| VERBS.iter().any(|(v, _)| *v == e.key));
            self.only = verb.map(|v| v.key_span.start..v.node.span.end.max(v.key_span.end));
        }
    }

    fn fresh_id(&mut self, kind: Kind, span: &Span) -> Entry {
        let next = self.ids.of(kind);
        let id = *next;
        *next = next.saturating_add(1);
        entry("id", span, Value::Integer(i64::from(id)))
    }

    /// New records of one section.
    fn section(&mut self, kind: Kind, section: &Entry) {
        for record in section.node.entries() {
            let known = self.tree.find(&record.key, &[kind]);
            if known.iter().any(|h| self.tree.key(*h) == record.key) {
                let error = MapError::AlreadyThere { what: kind.title(), name: record.key.clone() };
                self.misprints.push(*misprint(error, &record.key_span));
                continue;
            }
            if kind == Kind::Map {
                self.spell_out_domain();
            }
            let mut record = record.clone();
            if kind == Kind::Area {
                for lines in [Kind::Replica, Kind::Place] {
                    self.number_lines(lines, &mut record.node);
                }
            }
            if record.node.entry("id").is_none() {
                let id = self.fresh_id(kind, &record.key_span.clone());
                record.node.put(id);
            }
            self.tree.add(kind, record);
        }
    }

    fn number_lines(&mut self, kind: Kind, area: &mut Node) {
        let Some(list) = kind.lines().and_then(|l| area.entry_mut(l)) else { return };
        let Value::List(lines) = &mut list.node.value else { return };
        for line in lines {
            let span = line.span.clone();
            if line.entry("id").is_none() {
                line.put(self.fresh_id(kind, &span));
            }
        }
    }

    /// A building of one Map need not say where it stands; one of several must.
    fn spell_out_domain(&mut self) {
        let maps = self.tree.all(Kind::Map);
        let [only] = maps[..] else { return };
        let key = self.tree.key(only).to_owned();
        if let Some(domain) = self.tree.table_mut("domain")
            && domain.entry("maps").is_none()
        {
            let nowhere = usize::MAX - 1..usize::MAX;
            let line = table(&nowhere, vec![entry("map", &nowhere, Value::Text(key))]);
            domain.push("maps", line);
        }
    }

    fn types(&mut self, section: &Node) {
        for list in section.entries() {
            let Some(kind) = TypeKind::ALL.into_iter().find(|k| k.field() == list.key) else {
                self.misprints.push(*unknown_field(list, &TypeKind::ALL.map(TypeKind::field)));
                continue;
            };
            for line in list.node.elements() {
                let mut line = line.clone();
                if let Some(name) = line.entry("name").and_then(|n| n.node.text())
                    && self.world.types.list(kind).named(name).is_some()
                {
                    let error = MapError::AlreadyThere { what: "Тип", name: shortened(name) };
                    self.misprints.push(*misprint(error, &line.span));
                    continue;
                }
                let next = self.ids.types.entry(kind).or_insert(1);
                line.put(entry("id", &line.span.clone(), Value::Integer(i64::from(*next))));
                *next = next.saturating_add(1);
                if let Some(types) = self.tree.table_mut("type") {
                    types.push(kind.field(), line);
                }
            }
        }
    }

    fn step(&mut self, node: &Node) -> Done {
        let verbs: Vec<&str> = VERBS.iter().map(|(verb, _)| *verb).collect();
        let Some(verb) = node.entries().iter().find(|e| verbs.contains(&e.key.as_str())) else {
            let expected = verbs.join(", ");
            return Err(match node.entries().first() {
                None => wrong_kind(node, "шаг правки: таблица с глаголом"),
                Some(first) => misprint(
                    MapError::UnknownVerb {
                        found: shortened(&first.key),
                        nearest: likely(&first.key, &verbs),
                        expected,
                    },
                    &first.key_span,
                ),
            });
        };
        let (_, fields) = VERBS.iter().find(|(v, _)| *v == verb.key).expect("found by its name");
        let mut whole = true;
        for entry in node.entries().iter().filter(|e| e.key != verb.key) {
            if !fields.contains(&entry.key.as_str()) {
                self.misprints.push(*unknown_field(entry, fields));
                whole = false;
            }
        }
        let step = Step { node, verb };
        if !whole {
            return Ok(());
        }
        match verb.key.as_str() {
            "place" => self.place(&step),
            "point" => self.point(&step),
            "move" => self.shift(&step),
            "turn" => self.turn(&step),
            "remove" => self.remove(&step),
            "rename" => self.rename(&step),
            "set" => self.set(&step),
            "unset" => self.unset(&step),
            "state" => self.state(&step),
            "bind" => self.bind(&step),
            "unbind" => self.unbind(&step),
            "item" => self.item(&step),
            "link" => self.link(&step),
            "unlink" => self.unlink(&step),
            "stand" => self.stand(&step),
            "include" => self.include(&step),
            _ => self.lift(&step),
        }
    }

    /// What a name means among some kinds: as the map or this file spells it, else in another form.
    fn find(&self, node: &Node, kinds: &[Kind]) -> Outcome<Handle> {
        let name = text_of(node)?;
        let mut found = self.tree.find(name, kinds);
        if found.is_empty() {
            let in_other_words = (self.names)(name);
            found = in_other_words.iter().filter_map(|e| self.known(*e, kinds)).collect();
        }
        match found[..] {
            [only] => Ok(only),
            [] => {
                let what = if let [kind] = kinds { kind.title() } else { "Имя" };
                let nearest = self.tree.nearest(name, kinds);
                let error = MapError::UnknownReference { what, name: shortened(name), nearest };
                Err(misprint(error, &node.span))
            }
            _ => {
                let candidates: Vec<String> =
                    found.iter().map(|h| format!("«{}»", self.tree.reference(*h))).collect();
                let (name, candidates) = (shortened(name), candidates.join(", "));
                Err(misprint(MapError::AmbiguousName { name, candidates }, &node.span))
            }
        }
    }

    fn known(&self, entity: Entity, kinds: &[Kind]) -> Option<Handle> {
        let w = self.world;
        let (kind, name) = match entity {
            Entity::Map(id) => (Kind::Map, &w.maps.get(&id)?.key),
            Entity::Area(id) => (Kind::Area, &w.areas.get(&id)?.key),
            Entity::Door(id) => (Kind::Door, &w.doors.get(&id)?.key),
            Entity::Replica(id) => (Kind::Replica, &w.replicas.get(&id)?.name),
            Entity::Place(id) => (Kind::Place, &w.places.get(&id)?.name),
        };
        if !kinds.contains(&kind) {
            return None;
        }
        match self.tree.find(name, &[kind])[..] {
            [only] => Some(only),
            _ => None,
        }
    }

    /// A reference to what a field names, in the words of the map.
    fn reference(&self, node: &Node, kinds: &[Kind]) -> Outcome<Node> {
        let text = self.tree.reference(self.find(node, kinds)?);
        Ok(Node { span: node.span.clone(), value: Value::Text(text) })
    }

    /// The kinds that a step may speak of: all of these, or the one that it names.
    fn kinds(&self, step: &Step<'_>, all: &[Kind]) -> Outcome<Vec<Kind>> {
        let Some(node) = step.field("kind") else { return Ok(all.to_vec()) };
        let word = text_of(node)?;
        let words: Vec<&str> = all.iter().map(|k| k.word()).collect();
        match all.iter().find(|k| k.word() == word) {
            Some(kind) => Ok(vec![*kind]),
            None => Err(misprint(
                MapError::UnknownWord {
                    word: shortened(word),
                    nearest: likely(word, &words),
                    expected: words.join(", "),
                },
                &node.span,
            )),
        }
    }

    fn change(&mut self, at: Handle) -> &mut Node {
        self.tree.get_mut(at).expect("a handle leads to its record")
    }

    fn place(&mut self, step: &Step<'_>) -> Done {
        let area = self.find(step.required("area")?, &[Kind::Area])?;
        let fields = VERBS[0].1.iter().filter(|f| **f != "area").copied().collect::<Vec<_>>();
        self.new_line(Kind::Replica, area, step, &fields)
    }

    fn point(&mut self, step: &Step<'_>) -> Done {
        let area = self.find(step.required("area")?, &[Kind::Area])?;
        self.new_line(Kind::Place, area, step, &["at", "heading", "serves", "name_en", "forms"])
    }

    fn new_line(&mut self, kind: Kind, area: Handle, step: &Step<'_>, fields: &[&str]) -> Done {
        let name = step.what()?;
        if !self.tree.find(name, &[kind]).is_empty() {
            let error = MapError::AlreadyThere { what: kind.title(), name: shortened(name) };
            return Err(misprint(error, step.span()));
        }
        let mut entries = step.copies(fields);
        for entry in &mut entries {
            let kinds = match entry.key.as_str() {
                "object" => &[Kind::Object],
                "serves" => &[Kind::Replica],
                _ => continue,
            };
            entry.node = self.reference(&entry.node, kinds)?;
        }
        entries.push(Entry { key: "name".to_owned(), ..step.verb.clone() });
        entries.push(self.fresh_id(kind, step.span()));
        // The place of the line is that of the whole step, as a line of a map file is that of its fields.
        self.tree.add_line(kind, area, table(&step.verb.key_span, entries));
        Ok(())
    }

    /// `move`: to a place, by an offset, into another Area. Coordinates are those of the Area.
    fn shift(&mut self, step: &Step<'_>) -> Done {
        let at = self.find(&step.verb.node, &[Kind::Replica, Kind::Place])?;
        let before = self.tree.get(at).and_then(|n| n.entry("at")).map(|e| numbers(&e.node));
        let before = before.transpose()?.unwrap_or_default();
        let (to, by) = (step.field("to"), step.field("by"));
        let new = match (to, by) {
            (Some(to), None) => Some((numbers(to)?, to)),
            (None, Some(by)) => {
                let by_how_much = numbers(by)?;
                let sum = |i: usize| {
                    before.get(i).copied().unwrap_or(0.0)
                        + by_how_much.get(i).copied().unwrap_or(0.0)
                };
                let count = before.len().max(by_how_much.len());
                Some(((0..count).map(sum).collect(), by))
            }
            (None, None) if step.field("area").is_some() => None,
            (None, None) => {
                return Err(misprint(MapError::MissingField { field: "to" }, &step.verb.key_span));
            }
            (Some(_), Some(by)) => {
                let message = "дайте либо to, либо by".to_owned();
                return Err(misprint(MapError::BadValue { message }, &by.span));
            }
        };
        if let Some((new, node)) = new {
            // A height that was there stays when the new place says none.
            let mut new = new;
            if let (2, Some(z)) = (new.len(), before.get(2)) {
                new.push(*z);
            }
            if at.kind == Kind::Place {
                new.truncate(2);
            }
            let list = new.iter().map(|x| Node { span: node.span.clone(), value: written(*x) });
            let value = Value::List(list.collect());
            self.change(at).put(entry("at", &node.span, value));
        }
        let Some(area) = step.field("area") else { return Ok(()) };
        let area = self.find(area, &[Kind::Area])?;
        if area.entry != at.entry {
            let record = self.change(at);
            let line = Node { span: step.verb.key_span.clone(), value: record.value.clone() };
            record.value = Value::Nothing;
            self.tree.add_line(at.kind, area, line);
        }
        Ok(())
    }

    fn turn(&mut self, step: &Step<'_>) -> Done {
        let at = self.find(&step.verb.node, &[Kind::Replica, Kind::Place])?;
        let field = if at.kind == Kind::Place { "heading" } else { "angle" };
        let before = self.tree.get(at).and_then(|n| n.entry(field)).map(|e| number(&e.node));
        let before = before.transpose()?.unwrap_or(0.0);
        let (angle, node) = match (step.field("to"), step.field("by")) {
            (Some(to), None) => (number(to)?, to),
            (None, Some(by)) => ((before + number(by)?).rem_euclid(360.0), by),
            (Some(_), Some(by)) => {
                let message = "дайте либо to, либо by".to_owned();
                return Err(misprint(MapError::BadValue { message }, &by.span));
            }
            (None, None) => {
                return Err(misprint(MapError::MissingField { field: "by" }, &step.verb.key_span));
            }
        };
        self.change(at).put(entry(field, &node.span, written(angle)));
        Ok(())
    }

    /// Takes a record out, with what only it gave a place: an Area's standing on its Map, a door's bindings.
    fn remove(&mut self, step: &Step<'_>) -> Done {
        let kinds = self.kinds(step, &Kind::ALL)?;
        let at = self.find(&step.verb.node, &kinds)?;
        let name = self.tree.reference(at);
        let users = self.users(at, &name);
        if !users.is_empty() {
            let (what, by) = (at.kind.title(), users.join(", "));
            return Err(misprint(MapError::StillUsed { what, name, by }, step.span()));
        }
        self.change(at).value = Value::Nothing;
        let is = |field: &'static str, name: String| {
            move |node: &Node| node.entry(field).and_then(|e| e.node.text()) == Some(name.as_str())
        };
        match at.kind {
            Kind::Replica => {
                for area in self.tree.all(Kind::Area) {
                    let area = self.change(area);
                    if let Some(Value::List(places)) =
                        area.entry_mut("places").map(|e| &mut e.node.value)
                    {
                        let serving = is("serves", name.clone());
                        places
                            .iter_mut()
                            .filter(|p| serving(p))
                            .for_each(|p| p.drop_entry("serves"));
                    }
                }
            }
            Kind::Door => {
                for kind in GROUPS {
                    for group in self.tree.all(*kind) {
                        self.change(group).strike("doors", is("door", name.clone()));
                    }
                }
            }
            Kind::Area => {
                let of_area = |text: Option<&str>| {
                    text.is_some_and(|t| {
                        t.strip_prefix(&name).is_some_and(|rest| rest.starts_with('.'))
                    })
                };
                for map in self.tree.all(Kind::Map) {
                    let map = self.change(map);
                    map.strike("items", is("area", name.clone()));
                    map.strike("links", |link| {
                        ["from", "to"]
                            .iter()
                            .any(|f| of_area(link.entry(f).and_then(|e| e.node.text())))
                    });
                }
            }
            Kind::Map => {
                if let Some(domain) = self.tree.table_mut("domain") {
                    domain.strike("maps", is("map", name));
                }
            }
            Kind::Place | Kind::Object | Kind::Orthoframe => {}
        }
        Ok(())
    }

    /// What could not be without a record, and does not go with it.
    fn users(&self, at: Handle, name: &str) -> Vec<String> {
        let is =
            |node: &Node, field: &str| node.entry(field).and_then(|e| e.node.text()) == Some(name);
        let lines = |owner: Handle, list: &str, field: &str| -> Vec<&Node> {
            let nodes = self.tree.get(owner).and_then(|n| n.entry(list));
            let nodes = nodes.map_or(&[][..], |e| e.node.elements());
            nodes.iter().filter(|n| is(n, field)).collect()
        };
        let quoted = |name: &str| format!("«{name}»");
        match at.kind {
            Kind::Object => {
                let areas = self.tree.all(Kind::Area).into_iter();
                let replicas = areas.flat_map(|area| lines(area, "replicas", "object"));
                replicas.filter_map(|r| r.entry("name")?.node.text()).map(quoted).collect()
            }
            Kind::Orthoframe => {
                let groups = GROUPS.iter().flat_map(|kind| self.tree.all(*kind));
                let using = groups.filter(|g| !lines(*g, "items", "orthoframe").is_empty());
                using.map(|g| quoted(self.tree.key(g))).collect()
            }
            Kind::Place => {
                let robot = self.tree.section("robot").iter().find(|e| e.key == "start");
                let starts = robot.is_some_and(|e| e.node.text() == Some(name));
                if starts {
                    vec!["робот начинает отсюда".to_owned()]
                } else {
                    Vec::new()
                }
            }
            _ => Vec::new(),
        }
    }

    /// A new name; what refers to the old one follows. Word forms of the old name do not fit the new one.
    fn rename(&mut self, step: &Step<'_>) -> Done {
        let kinds = self.kinds(step, &Kind::ALL)?;
        let at = self.find(&step.verb.node, &kinds)?;
        let old = self.tree.reference(at);
        if step.field("to").is_none() && step.field("en").is_none() {
            return Err(misprint(MapError::MissingField { field: "to" }, &step.verb.key_span));
        }
        if let Some(to) = step.field("to") {
            let new = text_of(to)?.to_owned();
            let record = self.change(at);
            record.put(Entry {
                key: "name".to_owned(),
                key_span: to.span.clone(),
                node: to.clone(),
            });
            record.drop_entry("forms");
            self.tree.note(&new, at);
            self.follow_name(at.kind, &old, to);
        }
        if let Some(en) = step.field("en") {
            text_of(en)?;
            let name =
                Entry { key: "name_en".to_owned(), key_span: en.span.clone(), node: en.clone() };
            self.change(at).put(name);
        }
        for forms in step.copies(&["forms"]) {
            self.change(at).put(forms);
        }
        Ok(())
    }

    /// Lines are referred to by their names, not by keys.
    fn follow_name(&mut self, kind: Kind, old: &str, new: &Node) {
        let named =
            |node: &Node, field: &str| node.entry(field).and_then(|e| e.node.text()) == Some(old);
        if kind == Kind::Place
            && let Some(robot) = self.tree.table_mut("robot")
            && named(robot, "start")
        {
            robot.put(Entry { key: "start".into(), key_span: new.span.clone(), node: new.clone() });
        }
        if kind != Kind::Replica {
            return;
        }
        for area in self.tree.all(Kind::Area) {
            let places = self.change(area).entry_mut("places").map(|e| &mut e.node.value);
            let Some(Value::List(places)) = places else { continue };
            for place in places.iter_mut().filter(|p| named(p, "serves")) {
                let key_span = new.span.clone();
                place.put(Entry { key: "serves".into(), key_span, node: new.clone() });
            }
        }
    }

    fn set(&mut self, step: &Step<'_>) -> Done {
        if let Some(probability) = step.field("move_prob") {
            let at = self.find(&step.verb.node, &[Kind::Replica])?;
            number(probability)?;
            let new = step.copies(&["move_prob"]).remove(0);
            self.change(at).put(new);
            if step.field("property").is_none() {
                return Ok(());
            }
        }
        let property = step.required("property")?;
        let value = step.required("value")?.clone();
        let name = text_of(property)?.to_owned();
        text_of(&value)?;
        let properties = self.properties(step)?;
        properties.put(Entry { key: name, key_span: property.span.clone(), node: value });
        Ok(())
    }

    fn unset(&mut self, step: &Step<'_>) -> Done {
        let property = step.required("property")?;
        let name = text_of(property)?.to_owned();
        let properties = self.properties(step)?;
        if properties.entry(&name).is_none() {
            let nearest = None;
            let error = MapError::UnknownReference { what: "Свойство", name, nearest };
            return Err(misprint(error, &property.span));
        }
        properties.drop_entry(&name);
        Ok(())
    }

    /// The table of properties of what a step speaks of, or of one of its sides.
    fn properties(&mut self, step: &Step<'_>) -> Outcome<&mut Node> {
        let kinds = if step.field("side").is_some() {
            vec![Kind::Orthoframe]
        } else {
            self.kinds(step, PROPERTIED)?
        };
        let at = self.find(&step.verb.node, &kinds)?;
        let side = step.field("side").map(text_of).transpose()?;
        let mut record = self.change(at);
        if let Some(side) = side {
            record = side_of(record, side).ok_or_else(|| {
                let (what, name, nearest) = ("Сторона", shortened(side), None);
                misprint(MapError::UnknownReference { what, name, nearest }, step.span())
            })?;
        }
        if record.entry("properties").is_none() {
            record.put(entry("properties", step.span(), Value::Table(Vec::new())));
        }
        Ok(&mut record.entry_mut("properties").expect("it was put there").node)
    }

    /// The state of a door, or of a door of a replica's Object on that replica.
    fn state(&mut self, step: &Step<'_>) -> Done {
        let door = self.find(&step.verb.node, &[Kind::Door])?;
        let is = step.required("is")?;
        let mut state =
            vec![Entry { key: "state".into(), key_span: is.span.clone(), node: is.clone() }];
        state.extend(step.copies(&["opening"]));
        let Some(on) = step.field("on") else {
            let record = self.change(door);
            record.drop_entry("opening");
            state.into_iter().for_each(|field| record.put(field));
            return Ok(());
        };
        let replica = self.find(on, &[Kind::Replica])?;
        let key = self.tree.key(door).to_owned();
        let record = self.change(replica);
        if record.entry("doors").is_none() {
            record.put(entry("doors", &on.span, Value::Table(Vec::new())));
        }
        let doors = &mut record.entry_mut("doors").expect("it was put there").node;
        doors.put(Entry { key, key_span: step.span().clone(), node: table(&is.span, state) });
        Ok(())
    }

    fn bind(&mut self, step: &Step<'_>) -> Done {
        let door = self.reference(&step.verb.node, &[Kind::Door])?;
        let group = self.find(step.required("to")?, GROUPS)?;
        step.required("side")?;
        let mut mount =
            vec![Entry { key: "door".into(), key_span: step.span().clone(), node: door }];
        mount.extend(step.copies(&["side", "opens"]));
        self.change(group).push("doors", table(&step.verb.key_span, mount));
        Ok(())
    }

    fn unbind(&mut self, step: &Step<'_>) -> Done {
        let door = self.tree.reference(self.find(&step.verb.node, &[Kind::Door])?);
        let groups = match step.field("from") {
            Some(from) => vec![self.find(from, GROUPS)?],
            None => GROUPS.iter().flat_map(|kind| self.tree.all(*kind)).collect(),
        };
        let mut any = false;
        for group in groups {
            any |= self.change(group).strike("doors", |mount| {
                mount.entry("door").and_then(|e| e.node.text()) == Some(door.as_str())
            });
        }
        if any { Ok(()) } else { Err(misprint(MapError::NotBound { door }, step.span())) }
    }

    /// Another part of an Object or Area.
    fn item(&mut self, step: &Step<'_>) -> Done {
        let group = self.find(step.required("of")?, GROUPS)?;
        let orthoframe = step.required("orthoframe")?;
        let reference = self.reference(orthoframe, &[Kind::Orthoframe])?;
        let mut item = vec![
            Entry { key: "id".into(), ..step.verb.clone() },
            Entry { key: "orthoframe".into(), key_span: orthoframe.span.clone(), node: reference },
        ];
        item.extend(step.copies(&["at", "angle", "base"]));
        self.change(group).push("items", table(&step.verb.key_span, item));
        Ok(())
    }

    /// Binds faces of two parts of an Object or Area, or sides of two Areas of a Map.
    fn link(&mut self, step: &Step<'_>) -> Done {
        let (owner, from, to) = self.ends(step)?;
        let mut link = vec![
            Entry { key: "from".into(), key_span: from.span.clone(), node: from },
            Entry { key: "to".into(), key_span: to.span.clone(), node: to },
        ];
        link.extend(step.copies(&["rel", "angle"]));
        self.change(owner).push("links", table(&step.verb.key_span, link));
        Ok(())
    }

    fn unlink(&mut self, step: &Step<'_>) -> Done {
        let (owner, from, to) = self.ends(step)?;
        let ends = [from.text(), to.text()];
        let any = self.change(owner).strike("links", |link| {
            let of_link = ["from", "to"].map(|f| link.entry(f).and_then(|e| e.node.text()));
            of_link == ends || of_link == [ends[1], ends[0]]
        });
        if any {
            return Ok(());
        }
        let text =
            format!("{} - {}", from.text().unwrap_or_default(), to.text().unwrap_or_default());
        Err(misprint(MapError::NotLinked { link: text }, step.span()))
    }

    /// Where a link stands, and its ends in the words of the map.
    fn ends(&self, step: &Step<'_>) -> Outcome<(Handle, Node, Node)> {
        let (from, to) = (&step.verb.node, step.required("to")?);
        let (from_text, to_text) = (text_of(from)?, text_of(to)?);
        if let Some(of) = step.field("of") {
            let owner = self.find(of, &[Kind::Map, Kind::Object, Kind::Area])?;
            if owner.kind != Kind::Map {
                return Ok((owner, from.clone(), to.clone()));
            }
        }
        let ends =
            [(from, from_text), (to, to_text)].map(|(node, text)| self.side_of_area(node, text));
        let [from, to] = ends;
        let ((area, from), (_, to)) = (from?, to?);
        let owner = match step.field("of") {
            Some(of) => self.find(of, &[Kind::Map])?,
            None => self.map_of(area).ok_or_else(|| {
                let area = self.tree.key(area).to_owned();
                misprint(MapError::AreaNowhereYet { area }, &step.verb.node.span)
            })?,
        };
        Ok((owner, from, to))
    }

    /// «Комната-В.F» with the Area's key in place of its name.
    fn side_of_area(&self, node: &Node, text: &str) -> Outcome<(Handle, Node)> {
        let dots = text.match_indices('.').map(|(at, _)| at).collect::<Vec<_>>();
        for at in dots.into_iter().rev() {
            let name = Node { span: node.span.clone(), value: Value::Text(text[..at].to_owned()) };
            if let Ok(area) = self.find(&name, &[Kind::Area]) {
                let whole = format!("{}{}", self.tree.key(area), &text[at..]);
                return Ok((area, Node { span: node.span.clone(), value: Value::Text(whole) }));
            }
        }
        let wanted = "«помещение.сторона»";
        let error = match text.split_once('.') {
            None => MapError::BadReference { text: shortened(text), wanted },
            Some((area, _)) => MapError::UnknownReference {
                what: "Помещение",
                name: shortened(area),
                nearest: self.tree.nearest(area, &[Kind::Area]),
            },
        };
        Err(misprint(error, &node.span))
    }

    fn map_of(&self, area: Handle) -> Option<Handle> {
        let key = self.tree.key(area);
        let holds = |map: &Handle| {
            let items = self.tree.get(*map).and_then(|m| m.entry("items"));
            items.is_some_and(|items| {
                let of = |i: &Node| i.entry("area").and_then(|e| e.node.text()) == Some(key);
                items.node.elements().iter().any(of)
            })
        };
        self.tree.all(Kind::Map).into_iter().find(holds)
    }

    /// Where an Area stands on a Map.
    fn stand(&mut self, step: &Step<'_>) -> Done {
        let area = self.find(&step.verb.node, &[Kind::Area])?;
        let map = match step.field("map") {
            Some(map) => self.find(map, &[Kind::Map])?,
            None => self.only_map(step)?,
        };
        self.put_down("items", "area", area, map, step)
    }

    fn only_map(&self, step: &Step<'_>) -> Outcome<Handle> {
        match self.tree.all(Kind::Map)[..] {
            [only] => Ok(only),
            _ => Err(misprint(MapError::MissingField { field: "map" }, &step.verb.key_span)),
        }
    }

    fn put_down(
        &mut self,
        list: &str,
        field: &str,
        what: Handle,
        on: Handle,
        step: &Step<'_>,
    ) -> Done {
        let key = self.tree.key(what).to_owned();
        let mut fields = step.copies(&["at", "angle", "base"]);
        let owner = self.change(on);
        let known = owner.entry_mut(list).and_then(|e| match &mut e.node.value {
            Value::List(lines) => lines
                .iter_mut()
                .find(|l| l.entry(field).and_then(|e| e.node.text()) == Some(key.as_str())),
            _ => None,
        });
        if let Some(line) = known {
            fields.into_iter().for_each(|f| line.put(f));
        } else {
            fields.push(entry(field, step.span(), Value::Text(key)));
            owner.push(list, table(&step.verb.key_span, fields));
        }
        Ok(())
    }

    /// Where a Map stands in the Domain.
    fn include(&mut self, step: &Step<'_>) -> Done {
        let map = self.find(&step.verb.node, &[Kind::Map])?;
        let key = self.tree.key(map).to_owned();
        let fields = step.copies(&["at", "angle", "base"]);
        let Some(domain) = self.tree.table_mut("domain") else { return Ok(()) };
        let known = domain.entry_mut("maps").and_then(|e| match &mut e.node.value {
            Value::List(lines) => lines
                .iter_mut()
                .find(|l| l.entry("map").and_then(|e| e.node.text()) == Some(key.as_str())),
            _ => None,
        });
        match known {
            Some(line) => fields.into_iter().for_each(|f| line.put(f)),
            None => {
                let mut line = fields;
                line.push(entry("map", step.span(), Value::Text(key)));
                domain.push("maps", table(&step.verb.key_span, line));
            }
        }
        Ok(())
    }

    /// A lift, or a flight of stairs, with its stops; one of this name gets these stops.
    fn lift(&mut self, step: &Step<'_>) -> Done {
        let name = step.what()?.to_owned();
        let stops = step.required("stops")?;
        let areas: Vec<Node> = stops
            .elements()
            .iter()
            .map(|stop| self.reference(stop, &[Kind::Area]))
            .collect::<Result<_, _>>()?;
        let line = vec![
            Entry { key: "name".into(), ..step.verb.clone() },
            entry("stops", &stops.span, Value::List(areas)),
        ];
        let Some(domain) = self.tree.table_mut("domain") else { return Ok(()) };
        domain
            .strike("lifts", |lift| lift.entry("name").and_then(|e| e.node.text()) == Some(&name));
        domain.push("lifts", table(&step.verb.key_span, line));
        Ok(())
    }
}

/// The table of one side of an Orthoframe's base, made where its corners alone are written.
fn side_of<'t>(record: &'t mut Node, side: &str) -> Option<&'t mut Node> {
    if record.entry("sides").is_some() {
        let Value::List(sides) = &mut record.entry_mut("sides")?.node.value else { return None };
        return sides.iter_mut().find(|s| s.entry("id").and_then(|e| e.node.text()) == Some(side));
    }
    let span = record.span.clone();
    if record.entry("side").is_none() {
        record.put(entry("side", &span, Value::Table(Vec::new())));
    }
    let traits = &mut record.entry_mut("side")?.node;
    if traits.entry(side).is_none() {
        traits.put(entry(side, &span, Value::Table(Vec::new())));
    }
    Some(&mut traits.entry_mut(side)?.node)
}

fn check_format(node: &Node) -> Done {
    match node.value {
        Value::Integer(n) if n == i64::from(FORMAT) => Ok(()),
        Value::Integer(n) => Err(misprint(MapError::Format { found: n.to_string() }, &node.span)),
        _ => Err(wrong_kind(node, "число")),
    }
}

fn unknown_field(entry: &Entry, known: &[&str]) -> Box<Misprint> {
    let error = MapError::UnknownField {
        field: shortened(&entry.key),
        nearest: likely(&entry.key, known),
        expected: known.join(", "),
    };
    misprint(error, &entry.key_span)
}
