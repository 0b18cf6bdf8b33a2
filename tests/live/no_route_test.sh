#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# no_route_test.sh RELAY: without a multicast route, a stage exits with 2 and prints the required command.
set -u

if ! unshare -rn true 2>/dev/null; then
  echo "skipped: unshare -rn is not permitted, no private network" >&2
  exit 77
fi
output=$(unshare -rn "$1" 2>&1)
exit_code=$?
echo "$output"
[[ $exit_code == 2 && $output == *"ip route add 224.0.0.0/4 dev lo"* ]]
