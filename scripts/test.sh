#!/usr/bin/env bash
# Installs the dependencies, builds the release preset and runs every test. LUCARNE_WERROR=1 makes warnings errors.
# The last thing printed is CTest's summary.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install-dependencies.sh
scripts/build.sh release
ctest --preset release --parallel "$(($(nproc) + 1))"  # some tests wait
