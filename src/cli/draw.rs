//! `ortho draw`: maps and rooms, free floor, network, Objects, routes and views, as SVG or PNG.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use crate::engine::{
    Drawing, Engine, Lens, Method, RequestError, TaskAnswer, no_way_in_words, parse_pose,
};
use crate::units::MapId;

use super::args::{Common, CorridorArgs};
use super::commands::{note, open};
use super::fault::Failure;
use super::{Answer, say};

#[derive(Debug, Args)]
pub(super) struct DrawArgs {
    #[command(subcommand)]
    what: What,
    /// File to write, as PNG where its name ends so, else as SVG; standard output when absent
    #[arg(short, long, global = true, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write a PNG, whatever the file's name
    #[arg(long, global = true)]
    png: bool,
    /// Width of the PNG in pixels
    #[arg(long, global = true, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(1..=20_000))]
    width: Option<u32>,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Rooms, doors, furniture
    Map {
        /// A map or a room; may be left out when there is only one map
        name: Option<String>,
    },
    /// The same with free floor, dead zones and Passframes
    Floor { name: Option<String> },
    /// The same with the network of Passframes
    Network { name: Option<String> },
    /// An Object or a thing of its kind: façade, profile and plan, with dimensions
    Object { name: String },
    /// The road graph of corridors, with the way
    Corridor(CorridorArgs),
    /// The map with a route, or with the way driven for a task and its directives
    Route {
        #[arg(long, value_name = "PLACE", allow_hyphen_values = true, requires = "to")]
        from: Option<String>,
        #[arg(long, value_name = "PLACE", allow_hyphen_values = true, requires = "from")]
        to: Option<String>,
        /// A task in words, carried out in the simulator
        #[arg(
            long,
            value_name = "TEXT",
            conflicts_with_all = ["from", "to"],
            required_unless_present = "from"
        )]
        task: Option<String>,
    },
    /// What the robot sees from a pose, in perspective
    View(ViewArgs),
}

#[derive(Debug, Args)]
struct ViewArgs {
    /// The map; may be left out when the store has only one
    #[arg(long, value_name = "NAME")]
    map: Option<String>,
    /// Pose on the map, cm and degrees
    #[arg(long, value_name = "X,Y,HEADING", allow_hyphen_values = true)]
    at: String,
    /// Of the eye above the floor, cm; the robot's height when absent
    #[arg(long, value_name = "CM")]
    height: Option<f64>,
    /// Angle of view from side to side
    #[arg(long, value_name = "DEGREES", default_value_t = 90.0)]
    field: f64,
    /// How far the eye sees, cm
    #[arg(long, value_name = "CM", default_value_t = 1200.0)]
    range: f64,
    /// From above, what is in view marked on the plan
    #[arg(long)]
    plan: bool,
}

pub(super) fn run(common: &Common, args: &DrawArgs) -> Result<Answer, Failure> {
    let language = common.lang.language();
    let plain = Drawing { language, ..Drawing::default() };
    let plan = |name: &Option<String>, sheet: Drawing| -> Result<String, Failure> {
        let engine = open(common)?;
        let (map, only) = engine.sheet_named(name.as_deref())?;
        Ok(engine.draw(map, &Drawing { only, ..sheet })?)
    };
    let svg = match &args.what {
        What::Map { name } => plan(name, plain)?,
        What::Floor { name } => plan(name, Drawing { floor: true, ..plain })?,
        What::Network { name } => plan(name, Drawing { floor: true, network: true, ..plain })?,
        What::Object { name } => open(common)?.draw_object(name, language)?,
        What::Corridor(args) => super::corridor::draw(common, args)?,
        What::View(view) => draw_view(common, view)?,
        What::Route { task: Some(task), .. } => {
            let engine = open(common)?;
            let answer = engine.perform(task, &mut |_| {})?;
            driven(common, &engine, &answer, answer.map)?
        }
        What::Route { from, to, .. } => {
            let engine = open(common)?;
            let end = |name: &Option<String>| name.clone().unwrap_or_default();
            let answer = engine.route(&end(from), &end(to), Method::Shortest)?;
            match answer.route {
                Ok(route) => {
                    let legs = vec![(1, route.points)];
                    engine.draw(answer.map, &Drawing { legs, ..plain })?
                }
                Err(why) => {
                    note(&no_way_in_words(engine.world()?, &why, language));
                    return Ok(Answer::No);
                }
            }
        }
    };
    if args.png && args.out.is_none() {
        let picture = picture(&svg, args.width)?;
        let mut out = std::io::stdout().lock();
        out.write_all(&picture).and_then(|()| out.flush()).map_err(|e| Failure::output(&e))?;
        return Ok(Answer::Yes);
    }
    match &args.out {
        Some(path) if args.png => {
            write(path, &picture(&svg, args.width)?)?;
            Ok(Answer::Yes)
        }
        out => put(&svg, out.as_deref(), args.width),
    }
}

