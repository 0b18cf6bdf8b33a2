#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mission_test.sh ADIT CASE [CHECK_LOSSES]
# A short mission, each stage a process, ends at home: `home`, where all is well; `harmed`, where one
# process is killed and others stand still, one of them while a 3D scan comes for it; `cut`, where
# everything is killed at once and started again; `lossy`, where a twentieth of what the drivers say is
# lost, and of all that comes to each process; `ordered`, where a person says when to come home. Nothing is
# left running.
set -u
here=$(dirname "$(readlink -f "$0")")
adit=$1; case=$2; check_losses=${3:-}
kPathLengthMaxM=24        # so that the robot turns around after the first bend
kPowerLossAfterM=3
kFirstSweepS=5     # of simulated time: the first 3D scan comes after eight seconds
kLossPercent=5
kDeadlineSeconds=100
kNearHomeM=1.0
kReport=(mission.html map.png map.pgm map.yaml map.svg graph.g2o trajectory.tum cloud.ply volume.bt
  junctions.geojson run.lcmlog summary.json)

# The network of a mission within this one; skipped where it cannot be had.
"$here/in_private_network.sh" true || exit
scratch=$(mktemp -d)
out=$scratch/out
trap 'kill -KILL $(jobs -p) 2>/dev/null; wait; rm -rf "$scratch"' EXIT
echo "mission: {after_power_loss: home, limits: {path_length_max_m: $kPathLengthMaxM}}" >"$scratch/config.yaml"

fail() {
  echo "FAILED: $*" >&2
  tail -n 40 "$scratch"/*.text "$out/phases.tsv" "$out/supervisor.log" >&2
  exit 1
}
begin() { "$adit" mission "$@" --out "$out" >>"$scratch/mission.text" 2>&1 & mission=$!; }
driven_m() { awk -F'\t' '$2 != "STOP" { m = $7 } END { print int(m) }' "$out/phases.tsv" 2>/dev/null; }
await_driven() {
  for ((i = 0; i < kDeadlineSeconds * 10; ++i)); do
    ((10#0$(driven_m) >= $1)) && return
    kill -0 "$mission" 2>/dev/null || fail "it ended before it had driven $1 m"
    sleep 0.1
  done
  fail "it does not drive"
}
share() { awk -v percent="$1" 'BEGIN { print percent / 100 }'; }
# What runs in the folder of the mission.
remaining_processes() {
  local file
  for file in /proc/[0-9]*/cwd; do [[ $(readlink "$file") == "$out" ]] && echo "$file"; done 2>/dev/null
}
expect_no_process() {
  for _ in $(seq 50); do [[ -z $(remaining_processes) ]] && return; sleep 0.1; done
  fail "left running: $(remaining_processes)"
}
expect_return() {
  wait "$mission" || fail "the mission ended with $?"
  expect_no_process
  local off; off=$(awk '/from the start at the end/ { print $(NF - 7) }' "$scratch/mission.text" | tail -1)
  awk -v off="$off" -v max="$kNearHomeM" 'BEGIN { exit !(off != "" && off < max) }' ||
    fail "it says that it is at home, and is $off m away"
}

world=$here/bent_tunnel.yaml; config=$scratch/config.yaml
case $case in
  home)
    begin "$world" --config "$config"
    expect_return
    for file in "${kReport[@]}"; do [[ -s $out/$file ]] || fail "there is no $file"; done
    "$adit" mission "$world" --out "$out" 2>"$scratch/again.text" && fail "overwrites a mission"
    grep -q -- "--resume" "$scratch/again.text" || fail "does not say how to go on"
    ;;
  harmed)
    begin "$world" --config "$config" --fault "suspend:volume_map@$kFirstSweepS" \
      --fault kill:planning@20 --fault suspend:driving@40
    expect_return
    "$check_losses" "$out" >"$scratch/losses.text" || fail "something that was announced is lost"
    grep -q "driving does not answer" "$scratch/mission.text" || fail "nobody saw driving stand still"
    ;;
  cut)
    begin "$world" --config "$config"
    await_driven "$kPowerLossAfterM"
    kill -KILL "$mission"; wait "$mission" 2>/dev/null
    expect_no_process
    begin --resume
    expect_return
    [[ -s $out/run.lcmlog && -s $out/run_2.lcmlog ]] || fail "there are no logs of two lives"
    grep -q "is at home" "$out/mission.html" || fail "the report does not tell of the second life"
    ;;
  lossy)
    export ADIT_RECEIVE_LOSS; ADIT_RECEIVE_LOSS=$(share $kLossPercent)
    begin "$world" --config "$config" --fault "packet_loss=$ADIT_RECEIVE_LOSS@5"
    expect_return
    ;;
  ordered)
    echo "mission: {limits: {path_length_max_m: 500}}" >"$config"
    begin "$world" --config "$config"
    await_driven "$kPowerLossAfterM"
    "$adit" order pause --mission "$out" || fail "it does not pause"
    "$adit" order resume --mission "$out" || fail "it does not go on"
    "$adit" order return --mission "$out" | grep -q "homeward: by order" || fail "it does not come home"
    expect_return
    "$adit" order pause --mission "$out" 2>"$scratch/order.text" && fail "an order to nobody is obeyed"
    grep -q "no mission runs" "$scratch/order.text" || fail "does not say that no mission runs"
    ;;
  *) fail "no case $case" ;;
esac
