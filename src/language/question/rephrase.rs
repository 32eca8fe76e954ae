//! Constructions of everyday speech put into those that the grammar reads, word by word.
//!
//! Invariant: what is put in means the same, and names nothing that was not named.

use std::borrow::Cow;

use super::constructions;
use super::mark::{Mark, Pronoun};
use super::rule::{Rule, Words};
use super::vocabulary;
use crate::words::Language;

/// A text with its everyday constructions put plainly.
pub(super) fn plain(text: &str) -> Cow<'_, str> {
    let rules: [Rule; 36] = [
        nearer_to,
        named_by_number,
        storey_of,
        of_this,
        as_listed,
        among,
        everything_but,
        numbered,
        locked,
        neither,
        everything_switched,
        asked_of_that,
        outwards,
        whence,
        any_room,
        up_or_down,
        one_of,
        storey_again,
        any_left,
        your_side,
        borne_on_it,
        on_it,
        around,
        connecting,
        numbers_joined,
        looks_at,
        borne_by_it,
        behind_ones_back,
        of_the_most,
        can_be_moved,
        lies_or_stands,
        beside_it,
        its_side,
        seen_from_there,
        leads_outside,
        put_it_down,
    ];
    let mut rules = constructions::RULES.iter().chain(&rules);
    let mut plain = Cow::Borrowed(text);
    // Each rule once, in this order; the words are taken anew only where one has changed the text.
    while let Some(next) = Words::of(&plain).and_then(|words| rules.find_map(|rule| rule(&words))) {
        plain = Cow::Owned(next);
    }
    plain
}

/// «Закрыта ли дверь на ключ?» asks whether it is locked.
fn locked(words: &Words<'_>) -> Option<String> {
    let key = (1..words.keys.len())
        .find(|n| words.is(*n, &["ключ", "замок", "засов"]) && words.is(*n - 1, &["на"]))?;
    let shut = words.keys.iter().position(|key| key.starts_with("закрыт") && key != "закрыть")?;
    let said = &words.text[words.at[shut].clone()];
    let capital = said.starts_with(char::is_uppercase);
    let ending: String = said.chars().skip("закрыт".chars().count()).collect();
    Some(words.replaced(vec![
        (shut..shut + 1, format!("{}аперт{ending}", if capital { 'З' } else { 'з' })),
        (key - 1..key + 1, String::new()),
    ]))
}

/// "Which room has neither a window nor a lamp?": without either of them.
fn neither(words: &Words<'_>) -> Option<String> {
    let neither = words.find(&["neither"])?;
    let nor = words.find(&["nor"]).filter(|nor| *nor > neither)?;
    // "… are neither apples nor plums" says nothing of what they have.
    // "Neither in the kitchen nor in the hall": not in the one, and not in the other.
    let places = |n: usize| {
        words
            .keys
            .get(n + 1..)
            .and_then(vocabulary::longest)
            .is_some_and(|(_, mark)| matches!(mark, Mark::Link(_)))
    };
    if places(neither) && places(nor) {
        let not = |n: usize, by: &str| (n..n + 1, by.to_owned());
        return Some(words.replaced(vec![not(neither, "not"), not(nor, "and not")]));
    }
    let has = neither.checked_sub(1).filter(|n| words.is(*n, &["has", "have", "contains", "with"]));
    let without = has?..neither + 1;
    Some(words.replaced(vec![(without, "without".to_owned()), (nor..nor + 1, "or".to_owned())]))
}

