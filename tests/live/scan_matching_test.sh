#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# scan_matching_test.sh ADIT SCAN_MATCHING COMPARE_POSES
# An imported log, played by lcm-logplayer to the process adit-scan_matching and recorded by lcm-logger, gives
# the same poses as `adit map` in one process.
set -eu
here=$(dirname "$(readlink -f "$0")")
adit=$1; scan_matching=$2; compare_poses=$3
kLengthM=60   # 150 s of driving, three scans a second
kSpeed=10     # no message is lost at thirty scans a second, even on a slow or busy machine

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$adit" sample "$scratch/mine.log" --length-m "$kLengthM"
"$adit" import carmen "$scratch/mine.log" "$scratch/mine.lcmlog"
"$adit" map "$scratch/mine.lcmlog" --out "$scratch/offline"
"$here/in_private_network.sh" "$here/record_node.sh" "$scratch/mine.lcmlog" "$kSpeed" \
  "$scratch/recorded.lcmlog" "$scan_matching"
"$compare_poses" "$scratch/offline/run.lcmlog" "$scratch/recorded.lcmlog"
