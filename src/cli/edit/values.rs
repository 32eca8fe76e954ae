//! A step told in arguments, as the edit that it is.

use crate::map::schema::{
    AreaFile, At, Coordinates, DoorFile, ItemFile, ItemLinkFile, LeafFile, Number, ObjectFile,
    OpensFile, OrthoframeFile, Pairs, PlanFile, PlanItemFile, PlanLinkFile, RegularFile,
    SideTraitsFile, StatusFile, Table, pair,
};
use crate::map::{Edit, MapError, NewRecord};
use crate::units::said;

use super::step::{Group, Names, Numbers, Step};

type Told<T> = Result<T, Box<MapError>>;

fn number(value: Option<f64>) -> Told<Option<Number>> {
    value.map(Number::try_from).transpose()
}

fn numbers(Numbers(list): &Numbers) -> Told<Vec<Number>> {
    list.iter().map(|n| Number::try_from(*n)).collect()
}

fn coordinates(told: Option<&Numbers>) -> Told<Option<Coordinates>> {
    told.map(|told| Coordinates::try_from(&numbers(told)?[..])).transpose()
}

/// Two numbers.
fn two(told: Option<&Numbers>) -> Told<Option<[Number; 2]>> {
    told.map(|told| pair(&numbers(told)?)).transpose()
}

/// `X,Y X,Y …` as a list of points.
fn corners(points: &str) -> Told<Vec<[Number; 2]>> {
    let corner = |text: &str| {
        let list: Vec<Number> = text.split(',').map(str::parse).collect::<Result<_, _>>()?;
        pair(&list)
    };
    points.split_whitespace().map(corner).collect()
}

/// `KEY[@X,Y[,Z[,DEG]]]`: what stands where.
fn placed(text: &str) -> Told<(String, At, Option<Number>)> {
    let Some((key, at)) = text.split_once('@') else {
        return Ok((text.trim().to_owned(), At::default(), None));
    };
    let mut list: Vec<Number> = at.split(',').map(str::parse).collect::<Result<_, _>>()?;
    let angle = if list.len() == 4 { list.pop() } else { None };
    Ok((key.trim().to_owned(), Coordinates::try_from(&list[..])?.into(), angle))
}

fn pairs(told: &[String]) -> Pairs {
    let split = |pair: &String| {
        let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
        (name.to_owned(), value.to_owned())
    };
    told.iter().map(split).collect()
}

fn ends(link: &str) -> (String, String) {
    let (from, to) = link.split_once('=').unwrap_or((link, ""));
    (from.trim().to_owned(), to.trim().to_owned())
}

fn items(group: &Group) -> Told<Vec<ItemFile>> {
    let item = |item: &String| {
        let (id, rest) = item.split_once('=').unwrap_or((item, ""));
        let (orthoframe, at, angle) = placed(rest)?;
        Ok(ItemFile { id: id.trim().to_owned(), orthoframe, at, angle, base: false })
    };
    group.items.iter().map(item).collect()
}

fn item_links(group: &Group) -> Vec<ItemLinkFile> {
    let link = |link: &String| {
        let (from, to) = ends(link);
        ItemLinkFile { from, to, rel: At::default(), angle: None }
    };
    group.links.iter().map(link).collect()
}

impl Names {
    fn name(&self) -> String {
        self.name.clone().unwrap_or_default()
    }

    fn name_en(&self) -> String {
        self.name_en.clone().unwrap_or_default()
    }
}

/// `N,R`: corners and radius.
fn regular(told: &Numbers) -> Told<RegularFile> {
    let [corners, radius] = pair(&numbers(told)?)?;
    let (what, value) = ("corners".into(), corners.get());
    if value.fract() != 0.0 || value < 0.0 {
        let range = said!("whole-from-3-to-360");
        return Err(Box::new(MapError::OutOfRange { what, value, range }));
    }
    Ok(RegularFile { corners: value as u32, radius })
}

/// `ID=WORD[,TYPE]`: what a side is beyond its place.
fn side(told: &str) -> Told<(String, SideTraitsFile)> {
    let (id, traits) = told.split_once('=').unwrap_or((told, ""));
    let (permeability, kind) = traits.split_once(',').unwrap_or((traits, ""));
    let traits = SideTraitsFile {
        permeability: permeability.trim().parse()?,
        r#type: (!kind.is_empty()).then(|| kind.trim().to_owned()),
        ..SideTraitsFile::default()
    };
    Ok((id.trim().to_owned(), traits))
}

