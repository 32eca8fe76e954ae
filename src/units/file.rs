//! Files that a person names: read within limits, written whole or not at all.
//!
//! What a name stands for may be a pipe into which nobody writes, a device without end, or a file that grows while it
//! is read. Every reader goes through here, so that each of them ends, with bounded memory.

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::time::Duration;

/// Why a file was not read.
#[derive(Debug)]
#[non_exhaustive]
pub enum FileFault {
    Io(io::Error),
    /// It is longer than its reader takes; `bytes` is as much as is known of its length.
    TooLarge {
        bytes: u64,
        limit: u64,
    },
    /// A pipe or a device that gives nothing.
    Silent,
    /// This byte belongs to no text in UTF-8.
    NotText {
        at: usize,
    },
}

impl From<io::Error> for FileFault {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl FileFault {
    /// As an error of the file system, for those whose own faults hold one.
    #[must_use]
    pub fn into_io(self) -> io::Error {
        let kind = match &self {
            Self::Io(_) | Self::TooLarge { .. } => ErrorKind::InvalidInput,
            Self::Silent => ErrorKind::TimedOut,
            Self::NotText { .. } => ErrorKind::InvalidData,
        };
        match self {
            Self::Io(error) => error,
            other => io::Error::new(kind, other.to_string()),
        }
    }
}

/// How long a pipe may give nothing.
pub(super) const PATIENCE: Duration = Duration::from_secs(5);
const PIECE: usize = 1 << 16;

/// The bytes of a file, at most `limit`.
///
/// # Errors
/// [`FileFault`], never [`FileFault::NotText`].
pub fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, FileFault> {
    let about = fs::metadata(path)?;
    if about.is_dir() {
        return Err(FileFault::Io(ErrorKind::IsADirectory.into()));
    }
    if about.len() > limit {
        return Err(FileFault::TooLarge { bytes: about.len(), limit });
    }
    if about.is_file() {
        let mut bytes = Vec::new();
        // It may grow meanwhile; one byte past the limit is enough to know.
        File::open(path)?.take(limit.saturating_add(1)).read_to_end(&mut bytes)?;
        return within(bytes, limit);
    }
    read_patiently(path, limit)
}

fn within(bytes: Vec<u8>, limit: u64) -> Result<Vec<u8>, FileFault> {
    match bytes.len() as u64 {
        length if length > limit => Err(FileFault::TooLarge { bytes: length, limit }),
        _ => Ok(bytes),
    }
}

/// A pipe or a device: opening it may wait for ever, and so may reading. A thread does both and is left behind when
/// nothing comes.
fn read_patiently(path: &Path, limit: u64) -> Result<Vec<u8>, FileFault> {
    let (pieces, heard) = sync_channel::<io::Result<Vec<u8>>>(4);
    let path = path.to_owned();
    let read = move || {
        let mut file = match File::open(path) {
            Ok(file) => file,
            Err(error) => {
                let _ = pieces.send(Err(error));
                return;
            }
        };
        loop {
            let mut piece = vec![0; PIECE];
            let read = file.read(&mut piece).map(|length| {
                piece.truncate(length);
                piece
            });
            let is_last = !matches!(&read, Ok(piece) if !piece.is_empty());
            if matches!(&read, Err(e) if e.kind() == ErrorKind::Interrupted) {
                continue;
            }
            // Whoever asked has enough when it no longer listens.
            if pieces.send(read).is_err() || is_last {
                return;
            }
        }
    };
    std::thread::Builder::new().spawn(read)?;
    let mut bytes = Vec::new();
    loop {
        match heard.recv_timeout(PATIENCE) {
            Ok(piece) => match piece? {
                end if end.is_empty() => return Ok(bytes),
                piece => bytes.extend(piece),
            },
            Err(RecvTimeoutError::Disconnected) => return Ok(bytes),
            Err(RecvTimeoutError::Timeout) => return Err(FileFault::Silent),
        }
        bytes = within(bytes, limit)?;
    }
}

/// The text of a file in UTF-8, at most `limit` bytes.
///
/// # Errors
/// [`FileFault`].
pub fn read_text(path: &Path, limit: u64) -> Result<String, FileFault> {
    String::from_utf8(read_file(path, limit)?)
        .map_err(|error| FileFault::NotText { at: error.utf8_error().valid_up_to() })
}

/// Puts a file in place whole, or leaves what was there: on a full disk the beginning of a file is only in the way.
/// What is no regular file, a pipe or a terminal, is written to as it is.
///
/// # Errors
/// Whatever the file system says.
pub fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_file_with(path, |out| out.write_all(bytes))
}

/// As [`write_file`], for what is written piece by piece.
///
/// # Errors
/// Whatever the file system or `write` says.
pub fn write_file_with(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    // Through a link: what it points to is replaced, not the link.
    let path = &path.canonicalize().unwrap_or_else(|_| path.to_owned());
    if fs::metadata(path).is_ok_and(|about| !about.is_file()) {
        let mut out = BufWriter::new(fs::OpenOptions::new().write(true).open(path)?);
        write(&mut out)?;
        return out.flush();
    }
    let aside = aside_of(path);
    let all = || {
        let mut out = BufWriter::new(File::create(&aside)?);
        write(&mut out)?;
        // Closing tells nobody of what could not be written.
        out.flush()
    };
    let written = all().and_then(|()| {
        if let Ok(about) = fs::metadata(path) {
            fs::set_permissions(&aside, about.permissions())?;
        }
        fs::rename(&aside, path)
    });
    written.inspect_err(|_| {
        let _ = fs::remove_file(&aside);
    })
}

fn aside_of(path: &Path) -> PathBuf {
    static NUMBER: AtomicU64 = AtomicU64::new(0);
    let number = NUMBER.fetch_add(1, Ordering::Relaxed);
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}-{number}.new", std::process::id()));
    path.with_file_name(name)
}

/// Whether the file system's refusal is about what was named: it is not there, is of another kind, is not permitted.
/// Else the machine is at fault: no room, a device that fails.
#[must_use]
pub fn is_input(kind: ErrorKind) -> bool {
    matches!(
        kind,
        ErrorKind::NotFound
            | ErrorKind::PermissionDenied
            | ErrorKind::AlreadyExists
            | ErrorKind::NotADirectory
            | ErrorKind::IsADirectory
            | ErrorKind::DirectoryNotEmpty
            | ErrorKind::InvalidInput
            | ErrorKind::InvalidData
            | ErrorKind::InvalidFilename
            | ErrorKind::TimedOut
            | ErrorKind::UnexpectedEof
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_its_limit() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("файл");
        write_file(&path, b"12345").unwrap();
        assert_eq!(read_file(&path, 5).unwrap(), b"12345");
        assert!(matches!(read_file(&path, 4), Err(FileFault::TooLarge { bytes: 5, limit: 4 })));
        assert!(matches!(read_file(dir.path(), 4), Err(FileFault::Io(_))));
        write_file(&path, b"ab\xFFc").unwrap();
        assert!(matches!(read_text(&path, 9), Err(FileFault::NotText { at: 2 })));
        // Nothing is left beside it.
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
        assert!(write_file(&dir.path().join("нет").join("файл"), b"1").is_err());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_device_without_end_ends() {
        let zeroes = Path::new("/dev/zero");
        assert!(matches!(read_file(zeroes, 1 << 20), Err(FileFault::TooLarge { .. })));
        assert_eq!(read_file(Path::new("/dev/null"), 9).unwrap(), b"");
        assert!(write_file(Path::new("/dev/null"), b"1").is_ok());
        assert!(write_file(Path::new("/dev/full"), b"1").is_err());
    }
}
