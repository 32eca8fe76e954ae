//! What is said where there is no answer.
//!
//! Invariant: a doubt names what was not understood, or the candidates with what tells them apart.

use super::doubt::{Doubt, Unanswered};
use super::knowledge::Knowledge;
use super::outlive;
use super::query::{Noun, Rel, Thing};
use super::speech;
use super::values::Property;
use super::{Answer, Said};
use crate::map::Entity;
use crate::sets::set;
use crate::units::AreaId;
use crate::words::russian::{self, Preposition};
use crate::words::{Case, Language, alternatives, enumerate, everyday};

impl Unanswered {
    /// With the questions that may have been meant.
    #[must_use]
    pub fn offering(self, offers: Vec<String>) -> Self {
        let quoted: Vec<String> = match self.language {
            Language::Russian => offers.iter().map(|asked| format!("«{asked}»")).collect(),
            Language::English => offers.iter().map(|asked| format!("“{asked}”")).collect(),
        };
        if quoted.is_empty() {
            return self;
        }
        let asked = alternatives(&quoted, self.language);
        // What names nothing of an aside is a word, and may be there for all that.
        let text = match &self.doubt {
            Doubt::Unknown { reference, .. } => {
                let word = tidy(reference);
                self.language.pick(
                    format!("Я не понимаю «{word}»."),
                    format!("I do not understand “{word}”."),
                )
            }
            _ => self.text.clone(),
        };
        let offer = self.language.pick("Может быть, вы спрашиваете:", "Do you ask:");
        Self { text: format!("{text} {offer} {asked}"), offers: offers.into(), ..self }
    }

    /// Of a condition that is neither so nor not so by its answer: the map does not tell it, or a denial in it is not understood.
    #[must_use]
    pub fn undecided(question: &str, answer: Answer) -> Self {
        let language = answer.language;
        let text = match answer.said {
            Said::Unknown => answer.text,
            _ => language.pick(
                format!("Я не понимаю: «{question}»."),
                format!("I do not understand \"{question}\"."),
            ),
        };
        Self {
            doubt: Doubt::not_understood(question),
            language,
            text,
            names: Box::default(),
            offers: Box::default(),
        }
    }

    /// Of an order that hinges on an answer where nothing was asked that is so or not: "If so, close it".
    #[must_use]
    pub fn unasked(order: &str) -> Self {
        let language = Language::of(order);
        let text = language.pick(
            format!("Я не понимаю, о каком условии речь: «{order}»."),
            format!("I do not understand on what this hinges: \"{order}\"."),
        );
        Self {
            doubt: Doubt::not_understood(order),
            language,
            text,
            names: Box::default(),
            offers: Box::default(),
        }
    }

    /// Of a line that takes back its order, and says something else instead that is not understood.
    #[must_use]
    pub fn uncorrected(words: &str, language: Language) -> Self {
        let said = words.trim().trim_end_matches(['.', '!']);
        let text = language.pick(
            format!("Я не понимаю, что взамен: «{said}». Ничего не сделано."),
            format!("I do not understand what is meant instead: \"{said}\". Nothing was done."),
        );
        Self {
            doubt: Doubt::not_understood(said),
            language,
            text,
            names: Box::default(),
            offers: Box::default(),
        }
    }

    /// What was asked for is called so by nothing on the map, which denies nothing: it may be there under another name. Of a
    /// word that `known` does not say to be one, that is told as well.
    pub(super) fn not_denied(self, known: impl Fn(&str) -> bool) -> Self {
        let Doubt::Unknown { reference, near } = &self.doubt else { return self };
        if !near.is_empty() || known(reference) {
            return self;
        }
        let word = tidy(reference);
        let text = match self.language {
            Language::Russian => format!(
                "слова «{word}» я не знаю: под таким названием на карте ничего нет, а есть ли это под другим, не скажу"
            ),
            Language::English => format!(
                "I do not know the word \"{word}\": nothing on the map is called so, and whether it is there under another name I cannot tell"
            ),
        };
        Self { text: speech::sentence(&text), ..self }
    }
}

