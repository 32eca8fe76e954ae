//! What holds for every command: settings, colours, what is told of the inside; what a shell and `man` are told; watching.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::files::project;

/// The program in a folder of its own, with nothing set.
fn ortho(folder: &Path) -> Command {
    let mut command = crate::ortho();
    command.current_dir(folder).env("HOME", folder);
    for name in ["XDG_CONFIG_HOME", "ORTHO_LANG", "ORTHO_STORE", "ORTHO_CONFIG", "ORTHO_USER"] {
        command.env_remove(name);
    }
    for name in ["LC_ALL", "LC_MESSAGES", "LANG", "NO_COLOR"] {
        command.env_remove(name);
    }
    command
}

fn told(output: &Output) -> (String, String, Option<i32>) {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (text(&output.stdout), text(&output.stderr), output.status.code())
}

fn run(folder: &Path, arguments: &[&str]) -> (String, String, Option<i32>) {
    told(&ortho(folder).args(arguments).output().unwrap())
}

#[test]
fn an_argument_counts_before_the_environment_and_that_before_the_settings() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let map = project("maps/lab.toml").display().to_string();
    std::fs::create_dir(here.join("conf")).unwrap();
    std::fs::write(
        here.join("conf/ortho.toml"),
        "language = \"en\"\nstore = \"kept\"\nuser = \"anna\"\n",
    )
    .unwrap();
    let with = ["--config", "conf/ortho.toml"];
    let (out, err, code) = run(here, &[&with[..], &["import", &map]].concat());
    assert_eq!(code, Some(0), "{err}");
    assert!(out.contains("Revision 1"), "{out}");
    // Paths count from the folder of the settings.
    assert!(here.join("conf/kept").is_dir() && !here.join("ortho-store").exists());
    let (out, ..) = run(here, &[&with[..], &["history"]].concat());
    assert!(out.contains("anna"), "{out}");
    let (out, ..) = run(here, &[&with[..], &["--lang", "ru", "where"]].concat());
    assert!(out.starts_with("Я нахожусь"), "{out}");
    let in_environment =
        told(&ortho(here).args(with).arg("where").env("ORTHO_LANG", "ru").output().unwrap());
    assert!(in_environment.0.starts_with("Я нахожусь"), "{in_environment:?}");
    let (out, ..) = run(here, &[&with[..], &["where"]].concat());
    assert!(out.starts_with("I am"), "{out}");
    // Without a name: that of this folder, else the user's own.
    let (out, ..) = run(&here.join("conf"), &["where"]);
    assert!(out.starts_with("I am"), "{out}");
    std::fs::create_dir_all(here.join(".config/ortho")).unwrap();
    std::fs::rename(here.join("conf/ortho.toml"), here.join(".config/ortho/ortho.toml")).unwrap();
    let (_, err, code) = run(here, &["where"]);
    assert!(
        code == Some(2) && err.contains("kept"),
        "the store of the settings is not there: {err}"
    );
}

#[test]
fn lengths_are_in_the_unit_of_the_settings_and_in_centimetres_for_programs() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let (_, err, code) = run(here, &["import", &project("maps/rb2.toml").display().to_string()]);
    assert_eq!(code, Some(0), "{err}");
    let way = |from: &str, to: &str| run(here, &["route", "--from", from, "--to", to]).0;
    let (usual, place) = (way("225,380", "70,60"), run(here, &["where", "--at", "225,380"]).0);
    assert!(usual.contains("Точки, см: (225.0, 380.0)"), "{usual}");
    let json = run(here, &["--json", "route", "--from", "225,380", "--to", "70,60"]).0;

    assert_eq!(way("2.25m,3800mm", "70cm,60"), usual);
    std::fs::write(here.join("ortho.toml"), "units = \"m\"\n").unwrap();
    assert_eq!(run(here, &["where", "--at", "2.25,3.8"]).0, place);
    let told = way("2.25,3.8", "0.7,0.6");
    assert!(told.contains("Точки, м: (2.250, 3.800)"), "{told}");
    assert_eq!(run(here, &["--json", "route", "--from", "2.25,3.8", "--to", "0.7,0.6"]).0, json);
    let centimetres = ["--units", "cm", "route", "--from", "225,380", "--to", "70,60"];
    assert_eq!(run(here, &centimetres).0, usual);
}

