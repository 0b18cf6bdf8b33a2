#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# guard_test.sh SIM GUARD PLACE DRIVER CHECK_STANDSTILL
# The one who drives is suspended or killed, and so is the guard, each a process of its own: the vehicle
# stands within 300 ms of simulated time after the last command, or order of the guard, has expired.
set -u
here=$(dirname "$(readlink -f "$0")")

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/in_private_network.sh" "$0" "$@"
fi
sim=$1; guard=$2; place=$3; driver=$4; check_standstill=$5
config="$here/../../deploy/config/groundhog.yaml"
kMetresPerSecond=0.15   # Groundhog's
kCommandExpiry=0.25     # of a command, in seconds
kOrderExpiry=0.5        # of the guard's word

scratch=$(mktemp -d)
processes=()
trap 'kill -KILL "${processes[@]}" 2>/dev/null; wait; rm -rf "$scratch"' EXIT

# harm WHAT WHOM CHANNEL EXPIRY
harm() {
  "$guard" --sim-time --config "$config" & processes+=($!)
  "$place" & processes+=($!)
  "$driver" "$kMetresPerSecond" & processes+=($!)
  "$sim" "$here/bent_tunnel.yaml" --speed 3 --config "$config" --fault "$1:$2@3" --for 6 \
    --wait-for guard,truth_as_pose,constant_driver --record "$scratch/run.lcmlog" || return 1
  kill -KILL "${processes[@]}" 2>/dev/null; wait "${processes[@]}" 2>/dev/null
  processes=()
  "$check_standstill" "$scratch/run.lcmlog" "$3" "$4"
}

failed=0
for what in suspend kill; do
  harm "$what" constant_driver DRIVE_COMMAND "$kCommandExpiry" || failed=1
  harm "$what" guard STOP "$kOrderExpiry" || failed=1
done
exit $failed
