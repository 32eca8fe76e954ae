#!/bin/sh
# Kills a program that writes a store, without warning, 300 times (or as many as the first argument says), also
# while it recovers from the time before. Nothing that it acknowledged may be missing. No rights are needed.
set -eu
cd "$(dirname "$0")/../.."
STORE_KILLS="${1:-300}" cargo test --test all store_faults::what_was_acknowledged -- --nocapture
