//! What is in view from a pose: faces by name.

use crate::geometry::{Blocker, Eye, Face, FaceInView, FaceKind};
use crate::map::{Entity, Item, World};
use crate::units::{Language, MapId, told};

use super::lexicon::named;
use super::{Error, Lens, State};

impl State {
    /// The faces that are seen through a lens, those that look largest first.
    ///
    /// # Errors
    /// There is no map.
    pub fn faces_in_view(&self, map: MapId, lens: Lens) -> Result<Vec<FaceInView>, Error> {
        let eye =
            Eye { pose: lens.pose, height: lens.height, field: lens.field, range: lens.range };
        Ok(self.floor(map)?.faces(self.world()?, &eye).in_view(&eye))
    }
}

/// «Стол-1, Столешница: верх», "Room V: side B"; a side that has a name of its own bears it.
#[must_use]
pub(crate) fn face_in_words(world: &World, face: &Face, language: Language) -> String {
    let name = |entity: Entity| match language {
        Language::Russian => world.name(entity).to_owned(),
        Language::English => named(world, entity).english(),
    };
    let of = |owner: Entity, items: &[Item], item: usize| {
        let Some(item) = items.get(item) else { return name(owner) };
        let orthoframe = world.orthoframe_of(item);
        let side = match face.kind {
            FaceKind::Roof => told!(language, "top"),
            FaceKind::Base => told!(language, "underside"),
            FaceKind::Side(side) => match orthoframe.base.get(side) {
                Some(vector) if !vector.names.is_empty() => vector.names.join(", "),
                Some(vector) => format!("{} {}", told!(language, "side"), vector.id),
                None => String::new(),
            },
        };
        let english = language == Language::English && !orthoframe.name_en.is_empty();
        let part = if english { &orthoframe.name_en } else { &orthoframe.name };
        match items.len() {
            1 => format!("{}: {side}", name(owner)),
            _ => format!("{}, {part}: {side}", name(owner)),
        }
    };
    let leaf = |owner: Entity, leaf: usize| {
        format!("{}, {} {}", name(owner), told!(language, "leaf"), leaf + 1)
    };
    match face.blocker {
        Blocker::Replica { replica, item } => match world.replicas.get(&replica) {
            Some(model) => of(Entity::Replica(replica), &world.objects[&model.object].items, item),
            None => String::new(),
        },
        Blocker::Wall { area, item, .. } => {
            of(Entity::Area(area), world.areas.get(&area).map_or(&[][..], |a| &a.items), item)
        }
        Blocker::Floor { area, .. } => {
            format!("{}: {}", name(Entity::Area(area)), told!(language, "floor"))
        }
        Blocker::Zone { zone } => name(Entity::Zone(zone)),
        Blocker::DoorLeaf { door, leaf: number } => leaf(Entity::Door(door), number),
        Blocker::ReplicaLeaf { replica, leaf: number, .. } => {
            leaf(Entity::Replica(replica), number)
        }
    }
}
