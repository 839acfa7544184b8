# SPDX-License-Identifier: BSD-3-Clause
# SPDX-FileCopyrightText: 2026 the msc_vo authors
"""Build back-end (PEP 517) of the Python module: CMake builds it, and this puts it into a wheel.

It needs the standard library only. Settings, given to pip as --config-settings NAME=VALUE:

    build-dir    a build folder of CMake that is kept and used again; default: a temporary one
    cmake-args   further arguments of CMake, separated by spaces
"""
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

import msc_vo_wheel as wheel

ROOT = pathlib.Path(__file__).resolve().parents[3]


def get_requires_for_build_wheel(config_settings=None):
    """Nothing that pip could install: the rest are packages of the system."""
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = wheel.dist_info(ROOT)
    for name, text in wheel.metadata_files(ROOT).items():
        path = pathlib.Path(metadata_directory, folder, name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text)
    return folder


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = dict(config_settings or {})
    unknown = set(settings) - {"build-dir", "cmake-args"}
    if unknown:
        raise SystemExit(f"unknown setting {sorted(unknown)[0]!r}: give build-dir or cmake-args")
    # pip gives a list of a setting that occurs several times.
    if isinstance(settings.get("build-dir"), list):
        raise SystemExit("build-dir is given more than once")
    arguments = settings.get("cmake-args", "")
    arguments = shlex.split(" ".join(arguments) if isinstance(arguments, list) else arguments)
    with tempfile.TemporaryDirectory() as scratch:
        build = os.path.abspath(settings.get("build-dir") or os.path.join(scratch, "build"))
        package = build_package(pathlib.Path(build), pathlib.Path(scratch, "install"),
                                arguments)
        return wheel.write(ROOT, package, pathlib.Path(wheel_directory))


def build_sdist(sdist_directory, config_settings=None):
    raise SystemExit("msc-vo has no source distribution of its own: give pip the checkout (pip "
                     "install .), or make an archive with git archive")


def build_package(build, prefix, arguments):
    """Builds the package msc_vo and returns the folder that it is installed in."""
    require("cmake", "cmake")
    configure = ["cmake", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
                 f"-DCMAKE_INSTALL_PREFIX={prefix}", "-DMSC_VO_BUILD_APPS=ON",
                 "-DMSC_VO_BUILD_TESTS=OFF", "-DMSC_VO_BUILD_FUSION=OFF",
                 "-DMSC_VO_BUILD_PYTHON=ON", f"-DMSC_VO_PYTHON_EXECUTABLE={sys.executable}",
                 "-DMSC_VO_PYTHON_INSTALL_DIR=package", "-DBUILD_SHARED_LIBS=OFF", *arguments]
    if shutil.which("ninja") and not (build / "CMakeCache.txt").exists():
        configure += ["-G", "Ninja"]
    run(configure)
    if "msc_vo_python" not in subprocess.run(["cmake", "--build", build, "--target", "help"],
                                             check=True, capture_output=True, text=True).stdout:
        raise SystemExit(f"CMake has left the Python module out: install pybind11-dev and the headers "
                         f"of {sys.executable} (python3-dev)")
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(os.cpu_count() or 1)
    run(["cmake", "--build", build, "--target", "msc_vo_python", "--parallel", jobs])
    run(["cmake", "--install", build, "--component", "python", "--prefix", prefix])
    return prefix / "package" / "msc_vo"


def require(program, package):
    if not shutil.which(program):
        raise SystemExit(f"{program} is not installed: apt install {package}; msc_vo is built with "
                         f"the packages of {ROOT}/cmake/debian_packages.txt")


def run(command):
    print("+", *command, flush=True)
    if subprocess.run(command).returncode != 0:
        raise SystemExit(f"{command[0]} has failed, see above; docs/python.md lists what it needs")
