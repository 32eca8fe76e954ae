//! What is amiss in the messages of a crate: for its test, see [`crate::messages!`].

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use fluent_bundle::FluentResource;
use fluent_syntax::ast::{
    CallArguments, Entry, Expression, InlineExpression, Pattern, PatternElement,
};

use super::{COMMON, FUNCTIONS, Kind, Messages};

/// What a message or an attribute (`message.attribute`) names.
#[derive(Debug, Default)]
struct Names {
    /// Arguments that are told.
    told: BTreeSet<String>,
    /// Arguments by which grammar chooses, as it must in one language and need not in the other.
    chosen: BTreeSet<String>,
    messages: BTreeSet<String>,
}

type Named = BTreeMap<String, Names>;

/// The messages of a crate in one language, with those that all crates have.
struct Read {
    own: Named,
    alike: Named,
}

/// A line for each thing that is amiss.
#[must_use]
pub fn amiss_in(messages: &Messages, kinds: &[&[Kind]], is_whole: bool, sources: &str) -> String {
    let mut amiss = Vec::new();
    let [ru, en] = [0, 1].map(|i| {
        let language = ["ru", "en"][i];
        let mut faults = Vec::new();
        let read = Read {
            own: named(messages.texts.iter().map(|text| *text[i]), &mut faults),
            alike: named([*COMMON[i]], &mut Vec::new()),
        };
        amiss.extend(faults.into_iter().map(|fault| format!("{language}: {fault}")));
        read
    });
    for (one, other, language) in [(&ru, &en, "en"), (&en, &ru, "ru")] {
        let missing = one.own.keys().filter(|name| !other.own.contains_key(*name));
        amiss.extend(missing.map(|name| format!("{language}: {name} is missing")));
    }
    for (name, names) in &ru.own {
        if let Some(other) = en.own.get(name).filter(|other| other.told != names.told) {
            amiss.push(format!("{name}: {:?} in ru, {:?} in en", names.told, other.told));
        }
    }

    let mut asked = BTreeSet::new();
    for kind in kinds.iter().copied().flatten() {
        if !ru.own.contains_key(kind.message) {
            amiss.push(format!("no message {}", kind.message));
        }
        let attributes = kind.places.iter().copied();
        let attributes = attributes.chain((!kind.fields.contains(&"help")).then_some("help"));
        let attributes = attributes.map(|attribute| format!("{}.{attribute}", kind.message));
        for name in attributes.chain([kind.message.to_owned()]) {
            let arguments = ru.arguments(&name).into_iter().chain(en.arguments(&name));
            let unknown = arguments.filter(|name| !kind.fields.contains(&name.as_str()));
            amiss.extend(unknown.map(|it| format!("{name}: {} has no {it}", kind.code)));
            asked.insert(name);
        }
    }
    for (message, given) in told_in(Path::new(sources)) {
        let arguments: BTreeSet<_> =
            ru.arguments(&message).into_iter().chain(en.arguments(&message)).collect();
        if ru.names(&message).is_none() {
            amiss.push(format!("no message {message}"));
        } else if arguments != given {
            amiss.push(format!("{message}: {arguments:?} in its text, {given:?} in said!"));
        }
        asked.insert(message);
    }
    for names in ru.own.values().chain(en.own.values()) {
        let unknown = names.messages.iter().filter(|name| ru.names(name).is_none());
        amiss.extend(unknown.map(|name| format!("no message {name}")));
        asked.extend(names.messages.iter().cloned());
    }
    // What all crates have, each takes as it needs it.
    if is_whole && !std::ptr::eq(messages, &crate::MESSAGES) {
        let unused = ru.own.keys().filter(|name| !asked.contains(*name));
        amiss.extend(unused.map(|name| format!("{name} is told nowhere")));
    }
    amiss.join("\n")
}

impl Read {
    fn names(&self, message: &str) -> Option<&Names> {
        self.own.get(message).or(self.alike.get(message))
    }

    /// The arguments of a message, those of the messages in it among them.
    fn arguments(&self, message: &str) -> BTreeSet<String> {
        let Some(names) = self.names(message) else { return BTreeSet::new() };
        // Fluent itself stops where a message leads back to itself.
        let within = names.messages.iter().filter(|within| *within != message);
        let within = within.flat_map(|within| self.arguments(within));
        names.told.union(&names.chosen).cloned().chain(within).collect()
    }
}

/// What some files have.
fn named<'t>(texts: impl IntoIterator<Item = &'t str>, amiss: &mut Vec<String>) -> Named {
    let mut named = Named::new();
    for text in texts {
        add(&mut named, text, amiss);
    }
    named
}

