#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mission_soak.sh ADIT HOURS [WORLD]
# By hand, not in CI. Missions one after the other until so many hours of the clock are over; prints the
# memory of each process each minute (`adit ps`), so that what grows can be seen.
set -u
adit=$(readlink -f "$1"); hours=$2; world=${3:-bruceton}
kPeriodSeconds=60

scratch=$(mktemp -d)
mission=
trap '[[ -z $mission ]] || { kill -TERM $mission; wait $mission; }; rm -rf "$scratch"' EXIT
end=$(awk -v hours="$hours" -v now="$SECONDS" 'BEGIN { print int(now + 3600 * hours) }')
for ((n = 1; SECONDS < end; ++n)); do
  out=$scratch/$n
  "$adit" mission "$world" --seed "$n" --out "$out" >"$scratch/$n.text" 2>&1 & mission=$!
  echo; echo "Mission $n:"; echo
  while kill -0 "$mission" 2>/dev/null && ((SECONDS < end)); do
    sleep "$kPeriodSeconds" & wait -n "$mission" $!
    "$adit" ps --socket "$out/supervisor.sock" 2>/dev/null | sed 's/^/    /'
  done
  ((SECONDS < end)) || kill -TERM "$mission" 2>/dev/null
  wait "$mission"; echo; echo "ended with $?: $(grep 'from the start at the end' "$scratch/$n.text")"
  mission=
  rm -rf "$out"
done
