#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# campaign_overhead.sh [UNITS [JOBS [RUNS]]]
# Prints the time that `adit campaign` takes for UNITS (40) commands of about two seconds, JOBS (1) at a time, against
# a bare loop (xargs) over the same commands: medians of RUNS (5) runs each, one after the other in turn. CPU time is
# that of all processes, and depends less on what else the computer does.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

units=${1:-40}
jobs=${2:-1}
runs=${3:-5}
build adit adit-watch
adit=$root/build/release/bin/adit
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cat >"$folder/campaign.yaml" <<END
campaign:
  command: adit sample {out}/mine.log --seed {seed}
matrix:
  seed: {from: 1, to: $units}
END

bare_loop() {
  seq "$units" | xargs -P "$jobs" -I '{}' sh -c \
    "mkdir -p '$folder/bare/{}' && '$adit' sample '$folder/bare/{}/mine.log' --seed {} >'$folder/bare/{}/output.log' 2>&1"
}
campaign() { "$adit" campaign "$folder/campaign.yaml" --out "$folder/campaign" --jobs "$jobs" >/dev/null 2>&1; }

# timed NAME: appends "NAME WALL_S CPU_S" to the times.
timed() {
  rm -rf "$folder/bare" "$folder/campaign"
  local TIMEFORMAT="$1 %R %U %S"
  { time "$1" 2>&1; } 2>&1 | awk '{ print $1, $2, $3 + $4 }' >>"$folder/times"
}

median() { awk -v name="$1" -v column="$2" '$1 == name { print $column }' "$folder/times" | sort -n |
  awk '{ value[NR] = $1 } END { print (value[int((NR + 1) / 2)] + value[int(NR / 2) + 1]) / 2 }'; }

for ((run = 0; run < runs; ++run)); do
  timed bare_loop
  timed campaign
done
conditions "medians of $runs runs"
echo "| $units commands, $jobs at a time | bare loop (s) | adit campaign (s) | more (%) |"
echo "|---|---|---|---|"
for column in 2:wall 3:CPU; do
  bare=$(median bare_loop "${column%:*}") with=$(median campaign "${column%:*}")
  awk -v name="${column#*:}" -v bare="$bare" -v with="$with" \
    'BEGIN { printf "| %s time | %.2f | %.2f | %.1f |\n", name, bare, with, 100 * (with / bare - 1) }'
done
