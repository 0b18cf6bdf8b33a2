#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# slurm_test.sh ADIT [UNITS]
# A campaign on a real Slurm cluster on this computer, of UNITS (default 40, at least 20) small units. During it the
# collector is killed and started again, slurmctld is restarted, and a node is killed with its units; one unit crashes,
# one takes too much memory, one hangs. All rows must be there in the end, the three with their reasons, and the same
# campaign with --on local must give the same rows. Exit code 77 (skipped) if Slurm does not run here.
set -eu
here=$(dirname "$(readlink -f "$0")")

# Root needs no user namespace, in which slurmd could not set groups. All daemons end with the namespace of processes.
if [[ -z ${IN_PRIVATE_NETWORK:-} ]]; then
  flags=(--net --pid --fork --kill-child --mount-proc)
  ((EUID == 0)) || flags+=(--map-root-user)
  unshare "${flags[@]}" true 2>/dev/null || { echo "skipped: unshare ${flags[*]} is not permitted" >&2; exit 77; }
  IN_PRIVATE_NETWORK=1 exec unshare "${flags[@]}" "$0" "$@"
fi

adit=$1
units=${2:-40}
# shellcheck source=tests/live/slurm/cluster.sh
. "$here/cluster.sh"
folder=$(mktemp -d)
nodes=()
trap 'stop_cluster; rm -rf "$folder"' EXIT
command -v sqlite3 >/dev/null || { echo "skipped: no sqlite3" >&2; exit 77; }
start_cluster "$folder/cluster"
echo "nodes: ${nodes[*]}"

# The token tells apart two runs of one unit.
cat >"$folder/campaign.yaml" <<'END'
campaign:
  command: >-
    sh -c 'case {n} in 3) kill -SEGV $$;; 4) tail /dev/zero;; 5) sleep 1000;; esac; sleep 0.4; echo {n} >>runs;
    echo "{{\"value\": $(({n} * {n})), \"token\": \"$(cat /proc/sys/kernel/random/uuid)\"}}" >{out}/score.json'
  time_max_s: 10
  memory_max_mb: 200
  scores:
    - {name: value, file: score.json, pointer: /value}
    - {name: token, file: score.json, pointer: /token}
  rates:
    - {name: with a value, condition: value > 0, min: 0.5}
matrix:
END
echo "  n: {from: 1, to: $units}" >>"$folder/campaign.yaml"

query() { sqlite3 -readonly "$folder/$1/campaign.db" "$2"; }
results() { query slurm 'SELECT count(*) FROM campaign WHERE state IS NOT NULL' 2>/dev/null || echo 0; }
has_results() { reconcile_nodes; (($(results) >= $1)); }
has_ended() { reconcile_nodes; ! kill -0 "$collector" 2>/dev/null; }
fail() {
  echo "FAILED: $*" >&2
  tail -n 20 "$folder"/cluster/log/slurm* "$folder/slurm.log" "$folder"/slurm/slurm/*.log >&2 || true
  exit 1
}
start_collector() {
  "$adit" campaign "$folder/campaign.yaml" --out "$folder/slurm" --on slurm >>"$folder/slurm.log" 2>&1 &
  collector=$!
}
# Processes of units on a node.
processes_of_node() { grep -lzs "^SLURMD_NODENAME=$1\$" /proc/[0-9]*/environ | cut -d/ -f3; }

start_collector
until_true 60 has_results $((units / 8)) || fail "no results"
kill -KILL "$collector"
wait "$collector" 2>/dev/null || true
echo "$SECONDS s: collector killed after $(results) results"
kill -KILL "$controller_pid"
start_controller
start_collector
until_true 60 has_results $((units / 4)) || fail "no results after the restart of slurmctld"
node=${nodes[-1]}
kill -KILL "$(node_pid "$node")"
processes_of_node "$node" | xargs -r kill -KILL 2>/dev/null || true
echo "$SECONDS s: node $node killed after $(results) results"
until_true 60 has_results $((units / 2)) || [[ ${#nodes[@]} == 1 ]] || fail "no results without a node"
start_node "$node"
until_true 300 has_ended || fail "the campaign does not end: $(results) results"
wait "$collector" || fail "exit code $?"
echo "$SECONDS s: the campaign has ended"
cat "$folder/slurm.log"

[[ $(results) == "$units" ]] || fail "$(results) rows"
states=$(query slurm "SELECT n, state, reason FROM campaign WHERE state <> 'ended' ORDER BY n")
[[ $states == "3|crashed|killed by SIGSEGV
4|memory limit|more than 200 MB
5|time limit|more than 10 s" ]] || fail "$states"

# Each row is the one result that is on the disk, whatever ran twice.
while IFS='|' read -r id token; do
  grep -q "$token" "$folder/slurm/units/$id/out/score.json" || fail "unit $id has another result"
done < <(query slurm "SELECT id, token FROM campaign WHERE state = 'ended'")
echo "units that ran: $(sort -u "$folder/runs" | wc -l), runs: $(wc -l <"$folder/runs")"

"$adit" campaign "$folder/campaign.yaml" --out "$folder/local" >/dev/null
rows='SELECT unit, id, parameters, state, reason, exit_code, n, value FROM campaign'
diff <(query slurm "$rows") <(query local "$rows") || fail "another table with --on local"
echo "$SECONDS s: all $units rows, the same as with --on local"
