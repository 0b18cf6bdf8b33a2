#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# type_database_test.sh LIVE_LOGS LCM_JAR OUR_JAR..: lcm-spy's own table of types has all of ours, by
# the fingerprints that C++ gives them.
set -u
here=$(dirname "$(readlink -f "$0")")

live_logs=$1; lcm_jar=$2; shift 2
if ! command -v javac >/dev/null || [[ ! -e $lcm_jar || ! -e $1 ]]; then
  echo "skipped: no JDK or no jar, try: apt install default-jdk-headless liblcm-java" >&2
  exit 77
fi
ours=$(IFS=:; echo "$*")
"$live_logs" fingerprints | CLASSPATH=$ours java -cp "$lcm_jar:$ours" "$here/TypeDatabaseTest.java"
