#!/usr/bin/env bash
# shipped.sh PROGRAM STUDY RESULTS: a study that ships, with 50 cells if ZWANG_LONG is in the environment, else with one.
runs=1
if [ -n "${ZWANG_LONG:-}" ]; then runs=50; fi
exec "$1" sweep "$2" --runs "$runs" -j2 --fresh --out "$3"
