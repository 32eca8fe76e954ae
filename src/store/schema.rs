//! What a table is: its columns, its key, its origin; and the macro that declares one record type a table.

use super::cell::{Cell, Field, Key, Kind};

/// Where a table or a column comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// Paper 2, under exactly its name.
    Paper,
    /// Paper 2, but computed from other tables when asked for, never stored and never edited.
    Derived,
    /// No paper has it; the map needs it.
    Beyond,
    /// What the store notes of itself and of the robot; not part of the map, so it makes no new revision.
    Log,
}

/// A column of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    pub name: &'static str,
    pub kind: Kind,
    pub is_key: bool,
    /// The paper's table lacks it.
    pub is_beyond: bool,
}

/// The key of a row: its key columns in the order of the table, which is the paper's.
pub(crate) fn key_of(columns: &[Column], row: &[Cell]) -> Option<Key> {
    columns
        .iter()
        .zip(row)
        .filter(|(column, _)| column.is_key)
        .try_fold(Key::new(), |key, (column, cell)| key.cell(cell, column.kind))
}

pub(crate) fn field<T: Field + Default>(row: &[Cell], index: usize) -> Option<T> {
    // An older row ends before a column that was added later.
    row.get(index).map_or_else(|| Some(T::default()), T::from_cell)
}

pub(crate) const fn column(name: &'static str, kind: Kind, role: (bool, bool)) -> Column {
    Column { name, kind, is_key: role.0, is_beyond: role.1 }
}

/// `(is_key, is_beyond)` of the word that stands before a column.
macro_rules! role {
    (key) => {
        (true, false)
    };
    (col) => {
        (false, false)
    };
    (beyond) => {
        (false, true)
    };
    (beyond_key) => {
        (true, true)
    };
}

macro_rules! tables {
    ($($(#[$doc:meta])* $origin:ident $record:ident = $code:literal {
        $($role:ident $field:ident: $type:ty = $name:literal,)+
    })+) => {
        /// The tables of a store.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum Table { $($(#[$doc])* $record = $code,)+ }

        impl Table {
            /// All tables, those computed included, in the order of paper 2.
            pub const ALL: &'static [Self] = &[$(Self::$record),+];

            /// The paper's name, which is also the name of the sled tree.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(Self::$record => stringify!($record),)+ }
            }

            #[must_use]
            pub fn origin(self) -> Origin {
                match self { $(Self::$record => Origin::$origin,)+ }
            }

            /// Whether these cells are a record of this table.
            #[must_use]
            pub fn fits(self, row: &[Cell]) -> bool {
                row.len() <= self.columns().len()
                    && match self { $(Self::$record => $record::from_row(row).is_some(),)+ }
            }

            /// The cells of a record with all columns of the table: an older row ends before a column that was added
            /// later. None when they are no record of it.
            #[must_use]
            pub fn full(self, row: &[Cell]) -> Option<Row> {
                match self { $(Self::$record => $record::from_row(row).map(|r| r.to_row()),)+ }
            }

            #[must_use]
            pub fn columns(self) -> &'static [Column] {
                match self {
                    $(Self::$record => const { &[
                        $(column($name, <$type as Field>::KIND, role!($role)),)+
                    ] },)+
                }
            }
        }

        $(
            $(#[$doc])*
            #[derive(Debug, Clone, PartialEq, Default)]
            pub struct $record { $(pub $field: $type,)+ }

            impl Record for $record {
                const TABLE: Table = Table::$record;

                fn to_row(&self) -> Row {
                    vec![$(self.$field.to_cell(),)+]
                }

                fn from_row(row: &[Cell]) -> Option<Self> {
                    let mut index = 0..;
                    Some(Self { $($field: field(row, index.next()?)?,)+ })
                }
            }
        )+
    };
}

pub(crate) use {role, tables};
