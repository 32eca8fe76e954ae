//! What README.md shows is what the program does.

use std::os::unix::fs::symlink;

use super::{Place, project};

const README: &str = include_str!("../../README.md");

/// Command lines and what is shown below each, of all fences that show a terminal.
fn shown() -> Vec<(Vec<String>, String)> {
    let fences = README.split("```text\n").skip(1);
    let terminals = fences.map(|rest| rest.split("```").next().expect("a piece"));
    let runs = terminals.flat_map(|text| text.split("$ ortho ").skip(1));
    runs.map(|run| {
        let (line, output) = run.split_once('\n').expect("a command has a line of its own");
        // The one argument with spaces stands between quotes.
        let words = line.split('"').enumerate().flat_map(|(k, part)| match k % 2 {
            0 => part.split_whitespace().map(str::to_owned).collect(),
            _ => vec![part.to_owned()],
        });
        (words.collect(), output.trim().to_owned())
    })
    .collect()
}

#[test]
fn the_tour_is_as_it_is_shown() {
    let place = Place::empty();
    for folder in ["maps", "rules"] {
        symlink(project(folder), place.path(folder)).unwrap();
    }
    let map = std::fs::read_to_string(project("maps/rb2.toml")).unwrap();
    place.write("flat.toml", map.replacen(r#"object = "sofa""#, r#"object = "soffa""#, 1));
    let shown = shown();
    assert!(shown.len() > 7);
    for (words, expected) in shown {
        let args: Vec<&str> = words.iter().map(String::as_str).collect();
        let run = place.command(&args).env("ORTHO_LANG", "en").output().unwrap();
        let found = [run.stdout, run.stderr].map(|told| String::from_utf8(told).unwrap()).concat();
        let lines =
            |text: &str| text.trim().lines().map(str::trim_end).collect::<Vec<_>>().join("\n");
        assert_eq!(lines(&found), lines(&expected), "ortho {words:?}");
    }
}

#[test]
fn the_program_of_twenty_lines_is_the_example() {
    let example = include_str!("../../examples/fetch.rs");
    assert!(README.contains(&format!("```rust\n{example}```")));
}
