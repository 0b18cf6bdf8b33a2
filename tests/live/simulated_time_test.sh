#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# simulated_time_test.sh ADIT SIM SCAN_MATCHING MAPPING CHECK_SIMULATED
# The simulator, as fast as possible, waits for the stages, each a separate process: neither the stages, also those
# that depend on others, nor the recorded log lose a message. Prints the real time factor.
set -u
here=$(dirname "$(readlink -f "$0")")

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/in_private_network.sh" "$0" "$@"
fi
adit=$1; sim=$2; scan_matching=$3; mapping=$4; check_simulated=$5
config="$here/../../deploy/config/groundhog.yaml"
kSeconds=25   # simulated

scratch=$(mktemp -d)
processes=()
trap 'kill "${processes[@]}" 2>/dev/null; wait; rm -rf "$scratch"' EXIT

printf '16 0\n24 0\n32 7\n' >"$scratch/waypoints"
"$check_simulated" "$kSeconds" "$scratch/run.lcmlog" & check=$!; processes+=("$check")
"$scan_matching" --sim-time --config "$config" & matcher=$!; processes+=("$matcher")
"$mapping" --sim-time --config "$config" & mapper=$!; processes+=("$mapper")
"$adit" drive --waypoints "$scratch/waypoints" & driver=$!; processes+=("$driver")

start=$(date +%s%N)
"$sim" "$here/bent_tunnel.yaml" --speed max --config "$config" \
  --wait-for scan_matching,mapping,drive,check --record "$scratch/run.lcmlog" --for "$kSeconds" || exit 1
echo "real time factor: 0.1 * $((kSeconds * 10000000000 / ($(date +%s%N) - start)))"
sleep 2   # for messages in transit; no message marks their end

for process in "$driver" "$matcher" "$mapper" "$check"; do
  kill -TERM "$process"
  wait "$process" || { echo "a process failed" >&2; exit 1; }
done
processes=()
