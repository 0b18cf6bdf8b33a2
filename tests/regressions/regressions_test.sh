#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# regressions_test.sh ADIT [--open] [CASE..]
# Runs the missions that are kept here, by default all that must succeed, two at a time: the robot must return, be at the start by the
# truth, and have a map whose error is at most four times what the map allows. --open runs those that are open weaknesses instead, and prints how they end now.
set -u
adit=$(readlink -f "$1"); shift
open=
[[ ${1:-} == --open ]] && { open=yes; shift; }
here=$(dirname "$(readlink -f "$0")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cases=("$@")
if ((${#cases[@]} == 0)); then
  for world in "$here"/*/world.yaml; do
    folder=$(dirname "$world")
    is_open=; [[ -e $folder/open.txt ]] && is_open=yes
    [[ $is_open == "$open" ]] && cases+=("$(basename "$folder")")
  done
fi

# run CASE: prints "CASE: how it ended".
run() {
  local out=$scratch/$1
  "$adit" mission "$here/$1/world.yaml" --config "$here/$1/robot.yaml" --in-process --out "$out" >"$out.log" 2>&1
  local code=$? from_start of_allowed
  from_start=$(sed -n 's/.* \([0-9.]*\) m from the start at the end$/\1/p' "$out.log" | tail -1)
  of_allowed=$(sed -n 's/^ *"plan_of_allowed": \([0-9.e+-]*\),*$/\1/p' "$out/summary.json")
  if ((code == 0)) && awk "BEGIN { exit !(${from_start:-9} <= 0.5 && ${of_allowed:-9} <= 4) }"; then
    echo "$1: succeeds"
  else
    echo "$1: exit code $code, ${from_start:-?} m from the start, error of the map ${of_allowed:-?} of the allowed:" \
      "$(grep -v ' m from the start' "$out.log" | grep -A1 '^$' | tail -1 | head -c 200)"
  fi
  rm -rf "$out"
}
export -f run
export adit here scratch
results=$(printf '%s\n' "${cases[@]}" | xargs -P 2 -I '{}' bash -c 'run {}' | sort)
echo "$results"
[[ -n $open ]] || ! grep -vq ': succeeds$' <<<"$results"
