//! Questions of zones: which there are, where the robot may not go, why not, and until when.
//!
//! **Invariant**: every word of a question is one of these questions' own, or of the one name that it asks about; what has
//! others is left to the rest of the grammar.

use std::collections::BTreeMap;

use crate::geometry::{PlacedZone, Polygon, Prism};
use crate::language::question::{Answer, Query, Said, Senses, Thing};
use crate::language::report::Detail;
use crate::language::zones::{when, zone_in_words};
use crate::language::{Case, Language, enumerate};
use crate::map::{Entity, Zone, ZoneKind, plane};
use crate::units::{AreaId, InOrder as _, ZoneId, capitalized, name_key, told};

use super::known::Known;
use super::lexicon::named;
use super::{Error, State};

/// What is asked of zones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ask {
    /// Which there are, of one kind or of any.
    Which(Option<Sort>),
    HowMany(Option<Sort>),
    WhereNot,
    /// Why the robot cannot get there.
    WhyNoWay,
    WhyShut,
    HowLong,
    /// Whether it is closed, or whether it is open.
    IsShut(bool),
}

/// A kind of zones, as people ask for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sort {
    Closed,
    KeepOut,
    Slow,
    OneWay,
}

impl Sort {
    fn fits(self, kind: ZoneKind) -> bool {
        match self {
            Self::Closed => kind == ZoneKind::Closed,
            Self::KeepOut => kind == ZoneKind::KeepOut,
            Self::Slow => matches!(kind, ZoneKind::Slow { .. }),
            Self::OneWay => matches!(kind, ZoneKind::OneWay { .. }),
        }
    }
}

const ZONE: &str = "зона зоны зон зонах zone zones";
const CLOSED: &str = "закрыт закрыта закрыто закрыты закрытые закрытая закрытых closed shut";
const OPEN: &str = "открыт открыта открыто открыты open";
const KEEP_OUT: &str = "запретные запретная запретных запрещенные запрещенных forbidden prohibited";
const SLOW: &str = "медленные медленная медленных slow";
const ONE_WAY: &str = "односторонние односторонняя односторонних";
const BESIDE: &str = "на карте в здании доме тут здесь есть ли сейчас у нас the on map in building \
                      are is there now do you have";
const ABOUT: &str = "в во на к сейчас туда to into in the now";

/// The words of a sentence, and which of them are taken for what they say.
struct Words<'t> {
    text: &'t str,
    ranges: Vec<std::ops::Range<usize>>,
    keys: Vec<String>,
}

impl<'t> Words<'t> {
    fn of(text: &'t str) -> Self {
        let ranges = crate::language::word_ranges(text);
        let keys = ranges.iter().map(|range| name_key(&text[range.clone()])).collect();
        Self { text, ranges, keys }
    }

    fn has(&self, one_of: &str) -> bool {
        self.keys.iter().any(|key| is_one(key, one_of))
    }

    fn has_row(&self, row: &str) -> bool {
        let row: Vec<&str> = row.split(' ').collect();
        self.keys.windows(row.len()).any(|w| w.iter().zip(&row).all(|(key, word)| key == word))
    }

    fn are_all(&self, one_of: &[&str]) -> bool {
        self.keys.iter().all(|key| one_of.iter().any(|words| is_one(key, words)))
    }

    /// The longest row of words for which `find` finds something, where all others are among these.
    fn subject<T>(&self, one_of: &[&str], find: impl Fn(&str) -> Option<T>) -> Option<T> {
        let is_own = |n: usize| one_of.iter().any(|words| is_one(&self.keys[n], words));
        let count = self.keys.len();
        let first = (0..count).find(|n| !is_own(*n)).unwrap_or(count);
        let last = (0..count).rev().find(|n| !is_own(*n)).unwrap_or(0);
        // A name may begin or end with a word that is one of the question's own: «Комната-В».
        let mut rows: Vec<(usize, usize)> = (0..count)
            .flat_map(|from| (from..count).map(move |to| (from, to)))
            .filter(|(from, to)| *from <= first && *to >= last)
            .collect();
        rows.order_by_key(|(from, to)| std::cmp::Reverse(to - from));
        rows.into_iter()
            .find_map(|(from, to)| find(&self.text[self.ranges[from].start..self.ranges[to].end]))
    }
}

