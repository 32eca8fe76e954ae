//! The words of commands in both languages, and what each does in a sentence.

use std::collections::{HashMap, HashSet};
use std::sync::OnceLock;

use super::Relation;
use crate::units::{InOrder as _, name_key};
use crate::words::ordering_verb;

/// What a word or phrase does in a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    Verb(Verb),
    Link(Link),
    /// Politeness, articles, adverbs: heard and dropped.
    Filler,
    /// «на ключ»: closing becomes locking.
    WithKey,
    /// «на пол»: what is put goes onto no thing.
    OnFloor,
    /// «лицом к стене»: the nearest.
    FacingWall,
    /// «домой», «на зарядку»: a place of the robot's own.
    Haunt(Haunt),
    And,
    /// «все двери»
    All,
    Not,
    /// «мне», "me"
    Me,
    /// «её», "it"
    Pronoun,
    /// «их», "them"
    Them,
}

impl Meaning {
    /// Whether a word says whither, or may: a preposition, «домой».
    pub(super) fn says_whither(self) -> bool {
        match self {
            Self::Link(link) => matches!(link.role, Role::Whither | Role::WhereOrWhither),
            Self::Haunt(_) => true,
            _ => false,
        }
    }
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
    /// "put down": where a place is named it is put there, else on the floor.
    SetDown,
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
    /// "clean": a room is tidied; of a thing, its surface is meant.
    Clean,
    CallOperator,
    CallLift,
    Report,
    Stop,
    /// «не надо»: by itself nothing is to be done; behind what is named, that is let be.
    Needless,
    /// «вернись»: to the place that is named, else to where the robot came from.
    Return,
    /// «верни на место»
    PutBack,
    /// «выброси»: into a bin, unless a place is named.
    ThrowAway,
    /// «зарядись»
    Charge,
    /// «выйди»: out of the room in which the robot is.
    Leave,
    Wait,
    /// «повернись к окну»
    Face,
    /// «обойди»: into each of the rooms that are named; what is no room is gone around, and that this one cannot do.
    Visit,
    /// What people ask of robots and this one cannot do.
    Unable,
}

