//! What people say of going, looking and fetching, put into plain orders by words alone, as [`spoken`](super::spoken).

use super::Relation;
use super::said::Said;
use super::verbs::Sort;
use super::vocabulary::{Meaning, Verb};
use crate::words::Language;

/// "Search the bedroom for the medicine".
pub(super) fn searched(said: &Said) -> Option<String> {
    if !said.is(0, &["search"]) {
        return None;
    }
    let at = (2..said.keys.len().saturating_sub(1)).find(|&n| said.is(n, &["for"]))?;
    let what = said.of(&(at + 1..said.clause_end(at)));
    let place = said.of(&(1..at));
    Some(said.with(&(0..said.clause_end(at)), &format!("find {what} in {place}")))
}

/// "Go wherever the umbrella is", «поставь вазу туда, где стоит растение»: a place told by what is there; of what is
/// switched or taken, the room.
pub(super) fn where_it_is(said: &Said) -> Option<String> {
    const WHEREVER: [&str; 8] = [
        "wherever",
        "to where",
        "to wherever",
        "where",
        "туда где",
        "к тому месту где",
        "там где",
        "где",
    ];
    const WHERE: [&str; 3] = ["where", "там где", "где"];
    const IS: [&str; 9] =
        ["is", "are", "lies", "stands", "лежит", "стоит", "находится", "лежат", "стоят"];
    let mut from = 0;
    while let Some((verb, taken, kind)) = said.verb_from(from) {
        from = verb + taken;
        let next = said.verb_from(from).map_or(said.keys.len(), |(next, ..)| next);
        let (russian, english) = match Sort::of(kind) {
            Sort::Go => ("к", "to"),
            Sort::Put => ("рядом с", "next to"),
            // «включи телевизор там, где стоит кровать»
            Sort::Switch => ("в комнате, где стоит", "in the room with"),
            _ if kind == Verb::Take => ("в комнате, где стоит", "in the room with"),
            _ => continue,
        };
        let is_there = matches!(Sort::of(kind), Sort::Go | Sort::Put);
        let phrases = if is_there { &WHEREVER[..] } else { &WHERE[..] };
        let Some((at, told)) = (from..next).find_map(|n| Some((n, said.phrase(n, phrases)?)))
        else {
            continue;
        };
        let joint = |n: &usize| matches!(said.meaning(*n), Some((_, Meaning::And)));
        let end = (at + told + 1..next).find(|n| said.parted(*n) || joint(n)).unwrap_or(next);
        let kept: Vec<&str> = (at + told..end)
            .filter(|&n| !said.is(n, &IS))
            .map(|n| &said.text[said.words[n].clone()])
            .collect();
        // «в комнату, где стоит диван»: that the noun itself is meant.
        let before = |n: usize| match said.meaning(n) {
            Some((_, Meaning::Link(_))) => true,
            Some(_) => false,
            None => Sort::of(kind) == Sort::Go,
        };
        let room = (from..at).any(before);
        // «где ты был» says nothing of a thing.
        if room
            || kept.is_empty()
            || (at + told..end).any(|n| said.is(n, &["you", "ты", "i", "я", "it"]))
        {
            continue;
        }
        let link = Language::of(&said.keys[verb]).pick(russian, english);
        return Some(said.with(&(at..end), &format!("{link} {}", kept.join(" "))));
    }
    None
}

/// «Повернись к окну», "face the window": what it is to look at.
pub(super) fn faced(said: &Said) -> Option<String> {
    let mut from = 0;
    while let Some((verb, taken, kind)) = said.verb_from(from) {
        from = verb + taken;
        let link = said.meaning(from);
        let facing = matches!(
            link,
            Some((_, Meaning::FacingWall))
                | Some((
                    _,
                    Meaning::Link(super::vocabulary::Link { relation: Relation::Facing, .. })
                ))
        );
        if kind != Verb::Face || facing || from >= said.clause_end(verb) {
            continue;
        }
        let language = Language::of(&said.keys[verb]);
        let (turn, facing) =
            (language.pick("повернись", "face"), language.pick("лицом к", "facing"));
        let (length, is_link) = match link {
            Some((length, Meaning::Link(link))) => (length, link.relation == Relation::At),
            _ => (0, language == Language::English),
        };
        let seen = from + length;
        if is_link && seen < said.clause_end(verb) {
            let first = said.of(&(seen..seen + 1));
            return Some(said.with(&(verb..seen + 1), &format!("{turn} {facing} {first}")));
        }
    }
    None
}

