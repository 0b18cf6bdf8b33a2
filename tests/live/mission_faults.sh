#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mission_faults.sh ADIT CHECK_LOSSES FOLDER [FAULTS [POWER_LOSSES [JOBS [MINUTES [SEED]]]]]
# Run by hand, not in CI. Kills and suspends each stage at FAULTS random times, several per mission with time to
# recover between them, and kills complete missions POWER_LOSSES times, a few times per mission, and resumes them.
# Runs JOBS missions in parallel and starts none after MINUTES. The return of the robot is checked by ground truth,
# lost data by the journals (check_losses). FOLDER receives one line per mission, and the folders of missions that
# failed; the tables for docs/results/mission.md are printed at the end.
set -u
here=$(dirname "$(readlink -f "$0")")
adit=$(readlink -f "$1"); check_losses=$(readlink -f "$2"); mkdir -p "$3"; folder=$(readlink -f "$3")
faults=${4:-50}; power_losses=${5:-20}; jobs=${6:-1}; minutes=${7:-100000}; seed=${8:-1}
kStages=(scan_matching mapping scan_assembly terrain volume_map planning driving guard exploration mission)
kFaultsPerMission=20; kPowerLossesPerMission=3
kFirstS=5; kIntervalS=12; kSpreadS=8      # simulated time between faults
kPowerLossMinS=4; kPowerLossMaxS=20        # wall time between power losses
kPowerLossEach=5; kRandomEach=4            # every n-th mission has power losses; is in a random mine
kRandomMine=(random_level --length-m 50)
kTimeoutSeconds=1200

"$here/in_private_network.sh" true || exit
mkdir -p "$folder/planned"
touch "$folder/faults.tsv" "$folder/missions.tsv" "$folder/power_losses.tsv"
trap 'kill $(jobs -p) 2>/dev/null; wait; rm -rf "$folder/planned"' EXIT
until_s=$((SECONDS + 60 * minutes))

