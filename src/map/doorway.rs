//! Where doors and windows are: which Areas they join, and the segment of floor that each of them leaves to go through.

use crate::units::{AreaId, DoorId, Point};

use super::{BaseVector, Door, DoorMount, World};

impl World {
    /// The Areas that mount a door, in the order of their ids: two, or one when it leads outside, or none when it
    /// belongs to an Object.
    #[must_use]
    pub fn door_areas(&self, door: DoorId) -> Vec<AreaId> {
        self.door_mounts(door).map(|(area, _)| area).collect()
    }

    /// Every mount of a door on an Area, in the order of the Areas' ids. The first is the one from which
    /// [`Door::leaves`] are counted.
    pub fn door_mounts(&self, door: DoorId) -> impl Iterator<Item = (AreaId, &DoorMount)> + '_ {
        self.areas
            .values()
            .flat_map(|area| area.doors.iter().map(move |mount| (area.id, mount)))
            .filter(move |(_, mount)| mount.door == door)
    }

    /// The doors between Areas, passages among them; doors of Objects are not.
    pub fn area_doors(&self) -> impl Iterator<Item = &Door> + '_ {
        self.doors.values().filter(|door| self.door_mounts(door.id).next().is_some())
    }

    /// The right and the left jamb of a door in the frame of an Area, seen from within that Area. In the middle of
    /// its side where the side is longer than the door is wide. None when the Area does not mount the door.
    ///
    /// ```text
    ///   -----left  right-----      side vector: <-----
    ///          this Area
    /// ```
    #[must_use]
    pub fn threshold(&self, area: AreaId, door: DoorId) -> Option<(Point, Point)> {
        let group = self.areas.get(&area)?;
        let mount = group.doors.iter().find(|mount| mount.door == door)?;
        let item = group.item(&mount.item)?;
        let (_, side) = self.orthoframes.get(&item.orthoframe)?.side(&mount.side)?;
        // The base runs counter-clockwise: seen from within, a side runs from right to left.
        let (right, left) = (item.frame.apply(side.start), item.frame.apply(side.end));
        let along = left - right;
        let margin = (along.norm() - self.doors.get(&door)?.width.get()) / 2.0;
        if margin <= 0.0 {
            return Some((right, left));
        }
        let inset = along.normalize() * margin;
        Some((right + inset, left - inset))
    }

    /// Whether a side is a window, by the words of its type.
    #[must_use]
    pub fn is_window(&self, side: &BaseVector) -> bool {
        self.types.side.get(side.side_type).is_some_and(|t| t.is_called(&["window", "окно"]))
    }

    /// The bases of an Area's items, counter-clockwise, in the Area's frame.
    ///
    /// # Panics
    /// When the Area is not of this world.
    #[must_use]
    pub fn area_polygons(&self, area: AreaId) -> Vec<Vec<Point>> {
        let corners = |item: &super::Item| {
            self.orthoframe_of(item).corners().map(|p| item.frame.apply(p)).collect()
        };
        self.areas[&area].items.iter().map(corners).collect()
    }
}
