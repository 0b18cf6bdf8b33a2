#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# memory.sh CARMEN_LOG.gz DIR [PASSES..]
# Prints peak memory, CPU time and the size of summary.json of `adit map` over logs of growing length: each drives CARMEN_LOG (a
# CARMEN log with FLASER lines) forwards and backwards PASSES times (1 2 4 8), and measures each place of it 36 times at 50 Hz, with
# errors of 1 cm. Four passes of the CSAIL log of shared/data have 570,000 scans and 1.1 GB. DIR takes the logs and the maps.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

input=$(realpath "$1")
folder=$(realpath -m "$2")
shift 2
(($#)) || set -- 1 2 4 8
mkdir -p "$folder"

# long_log PASSES: the log on standard output. FLASER n ranges.. x y theta odom_x odom_y odom_theta time host time
long_log() {
  zcat "$input" | awk -v passes="$1" -v copies=36 -v period_s=0.02 -v error_m=0.01 '
    function normal() { return sqrt(-2 * log(1 - rand())) * cos(6.283185307 * rand()) }
    BEGIN { srand(1); for (i = 0; i < 65536; ++i) errors[i] = error_m * normal() }
    $1 == "FLASER" { scans[++count] = $0 }
    END {
      time_s = 1000
      for (pass = 0; pass < 2 * passes; ++pass) {
        for (k = 1; k <= count; ++k) {
          fields = split(scans[pass % 2 ? count + 1 - k : k], field, " ")
          beams = field[2]
          for (copy = 0; copy < copies; ++copy) {
            time_s += period_s
            line = "FLASER " beams
            drawn = int(65536 * rand())
            for (i = 3; i < beams + 3; ++i) {
              range_m = field[i]
              if (range_m < 50) range_m += errors[(drawn + i) % 65536]
              line = line " " sprintf("%.2f", range_m < 0 ? 0 : range_m)
            }
            for (i = beams + 3; i < beams + 9; ++i) line = line " " field[i]
            printf "%s %.6f robot %.6f\n", line, time_s, time_s
          }
        }
      }
    }'
}

build adit
conditions "one run of each log"
echo '| passes | scans | log (MB) | peak memory (MB) | local maps | CPU (s) | CPU for each 1,000 scans (s) | summary.json (kB) |'
echo '|---|---|---|---|---|---|---|---|'
for passes in "$@"; do
  log=$folder/$passes.log
  [[ -s $log ]] || { long_log "$passes" >"$log.part" && mv "$log.part" "$log"; }
  rm -rf "$folder/$passes"
  build/release/bin/adit map "$log" --out "$folder/$passes" >"$folder/$passes.text"
  awk -v passes="$passes" -v log_mb="$(($(stat -c %s "$log") / 1000000))" -v kb="$(($(stat -c %s "$folder/$passes/summary.json") / 1000))" '
    function value() { sub(/,$/, "", $2); return $2 }
    $1 == "\"peak_memory_mb\":" { memory = value() }
    $1 == "\"cpu_s\":" { cpu = value() }
    $1 == "\"local_maps\":" && !maps { maps = value() }
    $1 == "\"total\":" && !scans { scans = value() }
    END { printf "| %d | %d | %d | %.0f | %d | %.0f | %.2f | %d |\n", passes, scans, log_mb, memory, maps, cpu, 1000 * cpu / scans, kb }' "$folder/$passes/summary.json"
done
