//! What people do with things, in the words of a question: «чем моют посуду», "where can I wash my hands?"
//!
//! Which things serve is told by the sorts of `purposes`. Invariant: of the sorts of a deed each has another role or
//! other words; a deed that has a sort of things is never told of another sort's.

use std::collections::{BTreeSet, HashMap};
use std::ops::Range;
use std::sync::OnceLock;

use super::purposes::{self, Role};
use Role::{Instrument, Location, Patient, Source, Theme};

/// Forms that stand for one another in the deeds below, the first for all.
const FORMS: &[&str] = &[
    "мыть|помыть|вымыть|моют|мою|моем|отмыть|отмывают|ополоснуть|сполоснуть",
    "мыться|помыться|вымыться|моются|искупаться|купаться|купаются",
    "посуду|тарелки|тарелку|чашки|чашку|кружку|кастрюлю|сковороду|сковородку",
    "резать|порезать|режут|режу|нарезать|нарезают|разрезать|разрезают|отрезать|отрезают",
    "вытирать|вытереть|вытирают|вытру|обтереть|протереть|протирать|протирают",
    "вытираться|вытереться|вытираются|обтереться",
    "подметать|подмести|подметают|подмету",
    "писать|пишут|написать|записать|записывать|записывают",
    "рисовать|рисуют|нарисовать",
    "стирать|постирать|стирают|выстирать",
    "бельё|одежду|рубашку|вещи",
    "готовить|приготовить|готовят|приготовляют",
    "варить|сварить|варят|отварить",
    "жарить|пожарить|жарят|поджарить|обжарить|поджаривают",
    "печь|испечь|пекут|выпекать",
    "греть|разогреть|подогреть|разогревать|разогревают|подогревают|подогревать|согреть",
    "еду|обед|ужин|завтрак|суп|пищу",
    "кипятить|вскипятить|кипятят",
    "заваривать|заварить|заваривают|делать|сделать|делают",
    "выбрасывать|выбросить|выбрасывают|выкинуть|выкидывать|выкидывают|бросить|бросать|бросают",
    "вешать|повесить|вешают",
    "пальто|куртку|одежду|плащ|рубашку",
    "прочищать|прочистить|прочищают|пробить",
    "унитаз|засор|раковину|слив",
    "чистить|почистить|чистят",
    "солить|посолить|солят|подсолить|досолить",
    "перчить|поперчить|перчат",
    "приправить|приправлять|приправляют",
    "поливать|полить|поливают",
    "опрыскать|опрыскивать|опрыскивают|побрызгать|брызгать|брызгают|распылять|распылить",
    "играть|поиграть|играют|сыграть",
    "бить|ударить|бьют|отбить|отбивать|отбивают",
    "смотреть|посмотреть|смотрят|глядеть",
    "слушать|послушать|слушают",
    "узнать|узнать|узнают|посмотреть|определить",
    "звонить|позвонить|звонят",
    "хранить|держать|хранят|держат",
    "гладить|погладить|гладят|выгладить|отгладить",
    "складывать|сложить|класть|положить|складывают|кладут|убрать|деть|бросить",
    "помешать|размешать|перемешать|мешают|помешивать|размешивают",
    "класть|положить|поставить|ставить|кладут|ставят",
    "печатать|напечатать|печатают|набрать|набирать",
    "потушить|тушить|тушат|погасить",
    "завернуть|заворачивать|заворачивают|обернуть",
    "зарядить|заряжать|заряжают",
    "платить|заплатить|платят|расплатиться|расплачиваются",
    "лечиться|вылечиться|полечиться|лечатся|лечить|лечат",
    "осветить|освещать|освещают|посветить",
    "wash|washing|rinse|rinsing",
    "cut|cutting|slice|slicing|chop|chopping",
    "write|writing",
    "draw|drawing|sketch",
    "wipe|wiping|wipe down|wipe up",
    "dry|drying",
    "clean|cleaning|tidy up",
    "sweep|sweeping|sweep up",
    "mop|mopping",
    "vacuum|vacuuming|hoover",
    "unclog|unclogging|unblock|unblocking",
    "brush|brushing|clean",
    "eat|eating",
    "drink|drinking",
    "read|reading",
    "cook|cooking",
    "boil|boiling",
    "fry|frying",
    "bake|baking|roast|roasting",
    "toast|toasting",
    "make|making|brew|brewing|prepare|preparing",
    "heat up|heating up|heat|heating|warm up|warming up|reheat|reheating",
    "food|dinner|lunch|soup|leftovers|milk|a meal",
    "throw away|throwing away|throw out|throwing out|dispose of|disposing of|get rid of",
    "hang|hanging|hang up|hanging up",
    "coat|coats|jacket|clothes|dress|shirt",
    "call|calling|phone|ring up",
    "season|seasoning|flavour|flavor",
    "salt|salting",
    "spray|spraying",
    "water|watering",
    "hit|hitting|strike|striking",
    "play|playing",
    "watch|watching",
    "listen to|listening to|hear|hearing|play",
    "light|lighting|light up|lighting up|illuminate",
    "store|storing|keep|keeping",
    "iron|ironing|press",
    "work|working",
    "stir|stirring|mix|mixing",
    "put|putting|place|leave",
    "charge|charging",
    "dirty clothes|dirty laundry|laundry|dirty socks",
];

