//! What is amiss in the messages of a crate: for its test, see [`crate::messages!`].

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use fluent_bundle::FluentResource;
use fluent_syntax::ast::{
    CallArguments, Entry, Expression, InlineExpression, Pattern, PatternElement,
};

use super::{COMMON, Kind, Messages};

/// A message or an attribute (`message.attribute`): the arguments and the messages that it names.
type Named = BTreeMap<String, [BTreeSet<String>; 2]>;

/// A line for each thing that is amiss.
#[must_use]
pub fn amiss_in(messages: &Messages, kinds: &[&[Kind]], sources: &str) -> String {
    let mut amiss = Vec::new();
    let alike = [0, 1].map(|i| named(&COMMON[i], "units.ftl", &mut amiss));
    let own = [0, 1].map(|i| named(&messages.texts[i], ["ru", "en"][i], &mut amiss));
    let is_common = std::ptr::eq(messages, &crate::MESSAGES);

    for (one, other, language) in [(&own[0], &own[1], "en"), (&own[1], &own[0], "ru")] {
        for (name, [arguments, _]) in one {
            match other.get(name) {
                None => amiss.push(format!("{language}: {name} is missing")),
                Some([others, _]) if arguments != others && language == "en" => {
                    amiss.push(format!("{name}: {arguments:?} in ru, {others:?} in en"));
                }
                Some(_) => {}
            }
        }
    }
    let own = &own[0];
    let mut asked: BTreeSet<String> = BTreeSet::new();
    for kind in kinds.iter().copied().flatten() {
        let message = kind.message();
        if !own.contains_key(&message) {
            amiss.push(format!("no message {message}"));
        }
        for (name, [arguments, referred]) in own.range(message.clone()..) {
            let (of, attribute) = name.split_once('.').unwrap_or((name, ""));
            if of != message {
                // Other messages may stand between one and its attributes: «a-b» between «a» and «a.help».
                if !of.starts_with(&message) {
                    break;
                }
                continue;
            }
            let known = ["", "help"].contains(&attribute) || kind.places.contains(&attribute);
            if known && !(attribute == "help" && kind.fields.contains(&"help")) {
                asked.insert(name.clone());
            }
            let within = referred.iter().filter_map(|r| Some(&own.get(r).or(alike[0].get(r))?[0]));
            for argument in arguments.iter().chain(within.flatten()) {
                if !kind.fields.contains(&argument.as_str()) {
                    amiss.push(format!("{name}: {} has no {argument}", kind.code));
                }
            }
        }
    }
    for (message, given) in told_in(Path::new(sources)) {
        let Some([arguments, _]) = own.get(&message).or(alike[0].get(&message)) else {
            amiss.push(format!("no message {message}"));
            continue;
        };
        if *arguments != given {
            amiss.push(format!("{message}: {arguments:?} in its text, {given:?} in said!"));
        }
        asked.insert(message);
    }
    asked.extend(own.values().flat_map(|[_, referred]| referred.clone()));
    if !is_common {
        let unused = own.keys().filter(|name| !asked.contains(*name));
        amiss.extend(unused.map(|name| format!("{name} is told nowhere")));
    }
    amiss.join("\n")
}

/// What a file has.
fn named(text: &str, file: &str, amiss: &mut Vec<String>) -> Named {
    let read = FluentResource::try_new(text.to_owned()).unwrap_or_else(|(read, faults)| {
        amiss.extend(faults.iter().map(|fault| format!("{file}: {fault}")));
        read
    });
    let mut named = Named::new();
    let mut add = |name: String, pattern: &Pattern<&str>, amiss: &mut Vec<String>| {
        let mut within = Default::default();
        of_pattern(pattern, &mut within);
        if named.insert(name.clone(), within).is_some() {
            amiss.push(format!("{file}: {name} twice"));
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
            other => amiss.push(format!("{file}: {other:?}")),
        }
    }
    named
}

fn of_pattern(pattern: &Pattern<&str>, found: &mut [BTreeSet<String>; 2]) {
    for element in &pattern.elements {
        match element {
            PatternElement::Placeable { expression: Expression::Inline(inline) } => {
                of_inline(inline, found);
            }
            PatternElement::Placeable { expression: Expression::Select { selector, variants } } => {
                of_inline(selector, found);
                variants.iter().for_each(|variant| of_pattern(&variant.value, found));
            }
            PatternElement::TextElement { .. } => {}
        }
    }
}

fn of_inline(inline: &InlineExpression<&str>, found: &mut [BTreeSet<String>; 2]) {
    match inline {
        InlineExpression::VariableReference { id } => {
            found[0].insert(id.name.to_owned());
        }
        InlineExpression::MessageReference { id, attribute } => {
            let attribute = attribute.as_ref().map(|attribute| format!(".{}", attribute.name));
            found[1].insert(id.name.to_owned() + &attribute.unwrap_or_default());
        }
        InlineExpression::FunctionReference {
            arguments: CallArguments { positional, .. }, ..
        } => {
            positional.iter().for_each(|argument| of_inline(argument, found));
        }
        InlineExpression::Placeable { expression } => {
            let expression = (**expression).clone();
            of_pattern(
                &Pattern { elements: vec![PatternElement::Placeable { expression }] },
                found,
            );
        }
        _ => {}
    }
}

/// The messages that `said!` names in the sources of a crate, with the names of their arguments.
fn told_in(folder: &Path) -> Vec<(String, BTreeSet<String>)> {
    let mut told = Vec::new();
    for entry in fs::read_dir(folder).expect("the sources stand beside their manifest").flatten() {
        let path = entry.path();
        if path.is_dir() && !path.join("Cargo.toml").exists() && !path.ends_with("target") {
            told.extend(told_in(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let text = fs::read_to_string(&path).expect("a source is a text");
            let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
            let code = code.collect::<Vec<_>>().join("\n");
            // A message in one language has the language before it.
            for (name, due) in [("said", ""), ("told", ",")] {
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
