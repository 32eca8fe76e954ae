//! Zones laid out, changed and moved. What steps say of one is gathered in the words of a map file, and read when all is said.

use super::super::said::{entry, table};
use super::super::verbs::Edit;
use super::{Done, Kind, MapError, Outcome, Record, Step, Steps, cm, misprint};
use crate::World;
use crate::file::decode::shortened;
use crate::file::node::{Node, Value};
use crate::file::schema::{Coordinates, Number, ZoneFile, ZoneWord};
use crate::file::write;
use crate::units::{ZoneId, word};

/// A zone as it is told so far.
pub(super) struct Draft {
    pub(super) key: String,
    pub(super) file: ZoneFile,
}

impl Draft {
    pub(super) fn names(&self) -> [&str; 3] {
        [&self.key, &self.file.name, &self.file.name_en]
    }
}

/// A text that is empty is taken back.
fn told(text: &str) -> Option<String> {
    (!text.is_empty()).then(|| text.to_owned())
}

impl Steps<'_> {
    /// The zone, to be changed.
    pub(super) fn zone_mut(&mut self, id: ZoneId) -> &mut ZoneFile {
        let world: &World = &self.world;
        let draft = self.zones.entry(id).or_insert_with(|| {
            let zone = &world.zones[&id];
            Draft { key: zone.key.clone(), file: write::zone_file(world, zone) }
        });
        &mut draft.file
    }

    /// `zone`: a new one, or what is said anew of one that is there.
    pub(super) fn zone(&mut self, step: &Step<'_>, edit: &Edit, is_broken: bool) -> Done {
        let Edit::Zone { name, rooms, map, .. } = edit else { unreachable!("it is of its verb") };
        let elements = step.entry("rooms").map_or(&[][..], |e| e.node.elements());
        let mut keys = Vec::new();
        for (no, room) in rooms.iter().flatten().enumerate() {
            let at = elements.get(no).map_or(step.at("rooms"), |node| &node.span);
            keys.push(self.reference(self.find(room, at, &[Kind::Area])?));
        }
        let rooms = rooms.as_ref().map(|_| keys);
        let map = match map.as_deref() {
            Some("") | None => map.clone(),
            Some(map) => Some(self.reference(self.find(map, step.at("map"), &[Kind::Map])?)),
        };
        let is_new = self.bearers(name, Kind::Zone).is_empty()
            && (self.naming.in_other_words)(name).is_empty();
        let id = match is_new {
            true => self.new_zone(step, edit)?,
            false => match self.find(name, step.span(), &[Kind::Zone])? {
                Record::Zone(id) => id,
                _ => unreachable!("it was looked for among zones"),
            },
        };
        let fields = step.node.entries().iter().filter(|e| e.key != "zone").cloned();
        let record = self.said.of(Record::Zone(id));
        fields.for_each(|field| record.put(field));
        if is_broken {
            self.broken.insert(Record::Zone(id));
        }
        say(self.zone_mut(id), edit, rooms, map);
        Ok(())
    }

    fn new_zone(&mut self, step: &Step<'_>, edit: &Edit) -> Outcome<ZoneId> {
        let Edit::Zone { name, kind, .. } = edit else { unreachable!("it is of its verb") };
        // A kind that could not be read is told already; nothing is read of that zone.
        let unread = step.entry("kind").map(|_| ZoneWord::Closed);
        let kind = kind.or(unread).ok_or_else(|| step.missing("kind"))?;
        // A key has no point, which is what parts keys in a reference.
        let key = name.replace('.', "-");
        if !self.bearers(&key, Kind::Zone).is_empty() {
            let (what, name) = (Kind::Zone.title().into(), shortened(name));
            return Err(misprint(MapError::AlreadyThere { what, name }, step.span()));
        }
        let id = ZoneId(self.fresh_id(Kind::Zone));
        let record = Record::Zone(id);
        self.said.new_record(
            record,
            step.span(),
            table(step.key_span(), vec![step.verb_as("name")]),
        );
        [&key, name].iter().for_each(|name| self.note(name, record));
        let file = ZoneFile { name: name.clone(), ..ZoneFile::of_kind(kind) };
        self.zones.insert(id, Draft { key, file });
        Ok(id)
    }

    /// `move` of a zone: all its corners by an offset, or so that the first one comes to a place.
    pub(super) fn shift_zone(
        &mut self,
        id: ZoneId,
        step: &Step<'_>,
        by: (Option<&Coordinates>, Option<&Coordinates>),
    ) -> Done {
        let corners = self.zone_mut(id).points.clone();
        let Some([x, y]) = corners.first() else {
            let message = word!("the-zone-is-made-of-areas-and");
            return Err(misprint(MapError::BadValue { message: message.into() }, step.span()));
        };
        if let Some(field) = ["area", "carry"].into_iter().find(|f| step.entry(f).is_some()) {
            return Err(step.bad(field, word!("a-zone-has-no-such-thing")));
        }
        let (by, field) = match by {
            (Some(to), None) => ([to.x.get() - x.get(), to.y.get() - y.get()], "to"),
            (None, Some(by)) => ([by.x.get(), by.y.get()], "by"),
            (None, None) => return Err(step.missing("to")),
            (Some(_), Some(_)) => {
                return Err(step.bad("by", word!("give-either-to-or-by")));
            }
        };
        let at = step.at(field);
        let mut moved = Vec::new();
        for [x, y] in &corners {
            moved.push([cm(x.get() + by[0], at)?, cm(y.get() + by[1], at)?].map(Number::from));
        }
        let node = |value| Node { span: at.clone(), value };
        let list = moved.iter().map(|_| node(Value::List(Vec::new()))).collect();
        self.said.of(Record::Zone(id)).put(entry("points", at, Value::List(list)));
        self.zone_mut(id).points = moved;
        Ok(())
    }
}

/// Says anew what a step tells of a zone.
fn say(zone: &mut ZoneFile, edit: &Edit, rooms: Option<Vec<String>>, map: Option<String>) {
    let Edit::Zone {
        kind,
        points,
        speed,
        heading,
        reason,
        reason_en,
        from,
        until,
        name_en,
        forms,
        ..
    } = edit
    else {
        unreachable!("it is of its verb")
    };
    // A zone is told in one way, and has the number that its kind has.
    if rooms.is_some() {
        (zone.points, zone.map) = (Vec::new(), None);
    }
    if points.is_some() {
        zone.rooms = Vec::new();
    }
    if let Some(kind) = kind {
        (zone.kind, zone.speed, zone.heading) = (*kind, None, None);
    }
    zone.rooms = rooms.unwrap_or(std::mem::take(&mut zone.rooms));
    zone.map = map.map_or(zone.map.take(), |map| told(&map));
    if let Some(points) = points {
        zone.points.clone_from(points);
    }
    zone.speed = speed.or(zone.speed);
    zone.heading = heading.or(zone.heading);
    for (field, text) in
        [(&mut zone.reason, reason), (&mut zone.reason_en, reason_en), (&mut zone.name_en, name_en)]
    {
        if let Some(text) = text {
            field.clone_from(text);
        }
    }
    for (field, text) in [(&mut zone.from, from), (&mut zone.until, until)] {
        if let Some(text) = text {
            *field = told(text);
        }
    }
    if let Some(forms) = forms {
        zone.forms.clone_from(forms);
    }
}
