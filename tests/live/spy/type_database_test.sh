#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# type_database_test.sh LIVE_LOGS OUR_JAR LCM_JAR: lcm-spy's own table of types has all of ours, by
# the fingerprints that C++ gives them.
set -u
here=$(dirname "$(readlink -f "$0")")

if ! command -v javac >/dev/null || [[ ! -e $2 || ! -e $3 ]]; then
  echo "skipped: no JDK or no jar, try: apt install default-jdk-headless liblcm-java" >&2
  exit 77
fi
"$1" fingerprints | CLASSPATH=$2 java -cp "$3:$2" "$here/TypeDatabaseTest.java"
