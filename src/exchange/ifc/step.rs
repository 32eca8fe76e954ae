//! The exchange text of ISO 10303-21 (STEP): `#12=IFCDOOR('0abc',$,(#3,#4),1.5E3,.T.);` → values.
//!
//! The text is read once, from front to back; an instance of a type that nobody asks for is passed over without being
//! taken apart, which is most of an IFC file. Strings are decoded: `''`, `\S\`, `\X\`, `\X2\`, `\X4\`.
//!
//! **Invariant**: no text makes it panic; depth and size are bounded.

use std::collections::HashMap;

use nom::IResult;
use nom::Parser;
use nom::branch::alt;
use nom::bytes::complete::{tag, take_till, take_until, take_while, take_while1};
use nom::character::complete::{char, digit1, multispace1};
use nom::combinator::{map, map_opt, opt, recognize, value};
use nom::error::{Error, ErrorKind};
use nom::multi::many0_count;
use nom::sequence::{delimited, preceded};

use crate::units::{Bilingual, Piece, Source, said, word};
use crate::{ReadError, Remark};

pub(super) const FORMAT: &str = "IFC";
const DEEPEST: usize = 32;
/// Instances that are kept.
const MOST: usize = 5_000_000;
/// Faulty instances that are told one by one.
const MOST_REMARKS: usize = 20;

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    /// `$` or `*`
    Nothing,
    /// `#12`
    Ref(u32),
    Number(f64),
    Text(Box<str>),
    /// `.LEFT.`, without the points.
    Word(Box<str>),
    List(Box<[Self]>),
}

impl Value {
    pub(super) fn reference(&self) -> Option<u32> {
        if let Self::Ref(id) = self { Some(*id) } else { None }
    }

    pub(super) fn number(&self) -> Option<f64> {
        if let Self::Number(n) = self { Some(*n) } else { None }
    }

    /// A string that says something.
    pub(super) fn text(&self) -> Option<&str> {
        if let Self::Text(t) = self { Some(t.trim()).filter(|t| !t.is_empty()) } else { None }
    }

    pub(super) fn word(&self) -> Option<&str> {
        if let Self::Word(w) = self { Some(w) } else { None }
    }