/// Words that may stand before what a deed is done to.
const DETERMINERS: [&str; 17] = [
    "the", "a", "an", "some", "my", "your", "our", "his", "her", "one's", "s", "мне", "свои",
    "свою", "мои", "себе", "нам",
];

/// Phrases of deeds in both languages, and the sorts that serve for them by their English names; «…» stands for what it
/// is done to, which need not be on the map.
const DEEDS: &[(&str, &str)] = &[
    (
        "есть съестное|поесть|едят|обедают|обедать|ужинать|завтракать|пообедать|поужинать|позавтракать|съесть|покушать|кушать|скушать|перекусить|закусить|eat lunch|have lunch|have dinner|have breakfast|eat …|have a snack|have a bite|snack on",
        "food item|place to eat at|thing to eat with|thing to eat from",
    ),
    (
        "есть суп|едят суп|есть кашу|едят кашу|поесть суп|хлебать суп|eat soup|eat cereal|eat porridge",
        "place to eat at|thing to eat soup with|thing to eat from",
    ),
    (
        "попить|выпить|пить|пьют|пить чай|пить чаю|пить кофе|попить чаю|выпить чаю|попить кофе|выпить кофе|попить чай|drink …|drink tea|drink coffee|drink water",
        "drink|thing to drink from",
    ),
    ("почитать|читать|прочитать|прочесть|читают|read", "thing to read"),
    ("писать …|рисовать …|write …|draw …", "thing to write with|thing to write on"),
    ("мыть руки|wash hands|wash up", "place to wash hands|thing to wash hands with"),
    ("набрать воды|налить воды|get some water|get water", "place to wash hands"),
    ("чистить зубы|brush teeth", "place to wash hands|thing to brush teeth with"),
    (
        "мыть посуду|wash dishes|wash plates|wash a plate|do the dishes|wash a cup|wash up the dishes",
        "place to wash dishes|thing to wash dishes with",
    ),
    ("стирать|стирать бельё|wash clothes|do laundry|wash laundry", "place to wash clothes"),
    (
        "мыться|принять душ|принять ванну|take a shower|have a shower|take a bath|have a bath|bathe",
        "place to bathe|thing to wash with",
    ),
    (
        "умыться|умываться|помыть лицо|wash myself|wash oneself|wash face|wash",
        "place to wash|thing to wash with",
    ),
    ("мыть голову|мыть волосы|wash hair", "place to bathe|thing to wash hair with"),
    ("резать …|cut …", "thing to cut with"),
    (
        "готовить …|готовить еду|cook …|prepare food|make dinner|make lunch|prepare a meal",
        "thing to cook with",
    ),
    ("варить …|варить еду|boil …", "thing to boil food in|thing to cook with"),
    ("жарить …|fry …", "thing to fry with|thing to cook with"),
    ("печь пирог|испечь …|пекут …|выпекать …|bake …", "thing to bake in"),
    (
        "поджарить хлеб|поджарить тосты|жарить хлеб|жарить тосты|делать тосты|заваривать тосты|toast bread|make toast",
        "thing to toast bread with",
    ),
    ("греть …|греть еду|heat up …|heat up food", "thing to warm food with"),
    (
        "кипятить …|кипятить воду|заваривать чай|готовить чай|boil water|make tea",
        "thing to boil water with",
    ),
    ("варить кофе|заваривать кофе|готовить кофе|make coffee", "thing to make coffee with"),
    (
        "выбрасывать …|выбрасывать мусор|выбрасывать отходы|throw away …|throw away rubbish|throw rubbish|throw trash|throw garbage|throw it away|throw this away|throw it out|throw this out|throw that away|throw something away|throw things away|put the trash|put the rubbish|put the garbage",
        "place for rubbish",
    ),
    ("вешать …|вешать пальто|hang …|hang coat", "place for clothes"),
    ("вешать полотенце|hang a towel|hang towels", "place to hang a towel"),
    (
        "хранить одежду|складывать одежду|убрать одежду|store clothes|put clothes|put away clothes",
        "place to keep clothes",
    ),
    (
        "складывать грязное бельё|складывать грязную одежду|складывать бельё|складывать грязные вещи|put dirty clothes|throw dirty clothes",
        "place for dirty clothes",
    ),
    (
        "поработать|работать|позаниматься|заниматься|учиться|сделать уроки|делать уроки|do my homework|do homework|work at|work|study",
        "place to work",
    ),
    (
        "звонить|звонить маме|звонить домой|звонить другу|make a call|make a phone call|phone home|call somebody|call someone|call home|call a friend|call my mother|call mom|call people",
        "thing to call with",
    ),
    (
        "убраться|убираться|убираются|прибраться|навести порядок|clean with|clean the room|clean the house|clean the floor|clean up",
        "thing to clean with",
    ),
    ("вытирать …|вытирать стол|wipe …", "thing to wipe with"),
    (
        "вытирать руки|вытираться|вытирать лицо|вытирать посуду|высушить руки|вытирать тарелки|dry hands|dry dishes|dry plates|dry hair|dry myself|dry oneself|wipe hands|dry off",
        "thing to dry with",
    ),
    ("подметать …|подметать пол|sweep …|sweep the floor", "thing to sweep with"),
    ("мыть пол|мыть полы|mop the floor|wash the floor", "thing to mop with"),
    (
        "пылесосить …|пропылесосить …|пылесосят …|почистить ковёр|чистить ковёр|vacuum the carpet|vacuum the floor|clean the carpet|clean the rug",
        "thing to vacuum with",
    ),
    (
        "прочищать …|прочищать унитаз|устранить засор|unclog …|unclog the toilet|unclog the sink|unclog a drain|unclog the drain",
        "thing to unclog with",
    ),
    ("высморкаться|сморкаться|blow my nose|blow one s nose", "thing to blow your nose with"),
    ("солить …|salt my food|salt food|salt the soup|add salt", "thing to salt food with"),
    ("перчить …|pepper my food|pepper the soup|add pepper", "thing to pepper food with"),
    ("приправить …|season …", "thing to season food with"),
    ("налить суп|разлить суп|наливать суп|pour soup|serve soup", "thing to pour with"),
    ("помешать …|stir …", "thing to stir with"),
    (
        "перевернуть котлету|перевернуть блин|перевернуть блины|переворачивать блины|flip pancakes|flip a pancake|flip an egg|turn pancakes",
        "thing to turn food over with",
    ),
    ("опрыскать …|spray …", "thing to spray with"),
    (
        "поливать цветы|поливать растения|поливать цветок|поливать растение|опрыскать цветы|опрыскать растения|water plants|water flowers|water the plant|spray plants|spray the plant",
        "thing to water plants with",
    ),
    ("поставить цветы|поставить букет|put flowers|put a bouquet", "place for flowers"),
    (
        "бить по мячу|бить мяч|ударить по мячу|hit a ball|hit balls|hit the ball",
        "thing to hit a ball with",
    ),
    ("играть в теннис|play tennis", "thing to play tennis with"),
    ("играть в бейсбол|play baseball", "thing to play baseball with"),
    (
        "играть в баскетбол|играть в мяч|play basketball|play ball|play catch",
        "thing to play basketball with",
    ),
    ("играть|play", "toy|thing to play with"),
    (
        "тренироваться|потренироваться|качать мышцы|заняться спортом|заниматься спортом|exercise|work out",
        "thing to exercise with",
    ),
    (
        "смотреть телевизор|watch tv|watch television|watch the telly",
        "thing to watch television on",
    ),
    (
        "смотреть фильм|смотреть кино|смотреть фильмы|смотреть мультики|смотреть новости|смотреть сериал|watch a film|watch a movie|watch films|watch movies|watch the news|watch a show|watch cartoons",
        "thing to watch films on",
    ),
    (
        "слушать музыку|слушать радио|слушать новости|listen to music|listen to the news",
        "thing to listen to music with",
    ),
    (
        "осветить|осветить комнату|light a room|light the room|light the table|read by",
        "thing to light a room with",
    ),
    (
        "узнать время|узнать который час|смотреть который час|узнать сколько времени|tell the time|see the time|check the time|see what time it is|know the time|tell what time it is",
        "thing to tell the time by",
    ),
    ("проснуться|проснуться вовремя|wake up|wake me up", "thing to wake up with"),
    (
        "спит собака|спать собаке|спит пёс|спать собака|лежит собака|уложить собаку|dog sleep|dog sleeps|dog lie down|dog rest|puppy sleep",
        "place for a dog to sleep",
    ),
    (
        "хранить продукты|хранить еду|хранить молоко|охладить …|охладить напитки|охлаждать напитки|держать холодным|заморозить …|cool drinks|chill …|chill drinks|freeze …|keep food cold|keep food fresh|keep milk cold|keep milk|store food|keep things cold|store milk|store cold things|keep food|keep drinks cold|store cold food",
        "place to keep food cold",
    ),
    ("гладить …|iron clothes|iron a shirt|iron shirts", "thing to iron with"),
    (
        "справить нужду|сходить в туалет|сходить по нужде|go to the toilet|use the toilet|pee|relieve myself|go to the bathroom",
        "place to relieve yourself",
    ),
    (
        "посмотреться|причесаться|посмотреть на себя|побриться|look at myself|see myself|comb hair|shave|do my makeup",
        "thing to look at yourself in",
    ),
    ("платить|pay|pay for …", "thing to pay with"),
    (
        "зарядить телефон|зарядить ноутбук|charge a phone|charge a laptop|charge the laptop|plug in",
        "thing to charge a phone with",
    ),
    ("печатать текст|печатать|type a letter|type a text|type text", "thing to type with"),
    (
        "выйти в интернет|посмотреть в интернете|go online|surf the internet|browse the internet|check email|write an email",
        "thing to go online with",
    ),
    ("распечатать|print a page|print a document|print something", "thing to print with"),
    (
        "переключить канал|переключать каналы|change channels|change the channel|switch channels",
        "thing to change channels with",
    ),
    ("лечиться|treat a cold|take for a headache|take medicine", "thing to be treated with"),
    (
        "потушить огонь|потушить пожар|put out a fire|extinguish a fire",
        "thing to put out a fire with",
    ),
    (
        "завернуть …|завернуть еду|завернуть бутерброд|wrap food|wrap a sandwich|wrap leftovers",
        "thing to wrap food in",
    ),
    (
        "переносить|переставить|носить|унести|поднять|принести|перенести|взять с собой|be carried|be taken|be picked up|pick up|carry|bring me",
        "portable thing",
    ),
    (
        "передвинуть|передвигать|сдвинуть|подвинуть|двигать|переместить|be moved|be pushed|be shifted|push around",
        "movable thing",
    ),
    (
        "включить|выключить|turn on|turn off|switch on|switch off|be switched on|be turned on|be switched off|be turned off",
        "switchable thing",
    ),
];

