#!/usr/bin/env python3
"""Runs `msc_vo replay` with damaged input.

    damaged_inputs.py COMMAND [--only PART_OF_NAME]

Each run must complete, or end with an error that names the cause; none may end by a signal, leave a
file that is not whole, or lose frames. Prints one line per fault; exit status 1 if any test failed.
"""
import os
import random
import struct
import sys
import zlib

import replay_process
from fault_case import fault, run_faults

WIDTH, HEIGHT = 160, 120


def write_png(path, rows, channels, bits, width=WIDTH):
    """`rows`: bytes of each row. 1 or 3 channels of 8 or 16 bits."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    header = struct.pack(">IIBBBBB", width, len(rows), bits, 2 if channels == 3 else 0, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + row for row in rows), 1)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b""))


def write_color(path, value, width=WIDTH, height=HEIGHT):
    write_png(path, [bytes([value]) * (3 * width)] * height, 3, 8, width)


def write_depth(path, value):
    write_png(path, [struct.pack(">H", value) * WIDTH] * HEIGHT, 1, 16)


@fault
def files_vanish(case, expected):
    process = case.replay.start(*case.arguments())
    replay_process.wait_for_frames(case.output, 5, process)
    for path in case.images("rgb")[25:30]:
        path.unlink()
    output = process.communicate()[0].decode()
    case.check(process.returncode, output, (0,), ("5", "40", "read"))


@fault
def folder_vanishes(case, expected):
    process = case.replay.start(*case.arguments())
    replay_process.wait_for_frames(case.output, 5, process)
    case.sequence.rename(case.sequence.with_name("elsewhere"))
    output = process.communicate()[0].decode()
    case.check(process.returncode, output, (0, 1))
    assert replay_process.count_frames(case.output) >= 5


@fault
def folder_of_images_is_unreadable(case, expected):
    # Root may read everything: run as another user.
    user = {"user": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
    case.output.mkdir(mode=0o777)
    for path in [case.output, *case.output.parents[:1]]:
        path.chmod(0o777)
    (case.sequence / "rgb").chmod(0)
    case.run(codes=(1,), says=("rgb", "read"), **user)
    (case.sequence / "rgb").chmod(0o755)


@fault
def clock_steps_back(case, expected):
    case.change_stamps(lambda stamps: stamps[:20] + [stamp - 0.5 for stamp in stamps[20:]])
    case.run(codes=(1,), says=("clock goes back", "0.5"))


@fault
def stamps_are_equal(case, expected):
    case.change_stamps(lambda stamps: [stamps[i - i % 2] for i in range(len(stamps))])
    case.run(codes=(0, 3), says=("warning",))


@fault
def all_stamps_are_equal(case, expected):
    case.change_stamps(lambda stamps: [stamps[0]] * len(stamps))
    case.run(codes=(1,), says=("1", "40"))


@fault
def truth_has_nan(case, expected):
    path = case.sequence / "groundtruth.txt"
    rows = path.read_text().splitlines()
    rows[10] = " ".join(rows[10].split()[:1] + ["nan"] * 7)
    path.write_text("\n".join(rows) + "\n")
    case.run(codes=(0,), says=("groundtruth.txt", "1", "nan"))


@fault
def sizes_change(case, expected):
    for path in case.images("rgb")[10:15]:
        write_color(path, 90, 80, 60)
    case.run(codes=(0,), says=("5", "40", "read"))


@fault
def all_black(case, expected):
    for path in case.images("rgb"):
        write_color(path, 0)
    case.run(codes=(3,), says=("black",))


@fault
def all_white(case, expected):
    for path in case.images("rgb"):
        write_color(path, 255)
    case.run(codes=(3,), says=("black",))


@fault
def black_from_the_middle_on(case, expected):
    for path in case.images("rgb")[15:]:
        write_color(path, 0)
    case.run(codes=(0, 3))


@fault
def depth_is_zero(case, expected):
    for path in case.images("depth"):
        write_depth(path, 0)
    case.run(codes=(3,))


@fault
def depth_is_saturated(case, expected):
    for path in case.images("depth"):
        write_depth(path, 65535)
    case.run(codes=(3,))


@fault
def images_are_noise(case, expected):
    numbers = random.Random(1)
    for path in case.images("rgb"):
        write_png(path, [numbers.randbytes(3 * WIDTH) for _ in range(HEIGHT)], 3, 8)
    for path in case.images("depth"):
        write_png(path, [numbers.randbytes(2 * WIDTH) for _ in range(HEIGHT)], 1, 16)
    case.run(codes=(0, 3))


@fault
def gap_of_ten_minutes(case, expected):
    case.change_stamps(lambda stamps: stamps[:20] + [stamp + 600.0 for stamp in stamps[20:]])
    case.run(codes=(0,))


if __name__ == "__main__":
    sys.exit(run_faults())
