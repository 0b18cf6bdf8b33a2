#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# check.sh
# The checks that test.sh leaves out: builds the benchmarks and accuracy tables (warnings are errors),
# checks the layout of the sources and runs clang-tidy (lint.sh), runs a million mutated inputs through all parsers
# under the address and undefined-behaviour sanitizers, and sends mutated messages to all stages of missions
# (fuzz_stages, without sanitizers: all stages with them take longer to build than all else here). Ends with 0 only if
# all pass.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
kFuzzCases=1000000
kFuzzMessages=100000

"$root/deploy/install_dependencies.sh" build test check
cd "$root"
cmake --preset check >/dev/null
cmake --build --preset check

failed=()
deploy/lint.sh build/release || failed+=(lint)

cmake --preset asan >/dev/null
cmake --build --preset asan --target fuzz_inputs
build/asan/tests/fuzz_inputs --cases "$kFuzzCases" --seed 1 || failed+=(fuzzing)
build/release/tests/fuzz_stages --cases "$kFuzzMessages" --seed 1 || failed+=("fuzzing of the stages")

if ((${#failed[@]})); then
  echo "FAILED: ${failed[*]}" >&2
  exit 1
fi
echo "check: benchmarks built, lint and fuzzing passed"
