//! A sentence cut into tokens: which words are a name, a value, a property, a number, or a word of the vocabulary.

use std::ops::Range;

use super::pointing::stands_for_one;
use super::{Found, Sentence, Tok, Token};
use crate::command::without_marks;
use crate::map::Entity;
use crate::question::compared::quantity;
use crate::question::lexicon::{Extension, Lexicon, Meaning};
use crate::question::mark::{Mark, Pronoun};
use crate::question::query::{Extreme, Quantity, Rel};
use crate::question::small_words;
use crate::question::uses;
use crate::question::values::{Property, ValueId};
use crate::question::vocabulary;
use crate::sets::{Set, set};
use crate::units::name_key;
use crate::words::{Hit, Language, word_ranges};

impl<'t> Sentence<'t> {
    pub(in super::super) fn new(text: &'t str, lexicon: &Lexicon) -> Self {
        let words = word_ranges(text);
        let key = |range: &Range<usize>| name_key(&without_marks(&text[range.clone()]));
        let keys: Vec<String> = words.iter().map(key).collect();
        let mut sentence = Self {
            text,
            language: Language::of(text),
            words,
            keys,
            tokens: Vec::new(),
            nouns: Vec::new(),
            properties: Vec::new(),
            value_sorts: Vec::new(),
        };
        let mut at = 0;
        while at < sentence.keys.len() {
            at = sentence.token(at, lexicon);
        }
        sentence.heed_what_articles_precede();
        sentence.tokens.retain(|t| t.kind != Tok::Mark(Mark::Filler));
        sentence.drop_idle_but();
        sentence.tell_openings(lexicon);
        sentence.fill_elided();
        sentence.drop_asking_particle();
        sentence.fill_unsaid();
        sentence.drop_stranded();
        sentence.tell_heights();
        for token in &sentence.tokens {
            if let Tok::Value(value) = token.kind {
                let property = lexicon.values.entry(value).property.clone();
                sentence.value_sorts.push((value, property));
            }
        }
        sentence
    }

    /// "Is there a then in the kitchen?": a small word that an article makes a noun of is no small word.
    fn heed_what_articles_precede(&mut self) {
        let small = |t: &Token| t.kind == Tok::Mark(Mark::Filler);
        for n in 1..self.tokens.len() {
            let article = matches!(self.tokens[n - 1].kind, Tok::Mark(Mark::A | Mark::The));
            let next = self.tokens[n..].iter().find(|t| !small(t)).map(|t| t.kind);
            let ends = matches!(
                next,
                None | Some(Tok::Mark(
                    Mark::Link(_) | Mark::Be | Mark::Have | Mark::Can | Mark::And | Mark::Or
                ))
            );
            if article && ends && small(&self.tokens[n]) {
                self.tokens[n].kind = Tok::Unknown;
            }
        }
    }

    /// "But where is it?", «стол, но не красный»: what begins a sentence or comes before a denial bounds nothing.
    fn drop_idle_but(&mut self) {
        let but = Tok::Mark(Mark::But);
        let denies = |t: &Token| {
            matches!(t.kind, Tok::Mark(Mark::Not | Mark::Without | Mark::Avoiding | Mark::Except))
        };
        let idle = |n: usize| n == 0 || self.tokens.get(n + 1).is_none_or(denies);
        let kept: Vec<bool> =
            (0..self.tokens.len()).map(|n| self.tokens[n].kind != but || !idle(n)).collect();
        let mut kept = kept.into_iter();
        self.tokens.retain(|_| kept.next() == Some(true));
    }

