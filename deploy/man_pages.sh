#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# man_pages.sh BIN OUT
# Writes a manual page OUT/PROGRAM.1.gz for each program adit* in BIN, from what it prints with --help, so that no page
# differs from its program; adit(1) has all commands. A program without --help is a script: its first comment is its page.
set -euo pipefail
(($# == 2)) || { echo "usage: man_pages.sh BIN OUT" >&2; exit 2; }
bin=$1 out=$2
mkdir -p "$out"
version=$("$bin/adit" --version)
# The same on every computer: lines of a page are as the program prints them, and the page has no date.
export LC_ALL=C.UTF-8 COLUMNS=100
unset ADIT_CONFIG ADIT_SEAL_KEY LCM_DEFAULT_URL

# verbatim: lines for roff as they are.
verbatim() {
  echo .nf
  sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"
  echo .fi
}

heading() { printf '.SH %s\n' "$1"; }

# begin PROGRAM PURPOSE
begin() {
  printf '.TH %s 1 "" "%s" "Adit"\n' "${1^^}" "$version"
  heading NAME
  printf '%s \\- %s\n' "${1//-/\\-}" "${2%.}"
}

# help_page PROGRAM: purpose, usage, and the rest of --help.
help_page() {
  local help
  help=$("$bin/$1" --help)
  begin "$1" "$(head -n 1 <<<"$help")"
  heading SYNOPSIS
  sed -n 's/^Usage: //p' <<<"$help" | head -n 1 | verbatim
  heading DESCRIPTION
  sed -e '1d' -e '/^Usage: /d' <<<"$help" | verbatim
}

commands_of_adit() { "$bin/adit" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]\+\) .*/\1/p'; }

for program in "$bin"/adit*; do
  name=${program##*/}
  case $name in
    adit-watch) echo '.so man1/adit-supervisor.1' ;;   # started by adit-supervisor alone
    adit-record)
      begin "$name" "record all that is on LCM"
      heading DESCRIPTION
      sed -n '3,/^[^#]/{s/^#$//;s/^# //p}' "$program" | sed 1d | verbatim
      ;;
    *) help_page "$name" ;;
  esac >"$out/$name.1"
  if [[ $name == adit ]]; then
    heading COMMANDS
    for command in $(commands_of_adit); do
      printf '.SS adit %s\n' "$command"
      "$bin/adit" "$command" --help | verbatim
    done
    heading "SEE ALSO"
    ls "$bin" | sed -n 's/^adit-\(.*\)/\\fBadit\\-\1\\fR(1)/p' | paste -sd, | sed 's/,/, /g'
  fi >>"$out/$name.1"
  gzip -9nf "$out/$name.1"
done
