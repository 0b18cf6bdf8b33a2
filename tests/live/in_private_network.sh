#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# in_private_network.sh COMMAND [ARGUMENT..]
# Runs the command on a network of its own that has multicast on its loopback and nothing else, so
# that LCM there hears nobody and nobody hears it. Ends with 77 (skipped) where that cannot be had.
set -u

if ! unshare -rn true 2>/dev/null; then
  echo "skipped: unshare -rn does not work here, so there is no private network" >&2
  exit 77
fi
exec unshare -rn bash -c '
  ip link set lo up && ip route add 224.0.0.0/4 dev lo || { echo "skipped: no multicast" >&2; exit 77; }
  exec "$@"' in_private_network "$@"
