#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# kill_mapping.sh LOG SPEED RECORD JOURNAL SEED MAPPING
# Plays LOG to adit-mapping, which writes JOURNAL, kills it with SIGKILL at random times, and restarts it until
# the log ends. After every second kill, some bytes are truncated from both copies of the journal; JOURNAL.torn receives the
# number of truncations. Run it by in_private_network.sh.
set -u

log=$1; speed=$2; record=$3; journal=$4; RANDOM=$5; mapping=$6
kKills=5
kTruncatedMax=20          # bytes, fewer than in any record
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
# The log also has the output of mapping, which must not be played.
lcm-logplayer --speed="$speed" --regexp="LASER_FRONT|LASER_REAR|SCAN_MATCH" "$log" >/dev/null & player=$!

torn=0
for ((kill = 1; kill <= kKills; ++kill)); do
  at_start=$(size "$journal")
  start_mapping
  wait_for "a local map" has_grown "$at_start"
  sleep "$((RANDOM % 2)).$((RANDOM % 10))$((RANDOM % 10))"
  kill -KILL "$node"; wait "$node" 2>/dev/null
  if ((kill % 2 == 0)); then
    kept=$(($(size "$journal") - 1 - RANDOM % kTruncatedMax))
    truncate --size="$kept" "$journal" "${journal%.journal}.copy.journal"
    torn=$((torn + 1))
  fi
done
echo "$torn" >"$journal.torn"

start_mapping
if ! kill -0 "$player" 2>/dev/null; then echo "the log ended before the last restart" >&2; exit 1; fi
wait "$player"
wait_for "the end of the mapping work" has_settled
kill -TERM "$node"; wait "$node"; node_exit=$?
kill -INT "$logger"; wait "$logger"
trap - EXIT
if ((node_exit != 0)); then echo "mapping exited with $node_exit" >&2; exit 1; fi
