#!/usr/bin/env python3
"""Writes the SQLite bags of this folder: plain.db3, and split/, a bag in two files with metadata.yaml.

    make_db3.py
"""
import os
import sqlite3
import struct


class Cdr:
    """Fields of a message in CDR, the lowest byte first."""

    def __init__(self):
        self.bytes = b"\0\1\0\0"

    def add(self, form, *values):
        for value in values:
            self.bytes += b"\0" * (-(len(self.bytes) - 4) % struct.calcsize(form))
            self.bytes += struct.pack("<" + form, value)
        return self

    def text(self, value):
        self.add("I", len(value) + 1)
        self.bytes += value.encode() + b"\0"
        return self

    def header(self, i):
        return self.add("I", 1700000000, i * 100000000).text("camera")


def image(i, encoding, pixels):
    cdr = Cdr().header(i).add("I", 12, 16).text(encoding).add("B", 0).add("I", len(pixels) // 12, len(pixels))
    return cdr.bytes + pixels


def camera_info():
    cdr = Cdr().header(0).add("I", 12, 16).text("plumb_bob").add("I", 5).add("d", 0, 0, 0, 0, 0)
    cdr.add("d", 14.5, 0, 7.5, 0, 14.5, 5.5, 0, 0, 1)
    cdr.add("d", 1, 0, 0, 0, 1, 0, 0, 0, 1)
    return cdr.add("d", 14.5, 0, 7.5, 0, 0, 14.5, 5.5, 0, 0, 0, 1, 0).bytes


def messages():
    yield 3, 0, camera_info()
    for i in range(3):
        yield 1, i, image(i, "rgb8", bytes([40 * (i + 1)]) * (12 * 16 * 3))
        depth = [1000 * (i + 1) + x + 20 * y for y in range(12) for x in range(16)]
        yield 2, i, image(i, "16UC1", struct.pack("<192H", *depth))


def write(path, rows):
    if os.path.exists(path):
        os.remove(path)
    database = sqlite3.connect(path)
    database.execute("PRAGMA page_size = 1024")
    database.execute("CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL)")
    database.execute("CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, "
                     "metadata TEXT NOT NULL)")
    database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
                     "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL, "
                     "type_description_hash TEXT NOT NULL)")
    database.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
                     "timestamp INTEGER NOT NULL, data BLOB NOT NULL)")
    for number, (name, kind) in enumerate([("/camera/color/image_raw", "Image"),
                                           ("/camera/depth/image_rect_raw", "Image"),
                                           ("/camera/color/camera_info", "CameraInfo")], 1):
        database.execute("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '', '')",
                         (number, name, f"sensor_msgs/msg/{kind}"))
    for topic, i, data in rows:
        database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
                         (topic, 1700000000000000000 + 100000000 * i, data))
    database.commit()
    database.close()


def main():
    rows = list(messages())
    write("plain.db3", rows)
    os.makedirs("split", exist_ok=True)
    write("split/split_0.db3", rows[:3])
    write("split/split_1.db3", rows[3:])
    with open("split/metadata.yaml", "w", encoding="utf-8") as file:
        file.write("rosbag2_bagfile_information:\n  version: 8\n  storage_identifier: sqlite3\n"
                   "  relative_file_paths:\n    - split_0.db3\n    - split_1.db3\n")


main()
