#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# slopes.sh DIR [SEED [JOBS [SENSORS..]]]
# Prints the table of grades of docs/results/slopes.md: missions up and down every grade, smooth and sudden, on smooth
# and rough floor. SENSORS: wheels_and_imu, without_wheels, without_imu; default all. DIR takes the folders of the
# missions. One mission takes about a minute, without wheels some seconds.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

folder=$(realpath -m "$1")
seed=${2:-2}
jobs=${3:-1}
sensors=("${@:4}")
[ ${#sensors[@]} -gt 0 ] || sensors=(wheels_and_imu without_wheels without_imu)

worlds=()
for percent in 3 5 8 12 16 20 25; do
  for sign in '' -; do
    for form in '' ,rough ,sudden ,rough,sudden; do worlds+=("grade:$sign$percent$form"); done
  done
done

mkdir -p "$folder"
echo 'sim: {}' >"$folder/wheels_and_imu.yaml"
echo 'sim: {wheel_odometry: {present: false}}' >"$folder/without_wheels.yaml"
echo 'sim: {imu: {present: false}}' >"$folder/without_imu.yaml"

build mission_table
conditions "one run, seed $seed"
for choice in "${sensors[@]}"; do
  printf '%s\n\n' "$choice"
  "$programs/mission_table" "${worlds[@]}" --seed "$seed" --jobs "$jobs" --out "$folder/$choice" \
    --config "$folder/$choice.yaml"
  echo
done
