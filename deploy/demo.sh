#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# demo.sh [FOLDER]
# From a fresh clone on Debian 12 to a mission: installs what is missing, builds, sends a robot alone
# into a simulated mine, each stage a process of its own, and shows what it brought back. The results
# are in FOLDER (out/demo).
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
out=$(readlink -m "${1:-$root/out/demo}")

"$root/deploy/install_dependencies.sh" build
cd "$root"
cmake --preset release >/dev/null
cmake --build --preset release

adit=$root/build/release/bin/adit
if [[ -e $out/run.lcmlog ]]; then
  echo "$out is there already; name another folder" >&2
  exit 2
fi
"$adit" mission mathies --out "$out"

echo
echo "The results are in $out:"
echo "  mission.html                 how it went: one page to read"
echo "  map.png, map.svg             the map, with the way of the robot"
echo "  map.pgm, map.yaml            the same for ROS's map_server"
echo "  cloud.ply, volume.bt         the points of all 3D scans; the mine as a volume"
echo "  trajectory.tum, graph.g2o    the way of the robot; the pose graph"
echo "  junctions.geojson            corridors, junctions, openings"
echo "  summary.json                 how far, how long, how fast"
echo "  run.lcmlog                   every message, for adit spy and lcm-logplayer"
echo "  phases.tsv                   what the robot was at, and why"
echo "  *.journal                    what it would have gone on from: adit mission --resume"
echo "  *.yaml, processes.cfg        the mine, and the configuration of all processes"
