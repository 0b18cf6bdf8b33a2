#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# bags_test.sh ADIT ros1|ros2
# Bags that other programs make of the readings of a CARMEN log map like the LCM log of the same readings: the same
# trajectory. ros1: by rosbag of Debian, without compression, with bz2 and lz4. ros2: by @mcap/core, without compression, with zstd
# and lz4, and in the database of a rosbag2; also with a damaged chunk, which costs its messages only. Skipped where
# the program is not installed.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
adit=$1; case=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
fail() { echo "FAILED: $*" >&2; exit 1; }

"$adit" sample mine.log --length-m 20 >/dev/null
"$adit" import carmen mine.log mine.lcmlog >/dev/null
"$adit" map mine.lcmlog --out expected >/dev/null

# Times and poses of two trajectories are the same, to what a quaternion rounds or to the given distance.
check_trajectory() {  # NAME [METRES]
  paste -d ' ' expected/trajectory.tum "$1/trajectory.tum" | awk -v name="$1" -v most="${2:-1e-5}" '
    NF != 16 { bad = 1 }
    { for (i = 1; i <= 8; ++i) { d = $i - $(i + 8); if (d < 0) d = -d; if (d > most) bad = 1 } }
    END { if (bad || NR < 50) { print name ": another trajectory"; exit 1 } }' || exit 1
}

maps_the_same() {  # BAG
  local name=map_${1//[.\/]/_}
  "$adit" map "$1" --out "$name" >out 2>err || fail "$1: $(cat err)"
  if grep '^adit: ' err >&2; then fail "$1: a warning"; fi   # lines of progress are none
  check_trajectory "$name"
  # A cell may flip where a quaternion rounds.
  [[ $(stat -c %s expected/map.pgm) == $(stat -c %s "$name/map.pgm") ]] || fail "$1: a map of another size"
  (($(cmp -l expected/map.pgm "$name/map.pgm" | wc -l) <= 5)) || fail "$1: another map"
  echo "$1: the same trajectory and map, $(wc -l <"$name/trajectory.tum") poses"
}

if [[ $case == ros1 ]]; then
  # Modules of Debian are seen by its own interpreter only.
  python=python3
  /usr/bin/python3 -c 'import rosbag' 2>/dev/null && python=/usr/bin/python3
  code=0; "$python" "$here/write_ros1_bags.py" mine.log . || code=$?
  ((code == 77)) && exit 77
  ((code == 0)) || fail "write_ros1_bags.py"
  for bag in none.bag bz2.bag lz4.bag; do maps_the_same "$bag"; done
  # Of a 3D lidar beams without return are not known, and points have the bearings of bins.
  "$adit" map clouds.bag --out clouds --clouds /points >out 2>err || fail "$(cat err)"
  check_trajectory clouds 0.15
  "$adit" volume clouds/run.lcmlog --out clouds >/dev/null || fail "volume of clouds.bag"
  grep -q 'element vertex [1-9]' <(head -c 300 clouds/cloud.ply) || fail "no points"
  # A recording that was killed has no index; its last chunk may be incomplete.
  head -c $(($(stat -c %s lz4.bag) * 2 / 3)) lz4.bag >killed.bag.active
  "$adit" map killed.bag.active --out killed >out 2>err || fail "$(cat err)"
  grep -q "skipped .* bytes of a truncated end" err || fail "killed: $(cat err)"
  poses=$(wc -l <killed/trajectory.tum)
  ((poses > 50)) || fail "killed: $poses poses"
  echo "killed.bag.active: $poses poses"
else
  if ! command -v node >/dev/null || [[ ! -d $here/../export/node_modules/@foxglove/rosmsg2-serialization ]]; then
    echo "skipped: no node, or no packages, try: apt install nodejs npm; (cd tests/live/export && npm ci)" >&2
    exit 77
  fi
  node "$here/write_ros2_mcap.mjs" mine.log .
  python3 "$here/write_rosbag2_database.py" messages.tsv database
  for bag in *.mcap database database/database_0.db3; do maps_the_same "$bag"; done
  if command -v zstd >/dev/null; then
    zstd -q database/database_0.db3 -o packed.db3.zstd
    maps_the_same packed.db3.zstd
  fi

  # Our own bag gives the readings back, and an independent reader decodes it.
  "$adit" export mine.lcmlog --rosbag2 back >/dev/null
  maps_the_same back
  node "$here/read_ros2_mcap.mjs" back/back_0.mcap | tee topics
  grep -q '^/scan_front sensor_msgs/msg/LaserScan [1-9][0-9]* 181 beams in laser_front' topics || fail "no scans"
  grep -q '^/wheel_odometry nav_msgs/msg/Odometry [1-9]' topics || fail "no odometry"
  # And one of a map, with poses and the map.
  "$adit" export expected/run.lcmlog --rosbag2 mapped >/dev/null
  node "$here/read_ros2_mcap.mjs" mapped/mapped_0.mcap | tee topics
  grep -q '^/map nav_msgs/msg/OccupancyGrid [1-9].* with walls' topics || fail "no map"
  grep -q '^/tf tf2_msgs/msg/TFMessage [1-9]' topics || fail "no tf"

  # 100 damaged bytes in the middle cost a chunk.
  cp none.mcap damaged.mcap
  printf 'x%.0s' {1..100} | dd of=damaged.mcap bs=1 seek=$(($(stat -c %s none.mcap) / 2)) conv=notrunc 2>/dev/null
  "$adit" import bag damaged.mcap damaged.lcmlog >out 2>err || fail "damaged: $(cat err)"
  grep -q "skipped [0-9]* corrupt bytes in 1 region" err || fail "damaged: $(cat err)"
  grep -q "skipped [0-9]* unreadable messages" err || fail "damaged: $(cat err)"
  cat err
fi
