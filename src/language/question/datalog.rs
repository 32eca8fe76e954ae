//! A query as a rule of the relations' Datalog, so that a person learns to write it.

use crate::map::{DoorStatus, Entity};
use crate::words::Language;

use super::knowledge::{Knowledge, bases};
use super::lexicon::Extension;
use super::query::{Claim, Filter, Noun, Query, Rel, Restriction, Thing};
use super::values::Property;

/// Atoms on their way into one rule.
struct Rule<'k, 'a> {
    knowledge: &'k Knowledge<'a>,
    atoms: Vec<String>,
    variables: usize,
    /// Rules of relations that a negation needs.
    helpers: Vec<String>,
    /// The description is of doors and passages.
    of_gates: bool,
    /// Something of the question is measured, which the rule does not say.
    measured: bool,
    /// The text of a rule that was made already.
    whole: Option<String>,
}

const NAMES: [&str; 8] = ["X", "Y", "Z", "U", "V", "W", "S", "T"];

impl Knowledge<'_> {
    /// `ответ(X) :- …`, or a remark where a question is one of geometry or history, which no rule answers.
    pub(super) fn rule(&self, query: &Query) -> String {
        let mut rule = Rule {
            knowledge: self,
            atoms: Vec::new(),
            variables: 0,
            helpers: Vec::new(),
            of_gates: false,
            measured: false,
            whole: None,
        };
        let head = match self.language {
            Language::Russian => "ответ",
            Language::English => "answer",
        };
        let (arguments, remark) = rule.read(query);
        let measured = self.pick("остальное измерено", "the rest is measured");
        let remark = match (rule.measured, remark.is_empty()) {
            (true, true) => measured.to_owned(),
            (true, false) if remark != measured => format!("{remark}; {measured}"),
            _ => remark,
        };
        let remark = if remark.is_empty() { String::new() } else { format!("   // {remark}") };
        if let Some(whole) = rule.whole {
            rule.helpers.push(whole);
            return rule.helpers.join("\n");
        }
        let text = match rule.atoms.is_empty() {
            true if arguments.is_empty() => format!("// {}", query.kind()),
            true => format!("{head}({arguments}).{remark}"),
            false => format!("{head}({arguments}) :- {}.{remark}", rule.atoms.join(", ")),
        };
        rule.helpers.push(text);
        rule.helpers.join("\n")
    }
}

impl Rule<'_, '_> {
    fn variable(&mut self) -> String {
        let n = self.variables;
        self.variables += 1;
        NAMES.get(n).map_or_else(|| format!("X{n}"), |name| (*name).to_owned())
    }

    fn relation(&self, english: &str) -> String {
        self.knowledge.relations.display_name(english, self.knowledge.language)
    }

    fn quoted(&self, thing: Thing) -> String {
        format!("\"{}\"", self.knowledge.symbol(thing).replace('"', "\\\""))
    }

