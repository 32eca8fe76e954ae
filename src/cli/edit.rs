//! `ortho edit`: one step of an edit told in arguments, or a whole file of them.
//!
//! The arguments are written out as an edit file (see [`crate::map::edit`]) and go its way, so that both can do the
//! same and are refused for the same.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand, ValueEnum};
use serde_json::json;

use crate::engine::{Difference, Edited, Format, Mode, change_now};
use crate::units::Source;

use super::args::{Common, Lang};
use super::commands::{open_to_write, warn};
use super::fault::Failure;
use super::{Answer, say};

#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = false, subcommand_negates_reqs = true)]
pub(super) struct EditArgs {
    /// A file of edits (TOML, YAML or JSON): one transaction, all faults at once
    #[arg(long, value_name = "FILE", required = true)]
    pub file: Option<PathBuf>,
    /// Check, say what would change, write nothing
    #[arg(long, global = true)]
    pub dry_run: bool,
    /// Why the change is made, for the history
    #[arg(long, global = true, value_name = "TEXT")]
    pub reason: Option<String>,
    #[command(subcommand)]
    pub step: Option<Step>,
}

#[derive(Debug, Subcommand)]
pub(super) enum Step {
    /// Place a replica of an Object in an Area
    Place {
        name: String,
        #[arg(long, value_name = "NAME")]
        object: String,
        #[arg(long, value_name = "NAME")]
        area: String,
        #[command(flatten)]
        at: At,
        /// 0 never moves, 100 may be anywhere
        #[arg(long, value_name = "0..100")]
        move_prob: Option<u32>,
        #[arg(long, value_name = "NAME")]
        name_en: Option<String>,
    },
    /// Name a place to stand
    Point {
        name: String,
        #[arg(long, value_name = "NAME")]
        area: String,
        /// In the Area's frame, cm
        #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
        at: Numbers,
        #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
        heading: Option<f64>,
        /// The thing that is served from here
        #[arg(long, value_name = "NAME")]
        serves: Option<String>,
    },
    /// Move a thing or a place: to a point, by an offset, into another Area
    Move {
        name: String,
        /// In the Area's frame, cm
        #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, conflicts_with = "by")]
        to: Option<Numbers>,
        /// cm
        #[arg(long, value_name = "DX,DY[,DZ]", allow_hyphen_values = true)]
        by: Option<Numbers>,
        #[arg(long, value_name = "NAME")]
        area: Option<String>,
        /// With what stands on it or lies in it
        #[arg(long)]
        carry: bool,
    },
    /// Turn a thing, or the heading of a place
    Turn {
        name: String,
        /// Degrees counter-clockwise
        #[arg(long, value_name = "DEG", allow_hyphen_values = true, conflicts_with = "by")]
        to: Option<f64>,
        #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
        by: Option<f64>,
        /// With what stands on it or lies in it
        #[arg(long)]
        carry: bool,
    },
    /// Take anything out of the map
    Remove {
        name: String,
        #[command(flatten)]
        kind: KindArg,
    },
    /// Give another name
    Rename {
        name: String,
        to: Option<String>,
        /// The English name
        #[arg(long, value_name = "NAME")]
        en: Option<String>,
        #[command(flatten)]
        kind: KindArg,
    },
    /// Set a property: set "Стул-1" ЦВЕТ Красный
    Set {
        name: String,
        property: String,
        value: String,
        /// Of this side of an Orthoframe
        #[arg(long, value_name = "ID")]
        side: Option<String>,
        #[command(flatten)]
        kind: KindArg,
    },
    /// Take a property away
    Unset {
        name: String,
        property: String,
        #[arg(long, value_name = "ID")]
        side: Option<String>,
        #[command(flatten)]
        kind: KindArg,
    },
    /// How likely a thing is to be moved: 0 never, 100 may be anywhere
    MoveProb { name: String, percent: u32 },
    /// State of a door: open, closed or locked
    State {
        door: String,
        state: String,
        /// Percent of the largest opening
        #[arg(long, value_name = "PERCENT")]
        opening: Option<f64>,
        /// A door of this thing
        #[arg(long, value_name = "NAME")]
        on: Option<String>,
    },
    /// Create an Orthoframe
    Orthoframe {
        key: String,
        /// Width and depth, cm
        #[arg(long, value_name = "W,D", conflicts_with_all = ["points", "regular"])]
        rect: Option<Numbers>,
        /// Corners counter-clockwise: "0,0 40,0 20,30"
        #[arg(long, value_name = "X,Y …", allow_hyphen_values = true)]
        points: Option<String>,
        /// A regular polygon: corners and radius
        #[arg(long, value_name = "N,R", conflicts_with = "points")]
        regular: Option<Numbers>,
        /// cm
        #[arg(long, value_name = "CM")]
        height: f64,
        /// Permeability of the base
        #[arg(long, value_name = "WORD")]
        base: Option<String>,
        /// Permeability of the roof
        #[arg(long, value_name = "WORD")]
        roof: Option<String>,
        /// A side that is not a wall: F=conditional, or F=conditional,Дверь with its type
        #[arg(long, value_name = "ID=WORD[,TYPE]")]
        side: Vec<String>,
        #[command(flatten)]
        names: Names,
    },
    /// Create a door
    Door {
        key: String,
        /// hinged, sliding or passage
        #[arg(long, value_name = "WORD")]
        kind: String,
        /// cm
        #[arg(long, value_name = "CM")]
        width: f64,
        /// cm
        #[arg(long, value_name = "CM")]
        height: f64,
        /// A leaf: right or left, with its share of the width: right, left=0.4
        #[arg(long, value_name = "HINGE[=SHARE]")]
        leaf: Vec<String>,
        /// open, closed or locked
        #[arg(long, value_name = "WORD")]
        state: Option<String>,
        #[command(flatten)]
        names: Names,
    },
    /// Create an Object from Orthoframes
    Object {
        key: String,
        #[command(flatten)]
        group: Group,
        /// The side that looks forward
        #[arg(long, value_name = "[ITEM.]SIDE")]
        front: Option<String>,
        #[arg(long, value_name = "[ITEM.]SIDE")]
        back: Option<String>,
        #[command(flatten)]
        names: Names,
    },
    /// Create an Area from Orthoframes
    Area {
        key: String,
        #[command(flatten)]
        group: Group,
        #[command(flatten)]
        names: Names,
    },
    /// Create a Map of Areas
    Map {
        key: String,
        /// An Area and where it stands: room@0,0 or room@560,0,0,90
        #[arg(long = "area", value_name = "AREA@X,Y[,Z[,DEG]]", required = true)]
        areas: Vec<String>,
        /// Sides that belong together: room.C=corridor.A
        #[arg(long = "link", value_name = "FROM=TO")]
        links: Vec<String>,
        #[command(flatten)]
        names: Names,
    },
    /// Bind a door to a side of an Area or Object
    Bind {
        door: String,
        /// Area or Object
        #[arg(long, value_name = "NAME")]
        to: String,
        #[arg(long, value_name = "[ITEM.]SIDE")]
        side: String,
        /// inside or outside
        #[arg(long, value_name = "WORD")]
        opens: Option<String>,
    },
    /// Take a door off
    Unbind {
        door: String,
        #[arg(long, value_name = "NAME")]
        from: Option<String>,
    },
    /// Add a part to an Object or Area
    Item {
        id: String,
        #[arg(long, value_name = "NAME")]
        of: String,
        #[arg(long, value_name = "KEY")]
        orthoframe: String,
        #[command(flatten)]
        at: At,
    },
    /// Link sides of two Areas of a Map, or faces of two parts of an Object or Area
    Link {
        /// area.side, area.item.side; with --of OBJECT item.side, item.roof, item.base
        from: String,
        to: String,
        /// The Map, Object or Area to which both belong
        #[arg(long, value_name = "NAME")]
        of: Option<String>,
        /// Offset of the second from the first, cm
        #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true)]
        rel: Option<Numbers>,
        #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
        angle: Option<f64>,
    },
    /// Take a link away
    Unlink {
        from: String,
        to: String,
        #[arg(long, value_name = "NAME")]
        of: Option<String>,
    },
    /// Stand an Area on a Map, or somewhere else on it
    Stand {
        area: String,
        #[arg(long, value_name = "NAME")]
        map: Option<String>,
        #[command(flatten)]
        at: At,
    },
    /// Bind a Map to the Domain, or put it elsewhere in it
    Include {
        map: String,
        #[command(flatten)]
        at: At,
    },
    /// A lift or a flight of stairs, by the Areas in which it stops
    Lift {
        name: String,
        #[arg(long, value_name = "AREA,…", value_delimiter = ',', required = true)]
        stops: Vec<String>,
    },
}

