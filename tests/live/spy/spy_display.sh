#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# spy_display.sh
# Sourced by the scripts that look at lcm-spy, with all their arguments: starts them again in a private network.

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../in_private_network.sh" "$0" "$@"
fi

# need TOOL..: ends with 77, for skipped, where one is missing.
need() {
  local tool
  for tool in "$@"; do
    command -v "$tool" >/dev/null && continue
    echo "skipped: no $tool, try: apt install xvfb xdotool imagemagick default-jre liblcm-bin liblcm-java libjchart2d-java" >&2
    exit 77
  done
}

# start_spy SIZE SPY [ARGUMENT..]: starts the command SPY on a virtual display of SIZE. Sets `scratch`, a folder that is removed at
# the end, `processes`, which end then, and `spy`, the window of lcm-spy; ends with 1 if it does not open.
start_spy() {
  local size=$1 number
  shift
  scratch=$(mktemp -d)
  processes=()
  trap 'kill "${processes[@]}" 2>/dev/null; wait; rm -rf "$scratch"' EXIT
  mkfifo "$scratch/display"
  Xvfb -displayfd 3 -screen 0 "${size}x24" -nolisten tcp 3>"$scratch/display" 2>/dev/null &
  processes+=($!)
  read -r number <"$scratch/display"
  export DISPLAY=:$number
  "$@" >"$scratch/spy.out" 2>&1 &
  processes+=($!)
  spy=$(timeout 60 xdotool search --sync --onlyvisible --name "LCM Spy" | head -1)
  [[ -n $spy ]] || { cat "$scratch/spy.out" >&2; exit 1; }
}
