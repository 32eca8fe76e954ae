//! Objects and Areas: rigid groups of Orthoframes (paper 1 §§3-4; paper 2 §§3-4).

use crate::units::{AreaId, Cm, Deg, Frame, ObjectId, OrFrId, TypeId};

use super::{DoorMount, Properties};

/// One Orthoframe of an Object or Area, placed in its local frame (ObjectItems, AreaItems).
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// Unique within its Object or Area: `"A"`.
    pub id: String,
    pub orthoframe: OrFrId,
    /// PosX, PosY, PosZ, PosA.
    pub frame: Frame,
    /// The item with a corner at the origin; exactly one.
    pub is_base: bool,
}

/// A face of an item.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Face {
    Base,
    Roof,
    /// The side that stands on this base vector.
    Side(String),
}

/// A link between faces of two items (ObjectItemLinks, AreaItemLinks).
///
/// The offset is that of the linked face from this one, in the frame of the Object: origin to origin for
/// horizontal faces, corner to corresponding corner for sides. A side that runs the other way, by more than a right
/// angle, stands back to back with this one: its end then corresponds to this one's start, and `rel_a` is taken
/// from its direction turned round. So coinciding faces have offset zero, `rel_a` included.
#[derive(Debug, Clone, PartialEq)]
pub struct ItemLink {
    pub item: String,
    pub face: Face,
    pub to_item: String,
    pub to_face: Face,
    pub rel_x: Cm,
    pub rel_y: Cm,
    pub rel_z: Cm,
    /// Angle of the linked face less the angle of this one.
    pub rel_a: Deg,
}

/// A base vector of an item.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct SideRef {
    pub item: String,
    pub side: String,
}

/// A kind of thing: what all its replicas have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    pub id: ObjectId,
    pub key: String,
    pub name: String,
    pub name_en: String,
    pub description: String,
    pub object_type: Option<TypeId>,
    pub items: Vec<Item>,
    pub links: Vec<ItemLink>,
    /// Absent for a round table. The front's outward normal is the way the Object faces.
    pub front: Option<SideRef>,
    pub back: Option<SideRef>,
    pub doors: Vec<DoorMount>,
    pub properties: Properties,
}

/// A room, corridor or hall: a place in which the robot can be.
#[derive(Debug, Clone, PartialEq)]
pub struct Area {
    pub id: AreaId,
    pub key: String,
    pub name: String,
    pub name_en: String,
    pub description: String,
    pub area_type: Option<TypeId>,
    pub items: Vec<Item>,
    pub links: Vec<ItemLink>,
    pub doors: Vec<DoorMount>,
    pub properties: Properties,
    /// Word forms of the name where the rules of the language would go wrong.
    pub forms: super::Forms,
}

macro_rules! group_of_items {
    ($($group:ty),+) => {$(
        impl $group {
            #[must_use]
            pub fn item(&self, id: &str) -> Option<&Item> {
                self.items.iter().find(|item| item.id == id)
            }
        }
    )+};
}
group_of_items!(Object, Area);
