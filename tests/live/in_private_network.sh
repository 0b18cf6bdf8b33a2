#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# in_private_network.sh COMMAND [ARGUMENT..]
# Runs the command in a network namespace that has only a loopback interface with multicast, isolated from all
# other LCM traffic. Exit code 77 (skipped) if the namespace cannot be created.
set -u

if ! unshare -rn true 2>/dev/null; then
  echo "skipped: unshare -rn is not permitted, no private network" >&2
  exit 77
fi
exec unshare -rn bash -c '
  ip link set lo up && ip route add 224.0.0.0/4 dev lo || { echo "skipped: no multicast" >&2; exit 77; }
  exec "$@"' in_private_network "$@"
