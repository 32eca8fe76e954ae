//! Looking for a thing in a room, from view to view.

use crate::geometry::{Route, Target};
use crate::semantics::planning::{PlaceSource, PlanPlace};
use crate::units::{AreaId, InOrder as _};

use super::belief::Station;
use super::event::{Leg, Surprise};
use super::mission::{Mission, look_round};
use super::reins::Reins;
use super::vehicle::Unfinished;

impl Mission<'_> {
    /// Looks for a thing from here, then from each place of the Area in turn, then from the middles of its Passframes.
    pub(super) fn seek(
        &mut self,
        name: &str,
        reins: &mut Reins<'_>,
        leg: &mut Leg,
    ) -> Result<(), Unfinished<Surprise>> {
        let thing = self.replica(name)?;
        let area = self.belief.area;
        let mut views = self.views_of(area).into_iter();
        loop {
            if let Some(seen) = reins.sees(thing).map_err(Unfinished::Failed)? {
                self.belief.learn(seen);
                self.belief.found.insert(name.to_owned());
                return Ok(());
            }
            let Some((place, target)) = views.next() else {
                let mut searched = self.belief.sought.get(name).cloned().unwrap_or_default();
                searched.insert(area);
                let (next, for_kin) = self.belief.where_else(name, &searched);
                let thing = name.to_owned();
                return Err(Surprise::NotSeen { thing, area, next, for_kin }.into());
            };
            let driven = leg.route.take();
            let called = place.as_deref().unwrap_or(name);
            match (self.go(called, target, &[area], reins, leg), place) {
                (Ok(()), place) => {
                    match place {
                        Some(place) => self.belief.station = Station::Place(place),
                        None => self.name_this_point(),
                    }
                    look_round(reins)?;
                }
                // One looks from elsewhere.
                (Err(Unfinished::Met(Surprise::NoWay { .. })), _) => {}
                (Err(other), _) => return Err(other),
            }
            leg.route = match (driven, leg.route.take()) {
                (Some(first), Some(next)) => Some(Route {
                    points: first
                        .points
                        .into_iter()
                        .chain(next.points.into_iter().skip(1))
                        .collect(),
                    length: first.length + next.length,
                    ..next
                }),
                (first, next) => next.or(first),
            };
        }
    }

    /// From where an Area is looked over: its places by their names, then the largest Passframes, from their middles.
    fn views_of(&self, area: AreaId) -> Vec<(Option<String>, Target)> {
        /// Of more there is no new view to be hoped for.
        const MOST: usize = 12;
        let here = |p: &&PlanPlace| p.area == area && p.source != PlaceSource::Robot;
        let places = self.places.iter().filter(here).map(|p| p.name.clone());
        let mut views: Vec<(Option<String>, Target)> = places
            .filter_map(|name| self.place_target(&name).ok().map(|target| (Some(name), target)))
            .collect();
        let mut cells: Vec<_> = self.belief.floor().passframes(area).iter().collect();
        cells.order_by(|a, b| {
            b.polygon.signed_area().total_cmp(&a.polygon.signed_area()).then(a.id.cmp(&b.id))
        });
        let middles = cells.iter().take(MOST).map(|cell| Target::Point(cell.polygon.centroid()));
        views.extend(middles.map(|target| (None, target)));
        views
    }
}
