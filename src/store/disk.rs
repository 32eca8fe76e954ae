//! The few things that journal and snapshots ask of a file system, so that tests can put a failing one in its place.
//!
//! **Invariant**: no other file of this folder writes a file, but for sled's own.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::units::InOrder as _;

/// A file that is only appended to.
pub(crate) trait Appender: Send {
    fn append(&mut self, bytes: &[u8]) -> io::Result<()>;
    /// What was appended outlives a power cut once this returns.
    fn sync(&mut self) -> io::Result<()>;
    fn cut(&mut self, length: u64) -> io::Result<()>;
}

/// A file that keeps its length and is written in place, by one writer.
pub(crate) trait Placed: Send + Sync {
    fn write_at(&self, place: u64, bytes: &[u8]) -> io::Result<()>;
    /// What was written outlives a power cut once this returns.
    fn sync(&self) -> io::Result<()>;
}

/// A file that is there, read in pieces.
pub(crate) trait Reading: Send + Sync {
    fn length(&self) -> io::Result<u64>;
    /// So many bytes from a place on; an error where there are fewer.
    fn read_at(&self, place: u64, length: usize) -> io::Result<Vec<u8>>;
}

/// Appends a file's contents.
pub(crate) type Filling<'a> = dyn FnMut(&mut dyn Appender) -> io::Result<()> + 'a;

/// A file system as the store sees it.
pub(crate) trait Disk: Send + Sync {
    fn create_dir(&self, dir: &Path) -> io::Result<()>;
    /// File names within a directory, sorted; none when it does not exist.
    fn list(&self, dir: &Path) -> io::Result<Vec<String>>;
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;
    /// Opens a file to append to, making it when it does not exist.
    fn appender(&self, path: &Path) -> io::Result<Box<dyn Appender>>;
    /// Opens a file that is there, to write in place.
    fn placed(&self, path: &Path) -> io::Result<Box<dyn Placed>>;
    /// Opens a file that is there, to read in pieces.
    fn reading(&self, path: &Path) -> io::Result<Box<dyn Reading>>;
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;
    fn remove(&self, path: &Path) -> io::Result<()>;
    /// The directory's entries outlive a power cut once this returns.
    fn sync_dir(&self, dir: &Path) -> io::Result<()>;

    fn remove_if_there(&self, path: &Path) -> io::Result<()> {
        match self.remove(path) {
            Err(e) if e.kind() != io::ErrorKind::NotFound => Err(e),
            _ => Ok(()),
        }
    }

    /// Puts a file in place whole or not at all, power cut or no.
    fn replace(&self, path: &Path, parts: &[Vec<u8>]) -> io::Result<()> {
        self.replace_by(path, &mut |file| parts.iter().try_for_each(|part| file.append(part)))
    }

    /// The same, of a file that is too large to be held at once.
    fn replace_by(&self, path: &Path, fill: &mut Filling<'_>) -> io::Result<()> {
        let aside = aside_name(path);
        // An attempt that failed before may have left its beginning.
        self.remove_if_there(&aside)?;
        let mut file = self.appender(&aside)?;
        let written = fill(&mut *file).and_then(|()| file.sync());
        drop(file);
        if let Err(error) = written.and_then(|()| self.rename(&aside, path)) {
            // On a full disk the beginning of a file is only in the way.
            let _ = self.remove(&aside);
            return Err(error);
        }
        // A bare file name lies in the working directory.
        let parent = path.parent().filter(|p| !p.as_os_str().is_empty());
        self.sync_dir(parent.unwrap_or_else(|| Path::new(".")))
    }
}

fn aside_name(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".new");
    name.into()
}

/// The file system of this machine.
pub(crate) struct RealDisk;

impl Appender for File {
    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.write_all(bytes)
    }

    fn sync(&mut self) -> io::Result<()> {
        // fdatasync: it also writes the length that an append has changed.
        self.sync_data()
    }

    fn cut(&mut self, length: u64) -> io::Result<()> {
        self.set_len(length)?;
        self.sync_data()
    }
}

impl Placed for File {
    fn write_at(&self, place: u64, bytes: &[u8]) -> io::Result<()> {
        let mut file = self;
        file.seek(SeekFrom::Start(place))?;
        file.write_all(bytes)
    }

    fn sync(&self) -> io::Result<()> {
        self.sync_data()
    }
}

impl Reading for File {
    fn length(&self) -> io::Result<u64> {
        Ok(self.metadata()?.len())
    }

    fn read_at(&self, place: u64, length: usize) -> io::Result<Vec<u8>> {
        let mut bytes = vec![0; length];
        #[cfg(unix)]
        std::os::unix::fs::FileExt::read_exact_at(self, &mut bytes, place)?;
        #[cfg(not(unix))]
        {
            let mut file = self.try_clone()?;
            file.seek(SeekFrom::Start(place))?;
            io::Read::read_exact(&mut file, &mut bytes)?;
        }
        Ok(bytes)
    }
}

impl Disk for RealDisk {
    fn create_dir(&self, dir: &Path) -> io::Result<()> {
        fs::create_dir_all(dir)
    }

    fn list(&self, dir: &Path) -> io::Result<Vec<String>> {
        let entries = match fs::read_dir(dir) {
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            entries => entries?,
        };
        let mut names = entries
            .map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()))
            .collect::<io::Result<Vec<_>>>()?;
        names.order();
        Ok(names)
    }

    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        fs::read(path)
    }

    fn appender(&self, path: &Path) -> io::Result<Box<dyn Appender>> {
        Ok(Box::new(OpenOptions::new().create(true).append(true).open(path)?))
    }

    fn placed(&self, path: &Path) -> io::Result<Box<dyn Placed>> {
        Ok(Box::new(OpenOptions::new().write(true).open(path)?))
    }

    fn reading(&self, path: &Path) -> io::Result<Box<dyn Reading>> {
        Ok(Box::new(File::open(path)?))
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }

    fn sync_dir(&self, dir: &Path) -> io::Result<()> {
        // A directory is a file that can be opened and synced; other systems than Unix do it of themselves.
        if cfg!(unix) { File::open(dir)?.sync_all() } else { Ok(()) }
    }
}
