#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# two_computers.sh: setup of tests with two computers, to be sourced in a private network. `robot` is the network
# namespace of the test, `sensors` a second one, with a virtual Ethernet link between them. The supervisors of
# both read $scratch/list.cfg; that of robot is in charge. Processes of the test sleep for $sleep_s, which
# identifies them. Requires $supervisor.
export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=1'   # ttl 0 would not leave the computer
scratch=$(mktemp -d)
sleep_s="1000.$$"
trap 'kill -KILL $(jobs -p) 2>/dev/null; rm -rf "$scratch"' EXIT

fail() { echo "FAILED: $*" >&2; cat "$scratch"/*.err >&2; exit 1; }
skip() { echo "skipped: $*" >&2; exit 77; }

unshare -n sleep 120 & other=$!
until [[ $(readlink "/proc/$other/ns/net") != $(readlink /proc/self/ns/net) ]]; do sleep 0.01; done
ip route del 224.0.0.0/4 dev lo
ip link add link0 type veth peer name link1 && ip link set link1 netns "$other" &&
  ip addr add 10.9.0.1/24 dev link0 && ip link set link0 up && ip route add 224.0.0.0/4 dev link0 &&
  nsenter -t "$other" -n bash -c 'ip link set lo up && ip addr add 10.9.0.2/24 dev link1 &&
    ip link set link1 up && ip route add 224.0.0.0/4 dev link1' || skip "no veth between namespaces"

cat > "$scratch/robot.yaml" <<EOF
supervisor: {processes: $scratch/list.cfg, deputy_id: robot, start_script: start_all, socket: $scratch/robot.sock}
EOF
cat > "$scratch/sensors.yaml" <<EOF
supervisor: {processes: $scratch/list.cfg, deputy_id: sensors, role: deputy, in_charge: robot,
             socket: $scratch/sensors.sock}
EOF
start_robot() { "$supervisor" --config "$scratch/robot.yaml" "$@" 2>>"$scratch/robot.err" & robot=$!; }
start_sensors() {
  nsenter -t "$other" -n "$supervisor" --config "$scratch/sensors.yaml" 2>>"$scratch/sensors.err" &
  sensors=$!
}
count_sleepers() {
  local n=0 arguments file
  for file in /proc/[0-9]*/cmdline; do
    arguments=()
    mapfile -d '' arguments 2>/dev/null <"$file"
    [[ ${arguments[*]} == "sleep $sleep_s" ]] && n=$((n + 1))
  done 2>/dev/null
  echo "$n"
}
await_sleepers() {
  for _ in $(seq 1500); do [[ $(count_sleepers) == "$1" ]] && return; sleep 0.02; done
  fail "$(count_sleepers) sleeping processes, expected $1"
}
# The log output of a supervisor can be later than its action.
await_output() {
  for _ in $(seq 1500); do grep -q "$2" "$1" && return; sleep 0.02; done
  fail "missing output: $2"
}
