#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# structure.sh [CHECKOUT]
# Prints the figures of docs/results/structure.md for a checkout (default: this one): number and length of the
# sources, and sources per folder, without tests. Lines of substance exclude blank lines, comments, #include and
# namespace lines. A header with one function has one free function and no type.
set -euo pipefail
cd "${1:-$(dirname "$(dirname "$(dirname "$(readlink -f "$0")")")")}"

sources() { git ls-files -- common procs sim tools | grep -E '\.(hpp|cpp)$' | while read -r f; do [[ -f $f ]] && echo "$f"; done; }

# file, lines, lines of substance, free functions, types
figures() {
  sources | xargs awk '
    function finish() { if (file != "") print file "\t" lines "\t" substance "\t" functions "\t" types }
    FNR == 1 { finish(); file = FILENAME; lines = substance = functions = types = 0 }
    { ++lines }
    /^[[:space:]]*$/ || /^[[:space:]]*\/\// || /^#(include|pragma)/ || /^(namespace|}  \/\/ namespace)/ { next }
    { ++substance }
    /^(class|struct|enum|union|template|using|constexpr|inline constexpr|extern)/ && !/\(/ { ++types }
    /^[A-Za-z\[].*\(/ && !/^(class|struct|enum|using|static_assert|#)/ { ++functions }
    END { finish() }'
}

all=$(figures)
count=$(wc -l <<<"$all")
echo "sources: $count"
echo "lines: $(awk -F'\t' '{ n += $2 } END { print n }' <<<"$all")"
echo "median lines of a source: $(cut -f2 <<<"$all" | sort -n | sed -n "$(((count + 1) / 2))p")"
echo "sources with at most 20 lines of substance: $(awk -F'\t' '$3 <= 20' <<<"$all" | wc -l)"
echo "headers with one function: $(awk -F'\t' '$1 ~ /hpp$/ && $4 == 1 && $5 == 0' <<<"$all" | wc -l)" \
  "of $(awk -F'\t' '$1 ~ /hpp$/' <<<"$all" | wc -l)"
echo "fullest folders:"
cut -f1 <<<"$all" | xargs -n1 dirname | sort | uniq -c | sort -rn | sed -n 1,5p
