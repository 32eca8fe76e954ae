//! Whether the robot can take a thing into its hand: what hinders it, as far as the map and its senses tell.
//!
//! Invariant: that it can is said to be by what is known, for only who tries knows.

use super::Draft;
use crate::map::{DoorStatus, Entity};
use crate::question::knowledge::Knowledge;
use crate::question::query::{Noun, Rel, Thing};
use crate::question::{Doubt, Said};
use crate::report::Detail;
use crate::words::{Case, length};

impl Knowledge<'_> {
    /// «диван робот не носит», "I can take the book: nothing that I know of hinders it"
    pub(in crate::question) fn may_take(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        if let Some(hindrance) = self.hinders_taking(thing) {
            return Ok(Draft::new(Said::No, hindrance).with(vec![thing]));
        }
        let text = match self.is_russian() {
            true => format!(
                "{} я могу взять: ничто из известного этому не мешает",
                self.form(thing, Case::Accusative)
            ),
            false => format!("I can take {}: nothing that I know of hinders it", self.name(thing)),
        };
        Ok(Draft::new(Said::Yes, text).with(vec![thing]))
    }

    fn hinders_taking(&self, thing: Thing) -> Option<String> {
        let (name, of) = (self.name(thing), self.form(thing, Case::Genitive));
        let told = |russian: String, english: String| {
            Some(if self.is_russian() { russian } else { english })
        };
        let carried = |id: &_| self.world.has_trait(*id, "portable");
        let Some(id) = thing.replica().filter(carried) else {
            let what = self.form(thing, Case::Accusative);
            return told(
                format!("{what} робот не носит"),
                format!("the robot does not carry {name}"),
            );
        };
        let held = self.senses.held();
        if held.contains(&id) {
            return told(
                format!("{name} уже у меня в руках"),
                format!("I am holding {name} already"),
            );
        }
        if !held.is_empty() {
            let held: Vec<Thing> =
                held.into_iter().map(|id| Thing::Entity(Entity::Replica(id))).collect();
            let held = self.list(&held);
            return told(
                format!("в руках у меня {held}: сначала это надо положить"),
                format!("I am holding {held}: that is to be put down first"),
            );
        }
        if self.senses.holder(id).is_some() || self.senses.doubted(id).is_some() {
            return told(
                format!("я не знаю, где {name}"),
                format!("I do not know where {name} is"),
            );
        }
        let replicas = self.world.replicas.keys().map(|id| Thing::Entity(Entity::Replica(*id)));
        let locks = |holder: &Thing| {
            let locked = |(status, _): &(DoorStatus, _)| *status == DoorStatus::Locked;
            self.statuses(*holder).iter().any(locked)
                && self.related(Rel::In, *holder).contains(&thing)
        };
        if let Some(holder) = replicas.into_iter().find(locks) {
            let (within, holder) = (self.place(Rel::In, &[holder]), self.name(holder));
            return told(
                format!("{name} {} {within}, а {holder} на замке", self.is(&[thing])),
                format!("{name} {} {within}, and {holder} is locked", self.is(&[thing])),
            );
        }
        if let Err(why) = self.senses.way(None, thing, self.language, Detail::Region) {
            return told(
                format!("до {of} мне не добраться: {why}"),
                format!("I cannot get to {name}: {why}"),
            );
        }
        let beyond = length(self.senses.beyond_arm(id)?, self.language);
        told(
            format!(
                "до {of} не дотянуться: там, где робот встаёт ближе всего, руке не хватает {beyond}"
            ),
            format!(
                "{name} is out of reach: where I can stand nearest to it, my arm is {beyond} too short"
            ),
        )
    }
}
