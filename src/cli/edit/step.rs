//! The steps of an edit as arguments.

use clap::builder::PossibleValuesParser;
use clap::{Args, Subcommand};

use crate::cli::number::finite;
use crate::map;

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
        /// Instead of --at, in the frame of the Map, cm; --angle is then of that frame as well
        #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, conflicts_with = "at")]
        pose: Option<Numbers>,
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
        #[arg(
            long,
            value_name = "X,Y",
            allow_hyphen_values = true,
            required_unless_present = "pose"
        )]
        at: Option<Numbers>,
        /// Instead of --at, in the frame of the Map, cm; --heading is then of that frame as well
        #[arg(long, value_name = "X,Y", allow_hyphen_values = true, conflicts_with = "at")]
        pose: Option<Numbers>,
        #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = finite)]
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
        #[arg(long, value_name = "DEG", allow_hyphen_values = true, conflicts_with = "by", value_parser = finite)]
        to: Option<f64>,
        #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = finite)]
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
    /// Set a property: set "Chair 1" colour red
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
        #[arg(long, value_name = "PERCENT", value_parser = finite)]
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
        /// A side that is not a wall: F=conditional, or F=conditional,DOOR with its type
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
        #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = finite)]
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
    /// Lay out a zone, or say something else of one: a field given empty is taken back
    Zone {
        /// A new zone, or one that is there
        name: String,
        /// keep-out, closed, slow or one-way
        #[arg(long, value_name = "WORD")]
        kind: Option<String>,
        /// The Areas that it is
        #[arg(long, value_name = "AREA,…", value_delimiter = ',')]
        rooms: Vec<String>,
        /// Its corners in the Map, cm: "0,0 40,0 20,30"
        #[arg(long, value_name = "X,Y …", allow_hyphen_values = true, conflicts_with = "rooms")]
        points: Option<String>,
        /// The Map on which they lie
        #[arg(long, value_name = "NAME")]
        map: Option<String>,
        /// Of a slow zone, cm/s
        #[arg(long, value_name = "CM/S", value_parser = finite)]
        speed: Option<f64>,
        /// Of a one-way zone, degrees counter-clockwise
        #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = finite)]
        heading: Option<f64>,
        /// Why, in a few words that follow "closed:"
        #[arg(long, value_name = "TEXT")]
        reason: Option<String>,
        /// The same in English
        #[arg(long, value_name = "TEXT")]
        reason_en: Option<String>,
        /// From when it is in force, such as 2026-11-21T09:30Z
        #[arg(long, value_name = "MOMENT")]
        from: Option<String>,
        /// Until when it is in force
        #[arg(long, value_name = "MOMENT")]
        until: Option<String>,
        /// The name in English
        #[arg(long, value_name = "NAME")]
        name_en: Option<String>,
    },
}

/// Where something stands.
#[derive(Debug, Args)]
pub(super) struct At {
    /// cm
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true)]
    pub(super) at: Option<Numbers>,
    /// Degrees counter-clockwise
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = finite)]
    pub(super) angle: Option<f64>,
}

#[derive(Debug, Args)]
pub(super) struct KindArg {
    /// What bears the name, where several kinds of things do
    #[arg(long, value_parser = PossibleValuesParser::new(map::kinds()))]
    pub(super) kind: Option<String>,
}

/// What most records have.
#[derive(Debug, Args)]
pub(super) struct Names {
    /// The key if left out
    #[arg(long, value_name = "NAME")]
    pub(super) name: Option<String>,
    #[arg(long, value_name = "NAME")]
    pub(super) name_en: Option<String>,
    #[arg(long = "type", value_name = "NAME")]
    pub(super) kind_of: Option<String>,
    /// A property: colour=red
    #[arg(long = "property", value_name = "NAME=VALUE")]
    pub(super) properties: Vec<String>,
}

#[derive(Debug, Args)]
pub(super) struct Group {
    /// A part: its id, Orthoframe, place and angle: A=board, B=leg@10,10,0,90
    #[arg(long = "item", value_name = "ID=KEY[@X,Y[,Z[,DEG]]]", required = true)]
    pub(super) items: Vec<String>,
    /// Faces that belong together: A.roof=B.base
    #[arg(long = "link", value_name = "FROM=TO")]
    pub(super) links: Vec<String>,
}

/// Numbers with commas.
#[derive(Debug, Clone)]
pub(in crate::cli) struct Numbers(pub(in crate::cli) Vec<f64>);

impl std::str::FromStr for Numbers {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let number = |n: &str| finite(n).map_err(|wanted| format!("“{}”: {wanted}", n.trim()));
        text.split(',').map(number).collect::<Result<_, _>>().map(Self)
    }
}