    /// Reads the token at a word and gives the word after it.
    fn token(&mut self, at: usize, lexicon: &Lexicon) -> usize {
        if let Some(value) = self.switched(at, lexicon) {
            let (from, to) = (at as u32, at as u32 + 1);
            self.tokens.push(Token { from, to, kind: Tok::Value(value) });
            return at + 1;
        }
        if self.points_ahead(at) {
            let (from, to) = (at as u32, at as u32 + 1);
            self.tokens.push(Token { from, to, kind: Tok::Mark(Mark::One) });
            return at + 1;
        }
        if let Some(taken) = self.measured(at) {
            return at + taken;
        }
        if let Some(taken) = self.quantity(at) {
            return at + taken;
        }
        let keys = &self.keys[at..];
        let mark = vocabulary::longest(keys);
        // "Which is the tallest?" asks; "the book which is on the table" tells.
        let mark = match mark {
            Some((_, Mark::Filler)) if at == 0 && keys[0] == "which" => Some((1, Mark::Which)),
            // "The book that is not on the table": a denied place is told by a clause.
            Some((2, Mark::Filler | Mark::Corrects))
                if at > 0
                    && keys.get(2).is_some_and(|key| key == "not")
                    && matches!(vocabulary::longest(&keys[3..]), Some((_, Mark::Link(_)))) =>
            {
                match keys[0].as_str() {
                    "that" => Some((1, Mark::The)),
                    "which" => Some((1, Mark::Which)),
                    _ => mark,
                }
            }
            // "To the left nurse center", where a name begins so.
            Some((taken @ 2.., Mark::Best(_) | Mark::Link(_)))
                if let Some(before) =
                    (1..taken).find(|n| self.name_length(at + n, lexicon) > taken - n) =>
            {
                vocabulary::longest(&keys[..before])
            }
            // "… any idea where it is?"
            Some((2, Mark::Filler)) if at > 0 && keys == ["it", "is"] => {
                Some((1, Mark::Pronoun(Pronoun::Any)))
            }
            // "the chairs round the table", but "the round table"
            None if self.is_round_something(at) => Some((1, Mark::Link(Rel::Near))),
            mark => mark,
        };
        // "for cutting bread", but "a cutting board"
        let noun_like = keys[0].ends_with("ing") && (at == 0 || self.keys[at - 1] != "for");
        let mark = mark.filter(
            |(_, mark)| !matches!(mark, Mark::Activity(activity) if noun_like && !uses::moves(*activity)),
        );
        let value = lexicon.values.longest(keys);
        let named = self.name_length(at, lexicon);
        // «Где можно сесть?» asks for no property, though a map may call one so.
        let property = lexicon.values.property(keys).map(|(n, p)| (n, p.clone()));
        let property = property.filter(|_| mark.is_none_or(|(_, mark)| mark != Mark::Can));
        let propertied = property.as_ref().map_or(0, |(n, _)| *n);
        let marked = mark.map_or(0, |(n, _)| n);
        let valued = value.map_or(0, |(n, _)| n);
        let longest = marked.max(valued).max(named).max(propertied);
        let push = |sentence: &mut Self, taken: usize, kind: Tok| {
            let (from, to) = (at as u32, (at + taken) as u32);
            sentence.tokens.push(Token { from, to, kind });
            at + taken
        };
        if longest == 0
            && let Some(value) = self.joined_negation(at, lexicon)
        {
            push(self, 1, Tok::Mark(Mark::Not));
            return push(self, 1, Tok::Value(value));
        }
        if longest == 0 {
            let number = number_of(&keys[0]);
            let small = || match small_words::says_nothing(&keys[0]) {
                true => Tok::Mark(Mark::Filler),
                false => Tok::Unknown,
            };
            return push(self, 1, number.map_or_else(small, Tok::Number));
        }
        let before = self.tokens.last().map(|t| t.kind);
        // "the place", "any space": after an article a noun is meant; a verb or adverb otherwise.
        let article = matches!(
            before,
            Some(Tok::Mark(
                Mark::The
                    | Mark::A
                    | Mark::Which
                    | Mark::All
                    | Mark::Each
                    | Mark::Same
                    | Mark::HowMany
            ))
        );
        let noun_wins = named == longest
            && match mark {
                Some((n, Mark::PutDown | Mark::Free | Mark::See | Mark::Describe | Mark::List))
                    if n == longest =>
                {
                    article
                }
                // "the top of the desk" is its part, "the top shelf" one of several.
                Some((n, Mark::Best(extreme))) if n == longest && extreme.is_level() => {
                    !self.begins_noun(at + n, lexicon)
                }
                Some((n, Mark::Filler)) if n == longest => true,
                Some((n, _)) => n < longest,
                None => true,
            }
            && (valued < longest || !self.begins_noun(at + longest, lexicon));
        let of_what = |s: &Self| (at + named..s.keys.len()).any(|n| s.begins_noun(n, lexicon));
        if noun_wins && !(property.is_some() && named == 1 && self.asks_property() && of_what(self))
        {
            let found = self.noun(at, named, lexicon);
            self.nouns.push(found);
            let number = self.nouns.len() as u32 - 1;
            return push(self, named, Tok::Noun(number));
        }
        match (mark, value, property) {
            (Some((n, Mark::Without)), _, _) if n == longest => {
                push(self, n, Tok::Mark(Mark::Not));
                push(self, n, Tok::Mark(Mark::Link(Rel::Has)))
            }
            (Some((n, Mark::Avoiding)), _, _) if n == longest => {
                push(self, n, Tok::Mark(Mark::Not));
                push(self, n, Tok::Mark(Mark::Link(Rel::Through)))
            }
            (Some((n, Mark::Cannot)), _, _) if n == longest => {
                push(self, n, Tok::Mark(Mark::Not));
                push(self, n, Tok::Mark(Mark::Can))
            }
            (Some((n, Mark::OnlyOne)), _, _) if n == longest => {
                push(self, n, Tok::Mark(Mark::Number(Quantity::Exactly)));
                push(self, n, Tok::Number(1))
            }
            // «Что левее, стол или шкаф?» compares; «Что левее стола?» asks for a place.
            (Some((n, Mark::Link(side @ (Rel::LeftOf | Rel::RightOf)))), _, _)
                if n == longest && self.comma_between(at + n, at + n) =>
            {
                let left = side == Rel::LeftOf;
                let extreme = if left { Extreme::LeftMost } else { Extreme::RightMost };
                push(self, n, Tok::Mark(Mark::More(extreme)))
            }
            (Some((n, mark)), _, _)
                if n == longest && !(mark == Mark::Filler && valued == longest) =>
            {
                push(self, n, Tok::Mark(mark))
            }
            (_, Some((n, value)), _) if n == longest => push(self, n, Tok::Value(value)),
            (_, _, Some((n, property))) => {
                self.properties.push(property);
                let number = self.properties.len() as u32 - 1;
                push(self, n, Tok::Property(number))
            }
            _ => push(self, 1, Tok::Unknown),
        }
    }