/// Where something stands.
#[derive(Debug, Args)]
pub(super) struct At {
    /// cm
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true)]
    at: Option<Numbers>,
    /// Degrees counter-clockwise
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    angle: Option<f64>,
}

#[derive(Debug, Args)]
pub(super) struct KindArg {
    /// What bears the name, where several kinds of things do
    #[arg(long, value_enum)]
    kind: Option<KindWord>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum KindWord {
    Replica,
    Area,
    Door,
    Place,
    Map,
    Object,
    Orthoframe,
}

/// What most records have.
#[derive(Debug, Args)]
pub(super) struct Names {
    /// The key if left out
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    #[arg(long, value_name = "NAME")]
    name_en: Option<String>,
    #[arg(long = "type", value_name = "NAME")]
    kind_of: Option<String>,
    /// A property: ЦВЕТ=Красный
    #[arg(long = "property", value_name = "NAME=VALUE")]
    properties: Vec<String>,
}

#[derive(Debug, Args)]
pub(super) struct Group {
    /// A part: its id, Orthoframe, place and angle: A=board, B=leg@10,10,0,90
    #[arg(long = "item", value_name = "ID=KEY[@X,Y[,Z[,DEG]]]", required = true)]
    items: Vec<String>,
    /// Faces that belong together: A.roof=B.base
    #[arg(long = "link", value_name = "FROM=TO")]
    links: Vec<String>,
}

/// Numbers with commas.
#[derive(Debug, Clone)]
pub(super) struct Numbers(pub(super) Vec<f64>);

impl std::str::FromStr for Numbers {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let number = |n: &str| n.trim().parse::<f64>().map_err(|e| format!("{n}: {e}"));
        text.split(',').map(number).collect::<Result<_, _>>().map(Self)
    }
}

