//! Logical forms as questions in the rules' language.
//!
//! A description becomes premises about a variable; a definite one is looked for first and stands as a constant, so that
//! what runs begins with what is known. Negation and what all must have get a relation of the question's own.

mod measures;
mod values;

use std::fmt::Write as _;

use super::grammar::Grammar;
use super::outcome::NoAnswer;
use super::sense::{Signatures, taking};
use super::term::{Desc, Dimension, Head, Measure, Mod, Quant, RoleId, Sorts};
use super::words::Map;
use crate::facts::{Value, quoted};
use crate::language::question::{Extension, KindId, Lexicon, Property, ValueId};
use crate::map::Entity;
use crate::semantics::Subject;
use crate::units::InOrder as _;

/// The rows of a question of the rules' language, or why there are none.
pub type Rows = Result<Vec<Vec<Value>>, String>;

/// Runs such a question.
pub(crate) type Run<'r> = dyn FnMut(&str) -> Rows + 'r;

/// A question on its way, with what was run for it.
pub(crate) struct Asking<'q> {
    pub(crate) grammar: &'q Grammar,
    pub(crate) map: &'q Map<'q>,
    pub(crate) run: &'q mut Run<'q>,
    /// Every question that ran.
    pub(crate) rules: Vec<String>,
}

/// Premises about one thing.
#[derive(Default, Clone)]
struct Body {
    premises: Vec<String>,
    helpers: Vec<String>,
    variables: usize,
    /// Definite others may be any of those that fit.
    is_loose: bool,
}

impl Body {
    fn variable(&mut self) -> String {
        self.variables += 1;
        format!("X{}", self.variables)
    }
}

/// Of these the facts tell which there are.
const HAVE_FACTS: Sorts = Sorts::THING.or(Sorts::AREA).or(Sorts::OPENING);

/// The last place that is asked for: «девятый по высоте».
const MOST_RANKS: u64 = 9;

const FALSE: &str = "1 = 2";

