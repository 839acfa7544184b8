#!/usr/bin/env python3
"""Checks that the source tree keeps to the layers of docs/architecture.md.

    check_layers.py ROOT         reports every violation as file:line: message; exit status 1 if any
    check_layers.py --self-test  tests every rule on small trees

Rules: a folder includes only folders of lower layers; third-party and system headers stay in the
folders that may use them; x.cc includes its own x.h first, which proves that x.h compiles alone;
files and functions stay short.
"""
import re
import sys

import tree_check

# Lowest first. Folders of one layer do not include each other.
LAYERS = [
    ["camera", "text", "timing"],
    ["geometry", "checkpoint", "image_files"],
    ["frame", "factors", "evaluation", "sensor", "synthetic/scene", "report"],
    ["bundle_adjustment"],
    ["map", "synthetic/window"],
    ["matching", "structure", "features", "place_recognition"],
    ["pose_estimation", "self_calibration"],
    ["tracking", "mapping", "logging"],  # the solver below needs no spdlog
    ["odometry", "datasets", "inertial"],
    ["config", "diagnosis", "phone_recordings", "ros_bag", "openni"],
    ["recording", "results", "map_file"],
    ["exports"],
    ["apps"],
]
LAYER_OF = {folder: layer for layer, folders in enumerate(LAYERS) for folder in folders}

# Header pattern -> folders that may include it. Headers that no pattern matches are allowed everywhere.
OUTSIDE_HEADERS = [
    (r"opencv2/", {"image_files", "sensor", "features", "datasets", "phone_recordings", "ros_bag", "openni",
                   "odometry", "diagnosis", "results", "apps"}),
    (r"(rosbag|ros)/|lz4frame\.h$", {"ros_bag"}),
    (r"fastcdr/|zstd\.h$", {"ros_bag", "exports"}),
    (r"(OpenNI\.h|openni2/)", {"openni"}),
    (r"sqlite3\.h$", {"map_file", "ros_bag"}),
    (r"spdlog/", {"logging", "apps"}),
    (r"yaml-cpp/", {"config", "ros_bag", "results"}),
    (r"nlohmann/", {"report", "datasets", "recording", "results", "exports", "apps"}),
    (r"ceres/", {"factors", "bundle_adjustment", "pose_estimation", "structure", "self_calibration",
                 "inertial", "apps"}),
    (r"(thread|mutex|shared_mutex|future|condition_variable)$",
     {"odometry", "datasets", "phone_recordings", "ros_bag", "openni", "apps"}),
    (r"atomic$", {"odometry", "datasets", "apps"}),
    (r"chrono$", {"timing", "odometry", "datasets", "openni", "results", "apps"}),
    (r"(fstream|filesystem)$", {"text", "datasets", "phone_recordings", "ros_bag", "diagnosis", "config",
                                "recording", "results", "map_file", "exports", "apps"}),
    (r"httplib", {"apps"}),
    (r"benchmark/", {"apps"}),
    (r"gtest/|gmock/", set()),
]
# Generated; belongs to no folder.
COMMON_HEADERS = {"msc_vo/version.h"}

