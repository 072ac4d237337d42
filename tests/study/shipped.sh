#!/usr/bin/env bash
# shipped.sh PROGRAM STUDY CELLS PART OF FOLDER: a part of the first cells of a study that ships, in one process; of the
# first 50 if ZWANG_LONG is in the environment. Ends with 1 if an expectation is broken.
name=$(basename "$2" .yaml) cells=$3
if [ -n "${ZWANG_LONG:-}" ]; then cells=50; fi
exec "$1" sweep "$2" --runs "$cells" --shard "$4/$5" -j1 --fresh --out "$6/$name.$4-of-$5.db"
