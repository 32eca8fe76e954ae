//! The class `orthoframe.Engine`.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant, SystemTime};

use orthoframe::engine::{
    Change, Dialogue as Talk, Drawing, Format, ImportOptions, Limits, Method, Mode, Rules,
    Scenario, Seen, State, Wanted, When, change_now, json,
};
use orthoframe::vehicle::{Address, Patience};
use orthoframe::{Deg, Edits, Frame, Language, SourceText};
use pyo3::prelude::*;
use pyo3::types::PyString;
use serde_json::{Value, json};

use crate::arrays;
use crate::desk::{Desk, Failure, Told};
use crate::dialogue::Dialogue;
use crate::dict::to_json;
use crate::task::{Task, Wheels};
use crate::vehicle::link;

/// The knowledge of one building: a store, and all that follows from its map. Any thread may call it.
#[pyclass(frozen)]
#[derive(Debug)]
pub(crate) struct Engine {
    desk: Arc<Desk>,
    rules: Option<PathBuf>,
}

fn language(word: &str) -> Result<Language, Failure> {
    match word {
        "en" => Ok(Language::English),
        "ru" => Ok(Language::Russian),
        other => Err(Failure::Value(format!("language is \"en\" or \"ru\", not {other:?}"))),
    }
}

/// Makes an engine with the interpreter let go.
fn made(
    py: Python<'_>,
    speaks: &str,
    user: &str,
    rules: Option<PathBuf>,
    make: impl FnOnce(Option<&Path>) -> Result<orthoframe::Engine, Failure> + Send,
) -> PyResult<Engine> {
    let speaks =
        language(speaks).map_err(|failure| Told::of(&failure, Language::English).raised(py))?;
    let engine = py.detach(|| {
        // As the command line: ./rules where there is one.
        let rules = rules.clone().or_else(Rules::default_dir);
        crate::desk::guarded(|| make(rules.as_deref()))
            .map_err(|failure| Told::of(&failure, speaks))
    });
    let engine = engine.map_err(|told| told.raised(py))?;
    Ok(Engine { desk: Arc::new(Desk::new(engine, speaks, user.to_owned())), rules })
}

impl Engine {
    fn change(&self, reason: &str) -> Change {
        change_now(&self.desk.user, reason)
    }
}

#[pymethods]
impl Engine {
    /// Opens the store in a directory, or makes one there.
    #[staticmethod]
    #[pyo3(signature = (store, *, rules=None, language="en", user="python", read_only=false))]
    fn open(
        py: Python<'_>,
        store: PathBuf,
        rules: Option<PathBuf>,
        language: &str,
        user: &str,
        read_only: bool,
    ) -> PyResult<Self> {
        made(py, language, user, rules, |rules| {
            Ok(match read_only {
                true => orthoframe::Engine::open_read_only(&store, rules)?,
                false => orthoframe::Engine::open(&store, rules)?,
            })
        })
    }

    /// A map of any format that can be imported, held in memory without a store.
    #[staticmethod]
    #[pyo3(signature = (map, *, rules=None, language="en", user="python"))]
    fn in_memory(
        py: Python<'_>,
        map: PathBuf,
        rules: Option<PathBuf>,
        language: &str,
        user: &str,
    ) -> PyResult<Self> {
        made(py, language, user, rules, |rules| {
            let read = orthoframe::Engine::read_building(&map, &ImportOptions::default())?;
            Ok(orthoframe::Engine::in_memory(read.world, rules)?)
        })
    }

    /// Closes the store. What is asked afterwards is an error.
    fn close(&self, py: Python<'_>) {
        py.detach(|| self.desk.close());
    }