    /// Whether "round" stands behind a noun or "is" and before an article or a pronoun, as prepositions do.
    fn is_round_something(&self, at: usize) -> bool {
        let next = self.keys.get(at + 1..).unwrap_or_default();
        let governs = matches!(
            vocabulary::longest(next),
            Some((_, Mark::The | Mark::A | Mark::Each | Mark::All | Mark::Pronoun(_)))
        );
        let behind = self.tokens.last().is_some_and(|t| {
            matches!(
                t.kind,
                Tok::Noun(_) | Tok::Unknown | Tok::Mark(Mark::Be | Mark::Exists | Mark::There)
            )
        });
        self.keys[at] == "round" && governs && behind
    }

    /// «Что висит выше всех?» asks for a place, «Какой шкаф выше всех?» for a size.
    fn tell_heights(&mut self) {
        static PLACED: Set = Set::named("PlacedStem");
        static FOUND: Set = Set::named("FoundStem");
        let placed =
            |key: &String| PLACED.iter().chain(FOUND.iter()).any(|stem| key.starts_with(stem));
        if !self.keys.iter().any(placed) {
            return;
        }
        let keys = &self.keys;
        for token in &mut self.tokens {
            if !set!("HigherOrLower").contains(&keys[token.from as usize].as_str()) {
                continue;
            }
            let raised = |extreme: Extreme| match extreme {
                Extreme::Tallest => Extreme::Topmost,
                Extreme::Lowest => Extreme::Bottommost,
                other => other,
            };
            token.kind = match token.kind {
                Tok::Mark(Mark::Best(extreme)) => Tok::Mark(Mark::Best(raised(extreme))),
                Tok::Mark(Mark::More(extreme)) => Tok::Mark(Mark::More(raised(extreme))),
                other => other,
            };
        }
    }

