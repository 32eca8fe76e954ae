//! `ortho corridor` and `ortho draw corridor`: directions by counting entrances.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::corridor::{CorridorSystem, Directions, Measure, Variant, directions, figure};
use crate::draw::{
    CorridorArc, CorridorDrawing, CorridorMark, CorridorSign, CorridorVertex, corridor_svg,
};
use crate::engine::{Engine, Error, json, read_map};
use crate::units::{Piece, Source, told, word};

use super::args::{Common, Lang};
use super::fault::Failure;
use super::opened::{open, rules_dir};
use super::{Answer, say};

#[derive(Debug, Args)]
pub(super) struct CorridorArgs {
    /// Corridor file (TOML), e.g. maps/corridor-paper4.toml; the store's maps when it and --map are left out
    pub file: Option<PathBuf>,
    /// A map of the store, or a map file
    #[arg(long, conflicts_with = "file", value_name = "MAP")]
    pub map: Option<String>,
    /// Room where the robot stands, or #N for a vertex
    #[arg(long, value_name = "ROOM")]
    pub from: String,
    /// The arc driven last, by its vertices; without it the heading is unknown
    #[arg(long, value_name = "N,N", value_parser = parse_arc)]
    pub last: Option<(u32, u32)>,
    /// Room to go to
    #[arg(long, value_name = "ROOM")]
    pub to: String,
    /// The paper's first or second road graph
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=2))]
    pub variant: u8,
    /// Count metres instead of arcs, where the map knows them
    #[arg(long)]
    pub metres: bool,
}

fn parse_arc(text: &str) -> Result<(u32, u32), String> {
    let numbers: Vec<u32> = text
        .split(',')
        .map(|n| n.trim().parse::<u32>().map_err(|e| format!("{n}: {e}")))
        .collect::<Result<_, _>>()?;
    match numbers[..] {
        [from, to] => Ok((from, to)),
        _ => Err("two vertex numbers are wanted, such as 1,0".to_owned()),
    }
}

pub(super) fn run(common: &Common, args: &CorridorArgs) -> Result<Answer, Failure> {
    let (_, way) = solve(common, args)?;
    if common.json {
        return say(&json::directions(&way).to_string());
    }
    if way.steps.is_empty() {
        return say(&told!(common.lang.language(), "there-already"));
    }
    let mut lines = Vec::new();
    for (i, step) in way.steps.iter().enumerate() {
        lines.push(format!(
            "{:>3}. {}",
            i + 1,
            if common.lang == Lang::Ru { &step.ru } else { &step.en }
        ));
    }
    let sentences = if common.lang == Lang::Ru { &way.ru } else { &way.en };
    say(&format!("{}\n\n{}", lines.join("\n"), sentences.join("\n")))
}

/// The road graph of the storey on which the way lies, with the way in red.
pub(super) fn draw(common: &Common, args: &CorridorArgs) -> Result<String, Failure> {
    let (system, way) = solve(common, args)?;
    let figure = figure(&system, way.variant, &way.path).map_err(Error::from)?;
    let vertices = figure.vertices.into_iter().map(|v| CorridorVertex {
        at: v.at,
        mark: if v.is_junction { CorridorMark::Junction } else { CorridorMark::Entrance },
        label: v.label,
        name: v.name,
        name_towards: v.name_towards,
    });
    let arcs = figure.arcs.into_iter().map(|a| CorridorArc {
        from: a.from,
        to: a.to,
        label: a.label,
        on_way: a.on_way,
        faint: a.is_u_turn,
    });
    let name = match common.lang {
        Lang::En if !system.name_en.is_empty() => &system.name_en,
        _ => &system.name,
    };
    let floor = match figure.floor.as_str() {
        "" => String::new(),
        floor if floor == system.name => String::new(),
        floor => format!(", {floor}"),
    };
    let title =
        told!(common.lang.language(), "variant", name, floor, number = way.variant.number());
    let notes = if common.lang == Lang::Ru { way.ru } else { way.en };
    let told = |word: Piece| word.say(common.lang.language()).into_owned();
    let arcs: Vec<CorridorArc> = arcs.collect();
    // In the second variant an arc has commands, not a code.
    let has_codes = arcs.iter().any(|arc| !arc.label.is_empty());
    let sign = |&(sign, word): &(CorridorSign, Piece)| {
        (sign, told(if sign == CorridorSign::Arc && !has_codes { PLAIN_ARC } else { word }))
    };
    Ok(corridor_svg(&CorridorDrawing {
        title,
        vertices: vertices.collect(),
        arcs,
        codes: CODES.iter().map(|(code, word)| (code.to_string(), told(*word))).collect(),
        signs: SIGNS.iter().map(sign).collect(),
        notes,
    }))
}

/// The codes of paper 4, table 1, in words, and those beyond it.
const CODES: [(u8, Piece); 10] = [
    (1, word!("code-crossing")),
    (2, word!("code-t-junction")),
    (3, word!("code-branch-right")),
    (4, word!("code-branch-left")),
    (5, word!("code-turn-right")),
    (6, word!("code-turn-left")),
    (7, word!("code-star")),
    (11, word!("code-door-right")),
    (12, word!("code-door-left")),
    (13, word!("code-door-ahead")),
];

const SIGNS: [(CorridorSign, Piece); 5] = [
    (CorridorSign::Entrance, word!("sign-entrance")),
    (CorridorSign::Junction, word!("sign-junction")),
    (CorridorSign::Arc, word!("sign-arc")),
    (CorridorSign::Way, word!("sign-way")),
    (CorridorSign::UTurn, word!("sign-u-turn")),
];

const PLAIN_ARC: Piece = word!("sign-plain-arc");

fn solve(common: &Common, args: &CorridorArgs) -> Result<(CorridorSystem, Directions), Failure> {
    let mut system = match (&args.file, &args.map) {
        (Some(file), _) => read(file)?,
        (None, Some(map)) if Path::new(map).is_file() => {
            let (world, _) = read_map(Path::new(map))?;
            let engine = Engine::in_memory(world, rules_dir(common).as_deref())?;
            engine.corridors(None)?
        }
        (None, map) => {
            let engine = open(common)?;
            let map = map.as_ref().map(|map| engine.map_named(Some(map))).transpose()?;
            engine.corridors(map)?
        }
    };
    if args.metres {
        system.weights.measure = Measure::Metres;
    }
    let variant = Variant::numbered(args.variant).unwrap_or_default();
    let way = directions(&system, &args.from, args.last, &args.to, variant).map_err(Error::from)?;
    Ok((system, way))
}

fn read(file: &Path) -> Result<CorridorSystem, Failure> {
    let source = Source::read(file).map_err(|fault| Failure::file(file, &fault.into_io()))?;
    Ok(CorridorSystem::from_toml(&source).map_err(Error::from)?)
}
