//! Hospitals made of one ward, again and again: the same on every machine.

use orthoframe_map::{Area, Format, MapItem, Replica, World};
use orthoframe_units::{AreaId, Frame, ReplicaId, Source};

/// The ward of a map file, so many times, each at its frame; things beyond `most` are left out.
///
/// Names end with the number of the ward: «Палата-7», «Стул-2-7».
pub(crate) fn hospital(
    ward: &str,
    wards: usize,
    most: usize,
    frame: impl Fn(usize) -> Frame,
) -> World {
    let text = Source::new("палата.toml", ward);
    let mut world = World::parse(&text, Format::Toml).expect("the ward is sound");
    let ward = world.areas.values().next().expect("one ward").clone();
    let furniture: Vec<Replica> = world.replicas.values().cloned().collect();
    let map = world.maps.values_mut().next().expect("one floor");
    map.items.clear();
    world.areas.clear();
    world.replicas.clear();
    for n in 0..wards {
        let area = AreaId(n as u32 + 1);
        let (name, key) = (format!("Палата-{n}"), format!("ward-{n}"));
        world.areas.insert(area, Area { id: area, name, key, ..ward.clone() });
        map.items.push(MapItem { area, frame: frame(n), is_base: n == 0 });
        let left = most.saturating_sub(n * furniture.len());
        for (k, thing) in furniture.iter().enumerate().take(left) {
            let id = ReplicaId((n * furniture.len() + k) as u32 + 1);
            let name = format!("{}-{n}", thing.name);
            world.replicas.insert(id, Replica { id, area, name, ..thing.clone() });
        }
    }
    world
}

/// How many things a ward of this text holds.
#[allow(dead_code, reason = "one of the two benches counts wards")]
pub(crate) fn things(ward: &str) -> usize {
    let text = Source::new("палата.toml", ward);
    World::parse(&text, Format::Toml).expect("the ward is sound").replicas.len()
}
