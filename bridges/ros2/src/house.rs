//! `ortho`, asked by its arguments and heard by its JSON.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver};

use serde_json::Value;

use crate::messages::{Color, GridInfo, Marker, Mesh, OccupancyGrid, Picture, Point, header, pose};
use crate::ros::Fault;

/// Which `ortho`, and what it is asked of.
#[derive(Debug, Clone)]
pub(crate) struct House {
    pub(crate) ortho: PathBuf,
    pub(crate) store: PathBuf,
    pub(crate) floor: Option<String>,
    pub(crate) vehicle: Option<String>,
}

/// An order that is carried out.
pub(crate) struct Errand {
    child: Child,
    /// Events, and the value of the task last.
    pub(crate) lines: Receiver<Value>,
}

impl House {
    fn command(&self) -> Command {
        let mut command = Command::new(&self.ortho);
        command.arg("--store").arg(&self.store).arg("--json").stdin(Stdio::null());
        command
    }

    fn told(&self, command: &mut Command) -> Result<Value, Fault> {
        let done = command.output().map_err(|e| format!("{}: {e}", self.ortho.display()))?;
        let text = String::from_utf8_lossy(&done.stdout);
        let last = text.lines().last().unwrap_or_default();
        serde_json::from_str(last).map_err(|e| {
            let said = String::from_utf8_lossy(&done.stderr);
            format!("ortho did not answer ({e}): {}", said.trim())
        })
    }

    pub(crate) fn ask(&self, question: &str) -> Result<Value, Fault> {
        self.told(self.command().args(["ask", "--", question]))
    }

    pub(crate) fn run(&self, order: &str) -> Result<Errand, Fault> {
        let mut command = self.command();
        command.arg("do");
        if let Some(vehicle) = &self.vehicle {
            command.args(["--vehicle", vehicle]);
        }
        command.args(["--", order]).stdout(Stdio::piped());
        let mut child = command.spawn().map_err(|e| format!("{}: {e}", self.ortho.display()))?;
        let out = child.stdout.take().expect("it is piped");
        let (say, lines) = mpsc::channel();
        std::thread::spawn(move || {
            for line in BufReader::new(out).lines().map_while(Result::ok) {
                let Ok(value) = serde_json::from_str(&line) else { continue };
                if say.send(value).is_err() {
                    break;
                }
            }
        });
        Ok(Errand { child, lines })
    }

    /// The storey as a grid, and its rooms, things and places by name.
    pub(crate) fn map(&self, frame: &str) -> Result<(OccupancyGrid, Vec<Marker>), Fault> {
        let dir = std::env::temp_dir().join(format!("ortho-ros2-{}", std::process::id()));
        let read = self.read_map(&dir, frame);
        // What is left of it is the system's to clean.
        let _ = std::fs::remove_dir_all(&dir);
        read
    }

    fn read_map(&self, dir: &Path, frame: &str) -> Result<(OccupancyGrid, Vec<Marker>), Fault> {
        let geojson = dir.join("map.geojson");
        std::fs::create_dir_all(dir).map_err(|e| format!("{}: {e}", dir.display()))?;
        let mut command = self.command();
        command.arg("export").arg("--ros").arg(dir).arg("--geojson").arg(&geojson);
        if let Some(floor) = &self.floor {
            command.args(["--floor", floor]);
        }
        let told = self.told(&mut command)?;
        let files = told["files"].as_array().ok_or_else(|| format!("ortho export: {told}"))?;
        let sheets: Vec<&str> =
            files.iter().filter_map(Value::as_str).filter(|name| name.ends_with(".yaml")).collect();
        let [sheet] = sheets[..] else {
            return Err("there are several storeys: name one with --floor".to_owned());
        };
        let text = |path: &Path| {
            std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))
        };
        let grid =
            grid(&text(Path::new(sheet))?, &read(&Path::new(sheet).with_extension("pgm"))?, frame)
                .ok_or("the picture of the map was not understood")?;
        let features: Value = serde_json::from_str(&text(&geojson)?).map_err(|e| e.to_string())?;
        Ok((grid, markers(&features, frame)))
    }
}

fn read(path: &Path) -> Result<Vec<u8>, Fault> {
    std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))
}

/// A map_server's files in mode trinary, as its node publishes them.
fn grid(sheet: &str, picture: &[u8], frame: &str) -> Option<OccupancyGrid> {
    let value = |key: &str| {
        let line = sheet.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(':'));
        line.map(|rest| rest.trim().trim_matches(['[', ']']).to_owned())
    };
    let resolution: f32 = value("resolution")?.parse().ok()?;
    let origin: Vec<f64> =
        value("origin")?.split(',').filter_map(|n| n.trim().parse().ok()).collect();
    let mut rest = picture;
    let mut word = || {
        let end = rest.iter().position(u8::is_ascii_whitespace)?;
        let word = std::str::from_utf8(&rest[..end]).ok()?;
        rest = &rest[end + 1..];
        Some(word)
    };
    let head = [word()?, word()?, word()?, word()?];
    let ["P5", width, height, "255"] = head else { return None };
    let (width, height): (u32, u32) = (width.parse().ok()?, height.parse().ok()?);
    let cells = rest.get(..width as usize * height as usize)?;
    let occupancy = |grey: &u8| match grey {
        0 => 100,
        254 => 0,
        _ => -1,
    };
    let rows = cells.chunks_exact(width.max(1) as usize).rev();
    let data = rows.flatten().map(occupancy).collect();
    let [x, y, ..] = origin[..] else { return None };
    let header = header(frame);
    let origin = pose(x * 100.0, y * 100.0, 0.0);
    let info = GridInfo { map_load_time: header.stamp, resolution, width, height, origin };
    Some(OccupancyGrid { header, info, data })
}

