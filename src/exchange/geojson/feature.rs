//! GeoJSON (RFC 7946) → features: geometry as flat lists of points, properties as they stand.
//!
//! A text that is no JSON is refused with its place. A feature whose geometry is not of the standard is left out
//! with a remark; unknown members are passed over. Coordinates are read straight into points, so that two million
//! vertices take 32 MB.

use std::borrow::Cow;
use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, SeqAccess, Visitor};
use serde_json::value::RawValue;
use serde_json::{Map, Value};

use crate::units::{Bilingual, Source, said, word};
use crate::{ReadError, Remark};

pub(super) const FORMAT: &str = "GeoJSON";
/// Features of one file.
const MOST_FEATURES: usize = 1_000_000;

/// A position: the first two numbers, in whatever unit the file counts.
pub(super) type Position = [f64; 2];

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Shape {
    Points(Vec<Position>),
    Lines(Vec<Vec<Position>>),
    /// Each an outer ring and its holes.
    Polygons(Vec<Vec<Vec<Position>>>),
}

impl Shape {
    pub(super) fn positions(&self) -> Box<dyn Iterator<Item = Position> + '_> {
        match self {
            Self::Points(points) => Box::new(points.iter().copied()),
            Self::Lines(lines) => Box::new(lines.iter().flatten().copied()),
            Self::Polygons(polygons) => Box::new(polygons.iter().flatten().flatten().copied()),
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Feature {
    pub id: String,
    /// IMDF's `feature_type`; empty elsewhere.
    pub feature_type: String,
    pub shape: Option<Shape>,
    pub properties: Map<String, Value>,
}

impl Feature {
    /// A property as a text, numbers included; none for what is empty.
    pub(super) fn text(&self, key: &str) -> Option<Cow<'_, str>> {
        scalar(self.properties.get(key)?).filter(|text| !text.trim().is_empty())
    }

    /// The first of some properties that says anything. Keys are compared without regard to case.
    pub(super) fn first(&self, keys: &[&str]) -> Option<Cow<'_, str>> {
        keys.iter().find_map(|key| self.text(key)).or_else(|| {
            let spelled = |key: &&str| {
                let same = |(k, _): &(&String, &Value)| k.to_lowercase() == **key;
                self.properties.iter().find(same).and_then(|(_, v)| scalar(v))
            };
            keys.iter().find_map(spelled).filter(|text| !text.trim().is_empty())
        })
    }

    /// The first of some properties that begins with a number: `"0.9 m"` is 0.9.
    pub(super) fn number(&self, keys: &[&str]) -> Option<f64> {
        leading_number(&self.first(keys)?)
    }
}

/// The number with which a text begins, comma or point.
pub(super) fn leading_number(text: &str) -> Option<f64> {
    let text = text.trim();
    let end = text.find(|c: char| !(c.is_ascii_digit() || "+-.,eE".contains(c)));
    let number = text[..end.unwrap_or(text.len())].replace(',', ".");
    number.parse().ok().filter(|n: &f64| n.is_finite())
}

fn scalar(value: &Value) -> Option<Cow<'_, str>> {
    match value {
        Value::String(text) => Some(Cow::Borrowed(text)),
        Value::Number(n) => Some(Cow::Owned(n.to_string())),
        Value::Bool(true) => Some(Cow::Borrowed("yes")),
        Value::Bool(false) => Some(Cow::Borrowed("no")),
        _ => None,
    }
}

/// What stands around the features of a file.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Surroundings {
    pub name: String,
    /// Name of the coordinate reference system, of the older standard.
    pub crs: String,
    /// Unit of the coordinates where the file tells: a member that this program writes.
    pub units: String,
}

#[derive(Deserialize)]
struct File<'a> {
    #[serde(borrow, rename = "type")]
    kind: Option<Cow<'a, str>>,
    #[serde(borrow)]
    features: Option<Vec<&'a RawValue>>,
    #[serde(borrow)]
    geometry: Option<&'a RawValue>,
    name: Option<Value>,
    crs: Option<Value>,
    units: Option<Value>,
}

#[derive(Deserialize)]
struct RawFeature<'a> {
    id: Option<Value>,
    feature_type: Option<Value>,
    #[serde(borrow)]
    geometry: Option<RawGeometry<'a>>,
    properties: Option<Map<String, Value>>,
}

#[derive(Deserialize)]
struct RawGeometry<'a> {
    #[serde(borrow, rename = "type")]
    kind: Cow<'a, str>,
    #[serde(borrow)]
    coordinates: Option<&'a RawValue>,
}

/// A position that reads its first two numbers and passes over height and whatever follows.
struct At(Position);

impl<'de> Deserialize<'de> for At {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Seq;
        impl<'de> Visitor<'de> for Seq {
            type Value = At;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("two coordinates")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<At, A::Error> {
                let missing = || serde::de::Error::invalid_length(0, &self);
                let x = seq.next_element()?.ok_or_else(missing)?;
                let y = seq.next_element()?.ok_or_else(missing)?;
                while seq.next_element::<IgnoredAny>()?.is_some() {}
                Ok(At([x, y]))
            }
        }
        deserializer.deserialize_seq(Seq)
    }
}

