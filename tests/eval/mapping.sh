#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mapping.sh [RUNS]
# Prints the figures of docs/results/mapping.md, with RUNS (3) runs of each log. Run it on an idle computer.
# shellcheck source=tests/eval/common.sh
. "$(dirname "$(readlink -f "$0")")/common.sh"

runs=${1:-3}
build mapping_table
conditions "medians of $runs runs"
"$programs/mapping_table" --runs "$runs"
