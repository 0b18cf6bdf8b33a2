#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mapping.sh [--update] [RUNS]
# Builds optimised (preset ci) and prints the figures of docs/results/mapping.md; --update puts them into
# the page, behind its last heading. To be run while the machine has nothing else to do.
set -euo pipefail
root=$(dirname "$(dirname "$(dirname "$(readlink -f "$0")")")")
page=$root/docs/results/mapping.md
. "$root/tests/eval/page.sh"

update=
[[ ${1:-} == --update ]] && { update=yes; shift; }
runs=${1:-3}
cd "$root"
cmake --preset check >/dev/null
cmake --build --preset check --target mapping_table >&2
figures=$(conditions "$page" "$runs"; build/release/tests/mapping_table --runs "$runs")
if [[ $update ]]; then put "$page" "$figures"; else echo "$figures"; fi
