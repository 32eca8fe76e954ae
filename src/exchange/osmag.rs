//! osmAG: areas of a building in OpenStreetMap's XML, with passages between them.
//!
//! An *area* is a closed way tagged `osmAG:type=area`; those of `osmAG:areaType=structure` only hold others and are no
//! floor. A *passage* is a way tagged `osmAG:type=passage` along the opening, with the names or ids of the two areas in
//! `osmAG:from` and `osmAG:to`. Latitude and longitude are laid flat about the root node. Rooms of one name on several
//! levels that lie over one another, and those that a passage joins from level to level, are a flight of stairs or a shaft if
//! they are of a type that is; the file itself does not say. An area that is drawn as a mere line still arrives:
//! its floor is what its passages enclose, else a strip. Ways of plain indoor tagging (`indoor=room`,
//! `area`, `corridor`) are rooms too.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use roxmltree::{Document, Node, ParsingOptions};

use crate::geometry::convex_hull;
use crate::map::Properties;
use crate::map::plane::{bounds, doubled_area};
use crate::units::{Bilingual, Cm, Point, Source, Vector, said, word};

use super::assemble::ring::{self, LEAST_AREA, Ring};
use super::{Level, Lift, Opening, OpeningKind, ReadError, Remark, Room, Survey, zero_of};

const FORMAT: &str = "osmAG";
/// Mean radius of the earth, cm.
const EARTH: f64 = 637_100_880.0;
/// Floor to floor where the file does not tell, cm.
const STOREY: f64 = 320.0;
/// The least width of a strip of floor, cm.
const STRIP: f64 = 20.0;
/// Areas drawn as lines that get a floor; a file of more is no drawing of a building.
const MOST_THIN: usize = 500;
/// Elements of one file.
const MOST: u32 = 20_000_000;

/// Whether a text is OpenStreetMap's XML.
#[must_use]
pub(super) fn recognises(text: &str) -> bool {
    let mut end = text.len().min(2000);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    text[..end].contains("<osm")
}

/// Reads a building.
///
/// # Errors
/// [`ReadError::Syntax`]; [`ReadError::NoBuilding`] when it has no area.
pub fn read(source: &Source) -> Result<Survey, ReadError> {
    let options =
        ParsingOptions { allow_dtd: false, nodes_limit: MOST, ..ParsingOptions::default() };
    let document = Document::parse_with_options(source.text(), options).map_err(|e| {
        let pos = e.pos();
        let lines = source.text().split_inclusive('\n');
        let start: usize = lines.take((pos.row as usize).saturating_sub(1)).map(str::len).sum();
        let rest = source.text().get(start..).unwrap_or_default();
        let within: usize =
            rest.chars().take((pos.col as usize).saturating_sub(1)).map(char::len_utf8).sum();
        ReadError::syntax(
            FORMAT,
            said!("this-is-no-xml", reason = e.to_string()),
            source,
            start + within,
        )
    })?;
    let mut reader = Reader { ways: ways(document.root_element()), ..Reader::default() };
    reader.nodes(document.root_element());
    reader.areas();
    if reader.areas.is_empty() {
        let what = word!("there-is-no-way-with").into();
        return Err(ReadError::NoBuilding { format: FORMAT, what });
    }
    reader.thin_areas();
    reader.passages();
    reader.shafts();
    Ok(reader.survey)
}

type Tags<'x> = BTreeMap<&'x str, &'x str>;

struct Way<'x> {
    id: &'x str,
    tags: Tags<'x>,
    nodes: Vec<&'x str>,
}

#[derive(Default)]
struct Reader<'x> {
    ways: Vec<Way<'x>>,
    points: HashMap<&'x str, Point>,
    survey: Survey,
    /// Every area that is a room: its level, its place there, its name and id.
    areas: Vec<Found<'x>>,
    by_word: HashMap<&'x str, Vec<usize>>,
}

struct Found<'x> {
    level: usize,
    room: usize,
    name: &'x str,
}

fn tags<'x>(element: Node<'x, '_>) -> Tags<'x> {
    let tag = |t: Node<'x, '_>| Some((t.attribute("k")?, t.attribute("v")?));
    element.children().filter(|c| c.has_tag_name("tag")).filter_map(tag).collect()
}

fn ways<'x>(root: Node<'x, '_>) -> Vec<Way<'x>> {
    let mut seen = BTreeSet::new();
    root.children()
        .filter(|c| c.has_tag_name("way") && c.attribute("action") != Some("delete"))
        .filter_map(|way| {
            let id = way.attribute("id")?;
            let nodes = way.children().filter(|c| c.has_tag_name("nd"));
            seen.insert(id).then(|| Way {
                id,
                tags: tags(way),
                nodes: nodes.filter_map(|nd| nd.attribute("ref")).collect(),
            })
        })
        .collect()
}

