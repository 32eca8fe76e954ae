//! Messages in a file, which is whole up to the last chunk that was flushed, whenever the program ends.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use super::container::{Fields, MAGIC, op};
use super::{Message, RecordingError, Schema, Sink};

/// Of messages in one chunk, at most; one that was not flushed is lost when the program is killed.
const CHUNK_NS: u64 = 250_000_000;

/// The map with which a mission began, as a map file, among the attachments.
pub(super) const MAP: &str = "map.toml";
/// What the recording is of, among the metadata.
pub(super) const ABOUT: &str = "ortho";

/// A recording that is being written.
#[derive(Debug)]
pub struct Tape {
    path: PathBuf,
    file: File,
    /// Bytes that were written.
    at: u64,
    /// Schemas and channels, as the summary repeats them.
    schemas: BTreeMap<Schema, (u16, Vec<u8>)>,
    channels: BTreeMap<String, Channel>,
    chunk: Chunk,
    /// What the summary says of all that was written.
    indexes: Vec<u8>,
    chunks: u32,
    first: Option<u64>,
    last: u64,
    /// It has its end.
    is_over: bool,
}

#[derive(Debug)]
struct Channel {
    id: u16,
    record: Vec<u8>,
    count: u64,
}

/// Messages that are to be written together.
#[derive(Debug, Default)]
struct Chunk {
    records: Vec<u8>,
    times: Option<(u64, u64)>,
    /// By channel the time of each message, and where in the chunk it begins.
    index: BTreeMap<u16, Vec<(u64, u64)>>,
}

impl Tape {
    /// Begins a file, in place of what is there. `map` is the text of a map file, `about` says what is recorded.
    ///
    /// # Errors
    /// The disk refused.
    pub fn create(
        path: &Path,
        map: &str,
        about: &BTreeMap<String, String>,
        time: u64,
    ) -> Result<Self, RecordingError> {
        let refused = |error| unwritable(path, &error);
        let file = File::create(path).map_err(refused)?;
        let mut tape = Self {
            path: path.to_owned(),
            file,
            at: 0,
            schemas: BTreeMap::new(),
            channels: BTreeMap::new(),
            chunk: Chunk::default(),
            indexes: Vec::new(),
            chunks: 0,
            first: None,
            last: 0,
            is_over: false,
        };
        tape.begin(map, about, time).map_err(refused)?;
        Ok(tape)
    }

    fn begin(&mut self, map: &str, about: &BTreeMap<String, String>, time: u64) -> io::Result<()> {
        let mut head = MAGIC.to_vec();
        let library = concat!("orthoframe ", env!("CARGO_PKG_VERSION"));
        head.extend(Fields::default().text("").text(library).record(op::HEADER));
        self.write(&head)?;
        let metadata = Fields::default().text(ABOUT).texts(about).record(op::METADATA);
        let (at, length) = (self.at, metadata.len() as u64);
        self.write(&metadata)?;
        let index = Fields::default().u64(at).u64(length).text(ABOUT);
        self.indexes.extend(index.record(op::METADATA_INDEX));
        let kind = "application/toml";
        let size = map.len() as u64;
        let fields = Fields::default().u64(time).u64(time).text(MAP).text(kind).u64(size);
        let fields = fields.rest(map.as_bytes());
        let crc = crc32fast::hash(&fields.0);
        let attachment = fields.u32(crc).record(op::ATTACHMENT);
        let (at, length) = (self.at, attachment.len() as u64);
        self.write(&attachment)?;
        let index = Fields::default().u64(at).u64(length).u64(time).u64(time).u64(size);
        self.indexes.extend(index.text(MAP).text(kind).record(op::ATTACHMENT_INDEX));
        Ok(())
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.write_all(bytes)?;
        self.at += bytes.len() as u64;
        Ok(())
    }

    fn put(&mut self, message: &Message) {
        let channel = match self.channels.get_mut(&message.topic) {
            Some(channel) => channel,
            None => {
                let channel = self.channel(message);
                self.channels.entry(message.topic.clone()).or_insert(channel)
            }
        };
        let time = message.time;
        let sequence = u32::try_from(channel.count).unwrap_or(u32::MAX);
        channel.count += 1;
        let id = channel.id;
        let fields = Fields::default().u16(id).u32(sequence).u64(time).u64(time);
        let at = self.chunk.records.len() as u64;
        self.chunk.records.extend(fields.rest(&message.data).record(op::MESSAGE));
        self.chunk.index.entry(id).or_default().push((time, at));
        let (first, last) = self.chunk.times.unwrap_or((time, time));
        self.chunk.times = Some((first.min(time), last.max(time)));
        self.first = Some(self.first.map_or(time, |first| first.min(time)));
        self.last = self.last.max(time);
    }

