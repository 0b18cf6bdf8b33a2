#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# failing_disk_test.sh ADIT FAILING_DISK.so [--table]
# Every command of adit that writes files, on a disk that fails (failing_disk.cpp): at once, after half and shortly before
# the end of what the command writes (EIO, ENOSPC), when the file is synchronised, closed or renamed; and on one that
# takes few bytes at a time and interrupts (short writes), which must not change a byte. A command fails with 2 and
# one line, and leaves complete files under their names only. Then on a disk that cannot read its inputs, nothing of
# them or not their second half: a command fails so, or says what it could not read. Then journals of which the disk
# cannot read a part. --table prints a row for each command and fault.
set -u
adit=$1; shim=$2; table=${3:-}
here=$(dirname "$(readlink -f "$0")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/in" "$scratch/work" && cd "$scratch/in" || exit 1
failures=0
complain() { echo "FAILED: $*: $(head -c 300 ../err)" >&2; failures=$((failures + 1)); }

# Inputs.
"$adit" sample in.log --length-m 4 --truth in.tum >/dev/null || exit 1
"$adit" sample in.lcmlog --length-m 4 >/dev/null || exit 1
printf 'EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\n' > in.g2o
"$adit" scan sample --out scan.lcmlog >/dev/null || exit 1
"$adit" export in.lcmlog --rosbag2 bag >/dev/null || exit 1
mkdir clouds && "$adit" scan sample --out clouds/1700000000.ply >/dev/null || exit 1
printf '1700000000 0 0 0 0 0 0 1\n' > poses.tum
cp "$here/../../deploy/config/groundhog.yaml" robot.yaml
printf '0 0\n1 0\n' > in.txt
cd ../work || exit 1

# The same commands as in full_disk_test.sh, which compares them with adit --help.
mapfile -t commands < <(sed -n "/^declare -A writes/,/^# Not here/p" "$here/full_disk_test.sh" |
  grep -o "='[^']*'" | sed "s/^='//; s/'\$//; s| \(\.\./\)\?in_| ../in/|g; s| in\.| ../in/in.|g" | sort -u)
((${#commands[@]} > 10)) || { echo "FAILED: no commands" >&2; exit 1; }

outputs() { find . -type f | sort; }
# with_fault ASSIGNMENT.. -- ARGUMENT..: exit code of the command.
with_fault() {
  local settings=()
  while [[ $1 != -- ]]; do settings+=("$1"); shift; done; shift
  rm -rf ./* ./.[!.]*
  env FAIL_BELOW="$scratch/work" "${settings[@]}" LD_PRELOAD="$shim" "$adit" "$@" >../text 2>../err
}
# Files with run times and random keys differ in these and keep their form; the others are equal to the byte.
is_same() {
  case $1 in
    *.json) python3 -m json.tool "$1" >/dev/null 2>&1 || ! command -v python3 >/dev/null ;;
    *.key) [[ $(stat -c %s "$1") == $(stat -c %s "../reference/$1") ]] ;;
    *) cmp -s "$1" "../reference/$1" ;;
  esac
}
# check_failure WHAT CODE
check_failure() {
  [[ $2 == 2 ]] || complain "$1: exits with $2"
  local lines; lines=$(grep -vc "no pose graph with a map correction" ../err)
  [[ $lines == 1 ]] || complain "$1: prints $lines lines"
}
check_left() {
  left=$(outputs)
  for file in $left; do is_same "$file" || complain "$1: leaves a part of $file"; done
}
row() { [[ -n $table ]] && echo "| \`adit $1\` | $2 | $3 | $(tail -1 ../err | head -c 90 | sed "s|$scratch|DIR|g; s/|/\\\\|/g") | ${4:-none} |"; }

[[ -n $table ]] && printf '| command | fault | exit code | line | left |\n|---|---|---|---|---|\n'
for command in "${commands[@]}"; do
  read -ra arguments <<<"$command"
  rm -rf ./* ./.[!.]* ../reference
  "$adit" "${arguments[@]}" >/dev/null 2>../err || { complain "$command without a fault"; continue; }
  cp -a . ../reference
  bytes=$(find . -type f -printf '%s\n' | awk '{ sum += $1 } END { print sum + 0 }')

  with_fault FAIL_SHORT=4000 -- "${arguments[@]}"; code=$?
  [[ $code == 0 ]] || complain "$command with short writes exits with $code"
  for file in $(cd ../reference && outputs); do
    is_same "$file" || complain "$command with short writes gives another $file"
  done
  row "$command" "short writes, EINTR" $code "all, the same bytes"

  faults=("FAIL_AFTER=0 FAIL_WITH=EIO" "FAIL_AFTER=$((bytes / 2)) FAIL_WITH=EIO" "FAIL_AFTER=$((bytes * 9 / 10)) FAIL_WITH=ENOSPC"
    "FAIL_AFTER=0 FAIL_CALL=fsync" "FAIL_AFTER=0 FAIL_CALL=close" "FAIL_AFTER=0 FAIL_CALL=rename")
  for fault in "${faults[@]}"; do
    read -ra settings <<<"$fault"
    with_fault "${settings[@]}" -- "${arguments[@]}"; code=$?
    check_left "$command, $fault"
    if [[ $code == 0 ]]; then  # it never makes this call: then everything is there
      [[ $fault == *FAIL_CALL=* ]] || complain "$command, $fault: exits with 0"
      for file in $(cd ../reference && outputs); do [[ -e $file ]] || complain "$command, $fault: no $file, exit code 0"; done
    else
      check_failure "$command, $fault" $code
    fi
    row "$command" "$(sed "s/FAIL_AFTER=0 FAIL_CALL=/EIO in /; s/FAIL_AFTER=\([0-9]*\) FAIL_WITH=\([A-Z]*\)/\2 after \1 bytes/" <<<"$fault")" \
      $code "$(echo $left)"
  done

  # The size of the largest input.
  size=$(grep -o '\.\./in/[^ ]*' <<<"$command" | xargs -r -I{} find {} -type f -printf '%s\n' | sort -n | tail -1)
  [[ -n $size ]] || continue
  for after in 0 $((size / 2)); do
    with_fault FAIL_BELOW="$scratch/in" FAIL_CALL=read FAIL_AFTER=$after -- "${arguments[@]}"; code=$?
    if [[ $code != 0 ]]; then
      check_failure "$command, unreadable from byte $after" $code
      check_left "$command, unreadable from byte $after"
    elif ! grep -q "cannot read\|corrupt" ../err ../text; then  # then it has not used what cannot be read
      for file in $(cd ../reference && outputs); do
        is_same "$file" || complain "$command, unreadable from byte $after: another $file, without a word"
      done
    fi
    row "$command" "EIO when reading, from byte $after" $code "$(echo $(outputs))"
  done
done

# A journal and its copy: the disk cannot read 8 kB in the middle of one of them, then the end of both.
rm -rf ./* ../journals && mkdir ../journals
"$adit" sample ../journals/in.lcmlog --length-m 16 >/dev/null
"$adit" map ../journals/in.lcmlog --out ../journals/first >/dev/null 2>../err || complain "no journal"
size=$(stat -c %s ../journals/first/map.journal)
resume() {
  with_fault FAIL_CALL=read "$@" -- map ../journals/in.lcmlog --out out --resume ../journals/first; code=$?
}
resume FAIL_BELOW="$scratch/journals/first/map.journal" FAIL_AFTER=$((size / 2)) FAIL_BYTES=8192
[[ $code == 0 ]] && grep -q "taken from the other copy, nothing lost" ../err || complain "a journal with a bad place"
resume FAIL_BELOW="$scratch/journals/first/" FAIL_AFTER=$((size / 2))
[[ $code == 0 ]] && grep -q "an unknown number of records at the end lost" ../err || complain "two journals without their ends"
resume FAIL_BELOW="$scratch/journals/first/" FAIL_AFTER=0
check_failure "two journals that cannot be read" $code
[[ $failures == 0 ]]
