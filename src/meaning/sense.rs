//! What rules make of their parts: small expressions over typed values.
//!
//! ```text
//! n & a       a description with more said of it          r(n)  on(n)   in a role to something
//! not(m)      either(m, m)  some(n)  all(n)  none(n)  exactly(k, n)  except(n)  having(r, n)  any(Thing)
//! most(height)  least(distance, n)  having_most(r, n)     list(x) count(x) whether(x, m) both(f, f) …: the forms
//! beyond(most(height), k)  exceeds(most(height), n)  ranked(k, m)  within(k, n)  same(p, n)
//! of(n, x): n, whatever x is                                 kind(sofa)  quality(red): what the map knows by a name
//! ```
//!
//! Invariant: what is untyped does not come about: `&` gives nothing where a role does not take such a thing.

use super::features::Features;
use super::term::{Desc, Dimension, Form, Measure, Mod, Quant, RoleId, Sorts};
use crate::language::question::Property;

/// The value of a part of a sentence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Sense {
    /// A word that has its place and no meaning of its own; an optional part that is not there.
    Nothing,
    Desc(Desc),
    Mods(Vec<Mod>),
    Role(RoleId),
    Number(u64),
    Property(Property),
    Measure(Measure),
    Form(Box<Form>),
}

/// What a category's parts are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Type {
    Nothing,
    Desc,
    Mods,
    Role,
    Number,
    Property,
    Measure,
    Form,
}

impl Type {
    /// As faults call it.
    pub(crate) fn word(self) -> (&'static str, &'static str) {
        match self {
            Self::Nothing => ("ничего", "nothing"),
            Self::Desc => ("описание вещи", "a description of a thing"),
            Self::Mods => ("то, что о вещи сказано", "what is said of a thing"),
            Self::Role => ("отношение", "a relation"),
            Self::Number => ("число", "a number"),
            Self::Property => ("свойство", "a property"),
            Self::Measure => ("мера", "a measure"),
            Self::Form => ("вопрос", "a question"),
        }
    }
}

/// A function of the grammar files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Function {
    Not,
    Either,
    Some,
    All,
    None,
    Exactly,
    Except,
    Having,
    HavingMost,
    HavingLeast,
    Best,
    Ranked,
    Exceeds,
    Of,
    Beyond,
    Within,
    Same,
    Times,
    List,
    Count,
    AskSome,
    AskNone,
    Whether,
    Choice,
    Place,
    Room,
    By,
    Value,
    Joins,
    Distance,
    Compare,
    Nearer,
    Which,
    Is,
    Size,
    Number,
    Over,
    Under,
    More,
    Extra,
    Both,
    OneOf,
}

impl Function {
    pub(crate) const NAMES: [(&'static str, Self); 42] = [
        ("not", Self::Not),
        ("either", Self::Either),
        ("some", Self::Some),
        ("all", Self::All),
        ("none", Self::None),
        ("exactly", Self::Exactly),
        ("except", Self::Except),
        ("having", Self::Having),
        ("having_most", Self::HavingMost),
        ("having_least", Self::HavingLeast),
        ("best", Self::Best),
        ("ranked", Self::Ranked),
        ("exceeds", Self::Exceeds),
        ("of", Self::Of),
        ("beyond", Self::Beyond),
        ("within", Self::Within),
        ("same", Self::Same),
        ("times", Self::Times),
        ("list", Self::List),
        ("count", Self::Count),
        ("exists", Self::AskSome),
        ("lacks", Self::AskNone),
        ("whether", Self::Whether),
        ("choice", Self::Choice),
        ("place", Self::Place),
        ("room", Self::Room),
        ("by", Self::By),
        ("value", Self::Value),
        ("joins", Self::Joins),
        ("distance", Self::Distance),
        ("compare", Self::Compare),
        ("nearer", Self::Nearer),
        ("which", Self::Which),
        ("is", Self::Is),
        ("size", Self::Size),
        ("number", Self::Number),
        ("number_over", Self::Over),
        ("number_under", Self::Under),
        ("more", Self::More),
        ("extra", Self::Extra),
        ("both", Self::Both),
        ("oneof", Self::OneOf),
    ];

    /// What it takes, the last ones optional after `.1` of them, and what it gives.
    pub(crate) fn signature(self) -> (&'static [Type], Type) {
        use Type::{Desc as D, Form as F, Measure as Me, Mods as M, Number, Property, Role as R};
        match self {
            Self::Not => (&[M], M),
            Self::Either => (&[M, M], M),
            Self::Some | Self::All | Self::None => (&[D], D),
            Self::Exactly => (&[Number, D], D),
            Self::Except => (&[D], M),
            Self::Having | Self::HavingMost | Self::HavingLeast => (&[R, D], M),
            Self::Best => (&[Me, D], M),
            Self::Ranked => (&[Number, Me], M),
            Self::Exceeds => (&[Me, D], M),
            Self::Of => (&[D, D], D),
            Self::Beyond => (&[Me, Number], M),
            Self::Within => (&[Number, D], M),
            Self::Same => (&[Property, D], M),
            Self::Times => (&[Number, Number], Number),
            Self::List | Self::Count | Self::AskSome | Self::AskNone => (&[D], F),
            Self::Place | Self::Room | Self::Joins => (&[D], F),
            Self::Whether => (&[D, M], F),
            Self::Choice => (&[D, M], F),
            Self::By => (&[D, R], F),
            Self::Value => (&[D, Property], F),
            Self::Distance => (&[D, D], F),
            Self::Compare => (&[D, D, Me], F),
            Self::Nearer => (&[D, D, D], F),
            Self::Which => (&[D, D, M], F),
            Self::Is | Self::More | Self::Extra => (&[D, D], F),
            Self::Size => (&[D, Me], F),
            Self::Number | Self::Over | Self::Under => (&[D, Number], F),
            Self::Both | Self::OneOf => (&[F, F], F),
        }
    }

    /// How many arguments it may do without.
    pub(crate) fn optional(self) -> usize {
        usize::from(self == Self::Best)
    }
}

/// A checked expression.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Meaning {
    Variable(u8),
    Role(RoleId),
    /// A role of one argument, which is said of a thing by itself.
    Said(RoleId),
    Apply(Box<Self>, Vec<Self>),
    And(Vec<Self>),
    Call(Function, Vec<Self>),
    Any(Sorts),
    Measure(Dimension, bool),
    Property(Property),
    Number(u64),
    /// A kind that the map's own lexicon knows by this name: how a file gives it words.
    Kind(String),
    /// A value likewise.
    Known(String),
    Nothing,
}

