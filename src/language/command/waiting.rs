//! What is said of the tasks that wait: «Пауза», «Продолжай», «Отмени 2», "What is queued?", "Later: bring the cup".
//!
//! Invariant: only a line of nothing else is one.

use crate::units::name_key;

/// A line about the tasks that wait.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Waiting<'t> {
    /// Nothing more is begun.
    Pause,
    Resume,
    /// What waits is told.
    List,
    /// One is dropped, by its number in the list from 1; without one the only one.
    Cancel(Option<usize>),
    CancelAll,
    /// An order that is to wait.
    Add(&'t str),
}

const PAUSE: &str = "пауза|поставь на паузу|сделай паузу|приостанови|приостановись|приостанови задание|приостанови задания|\
    pause|pause it|pause the task|pause the tasks|pause the queue";
const RESUME: &str = "продолжай|продолжайте|продолжи|продолжить|продолжай задание|продолжай задания|продолжи задание|\
    продолжи задания|возобнови|возобнови задание|возобнови задания|снимись с паузы|continue|resume|go on|carry on|\
    continue the task|continue the tasks|resume the task|resume the tasks|resume the queue";
const LIST: &str = "что в очереди|какие задания в очереди|какие задания ждут|очередь|очередь заданий|список заданий|\
    покажи очередь|что осталось сделать|what is queued|what s queued|what is in the queue|what s in the queue|\
    which tasks are waiting|what tasks are waiting|which tasks are queued|what tasks are queued|list the tasks|show the queue|queue";
const CANCEL: &str = "отмени|отмените|отмена|отмени задание|отмени номер|отмени задание номер|cancel|cancel it|cancel the task|\
    cancel task|cancel number|cancel task number";
const CANCEL_ALL: &str = "отмени все|отмени все задания|очисти очередь|cancel all|cancel all tasks|cancel all the tasks|\
    cancel everything|clear the queue";
const LATER: &str =
    "в очередь|добавь в очередь|поставь в очередь|позже|потом|queue|enqueue|add to the queue|later";

fn is_one_of(all: &str, key: &str) -> bool {
    all.split('|').any(|one| one.trim() == key)
}

/// What a line says of the tasks that wait; none for every other line.
#[must_use]
pub fn waiting(line: &str) -> Option<Waiting<'_>> {
    if let Some((before, order)) = line.split_once(':')
        && is_one_of(LATER, &name_key(before))
        && !order.trim().is_empty()
    {
        return Some(Waiting::Add(order.trim()));
    }
    let key = name_key(line.trim_matches(|c: char| !c.is_alphanumeric())).replace(['\'', '’'], " ");
    let lists = [
        (PAUSE, Waiting::Pause),
        (RESUME, Waiting::Resume),
        (LIST, Waiting::List),
        (CANCEL, Waiting::Cancel(None)),
        (CANCEL_ALL, Waiting::CancelAll),
    ];
    if let Some((_, meant)) = lists.into_iter().find(|(list, _)| is_one_of(list, &key)) {
        return Some(meant);
    }
    let (verb, number) = key.rsplit_once(' ')?;
    let number = number.parse().ok().filter(|number| *number > 0)?;
    is_one_of(CANCEL, verb).then_some(Waiting::Cancel(Some(number)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_line_of_nothing_else_speaks_of_what_waits() {
        for (line, expected) in [
            ("Пауза!", Some(Waiting::Pause)),
            ("pause", Some(Waiting::Pause)),
            ("Продолжай", Some(Waiting::Resume)),
            ("Resume.", Some(Waiting::Resume)),
            ("Что в очереди?", Some(Waiting::List)),
            ("What's queued?", Some(Waiting::List)),
            ("Отмени", Some(Waiting::Cancel(None))),
            ("Отмени задание 2", Some(Waiting::Cancel(Some(2)))),
            ("cancel 3", Some(Waiting::Cancel(Some(3)))),
            ("cancel 0", None),
            ("Отмени всё", Some(Waiting::CancelAll)),
            ("Later: bring the cup", Some(Waiting::Add("bring the cup"))),
            ("В очередь: принеси чашку", Some(Waiting::Add("принеси чашку"))),
            ("Later:", None),
            ("Продолжай искать", None),
            ("Pause the music", None),
            ("Что на столе?", None),
            ("", None),
        ] {
            assert_eq!(waiting(line), expected, "{line}");
        }
    }
}
