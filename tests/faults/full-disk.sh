#!/bin/sh
# Lets the disk fill up under programs that write a store. Whatever they acknowledged must be there, every program must
# end by itself, and the store must open on the full disk, to read and to write.
#
# Without rights: no file may grow beyond a limit (in KiB). With root, besides, small file systems of their own (tmpfs,
# and ext4 on a loop device where that can be mounted), filled by edits of 20 kB until hundreds were refused: the place
# where sled used to wait for ever.
set -eu
cd "$(dirname "$0")/../.."
cargo test --test all --no-run
cargo build
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

[ "$(id -u)" = 0 ] || { echo "small file systems: not tried, that needs root"; exit 0; }
ortho="${ORTHO:-target/debug/ortho}"

# fill DIRECTORY NAME: edits until the disk is full and long after.
fill() {
    store="$1/store"
    "$ortho" --store "$store" import maps/rb2.toml >/dev/null
    done=0 refused=0 longest=0
    for n in $(seq 1 "${EDITS:-60}"); do
        text="$(head -c 15000 /dev/urandom | base64 -w0)"
        begin="$(date +%s)"
        code=0
        timeout 60 "$ortho" --store "$store" edit set Стол-1 ЗАМЕТКА "$text" >"$1.out" 2>"$1.err" || code=$?
        took="$(($(date +%s) - begin))"
        [ "$took" -le "$longest" ] || longest="$took"
        case "$code" in
        0) done="$((done + 1))" last="$text" ;;
        3) refused="$((refused + 1))" ;;
        *) echo "$2, edit $n: exit code $code"; cat "$1.err"; exit 1 ;;
        esac
        # What was acknowledged is read, on the full disk too.
        "$ortho" --read-only --store "$store" history --json >"$1.out"
        revisions="$(grep -o '"revision"' "$1.out" | wc -l)"
        [ "$revisions" -eq "$((done + 1))" ] || { echo "$2: $done edits acknowledged, $revisions there"; exit 1; }
    done
    "$ortho" --read-only --store "$store" as-of "$revisions" | grep -qF "$last" || { echo "$2: another map"; exit 1; }
    [ -z "$(find "$store" -name '*.new')" ] || { echo "$2: leftovers"; find "$store" -name '*.new'; exit 1; }
    echo "$2: $done edits acknowledged, $refused refused, none lost; the longest took $longest s"
}

work="$(mktemp -d)"
for kib in 800 1200 2000; do
    mkdir -p "$work/disk"
    mount -t tmpfs -o "size=${kib}k" tmpfs "$work/disk"
    fill "$work/disk" "tmpfs of $kib KiB"
    umount "$work/disk"
done
truncate -s 3M "$work/image"
if mkfs.ext4 -q -F -O ^has_journal "$work/image" && mount -o loop "$work/image" "$work/disk"; then
    fill "$work/disk" "ext4 of 3 MiB"
    umount "$work/disk"
fi
rm -r "$work"
