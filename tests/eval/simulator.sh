#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# simulator.sh
# Prints the figures of docs/results/simulator.md: the accuracy of maps of drives through simulated mines, and
# the speed of the simulator. Takes about twenty minutes. Run it on an idle computer.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

drives=()
for world in straight mathies bruceton; do
  drives+=("$world" "sim/worlds/${world}_drive.txt")
done
build mines_table bench_sim
conditions 'one run'
"$programs/mines_table" "${drives[@]}"
echo
echo '```'
"$programs/bench_sim" 2>/dev/null
echo '```'
