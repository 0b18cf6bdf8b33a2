#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# extremes_test.sh SIM SEND_EXTREMES STAGE..
# A mission with one process per stage receives messages of every type in which one field has an extreme value, NaN
# or random bits, one field at a time. No process ends, and all stages continue.
set -u
here=$(dirname "$(readlink -f "$0")")
kListenS=20       # the robot has taken its first 3D scan
kRunS=200         # of simulated time, longer than the messages take
kSpeed=1          # times real time

if [[ -z ${ADIT_EXTREMES:-} ]]; then
  ADIT_EXTREMES=1 exec "$here/in_private_network.sh" "$0" "$@"
fi
sim=$1; send_extremes=$2; stages=("${@:3}")
scratch=$(mktemp -d)
processes=()
trap 'kill -KILL "${processes[@]}" 2>/dev/null; wait 2>/dev/null; rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1

fail() {
  echo "FAILED: $*" >&2
  tail -n 5 "$scratch"/*.text >&2
  exit 1
}

config=$here/../../deploy/config/groundhog.yaml
names=(); wait_for=
for stage in "${stages[@]}"; do
  name=${stage##*/adit-}
  "$stage" --sim-time --config "$config" 2>"$scratch/$name.text" & processes+=($!)
  names+=("$name"); wait_for+="${wait_for:+,}$name"
done
"$sim" "$here/bent_tunnel.yaml" --config "$config" --speed $kSpeed --for $kRunS --wait-for "$wait_for" \
  >"$scratch/sim.text" 2>&1 & processes+=($!)
names+=(sim)

"$send_extremes" $kListenS || fail "the stages do not continue"
for i in "${!processes[@]}"; do
  kill -0 "${processes[i]}" 2>/dev/null || fail "${names[i]} has ended"
done
grep -h "failed" "$scratch"/*.text && fail "a handler has failed"
exit 0