/// An edit file in the making.
#[derive(Default)]
struct Text(String);

impl Text {
    fn head(header: &str) -> Self {
        Self(format!("{header}\n"))
    }

    fn step(verb: &str, what: &str) -> Self {
        Self::head("[[edit]]").text(verb, what)
    }

    fn line(mut self, field: &str, value: &str) -> Self {
        let _ = writeln!(self.0, "{field} = {value}");
        self
    }

    fn text(self, field: &str, value: &str) -> Self {
        self.line(field, &quoted(value))
    }

    fn opt(self, field: &str, value: Option<&String>) -> Self {
        value.map_or_else(String::new, |v| format!("{field} = {}\n", quoted(v))).prepend(self)
    }

    fn flag(self, field: &str, is_set: bool) -> Self {
        if is_set { self.line(field, "true") } else { self }
    }

    fn number(self, field: &str, value: Option<f64>) -> Self {
        match value {
            Some(value) => self.line(field, &value.to_string()),
            None => self,
        }
    }

    fn numbers(self, field: &str, value: Option<&Numbers>) -> Self {
        match value {
            Some(Numbers(list)) => self.line(field, &list_of(list)),
            None => self,
        }
    }

    fn at(self, at: &At) -> Self {
        self.numbers("at", at.at.as_ref()).number("angle", at.angle)
    }