/// The numbers of a text, and what stands between them.
fn numbers(text: &str) -> (Vec<f64>, Vec<&str>) {
    let is_of_number = |c: char| c.is_ascii_digit() || c == '.' || c == ',';
    let between = text.split(|c: char| c.is_ascii_digit()).map(|b| b.trim_matches([',', '.']));
    let digits = text.split(|c: char| !is_of_number(c)).map(|n| n.trim_matches([',', '.']));
    let numbers = digits.filter_map(|n| n.replace(',', ".").parse().ok());
    (numbers.collect(), between.filter(|b| !b.is_empty()).collect())
}

/// A text whose moments are taken out: two runs are not at the same time.
fn without_moments(text: &str) -> String {
    const MOMENT: usize = "2026-11-21 09:30:00".len();
    let mut parts: Vec<&str> = text.split(" UTC").collect();
    let last = parts.pop().unwrap_or_default();
    parts.iter().map(|part| &part[..part.len() - MOMENT]).chain([last]).collect()
}

/// Every command that tells lengths or is given them, with these in brackets, in cm: told in metres it says the same of the
/// same, and leaves the same behind.
#[test]
fn metres_are_understood_and_told_by_every_command() {
    let commands = [
        "find|Чашка-1",
        "observe|Чашка-1|--at|[40,50]|--when|2040-11-28T09:00Z",
        "observe|Чашка-2|--pose|[120,60]|--when|2040-11-28T09:00Z",
        "find|Чашка-1|--at|2040-11-28T09:01Z",
        "proposals",
        "find|Чашка-2|--story",
        "edit|move|Стул-1|--by|[15,0]",
        "edit|move|Кресло-1|--to|[100,100]|--dry-run",
        "edit|place|Стул-9|--object|chair|--area|Комната-В|--at|[100,100]|--dry-run",
        "edit|point|Точка-Ж|--area|Комната-В|--at|[100,120]",
        "edit|move|Точка-Ж|--to|[110,120]",
        "edit|zone|Зона-Ж|--kind|slow|--map|Квартира РБ-2|--points|[0,0] [100,0] [100,100]|--speed|30",
        "edit|orthoframe|k|--rect|[40,30]|--height|[70]",
        "edit|item|lid|--of|chair|--orthoframe|k|--at|[0,0,50]|--dry-run",
        "diff|1|2",
        "diff|2|6",
        "where|--at|[225,380,]90",
        "where|--at|[9900,9900]",
        "route|--from|[225,380]|--to|[70,60]",
        "route|--from|[225,380]|--to|[9900,60]",
        "relations|--of|Чашка-1",
        "ask|Как далеко Чашка-1 от Стола-1?",
        "ask|Какого размера Стол-1?",
        "ask|How big is the Table 1?",
        "ask|Почему Чашка-1 рядом с Чашкой-2?",
        "do|Поезжай в точку ([100; 120])",
        "do|Поезжай в точку ([9900; 120])",
        "do|Drive to the point ([100, 120])",
        "do|Положи чашку-1 в точку ([100; 120])",
    ];
    let stores = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let [cm, m] = [stores[0].path(), stores[1].path()];
    std::fs::write(m.join("ortho.toml"), "units = \"m\"\n").unwrap();
    for here in [cm, m] {
        let (_, err, code) =
            run(here, &["import", &project("maps/rb2.toml").display().to_string()]);
        assert_eq!(code, Some(0), "{err}");
    }
    let mut converted = 0;
    for command in commands {
        let said = |in_metres: bool| -> Vec<String> {
            let mut words = String::new();
            for (n, part) in command.split(['[', ']']).enumerate() {
                let number = |text: &str| match text.trim().parse::<f64>() {
                    Ok(length) if in_metres => {
                        text.replace(text.trim(), &(length / 100.0).to_string())
                    }
                    _ => text.to_owned(),
                };
                let lengths =
                    |by: char| part.split(by).map(number).collect::<Vec<_>>().join(&by.to_string());
                words.push_str(&match n % 2 {
                    0 => part.to_owned(),
                    _ => lengths(if part.contains(';') { ';' } else { ',' }),
                });
            }
            words.split('|').map(str::to_owned).collect()
        };
        let told = [(cm, false), (m, true)].map(|(here, in_metres)| {
            let words = said(in_metres);
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            let (out, err, code) = run(here, &words);
            (without_moments(&(out + &err)), code)
        });
        let [(in_cm, code), (in_m, same_code)] = &told;
        assert_eq!(code, same_code, "{command}: {in_cm}\n{in_m}");
        assert!(!in_m.contains(" см") && !in_m.contains(" cm"), "{command}: {in_m}");
        let as_metres = in_cm.replace(" см", " м").replace(" cm", " m");
        // What was said is told again.
        let ((lengths, between), (metres, same)) = (numbers(&as_metres), numbers(in_m));
        assert_eq!(between, same, "{command}: {in_cm}\n{in_m}");
        assert_eq!(lengths.len(), metres.len(), "{command}: {in_cm}\n{in_m}");
        for (length, metre) in lengths.iter().zip(&metres) {
            let is_same = (length - metre).abs() < 1e-9;
            assert!(
                is_same || (length / 100.0 - metre).abs() < 0.0051,
                "{command}: {in_cm}\n{in_m}"
            );
            converted += usize::from(!is_same);
        }
    }
    assert!(converted > 40, "{converted}");
    // Corners are told as they are given, with commas between.
    let moved = ["edit", "zone", "Зона-Ж", "--dry-run", "--points", "0,0 1.5,0 1.5,1"];
    let (told, ..) = run(m, &moved);
    assert!(told.contains("«0,0 1,0 1,1» → «0,0 1.5,0 1.5,1»"), "{told}");
    let [left, same] = [cm, m].map(|here| {
        [
            "find|Чашка-1|--at|2040-11-28T09:01Z",
            "find|Чашка-2|--at|2040-11-28T09:01Z",
            "relations|--of|Стул-1",
            "diff|2|6",
            "where",
        ]
        .map(|command| {
            run(here, &[&command.split('|').collect::<Vec<_>>()[..], &["--json"]].concat()).0
        })
    });
    assert_eq!(left, same);
}

