#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# SPDX-FileCopyrightText: 2026 the msc_vo authors
"""Counts the instructions of whole replays and compares them, and peak memory, with a baseline.

    apps/benchmarks/replay_cost.py BUILD [--record]

BUILD is a folder with a Release build; valgrind counts. Sequences: data/room, and two that
`msc_vo synthesize` renders into BUILD/replay_cost, a corridor with structured light and a room behind a
rolling shutter. The baseline, replay_cost.json, names the compiler that it was recorded with: other
compilers give other numbers, which are shown only. --record replaces it. Exit status 1 if instructions are
3 % above the baseline, or memory 15 %.
"""
import json
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
BASELINE = os.path.join(HERE, "replay_cost.json")
ROOM = os.path.join(HERE, "..", "..", "data", "room")
LARGEST_RATIO = {"million_instructions": 1.03, "peak_memory_mib": 1.15}
RENDERED = {
    "corridor": ["--scene", "corridor", "--depth-sensor", "structured-light"],
    "shutter": ["--scene", "room", "--readout-time", "0.026", "--jpeg"],
}


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def sequences(program, folder):
    found = {"room": ROOM}
    for name, options in RENDERED.items():
        found[name] = os.path.join(folder, name)
        shutil.rmtree(found[name], ignore_errors=True)
        run(program, "synthesize", found[name], "--frames", "60", "--seed", "1", *options)
    return found


def cost(program, sequence, output):
    """Million instructions of a run with one thread, and MiB of memory of one with two."""
    replay = [program, "replay", sequence, "--quiet", "--overwrite", "--output", output]
    counted = run("valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null",
                  *replay, "--set", "threads=1")
    instructions = re.search(r"I\s+refs:\s+([\d,]+)", counted).group(1)
    run(*replay)
    with open(os.path.join(output, "summary.json"), encoding="utf-8") as file:
        memory = json.load(file)["peak_memory_mib"]
    return {"million_instructions": int(instructions.replace(",", "")) // 1000000,
            "peak_memory_mib": round(memory, 1)}


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--record"]
    if len(arguments) != 1:
        sys.exit(__doc__)
    program = os.path.join(arguments[0], "apps", "msc_vo")
    folder = os.path.join(arguments[0], "replay_cost")
    os.makedirs(folder, exist_ok=True)
    costs = {name: cost(program, sequence, os.path.join(folder, "out"))
             for name, sequence in sequences(program, folder).items()}
    compiler = re.search(r"CMAKE_CXX_COMPILER:\w+=(.*)", open(
        os.path.join(arguments[0], "CMakeCache.txt"), encoding="utf-8").read()).group(1)
    compiler = run(compiler, "--version").splitlines()[0]
    if "--record" in sys.argv:
        with open(BASELINE, "w", encoding="utf-8") as file:
            json.dump({"compiler": compiler, "costs": costs}, file, indent=2)
            file.write("\n")
    with open(BASELINE, encoding="utf-8") as file:
        baseline = json.load(file)
    is_comparable = baseline["compiler"] == compiler
    if not is_comparable:
        print(f"The baseline is of {baseline['compiler']}, this build of {compiler}.")
    is_worse = False
    for name, measured in costs.items():
        for what, value in measured.items():
            ratio = value / baseline["costs"][name][what]
            is_worse = is_worse or ratio > LARGEST_RATIO[what]
            print(f"{name:10} {what:22} {value:10} {ratio:6.3f} of the baseline")
    return 1 if is_comparable and is_worse else 0


if __name__ == "__main__":
    sys.exit(main())
