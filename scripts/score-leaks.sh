#!/usr/bin/env bash
# Scores leaks, rims and seams in built-in scenes: prints the table of docs/leaks.md.
#   scripts/score-leaks.sh [PHOTONS]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${LUCARNE_BUILD:-build/release}
[[ -f $build/build.ninja ]] || cmake --preset release >/dev/null
cmake --build "$build" --target leak_study >/dev/null
"$build/tests/bench/leak_study" "${1:-4000000}"
