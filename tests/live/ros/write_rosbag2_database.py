# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# write_rosbag2_database.py MESSAGES.tsv FOLDER
# Writes messages (topic, type, time in ns, bytes in hexadecimal) as the storage sqlite3 of rosbag2 does (its schema of version
# 3), into FOLDER/FOLDER_0.db3.
import os
import sqlite3
import sys

folder = sys.argv[2]
os.makedirs(folder)
database = sqlite3.connect(f"{folder}/{os.path.basename(folder)}_0.db3")
database.executescript(
    """
    CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
    CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
    CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
                        serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
    CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
    CREATE INDEX timestamp_idx ON messages (timestamp ASC);
    INSERT INTO schema VALUES (3, 'humble');
    """
)
ids = {}
for line in open(sys.argv[1], encoding="ascii"):
    topic, kind, time, data = line.rstrip("\n").split("\t")
    if topic not in ids:
        ids[topic] = len(ids) + 1
        database.execute("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '')", (ids[topic], topic, kind))
    database.execute(
        "INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)", (ids[topic], int(time), bytes.fromhex(data))
    )
database.commit()
