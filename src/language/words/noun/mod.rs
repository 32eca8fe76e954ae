//! Declension of Russian nouns by principal parts, and the principal parts by ending.
//!
//! A noun is determined by five forms: nominative and genitive singular, instrumental singular, nominative and
//! genitive plural. [`Parts::by_ending`] guesses them from the ending, the word list overrides what it knows, and
//! [`Parts::paradigm`] fills in the rest, where nothing is left to guess.
//! Invariant: the nominative of the noun's own number is the word itself.

mod endings;
mod parts;

use std::collections::HashMap;
use std::sync::OnceLock;

use super::grammar::{Animacy, Case, Evidence, Gender, Number};
use super::lexicon;
use parts::Parts;

/// All forms of one word, in lower case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Paradigm {
    forms: [[String; 7]; 2],
    /// Rarer forms that people also say: «дверьми», «комнатою».
    pub(crate) variants: Vec<(Number, Case, String)>,
}

impl Paradigm {
    pub(crate) fn new(form: impl Fn(Number, Case) -> String) -> Self {
        let forms = Number::BOTH.map(|number| Case::ALL.map(|case| form(number, case)));
        Self { forms, variants: Vec::new() }
    }

    /// A word that has one form only.
    pub(crate) fn unchanging(word: &str) -> Self {
        Self::new(|_, _| word.into())
    }

    pub(crate) fn form(&self, number: Number, case: Case) -> &str {
        &self.forms[number.index()][case.index()]
    }
}

/// A noun in lower case with all its forms.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Noun {
    pub(crate) paradigm: Paradigm,
    pub(crate) gender: Gender,
    pub(crate) animacy: Animacy,
    /// The number that the word given stands in.
    pub(crate) number: Number,
    pub(crate) evidence: Evidence,
}

/// What a caller knows of a noun before it is declined.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Known {
    pub(crate) gender: Option<Gender>,
    pub(crate) animacy: Option<Animacy>,
    pub(crate) number: Option<Number>,
}

impl Noun {
    /// Whether it declines as an adjective: «гостиная».
    pub(crate) fn is_adjectival(&self) -> bool {
        let genitive = self.paradigm.form(Number::Plural, Case::Genitive);
        let nominative = self.paradigm.form(Number::Plural, Case::Nominative);
        (genitive.ends_with("ых") || genitive.ends_with("их"))
            && (nominative.ends_with("ые") || nominative.ends_with("ие"))
    }

    /// The noun by the word list, if it is there, and by its ending otherwise.
    pub(crate) fn by_rules(word: &str, known: Known) -> Self {
        let entry = lexicon::find(word);
        let mut parts = Parts::by_ending(word, known, entry);
        if let Some(entry) = entry {
            parts.apply(entry);
        }
        parts.into_noun()
    }
}