/// Which sorts a role takes at each of its places, an overload each.
pub(crate) type Signatures = Vec<Vec<Vec<Sorts>>>;

/// The value of a variable: what its parts mean together.
#[derive(Debug, Clone)]
pub(crate) struct Bound {
    pub(crate) sense: Sense,
    pub(crate) features: Features,
}

impl Meaning {
    /// Its value; none where its parts do not go together.
    pub(crate) fn value(&self, bound: &[Option<Bound>], roles: &Signatures) -> Option<Sense> {
        match self {
            Self::Nothing => Some(Sense::Nothing),
            // The map tells.
            Self::Kind(_) | Self::Known(_) => None,
            Self::Number(number) => Some(Sense::Number(*number)),
            Self::Role(role) => Some(Sense::Role(*role)),
            Self::Property(property) => Some(Sense::Property(property.clone())),
            Self::Said(role) => Some(Sense::Mods(vec![Mod::Role { role: *role, to: Vec::new() }])),
            Self::Measure(of, most) => Some(Sense::Measure(Measure { of: *of, most: *most })),
            Self::Any(sorts) => Some(Sense::Desc(Desc::any(*sorts))),
            Self::Variable(n) => match bound.get(usize::from(*n))? {
                None => Some(Sense::Nothing),
                Some(Bound { sense: Sense::Desc(desc), features }) => {
                    let number = *features != Features::ALL;
                    let plural = if number { features.is_plural() } else { desc.plural };
                    Some(Sense::Desc(Desc { plural, ..desc.clone() }))
                }
                Some(Bound { sense, .. }) => Some(sense.clone()),
            },
            Self::Apply(role, arguments) => {
                let Sense::Role(role) = role.value(bound, roles)? else { return None };
                let mut to = Vec::new();
                for argument in arguments {
                    let Sense::Desc(desc) = argument.value(bound, roles)? else { return None };
                    to.push(desc);
                }
                let takes = |overload: &Vec<Sorts>| {
                    overload.len() == to.len() + 1
                        && overload[1..].iter().zip(&to).all(|(sorts, d)| sorts.meets(d.sorts))
                };
                let is_typed = roles[usize::from(role.0)].iter().any(takes);
                is_typed.then(|| Sense::Mods(vec![Mod::Role { role, to }]))
            }
            Self::And(parts) => {
                let mut sense = Sense::Nothing;
                for part in parts {
                    sense = and(sense, part.value(bound, roles)?, roles)?;
                }
                Some(sense)
            }
            Self::Call(function, arguments) => {
                let mut values = Vec::new();
                for argument in arguments {
                    values.push(argument.value(bound, roles)?);
                }
                call(*function, values, roles)
            }
        }
    }
}

