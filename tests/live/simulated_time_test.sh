#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# simulated_time_test.sh ADIT SIM SCAN_MATCHING CHECK_SIMULATED
# The simulator as fast as it goes waits for the stages, which lose nothing.
set -eu
here=$(dirname "$(readlink -f "$0")")
kSeconds=25   # simulated

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$here/in_private_network.sh" "$here/simulate.sh" "$scratch/run.lcmlog" "$1" "$2" "$3" \
  "$here/bent_drift.yaml" "$kSeconds"
"$4" "$scratch/run.lcmlog" "$kSeconds"
