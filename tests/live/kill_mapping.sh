#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# kill_mapping.sh LOG SPEED RECORD JOURNAL SEED MAPPING
# Plays LOG to adit-mapping, which keeps JOURNAL, kills it with SIGKILL at random moments, and starts
# it again until the log ends. After every second death some bytes are cut off the journal. To be run
# by in_private_network.sh. Writes to JOURNAL.torn how often that was.
set -u

log=$1; speed=$2; record=$3; journal=$4; RANDOM=$5; mapping=$6
kKills=5
kTruncatedMax=20          # bytes, fewer than any record has
. "$(dirname "$(readlink -f "$0")")/lcm_tools.sh"

size() { stat -c %s "$1" 2>/dev/null || echo 0; }
has_grown() { (( $(size "$journal") > $1 )); }
has_settled() {
  local before; before=$(size "$journal")
  sleep 1
  (( $(size "$journal") == before ))
}

printf 'mapping:\n  journal: %s\n' "$journal" >"$journal.yaml"
start_mapping() { "$mapping" --config "$journal.yaml" & node=$!; }

lcm-logger --quiet --flush-interval=50 "$record" & logger=$!
trap 'kill "$logger" "${node:-$logger}" "${player:-$logger}" 2>/dev/null' EXIT
wait_for "lcm-logger" is_listening
# What the mapping makes of it is in the log as well, and is not to be heard from there.
lcm-logplayer --speed="$speed" --regexp="LASER_FRONT|LASER_REAR|SCAN_MATCH" "$log" >/dev/null & player=$!

torn=0
for ((kill = 1; kill <= kKills; ++kill)); do
  at_start=$(size "$journal")
  start_mapping
  wait_for "a local map" has_grown "$at_start"
  sleep "$((RANDOM % 2)).$((RANDOM % 10))$((RANDOM % 10))"
  kill -KILL "$node"; wait "$node" 2>/dev/null
  if ((kill % 2 == 0)); then
    truncate --size=-$((1 + RANDOM % kTruncatedMax)) "$journal"
    torn=$((torn + 1))
  fi
done
echo "$torn" >"$journal.torn"

start_mapping
if ! kill -0 "$player" 2>/dev/null; then echo "the log ended before the last life" >&2; exit 1; fi
wait "$player"
wait_for "the end of the mapping's work" has_settled
kill -TERM "$node"; wait "$node"; node_exit=$?
kill -INT "$logger"; wait "$logger"
trap - EXIT
if ((node_exit != 0)); then echo "the mapping ended with $node_exit" >&2; exit 1; fi
