#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# emulated_mission.sh BUILD OUT [WORLD [PATH_LENGTH_MAX_M [ROBOT]]]
# A mission in real time with the processes of a real robot: supervisor, guard, stages, and drivers of its devices. Behind these
# are emulated devices in the world of a simulator, which has a bus of its own: nothing but the bytes on their lines joins both.
# ROBOT: skid_steered, that of deploy/config/skid_steered.yaml, with a laser by TCP (SCIP), base, tilt servo and IMU on
# pseudo-terminals; two_sicks, that of deploy/config/robot.yaml on a skid-steered base, with two LMS-200 and two servos on
# pseudo-terminals, too; spinning_lidar, that of deploy/config/spinning_lidar.yaml, with a VLP-16 by UDP. The mission starts by order. Prints what the robot says in the end and what is true; exit code 0 if it
# says that it is home and is within 0.5 m.
set -u
here=$(dirname "$(readlink -f "$0")")
root=$(readlink -f "$here/../../..")
kFromStartMaxM=0.5
kDeadlineS=${EMULATED_MISSION_SECONDS:-300}
kSimUrl='udpm://239.255.76.68:7668?ttl=0'

(($# >= 2)) || { echo "usage: emulated_mission.sh BUILD OUT [WORLD [PATH_LENGTH_MAX_M [ROBOT]]]" >&2; exit 2; }
build=$(readlink -f "$1"); mkdir -p "$2"; out=$(readlink -f "$2"); world=${3:-$here/../bent_tunnel.yaml}; path_max_m=${4:-500}
robot=${5:-skid_steered}
case $robot in
  skid_steered) config=$root/deploy/config/skid_steered.yaml; track_m=0.54; sides="front" ;;
  two_sicks) config=$root/deploy/config/robot.yaml; track_m=0.95; sides="front rear" ;;
  spinning_lidar) config=$root/deploy/config/spinning_lidar.yaml; track_m=0.44; sides="" ;;
  *) echo "emulated_mission.sh: unknown robot $robot: skid_steered, two_sicks or spinning_lidar" >&2; exit 2 ;;
esac
if [[ ${IN_PRIVATE_NETWORK:-} != 1 ]]; then
  IN_PRIVATE_NETWORK=1 exec "$here/../in_private_network.sh" "$0" "$build" "$out" "$world" "$path_max_m" "$robot"
fi
export PATH=$build/bin:$root/deploy/bin:$PATH
trap 'kill $(jobs -p) 2>/dev/null; wait' EXIT

fail() { echo "FAILED: $*" >&2; tail -n 20 "$out"/*.text >&2; exit 1; }
await() {  # WHAT SECONDS CONDITION..
  local what=$1 seconds=$2; shift 2
  for ((SECONDS = 0; SECONDS < seconds;)); do "$@" && return; sleep 0.2; done
  fail "$what"
}

# The parameters that devices and stages share. Each revolution of a lidar is simulated with all rings.
shared_configuration() {
  local section edits=()
  if [[ $robot == two_sicks ]]; then
    sed -e "s#/var/lib/adit#$out#" -e "s/\(path_length_max_m:\).*/\1 $path_max_m/" -e "s/steering: four_wheel/steering: skid/" \
      -e '/^supervisor:/,$d' "$config"
    return
  fi
  for section in scan_assembly mission exploration mapping volume_map; do
    if grep -q "^$section:" "$config"; then edits+=(-e "/^$section:/a\\  journal: $out/$section.journal")
    else echo "$section: {journal: $out/$section.journal}"; fi
  done
  sed "${edits[@]}" -e "/^mission:/a\\  start: on_order" -e "s/^  limits:/&\n    path_length_max_m: $path_max_m/" \
    -e "s/lidar: {rings: 16, /&decimation: 1, /" "$config"
  echo "guard: {require_supervisor: true}"
}

configuration() {
  local side
  shared_configuration
  [[ $robot == spinning_lidar ]] && echo 'velodyne_front: {device: "udp://127.0.0.1:2368", decimation: 4}'
  for side in $sides; do
    if [[ $robot == skid_steered ]]; then
      echo "scip_$side: {device: \"$(cat "$out/laser_$side")\"}"
    else
      echo "sick_lms2xx_$side: {device: $out/laser_$side, baud: 500000, field_of_view_deg: 180, angle_step_deg: 0.5}"
    fi
    echo "tilt_$side: {device: $out/servo_$side, angle_min_rad: -0.6, angle_max_rad: 1.0, rate_max_rad_s: 2, acceleration_rad_s2: 10}"
  done
  cat <<YAML
base_serial: {device: $out/base, ticks_per_m: 5000, track_width_m: $track_m, wheel_speed_max_m_s: 1}
imu_vectornav: {device: $out/imu, roll_deg: 180}
supervisor: {processes: $out/robot.cfg, deputy_id: robot, start_script: start_all, socket: $out/supervisor.sock, log_dir: $out/log}
YAML
}

# The list of the robot with its drivers, and without a guard, which is a service of its own.
processes() {
  local driver drivers=("base_serial:VEHICLE_STATE" "imu_vectornav:IMU") laser=sick_lms2xx side
  [[ $robot == skid_steered ]] && laser=scip
  [[ $robot == spinning_lidar ]] && drivers+=("velodyne front:LASER_FRONT")
  for side in $sides; do drivers+=("$laser $side:LASER_${side^^}" "tilt $side:TILT_${side^^}"); done
  echo 'group "drivers" {'
  for driver in "${drivers[@]}"; do
    echo "  cmd \"$(tr ' ' '_' <<<"${driver%:*}")\" { exec = \"adit-${driver%:*}\"; auto_respawn = \"true\"; stop_signal = 15;"
    echo "    stop_time_allowed = 2; alive_channel = \"${driver#*:}\"; alive_rate_hz = 15; start_timeout_s = 60; }"
  done
  echo '}'
  sed -e '/^group "drivers"/,/^}/d' -e "s#/var/lib/adit/log#$out/log#" "$root/deploy/processes/robot.cfg"
}

# The order to resume changes nothing; its answer is the reason of the present phase.
says_home() { said=$(adit order resume --timeout-s 0.5 2>&1 | tail -n 1); [[ $said == *"the robot is at home"* ]]; }

rm -f "$out"/{ready,*.journal}; mkdir -p "$out/log"
shared_configuration >"$out/sim.yaml"
emulated_robot=$build/tests/emulated_robot
"$emulated_robot" "$kSimUrl" "$out" "$robot" >"$out/emulated.text" 2>&1 & emulated=$!
adit-sim "$world" --config "$out/sim.yaml" --lcm-url "$kSimUrl" >"$out/sim.text" 2>&1 &
await "the emulated devices do not start" 30 test -s "$out/ready"
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
