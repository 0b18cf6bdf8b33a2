#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# same_drive_twice.sh ADIT
# The same world, waypoints and seed give the same log to the byte in two processes.
set -eu
adit=$1

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# From the start, about 20 s at 0.4 m/s.
printf '12 0\n' > "$scratch/waypoints.txt"
for run in first second; do
  "$adit" drive mathies --waypoints "$scratch/waypoints.txt" --out "$scratch/$run.lcmlog" \
    --truth "$scratch/$run.tum" > /dev/null
done
test "$(stat -c %s "$scratch/first.lcmlog")" -gt 1000000
cmp "$scratch/first.lcmlog" "$scratch/second.lcmlog"
cmp "$scratch/first.tum" "$scratch/second.tum"