impl Asking<'_> {
    /// The symbols of all that fits a description.
    pub(crate) fn all(&mut self, desc: &Desc, is_loose: bool) -> Result<Vec<String>, NoAnswer> {
        self.all_that(desc, &[], is_loose)
    }

    /// The symbols of all that fits a description and of which this holds too.
    pub(crate) fn all_that(
        &mut self,
        desc: &Desc,
        claims: &[Mod],
        is_loose: bool,
    ) -> Result<Vec<String>, NoAnswer> {
        if desc.head == Head::Any && desc.sorts.each().count() > 1 {
            // The rules' types keep things, rooms and doors apart.
            let said: Vec<Mod> = desc.mods.iter().chain(claims).cloned().collect();
            if said.is_empty() || said.iter().any(Mod::is_superlative) {
                return Err(NoAnswer::Unfit("anything at all"));
            }
            let mut found = Vec::new();
            for sorts in desc.sorts.each().filter(|one| HAVE_FACTS.meets(*one)) {
                if taking(sorts, &said, &self.grammar.signatures).is_some() {
                    let one = Desc { sorts, ..desc.clone() };
                    found.extend(self.all_that(&one, claims, is_loose)?);
                }
            }
            return Ok(found);
        }
        let mut body = Body { is_loose, ..Body::default() };
        let x = body.variable();
        self.describe(desc, &x, &mut body)?;
        self.said(claims, &x, desc.sorts, &mut body)?;
        let best = desc.mods.iter().chain(claims).find(|one| one.is_superlative());
        let Some(best) = best else {
            let premises = body.premises.join(", ");
            let rule = format!("{}\n?- answer({x}) :- {premises}", body.helpers.join("\n"));
            return self.symbols(rule.trim());
        };
        if let Mod::Best(Measure { of: Dimension::Distance, most }, Some(to), 1) = best {
            // What is behind a wall is not near, and what is farthest of anything is asked of the room.
            let is_any = desc.head == Head::Any;
            if let Some(here) = self.in_room_of(&x, to)?.filter(|_| !most || is_any) {
                let mut body = body.clone();
                body.premises.push(here);
                let near = self.foremost(&x, best, desc, &mut body)?;
                if !near.is_empty() {
                    return Ok(near);
                }
            }
        }
        self.foremost(&x, best, desc, &mut body)
    }

    /// Those of what premises tell that are foremost.
    fn foremost(
        &mut self,
        x: &str,
        best: &Mod,
        desc: &Desc,
        body: &mut Body,
    ) -> Result<Vec<String>, NoAnswer> {
        if let Mod::Best(Measure { of: Dimension::Distance, most: false }, Some(to), _) = best
            && desc.head == Head::Any
        {
            // "The nearest thing to the egg" is not the counter under it.
            let to = quoted(&self.one(to, false)?);
            body.helpers.push(
                ".decl borne(x: Thing, y: Thing)\nborne(X, Y) :- LIES_ON_OR_IN(X, Y).\n\
                 borne(X, Z) :- LIES_ON_OR_IN(X, Y), borne(Y, Z)."
                    .to_owned(),
            );
            body.premises.push(format!("!borne({x}, {to}), !borne({to}, {x})"));
        }
        let (premise, v, most) = self.measured(x, best, desc.sorts, body)?;
        let (premises, extreme) = (body.premises.join(", "), if most { "max" } else { "min" });
        let mut rule = body.helpers.join("\n");
        let _ = write!(
            rule,
            "\n.decl measured(x: Any, v: number)\nmeasured({x}, {v}) :- {premises}, {premise}."
        );
        let mut last = "measured".to_owned();
        if let Mod::Best(_, _, rank) = best {
            if *rank > MOST_RANKS {
                return Err(NoAnswer::Unfit("so far a place"));
            }
            // The second biggest comes after all that are equally the biggest.
            let sign = if most { "<" } else { ">" };
            for n in 1..*rank {
                let next = format!("after_{n}");
                let _ = write!(
                    rule,
                    "\n.decl {next}(x: Any, v: number)\n\
                     {next}({x}, {v}) :- {last}({x}, {v}), M = {extreme} v : {{ {last}(_, v) }}, {v} {sign} M."
                );
                last = next;
            }
        }
        let _ = write!(
            rule,
            "\n?- answer({x}) :- {last}({x}, {v}), {v} = {extreme} v : {{ {last}(_, v) }}"
        );
        self.symbols(rule.trim())
    }

    /// The values of a property that what fits a description has.
    pub(crate) fn values_of(
        &mut self,
        desc: &Desc,
        property: &Property,
    ) -> Result<Vec<String>, NoAnswer> {
        let mut body = Body { is_loose: true, ..Body::default() };
        let x = body.variable();
        self.describe(desc, &x, &mut body)?;
        let names = self.names_of(property).into_iter().map(|name| quoted(&name));
        let mut told: Vec<String> = names.map(|name| format!("HAS({x}, {name}, V)")).collect();
        if *property == Property::State && !desc.sorts.meets(Sorts::THING) {
            told.push(format!("DOOR_IS({x}, V)"));
        }
        if told.is_empty() {
            return Ok(Vec::new());
        }
        let (premises, helpers) = (body.premises.join(", "), body.helpers.join("\n"));
        self.symbols(format!("{helpers}\n?- answer(V) :- {premises}, {}", either(&told)).trim())
    }

    /// That `x` is in the room of another thing; none where that is in none, or is not one.
    fn in_room_of(&mut self, x: &str, to: &Desc) -> Result<Option<String>, NoAnswer> {
        if to.sorts != Sorts::THING {
            return Ok(None);
        }
        let to = quoted(&self.one(to, false)?);
        Ok(Some(format!("in_area({x}, Room), in_area({to}, Room), {x} != {to}")))
    }

    /// Those of what fits a description of which the map tells whether they have a value.
    pub(crate) fn known(&mut self, desc: &Desc, value: ValueId) -> Result<Vec<String>, NoAnswer> {
        let mut body = Body::default();
        let x = body.variable();
        let Some(known) = self.property_known(value, &x, desc.sorts) else { return Ok(Vec::new()) };
        self.describe(desc, &x, &mut body)?;
        body.premises.push(known);
        let premises = body.premises.join(", ");
        self.symbols(format!("{}\n?- answer({x}) :- {premises}", body.helpers.join("\n")).trim())
    }

    /// The one thing that a definite description means.
    pub(crate) fn one(&mut self, desc: &Desc, is_loose: bool) -> Result<String, NoAnswer> {
        if let (Head::Entities(all), true) = (&desc.head, desc.mods.is_empty())
            && let [only] = all[..]
        {
            return self.symbol(only);
        }
        let mut found = self.all(desc, is_loose)?;
        match found.len() {
            0 => Err(NoAnswer::NoneSuch),
            1 => Ok(found.swap_remove(0)),
            _ => Err(NoAnswer::Ambiguous(found)),
        }
    }

    /// The first columns of what a question finds.
    pub(crate) fn symbols(&mut self, rule: &str) -> Result<Vec<String>, NoAnswer> {
        let rows = self.rows(rule)?;
        let first = |row: Vec<Value>| row.into_iter().next().map(|value| value.to_string());
        let mut found: Vec<String> = rows.into_iter().filter_map(first).collect();
        found.order();
        found.dedup();
        Ok(found)
    }

    pub(crate) fn rows(&mut self, rule: &str) -> Result<Vec<Vec<Value>>, NoAnswer> {
        self.rules.push(rule.to_owned());
        (self.run)(rule).map_err(NoAnswer::Failed)
    }

    fn symbol(&self, entity: Entity) -> Result<String, NoAnswer> {
        // What is carried stands in no facts.
        let known = self.map.relations.symbols().known(Subject::Entity(entity));
        known.map(ToString::to_string).ok_or(NoAnswer::Unfit("what is carried"))
    }

    /// Premises for a description of `x`.
    fn describe(&mut self, desc: &Desc, x: &str, body: &mut Body) -> Result<(), NoAnswer> {
        if matches!(desc.quant, Quant::Exactly(_)) {
            return Err(NoAnswer::Unfit("a number of things"));
        }
        let mut choices: Vec<String> = Vec::new();
        match &desc.head {
            Head::Entities(all) => {
                for entity in all {
                    choices.push(format!("{x} = {}", quoted(&self.symbol(*entity)?)));
                }
            }
            Head::Kinds(kinds) => {
                for kind in kinds {
                    self.kind(*kind, x, &mut choices);
                }
                if choices.is_empty() {
                    let is_sort = |kind: &KindId| {
                        let extension = &self.map.lexicon.kind(*kind).extension;
                        matches!(extension, Extension::Sort(_))
                    };
                    // Of a sort of things the map has no kind.
                    if !kinds.iter().all(is_sort) {
                        return Err(NoAnswer::Unfit("such a kind"));
                    }
                    choices.push(format!("replica({x}, _, _, _, _), {FALSE}"));
                }
            }
            Head::Any => {
                for (sort, premise) in [
                    (Sorts::THING, format!("replica({x}, _, _, _, _)")),
                    (Sorts::AREA, format!("area({x}, _)")),
                    (Sorts::OPENING, format!("opening({x}, _, _, _)")),
                    (Sorts::STOREY, format!("area(_, {x})")),
                ] {
                    if desc.sorts.meets(sort) {
                        choices.push(premise);
                    }
                }
            }
        }
        choices.order();
        choices.dedup();
        body.premises.push(either(&choices));
        self.said(&desc.mods, x, desc.sorts, body)
    }

    fn kind(&self, kind: KindId, x: &str, choices: &mut Vec<String>) {
        let (world, symbols) = (self.map.world, self.map.relations.symbols());
        let mut object = |id| {
            let symbol = symbols.symbol(Subject::Object(id));
            choices.push(format!("INSTANCE_OF({x}, {})", quoted(symbol)));
        };
        let objects = world.objects.values();
        match &self.map.lexicon.kind(kind).extension {
            Extension::ObjectType(id) => {
                objects.filter(|o| o.object_type == Some(*id)).for_each(|o| object(o.id));
            }
            Extension::Object(id) => object(*id),
            Extension::Lighting => {
                let is_light =
                    |o: &&crate::map::Object| world.types.object.has_trait(o.object_type, "light");
                let is_switch = |o: &&crate::map::Object| {
                    world.types.object.get(o.object_type).is_some_and(Lexicon::is_switch)
                };
                // A switch stands for its light only where the map gives the lights themselves no place.
                match objects.clone().any(|o| is_light(&o)) {
                    true => objects.filter(is_light).for_each(|o| object(o.id)),
                    false => objects.filter(is_switch).for_each(|o| object(o.id)),
                }
            }
            Extension::Trait(wanted) => choices.push(format!("HAS_TRAIT({x}, \"{wanted}\")")),
            Extension::Things => choices.push(format!("replica({x}, _, _, _, _)")),
            Extension::Furniture => choices.push(format!("IS_FURNITURE({x})")),
            Extension::Rooms => choices.push(format!("area({x}, _)")),
            Extension::AreaType(id) => {
                let own = world.areas.values().filter(|a| a.area_type == Some(*id));
                let symbol = |id| quoted(symbols.symbol(Subject::Entity(Entity::Area(id))));
                choices.extend(own.map(|a| format!("{x} = {}", symbol(a.id))));
            }
            Extension::DoorType(id) => {
                let own = world.doors.values().filter(|d| d.door_type == Some(*id));
                let symbol = |id| quoted(symbols.symbol(Subject::Entity(Entity::Door(id))));
                choices.extend(own.map(|d| format!("{x} = {}", symbol(d.id))));
            }
            Extension::Doors => choices.push(format!("opening({x}, \"door\", _, _)")),
            Extension::Storeys => choices.push(format!("area(_, {x})")),
            Extension::Passages => choices.push(format!("opening({x}, \"passage\", _, _)")),
            // Of these the facts know nothing; the kinds of a sort stand beside it.
            _ => {}
        }
    }

    fn said(
        &mut self,
        mods: &[Mod],
        x: &str,
        sorts: Sorts,
        body: &mut Body,
    ) -> Result<(), NoAnswer> {
        for one in mods {
            self.say(one, x, sorts, body)?;
        }
        Ok(())
    }

    fn say(&mut self, one: &Mod, x: &str, sorts: Sorts, body: &mut Body) -> Result<(), NoAnswer> {
        match one {
            Mod::Value(value) => {
                let choices = self.value(*value, x, sorts)?;
                body.premises.push(either(&choices));
            }
            Mod::Role { role, to } => {
                let mut terms = vec![(x.to_owned(), sorts)];
                for (n, other) in to.iter().enumerate() {
                    let other = self.narrowed(*role, n + 1, other);
                    terms.push((self.term(&other, body)?, other.sorts));
                }
                let premise = self.role(*role, &terms, body)?;
                body.premises.push(premise);
            }
            Mod::Having { role, what } => {
                if what.quant == Quant::None {
                    let bare = Desc { quant: Quant::Some, ..what.clone() };
                    let having = Mod::Having { role: *role, what: bare };
                    return self.say(&Mod::Not(Box::new(having)), x, sorts, body);
                }
                let what = &self.narrowed(*role, 0, what);
                // "Rooms with a lamp" have any.
                let is_loose = std::mem::replace(&mut body.is_loose, true);
                let term = self.term(what, body)?;
                body.is_loose = is_loose;
                let terms = [(term, what.sorts), (x.to_owned(), sorts)];
                let premise = self.role(*role, &terms, body)?;
                body.premises.push(premise);
            }
            Mod::Not(inner) => {
                // Only of what the map gives the property is it said that it is not so.
                if let Mod::Value(value) = &**inner
                    && let Some(known) = self.property_known(*value, x, sorts)
                {
                    body.premises.push(known);
                }
                let before = std::mem::take(&mut body.premises);
                self.say(inner, x, sorts, body)?;
                let inner = std::mem::replace(&mut body.premises, before).join(", ");
                self.none_of(x, x, &inner, body);
            }
            Mod::Either(choices) => {
                let before = std::mem::take(&mut body.premises);
                let mut all = Vec::new();
                for choice in choices {
                    self.said(choice, x, sorts, body)?;
                    all.push(std::mem::take(&mut body.premises).join(", "));
                }
                body.premises = before;
                body.premises.push(either(&all));
            }
            Mod::Except(other) => {
                let before = std::mem::take(&mut body.premises);
                let y = body.variable();
                self.describe(other, &y, body)?;
                let inner = std::mem::replace(&mut body.premises, before).join(", ");
                self.none_of(x, &y, &inner, body);
            }
            // Found after all else.
            Mod::Best(..) | Mod::MostOf { .. } => {}
            Mod::Beyond(measure, than) => {
                let v = body.variable();
                let premise = amount(measure.of, x, sorts, &v)?;
                let sign = if measure.most { ">" } else { "<" };
                body.premises.push(format!("{premise}, {v} {sign} {than}"));
            }
            Mod::Exceeds(measure, than) => {
                let y = self.term(than, body)?;
                // "Taller than the fridge": wherever it begins.
                let of =
                    if measure.of == Dimension::Level { Dimension::Height } else { measure.of };
                let (v, w) = (body.variable(), body.variable());
                let own = amount(of, x, sorts & than.sorts, &v)?;
                let other = amount(of, &y, sorts & than.sorts, &w)?;
                let sign = if measure.most { ">" } else { "<" };
                let premise = format!("{own}, {other}, {v} {sign} {w}");
                body.premises.push(premise);
            }
            Mod::Within(reach, to) => {
                let (term, v) = (self.term(to, body)?, body.variable());
                let premise = format!("distance_between({x}, {term}, {v}), {v} <= {reach}");
                body.premises.push(premise);
            }
            Mod::Same(property, other) => {
                let (y, v) = (self.term(other, body)?, body.variable());
                let names = self.names_of(property).into_iter().map(|name| quoted(&name));
                let both = names.map(|n| format!("HAS({x}, {n}, {v}), HAS({y}, {n}, {v})"));
                let both: Vec<String> = both.collect();
                if both.is_empty() {
                    return Err(NoAnswer::Unfit("such a property"));
                }
                body.premises.push(format!("{}, {x} != {y}", either(&both)));
            }
        }
        Ok(())
    }

    /// That `x` is none of those `y` of which premises hold: they get a relation of their own.
    fn none_of(&mut self, x: &str, y: &str, premises: &str, body: &mut Body) {
        let name = format!("has_one_{}", body.helpers.len() + 1);
        body.helpers.push(format!(".decl {name}(x: Any)\n{name}({y}) :- {premises}."));
        body.premises.push(format!("!{name}({x})"));
    }

    /// Another thing as an argument: a constant for a definite one, unless any of several will do.
    fn term(&mut self, desc: &Desc, body: &mut Body) -> Result<String, NoAnswer> {
        let is_named = matches!(&desc.head, Head::Entities(all) if all.len() == 1);
        if (desc.is_definite() && !body.is_loose) || (is_named && desc.mods.is_empty()) {
            return Ok(quoted(&self.one(desc, false)?));
        }
        if desc.quant == Quant::All || desc.quant == Quant::None {
            return Err(NoAnswer::Unfit("all of several"));
        }
        if desc.mods.iter().any(Mod::is_superlative) {
            return Ok(quoted(&self.one(desc, true)?));
        }
        let y = body.variable();
        self.describe(desc, &y, body)?;
        Ok(y)
    }

    /// Anything as far as a role takes it at a place.
    fn narrowed(&self, role: RoleId, place: usize, desc: &Desc) -> Desc {
        let overloads = &self.grammar.signatures[usize::from(role.0)];
        let takes = overloads.iter().filter_map(|own| own.get(place));
        let takes = takes.fold(Sorts::NONE, |all, one| all | *one);
        let sorts = if desc.head == Head::Any { desc.sorts & takes } else { desc.sorts };
        Desc { sorts, ..desc.clone() }
    }

    /// The premises that a role stands for, whichever of its overloads these things fit.
    fn role(
        &mut self,
        role: RoleId,
        terms: &[(String, Sorts)],
        body: &mut Body,
    ) -> Result<String, NoAnswer> {
        let at = usize::from(role.0);
        let signatures: &Signatures = &self.grammar.signatures;
        let mut choices = Vec::new();
        let grammar = self.grammar;
        for (n, overload) in grammar.roles[at].overloads.iter().enumerate() {
            let own = &signatures[at][n];
            let fits = own.len() == terms.len()
                && own.iter().zip(terms).all(|(sorts, (_, of))| sorts.meets(*of));
            if fits {
                let known = overload.variables.iter().zip(terms);
                let known: Vec<(&str, &str)> =
                    known.map(|(name, (term, _))| (name.as_str(), term.as_str())).collect();
                // Of what is known only by its description it follows from the role itself.
                if let Some(needs) = &overload.needs {
                    let needs = filled(needs, &known, 0);
                    let is_open =
                        terms.iter().any(|(t, _)| !t.starts_with('"') && needs.contains(t));
                    if !is_open && self.rows(&format!("?- answer() :- {needs}"))?.is_empty() {
                        return Err(NoAnswer::Unfit("such a relation to that"));
                    }
                }
                for text in &overload.bodies {
                    body.variables += 1;
                    choices.push(filled(text, &known, body.variables));
                }
            }
        }
        if choices.is_empty() {
            Err(NoAnswer::Unfit("such a relation"))
        } else {
            Ok(either(&choices))
        }
    }
}