/// The features of a text, in the order of the file.
pub(super) fn features(
    source: &Source,
    remarks: &mut Vec<Remark>,
) -> Result<(Surroundings, Vec<Feature>), ReadError> {
    let text = source.text();
    let file: File<'_> = serde_json::from_str(text).map_err(|e| json_fault(source, &e))?;
    let word = |value: &Option<Value>| {
        value.as_ref().and_then(scalar).map(Cow::into_owned).unwrap_or_default()
    };
    let crs = file.crs.as_ref().and_then(|crs| crs.pointer("/properties/name")?.as_str());
    let around = Surroundings {
        name: word(&file.name),
        crs: crs.unwrap_or_default().to_owned(),
        units: word(&file.units),
    };
    let raw: Vec<&str> = match (&file.features, file.kind.as_deref()) {
        (Some(features), _) => features.iter().map(|f| f.get()).collect(),
        (None, Some("Feature")) if file.geometry.is_some() => vec![text.trim()],
        (None, kind) => {
            let what = match kind {
                Some(kind) => {
                    said!("type-is-here-and-featurecollection", shorten = shorten(kind))
                }
                None => word!("there-are-no-members-type").into(),
            };
            return Err(ReadError::NoBuilding { format: FORMAT, what });
        }
    };
    if raw.len() > MOST_FEATURES {
        let what = said!("records-features");
        return Err(ReadError::TooMany { format: FORMAT, what, limit: MOST_FEATURES });
    }
    let mut features = Vec::with_capacity(raw.len());
    for (no, text) in raw.into_iter().enumerate() {
        match feature(text, no) {
            Ok(feature) => features.push(feature),
            Err(why) => remarks.push(Remark {
                source: format!("features[{no}]"),
                text: said!("record-left-out", why),
            }),
        }
    }
    Ok((around, features))
}

fn feature(text: &str, no: usize) -> Result<Feature, Bilingual> {
    let raw: RawFeature<'_> = serde_json::from_str(text).map_err(|e| reason(&e))?;
    let properties = raw.properties.unwrap_or_default();
    let own = |keys: [&str; 3]| keys.iter().find_map(|k| scalar(properties.get(*k)?));
    let id = raw.id.as_ref().and_then(scalar).or_else(|| own(["@id", "id", "uuid"]));
    let id = id.map_or_else(|| format!("#{no}"), Cow::into_owned);
    let feature_type = raw.feature_type.as_ref().and_then(scalar).map(Cow::into_owned);
    let shape = raw.geometry.map(|g| shape(&g)).transpose()?;
    Ok(Feature { id, feature_type: feature_type.unwrap_or_default(), shape, properties })
}

fn shape(raw: &RawGeometry<'_>) -> Result<Shape, Bilingual> {
    fn coordinates<'a, T: Deserialize<'a>>(raw: &RawGeometry<'a>) -> Result<T, Bilingual> {
        let text = raw.coordinates.ok_or(word!("the-geometry-has-no-coordinates"))?.get();
        serde_json::from_str(text).map_err(|e| {
            let (kind, reason) = (shorten(&raw.kind), reason(&e));
            Bilingual::both(|language| format!("{kind}: {}", reason.say(language)))
        })
    }
    let line = |line: Vec<At>| line.into_iter().map(|at| at.0).collect::<Vec<_>>();
    let lines = |lines: Vec<Vec<At>>| lines.into_iter().map(line).collect::<Vec<_>>();
    Ok(match &*raw.kind {
        "Point" => Shape::Points(vec![coordinates::<At>(raw)?.0]),
        "MultiPoint" => Shape::Points(line(coordinates(raw)?)),
        "LineString" => Shape::Lines(vec![line(coordinates(raw)?)]),
        "MultiLineString" => Shape::Lines(lines(coordinates(raw)?)),
        "Polygon" => Shape::Polygons(vec![lines(coordinates(raw)?)]),
        "MultiPolygon" => {
            let polygons: Vec<Vec<Vec<At>>> = coordinates(raw)?;
            Shape::Polygons(polygons.into_iter().map(lines).collect())
        }
        other => {
            return Err(said!("the-geometry-is-not-read", shorten = shorten(other)));
        }
    })
}

/// A fault of the JSON text with its place.
pub(crate) fn json_fault(source: &Source, error: &serde_json::Error) -> ReadError {
    let text = source.text();
    let start = |line: usize| {
        let mut ends = text.match_indices('\n').map(|(at, _)| at + 1);
        if line < 2 { 0 } else { ends.nth(line - 2).unwrap_or(text.len()) }
    };
    let at = start(error.line()) + error.column().saturating_sub(1);
    ReadError::syntax(FORMAT, reason(error), source, at)
}

/// What serde_json says, without the place, which is shown apart.
fn reason(error: &serde_json::Error) -> Bilingual {
    let text = error.to_string();
    let end = text.rfind(" at line ").unwrap_or(text.len());
    let said = shorten(&text[..end]);
    if error.is_eof() { said!("the-text-is-cut-off", said) } else { said.into() }
}

/// A word from a file for a message: at most 60 letters of it.
pub(super) fn shorten(text: &str) -> String {
    let mut short: String = text.chars().take(60).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short
}
