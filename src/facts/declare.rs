//! Declarations: types and the types they are part of, records and branches, relations and what is asked of them.

use std::collections::{BTreeSet, HashMap};

use super::declared::{Declared, MAX_COLUMNS, Structure, Type, is_declared, kind_name, primitive};
use super::fault::{Found, RuleError};
use super::program::Kind;
use super::relations::{Column, RelationId, RelationInfo};
use super::syntax::{Item, Name, Role};
use crate::units::{Gather as _, nearest_name, said, word};

pub(super) fn declare(items: &[Item], faults: &mut Found) -> Declared {
    let mut declared = Declared::default();
    for kind in [Kind::Symbol, Kind::Number, Kind::Unsigned, Kind::Float] {
        let name = kind_name(kind);
        declared.type_names.insert(name.into(), declared.types.len());
        declared.types.push(Type { name: name.into(), kind, below: vec![], parts: vec![] });
    }
    declare_structures(items, &mut declared, faults);
    declare_more(items, &mut declared, faults);
    declare_fields(items, &mut declared, faults);
    declared
}

/// Adds types and relations to those that are declared already.
pub(super) fn declare_more(items: &[Item], declared: &mut Declared, faults: &mut Found) {
    declare_types(items, declared, faults);
    for item in items {
        if let Item::Relation { names, columns, second, roles, domains } = item {
            for name in names {
                declare_relation(name, columns, second.as_ref(), roles, declared, faults);
                choose(name, domains, declared, faults);
            }
        }
    }
}

/// The names of records and of branched types, so that their fields may be of them.
fn declare_structures(items: &[Item], declared: &mut Declared, faults: &mut Found) {
    for item in items {
        let Item::Structure { name, is_record, .. } = item else { continue };
        if declared.type_names.contains_key(&name.text) {
            let fault = RuleError::Duplicate { name: name.text.clone(), at: name.at.into() };
            faults.push(name.at, fault);
            continue;
        }
        let kind = Kind::Record(declared.structures.len() as u32);
        declared.type_names.insert(name.text.clone(), declared.types.len());
        let name = name.text.clone();
        declared.types.push(Type { name: name.clone(), kind, below: vec![], parts: vec![] });
        declared.structures.push(Structure { name, branches: Vec::new(), is_record: *is_record });
    }
}

/// The fields of records and branches, once all types are known.
fn declare_fields(items: &[Item], declared: &mut Declared, faults: &mut Found) {
    for item in items {
        let Item::Structure { name, branches, is_record } = item else { continue };
        let Some(Kind::Record(of)) =
            declared.type_named(&name.text).map(|id| declared.types[id].kind)
        else {
            continue;
        };
        if !declared.structures[of as usize].branches.is_empty() {
            continue;
        }
        for branch in branches {
            if *is_record {
                twice(&branch.fields, faults);
            }
            let types = branch.fields.iter();
            let types: Vec<usize> =
                types.map(|(_, field)| type_named(field, declared, faults).unwrap_or(0)).collect();
            if types.len() >= MAX_COLUMNS {
                let (what, limit, at) = (word!("fields-of-a-record"), MAX_COLUMNS, branch.name.at);
                faults.push(at, RuleError::TooLarge { what, limit, at: at.into() });
            }
            let is_new =
                *is_record || declared.branches.insert(branch.name.text.clone(), of).is_none();
            if !is_new {
                let (name, at) = (branch.name.text.clone(), branch.name.at);
                faults.push(at, RuleError::Duplicate { name, at: at.into() });
            }
            declared.structures[of as usize].branches.push((branch.name.text.clone(), types));
        }
    }
}

/// The columns of a relation's choice domains.
fn choose(name: &Name, domains: &[Vec<Name>], declared: &mut Declared, faults: &mut Found) {
    let Some(id) = declared.names.find(&name.text) else { return };
    let info = &mut declared.relations[id.index()];
    for domain in domains {
        let mut columns = Vec::with_capacity(domain.len());
        for column in domain {
            match info.columns.iter().position(|known| known.name == column.text) {
                Some(at) => columns.push(at),
                None => {
                    let what = said!("choice-domain-without-such-a-column", text = column.text);
                    let help = word!("name-columns-of-this-relation");
                    let at = column.at;
                    faults.push(at, RuleError::Unsupported { what, help, at: at.into() });
                }
            }
        }
        if columns.len() == domain.len() {
            info.choices.push(columns);
        }
    }
}

