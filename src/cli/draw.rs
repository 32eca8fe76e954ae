//! `ortho draw`: maps and rooms, free floor, network, Objects, routes and views, as SVG or PNG.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use crate::engine::{
    Drawing, Engine, Lens, Method, RequestError, Sighted, State, TaskAnswer, directive_in_words,
    face_in_words, no_way_in_words,
};
use crate::robot::Directive;
use crate::units::{MapId, Point, told, write_file};

use super::args::{Common, LogOnMap};
use super::corridor::CorridorArgs;
use super::fault::Failure;
use super::notes::note;
use super::opened::open;
use super::{Answer, json, say};

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
        /// A map or a room; every storey has a sheet of its own when left out
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
    /// What one scan of a log shows of the floor, cut into Passframes, beside the map
    Sight(SightArgs),
}

#[derive(Debug, Args)]
struct SightArgs {
    #[command(flatten)]
    of: LogOnMap,
    /// Which scan of the log, from 1
    #[arg(long, value_name = "N", default_value_t = 1)]
    scan: usize,
    /// The log tells the poses, in the map's frame; else the pose is found
    #[arg(long)]
    posed: bool,
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
    /// List the faces that are in view instead, the largest first
    #[arg(long, conflicts_with = "plan")]
    faces: bool,
}

pub(super) fn run(common: &Common, args: &DrawArgs) -> Result<Answer, Failure> {
    let form = Form::of(args)?;
    if let What::View(view) = &args.what
        && view.faces
    {
        return tell_faces(common, view);
    }
    let sheets = sheets(common, &args.what)?;
    let Some(path) = &args.out else {
        let [sheet] = &sheets[..] else {
            return match sheets.len() {
                0 => Ok(Answer::No),
                count => Err(RequestError::ManySheets { count }.into()),
            };
        };
        if form == Form::Svg {
            return say(sheet);
        }
        let picture = picture(sheet, args.width)?;
        super::waiting::over();
        let mut out = std::io::stdout().lock();
        out.write_all(&picture).and_then(|()| out.flush()).map_err(|e| Failure::output(&e))?;
        return Ok(Answer::Yes);
    };
    let written = put(&sheets, form, path, args.width)?;
    if written.len() > 1 {
        written.iter().for_each(|path| note(&path.display().to_string()));
    }
    Ok(if written.is_empty() { Answer::No } else { Answer::Yes })
}

/// What a drawing is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Svg,
    Png,
}

impl Form {
    fn of(args: &DrawArgs) -> Result<Self, Failure> {
        if args.png {
            return Ok(Self::Png);
        }
        args.out.as_deref().map_or(Ok(Self::Svg), Self::of_file)
    }

    /// By the file's ending: SVG where it has none.
    fn of_file(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            None | Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            Some(other) => Err(RequestError::DrawingFormat { ending: other.to_owned() }.into()),
        }
    }
}

/// A map with the legs of a way over it, by number.
type Storey = (MapId, Vec<(usize, Vec<Point>)>);

/// The sheets of a drawing, one for each storey of a way; none where there is no way.
fn sheets(common: &Common, what: &What) -> Result<Vec<String>, Failure> {
    let language = common.lang.language();
    let plain = Drawing { language, ..Drawing::default() };
    let plan = |name: &Option<String>, sheet: &Drawing| -> Result<Vec<String>, Failure> {
        let engine = open(common)?;
        let sheets = engine.sheets_named(name.as_deref())?.into_iter();
        let draw = |(map, only)| engine.draw(map, &Drawing { only, ..sheet.clone() });
        Ok(sheets.map(draw).collect::<Result<_, _>>()?)
    };
    let sheet = match what {
        What::Map { name } => return plan(name, &plain),
        What::Floor { name } => return plan(name, &Drawing { floor: true, ..plain }),
        What::Network { name } => {
            return plan(name, &Drawing { floor: true, network: true, ..plain });
        }
        What::Object { name } => open(common)?.draw_object(name, language)?,
        What::Corridor(args) => super::corridor::draw(common, args)?,
        What::View(view) => draw_view(common, view)?,
        What::Sight(sight) => return draw_sight(common, sight),
        What::Route { task: Some(task), .. } => {
            let engine = open(common)?;
            let answer = engine.perform(task, &mut |_| {})?;
            return driven(common, &engine, &answer);
        }
        What::Route { from, to, .. } => {
            let end = |name: &Option<String>| name.clone().unwrap_or_default();
            return journey(common, &end(from), &end(to));
        }
    };
    Ok(vec![sheet])
}