/// The word of the list whose nominative plural this is: «стул» for «стулья».
pub(crate) fn singular_of(plural: &str) -> Option<&'static str> {
    static PLURALS: OnceLock<HashMap<String, &'static str>> = OnceLock::new();
    let plural_of = |word| {
        let noun = Noun::by_rules(word, Known::default());
        lexicon::without_yo(noun.paradigm.form(Number::Plural, Case::Nominative))
    };
    let declines = |(_, entry): &(&str, lexicon::Entry)| !entry.plural_only && !entry.indeclinable;
    let plurals = PLURALS.get_or_init(|| {
        let words = lexicon::all().filter(declines);
        words.map(|(word, _)| (plural_of(word), word)).collect()
    });
    plurals.get(&lexicon::without_yo(plural)).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(word: &str, expected: &str) {
        let noun = Noun::by_rules(word, Known::default());
        let all =
            |number| Case::SIX.map(|case| noun.paradigm.form(number, case).to_owned()).join(" ");
        let singular = if noun.number == Number::Plural {
            String::new()
        } else {
            format!("{} / ", all(Number::Singular))
        };
        assert_eq!(format!("{singular}{}", all(Number::Plural)), expected);
    }

    #[test]
    fn endings_alone_decline_what_no_list_holds() {
        check(
            "ступица",
            "ступица ступицы ступице ступицу ступицей ступице / ступицы ступиц ступицам ступицы ступицами ступицах",
        );
        check(
            "станция",
            "станция станции станции станцию станцией станции / станции станций станциям станции станциями станциях",
        );
        check(
            "задвижка",
            "задвижка задвижки задвижке задвижку задвижкой задвижке / задвижки задвижек задвижкам задвижки задвижками задвижках",
        );
        check(
            "черепок",
            "черепок черепка черепку черепок черепком черепке / черепки черепков черепкам черепки черепками черепках",
        );
        check(
            "обогреватель",
            "обогреватель обогревателя обогревателю обогреватель обогревателем обогревателе / обогреватели обогревателей обогревателям обогреватели обогревателями обогревателях",
        );
        check(
            "хранилище",
            "хранилище хранилища хранилищу хранилище хранилищем хранилище / хранилища хранилищ хранилищам хранилища хранилищами хранилищах",
        );
        check(
            "санаторий",
            "санаторий санатория санаторию санаторий санаторием санатории / санатории санаториев санаториям санатории санаториями санаториях",
        );
        check(
            "пристань",
            "пристань пристани пристани пристань пристанью пристани / пристани пристаней пристаням пристани пристанями пристанях",
        );
        check(
            "патио",
            &["патио"; 12].join(" ").replacen(
                "патио патио патио патио патио патио ",
                "патио патио патио патио патио патио / ",
                1,
            ),
        );
        check(
            "мойка",
            "мойка мойки мойке мойку мойкой мойке / мойки моек мойкам мойки мойками мойках",
        );
    }

    /// Household nouns that the word list does not hold: what the endings do with words never seen.
    #[cfg(feature = "rumorph")]
    const UNSEEN: &str = "абажур альбом баллон барабан башня билет блюдо блюдце бочка брелок брошюра будильник бутыль \
        вазон вентилятор верёвка витрина водонагреватель выдвижение газета гардероб гвоздика гирлянда гитара глобус \
        горшок градусник графин гребёнка громкость губка датчик держатель диск документ домофон досуг жакет жалоба \
        желоб живопись зажигалка зонт игла изголовье икона инструмент кабина календарь калькулятор камера канистра \
        карниз кассета кафель клапан клетка клеёнка книжка ковёрчик кожух козырёк колонка колонна комбайн конверт \
        кондиционер консервы контейнер копилка копирка корыто косметичка кофеварка кофта крем крестовина крышка куртка \
        лейка лекция линейка линолеум лоток лупа мангал манекен маска матрас машина мебелька мельница микроскоп миксер \
        модем молоток морозилка мотор мыло мыльница набор накидка насос наволочка нитка ноутбук обогрев обувница огонёк \
        ограда окошко опора отвёртка отделение отопление павильон пакет палитра палка пальма панно пар паркет пылесос \
        пепельница перегородка перчатка печенье пила пинцет платок плафон плед плитка поднос подпорка подсвечник \
        подставка покрывало портрет посуда почта предохранитель прибор провод прожектор простыня пряжа пуговица пузырёк \
        радиатор рама расчёска ремешок решётка рисунок рукомойник рулон рюкзак самовар сахарница свёрток сервер \
        сигнализация сито скобка скульптура совок солонка статуэтка стенд стойло стремянка ступенька сумка сундук \
        сушилка счётчик тапка термометр термос терминал ткань тряпка труба туфля угольник удлинитель украшение урок \
        утюг фартук фен фильтр флакон фляга фонарик форма форточка холст хранение цветочница цифра чехол чайничек \
        чемодан черепица чернила шкатулка шланг шпатель щётка щипчики этажерка этикетка юбка юла якорь ящичек";

    #[cfg(feature = "rumorph")]
    #[test]
    fn endings_alone_are_right_on_unseen_nouns() {
        let (mut good, mut all) = (0, 0);
        let mut wrong = String::new();
        for word in UNSEEN.split_whitespace().filter(|word| lexicon::find(word).is_none()) {
            let Some(truth) = super::super::dictionary::noun(word, Known::default()) else {
                continue;
            };
            let (right, of) = agreement(&truth, &Noun::by_rules(word, Known::default()));
            if right < of {
                wrong.push_str(word);
                wrong.push(' ');
            }
            good += right;
            all += of;
        }
        assert!(all > 2000, "only {all} forms compared");
        assert!(good * 100 >= all * 97, "{good} of {all} forms; wrong: {wrong}");
    }

    #[cfg(feature = "rumorph")]
    #[test]
    fn the_word_list_agrees_with_the_dictionary() {
        let (mut good, mut all) = (0, 0);
        for (word, entry) in lexicon::all().filter(|(_, entry)| !entry.plural_only) {
            let Some(truth) = super::super::dictionary::noun(
                word,
                Known { gender: entry.gender, ..Known::default() },
            ) else {
                continue;
            };
            let (right, of) = agreement(
                &truth,
                &Noun::by_rules(word, Known { animacy: Some(truth.animacy), ..Known::default() }),
            );
            good += right;
            all += of;
        }
        assert!(good * 100 >= all * 98, "{good} of {all} forms agree");
    }

    /// Forms on which two readings of a noun agree, and forms compared. A missing plural is no disagreement.
    #[cfg(feature = "rumorph")]
    fn agreement(truth: &Noun, ours: &Noun) -> (usize, usize) {
        let yo = |form: &str| form.replace('ё', "е");
        let has_plural = truth.paradigm.form(Number::Plural, Case::Dative)
            != truth.paradigm.form(Number::Singular, Case::Dative);
        let numbers = if has_plural { &Number::BOTH[..] } else { &Number::BOTH[..1] };
        let pairs = numbers.iter().flat_map(|number| Case::SIX.map(|case| (*number, case)));
        let right = pairs.clone().filter(|(number, case)| {
            let form = yo(ours.paradigm.form(*number, *case));
            let rarer = truth
                .paradigm
                .variants
                .iter()
                .any(|(n, c, v)| (n, c) == (number, case) && yo(v) == form);
            rarer || yo(truth.paradigm.form(*number, *case)) == form
        });
        (right.count(), pairs.count())
    }
}
