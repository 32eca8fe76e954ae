//! Readers of foreign building files: what they make of small files of every format, written out as text.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use expect_test::expect_file;
use orthoframe_exchange::{self as exchange, Level, OpeningKind, ReadError, Survey};
use orthoframe_units::Point;

fn golden() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/formats")
}

/// Twice the area over two; m², from cm².
fn square_metres(ring: &[Point]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    let double: f64 = ring.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum();
    double.abs() / 2.0 / 1e4
}

fn at(p: &Point) -> String {
    format!("{:.0},{:.0}", p.x + 0.0, p.y + 0.0)
}

fn opening(what: &OpeningKind) -> String {
    match what {
        OpeningKind::Passage => "проход".to_owned(),
        OpeningKind::Window => "окно".to_owned(),
        OpeningKind::Door { kind, leaves, opens, status, .. } => {
            let leaves: Vec<String> =
                leaves.iter().map(|l| format!("{:?} {}", l.hinge, l.share)).collect();
            format!("дверь {kind:?} [{}] {opens:?} {status:?}", leaves.join(", "))
        }
    }
}

fn level(out: &mut String, survey: &Survey, level: &Level) -> std::fmt::Result {
    writeln!(out, "\nэтаж «{}» ({}) на {} см", level.name, level.source, level.elevation.get())?;
    for room in &level.rooms {
        let height = room.height.map_or_else(|| "?".to_owned(), |h| h.get().to_string());
        let corners: Vec<String> = room.outline.iter().map(at).collect();
        writeln!(
            out,
            "  помещение {} «{}» [{}] {:.1} м², углов {}, дыр {}, высота {height}: {}",
            room.source,
            room.name,
            room.kind,
            square_metres(&room.outline),
            corners.len(),
            room.holes.len(),
            corners.join(" ")
        )?;
    }
    for o in &level.openings {
        let rooms = o.rooms.map(|rooms| {
            let name = |r: Option<usize>| r.map_or("снаружи", |r| &level.rooms[r].source);
            format!("{} – {}", name(rooms[0]), name(rooms[1]))
        });
        let (a, b) = (at(&o.jambs[0]), at(&o.jambs[1]));
        let height = o.height.map_or_else(|| "?".to_owned(), |h| h.get().to_string());
        let what = opening(&o.what);
        let rooms = rooms.unwrap_or_else(|| "?".to_owned());
        writeln!(
            out,
            "  {what} {} «{}» {a} – {b}, высота {height}, низ {}, {rooms}",
            o.source,
            o.name,
            o.sill.get()
        )?;
    }
    for thing in &level.things {
        let kind = &survey.kinds[thing.kind];
        let room = thing.room.map_or("?", |r| &level.rooms[r].source);
        writeln!(
            out,
            "  вещь {} «{}» {} на {} z {} угол {}, в {room}",
            thing.source,
            thing.name,
            kind.source,
            at(&thing.at),
            thing.z.get(),
            thing.angle.get()
        )?;
    }
    for spot in &level.spots {
        let heading = spot.heading.map(|h| h.get());
        writeln!(out, "  точка {} «{}» {} {heading:?}", spot.source, spot.name, at(&spot.at))?;
    }
    Ok(())
}

/// A survey in words.
pub(crate) fn told(survey: &Survey) -> String {
    let mut out = format!("здание «{}»\n", survey.name);
    for l in &survey.levels {
        level(&mut out, survey, l).expect("a string takes all");
    }
    for kind in &survey.kinds {
        let parts: Vec<String> = kind
            .parts
            .iter()
            .map(|p| {
                let corners: Vec<String> = p.outline.iter().map(at).collect();
                format!(
                    "{} ({}..{})",
                    corners.join(" "),
                    p.bottom.get(),
                    p.bottom.get() + p.height.get()
                )
            })
            .collect();
        out += &format!("\nвид {} [{}]: {}", kind.source, kind.word, parts.join("; "));
    }
    for lift in &survey.lifts {
        let stops: Vec<&str> =
            lift.stops.iter().map(|(l, r)| survey.levels[*l].rooms[*r].source.as_str()).collect();
        out += &format!("\nлифт {} «{}»: {}", lift.source, lift.name, stops.join(", "));
    }
    for remark in &survey.remarks {
        out += &format!("\n! {}: {}", remark.source, remark.text);
    }
    for told in &survey.told {
        let (taken, found) = (told.count.taken, told.count.found);
        out += &format!(
            "\n! {:?} {}: {} ({taken} из {found})",
            told.treatment, told.source, told.text
        );
    }
    out + "\n"
}

/// Reads a case: a file `input.*`, or the folder itself.
fn read(case: &Path) -> Result<Survey, ReadError> {
    let files = std::fs::read_dir(case).expect("a case is a folder");
    let mut inputs: Vec<PathBuf> = files.map(|f| f.expect("readable").path()).collect();
    inputs.retain(|p| p.file_stem().is_some_and(|s| s == "input"));
    inputs.sort();
    let Some(input) = inputs.last() else { return exchange::geojson::read_folder(case) };
    let mut source = exchange::file_text(input)?;
    let name = input.file_name().expect("a file has a name").to_string_lossy().into_owned();
    source = orthoframe_units::Source::new(name, source.text());
    match input.extension().and_then(|e| e.to_str()) {
        Some("ifc") => exchange::ifc::read(&source),
        Some("geojson") => exchange::geojson::read(&source),
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_format_tells_the_building_that_it_holds() {
    let mut cases = 0;
    for case in std::fs::read_dir(golden()).expect("golden cases are part of the crate") {
        let case = case.expect("a folder can be read").path();
        let said = read(&case).map_or_else(|e| format!("{e}\n"), |s| told(&s));
        expect_file![case.join("survey.txt")].assert_eq(&said);
        cases += 1;
    }
    assert!(cases >= 5);
}