impl Knowledge<'_> {
    pub(super) fn unanswered(&self, doubt: Doubt) -> Unanswered {
        let (text, names) = self.doubt_words(&doubt);
        Unanswered {
            doubt,
            language: self.language,
            text: speech::sentence(&text),
            names: names.into(),
            offers: Box::default(),
        }
    }

    fn doubt_words(&self, doubt: &Doubt) -> (String, Vec<String>) {
        let russian = self.is_russian();
        let text = match doubt {
            Doubt::Empty => self
                .pick(
                    "вопрос пуст. Спросите, например: «Где лекарство?»",
                    "the question is empty. Ask, for example: \"Where is the medicine?\"",
                )
                .to_owned(),
            Doubt::TooLong { length } => match russian {
                true => format!("вопрос слишком длинный: {length} знаков. Спросите короче"),
                false => {
                    format!("the question is too long: {length} characters. Ask a shorter one")
                }
            },
            Doubt::NotUnderstood { words } => match russian {
                true => format!("я не понимаю: «{}»", tidy(words)),
                false => format!("I do not understand \"{}\"", tidy(words)),
            },
            Doubt::PointNoRoom { point, room } => {
                let (name, place) = (self.name(*point), self.place(Rel::In, &[*room]));
                match russian {
                    true => format!("{name} – точка, а не помещение: она {place}"),
                    false => format!("{name} is a point and not a room: it is {place}"),
                }
            }
            Doubt::Astray { told } => match russian {
                true => format!("я не понял, где вы: «{}»", tidy(told)),
                false => format!("I did not understand where you are: \"{}\"", tidy(told)),
            },
            Doubt::Unheeded { told } => match russian {
                true => format!("не знаю, как учесть сказанное: «{}»", tidy(told)),
                false => format!("I do not know how to reckon with \"{}\"", tidy(told)),
            },
            Doubt::Incomplete { about } => match russian {
                true => format!("что вы хотите узнать про «{}»?", tidy(about)),
                false => format!("what would you like to know about \"{}\"?", tidy(about)),
            },
            Doubt::NoReferent { word } if word.trim().is_empty() => {
                self.pick("не понимаю, о чём речь", "I do not know what is meant here").to_owned()
            }
            Doubt::NoReferent { word } => match russian {
                true => format!("не понимаю, о чём речь: «{}»", tidy(word)),
                false => format!("I do not know what \"{}\" means here", tidy(word)),
            },
            Doubt::InOrOn { place } => match self.form(*place, Case::Accusative) {
                name if russian => format!("в {name} или на {name}?"),
                name => format!("in {name} or on it?"),
            },
            Doubt::Departed { things } => outlive::departed_words(things, self.language),
            Doubt::Past { moved } => match russian {
                true => format!(
                    "знаю только, как есть сейчас; с тех пор перемещено: {}",
                    self.list(moved)
                ),
                false => format!("I know only how it is now; moved since: {}", self.list(moved)),
            },
            Doubt::TooFew { found } => match russian {
                true => format!("столько нет, есть только {}", self.list(found)),
                false => format!("there are not so many, only {}", self.list(found)),
            },
            Doubt::TooMany { many, most } => match russian {
                true => format!(
                    "таких {many}, а пути я ищу не больше чем к {most}; спросите об одной комнате"
                ),
                false => format!(
                    "there are {many} of them, and I look for ways to no more than {most}; ask of one room"
                ),
            },
            Doubt::Windows => self
                .pick("окон я не открываю и не закрываю", "I neither open nor shut windows")
                .to_owned(),
            Doubt::NoStorey { above: true } => self
                .pick(
                    "выше моего этажа на карте ничего нет",
                    "there is no storey above mine on the map",
                )
                .to_owned(),
            Doubt::NoStorey { above: false } => self
                .pick(
                    "ниже моего этажа на карте ничего нет",
                    "there is no storey below mine on the map",
                )
                .to_owned(),
            Doubt::Unknown { reference, near } => {
                let offered: Vec<String> = near
                    .iter()
                    .map(|n| if russian { format!("«{n}»") } else { format!("\"{n}\"") })
                    .collect();
                let reference = tidy(reference);
                let named = everyday::nominative(&crate::units::name_key(&reference));
                let reference = named.unwrap_or(reference);
                let offer = match (offered.is_empty(), russian) {
                    (true, _) => String::new(),
                    (false, true) => {
                        format!(" Может быть, {}?", alternatives(&offered, self.language))
                    }
                    (false, false) => {
                        format!(" Do you mean {}?", alternatives(&offered, self.language))
                    }
                };
                // Robots of a site, which the map does not keep, are not denied.
                let is_robots = set!("Robots").contains(&&*crate::units::name_key(&reference));
                let text = match russian {
                    true if is_robots => {
                        "роботов карта не хранит, только места для них: из роботов я знаю одного себя"
                            .to_owned()
                    }
                    false if is_robots => "the map keeps no robots, only places for them: of robots I know \
                         myself alone"
                        .to_owned(),
                    true => format!("на карте нет ничего, что называлось бы «{reference}».{offer}"),
                    false => format!("the map has nothing called \"{reference}\".{offer}"),
                };
                return (text, near.clone());
            }
            Doubt::NoneSuch { noun } if self.has_no_order(noun) => self.without_order().to_owned(),
            Doubt::NoneSuch { noun } if !noun.except.is_empty() => self
                .pick(
                    "других, кроме исключённых, на карте нет",
                    "the map has none but what is left out",
                )
                .to_owned(),
            Doubt::NoneSuch { noun } => {
                let place = self.restrictions(noun);
                let none = self.none_of(noun);
                let general = noun.head.anything;
                let none = match (noun.other && !general, russian) {
                    (true, true) => format!("других {none}"),
                    (true, false) => format!("other {none}"),
                    (false, _) => none,
                };
                match (russian, place.is_empty(), general) {
                    (true, true, _) => format!("на карте нет {none}"),
                    (true, false, true) => format!("{place} ничего нет"),
                    (true, false, false) => format!("{place} нет {none}"),
                    (false, true, false) if noun.other => format!("the map has no {none}"),
                    (false, true, _) => format!("there is no such thing on the map: {none}"),
                    (false, false, _) => self.there_is_no(noun, &place),
                }
            }
            Doubt::Ambiguous { reference, candidates } => {
                return self.which_one(reference, candidates);
            }
        };
        (text, Vec::new())
    }

    /// «Где самая тяжёлая вещь?»: there are such things, but no measure of them.
    fn has_no_order(&self, noun: &Noun) -> bool {
        let unordered = Noun { best: None, rank: None, ..noun.clone() };
        noun.best.is_some() && self.find(&unordered, true).is_ok_and(|all| !all.is_empty())
    }

    /// The candidates, each with what tells it from the others.
    fn which_one(&self, reference: &str, candidates: &[Thing]) -> (String, Vec<String>) {
        const SHOWN: usize = 8;
        let names: Vec<String> = candidates.iter().map(|t| self.name(*t)).collect();
        let shown: Vec<String> = candidates
            .iter()
            .take(SHOWN)
            .map(|t| match self.telling(*t, candidates) {
                Some(mark) => format!("{} ({mark})", self.name(*t)),
                None => self.name(*t),
            })
            .collect();
        let more = candidates.len().saturating_sub(SHOWN);
        let list = match (more, self.is_russian()) {
            (0, _) => alternatives(&shown, self.language),
            (_, true) => format!("{} или ещё что-то из {more}", shown.join(", ")),
            (_, false) => format!("{} or one of {more} more", shown.join(", ")),
        };
        let reference = tidy(reference);
        let text = match self.is_russian() {
            true => format!("«{reference}» – это {list}?"),
            false => format!("by \"{reference}\", do you mean {list}?"),
        };
        (text, names)
    }

    /// A property, or a place, by which a thing differs from the other candidates.
    fn telling(&self, thing: Thing, candidates: &[Thing]) -> Option<String> {
        let property = |t: Thing, wanted: &Property| {
            let all = self.values(t);
            all.into_iter().find(|(p, _, _)| p == wanted).and_then(|(_, v, _)| v)
        };
        // What each of the candidates has tells better than what the map gives of some.
        let own = |wanted: &Property, of_all: bool| {
            let value = property(thing, wanted)?;
            let all = candidates.iter().map(|t| property(*t, wanted));
            let known = all.clone().all(|other| other.is_some()) || !of_all;
            let alike = all.filter(|other| *other == Some(value)).count();
            (known && alike == 1).then(|| self.value_of(wanted, value, thing))
        };
        if let Some(colour) = own(&Property::Colour, true) {
            return Some(colour);
        }
        let place = self.own_place(thing, candidates);
        let here = |t: &&Thing| self.own_place(**t, candidates) == place;
        if self.opening(thing).is_none()
            && place.is_some()
            && candidates.iter().filter(here).count() == 1
        {
            return place;
        }
        const VALUES: [Property; 3] = [Property::Colour, Property::Material, Property::State];
        let value = |of_all: bool| VALUES.iter().find_map(|wanted| own(wanted, of_all));
        if let Some(value) = value(true).or_else(|| value(false)) {
            return Some(value);
        }
        let mut marks: Vec<String> = Vec::new();
        if let Some(value) = property(thing, &Property::Colour)
            && candidates.iter().any(|t| property(*t, &Property::Colour) != Some(value))
        {
            marks.push(self.value_of(&Property::Colour, value, thing));
        }
        if let Some(gate) = self.opening(thing) {
            let case = if gate.areas.len() == 1 { Case::Genitive } else { Case::Instrumental };
            let room = |a: &AreaId| self.form(Thing::Entity(Entity::Area(*a)), case);
            let rooms = enumerate(&gate.areas.iter().map(room).collect::<Vec<_>>(), self.language);
            return Some(match (self.is_russian(), gate.areas.len()) {
                (true, 1) => format!("из {rooms}"),
                (true, _) => format!("между {rooms}"),
                (false, 1) => format!("of {rooms}"),
                (false, _) => format!("between {rooms}"),
            });
        }
        marks.extend(place);
        if marks.is_empty() {
            marks.extend(self.bearing(thing, candidates));
        }
        if let ([a, b], true) = (candidates, marks.is_empty()) {
            let far = |t: &Thing| self.distance(*t, Thing::Robot);
            if let (Some(a_far), Some(b_far)) = (far(a), far(b)) {
                let nearer = (a_far <= b_far) == (thing == *a);
                marks.push(match nearer {
                    true => self.pick("ближе ко мне", "nearer to me").to_owned(),
                    false => self.pick("дальше от меня", "farther from me").to_owned(),
                });
            }
        }
        (!marks.is_empty())
            .then(|| enumerate(&marks, self.language).replace(" и ", ", ").replace(" and ", ", "))
    }
}

