//! What a run tells a person: its plan, each step as it ends, and what it came to.
//!
//! **Invariant.** Every face tells a task in these words and has none of its own.

use crate::graphplan::Outcome;
use crate::language::Language;
use crate::language::question::{Answer, Memory};
use crate::language::words::english;
use crate::map::{Entity, World};
use crate::robot::{Directive, Solved};
use crate::semantics::predicate;
use crate::strips::{OperatorId, Said, Wording};

use super::assumed::assumptions_in_russian;
use super::directive_words::{actions_in_words, directive_in_words, goal_in_words, name_in};
use super::surprises::{barred_in_words, surprise_in_words};
use super::task::{Progress, TaskAnswer, TaskEnding};
use super::{Error, State};

/// What is said to "Stop" where nothing is under way.
pub(super) fn nothing_to_stop(language: Language) -> &'static str {
    language.pick("Стою: ничего не выполняется.", "I stand still: nothing is under way.")
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
            _ if solved.is_of_whole_actions => pick(
                "Плана из целых действий, одного за другим, нет, и это доказано; такой, где одно идёт внутри другого, не искался",
                "There is no plan of whole actions, one after another; this is proven. One in which an action goes on within another was not sought",
            ),
            _ => pick("Плана нет, и это доказано", "There is no plan; this is proven"),
        };
        return format!("{head}: {}", solved.explanation_with(wording).unwrap_or_default());
    }
    let wishes = solved.wishes.as_ref().map(|wishes| wishes.in_words(wording.language));
    if steps.is_empty() {
        let held = pick("Цель уже достигнута.", "The goal holds already.");
        return wishes.map_or_else(|| held.to_owned(), |wishes| format!("{held}\n{wishes}"));
    }
    let actions: usize = steps.iter().map(Vec::len).sum();
    let is_proven = solved.is_shortest && matches!(solved.outcome, Outcome::Plan(_));
    let shown = |hundredths: u64| {
        let seconds = hundredths as f64 / 100.0;
        decimal(seconds, pick("с", "s"), wording.language)
    };
    let driven = solved.time.map(|time| (shown(time.takes), shown(time.at_least), time.is_least()));
    let proof = match is_proven {
        true => pick("меньше шагов нельзя, это доказано", "fewer steps are proven impossible"),
        false => pick("что он кратчайший, не доказано", "not proven to be the shortest"),
    };
    // Where the search was given up, what is known is told below.
    let at_least = match (&solved.outcome, solved.at_least) {
        (Outcome::Plan(_), least @ 1..) if !is_proven => wording.language.pick(
            format!("; доказано, что шагов нужно не меньше {least}"),
            format!("; proven: at least {} needed", english::count(least as u64, "step is")),
        ),
        _ => String::new(),
    };
    let russian = format!("План: шагов {}, действий {actions}", steps.len());
    let english = format!("Plan: {}", counted_in_english(steps.len(), actions));
    let mut text = match &driven {
        None => wording.language.pick(
            format!("{russian}; {proof}{at_least}."),
            format!("{english}; {proof}{at_least}."),
        ),
        Some((takes, _, true)) => wording.language.pick(
            format!("{russian}, {takes} в пути; быстрее нельзя, это доказано."),
            format!("{english}, {takes} to drive; a quicker one is proven impossible."),
        ),
        Some((takes, least, false)) => wording.language.pick(
            format!("{russian}, {takes} в пути; доказано, что быстрее {least} нельзя."),
            format!("{english}, {takes} to drive; proven: none takes less than {least}."),
        ),
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
        let head = pick("Предположения, на которых он держится:", "It rests on the assumptions:");
        let told = assumed.join("\n     ");
        text.push_str(&format!("\n{head}\n     {told}"));
    }
    text
}

/// Of a plan where the search was given up, what it leaves open: between which bounds the fewest steps lie.
pub(super) fn left_open(solved: &Solved, wording: &Wording<'_>) -> Option<String> {
    let is_open = matches!(solved.outcome, Outcome::LimitReached(_)) && solved.time.is_none();
    let known = solved.explanation_with(wording).filter(|_| is_open)?;
    let head = wording.language.pick("Это не ответ до конца: ", "This is no full answer: ");
    Some(format!("{head}{known}"))
}