type Phrases = HashMap<String, Vec<(Vec<String>, u16)>>;

/// The phrases in all forms, by their first words.
fn phrases() -> &'static Phrases {
    static PHRASES: OnceLock<Phrases> = OnceLock::new();
    PHRASES.get_or_init(|| {
        let mut all = Phrases::new();
        for (n, (said, _)) in DEEDS.iter().enumerate() {
            let deed = u16::try_from(n).unwrap_or(u16::MAX);
            for words in said.split('|').flat_map(|phrase| in_all_forms(bare(phrase))) {
                all.entry(words[0].clone()).or_default().push((words, deed));
            }
        }
        all
    })
}

/// A phrase without the place of what the deed is done to.
fn bare(phrase: &str) -> &str {
    phrase.trim_end_matches(" …")
}

/// A phrase with each word in all its forms; in Russian what the deed is done to may stand first.
fn in_all_forms(phrase: &str) -> Vec<Vec<String>> {
    let keys = |text: &str| text.split_whitespace().map(crate::units::name_key).collect::<Vec<_>>();
    let forms = |part: &str| -> Option<Vec<&'static str>> {
        let group = FORMS.iter().find(|group| group.split('|').next() == Some(part))?;
        Some(group.split('|').collect())
    };
    let words: Vec<&str> = phrase.split_whitespace().collect();
    let mut all: Vec<Vec<String>> = vec![Vec::new()];
    let mut at = 0;
    while at < words.len() {
        // "throw away", "listen to" are one verb.
        let taken =
            (1..=words.len() - at).rev().find(|n| forms(&words[at..at + n].join(" ")).is_some());
        let part = words[at..at + taken.unwrap_or(1)].join(" ");
        let own = forms(&part).unwrap_or_default();
        let own: Vec<Vec<String>> = match own.is_empty() {
            true => vec![keys(&part)],
            false => own.into_iter().map(keys).collect(),
        };
        all = all
            .iter()
            .flat_map(|head| own.iter().map(move |tail| [head.clone(), tail.clone()].concat()))
            .collect();
        at += taken.unwrap_or(1);
    }
    let inverted = words.len() == 2 && forms(words[0]).is_some() && !phrase.is_ascii();
    if inverted {
        let behind: Vec<Vec<String>> =
            all.iter().map(|two| two.iter().rev().cloned().collect()).collect();
        all.extend(behind);
    }
    all
}

