#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# survey_changes.sh DIR [FIRST_SEED [COUNT]]
# Prints what adit survey compare finds between two missions in one mine, each with its own errors of all sensors: random mines
# that have not changed (COUNT of them, 6 if not given), and one in which a wall has moved by 0.1 m and 0.5 m³ have fallen, each
# four times. DIR takes the missions; those that are there are used again.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

folder=$(realpath -m "$1")
first=${2:-1}
count=${3:-6}
mine=$root/tests/eval/survey/changing_mine.yaml
worlds=(random random_level)
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

# survey NAME NOISE_SEED WORLD..
survey() {
  local name=$1
  echo "sim: {noise_seed: $2}" >"$folder/$name.yaml"
  shift 2
  [ -d "$folder/$name" ] || "$adit" mission "$@" --in-process --config "$folder/$name.yaml" --out "$folder/$name" \
    >"$folder/$name.log" 2>&1 || true
  [ -d "$folder/survey_$name" ] || "$adit" survey "$folder/$name" --out "$folder/survey_$name" >>"$folder/$name.log" 2>&1
}

# compare TEXT OLDER NEWER [--by-coordinates]: a row for the pair, and one for each region of change
compare() {
  local result=$folder/change_$3${4:-}
  local mode=${4:-by the clouds}
  "$adit" survey compare "$folder/survey_$2" "$folder/survey_$3" --out "$result" "${@:4}" >"$result.log" 2>&1
  sed -nE "s/^([0-9]+) m² of surface are seen by both; level of detection ([0-9.]+) m .*; ([0-9.]+) % exceed it.*/| $1 | ${mode#--} | \2 | \3 % of \1 m² |/p" \
    "$result.log"
  sed -nE 's/^  [0-9]+: (.*)/| | | | \1 |/p' "$result.log"
}

conditions "one run each, random mines of seeds $first to $((first + count - 1))"
echo '| surveys | registration | level of detection (95 %, median, m) | area above it, regions of change |'
echo '|---|---|---|---|'
for ((seed = first; seed < first + count; ++seed)); do
  world=${worlds[seed % 2]}
  for noise in 1 2; do survey "mine_${seed}_$noise" "$((2 * seed + noise))" "$world" --seed "$seed"; done
  compare "$world $seed, unchanged" "mine_${seed}_1" "mine_${seed}_2"
done
for set in 0 1 2 3; do
  survey "before_$set" "$((10 * set + 1))" "$mine"
  survey "again_$set" "$((10 * set + 2))" "$mine"
  survey "changed_$set" "$((10 * set + 5))" "$folder/changed_mine.yaml"
  compare "unchanged ($set)" "before_$set" "again_$set"
  compare "changed ($set)" "again_$set" "changed_$set"
  compare "changed ($set)" "again_$set" "changed_$set" --by-coordinates
done
