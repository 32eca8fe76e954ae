//! The items of a sentence sorted by what they are.
//!
//! Invariant: no item is lost; what nothing knows ends the reading with a doubt.

use super::Frame;
use super::Referent;
use super::Spot;
use super::Subject;
use super::things;
use crate::question::Doubt;
use crate::question::grammar::{Item, Phrase, Sentence};
use crate::question::lexicon::{Extension, Lexicon};
use crate::question::mark::{Mark, Pronoun};
use crate::question::query::{Filter, Head, Noun, Rel, Restriction, Side, Thing};
use crate::question::uses;
use crate::question::values::{Property, ValueId};
use crate::report::Detail;
use crate::sets::set;
use crate::words::everyday;

/// Whether a place is none of its kind in a sentence that is denied anyway: «ни в одной комнате нет …».
fn in_none(sentence: &Sentence<'_>, place: &Phrase) -> bool {
    let keys = &sentence.keys;
    let none = place.words.start.checked_sub(2).is_some_and(|n| keys[n] == "ни");
    none && keys[place.words.start].starts_with("одн") && keys.iter().any(|key| key == "нет")
}

/// Whether a list goes on to its «и», as «…, чашки и ложки» does; a noun behind the last comma may be no part of it.
fn listed_on(items: &[Item], sentence: &Sentence<'_>) -> bool {
    match items {
        [Item::Noun(_), Item::Mark(Mark::And | Mark::Or), Item::Noun(_), ..] => true,
        [Item::Noun(a), Item::Noun(b), ..] => {
            sentence.comma_between(a.words.end, b.words.start) && listed_on(&items[1..], sentence)
        }
        _ => false,
    }
}

/// Whether a sentence names one place only, from which something is told.
fn is_only_from(items: &[Item]) -> bool {
    let mut places = items.iter().filter_map(|item| match item {
        Item::Place { rel, .. } => Some(*rel),
        _ => None,
    });
    places.next() == Some(Rel::From) && places.next().is_none()
}

/// Whether an item stands where an activity names what it is done to: «порезать хлеб», "cut the bread".
fn done_to(items: &[Item], at: usize) -> bool {
    let article = |item: &Item| matches!(item, Item::Mark(Mark::The | Mark::A));
    let before = items[..at].iter().rev().find(|item| !article(item));
    matches!(before, Some(Item::Mark(Mark::Activity(activity))) if uses::takes_object(*activity))
}

/// Whether a preposition governs no noun but whatever there is, "on anything", «ни на чём»; and whether that is denied, "on nothing".
fn of_whatever(sentence: &Sentence<'_>, items: &[Item], at: usize) -> Option<bool> {
    let denied = |key: &String| set!("NothingWord").contains(&key.as_str());
    match items.get(at + 1)? {
        Item::Mark(Mark::Anything) => Some(sentence.keys.iter().any(denied)),
        Item::Mark(Mark::What) if at > 0 && items[at - 1] == Item::Mark(Mark::Not) => Some(false),
        _ => None,
    }
}