    fn __enter__(this: PyRef<'_, Self>) -> PyRef<'_, Self> {
        this
    }

    #[pyo3(signature = (*_why))]
    fn __exit__(&self, py: Python<'_>, _why: &Bound<'_, PyAny>) {
        self.close(py);
    }

    /// Makes a building the map: a map file, one of docs/import.md, or a picture of so many cm a pixel.
    #[pyo3(signature = (file, *, reason="", pixel=None))]
    fn import_file<'py>(
        &self,
        py: Python<'py>,
        file: PathBuf,
        reason: &str,
        pixel: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let reason = if reason.is_empty() { file.display().to_string() } else { reason.to_owned() };
        let change = self.change(&reason);
        self.desk.answer(py, || {
            self.desk.write(|engine| {
                let options = ImportOptions { pixel, ..ImportOptions::default() };
                let read = orthoframe::Engine::read_building(&file, &options)?;
                let imported = engine.keep(read, &change)?;
                let mut view = json::changed("imported", &imported.report);
                view["warnings"] = json!(json::faults(&imported.warnings));
                view["reading"] = imported.reading.to_json(self.desk.language);
                Ok(view)
            })
        })
    }

    /// The map as a map file, TOML.
    fn export_map(&self, py: Python<'_>) -> PyResult<String> {
        self.desk.free(py, || Ok(self.desk.state()?.world()?.to_toml()))
    }

    /// The number of the last change of the map; 0 for a map in memory.
    #[getter]
    fn revision(&self, py: Python<'_>) -> PyResult<u64> {
        self.desk.free(py, || self.desk.look(|engine| Ok(engine.revision())))
    }

