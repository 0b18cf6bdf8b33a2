#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# full_disk_mission_test.sh ADIT [SPEED]
# A mission of processes on a small disk (a tmpfs in a mount namespace of its own), which another program fills
# during the mission: the recording stops and is readable, the mission comes home and says why, the exit code is 1,
# all journals are intact. Then one whose disk is filled in one step, to the last byte: the same, as the journals
# have their space. Exit code 77 (skipped) where no file system can be mounted.
set -u
adit=$1
if [[ -z ${IN_MOUNT_NAMESPACE:-} ]]; then
  unshare -rmn true 2>/dev/null || { echo "skipped: unshare -rmn is not permitted" >&2; exit 77; }
  IN_MOUNT_NAMESPACE=1 exec unshare -rmn "$0" "$@"
fi
ip link set lo up && ip route add 224.0.0.0/4 dev lo || { echo "skipped: no multicast" >&2; exit 77; }
scratch=$(mktemp -d)
mount -t tmpfs -o size=300m tmpfs "$scratch" || { echo "skipped: no tmpfs" >&2; exit 77; }
mission=0
trap '[[ $mission != 0 ]] && kill "$mission" 2>/dev/null; umount -l "$scratch"; rmdir "$scratch"' EXIT
cd "$scratch" || exit 1
failures=0
complain() { echo "FAILED: $*" >&2; failures=$((failures + 1)); }
free_mb() { df --output=avail -BM "$scratch" | tail -1 | tr -dc 0-9; }

# Thresholds that fit to this disk.
printf 'mission:\n  limits:\n    disk_free_min_mb: 60\nsim:\n  record_free_min_mb: 120\n' > mission.yaml

# run NAME FREE_MB..: during the mission another program leaves so much space free, in steps a few seconds apart.
run() {
  local name=$1 free; shift
  rm -f ballast
  "$adit" mission random --seed 7 --length-m 60 --config mission.yaml --out "$name" >"/dev/shm/$$.out" 2>&1 &
  mission=$!
  until grep -qs $'\t' "$name/phases.tsv" && (($(wc -l <"$name/phases.tsv") > 8)); do
    kill -0 $mission 2>/dev/null || break
    sleep 0.1
  done
  for free in "$@"; do
    if ((free == 0)); then
      dd if=/dev/zero bs=64k >>ballast 2>/dev/null
    else
      fallocate -l "$(($(free_mb) - free + $(stat -c %s ballast 2>/dev/null || echo 0) / 1048576))M" ballast
    fi
    sleep 3
  done
  wait $mission; local code=$?
  mission=0
  mv "/dev/shm/$$.out" "/dev/shm/$$.last"
  local text; text=$(tail -n 12 "/dev/shm/$$.last")
  [[ $code == 1 ]] || complain "$name: exit code $code"
  grep -q 'the recording has stopped: ' <<<"$text" || complain "$name: the end does not say that the recording stopped"
  grep -qE '^the robot is at home, .*; it turned around: .*( MB free on the disk|No space left)' "/dev/shm/$$.last" ||
    complain "$name: the outcome does not say why the robot came home"
  rm -f ballast
  "$adit" report "$name/run.lcmlog" --out report >"/dev/shm/$$.report" 2>&1 || complain "$name: the log cannot be reported"
  grep -qi 'corrupt\|truncated\|damaged\|incomplete event' "/dev/shm/$$.report" && complain "$name: the log is damaged"
  if [[ $name == filling ]]; then
    grep -q '"record_stopped": "fault: the recording has stopped' report/summary.json || complain "$name: not in summary.json"
  fi
  # Says what is wrong with the journals, and whether the map has fewer local maps than the mission has seen.
  local resumed; resumed=$("$adit" mission --resume --out "$name" 2>&1)
  [[ $(wc -l <<<"$resumed") == 1 && $resumed == *"has ended: the robot is at home"* ]] ||
    complain "$name: journals: $resumed"
  ((failures)) && { cat "/dev/shm/$$.last" "/dev/shm/$$.report" >&2; }
  echo "$name: exit code $code; $(grep '^the robot' "/dev/shm/$$.last" | tail -1)"
  rm -rf report "/dev/shm/$$."*
}

run filling 100 50
run full 0
[[ $failures == 0 ]]