/// «Выключи всё в комнате», "turn everything off": all devices, where nothing is named behind.
fn everything_switched(words: &Words<'_>) -> Option<String> {
    let switches = |key: &String| {
        ["выключ", "отключ", "включ", "погас", "выруб"].iter().any(|stem| key.starts_with(stem))
            || ["turn", "switch", "power", "shut"].contains(&key.as_str())
    };
    let orders = words.keys.iter().take(4).position(switches)?;
    // A state («выключено ли всё») is asked after.
    if words.keys[orders].contains("ключен") {
        return None;
    }
    let all = words.find(&["все", "everything"]).filter(|all| *all > orders)?;
    // «Выключи все», with nothing behind it and no ё: those that were spoken of, and without any it is asked which.
    if all + 1 == words.keys.len() && words.text[words.at[all].clone()].to_lowercase() == "все" {
        return None;
    }
    let ends = ["в", "во", "на", "кроме", "здесь", "тут", "off", "on", "in", "down", "except"];
    if all + 1 < words.keys.len() && !words.is(all + 1, &ends) {
        return None;
    }
    let devices = Language::of(words.text).pick("все приборы", "all devices");
    Some(words.replaced(vec![(all..all + 1, devices.to_owned())]))
}

/// «Это далеко?», "Which room is that?": how far what was spoken of is, or in which room.
fn asked_of_that(words: &Words<'_>) -> Option<String> {
    const FAR: &[&str] = &[
        "сколько это метров",
        "сколько это в метрах",
        "а сколько это метров",
        "это далеко",
        "а это далеко",
        "далеко это",
        "далеко ли это",
        "how far is that",
        "is that far",
        "is that far away",
    ];
    const ROOM: &[&str] = &[
        "which room is that",
        "what room is that",
        "which room is that in",
        "what room is that in",
        "в какой это комнате",
        "это в какой комнате",
    ];
    let said = words.keys.join(" ");
    let asked = [
        (FAR, ("Как далеко туда?", "How far is it?")),
        (ROOM, ("В какой они комнате?", "Which room is it in?")),
    ];
    let (_, (russian, english)) = asked.into_iter().find(|(all, _)| all.contains(&&*said))?;
    Some(Language::of(words.text).pick(russian, english).to_owned())
}

/// «Откуда можно попасть в ванную?»: out of which rooms.
fn whence(words: &Words<'_>) -> Option<String> {
    let whence = words.find(&["откуда"])?;
    let goes = words.keys.iter().any(|key| {
        ["попа", "пройти", "проехать", "веду", "войти", "зайти"]
            .iter()
            .any(|stem| key.starts_with(stem))
    });
    goes.then(|| words.replaced(vec![(whence..whence + 1, "Из каких комнат".to_owned())]))
}

/// "Is there any room without windows?": of rooms, not of free space.
fn any_room(words: &Words<'_>) -> Option<String> {
    const TOLD: [&str; 9] =
        ["without", "with", "that", "which", "where", "locked", "open", "closed", "empty"];
    let any = (0..words.keys.len())
        .find(|&n| words.is(n, &["any"]) && words.is(n + 1, &["room"]) && words.is(n + 2, &TOLD))?;
    Some(words.replaced(vec![(any..any + 1, "a".to_owned())]))
}

/// "Which table has the most things on it?": on the table that is asked for.
fn on_it(words: &Words<'_>) -> Option<String> {
    let last = words.keys.len().checked_sub(1)?;
    let which = words.find(&["which", "what"])?;
    let has = words.find(&["has", "have"]).filter(|has| *has > which)?;
    let tail = last > has + 2
        && words.is(last, &["it", "them"])
        && words.is(last - 1, &["on", "in", "inside"]);
    tail.then(|| words.replaced(vec![(last - 1..last + 1, String::new())]))
}

/// "Where could I put a plate down?": the adverb stands with its verb.
fn put_it_down(words: &Words<'_>) -> Option<String> {
    let put = words.find(&["put", "set", "lay"])?;
    let down = words.find(&["down"]).filter(|down| *down > put + 1 && *down < put + 6)?;
    let verb = format!("{} down", words.keys[put]);
    Some(words.replaced(vec![(put..put + 1, verb), (down..down + 1, String::new())]))
}

