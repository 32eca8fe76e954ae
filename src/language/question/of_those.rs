//! Of those that were told: how many they are, which is the biggest or the third, which of two counts is more.
//!
//! Invariant: of all that there is nothing is asked here; where nothing was told there is no such question.

use super::grammar::{Item, Phrase, Sentence};
use super::mark::{Mark, Pronoun};
use super::query::{Best, Extreme, Head, Restriction};
use super::{Asker, Memory, Noun, Query, Rel, Thing, memory, vocabulary};
use crate::sets::set;
use crate::words::{Gender, Language, word_keys};

impl Asker<'_> {
    /// "Which one is bigger?", «Какой из них тяжелее?»: of the several things that the last answer told, or of those that
    /// its question named, where only they agree («В каких комнатах есть телевизор? Какой из них больше?»).
    pub(super) fn more_of_those(&self, text: &str, memory: &Memory) -> Option<Query> {
        let text = self.plain(text);
        let sentence = Sentence::new(&text, &self.mind.lexicon);
        let items = sentence.items();
        // "Which is" is one small word, as in "the book which is on the table".
        let mut which = sentence.keys.first().is_some_and(|key| key == "which");
        let (mut extreme, mut of) = (None, None);
        for item in &items {
            match item {
                // "Which of the two is taller?"
                Item::Number(n @ 2..) if of.is_none() => of = usize::try_from(*n).ok(),
                Item::Mark(Mark::More(by) | Mark::Best(by)) if extreme.is_none() => {
                    extreme = Some(*by);
                }
                Item::Mark(Mark::Which) => which = true,
                Item::Mark(Mark::What | Mark::Be | Mark::The | Mark::One | Mark::And) => {}
                Item::Link(Rel::From | Rel::Of) => {}
                Item::Noun(phrase) if phrase.noun.head.anything => {
                    extreme = extreme.or(phrase.noun.best.as_ref().map(|best| best.extreme));
                }
                Item::Noun(phrase) if phrase.pronoun == Some(Pronoun::They) => {}
                Item::Place { rel: Rel::From | Rel::Of, nouns, .. } if matches!(&nouns[..], [p] if p.pronoun == Some(Pronoun::They)) =>
                    {}
                _ => return None,
            }
        }
        // Of how many there are nothing is told by what was told.
        let many = |extreme: &Extreme| matches!(extreme, Extreme::Most | Extreme::Fewest);
        let extreme = extreme.filter(|extreme| which && !many(extreme))?;
        let knowledge = self.knowledge(sentence.language, memory);
        let gender = sentence.keys.iter().find_map(|key| match key.as_str() {
            "какой" | "который" => Some(Gender::Masculine),
            "какая" | "которая" => Some(Gender::Feminine),
            "какое" | "которое" => Some(Gender::Neuter),
            _ => None,
        });
        let agree = |things: &[Thing]| {
            let fits = |t: &Thing| gender.is_none_or(|gender| knowledge.gender(*t).0 == gender);
            things.len() > 1 && things.iter().any(fits)
        };
        let mut named = vec![memory.last.clone()];
        // "What are they on? – The table and the shelf. – Which of these is the biggest?": these are what it was asked of.
        if let Some(things) = knowledge.asked_whereabouts() {
            let shown = (0..sentence.keys.len())
                .any(|n| vocabulary::taken_by(Mark::These, &sentence.keys[n..]).is_some());
            if !shown && agree(things) && agree(&memory.last) {
                return None;
            }
            named.insert(0, things.to_vec());
        }
        // "Is the bed bigger than the sofa? Which is bigger?"
        named.extend(memory.exchanges.first().map(|exchange| exchange.compared().to_vec()));
        if of.is_some() {
            named.extend(knowledge.last_pair());
            named.extend(knowledge.last_places());
            named.push(knowledge.measured_before());
        }
        memory.query.clone()?.each_noun(&mut |noun| {
            named.extend(knowledge.find(noun, true).ok());
        });
        // "Are there any lamps? – No. – Which of them is biggest?": of none, none is.
        let none =
            memory.last.is_empty() && memory.query.as_ref().is_some_and(|q| q.sought().is_some());
        if !none {
            named.extend(self.alike_spoken_of(memory));
        }
        if let Some(of) = of {
            named.retain(|things| things.len() == of);
        }
        let things = named.into_iter().find(|things| agree(things))?;
        let best = Some(Best { extreme, anchor: None });
        Some(Query::Find(Noun { best, indefinite: true, ..Noun::of(things) }))
    }

    /// Several things of one kind that the last exchanges named, each by itself.
    fn alike_spoken_of(&self, memory: &Memory) -> Option<Vec<Thing>> {
        let knowledge = self.knowledge(memory.language, memory);
        let mut spoken: Vec<Thing> = Vec::new();
        for thing in memory.exchanges.iter().flat_map(memory::Exchange::things) {
            if !spoken.contains(thing) {
                spoken.push(*thing);
            }
        }
        spoken.iter().find_map(|first| {
            let kind = knowledge.kind_of(*first)?;
            let alike = spoken.iter().filter(|t| knowledge.kind_of(**t) == Some(kind)).copied();
            let alike: Vec<Thing> = alike.collect();
            // «Сколько там столов? – Один. – Какой из них больше?»: chairs that were told before are none of them.
            let of_last = memory.last.iter().all(|last| alike.contains(last));
            (alike.len() > 1 && of_last).then_some(alike)
        })
    }

    /// "How many things is that?", «Сколько это?»: of those that were told.
    pub(super) fn how_many_told(&self, text: &str, memory: &Memory) -> Option<Query> {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let (mut counts, mut bare) = (false, !sentence.points());
        for item in sentence.items() {
            match item {
                Item::Mark(Mark::HowMany) => counts = true,
                Item::Mark(Mark::Be | Mark::The | Mark::And | Mark::Filler) => {}
                Item::Mark(Mark::Exists) if bare => {}
                Item::Noun(phrase) if self.is_bare_thing(&phrase.noun) => bare = false,
                _ => return None,
            }
        }
        let told = &memory.last;
        // "Which room has the most lamps? – The kitchen. – How many?": lamps there.
        if let (true, true, Some(Query::Find(noun)), &[room]) =
            (counts, bare, &memory.query, &told[..])
            && let Some(Best { extreme: Extreme::Most | Extreme::Fewest, anchor: Some(had) }) =
                &noun.best
            && room.area().is_some()
        {
            let anchors = vec![Noun::of(vec![room])];
            let place = Restriction { rel: Rel::In, anchors, negated: false };
            return Some(Query::Count(Noun {
                restrictions: vec![place],
                plural: true,
                ..(**had).clone()
            }));
        }
        // "Is there a mug in the kitchen? – Yes. – How many are there?": of the kind, where it was asked for.
        if let (true, true, Some(Query::Exists { what, .. })) = (counts, bare, &memory.query)
            && let [noun] = &what[..]
            && !noun.head.anything
            && noun.best.is_none()
        {
            let noun = Noun { indefinite: false, count: None, plural: true, ..noun.clone() };
            return Some(Query::Count(noun));
        }
        // "Which of them has chairs? How many?": rooms or chairs, nothing says.
        let alike = || self.knowledge(sentence.language, memory).alike(told).is_some();
        (counts && (sentence.points() || bare && alike()) && told.len() > 1)
            .then(|| Query::Count(Noun { plural: true, ..Noun::of(told.clone()) }))
    }

    /// «Сколько стульев на кухне? А в гостиной? Где больше?»: of the two that were counted.
    pub(super) fn more_of_counted(&self, text: &str, memory: &Memory) -> Option<Query> {
        let [later, earlier] = &memory.counted[..] else { return None };
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        // "Which are" is one small word, as in "the plates which are on the table".
        let mut asks = sentence.keys.first().is_some_and(|key| key == "which");
        let (mut extreme, mut one) = (None, false);
        for item in sentence.items() {
            match item {
                Item::Mark(Mark::More(of) | Mark::Best(of)) if extreme.is_none() => {
                    extreme = Some(of);
                }
                Item::Mark(Mark::Which) => (asks, one) = (true, true),
                Item::Mark(Mark::Where | Mark::What) => asks = true,
                Item::Mark(Mark::Be | Mark::The | Mark::And | Mark::Have | Mark::Exists) => {}
                Item::Link(Rel::In | Rel::On) => one = false,
                Item::Noun(phrase) if phrase.pronoun == Some(Pronoun::They) => {}
                Item::Noun(phrase)
                    if self.is_room(&phrase.noun) && phrase.noun.head.named.is_empty() =>
                {
                    one = false;
                }
                _ => return None,
            }
        }
        // «Какое больше?» asks of one of them, and not how many there are.
        let counts = asks && !(one && sentence.language == Language::Russian);
        let extreme = match extreme.filter(|_| counts)? {
            Extreme::Biggest | Extreme::Most => Extreme::Most,
            Extreme::Smallest | Extreme::Fewest => Extreme::Fewest,
            _ => return None,
        };
        let of = [earlier.clone(), later.clone()];
        Some(Query::MoreOf { of, extreme, asks: true, by: false })
    }

    /// «Сколько стульев на кухне? Их больше, чем в гостиной?», "Are there fewer in the hall?": there, and where they were asked
    /// after. "Are there more in the hall?" may ask for others, and is not understood.
    pub(super) fn more_than_there(&self, text: &str, memory: &Memory) -> Option<Query> {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let (mut extreme, mut than, mut meant) = (None, false, sentence.points());
        let (mut own, mut other) = (None, None);
        let place = |nouns: &[Phrase], rel: Rel| match nouns {
            [only] if only.pronoun.is_none() && only.person.is_none() => {
                let anchors = vec![only.noun.clone()];
                Some(Restriction { rel, anchors, negated: false })
            }
            _ => None,
        };
        let they = |phrase: &Phrase| phrase.pronoun == Some(Pronoun::They);
        for item in sentence.items() {
            match item {
                Item::Mark(Mark::More(of)) if extreme.is_none() => extreme = Some(of),
                // «больше, чем» has the word of «под чем».
                Item::Mark(Mark::Than | Mark::What) if extreme.is_some() && !than => than = true,
                Item::Mark(Mark::Be | Mark::The | Mark::And | Mark::Exists | Mark::Have) => {}
                Item::Noun(phrase) if they(&phrase) => meant = true,
                Item::Noun(phrase) if phrase.person == Some(Mark::There) => meant = true,
                Item::Place { rel: Rel::From | Rel::Of, nouns, .. } if nouns.iter().all(they) => {
                    meant = true;
                }
                Item::Place { rel: rel @ (Rel::In | Rel::On), nouns, either: false } => {
                    let told = if than { &mut other } else { &mut own };
                    if told.is_some() {
                        return None;
                    }
                    *told = Some(place(&nouns, rel)?);
                }
                _ => return None,
            }
        }
        let extreme = match extreme? {
            Extreme::Biggest | Extreme::Most => Extreme::Most,
            Extreme::Smallest | Extreme::Fewest => Extreme::Fewest,
            _ => return None,
        };
        // More than there may be any more there.
        let compares = than || sentence.language == Language::Russian || extreme == Extreme::Fewest;
        let (Query::Count(before) | Query::Find(before)) = memory.query.as_ref()? else {
            return None;
        };
        let [there] = &before.restrictions[..] else { return None };
        let placed = matches!(there.rel, Rel::In | Rel::On) && !there.negated;
        if !compares || !placed || before.head.kinds.is_empty() || before.best.is_some() {
            return None;
        }
        let at = |place: Restriction| {
            let restrictions = vec![place];
            Noun { restrictions, plural: true, indefinite: true, ..before.clone() }
        };
        let of = match (than, own, other) {
            (true, own, Some(other)) if meant || own.is_none() => {
                [at(own.unwrap_or_else(|| there.clone())), at(other)]
            }
            (false, Some(own), None) if own.anchors != there.anchors => {
                [at(own), at(there.clone())]
            }
            _ => return None,
        };
        Some(Query::MoreOf { of, extreme, asks: false, by: false })
    }

    /// «Где ближайший стул? А в гостиной их сколько?»: of the kind of the one thing that was told, there.
    pub(super) fn count_of_kind(&self, sentence: &Sentence<'_>, memory: &Memory) -> Option<Query> {
        let they = |phrase: &Phrase| phrase.pronoun == Some(Pronoun::They);
        let (mut counts, mut meant, mut restrictions) = (false, false, Vec::new());
        for item in sentence.items() {
            match item {
                Item::Mark(Mark::HowMany) => counts = true,
                Item::Mark(Mark::And | Mark::Be | Mark::Exists | Mark::Hang) => {}
                Item::Noun(phrase) if they(&phrase) => meant = true,
                Item::Place { rel: Rel::From | Rel::Of, nouns, .. } if nouns.iter().all(they) => {
                    meant = true;
                }
                Item::Place { rel, nouns, .. }
                    if nouns.iter().all(|p| p.pronoun.is_none() && p.person.is_none()) =>
                {
                    let anchors = nouns.into_iter().map(|phrase| phrase.noun).collect();
                    restrictions.push(Restriction { rel, anchors, negated: false });
                }
                _ => return None,
            }
        }
        let [only] = memory.last[..] else { return None };
        let knowledge = self.knowledge(sentence.language, memory);
        // The whole house is no place of its own.
        let part = |anchor: &Noun| {
            let base = knowledge.base(&anchor.head);
            !base.is_empty() && base.iter().all(|t| t.area().is_some() || t.replica().is_some())
        };
        let parts = restrictions.iter().flat_map(|place: &Restriction| &place.anchors).all(part);
        let asks = counts && meant && parts && !restrictions.is_empty();
        let kind = knowledge.kind_of(only).filter(|_| asks)?;
        // "How many pictures are there? Where is the sofa? How many of them are in the hall?": of those that were several.
        let several = memory.exchanges.iter().skip(1).map(memory::Exchange::members);
        let mut several = several.filter(|all| all.len() > 1 && !all.contains(&only));
        let head = match several.next() {
            Some(all) => Head { things: Some(all.to_vec()), ..Head::default() },
            None => Head { kinds: vec![kind], ..Head::default() },
        };
        Some(Query::Count(Noun { head, restrictions, plural: true, ..Noun::default() }))
    }

    /// "Things" and no more.
    pub(super) fn is_bare_thing(&self, noun: &Noun) -> bool {
        let plain = noun.filters.is_empty() && noun.restrictions.is_empty() && noun.best.is_none();
        plain && self.knowledge(Language::English, &Memory::default()).is_anything(&noun.head)
    }

    /// «Где третья?», "And the third one?": of those that were listed, in their order.
    pub(super) fn counted_of_listed(&self, text: &str, memory: &Memory) -> Option<Query> {
        let text = self.plain(text);
        let sentence = Sentence::new(&text, &self.mind.lexicon);
        let (mut rank, mut asks_where) = (None, false);
        for n in 0..sentence.keys.len() {
            if rank.is_none() && set!("LastOfList").contains(&sentence.keys[n].as_str()) {
                rank = Some(memory.listed.len() as u64);
                continue;
            }
            match vocabulary::longest(&sentence.keys[n..]) {
                Some((_, Mark::Rank(told))) if rank.is_none() => rank = Some(told),
                Some((_, Mark::Where)) => asks_where = true,
                Some((_, Mark::The | Mark::One | Mark::Be | Mark::And | Mark::What)) => {}
                _ if set!("AboutThose").contains(&sentence.keys[n].as_str()) => {}
                _ => return None,
            }
        }
        let at = usize::try_from(rank?).ok()?.checked_sub(1)?;
        // "How many of the three are on the bed? – Two. – Where is the third?"
        let knowledge = self.knowledge(sentence.language, memory);
        let wider = || knowledge.list_with(&memory.listed)?.get(at).copied();
        let meant = match memory.numbered(at)[..] {
            [only] => only,
            [] => wider()?,
            _ => return None,
        };
        let noun = Noun::of(vec![meant]);
        let lists = |query: &Query| {
            query.sought().is_some() || matches!(query, Query::Where(_) | Query::Several(_))
        };
        Some(match &memory.query {
            Some(query) if !asks_where && !lists(query) => query.clone().of_another(&noun),
            None if !asks_where => return None,
            _ => Query::Where(noun),
        })
    }

    /// «Какая самая маленькая?», "Which is the biggest?", "Which are open?": a superlative or a value, and no noun.
    pub(super) fn asks_of_those(&self, text: &str) -> bool {
        let text = self.plain(text);
        // "Which is" alone is a small word, as in "the book which is on the table".
        let which = word_keys(&text).first().is_some_and(|word| word == "which");
        let items = Sentence::new(&text, &self.mind.lexicon).items();
        let small = |item: &Item| match item {
            Item::Mark(mark) => matches!(
                mark,
                Mark::Which | Mark::What | Mark::Be | Mark::The | Mark::Best(_) | Mark::One
            ),
            Item::Noun(phrase) => {
                phrase.noun.head.anything && (which || phrase.noun.best.is_some())
            }
            Item::Value(_) => true,
            // "which one is in the kitchen?"
            Item::Place { .. } => which,
            _ => false,
        };
        let asks = matches!(items.first(), Some(Item::Mark(Mark::Which)));
        let least = if asks { 2 } else { 1 };
        (asks || which) && items.len() >= least && items.iter().all(small)
    }
}

/// Whether it is asked of one of several, whichever: "is one of them in the hall", «стоит ли одна из них в зале».
pub(super) fn asks_of_one(items: &[Item]) -> bool {
    items.windows(2).any(|two| match two {
        [Item::Mark(Mark::A), Item::Noun(phrase)] => phrase.pronoun == Some(Pronoun::They),
        _ => false,
    })
}

/// Whether one of several is asked for by what it is most: "which of them is the nearest", «какая из них ближе».
pub(super) fn chooses(items: &[Item]) -> bool {
    let which = items.contains(&Item::Mark(Mark::Which));
    which
        && items.iter().any(|item| match item {
            Item::Mark(Mark::More(_) | Mark::Best(_) | Mark::BestTo(_) | Mark::Nearer(_)) => true,
            Item::Noun(phrase) => phrase.noun.best.is_some(),
            _ => false,
        })
}