fn draw_view(common: &Common, args: &ViewArgs) -> Result<String, Failure> {
    let engine = open(common)?;
    let language = common.lang.language();
    let map: MapId = engine.map_named(args.map.as_deref())?;
    let pose = parse_pose(&args.at)?;
    let height = args
        .height
        .unwrap_or_else(|| engine.world().map_or(120.0, |world| world.robot.height.get()));
    for (value, what, low, high) in [
        (height, "height", 1.0, 1000.0),
        (args.field, "field", 10.0, 360.0),
        (args.range, "range", 10.0, 100_000.0),
    ] {
        if !(low..=high).contains(&value) {
            return Err(RequestError::OutOfRange { what, value, low, high }.into());
        }
    }
    let lens = Lens { pose, height, field: args.field, range: args.range };
    // A pose outside every room sees nothing worth a picture.
    engine.locate(map, pose, false)?;
    if args.plan {
        return Ok(engine.draw(map, &Drawing { view: Some(lens), language, ..Drawing::default() })?);
    }
    Ok(engine.draw_view(map, lens, language)?)
}

/// Writes the map with the way driven for a task, into a folder that is made when it is not there. Each further storey
/// that the robot came to has a file of its own beside it, numbered from 2.
pub(super) fn put_driven(
    common: &Common,
    engine: &Engine,
    answer: &TaskAnswer,
    path: &Path,
) -> Result<Vec<PathBuf>, Failure> {
    if let Some(dir) = path.parent() {
        std::fs::create_dir_all(dir).map_err(|e| Failure::file(dir, &e))?;
    }
    let mut storeys = vec![answer.map];
    for report in &answer.reports {
        if !storeys.contains(&report.map) {
            storeys.push(report.map);
        }
    }
    let mut written = Vec::new();
    for (k, map) in storeys.into_iter().enumerate() {
        let path = if k == 0 { path.to_owned() } else { numbered(path, k + 1) };
        put(&driven(common, engine, answer, map)?, Some(&path), None)?;
        written.push(path);
    }
    Ok(written)
}

/// `plan-2.svg` beside `plan.svg`.
fn numbered(path: &Path, number: usize) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().map(|e| format!(".{}", e.to_string_lossy())).unwrap_or_default();
    path.with_file_name(format!("{stem}-{number}{ending}"))
}

/// One storey with Passframes and what was driven there for a task; all directives are listed below.
fn driven(
    common: &Common,
    engine: &Engine,
    answer: &TaskAnswer,
    map: MapId,
) -> Result<String, Failure> {
    let driven = answer.reports.iter().filter(|r| !r.points.is_empty() && r.map == map);
    let legs = driven.map(|r| (r.number, r.points.clone())).collect();
    let directives = answer.reports.iter().map(|r| (r.number, r.directive.to_string())).collect();
    let drawing = Drawing {
        floor: true,
        legs,
        directives,
        robot: Some(answer.start).filter(|_| map == answer.map),
        language: common.lang.language(),
        ..Drawing::default()
    };
    Ok(engine.draw(map, &drawing)?)
}

/// Writes a drawing, as PNG where the file's name ends so; to standard output without a file.
fn put(svg: &str, out: Option<&Path>, width: Option<u32>) -> Result<Answer, Failure> {
    let Some(path) = out else { return say(svg) };
    let is_png = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
    if is_png {
        write(path, &picture(svg, width)?)?;
    } else {
        write(path, svg.as_bytes())?;
    }
    Ok(Answer::Yes)
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    std::fs::write(path, bytes).map_err(|e| Failure::file(path, &e))
}

#[cfg(feature = "pictures")]
fn picture(svg: &str, width: Option<u32>) -> Result<Vec<u8>, Failure> {
    Ok(crate::draw::png(svg, width)?)
}

#[cfg(not(feature = "pictures"))]
fn picture(_svg: &str, _width: Option<u32>) -> Result<Vec<u8>, Failure> {
    Err(RequestError::NoPng.into())
}
