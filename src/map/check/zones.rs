//! Zones: a region that is one, of something that is there, for a time that can be.

use std::collections::BTreeSet;

use crate::fault::{COORDINATE, MORE_THAN_0, MapError, Record, Spot, WITHIN};
use crate::units::{Bilingual, Cm, Piece, said, word};
use crate::{Extent, Zone, ZoneKind};

use super::plane::{doubled_area, edges, meeting};
use super::{Checker, at};

/// Corners that a zone may have; the check for crossings is quadratic.
const MOST_CORNERS: usize = 500;
/// A region of less, in cm², is none.
const LEAST_AREA: f64 = 1.0;

impl Checker<'_> {
    pub(super) fn zones(&mut self) {
        let mut keys = BTreeSet::new();
        let id = |record: &Record| match record {
            Record::Zone(id) => Some(*id),
            _ => None,
        };
        for zone in self.asked(("zones", &self.world.zones), id, |z| &z.key) {
            let record = Record::Zone(zone.id);
            let spot = Spot::of(record);
            self.key(&mut keys, &zone.key, word!("zone-title"), &spot);
            if !self.is_broken(record) && self.asks_for(record) {
                self.zone(zone, &spot);
            }
        }
    }

    fn zone(&mut self, zone: &Zone, spot: &Spot) {
        let owner = Bilingual::named(word!("zone"), &zone.name);
        if let ZoneKind::Slow { speed } = zone.kind {
            self.in_range("speed", speed, speed > 0.0, MORE_THAN_0, spot.clone().field("speed"));
        }
        if let (Some(from), Some(until)) = (zone.from, zone.until)
            && until <= from
        {
            self.zone_fault(
                owner.clone(),
                word!("until-is-not-after-from-it-is"),
                spot.clone().field("until"),
            );
        }
        match &zone.extent {
            Extent::Areas(areas) => {
                if areas.is_empty() {
                    let none = word!("it-is-nowhere");
                    self.zone_fault(owner.clone(), none, spot.clone());
                }
                for (i, area) in areas.iter().enumerate() {
                    let at = spot.clone().field("rooms").index(i);
                    let exists = self.world.areas.contains_key(area);
                    self.exists(exists, &owner, word!("area"), area.0, at.clone());
                    if areas[..i].contains(area) {
                        let twice = word!("an-area-is-named-twice");
                        self.zone_fault(owner.clone(), twice, at);
                    }
                }
            }
            Extent::Polygon { map, corners } => {
                let exists = self.world.maps.contains_key(map);
                self.exists(exists, &owner, word!("map-2"), map.0, spot.clone().field("map"));
                self.outline(&owner, corners, &spot.clone().field("points"));
            }
        }
    }

    fn outline(&mut self, owner: &Bilingual, corners: &[crate::units::Point], spot: &Spot) {
        if !(3..=MOST_CORNERS).contains(&corners.len()) {
            let (what, value) = ("points".into(), corners.len() as f64);
            let range = said!("from-3-to-500-corners");
            return self.fault(MapError::OutOfRange { what, value, range }, spot.clone());
        }
        let numbers = corners.iter().enumerate().flat_map(|(i, p)| [(i, p.x), (i, p.y)]);
        if let Some((i, value)) = numbers.into_iter().find(|(_, n)| Cm::new(*n).is_err()) {
            let (what, range) = (COORDINATE.into(), WITHIN.into());
            let at = spot.clone().index(i);
            return self.fault(MapError::OutOfRange { what, value, range }, at);
        }
        if doubled_area(corners).abs() < 2.0 * LEAST_AREA {
            let flat = word!("it-has-no-area");
            return self.zone_fault(owner.clone(), flat, spot.clone());
        }
        let sides: Vec<_> = edges(corners).collect();
        for (i, one) in sides.iter().enumerate() {
            for (j, other) in sides.iter().enumerate().skip(i + 2) {
                let follows = i == 0 && j + 1 == sides.len();
                let Some(p) = meeting(*one, *other).filter(|_| !follows) else { continue };
                let message = said!("its-outline-crosses-itself-at", p = at(p));
                return self.fault(
                    MapError::BadZone { owner: owner.clone(), message },
                    spot.clone().index(i),
                );
            }
        }
    }

    fn zone_fault(&mut self, owner: Bilingual, message: Piece, spot: Spot) {
        self.fault(MapError::BadZone { owner, message: message.into() }, spot);
    }
}
