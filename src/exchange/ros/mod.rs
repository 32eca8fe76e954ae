//! Occupancy grids of ROS map_server (a YAML file and a picture) → [`Survey`], as a draft to be corrected.
//!
//! A grid knows no rooms and no doors. Rooms are what is left when the free floor is cut at its narrow places; a
//! narrow place is a door without leaves until somebody says what hangs in it. Outlines are brought to straight
//! walls; islands in a room become things; what the laser saw out of the building is left out (`fans`). After the YAML of map_server (`image`, `resolution`, `origin` with yaw,
//! `negate`, `occupied_thresh`, `free_thresh`, `mode`) and the distance transform of Felzenszwalb and Huttenlocher;
//! the segmentation is a watershed of that distance in which a basin counts by its persistence (Bormann et al.,
//! "Room segmentation: survey, implementation, and analysis", 2016, compares such ways).

mod doorways;
mod fans;
mod grid;
mod image;
mod rooms;
mod trace;

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::{Level, ReadError, Remark, Survey, input};
use crate::units::{Bilingual, Deg, Frame, Source, said, word};
use grid::Grid;

pub(super) const FORMAT: &str = "ROS map_server";
/// Cells of one grid: two kilometres square at half a metre, 250 m at 5 cm.
const MOST_CELLS: usize = 40_000_000;

/// What the YAML file says of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Path of the picture, relative to the YAML file.
    pub image: String,
    /// cm in a cell.
    pub resolution: f64,
    /// Where the lower left corner of the picture lies on the plan.
    pub origin: Frame,
    /// White is occupied and black is free.
    pub negate: bool,
    pub occupied_thresh: f64,
    pub free_thresh: f64,
    /// Grey is occupancy in percent; transparent is unknown. Else three values.
    pub is_raw: bool,
}

/// Whether a YAML text describes a map_server map.
#[must_use]
pub fn recognises(text: &str) -> bool {
    let has = |key: &str| text.lines().any(|line| line.trim_start().starts_with(key));
    has("image:") && has("resolution:") && has("origin:")
}

/// Reads the YAML file and the picture that it names.
///
/// # Errors
/// [`ReadError::Syntax`] or [`ReadError::Bytes`] where a file breaks its format, [`ReadError::NoBuilding`] when
/// there is no free floor as large as a room.
pub fn read(path: &Path) -> Result<Survey, ReadError> {
    let source = input::file_text(path)?;
    let sheet = sheet(&source)?;
    let named = Path::new(&sheet.image);
    let beside = |name: &Path| path.parent().unwrap_or(Path::new("")).join(name);
    let mut picture: PathBuf = beside(named);
    // Maps are copied to other machines with the path that they had.
    if !picture.is_file()
        && let Some(name) = named.file_name()
    {
        picture = beside(Path::new(name));
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    read_parts(&stem, &sheet, &input::file_bytes(&picture)?)
}

/// Makes rooms of a grid given as bytes of a PGM or PNG picture.
///
/// # Errors
/// As [`read`].
pub fn read_parts(name: &str, sheet: &Sheet, picture: &[u8]) -> Result<Survey, ReadError> {
    let picture = image::read(picture)?;
    let grid = Grid::of(sheet, &picture);
    let (width, height, cell) = (grid.width, grid.height, sheet.resolution);
    let mut remarks =
        vec![Remark { source: String::new(), text: said!("grid", width, height, cell) }];
    let mut level =
        Level { source: name.to_owned(), name: "Этаж 1".to_owned(), ..Level::default() };
    let kinds = rooms::furnish(&grid, sheet, &mut level, &mut remarks);
    if level.rooms.is_empty() {
        let what = word!("the-grid-has-no-free").into();
        return Err(ReadError::NoBuilding { format: FORMAT, what });
    }
    Ok(Survey { name: name.to_owned(), levels: vec![level], kinds, remarks, ..Survey::default() })
}

/// The fields of the YAML file.
///
/// # Errors
/// [`ReadError::Syntax`] when it is no YAML, [`ReadError::NoBuilding`] when a field is missing or makes no sense.
pub fn sheet(source: &Source) -> Result<Sheet, ReadError> {
    let root: Value = super::yaml::parse(source, FORMAT, word!("of-a-map"))?;
    let wrong = |what: Bilingual| ReadError::NoBuilding { format: FORMAT, what };
    let number = |key: &str| root.get(key).and_then(as_number);
    let share = |key: &str, usual: f64| match root.get(key) {
        None => Ok(usual),
        Some(v) => as_number(v)
            .filter(|x| (0.0..=1.0).contains(x))
            .ok_or_else(|| wrong(said!("is-no-number-from-0", key))),
    };
    let image = root.get("image").and_then(Value::as_str).filter(|i| !i.is_empty());
    let resolution = number("resolution").map(|r| r * 100.0).filter(|r| (0.1..=1000.0).contains(r));
    let origin = match root.get("origin") {
        None => vec![0.0; 3],
        Some(list) => list
            .as_array()
            .map(|l| l.iter().map(as_number).collect::<Option<Vec<f64>>>())
            .and_then(|l| l.filter(|l| l.len() >= 2 && l.iter().all(|x| x.abs() <= 1e4)))
            .ok_or_else(|| wrong(said!("bad-origin")))?,
    };
    let negate = match root.get("negate") {
        None => false,
        Some(Value::Bool(b)) => *b,
        Some(v) => as_number(v).is_some_and(|n| n != 0.0),
    };
    Ok(Sheet {
        image: image.ok_or_else(|| wrong(said!("the-field-image-is-missing")))?.to_owned(),
        resolution: resolution.ok_or_else(|| wrong(said!("bad-resolution")))?,
        origin: Frame::new(
            origin[0] * 100.0,
            origin[1] * 100.0,
            0.0,
            Deg::from_radians(origin.get(2).copied().unwrap_or(0.0)),
        ),
        negate,
        occupied_thresh: share("occupied_thresh", 0.65)?,
        free_thresh: share("free_thresh", 0.25)?,
        is_raw: root.get("mode").and_then(Value::as_str) == Some("raw"),
    })
}

fn as_number(value: &Value) -> Option<f64> {
    let number = value.as_f64().or_else(|| value.as_str()?.trim().parse().ok());
    number.filter(|n| n.is_finite())
}
