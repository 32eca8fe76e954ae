//! Noun phrases: any name that a map may give to a room, a door, a thing.
//!
//! A name has a head, the words that agree with it, and a tail that stays as it is: in «Большой письменный стол
//! директора» the head is «стол», two adjectives go with it, «директора» stays. «Комната-В» has the head «Комната»
//! and the tag «В»; in «кресло-качалка» both parts decline; «Гостиная 2» is an adjective that became the head.
//!
//! Invariant: the nominative in the name's own number is the name itself, letter for letter.
//!
//! ```
//! use orthoframe_language::{Case, NounPhrase, WordHints};
//! let room = NounPhrase::parse("Комната-В", &WordHints::default());
//! assert_eq!(room.case(Case::Genitive), "Комнаты-В");
//! let desk = NounPhrase::parse("Письменный стол", &WordHints::default());
//! assert_eq!(desk.case(Case::Instrumental), "Письменным столом");
//! ```

use std::collections::BTreeMap;

use super::adjective::Adjective;
use super::grammar::{Animacy, Case, Evidence, Gender, Number, PlaceSense};
use super::letters::recase;
use super::noun::Noun;
use super::number::{Cardinal, Counted};

/// A name with all its forms.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NounPhrase {
    pub(super) name: String,
    pub(super) pieces: Vec<Piece>,
    pub(super) gender: Gender,
    pub(super) animacy: Animacy,
    pub(super) number: Number,
    pub(super) place: PlaceSense,
    pub(super) evidence: Evidence,
    pub(super) given: BTreeMap<(Number, Case), String>,
    /// The head in lower case, the key of the word list.
    pub(super) head: Option<String>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Piece {
    Fixed(String),
    Noun {
        written: String,
        noun: Box<Noun>,
    },
    Agreeing {
        written: String,
        adjective: Adjective,
    },
    /// «Два» of «Два стула».
    Numeral {
        written: String,
        cardinal: Cardinal,
    },
    /// «Стула» of «Два стула»: in the nominative as it is written.
    Counted {
        written: String,
        noun: Box<Noun>,
    },
    /// «2-й»: the digits stay, the ending agrees.
    Ordinal {
        digits: String,
        ending: Adjective,
    },
}

impl NounPhrase {
    /// The name as it was given, in NFC.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The form in this case and number. A name that stands in the plural has no singular: it gives the plural.
    #[must_use]
    pub fn form(&self, case: Case, number: Number) -> String {
        let number = if self.number == Number::Plural { Number::Plural } else { number };
        if let Some(form) = self.given_form(case, number) {
            return form.into();
        }
        if (case, number) == (Case::Nominative, self.number) {
            return self.name.clone();
        }
        self.pieces.iter().map(|piece| self.piece(piece, case, number)).collect()
    }

    /// The form in this case, in the name's own number.
    #[must_use]
    pub fn case(&self, case: Case) -> String {
        self.form(case, self.number)
    }

    /// The form after this number in the nominative: «2 двери», «5 дверей», «3 больших стола».
    #[must_use]
    pub fn counted(&self, number: u64) -> String {
        let counted = Counted::of(number);
        if self.head() == Some("человек") && counted == Counted::Many {
            return self.form(Case::Nominative, Number::Singular);
        }
        match counted {
            Counted::One => self.form(Case::Nominative, Number::Singular),
            Counted::Many => self.form(Case::Genitive, Number::Plural),
            Counted::Few if !self.given.is_empty() => self.form(Case::Genitive, Number::Singular),
            Counted::Few => {
                // An adjective after 2, 3, 4 stands in the plural: «2 гостиные», «2 больших стола».
                let case =
                    if self.gender == Gender::Feminine { Case::Nominative } else { Case::Genitive };
                let of = |piece: &Piece| match piece {
                    Piece::Noun { noun, .. } if !noun.is_adjectival() => {
                        self.piece(piece, Case::Genitive, Number::Singular)
                    }
                    _ => self.piece(piece, case, Number::Plural),
                };
                self.pieces.iter().map(of).collect()
            }
        }
    }

    /// Every form that people may use, rarer ones too, with what it is a form of. Each (case, number) occurs.
    #[must_use]
    pub fn all_forms(&self) -> Vec<(Number, Case, String)> {
        let both = [Number::Singular, Number::Plural];
        let numbers = if self.number == Number::Plural { &both[1..] } else { &both[..] };
        let mut forms = Vec::new();
        for &number in numbers {
            for case in Case::ALL {
                forms.push((number, case, self.form(case, number)));
            }
        }
        for (at, piece) in self.pieces.iter().enumerate() {
            let Piece::Noun { written, noun } = piece else { continue };
            for (number, case, variant) in &noun.paradigm.variants {
                let whole =
                    self.pieces.iter().enumerate().map(|(other, piece)| match other == at {
                        true => recase(written, variant),
                        false => self.piece(piece, *case, *number),
                    });
                forms.push((*number, *case, whole.collect()));
            }
        }
        forms
    }

    #[must_use]
    pub fn gender(&self) -> Gender {
        self.gender
    }

    #[must_use]
    pub fn animacy(&self) -> Animacy {
        self.animacy
    }

