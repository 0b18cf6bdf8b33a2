#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# wrong_loops.sh [LIMIT_S]
# Prints the figures of docs/results/wrong_loops.md. Each row of the second table has a time limit of LIMIT_S
# seconds (300). Run it on an idle computer.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

methods=('least squares' 'Huber' 'DCS' 'lazy' "lazy, paper's order")
limit=${1:-300}

row() {  # GRAPH COUNT KIND METHOD
  local trial=(--graphs "$1" --counts "$2" --kinds "$3" --only "$4") kind='at random' status=0
  timeout "$limit" "$programs/wrong_loops_table" --no-head "${trial[@]}" || status=$?
  ((status == 124)) || return "$status"
  [[ $3 != groups ]] || kind='in groups'
  echo "| $1 | $2, $kind | $4 | – | – | – | – | > $limit |"
}

added_loops() {
  "$programs/wrong_loops_table" --graphs intel --counts 0 --only none  # the heading only
  for graph in intel manhattan; do
    for count in 0 10 100 1000; do
      for kind in random groups; do
        ((count)) || [[ $kind == random ]] || continue
        for method in "${methods[@]}"; do row "$graph" "$count" "$kind" "$method"; done
      done
    done
  done
}

build bicocca_table wrong_loops_table
conditions 'one run'
echo '### Loops of place recognition'
echo
"$programs/bicocca_table"
echo
echo '### Added wrong loops'
echo
added_loops
