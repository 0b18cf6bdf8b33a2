#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# record_test.sh LIVE_LOGS RECORD
# adit-record, restarted repeatedly as by a supervisor, keeps the recordings of earlier starts while there is
# space, and then deletes the oldest.
set -eu
here=$(dirname "$(readlink -f "$0")")
if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/in_private_network.sh" "$0" "$@"
fi
. "$here/lcm_tools.sh"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $*" >&2; ls -l "$scratch" >&2; exit 1; }

"$1" write "$scratch/played.lcmlog"
# record GB RECORD: records a played log and exits.
record() {
  "$2" "$scratch/logs" "$1" >/dev/null 2>"$scratch/err" & local recorder=$!
  wait_for "the recorder" is_listening
  lcm-logplayer -s 10 "$scratch/played.lcmlog" >/dev/null
  sleep 0.3   # longer than lcm-logger takes to write
  kill -INT "$recorder"; wait "$recorder" || fail "exited with $?: $(cat "$scratch/err")"
}
bytes() { find "$scratch/logs" -type f -printf '%s\n' | awk '{ sum += $1 } END { print sum }'; }
starts() { find "$scratch/logs" -type f -name 'run-*' | sed 's/\.lcmlog.*//' | sort -u | wc -l; }

record 1 "$2"
one=$(bytes)
((one > 10000)) || fail "only $one bytes were recorded"
record 1 "$2"
(($(starts) == 2)) || fail "there are $(starts) recordings, not 2"
(($(bytes) > one * 19 / 10)) || fail "part of the first recording is missing"

# Space for two and a half recordings, half of it for earlier ones: one remains.
gb=$(awk -v one="$one" 'BEGIN { printf "%.9f", one * 2.5e-9 }')
record "$gb" "$2"
(($(starts) == 2)) || fail "there are $(starts) recordings, not 2"
(($(bytes) <= one * 28 / 10)) || fail "$(bytes) bytes remain"   # adit-record writes one file more than the limit
"$2" "$scratch/logs" 2>/dev/null && fail "an invalid command line was accepted"
exit 0
