//! `ortho watch MAP`: checks a map file and draws it again whenever it, or a rule file, has changed.

use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use crate::engine::{Drawing, Engine};
use crate::units::{InOrder as _, told};

use super::args::Common;
use super::fault::Failure;
use super::notes::{note, warn};
use super::opened::rules_dir;
use super::signals::stopped_by_signals;
use super::text::described;
use super::{Answer, json, say};

/// Between two looks at the files.
const GLANCE: Duration = Duration::from_millis(200);

/// Of each file when it was written and how long it is; editors put another file in its place, so that no handle is kept.
type Stand = Vec<(PathBuf, Option<(SystemTime, u64)>)>;

/// Runs until a signal ends it.
pub(super) fn run(common: &Common, map: &Path, out: Option<&Path>) -> Result<Answer, Failure> {
    let drawing = out.map_or_else(|| map.with_extension("svg"), Path::to_path_buf);
    let (stop, rules) = (stopped_by_signals(), rules_dir(common));
    let mut seen = None;
    while !stop.is_raised() {
        let stand = stand(map, rules.as_deref());
        if seen.as_ref() == Some(&stand) {
            std::thread::sleep(GLANCE);
            continue;
        }
        // Whoever writes may be at it still.
        if seen.is_some() {
            std::thread::sleep(GLANCE);
            if self::stand(map, rules.as_deref()) != stand {
                continue;
            }
        }
        seen = Some(stand);
        match look(common, map, rules.as_deref(), &drawing) {
            Ok(told) => {
                say(&told)?;
            }
            // It is told, and mended by whoever edits.
            Err(failure) => {
                let _code = failure.show(common.json, common.lang);
            }
        }
    }
    Ok(Answer::Yes)
}

fn stand(map: &Path, rules: Option<&Path>) -> Stand {
    let mut files = vec![map.to_owned()];
    let mut folders: Vec<PathBuf> = rules.into_iter().map(Path::to_path_buf).collect();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            match entry.file_type() {
                Ok(kind) if kind.is_dir() => folders.push(entry.path()),
                _ => files.push(entry.path()),
            }
        }
    }
    files.order();
    let of = |path: &PathBuf| {
        let found = std::fs::metadata(path).ok()?;
        Some((found.modified().ok()?, found.len()))
    };
    files.into_iter().map(|path| (path.clone(), of(&path))).collect()
}

/// One check, and the drawing where the map is sound.
fn look(
    common: &Common,
    map: &Path,
    rules: Option<&Path>,
    drawing: &Path,
) -> Result<String, Failure> {
    let (world, warnings) = Engine::check_map(map, rules)?;
    warn(&warnings, common.lang);
    let described = described(&world, common.lang);
    let engine = Engine::in_memory(world, rules)?;
    let first = engine.sheets_named(None)?;
    let Some(&(sheet, only)) = first.first() else {
        return Ok(described);
    };
    let wanted = Drawing { only, language: common.lang.language(), ..Drawing::default() };
    super::draw::put_drawing(engine.draw(sheet, &wanted)?, drawing)?;
    let path = drawing.display();
    if common.json {
        return Ok(json::drawn_map(&warnings, drawing).to_string());
    }
    if first.len() > 1 {
        note(&told!(common.lang.language(), "first-storey-drawn"));
    }
    Ok(format!("{described} → {path}"))
}
