#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# build.sh FOLDER
# Builds the page into FOLDER/page.html: installs what the lock file names, unless it is installed already, checks types,
# bundles. Where the registry of npm cannot be reached the page is left out, with one line, and this ends with 0.
set -euo pipefail
folder=$(readlink -m "$1")
cd "$(dirname "$(readlink -f "$0")")"
log=$(mktemp)
trap 'rm -f "$log"' EXIT

installed=node_modules/.package-lock.json
if [[ ! $installed -nt package-lock.json ]]; then
  if ! npm ci --ignore-scripts --no-audit --no-fund >"$log" 2>&1; then
    echo "The viewer's page is left out: npm ci failed: $(grep -m 1 -o 'npm.* code .*' "$log" || tail -n 1 "$log")" >&2
    rm -f "$folder/page.html"
    exit 0
  fi
  touch "$installed"
fi
npm run -s build -- --outDir "$folder" --logLevel warn >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
