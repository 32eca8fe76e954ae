//! Directions from where the robot stands to the entrance of a room.

use crate::units::{Language, nearest_name, said, told};

use super::CorridorError;
use super::command::Command;
use super::double::DoubleGraph;
use super::single::SingleGraph;
use super::system::{ArcIx, CorridorSystem, VertexIx};
use super::way::{Position, Way};
use super::weight::in_people_units;

/// Which of the paper's two road graphs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Variant {
    /// One vertex per entrance and junction.
    #[default]
    Single,
    /// Two vertices per entrance.
    Double,
}

impl Variant {
    /// 1 or 2, as the paper numbers them.
    #[must_use]
    pub fn number(self) -> u8 {
        match self {
            Self::Single => 1,
            Self::Double => 2,
        }
    }

    #[must_use]
    pub fn numbered(number: u8) -> Option<Self> {
        [Self::Single, Self::Double].into_iter().find(|v| v.number() == number)
    }
}

/// One command in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Step {
    pub command: Command,
    /// «движение до двери слева»
    pub ru: String,
    /// "drive to the door on the left"
    pub en: String,
}

/// The answer to "how do I get there": plain values with stable names.
#[derive(Debug, Clone, PartialEq)]
pub struct Directions {
    pub variant: Variant,
    pub from_room: Option<String>,
    pub from_vertex: u32,
    /// The arc driven last, by vertex numbers, where it was given.
    pub last: Option<(u32, u32)>,
    pub to_room: String,
    pub to_vertex: u32,
    /// Vertices of the graph on the way, the first and the last included: «1», «2'».
    pub path: Vec<String>,
    /// In arcs or metres, U-turn included.
    pub cost: f64,
    /// Empty when the robot stands at its goal.
    pub steps: Vec<Step>,
    /// The same in sentences, entrances counted.
    pub ru: Vec<String>,
    pub en: Vec<String>,
    /// The arc over which the robot arrives: `last` for the next question. None when nothing moved and no arc was known.
    pub arrived_by: Option<(u32, u32)>,
}

impl Directions {
    #[must_use]
    pub fn commands(&self) -> Vec<Command> {
        self.steps.iter().map(|s| s.command).collect()
    }
}

/// Directions from `from` to `to`: rooms by name or number, or a vertex as `#7`.
///
/// `last` is the arc driven last, by the numbers of its vertices; without it the directions begin with how to
/// stand. A room with several entrances is a goal by its nearest one.
///
/// # Errors
/// Every [`CorridorError`] but those of reading a Map.
pub fn directions(
    system: &CorridorSystem,
    from: &str,
    last: Option<(u32, u32)>,
    to: &str,
    variant: Variant,
) -> Result<Directions, CorridorError> {
    let position = position(system, from, last)?;
    let goals = named(system, to)?;
    if let [only] = *goals
        && system.vertex(only).entrance().is_none()
    {
        return Err(CorridorError::GoalIsJunction { vertex: system.vertex(only).number });
    }
    let way = if goals.contains(&position.vertex) {
        None
    } else {
        let way = match variant {
            Variant::Single => SingleGraph::new(system)?.way(position, &goals),
            Variant::Double => DoubleGraph::new(system)?.way(position, &goals)?,
        };
        Some(way.ok_or_else(|| why_none(system, position, &goals, from, to))?)
    };
    Ok(answer(system, position, way, variant))
}

fn answer(
    system: &CorridorSystem,
    position: Position,
    way: Option<Way>,
    variant: Variant,
) -> Directions {
    let number = |vertex: VertexIx| system.vertex(vertex).number;
    let pair = |arc: ArcIx| (number(system.tail(arc).vertex), number(system.head(arc).vertex));
    let room = |v: VertexIx| system.vertex(v).entrance().map(|e| e.room.clone());
    let arrived_by = way.as_ref().map(|w| w.arrived_by).or(position.last);
    let goal = way.as_ref().map_or(position.vertex, |w| system.head(w.arrived_by).vertex);
    let (commands, path, cost) = match way {
        Some(way) => (way.commands, way.labels, in_people_units(way.cost)),
        None => (Vec::new(), vec![number(goal).to_string()], 0.0),
    };
    let sentences = |language| match Command::sentences(&commands, language) {
        none if none.is_empty() => vec![told!(language, "at-the-goal")],
        some => some,
    };
    let in_words = |&command: &Command| Step {
        command,
        ru: command.russian().into_owned(),
        en: command.english().into_owned(),
    };
    Directions {
        variant,
        from_room: room(position.vertex),
        from_vertex: number(position.vertex),
        last: position.last.map(pair),
        to_room: room(goal).unwrap_or_default(),
        to_vertex: number(goal),
        path,
        cost,
        steps: commands.iter().map(in_words).collect(),
        ru: sentences(Language::Russian),
        en: sentences(Language::English),
        arrived_by: arrived_by.map(pair),
    }
}

