#!/bin/sh
# Lets the disk "fill up" under a program that writes a store: no file may grow beyond a limit (in KiB), as if
# there were no room. The writer must stop with an error, and all that it acknowledged must be readable. No
# rights are needed.
set -eu
cd "$(dirname "$0")/../.."
cargo test --test all --no-run
trap '' XFSZ # a write beyond the limit then fails, rather than killing the writer
for kib in 100 300 700 1500 3000; do
    dir="$(mktemp -d)"
    (
        ulimit -f "$((kib * 2))" 2>/dev/null || ulimit -f "$kib"
        STORE_FULL_DISK="$dir" cargo test --quiet --test all store_faults::a_full_disk -- --nocapture
    )
    # Now there is room again.
    STORE_CHECK="$dir" cargo test --quiet --test all store_faults::checker
    rm -r "$dir"
done
