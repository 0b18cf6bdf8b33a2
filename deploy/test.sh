#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# test.sh [--built]
# Runs all tests, on a fresh clone on Debian 12 too: installs what is missing, builds the tests beside the
# programs in build/release (what demo.sh has built is used again), runs CTest. Ends with CTest's counts,
# and with 0 only if every test passed. Lint and fuzzing are in check.sh. --built: build/release has all tests already.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")

cd "$root"
if [[ ${1:-} != --built ]]; then
  deploy/install_dependencies.sh build test
  cmake --preset test >/dev/null
  cmake --build --preset test
fi

# The reader of a test that is not ours; without it that test is skipped.
if command -v npm >/dev/null; then
  (cd tests/live/export && npm ci --ignore-scripts --no-audit --no-fund >/dev/null) ||
    echo "npm ci failed in tests/live/export: its test is skipped" >&2
fi

# The fuzz targets run in check.sh, under sanitizers.
ctest --preset test --exclude-regex '^Fuzz' --parallel "$(nproc)"
