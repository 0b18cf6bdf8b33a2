#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# check_package.sh [BUILD]
# Makes the Debian package of a build (build/release) in a scratch folder and looks at it: what is in it, what it
# depends on, whether its programs run from where it is unpacked, know the robot's configuration and find
# what came with them; whether systemd takes the units. Ends with 77 where there are no tools for that.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
build=$(readlink -f "${1:-$root/build/release}")
for tool in cpack dpkg-deb dpkg-shlibdeps; do
  command -v "$tool" >/dev/null || { echo "skipped: there is no $tool (dpkg-dev)" >&2; exit 77; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

cpack -G DEB --config "$build/CPackConfig.cmake" -B "$scratch" >"$scratch/cpack.log" 2>&1 ||
  { cat "$scratch/cpack.log" >&2; fail "cpack"; }
package=$(echo "$scratch"/adit_*.deb)
tree=$scratch/tree
dpkg-deb -x "$package" "$tree"
dpkg-deb -e "$package" "$scratch/control"

for file in etc/adit/robot.{yaml,cfg} etc/default/adit usr/lib/sysctl.d/60-adit-lcm.conf \
  usr/lib/systemd/system/adit-{guard,supervisor,loopback}.service usr/share/adit/worlds/bruceton.yaml \
  usr/share/adit/config/{groundhog,simulated}.yaml usr/share/adit/processes/simulated.cfg \
  usr/share/doc/adit/{README.md,deploy.md,copyright} usr/bin/adit-record; do
  [[ -f $tree/$file ]] || fail "$file is not in the package"
done
if [[ -f $build/share/adit/viewer/page.html ]]; then   # built where npm is
  cmp -s "$build/share/adit/viewer/page.html" "$tree/usr/share/adit/viewer/page.html" || fail "the page is not in the package"
fi
for program in "$build"/bin/adit*; do
  [[ -x $tree/usr/bin/${program##*/} ]] || fail "${program##*/} is not in the package"
  [[ -s $tree/usr/share/man/man1/${program##*/}.1.gz ]] || fail "${program##*/} has no manual page"
done
for package_needed in adduser liblcm-bin liblcm1 libcholmod3 liboctomap libsodium23 libyaml-cpp; do
  grep -q "^Depends:.*\b$package_needed" "$scratch/control/control" || fail "does not depend on $package_needed"
done
while read -r file; do [[ -f $tree$file ]] || fail "conffile $file"; done <"$scratch/control/conffiles"
sh -n "$scratch/control/postinst" || fail "postinst"

# The programs, from a folder where there is nothing else.
cd "$scratch"
bin=$tree/usr/bin
programs=0
for program in "$bin"/adit*; do
  name=${program##*/}
  case $name in adit-watch | adit-record) continue ;; esac   # for the supervisor, and without help
  "$program" --help >/dev/null || fail "$name --help"
  programs=$((programs + 1))
  case $name in adit | adit-sim) continue ;; esac
  device=()
  "$program" --help | grep -q '^ *DEVICE ' && device=(front)   # a driver
  "$program" "${device[@]}" --config "$tree/etc/adit/robot.yaml" --print-config >/dev/null || fail "$name with robot.yaml"
  "$program" "${device[@]}" --config simulated.yaml --print-config >/dev/null || fail "$name does not find simulated.yaml"
done
"$bin/adit" sim bruceton --describe "$scratch/mine.yaml" && [[ -s $scratch/mine.yaml ]] || fail "a world by name"
"$bin/adit" sim "$tree/usr/share/adit/worlds/straight.yaml" --describe "$scratch/other.yaml" || fail "a world file"
# The list is found: else that would be the error.
echo 'supervisor: {processes: simulated.cfg, start_script: none}' >"$scratch/list.yaml"
"$bin/adit-supervisor" --config "$scratch/list.yaml" --lcm-url memq:// 2>"$scratch/list.err" || true
grep -q 'simulated.cfg has no script "none"' "$scratch/list.err" || fail "the list: $(cat "$scratch/list.err")"
(source "$tree/usr/share/bash-completion/completions/adit" && complete -p adit >/dev/null) || fail "completion"

# The pages have what the programs print, and every command of adit.
for command in $("$bin/adit" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
  zcat "$tree/usr/share/man/man1/adit.1.gz" | grep "^\.SS adit $command$" >/dev/null || fail "adit(1) has no $command"
done
if command -v man >/dev/null; then
  for page in "$tree"/usr/share/man/man1/*.gz; do
    case $page in */adit-watch.1.gz) continue ;; esac   # the page of adit-supervisor
    warnings=$(man --warnings -l "$page" 2>&1 >/dev/null) || fail "man $page"
    [[ -z $warnings ]] || fail "$page: $warnings"
  done
fi

units="no systemd-analyze here"
if command -v systemd-analyze >/dev/null; then
  sed -i "s|/usr/bin|$bin|" "$tree"/usr/lib/systemd/system/adit-*.service
  # Its pages are not installed here.
  sed -i 's|man:[^ ]* ||' "$tree"/usr/lib/systemd/system/adit-*.service
  systemd-analyze verify "$tree"/usr/lib/systemd/system/adit-*.service >"$scratch/units" 2>&1 &&
    [[ ! -s $scratch/units ]] || fail "units: $(cat "$scratch/units")"
  units="systemd takes the units"
fi
echo "$(basename "$package"): $(find "$tree" -type f | wc -l) files, $programs programs run; $units"
