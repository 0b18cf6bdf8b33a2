#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mine_window_test.sh WRITE_MISSION_LOG [PICTURE.png] SPY [ARGUMENT..]
# lcm-spy draws a synthetic mine: starts the command SPY (live_spy of the tests, or `adit spy`) on a virtual display and a
# private network, plays its log, opens "Draw the mine" of the channel CLOUD, and looks for walls, pose graph and robot in
# the picture of the window.
set -u
# shellcheck source=tests/live/spy/spy_display.sh
. "$(dirname "$(readlink -f "$0")")/spy_display.sh"
need Xvfb xdotool import convert lcm-spy lcm-logplayer java
write_log=$1; shift
picture=
if [[ $1 == *.png ]]; then picture=$1; shift; fi
kRow=1      # of CLOUD in the alphabetical table of channels, behind ASSOCIATION
kWall=1F242B kGraph=6D747C kRobot=C8324A   # colours of MinePanel
kPixelsMin=20

start_spy 1280x1024 "$@"
log=$scratch/run.lcmlog
picture=${picture:-$scratch/mine.png}
"$write_log" "$log" || exit 1
lcm-logplayer -s 10 "$log" >/dev/null   # the rows of the table are complete then

# The menu of a row offers the plugin below the viewer of lcm-spy itself.
xdotool windowmove --sync "$spy" 0 0
for ((i = 0; i < 20; ++i)); do
  xdotool mousemove 60 $((27 + 16 * kRow)) click 3
  sleep 0.5
  xdotool mousemove_relative 30 31 click 1
  for ((k = 0; k < 10; ++k)); do
    window=$(xdotool search --onlyvisible --name "^Mine$" | head -1)
    [[ -n $window ]] && break 2
    sleep 0.2
  done
done
[[ -n $window ]] || { echo "no window of the plugin opened" >&2; import -window root "$picture"; exit 1; }
xdotool windowmove --sync "$window" 300 200

count() { convert "$picture" -depth 8 -format %c histogram:info: | awk -v colour="#$1" '$0 ~ colour { n = $1 + 0 } END { print n + 0 }'; }
for ((i = 0; i < 20; ++i)); do
  import -window "$window" "$picture"
  (($(count $kWall) >= kPixelsMin && $(count $kGraph) >= kPixelsMin && $(count $kRobot) >= kPixelsMin)) && exit 0
  sleep 0.5
done
echo "walls $(count $kWall), pose graph $(count $kGraph), robot $(count $kRobot) pixels" >&2
exit 1