impl<'s, 't> Frame<'s, 't> {
    pub(super) fn of(
        sentence: &'s Sentence<'t>,
        lexicon: &'s Lexicon,
        items: &[Item],
        referent: &Referent<'_>,
    ) -> Result<Self, Doubt> {
        let mut frame = Self {
            sentence,
            lexicon,
            marks: Vec::new(),
            nouns: Vec::new(),
            spots: Vec::new(),
            links: Vec::new(),
            values: Vec::new(),
            sizes: Vec::new(),
            property: None,
            you: false,
            me: false,
            there: None,
            nowhere: None,
            negated: false,
            except: Vec::new(),
            excepted: Vec::new(),
            undone: None,
            idle: false,
        };
        let items = &sides_shared(items)[..];
        let mut not = false;
        let mut without = false;
        let mut excepted = None;
        for (at, item) in items.iter().enumerate() {
            match item {
                Item::Mark(Mark::Not) => {
                    not = true;
                    // «комната без окон», «минуя кухню» deny nothing of the question.
                    let without = matches!(
                        items.get(at + 1),
                        Some(Item::Place { rel: Rel::Has | Rel::Through, .. })
                    );
                    if !without {
                        frame.negated = true;
                        frame.marks.push((Mark::Not, at));
                    }
                }
                // "within reach of the bed": in or on what goes nothing lies; the verb is a noun that is not known.
                Item::Mark(Mark::Move)
                    if at > 0
                        && matches!(items[at - 1], Item::Link(Rel::In | Rel::On | Rel::Under)) =>
                {
                    return Err(Doubt::not_understood(sentence.text));
                }
                Item::Mark(Mark::Except) => without = true,
                Item::Mark(mark) => frame.marks.push((*mark, at)),
                // «Назови комнаты и их площади»: their own, of what stands before.
                Item::Noun(phrase)
                    if phrase.pronoun == Some(Pronoun::They)
                        && at > 0
                        && items[at - 1] == Item::Mark(Mark::And)
                        && frame.nouns.last().is_some_and(|s| s.noun.plural) => {}
                // "How far is it from the hall to the kitchen?" means nothing by "it".
                Item::Noun(phrase)
                    if phrase.pronoun == Some(Pronoun::Any)
                        && items[..at].iter().all(|item| {
                            matches!(item, Item::Mark(Mark::HowFar | Mark::Be | Mark::And))
                        })
                        && frame.has(Mark::HowFar)
                        // "How far is it from the counter?" is asked of what was spoken of.
                        && (!is_only_from(items) || referent(Pronoun::Any, None).is_empty()) => {}
                Item::Noun(phrase) => {
                    let Some(mut noun) = frame.noun(phrase, None, referent)? else { continue };
                    // "the green book and the red one"
                    let joined = at > 0
                        && matches!(
                            items[at - 1],
                            Item::Mark(Mark::And | Mark::Or | Mark::As | Mark::Than)
                        );
                    if let Some(before) = frame.nouns.last().filter(|_| joined)
                        && noun.head.anything
                        && !before.noun.head.kinds.is_empty()
                    {
                        noun.head =
                            Head { kinds: before.noun.head.kinds.clone(), ..Head::default() };
                    }
                    // «кроме унитаза и раковины»
                    let again = excepted.is_some_and(|last| match &items[last..at] {
                        [_, Item::Mark(Mark::And | Mark::Or)] => true,
                        [Item::Noun(last)] => {
                            sentence.comma_between(last.words.end, phrase.words.start)
                                && listed_on(&items[at..], sentence)
                        }
                        _ => false,
                    });
                    if std::mem::take(&mut without) || again {
                        frame.except.push(noun);
                        excepted = Some(at);
                        continue;
                    }
                    let first = frame.nouns.is_empty();
                    let negated = not && !first && std::mem::take(&mut not);
                    // "Is there no chair in the kitchen?", «Нет стула в кухне?» deny the chair, not its place.
                    let denied = at > 0 && items[at - 1] == Item::Mark(Mark::Not);
                    if first && denied && (frame.has(Mark::Exists) || !phrase.nominative) {
                        not = false;
                    }
                    let nominative = phrase.nominative;
                    frame.nouns.push(Subject { noun, at, negated, nominative });
                }
                Item::Place { rel, nouns, either } => {
                    let mut anchors = Vec::new();
                    // «Где у тебя лежит зонт?» says nothing of a place.
                    let said = nouns[0].words.start.checked_sub(1).map(|n| &sentence.keys[n]);
                    if nouns[0].person == Some(Mark::You)
                        && *rel == Rel::NextTo
                        && said.is_some_and(|key| key == "у")
                    {
                        continue;
                    }
                    for phrase in nouns {
                        // «над тумбой или на ней»: what the sentence has just named.
                        if phrase.pronoun.is_some()
                            && frame.has(Mark::Or)
                            && let Some(before) = frame.spots.last()
                        {
                            anchors.extend(before.nouns.first().cloned());
                            continue;
                        }
                        let mut noun = frame.noun(phrase, Some(*rel), referent)?;
                        // «рядом с красной», "next to the red one"
                        if let (Some(noun), Some(before)) = (&mut noun, frame.nouns.last())
                            && noun.head.anything
                            && !noun.filters.is_empty()
                            && !before.noun.head.kinds.is_empty()
                            && !frame.is_area(&before.noun)
                        {
                            let kinds = before.noun.head.kinds.clone();
                            noun.head = Head { kinds, ..Head::default() };
                        }
                        anchors.extend(noun);
                        if phrase.person == Some(Mark::You) {
                            anchors.push(things(vec![Thing::Robot], "you"));
                        }
                    }
                    if anchors.is_empty() {
                        let words = nouns[0].words.clone();
                        let me = nouns[0].person == Some(Mark::Me);
                        // «у меня есть …», "for me" say nothing of a place.
                        if me && matches!(rel, Rel::NextTo | Rel::To | Rel::Of) {
                            continue;
                        }
                        // «дальше от меня»: nearness is told from where the robot is, as without «от меня».
                        let compares = |item: &Item| {
                            matches!(
                                item,
                                Item::Mark(Mark::Nearer(_) | Mark::Best(_) | Mark::BestTo(_))
                            )
                        };
                        if me && *rel == Rel::From && items.iter().any(compares) {
                            continue;
                        }
                        // The robot does not know where the person stands.
                        if me {
                            let word = sentence.said(&words).to_owned();
                            return Err(Doubt::NoReferent { word });
                        }
                        return Err(Doubt::not_understood(sentence.said(&words)));
                    }
                    let (rel, either) = (*rel, *either);
                    // «кроме лампы на столе», «кроме тех, что на кухне»
                    let behind = at > 0 && matches!(&items[at - 1], Item::Noun(_));
                    if let (true, Some(except)) = (behind, frame.except.last_mut())
                        && except.text == frame_text(&items[at - 1])
                    {
                        except.restrictions.push(Restriction { rel, anchors, negated: false });
                        continue;
                    }
                    if std::mem::take(&mut without) {
                        let head = Head { anything: true, ..Head::default() };
                        let place = Restriction { rel, anchors, negated: false };
                        let restrictions = vec![place];
                        frame.except.push(Noun {
                            head,
                            plural: true,
                            restrictions,
                            ..Noun::default()
                        });
                        continue;
                    }
                    let denied = std::mem::take(&mut not);
                    // «Ни в одной комнате нет дивана» denies the sofa, once.
                    let concord = denied && in_none(sentence, &nouns[0]);
                    if concord {
                        anchors[0].count = None;
                        anchors[0].indefinite = true;
                    }
                    let negated = denied && !concord;
                    let spot = Spot { rel, nouns: anchors, either, at, negated };
                    // "in a room with a window": the room has it, whatever else is in that room.
                    let before = at.checked_sub(1).filter(|_| rel == Rel::Has && !either);
                    let activity = |(mark, _): &(Mark, usize)| matches!(mark, Mark::Activity(_));
                    let with_what = frame.marks.iter().any(activity);
                    let room = frame.spots.iter().rposition(|spot| {
                        Some(spot.at) == before
                            && matches!(&spot.nouns[..], [room]
                                if frame.is_rooms(room) || frame.is_area(room) && !with_what)
                    });
                    match room {
                        Some(room) => {
                            let places = spot.restrictions();
                            frame.spots[room].nouns[0].restrictions.extend(places);
                        }
                        None => frame.spots.push(spot),
                    }
                }
                // "not on anything", «ни на чём», "next to nothing"
                Item::Link(rel) if let Some(none) = of_whatever(sentence, items, at) => {
                    let head = Head { anything: true, ..Head::default() };
                    let nouns = vec![Noun { head, indefinite: true, ..Noun::default() }];
                    let negated = std::mem::take(&mut not) || none;
                    frame.negated |= negated;
                    frame.spots.push(Spot { rel: *rel, nouns, either: false, at, negated });
                }
                Item::Link(rel) => frame.links.push((*rel, at)),
                // «все книги, кроме красной»
                Item::Value(value) if without && !frame.nouns.is_empty() => {
                    without = false;
                    let kinds = frame.nouns[0].noun.head.kinds.clone();
                    let head = Head { kinds, ..Head::default() };
                    let filters = vec![Filter::new(*value, false)];
                    frame.except.push(Noun { head, plural: true, filters, ..Noun::default() });
                }
                Item::Value(value) if let Some(words) = frame.called_after(*value, items, at) => {
                    return Err(Doubt::not_understood(&words));
                }
                Item::Value(value) if frame.is_filled_with(*value, items, at) => {
                    return Err(Doubt::not_understood(sentence.text));
                }
                Item::Value(value) => {
                    frame.values.push((*value, at, std::mem::take(&mut not)));
                }
                Item::Property(property) => {
                    frame.property.get_or_insert((property.clone(), at));
                }
                // "Chair 12", of which there is none
                Item::Number(_)
                    if let Some(reference) = numbered(items.get(at.wrapping_sub(1)), sentence) =>
                {
                    return Err(Doubt::Unknown { reference, near: Vec::new() });
                }
                Item::Number(number) => {
                    if !frame.counts(*number, at) && !frame.counts_last(*number, items.len() - at) {
                        frame.marks.push((if *number == 1 { Mark::A } else { Mark::Filler }, at));
                        frame.idle |= *number > 1;
                    }
                }
                Item::Size(size) => frame.sizes.push(*size),
                // «Чем порезать хлеб?»: what is cut need not be on the map.
                Item::Unknown(words) if done_to(items, at) => {
                    frame.undone = Some(sentence.said(words).to_owned());
                }
                Item::Unknown(words) => return Err(frame.unknown(words, items.get(at + 1))),
            }
        }
        // "What else is there?"
        let bare = frame.nouns.is_empty() && frame.spots.is_empty() && frame.there.is_none();
        let bare = bare && !frame.marks.iter().any(|(mark, _)| matches!(mark, Mark::Activity(_)));
        if bare && frame.asks() && frame.has(Mark::Other) && frame.has(Mark::Exists) {
            let meant = referent(Pronoun::There, None);
            frame.there = (!meant.is_empty()).then(|| things(meant, "there"));
        }
        // «Что у нас там в холодильнике?» names the place itself, "Which rooms are there?" needs none.
        if let Some(word) = &frame.nowhere
            && (frame.has(Mark::HowGet) || frame.has(Mark::Move))
        {
            return Err(Doubt::NoReferent { word: word.clone() });
        }
        // "How far is it from here?"
        let it = sentence.keys.iter().any(|key| key == "it");
        if it && frame.has(Mark::HowFar) && frame.nouns.is_empty() && frame.spots.is_empty() {
            let meant = referent(Pronoun::Any, None);
            if meant.is_empty() {
                return Err(Doubt::NoReferent { word: "it".to_owned() });
            }
            let noun = things(meant, "it");
            frame.nouns.push(Subject { noun, at: items.len(), negated: false, nominative: true });
        }
        frame.all_of_those_told(items.len(), referent)?;
        // «Вся ли мебель деревянная?»: the small word stands between.
        let all = frame.has(Mark::All) || frame.has(Mark::Each);
        if let Some(first) = frame.nouns.first_mut().filter(|_| all) {
            first.noun.all = true;
        }
        frame.excepted.clone_from(&frame.except);
        frame.except_rooms();
        frame.rooms_of_storeys();
        frame.look_aside();
        let walls = frame.on_walls(items.len());
        frame.spots.extend(walls);
        Ok(frame)
    }

