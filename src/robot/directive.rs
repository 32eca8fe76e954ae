//! A directive: one instantiated action of a plan, and what it asks the vehicle to do (paper 1 §8).
//!
//! What is to be done is read from the action's effects, never from its name: an action after which the robot
//! is at a door is a drive to that door. So a rule file may add, rename and split actions freely, as long as
//! it speaks of the world in the predicates of [`crate::semantics::predicate`].

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::map::DoorStatus;
use crate::semantics::predicate;
use crate::strips::{Domain, FactId, Operator, Schema, SchemaAtom, SchemaTerm, Task};
use crate::units::name_key;

/// A step of a plan: the action's name, its arguments, and all its effects.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Directive {
    pub action: Arc<str>,
    pub args: Vec<Arc<str>>,
    pub adds: Vec<Effect>,
    pub deletes: Vec<Effect>,
    /// The conditions under which the action is taken.
    pub needs: Vec<Effect>,
}

/// A ground atom: what a directive needs, brings about or ends.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Effect {
    pub predicate: String,
    pub args: Vec<String>,
}

/// One action primitive: what a directive has the vehicle do, in the names of the Map.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Primitive {
    /// Drive within the Area to a place, or to the place before a thing.
    GoToPlace(String),
    /// Drive within the Area to a door.
    GoToDoor(String),
    /// Drive through the door into an Area.
    Cross {
        door: String,
        into: String,
    },
    SetDoor {
        door: String,
        status: DoorStatus,
    },
    /// Have the cabin of a lift come to the door at which the robot stands.
    CallLift {
        lift: String,
        door: String,
    },
    /// Ride to where the cabin is another Area, and have this door of it opened.
    Ride {
        lift: String,
        to: String,
        door: String,
    },
    /// Open or shut the doors, lid or drawer of a thing.
    SetOpen {
        thing: String,
        open: bool,
    },
    /// Push a thing out of the way.
    Push(String),
    Take(String),
    /// Put a thing onto another, or down where the robot stands.
    Put {
        thing: String,
        onto: Option<String>,
    },
    HandOver {
        thing: String,
        person: String,
    },
    Switch {
        device: String,
        on: bool,
    },
    /// Turn round and look at all there is.
    LookRound,
    /// Have a thing in view, from here or from another place of the Area.
    Seek(String),
    Call(String),
}

/// With what comes about under conditions, of which the operator knows that they hold.
fn with_conditional(
    mut effects: Vec<Effect>,
    schema: &Schema,
    task: &Task,
    facts: &[FactId],
) -> Vec<Effect> {
    if schema.conditional.is_empty() {
        return effects;
    }
    for fact in facts.iter().map(|&id| task.fact(id)).filter(|fact| !fact.negated) {
        let effect = Effect {
            predicate: name_key(&fact.predicate),
            args: fact.args.iter().map(ToString::to_string).collect(),
        };
        if !effects.contains(&effect) {
            effects.push(effect);
        }
    }
    effects
}

impl Directive {
    /// The directive that an operator of a task stands for, with the effects that its rule gives it
    /// (a task keeps only those that matter to its goal).
    ///
    /// # Panics
    /// When the operator was not grounded from this domain.
    #[must_use]
    pub fn of(domain: &Domain, task: &Task, operator: &Operator) -> Self {
        let schema = domain
            .schemas()
            .iter()
            .find(|s| s.name == *operator.name)
            .expect("an operator is grounded from a rule of its domain");
        let ground = |atom: &SchemaAtom| Effect {
            predicate: name_key(&domain.predicates()[atom.predicate.index()].name),
            args: atom
                .args
                .iter()
                .map(|term| match term {
                    SchemaTerm::Parameter(at) => operator.args[*at as usize].to_string(),
                    SchemaTerm::Constant(name) => name.clone(),
                })
                .collect(),
        };
        Self {
            action: Arc::clone(&operator.name),
            args: operator.args.clone(),
            adds: with_conditional(
                schema.add_effects.iter().map(ground).collect(),
                schema,
                task,
                &operator.add_effects,
            ),
            deletes: with_conditional(
                schema.del_effects.iter().map(ground).collect(),
                schema,
                task,
                &operator.del_effects,
            ),
            needs: schema.preconditions.iter().map(ground).collect(),
        }
    }

    /// The same where some things go into others, not onto them: the rules' "on" may mean both.
    #[must_use]
    pub fn putting(mut self, into: &BTreeSet<(String, String)>) -> Self {
        let on = name_key(predicate::THING_ON);
        for effect in &mut self.adds {
            if effect.predicate == on
                && let [thing, holder] = &effect.args[..]
                && into.contains(&(thing.clone(), holder.clone()))
            {
                effect.predicate = name_key(predicate::THING_IN);
            }
        }
        self
    }

