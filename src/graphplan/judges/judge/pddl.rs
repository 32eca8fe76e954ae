//! PDDL as the judge reads it: words and brackets.

use super::{Action, Atom, Condition, Effect, Given, Moment, Typed};

/// A word or a list in brackets.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Form {
    Word(String),
    List(Vec<Self>),
}

type Read<T> = Result<T, String>;

impl Form {
    fn word(&self) -> Read<&str> {
        match self {
            Self::Word(word) => Ok(word),
            Self::List(_) => Err(format!("a word is wanted: {self:?}")),
        }
    }

    fn list(&self) -> Read<&[Self]> {
        match self {
            Self::List(list) => Ok(list),
            Self::Word(_) => Err(format!("a list is wanted: {self:?}")),
        }
    }

    fn head(&self) -> &str {
        match self {
            Self::List(list) => list.first().and_then(|first| first.word().ok()).unwrap_or(""),
            Self::Word(_) => "",
        }
    }
}

/// Case is all that names may differ in and be the same.
fn key(word: &str) -> String {
    word.to_lowercase()
}

fn forms(text: &str) -> Read<Vec<Form>> {
    let mut open = vec![Vec::new()];
    let without_comments: String = text
        .lines()
        .map(|line| line.split(';').next().unwrap_or_default().to_owned() + "\n")
        .collect();
    let spaced = without_comments.replace('(', " ( ").replace(')', " ) ");
    for word in spaced.split_whitespace() {
        match word {
            "(" => open.push(Vec::new()),
            ")" => {
                let list = open.pop().ok_or("a bracket too many")?;
                open.last_mut().ok_or("a bracket too many")?.push(Form::List(list));
            }
            word => open.last_mut().ok_or("a bracket too many")?.push(Form::Word(key(word))),
        }
    }
    match (open.pop(), open.is_empty()) {
        (Some(forms), true) => Ok(forms),
        _ => Err("a bracket is open".to_owned()),
    }
}

/// `a b - kind c - other` as names with their kinds.
fn typed(forms: &[Form]) -> Read<Typed> {
    let (mut all, mut names) = (Vec::new(), Vec::new());
    let mut forms = forms.iter();
    while let Some(form) = forms.next() {
        if *form == Form::Word("-".to_owned()) {
            let kinds = match forms.next().ok_or("a kind follows")? {
                Form::Word(kind) => vec![kind.clone()],
                Form::List(either) => either[1..]
                    .iter()
                    .map(|kind| kind.word().map(str::to_owned))
                    .collect::<Read<_>>()?,
            };
            all.extend(names.drain(..).map(|name| (name, kinds.clone())));
        } else {
            names.push(form.word()?.to_owned());
        }
    }
    all.extend(names.into_iter().map(|name| (name, Vec::new())));
    Ok(all)
}

fn atom(form: &Form) -> Read<Atom> {
    form.list()?.iter().map(|word| word.word().map(str::to_owned)).collect()
}

fn condition(form: &Form) -> Read<Condition> {
    let list = form.list()?;
    let parts = || list[1..].iter().map(condition).collect::<Read<Vec<_>>>();
    let one = |at: usize| list.get(at).ok_or_else(|| format!("cut short: {form:?}"));
    Ok(match form.head() {
        "" if list.is_empty() => Condition::All(Vec::new()),
        "and" => Condition::All(parts()?),
        "or" => Condition::Any(parts()?),
        "not" => Condition::Not(Box::new(condition(one(1)?)?)),
        "imply" => {
            let unless = Condition::Not(Box::new(condition(one(1)?)?));
            Condition::Any(vec![unless, condition(one(2)?)?])
        }
        "=" => Condition::Equal(one(1)?.word()?.to_owned(), one(2)?.word()?.to_owned()),
        "forall" => Condition::Every(typed(one(1)?.list()?)?, Box::new(condition(one(2)?)?)),
        "exists" => Condition::Some(typed(one(1)?.list()?)?, Box::new(condition(one(2)?)?)),
        "preference" | "when" | "<" | "<=" | ">" | ">=" => {
            return Err(format!("not for this judge: {form:?}"));
        }
        _ => Condition::Holds(atom(form)?),
    })
}

fn effects(form: &Form, around: &Effect, into: &mut Vec<Effect>) -> Read<()> {
    let list = form.list()?;
    let one = |at: usize| list.get(at).ok_or_else(|| format!("cut short: {form:?}"));
    let with = |adds: bool, atom: Atom| Effect { adds, atom, ..around.clone() };
    match form.head() {
        "" | "increase" => {}
        "and" => list[1..].iter().try_for_each(|part| effects(part, around, into))?,
        "not" => into.push(with(false, atom(one(1)?)?)),
        "forall" => {
            let mut variables = around.variables.clone();
            variables.extend(typed(one(1)?.list()?)?);
            effects(one(2)?, &Effect { variables, ..around.clone() }, into)?;
        }
        "when" => {
            let both = vec![around.condition.clone(), condition(one(1)?)?];
            let around = Effect { condition: Condition::All(both), ..around.clone() };
            effects(one(2)?, &around, into)?;
        }
        "assign" | "decrease" | "scale-up" | "scale-down" => {
            return Err(format!("not for this judge: {form:?}"));
        }
        _ => into.push(with(true, atom(form)?)),
    }
    Ok(())
}

