//! More constructions put plainly, by their words in order: what a room contains, doors to the outside, what shares a
//! place with a thing, made beds. The first rules of [`super::rephrase`].

use super::rule::{Rule, Words};
use crate::words::{Case, Language, NounPhrase, WordHints, phrase_at};

pub(super) const RULES: [Rule; 16] = [
    price_of_it,
    on_itself,
    contracted,
    framed,
    done_to_it,
    connects_with,
    nearer_from,
    but_no,
    same_as_where,
    something_there,
    in_them,
    both_of,
    doors_to_open,
    on_its_walls,
    made_bed,
    is_free,
];

/// «Сколько он стоит?» asks for its price, and counts nothing.
fn price_of_it(words: &Words<'_>) -> Option<String> {
    let much = words.find(&["сколько"])?;
    let one = words.is(much + 1, &["он", "она", "оно"]) && words.is(much + 2, &["стоит"]);
    let said = |n: usize| words.text[words.at[n].clone()].to_owned();
    one.then(|| {
        words.replaced(vec![
            (much + 1..much + 2, said(much + 2)),
            (much + 2..much + 3, said(much + 1)),
        ])
    })
}

/// «Я дверь закрыл?»: whether it is closed.
fn done_to_it(words: &Words<'_>) -> Option<String> {
    super::done::as_it_is(words.text)
}

/// Sentences with one gap, by what stands before and behind it, and the same of the sentence that is meant: what stands
/// in the one goes into the other.
const FRAMES: [(&str, &str, &str, &str); 67] = [
    ("я правильно понимаю что", "", "правда ли, что", ""),
    ("правильно ли я понимаю что", "", "правда ли, что", ""),
    ("am i right that", "", "is it true that", ""),
    ("do you think", "", "is it true that", ""),
    ("i bet", "", "is it true that", ""),
    ("any chance there s", "", "is there", ""),
    ("any chance there is", "", "is there", ""),
    ("any chance there are", "", "are there", ""),
    ("правда что", "", "правда ли, что", ""),
    ("верно что", "", "верно ли, что", ""),
    ("правда ведь что", "", "правда ли, что", ""),
    ("пройду ли я", "", "можно ли пройти", ""),
    ("попаду ли я", "", "можно ли попасть", ""),
    ("доберусь ли я", "", "можно ли добраться", ""),
    ("смогу ли я пройти", "", "можно ли пройти", ""),
    ("смогу ли я попасть", "", "можно ли попасть", ""),
    ("what do we have more of", "", "are there more", ""),
    ("what is there more of", "", "are there more", ""),
    ("what are there more of", "", "are there more", ""),
    ("which things share a surface with", "", "what else is on the same piece of furniture as", ""),
    ("what shares a surface with", "", "what else is on the same piece of furniture as", ""),
    ("which doors lead outside", "", "which are the exits", ""),
    ("what doors lead outside", "", "which are the exits", ""),
    ("which door leads outside", "", "where is the exit", ""),
    ("which of the doors lead outside", "", "which are the exits", ""),
    ("which of the doors leads outside", "", "which are the exits", ""),
    ("which of them lead outside", "", "which of them are outer doors", ""),
    ("which of them leads outside", "", "which of them are outer doors", ""),
    ("which of those lead outside", "", "which of them are outer doors", ""),
    ("where do you keep", "", "where is", ""),
    ("where do we keep", "", "where is", ""),
    ("where do they keep", "", "where is", ""),
    ("зачем нужен", "", "для чего нужен", ""),
    ("зачем нужна", "", "для чего нужна", ""),
    ("зачем нужно", "", "для чего нужно", ""),
    ("зачем нужны", "", "для чего нужны", ""),
    ("does any door lead outside", "", "is there an exit", ""),
    ("do any doors lead outside", "", "is there an exit", ""),
    ("does a door lead outside", "", "is there an exit", ""),
    ("where should i look for", "", "where is", ""),
    ("what door do i take to go from", "", "which door leads from", ""),
    ("which door do i take to go from", "", "which door leads from", ""),
    ("how do i get outside from", "", "how do i get from", "to the exit"),
    ("how do i get outside", "", "how do i get to the exit", ""),
    ("how do i leave the house from", "", "how do i get from", "to the exit"),
    ("how can i get outside from", "", "how do i get from", "to the exit"),
    ("what does", "contain", "what is in", ""),
    ("what do", "contain", "what is in", ""),
    ("which things does", "contain", "what is in", ""),
    ("what else is where", "is", "what else is on the same piece of furniture as", ""),
    ("what is lying where", "is", "what else is on the same piece of furniture as", ""),
    ("which rooms does", "connect", "what does", "join"),
    ("which rooms does", "join", "what does", "join"),
    ("can i go outside from", "", "can i get from", "to the exit"),
    ("can one go outside from", "", "can i get from", "to the exit"),
    ("can i leave the house directly from", "", "is there an exit in", ""),
    ("can i leave the house from", "", "can i get from", "to the exit"),
    ("can i get outside from", "", "can i get from", "to the exit"),
    ("ведет ли какая нибудь дверь на улицу", "", "есть ли выход", ""),
    ("ведет ли какая нибудь дверь наружу", "", "есть ли выход", ""),
    ("можно ли выйти из дома прямо с", "", "есть ли выход с", ""),
    ("можно ли выйти из дома прямо из", "", "есть ли выход из", ""),
    ("что содержит", "", "что внутри", ""),
    ("где искать", "", "где", ""),
    ("где мне искать", "", "где", ""),
    ("что еще лежит там же где и", "", "что ещё лежит на том же предмете мебели что и", ""),
    ("что еще лежит там же где", "", "что ещё лежит на том же предмете мебели что и", ""),
];

