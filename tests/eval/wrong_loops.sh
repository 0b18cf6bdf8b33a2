#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# wrong_loops.sh [LIMIT_S]
# wrong_loops.sh --cpu [LIMIT_S]
# Prints the figures of docs/results/wrong_loops.md. Each row of the second table has a limit of LIMIT_S
# seconds (300) of CPU time. With --cpu, the table of CPU times only, for two seeds of the wrong loops: lazy data
# association beside the plain optimum and graduated non-convexity, each limited to LIMIT_S (60).
# Run it on an idle computer.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

methods=('least squares' 'Huber' 'DCS' 'GNC' 'lazy' "lazy, paper's order")
limit=${1:-300}
[[ $limit != --cpu ]] || limit=${2:-60}

row() {  # GRAPH COUNT KIND METHOD [SEED]
  local trial=(--graphs "$1" --counts "$2" --kinds "$3" --only "$4" --seed "${5:-1}") kind='at random' status=0
  (
    ulimit -S -t "$limit"
    exec "$programs/wrong_loops_table" --no-head "${trial[@]}"
  ) || status=$?
  ((status == 128 + 24)) || return "$status"  # SIGXCPU
  [[ $3 != groups ]] || kind='in groups'
  echo "| $1 | $2, $kind | $4 | – | – | – | – | > $limit | – | |"
}

heading() { "$programs/wrong_loops_table" --graphs intel --counts 0 --only none; }

added_loops() {
  heading
  for graph in intel manhattan; do
    for count in 0 10 100 1000; do
      for kind in random groups; do
        ((count)) || [[ $kind == random ]] || continue
        for method in "${methods[@]}"; do row "$graph" "$count" "$kind" "$method"; done
      done
    done
  done
}

# "least squares" accepts all loops: its time is that of the plain optimum.
cpu_times() {
  heading
  local trial graph count kind seed
  for trial in manhattan:0:random manhattan:1000:random manhattan:1000:groups intel:1000:random intel:1000:groups \
    M3500a:0:random M3500a:500:random M3500a:1000:random M3500a:500:groups M3500b:0:random M3500b:500:random; do
    IFS=: read -r graph count kind <<<"$trial"
    for seed in 1 2; do
      ((count)) || ((seed == 1)) || continue
      for method in 'least squares' GNC lazy; do row "$graph" "$count" "$kind" "$method" "$seed"; done
    done
  done
  echo
  echo '10,000 poses on a grid, drift 0.0088 (rows of generated_graphs_table):'
  echo
  local share method
  for share in 0 0.3334; do
    for method in lazy gnc; do
      (
        ulimit -S -t "$limit"
        exec "$programs/generated_graphs_table" --first 5 --count 1 --only "$method" --poses 10000 --right 10000 \
          --wrong-share "$share"
      ) || echo "$method: more than $limit s"
    done
  done
}

if [[ ${1:-} == --cpu ]]; then
  build wrong_loops_table generated_graphs_table
  conditions 'one run'
  cpu_times
  exit
fi
build bicocca_table wrong_loops_table
conditions 'one run'
echo '### Loops of place recognition'
echo
"$programs/bicocca_table"
echo
echo '### Added wrong loops'
echo
added_loops