    fn kind(self, kind: &KindArg) -> Self {
        let word = kind.kind.and_then(|k| k.to_possible_value().map(|v| v.get_name().to_owned()));
        self.opt("kind", word.as_ref())
    }

    fn names(self, names: &Names) -> Self {
        let mut text = self
            .opt("name", names.name.as_ref())
            .opt("name_en", names.name_en.as_ref())
            .opt("type", names.kind_of.as_ref());
        for pair in &names.properties {
            let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
            text = text.text(&format!("properties.{}", quoted(name)), value);
        }
        text
    }

    fn links(self, links: &[String]) -> Self {
        if links.is_empty() {
            return self;
        }
        let link = |link: &String| {
            let (from, to) = link.split_once('=').unwrap_or((link, ""));
            format!("  {{ from = {}, to = {} }},\n", quoted(from.trim()), quoted(to.trim()))
        };
        let lines: String = links.iter().map(link).collect();
        self.line("links", &format!("[\n{lines}]"))
    }
}

trait Prepend {
    fn prepend(self, text: Text) -> Text;
}

impl Prepend for String {
    fn prepend(self, text: Text) -> Text {
        Text(text.0 + &self)
    }
}

/// A text between quotation marks, as TOML and JSON write it alike.
fn quoted(text: &str) -> String {
    json!(text).to_string()
}

fn list_of(numbers: &[f64]) -> String {
    let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
    format!("[{}]", words.join(", "))
}

/// `KEY[@X,Y[,Z[,DEG]]]` as the fields of a line; what is no number is left for the reader to refuse.
fn placed(field: &str, text: &str) -> String {
    let Some((key, at)) = text.split_once('@') else {
        return format!("{field} = {}", quoted(text.trim()));
    };
    let mut numbers: Vec<&str> = at.split(',').map(str::trim).collect();
    let angle = if numbers.len() == 4 { numbers.pop() } else { None };
    let angle = angle.map_or_else(String::new, |a| format!(", angle = {a}"));
    format!("{field} = {}, at = [{}]{angle}", quoted(key.trim()), numbers.join(", "))
}

fn group(text: Text, group: &Group) -> Text {
    let item = |item: &String| {
        let (id, rest) = item.split_once('=').unwrap_or((item, ""));
        format!("  {{ id = {}, {} }},\n", quoted(id.trim()), placed("orthoframe", rest))
    };
    let items: String = group.items.iter().map(item).collect();
    text.line("items", &format!("[\n{items}]")).links(&group.links)
}