/// `HINGE[=SHARE]`.
fn leaf(told: &str) -> Told<LeafFile> {
    let (hinge, share) = told.split_once('=').map_or((told, None), |(h, s)| (h, Some(s)));
    let share = share.map(str::parse).transpose()?;
    Ok(LeafFile { hinge: hinge.parse()?, share, thickness: None, max_open: None })
}

/// `AREA@X,Y[,Z[,DEG]]`.
fn plan_item(told: &str) -> Told<PlanItemFile> {
    let (area, at, angle) = placed(told)?;
    Ok(PlanItemFile { area, at, angle, base: false })
}

fn word<T: std::str::FromStr<Err = Box<MapError>>>(told: Option<&String>) -> Told<Option<T>> {
    told.map(|word| word.parse()).transpose()
}

impl Step {
    /// The record that the step makes, if it makes one.
    fn record(&self) -> Told<Option<NewRecord>> {
        Ok(Some(match self {
            Self::Orthoframe {
                key,
                rect,
                points,
                regular: polygon,
                height,
                base,
                roof,
                side: sides,
                names,
            } => {
                let file = OrthoframeFile {
                    name: names.name(),
                    name_en: names.name_en(),
                    r#type: names.kind_of.clone(),
                    properties: pairs(&names.properties),
                    rect: two(rect.as_ref())?,
                    points: points.as_deref().map_or(Ok(Vec::new()), corners)?,
                    regular: polygon.as_ref().map(regular).transpose()?,
                    height: number(Some(*height))?,
                    base: word(base.as_ref())?.unwrap_or_default(),
                    roof: word(roof.as_ref())?.unwrap_or_default(),
                    side: Table(sides.iter().map(|told| side(told)).collect::<Told<_>>()?),
                    ..OrthoframeFile::default()
                };
                NewRecord::Orthoframe(key.clone(), file)
            }
            Self::Door { key, kind, width, height, leaf: leaves, state, names } => {
                let file = DoorFile {
                    kind: kind.parse()?,
                    width: (*width).try_into()?,
                    height: (*height).try_into()?,
                    id: None,
                    name: names.name(),
                    name_en: names.name_en(),
                    r#type: names.kind_of.clone(),
                    leaves: leaves.iter().map(|told| leaf(told)).collect::<Told<_>>()?,
                    state: word(state.as_ref())?.unwrap_or_default(),
                    opening: None,
                    properties: pairs(&names.properties),
                    forms: Default::default(),
                };
                NewRecord::Door(key.clone(), file)
            }
            Self::Object { key, group, front, back, names } => {
                let file = ObjectFile {
                    items: items(group)?,
                    links: item_links(group),
                    name: names.name(),
                    name_en: names.name_en(),
                    r#type: names.kind_of.clone(),
                    properties: pairs(&names.properties),
                    front: front.clone(),
                    back: back.clone(),
                    ..ObjectFile::default()
                };
                NewRecord::Object(key.clone(), file)
            }
            Self::Area { key, group, names } => {
                let file = AreaFile {
                    items: items(group)?,
                    links: item_links(group),
                    name: names.name(),
                    name_en: names.name_en(),
                    r#type: names.kind_of.clone(),
                    properties: pairs(&names.properties),
                    ..AreaFile::default()
                };
                NewRecord::Area(key.clone(), file)
            }
            Self::Map { names, .. } if !names.properties.is_empty() => {
                return Err(Box::new(MapError::UnknownField {
                    field: "properties".to_owned(),
                    nearest: None,
                    expected: "name, name_en, type".to_owned(),
                }));
            }
            Self::Map { key, areas, links, names } => {
                let link = |told: &String| {
                    let (from, to) = ends(told);
                    PlanLinkFile { from, to, rel: At::default(), angle: None }
                };
                let file = PlanFile {
                    items: areas.iter().map(|told| plan_item(told)).collect::<Told<_>>()?,
                    links: links.iter().map(link).collect(),
                    name: names.name.clone().unwrap_or_default(),
                    name_en: names.name_en.clone().unwrap_or_default(),
                    r#type: names.kind_of.clone(),
                    ..PlanFile::default()
                };
                NewRecord::Map(key.clone(), file)
            }
            _ => return Ok(None),
        }))
    }

