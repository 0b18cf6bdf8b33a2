#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# lint.sh [BUILD [FILE..]]
# Checks the layout of the sources (clang-format) and runs clang-tidy with the compile commands of a build folder
# (build/release, or build/dev if it does not exist) on all sources except tests, or on the given ones. Sources that the
# build compiles as one are also checked as one, since most of the time goes into shared headers.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
cd "$root"
build=${1:-}
[[ -n $build ]] || { [[ -d build/release ]] && build=build/release || build=build/dev; }
build=$(readlink -f "$build")
shift || true

# Clang cannot read GCC's precompiled headers; the sources include what they use anyway. Each source of a unity file gets
# the command of that file, so that it can be checked alone.
commands=$(mktemp -d)
trap 'rm -r "$commands"' EXIT
sed 's| -Winvalid-pch -include [^ ]*||' "$build/compile_commands.json" | awk '
  /^  "directory":/ { directory = $0 }
  /^  "command":/ { command = $0 }
  /^\]/ { printf "%s", members }
  { print }
  /^  "file": .*\/Unity\// {
    split($0, quoted, "\"")
    while ((getline line < quoted[4]) > 0) {
      if (split(line, included, "\"") < 3) continue
      sub(/-c [^ ]*"/, "-c " included[2] "\"", command)
      members = members ",\n{\n" directory "\n" command "\n  \"file\": \"" included[2] "\"\n}\n"
    }
  }' >"$commands/compile_commands.json"

if (($#)); then
  sources=("$@")
  tidied=("$@")
else
  mapfile -t sources < <(find common procs drivers sim tools viewer tests -name '*.[hc]pp' | sort)
  mapfile -t tidied < <(sed -n 's|^  "file": "\(.*\)"$|\1|p' "$build/compile_commands.json" |
    grep -v -e "^$root/tests/" -e "^$build/tests/" -e precompiled -e cmake_pch)
fi

failed=0
clang-format --dry-run -Werror "${sources[@]}" || failed=1

# One process per file, without the counts that clang-tidy prints on standard error.
tidy() { clang-tidy -p "$1" --quiet "$2" 2> >(grep -v 'warnings\? generated' >&2); }
export -f tidy
printf '%s\n' "${tidied[@]}" | grep '\.c\(pp\|xx\)$' |
  xargs -P "$(nproc)" -I{} bash -c 'tidy "$0" "$1"' "$commands" {} || failed=1

((failed)) && echo "lint: see above" >&2 || echo "lint: ${#sources[@]} files passed"
exit $failed
