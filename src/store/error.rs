//! What can go wrong with a store, each with its remedy.

use std::path::{Path, PathBuf};

use miette::Diagnostic;
use thiserror::Error;

use crate::units::{Bilingual, is_input};

/// What was to be done with a file.
pub(crate) mod doing {
    type Words = (&'static str, &'static str);

    pub(crate) const OPEN: Words = ("открыть", "open");
    pub(crate) const LOCK: Words = ("запереть", "lock");
    pub(crate) const LIST: Words = ("прочитать каталог", "read the directory");
    pub(crate) const READ: Words = ("прочитать", "read");
    pub(crate) const WRITE: Words = ("записать", "write");
    pub(crate) const WRITE_DIR: Words = ("записать каталог", "write the directory");
    pub(crate) const WRITE_SNAPSHOT: Words = ("записать снимок", "write the snapshot");
    pub(crate) const FIND_ROOM: Words = ("найти место для", "find room for");
    pub(crate) const REMOVE: Words = ("удалить", "remove");
    pub(crate) const MAKE: Words = ("создать", "make");
    pub(crate) const MAKE_DIR: Words = ("создать каталог", "make the directory");
    pub(crate) const RENAME: Words = ("переименовать", "rename");
    pub(crate) const CUT: Words = ("укоротить", "cut short");
}