    /// The arguments of the head, and what is done with what the rule finds.
    fn read(&mut self, query: &Query) -> (String, String) {
        let pick = |r: &'static str, e: &'static str| self.knowledge.pick(r, e).to_owned();
        match query {
            Query::Find(noun) | Query::Purpose(noun) | Query::Serving { of: noun, .. } => {
                let remark =
                    noun.best.as_ref().map(|b| format!("{:?}", b.extreme)).unwrap_or_default();
                (self.noun(noun), remark)
            }
            Query::Count(noun) => {
                let remark = pick("сколько таких X", "how many such X");
                (self.noun(noun), remark)
            }
            Query::Exists { what, .. } => {
                let remark = pick("есть ли такой X", "is there such an X");
                let terms: Vec<String> = what.iter().map(|n| self.noun(n)).collect();
                (terms.join(", "), remark)
            }
            Query::Where(noun) | Query::RoomOf(noun) => {
                let thing = self.noun(noun);
                let place = self.variable();
                let inside = self.relation("INSIDE");
                if matches!(query, Query::Where(_)) {
                    let on = self.relation("ON_TOP_OF");
                    self.atoms
                        .push(format!("({inside}({thing}, {place}) ; {on}({thing}, {place}))"));
                } else {
                    self.atoms.push(format!("{inside}({thing}, {place})"));
                    self.atoms.push(format!("area({place}, _)"));
                }
                (place, String::new())
            }
            Query::Holds { subject, claims, .. } | Query::Choice { subject, claims } => {
                let thing = self.noun(subject);
                for claim in claims {
                    match claim {
                        Claim::Related(restriction) => self.restriction(&thing, restriction),
                        Claim::Value(filter) => self.filter(&thing, filter),
                        Claim::Size(_) => self.measured = true,
                        Claim::Kind(noun) => self.kinds(&thing, noun),
                    }
                }
                (thing, pick("верно ли", "is it so"))
            }
            // Walls stand in no facts.
            Query::Anchor { of, what: Some(what), .. } if self.knowledge.is_walls(what) => {
                (self.noun(of), pick("стены измерены", "walls are measured"))
            }
            Query::Anchor { rel, of, .. } => {
                let thing = self.noun(of);
                let other = self.variable();
                self.related(*rel, &thing, &other, false);
                (other, String::new())
            }
            Query::Property { property, of } | Query::SameAll { property, of } => {
                let thing = self.noun(of);
                let value = self.variable();
                let is_door = self.is_door(of);
                if is_door && *property == Property::State {
                    let state = self.relation("DOOR_IS");
                    self.atoms.push(format!("{state}({thing}, {value})"));
                } else {
                    let has = self.relation("HAS");
                    let name = property.noun(Language::Russian).to_uppercase();
                    self.atoms.push(format!("{has}({thing}, \"{name}\", {value})"));
                }
                (value, String::new())
            }
            Query::Parts(noun) => {
                let thing = self.noun(noun);
                let (kind, part) = (self.variable(), self.variable());
                let (instance, parts) = (self.relation("INSTANCE_OF"), self.relation("PART_OF"));
                self.atoms.push(format!("{instance}({thing}, {kind})"));
                self.atoms.push(format!("{parts}({part}, {kind})"));
                (part, String::new())
            }
            Query::Leads(noun) => {
                let thing = self.noun(noun);
                let (from, to) = (self.variable(), self.variable());
                let joins = self.relation("JOINS");
                self.atoms.push(format!("{joins}({thing}, {from}, {to})"));
                (format!("{from}, {to}"), String::new())
            }
            Query::Place { use_for, within, .. } => {
                let thing = self.variable();
                let wanted = match use_for {
                    super::query::Use::Sit => "seat",
                    super::query::Use::Lie => "bed",
                    super::query::Use::Put => "support",
                };
                let has = self.relation("HAS_TRAIT");
                self.atoms.push(format!("{has}({thing}, \"{wanted}\")"));
                for restriction in within {
                    self.restriction(&thing, restriction);
                }
                (thing, String::new())
            }
            Query::Size { of, .. }
            | Query::Free(of)
            | Query::Sees(of)
            | Query::Takes(of)
            | Query::Describe(of) => {
                (self.noun(of), pick("остальное измерено", "the rest is measured"))
            }
            Query::Distance { from, to }
            | Query::Duration { from, to }
            | Query::Way { from, to, .. }
            | Query::Passing { from, to, .. }
            | Query::CanReach { from, to } => {
                let from = from.as_ref().map(|n| self.noun(n));
                let to = self.noun(to);
                let terms: Vec<String> = from.into_iter().chain([to]).collect();
                (
                    terms.join(", "),
                    pick("путь и расстояние измеряются", "way and distance are measured"),
                )
            }
            Query::WhichWay { of, .. } => {
                let ends = of.iter().flat_map(|(from, to)| from.iter().chain([to]));
                let terms: Vec<String> = ends.map(|n| self.noun(n)).collect();
                (terms.join(", "), pick("длины путей сравниваются", "lengths of ways are compared"))
            }
            Query::Closer { what, near, than, .. } => {
                let terms = [what, near, than].map(|n| self.noun(n));
                (terms.join(", "), pick("расстояния сравниваются", "distances are compared"))
            }
            Query::Together { of, .. } | Query::Differ { of, .. } | Query::SameSize { of, .. } => {
                let terms: Vec<String> = of.iter().map(|n| self.noun(n)).collect();
                (terms.join(", "), pick("по местам и значениям", "by places and values"))
            }
            Query::WhichMore { of, .. } => {
                let terms: Vec<String> = of.iter().map(|n| self.noun(n)).collect();
                (terms.join(", "), pick("сравнение", "compared"))
            }
            Query::Same { of, .. } | Query::MoreOf { of, .. } => {
                let terms = [&of[0], &of[1]].map(|n| self.noun(n));
                (terms.join(", "), pick("сравнение", "compared"))
            }
            Query::Larger { what, than, .. } => {
                let terms = [what, than].map(|n| self.noun(n));
                (terms.join(", "), pick("сравнение", "compared"))
            }
            Query::Kinds { of, .. } => (self.noun(of), pick("по видам", "by kind")),
            Query::LastSeen(noun) | Query::Before(noun) => {
                (self.noun(noun), pick("по истории хранилища", "from the store's history"))
            }
            Query::Several(queries) => {
                let rules: Vec<String> = queries.iter().map(|q| self.knowledge.rule(q)).collect();
                let (last, others) = rules.split_last().map_or(("", &[][..]), |(l, o)| (l, o));
                self.helpers.extend(others.iter().cloned());
                self.whole = Some(last.to_owned());
                (String::new(), String::new())
            }
            Query::Ran { rule, .. } => {
                self.whole = Some(rule.clone());
                (String::new(), String::new())
            }
            Query::Noted { relation, args } => {
                self.whole = Some(format!("{relation}({})", args.join(", ")));
                (String::new(), String::new())
            }
            Query::Why { .. }
            | Query::WhereAmI
            | Query::People { .. }
            | Query::WhereAreYou(_)
            | Query::Help
            | Query::WhatDoYouSee
            | Query::Done
            | Query::Changed
            | Query::Unseen
            | Query::Sureness
            | Query::WhatDoYouHold
            | Query::Courtesy(_) => (String::new(), String::new()),
        }
    }

