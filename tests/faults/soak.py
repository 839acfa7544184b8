#!/usr/bin/env python3
"""Plays a rendered house and a rendered room back and forth for a long time, and measures memory and times.

    tests/faults/soak.py MSC_VO [--images 20000] [--width 640] [--scenes house room] [--output DIR]

MSC_VO: the command. Writes DIR/house.csv and DIR/room.csv: means over eighths of the run. Fails if an image
is not tracked, or if memory grows from the second quarter of the run to the last one in the room, all of
which is observed in the first quarter. What is in DIR is overwritten.
"""
import argparse
import csv
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import replay_process

ROWS = 8
MAX_GROWTH = 1.25  # of memory, from the second quarter of a run to its last, where nothing new is seen


def render(arguments, scene, count, folder):
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([arguments.command, "synthesize", folder, "--scene", scene, "--frames", str(count),
                    "--width", str(arguments.width), "--jpeg", "--noise", "kinect"],
                   check=True, stdout=subprocess.DEVNULL)


def read_rows(path):
    return [line.split() for line in path.read_text().splitlines() if line and not line.startswith("#")]


def play_back_and_forth(once, folder, num_images):
    """A sequence that shows the images of the folder `once` forwards, backwards, forwards..."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for name in ("rgb", "depth"):
        (folder / name).symlink_to(once / name)
    shutil.copy(once / "camera.txt", folder)
    files = {name: read_rows(once / name) for name in ("rgb.txt", "depth.txt", "groundtruth.txt")}
    count = len(files["rgb.txt"])
    interval = (float(files["rgb.txt"][-1][0]) - float(files["rgb.txt"][0][0])) / (count - 1)
    order = list(range(count)) + list(range(count - 2, 0, -1))
    for name, rows in files.items():
        with (folder / name).open("w") as file:
            for i in range(num_images):
                file.write(" ".join([f"{1.0 + interval * i:.6f}", *rows[order[i % len(order)]][1:]]) + "\n")


def resident_mb(process):
    for line in pathlib.Path("/proc", str(process.pid), "status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024.0
    return None  # the process has ended


def run(replay, folder, output, num_images, checkpoint_interval):
    """Replays a sequence. Returns pairs (images so far, resident memory in MB)."""
    samples = []
    process = replay.start(folder, "--output", output, "--quiet", "--set", "threads=1",
                           "--checkpoint-interval", checkpoint_interval,
                           stdout=subprocess.DEVNULL, stderr=None)
    try:
        while process.poll() is None:
            memory = resident_mb(process)
            count = replay_process.count_frames(output)
            if memory is not None and 0 < count < num_images:  # not while it writes the report
                samples.append((count, memory))
            time.sleep(0.1)
    finally:
        process.kill()
    if process.returncode != 0:
        sys.exit(f"soak.py: the run ended with exit code {process.returncode}")
    return samples


def mean(values):
    return sum(values) / len(values) if values else math.nan


def table(output, samples):
    with (output / "frames.csv").open() as file:
        frames = list(csv.DictReader(file))
    size = len(frames) // ROWS
    rows = []
    for i in range(ROWS):
        part = frames[i * size:(i + 1) * size]
        rows.append({
            "images": (i + 1) * size,
            "memory_mb": mean([memory for count, memory in samples if i * size < count <= (i + 1) * size]),
            "tracking_ms": mean([float(frame["tracking_ms"]) for frame in part]),
            "mapping_ms": mean([float(frame["mapping_ms"]) for frame in part if frame["keyframe"] == "1"]),
        })
    return rows


def write(path, rows):
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows({name: round(value, 2) for name, value in row.items()} for row in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("--images", type=int, default=20000)
    parser.add_argument("--width", type=int, default=640)
    parser.add_argument("--scenes", nargs="+", choices=["house", "room"], default=["house", "room"])
    parser.add_argument("--output", type=pathlib.Path)
    parser.add_argument("--checkpoint-interval", default="5", help="of the replay, seconds")
    arguments = parser.parse_args()
    replay = replay_process.Replay(arguments.command)
    failures = []
    with tempfile.TemporaryDirectory() as temporary:
        work = (arguments.output or pathlib.Path(temporary)).resolve()
        work.mkdir(parents=True, exist_ok=True)
        for scene in arguments.scenes:
            once, often = work / f"{scene}-once", work / f"{scene}-often"
            count = max(2, min(2600 if scene == "house" else 260, arguments.images // ROWS))
            render(arguments, scene, count, once)
            play_back_and_forth(once, often, arguments.images)
            rows = table(work / scene, run(replay, often, work / scene, arguments.images,
                                           arguments.checkpoint_interval))
            write(work / f"{scene}.csv", rows)
            print(scene, *(f"{name}: {[round(row[name], 1) for row in rows]}" for name in rows[0]), sep="\n  ")
            summary = json.loads((work / scene / "summary.json").read_text())
            num_tracked = summary["frames"]["tracked"]
            if num_tracked != arguments.images:
                failures.append(f"{scene}: {num_tracked} of {arguments.images} images tracked")
            growth = mean([row["memory_mb"] for row in rows[6:]]) / mean([row["memory_mb"] for row in rows[2:4]])
            if scene == "room" and not growth <= MAX_GROWTH:  # nan: too few samples
                failures.append(f"{scene}: memory grows by {100 * (growth - 1):.0f} %")
    sys.exit("\n".join(failures) or None)


if __name__ == "__main__":
    main()
