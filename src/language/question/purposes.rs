//! Sorts of things above the types of a map, and what people do with them: "food", «посуда», "what can I drink from?"
//!
//! After the hypernyms of everyday nouns. Invariant: a sort consists of kinds that the map has; a word that the map
//! itself uses is never taken from it.

/// A sort of things: the words for it, what is done with it, and the kinds that belong to it.
pub(super) struct Sort {
    /// The first is what such things are counted by; «|» between words.
    pub(super) russian: &'static str,
    pub(super) english: &'static str,
    /// Verbs that ask for such things.
    pub(super) deeds: &'static str,
    /// Names of kinds, in either language, or of sorts listed before.
    pub(super) members: &'static str,
}

const fn sort(
    russian: &'static str,
    english: &'static str,
    deeds: &'static str,
    members: &'static str,
) -> Sort {
    Sort { russian, english, deeds, members }
}

/// All sorts; the number of one is its place here.
pub(super) const SORTS: &[Sort] = &[
    sort(
        "фрукт",
        "fruit",
        "",
        "apple|banana|orange|pear|peach|plum|lime|lemon|grape|kiwi|mango|cherry|яблоко|банан|апельсин|груша|персик|слива|лайм|лимон|виноград",
    ),
    sort(
        "овощ",
        "vegetable",
        "",
        "tomato|potato|lettuce|carrot|cucumber|bell pepper|onion|cabbage|помидор|картофель|салат|морковь|огурец|лук|капуста",
    ),
    sort(
        "продукт|еда|пища|съестное|съедобное|продукт питания",
        "food item|food|foodstuff|groceries",
        "есть съестное|поесть|едят|обедают|обедать|ужинать|завтракать|пообедать|поужинать|позавтракать|eat lunch|have lunch|have dinner|have breakfast|съесть|покушать|кушать|скушать|перекусить|закусить|есть|eat|have a snack|have a bite|snack on",
        "fruit|vegetable|bread|egg|cheese|meat|pie|cake|cereal|chips|cupcake|cookie|chocolate|candy bar|candy|sandwich|pancake|pudding|salmon|chicken|milk|sugar|хлеб|яйцо|сыр|мясо|пирог|кекс|чипсы|печенье|шоколад|конфета|бутерброд|молоко|сахар",
    ),
    sort(
        "напиток",
        "drink|beverage",
        "попить|выпить",
        "milk|juice|wine|water|beer|tea|coffee|wine bottle|water bottle|bottle of wine|молоко|сок|вино|вода|пиво|бутылка вина|бутылка воды",
    ),
    sort(
        "вещь для питья",
        "thing to drink from",
        "из чего попить|из чего выпить|пить|пьют|пить чай|пить чаю|пить кофе|попить чаю|выпить чаю|попить кофе|выпить кофе|попить чай|drink from|drink out of|drink tea|drink coffee|drink",
        "cup|mug|glass|wine glass|water glass|чашка|кружка|стакан|бокал",
    ),
    sort(
        "столовый прибор",
        "piece of cutlery|cutlery|silverware",
        "",
        "knife|fork|spoon|butter knife|нож|вилка|ложка",
    ),
    sort(
        "предмет посуды|посуда",
        "piece of crockery|crockery|tableware|dishware|dish|kitchenware",
        "",
        "cup|mug|glass|wine glass|water glass|plate|bowl|pot|pan|cutlery|kettle|ladle|spatula|teapot|coffee pot|frying pan|чашка|кружка|стакан|тарелка|миска|кастрюля|сковорода|чайник|половник|столовый прибор|кофейник",
    ),
    sort(
        "вещь для чтения",
        "thing to read|reading matter",
        "почитать|читать|прочитать|прочесть|читают|read",
        "book|newspaper|magazine|журнал|книга|газета",
    ),
    sort(
        "вещь для письма",
        "thing to write with|writing utensil",
        "писать|пишут|рисуют|написать|записать|рисовать|write with|write|draw with",
        "pen|pencil|marker|ручка|карандаш|маркер|фломастер",
    ),
    sort(
        "лампа",
        "lamp",
        "",
        "торшер|настольная лампа|люстра|бра|ночник|floor lamp|table lamp|desk lamp|ceiling lamp|wall lamp",
    ),
    sort("часы", "clock", "", "будильник|настенные часы|alarm clock|wall clock"),
    sort(
        "место для мытья рук",
        "place to wash hands",
        "помыть руки|мыть руки|вымыть руки|ополоснуть руки|wash hands|wash my hands|wash our hands|wash your hands|wash one s hands|wash up|get some water|набрать воды|налить воды|brush my teeth|почистить зубы",
        "sink|wash basin|раковина|умывальник|мойка|kitchen sink|bathroom sink",
    ),
    sort(
        "место для мытья посуды",
        "place to wash dishes",
        "помыть посуду|мыть посуду|вымыть посуду|wash dishes|wash the dishes|do the dishes|wash plates|wash the plates",
        "dishwasher|sink|kitchen sink|посудомоечная машина|раковина|мойка",
    ),
    sort(
        "место для стирки",
        "place to wash clothes",
        "постирать|стирать|постирать бельё|постирать одежду|wash clothes|wash my clothes|do the laundry|do my laundry|do laundry|wash laundry",
        "washing machine|стиральная машина",
    ),
    sort(
        "место для мытья",
        "place to wash",
        "помыться|умыться|мыться|принять душ|принять ванну|take a shower|have a shower|take a bath|have a bath|wash myself|wash",
        "shower|bathtub|bath|sink|shower cabin|душ|ванна|раковина|душевая кабина",
    ),
    sort(
        "вещь для резки",
        "thing to cut with",
        "порезать|режут|резать|нарезать|разрезать|отрезать|cut|slice|chop|cut with|slice with",
        "knife|scissors|butter knife|нож|ножницы",
    ),
    sort(
        "место для еды",
        "place to eat at",
        "",
        "dining table|обеденный стол|kitchen table|кухонный стол",
    ),
    sort(
        "вещь для готовки",
        "thing to cook with",
        "приготовить еду|готовить еду|приготовить|готовить|сварить|варить|пожарить|жарить|испечь|приготовить обед|cook|prepare food|make dinner|prepare a meal|fry|bake|boil",
        "stove|oven|microwave|stove burner|microwave oven|hob|cooker|плита|духовка|духовой шкаф|микроволновая печь|варочная панель",
    ),
    sort(
        "вещь для разогревания",
        "thing to warm food with",
        "разогреть еду|подогреть еду|разогреть|подогреть|heat up food|warm up food|heat food|warm up|heat up",
        "microwave|microwave oven|stove|oven|микроволновая печь|плита",
    ),
    sort(
        "вещь для кипячения воды",
        "thing to boil water with",
        "вскипятить воду|вскипятить|заварить чай|сделать чай|приготовить чай|boil water|make tea|make some tea",
        "kettle|stove|чайник|плита",
    ),
    sort(
        "вещь для варки кофе",
        "thing to make coffee with",
        "сварить кофе|сделать кофе|приготовить кофе|make coffee|make some coffee|brew coffee",
        "coffee machine|coffee maker|coffee pot|кофеварка|кофемашина",
    ),
    sort(
        "место для мусора",
        "place for rubbish",
        "выбросить мусор|выкинуть мусор|выбросить|выкинуть|throw away rubbish|throw rubbish|throw away|throw out|throw trash|throw the trash|dispose of|throw it away|throw this away|throw it out|throw this out|throw that away|throw something away|throw things away|throw it away|throw this away|get rid of the trash",
        "bin|trash can|garbage can|waste bin|rubbish bin|мусорное ведро|мусорная корзина|урна",
    ),
    sort(
        "место для одежды",
        "place for clothes",
        "повесить одежду|повесить пальто|повесить куртку|повесить|hang my coat|hang a coat|hang up my coat|hang clothes|hang my clothes|hang up",
        "coat rack|hanger|wardrobe|hook|closet|вешалка|шкаф|крючок",
    ),
    sort(
        "место для работы",
        "place to work",
        "поработать|работать|позаниматься|заниматься|учиться|do my homework|work at|work|study",
        "desk|письменный стол|рабочий стол",
    ),
    sort(
        "вещь для звонков",
        "thing to call with",
        "позвонить|звонить|make a call|make a phone call|phone home",
        "telephone|phone|cell phone|телефон",
    ),
    sort(
        "вещь для уборки",
        "thing to clean with",
        "подмести|убраться|вытереть|протереть|помыть пол|clean with|sweep|wipe|mop the floor",
        "broom|mop|vacuum cleaner|rag|cloth|sponge|scrub brush|paper towel|dish sponge|towel|веник|швабра|пылесос|тряпка|губка|полотенце",
    ),
    sort(
        "переносимая вещь",
        "portable thing",
        "переносить|переставить|носить|унести|поднять|принести|перенести|взять с собой|be carried|be taken|be picked up|pick up|carry|bring me",
        "small object",
    ),
    sort(
        "подвижная вещь",
        "movable thing",
        "передвинуть|передвигать|сдвинуть|подвинуть|двигать|переместить|be moved|be pushed|be shifted|push around",
        "small object|movable object",
    ),
    sort(
        "включаемый прибор",
        "switchable thing",
        "включить|выключить|turn on|turn off|switch on|switch off|be switched on|be turned on|be switched off|be turned off",
        "appliance|light fixture",
    ),
    sort(
        "предмет электроники|электроника",
        "electronic device|electronics",
        "",
        "television|computer|laptop|telephone|cell phone|phone|radio|printer|tablet|monitor|телевизор|компьютер|ноутбук|телефон|радио|принтер|монитор",
    ),
    sort(
        "игрушка",
        "toy",
        "играть|поиграть|играют|play with|play",
        "teddy bear|ball|doll|basketball|плюшевый медведь|мяч|кукла",
    ),
];

