//! The one door for foreign files: which format it is, its reader, the assembler, the report.

use std::path::{Path, PathBuf};

use crate::map::{self, MapErrors, Profile, World};
use crate::units::{Deg, Frame, Point, Source, said};

use super::report::{What, Why};
use super::scene::{self, Assets, SceneFormat};
use super::{
    Feet, ImportError, ReadError, Report, Survey, Synonyms, assemble, geojson, ifc, input, osmag,
    rmf, ros,
};

/// A format that is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Format {
    /// orthoframe's own map file.
    Map,
    Rmf,
    OsmAg,
    ProcThor,
    Thor,
    VirtualHome,
    PyRoboSim,
    /// IMDF and other GeoJSON.
    GeoJson,
    Ifc,
    /// Occupancy grids of map_server.
    Ros,
}

/// How a format is known and read.
struct Reader {
    format: Format,
    /// As the command line names it.
    key: &'static str,
    title: &'static str,
    /// By name and content; the first reader that says yes reads.
    recognises: fn(&Input<'_>) -> bool,
    read: fn(&Input<'_>) -> Result<Survey, ReadError>,
}

/// In the order in which they are asked.
const READERS: &[Reader] = &[
    Reader {
        format: Format::Rmf,
        key: "rmf",
        title: "Open-RMF",
        recognises: |input| rmf::recognises(input.text()),
        read: |input| rmf::read(input.source()?),
    },
    Reader {
        format: Format::OsmAg,
        key: "osmag",
        title: "osmAG",
        recognises: |input| osmag::recognises(input.text()),
        read: |input| osmag::read(input.source()?),
    },
    Reader {
        format: Format::ProcThor,
        key: "procthor",
        title: "ProcTHOR",
        recognises: |input| is_scene(input, SceneFormat::ProcThor),
        read: |input| scene::read_procthor(input.source()?, &asset_sizes(input)?),
    },
    Reader {
        format: Format::Thor,
        key: "thor",
        title: "AI2-THOR",
        recognises: |input| is_scene(input, SceneFormat::Thor),
        read: |input| scene::read_thor(input.source()?),
    },
    Reader {
        format: Format::VirtualHome,
        key: "virtualhome",
        title: "VirtualHome",
        recognises: |input| is_scene(input, SceneFormat::VirtualHome),
        read: |input| scene::read_virtualhome(input.source()?),
    },
    Reader {
        format: Format::PyRoboSim,
        key: "pyrobosim",
        title: "pyrobosim",
        recognises: |input| is_scene(input, SceneFormat::PyRoboSim),
        read: |input| scene::read_pyrobosim(input.source()?, &mut |name| input.beside(name)),
    },
    Reader {
        format: Format::Ifc,
        key: "ifc",
        title: "IFC (STEP)",
        recognises: |input| ifc::recognises(input.text()),
        read: |input| ifc::read(input.source()?),
    },
    Reader {
        format: Format::GeoJson,
        key: "geojson",
        title: "IMDF, GeoJSON",
        recognises: |input| {
            geojson::recognises(input.text()) || geojson::recognises_folder(input.path)
        },
        read: |input| match &input.text {
            Some(source) => geojson::read(source),
            None => geojson::read_folder(input.path),
        },
    },
    Reader {
        format: Format::Ros,
        key: "ros",
        title: "ROS map_server",
        recognises: |input| ros::recognises(input.text()),
        read: |input| ros::read(input.path),
    },
];

fn is_scene(input: &Input<'_>, format: SceneFormat) -> bool {
    input.text.as_ref().and_then(SceneFormat::of) == Some(format)
}

/// The file in which ProcTHOR keeps the sizes of its models.
const ASSETS: &str = "asset-database.json";

/// The sizes of models: of the file named, or of the one beside or above the house; none when there is none.
fn asset_sizes(input: &Input<'_>) -> Result<Assets, ReadError> {
    let found = || {
        let up = input.path.ancestors().skip(1).take(3).map(|dir| dir.join(ASSETS));
        up.into_iter().find(|path| path.is_file())
    };
    match input.assets.map(Path::to_path_buf).or_else(found) {
        Some(path) => Assets::read(&input::file_text(&path)?),
        None => Ok(Assets::default()),
    }
}

/// A foreign file, opened.
pub(super) struct Input<'a> {
    pub(super) path: &'a Path,
    /// None when the path is a directory.
    pub(super) text: Option<Source>,
    /// A second file that some formats need: sizes of models.
    pub(super) assets: Option<&'a Path>,
}

impl Input<'_> {
    /// The file's name in small letters.
    fn file_name(&self) -> String {
        self.path.file_name().map(|n| n.to_string_lossy().to_lowercase()).unwrap_or_default()
    }