/// "Does the sofa have a pillow on it?": a sofa with a pillow; "it" is the sofa of the same sentence.
fn on_itself(words: &Words<'_>) -> Option<String> {
    let end = words.keys.len();
    let has = words.find(&["have", "has"]).filter(|has| *has > 1 && has + 3 < end)?;
    let asks = words.is(0, &["does", "do"]);
    let itself = words.is(end - 2, &["on", "in"]) && words.is(end - 1, &["it", "them"]);
    const ANY: [&str; 4] = ["something", "anything", "nothing", "things"];
    let nothing = words.keys[has..].iter().any(|key| ANY.contains(&key.as_str()));
    (asks && itself && !nothing).then(|| format!("{}?", &words.text[..words.at[end - 3].end]))
}

/// "Where'd I leave my keys?": where did I.
fn contracted(words: &Words<'_>) -> Option<String> {
    const PERSONS: [&str; 7] = ["i", "you", "we", "they", "he", "she", "the"];
    let asks = words.find(&["where", "how", "why", "when"])?;
    let said = words.is(asks + 1, &["d"]) && words.is(asks + 2, &PERSONS);
    let cut = said.then(|| words.at[asks].end..words.at[asks + 1].end)?;
    let mut text = words.text.to_owned();
    text.replace_range(cut, " did");
    Some(text)
}

fn framed(words: &Words<'_>) -> Option<String> {
    FRAMES.iter().find_map(|(start, end, before, after)| {
        let from = phrase_at(&words.keys, 0, start)?;
        let to = words.keys.len() - usize::from(!end.is_empty());
        let ends = end.is_empty() || words.is(to, &[end]);
        let gap = words.part(from..to).unwrap_or_default();
        ends.then(|| format!("{}?", format!("{before} {gap} {after}").trim_end()))
    })
}

/// "Which door connects the hall with the lab?": and the lab.
fn connects_with(words: &Words<'_>) -> Option<String> {
    let verb = words.find(&["connects", "connect", "connecting", "joins", "join", "links"])?;
    let with = words.phrase(verb, "with")?;
    Some(words.replaced(vec![(with..with + 1, "and".to_owned())]))
}

/// «От хлеба до чашки ближе, чем до яблока?»: is the cup nearer to the bread than the apple.
fn nearer_from(words: &Words<'_>) -> Option<String> {
    let to = words.phrase(1, "до").filter(|_| words.is(0, &["от"]))?;
    let nearer = words.find(&["ближе", "дальше"]).filter(|nearer| *nearer > to)?;
    let than = words.phrase(nearer, "чем до")?;
    let (first, second) = (words.part(1..to)?, words.part(to + 1..nearer)?);
    let third = words.part(than + 2..words.keys.len())?;
    Some(format!("{first} {} к {second}, чем к {third}?", words.keys[nearer]))
}

/// «на том же столе, где кофеварка»: the same as that with it.
fn same_as_where(words: &Words<'_>) -> Option<String> {
    let same = words.phrase(1, "же").filter(|n| words.is(n - 1, &["том", "той", "тех"]))?;
    let place = words.phrase(same, "где")?;
    let partner = place + 1 + usize::from(words.is(place + 1, &["и"]));
    let rest = &words.text[words.at.get(partner)?.start..];
    Some(format!("{} что и {rest}", &words.text[..words.at[place - 1].end]))
}

