#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# seal_test.sh ADIT MISSION
# A mission process with a key executes the orders of who has the key, not those without it, with another key, or of a
# recording by lcm-logger that lcm-logplayer plays, neither to the process that executed them nor to its successor.
set -u
here=$(dirname "$(readlink -f "$0")")

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/in_private_network.sh" "$0" "$@"
fi
. "$here/lcm_tools.sh"
adit=$1; mission=$2
scratch=$(mktemp -d)
trap 'kill -KILL $(jobs -p) 2>/dev/null; wait; rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
fail() { echo "FAILED: $*" >&2; cat ./*.text >&2; exit 1; }

"$adit" key --new key >/dev/null && "$adit" key --new other >/dev/null || fail "adit key"
cat >robot.yaml <<'YAML'
seal: {key: key}
mission: {start: on_order}
YAML
start_mission() {
  "$mission" --config robot.yaml 2>>mission.text & process=$!
  wait_for "the mission" is_there
}
answer() { "$adit" order resume --timeout-s 1 2>&1; }
is_there() { [[ $(answer) != *"no mission responds"* ]]; }
# What the mission is doing, as an order that it does not execute says it; asked again until it responds, which takes
# longer on a loaded machine.
state() {
  local said
  until said=$(answer); [[ $said != *"no mission responds"* ]]; do :; done
  echo "$said"
}
# executes ORDER SECONDS [OPTION..]
executes() { local order=$1 seconds=$2; shift 2; "$adit" order "$order" --timeout-s "$seconds" "$@" >>orders.text 2>&1; }

lcm-logger --quiet --flush-interval=50 orders.lcmlog & logger=$!
wait_for "lcm-logger" is_listening
start_mission
before=$(state)
executes resume 2 && fail "an order without a seal"
executes resume 2 --key other && fail "an order with another key"
executes resume 20 --key key || fail "no order with the key"
executes pause 20 --key key || fail "no second order with the key"
after=$(state)
[[ $after == *"did not execute"* ]] || fail "the mission is not paused: $after"
kill -INT "$logger"; wait "$logger"

play() { lcm-logplayer --speed=4 --regexp='MISSION_ORDER|SEAL_.*' orders.lcmlog >/dev/null || fail "lcm-logplayer"; }
play
[[ $(state) == "$after" ]] || fail "a recorded order was executed: $(state)"
kill -TERM "$process"; wait "$process"
start_mission
[[ $(state) == "$before" ]] || fail "the new process begins with: $(state)"
play
[[ $(state) == "$before" ]] || fail "the new process executed a recorded order: $(state)"
executes resume 20 --key key || fail "the new process executes no order with the key"
grep -q "without a valid seal were rejected" mission.text || fail "no line about rejected orders"
[[ $(grep -c "without a valid seal were rejected" mission.text) -le 3 ]] || fail "many lines about rejected orders"