#[test]
fn faulty_settings_are_refused_with_their_place() {
    let folder = tempfile::tempdir().unwrap();
    for (text, line, word) in [
        ("language = \"en\"\ncolour = \"never\"\n", 2, "colour"),
        ("language = \"fr\"\n", 1, "fr"),
        ("store = 3\n", 1, "3"),
        ("units = \"feet\"\n", 1, "feet"),
        ("vehicle = \"pigeon\"\n", 1, "cmd:"),
        ("store = \"\n", 1, ""),
    ] {
        std::fs::write(folder.path().join("ortho.toml"), text).unwrap();
        let (out, _, code) = run(folder.path(), &["--json", "where"]);
        let view: serde_json::Value = serde_json::from_str(&out).unwrap();
        let fault = &view["errors"][0];
        assert_eq!((code, &fault["line"]), (Some(2), &line.into()), "{text}: {view}");
        assert!(fault["message"].as_str().unwrap().contains(word), "{text}: {view}");
    }
    let (_, err, code) = run(folder.path(), &["--config", "none.toml", "where"]);
    assert!(code == Some(2) && err.contains("none.toml"), "{err}");
}

#[test]
fn a_robot_of_the_settings_drives_and_yields_to_the_simulator() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let (map, cart) = (project("maps/rb2.toml"), project("examples/vehicle.py"));
    let (_, err, code) = run(here, &["import", &map.display().to_string()]);
    assert_eq!(code, Some(0), "{err}");
    let vehicle = format!("cmd:python3 '{}' --map 'Квартира РБ-2' --at 120,85,90", cart.display());
    std::fs::write(here.join("ortho.toml"), format!("vehicle = {vehicle:?}\n")).unwrap();
    let (_, err, code) = run(here, &["do", "Поезжай к Точке-К"]);
    assert_eq!(code, Some(0), "{err}");
    std::fs::write(here.join("ortho.toml"), "vehicle = \"tcp:127.0.0.1:1\"\n").unwrap();
    let (_, err, code) = run(here, &["do", "Поезжай к Точке-А"]);
    assert!(code == Some(3), "nobody is there: {err}");
    for more in [&["--vehicle", "simulator"][..], &["--senses", "7"]] {
        let (_, err, code) = run(here, &[&["do", "Поезжай к Точке-А"], more].concat());
        assert_eq!(code, Some(0), "{more:?}: {err}");
    }
}

