#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# kill_fault_test.sh SIM SCAN_MATCHING
# A fault that kills a stage kills the one that was started beside the simulator, and no other.
set -u
here=$(dirname "$(readlink -f "$0")")

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/in_private_network.sh" "$0" "$@"
fi
sim=$1; scan_matching=$2
kKilled=137   # how a shell says SIGKILL

stranger=$("$scan_matching" --sim-time >/dev/null & echo $!)   # its parent ends with the subshell
"$scan_matching" --sim-time & sibling=$!
trap 'kill "$stranger" "$sibling" 2>/dev/null' EXIT
"$sim" "$here/bent_tunnel.yaml" --speed 5 --for 3 --fault kill:scan_matching@1 || exit 1
wait "$sibling"; sibling_exit=$?
if ((sibling_exit != kKilled)); then echo "the sibling ended with $sibling_exit" >&2; exit 1; fi
if ! kill -0 "$stranger"; then echo "a stranger was killed" >&2; exit 1; fi
