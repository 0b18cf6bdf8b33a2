#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# demo.sh [FOLDER]
# From a fresh clone on Debian 12 to a mission: installs missing packages, builds, runs an autonomous mission
# in a simulated mine, each stage a process of its own, and lists the results in FOLDER (out/demo).
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
out=$(readlink -m "${1:-$root/out/demo}")

"$root/deploy/install_dependencies.sh" build
cd "$root"
cmake --preset release >/dev/null
cmake --build --preset release

adit=$root/build/release/bin/adit
if [[ -e $out/run.lcmlog ]]; then
  echo "$out exists already; name another folder" >&2
  exit 2
fi
echo "The robot can be watched while it drives: open the address of the live view in a browser."
"$adit" mission mathies --out "$out"

cat <<EOF

The results are in $out:
  mission.html                 the mission in one page, opens in any browser: map, 3D, time, plots, cards of scans
  map.png, map.svg             map with the path of the robot
  map.pgm, map.yaml            the same for Nav2's map_server
  cloud.ply, volume.bt         points of all 3D scans; OctoMap of the mine
  trajectory.tum, graph.g2o    path of the robot; pose graph
  junctions.geojson            corridors, junctions, frontiers
  summary.json                 figures of the mission
  phases.tsv                   phases of the mission, with reasons
  run.lcmlog                   every message, for adit view, adit spy and lcm-logplayer
  viewer.log                   output of adit-viewer
  *.journal                    state for adit mission --resume
  *.yaml, processes.cfg        the mine, and the configuration of all processes
EOF
