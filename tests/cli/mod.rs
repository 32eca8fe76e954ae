//! The program as it is run: answers, exit codes, and what wrong input comes to.

mod assistants;
mod barred;
mod differences;
mod drives;
mod faults;
mod furnished;
mod language_server;
mod languages;
mod lengths;
mod limits;
mod locate;
mod map;
mod plans;
mod readme;
mod rules;
mod see;
mod settings;
mod tasks;
mod words;

use std::path::PathBuf;
use std::process::{Command, Stdio};

use orthoframe_map::World;
use orthoframe_store::Store;
use serde_json::Value;
use tempfile::TempDir;

use crate::files::project;

const AT_THE_DOOR: &str = "Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z.";

/// A working directory of its own, with a store in it.
struct Place {
    dir: TempDir,
}

/// What a run came to.
struct Run {
    code: i32,
    out: String,
    err: String,
}

impl Place {
    fn empty() -> Self {
        Self { dir: tempfile::tempdir().unwrap() }
    }

    fn with_rb2() -> Self {
        let place = Self::empty();
        place.run(&["import", &rb2()]).is(0);
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    fn write(&self, name: &str, text: impl AsRef<[u8]>) -> String {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path.display().to_string()
    }

    fn command(&self, args: &[&str]) -> Command {
        let mut command = crate::ortho();
        command.current_dir(self.dir.path()).args(args).stdin(Stdio::null());
        for name in ["ORTHO_STORE", "ORTHO_RULES", "ORTHO_USER"] {
            command.env_remove(name);
        }
        command
    }

    fn run(&self, args: &[&str]) -> Run {
        let output = self.command(args).output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("ortho writes UTF-8");
        let code = output.status.code().expect("ortho ends by itself");
        let run = Run { code, out: text(output.stdout), err: text(output.stderr) };
        assert!(!run.err.contains("panicked"), "{args:?}: {}", run.err);
        run
    }

    fn json(&self, args: &[&str], code: i32) -> Value {
        let args: Vec<&str> = args.iter().copied().chain(["--json"]).collect();
        let run = self.run(&args).is(code);
        let mut lines = run
            .out
            .lines()
            .map(|line| serde_json::from_str::<Value>(line).expect("one JSON value a line"));
        // What happens on the way of a task stands before its value.
        let value = lines.next_back().expect("a command with --json has a value");
        assert!(lines.all(|event| event["event"].is_string()), "{args:?}: {}", run.out);
        value
    }

    /// What the store holds: its revision and its world.
    fn store(&self) -> Option<(u64, Option<World>)> {
        let dir = self.path("ortho-store");
        let (store, _) = dir.is_dir().then(|| Store::open_read_only(dir).unwrap())?;
        Some((store.revision(), store.world().unwrap()))
    }
}

impl Run {
    #[track_caller]
    fn is(self, code: i32) -> Self {
        assert_eq!(self.code, code, "{}{}", self.out, self.err);
        self
    }
}

fn rb2() -> String {
    project("maps/rb2.toml").display().to_string()
}

fn walk() -> String {
    project("rules/scenarios/medicine-walk.strips").display().to_string()
}
