//! A sheet: the live records of the map at one revision. Written from a world in [`super::write`], read in [`super::read`].
//!
//! **Invariant**: `Sheet::of(world)?.world()? == world`, to the last bit and in the same order.

use std::collections::BTreeMap;

use super::cell::{Key, Row};
use super::error::{Result, StoreError};
use super::schema::key_of;
use super::tables::{Record, Table};

/// Records of one revision by table and key.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sheet {
    tables: BTreeMap<Table, BTreeMap<Key, Row>>,
}

impl Sheet {
    pub(crate) fn put<T: Record>(&mut self, record: &T) -> Result<()> {
        let (table, row) = (T::TABLE, record.to_row());
        let key = key_of(table.columns(), &row).expect("a record's key fields are ids and texts");
        match self.tables.entry(table).or_default().entry(key) {
            std::collections::btree_map::Entry::Vacant(place) => {
                place.insert(row);
                Ok(())
            }
            std::collections::btree_map::Entry::Occupied(place) => Err(StoreError::Duplicate {
                table: table.name(),
                key: describe_key(table, place.get()),
            }),
        }
    }

    pub(crate) fn insert(&mut self, table: Table, key: Key, row: Row) {
        self.tables.entry(table).or_default().insert(key, row);
    }

    pub(crate) fn remove(&mut self, table: Table, key: &Key) {
        if let Some(rows) = self.tables.get_mut(&table) {
            rows.remove(key);
        }
    }

    /// Adds a row that came from elsewhere, a table of SQL for one.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when the cells do not fit the table's columns, [`StoreError::Duplicate`] when
    /// there is a row with this key already, [`StoreError::DerivedTable`] for a table that is computed.
    pub fn add(&mut self, table: Table, row: Row) -> Result<()> {
        if !table.is_stored() {
            return Err(StoreError::DerivedTable { table: table.name() });
        }
        let described = || (table.name(), describe_key(table, &row));
        let key = key_of(table.columns(), &row).filter(|_| table.fits(&row));
        let Some(key) = key else {
            let (table, key) = described();
            return Err(StoreError::BadRecord { table, key });
        };
        if self.get(table, &key).is_some() {
            let (table, key) = described();
            return Err(StoreError::Duplicate { table, key });
        }
        self.insert(table, key, row);
        Ok(())
    }

    #[must_use]
    pub fn get(&self, table: Table, key: &Key) -> Option<&Row> {
        self.tables.get(&table)?.get(key)
    }

    /// The rows of a table in the order of their keys.
    pub fn rows(&self, table: Table) -> impl Iterator<Item = (&Key, &Row)> + '_ {
        self.tables.get(&table).into_iter().flatten()
    }

    /// All rows, in the order of tables and keys.
    pub fn iter(&self) -> impl Iterator<Item = (Table, &Key, &Row)> + '_ {
        self.tables.iter().flat_map(|(table, rows)| rows.iter().map(|(k, r)| (*table, k, r)))
    }

    pub(super) fn into_rows(self) -> impl Iterator<Item = (Table, Key, Row)> {
        self.tables
            .into_iter()
            .flat_map(|(table, rows)| rows.into_iter().map(move |(key, row)| (table, key, row)))
    }

    #[must_use]
    pub fn len(&self) -> usize {
        self.tables.values().map(BTreeMap::len).sum()
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The records of one type, in the order of their keys.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a row does not fit its table.
    pub fn all<T: Record>(&self) -> Result<Vec<T>> {
        self.rows(T::TABLE)
            .map(|(_, row)| {
                T::from_row(row).ok_or_else(|| StoreError::BadRecord {
                    table: T::TABLE.name(),
                    key: describe_key(T::TABLE, row),
                })
            })
            .collect()
    }
}

