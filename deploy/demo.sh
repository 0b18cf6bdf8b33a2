#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# demo.sh [FOLDER]
# From a fresh clone on Debian 12 to a mission: installs what is missing, builds, sends a robot alone
# into a simulated mine, each stage a process of its own, and draws what it brought back. The results
# are in FOLDER (out/demo).
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
out=$(readlink -m "${1:-$root/out/demo}")

"$root/deploy/install_dependencies.sh" build
cd "$root"
cmake --preset release >/dev/null
cmake --build --preset release

adit=$root/build/release/bin/adit
if [[ -e $out/mission/run.lcmlog ]]; then
  echo "$out/mission is there already; name another folder" >&2
  exit 2
fi
mkdir -p "$out"
"$adit" mission mathies --out "$out/mission"
"$adit" map "$out/mission/run.lcmlog" --out "$out/map"

echo
echo "The results are in $out:"
echo "  mission/run.lcmlog   every message, for adit spy and lcm-logplayer"
echo "  mission/phases.tsv   what the robot was at, and why"
echo "  mission/*.journal    what it would have gone on from: adit mission --resume"
echo "  mission/*.yaml       the mine, and the configuration of all processes"
echo "  map/map.png          the map, with the way of the robot"
echo "  map/map.pgm, .yaml   the same for ROS's map_server"
echo "  map/trajectory.tum   the way of the robot"
echo "  map/summary.json     how far, how long, how fast"