/// «Дверь, которая ведёт на улицу», "the door from the kitchen to the outside": an exit.
fn leads_outside(words: &Words<'_>) -> Option<String> {
    const RELATIVE: [&str; 5] = ["that", "which", "которая", "которую", "что"];
    const LEADS: [&str; 4] = ["leads", "goes", "ведет", "выходит"];
    const LEADING: [&str; 5] = ["leading", "going", "ведущая", "ведущую", "ведущей"];
    let exit = |key: &str| {
        Some(match key {
            "door" => "outer door",
            "doors" => "outer doors",
            "дверь" => "наружный выход",
            "двери" => "наружного выхода",
            "дверью" => "наружным выходом",
            _ => return None,
        })
    };
    let (at, exit) = words.keys.iter().enumerate().find_map(|(n, key)| Some((n, exit(key)?)))?;
    // The last of the words that say whither.
    let out = (at + 1..words.keys.len()).find(|&n| {
        words.is(n, &["наружу"])
            || words.is(n, &["улицу"]) && words.is(n - 1, &["на"])
            || words.is(n, &["outside", "outdoors", "street"]) && words.is(n - 1, &["to", "the"])
            || words.is(n, &["outside", "outdoors"])
                && (words.is(n - 1, &LEADING) || words.is(n - 1, &LEADS))
    })?;
    let mut from = out;
    while from > at + 1 && words.is(from - 1, &["на", "to", "the"]) {
        from -= 1;
    }
    if words.is(from - 1, &LEADING) {
        from -= 1;
    } else if words.is(from - 1, &LEADS) {
        // «Какая дверь ведёт наружу?» asks for it.
        from = (from - 2..from).find(|&n| words.is(n, &RELATIVE))?;
    }
    // What stands between tells whence: "from the kitchen".
    let between = at + 1..from;
    if between.len() > 4 || (!between.is_empty() && !words.is(between.start, &["from", "из", "с"]))
    {
        return None;
    }
    let start = words.at[at].start;
    let kept = &words.text[words.at[at].end..words.at[from - 1].end];
    let mut text = words.text.to_owned();
    let rest = text[words.at[out].end..].trim_start_matches(',').to_owned();
    text.truncate(start);
    Some(format!("{text}{exit}{kept}{rest}"))
}

/// "What is to its left?", "on its right side": to the left of it.
fn its_side(words: &Words<'_>) -> Option<String> {
    let its = (1..words.keys.len()).find(|&n| {
        words.is(n, &["its"])
            && words.is(n - 1, &["to", "on", "at"])
            && words.is(n + 1, &["left", "right"])
    })?;
    let end = its + 2 + usize::from(words.is(its + 2, &["side", "hand"]));
    let side = &words.keys[its + 1];
    Some(words.replaced(vec![(its - 1..end, format!("to the {side} of it"))]))
}

/// "What can you see from there?": from where the robot is.
fn seen_from_there(words: &Words<'_>) -> Option<String> {
    let see = words.keys.iter().position(|key| key == "see" || key == "видишь")?;
    let (from, to) = match (words.is(see + 1, &["from"]), words.is(see + 1, &["оттуда"])) {
        (true, _) if words.is(see + 2, &["there", "here"]) => (see + 1, see + 3),
        (_, true) => (see + 1, see + 2),
        _ => return None,
    };
    let mut text = words.text.to_owned();
    text.replace_range(words.at[from - 1].end..words.at[to - 1].end, "");
    Some(text)
}

/// «Что с ней рядом?»: beside it.
fn beside_it(words: &Words<'_>) -> Option<String> {
    let beside = (2..words.keys.len()).find(|n| {
        words.is(*n, &["рядом"])
            && words.is(*n - 1, &["ней", "ним", "нею", "ними"])
            && words.is(*n - 2, &["с"])
    })?;
    let it = &words.keys[beside - 1];
    Some(words.replaced(vec![(beside - 2..beside + 1, format!("рядом с {it}"))]))
}

