//! Texts to a program: read, their components written out, checked.

use std::sync::Arc;

use super::fault::{Faults, Found, RuleError, by_file};
use super::program::{Clause, Program};
use super::relations::RelationId;
use super::syntax::Item;
use super::{check, component, misuse, parse, strata};
use crate::units::{Source, said, word};

impl Program {
    /// Reads one rule text.
    ///
    /// # Errors
    /// All [`Faults`] of the text.
    pub fn parse(source: &Source) -> Result<Self, Faults> {
        Self::parse_all(std::slice::from_ref(source))
    }

    /// Reads several rule texts as one program: rules of one may use relations that another declares.
    ///
    /// # Errors
    /// All [`Faults`] of all texts.
    pub fn parse_all(sources: &[Source]) -> Result<Self, Faults> {
        let mut faults = Found::default();
        let items = all_items(sources, &mut faults);
        for item in &items {
            if let Item::Include { path, at } = item {
                let what = said!("include-in-a-text-that-has-no", path);
                let help = word!("give-the-rule-texts-together-as-one");
                faults.push(*at, RuleError::Unsupported { what, help, at: (*at).into() });
            }
        }
        Self::of_items(sources, &items, faults)
    }

    /// Texts that were read with all that they include.
    pub(super) fn parse_included(sources: &[Source]) -> Result<Self, Faults> {
        let mut faults = Found::default();
        let items = all_items(sources, &mut faults);
        Self::of_items(sources, &items, faults)
    }

    fn of_items(sources: &[Source], items: &[Item], mut faults: Found) -> Result<Self, Faults> {
        misuse::names(items, &mut faults);
        let items = &component::expand(items.to_vec(), &mut faults);
        let mut program = check::program(sources, items, &mut faults);
        let (warnings, errors): (Vec<_>, Vec<_>) =
            faults.all.into_iter().partition(|(_, fault)| fault.is_warning());
        if !errors.is_empty() {
            return Err(Faults { files: by_file(sources, errors) });
        }
        program.warnings = by_file(sources, warnings).into();
        Ok(program)
    }

    /// The texts of the rules that read a relation, each as often as it has such a rule.
    pub fn readers(&self, relation: RelationId) -> impl Iterator<Item = &Source> {
        let reads = move |clause: &&Arc<Clause>| {
            let mut found = false;
            strata::reads(&clause.body, false, &mut |of, _, _| found |= of == relation);
            found
        };
        self.clauses.iter().filter(reads).map(|clause| &self.sources[clause.at.file as usize])
    }
}

fn all_items(sources: &[Source], faults: &mut Found) -> Vec<Item> {
    let mut items = Vec::new();
    for (file, source) in sources.iter().enumerate() {
        let mut here = Vec::new();
        items.extend(parse::items(source, file as u32, &mut here));
        faults.all.extend(here.into_iter().map(|fault| (file as u32, fault)));
    }
    items
}

/// The files that a text includes, as it names them.
pub(super) fn includes(source: &Source) -> Vec<String> {
    let items = parse::items(source, 0, &mut Vec::new());
    let path = |item| match item {
        Item::Include { path, .. } => Some(path),
        _ => None,
    };
    items.into_iter().filter_map(path).collect()
}