    pub(super) fn list(&self) -> &[Self] {
        if let Self::List(list) = self { list } else { &[] }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Instance {
    /// Capital letters: `IFCDOOR`.
    pub kind: &'static str,
    pub values: Box<[Value]>,
}

/// The instances of the types that were asked for.
#[derive(Debug, Default)]
pub(super) struct Instances {
    by_id: HashMap<u32, Instance>,
    /// In the order of the file.
    order: HashMap<&'static str, Vec<u32>>,
    /// How many there are of the types that were only to be counted.
    counts: HashMap<&'static str, usize>,
}

impl Instances {
    pub(super) fn get(&self, id: u32) -> Option<&Instance> {
        self.by_id.get(&id)
    }

    /// The instances of a type, in the order of the file.
    pub(super) fn all(&self, kind: &str) -> impl Iterator<Item = (u32, &Instance)> + '_ {
        let ids = self.order.get(kind).map(Vec::as_slice).unwrap_or_default();
        ids.iter().filter_map(|id| Some((*id, self.by_id.get(id)?)))
    }

    /// How many there are of a type that is kept or counted.
    pub(super) fn count(&self, kind: &str) -> usize {
        let kept = self.order.get(kind).map(Vec::len);
        kept.or(self.counts.get(kind).copied()).unwrap_or(0)
    }
}

impl Instance {
    /// The attribute of this place; [`Value::Nothing`] when the instance has fewer.
    pub(super) fn at(&self, index: usize) -> &Value {
        self.values.get(index).unwrap_or(&Value::Nothing)
    }
}

/// Whether a text says that it is STEP.
pub(super) fn is_step(text: &str) -> bool {
    matches!(space(text), Ok((rest, ())) if rest.starts_with("ISO-10303-21"))
}

/// Reads the DATA section: takes apart the instances of the types that are wanted, and counts others.
pub(super) fn instances(
    source: &Source,
    wanted: &[&'static str],
    counted: &[&'static str],
    remarks: &mut Vec<Remark>,
) -> Result<Instances, ReadError> {
    let text = source.text();
    let offset = |rest: &str| text.len() - rest.len();
    let fault = |what: Piece, rest: &str| ReadError::syntax(FORMAT, what, source, offset(rest));
    if !is_step(text) {
        return Err(fault(word!("the-text-does-not-begin"), text));
    }
    let Some(mut rest) = data_section(text) else {
        return Err(fault(word!("the-text-is-cut-off-there"), &text[text.len()..]));
    };
    let wanted: HashMap<&'static str, &'static str> = wanted.iter().map(|w| (*w, *w)).collect();
    let counted: HashMap<&'static str, &'static str> = counted.iter().map(|w| (*w, *w)).collect();
    let known = Known { wanted, counted };
    let mut found = Instances::default();
    let mut faulty = 0_usize;
    loop {
        rest = space(rest).map_or(rest, |(rest, ())| rest);
        let begun = rest;
        if rest.is_empty() {
            return Err(fault(word!("the-text-is-cut-off-the"), rest));
        }
        if let Ok((after, _)) = word(rest)
            && rest[..rest.len() - after.len()].eq_ignore_ascii_case("ENDSEC")
        {
            // A file may have several DATA sections.
            match data_section(after) {
                Some(next) => rest = next,
                None => break,
            }
            continue;
        }
        match instance(rest, &known) {
            Ok((after, Found::Kept(id, instance))) => {
                rest = after;
                if found.by_id.len() >= MOST {
                    return Err(ReadError::TooMany {
                        format: FORMAT,
                        what: said!("records"),
                        limit: MOST,
                    });
                }
                let kind = instance.kind;
                if found.by_id.insert(id, instance).is_some() {
                    remarks.push(remark(id, word!("the-number-stands-twice-the")));
                } else {
                    found.order.entry(kind).or_default().push(id);
                }
            }
            Ok((after, Found::Passed(kind))) => {
                if let Some(kind) = kind {
                    *found.counts.entry(kind).or_default() += 1;
                }
                rest = after;
            }
            Err(e) => {
                let at = match &e {
                    nom::Err::Error(e) | nom::Err::Failure(e) => e.input,
                    nom::Err::Incomplete(_) => rest,
                };
                let Ok((after, ())) = skip(begun) else {
                    return Err(fault(word!("the-text-is-cut-off-amid"), begun));
                };
                faulty += 1;
                if faulty <= MOST_REMARKS {
                    let (line, column) = source.position(offset(at));
                    let text = said!("the-record-cannot-be-read", line, column);
                    remarks.push(Remark { source: begun.chars().take(40).collect(), text });
                }
                rest = after;
            }
        }
    }
    if faulty > MOST_REMARKS {
        let text = said!("records-that-cannot-be-read", faulty);
        remarks.push(Remark { source: String::new(), text });
    }
    Ok(found)
}

fn remark(id: u32, text: impl Into<Bilingual>) -> Remark {
    Remark { source: format!("#{id}"), text: text.into() }
}

/// What follows the next `DATA;` that stands outside of strings and comments.
fn data_section(text: &str) -> Option<&str> {
    let mut rest = text;
    loop {
        rest = space(rest).map_or(rest, |(rest, ())| rest);
        let head = rest.get(..4)?;
        if head.eq_ignore_ascii_case("DATA") {
            // `DATA;` or, in later editions, `DATA(…);`
            return skip(rest).ok().map(|(rest, ())| rest);
        }
        rest = skip(rest).ok()?.0;
    }
}

type Read<'a, T> = IResult<&'a str, T>;

/// White space and comments.
fn space(input: &str) -> Read<'_, ()> {
    let comment = || delimited(tag("/*"), take_until("*/"), tag("*/"));
    value((), many0_count(alt((multispace1, comment())))).parse(input)
}

fn word(input: &str) -> Read<'_, &str> {
    take_while1(|c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-')).parse(input)
}

/// To behind the next `;` that stands outside of strings and comments.
fn skip(input: &str) -> Read<'_, ()> {
    let mut rest = input;
    loop {
        let (at, _): (_, &str) = take_till(|c| matches!(c, ';' | '\'' | '/')).parse(rest)?;
        let after = |input: &'static str| preceded(tag(input), |rest| Ok((rest, ())));
        if let Ok((end, ())) = after(";").parse(at) as Read<'_, ()> {
            return Ok((end, ()));
        }
        rest = if at.starts_with('\'') {
            quoted(at)?.0
        } else if at.starts_with("/*") {
            preceded((tag("/*"), take_until("*/")), tag("*/")).parse(at)?.0
        } else {
            preceded(tag("/"), |rest| Ok((rest, ()))).parse(at)?.0
        };
    }
}

/// The types that are taken apart, and those that are only counted.
struct Known {
    wanted: HashMap<&'static str, &'static str>,
    counted: HashMap<&'static str, &'static str>,
}