    /// «А на другой?», «что на второй?»: an adjective that a preposition governs and no noun follows stands for one.
    fn fill_elided(&mut self) {
        let governed = |n: usize| matches!(self.tokens[n].kind, Tok::Mark(Mark::Link(_)));
        let tells = |t: &Token| match t.kind {
            Tok::Mark(Mark::Other) => stands_for_one(&self.keys[t.to as usize - 1]),
            Tok::Mark(Mark::Rank(_)) => true,
            _ => false,
        };
        let open = |n: usize| {
            self.tokens.get(n).is_none_or(|t| {
                matches!(
                    t.kind,
                    Tok::Mark(Mark::Be | Mark::Exists | Mark::Hang | Mark::What | Mark::HowMany)
                )
            })
        };
        let at = (1..self.tokens.len())
            .rev()
            .find(|&n| governed(n - 1) && tells(&self.tokens[n]) && open(n + 1));
        // "And on the other?", but "what other chairs are there"
        let shown = |t: &Token| t.kind == Tok::Mark(Mark::Other) && t.to - t.from > 1;
        let may = |at: &usize| self.language == Language::Russian || shown(&self.tokens[*at]);
        if let Some(at) = at.filter(may) {
            let one = Token { kind: Tok::Mark(Mark::One), ..self.tokens[at] };
            self.tokens.insert(at + 1, one);
        }
    }

    /// «Во всех ли комнатах …»: within a noun phrase «ли» only asks, as it does behind a verb.
    fn drop_asking_particle(&mut self) {
        let within = (1..self.tokens.len()).find(|&n| {
            let (before, token) = (self.tokens[n - 1].kind, self.tokens[n]);
            let next = self.tokens.get(n + 1).map(|t| t.kind);
            self.keys[token.from as usize] == "ли"
                && matches!(before, Tok::Mark(Mark::All | Mark::Each | Mark::Link(_) | Mark::Same))
                && matches!(next, Some(Tok::Noun(_) | Tok::Value(_)))
                && n >= 2
                && matches!(self.tokens[n - 2].kind, Tok::Mark(Mark::Link(_)))
        });
        if let Some(n) = within {
            self.tokens.remove(n);
        }
    }

    /// "Got a pen or a pencil around?": who is asked to have something is not named, nor around what it may be.
    fn fill_unsaid(&mut self) {
        let said = |key: &str, t: &Token| t.to - t.from == 1 && self.keys[t.from as usize] == key;
        let small = |t: &Token| t.kind == Tok::Mark(Mark::Filler);
        let got = |t: &Token| t.kind == Tok::Mark(Mark::Have) && said("got", t);
        // "I need to write something down, got a pen?"
        let begins = |&n: &usize| {
            let word = self.tokens[n].from as usize;
            self.tokens[..n].iter().all(small) || self.comma_between(word, word)
        };
        let first = (0..self.tokens.len()).filter(|&n| got(&self.tokens[n])).find(begins);
        let idle = self.tokens.last().is_some_and(|t| {
            said("around", t) && self.tokens.len() > 1 && matches!(t.kind, Tok::Mark(Mark::Link(_)))
        });
        // "What has the kitchen got?"
        let has = |t: &Token| t.kind == Tok::Mark(Mark::Have);
        let twice = self.tokens.iter().filter(|t| has(t)).count() > 1
            && self.tokens.last().is_some_and(|t| has(t) && said("got", t));
        if twice {
            self.tokens.pop();
        }
        if let Some(first) = first {
            self.tokens[first].kind = Tok::Mark(Mark::Exists);
        }
        if idle && self.tokens.iter().any(|t| t.kind == Tok::Mark(Mark::Exists)) {
            self.tokens.pop();
        }
    }

