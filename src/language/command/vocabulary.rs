//! The words of commands in both languages, and what each does in a sentence.

use std::collections::HashMap;
use std::sync::OnceLock;

use super::Relation;

/// What a word or phrase does in a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    Verb(Verb),
    Link(Link),
    /// Politeness, articles, adverbs: heard and dropped.
    Filler,
    /// «на ключ»: closing becomes locking.
    WithKey,
    And,
    /// «все двери»
    All,
    Not,
    /// «мне», "me"
    Me,
    /// «её», "it"
    Pronoun,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Verb {
    GoTo,
    /// "move": what is named is carried, and without a name the robot goes itself.
    Move,
    /// "get": what is named is brought, and without a name the robot goes itself.
    Get,
    Bring,
    /// «нужно лекарство»: asks for it without saying how.
    Need,
    Take,
    Put,
    /// «убери»: puts away, or tidies a place.
    Clear,
    Open,
    Close,
    Lock,
    Unlock,
    SwitchOn,
    SwitchOff,
    Find,
    Tidy,
    CallOperator,
    Report,
    Stop,
}

/// A preposition: how the thing after it lies to the rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Link {
    pub(super) relation: Relation,
    pub(super) role: Role,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// «в», «на», «под»: the case tells whither from where.
    WhereOrWhither,
    Whither,
    Where,
    Whence,
    Via,
}

const fn link(relation: Relation, role: Role) -> Meaning {
    Meaning::Link(Link { relation, role })
}

