//! `ortho why "НАХОДИТСЯ_СВЕРХУ_НА(Чашка-1, Стол-1)"`: the proof of a relation, down to what was measured; `--not` asks
//! why it does not hold.

use super::args::{Common, Lang};
use super::fault::Failure;
use super::opened::open;
use super::{Answer, say};
use crate::engine::{Engine, Relations, RequestError};
use crate::facts::{SEE_ABOVE, Value, WhyNot};
use crate::units::{Language, told};

/// Runs the command. A fact that is asked about the wrong way round – why, though it does not hold – is answered with
/// "no" and with what can be said.
pub(super) fn run(common: &Common, fact: &str, not: bool) -> Result<Answer, Failure> {
    let Some((name, of)) = parts(fact) else {
        return Err(RequestError::Fact { text: fact.to_owned() }.into());
    };
    let engine = open(common)?;
    let names = Names::of(&engine, common.lang)?;
    let because = engine.why(name, &of)?;
    if common.json {
        say(&super::json::why(&engine, name, &of, common.lang.language())?.to_string())?;
        return Ok(if because.is_ok() == not { Answer::No } else { Answer::Yes });
    }
    let nearest = match because {
        Ok(proof) => {
            if not {
                say(&told!(common.lang.language(), "it-does-hold"))?;
            }
            say(names.translate(&proof.to_string()).trim_end())?;
            return Ok(if not { Answer::No } else { Answer::Yes });
        }
        Err(nearest) => nearest,
    };
    let of = engine.arguments(&of)?;
    let shown = names.name(name);
    let of: Vec<String> = of.iter().map(|of| names.value(of)).collect();
    let head = format!("{shown}({})", of.join(", "));
    match nearest {
        WhyNot::Nearest(rule) => {
            let text = told!(common.lang.language(), "does-not-hold");
            say(names.translate(&format!("{head}: {text} {rule}")).trim_end())?;
        }
        WhyNot::NotTold | WhyNot::Holds => {
            let text = told!(common.lang.language(), "not-measured");
            say(&format!("{head}: {text}"))?;
        }
    }
    Ok(if not { Answer::Yes } else { Answer::No })
}

/// `name(a, b)`; the names may stand in quotes.
fn parts(fact: &str) -> Option<(&str, Vec<&str>)> {
    let (name, rest) = fact.trim().split_once('(')?;
    let inside = rest.trim_end().strip_suffix(')')?;
    let name = name.trim();
    if name.is_empty() {
        return None;
    }

    let mut of = Vec::new();
    let mut rest = inside.trim();
    while !rest.is_empty() {
        let quote = ['"', '«'].into_iter().find(|q| rest.starts_with(*q));
        let (value, after) = match quote {
            Some(quote) => {
                let close = if quote == '«' { '»' } else { '"' };
                rest[quote.len_utf8()..].split_once(close)?
            }
            None => rest.split_at(rest.find(',').unwrap_or(rest.len())),
        };
        of.push(value.trim());
        let after = after.trim_start();
        rest = match after.strip_prefix(',') {
            Some(more) => more.trim_start(),
            None if after.is_empty() => after,
            None => return None,
        };
    }
    Some((name, of))
}

/// Relations, and what facts name, as they are called in the wanted language.
pub(super) struct Names<'a> {
    engine: &'a Engine,
    relations: &'a Relations,
    lang: Lang,
}

impl<'a> Names<'a> {
    pub(super) fn of(engine: &'a Engine, lang: Lang) -> Result<Self, Failure> {
        Ok(Self { engine, relations: engine.relations()?, lang })
    }

    fn name(&self, name: &str) -> String {
        self.relations.display_name(name, self.lang.language())
    }

    fn value(&self, text: &str) -> String {
        let value = Value::Symbol(text.into());
        self.engine.value_in_words(&value, self.lang.language())
    }

    /// A shown tree with names in the wanted language: of relations, and in quotes of what facts name.
    pub(super) fn translate(&self, text: &str) -> String {
        if self.lang == Lang::Ru {
            return text.to_owned();
        }
        let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
        let mut shown = String::new();
        let mut rest = text;
        while let Some(start) = rest.find(|c| is_of_name(c) || c == '"') {
            let (before, word) = rest.split_at(start);
            shown.push_str(before);
            if let Some((quoted, after)) = word.strip_prefix('"').and_then(|q| q.split_once('"')) {
                shown.push_str(&format!("\"{}\"", self.value(quoted)));
                rest = after;
                continue;
            }
            // A quote that nothing closes stands for itself.
            let end = word.find(|c| !is_of_name(c)).unwrap_or(word.len()).max(1);
            let (word, after) = word.split_at(end);
            // A relation's name is followed by its tuple.
            shown.push_str(&if after.starts_with('(') { self.name(word) } else { word.to_owned() });
            rest = after;
        }
        shown.push_str(rest);
        shown.replace(&*SEE_ABOVE.say(Language::Russian), &SEE_ABOVE.say(Language::English))
    }
}

#[cfg(test)]
mod tests {
    use super::parts;

    #[test]
    fn a_fact_is_read_with_and_without_quotes() {
        assert_eq!(parts("НА(Чашка-1, Стол)"), Some(("НА", vec!["Чашка-1", "Стол"])));
        assert_eq!(parts(" ON ( \"a, b\" , «в (г)» ) "), Some(("ON", vec!["a, b", "в (г)"])));
        assert_eq!(parts("flag()"), Some(("flag", vec![])));
        assert_eq!(parts("НА(\"а\" б)"), None);
        assert_eq!(parts("НА"), None);
    }
}