/// «Из чего попить?» asks for cups, «что попить» for drinks: the sort of what a deed is done out of.
pub(super) fn done_out_of(sort: u16) -> u16 {
    let is_drink = SORTS.get(usize::from(sort)).is_some_and(|s| s.english.starts_with("drink|"));
    let cups = SORTS.iter().position(|s| s.english == "thing to drink from");
    cups.filter(|_| is_drink).and_then(|n| u16::try_from(n).ok()).unwrap_or(sort)
}

/// «Где можно поесть?» asks for a table, «что поесть» for food: the sort of where a deed is done.
pub(super) fn done_at(sort: u16) -> u16 {
    let is_food = SORTS.get(usize::from(sort)).is_some_and(|s| s.english.starts_with("food item|"));
    let tables = SORTS.iter().position(|s| s.english == "place to eat at");
    tables.filter(|_| is_food).and_then(|n| u16::try_from(n).ok()).unwrap_or(sort)
}

/// The sorts of what holds drink and food.
pub(super) fn vessels() -> impl Iterator<Item = u16> {
    let holds = |sort: &Sort| sort.members.split('|').any(|kind| matches!(kind, "cup" | "bowl"));
    SORTS
        .iter()
        .enumerate()
        .filter(move |(_, sort)| holds(sort))
        .filter_map(|(n, _)| u16::try_from(n).ok())
}

/// Whether its verbs say what is done with such things to others: "thing to cut with".
pub(super) fn is_tool(sort: u16) -> bool {
    SORTS.get(usize::from(sort)).is_some_and(|s| s.english.contains(" with"))
}

/// A verb of [`SORTS`] with the number of its sort.
pub(super) fn deeds() -> impl Iterator<Item = (u16, &'static str)> {
    SORTS.iter().enumerate().flat_map(|(n, sort)| {
        let number = u16::try_from(n).unwrap_or(u16::MAX);
        sort.deeds.split('|').filter(|deed| !deed.is_empty()).map(move |deed| (number, deed))
    })
}