    /// The text; empty for a directory.
    pub(super) fn text(&self) -> &str {
        self.text.as_ref().map_or("", Source::text)
    }

    /// The text, where the format needs one.
    pub(super) fn source(&self) -> Result<&Source, ReadError> {
        self.text.as_ref().ok_or_else(|| ReadError::Unreadable {
            path: self.path.display().to_string(),
            reason: said!("this-is-a-folder-and"),
        })
    }

    /// A file of this name in the folder of the file; whatever folder the name itself speaks of.
    fn beside(&self, name: &str) -> Option<Source> {
        let path = self.path.parent()?.join(Path::new(name).file_name()?);
        input::file_text(&path).ok()
    }

    fn ends_with(&self, endings: &[&str]) -> bool {
        let name = self.file_name();
        endings.iter().any(|ending| name.ends_with(ending))
    }
}

/// How a file is to be read.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// None: by its name and content.
    pub format: Option<Format>,
    /// Refuse when anything had to be mended or left out.
    pub strict: bool,
    /// Sizes of models; looked for beside the file when None.
    pub assets: Option<PathBuf>,
    /// A synonym table laid over the built-in one.
    pub synonyms: Option<PathBuf>,
    /// How exactly the things were measured; by what the file itself shows when None.
    pub profile: Option<Profile>,
    /// The file is a picture of a floor plan, dark walls on white, and a pixel of it so many cm.
    pub pixel: Option<f64>,
}

/// What came of a file.
#[derive(Debug, Clone)]
pub struct Imported {
    pub world: World,
    pub report: Report,
    /// Of a map file.
    pub warnings: MapErrors,
}

impl Format {
    /// The format of this name: `rmf`.
    #[must_use]
    pub fn named(key: &str) -> Option<Self> {
        if key == "map" {
            return Some(Self::Map);
        }
        READERS.iter().find(|r| r.key == key).map(|r| r.format)
    }

    /// The names of all formats, for the command line.
    #[must_use]
    pub fn keys() -> Vec<&'static str> {
        std::iter::once("map").chain(READERS.iter().map(|r| r.key)).collect()
    }

    fn recognised(input: &Input<'_>) -> Option<Self> {
        // A file of our own says so in its first key, or is TOML, which no foreign format is.
        let is_map = input.ends_with(&[".toml"]) || names_its_format(input.text());
        let foreign = READERS.iter().find(|r| (r.recognises)(input)).map(|r| r.format);
        foreign.or(is_map.then_some(Self::Map))
    }
}

/// Whether a text has the field `format` of a map file, however its lines are broken.
fn names_its_format(text: &str) -> bool {
    /// Whatever else stands at the top.
    #[derive(serde::Deserialize)]
    struct Top {
        format: Option<serde::de::IgnoredAny>,
    }
    let text = text.trim_start_matches('\u{FEFF}').trim_start();
    if text.starts_with('{')
        && let Ok(top) = serde_json::from_str::<Top>(text)
    {
        return top.format.is_some();
    }
    text.lines().take(50).any(|line| {
        let line = line.trim_start().trim_start_matches(['{', ' ']).trim_start_matches(['"', '\'']);
        line.strip_prefix("format")
            .is_some_and(|rest| rest.trim_start_matches(['"', '\'', ' ']).starts_with(['=', ':']))
    })
}

/// Reads a building of any known format.
///
/// # Errors
/// The file cannot be read, its format is not known, no room is left of it; in strict reading also whenever something
/// had to be mended or left out.
pub fn read(path: &Path, options: &Options) -> Result<Imported, ImportError> {
    if let Some(pixel) = options.pixel {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        return read_grid(&name, &input::file_bytes(path)?, pixel, Point::origin(), options);
    }
    let text = if path.is_dir() { None } else { Some(input::file_text(path)?) };
    let input = Input { path, text, assets: options.assets.as_deref() };
    let format = options.format.or_else(|| Format::recognised(&input)).ok_or_else(|| {
        let known: Vec<&str> = READERS.iter().map(|r| r.title).collect();
        ImportError::UnknownFormat { path: path.display().to_string(), known: known.join(", ") }
    })?;
    let imported = match READERS.iter().find(|r| r.format == format) {
        None => own(path, &input)?,
        Some(reader) => foreign(reader, &input, options)?,
    };
    accepted(imported, options)
}

