#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# viewer_test.sh ADIT CASE
# An independent client (viewer/client.mjs, @foxglove/ws-protocol in node) of the viewer. Skipped without node or the
# packages of viewer/page (npm ci). Cases:
#   log      agrees with every compared message of a played log
#   mission  sees the mission that runs in a private network; a port in use is replaced; --no-view serves nothing
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
  *) fail "unknown case $case" ;;
esac
echo passed
