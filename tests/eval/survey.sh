#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# survey.sh DIR [FIRST_SEED [COUNT]]
# Prints the tables of docs/results/survey.md: missions in random mines (level ones and ones with slopes, by turns), surveyed
# without control and with four control points, against the true mesh. DIR takes the folders of the missions; those that are
# there are used again. A mission takes one to five minutes.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

folder=$(realpath -m "$1")
first=${2:-1}
count=${3:-10}
worlds=(random random_level)

build adit survey_table
mkdir -p "$folder"
missions=()
for ((seed = first; seed < first + count; ++seed)); do
  mission=$folder/mission_$seed
  [ -d "$mission" ] || "$root/build/release/bin/adit" mission "${worlds[seed % 2]}" --seed "$seed" --in-process \
    --out "$mission" >"$mission.log" 2>&1 || true
  missions+=("$mission")
done

conditions "one run each, seeds $first to $((first + count - 1))"
"$programs/survey_table" "${missions[@]}"
echo
echo "With four control points (standard deviation 0.02 m):"
"$programs/survey_table" "${missions[@]}" --control 4
