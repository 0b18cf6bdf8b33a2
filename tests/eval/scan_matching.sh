#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# scan_matching.sh [RUNS]
# Prints the figures of docs/results/scan_matching.md, with RUNS (5) runs of each log. Run it on an idle
# computer.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

runs=${1:-5}
build scan_matching_table bench_scan_matching
conditions "medians of $runs runs"
"$programs/scan_matching_table" --runs "$runs"
echo
echo '```'
"$programs/bench_scan_matching" --benchmark_repetitions=5 --benchmark_report_aggregates_only=true \
  2>/dev/null | grep -E '^Benchmark|_median' | cut -c1-150
echo '```'
