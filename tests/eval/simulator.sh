#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# simulator.sh [--update]
# Builds optimised (preset ci) and prints the figures of docs/results/simulator.md: how good maps of drives
# through simulated mines are, and how fast the simulator is; --update puts them into the page, behind its
# last heading. To be run while the machine has nothing else to do; takes some twenty minutes.
set -euo pipefail
root=$(dirname "$(dirname "$(dirname "$(readlink -f "$0")")")")
page=$root/docs/results/simulator.md
. "$root/tests/eval/page.sh"

update=
[[ ${1:-} == --update ]] && update=yes
cd "$root"
cmake --preset check >/dev/null
cmake --build --preset check --target mines_table bench_sim >&2

drives() {
  for world in straight mathies bruceton; do
    echo "$world" "sim/worlds/${world}_drive.txt"
  done
}

benchmarks() {
  echo
  echo '```'
  build/release/tests/bench_sim 2>/dev/null
  echo '```'
}

# shellcheck disable=SC2046 # words on purpose
figures=$(conditions "$page" 1; build/release/tests/mines_table $(drives); benchmarks)
if [[ $update ]]; then put "$page" "$figures"; else echo "$figures"; fi
