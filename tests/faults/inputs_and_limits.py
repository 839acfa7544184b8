#!/usr/bin/env python3
"""Runs `msc_vo replay` and other commands with damaged input and under limits of the system.

    inputs_and_limits.py COMMAND [--only PART_OF_NAME]

Each run must complete, or end with an error that names the cause; none may end by a signal, leave a
file that is not whole, or lose frames. Prints one line per fault; exit status 1 if any test failed.
"""
import argparse
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib

import replay_process
from replay_process import Replay

FRAMES = 40
WIDTH, HEIGHT = 160, 120
FAULTS = []


def fault(function):
    FAULTS.append(function)
    return function


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

    def run(self, *more, codes=(0,), says="", **options):
        code, output = self.replay.run(*self.arguments(), *more, **options)
        self.check(code, output, codes, says)
        return output

    def check(self, code, output, codes, says=""):
        self.codes.append(code)
        assert code in codes, f"exit code {code}: {output}"
        assert says in output, f"'{says}' is missing: {output}"
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


@fault
def files_vanish(case, expected):
    process = case.replay.start(*case.arguments())
    replay_process.wait_for_frames(case.output, 5, process)
    for path in case.images("rgb")[25:30]:
        path.unlink()
    output = process.communicate()[0].decode()
    case.check(process.returncode, output, (0,), "5 of 40 images cannot be read")


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
    case.run(codes=(1,), says="cannot be read", **user)
    (case.sequence / "rgb").chmod(0o755)


@fault
def clock_steps_back(case, expected):
    case.change_stamps(lambda stamps: stamps[:20] + [stamp - 0.5 for stamp in stamps[20:]])
    case.run(codes=(0, 3))


@fault
def stamps_are_equal(case, expected):
    case.change_stamps(lambda stamps: [stamps[i - i % 2] for i in range(len(stamps))])
    case.run(codes=(0, 3), says="warning")


@fault
def all_stamps_are_equal(case, expected):
    case.change_stamps(lambda stamps: [stamps[0]] * len(stamps))
    case.run(codes=(1,), says="only 1 of")


@fault
def truth_has_nan(case, expected):
    path = case.sequence / "groundtruth.txt"
    rows = path.read_text().splitlines()
    rows[10] = " ".join(rows[10].split()[:1] + ["nan"] * 7)
    path.write_text("\n".join(rows) + "\n")
    case.run(codes=(0,), says="1 poses with nan or inf are left out")


@fault
def sizes_change(case, expected):
    for path in case.images("rgb")[10:15]:
        write_color(path, 90, 80, 60)
    case.run(codes=(0,), says="5 of 40 images cannot be read")


@fault
def all_black(case, expected):
    for path in case.images("rgb"):
        write_color(path, 0)
    case.run(codes=(3,), says="black or uniform")


@fault
def all_white(case, expected):
    for path in case.images("rgb"):
        write_color(path, 255)
    case.run(codes=(3,), says="black or uniform")


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


