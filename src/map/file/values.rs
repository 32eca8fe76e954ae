//! Numbers of a map file: finite, of modest size, and as many as are wanted.

use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Error as _, SeqAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::decode::{
    COORDINATES, MODEST_NUMBER, NUMBER, TWO_OR_THREE, a_number, a_text, expected_words, list_of,
};
use crate::fault::MapError;
use crate::units::{Bilingual, Cm};

/// A finite number of modest size: a length in cm or an angle in degrees. Whole numbers are written without a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number(pub(super) f64);

impl Number {
    pub const ZERO: Self = Self(0.0);

    #[must_use]
    pub fn get(self) -> f64 {
        self.0
    }
}

impl TryFrom<f64> for Number {
    type Error = Box<MapError>;

    fn try_from(value: f64) -> Result<Self, Box<MapError>> {
        match Cm::new(value) {
            Ok(length) => Ok(length.into()),
            Err(_) => Err(wrong(a_number(value), expected_words(MODEST_NUMBER))),
        }
    }
}

impl FromStr for Number {
    type Err = Box<MapError>;

    fn from_str(text: &str) -> Result<Self, Box<MapError>> {
        match text.trim().parse::<f64>() {
            Ok(number) => number.try_into(),
            Err(_) => Err(wrong(a_text(text), NUMBER.into())),
        }
    }
}

impl From<Cm> for Number {
    fn from(length: Cm) -> Self {
        Self(length.get())
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = f64::deserialize(deserializer)?;
        let refused = |_| D::Error::invalid_value(Unexpected::Float(value), &MODEST_NUMBER);
        Cm::new(value).map(|cm| Self(cm.get())).map_err(refused)
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.fract() == 0.0 && self.0.abs() <= Cm::LIMIT {
            serializer.serialize_i64(self.0 as i64)
        } else {
            serializer.serialize_f64(self.0)
        }
    }
}

impl JsonSchema for Number {
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }
    fn inline_schema() -> bool {
        true
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "number", "minimum": -Cm::LIMIT, "maximum": Cm::LIMIT })
    }
}

/// [x, y] or [x, y, z]; nothing stands for the origin.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct At(#[schemars(length(min = 2, max = 3))] pub Vec<Number>);

impl From<Coordinates> for At {
    fn from(at: Coordinates) -> Self {
        Self(at.numbers())
    }
}

/// Two or three numbers, [x, y] or [x, y, z].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coordinates {
    pub x: Number,
    pub y: Number,
    pub z: Option<Number>,
}

impl Coordinates {
    pub(super) fn numbers(self) -> Vec<Number> {
        [Some(self.x), Some(self.y), self.z].into_iter().flatten().collect()
    }
}

impl TryFrom<&[Number]> for Coordinates {
    type Error = Box<MapError>;

    fn try_from(numbers: &[Number]) -> Result<Self, Box<MapError>> {
        match *numbers {
            [x, y] => Ok(Self { x, y, z: None }),
            [x, y, z] => Ok(Self { x, y, z: Some(z) }),
            _ => Err(wrong(list_of(numbers.len()), TWO_OR_THREE.into())),
        }
    }
}

/// «X,Y» or «X,Y,Z».
impl FromStr for Coordinates {
    type Err = Box<MapError>;

    fn from_str(text: &str) -> Result<Self, Box<MapError>> {
        let numbers: Vec<Number> = text.split(',').map(str::parse).collect::<Result<_, _>>()?;
        Self::try_from(&numbers[..])
    }
}

impl Serialize for Coordinates {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.numbers().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Coordinates {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Axes;
        impl<'de> Visitor<'de> for Axes {
            type Value = Coordinates;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(COORDINATES)
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Coordinates, A::Error> {
                let mut axes = Vec::new();
                while let Some(axis) = seq.next_element::<Number>()? {
                    axes.push(axis);
                }
                match Coordinates::try_from(&axes[..]) {
                    Ok(coordinates) => Ok(coordinates),
                    Err(_) => Err(A::Error::invalid_length(axes.len(), &self)),
                }
            }
        }
        deserializer.deserialize_any(Axes)
    }
}

/// A point of the plane, or its fault.
///
/// # Errors
/// There are not two numbers.
pub fn pair(numbers: &[Number]) -> Result<[Number; 2], Box<MapError>> {
    match *numbers {
        [x, y] => Ok([x, y]),
        _ => Err(wrong(list_of(numbers.len()), expected_words("an array of length 2"))),
    }
}

fn wrong(found: Bilingual, expected: Bilingual) -> Box<MapError> {
    Box::new(MapError::WrongKind { found, expected })
}