/// «Назови по одной вещи из каждой комнаты», "Tell me two things in each room": so many are named.
fn named_by_number(words: &Words<'_>) -> Option<String> {
    const ONE: [&str; 5] = ["одной", "одному", "одну", "один", "одно"];
    let told = vocabulary::longest(&words.keys);
    let listed = match told {
        Some((taken, Mark::List)) => taken,
        _ if words.is(0, &["tell"]) && words.is(1, &["me"]) => 2,
        _ => return None,
    };
    let each = usize::from(words.is(listed, &["по"]));
    let number = words.keys.get(listed + each)?;
    let one = ONE.contains(&number.as_str());
    let by = match one {
        true => "одна",
        false => words.text.get(words.at[listed + each].clone())?,
    };
    let counts = one || number == "one" || crate::question::grammar::number_of(number).is_some();
    let said = match told {
        Some((_, Mark::List)) => words.part(0..listed)?,
        _ => "Name",
    };
    counts
        .then(|| words.replaced(vec![(0..listed + each + 1, format!("{said} {by}"))]))
        .filter(|text| text != words.text)
}

/// «Какая дверь ведёт наружу?»: to the street.
fn outwards(words: &Words<'_>) -> Option<String> {
    let out = words.find(&["наружу"])?;
    Some(words.replaced(vec![(out..out + 1, "на улицу".to_owned())]))
}

/// «Спускайся!»: to the storey below.
fn up_or_down(words: &Words<'_>) -> Option<String> {
    const UP: [&str; 4] = ["поднимись", "поднимитесь", "поднимайся", "поднимайтесь"];
    const DOWN: [&str; 4] = ["спустись", "спуститесь", "спускайся", "спускайтесь"];
    let last = words.keys.len() - 1;
    let whither = match () {
        () if words.is(last, &UP) => "вверх",
        () if words.is(last, &DOWN) => "вниз",
        () => return None,
    };
    let said = &words.text[words.at[last].clone()];
    Some(words.replaced(vec![(last..last + 1, format!("{said} {whither}"))]))
}

/// «одну из тарелок»: one plate, whichever.
fn one_of(words: &Words<'_>) -> Option<String> {
    const ONE: [&str; 6] = ["один", "одна", "одно", "одну", "любую", "любой"];
    let one = (0..words.keys.len()).find(|n| words.is(*n, &ONE) && words.is(*n + 1, &["из"]))?;
    // «одну из них»: of those that were told.
    let named = one + 2 < words.keys.len() && !words.is(one + 2, &["них", "этих", "тех"]);
    named.then(|| {
        let said = &words.text[words.at[one].clone()];
        words.replaced(vec![(one..one + 2, said.to_owned())])
    })
}

/// «Что в кладовой первого этажа?»: on the first floor.
fn storey_of(words: &Words<'_>) -> Option<String> {
    const ORDER: [(&str, &str); 6] = [
        ("первого", "первом"),
        ("второго", "втором"),
        ("третьего", "третьем"),
        ("четвертого", "четвертом"),
        ("пятого", "пятом"),
        ("последнего", "последнем"),
    ];
    let floor = words.find(&["этажа"]).filter(|floor| *floor >= 2)?;
    let (_, placed) = ORDER.iter().find(|(own, _)| words.is(floor - 1, &[own]))?;
    // «до первого этажа», «план первого этажа»
    let before = ["до", "с", "от", "из", "около", "план", "карта", "возле", "у", "кроме", "для"];
    (!words.is(floor - 2, &before))
        .then(|| words.replaced(vec![(floor - 1..floor + 1, format!("на {placed} этаже"))]))
}

/// «Сколько из этого фруктов?», "how much of this is fruit": of them.
fn of_this(words: &Words<'_>) -> Option<String> {
    const THIS: [&str; 5] = ["из всего этого", "из этого", "of all this", "of this", "of that"];
    if !words.is(0, &["сколько", "какие", "что", "how", "which", "what"]) {
        return None;
    }
    THIS.iter().find_map(|this| {
        let at = words.phrase(1, this)?;
        let taken = this.split(' ').count();
        let ends = at + taken;
        // "of this room" names its own.
        // «Что из этого есть на кухне: диван, кровать?»: of what is listed behind.
        if words.text.contains(':') {
            return Some(words.replaced(vec![(at..ends, String::new())]));
        }
        let alone = words.is(0, &["сколько", "какие", "что"])
            || ends == words.keys.len()
            || words.is(ends, &["is", "are", "can", "were"]);
        let them = Language::of(words.text).pick("из них", "of them");
        alone.then(|| words.replaced(vec![(at..ends, them.to_owned())]))
    })
}

