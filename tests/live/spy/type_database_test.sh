#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# type_database_test.sh LIVE_LOGS LCM_JAR JAR..
# The type database of lcm-spy finds all types of this project by their C++ fingerprints.
set -u
here=$(dirname "$(readlink -f "$0")")

live_logs=$1; lcm_jar=$2; shift 2
if ! command -v javac >/dev/null || [[ ! -e $lcm_jar || ! -e $1 ]]; then
  echo "skipped: no JDK or no jar, try: apt install default-jdk-headless liblcm-java" >&2
  exit 77
fi
jars=$(IFS=:; echo "$*")
"$live_logs" fingerprints | CLASSPATH=$jars java -cp "$lcm_jar:$jars" "$here/TypeDatabaseTest.java"