/// Places of the robot's own, that it knows without their names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Haunt {
    Charger,
    Home,
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
        "приезжай|приехать|прибудь|окажись|добравшись|поезжай|поезжайте|езжай|езжайте|поехали|едь|едьте|ехать|поехать|съезди|съездите|подъедь|подъедьте|подъезжай|подъезжайте|\
        подъехать|заедь|заезжай|иди|идите|идти|пойди|пойдите|пойти|сходи|сходите|подойди|подойдите|подойти|зайди|зайдите|зайти|пройди|пройдите|\
        пройти|перейди|перейдите|перейти|отправляйся|отправляйтесь|отправиться|двигайся|двигайтесь|двигаться|переместись|переместитесь|\
        поднимись|поднимитесь|подняться|спускайся|спускайтесь|поднимайся|поднимайтесь|спустись|спуститесь|спуститься|поднимись на лифте|поднимитесь на лифте|спустись на лифте|\
        take the elevator|take the lift|use the elevator|use the lift|ride the elevator|ride the lift|go up|go down|направляйся|направляйтесь|\
        встань|встаньте|стань|подкати|подкатись|прокатись|двигай|дуй|доедь|доезжай|дойди|доберись|сгоняй|сбегай|слетай|смотайся|загляни|заскочи|look in|look into|look inside|peek into|приезжай|приедь|приди|проедь|проезжай|проследуй|\
        go|go over|nip over|nip|pop over|hop over|swing by|stop by|drop by|drive|drive over|navigate|come|come over|head|head over|walk|walk over|proceed|enter|move yourself|get yourself|run|roll|travel|visit|stand|go stand|approach|going",
    ),
    (
        Meaning::Verb(Verb::Visit),
        "обойди|обойдите|обойти|обходи|обходите|объедь|объедьте|объехать|объезжай|объезжайте|объезди|посети|посетите|посетить|make the rounds of|do the rounds of|make a tour of",
    ),
    (
        Meaning::Verb(Verb::Return),
        "верни|верните|вернуть|вернись|вернитесь|вернуться|возвращайся|возвращайтесь|вернись обратно|вернись назад|вернись туда откуда приехал|вернись туда откуда приехала|вернись откуда приехал|вернись туда где был|вернись туда где ты был|вернись туда|go back where you came from|go back to where you came from|return to where you came from|go back to where you were|go back where you were|come back|go back|get back|head back|drive back|return",
    ),
    (
        Meaning::Verb(Verb::PutBack),
        "верни на место|верните на место|вернуть на место|положи на место|положите на место|поставь на место|поставьте на место|убери на место|\
        уберите на место|отнеси на место|положи обратно|поставь обратно|отвези обратно|отвези назад|отвези на место|отнеси назад|положи назад|поставь назад|унеси обратно|верни обратно|верни назад|отнеси обратно|убери обратно|повесь обратно|put back|take back|place back|return to its place",
    ),
    (
        Meaning::Verb(Verb::Leave),
        "выйди|выйдите|выйти|выезжай|выезжайте|выедь|уходи|уходите|уйди|уйдите|уезжай|уезжайте|leave|exit|get out|get out of|get out of here|go out|go out of|go away|drive out|drive out of",
    ),
    (
        Meaning::Verb(Verb::Wait),
        "подожди|подождите|подождать|дождись|дождитесь|жди|ждите|обожди|побудь|постой|wait|hold on|stay",
    ),
    (
        Meaning::Verb(Verb::Face),
        "повернись|повернитесь|повернуться|поворачивайся|поверни|face|turn yourself|turn to face|turn to|turn towards|turn toward|turn yourself to|turn yourself towards",
    ),
    (
        Meaning::Verb(Verb::Unable),
        "застели|застелите|заправь|заправьте|патрулируй|посторожи|give me a hand|give us a hand|patrol|следуй|накрой|накройте|накрой на стол|накрыть на стол|сервируй|поменяй местами|поменяйте местами|lay the table|set the table|set a table|lay a table|swap|exchange|следуйте|следуй за|иди за|езжай за|поезжай за|проводи|проводите|сопроводи|сопроводите|отведи|отведите|встреть|встретьте|познакомь|скажи|расскажи анекдот|\
        спой|станцуй|потанцуй|приготовь|приготовьте|свари|сварите|налей|налейте|помой|помойте|вымой|вымойте|постирай|погладь|пропылесось|протри|протрите|накорми|полей|\
        почини|подмети|сделай|сделайте|поменяй|поменяйте|отъедь|отъезжай|вынеси мусор|вынесите мусор|позвони|сфотографируй|нарисуй|купи|закажи|разбуди|погуляй|\
        follow|guide|escort|lead|accompany|introduce|meet|greet|sing|dance|cook|bake|wash|mop|vacuum|sweep|wipe|feed|pour|take out the trash|take out the garbage|take out the rubbish|go around|drive around|go round|покажи|покажите|tell me a joke|tell a joke|turn around|turn round|rotate|spin|развернись|вытри|\
        repair|fix|buy|order|wake up|play|photograph|say|speak|slice|eat|boil|make",
    ),
    (
        Meaning::Verb(Verb::Move),
        "перемести|переместите|переместить|передвинь|передвиньте|передвинуть|подвинь|подвиньте|сдвинь|сдвиньте|перетащи|перетащите|подтолкни|толкни|отодвинь|пододвинь|придвинь|move|shift|push|pull|drag|slide|shove",
    ),
    (Meaning::Verb(Verb::Get), "get|go get|go and get|go fetch|getting"),
    (
        Meaning::Verb(Verb::Bring),
        "принеси|принесите|принести|неси|несите|привези|привезите|привезти|доставь|доставьте|доставить|подай|подайте|\
        подать|дай|дайте|дать|достань|достаньте|отдай|отдайте|отдать|притащи|притащите|принесите ка|подкинь|передай|передайте|тащи|неси ка|bring|bring over|bring back|fetch|go fetch me|get me|give|deliver|hand|hand over|carry|pass|serve|grab me|bringing|bringing me|fetching|handing me|passing me|giving me",
    ),
    (
        Meaning::Verb(Verb::Need),
        "нужен|нужна|нужно|нужны|хочу|хотел бы|хотела бы|хочется|need|want|would like|d like",
    ),
    (
        Meaning::Verb(Verb::Take),
        "сними|снимите|снять|возьми|возьмите|взять|бери|собери|соберите|собрать|забери|заберите|забрать|подними|поднимите|поднять|схвати|схватите|захвати|захватите|прихвати|ухвати|take|take out|take hold of|pick up|pick|grab|grasp|lift|lift up|collect|get hold of|taking|picking up",
    ),
    (
        Meaning::Verb(Verb::Put),
        "вези|везите|положи|положите|положить|клади|поставь|поставьте|поставить|ставь|помести|поместите|поместить|повесь|повесьте|\
        отнеси|отнесите|отнести|отвези|отвезите|отвезти|перенеси|перенесите|перенести|переставь|переставьте|переложи|переложите|\
        брось|бросьте|кинь|киньте|сложи|сложите|засунь|засуньте|вложи|вложите|унеси|унесите|увези|вынеси|вынесите|вывези|оставь|оставьте|\
        put|place|set|lay|hang|drop|throw|toss|поднеси|поднесите|drop off|insert|putting|placing",
    ),
    (
        Meaning::Verb(Verb::ThrowAway),
        "выброси|выбросите|выбросить|выбрасывай|выбрасывайте|выкинь|выкиньте|выкинуть|выкидывай|избавься от|избавьтесь от|\
        throw away|throw out|toss away|toss out|get rid of|dispose of|discard",
    ),
    (Meaning::Verb(Verb::SetDown), "опусти|опустите|put down|set down|lay down"),
    (
        Meaning::Verb(Verb::Clear),
        "убери|уберите|убрать|убирай|спрячь|спрячьте|put away|clear|clear up|clear away|stow|hide",
    ),
    (
        Meaning::Verb(Verb::Open),
        "открой|откройте|открыть|открывай|открывайте|opening|отвори|отворите|распахни|распахните|приоткрой|приоткройте|open|open up",
    ),
    (
        Meaning::Verb(Verb::Close),
        "закрой|закройте|закрыть|закрывай|закрывайте|closing|shutting|прикрой|прикройте|затвори|затворите|захлопни|захлопните|close|shut|close up",
    ),
    (Meaning::Verb(Verb::Lock), "запри|заприте|запереть|запирай|замкни|замкните|lock|lock up"),
    (
        Meaning::Verb(Verb::Unlock),
        "отопри|отоприте|отпереть|отпирай|отомкни|отомкните|разблокируй|разблокируйте|unlock",
    ),
    (
        Meaning::Verb(Verb::SwitchOn),
        "включи|включите|включить|включай|зажги|light up|зажгите|зажечь|вруби|врубите|запусти|запустите|turn on|switch on|power on|power up|start|activate|turning on|switching on",
    ),
    (
        Meaning::Verb(Verb::SwitchOff),
        "выключи|выключите|выключить|отключи|отключите|погаси|погасите|погасить|потуши|потушите|потушить|туши|выключай|гаси|выруби|вырубите|отключить|turn off|switch off|power off|power down|shut off|shut down|deactivate|turn out|turning off|switching off|kill",
    ),
    (
        Meaning::Verb(Verb::Find),
        "найди|найдите|найти|отыщи|отыщите|поищи|поищите|разыщи|разыщите|ищи|ищите|высмотри|find|find me|look for|search for|locate|seek|go find|hunt for|finding|looking for",
    ),
    (
        Meaning::Verb(Verb::Tidy),
        "приберись|приведи в порядок|приведите в порядок|привести в порядок|приберитесь|прибраться|прибери|наведи порядок|наведите порядок|навести порядок|уберись|уберитесь|убраться|приберите|разбери завалы|разложи всё по местам|разложи все вещи по местам|разложи вещи по местам|расставь всё по местам|tidy|tidy up|clean up|clean out|straighten up|neaten",
    ),
    (Meaning::Verb(Verb::Clean), "почисти|почистите|очисти|очистите|отчисти|clean"),
    (
        Meaning::Verb(Verb::CallOperator),
        "приведи оператора|приведи сюда оператора|пригласи оператора|bring the operator|bring the operator here|позови оператора|позовите оператора|вызови оператора|вызовите оператора|позвать оператора|вызвать оператора|\
        позвони оператору|свяжись с оператором|кликни оператора|крикни оператора|call operator|call the operator|call an operator|ask the operator|\
        get the operator|fetch the operator|call for the operator|summon the operator|call for help|get help|alert the operator|ask the operator to come|на помощь|позови кого нибудь на помощь|tell the operator to come|скажи оператору|скажи оператору подойти|call someone|call somebody|call a human|call a person|call a man|get someone|get somebody|позови человека|позовите человека|позови кого нибудь|позовите кого нибудь|позови людей|вызови человека|позови помощь|зови на помощь|оператора сюда|оператор сюда|operator please|operator over here|позови на помощь|зови оператора",
    ),
    (
        Meaning::Verb(Verb::CallLift),
        "вызови лифт|вызовите лифт|вызвать лифт|call lift|call the lift|call a lift|call the elevator|call an elevator|summon the lift",
    ),
    (
        Meaning::Verb(Verb::Stop),
        "стоп|стой|стойте|остановись|остановитесь|остановиться|хватит|прекрати|прекратите|отмена|отмени|отмени задание|\
        забудь|забудьте|забей|неважно|не важно|передумал|передумала|я передумал|я передумала|отставить|\
        stop|halt|cancel|abort|freeze|never mind|nevermind|forget it|forget about it|stop it|cancel that|don t bother",
    ),
    (
        Meaning::Verb(Verb::Needless),
        "не надо|не нужно|не нужна|не нужен|не нужны|no need|not needed|not necessary",
    ),
    (
        Meaning::Verb(Verb::Report),
        "доложи|доложите|доложить|доложи где находишься|доложи своё положение|доложи положение|доложи местоположение|доложи где ты находишься|доложи обстановку|доложи о состоянии|доложи где ты|отчитайся|сообщи где ты|сообщи где ты находишься|\
        сообщи своё положение|сообщи|сообщите|сообщи положение|сообщи местоположение|сообщи своё местоположение|доложи своё местоположение|где ты|где ты находишься|где ты сейчас|report|report your position|report position|report your location|report where you are|report back|where are you|\
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
    (
        link(Relation::LeftOf, Role::WhereOrWhither),
        "слева от|левее|по левую сторону от|с левой стороны от|to the left of|to the left side of|on the left of|on the left side of|left of",
    ),
    (
        link(Relation::RightOf, Role::WhereOrWhither),
        "справа от|правее|по правую сторону от|с правой стороны от|to the right of|to the right side of|on the right of|on the right side of|right of",
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
        "time to|it s time to|it is time to|пора бы|пора уже|уже пора|пожалуйста|плиз|если можно|если не сложно|если получится|как освободишься|когда освободишься|можно попросить тебя|можно тебя попросить|можно вас попросить|if you can|if possible|possibly|perhaps|maybe|может быть|if you please|if you don t mind|when you are free|when you can|a moment|a minute|a second|a bit|минуту|минутку|секунду|секундочку|что ближе|какая ближе|какой ближе|что поближе|whichever is closer|whichever is nearer|either|либо|и больше ничего|больше ничего|но никуда не едь|никуда не едь|никуда не уезжай|and nothing else|пж|plz|pls|find out|спасибо|заранее спасибо|thanks|thank you|будь так любезен|будь так любезна|будьте так любезны|будь любезен|будь любезна|будьте любезны|будьте так добры|\
        instead|вместо этого|вместо того|сначала|сперва|для начала|first|first of all|firstly|next|finally|наконец|после|заодно|давай|давайте|а ну|пора|слушай|эй|так|обратно|назад|back|back again|\
        поближе|ближе|closer|a bit|a little|at once|until i come|пока я не приду|again|as well|once more|снова|опять|да|стоит|лежит|находится|висит|стоят|лежат|where it belongs|side by side|if so|если да|в таком случае|тогда|a little bit|slightly|чуть чуть|немножко|чуток|поскорее|побыстрее|живо|немедленно|аккуратно|тихо|немного|чуть|просто|ещё|тоже|also|too|just|right now|immediately|gently|straight|away|over|\
        can you please|could you kindly|would you mind|would you kindly|be so kind as to|be so kind to|be so kind and|be a dear and|be so kind|be able to|do me a favour and|do me a favor and|behind you|behind yourself|from here|ok|okay|alright|so|let s|we|us|i d like you to|i would like you to|i want you to|i need you to|\
        хочу чтобы ты|хотел бы чтобы ты|хотелось бы|для нас|нужно чтобы ты|попрошу|попрошу тебя|сможешь|сможете|сумеешь|могла бы ты|ты можешь|ты можете|\
        будь другом|за собой|отсюда|здесь|любой|любую|любое|какую нибудь|any|some|one|one of the|какое нибудь|каких нибудь|одного|будь добр|будь добра|будьте добры|будь так добр|прошу|прошу тебя|прошу вас|если не трудно|можешь|можете|можно|мог бы ты|\
        могли бы вы|не мог бы ты|не могли бы вы|не можешь|не можете|ты не мог бы|ты|вы|бы|ли|надо|необходимо|чтобы|чтобы ты|я|мы|нам|быстро|быстрее|скорее|срочно|осторожно|сейчас|теперь|\
        тут|там|туда|вот|ка|же|ну|ладно|хорошо|привет|здравствуй|здравствуйте|робот|рб|рб 2|этот|эту|это|эти|тот|ту|те|мой|мою|моё|мои|свой|свою|своё|для меня|\
        какой нибудь|кое что|свободный|одну|один|какую то|please|could you|could you please|can you|would you|will you|would you please|robot|hey|hello|hi|\
        вон|везде|повсюду|everywhere|in a minute|in a moment|in a second|a|an|the|this|that|these|those|my|your|some|now|quickly|quick|fast|carefully|there|for me|kindly|i|d like you to|like|you",
    ),
    (
        link(Relation::Between, Role::WhereOrWhither),
        "между|between|in between|посередине между|посреди между|halfway between|midway between",
    ),
    (
        link(Relation::Middle, Role::WhereOrWhither),
        "посреди|посередине|в середину|в середине|на середину|на середине|в центр|в центре|на центр|по центру|\
        in the middle of|into the middle of|to the middle of|in the centre of|in the center of|to the centre of|to the center of|at the centre of|at the center of|in middle of|in the very middle of",
    ),
    (
        link(Relation::Facing, Role::Where),
        "лицом к|лицом ко|передом к|носом к|повернувшись к|глядя на|facing|facing towards|facing toward|face to face with|looking at|looking towards",
    ),
    (
        Meaning::Verb(Verb::Charge),
        "зарядись|зарядитесь|заряжайся|заряжайтесь|подзарядись|заряжаться|зарядиться|подзарядиться|подзаряжайся|charge|recharge|charge yourself|recharge yourself|charge up|charge your battery|charge your batteries|dock|dock yourself",
    ),
    (
        Meaning::Haunt(Haunt::Charger),
        "на зарядку|на подзарядку|к зарядке|на зарядную станцию|к зарядной станции|на док станцию|к док станции|to charge|to recharge|to charger|to your charger|to the charger|to the charging station|to your charging station|to the charging point|to the dock|to your dock|to the docking station|to your docking station",
    ),
    (
        Meaning::Haunt(Haunt::Home),
        "домой|на базу|на свою базу|на исходную|на исходную позицию|в исходную точку|на исходное место|home|to base|to your base|back to base|to your starting point|to the starting point|to where you started|to your home|to your home position",
    ),
    (
        Meaning::OnFloor,
        "на пол|на полу|на землю|on floor|on the floor|onto the floor|to the floor|down on the floor|on the ground|onto the ground",
    ),
    (
        Meaning::FacingWall,
        "лицом к стене|лицом к стенке|передом к стене|носом к стене|facing the wall|facing a wall|facing wall|facing the nearest wall|лицом к ближайшей стене",
    ),
    (Meaning::WithKey, "на ключ|на замок|with the key|with a key"),
    (
        Meaning::And,
        "и|а|но|but|а затем|затем|потом|после этого|после чего|а потом|а оттуда|а уже оттуда|и потом|и затем|дальше|далее|then|and|and then|after that|afterwards|and after that|followed by",
    ),
    (
        Meaning::All,
        "все|всю|обе|оба|обоих|обеих|всё|весь|всех|всей|всего|всему|всём|каждую|каждый|каждое|каждой|каждого|каждом|каждому|all|all the|all of the|every|each|both|both the|everything",
    ),
    (Meaning::Not, "не|нельзя|никогда|not|never|don t|do not|dont"),
    (
        Meaning::Me,
        "мне|меня|ко мне|до меня|сюда|оператору|к оператору|to the operator|to operator|me|to me|here|over here",
    ),
    (Meaning::Pronoun, "его|её|него|неё|ней|ему|нему|нём|ей|ею|it|him|her"),
    (Meaning::Them, "их|них|им|ним|ими|ними|them|both of them|all of them"),
];

