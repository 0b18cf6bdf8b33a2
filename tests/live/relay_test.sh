#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# relay_test.sh LIVE_LOGS RELAY: a log of this project, played and recorded by LCM's tools.
set -eu
here=$(dirname "$(readlink -f "$0")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$1" write "$scratch/played.lcmlog"
"$here/in_private_network.sh" "$here/record_node.sh" "$scratch/played.lcmlog" 1 \
  "$scratch/recorded.lcmlog" "$2"
"$1" check "$scratch/played.lcmlog" "$scratch/recorded.lcmlog"
