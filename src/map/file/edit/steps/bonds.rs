//! What binds parts together: doors on sides, items of a group, links between faces and between Areas.

use super::word::{Done, Outcome, Step, misprint, table, text_of};
use super::{GROUPS, Steps};
use crate::fault::MapError;
use crate::file::decode::shortened;
use crate::file::edit::tree::{Handle, Kind};
use crate::file::node::{Entry, Node, Value};

impl Steps<'_> {
    pub(super) fn bind(&mut self, step: &Step<'_>) -> Done {
        let door = self.reference(&step.verb.node, &[Kind::Door])?;
        let group = self.find(step.required("to")?, GROUPS)?;
        step.required("side")?;
        let mut mount =
            vec![Entry { key: "door".into(), key_span: step.span().clone(), node: door }];
        mount.extend(step.copies(&["side", "opens"]));
        self.change(group).push("doors", table(&step.verb.key_span, mount));
        Ok(())
    }

    pub(super) fn unbind(&mut self, step: &Step<'_>) -> Done {
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
    pub(super) fn item(&mut self, step: &Step<'_>) -> Done {
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
    pub(super) fn link(&mut self, step: &Step<'_>) -> Done {
        let (owner, from, to) = self.ends(step)?;
        let mut link = vec![
            Entry { key: "from".into(), key_span: from.span.clone(), node: from },
            Entry { key: "to".into(), key_span: to.span.clone(), node: to },
        ];
        link.extend(step.copies(&["rel", "angle"]));
        self.change(owner).push("links", table(&step.verb.key_span, link));
        Ok(())
    }

    pub(super) fn unlink(&mut self, step: &Step<'_>) -> Done {
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
        let wanted = ("«помещение.сторона»", "“area.side”").into();
        let error = match text.split_once('.') {
            None => MapError::BadReference { text: shortened(text), wanted },
            Some((area, _)) => MapError::UnknownReference {
                what: ("Помещение", "Area").into(),
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
}
