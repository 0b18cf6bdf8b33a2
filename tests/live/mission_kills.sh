#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mission_kills.sh ADIT N [M [WORLD [SEED]]]
# By hand, not in CI. Each process of a mission is killed, and suspended, at N random moments, one
# mission for each; the whole of it is cut off M (N) times and started again. Prints a table for
# docs/results/mission.md.
set -u
here=$(dirname "$(readlink -f "$0")")
adit=$(readlink -f "$1"); count=$2; cuts=${3:-$count}; world=${4:-$here/bent_drift.yaml}; RANDOM=${5:-1}
kStages=(scan_matching mapping scan_assembly terrain volume_map planning driving guard exploration mission)
kFirstS=10; kLastS=300   # of simulated time, for a harm
kCutMaxS=30              # of the clock, for a cut
kPatienceSeconds=1200

scratch=$(mktemp -d)
trap 'kill -KILL $(jobs -p) 2>/dev/null; wait; rm -rf "$scratch"' EXIT
at() { echo $((kFirstS + RANDOM % (kLastS - kFirstS))); }
last() { tr '\r' '\n' <"$1" | grep -B 1 'from the start at the end' | tail -2 | head -1; }
stand() { tr '\r' '\n' <"$1" | grep 'from the start at the end' | tail -1; }

# row HARM MOMENT EXIT TEXT
row() {
  local outcome=home; (($3 == 0)) || outcome="**not home** ($3)"
  echo "| $1 | $2 | $outcome | $(stand "$4") | $(last "$4") |"
}
mission() { timeout "$kPatienceSeconds" "$adit" mission "$@"; }

echo "| harm | at | outcome | time, and where it stood | in its words |"
echo "|---|---|---|---|---|"
runs=0; home=0
for stage in "${kStages[@]}"; do
  for harm in kill suspend; do
    for ((i = 0; i < count; ++i)); do
      moment=$(at); out=$scratch/out; rm -rf "$out"
      mission "$world" --out "$out" --fault "$harm:$stage@$moment" >"$scratch/text" 2>/dev/null
      result=$?; runs=$((runs + 1)); ((result == 0)) && home=$((home + 1))
      row "$harm $stage" "$moment s" "$result" "$scratch/text"
    done
  done
done
for ((i = 0; i < cuts; ++i)); do
  out=$scratch/out; rm -rf "$out"; moment=$((3 + RANDOM % kCutMaxS))
  "$adit" mission "$world" --out "$out" >/dev/null 2>&1 & victim=$!
  sleep "$moment"
  kill -KILL "$victim" 2>/dev/null; wait "$victim" 2>/dev/null
  sleep 1
  mission --resume --out "$out" >"$scratch/text" 2>&1
  result=$?; runs=$((runs + 1)); ((result == 0)) && home=$((home + 1))
  row "all cut off" "$moment s of the clock" "$result" "$scratch/text"
done
echo
echo "Home in $home of $runs."
