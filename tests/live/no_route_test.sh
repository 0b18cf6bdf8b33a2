#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# no_route_test.sh RELAY: without a route for multicast a stage ends with 2 and says what to do.
set -u

if ! unshare -rn true 2>/dev/null; then
  echo "skipped: unshare -rn does not work here, so there is no private network" >&2
  exit 77
fi
said=$(unshare -rn "$1" 2>&1)
ended=$?
echo "$said"
[[ $ended == 2 && $said == *"ip route add 224.0.0.0/4 dev lo"* ]]
