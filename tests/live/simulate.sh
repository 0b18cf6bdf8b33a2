#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# simulate.sh RECORD ADIT SIM SCAN_MATCHING WORLD SECONDS
# Drives through WORLD as fast as adit-scan_matching and the driver keep up, each a process of its
# own, and records everything by lcm-logger. To be run by in_private_network.sh. Says how many times
# real time that was.
set -u

record=$1; adit=$2; sim=$3; scan_matching=$4; world=$5; seconds=$6
kPort=":1DF3 "       # 7667, LCM's, as /proc/net/udp writes it
kDeadlineSeconds=60

for tool in lcm-logger ip; do
  if ! command -v "$tool" >/dev/null; then
    echo "skipped: no $tool, try: apt install liblcm-bin iproute2" >&2
    exit 77
  fi
done

# wait_for WHAT COMMAND..: until the command succeeds.
wait_for() {
  local what=$1 end=$((SECONDS + kDeadlineSeconds)); shift
  until "$@"; do
    if ((SECONDS > end)); then echo "waited in vain for $what" >&2; exit 1; fi
    sleep 0.05
  done
}

is_listening() { grep -q "$kPort" /proc/net/udp; }
size() { stat -c %s "$record"; }
has_settled() {   # without a simulator there is no time, and so no heartbeat
  local before; before=$(size)
  sleep 1
  (( $(size) == before ))
}

printf '16 0\n24 0\n32 7\n' >"$record.waypoints"
lcm-logger --quiet --flush-interval=50 "$record" & logger=$!
trap 'kill "$logger" "${stage:-$logger}" "${driver:-$logger}" 2>/dev/null' EXIT
wait_for "lcm-logger" is_listening

"$scan_matching" --sim-time & stage=$!
"$adit" drive --waypoints "$record.waypoints" & driver=$!
start=$(date +%s%N)
"$sim" "$world" --speed max --wait-for scan_matching,drive --for "$seconds" || exit 1
echo "$(( seconds * 10000000000 / ($(date +%s%N) - start) )) tenths of times real time"
wait_for "the end of the record" has_settled

kill -TERM "$stage" "$driver"
wait "$stage"; stage_exit=$?
wait "$driver"; driver_exit=$?
kill -INT "$logger"; wait "$logger"
trap - EXIT
if ((stage_exit + driver_exit != 0)); then echo "stage or driver failed" >&2; exit 1; fi