/// The premise that measures `x` as `v`.
pub(crate) fn amount(of: Dimension, x: &str, sorts: Sorts, v: &str) -> Result<String, NoAnswer> {
    let is_all = |of: Sorts| sorts & of == sorts;
    let what = match of {
        Dimension::Size if is_all(Sorts::THING) => "volume",
        Dimension::Size if is_all(Sorts::AREA) => "base",
        Dimension::Height => "height",
        Dimension::Thickness => "thickness",
        Dimension::Length | Dimension::Width if is_all(Sorts::OPENING) => "width",
        Dimension::Length => "longest",
        Dimension::Width => "width",
        Dimension::Level => "foot",
        Dimension::Size | Dimension::Distance => return Err(NoAnswer::Unfit("such a measure")),
    };
    Ok(format!("size_of({x}, \"{what}\", {v})"))
}

/// A number of a row.
pub(crate) fn number(row: &[Value], column: usize) -> Option<i64> {
    match row.get(column)? {
        Value::Number(number) => Some(*number),
        _ => None,
    }
}

/// The number in the first row.
pub(crate) fn number_of(rows: &[Vec<Value>]) -> Option<i64> {
    number(rows.first()?, 0)
}

/// Any of these premises.
pub(crate) fn either(choices: &[String]) -> String {
    match choices {
        [only] => only.clone(),
        all => format!("({})", all.join(" ; ")),
    }
}