/// «Остановись у шкафа», "stop by the kitchen": it goes there.
pub(super) fn stopping_at(said: &Said) -> Option<String> {
    let mut from = 0;
    while let Some((at, taken, kind)) = said.verb_from(from) {
        from = at + taken;
        if kind == Verb::Stop && matches!(said.meaning(from), Some((_, Meaning::Link(_)))) {
            let language = Language::of(said.of(&(at..from)));
            return Some(said.with(&(at..from), language.pick("встань", "stand")));
        }
    }
    None
}

/// "Go home": the map's houses are not meant.
pub(super) fn homeward(said: &Said) -> Option<String> {
    let (verb, taken, _) = said.verb_from(0)?;
    let at = (verb + taken..said.keys.len()).find(|&n| said.is(n, &["home"]))?;
    let next = said.meaning(at + 1).map(|(_, meaning)| meaning);
    let ends = at + 1 == said.keys.len() || said.parted(at + 1);
    let ends = ends || matches!(next, Some(Meaning::And | Meaning::Filler));
    (ends && !said.is(at - 1, &["to", "your", "the"])).then(|| said.with(&(at..at + 1), "to base"))
}

/// "Leave the house", «выйди из дома»: to the way out.
pub(super) fn out_of_the_house(said: &Said) -> Option<String> {
    const OUT: [&str; 31] = [
        "house",
        "the house",
        "this house",
        "home",
        "building",
        "the building",
        "this building",
        "apartment",
        "the apartment",
        "flat",
        "the flat",
        "of the house",
        "of the building",
        "of the apartment",
        "of the flat",
        "outside",
        "outdoors",
        "дом",
        "из дома",
        "из дому",
        "из этого дома",
        "здание",
        "из здания",
        "из этого здания",
        "квартиру",
        "из квартиры",
        "из этой квартиры",
        "наружу",
        "помещение наружу",
        "из помещения наружу",
        "на улицу",
    ];
    let mut from = 0;
    while let Some((verb, taken, kind)) = said.verb_from(from) {
        from = verb + taken;
        let Some(length) = said.phrase(from, &OUT) else { continue };
        let outside = said.is(from, &["outside", "outdoors", "наружу"]);
        let goes = kind == Verb::Leave || kind == Verb::GoTo && outside;
        let end = from + length;
        let next = said.meaning(end).map(|(_, meaning)| meaning);
        let ends = end == said.keys.len() || said.parted(end);
        if goes && (ends || matches!(next, Some(Meaning::And | Meaning::Filler))) {
            let way = Language::of(&said.keys[verb]).pick("поезжай на улицу", "go to the exit");
            return Some(said.with(&(verb..end), way));
        }
    }
    None
}

/// «Сходи принеси чашку», "go and look for the cup": going is meant by the second verb.
pub(super) fn gone(said: &Said) -> Option<String> {
    let mut from = 0;
    while let Some((verb, taken, kind)) = said.verb_from(from) {
        from = verb + taken;
        let mut next = from;
        while let Some((small, Meaning::Filler | Meaning::And)) = said.meaning(next) {
            next += small;
        }
        let then =
            matches!(said.meaning(next), Some((_, Meaning::Verb(then))) if then != Verb::Need);
        if kind == Verb::GoTo && then {
            return Some(said.with(&(verb..next + 1), said.of(&(next..next + 1))));
        }
    }
    None
}

