#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# two_computers.sh is no test but what tests with two computers begin with, within a private network:
# `robot` is the namespace of the test itself, `sensors` another, with a cable between them. A list in
# $scratch/list.cfg is what the supervisors of both read, of which robot's is in charge. Processes of the
# test sleep for $sleep_s, by which they are told from all others. Wants $supervisor.
export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=1'   # 0 would not leave the computer
scratch=$(mktemp -d)
sleep_s="1000.$$"
trap 'kill -KILL $(jobs -p) 2>/dev/null; rm -rf "$scratch"' EXIT

fail() { echo "FAILED: $*" >&2; cat "$scratch"/*.err >&2; exit 1; }
skip() { echo "skipped: $*" >&2; exit 77; }

unshare -n sleep 120 & other=$!
until [[ $(readlink "/proc/$other/ns/net") != $(readlink /proc/self/ns/net) ]]; do sleep 0.01; done
ip route del 224.0.0.0/4 dev lo
ip link add cable0 type veth peer name cable1 && ip link set cable1 netns "$other" &&
  ip addr add 10.9.0.1/24 dev cable0 && ip link set cable0 up && ip route add 224.0.0.0/4 dev cable0 &&
  nsenter -t "$other" -n bash -c 'ip link set lo up && ip addr add 10.9.0.2/24 dev cable1 &&
    ip link set cable1 up && ip route add 224.0.0.0/4 dev cable1' || skip "no veth between namespaces"

cat > "$scratch/robot.yaml" <<EOF
supervisor: {processes: $scratch/list.cfg, deputy_id: robot, start_script: go, socket: $scratch/robot.sock}
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
how_many_sleep() {
  local n=0 words file
  for file in /proc/[0-9]*/cmdline; do
    words=()
    mapfile -d '' words 2>/dev/null <"$file"
    [[ ${words[*]} == "sleep $sleep_s" ]] && n=$((n + 1))
  done 2>/dev/null
  echo "$n"
}
await_sleepers() {
  for _ in $(seq 500); do [[ $(how_many_sleep) == "$1" ]] && return; sleep 0.02; done
  fail "$(how_many_sleep) processes sleep, not $1"
}
# What a supervisor says of a message may come later than what it does.
await_output() {
  for _ in $(seq 500); do grep -q "$2" "$1" && return; sleep 0.02; done
  fail "no word of: $2"
}
