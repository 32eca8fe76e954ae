//! A step told in arguments, written out as an edit file.

use std::fmt::Write as _;

use serde_json::json;

use super::step::{At, Group, KindArg, Names, Numbers, Step};

/// An edit file in the making.
#[derive(Default)]
struct Text(String);

impl Text {
    fn head(header: &str) -> Self {
        Self(format!("{header}\n"))
    }

    fn step(verb: &str, what: &str) -> Self {
        Self::head("[[edit]]").text(verb, what)
    }

    fn line(mut self, field: &str, value: &str) -> Self {
        let _ = writeln!(self.0, "{field} = {value}");
        self
    }

    fn text(self, field: &str, value: &str) -> Self {
        self.line(field, &quoted(value))
    }

    fn opt(self, field: &str, value: Option<&String>) -> Self {
        value.map_or_else(String::new, |v| format!("{field} = {}\n", quoted(v))).prepend(self)
    }

    fn flag(self, field: &str, is_set: bool) -> Self {
        if is_set { self.line(field, "true") } else { self }
    }

    fn number(self, field: &str, value: Option<f64>) -> Self {
        match value {
            Some(value) => self.line(field, &value.to_string()),
            None => self,
        }
    }

    fn numbers(self, field: &str, value: Option<&Numbers>) -> Self {
        match value {
            Some(Numbers(list)) => self.line(field, &list_of(list)),
            None => self,
        }
    }

    fn at(self, at: &At) -> Self {
        self.numbers("at", at.at.as_ref()).number("angle", at.angle)
    }

    fn kind(self, kind: &KindArg) -> Self {
        self.opt("kind", kind.kind.as_ref())
    }

    fn names(self, names: &Names) -> Self {
        let mut text = self
            .opt("name", names.name.as_ref())
            .opt("name_en", names.name_en.as_ref())
            .opt("type", names.kind_of.as_ref());
        for pair in &names.properties {
            let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
            text = text.text(&format!("properties.{}", quoted(name)), value);
        }
        text
    }

    fn links(self, links: &[String]) -> Self {
        if links.is_empty() {
            return self;
        }
        let link = |link: &String| {
            let (from, to) = link.split_once('=').unwrap_or((link, ""));
            format!("  {{ from = {}, to = {} }},\n", quoted(from.trim()), quoted(to.trim()))
        };
        let lines: String = links.iter().map(link).collect();
        self.line("links", &format!("[\n{lines}]"))
    }
}

trait Prepend {
    fn prepend(self, text: Text) -> Text;
}

impl Prepend for String {
    fn prepend(self, text: Text) -> Text {
        Text(text.0 + &self)
    }
}

/// A text between quotation marks, as TOML and JSON write it alike.
fn quoted(text: &str) -> String {
    json!(text).to_string()
}

/// `X,Y X,Y …` as a list of points; what is no number is left for the reader to refuse.
fn corners(points: &str) -> String {
    let corners: Vec<String> = points.split_whitespace().map(|p| format!("[{p}]")).collect();
    format!("[{}]", corners.join(", "))
}

fn list_of(numbers: &[f64]) -> String {
    let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
    format!("[{}]", words.join(", "))
}

/// `KEY[@X,Y[,Z[,DEG]]]` as the fields of a line; what is no number is left for the reader to refuse.
fn placed(field: &str, text: &str) -> String {
    let Some((key, at)) = text.split_once('@') else {
        return format!("{field} = {}", quoted(text.trim()));
    };
    let mut numbers: Vec<&str> = at.split(',').map(str::trim).collect();
    let angle = if numbers.len() == 4 { numbers.pop() } else { None };
    let angle = angle.map_or_else(String::new, |a| format!(", angle = {a}"));
    format!("{field} = {}, at = [{}]{angle}", quoted(key.trim()), numbers.join(", "))
}

fn group(text: Text, group: &Group) -> Text {
    let item = |item: &String| {
        let (id, rest) = item.split_once('=').unwrap_or((item, ""));
        format!("  {{ id = {}, {} }},\n", quoted(id.trim()), placed("orthoframe", rest))
    };
    let items: String = group.items.iter().map(item).collect();
    text.line("items", &format!("[\n{items}]")).links(&group.links)
}

