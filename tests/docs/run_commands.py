#!/usr/bin/env python3
"""Runs the msc_vo commands in the ```text blocks of Markdown files.

    run_commands.py --root ROOT --command MSC_VO FILE.md ...

These blocks show commands on the reader's own data. Here they run in a scratch folder with small data
of these names (prepare() below), one after the other, and must end with exit status 0. A line that an
earlier document has, too, is not run again. Exit status 1 if any command fails.
"""
import argparse
import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from markdown import read_blocks

# What a command needs that is not here -> the test that runs it.
ELSEWHERE = {
    "record openni2:": "OpenNi2Command",
    "_xyz.bag": "RosBag",
    "replay --resume": "ResumeTest",
    " my_scan": "PhoneCommandTest",
}
# Shorter, so that the test is fast.
SHORTENED = [
    (re.compile(r"--frames \d+"), "--frames 4"),
    (re.compile(r"^msc_vo synthesize (?!.*--frames).*"), r"\g<0> --frames 4"),
]
# What a msc_vo that was built without a library says.
NOT_BUILT = re.compile(r"is not installed|was built without")
COMMAND_SECONDS = 300


def read_commands(text):
    """The lines with a command, without comments."""
    for block in read_blocks(text):
        if block.language == "text":
            for number, line in enumerate(block.lines):
                if line.startswith("msc_vo "):
                    yield block.first_line + number, line.split("  #")[0].strip()


def write_euroc(trajectory, path):
    """A trajectory in the format of EuRoC's ground truth."""
    rows = ["#timestamp [ns], p_x, p_y, p_z, q_w, q_x, q_y, q_z"]
    for line in trajectory.read_text().splitlines():
        if not line.startswith("#"):
            t, x, y, z, qx, qy, qz, qw = line.split()
            rows.append(",".join([str(round(float(t) * 1e9)), x, y, z, qw, qx, qy, qz]))
    path.parent.mkdir(parents=True)
    path.write_text("\n".join(rows) + "\n")


def prepare(scratch, root, run):
    """The data that the documents speak of."""
    shutil.copytree(root / "data" / "room", scratch / "my_sequence")
    run("msc_vo replay my_sequence --output out --quiet --map attic.map")
    for name in ("groundtruth.txt", "edges.ply"):
        shutil.copy(scratch / "my_sequence" / name, scratch)
    shutil.copy(scratch / "out" / "trajectory.txt", scratch)
    # A mask of the left edge, as PGM: the contents of an image say its format.
    (scratch / "arm.png").write_bytes(b"P5 640 480 255\n" + 480 * (100 * b"\xff" + 540 * b"\0"))
    write_euroc(scratch / "groundtruth.txt",
                scratch / "mav0" / "state_groundtruth_estimate0" / "data.csv")
    for room in ("room_1", "room_2"):
        run(f"msc_vo synthesize {room} --frames 4 --width 160 --fps 4")
    (scratch / "sequences.txt").write_text("room_1\nroom_2\n")
    # A dataset of a table of the literature, by the name of its folder.
    shutil.copytree(root / "data" / "benchmarks", scratch / "data" / "benchmarks")
    shutil.copytree(scratch / "room_1", scratch / "DATASETS" / "living_room_traj0_frei_png")
    # Shares of other machines; share 2 of 4 is run by its document.
    shares = [("1/2", "from_a"), ("2/2", "from_b"), ("1/2", "out"), ("2/2", "out")]
    shares += [(f"{k}/4", "out/shards") for k in (1, 3, 4)]
    for share, folder in shares:
        run(f"msc_vo benchmark sequences.txt --shard {share} --output {folder} --quiet")


def make_runner(scratch, command):
    """A function that runs a line in the scratch folder."""
    (scratch / "bin").mkdir()
    (scratch / "bin" / "msc_vo").symlink_to(command)
    environment = dict(os.environ, PATH=f"{scratch / 'bin'}{os.pathsep}{os.environ['PATH']}")

    def run(line):
        result = subprocess.run(["bash", "-c", line], cwd=scratch, env=environment,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, timeout=COMMAND_SECONDS, check=False)
        return result.returncode, result.stdout.decode(errors="replace")

    return run


def run_document(document, root, run, done):
    """Whether all commands of a document passed. `done` counts the lines of earlier documents."""
    passed = True
    earlier = collections.Counter(done)
    for number, line in read_commands(document.read_text()):
        where = f"{document.relative_to(root)}:{number}"
        done[line] += 1
        if earlier[line] > 0:
            earlier[line] -= 1
            print(f"{where}: run above: {line}")
            continue
        elsewhere = [test for part, test in ELSEWHERE.items() if part in line]
        if elsewhere:
            print(f"{where}: run by the test {elsewhere[0]}: {line}")
            continue
        for pattern, short in SHORTENED:
            line = pattern.sub(short, line)
        status, output = run(line)
        is_missing = status != 0 and NOT_BUILT.search(output)
        print(f"{where}: exit status {status}{', not built' if is_missing else ''}: {line}",
              flush=True)
        if status != 0 and not is_missing:
            passed = False
            print(output)
    return passed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--command", type=pathlib.Path, required=True)
    parser.add_argument("documents", type=pathlib.Path, nargs="+")
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    with tempfile.TemporaryDirectory() as directory:
        scratch = pathlib.Path(directory).resolve()
        run = make_runner(scratch, arguments.command.resolve())
        prepare(scratch, root, run)
        done = collections.Counter()
        results = [run_document(document.resolve(), root, run, done)
                   for document in arguments.documents]
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
