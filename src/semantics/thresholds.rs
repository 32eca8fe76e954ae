//! The thresholds of the rule text, with their units: the one place where code reads them.
//!
//! `rules/relations.dl` holds every number that decides whether something is so, as `limit(profile, name, value)`;
//! rules read it as `threshold(name, value)`, code as a field of [`Thresholds`]. The table below names each, its unit,
//! what it is where a rule text does not say it, and how far measuring looks for it. A rule text that lacks one gets
//! the value of the table, rules and code alike; one whose value cannot be meant is refused with its place.
//!
//! **Invariant:** the standard text says of every name what the table says; a test holds it.

use miette::SourceSpan;

use crate::facts::{Program, Value};
use crate::map::Profile;
use crate::units::{Bilingual, Fault, InOrder as _, Piece, Source, said, word};

/// What a number of the rule text counts, and what it may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Tenths of a millimetre there, cm here; up to 100 m, within which is all that a room knows.
    Length,
    /// Hundredths of a degree there, degrees here; up to half a turn.
    Angle,
    /// Thousandths there, a share of one here.
    Share,
    /// A number of times.
    Times,
    /// Millionths of a steradian there, steradians here: how large something looks.
    Solid,
}

impl Unit {
    /// How many of the rule text's units make one of those of code.
    fn scale(self) -> f64 {
        match self {
            Self::Length | Self::Angle => 100.0,
            Self::Share => 1000.0,
            Self::Times => 1.0,
            Self::Solid => 1_000_000.0,
        }
    }

    fn range(self) -> (i64, i64) {
        match self {
            Self::Length => (0, 1_000_000),
            Self::Angle => (0, 18_000),
            Self::Share => (0, 1_000),
            Self::Times => (1, 1_000),
            Self::Solid => (0, 12_566_370),
        }
    }

    fn words(self) -> Piece {
        match self {
            Self::Length => word!("a-length-in-tenths-of-a-millimetre"),
            Self::Angle => word!("an-angle-in-hundredths-of-a-degree"),
            Self::Share => {
                word!("a-share-in-thousandths-from-0-to")
            }
            Self::Times => word!("a-number-of-times-from-1-to"),
            Self::Solid => word!("a-solid-angle-in-millionths-of-a"),
        }
    }

    fn told(self) -> Bilingual {
        said!("it-is", what = self.words())
    }
}

/// One name of the table.
#[derive(Debug, Clone, Copy)]
pub struct Known {
    pub name: &'static str,
    pub unit: Unit,
    /// Of the profile «common», in the rule text's unit.
    pub standard: i64,
    /// The name of the `reach` that must look as far as the threshold does.
    pub(super) reach: Option<&'static str>,
}