/// Phrases of a meaning, separated by bars.
const VOCABULARY: &[(Meaning, &str)] = &[
    (
        Meaning::Verb(Verb::GoTo),
        "поезжай|поезжайте|поехал|подъехал|езжай|езжайте|поехали|едь|едьте|ехать|поехать|съезди|съездите|подъедь|подъедьте|подъезжай|подъезжайте|\
        подъехать|заедь|заезжай|иди|идите|идти|пойди|пойдите|пойти|сходи|сходите|подойди|подойдите|подойти|зайди|зайдите|зайти|пройди|пройдите|\
        пройти|перейди|перейдите|перейти|отправляйся|отправляйтесь|отправиться|двигайся|двигайтесь|двигаться|переместись|переместитесь|\
        поднимись|поднимитесь|подняться|спустись|спуститесь|спуститься|поднимись на лифте|поднимитесь на лифте|спустись на лифте|\
        take the elevator|take the lift|use the elevator|use the lift|ride the elevator|ride the lift|go up|go down|вернись|вернитесь|вернуться|возвращайся|направляйся|следуй|go|go back|drive|navigate|come|return|head|walk|proceed|enter",
    ),
    (
        Meaning::Verb(Verb::Move),
        "перемести|переместите|переместить|передвинь|передвиньте|передвинуть|подвинь|подвиньте|сдвинь|сдвиньте|перетащи|перетащите|move|shift",
    ),
    (Meaning::Verb(Verb::Get), "get"),
    (
        Meaning::Verb(Verb::Bring),
        "принеси|принесите|принёс|принесла|привёз|достал|подал|принести|неси|несите|привези|привезите|привезти|доставь|доставьте|доставить|подай|подайте|\
        подать|дай|дайте|дать|достань|достаньте|bring|fetch|get me|give|deliver|hand|carry|pass",
    ),
    (Meaning::Verb(Verb::Need), "нужен|нужна|нужно|нужны|хочу|хотел бы|хотела бы|need|want"),
    (
        Meaning::Verb(Verb::Take),
        "возьми|возьмите|взял|взять|бери|забери|заберите|забрать|подними|поднимите|поднять|схвати|захвати|take|pick up|pick|grab|grasp|lift",
    ),
    (
        Meaning::Verb(Verb::Put),
        "положи|положите|положил|поставил|отнёс|положить|клади|поставь|поставьте|поставить|ставь|помести|поместите|поместить|повесь|повесьте|\
        отнеси|отнесите|отнести|отвези|отвезите|отвезти|перенеси|перенесите|перенести|переставь|переложи|верни|верните|вернуть|\
        put|place|put down|set|lay|put back|hang",
    ),
    (Meaning::Verb(Verb::Clear), "убери|уберите|убрать|put away|clear"),
    (
        Meaning::Verb(Verb::Open),
        "открой|открыл|откройте|открыть|открывай|отвори|отворите|распахни|open",
    ),
    (
        Meaning::Verb(Verb::Close),
        "закрой|закрыл|закройте|закрыть|закрывай|прикрой|прикройте|затвори|захлопни|close|shut",
    ),
    (Meaning::Verb(Verb::Lock), "запри|запер|заприте|запереть|замкни|lock"),
    (Meaning::Verb(Verb::Unlock), "отопри|отоприте|отпереть|отомкни|разблокируй|unlock"),
    (
        Meaning::Verb(Verb::SwitchOn),
        "включи|включил|включите|включить|зажги|зажгите|зажечь|turn on|switch on",
    ),
    (
        Meaning::Verb(Verb::SwitchOff),
        "выключи|выключил|выключите|выключить|отключи|отключите|погаси|погасите|потуши|туши|turn off|switch off",
    ),
    (
        Meaning::Verb(Verb::Find),
        "найди|нашёл|найдите|найти|отыщи|отыщите|поищи|поищите|разыщи|ищи|find|look for|search for|locate",
    ),
    (
        Meaning::Verb(Verb::Tidy),
        "приберись|приберитесь|прибраться|прибери|наведи порядок|наведите порядок|навести порядок|уберись|уберитесь|tidy|tidy up|clean|clean up|clean out",
    ),
    (
        Meaning::Verb(Verb::CallOperator),
        "позови оператора|позовите оператора|вызови оператора|вызовите оператора|позвать оператора|вызвать оператора|\
        позвони оператору|call operator|call the operator|call an operator|ask the operator",
    ),
    (
        Meaning::Verb(Verb::Stop),
        "стоп|стой|стойте|остановись|остановитесь|остановиться|хватит|прекрати|прекратите|отмена|отмени|отмени задание|\
        stop|halt|cancel|abort|freeze",
    ),
    (
        Meaning::Verb(Verb::Report),
        "доложи|доложите|доложить|доложи обстановку|доложи о состоянии|доложи где ты|отчитайся|сообщи где ты|сообщи где ты находишься|\
        сообщи своё положение|сообщи положение|сообщи местоположение|где ты|где ты находишься|где ты сейчас|report|report your position|report position|where are you|\
        tell me where you are",
    ),
    (link(Relation::In, Role::WhereOrWhither), "в|во|внутрь"),
    (link(Relation::On, Role::WhereOrWhither), "на"),
    (link(Relation::In, Role::Whither), "into|inside of"),
    (link(Relation::In, Role::Where), "внутри|inside|in"),
    (link(Relation::On, Role::Whither), "onto|on to"),
    (link(Relation::On, Role::Where), "on|on top of|upon"),
    (link(Relation::Under, Role::WhereOrWhither), "под|подо|under|below|beneath|underneath"),
    (link(Relation::Behind, Role::WhereOrWhither), "за|позади|behind"),
    (link(Relation::InFrontOf, Role::WhereOrWhither), "перед|передо|in front of"),
    (
        link(Relation::NextTo, Role::WhereOrWhither),
        "у|около|возле|рядом с|рядом со|близ|next to|near|beside|by",
    ),
    (link(Relation::At, Role::Whither), "к|ко|до|to|towards|toward|up to"),
    (link(Relation::At, Role::Where), "at"),
    (link(Relation::In, Role::Whence), "из|изо|out of"),
    (link(Relation::On, Role::Whence), "с|со|off|off of"),
    (link(Relation::At, Role::Whence), "от|ото|from"),
    (link(Relation::Under, Role::Whence), "из под|from under"),
    (link(Relation::Behind, Role::Whence), "из за|from behind"),
    (link(Relation::At, Role::Via), "через|сквозь|through|via"),
    (
        Meaning::Filler,
        "пожалуйста|плиз|будь добр|будь добра|будьте добры|будь так добр|прошу|прошу тебя|прошу вас|если не трудно|можешь|можете|можно|мог бы ты|\
        могли бы вы|не мог бы ты|не могли бы вы|не можешь|не можете|ты не мог бы|ты|вы|бы|ли|надо|необходимо|чтобы|чтобы ты|я|мы|нам|быстро|быстрее|скорее|срочно|осторожно|сейчас|теперь|\
        тут|там|сюда|туда|вот|ка|же|ну|ладно|хорошо|привет|здравствуй|здравствуйте|робот|рб|рб 2|этот|эту|это|эти|тот|ту|те|мой|мою|моё|мои|свой|свою|своё|для меня|\
        какой нибудь|какую нибудь|кое что|свободный|одну|один|какую то|please|could you|could you please|can you|would you|will you|would you please|robot|hey|hello|hi|\
        a|an|the|this|that|these|those|my|your|some|now|quickly|quick|fast|carefully|here|there|for me|kindly|i|d like|d like you to|like|you",
    ),
    (Meaning::WithKey, "на ключ|на замок|with the key|with a key"),
    (
        Meaning::And,
        "и|а затем|затем|потом|после этого|а потом|и потом|и затем|then|and|and then|after that",
    ),
    (
        Meaning::All,
        "все|всю|всё|весь|всех|каждую|каждый|каждое|all|all the|all of the|every|each|both|both the",
    ),
    (Meaning::Not, "не|нельзя|никогда|not|never|don t|do not|dont"),
    (Meaning::Me, "мне|меня|ко мне|до меня|me|to me"),
    (Meaning::Pronoun, "его|её|их|него|неё|них|ней|ним|ему|it|them|him|her"),
];