    /// "something to cut an apple with": a preposition of an activity whose noun is what is asked for.
    fn drop_stranded(&mut self) {
        let activity = |t: &Token| matches!(t.kind, Tok::Mark(Mark::Activity(_)));
        let Some(first) = self.tokens.iter().position(activity) else { return };
        let link = |t: &Token| matches!(t.kind, Tok::Mark(Mark::Link(_)));
        let stranded: Vec<usize> = (0..self.tokens.len())
            .filter(|n| link(&self.tokens[*n]))
            .filter(|n| {
                let next = self.tokens.get(n + 1);
                // "for cutting bread"
                let before_activity = next.is_some_and(activity);
                before_activity || (*n > first && next.is_none_or(link))
            })
            .collect();
        for n in stranded.into_iter().rev() {
            self.tokens.remove(n);
        }
    }

    /// «нечёрные»: the value that is denied.
    fn joined_negation(&self, at: usize, lexicon: &Lexicon) -> Option<ValueId> {
        let rest =
            self.keys[at].strip_prefix("не").or_else(|| self.keys[at].strip_prefix("non"))?;
        lexicon.values.meaning(rest)
    }

    /// "at least four": how a number is meant, and the number. Gives the words that they take.
    fn quantity(&mut self, at: usize) -> Option<usize> {
        let (taken, quantity) = quantity(&self.keys[at..])?;
        let number = match self.keys.get(at + taken)?.as_str() {
            "один" | "одна" | "одно" | "одного" | "одной" | "одну" | "one" => {
                1
            }
            key => number_of(key)?,
        };
        // «Комната больше 3» counts nothing: several things follow, or stand before («стульев больше трёх»).
        let counts = |t: &Token| {
            matches!(t.kind, Tok::Noun(n) if {
                let found = &self.nouns[n as usize];
                !found.is_area && found.readings.iter().all(|r| !r.is_singular())
            })
        };
        if self.keys.len() <= at + taken + 1 && !self.tokens.iter().any(counts) {
            return None;
        }
        let (from, cut, to) = (at as u32, (at + taken) as u32, (at + taken + 1) as u32);
        self.tokens.push(Token { from, to: cut, kind: Tok::Mark(Mark::Number(quantity)) });
        self.tokens.push(Token { from: cut, to, kind: Tok::Number(number) });
        Some(taken + 1)
    }

    /// "Is the lamp on?", "on or off": a state, where nothing follows to be on.
    fn switched(&self, at: usize, lexicon: &Lexicon) -> Option<ValueId> {
        let word = match self.keys[at].as_str() {
            "on" => "switched on",
            "off" => "switched off",
            _ => return None,
        };
        let next = self.keys.get(at + 1).map(String::as_str);
        // "something to sit on"
        let before = self.tokens.last().map(|t| t.kind);
        let used = matches!(before, Some(Tok::Mark(Mark::Sit | Mark::LieDown | Mark::PutDown)))
            || self.tokens.iter().any(|t| matches!(t.kind, Tok::Mark(Mark::Activity(_))));
        let joint = matches!(next, Some("or" | "and"));
        let clause_ends = self.comma_between(at + 1, at + 1);
        let ends = !used && (joint || clause_ends || self.ends_in_small_words(at + 1));
        let said = |word: &str| self.keys[..at].iter().any(|k| k == word);
        let is_noun = |t: &&Token| matches!(t.kind, Tok::Noun(_) | Tok::Mark(Mark::Pronoun(_)));
        let nouns = self.tokens.iter().filter(is_noun).count();
        // "Which lamps are on?", but "What is the lamp on?" and "Which table is the lamp on?"
        // "Which floor am I on?"
        let person = set!("PersonWord").iter().any(|word| said(word));
        let link =
            self.keys[at] == "on" && (said("what") || (said("which") && (nouns != 1 || person)));
        // "Is the light on in the kitchen?": a second preposition after it.
        let placed = matches!(next, Some("in" | "at" | "inside"))
            && nouns == 1
            && !said("what")
            && self.keys[..at].iter().any(|k| set!("IsOrWas").contains(&k.as_str()));
        ((ends && !link) || placed).then(|| lexicon.values.meaning(word)).flatten()
    }

