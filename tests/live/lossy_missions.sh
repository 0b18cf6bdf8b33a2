#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# lossy_missions.sh ADIT DIR SHARE [COUNT [JOBS]]
# Run by hand, not in CI. Missions of processes (bent_tunnel, and every second one a random level mine of 50 m) in which
# the SHARE (0.05, 0.3) of the messages of the sensors is lost from 5 s on. Prints a row for each and a summary; the
# distance from home is the true one. Exit code 1 if one says "home" farther than 0.5 m from it.
set -u
here=$(dirname "$(readlink -f "$0")")
adit=$(readlink -f "$1"); mkdir -p "$2"; folder=$(readlink -f "$2"); share=$3; count=${4:-8}; jobs=${5:-1}
"$here/in_private_network.sh" true || exit

run() {
  local n=$1 world=("$here/bent_tunnel.yaml") code
  ((n % 2)) || world=(random_level --length-m 50 --seed "$((900 + n))")
  timeout 1800 "$adit" mission "${world[@]}" --out "$folder/$n" --fault "packet_loss=$share@5" >"$folder/$n.text" 2>&1
  code=$?
  local distance_m outcome
  distance_m=$(sed -nE 's/.*; ([0-9.]+) m from the start at the end.*/\1/p' "$folder/$n.text")
  outcome=$(grep -aE '^(the robot is at home|at home by its own|.*stranded)|time limit' "$folder/$n.text" | tail -1 | cut -c1-110)
  printf '%s\t%s\t%s\t%s\t%s\n' "$n" "${world[*]##*/}" "$code" "${distance_m:-?}" "$outcome" >"$folder/$n.row"
  rm -rf "${folder:?}/$n"
}
worker() {
  local n
  for ((n = $1; n <= count; n += jobs)); do run "$n"; done
}
for ((j = 1; j <= jobs; ++j)); do worker "$j" & done
wait
echo "| mission | world | exit code | from the start (m) | outcome |"
echo "|---|---|---|---|---|"
cat "$folder"/*.row | sort -n | awk -F '\t' '
  { printf "| %s | %s | %s | %s | %s |\n", $1, $2, $3, $4, $5
    if ($3 == 0) { ++home; if ($4 > 0.5) ++false_home }
    if ($4 <= 0.5) ++near
    if ($4 > worst) worst = $4 }
  END {
    printf "\n%d missions: %d home, %d of them falsely; %d within 0.5 m; %.2f m at most\n", NR, home, false_home, near, worst
    exit false_home > 0
  }'
