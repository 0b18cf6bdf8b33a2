#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# loops_at_scale.sh [LOOPS...]
# Prints the CPU time of lazy data association against the number of right loops (default: 500 to 50,000) on
# generated graphs of as many poses, clean and with as many wrong loops as right ones, and the slopes
# in log-log: 1 where the time is proportional to the loops. LIMIT_S (600) is the limit of CPU time of a graph.
# Run it on an idle computer.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

loops=("$@")
((${#loops[@]})) || loops=(500 1000 2000 5000 10000 20000 50000)
limit_s=${LIMIT_S:-600}
seed=5  # a grid with a drift of 0.0088, wrong loops at random

rows() {  # WRONG_SHARE
  local count
  for count in "${loops[@]}"; do
    (
      ulimit -t "$limit_s"
      exec "$programs/generated_graphs_table" --first "$seed" --count 1 --only lazy \
        --poses "$count" --right "$count" --wrong-share "$1"
    ) | tail -n +2 || { echo "$count loops take more than $limit_s s" >&2 && break; }
  done
}

# From rows of generated_graphs_table; slope: to the row before, then by least squares over all.
table() {
  awk -F, '
    BEGIN {
      print "| poses | right | wrong | right accepted | wrong accepted | CPU (s) | slope |"
      print "|---|---|---|---|---|---|---|"
    }
    {
      x = log($5 + $6); y = log($12 > 0 ? $12 : 0.01)
      slope = n++ ? sprintf("%.2f", (y - last_y) / (x - last_x)) : ""
      printf "| %d | %d | %d | %d | %d | %.2f | %s |\n", $4, $5, $6, $9, $10, $12, slope
      last_x = x; last_y = y
      sx += x; sy += y; sxx += x * x; sxy += x * y
    }
    END { if (n > 1) printf "\nSlope over all: %.2f\n", (n * sxy - sx * sy) / (n * sxx - sx * sx) }'
}

build generated_graphs_table
conditions 'one run'
for share in 0 0.5; do
  echo "### Share of wrong loops: $share"
  echo
  rows "$share" | table
  echo
done
