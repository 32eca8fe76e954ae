//! The statements of one language, checked: every category has a type, every variable a use, no frame swallows a word
//! that carries a meaning.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use super::fault::{LangError, LangFault, LangFaults};
use super::features::Features;
use super::file::{self, Element, ElementKind, Expr, Left, Name, Repeat, Rule, Statement, Word};
use super::forms::{check_forms, forms_of};
use super::grammar::{
    Category, Entry, Frame, Grammar, OF_THE_MAP, Overload, Phrase, Role, Slot, Tongue,
};
use super::paraphrase;
use super::sense::{Function, Meaning, Type};
use super::term::{Dimension, RoleId, Sorts};
use crate::language::paraphrase::Paraphrases;
use crate::language::question::Property;
use crate::units::{Source, nearest_name};

/// The sentences that a language must have, and the parts that they may name.
const SENTENCES: [&str; 12] = [
    "things",
    "no_things",
    "yes",
    "no",
    "number",
    "length",
    "distance",
    "area",
    "place",
    "values",
    "unknown",
    "and",
];
impl Grammar {
    /// The grammar of files, each by its path within `rules/language`: a folder is a language, what stands in none is
    /// for all. A statement with a fault is left out; all faults come with the grammar of the rest.
    #[must_use]
    pub fn of(files: &[(&str, Source)]) -> (Self, Option<LangFaults>) {
        let mut faults = Vec::new();
        let mut paraphrases = Paraphrases::default();
        let mut by_folder: BTreeMap<String, Vec<(Source, Vec<Statement>)>> = BTreeMap::new();
        for (path, source) in files {
            let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
            let statements = file::read(source, &mut faults);
            for statement in &statements {
                if let Statement::Paraphrase(at) = statement
                    && let Err(error) = paraphrase::add(&mut paraphrases, path, source, at)
                {
                    faults.push(LangFault { error: error.into(), file: source.clone() });
                }
            }
            by_folder.entry(folder.to_owned()).or_default().push((source.clone(), statements));
        }
        let mut grammar = Self {
            roles: Vec::new(),
            signatures: Vec::new(),
            tongues: BTreeMap::new(),
            paraphrases: Arc::default(),
        };
        let all = by_folder.values().flatten();
        for (source, statement) in
            all.flat_map(|(source, all)| all.iter().map(move |s| (source, s)))
        {
            if let Statement::Role { name, parameters, bodies, needs } = statement
                && let Err(error) = grammar.add_role(name, parameters, bodies, needs.as_ref())
            {
                faults.push(LangFault { error, file: source.clone() });
            }
        }
        for (folder, statements) in by_folder.into_iter().filter(|(folder, _)| !folder.is_empty()) {
            let tongue = Building::of(&grammar.roles, &statements, &mut faults);
            grammar.tongues.insert(folder, tongue);
        }
        grammar.paraphrases = Arc::new(paraphrases);
        let faults = (!faults.is_empty()).then_some(LangFaults { faults });
        (grammar, faults)
    }

    fn add_role(
        &mut self,
        name: &Name,
        parameters: &[(Name, Vec<Name>)],
        bodies: &[String],
        needs: Option<&String>,
    ) -> Result<(), LangError> {
        let mut sorts = Vec::new();
        for (_, types) in parameters {
            let mut of = Sorts::NONE;
            for one in types {
                let names = ["Thing", "Area", "Opening", "Point", "Storey", "Any"];
                of = of
                    | Sorts::named(&one.text)
                        .ok_or_else(|| unknown(("тип", "type"), one, names))?;
            }
            sorts.push(of);
        }
        let variables = parameters.iter().map(|(name, _)| name.text.clone()).collect();
        let (bodies, needs) = (bodies.to_vec(), needs.cloned());
        let overload = Overload { variables, sorts: sorts.clone(), bodies, needs };
        match self.roles.iter().position(|role| role.name == name.text) {
            Some(at) => {
                self.roles[at].overloads.push(overload);
                self.signatures[at].push(sorts);
            }
            None => {
                self.roles.push(Role { name: name.text.clone(), overloads: vec![overload] });
                self.signatures.push(vec![sorts]);
            }
        }
        Ok(())
    }
}

