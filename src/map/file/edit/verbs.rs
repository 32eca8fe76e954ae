//! An edit as a value: one variant a verb, with what can be said beside it.

use crate::units::word;
use serde::Deserialize;

use super::super::decode::{decode, likely, shortened};
use super::super::node::{Entry, Misprint, Node};
use super::super::schema::{
    AreaFile, Coordinates, DoorFile, DoorStateFile, FormsFile, Number, ObjectFile, OrthoframeFile,
    Pairs, PlanFile, Table, TypeFile, ZoneFile, ZoneWord,
};
use super::super::text::{Lines, key};
use super::in_file::{InFile, told};
use super::word::{Slips, misprint, unknown_field, wrong_kind};
use crate::fault::MapError;
use crate::{DoorStatus, OpensTo, Permeability, TypeKind};

/// A record that an edit brings, under its key, as a map file tells of it. Names in it are those of the map and of what else
/// the edits bring.
#[derive(Debug, Clone, PartialEq)]
pub enum NewRecord {
    Type(TypeKind, TypeFile),
    Orthoframe(String, OrthoframeFile),
    Door(String, DoorFile),
    Object(String, ObjectFile),
    /// With what stands in it.
    Area(String, AreaFile),
    Map(String, PlanFile),
    Zone(String, ZoneFile),
}

impl NewRecord {
    /// The section of an edit file for it.
    fn text(&self) -> String {
        let record =
            |section: &str, of: &String, lines: String| format!("[{section}.{}]\n{lines}", key(of));
        match self {
            Self::Type(kind, file) => format!("[[type.{}]]\n{}", kind.field(), file.lines()),
            Self::Orthoframe(key, file) => record("orthoframe", key, file.lines()),
            Self::Door(key, file) => record("door", key, file.lines()),
            Self::Object(key, file) => record("object", key, file.lines()),
            Self::Area(key, file) => record("area", key, file.lines()),
            Self::Map(key, file) => record("map", key, file.lines()),
            Self::Zone(key, file) => record("zone", key, file.lines()),
        }
    }
}

/// As [`RobotFile`](super::super::schema::RobotFile), where no corners are something else than none told.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RobotSaid {
    pub radius: Option<Number>,
    pub footprint: Option<Vec<[Number; 2]>>,
    pub height: Option<Number>,
    pub step: Option<Number>,
    pub clearance: Option<Number>,
    pub speed: Option<Number>,
    pub turn_rate: Option<Number>,
    /// The place where it stands when nothing else is known.
    pub start: Option<String>,
    pub opens: Option<bool>,
}

impl RobotSaid {
    /// The section of an edit file for it.
    fn text(&self) -> String {
        [
            "[robot]\n".to_owned(),
            told("radius", &self.radius),
            told("footprint", &self.footprint),
            told("height", &self.height),
            told("step", &self.step),
            told("clearance", &self.clearance),
            told("speed", &self.speed),
            told("turn_rate", &self.turn_rate),
            told("start", &self.start),
            told("opens", &self.opens),
        ]
        .concat()
    }
}

/// A step begins with its verb and what that is done to.
fn verb_line(verb: &str, name: &String) -> String {
    format!("[[edit]]\n{}", name.told(verb))
}