/// An effect whatever is so, of which the fact is left out.
fn plain() -> Effect {
    let condition = Condition::All(Vec::new());
    Effect { variables: Vec::new(), condition, adds: true, atom: Vec::new() }
}

/// Parts of a condition, or of an effect, each with its time.
fn timed(form: &Form, is_asked: bool, action: &mut Action) -> Read<()> {
    let list = form.list()?;
    if list.is_empty() || form.head() == "and" {
        return list.iter().skip(1).try_for_each(|part| timed(part, is_asked, action));
    }
    let [time, moment, what] = list else { return Err(format!("no time: {form:?}")) };
    let ask = |place: &mut Condition| -> Read<()> {
        *place = Condition::All(vec![place.clone(), condition(what)?]);
        Ok(())
    };
    match (time.word()?, moment.word()?, is_asked) {
        ("at", "start", true) => ask(&mut action.start.precondition),
        ("over", "all", true) => ask(&mut action.throughout),
        ("at", "end", true) => ask(&mut action.end.precondition),
        ("at", "start", false) => effects(what, &plain(), &mut action.start.effects),
        ("at", "end", false) => effects(what, &plain(), &mut action.end.effects),
        _ => Err(format!("not for this judge: {form:?}")),
    }
}

fn goal(form: &Form, given: &mut Given) -> Read<()> {
    match (form.head(), form.list()?) {
        ("and", parts) => parts[1..].iter().try_for_each(|part| goal(part, given))?,
        ("preference", [_, name, wish]) => {
            given.wishes.push((name.word()?.to_owned(), condition(wish)?));
        }
        _ => given.goal.push(condition(form)?),
    }
    Ok(())
}

fn section<'f>(forms: &'f [Form], name: &str) -> &'f [Form] {
    let found = forms.iter().find(|form| form.head() == name);
    found.and_then(|form| form.list().ok()).map_or(&[], |list| &list[1..])
}

pub(super) fn read(domain: &str, problem: &str) -> Read<Given> {
    let (domain, problem) = (forms(domain)?, forms(problem)?);
    let body = |forms: &[Form]| -> Read<Vec<Form>> {
        Ok(forms.first().ok_or("nothing is defined")?.list()?.to_vec())
    };
    let (domain, problem) = (body(&domain)?, body(&problem)?);
    let mut given = Given::new(key);
    given.kinds = typed(section(&domain, ":types"))?.into_iter().collect();
    let named = typed(section(&domain, ":constants"))?.into_iter();
    for (name, kinds) in named.chain(typed(section(&problem, ":objects"))?) {
        let kinds = if kinds.is_empty() { vec!["object".to_owned()] } else { kinds };
        given.objects.entry(name).or_default().extend(kinds);
    }
    for form in &domain {
        match form.head() {
            ":action" | ":durative-action" => {
                let list = form.list()?;
                let part = |name: &str| {
                    let at = list.iter().position(|part| *part == Form::Word(name.to_owned()))?;
                    list.get(at + 1)
                };
                let parameters =
                    part(":parameters").map_or(Ok(Vec::new()), |f| typed(f.list()?))?;
                let mut action = Action::new(parameters);
                if form.head() == ":action" {
                    let Moment { precondition, effects: found } = &mut action.start;
                    if let Some(asked) = part(":precondition") {
                        *precondition = condition(asked)?;
                    }
                    part(":effect").map_or(Ok(()), |f| effects(f, &plain(), found))?;
                } else {
                    part(":condition").map_or(Ok(()), |f| timed(f, true, &mut action))?;
                    part(":effect").map_or(Ok(()), |f| timed(f, false, &mut action))?;
                }
                given.actions.insert(list[1].word()?.to_owned(), action);
            }
            ":derived" => {
                let [_, head, body] = form.list()? else { return Err(format!("{form:?}")) };
                let head = head.list()?;
                let variables = typed(&head[1..])?;
                let names = variables.iter().map(|(name, _)| name.clone());
                let atom = std::iter::once(head[0].word()?.to_owned()).chain(names).collect();
                given.derived.push((variables, atom, condition(body)?));
            }
            ":constraints" => {
                return Err(format!("not for this judge: {}", form.head()));
            }
            _ => {}
        }
    }
    let facts =
        section(&problem, ":init").iter().filter(|form| !matches!(form.head(), "=" | "not"));
    given.init = facts.map(atom).collect::<Read<_>>()?;
    section(&problem, ":goal").iter().try_for_each(|form| goal(form, &mut given))?;
    Ok(given)
}