    /// The step as an edit.
    pub(super) fn edit(&self) -> Told<Edit> {
        if let Some(record) = self.record()? {
            return Ok(Edit::New(Box::new(record)));
        }
        Ok(match self {
            Self::Place { name, object, area, at, pose, move_prob, name_en } => Edit::Place {
                name: name.clone(),
                object: object.clone(),
                area: area.clone(),
                at: coordinates(at.at.as_ref())?,
                pose: coordinates(pose.as_ref())?,
                angle: number(at.angle)?,
                name_en: name_en.clone(),
                move_prob: *move_prob,
                properties: Pairs::new(),
                doors: Table::default(),
                forms: Default::default(),
            },
            Self::Point { name, area, at, pose, heading, serves } => Edit::Point {
                name: name.clone(),
                area: area.clone(),
                at: two(at.as_ref())?,
                pose: two(pose.as_ref())?,
                heading: number(*heading)?,
                serves: serves.clone(),
                name_en: None,
                forms: Default::default(),
            },
            Self::Move { name, to, by, area, carry } => Edit::Move {
                name: name.clone(),
                to: coordinates(to.as_ref())?,
                by: coordinates(by.as_ref())?,
                area: area.clone(),
                carry: *carry,
            },
            Self::Turn { name, to, by, carry } => {
                let (to, by) = (number(*to)?, number(*by)?);
                Edit::Turn { name: name.clone(), to, by, carry: *carry }
            }
            Self::Remove { name, kind } => {
                Edit::Remove { name: name.clone(), kind: kind.kind.clone() }
            }
            Self::Rename { name, to, en, kind } => Edit::Rename {
                name: name.clone(),
                to: to.clone(),
                en: en.clone(),
                forms: None,
                kind: kind.kind.clone(),
            },
            Self::Set { name, property, value, side, kind } => Edit::Set {
                name: name.clone(),
                property: Some(property.clone()),
                value: Some(value.clone()),
                side: side.clone(),
                move_prob: None,
                kind: kind.kind.clone(),
            },
            Self::Unset { name, property, side, kind } => Edit::Unset {
                name: name.clone(),
                property: property.clone(),
                side: side.clone(),
                kind: kind.kind.clone(),
            },
            Self::MoveProb { name, percent } => Edit::Set {
                name: name.clone(),
                property: None,
                value: None,
                side: None,
                move_prob: Some(*percent),
                kind: None,
            },
            Self::State { door, state, opening, on } => Edit::State {
                name: door.clone(),
                is: state.parse::<StatusFile>()?.into(),
                opening: number(*opening)?,
                on: on.clone(),
            },
            Self::Bind { door, to, side, opens } => Edit::Bind {
                name: door.clone(),
                to: to.clone(),
                side: side.clone(),
                opens: word::<OpensFile>(opens.as_ref())?.map(Into::into),
            },
            Self::Unbind { door, from } => Edit::Unbind { name: door.clone(), from: from.clone() },
            Self::Item { id, of, orthoframe, at } => Edit::Item {
                name: id.clone(),
                of: of.clone(),
                orthoframe: orthoframe.clone(),
                at: coordinates(at.at.as_ref())?,
                angle: number(at.angle)?,
                base: None,
            },
            Self::Link { from, to, of, rel, angle } => Edit::Link {
                name: from.clone(),
                to: to.clone(),
                of: of.clone(),
                rel: coordinates(rel.as_ref())?,
                angle: number(*angle)?,
            },
            Self::Unlink { from, to, of } => {
                Edit::Unlink { name: from.clone(), to: to.clone(), of: of.clone() }
            }
            Self::Stand { area, map, at } => Edit::Stand {
                name: area.clone(),
                map: map.clone(),
                at: coordinates(at.at.as_ref())?,
                angle: number(at.angle)?,
                base: None,
                relink: false,
            },
            Self::Include { map, at } => {
                let (at, angle) = (coordinates(at.at.as_ref())?, number(at.angle)?);
                Edit::Include { name: map.clone(), at, angle, base: None }
            }
            Self::Lift { name, stops } => Edit::Lift {
                name: name.clone(),
                stops: stops.iter().map(|stop| stop.trim().to_owned()).collect(),
            },
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
            } => Edit::Zone {
                name: name.clone(),
                kind: word(kind.as_ref())?,
                rooms: (!rooms.is_empty())
                    .then(|| rooms.iter().map(|room| room.trim().to_owned()).collect()),
                map: map.clone(),
                points: points.as_deref().map(corners).transpose()?,
                speed: number(*speed)?,
                heading: number(*heading)?,
                reason: reason.clone(),
                reason_en: reason_en.clone(),
                from: from.clone(),
                until: until.clone(),
                name_en: name_en.clone(),
                forms: None,
            },
            Self::Orthoframe { .. }
            | Self::Door { .. }
            | Self::Object { .. }
            | Self::Area { .. }
            | Self::Map { .. } => unreachable!("these make a record"),
        })
    }
}