/// A name that nothing declares, with the nearest that something does.
fn unknown<'n>(
    what: (&'static str, &'static str),
    name: &Name,
    known: impl IntoIterator<Item = &'n str>,
) -> LangError {
    let nearest = nearest_name(&name.text, known).map(str::to_owned);
    LangError::Unknown {
        what: what.into(),
        name: name.text.clone(),
        nearest,
        at: name.at.clone().into(),
    }
}

/// A language while its statements are checked.
struct Building<'g> {
    roles: &'g [Role],
    categories: Vec<(String, Option<Type>)>,
    reserved: HashMap<String, ()>,
    patterns: HashMap<String, String>,
    tongue: Tongue,
}

type Checked<T> = Result<T, LangError>;

impl<'g> Building<'g> {
    /// The language of these files; the faults of their statements.
    pub(super) fn of(
        roles: &'g [Role],
        files: &[(Source, Vec<Statement>)],
        faults: &mut Vec<LangFault>,
    ) -> Tongue {
        let known = OF_THE_MAP.map(|(name, of)| (name.to_owned(), Some(of)));
        let mut building = Self {
            roles,
            categories: known.to_vec(),
            reserved: HashMap::new(),
            patterns: HashMap::new(),
            tongue: Tongue::default(),
        };
        building.declare(files);
        for (source, statements) in files {
            for statement in statements {
                if let Err(error) = building.add(statement, source) {
                    faults.push(LangFault { error, file: source.clone() });
                }
            }
        }
        building.tongue
    }

    /// Gives every category on the left of a rule its type, which may rest on that of others.
    fn declare(&mut self, files: &[(Source, Vec<Statement>)]) {
        let all = || files.iter().flat_map(|(_, all)| all);
        let rules = || {
            all().filter_map(|statement| match statement {
                Statement::Rule(rule) => match &rule.left {
                    Left::Category(name) => Some((rule, name)),
                    Left::Form(_) => None,
                },
                _ => None,
            })
        };
        for (_, name) in rules() {
            if self.category(&name.text).is_none() {
                self.categories.push((name.text.clone(), None));
            }
        }
        loop {
            let mut is_fixpoint = true;
            for (rule, name) in rules() {
                let at = self.category(&name.text).expect("it was just declared");
                if self.categories[usize::from(at)].1.is_some() {
                    continue;
                }
                let of = match &rule.meaning {
                    None => Some(Type::Nothing),
                    Some(meaning) => rule.patterns.iter().find_map(|pattern| {
                        // By a rule over what has no type yet nothing is known.
                        if !pattern.iter().all(|element| self.is_typed(element)) {
                            return None;
                        }
                        let variables = self.variables(pattern).ok()?;
                        self.check(meaning, &variables).ok().map(|(_, of)| of)
                    }),
                };
                if of.is_some() {
                    self.categories[usize::from(at)].1 = of;
                    is_fixpoint = false;
                }
            }
            if is_fixpoint {
                break;
            }
        }
        // What a frame may not swallow.
        for statement in all() {
            let Statement::Reserved(names) = statement else { continue };
            let is_one = |name: &Name| names.iter().any(|reserved| reserved.text == name.text);
            for (rule, _) in rules().filter(|(_, name)| is_one(name)) {
                for words in rule.patterns.iter().filter_map(|pattern| as_words(pattern)) {
                    if let [only] = words {
                        self.reserved.insert(only.name.text.clone(), ());
                    }
                }
            }
        }
    }

    fn is_typed(&self, element: &Element) -> bool {
        match &element.kind {
            ElementKind::Words(_) => true,
            ElementKind::Part { category, .. } => {
                let own = self.categories.iter().find(|(name, _)| *name == category.text);
                own.is_some_and(|(_, of)| of.is_some())
            }
        }
    }

    fn category(&self, name: &str) -> Option<Category> {
        let at = self.categories.iter().position(|(known, _)| known == name)?;
        Category::try_from(at).ok()
    }

    fn category_of(&self, name: &Name) -> Checked<(Category, Type)> {
        let names = self.categories.iter().map(|(known, _)| known.as_str());
        let at = self
            .category(&name.text)
            .ok_or_else(|| unknown(("категория", "category"), name, names))?;
        let of = self.categories[usize::from(at)].1;
        // A category whose only rule is at fault is told of there.
        Ok((at, of.unwrap_or(Type::Nothing)))
    }

