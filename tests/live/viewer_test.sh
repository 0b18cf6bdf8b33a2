#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# viewer_test.sh ADIT CASE
# An independent client (viewer/client.mjs, @foxglove/ws-protocol in node) of the viewer. Skipped without node or the
# packages of viewer/page (npm ci). Cases:
#   log      agrees with every compared message of a played log
#   mission  sees the mission that runs in a private network; a port in use is replaced; --no-view serves nothing
#   orders   sends orders to the mission, which ends, by `adit view --mission --orders`; then plays its log by the same command
set -u
here=$(dirname "$(readlink -f "$0")")
adit=$1; case=$2
modules=$(readlink -f "$here/../../viewer/page/node_modules")
kDeadlineSeconds=60

if ! command -v node >/dev/null || [[ ! -d $modules/@foxglove/ws-protocol ]]; then
  echo "skipped: node or viewer/page/node_modules is missing (npm ci in viewer/page)"
  exit 77
fi
scratch=$(mktemp -d)
trap 'kill -KILL $(jobs -p) 2>/dev/null; wait 2>/dev/null; rm -rf "$scratch"' EXIT
fail() {
  echo "FAILED: $*" >&2
  tail -n 30 "$scratch"/*.text >&2
  exit 1
}
echo "mission: {after_power_loss: home, limits: {path_length_max_m: 16}}" >"$scratch/config.yaml"
# address FILE: of the first line with one.
address() {
  local found
  for ((i = 0; i < kDeadlineSeconds * 10; ++i)); do
    found=$(grep -o -m 1 'http://127.0.0.1:[0-9]*' "$1") && { echo "${found#http://}"; return; }
    sleep 0.1
  done
  return 1
}

case $case in
  log)
    "$adit" mission "$here/bent_tunnel.yaml" --config "$scratch/config.yaml" --in-process \
      --out "$scratch/out" >"$scratch/mission.text" 2>&1 || fail "the mission exited with $?"
    "$adit" view "$scratch/out/run.lcmlog" --port 0 >"$scratch/view.text" 2>&1 &
    at=$(address "$scratch/view.text") || fail "adit view prints no address"
    # The whole log at a multiple of real time, so that all topics have content within the time of the client.
    node "$here/viewer/play.mjs" "$modules" "ws://$at" 5 || fail "the playback cannot be controlled"
    node "$here/viewer/client.mjs" "$modules" "ws://$at" "$scratch/out/run.lcmlog" 15 || fail "the client disagrees"
    ;;
  mission)
    # The default port may be in use by another program here; this one is, for sure.
    node -e 'require("net").createServer().listen(Number(process.argv[1]), "127.0.0.1", () => console.log("listens"))' \
      18765 >"$scratch/blocker.text" &
    for ((i = 0; i < 100; ++i)); do grep -q listens "$scratch/blocker.text" && break; sleep 0.1; done
    "$adit" mission "$here/bent_tunnel.yaml" --config "$scratch/config.yaml" --out "$scratch/out" --view-port 18765 \
      --speed 4 >"$scratch/mission.text" 2>&1 &
    mission=$!
    at=$(address "$scratch/mission.text") || fail "adit mission prints no address"
    [[ $at != 127.0.0.1:18765 ]] || fail "the port in use was not replaced"
    [[ $(grep -c "18765" "$scratch/mission.text") == 1 ]] || fail "a port in use is not said in one line"
    grep -q "adit spy --mission" "$scratch/mission.text" || fail "the line that opens lcm-spy is missing"
    for ((i = 0; i < kDeadlineSeconds; ++i)); do
      node "$here/viewer/client.mjs" "$modules" "ws://$at" - 4 >"$scratch/client.text" 2>&1 && break
      kill -0 $mission 2>/dev/null || fail "the mission ended before the client saw it"
    done
    kill -INT $mission
    wait $mission
    if node "$here/viewer/client.mjs" "$modules" "ws://$at" - 1 >/dev/null 2>&1; then
      fail "adit-viewer outlives its mission"
    fi
    ;;
  orders)
    "$adit" mission "$here/bent_tunnel.yaml" --config "$scratch/config.yaml" --out "$scratch/out" --no-view --speed 4 \
      >"$scratch/mission.text" 2>&1 &
    mission=$!
    # The folder names the mission only once its processes run.
    for ((i = 0; i < kDeadlineSeconds * 10; ++i)); do
      grep -q "adit spy --mission" "$scratch/mission.text" && break
      sleep 0.1
    done
    "$adit" view --mission "$scratch/out" --orders --port 0 >"$scratch/view.text" 2>&1 &
    view=$!
    at=$(address "$scratch/view.text") || fail "adit view --mission prints no address"
    token=$(sed -n 's/^token of orders: //p' "$scratch/view.text")
    node "$here/viewer/orders.mjs" "$modules" "ws://$at" "$token" || fail "orders do not do what they say"
    wait $mission
    [[ $? == 1 ]] || fail "a mission that an order stopped exits with 0"
    grep -q "stopped" "$scratch/mission.text" || fail "the mission does not say that it was stopped"
    kill -INT $view
    wait $view || fail "adit view exits with $?"
    "$adit" view --mission "$scratch/out" --port 0 >"$scratch/play.text" 2>&1 &
    "$adit" view --mission "$scratch/out" --orders --port 0 >"$scratch/rejected.text" 2>&1 && fail "a log takes orders"
    grep -q "only a running mission" "$scratch/rejected.text" || fail "no reason why a log takes no orders"
    at=$(address "$scratch/play.text") || fail "adit view --mission does not play the logs of a finished mission"
    node "$here/viewer/client.mjs" "$modules" "ws://$at" - 8 >"$scratch/client.text" 2>&1 || fail "the finished mission is not shown"
    ;;
  *) fail "unknown case $case" ;;
esac
echo passed
