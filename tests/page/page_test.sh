#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# page_test.sh PAGE CASE [SHOTS [ADIT]]
# Tests PAGE as built. Cases:
#   units      decoding, state, width: without a browser
#   synthetic  Chromium: a mine of known geometry, live and as a file
#   florence   Chromium: mission.html of a mission in a mine whose end is flooded
# Screenshots are kept in the folder SHOTS. Ends with 77 where a prerequisite is missing.
set -euo pipefail
page=$1; case=$2
source=$(dirname "$(readlink -f "$0")")/../../viewer/page
skip() { echo "skipped: $*" >&2; exit 77; }

[[ -s $page ]] || skip "this build has no page of the viewer (npm)"
cd "$source"
[[ -d node_modules ]] || skip "npm ci has not run in viewer/page"
export ADIT_PAGE=$page
if [[ $case == units ]]; then exec npm run -s test; fi

ADIT_CHROMIUM=$(command -v chromium) || skip "there is no chromium"
shots=$3
rm -rf "$shots"
mkdir -p "$shots"
export ADIT_CHROMIUM ADIT_SCREENSHOTS=$shots
if [[ $case == synthetic ]]; then exec npm run -s test:browser -- synthetic; fi

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$4" mission florence --in-process --out "$scratch/out" >"$scratch/mission.text" 2>&1 ||
  { cat "$scratch/mission.text" >&2; exit 1; }
mv "$scratch/out/mission.html" "$shots/mission.html"
npm run -s test:browser -- florence "$shots/mission.html"
