//! What is young becomes past: runs written, taken in by a transaction, made one, mended and removed.
//!
//! **Invariant**: the files of a run are whole before a transaction names it, and are there as long as a snapshot may.

use super::super::error::{Result, StoreError, doing};
use super::super::frame::Op;
use super::super::journal::numbered_files;
use super::super::past::{describe, is_past, past_dir, write_merged, write_young};
use super::super::run::{self, Run};
use super::super::trees::{RUNS, Records, Trees, tree_names};
use super::{Change, OpenReport, Vault};
use crate::units::Bilingual;

/// Less than this is not worth a run of its own. Tests see to it that there are runs.
const LEAST_RUN: usize = if cfg!(test) { 1 } else { 1 << 20 };

impl Vault {
    /// Writes what has become past as a run and takes it from the trees; makes runs of like size one, or `all` of them.
    ///
    /// The files come first: a run that no transaction names is nothing.
    pub(crate) fn put_past(&mut self, all: bool) -> Result<()> {
        let mut young = Vec::new();
        for (tree, _) in tree_names().filter(|(tree, _)| is_past(*tree)) {
            self.memory.scan(tree, &[], &mut |key, value| {
                young.push((tree, key.to_vec(), value.to_vec()));
                Ok(true)
            })?;
        }
        young.sort();
        let size: usize = young.iter().map(|(_, key, value)| key.len() + value.len()).sum();
        if size >= LEAST_RUN || (all && size > 0) {
            let place = self.state.lsn + 1;
            let full: Vec<_> = young
                .iter()
                .map(|(tree, key, value)| {
                    let mut full = vec![*tree];
                    full.extend(key);
                    (full, value.clone())
                })
                .collect();
            self.disk
                .create_dir(&past_dir(&self.dir))
                .map_err(StoreError::io(doing::MAKE_DIR, &self.dir))?;
            let run = write_young(&*self.disk, &self.dir, place, &full)?;
            let gone = young.into_iter().map(|(tree, key, value)| Change {
                op: Op { tree, key, value: None },
                old: Some(value),
            });
            self.take_in(place, place, run, gone.collect())?;
        }
        if let Some((first, last)) = self.past.alike(all) {
            let runs = self.past.runs();
            let is_oldest = runs.first().is_some_and(|named| named.place == first);
            let from = runs.partition_point(|named| named.place < first);
            let file = self.state.lsn + 1;
            let run = write_merged(&*self.disk, &self.dir, file, &runs[from..], is_oldest)?;
            let places = runs[from..].iter().map(|named| named.place).filter(|p| *p != last);
            let mut gone = Vec::new();
            for place in places {
                let key = place.to_be_bytes().to_vec();
                let old = self.memory.get(RUNS, &key)?;
                gone.push(Change { op: Op { tree: RUNS, key, value: None }, old });
            }
            self.take_in(first, last, run, gone)?;
        }
        Ok(())
    }

    /// Notes a run in the place of those from `first` to `place`, with other changes, in one transaction.
    fn take_in(
        &mut self,
        first: u64,
        place: u64,
        run: Run,
        mut changes: Vec<Change>,
    ) -> Result<()> {
        let key = place.to_be_bytes().to_vec();
        let old = self.memory.get(RUNS, &key)?;
        let value = Some(describe(run.file));
        changes.push(Change { op: Op { tree: RUNS, key, value }, old });
        let (runs, before) = (self.past.runs(), self.past.files());
        self.past.put(first, place, run);
        if let Err(error) = self.write(changes) {
            self.past.restore(runs);
            return Err(error);
        }
        let now = self.past.files();
        self.retired.retain(|(_, file)| !now.contains(file));
        let gone = before.into_iter().filter(|file| !now.contains(file));
        self.retired.extend(gone.map(|file| (self.state.lsn, file)));
        Ok(())
    }

    /// Finds files of runs that are not in use, and mends one of two by the other.
    pub(super) fn care_for_runs(&mut self, report: &mut OpenReport) {
        let dir = past_dir(&self.dir);
        let used = self.past.files();
        for extension in ["run", "twin"] {
            let files = numbered_files(&*self.disk, &dir, extension).unwrap_or_default();
            for (file, _) in files.into_iter().filter(|(file, _)| !used.contains(file)) {
                if self.retired.iter().all(|(_, known)| *known != file) {
                    self.retired.push((self.state.lsn, file));
                }
            }
        }
        if self.read_only.is_none() {
            report.past_mended = self.mend_runs();
        }
    }

    /// Writes anew, from its twin, what of a run was found broken; names one of the files.
    pub(super) fn mend_runs(&self) -> Option<Bilingual> {
        let mut mended = None;
        for named in self.past.runs().iter() {
            let Ok(run) = &named.run else { continue };
            for path in run.broken() {
                // What was read by the broken file is read by the new one from now on.
                let written = run.copy_to(&*self.disk, &path);
                let anew =
                    written.and_then(|()| Run::open(&*self.disk, &past_dir(&self.dir), run.file));
                match anew {
                    Ok(anew) => {
                        self.past.put(named.place, named.place, anew);
                        mended = Some(path.display().to_string().into());
                    }
                    Err(error) => tracing::warn!(%error, "a file of the past is not mended"),
                }
            }
        }
        mended
    }

    /// Removes the files of runs that no snapshot can need: the oldest that is kept is that of transaction `oldest`.
    pub(super) fn drop_old_runs(&mut self, oldest: u64) -> Result<()> {
        let retired = std::mem::take(&mut self.retired).into_iter();
        let (gone, kept): (Vec<_>, Vec<_>) = retired.partition(|(since, _)| *since <= oldest);
        self.retired = kept;
        for path in gone.into_iter().flat_map(|(_, file)| run::paths(&past_dir(&self.dir), file)) {
            self.disk.remove_if_there(&path).map_err(StoreError::io(doing::REMOVE, &path))?;
        }
        Ok(())
    }
}
