#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mission_test.sh ADIT CASE [CHECK_LOSSES]
# A short mission with one process per stage returns to the start, and no process remains. Cases:
#   nominal        no faults
#   faults         one process is killed, others are suspended, one of them during a 3D scan
#   power_loss     all processes are killed; the mission is resumed
#   power_loss_compressed   the same with compressed logs
#   message_loss   5 % of the messages of the drivers are lost (losses between stages:
#                  tests/system/lossy_mission_test.cpp)
#   orders         pause, resume and return by order
set -u
here=$(dirname "$(readlink -f "$0")")
adit=$1; case=$2; check_losses=${3:-}
kPathLengthMaxM=24        # the robot turns around after the first bend
kPowerLossAfterM=3
kFirstSweepS=5     # simulated time; the first 3D scan is complete after eight seconds
kLossShare=0.05
kDeadlineSeconds=100
kReturnErrorMaxM=1.0
kReport=(mission.html map.png map.pgm map.yaml map.svg graph.g2o trajectory.tum cloud.ply volume.bt
  junctions.geojson run.lcmlog summary.json)

# The mission creates its own private network; skipped where that is not permitted.
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
    kill -0 "$mission" 2>/dev/null || fail "the mission ended before $1 m"
    sleep 0.1
  done
  fail "the robot does not drive"
}
# Processes whose working directory is the folder of the mission.
remaining_processes() {
  local file
  for file in /proc/[0-9]*/cwd; do [[ $(readlink "$file") == "$out" ]] && echo "$file"; done 2>/dev/null
}
expect_no_process() {
  for _ in $(seq 50); do [[ -z $(remaining_processes) ]] && return; sleep 0.1; done
  fail "remaining processes: $(remaining_processes)"
}
expect_return() {
  wait "$mission" || fail "the mission exited with $?"
  expect_no_process
  local error_m; error_m=$(awk '/from the start at the end/ { print $(NF - 7) }' "$scratch/mission.text" | tail -1)
  awk -v error_m="$error_m" -v max="$kReturnErrorMaxM" 'BEGIN { exit !(error_m != "" && error_m < max) }' ||
    fail "the mission reports the return, but the robot is $error_m m from the start"
}

world=$here/bent_tunnel.yaml; config=$scratch/config.yaml
case $case in
  nominal)
    begin "$world" --config "$config"
    expect_return
    for file in "${kReport[@]}"; do [[ -s $out/$file ]] || fail "$file is missing"; done
    "$adit" mission "$world" --out "$out" 2>"$scratch/second.text" && fail "an existing mission was overwritten"
    grep -q -- "--resume" "$scratch/second.text" || fail "the error does not mention --resume"
    ;;
  faults)
    begin "$world" --config "$config" --fault "suspend:volume_map@$kFirstSweepS" \
      --fault kill:planning@20 --fault suspend:driving@40
    expect_return
    "$check_losses" "$out" >"$scratch/losses.text" || fail "published data are lost"
    grep -q "driving does not respond" "$scratch/mission.text" || fail "the suspended process was not detected"
    ;;
  power_loss | power_loss_compressed)
    options=(); extension=
    if [[ $case == *_compressed ]]; then options=(--compress); extension=.zst; fi
    begin "$world" --config "$config" "${options[@]}"
    await_driven "$kPowerLossAfterM"
    kill -KILL "$mission"; wait "$mission" 2>/dev/null
    expect_no_process
    begin --resume "${options[@]}"
    expect_return
    [[ -s $out/run.lcmlog$extension && -s $out/run_2.lcmlog$extension ]] || fail "the logs of two runs are missing"
    grep -q '"outcome": "home"' "$out/summary.json" || fail "the report does not cover the second run"
    ;;
  message_loss)
    begin "$world" --config "$config" --fault "packet_loss=$kLossShare@5"
    expect_return
    ;;
  orders)
    echo "mission: {limits: {path_length_max_m: 500}}" >"$config"
    begin "$world" --config "$config"
    await_driven "$kPowerLossAfterM"
    "$adit" order pause --mission "$out" || fail "order pause"
    "$adit" order resume --mission "$out" || fail "order resume"
    "$adit" order return --mission "$out" | grep -q "returning home: by order" || fail "order return"
    expect_return
    "$adit" order pause --mission "$out" 2>"$scratch/order.text" && fail "an order without a mission succeeded"
    grep -q "no mission is running" "$scratch/order.text" || fail "the error does not mention the missing mission"
    ;;
  *) fail "unknown case $case" ;;
esac
