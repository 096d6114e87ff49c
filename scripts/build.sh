#!/usr/bin/env bash
# build.sh [PRESET [CMAKE OPTION…]]: configures and builds build/PRESET; presets: release (the default), debug, asan-ubsan.
# LUCARNE_WERROR=1 makes warnings errors.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:-release}
shift || true
export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS-pch_defines,time_macros}  # without, nothing with precompiled headers is cached
werror=OFF
case "${LUCARNE_WERROR:-0}" in 1 | ON | on | yes) werror=ON ;; esac
cmake --preset "$preset" -DLUCARNE_WERROR="$werror" "$@"
cmake --build --preset "$preset" --parallel "$(nproc)"