impl Step {
    /// The step as an edit file.
    pub(super) fn text(&self) -> String {
        let record = |section: &str, key: &str| Text::head(&format!("[{section}.{}]", quoted(key)));
        let text = match self {
            Self::Place { name, object, area, at, pose, move_prob, name_en } => {
                Text::step("place", name)
                    .text("object", object)
                    .text("area", area)
                    .at(at)
                    .numbers("pose", pose.as_ref())
                    .number("move_prob", move_prob.map(f64::from))
                    .opt("name_en", name_en.as_ref())
            }
            Self::Point { name, area, at, pose, heading, serves } => Text::step("point", name)
                .text("area", area)
                .numbers("at", at.as_ref())
                .numbers("pose", pose.as_ref())
                .number("heading", *heading)
                .opt("serves", serves.as_ref()),
            Self::Move { name, to, by, area, carry } => Text::step("move", name)
                .numbers("to", to.as_ref())
                .numbers("by", by.as_ref())
                .opt("area", area.as_ref())
                .flag("carry", *carry),
            Self::Turn { name, to, by, carry } => {
                Text::step("turn", name).number("to", *to).number("by", *by).flag("carry", *carry)
            }
            Self::Remove { name, kind } => Text::step("remove", name).kind(kind),
            Self::Rename { name, to, en, kind } => {
                Text::step("rename", name).opt("to", to.as_ref()).opt("en", en.as_ref()).kind(kind)
            }
            Self::Set { name, property, value, side, kind } => Text::step("set", name)
                .text("property", property)
                .text("value", value)
                .opt("side", side.as_ref())
                .kind(kind),
            Self::Unset { name, property, side, kind } => Text::step("unset", name)
                .text("property", property)
                .opt("side", side.as_ref())
                .kind(kind),
            Self::MoveProb { name, percent } => {
                Text::step("set", name).number("move_prob", Some(f64::from(*percent)))
            }
            Self::State { door, state, opening, on } => Text::step("state", door)
                .text("is", state)
                .number("opening", *opening)
                .opt("on", on.as_ref()),
            Self::Orthoframe { key, rect, points, regular, height, base, roof, side, names } => {
                let mut text = record("orthoframe", key)
                    .numbers("rect", rect.as_ref())
                    .number("height", Some(*height))
                    .opt("base", base.as_ref())
                    .opt("roof", roof.as_ref())
                    .names(names);
                if let Some(points) = points {
                    text = text.line("points", &corners(points));
                }
                if let Some(Numbers(regular)) = regular {
                    let word = |i: usize| regular.get(i).map_or_else(String::new, f64::to_string);
                    let table = format!("{{ corners = {}, radius = {} }}", word(0), word(1));
                    text = text.line("regular", &table);
                }
                for side in side {
                    let (id, traits) = side.split_once('=').unwrap_or((side, ""));
                    let (permeability, kind) = traits.split_once(',').unwrap_or((traits, ""));
                    let field = format!("side.{}", quoted(id.trim()));
                    text = text.text(&format!("{field}.permeability"), permeability.trim());
                    if !kind.is_empty() {
                        text = text.text(&format!("{field}.type"), kind.trim());
                    }
                }
                text
            }
            Self::Door { key, kind, width, height, leaf, state, names } => {
                let text = record("door", key)
                    .text("kind", kind)
                    .number("width", Some(*width))
                    .number("height", Some(*height))
                    .opt("state", state.as_ref())
                    .names(names);
                let leaves: Vec<String> = leaf
                    .iter()
                    .map(|leaf| match leaf.split_once('=') {
                        Some((hinge, share)) => {
                            format!("{{ hinge = {}, share = {share} }}", quoted(hinge))
                        }
                        None => format!("{{ hinge = {} }}", quoted(leaf)),
                    })
                    .collect();
                text.line("leaves", &format!("[{}]", leaves.join(", ")))
            }
            Self::Object { key, group: parts, front, back, names } => {
                group(record("object", key), parts)
                    .opt("front", front.as_ref())
                    .opt("back", back.as_ref())
                    .names(names)
            }
            Self::Area { key, group: parts, names } => {
                group(record("area", key), parts).names(names)
            }
            Self::Map { key, areas, links, names } => {
                let item = |item: &String| format!("  {{ {} }},\n", placed("area", item));
                let items: String = areas.iter().map(item).collect();
                let text = record("map", key).line("items", &format!("[\n{items}]"));
                text.links(links).names(names)
            }
            Self::Bind { door, to, side, opens } => Text::step("bind", door)
                .text("to", to)
                .text("side", side)
                .opt("opens", opens.as_ref()),
            Self::Unbind { door, from } => Text::step("unbind", door).opt("from", from.as_ref()),
            Self::Item { id, of, orthoframe, at } => {
                Text::step("item", id).text("of", of).text("orthoframe", orthoframe).at(at)
            }
            Self::Link { from, to, of, rel, angle } => Text::step("link", from)
                .text("to", to)
                .opt("of", of.as_ref())
                .numbers("rel", rel.as_ref())
                .number("angle", *angle),
            Self::Unlink { from, to, of } => {
                Text::step("unlink", from).text("to", to).opt("of", of.as_ref())
            }
            Self::Stand { area, map, at } => {
                Text::step("stand", area).opt("map", map.as_ref()).at(at)
            }
            Self::Include { map, at } => Text::step("include", map).at(at),
            Self::Lift { name, stops } => {
                let stops: Vec<String> = stops.iter().map(|s| quoted(s.trim())).collect();
                Text::step("lift", name).line("stops", &format!("[{}]", stops.join(", ")))
            }
            Self::Zone {
                name,
                kind,
                rooms,
                points,
                map,
                speed,
                heading,
                reason,
                reason_en,
                from,
                until,
                name_en,
            } => {
                let mut text = Text::step("zone", name).opt("kind", kind.as_ref());
                if !rooms.is_empty() {
                    let rooms: Vec<String> = rooms.iter().map(|r| quoted(r.trim())).collect();
                    text = text.line("rooms", &format!("[{}]", rooms.join(", ")));
                }
                if let Some(points) = points {
                    text = text.line("points", &corners(points));
                }
                text.opt("map", map.as_ref())
                    .number("speed", *speed)
                    .number("heading", *heading)
                    .opt("reason", reason.as_ref())
                    .opt("reason_en", reason_en.as_ref())
                    .opt("from", from.as_ref())
                    .opt("until", until.as_ref())
                    .opt("name_en", name_en.as_ref())
            }
        };
        text.0
    }
}
