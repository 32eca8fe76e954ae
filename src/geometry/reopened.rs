//! The openings of an edited building: sides that changed, and those that may make an opening with them, are looked at; what
//! the others make is taken over.
//!
//! Two sides may make an opening where the Map links them, where one door is mounted on both, where they face each other, and
//! where each is met by stepping through the other. So sides fall into groups, and what a group makes depends on the group
//! alone: a group of which a side changed is paired anew, whole.
//!
//! **Invariant**: they are those that [`Openings::of`] measures in the edited world, but for the names that openings had.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::map::{Area, MapLink, SideRef, World};
use crate::units::{AreaId, DoorId, Gather as _, InOrder as _, MapId};

use super::Bounds;
use super::opening::{OpenSide, Opening};
use super::openings::{
    FOOTHOLD, Floors, Openings, Place, Stand, face_each_other, open_sides, paired,
};
use super::scene::PlacedArea;

/// With so many sides to pair, or Areas to look at, measuring all costs less.
const MOST: usize = 400;

impl Openings {
    /// Follows to an edited world in which these `areas` are bounded otherwise, stand elsewhere, are new or gone, and these
    /// `doors` are others; `reach` as in [`Openings::of`]. What is measured anew has no name, and joins what it measures to
    /// join. None where measuring all costs less.
    #[must_use]
    pub fn follow(
        &self,
        before: &World,
        after: &World,
        reach: f64,
        areas: &BTreeSet<AreaId>,
        doors: &BTreeSet<DoorId>,
    ) -> Option<Self> {
        let stands_twice = |stands: &[Stand]| stands.windows(2).any(|w| w[0].area == w[1].area);
        if stands_twice(&self.stands) || areas.len() > MOST {
            return None;
        }
        let is_other = |stand: &&Stand| areas.contains(&stand.area);
        let mut changed: Vec<(MapId, Bounds)> =
            self.stands.iter().filter(is_other).map(|stand| (stand.map, stand.bounds)).collect();
        let mut stands: Vec<Stand> =
            self.stands.iter().filter(|stand| !areas.contains(&stand.area)).cloned().collect();
        for map in after.maps.values() {
            for item in map.items.iter().filter(|item| areas.contains(&item.area)) {
                if after.areas.contains_key(&item.area) {
                    let placed = PlacedArea::new(after, item.area, item.frame);
                    stands.push(Stand::of(map.id, &placed));
                    changed.push((map.id, stands[stands.len() - 1].bounds));
                }
            }
        }
        stands.order_by_key(|stand| (stand.area, stand.map));
        if stands_twice(&stands) {
            return None;
        }
        let new_links: Vec<&Arc<MapLink>> =
            after.maps.values().flat_map(|map| &map.links).collect();
        let mut anew = Anew {
            world: after,
            reach,
            linked: Linked::by(new_links.clone()),
            mounted: OnceCell::new(),
            stands: &stands,
            placed: BTreeMap::new(),
            sides: BTreeMap::new(),
            group: BTreeMap::new(),
            queue: Vec::new(),
        };
        for &area in areas {
            anew.take(area, |_| true);
        }
        anew.take_near(&changed);
        for opening in self.iter().filter(|o| o.sides.iter().any(|s| areas.contains(&s.area))) {
            opening.sides.iter().for_each(|side| anew.take_side(side.area, &side.side));
        }
        let old_links: Vec<&Arc<MapLink>> =
            before.maps.values().flat_map(|map| &map.links).collect();
        let is_of_changed =
            |link: &&Arc<MapLink>| areas.contains(&link.area) || areas.contains(&link.to_area);
        let told: Vec<&Arc<MapLink>> = [&old_links, &new_links]
            .into_iter()
            .flat_map(|links| links.iter().copied().filter(is_of_changed))
            .chain(differing(&old_links, &new_links))
            .collect();
        for link in told {
            anew.take_side(link.area, &link.side);
            anew.take_side(link.to_area, &link.to_side);
        }
        let mounted = [before, after].into_iter().flat_map(|world| {
            let rooms = areas.iter().filter_map(|area| world.areas.get(area));
            rooms.flat_map(|area| area.doors.iter().map(|mount| mount.door))
        });
        anew.take_mounts(&doors.iter().copied().chain(mounted).collect());
        let (world, reach) = (after, anew.reach);
        let group = anew.closed()?;
        let Anew { placed, .. } = anew;

        let is_in = |side: &OpenSide| group.iter().any(|(_, own)| is_same(own, side));
        let own: BTreeSet<AreaId> = group.iter().map(|(place, _)| place.1).gather();
        let is_kept = |opening: &Opening| {
            let is_other =
                |s: &OpenSide| areas.contains(&s.area) || own.contains(&s.area) && is_in(s);
            !opening.sides.iter().any(is_other)
        };
        let mut all: Vec<(Place, Arc<Opening>)> =
            self.placed().filter(|(_, o)| is_kept(o)).map(|(at, o)| (at, Arc::clone(o))).collect();
        let mut group = group.into_iter().peekable();
        while let Some(map) = group.peek().map(|(place, _)| place.0) {
            let mut sides = Vec::new();
            while let Some(side) = group.next_if(|(place, _)| place.0 == map) {
                sides.push(side);
            }
            let found = paired(world, map, sides, &placed, reach).into_iter();
            all.extend(found.map(|(first, opening)| (first, Arc::new(opening))));
        }
        all.order_by_key(|(first, _)| *first);
        Some(Self::numbered(all.into_iter(), stands, reach))
    }
}