/// "1 step, 2 actions"
#[must_use]
pub(crate) fn counted_in_english(steps: usize, actions: usize) -> String {
    let count = |number: usize, noun| english::count(number as u64, noun);
    format!("{}, {}", count(steps, "step"), count(actions, "action"))
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
            Self::Started { .. } | Self::Sent { .. } | Self::Moved(_) | Self::Scanned(_) => Vec::new(),
            Self::Finished(report) => {
                let way = decimal(report.length / 100.0, language.pick("м", "m"), language);
                let way =
                    if report.points.is_empty() { String::new() } else { format!("{way}, ") };
                let time = decimal(report.seconds, language.pick("с", "s"), language);
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
                language
                    .pick(
                        "     Не обойти и не сдвинуть: зову оператора.",
                        "     No way leads round it, and it is not to be pushed: I call the operator.",
                    )
                    .to_owned(),
            ],
            Self::Surprised { directive, surprise } => {
                let what = surprise_in_words(world, surprise, language);
                vec![
                    format!("   ! {}: {what}", directive_in_words(world, directive, language)),
                    language.pick("     Новый план.", "     Planning anew.").to_owned(),
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
                let head = language
                    .pick("Плана нет, и это доказано.", "There is no plan; this is proven.");
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
        let left = language.pick("Оставлено на месте", "Left where it is");
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
            let shown = name_in(self.world()?, name, language);
            let question = match language {
                Language::Russian => format!("Где {name}?"),
                Language::English => format!("Where is {shown}?"),
            };
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
        decimal(length, language.pick("м", "m"), language),
        decimal(answer.seconds, language.pick("с", "s"), language)
    );
    let mut told = match &answer.ending {
        TaskEnding::Done => match language {
            Language::Russian => format!("\nСделано: {spent}."),
            Language::English => format!("\nDone: {spent}."),
        },
        ending => unfinished(world, ending, answer, language),
    };
    for (thing, sure) in &answer.unsure {
        let name = name_in(world, world.name(Entity::Replica(*thing)), language);
        let percent = (sure * 100.0).round();
        told.push_str(&match language {
            Language::Russian => format!(
                "\nГде {name}, я не был уверен (уверенность {percent:.0} %), поэтому сначала искал."
            ),
            Language::English => {
                format!(
                    "\nI was not sure where {name} was ({percent:.0}% sure), so I looked first."
                )
            }
        });
    }
    for (goal, ending) in &answer.left {
        let thing = goal.args.first().map(|name| name_in(world, name, language));
        let why = unfinished(world, ending, answer, language);
        if goal.predicate != predicate::IN_ITS_PLACE {
            told.push_str(&format!("\n{why}"));
            continue;
        }
        let stays = language.pick("осталось не на месте", "is not in its place");
        told.push_str(&format!("\n{} {stays}. {why}", thing.unwrap_or_default()));
    }
    if answer.others_done {
        told.push('\n');
        told.push_str(language.pick("Остальное сделано.", "The rest is done."));
    }
    for thing in &answer.strays {
        let thing = name_in(world, thing, language);
        told.push_str(&match language {
            Language::Russian => {
                format!("\nНеизвестно, где место для «{thing}»: оставлено там, где лежит.")
            }
            Language::English => {
                format!("\nIt is not known where {thing} belongs: it stays where it is.")
            }
        });
    }
    for (thing, home) in &answer.kept {
        let (thing, home) = (name_in(world, thing, language), name_in(world, home, language));
        told.push_str(&match language {
            Language::Russian => format!("\n«{thing}» лежит там, где и хранится: «{home}»."),
            Language::English => format!("\n{thing} lies where it is kept: {home}."),
        });
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
        let head = language.pick("Не начато", "Not begun");
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
            None if answer.stops => nothing_to_stop(language).to_owned(),
            None if !answer.strays.is_empty() || !answer.kept.is_empty() => language
                .pick("Больше убирать нечего.", "Nothing else is to be put away.")
                .to_owned(),
            None if answer.tidies => {
                let kept = "Всё уже на своих местах: там, где хранится или было на карте.";
                let english =
                    "Everything is in its place already: where it is kept, or was surveyed.";
                language.pick(kept, english).to_owned()
            }
            None => language.pick("Так уже и есть.", "It is so already.").to_owned(),
        },
        TaskEnding::NoPlan(planned) => {
            let name = |name: &str| name_in(world, name, language);
            plan_in_words(&planned.solved, &planned.solved.wording(language, &name))
        }
        TaskEnding::Stuck(surprise) => {
            let what = surprise_in_words(world, surprise, language);
            format!("{}: {what}.", language.pick("Не выходит", "Stuck"))
        }
        TaskEnding::Stopped => {
            let stopped = language.pick("Остановлено.", "Stopped.");
            match &answer.reported {
                Some(position) => format!("{stopped} {}", position.say(language)),
                None => stopped.to_owned(),
            }
        }
        TaskEnding::Failed(failure) => {
            let broken_off = language.pick("Задание прервано", "The task was broken off");
            format!("{broken_off}: {}.", failure.say(language))
        }
    }
}
