#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# supervisor_test.sh SUPERVISOR ADIT SHERIFF
# Two supervisors on two computers, of which one is in charge, and a sheriff that speaks procman's
# messages: starts over the network, refuses what is foreign, comes back after a SIGKILL without
# having left an orphan. The computers are network namespaces with a cable between them.
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
script "go" { start cmd "near" wait "running"; start cmd "far" wait "running" timeout_s 20; }
EOF

start_robot
start_sensors

# The script of the one in charge starts what the other is to run.
"$sheriff" await robot near running >/dev/null || fail "the process of the one in charge"
near=$("$sheriff" await robot near running)
[[ $(ls "/proc/$near/fd" | wc -l) == 3 ]] || fail "near has inherited descriptors, as LCM's sockets are"
far=$("$sheriff" await sensors far running) || fail "the process of the other computer"
"$sheriff" output sensors far "hello from far" & listening=$!
await_sleepers 3

# Nobody else is obeyed, and nothing is run that is not in the list.
"$sheriff" order sensors stranger far "" 99 stop
"$sheriff" order robot robot near "" 99 stop
"$sheriff" order sensors robot far "sh -c 'sleep $sleep_s'" 99 start
"$sheriff" order sensors robot evil "sleep $sleep_s" 1 start
[[ $("$sheriff" await sensors far running) == "$far" ]] || fail "far was stopped by a stranger"
await_sleepers 3
for reason in "foreign sheriff" "another command line" "not in the list"; do
  await_output "$scratch/sensors.err" "PM_ORDERS refused.*$reason"
done
await_output "$scratch/robot.err" "PM_ORDERS refused.*foreign sheriff"   # not its own name either

# A terminal of the one in charge is obeyed on both.
"$adit" restart far --socket "$scratch/robot.sock" || fail "adit restart"
wait "$listening" || fail "PM_OUTPUT"
"$adit" stop far --socket "$scratch/robot.sock" || fail "adit stop"
"$sheriff" await sensors far stopped >/dev/null || fail "far does not stop"
await_sleepers 1
"$adit" start far --socket "$scratch/sensors.sock" || fail "adit start on the other computer"
"$adit" start far --socket "$scratch/robot.sock" || fail "adit start"
"$sheriff" await sensors far running >/dev/null || fail "far does not start"
await_sleepers 3

# A supervisor that is killed leaves nobody, and when it is back, what the one in charge wants runs.
kill -KILL "$sensors"
await_sleepers 1
start_sensors
"$sheriff" await sensors far running >/dev/null || fail "far does not come back"
await_sleepers 3
"$adit" ps --socket "$scratch/robot.sock"
"$adit" logs far --socket "$scratch/sensors.sock" | grep -q "hello from far" || fail "adit logs"

kill -TERM "$robot" "$sensors"
wait "$robot" || fail "the one in charge ended with $?"
wait "$sensors" || fail "the other ended with $?"
await_sleepers 0
