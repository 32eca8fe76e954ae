//! What a clause of a command speaks of.

use std::ops::Range;

use super::Resolver;
use super::choice::with;
use super::place::Spot;
use crate::command::Sort;
use crate::map::Entity;
use crate::question::Doubt;
use crate::question::grammar::{Item, Phrase, points};
use crate::question::knowledge::Knowledge;
use crate::question::lexicon::{Extension, KindId};
use crate::question::mark::Mark;
use crate::question::query::{Filter, Head, Noun, Quantity, Rel, Restriction, Thing};
use crate::question::values::ValueId;
use crate::semantics::lifts;
use crate::sets::{Set, set};
use crate::units::{AreaId, DoorId};
use crate::words::{Case, Language, Number, Readings, phrase_at};

/// The thing that is taken of several that were named, and the words that named them.
pub(super) type Chosen = (Thing, Range<usize>);

/// What follows a noun and tells more of it.
#[derive(Default)]
pub(super) struct More {
    pub(super) value: Option<ValueId>,
    pub(super) except: Vec<Noun>,
    /// What was spoken of before the clause: «возьми с него».
    pub(super) place: Option<Thing>,
    /// The places of which it is said to be there.
    pub(super) there: Option<Vec<Thing>>,
    /// The room into which the sentence sends the robot before.
    pub(super) gone_to: Option<AreaId>,
    /// What was opened for it: «открой холодильник и достань молоко».
    pub(super) opened: Option<Thing>,
    /// What stands before it in the clause: "the red one" after a book is a book.
    pub(super) like: Option<Head>,
    /// What the sentence has done something to before: another one is none of these.
    pub(super) told: Vec<Thing>,
}