    /// "Is there a window in every room except the hall?": of the rooms, not of the windows.
    fn except_rooms(&mut self) {
        let rooms = |noun: &Noun| self.is_area(noun) && (noun.plural || noun.all);
        let subject = self.nouns.iter().position(|s| rooms(&s.noun));
        let spot = self.spots.iter().position(|s| rooms(&s.nouns[0]));
        let (except, rest): (Vec<Noun>, Vec<Noun>) =
            std::mem::take(&mut self.except).into_iter().partition(|noun| self.is_area(noun));
        match (subject, spot) {
            (Some(at), _) => self.nouns[at].noun.except.extend(except),
            (None, Some(at)) => self.spots[at].nouns[0].except.extend(except),
            (None, None) => self.except.extend(except),
        }
        self.except.extend(rest);
    }

    /// "Is there a wine glass?": a noun and a material right behind it are the name of one thing, where they say nothing of the
    /// noun, as "Is the bottle glass?" does.
    fn called_after(&self, value: ValueId, items: &[Item], at: usize) -> Option<String> {
        let Item::Noun(phrase) = items.get(at.checked_sub(1)?)? else { return None };
        let is_material = self.lexicon.values.entry(value).property == Property::Material;
        let says = matches!(items.first(), Some(Item::Mark(Mark::Be | Mark::Not)));
        let named = phrase.pronoun.is_none() && phrase.person.is_none();
        let english = self.sentence.language == crate::words::Language::English;
        let words = phrase.words.start..phrase.words.end + 1;
        (english && is_material && named && !says).then(|| self.sentence.said(&words).to_owned())
    }

