#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# merge.sh DIR
# Prints the tables of docs/results/merge.md: ten drives of two robots from three portals of one mine (merge/three_portals.yaml),
# mapped by adit map and joined; a fall between drives; ten walks in each of several generated mines; pairs of different mines that
# are alike. DIR takes the drives; those that are there are used again. About 12 minutes of CPU time.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

folder=$(realpath -m "$1")
files=$root/tests/eval/merge
adit=$root/build/release/bin/adit
build adit merge_table
mkdir -p "$folder"

# start PORTAL WORLD_OUT [APPENDIX]: the mine with the robot at a portal.
start() {
  local pose
  case $1 in
    west) pose='x_m: 3, y_m: 0, theta_rad: 0' ;;
    east) pose='x_m: 65.1, y_m: 9.2, theta_rad: 3.41' ;;
    north) pose='x_m: 32.83, y_m: 33, theta_rad: -1.737' ;;
  esac
  sed "s/T_world_start: .*/T_world_start: {$pose}/" "$files/three_portals.yaml" >"$2"
}

# drive NAME PORTAL ROUTE ROBOT [fall]
drive() {
  local run=$folder/$1 world=$folder/$1.yaml config=()
  [ -d "$run" ] && return
  start "$2" "$world"
  [ "${5:-}" = fall ] && cat "$files/fall.yaml" >>"$world"
  [ "$4" = 2 ] && config=(--config "$files/second_robot.yaml")
  "$adit" drive "$world" --waypoints "$files/routes/$3.txt" "${config[@]}" --out "$folder/$1.lcmlog" >"$folder/$1.log" 2>&1
  "$adit" map "$folder/$1.lcmlog" --out "$run" >>"$folder/$1.log" 2>&1
  rm "$folder/$1.lcmlog"
}

drive w1 west w1 1
drive n1 north n1 2
drive e1 east e1 1
drive w2 west w2 2
drive e2 east e2 2
drive n2 north n2 1
drive w3 west w3 1
drive n3 north n3 2
drive w4 west w4 1
drive e3 east e3 2
drive f1 west w2 1 fall
drive f2 north n2 2 fall

runs=()
for name in w1 n1 e1 w2 e2 n2 w3 n3 w4 e3; do runs+=("$folder/$name"); done
conditions "one run each"
"$programs/merge_table" --same "${runs[@]}" || true
"$programs/merge_table" --ahead-ms 28 --same "${runs[@]}" | tail -1 || true
echo
"$adit" merge "${runs[@]}" --out "$folder/merged" 2>/dev/null
"$adit" merge "$folder"/{w1,n1,e1,f1,f2} --out "$folder/fall" 2>/dev/null
cat "$folder/fall/changes.tsv"
echo
"$programs/merge_table" --mines 11 1 || true
"$programs/merge_table" --mines 21 1 || true
"$programs/merge_table" --pairs 11 8 --plans 11 4 || true
"$programs/merge_table" --pairs 21 8 --plans 21 4 || true
"$programs/merge_table" --tunnels 1 4 || true
