//! A fact in the notation of the rules, asked after or asked why: `ON_TOP_OF(Cup 1, Table 1)`,
//! «почему НАХОДИТСЯ_СВЕРХУ_НА(Чашка-1, Стол-1)?», "why not …". Its names are names, never words of a sentence: what the map
//! does not know is told to be unknown.

use crate::semantics::Relations;
use crate::sets::Set;
use crate::units::name_key;
use crate::words::Language;

use super::answer::Draft;
use super::knowledge::Knowledge;
use super::query::Query;
use super::{Asker, Doubt, Fact, Said};

static WHY: Set = Set::named("Why");
static WHY_NOT: Set = Set::named("WhyNot");

/// `NAME(a, b)` with what stands before it.
struct Noted<'t> {
    before: String,
    relation: &'t str,
    args: Vec<&'t str>,
}

/// Names may stand in quotes.
fn noted(text: &str) -> Option<Noted<'_>> {
    let text = text.trim().trim_end_matches(['?', '!', '.']).trim_end();
    let (head, inside) = text.strip_suffix(')')?.split_once('(')?;
    let relation = head.split_whitespace().next_back()?;
    // Directly before the bracket, or it is a remark of a sentence.
    if !head.ends_with(relation) || inside.contains(['(', ')']) {
        return None;
    }
    let before = head[..head.len() - relation.len()].trim().trim_end_matches(':').to_lowercase();
    let around = |c: char| c.is_whitespace() || "\"«»".contains(c);
    let args: Vec<&str> = inside.split(',').map(|arg| arg.trim_matches(around)).collect();
    (args.iter().all(|arg| !arg.is_empty())).then_some(Noted { before, relation, args })
}

impl Asker<'_> {
    /// The query of a text that is a fact in the notation of the rules.
    pub(super) fn noted(&self, text: &str) -> Option<Query> {
        let Noted { before, relation, args } = noted(text)?;
        let is_known = knows(self.relations, relation);
        // A word that a person would put before brackets is no relation.
        let looks_like_one =
            relation.contains('_') || relation.chars().all(|c| c.is_uppercase() || c == '_');
        if !is_known && !looks_like_one {
            return None;
        }
        let args = args.into_iter().map(str::to_owned).collect();
        let fact = Query::Noted { relation: relation.to_owned(), args };
        let is = |words: &[&str]| words.contains(&before.as_str());
        match before.as_str() {
            "" => Some(fact),
            _ if is(&WHY) => Some(Query::Why { negated: false, about: Some(Box::new(fact)) }),
            // Whether it holds is found out; why not is then the same question.
            _ if is(&WHY_NOT) => Some(Query::Why { negated: true, about: Some(Box::new(fact)) }),
            _ => None,
        }
    }
}

/// Whether the rules have a relation of this name, in either language.
fn knows(relations: &Relations, name: &str) -> bool {
    relations.tuples(name).is_ok()
}

impl Knowledge<'_> {
    /// Whether a fact in the notation of the rules holds.
    pub(super) fn say_noted(&self, relation: &str, args: &[String]) -> Result<Draft, Doubt> {
        if !knows(self.relations, relation) {
            return Err(Doubt::Unknown { reference: relation.to_owned(), near: Vec::new() });
        }
        let mut symbols = Vec::new();
        for arg in args {
            symbols.push(self.symbol_called(arg)?);
        }
        let name = self.relations.display_name(relation, Language::English);
        let given: Vec<&str> = symbols.iter().map(String::as_str).collect();
        let proof = self.relations.why(&self.around(), &name, &given);
        // Too many or too few names for the relation.
        let proof = proof.map_err(|_schema| {
            Doubt::not_understood(&format!("{relation}({})", args.join(", ")))
        })?;
        let holds = proof.is_some();
        let fact = Fact { relation: name, args: symbols, holds };
        let words = || self.fact_words(&fact.relation, &fact.args);
        let denied = || match (self.fact_denied(&fact), self.is_russian()) {
            (Some(denied), _) => denied,
            (None, true) => format!("неверно, что {}", words()),
            (None, false) => format!("it is not so that {}", words()),
        };
        let (said, text) = match holds {
            true => (Said::Yes, format!("{}, {}", self.pick("Да", "Yes"), words())),
            false => (Said::No, format!("{}, {}", self.pick("Нет", "No"), denied())),
        };
        let things = fact.args.iter().filter_map(|symbol| self.thing(symbol)).collect();
        let mut draft = Draft::plain(said, text).with(things);
        draft.rest_on(fact);
        Ok(draft)
    }

    /// The symbol of what is called so, in any spelling and form; numbers and values stand for themselves.
    fn symbol_called(&self, name: &str) -> Result<String, Doubt> {
        if name.parse::<f64>().is_ok() {
            return Ok(name.to_owned());
        }
        if let Some(subject) = self.relations.symbols().find(name) {
            return Ok(self.relations.symbols().symbol(subject).to_string());
        }
        if self.relations.knows(name) {
            return Ok(name.to_owned());
        }
        // Letters that look alike make "Bed" of «Нет»: a name is like those of its own alphabet.
        let latin = |text: &str| text.starts_with(|c: char| c.is_ascii());
        let key = name_key(name);
        let is_like = |near: &&str| {
            latin(near) == latin(name)
                && strsim::normalized_damerau_levenshtein(&name_key(near), &key) >= 0.65
        };
        let near = self.lexicon().nouns.near(name, 3).into_iter().filter(is_like);
        let near = near.map(str::to_owned).collect();
        Err(Doubt::Unknown { reference: name.to_owned(), near })
    }
}
