//! What records are like: their properties and those of their sides, probabilities, the states of doors.

use super::super::said::{entry, table};
use super::super::verbs::Edit;
use super::{Done, Kind, MapError, Outcome, Record, Step, Steps, misprint};
use crate::file::decode::shortened;
use crate::file::node::{Entry, Value};
use crate::file::records::door_state;
use crate::file::schema::Number;
use crate::units::{nearest_name, said};
use crate::{DoorStatus, Properties};

/// Kinds that have properties.
const PROPERTIED: &[Kind] =
    &[Kind::Replica, Kind::Area, Kind::Door, Kind::Object, Kind::Orthoframe];

impl Steps<'_> {
    pub(super) fn set(&mut self, step: &Step<'_>, edit: &Edit) -> Done {
        let Edit::Set { name, property, value, side, move_prob, kind } = edit else {
            unreachable!("it is of its verb")
        };
        if let Some(probability) = *move_prob {
            let record = self.find(name, step.span(), &[Kind::Replica])?;
            let Record::Replica(id) = record else { unreachable!("it was looked for among these") };
            let new = step.copies(&["move_prob"]);
            new.into_iter().for_each(|new| self.said.of(record).put(new));
            let read = self.reading(|reader| reader.move_prob(id, probability));
            self.replica_mut(id).move_prob = read;
            if property.is_none() {
                return Ok(());
            }
        }
        let property = property.as_ref().ok_or_else(|| step.missing("property"))?;
        let value = value.as_ref().ok_or_else(|| step.missing("value"))?;
        let record = self.with_properties(step, name, side.as_deref(), kind.as_deref())?;
        let properties = self.properties(step, record, side.as_deref())?;
        properties.insert(property.clone(), value.clone());
        let told = step.entry("value").map(|e| Entry { key: property.clone(), ..e.clone() });
        let said = self.said.of(record);
        let of = match side {
            Some(side) => said.table_at("side").table_at(side),
            None => said,
        };
        told.into_iter().for_each(|told| of.table_at("properties").put(told));
        Ok(())
    }

    pub(super) fn unset(
        &mut self,
        step: &Step<'_>,
        name: &str,
        property: &str,
        side: Option<&str>,
        kind: Option<&str>,
    ) -> Done {
        let record = self.with_properties(step, name, side, kind)?;
        if self.properties(step, record, side)?.remove(property).is_none() {
            let (what, nearest) = (said!("property"), None);
            let error = MapError::UnknownReference { what, name: property.to_owned(), nearest };
            return Err(misprint(error, step.at("property")));
        }
        Ok(())
    }

    /// The record that a step speaks of, or that has the side of which it speaks.
    fn with_properties(
        &self,
        step: &Step<'_>,
        name: &str,
        side: Option<&str>,
        kind: Option<&str>,
    ) -> Outcome<Record> {
        let kinds = match side {
            Some(_) => vec![Kind::Orthoframe],
            None => self.kinds(step, kind, PROPERTIED)?,
        };
        self.find(name, step.span(), &kinds)
    }

    fn properties(
        &mut self,
        step: &Step<'_>,
        record: Record,
        side: Option<&str>,
    ) -> Outcome<&mut Properties> {
        let world = &mut self.world;
        macro_rules! of {
            ($records:ident, $id:expr) => {
                &mut world.$records.get_mut(&$id).expect("it was found").properties
            };
        }
        Ok(match (record, side) {
            (Record::Orthoframe(id), Some(side)) => {
                let base = &mut world.orthoframes.get_mut(&id).expect("it was found").base;
                let Some(at) = base.iter().position(|vector| vector.id == side) else {
                    let ids = base.iter().map(|vector| vector.id.as_str());
                    let nearest = nearest_name(side, ids).map(str::to_owned);
                    let (what, name) = (said!("side"), shortened(side));
                    let error = MapError::UnknownReference { what, name, nearest };
                    return Err(misprint(error, step.span()));
                };
                &mut base[at].properties
            }
            (Record::Orthoframe(id), None) => of!(orthoframes, id),
            (Record::Replica(id), _) => of!(replicas, id),
            (Record::Area(id), _) => of!(areas, id),
            (Record::Door(id), _) => of!(doors, id),
            (Record::Object(id), _) => of!(objects, id),
            _ => unreachable!("it was looked for among these"),
        })
    }

    /// The state of a door, or of a door of a replica's Object on that replica.
    pub(super) fn state(
        &mut self,
        step: &Step<'_>,
        name: &str,
        is: DoorStatus,
        opening: Option<Number>,
        on: Option<&str>,
    ) -> Done {
        let record = self.find(name, step.span(), &[Kind::Door])?;
        let Record::Door(door) = record else { unreachable!("it was looked for among doors") };
        let state = door_state(is, opening);
        let mut told = step.copies(&["opening"]);
        told.extend(step.entry("is").map(|e| Entry { key: "state".to_owned(), ..e.clone() }));
        let Some(on) = on else {
            self.world.doors.get_mut(&door).expect("it was found").state = state;
            let said = self.said.of(record);
            said.drop_entry("opening");
            told.into_iter().for_each(|field| said.put(field));
            return Ok(());
        };
        let replica = self.find(on, step.at("on"), &[Kind::Replica])?;
        let Record::Replica(id) = replica else { unreachable!("it was looked for among these") };
        self.replica_mut(id).door_states.insert(door, state);
        let key = self.reference(record);
        let node = table(step.at("is"), told);
        let said = self.said.of(replica);
        if said.entry("doors").is_none() {
            said.put(entry("doors", step.at("on"), Value::Table(Vec::new())));
        }
        said.table_at("doors").put(Entry { key, key_span: step.span().clone(), node });
        Ok(())
    }
}
