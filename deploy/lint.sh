#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# lint.sh [BUILD [FILE..]]
# Checks the layout of the sources (clang-format) and runs clang-tidy over the .cpp files, all but the
# tests or the given ones, with the compile commands of a build folder (build/ci, or build/dev where it
# is absent).
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
cd "$root"
build=${1:-}
[[ -n $build ]] || { [[ -d build/ci ]] && build=build/ci || build=build/dev; }
shift || true

mapfile -t sources < <(find common procs sim tools tests -name '*.[hc]pp' 2>/dev/null | sort)
mapfile -t tidied < <(printf '%s\n' "${sources[@]}" | grep -v '^tests/')
((!$#)) || { sources=("$@"); tidied=("$@"); }

failed=0
clang-format --dry-run -Werror "${sources[@]}" || failed=1

# Clang reads the sources with the includes that they name themselves, not with what GCC precompiled.
commands=$(mktemp -d)
trap 'rm -r "$commands"' EXIT
sed 's| -Winvalid-pch -include [^ ]*||' "$build/compile_commands.json" >"$commands/compile_commands.json"

# One process for each file; what clang-tidy counts on standard error is of no interest.
tidy() { clang-tidy -p "$1" --quiet "$2" 2> >(grep -v 'warnings\? generated' >&2); }
export -f tidy
printf '%s\n' "${tidied[@]}" | grep '\.cpp$' |
  xargs -P "$(nproc)" -I{} bash -c 'tidy "$0" "$1"' "$commands" {} || failed=1

((failed)) && echo "lint: see above" >&2 || echo "lint: ${#sources[@]} files are fine"
exit $failed