impl Resolver<'_, '_> {
    /// What a clause speaks of.
    pub(super) fn object(
        &self,
        sort: Sort,
        phrase: &Phrase,
        spots: &[&&Spot<'_>],
        more: More,
    ) -> Result<Option<Vec<Thing>>, (Doubt, Range<usize>)> {
        let at = self.bytes(&phrase.words);
        let mut noun = phrase.noun.clone();
        noun.filters.extend(more.value.map(|value| Filter::new(value, false)));
        // "The light in every room except the kitchen": what is there is left out.
        let is_area = |noun: &Noun| {
            let base = self.knowledge.base(&noun.head);
            !base.is_empty() && base.iter().all(|t| t.area().is_some())
        };
        let (rooms, except): (Vec<Noun>, Vec<Noun>) =
            more.except.into_iter().partition(|except| is_area(except) && !is_area(&phrase.noun));
        noun.except.extend(except);
        noun.indefinite |= self.is_any(&phrase.words);
        noun.other |= self.is_one_more(&phrase.words);
        if noun.head.anything && (noun.all || noun.text.to_lowercase().contains("everything")) {
            // "Turn off everything in the kitchen"
            noun.plural = true;
        } else if let (true, Some(like)) = (noun.head.anything, more.like) {
            noun.head = like;
        } else if sort == Sort::Door && points(&noun) && self.is_led_to(spots) {
            // "Close the other one that leads to the bedroom": what leads to a room is a door.
            noun.head = Head { kinds: self.door_kinds(), ..Head::default() };
        } else if noun.head.anything && noun.other {
            noun.head = Head { things: Some(self.like_spoken()), ..Head::default() };
        } else if noun.head.anything
            && !self.spoken.is_empty()
            && !(points(&noun) && noun.best.is_some())
        {
            let spoken = self.spoken_for(sort);
            if spoken.is_empty() {
                return Err((Doubt::NoReferent { word: noun.text.clone() }, at));
            }
            noun.head = Head { things: Some(spoken), ..Head::default() };
            // "The second one", where none of those that were told is.
            let bare = noun.filters.is_empty() && spots.is_empty();
            if noun.rank.is_some() && noun.best.is_none() && bare {
                return Err((Doubt::NoReferent { word: noun.text.clone() }, at));
            }
            // "the red one", and none of what was spoken of is: then of all that can be carried, say.
            if self.candidates(&noun, &[]).is_ok_and(|found| found.is_empty()) {
                noun.head = Head { anything: true, ..Head::default() };
            }
        }
        let noun = &noun;
        let mut noun_is: Option<Noun> = None;
        let out = |room| Restriction { rel: Rel::In, anchors: vec![room], negated: true };
        let mut within: Vec<Restriction> = rooms.into_iter().map(out).collect();
        let doors = sort == Sort::Door && self.are_doors(noun);
        for spot in spots {
            self.counts_nothing(spot)?;
            // "from the desk and the shelf": it is on one of them.
            if let (Some(second), true) = (spot.nouns.get(1), spot.rel != Rel::Between) {
                return Err((Doubt::not_understood(&second.noun.text), self.bytes(&second.words)));
            }
            let mut anchor = with(&spot.phrase.noun, &spot.within);
            // "from the bed with the racket": what bears it or holds it, as where that is the object.
            if spot.within.iter().any(|place| place.rel == Rel::Has) {
                let found = self.candidates(&spot.phrase.noun, &spot.within);
                let found = found.map_err(|doubt| (doubt, self.bytes(&spot.phrase.words)))?;
                if found.is_empty() {
                    let doubt = self.knowledge.none_such(&anchor);
                    return Err((doubt, self.bytes(&spot.phrase.words)));
                }
                anchor = Noun { text: anchor.text, plural: found.len() > 1, ..Noun::of(found) };
            }
            // What the sentence has named, else what was spoken of that may be so related: "the banana from it".
            if let Some(pronoun) = spot.phrase.pronoun {
                let spoken = more.place == self.knowledge.memory.last_thing();
                let meant = || self.knowledge.borne_by_pronoun(pronoun).filter(|_| spoken);
                let all = || self.knowledge.places_meant(pronoun, spot.rel).filter(|_| spoken);
                let places = all().or_else(|| meant().or(more.place).map(|place| vec![place]));
                if let Some(places) = places {
                    anchor =
                        Noun { text: anchor.text, plural: places.len() > 1, ..Noun::of(places) };
                }
            }
            // «дверь на улицу»: the way out is the door itself.
            if doors && self.are_doors(&anchor) {
                noun_is = Some(anchor);
                continue;
            }
            let anchors = vec![anchor];
            let rel = match (sort, spot.rel) {
                // «ключ от лаборатории», not «ключи с письменного стола»
                (_, Rel::From | Rel::Of) if is_key(noun) && !self.is_out_of(spot) => Rel::Opens,
                // «дверь из кухни в коридор»
                (_, Rel::To | Rel::In | Rel::On | Rel::From | Rel::Through | Rel::Of) if doors => {
                    Rel::Of
                }
                (_, rel) => rel,
            };
            let anchors = match spot.rel {
                Rel::Between => spot.nouns.iter().map(|p| p.noun.clone()).collect(),
                _ => anchors,
            };
            within.push(Restriction { rel, anchors, negated: false });
        }
        if let Some(opened) = more.opened.filter(|_| spots.is_empty() && noun.head.named.is_empty())
        {
            let anchors = vec![Noun::of(vec![opened])];
            within.push(Restriction { rel: Rel::In, anchors, negated: false });
        }
        if let Some(places) = &more.there {
            let there = Noun { plural: places.len() > 1, ..Noun::of(places.clone()) };
            within.push(Restriction { rel: Rel::There, anchors: vec![there], negated: false });
        }
        let told = noun_is.map(|way_out| Noun { head: way_out.head, ..noun.clone() });
        let noun = told.as_ref().unwrap_or(noun);
        let noun = &self.with_excepted_best(noun, &within);
        if self.is_strange(&phrase.words) {
            return Ok(None);
        }
        let is_window = |k| self.knowledge.lexicon().kind(k).extension == Extension::Windows;
        if sort == Sort::Door && noun.head.kinds.iter().any(|k| is_window(*k)) {
            return Err((Doubt::Windows, at));
        }
        if let (Some(room), true) = (more.gone_to, doors && within.is_empty())
            && let Some(words) = self.behind_oneself(&phrase.words)
        {
            let door = self.door_come_through(room).filter(|door| self.knowledge.can(sort, *door));
            let word = self.sentence.said(&words).to_owned();
            return match door {
                Some(door) => Ok(Some(vec![door])),
                None => Err((Doubt::NoReferent { word }, self.bytes(&words))),
            };
        }
        let mut found = self.candidates(noun, &within).map_err(|doubt| (doubt, at.clone()))?;
        if let (Some(places), true, Sort::Switch) = (&more.there, found.is_empty(), sort) {
            found = self.in_rooms_there(noun, places).map_err(|doubt| (doubt, at.clone()))?;
        }
        // "The one from the dresser", where a list was told before the last one: of that.
        if found.is_empty() && phrase.noun.head.anything && noun.head.things.is_some() {
            for exchange in &self.knowledge.memory.exchanges {
                let things = exchange.members().to_vec();
                if things.len() > 1 && found.is_empty() {
                    let head = Head { things: Some(things), ..Head::default() };
                    let told = Noun { head, ..noun.clone() };
                    found = self.candidates(&told, &within).map_err(|d| (d, at.clone()))?;
                }
            }
        }
        if noun.other {
            let given = |t: &Thing| {
                t.replica().is_some_and(|id| self.knowledge.senses.holder(id).is_some())
            };
            found.retain(|t| !given(t) && !more.told.contains(t));
        }
        // "The other pens" before any was spoken of: other than nothing is no other.
        if noun.other && noun.plural && noun.count.is_none() && !noun.head.anything {
            let all = Noun { other: false, ..noun.clone() };
            let all = self.candidates(&all, &within).map_err(|doubt| (doubt, at.clone()))?;
            if found.len() == all.len() && more.told.is_empty() {
                return Err((Doubt::NoReferent { word: noun.text.clone() }, at));
            }
        }
        let able: Vec<Thing> =
            found.iter().copied().filter(|t| self.knowledge.can(sort, *t)).collect();
        let none_can = able.is_empty();
        let there_are = found.len();
        if !none_can {
            found = able;
        } else if matches!(sort, Sort::Switch | Sort::Door | Sort::Carry | Sort::Put) {
            // None of them can be: that is said of one, and not asked which.
            let strict = (self.strict)(&noun.text).map(Thing::Entity);
            found = strict
                .filter(|t| found.contains(t))
                .or(found.first().copied())
                .into_iter()
                .collect();
        }
        let lights = |kind| self.knowledge.lexicon().kind(kind).extension == Extension::Lighting;
        let of_light = noun.head.named.is_empty() && noun.head.kinds.iter().any(|k| lights(*k));
        self.without_idle_count(noun, &phrase.words)?;
        if noun.quantity != Quantity::Exactly {
            return Err((Doubt::not_understood(&noun.text), at));
        }
        self.excepts_something(noun, &within, &phrase.words)?;
        // «Принеси все чашки 2» orders neither all of them nor one.
        let numeric = |key: &String| !key.is_empty() && key.chars().all(char::is_numeric);
        let last = phrase.words.end.checked_sub(1).and_then(|last| self.sentence.keys.get(last));
        let ends_in_number = last.is_some_and(numeric);
        let of_things = matches!(sort, Sort::Carry | Sort::Put | Sort::Switch | Sort::Door);
        // "Turn off Lamp 77; bring Battery 1": a number before a mark counts nothing behind it.
        let cut_off = (phrase.words.start + 1..phrase.words.end)
            .find(|&n| self.is_parted(n) && self.sentence.keys.get(n - 1).is_some_and(numeric));
        if let Some(n) = cut_off {
            return Err((Doubt::not_understood(self.sentence.said(&(n - 1..n))), at));
        }
        if noun.all && of_things && ends_in_number {
            return Err((Doubt::not_understood(self.sentence.said(&phrase.words)), at));
        }
        if let Some(each) =
            self.of_each(noun, &within, &found).map_err(|doubt| (doubt, at.clone()))?
        {
            return Ok(Some(each));
        }
        let both = self.is_both(&phrase.words).then_some(2);
        if let Some(wanted) = noun.count.filter(|_| noun.best.is_none()).or(both) {
            let wanted = usize::try_from(wanted).unwrap_or(usize::MAX);
            if both.is_none() && self.is_a_number_of_one(phrase, wanted) {
                return Err((Doubt::not_understood(&noun.text), at));
            }
            if none_can && !found.is_empty() {
                // "The 77 stool": that none can be carried makes no other number of them.
                let enough = there_are >= wanted;
                return if enough { Ok(Some(found)) } else { Err((Doubt::TooFew { found }, at)) };
            }
            // "Both cups", «все три чашки»: there are so many and no more, or it is not known which are meant.
            let these = both.is_some() || noun.all;
            // «обе спальни», one of which is called so: both of the kind.
            if found.len() < wanted
                && let Some(of_kind) = noun.of_kind()
            {
                found = self.candidates(&of_kind, &within).map_err(|doubt| (doubt, at.clone()))?;
                found.retain(|t| self.knowledge.can(sort, *t));
            }
            return match found.len() {
                0 => Ok(None),
                few if few < wanted => Err((Doubt::TooFew { found }, at)),
                more if these && more > wanted => Err((self.knowledge.ambiguous(noun, &found), at)),
                _ => Ok(Some(self.nearest_of(&found, wanted))),
            };
        }
        let one_of = noun.plural && self.is_one_of(&phrase.words);
        let plural = noun.plural && !one_of && !self.has_no_singular(noun);
        let several = plural || noun.all || (sort == Sort::Switch && of_light);
        if several && sort == Sort::Door {
            self.without_lifts(&mut found);
        }
        if several && !found.is_empty() {
            // «Погаси свет»: the lamps, and the switches of the rooms where they are.
            if sort == Sort::Switch && of_light {
                let area = |t: Thing| self.knowledge.area_of(t);
                let rooms: Vec<_> = found.iter().filter_map(|lamp| area(*lamp)).collect();
                let mut switches = self.knowledge.switches();
                switches.retain(|t| area(*t).is_some_and(|room| rooms.contains(&room)));
                switches.retain(|t| self.knowledge.can(sort, *t) && !found.contains(t));
                found.extend(switches);
            }
            return Ok(Some(found));
        }
        // «Поезжай на кухню и возьми чашку»: the one that is there.
        let room = more.gone_to.or_else(|| self.room_pointed_at(sort, phrase));
        let near = |t: &&Thing| self.knowledge.area_of(**t) == room;
        if let (Some(_), true, [only]) =
            (room, found.len() > 1, &found.iter().filter(near).copied().collect::<Vec<_>>()[..])
        {
            found = vec![*only];
        }
        if (noun.indefinite
            || one_of
            || sort == Sort::Find
            || noun.other && (self.is_one_more(&phrase.words) || !more.told.is_empty()))
            && let Some(nearest) = self.nearest(&found)
        {
            return Ok(Some(vec![nearest]));
        }
        if sort == Sort::Put && found.len() > 1 {
            // What is put down is what the robot has in its hands.
            let held = self.knowledge.senses.held();
            let in_hand = |t: &&Thing| t.replica().is_some_and(|id| held.contains(&id));
            let held: Vec<Thing> = found.iter().filter(in_hand).copied().collect();
            if held.len() == 1 {
                return Ok(Some(held));
            }
        }
        Ok(self.one(noun, &within, &found, at)?.map(|thing| vec![thing]))
    }

    /// Whether places tell a room to which something leads.
    fn is_led_to(&self, spots: &[&&Spot<'_>]) -> bool {
        spots.iter().any(|spot| {
            let rooms = self.knowledge.base(&spot.phrase.noun.head);
            spot.rel == Rel::To && !rooms.is_empty() && rooms.iter().all(|t| t.area().is_some())
        })
    }

    fn door_kinds(&self) -> Vec<KindId> {
        self.knowledge.lexicon().kind_of(&Extension::Doors).into_iter().collect()
    }

    /// What is left out must be something, and be left out of several: "all cups except the purple one" where none is
    /// purple, "Cup 1 except the blue one".
    fn excepts_something(
        &self,
        noun: &Noun,
        within: &[Restriction],
        words: &Range<usize>,
    ) -> Result<(), (Doubt, Range<usize>)> {
        let at = || self.bytes(words);
        for except in &noun.except {
            let mut out = except.clone();
            if out.head.anything {
                out.head = noun.head.clone();
            }
            let found = |noun: &Noun, within: &[Restriction]| {
                self.candidates(noun, within).map_err(|doubt| (doubt, at()))
            };
            let left_out = found(&out, &[])?;
            let all = found(&Noun { except: Vec::new(), ..noun.clone() }, within)?;
            let several = noun.plural || noun.all || noun.count.is_some();
            // "The plate, not the bowl": of another kind, and so not meant anyway.
            let base = self.knowledge.base(&noun.head);
            let other_kind = !except.head.anything && !left_out.is_empty();
            if other_kind && left_out.iter().all(|thing| !base.contains(thing)) {
                continue;
            }
            if !several && !all.iter().any(|thing| left_out.contains(thing)) {
                return Err((Doubt::not_understood(&except.text), at()));
            }
            if left_out.is_empty() {
                return Err((self.knowledge.none_such(&out), at()));
            }
            let kept = found(&Noun { except: vec![except.clone()], ..noun.clone() }, within)?;
            if kept.iter().any(|thing| left_out.contains(thing)) {
                return Err((Doubt::not_understood(&except.text), at()));
            }
        }
        Ok(())
    }

    /// "All the cups on the table but the biggest one": the biggest of those.
    fn with_excepted_best(&self, noun: &Noun, within: &[Restriction]) -> Noun {
        let mut whole = noun.clone();
        for except in whole.except.iter_mut().filter(|out| out.head.anything && out.best.is_some())
        {
            except.head = noun.head.clone();
            except.restrictions.extend(self.resting(within));
        }
        whole
    }

    /// Whether a thing is furniture to keep others in.
    pub(super) fn is_container(&self, thing: Thing) -> bool {
        thing.replica().is_some_and(|id| self.knowledge.world.has_trait(id, "container"))
    }

    /// «обе чашки», "both cups"
    fn is_both(&self, words: &Range<usize>) -> bool {
        static BOTH: Set = Set::named("Both");
        let keys = self.sentence.keys.get(words.start.saturating_sub(1)..words.end);
        keys.unwrap_or_default().iter().any(|key| BOTH.contains(&key.as_str()))
    }

    /// «4 книгу»: a singular that no number but one stands before is no count of several.
    fn is_a_number_of_one(&self, phrase: &Phrase, count: usize) -> bool {
        let ends_in_one = count % 10 == 1 && count % 100 != 11;
        let counted = |r: &Readings| {
            r.has_case(Case::Genitive) || Case::ALL.iter().any(|case| r.has(Number::Plural, *case))
        };
        self.sentence.language == Language::Russian
            && !ends_in_one
            && !phrase.cases.is_empty()
            && !phrase.cases.iter().any(counted)
    }

    /// «Закрой все двери»: a lift sees to its own, unless they alone are meant.
    fn without_lifts(&self, found: &mut Vec<Thing>) {
        let lifts = lifts(self.knowledge.world, self.knowledge.relations);
        let joins = lifts.iter().flat_map(|lift| &lift.doors);
        let own: Vec<DoorId> = joins.filter_map(|join| join.door).collect();
        let of_lift = |t: &Thing| matches!(t, Thing::Entity(Entity::Door(id)) if own.contains(id));
        if !found.iter().all(of_lift) {
            found.retain(|t| !of_lift(t));
        }
    }

    /// Whether a noun means doors.
    fn are_doors(&self, noun: &Noun) -> bool {
        let base = self.knowledge.base(&noun.head);
        let is_door = |t: &Thing| matches!(t, Thing::Entity(Entity::Door(_)));
        !base.is_empty() && base.iter().all(is_door)
    }

    /// "Either the apple or the potato": the nearest of what is named, and the words that name it; none where only one
    /// thing is.
    pub(super) fn either(
        &self,
        sort: Sort,
        objects: &[(usize, &Phrase)],
        items: &[Item],
    ) -> Result<Option<Chosen>, (Doubt, Range<usize>)> {
        // A place between them tells of the first alone, and then they are no list.
        let or = |pair: &&[(usize, &Phrase)]| {
            let between = &items[pair[0].0 + 1..pair[1].0];
            matches!(between, [Item::Mark(Mark::Or)])
        };
        let others = objects.windows(2).take_while(or).count();
        if others == 0 {
            return Ok(None);
        }
        let mut found = Vec::new();
        for (_, phrase) in &objects[..=others] {
            let mut phrase = Phrase::clone(phrase);
            phrase.noun.indefinite = true;
            let Some(things) = self.object(sort, &phrase, &[], More::default())? else {
                return Ok(None);
            };
            found.extend(things);
        }
        let words = objects[0].1.words.start..objects[others].1.words.end;
        Ok(self.nearest(&found).map(|thing| (thing, words)))
    }

    /// «Закрой дверь за собой», «закрой за собой дверь»: some words with those behind or before them.
    fn behind_oneself(&self, words: &Range<usize>) -> Option<Range<usize>> {
        let said = |at: usize| {
            set!("BehindOneself").iter().filter_map(move |p| phrase_at(&self.sentence.keys, at, p))
        };
        let behind = said(words.end).max().map(|taken| words.start..words.end + taken);
        behind.or_else(|| {
            let before = |at: &usize| said(*at).any(|taken| at + taken == words.start);
            (0..words.start).find(before).map(|at| at..words.end)
        })
    }

    /// Through what the robot comes last on its way to a room.
    fn door_come_through(&self, room: AreaId) -> Option<Thing> {
        let here = self.knowledge.area_of(Thing::Robot)?;
        let way = self.knowledge.passage(&[here], &[room])?;
        way.crossings.last().map(|crossing| crossing.by)
    }

    /// Of what was spoken of last, or before it, that to which such a thing can be done: "What about the living room? –
    /// Take the one on the table". Where nothing can, what was spoken of last, but no room is "the one" that is taken.
    fn spoken_for(&self, sort: Sort) -> Vec<Thing> {
        if !matches!(sort, Sort::Carry | Sort::Put | Sort::Switch | Sort::Door) {
            return self.spoken.clone();
        }
        let able = |things: &[Thing]| things.iter().any(|t| self.knowledge.can(sort, *t));
        let exchanges = self.knowledge.memory.exchanges.iter();
        let before = || exchanges.map(|e| e.members().to_vec()).find(|all| able(all));
        match able(&self.spoken) || self.spoken.iter().any(|t| t.area().is_none()) {
            true => self.spoken.clone(),
            false => before().unwrap_or_default(),
        }
    }

    /// Whatever is of the kind of what was spoken of last: «ещё одну», "another one".
    fn like_spoken(&self) -> Vec<Thing> {
        let world = self.knowledge.world;
        let kind = |object| world.objects.get(&object).and_then(|object| object.object_type);
        let spoken = self.spoken.iter().rev().filter_map(|t| t.replica());
        let mut kinds = spoken.filter_map(|id| kind(world.replicas.get(&id)?.object));
        let Some(wanted) = kinds.next() else { return Vec::new() };
        let alike = world.replicas.values().filter(|r| kind(r.object) == Some(wanted));
        alike.map(|r| Thing::Entity(Entity::Replica(r.id))).collect()
    }

    /// «ещё одну книгу», "another book": any that was not spoken of, where «другую» is the one that is left.
    fn is_one_more(&self, words: &Range<usize>) -> bool {
        let keys = &self.sentence.keys[words.start.saturating_sub(2)..words.end];
        keys.iter().any(|key| set!("AnotherWord").contains(&key.as_str()))
    }

    /// «одну из тарелок», "one of the plates": any of them.
    fn is_one_of(&self, words: &Range<usize>) -> bool {
        static ONE: Set = Set::named("OneOrAny");
        self.sentence.keys[words.start.saturating_sub(3)..words.end]
            .iter()
            .any(|key| ONE.contains(&key.as_str()))
    }

    /// «Возьми часы», «ключи»: that it is plural does not tell how many are meant.
    pub(super) fn has_no_singular(&self, noun: &Noun) -> bool {
        let lexicon = self.knowledge.lexicon();
        self.sentence.language == Language::Russian
            && noun.head.kinds.iter().any(|k| lexicon.kind(*k).phrase.number() == Number::Plural)
    }

    /// «с письменного стола», "from the bedroom": where something is taken, where «от» would tell whose it is.
    fn is_out_of(&self, spot: &Spot<'_>) -> bool {
        let at = self.sentence.words.iter().position(|word| word.start == spot.at.start);
        at.is_some_and(|n| set!("FromWord").contains(&&*self.sentence.keys[n]))
    }

    /// «любую книгу»: a question would ask about all of them.
    pub(super) fn is_any(&self, words: &Range<usize>) -> bool {
        static ANY: Set = Set::named("AnyOfThem");
        let said =
            |n: usize| self.sentence.keys.get(n).is_some_and(|key| ANY.contains(&key.as_str()));
        // «одну чашку», "one cup": whichever; "the one by the door" is not.
        let one = |n: usize| {
            let key = self.sentence.keys.get(n).map(String::as_str);
            matches!(key, Some("одну" | "один" | "одно" | "одного" | "one"))
        };
        let before = words.start.checked_sub(1);
        said(words.start)
            || before.is_some_and(said)
            || (words.len() > 1 && one(words.start))
            || before.is_some_and(one)
    }
}

impl Knowledge<'_> {
    /// Whether people may think that such a thing can be done to it: any door is shut, and what is no furniture is carried.
    pub(super) fn is_akin(&self, sort: Sort, thing: Thing) -> bool {
        const FURNITURE: [&str; 4] = ["support", "seat", "bed", "container"];
        let has = |id, wanted: &&str| self.world.has_trait(id, wanted);
        match (sort, thing, thing.replica()) {
            (Sort::Door, Thing::Entity(Entity::Door(_)), _) => true,
            (Sort::Carry | Sort::Put, _, Some(id)) => !FURNITURE.iter().any(|t| has(id, t)),
            _ => false,
        }
    }

    /// Whether a verb of this sort can be done to a thing at all.
    pub(in crate::question) fn can(&self, sort: Sort, thing: Thing) -> bool {
        let world = self.world;
        let has = |wanted: &str| thing.replica().is_some_and(|id| world.has_trait(id, wanted));
        match (sort, thing) {
            (Sort::Carry | Sort::Put, _) => has("portable"),
            (Sort::Switch, _) => has("device"),
            (Sort::Door, Thing::Entity(Entity::Door(door))) => {
                self.relations.joins().iter().any(|j| j.door == Some(door))
                    && world.doors.get(&door).is_some_and(|d| !d.leaves.is_empty())
            }
            (Sort::Door, _) => false,
            (Sort::Go | Sort::Find | Sort::Leave | Sort::Other, _) => true,
        }
    }
}

/// Whether a noun is a key, by its words.
fn is_key(noun: &Noun) -> bool {
    let said = crate::units::name_key(&noun.text);
    said.split(' ').any(|word| word.starts_with("ключ") || word == "key" || word == "keys")
}
