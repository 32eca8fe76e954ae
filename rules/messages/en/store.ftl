# What is wrong with a store.

store-io = the store: could not { $what } “{ $path }”: { $source }
    .help = see that the directory can be written and the disk has room
store-not-a-store = “{ $dir }” is no store: the directory has files, and no file FORMAT
    .help = name an empty directory, or a new one
store-not-empty = the directory “{ $dir }” is not empty
    .help = name a new directory: a store is not written over
store-missing = there is no store “{ $dir }”
    .help = make it by importing a map: ortho import MAP
store-unknown-format = the store “{ $dir }” is written in the format “{ $found }”, and this program knows format { $known }
    .help = open it with the version of the program that wrote it, and export the map
store-locked = { $drives ->
        [yes] the store “{ $dir }” is taken: another program drives the robot
       *[no] another program has the store “{ $dir }” open
    }
    .help = wait until it is done, take another store, or open this one --read-only
store-journal-corrupt = the journal “{ $path }” is damaged: the frame at { $offset } is broken, though whole ones follow
    .help = check the disk; restore the store from a backup: ortho restore
store-journal-cut-short = the journal ends at transaction { $found }, and { $known } were confirmed
    .help = check the disk; restore the store from a backup: ortho restore
store-both-corrupt = the store “{ $dir }” is damaged: the journal: { $journal }; the tables: { $tables }
    .help = check the disk, and restore the store from a backup: ortho restore BACKUP
store-bad-record = table { $table }: the record { $key } is broken
    .help = close the store and open it again: the tables will be restored from the journal
store-broken-reference = table { $table }: { $what }
    .help = check the store: ortho fsck
store-duplicate = table { $table }: the key { $key } stands twice
    .help = give the parts of the map different names
store-duplicate-name = { $table }: the name “{ $name }” stands twice
    .help = give them different names
store-id-reused = { $table }: the number { $id } belongs to the record “{ $was }”, and cannot go to “{ $is }”
    .help = take a new number: Store::next_id
store-not-finite = table { $table }, record { $key }: the field { $column } is no number, but { $value }
    .help = correct the map: numbers must be finite
store-unknown-replica = the map has no replica of the number { $id }
    .help = the replicas are listed by: ortho relations
store-derived-table = the table { $table } is computed from others, and cannot be edited
    .help = edit the tables that it comes from
store-read-only = the store is open for reading only: { $reason }
    .help = remove the cause, and open the store again
store-unknown-revision = there is no revision { $wanted }: the last is { $last }
    .help = the revisions are listed by: ortho history
store-forgotten-revision = the revision { $wanted } is removed from the history already; the earliest is { $first }
    .help = take a backup of that time
store-undo-conflict = the revision { $revision } cannot be undone: the record { $record } was changed later, by revision { $by }
    .help = first undo revision { $by }
store-already-undone = the revision { $revision } is undone already, by revision { $by }
    .help = it comes back by ortho redo, or ortho undo { $by }
store-undo-breaks = the revision { $revision } cannot be undone: the map would become faulty: { $what }
    .help = first undo the revisions that rest on it: ortho history
store-nothing-to-undo = there is nothing to { $what }
    .help = the revisions are listed by: ortho history
store-tables = the store’s tables: { $what }
    .help = close the store and open it again: the tables will be restored from the journal
store-bad-file = “{ $path }” is a broken file, or another program’s: { $what }
    .help = take another backup