/// A type may be named before it is declared: it waits until all its bases are. What is left when nothing more fits
/// names what nobody declares.
fn declare_types(items: &[Item], declared: &mut Declared, faults: &mut Found) {
    let types: Vec<(&Name, &[Name], bool)> = items
        .iter()
        .filter_map(|item| match item {
            Item::Type { name, bases, is_union } => Some((name, bases.as_slice(), *is_union)),
            _ => None,
        })
        .collect();
    let mut waiting: HashMap<&str, Vec<usize>> = HashMap::new();
    let mut missing = vec![0_usize; types.len()];
    for (number, (_, bases, _)) in types.iter().enumerate() {
        for base in *bases {
            if !declared.type_names.contains_key(&base.text) {
                waiting.entry(&base.text).or_default().push(number);
                missing[number] += 1;
            }
        }
    }
    let mut left: BTreeSet<usize> = (0..types.len()).gather();
    let mut ready: BTreeSet<usize> =
        (0..types.len()).filter(|number| missing[*number] == 0).gather();
    while let Some(next) = ready.pop_first().or_else(|| left.first().copied()) {
        left.remove(&next);
        ready.remove(&next);
        let (name, bases, is_union) = types[next];
        declare_type(name, bases, is_union, declared, faults);
        if declared.type_names.contains_key(&name.text) {
            for number in waiting.remove(name.text.as_str()).into_iter().flatten() {
                missing[number] -= 1;
                if missing[number] == 0 && left.contains(&number) {
                    ready.insert(number);
                }
            }
        }
    }
}

/// `<:` puts the new type below its base; `=` with several bases puts it above all of them.
fn declare_type(
    name: &Name,
    bases: &[Name],
    is_union: bool,
    declared: &mut Declared,
    faults: &mut Found,
) {
    let known: Vec<usize> =
        bases.iter().filter_map(|base| type_named(base, declared, faults)).collect();
    let Some(first) = known.first().copied() else { return };
    let id = declared.types.len();
    if declared.type_names.contains_key(&name.text) {
        let fault = RuleError::Duplicate { name: name.text.clone(), at: name.at.into() };
        faults.push(name.at, fault);
        return;
    }
    let kind = declared.types[first].kind;
    let is_closed = matches!(kind, Kind::Record(_)) || declared.types[first].parts.len() > 1;
    if !is_union && is_closed {
        let what =
            said!("a-subtype-of-the-record-or-union", text = name.text, text2 = bases[0].text);
        let help = word!("symbol-number-unsigned-float-and-their-subtypes");
        faults.push(name.at, RuleError::Misuse { what, help, at: name.at.into() });
    }
    let parts = if is_union { known.clone() } else { Vec::new() };
    declared.type_names.insert(name.text.clone(), id);
    declared.types.push(Type { name: name.text.clone(), kind, below: Vec::new(), parts });
    // The primitive type is above a union as it is above the union's parts.
    declared.put_below(id, if bases.len() == 1 { first } else { primitive(kind).unwrap_or(first) });
    if is_union {
        for (part, base) in known.iter().zip(bases) {
            if declared.types[*part].kind != kind {
                let expected = declared.kind_text(kind);
                let found = declared.kind_text(declared.types[*part].kind);
                let fault = RuleError::Types {
                    what: base.text.clone(),
                    expected,
                    found: found.into(),
                    at: base.at.into(),
                };
                faults.push(base.at, fault);
            }
        }
        for part in known {
            if declared.types[part].kind == kind {
                declared.put_below(part, id);
            }
        }
    }
}

pub(super) fn type_named(name: &Name, declared: &Declared, faults: &mut Found) -> Option<usize> {
    let found = declared.type_names.get(&name.text).copied();
    if found.is_none() {
        let nearest =
            nearest_name(&name.text, declared.types.iter().map(|known| known.name.as_str()));
        let nearest = nearest.map(str::to_owned);
        let fault = RuleError::UnknownType { name: name.text.clone(), nearest, at: name.at.into() };
        faults.push(name.at, fault);
    }
    found
}

