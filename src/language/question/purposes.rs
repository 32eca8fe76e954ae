//! Sorts of things above the types of a map: "food", «посуда», "thing to cut with".
//!
//! After the hypernyms of everyday nouns. Invariant: a sort consists of kinds that the map has; a word that the map
//! itself uses is never taken from it. What is done with the things of a sort is listed in `uses`.

use std::collections::HashSet;
use std::sync::OnceLock;

use crate::units::name_key;
use crate::words::english::plural;
use crate::words::{Language, NounPhrase, WordHints};

/// What part things of a sort have in what is done, after the thematic roles of verbs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// What it is done to: what is eaten or read.
    Patient,
    /// What is moved or switched by it.
    Theme,
    /// With what: what cuts, writes, wipes.
    Instrument,
    /// Out of what: what one drinks from.
    Source,
    /// Where, in or on what.
    Location,
}

/// A sort of things: the words for it, its part in what is done, and the kinds that belong to it.
pub(super) struct Sort {
    /// The first is what such things are counted by; «|» between words.
    pub(super) russian: &'static str,
    pub(super) english: &'static str,
    pub(super) role: Role,
    /// Names of kinds, in either language, or of sorts listed before.
    pub(super) members: &'static str,
}

impl Sort {
    /// Whether people call such things so: tools and places are told by what is done with them.
    pub(super) fn is_spoken(&self) -> bool {
        matches!(self.role, Patient | Theme)
    }
}

const fn sort(
    russian: &'static str,
    english: &'static str,
    role: Role,
    members: &'static str,
) -> Sort {
    Sort { russian, english, role, members }
}

use Role::{Instrument, Location, Patient, Source, Theme};

