#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# test.sh
# The whole of the checks, on a fresh clone on Debian 12 too: installs what is missing, builds with
# warnings as errors, checks form, fuzzes under sanitizers, runs all tests. Ends with CTest's counts,
# and with 0 only if everything passed.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
kFuzzCases=1000000

"$root/deploy/install_dependencies.sh" build check
cd "$root"
cmake --preset ci >/dev/null
cmake --build --preset ci

failed=()
"$root/deploy/lint.sh" build/ci || failed+=(lint)

cmake --preset asan >/dev/null
cmake --build --preset asan --target fuzz_inputs
build/asan/tests/fuzz_inputs --cases "$kFuzzCases" --seed 1 || failed+=(fuzzing)

# The million cases have just been run where they count more.
ctest --preset ci --exclude-regex '^Fuzz' --parallel "$(nproc)" || failed+=(tests)
if ((${#failed[@]})); then
  echo "FAILED: ${failed[*]}" >&2
  exit 1
fi