    /// The variables of a pattern with their types, in order.
    fn variables(&self, pattern: &[Element]) -> Checked<Vec<(String, Type)>> {
        let mut found = Vec::new();
        for element in pattern {
            if let ElementKind::Part { variable: Some(name), category, .. } = &element.kind {
                found.push((name.text.clone(), self.category_of(category)?.1));
            }
        }
        Ok(found)
    }

    fn add(&mut self, statement: &Statement, source: &Source) -> Checked<()> {
        match statement {
            Statement::Role { .. } | Statement::Paraphrase(_) => {}
            Statement::Order { free } => self.tongue.free = *free,
            Statement::Say { name, text } => {
                if !SENTENCES.contains(&name.text.as_str()) {
                    return Err(unknown(("ответ", "answer"), name, SENTENCES));
                }
                self.tongue.says.insert(name.text.clone(), text.clone());
            }
            Statement::Reserved(names) => {
                for name in names {
                    let (category, _) = self.category_of(name)?;
                    self.tongue.reserved.push(category);
                }
            }
            Statement::Skip { loose, words } => {
                for run in words {
                    let run: Vec<String> =
                        run.iter().map(|w| crate::units::name_key(&w.text)).collect();
                    let first = run[0].clone();
                    self.tongue.skipped.entry(first).or_default().push((run, u32::from(*loose)));
                }
            }
            Statement::Rule(rule) => match &rule.left {
                Left::Form(name) => self.frame(rule, name, source)?,
                Left::Category(name) => {
                    for pattern in &rule.patterns {
                        match as_words(pattern) {
                            Some(words) => self.entry(rule, name, words)?,
                            None => self.phrase(rule, name, pattern)?,
                        }
                    }
                }
            },
        }
        Ok(())
    }

    fn meaning(
        &self,
        rule: &Rule,
        variables: &[(String, Type)],
        wanted: Type,
        at: &Name,
    ) -> Checked<Meaning> {
        let Some(meaning) = &rule.meaning else { return Ok(Meaning::Nothing) };
        let (meaning, found) = self.check(meaning, variables)?;
        if found == wanted { Ok(meaning) } else { Err(mismatch(at, found, wanted)) }
    }

    fn entry(&mut self, rule: &Rule, name: &Name, words: &[Word]) -> Checked<()> {
        let (category, of) = self.category_of(name)?;
        let meaning = self.meaning(rule, &[], of, name)?;
        let mut keys: Vec<(String, Features)> = vec![(String::new(), Features::ALL)];
        for word in words {
            check_forms(word)?;
            let forms = forms_of(word);
            let joined = |(key, features): &(String, Features),
                          (form, own): &(String, Features)| {
                let key = if key.is_empty() { form.clone() } else { format!("{key} {form}") };
                (key, *features & *own)
            };
            let all = keys.iter().flat_map(|key| forms.iter().map(move |form| joined(key, form)));
            keys = all.collect();
        }
        if let (Meaning::Known(known), Some((word, _))) = (&meaning, keys.first()) {
            self.tongue.qualities.push((known.clone(), word.clone()));
        }
        for (key, features) in keys.into_iter().filter(|(_, f)| !f.is_empty()) {
            self.tongue.longest = self.tongue.longest.max(key.split(' ').count());
            let entry = Entry { category, features, cost: rule.cost, meaning: meaning.clone() };
            self.tongue.words.entry(key).or_default().push(entry);
        }
        Ok(())
    }

