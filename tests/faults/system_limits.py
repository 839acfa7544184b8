#!/usr/bin/env python3
"""Runs `msc_vo replay` and other commands under limits of the system: memory, disk, signals, streams.

    system_limits.py COMMAND [--only PART_OF_NAME]

Each run must complete, or end with an error that names the cause; none may end by a signal, leave a
file that is not whole, or lose frames. Prints one line per fault; exit status 1 if any test failed.
"""
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import time

import replay_process
from fault_case import FRAMES, fault, names, run_faults


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
                assert code == 1 and names(output, name, "written"), f"{name} is not named: {output}"
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
            file.write_text("[" + "x" * ((limit << 10) - 100) + "\n")  # as a log begins; more is appended
            more += ["--log-level", "debug"]
        code, output = case.replay.run(*case.arguments(), *more, preexec_fn=limit_file_size(limit))
        case.check(code, output, (1,), ("report.html", "written", "File too large"))
        different = replay_process.differences(case.output, expected, replay_process.RESULTS)
        assert not different, f"{different} differ with {argument}: {output}"
        case.check_remains()
        if "encoder" in output:
            continue  # OpenCV has none
        if argument == "--log-file":
            assert names(output, "log", "ends"), output
        else:
            assert name in output, f"{name} is not named: {output}"
        if argument == "--overlay":
            assert not file.exists(), "a part of the video remains"


@fault
def reports_of_a_benchmark_cannot_be_written(case, expected):
    limit = (max((expected / name).stat().st_size for name in replay_process.RESULTS) >> 10) + 2
    code, output = case.replay.command_run("benchmark", case.sequence, "--modes", "pl-vo", "--quiet",
                                           "--output", case.output, preexec_fn=limit_file_size(limit))
    assert code == 0 and names(output, "report.html", "written"), f"exit code {code}: {output}"
    runs = json.loads((case.output / "benchmark.json").read_text())["runs"]
    assert len(runs) == 1 and not runs[0].get("failure"), runs


@fault
def plots_cannot_be_written(case, expected):
    """The printed errors and the estimated camera do not depend on them."""
    code, output = case.replay.command_run("evaluate", case.sequence / "groundtruth.txt", expected / "trajectory.txt",
                                           "--plot", case.output / "no" / "such" / "plot.svg")
    assert code == 1 and "APE" in output and names(output, "plot.svg", "written"), output
    camera = case.output.with_name("camera.yaml")
    code, output = case.replay.command_run("calibrate", case.sequence, "--output", camera, "--quiet", "--plot",
                                           case.output.with_name("plot.html"), preexec_fn=limit_file_size(16))
    assert code == 1 and (names(output, "plot.html", "written") or "camera.yaml" not in output), output
    assert camera.exists() == names(output, "plot.html", "written"), output


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
                assert names(output, "report.html", "written") or "video.mp4" in output, output
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
    case.check(process.returncode, output, (130,), ("--resume",))
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
    case.check(process.returncode, output, (1,), ("standard output",))
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


if __name__ == "__main__":
    sys.exit(run_faults())
