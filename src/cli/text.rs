//! Engine values as text for a person.

use comfy_table::presets::UTF8_BORDERS_ONLY;
use comfy_table::{CellAlignment, ContentArrangement, Table};

pub(super) use crate::engine::{counted_in_english as english_size, plan_in_words as plan};

use crate::engine::{Relations, Replanned, RouteAnswer, World, decimal, no_way_in_words};
use crate::geometry::FloorPlan;
use crate::graphplan::Outcome;
use crate::language::names::english_name;
use crate::language::{Language, english};
use crate::map::Entity;
use crate::strips::{Broken, Replayed, RuleFault, RuleFaults, Wording};
use crate::units::{English, capitalized};

use super::args::{Common, Lang};

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
    let counts = match lang {
        Lang::Ru => {
            table.set_header(["Отношение", "English name", "Число"]);
            2
        }
        Lang::En => {
            table.set_header(["Relation", "Count"]);
            1
        }
    };
    for row in relations.counts() {
        let count = row.count.to_string();
        match lang {
            Lang::Ru => table.add_row([row.name, row.name_en, count]),
            Lang::En if row.name_en.is_empty() => table.add_row([row.name, count]),
            Lang::En => table.add_row([row.name_en, count]),
        };
    }
    if let Some(column) = table.column_mut(counts) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}

pub(super) fn table() -> Table {
    let mut table = Table::new();
    table.load_style(UTF8_BORDERS_ONLY).set_content_arrangement(ContentArrangement::Disabled);
    table
}

/// Facts, one a line: `Чашка-1 НАХОДИТСЯ_СВЕРХУ_НА Стол-1`.
pub(super) fn fact(relation: &str, values: &[String]) -> String {
    match values {
        [x, y] => format!("{x}  {relation}  {y}"),
        [x, property, value] => format!("{x}  {relation}  {property} = {value}"),
        _ => format!("{relation}({})", values.join(", ")),
    }
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
    let (steps, cost) = (replayed.steps.len(), replayed.cost_shown());
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
pub(super) fn route(
    world: &World,
    floor: &FloorPlan,
    answer: &RouteAnswer,
    common: &Common,
) -> String {
    let (lang, lengths) = (common.lang, common.units);
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
            format!(
                "{} → {}: {}\n{stages}",
                answer.from,
                answer.to,
                decimal(meters, "м", lang.language())
            )
        }
        Lang::En => {
            format!(
                "{} → {}: {}\n{stages}",
                answer.from,
                answer.to,
                decimal(meters, "m", lang.language())
            )
        }
    };
    let frames: Vec<String> = answer.chain.iter().map(|(_, id)| id.to_string()).collect();
    text.push_str(&format!("\n{} {}", lang.pick("Пассфреймы:", "Passframes:"), frames.join(" → ")));
    let points_in = lang.pick("Точки", "Points");
    let points: Vec<String> = route.points.iter().map(|p| lengths.point(p.x, p.y, 1)).collect();
    text.push_str(&format!(
        "\n{points_in}, {}: {}",
        lengths.word(lang.language()),
        points.join(" → ")
    ));
    for (moved, what) in [
        (&route.moved_start, lang.pick("Начало занято", "The start")),
        (&route.moved_goal, lang.pick("Цель занята", "The goal")),
    ] {
        if let Some(moved) = moved {
            let to = lengths.point(moved.to.x, moved.to.y, 1);
            text.push_str(&match lang {
                Lang::Ru => {
                    format!("\n{what}: робот там не помещается; взято ближайшее место {to}.")
                }
                Lang::En => format!(
                    "\n{what} is taken: the robot does not fit there; the nearest place is {to}."
                ),
            });
        }
    }
    text
}

/// «Дом РБ-2»: карт 1, помещений 4 …
pub(super) fn described(world: &World, lang: Lang) -> String {
    let [maps, areas, doors] = [world.maps.len(), world.areas.len(), world.doors.len()];
    let [replicas, objects] = [world.replicas.len(), world.objects.len()];
    let [orthoframes, places] = [world.orthoframes.len(), world.places.len()];
    let domain = &world.domain;
    match lang {
        Lang::Ru => format!(
            "«{}»: карт {maps}, помещений {areas}, дверей и проходов {doors}, экземпляров {replicas} (объектов {objects}, ортофреймов {orthoframes}), точек {places}.",
            domain.name
        ),
        Lang::En => {
            let count = |number: usize, noun| english::count(number as u64, noun);
            format!(
                "“{}”: {}, {}, {} (passages among them), {} ({}, {}), {}.",
                if domain.name_en.is_empty() { &domain.name } else { &domain.name_en },
                count(maps, "map"),
                count(areas, "room"),
                count(doors, "door"),
                count(replicas, "thing"),
                count(objects, "object"),
                count(orthoframes, "Orthoframe"),
                count(places, "place"),
            )
        }
    }
}
