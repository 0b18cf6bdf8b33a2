#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# check.sh [--built]
# The checks that test.sh leaves out: builds the benchmarks, and the accuracy tables without optimization, to see that they
# build (warnings are errors), checks the layout of the sources and runs clang-tidy (lint.sh), runs a million mutated
# inputs through all parsers under the address and undefined-behaviour sanitizers, and sends mutated messages to all
# stages of missions (fuzz_stages, without sanitizers: all stages with them take longer to build than all else here). Ends
# with 0 only if all pass. --built: build/release has all of the preset check already.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
kFuzzCases=1000000
kFuzzMessages=100000

cd "$root"
if [[ ${1:-} != --built ]]; then
  deploy/install_dependencies.sh build test check
  cmake --preset check >/dev/null
  cmake --build --preset check
fi

# What has no limits of time yields to the tests that may run meanwhile. The fuzzers, whose cases have one, come last, with a
# processor each.
cmake --preset asan >/dev/null
nice -n 19 cmake --build --preset asan --target fuzz_inputs
failed=()
nice -n 19 deploy/lint.sh build/release || failed+=(lint)
outputs=$(mktemp -d)
trap 'rm -r "$outputs"' EXIT
build/asan/tests/fuzz_inputs --cases "$kFuzzCases" --seed 1 >"$outputs/inputs" 2>&1 &
inputs=$!
build/release/tests/fuzz_stages --cases "$kFuzzMessages" --seed 1 >"$outputs/stages" 2>&1 &
stages=$!
wait $inputs || failed+=(fuzzing)
wait $stages || failed+=("fuzzing of the stages")
cat "$outputs/inputs" "$outputs/stages"

if ((${#failed[@]})); then
  echo "FAILED: ${failed[*]}" >&2
  exit 1
fi
echo "check: benchmarks built, lint and fuzzing passed"