/// "Which rooms have a bed but no lamp?", «В каких комнатах есть кровать, но нет лампы?»: those with one, without the
/// other.
fn but_no(words: &Words<'_>) -> Option<String> {
    let end = words.keys.len();
    let begins = |all: &[&str]| all.iter().find_map(|start| phrase_at(&words.keys, 0, start));
    if let Some(rooms) = begins(&["which rooms", "what rooms", "which room", "what room"]) {
        let have = words.find(&["have", "has"]).filter(|have| *have >= rooms)?;
        let (with, without) = match words.phrase(have, "but no") {
            Some(but) => (have + 1..but, but + 2..end),
            // "Which rooms with a bed have no lamp?"
            None if words.is(rooms, &["with"]) && words.is(have + 1, &["no"]) => {
                (rooms + 1..have, have + 2..end)
            }
            None => return None,
        };
        let (with, without) = (words.part(with)?, words.part(without)?);
        return Some(format!("Which rooms with {with} are without {without}?"));
    }
    let asked = begins(&["в каких комнатах есть", "в какой комнате есть"])?;
    let but = ["но нет", "а нет", "зато нет"].iter().find_map(|but| words.phrase(asked, but))?;
    let (with, without) = (words.part(asked..but)?, words.part(but + 2..end)?);
    let with = NounPhrase::parse(with, &WordHints::default());
    let with = with.form(Case::Instrumental, with.number());
    Some(format!("Комнаты с {with} без {without}"))
}

/// «На каких стульях что-нибудь лежит?»: things lie.
fn something_there(words: &Words<'_>) -> Option<String> {
    let which = words.is(0, &["на"]) && words.is(1, &["каком", "какой", "каких"]);
    let all = ["что нибудь", "что то", "что либо"];
    let thing = all.iter().find_map(|thing| words.phrase(2, thing)).filter(|_| which)?;
    let verb = words.find(&["лежит", "стоит", "есть", "находится"])?;
    let end = thing.min(verb);
    let table = words.part(0..end).filter(|_| end > 2 && words.keys.len() <= end + 3)?;
    Some(format!("{table} есть вещи?"))
}

/// "How many rooms have paintings in them?": in them says nothing more.
fn in_them(words: &Words<'_>) -> Option<String> {
    let last = words.keys.len() - 1;
    let ends = last > 2 && words.is(last, &["them", "it"]) && words.is(last - 1, &["in", "inside"]);
    let asked =
        words.part(0..last - usize::from(ends)).filter(|_| ends && of_having_rooms(words))?;
    Some(format!("{asked}?"))
}

/// "both a bed and a desk": a bed and a desk.
fn both_of(words: &Words<'_>) -> Option<String> {
    let both = words.find(&["both"])?;
    let said = words.is(both + 1, &["a", "an"]) || of_having_rooms(words);
    // "don't have both a bed and a desk": one of them they may have.
    if words.find(&["t", "not"]).is_some_and(|not| not < both) {
        return None;
    }
    words.phrase(both, "and").filter(|_| said && both + 1 < words.keys.len())?;
    let (before, rest) =
        (&words.text[..words.at[both].start], &words.text[words.at[both + 1].start..]);
    Some(format!("{before}{rest}"))
}

/// "Which rooms have …?"
fn of_having_rooms(words: &Words<'_>) -> bool {
    words.find(&["rooms", "room"]).is_some() && words.find(&["have", "has", "contain"]).is_some()
}

/// «А двери открывать придётся?», "Will I need to open a door?": in the words of the vocabulary.
fn doors_to_open(words: &Words<'_>) -> Option<String> {
    const MUST: &[&str] = &["must", "have", "need", "придется", "нужно", "надо", "понадобится"];
    let must = words.find(MUST)?;
    let open = words.find(&["open", "открывать"])?;
    let door = words.find(&["door", "doors", "дверь", "двери", "дверей"])?;
    let russian = Language::of(words.text) == Language::Russian;
    // "Do I have to", "will we need to"
    let asked = must.checked_sub(2).filter(|n| words.is(*n, &["do", "does", "will", "would"]));
    let ends = [must, open, door];
    let (first, last) = (ends.into_iter().min()?, ends.into_iter().max()?);
    let asks_which = words.find(&["какую", "какие", "сколько", "which", "many"]).is_some();
    if asks_which || last - first > 5 || !(russian || must < open && open < door) {
        return None;
    }
    let plain = if russian {
        "придётся открывать двери"
    } else {
        "have to open any doors"
    };
    Some(words.replaced(vec![(asked.unwrap_or(first)..last + 1, plain.to_owned())]))
}

/// "Which room has the most pictures on its walls?": pictures in a room hang on its walls.
fn on_its_walls(words: &Words<'_>) -> Option<String> {
    let walls = words.find(&["walls", "wall", "стенах", "стене"])?;
    let its = walls.checked_sub(2).filter(|_| words.is(walls - 1, &["its", "своих"]))?;
    let which = words.find(&["which", "what", "какой", "какая"]).is_some();
    let room = words.find(&["room", "комната", "комнате"]).is_some();
    let on = words.is(its, &["on", "на"]);
    (on && which && room).then(|| words.replaced(vec![(its..walls + 1, String::new())]))
}