/// "Which of the books you listed is red?": of these books.
fn as_listed(words: &Words<'_>) -> Option<String> {
    let names = |noun: &usize| {
        let said = vocabulary::longest(&words.keys[*noun..=*noun]);
        said.is_none_or(|(_, mark)| mark == Mark::One)
    };
    let (noun, taken) = (0..words.keys.len()).filter(names).find_map(|noun| {
        Some((noun, vocabulary::taken_by(Mark::Listed, words.keys.get(noun + 1..)?)?))
    })?;
    let article = noun.checked_sub(1).filter(|n| words.is(*n, &["the", "all"]));
    let named = words.text.get(words.at[noun].clone())?;
    let those = format!("{} {named}", Language::of(named).pick("эти", "these"));
    Some(words.replaced(vec![(article.unwrap_or(noun)..noun + 1 + taken, those)]))
}

/// "Are there books among them?", «Есть ли среди этих вещей книги?»: of them. Among the chairs is a place.
fn among(words: &Words<'_>) -> Option<String> {
    let among = words.find(&["среди", "among", "amongst"])?;
    let told = words.keys.get(among + 1..)?;
    let pronoun = matches!(vocabulary::longest(told), Some((_, Mark::Pronoun(Pronoun::They))));
    let of = Language::of(&words.keys[among]).pick("из", "of");
    (pronoun || vocabulary::taken_by(Mark::These, told).is_some())
        .then(|| words.replaced(vec![(among..among + 1, of.to_owned())]))
}

/// "Which chair is nearer the window?": to it.
fn nearer_to(words: &Words<'_>) -> Option<String> {
    let near = words.find(&["nearer", "closer", "nearest", "closest"])?;
    let article = words.is(near + 1, &["the", "my", "your"]) && near + 2 < words.keys.len();
    // "Which is nearer the sofa or the bed?" compares the two.
    let joined = words.find(&["or", "of", "to"]).is_some_and(|joint| joint > near);
    let gap = words.text.get(words.at[near].end..words.at.get(near + 1)?.start)?;
    let asks = near > 0 && !words.is(near - 1, &["the", "a"]) && gap.trim().is_empty();
    (article && asks && !joined)
        .then(|| words.replaced(vec![(near..near + 1, format!("{} to", words.keys[near]))]))
}

/// "What else is there but an apple?", "all lamps but not the lamp on the desk": except the apple.
fn everything_but(words: &Words<'_>) -> Option<String> {
    const OTHER: [&str; 8] =
        ["other", "else", "everything", "all", "every", "each", "anything", "nothing"];
    let but = words.find(&["but"]).filter(|but| *but > 0 && *but + 1 < words.keys.len())?;
    let other = words.find(&OTHER).filter(|other| *other < but)?;
    let comma = words.text[words.at[other].end..words.at[but].start].contains([',', '.', ';']);
    let ends = if words.is(but + 1, &["not"]) { but + 2 } else { but + 1 };
    // "rooms with beds but no lamps" are without lamps.
    (!comma && !words.is(ends, &["no", "where", "what", "is", "are", "i", "how", "which"]))
        .then(|| words.replaced(vec![(but..ends, "except".to_owned())]))
}

/// «процедурная номер два», "room number 5": the number of its name.
fn numbered(words: &Words<'_>) -> Option<String> {
    let number = (1..words.keys.len() - 1).find(|n| words.is(*n, &["номер", "number"]))?;
    let counted = crate::question::grammar::number_of(&words.keys[number + 1])?;
    (words.keys[number - 1].chars().count() > 2 && !words.is(number - 1, &["the", "what"]))
        .then(|| words.replaced(vec![(number..number + 2, counted.to_string())]))
}