    /// "A bottle of red": of what it is full, and not what colour it has.
    fn is_filled_with(&self, value: ValueId, items: &[Item], at: usize) -> bool {
        let is_colour = self.lexicon.values.entry(value).property == Property::Colour;
        let of = at > 0 && items[at - 1] == Item::Link(Rel::Of);
        let english = self.sentence.language == crate::words::Language::English;
        is_colour && of && english && !matches!(items.get(at + 1), Some(Item::Property(_)))
    }

    /// «Стульев на кухне больше трёх?»: gives a number that stands last to what is counted.
    fn counts(&mut self, number: u64, at: usize) -> bool {
        let Some(&(Mark::Number(quantity), before)) = self.marks.last() else { return false };
        let counted = self.nouns.iter_mut().find(|s| s.noun.plural && s.noun.count.is_none());
        let Some(subject) = counted.filter(|_| before + 1 == at) else { return false };
        subject.noun.count = Some(number);
        subject.noun.quantity = quantity;
        subject.noun.indefinite = true;
        true
    }

    /// «Ноутбуков в доме два?»: a number at the end counts what stands in the plural before.
    fn counts_last(&mut self, number: u64, left: usize) -> bool {
        let asked = self.asks() || self.has(Mark::HowMany) || self.has(Mark::Where);
        let [subject] = &mut self.nouns[..] else { return false };
        let counted = subject.noun.plural && subject.noun.count.is_none() && !asked && left == 1;
        if counted {
            subject.noun.count = Some(number);
            subject.noun.indefinite = true;
        }
        counted
    }

