//! What was seen and is not on the map, as things of the world as it is now: temporary Orthoframes that free floor, ways and
//! answers respect like all else (SPEC L4).
//!
//! **Invariant**: the surveyed map never has them; nobody can push them, since nobody knows what they are.

use crate::map::{BaseVector, Item, Object, Orthoframe, Permeability, Properties, Replica, World};
use crate::units::{
    AreaId, Bilingual, Cm, Deg, Frame, Language, ObjectId, OrFrId, Point, ReplicaId, said,
};

/// Ids from here downwards are of no map: those of a map are given upwards from 1.
const LAST_ID: u32 = u32::MAX - 1;

/// Whether a thing is one that was only seen, and not surveyed.
#[must_use]
pub fn is_obstacle(id: ReplicaId) -> bool {
    id.0 > LAST_ID / 2
}

/// Stands what was seen in an Area of the world: convex pieces in its frame, counter-clockwise, up to a height above its
/// floor, cm. None where there is no such Area, or nothing was seen.
pub fn stand_obstacle(
    world: &mut World,
    area: AreaId,
    pieces: &[Vec<Point>],
    top: f64,
) -> Option<ReplicaId> {
    let &origin = pieces.first().and_then(|piece| piece.first())?;
    if !world.areas.contains_key(&area) || pieces.iter().any(Vec::is_empty) {
        return None;
    }
    let is_new = |id: &u32| {
        !world.replicas.contains_key(&ReplicaId(*id)) && !world.objects.contains_key(&ObjectId(*id))
    };
    let own = (0..=LAST_ID).rev().find(is_new)?;
    let mut next_frame =
        (0..=LAST_ID).rev().find(|id| !world.orthoframes.contains_key(&OrFrId(*id)))?;
    let mut items = Vec::new();
    for (index, piece) in pieces.iter().enumerate() {
        let id = OrFrId(next_frame);
        next_frame -= 1;
        let corner = piece[0];
        world.orthoframes.insert(id, prism(id, piece, top));
        let off = corner - origin;
        items.push(Item {
            id: format!("P{index}"),
            orthoframe: id,
            frame: Frame::new(off.x, off.y, 0.0, Deg::ZERO),
            is_base: index == 0,
        });
    }
    let names = |number: usize| in_both(&said!("obstacle-numbered", number));
    let is_free = |number: &usize| names(*number).iter().all(|name| world.find(name).is_empty());
    // Its place among such things is free, unless the map has a thing of that name.
    let number = ((LAST_ID - own) as usize + 1..).find(is_free)?;
    let ([name, name_en], [kind, kind_en]) = (names(number), in_both(&said!("obstacle")));
    let object = ObjectId(own);
    world.objects.insert(
        object,
        Object {
            id: object,
            key: format!("obstacle-{number}"),
            name: kind,
            name_en: kind_en,
            description: String::new(),
            object_type: None,
            items,
            links: Vec::new(),
            front: None,
            back: None,
            doors: Vec::new(),
            properties: Properties::new(),
        },
    );
    let id = ReplicaId(own);
    world.replicas.insert(
        id,
        Replica {
            id,
            area,
            object,
            name,
            name_en,
            frame: Frame::new(origin.x, origin.y, 0.0, Deg::ZERO),
            move_prob: 0,
            properties: Properties::new(),
            door_states: Default::default(),
            forms: Default::default(),
        },
    );
    Some(id)
}

/// The Russian name and the English one.
fn in_both(name: &Bilingual) -> [String; 2] {
    [Language::Russian, Language::English].map(|language| name.say(language).to_owned())
}

/// What [`stand_obstacle`] was told of a thing that stands so: its Area, the pieces and their top.
#[must_use]
pub fn outline_of(world: &World, id: ReplicaId) -> Option<(AreaId, Vec<Vec<Point>>, f64)> {
    let replica = world.replicas.get(&id).filter(|_| is_obstacle(id))?;
    let items = &world.objects.get(&replica.object)?.items;
    let frames = items.iter().map(|item| Some((item, world.orthoframes.get(&item.orthoframe)?)));
    let frames: Vec<_> = frames.collect::<Option<_>>()?;
    let top = frames.first()?.1.height.get();
    let piece = |(item, frame): &(&Item, &Orthoframe)| {
        let placed = replica.frame.compose(&item.frame);
        frame.base.iter().map(|vector| placed.apply(vector.start)).collect()
    };
    Some((replica.area, frames.iter().map(piece).collect(), top))
}

fn prism(id: OrFrId, piece: &[Point], top: f64) -> Orthoframe {
    let corner = |index: usize| Point::from(piece[index % piece.len()] - piece[0]);
    let side = |index: usize| BaseVector {
        id: format!("V{index}"),
        start: corner(index),
        end: corner(index + 1),
        side_type: None,
        permeability: Permeability::Impermeable,
        names: Vec::new(),
        properties: Properties::new(),
    };
    Orthoframe {
        id,
        key: format!("obstacle-{}", LAST_ID - id.0),
        name: String::new(),
        name_en: String::new(),
        description: String::new(),
        frame_type: None,
        shape: None,
        base: (0..piece.len()).map(side).collect(),
        height: Cm::of(top.max(1.0)),
        base_permeability: Permeability::Impermeable,
        roof_permeability: Permeability::Impermeable,
        roof_scale: 1.0,
        properties: Properties::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_one_of_its_own_and_one_without_an_outline_is_none() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/rb2.toml");
        let mut world = World::load(path).expect("the example map is sound");
        let area = *world.areas.keys().next().expect("the map has rooms");
        let square = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]].map(|[x, y]| Point::new(x, y));
        let before = world.clone();
        assert_eq!(stand_obstacle(&mut world, area, &[], 50.0), None);
        let holed = [square.to_vec(), Vec::new()];
        assert_eq!(stand_obstacle(&mut world, area, &holed, 50.0), None);
        assert!(world == before);
        let mut stand = || {
            let id = stand_obstacle(&mut world, area, &[square.to_vec()], 50.0);
            world.replicas[&id.expect("it has an outline")].name.clone()
        };
        let names: Vec<String> = (0..3).map(|_| stand()).collect();
        assert_eq!(names, ["Препятствие-1", "Препятствие-2", "Препятствие-3"]);
        let told = outline_of(&world, ReplicaId(LAST_ID)).expect("it stands");
        assert_eq!(told, (area, vec![square.to_vec()], 50.0));
    }
}
