//! The unit of lengths in arguments: centimetres unless `--units` or `ortho.toml` says otherwise.
//!
//! Which arguments are lengths, and which numbers within them, tells the name of their value: `CM`, `X,Y[,Z]`,
//! `AREA@X,Y[,Z[,DEG]]`, `X,Y,HEADING`; a place may be a name or `X,Y`. They are brought to centimetres before they are
//! read, so nothing behind the command line knows of another unit. A number may bear its unit whatever is usual: `2.5m`.

use std::ffi::OsString;

use clap::{Arg, Command};

use crate::units::Lengths;

/// Which numbers of a value are lengths, by the name under which it is shown.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Shape {
    lengths: Vec<bool>,
    /// They stand behind an `@`.
    is_behind: bool,
}

impl Shape {
    fn of(arg: &Arg) -> Option<Self> {
        let name = match arg.get_value_names()?.first()?.as_str() {
            "CM" => "X",
            "PLACE" => "X,Y",
            name => name,
        };
        let (is_behind, fields) = match name.split_once('@') {
            Some((_, fields)) => (true, fields),
            None => (false, name),
        };
        let fields = fields.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty());
        let is_length =
            |word: &str| matches!(word, "X" | "Y" | "Z" | "DX" | "DY" | "DZ" | "W" | "D" | "R");
        let lengths: Vec<bool> = fields.map(is_length).collect();
        lengths.contains(&true).then_some(Self { lengths, is_behind })
    }

    /// The value in centimetres; several points may stand in one. What is no such value is none, for its reader to refuse.
    fn in_cm(&self, value: &str, unit: Lengths) -> Option<String> {
        let (before, points) = match self.is_behind {
            true => value.split_once('@').map(|(name, point)| (format!("{name}@"), point))?,
            false => (String::new(), value),
        };
        let points = points.split_whitespace().map(|point| self.point(point, unit));
        Some(before + &points.collect::<Option<Vec<_>>>()?.join(" "))
    }

    fn point(&self, point: &str, unit: Lengths) -> Option<String> {
        let field = |(no, text): (usize, &str)| match self.lengths.get(no) {
            Some(true) => centimetres(text, unit),
            _ => Some(text.to_owned()),
        };
        Some(point.split(',').enumerate().map(field).collect::<Option<Vec<_>>>()?.join(","))
    }
}

fn centimetres(text: &str, unit: Lengths) -> Option<String> {
    let text = text.trim();
    let number = text.trim_end_matches(char::is_alphabetic);
    let unit = match &text[number.len()..] {
        "" if unit == Lengths::M => "m",
        "" => "cm",
        told => told,
    };
    let number = number.trim_end();
    let value: f64 = number.parse().ok().filter(|value: &f64| value.is_finite())?;
    let factor = match unit {
        "mm" | "мм" => 0.1,
        // As it is written: a number is not changed where its unit is not.
        "cm" | "см" => return Some(number.to_owned()),
        "m" | "м" => 100.0,
        _ => return None,
    };
    // A tenth of a millimetre is the finest that is known.
    Some(((value * factor * 100.0).round() / 100.0).to_string())
}

/// The arguments of a call with their lengths in centimetres.
pub(super) fn in_centimetres(
    root: &Command,
    arguments: impl IntoIterator<Item = OsString>,
    unit: Lengths,
) -> Vec<OsString> {
    // The value that the option before asks for, and its shape where it has lengths.
    let (mut command, mut awaited) = (root, None::<Option<Shape>>);
    let mut arguments = arguments.into_iter();
    let mut done: Vec<OsString> = arguments.by_ref().take(1).collect();
    for argument in arguments.by_ref() {
        let text = argument.to_string_lossy();
        let in_cm = |shape: Option<Shape>, value: &str| shape?.in_cm(value, unit);
        let brought = match (awaited.take(), text.strip_prefix("--")) {
            (Some(shape), _) => in_cm(shape, &text),
            // What follows is values by their place.
            (None, Some("")) => {
                done.push(argument);
                break;
            }
            (None, Some(option)) => {
                let (name, value) = option
                    .split_once('=')
                    .map_or((option, None), |(name, value)| (name, Some(value)));
                let all = command.get_arguments().chain(root.get_arguments());
                let arg = all.into_iter().find(|arg| arg.get_long() == Some(name));
                let shape = arg.and_then(Shape::of);
                if value.is_none() && arg.is_some_and(|arg| arg.get_action().takes_values()) {
                    awaited = Some(shape);
                    None
                } else {
                    value.and_then(|value| in_cm(shape, value)).map(|cm| format!("--{name}={cm}"))
                }
            }
            (None, None) => {
                command = command.find_subcommand(&*text).unwrap_or(command);
                None
            }
        };
        done.push(brought.map_or_else(|| argument.clone(), OsString::from));
    }
    done.extend(arguments);
    done
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;
    use expect_test::{Expect, expect};

    use super::*;

    fn check(line: &str, unit: Lengths, expect: &Expect) {
        let words = line.split('|').map(OsString::from);
        let done = in_centimetres(&crate::cli::args::Arguments::command(), words, unit);
        let done: Vec<_> = done.iter().map(|word| word.to_string_lossy()).collect();
        expect.assert_eq(&done.join("|"));
    }

    #[test]
    fn lengths_of_arguments_are_brought_to_centimetres_and_nothing_else_is() {
        use Lengths::{Cm, M};
        check("ortho|where|--at|2.25,3.8,90", M, &expect!["ortho|where|--at|225,380,90"]);
        check("ortho|where|--at|225,380,90", Cm, &expect!["ortho|where|--at|225,380,90"]);
        check("ortho|where|--at|2.25m,3800mm", Cm, &expect!["ortho|where|--at|225,380"]);
        check(
            "ortho|--units|m|route|--from|1.5,2|--to|Точка-К",
            M,
            &expect!["ortho|--units|m|route|--from|150,200|--to|Точка-К"],
        );
        check(
            "ortho|edit|move|Стол-1|--by=-0.1,0",
            M,
            &expect!["ortho|edit|move|Стол-1|--by=-10,0"],
        );
        check(
            "ortho|edit|zone|1.5|--points|0,0 1.5,0|--speed|0.3",
            M,
            &expect!["ortho|edit|zone|1.5|--points|0,0 150,0|--speed|0.3"],
        );
        check(
            "ortho|edit|map|k|--area|room@0,2.5,0,90",
            M,
            &expect!["ortho|edit|map|k|--area|room@0,250,0,90"],
        );
        check("ortho|where|--at|2.25 yards,1", M, &expect!["ortho|where|--at|2.25 yards,1"]);
        check(
            "ortho|edit|orthoframe|k|--height|0.7|--regular|6,0.2",
            M,
            &expect!["ortho|edit|orthoframe|k|--height|70|--regular|6,20"],
        );
        check(
            "ortho|--store|where|where|--at|1,1",
            M,
            &expect!["ortho|--store|where|where|--at|100,100"],
        );
        check("ortho|where|--at|inf,NaN", M, &expect!["ortho|where|--at|inf,NaN"]);
    }
}
