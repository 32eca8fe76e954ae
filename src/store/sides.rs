//! The derived tables: ObjectItemSides, AreaItemSides, AreaObjectSides, MapItemSides (paper 2 §§3-6).
//!
//! They repeat sides of Orthoframes in the frame of Object, Area or Map, for those who read the tables with SQL.
//! They are computed from a world when asked for, so that they cannot disagree with it.

use crate::map::{Item, World};
use crate::units::Frame;

use super::error::Result;
use super::sheet::Sheet;
use super::tables as t;

/// One side of an item, placed.
struct Placed<'a> {
    item: &'a Item,
    side_id: &'a str,
    side_type_id: Option<u32>,
    side_pntr: u32,
    ends: [f64; 4],
    len: f64,
    ang: f64,
    z: f64,
    height: f64,
}

/// The sides of some items, seen from the frame in which `frame` places their group.
fn placed<'a>(
    world: &'a World,
    items: &'a [Item],
    frame: &Frame,
) -> impl Iterator<Item = Placed<'a>> {
    items
        .iter()
        .filter_map(|item| Some((item, world.orthoframes.get(&item.orthoframe)?)))
        .map(|(item, orthoframe)| (item, orthoframe, frame.compose(&item.frame)))
        .collect::<Vec<_>>()
        .into_iter()
        .flat_map(|(item, orthoframe, frame)| {
            orthoframe.base.iter().map(move |side| {
                let (start, end) = (frame.apply(side.start), frame.apply(side.end));
                Placed {
                    item,
                    side_id: &side.id,
                    side_type_id: side.side_type.map(|id| id.0),
                    side_pntr: u32::from(side.permeability.code()),
                    ends: [start.x, start.y, end.x, end.y],
                    len: side.length().get(),
                    ang: (frame.angle + side.angle()).get(),
                    z: frame.z.get(),
                    height: orthoframe.height.get(),
                }
            })
        })
}

/// A record of one of the four tables: the columns that they share, and their own keys.
macro_rules! sides {
    ($record:ident, $side:expr, $base:expr, { $($key:ident: $value:expr),+ }) => {{
        let Placed { item, side_id, side_type_id, side_pntr, ends, len, ang, z, height } = $side;
        let [x1, y1, x2, y2] = ends;
        t::$record {
            $($key: $value,)+
            or_fr_id: item.orthoframe.0,
            side_id: side_id.to_owned(),
            side_type_id,
            side_pntr,
            base: $base(item),
            x1, y1, x2, y2, len, ang, z, height,
        }
    }};
}

impl Sheet {
    /// The derived tables of a world: ObjectItemSides, AreaItemSides, AreaObjectSides, MapItemSides.
    ///
    /// # Errors
    /// [`StoreError::Duplicate`](crate::StoreError::Duplicate) when two parts of the world have one key.
    pub fn derived(world: &World) -> Result<Self> {
        let mut sheet = Self::default();
        let of_item = |item: &Item| item.is_base;
        for object in world.objects.values() {
            for side in placed(world, &object.items, &Frame::IDENTITY) {
                let item_id = side.item.id.clone();
                sheet.put(&sides!(ObjectItemSides, side, of_item, {
                    object_id: object.id.0, item_id: item_id
                }))?;
            }
        }
        for area in world.areas.values() {
            for side in placed(world, &area.items, &Frame::IDENTITY) {
                let item_id = side.item.id.clone();
                sheet.put(&sides!(AreaItemSides, side, of_item, {
                    area_id: area.id.0, item_id: item_id
                }))?;
            }
        }
        for replica in world.replicas.values() {
            let Some(object) = world.objects.get(&replica.object) else { continue };
            for side in placed(world, &object.items, &replica.frame) {
                let item_id = side.item.id.clone();
                sheet.put(&sides!(AreaObjectSides, side, of_item, {
                    area_id: replica.area.0,
                    object_id: object.id.0,
                    repl_id: replica.id.0,
                    item_id: item_id
                }))?;
            }
        }
        map_sides(world, &mut sheet)?;
        Ok(sheet)
    }
}

fn map_sides(world: &World, sheet: &mut Sheet) -> Result<()> {
    for map in world.maps.values() {
        for item in &map.items {
            let Some(area) = world.areas.get(&item.area) else { continue };
            // Here `Base` tells the Map's base Area (paper 2 §6).
            for side in placed(world, &area.items, &item.frame) {
                let area_item_id = side.item.id.clone();
                sheet.put(&sides!(MapItemSides, side, |_: &Item| item.is_base, {
                    map_id: map.id.0,
                    item_id: item.area.0,
                    area_id: item.area.0,
                    area_item_id: area_item_id
                }))?;
            }
        }
    }
    Ok(())
}
