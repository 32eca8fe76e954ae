//! Where the large things stand: Areas on a Map, Maps in the Domain, lifts between them.

use super::super::said::{entry, table};
use super::things::EITHER;
use super::{Coordinates, Done, Kind, MapError, Number, Outcome, Record, Step, Steps};
use super::{cm, frame_of, misprint};
use crate::file::node::Value;
use crate::units::{AreaId, Cm, Deg, Frame, MapId, word};
use crate::{DomainMap, LiftStop, MapItem};

/// Where a step says that something stands, and whether that is the base.
pub(super) type Stands<'t> = (Option<&'t Coordinates>, Option<Number>, Option<bool>);

/// Changes a list of which one is the base: the one that says so, or else the first.
pub(super) fn with_base<T>(
    list: &mut Vec<T>,
    is_base: impl Fn(&mut T) -> &mut bool,
    change: impl FnOnce(&mut Vec<T>),
) {
    let marks: Vec<bool> = list.iter_mut().map(|one| *is_base(one)).collect();
    // That the first one is the base goes without saying, until another says that it is.
    if marks.iter().position(|&mark| mark) == Some(0) && marks.iter().filter(|&&m| m).count() == 1 {
        *is_base(&mut list[0]) = false;
    }
    change(list);
    if list.iter_mut().all(|one| !*is_base(one))
        && let Some(first) = list.first_mut()
    {
        *is_base(first) = true;
    }
}

/// What a step says anew of where something stands.
fn restand(frame: &mut Frame, is_base: &mut bool, (at, angle, base): Stands<'_>) {
    if let Some(at) = at {
        let z = at.z.map_or(Cm::ZERO, |z| Cm::of(z.get()));
        *frame = Frame { x: Cm::of(at.x.get()), y: Cm::of(at.y.get()), z, angle: frame.angle };
    }
    if let Some(angle) = angle {
        frame.angle = Deg::of(angle.get());
    }
    *is_base = base.unwrap_or(*is_base);
}