    fn phrase(&mut self, rule: &Rule, name: &Name, pattern: &[Element]) -> Checked<()> {
        let (category, of) = self.category_of(name)?;
        let variables = self.variables(pattern)?;
        let meaning = self.meaning(rule, &variables, of, name)?;
        let slots = self.slots(pattern, rule.meaning.as_ref())?;
        if let Some((at, _)) = slots
            .iter()
            .enumerate()
            .find(|(_, (_, repeat))| matches!(repeat, Repeat::Any | Repeat::Some))
        {
            let at = place_of(&pattern[at]);
            return Err(LangError::Syntax {
                expected: (
                    "часть без «*»: повторы – дело оборотов",
                    "a part without “*”: repetitions belong into phrases",
                )
                    .into(),
                at: at.into(),
            });
        }
        let head = rule.meaning.as_ref().and_then(first_variable);
        let slot_of = |name: &str| {
            pattern.iter().position(|element| match &element.kind {
                ElementKind::Part { variable: Some(own), .. } => own.text == name,
                _ => false,
            })
        };
        let mut agree = Vec::new();
        for name in &rule.agree {
            let names = variables.iter().map(|(name, _)| name.as_str());
            agree.push(
                slot_of(&name.text)
                    .ok_or_else(|| unknown(("переменная", "variable"), name, names))?,
            );
        }
        let head = head.and_then(slot_of);
        // With and without each of what may be left out.
        let optional: Vec<usize> =
            (0..slots.len()).filter(|n| slots[*n].1 == Repeat::Optional).collect();
        for left_out in 0..1_u32 << optional.len().min(6) {
            let is_out = |n: &usize| {
                optional.iter().position(|o| o == n).is_some_and(|bit| left_out & 1 << bit != 0)
            };
            let kept: Vec<usize> = (0..slots.len()).filter(|n| !is_out(n)).collect();
            let place = |n: usize| kept.iter().position(|k| *k == n);
            if kept.is_empty() {
                continue;
            }
            self.tongue.rules.push(Phrase {
                category,
                parts: kept.iter().map(|n| slots[*n].0.clone()).collect(),
                agree: agree.iter().filter_map(|n| place(*n)).collect(),
                head: head.and_then(place),
                cost: rule.cost,
                meaning: meaning.clone(),
                variables: variables.len(),
            });
        }
        Ok(())
    }

    fn frame(&mut self, rule: &Rule, name: &Name, source: &Source) -> Checked<()> {
        for pattern in &rule.patterns {
            let variables = self.variables(pattern)?;
            let meaning = self.meaning(rule, &variables, Type::Form, name)?;
            let parts = self.slots(pattern, rule.meaning.as_ref())?;
            let at = || (name.at.start, name.at.len()).into();
            if parts.iter().all(|(_, repeat)| matches!(repeat, Repeat::Optional | Repeat::Any)) {
                return Err(LangError::NothingRequired { at: at() });
            }
            for element in pattern {
                let ElementKind::Words(choices) = &element.kind else { continue };
                for word in choices.iter().flatten() {
                    if self.reserved.contains_key(&word.name.text) {
                        let (word, at) = (word.name.text.clone(), word.name.at.clone().into());
                        return Err(LangError::Reserved { word, at });
                    }
                }
            }
            let (own, says) = (format!("{parts:?}"), format!("{meaning:?}"));
            if self.patterns.insert(own, says.clone()).is_some_and(|other| other != says) {
                return Err(LangError::Twice { at: at() });
            }
            for (slot, _) in &parts {
                let Slot::Words(runs) = slot else { continue };
                self.tongue.literals.extend(runs.iter().flatten().cloned());
            }
            let (line, _) = source.position(name.at.start);
            let place = format!("{}:{line}", source.name());
            let variables = variables.len();
            self.tongue.frames.push(Frame { parts, cost: rule.cost, meaning, variables, place });
        }
        Ok(())
    }

