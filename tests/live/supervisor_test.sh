#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# supervisor_test.sh SUPERVISOR ADIT SHERIFF
# Two supervisors on two computers, one of them in charge, and a sheriff that sends procman's messages: processes
# start over the network, foreign orders are rejected, and a supervisor that is killed leaves no orphans and
# recovers after its restart. The computers are network namespaces with a link between them.
set -u
here=$(dirname "$(readlink -f "$0")")

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/in_private_network.sh" "$0" "$@"
fi
supervisor=$1; adit=$2; sheriff=$3
. "$here/two_computers.sh"

cat > "$scratch/list.cfg" <<EOF
group "sensing" { cmd "near" { exec = "sleep $sleep_s"; deputy = "robot"; } }
cmd "far" { exec = "sh -c 'echo hello from far; sleep $sleep_s & setsid sleep $sleep_s'";
            deputy = "sensors"; depends_on = "near"; stop_time_allowed = 1; }
script "start_all" { start cmd "near" wait "running"; start cmd "far" wait "running" timeout_s 20; }
EOF

start_robot
start_sensors

# The start script of the computer in charge starts processes on both computers.
"$sheriff" await robot near running >/dev/null || fail "process on the computer in charge"
near=$("$sheriff" await robot near running)
[[ $(ls "/proc/$near/fd" | wc -l) == 3 ]] || fail "near inherits file descriptors, such as LCM's sockets"
far=$("$sheriff" await sensors far running) || fail "process on the other computer"
"$sheriff" output sensors far "hello from far" & output=$!
await_sleepers 3

# Orders of other sheriffs, and processes that are not in the list, are rejected.
"$sheriff" order sensors foreign far "" 99 stop
"$sheriff" order robot robot near "" 99 stop
"$sheriff" order sensors robot far "sh -c 'sleep $sleep_s'" 99 start
"$sheriff" order sensors robot evil "sleep $sleep_s" 1 start
[[ $("$sheriff" await sensors far running) == "$far" ]] || fail "far was stopped by a foreign sheriff"
await_sleepers 3
for reason in "foreign sheriff" "another command line" "not in the list"; do
  await_output "$scratch/sensors.err" "PM_ORDERS re.*ed.*$reason"
done
await_output "$scratch/robot.err" "PM_ORDERS re.*ed.*foreign sheriff"   # also not under its own name

# Commands on the computer in charge control both computers.
"$adit" restart far --socket "$scratch/robot.sock" || fail "adit restart"
wait "$output" || fail "PM_OUTPUT"
"$adit" stop far --socket "$scratch/robot.sock" || fail "adit stop"
"$sheriff" await sensors far stopped >/dev/null || fail "far does not stop"
await_sleepers 1
"$adit" start far --socket "$scratch/sensors.sock" || fail "adit start on the other computer"
"$adit" start far --socket "$scratch/robot.sock" || fail "adit start"
"$sheriff" await sensors far running >/dev/null || fail "far does not start"
await_sleepers 3

# A killed supervisor leaves no processes; after its restart, the requested processes run again.
kill -KILL "$sensors"
await_sleepers 1
start_sensors
"$sheriff" await sensors far running >/dev/null || fail "far does not restart"
await_sleepers 3
"$adit" ps --socket "$scratch/robot.sock"
"$adit" logs far --socket "$scratch/sensors.sock" | grep -q "hello from far" || fail "adit logs"

kill -TERM "$robot" "$sensors"
wait "$robot" || fail "the supervisor in charge exited with $?"
wait "$sensors" || fail "the other supervisor exited with $?"
await_sleepers 0