all_pairs() { for stage in "${kStages[@]}"; do echo "kill:$stage"; echo "suspend:$stage"; done; }
# The least frequent faults so far, including those of running missions, in random order.
select_faults() {
  { all_pairs; cut -f 2 "$folder/faults.tsv"; cat "$folder"/planned/* 2>/dev/null; } | sort | uniq -c |
    awk -v max="$faults" '$1 <= max { print $1, $2 }' |
    while read -r count pair; do echo "$count $RANDOM $pair"; done |
    sort -n -k 1,1 -k 2,2 | head -n "$kFaultsPerMission" | shuf --random-source=<(yes "$RANDOM") |
    cut -d ' ' -f 3
}
world_of() {
  if (($1 % kRandomEach)); then echo "$here/bent_tunnel.yaml"; else echo "${kRandomMine[*]} --seed $((100 * seed + $1))"; fi
}
# record N OUT EXIT: appends the line of a mission; deletes its folder if it succeeded.
record() {
  local losses lost
  losses=$("$check_losses" "$2/out" 2>>"$2/text"); lost=$?
  printf '%s\t%s\t%s\t%s\n' "$1" "$(<"$2/world")" "$3" "$losses" >>"$folder/missions.tsv"
  if (($3 == 0 && lost == 0)); then rm -rf "$2"; fi
}
# Faults that the simulator reports as injected; those planned after the end of the mission are missing.
injected_in() { grep -aoE '(kill|suspend) adit-[a-z_]+: 1 process' "$1"/run*.lcmlog | sort -u | sed -E 's/.*(kill|suspend) adit-([a-z_]+):.*/\1:\2/'; }

run_with_faults() {
  local n=$1 out=$folder/$1 at=$kFirstS options=() pair
  mkdir -p "$out"; world_of "$n" >"$out/world"
  while read -r pair; do
    at=$((at + kIntervalS + RANDOM % kSpreadS)); options+=(--fault "$pair@$at")
    printf '%s\t%s\t%s\n' "$n" "$pair" "$at" >>"$out/plan"
  done <"$folder/planned/$n"
  # shellcheck disable=SC2046
  timeout "$kTimeoutSeconds" "$adit" mission $(<"$out/world") --out "$out/out" "${options[@]}" \
    >"$out/text" 2>&1
  local result=$?
  injected_in "$out/out" >"$out/injected"
  grep -F -f "$out/injected" "$out/plan" >>"$folder/faults.tsv"
  rm "$folder/planned/$n"
  record "$n" "$out" "$result"
}

# Phase 6: the mission has ended.
has_ended() { awk -F '\t' '$2 == 6 { ended = 1 } END { exit !ended }' "$1/phases.tsv"; }

run_with_power_losses() {
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
    printf '%s\t%s\n' "$n" "$i" >>"$folder/power_losses.tsv"
    set -- --resume
  done
  timeout "$kTimeoutSeconds" "$adit" mission --resume --out "$out/out" >>"$out/text" 2>&1
  result=$?
  grep -q "has ended: the robot is at home" "$out/text" && result=0
  record "$n" "$out" "$result"
}

worker() {
  local n
  for ((n = $1; SECONDS < until_s; n += jobs)); do
    RANDOM=$((seed * 1000 + n))
    if (($(wc -l <"$folder/power_losses.tsv") < power_losses && (n % kPowerLossEach == 0 || faults == 0))); then
      run_with_power_losses "$n"
      continue
    fi
    exec 9>"$folder/lock"; flock 9
    select_faults >"$folder/planned/$n"
    flock -u 9
    [[ -s $folder/planned/$n ]] || { rm "$folder/planned/$n"; break; }
    run_with_faults "$n"
  done
}

# From missions.tsv and faults.tsv; losses of a mission count for each stage with a fault in it.
table_of_faults() {
  echo "| stage | fault | faults | missions | returned | maximum distance from the start (m) | local maps lost | 3D scans lost |"
  echo "|---|---|---|---|---|---|---|---|"
  awk -F '\t' '
    FILENAME ~ /missions[.]tsv$/ { result[$1] = $3; distance[$1] = $4; maps[$1] = $6; scans[$1] = $8; next }
    $1 in result {
      ++faults[$2]
      if (counted[$2, $1]++) next
      ++missions[$2]; returned[$2] += result[$1] == 0; lost_maps[$2] += maps[$1]; lost_scans[$2] += scans[$1]
      if (distance[$1] > worst[$2]) worst[$2] = distance[$1]
    }
    END {
      for (pair in faults) {
        split(pair, of, ":")
        printf "| %s | %s | %d | %d | %d | %.2f | %d | %d |\n", of[2], of[1], faults[pair], missions[pair],
          returned[pair], worst[pair], lost_maps[pair], lost_scans[pair]
      }
    }' "$folder/missions.tsv" "$folder/faults.tsv" | sort
}
table_of_missions() {
  echo "| missions | returned | maximum distance from the start (m) | local maps | lost | 3D scans | lost |"
  echo "|---|---|---|---|---|---|---|"
  awk -F '\t' '
    FILENAME ~ /power_losses[.]tsv$/ { ++power_losses[$1]; ++all_power_losses; next }
    {
      kind = $1 in power_losses ? "with " all_power_losses " power losses" : "with faults"
      ++n[kind]; returned[kind] += $3 == 0; maps[kind] += $5; lost_maps[kind] += $6; scans[kind] += $7
      lost_scans[kind] += $8
      if ($4 > worst[kind]) worst[kind] = $4
    }
    END {
      for (kind in n) {
        printf "| %d %s | %d | %.2f | %d | %d | %d | %d |\n", n[kind], kind, returned[kind], worst[kind], maps[kind],
          lost_maps[kind], scans[kind], lost_scans[kind]
      }
    }' "$folder/power_losses.tsv" "$folder/missions.tsv"
}

for ((j = 1; j <= jobs; ++j)); do worker "$j" & done
wait
table_of_faults
echo; table_of_missions
echo; echo "Missions with losses, or without return:"
awk -F '\t' '$3 != 0 || $6 + $8 > 0' "$folder/missions.tsv"