fn is_same(one: &OpenSide, other: &OpenSide) -> bool {
    one.area == other.area && one.side == other.side
}

/// A side of an Area.
type End<'w> = (AreaId, &'w SideRef);

/// Links, found by the Areas that they link.
struct Linked<'w> {
    links: Vec<&'w Arc<MapLink>>,
    /// Each end of each link: its Area, and the number of the link twice, and one more at its other end; sorted.
    ends: Vec<(AreaId, usize)>,
}

impl<'w> Linked<'w> {
    fn by(links: Vec<&'w Arc<MapLink>>) -> Self {
        let both =
            |(n, link): (usize, &&Arc<MapLink>)| [(link.area, 2 * n), (link.to_area, 2 * n + 1)];
        let mut ends: Vec<(AreaId, usize)> = links.iter().enumerate().flat_map(both).collect();
        ends.sort_unstable();
        Self { links, ends }
    }

    /// The links of an Area's sides in their order, its own end first.
    fn of(&self, area: AreaId) -> impl Iterator<Item = [End<'w>; 2]> {
        let from = self.ends.partition_point(|(own, _)| *own < area);
        self.ends[from..].iter().take_while(move |(own, _)| *own == area).map(|(_, end)| {
            let link: &'w MapLink = self.links[end / 2];
            let (one, other) = ((link.area, &link.side), (link.to_area, &link.to_side));
            if end % 2 == 0 { [one, other] } else { [other, one] }
        })
    }
}

/// Sides that are to be paired anew, in the making.
struct Anew<'w> {
    world: &'w World,
    reach: f64,
    linked: Linked<'w>,
    /// Which doors are mounted in which Areas, sorted; found when it is asked for.
    mounted: OnceCell<Vec<(DoorId, AreaId)>>,
    stands: &'w [Stand],
    /// Areas that had to be placed.
    placed: BTreeMap<AreaId, PlacedArea>,
    /// The sides of Areas that were looked at.
    sides: BTreeMap<AreaId, Arc<Vec<(Place, OpenSide)>>>,
    group: BTreeMap<Place, OpenSide>,
    /// Of these it is not yet known with what they may make an opening.
    queue: Vec<Place>,
}

