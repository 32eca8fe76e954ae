//! What a clause leaves out because the one before has said it: «лампу включи, а телевизор выключи», "one knife on the
//! sofa and another on the bed", «телевизор в спальне включи, а в гостиной выключи». By words alone, as
//! [`spoken`](super::spoken).
//!
//! Invariant: nothing is dropped; verbs come before what they are done to, and words of the clause before are repeated.

use std::ops::Range;

use super::said::{Said, is_adjective};
use super::verbs::{Sort, is_relative};
use super::vocabulary::{Meaning, Role, Verb};
use crate::command::Relation;
use crate::sets::{Set, set};
use crate::words::Language;

/// What stands between two marks or joints, without the joint.
struct Segment {
    words: Range<usize>,
    /// Where each verb stands, and how many words it takes.
    verbs: Vec<(usize, usize, Verb)>,
    /// Whether «а», "but" joins it to the one before.
    contrasted: bool,
}

impl Segment {
    /// The one verb of a segment that begins with it.
    fn begins_with(&self, said: &Said) -> Option<(usize, usize, Verb)> {
        let [verb] = self.verbs[..] else { return None };
        (first_word(said, &self.words) == Some(verb.0)).then_some(verb)
    }
}

fn segments(said: &Said) -> Vec<Segment> {
    let mut all: Vec<Segment> = Vec::new();
    let mut begins = true;
    let mut contrasted = false;
    let mut at = 0;
    while at < said.keys.len() {
        let (taken, meaning) = match said.meaning(at) {
            Some((taken, meaning)) => (taken, Some(meaning)),
            None => (1, None),
        };
        let but = said.is(at, set!("But"));
        if but || meaning == Some(Meaning::And) {
            contrasted |= but || said.is(at, &["а"]);
            begins = true;
            at += taken;
            continue;
        }
        if begins || said.parted(at) {
            all.push(Segment { words: at..at, verbs: Vec::new(), contrasted });
            (begins, contrasted) = (false, false);
        }
        if let Some(segment) = all.last_mut() {
            segment.words.end = at + taken;
            if let Some(Meaning::Verb(verb)) = meaning {
                segment.verbs.push((at, taken, verb));
            }
        }
        at += taken;
    }
    all
}

/// The first word that is no politeness.
pub(super) fn first_word(said: &Said, words: &Range<usize>) -> Option<usize> {
    let mut at = words.start;
    while at < words.end {
        match said.meaning(at) {
            Some((taken, Meaning::Filler | Meaning::Me)) => at += taken,
            _ => return Some(at),
        }
    }
    None
}

/// What is named before the first preposition, and that preposition.
pub(super) fn object(
    said: &Said,
    words: &Range<usize>,
) -> (Range<usize>, Option<(Relation, Role)>) {
    let mut named: Option<Range<usize>> = None;
    let mut at = words.start;
    while at < words.end {
        match said.meaning(at) {
            Some((_, Meaning::Link(link))) => {
                return (named.unwrap_or(at..at), Some((link.relation, link.role)));
            }
            Some((taken, _)) => at += taken,
            None => {
                named = Some(named.map_or(at, |named| named.start)..at + 1);
                at += 1;
            }
        }
    }
    (named.unwrap_or(at..at), None)
}