/// «На первом этаже или на втором?», "on the first floor or the second": the floor said again.
fn storey_again(words: &Words<'_>) -> Option<String> {
    const ORDER: [&str; 10] = [
        "первом",
        "втором",
        "третьем",
        "четвертом",
        "пятом",
        "first",
        "second",
        "third",
        "fourth",
        "fifth",
    ];
    let floor = words.find(&["этаже", "floor", "storey"])?;
    let or = words.find(&["или", "or"]).filter(|or| *or > floor)?;
    let last = words.keys.len() - 1;
    (last > or && words.is(last, &ORDER)).then(|| {
        let said = &words.text[words.at[last].clone()];
        let noun = &words.text[words.at[floor].clone()];
        words.replaced(vec![(last..last + 1, format!("{said} {noun}"))])
    })
}

/// "to your left", "on your right": to the left of you.
fn your_side(words: &Words<'_>) -> Option<String> {
    let side = (2..words.keys.len()).find(|&n| {
        words.is(n, &["left", "right"])
            && words.is(n - 1, &["your"])
            && words.is(n - 2, &["to", "on"])
    })?;
    let said = &words.text[words.at[side].clone()];
    Some(words.replaced(vec![(side - 2..side + 1, format!("to the {said} of you"))]))
}

/// "Which chair has something on it?": which is occupied.
fn borne_on_it(words: &Words<'_>) -> Option<String> {
    let has = (0..words.keys.len()).find(|&n| {
        words.is(n, &["has", "have"])
            && words.is(n + 1, &["something", "anything", "nothing"])
            && words.is(n + 2, &["on", "in"])
            && words.is(n + 3, &["it", "them"])
    })?;
    let be = if words.is(has, &["has"]) { "is" } else { "are" };
    let state = if words.is(has + 1, &["nothing"]) { "empty" } else { "occupied" };
    Some(words.replaced(vec![(has..has + 4, format!("{be} {state}"))]))
}

/// «Что тебя окружает?»: what is around you.
fn around(words: &Words<'_>) -> Option<String> {
    let verb = words.find(&["окружает", "окружают"])?;
    let before = verb.checked_sub(1).filter(|n| words.is(*n, &["тебя", "его", "ее", "их", "вас"]));
    Some(match before {
        Some(whom) => {
            let said = &words.text[words.at[whom].clone()];
            words.replaced(vec![(whom..verb + 1, format!("вокруг {said}"))])
        }
        None => words.replaced(vec![(verb..verb + 1, "вокруг".to_owned())]),
    })
}

/// «Дверь, соединяющая кухню и спальню», "the door that connects the kitchen to the bedroom": between the two.
fn connecting(words: &Words<'_>) -> Option<String> {
    const WHICH: [&str; 6] = ["that", "which", "которая", "которую", "которые", "что"];
    const JOINS: [&str; 10] = [
        "connects",
        "joins",
        "links",
        "separates",
        "соединяет",
        "соединяют",
        "связывает",
        "связывают",
        "разделяет",
        "разделяют",
    ];
    const JOINING: [&str; 16] = [
        "connecting",
        "joining",
        "linking",
        "separating",
        "соединяющую",
        "соединяющая",
        "соединяющей",
        "соединяющие",
        "связывающую",
        "связывающая",
        "связывающей",
        "связывающие",
        "разделяющую",
        "разделяющая",
        "разделяющей",
        "разделяющие",
    ];
    let (at, from) = (1..words.keys.len()).find_map(|n| {
        let which = words.is(n, &WHICH) && words.is(n + 1, &JOINS);
        (which || words.is(n, &JOINING)).then_some((n, n + 1 + usize::from(which)))
    })?;
    // "Which doors are connecting …?" asks for them.
    let asks =
        words.is(at - 1, &["is", "are", "doors", "двери"]) && words.is(0, &["which", "какие"]);
    let joints = ["and", "to", "with", "from", "и", "с", "со", "от"];
    let second = (from + 1..words.keys.len()).find(|&n| words.is(n, &joints))?;
    if asks || second + 1 == words.keys.len() {
        return None;
    }
    let language = Language::of(&words.keys[at]);
    let mut text = words.text.to_owned();
    text.replace_range(words.at[second].clone(), language.pick("и", "and"));
    let between = format!(" {}", language.pick("между", "between"));
    text.replace_range(words.at[at - 1].end..words.at[from - 1].end, &between);
    Some(text)
}

