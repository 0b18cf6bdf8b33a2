#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# check_units.sh
# The exposure of each unit in systemd/ as systemd-analyze rates it, from 0 to 10: a table in Markdown. Fails if one is
# above 3.0, or if a directive has no effect because systemd does not know it. Needs no running systemd; exit code 77
# (skipped) where there is no systemd-analyze.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
kExposureMax=3.0

command -v systemd-analyze >/dev/null || { echo "skipped: no systemd-analyze, try: apt install systemd" >&2; exit 77; }
systemd-analyze security --help | grep -q -- --offline ||
  { echo "skipped: this systemd-analyze rates no files" >&2; exit 77; }

failed=0
echo "| unit | exposure |"
echo "|---|---|"
for unit in "$here"/systemd/*.service; do
  output=$(systemd-analyze security --offline=true --no-pager "$unit" 2>&1) || true
  level=$(sed -n 's/.*Overall exposure level for [^:]*: \([0-9.]*\).*/\1/p' <<<"$output")
  echo "| ${unit##*/} | ${level:-none} |"
  if [[ -z $level ]] || awk "BEGIN { exit !($level > $kExposureMax) }"; then
    echo "FAILED: ${unit##*/} is above $kExposureMax: systemd-analyze security --offline=true $unit" >&2
    failed=1
  fi
  if grep -E "Unknown (key|lvalue|section)|Failed to parse" <<<"$output" >&2; then failed=1; fi
done
exit $failed