enum Found {
    Kept(u32, Instance),
    /// Passed over; its type, where that is counted.
    Passed(Option<&'static str>),
}

/// `#12=IFCDOOR(…);`
fn instance<'a>(input: &'a str, known: &Known) -> Read<'a, Found> {
    let (rest, id) = reference(input)?;
    let (rest, _) = (space, char('='), space).parse(rest)?;
    if rest.starts_with('(') {
        // Several types at once: units and colours are written so; none of them is needed.
        return map(skip, |()| Found::Passed(None)).parse(rest);
    }
    let (rest, name) = word(rest)?;
    let upper = name.to_ascii_uppercase();
    let Some(&kind) = known.wanted.get(upper.as_str()) else {
        let counted = known.counted.get(upper.as_str()).copied();
        return map(skip, |()| Found::Passed(counted)).parse(rest);
    };
    let (rest, values) = preceded(space, |i| list(i, 0)).parse(rest)?;
    let (rest, _) = (space, char(';')).parse(rest)?;
    Ok((rest, Found::Kept(id, Instance { kind, values })))
}

fn reference(input: &str) -> Read<'_, u32> {
    map_opt(preceded(char('#'), digit1), |n: &str| n.parse().ok()).parse(input)
}

fn list(input: &str, depth: usize) -> Read<'_, Box<[Value]>> {
    if depth > DEEPEST {
        return Err(nom::Err::Failure(Error::new(input, ErrorKind::TooLarge)));
    }
    let (mut rest, _) = (char('('), space).parse(input)?;
    let mut values = Vec::new();
    if let Ok((rest, _)) = char::<_, Error<&str>>(')').parse(rest) {
        return Ok((rest, values.into()));
    }
    loop {
        let (after, value) = any_value(rest, depth)?;
        values.push(value);
        let (after, _) = space(after)?;
        let (after, sign) = alt((char(','), char(')'))).parse(after)?;
        if sign == ')' {
            return Ok((after, values.into()));
        }
        rest = space(after)?.0;
    }
}

fn any_value(input: &str, depth: usize) -> Read<'_, Value> {
    alt((
        map(alt((char('$'), char('*'))), |_| Value::Nothing),
        map(reference, Value::Ref),
        map(quoted, |raw| Value::Text(decoded(raw).into())),
        map(delimited(char('.'), word, char('.')), |w| Value::Word(w.to_ascii_uppercase().into())),
        map(number, Value::Number),
        map(|i| list(i, depth + 1), Value::List),
        // `IFCLABEL('x')`: but for arcs the type adds nothing that the place does not say.
        |i| typed(i, depth + 1),
        map(delimited(char('"'), take_while(|c: char| c.is_ascii_hexdigit()), char('"')), |_| {
            Value::Nothing
        }),
    ))
    .parse(input)
}

/// A typed value: the value alone, or the list when there are several.
fn typed(input: &str, depth: usize) -> Read<'_, Value> {
    let (rest, (name, ())) = (word, space).parse(input)?;
    let (rest, values) = list(rest, depth)?;
    let mut values = values.into_vec();
    if name.eq_ignore_ascii_case("IFCARCINDEX") {
        values.insert(0, Value::Word("ARC".into()));
        return Ok((rest, Value::List(values.into())));
    }
    let value = if values.len() == 1 { values.remove(0) } else { Value::List(values.into()) };
    Ok((rest, value))
}

fn number(input: &str) -> Read<'_, f64> {
    let sign = || opt(alt((char('+'), char('-'))));
    let fraction = opt((char('.'), take_while(|c: char| c.is_ascii_digit())));
    let exponent = opt((alt((char('E'), char('e'))), sign(), digit1));
    let text = recognize((sign(), digit1, fraction, exponent));
    map_opt(text, |t: &str| t.parse::<f64>().ok().filter(|n| n.is_finite())).parse(input)
}

/// What stands between the apostrophes, with its escapes.
fn quoted(input: &str) -> Read<'_, &str> {
    let part = take_while1(|c| c != '\'');
    let inside = recognize(many0_count(alt((part, tag("''")))));
    delimited(char('\''), inside, char('\'')).parse(input)
}