impl Step {
    /// The step as an edit file.
    fn text(&self) -> String {
        let record = |section: &str, key: &str| Text::head(&format!("[{section}.{}]", quoted(key)));
        let text = match self {
            Self::Place { name, object, area, at, move_prob, name_en } => Text::step("place", name)
                .text("object", object)
                .text("area", area)
                .at(at)
                .number("move_prob", move_prob.map(f64::from))
                .opt("name_en", name_en.as_ref()),
            Self::Point { name, area, at, heading, serves } => Text::step("point", name)
                .text("area", area)
                .numbers("at", Some(at))
                .number("heading", *heading)
                .opt("serves", serves.as_ref()),
            Self::Move { name, to, by, area, carry } => Text::step("move", name)
                .numbers("to", to.as_ref())
                .numbers("by", by.as_ref())
                .opt("area", area.as_ref())
                .flag("carry", *carry),
            Self::Turn { name, to, by, carry } => {
                Text::step("turn", name).number("to", *to).number("by", *by).flag("carry", *carry)
            }
            Self::Remove { name, kind } => Text::step("remove", name).kind(kind),
            Self::Rename { name, to, en, kind } => {
                Text::step("rename", name).opt("to", to.as_ref()).opt("en", en.as_ref()).kind(kind)
            }
            Self::Set { name, property, value, side, kind } => Text::step("set", name)
                .text("property", property)
                .text("value", value)
                .opt("side", side.as_ref())
                .kind(kind),
            Self::Unset { name, property, side, kind } => Text::step("unset", name)
                .text("property", property)
                .opt("side", side.as_ref())
                .kind(kind),
            Self::MoveProb { name, percent } => {
                Text::step("set", name).number("move_prob", Some(f64::from(*percent)))
            }
            Self::State { door, state, opening, on } => Text::step("state", door)
                .text("is", state)
                .number("opening", *opening)
                .opt("on", on.as_ref()),
            Self::Orthoframe { key, rect, points, regular, height, base, roof, side, names } => {
                let mut text = record("orthoframe", key)
                    .numbers("rect", rect.as_ref())
                    .number("height", Some(*height))
                    .opt("base", base.as_ref())
                    .opt("roof", roof.as_ref())
                    .names(names);
                if let Some(points) = points {
                    let corners: Vec<String> =
                        points.split_whitespace().map(|p| format!("[{p}]")).collect();
                    text = text.line("points", &format!("[{}]", corners.join(", ")));
                }
                if let Some(Numbers(regular)) = regular {
                    let word = |i: usize| regular.get(i).map_or_else(String::new, f64::to_string);
                    let table = format!("{{ corners = {}, radius = {} }}", word(0), word(1));
                    text = text.line("regular", &table);
                }
                for side in side {
                    let (id, traits) = side.split_once('=').unwrap_or((side, ""));
                    let (permeability, kind) = traits.split_once(',').unwrap_or((traits, ""));
                    let field = format!("side.{}", quoted(id.trim()));
                    text = text.text(&format!("{field}.permeability"), permeability.trim());
                    if !kind.is_empty() {
                        text = text.text(&format!("{field}.type"), kind.trim());
                    }
                }
                text
            }
            Self::Door { key, kind, width, height, leaf, state, names } => {
                let text = record("door", key)
                    .text("kind", kind)
                    .number("width", Some(*width))
                    .number("height", Some(*height))
                    .opt("state", state.as_ref())
                    .names(names);
                let leaves: Vec<String> = leaf
                    .iter()
                    .map(|leaf| match leaf.split_once('=') {
                        Some((hinge, share)) => {
                            format!("{{ hinge = {}, share = {share} }}", quoted(hinge))
                        }
                        None => format!("{{ hinge = {} }}", quoted(leaf)),
                    })
                    .collect();
                text.line("leaves", &format!("[{}]", leaves.join(", ")))
            }
            Self::Object { key, group: parts, front, back, names } => {
                group(record("object", key), parts)
                    .opt("front", front.as_ref())
                    .opt("back", back.as_ref())
                    .names(names)
            }
            Self::Area { key, group: parts, names } => {
                group(record("area", key), parts).names(names)
            }
            Self::Map { key, areas, links, names } => {
                let item = |item: &String| format!("  {{ {} }},\n", placed("area", item));
                let items: String = areas.iter().map(item).collect();
                let text = record("map", key).line("items", &format!("[\n{items}]"));
                text.links(links).names(names)
            }
            Self::Bind { door, to, side, opens } => Text::step("bind", door)
                .text("to", to)
                .text("side", side)
                .opt("opens", opens.as_ref()),
            Self::Unbind { door, from } => Text::step("unbind", door).opt("from", from.as_ref()),
            Self::Item { id, of, orthoframe, at } => {
                Text::step("item", id).text("of", of).text("orthoframe", orthoframe).at(at)
            }
            Self::Link { from, to, of, rel, angle } => Text::step("link", from)
                .text("to", to)
                .opt("of", of.as_ref())
                .numbers("rel", rel.as_ref())
                .number("angle", *angle),
            Self::Unlink { from, to, of } => {
                Text::step("unlink", from).text("to", to).opt("of", of.as_ref())
            }
            Self::Stand { area, map, at } => {
                Text::step("stand", area).opt("map", map.as_ref()).at(at)
            }
            Self::Include { map, at } => Text::step("include", map).at(at),
            Self::Lift { name, stops } => {
                let stops: Vec<String> = stops.iter().map(|s| quoted(s.trim())).collect();
                Text::step("lift", name).line("stops", &format!("[{}]", stops.join(", ")))
            }
        };
        text.0
    }
}

