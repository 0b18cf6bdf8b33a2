#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# district.sh [POSES...]
# Prints wall time, CPU time and peak memory of `adit optimize` on generated graphs with as many loops as poses (default: 1,000 to
# 1,000,000), and the wall time of adding a run of 1,000 poses to the optimum: the rows of docs/results/district.md. A robot
# walks at random on streets 10 m apart and links each pose to the last two poses at the same place. Odometry errs by
# 0.01 m and 0.001 rad per metre, loops by 0.05 m and 0.01 rad. The run is its next 1,000 m.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

sizes=("$@")
((${#sizes[@]})) || sizes=(1000 10000 100000 1000000)
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

graph() {  # POSES RUN_FILE
  awk -v n="$1" -v run="$2" -v further=1000 '
    function out(i) { return i < n ? "/dev/stdout" : run }
    function normal(  u, v) {
      do u = rand(); while (u == 0)
      v = rand()
      return sqrt(-2 * log(u)) * cos(6.283185307179586 * v)
    }
    BEGIN {
      srand(1)
      side = 10 * int(sqrt(n / 20) / 2 + 2)  # of the square, so that each place is passed about ten times
      split("1 0 -1 0", dx, " "); split("0 1 0 -1", dy, " ")
      x = y = 0; heading = 0; loops = 0
      for (i = 0; i < n + further; ++i) {
        printf "VERTEX_SE2 %d %d %d %.6f\n", i, x, y, heading * 1.5707963267948966 > (out(i))
        place = x "," y
        count = split(seen[place], last, " ")
        for (k = 1; k <= count && loops <= i; ++k) {
          split(last[k], pose, ":")
          turn = (heading - pose[2]) * 1.5707963267948966
          printf "EDGE_SE2 %d %d %.6f %.6f %.6f 400 0 0 400 0 10000\n", pose[1], i, 0.05 * normal(), 0.05 * normal(), turn + 0.01 * normal() > (out(i))
          ++loops
        }
        seen[place] = i ":" heading (count ? " " last[1] : "")
        before = heading
        if (x % 10 == 0 && y % 10 == 0) {
          do {
            r = int(4 * rand()); heading = (r == 2) ? before : (before + r) % 4
            fx = x + 10 * dx[heading + 1]; fy = y + 10 * dy[heading + 1]
          } while (fx < 0 || fy < 0 || fx > side || fy > side || heading == (before + 2) % 4)
        }
        # One step ahead after the turn: the displacement is in the frame of the pose before.
        turn = (heading - before) * 1.5707963267948966
        x += dx[heading + 1]; y += dy[heading + 1]
        if (i + 1 < n + further)
          printf "EDGE_SE2 %d %d %.6f %.6f %.6f 10000 0 0 10000 0 1000000\n", i, i + 1, cos(turn) + 0.01 * normal(), sin(turn) + 0.01 * normal(), turn + 0.001 * normal() > (out(i + 1))
        if (i + 1 == n) of_graph = loops
      }
      print of_graph > "/dev/stderr"
    }'
}

build adit
conditions "one run"
echo "| poses | loops | objective per degree of freedom | wall (s) | CPU (s) | peak memory (MB) | run of 1,000 poses added (s); steps; factorisations |"
echo "|---|---|---|---|---|---|---|"
for poses in "${sizes[@]}"; do
  loops=$(graph "$poses" "$folder/run.g2o" 2>&1 >"$folder/graph.g2o")
  /usr/bin/time -f '%e %U %M' -o "$folder/time" "$root/build/release/bin/adit" optimize "$folder/graph.g2o" >"$folder/result.json"
  read -r wall cpu memory <"$folder/time"
  "$root/build/release/bin/adit" optimize "$folder/graph.g2o" --add "$folder/run.g2o" >"$folder/added.json"
  python3 - "$folder/result.json" "$folder/added.json" "$poses" "$loops" "$wall" "$cpu" "$memory" <<'PYTHON'
import json, sys
result = json.load(open(sys.argv[1]))
run = json.load(open(sys.argv[2]))["added"][0]
poses, loops = int(sys.argv[3]), int(sys.argv[4])
added = f"{run['wall_ms'] / 1e3:.2f}; {run['iterations']}; {run['factorisations']}"
print(f"| {poses} | {loops} | {result['objective'] / (3 * loops):.2f} | {sys.argv[5]} | {sys.argv[6]} | {int(sys.argv[7]) / 1024:.0f} | {added} |")
PYTHON
done