    /// Every name of the map, in both languages.
    fn names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.desk.free(py, || Ok(self.desk.state()?.names()?))
    }

    /// Answers a question in English or Russian. No order is followed.
    fn ask<'py>(&self, py: Python<'py>, question: &str) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            let engine = orthoframe::Engine::beside(self.desk.state()?);
            let reply = Talk::new(self.desk.language).ask(&engine, question)?;
            let mut view = json::reply(&engine, &reply)?;
            view["text"] = json!(reply.text);
            Ok(view)
        })
    }

    /// Begins a dialogue.
    fn dialogue(&self) -> Dialogue {
        let talk = Mutex::new(Talk::new(self.desk.language));
        Dialogue { desk: Arc::clone(&self.desk), talk }
    }

    /// Answers a question in the rules' language: `?- ON_TOP_OF(X, Y), CONTAINS("Kitchen", Y)`.
    #[pyo3(signature = (question, *, proofs=false))]
    fn query<'py>(
        &self,
        py: Python<'py>,
        question: &str,
        proofs: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            let state = self.desk.state()?;
            let answer = state.query(question, proofs)?;
            Ok(json::query(&state, &answer, proofs, self.desk.language)?)
        })
    }

    /// The facts of a relation, those about a thing, or both; how many there are of each relation without either.
    #[pyo3(signature = (name=None, *, of=None))]
    fn relations<'py>(
        &self,
        py: Python<'py>,
        name: Option<&str>,
        of: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            let state = self.desk.state()?;
            if name.is_none() && of.is_none() {
                return Ok(json::counts(state.relations()?));
            }
            Ok(json::facts(&state, name, of, self.desk.language)?["facts"].take())
        })
    }

    /// A relation as an array.
    fn relation<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let table = self
            .desk
            .free(py, || arrays::relation(&*self.desk.state()?, name, self.desk.language))?;
        let class = py.import("orthoframe.arrays")?.getattr("Relation")?;
        let rows = table.rows.into_python(py)?;
        class.call1((table.name, table.columns, table.is_symbol, table.names, rows))
    }

    /// The free floor of a map as arrays.
    #[pyo3(signature = (map=None))]
    fn floor<'py>(&self, py: Python<'py>, map: Option<&str>) -> PyResult<Bound<'py, PyAny>> {
        let floor = self.desk.free(py, || {
            let state = self.desk.state()?;
            arrays::floor(&state, state.map_named(map)?)
        })?;
        let class = py.import("orthoframe.arrays")?.getattr("Floor")?;
        class.call1((
            floor.map,
            floor.rooms,
            floor.room.into_python(py)?,
            floor.offsets.into_python(py)?,
            floor.corners.into_python(py)?,
            floor.links.into_python(py)?,
        ))
    }

    /// Why a relation holds of these, down to what was measured; or what was missing.
    #[pyo3(signature = (relation, *of))]
    fn why<'py>(
        &self,
        py: Python<'py>,
        relation: &str,
        of: Vec<String>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            let state = self.desk.state()?;
            let of: Vec<&str> = of.iter().map(String::as_str).collect();
            Ok(json::why(&state, relation, &of, self.desk.language)?)
        })
    }

    /// What the robot would do if it were told so: its plans, and each step's way. Nothing is carried out.
    fn plan<'py>(&self, py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            let state = self.desk.state()?;
            let heard = state.rehearse(&Talk::new(self.desk.language), text)?;
            Ok(json!({ "plan": heard.plan, "replies": heard.replies }))
        })
    }

    /// The plan of a scenario (.strips), with the facts of the map.
    #[pyo3(signature = (file, *, time_limit=None))]
    fn plan_scenario<'py>(
        &self,
        py: Python<'py>,
        file: PathBuf,
        time_limit: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            let whole = time_limit.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
            let deadline = whole.and_then(|whole| Instant::now().checked_add(whole));
            let limits = Limits { deadline, ..Limits::default() };
            let state = self.desk.state()?;
            let answer = state.plan(Scenario::read(&file)?, &limits, Wanted::Shortest)?;
            Ok(json::plan(&answer.solved, state.world().ok()))
        })
    }

    /// The shortest way between two places, rooms, doors or things, or "X,Y".
    fn route<'py>(&self, py: Python<'py>, start: &str, goal: &str) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            let state = self.desk.state()?;
            let journey = state.journey(start, goal, Method::Shortest)?;
            Ok(json::journey(state.world_now()?, &journey, self.desk.language))
        })
    }

    /// A pose in words; without one, that of the robot.
    #[pyo3(name = "where", signature = (x=None, y=None, heading=None, *, map=None))]
    fn place<'py>(
        &self,
        py: Python<'py>,
        x: Option<f64>,
        y: Option<f64>,
        heading: Option<f64>,
        map: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            let state = self.desk.state()?;
            let (map, pose, is_facing) = match (x, y) {
                (Some(x), Some(y)) => {
                    let text = [Some(x), Some(y), heading];
                    let text: Vec<_> = text.iter().flatten().map(f64::to_string).collect();
                    let pose = State::parse_pose(&text.join(","))?;
                    (state.map_named(map)?, pose, heading.is_some())
                }
                (None, None) => {
                    let (map, pose) = state.robot()?;
                    (map, pose, true)
                }
                _ => return Err(Failure::Value("both x and y are wanted, or neither".into())),
            };
            Ok(json::whereabout(state.world()?, &state.locate(map, pose, is_facing)?))
        })
    }

    /// Where a thing is believed to be, how surely, and since when.
    fn find<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            let state = self.desk.state()?;
            Ok(json::believed(&state, &state.where_is(name, SystemTime::now().into())?)?)
        })
    }

    /// All that is known of where a thing stood.
    fn story<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || Ok(json::story(&*self.desk.state()?, name)?["story"].take()))
    }

    /// Notes that a thing was seen somewhere, in the frame of its room or of a map; or that it was not there.
    #[pyo3(signature = (name, at=None, *, room=None, map=None, angle=None, sure=0.9))]
    #[expect(clippy::too_many_arguments, reason = "they are Python's keywords")]
    fn observe<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        at: Option<Vec<f64>>,
        room: Option<&str>,
        map: Option<&str>,
        angle: Option<f64>,
        sure: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            if !(0.0..=1.0).contains(&sure) {
                return Err(Failure::Value(format!("sure = {sure}: from 0 to 1")));
            }
            if at.as_ref().is_some_and(|at| !matches!(at.len(), 2 | 3)) {
                return Err(Failure::Value("at = (x, y) or (x, y, z), in cm".into()));
            }
            let numbers = at.iter().flatten().chain(&angle);
            if numbers.copied().any(|number| !number.is_finite()) {
                return Err(Failure::Value("at and angle are finite numbers".into()));
            }
            let now = SystemTime::now().into();
            let user = &self.desk.user;
            self.desk.write(|engine| {
                let thing = engine.thing(name)?;
                let (area, surveyed) = (thing.area, thing.frame);
                let before = match map {
                    Some(_) => engine
                        .on_map(&Seen { area, frame: surveyed })?
                        .map_or(surveyed, |(_, frame)| frame),
                    None => surveyed,
                };
                let frame = at.as_ref().map(|at| {
                    let angle = angle.map_or(before.angle, Deg::of);
                    Frame::new(at[0], at[1], at.get(2).copied().unwrap_or(before.z.get()), angle)
                });
                match (frame, map) {
                    (Some(frame), Some(map)) => {
                        engine.observe_on_map(name, (Some(map), frame), sure, user, now)?;
                    }
                    (frame, _) => {
                        engine.observe(name, frame.map(|frame| (room, frame)), sure, user, now)?;
                    }
                }
                Ok(json::believed(engine, &engine.where_is(name, now)?)?)
            })
        })
    }

    /// Things that are believed to stand elsewhere than the map says.
    fn proposals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            self.desk.look(|engine| {
                let all = engine.proposals(SystemTime::now().into())?;
                let all = all.iter().map(|one| json::believed(engine, one));
                Ok(Value::Array(all.collect::<Result<_, _>>()?))
            })
        })
    }

    /// Corrects the map: the thing does stand where it is believed to.
    #[pyo3(signature = (name, *, reason="confirm"))]
    fn confirm<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        reason: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let change = self.change(reason);
        self.desk.answer(py, || {
            self.desk
                .write(|engine| Ok(json::changed("confirmed", &engine.confirm(name, &change)?)))
        })
    }

    /// The map is right: what was seen of the thing until now counts no more.
    #[pyo3(signature = (name, *, reason="reject"))]
    fn reject(&self, py: Python<'_>, name: &str, reason: &str) -> PyResult<()> {
        let change = self.change(reason);
        self.desk.free(py, || self.desk.write(|engine| Ok(engine.reject(name, &change)?)))
    }

    /// Edits the map: one transaction, checked as a whole. A dict, or a text of edits (TOML).
    #[pyo3(signature = (edits, *, reason="", dry_run=false))]
    fn edit<'py>(
        &self,
        py: Python<'py>,
        edits: &Bound<'py, PyAny>,
        reason: &str,
        dry_run: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (text, format) = match edits.cast::<PyString>() {
            Ok(text) => (text.to_string(), Format::Toml),
            Err(_) => (to_json(edits)?, Format::Json),
        };
        let change = self.change(reason);
        let mode = if dry_run { Mode::DryRun } else { Mode::Commit };
        self.desk.answer(py, || {
            self.desk.write(|engine| {
                let edits = Edits::read(&SourceText::new("edits", text), format);
                let edited = engine.edit(&edits, &change, mode)?;
                Ok(json::edited(&edited, self.desk.language))
            })
        })
    }

    /// All revisions, the oldest first.
    fn history<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            self.desk.look(|engine| {
                let all = engine.revisions()?;
                Ok(all.iter().map(json::revision).collect())
            })
        })
    }

    /// What changed between two revisions; to the last without a second.
    #[pyo3(signature = (start, end=None))]
    fn diff<'py>(
        &self,
        py: Python<'py>,
        start: u64,
        end: Option<u64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.desk.answer(py, || {
            self.desk.look(|engine| {
                let end = end.unwrap_or_else(|| engine.revision());
                let all = engine.diff(When::Revision(start), When::Revision(end))?;
                Ok(Value::Array(json::differences(&all, self.desk.language)))
            })
        })
    }

    /// Takes back the last edit that stands, or a certain one.
    #[pyo3(signature = (revision=None, *, reason=""))]
    fn undo<'py>(
        &self,
        py: Python<'py>,
        revision: Option<u64>,
        reason: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let change = self.change(reason);
        self.desk.answer(py, || {
            self.desk.write(|engine| Ok(json::changed("undone", &engine.undo(revision, &change)?)))
        })
    }

    /// Brings back what the last undo took.
    #[pyo3(signature = (*, reason=""))]
    fn redo<'py>(&self, py: Python<'py>, reason: &str) -> PyResult<Bound<'py, PyAny>> {
        let change = self.change(reason);
        self.desk.answer(py, || {
            self.desk.write(|engine| Ok(json::changed("redone", &engine.redo(&change)?)))
        })
    }

    /// The map as it stood at a revision, held in memory.
    fn as_of(&self, py: Python<'_>, revision: u64) -> PyResult<Self> {
        let rules = self.rules.clone().or_else(Rules::default_dir);
        let then = self.desk.free(py, || {
            let world = self.desk.look(|engine| {
                Ok(engine.store()?.world_as_of(revision).map_err(orthoframe::Error::from)?)
            })?;
            let world = world.ok_or_else(|| Failure::Value("there was no map yet".into()))?;
            Ok(orthoframe::Engine::in_memory(world, rules.as_deref())?)
        })?;
        let desk = Desk::new(then, self.desk.language, self.desk.user.clone());
        Ok(Self { desk: Arc::new(desk), rules: self.rules.clone() })
    }

    /// A map drawn, as SVG.
    #[pyo3(signature = (map=None, *, floor=false))]
    fn draw(&self, py: Python<'_>, map: Option<&str>, floor: bool) -> PyResult<String> {
        self.desk.free(py, || {
            let state = self.desk.state()?;
            let drawing = Drawing { floor, language: self.desk.language, ..Drawing::default() };
            Ok(state.draw(state.map_named(map)?, &drawing)?)
        })
    }

    /// Has the robot do something: the simulated one, a `Vehicle`, or one elsewhere ("cmd:…", "tcp:HOST:PORT").
    #[pyo3(signature = (text, vehicle=None, *, silence=10.0, poses=false))]
    fn run(
        &self,
        py: Python<'_>,
        text: String,
        vehicle: Option<&Bound<'_, PyAny>>,
        silence: f64,
        poses: bool,
    ) -> PyResult<Task> {
        let usual = Patience::default();
        let wait = Duration::try_from_secs_f64(silence).ok().filter(|wait| !wait.is_zero());
        let patience = wait.map(|silence| Patience { silence, ..usual });
        let wrong = |why: &str| self.desk.tell(&Failure::Value(why.to_owned())).raised(py);
        let patience = patience.ok_or_else(|| wrong("silence: seconds, more than 0"))?;
        let (wheels, end) = match vehicle {
            None => (Wheels::Simulated, None),
            Some(vehicle) => match vehicle.cast::<PyString>() {
                Ok(address) => {
                    let address = address.to_string().parse::<Address>();
                    let address = address.map_err(|why| wrong(why.say(Language::English)))?;
                    (Wheels::Elsewhere(address), None)
                }
                Err(_) => {
                    py.import("orthoframe.vehicle")?.getattr("ready")?.call1((vehicle,))?;
                    let (link, hears, orders) = link();
                    (Wheels::Python(hears, orders), Some((vehicle, link)))
                }
            },
        };
        let task = self.desk.free(py, || Task::begin(&self.desk, text, wheels, patience, poses))?;
        if let Some((vehicle, link)) = end {
            py.import("orthoframe.vehicle")?.getattr("begin")?.call1((vehicle, link))?;
        }
        Ok(task)
    }

    /// Puts the robot back to the map's start, in a map as surveyed.
    fn reset_robot(&self, py: Python<'_>) -> PyResult<()> {
        let change = self.change("reset");
        self.desk.free(py, || self.desk.write(|engine| Ok(engine.reset_robot(&change)?)))
    }

    fn __repr__(&self) -> String {
        match self.desk.look(|engine| Ok(engine.world()?.domain.name.clone())) {
            Ok(name) => format!("<orthoframe.Engine {name:?}>"),
            Err(_) => "<orthoframe.Engine>".to_owned(),
        }
    }
}