/// The deed that these words, in [`name_key`](crate::units::name_key) form, begin with, and how many they are.
pub(super) fn longest(words: &[String]) -> Option<(usize, u16)> {
    let fitting = phrases()
        .get(words.first()?)?
        .iter()
        .filter_map(|(phrase, deed)| Some((fits(phrase, words)?, *deed)));
    // Of equally long ones the first: what is listed before stands for more.
    fitting.fold(None, |best, next| match best {
        Some((taken, _)) if taken >= next.0 => best,
        _ => Some(next),
    })
}

/// How many words a phrase takes at the beginning of others, determiners between them counted.
fn fits(phrase: &[String], words: &[String]) -> Option<usize> {
    let mut at = 0;
    for (n, word) in phrase.iter().enumerate() {
        while n > 0 && words.get(at) != Some(word) && DETERMINERS.contains(&words.get(at)?.as_str())
        {
            at += 1;
        }
        if words.get(at)? != word {
            return None;
        }
        at += 1;
    }
    Some(at)
}

/// The sorts of things that serve for a deed.
pub(super) fn sorts(deed: u16) -> impl Iterator<Item = u16> {
    let named = DEEDS.get(usize::from(deed)).map_or("", |(_, sorts)| sorts);
    named.split('|').filter_map(purposes::sort_called)
}

