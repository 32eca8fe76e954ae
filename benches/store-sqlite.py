#!/usr/bin/env python3
"""The work of benches/store.rs done by SQLite: WAL, synchronous=FULL, the same records in the same batches.

Usage: benches/store-sqlite.py [DIRECTORY ON THE SAME DISK]
"""
import os, shutil, sqlite3, sys, tempfile, time

RECORDS, BATCH, FRAGMENT = 100_000, 1000, 20


def replica(n):
    return (
        n // FRAGMENT, n % 7, n, n * 0.37, n * 0.11, 0.0, n % 4 * 90.0, n % 101,
        f"Стул номер {n} у окна в комнате для совещаний",
        f"Chair number {n} at the window of the meeting room",
        0, "2026-09-21T14:13:20.000Z", "Мастер",
    )


def main():
    base = sys.argv[1] if len(sys.argv) > 1 else "target/tmp"
    os.makedirs(base, exist_ok=True)
    rows = [replica(n) for n in range(RECORDS)]
    for _ in range(3):
        directory = tempfile.mkdtemp(dir=base)
        path = os.path.join(directory, "map.sqlite")
        db = sqlite3.connect(path, isolation_level=None)
        db.execute("PRAGMA journal_mode=WAL")
        db.execute("PRAGMA synchronous=FULL")
        db.execute(
            "CREATE TABLE AreaObjects (AreaID INTEGER, ObjectID INTEGER, ReplID INTEGER, X REAL, Y REAL, Z REAL,"
            " Ang REAL, MoveProb INTEGER, Name TEXT, NameEn TEXT, Deleted INTEGER, RecDate TEXT, RecUser TEXT,"
            " PRIMARY KEY (AreaID, ObjectID, ReplID)) WITHOUT ROWID"
        )
        insert = "INSERT INTO AreaObjects VALUES (" + ",".join("?" * 13) + ")"
        start, cpu = time.perf_counter(), time.process_time()
        for first in range(0, RECORDS, BATCH):
            db.execute("BEGIN")
            db.executemany(insert, rows[first:first + BATCH])
            db.execute("COMMIT")
        print(f"100 000 records in 100 durable batches: {time.perf_counter() - start:.3f} s"
              f" (CPU {time.process_time() - cpu:.3f} s)")
        n, times = 0, []
        for _ in range(300):
            n = (n + 7919) % RECORDS
            start = time.perf_counter()
            db.execute("UPDATE AreaObjects SET X = ?, Y = ? WHERE AreaID = ? AND ObjectID = ? AND ReplID = ?",
                       (n + 0.5, n + 1.0, n // FRAGMENT, n % 7, n))
            times.append(time.perf_counter() - start)
        times.sort()
        print(f"one durable edit: median {times[150] * 1e6:.0f} µs")
        db.close()
        shutil.rmtree(directory)


if __name__ == "__main__":
    main()