@fault
def memory_is_limited(case, expected):
    """From too little to load the program's libraries to enough."""
    if "ASAN_OPTIONS" in os.environ:
        return "left out: AddressSanitizer reserves far more address space than any limit"
    for megabytes in [100, 200, 300, 350, 400, 450, 500, 600, 800, 1600]:
        shutil.rmtree(case.output, ignore_errors=True)
        limit = megabytes << 20
        code, output = case.replay.run(
            *case.arguments(), preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        if code == 127 and "shared libraries" in output:
            continue  # the loader has not even started the program
        case.check(code, output, (0, 1))
        if (case.output / "checkpoint").exists():
            case.resume(expected)


def limit_file_size(kilobytes):
    def apply():
        resource.setrlimit(resource.RLIMIT_FSIZE, (kilobytes << 10, kilobytes << 10))
    return apply


@fault
def files_cannot_grow(case, expected):
    """Each file that is allowed its size is there; nothing remains of those that are not."""
    sizes = {name: (expected / name).stat().st_size for name in [*replay_process.RESULTS, "report.html"]}
    for kilobytes in [0, 1, 4, 16, 64, 256]:
        shutil.rmtree(case.output, ignore_errors=True)
        code, output = case.replay.run(*case.arguments(), preexec_fn=limit_file_size(kilobytes))
        case.check(code, output, (0, 1))
        # Times and paths make some files longer or shorter than those of the other run.
        fitting = [name for name in replay_process.RESULTS if sizes[name] + 1024 < kilobytes << 10]
        different = replay_process.differences(case.output, expected, fitting)
        assert not different, f"{different} differ with {kilobytes} kB: {output}"
        for name, size in sizes.items():
            if size > (kilobytes << 10) + 1024:
                assert code == 1 and f"{name}: cannot be written" in output, f"{name} is not named: {output}"
        case.check_remains()
        if (case.output / "checkpoint" / "state.bin").exists():
            case.resume(expected)


@fault
def only_what_helps_cannot_be_written(case, expected):
    """Log, video, windows, report and checkpoint are too large: the results are the same."""
    largest = max((expected / name).stat().st_size for name in replay_process.RESULTS)
    limit = (largest >> 10) + 2
    help_files = {"--log-file": "log.txt", "--overlay": "video.mp4", "--dump-windows": "windows"}
    for argument, name in help_files.items():
        shutil.rmtree(case.output, ignore_errors=True)
        file = case.output.with_name(name)
        more = [argument, file]
        if argument == "--log-file":
            file.write_text("x" * ((limit << 10) - 100) + "\n")  # the log appends
            more += ["--log-level", "debug"]
        code, output = case.replay.run(*case.arguments(), *more, preexec_fn=limit_file_size(limit))
        case.check(code, output, (1,), "report.html: cannot be written: File too large")
        different = replay_process.differences(case.output, expected, replay_process.RESULTS)
        assert not different, f"{different} differ with {argument}: {output}"
        case.check_remains()
        if "encoder" in output:
            continue  # OpenCV has none
        if argument == "--log-file":
            assert "the log ends here" in output, output
        else:
            assert name in output, f"{name} is not named: {output}"
        if argument == "--overlay":
            assert not file.exists(), "a part of the video remains"


@fault
def reports_of_a_benchmark_cannot_be_written(case, expected):
    limit = (max((expected / name).stat().st_size for name in replay_process.RESULTS) >> 10) + 2
    code, output = case.replay.command_run("benchmark", case.sequence, "--modes", "pl-vo", "--quiet",
                                           "--output", case.output, preexec_fn=limit_file_size(limit))
    assert code == 0 and "report.html: cannot be written" in output, f"exit code {code}: {output}"
    runs = json.loads((case.output / "benchmark.json").read_text())["runs"]
    assert len(runs) == 1 and not runs[0].get("failure"), runs


@fault
def plots_cannot_be_written(case, expected):
    """The printed errors and the estimated camera do not depend on them."""
    code, output = case.replay.command_run("evaluate", case.sequence / "groundtruth.txt", expected / "trajectory.txt",
                                           "--plot", case.output / "no" / "such" / "plot.svg")
    assert code == 1 and "APE" in output and "plot.svg: cannot be written" in output, output
    camera = case.output.with_name("camera.yaml")
    code, output = case.replay.command_run("calibrate", case.sequence, "--output", camera, "--quiet", "--plot",
                                           case.output.with_name("plot.html"), preexec_fn=limit_file_size(16))
    assert code == 1 and ("plot.html: cannot be written" in output or "camera.yaml" not in output), output
    assert camera.exists() == ("plot.html: cannot be written" in output), output


def mount_tmpfs(folder, size):
    """Whether a file system of this size could be mounted, for which only root has the right."""
    return os.geteuid() == 0 and subprocess.run(
        ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder], capture_output=True).returncode == 0


