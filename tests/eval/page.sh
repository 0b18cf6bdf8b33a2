# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# What the scripts have in common that measure the figures of a page in docs/results. To be sourced.

# conditions PAGE RUNS: what was measured, when, and on what.
conditions() {
  local changes=
  git diff --quiet HEAD -- . ":!$1" || changes=', with changes'
  echo "$(date +%F), commit $(git rev-parse --short HEAD)$changes, default configuration, $(nproc) cores of" \
    "$(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -1)," \
    "load before $(cut -d' ' -f1 /proc/loadavg), medians of $2 runs."
  echo
}

# put PAGE TEXT: the text behind the heading of figures, the page's last.
put() {
  local new
  new=$(sed '/^## Figures/q' "$1"; echo; echo "$2")
  echo "$new" >"$1"
}
