//! Records of any kind taken out and renamed, and all that refers to them with them.

use super::super::verbs::Edit;
use super::{Done, Kind, MapError, Record, Span, Step, Steps, misprint, standing};
use crate::file::decode::{likely, shortened};
use crate::file::node::Entry;
use crate::units::{AreaId, Bilingual, name_key, said};
use crate::{Extent, Forms};

impl Steps<'_> {
    /// Takes a record out, with what only it gave a place: an Area's standing on its Map, a door's bindings.
    pub(super) fn remove(&mut self, step: &Step<'_>, name: &str, kind: Option<&str>) -> Done {
        let kinds = self.kinds(step, kind, &Kind::ALL)?;
        let record = self.find(name, step.span(), &kinds)?;
        let name = self.reference(record);
        let users = self.users(record);
        if !users.is_empty() {
            let kind = Kind::of(record).expect("what has a name is of a kind");
            let (what, by) = (kind.title().into(), Bilingual::list(&users));
            return Err(misprint(MapError::StillUsed { what, name, by }, step.span()));
        }
        self.late.note_removal(record, &name, &step.whole());
        match record {
            Record::Replica(id) => {
                self.world.replicas.remove(&id);
                let serving = self.world.places.values().filter(|p| p.serves == Some(id));
                let serving: Vec<_> = serving.map(|p| p.id).collect();
                for place in serving {
                    self.place_mut(place).serves = None;
                }
            }
            Record::Door(id) => {
                self.world.doors.remove(&id);
                for group in self.hung_with(id) {
                    self.take_off(group, id);
                }
            }
            Record::Area(id) => self.remove_area(id, &step.whole()),
            Record::Map(id) => {
                self.world.maps.remove(&id);
                let is_it = self.world.domain.maps.iter().position(|own| own.map == id);
                if let Some(no) = is_it {
                    let maps = &mut self.world.domain.maps;
                    standing::with_base(
                        maps,
                        |m| &mut m.is_base,
                        |maps| {
                            maps.remove(no);
                        },
                    );
                    self.said.of(Record::Domain).drop_element("maps", no);
                }
            }
            Record::Place(id) => drop(self.world.places.remove(&id)),
            Record::Zone(id) => {
                self.zones.remove(&id);
                self.world.zones.remove(&id);
            }
            Record::Object(id) => drop(self.world.objects.remove(&id)),
            Record::Orthoframe(id) => drop(self.world.orthoframes.remove(&id)),
            Record::Domain | Record::Robot | Record::Type(..) => {
                unreachable!("it was looked for among what has a name")
            }
        }
        Ok(())
    }

    /// An Area goes with all that stands in it.
    fn remove_area(&mut self, id: AreaId, at: &Span) {
        self.world.areas.remove(&id);
        let gone: Vec<_> = self.world.replicas_in(id).map(|r| r.id).collect();
        for replica in gone {
            if let Some(replica) = self.world.replicas.remove(&replica) {
                self.late.note_removal(Record::Replica(replica.id), &replica.name, at);
            }
        }
        let gone: Vec<_> =
            self.world.places.values().filter(|p| p.area == id).map(|p| p.id).collect();
        for place in gone {
            if let Some(place) = self.world.places.remove(&place) {
                self.late.note_removal(Record::Place(place.id), &place.name, at);
            }
        }
        let is_of = |map: &&crate::Map| {
            map.items.iter().any(|item| item.area == id)
                || map.links.iter().any(|link| link.area == id || link.to_area == id)
        };
        let maps: Vec<_> = self.world.maps.values().filter(is_of).map(|map| map.id).collect();
        for map in maps {
            let said = Record::Map(map);
            while let Some(no) = self.world.maps[&map].items.iter().position(|item| item.area == id)
            {
                let items = &mut self.map_mut(map).items;
                standing::with_base(
                    items,
                    |i| &mut i.is_base,
                    |items| {
                        items.remove(no);
                    },
                );
                self.said.of(said).drop_element("items", no);
            }
            while let Some(no) =
                self.world.maps[&map].links.iter().position(|l| l.area == id || l.to_area == id)
            {
                self.map_mut(map).links.remove(no);
                self.said.of(said).drop_element("links", no);
            }
        }
    }

    /// What could not be without a record, and does not go with it.
    fn users(&self, record: Record) -> Vec<Bilingual> {
        let quoted = |text: &str| Bilingual::quoted(text);
        let zones = |of: &dyn Fn(&Extent) -> bool, told: &dyn Fn(&super::Draft) -> bool| {
            let drafts = self.zones.values().filter(|draft| told(draft));
            let untouched = self.world.zones.values().filter(|z| !self.zones.contains_key(&z.id));
            let mut all: Vec<&str> =
                untouched.filter(|zone| of(&zone.extent)).map(|zone| &*zone.key).collect();
            all.extend(drafts.map(|draft| &*draft.key));
            all.into_iter().map(quoted).collect()
        };
        let key = self.reference(record);
        match record {
            Record::Object(id) => {
                let mut all: Vec<_> = self.world.replicas_of(|of| of == id).collect();
                all.sort_by_key(|r| (r.area, r.id));
                all.into_iter().map(|r| quoted(&r.name)).collect()
            }
            Record::Orthoframe(id) => {
                let areas = self.world.areas_made_of(|of| of == id).map(|a| quoted(&a.key));
                areas
                    .chain(self.world.objects_made_of(|of| of == id).map(|o| quoted(&o.key)))
                    .collect()
            }
            Record::Area(id) => zones(
                &|extent| matches!(extent, Extent::Areas(areas) if areas.contains(&id)),
                &|draft| draft.file.rooms.contains(&key),
            ),
            Record::Map(id) => zones(
                &|extent| matches!(extent, Extent::Polygon { map, .. } if *map == id),
                &|draft| draft.file.map.as_ref() == Some(&key),
            ),
            Record::Place(id) if self.world.robot.start == Some(id) => {
                vec![said!("the-robot-starts-from-here")]
            }
            _ => Vec::new(),
        }
    }

    /// A new name. Word forms of the old name do not fit the new one.
    pub(super) fn rename(&mut self, step: &Step<'_>, edit: &Edit) -> Done {
        let Edit::Rename { name, to, en, forms, kind } = edit else {
            unreachable!("it is of its verb")
        };
        let kinds = self.kinds(step, kind.as_deref(), &Kind::ALL)?;
        let record = self.find(name, step.span(), &kinds)?;
        if to.is_none() && en.is_none() {
            return Err(step.missing("to"));
        }
        let called = name_key(name);
        let key = self.reference(record);
        let mut named = self.named_mut(record);
        if let Some(to) = to {
            let is_called = |name: &str| !name.is_empty() && name_key(name) == called;
            // Called by its English name, it has that no more.
            if is_called(named.name_en) && (*named.name == key || !is_called(named.name)) {
                named.name_en.clear();
            }
            named.name.clone_from(to);
            if to.is_empty() && !matches!(record, Record::Replica(_) | Record::Place(_)) {
                *named.name = key;
            }
            named.forms.iter_mut().for_each(|forms| forms.clear());
        }
        if let Some(en) = en {
            named.name_en.clone_from(en);
        }
        let has_forms = named.forms.is_some();
        if let (Some(own), Some(forms)) = (&mut named.forms, forms) {
            own.clone_from(forms);
        }
        let said = self.said.of(record);
        for (told, field) in [("to", "name"), ("en", "name_en"), ("forms", "forms")] {
            if let Some(told) = step.entry(told) {
                let node = told.node.clone();
                said.put(Entry { key: field.to_owned(), key_span: node.span.clone(), node });
            } else if field == "forms" && to.is_some() {
                said.drop_entry(field);
            }
        }
        if let Some(to) = to {
            self.note(to, record);
        }
        match step.entry("forms") {
            Some(told) if !has_forms => {
                let fields = ["to", "en", "kind"];
                let error = MapError::UnknownField {
                    field: shortened("forms"),
                    nearest: likely("forms", &fields),
                    expected: fields.join(", "),
                };
                Err(misprint(error, &told.key_span))
            }
            _ => Ok(()),
        }
    }

    /// The names of a record, and the forms of its name if it has any.
    fn named_mut(&mut self, record: Record) -> Named<'_> {
        macro_rules! of {
            ($records:ident, $id:expr, with forms) => {{
                let record = self.world.$records.get_mut(&$id).expect("it was found");
                let forms = Some(&mut record.forms);
                Named { name: &mut record.name, name_en: &mut record.name_en, forms }
            }};
            ($records:ident, $id:expr) => {{
                let record = self.world.$records.get_mut(&$id).expect("it was found");
                Named { name: &mut record.name, name_en: &mut record.name_en, forms: None }
            }};
        }
        match record {
            Record::Replica(id) => of!(replicas, id, with forms),
            Record::Place(id) => of!(places, id, with forms),
            Record::Area(id) => of!(areas, id, with forms),
            Record::Door(id) => of!(doors, id, with forms),
            Record::Map(id) => of!(maps, id),
            Record::Object(id) => of!(objects, id),
            Record::Orthoframe(id) => of!(orthoframes, id),
            Record::Zone(id) => {
                let zone = self.zone_mut(id);
                let forms = Some(&mut zone.forms);
                Named { name: &mut zone.name, name_en: &mut zone.name_en, forms }
            }
            Record::Domain | Record::Robot | Record::Type(..) => {
                unreachable!("it was looked for among what has a name")
            }
        }
    }
}

struct Named<'r> {
    name: &'r mut String,
    name_en: &'r mut String,
    forms: Option<&'r mut Forms>,
}
