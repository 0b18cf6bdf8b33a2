#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# loop_in_space.sh ADIT DIR
# Drives once around a loop of 1 km that passes 14 m below itself, and 70 m farther, maps the drive, and prints the
# score of the map; z is the error in height.
set -euo pipefail
adit=$1 out=$2
loop=$(dirname "$(readlink -f "$0")")/loop_in_space
mkdir -p "$out"
"$adit" drive "$loop/eight.yaml" --waypoints "$loop/eight_drive.txt" --out "$out/drive.lcmlog"
"$adit" map "$out/drive.lcmlog" --out "$out/map"
"$adit" eval map "$out/map" --world "$loop/eight.yaml"
