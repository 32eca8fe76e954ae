//! Asking of the rest: whether what was told is all there is, and whether there is more of it elsewhere.

use super::grammar::Sentence;
use super::lexicon::Extension;
use super::query::Denial;
use super::{Asker, Head, Memory, Noun, Query, Rel, Thing};
use crate::sets::Set;
use crate::words::word_keys;

/// «Это все?», which a noun may follow.
static ALL: Set = Set::named("IsThatAll");

static ELSEWHERE: Set = Set::named("Elsewhere");

/// «Сколько ещё?»: how many besides those that were told.
static MORE: Set = Set::named("HowManyMore");

impl Asker<'_> {
    /// «И это все ложки на кухне?», "Are there any more of those elsewhere?": of the kind that was told, what is left.
    pub(super) fn of_the_rest(&self, text: &str, memory: &Memory) -> Option<Query> {
        let words = word_keys(text);
        let key = words.join(" ");
        let starts = |start: &&&str| key == **start || key.starts_with(&format!("{start} "));
        let told = &memory.last;
        if let Some(start) = ALL.iter().find(starts) {
            let named = key[start.len()..].trim();
            // "Are they all eggs?" asks what they are, "Are they all the eggs?" whether there are more.
            if start.starts_with("are ") && !named.is_empty() && !named.starts_with("the ") {
                return None;
            }
            let noun = match named.is_empty() {
                true => self.as_asked(memory)?,
                false => self.described(named, memory)?,
            };
            let what = vec![but(noun, told)];
            return Some(Query::Exists { what, either: false, denial: Denial::Taken });
        }
        if MORE.contains(&key.as_str()) {
            return Some(Query::Count(self.left_of_kind(memory)?));
        }
        // What names something itself is a question of its own.
        let asks = ELSEWHERE.iter().find(|place| key.contains(**place))?;
        let rest = key.replace(asks, " ");
        static SMALL: Set = Set::named("AroundMore");
        if rest.split_whitespace().any(|word| !SMALL.contains(&word)) {
            return None;
        }
        let what = vec![self.left_of_kind(memory)?];
        Some(Query::Exists { what, either: false, denial: Denial::None })
    }

    /// What there is of the kind of what was told last, besides that.
    fn left_of_kind(&self, memory: &Memory) -> Option<Noun> {
        let knowledge = self.knowledge(memory.language, memory);
        let is_door = |thing: &Thing| knowledge.base(&self.doors()).contains(thing);
        let head = match memory.last.iter().all(is_door) {
            true => self.doors(),
            false => {
                let told = memory.last.iter().copied().filter(|t| t.replica().is_some());
                let kind = knowledge.alike(&told.collect::<Vec<_>>())?;
                Head { kinds: vec![kind], ..Head::default() }
            }
        };
        let noun = Noun { head, ..Noun::default() };
        Some(but(noun, &memory.last))
    }

    /// Any door, of whatever make.
    fn doors(&self) -> Head {
        Head::of_kind(&self.mind.lexicon, &Extension::Doors)
    }

    /// "Where are the others?" of several that were told, where there are others; after "how many of them …?" of those.
    pub(super) fn rest_of_kind(&self, memory: &Memory) -> Option<Noun> {
        if memory.pending.is_some() {
            return None;
        }
        if memory.query.as_ref().and_then(Query::sought).is_some_and(asks_of_told)
            && let Some(rest) = self.knowledge(memory.language, memory).rest_of_list(&memory.last)
        {
            return Some(Noun { plural: true, ..Noun::of(rest) });
        }
        let rest = self.left_of_kind(memory).filter(|_| memory.last.len() > 1)?;
        let left = self.knowledge(memory.language, memory).find(&rest, true).ok()?;
        (!left.is_empty()).then_some(rest)
    }

    /// What the last question sought, in its own words.
    fn as_asked(&self, memory: &Memory) -> Option<Noun> {
        let sought = memory.query.as_ref()?.sought().filter(|noun| !noun.head.anything)?;
        Some(sought.clone())
    }

    fn described(&self, text: &str, memory: &Memory) -> Option<Noun> {
        let text = self.plain(text);
        self.fragment(&Sentence::new(&text, &self.mind.lexicon), memory)
    }
}

fn but(noun: Noun, told: &[Thing]) -> Noun {
    let told = Noun { plural: told.len() > 1, ..Noun::of(told.to_vec()) };
    Noun { plural: true, except: vec![told], ..noun }
}

/// Whether it was asked of some of several things that were told: "which of them are red?"
fn asks_of_told(noun: &Noun) -> bool {
    let of = noun.restrictions.iter().filter(|place| matches!(place.rel, Rel::Of | Rel::From));
    let anchors = of.flat_map(|place| &place.anchors);
    let told = |noun: &Noun| noun.head.things.as_ref().is_some_and(|things| things.len() > 1);
    std::iter::once(noun).chain(anchors).any(told)
}
