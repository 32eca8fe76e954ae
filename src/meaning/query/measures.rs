//! Measures as premises: superlatives, and which of two has more.

use crate::outcome::NoAnswer;
use crate::term::{Desc, Dimension, Measure, Mod, Quant, Sorts};

use super::{Asking, Body, amount, number};
use crate::facts::quoted;

impl Asking<'_> {
    /// The premise by which a superlative measures a thing, the variable of the measure, and whether more of it wins.
    pub(super) fn measured(
        &mut self,
        x: &str,
        best: &Mod,
        sorts: Sorts,
        body: &mut Body,
    ) -> Result<(String, String, bool), NoAnswer> {
        let v = body.variable();
        match best {
            Mod::Best(Measure { of: Dimension::Distance, most }, Some(to), _) => {
                let to = self.one(to, false)?;
                Ok((format!("distance_between({x}, {}, {v})", quoted(&to)), v, *most))
            }
            Mod::Best(Measure { of: Dimension::Level, most }, None, _) => {
                let foot = amount(Dimension::Level, x, sorts, &v)?;
                let premises = body.premises.join(", ");
                let rule =
                    format!("{}\n?- answer({v}) :- {premises}, {foot}", body.helpers.join("\n"));
                let feet: Vec<i64> =
                    self.rows(rule.trim())?.iter().filter_map(|r| number(r, 0)).collect();
                let spread = feet.iter().max().zip(feet.iter().min()).map_or(0, |(a, b)| a - b);
                let of =
                    if spread > self.level_equal() { Dimension::Level } else { Dimension::Height };
                Ok((amount(of, x, sorts, &v)?, v, *most))
            }
            Mod::Best(Measure { of, most }, None, _) => Ok((amount(*of, x, sorts, &v)?, v, *most)),
            Mod::MostOf { role, what, most } => {
                let before = std::mem::take(&mut body.premises);
                let y = body.variable();
                let is_loose = std::mem::replace(&mut body.is_loose, true);
                self.describe(&Desc { quant: Quant::Some, ..what.clone() }, &y, body)?;
                let terms = [(y.clone(), what.sorts), (x.to_owned(), sorts)];
                let premise = self.role(*role, &terms, body)?;
                body.is_loose = is_loose;
                let premises = std::mem::replace(&mut body.premises, before).join(", ");
                let name = format!("of_it_{}", body.helpers.len() + 1);
                body.helpers.push(format!(
                    ".decl {name}(y: Any, x: Any)\n{name}({y}, {x}) :- {premises}, {premise}."
                ));
                Ok((format!("{v} = count : {{ {name}(_, {x}) }}"), v, *most))
            }
            _ => Err(NoAnswer::Unfit("such a measure")),
        }
    }

    /// Levels nearer to each other are one, tenths of a millimetre.
    pub(crate) fn level_equal(&self) -> i64 {
        (self.map.relations.thresholds().level_equal * 100.0).round() as i64
    }

    /// The measures of two things, of which the greater has more; of levels nearly equal their heights.
    pub(crate) fn amounts(
        &mut self,
        (a, b): (&str, &str),
        of: Dimension,
        sorts: Sorts,
    ) -> Result<(i64, i64), NoAnswer> {
        let first = amount(of, &quoted(a), sorts, "A")?;
        let second = amount(of, &quoted(b), sorts, "B")?;
        let rows = self.rows(&format!("?- answer(A, B) :- {first}, {second}"))?;
        let pair = rows.first().and_then(|row| Some((number(row, 0)?, number(row, 1)?)));
        let (x, y) = pair.ok_or(NoAnswer::Unfit("the measures of such things"))?;
        if of == Dimension::Level && (x - y).abs() <= self.level_equal() {
            return self.amounts((a, b), Dimension::Height, sorts);
        }
        // What is told to be as much is not more: floors are told in hundredths of m², lengths in cm.
        let told =
            |v: i64| if of == Dimension::Size && sorts != Sorts::AREA { v } else { (v + 50) / 100 };
        Ok((told(x), told(y)))
    }
}