/// «Лампу включи, книгу принеси»: each verb before what it is done to, where a sentence has several.
pub(super) fn verb_first(said: &Said) -> Option<String> {
    let all = segments(said);
    let with_verb = all.iter().filter(|segment| !segment.verbs.is_empty()).count();
    if with_verb == 0 || Language::of(&said.text) != Language::Russian {
        return None;
    }
    // «Чашку, ложку принеси»: a list before the first verb is what that is done to.
    let listed = all.iter().take_while(|segment| segment.verbs.is_empty()).count();
    let from = |n: usize| if n == listed { 0 } else { n };
    all.iter().enumerate().find_map(|(n, segment)| {
        let [(verb, taken, kind)] = segment.verbs[..] else { return None };
        let own = first_word(said, &segment.words)?;
        let begin = all[from(n)].words.start;
        // «Книгу, что на столе, отвези в спальню»: nothing else is named that it is done to.
        let leads = || {
            let mut behind = verb + taken..segment.words.end;
            let pronoun = |n: usize| {
                matches!(
                    said.meaning(n),
                    Some((_, Meaning::Pronoun | Meaning::Them | Meaning::All))
                )
            };
            let carries = matches!(Sort::of(kind), Sort::Put | Sort::Carry);
            let (named, link) = object(said, &behind);
            let named = !named.is_empty() || behind.any(pronoun) || link.is_none();
            carries && begin < verb && !named && !object(said, &all[0].words).0.is_empty()
        };
        // «Одну чашку отнеси на кровать, остальные на комод»
        let goes_on = || {
            let later = all[n + 1..].iter().map(|next| object(said, &next.words));
            with_verb > 1
                || later.into_iter().any(|(named, link)| !named.is_empty() && link.is_some())
        };
        if kind == Verb::Need || (own == verb && !leads()) || (own != verb && !goes_on()) {
            return None;
        }
        let denied = (begin..verb).any(|n| matches!(said.meaning(n), Some((_, Meaning::Not))));
        let before = begin..verb;
        (!denied).then(|| {
            let said_first = format!("{} {}", said.of(&(verb..verb + taken)), said.of(&before));
            said.with(&(begin..verb + taken), &said_first)
        })
    })
}

/// Whether words say whither something is put or carried; between two things ends with a second noun.
fn says_whither(said: &Said, words: &Range<usize>, sort: Sort) -> bool {
    let links = words.clone().filter_map(|at| match said.meaning(at) {
        Some((_, Meaning::Link(link))) => Some((link.relation, link.role)),
        _ => None,
    });
    let links: Vec<_> = links.collect();
    let whence = links.iter().any(|(_, role)| *role == Role::Whence);
    let says = links.iter().any(|(_, role)| match (sort, role) {
        (Sort::Put | Sort::Carry, Role::Whither) | (Sort::Put, Role::Where) => true,
        (Sort::Put, Role::WhereOrWhither) => true,
        (Sort::Carry, Role::WhereOrWhither) => whence,
        _ => false,
    });
    says && links.iter().all(|(relation, _)| *relation != Relation::Between)
}

/// «Положи карандаш на диван, а ручку на комод»: the verb once more.
pub(super) fn verb_again(said: &Said) -> Option<String> {
    let all = segments(said);
    (1..all.len()).find_map(|n| {
        let (before, next) = (&all[n - 1], &all[n]);
        // «Положи карандаш и ручку на диван, а …»: what is listed has the verb of the first.
        let lead = all[..n].iter().rev().find(|segment| !segment.verbs.is_empty())?;
        let (verb, taken, kind) = lead.begins_with(said)?;
        let own = (verb + taken).max(before.words.start)..before.words.end;
        let told = if own.is_empty() { (0..0, None) } else { object(said, &own) };
        let begin = first_word(said, &next.words)?;
        let named = object(said, &next.words);
        let goes = |words: &Range<usize>| says_whither(said, words, Sort::of(kind));
        let objects = !told.0.is_empty() && !named.0.is_empty();
        let role = |place: Option<(Relation, Role)>| place.map(|(_, role)| role);
        // "… from the hall to the bath, and the cup to the kitchen"
        let whence = [told.1, named.1].iter().any(|place| role(*place) == Some(Role::Whence));
        // "Bring me the mug, and the plate to the kitchen": without a mark both may go there.
        let is_me = |n: usize| matches!(said.meaning(n), Some((_, Meaning::Me)));
        let last = own.clone().rfind(|n| is_me(*n)).is_some_and(|n| n >= told.0.end);
        let to_me = Sort::of(kind) == Sort::Carry
            && own.clone().any(is_me)
            && (last || next.contrasted || said.parted(before.words.end));
        let alike = to_me || whence || role(told.1) == role(named.1);
        let gaps = next.verbs.is_empty() && objects && alike;
        let gaps = gaps
            && (to_me || goes(&own))
            && (goes(&next.words) || to_me && next.contrasted && named.1.is_some());
        (gaps && !is_relative(&said.keys, begin)).then(|| {
            let first = next.words.start..next.words.start + 1;
            let again = format!("{} {}", said.of(&(verb..verb + taken)), said.of(&first));
            said.with(&first, &again)
        })
    })
}

