#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# crash_safety_test.sh ADIT MAPPING CHECK_CRASHES
# adit-mapping restores from its journal, after SIGKILL, everything that it has published, and continues.
set -eu
here=$(dirname "$(readlink -f "$0")")
adit=$1; mapping=$2; check_crashes=$3
kLengthM=300  # loops are closed; 650 s of driving
kSpeed=32     # 100 scans a second
kSeed=1

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$adit" sample "$scratch/mine.lcmlog" --length-m "$kLengthM" --truth "$scratch/truth.tum"
"$adit" map "$scratch/mine.lcmlog" --out "$scratch/matched"   # scans and their matches
"$here/in_private_network.sh" "$here/kill_mapping.sh" "$scratch/matched/run.lcmlog" "$kSpeed" \
  "$scratch/recorded.lcmlog" "$scratch/map.journal" "$kSeed" "$mapping"
"$check_crashes" "$scratch/recorded.lcmlog" "$scratch/map.journal" "$scratch/truth.tum" \
  "$(cat "$scratch/map.journal.torn")"
