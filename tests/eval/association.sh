#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# association.sh [--update] [LIMIT_S]
# Builds optimised (preset ci) and prints the figures of docs/results/association.md; --update puts
# them into the page, behind its last heading. Each row of the second table has LIMIT_S seconds (300).
# To be run while the machine has nothing else to do.
set -euo pipefail
root=$(dirname "$(dirname "$(dirname "$(readlink -f "$0")")")")
page=$root/docs/results/association.md
kHeading='## Figures'
kMethods=('least squares' 'Huber' 'DCS' 'lazy' "lazy, paper's order")

row() {  # GRAPH COUNT KIND METHOD
  local of=(--graphs "$1" --counts "$2" --kinds "$3" --only "$4") kind='at random' status=0
  timeout "$limit" build/release/tests/wrong_loops_table --no-head "${of[@]}" || status=$?
  ((status == 124)) || return "$status"
  [[ $3 != groups ]] || kind='in groups'
  echo "| $1 | $2, $kind | $4 | – | – | – | – | > $limit |"
}

wrong_loops() {
  build/release/tests/wrong_loops_table --graphs intel --counts 0 --only none  # the head alone
  for graph in intel manhattan; do
    for count in 0 10 100 1000; do
      for kind in random groups; do
        ((count)) || [[ $kind == random ]] || continue
        for method in "${kMethods[@]}"; do row "$graph" "$count" "$kind" "$method"; done
      done
    done
  done
}

figures() {
  local changes=
  git diff --quiet HEAD -- . ":!$page" || changes=', with changes'
  echo "$(date +%F), commit $(git rev-parse --short HEAD)$changes, default configuration, $(nproc) cores of" \
    "$(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -1)," \
    "load before $(cut -d' ' -f1 /proc/loadavg), one run."
  echo
  echo '### Loops of place recognition'
  echo
  build/release/tests/bicocca_table
  echo
  echo '### Wrong loops that were added'
  echo
  wrong_loops
}

update=
[[ ${1:-} == --update ]] && { update=yes; shift; }
limit=${1:-300}
cd "$root"
cmake --preset check >/dev/null
cmake --build --preset check -j2 --target bicocca_table wrong_loops_table >&2
if [[ $update ]]; then
  new=$(sed "/^$kHeading/q" "$page"; echo; figures)
  echo "$new" >"$page"
else
  figures
fi
