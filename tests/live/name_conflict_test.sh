#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# name_conflict_test.sh SUPERVISOR ADIT
# Supervisors with one name on one network: a second one exits with 2, one line and no process; of two that start
# together one remains; after the first was killed another starts.
set -u
here=$(dirname "$(readlink -f "$0")")

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/in_private_network.sh" "$0" "$@"
fi
supervisor=$1; adit=$2
scratch=$(mktemp -d)
trap 'kill -KILL $(jobs -p) 2>/dev/null; rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $*" >&2; cat "$scratch"/*.err >&2; exit 1; }

cat > "$scratch/list.cfg" <<EOF
cmd "task" { exec = "sh -c 'echo x >> $scratch/starts; exec sleep 100'"; }
script "go" { start cmd "task" wait "running"; }
EOF
for n in 1 2 3 4 5; do
  cat > "$scratch/$n.yaml" <<EOF
supervisor: {processes: $scratch/list.cfg, deputy_id: robot, start_script: go, socket: $scratch/$n.sock}
EOF
done
start() { "$supervisor" --config "$scratch/$1.yaml" 2>>"$scratch/$1.err" & pid=$!; }
runs() { "$adit" ps --socket "$scratch/$1.sock" 2>/dev/null | grep -q 'task.*running'; }
await_running() {
  for _ in $(seq 1500); do runs "$1" && return; sleep 0.02; done
  fail "supervisor $1 does not run its process"
}

start 1; first=$pid
await_running 1
start 2
wait "$pid"; [[ $? == 2 ]] || fail "the second supervisor did not exit with 2"
[[ $(grep -c . "$scratch/2.err") == 1 ]] || fail "not one line"
grep -q "another supervisor named 'robot' runs on this network" "$scratch/2.err" || fail "other reason"
runs 1 || fail "the first supervisor was disturbed"
[[ $(grep -c x "$scratch/starts") == 1 ]] || fail "the process was started twice"

kill -KILL "$first"; wait "$first" 2>/dev/null
start 3; third=$pid
await_running 3
kill -TERM "$third"; wait "$third" || fail "exited with $?"

: > "$scratch/starts"
start 4; fourth=$pid
start 5; fifth=$pid
wait -n "$fourth" "$fifth"; [[ $? == 2 ]] || fail "neither of two ended"
if kill -0 "$fourth" 2>/dev/null; then await_running 4; else await_running 5; fi
[[ $(grep -c x "$scratch/starts") == 1 ]] || fail "the process was started twice"