    fn is_door(&self, noun: &Noun) -> bool {
        let found = self.knowledge.find(noun, true).unwrap_or_default();
        found.first().is_some_and(|t| self.knowledge.opening(*t).is_some())
    }

    /// A term for a description: a constant for a name, else a variable with its atoms.
    fn noun(&mut self, noun: &Noun) -> String {
        // «Спальня с компьютером», where the one that is called so has none: another of its kind was found.
        let is_named = |t: &Thing| noun.head.named.iter().any(|named| Thing::Entity(*named) == *t);
        let found = || self.knowledge.find(noun, true).unwrap_or_default();
        let of_kind = noun.of_kind().filter(|_| !found().iter().all(is_named));
        let noun = of_kind.as_ref().unwrap_or(noun);
        let named = match (&noun.head.things, &noun.head.named[..]) {
            (Some(things), _) => match things[..] {
                [only] => Some(only),
                _ => None,
            },
            (None, [only]) => Some(Thing::Entity(*only)),
            _ => None,
        };
        if let (Some(only), true) = (named, noun.filters.is_empty() && noun.restrictions.is_empty())
        {
            return self.quoted(only);
        }
        let term = self.variable();
        let is_gates = self.is_gates(noun);
        let gates = std::mem::replace(&mut self.of_gates, is_gates);
        match named {
            Some(only) => {
                let name = self.quoted(only);
                self.atoms.push(format!("{term} = {name}"));
            }
            None => self.kinds(&term, noun),
        }
        for filter in &noun.filters {
            self.filter(&term, filter);
        }
        let at = |r: &Restriction| r.rel == Rel::NextTo && !noun.head.kinds.is_empty();
        self.measured |= !noun.sizes.is_empty() || noun.restrictions.iter().any(at);
        // Sorts at once, the values and sizes of others are looked at after the rule.
        self.measured |= !noun.also.is_empty() || noun.like.is_some() || noun.beyond.is_some();
        for except in &noun.except {
            let before = std::mem::take(&mut self.atoms);
            let other = self.noun(except);
            let body = std::mem::replace(&mut self.atoms, before);
            match body.is_empty() {
                true => self.atoms.push(format!("{term} != {other}")),
                false => self.none_of(&term, &other, &body.join(", ")),
            }
        }
        for restriction in &noun.restrictions {
            self.restriction(&term, restriction);
        }
        self.of_gates = gates;
        term
    }