/// The position that a person gave.
fn position(
    system: &CorridorSystem,
    from: &str,
    last: Option<(u32, u32)>,
) -> Result<Position, CorridorError> {
    let places = named(system, from)?;
    let Some((tail, head)) = last else {
        let [vertex] = *places else {
            return Err(several(system, from, &places));
        };
        if system.vertex(vertex).entrance().is_none() {
            return Err(CorridorError::HeadingNeeded { vertex: system.vertex(vertex).number });
        }
        return Ok(Position { vertex, last: None });
    };
    let (tail_ix, head_ix) = (numbered(system, tail)?, numbered(system, head)?);
    let arc = system.arc_between(tail_ix, head_ix).ok_or_else(|| {
        let number = |arc| system.vertex(system.head(arc).vertex).number;
        let neighbours = list(system.departures(head_ix).map(number));
        CorridorError::UnknownArc { from: tail, to: head, neighbours }
    })?;
    if places.contains(&head_ix) {
        return Ok(Position { vertex: head_ix, last: Some(arc) });
    }
    let vertex = system.vertex(places[0]).number;
    Err(CorridorError::LastArcElsewhere { vertex, from: tail, to: head })
}

fn several(system: &CorridorSystem, room: &str, places: &[VertexIx]) -> CorridorError {
    let numbers: Vec<u32> = places.iter().map(|&v| system.vertex(v).number).collect();
    CorridorError::SeveralEntrances {
        room: room.to_owned(),
        example: numbers[0],
        vertices: list(numbers.into_iter()),
    }
}

/// The vertices that a person means; at least one.
fn named(system: &CorridorSystem, name: &str) -> Result<Vec<VertexIx>, CorridorError> {
    let found = system.entrances_of(name);
    if !found.is_empty() {
        return Ok(found);
    }
    if let Some(number) = name.trim().strip_prefix('#') {
        let unknown = || unknown_vertex(system, number.to_owned());
        let number: u32 = number.trim().parse().map_err(|_not_a_number| unknown())?;
        return Ok(vec![numbered(system, number)?]);
    }
    let rooms: Vec<&str> = system
        .vertices()
        .filter_map(|(_, v)| v.entrance())
        .map(|entrance| entrance.room.as_str())
        .collect();
    let hint = match nearest_name(name, rooms.iter().copied()) {
        Some(near) => {
            said!("perhaps-2", near)
        }
        None if rooms.is_empty() => {
            said!("the-description-has-no-entrance")
        }
        None => {
            let known = list(rooms.into_iter());
            said!("there-are-entrances", known)
        }
    };
    Err(CorridorError::UnknownRoom { room: name.to_owned(), hint })
}

fn numbered(system: &CorridorSystem, number: u32) -> Result<VertexIx, CorridorError> {
    system.numbered(number).ok_or_else(|| unknown_vertex(system, number.to_string()))
}

fn unknown_vertex(system: &CorridorSystem, vertex: String) -> CorridorError {
    let known = list(system.vertices().map(|(_, v)| v.number));
    CorridorError::UnknownVertex { vertex, known }
}

/// Why no way was found: another floor, or corridors that do not meet.
fn why_none(
    system: &CorridorSystem,
    position: Position,
    goals: &[VertexIx],
    from: &str,
    to: &str,
) -> CorridorError {
    let floor = &system.vertex(position.vertex).floor;
    let other = goals.iter().map(|&g| &system.vertex(g).floor).find(|f| *f != floor);
    let hint = match other {
        Some(other) => said!("is-on-on-a-lift-is-needed", from, floor, to, other),
        None => said!("their-corridors-are-not-joined"),
    };
    CorridorError::Unreachable { from: from.to_owned(), to: to.to_owned(), hint }
}

/// At most a dozen, for people.
fn list(items: impl Iterator<Item = impl ToString>) -> String {
    let mut items: Vec<String> = items.map(|i| i.to_string()).collect();
    items.dedup();
    if items.len() > 12 {
        items.truncate(12);
        items.push("…".to_owned());
    }
    items.join(", ")
}
