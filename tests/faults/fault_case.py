"""Runs of `msc_vo replay` on a rendered sequence that a test damages or hinders."""
import argparse
import pathlib
import shutil
import subprocess
import tempfile

import replay_process
from replay_process import Replay

FRAMES = 40
FAULTS = []


def fault(function):
    """Adds a test: a function of a Case and the folder of an undisturbed run. It returns why it was
    left out, or None."""
    FAULTS.append(function)
    return function


def names(output, *tokens):
    """Whether a line of the output has every token; independent of the wording around them."""
    return not tokens or any(all(token in line for token in tokens) for line in output.splitlines())


class Case:
    """A copy of the sequence, and what is expected of runs on it."""

    def __init__(self, replay, folder, source):
        self.replay = replay
        self.sequence = folder / "room"
        self.output = folder / "out"
        self.codes = []  # exit codes of the runs
        shutil.copytree(source, self.sequence)

    def images(self, kind):
        rows = (self.sequence / f"{kind}.txt").read_text().splitlines()
        return [self.sequence / row.split()[1] for row in rows if not row.startswith("#")]

    def change_stamps(self, change):
        """`change`: from the list of stamps to new ones, in every list but the ground truth."""
        for name in ["rgb.txt", "depth.txt", "associations.txt"]:
            path = self.sequence / name
            if not path.exists():
                continue
            rows = [row.split() for row in path.read_text().splitlines() if not row.startswith("#")]
            for column in (0, 2) if name == "associations.txt" else (0,):
                stamps = change([float(row[column]) for row in rows])
                for row, stamp in zip(rows, stamps):
                    row[column] = f"{stamp:.6f}"
            path.write_text("".join(" ".join(row) + "\n" for row in rows))

    def arguments(self):
        return [self.sequence, "--output", self.output, "--quiet", "--no-check", "--checkpoint-interval", "0"]

    def run(self, *more, codes=(0,), says=(), **options):
        code, output = self.replay.run(*self.arguments(), *more, **options)
        self.check(code, output, codes, says)
        return output

    def check(self, code, output, codes, says=()):
        self.codes.append(code)
        assert code in codes, f"exit code {code}: {output}"
        assert names(output, *says), f"no line names {says}: {output}"
        if code == 1:
            assert "msc_vo: error: " in output, output
        damaged = replay_process.damaged_files(self.output)
        assert not damaged, damaged

    def check_remains(self):
        """Nothing is left of files that could not be written."""
        partial = [path.name for path in self.output.rglob("*.partial")]
        assert not partial, f"{partial} remain"
        folder = self.output / "checkpoint"
        assert not folder.exists() or (folder / "state.bin").exists(), "a part of a checkpoint remains"

    def resume(self, expected):
        code, output = self.replay.run("--quiet", "--resume", self.output)
        assert code == 0, f"exit code {code}: {output}"
        different = replay_process.differences(self.output, expected)
        assert not different, f"{different} differ"


def run_faults():
    """Runs the tests; returns the exit status of the program."""
    parser = argparse.ArgumentParser()
    parser.add_argument("command", type=pathlib.Path)
    parser.add_argument("--only", default="", help="part of the name of a fault")
    arguments = parser.parse_args()
    replay = Replay(arguments.command)
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        folder.chmod(0o755)
        source = folder / "room"
        replay.synthesize(source, FRAMES)
        expected = folder / "expected"
        code, output = replay.run(source, "--quiet", "--no-check", "--output", expected)
        assert code == 0, output
        for test in FAULTS:
            if arguments.only not in test.__name__:
                continue
            place = folder / test.__name__
            try:
                case = Case(replay, place, source)
                note = test(case, expected)
                print(f"{test.__name__}: {note or 'passed'}; exit codes {case.codes}", flush=True)
            except (AssertionError, subprocess.TimeoutExpired) as error:
                failed += 1
                print(f"{test.__name__}: FAILED: {error}", flush=True)
            shutil.rmtree(place, ignore_errors=True)
    return 1 if failed else 0
