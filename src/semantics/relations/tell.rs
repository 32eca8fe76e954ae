//! What a robot knows, as rows of the relations that are told: see [`Told`].

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::asked::{Listed, ROBOT};
use crate::facts::Value;
use crate::map::{Entity, World};
use crate::measure::{hundredths, tenths};
use crate::measured::{MEASURED, Measured};
use crate::names::Subject;
use crate::told::Told;
use crate::units::{AreaId, ReplicaId};

use super::follow::{Difference, Followed};
use super::{RelationError, RelationRules, Relations};

/// The relations that are told.
const TOLD: [&str; 4] = [ROBOT_AT, SEES, BELIEVED, CARRIED_BY];
const ROBOT_AT: &str = "robot_at";
const SEES: &str = "sees";
const BELIEVED: &str = "believed";
const CARRIED_BY: &str = "carried_by";
const AT: &str = "at";
impl RelationRules {
    /// Whether the rule text asks what a robot knows.
    #[must_use]
    pub fn asks_the_robot(&self) -> bool {
        TOLD.iter().any(|name| self.asks_for(name))
    }

    /// Whether the rule text asks what the robot has in view.
    #[must_use]
    pub fn asks_for_view(&self) -> bool {
        self.asks_for(SEES)
    }

    /// A relation of the user's own that bears the name is another one.
    fn asks_for(&self, name: &str) -> bool {
        let program = self.program();
        program.relation(name).is_some_and(|id| !program.info(id).inputs.is_empty())
    }
}

impl Relations {
    /// Takes over what a robot knows instead of what it knew before, and derives what follows.
    ///
    /// # Errors
    /// As [`derive()`](super::derive).
    pub fn tell(&mut self, world: &World, told: &Told) -> Result<(), RelationError> {
        let rows = self.told_rows(world, told, |name| self.rules().asks_for(name));
        self.replace_told(rows)
    }

    /// What is told or measured on demand, for a question that reads it where the rule text does not: relations that the
    /// text knows already are left out, and `apart`, which needs a reach.
    ///
    /// # Errors
    /// Those of `tell`, which is asked for what the robot knows where that is read.
    pub fn listed<E>(
        &self,
        world: &World,
        is_read: impl Fn(&str) -> bool,
        tell: impl FnOnce() -> Result<Told, E>,
    ) -> Result<Vec<Listed>, E> {
        let wanted = |name: &str| self.rules().program().relation(name).is_none() && is_read(name);
        let told = if TOLD.iter().any(|name| wanted(name)) { tell()? } else { Told::default() };
        let mut rows = self.told_rows(world, &told, wanted);
        if wanted(AT) {
            for (&id, single) in self.measurements().singles() {
                let subject = Subject::Entity(Entity::Replica(id));
                if let Some(symbol) = self.symbols().known(subject) {
                    let at = single.at.map(Value::Number);
                    let area = Value::Symbol(self.symbols().area(single.fragment).clone());
                    let row = [Value::Symbol(symbol.clone()), area].into_iter().chain(at);
                    rows.insert((AT, row.collect()));
                }
            }
        }
        let is_listed = |name| name == AT || TOLD.contains(&name);
        let named = MEASURED.iter().filter(|relation| is_listed(relation.name));
        let listed = |relation: &Measured| {
            let of_it = rows.iter().filter(|(name, _)| *name == relation.name);
            Listed::new(relation, of_it.map(|(_, row)| row.clone()).collect())
        };
        Ok(named.filter(|relation| wanted(relation.name)).map(listed).collect())
    }

    fn told_rows(
        &self,
        world: &World,
        told: &Told,
        wanted: impl Fn(&str) -> bool,
    ) -> BTreeSet<(&'static str, Vec<Value>)> {
        let symbols = self.symbols();
        let thing = |id: ReplicaId| match symbols.known(Subject::Entity(Entity::Replica(id))) {
            Some(symbol) => Value::Symbol(symbol.clone()),
            // What is carried may have no symbol any more.
            None => Value::from(world.name(Entity::Replica(id))),
        };
        let area = |id: AreaId| Value::Symbol(symbols.area(id).clone());
        let mut rows = BTreeSet::new();
        let mut put = |name: &'static str, row: Vec<Value>| {
            if wanted(name) {
                rows.insert((name, row));
            }
        };
        if let Some((map, pose)) = &told.robot
            && let Some(room) = self.measurements().area_at(*map, pose.at)
        {
            let map = symbols.symbol(Subject::Entity(Entity::Map(*map)));
            let [x, y] = [pose.at.x, pose.at.y].map(|at| Value::Number(tenths(at)));
            let angle = Value::Number(hundredths(pose.heading.get()));
            put(ROBOT_AT, vec![Value::Symbol(map.clone()), area(room), x, y, angle]);
        }
        for &id in told.in_view.iter().filter(|id| world.replicas.contains_key(id)) {
            put(SEES, vec![thing(id)]);
        }
        for &(id, room, sure) in &told.believed {
            if world.replicas.contains_key(&id) && world.areas.contains_key(&room) {
                let sure = Value::Number((sure * 1000.0).round() as i64);
                put(BELIEVED, vec![thing(id), area(room), sure]);
            }
        }
        for (id, holder) in &told.carried {
            let holder = if holder.is_empty() { ROBOT } else { holder };
            put(CARRIED_BY, vec![thing(*id), Value::from(holder)]);
        }
        rows
    }

    /// Puts rows that are told in the place of those told before.
    ///
    /// # Errors
    /// As [`derive()`](super::derive).
    fn replace_told(
        &mut self,
        rows: BTreeSet<(&'static str, Vec<Value>)>,
    ) -> Result<(), RelationError> {
        if rows == self.told {
            return Ok(());
        }
        let out = std::mem::replace(&mut self.told, rows.clone());
        self.apply(&mut Difference { out, into: rows })?;
        self.live.update()?;
        self.follow(BTreeSet::new());
        Ok(())
    }
}

impl Followed {
    /// Tells the rules what a robot knows beside the world that was followed last, where they ask for it.
    ///
    /// # Errors
    /// As [`derive()`](super::derive).
    pub fn tell(&mut self, told: Told) -> Result<(), RelationError> {
        if self.relations.rules().asks_the_robot() {
            Arc::make_mut(&mut self.relations).tell(&self.world, &told)?;
            self.told = told;
        }
        Ok(())
    }
}
