#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mission_kills.sh ADIT CHECK_LOSSES FOLDER [HARMS [CUTS [JOBS [MINUTES [SEED]]]]]
# By hand, not in CI. Each stage of a mission is killed, and suspended, at HARMS random moments, several
# in one mission with time between to recover; all of it is cut off CUTS times and goes on, a few times in
# one mission. JOBS missions at once, none begun after MINUTES. Whether the robot came home is asked of the
# truth, and what was lost of the journals (check_losses). FOLDER gets a line for each mission, and keeps
# those that went wrong; the tables for docs/results/mission.md are printed at the end.
set -u
here=$(dirname "$(readlink -f "$0")")
adit=$(readlink -f "$1"); check_losses=$(readlink -f "$2"); mkdir -p "$3"; folder=$(readlink -f "$3")
harms=${4:-50}; cuts=${5:-20}; jobs=${6:-1}; minutes=${7:-100000}; seed=${8:-1}
kStages=(scan_matching mapping scan_assembly terrain volume_map planning driving guard exploration mission)
kFaultsPerMission=9; kPowerLossesPerMission=3
kFirstS=5; kApartS=28; kSpreadS=17       # of simulated time, from harm to harm
kPowerLossMinS=4; kPowerLossMaxS=20                  # of the clock, from cut to cut
kPowerLossEach=5; kRandomEach=4                # one mission of so many is cut off; is in a random mine
kRandomMine=(random --length-m 50)
kTimeoutSeconds=1200

"$here/in_private_network.sh" true || exit
mkdir -p "$folder/planned"
touch "$folder/harms.tsv" "$folder/missions.tsv" "$folder/cuts.tsv"
trap 'kill $(jobs -p) 2>/dev/null; wait; rm -rf "$folder/planned"' EXIT
until_s=$((SECONDS + 60 * minutes))

