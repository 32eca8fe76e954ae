//! What a form comes to: run on the rules, as data.

use super::outcome::{Found, NoAnswer, Place};
use super::query::{Asking, amount, number, number_of};
use super::term::{Desc, Dimension, Form, Head, Mod, Quant, Sorts};
use crate::facts::Value;
use crate::facts::quoted;
use crate::language::question::{Property, ValueId};

impl Asking<'_> {
    pub(super) fn answer(&mut self, form: &Form) -> Result<Found, NoAnswer> {
        match form {
            Form::List(desc) | Form::Count(desc) | Form::Some(desc) | Form::None(desc) => {
                let all = self.all(desc, false)?;
                if all.is_empty() && !self.values_are_known(desc)? {
                    return Ok(Found::Unknown);
                }
                Ok(match form {
                    Form::List(_) => Found::Things(all),
                    Form::Count(_) => Found::Number(all.len()),
                    Form::Some(_) => Found::Truth(!all.is_empty()),
                    _ => Found::Truth(all.is_empty()),
                })
            }
            Form::Whether(desc, claims) => self.whether(desc, claims),
            Form::Choice(desc, choices) => {
                let symbol = self.one(desc, true)?;
                let mut holding = Vec::new();
                for (n, claims) in choices.iter().enumerate() {
                    if self.holds(&symbol, desc.sorts, claims)? {
                        holding.push(n.to_string());
                    }
                }
                Ok(if holding.is_empty() { Found::Unknown } else { Found::Values(holding) })
            }
            Form::Place(desc) => self.places(desc),
            Form::Room(desc) => {
                let symbol = quoted(&self.one(desc, true)?);
                let rule = if desc.sorts.meets(Sorts::OPENING) {
                    format!("?- answer(R) :- (JOINS({symbol}, R, _) ; mounts({symbol}, R))")
                } else {
                    format!("?- answer(R) :- in_area({symbol}, R)")
                };
                Ok(Found::Things(self.symbols(&rule)?))
            }
            Form::By(desc, role) => {
                let symbol = self.one(desc, true)?;
                let what = self.constant(&symbol, desc)?;
                // What is in a box in a room is in the box.
                for sort in [Sorts::THING, Sorts::AREA] {
                    let takes = |own: &Vec<Sorts>| own.len() == 2 && own[1].meets(sort);
                    if self.grammar.signatures[usize::from(role.0)].iter().any(takes) {
                        let having = Mod::Having { role: *role, what: what.clone() };
                        let all = self.all_that(&Desc::any(sort), &[having], false)?;
                        if !all.is_empty() {
                            return Ok(Found::Things(all));
                        }
                    }
                }
                Ok(Found::Things(Vec::new()))
            }
            Form::Value(desc, property) => self.value_of(desc, property),
            Form::Joins(desc) => {
                let symbol = quoted(&self.one(desc, true)?);
                let rule = format!("?- answer(R) :- (JOINS({symbol}, R, _) ; mounts({symbol}, R))");
                Ok(Found::Things(self.symbols(&rule)?))
            }
            Form::Distance(a, b) => {
                let (a, b) = (quoted(&self.one(a, true)?), quoted(&self.one(b, true)?));
                let rows = self.rows(&format!("?- answer(D) :- distance_between({a}, {b}, D)"))?;
                number_of(&rows).map(Found::Length).ok_or(NoAnswer::Unfit("such a distance"))
            }
            Form::Compare(a, b, measure) => {
                let sorts = a.sorts & b.sorts;
                let (a, b) = (self.one(a, true)?, self.one(b, true)?);
                let (a, b) = self.amounts((&a, &b), measure.of, sorts)?;
                Ok(Found::Truth(if measure.most { a > b } else { a < b }))
            }
            Form::Nearer(x, a, b) => {
                let x = quoted(&self.one(x, true)?);
                let (a, b) = (quoted(&self.one(a, true)?), quoted(&self.one(b, true)?));
                let rule = format!(
                    "?- answer(A, B) :- distance_between({x}, {a}, A), distance_between({x}, {b}, B)"
                );
                let rows = self.rows(&rule)?;
                let pair = rows.first().and_then(|row| Some((number(row, 0)?, number(row, 1)?)));
                let (a, b) = pair.ok_or(NoAnswer::Unfit("such a distance"))?;
                Ok(Found::Truth(a < b))
            }
            Form::Which(descs, best) => {
                if let (Mod::Best(measure, None, 1), [a, b]) = (best, &descs[..]) {
                    let sorts = a.sorts & b.sorts;
                    let (x, y) = (self.one(a, true)?, self.one(b, true)?);
                    let (a, b) = self.amounts((&x, &y), measure.of, sorts)?;
                    return Ok(Found::Things(match (a == b, (a > b) == measure.most) {
                        (true, _) => vec![x, y],
                        (false, true) => vec![x],
                        (false, false) => vec![y],
                    }));
                }
                let mut entities = Vec::new();
                let mut sorts = Sorts::ANY;
                for desc in descs {
                    sorts = sorts & desc.sorts;
                    let symbol = self.one(desc, true)?;
                    match self.constant(&symbol, desc)?.head {
                        Head::Entities(own) => entities.extend(own),
                        _ => return Err(NoAnswer::Unfit("what has no name")),
                    }
                }
                let both = Desc { head: Head::Entities(entities), ..Desc::any(sorts) };
                let best = std::slice::from_ref(best);
                Ok(Found::Things(self.all_that(&both, best, true)?))
            }
            Form::Is(x, all) => {
                let symbol = self.one(x, true)?;
                Ok(Found::Truth(self.all(all, true)?.contains(&symbol)))
            }
            Form::Size(desc, of) => {
                let symbol = quoted(&self.one(desc, true)?);
                let premise = amount(*of, &symbol, desc.sorts, "V")?;
                let rows = self.rows(&format!("?- answer(V) :- {premise}"))?;
                let found = number_of(&rows).ok_or(NoAnswer::Unfit("such a size"))?;
                match of {
                    Dimension::Size if desc.sorts.meets(Sorts::THING) => {
                        Err(NoAnswer::Unfit("a size in one number"))
                    }
                    Dimension::Size => Ok(Found::Area(found)),
                    _ => Ok(Found::Length(found)),
                }
            }
            Form::Number(desc, least, most) => {
                let (all, is_known) = (self.all(desc, false)?, self.values_are_known(desc)?);
                let so = u64::try_from(all.len()).is_ok_and(|all| (*least..=*most).contains(&all));
                Ok(if is_known { Found::Truth(so) } else { Found::Unknown })
            }
            Form::More(a, b) | Form::Extra(a, b) => {
                if !self.values_are_known(a)? || !self.values_are_known(b)? {
                    return Ok(Found::Unknown);
                }
                let (a, b) = (self.all(a, false)?.len(), self.all(b, false)?.len());
                match form {
                    Form::More(..) => Ok(Found::Truth(a > b)),
                    _ => {
                        a.checked_sub(b).map(Found::Number).ok_or(NoAnswer::Unfit("less than none"))
                    }
                }
            }
            Form::Both(a, b) | Form::OneOf(a, b) => {
                let (a, b) = (self.answer(a)?, self.answer(b)?);
                // The truth that decides it whatever the other is.
                let decisive = Found::Truth(matches!(form, Form::OneOf(..)));
                Ok(match (a, b) {
                    (a, b) if a == decisive || b == decisive => decisive,
                    (Found::Truth(a), Found::Truth(_)) => Found::Truth(a),
                    _ => Found::Unknown,
                })
            }
        }
    }

    fn constant(&self, symbol: &str, desc: &Desc) -> Result<Desc, NoAnswer> {
        use crate::semantics::Subject;
        match self.map.relations.symbols().subject(symbol) {
            Some(Subject::Entity(entity)) => Ok(Desc {
                head: super::term::Head::Entities(vec![entity]),
                mods: Vec::new(),
                plural: false,
                ..desc.clone()
            }),
            _ => Err(NoAnswer::Unfit("what has no name")),
        }
    }

    fn holds(&mut self, symbol: &str, sorts: Sorts, claims: &[Mod]) -> Result<bool, NoAnswer> {
        let desc = Desc { sorts, ..Desc::any(sorts) };
        let desc = self.constant(symbol, &desc)?;
        Ok(!self.all_that(&desc, claims, true)?.is_empty())
    }

    fn whether(&mut self, desc: &Desc, claims: &[Mod]) -> Result<Found, NoAnswer> {
        if claims.iter().any(Mod::is_superlative) {
            return Err(NoAnswer::Unfit("whether it is foremost"));
        }
        if desc.is_definite() {
            let symbol = match self.one(desc, true) {
                // Whichever is meant, where all are alike.
                Err(NoAnswer::Ambiguous(all)) => {
                    let so = self.all_that(desc, claims, true)?;
                    let is_told = claims.iter().all(|one| value_in(one).is_none());
                    if !is_told || !(so.is_empty() || so == all) {
                        return Err(NoAnswer::Ambiguous(all));
                    }
                    return Ok(Found::Truth(!so.is_empty()));
                }
                one => one?,
            };
            if self.holds(&symbol, desc.sorts, claims)? {
                return Ok(Found::Truth(true));
            }
            // No value is told of what the map gives none.
            for one in claims {
                let known = match (value_in(one), one) {
                    (Some(value), _) => self.property_known(value, &quoted(&symbol), desc.sorts),
                    (None, Mod::Same(property, _)) => {
                        self.property_told(property, &quoted(&symbol), desc.sorts)
                    }
                    _ => continue,
                };
                let rule = known.map(|known| format!("?- answer() :- {known}"));
                if rule.is_none_or(|rule| self.rows(&rule).is_ok_and(|rows| rows.is_empty())) {
                    return Ok(Found::Unknown);
                }
            }
            return Ok(Found::Truth(false));
        }
        let so = self.all_that(desc, claims, true)?;
        if let Quant::None | Quant::Some = desc.quant {
            let mods = desc.mods.iter().chain(claims).cloned().collect();
            if so.is_empty() && !self.values_are_known(&Desc { mods, ..desc.clone() })? {
                return Ok(Found::Unknown);
            }
            return Ok(Found::Truth(so.is_empty() == (desc.quant == Quant::None)));
        }
        let all = self.all(desc, true)?;
        if all.is_empty() { Err(NoAnswer::NoneSuch) } else { Ok(Found::Truth(so == all)) }
    }

    /// Whether the map tells of all that fits but for its values whether it has such: else none of them is no answer.
    fn values_are_known(&mut self, desc: &Desc) -> Result<bool, NoAnswer> {
        let (values, others): (Vec<Mod>, Vec<Mod>) =
            desc.mods.iter().cloned().partition(|one| value_in(one).is_some());
        if values.is_empty() {
            return Ok(true);
        }
        // "Is anything made of gold?" is not of doors alone, though the map gives the material of nothing else.
        let sorts = if desc.head == Head::Any { desc.sorts.or(Sorts::THING) } else { desc.sorts };
        let bare = Desc { mods: others, sorts, ..desc.clone() };
        let all = self.all(&bare, false)?;
        for value in values.iter().filter_map(value_in) {
            if !all.is_empty() && self.known(&bare, value)? != all {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn places(&mut self, desc: &Desc) -> Result<Found, NoAnswer> {
        let things = match desc.is_definite() {
            true => vec![self.one(desc, true)?],
            false => self.all(desc, true)?,
        };
        if things.is_empty() {
            return Err(NoAnswer::NoneSuch);
        }
        let mut places = Vec::new();
        for thing in things {
            let symbol = quoted(&thing);
            let mut at = Vec::new();
            if desc.sorts == Sorts::THING {
                let rule = format!("?- answer(Y) :- LIES_ON_OR_IN({symbol}, Y)");
                at.extend(self.symbols(&rule)?.into_iter().next());
                let rule = format!("?- answer(R) :- in_area({symbol}, R)");
                at.extend(self.symbols(&rule)?.into_iter().next());
            } else if desc.sorts == Sorts::OPENING {
                let rule = format!("?- answer(R) :- (JOINS({symbol}, R, _) ; mounts({symbol}, R))");
                at.extend(self.symbols(&rule)?);
            } else if desc.sorts == Sorts::AREA {
                at.extend(self.symbols(&format!("?- answer(M) :- area({symbol}, M)"))?);
            } else {
                return Err(NoAnswer::Unfit("such a place"));
            }
            places.push(Place { thing, at });
        }
        Ok(Found::Places(places))
    }

    fn value_of(&mut self, desc: &Desc, property: &Property) -> Result<Found, NoAnswer> {
        if *property == Property::Kind {
            return Err(NoAnswer::Unfit("of what kind a thing is"));
        }
        if !desc.is_definite() {
            let all = self.values_of(desc, property)?;
            return Ok(if all.is_empty() { Found::Unknown } else { Found::Values(all) });
        }
        let symbol = quoted(&self.one(desc, true)?);
        let names: Vec<String> = self.names_of(property).iter().map(|name| quoted(name)).collect();
        let mut choices: Vec<String> =
            names.iter().map(|name| format!("HAS({symbol}, {name}, V)")).collect();
        if *property == Property::State && !desc.sorts.meets(Sorts::THING) {
            choices.push(format!("DOOR_IS({symbol}, V)"));
        }
        if choices.is_empty() {
            return Ok(Found::Unknown);
        }
        let rows = self.rows(&format!("?- answer(V) :- {}", super::query::either(&choices)))?;
        let values: Vec<String> =
            rows.into_iter().flatten().map(|value: Value| value.to_string()).collect();
        Ok(if values.is_empty() { Found::Unknown } else { Found::Values(values) })
    }
}

/// The value that a thing is said to have, or not to have.
fn value_in(one: &Mod) -> Option<ValueId> {
    match one {
        Mod::Value(value) => Some(*value),
        Mod::Not(inner) => value_in(inner),
        _ => None,
    }
}
