#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mission_soak.sh ADIT SIMULATED_HOURS [WORLD [OPTION..]]
# Run by hand, not in CI; eight simulated hours take one or two hours. One mission with one set of processes explores
# the mine and then patrols it until its time limit. For each half hour of simulated time, prints a row with the
# memory of each process (`adit ps`, MB), averaged because it varies by a tenth with the current work; at the end,
# the growth over the last three quarters of the time. Exit code 1 if a process grew by more than 5 %, the mission
# ended early, or a process was restarted. OPTIONs are the world options of `adit mission`.
set -u
adit=$(readlink -f "$1"); world=${3:-random_level}
requested_s=$(awk -v hours="$2" 'BEGIN { print int(3600 * hours) }')
if (($# > 3)); then options=("${@:4}"); else options=(); fi
[[ $world == random_level && ${#options[@]} -eq 0 ]] && options=(--seed 7 --length-m 60)
kRowSeconds=1800     # simulated time
kSettledShare=0.25   # share of the time in which memory may grow, for caches and the map
kGrowthMax=5         # percent
kPollSeconds=2

# Only the time limit ends the patrol; the map stores at most three local maps and one 3D scan per place.
config() {
  cat <<YAML
mapping: {maps_per_place_max: 3}
volume_map: {replace_radius_m: 4}
exploration: {patrol: true}
mission:
  limits: {time_max_s: $requested_s, path_length_max_m: 1000000}
sim: {motion: {battery_wh: 1000000}}
YAML
}

scratch=$(mktemp -d)
mission=
trap 'kill -TERM $mission 2>/dev/null; wait; rm -rf "$scratch"' EXIT
out=$scratch/mission
config >"$scratch/soak.yaml"

megabytes() { if [[ -e $1 ]]; then stat -c %s "$1" | awk '{ printf "%.1f", $1 / 1e6 }'; else echo 0; fi; }
# Simulated time [s], path length [m], local maps, 3D scans, real time factor: from the newest progress line.
progress() {
  tail -n 1 "$scratch/text" 2>/dev/null |
    awk '/real time/ { for (i = 2; i <= NF; ++i) {
           if ($i == "driven,") path = $(i - 2); if ($i == "local") maps = $(i - 1)
           if ($i == "scans,") scans = $(i - 1); if ($i == "x") speed = $(i - 1) }
         print $1, path, maps, scans, speed }'
}
# Name and memory of each running process.
sample() {
  "$adit" ps --socket "$out/supervisor.sock" 2>/dev/null | awk 'NR > 1 && $7 > 0 { print $1, $7 }' >>"$scratch/samples"
}
# Mean memory of each process since the last call, in list order.
means() {
  awk '{ if (!($1 in n)) name[++names] = $1; sum[$1] += $2; ++n[$1] }
       END { for (i = 1; i <= names; ++i) printf "%s %.1f\n", name[i], sum[name[i]] / n[name[i]] }' "$scratch/samples"
  rm "$scratch/samples"
}

row() {
  local memory=$1; shift
  echo "$1 $(awk '{ printf "%s ", $2 }' <<<"$memory")" >>"$scratch/memory"
  if [[ ! -e $scratch/names ]]; then
    awk '{ print $1 }' <<<"$memory" >"$scratch/names"
    echo "| simulated (h) | path length (m) | local maps | 3D scans | real time factor | $(
      paste -sd '|' "$scratch/names" | sed 's/|/ | /g') | mapping.journal | volume.journal | run.lcmlog |"
    awk -v n="$(wc -l <"$scratch/names")" 'BEGIN { for (i = 0; i < n + 8; ++i) printf "|---"; print "|" }'
  fi
  awk -v s="$1" -v path="$2" -v maps="$3" -v scans="$4" -v speed="$5" -v memory="$(
    awk '{ printf "%s | ", $2 }' <<<"$memory")" -v disk="$(megabytes "$out/mapping.journal") | $(
    megabytes "$out/volume_map.journal") | $(megabytes "$out/run.lcmlog")" \
    'BEGIN { printf "| %.2f | %s | %s | %s | %s | %s%s |\n", s / 3600, path, maps, scans, speed, memory, disk }'
}

# Growth of each process from the first settled row to the last, against the limit.
verdict() {
  awk -v share="$kSettledShare" -v max="$kGrowthMax" '
    FNR == NR { name[++n] = $1; next }
    { time[++rows] = $1; for (i = 1; i <= n; ++i) memory[rows, i] = $(i + 1) }
    END {
      for (first = 1; first < rows && time[first] < share * time[rows]; ++first) {}
      printf "\nFrom %.2f h to %.2f h:\n\n| process | MB | MB | growth (%%) | |\n|---|---|---|---|---|\n",
             time[first] / 3600, time[rows] / 3600
      for (i = 1; i <= n; ++i) {
        growth = 100 * (memory[rows, i] / memory[first, i] - 1)
        printf "| %s | %.1f | %.1f | %.1f | %s |\n", name[i], memory[first, i], memory[rows, i], growth,
               (growth > max) ? "too much" : "ok"
        bad += (growth > max)
      }
      exit bad > 0
    }' "$scratch/names" "$scratch/memory"
}

"$adit" mission "$world" "${options[@]}" --config "$scratch/soak.yaml" --out "$out" \
  --time-max-s "$((requested_s + 1800))" >"$scratch/text" 2>&1 & mission=$!
next=$kRowSeconds; last=0
while kill -0 "$mission" 2>/dev/null; do
  read -r seconds path maps scans speed <<<"$(progress)"
  [[ -n ${seconds:-} ]] && last=$seconds
  sample
  if ((last >= next)) && [[ -s $scratch/samples ]]; then
    row "$(means)" "$seconds" "$path" "$maps" "$scans" "$speed"
    next=$((next + kRowSeconds))
  fi
  # Do not wait for the report, which is not measured here.
  ((last >= requested_s - kRowSeconds / 2)) && grep -q "at home" "$scratch/text" && break
  sleep "$kPollSeconds"
done
echo; grep -B 1 "from the start at the end" "$scratch/text" || tail -n 3 "$scratch/text"
[[ -e $scratch/memory ]] || { echo "the mission ended after $last s, before the first row"; exit 1; }
verdict; result=$?
((10 * last >= 9 * requested_s)) || { echo "the mission ended early"; exit 1; }
if grep "restarting" "$scratch/text"; then exit 1; fi
exit $result