def pages(size):
    return -(-size // 4096) * 4096


@fault
def disk_has_room_for_the_results(case, expected):
    """The checkpoint and the video take the space of the results: they give way."""
    needed = sum(pages(file.stat().st_size) for file in expected.iterdir() if file.suffix != ".html") + 2 * 4096
    report = pages((expected / "report.html").stat().st_size)
    largest = max(pages((expected / name).stat().st_size) for name in replay_process.RESULTS)
    video = case.output / "video.mp4"
    # From room for the results, each beside its temporary file, to room for everything.
    for size, more in [(needed + 8 * 4096, []), (needed + largest, ["--overlay", video]),
                       (needed + report // 2, []), (needed + report + 16 * 4096, ["--overlay", video])]:
        case.output.mkdir()
        if not mount_tmpfs(case.output, size):
            case.output.rmdir()
            return "left out: a file system cannot be mounted"
        try:
            code, output = case.replay.run(*case.arguments(), *more)
            case.check(code, output, (0, 1))
            different = replay_process.differences(case.output, expected, replay_process.RESULTS)
            assert not different, f"{different} differ with {size} bytes: {output}"
            case.check_remains()
            assert not (case.output / "checkpoint").exists(), "the checkpoint remains"
            if code == 1:
                assert "report.html: cannot be written" in output or "video.mp4" in output, output
        finally:
            subprocess.run(["umount", case.output], check=True)
            case.output.rmdir()
    return None


@fault
def disk_is_full(case, expected):
    for kilobytes in [0, 8, 64, 256, 512, 1024]:
        case.output.mkdir()
        if not mount_tmpfs(case.output, f"{max(4, kilobytes)}k"):
            case.output.rmdir()
            return "left out: a file system cannot be mounted"
        try:
            code, output = case.replay.run(*case.arguments())
            case.check(code, output, (0, 1))
            case.check_remains()
            frames = replay_process.count_frames(case.output)
            if (case.output / "checkpoint" / "state.bin").exists():
                subprocess.run(["mount", "-o", "remount,size=64m", case.output], check=True)
                case.resume(expected)
                assert replay_process.count_frames(case.output) >= frames
        finally:
            subprocess.run(["umount", case.output], check=True)
            case.output.rmdir()
    return None


def stop_by(case, expected, number):
    process = case.replay.start(*case.arguments())
    replay_process.wait_for_frames(case.output, 8, process)
    process.send_signal(number)
    output = process.communicate()[0].decode()
    case.check(process.returncode, output, (130,), "--resume")
    frames = replay_process.count_frames(case.output)
    assert 8 <= frames <= FRAMES
    case.resume(expected)


@fault
def interrupt(case, expected):
    stop_by(case, expected, signal.SIGINT)


@fault
def terminate(case, expected):
    stop_by(case, expected, signal.SIGTERM)


@fault
def two_interrupts(case, expected):
    process = case.replay.start(*case.arguments())
    replay_process.wait_for_frames(case.output, 8, process)
    process.send_signal(signal.SIGINT)
    time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    output = process.communicate()[0].decode()
    case.check(process.returncode, output, (130, -signal.SIGINT))
    case.resume(expected)


@fault
def standard_output_is_full(case, expected):
    arguments = [argument for argument in case.arguments() if argument != "--quiet"]
    with open("/dev/full", "w") as full:
        process = case.replay.start(*arguments, "--json", stdout=full, stderr=subprocess.PIPE)
    output = process.communicate()[1].decode()
    case.check(process.returncode, output, (1,), "standard output cannot be written")
    assert not replay_process.differences(case.output, expected)


@fault
def standard_output_is_a_closed_pipe(case, expected):
    arguments = [argument for argument in case.arguments() if argument != "--quiet"]
    process = case.replay.start(*arguments, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    process.stdout.close()
    code = process.wait()
    case.check(code, "", (-signal.SIGPIPE,))  # as other programs end
    assert not replay_process.differences(case.output, expected)


@fault
def standard_streams_are_closed(case, expected):
    arguments = [argument for argument in case.arguments() if argument != "--quiet"]
    command = [case.replay.command, "replay", *map(str, arguments)]
    code = subprocess.run(["sh", "-c", 'exec "$@" <&- >&- 2>&-', "sh", *command]).returncode
    assert code in (0, 1), code
    assert not replay_process.differences(case.output, expected)


@fault
def standard_error_is_a_full_pipe(case, expected):
    """Nobody reads the progress: the run waits, and goes on when somebody does."""
    arguments = [argument for argument in case.arguments() if argument != "--quiet"]
    process = case.replay.start(*arguments)
    time.sleep(0.5)
    output = process.communicate()[0].decode()
    case.check(process.returncode, output, (0,))
    assert not replay_process.differences(case.output, expected)


def main():
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


if __name__ == "__main__":
    sys.exit(main())