impl Steps<'_> {
    pub(super) fn map_mut(&mut self, id: MapId) -> &mut crate::Map {
        self.world.maps.get_mut(&id).expect("what was found is in the world")
    }

    /// Where an Area stands on a Map; with `relink` what its links say of that is told anew, and the Map keeps its coordinates.
    pub(super) fn stand(
        &mut self,
        step: &Step<'_>,
        name: &str,
        map: Option<&str>,
        stands: Stands<'_>,
        relink: bool,
    ) -> Done {
        let area = self.area(name, step.span())?;
        let map = match map {
            Some(map) => self.map(map, step.at("map"))?,
            None => {
                let mut maps = self.world.maps.keys();
                match (maps.next(), maps.next()) {
                    (Some(only), None) => *only,
                    _ => return Err(step.missing("map")),
                }
            }
        };
        let items = &self.world.maps[&map].items;
        let known = items.iter().position(|item| item.area == area);
        let no = known.unwrap_or(items.len());
        self.tell_standing(step, (Record::Map(map), "items", no), known.is_none(), "area");
        with_base(
            &mut self.map_mut(map).items,
            |i| &mut i.is_base,
            |items| {
                if known.is_none() {
                    items.push(MapItem { area, frame: frame_of(None, None), is_base: false });
                }
                let item = &mut items[no];
                restand(&mut item.frame, &mut item.is_base, stands);
            },
        );
        if relink {
            self.keep_coordinates(area, step.span());
            self.relink(area);
        }
        Ok(())
    }

    /// An Area put elsewhere on the Map on which it stands, with all that is in it; its links say where it lies now.
    pub(super) fn shift_area(
        &mut self,
        area: AreaId,
        step: &Step<'_>,
        (to, by): (Option<&Coordinates>, Option<&Coordinates>),
    ) -> Done {
        if let Some(field) = ["area", "carry"].into_iter().find(|f| step.entry(f).is_some()) {
            let message = word!("an-area-has-no-such-thing");
            return Err(step.bad(field, message));
        }
        let (field, told, is_offset) = match (to, by) {
            (Some(to), None) => ("to", to, false),
            (None, Some(by)) => ("by", by, true),
            (None, None) => return Err(step.missing("to")),
            (Some(_), Some(_)) => return Err(step.bad("by", EITHER)),
        };
        let on = |map: &crate::Map| map.items.iter().position(|item| item.area == area);
        let placed = self.world.maps.values().find_map(|map| Some((map.id, on(map)?)));
        let Some((map, no)) = placed else {
            let message = word!("the-area-stands-on-no-map-put");
            return Err(misprint(MapError::BadValue { message: message.into() }, step.span()));
        };
        let at = step.at(field);
        let was = self.world.maps[&map].items[no].frame;
        let from = |was: Cm| if is_offset { was.get() } else { 0.0 };
        let x = cm(from(was.x) + told.x.get(), at)?;
        let y = cm(from(was.y) + told.y.get(), at)?;
        let z = told.z.map(|z| cm(from(was.z) + z.get(), at)).transpose()?;
        self.map_mut(map).items[no].frame = Frame { x, y, z: z.unwrap_or(was.z), ..was };
        let nodes = step.entry(field).map_or(&[][..], |e| e.node.elements()).to_vec();
        let list = if is_offset { Vec::new() } else { nodes };
        let line = self.said.of(Record::Map(map)).element_at("items", no);
        line.span = step.whole();
        line.put(entry("at", at, Value::List(list)));
        self.keep_coordinates(area, step.span());
        self.relink(area);
        Ok(())
    }

    fn map(&self, name: &str, at: &super::Span) -> Outcome<MapId> {
        match self.find(name, at, &[Kind::Map])? {
            Record::Map(id) => Ok(id),
            _ => unreachable!("it was looked for among Maps"),
        }
    }

    /// Where it is told that something stands: a line of a list.
    fn tell_standing(
        &mut self,
        step: &Step<'_>,
        (record, list, no): (Record, &str, usize),
        is_new: bool,
        what: &str,
    ) {
        let fields = step.copies(&["at", "angle", "base"]);
        let line = self.said.of(record).element_at(list, no);
        if is_new {
            *line = table(step.key_span(), vec![step.verb_as(what)]);
        } else {
            line.span = step.whole();
        }
        fields.into_iter().for_each(|field| line.put(field));
    }

    /// Where a Map stands in the Domain.
    pub(super) fn include(&mut self, step: &Step<'_>, name: &str, stands: Stands<'_>) -> Done {
        let map = self.map(name, step.span())?;
        let maps = &self.world.domain.maps;
        let known = maps.iter().position(|own| own.map == map);
        let no = known.unwrap_or(maps.len());
        self.tell_standing(step, (Record::Domain, "maps", no), known.is_none(), "map");
        with_base(
            &mut self.world.domain.maps,
            |m| &mut m.is_base,
            |maps| {
                if known.is_none() {
                    maps.push(DomainMap { map, frame: Frame::IDENTITY, is_base: false });
                }
                let own = &mut maps[no];
                restand(&mut own.frame, &mut own.is_base, stands);
            },
        );
        Ok(())
    }

    /// A lift, or a flight of stairs, with its stops; one of this name gets these stops.
    pub(super) fn lift(&mut self, step: &Step<'_>, name: &str, stops: &[String]) -> Done {
        let nodes = step.entry("stops").map_or(&[][..], |e| e.node.elements());
        let mut areas = Vec::new();
        for (no, stop) in stops.iter().enumerate() {
            let at = nodes.get(no).map_or(step.at("stops"), |node| &node.span);
            areas.push(LiftStop { area: self.area(stop, at)? });
        }
        let is_it = |(own, _): &(String, Vec<LiftStop>)| own == name;
        while let Some(no) = self.world.domain.lifts.iter().position(is_it) {
            self.world.domain.lifts.remove(no);
            self.said.of(Record::Domain).drop_element("lifts", no);
        }
        let no = self.world.domain.lifts.len();
        self.world.domain.lifts.push((name.to_owned(), areas));
        let list = Value::List(nodes.to_vec());
        let told = vec![step.verb_as("name"), entry("stops", step.at("stops"), list)];
        *self.said.of(Record::Domain).element_at("lifts", no) = table(step.key_span(), told);
        Ok(())
    }
}
