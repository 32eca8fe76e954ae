//! A recording read while it is written: what was flushed since the last look.

use std::fs::File;
use std::io::{self, Read as _, Seek as _, SeekFrom};
use std::path::Path;

use super::container::{MAGIC, Reader, Torn, op};

/// Something new in a file, as it stands there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Followed {
    /// What messages of these schemas are: JSON Schema.
    Schema {
        id: u16,
        name: String,
        text: String,
    },
    Channel {
        id: u16,
        schema: u16,
        topic: String,
    },
    /// `time` in nanoseconds since 1970, `data` JSON.
    Message {
        channel: u16,
        time: u64,
        data: Vec<u8>,
    },
    /// It has its end.
    End,
}

/// See the head of this file.
#[derive(Debug)]
pub struct Follower {
    file: File,
    /// Bytes that were read and are no whole record yet.
    rest: Vec<u8>,
    is_begun: bool,
    is_over: bool,
}

impl Follower {
    /// Begins at the beginning of a file.
    ///
    /// # Errors
    /// It cannot be opened.
    pub fn open(path: &Path) -> io::Result<Self> {
        Ok(Self { file: File::open(path)?, rest: Vec::new(), is_begun: false, is_over: false })
    }

    /// What has come since the last look; nothing after the end.
    ///
    /// # Errors
    /// The disk refused, or the file is no recording: it is read no farther.
    pub fn look(&mut self) -> io::Result<Vec<Followed>> {
        let mut found = Vec::new();
        if self.is_over {
            return Ok(found);
        }
        // One that became shorter is another file.
        let (at, length) = (self.file.stream_position()?, self.file.metadata()?.len());
        if length < at {
            self.file.seek(SeekFrom::Start(0))?;
            self.is_over = true;
            return Err(io::Error::other("the file was written anew"));
        }
        self.file.read_to_end(&mut self.rest)?;
        if !self.is_begun {
            if self.rest.len() < MAGIC.len() {
                return Ok(found);
            }
            if !self.rest.starts_with(MAGIC) {
                self.is_over = true;
                return Err(io::Error::new(io::ErrorKind::InvalidData, "no MCAP"));
            }
            self.rest.drain(..MAGIC.len());
            self.is_begun = true;
        }
        let mut reader = Reader(&self.rest);
        let mut left = reader.0.len();
        while let Ok((kind, fields)) = reader.record() {
            left = reader.0.len();
            if let Err(_torn) = take(kind, fields, &mut found, true) {
                self.is_over = true;
                return Err(io::Error::new(io::ErrorKind::InvalidData, "the file is damaged"));
            }
            if found.last() == Some(&Followed::End) {
                self.is_over = true;
                break;
            }
        }
        let done = self.rest.len() - left;
        self.rest.drain(..done);
        Ok(found)
    }
}

fn take(
    kind: u8,
    mut fields: Reader<'_>,
    found: &mut Vec<Followed>,
    may_be_chunk: bool,
) -> Result<(), Torn> {
    match kind {
        op::SCHEMA => {
            let (id, name, _encoding) = (fields.u16()?, fields.text()?, fields.text()?);
            let text = std::str::from_utf8(fields.bytes()?).map_err(|_error| Torn::Broken)?;
            let (name, text) = (name.to_owned(), text.to_owned());
            found.push(Followed::Schema { id, name, text });
        }
        op::CHANNEL => {
            let (id, schema, topic) = (fields.u16()?, fields.u16()?, fields.text()?.to_owned());
            found.push(Followed::Channel { id, schema, topic });
        }
        op::MESSAGE => {
            let (channel, _sequence, time) = (fields.u16()?, fields.u32()?, fields.u64()?);
            let _published = fields.u64()?;
            found.push(Followed::Message { channel, time, data: fields.0.to_vec() });
        }
        op::CHUNK if may_be_chunk => {
            let (_first, _last, _size) = (fields.u64()?, fields.u64()?, fields.u64()?);
            let (crc, compression) = (fields.u32()?, fields.text()?);
            let size = fields.u64()?;
            let records = fields.take(size)?;
            let is_right = crc == 0 || crc == crc32fast::hash(records);
            if !compression.is_empty() || !is_right {
                return Err(Torn::Broken);
            }
            let mut records = Reader(records);
            while !records.0.is_empty() {
                let (kind, fields) = records.record()?;
                take(kind, fields, found, false)?;
            }
        }
        op::DATA_END => found.push(Followed::End),
        _ => {}
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Level, Scribe, Sink, Tape};

    #[test]
    fn what_is_written_is_seen_as_it_is_flushed() {
        let name = format!("ortho-follower-{}.mcap", std::process::id());
        let path = std::env::temp_dir().join(name);
        let mut tape = Tape::create(&path, "", &std::collections::BTreeMap::new(), 1).unwrap();
        let mut follower = Follower::open(&path).unwrap();
        assert_eq!(follower.look().unwrap(), []);
        let scribe = Scribe::new(5);
        let words = |text: &str| [scribe.words(Level::Info, "ortho", text)];
        tape.take(&words("a"), true).unwrap();
        let found = follower.look().unwrap();
        assert!(
            matches!(
                found[..],
                [
                    Followed::Schema { .. },
                    Followed::Channel { .. },
                    Followed::Message { time: 5, .. }
                ]
            ),
            "{found:?}"
        );
        tape.take(&words("b"), false).unwrap();
        assert_eq!(follower.look().unwrap(), [], "it was not flushed");
        tape.end().unwrap();
        let found = follower.look().unwrap();
        assert!(matches!(found[..], [Followed::Message { .. }, Followed::End]), "{found:?}");
        std::fs::remove_file(&path).unwrap();
    }
}