/// A role's body with its arguments put in; variables of its own get a number.
fn filled(body: &str, known: &[(&str, &str)], number: usize) -> String {
    let mut text = String::with_capacity(body.len() + 32);
    let mut rest = body;
    while let Some(first) = rest.chars().next() {
        if first == '"' {
            let end = rest[1..].find('"').map_or(rest.len(), |at| at + 2);
            text.push_str(&rest[..end]);
            rest = &rest[end..];
            continue;
        }
        let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
        let length = rest.find(|c| !is_of_name(c)).unwrap_or(rest.len());
        if length == 0 {
            text.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        }
        let (name, after) = rest.split_at(length);
        rest = after;
        let is_relation = after.trim_start().starts_with('(');
        match known.iter().find(|(own, _)| *own == name) {
            Some((_, term)) if !is_relation => text.push_str(term),
            _ if !is_relation && name.starts_with(char::is_uppercase) => {
                let _ = write!(text, "{name}{number}");
            }
            _ => text.push_str(name),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_role_takes_its_arguments_and_keeps_its_own_variables_apart() {
        let body = "CLOSE_TO(x, y), in_area(x, R), HAS(y, \"x R\", _)";
        assert_eq!(
            filled(body, &[("x", "X1"), ("y", "\"Стол-1\"")], 3),
            "CLOSE_TO(X1, \"Стол-1\"), in_area(X1, R3), HAS(\"Стол-1\", \"x R\", _)"
        );
    }
}