/// «Стулья 3 и 4», "chairs 3 and 4": the noun said again before the second number.
fn numbers_joined(words: &Words<'_>) -> Option<String> {
    let number = |n: usize| words.keys.get(n).is_some_and(|key| key.parse::<u32>().is_ok());
    let noun = |n: usize| words.keys[n].chars().all(char::is_alphabetic);
    let joint = (2..words.keys.len()).find(|&n| {
        words.is(n, &["и", "или", "and", "or"])
            && number(n - 1)
            && noun(n - 2)
            && number(n + 1)
            && words.keys[n - 2].chars().count() > 2
    })?;
    let said = &words.text[words.at[joint - 2].clone()];
    let second = &words.text[words.at[joint + 1].clone()];
    Some(words.replaced(vec![(joint + 1..joint + 2, format!("{said} {second}"))]))
}

/// "What does the stand have on it?": what is on the stand.
fn borne_by_it(words: &Words<'_>) -> Option<String> {
    let last = words.keys.len().checked_sub(1)?;
    let what = words.find(&["what"]).filter(|n| words.is(*n + 1, &["does", "do"]))?;
    let tail = words.is(last, &["it", "them"])
        && last >= what + 5
        && words.is(last - 1, &["on", "in", "inside", "under"])
        && words.is(last - 2, &["have", "has"]);
    let rel = tail.then(|| words.text[words.at[last - 1].clone()].to_owned())?;
    Some(words.replaced(vec![
        (what + 1..what + 2, format!("is {rel}")),
        (last - 2..last + 1, String::new()),
    ]))
}

/// «Что у тебя за спиной?»: what is behind you.
fn behind_ones_back(words: &Words<'_>) -> Option<String> {
    let back = words.find(&["спиной"]).filter(|n| *n > 1 && words.is(*n - 1, &["за"]))?;
    let whose = words.is(back - 2, &["тебя", "вас", "твоей", "вашей"]);
    let from = if back > 2 && words.is(back - 3, &["у"]) { back - 3 } else { back - 2 };
    whose.then(|| words.replaced(vec![(from..back + 1, "позади тебя".to_owned())]))
}

/// «три самых высоких шкафа»: the superlative as it stands alone.
fn of_the_most(words: &Words<'_>) -> Option<String> {
    let most = words.find(&["самых"])?;
    let next = words.text.get(words.at.get(most + 1)?.clone())?;
    let stem = next.strip_suffix("их").map(|stem| (stem, "ие"));
    let (stem, end) = stem.or_else(|| next.strip_suffix("ых").map(|stem| (stem, "ые")))?;
    Some(words.replaced(vec![(most..most + 2, format!("самые {stem}{end}"))]))
}

/// "Which things can I move?": which can be moved.
fn can_be_moved(words: &Words<'_>) -> Option<String> {
    let last = words.keys.len().checked_sub(1)?;
    let moved = last > 2
        && words.is(last, &["move", "carry"])
        && words.is(last - 1, &["i", "you", "we"])
        && words.is(last - 2, &["can", "could"]);
    let verb = if words.is(last, &["move"]) { "can be moved" } else { "can be carried" };
    moved.then(|| words.replaced(vec![(last - 2..last + 1, verb.to_owned())]))
}

/// «Смотрит ли кресло на телевизор?»: whether it is turned to it.
fn looks_at(words: &Words<'_>) -> Option<String> {
    let looks = words.find(&["смотрит", "смотрят"])?;
    let at = (looks + 1..words.keys.len()).find(|n| words.is(*n, &["на", "в"]))?;
    Some(
        words.replaced(vec![
            (looks..looks + 1, "стоит".to_owned()),
            (at..at + 1, "лицом к".to_owned()),
        ]),
    )
}