/// The meaning of the longest phrase at the beginning of these words (in [`name_key`](crate::units::name_key) form),
/// with the number of words that it takes.
pub(super) fn longest<'k>(
    words: &(impl Iterator<Item = &'k str> + Clone),
) -> Option<(usize, Meaning)> {
    type Phrases = Vec<(Vec<String>, Meaning)>;
    static TABLE: OnceLock<HashMap<String, Phrases>> = OnceLock::new();
    let table = TABLE.get_or_init(|| {
        let mut table: HashMap<String, Phrases> = HashMap::new();
        for (meaning, phrase) in phrases() {
            let words: Vec<String> =
                phrase.split_whitespace().map(crate::units::name_key).collect();
            table.entry(words[0].clone()).or_default().push((words, meaning));
        }
        for phrases in table.values_mut() {
            phrases.sort_by_key(|(words, _)| std::cmp::Reverse(words.len()));
        }
        table
    });
    let first = words.clone().next()?;
    let fits = |phrase: &[String]| {
        let mut words = words.clone();
        phrase.iter().all(|word| words.next() == Some(word))
    };
    table
        .get(first)?
        .iter()
        .find(|(phrase, _)| fits(phrase))
        .map(|(phrase, meaning)| (phrase.len(), *meaning))
}

/// All verbs, to offer the one that was meant.
pub(super) fn verbs() -> impl Iterator<Item = &'static str> {
    phrases().filter(|(meaning, _)| matches!(meaning, Meaning::Verb(_))).map(|(_, phrase)| phrase)
}

fn phrases() -> impl Iterator<Item = (Meaning, &'static str)> {
    VOCABULARY
        .iter()
        .flat_map(|(meaning, list)| list.split('|').map(|phrase| (*meaning, phrase.trim())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: Option<(usize, Meaning)>) {
        assert_eq!(longest(&text.split_whitespace()), expected, "{text}");
    }

    #[test]
    fn the_longest_phrase_wins() {
        check("не могли бы вы", Some((4, Meaning::Filler)));
        check("не открывай", Some((1, Meaning::Not)));
        check("pick up the cup", Some((2, Meaning::Verb(Verb::Take))));
        check("её", None); // keys have no ё
        check("ее", Some((1, Meaning::Pronoun)));
        check("стол", None);
    }

    #[test]
    fn no_phrase_has_two_meanings() {
        let mut seen = HashMap::new();
        for (meaning, phrase) in phrases() {
            assert!(!phrase.is_empty());
            if let Some(other) = seen.insert(crate::units::name_key(phrase), meaning) {
                assert_eq!(other, meaning, "{phrase}");
            }
        }
    }
}
