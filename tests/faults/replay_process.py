"""Runs of `msc_vo replay` for the tests of faults: starting, observing and comparing them."""
import pathlib
import subprocess
import time

# Files of a run that do not contain times.
REPEATABLE_FILES = ["trajectory.txt", "keyframes.txt", "map.ply", "lines.ply"]
# Those that count; the others only help.
RESULTS = [*REPEATABLE_FILES, "frames.csv", "summary.json"]


class Replay:
    def __init__(self, command):
        self.command = str(command)

    def synthesize(self, folder, frames, *more):
        subprocess.run([self.command, "synthesize", folder, "--scene", "room", "--frames", str(frames),
                        "--width", "160", *more], check=True, capture_output=True)

    def start(self, *arguments, **options):
        """Starts a run; standard output and standard error are captured together."""
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, **options}
        return subprocess.Popen([self.command, "replay", *map(str, arguments)], **options)

    def run(self, *arguments, timeout=120, **options):
        """Runs to the end. Returns the exit code (minus the signal that ended it) and the output."""
        return self.command_run("replay", *arguments, timeout=timeout, **options)

    def command_run(self, name, *arguments, timeout=120, **options):
        """The same for any command."""
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, **options}
        process = subprocess.Popen([self.command, name, *map(str, arguments)], **options)
        output = process.communicate(timeout=timeout)[0]
        return process.returncode, (output or b"").decode(errors="replace")


def count_frames(output):
    """Whole rows of frames.csv."""
    path = pathlib.Path(output, "frames.csv")
    return max(0, path.read_bytes().count(b"\n") - 1) if path.exists() else 0


def wait_for_frames(output, count, process, seconds=60):
    end = time.monotonic() + seconds
    while count_frames(output) < count and process.poll() is None and time.monotonic() < end:
        time.sleep(0.001)


def damaged_files(output):
    """Result files that are not whole, with the reason. A killed run may have none."""
    damaged = []
    for path in pathlib.Path(output).glob("*"):
        if not path.is_file() or path.suffix == ".partial":
            continue
        data = path.read_bytes()
        if data and not data.endswith(b"\n") and path.suffix in (".txt", ".csv", ".html", ".json", ".ply"):
            damaged.append(f"{path.name} does not end with a line")
        if path.name == "trajectory.txt":
            rows = [row.split() for row in data.decode().splitlines() if not row.startswith("#")]
            if any(len(row) != 8 for row in rows):
                damaged.append("trajectory.txt has a row without 8 numbers")
        if path.name == "frames.csv":
            rows = data.decode().splitlines()
            if any(row.count(",") != rows[0].count(",") for row in rows):
                damaged.append("frames.csv has a row with missing columns")
        if path.name == "report.html" and not data.endswith(b"</html>\n"):
            damaged.append("report.html has no end")
    return damaged


def frames_without_times(output):
    rows = [row.split(",") for row in pathlib.Path(output, "frames.csv").read_text().splitlines()]
    kept = [i for i, name in enumerate(rows[0]) if not name.endswith("_ms")]
    return [[row[i] for i in kept] for row in rows]


def differs(name, output, expected):
    """Whether a result file differs from that of another run, times apart, or is missing."""
    if not pathlib.Path(output, name).exists():
        return True
    if name == "frames.csv":
        return frames_without_times(output) != frames_without_times(expected)
    if name == "summary.json":  # full of times
        return not pathlib.Path(output, name).read_text().endswith("}\n")
    return pathlib.Path(output, name).read_bytes() != pathlib.Path(expected, name).read_bytes()


def differences(output, expected, names=(*REPEATABLE_FILES, "frames.csv")):
    """Names of the result files that differ from those of another run."""
    return [name for name in names if differs(name, output, expected)]
