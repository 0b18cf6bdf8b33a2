# shellcheck shell=bash disable=SC2034 # sourced
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Common part of the scripts that measure the figures of a page in docs/results. To be sourced.

set -euo pipefail
root=$(dirname "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")")
programs=$root/build/release/tests
cd "$root"

# build TARGET...: builds with optimization (preset bench) into $programs.
build() {
  cmake --preset bench >/dev/null
  cmake --build --preset bench --target "$@" >&2
}

# conditions RUNS: date, commit, computer and load of a measurement; RUNS as in "medians of 3 runs".
conditions() {
  local changes=
  git diff --quiet HEAD -- || changes=', with changes'
  echo "$(date +%F), commit $(git rev-parse --short HEAD)$changes, default configuration, $(nproc) cores of" \
    "$(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -1)," \
    "load before $(cut -d' ' -f1 /proc/loadavg), $1."
  echo
}
