#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# narrow.sh DIR [JOBS [SEEDS..]]
# Prints the table of docs/results/narrow_tunnels.md, one for each seed, default 1 and 2: missions through
# tunnels of 1.3 to 2 m, straight, bent and necked. Passed is: home, and complete. DIR takes the folders of the
# missions. One mission takes half a minute, in 1.3 m one and a half.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

folder=$(realpath -m "$1")
jobs=${2:-1}
seeds=("${@:3}")
[ ${#seeds[@]} -gt 0 ] || seeds=(1 2)

worlds=()
for width_m in 1.3 1.4 1.5 1.6 1.8 2.0; do
  for shape in straight bent necked; do worlds+=("narrow:$width_m,$shape"); done
done

build mission_table
conditions 'one run for each seed'
for seed in "${seeds[@]}"; do
  printf 'Seed %s\n\n' "$seed"
  "$programs/mission_table" "${worlds[@]}" --seed "$seed" --jobs "$jobs" --out "$folder/seed_$seed"
  echo
done
