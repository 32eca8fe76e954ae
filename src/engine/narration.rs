//! What a run tells a person: its plan, each step as it ends, and what it came to.
//!
//! **Invariant.** Every face tells a task in these words and has none of its own.

use crate::graphplan::Outcome;
use crate::language::Language;
use crate::language::question::{Answer, Memory};
use crate::map::{Entity, World};
use crate::robot::{Directive, Solved};
use crate::semantics::predicate;
use crate::strips::{OperatorId, Said, Wording};
use crate::units::told;

use super::assumed::assumptions_in_russian;
use super::directive_words::{actions_in_words, directive_in_words, goal_in_words, name_in};
use super::surprises::{barred_in_words, surprise_in_words};
use super::task::{Progress, TaskAnswer, TaskEnding};
use super::{Error, State};

/// What is said to "Stop" where nothing is under way.
pub(super) fn nothing_to_stop(language: Language) -> String {
    told!(language, "i-stand-still")
}

/// A plan as the paper prints it, one directive a line, parallel ones under one number; by the phrases of the rules
/// where they have any in the language.
#[must_use]
pub(crate) fn plan_in_words(solved: &Solved, wording: &Wording<'_>) -> String {
    let directive = |id: &OperatorId| wording.action(&Said::from(solved.task.operator(*id)));
    let steps = solved.outcome.plan().map_or_else(Vec::new, |plan| {
        plan.steps.iter().map(|step| step.iter().map(directive).collect()).collect()
    });
    plan_of(solved, &steps, &solved.assumptions_with(wording), wording)
}

/// A plan, its directives and what it rests on given in words.
fn plan_of(
    solved: &Solved,
    steps: &[Vec<String>],
    assumed: &[String],
    wording: &Wording<'_>,
) -> String {
    // What was given up before it began knows no plan, and one of no steps would be an answer.
    let is_found = match solved.outcome {
        Outcome::Plan(_) => true,
        Outcome::NoPlan { .. } => false,
        Outcome::LimitReached(_) => !steps.is_empty(),
    };
    if !is_found {
        let head = match solved.outcome {
            Outcome::LimitReached(_) => told!(wording.language, "no-plan-was-found"),
            _ if solved.is_of_whole_actions => told!(wording.language, "no-plan-of-whole-actions"),
            _ => told!(wording.language, "no-plan-proven"),
        };
        return format!("{head}: {}", solved.explanation_with(wording).unwrap_or_default());
    }
    let wishes = solved.wishes.as_ref().map(|wishes| wishes.in_words(wording.language));
    if steps.is_empty() {
        let held = told!(wording.language, "the-goal-holds-already");
        return wishes.map_or_else(|| held.to_owned(), |wishes| format!("{held}\n{wishes}"));
    }
    let actions: usize = steps.iter().map(Vec::len).sum();
    let is_proven = solved.is_shortest && matches!(solved.outcome, Outcome::Plan(_));
    let shown = |hundredths: u64| {
        let seconds = hundredths as f64 / 100.0;
        decimal(seconds, &told!(wording.language, "s"), wording.language)
    };
    let driven = solved.time.map(|time| (shown(time.takes), shown(time.at_least), time.is_least()));
    let proof = match is_proven {
        true => told!(wording.language, "fewer-steps-are-proven-impossible"),
        false => told!(wording.language, "shortest-unproven"),
    };
    // Where the search was given up, what is known is told below.
    let at_least = match (&solved.outcome, solved.at_least) {
        (Outcome::Plan(_), least @ 1..) if !is_proven => {
            told!(wording.language, "proven-at-least", least)
        }
        _ => String::new(),
    };
    let language = wording.language;
    let plan = told!(language, "plan-of", steps = steps.len(), actions);
    let mut text = match &driven {
        None => format!("{plan}; {proof}{at_least}."),
        Some((takes, _, true)) => told!(language, "plan-quickest", plan, takes),
        Some((takes, least, false)) => told!(language, "plan-driven", plan, takes, least),
    };
    if let Some(wishes) = wishes {
        text = format!("{text}\n{wishes}");
    }
    for (number, step) in steps.iter().enumerate() {
        for (i, action) in step.iter().enumerate() {
            let label = if i == 0 { format!("{}.", number + 1) } else { String::new() };
            text.push_str(&format!("\n{label:>4} {action}"));
        }
    }
    if let Some(open) = left_open(solved, wording) {
        text.push_str(&format!("\n{open}"));
    }
    if !solved.assumptions.is_empty() {
        let head = told!(wording.language, "it-rests-on-the-assumptions");
        let told = assumed.join("\n     ");
        text.push_str(&format!("\n{head}\n     {told}"));
    }
    text
}

/// Of a plan where the search was given up, what it leaves open: between which bounds the fewest steps lie.
pub(super) fn left_open(solved: &Solved, wording: &Wording<'_>) -> Option<String> {
    let is_open = matches!(solved.outcome, Outcome::LimitReached(_)) && solved.time.is_none();
    let known = solved.explanation_with(wording).filter(|_| is_open)?;
    let head = told!(wording.language, "this-is-no-full-answer");
    Some(format!("{head}{known}"))
}

