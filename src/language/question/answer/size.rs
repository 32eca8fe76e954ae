//! How big a thing is, and which parts it consists of.
//!
//! Lengths in cm, areas in cm².
//! Invariant: the number of the answer is the measure that the sentence says.

use super::Draft;
use crate::map::Entity;
use crate::question::knowledge::Knowledge;
use crate::question::query::{Dimension, Noun, Thing};
use crate::question::{Doubt, Fact, Said};
use crate::units::Lengths;
use crate::words::{Case, Number, enumerate};
use crate::words::{area, length};

impl Knowledge<'_> {
    /// «90×30×190 см»
    pub(super) fn sizes(&self, thing: Thing) -> Option<String> {
        let extent = match thing {
            Thing::Entity(Entity::Replica(id)) => self.relations.extent(id)?,
            Thing::Entity(Entity::Area(id)) => self.relations.area_extent(id)?,
            _ => return None,
        };
        let (lengths, language) = (Lengths::said(), self.language);
        let sizes = [extent.width, extent.depth, extent.height];
        let sizes = sizes.map(|cm| lengths.in_language(cm, 0, language)).join("×");
        Some(format!("{sizes} {}", lengths.word(language)))
    }

    /// One measure of a thing in words; none where it has none.
    pub(super) fn size_in_words(&self, dimension: Dimension, thing: Thing) -> Option<String> {
        let extent = match thing {
            Thing::Entity(Entity::Replica(id)) => self.relations.extent(id)?,
            Thing::Entity(Entity::Area(id)) => self.relations.area_extent(id)?,
            _ => return None,
        };
        Some(match dimension {
            Dimension::All | Dimension::Sides => self.sizes(thing)?,
            Dimension::Height => length(extent.height, self.language),
            Dimension::Width => length(extent.width, self.language),
            Dimension::Length => length(extent.depth, self.language),
            Dimension::Area => area(extent.base, self.language),
            Dimension::Elevation => return None,
        })
    }

    pub(super) fn size(&self, dimension: Dimension, of: &Noun) -> Result<Draft, Doubt> {
        const SHOWN: usize = 20;
        let found = self.definite(of)?;
        if let [only] = found[..] {
            return Ok(self.size_of(dimension, only));
        }
        let drafts = found.iter().take(SHOWN).map(|thing| self.size_of(dimension, *thing).text);
        let mut parts: Vec<String> = drafts.collect();
        let more = found.len().saturating_sub(SHOWN);
        if more > 0 {
            parts.push(self.pick("и так далее", "and so on").to_owned());
        }
        Ok(Draft::new(Said::Found, parts.join("; ")).with(found))
    }

    fn size_of(&self, dimension: Dimension, thing: Thing) -> Draft {
        let name = self.name(thing);
        let lang = self.language;
        let extent = match thing {
            Thing::Entity(Entity::Replica(id)) => self.relations.extent(id),
            Thing::Entity(Entity::Area(id)) => self.relations.area_extent(id),
            _ => None,
        };
        let door = match thing {
            Thing::Entity(Entity::Door(id)) => self.world.doors.get(&id),
            _ => None,
        };
        let (text, number) = match (extent, door) {
            (Some(e), _) => match dimension {
                Dimension::All if thing.area().is_some() => {
                    let (area, height) = (area(e.base, lang), length(e.height, lang));
                    let text = match self.is_russian() {
                        true => format!("{name}: площадь {area}, высота {height}"),
                        false => format!("{name} has a floor area of {area} and is {height} high"),
                    };
                    (text, e.base)
                }
                Dimension::All | Dimension::Sides => {
                    let sizes = self.sizes(thing).unwrap_or_default();
                    let text = match self.is_russian() {
                        true => format!(
                            "размеры {}: {sizes} (ширина, глубина, высота)",
                            self.form(thing, Case::Genitive)
                        ),
                        false => format!("{name} measures {sizes} (width, depth, height)"),
                    };
                    (text, e.height)
                }
                Dimension::Height => self.say_measure(thing, dimension, e.height),
                Dimension::Width => self.say_measure(thing, dimension, e.width),
                Dimension::Length => self.say_measure(thing, dimension, e.width.max(e.depth)),
                Dimension::Area => self.say_measure(thing, dimension, e.base),
                Dimension::Elevation => {
                    let (at, is) = (length(e.bottom, lang), self.is(&[thing]));
                    let text = match self.is_russian() {
                        true => format!("{name} {is} на высоте {at}"),
                        false => format!("{name} {is} {at} above the floor"),
                    };
                    (text, e.bottom)
                }
            },
            (None, Some(door)) => {
                let (width, height) = (door.width.get(), door.height.get());
                match dimension {
                    Dimension::Height => self.say_measure(thing, dimension, height),
                    Dimension::Width => self.say_measure(thing, dimension, width),
                    _ => {
                        let (wide, high) = (length(width, lang), length(height, lang));
                        let text = match self.is_russian() {
                            true => format!("{name}: ширина {wide}, высота {high}"),
                            false => format!("{name} is {wide} wide and {high} high"),
                        };
                        (text, width)
                    }
                }
            }
            (None, None) if dimension == Dimension::Height && !self.heights(thing).is_empty() => {
                let heights = self.heights(thing);
                let (low, high) = (heights[0], heights[heights.len() - 1]);
                let said = match high - low < self.relations.thresholds().level_equal {
                    true => length(high, lang),
                    false => match self.is_russian() {
                        true => format!("от {} до {}", length(low, lang), length(high, lang)),
                        false => format!("{} to {}", length(low, lang), length(high, lang)),
                    },
                };
                let text = match self.is_russian() {
                    true => {
                        format!("высота помещений {} – {said}", self.form(thing, Case::Genitive))
                    }
                    false => format!("the rooms of {name} are {said} high"),
                };
                (text, high)
            }
            (None, None) if self.whole_area(thing).is_some() && dimension_is_flat(dimension) => {
                let whole = self.whole_area(thing).unwrap_or_default();
                let said = area(whole, lang);
                let text = match self.is_russian() {
                    true => {
                        format!("площадь помещений {} – {said}", self.form(thing, Case::Genitive))
                    }
                    false => format!("the rooms of {name} have {said} of floor"),
                };
                (text, whole)
            }
            (None, None) => {
                let text = match self.is_russian() {
                    true => {
                        format!("размеры {} на карте не указаны", self.form(thing, Case::Genitive))
                    }
                    false => format!("the map does not give the size of {name}"),
                };
                return Draft::new(Said::Unknown, text).with(vec![thing]);
            }
        };
        Draft::new(Said::Found, text).with(vec![thing]).number(number)
    }

    /// Heights of the rooms of a storey, the lowest first, cm.
    fn heights(&self, thing: Thing) -> Vec<f64> {
        let Thing::Entity(Entity::Map(id)) = thing else { return Vec::new() };
        let items = self.world.maps.get(&id).into_iter().flat_map(|m| &m.items);
        let rooms = items.filter_map(|item| self.relations.area_extent(item.area));
        let mut heights: Vec<f64> = rooms.map(|e| e.height).collect();
        heights.sort_by(f64::total_cmp);
        heights
    }

    /// The floor of all rooms of a storey together, cm².
    fn whole_area(&self, thing: Thing) -> Option<f64> {
        let Thing::Entity(Entity::Map(id)) = thing else { return None };
        let items = &self.world.maps.get(&id)?.items;
        let rooms = items.iter().filter_map(|item| self.relations.area_extent(item.area));
        Some(rooms.map(|e| e.base).sum())
    }

    /// «высота Стола – 75 см», "the table is 75 cm high", with the number.
    fn say_measure(&self, thing: Thing, dimension: Dimension, value: f64) -> (String, f64) {
        let said = match dimension {
            Dimension::Area => area(value, self.language),
            _ => length(value, self.language),
        };
        let text = if self.is_russian() {
            let what = match dimension {
                Dimension::Height => "высота",
                Dimension::Width => "ширина",
                Dimension::Area => "площадь",
                _ => "длина",
            };
            format!("{what} {} – {said}", self.form(thing, Case::Genitive))
        } else {
            let name = self.name(thing);
            match dimension {
                Dimension::Height => format!("{name} is {said} high"),
                Dimension::Width => format!("{name} is {said} wide"),
                Dimension::Area => format!("{name} has an area of {said}"),
                _ => format!("{name} is {said} long"),
            }
        };
        (text, value)
    }

    pub(super) fn parts(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let items = match thing {
            Thing::Entity(Entity::Replica(id)) => {
                let object =
                    self.world.replicas.get(&id).and_then(|r| self.world.objects.get(&r.object));
                object.map(|o| &o.items)
            }
            Thing::Entity(Entity::Area(id)) => self.world.areas.get(&id).map(|a| &a.items),
            _ => None,
        };
        let name = self.name(thing);
        let Some(items) = items.filter(|i| !i.is_empty()) else {
            let text = match self.is_russian() {
                true => format!("части {} на карте не описаны", self.form(thing, Case::Genitive)),
                false => format!("the map does not tell the parts of {name}"),
            };
            return Ok(Draft::new(Said::Unknown, text).with(vec![thing]));
        };
        let mut counted: Vec<(crate::units::OrFrId, usize)> = Vec::new();
        for item in items {
            match counted.iter_mut().find(|(id, _)| *id == item.orthoframe) {
                Some((_, n)) => *n += 1,
                None => counted.push((item.orthoframe, 1)),
            }
        }
        let mut facts = Vec::new();
        let parts: Vec<String> = counted
            .iter()
            .filter_map(|(id, n)| {
                let part = self.world.orthoframes.get(id)?;
                let symbol = self.relations.symbols().symbol(crate::semantics::Subject::Part(*id));
                let whole = match thing {
                    Thing::Entity(Entity::Replica(r)) => {
                        let object = self.world.replicas.get(&r)?.object;
                        self.relations
                            .symbols()
                            .symbol(crate::semantics::Subject::Object(object))
                            .to_string()
                    }
                    other => self.symbol(other),
                };
                facts.push(Fact::holding("PART_OF", vec![symbol.to_string(), whole]));
                let kind = self.world.types.orthoframe.get(part.frame_type);
                let title = match (part.name.is_empty(), kind) {
                    (false, _) => part.name.clone(),
                    (true, Some(kind)) => kind.name.clone(),
                    (true, None) => part.key.clone(),
                };
                let english = match (part.name_en.is_empty(), kind) {
                    (false, _) => part.name_en.clone(),
                    (true, Some(kind)) if !kind.name_en.is_empty() => kind.name_en.clone(),
                    _ => crate::english::name_of(&title).unwrap_or_else(|| title.clone()),
                };
                let phrase = crate::NounPhrase::parse(&title, &crate::WordHints::default());
                Some(match (self.is_russian(), *n) {
                    (true, 1) => {
                        crate::question::lexicon::lower_first(&phrase.case(Case::Genitive))
                    }
                    (true, n) => genitive_count(n, &phrase),
                    (false, 1) => crate::english::with_article(&english.to_lowercase()),
                    (false, n) => crate::english::count(n as u64, &english.to_lowercase()),
                })
            })
            .collect();
        let list = enumerate(&parts, self.language);
        let number = items.len() as f64;
        let text = match self.is_russian() {
            true => format!("{name} состоит из {list}"),
            false => format!("{name} consists of {list}"),
        };
        Ok(Draft { facts, ..Draft::new(Said::Found, text).with(vec![thing]) }.number(number))
    }
}

fn dimension_is_flat(dimension: Dimension) -> bool {
    matches!(dimension, Dimension::All | Dimension::Area)
}

/// «двух полок», as after «состоит из».
fn genitive_count(n: usize, phrase: &crate::NounPhrase) -> String {
    const WORDS: [&str; 11] =
        ["", "", "двух", "трёх", "четырёх", "пяти", "шести", "семи", "восьми", "девяти", "десяти"];
    let plural =
        crate::question::lexicon::lower_first(&phrase.form(Case::Genitive, Number::Plural));
    match WORDS.get(n) {
        Some(word) => format!("{word} {plural}"),
        None => format!("{n} {plural}"),
    }
}
