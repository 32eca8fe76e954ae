//! The index of names against a search, through edits.

use orthoframe_map::{NameIndex, Replica, World};
use orthoframe_units::ReplicaId;

#[test]
fn it_finds_what_a_search_finds_and_follows_edits() {
    let mut world = World::load("../../maps/lab.toml").expect("a map of the project");
    let mut index = NameIndex::of(&world);
    let ids: Vec<ReplicaId> = world.replicas.keys().copied().collect();
    let names: Vec<String> = world.names().map(|(_, name)| name.to_owned()).collect();
    for step in 0..400_usize {
        let before = world.clone();
        let id = ids[step * 31 % ids.len()];
        let other = &names[step * 17 % names.len()];
        match world.replicas.get_mut(&id) {
            None => {
                let twin = world.replicas.values().next().expect("some are left").clone();
                let twin = Replica { id, name: format!("Вещь-{step}"), ..twin };
                world.replicas.insert(id, twin);
            }
            Some(_) if step % 5 == 0 => drop(world.replicas.remove(&id)),
            Some(replica) if step % 3 == 0 => replica.name_en.clone_from(other),
            Some(replica) => replica.name.clone_from(other),
        }
        let area = world.areas.values_mut().nth(step % 3).expect("it has rooms");
        area.name.clone_from(other);
        if step % 9 == 0 {
            world.doors.values_mut().take(1).for_each(|door| door.name_en.push('!'));
            world.places.pop_last();
        }
        index.follow(&before, &world);
        assert_eq!(index, NameIndex::of(&world), "step {step}");
        for name in names.iter().skip(step % 7).step_by(7) {
            let typed = name.to_uppercase();
            let mut found = world.find(&typed);
            found.sort_unstable();
            found.dedup();
            assert_eq!(index.find(&world, &typed), found, "step {step}: {name}");
        }
    }
}
