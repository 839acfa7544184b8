#!/usr/bin/env python3
"""Kills runs of `msc_vo replay` at random moments and resumes them.

    kill_and_resume.py COMMAND [--kills N] [--seed N] [--frames N]

Every run must end with the same bytes as one that was not killed. After every kill, each file that is
there must be whole, and no frame that was on disk may be missing. Prints how many runs and kills there
were; exit status 1 if anything was lost.
"""
import argparse
import collections
import pathlib
import random
import signal
import sys
import tempfile
import time

import replay_process
from replay_process import Replay


class Killer:
    def __init__(self, replay, folder, random_numbers, frames):
        self.replay = replay
        self.folder = folder
        self.random = random_numbers
        self.sequence = folder / "room"
        self.expected = folder / "expected"
        self.counts = collections.Counter()
        self.failures = []
        replay.synthesize(self.sequence, frames)
        start = time.monotonic()
        code, output = replay.run(self.sequence, "--quiet", "--output", self.expected)
        self.seconds = time.monotonic() - start
        if code != 0:
            raise SystemExit(f"the run to compare with failed: {output}")

    def fail(self, text):
        self.failures.append(text)
        print(text, file=sys.stderr)

    def arguments(self, output):
        """Those of a new run, or of one that is resumed."""
        common = ["--quiet", "--checkpoint-interval", self.random.choice(["0", "0", "0.01", "0.05"])]
        if not (output / "checkpoint" / "state.bin").exists():
            if replay_process.count_frames(output) > 1:
                self.fail(f"{output}: has frames, but no checkpoint")
            self.counts["killed before the first checkpoint"] += output.exists()
            return [self.sequence, "--output", output, *common,
                    "--set", f"threads={self.random.randint(1, 3)}"]
        self.counts["resumed"] += 1
        if self.random.random() < 0.5:
            return ["--resume", output, *common]
        return [self.sequence, "--resume", output, *common,
                "--set", f"threads={self.random.randint(1, 3)}"]

    @staticmethod
    def is_complete(output):
        """Whether all results are there and the checkpoint has been removed."""
        report = output / "report.html"
        return report.exists() and not (output / "checkpoint" / "state.bin").exists()

    def check_files(self, output, num_frames_before):
        for damage in replay_process.damaged_files(output):
            self.fail(f"{output}: {damage}")
        if replay_process.count_frames(output) < num_frames_before:
            self.fail(f"{output}: frames were lost")

    def run_once(self, output, max_kills):
        """One run, killed until it happens to reach its end."""
        kills = 0
        num_frames = 0
        while True:
            arguments = self.arguments(output)
            process = self.replay.start(*arguments)
            if kills < max_kills:
                try:
                    process.wait(self.random.uniform(0.0, 1.5 * self.seconds))
                except Exception:  # still running
                    process.kill()
            text = process.communicate()[0].decode(errors="replace")
            if process.returncode != -signal.SIGKILL:
                break
            kills += 1
            self.check_files(output, num_frames)
            num_frames_before, num_frames = num_frames, replay_process.count_frames(output)
            self.counts["kills that left more frames than the one before"] += num_frames > num_frames_before
            if self.is_complete(output):
                self.counts["killed after the end"] += 1
                break
        self.counts["kills"] += kills
        self.counts["runs"] += 1
        if process.returncode not in (0, -signal.SIGKILL):
            self.fail(f"{output}: {arguments} failed: {text}")
            return
        different = replay_process.differences(output, self.expected)
        if different:
            self.fail(f"{output}: {different} differ")
        if process.returncode == 0 and (output / "checkpoint").exists():
            self.fail(f"{output}: the checkpoint remains after the end")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("command", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--frames", type=int, default=60)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        killer = Killer(Replay(arguments.command), pathlib.Path(folder), random.Random(arguments.seed),
                        arguments.frames)
        number = 0
        while killer.counts["kills"] < arguments.kills and not killer.failures:
            rest = arguments.kills - killer.counts["kills"]
            killer.run_once(pathlib.Path(folder, f"run_{number}"), min(10, rest))
            number += 1
        print(", ".join(f"{count} {name}" for name, count in sorted(killer.counts.items())))
        return 1 if killer.failures else 0


if __name__ == "__main__":
    sys.exit(main())
