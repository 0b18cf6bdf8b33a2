#!/bin/sh
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mission_pair.sh FAULTY SOUND OUT WORLD ARGUMENTS..
# In the folder OUT, a mission by the program FAULTY with the configurations sound.yaml and fault.yaml together, scored in faulty.json. If it
# does not succeed, the same mission by SOUND with sound.yaml alone, scored in sound.json, otherwise that is the same.
set -e
faulty=$1 sound=$2
cd "$3"
shift 3
# mission NAME PROGRAM CONFIG ARGUMENTS..
mission() {
  name=$1 program=$2 config=$3
  shift 3
  "$program" "$@" --config "$config" --out "$name"
  find "$name" -name score.json -exec cp {} "$name.json" \;
}
value() { sed -n "s/^ *\"$1\": \([0-9.e+-]*\),*$/\1/p" faulty.json; }

cat sound.yaml fault.yaml >faulty.yaml
mission faulty "$faulty" faulty.yaml "$@"
if grep -q '"outcome": "home",' faulty.json &&
  awk "BEGIN { exit !($(value rmse_m) <= 0.3 && $(value distance_from_start_m) <= 0.5 && $(value wrong_loop_closures) == 0) }"; then
  cp faulty.json sound.json
else
  mission sound "$sound" sound.yaml "$@"
fi