impl<'x> Reader<'x> {
    fn remark(&mut self, source: &str, text: impl Into<Bilingual>) {
        self.survey.remarks.push(Remark { source: source.to_owned(), text: text.into() });
    }

    /// Lays latitude and longitude flat about the root.
    fn nodes(&mut self, root: Node<'x, '_>) {
        let number = |n: Node<'x, '_>, name: &str| {
            n.attribute(name)?.trim().parse::<f64>().ok().filter(|v| v.is_finite())
        };
        let mut places: Vec<(&str, f64, f64, bool)> = Vec::new();
        for node in root.children().filter(|c| c.has_tag_name("node")) {
            let Some(id) = node.attribute("id") else { continue };
            match (number(node, "lat"), number(node, "lon")) {
                (Some(lat), Some(lon)) if lat.abs() <= 89.0 && lon.abs() <= 360.0 => {
                    let is_root = node.attribute("root") == Some("true")
                        || tags(node).get("name") == Some(&"root");
                    places.push((id, lat, lon, is_root));
                }
                _ => self.remark(id, word!("a-node-is-left-out")),
            }
        }
        let Some(&(_, lat0, lon0, _)) = places.iter().find(|p| p.3).or(places.first()) else {
            return;
        };
        self.survey.frame = zero_of(lat0, lon0);
        let east = EARTH * lat0.to_radians().cos();
        for (id, lat, lon, _) in places {
            let p = Point::new((lon - lon0).to_radians() * east, (lat - lat0).to_radians() * EARTH);
            // Of two nodes with one id the first counts; JOSM writes the root twice.
            if Cm::new(p.x).is_ok() && Cm::new(p.y).is_ok() {
                self.points.entry(id).or_insert(p);
            }
        }
    }

    fn outline(&mut self, way: usize) -> Vec<Point> {
        let mut outline = Vec::new();
        let mut missing = 0;
        for node in &self.ways[way].nodes {
            match self.points.get(node) {
                Some(&p) => outline.push(p),
                None => missing += 1,
            }
        }
        if missing > 0 {
            let id = self.ways[way].id;
            self.remark(id, said!("nodes-of-the-outline-are", missing));
        }
        outline
    }

