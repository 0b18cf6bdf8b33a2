#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mcap_test.sh ADIT WRITE_MISSION_LOG
# What adit export writes of a mission is read by an independent reader, npm's @mcap/core: every message decodes by its
# schema, times are in order, counts agree. Skipped without node or without its packages (npm ci in this folder).
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
adit=$1; write_mission_log=$2
if ! command -v node >/dev/null || [[ ! -d $here/node_modules/@mcap/core ]]; then
  echo "skipped: no node, or no packages, try: apt install nodejs npm; (cd tests/live/export && npm ci)" >&2
  exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$write_mission_log" "$scratch/run.lcmlog"
"$adit" export "$scratch/run.lcmlog" --mcap "$scratch/a.mcap"
node "$here/read_mcap.mjs" "$scratch/a.mcap" | tee "$scratch/topics"
for topic in /tf /pose /map /cloud /mission; do
  grep -q "^$topic [a-zA-Z.]* [1-9]" "$scratch/topics" || { echo "no message of $topic" >&2; exit 1; }
done

# The same from a compressed log.
"$adit" export "$scratch/run.lcmlog" --lcmlog "$scratch/run.lcmlog.zst"
"$adit" export "$scratch/run.lcmlog.zst" --mcap "$scratch/b.mcap"
cmp "$scratch/a.mcap" "$scratch/b.mcap"
"$adit" export "$scratch/run.lcmlog.zst" --lcmlog "$scratch/plain.lcmlog"
cmp "$scratch/run.lcmlog" "$scratch/plain.lcmlog"

# What cannot be written leaves nothing.
if "$adit" export "$scratch/run.lcmlog" --mcap /dev/full 2>"$scratch/error"; then exit 1; fi
grep -q "/dev/full" "$scratch/error"
echo "no log" >"$scratch/no.lcmlog"
if "$adit" export "$scratch/no.lcmlog" --mcap "$scratch/no.mcap" 2>/dev/null; then exit 1; fi
[[ ! -e $scratch/no.mcap ]]
