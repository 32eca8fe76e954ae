//! What a recording tells, read up to its end or to where it was cut off.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value;

use crate::units::{Bilingual, read_file, said};

use super::RecordingError;
use super::container::{MAGIC, Reader, Torn, op};
use super::tape::{ABOUT, MAP};

/// Bytes of a recording, at most.
const LARGEST: u64 = 2 << 30;
/// What is drawn and not told; a reader of missions passes it over.
const DRAWN: [&str; 6] = ["/frames", "/tf", "/scan", "/map/", "/rooms/", "/things/"];

/// One message of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Told {
    /// Nanoseconds since 1970.
    pub time: u64,
    pub topic: String,
    pub value: Value,
}

/// See the head of this file.
#[derive(Debug, Clone, PartialEq)]
pub struct Played {
    /// The map with which it began, as a map file.
    pub map: Option<String>,
    /// What it says of itself.
    pub about: BTreeMap<String, String>,
    /// Poses, ways, words, directives, surprises, tasks, in order.
    pub told: Vec<Told>,
    /// Why it could be read no farther; none where it has its end.
    pub cut: Option<Bilingual>,
}

impl Played {
    /// When something was told last; the beginning of time where nothing was.
    #[must_use]
    pub fn end(&self) -> u64 {
        self.told.last().map_or(0, |last| last.time)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// It cannot be read, is no MCAP, or has nothing of a mission.
    pub fn read(path: &Path) -> Result<Self, RecordingError> {
        let name = || path.display().to_string();
        let bytes = read_file(path, LARGEST).map_err(|fault| RecordingError::Unreadable {
            path: name(),
            reason: Bilingual::from(&fault),
        })?;
        if !bytes.starts_with(MAGIC) {
            return Err(RecordingError::NotMcap { path: name() });
        }
        let played = Self::of(&bytes);
        match played.about.is_empty() && played.map.is_none() {
            true if played.cut.is_some() => Err(RecordingError::Cut { path: name() }),
            true => Err(RecordingError::Foreign { path: name() }),
            false => Ok(played),
        }
    }

    /// Reads bytes that begin as an MCAP does, up to their end or to what is torn.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        let mut played = Self { map: None, about: BTreeMap::new(), told: Vec::new(), cut: None };
        let mut topics = BTreeMap::new();
        let mut reader = Reader(bytes.get(MAGIC.len()..).unwrap_or_default());
        played.cut = match played.read_records(&mut reader, &mut topics, false) {
            Ok(true) if bytes.ends_with(MAGIC) => None,
            Ok(_) | Err(Fault::Torn(Torn::Short)) => Some(said!("cut-off")),
            Err(Fault::Torn(Torn::Broken)) => Some(said!("damaged")),
            Err(Fault::Compressed(how)) => Some(said!("compressed", how)),
        };
        played
    }

    /// Whether the end of the data was reached.
    fn read_records(
        &mut self,
        reader: &mut Reader<'_>,
        topics: &mut BTreeMap<u16, String>,
        is_chunk: bool,
    ) -> Result<bool, Fault> {
        while !reader.0.is_empty() {
            let (kind, mut fields) = reader.record()?;
            // What a whole record lacks is no cut.
            let broken = |_torn| Fault::Torn(Torn::Broken);
            match kind {
                op::ATTACHMENT => self.attachment(fields).map_err(broken)?,
                op::METADATA => self.metadata(fields).map_err(broken)?,
                // What stands in a chunk bears its checksum, and all that is told does.
                op::CHANNEL if is_chunk => {
                    let (id, _schema) =
                        (fields.u16().map_err(broken)?, fields.u16().map_err(broken)?);
                    topics.insert(id, fields.text().map_err(broken)?.to_owned());
                }
                op::MESSAGE if is_chunk => self.message(fields, topics).map_err(broken)?,
                op::CHUNK if !is_chunk => {
                    let (crc, compression, records) = chunk(fields).map_err(broken)?;
                    if !compression.is_empty() {
                        return Err(Fault::Compressed(compression.to_owned()));
                    }
                    if crc != 0 && crc != crc32fast::hash(records) {
                        return Err(Fault::Torn(Torn::Broken));
                    }
                    let mut records = Reader(records);
                    self.read_records(&mut records, topics, true).map_err(|fault| match fault {
                        Fault::Torn(_) => Fault::Torn(Torn::Broken),
                        fault => fault,
                    })?;
                }
                op::DATA_END => return Ok(true),
                _ => {}
            }
        }
        Ok(false)
    }

