//! What is known of one thing, room, door, place, zone or map, as data.

use serde_json::{Value, json};

use super::known::{believed, story};
use super::proofs::display;
use super::storey::{door_state, objects, seen, walls};
use crate::engine::{Error, State};
use crate::facts::Kind;
use crate::language::Language;
use crate::map::Entity;

/// Where something is to be seen, its relations, who changed it and when, and what is known of its kind alone.
///
/// # Errors
/// There is no map, or it knows nothing of such a name.
pub fn about(state: &State, name: &str, language: Language) -> Result<Value, Error> {
    let (world, relations) = (state.world()?, state.relations()?);
    let entity = state.find(name)?;
    let name = world.name(entity).to_owned();
    let facts = relations.of(&name).into_iter();
    let facts = facts.map(|(relation, values)| display(relations, &relation, &values, language));
    let mut view = json!({ "name": name, "relations": facts.collect::<Vec<_>>() });
    view["seen"] = json!(seen(state, entity));
    // A state of the past has no store behind it.
    let changes = state.changes_of(entity).unwrap_or_default();
    view["changes"] = changes
        .iter()
        .map(|made| json!({ "revision": made.revision, "user": made.user, "at": made.at.to_string() }))
        .collect();
    match entity {
        Entity::Replica(id) => {
            let replica = &world.replicas[&id];
            let object = &world.objects[&replica.object];
            let mut properties = object.properties.clone();
            properties.extend(replica.properties.clone());
            view["kind"] = json!("thing");
            view["name_en"] = json!(replica.name_en);
            view["object"] = json!([object.name, object.name_en]);
            view["room"] = json!(world.areas[&replica.area].name);
            view["properties"] = json!(properties);
            if let Ok(found) = state.where_is(&name, std::time::SystemTime::now().into()) {
                view["believed"] = believed(state, &found)?;
                view["story"] = story(state, &name)?["story"].take();
            }
        }
        Entity::Door(id) => {
            let door = state.world_now()?.doors.get(&id).unwrap_or(&world.doors[&id]);
            view["kind"] = json!("door");
            view["name_en"] = json!(door.name_en);
            view["state"] = json!(door_state(door));
            view["properties"] = json!(door.properties);
        }
        Entity::Area(id) => {
            view["kind"] = json!("room");
            view["name_en"] = json!(world.areas[&id].name_en);
            view["parts"] = json!(walls(world, id));
            view["things"] =
                json!(world.replicas_in(id).map(|r| [&r.name, &r.name_en]).collect::<Vec<_>>());
        }
        Entity::Place(id) => {
            view["kind"] = json!("place");
            view["name_en"] = json!(world.places[&id].name_en);
        }
        Entity::Zone(id) => {
            let words = state.zones_in_words(language)?;
            view["rule"] = json!(words.get(&id));
            view["kind"] = json!("zone");
            view["name_en"] = json!(world.zones[&id].name_en);
        }
        Entity::Map(id) => {
            view["kind"] = json!("map");
            view["name_en"] = json!(world.maps[&id].name_en);
        }
    }
    Ok(view)
}

/// What can be asked of two things, and what kinds of things can be put down.
///
/// # Errors
/// There is no map.
pub(crate) fn kinds(state: &State) -> Result<Value, Error> {
    let between = state.relations()?.derived().relations().filter(|(_, info)| {
        let is_shown = !info.outputs.is_empty() && info.columns.len() == 2;
        is_shown && info.columns.iter().all(|column| column.kind == Kind::Symbol)
    });
    let names = between.filter_map(|(_, info)| Some([&info.name, info.second_name.as_ref()?]));
    Ok(json!({ "relations": names.collect::<Vec<_>>(), "objects": objects(state.world()?) }))
}