/// Letters of a string. A broken escape stays as it is written.
fn decoded(raw: &str) -> String {
    if !raw.contains(['\\', '\'']) {
        return raw.to_owned();
    }
    let mut out = String::with_capacity(raw.len());
    let mut rest = raw;
    while let Some(at) = rest.find(['\\', '\'']) {
        out.push_str(&rest[..at]);
        rest = &rest[at..];
        let (length, letters) = escape(rest).unwrap_or_else(|| (1, rest[..1].to_owned()));
        out.push_str(&letters);
        rest = &rest[length..];
    }
    out + rest
}

/// The escape with which a text begins: its length and its letters.
fn escape(text: &str) -> Option<(usize, String)> {
    if text.starts_with("''") {
        return Some((2, "'".to_owned()));
    }
    if text.starts_with("\\\\") {
        return Some((2, "\\".to_owned()));
    }
    if let Some(rest) = text.strip_prefix("\\S\\") {
        // The upper half of ISO 8859-1.
        let letter = rest.chars().next().filter(char::is_ascii)?;
        return Some((4, char::from(letter as u8 | 0x80).to_string()));
    }
    if let Some(rest) = text.strip_prefix("\\X\\") {
        let code = u8::from_str_radix(rest.get(..2)?, 16).ok()?;
        return Some((5, char::from(code).to_string()));
    }
    for (mark, digits) in [("\\X2\\", 4), ("\\X4\\", 8)] {
        let Some(rest) = text.strip_prefix(mark) else { continue };
        let hex = &rest[..rest.find("\\X0\\")?];
        let length = mark.len() + hex.len() + 4;
        if !hex.is_ascii() || hex.len() % digits != 0 {
            return None;
        }
        let codes: Option<Vec<u32>> = (0..hex.len())
            .step_by(digits)
            .map(|at| u32::from_str_radix(&hex[at..at + digits], 16).ok())
            .collect();
        let codes = codes?;
        let letters = if digits == 4 {
            String::from_utf16_lossy(&codes.iter().map(|c| *c as u16).collect::<Vec<_>>())
        } else {
            codes.iter().map(|c| char::from_u32(*c).unwrap_or('\u{FFFD}')).collect()
        };
        return Some((length, letters));
    }
    // `\PA\` names an alphabet for `\S\`; it stands for no letter.
    let alphabet = text.strip_prefix("\\P")?;
    (alphabet.as_bytes().get(1) == Some(&b'\\')).then(|| (4, String::new()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escaped_letters_come_out_as_they_were() {
        assert_eq!(decoded("\\X2\\041A0443\\X0\\\\X2\\0445043D044F\\X0\\"), "Кухня");
        assert_eq!(decoded("d''Or \\S\\i \\X\\E9 \\\\ \\X4\\0001F6AA\\X0\\"), "d'Or é é \\ 🚪");
        assert_eq!(decoded("\\X2\\04\\X0\\ \\"), "\\X2\\04\\X0\\ \\");
        assert_eq!(decoded("\\PA\\a"), "a");
    }

    #[test]
    fn values_of_every_sort_are_read() {
        let text = "(#12, $,*,.T.,-1.E-2,'it''s',IFCLABEL('x'),(1,(2.5)),\"0F\")";
        let (rest, values) = list(text, 0).unwrap();
        assert_eq!(rest, "");
        use Value::{List, Nothing, Number, Ref, Text, Word};
        let inner = List([Number(1.0), List([Number(2.5)].into())].into());
        let expected = [
            Ref(12),
            Nothing,
            Nothing,
            Word("T".into()),
            Number(-0.01),
            Text("it's".into()),
            Text("x".into()),
            inner,
            Nothing,
        ];
        assert_eq!(*values, expected);
    }

    #[test]
    fn what_nobody_asks_for_is_passed_over_strings_and_comments_included() {
        let text = "ISO-10303-21;HEADER;FILE_NAME('DATA;','x');ENDSEC;\n/* DATA; */DATA;\n\
                    #1=IFCWALL('a;b',$);#2=(A(1)B(2)); #3 = ifcdoor ( 'Д' ) ;\n#4=IFCDOOR(oops;ENDSEC;\nEND-ISO-10303-21;";
        let mut remarks = Vec::new();
        let found =
            instances(&Source::new("x.ifc", text), &["IFCDOOR"], &["IFCWALL"], &mut remarks)
                .unwrap();
        assert_eq!(found.all("IFCDOOR").map(|(id, _)| id).collect::<Vec<_>>(), [3]);
        assert_eq!((found.count("IFCWALL"), found.count("IFCDOOR")), (1, 1));
        assert_eq!(remarks.len(), 1);
        assert!(remarks[0].text.to_string().contains("строка 4, столбец 12"), "{remarks:?}");
    }
}