    /// "pepper shaker": the name of things that people have, of which the map has none.
    fn thing_unknown(&self, words: &std::ops::Range<usize>) -> Option<String> {
        let last = self.sentence.words.len().min(words.start + everyday::LONGEST);
        let longest = (words.start + 1..=last).rev().find_map(|end| {
            let said = self.sentence.said(&(words.start..end));
            everyday::is_a_thing(&crate::units::name_key(said)).then_some(said)
        });
        longest.map(str::to_owned)
    }

    /// Words that nothing knows: a name that the map lacks, or no word at all.
    fn unknown(&self, words: &std::ops::Range<usize>, next: Option<&Item>) -> Doubt {
        // «Комната-X»: the noun before the hyphen belongs to the name that is not there.
        let mut words = words.clone();
        while words.start > 0 {
            let gap =
                self.sentence.words[words.start - 1].end..self.sentence.words[words.start].start;
            if !self.sentence.text[gap].chars().all(crate::words::is_hyphen) {
                break;
            }
            words.start -= 1;
        }
        let said = self.sentence.said(&words);
        // "Sofa" is no slip for "soft".
        let thing = self.thing_unknown(&words);
        if let Some(reference) = thing {
            return Doubt::Unknown { reference, near: Vec::new() };
        }
        let near = self.lexicon.alike(said);
        // «туалетная бумага», "toilet paper": the name of one thing, though paper alone is a material.
        let material =
            |value: &ValueId| self.lexicon.values.entry(*value).property == Property::Material;
        if let (Some(Item::Value(value)), true) = (next, near.is_empty())
            && material(value)
        {
            let whole = words.start..words.end + 1;
            return Doubt::Unknown { reference: self.sentence.said(&whole).to_owned(), near };
        }
        let before_noun = matches!(next, Some(Item::Noun(_)));
        if near.is_empty() && (before_noun || !crate::words::may_be_noun(said)) {
            return Doubt::not_understood(said);
        }
        if before_noun && near.is_empty() {
            return Doubt::not_understood(said);
        }
        Doubt::Unknown { reference: said.to_owned(), near }
    }

