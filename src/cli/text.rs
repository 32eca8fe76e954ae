//! Engine values as text for a person.

use comfy_table::presets::UTF8_BORDERS_ONLY;
use comfy_table::{CellAlignment, ContentArrangement, Table};

use crate::engine::{Relations, Replanned, RouteAnswer, Solved, World, no_way_in_words};
use crate::facts::Value;
use crate::geometry::FloorPlan;
use crate::graphplan::Outcome;
use crate::language::Language;
use crate::language::names::english_name;
use crate::language::words::english;
use crate::map::Entity;
use crate::strips::{Broken, OperatorId, Replayed, RuleFault, RuleFaults, Said, Wording};
use crate::units::{English, capitalized};

use super::args::Lang;

impl Lang {
    pub(super) fn pick<'a>(self, russian: &'a str, english: &'a str) -> &'a str {
        match self {
            Self::Ru => russian,
            Self::En => english,
        }
    }

    pub(super) fn language(self) -> Language {
        match self {
            Self::Ru => Language::Russian,
            Self::En => Language::English,
        }
    }
}

/// How often each relation holds.
pub(super) fn counts(relations: &Relations, lang: Lang) -> String {
    let mut table = table();
    table.set_header([
        lang.pick("Отношение", "Russian name"),
        "English name",
        lang.pick("Число", "Count"),
    ]);
    for row in relations.counts() {
        table.add_row([row.name, row.name_en, row.count.to_string()]);
    }
    if let Some(column) = table.column_mut(2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}

fn table() -> Table {
    let mut table = Table::new();
    table.load_style(UTF8_BORDERS_ONLY).set_content_arrangement(ContentArrangement::Disabled);
    table
}

/// Facts, one a line: `Чашка-1 НАХОДИТСЯ_СВЕРХУ_НА Стол-1`.
pub(super) fn facts(rows: &[(String, Vec<Value>)]) -> String {
    rows.iter().map(|(relation, values)| fact(relation, values)).collect::<Vec<_>>().join("\n")
}

fn fact(relation: &str, values: &[Value]) -> String {
    let words: Vec<String> = values.iter().map(ToString::to_string).collect();
    match &words[..] {
        [x, y] => format!("{x}  {relation}  {y}"),
        [x, property, value] => format!("{x}  {relation}  {property} = {value}"),
        _ => format!("{relation}({})", words.join(", ")),
    }
}

/// A plan as the paper prints it, one directive a line, parallel ones under one number; by the phrases of the rules
/// where they have any in the language.
pub(super) fn plan(solved: &Solved, wording: &Wording<'_>) -> String {
    let directive = |id: &OperatorId| wording.action(&Said::from(solved.task.operator(*id)));
    let steps = solved.outcome.plan().map_or_else(Vec::new, |plan| {
        plan.steps.iter().map(|step| step.iter().map(directive).collect()).collect()
    });
    plan_of(solved, &steps, wording)
}

/// A plan, its directives given in words.
pub(super) fn plan_of(solved: &Solved, steps: &[Vec<String>], wording: &Wording<'_>) -> String {
    let pick = |russian, english| wording.language.pick(russian, english);
    // What was given up before it began knows no plan, and one of no steps would be an answer.
    let is_found = match solved.outcome {
        Outcome::Plan(_) => true,
        Outcome::NoPlan { .. } => false,
        Outcome::LimitReached(_) => !steps.is_empty(),
    };
    if !is_found {
        let head = match solved.outcome {
            Outcome::LimitReached(_) => pick("План не найден", "No plan was found"),
            _ => pick("Плана нет, и это доказано", "There is no plan; this is proven"),
        };
        return format!("{head}: {}", solved.explanation_with(wording).unwrap_or_default());
    }
    if steps.is_empty() {
        return pick("Цель уже достигнута.", "The goal holds already.").to_owned();
    }
    let actions: usize = steps.iter().map(Vec::len).sum();
    let is_proven = solved.is_shortest && matches!(solved.outcome, Outcome::Plan(_));
    let proof = match is_proven {
        true => pick("меньше шагов нельзя, это доказано", "fewer steps are proven impossible"),
        false => pick("что он кратчайший, не доказано", "not proven to be the shortest"),
    };
    let mut text = wording.language.pick(
        format!("План: шагов {}, действий {actions}; {proof}.", steps.len()),
        format!("Plan: {}; {proof}.", english_size(steps.len(), actions)),
    );
    for (number, step) in steps.iter().enumerate() {
        for (i, action) in step.iter().enumerate() {
            let label = if i == 0 { format!("{}.", number + 1) } else { String::new() };
            text.push_str(&format!("\n{label:>4} {action}"));
        }
    }
    if let (Outcome::LimitReached(_), Some(known)) =
        (&solved.outcome, solved.explanation_with(wording))
    {
        let head = pick("Это не ответ до конца: ", "This is no full answer: ");
        text.push_str(&format!("\n{head}{known}"));
    }
    if !solved.assumptions.is_empty() {
        let head = pick("Предположения, на которых он держится:", "It rests on the assumptions:");
        let told = solved.assumptions_with(wording).join("\n     ");
        text.push_str(&format!("\n{head}\n     {told}"));
    }
    text
}

/// What was withdrawn, whether the plan before rested on it, and the plan now.
pub(super) fn replanned(replanned: &Replanned, wording: &Wording<'_>) -> String {
    let mut told: Vec<String> = replanned.withdrawn.iter().map(|f| wording.fact(f)).collect();
    told.dedup();
    let withdrawn = told.join(wording.language.pick(", ", "; "));
    let before = match (&replanned.before.outcome, replanned.rested_on()) {
        (Outcome::Plan(_), true) => {
            wording.language.pick("прежний план на этом держался", "the plan before rested on this")
        }
        (Outcome::Plan(_), false) => wording
            .language
            .pick("прежний план на этом не держался", "the plan before did not rest on this"),
        _ => wording.language.pick("плана не было и прежде", "there was no plan before either"),
    };
    let head = wording.language.pick("Отозвано", "Withdrawn");
    format!("{head}: {withdrawn} – {before}.\n{}", plan(&replanned.after, wording))
}

/// "1 step, 2 actions"
pub(super) fn english_size(steps: usize, actions: usize) -> String {
    let count = |number: usize, noun| english::count(number as u64, noun);
    format!("{}, {}", count(steps, "step"), count(actions, "action"))
}

/// A plan carried out: every step that could be, and where it breaks.
pub(super) fn replayed(replayed: &Replayed, lang: Lang) -> String {
    let mut text = String::new();
    for (step, directives) in &replayed.steps {
        for (i, directive) in directives.iter().enumerate() {
            let label = if i == 0 { format!("{step}:") } else { String::new() };
            text.push_str(&format!("{label:>5} {directive}\n"));
        }
    }
    let actions: usize = replayed.steps.iter().map(|(_, directives)| directives.len()).sum();
    let (steps, cost) = (replayed.steps.len(), replayed.cost);
    let verdict = match (&replayed.broken, lang) {
        (None, Lang::Ru) => {
            format!("План верен: шагов {steps}, действий {actions}, стоимость {cost}.")
        }
        (None, Lang::En) => {
            format!("The plan works: {}, cost {cost}.", english_size(steps, actions))
        }
        (Some(Broken { step: Some(step), faults }), Lang::Ru) => {
            format!("План обрывается на шаге {step}:{}", reasons(faults, lang))
        }
        (Some(Broken { step: Some(step), faults }), Lang::En) => {
            format!("The plan breaks at step {step}:{}", reasons(faults, lang))
        }
        (Some(Broken { step: None, faults }), Lang::Ru) => {
            format!("План выполним, но цели не достигает:{}", reasons(faults, lang))
        }
        (Some(Broken { step: None, faults }), Lang::En) => {
            format!("The plan can be carried out, but misses its goal:{}", reasons(faults, lang))
        }
    };
    text + &verdict
}

fn reasons(faults: &RuleFaults, lang: Lang) -> String {
    let told = |fault: &RuleFault| match lang {
        Lang::Ru => format!("\n      {fault}"),
        Lang::En => format!("\n      {}", English(fault)),
    };
    faults.0.iter().map(told).collect()
}

/// A way in words: through which rooms and doors, how long, and where it bends.
pub(super) fn route(world: &World, floor: &FloorPlan, answer: &RouteAnswer, lang: Lang) -> String {
    let route = match &answer.route {
        Ok(route) => route,
        Err(why) => {
            let why = no_way_in_words(world, why, lang.language()) + ".";
            return match lang {
                Lang::Ru => format!("Пути нет: {why}"),
                Lang::En => capitalized(&why),
            };
        }
    };
    let name = |entity: Entity| match lang {
        Lang::En if !english_name(world, entity).is_empty() => english_name(world, entity),
        _ => world.name(entity),
    };
    let mut stages = String::new();
    for stage in &answer.stages {
        stages.push_str(name(Entity::Area(stage.area)));
        if let Some(door) = stage.leaves_by.and_then(|d| floor.doorways()[d].door) {
            stages.push_str(&format!(" → {} → ", name(Entity::Door(door))));
        } else if stage.leaves_by.is_some() {
            stages.push_str(" → ");
        }
    }
    let meters = route.length / 100.0;
    let mut text = match lang {
        Lang::Ru => {
            format!("{} → {}: {}\n{stages}", answer.from, answer.to, decimal(meters, "м", lang))
        }
        Lang::En => {
            format!("{} → {}: {}\n{stages}", answer.from, answer.to, decimal(meters, "m", lang))
        }
    };
    let frames: Vec<String> = answer.chain.iter().map(|(_, id)| id.to_string()).collect();
    text.push_str(&format!("\n{} {}", lang.pick("Пассфреймы:", "Passframes:"), frames.join(" → ")));
    let points: Vec<String> =
        route.points.iter().map(|p| format!("({:.1}, {:.1})", p.x, p.y)).collect();
    text.push_str(&format!("\n{} {}", lang.pick("Точки, см:", "Points, cm:"), points.join(" → ")));
    for (moved, what) in [
        (&route.moved_start, lang.pick("Начало", "The start")),
        (&route.moved_goal, lang.pick("Цель", "The goal")),
    ] {
        if let Some(moved) = moved {
            let to = format!("({:.1}, {:.1})", moved.to.x, moved.to.y);
            text.push_str(&match lang {
                Lang::Ru => {
                    format!("\n{what} занято: робот там не помещается; взято ближайшее место {to}.")
                }
                Lang::En => format!(
                    "\n{what} is taken: the robot does not fit there; the nearest place is {to}."
                ),
            });
        }
    }
    text
}

/// A number with one decimal, its mark as the language has it.
pub(super) fn decimal(value: f64, unit: &str, lang: Lang) -> String {
    let text = format!("{value:.1} {unit}");
    if lang == Lang::Ru { text.replacen('.', ",", 1) } else { text }
}