fn is_one(key: &str, words: &str) -> bool {
    words.split_whitespace().any(|word| word == key)
}

/// What a sentence asks of zones, without what it is about.
fn asked(words: &Words<'_>) -> Option<(Ask, Vec<&'static str>)> {
    let sorts = [
        (words.has(CLOSED), Sort::Closed),
        (words.has(KEEP_OUT) || words.has_row("keep out"), Sort::KeepOut),
        (words.has(SLOW), Sort::Slow),
        (words.has(ONE_WAY) || words.has_row("one way"), Sort::OneWay),
    ];
    let mut found = sorts.into_iter().filter(|(has, _)| *has).map(|(_, sort)| sort);
    let (sort, is_one_sort) = (found.next(), found.next().is_none());
    if words.has(ZONE) && is_one_sort {
        let asks = "какие какая сколько what which how many keep out one way";
        if words.are_all(&[ZONE, CLOSED, KEEP_OUT, SLOW, ONE_WAY, BESIDE, asks]) {
            let counts = words.has("сколько") || words.has_row("how many");
            let is_asked = counts || words.has("какие какая есть what which are is");
            let ask = if counts { Ask::HowMany(sort) } else { Ask::Which(sort) };
            return is_asked.then(|| (ask, Vec::new()));
        }
    }
    let nowhere = "куда нельзя роботу тебе ехать ездить заезжать въезжать входить заходить \
                   проезжать сейчас where may can cannot can't must mustn't the robot you not go \
                   drive enter now is it isn't allowed to t";
    let is_where = (words.has("куда") && words.has("нельзя"))
        || (words.has("where") && words.has("not cannot can't mustn't t"));
    if is_where && words.are_all(&[nowhere]) {
        return Some((Ask::WhereNot, Vec::new()));
    }
    let why = "почему отчего why";
    if words.has(why) {
        let bars = "нельзя cannot can't not t";
        let ways = "роботу тебе мне пройти проехать войти зайти заехать въехать попасть can the \
                    robot you one i it get go enter drive";
        if words.has(bars) {
            return Some((Ask::WhyNoWay, vec![why, bars, ways, ABOUT]));
        }
        if words.has(CLOSED) {
            return Some((Ask::WhyShut, vec![why, CLOSED, ABOUT, "is", "вход"]));
        }
    }
    let until = words.has_row("до какого времени")
        || words.has_row("до каких пор")
        || words.has_row("до скольки")
        || words.has_row("до которого часа")
        || words.has_row("на сколько")
        || words.has_row("как долго")
        || words.has("надолго насколько")
        || words.has_row("how long")
        || words.has_row("until when")
        || words.has_row("till when");
    let opens = (words.has("когда") && words.has("откроют откроется откроешь открывается"))
        || (words.has("when") && words.has("will does") && words.has("open opened reopen opens"));
    if (until && words.has(CLOSED)) || opens {
        let own = "до какого времени каких пор скольки которого часа на сколько как долго надолго \
                   насколько когда откроют откроется открывается how long until till when will \
                   does be open opened reopen is stay remain for";
        return Some((Ask::HowLong, vec![own, CLOSED, ABOUT, "вход", "зона", "zone"]));
    }
    let is_shut = words.has(CLOSED);
    if is_shut != words.has(OPEN)
        && (words.has("ли is are") || words.text.trim_end().ends_with('?'))
    {
        let state = if is_shut { CLOSED } else { OPEN };
        return Some((Ask::IsShut(is_shut), vec![state, "ли is are the сейчас now"]));
    }
    None
}