/// The sorts that serve for some deed, what is merely moved or switched left out.
pub(super) fn all_sorts() -> impl Iterator<Item = u16> {
    let deeds = 0..u16::try_from(DEEDS.len()).unwrap_or(u16::MAX);
    let all: BTreeSet<u16> = deeds.flat_map(sorts).collect();
    all.into_iter().filter(|sort| !matches!(purposes::role(*sort), Theme))
}

/// Whether a deed is to move or switch something: then nothing serves for it.
pub(super) fn moves(deed: u16) -> bool {
    sorts(deed).any(|sort| purposes::role(sort) == Theme)
}

/// Whether a deed is done to something that its phrase does not name: «чем порезать хлеб».
pub(super) fn takes_object(deed: u16) -> bool {
    DEEDS.get(usize::from(deed)).is_some_and(|(said, _)| said.contains('…'))
}

/// A thing that an order names by its use: the words, and the sorts that will do, the likeliest first.
pub(super) struct Wanted {
    pub(super) words: Range<usize>,
    pub(super) sorts: Vec<u16>,
}

/// «что-нибудь попить», "something to cut an apple with" among words in [`name_key`](crate::units::name_key) form.
pub(super) fn wanted(keys: &[String]) -> Option<Wanted> {
    const ANY: [&[&str]; 8] = [
        &["something"],
        &["anything"],
        &["что", "нибудь"],
        &["чего", "нибудь"],
        &["что", "либо"],
        &["что", "то"],
        &["чего", "то"],
        &["то"],
    ];
    const JOINTS: [&str; 6] = ["to", "for", "чем", "чтобы", "из", "чего"];
    const ENDS: [&str; 6] = ["with", "from", "out", "in", "on", "of"];
    let is =
        |n: usize, words: &[&str]| keys.get(n).is_some_and(|key| words.contains(&key.as_str()));
    let begins =
        |at: usize, any: &[&str]| any.iter().enumerate().all(|(n, word)| is(at + n, &[word]));
    let (start, mut next) = (0..keys.len()).find_map(|at| {
        let any = ANY.iter().find(|any| begins(at, any))?;
        Some((at, at + any.len()))
    })?;
    let mut joints = Vec::new();
    while is(next, &JOINTS) {
        joints.push(keys[next].as_str());
        next += 1;
    }
    let (taken, deed) = longest(&keys[next..])?;
    let mut end = next + taken;
    // What it is done to, and a preposition whose noun is what is wanted.
    let object =
        |n: &usize| !is(*n, &["please", "пожалуйста", "and", "и", "from", "из", "с", "в", "на"]);
    let stranded = (end..keys.len().min(end + 4)).find(|n| is(*n, &["with"]));
    match stranded {
        Some(with) => end = with + 1,
        None if takes_object(deed) => {
            end += usize::from(is(end, &DETERMINERS));
            end += usize::from(end < keys.len() && object(&end));
        }
        None => {}
    }
    while is(end, &ENDS) && (end + 1..keys.len()).all(|n| is(n, &ENDS)) {
        end += 1;
    }
    let said =
        |word: &str| joints.contains(&word) || keys[next + taken..end].iter().any(|k| k == word);
    let roles = match () {
        () if said("with") || said("чем") => &[Instrument, Location][..],
        () if said("from") || said("out") || said("чего") => &[Source, Instrument],
        () if sorts(deed).any(|sort| matches!(purposes::role(sort), Patient | Theme)) => {
            &[Patient, Theme]
        }
        () => &[Instrument, Source, Location],
    };
    let of_role = |role: Role| sorts(deed).filter(move |sort| purposes::role(*sort) == role);
    Some(Wanted { words: start..end, sorts: roles.iter().copied().flat_map(of_role).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sort_of_a_deed_is_there_and_every_form_leads_to_its_deed() {
        for (n, (said, named)) in DEEDS.iter().enumerate() {
            let deed = u16::try_from(n).unwrap();
            assert_eq!(sorts(deed).count(), named.split('|').count(), "{named}");
            for phrase in said.split('|') {
                let words: Vec<String> =
                    bare(phrase).split_whitespace().map(crate::units::name_key).collect();
                assert_eq!(longest(&words), Some((words.len(), deed)), "{phrase}");
            }
        }
    }

    #[test]
    fn determiners_and_the_other_order_change_nothing() {
        let check = |text: &str, expected: Option<&str>| {
            let words: Vec<String> = text.split_whitespace().map(crate::units::name_key).collect();
            let sort = longest(&words).and_then(|(_, deed)| sorts(deed).next());
            assert_eq!(sort.map(|s| purposes::SORTS[usize::from(s)].english), expected, "{text}");
        };
        check("washing my hands", Some("place to wash hands"));
        check("посуду моют", Some("place to wash dishes"));
        check("cut an apple", Some("thing to cut with"));
        check("the apple", None);
    }
}