/// «Включи телевизор в спальне, а в гостиной выключи»: what it is done to once more.
pub(super) fn object_again(said: &Said) -> Option<String> {
    segments(said).windows(2).find_map(|pair| {
        let [before, next] = pair else { return None };
        let ((verb, taken, kind), (again, length, other)) =
            (before.begins_with(said)?, next.begins_with(said)?);
        let switches = matches!(Sort::of(kind), Sort::Switch | Sort::Door);
        if !next.contrasted || !switches || Sort::of(kind) != Sort::of(other) {
            return None;
        }
        let (told, _) = object(said, &(verb + taken..before.words.end));
        let (named, link) = object(said, &(again + length..next.words.end));
        (named.is_empty() && link.is_some() && !told.is_empty()).then(|| {
            let verb = again..again + length;
            said.with(&verb, &format!("{} {}", said.of(&verb), said.of(&told)))
        })
    })
}

/// "Shut and lock the office door": what the second verb is done to is said of the first as well.
pub(super) fn object_shared(said: &Said) -> Option<String> {
    segments(said).windows(2).find_map(|pair| {
        let [before, next] = pair else { return None };
        let ((verb, taken, kind), (again, length, other)) =
            (before.begins_with(said)?, next.begins_with(said)?);
        let alike = matches!(Sort::of(kind), Sort::Switch | Sort::Door)
            && Sort::of(kind) == Sort::of(other);
        let alone = verb + taken == before.words.end && !said.parted(before.words.end);
        let what = again + length..next.words.end;
        let (named, _) = object(said, &what);
        (alike && alone && !named.is_empty()).then(|| {
            let verb = verb..verb + taken;
            said.with(&verb, &format!("{} {}", said.of(&verb), said.of(&what)))
        })
    })
}

/// «Одну чашку поставь на стол, а другую на полку», «… синюю на диван»: the noun once more.
pub(super) fn noun_again(said: &Said) -> Option<String> {
    static ONE: Set = Set::named("AnotherOne");
    static REST: Set = Set::named("TheOthers");
    let all = segments(said);
    (1..all.len()).find_map(|n| {
        let (verb, taken, kind) = all[n].begins_with(said)?;
        if !matches!(Sort::of(kind), Sort::Put | Sort::Carry | Sort::Switch) {
            return None;
        }
        let at = first_word(said, &(verb + taken..all[n].words.end))?;
        let language = Language::of(&said.keys[at]);
        let (length, before) = match (said.phrase(at, &ONE), said.phrase(at, &REST)) {
            (_, Some(length)) => (length, language.pick("все остальные", "all the other")),
            (Some(length), _) => (length, language.pick("другую", "another")),
            _ if kind_is_told(said, at, kind) => (1, said.of(&(at..at + 1))),
            _ => return None,
        };
        // «другую чашку» has its noun.
        let end = at + length;
        let ends = end >= all[n].words.end
            || matches!(said.meaning(end), Some((_, Meaning::Link(_) | Meaning::Me)));
        if !ends {
            return None;
        }
        let noun = all[..n].iter().rev().find_map(|segment| {
            let (verb, taken, _) = segment.begins_with(said)?;
            let (named, _) = object(said, &(verb + taken..segment.words.end));
            (!named.is_empty()).then(|| named.end - 1)
        })?;
        Some(said.with(&(at..end), &format!("{before} {}", said.of(&(noun..noun + 1)))))
    })
}