/// «Кровать застелена?», "Are all the beds made?": a made bed is kept as a clean one.
fn made_bed(words: &Words<'_>) -> Option<String> {
    const BEDS: &[&str] = &["bed", "beds", "кровать", "кровати", "постель", "постели"];
    const MADE: &[(&str, &str)] = &[
        ("застелен", "чист"),
        ("заправлен", "чист"),
        ("убран", "чист"),
        ("незастелен", "грязн"),
        ("незаправлен", "грязн"),
        ("неубран", "грязн"),
        ("расстелен", "грязн"),
    ];
    let bed = words.find(BEDS)?;
    let last = words.keys.len() - 1;
    match words.keys[last].as_str() {
        "made" => return Some(words.replaced(vec![(last..last + 1, "clean".to_owned())])),
        "unmade" => return Some(words.replaced(vec![(last..last + 1, "dirty".to_owned())])),
        _ => {}
    }
    // «Коробка убрана под кровать?» is not asked of the bed.
    let of_bed = |n: usize| match words.keys.get(n + 1..bed) {
        Some(between) => between.iter().all(|word| word == "ли"),
        None => n > bed && n - bed <= 2,
    };
    words.keys.iter().enumerate().filter(|(n, _)| of_bed(*n)).find_map(|(n, key)| {
        let (stem, plain) = MADE.iter().find(|(stem, _)| key.starts_with(stem))?;
        let ending = key[stem.len()..].trim_start_matches('н');
        Some(words.replaced(vec![(n..n + 1, format!("{plain}{ending}"))]))
    })
}

/// «Он свободен?», «Правда ли, что в холодильнике пусто?»: whether nothing is there.
fn is_free(words: &Words<'_>) -> Option<String> {
    const OTHER: &[&str] = &["сколько", "что", "где", "место", "мест", "места", "какой", "какие"];
    let last = words.keys.len() - 1;
    let begins = if words.is(0, &["правда", "верно"]) { 3 } else { 0 };
    if (begins..last).any(|n| words.is(n, OTHER)) || last == 0 {
        return None;
    }
    let plain = match words.keys[last].as_str() {
        "свободен" => "пуст",
        "свободна" => "пуста",
        "свободно" => "пусто",
        "свободны" => "пусты",
        "пусто" if (begins..last).any(|n| words.is(n, &["в", "во", "на"])) => {
            "ничего нет"
        }
        _ => return None,
    };
    Some(words.replaced(vec![(last..last + 1, plain.to_owned())]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constructions_are_put_plainly() {
        let plain = |text: &str| RULES.iter().find_map(|rule| rule(&Words::of(text)?));
        let check = |text: &str, meant: &str| assert_eq!(plain(text).as_deref(), Some(meant));
        check("What does the bedroom contain?", "what is in the bedroom?");
        check("Which rooms does Door 1 connect?", "what does Door 1 join?");
        check("What do we have more of, chairs or books?", "are there more chairs or books?");
        check("How many rooms have paintings in them?", "How many rooms have paintings?");
        check("Does the room have both a bed and a desk?", "Does the room have a bed and a desk?");
        check("Где искать статуэтку?", "где статуэтку?");
        check(
            "Что ещё есть на том же столе, где и газета?",
            "Что ещё есть на том же столе что и газета?",
        );
        check("Which rooms have books but no lamps?", "Which rooms with books are without lamps?");
        check(
            "Which door connects the hall with the lab?",
            "Which door connects the hall and the lab?",
        );
        check("От хлеба до чашки ближе, чем до яблока?", "хлеба ближе к чашки, чем к яблока?");
        check("Правда, что газета на диване?", "правда ли, что газета на диване?");
        assert_eq!(plain("Where are both chairs?"), None);
        assert_eq!(plain("in it"), None);
        // Every order of the words that are looked for, some of them missing.
        let words = [
            "от",
            "до",
            "ближе",
            "чем",
            "до",
            "на",
            "каких",
            "что",
            "то",
            "лежит",
            "том",
            "же",
            "где",
            "и",
            "which",
            "rooms",
            "have",
            "but",
            "no",
            "with",
            "connects",
            "both",
            "a",
            "in",
            "it",
        ];
        for length in 1..6 {
            for start in 0..words.len() {
                for step in 1..words.len() {
                    let some = (0..length).map(|n| words[(start + n * step) % words.len()]);
                    let text = some.collect::<Vec<_>>().join(" ");
                    let _ = plain(&text);
                }
            }
        }
        assert_eq!(plain(""), None);
    }
}
