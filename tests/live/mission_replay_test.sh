#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mission_replay_test.sh ADIT MAPPING
# The log that the simulator records of a mission is sufficient for mapping: played by lcm-logplayer to
# adit-mapping, it gives the pose graph of the mission.
set -eu
here=$(dirname "$(readlink -f "$0")")
adit=$(readlink -f "$1"); mapping=$(readlink -f "$2")
kPathLengthMaxM=24
kSpeed=6         # no message is lost at 75 scans per second times this, also on a loaded machine
kNearM=0.001
kNearRad=0.0001  # rounding errors over the path

"$here/in_private_network.sh" true || exit
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
echo "mission: {limits: {path_length_max_m: $kPathLengthMaxM}}" >"$scratch/config.yaml"
"$adit" mission "$here/bent_tunnel.yaml" --config "$scratch/config.yaml" --out "$scratch/mission" \
  >"$scratch/text" 2>&1 || { cat "$scratch/text" >&2; exit 1; }

mkdir "$scratch/replay"; cd "$scratch/replay"   # for the journal
CHANNELS='^(LASER_FRONT|LASER_REAR|SCAN_MATCH)$' "$here/in_private_network.sh" \
  "$here/record_node.sh" "$scratch/mission/run.lcmlog" "$kSpeed" "$scratch/played.lcmlog" \
  "$mapping" --config "$scratch/mission/mission.yaml"
"$adit" report "$scratch/played.lcmlog" --out "$scratch/played" 2>/dev/null

poses() { grep '^VERTEX_SE2' "$1/graph.g2o"; }
paste <(poses "$scratch/mission") <(poses "$scratch/played") |
  awk -v near_m="$kNearM" -v near_rad="$kNearRad" '
    function distance(a, b) { return a > b ? a - b : b - a }
    $2 != $7 || distance($3, $8) > near_m || distance($4, $9) > near_m || distance($5, $10) > near_rad {
      print "differs: " $0; different = 1
    }
    END { print NR " local maps"; exit different || NR < 3 }'