fn add(named: &mut Named, text: &str, amiss: &mut Vec<String>) {
    let read = FluentResource::try_new(text.to_owned()).unwrap_or_else(|(read, faults)| {
        amiss.extend(faults.iter().map(ToString::to_string));
        read
    });
    let mut add = |name: String, pattern: &Pattern<&str>, amiss: &mut Vec<String>| {
        let mut names = Names::default();
        names.of_pattern(pattern, amiss);
        if named.insert(name.clone(), names).is_some() {
            amiss.push(format!("{name} twice"));
        }
    };
    for entry in read.entries() {
        match entry {
            Entry::Message(message) => {
                if let Some(pattern) = &message.value {
                    add(message.id.name.to_owned(), pattern, amiss);
                }
                for attribute in &message.attributes {
                    let name = format!("{}.{}", message.id.name, attribute.id.name);
                    add(name, &attribute.value, amiss);
                }
            }
            Entry::Comment(_) | Entry::GroupComment(_) | Entry::ResourceComment(_) => {}
            other => amiss.push(format!("{other:?}")),
        }
    }
}

impl Names {
    fn of_pattern(&mut self, pattern: &Pattern<&str>, amiss: &mut Vec<String>) {
        for element in &pattern.elements {
            if let PatternElement::Placeable { expression } = element {
                self.of_expression(expression, amiss);
            }
        }
    }

    fn of_expression(&mut self, expression: &Expression<&str>, amiss: &mut Vec<String>) {
        match expression {
            Expression::Inline(inline) => self.of_inline(inline, amiss),
            Expression::Select { selector, variants } => {
                let mut choice = Self::default();
                choice.of_inline(selector, amiss);
                self.chosen.extend(choice.told);
                variants.iter().for_each(|variant| self.of_pattern(&variant.value, amiss));
            }
        }
    }

    fn of_inline(&mut self, inline: &InlineExpression<&str>, amiss: &mut Vec<String>) {
        match inline {
            InlineExpression::VariableReference { id } => {
                self.told.insert(id.name.to_owned());
            }
            InlineExpression::MessageReference { id, attribute } => {
                let attribute = attribute.as_ref().map(|attribute| format!(".{}", attribute.name));
                self.messages.insert(id.name.to_owned() + &attribute.unwrap_or_default());
            }
            InlineExpression::FunctionReference { id, arguments } => {
                if !FUNCTIONS.contains(&id.name) {
                    amiss.push(format!("no function {}", id.name));
                }
                let CallArguments { positional, .. } = arguments;
                positional.iter().for_each(|argument| self.of_inline(argument, amiss));
            }
            InlineExpression::Placeable { expression } => self.of_expression(expression, amiss),
            InlineExpression::StringLiteral { .. } | InlineExpression::NumberLiteral { .. } => {}
            InlineExpression::TermReference { id, .. } => {
                amiss.push(format!("a term: {}", id.name));
            }
        }
    }
}

/// The messages that `said!` names in the sources of a crate, with the names of their arguments.
fn told_in(folder: &Path) -> Vec<(String, BTreeSet<String>)> {
    let mut told = Vec::new();
    for entry in fs::read_dir(folder).expect("the sources stand beside their manifest").flatten() {
        let path = entry.path();
        let is_told_elsewhere = path.join("Cargo.toml").exists()
            || ["target", "tests"].iter().any(|folder| path.ends_with(folder));
        if path.is_dir() && !is_told_elsewhere {
            told.extend(told_in(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let text = fs::read_to_string(&path).expect("a source is a text");
            let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
            let code = code.collect::<Vec<_>>().join("\n");
            // A message in one language has the language before it.
            for (name, due) in [("said", ""), ("word", ""), ("told", ",")] {
                for call in code.split(&format!("{name}!(")).skip(1) {
                    let mut parts = call.splitn(3, '"');
                    if let (Some(head), Some(message), Some(rest)) =
                        (parts.next(), parts.next(), parts.next())
                        && head.trim().ends_with(due)
                        && head.trim().is_empty() == due.is_empty()
                    {
                        told.push((message.to_owned(), arguments_of(rest)));
                    }
                }
            }
        }
    }
    told
}

/// The names at the heads of what commas part, up to the bracket that closes.
fn arguments_of(rest: &str) -> BTreeSet<String> {
    let (mut depth, mut quoted, mut names, mut due) = (0, false, BTreeSet::new(), false);
    let mut name = String::new();
    let mut before = ' ';
    for sign in rest.chars() {
        match sign {
            '"' if before != '\\' => quoted = !quoted,
            _ if quoted => {}
            '(' | '[' | '{' => depth += 1,
            ')' if depth == 0 => break,
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 => {
                names.insert(std::mem::take(&mut name));
                due = true;
            }
            _ if due && (sign.is_alphanumeric() || sign == '_') => name.push(sign),
            _ if due && !name.is_empty() => due = false,
            _ => {}
        }
        before = sign;
    }
    names.insert(name);
    names.remove("");
    names
}
