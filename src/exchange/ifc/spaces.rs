//! Spaces → rooms: the floor of a space's bodies.

use std::collections::HashSet;

use crate::map::Properties;
use crate::units::{Cm, said, word};
use crate::{ReadError, Room, Treatment, What, outline};

use super::body::{Body, together};
use super::building::{Reader, source};
use super::shape::{Else, Source};
use super::step::{FORMAT, Instance};

const MOST_ROOMS: usize = 200_000;
/// Bodies of one space that begin so much above the lowest, in cm, add nothing to its floor.
const STEP: f64 = 50.0;

impl Reader<'_> {
    pub(super) fn spaces(&mut self) -> Result<(), ReadError> {
        let spaces: Vec<(u32, &Instance)> = self.all.all("IFCSPACE").collect();
        if spaces.len() > MOST_ROOMS {
            return Err(ReadError::TooMany {
                format: FORMAT,
                what: said!("rooms"),
                limit: MOST_ROOMS,
            });
        }
        let is_space = |id: &u32| self.all.get(*id).is_some_and(|s| s.kind == "IFCSPACE");
        let wholes: HashSet<u32> = spaces
            .iter()
            .filter_map(|(id, _)| self.wholes.get(id))
            .filter(|id| is_space(id))
            .copied()
            .collect();
        for (id, space) in spaces {
            let source = source(space, id);
            if wholes.contains(&id) {
                let text = word!("the-room-consists-of-others");
                self.tell((Treatment::Noted, What::Room), (1, 1), &source, text);
                continue;
            }
            // A whole storey's area, for sums of money.
            if space.at(9).word() == Some("GFA") {
                let text = word!("this-is-a-storey-s");
                self.tell((Treatment::Noted, What::Room), (1, 0), &source, text);
                continue;
            }
            let place = self.place_of(space);
            let (bodies, from) = self.shapes.of_product(space.at(6), &place, Else::Footprint);
            if bodies.is_empty() {
                let text = word!("the-room-has-neither-a");
                self.lose(What::Room, &source, text);
                continue;
            }
            self.space(id, space, &bodies, from);
        }
        Ok(())
    }

    fn space(&mut self, id: u32, space: &Instance, bodies: &[Body], from: Source) {
        let source = source(space, id);
        let heights = || bodies.iter().filter_map(Body::heights);
        let low = heights().map(|h| h.0).fold(f64::INFINITY, f64::min);
        let high = heights().map(|h| h.1).fold(f64::NEG_INFINITY, f64::max);
        let effort = &mut self.shapes.effort;
        let lowest = bodies.iter().filter(|b| b.heights().is_some_and(|h| h.0 <= low + STEP));
        let floors: Vec<_> = lowest.flat_map(|b| b.floor(effort)).collect();
        let floors = together(&floors, effort);
        let largest = floors.iter().max_by(|a, b| a.area().total_cmp(&b.area()));
        let ring = |ring: &[crate::units::Point]| {
            let ring = outline::ring(ring.iter().copied())?;
            (ring.len() <= outline::MOST_CORNERS).then_some(ring)
        };
        let Some((floor, outline)) = largest.and_then(|f| Some((f, ring(&f.outer)?))) else {
            let text = word!("the-outline-has-no-area-or");
            return self.lose(What::Room, &source, text);
        };
        if floors.iter().any(|f| f != floor && f.area() > 0.1 * floor.area()) {
            let text = word!("the-room-s-floor-is");
            self.tell((Treatment::Mended, What::Room), (0, 0), &source, text);
        }
        if bodies.iter().any(|b| b.is_round) {
            let text = word!("the-walls-are-curved-the");
            self.tell((Treatment::Mended, What::Room), (0, 0), &source, text);
        }
        let holes = floor.holes.iter().filter_map(|h| ring(h)).collect();
        let level = self.level_of(id, low);
        let (number, long) = (space.at(2).text(), space.at(7).text());
        let name = match (long, number) {
            (Some(long), Some(number)) if long != number => format!("{long} {number}"),
            (long, number) => long.or(number).unwrap_or_default().to_owned(),
        };
        let kind = long.or(space.at(4).text()).or(number).unwrap_or_default().to_owned();
        let mut properties = Properties::new();
        for (key, value) in [("ifc:Name", number), ("ifc:ObjectType", space.at(4).text())] {
            properties.extend(value.map(|v| (key.to_owned(), v.to_owned())));
        }
        let rooms = &mut self.survey.levels[level].rooms;
        self.rooms.insert(id, (level, rooms.len()));
        let height = Cm::new(high - low).ok().filter(|_| from != Source::Footprint);
        rooms.push(Room {
            source,
            name,
            kind,
            called: String::new(),
            outline,
            holes,
            height: height.filter(|h| h.get() >= 50.0),
            properties,
        });
    }
}