    fn areas(&mut self) {
        let is_room = |tags: &Tags<'_>| {
            let kind = tags.get("osmAG:type").copied();
            let indoor = matches!(tags.get("indoor"), Some(&("room" | "area" | "corridor")));
            let structure = tags.get("osmAG:areaType") == Some(&"structure");
            !structure && (kind == Some("area") || kind.is_none() && indoor)
        };
        let rooms: Vec<usize> =
            (0..self.ways.len()).filter(|&i| is_room(&self.ways[i].tags)).collect();
        let mut levels: Vec<f64> = rooms.iter().map(|&i| level(&self.ways[i].tags)).collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        self.survey.name = self
            .ways
            .iter()
            .find(|w| w.tags.contains_key("building"))
            .and_then(|w| w.tags.get("name"))
            .map_or_else(String::new, |name| (*name).to_owned());
        let storey = rooms
            .iter()
            .filter_map(|&i| height(&self.ways[i].tags))
            .fold(0.0_f64, |most, h| most.max(h.get()));
        let storey = if storey > 0.0 { storey } else { STOREY };
        let lowest = levels.first().copied().unwrap_or(0.0);
        self.survey.levels = levels
            .iter()
            .map(|&number| Level {
                source: number.to_string(),
                name: number.to_string(),
                elevation: Cm::new((number - lowest) * storey).unwrap_or(Cm::ZERO),
                ..Level::default()
            })
            .collect();
        for way in rooms {
            let outline = self.outline(way);
            let Way { id, tags, .. } = &self.ways[way];
            let number = level(tags);
            let at = levels.iter().position(|l| l.total_cmp(&number).is_eq()).unwrap_or(0);
            let name = tags.get("name").copied().unwrap_or_default();
            let mut properties = Properties::new();
            if let Some(parent) = tags.get("osmAG:parent") {
                properties.insert("ЧАСТЬ".to_owned(), (*parent).to_owned());
            }
            let own = tags.get("osmAG:areaType").filter(|kind| **kind != "room");
            let kind = ["room", "osmAG:roomType", "amenity", "highway"]
                .into_iter()
                .find_map(|key| tags.get(key))
                .or(own)
                .map_or_else(|| name.to_owned(), |kind| (*kind).to_owned());
            let room = self.survey.levels[at].rooms.len();
            let found = self.areas.len();
            self.by_word.entry(name).or_default().push(found);
            self.by_word.entry(id).or_default().push(found);
            self.areas.push(Found { level: at, room, name });
            self.survey.levels[at].rooms.push(Room {
                source: (*id).to_owned(),
                name: name.to_owned(),
                kind,
                called: String::new(),
                outline,
                holes: Vec::new(),
                height: height(tags),
                properties,
            });
        }
    }

    /// Gives a floor to areas that have none of their own: what their passages enclose, else a strip along their line.
    fn thin_areas(&mut self) {
        let is_thin = |room: &Room| {
            let outline = &room.outline;
            doubled_area(outline).abs() < 2.0 * LEAST_AREA && ring::clean(outline, &[]).is_none()
        };
        let thin: Vec<usize> = (0..self.areas.len())
            .filter(|&i| {
                is_thin(&self.survey.levels[self.areas[i].level].rooms[self.areas[i].room])
            })
            .take(MOST_THIN)
            .collect();
        if thin.is_empty() {
            return;
        }
        let mut lines = self.passage_lines();
        for area in thin {
            let Found { level, room, .. } = self.areas[area];
            let record = &self.survey.levels[level].rooms[room];
            let line = record.outline.clone();
            let others: Vec<Ring> = self.survey.levels[level]
                .rooms
                .iter()
                .enumerate()
                .filter(|(i, other)| *i != room && other.outline.len() > 2)
                .map(|(_, other)| ring::counter_clockwise(other.outline.clone()))
                .collect();
            let jambs = lines.remove(&area).unwrap_or_default();
            let (outline, text) = match enclosed(&line, &jambs, &others) {
                Some(outline) => (outline, word!("there-is-no-outline-what").into()),
                None => match strip(&line, &others) {
                    Some(outline) => {
                        let text = said!("outline-is-a-line", wide = strip_width(&line));
                        (outline, text)
                    }
                    None => continue,
                },
            };
            let source = record.source.clone();
            self.survey.levels[level].rooms[room].outline = outline;
            self.remark(&source, text);
        }
    }

    /// The jambs of the passages that name each area.
    fn passage_lines(&self) -> HashMap<usize, Vec<Point>> {
        let mut lines: HashMap<usize, Vec<Point>> = HashMap::new();
        for way in self.ways.iter().filter(|w| w.tags.get("osmAG:type") == Some(&"passage")) {
            let line: Vec<Point> =
                way.nodes.iter().filter_map(|n| self.points.get(n)).copied().collect();
            let Some(&first) = line.first() else { continue };
            let wanted = way.tags.get("level").map(|_| level(&way.tags));
            for key in ["osmAG:from", "osmAG:to"] {
                let found = way.tags.get(key).and_then(|word| self.nearest(word, wanted, first));
                if let Some(found) = found {
                    lines.entry(found).or_default().extend(&line);
                }
            }
        }
        lines
    }

    fn passages(&mut self) {
        let passages: Vec<usize> = (0..self.ways.len())
            .filter(|&i| self.ways[i].tags.get("osmAG:type") == Some(&"passage"))
            .collect();
        for way in passages {
            let line = self.outline(way);
            let Way { id, tags, .. } = &self.ways[way];
            let (id, tags) = (*id, tags.clone());
            let (Some(&first), Some(&last)) = (line.first(), line.last()) else {
                self.remark(id, word!("the-passage-is-left-out"));
                continue;
            };
            let wanted = tags.get("level").map(|_| level(&tags));
            let mut ends = Vec::new();
            for key in ["osmAG:from", "osmAG:to"] {
                match tags.get(key) {
                    None => self.remark(id, said!("the-passage-has-no", key)),
                    Some(&word) => match self.nearest(word, wanted, first) {
                        Some(found) => ends.push(found),
                        None => {
                            let text = said!("the-passage-refers-to-which", word);
                            self.remark(id, text);
                        }
                    },
                }
            }
            let rooms = match ends[..] {
                [one, other] => {
                    let (a, b) = (&self.areas[one], &self.areas[other]);
                    if a.level == b.level {
                        Some((a.level, [Some(a.room), Some(b.room)]))
                    } else {
                        let stops = vec![(a.level, a.room), (b.level, b.room)];
                        let name = a.name.to_owned();
                        let source = id.to_owned();
                        self.survey.lifts.push(Lift { source, name, stops, is_told: false });
                        continue;
                    }
                }
                _ => None,
            };
            let at = rooms.map(|(level, _)| level).or_else(|| {
                let number = wanted?;
                self.survey.levels.iter().position(|l| l.source == number.to_string())
            });
            let Some(at) = at.or_else(|| ends.first().map(|&e| self.areas[e].level)) else {
                self.remark(id, word!("the-passage-is-left-out-its"));
                continue;
            };
            self.survey.levels[at].openings.push(Opening {
                source: id.to_owned(),
                name: String::new(),
                what: OpeningKind::Passage,
                jambs: [first, last],
                rooms: rooms.map(|(_, rooms)| rooms),
                height: None,
                sill: Cm::ZERO,
                properties: Properties::new(),
            });
        }
    }

    /// The area of a name or id: of several, one of the wanted level, then the nearest.
    fn nearest(&self, word: &str, wanted: Option<f64>, at: Point) -> Option<usize> {
        let distance = |found: usize| {
            let area = &self.areas[found];
            let level = &self.survey.levels[area.level];
            let away = level.rooms[area.room]
                .outline
                .iter()
                .map(|p| (p - at).norm())
                .fold(f64::INFINITY, f64::min);
            let is_other = wanted.is_some_and(|number| level.source != number.to_string());
            (is_other, away)
        };
        self.by_word.get(word)?.iter().copied().min_by(|&a, &b| {
            let ((other_a, away_a), (other_b, away_b)) = (distance(a), distance(b));
            other_a.cmp(&other_b).then(away_a.total_cmp(&away_b))
        })
    }

    /// Rooms of one name over one another.
    fn shafts(&mut self) {
        let mut by_name: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (i, area) in self.areas.iter().enumerate() {
            if !area.name.is_empty() {
                by_name.entry(area.name).or_default().push(i);
            }
        }
        for (name, found) in by_name {
            let outline = |i: usize| {
                let area = &self.areas[i];
                let room = &self.survey.levels[area.level].rooms[area.room];
                bounds(room.outline.iter().copied())
            };
            let first = found[0];
            let mut stops = vec![(self.areas[first].level, self.areas[first].room)];
            for &i in &found[1..] {
                let (a, b) = (outline(first), outline(i));
                let common = a.1.inf(&b.1) - a.0.sup(&b.0);
                let level = self.areas[i].level;
                if common.x > 0.0 && common.y > 0.0 && stops.iter().all(|s| s.0 != level) {
                    stops.push((level, self.areas[i].room));
                }
            }
            if stops.len() > 1 {
                let name = name.to_owned();
                let source = name.clone();
                self.survey.lifts.push(Lift { source, name, stops, is_told: false });
            }
        }
    }
}

