#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# record_node.sh LOG SPEED RECORD NODE [ARGUMENT..]
# Starts NODE, plays LOG to it with lcm-logplayer at SPEED, and records all messages with lcm-logger to RECORD. The
# environment variable CHANNELS (a regular expression) selects the channels to play. Run it by
# in_private_network.sh. Exit code 0 only if the node exits with 0 on SIGTERM.
set -u

log=$1; speed=$2; record=$3; shift 3
. "$(dirname "$(readlink -f "$0")")/lcm_tools.sh"

is_recorded() { grep -aq "$1" "$record" 2>/dev/null; }
size() { stat -c %s "$record"; }

# Only heartbeats for one second: at most 1500 bytes.
has_settled() {
  local before; before=$(size)
  sleep 1
  (( $(size) - before < 1500 ))
}

rm -f "$record"
lcm-logger --quiet --flush-interval=50 "$record" & logger=$!
trap 'kill "$logger" "${node:-$logger}" 2>/dev/null' EXIT
wait_for "lcm-logger" is_listening

"$@" & node=$!
wait_for "the node's first heartbeat" is_recorded HEARTBEAT

lcm-logplayer --speed="$speed" --regexp="${CHANNELS:-.*}" "$log" >/dev/null || exit 1
wait_for "the end of the record" has_settled

kill -TERM "$node"; wait "$node"; node_exit=$?
kill -INT "$logger"; wait "$logger"
trap - EXIT
if ((node_exit != 0)); then echo "the node exited with $node_exit" >&2; exit 1; fi