/// All sorts; the number of one is its place here.
pub(super) const SORTS: &[Sort] = &[
    sort(
        "фрукт",
        "fruit",
        Patient,
        "apple|banana|orange|pear|peach|plum|lime|lemon|grape|kiwi|mango|cherry|яблоко|банан|апельсин|груша|персик|слива|лайм|лимон|виноград",
    ),
    sort(
        "овощ",
        "vegetable",
        Patient,
        "tomato|potato|lettuce|carrot|cucumber|bell pepper|onion|cabbage|помидор|картофель|салат|морковь|огурец|лук|капуста",
    ),
    sort(
        "продукт|еда|пища|съестное|съедобное|продукт питания",
        "food item|food|foodstuff|groceries",
        Patient,
        "fruit|vegetable|bread|egg|cheese|meat|pie|cake|cereal|chips|cupcake|cookie|chocolate|candy bar|candy|sandwich|pancake|pudding|salmon|chicken|milk|sugar|хлеб|яйцо|сыр|мясо|пирог|кекс|чипсы|печенье|шоколад|конфета|бутерброд|молоко|сахар",
    ),
    sort(
        "напиток",
        "drink|beverage",
        Patient,
        "milk|juice|wine|water|beer|tea|coffee|wine bottle|water bottle|bottle of wine|молоко|сок|вино|вода|пиво|бутылка вина|бутылка воды",
    ),
    sort(
        "вещь для питья",
        "thing to drink from",
        Source,
        "cup|mug|glass|wine glass|water glass|чашка|кружка|стакан|бокал",
    ),
    sort(
        "столовый прибор",
        "piece of cutlery|cutlery|silverware",
        Patient,
        "knife|fork|spoon|butter knife|нож|вилка|ложка",
    ),
    sort(
        "предмет посуды|посуда",
        "piece of crockery|crockery|tableware|dishware|dish|kitchenware",
        Patient,
        "cup|mug|glass|wine glass|water glass|plate|bowl|pot|pan|cutlery|kettle|ladle|spatula|teapot|coffee pot|frying pan|чашка|кружка|стакан|тарелка|миска|кастрюля|сковорода|чайник|половник|столовый прибор|кофейник",
    ),
    sort(
        "вещь для чтения",
        "thing to read|reading matter",
        Patient,
        "book|newspaper|magazine|журнал|книга|газета",
    ),
    sort(
        "вещь для письма",
        "thing to write with|writing utensil",
        Instrument,
        "pen|pencil|marker|ручка|карандаш|маркер|фломастер",
    ),
    sort(
        "лампа",
        "lamp",
        Patient,
        "торшер|настольная лампа|люстра|бра|ночник|floor lamp|table lamp|desk lamp|ceiling lamp|wall lamp",
    ),
    sort("часы", "clock", Patient, "будильник|настенные часы|alarm clock|wall clock"),
    sort(
        "место для мытья рук",
        "place to wash hands",
        Location,
        "sink|wash basin|раковина|умывальник|мойка|kitchen sink|bathroom sink",
    ),
    sort(
        "место для мытья посуды",
        "place to wash dishes",
        Location,
        "dishwasher|sink|kitchen sink|посудомоечная машина|раковина|мойка",
    ),
    sort(
        "место для стирки",
        "place to wash clothes",
        Location,
        "washing machine|стиральная машина",
    ),
    sort(
        "место для мытья",
        "place to wash",
        Location,
        "shower|bathtub|bath|sink|shower cabin|душ|ванна|раковина|душевая кабина",
    ),
    sort(
        "вещь для резки",
        "thing to cut with",
        Instrument,
        "knife|scissors|butter knife|нож|ножницы",
    ),
    sort(
        "место для еды",
        "place to eat at",
        Location,
        "dining table|обеденный стол|kitchen table|кухонный стол",
    ),
    sort(
        "вещь для готовки",
        "thing to cook with",
        Location,
        "stove|oven|microwave|stove burner|microwave oven|hob|cooker|плита|духовка|духовой шкаф|микроволновая печь|варочная панель",
    ),
    sort(
        "вещь для разогревания",
        "thing to warm food with",
        Location,
        "microwave|microwave oven|stove|oven|микроволновая печь|плита",
    ),
    sort(
        "вещь для кипячения воды",
        "thing to boil water with",
        Instrument,
        "kettle|stove|чайник|плита",
    ),
    sort(
        "вещь для варки кофе",
        "thing to make coffee with",
        Instrument,
        "coffee machine|coffee maker|coffee pot|кофеварка|кофемашина",
    ),
    sort(
        "место для мусора",
        "place for rubbish",
        Location,
        "bin|trash can|garbage can|waste bin|rubbish bin|dumpster|мусорное ведро|мусорная корзина|мусорный контейнер|урна",
    ),
    sort(
        "место для одежды",
        "place for clothes",
        Location,
        "coat rack|hanger|wardrobe|hook|closet|вешалка|шкаф|крючок|гардероб",
    ),
    sort("место для работы", "place to work", Location, "desk|письменный стол|рабочий стол"),
    sort(
        "вещь для звонков",
        "thing to call with",
        Instrument,
        "telephone|phone|cell phone|телефон",
    ),
    sort("переносимая вещь", "portable thing", Theme, "small object"),
    sort("подвижная вещь", "movable thing", Theme, "small object|movable object"),
    sort("включаемый прибор", "switchable thing", Theme, "appliance|light fixture"),
    sort(
        "предмет электроники|электроника",
        "electronic device|electronics",
        Patient,
        "television|computer|laptop|telephone|cell phone|phone|radio|printer|tablet|monitor|remote control|alarm clock|телевизор|компьютер|ноутбук|телефон|радио|принтер|монитор",
    ),
    sort(
        "спортивный предмет|спортинвентарь|спортивный инвентарь|спорттовар",
        "sports item|sports equipment|sports gear|sporting goods",
        Patient,
        "basketball|ball|baseball bat|bat|tennis racket|racket|dumbbell|мяч|бита|ракетка|гантель",
    ),
    sort(
        "игрушка",
        "toy",
        Patient,
        "teddy bear|ball|doll|basketball|toy|плюшевый медведь|мяч|кукла|игрушка",
    ),
    sort(
        "вещь для еды",
        "thing to eat with",
        Instrument,
        "fork|spoon|table knife|chopsticks|вилка|ложка",
    ),
    sort("ёмкость для еды", "thing to eat from", Source, "plate|bowl|тарелка|миска"),
    sort("вещь для супа", "thing to eat soup with", Instrument, "spoon|ложка"),
    sort(
        "место для купания",
        "place to bathe",
        Location,
        "shower|bathtub|bath|shower cabin|shower head|душ|ванна|душевая кабина",
    ),
    sort(
        "вещь для мытья рук",
        "thing to wash hands with",
        Instrument,
        "soap|soap bottle|soap dispenser|sink|мыло|жидкое мыло|раковина|умывальник",
    ),
    sort(
        "вещь для мытья посуды",
        "thing to wash dishes with",
        Instrument,
        "sponge|dish sponge|dishwasher|dishwashing liquid|soap bottle|soap|scrub brush|губка|мыло|жидкое мыло|моющее средство",
    ),
    sort(
        "вещь для мытья",
        "thing to wash with",
        Instrument,
        "soap|soap bottle|shampoo|мыло|флакон мыла|шампунь",
    ),
    sort("вещь для мытья головы", "thing to wash hair with", Instrument, "shampoo|шампунь"),
    sort(
        "вещь для вытирания",
        "thing to wipe with",
        Instrument,
        "paper towel|towel|cloth|rag|sponge|dish sponge|полотенце|бумажное полотенце|тряпка|губка",
    ),
    sort(
        "вещь для вытирания насухо",
        "thing to dry with",
        Instrument,
        "towel|hand towel|paper towel|cloth|полотенце|бумажное полотенце|тряпка",
    ),
    sort(
        "вещь для уборки",
        "thing to clean with",
        Instrument,
        "broom|mop|vacuum cleaner|rag|cloth|sponge|scrub brush|brush|paper towel|dish sponge|towel|веник|швабра|пылесос|тряпка|губка|полотенце|бумажное полотенце|щётка",
    ),
    sort(
        "вещь для подметания",
        "thing to sweep with",
        Instrument,
        "broom|brush|dustpan|веник|метла|щётка",
    ),
    sort("вещь для мытья пола", "thing to mop with", Instrument, "mop|rag|швабра|тряпка"),
    sort("вещь для чистки ковра", "thing to vacuum with", Instrument, "vacuum cleaner|пылесос"),
    sort("вещь для прочистки", "thing to unclog with", Instrument, "plunger|вантуз"),
    sort(
        "вещь для чистки зубов",
        "thing to brush teeth with",
        Instrument,
        "toothbrush|toothpaste|зубная щётка|зубная паста",
    ),
    sort(
        "вещь для носа",
        "thing to blow your nose with",
        Instrument,
        "tissue box|paper towel|салфетки|коробка салфеток",
    ),
    sort("вещь для соли", "thing to salt food with", Instrument, "salt shaker|salt|солонка|соль"),
    sort(
        "вещь для перца",
        "thing to pepper food with",
        Instrument,
        "pepper shaker|pepper mill|перечница",
    ),
    sort(
        "приправа",
        "thing to season food with",
        Instrument,
        "salt shaker|pepper shaker|salt|солонка|перечница|соль",
    ),
    sort("вещь для жарки хлеба", "thing to toast bread with", Instrument, "toaster|тостер"),
    sort(
        "вещь для жарки",
        "thing to fry with",
        Instrument,
        "pan|frying pan|spatula|сковорода|лопатка",
    ),
    sort("вещь для варки", "thing to boil food in", Instrument, "pot|saucepan|кастрюля"),
    sort(
        "вещь для выпечки",
        "thing to bake in",
        Location,
        "oven|stove|microwave oven|духовка|духовой шкаф|плита",
    ),
    sort("вещь для наливания", "thing to pour with", Instrument, "ladle|половник"),
    sort(
        "вещь для помешивания",
        "thing to stir with",
        Instrument,
        "spoon|ladle|spatula|ложка|половник|лопатка",
    ),
    sort("вещь для переворачивания", "thing to turn food over with", Instrument, "spatula|лопатка"),
    sort(
        "вещь для опрыскивания",
        "thing to spray with",
        Instrument,
        "spray bottle|распылитель|пульверизатор",
    ),
    sort(
        "вещь для поливки",
        "thing to water plants with",
        Instrument,
        "watering can|spray bottle|лейка|распылитель",
    ),
    sort("место для цветов", "place for flowers", Location, "vase|ваза"),
    sort(
        "вещь для ударов по мячу",
        "thing to hit a ball with",
        Instrument,
        "baseball bat|tennis racket|racket|бейсбольная бита|теннисная ракетка|ракетка",
    ),
    sort(
        "вещь для игры в теннис",
        "thing to play tennis with",
        Instrument,
        "tennis racket|ball|tennis ball|теннисная ракетка|мяч",
    ),
    sort(
        "вещь для игры в бейсбол",
        "thing to play baseball with",
        Instrument,
        "baseball bat|ball|бейсбольная бита|мяч",
    ),
    sort(
        "вещь для баскетбола",
        "thing to play basketball with",
        Instrument,
        "basketball|ball|мяч|баскетбольный мяч",
    ),
    sort(
        "вещь для игр",
        "thing to play with",
        Instrument,
        "toy|baseball bat|tennis racket|basketball|игрушка|бейсбольная бита|теннисная ракетка|мяч",
    ),
    sort("вещь для упражнений", "thing to exercise with", Instrument, "dumbbell|гантель"),
    sort(
        "вещь для просмотра телевизора",
        "thing to watch television on",
        Location,
        "television|телевизор",
    ),
    sort(
        "вещь для просмотра",
        "thing to watch films on",
        Location,
        "television|laptop|computer|monitor|tablet|телевизор|ноутбук|компьютер|монитор",
    ),
    sort(
        "вещь для музыки",
        "thing to listen to music with",
        Instrument,
        "radio|cd player|speaker|радио|магнитола|колонка",
    ),
    sort(
        "вещь для освещения",
        "thing to light a room with",
        Instrument,
        "light fixture|candle|lamp|lantern|лампа|свеча|фонарь",
    ),
    sort(
        "вещь для определения времени",
        "thing to tell the time by",
        Instrument,
        "clock|watch|часы|наручные часы|будильник",
    ),
    sort("вещь для пробуждения", "thing to wake up with", Instrument, "alarm clock|будильник"),
    sort(
        "место для собаки",
        "place for a dog to sleep",
        Location,
        "dog bed|лежанка для собаки|собачья лежанка|лежанка",
    ),
    sort(
        "место для холодного",
        "place to keep food cold",
        Location,
        "refrigerator|freezer|fridge|холодильник|морозильник",
    ),
    sort(
        "вещь для глажки",
        "thing to iron with",
        Instrument,
        "iron|ironing board|утюг|гладильная доска",
    ),
    sort(
        "место для грязного белья",
        "place for dirty clothes",
        Location,
        "laundry hamper|washing machine|корзина для белья|стиральная машина",
    ),
    sort(
        "место для хранения одежды",
        "place to keep clothes",
        Location,
        "wardrobe|dresser|closet|шкаф|гардероб|комод|платяной шкаф",
    ),
    sort(
        "место для полотенца",
        "place to hang a towel",
        Location,
        "towel rack|towel holder|вешалка для полотенец|полотенцесушитель",
    ),
    sort("санитарный прибор", "place to relieve yourself", Location, "toilet|унитаз"),
    sort("вещь для причёсывания", "thing to look at yourself in", Location, "mirror|зеркало"),
    sort(
        "вещь для оплаты",
        "thing to pay with",
        Instrument,
        "credit card|кредитная карта|кредитка",
    ),
    sort(
        "место для зарядки",
        "thing to charge a phone with",
        Location,
        "power socket|розетка|зарядное устройство",
    ),
    sort(
        "вещь для печатания",
        "thing to type with",
        Instrument,
        "keyboard|laptop|monitor and keyboard|клавиатура|ноутбук",
    ),
    sort(
        "вещь для интернета",
        "thing to go online with",
        Instrument,
        "laptop|computer|tablet|phone|ноутбук|компьютер|телефон",
    ),
    sort("вещь для печати", "thing to print with", Instrument, "printer|принтер"),
    sort(
        "вещь для переключения",
        "thing to change channels with",
        Instrument,
        "remote control|пульт",
    ),
    sort(
        "вещь для записей",
        "thing to write on",
        Location,
        "paper|notebook|notepad|whiteboard|бумага|доска|блокнот",
    ),
    sort(
        "вещь для лечения",
        "thing to be treated with",
        Instrument,
        "medicine|first aid kit|pill bottle|лекарство|аптечка",
    ),
    sort(
        "вещь для тушения огня",
        "thing to put out a fire with",
        Instrument,
        "fire extinguisher|огнетушитель",
    ),
    sort("вещь для заворачивания", "thing to wrap food in", Instrument, "aluminum foil|фольга"),
];

