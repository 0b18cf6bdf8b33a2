#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# install_dependencies.sh [GROUP..]
# Installs those Debian packages of packages.txt that are missing, of all groups or the given ones.
# Asks for a password only where something is missing and the caller is not root.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
groups=${*:-build test check spy}

is_installed() { [[ $(dpkg-query -W -f '${Status}' "$1" 2>/dev/null) == "install ok installed" ]]; }

missing=()
while read -r group package command; do
  [[ " $groups " == *" $group "* ]] || continue
  [[ -n $command ]] && command -v "$command" >/dev/null && continue
  is_installed "$package" || missing+=("$package")
done <"$here/packages.txt"
((${#missing[@]})) || exit 0

echo "Installing ${missing[*]}"
as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || { echo "not root, and no sudo: install them yourself" >&2; exit 2; }
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}"
