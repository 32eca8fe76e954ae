//! What fits a description, how many there are, and whether there is any: lists in the words of the question.
//!
//! Invariant: the things of the answer are those that the description finds, whatever the sentence leaves out.

use super::Draft;
use crate::map::Entity;
use crate::question::focus::is_shown;
use crate::question::knowledge::{Frame, Knowledge};
use crate::question::lexicon::{Extension, KindId};
use crate::question::query::{Denial, Extreme, Head, Noun, Rel, Thing};
use crate::question::{Doubt, Said};
use crate::sets::set;
use crate::units::InOrder as _;
use crate::words::length;
use crate::words::{Language, enumerate, russian, word_keys};

impl Knowledge<'_> {
    pub(super) fn say_found(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let mut found = self.find(noun, false)?;
        self.one_of_each_lift(noun, &mut found);
        // "Name three things": as many as are asked for.
        if let (Some(count), None) = (noun.count, &noun.best) {
            found.truncate(usize::try_from(count).unwrap_or(usize::MAX));
        }
        // «Какой предмет самый тяжёлый?»: without weights nothing is the heaviest.
        let by_weight = noun
            .best
            .as_ref()
            .is_some_and(|b| matches!(b.extreme, Extreme::Heaviest | Extreme::Lightest));
        if let (true, Some(reached)) = (found.is_empty(), &noun.reached) {
            let text = match reached.able {
                true => self.pick("путей туда нет", "there is a way to none of them"),
                false => self.pick("путь есть ко всем", "there is a way to all of them"),
            };
            return Ok(Draft::new(Said::No, text.to_owned()));
        }
        if found.is_empty() && by_weight {
            let text =
                self.pick("вес этих вещей на карте не указан", "the map gives no weight of them");
            return Ok(Draft::new(Said::Unknown, text.to_owned()));
        }
        if let Some((property, other)) = &noun.like {
            let other = self.one(other)?;
            if self.values(other).iter().all(|(p, _, _)| p != property) {
                let text = self.no_property(property, other);
                return Ok(Draft::new(Said::Unknown, text).about(&[other]));
            }
        }
        if let (true, Some(word)) = (found.is_empty(), self.bears_no_other(noun)) {
            return Err(Doubt::NoReferent { word });
        }
        let facts = self.facts_of(noun, &found);
        if let Some(draft) = self.best_by_each(noun)? {
            return Ok(Draft { facts, ..draft });
        }
        if noun.best.is_some() {
            return Ok(Draft { facts, ..self.say_best(noun, found) });
        }
        if let Some(text) = self.keys_for(noun, &found) {
            return Ok(Draft { facts, ..Draft::new(Said::Found, text).with(found) });
        }
        if let Some(draft) = self.storeys_of_lift(noun) {
            return Ok(draft);
        }
        if let Some(text) = self.neighbours(noun, &found) {
            return Ok(Draft { facts, ..Draft::new(Said::Found, text).with(found) });
        }
        if let Some(draft) = self.found_by_each(noun)? {
            return Ok(Draft { facts, ..draft });
        }
        if let Some(draft) = self.rooms_between(noun, &found) {
            return Ok(Draft { facts, ..draft });
        }
        if let Some(text) = self.out_of_sight(noun, &found) {
            return Ok(Draft::new(Said::Unknown, text));
        }
        let place = self.restrictions(&self.in_their_rooms(noun, &found));
        let anchors = self.anchor_things(noun);
        let frame = self.frame_of(noun);
        let text = if found.is_empty() {
            self.nothing_found(noun, &place)
        } else {
            let list = self.with_details(noun, &found);
            let general = noun.head.anything || noun.head.kinds.is_empty();
            match (self.is_russian(), place.is_empty()) {
                // «Какие лампы включены?»
                (_, _) if self.is_only(noun, &found) && self.is_having(noun) => list,
                (true, _) if self.is_only(noun, &found) => format!("только {list}"),
                (false, _) if self.is_only(noun, &found) => format!("only {list}"),
                (true, true) => {
                    let counted = self.counted(noun, found.len());
                    if general { list } else { format!("{counted}: {list}") }
                }
                (true, false) if self.is_having(noun) => {
                    format!("{}: {list}", self.capital_count(noun, found.len()))
                }
                (true, false) if self.is_leading(noun) => {
                    let leads = if found.len() > 1 { "ведут" } else { "ведёт" };
                    let list = if self.leads_both(noun) { self.list(&found) } else { list };
                    format!("{place} {leads} {list}")
                }
                (false, false) if self.is_leading(noun) => {
                    let leads = if found.len() > 1 { "lead" } else { "leads" };
                    match self.leads_both(noun) {
                        true => format!(
                            "{} {leads} {}",
                            self.list(&found),
                            place.replace("out of", "from")
                        ),
                        false => format!("{list} {leads} {place}"),
                    }
                }
                // «Шкаф-1 и Шкаф-2 выше Холодильника-1»
                (true, false) if noun.beyond.is_some() => format!("{list} {place}{frame}"),
                // «Выше 2 м Шкаф-1 и Шкаф-2»
                (true, false) if !noun.sizes.is_empty() => format!("{place}{frame} {list}"),
                (true, false) => format!("{place}{frame} {} {list}", self.is(&found)),
                (false, true) => {
                    if general {
                        list
                    } else {
                        format!("{}: {list}", self.counted(noun, found.len()))
                    }
                }
                (false, false) if self.is_having(noun) => {
                    format!("{}: {list}", self.capital_count(noun, found.len()))
                }
                (false, false) => format!("{list} {} {place}{frame}", self.is(&found)),
            }
        };
        let said = if found.is_empty() { Said::Nothing } else { Said::Found };
        let text = format!("{text}{}", self.also(noun, &found));
        let beside = match found.is_empty() {
            true => self.nearest_beside(noun).map(|(_, thing)| thing),
            false => None,
        };
        let topic: Vec<Thing> = anchors.into_iter().chain(beside).collect();
        Ok(Draft { facts, ..Draft::new(said, text).with(found) }.about(&topic))
    }

    /// The pronoun of «Что ещё на нём?» where it came to a thing that bears nothing at all, so that another one is meant.
    fn bears_no_other(&self, noun: &Noun) -> Option<String> {
        let [place] = &noun.restrictions[..] else { return None };
        let [anchor] = &place.anchors[..] else { return None };
        let things = anchor.head.things.as_deref().filter(|_| noun.other && noun.head.anything)?;
        let bears = |t: &Thing| !self.related(place.rel, *t).is_empty();
        // «Что ещё на этой тумбе?» says of what.
        let on_or_in = matches!(place.rel, Rel::On | Rel::In) && !is_shown(anchor);
        (on_or_in && !things.iter().any(bears)).then(|| anchor.text.clone())
    }

    /// Whether what was found is one of several that differ by a value, or by what they have.
    fn is_only(&self, noun: &Noun, found: &[Thing]) -> bool {
        let told = !noun.filters.is_empty() || self.is_having(noun);
        let placed = noun.restrictions.iter().any(|r| !matches!(r.rel, Rel::Has | Rel::Bears));
        let rooms = noun.restrictions.iter().any(|r| r.rel == Rel::Near);
        let kind = !noun.head.kinds.is_empty() && noun.head.named.is_empty();
        found.len() == 1 && told && kind && !placed && !rooms
    }

    /// Left and right of what has no front are told from where the robot is: of what is in another room, they are not.
    fn out_of_sight(&self, noun: &Noun, found: &[Thing]) -> Option<String> {
        let side = noun
            .restrictions
            .iter()
            .find(|r| matches!(r.rel, Rel::LeftOf | Rel::RightOf | Rel::Behind | Rel::InFrontOf))?;
        let anchors = self.find(side.anchors.first()?, true).ok()?;
        let [anchor] = anchors[..] else { return None };
        let away = self.frame(anchor) == Frame::Viewer
            && anchor != Thing::Robot
            && self.area_of(anchor) != self.area_of(Thing::Robot);
        (found.is_empty() && away).then(|| match self.is_russian() {
            true => format!(
                "у {} нет лицевой стороны, а с моего места туда не видно",
                self.form(anchor, crate::Case::Genitive)
            ),
            false => format!(
                "{} has no front side, and I cannot see there from where I am",
                self.name(anchor)
            ),
        })
    }

    /// «Ключ-1 подходит к Лаборатории», "Key 1 opens the laboratory"
    fn keys_for(&self, noun: &Noun, found: &[Thing]) -> Option<String> {
        let opens = noun.restrictions.iter().find(|r| r.rel == Rel::Opens && !r.negated)?;
        let what = self.find(opens.anchors.first()?, true).ok()?;
        let (&key, &door) = (found.first()?, what.first()?);
        let several = found.len() > 1;
        let list = self.list(found);
        Some(match self.is_russian() {
            true => {
                let verb = if several { "открывают" } else { "открывает" };
                format!("{list} {verb} {}", self.form(door, crate::Case::Accusative))
            }
            false if several => format!("{list} open {}", self.name(door)),
            false => format!("{} opens {}", self.name(key), self.name(door)),
        })
    }

    /// «Из Коридора можно попасть в Комнату-В и в Комнату-Y.»
    fn neighbours(&self, noun: &Noun, found: &[Thing]) -> Option<String> {
        if let Some(text) = self.led_from(noun, found) {
            return Some(text);
        }
        let near = noun.restrictions.iter().find(|r| r.rel == Rel::Near)?;
        let from = self.find(near.anchors.first()?, true).ok()?;
        if near.negated && from.iter().all(|t| t.area().is_some()) {
            return Some(match (found.is_empty(), self.is_russian()) {
                (false, true) => format!(
                    "прямо {} нельзя попасть {}",
                    self.place(Rel::From, &from),
                    enumerate(
                        &found.iter().map(|t| self.place(Rel::To, &[*t])).collect::<Vec<_>>(),
                        self.language
                    )
                ),
                (false, false) => {
                    format!("not connected to {}: {}", self.list(&from), self.list(found))
                }
                (true, true) => {
                    format!("прямо {} можно попасть во все помещения", self.place(Rel::From, &from))
                }
                (true, false) => format!("all rooms are connected to {}", self.list(&from)),
            });
        }
        let rooms = !found.is_empty() && found.iter().chain(&from).all(|t| t.area().is_some());
        let list: Vec<String> = found.iter().map(|t| self.place(Rel::To, &[*t])).collect();
        let list = enumerate(&list, self.language);
        rooms.then(|| match self.is_russian() {
            true => format!("{} можно попасть {list}", self.place(Rel::From, &from)),
            false => format!("from {} one can get {list}", self.list(&from)),
        })
    }

    pub(super) fn is_having(&self, noun: &Noun) -> bool {
        noun.restrictions.iter().any(|r| {
            matches!(r.rel, Rel::Has | Rel::Bears)
                || (r.rel == Rel::Near
                    && noun.head.kinds.iter().any(|k| self.lexicon().is_area(*k)))
        })
    }

    /// «2 помещения, где есть стулья»
    fn capital_count(&self, noun: &Noun, number: usize) -> String {
        let counted = self.counted(noun, number);
        let place = self.restrictions(noun);
        format!("{counted} {place}")
    }

    /// Names; of doors with where they lead, of left and right with how far they are.
    fn with_details(&self, noun: &Noun, found: &[Thing]) -> String {
        let measured = noun.restrictions.iter().find(|r| {
            matches!(
                r.rel,
                Rel::LeftOf
                    | Rel::RightOf
                    | Rel::Behind
                    | Rel::InFrontOf
                    | Rel::NextTo
                    | Rel::Near
                    | Rel::Within(_)
            )
        });
        let anchor =
            measured.and_then(|r| self.find(r.anchors.first()?, true).ok()?.first().copied());
        let from = noun.restrictions.iter().find(|r| matches!(r.rel, Rel::From | Rel::Of));
        let from = from.and_then(|r| self.find(r.anchors.first()?, true).ok()?.first().copied());
        let mut found = found.to_vec();
        if let Some(anchor) = anchor {
            found.order_by(|a, b| {
                let away = |t: &Thing| self.distance(*t, anchor).unwrap_or(f64::INFINITY);
                away(a).total_cmp(&away(b)).then(a.cmp(b))
            });
        }
        let detail = |thing: &Thing| -> String {
            let name = self.name(*thing);
            if let (Some(_), Some(here @ Thing::Entity(Entity::Area(_)))) =
                (self.opening(*thing), from)
            {
                return self.with_destinations(&[*thing], here).concat();
            }
            let apart = self.relations.thresholds().touch_gap;
            let away = anchor.and_then(|a| self.distance(*thing, a)).filter(|d| *d >= apart);
            match away {
                Some(d) if thing.replica().is_some() => {
                    format!("{name} ({})", length(d, self.language))
                }
                _ => name,
            }
        };
        let borne: Vec<Thing> = noun
            .restrictions
            .iter()
            .filter(|r| r.rel == Rel::On && !r.negated)
            .flat_map(|r| r.anchors.iter().filter_map(|a| self.find(a, true).ok()))
            .flatten()
            .filter(|t| t.replica().is_some())
            .collect();
        if !borne.is_empty() && found.len() <= 12 {
            let parts: Vec<String> = found.iter().map(|t| self.with_bearer(*t, &borne)).collect();
            return enumerate(&parts, self.language);
        }
        if let Some(list) = self.ways_out_told(noun, &found) {
            return list;
        }
        if (anchor.is_none() && from.is_none()) || found.len() > 12 {
            return self.list(&found);
        }
        let parts: Vec<String> = found.iter().map(detail).collect();
        enumerate(&parts, self.language)
    }

    /// «Чашка-1 (на Подносе-1)»: what lies on the table by something that lies on it.
    fn with_bearer(&self, thing: Thing, asked: &[Thing]) -> String {
        let own = self.borne_by(thing).first().copied().filter(|own| !asked.contains(own));
        let by = own.filter(|own| asked.iter().any(|a| self.related(Rel::On, *a).contains(own)));
        match by {
            Some(own) => {
                format!("{} ({})", self.name(thing), self.place(self.on_or_in(thing, own), &[own]))
            }
            None => self.name(thing),
        }
    }

    /// The things that places of a description name.
    pub(super) fn anchor_things(&self, noun: &Noun) -> Vec<Thing> {
        let anchors = noun.restrictions.iter().flat_map(|r| &r.anchors);
        anchors.filter_map(|a| self.find(a, true).ok()).filter(|f| f.len() == 1).flatten().collect()
    }

    pub(super) fn frame_of(&self, noun: &Noun) -> String {
        let side = noun.restrictions.iter().find_map(|r| {
            let anchor = self.find(r.anchors.first()?, true).ok()?;
            let words = self.frame_words(r.rel, *anchor.first()?);
            (!words.is_empty()).then_some(words)
        });
        side.unwrap_or_default()
    }

    /// A lift has an Area on every floor where it stops; people count it once. Rooms in general are counted as such.
    pub(super) fn one_of_each_lift(&self, noun: &Noun, found: &mut Vec<Thing>) {
        let rooms = |k: &KindId| self.lexicon().kind(*k).extension == Extension::Rooms;
        if noun.head.anything || noun.head.kinds.iter().any(rooms) {
            return;
        }
        for (_, stops) in &self.world.domain.lifts {
            let is_stop = |t: &Thing| t.area().is_some_and(|a| stops.iter().any(|s| s.area == a));
            let mut met = false;
            found.retain(|t| !is_stop(t) || !std::mem::replace(&mut met, true));
        }
    }

    pub(super) fn count(&self, noun: &Noun) -> Result<Draft, Doubt> {
        if let Some(parts) = self.count_parts(noun)? {
            return Ok(parts);
        }
        if let Some((each, rooms)) = self.in_each(noun)? {
            return Ok(self.count_in_each(&each, &rooms));
        }
        let mut found = self.find(noun, false)?;
        self.one_of_each_lift(noun, &mut found);
        let facts = self.facts_of(noun, &found);
        let place = self.restrictions(noun);
        let anchors = self.anchor_things(noun);
        let number = found.len();
        let sorts = self.rooms_and_things(noun, &found);
        let text = if number == 0 {
            self.nothing_found(noun, &place) + &self.passages_instead(noun)
        } else if let Some(sorts) = sorts.filter(|_| !noun.head.anything) {
            match (self.is_russian(), place.is_empty()) {
                (true, true) => format!("на карте {sorts}"),
                (true, false) => format!("{place} {sorts}"),
                (false, true) => format!("there are {sorts}"),
                (false, false) => format!("there are {sorts} {place}"),
            }
        } else {
            let counted = match noun.head.anything {
                true => {
                    let (phrase, english) = self.kind_phrase(noun);
                    match self.language {
                        Language::Russian => russian::count(number as u64, &phrase),
                        Language::English => crate::words::english::count(number as u64, &english),
                    }
                }
                false => self.counted(noun, number),
            };
            let list = match number <= 12 {
                true => {
                    let list = self.ways_out_told(noun, &found);
                    format!(": {}", list.unwrap_or_else(|| self.list(&found)))
                }
                false => String::new(),
            };
            let are = |number| if number == 1 { "is" } else { "are" };
            let told = noun.head.things.is_some();
            let of_told = told && (!noun.filters.is_empty() || self.list_with(&found).is_some());
            match (self.is_russian(), place.is_empty()) {
                (false, true) if told && noun.sums() => {
                    format!("there {} {counted} in all{list}", are(number))
                }
                (true, true) if of_told && !noun.sums() => format!("из них {counted}{list}"),
                (false, true) if of_told => format!("among them {} {counted}{list}", are(number)),
                (true, true) if told => format!("всего {counted}{list}"),
                (true, true) => format!("на карте {counted}{list}"),
                (true, false) if self.is_having(noun) => format!("{counted} {place}{list}"),
                (true, false) => format!("{place} {counted}{list}"),
                (false, true) => format!("there {} {counted}{list}", are(number)),
                (false, false) => format!("there {} {counted} {place}{list}", are(number)),
            }
        };
        let said = if number == 0 { Said::Nothing } else { Said::Found };
        let text = format!("{text}{}", self.within_as_well(noun, &found));
        Ok(Draft { facts, ..Draft::new(said, text).with(found) }
            .about(&anchors)
            .number(number as f64))
    }

    /// «2 помещения (Туалет-1 и Туалет-2) и 3 вещи», where one word is of rooms and of things: they are not counted together.
    fn rooms_and_things(&self, noun: &Noun, found: &[Thing]) -> Option<String> {
        let (rooms, things): (Vec<Thing>, Vec<Thing>) =
            found.iter().partition(|thing| thing.area().is_some());
        let several = noun.head.things.is_none() && !rooms.is_empty() && !things.is_empty();
        let sorts = [(rooms, Extension::Rooms), (things, Extension::Things)];
        let told = sorts.into_iter().filter(|_| several).map(|(found, sort)| {
            let kind = self.lexicon().kind(self.lexicon().kind_of(&sort)?);
            let number = found.len() as u64;
            let counted = match self.language {
                Language::Russian => russian::count(number, &kind.phrase),
                Language::English => crate::words::english::count(number, &kind.english),
            };
            let list = (found.len() <= 12).then(|| format!(" ({})", self.list(&found)));
            Some(counted + &list.unwrap_or_default())
        });
        let told: Vec<String> = told.collect::<Option<_>>()?;
        several.then(|| enumerate(&told, self.language))
    }

    pub(super) fn exists(
        &self,
        what: &[Noun],
        either: bool,
        denial: Denial,
    ) -> Result<Draft, Doubt> {
        if let [noun] = what {
            if let Some(parts) = self.has_parts(noun)? {
                return Ok(parts);
            }
            if let Some((each, rooms)) = self.in_each(noun)? {
                return Ok(self.exists_in_each(&each, Rel::In, &rooms));
            }
            if let Some((each, rel, tables)) = self.at_each(noun)? {
                return Ok(self.exists_in_each(&each, rel, &tables));
            }
            if let Some(asked) = noun.count {
                return self.exist_so_many(noun, asked);
            }
        }
        let mut found: Vec<Vec<Thing>> = Vec::new();
        for noun in what {
            let mut things = self.find(noun, true)?;
            self.one_of_each_lift(noun, &mut things);
            found.push(things);
        }
        // "Is there another toilet?" has one in mind that was not spoken of.
        if let ([noun], [things], Denial::None) = (what, &found[..], denial)
            && noun.other
            && !noun.head.anything
            && word_keys(&noun.text).iter().any(|key| set!("Another").contains(&key.as_str()))
            && let [only] = things[..]
            && self.find(&Noun { other: false, ..noun.clone() }, true)? == [only]
        {
            let (name, place) = (self.name(only), self.restrictions(noun));
            let text = match self.is_russian() {
                true if place.is_empty() => format!("нет, есть только {name}"),
                true => format!("нет, {place} есть только {name}"),
                false => format!("no, there is only {name} {place}"),
            };
            return Ok(Draft::new(Said::No, text.trim_end().to_owned()).with(vec![only]));
        }
        let have = |n: usize| !found[n].is_empty();
        let any = (0..what.len()).any(have);
        let all = (0..what.len()).all(have);
        // «Нет ни кровати, ни дивана?» denies each of them.
        let holds = if either || denial.is_taken() { any } else { all };
        // What bears out the answer is told first: "Yes, there is a mug, but there are no cups".
        let mut order: Vec<usize> = (0..what.len()).collect();
        order.order_by_key(|n| have(*n) != holds);
        let mut parts: Vec<(bool, String)> = Vec::new();
        for n in order {
            parts.push((have(n), self.existing(&what[n], &found[n])));
        }
        if let [noun] = what
            && !any
            && let Some(within) = self.existing_instead(noun)
        {
            parts.push((true, within));
        }
        let (mut text, mut before) = (String::new(), None);
        for (is_there, part) in parts {
            match before {
                None => {}
                Some(same) if same == is_there => text.push_str(self.pick(", и ", " and ")),
                Some(_) => text.push_str(self.pick(", но ", ", but ")),
            }
            text.push_str(&part);
            before = Some(is_there);
        }
        // «В комнате нет стула?» is answered by «Да, нет» only in words that cannot mislead.
        let yes = holds != denial.is_taken();
        let head = match (denial, yes) {
            (Denial::Unasked, _) => "",
            (_, true) => self.pick("да, ", "yes, "),
            (_, false) => self.pick("нет, ", "no, "),
        };
        let facts = what.iter().zip(&found).flat_map(|(n, f)| self.facts_of(n, f)).collect();
        let things: Vec<Thing> = found.concat();
        let anchors = self.anchor_things(&what[0]);
        let said = match (denial, yes) {
            (Denial::Unasked, true) => Said::Found,
            (Denial::Unasked, false) => Said::Nothing,
            (_, true) => Said::Yes,
            (_, false) => Said::No,
        };
        Ok(Draft { facts, ..Draft::new(said, format!("{head}{text}")).with(things) }
            .about(&anchors))
    }

    /// A description without those rooms, of several, in which nothing was found.
    fn in_their_rooms(&self, noun: &Noun, found: &[Thing]) -> Noun {
        let mut told = noun.clone();
        for place in told.restrictions.iter_mut().filter(|place| !place.negated) {
            let holds = |anchor: &Noun| {
                self.find(anchor, true).is_ok_and(|rooms| {
                    let mut within = rooms.iter().flat_map(|room| self.related(place.rel, *room));
                    within.any(|t| found.contains(&t))
                })
            };
            let kept: Vec<Noun> = place.anchors.iter().filter(|a| holds(a)).cloned().collect();
            if matches!(place.rel, Rel::In | Rel::On) && !kept.is_empty() {
                place.anchors = kept;
            }
        }
        told
    }

    /// A description with the place where the things are, for one of several that would do: "on the tables" is on one.
    fn borne(&self, noun: &Noun, things: &[Thing]) -> Noun {
        let mut told = noun.clone();
        for restriction in told.restrictions.iter_mut().filter(|r| !r.negated) {
            // "in the bathroom or in the kitchen": where they are.
            if restriction.anchors.len() > 1 && restriction.rel != Rel::Between {
                let holds = |anchor: &Noun| {
                    self.find(anchor, true).is_ok_and(|found| {
                        let mut all = found.iter().flat_map(|a| self.related(restriction.rel, *a));
                        all.any(|t| things.contains(&t))
                    })
                };
                let kept: Vec<Noun> =
                    restriction.anchors.iter().filter(|a| holds(a)).cloned().collect();
                if !kept.is_empty() {
                    restriction.anchors = kept;
                }
                continue;
            }
            let [anchor] = &mut restriction.anchors[..] else { continue };
            if self.is_walls(anchor) || self.is_floor(anchor) {
                continue;
            }
            let Ok(found) = self.find(anchor, true) else { continue };
            let bearing = |rel: Rel| -> Vec<Thing> {
                let bears = |a: &Thing| {
                    let related = self.related(rel, *a);
                    things.iter().any(|t| related.contains(t))
                };
                found.iter().copied().filter(bears).collect()
            };
            let mut bearing = match bearing(restriction.rel) {
                none if none.is_empty() && restriction.rel == Rel::NextTo => bearing(Rel::Near),
                some => some,
            };
            bearing.truncate(2);
            let bears_all = |a: &Thing| {
                let related = self.related(restriction.rel, *a);
                things.iter().all(|t| related.contains(t))
            };
            if let (true, [only]) = (found.len() > 1, &bearing[..])
                && (restriction.rel != Rel::On || bears_all(only))
            {
                let head = Head { things: Some(vec![*only]), ..Head::default() };
                *anchor = Noun { head, ..Noun::default() };
            }
        }
        told
    }

    /// «в Комнате-В есть 2 стула: Стул-1 и Стул-2», «в Комнате-В нет стульев»
    pub(super) fn existing(&self, noun: &Noun, things: &[Thing]) -> String {
        let place = self.restrictions(&self.borne(noun, things));
        let blank = if place.is_empty() { String::new() } else { format!("{place} ") };
        if things.is_empty() {
            // «Есть ли ещё книги?»: those that were spoken of are there.
            let but = noun.other || !noun.except.is_empty();
            let other = if but { self.pick("других ", "other ") } else { "" };
            let none = format!("{other}{}", self.none_of(noun));
            return match (self.is_russian(), noun.head.anything && noun.filters.is_empty()) {
                (true, true) if but => format!("{blank}больше ничего нет"),
                (false, true) if but => format!("there is nothing else {place}"),
                (true, true) => format!("{blank}ничего нет"),
                (false, true) => format!("there is nothing {place}"),
                (true, false) if noun.head.things.is_some() => format!("{blank}таких нет"),
                (false, false) if noun.head.things.is_some() => {
                    format!("none of them {place}").trim_end().to_owned()
                }
                (true, false) if place.is_empty() => format!("на карте нет {none}"),
                (true, false) => format!("{blank}нет {none}"),
                (false, false) if place.is_empty() => self.there_is_no(noun, "on the map"),
                (false, false) => self.there_is_no(noun, &place),
            };
        }
        let list = self.ways_out_told(noun, things).unwrap_or_else(|| self.list(things));
        let general = noun.head.anything || noun.head.kinds.is_empty();
        // "Is there a room without windows?"
        if self.is_having(noun) && things.iter().all(|t| t.area().is_some()) {
            return list;
        }
        // «есть 6 стульев без вещей»
        let compares = self.is_having(noun) || (noun.beyond.is_some() && things.len() > 1);
        if self.is_russian() && compares && !general {
            return format!("есть {} {place}: {list}", self.counted(noun, things.len()));
        }
        let unplaced = place.is_empty() && things.len() == 1;
        let only = things.first().filter(|t| unplaced && t.area().is_none());
        let room = only.and_then(|t| match t.replica() {
            Some(_) => Some(format!(" {}", self.short_place(*t, &mut Vec::new()))),
            None => self.in_room(*t).map(|room| format!(" {room}")),
        });
        let room = room.unwrap_or_default();
        match (self.is_russian(), general || things.len() == 1) {
            // «выше шкафа есть полка» would say where it hangs.
            (true, true) if noun.beyond.is_some() => format!("есть {list} {place}"),
            (true, true) => format!("{blank}есть {list}{room}"),
            (true, false) => format!("{blank}есть {}: {list}", self.counted(noun, things.len())),
            (false, true) => {
                let verb = self.is(things);
                format!("there {verb} {list}{room} {place}")
            }
            (false, false) => {
                format!("there are {} {place}: {list}", self.counted(noun, things.len()))
            }
        }
        .trim_end()
        .replace(" :", ":")
    }
}
