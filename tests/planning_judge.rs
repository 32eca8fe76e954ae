//! Every plan that the tests make stands before a judge that shares no code with the planner, by the rules as they are given.

use std::path::Path;

use orthoframe_graphplan::Plan;
use orthoframe_strips::{PlanText, Task};

#[path = "../src/graphplan/judges/judge.rs"]
mod judge;

pub(crate) use judge::Texts;
use judge::{Verdict, judge};

/// Whether the judge reads the texts; by those that it reads the plan works.
pub(crate) fn stands(texts: &Texts, task: &Task, plan: &Plan) -> bool {
    let (mut task, mut steps) = (task.clone(), plan.steps.clone());
    task.choose_disjunct(&mut steps);
    let text = PlanText::write(&task, &steps);
    match judge(texts, &text) {
        Verdict::Works => true,
        Verdict::Fails(why) => panic!("{why}\n{text}\n{texts:?}"),
        Verdict::Unread(_) => false,
    }
}

/// A rule file, with what the files that it includes say in their places.
pub(crate) fn whole(path: &Path) -> String {
    let included = |line: &str| {
        let line = line.trim_start();
        line.strip_prefix("Включить:").or_else(|| line.strip_prefix("Include:")).map(str::to_owned)
    };
    let line = |line: &str| match included(line) {
        Some(included) => whole(&path.with_file_name(included.trim())),
        None => line.to_owned(),
    };
    let text = std::fs::read_to_string(path).expect("the rules can be read");
    text.lines().map(|text| line(text) + "\n").collect()
}