fn and(a: Sense, b: Sense, roles: &Signatures) -> Option<Sense> {
    match (a, b) {
        (Sense::Nothing, other) | (other, Sense::Nothing) => Some(other),
        (Sense::Mods(mut mods), Sense::Mods(more)) => {
            mods.extend(more);
            Some(Sense::Mods(mods))
        }
        (Sense::Desc(mut desc), Sense::Mods(mods)) => {
            desc.sorts = taking(desc.sorts, &mods, roles)?;
            desc.mods.extend(mods);
            Some(Sense::Desc(desc))
        }
        _ => None,
    }
}

/// To what a thing has a distance.
const MEASURED_TO: Sorts = Sorts::THING.or(Sorts::OPENING);

/// The sorts of which all of this may be said; none for no sort.
pub(crate) fn taking(mut sorts: Sorts, mods: &[Mod], roles: &Signatures) -> Option<Sorts> {
    for one in mods {
        sorts = match one {
            Mod::Role { role, to } => {
                let fits = |overload: &&Vec<Sorts>| {
                    let others = overload.get(1..).unwrap_or_default();
                    others.len() == to.len()
                        && others.iter().zip(to).all(|(sorts, d)| sorts.meets(d.sorts))
                };
                let own = roles[usize::from(role.0)].iter().filter(fits);
                sorts & own.fold(Sorts::NONE, |all, overload| all | overload[0])
            }
            Mod::Having { role, what } => {
                let own = roles[usize::from(role.0)].iter();
                let own = own.filter(|o| o.len() == 2 && o[0].meets(what.sorts));
                sorts & own.fold(Sorts::NONE, |all, overload| all | overload[1])
            }
            Mod::Not(inner) => taking(sorts, std::slice::from_ref(inner), roles)?,
            Mod::Either(choices) => {
                let all = choices.iter().filter_map(|choice| taking(sorts, choice, roles));
                all.fold(Sorts::NONE, |all, one| all | one)
            }
            // Of a room that is locked its door is meant.
            Mod::Value(_) => sorts & (Sorts::THING | Sorts::OPENING),
            Mod::Except(_) => sorts,
            Mod::Best(measure, ..) | Mod::Beyond(measure, _) => sorts & measure.of.sorts(),
            Mod::Exceeds(measure, than) => sorts & than.sorts & measure.of.sorts(),
            Mod::MostOf { role, what, .. } => {
                let own = roles[usize::from(role.0)].iter();
                let own = own.filter(|o| o.len() == 2 && o[0].meets(what.sorts));
                sorts & own.fold(Sorts::NONE, |all, overload| all | overload[1])
            }
            Mod::Within(_, to) if !to.sorts.meets(MEASURED_TO) => Sorts::NONE,
            Mod::Within(..) => sorts & Sorts::THING,
            Mod::Same(_, other) => sorts & other.sorts & (Sorts::THING | Sorts::OPENING),
        };
        if sorts.is_empty() {
            return None;
        }
    }
    Some(sorts)
}