    fn slots(&self, pattern: &[Element], meaning: Option<&Expr>) -> Checked<Vec<(Slot, Repeat)>> {
        let mut slots = Vec::new();
        let mut variables: Vec<&str> = Vec::new();
        for element in pattern {
            let slot = match &element.kind {
                ElementKind::Words(choices) => {
                    choices.iter().flatten().try_for_each(check_forms)?;
                    let keys = |run: &Vec<Word>| {
                        run.iter().fold(vec![Vec::new()], |runs: Vec<Vec<String>>, word| {
                            let forms = forms_of(word);
                            let longer = |run: &Vec<String>| {
                                let run = run.clone();
                                let add = move |(form, _): (String, Features)| {
                                    run.iter().cloned().chain([form]).collect()
                                };
                                forms.clone().into_iter().map(add).collect::<Vec<_>>()
                            };
                            runs.iter().flat_map(longer).collect()
                        })
                    };
                    Slot::Words(choices.iter().flat_map(keys).collect())
                }
                ElementKind::Part { variable, category, features } => {
                    let (at, of) = self.category_of(category)?;
                    let is_used = |name: &Name| meaning.is_some_and(|m| uses(m, &name.text));
                    // A part that means something is part of the meaning.
                    let lost = match variable {
                        Some(name) => (!is_used(name) && of != Type::Nothing).then_some(name),
                        None => (of != Type::Nothing).then_some(category),
                    };
                    if let Some(lost) = lost {
                        let at = (lost.at.start, lost.at.len()).into();
                        return Err(LangError::OneSide { name: lost.text.clone(), at });
                    }
                    let number = match variable {
                        None => None,
                        Some(name) => {
                            let at = (name.at.start, name.at.len()).into();
                            let other = (
                                "имя, которого в образце ещё нет",
                                "a name that the pattern does not have yet",
                            );
                            let few = (
                                "не больше 255 имён в образце",
                                "no more than 255 names in a pattern",
                            );
                            let is_new = !variables.contains(&name.text.as_str());
                            let number = u8::try_from(variables.len()).ok().filter(|_| is_new);
                            let expected = if is_new { few } else { other };
                            variables.push(&name.text);
                            Some(
                                number
                                    .ok_or(LangError::Syntax { expected: expected.into(), at })?,
                            )
                        }
                    };
                    Slot::Part { category: at, features: *features, variable: number }
                }
            };
            slots.push((slot, element.repeat));
        }
        Ok(slots)
    }

    fn check(&self, expr: &Expr, variables: &[(String, Type)]) -> Checked<(Meaning, Type)> {
        let variable = |name: &Name| {
            let at = variables.iter().position(|(own, _)| *own == name.text)?;
            Some((Meaning::Variable(u8::try_from(at).ok()?), variables[at].1))
        };
        let role = |name: &Name| {
            let at = self.roles.iter().position(|role| role.name == name.text)?;
            Some((RoleId(u16::try_from(at).ok()?), &self.roles[at]))
        };
        match expr {
            Expr::Number(number) => Ok((Meaning::Number(*number), Type::Number)),
            Expr::Name(name) => {
                if let Some(found) = variable(name) {
                    return Ok(found);
                }
                let names = self.roles.iter().map(|role| role.name.as_str());
                let (id, role) = role(name).ok_or_else(|| unknown(("имя", "name"), name, names))?;
                Ok(match role.overloads.iter().all(|o| o.sorts.len() == 1) {
                    true => (Meaning::Said(id), Type::Mods),
                    false => (Meaning::Role(id), Type::Role),
                })
            }
            Expr::And(parts) => {
                let mut all = Vec::new();
                let mut of = Type::Nothing;
                for part in parts {
                    let (meaning, own) = self.check(part, variables)?;
                    of = match (of, own) {
                        (Type::Nothing, own) => own,
                        (Type::Desc | Type::Mods, Type::Mods) => of,
                        _ => return Err(mismatch(&name_of(part), own, Type::Mods)),
                    };
                    all.push(meaning);
                }
                Ok((Meaning::And(all), of))
            }
            Expr::Call(name, arguments) => {
                if let ("any", [Expr::Name(sort)]) = (name.text.as_str(), &arguments[..]) {
                    let names = ["Thing", "Area", "Opening", "Point", "Storey", "Any"];
                    let sorts = Sorts::named(&sort.text)
                        .ok_or_else(|| unknown(("тип", "type"), sort, names))?;
                    return Ok((Meaning::Any(sorts), Type::Desc));
                }
                if let ("most" | "least", [Expr::Name(of)]) = (name.text.as_str(), &arguments[..]) {
                    let dimension = Dimension::named(&of.text).ok_or_else(|| {
                        unknown(("мера", "measure"), of, Dimension::NAMES.map(|(n, _)| n))
                    })?;
                    return Ok((Meaning::Measure(dimension, name.text == "most"), Type::Measure));
                }
                if let ("property", [Expr::Name(of)]) = (name.text.as_str(), &arguments[..]) {
                    return Ok((Meaning::Property(Property::of(&of.text)), Type::Property));
                }
                // «kind(dining_table)»: a name within one word of the file.
                if let ("kind" | "quality", [Expr::Name(of)]) = (name.text.as_str(), &arguments[..])
                {
                    let known = of.text.replace('_', " ");
                    // A word may be one; what is made of parts has the word as a part.
                    if !variables.is_empty() {
                        let at = (name.at.start, name.at.len()).into();
                        return Err(LangError::Syntax {
                            expected: ("часть, а не имя вида", "a part, and no name of a form")
                                .into(),
                            at,
                        });
                    }
                    return Ok(match name.text.as_str() {
                        "kind" => (Meaning::Kind(known), Type::Desc),
                        _ => (Meaning::Known(known), Type::Mods),
                    });
                }
                let mut checked = Vec::new();
                for argument in arguments {
                    checked.push(self.check(argument, variables)?);
                }
                let applied = match (variable(name), role(name)) {
                    (Some((meaning, Type::Role)), _) => Some(meaning),
                    (None, Some((id, _))) => Some(Meaning::Role(id)),
                    _ => None,
                };
                let wanted = |n: usize, wanted: Type| match checked.get(n) {
                    Some((_, found)) if *found != wanted => {
                        Err(mismatch(&name_of(&arguments[n]), *found, wanted))
                    }
                    _ => Ok(()),
                };
                if let Some(role) = applied {
                    (0..checked.len()).try_for_each(|n| wanted(n, Type::Desc))?;
                    let arguments = checked.into_iter().map(|(meaning, _)| meaning).collect();
                    return Ok((Meaning::Apply(Box::new(role), arguments), Type::Mods));
                }
                let known = Function::NAMES.iter().find(|(own, _)| *own == name.text);
                let names = Function::NAMES.iter().map(|(own, _)| *own);
                let (_, function) =
                    known.ok_or_else(|| unknown(("функция", "function"), name, names))?;
                let (takes, gives) = function.signature();
                let least = takes.len() - function.optional();
                if checked.len() < least || checked.len() > takes.len() {
                    let at = (name.at.start, name.at.len()).into();
                    return Err(LangError::Syntax {
                        expected: ("другое число аргументов", "another number of arguments").into(),
                        at,
                    });
                }
                takes.iter().enumerate().try_for_each(|(n, of)| wanted(n, *of))?;
                let arguments = checked.into_iter().map(|(meaning, _)| meaning).collect();
                Ok((Meaning::Call(*function, arguments), gives))
            }
        }
    }
}

