//! `ortho export`: the map in other programs' formats.

use std::path::{Path, PathBuf};

use crate::engine::Engine;
use crate::map::Format;
use crate::units::{MapId, told, write_file};

use super::args::{Common, ExportArgs};
use super::fault::Failure;
use super::notes::note;
use super::opened::open;
use super::{Answer, json, say};

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
        let is_single = args.floor.is_some() || engine.world()?.maps.len() == 1;
        let graph = match is_single {
            true => engine.export_route_graph(engine.map_named(args.floor.as_deref())?)?,
            false => engine.export_route_graph_of_all()?,
        };
        write(path, graph.as_bytes(), &mut written)?;
    }
    if let Some(path) = &args.mesh {
        let floor = args.floor.as_deref();
        let only = floor.map(|name| engine.map_named(Some(name))).transpose()?;
        write(path, engine.export_mesh(only)?.as_bytes(), &mut written)?;
    }
    if let Some(dir) = &args.ros {
        grids(&engine, args, dir, &mut written)?;
    }
    if let Some(dir) = &args.masks {
        masks(common, &engine, args, dir, &mut written)?;
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
        return say(&json::exported(&names).to_string());
    }
    say(&format!("{}: {}.", told!(common.lang.language(), "written"), names.join(", ")))
}

/// A picture and its YAML for every floor, or for the one that was named.
fn grids(
    engine: &Engine,
    args: &ExportArgs,
    dir: &Path,
    written: &mut Vec<PathBuf>,
) -> Result<(), Failure> {
    std::fs::create_dir_all(dir).map_err(|e| Failure::file(dir, &e))?;
    for map in floors(engine, args)? {
        let grid = engine.export_grid(map, args.cell)?;
        picture(dir, &grid.name, &grid.yaml, &grid.pgm, written)?;
        if let Some(height) = args.laser {
            let grid = engine.export_laser_grid(map, args.cell, height)?;
            picture(dir, &grid.name, &grid.yaml, &grid.pgm, written)?;
        }
    }
    Ok(())
}

/// The masks of every floor, or of the one that was named, with the parameters of their servers.
fn masks(
    common: &Common,
    engine: &Engine,
    args: &ExportArgs,
    dir: &Path,
    written: &mut Vec<PathBuf>,
) -> Result<(), Failure> {
    std::fs::create_dir_all(dir).map_err(|e| Failure::file(dir, &e))?;
    let now = std::time::SystemTime::now().into();
    let before = written.len();
    for map in floors(engine, args)? {
        for mask in engine.export_masks(map, args.cell, now)? {
            let grid = &mask.grid;
            picture(dir, &grid.name, &grid.yaml, &grid.pgm, written)?;
            let params = dir.join(format!("{}.params.yaml", grid.name));
            write(&params, mask.params.as_bytes(), written)?;
        }
    }
    if written.len() == before {
        note(&told!(common.lang.language(), "no-mask"));
    }
    Ok(())
}

fn floors(engine: &Engine, args: &ExportArgs) -> Result<Vec<MapId>, Failure> {
    Ok(match &args.floor {
        Some(name) => vec![engine.map_named(Some(name))?],
        None => engine.world()?.maps.keys().copied().collect(),
    })
}

fn picture(
    dir: &Path,
    name: &str,
    yaml: &str,
    pgm: &[u8],
    written: &mut Vec<PathBuf>,
) -> Result<(), Failure> {
    write(&dir.join(format!("{name}.yaml")), yaml.as_bytes(), written)?;
    write(&dir.join(format!("{name}.pgm")), pgm, written)
}

fn write(path: &Path, bytes: &[u8], written: &mut Vec<PathBuf>) -> Result<(), Failure> {
    write_file(path, bytes).map_err(|e| Failure::file(path, &e))?;
    written.push(path.to_owned());
    Ok(())
}