/// None where the scan fits nowhere.
fn draw_sight(common: &Common, args: &SightArgs) -> Result<Vec<String>, Failure> {
    let engine = open(common)?;
    let map = engine.map_named(args.of.map.as_deref())?;
    let log = Sighted::read(&args.of.log)?;
    let Some(seen) = engine.sighting(map, &log, args.scan, args.of.height, args.posed)? else {
        note(&told!(common.lang.language(), "scan-unplaced"));
        return Ok(Vec::new());
    };
    if seen.is_one_of > 1 {
        note(&told!(common.lang.language(), "one-of-poses", is_one_of = seen.is_one_of));
    }
    Ok(vec![engine.draw_sighting(map, &seen, common.lang.language())?])
}

/// A sheet for each storey of the shortest way; where it leads to another storey, its legs and rides are numbered and
/// listed.
fn journey(common: &Common, from: &str, to: &str) -> Result<Vec<String>, Failure> {
    let engine = open(common)?;
    let language = common.lang.language();
    let world = engine.world_now()?;
    let journey = engine.journey(from, to, Method::Shortest)?;
    let opens = journey.opens_in_words(world, language);
    Some(opens).filter(|told| !told.is_empty()).iter().for_each(|told| note(told));
    let mut storeys: Vec<Storey> = Vec::new();
    let mut directives = Vec::new();
    for (k, leg) in journey.legs.iter().enumerate() {
        let route = match &leg.route {
            Ok(route) => route,
            Err(why) => {
                note(&no_way_in_words(world, why, language));
                let head = told!(common.lang.language(), "to-open-a-way");
                let advice = journey.advice.as_ref().map(|a| a.in_words(world, language));
                advice.iter().for_each(|advice| note(&format!("{head} {advice}.")));
                return Ok(Vec::new());
            }
        };
        let mut legs = vec![(2 * k + 1, route.points.clone())];
        directives.push((2 * k + 1, format!("{} – {}", leg.from, leg.to)));
        if let Some(ride) = journey.rides.get(k) {
            legs.push((2 * k + 2, route.points.last().copied().into_iter().collect()));
            directives.push((2 * k + 2, engine.ride_in_words(ride, language)?));
        }
        match storeys.iter_mut().find(|(map, _)| *map == leg.map) {
            Some((_, drawn)) => drawn.extend(legs),
            None => storeys.push((leg.map, legs)),
        }
    }
    let directives = if journey.legs.len() > 1 { directives } else { Vec::new() };
    let last = journey.legs.last().map(|leg| leg.map);
    let sheet = |(map, legs): Storey| {
        let (directives, has_goal) = (directives.clone(), last == Some(map));
        let drawing = Drawing { legs, directives, has_goal, language, ..Drawing::default() };
        Ok(engine.draw(map, &drawing)?)
    };
    storeys.into_iter().map(sheet).collect()
}

/// The lens of a view and the map that it looks at.
fn lens(engine: &Engine, args: &ViewArgs) -> Result<(MapId, Lens), Failure> {
    let map: MapId = engine.map_named(args.map.as_deref())?;
    let pose = State::parse_pose(&args.at)?;
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
    // A pose outside every room sees nothing worth a picture.
    engine.locate(map, pose, false)?;
    Ok((map, Lens { pose, height, field: args.field, range: args.range }))
}

fn draw_view(common: &Common, args: &ViewArgs) -> Result<String, Failure> {
    let engine = open(common)?;
    let language = common.lang.language();
    let (map, lens) = lens(&engine, args)?;
    if args.plan {
        return Ok(engine.draw(map, &Drawing { view: Some(lens), language, ..Drawing::default() })?);
    }
    Ok(engine.draw_view(map, lens, language)?)
}