impl Known {
    /// The zones that lie on an Area, in force or not, in the order of their ids, each with whether it is all of it.
    fn zones_on(&self, area: AreaId) -> Result<Vec<(ZoneId, bool)>, Error> {
        let Some((map, _)) = self.world().placement(area) else { return Ok(Vec::new()) };
        let floor = self.floor(map)?.with_zones(self.world(), |_| true);
        let Some(placed) = floor.scene().areas.get(&area) else { return Ok(Vec::new()) };
        let whole: f64 = placed.prisms.iter().map(|p| p.polygon.signed_area().abs()).sum();
        let taken = |zone: &PlacedZone| -> f64 {
            let pairs = zone
                .polygons
                .iter()
                .flat_map(|polygon| placed.prisms.iter().map(move |prism| (polygon, prism)));
            let common = |(polygon, prism): (&Polygon, &Prism)| {
                plane::intersection(&prism.polygon.corners, &polygon.corners).area
            };
            pairs.map(common).sum()
        };
        let all = floor.zones().iter().map(|zone| (zone.id, taken(zone)));
        let least = self.relations()?.thresholds().zone_patch.powi(2);
        let lying = all.filter(|(_, taken)| *taken > least);
        Ok(lying.map(|(id, taken)| (id, taken >= whole - least)).collect())
    }
}

impl State {
    /// What each zone of the map says, in words.
    ///
    /// # Errors
    /// There is no map.
    pub fn zones_in_words(&self, language: Language) -> Result<BTreeMap<ZoneId, String>, Error> {
        let world = self.world()?;
        Ok(world.zones.keys().map(|id| (*id, zone_in_words(world, *id, language))).collect())
    }