    pub(super) fn noun(
        &mut self,
        phrase: &Phrase,
        rel: Option<Rel>,
        referent: &Referent<'_>,
    ) -> Result<Option<Noun>, Doubt> {
        match (phrase.pronoun, phrase.person) {
            (Some(pronoun), _) => {
                let meant = referent(pronoun, rel);
                if meant.is_empty() {
                    return Err(Doubt::NoReferent { word: phrase.noun.text.clone() });
                }
                let indefinite = phrase.noun.indefinite;
                Ok(Some(Noun { indefinite, ..things(meant, &phrase.noun.text) }))
            }
            (_, Some(Mark::You)) => {
                self.you = true;
                Ok(None)
            }
            (_, Some(Mark::There)) => {
                let meant = referent(Pronoun::There, None);
                self.nowhere = meant.is_empty().then(|| phrase.noun.text.clone());
                self.there = (!meant.is_empty()).then(|| things(meant, &phrase.noun.text));
                Ok(None)
            }
            (_, Some(_)) => {
                self.me = true;
                Ok(None)
            }
            _ => Ok(Some(phrase.noun.clone())),
        }
    }

    pub(super) fn has(&self, wanted: Mark) -> bool {
        // What hangs is somewhere, too.
        let fits = |mark: Mark| mark == wanted || (wanted == Mark::Be && mark == Mark::Hang);
        self.marks.iter().any(|(mark, _)| fits(*mark))
    }

    /// «Что слева от стола, если смотреть на окно?»: the side is that of one who faces the thing.
    fn look_aside(&mut self) {
        let side = |rel: Rel, all: bool| match (rel, all) {
            (Rel::LeftOf, true) => Some(Side::AllLeft),
            (Rel::RightOf, true) => Some(Side::AllRight),
            (Rel::LeftOf, false) => Some(Side::Left),
            (Rel::RightOf, false) => Some(Side::Right),
            _ => None,
        };
        if !self.asks() {
            return;
        }
        let told = |rel: Rel| matches!(rel, Rel::LeftOf | Rel::RightOf);
        let of = self.spots.iter().position(|s| told(s.rel) && s.nouns.len() == 1);
        let faced = self.spots.iter().position(|s| s.rel == Rel::Facing && s.nouns.len() == 1);
        let it = self.has(Mark::FacingIt);
        if let (Some(of), None, true) = (of, faced, it) {
            let spot = &mut self.spots[of];
            spot.nouns.push(spot.nouns[0].clone());
            spot.rel = side(spot.rel, false).map_or(spot.rel, Rel::ToTheEye);
            self.marks.retain(|(mark, _)| *mark != Mark::FacingIt);
            return;
        }
        let Some(faced) = faced else { return };
        let seen = self.spots[faced].nouns[0].clone();
        let link = self.links.iter().position(|(rel, _)| told(*rel));
        match (of, link) {
            (Some(of), _) => {
                let spot = &mut self.spots[of];
                spot.nouns.push(seen);
                spot.rel = side(spot.rel, false).map_or(spot.rel, Rel::ToTheEye);
                self.spots.remove(faced);
            }
            (None, Some(link)) => {
                let (rel, _) = self.links.remove(link);
                self.spots[faced].rel = side(rel, true).map_or(rel, Rel::ToTheEye);
            }
            (None, None) => {}
        }
    }

    /// "What hangs in the hall?": on its walls, where nothing else is named to hang on.
    fn on_walls(&self, items: usize) -> Option<Spot> {
        let asked = self.asks() || self.has(Mark::HowMany) || self.has(Mark::List);
        let in_rooms = self.spots.iter().all(|s| s.rel != Rel::On && self.is_area(&s.nouns[0]));
        let kind = self.lexicon.kind_of(&Extension::Walls)?;
        let head = Head { kinds: vec![kind], ..Head::default() };
        let compares = self.marks.iter().any(|(mark, _)| matches!(mark, Mark::More(_)));
        (asked && in_rooms && !compares && self.has(Mark::Hang) && self.links.is_empty()).then(
            || Spot {
                rel: Rel::On,
                nouns: vec![Noun { head, plural: true, indefinite: true, ..Noun::default() }],
                either: false,
                at: items + 1,
                negated: false,
            },
        )
    }

    /// Whether a noun is a key, by its words.
    pub(super) fn is_key(&self, noun: &Noun) -> bool {
        let keys = crate::units::name_key(&noun.text);
        keys.split(' ').any(|word| word.starts_with("ключ") || word == "key" || word == "keys")
    }

    /// How much of a way or a place is asked for.
    pub(super) fn detail(&self) -> Detail {
        let asked = self.marks.iter().find_map(|(mark, _)| match mark {
            Mark::Detail(detail) => Some(*detail),
            _ => None,
        });
        asked.unwrap_or_default()
    }