/// What takes back what was ordered before it, and says what is meant instead.
pub(super) const CORRECTIONS: &str = "no|no no|no sorry|sorry|oh no|oops|actually|or rather|rather|i mean|i meant|make that|make it|scratch that|or better|better|\
    нет|нет нет|ой|ой нет|вернее|точнее|лучше|а лучше|хотя нет|хотя лучше|то есть|извини|извините|прости|простите|или нет|или лучше|я имел в виду|я имела в виду";

/// What may do so, and may also be said by itself.
pub(super) const HESITATIONS: &str = "wait|hold on|oh|hm|стоп|стой|погоди|постой|подожди|ну";

/// Past forms, which order behind «чтобы» and «бы» alone: «хочу, чтобы ты закрыл дверь». «Ты закрыл дверь?» orders nothing.
const WISHED: &[(Verb, &str)] = &[
    (Verb::GoTo, "поехал|подъехал"),
    (Verb::Bring, "принёс|принесла|привёз|достал|подал"),
    (Verb::Take, "взял"),
    (Verb::Put, "положил|поставил|отнёс"),
    (Verb::Open, "открыл"),
    (Verb::Close, "закрыл"),
    (Verb::Lock, "запер"),
    (Verb::SwitchOn, "включил"),
    (Verb::SwitchOff, "выключил"),
    (Verb::Find, "нашёл"),
];