    /// The answer to a question of zones; none where it is no such question.
    ///
    /// # Errors
    /// As [`State::ask`].
    pub(super) fn ask_of_zones(
        &self,
        text: &str,
        senses: &dyn Senses,
    ) -> Result<Option<Answer>, Error> {
        let words = Words::of(text);
        let Some((ask, own)) = asked(&words) else { return Ok(None) };
        let known = self.around()?;
        let world = known.world();
        let language = Language::of(text);
        let told = |ids: &[ZoneId]| -> String {
            let sentences = ids.iter().map(|id| {
                let words = capitalized(&zone_in_words(world, *id, language));
                let zone = &world.zones[id];
                let idle = told!(language, "not-in-force-now");
                match known.is_in_force(zone) {
                    true => format!("{words}."),
                    false => format!("{words} ({idle})."),
                }
            });
            sentences.collect::<Vec<_>>().join(" ")
        };
        let answer = |said: Said, ids: &[ZoneId], number: Option<f64>, words: String| {
            let rule = "// zones".to_owned();
            let query = Query::Ran { form: "zones", rule };
            let things = ids.iter().map(|id| Thing::Entity(Entity::Zone(*id))).collect();
            let symbols = ids.iter().map(|id| world.zones[id].name.clone()).collect();
            Answer::ran(query, language, said, text, words).of_things(things, symbols, number)
        };
        let of = |is_wanted: &dyn Fn(&Zone) -> bool| -> Vec<ZoneId> {
            world.zones.values().filter(|zone| is_wanted(zone)).map(|zone| zone.id).collect()
        };
        let none = told!(language, "no-such-zones");
        if let Ask::Which(sort) | Ask::HowMany(sort) = ask {
            // What is closed is so now; of all zones those to come are told too.
            let ids = of(&|zone| match sort {
                Some(sort) => sort.fits(zone.kind) && known.is_in_force(zone),
                None => true,
            });
            let number = Some(ids.len() as f64);
            if matches!(ask, Ask::HowMany(_)) {
                return Ok(Some(answer(Said::Found, &ids, number, format!("{}.", ids.len()))));
            }
            return Ok(Some(match ids.is_empty() {
                true => answer(Said::Nothing, &ids, None, none),
                false => answer(Said::Found, &ids, None, told(&ids)),
            }));
        }
        if ask == Ask::WhereNot {
            let ids = of(&|zone| zone.kind.is_shut() && known.is_in_force(zone));
            let nowhere = told!(language, "no-zone-now");
            return Ok(Some(match ids.is_empty() {
                true => answer(Said::Nothing, &ids, None, nowhere),
                false => answer(Said::Found, &ids, None, told(&ids)),
            }));
        }
        // Of a map without zones the rest of the grammar speaks.
        if world.zones.is_empty() {
            return Ok(None);
        }
        let find = |name: &str| {
            let bare = name.strip_prefix("the ").unwrap_or(name);
            let hits = known.forms().find(bare);
            match hits[..] {
                [ref only] => Some(*only.id),
                _ => None,
            }
        };
        let Some(subject) = words.subject(&own, find) else { return Ok(None) };
        let called = named(world, subject).form(Case::Nominative, language);
        let lying = match subject {
            Entity::Zone(id) => vec![(id, true)],
            Entity::Area(area) => known.zones_on(area)?,
            Entity::Place(_) | Entity::Replica(_) if ask == Ask::WhyNoWay => Vec::new(),
            _ => return Ok(None),
        };
        let zones: Vec<ZoneId> = lying.iter().map(|(id, _)| *id).collect();
        // A room is closed by what is all of it.
        let shut: Vec<ZoneId> = lying
            .iter()
            .filter(|(_, is_whole)| *is_whole)
            .map(|(id, _)| *id)
            .filter(|id| world.zones[id].kind.is_shut() && known.is_in_force(&world.zones[id]))
            .collect();
        if let Ask::IsShut(is_shut) = ask {
            // Of a room that no zone closes its doors tell.
            if shut.is_empty() && !matches!(subject, Entity::Zone(_)) {
                return Ok(None);
            }
            let said = if shut.is_empty() == is_shut { Said::No } else { Said::Yes };
            let yes = match said {
                Said::Yes => told!(language, "yes"),
                _ => told!(language, "no"),
            };
            let words = format!("{yes} {}", told(&zones));
            return Ok(Some(answer(said, &zones, None, words)));
        }
        if let (Ask::WhyNoWay, false) = (ask, matches!(subject, Entity::Zone(_))) {
            let way = senses.way(None, Thing::Entity(subject), language, Detail::default());
            return Ok(Some(match way {
                Err(why) => answer(Said::Found, &shut, None, format!("{}.", capitalized(&why))),
                Ok(_) => {
                    let there = told!(language, "there-is-a-way", place = called);
                    let beside =
                        if zones.is_empty() { String::new() } else { format!(" {}", told(&zones)) };
                    answer(Said::No, &zones, None, there + &beside)
                }
            }));
        }
        if shut.is_empty() {
            let open = capitalized(&told!(language, "no-zone-closes-it-whole", place = called));
            let beside =
                if zones.is_empty() { String::new() } else { format!(" {}", told(&zones)) };
            return Ok(Some(answer(Said::No, &zones, None, open + &beside)));
        }
        let mut words = told(&shut);
        if ask == Ask::HowLong {
            let ends = shut.iter().map(|id| world.zones[id].until).collect::<Option<Vec<_>>>();
            let last = ends.and_then(|ends| ends.into_iter().max());
            words = match (last, shut.len()) {
                (None, _) => {
                    let open = told!(language, "no-end-is-given");
                    format!("{words} {open}")
                }
                (Some(last), 2..) => {
                    let by = told!(language, "last-zone-until");
                    format!("{words} {by} {}.", when(last))
                }
                (Some(_), _) => words,
            };
        }
        if ask == Ask::WhyShut {
            let silent =
                |id: &&ZoneId| crate::language::zones::reason(world, **id, language).is_empty();
            let names: Vec<String> = shut
                .iter()
                .filter(silent)
                .map(|id| named(world, Entity::Zone(*id)).form(Case::Nominative, language))
                .collect();
            if !names.is_empty() {
                let unknown = told!(language, "no-reason-is-given");
                words = format!("{words} {unknown}: {}.", enumerate(&names, language));
            }
        }
        Ok(Some(answer(Said::Found, &shut, None, words)))
    }
}
