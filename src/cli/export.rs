//! `ortho export`: the map in other programs' formats.

use std::path::{Path, PathBuf};

use serde_json::json;

use crate::engine::Engine;
use crate::map::Format;
use crate::units::write_file;

use super::args::{Common, ExportArgs};
use super::commands::open;
use super::fault::Failure;
use super::{Answer, say};

pub(super) fn run(common: &Common, args: &ExportArgs) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let mut written: Vec<PathBuf> = Vec::new();
    if let Some(path) = &args.file {
        write(path, engine.export_map(Format::of(path))?.as_bytes(), &mut written)?;
    }
    if let Some(path) = &args.geojson {
        write(path, engine.export_geojson()?.as_bytes(), &mut written)?;
    }
    if let Some(path) = &args.nav2 {
        let map = engine.map_named(args.floor.as_deref())?;
        write(path, engine.export_route_graph(map)?.as_bytes(), &mut written)?;
    }
    if let Some(dir) = &args.ros {
        grids(&engine, args, dir, &mut written)?;
    }
    if let Some(path) = &args.records {
        write(path, engine.export_records()?.as_bytes(), &mut written)?;
    }
    #[cfg(feature = "sqlite")]
    if let Some(path) = &args.sqlite {
        engine.export_sqlite(path)?;
        written.push(path.clone());
    }
    let names: Vec<String> = written.iter().map(|p| p.display().to_string()).collect();
    if common.json {
        return say(&json!({ "outcome": "exported", "files": names }).to_string());
    }
    say(&format!("{}: {}.", common.lang.pick("Записано", "Written"), names.join(", ")))
}

/// A picture and its YAML for every floor, or for the one that was named.
fn grids(
    engine: &Engine,
    args: &ExportArgs,
    dir: &Path,
    written: &mut Vec<PathBuf>,
) -> Result<(), Failure> {
    std::fs::create_dir_all(dir).map_err(|e| Failure::file(dir, &e))?;
    let maps = match &args.floor {
        Some(name) => vec![engine.map_named(Some(name))?],
        None => engine.world()?.maps.keys().copied().collect(),
    };
    for map in maps {
        let grid = engine.export_grid(map, args.cell)?;
        write(&dir.join(format!("{}.yaml", grid.name)), grid.yaml.as_bytes(), written)?;
        write(&dir.join(format!("{}.pgm", grid.name)), &grid.pgm, written)?;
    }
    Ok(())
}

fn write(path: &Path, bytes: &[u8], written: &mut Vec<PathBuf>) -> Result<(), Failure> {
    write_file(path, bytes).map_err(|e| Failure::file(path, &e))?;
    written.push(path.to_owned());
    Ok(())
}