fn mismatch(name: &Name, found: Type, wanted: Type) -> LangError {
    LangError::Type {
        name: name.text.clone(),
        found: found.word(),
        wanted: wanted.word(),
        at: (name.at.start, name.at.len()).into(),
    }
}

fn name_of(expr: &Expr) -> Name {
    match expr {
        Expr::Name(name) | Expr::Call(name, _) => name.clone(),
        Expr::And(parts) => name_of(&parts[0]),
        Expr::Number(number) => Name { text: number.to_string(), at: 0..0 },
    }
}

fn uses(expr: &Expr, variable: &str) -> bool {
    match expr {
        Expr::Name(name) => name.text == variable,
        Expr::Call(name, all) => name.text == variable || all.iter().any(|e| uses(e, variable)),
        Expr::And(all) => all.iter().any(|e| uses(e, variable)),
        Expr::Number(_) => false,
    }
}

/// The part that a phrase is a phrase of: the first that its meaning speaks of, a preposition in `r(n)`.
fn first_variable(expr: &Expr) -> Option<&str> {
    match expr {
        Expr::Name(name) => Some(&name.text),
        Expr::And(parts) => first_variable(&parts[0]),
        Expr::Call(_, arguments) => arguments.iter().rev().find_map(first_variable),
        Expr::Number(_) => None,
    }
}

/// A pattern of nothing but one run of words.
fn as_words(pattern: &[Element]) -> Option<&[Word]> {
    match pattern {
        [Element { kind: ElementKind::Words(choices), repeat: Repeat::Once }] => match &choices[..]
        {
            [only] => Some(only),
            _ => None,
        },
        _ => None,
    }
}

fn place_of(element: &Element) -> std::ops::Range<usize> {
    match &element.kind {
        ElementKind::Words(choices) => choices[0][0].name.at.clone(),
        ElementKind::Part { category, .. } => category.at.clone(),
    }
}