impl Knowledge<'_> {
    /// What a thing is on or in, else its room, where that is not so of all the candidates.
    fn own_place(&self, thing: Thing, candidates: &[Thing]) -> Option<String> {
        let support = |t: Thing| t.replica().and_then(|id| self.relations.support_of(id));
        if let Some(own) = support(thing)
            && candidates.iter().any(|t| support(*t) != Some(own))
        {
            // Where the rooms differ too, people go by them.
            let area = self.area_of(thing);
            if candidates.iter().any(|t| self.area_of(*t) != area) {
                return Some(self.short_place(thing, &mut Vec::new()));
            }
            let own = Thing::Entity(Entity::Replica(own));
            return Some(self.place(self.on_or_in(thing, own), &[own]));
        }
        let own = self.area_of(thing).filter(|_| thing.area().is_none())?;
        let apart = candidates.iter().any(|t| self.area_of(*t) != Some(own));
        apart.then(|| self.in_room(thing)).flatten()
    }

    /// What stands on this thing and on no other candidate: «с Лекарством», "with the medicine".
    fn bearing(&self, thing: Thing, candidates: &[Thing]) -> Option<String> {
        let borne = self.related(Rel::On, thing);
        let own = borne.first().filter(|_| borne.len() <= 3)?;
        let others = candidates.iter().filter(|t| **t != thing);
        if others.into_iter().any(|t| self.related(Rel::On, *t).contains(own)) {
            return None;
        }
        Some(match self.is_russian() {
            true => russian::with(Preposition::S, Case::Instrumental, self.named(*own).phrase()),
            false => format!("with {}", self.named(*own).english()),
        })
    }
}

/// What a person typed, fit to be repeated: no control characters, not too long.
fn tidy(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(80).collect()
}