    /// The number that the name stands in.
    #[must_use]
    pub fn number(&self) -> Number {
        self.number
    }

    /// Whether one says «в» or «на» of this place.
    #[must_use]
    pub fn place(&self) -> PlaceSense {
        self.place
    }

    /// How the least certain of its words was declined.
    #[must_use]
    pub fn evidence(&self) -> Evidence {
        self.evidence
    }

    /// Where this form comes from: the map for a form that it gives, and for the name itself, which is given.
    #[must_use]
    pub fn evidence_of(&self, case: Case, number: Number) -> Evidence {
        let number = if self.number == Number::Plural { Number::Plural } else { number };
        let is_name = (case, number) == (Case::Nominative, self.number);
        match is_name || self.given_form(case, number).is_some() {
            true => Evidence::Given,
            false => self.evidence,
        }
    }

    /// The words of the name that decline, with where the forms of each come from; those that agree are decided by
    /// their endings. Forms that the map gives of the whole name stand apart ([`Self::evidence_of`]).
    #[must_use]
    pub fn sources(&self) -> Vec<(String, Evidence)> {
        let of = |piece: &Piece| match piece {
            Piece::Fixed(_) | Piece::Numeral { .. } => None,
            Piece::Noun { written, noun } | Piece::Counted { written, noun } => {
                Some((written.clone(), noun.evidence))
            }
            Piece::Agreeing { written, .. } => Some((written.clone(), Evidence::Rule)),
            Piece::Ordinal { digits, ending } => {
                let form = ending.form(Case::Nominative, self.number, self.gender, self.animacy);
                Some((format!("{digits}{}", ordinal_suffix(&form)), Evidence::Rule))
            }
        };
        self.pieces.iter().filter_map(of).collect()
    }

    /// Whether no word was declined by a mere guess from its ending.
    #[must_use]
    pub fn is_certain(&self) -> bool {
        let six = |number| {
            Case::SIX
                .iter()
                .all(|case| self.given.contains_key(&(number, *case)) || *case == Case::Nominative)
        };
        self.evidence < Evidence::Guess || six(self.number)
    }

    /// The head in lower case, nominative: «стол» of «Письменный стол директора».
    #[must_use]
    pub fn head(&self) -> Option<&str> {
        self.head.as_deref()
    }

    /// Shorter names that people use for the same thing: without its tail, and its head alone.
    #[must_use]
    pub fn shorter(&self) -> Vec<Self> {
        let is_head = |piece: &Piece| matches!(piece, Piece::Noun { .. });
        let Some(head) = self.pieces.iter().position(is_head) else { return Vec::new() };
        let first =
            self.pieces.iter().position(|piece| !matches!(piece, Piece::Fixed(_))).unwrap_or(head);
        let mut shorter: Vec<Self> = Vec::new();
        for pieces in [&self.pieces[first..=head], &self.pieces[head..=head]] {
            let mut short =
                Self { pieces: pieces.to_vec(), given: BTreeMap::new(), ..self.clone() };
            let nominative = |piece| short.piece(piece, Case::Nominative, self.number);
            short.name = short.pieces.iter().map(nominative).collect();
            if short.name != self.name && shorter.iter().all(|other| other.name != short.name) {
                shorter.push(short);
            }
        }
        shorter
    }

    fn given_form(&self, case: Case, number: Number) -> Option<&str> {
        let given = |case| self.given.get(&(number, case)).map(String::as_str);
        given(case).or_else(|| match case {
            Case::Locative => given(Case::Prepositional),
            Case::Accusative => match (self.animacy, number, self.gender) {
                (Animacy::Animate, Number::Plural, _)
                | (Animacy::Animate, _, Gender::Masculine) => given(Case::Genitive),
                _ => None,
            },
            _ => None,
        })
    }

    fn piece(&self, piece: &Piece, case: Case, number: Number) -> String {
        match piece {
            Piece::Fixed(text) => text.clone(),
            Piece::Noun { written, noun } => {
                let number = if noun.number == Number::Plural { Number::Plural } else { number };
                recase(written, noun.paradigm.form(number, case))
            }
            Piece::Numeral { written, cardinal } => recase(written, cardinal.form(case)),
            Piece::Counted { written, noun } => match case {
                Case::Nominative | Case::Accusative => written.clone(),
                _ => recase(written, noun.paradigm.form(Number::Plural, case)),
            },
            Piece::Agreeing { written, adjective } => {
                recase(written, &adjective.form(case, number, self.gender, self.animacy))
            }
            Piece::Ordinal { digits, ending } => {
                let form = ending.form(case, number, self.gender, self.animacy);
                format!("{digits}{}", ordinal_suffix(&form))
            }
        }
    }
}

/// «-я», «-го»: the last letter of the ordinal, or the last two after a vowel and consonant, as it is written.
fn ordinal_suffix(form: &str) -> String {
    let letters: Vec<char> = form.chars().collect();
    let keep = if form.ends_with("ого")
        || form.ends_with("его")
        || form.ends_with("ому")
        || form.ends_with("ему")
        || form.ends_with("ыми")
    {
        2
    } else {
        1
    };
    letters[letters.len() - keep..].iter().collect()
}