    fn is_gates(&self, noun: &Noun) -> bool {
        noun.head.kinds.iter().any(|k| {
            let extension = &self.knowledge.lexicon().kind(*k).extension;
            matches!(extension, Extension::Doors | Extension::Passages | Extension::DoorType(_))
        })
    }

    fn kinds(&mut self, term: &str, noun: &Noun) {
        if noun.head.anything {
            // What has a value may be a door as well.
            self.measured |= !noun.filters.is_empty() && noun.restrictions.is_empty();
            self.atoms.push(format!("replica({term}, _, _, _, _)"));
            return;
        }
        let mut choices: Vec<String> = Vec::new();
        let mut add = |atom: String| {
            if !choices.contains(&atom) {
                choices.push(atom);
            }
        };
        for entity in &noun.head.named {
            add(format!("{term} = {}", self.quoted(Thing::Entity(*entity))));
        }
        let things = noun.head.things.iter().flatten().copied();
        for thing in things {
            add(format!("{term} = {}", self.quoted(thing)));
        }
        let world = self.knowledge.world;
        let mut unknown = false;
        for kind in noun.head.kinds.iter().filter(|_| noun.head.named.is_empty()) {
            let instance = self.relation("INSTANCE_OF");
            let has_trait = self.relation("HAS_TRAIT");
            let object = |id: crate::units::ObjectId| {
                let symbols = self.knowledge.relations.symbols();
                let symbol = symbols.symbol(crate::semantics::Subject::Object(id));
                format!("{instance}({term}, \"{symbol}\")")
            };
            match &self.knowledge.lexicon().kind(*kind).extension {
                Extension::ObjectType(id) => {
                    let of_type = world.objects.values().filter(|o| o.object_type == Some(*id));
                    of_type.map(|o| object(o.id)).for_each(&mut add);
                }
                Extension::Object(id) => add(object(*id)),
                Extension::Trait(wanted) => add(format!("{has_trait}({term}, \"{wanted}\")")),
                Extension::Lighting => {
                    add(format!("{has_trait}({term}, \"light\")"));
                    let lights = world.replicas.keys().any(|id| world.has_trait(*id, "light"));
                    let switch = |o: &&crate::map::Object| {
                        let entry = world.types.object.get(o.object_type);
                        !lights && entry.is_some_and(super::lexicon::Lexicon::is_switch)
                    };
                    world.objects.values().filter(switch).map(|o| object(o.id)).for_each(&mut add);
                }
                Extension::Things => add(format!("replica({term}, _, _, _, _)")),
                Extension::Furniture => {
                    add(format!("{}({term})", self.relation("IS_FURNITURE")));
                }
                Extension::Rooms => add(format!("area({term}, _)")),
                Extension::AreaType(id) => {
                    let of_type = world.areas.values().filter(|a| a.area_type == Some(*id));
                    let name =
                        |a: &crate::map::Area| self.quoted(Thing::Entity(Entity::Area(a.id)));
                    of_type.map(|a| format!("{term} = {}", name(a))).for_each(&mut add);
                }
                Extension::DoorType(id) => {
                    let of_type = world.doors.values().filter(|d| d.door_type == Some(*id));
                    let name =
                        |d: &crate::map::Door| self.quoted(Thing::Entity(Entity::Door(d.id)));
                    of_type.map(|d| format!("{term} = {}", name(d))).for_each(&mut add);
                }
                Extension::Doors => add(format!("opening({term}, \"door\", _, _)")),
                Extension::Passages => add(format!("opening({term}, \"passage\", _, _)")),
                Extension::Exits if self.knowledge.is_of_rooms(noun) => {
                    add(format!("opening({term}, _, _, _)"));
                }
                // Of these the facts know nothing.
                Extension::Windows
                | Extension::Lifts
                | Extension::Chargers
                | Extension::Exits
                | Extension::OuterDoors
                | Extension::Places
                | Extension::Storeys
                | Extension::Building
                | Extension::Floor
                | Extension::Walls
                | Extension::Corners
                | Extension::Robot => unknown = true,
                // A part is no thing of the facts; the kinds beside it say what is meant.
                Extension::Part(_) | Extension::Sort(_) => unknown |= noun.head.kinds.len() == 1,
            }
        }
        // A lift is counted once, on however many floors it stops.
        let is_lift = |k: &_| self.knowledge.lexicon().kind(*k).english == "lift";
        self.measured |= unknown || noun.head.kinds.iter().any(is_lift);
        match &choices[..] {
            [] => {}
            [only] => self.atoms.push(only.clone()),
            several => self.atoms.push(format!("({})", several.join(" ; "))),
        }
    }

