//! What binds parts together: doors on sides, items of a group, links between faces and between Areas.

use std::sync::Arc;

use super::super::said::table;
use super::standing::{self, Stands};
use super::{Done, Frame, Kind, MapError, Outcome, Record, Span, Step, Steps, frame_of, misprint};
use crate::file::decode::shortened;
use crate::units::{AreaId, said};
use crate::{DoorMount, Item, ItemLink, MapLink, OpensTo, SideRef};

/// What is made of Orthoframes.
const GROUPS: &[Kind] = &[Kind::Area, Kind::Object];

impl Steps<'_> {
    fn items(&self, group: Record) -> &[Item] {
        match group {
            Record::Area(id) => &self.world.areas[&id].items,
            Record::Object(id) => &self.world.objects[&id].items,
            _ => unreachable!("an Area or an Object"),
        }
    }

    fn mounts_mut(&mut self, group: Record) -> &mut Vec<DoorMount> {
        match group {
            Record::Area(id) => &mut self.area_mut(id).doors,
            Record::Object(id) => &mut self.world.objects.get_mut(&id).expect("it was found").doors,
            _ => unreachable!("an Area or an Object"),
        }
    }

    fn item_links_mut(&mut self, group: Record) -> &mut Vec<ItemLink> {
        match group {
            Record::Area(id) => &mut self.area_mut(id).links,
            Record::Object(id) => &mut self.world.objects.get_mut(&id).expect("it was found").links,
            _ => unreachable!("an Area or an Object"),
        }
    }

    pub(super) fn area_mut(&mut self, id: AreaId) -> &mut crate::Area {
        self.world.areas.get_mut(&id).expect("what was found is in the world")
    }

    pub(super) fn bind(
        &mut self,
        step: &Step<'_>,
        door: &str,
        to: &str,
        side: &str,
        opens: OpensTo,
    ) -> Done {
        let door = self.find(door, step.span(), &[Kind::Door])?;
        let Record::Door(door) = door else { unreachable!("it was looked for among doors") };
        let group = self.find(to, step.at("to"), GROUPS)?;
        let items = self.items(group).to_vec();
        let no = self.mounts_mut(group).len();
        let mut told = vec![step.verb_as("door")];
        told.extend(step.copies(&["side", "opens"]));
        *self.said.of(group).element_at("doors", no) = table(step.key_span(), told);
        let spot = crate::Spot::of(group).field("doors").index(no).field("side");
        let side = self.reading(|reader| reader.side(side, &items, spot));
        if let Some(SideRef { item, side }) = side {
            self.mounts_mut(group).push(DoorMount { item, side, door, opens });
        }
        Ok(())
    }

    pub(super) fn unbind(&mut self, step: &Step<'_>, name: &str, from: Option<&str>) -> Done {
        let record = self.find(name, step.span(), &[Kind::Door])?;
        let Record::Door(door) = record else { unreachable!("it was looked for among doors") };
        let groups = match from {
            Some(from) => vec![self.find(from, step.at("from"), GROUPS)?],
            None => self.hung_with(door),
        };
        let mut any = false;
        for group in groups {
            any |= self.take_off(group, door);
        }
        let error = || MapError::NotBound { door: self.reference(record) };
        if any { Ok(()) } else { Err(misprint(error(), step.span())) }
    }

    /// The Areas and Objects in which a door hangs.
    pub(super) fn hung_with(&self, door: crate::units::DoorId) -> Vec<Record> {
        let areas = self.world.areas_hung_with(|id| id == door).map(|a| Record::Area(a.id));
        let objects = self.world.objects_hung_with(|id| id == door).map(|o| Record::Object(o.id));
        areas.chain(objects).collect()
    }

    /// Takes a door off an Area or Object; says whether it hung there.
    pub(super) fn take_off(&mut self, group: Record, door: crate::units::DoorId) -> bool {
        let mut any = false;
        while let Some(no) = self.mounts_mut(group).iter().position(|m| m.door == door) {
            self.mounts_mut(group).remove(no);
            self.said.of(group).drop_element("doors", no);
            any = true;
        }
        any
    }

    /// Another part of an Object or Area.
    pub(super) fn item(
        &mut self,
        step: &Step<'_>,
        id: &str,
        (of, orthoframe): (&str, &str),
        (at, angle, base): Stands<'_>,
    ) -> Done {
        let group = self.find(of, step.at("of"), GROUPS)?;
        let part = self.find(orthoframe, step.at("orthoframe"), &[Kind::Orthoframe])?;
        let Record::Orthoframe(orthoframe) = part else { unreachable!("looked for among these") };
        let no = self.items(group).len();
        let mut told = vec![step.verb_as("id")];
        told.extend(step.copies(&["orthoframe", "at", "angle", "base"]));
        *self.said.of(group).element_at("items", no) = table(step.key_span(), told);
        let frame = frame_of(at, angle);
        let item = Item { id: id.to_owned(), orthoframe, frame, is_base: base == Some(true) };
        standing::with_base(self.items_mut(group), |i| &mut i.is_base, |items| items.push(item));
        Ok(())
    }

    pub(super) fn items_mut(&mut self, group: Record) -> &mut Vec<Item> {
        match group {
            Record::Area(id) => &mut self.area_mut(id).items,
            Record::Object(id) => &mut self.world.objects.get_mut(&id).expect("it was found").items,
            _ => unreachable!("an Area or an Object"),
        }
    }

    /// Binds faces of two parts of an Object or Area, or sides of two Areas of a Map.
    pub(super) fn link(
        &mut self,
        step: &Step<'_>,
        (from, to): (&str, &str),
        of: Option<&str>,
        offset: Frame,
    ) -> Done {
        let Frame { x: rel_x, y: rel_y, z: rel_z, angle: rel_a } = offset;
        let owner = self.owner(step, (from, to), of)?;
        let mut told = vec![step.verb_as("from")];
        told.extend(step.copies(&["to", "rel", "angle"]));
        let told = table(step.key_span(), told);
        match owner {
            Owner::Map(map, [(area, side), (to_area, to_side)]) => {
                let no = self.world.maps[&map].links.len();
                *self.said.of(Record::Map(map)).element_at("links", no) = told;
                let [side, to_side] =
                    self.sides_of_map(map, no, [(area, &side), (to_area, &to_side)]);
                if let (Some(side), Some(to_side)) = (side, to_side) {
                    let link = MapLink { area, side, to_area, to_side, rel_x, rel_y, rel_z, rel_a };
                    self.map_mut(map).links.push(Arc::new(link));
                }
            }
            Owner::Group(group) => {
                let no = self.item_links_mut(group).len();
                *self.said.of(group).element_at("links", no) = told;
                let spot = crate::Spot::of(group).field("links").index(no);
                let ends = self.reading(|reader| {
                    let from = reader.face(from, spot.clone().field("from"));
                    from.zip(reader.face(to, spot.field("to")))
                });
                if let Some(((item, face), (to_item, to_face))) = ends {
                    let link =
                        ItemLink { item, face, to_item, to_face, rel_x, rel_y, rel_z, rel_a };
                    self.item_links_mut(group).push(link);
                }
            }
        }
        Ok(())
    }

    /// Sides of Areas «item.side», or of the only item «side»; what cannot be one is a fault of that link of the Map.
    fn sides_of_map(
        &mut self,
        map: crate::units::MapId,
        no: usize,
        sides: [(AreaId, &str); 2],
    ) -> [Option<SideRef>; 2] {
        let [from, to] = sides.map(|(area, side)| (self.world.areas[&area].items.clone(), side));
        let spot = crate::Spot::of(Record::Map(map)).field("links").index(no);
        self.reading(|reader| {
            let one = reader.side(from.1, &from.0, spot.clone().field("from"));
            [one, reader.side(to.1, &to.0, spot.field("to"))]
        })
    }

    pub(super) fn unlink(
        &mut self,
        step: &Step<'_>,
        (from, to): (&str, &str),
        of: Option<&str>,
    ) -> Done {
        let mut any = false;
        match self.owner(step, (from, to), of)? {
            Owner::Map(map, ends) => {
                let side = |(area, side): &(AreaId, String)| {
                    let (item, side) = match side.rsplit_once('.') {
                        Some((item, side)) => (item.to_owned(), side),
                        None => (self.world.areas[area].items.first()?.id.clone(), side.as_str()),
                    };
                    Some((*area, SideRef { item, side: side.to_owned() }))
                };
                if let [Some(one), Some(other)] = ends.each_ref().map(side) {
                    let is_it = |link: &Arc<MapLink>| {
                        let own =
                            [(link.area, link.side.clone()), (link.to_area, link.to_side.clone())];
                        let [a, b] = own;
                        (a == one && b == other) || (a == other && b == one)
                    };
                    while let Some(no) = self.world.maps[&map].links.iter().position(is_it) {
                        self.map_mut(map).links.remove(no);
                        self.said.of(Record::Map(map)).drop_element("links", no);
                        any = true;
                    }
                }
            }
            Owner::Group(group) => {
                let spot = || crate::Spot::of(group);
                let ends =
                    self.reading(|reader| reader.face(from, spot()).zip(reader.face(to, spot())));
                if let Some((one, other)) = ends {
                    let is_it = |link: &ItemLink| {
                        let a = (link.item.clone(), link.face.clone());
                        let b = (link.to_item.clone(), link.to_face.clone());
                        (a == one && b == other) || (a == other && b == one)
                    };
                    while let Some(no) = self.item_links_mut(group).iter().position(is_it) {
                        self.item_links_mut(group).remove(no);
                        self.said.of(group).drop_element("links", no);
                        any = true;
                    }
                }
            }
        }
        let error = || MapError::NotLinked { link: format!("{from} - {to}") };
        if any { Ok(()) } else { Err(misprint(error(), step.span())) }
    }

    /// Where a link stands, and on a Map between which sides.
    fn owner(&self, step: &Step<'_>, (from, to): (&str, &str), of: Option<&str>) -> Outcome<Owner> {
        let told = match of {
            Some(of) => {
                let kinds = [Kind::Map, Kind::Object, Kind::Area];
                Some(self.find(of, step.at("of"), &kinds)?)
            }
            None => None,
        };
        if let Some(group @ (Record::Object(_) | Record::Area(_))) = told {
            return Ok(Owner::Group(group));
        }
        let from = self.side_of_area(from, step.span())?;
        let to = self.side_of_area(to, step.at("to"))?;
        let map = match told {
            Some(Record::Map(map)) => map,
            _ => {
                let holds = |map: &&crate::Map| map.items.iter().any(|i| i.area == from.0);
                let map = self.world.maps.values().find(holds);
                map.map(|map| map.id).ok_or_else(|| {
                    let area = self.reference(Record::Area(from.0));
                    misprint(MapError::AreaNowhereYet { area }, step.span())
                })?
            }
        };
        Ok(Owner::Map(map, [from, to]))
    }

    /// «Комната-В.F» as the Area and the rest.
    fn side_of_area(&self, text: &str, at: &Span) -> Outcome<(AreaId, String)> {
        for (dot, _) in text.rmatch_indices('.') {
            if let Ok(area) = self.area(&text[..dot], at) {
                return Ok((area, text[dot + 1..].to_owned()));
            }
        }
        let wanted = said!("area-side");
        let error = match text.split_once('.') {
            None => MapError::BadReference { text: shortened(text), wanted },
            Some((area, _)) => MapError::UnknownReference {
                what: Kind::Area.title().into(),
                name: shortened(area),
                nearest: self.nearest(area, &[Kind::Area]),
            },
        };
        Err(misprint(error, at))
    }
}

/// Where a link stands.
enum Owner {
    Map(crate::units::MapId, [(AreaId, String); 2]),
    Group(Record),
}