    fn attachment(&mut self, mut fields: Reader<'_>) -> Result<(), Torn> {
        let whole = fields.0;
        let (_log, _create) = (fields.u64()?, fields.u64()?);
        let (name, _kind) = (fields.text()?, fields.text()?);
        let size = fields.u64()?;
        let data = fields.take(size)?;
        let checked = &whole[..whole.len() - fields.0.len()];
        let crc = fields.u32()?;
        if crc != 0 && crc != crc32fast::hash(checked) {
            return Err(Torn::Broken);
        }
        if name == MAP {
            self.map = Some(std::str::from_utf8(data).map_err(|_error| Torn::Broken)?.to_owned());
        }
        Ok(())
    }

    fn metadata(&mut self, mut fields: Reader<'_>) -> Result<(), Torn> {
        if fields.text()? == ABOUT {
            self.about = fields.texts()?;
        }
        Ok(())
    }

    fn message(
        &mut self,
        mut fields: Reader<'_>,
        topics: &BTreeMap<u16, String>,
    ) -> Result<(), Torn> {
        let (channel, _sequence) = (fields.u16()?, fields.u32()?);
        let (time, _published) = (fields.u64()?, fields.u64()?);
        let topic = topics.get(&channel).ok_or(Torn::Broken)?;
        if !DRAWN.iter().any(|drawn| topic.starts_with(drawn)) {
            let value = serde_json::from_slice(fields.0).map_err(|_error| Torn::Broken)?;
            self.told.push(Told { time, topic: topic.clone(), value });
        }
        Ok(())
    }
}

/// Why a file is read no farther.
enum Fault {
    Torn(Torn),
    Compressed(String),
}

impl From<Torn> for Fault {
    fn from(torn: Torn) -> Self {
        Self::Torn(torn)
    }
}

/// Checksum, compression and records of a chunk.
fn chunk<'b>(mut fields: Reader<'b>) -> Result<(u32, &'b str, &'b [u8]), Torn> {
    let (_first, _last, _size) = (fields.u64()?, fields.u64()?, fields.u64()?);
    let (crc, compression) = (fields.u32()?, fields.text()?);
    let size = fields.u64()?;
    Ok((crc, compression, fields.take(size)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Level, Scribe, Sink, Tape};

    fn recorded() -> Vec<u8> {
        // Both tests record, at the same time.
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("played.mcap");
        let about = BTreeMap::from([("domain".to_owned(), "Дом".to_owned())]);
        let mut tape = Tape::create(&path, "# a map", &about, 1).unwrap();
        let mut scribe = Scribe::new(1);
        for number in 0..20u64 {
            scribe.reach(number * 100_000_000);
            let words = scribe.words(Level::Info, "ortho", &format!("слово {number}"));
            tape.take(&[words], number % 7 == 0).unwrap();
        }
        tape.end().unwrap();
        std::fs::read(&path).unwrap()
    }

    /// A cut loses only what comes after it; damage is told; nothing is made up, and nothing brings the reader down.
    #[test]
    fn a_cut_anywhere_leaves_what_stood_before_it() {
        let bytes = recorded();
        let whole = Played::of(&bytes);
        assert_eq!((whole.cut.clone(), whole.told.len()), (None, 20));
        assert_eq!(whole.map.as_deref(), Some("# a map"));
        let mut before = 0;
        for end in MAGIC.len()..bytes.len() {
            let cut = Played::of(&bytes[..end]);
            assert_eq!(cut.told, whole.told[..cut.told.len()], "cut at {end}");
            assert!(cut.told.len() >= before, "cut at {end}");
            assert!(cut.cut.is_some(), "cut at {end}");
            before = cut.told.len();
        }
    }

    #[test]
    fn a_bit_that_was_turned_over_is_told_of_or_harms_nothing_that_is_told() {
        let bytes = recorded();
        let whole = Played::of(&bytes);
        for at in MAGIC.len()..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << (at % 8);
            let played = Played::of(&damaged);
            // Headers of records bear no checksum: one that is passed over may hide what it led.
            let known = |told: &Told| whole.told.contains(told);
            assert!(played.told.iter().all(known), "bit at {at}");
        }
    }
}