/// The floor between the passages of an area, where no other area lies; None when they enclose none.
fn enclosed(line: &[Point], jambs: &[Point], others: &[Ring]) -> Option<Ring> {
    if jambs.len() < 4 {
        return None;
    }
    let points: Vec<Point> = line.iter().chain(jambs).copied().collect();
    let hull = ring::clean(&convex_hull(points), &[])?.region;
    Some(ring::largest(ring::subtract(&hull, others))?.outer)
}

/// Wide enough for the least floor that a room may have, cm.
fn strip_width(line: &[Point]) -> f64 {
    let length: f64 = line.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    (1.05 * LEAST_AREA / length).max(STRIP)
}

/// A strip along a line, on that side of it where it takes least from others.
fn strip(line: &[Point], others: &[Ring]) -> Option<Ring> {
    let (&a, &b) = (
        line.first()?,
        line.iter().max_by(|p, q| (*p - line[0]).norm().total_cmp(&(*q - line[0]).norm()))?,
    );
    let along = (b - a).try_normalize(1.0)?;
    let left = Vector::new(-along.y, along.x) * strip_width(&[a, b]);
    let taken = |strip: &Ring| -> f64 {
        let common = ring::overlay(
            std::slice::from_ref(strip),
            others,
            OverlayRule::Intersect,
            FillRule::NonZero,
        );
        common.iter().map(ring::Region::area).sum()
    };
    let strips = [left / 2.0, left, Vector::zeros()]
        .map(|top| ring::counter_clockwise(vec![a + top - left, b + top - left, b + top, a + top]));
    strips.into_iter().min_by(|one, other| taken(one).total_cmp(&taken(other)))
}

/// The first of the levels of a tag: `1`, `1;2`, `-1--2`.
fn level(tags: &Tags<'_>) -> f64 {
    let first = |text: &str| {
        text.split(';')
            .next()?
            .trim()
            .parse::<f64>()
            .ok()
            .filter(|l| l.is_finite() && l.abs() < 500.0)
    };
    tags.get("level").and_then(|text| first(text)).unwrap_or(0.0)
}

fn height(tags: &Tags<'_>) -> Option<Cm> {
    let metres: f64 = tags.get("height")?.trim().trim_end_matches('m').trim().parse().ok()?;
    Cm::new(metres * 100.0).ok().filter(|cm| cm.get() > 0.0)
}
