//! Fields of an edit, and how a file tells each of them.

use serde::Deserialize;

use super::super::schema::{
    Coordinates, DoorStateFile, FormsFile, Number, OpensFile, Pairs, PermeabilityFile, StatusFile,
    Table, ZoneWord, is_default,
};
use super::super::text::{Printed, line};
use crate::{DoorStatus, OpensTo, Permeability};

/// What a field holds, and what stands for it in a file.
pub(super) trait InFile: Clone {
    type File: for<'de> Deserialize<'de> + Printed;

    fn of(file: Self::File) -> Self;
    fn file(&self) -> Self::File;

    /// The field as a line of a file.
    fn told(&self, field: &str) -> String {
        line(field, &self.file())
    }
}

/// A field that need not be told, as a line of a file.
pub(super) fn told<T: InFile + Default + PartialEq>(field: &str, value: &T) -> String {
    if is_default(value) { String::new() } else { value.told(field) }
}

macro_rules! as_it_is {
    ($($plain:ty),+) => {$(
        impl InFile for $plain {
            type File = Self;

            fn of(file: Self) -> Self {
                file
            }
            fn file(&self) -> Self {
                self.clone()
            }
        }
    )+};
}
as_it_is!(
    String,
    bool,
    u32,
    Number,
    Coordinates,
    ZoneWord,
    [Number; 2],
    Vec<[Number; 2]>,
    Vec<String>,
    Pairs,
    FormsFile,
    Table<DoorStateFile>
);

macro_rules! words {
    ($($model:ty: $word:ty),+) => {$(
        impl InFile for $model {
            type File = $word;

            fn of(file: $word) -> Self {
                file.into()
            }
            fn file(&self) -> $word {
                (*self).into()
            }
        }
    )+};
}
words!(DoorStatus: StatusFile, OpensTo: OpensFile, Permeability: PermeabilityFile);

impl<T: InFile> InFile for Option<T> {
    type File = Option<T::File>;

    fn of(file: Self::File) -> Self {
        file.map(T::of)
    }
    fn file(&self) -> Self::File {
        self.as_ref().map(T::file)
    }
}
