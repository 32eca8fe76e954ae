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