    /// Whether nothing but small words follows: "on then", "on at the moment, please".
    fn ends_in_small_words(&self, from: usize) -> bool {
        let mut at = from;
        while let Some(rest) = self.keys.get(at..).filter(|rest| !rest.is_empty()) {
            at += match vocabulary::longest(rest) {
                Some((taken, Mark::Filler)) => taken,
                None if small_words::says_nothing(&rest[0]) => 1,
                _ => return false,
            };
        }
        true
    }

    /// How many words the longest name takes. No name goes over a comma, and «комнат в которых» is not Комната-В; none begins
    /// behind an apostrophe: in "I'm" nothing called "m" is meant.
    fn name_length(&self, at: usize, lexicon: &Lexicon) -> usize {
        let gap = |n: usize| &self.text[self.words[n - 1].end..self.words[n].start];
        if at > 0 && matches!(gap(at), "'" | "’") {
            return 0;
        }
        let cut = |n: &usize| gap(*n).contains([',', ';', ':', '?', '!']);
        let mut end = (at + 1..self.words.len()).find(cut).unwrap_or(self.words.len());
        loop {
            let taken = lexicon.nouns.length_at(self.text, &self.words[..end], at);
            let last = (at + taken).saturating_sub(1);
            let small = taken > 1
                && ["в", "к", "с", "о", "у", "a", "и"]
                    .contains(&&self.text[self.words[last].clone()])
                && gap(last) == " "
                && last + 1 < self.words.len();
            // "Where does the TV stand?" asks with a verb that names take too.
            let after = |n: usize| at >= n && set!("Do").contains(&self.keys[at - n].as_str());
            let asks = |key: &String| set!("AskingWord").contains(&key.as_str());
            let verb = taken > 1
                && at + taken == self.words.len()
                && set!("LieOrStand").contains(&self.keys[last].as_str())
                && (after(1) || after(2))
                && self.keys[..at].iter().any(asks);
            // «На каком ковре 2 скамьи?»: the number counts what follows it, and of Rug 2 nobody asks which it is.
            let counts = taken > 1
                && self.asks_property()
                && gap(last) == " "
                && self.keys[last].chars().all(char::is_numeric)
                && last + 1 < end
                && lexicon.nouns.length_at(self.text, &self.words[..end], last + 1) > 0;
            if !(small || verb || counts) {
                return taken;
            }
            end = last;
        }
    }

    fn begins_noun(&self, at: usize, lexicon: &Lexicon) -> bool {
        at < self.keys.len() && self.name_length(at, lexicon) > 0
    }

    fn asks_property(&self) -> bool {
        let asks = |t: &Token| matches!(t.kind, Tok::Mark(Mark::What | Mark::Which));
        self.tokens.last().is_some_and(asks)
    }

    fn noun(&self, at: usize, taken: usize, lexicon: &Lexicon) -> Found {
        let hits = lexicon.nouns.find(self.said(&(at..at + taken)));
        let mut found = Found::default();
        let is_kind = hits.iter().any(|h| matches!(h.id, Meaning::Kind(_)));
        // «стол» may be a part of many names; then the kind is meant.
        let numbered = self.is_numbered(at, taken, lexicon);
        for hit in &hits {
            if let Meaning::Kind(kind) = hit.id {
                // "on the floor" is not "on the second floor".
                let skipped = match lexicon.kind(*kind).extension {
                    Extension::Storeys => !numbered && self.keys[at].starts_with("floor"),
                    Extension::Floor => numbered && self.keys[at].starts_with("floor"),
                    _ => false,
                };
                if skipped {
                    continue;
                }
            }
            match hit.id {
                Meaning::Entity(entity) => {
                    found.is_area |= matches!(entity, Entity::Area(_) | Entity::Map(_));
                    if !found.named.contains(entity) {
                        found.named.push(*entity);
                    }
                }
                Meaning::Kind(kind) => {
                    for kind in lexicon.with_narrower(*kind, self.language) {
                        found.is_area |= lexicon.is_area(kind);
                        let extension = lexicon.kind(kind).extension;
                        found.is_storey |= extension == Extension::Storeys;
                        found.is_thing |= extension == Extension::Things;
                        found.is_doors |= extension == Extension::Doors;
                        found.is_general |= matches!(
                            extension,
                            Extension::Storeys
                                | Extension::Rooms
                                | Extension::Places
                                | Extension::Doors
                                | Extension::Things
                        );
                        if !found.kinds.contains(&kind) {
                            found.kinds.push(kind);
                        }
                    }
                }
            }
            found.readings.push(hit.readings);
        }
        if is_kind && hits.iter().all(|h| h.spelling == crate::Spelling::Part) {
            found.named.clear();
        }
        found
    }