/// A record's key as people read it: `AreaID 3, ReplID 17`.
pub(crate) fn describe_key(table: Table, row: &[super::Cell]) -> String {
    let parts: Vec<_> = table
        .columns()
        .iter()
        .zip(row)
        .filter(|(column, _)| column.is_key)
        .map(|(column, cell)| format!("{} {cell}", column.name))
        .collect();
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use crate::Edits;
    use crate::map::{Orthoframe, Replica, World};
    use crate::units::{Cm, Frame, OrFrId, ReplicaId};

    use super::Sheet;

    /// One change of one sort.
    fn alter(world: &mut World, sort: usize) {
        let replica = *world.replicas.keys().nth(sort * 7 % world.replicas.len()).expect("some");
        let last = *world.replicas.keys().next_back().expect("some");
        match sort % 19 {
            0 | 1 => {
                let replica = world.replicas.get_mut(&replica).expect("it is there");
                let at = replica.frame;
                replica.frame = Frame::new(at.x.get() + 1.0, at.y.get(), at.z.get(), at.angle);
            }
            2 => drop(world.replicas.remove(&replica)),
            3 => {
                let id = ReplicaId(last.0 + 1);
                let twin =
                    Replica {
                        id, name: format!("Вещь-{}", id.0), ..world.replicas[&last].clone()
                    };
                world.replicas.insert(id, twin);
            }
            4 => world.doors.values_mut().take(2).for_each(|door| door.state.opening = 37.0),
            5 => world.areas.values_mut().take(2).for_each(|area| area.description.push('!')),
            6 => world.places.values_mut().take(1).for_each(|place| place.at.x += 1.0),
            7 => drop(world.places.pop_last()),
            8 => world.maps.values_mut().for_each(|map| map.description.push('!')),
            9 => world.objects.values_mut().take(1).for_each(|object| object.name.push('!')),
            10 => world.orthoframes.values_mut().take(3).for_each(|o| o.height = Cm::of(99.0)),
            11 => world.domain.name.push('!'),
            12 => {
                let part = world.orthoframes.values().next().expect("some").clone();
                let last = world.orthoframes.keys().next_back().expect("some").0;
                let id = OrFrId(last + 1);
                world
                    .orthoframes
                    .insert(id, Orthoframe { id, key: format!("part-{last}"), ..part });
                let object = world.objects.values_mut().nth(sort % 5).expect("so many");
                object.items[0].orthoframe = id;
            }
            13 => world.areas.values_mut().take(1).for_each(|area| {
                area.items.iter_mut().for_each(|item| item.frame = Frame::IDENTITY);
            }),
            14 => world.robot.speed += 1.0,
            15 => world.maps.values_mut().for_each(|map| {
                let link = map.links.pop();
                let at = sort / 19 % (map.links.len() + 1);
                link.into_iter().for_each(|link| map.links.insert(at, link));
            }),
            16 => world.maps.values_mut().for_each(|map| {
                let at = sort / 19 % map.items.len();
                map.items[at].frame.x = Cm::of(sort as f64);
            }),
            17 => {
                let id = *world.areas.keys().nth(sort / 19 % world.areas.len()).expect("some");
                if world.areas.len() > 2 {
                    world.areas.remove(&id);
                    for map in world.maps.values_mut() {
                        map.items.retain(|item| item.area != id);
                        map.links.retain(|link| link.area != id && link.to_area != id);
                    }
                }
            }
            _ => {
                // Another part in an Area's first place: the Map's records tell of it.
                let part = *world.orthoframes.keys().nth(sort % 7).expect("so many");
                let count = world.areas.len();
                let area = world.areas.values_mut().nth(sort / 19 % count).expect("so many");
                area.items[0].orthoframe = part;
            }
        }
    }

    /// What two worlds share makes no difference: the records of what they do not share tell all of it.
    #[test]
    fn the_records_of_a_change_tell_all_that_differs() {
        for map in ["../../maps/rb2.toml", "../../maps/two-storeys.toml"] {
            let mut few = 0;
            let first = World::load(map).expect("a map of the project");
            let mut before = first.clone();
            for step in 0..190_usize {
                let mut after = before.clone();
                for sort in 0..=(step / 7 % 3) {
                    alter(&mut after, step * (sort + 1) + sort);
                }
                let [whole_old, whole_new] = [&before, &after].map(|w| Sheet::of(w).expect("keys"));
                let whole = Edits::between(&whole_old, &whole_new);
                let [old, new] = Sheet::of_change(&before, &after).expect("keys");
                assert_eq!(Edits::between(&old, &new), whole, "{map}, step {step}");
                few += usize::from(!whole.is_empty() && old.len() < whole_old.len() / 2);
                // Some steps take things away.
                before = if after.replicas.len() < 3 { first.clone() } else { after };
            }
            assert!(few > 80, "{map}: {few} of 190");
        }
    }
}
