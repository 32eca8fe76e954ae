//! A thing that is not where it was: it is looked for where it is believed to be, then where things of its kind lie, then
//! everywhere, and found wherever the robot gets to.

#![allow(clippy::print_stdout, reason = "figures")]

use std::collections::BTreeSet;

use orthoframe_map::{Entity, Replica};
use orthoframe_robot::*;
use orthoframe_units::{AreaId, Cm, Frame, ReplicaId, Stop};

use super::setting::{Setting, example, fact};

#[test]
fn what_is_not_in_its_place_is_sought_where_its_kind_lies_first() {
    let setting = Setting::of(example("rb2"));
    let Setting { world, map, pose, .. } = &setting;
    let kind = |thing: &Replica| world.objects[&thing.object].object_type;
    let portable: Vec<ReplicaId> =
        world.replicas.keys().copied().filter(|id| world.has_trait(*id, "portable")).collect();
    assert!(portable.len() > 8);
    let (mut found, mut in_order, mut told_at_once) = (0, 0, 0);
    for (number, id) in portable.iter().enumerate() {
        let thing = &world.replicas[id];
        // Anywhere else: on the floor of another room, where a named place is.
        let elsewhere: Vec<_> =
            world.places.values().filter(|place| place.area != thing.area).collect();
        let place = elsewhere[number % elsewhere.len()];
        let mut truth = world.clone();
        let moved = truth.replicas.get_mut(id).unwrap();
        moved.area = place.area;
        moved.frame = Frame::new(place.at.x + 40.0, place.at.y, 0.0, thing.frame.angle);
        moved.frame.z = Cm::ZERO;
        let mut belief = setting.belief().unwrap();
        belief.sought.insert(thing.name.clone(), BTreeSet::new());
        let mut mission = setting.mission(belief);
        let mut robot = Simulator::new(truth, *map, *pose);
        let goal = [fact("ПРЕДМЕТ-НАЙДЕН", &thing.name)];
        let mut looked: Vec<AreaId> = Vec::new();
        let mut sought: Vec<String> = Vec::new();
        let mut tell = |event: &Event<'_>| match event {
            Event::Surprised { surprise: Surprise::NotSeen { area, .. }, .. } => looked.push(*area),
            Event::Started { directive, .. } if directive.brings_about("ПРЕДМЕТ-НАЙДЕН") =>
            {
                sought.push(directive.args[1].to_string());
            }
            _ => {}
        };
        let ending = mission.run(&goal, &mut robot, &Stop::new(), &mut tell).unwrap();
        let is_found = matches!(ending, Ending::Done | Ending::AlreadyTrue);
        // The rooms that were looked over, in their order.
        let area_of = |name: &String| {
            let found = world.find(name).into_iter();
            found.filter_map(|e| if let Entity::Area(id) = e { Some(id) } else { None }).next()
        };
        let order: Vec<AreaId> = sought.iter().filter_map(area_of).collect();
        assert!(order.starts_with(&looked), "{}: {order:?} {looked:?}", thing.name);
        found += usize::from(is_found);
        // What stands on the floor is missed, and seen, from the place before it: nothing is looked over for it there.
        if order.first() != Some(&thing.area) {
            told_at_once += 1;
            continue;
        }
        let kin: BTreeSet<AreaId> = world
            .replicas
            .values()
            .filter(|other| other.id != *id)
            .filter(|other| {
                other.object == thing.object || kind(other).is_some() && kind(other) == kind(thing)
            })
            .map(|other| other.area)
            .filter(|area| *area != thing.area)
            .collect();
        let tail = &order[1..];
        let first_other = tail.iter().position(|area| !kin.contains(area)).unwrap_or(tail.len());
        let kin_looked: BTreeSet<AreaId> = tail[..first_other].iter().copied().collect();
        let all_kin_first = first_other == tail.len() || kin_looked == kin;
        assert!(all_kin_first, "{}: {order:?}, its kind in {kin:?}", thing.name);
        in_order += usize::from(!kin.is_empty() && tail.len() > kin.len().min(1));
    }
    println!(
        "{found} of {} found; {in_order} sought beyond the first room of their kind",
        portable.len()
    );
    assert!(told_at_once * 4 <= portable.len(), "{told_at_once} of {}", portable.len());
    assert!(found * 10 >= portable.len() * 8, "{found} of {}", portable.len());
}

/// Nothing in it has a place before it either.
#[test]
fn a_room_without_a_named_place_is_looked_over_from_its_middle() {
    let mut world = example("rb2");
    let room = world.find("Комната-Y").into_iter();
    let room = room.filter_map(|e| if let Entity::Area(id) = e { Some(id) } else { None }).next();
    let room = room.expect("the flat has it");
    world.places.retain(|_, place| place.area != room);
    world.replicas.retain(|_, thing| thing.area != room);
    let setting = Setting::of(world.clone());
    let middle = setting.floors[&setting.map].rest_in(room).expect("it has a floor");
    let (_, frame) = world.placement(room).expect("it is on the map");
    let at = frame.invert(middle);
    let sought: Vec<&Replica> =
        world.replicas.values().filter(|thing| world.has_trait(thing.id, "portable")).collect();
    let mut found = 0;
    for thing in sought.iter().take(5) {
        let mut truth = world.clone();
        let moved = truth.replicas.get_mut(&thing.id).expect("it is one");
        (moved.area, moved.frame) = (room, Frame::new(at.x + 30.0, at.y, 0.0, thing.frame.angle));
        let mut belief = setting.belief().expect("the robot stands somewhere");
        belief.sought.insert(thing.name.clone(), BTreeSet::new());
        let mut mission = setting.mission(belief);
        let mut robot = Simulator::new(truth, setting.map, setting.pose);
        let goal = [fact("ПРЕДМЕТ-НАЙДЕН", &thing.name)];
        let mut stood = Vec::new();
        let mut tell = |event: &Event<'_>| {
            if let Event::Started { directive, .. } = event {
                stood.extend(directive.args.iter().map(ToString::to_string));
            }
        };
        let ending = mission.run(&goal, &mut robot, &Stop::new(), &mut tell).unwrap();
        let from_middle = stood.contains(&format!("{IN_MIDDLE}Комната-Y"));
        found += usize::from(matches!(ending, Ending::Done) && from_middle);
        assert!(matches!(ending, Ending::Done), "{}: {ending:?}", thing.name);
    }
    assert!(found >= 4, "{found}");
}