/// A number with one decimal, its mark as the language has it.
#[must_use]
pub(crate) fn decimal(value: f64, unit: &str, language: Language) -> String {
    let text = format!("{value:.1} {unit}");
    if language == Language::Russian { text.replacen('.', ",", 1) } else { text }
}

impl Progress<'_> {
    /// What happens on the way, a line each; nothing for what is only begun.
    #[must_use]
    pub fn in_words(&self, world: &World, language: Language) -> Vec<String> {
        match self {
            Self::Planned(planned) => {
                if planned.solved.outcome.plan().is_none() || planned.steps.is_empty() {
                    return Vec::new();
                }
                let told = |directive: &Directive| directive_in_words(world, directive, language);
                let steps: Vec<Vec<String>> =
                    planned.steps.iter().map(|step| step.iter().map(told).collect()).collect();
                let name = |name: &str| name_in(world, name, language);
                let wording = planned.solved.wording(language, &name);
                let assumed = match language {
                    Language::Russian => assumptions_in_russian(world, &planned.solved),
                    Language::English => planned.solved.assumptions_with(&wording),
                };
                vec![format!("{}\n", plan_of(&planned.solved, &steps, &assumed, &wording))]
            }
            Self::Started { .. } | Self::Sent { .. } | Self::Moved(_) | Self::Scanned(_) => {
                Vec::new()
            }
            Self::Finished(report) => {
                let way = decimal(report.length / 100.0, &told!(language, "metres"), language);
                let way = if report.points.is_empty() { String::new() } else { format!("{way}, ") };
                let time = decimal(report.seconds, &told!(language, "s"), language);
                let mut lines = vec![format!(
                    "{:>4} {} – {way}{time}",
                    format!("{}.", report.number),
                    directive_in_words(world, &report.directive, language)
                )];
                let primitives = actions_in_words(world, &report.directive, language);
                lines.extend(primitives.into_iter().map(|sentence| format!("     {sentence}")));
                lines.extend(report.position.as_ref().map(|p| format!("     {}", p.say(language))));
                lines
            }
            Self::Barred { barred, .. } => vec![
                format!("   ? {}", barred_in_words(world, barred, language)),
                told!(language, "no-way-round"),
            ],
            Self::Surprised { directive, surprise } => {
                let what = surprise_in_words(world, surprise, language);
                vec![
                    format!("   ! {}: {what}", directive_in_words(world, directive, language)),
                    told!(language, "planning-anew"),
                ]
            }
        }
    }
}

/// What planning came to, by a stable word for programs.
pub(super) fn outcome(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Plan(_) => "plan",
        Outcome::NoPlan { .. } => "no_plan",
        Outcome::LimitReached(_) => "limit",
    }
}

impl TaskAnswer {
    /// How it ended, by a stable word for programs.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match &self.ending {
            TaskEnding::Done => "done",
            TaskEnding::AlreadyTrue => "already_true",
            TaskEnding::NoPlan(planned) => outcome(&planned.solved.outcome),
            TaskEnding::Stuck(_) => "stuck",
            TaskEnding::Stopped => "stopped",
            TaskEnding::Failed(_) => "vehicle_failed",
        }
    }
}

impl State {
    /// What a task came to, in words.
    ///
    /// # Errors
    /// There is no map.
    pub fn ending_in_words(
        &self,
        answer: &TaskAnswer,
        language: Language,
    ) -> Result<String, Error> {
        if let TaskEnding::NoPlan(planned) = &answer.ending
            && matches!(planned.solved.outcome, Outcome::NoPlan { .. })
        {
            // Where nothing leads at all, that is the reason; the rules would only say it in more words.
            let apart = self.unconnected_in_words(answer, language);
            if !apart.is_empty() {
                let head = told!(language, "there-is-no-plan-this");
                return Ok(format!("{head} {}", apart.join(" ")));
            }
        }
        let mut told = vec![ending(self.world()?, answer, language)];
        let goals = answer.goal.iter().filter(|goal| goal.predicate == predicate::FOUND);
        let found = goals.flat_map(|goal| goal.args.first());
        let places = self.places_of(found, language)?;
        // That a thing is found already says nothing more than where it is.
        let finds = answer.goal.iter().all(|goal| goal.predicate == predicate::FOUND);
        let is_so = matches!(answer.ending, TaskEnding::AlreadyTrue) && answer.left.is_empty();
        if is_so && finds && !places.is_empty() {
            told.clear();
        }
        told.extend(places);
        let mut told = told.join(" ");
        let left = told!(language, "left-where-it-is");
        let lying = self.places_of(answer.lying.iter(), language)?;
        // That it is so would be untrue of what lies inside and was to be put on top.
        if is_so && !lying.is_empty() {
            told.clear();
        }
        for place in lying {
            told = format!("{told}\n{left}: {place}").trim_start().to_owned();
        }
        Ok(told)
    }