fn declare_relation(
    name: &Name,
    columns: &[(Name, Name)],
    second: Option<&Name>,
    roles: &[Role],
    declared: &mut Declared,
    faults: &mut Found,
) {
    if columns.len() > MAX_COLUMNS {
        let (what, limit) = (word!("columns-of-a-relation"), MAX_COLUMNS);
        faults.push(name.at, RuleError::TooLarge { what, limit, at: name.at.into() });
        return;
    }
    let id = RelationId(declared.relations.len() as u32);
    for name in std::iter::once(name).chain(second) {
        // Soufflé's own four types leave their names free.
        let is_type = declared.type_named(&name.text).is_some_and(is_declared);
        if is_type || !declared.names.insert(&name.text, id) {
            let fault = RuleError::Duplicate { name: name.text.clone(), at: name.at.into() };
            faults.push(name.at, fault);
        }
    }
    twice(columns, faults);
    // A column of unknown type is taken for a symbol, so that the relation's other uses are still checked.
    let types: Vec<usize> =
        columns.iter().map(|(_, of)| type_named(of, declared, faults).unwrap_or(0)).collect();
    let column = |((name, _), id): (&(Name, Name), &usize)| {
        let Type { name: type_name, kind, .. } = &declared.types[*id];
        Column { name: name.text.clone(), kind: *kind, type_name: type_name.clone() }
    };
    let mut info = RelationInfo {
        name: name.text.clone(),
        second_name: second.map(|name| name.text.clone()),
        columns: columns.iter().zip(&types).map(column).collect(),
        ..RelationInfo::default()
    };
    roles.iter().for_each(|role| give_role(*role, &[], &mut info));
    declared.relations.push(info);
    declared.columns.push(types);
    declared.places.push(name.at);
}

/// Columns, or a record's fields, of one name.
fn twice(named: &[(Name, Name)], faults: &mut Found) {
    for (n, (name, _)) in named.iter().enumerate() {
        if named[..n].iter().any(|(known, _)| known.text == name.text) {
            let fault = RuleError::Duplicate { name: name.text.clone(), at: name.at.into() };
            faults.push(name.at, fault);
        }
    }
}

pub(super) fn direct(items: &[Item], declared: &mut Declared, faults: &mut Found) {
    for item in items {
        if let Item::Directive { role, relations, parameters } = item {
            // Soufflé reads over what it does not know, and so does this, but not silently.
            for (known, value) in parameters.iter().filter(|(name, _)| !is_parameter(name)) {
                let at = relations.first().map(|name| name.at).unwrap_or_default();
                let what = format!("{known}={value}");
                faults.push(at, RuleError::Hint { what, at: at.into() });
            }
            for name in relations {
                let Some(id) = declared.relation(name, faults) else { continue };
                let info = &mut declared.relations[id.index()];
                let is_said = match role {
                    Role::PrintSize => info.print_size,
                    Role::LimitSize => info.limit_size.is_some(),
                    _ => false,
                };
                if is_said {
                    let fault =
                        RuleError::Duplicate { name: name.text.clone(), at: name.at.into() };
                    faults.push(name.at, fault);
                }
                give_role(*role, parameters, info);
            }
        }
    }
}

/// What a directive may say that has an effect, here or in Soufflé.
fn is_parameter(name: &str) -> bool {
    matches!(
        name,
        "IO" | "filename"
            | "delimiter"
            | "headers"
            | "rfc4180"
            | "columns"
            | "format"
            | "compress"
            | "n"
    )
}

fn give_role(role: Role, parameters: &[(String, String)], info: &mut RelationInfo) {
    match role {
        Role::Input | Role::Output => {
            let said = if role == Role::Input { &mut info.inputs } else { &mut info.outputs };
            if !said.iter().any(|known| known == parameters) {
                said.push(parameters.to_vec());
            }
        }
        Role::PrintSize => info.print_size = true,
        // Becomes rules, see `equivalence`.
        Role::Equivalence => {}
        // Is unfolded where it must be, see `inline`.
        Role::Inline => {}
        // Was seen to when the component was made.
        Role::Overridable => {}
        Role::LimitSize => {
            let limit = parameters.iter().find(|(name, _)| name == "n");
            info.limit_size = limit.and_then(|(_, n)| n.parse().ok()).or(info.limit_size);
        }
    }
}