    pub(super) fn place_of(&self, wanted: Mark) -> Option<usize> {
        self.marks.iter().find(|(mark, _)| *mark == wanted).map(|(_, at)| *at)
    }

    pub(super) fn asks(&self) -> bool {
        self.has(Mark::What) || self.has(Mark::Which)
    }

    pub(super) fn is_kind(&self, noun: &Noun, wanted: impl Fn(&Extension) -> bool) -> bool {
        noun.head.kinds.iter().any(|k| wanted(&self.lexicon.kind(*k).extension))
    }

    /// Rooms and storeys, named or not.
    pub(super) fn is_area(&self, noun: &Noun) -> bool {
        let named = |e: &crate::map::Entity| {
            matches!(e, crate::map::Entity::Area(_) | crate::map::Entity::Map(_))
        };
        let meant = |things: &Vec<Thing>| things.iter().any(|t| t.area().is_some());
        (!noun.head.named.is_empty() && noun.head.named.iter().all(named))
            || noun.head.things.as_ref().is_some_and(meant)
            || noun.head.kinds.iter().any(|k| self.lexicon.is_area(*k))
    }

    pub(super) fn is_rooms(&self, noun: &Noun) -> bool {
        noun.head.named.is_empty()
            && self.is_kind(noun, |e| {
                matches!(e, Extension::Rooms | Extension::AreaType(_) | Extension::Storeys)
            })
    }

    pub(super) fn is_storeys(&self, noun: &Noun) -> bool {
        self.is_kind(noun, |e| matches!(e, Extension::Storeys))
    }

    pub(super) fn is_storey(&self, noun: &Noun) -> bool {
        noun.is_storey(self.lexicon)
    }

    pub(super) fn is_building(&self, noun: &Noun) -> bool {
        self.is_kind(noun, |e| matches!(e, Extension::Building))
    }

    pub(super) fn is_doors(&self, noun: &Noun) -> bool {
        let named = |e: &crate::map::Entity| matches!(e, crate::map::Entity::Door(_));
        let meant = |things: &Vec<Thing>| {
            things.iter().any(|t| {
                matches!(t, Thing::Opening(_) | Thing::Entity(crate::map::Entity::Door(_)))
            })
        };
        noun.head.named.iter().any(named)
            || noun.head.things.as_ref().is_some_and(meant)
            || self.is_kind(noun, |e| {
                matches!(e, Extension::Doors | Extension::Passages | Extension::DoorType(_))
            })
    }

    pub(super) fn spot(&self, wanted: &[Rel]) -> Option<&Spot> {
        self.spots.iter().find(|s| wanted.contains(&s.rel))
    }

    pub(super) fn spot_noun(&self, wanted: &[Rel]) -> Option<Noun> {
        self.spot(wanted).and_then(|s| s.nouns.first()).cloned()
    }

    /// The noun of the question, with «там» as its place.
    pub(super) fn first(&self) -> Option<Noun> {
        self.nouns.first().map(|s| s.noun.clone())
    }
}

/// A noun with a number in digits right behind it, as it was said.
fn numbered(before: Option<&Item>, sentence: &Sentence<'_>) -> Option<String> {
    let phrase = match before? {
        Item::Noun(phrase) => phrase,
        Item::Place { nouns, .. } => nouns.last()?,
        _ => return None,
    };
    let number = sentence.keys.get(phrase.words.end)?;
    let named = !phrase.noun.plural && number.parse::<u64>().is_ok();
    let words = phrase.words.start..phrase.words.end + 1;
    named.then(|| sentence.said(&words).to_owned())
}

/// The words of a noun among the items.
fn frame_text(item: &Item) -> &str {
    match item {
        Item::Noun(phrase) => &phrase.noun.text,
        _ => "",
    }
}

/// «слева или справа от кровати»: both sides are of the bed.
fn sides_shared(items: &[Item]) -> Vec<Item> {
    let mut items = items.to_vec();
    for n in 0..items.len().saturating_sub(2) {
        let [Item::Link(rel), Item::Mark(Mark::Or), Item::Place { nouns, either, .. }] =
            &items[n..n + 3]
        else {
            continue;
        };
        items[n] = Item::Place { rel: *rel, nouns: nouns.clone(), either: *either };
    }
    items
}