all_pairs() { for stage in "${kStages[@]}"; do echo "kill:$stage"; echo "suspend:$stage"; done; }
# The harms that were done least often until now, those of missions under way included; of two that were
# done as often, that which the dice say.
least_done() {
  { all_pairs; cut -f 2 "$folder/harms.tsv"; cat "$folder"/planned/* 2>/dev/null; } | sort | uniq -c |
    awk -v max="$harms" '$1 <= max { print $1, $2 }' |
    while read -r count pair; do echo "$count $RANDOM $pair"; done |
    sort -n -k 1,1 -k 2,2 | head -n "$kFaultsPerMission" | shuf --random-source=<(yes "$RANDOM") |
    cut -d ' ' -f 3
}
world_of() {
  if (($1 % kRandomEach)); then echo "$here/bent_tunnel.yaml"; else echo "${kRandomMine[*]} --seed $((100 * seed + $1))"; fi
}
# keep N OUT EXIT: the line of a mission; what went wrong is kept.
keep() {
  local found lost
  found=$("$check_losses" "$2/out" 2>>"$2/text"); lost=$?
  printf '%s\t%s\t%s\t%s\n' "$1" "$(<"$2/world")" "$3" "$found" >>"$folder/missions.tsv"
  if (($3 == 0 && lost == 0)); then rm -rf "$2"; fi
}
# What was done to whom, by the words of the simulator; what was to come after the end did not.
done_in() { grep -aoE '(kill|suspend) adit-[a-z_]+: 1 process' "$1"/run*.lcmlog | sort -u | sed -E 's/.*(kill|suspend) adit-([a-z_]+):.*/\1:\2/'; }

harmed() {
  local n=$1 out=$folder/$1 at=$kFirstS faults=() pair
  mkdir -p "$out"; world_of "$n" >"$out/world"
  while read -r pair; do
    at=$((at + kApartS + RANDOM % kSpreadS)); faults+=(--fault "$pair@$at")
    printf '%s\t%s\t%s\n' "$n" "$pair" "$at" >>"$out/plan"
  done <"$folder/planned/$n"
  # shellcheck disable=SC2046
  timeout "$kTimeoutSeconds" "$adit" mission $(<"$out/world") --out "$out/out" "${faults[@]}" \
    >"$out/text" 2>&1
  local result=$?
  done_in "$out/out" >"$out/done"
  grep -F -f "$out/done" "$out/plan" >>"$folder/harms.tsv"
  rm "$folder/planned/$n"
  keep "$n" "$out" "$result"
}

# Phase 6 is the end.
has_ended() { awk -F '\t' '$2 == 6 { ended = 1 } END { exit !ended }' "$1/phases.tsv"; }

power_loss() {
  local n=$1 out=$folder/$1 i victim result
  mkdir -p "$out"; world_of "$n" >"$out/world"
  echo "mission: {after_power_loss: $( ((n % 2)) && echo resume || echo home)}" >"$out/config.yaml"
  # shellcheck disable=SC2046
  set -- $(<"$out/world") --config "$out/config.yaml"
  for ((i = 0; i < kPowerLossesPerMission; ++i)); do
    "$adit" mission "$@" --out "$out/out" >>"$out/text" 2>&1 & victim=$!
    sleep $((kPowerLossMinS + RANDOM % (kPowerLossMaxS - kPowerLossMinS))).$((RANDOM % 10))
    kill -KILL "$victim" 2>/dev/null; wait "$victim" 2>/dev/null
    sleep 2
    has_ended "$out/out" && break
    printf '%s\t%s\n' "$n" "$i" >>"$folder/cuts.tsv"
    set -- --resume
  done
  timeout "$kTimeoutSeconds" "$adit" mission --resume --out "$out/out" >>"$out/text" 2>&1
  result=$?
  grep -q "has ended: the robot is at home" "$out/text" && result=0
  keep "$n" "$out" "$result"
}

worker() {
  local n
  for ((n = $1; SECONDS < until_s; n += jobs)); do
    RANDOM=$((seed * 1000 + n))
    if (($(wc -l <"$folder/cuts.tsv") < cuts && (n % kPowerLossEach == 0 || harms == 0))); then
      power_loss "$n"
      continue
    fi
    exec 9>"$folder/lock"; flock 9
    least_done >"$folder/planned/$n"
    flock -u 9
    [[ -s $folder/planned/$n ]] || { rm "$folder/planned/$n"; break; }
    harmed "$n"
  done
}

# Of missions.tsv and harms.tsv; what a mission lost counts for each who was harmed in it.
table_of_faults() {
  echo "| stage | kind | harms | missions | of these at home | farthest from the start (m) | local maps lost | 3D scans lost |"
  echo "|---|---|---|---|---|---|---|---|"
  awk -F '\t' '
    FILENAME ~ /missions[.]tsv$/ { result[$1] = $3; off[$1] = $4; maps[$1] = $6; scans[$1] = $8; next }
    $1 in result {
      ++harms[$2]
      if (seen[$2, $1]++) next
      ++missions[$2]; home[$2] += result[$1] == 0; lost_maps[$2] += maps[$1]; lost_scans[$2] += scans[$1]
      if (off[$1] > worst[$2]) worst[$2] = off[$1]
    }
    END {
      for (pair in harms) {
        split(pair, of, ":")
        printf "| %s | %s | %d | %d | %d | %.2f | %d | %d |\n", of[2], of[1], harms[pair], missions[pair],
          home[pair], worst[pair], lost_maps[pair], lost_scans[pair]
      }
    }' "$folder/missions.tsv" "$folder/harms.tsv" | sort
}
table_of_missions() {
  echo "| missions | of these at home | farthest from the start (m) | local maps | lost | 3D scans | lost |"
  echo "|---|---|---|---|---|---|---|"
  awk -F '\t' '
    FILENAME ~ /cuts[.]tsv$/ { ++cuts[$1]; ++all_power_losses; next }
    {
      kind = $1 in cuts ? "cut off, " all_power_losses " times" : "harmed"
      ++n[kind]; home[kind] += $3 == 0; maps[kind] += $5; lost_maps[kind] += $6; scans[kind] += $7
      lost_scans[kind] += $8
      if ($4 > worst[kind]) worst[kind] = $4
    }
    END {
      for (kind in n) {
        printf "| %d %s | %d | %.2f | %d | %d | %d | %d |\n", n[kind], kind, home[kind], worst[kind], maps[kind],
          lost_maps[kind], scans[kind], lost_scans[kind]
      }
    }' "$folder/cuts.tsv" "$folder/missions.tsv"
}

for ((j = 1; j <= jobs; ++j)); do worker "$j" & done
wait
table_of_faults
echo; table_of_missions
echo; echo "Lost, or not at home:"
awk -F '\t' '$3 != 0 || $6 + $8 > 0' "$folder/missions.tsv"
