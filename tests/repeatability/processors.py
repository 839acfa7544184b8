#!/usr/bin/env python3
"""The same results on other processors: compares runs whose processor features are restricted.

    processors.py MSC_VO [--libm] [--sequence FOLDER] [--set NAME=VALUE]... [--emulate CPU]...

Without --sequence, a rendered one. --libm: also without the variants of the C library's mathematical
functions for newer processors. --set: options of the runs. --emulate: also on an emulated processor
("Nehalem"), by qemu-x86_64, which is slow. Exits with 77 if the sequence is not there.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

FILES = ["trajectory.txt", "keyframes.txt", "map.ply", "lines.ply"]
# What is switched off: every extension for which the C library or OpenCV has code of its own.
LIBM = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4,-AVX512F"}
OPENCV = {"OPENCV_CPU_DISABLE": "AVX512-SKX,AVX2,FMA3,AVX,FP16,SSE4.2,SSE4.1,SSSE3"}


def replay(prefix, command, sequence, options, output, environment):
    subprocess.run([*prefix, command, "replay", sequence, "--output", output, "--max-frames", "300", *options],
                   check=True, capture_output=True, env={**os.environ, **environment})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("--libm", action="store_true")
    parser.add_argument("--sequence")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE")
    parser.add_argument("--emulate", action="append", default=[], metavar="CPU")
    arguments = parser.parse_args()
    if arguments.sequence and not pathlib.Path(arguments.sequence).is_dir():
        print(f"skipped: {arguments.sequence} is not there")
        return 77

    variants = {"without OpenCV's extensions": ([], OPENCV)}
    if arguments.libm:
        variants["without extensions"] = ([], {**OPENCV, **LIBM})
    for cpu in arguments.emulate:
        variants[f"on an emulated {cpu}"] = (["qemu-x86_64", "-cpu", cpu], {})

    options = [text for setting in arguments.set for text in ("--set", setting)]
    different = []
    with tempfile.TemporaryDirectory(prefix="msc_vo_processors_") as folder:
        sequence = arguments.sequence or f"{folder}/room"
        if not arguments.sequence:
            subprocess.run([arguments.command, "synthesize", sequence, "--frames", "40", "--width", "160",
                            "--noise", "kinect"], check=True, capture_output=True)
        replay([], arguments.command, sequence, options, f"{folder}/here", {})
        for name, (prefix, environment) in variants.items():
            replay(prefix, arguments.command, sequence, options, f"{folder}/there", environment)
            for file in FILES:
                if pathlib.Path(folder, "here", file).read_bytes() != pathlib.Path(folder, "there", file).read_bytes():
                    different.append(f"{file} {name}")
    for what in different:
        print(f"not the same: {what}")
    print(f"{len(variants) * len(FILES)} files compared, {len(different)} differ")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
