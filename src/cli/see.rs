//! `ortho see`: what a robot saw, as segments, things and changes (paper 3).

use std::borrow::Cow;
use std::path::PathBuf;

use clap::Args;
use serde_json::Value;

use crate::Segment;
use crate::engine::{Changes, Sighted, Things, View, decimal, json};
use crate::units::{Lengths, told, word};

use super::args::{Common, Lang};
use super::draw::put_drawing;
use super::fault::Failure;
use super::notes::warn_of_lines;
use super::{Answer, say};

#[derive(Debug, Args)]
pub(super) struct SeeArgs {
    /// A log (CARMEN, rows of ranges, Breezy; also gzipped) or a picture (PNG)
    file: PathBuf,
    /// Which scan of the log, from 1; the first when left out
    #[arg(long, value_name = "N")]
    scan: Option<usize>,
    /// The segments that tell a scan best in no more than so many vertices, a corner counted once
    #[arg(long, value_name = "N", conflicts_with_all = ["models", "against"])]
    vertices: Option<usize>,
    /// Things instead of segments: of the scan named, or of all that tell where they were taken
    #[arg(long)]
    models: bool,
    /// With --models: draw the map as a tree
    #[arg(long, requires = "models")]
    tree: bool,
    /// What changed from the scan to this one
    #[arg(long, value_name = "N", conflicts_with = "models")]
    against: Option<usize>,
    /// Draw into a file, SVG or PNG
    #[arg(long, value_name = "FILE")]
    draw: Option<PathBuf>,
}

/// Value, words and drawing of an answer.
struct Shown {
    value: Value,
    words: String,
    drawing: Option<String>,
}

pub(super) fn run(common: &Common, args: &SeeArgs) -> Result<Answer, Failure> {
    let sighted = Sighted::read(&args.file)?;
    let shown = shown(common, args, &sighted)?;
    if let (Some(path), Some(svg)) = (&args.draw, shown.drawing) {
        put_drawing(svg, path)?;
    }
    let faults = sighted.faults();
    if common.json {
        say(&json::of_log(shown.value, Some(sighted.scans()), faults).to_string())?;
    } else {
        say(&shown.words)?;
        warn_of_lines(&sighted, common.lang);
    }
    // What could be read was shown; lines that could not make the input wrong.
    Ok(if faults.is_some() { Answer::Wrong } else { Answer::Yes })
}

fn shown(common: &Common, args: &SeeArgs, sighted: &Sighted) -> Result<Shown, Failure> {
    let language = common.lang.language();
    let wanted = args.draw.is_some();
    let scan = args.scan.unwrap_or(1);
    if args.models {
        let things = sighted.things(args.scan)?;
        let draw = || if args.tree { things.draw_tree(language) } else { things.draw(language) };
        let drawing = wanted.then(draw);
        let (value, words) = (json::things(&things), tell_things(common, &things));
        return Ok(Shown { value, words, drawing });
    }
    if let Some(against) = args.against {
        let changes = sighted.changes(scan, against)?;
        let drawing = wanted.then(|| changes.draw(language));
        let (value, words) = (json::changes(&changes), tell_changes(common, &changes));
        return Ok(Shown { value, words, drawing });
    }
    let view = sighted.view(scan, args.vertices)?;
    let drawing = wanted.then(|| view.draw(language));
    let words = tell_view(common, &view, sighted.scans());
    Ok(Shown { value: json::view(&view), words, drawing })
}

fn tell_view(common: &Common, view: &View, scans: usize) -> String {
    let lang = common.lang;
    // The points of a picture are its own.
    let lengths = if view.is_picture { Lengths::Cm } else { common.units };
    let (segments, language) = (view.segments.len(), lang.language());
    let head = match view.is_picture {
        true => told!(language, "picture", segments),
        false => {
            let (scan, line, beams, returns) =
                (view.scan, view.line, view.beams, view.returns.len());
            told!(language, "scan-of", scan, scans, line, beams, returns, segments)
        }
    };
    let lines =
        view.segments.iter().enumerate().map(|(k, s)| tell(lang, lengths, k, s, view.is_picture));
    let points = view
        .points
        .iter()
        .map(|p| told!(lang.language(), "thin-at", point = lengths.point(p.x, p.y, 0)));
    std::iter::once(head).chain(lines).chain(points).collect::<Vec<_>>().join("\n")
}

/// A segment: ends, length, what the ends are.
fn tell(lang: Lang, lengths: Lengths, k: usize, segment: &Segment<2>, is_picture: bool) -> String {
    let unit =
        if is_picture { word!("px").say(lang.language()) } else { lengths.word(lang.language()) };
    let length = decimal(lengths.of(segment.length()), &unit, lang.language());
    let (a, b) = (segment.start, segment.end);
    let [first, last] = json::ends(segment).map(|end| called(lang, end));
    format!(
        "{:>3}. {} – {}, {length}: {first} – {last}",
        k + 1,
        lengths.point(a.x, a.y, 0),
        lengths.point(b.x, b.y, 0)
    )
}

fn called(lang: Lang, end: &str) -> Cow<'static, str> {
    let word = match end {
        "corner" => word!("end-corner"),
        "free" => word!("end-free"),
        "given" => word!("end-given"),
        "occluded" => word!("end-occluded"),
        "range" => word!("end-range"),
        "field" => word!("end-field"),
        _ => word!("end-unclear"),
    };
    word.say(lang.language())
}

fn tell_things(common: &Common, things: &Things) -> String {
    let lang = common.lang;
    let lengths = if things.is_picture { Lengths::Cm } else { common.units };
    let all = things.scene.things().len();
    let mut lines =
        vec![told!(lang.language(), "things-joined", things = all, scans = things.views)];
    if things.without_pose > 0 {
        lines.push(told!(
            lang.language(),
            "scans-without-pose",
            without_pose = things.without_pose
        ));
    }
    for (k, thing) in things.scene.things().iter().enumerate() {
        let model = things.scene.seen(k);
        let at = things.scene.frames()[k].translation.vector;
        let whole = model.segments().iter().filter(|s| s.is_whole()).count();
        let (segments, at) = (model.len(), lengths.point(at.x, at.y, 0));
        let id = format!("{:>4}", thing.id.0);
        lines.push(told!(lang.language(), "thing-seen", id, at, segments, whole));
    }
    lines.join("\n")
}

fn tell_changes(common: &Common, changes: &Changes) -> String {
    let (lang, lengths) = (common.lang, common.units);
    let found = &changes.difference;
    let (segments, gone, new) = (found.pairs.len(), found.vanished.len(), found.appeared.len());
    let mut lines = vec![told!(lang.language(), "known-again", segments, gone, new)];
    for part in &found.parts {
        let motion = part.motion.isometry;
        let (shift, turn) = (motion.translation.vector, motion.rotation.angle().to_degrees());
        let (segments, unit) = (part.members.len(), lengths.word(lang.language()));
        let shift = lengths.point(shift.x, shift.y, 1);
        // No turn has no direction.
        let turn = decimal((turn * 10.0).round() / 10.0 + 0.0, "", lang.language());
        let turn = turn.trim_end();
        lines.push(told!(lang.language(), "part-moved", segments, shift, unit = &*unit, turn));
    }
    lines.join("\n")
}