/// What was read, as the options want it.
fn accepted(mut imported: Imported, options: &Options) -> Result<Imported, ImportError> {
    if let Some(profile) = options.profile {
        imported.world.domain.profile = profile;
    }
    if options.strict && !imported.report.is_clean() {
        let report = Box::new(imported.report);
        let [mended, skipped] =
            [super::Treatment::Mended, super::Treatment::Skipped].map(|t| report.count(t));
        return Err(ImportError::Strict { mended, skipped, report });
    }
    Ok(imported)
}

/// A map file of our own.
fn own(path: &Path, input: &Input<'_>) -> Result<Imported, ImportError> {
    let reading = match &input.text {
        Some(text) => map::read(text, map::Format::of_text(path, text.text())),
        None => map::read_file(path),
    };
    match reading.world {
        Some(world) => {
            let mut report = Report::new("orthoframe", &path.display().to_string());
            for (what, count) in [
                (What::Level, world.maps.len()),
                (What::Room, world.areas.len()),
                (What::Door, world.doors.len()),
                (What::Kind, world.objects.len()),
                (What::Thing, world.replicas.len()),
                (What::Place, world.places.len()),
            ] {
                report.found(what, count);
                report.taken(what, count);
            }
            Ok(Imported { world, report, warnings: reading.faults })
        }
        None => Err(reading.faults.into()),
    }
}

fn synonyms(options: &Options) -> Result<Synonyms, ImportError> {
    Ok(match &options.synonyms {
        Some(path) => Synonyms::load(path)?,
        None => Synonyms::built_in(),
    })
}

fn foreign(reader: &Reader, input: &Input<'_>, options: &Options) -> Result<Imported, ImportError> {
    let synonyms = synonyms(options)?;
    let survey = (reader.read)(input)?;
    let name = input.path.file_name().map_or_else(String::new, |n| n.to_string_lossy().into());
    assembled(reader, &name, survey, synonyms, options)
}

/// Makes a building of an occupancy grid in memory: a binary PGM as ROS map_server has it, `cell` cm to a cell, its lower
/// left corner at `low`.
///
/// # Errors
/// As [`read`].
pub fn read_grid(
    name: &str,
    picture: &[u8],
    cell: f64,
    low: Point,
    options: &Options,
) -> Result<Imported, ImportError> {
    if !(0.1..=1000.0).contains(&cell) {
        let what = said!("cell-size", cell);
        return Err(ReadError::NoBuilding { format: ros::FORMAT, what }.into());
    }
    let sheet = ros::Sheet {
        image: String::new(),
        resolution: cell,
        origin: Frame::new(low.x, low.y, 0.0, Deg::ZERO),
        negate: false,
        occupied_thresh: 0.65,
        free_thresh: 0.196,
        is_raw: false,
    };
    let survey = ros::read_parts(name, &sheet, picture)?;
    let reader = READERS.iter().find(|reader| reader.format == Format::Ros);
    let reader = reader.expect("grids are read");
    let imported = assembled(reader, name, survey, synonyms(options)?, options)?;
    accepted(imported, options)
}

fn assembled(
    reader: &Reader,
    name: &str,
    mut survey: Survey,
    synonyms: Synonyms,
    options: &Options,
) -> Result<Imported, ImportError> {
    let synonyms = synonyms.of_format(reader.key);
    let told = if survey.frame.is_empty() { "" } else { "; " };
    survey.frame = format!("{} «{name}», см{told}{}", reader.title, survey.frame);
    let mut report = Report::new(reader.title, name);
    for remark in &survey.remarks {
        let why = Why::Other { text: remark.text.clone() };
        report.mended(What::Record, &remark.source, why);
    }
    for told in &survey.told {
        let why = Why::Other { text: told.text.clone() };
        report.note(told.treatment, told.what, &told.source, why);
        report.found(told.what, told.count.found);
        report.taken(told.what, told.count.taken);
    }
    for note in &survey.notes {
        report.noted(What::Record, &note.source, Why::Other { text: note.text.clone() });
    }
    let mut world = assemble(&survey, &synonyms, &mut report)?;
    let feet = survey.feet;
    if feet.are_loose() {
        world.domain.profile = Profile::Detected;
        if options.profile.is_none() {
            let Feet { off, of } = feet;
            report.noted(What::Building, name, Why::LooseBoxes { off, of });
        }
    }
    Ok(Imported { world, report, warnings: MapErrors { source: None, faults: Vec::new() } })
}