fn call(function: Function, values: Vec<Sense>, roles: &Signatures) -> Option<Sense> {
    use Sense::{Desc as D, Measure as Me, Mods as M};
    let quantified = |desc: Desc, quant| Some(D(Desc { quant, ..desc }));
    let form = |form: Form| Some(Sense::Form(Box::new(form)));
    let mut values = values.into_iter();
    let (a, b, c) = (values.next(), values.next(), values.next());
    match (function, a?, b, c) {
        (Function::Not, M(mut mods), ..) => {
            let only = mods.pop().filter(|_| mods.is_empty())?;
            Some(M(vec![Mod::Not(Box::new(only))]))
        }
        (Function::Either, M(a), Some(M(b)), _) => Some(M(vec![Mod::Either(vec![a, b])])),
        (Function::Some, D(desc), ..) => quantified(desc, Quant::Some),
        (Function::All, D(desc), ..) => quantified(desc, Quant::All),
        (Function::None, D(desc), ..) => quantified(desc, Quant::None),
        (Function::Exactly, Sense::Number(n), Some(D(desc)), _) => {
            quantified(desc, Quant::Exactly(n))
        }
        (Function::Except, D(desc), ..) => Some(M(vec![Mod::Except(desc)])),
        (Function::Having, Sense::Role(role), Some(D(what)), _) => {
            Some(M(vec![Mod::Having { role, what }]))
        }
        (Function::Best, Me(measure), None | Some(Sense::Nothing), _) => {
            Some(M(vec![Mod::Best(measure, None, 1)]))
        }
        (Function::Best, Me(measure), Some(D(to)), _) if to.sorts.meets(MEASURED_TO) => {
            Some(M(vec![Mod::Best(measure, Some(to), 1)]))
        }
        (
            own @ (Function::HavingMost | Function::HavingLeast),
            Sense::Role(role),
            Some(D(what)),
            _,
        ) => {
            let most = own == Function::HavingMost;
            Some(M(vec![Mod::MostOf { role, what, most }]))
        }
        (Function::Ranked, Sense::Number(n), Some(Me(measure)), _) => {
            Some(M(vec![Mod::Best(measure, None, n)]))
        }
        (Function::Exceeds, Me(measure), Some(D(than)), _) => {
            Some(M(vec![Mod::Exceeds(measure, than)]))
        }
        // What serves for an activity, whatever it is done to.
        (Function::Of, D(desc), Some(D(_)), _) => Some(D(desc)),
        (Function::Beyond, Me(measure), Some(Sense::Number(n)), _) => {
            Some(M(vec![Mod::Beyond(measure, n)]))
        }
        (Function::Within, Sense::Number(n), Some(D(to)), _) => Some(M(vec![Mod::Within(n, to)])),
        (Function::Same, Sense::Property(property), Some(D(other)), _) => {
            Some(M(vec![Mod::Same(property, other)]))
        }
        (Function::Times, Sense::Number(a), Some(Sense::Number(b)), _) => {
            a.checked_mul(b).map(Sense::Number)
        }
        (Function::List, D(desc), ..) => form(Form::List(desc)),
        (Function::Count, D(desc), ..) => form(Form::Count(desc)),
        (Function::AskSome, D(desc), ..) => form(Form::Some(desc)),
        (Function::AskNone, D(desc), ..) => form(Form::None(desc)),
        (Function::Place, D(desc), ..) => form(Form::Place(desc)),
        (Function::Room, D(desc), ..) => form(Form::Room(desc)),
        (Function::Joins, D(desc), ..) if desc.sorts.meets(Sorts::OPENING) => {
            form(Form::Joins(desc))
        }
        (Function::Whether, D(desc), Some(M(mods)), _) => {
            taking(desc.sorts, &mods, roles)?;
            form(Form::Whether(desc, mods))
        }
        (Function::Choice, D(desc), Some(M(mods)), _) => {
            taking(desc.sorts, &mods, roles)?;
            match &mods[..] {
                [Mod::Either(choices)] => form(Form::Choice(desc, choices.clone())),
                _ => None,
            }
        }
        (Function::By, D(desc), Some(Sense::Role(role)), _) => {
            let takes = |o: &Vec<Sorts>| o.len() == 2 && o[0].meets(desc.sorts);
            let takes = roles[usize::from(role.0)].iter().any(takes);
            takes.then(|| Sense::Form(Box::new(Form::By(desc, role))))
        }
        (Function::Value, D(desc), Some(Sense::Property(property)), _) => {
            form(Form::Value(desc, property))
        }
        (Function::Distance, D(a), Some(D(b)), _) => form(Form::Distance(a, b)),
        (Function::Compare, D(a), Some(D(b)), Some(Me(measure)))
            if measure.of.sorts().meets(a.sorts & b.sorts) =>
        {
            form(Form::Compare(a, b, measure))
        }
        (Function::Nearer, D(a), Some(D(b)), Some(D(c))) => form(Form::Nearer(a, b, c)),
        (Function::Which, D(a), Some(D(b)), Some(M(mut mods))) => {
            let best = mods.pop().filter(|one| mods.is_empty() && one.is_superlative())?;
            taking(a.sorts & b.sorts, std::slice::from_ref(&best), roles)?;
            form(Form::Which(vec![a, b], best))
        }
        (Function::Is, D(a), Some(D(b)), _) if a.sorts.meets(b.sorts) => form(Form::Is(a, b)),
        (Function::More, D(a), Some(D(b)), _) => form(Form::More(a, b)),
        (Function::Extra, D(a), Some(D(b)), _) => form(Form::Extra(a, b)),
        (Function::Size, D(desc), Some(Me(measure)), _) if measure.of.sorts().meets(desc.sorts) => {
            form(Form::Size(desc, measure.of))
        }
        (Function::Number, D(desc), Some(Sense::Number(n)), _) => form(Form::Number(desc, n, n)),
        (Function::Over, D(desc), Some(Sense::Number(n)), _) => {
            form(Form::Number(desc, n.checked_add(1)?, u64::MAX))
        }
        (Function::Under, D(desc), Some(Sense::Number(n)), _) => {
            form(Form::Number(desc, 0, n.checked_sub(1)?))
        }
        (Function::Both, Sense::Form(a), Some(Sense::Form(b)), _) => form(Form::Both(a, b)),
        (Function::OneOf, Sense::Form(a), Some(Sense::Form(b)), _) => form(Form::OneOf(a, b)),
        _ => None,
    }
}