    /// A new channel, which stands in the chunk before its first message, and so does its schema.
    fn channel(&mut self, message: &Message) -> Channel {
        let next = self.schemas.len() as u16 + 1;
        let (schema, record) = self.schemas.entry(message.schema).or_insert_with(|| {
            let (name, text) = (message.schema.name(), message.schema.text());
            let fields = Fields::default().u16(next).text(name).text("jsonschema");
            (next, fields.bytes(text.trim_end().as_bytes()).record(op::SCHEMA))
        });
        if *schema == next {
            self.chunk.records.extend(&*record);
        }
        // Topics are a handful and some for each storey.
        let id = self.channels.len() as u16;
        let fields = Fields::default().u16(id).u16(*schema).text(&message.topic).text("json");
        let record = fields.texts(&BTreeMap::new()).record(op::CHANNEL);
        self.chunk.records.extend(&record);
        Channel { id, record, count: 0 }
    }

    /// Writes the chunk in hand.
    fn flush(&mut self) -> io::Result<()> {
        let Chunk { records, times, index } = std::mem::take(&mut self.chunk);
        let Some((first, last)) = times else { return Ok(()) };
        let size = records.len() as u64;
        let head = Fields::default().u64(first).u64(last).u64(size).u32(crc32fast::hash(&records));
        let mut bytes = head.text("").u64(size).rest(&records).record(op::CHUNK);
        let (at, length) = (self.at, bytes.len() as u64);
        let mut places = Fields::default();
        for (channel, entries) in &index {
            places = places.u16(*channel).u64(at + bytes.len() as u64);
            let put = |fields: Fields, (time, at): &(u64, u64)| fields.u64(*time).u64(*at);
            let entries = entries.iter().fold(Fields::default(), put);
            bytes.extend(
                Fields::default().u16(*channel).bytes(&entries.0).record(op::MESSAGE_INDEX),
            );
        }
        let indexes = bytes.len() as u64 - length;
        self.write(&bytes)?;
        let fields = Fields::default().u64(first).u64(last).u64(at).u64(length).bytes(&places.0);
        let fields = fields.u64(indexes).text("").u64(size).u64(size);
        self.indexes.extend(fields.record(op::CHUNK_INDEX));
        self.chunks += 1;
        Ok(())
    }

    fn finish(&mut self) -> io::Result<()> {
        self.flush()?;
        let end = Fields::default().u32(0).record(op::DATA_END);
        self.write(&end)?;
        let summary_at = self.at;
        let mut summary: Vec<u8> = Vec::new();
        self.schemas.values().for_each(|(_, record)| summary.extend(record));
        self.channels.values().for_each(|channel| summary.extend(&channel.record));
        let counts = self.channels.values();
        let put = |fields: Fields, channel: &Channel| fields.u16(channel.id).u64(channel.count);
        let total = self.channels.values().map(|channel| channel.count).sum();
        let fields = Fields::default().u64(total).u16(self.schemas.len() as u16);
        let fields = fields.u32(self.channels.len() as u32).u32(1).u32(1).u32(self.chunks);
        let fields = fields.u64(self.first.unwrap_or(0)).u64(self.last);
        let fields = fields.bytes(&counts.fold(Fields::default(), put).0);
        summary.extend(fields.record(op::STATISTICS));
        summary.extend(&self.indexes);
        // The checksum is of the summary and of the footer up to it.
        let mut footer = Fields::default().u64(summary_at).u64(0).u32(0).record(op::FOOTER);
        footer.truncate(footer.len() - 4);
        summary.extend(&footer);
        let crc = crc32fast::hash(&summary);
        summary.extend(crc.to_le_bytes());
        summary.extend(MAGIC);
        self.write(&summary)?;
        self.file.flush()
    }
}

impl Sink for Tape {
    fn take(&mut self, messages: &[Message], urgent: bool) -> Result<(), RecordingError> {
        messages.iter().for_each(|message| self.put(message));
        let is_due = self.chunk.times.is_some_and(|(first, last)| last >= first + CHUNK_NS);
        match urgent || is_due {
            true => self.flush().map_err(|error| unwritable(&self.path, &error)),
            false => Ok(()),
        }
    }

    fn end(&mut self) -> Result<(), RecordingError> {
        self.is_over = true;
        self.finish().map_err(|error| unwritable(&self.path, &error))
    }
}

/// A drive that ends in a fault leaves a file with an end too.
impl Drop for Tape {
    fn drop(&mut self) {
        if !self.is_over {
            // Nobody is there any more to be told why not.
            let _ = self.finish();
        }
    }
}

fn unwritable(path: &Path, error: &io::Error) -> RecordingError {
    RecordingError::Unwritable { path: path.display().to_string(), reason: error.to_string() }
}
