#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# lint.sh [BUILD [FILE..]]
# Checks the layout of the sources (clang-format) and runs clang-tidy over the .cpp files, all but the
# tests or the given ones, with the compile commands of a build folder (build/release, or build/dev where it
# is absent). Sources that the build compiles as one are also read as one: most of the time goes into the
# headers that they share.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
cd "$root"
build=${1:-}
[[ -n $build ]] || { [[ -d build/release ]] && build=build/release || build=build/dev; }
build=$(readlink -f "$build")
shift || true

# Clang cannot read what GCC precompiled; the sources name all includes themselves. Each source that is
# compiled together with others gets the command of the file that includes it, for who asks for it alone.
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
  mapfile -t sources < <(find common procs sim tools tests -name '*.[hc]pp' | sort)
  mapfile -t tidied < <(sed -n 's|^  "file": "\(.*\)"$|\1|p' "$build/compile_commands.json" |
    grep -v -e "^$root/tests/" -e "^$build/tests/" -e precompiled -e cmake_pch)
fi

failed=0
clang-format --dry-run -Werror "${sources[@]}" || failed=1

# One process for each file; what clang-tidy counts on standard error is of no interest.
tidy() { clang-tidy -p "$1" --quiet "$2" 2> >(grep -v 'warnings\? generated' >&2); }
export -f tidy
printf '%s\n' "${tidied[@]}" | grep '\.c\(pp\|xx\)$' |
  xargs -P "$(nproc)" -I{} bash -c 'tidy "$0" "$1"' "$commands" {} || failed=1

((failed)) && echo "lint: see above" >&2 || echo "lint: ${#sources[@]} files are fine"
exit $failed
