#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# screenshot.sh LOG PICTURE.png SPY [ARGUMENT..]
# Takes a screenshot of lcm-spy while LOG is played: starts the command SPY (live_spy of the tests, or `adit spy`)
# on a virtual display and a private network, and opens four channels.
set -u
# shellcheck source=tests/live/spy/spy_display.sh
. "$(dirname "$(readlink -f "$0")")/spy_display.sh"
need Xvfb xdotool import lcm-logplayer
log=$1; picture=$2; shift 2
kRows=(2 3 4 5)   # of the alphabetical table of channels
start_spy 1280x1210 "$@"
lcm-logplayer "$log" >/dev/null & processes+=($!)
sleep 3   # for the table to fill; lcm-spy does not signal this

# Without a window manager, new windows open in the corner: move each one aside.
windows() { xdotool search --onlyvisible --name "." | sort; }
xdotool windowsize --sync "$spy" 1270 260
for row in 0 1 2 3; do
  windows >"$scratch/before"
  for ((i = 0; i < 100; ++i)); do
    if ((i % 20 == 0)); then   # repeat if the row appears late
      xdotool mousemove 60 $((27 + 16 * kRows[row])) click --repeat 2 --delay 80 1
    fi
    viewer=$(windows | comm -13 "$scratch/before" - | head -1)
    [[ -n $viewer ]] && break
    sleep 0.1
  done
  if [[ -z $viewer ]]; then echo "no window opened for a channel" >&2; exit 1; fi
  xdotool windowsize --sync "$viewer" 630 460 windowmove --sync "$viewer" \
    $((640 * (row % 2))) $((270 + 470 * (row / 2)))
done
sleep 1   # for the windows to be drawn
import -window root "$picture"