    fn filter(&mut self, term: &str, filter: &Filter) {
        const STATES: [(DoorStatus, &str); 3] = [
            (DoorStatus::Open, "open"),
            (DoorStatus::Closed, "closed"),
            (DoorStatus::Locked, "locked"),
        ];
        let values = &self.knowledge.lexicon().values;
        // Whether anything is in or on a thing is looked at, unless the map says so of it.
        if values.entry(filter.value).is_emptiness()
            && self.knowledge.spellings(filter.value).is_empty()
        {
            self.measured = true;
            return;
        }
        let not = if filter.negated { "!" } else { "" };
        let mut atoms: Vec<String> = Vec::new();
        let mut by_value = false;
        for value in filter.values() {
            let states: Vec<&str> = STATES
                .iter()
                .filter(|(s, _)| values.of_door(*s).is_some_and(|v| values.is(v, value)))
                .map(|(_, word)| *word)
                .collect();
            if states.is_empty() {
                by_value = true;
                let has = self.relation("HAS");
                let spellings = self.knowledge.spellings(value).into_iter();
                atoms.extend(spellings.map(|word| format!("{not}{has}({term}, _, \"{word}\")")));
            } else {
                let door = self.relation("DOOR_IS");
                atoms.extend(states.iter().map(|word| format!("{not}{door}({term}, \"{word}\")")));
            }
        }
        // Only of what the map gives the property is it said that it is not so.
        if filter.negated && by_value {
            let has = self.relation("HAS");
            let property = &values.entry(filter.value).property;
            let names = self.knowledge.property_names(property).into_iter();
            let known: Vec<String> =
                names.map(|name| format!("{has}({term}, \"{name}\", _)")).collect();
            if !known.is_empty() {
                self.atoms.push(format!("({})", known.join(" ; ")));
            }
        }
        match (&atoms[..], filter.negated) {
            ([], _) => {}
            ([only], _) => self.atoms.push(only.clone()),
            (all, true) => self.atoms.extend(all.iter().cloned()),
            (all, false) => self.atoms.push(format!("({})", all.join(" ; "))),
        }
    }

    fn restriction(&mut self, term: &str, restriction: &Restriction) {
        let Some(anchor) = restriction.anchors.first() else { return };
        if self.knowledge.is_floor(anchor) {
            self.atoms.push(format!("{}({term}, _)", self.relation("STANDS_ON_FLOOR")));
            return;
        }
        self.measured |= restriction.anchors.iter().any(|a| self.is_measured(restriction.rel, a));
        // How many there are is counted after the rule.
        self.measured |= restriction.anchors.iter().any(|a| a.count.is_some());
        // Rooms stand in the facts with their storeys, things by their rooms alone.
        if self.knowledge.find(anchor, true).is_ok_and(|found| found.iter().any(Thing::is_storey)) {
            self.measured = true;
            return;
        }
        // Of several the biggest, or the top shelf, is looked for after the rule.
        self.measured |= restriction.anchors.iter().any(|a| a.best.is_some() || a.rank.is_some());
        if restriction.rel == Rel::Between && !self.of_gates {
            self.measured = true;
            return;
        }
        if restriction.rel == Rel::Between {
            let ends: Vec<String> = restriction.anchors.iter().map(|a| self.noun(a)).collect();
            let joins = self.relation("JOINS");
            self.atoms.push(format!("{joins}({term}, {})", ends.join(", ")));
            return;
        }
        if !restriction.negated {
            let before = std::mem::take(&mut self.atoms);
            let mut choices: Vec<String> = Vec::new();
            for anchor in &restriction.anchors {
                let other = self.noun(anchor);
                self.related(restriction.rel, term, &other, self.is_room(anchor));
                choices.push(std::mem::take(&mut self.atoms).join(", "));
            }
            self.atoms = before;
            choices.retain(|choice| !choice.is_empty());
            match &choices[..] {
                [] => {}
                [only] => self.atoms.push(only.clone()),
                // «в спальне и коридоре»: in either of them.
                several => self.atoms.push(format!("({})", several.join(" ; "))),
            }
            return;
        }
        // "no wardrobe" speaks of all wardrobes: a relation of its own says which rooms have one.
        // «Без кроватей и диванов» has none of either.
        for anchor in &restriction.anchors {
            let before = std::mem::take(&mut self.atoms);
            let other = self.noun(anchor);
            self.related(restriction.rel, term, &other, self.is_room(anchor));
            let body = std::mem::replace(&mut self.atoms, before).join(", ");
            self.none_of(term, term, &body);
        }
    }

