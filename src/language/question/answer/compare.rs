//! Superlatives and comparisons: by size, by distance, by a property.
//!
//! Invariant: what cannot be measured is not compared; equal ones are said to be equal.

use super::Draft;
use crate::question::knowledge::{HowFar, Knowledge};
use crate::question::lexicon::lower_first;
use crate::question::query::{Closeness, Dimension, Extreme, Head, Noun, Sized, Thing};
use crate::question::values::Property;
use crate::question::{Doubt, Said};
use crate::units::InOrder as _;
use crate::words::russian;
use crate::words::{Case, Counted, area, length};

/// What is compared of several things, one measure each.
struct Compared {
    extreme: Extreme,
    by_way: bool,
    each: Vec<f64>,
}

impl Knowledge<'_> {
    pub(super) fn say_best(&self, noun: &Noun, found: Vec<Thing>) -> Draft {
        let Some(best) = &noun.best else { return Draft::default() };
        let unranked = Noun { rank: None, ..noun.clone() };
        if found.is_empty()
            && noun.rank.is_some()
            && self.find(&unranked, false).is_ok_and(|all| !all.is_empty())
        {
            let text =
                self.pick("такого нет: все остальные равны", "there is none: the others are equal");
            return Draft::new(Said::Nothing, text.to_owned());
        }
        let unordered = Noun { best: None, rank: None, ..noun.clone() };
        if found.is_empty() && self.find(&unordered, false).is_ok_and(|all| !all.is_empty()) {
            return Draft::new(Said::Unknown, self.without_order().to_owned());
        }
        let Some(&first) = found.first() else {
            let text = self.nothing_found(noun, &self.restrictions(noun));
            return Draft::new(Said::Nothing, text);
        };
        let anchor = best.anchor.as_ref().and_then(|a| self.find(a, true).ok());
        let anchor = anchor.and_then(|a| a.first().copied()).unwrap_or(Thing::Robot);
        let list = self.list(&found);
        let how = match best.extreme {
            Extreme::Nearest | Extreme::Farthest => {
                let far = self.how_far(anchor, &[first]);
                let away = far.map(|far| self.far_words(first, far.each[0], far.by_way));
                let away = away.unwrap_or_default();
                let form = self.form(anchor, Case::Genitive);
                match self.is_russian() {
                    true => format!(
                        "{away} {} {form}",
                        russian::preposition(russian::Preposition::Ot, &form)
                    ),
                    false => format!("{away} from {form}"),
                }
            }
            Extreme::Most | Extreme::Fewest => match &best.anchor {
                Some(counted) => {
                    let all = self.counted_at(counted, &found).unwrap_or_default();
                    let number = self.having(&all, first);
                    // «по 1 телевизору»
                    let each = self.is_russian()
                        && found.len() > 1
                        && Counted::of(number as u64) == Counted::One;
                    match each {
                        true => {
                            let phrase = self.kind_phrase(counted).0;
                            format!("{number} {}", lower_first(&phrase.case(Case::Dative)))
                        }
                        false => self.counted(counted, number),
                    }
                }
                None => String::new(),
            },
            extreme => {
                let all = self.find(&unordered, true).unwrap_or_default();
                self.measure_words(self.by_place_or_size(extreme, &all), first)
            }
        };
        let counts = matches!(best.extreme, Extreme::Most | Extreme::Fewest);
        let place = self.in_room(first).filter(|_| first.area().is_none());
        let place = place.map(|p| format!(" {p}")).unwrap_or_default();
        let text = match (found.len(), self.is_russian()) {
            (1, true) => {
                let how = if how.is_empty() { String::new() } else { format!(" ({how})") };
                format!("это {list}{place}{how}")
            }
            (1, false) => {
                let how = if how.is_empty() { String::new() } else { format!(" ({how})") };
                format!("it is {list}{place}{how}")
            }
            (_, true) if counts => format!("это {list} (по {how})"),
            (_, false) if counts => format!("these are {list} ({how} each)"),
            (_, true) => format!("это {list}"),
            (_, false) => format!("these are {list}"),
        };
        Draft::new(Said::Found, text).with(found)
    }

    /// How far it is to a thing, and how that was measured where it is a room, a place or an opening.
    fn far_words(&self, to: Thing, far: f64, by_way: bool) -> String {
        let told = length(far, self.language);
        match (by_way, to.replica().is_some(), self.is_russian()) {
            (true, _, true) => format!("{told} пути"),
            (true, _, false) => format!("{told} of way"),
            (false, true, _) => told,
            (false, false, true) => format!("{told} по прямой"),
            (false, false, false) => format!("{told} in a straight line"),
        }
    }

    /// «выше 2 м», "wider than 80 cm"
    pub(in crate::question) fn size_words(&self, size: Sized) -> String {
        let than = match size.extreme {
            Extreme::Biggest | Extreme::Smallest => area(size.than as f64, self.language),
            _ => length(size.than as f64, self.language),
        };
        let not = if size.negated { self.pick("не ", "not ") } else { "" };
        let word = self.comparative(size.extreme);
        match self.is_russian() {
            true => format!("{not}{word} {than}"),
            false => format!("{not}{word} than {than}"),
        }
    }

    /// «больше Кухни», "taller than Wardrobe 1"
    pub(in crate::question) fn beyond(&self, extreme: Extreme, other: &Noun) -> Option<String> {
        let other = self.one(other).ok()?;
        let word = self.comparative(extreme);
        Some(match self.is_russian() {
            true => format!("{word} {}", self.form(other, Case::Genitive)),
            false => format!("{word} than {}", self.name(other)),
        })
    }

    /// That the map gives no measure of what others are said to be beyond, or of none of them: "heavier than the laptop".
    ///
    /// # Errors
    /// What is meant by the descriptions.
    pub(super) fn unmeasured(&self, noun: &Noun) -> Result<Option<Draft>, Doubt> {
        let Some((extreme, other)) = &noun.beyond else { return Ok(None) };
        let other = self.one(other)?;
        if self.measure(*extreme, other).is_none() {
            return Ok(Some(self.incomparable(&[other], *extreme)));
        }
        let others = self.find(&Noun { beyond: None, ..noun.clone() }, false)?;
        let mut others = others.into_iter().filter(|t| *t != other).peekable();
        let none = others.peek().is_some() && others.all(|t| self.measure(*extreme, t).is_none());
        Ok(none.then(|| Draft::new(Said::Unknown, self.without_order().to_owned())))
    }

    /// Of things that have no common measure.
    pub(in crate::question) fn without_order(&self) -> &'static str {
        self.pick("сравнить их карта не даёт", "the map does not let them be compared")
    }

    pub(super) fn measure_words(&self, extreme: Extreme, thing: Thing) -> String {
        let Some(measure) = self.measure(extreme, thing) else { return String::new() };
        let is_area = thing.area().is_some();
        match extreme {
            Extreme::Biggest | Extreme::Smallest if is_area => area(measure, self.language),
            Extreme::Biggest | Extreme::Smallest if thing.replica().is_some() => {
                self.sizes(thing).unwrap_or_default()
            }
            Extreme::Tallest | Extreme::Lowest => match self.is_russian() {
                true => format!("высота {}", length(measure, self.language)),
                false => format!("{} high", length(measure, self.language)),
            },
            Extreme::Thickest | Extreme::Thinnest => match self.is_russian() {
                true => format!("толщина {}", length(measure, self.language)),
                false => format!("{} thick", length(measure, self.language)),
            },
            Extreme::Topmost | Extreme::Bottommost | Extreme::Midmost => match self.is_russian() {
                true => format!("на высоте {}", length(measure, self.language)),
                false => format!("{} above the floor", length(measure, self.language)),
            },
            Extreme::Longest | Extreme::Shortest => match self.is_russian() {
                true => format!("длина {}", length(measure, self.language)),
                false => format!("{} long", length(measure, self.language)),
            },
            Extreme::Heaviest | Extreme::Lightest => {
                let own = self.values(thing).into_iter().find(|(p, _, _)| *p == Property::Weight);
                own.map(|(_, _, text)| text).unwrap_or_default()
            }
            Extreme::LeftMost | Extreme::RightMost | Extreme::Most | Extreme::Fewest => {
                String::new()
            }
            _ => match self.is_russian() {
                true => format!("ширина {}", length(measure, self.language)),
                false => format!("{} wide", length(measure, self.language)),
            },
        }
    }

    pub(super) fn closer(
        &self,
        what: &Noun,
        near: &Noun,
        than: &Noun,
        closeness: Closeness,
    ) -> Result<Draft, Doubt> {
        let (what, near, than) = (self.one(what)?, self.one(near)?, self.one(than)?);
        let Some(HowFar { by_way, each }) = self.how_far(what, &[near, than]) else {
            return Ok(self.apart(&[what, near, than]));
        };
        let (a, b) = (each[0], each[1]);
        let nearer = a < b;
        let yes = nearer == (closeness == Closeness::Nearer) && (a - b).abs() > 1e-9;
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let text = match self.is_russian() {
            true => {
                let to = |t: Thing| self.form(t, Case::Genitive);
                format!(
                    "{head}{} {} {} {}, а {} {} {}",
                    russian::preposition(russian::Preposition::Ot, &to(what)),
                    to(what),
                    format_args!("до {}", to(near)),
                    self.far_words(near, a, by_way),
                    "до",
                    to(than),
                    self.far_words(than, b, by_way)
                )
            }
            false => format!(
                "{head}it is {} from {} to {} and {} to {}",
                self.far_words(near, a, by_way),
                self.name(what),
                self.name(near),
                self.far_words(than, b, by_way),
                self.name(than)
            ),
        };
        let said = if yes { Said::Yes } else { Said::No };
        Ok(Draft::new(said, text).with(vec![what]).about(&[near, than]))
    }

    fn apart(&self, things: &[Thing]) -> Draft {
        let list = self.list(things);
        let text = match self.is_russian() {
            true => format!("сравнить нельзя: {list} – на разных картах или не имеют размеров"),
            false => {
                format!("they cannot be compared: {list} are on different maps or have no size")
            }
        };
        Draft::new(Said::Unknown, text)
    }

    /// Why things have no order: the map tells no weight of one, or they have no common measure.
    fn incomparable(&self, things: &[Thing], extreme: Extreme) -> Draft {
        let missing = things.iter().find(|t| self.measure(extreme, **t).is_none());
        match (missing, extreme) {
            (Some(missing), Extreme::Heaviest | Extreme::Lightest) => {
                let text = self.no_property(&Property::Weight, *missing);
                Draft::new(Said::Unknown, text).with(things.to_vec())
            }
            _ => self.apart(things),
        }
    }

    /// What is compared of each of some things; none where one of them has no such measure.
    fn compared(&self, things: &[Thing], extreme: Extreme, to: Option<Thing>) -> Option<Compared> {
        let each = match extreme {
            Extreme::Nearest | Extreme::Farthest => {
                let far = self.how_far(to.unwrap_or(Thing::Robot), things)?;
                return Some(Compared { extreme, by_way: far.by_way, each: far.each });
            }
            other => {
                things.iter().map(|t| self.measure(other, *t)).collect::<Option<Vec<f64>>>()?
            }
        };
        Some(Compared { extreme, by_way: false, each })
    }

    fn compared_words(&self, compared: &Compared, thing: Thing, value: f64) -> String {
        match compared.extreme {
            Extreme::Nearest | Extreme::Farthest => self.far_words(thing, value, compared.by_way),
            other => self.measure_words(other, thing),
        }
    }

    /// Of a kind that several things are of, the one that counts: «Что ближе к окну, стул или стол?» is about the
    /// nearest chair. Of sizes only a certain thing can be meant.
    fn champion(&self, noun: &Noun, extreme: Extreme, to: Option<Thing>) -> Result<Thing, Doubt> {
        let by_distance = matches!(extreme, Extreme::Nearest | Extreme::Farthest);
        let general = noun.head.named.is_empty() && noun.head.things.is_none();
        if !(by_distance && general) {
            return self.one(noun);
        }
        let found = self.find(noun, true)?;
        let sign = if extreme.is_less() { 1.0 } else { -1.0 };
        let measured = found
            .into_iter()
            .filter_map(|t| Some((sign * self.compared(&[t], extreme, to)?.each[0], t)))
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        measured.map(|(_, thing)| thing).ok_or_else(|| self.none_such(noun))
    }

    pub(super) fn which_more(
        &self,
        of: &[Noun],
        extreme: Extreme,
        to: Option<&Noun>,
    ) -> Result<Draft, Doubt> {
        let to = to.map(|noun| self.one(noun)).transpose()?;
        let things =
            of.iter().map(|n| self.champion(n, extreme, to)).collect::<Result<Vec<_>, _>>()?;
        if let (Extreme::LeftMost | Extreme::RightMost, [a, b]) = (extreme, &things[..]) {
            return Ok(self.further_aside([*a, *b], extreme, true));
        }
        let extreme = self.by_place_or_size(extreme, &things);
        let Some(compared) = self.compared(&things, extreme, to) else {
            return Ok(self.incomparable(&things, extreme));
        };
        let each = compared.each.iter().copied();
        let mut measured: Vec<(f64, Thing)> = each.zip(things.iter().copied()).collect();
        let sign = if extreme.is_less() { 1.0 } else { -1.0 };
        measured.order_by(|a, b| (sign * a.0).total_cmp(&(sign * b.0)));
        let [(best, winner), rest @ ..] = &measured[..] else { return Ok(self.apart(&things)) };
        // What is told to be as much is not more.
        let told = |measure: f64, thing: Thing| self.compared_words(&compared, thing, measure);
        let same = |m: f64, thing: Thing| {
            (m - best).abs() < 1e-6 || told(m, thing) == told(*best, *winner)
        };
        let equal = rest.iter().filter(|(m, thing)| same(*m, *thing)).count();
        if equal == rest.len() {
            let text = self.pick("они одинаковы", "they are equal").to_owned();
            return Ok(Draft::new(Said::Nothing, text).with(things));
        }
        let words =
            |(measure, thing): &(f64, Thing)| self.compared_words(&compared, *thing, *measure);
        let comparative = self.comparative(extreme);
        let (won, lost) = rest.split_at(equal);
        let winners: Vec<Thing> =
            std::iter::once(*winner).chain(won.iter().map(|(_, t)| *t)).collect();
        let others = lost.iter().map(|other| match self.is_russian() {
            true => format!("; {} – {}", self.name(other.1), words(other)),
            false => format!("; {}: {}", self.name(other.1), words(other)),
        });
        let (names, others) = (self.list(&winners), others.collect::<String>());
        let best = words(&(*best, *winner));
        let text = match self.is_russian() {
            true if lost.len() > 1 => format!("{comparative} всех {names} ({best}{others})"),
            true => format!("{comparative} {names} ({best}{others})"),
            false => {
                let than = if lost.len() > 1 { " than the others" } else { "" };
                format!("{names} {} {comparative}{than} ({best}{others})", self.is(&winners))
            }
        };
        let others: Vec<Thing> = lost.iter().map(|(_, t)| *t).collect();
        Ok(Draft::new(Said::Found, text).with(winners).about(&others))
    }

    /// «Что левее, диван или стол?»: as the robot sees them from where it is. `asks` which; else whether the first is.
    fn further_aside(&self, [a, b]: [Thing; 2], extreme: Extreme, asks: bool) -> Draft {
        let seen = self.outermost(&[a, b], extreme);
        let [(x, _), (y, _)] = seen[..] else { return self.apart(&[a, b]) };
        let from = self.pick("если смотреть с моего места", "as seen from where I am");
        let first = x < y;
        let (winner, other) = if first { (a, b) } else { (b, a) };
        let side = match extreme {
            Extreme::LeftMost => self.pick("левее", "further left"),
            _ => self.pick("правее", "further right"),
        };
        let (name, other_name) = (self.name(winner), self.name(other));
        let (said, head) = match (asks, first) {
            (true, _) => (Said::Found, ""),
            (false, true) => (Said::Yes, self.pick("да, ", "yes, ")),
            (false, false) => (Said::No, self.pick("нет, ", "no, ")),
        };
        let text = match self.is_russian() {
            true => format!("{head}{name} {side}, чем {other_name} ({from})"),
            false => format!("{head}{name} is {side} than {other_name} ({from})"),
        };
        Draft::new(said, text).with(vec![winner]).about(&[other])
    }

    fn comparative(&self, extreme: Extreme) -> &'static str {
        match extreme {
            Extreme::Nearest => self.pick("ближе", "closer"),
            Extreme::Farthest => self.pick("дальше", "farther"),
            Extreme::Smallest => self.pick("меньше", "smaller"),
            Extreme::Tallest => self.pick("выше", "taller"),
            Extreme::Lowest => self.pick("ниже", "lower"),
            Extreme::Topmost => self.pick("выше", "higher"),
            Extreme::Bottommost => self.pick("ниже", "lower"),
            Extreme::Shortest => self.pick("короче", "shorter"),
            Extreme::Widest => self.pick("шире", "wider"),
            Extreme::Narrowest => self.pick("уже", "narrower"),
            Extreme::Longest => self.pick("длиннее", "longer"),
            Extreme::Thickest => self.pick("толще", "thicker"),
            Extreme::Thinnest => self.pick("тоньше", "thinner"),
            Extreme::Heaviest => self.pick("тяжелее", "heavier"),
            Extreme::Lightest => self.pick("легче", "lighter"),
            _ => self.pick("больше", "bigger"),
        }
    }

    pub(super) fn larger(
        &self,
        what: &Noun,
        than: &Noun,
        extreme: Extreme,
        to: Option<&Noun>,
        by: bool,
    ) -> Result<Draft, Doubt> {
        let (a, b) = (self.one(what)?, self.one(than)?);
        let to = to.map(|noun| self.one(noun)).transpose()?;
        if matches!(extreme, Extreme::LeftMost | Extreme::RightMost) {
            return Ok(self.further_aside([a, b], extreme, false));
        }
        let extreme = self.by_place_or_size(extreme, &[a, b]);
        let Some(compared) = self.compared(&[a, b], extreme, to) else {
            return Ok(self.incomparable(&[a, b], extreme));
        };
        let (x, y) = (compared.each[0], compared.each[1]);
        let less = extreme.is_less();
        let words = |t, v| self.compared_words(&compared, t, v);
        let yes = (x - y).abs() > 1e-9 && (x < y) == less && words(a, x) != words(b, y);
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let both =
            format!("{} – {}, {} – {}", self.name(a), words(a, x), self.name(b), words(b, y));
        // No one length tells by how much bodies differ.
        if by && self.is_volume(a, extreme) {
            return Ok(Draft::new(Said::Found, both).with(vec![a]).about(&[b]));
        }
        // «На сколько выше?»: the difference, and what it is the difference of.
        if by && yes {
            let apart = match (extreme, a.area()) {
                (Extreme::Biggest | Extreme::Smallest, Some(_)) => {
                    area((x - y).abs(), self.language)
                }
                _ => length((x - y).abs(), self.language),
            };
            let text = match self.is_russian() {
                true => format!("на {apart}: {both}"),
                false => format!("by {apart}: {both}"),
            };
            return Ok(Draft::new(Said::Found, text)
                .with(vec![a])
                .about(&[b])
                .number((x - y).abs()));
        }
        let text = format!("{head}{both}");
        let said = if yes { Said::Yes } else { Said::No };
        Ok(Draft::new(said, text).with(vec![a]).about(&[b]))
    }

    /// Whether a comparison is of bodies, which no one length tells apart.
    fn is_volume(&self, thing: Thing, extreme: Extreme) -> bool {
        matches!(extreme, Extreme::Biggest | Extreme::Smallest) && thing.area().is_none()
    }

    /// «стульев в Кухне (4) больше, чем в Спальне (2)»
    pub(super) fn more_of(
        &self,
        of: &[Noun; 2],
        extreme: Extreme,
        asks: bool,
        by: bool,
    ) -> Result<Draft, Doubt> {
        // A place that is not there has nothing to count.
        for noun in of {
            for restriction in &noun.restrictions {
                let named = |a: &&Noun| !self.is_walls(a) && !self.is_floor(a);
                for anchor in restriction.anchors.iter().filter(named) {
                    self.anchors(restriction, anchor, false)?;
                }
            }
        }
        let found = [self.find(&of[0], true)?, self.find(&of[1], true)?];
        // "More paintings than photos", which are one kind here.
        if found[0] == found[1] && !found[0].is_empty() {
            return Err(Doubt::not_understood(&of[1].text));
        }
        if let Some(untold) = of.iter().find_map(|noun| self.uncounted(noun)) {
            return Ok(Draft::new(Said::Unknown, untold));
        }
        let numbers = [found[0].len(), found[1].len()];
        let (fewer, equal) = (extreme == Extreme::Fewest, numbers[0] == numbers[1]);
        let first = if fewer { numbers[0] <= numbers[1] } else { numbers[0] >= numbers[1] };
        let (best, other) = if first { (0, 1) } else { (1, 0) };
        let one_kind = of[0].head == of[1].head && of[0].filters == of[1].filters;
        let kinds = of.each_ref().map(|noun| self.none_of(noun));
        let place = |n: usize| {
            let place = self.restrictions(&of[n]);
            if place.is_empty() { place } else { format!(" {place}") }
        };
        // A place of its own.
        let elsewhere = |n: usize| if place(0) == place(1) { String::new() } else { place(n) };
        let (a, b) = (numbers[best], numbers[other]);
        let more = match fewer {
            true => self.pick("меньше", "fewer"),
            false => self.pick("больше", "more"),
        };
        let apart = a.abs_diff(b);
        // "3 more chairs"
        let by_so_many = |n: usize| {
            let counted = self.counted(&of[n], apart);
            let be = if apart == 1 { "is" } else { "are" };
            format!("there {be} {}", counted.replacen(' ', &format!(" {more} "), 1))
        };
        let text = match (one_kind, equal, self.is_russian()) {
            (true, true, true) => {
                format!("поровну: {}{} и{} – по {a}", kinds[0], place(0), place(1))
            }
            (false, true, true) => {
                format!("поровну: {} и {}{} – по {a}", kinds[0], kinds[1], place(0))
            }
            (true, true, false) => {
                let counted = self.counted(&of[0], a);
                format!("equally many: {counted}{} and {b}{}", place(0), place(1))
            }
            (false, true, false) => {
                let [one, other] = of.each_ref().map(|noun| self.counted(noun, a));
                format!("equally many: {one} and {other}{}", place(0))
            }
            (true, false, true) => {
                let (own, than) = (place(best), place(other));
                format!("{}{own} ({a}) на {apart} {more}, чем{than} ({b})", kinds[0])
            }
            (false, false, true) => {
                let (own, than) = (&kinds[best], &kinds[other]);
                let there = elsewhere(other);
                format!("{own}{} ({a}) на {apart} {more}, чем {than}{there} ({b})", place(best))
            }
            (true, false, false) => {
                format!("{}{} ({a}) than{} ({b})", by_so_many(0), place(best), place(other))
            }
            (false, false, false) => {
                let than = &kinds[other];
                match elsewhere(other) {
                    there if there.is_empty() => {
                        format!("{} ({a}) than {than} ({b}){}", by_so_many(best), place(best))
                    }
                    there => {
                        let so_many = by_so_many(best);
                        format!("{so_many}{} ({a}) than {than}{there} ({b})", place(best))
                    }
                }
            }
        };
        let (said, head) = match (asks, first && !equal) {
            (true, _) if equal => (Said::Nothing, ""),
            (true, _) => (Said::Found, ""),
            (false, true) => (Said::Yes, self.pick("да, ", "yes, ")),
            (false, false) => (Said::No, self.pick("нет, ", "no, ")),
        };
        let things = match (equal, one_kind) {
            (true, _) => Vec::new(),
            (false, true) => self.anchor_things(&of[best]),
            (false, false) => found[best].clone(),
        };
        let number = if by { apart } else { a };
        Ok(Draft::new(said, format!("{head}{text}")).with(things).number(number as f64))
    }

    /// «Одного ли цвета стулья?»
    pub(super) fn same_all(&self, property: &Property, of: &Noun) -> Result<Draft, Doubt> {
        let found = self.definite(of)?;
        let own = |t: Thing| self.values(t).into_iter().find(|(p, _, _)| p == property);
        let mut keyed = Vec::new();
        for &thing in &found {
            let Some((_, value, text)) = own(thing) else {
                let text = self.no_property(property, thing);
                return Ok(Draft::new(Said::Unknown, text).with(found));
            };
            keyed.push((
                thing,
                match value {
                    Some(v) => self.lexicon().values.entry(v).russian.clone(),
                    None => text.to_lowercase(),
                },
            ));
        }
        let words = |first: Thing| match own(first) {
            Some((_, Some(value), _)) => self.value_of(property, value, first),
            Some((_, None, text)) => text.to_lowercase(),
            None => String::new(),
        };
        Ok(self.by_groups(keyed, words))
    }

    /// «Кровати одного размера?», "Are the chairs the same height?"
    pub(super) fn same_size(&self, dimension: Dimension, of: &[Noun]) -> Result<Draft, Doubt> {
        let found = self.all_meant(of)?;
        if let ([only], [_]) = (of, &found[..]) {
            return Err(self.one_of_several(only, &found));
        }
        let keyed: Option<Vec<(Thing, String)>> =
            found.iter().map(|t| Some((*t, self.size_in_words(dimension, *t)?))).collect();
        let Some(keyed) = keyed else {
            let words = of.iter().map(|noun| noun.text.as_str()).collect::<Vec<_>>().join(", ");
            return Err(Doubt::NotUnderstood { words });
        };
        Ok(self.by_groups(keyed, |first| self.size_in_words(dimension, first).unwrap_or_default()))
    }

    /// Whether things that are alike by a key are all of one group; each group with the words of its first.
    fn by_groups(&self, keyed: Vec<(Thing, String)>, words: impl Fn(Thing) -> String) -> Draft {
        let found = keyed.iter().map(|(thing, _)| *thing).collect();
        let mut groups: Vec<(String, Vec<Thing>)> = Vec::new();
        for (thing, key) in keyed {
            match groups.iter_mut().find(|(other, _)| *other == key) {
                Some((_, things)) => things.push(thing),
                None => groups.push((key, vec![thing])),
            }
        }
        let yes = groups.len() == 1;
        let each = |(_, things): &(String, Vec<Thing>)| {
            format!("{} – {}", self.list(things), words(things[0]))
        };
        let parts: Vec<String> = groups.iter().map(each).collect();
        let head = if yes { self.pick("да", "yes") } else { self.pick("нет", "no") };
        let said = if yes { Said::Yes } else { Said::No };
        Draft::new(said, format!("{head}: {}", parts.join("; "))).with(found)
    }

    pub(super) fn same(&self, property: &Property, of: &[Noun; 2]) -> Result<Draft, Doubt> {
        if of.iter().any(|noun| noun.plural) {
            let things = [self.definite(&of[0])?, self.definite(&of[1])?].concat();
            let head = Head { things: Some(things), ..Head::default() };
            return self.same_all(property, &Noun { head, plural: true, ..Noun::default() });
        }
        let (a, b) = (self.one(&of[0])?, self.one(&of[1])?);
        let own = |t: Thing| self.values(t).into_iter().find(|(p, _, _)| p == property);
        let (Some((_, x, first)), Some((_, y, second))) = (own(a), own(b)) else {
            let missing = if own(a).is_none() { a } else { b };
            return Ok(
                Draft::new(Said::Unknown, self.no_property(property, missing)).with(vec![a, b])
            );
        };
        let yes = if x.is_some() { x == y } else { first == second };
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let words = |t: Thing, v: Option<crate::question::values::ValueId>, text: &str| match v {
            Some(v) => self.value_of(property, v, t),
            None => text.to_lowercase(),
        };
        let dash = self.pick("", "is ");
        let text = format!(
            "{head}{} {dash}{}, {} {dash}{}",
            self.name(a),
            words(a, x, &first),
            self.name(b),
            words(b, y, &second)
        );
        let said = if yes { Said::Yes } else { Said::No };
        Ok(Draft::new(said, text).with(vec![a, b]))
    }
}