/// Whether a lone word is an adjective of what the clause before has named.
fn kind_is_told(said: &Said, at: usize, verb: Verb) -> bool {
    let carried = matches!(Sort::of(verb), Sort::Put | Sort::Carry);
    carried && said.meaning(at).is_none() && is_adjective(&said.keys[at])
}

#[cfg(test)]
mod tests {
    use crate::command::gathered;

    #[test]
    fn what_is_left_out_is_said_again() {
        for (said, order) in [
            ("Лампу включи, книгу принеси", "включи Лампу, принеси книгу"),
            ("Чашку, ложку принеси, а лампу выключи", "принеси Чашку, ложку, а выключи лампу"),
            ("Тут темно, включи торшер и закрой дверь", "Тут темно, включи торшер и закрой дверь"),
            (
                "Положи карандаш на диван, а ручку на комод",
                "Положи карандаш на диван, а Положи ручку на комод",
            ),
            (
                "Положи карандаш и ручку на диван, а книгу на комод",
                "Положи карандаш и ручку на диван, а Положи книгу на комод",
            ),
            (
                "Put one knife on the sofa and another on the bed",
                "Put one knife on the sofa and Put another knife on the bed",
            ),
            (
                "Телевизор в спальне включи, а в гостиной выключи",
                "включи Телевизор в спальне, а выключи Телевизор в гостиной",
            ),
            (
                "Один нож отнеси на диван, остальные сложи на комод",
                "отнеси Один нож на диван, сложи все остальные нож на комод",
            ),
            (
                "Одну кружку поставь в шкаф, а другую принеси мне",
                "поставь Одну кружку в шкаф, а принеси другую кружку мне",
            ),
            (
                "Положи красную книгу на стол, а синюю на полку",
                "Положи красную книгу на стол, а Положи синюю книгу на полку",
            ),
            ("Положи книгу на тумбочку, ту, что у окна", "Положи книгу на тумбочку у окна"),
            (
                "Put the cup next to the book and the vase",
                "Put the cup next to the book and the vase",
            ),
            (
                "Go to your charger, but first switch off the lamp",
                "switch off the lamp, then Go to your charger",
            ),
            ("Прежде чем ехать в спальню, выключи лампу", "выключи лампу, потом ехать в спальню"),
            (
                "Bring the vase from the hall into the bath and the cup from the bath into the hall",
                "Bring the vase from the hall into the bath and Bring the cup from the bath into the \
                 hall",
            ),
            (
                "Ту кредитку, что на кухне, отвези в спальню",
                "отвези Ту кредитку на кухне в спальню",
            ),
            (
                "Одну чашку отнеси на кровать, остальные на комод",
                "отнеси Одну чашку на кровать, отнеси все остальные чашку на комод",
            ),
            ("Убери со стола всё, кроме тарелок", "Убери со стола все вещи, кроме тарелок"),
            ("Shut the door, then go and fetch the cup", "Shut the door, then fetch the cup"),
            ("Съезди на кухню и назад", "Съезди на кухню и вернись"),
            ("Положи свечу на полку, обе", "Положи все свечу на полку"),
            ("Leave the bowl where it is and bring me the cup", "bring me the cup"),
            ("After you have closed the door, come here", "close the door, then come here"),
            ("Книгу – на стол, вазу – на полку", "положи Книгу на стол, положи вазу на полку"),
            ("Put the ball where the pillow is", "Put the ball next to the pillow"),
            (
                "Leave the kitchen and go wherever the cart is",
                "Leave the kitchen and go to the cart",
            ),
        ] {
            assert_eq!(gathered(said), order, "{said}");
        }
    }
}
