#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# full_disk_test.sh ADIT [ADIT-STAGE ..]
# Every command of adit that writes, with a standard output that is full (/dev/full) and with files that cannot grow
# (ulimit -f): each exits with 2 and one line of error, and leaves no file under its final name. The commands are
# compared with adit --help, so that a new one is added here.
set -u
adit=$1; shift
here=$(dirname "$(readlink -f "$0")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/work" && cd "$scratch/work" || exit 1
failures=0
complain() { echo "FAILED: $*: $(head -c 300 err)" >&2; failures=$((failures + 1)); }

# Inputs.
"$adit" sample in.log --length-m 4 --truth in.tum >/dev/null || exit 1
"$adit" sample in.lcmlog --length-m 4 >/dev/null || exit 1
printf 'EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\n' > in.g2o
printf '1700000000.4 1700000001.4 0 0 0 0 0 0\n' > in.relations
"$adit" scan sample --out in_scan.lcmlog >/dev/null || exit 1
"$adit" export in.lcmlog --rosbag2 ../in_bag >/dev/null || exit 1
mkdir ../in_clouds && "$adit" scan sample --out ../in_clouds/1700000000.ply >/dev/null || exit 1
printf '1700000000 0 0 0 0 0 0 1\n' > in_poses.tum
printf '0 0\n1 0\n' > in.txt
printf 'campaign: {command: "true {n} {out}"}\nmatrix: {n: [1, 2]}\n' > in.yaml
printf 'campaign: {command: "true {n} {out}"}\nsearch: {failure: n > 2}\nspace: {n: [1, 2]}\n' > in_search.yaml
cp "$here/../../deploy/config/groundhog.yaml" in_robot.yaml
mapfile -t inputs < <(ls)

# Standard output: command lines that print a result.
declare -A prints=(
  [campaign]='campaign in.yaml --out out' [check]='check in_robot.yaml' [check-driver]='check-driver LASER_FRONT --log in.lcmlog'
  [check-stop]='check-stop guard --log in.lcmlog' [check-motion]='check-motion left --log in.lcmlog'
  [completion]='completion bash' [doctor]='doctor --seconds 0.2' [eval]='eval relations in.relations in.tum' [help]='--help' [version]='--version'
  [import]='import carmen in.log out.lcmlog' [import_bag]='import bag ../in_bag out.lcmlog'
  [import_clouds]='import clouds ../in_clouds out.lcmlog --poses in_poses.tum' [map]='map in.log --out out' [merge]='merge in.log --out out'
  [optimize]='optimize in.g2o'
  [plan]='plan in_scan.lcmlog --list' [sample]='sample out.log --length-m 2' [scan]='scan sample --out out.ply'
  [search]='search in_search.yaml --out out'
  [volume]='volume in_scan.lcmlog --out out')
# Files: command lines that write, and print nothing that matters.
declare -A writes=(
  [check_picture]='check in_robot.yaml --picture out.png' [drive]='drive sample --waypoints in.txt --out out.lcmlog'
  [export_mcap]='export in.lcmlog --mcap out.mcap' [export_lcm]='export in.lcmlog --lcmlog out.lcmlog.zst'
  [export_ros]='export in.lcmlog --rosbag2 out'
  [import]='import carmen in.log out.lcmlog' [import_bag]='import bag ../in_bag out.lcmlog'
  [import_clouds]='import clouds ../in_clouds out.lcmlog --poses in_poses.tum' [key]='key --new out.key' [map]='map in.log --out out' [map_lcm]='map in.lcmlog --out out'
  [merge]='merge in.log --out out'
  [optimize]='optimize in.g2o --out out.g2o' [optimize_gz]='optimize in.g2o --out out.g2o.gz'
  [plan]='plan in_scan.lcmlog --out out' [sample]='sample out.log --length-m 4'
  [sample_lcm]='sample out.lcmlog --length-m 4' [sample_truth]='sample out.log --length-m 4 --truth out.tum'
  [scan]='scan sample --out out.lcmlog' [scan_ply]='scan sample --out out.ply'
  [sim_view]='sim sample --view out.png' [sim_truth]='sim sample --truth out' [sim_describe]='sim sample --describe out.yaml'
  [volume]='volume in_scan.lcmlog --out out')
# Not here: these print what a supervisor or a mission answers, with the same check at the end (run_adit), or start
# a program; report, survey and mission need the log of a mission (tests/unit/tools). The database of a campaign or a search is never the same to
# the byte (tests/unit/tools/campaign, search).
elsewhere=' logs mission order ps reload report restart spy start stop survey view '

for command in $("$adit" --help | sed -n '/^Subcommands:/,/^$/p' | awk '/^  [a-z]/ {print $1}'); do
  [[ " ${!prints[*]} $(printf "%s " "${!writes[@]}" | sed "s|_[a-z]*||g") $elsewhere" == *" $command "* ]] ||
    { : > err; complain "$command is not tested"; }
done

remove_outputs() {
  local name
  for name in $(ls -A); do
    [[ " ${inputs[*]} err " == *" $name "* ]] || rm -rf "$name"
  done
}
check() {  # NAME EXIT_CODE
  [[ $2 == 2 ]] || complain "$1 exits with $2"
  local lines; lines=$(grep -vc "no pose graph with a map correction" err)   # a warning
  [[ $lines == 1 ]] || complain "$1 prints $lines lines"
}

for name in "${!prints[@]}"; do
  read -ra arguments <<<"${prints[$name]}"
  "$adit" "${arguments[@]}" >/dev/full 2>err; check "${prints[$name]} > /dev/full" $?
  remove_outputs
done
for stage in "$@"; do
  arguments=(--print-config)
  [[ $stage == */adit-sim ]] && arguments=(sample --print-config)
  "$stage" "${arguments[@]}" >/dev/full 2>err; code=$?
  check "$(basename "$stage") --print-config > /dev/full" $code
done

# With no space at all no file appears; with space for 8 kB only files that are complete, as without a limit.
run_limited() {  # KIB ARGUMENT ..
  local kib=$1; shift
  (ulimit -f "$kib"; trap '' XFSZ; exec "$adit" "$@" 2>&1 >/dev/null) | cat >err
  return "${PIPESTATUS[0]}"
}
outputs() { find . -type f | sed 's|^\./||' | grep -vxF "$(printf '%s\n' "${inputs[@]}" err)"; }
for name in "${!writes[@]}"; do
  read -ra arguments <<<"${writes[$name]}"
  run_limited 0 "${arguments[@]}"; check "${writes[$name]} on a full disk" $?
  left=$(outputs)
  [[ -z $left ]] || complain "${writes[$name]} leaves $left"
  remove_outputs

  "$adit" "${arguments[@]}" >/dev/null 2>err || complain "${writes[$name]} without a limit"
  mkdir -p ../reference && for file in $(outputs); do
    mkdir -p "../reference/$(dirname "$file")"; mv "$file" "../reference/$file"
  done
  remove_outputs
  if ! run_limited 8 "${arguments[@]}"; then
    for file in $(outputs); do
      cmp -s "$file" "../reference/$file" || complain "${writes[$name]} leaves a part of $file"
    done
  fi
  rm -rf "../reference"
  remove_outputs
done
[[ $failures == 0 ]]