    /// Who asks to find a thing wants to know where it is, and so does who had it put where it lies.
    fn places_of<'n>(
        &self,
        names: impl Iterator<Item = &'n String>,
        language: Language,
    ) -> Result<Vec<String>, Error> {
        let mut places = Vec::new();
        for name in names {
            let name = match language {
                Language::Russian => name.clone(),
                Language::English => name_in(self.world()?, name, language),
            };
            let question = told!(language, "where-is", name);
            places
                .extend(self.ask(&question, &mut Memory::default())?.ok().map(|found| found.text));
        }
        Ok(places)
    }

    /// The rule of an answer, and below it the proof of each of the first facts.
    ///
    /// # Errors
    /// As [`State::ask`](crate::engine::State::ask).
    pub fn explained(&self, answer: &Answer) -> Result<String, Error> {
        let mut lines = vec![self.rule_of(answer)?];
        for fact in answer.facts.iter().take(3) {
            let sign = if fact.holds { "" } else { "!" };
            lines.push(format!("{sign}{}({})", fact.relation, fact.args.join(", ")));
            let proof = self.proof_of(fact, answer.language)?;
            lines.extend(proof.into_iter().map(|line| format!("    {line}")));
        }
        Ok(lines.join("\n"))
    }
}

fn ending(world: &World, answer: &TaskAnswer, language: Language) -> String {
    let length = answer.reports.iter().map(|r| r.length).sum::<f64>() / 100.0;
    let spent = format!(
        "{}, {}",
        decimal(length, &told!(language, "metres"), language),
        decimal(answer.seconds, &told!(language, "s"), language)
    );
    let mut told = match &answer.ending {
        TaskEnding::Done => told!(language, "done-spent", spent),
        ending => unfinished(world, ending, answer, language),
    };
    for (thing, sure) in &answer.unsure {
        let name = name_in(world, world.name(Entity::Replica(*thing)), language);
        let percent = (sure * 100.0).round();
        told.push_str(&told!(
            language,
            "was-unsure-where",
            name,
            percent = format!("{percent:.0}")
        ));
    }
    for (goal, ending) in &answer.left {
        let thing = goal.args.first().map(|name| name_in(world, name, language));
        let why = unfinished(world, ending, answer, language);
        if goal.predicate != predicate::IN_ITS_PLACE {
            told.push_str(&format!("\n{why}"));
            continue;
        }
        let stays = told!(language, "is-not-in-place");
        told.push_str(&format!("\n{} {stays}. {why}", thing.unwrap_or_default()));
    }
    if answer.others_done {
        told.push('\n');
        told.push_str(&told!(language, "the-rest-is-done"));
    }
    for thing in &answer.strays {
        let thing = name_in(world, thing, language);
        told.push_str(&told!(language, "homeless", thing));
    }
    for (thing, home) in &answer.kept {
        let (thing, home) = (name_in(world, thing, language), name_in(world, home, language));
        told.push_str(&told!(language, "lies-at-home", thing, home));
    }
    // A door is asked for from both of its sides.
    let mut rest: Vec<String> = Vec::new();
    for goal in &answer.not_begun {
        let wanted = goal_in_words(world, goal, language);
        if !rest.contains(&wanted) {
            rest.push(wanted);
        }
    }
    if !rest.is_empty() {
        let head = told!(language, "not-begun-rest");
        told.push_str(&format!("\n{head}: {}.", rest.join("; ")));
    }
    told
}

fn unfinished(
    world: &World,
    ending: &TaskEnding,
    answer: &TaskAnswer,
    language: Language,
) -> String {
    match ending {
        TaskEnding::Done | TaskEnding::AlreadyTrue => match &answer.reported {
            Some(position) => position.say(language),
            None if answer.stops => nothing_to_stop(language),
            None if !answer.strays.is_empty() || !answer.kept.is_empty() => {
                told!(language, "nothing-else-is-to-be")
            }
            None if answer.tidies => told!(language, "all-in-place"),
            None => told!(language, "it-is-so-already"),
        },
        TaskEnding::NoPlan(planned) => {
            let name = |name: &str| name_in(world, name, language);
            plan_in_words(&planned.solved, &planned.solved.wording(language, &name))
        }
        TaskEnding::Stuck(surprise) => {
            let what = surprise_in_words(world, surprise, language);
            format!("{}: {what}.", told!(language, "stuck"))
        }
        TaskEnding::Stopped => {
            let stopped = told!(language, "stopped");
            match &answer.reported {
                Some(position) => format!("{stopped} {}", position.say(language)),
                None => stopped,
            }
        }
        TaskEnding::Failed(failure) => {
            let broken_off = told!(language, "the-task-was-broken-off");
            format!("{broken_off}: {}.", failure.say(language))
        }
    }
}