/// Outlines of rooms and things, and every name where it stands.
fn markers(features: &Value, frame: &str) -> Vec<Marker> {
    let mut markers = Vec::new();
    for feature in features["features"].as_array().into_iter().flatten() {
        let kind = feature["feature_type"].as_str().unwrap_or_default();
        let color = match kind {
            "unit" => [0.2, 0.2, 0.25],
            "opening" => [0.2, 0.6, 0.3],
            "fixture" => [0.7, 0.5, 0.35],
            "amenity" => [0.15, 0.4, 0.8],
            _ => continue,
        };
        let outlines = outlines(&feature["geometry"]);
        let all: Vec<&Point> = outlines.iter().flatten().collect();
        let (Some(name), false) = (feature["properties"]["name"]["ru"].as_str(), all.is_empty())
        else {
            continue;
        };
        let middle =
            |axis: fn(&Point) -> f64| all.iter().map(|p| axis(p)).sum::<f64>() / all.len() as f64;
        let (x, y) = (middle(|p| p.x), middle(|p| p.y));
        let mut put = |shape: i32, points: Vec<Point>, text: &str| {
            let id = i32::try_from(markers.len()).unwrap_or(i32::MAX);
            markers.push(marker(frame, kind, id, shape, color, points, text, (x, y)));
        };
        for outline in outlines.into_iter().filter(|outline| outline.len() > 1) {
            put(LINE_STRIP, outline, "");
        }
        put(TEXT, Vec::new(), name);
    }
    markers
}

const LINE_STRIP: i32 = 4;
const TEXT: i32 = 9;

#[expect(clippy::too_many_arguments, reason = "a marker has so many parts")]
fn marker(
    frame: &str,
    ns: &str,
    id: i32,
    kind: i32,
    [r, g, b]: [f32; 3],
    points: Vec<Point>,
    text: &str,
    (x, y): (f64, f64),
) -> Marker {
    let at = if kind == TEXT { pose(x * 100.0, y * 100.0, 0.0) } else { pose(0.0, 0.0, 0.0) };
    // Of letters z is the height, of lines x the width.
    let scale = if kind == TEXT {
        Point { x: 0.0, y: 0.0, z: 0.15 }
    } else {
        Point { x: 0.03, y: 0.0, z: 0.0 }
    };
    Marker {
        header: header(frame),
        ns: ns.to_owned(),
        id,
        kind,
        action: 0,
        pose: at,
        scale,
        color: Color { r, g, b, a: 1.0 },
        lifetime: ros2_client::builtin_interfaces::Duration::from(std::time::Duration::ZERO),
        frame_locked: false,
        points,
        colors: Vec::new(),
        texture_resource: String::new(),
        texture: Picture { header: header(""), format: String::new(), data: Vec::new() },
        uv_coordinates: Vec::new(),
        text: text.to_owned(),
        mesh_resource: String::new(),
        mesh_file: Mesh { filename: String::new(), data: Vec::new() },
        mesh_use_embedded_materials: false,
    }
}

/// The rings and lines of a geometry of GeoJSON; a point is a line of one.
fn outlines(geometry: &Value) -> Vec<Vec<Point>> {
    let point =
        |value: &Value| Some(Point { x: value[0].as_f64()?, y: value[1].as_f64()?, z: 0.0 });
    let line = |value: &Value| -> Vec<Point> {
        value.as_array().into_iter().flatten().filter_map(point).collect()
    };
    let rings = |value: &Value| -> Vec<Vec<Point>> {
        value.as_array().into_iter().flatten().map(line).collect()
    };
    let at = &geometry["coordinates"];
    match geometry["type"].as_str() {
        Some("Point") => vec![point(at).into_iter().collect()],
        Some("LineString") => vec![line(at)],
        Some("Polygon") => rings(at),
        Some("MultiPolygon") => at.as_array().into_iter().flatten().flat_map(rings).collect(),
        _ => Vec::new(),
    }
}

impl Errand {
    /// Has it stop in good order.
    pub(crate) fn stop(&self) {
        // Ctrl-C's sister; `ortho` stops the robot and notes how it stands.
        let pid = self.child.id().to_string();
        let _ = Command::new("kill").args(["-TERM", &pid]).status();
    }

    pub(crate) fn reap(mut self) {
        let _ = self.child.wait();
    }
}
