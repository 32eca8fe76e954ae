//! Every order that reads a file ends, whatever the name stands for: a pipe into which nobody writes, a device without
//! end, a file that is too long.

use std::process::Stdio;
use std::time::{Duration, Instant};

use super::{Place, walk};

const FILE: &str = "named";

/// The orders of the program that read a file which a person names, that file being `{}`.
const READERS: &[&[&str]] = &[
    &["check", "{}"],
    &["import", "{}"],
    &["import", "{}", "--format", "rmf"],
    &["import", "map.toml", "--synonyms", "{}", "--format", "rmf"],
    &["import", "--sqlite", "{}"],
    &["demo", "--map", "{}"],
    &["plan", "{}"],
    &["plan", "--domain", "{}", "--problem", "{}"],
    &["plan", "{walk}", "--check", "{}"],
    &["corridor", "{}", "--from", "A", "--to", "B"],
    &["datalog", "{}"],
    &["datalog", "program.dl"],
    &["datalog", "includes.dl"],
    &["edit", "--file", "{}"],
    &["restore", "{}", "--store", "other"],
    &["relations", "--rules", "rules-of-others"],
    &["relations", "--rules", "more-rules"],
    &["plan", "includes.strips"],
];

/// A place in which `{}` and all that is read besides lead to a file made by `make`.
fn place(make: &dyn Fn(&std::path::Path)) -> Place {
    let place = Place::empty();
    make(&place.path(FILE));
    // A store that is there, so that not its absence is what is refused.
    std::fs::create_dir(place.path("ortho-store")).unwrap();
    let map = std::fs::read_to_string(super::rb2()).unwrap();
    place.write("map.toml", map);
    place.write("program.dl", ".decl a(x: symbol)\n.input a(filename=\"named\")\n");
    place.write("includes.dl", ".include \"named\"\n");
    place.write("includes.strips", "Включить: named\n");
    for (dir, file) in [("rules-of-others", "relations.dl"), ("more-rules", "mine.dl")] {
        std::fs::create_dir(place.path(dir)).unwrap();
        std::os::unix::fs::symlink(place.path(FILE), place.path(dir).join(file)).unwrap();
    }
    place
}

/// Runs every reader at once; each must refuse, saying why, in good time.
fn all_refuse(make: &dyn Fn(&std::path::Path)) {
    let places: Vec<Place> = READERS.iter().map(|_| place(make)).collect();
    let (begin, walk) = (Instant::now(), walk());
    let mut running: Vec<_> = places
        .iter()
        .zip(READERS)
        .map(|(place, args)| {
            let of = |arg: &&'static str| match *arg {
                "{}" => FILE.to_owned(),
                "{walk}" => walk.clone(),
                other => other.to_owned(),
            };
            let args: Vec<String> = args.iter().map(of).collect();
            let shown: Vec<&str> = args.iter().map(String::as_str).collect();
            let mut command = place.command(&shown);
            command.stdout(Stdio::piped()).stderr(Stdio::piped());
            (args, command.spawn().expect("ortho starts"))
        })
        .collect();
    while running.iter_mut().any(|(_, child)| child.try_wait().unwrap().is_none()) {
        if begin.elapsed() > Duration::from_secs(120) {
            let hung: Vec<_> = running
                .iter_mut()
                .filter_map(|(args, child)| {
                    let runs = child.try_wait().unwrap().is_none();
                    child.kill().unwrap();
                    runs.then(|| args.join(" "))
                })
                .collect();
            panic!("these never end: {hung:#?}");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    for (args, child) in running {
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {said}");
        assert!(!said.contains("panicked"), "{args:?}: {said}");
        // What is too long is told by its length.
        let names = [FILE, "relations.dl", "mine.dl", "предел"];
        assert!(names.iter().any(|name| said.contains(name)), "{args:?}: {said}");
    }
}

#[test]
fn a_pipe_into_which_nobody_writes_is_not_waited_for() {
    all_refuse(&|path| {
        let made = std::process::Command::new("mkfifo").arg(path).status().unwrap();
        assert!(made.success());
    });
}

#[test]
fn a_device_without_end_is_refused() {
    all_refuse(&|path| std::os::unix::fs::symlink("/dev/zero", path).unwrap());
}

#[test]
fn a_file_that_is_too_long_is_refused_before_it_is_read() {
    all_refuse(&|path| {
        // It takes no room on the disk.
        std::fs::File::create(path).unwrap().set_len(8 << 30).unwrap();
    });
}

#[test]
fn what_comes_through_a_pipe_is_read() {
    let place = Place::empty();
    let pipe = place.path("map.toml");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let writer = std::thread::spawn(move || std::fs::copy(super::rb2(), pipe).unwrap());
    place.run(&["check", "map.toml"]).is(0);
    writer.join().unwrap();
}

/// One line or many, any notation: a map is known as one.
#[test]
fn a_map_on_one_line_is_a_map_for_an_import_too() {
    let place = Place::with_rb2();
    place.run(&["export", "map.json"]).is(0);
    let map: serde_json::Value =
        serde_json::from_slice(&std::fs::read(place.path("map.json")).unwrap()).unwrap();
    place.write("one.json", map.to_string());
    place.write("two.json", format!("\n{{\n\"format\"\n:{}", &map.to_string()[10..]));
    let mut turned = map.as_object().unwrap().clone();
    let format = turned.shift_remove("format").unwrap();
    turned.insert("format".into(), format);
    place.write("last.json", serde_json::Value::Object(turned).to_string());
    place.write("nameless", map.to_string());
    #[cfg(feature = "sqlite")]
    place.run(&["export", "--sqlite", "tables.db"]).is(0);
    let tables = if cfg!(feature = "sqlite") { "tables.db" } else { "map.json" };
    for name in ["map.json", "one.json", "two.json", "last.json", "nameless", tables] {
        let run = place.run(&["import", name, "--store", "other"]).is(0);
        assert!(run.out.contains("РБ-2"), "{name}: {}", run.out);
    }
}

/// A disk without room is the machine's fault, a name that leads nowhere the person's; whatever the order.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_no_wrong_input() {
    let place = Place::with_rb2();
    for args in [
        &["as-of", "1", "--out", "{}"][..],
        &["export", "{}"],
        &["export", "--geojson", "{}"],
        &["draw", "map", "--out", "{}"],
    ] {
        for (file, code) in [("/dev/full", 3), ("no/such/folder/file.svg", 2)] {
            let args: Vec<&str> = args.iter().map(|a| if *a == "{}" { file } else { a }).collect();
            place.run(&args).is(code);
        }
    }
}
