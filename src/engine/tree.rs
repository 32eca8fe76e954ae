//! A plan as a behaviour tree: XML of BehaviorTree.CPP 4, which Groot2 shows.
//!
//! A directive is a Sequence, named by its number and words; in it stand its primitives in their order, each an Action
//! whose ID is a verb of the vehicle protocol (docs/vehicle.md) and whose ports are names on the map. Directives of one step
//! may be done in any order, and are done one after another: there is one robot. Where a primitive drives to a named place the
//! port `goal` holds `x;y;heading` in metres and radians in the frame of its Map.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::language::Language;
use crate::map::{DoorStatus, World};
use crate::robot::{Directive, Planned, Primitive};

use super::{Error, State, directive_in_words};

/// The ports of an Action, in order.
type Ports = Vec<(&'static str, String)>;

impl State {
    /// The tree of a plan of a task; none where there is no plan.
    ///
    /// # Errors
    /// There is no map.
    pub fn behaviour_tree(&self, planned: &Planned) -> Result<Option<String>, Error> {
        let world = self.world()?;
        Ok(planned.solved.outcome.plan().map(|_| written(world, planned)))
    }
}

fn written(world: &World, planned: &Planned) -> String {
    let mut model: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    let mut body = String::new();
    let directives = planned.steps.iter().flatten().enumerate();
    for (no, directive) in directives {
        let words = directive_in_words(world, directive, Language::English);
        let name = format!("{}. {words}", no + 1);
        put(&mut body, format_args!("      <Sequence name=\"{}\">\n", escaped(&name)));
        for (action, ports) in actions(world, directive) {
            let known = model.entry(action).or_default();
            for (port, _) in &ports {
                if !known.contains(port) {
                    known.push(port);
                }
            }
            put(&mut body, format_args!("        <Action ID=\"{action}\""));
            for (port, value) in &ports {
                put(&mut body, format_args!(" {port}=\"{}\"", escaped(value)));
            }
            body.push_str("/>\n");
        }
        body.push_str("      </Sequence>\n");
    }
    if body.is_empty() {
        // A Sequence has a child: where the goal holds there is nothing to do.
        body.push_str("      <AlwaysSuccess/>\n");
    }
    let mut models = String::new();
    for (action, ports) in &model {
        put(&mut models, format_args!("    <Action ID=\"{action}\">\n"));
        for port in ports {
            put(
                &mut models,
                format_args!("      <input_port name=\"{port}\" type=\"std::string\"/>\n"),
            );
        }
        models.push_str("    </Action>\n");
    }
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<root BTCPP_format=\"4\" main_tree_to_execute=\"Plan\">\n  <BehaviorTree ID=\"Plan\">\n    <Sequence name=\"Plan\">\n{body}    </Sequence>\n  </BehaviorTree>\n  <TreeNodesModel>\n{models}  </TreeNodesModel>\n</root>\n",
    )
}

fn put(text: &mut String, piece: std::fmt::Arguments<'_>) {
    text.write_fmt(piece).expect("a string takes all");
}

fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // What XML cannot say at all.
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// The primitives of a directive; one that has none is called by its name alone, for whoever knows its rule.
fn actions(world: &World, directive: &Directive) -> Vec<(&'static str, Ports)> {
    let primitives = directive.primitives();
    if primitives.is_empty() {
        let ports = vec![
            ("action", directive.action.to_string()),
            ("args", directive.args.iter().map(ToString::to_string).collect::<Vec<_>>().join(";")),
        ];
        return vec![("Directive", ports)];
    }
    primitives.into_iter().map(|primitive| action(world, primitive)).collect()
}

fn action(world: &World, primitive: Primitive) -> (&'static str, Ports) {
    let flag = |on: bool| if on { "true" } else { "false" }.to_owned();
    match primitive {
        Primitive::GoToPlace(place) => {
            let goal = goal_of(world, &place);
            let mut ports = vec![("place", place)];
            ports.extend(goal.map(|goal| ("goal", goal)));
            ("GoToPlace", ports)
        }
        Primitive::GoToDoor(door) => ("GoToDoor", vec![("door", door)]),
        Primitive::Cross { door, into } => ("Cross", vec![("door", door), ("into", into)]),
        Primitive::SetDoor { door, status } => {
            let status = match status {
                DoorStatus::Open => "open",
                DoorStatus::Closed => "closed",
                DoorStatus::Locked => "locked",
            };
            ("SetDoor", vec![("door", door), ("status", status.to_owned())])
        }
        Primitive::CallLift { lift, door } => ("CallLift", vec![("lift", lift), ("door", door)]),
        Primitive::Ride { lift, to, door } => {
            ("Ride", vec![("lift", lift), ("to", to), ("door", door)])
        }
        Primitive::SetOpen { thing, open } => {
            ("SetOpen", vec![("thing", thing), ("open", flag(open))])
        }
        Primitive::Push(thing) => ("Push", vec![("thing", thing)]),
        Primitive::Take(thing) => ("Take", vec![("thing", thing)]),
        Primitive::Put { thing, onto } => {
            let mut ports = vec![("thing", thing)];
            ports.extend(onto.map(|onto| ("onto", onto)));
            ("Put", ports)
        }
        Primitive::HandOver { thing, person } => {
            ("HandOver", vec![("thing", thing), ("person", person)])
        }
        Primitive::Switch { device, on } => ("Switch", vec![("device", device), ("on", flag(on))]),
        Primitive::LookRound => ("LookRound", Vec::new()),
        Primitive::Seek(thing) => ("Seek", vec![("thing", thing)]),
        Primitive::Call(person) => ("Call", vec![("person", person)]),
    }
}

/// A named place of the map in the frame of its Map; none of what is a place by the plan alone.
fn goal_of(world: &World, name: &str) -> Option<String> {
    let place = world.places.values().find(|place| place.name == name)?;
    let (_, frame) = world.placement(place.area)?;
    let at = frame.apply(place.at);
    let heading = place.heading.map_or(0.0, |heading| (heading + frame.angle).get().to_radians());
    Some(format!("{:.4};{:.4};{heading:.4}", at.x / 100.0, at.y / 100.0))
}