pub(super) fn run(common: &Common, args: &EditArgs) -> Result<Answer, Failure> {
    let (source, format) = match (&args.step, &args.file) {
        (Some(step), _) => (Source::new("аргументы", step.text()), Format::Toml),
        (None, Some(file)) => (read(file)?, Format::of(file)),
        (None, None) => (Source::new("аргументы", ""), Format::Toml),
    };
    let mut engine = open_to_write(common)?;
    let mode = if args.dry_run { Mode::DryRun } else { Mode::Commit };
    let change = change_now(&common.user, args.reason.as_deref().unwrap_or_default());
    let edited = engine.edit(&source, format, &change, mode)?;
    warn(&edited.warnings);
    if common.json { say(&view(&edited).to_string()) } else { say(&told(&edited, common.lang)) }
}

fn read(file: &Path) -> Result<Source, Failure> {
    Source::read(file).map_err(|e| Failure::file(file, &e))
}

fn view(edited: &Edited) -> serde_json::Value {
    let counts = edited.report.as_ref().map(|r| r.counts).unwrap_or_default();
    json!({
        "outcome": if edited.report.is_some() { "edited" } else { "tried" },
        "revision": edited.report.as_ref().map(|r| r.revision),
        "created": counts.created,
        "changed": counts.changed,
        "deleted": counts.deleted,
        "differences": differences(&edited.differences),
        "left_behind": edited.left_behind,
        "warnings": edited.warnings.faults.len(),
    })
}

pub(super) fn differences(all: &[Difference]) -> Vec<serde_json::Value> {
    use crate::store::{Cell, Fate};
    let cell = |cell: &Cell| match cell {
        Cell::Null => json!(null),
        Cell::Int(n) => json!(n),
        Cell::Real(x) => json!(x),
        Cell::Text(text) => json!(text),
    };
    let one = |d: &Difference| {
        let fields: Vec<_> = d
            .fields
            .iter()
            .map(|f| json!({"column": f.column, "old": cell(&f.old), "new": cell(&f.new)}))
            .collect();
        json!({
            "table": d.table.name(),
            "fate": match d.fate {
                Fate::Created => "created",
                Fate::Changed => "changed",
                Fate::Deleted => "deleted",
            },
            "subject": d.subject,
            "ru": d.to_string(),
            "fields": fields,
        })
    };
    all.iter().map(one).collect()
}

fn told(edited: &Edited, lang: Lang) -> String {
    if edited.differences.is_empty() {
        return lang.pick("Ничего не меняется.", "Nothing changes.").to_owned();
    }
    let mut text: String = edited.differences.iter().map(|d| format!("{d}\n")).collect();
    if !edited.left_behind.is_empty() {
        let names = edited.left_behind.join(", ");
        let _ = match lang {
            Lang::Ru if edited.left_behind.len() == 1 => writeln!(
                text,
                "{names} остаётся на прежнем месте, хотя опора уходит; --carry перенесёт и это."
            ),
            Lang::Ru => writeln!(
                text,
                "{names} остаются на прежних местах, хотя опора уходит; --carry перенесёт и их."
            ),
            Lang::En => writeln!(
                text,
                "Stays behind, though what bears it goes: {names}; --carry takes it along."
            ),
        };
    }
    text.push_str(&match (&edited.report, lang) {
        (Some(report), Lang::Ru) => format!("Правка {} записана.", report.revision),
        (Some(report), Lang::En) => format!("Revision {} is written.", report.revision),
        (None, Lang::Ru) => "Всё верно; ничего не записано.".to_owned(),
        (None, Lang::En) => "All is right; nothing was written.".to_owned(),
    });
    text
}
