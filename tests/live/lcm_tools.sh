# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Functions of the scripts that play logs to live processes and record their output. Source this file. Skips the
# test if LCM's tools are not installed.

kPort=":1DF3 "       # LCM's port 7667 in the notation of /proc/net/udp
kDeadlineSeconds=60

for tool in lcm-logger lcm-logplayer ip; do
  if ! command -v "$tool" >/dev/null; then
    echo "skipped: no $tool, try: apt install liblcm-bin iproute2" >&2
    exit 77
  fi
done

# wait_for DESCRIPTION COMMAND..: waits until the command succeeds.
wait_for() {
  local description=$1 end=$((SECONDS + kDeadlineSeconds)); shift
  until "$@"; do
    if ((SECONDS > end)); then echo "timeout: no $description" >&2; exit 1; fi
    sleep 0.05
  done
}

is_listening() { grep -q "$kPort" /proc/net/udp; }