    /// Whether a sentence tells or asks what something is like to look at: "Are the floors of both rooms wooden?"
    fn tells_finish(&self, lexicon: &Lexicon) -> bool {
        let looks = |property: &Property| {
            matches!(property, Property::Colour | Property::Material | Property::Surface)
        };
        let value = |words: &[String]| {
            let value = lexicon.values.longest(words);
            value.is_some_and(|(_, value)| looks(&lexicon.values.entry(value).property))
        };
        let property = |words: &[String]| {
            lexicon.values.property(words).is_some_and(|(_, property)| looks(property))
        };
        (0..self.keys.len()).any(|n| value(&self.keys[n..]) || property(&self.keys[n..]))
            || self.keys.windows(2).any(|two| two == ["made", "of"])
    }

    /// Whether a sentence asks for rooms: «в какой комнате».
    pub(in super::super) fn asks_of_rooms(&self, lexicon: &Lexicon) -> bool {
        let rooms = |n: u32| {
            let kinds = &self.nouns[n as usize].kinds;
            kinds.iter().any(|kind| lexicon.kind(*kind).extension == Extension::Rooms)
        };
        self.tokens.windows(2).any(|pair| {
            let asks = matches!(pair[0].kind, Tok::Mark(Mark::Which | Mark::What | Mark::HowMany));
            asks && matches!(pair[1].kind, Tok::Noun(n) if rooms(n))
        })
    }

    /// «Где их больше всего?»: in which room.
    pub(in super::super) fn asks_where_most(&self) -> bool {
        let has = |mark: &dyn Fn(Mark) -> bool| {
            self.tokens.iter().any(|t| matches!(t.kind, Tok::Mark(own) if mark(own)))
        };
        let most = |mark| {
            let Mark::Best(extreme) = mark else { return false };
            matches!(
                extreme,
                Extreme::Most | Extreme::Fewest | Extreme::Biggest | Extreme::Smallest
            )
        };
        has(&|mark| mark == Mark::Where) && has(&most)
    }

    /// Whether a floor is one of several in a house: "the second floor", "floors", "which floor", "floor 2", "floor L1".
    fn is_numbered(&self, at: usize, taken: usize, lexicon: &Lexicon) -> bool {
        let before = self.tokens.iter().rev().find(|t| t.kind != Tok::Mark(Mark::Filler));
        let told = matches!(
            before.map(|t| t.kind),
            Some(
                Tok::Number(_)
                    | Tok::Mark(
                        Mark::Rank(_)
                            | Mark::Which
                            | Mark::What
                            | Mark::HowMany
                            | Mark::All
                            | Mark::Each
                            | Mark::Same
                            | Mark::Best(_)
                    )
            )
        );
        let next = self.keys.get(at + taken).and_then(|key| number_of(key)).is_some()
            || self.keys.get(at + taken).is_some_and(|key| {
                let storey =
                    |hit: &Hit<'_, Meaning>| matches!(hit.id, Meaning::Entity(Entity::Map(_)));
                lexicon.nouns.find(key).iter().any(storey)
            });
        // "Floors" are storeys, but "the wooden floors" are trodden.
        told || next || self.keys[at] == "floors" && !self.tells_finish(lexicon)
    }
}

/// Digits and the small number words of both languages.
pub(in super::super) fn number_of(key: &str) -> Option<u64> {
    static WORDS: Set = Set::named("NumberWord");
    let number = WORDS.meant().iter().find(|(word, _)| *word == key);
    number.map_or(key, |(_, digits)| digits).parse().ok()
}