/// «Сходи на кухню за чашкой», "go to the kitchen for the cup": it is to be brought.
pub(super) fn fetched(said: &Said) -> Option<String> {
    const INSTRUMENTAL: [&str; 11] =
        ["ой", "ей", "ом", "ем", "ами", "ями", "ью", "им", "ым", "ими", "ыми"];
    let (verb, taken, Verb::GoTo) = said.verb_from(0)? else { return None };
    if said.is(verb, &["встань", "стань", "встаньте", "стой", "спрячься"])
    {
        return None;
    }
    let end = said.clause_end(verb);
    // Up to the next order: "then look for the egg" fetches nothing.
    let goes_on =
        |n: &usize| !matches!(said.meaning(*n), Some((_, Meaning::And | Meaning::Verb(_))));
    let own = (verb + taken..end.saturating_sub(1)).take_while(goes_on);
    let at = own.into_iter().find(|&n| match said.keys[n].as_str() {
        "за" => {
            INSTRUMENTAL.iter().any(|ending| said.keys[n + 1].ends_with(ending))
                && !said.is(n + 1, &["мной", "собой", "дом"])
        }
        "for" => !said.is(n + 1, &["me", "us", "a"]) || (said.is(n + 1, &["a"]) && n + 2 < end),
        _ => false,
    })?;
    let bring = if said.keys[at] == "за" { "принеси" } else { "bring" };
    let before = if at == verb + taken { verb..at + 1 } else { at..at + 1 };
    let said_so = if at == verb + taken { bring.to_owned() } else { format!(", {bring}") };
    Some(said.with(&before, &said_so))
}

/// «Поищи, где ваза»: to find it is to know where it is.
pub(super) fn without_where(said: &Said) -> Option<String> {
    const WHERE: [&str; 2] = ["где", "where"];
    const SMALL: [&str; 14] = [
        "тут",
        "там",
        "здесь",
        "лежит",
        "стоит",
        "находится",
        "у",
        "нас",
        "the",
        "is",
        "are",
        "моя",
        "мой",
        "мои",
    ];
    let (verb, taken, Verb::Find) = said.verb_from(0)? else { return None };
    let at = verb + taken;
    if !said.is(at, &WHERE) {
        return None;
    }
    let end = said.clause_end(at);
    let kept: Vec<&str> = (at + 1..end)
        .filter(|&n| !said.is(n, &SMALL))
        .map(|n| &said.text[said.words[n].clone()])
        .collect();
    (!kept.is_empty()).then(|| {
        let kept = kept.join(" ");
        let mut text = said.text.clone();
        text.replace_range(said.words[at - 1].end..said.words[end - 1].end, &format!(" {kept}"));
        text
    })
}

/// "Go to the kitchen and back", «съезди на кухню и обратно», "take the cup to the kitchen, then back here".
pub(super) fn there_and_back(said: &Said) -> Option<String> {
    let (verb, taken, kind) = said.verb_from(0)?;
    let ends = |n: usize| n == said.keys.len() || said.parted(n);
    let joined =
        |n: usize| matches!(said.meaning(n - 1), Some((1, Meaning::And))) || said.parted(n);
    let at = (verb + taken + 1..said.keys.len()).find(|&n| {
        let back = said.is(n, &["back", "обратно", "назад"]) && joined(n);
        let here = match said.meaning(n + 1) {
            Some((taken, Meaning::Me)) => n + 1 + taken,
            _ => n + 1,
        };
        // "Take the cup to the kitchen and back": who or what comes back is not said.
        let told = kind == Verb::GoTo || here > n + 1;
        back && told && ends(here)
    })?;
    Some(said.with(&(at..at + 1), Language::of(&said.keys[at]).pick("вернись", "come back")))
}

