//! From a scenario file to a plan, and from a faulty file to its faults.

use std::path::{Path, PathBuf};

use orthoframe::graphplan::{Limits, Outcome, solve, validate};
use orthoframe::strips::{Scenario, Task};

fn project(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn directives(task: &Task) -> Vec<String> {
    let Outcome::Plan(plan) = solve(task, &Limits::default()) else { panic!("a plan exists") };
    assert_eq!(validate(task, &plan), Ok(()));
    plan.operators().map(|id| task.operator(id).to_string()).collect()
}

#[test]
fn the_papers_scenario_gives_the_papers_directives() {
    let scenario = Scenario::read(&project("rules/scenarios/medicine-walk.strips")).unwrap();
    assert_eq!(
        scenario.map.as_deref(),
        Some(project("rules/scenarios/../../maps/rb2.toml").as_path())
    );
    assert_eq!(
        directives(&scenario.ground().unwrap()),
        [
            "Движение-в_от-места_до-двери_(Комната-В, Точка-А, Дверь-ВZ)",
            "Движение-из_в_через-дверь_(Комната-В, Комната-Z, Дверь-ВZ)",
            "Движение-в_от-двери_до-двери_(Комната-Z, Дверь-ВZ, Дверь-ZY)",
            "Движение-из_в_через-дверь_(Комната-Z, Комната-Y, Дверь-ZY)",
            "Движение-в_от-двери_до-места_(Комната-Y, Дверь-ZY, Точка-К)",
        ]
    );
}