/// Declares the verbs: what must stand beside one, and after the semicolon what may.
macro_rules! verbs {
    ($(
        $(#[$doc:meta])*
        $verb:literal $variant:ident {
            $( $(#[$req_doc:meta])* $req:ident: $req_ty:ty, )*
            ;
            $( $(#[$opt_doc:meta])* $opt:ident: $opt_ty:ty, )*
        }
    )+) => {
        /// One step of an edit. Names are those that the map gives, or that an edit before gave; lengths are cm, angles degrees
        /// counter-clockwise, made by `"10,0".parse()` and `90.0.try_into()`, which refuse what no map has.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Edit {
            /// A record that was not there. All that edits bring is there before the first step is done.
            New(Box<NewRecord>),
            /// What is said of the robot; the rest of it stays.
            Robot(RobotSaid),
            $(
                $(#[$doc])*
                $variant {
                    name: String,
                    $( $(#[$req_doc])* $req: $req_ty, )*
                    $( $(#[$opt_doc])* $opt: $opt_ty, )*
                },
            )+
        }

        /// Every verb with the fields that may stand beside it.
        const VERBS: &[(&str, &[&str])] =
            &[$( ($verb, &[$( stringify!($req), )* $( stringify!($opt), )*]), )+];

        /// The step that a table with this verb tells.
        fn step(slips: &mut Slips<'_>, node: &Node, verb: &Entry) -> Option<Edit> {
            match verb.key.as_str() {
                $(
                    $verb => {
                        #[derive(Deserialize)]
                        struct Step {
                            #[serde(rename = $verb)]
                            name: String,
                            $( $req: <$req_ty as InFile>::File, )*
                            $( #[serde(default)] $opt: <$opt_ty as InFile>::File, )*
                        }
                        let read = decode::<Step>(
                            node,
                            &verb.key_span,
                            slips.left_out,
                            slips.misprints,
                        );
                        read.map(|Step { name, $( $req, )* $( $opt, )* }| {
                            Edit::$variant {
                                name,
                                $( $req: InFile::of($req), )*
                                $( $opt: InFile::of($opt), )*
                            }
                        })
                    }
                )+
                _ => None,
            }
        }

        impl Edit {
            /// The word by which a step is told; none for what is told in a section of its own.
            pub(super) fn verb(&self) -> Option<&'static str> {
                match self {
                    Self::New(_) | Self::Robot(_) => None,
                    $( Self::$variant { .. } => Some($verb), )+
                }
            }

            /// The edit as a piece of an edit file.
            pub(super) fn text(&self) -> String {
                match self {
                    Self::New(record) => record.text(),
                    Self::Robot(said) => said.text(),
                    $(
                        Self::$variant { name, $( $req, )* $( $opt, )* } => [
                            verb_line($verb, name),
                            $( $req.told(stringify!($req)), )*
                            $( told(stringify!($opt), $opt), )*
                        ]
                        .concat(),
                    )+
                }
            }
        }
    };
}

verbs! {
    /// A replica of an Object put down in an Area.
    "place" Place {
        object: String,
        area: String,
        ;
        /// In the frame of the Area.
        at: Option<Coordinates>,
        /// In the frame of the Map, in place of `at`; the angle is then of that frame as well.
        pose: Option<Coordinates>,
        angle: Option<Number>,
        name_en: Option<String>,
        /// 0 never moves, 100 may be anywhere.
        move_prob: Option<u32>,
        properties: Pairs,
        /// How its doors stand, where they differ from the Object's.
        doors: Table<DoorStateFile>,
        forms: FormsFile,
    }
    /// A named place to stand.
    "point" Point {
        area: String,
        ;
        /// In the frame of the Area.
        at: Option<[Number; 2]>,
        /// In the frame of the Map, in place of `at`; the heading is then of that frame as well.
        pose: Option<[Number; 2]>,
        heading: Option<Number>,
        /// The replica that is served from here.
        serves: Option<String>,
        name_en: Option<String>,
        forms: FormsFile,
    }
    /// A thing, a place or a zone put elsewhere: to a place, by an offset, into another Area.
    "move" Move {
        ;
        to: Option<Coordinates>,
        by: Option<Coordinates>,
        area: Option<String>,
        /// With what stands on it or lies in it.
        carry: bool,
    }
    /// A thing turned, or the heading of a place.
    "turn" Turn {
        ;
        to: Option<Number>,
        by: Option<Number>,
        carry: bool,
    }
    /// A record taken out, with what only it gave a place.
    "remove" Remove {
        ;
        /// Which of several that bear the name: see [`kinds`](super::kinds()).
        kind: Option<String>,
    }
    /// Another name.
    "rename" Rename {
        ;
        to: Option<String>,
        en: Option<String>,
        forms: Option<FormsFile>,
        kind: Option<String>,
    }
    /// A property given a value, or how likely a thing is to be moved.
    "set" Set {
        ;
        property: Option<String>,
        value: Option<String>,
        /// Of this side of an Orthoframe.
        side: Option<String>,
        move_prob: Option<u32>,
        kind: Option<String>,
    }
    /// A property taken away.
    "unset" Unset {
        property: String,
        ;
        side: Option<String>,
        kind: Option<String>,
    }
    /// How a door stands, or a door of an Object on one replica.
    "state" State {
        is: DoorStatus,
        ;
        /// Percent of the largest opening.
        opening: Option<Number>,
        on: Option<String>,
    }
    /// A door hung in a side of an Area or Object: "side" or "item.side".
    "bind" Bind {
        to: String,
        side: String,
        ;
        opens: Option<OpensTo>,
    }
    /// A door taken off one Area or Object, or off all.
    "unbind" Unbind {
        ;
        from: Option<String>,
    }
    /// Another part of an Object or Area.
    "item" Item {
        of: String,
        orthoframe: String,
        ;
        at: Option<Coordinates>,
        angle: Option<Number>,
        base: Option<bool>,
    }
    /// Faces of two parts of an Object or Area bound together, or sides of two Areas of a Map.
    "link" Link {
        to: String,
        ;
        of: Option<String>,
        rel: Option<Coordinates>,
        angle: Option<Number>,
    }
    /// A link taken away.
    "unlink" Unlink {
        to: String,
        ;
        of: Option<String>,
    }
    /// An Area stood on a Map, or elsewhere on it.
    "stand" Stand {
        ;
        map: Option<String>,
        at: Option<Coordinates>,
        angle: Option<Number>,
        base: Option<bool>,
        /// What its links say of where it lies is told anew, and the Map keeps its coordinates.
        relink: bool,
    }
    /// A Map put into the Domain, or elsewhere in it.
    "include" Include {
        ;
        at: Option<Coordinates>,
        angle: Option<Number>,
        base: Option<bool>,
    }
    /// A lift, or a flight of stairs, with its stops; one of this name gets these stops.
    "lift" Lift {
        stops: Vec<String>,
        ;
    }
    /// A new zone, or what is said anew of one that is there. A text that is empty is taken back.
    "zone" Zone {
        ;
        kind: Option<ZoneWord>,
        rooms: Option<Vec<String>>,
        map: Option<String>,
        points: Option<Vec<[Number; 2]>>,
        /// Of a slow zone, cm/s.
        speed: Option<Number>,
        /// Of a one-way zone.
        heading: Option<Number>,
        reason: Option<String>,
        reason_en: Option<String>,
        from: Option<String>,
        until: Option<String>,
        name_en: Option<String>,
        forms: Option<FormsFile>,
    }
    /// A stretch of a side made a side of its own, in which a door can hang.
    "cut" Cut {
        /// "side" or "item.side".
        side: String,
        from: Number,
        to: Number,
        ;
        /// The id of the stretch.
        r#as: Option<String>,
        r#type: Option<String>,
        permeability: Option<Permeability>,
    }
    /// The corners of an Area's item elsewhere, in the frame of the Area.
    "shape" Shape {
        points: Vec<[Number; 2]>,
        ;
        item: Option<String>,
    }
}

/// Verbs whose steps make something, which others may speak of.
pub(super) const MAKING: [&str; 3] = ["place", "point", "zone"];

/// Reads one step; what it is refused for is noted.
pub(super) fn read_step(slips: &mut Slips<'_>, node: &Node) -> Option<Edit> {
    let verbs: Vec<&str> = VERBS.iter().map(|(verb, _)| *verb).collect();
    let Some(verb) = node.entries().iter().find(|e| verbs.contains(&e.key.as_str())) else {
        slips.misprints.push(*no_verb(node, &verbs));
        return None;
    };
    let (_, fields) = VERBS.iter().find(|(v, _)| *v == verb.key).expect("found by its name");
    let fields: Vec<&str> = fields.iter().map(|f| f.trim_start_matches("r#")).collect();
    let is_other = |e: &&Entry| e.key != verb.key && !fields.contains(&e.key.as_str());
    let unknown: Vec<&Entry> = node.entries().iter().filter(is_other).collect();
    slips.misprints.extend(unknown.iter().map(|e| *unknown_field(e, &fields)));
    if unknown.is_empty() { step(slips, node, verb) } else { None }
}

fn no_verb(node: &Node, verbs: &[&str]) -> Box<Misprint> {
    match node.entries().first() {
        None => wrong_kind(node, word!("a-step-of-an-edit-a-table")),
        Some(first) => misprint(
            MapError::UnknownVerb {
                found: shortened(&first.key),
                nearest: likely(&first.key, verbs),
                expected: verbs.join(", "),
            },
            &first.key_span,
        ),
    }
}
