//! Records of any kind taken out and renamed, and all that refers to them with them.

use super::word::{Done, Step, misprint, text_of};
use super::{GROUPS, Steps};
use crate::fault::MapError;
use crate::file::edit::tree::{Handle, Kind};
use crate::file::node::{Entry, Node, Value};
use crate::units::{Bilingual, name_key};

impl Steps<'_> {
    /// Takes a record out, with what only it gave a place: an Area's standing on its Map, a door's bindings.
    pub(super) fn remove(&mut self, step: &Step<'_>) -> Done {
        let kinds = self.kinds(step, &Kind::ALL)?;
        let at = self.find(&step.verb.node, &kinds)?;
        let name = self.tree.reference(at);
        let users = self.users(at, &name);
        if !users.is_empty() {
            let (what, by) = (at.kind.title().into(), Bilingual::list(&users));
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
            Kind::Place | Kind::Zone | Kind::Object | Kind::Orthoframe => {}
        }
        Ok(())
    }

    /// What could not be without a record, and does not go with it.
    fn users(&self, at: Handle, name: &str) -> Vec<Bilingual> {
        let is =
            |node: &Node, field: &str| node.entry(field).and_then(|e| e.node.text()) == Some(name);
        let lines = |owner: Handle, list: &str, field: &str| -> Vec<&Node> {
            let nodes = self.tree.get(owner).and_then(|n| n.entry(list));
            let nodes = nodes.map_or(&[][..], |e| e.node.elements());
            nodes.iter().filter(|n| is(n, field)).collect()
        };
        let quoted = Bilingual::quoted;
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
            Kind::Area => {
                let names = |zone: &Handle| {
                    let rooms = self.tree.get(*zone).and_then(|n| n.entry("rooms"));
                    let rooms = rooms.map_or(&[][..], |e| e.node.elements());
                    rooms.iter().any(|room| room.text() == Some(name))
                };
                let zones = self.tree.all(Kind::Zone).into_iter().filter(names);
                zones.map(|zone| quoted(&self.tree.reference(zone))).collect()
            }
            Kind::Map => {
                let zones = self.tree.all(Kind::Zone).into_iter();
                let on = zones.filter(|zone| self.tree.get(*zone).is_some_and(|n| is(n, "map")));
                on.map(|zone| quoted(&self.tree.reference(zone))).collect()
            }
            Kind::Place => {
                let robot = self.tree.section("robot").iter().find(|e| e.key == "start");
                let starts = robot.is_some_and(|e| e.node.text() == Some(name));
                if starts {
                    vec![("робот начинает отсюда", "the robot starts from here").into()]
                } else {
                    Vec::new()
                }
            }
            _ => Vec::new(),
        }
    }

    /// A new name; what refers to the old one follows. Word forms of the old name do not fit the new one.
    pub(super) fn rename(&mut self, step: &Step<'_>) -> Done {
        let kinds = self.kinds(step, &Kind::ALL)?;
        let at = self.find(&step.verb.node, &kinds)?;
        let old = self.tree.reference(at);
        if step.field("to").is_none() && step.field("en").is_none() {
            return Err(misprint(MapError::MissingField { field: "to" }, &step.verb.key_span));
        }
        if let Some(to) = step.field("to") {
            let new = text_of(to)?.to_owned();
            let called = text_of(&step.verb.node).map(name_key)?;
            let record = self.change(at);
            let is_called = |field: &str| {
                let name = record.entry(field).and_then(|e| e.node.text());
                name.is_some_and(|name| name_key(name) == called)
            };
            // Called by its English name, it has that no more.
            if is_called("name_en") && !is_called("name") {
                record.drop_entry("name_en");
            }
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
}