#[test]
fn colours_are_as_they_are_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let faulty = ["check", "none.toml"];
    let is_coloured = |command: &mut Command| told(&command.output().unwrap()).1.contains('\u{1b}');
    assert!(!is_coloured(ortho(folder.path()).args(faulty)), "it is no terminal");
    let mut always = ortho(folder.path());
    assert!(is_coloured(always.args(faulty).args(["--color", "always"])));
    let mut no = ortho(folder.path());
    assert!(is_coloured(no.args(faulty).args(["--color", "always"]).env("NO_COLOR", "1")));
    assert!(!is_coloured(ortho(folder.path()).args(faulty).args(["--color", "never"])));
    std::fs::write(folder.path().join("ortho.toml"), "color = \"always\"\n").unwrap();
    assert!(is_coloured(ortho(folder.path()).args(faulty)));
}

/// Help, faults of arguments, of settings and of what is done, and what is done inside.
#[test]
fn whatever_is_told_is_coloured_as_it_is_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("faulty.toml"), "colour = 1\n").unwrap();
    let (_, err, code) = run(here, &["import", &project("maps/rb2.toml").display().to_string()]);
    assert_eq!(code, Some(0), "{err}");
    for told in [
        &["--help"][..],
        &["edit", "place", "--help"],
        &["help", "route"],
        &["route", "--form", "x"],
        &["where", "--detail", "all"],
        &[],
        &["find", "nothing"],
        &["where", "-v"],
        &["where", "--config", "faulty.toml"],
    ] {
        let is_coloured = |more: &[&str], no_color: &str| {
            let mut command = ortho(here);
            let output = command.args(more).args(told).env("NO_COLOR", no_color).output().unwrap();
            [output.stdout, output.stderr].concat().contains(&0x1b)
        };
        std::fs::write(here.join("ortho.toml"), "").unwrap();
        assert!(!is_coloured(&[], ""), "{told:?}: it is no terminal");
        assert!(!is_coloured(&["--color", "auto"], "1"), "{told:?}");
        assert!(is_coloured(&["--color", "always"], "1"), "{told:?}");
        assert!(is_coloured(&["--color=always"], ""), "{told:?}");
        std::fs::write(here.join("ortho.toml"), "color = \"always\"\n").unwrap();
        let is_of_these_settings = !told.contains(&"--config");
        assert_eq!(is_coloured(&[], ""), is_of_these_settings, "{told:?}: settings");
        assert!(!is_coloured(&["--color", "never"], ""), "{told:?}: an argument goes before");
    }
}

/// On a terminal (util-linux's script) there are colours, unless NO_COLOR is set.
#[test]
fn a_terminal_is_coloured_unless_no_color_is_set() {
    let folder = tempfile::tempdir().unwrap();
    for told in ["--help", "route --form x", "check none.toml"] {
        let is_coloured = |no_color: &str| {
            let ortho = ortho(folder.path());
            let line = format!("'{}' {told}", ortho.get_program().display());
            let mut terminal = Command::new("script");
            terminal.args(["-qec", &line, "/dev/null"]).current_dir(folder.path());
            terminal.env("TERM", "xterm").env("NO_COLOR", no_color).env("HOME", folder.path());
            let output = terminal.stdin(Stdio::null()).output().ok()?;
            // What takes the sign of waiting away is no colour.
            Some(
                String::from_utf8_lossy(&output.stdout).replace("\u{1b}[2K", "").contains('\u{1b}'),
            )
        };
        let Some(usually) = is_coloured("") else {
            assert!(std::env::var_os("CI").is_none(), "script is missing");
            return;
        };
        assert!(usually, "{told}");
        assert_eq!(is_coloured("1"), Some(false), "{told}");
    }
}

#[test]
fn what_is_done_inside_is_told_when_it_is_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let map = project("maps/lab.toml").display().to_string();
    run(folder.path(), &["import", &map]);
    let route = ["route", "--from", "Charger", "--to", "Lab"];
    let (out, quiet, code) = run(folder.path(), &route);
    assert_eq!((quiet.as_str(), code), ("", Some(0)), "{out}");
    let (same, told, _) = run(folder.path(), &[&route[..], &["-v"]].concat());
    assert_eq!(same, out);
    for word in ["relations", "floors", "ms="] {
        assert!(told.contains(word), "{told}");
    }
}