    /// That a term is none of those of which a body speaks: they get a relation of their own.
    fn none_of(&mut self, term: &str, those: &str, body: &str) {
        let name = self.knowledge.pick("есть", "has_one");
        let name = match self.helpers.len() {
            0 => name.to_owned(),
            n => format!("{name}_{n}"),
        };
        self.helpers.push(format!(".decl {name}(x: Any)\n{name}({those}) :- {body}."));
        self.atoms.push(format!("!{name}({term})"));
    }

    /// Whether a restriction is answered by measuring, so that no relation says the same.
    fn is_measured(&self, rel: Rel, anchor: &Noun) -> bool {
        let things = self.knowledge.find(anchor, true).unwrap_or_default();
        let no_body = |t: &Thing| {
            matches!(
                t,
                Thing::Robot
                    | Thing::Window(_)
                    | Thing::Opening(_)
                    | Thing::Entity(Entity::Door(_) | Entity::Place(_))
            )
        };
        match rel {
            Rel::Outside => true,
            Rel::Between => !things.iter().all(|t| t.area().is_some()),
            Rel::LeftOf | Rel::RightOf | Rel::Behind | Rel::InFrontOf => things
                .iter()
                .any(|t| no_body(t) || self.knowledge.frame(*t) == super::knowledge::Frame::Viewer),
            Rel::Near | Rel::NextTo | Rel::At | Rel::Under => things.iter().any(no_body),
            _ => false,
        }
    }

    /// Whether a description is of rooms.
    fn is_room(&self, noun: &Noun) -> bool {
        let things = self.knowledge.find(noun, true).unwrap_or_default();
        things.first().is_some_and(|t| t.area().is_some())
    }

    fn related(&mut self, rel: Rel, term: &str, other: &str, of_room: bool) {
        let joins = self.relation("JOINS");
        match rel {
            // "rooms that lead to the corridor"
            Rel::To if of_room && !self.of_gates => {
                return self.atoms.push(format!("{joins}(_, {term}, {other})"));
            }
            // Doors are in the rooms that they join; one that leads out of the map stands in its room only.
            Rel::From | Rel::To | Rel::Through => {
                let atom = format!("({joins}({term}, {other}, _) ; mounts({term}, {other}))");
                return self.atoms.push(atom);
            }
            Rel::In | Rel::On | Rel::Of | Rel::At if of_room && self.of_gates => {
                let atom = format!("({joins}({term}, {other}, _) ; mounts({term}, {other}))");
                return self.atoms.push(atom);
            }
            Rel::Near | Rel::NextTo if of_room => {
                return self.atoms.push(format!("{joins}(_, {term}, {other})"));
            }
            _ => {}
        }
        let rel = if of_room && matches!(rel, Rel::On | Rel::Of | Rel::At) { Rel::In } else { rel };
        let atom = |basis: &super::knowledge::Basis| {
            let name = self.relation(basis.relation);
            let (a, b) = if basis.swapped { (other, term) } else { (term, other) };
            let shelves = match basis.of_support {
                true => format!(", {}({other}, \"shelves\")", self.relation("HAS_TRAIT")),
                false => String::new(),
            };
            format!("{name}({a}, {b}){shelves}")
        };
        let atoms: Vec<String> = bases(rel).iter().map(atom).collect();
        match &atoms[..] {
            [] => self.measured = true,
            // What is behind a wall is not near.
            [only] if rel == Rel::Near => {
                let (only, room) = (only.clone(), self.variable());
                self.atoms
                    .push(format!("{only}, in_area({term}, {room}), in_area({other}, {room})"));
            }
            [only] => self.atoms.push(only.clone()),
            all => self.atoms.push(format!("({})", all.join(" ; "))),
        }
    }
}
