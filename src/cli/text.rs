//! Engine values as text for a person.

use comfy_table::presets::UTF8_BORDERS_ONLY;
use comfy_table::{CellAlignment, ContentArrangement, Table};

pub(super) use crate::engine::plan_in_words as plan;

use crate::engine::{Relations, Replanned, RouteAnswer, World, decimal, no_way_in_words};
use crate::geometry::FloorPlan;
use crate::graphplan::Outcome;
use crate::language::Language;
use crate::language::names::english_name;
use crate::map::Entity;
use crate::strips::{Broken, Replayed, RuleFault, RuleFaults, Wording};
use crate::units::{English, capitalized, told, word};

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
    let language = lang.language();
    let [relation, count] = [word!("relation"), word!("count")].map(|word| word.say(language));
    let counts = match lang {
        Lang::Ru => {
            table.set_header([relation, word!("relation-in-english").say(language), count]);
            2
        }
        Lang::En => {
            table.set_header([relation, count]);
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
            told!(wording.language, "plan-rested-on-it")
        }
        (Outcome::Plan(_), false) => told!(wording.language, "plan-did-not-rest"),
        _ => told!(wording.language, "no-plan-before"),
    };
    let head = told!(wording.language, "withdrawn");
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
    let language = lang.language();
    let verdict = match &replayed.broken {
        None => told!(language, "plan-works", steps, actions, cost),
        Some(Broken { step: Some(step), faults }) => {
            told!(language, "plan-breaks", step, reasons = reasons(faults, lang))
        }
        Some(Broken { step: None, faults }) => {
            told!(language, "plan-misses", reasons = reasons(faults, lang))
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
            let told = told!(lang.language(), "no-way", why);
            return capitalized(&told);
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
    let length = decimal(meters, "", lang.language());
    let (from, to) = (&answer.from, &answer.to);
    let head = told!(lang.language(), "way-length", from, to, length = length.trim_end());
    let mut text = format!("{head}\n{stages}");
    let frames: Vec<String> = answer.chain.iter().map(|(_, id)| id.to_string()).collect();
    text.push_str(&format!("\n{} {}", told!(lang.language(), "passframes"), frames.join(" → ")));
    let points_in = told!(lang.language(), "points");
    let points: Vec<String> = route.points.iter().map(|p| lengths.point(p.x, p.y, 1)).collect();
    text.push_str(&format!(
        "\n{points_in}, {}: {}",
        lengths.word(lang.language()),
        points.join(" → ")
    ));
    for (moved, what) in [
        (&route.moved_start, told!(lang.language(), "the-start")),
        (&route.moved_goal, told!(lang.language(), "the-goal")),
    ] {
        if let Some(moved) = moved {
            let to = lengths.point(moved.to.x, moved.to.y, 1);
            text.push_str(&told!(lang.language(), "end-is-taken", what, to));
        }
    }
    text
}

/// A name in the language of the answer, where it has one.
pub(super) fn spoken<'n>(name: &'n str, name_en: &'n str, lang: Lang) -> &'n str {
    if lang == Lang::En && !name_en.is_empty() { name_en } else { name }
}

/// «Дом РБ-2»: карт 1, помещений 4 …
pub(super) fn described(world: &World, lang: Lang) -> String {
    let [maps, areas, doors] = [world.maps.len(), world.areas.len(), world.doors.len()];
    let [replicas, objects] = [world.replicas.len(), world.objects.len()];
    let [orthoframes, places] = [world.orthoframes.len(), world.places.len()];
    let domain = &world.domain;
    let name = spoken(&domain.name, &domain.name_en, lang);
    told!(
        lang.language(),
        "described",
        name,
        maps,
        rooms = areas,
        doors,
        things = replicas,
        objects,
        orthoframes,
        places
    )
}
