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
. "$root/tests/eval/page.sh"

figures() {
  conditions "$page" "$1"
  build/release/tests/relations_table --runs "$1"
  echo
  echo '```'
  build/release/tests/bench_scan_matching --benchmark_repetitions=5 \
    --benchmark_report_aggregates_only=true 2>/dev/null | grep -E '^Benchmark|_median' | cut -c1-150
  echo '```'
}

update=
[[ ${1:-} == --update ]] && { update=yes; shift; }
cd "$root"
cmake --preset check >/dev/null
cmake --build --preset check --target relations_table bench_scan_matching >&2
if [[ $update ]]; then put "$page" "$(figures "${1:-5}")"; else figures "${1:-5}"; fi
