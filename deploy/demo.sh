#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# demo.sh [FOLDER]
# From a fresh clone on Debian 12 to a map: installs what is missing, builds, lets a robot drive
# through a made-up mine and maps what its laser saw. The results are in FOLDER (out/demo).
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
out=$(readlink -m "${1:-$root/out/demo}")

"$root/deploy/install_dependencies.sh" build
cd "$root"
cmake --preset release >/dev/null
cmake --build --preset release

adit=$root/build/release/bin/adit
mkdir -p "$out"
"$adit" sample "$out/mine.lcmlog" --truth "$out/mine.tum"
"$adit" map "$out/mine.lcmlog" --out "$out"

echo
echo "The results are in $out:"
echo "  map.png         the map, with the way of the robot"
echo "  map.pgm, .yaml  the same for ROS's map_server"
echo "  trajectory.tum  the way of the robot; mine.tum is the true one"
echo "  odometry.tum    the same before loops were closed"
echo "  graph.g2o, associations.tsv   how the map holds together, and why"
echo "  map.journal     for adit map --resume"
echo "  run.lcmlog      every message, for adit spy and lcm-logplayer"
echo "  summary.json    how far, how long, how fast"
