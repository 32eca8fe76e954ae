//! The measured relations: their columns with units, and in what order pairs stand.
//!
//! The table says what `feed` writes; `rules/relations.dl` declares the same, and docs/relations.md prints it. A rule
//! text need not declare what it uses of it.
//!
//! **Invariant:** the declarations of the standard text, this table and the one in docs/relations.md are one; tests hold it.

use std::fmt::Write as _;

/// A relation that is measured, or told of the Map or by the robot.
#[derive(Debug, Clone, Copy)]
pub struct Measured {
    pub name: &'static str,
    /// Name, type in the rule text, and what it holds.
    pub columns: &'static [(&'static str, &'static str, &'static str)],
    pub order: Order,
    pub made: Made,
    pub meaning: &'static str,
}

/// When its rows are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Made {
    Always,
    /// Only for rule texts that use it.
    OnDemand,
    /// When a question asks for them, and for no longer.
    WhenAsked,
}

/// In what order two things stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// The columns mean different things.
    Told,
    /// The pair may be told either way. The standard rules get it once, the lower id first; as soon as a rule of the
    /// user's own reads the relation, it stands in both orders.
    Either,
}

const LENGTH: &str = "0.1 mm";
const ANGLE: &str = "0.01°";
const SHARE: &str = "‰";

