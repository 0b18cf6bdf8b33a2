#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# guard_test.sh SIM GUARD LOCALIZATION DRIVER CHECK_STANDSTILL
# The driver, then the guard, is suspended or killed, each a separate process: the vehicle stops within 300 ms
# of simulated time after the last command of the driver, or order of the guard, has expired.
set -u
here=$(dirname "$(readlink -f "$0")")

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/in_private_network.sh" "$0" "$@"
fi
sim=$1; guard=$2; localization=$3; driver=$4; check_standstill=$5
config="$here/../../deploy/config/groundhog.yaml"
kMetresPerSecond=0.15   # Groundhog's
kCommandExpiry=0.25     # timeout of a command [s]
kOrderExpiry=0.5        # timeout of an order of the guard [s]

scratch=$(mktemp -d)
processes=()
trap 'kill -KILL "${processes[@]}" 2>/dev/null; wait; rm -rf "$scratch"' EXIT

# run_with_fault KIND PROCESS CHANNEL EXPIRY
run_with_fault() {
  "$guard" --sim-time --config "$config" & processes+=($!)
  "$localization" & processes+=($!)
  "$driver" "$kMetresPerSecond" & processes+=($!)
  "$sim" "$here/bent_tunnel.yaml" --speed 3 --config "$config" --fault "$1:$2@3" --for 6 \
    --wait-for guard,truth_as_pose,constant_drive --record "$scratch/run.lcmlog" || return 1
  kill -KILL "${processes[@]}" 2>/dev/null; wait "${processes[@]}" 2>/dev/null
  processes=()
  "$check_standstill" "$scratch/run.lcmlog" "$3" "$4"
}

failed=0
for kind in suspend kill; do
  run_with_fault "$kind" constant_drive DRIVE_COMMAND "$kCommandExpiry" || failed=1
  run_with_fault "$kind" guard STOP "$kOrderExpiry" || failed=1
done
exit $failed