#[test]
fn shells_and_man_know_every_command() {
    let folder = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish"] {
        let (script, _, code) = run(folder.path(), &["completions", shell]);
        assert_eq!(code, Some(0));
        for command in ["import", "relations", "watch", "language-server"] {
            assert!(script.contains(command), "{shell}: {command}");
        }
    }
    // Bash itself takes it and completes.
    let (script, ..) = run(folder.path(), &["completions", "bash"]);
    let file = folder.path().join("ortho.bash");
    std::fs::write(&file, script).unwrap();
    let asked = "source ./ortho.bash; COMP_WORDS=(ortho rel); COMP_CWORD=1; _ortho ortho rel ortho; echo \"${COMPREPLY[@]}\"";
    let bash = Command::new("bash").args(["-c", asked]).current_dir(folder.path()).output();
    assert_eq!(String::from_utf8_lossy(&bash.unwrap().stdout).trim(), "relations");
    let (written, _, code) = run(folder.path(), &["man", "pages"]);
    assert_eq!(code, Some(0));
    assert!(written.lines().count() > 30, "{written}");
    for page in ["ortho.1", "ortho-import.1", "ortho-watch.1"] {
        let text = std::fs::read_to_string(folder.path().join("pages").join(page)).unwrap();
        assert!(text.contains(".TH") && text.contains(".SH NAME"), "{page}");
    }
}

#[test]
fn a_map_is_checked_and_drawn_again_when_it_changes() {
    let folder = tempfile::tempdir().unwrap();
    let (map, drawing) = (folder.path().join("lab.toml"), folder.path().join("lab.svg"));
    std::fs::copy(project("maps/lab.toml"), &map).unwrap();
    let mut command = ortho(folder.path());
    command
        .args(["--lang", "en", "watch", "lab.toml"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut out = BufReader::new(child.stdout.take().unwrap()).lines();
    let mut err = BufReader::new(child.stderr.take().unwrap()).lines();
    assert!(out.next().unwrap().unwrap().contains("lab.svg"));
    let first = std::fs::read_to_string(&drawing).unwrap();
    let sound = std::fs::read_to_string(&map).unwrap();
    // An editor puts another file in its place.
    let put = |text: &str| {
        let beside = folder.path().join("new");
        std::fs::write(&beside, text).unwrap();
        std::fs::rename(&beside, &map).unwrap();
    };
    put(&sound.replace("Charger", "Dock"));
    assert!(out.next().unwrap().unwrap().contains("lab.svg"));
    let second = std::fs::read_to_string(&drawing).unwrap();
    assert!(second != first && second.contains("Dock"));
    put("format = ");
    let fault = err.by_ref().map_while(Result::ok).find(|line| line.contains("lab.toml:1"));
    assert!(fault.is_some());
    assert_eq!(std::fs::read_to_string(&drawing).unwrap(), second, "what was sound stays");
    put(&sound);
    assert!(out.next().unwrap().unwrap().contains("lab.svg"));
    // SIGINT ends it in good order.
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(child.wait().unwrap().success());
}

#[test]
fn what_takes_long_shows_a_sign_on_a_terminal_and_nowhere_else() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    // It never ends by itself, so it lasts as long on every machine.
    let endless = ".decl n(x: number)\nn(0).\nn(x + 1) :- n(x), x < 1000000000.\n";
    std::fs::write(here.join("endless.dl"), endless).unwrap();
    let arguments = ["--lang", "en", "datalog", "endless.dl", "--time-limit", "2"];
    let (out, err, code) = run(here, &arguments);
    assert_eq!((out.as_str(), code), ("", Some(2)), "{err}");
    assert!(!err.contains("working"), "{err}");

    let ortho = ortho(here);
    let line = format!("'{}' {}", ortho.get_program().display(), arguments.join(" "));
    // A terminal by util-linux's script.
    let mut terminal = Command::new("script");
    terminal.args(["-qec", &line, "/dev/null"]).current_dir(here);
    let Ok(told) = terminal.stdin(Stdio::null()).output() else {
        assert!(std::env::var_os("CI").is_none(), "script is missing");
        return;
    };
    let told = String::from_utf8_lossy(&told.stdout).into_owned();
    let (signs, fault) = told.rsplit_once("\u{1b}[2K").expect("the sign is wiped away");
    assert!(signs.contains("working, 1s"), "{told}");
    assert!(!fault.contains("working") && fault.contains("facts::time"), "{told}");
}