/// Whether a word, in [`name_key`] form, orders behind «чтобы» and «бы» alone.
pub(super) fn is_wished(word: &str) -> bool {
    static FORMS: OnceLock<HashSet<String>> = OnceLock::new();
    let forms = || WISHED.iter().flat_map(|(_, list)| list.split('|')).map(name_key).collect();
    FORMS.get_or_init(forms).contains(word)
}

/// The meaning of the longest phrase at the beginning of these words (in [`name_key`] form),
/// with the number of words that it takes.
pub(super) fn longest<'k>(
    words: &(impl Iterator<Item = &'k str> + Clone),
) -> Option<(usize, Meaning)> {
    type Phrases = Vec<(Vec<String>, Meaning)>;
    static TABLE: OnceLock<HashMap<String, Phrases>> = OnceLock::new();
    let table = TABLE.get_or_init(|| {
        let mut table: HashMap<String, Phrases> = HashMap::new();
        for (meaning, phrase) in phrases() {
            let words: Vec<String> = phrase.split_whitespace().map(name_key).collect();
            table.entry(words[0].clone()).or_default().push((words, meaning));
        }
        for phrases in table.values_mut() {
            phrases.order_by_key(|(words, _)| std::cmp::Reverse(words.len()));
        }
        table
    });
    let first = words.clone().next()?;
    let Some(phrases) = table.get(first) else { return inflected(first).map(|verb| (1, verb)) };
    phrases.iter().find_map(|(phrase, meaning)| Some((taken(phrase, words.clone())?, *meaning)))
}