macro_rules! thresholds {
    ($($(#[$doc:meta])* $field:ident = $name:literal, $unit:ident, $standard:literal $(, $reach:literal)?;)+) => {
        /// The thresholds of one profile: lengths in cm, angles in degrees, shares of one.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct Thresholds {
            $($(#[$doc])* pub $field: f64,)+
        }

        /// All names that the program knows.
        pub const KNOWN: &[Known] = &[$(Known {
            name: $name,
            unit: Unit::$unit,
            standard: $standard,
            reach: thresholds!(@reach $($reach)?),
        },)+];

        impl Default for Thresholds {
            fn default() -> Self {
                Self { $($field: f64::from($standard) / Unit::$unit.scale(),)+ }
            }
        }

        impl Thresholds {
            fn set(&mut self, name: &str, value: i64) {
                match name {
                    $($name => {
                        let (least, most) = Unit::$unit.range();
                        self.$field = value.clamp(least, most) as f64 / Unit::$unit.scale();
                    })+
                    // Of the user's own rules.
                    _ => {}
                }
            }
        }
    };
    (@reach) => { None };
    (@reach $reach:literal) => { Some($reach) };
}

thresholds! {
    support_gap_up = "support gap up", Length, 600;
    support_gap_down = "support gap down", Length, 600, "sink";
    support_share = "support share", Share, 500;
    support_cover = "support cover", Share, 900;
    overlap_share = "overlap share", Share, 200;
    inside_slack = "inside slack", Length, 500, "escape";
    inside_held = "inside held", Share, 500;
    inside_open_held = "inside open held", Share, 300;
    floor_gap = "floor gap", Length, 800;
    wall_reach = "wall reach", Length, 3000, "outside";
    next_level = "next level", Share, 333;
    next_divisor = "next divisor", Times, 4;
    next_least = "next least", Length, 3000, "beside";
    next_most = "next most", Length, 6000, "beside";
    between_share = "between share", Share, 250;
    facing_share = "facing share", Share, 500;
    close_distance = "close distance", Length, 13000, "distance";
    sector_half = "sector half", Angle, 4500;
    sector_distance = "sector distance", Length, 20000, "sector";
    lean_gap = "lean gap", Length, 500, "beside";
    lean_level = "lean level", Share, 500;
    slender_times = "slender times", Times, 3;
    step_distance = "step distance", Length, 6000, "step";
    part_edge = "part edge", Share, 10;
    part_middle = "part middle", Share, 500;
    belief_told = "belief told", Share, 500;
    /// An obstacle of which the robot is less sure counts no more.
    belief_reckoned = "belief reckoned", Share, 250;
    /// So sure the robot is of what it did or touched itself.
    belief_own = "belief own", Share, 950;

    /// What stands this near to a solid side of its room stands at the wall.
    wall_gap = "wall gap", Length, 3000, "edge";
    /// Both walls of a corner are this near to what stands in it.
    corner_gap = "corner gap", Length, 5000, "edge";
    /// Two walls make a corner when they turn by more than this, and by less than what is left of half a turn.
    corner_turn = "corner turn", Angle, 3000;
    /// What hangs on a wall is this near to it.
    hanging_gap = "hanging gap", Length, 800, "edge";
    /// What is this near to a door, a window or a point is at it.
    door_gap = "door gap", Length, 10000, "opening";
    /// Furniture this near to other furniture stands at it, whatever their sizes: a chair at a table.
    furniture_gap = "furniture gap", Length, 6000, "distance";
    /// In the middle: no farther from the middle than this share of the narrower side.
    middle_share = "middle share", Share, 250;

    /// What is between two things fills so much of the shortest way from one to the other,
    between_way = "between way", Length, 100;
    /// or is so near beside that way,
    between_aside = "between aside", Length, 1500;
    /// or lies with such a share of itself where both see each other.
    between_amid = "between amid", Share, 500;
    /// So far from a wall a thing may stand that people speak of what is between them.
    before_wall = "before wall", Length, 15000;
    /// A door or window this near to the line of a wall is in it: as thick as walls are.
    wall_line = "wall line", Length, 3000;
    /// What stands on a part sinks into it by no more; parts nearer in height are one level.
    level_sunk = "level sunk", Length, 300;
    /// Heights that differ by less are equal.
    level_equal = "level equal", Length, 100;
    /// Things that reach farther into one another sidewards cannot both stand there.
    overlap_depth = "overlap depth", Length, 100;
    /// What hangs from the ceiling is this near to it.
    ceiling_gap = "ceiling gap", Length, 1600;
    /// A room less wide than this was written in metres,
    least_room = "least room", Length, 1000;
    /// and so was one less high,
    least_ceiling = "least ceiling", Length, 1500;
    /// a door less wide or high,
    least_door = "least door", Length, 500;
    /// and furniture smaller every way.
    least_furniture = "least furniture", Length, 1000;
    /// So was a robot's radius of less,
    least_radius = "least radius", Length, 200;
    /// its height,
    least_height = "least height", Length, 250;
    /// and its speed, in a second.
    least_speed = "least speed", Length, 250;
    /// A doorway reaches so deep into each of its rooms: what stands there bars it.
    doorway_depth = "doorway depth", Length, 1000;
    /// What is thinner and no furniture is a cloth or a mat: what lies on it is on what is under it, too.
    covering_thick = "covering thick", Length, 200;
    /// What is nearer to a thing touches it: of no distance is spoken.
    touch_gap = "touch gap", Length, 100;
    /// Of a top with a smaller share free people say that it has no room.
    top_free = "top free", Share, 50;
    /// The highest roofs of a thing are its top where they have this share of its largest roof; else that is.
    top_share = "top share", Share, 500;
    /// Rooms lie one over the other where they share more of the smaller floor than this: walls of two storeys that do
    /// not quite meet share less.
    storey_share = "storey share", Share, 50;
    /// A storey this deep under the ground is a cellar and has no number.
    cellar_depth = "cellar depth", Length, 5000;

    /// Ahead of one who faces something is what is so near to the line of sight; beyond it, things are aside.
    view_ahead = "view ahead", Angle, 1500;
    /// Beyond this angle things are behind him.
    view_behind = "view behind", Angle, 12000;
    /// What is so near to straight ahead of a thing is rather on neither side of it.
    view_aside = "view aside", Length, 500;

    /// In a doorway: this near to the line of the door, or within the thickness of its wall.
    robot_doorway = "robot doorway", Length, 1500;
    /// The robot's middle is this near to a door at which it stands,
    robot_door = "robot door", Length, 13000;
    /// to a thing beside which it stands,
    robot_thing = "robot thing", Length, 7000;
    /// to the walls by which it stands.
    robot_wall = "robot wall", Length, 7000;
    /// In the middle: within the Area's outline shrunk to this share about its centroid, no wall being near.
    robot_middle = "robot middle", Share, 400;
    /// It faces what is this near along its heading,
    robot_facing = "robot facing", Length, 25000;
    /// turns from that by no more,
    robot_facing_turn = "robot facing turn", Angle, 0;
    /// and is higher than this: one steps over the rest.
    robot_low = "robot low", Length, 1000;
    /// A thing of the next room that reaches no farther through the wall still stands behind it.
    robot_through = "robot through", Length, 500;
    /// Around it, before, behind and beside it, is what is this near.
    robot_around = "robot around", Length, 40000;
    /// This near to a place of the map it is at that.
    robot_place = "robot place", Length, 3000;
    /// So far it sees,
    robot_sight = "robot sight", Length, 40000;
    /// and so wide: as a wide camera does.
    robot_field = "robot field", Angle, 12000;
    /// What looks smaller it does not make out: a matchbox at six metres.
    robot_speck = "robot speck", Solid, 20;
    /// Sent to one side of a thing, it stands so far from the thing's edge.
    robot_aside = "robot aside", Length, 3000;
    /// Sent to a point of the floor, it stands no farther from it than this, or is not sent.
    robot_spot = "robot spot", Length, 6000;
    /// Unknown things that it saw with their middles so near to one another are one.
    robot_same = "robot same", Length, 4000;
    /// What it met so near to where a lost thing stood is that thing.
    robot_lost = "robot lost", Length, 6000;
    /// Something unknown that moved no farther between two looks stands there; what moved may go away of itself.
    robot_still = "robot still", Length, 1500;
    /// Who may be waiting for the robot to pass is left so much room.
    robot_room = "robot room", Length, 15000;
    /// A way passes what stands this near to it,
    way_beside = "way beside", Length, 13000;
    /// and turns at what stands this near to its bend.
    way_bend = "way bend", Length, 11000;
    /// Nearer to the straight way than this a bend is none.
    way_jog = "way jog", Length, 3500;
    /// What is moved oftener than this is no landmark.
    way_landmark = "way landmark", Share, 500;
    /// So far before and behind an opening a way is looked at to see whether it turns there.
    way_through = "way through", Length, 5000;
    /// A shorter stretch passes nothing worth a word.
    way_told = "way told", Length, 6000;
    /// A way shorter than this is none: one is there.
    way_none = "way none", Length, 1000;
    /// Ways whose lengths differ by less are equally long.
    way_equal = "way equal", Length, 100;
    /// What is so near to the direction of a push names it: «towards the window».
    push_toward = "push toward", Angle, 2500;
    /// Nobody pushes furniture farther than this for a robot.
    push_farthest = "push farthest", Length, 12000;
    /// Of what lies on a room with no more than a square of this side nobody speaks.
    zone_patch = "zone patch", Length, 1000;

    /// The walls of a corridor converge by no more than this.
    corridor_parallel = "corridor parallel", Angle, 574;
    /// A shorter stretch between walls is a niche,
    corridor_shortest = "corridor shortest", Length, 12000;
    /// and so is one that is less than so many times as long as wide.
    corridor_slender = "corridor slender", Share, 700;
    /// Along so much of a corridor there are walls on both sides; the rest are mouths of branches.
    corridor_covered = "corridor covered", Share, 350;
    /// Facing walls that are shorter than this share of what lies between them are the ends of something long.
    corridor_stub = "corridor stub", Share, 250;
    /// Two corridors that meet at no more than this angle are one with a bend.
    corridor_bend = "corridor bend", Angle, 3000;
    /// A branch goes on between walls for more than this beyond its junction.
    corridor_arm = "corridor arm", Length, 8000;
    /// A door is straight ahead at the end of a corridor that is no farther from that end,
    corridor_ahead = "corridor ahead", Length, 6000;
    /// no farther beside its middle than this share of its width,
    corridor_aside = "corridor aside", Share, 600;
    /// and turned towards it by no more than this off.
    corridor_askew = "corridor askew", Angle, 4557;

    /// Up to here one goes straight on,
    turn_straight = "turn straight", Angle, 2500;
    /// up to here one bears left or right,
    turn_slight = "turn slight", Angle, 5500;
    /// and from here on one turns round.
    turn_round = "turn round", Angle, 15000;
    /// A turn that is told in degrees is one right round from here on.
    turn_about = "turn about", Angle, 17500;
}

/// What is wrong with one `limit` or `reach` of a rule text.
#[derive(Debug, Clone, Fault)]
#[fault(code = "semantics::threshold")]
pub struct ThresholdFault {
    pub(super) message: Bilingual,
    pub(super) help: Bilingual,
    #[source_code]
    text: Source,
    at: SourceSpan,
}

impl ThresholdFault {
    /// Line and character column, both from 1.
    #[must_use]
    pub fn position(&self) -> (usize, usize) {
        self.text.position(self.at.offset())
    }
}

/// One `limit` that stands in a text.
struct Limit<'p> {
    profile: String,
    name: String,
    value: i64,
    source: &'p Source,
    at: SourceSpan,
}

fn limits(program: &Program) -> Vec<Limit<'_>> {
    let Some(relation) = program.relation("limit") else { return Vec::new() };
    let limit = |(values, source, at): (Vec<Value>, _, _)| match &values[..] {
        [Value::Symbol(profile), Value::Symbol(name), Value::Number(value)] => {
            let (profile, name) = (profile.to_string(), name.to_string());
            Some(Limit { profile, name, value: *value, source, at })
        }
        _ => None,
    };
    program.written(relation).filter_map(limit).collect()
}

/// All that is wrong with the thresholds and reaches of a rule text.
pub(super) fn faults(program: &Program) -> Vec<ThresholdFault> {
    let mut faults = Vec::new();
    let limits = limits(program);
    for (n, limit) in limits.iter().enumerate() {
        let Limit { name, value, source, at, profile } = limit;
        let mut fault = |message, help| {
            faults.push(ThresholdFault { message, help, text: (*source).clone(), at: *at });
        };
        if !["common", "surveyed", "detected"].contains(&profile.as_str()) {
            let message = said!("there-is-no-profile", profile);
            let help = word!("there-are-common-surveyed-and-detected");
            fault(message, help.into());
        }
        let Some(known) = KNOWN.iter().find(|known| known.name == name) else { continue };
        let (least, most) = known.unit.range();
        if !(least..=most).contains(value) {
            let message = said!("the-threshold-cannot-be", name, value);
            fault(message, known.unit.told());
        }
        let same = |other: &&Limit<'_>| other.profile == *profile && other.name == *name;
        if let Some(first) = limits[..n].iter().find(same).filter(|first| first.value != *value) {
            let (line, _) = first.source.position(first.at.offset());
            let place = format!("{}:{line}", first.source.name());
            let message =
                said!("the-threshold-is-given-twice-and", name, first = first.value, value);
            fault(message, said!("keep-one-here-or", place));
        }
    }
    let reaches = program.relation("reach").map(|relation| program.written(relation));
    for (values, source, at) in reaches.into_iter().flatten() {
        let [Value::Symbol(name), Value::Number(value)] = &values[..] else { continue };
        let (least, most) = Unit::Length.range();
        if !(least..=most).contains(value) {
            let message = said!("the-limit-of-measuring-cannot-be", name, value);
            let help = Unit::Length.told();
            faults.push(ThresholdFault { message, help, text: source.clone(), at });
        }
    }
    faults
}

/// The facts that a rule text lacks, as a text; empty where it names every threshold, or none at all.
pub(super) fn lacking(program: &Program) -> String {
    let limits = limits(program);
    if limits.is_empty() {
        return String::new();
    }
    let lacks = |known: &&Known| limits.iter().all(|limit| limit.name != known.name);
    let line =
        |known: &Known| format!("limit(\"common\", \"{}\", {}).\n", known.name, known.standard);
    KNOWN.iter().filter(lacks).map(line).collect()
}

/// The farthest that any profile's thresholds of a reach look.
pub(super) fn farthest(program: &Program, reach: &str) -> i64 {
    let limits = limits(program);
    let of_reach = |name: &str| KNOWN.iter().any(|k| k.name == name && k.reach == Some(reach));
    let own = limits.iter().filter(|limit| of_reach(&limit.name)).map(|limit| limit.value);
    own.max().unwrap_or(0)
}

/// The greatest that any profile has of a threshold, in the rule text's unit; as the table has it where none names it.
pub(super) fn greatest(program: &Program, name: &str) -> i64 {
    let limits = limits(program);
    let own = limits.iter().filter(|limit| limit.name == name).map(|limit| limit.value);
    let standard = || KNOWN.iter().find(|known| known.name == name).map(|known| known.standard);
    own.max().or_else(standard).unwrap_or(0)
}

impl Thresholds {
    /// As the facts of a rule text say for a profile.
    pub(super) fn written(program: &Program, profile: Profile) -> Self {
        let limits = limits(program);
        let mut found = Self::default();
        for wanted in ["common", profile.name()] {
            let own = limits.iter().filter(|limit| limit.profile == wanted);
            own.for_each(|limit| found.set(&limit.name, limit.value));
        }
        found
    }

    /// As `threshold(name, value)` says; what it does not say is as the table has it. Where rules derive several
    /// values of one name, the greatest counts.
    pub(super) fn of(told: impl Iterator<Item = (String, i64)>) -> Self {
        let mut all: Vec<(String, i64)> = told.collect();
        all.order();
        let mut found = Self::default();
        all.iter().for_each(|(name, value)| found.set(name, *value));
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::STANDARD;

    fn program(text: &str) -> Program {
        Program::parse(&Source::new("правила.dl", text)).expect("it is sound")
    }

    #[test]
    fn the_standard_text_names_every_threshold_as_the_table_does() {
        let program = program(&STANDARD);
        assert_eq!(lacking(&program), "");
        assert!(faults(&program).is_empty());
        let limits = limits(&program);
        for known in KNOWN {
            let common = limits.iter().find(|l| l.profile == "common" && l.name == known.name);
            assert_eq!(common.map(|l| l.value), Some(known.standard), "{}", known.name);
        }
        let unknown = limits.iter().find(|l| KNOWN.iter().all(|known| known.name != l.name));
        assert!(unknown.is_none(), "{}", unknown.map_or("", |l| &l.name));
    }

    /// Maps are read, and openings measured, where no rules are at hand.
    #[test]
    fn a_step_reaches_through_the_thickest_wall() {
        let known = KNOWN.iter().find(|known| known.name == "step distance");
        let cm = known.map(|known| known.standard as f64 / known.unit.scale());
        assert_eq!(cm, Some(crate::geometry::STEP_REACH));
    }

    #[test]
    fn what_cannot_be_meant_is_told_with_its_place() {
        let text = r#".decl limit(p: symbol, n: symbol, v: number) .output limit
.decl reach(n: symbol, v: number) .output reach
limit("common", "wall gap", -1).
  limit("common", "inside held", 5000). limit("common", "sector half", 18001).
limit("surveyed", "next divisor", 0). limit("survyed", "next most", 1).
limit("common", "floor gap", 1). limit("common", "floor gap", 2). limit("detected", "floor gap", 3).
limit("common", "own", -5).
reach("edge", 10000000)."#;
        let told: String = faults(&program(text))
            .iter()
            .map(|f| {
                let (line, column) = f.position();
                format!("{line}:{column} {f}; {}\n", f.help)
            })
            .collect();
        expect_test::expect![[r#"
            3:1 порог «wall gap» не может быть -1; это длина в десятых долях миллиметра, от 0 до 1000000 (100 м)
            4:3 порог «inside held» не может быть 5000; это доля в тысячных, от 0 до 1000
            4:41 порог «sector half» не может быть 18001; это угол в сотых долях градуса, от 0 до 18000
            5:1 порог «next divisor» не может быть 0; это число раз, от 1 до 1000
            5:39 нет профиля «survyed»; бывают common, surveyed и detected
            6:34 порог «floor gap» назван дважды: 1 и 2; оставьте один: здесь или правила.dl:6
            8:1 предел измерения «edge» не может быть 10000000; это длина в десятых долях миллиметра, от 0 до 1000000 (100 м)
        "#]]
        .assert_eq(&told);
    }
}
