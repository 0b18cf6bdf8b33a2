#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# seeded_faults.sh DIR [JOBS [PROGRAMS]]
# Searches missions for each of three seeded faults until one fails that succeeds without the fault, one search after the other with
# JOBS (2) missions at a time, and prints how long each took. An interrupted search continues from DIR. PROGRAMS is a folder with
# programs that are built already: adit, adit-watch, mission_table, mission_table_without_belly.
#   guard   the guard stops only at the full sinkage of the vehicle, not at three quarters
#   belly   the planner ignores what would touch the belly
#   gate    the gates of loop closures are ten times too wide, in standard deviations
folder=$(realpath -m "$1") jobs=${2:-2} built=${3:+$(realpath "$3")}
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

adit=$root/build/release/bin/adit
if [ -n "$built" ]; then
  programs=$built
  adit=$built/adit
else
  build adit adit-watch mission_table mission_table_without_belly
fi

# search NAME FILE FAULTY SECTION: prints a row of the table.
search() {
  mkdir -p "$folder/$1"
  cp "$root/tests/eval/search/mission_pair.sh" "$folder/$1"
  sed "s|\"FAULT\"|\"$4\"|; s|FAULTY|$programs/$3|g; s|SOUND|$programs/mission_table|g" \
    "$root/tests/eval/search/$2.yaml" >"$folder/$1/$1.yaml"
  local begin=$SECONDS code=0
  "$adit" search "$folder/$1/$1.yaml" --out "$folder/$1/out" --jobs "$jobs" >"$folder/$1/search.log" || code=$?
  [ $code -le 1 ] || exit $code
  grep '^new kind' "$folder/$1/search.log" >&2 || true
  printf '| %s | %s |%s\n' "$1" "$((SECONDS - begin))" "$(sed -n 's/^| 1 |//p' "$folder/$1/out/search.md")"
}

conditions "one search each, $jobs missions at a time"
echo "| fault | wall time with shrinking (s) | kind | failures | found after (units, CPU time) | simplest | unit |"
echo "|---|---|---|---|---|---|---|"
search guard seeded_fault mission_table 'guard: {{sinkage_share: 1}}'
search belly seeded_fault mission_table_without_belly ''
search gate seeded_gate mission_table 'mapping: {{matching: {{gate_sigmas: 40}}, association: {{gate: 2110, gate_supported: 4200}}}}'
