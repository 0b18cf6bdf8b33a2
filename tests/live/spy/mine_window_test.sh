#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mine_window_test.sh WRITE_MISSION_LOG [PICTURE.png] SPY [ARGUMENT..]
# lcm-spy draws a synthetic mine: starts the command SPY (live_spy of the tests, or `adit spy`) on a virtual display and a
# private network, plays its log, opens "Draw the mine" of the channel CLOUD, and looks for walls, pose graph and robot in
# the picture of the window.
set -u
here=$(dirname "$(readlink -f "$0")")

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/../in_private_network.sh" "$0" "$@"
fi
for tool in Xvfb xdotool import convert lcm-spy lcm-logplayer java; do
  if ! command -v "$tool" >/dev/null; then
    echo "skipped: no $tool, try: apt install xvfb xdotool imagemagick default-jre liblcm-bin liblcm-java libjchart2d-java" >&2
    exit 77
  fi
done
scratch=$(mktemp -d)
processes=()
trap 'kill "${processes[@]}" 2>/dev/null; wait; rm -rf "$scratch"' EXIT
log=$scratch/run.lcmlog
"$1" "$log" || exit 1
shift
picture=$scratch/mine.png
if [[ $1 == *.png ]]; then picture=$1; shift; fi
kRow=1      # of CLOUD in the alphabetical table of channels, behind ASSOCIATION
kWall=1F242B kGraph=6D747C kRobot=C8324A   # colours of MinePanel
kPixelsMin=20

mkfifo "$scratch/display"
Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp 3>"$scratch/display" 2>/dev/null &
processes+=($!)
read -r number <"$scratch/display"
export DISPLAY=:$number

"$@" >"$scratch/spy.out" 2>&1 & processes+=($!)
spy=$(timeout 60 xdotool search --sync --onlyvisible --name "LCM Spy" | head -1)
[[ -n $spy ]] || { cat "$scratch/spy.out" >&2; exit 1; }
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