/// The faces in view by name, those that look largest first.
fn tell_faces(common: &Common, args: &ViewArgs) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let language = common.lang.language();
    let (map, lens) = lens(&engine, args)?;
    let world = engine.world()?;
    let faces = engine.faces_in_view(map, lens)?;
    if common.json {
        return say(&json::faces(world, &faces, language).to_string());
    }
    let line = |face: &crate::geometry::FaceInView| {
        let name = face_in_words(world, &face.face, language);
        let share = (100.0 * face.area / face.whole.max(1e-9)).clamp(0.0, 100.0);
        let away =
            crate::engine::decimal(face.distance / 100.0, &told!(language, "metres"), language);
        told!(common.lang.language(), "in-view", name, share = format!("{share:.0}"), away)
    };
    say(&faces.iter().map(line).collect::<Vec<_>>().join("\n"))
}

/// Writes a drawing as its file's name ends.
pub(super) fn put_drawing(svg: String, path: &Path) -> Result<(), Failure> {
    put(&[svg], Form::of_file(path)?, path, None).map(drop)
}

/// Writes sheets, the further ones into files of their own, numbered from 2.
fn put(
    sheets: &[String],
    form: Form,
    path: &Path,
    width: Option<u32>,
) -> Result<Vec<PathBuf>, Failure> {
    let mut written = Vec::new();
    for (k, svg) in sheets.iter().enumerate() {
        let path = if k == 0 { path.to_owned() } else { numbered(path, k + 1) };
        match form {
            Form::Svg => write(&path, svg.as_bytes())?,
            Form::Png => write(&path, &picture(svg, width)?)?,
        }
        written.push(path);
    }
    Ok(written)
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
    put(&driven(common, engine, answer)?, Form::of_file(path)?, path, None)
}

/// `plan-2.svg` beside `plan.svg`.
fn numbered(path: &Path, number: usize) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().map(|e| format!(".{}", e.to_string_lossy())).unwrap_or_default();
    path.with_file_name(format!("{stem}-{number}{ending}"))
}

/// Every storey to which a task led, with Passframes and what was driven there; all directives are listed below.
fn driven(common: &Common, engine: &Engine, answer: &TaskAnswer) -> Result<Vec<String>, Failure> {
    let mut storeys: Vec<Storey> = vec![(answer.map, Vec::new())];
    for report in &answer.reports {
        let at = match storeys.iter().position(|(map, _)| *map == report.map) {
            Some(at) => at,
            None => {
                storeys.push((report.map, Vec::new()));
                storeys.len() - 1
            }
        };
        let legs = &mut storeys[at].1;
        // What is done on the spot is told where the last way ended.
        let here = || legs.last().and_then(|(_, leg)| leg.last()).copied().into_iter().collect();
        let way = if report.points.is_empty() { here() } else { report.points.clone() };
        if !way.is_empty() {
            legs.push((report.number, way));
        }
    }
    let world = engine.world()?;
    let told = |directive: &Directive| directive_in_words(world, directive, common.lang.language());
    let directives: Vec<_> =
        answer.reports.iter().map(|r| (r.number, told(&r.directive))).collect();
    let last = answer.reports.last().map(|report| report.map);
    let sheet = |(map, legs): Storey| {
        let drawing = Drawing {
            floor: true,
            legs,
            has_goal: last == Some(map),
            directives: directives.clone(),
            robot: Some(answer.start).filter(|_| map == answer.map),
            language: common.lang.language(),
            ..Drawing::default()
        };
        Ok(engine.draw(map, &drawing)?)
    };
    storeys.into_iter().map(sheet).collect()
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_file(path, bytes).map_err(|e| Failure::file(path, &e))
}

#[cfg(feature = "pictures")]
fn picture(svg: &str, width: Option<u32>) -> Result<Vec<u8>, Failure> {
    Ok(crate::draw::png(svg, width)?)
}

#[cfg(not(feature = "pictures"))]
fn picture(_svg: &str, _width: Option<u32>) -> Result<Vec<u8>, Failure> {
    Err(RequestError::NoPng.into())
}
