#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# survey_changes.sh DIR
# Prints what adit survey compare finds between missions in one mine: unchanged with other errors of all sensors, and with a wall
# that moved by 0.1 m and a fall of 0.5 m³. DIR takes the missions; those that are there are used again.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

folder=$(realpath -m "$1")
mine=$root/tests/eval/survey/changing_mine.yaml
build adit
adit=$root/build/release/bin/adit
mkdir -p "$folder"

# The wall x = 38 of the room is dug back by 0.1 m; a cone of 1 m radius and 0.48 m height has fallen from the roof.
{
  sed 's/38, 2, 38, 11/38.1, 2, 38.1, 11/' "$mine"
  echo '  props:'
  echo '    rubble:'
  echo '      - {tunnel: side, at_m: 7, across_m: 0.6, radius_m: 1.0, height_m: 0.48}'
} >"$folder/changed_mine.yaml"

# survey NAME WORLD SEED
survey() {
  echo "sim: {noise_seed: $3}" >"$folder/$1.yaml"
  [ -d "$folder/$1" ] || "$adit" mission "$2" --in-process --config "$folder/$1.yaml" --out "$folder/$1" \
    >"$folder/$1.log" 2>&1 || true
  [ -d "$folder/survey_$1" ] || "$adit" survey "$folder/$1" --out "$folder/survey_$1" >>"$folder/$1.log" 2>&1
}

survey before "$mine" 1
survey again "$mine" 2
survey changed "$folder/changed_mine.yaml" 5

conditions "one run each"
for pair in 'before again' 'again changed'; do
  read -r older newer <<<"$pair"
  for mode in '' --by-coordinates; do
    echo "$older, $newer $mode"
    # shellcheck disable=SC2086 # a mode or nothing
    "$adit" survey compare "$folder/survey_$older" "$folder/survey_$newer" --out "$folder/change_$newer$mode" $mode 2>&1
    echo
  done
done
