#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# scan_matching.sh [--update] [RUNS]
# Builds optimised (preset ci) and prints the figures of docs/results/scan_matching.md; --update puts
# them into the page, behind its last heading. To be run while the machine has nothing else to do.
set -euo pipefail
root=$(dirname "$(dirname "$(dirname "$(readlink -f "$0")")")")
page=$root/docs/results/scan_matching.md
kHeading='## Figures'

figures() {
  local changes=
  git diff --quiet HEAD -- . ":!$page" || changes=', with changes'
  echo "$(date +%F), commit $(git rev-parse --short HEAD)$changes, default configuration, $(nproc) cores of" \
    "$(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -1)," \
    "load before $(cut -d' ' -f1 /proc/loadavg), medians of $1 runs."
  echo
  build/ci/tests/relations_table --runs "$1"
  echo
  echo '```'
  build/ci/tests/bench_scan_matching --benchmark_repetitions=5 \
    --benchmark_report_aggregates_only=true 2>/dev/null | grep -E '^Benchmark|_median' | cut -c1-150
  echo '```'
}

update=
[[ ${1:-} == --update ]] && { update=yes; shift; }
cd "$root"
cmake --preset ci >/dev/null
cmake --build --preset ci --target relations_table bench_scan_matching >&2
if [[ $update ]]; then
  new=$(sed "/^$kHeading/q" "$page"; echo; figures "${1:-5}")
  echo "$new" >"$page"
else
  figures "${1:-5}"
fi