/// "Put it where you found it", «отвези туда, откуда взял»: where it is kept.
pub(super) fn where_it_was(said: &Said) -> Option<String> {
    const WAS: [&str; 25] = [
        "where it belongs",
        "back where it belongs",
        "to where it belongs",
        "to its place",
        "туда где его место",
        "туда где ее место",
        "на его место",
        "на ее место",
        "to where it was",
        "where you found it",
        "where it was",
        "where you took it from",
        "where it came from",
        "where you got it",
        "where you got it from",
        "туда где взял",
        "туда где взяла",
        "откуда взял",
        "туда откуда взял",
        "где взял",
        "туда где она была",
        "туда где он был",
        "где была",
        "где был",
        "туда где была",
    ];
    let (verb, taken, kind) = said.verb_from(0)?;
    let (at, length) =
        (verb + taken..said.keys.len()).find_map(|n| Some((n, said.phrase(n, &WAS)?)))?;
    if !matches!(
        kind,
        Verb::Put | Verb::PutBack | Verb::Return | Verb::Move | Verb::Bring | Verb::Take
    ) {
        return None;
    }
    let back = Language::of(&said.keys[verb]).pick("верни на место", "put back");
    let what = if verb + taken < at { said.of(&(verb + taken..at)) } else { "" };
    Some(said.with(&(verb..at + length), format!("{back} {what}").trim_end()))
}

/// «Съезди на лифте на второй этаж», "take the lift to the second floor": how it gets there it knows.
pub(super) fn by_lift(said: &Said) -> Option<String> {
    const LIFT: [&str; 8] = [
        "на лифте",
        "на лифту",
        "by lift",
        "by elevator",
        "with the lift",
        "with the elevator",
        "using the lift",
        "using the elevator",
    ];
    let (verb, taken, Verb::GoTo) = said.verb_from(0)? else { return None };
    let (at, length) =
        (verb + taken..said.keys.len()).find_map(|n| Some((n, said.phrase(n, &LIFT)?)))?;
    let other = |n: usize| matches!(said.meaning(n), Some((_, Meaning::Link(_))));
    let own = verb + taken..said.clause_end(verb);
    let goes = own.into_iter().filter(|n| !(at..at + length).contains(n)).any(other);
    goes.then(|| said.without(&(at..at + length)))
}

/// "Fetch the battery; no, the toolbox", «принеси чашку, нет, тарелку»: the second of two.
pub(super) fn corrected(said: &Said) -> Option<String> {
    const NO: [&str; 12] = [
        "no",
        "or rather",
        "i mean",
        "sorry",
        "no sorry",
        "no wait",
        "нет",
        "вернее",
        "точнее",
        "ой нет",
        "нет лучше",
        "или нет лучше",
    ];
    let (verb, taken, _) = said.verb_from(0)?;
    let at = (verb + taken + 1..said.keys.len())
        .find(|&n| said.parted(n) && said.phrase(n, &NO).is_some())?;
    let rest = at + said.phrase(at, &NO)?..said.keys.len();
    if rest.is_empty() || said.verb_from(verb + taken).is_some() {
        return None;
    }
    let is_link = |n: &usize| matches!(said.meaning(*n), Some((_, Meaning::Link(_))));
    let link = (verb + taken..at).find(is_link);
    let wrong = match (is_link(&rest.start), link) {
        (true, Some(link)) => link..at,
        (true, None) => at..at,
        (false, Some(link)) => verb + taken..link,
        (false, None) => verb + taken..at,
    };
    let mut text = said.text[..said.words[at - 1].end].to_owned();
    let right = said.of(&rest);
    match wrong.is_empty() {
        true => text.push_str(&format!(" {right}")),
        false => {
            let bytes = said.words[wrong.start].start..said.words[wrong.end - 1].end;
            text.replace_range(bytes, right);
        }
    }
    Some(text)
}

/// "To the spot between the toilet and the sink": the preposition behind says it.
pub(super) fn without_spot(said: &Said) -> Option<String> {
    const SPOT: [&str; 14] = [
        "to the spot",
        "to the place",
        "to the point",
        "to a spot",
        "to a place",
        "into the space",
        "to the space",
        "into the gap",
        "in the space",
        "на место",
        "в место",
        "на то место",
        "в пространство",
        "в промежуток",
    ];
    (1..said.keys.len()).find_map(|at| {
        let taken = said.phrase(at, &SPOT)?;
        let (_, Meaning::Link(link)) = said.meaning(at + taken)? else { return None };
        let tells = matches!(
            link.relation,
            Relation::Between | Relation::NextTo | Relation::InFrontOf | Relation::Behind
        );
        let next = at + taken..at + taken + 1;
        tells.then(|| said.with(&(at..next.end), said.of(&next)))
    })
}
