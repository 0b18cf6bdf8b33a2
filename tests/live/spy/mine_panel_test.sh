#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# mine_panel_test.sh WRITE_MISSION_LOG LCM_JAR JAR_FOLDER [PICTURE.png]
# The plugin of lcm-spy draws the messages of a synthetic mission where its mine is, without a display.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")

write_mission_log=$1; lcm_jar=$2; jars=$3; shift 3
if ! command -v javac >/dev/null || [[ ! -e $lcm_jar || ! -e $jars/lcmspy_plugins_adit.jar ]]; then
  echo "skipped: no JDK or no jar, try: apt install default-jdk-headless liblcm-java" >&2
  exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
path=$lcm_jar:$jars/lcmtypes_adit.jar:$jars/lcmspy_plugins_adit.jar
javac --release 8 -Xlint:-options -cp "$path" -d "$scratch" "$here/adit/viewer/MinePanelTest.java"
"$write_mission_log" "$scratch/run.lcmlog"
java -Djava.awt.headless=true -cp "$scratch:$path" adit.viewer.MinePanelTest "$scratch/run.lcmlog" "$@"