macro_rules! measured {
    ($($(#[$flag:ident])? $name:ident($($column:ident: $kind:ident = $unit:expr),+) $order:ident $meaning:literal;)+) => {
        /// All measured relations, in the order of the standard text.
        pub const MEASURED: &[Measured] = &[$(Measured {
            name: stringify!($name),
            columns: &[$((stringify!($column), stringify!($kind), $unit)),+],
            order: Order::$order,
            made: measured!(@flag $($flag)?),
            meaning: $meaning,
        },)+];
    };
    (@flag) => { Made::Always };
    (@flag on_demand) => { Made::OnDemand };
    (@flag asked) => { Made::WhenAsked };
}

measured! {
    profile(name: symbol = "surveyed or detected") Told "which thresholds hold";
    replica(x: Thing = "", n: number = "id", kind: Kind = "", fragment: Area = "", move_prob: number = "percent") Told
        "each thing, its Object, and the Area to which the Map gives it";
    kind_trait(kind: Kind = "", is: symbol = "a word of the type list") Told "what the type list says of an Object";
    body(x: Thing = "", bottom: number = LENGTH, top: number = LENGTH, thin: number = LENGTH, mean_size: number = LENGTH, base: number = "cm²") Told
        "heights above the zero of the Map, the smaller and the mean of the sizes along its own axes, its outline";
    area(r: Area = "", map: symbol = "") Told "each Area that lies on a Map";
    standing_in(x: Thing = "", r: Area = "", above_floor: number = LENGTH, below_ceiling: number = LENGTH) Told
        "the Area whose base holds the interior point";
    off_area(x: Thing = "", r: Area = "", distance: number = LENGTH) Told
        "of what is in no Area's base: how far from that of its own";
    over(a: Thing = "", b: Thing = "", part: Part = "of b", roof: symbol = "solid or open", gap: number = LENGTH, share: number = SHARE, centred: number = "0 or 1", lift: number = LENGTH) Told
        "a's foot over a roof of b: foot less roof, share of the foot, whether the centre is over it, foot less the part's middle height";
    below(a: Thing = "", b: Thing = "", part: Part = "of b", base: symbol = "solid or open", gap: number = LENGTH, share: number = SHARE) Told
        "a beneath a part of b: base less a's highest roof there, share of a's outline";
    within(a: Thing = "", b: Thing = "", part: symbol = "of b, or b's Object", opening: symbol = "container, hollow, open top", escape: number = LENGTH, beneath: number = LENGTH, above: number = LENGTH, bulk: number = SHARE, held: number = SHARE) Told
        "a in b, or nearly: how far it sticks out sideways, below, above; its volume as a share of b's; the share of it that is inside";
    distance(a: Thing = "", b: Thing = "", d: number = LENGTH) Either "between surfaces, in space";
    beside(a: Thing = "", b: Thing = "", d: number = LENGTH, level: number = SHARE, facing: number = SHARE) Either
        "distance, common height as a share of the lower, overlap of the sides that they turn to each other";
    between(a: Thing = "", b: Thing = "", c: symbol = "a thing or an Area's wall", share: number = SHARE) Either
        "what stands between two things that are beside each other, and what share of their common height it fills";
    sector(x: Thing = "", anchor: Thing = "", bearing: number = ANGLE, d: number = LENGTH, level: number = SHARE) Told
        "x from the front of the anchor, counter-clockwise";
    #[asked] view(x: Thing = "", anchor: Thing = "", bearing: number = ANGLE, d: number = LENGTH, level: number = SHARE) Told
        "the same from the anchor's side that is turned to the robot";
    opening(o: Opening = "", kind: symbol = "door or passage", width: number = LENGTH, height: number = LENGTH) Told
        "a side of an Area that can be gone through";
    links(o: Opening = "", x: Area = "", y: Area = "") Told "a link of the Map, the lower id first";
    mounts(o: Opening = "", x: Area = "") Told "in whose side the opening is";
    mounted(o: Opening = "", x: Area = "") Told "on a side of which Area its door is mounted";
    step(o: Opening = "", side: symbol = "inward or outward", r: Area = "", distance: number = LENGTH) Told
        "the Area met by stepping off the side";
    door_state(o: Opening = "", status: symbol = "open, closed, locked", open: number = "percent") Told "how a door stands";
    clear_width(o: Opening = "", width: number = LENGTH) Told "what its leaves leave free now";
    robot(width: number = LENGTH, height: number = LENGTH) Told "what the robot needs to pass";
    part(p: Part = "", whole: Any = "", of: symbol = "object or area") Told "the Orthoframes of Objects and Areas";
    part_along(p: Part = "", whole: Any = "", of: symbol = "object or area", axis: symbol = "height, depth, width", low: number = SHARE, high: number = SHARE) Told
        "where a part begins and ends along the whole: upwards, towards the front, towards the left";
    property(x: Any = "", name: symbol = "", value: symbol = "") Told "as the Map has them";
    stands_shut(x: Thing = "") Told "its doors are shut";
    edge_distance(x: Thing = "", r: Area = "", wall: number = "which wall", d: number = LENGTH) Told
        "from a solid side of the Area where it is, in the plan";
    corner(r: Area = "", wall: number = "which wall", next: number = "which wall", turn: number = ANGLE) Told
        "two walls that meet; how far the second turns, inwards positive";
    opening_distance(x: Thing = "", o: Opening = "", d: number = LENGTH) Told
        "from the nearer side of a door or passage, in the plan";
    middle_distance(x: Thing = "", y: Any = "an Area or Thing", d: number = LENGTH) Told
        "from the middle of the Area where it is or of what it is over, in the plan; up to half the narrower side";
    narrow_side(r: Area = "", d: number = LENGTH) Told "the smaller size of an Area along its own axes";
    asked(x: Thing = "", map: symbol = "") Told "of what OUTSIDE is derived";
    #[asked] amid(x: Thing = "", a: Thing = "", b: Thing = "", how: symbol = "way, aside, share", v: number = "0.1 mm or ‰") Told
        "x between a and b in the plan: what it takes of the shortest way from one to the other, how far beside that way it is, the share of it that lies where both are in sight";
    #[asked] before_wall(x: Thing = "", a: Thing = "", r: Area = "", wall: number = "which wall", d: number = LENGTH) Told
        "x in the strip between the whole side of a and a wall; how far a is from it";
    #[asked] shelf(x: Thing = "", kind: symbol = "of the Orthoframe", top: number = LENGTH) Told
        "the parts of a thing, by the heights of their tops";
    #[asked] about_robot(x: Thing = "", ahead: number = LENGTH, left: number = LENGTH, d: number = LENGTH) Told
        "of what is in the robot's Area: how far before it and to its left the middle is, how far away it begins";
    #[asked] faced(x: Thing = "", of: symbol = "a Thing, door or Area", as: symbol = "thing, area, side", ahead: number = LENGTH, left: number = LENGTH, bearing: number = ANGLE, d: number = LENGTH) Told
        "x from the middle of a thing or from where one stands in an Area, for one who faces something; as side, for the thing's own front or the robot";
    #[asked] gaze(p: Spot = "who looks", x: Any = "a Thing, Opening, or the Area of a wall", as: symbol = "thing, leaf, opening, wall", n: number = "which opening or wall", low: number = LENGTH, high: number = LENGTH, turn: number = ANGLE, d: number = LENGTH) Told
        "what lies ahead of who looks from a point: from which to which height above the floor, how far it turns from the straight line, 0 where that meets it, and how far away it is";
    #[asked] spot(p: Spot = "робот, or the number of a point", r: Area = "") Told "the point is on the floor of an Area";
    #[asked] spot_side(p: Spot = "", o: Opening = "", n: number = "which opening", r: Area = "whose side", out: number = LENGTH, thick: number = LENGTH) Told
        "the point is alongside a side of an opening: how far out of it, and how thick the wall is";
    #[asked] spot_opening(p: Spot = "", o: Opening = "", n: number = "which opening", r: Area = "of which it is", d: number = LENGTH) Told
        "to the nearest side of an opening";
    #[asked] spot_thing(p: Spot = "", x: Thing = "", d: number = LENGTH) Told "to a thing, in the plan";
    #[asked] spot_wall(p: Spot = "", r: Area = "", wall: number = "which wall", d: number = LENGTH, way: number = ANGLE) Told
        "to a wall of the Area where it is, and which way that looks outwards";
    #[asked] spot_middle(p: Spot = "", r: Area = "", share: number = SHARE) Told
        "how far from the Area's centroid towards the rim";
    #[on_demand] at(x: Thing = "", r: Area = "whose frame", x_at: number = LENGTH, y_at: number = LENGTH, z_at: number = LENGTH, angle: number = ANGLE) Told
        "where the Map puts a thing, in the frame of its own Area";
    #[on_demand] apart(a: Thing = "", b: Thing = "", d: number = LENGTH) Told
        "from the middle of a to the box round b; needs a reach";
    #[on_demand] robot_at(map: symbol = "", r: Area = "", x_at: number = LENGTH, y_at: number = LENGTH, angle: number = ANGLE) Told
        "where the robot stands now, in the frame of the Map";
    #[on_demand] sees(x: Thing = "") Told "what the robot has in view from there";
    #[on_demand] believed(x: Thing = "", r: Area = "", sure: number = SHARE) Told
        "of what was looked at: where it is believed to be now";
    #[on_demand] carried_by(x: Thing = "", who: symbol = "робот, or a person") Told
        "what was taken up, and who has it now";
}

impl Measured {
    /// As a rule text declares it.
    #[must_use]
    pub fn declaration(&self) -> String {
        format!("{}\n.input {}\n", self.declared(), self.name)
    }

    /// Its `.decl` alone.
    pub(crate) fn declared(&self) -> String {
        let columns = self.columns.iter().map(|(name, kind, _)| format!("{name}: {kind}"));
        let columns: Vec<String> = columns.collect();
        format!(".decl {}({})", self.name, columns.join(", "))
    }
}

/// The table of docs/relations.md.
#[must_use]
pub fn measured_table() -> String {
    let mut text = "| relation | columns | order | what it says |\n|---|---|---|---|\n".to_owned();
    for relation in MEASURED {
        let column = |(name, _, unit): &(&str, &str, &str)| match *unit {
            "" => format!("`{name}`"),
            unit => format!("`{name}` ({unit})"),
        };
        let columns: Vec<String> = relation.columns.iter().map(column).collect();
        let order = match (relation.order, relation.made) {
            (Order::Either, _) => "both",
            (Order::Told, Made::OnDemand) => "as told; on demand",
            (Order::Told, Made::WhenAsked) => "as told; when asked",
            (Order::Told, Made::Always) => "as told",
        };
        let (name, columns) = (relation.name, columns.join(", "));
        let _ = writeln!(text, "| `{name}` | {columns} | {order} | {} |", relation.meaning);
    }
    text
}
