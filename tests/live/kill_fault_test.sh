#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# kill_fault_test.sh SIM SCAN_MATCHING
# A kill fault kills the stage started beside the simulator, and no other process of the same name.
set -u
here=$(dirname "$(readlink -f "$0")")

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/in_private_network.sh" "$0" "$@"
fi
sim=$1; scan_matching=$2
kKilled=137   # exit status of a process killed by SIGKILL

unrelated=$("$scan_matching" --sim-time >/dev/null & echo $!)   # its parent exits with the subshell
"$scan_matching" --sim-time & sibling=$!
trap 'kill "$unrelated" "$sibling" 2>/dev/null' EXIT
"$sim" "$here/bent_tunnel.yaml" --speed 5 --for 3 --fault kill:scan_matching@1 || exit 1
wait "$sibling"; sibling_exit=$?
if ((sibling_exit != kKilled)); then echo "the sibling exited with $sibling_exit" >&2; exit 1; fi
if ! kill -0 "$unrelated"; then echo "an unrelated process was killed" >&2; exit 1; fi
