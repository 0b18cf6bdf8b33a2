#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# drive_test.sh SIM CHECK_STANDSTILL CHECK_ARRIVAL ONE_GOAL STAGE..
# The robot scans, plans and drives at Groundhog's speed, with one process per stage. It arrives without faults,
# and also if planning is killed or suspended while it drives. If driving or scan matching is, the vehicle stops
# within 300 ms of simulated time after their last message has expired. The cases run in parallel on private
# networks.
set -u
here=$(dirname "$(readlink -f "$0")")
kGoalM=3.5
kFaultS=15         # the robot drives from about 10.5 s for 23 s
kStandstillEndS=18
kArrivalEndS=43
kFast=4           # times real time
kMeasured=2       # where times are measured: the simulator must not run ahead of the stages
kAheadMaxS=0.1    # a lead of 0.2 s makes POSE nearly as old as the guard permits, however slow the machine is
kCommandExpiry=0.25
kPoseExpiry=0.25  # timeout of the guard

sim=$1; check_standstill=$2; check_arrival=$3; one_goal=$4; stages=("${@:5}")

# drive LOG CONFIG FACTOR SECONDS [FAULT]: runs in a private network.
drive() {
  local names=one_goal processes=() stage result
  for stage in "${stages[@]}"; do
    "$stage" --sim-time --config "$2" & processes+=($!)
    names+=",${stage##*/adit-}"
  done
  "$one_goal" "$kGoalM" & processes+=($!)
  "$sim" "$here/bent_tunnel.yaml" --config "$2" --speed "$3" --for "$4" --ahead-max-s "$kAheadMaxS" ${5:+--fault "$5"} \
    --wait-for "$names" --record "$1"
  result=$?
  kill -KILL "${processes[@]}" 2>/dev/null; wait "${processes[@]}" 2>/dev/null
  return $result
}

if [[ -n ${ADIT_DRIVE:-} ]]; then
  read -ra drive_arguments <<<"$ADIT_DRIVE"
  drive "${drive_arguments[@]}"
  exit
fi
"$here/in_private_network.sh" true || exit

scratch=$(mktemp -d)
arguments=("$@"); cases=(); names=()
trap 'kill "${cases[@]}" 2>/dev/null; wait; rm -rf "$scratch"' EXIT
{ cat "$here/../../deploy/config/groundhog.yaml"; echo 'driving: {speed: {speed_m_s: 0.15}}'; } \
  >"$scratch/config.yaml"

# begin FACTOR SECONDS FAULT CHECK [ARGUMENT..]: the first argument of the check is the recorded log.
begin() {
  local log="$scratch/${#cases[@]}.lcmlog"
  (ADIT_DRIVE="$log $scratch/config.yaml $1 $2 $3" \
     "$here/in_private_network.sh" "$0" "${arguments[@]}" && "$4" "$log" "${@:5}") \
    >"$log.text" 2>&1 & cases+=($!)
  names+=("${3:-no fault}")
}

begin $kFast $kArrivalEndS "" "$check_arrival"
for fault in kill suspend; do
  begin $kFast $kArrivalEndS "$fault:planning@$kFaultS" "$check_arrival"
  begin $kMeasured $kStandstillEndS "$fault:driving@$kFaultS" "$check_standstill" DRIVE_COMMAND $kCommandExpiry
  begin $kMeasured $kStandstillEndS "$fault:scan_matching@$kFaultS" "$check_standstill" POSE $kPoseExpiry
done

failed=0
for i in "${!cases[@]}"; do
  wait "${cases[i]}" || failed=1
  echo "${names[i]}:"
  cat "$scratch/$i.lcmlog.text"
done
cases=()
exit $failed