/// «Книга лежит или стоит?», "Is the book lying or standing?": how it is turned, where nothing else is asked.
fn lies_or_stands(words: &Words<'_>) -> Option<String> {
    const LIES: [&str; 5] = ["лежит", "лежат", "lying", "flat", "lie"];
    const STANDS: [&str; 6] = ["стоит", "стоят", "standing", "upright", "stand", "стоймя"];
    let either = |n: usize| words.is(n, &LIES) || words.is(n, &STANDS);
    let or = words.find(&["или", "or"]).filter(|or| *or > 0)?;
    let both =
        either(or - 1) && either(or + 1) && words.is(or - 1, &LIES) != words.is(or + 1, &LIES);
    let asks = ["что", "где", "кто", "какой", "какая", "какие", "какое", "what", "where", "which"];
    let whole = both && !(0..words.keys.len()).any(|n| words.is(n, &asks));
    let turned = |n: usize| match (words.is(n, &LIES), Language::of(words.text)) {
        (true, Language::Russian) => "горизонтальный",
        (false, Language::Russian) => "вертикальный",
        (true, Language::English) => "horizontal",
        (false, Language::English) => "vertical",
    };
    let by = |n: usize| (n..n + 1, turned(n).to_owned());
    whole.then(|| words.replaced(vec![by(or - 1), by(or + 1)]))
}

/// "Do I have any apples left?"
fn any_left(words: &Words<'_>) -> Option<String> {
    let last = words.keys.len() - 1;
    let any = words.find(&["any", "some", "many", "much"])?;
    (any + 1 < last && words.is(last, &["left"]))
        .then(|| words.replaced(vec![(last..last + 1, String::new())]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everyday_constructions_become_plain_ones() {
        let check = |text: &str, expected: &str| assert_eq!(plain(text), expected, "{text}");
        check("Закрыта ли дверь на ключ?", "Заперта ли дверь ?");
        check("Закрой дверь на ключ", "Закрой дверь на ключ");
        check("Which room has neither a lamp nor a bed?", "Which room without a lamp or a bed?");
        check("Выключи всё в спальне", "Выключи все приборы в спальне");
        check("Выключи все лампы", "Выключи все лампы");
        check("Turn everything off", "Turn all devices off");
        check("Это далеко?", "Как далеко туда?");
        check("Which room is that?", "Which room is it in?");
        check("Какая дверь ведёт наружу?", "Какая дверь ведёт на улицу?");
        check("Откуда можно попасть в ванную?", "Из каких комнат можно попасть в ванную?");
        check("Is there any room without windows?", "Is there a room without windows?");
        check("Is there any room on the desk?", "Is there any room on the desk?");
        check("Откуда ты это знаешь?", "Откуда ты это знаешь?");
        check("Which table has the most things on it?", "Which table has the most things ?");
        check("Which chair has nothing on it?", "Which chair is empty?");
        check("Теперь спускайся!", "Теперь спускайся вниз!");
        check("Отнеси одну из тарелок в зал", "Отнеси одну тарелок в зал");
        check(
            "Open the door that connects the hall to the lab",
            "Open the door between the hall and the lab",
        );
        check(
            "Какого цвета дверь, соединяющая холл с кухней?",
            "Какого цвета дверь между холл и кухней?",
        );
        check("Закрыта ли дверь, ведущая на улицу?", "Закрыта ли наружный выход?");
        check(
            "Is the door from the hall to the outside locked?",
            "Is the outer door from the hall locked?",
        );
        check("What is to its left?", "What is to the left of it?");
        check("Какая дверь соединяет холл с кухней?", "Какая дверь соединяет холл с кухней?");
        check("Стулья 3 и 4 белые?", "Стулья 3 и Стулья 4 белые?");
        check("4 стула и 2 стола", "4 стула и 2 стола");
        check("Смотрит ли кресло на диван?", "стоит ли кресло лицом к диван?");
        check("What does the TV stand have on it?", "What is on the TV stand ?");
        check("Что у тебя за спиной?", "Что позади тебя?");
        check("Назови три самых высоких шкафа", "Назови три самые высокие шкафа");
        check("Which things can I move?", "Which things can be moved?");
        check("Книга-1 лежит или стоит?", "Книга-1 горизонтальный или вертикальный?");
        check("Что лежит или стоит на столе?", "Что лежит или стоит на столе?");
        check("", "");
    }
}