MAX_FILE_LINES = 400
MAX_FUNCTION_LINES = 60

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
# Start of a statement whose body is not that of a function.
NO_FUNCTION = re.compile(r"^\s*(namespace|(template\s*<.*>\s*)?(class|struct|enum|union)|extern)\b")
STRINGS_AND_COMMENTS = re.compile(
    r'R"(?P<delimiter>[^(\s]*)\(.*?\)(?P=delimiter)"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'|//[^\n]*|/\*.*?\*/", re.DOTALL)


def check_includes(folder, path, lines):
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        header = match.group(2)
        if header in COMMON_HEADERS:
            continue
        parts = header.split("/")
        if parts[0] in ("msc_vo", "apps"):
            other = folder_of(parts)
            if other not in LAYER_OF:
                yield number, f"includes {header}, whose folder has no layer in check_layers.py"
            elif other != folder and LAYER_OF[other] >= LAYER_OF[folder]:
                yield number, f"{folder} must not include {header}: {other} is not below it"
            elif other != folder and "internal" in parts and "benchmarks" not in path.parts:
                yield number, f"{folder} must not include {header}: it is internal to {other}"
            continue
        for pattern, allowed in OUTSIDE_HEADERS:
            if re.match(pattern, header) and folder not in allowed:
                where = ", ".join(sorted(allowed)) or "tests"
                yield number, f"{folder} must not include <{header}>: only {where} may"


def check_own_header_first(path, root, lines):
    own = path.with_suffix(".h")
    if path.suffix != ".cc" or not own.exists():
        return
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if match:
            if match.group(2) != own.relative_to(root).as_posix():
                yield number, f"must include its own header {own.name} first"
            return


def blank_out(match):
    return re.sub(r"[^\n]", " ", match.group())


def function_bodies(text):
    """Yields (first line, last line) of every outermost body that is not of a namespace or type.

    Counts braces, which suffices for code formatted by clang-format.
    """
    code = STRINGS_AND_COMMENTS.sub(blank_out, text)
    open_bodies = []  # (line where the statement starts, is it a function)
    statement_line, statement = None, ""
    for number, line in enumerate(code.splitlines(), 1):
        if line.lstrip().startswith("#"):
            continue
        for char in line:
            if char == "{":
                inside_function = any(is_function for _, is_function in open_bodies)
                is_function = ("(" in statement and not inside_function and
                               not NO_FUNCTION.match(statement))
                open_bodies.append((statement_line or number, is_function))
            elif char == "}" and open_bodies:
                first, is_function = open_bodies.pop()
                if is_function:
                    yield first, number
            if char in "{};":
                statement_line, statement = None, ""
            elif statement_line is not None or not char.isspace():
                statement_line = statement_line or number
                statement += char
        statement += " " if statement else ""


def check_lengths(text, lines):
    if len(lines) > MAX_FILE_LINES:
        yield len(lines), f"file has {len(lines)} lines, more than {MAX_FILE_LINES}"
    for first, last in function_bodies(text):
        if last - first + 1 > MAX_FUNCTION_LINES:
            yield first, f"function has {last - first + 1} lines, more than {MAX_FUNCTION_LINES}"


def folder_of(parts):
    """The folder with a layer that a file with these path components belongs to, or None."""
    if parts[0] == "apps":
        return "apps"
    if parts[0] != "msc_vo" or len(parts) < 3:
        return None
    nested = "/".join(parts[1:3])
    return nested if nested in LAYER_OF else parts[1]


def check_tree(root):
    """All violations in the tree as (path, line, message)."""
    for top in ("msc_vo", "apps", "tests"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in (".h", ".cc", ".js", ".css"):
                continue
            text = path.read_text(encoding="utf-8")
            lines = text.splitlines()
            if path.suffix in (".js", ".css"):
                if len(lines) > MAX_FILE_LINES:
                    yield (path.relative_to(root), len(lines),
                           f"file has {len(lines)} lines, more than {MAX_FILE_LINES}")
                continue
            violations = list(check_lengths(text, lines))
            folder = folder_of(path.relative_to(root).parts)
            if folder in LAYER_OF:
                violations += check_includes(folder, path, lines)
                violations += check_own_header_first(path, root, lines)
            elif top == "msc_vo":
                violations.append((1, f"folder {folder} has no layer in check_layers.py"))
            for number, message in sorted(violations):
                yield path.relative_to(root), number, message


def self_test():
    long_body = "void F() {\n" + "  G();\n" * MAX_FUNCTION_LINES + "}\n"
    # File, contents, a part of the message that must be the only one (None: must pass).
    cases = [
        ("msc_vo/geometry/a.h", '#include "msc_vo/map/b.h"\n', "map is not below it"),
        ("msc_vo/synthetic/scene/a.h", '#include "msc_vo/synthetic/window/b.h"\n',
         "synthetic/window is not below it"),
        ("msc_vo/map/a.h", '#include "msc_vo/bundle_adjustment/internal/b.h"\n',
         "internal to bundle_adjustment"),
        ("msc_vo/tracking/a.h", '#include "msc_vo/mapping/b.h"\n', "mapping is not below it"),
        ("msc_vo/results/a.cc", '#include "apps/cli/commands.h"\n', "apps is not below it"),
        ("msc_vo/tracking/a.h", '#include "msc_vo/attic/b.h"\n', "has no layer"),
        ("msc_vo/attic/a.h", "", "attic has no layer"),
        ("msc_vo/tracking/a.h", "#include <opencv2/core.hpp>\n", "tracking must not include"),
        ("msc_vo/mapping/a.h", "#include <ceres/ceres.h>\n", "only apps, bundle_adjustment, factors"),
        ("msc_vo/mapping/a.h", '#  include "spdlog/spdlog.h"\n', "must not include <spdlog/"),
        ("msc_vo/structure/a.cc", '#include "msc_vo/logging/logger.h"\n',
         "logging is not below it"),
        ("msc_vo/map/a.h", "#include <mutex>\n", "only apps, datasets, odometry, openni, phone_recordings, ros_bag"),
        ("msc_vo/map/a.h", "#include <chrono>\n", "must not include <chrono>"),
        ("msc_vo/synthetic/scene/a.cc", "#include <fstream>\n", "must not include <fstream>"),
        ("msc_vo/map/a.cc", "\n" * (MAX_FILE_LINES + 1), "file has 401 lines"),
        ("msc_vo/report/web/a.js", "\n" * (MAX_FILE_LINES + 1), "file has 401 lines"),
        ("msc_vo/map/a.cc", long_body, "function has 62 lines"),
        ("msc_vo/map/a.cc", "class A {\n" + long_body + "};\n", "function has 62 lines"),
        ("tests/map/a.cc", long_body, "function has 62 lines"),
        ("msc_vo/geometry/so3.cc", "#include <cmath>\n", "must include its own header so3.h"),
        ("msc_vo/results/a.cc", "#include <httplib.h>\n", "must not include <httplib.h>"),
        # Allowed:
        ("msc_vo/odometry/a.h", '#include "msc_vo/features/b.h"\n#include <thread>\n', None),
        ("msc_vo/map/a.h", '#include "msc_vo/map/b.h"\n#include "msc_vo/version.h"\n', None),
        ("msc_vo/map/a.cc", "// #include <mutex>\n", None),
        ("msc_vo/map/a.cc", "namespace a {\nclass B {\n" + "  int c();\n" * 70 + "};\n}\n", None),
        ("msc_vo/map/a.cc", 'const char a[] = R"x(\n' + "(){\n" * 70 + ')x";\n', None),
        ("msc_vo/map/a.cc", "int a[] = {\n" + "  1,\n" * 70 + "};\n", None),
    ]
    return tree_check.test_rules([({"msc_vo/geometry/so3.h": "", path: contents}, expected)
                                  for path, contents, expected in cases], check_tree)


if __name__ == "__main__":
    sys.exit(tree_check.main(__doc__.splitlines()[0], "msc_vo", check_tree, self_test))