    /// What the vehicle has to do, in this order. Empty for an action that only changes what is known.
    #[must_use]
    pub fn primitives(&self) -> Vec<Primitive> {
        let mut primitives = Vec::new();
        if let Some([lift, door]) = self.added(predicate::CABIN_AT) {
            let (lift, door) = (lift.clone(), door.clone());
            primitives.push(match self.added(predicate::ROBOT_IN) {
                Some([to, ..]) => Primitive::Ride { lift, to: to.clone(), door },
                _ => Primitive::CallLift { lift, door },
            });
        } else if let Some([place]) = self.added(predicate::ROBOT_AT_PLACE) {
            primitives.push(Primitive::GoToPlace(place.clone()));
        } else if let Some([door]) = self.added(predicate::ROBOT_AT_DOOR) {
            primitives.push(Primitive::GoToDoor(door.clone()));
        } else if let (Some([area]), Some([door])) =
            (self.added(predicate::ROBOT_IN), find(&self.needs, predicate::ROBOT_AT_DOOR))
        {
            primitives.push(Primitive::Cross { door: door.clone(), into: area.clone() });
        }
        let states = [
            (predicate::DOOR_OPEN, DoorStatus::Open),
            (predicate::DOOR_CLOSED, DoorStatus::Closed),
            (predicate::DOOR_LOCKED, DoorStatus::Locked),
        ];
        for (name, status) in states {
            if let Some([door, ..]) = self.added(name) {
                primitives.push(Primitive::SetDoor { door: door.clone(), status });
            }
        }
        for (name, open) in [(predicate::STANDS_OPEN, true), (predicate::STANDS_SHUT, false)] {
            if let Some([thing]) = self.added(name) {
                primitives.push(Primitive::SetOpen { thing: thing.clone(), open });
            }
        }
        if let Some([thing, ..]) = find(&self.deletes, predicate::BLOCKS_DOOR) {
            primitives.push(Primitive::Push(thing.clone()));
        }
        if let Some([thing]) = self.added(predicate::ROBOT_HOLDS) {
            primitives.push(Primitive::Take(thing.clone()));
        }
        if let Some([thing]) = find(&self.deletes, predicate::ROBOT_HOLDS) {
            let thing = thing.clone();
            primitives.push(if let Some([_, person]) = self.added(predicate::HANDED_OVER) {
                Primitive::HandOver { thing, person: person.clone() }
            } else {
                let put = self.added(predicate::THING_ON).or(self.added(predicate::THING_IN));
                let onto = put.and_then(|args| args.get(1)).cloned();
                Primitive::Put { thing, onto }
            });
        }
        for (predicate, on) in [(predicate::DEVICE_ON, true), (predicate::DEVICE_OFF, false)] {
            if let Some([device]) = self.added(predicate) {
                primitives.push(Primitive::Switch { device: device.clone(), on });
            }
        }
        let lit = [(self.added(predicate::ROOM_LIT), true)]
            .into_iter()
            .chain([(find(&self.deletes, predicate::ROOM_LIT), false)]);
        for (_, on) in lit.filter(|(room, _)| room.is_some()) {
            if let Some([lamp, _]) = find(&self.needs, predicate::SWITCH_OF_LIGHT) {
                primitives.push(Primitive::Switch { device: lamp.clone(), on });
            }
        }
        if self.added(predicate::ROOM_INSPECTED).is_some() {
            primitives.push(Primitive::LookRound);
        }
        if let Some([thing]) = self.added(predicate::FOUND) {
            primitives.push(Primitive::Seek(thing.clone()));
        }
        if let Some([person]) = self.added(predicate::CALLED) {
            primitives.push(Primitive::Call(person.clone()));
        }
        primitives
    }

    /// Whether a fact of this predicate holds afterwards.
    #[must_use]
    pub fn brings_about(&self, predicate: &str) -> bool {
        self.added(predicate).is_some()
    }

    /// Whether it takes a fact of this predicate.
    #[must_use]
    pub fn needs(&self, predicate: &str) -> bool {
        find(&self.needs, predicate).is_some()
    }

    fn added(&self, predicate: &str) -> Option<&[String]> {
        find(&self.adds, predicate)
    }
}

fn find<'a>(effects: &'a [Effect], predicate: &str) -> Option<&'a [String]> {
    let key = name_key(predicate);
    effects.iter().find(|e| e.predicate == key).map(|e| e.args.as_slice())
}

/// `Движение-из_в_через-дверь_(Комната-В, Комната-Z, Дверь-ВZ)`, as the paper prints a directive.
impl std::fmt::Display for Directive {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}_({})", self.action, self.args.join(", "))
    }
}
