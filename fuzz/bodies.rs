//! What is done to every reader with any bytes: read them, and hold the reader to what it promises.
//!
//! One text for two users: the targets of `fuzz_targets/`, which cargo-fuzz drives by coverage, and
//! `tests/hostile.rs`, which drives the same bodies with a seeded mutator in every test run.

use orthoframe_exchange::{self as exchange, OpeningKind, ReadError, Report, Survey, Synonyms};
use orthoframe_map::{Format, check, read};
use orthoframe_units::{Point, Source};

/// A reader's name and its body.
pub(crate) type Body = (&'static str, fn(&[u8]) -> Result<(), String>);

/// Every reader of outside data that takes bytes.
pub(crate) const BODIES: &[Body] = &[
    ("geojson", geojson),
    ("ifc", ifc),
    ("ros_grid", ros_grid),
    ("ros_sheet", ros_sheet),
    ("procthor", procthor),
    ("thor", thor),
    ("virtualhome", virtualhome),
    ("pyrobosim", pyrobosim),
    ("rmf", rmf),
    ("osmag", osmag),
    ("map_file", map_file),
];

/// A survey must keep its invariant, and the assembler must make a sound world of it or say why not.
fn judged(read: Result<Survey, ReadError>) -> Result<(), String> {
    let survey = read.map_err(|e| e.to_string())?;
    sound(&survey);
    let mut report = Report::new("fuzz", "fuzz");
    match exchange::assemble(&survey, &Synonyms::built_in(), &mut report) {
        Ok(world) => {
            let faults = check(&world);
            let errors: Vec<_> = faults.iter().filter(|f| !f.is_warning()).collect();
            assert!(errors.is_empty(), "the assembler made an unsound world: {errors:?}");
            Ok(())
        }
        Err(e) => Err(e.to_string()),
    }
}

/// Every number in a `Survey` is finite; indices into its lists are in range.
fn sound(survey: &Survey) {
    let finite = |p: &Point| assert!(p.x.is_finite() && p.y.is_finite(), "{p:?}");
    for level in &survey.levels {
        for room in &level.rooms {
            room.outline.iter().chain(room.holes.iter().flatten()).for_each(finite);
        }
        for opening in &level.openings {
            opening.jambs.iter().for_each(finite);
            let rooms = opening.rooms.iter().flatten().flatten();
            rooms.for_each(|r| assert!(*r < level.rooms.len()));
            if let OpeningKind::Door { opening, leaves, .. } = &opening.what {
                assert!(opening.is_finite());
                assert!(leaves.iter().all(|l| l.share.is_finite() && l.max_open.is_finite()));
            }
        }
        for thing in &level.things {
            finite(&thing.at);
            assert!(thing.kind < survey.kinds.len());
            assert!(thing.room.is_none_or(|r| r < level.rooms.len()));
        }
        level.spots.iter().for_each(|s| finite(&s.at));
    }
    for kind in &survey.kinds {
        kind.parts.iter().flat_map(|p| &p.outline).for_each(finite);
    }
    for (level, room) in survey.lifts.iter().flat_map(|l| &l.stops) {
        assert!(*room < survey.levels[*level].rooms.len());
    }
}

fn text(bytes: &[u8]) -> Result<Source, String> {
    exchange::decode("fuzz", bytes.to_vec()).map_err(|e| e.to_string())
}

pub(crate) fn geojson(bytes: &[u8]) -> Result<(), String> {
    judged(exchange::geojson::read(&text(bytes)?))
}

pub(crate) fn ifc(bytes: &[u8]) -> Result<(), String> {
    judged(exchange::ifc::read(&text(bytes)?))
}

/// The picture alone, under a usual sheet.
pub(crate) fn ros_grid(bytes: &[u8]) -> Result<(), String> {
    let yaml = "image: a.pgm\nresolution: 0.05\norigin: [0, 0, 0.3]\n";
    let sheet = exchange::ros::sheet(&Source::new("fuzz", yaml)).map_err(|e| e.to_string())?;
    judged(exchange::ros::read_parts("fuzz", &sheet, bytes))
}

pub(crate) fn ros_sheet(bytes: &[u8]) -> Result<(), String> {
    exchange::ros::sheet(&text(bytes)?).map(|_| ()).map_err(|e| e.to_string())
}

pub(crate) fn procthor(bytes: &[u8]) -> Result<(), String> {
    // The size of the chair in the corpus: without one the house would be refused before its things are read.
    let sizes =
        r#"{"Chair": [{"assetId": "Chair_1", "boundingBox": {"x": 0.5, "y": 0.8, "z": 0.5}}]}"#;
    let sizes = exchange::Assets::read(&Source::new("sizes", sizes)).map_err(|e| e.to_string())?;
    judged(exchange::read_procthor(&text(bytes)?, &sizes))
}

pub(crate) fn thor(bytes: &[u8]) -> Result<(), String> {
    judged(exchange::read_thor(&text(bytes)?))
}

pub(crate) fn virtualhome(bytes: &[u8]) -> Result<(), String> {
    judged(exchange::read_virtualhome(&text(bytes)?))
}

pub(crate) fn pyrobosim(bytes: &[u8]) -> Result<(), String> {
    judged(exchange::read_pyrobosim(&text(bytes)?, &mut |_| None))
}

pub(crate) fn rmf(bytes: &[u8]) -> Result<(), String> {
    judged(exchange::read_rmf(&text(bytes)?))
}

pub(crate) fn osmag(bytes: &[u8]) -> Result<(), String> {
    judged(exchange::read_osmag(&text(bytes)?))
}

pub(crate) fn map_file(bytes: &[u8]) -> Result<(), String> {
    let source = text(bytes)?;
    for format in [Format::Toml, Format::Yaml, Format::Json] {
        let _ = read(&source, format);
    }
    Ok(())
}
