#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# lint.sh [BUILD [FILE..]]
# Checks the layout of the sources (clang-format) and runs clang-tidy with the compile commands of a build folder
# (build/release, or build/dev if it does not exist) on all sources except tests, or on the given ones. All sources are
# checked in batches, since most of the time goes into shared headers (lint_batches.awk).
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
cd "$root"
build=${1:-}
[[ -n $build ]] || { [[ -d build/release ]] && build=build/release || build=build/dev; }
build=$(readlink -f "$build")
shift || true

# A copy of the configuration beside the batches: with --config-file clang-tidy would name-check library headers too.
# Clang cannot read GCC's precompiled headers; the sources include what they use anyway. Each source of a unity file gets
# the command of that file, so that it can be checked alone.
batches=$(mktemp -d)
trap 'rm -r "$batches"' EXIT
cp .clang-tidy "$batches"
sed 's| -Winvalid-pch -include [^ ]*||' "$build/compile_commands.json" | awk '
  /^  "directory":/ { directory = substr($0, 17, length - 18) }
  /^  "command":/ { command = substr($0, 15, length - 16) }
  /^  "file":/ {
    split($0, quoted, "\"")
    source = quoted[4]
    if (source !~ /\/Unity\//) { print directory "\t" command "\t" source; next }
    while ((getline line < source) > 0) {
      if (split(line, included, "\"") < 3) continue
      alone = command
      sub(/-c [^ ]*$/, "-c " included[2], alone)
      print directory "\t" alone "\t" included[2]
    }
  }' >"$batches/commands"
awk -v out="$batches" -v skipped="^($root|$build)/tests/|precompiled|cmake_pch" \
  -f deploy/lint_batches.awk "$batches/commands" >"$batches/names"

if (($#)); then
  sources=("$@")
  tidied=("$@")
else
  mapfile -t sources < <(find common procs drivers sim tools viewer tests -name '*.[hc]pp' | sort)
  mapfile -t tidied <"$batches/names"
fi

failed=0
clang-format --dry-run -Werror "${sources[@]}" || failed=1

# Without the counts that clang-tidy prints on standard error.
tidy() {
  clang-tidy -p "$1" --quiet "$2" 2> >(grep -v 'warnings\? generated' >&2)
}
# One file, or the sources of a batch.
tidy_all() {
  local list=${2%.cpp}.list source failed=0
  [[ $2 == "$1"/* ]] || { tidy "$1" "$2"; return; }
  tidy "$1" "$2" >"$list.out" 2>&1 && return
  while read -r source; do tidy "$1" "$source" || failed=1; done <"$list"
  ((failed)) || { echo "lint: checked one by one, as together they fail:"; cat "$list" "$list.out"; } >&2
  return $failed
}
export -f tidy tidy_all
printf '%s\n' "${tidied[@]}" | grep '\.c\(pp\|xx\)$' |
  xargs -P "$(nproc)" -I{} bash -c 'tidy_all "$0" "$1"' "$batches" {} || failed=1

((failed)) && echo "lint: see above" >&2 || echo "lint: ${#sources[@]} files passed"
exit $failed