/// How many words a phrase takes at the beginning of some: its own, and politeness between them («позови, пожалуйста,
/// оператора»).
fn taken<'k>(phrase: &[String], words: impl Iterator<Item = &'k str>) -> Option<usize> {
    const BETWEEN: [&str; 8] =
        ["пожалуйста", "плиз", "мне", "нам", "скорее", "быстрее", "please", "quickly"];
    let mut left = phrase.iter();
    let mut wanted = left.next()?;
    for (n, word) in words.enumerate() {
        if word == wanted {
            match left.next() {
                Some(next) => wanted = next,
                None => return Some(n + 1),
            }
        } else if n == 0 || !BETWEEN.contains(&word) {
            return None;
        }
    }
    None
}

/// A Russian verb in a form that orders or asks, found by its infinitive: «сгонять» as «сгоняй», «принесёшь» as
/// «принеси»; of another aspect by its stem, «вырубай» as «выруби».
fn inflected(word: &str) -> Option<Meaning> {
    static INFINITIVES: OnceLock<HashMap<String, Meaning>> = OnceLock::new();
    static STEMS: OnceLock<HashMap<String, Option<Meaning>>> = OnceLock::new();
    let infinitive = ordering_verb(word)?;
    let table = INFINITIVES.get_or_init(|| {
        let mut table: HashMap<String, Meaning> = HashMap::new();
        for (meaning, phrase) in phrases().filter(|(_, phrase)| !phrase.contains(' ')) {
            let able = matches!(meaning, Meaning::Verb(verb) if verb != Verb::Unable);
            if let Some(infinitive) = able.then(|| ordering_verb(phrase)).flatten() {
                table.entry(infinitive).or_insert(meaning);
            }
        }
        table
    });
    // A stem that verbs of several meanings share tells nothing.
    let stems = STEMS.get_or_init(|| {
        let mut stems: HashMap<String, Option<Meaning>> = HashMap::new();
        for (infinitive, meaning) in table {
            let Some(stem) = stem_of(infinitive) else { continue };
            let one = stems.entry(stem.to_owned()).or_insert(Some(*meaning));
            *one = one.filter(|known| known == meaning);
        }
        stems
    });
    let known = table.get(&infinitive).copied();
    known.or_else(|| stems.get(stem_of(&infinitive)?).copied().flatten())
}

/// What verbs of both aspects share: «включ» of «включить» and «включать», «откр» of «открыть» and «открывать».
fn stem_of(infinitive: &str) -> Option<&str> {
    const ENDINGS: [&str; 8] = ["ывать", "ивать", "авать", "ать", "ять", "ить", "ыть", "еть"];
    let stem = ENDINGS.iter().find_map(|ending| infinitive.strip_suffix(ending))?;
    (stem.chars().count() >= 4).then_some(stem)
}

/// All verbs, to offer the one that was meant.
pub(super) fn verbs() -> impl Iterator<Item = &'static str> {
    phrases().filter(|(meaning, _)| matches!(meaning, Meaning::Verb(_))).map(|(_, phrase)| phrase)
}

fn phrases() -> impl Iterator<Item = (Meaning, &'static str)> {
    let wished = WISHED.iter().map(|(verb, list)| (Meaning::Verb(*verb), *list));
    let all = VOCABULARY.iter().copied().chain(wished);
    all.flat_map(|(meaning, list)| list.split('|').map(move |phrase| (meaning, phrase.trim())))
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
            if let Some(other) = seen.insert(name_key(phrase), meaning) {
                assert_eq!(other, meaning, "{phrase}");
            }
        }
    }
}
