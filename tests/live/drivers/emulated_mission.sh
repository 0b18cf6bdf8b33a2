#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# emulated_mission.sh BUILD OUT [WORLD [PATH_LENGTH_MAX_M]]
# A mission of the robot of deploy/config/skid_steered.yaml in real time, with the processes of a real one: supervisor, guard,
# stages, and the drivers of its laser (SCIP, TCP), base, tilt servo and IMU (pseudo-terminals). Behind these are emulated devices
# in the world of a simulator, which has a bus of its own: nothing but the bytes on those lines joins both. The mission starts by
# order. Prints what the robot says in the end and what is true; exit code 0 if it says that it is home and is within 0.5 m.
set -u
here=$(dirname "$(readlink -f "$0")")
root=$(readlink -f "$here/../../..")
kFromStartMaxM=0.5
kDeadlineS=${EMULATED_MISSION_SECONDS:-300}
kSimUrl='udpm://239.255.76.68:7668?ttl=0'

(($# >= 2)) || { echo "usage: emulated_mission.sh BUILD OUT [WORLD [PATH_LENGTH_MAX_M]]" >&2; exit 2; }
build=$(readlink -f "$1"); mkdir -p "$2"; out=$(readlink -f "$2"); world=${3:-$here/../bent_tunnel.yaml}; path_max_m=${4:-500}
if [[ ${IN_PRIVATE_NETWORK:-} != 1 ]]; then
  IN_PRIVATE_NETWORK=1 exec "$here/../in_private_network.sh" "$0" "$build" "$out" "$world" "$path_max_m"
fi
export PATH=$build/bin:$root/deploy/bin:$PATH
trap 'kill $(jobs -p) 2>/dev/null; wait' EXIT

fail() { echo "FAILED: $*" >&2; tail -n 20 "$out"/*.text >&2; exit 1; }
await() {  # WHAT SECONDS CONDITION..
  local what=$1 seconds=$2; shift 2
  for ((SECONDS = 0; SECONDS < seconds;)); do "$@" && return; sleep 0.2; done
  fail "$what"
}

configuration() {
  sed -e "/^scan_assembly:/a\\  journal: $out/scans.journal" \
    -e "/^mission:/a\\  journal: $out/mission.journal\n  start: on_order" \
    -e "s/^  limits:/&\n    path_length_max_m: $path_max_m/" "$root/deploy/config/skid_steered.yaml"
  cat <<YAML
mapping: {journal: $out/map.journal}
volume_map: {journal: $out/volume.journal}
exploration: {journal: $out/exploration.journal}
guard: {require_supervisor: true}
scip_front: {device: "$(cat "$out/laser")"}
tilt_front: {device: $out/servo, angle_min_rad: -0.6, angle_max_rad: 1.0, rate_max_rad_s: 2, acceleration_rad_s2: 10}
base_serial: {device: $out/base, ticks_per_m: 5000, track_width_m: 0.54, wheel_speed_max_m_s: 1}
imu_vectornav: {device: $out/imu, roll_deg: 180}
supervisor: {processes: $out/robot.cfg, deputy_id: robot, start_script: start_all, socket: $out/supervisor.sock, log_dir: $out/log}
YAML
}

# The list of the robot with its drivers, and without a guard, which is a service of its own.
processes() {
  local name
  echo 'group "drivers" {'
  for name in "scip front:LASER_FRONT" "tilt front:TILT_FRONT" "base_serial:VEHICLE_STATE" "imu_vectornav:IMU"; do
    echo "  cmd \"${name%%[ :]*}\" { exec = \"adit-${name%:*}\"; auto_respawn = \"true\"; stop_signal = 15; stop_time_allowed = 2;"
    echo "    alive_channel = \"${name#*:}\"; alive_rate_hz = 15; start_timeout_s = 60; }"
  done
  echo '}'
  sed -e '/^group "drivers"/,/^}/d' -e "s#/var/lib/adit/log#$out/log#" "$root/deploy/processes/robot.cfg"
}

# The order to resume changes nothing; its answer is the reason of the present phase.
says_home() { said=$(adit order resume --timeout-s 0.5 2>&1 | tail -n 1); [[ $said == *"the robot is at home"* ]]; }

rm -f "$out"/{laser,*.journal}; mkdir -p "$out/log"
emulated_robot=$build/tests/emulated_robot
"$emulated_robot" "$kSimUrl" "$out" >"$out/emulated.text" 2>&1 & emulated=$!
adit-sim "$world" --config "$root/deploy/config/skid_steered.yaml" --lcm-url "$kSimUrl" >"$out/sim.text" 2>&1 &
await "the emulated devices do not start" 30 test -s "$out/laser"
configuration >"$out/robot.yaml"
processes >"$out/robot.cfg"
adit-guard --config "$out/robot.yaml" >"$out/guard.text" 2>&1 &
adit-supervisor --config "$out/robot.yaml" >"$out/supervisor.text" 2>&1 & supervisor=$!
adit order resume --timeout-s 60 >"$out/order.text" 2>&1 || fail "the mission does not start"
await "the robot does not say in $kDeadlineS s that it is home" "$kDeadlineS" says_home
adit ps --socket "$out/supervisor.sock" >"$out/ps.text"
kill "$supervisor"; wait "$supervisor"
kill "$emulated"; wait "$emulated"
cat "$out/emulated.text"
echo "$said"
from_start_m=$(awk '/from the start by the truth/ { print $1 }' "$out/emulated.text")
awk -v m="$from_start_m" -v max="$kFromStartMaxM" 'BEGIN { exit !(m != "" && m <= max) }' || fail "$from_start_m m from the start"
