//! Who may write a store: one program at a time, for the length of a call.
//!
//! The system frees the lock of a program that is killed. Who finds it taken waits a moment, but not where its holder says
//! in the file that it has the robot drive.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Seek as _, SeekFrom, Write as _};
use std::path::Path;
use std::time::{Duration, Instant};

use super::error::{Result, StoreError, doing};

/// The store is this program's alone as long as this lives.
pub(crate) struct Lock(File);

/// What the file says while its holder drives the robot: that takes longer than anybody waits.
const DRIVES: &[u8] = b"drives";
/// How long a call waits for that of another program.
pub(crate) const PATIENCE: Duration = Duration::from_secs(2);
/// Between two looks whether it has ended.
const GLANCE: Duration = Duration::from_millis(5);

impl Lock {
    /// Says whether the robot is driven meanwhile. Whoever is not told waits in vain, and no more.
    pub(crate) fn says_drives(&mut self, drives: bool) {
        let said = self.0.set_len(0).and_then(|()| self.0.seek(SeekFrom::Start(0)));
        let said = said.and_then(|_| if drives { self.0.write_all(DRIVES) } else { Ok(()) });
        if let Err(error) = said {
            tracing::debug!(%error, "the lock does not say what for");
        }
    }
}

/// Whether whoever holds the store drives the robot.
pub(crate) fn is_driven(dir: &Path) -> bool {
    std::fs::read(dir.join("lock")).is_ok_and(|said| said == DRIVES)
}

impl Drop for Lock {
    fn drop(&mut self) {
        self.says_drives(false);
        // Closing is not enough: a child that another thread is about to start shares the file until it runs. What
        // cannot be unlocked is unlocked by the end of both.
        let _ = self.0.unlock();
    }
}

/// Takes the store for this program alone; waits so long for the call of another program, and not for its drive.
pub(crate) fn lock(dir: &Path, patience: Duration) -> Result<Lock> {
    let path = dir.join("lock");
    let file = OpenOptions::new()
        .create(true)
        .truncate(false)
        .write(true)
        .open(&path)
        .map_err(StoreError::io(doing::OPEN, &path))?;
    let until = Instant::now() + patience;
    loop {
        match file.try_lock() {
            Ok(()) => break,
            Err(TryLockError::WouldBlock) => {
                let drives = is_driven(dir);
                if drives || Instant::now() >= until {
                    return Err(StoreError::Locked { dir: dir.display().to_string(), drives });
                }
                std::thread::sleep(GLANCE);
            }
            Err(TryLockError::Error(error)) => {
                return Err(StoreError::io(doing::LOCK, &path)(error));
            }
        }
    }
    let mut lock = Lock(file);
    // Whoever was killed on the way said so to the end.
    if is_driven(dir) {
        lock.says_drives(false);
    }
    Ok(lock)
}