impl<'w> Anew<'w> {
    fn stand(&self, area: AreaId) -> Option<&'w Stand> {
        let at = self.stands.binary_search_by_key(&area, |stand| stand.area).ok()?;
        Some(&self.stands[at])
    }

    /// The sides of an Area through which one may pass, stepped through; none of one that stands nowhere.
    fn sides_of(&mut self, area: AreaId) -> Arc<Vec<(Place, OpenSide)>> {
        if let Some(known) = self.sides.get(&area) {
            return Arc::clone(known);
        }
        let sides = self.stand(area).map_or_else(Vec::new, |stand| self.measured(stand));
        let sides = Arc::new(sides);
        self.sides.insert(area, Arc::clone(&sides));
        sides
    }

    fn measured(&mut self, stand: &Stand) -> Vec<(Place, OpenSide)> {
        let within = stand.bounds.grown(self.reach + FOOTHOLD + 2.0);
        let near = self.stands.iter().filter(|s| s.map == stand.map && s.bounds.meets(&within));
        let mut around = BTreeMap::new();
        for stand in near {
            let place = || PlacedArea::new(self.world, stand.area, stand.frame);
            let placed = self.placed.entry(stand.area).or_insert_with(place);
            around.insert(stand.area, placed.clone());
        }
        let mut sides = open_sides(self.world, stand.map, &around[&stand.area]);
        let floors = Floors::of(&around);
        for (_, side) in &mut sides {
            floors.step_off(side, self.reach);
        }
        for [(_, side), (other, _)] in self.linked.of(stand.area) {
            if let Some((_, own)) = sides.iter_mut().find(|(_, own)| own.side == *side) {
                own.linked = Some(other);
            }
        }
        sides
    }

    /// Takes the sides of an Area of which this holds.
    fn take(&mut self, area: AreaId, is_wanted: impl Fn(&OpenSide) -> bool) {
        for (place, side) in self.sides_of(area).iter().filter(|(_, side)| is_wanted(side)) {
            if self.group.insert(*place, side.clone()).is_none() {
                self.queue.push(*place);
            }
        }
    }

    fn take_side(&mut self, area: AreaId, side: &SideRef) {
        self.take(area, |own| own.side == *side);
    }

    /// Takes sides through which one may step into an Area that changed.
    fn take_near(&mut self, changed: &[(MapId, Bounds)]) {
        let further = self.reach + FOOTHOLD + 2.0;
        for stand in self.stands {
            let own = stand.bounds.grown(further);
            let near =
                changed.iter().filter(|(map, bounds)| *map == stand.map && bounds.meets(&own));
            let near: Vec<&Bounds> = near.map(|(_, bounds)| bounds).collect();
            if !near.is_empty() {
                let is_near = |side: &OpenSide| {
                    let own = Bounds::of([side.ends.0, side.ends.1]).grown(further);
                    near.iter().any(|bounds| bounds.meets(&own))
                };
                self.take(stand.area, is_near);
            }
        }
    }

    /// Takes the sides on which one of these doors is mounted.
    fn take_mounts(&mut self, doors: &BTreeSet<DoorId>) {
        if doors.is_empty() {
            return;
        }
        let world = self.world;
        let mounted = self.mounted.get_or_init(|| {
            let mounts = |area: &'w Area| area.doors.iter().map(|mount| (mount.door, area.id));
            let mut mounted: Vec<_> = world.areas.values().flat_map(mounts).collect();
            mounted.sort_unstable();
            mounted
        });
        let of_door = |&door: &DoorId| {
            let from = mounted.partition_point(|(own, _)| *own < door);
            mounted[from..].iter().take_while(move |(own, _)| *own == door).map(|(_, area)| *area)
        };
        let areas: BTreeSet<AreaId> = doors.iter().flat_map(of_door).gather();
        for area in areas {
            let is_mounted = |side: &OpenSide| {
                side.mount.as_ref().is_some_and(|mount| doors.contains(&mount.door))
            };
            self.take(area, is_mounted);
        }
    }

    /// With the sides that were taken all that may make an opening with one of them, in the order of their places; none
    /// where these are too many.
    fn closed(&mut self) -> Option<Vec<(Place, OpenSide)>> {
        while let Some(place) = self.queue.pop() {
            if self.group.len() > MOST || self.sides.len() > MOST {
                return None;
            }
            let side = self.group[&place].clone();
            let own = self.linked.of(side.area).filter(|[(_, own), _]| **own == side.side);
            for (area, other) in own.map(|[_, other]| other).collect::<Vec<_>>() {
                self.take_side(area, other);
            }
            if let Some(mount) = &side.mount {
                self.take_mounts(&BTreeSet::from([mount.door]));
            }
            let own = Bounds::of([side.ends.0, side.ends.1]);
            for stand in self.stands.iter().filter(|s| s.map == place.0 && s.area != side.area) {
                let way = self.reach + side.width().max(stand.widest) / 2.0 + 2.0;
                if stand.bounds.grown(way).meets(&own) {
                    let reach = self.reach;
                    self.take(stand.area, |other| may_pair(&side, other, reach));
                }
            }
        }
        Some(std::mem::take(&mut self.group).into_iter().collect())
    }
}

/// Whether two sides may make an opening for where they are.
fn may_pair(one: &OpenSide, other: &OpenSide, reach: f64) -> bool {
    let meets = || {
        let way = (other.middle() - one.middle()).norm();
        one.behind() == Some(other.area)
            && other.behind() == Some(one.area)
            && way <= reach + one.width().max(other.width()) / 2.0
    };
    face_each_other(one, other, reach) || face_each_other(other, one, reach) || meets()
}

/// The links that two lists, gone through in their order, do not have in common.
fn differing<'l>(before: &[&'l Arc<MapLink>], after: &[&'l Arc<MapLink>]) -> Vec<&'l Arc<MapLink>> {
    let same = |one: &Arc<MapLink>, other: &Arc<MapLink>| Arc::ptr_eq(one, other) || one == other;
    let (mut was, mut is, mut found) = (before, after, Vec::new());
    loop {
        match (was, is) {
            ([one, old @ ..], [other, new @ ..]) if same(one, other) => (was, is) = (old, new),
            ([], []) => return found,
            ([one, old @ ..], new) if old.len() >= new.len() => {
                found.push(*one);
                was = old;
            }
            (_, [other, new @ ..]) => {
                found.push(*other);
                is = new;
            }
            ([one, old @ ..], []) => {
                found.push(*one);
                was = old;
            }
        }
    }
}
