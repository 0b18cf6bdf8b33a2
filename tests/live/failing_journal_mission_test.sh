#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# failing_journal_mission_test.sh ADIT FAILING_DISK [JOURNAL..]
# Missions of processes whose disk fails (EIO) for the two files of one journal, in the middle of the mission: each
# comes home, by the truth too, says which journal the disk does not take, and exits with 1. With JOURNAL.copy only
# the second file fails. Default: mapping; all: mapping mapping.copy mission exploration scan_assembly volume_map.
# FAILING_DISK is the library that fails the calls. Exit code 77 (skipped) without a private network.
set -u
here=$(dirname "$(readlink -f "$0")")
adit=$(readlink -f "$1"); failing_disk=$(readlink -f "$2"); shift 2
(($#)) || set -- mapping
"$here/in_private_network.sh" true || { echo "skipped: no private network" >&2; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0
complain() { echo "FAILED: $*" >&2; failures=$((failures + 1)); }

for journal in "$@"; do
  out=$scratch/$journal
  case $journal in mission* | exploration*) bytes=20000 ;; *) bytes=400000 ;; esac
  FAIL_BELOW=$out/$journal. FAIL_AFTER=$bytes LD_PRELOAD=$failing_disk \
    "$adit" mission "$here/bent_tunnel.yaml" --out "$out" >"$scratch/text" 2>&1
  code=$?
  [[ $code == 1 ]] || complain "$journal: exit code $code"
  outcome=$(grep '^the robot is at home' "$scratch/text")
  grep -qE "it turned around: .*${journal%.copy}.*\.journal: cannot write: Input/output error" <<<"$outcome" ||
    complain "$journal: the outcome does not name it"
  grep -q "^adit mission: .*\.journal: cannot write: Input/output error" "$scratch/text" ||
    complain "$journal: no message during the mission"
  distance_m=$(sed -nE 's/.*; ([0-9.]+) m from the start at the end.*/\1/p' "$scratch/text")
  awk -v d="${distance_m:-99}" 'BEGIN { exit !(d < 0.5) }' || complain "$journal: ${distance_m:-?} m from the start"
  echo "$journal: exit code $code, ${distance_m:-?} m from the start; $outcome"
done
((failures == 0)) || { cat "$scratch/text" >&2; exit 1; }
