#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# sandbox_mission.sh BUILD OUT [WORLD]
# A mission under systemd, by the units of deploy/systemd as they are installed: systemd runs in a container over the
# root of this computer, to which nothing is written (systemd-nspawn, root needed; 77 where it is not possible). The
# simulator takes the place of the drivers, as a process of the supervisor; all stages use its time, and orders are
# sealed. OUT receives inside.log: the outcome, the exposure of the running units, their scheduling and their journals.
set -u
here=$(dirname "$(readlink -f "$0")")
root=$(readlink -f "$here/../..")
kDeadlineSeconds=${SANDBOX_SECONDS:-600}

skip() { echo "skipped: $*" >&2; exit 77; }

outside() {
  local build out world container
  build=$(readlink -f "$1"); mkdir -p "$2"; out=$(readlink -f "$2"); world=${3:-straight}
  ((EUID == 0)) || skip "not root"
  command -v systemd-nspawn >/dev/null || skip "no systemd-nspawn, try: apt install systemd-container"
  container=$(mktemp -d)
  rm -f "$out/inside.log"
  cat >"$out/check.service" <<UNIT
[Unit]
After=basic.target dbus.service
[Service]
Type=oneshot
ExecStart=/bin/bash $root/tests/live/sandbox_mission.sh --inside $build $out $world
ExecStopPost=/bin/systemctl --no-block poweroff
TimeoutStartSec=infinity
UNIT
  printf '[Unit]\nWants=check.service dbus.service\n' >"$out/check.target"
  unshare -m bash -c '
    mount --make-rprivate / && mount --bind / "$1" || exit 77
    exec timeout -s KILL "$4" systemd-nspawn --quiet -D "$1" --volatile=overlay --register=no --keep-unit \
      --private-network --machine=adit-sandbox --bind="$2" --bind-ro="$2/check.service:/etc/systemd/system/check.service" \
      --bind-ro="$2/check.target:/etc/systemd/system/check.target" --console=pipe \
      --boot systemd.unit=check.target' _ "$container" "$out" "" "$((kDeadlineSeconds * 2))" \
    </dev/null >"$out/boot.log" 2>&1
  rmdir "$container"
  [[ -s $out/inside.log ]] || skip "systemd does not start here: $(tail -n 3 "$out/boot.log")"
  cat "$out/inside.log"
  grep -q '^PASSED' "$out/inside.log"
}

inside() {
  local build=$1 out=$2 world=$3 bin=/usr/bin
  exec >"$out/inside.log" 2>&1
  cmake --install "$build" --prefix /usr >"$out/install.log" || { echo "FAILED: install"; return; }
  bash "$root/deploy/debian/postinst" configure
  sysctl -q -p /usr/lib/sysctl.d/60-adit-lcm.conf

  adit key --new /etc/adit/seal.key >/dev/null
  chgrp adit /etc/adit/seal.key; chmod 640 /etc/adit/seal.key
  sed -i -e 's/^# seal:/seal:/' -e 's/path_length_max_m: 2000/path_length_max_m: 14/' /etc/adit/robot.yaml
  # Simulated time for all, and the simulator as a driver.
  sed -i 's/exec = "\(adit-[a-z_]*\)";/exec = "\1 --sim-time";/' /etc/adit/robot.cfg
  # The simulator waits for all stages, so that none may wait for messages of another.
  sed -i -e 's/ alive_channel = .*//' -e 's/ depends_on = [^;]*;//' /etc/adit/robot.cfg
  stages=scan_matching,mapping,scan_assembly,terrain,volume_map,planning,driving,guard,exploration,mission,supervisor
  sed -i "s|^group \"drivers\" {|&\n  cmd \"sim\" { exec = \"adit-sim $world --wait-for $stages --ahead-max-s 0.1 --config /etc/adit/robot.yaml\"; stop_signal = 15; }|" /etc/adit/robot.cfg
  for unit in guard supervisor; do
    mkdir -p "/run/systemd/system/adit-$unit.service.d"
    printf '[Service]\nExecStart=\nExecStart=/usr/bin/adit-%s --sim-time --config /etc/adit/robot.yaml\n' "$unit" \
      >"/run/systemd/system/adit-$unit.service.d/simulated.conf"
  done
  systemctl daemon-reload
  systemctl start adit-loopback || echo "FAILED: adit-loopback does not start"
  systemctl start adit-supervisor || echo "FAILED: adit-supervisor does not start"

  local phase="" driven=0
  adit order resume --timeout-s 20 | sed 's/^/order without the key: /' || true
  adit order resume --timeout-s 120 --key /etc/adit/seal.key | sed 's/^/order with the key: /'
  for ((i = 0; i < kDeadlineSeconds; ++i)); do
    sleep 1
    phase=$(adit logs mission --socket /run/adit/supervisor.sock 2>/dev/null | tail -n 1)
    driven=$(adit order pause --timeout-s 0.3 2>&1 | tail -n 1)
    [[ $driven == *"has ended"* ]] && break
  done
  echo "last answer: $driven"
  adit ps --socket /run/adit/supervisor.sock
  for unit in loopback guard supervisor; do
    echo "adit-$unit: $(systemctl is-active "adit-$unit"), restarts $(systemctl show -P NRestarts "adit-$unit"), $(
      systemd-analyze security --no-pager "adit-$unit" | tail -n 1)"
  done
  local guard; guard=$(systemctl show -P MainPID adit-guard)
  echo "guard: $(chrt -p "$guard" | paste -sd' '), oom_score_adj $(cat "/proc/$guard/oom_score_adj"), $(
    grep -E 'Seccomp:|NoNewPrivs|CapEff' "/proc/$guard/status" | paste -sd' ')"
  ls -l /var/lib/adit /var/lib/adit/log
  journalctl --no-pager -o cat -u adit-guard -u adit-supervisor -u adit-loopback | tail -n 60
  local logs; logs=$(ls /var/lib/adit/log/run-*.lcmlog* 2>/dev/null)
  # shellcheck disable=SC2086
  adit report $logs --out /tmp/mission 2>&1 | tail -n 5
  if [[ $driven == *"has ended"* ]]; then echo "PASSED"; else echo "FAILED: the mission has not ended"; fi
  cp /var/lib/adit/log/*.log "$out" 2>/dev/null
}

if [[ ${1:-} == --inside ]]; then shift; inside "$@"; else
  (($# >= 2)) || { echo "usage: sandbox_mission.sh BUILD OUT [WORLD]" >&2; exit 2; }
  outside "$@"
fi
