#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# viewer_load.sh DIR [RUNS]
# Prints the figures of the viewer under load of docs/results/viewer.md: RUNS (default 3) pairs of missions of processes in mathies at
# eight times real time, without a viewer and with 50 clients of it, five of which stop reading: CPU time of each stage for each
# simulated second, largest memory of adit-viewer. Then a mission at real time with the same clients: time from the arrival of a
# POSE on the network to that of /pose at a client. DIR takes the missions. Needs node and the packages of viewer/page (npm ci).
# A pair takes about two minutes.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

folder=$(realpath -m "$1")
runs=${2:-3}
modules=$root/viewer/page/node_modules
adit=$root/build/release/bin/adit
clients=45
stopped=5
simulated_s=150
mkdir -p "$folder"

build adit
[[ -d $modules/@foxglove/ws-protocol ]] || { echo "viewer_load.sh: run npm ci in viewer/page first" >&2; exit 2; }
trap 'kill $(jobs -p) 2>/dev/null; wait' EXIT

address() {  # TEXT: that of the live view, when it is printed
  for ((i = 0; i < 600; ++i)); do
    grep -o -m 1 'http://127.0.0.1:[0-9]*' "$1" | sed 's/http/ws/' && return
    sleep 0.1
  done
  return 1
}
# sample OUT FILE: CPU ticks and resident kB of each process of the mission, a line NAME TICKS KB each, as long as it runs.
sample() {
  while kill -0 "$mission" 2>/dev/null; do
    for process in /proc/[0-9]*; do
      [[ $(readlink "$process/cwd") == "$1" ]] 2>/dev/null || continue
      awk '{ sub(/.*\(/, ""); name = $0; sub(/\).*/, "", name); sub(/.*\) /, ""); print name, $12 + $13, $22 * 4 }' "$process/stat" 2>/dev/null
    done >"$2.new"
    cat "$2.new" >>"$2"
    sleep 1
  done
}
# process_in OUT NAME: the process of that name in the folder of the mission.
process_in() {
  local pid
  for pid in $(pgrep -x "$2"); do
    [[ $(readlink "/proc/$pid/cwd") == "$1" ]] && echo "$pid" && return
  done
  return 1
}
# begin NAME SPEED SIMULATED_S VIEW_OPTION..: a mission, $mission its process.
begin() {
  local out=$folder/$1 speed=$2 limit_s=$3
  shift 3
  rm -rf "$out"
  mkdir -p "$out"
  "$adit" mission mathies --seed 1 --speed "$speed" --time-max-s "$limit_s" --out "$out" "$@" >"$out.text" 2>&1 &
  mission=$!
}

conditions "$runs pairs of runs"
for ((run = 1; run <= runs; ++run)); do
  begin "without_$run" 8 "$simulated_s" --no-view
  sample "$folder/without_$run" "$folder/without_$run.cpu"
  begin "with_$run" 8 "$simulated_s" --view-port 0
  url=$(address "$folder/with_$run.text")
  node "$root/tests/eval/viewer/clients.mjs" "$modules" "$url" "$clients" "$stopped" >"$folder/with_$run.clients" &
  sample "$folder/with_$run" "$folder/with_$run.cpu"
  echo "run $run of $runs: clients received $(cat "$folder/with_$run.clients")" >&2
done

begin real_time 1 60 --view-port 0
url=$(address "$folder/real_time.text")
node "$root/tests/eval/viewer/clients.mjs" "$modules" "$url" "$clients" "$stopped" >/dev/null &
node "$root/tests/eval/viewer/pose_times.mjs" viewer "$folder/viewer.times" "$modules" "$url" &
until simulator=$(process_in "$folder/real_time" adit-sim); do sleep 0.1; done
namespaces=(-n)  # root needs no user namespace of its own for a private network
[[ $(readlink "/proc/$simulator/ns/user") == "$(readlink /proc/self/ns/user)" ]] || namespaces+=(-U --preserve-credentials)
nsenter -t "$simulator" "${namespaces[@]}" \
  node "$root/tests/eval/viewer/pose_times.mjs" lcm "$folder/lcm.times" &
listener=$!
wait "$mission" || true
kill "$listener" 2>/dev/null || true

# The largest ticks of each process are those at its end.
ticks_s=$(getconf CLK_TCK)
echo '| process | CPU without viewer (s for each simulated s) | with 50 clients | change |'
echo '|---|---|---|---|'
for ((run = 1; run <= runs; ++run)); do
  for mode in without with; do sed "s/^/$mode $run /" "$folder/${mode}_$run.cpu"; done
done | awk -v simulated_s="$((simulated_s * ticks_s * runs))" '
  { key = $1 " " $3; if ($4 > last[key, $2]) { sum[key] += $4 - last[key, $2]; last[key, $2] = $4 } names[$3] }
  $3 == "adit-viewer" && $5 > memory { memory = $5 }
  END {
    for (name in names) {
      before = sum["without " name] / simulated_s
      after = sum["with " name] / simulated_s
      if (before > 0 && name ~ /^adit-/) printf "| %s | %.4f | %.4f | %+.1f %% |\n", name, before, after, 100 * (after / before - 1) | "sort"
    }
    close("sort")
    printf "\nadit-viewer: %.3f s CPU for each simulated s, %.0f MB at most\n", sum["with adit-viewer"] / simulated_s, memory / 1024
  }'
awk 'NR == FNR { arrived[$1] = $2; next } $1 in arrived { print $2 - arrived[$1] }' "$folder/lcm.times" "$folder/viewer.times" |
  sort -n | awk '{ value[NR] = $1 }
    END { printf "latency of /pose: %d poses, median %.1f ms, 95 %% within %.1f ms\n", NR, value[int((NR + 1) / 2)], value[int(0.95 * NR)] }'
