# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# What the scripts share that play logs to live processes and record what they say. To be sourced.
# Skips where LCM's tools are absent.

kPort=":1DF3 "       # 7667, LCM's, as /proc/net/udp writes it
kDeadlineSeconds=60

for tool in lcm-logger lcm-logplayer ip; do
  if ! command -v "$tool" >/dev/null; then
    echo "skipped: no $tool, try: apt install liblcm-bin iproute2" >&2
    exit 77
  fi
done

# wait_for WHAT COMMAND..: until the command succeeds.
wait_for() {
  local what=$1 end=$((SECONDS + kDeadlineSeconds)); shift
  until "$@"; do
    if ((SECONDS > end)); then echo "waited in vain for $what" >&2; exit 1; fi
    sleep 0.05
  done
}

is_listening() { grep -q "$kPort" /proc/net/udp; }