/// A store that cannot be opened, read or written, or that refuses what it was asked to keep.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum StoreError {
    /// The file system refused.
    #[error("хранилище: не удалось {what} «{path}»: {source}")]
    #[diagnostic(
        code(store::io),
        help("проверьте, что каталог доступен для записи и на диске есть место")
    )]
    Io { what: Bilingual, path: String, source: std::io::Error },

    /// A directory with something else in it.
    #[error("«{dir}» — не хранилище: в каталоге есть файлы, но нет файла FORMAT")]
    #[diagnostic(code(store::not_a_store), help("укажите пустой или новый каталог"))]
    NotAStore { dir: String },

    /// A backup is restored into a place of its own.
    #[error("каталог «{dir}» не пуст")]
    #[diagnostic(code(store::not_empty), help("укажите новый каталог: хранилище не затирается"))]
    NotEmpty { dir: String },

    /// There is nothing at this path.
    #[error("хранилища «{dir}» нет")]
    #[diagnostic(code(store::missing), help("создайте его импортом карты: ortho import КАРТА"))]
    Missing { dir: String },

    /// Written by another version of the program.
    #[error("хранилище «{dir}» записано в формате «{found}», а эта программа знает формат {known}")]
    #[diagnostic(
        code(store::unknown_format),
        help("откройте его той версией программы, которая его записала, и выгрузите карту")
    )]
    UnknownFormat { dir: String, found: String, known: u32 },

    /// Another process writes it, and went on longer than is waited; or has the robot drive.
    #[error(
        "хранилище «{dir}» {}",
        if *drives { "занято: другая программа ведёт робота" } else { "уже открыто другой программой" }
    )]
    #[diagnostic(
        code(store::locked),
        help("подождите её, выберите другое хранилище или откройте это только для чтения")
    )]
    Locked { dir: String, drives: bool },

    /// A broken frame stands before good ones: not a torn tail.
    #[error("журнал «{path}» повреждён: кадр на месте {offset} испорчен, хотя за ним есть целые")]
    #[diagnostic(
        code(store::journal_corrupt),
        help("проверьте диск; восстановите хранилище из резервной копии: ortho restore")
    )]
    JournalCorrupt { path: String, offset: u64 },

    /// The journal is whole as far as it goes, and does not go as far as was acknowledged.
    #[error("журнал обрывается на транзакции {found}, а подтверждены были {known}")]
    #[diagnostic(
        code(store::journal_cut_short),
        help("проверьте диск; восстановите хранилище из резервной копии: ortho restore")
    )]
    CutShort { found: u64, known: u64 },

    /// Neither the journal nor the tables are whole.
    #[error("хранилище «{dir}» повреждено: журнал: {journal}; таблицы: {tables}")]
    #[diagnostic(
        code(store::both_corrupt),
        help("проверьте диск и восстановите хранилище из резервной копии: ortho restore КОПИЯ")
    )]
    BothCorrupt { dir: String, journal: Box<Bilingual>, tables: Box<Bilingual> },

    /// A record's bytes do not match their checksum, or its cells do not fit.
    #[error("таблица {table}: запись {key} испорчена")]
    #[diagnostic(
        code(store::bad_record),
        help("закройте хранилище и откройте снова: таблицы восстановятся по журналу")
    )]
    BadRecord { table: &'static str, key: String },

    /// A record of the map names one that is not there.
    #[error("таблица {table}: {what}")]
    #[diagnostic(code(store::broken_reference), help("проверьте хранилище: ortho fsck"))]
    BrokenReference { table: &'static str, what: Bilingual },

    /// Two records with one key.
    #[error("таблица {table}: ключ {key} встречается дважды")]
    #[diagnostic(code(store::duplicate), help("дайте частям карты различные имена"))]
    Duplicate { table: &'static str, key: String },

    /// Two things with one name, so that an import cannot tell them apart.
    #[error("{table}: имя «{name}» встречается дважды")]
    #[diagnostic(code(store::duplicate_name), help("дайте им различные имена"))]
    DuplicateName { table: &'static str, name: String },

    /// An id of something that is gone was given to something else.
    #[error("{table}: номер {id} принадлежал записи «{was}» и не может достаться «{is}»")]
    #[diagnostic(code(store::id_reused), help("возьмите новый номер: Store::next_id"))]
    IdReused { table: &'static str, id: u32, was: String, is: String },

    /// A number that is none.
    #[error("таблица {table}, запись {key}: поле {column} — не число, а {value}")]
    #[diagnostic(code(store::not_finite), help("исправьте карту: числа должны быть конечными"))]
    NotFinite { table: &'static str, key: String, column: &'static str, value: f64 },

    /// Something is said of a replica that is not in the map.
    #[error("экземпляра с номером {id} нет на карте")]
    #[diagnostic(code(store::unknown_replica), help("список экземпляров: ortho relations"))]
    UnknownReplica { id: u32 },

    /// A derived table was to be edited.
    #[error("таблица {table} вычисляется по другим таблицам, её нельзя править")]
    #[diagnostic(code(store::derived_table), help("правьте исходные таблицы"))]
    DerivedTable { table: &'static str },

    /// The store was opened for reading, or has become unsafe to write.
    #[error("хранилище открыто только для чтения: {reason}")]
    #[diagnostic(code(store::read_only), help("устраните причину и откройте хранилище снова"))]
    ReadOnly {
        reason: Bilingual,
        /// It was opened so; else the disk is at fault.
        by_choice: bool,
    },

    /// No such revision.
    #[error("правки {wanted} нет: последняя правка — {last}")]
    #[diagnostic(code(store::unknown_revision), help("список правок: ortho history"))]
    UnknownRevision { wanted: u64, last: u64 },

    /// What a reader or an "as of" asks for was collected as garbage.
    #[error("правка {wanted} уже удалена из истории, самая ранняя — {first}")]
    #[diagnostic(code(store::forgotten_revision), help("возьмите резервную копию того времени"))]
    ForgottenRevision { wanted: u64, first: u64 },

    /// Later changes stand on the one that was to be undone.
    #[error("правку {revision} нельзя отменить: запись {record} изменена позже, правкой {by}")]
    #[diagnostic(code(store::undo_conflict), help("сначала отмените правку {by}"))]
    UndoConflict { revision: u64, record: String, by: u64 },

    /// It was undone already, and not brought back since.
    #[error("правка {revision} уже отменена правкой {by}")]
    #[diagnostic(
        code(store::already_undone),
        help("вернуть её можно правкой «ortho redo» или «ortho undo {by}»")
    )]
    AlreadyUndone { revision: u64, by: u64 },

    /// Without what the revision made, the map would be faulty.
    #[error("правку {revision} нельзя отменить: карта стала бы неверной: {what}")]
    #[diagnostic(
        code(store::undo_breaks),
        help("сначала отмените правки, которые на неё опираются: ortho history")
    )]
    UndoBreaks { revision: u64, what: Bilingual },

    /// Nothing is left to undo or redo.
    #[error("нечего {what}")]
    #[diagnostic(code(store::nothing_to_undo), help("список правок: ortho history"))]
    NothingToUndo { what: Bilingual },

    /// sled failed, or panicked.
    #[error("таблицы хранилища: {what}")]
    #[diagnostic(
        code(store::tables),
        help("закройте хранилище и откройте снова: таблицы восстановятся по журналу")
    )]
    Tables { what: Bilingual },

    /// A backup or snapshot whose bytes are not what was written.
    #[error("«{path}» — испорченный или чужой файл: {what}")]
    #[diagnostic(code(store::bad_file), help("возьмите другую резервную копию"))]
    BadFile { path: String, what: Bilingual },
}

impl StoreError {
    /// What was asked for is at fault, not the disk, the store's own files or the program.
    #[must_use]
    pub fn is_input(&self) -> bool {
        match self {
            Self::Io { source, .. } => is_input(source.kind()),
            Self::ReadOnly { by_choice, .. } => *by_choice,
            Self::JournalCorrupt { .. }
            | Self::CutShort { .. }
            | Self::BothCorrupt { .. }
            | Self::BadRecord { .. }
            | Self::Tables { .. } => false,
            _ => true,
        }
    }

    pub(crate) fn io(
        what: (&'static str, &'static str),
        path: &Path,
    ) -> impl FnOnce(std::io::Error) -> Self + use<> {
        let path: PathBuf = path.to_owned();
        move |source| Self::Io { what: what.into(), path: path.display().to_string(), source }
    }
}

/// The work of this folder succeeds or says why not.
pub(crate) type Result<T> = std::result::Result<T, StoreError>;