/// Whether a word is a sort or the kind of one, in either language; the text in [`name_key`](crate::units::name_key) form.
pub(super) fn is_a_word(key: &str) -> bool {
    static WORDS: OnceLock<HashSet<String>> = OnceLock::new();
    let words = WORDS.get_or_init(|| {
        let lists = SORTS.iter().flat_map(|sort| [sort.russian, sort.english, sort.members]);
        let mut words = HashSet::new();
        for word in lists.flat_map(|list| list.split('|')) {
            match Language::of(word) {
                Language::English => words.extend([name_key(word), name_key(&plural(word))]),
                Language::Russian => {
                    let phrase = NounPhrase::parse(word, &WordHints::default());
                    words.extend(phrase.all_forms().iter().map(|(_, _, form)| name_key(form)));
                }
            }
        }
        words
    });
    words.contains(key)
}

/// A sort by its English name.
pub(super) fn sort_called(english: &str) -> Option<u16> {
    let found = SORTS.iter().position(|sort| sort.english.split('|').next() == Some(english));
    found.and_then(|n| u16::try_from(n).ok())
}

/// The part of a sort's things in what is done with them.
pub(super) fn role(sort: u16) -> Role {
    SORTS.get(usize::from(sort)).map_or(Patient, |sort| sort.role)
}
